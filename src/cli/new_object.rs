//! `stargrip-cam new NAME --object Q --mass Q`: the spec of a gripper that holds an object.

use std::fmt::Write;
use std::path::Path;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde_json::{Value, json};

use crate::cli::defaults;
use crate::cli::details::hours;
use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::load::read_source;
use crate::cli::overview::sealing_time;
use crate::cli::quantity::{SIZE, number, quantity};
use crate::design::{RefusalCode, Refusals};
use crate::forecast::candidate::Candidate;
use crate::forecast::sizing::{
    Choice, FRICTION, Infeasible, NearestRequirements, Requirements, Workspace, choose, spec_text,
};
use crate::forecast::verdict::Verdict;
use crate::pipeline::Forecast;
use crate::spec;
use crate::spec::{Allowed, FeedFloor, Machine, ObjectShape, Source, Spec};
use crate::units::{Force, Length, Mass, Pressure};
use inflatable::mechanics::hinge::ring::RingTable;

/// What the gripper is wanted for.
#[derive(clap::Args, Debug)]
pub(super) struct ObjectArgs {
    /// How wide the object is across where it is gripped: "70 mm".
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = quantity::<Length>(SIZE), requires = "mass")]
    object: Option<Length>,
    /// Height of the object along the gripper's axis: "57 mm"; default: as tall as wide.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = quantity::<Length>(SIZE), requires = "object")]
    height: Option<Length>,
    /// Shape of the object; default: ball.
    #[arg(long, value_name = "SHAPE", value_parser = shape_parser(), requires = "object")]
    shape: Option<ObjectShape>,
    /// Mass of the object: "1.3 kg".
    #[arg(long, value_name = "MASS", allow_hyphen_values = true, value_parser = quantity::<Mass>(Allowed::above(0.0, 1e4)), requires = "object")]
    mass: Option<Mass>,
    /// The pressure that your pump gives; default: the best from 5 to 60 kPa.
    #[arg(long, value_name = "PRESSURE", allow_hyphen_values = true, value_parser = quantity::<Pressure>(Allowed::closed(1e-3, 1e6)), requires = "object")]
    pressure: Option<Pressure>,
    /// Friction between corners and object; default: 0.3, bare fabric on a smooth surface. Coated corners have about 1.
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, value_parser = number(Allowed::above(0.0, 10.0)), requires = "object")]
    friction: Option<f64>,
    /// Largest radial force of one star that the object bears: "20 N".
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true, value_parser = quantity::<Force>(Allowed::above(0.0, 1e6)), requires = "object")]
    fragile: Option<Force>,
    /// "paper", or a spec whose `[fabric]` is taken.
    #[arg(long, value_name = "NAME", requires = "object")]
    fabric: Option<String>,
    /// A built-in machine profile's name; default: generic.
    #[arg(long, value_name = "NAME", requires = "object")]
    machine: Option<String>,
    /// Size of the fabric sheets: 400x400 in mm, or A4.
    #[arg(long, value_name = "WxH", value_parser = sheet, requires = "object")]
    sheet: Option<[Length; 2]>,
}

fn shape_parser() -> impl TypedValueParser<Value = ObjectShape> {
    PossibleValuesParser::new(ObjectShape::ALL.map(|(word, _)| word)).try_map(|word| {
        ObjectShape::ALL
            .iter()
            .find(|(name, _)| *name == word)
            .map(|(_, shape)| *shape)
            .ok_or("no such shape")
    })
}

/// Inner radius of curvature of tips and corners: at 2 mm the seal bears some two fifths of what sharp ones put on it.
const ROUND: Length = Length(2.0);

/// Paper sizes of ISO 216 from A0, mm, landscape.
const PAPERS: [[f64; 2]; 6] =
    [[1189.0, 841.0], [841.0, 594.0], [594.0, 420.0], [420.0, 297.0], [297.0, 210.0], [210.0, 148.0]];

/// Objects of usual sizes, mm across: beyond them the unit may be wrong.
const USUAL_SIZES: Allowed = Allowed::closed(5.0, 1000.0);

