//! `stargrip-cam new NAME --object Q --mass Q`: the spec of a gripper that holds an object.

use std::fmt::Write;
use std::path::Path;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::cli::defaults;
use crate::cli::failure::Failure;
use crate::cli::harmless::shown;
use crate::cli::load::read_source;
use crate::cli::quantity::{SIZE, number, quantity};
use crate::design::Refusals;
use crate::forecast::candidate::Candidate;
use crate::forecast::choosing::{Choice, Miss, Nearest, Room, Wish, choose, spec_text};
use crate::forecast::verdict::Verdict;
use crate::mechanics::hinge::ring::RingTable;
use crate::pipeline::Forecast;
use crate::spec;
use crate::spec::{Allowed, FeedFloor, Machine, ObjectShape, Source, Spec};
use crate::units::{Force, Length, Mass, Pressure};

/// What the gripper is wanted for.
#[derive(clap::Args, Debug)]
pub(super) struct ObjectArgs {
    /// How wide the object is across where it is gripped: "70 mm".
    #[arg(long, value_name = "LENGTH", value_parser = quantity::<Length>(SIZE), requires = "mass")]
    object: Option<Length>,
    /// Height of the object along the gripper's axis: "57 mm"; default: as tall as wide.
    #[arg(long, value_name = "LENGTH", value_parser = quantity::<Length>(SIZE), requires = "object")]
    height: Option<Length>,
    /// Shape of the object; default: ball.
    #[arg(long, value_name = "SHAPE", value_parser = shape_parser(), requires = "object")]
    shape: Option<ObjectShape>,
    /// Mass of the object: "1.3 kg".
    #[arg(long, value_name = "MASS", value_parser = quantity::<Mass>(Allowed::above(0.0, 1e4)), requires = "object")]
    mass: Option<Mass>,
    /// The pressure that your pump gives; default: the best from 5 to 60 kPa.
    #[arg(long, value_name = "PRESSURE", value_parser = quantity::<Pressure>(Allowed::closed(1e-3, 1e6)), requires = "object")]
    pressure: Option<Pressure>,
    /// Friction between corners and object; default: 0.5, bare fabric on a smooth surface.
    #[arg(long, value_name = "RATIO", value_parser = number(Allowed::above(0.0, 10.0)), requires = "object")]
    friction: Option<f64>,
    /// Largest radial force of one star that the object bears: "20 N".
    #[arg(long, value_name = "FORCE", value_parser = quantity::<Force>(Allowed::above(0.0, 1e6)), requires = "object")]
    fragile: Option<Force>,
    /// "paper", or a spec whose `[fabric]` is taken.
    #[arg(long, value_name = "NAME", requires = "object")]
    fabric: Option<String>,
    /// A built-in machine profile's name; default: generic.
    #[arg(long, value_name = "NAME", requires = "object")]
    machine: Option<String>,
    /// Size of the fabric sheets, mm: 400x400.
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

/// Friction of bare fabric on a smooth surface, assumed.
const FRICTION: f64 = 0.5;
/// Inner radius of curvature of tips and corners: at 2 mm the seal bears some two fifths of what sharp ones put on it.
const ROUND: Length = Length(2.0);

/// Reads "400x300", in mm.
fn sheet(text: &str) -> Result<[Length; 2], String> {
    let fault = || format!("`{text}` is not WIDTHxHEIGHT in mm, like 400x300");
    let (width, height) = text.split_once(['x', 'X', '\u{d7}']).ok_or_else(fault)?;
    let side = |text: &str| {
        let text = text.trim().trim_end_matches("mm").trim();
        text.parse().ok().filter(|mm| SIZE.holds(*mm)).map(Length).ok_or_else(fault)
    };
    Ok([side(width)?, side(height)?])
}

/// The spec called `name`, and the verdict on its gripper.
type Made = (String, Option<Verdict>);

/// The spec of a gripper for the object; `None` without an object.
pub(super) fn chosen(name: &str, args: &ObjectArgs) -> Result<Option<Made>, Failure> {
    let Some((object, mass)) = args.object.zip(args.mass) else { return Ok(None) };
    let base = base(args)?;
    let machine = machine(&base.machine.profile)?;
    let _ = spec::quoted(name).map_err(|fault| Failure::Message(fault.to_string()))?;
    // The inlet reaches beyond the tip on one side.
    let inlet = base.inlet.as_ref().map_or(0.0, |inlet| inlet.length.0);
    let wish = Wish {
        object: Length(0.5 * object.0),
        height: args.height,
        shape: args.shape,
        mass,
        pressure: args.pressure,
        friction: args.friction.unwrap_or(FRICTION),
        largest_force: args.fragile,
        room: Room {
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
                Ok(made) => return Ok(made),
                Err(refusals) => why = why.or(Some(refusals)),
            }
        }
        Err(why.unwrap_or_default())
    };
    let choices = choose(&wish, &candidate, &ring).map_err(|Miss { reasons, nearest }| {
        // What is named can be had: it is tried as far as a wish is.
        let nearest = nearest.filter(|nearest| {
            let mut base = base.clone();
            if nearest.wish.room.sheet != wish.room.sheet {
                [base.sheet.width, base.sheet.height] = [nearest.wish.room.sheet; 2];
            }
            made(&nearest.choices, &base).is_ok()
        });
        missed(&reasons, nearest.and_then(|nearest| in_words(name, args, &wish, &nearest)))
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

/// What can be had in place of `wish`, and the command that has it.
fn in_words(name: &str, args: &ObjectArgs, wish: &Wish, nearest: &Nearest) -> Option<String> {
    let (had, best) = (&nearest.wish, &nearest.choices.first()?.best.point);
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
    for (option, value) in [
        ("pressure", had.pressure.map(|pressure| pressure.to_string())),
        ("friction", args.friction.map(|friction| friction.to_string())),
        ("fragile", had.largest_force.map(|force| force.to_string())),
        ("fabric", args.fabric.clone()),
        ("machine", args.machine.clone()),
    ] {
        if let Some(value) = value {
            word(option, value);
        }
    }
    let sheet =
        if had.room.sheet == wish.room.sheet { args.sheet } else { had.room.sheet.map(|side| [side; 2]) };
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
    let known: Vec<&str> = spec::builtin_machines().collect();
    Err(Failure::Message(format!(
        "no machine profile is called {profile:?}, and there is no such file; there are {}",
        known.join(", ")
    )))
}

/// The spec of `choice`, if all that `check` does accepts it, with the controller's low feeds chopped where they must be.
fn buildable(name: &str, choice: &Choice, base: &Spec, machine: &Machine) -> Result<Made, Refusals> {
    let attempt = |feed_floor: FeedFloor| {
        let mut base = base.clone();
        base.machine.feed_floor = feed_floor;
        let text = spec_text(name, choice, &base).map_err(|_| Refusals::new())?;
        let spec = spec::read(&Source::new("chosen", text.clone())).map_err(|_| Refusals::new())?.spec;
        let forecast = Forecast::of(spec, machine.clone())?;
        forecast.unfit().or(())?;
        Ok((text, forecast.prediction.and_then(|prediction| prediction.verdict)))
    };
    attempt(FeedFloor::Refuse).or_else(|why: Refusals| attempt(FeedFloor::Chop).map_err(|_| why))
}

fn missed(reasons: &[String], nearest: Option<String>) -> Failure {
    let mut text = String::from("no gripper that was tried does all of this:");
    for reason in reasons {
        // A String takes everything.
        let _ = write!(text, "\n  {reason}");
    }
    if let Some(nearest) = nearest {
        let _ = write!(text, "\nwhat comes nearest: {nearest}");
    }
    Failure::Message(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_is_two_lengths() {
        assert_eq!(sheet("400x300"), Ok([Length(400.0), Length(300.0)]));
        assert_eq!(sheet("400 mm x 300 mm"), Ok([Length(400.0), Length(300.0)]));
        for bad in ["400", "400x", "x", "0x5", "nanx5", "400x300x2"] {
            assert!(sheet(bad).is_err(), "{bad}");
        }
    }
}