/// Reads "400x300", in mm, or "A3".
fn sheet(text: &str) -> Result<[Length; 2], String> {
    let fault = || format!("`{text}` is not WIDTHxHEIGHT in mm, like 400x300, and not A0 to A5");
    let paper =
        text.trim().strip_prefix(['A', 'a']).and_then(|number| PAPERS.get(number.parse::<usize>().ok()?));
    if let Some(paper) = paper {
        return Ok(paper.map(Length));
    }
    let (width, height) = text.split_once(['x', 'X', '\u{d7}']).ok_or_else(fault)?;
    let side = |text: &str| {
        let text = text.trim().trim_end_matches("mm").trim();
        text.parse().ok().filter(|mm| SIZE.holds(*mm)).map(Length).ok_or_else(fault)
    };
    Ok([side(width)?, side(height)?])
}

/// A gripper for an object: its spec, and what was forecast of it.
pub(super) struct NewGripper {
    /// The spec's text.
    pub(super) text: String,
    /// Everything that `check` knows of it.
    pub(super) forecast: Forecast,
    /// Whether its friction is the default.
    pub(super) friction_assumed: bool,
}

impl NewGripper {
    /// The verdict with its reasons, and below it what was chosen: a line each.
    pub(super) fn in_words(&self) -> String {
        let verdict = self.forecast.verdict();
        let mut lines: Vec<String> = verdict.iter().map(Verdict::line).collect();
        let more = |verdict: &Verdict| verdict.one_star().into_iter().chain(verdict.assumed_in_words());
        let reasons = verdict.iter().flat_map(|verdict| verdict.reasons.iter().cloned().chain(more(verdict)));
        lines.extend(reasons.map(|reason| format!("  {reason}")));
        lines.extend(self.star_in_words());
        lines.join("\n") + "\n"
    }

    fn star_in_words(&self) -> Option<String> {
        let Forecast { spec, .. } = &self.forecast;
        let (star, load) = (spec.stars.first()?, spec.load.as_ref()?);
        let stars =
            if spec.stars.len() == 1 { "1 star".to_owned() } else { format!("{} stars", spec.stars.len()) };
        let [width, height] = self.fabric()?.map(f64::round);
        let at = load.pressure.map_or_else(String::new, |pressure| format!("; {pressure}"));
        let friction = load.friction.map_or_else(String::new, |friction| {
            let assumed = if self.friction_assumed { " assumed: change it with --friction" } else { "" };
            format!("; friction {friction}{assumed}")
        });
        Some(format!(
            "{stars} of {} points, tube {} wide, {width} x {height} mm of fabric{at}; {} of sealing{friction}",
            star.points,
            star.tube_width,
            hours(sealing_time(&self.forecast)),
        ))
    }

    /// Width and height of the first star's cut, mm.
    fn fabric(&self) -> Option<[f64; 2]> {
        let bounds = self.forecast.design.assembly()?.distinct.first()?.outline.outside.bounds();
        Some([bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y])
    }

    /// What was chosen, for programs.
    pub(super) fn json(&self) -> Value {
        let Forecast { spec, .. } = &self.forecast;
        let (star, load) = (spec.stars.first(), spec.load.as_ref());
        json!({
            "stars": spec.stars.len(),
            "points": star.map(|star| star.points),
            "tube_width_mm": star.map(|star| star.tube_width.0),
            "fabric_mm": self.fabric(),
            "pressure_kPa": load.and_then(|load| Some(load.pressure?.0)),
            "friction": load.and_then(|load| load.friction),
            "friction_assumed": self.friction_assumed,
            "sealing_time_s": sealing_time(&self.forecast),
        })
    }
}

/// The spec of a gripper for the object; `None` without an object.
pub(super) fn chosen(name: &str, args: &ObjectArgs) -> Result<Option<NewGripper>, Failure> {
    let Some((object, mass)) = args.object.zip(args.mass) else { return Ok(None) };
    let base = base(args)?;
    let machine = machine(&base.machine.profile)?;
    let _ = spec::quoted(name).map_err(|fault| Failure::Message(fault.to_string()))?;
    // The inlet reaches beyond the tip on one side.
    let inlet = base.inlet.as_ref().map_or(0.0, |inlet| inlet.length.0);
    let requirements = Requirements {
        object: Length(0.5 * object.0),
        height: args.height,
        shape: args.shape,
        mass,
        pressure: args.pressure,
        friction: args.friction.unwrap_or(FRICTION),
        largest_force: args.fragile,
        room: Workspace {
            sheet: smaller(base.sheet.width, base.sheet.height),
            machine: machine.bench.work_area.and_then(|(x, y)| smaller(Some(x), Some(y))),
            edge: Length(2.0 * base.sheet.margin.0 + inlet),
        },
    };
    let ring = RingTable::new().map_err(|fault| Failure::Message(fault.to_string()))?;
    let candidate =
        Candidate::of(&base).ok_or_else(|| Failure::Message("the spec has no star".to_owned()))?;
    let made = |choices: &[Choice], base: &Spec| {
        let mut why = None;
        for choice in choices {
            match buildable(name, choice, base, &machine) {
                Ok((text, forecast)) => {
                    return Ok(NewGripper { text, forecast, friction_assumed: args.friction.is_none() });
                }
                Err(refusals) => why = why.or(Some(refusals)),
            }
        }
        Err(why.unwrap_or_default())
    };
    let choices = choose(&requirements, &candidate, &ring).map_err(|Infeasible { reasons, nearest }| {
        // What is named can be had: it is tried as far as the requirements are.
        let nearest = nearest.filter(|nearest| {
            let mut base = base.clone();
            if nearest.requirements.room.sheet != requirements.room.sheet {
                [base.sheet.width, base.sheet.height] = [nearest.requirements.room.sheet; 2];
            }
            made(&nearest.choices, &base).is_ok()
        });
        let unit = (!USUAL_SIZES.holds(object.0))
            .then(|| format!("an object {object} across: is the unit right (mm, cm, m, in)?"));
        let reasons: Vec<String> = unit.into_iter().chain(reasons).collect();
        missed(&reasons, nearest.and_then(|nearest| in_words(name, args, &requirements, &nearest)))
    })?;
    made(&choices, &base).map(Some).map_err(|why| {
        let why: Vec<String> = why.iter().map(|one| format!("{}: {}", one.found, one.remedy)).collect();
        Failure::Message(format!("the gripper that would hold this cannot be made: {}", why.join("; ")))
    })
}

/// The smaller of the sides that have an end.
fn smaller(width: Option<Length>, height: Option<Length>) -> Option<Length> {
    [width, height].into_iter().flatten().reduce(|a, b| if b.0 < a.0 { b } else { a })
}

/// `text` as a shell takes it for one word.
fn argument(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
    if text.chars().all(is_plain) { text.to_owned() } else { format!("\"{}\"", shown(text)) }
}

/// What can be had in place of `requirements`, and the command that has it.
fn in_words(
    name: &str,
    args: &ObjectArgs,
    requirements: &Requirements,
    nearest: &NearestRequirements,
) -> Option<String> {
    let (had, best) = (&nearest.requirements, &nearest.choices.first()?.best.point);
    let stars = if best.stars == 1 { "1 star".to_owned() } else { format!("{} stars", best.stars) };
    let at = best.load.pressure.map_or(String::new(), |pressure| format!(" at {pressure}"));
    let mut words = vec![format!("stargrip-cam new {}", argument(name))];
    let mut word = |option: &str, value: String| words.push(format!("--{option} \"{}\"", shown(value)));
    word("object", Length(2.0 * had.object.0).to_string());
    if let Some(height) = had.height {
        word("height", height.to_string());
    }
    if let Some(shape) = had.shape {
        word("shape", shape.word().to_owned());
    }
    word("mass", had.mass.to_string());
    let is_assumed = args.friction.is_none() && had.friction == requirements.friction;
    let friction = (!is_assumed).then_some(had.friction);
    for (option, value) in [
        ("pressure", had.pressure.map(|pressure| pressure.to_string())),
        ("friction", friction.map(|friction| friction.to_string())),
        ("fragile", had.largest_force.map(|force| force.to_string())),
        ("fabric", args.fabric.clone()),
        ("machine", args.machine.clone()),
    ] {
        if let Some(value) = value {
            word(option, value);
        }
    }
    let sheet = if had.room.sheet == requirements.room.sheet {
        args.sheet
    } else {
        had.room.sheet.map(|side| [side; 2])
    };
    if let Some([width, height]) = sheet {
        word("sheet", format!("{}x{}", width.0, height.0));
    }
    Some(format!(
        "{stars} of {} points, {} wide{at}:\n  {}",
        best.star.points,
        best.star.tube_width,
        words.join(" ")
    ))
}

/// Fabric, machine, sheet and radii of curvature: what the search does not change.
fn base(args: &ObjectArgs) -> Result<Spec, Failure> {
    let text = spec::starter("base").map_err(|fault| Failure::Message(fault.to_string()))?;
    let text = defaults::written_into(text)?;
    let mut base = spec::read(&Source::new("starter", text))?.spec;
    if let Some(fabric) = args.fabric.as_deref().filter(|fabric| *fabric != "paper") {
        base.fabric = spec::read(&read_source(Path::new(fabric))?)?.spec.fabric;
    }
    if let Some(machine) = &args.machine {
        base.machine.profile.clone_from(machine);
    }
    if let Some([width, height]) = args.sheet {
        [base.sheet.width, base.sheet.height] = [Some(width), Some(height)];
    }
    for star in &mut base.stars {
        (star.tip_radius, star.corner_radius) = (ROUND, ROUND);
    }
    Ok(base)
}

fn machine(profile: &str) -> Result<Machine, Failure> {
    if spec::builtin_machine(profile).is_some() {
        return Machine::builtin(profile).map_err(|fault| Failure::Message(fault.to_string()));
    }
    let path = Path::new(profile);
    if path.is_file() {
        return Ok(spec::read_machine(&read_source(path)?)?);
    }
    let remedy = spec::usual_profile(profile).map_or_else(
        || format!("there are {}", spec::builtin_machines().collect::<Vec<_>>().join(", ")),
        |(controller, name)| format!("it usually has {controller}: --machine {name}"),
    );
    Err(Failure::Message(format!("{profile:?} is not a machine profile, and not a file; {remedy}")))
}

/// The spec of `choice`, if all that `check` does accepts it, with the controller's low feeds chopped where they must be.
fn buildable(
    name: &str,
    choice: &Choice,
    base: &Spec,
    machine: &Machine,
) -> Result<(String, Forecast), Refusals> {
    let attempt = |base: &Spec| {
        let text = spec_text(name, choice, base).map_err(|_| Refusals::new())?;
        let spec = spec::read(&Source::new("chosen", text.clone())).map_err(|_| Refusals::new())?.spec;
        let forecast = Forecast::of(spec, machine.clone())?;
        forecast.unfit().or(())?;
        Ok((text, forecast))
    };
    let mut base = base.clone();
    let (text, forecast) = attempt(&base).or_else(|why: Refusals| {
        base.machine.feed_floor = FeedFloor::Chop;
        attempt(&base).map_err(|_| why)
    })?;
    // Windows that are shorter than the default are accepted in the spec: `check` need not warn of them.
    let is_short = forecast.design.warnings.iter().any(|warning| warning.code == RefusalCode::ShortWindow);
    let stars = forecast.design.assembly().into_iter().flat_map(|assembly| &assembly.distinct);
    let reaches = stars.map(|part| part.mask.extent);
    let Some(shortest) = reaches.reduce(f64::min).filter(|_| is_short) else { return Ok((text, forecast)) };
    base.mask.extent = Some(Length((shortest * 100.0).floor() / 100.0));
    attempt(&base)
}

fn missed(reasons: &[String], nearest: Option<String>) -> Failure {
    let mut text = String::from("no gripper was found that does all of this:");
    for reason in reasons {
        // A String takes everything.
        let _ = write!(text, "\n  {reason}");
    }
    if let Some(nearest) = nearest {
        let _ = write!(text, "\na request near it that can be met: {nearest}");
    }
    Failure::Infeasible(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_is_two_lengths() {
        assert_eq!(sheet("400x300"), Ok([Length(400.0), Length(300.0)]));
        assert_eq!(sheet("400 mm x 300 mm"), Ok([Length(400.0), Length(300.0)]));
        assert_eq!(sheet("A3"), Ok([Length(420.0), Length(297.0)]));
        assert_eq!(sheet("a0"), Ok([Length(1189.0), Length(841.0)]));
        for bad in ["400", "400x", "x", "0x5", "nanx5", "400x300x2", "A", "A6", "A-1"] {
            assert!(sheet(bad).is_err(), "{bad}");
        }
    }
}
