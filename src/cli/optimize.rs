//! `stargrip-cam optimize`

use std::fmt::Write;
use std::path::PathBuf;

use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::quantity::{EXTRA, SIZE, number, range};
use crate::cli::shell::watched;
use crate::design::Design;
use crate::forecast::by_shell::Detail;
use crate::forecast::candidate::Candidate;
use crate::forecast::optimize::{
    Bounds, Constraints, Evaluated, Found, Goal, ROUNDING, is_at_pressure, search, shortfalls, thinned,
};
use crate::forecast::outcome::Outcome;
use crate::forecast::ranges::{mm, shown};
use crate::forecast::star_by_shell;
use crate::forecast::star_by_shell::Refusal;
use crate::mechanics::hinge::ring::RingTable;
use crate::spec;
use crate::spec::edit::{StarEdit, with_star, with_value};
use crate::spec::{Allowed, Source, key};
use crate::units::{Angle, Length, Mass, Pressure};

/// Rows of the front that are shown.
const SHOWN: usize = 12;

/// Arguments of `optimize`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to start from; what is not searched stays as it says.
    spec: PathBuf,
    /// What is wanted most; default: to hold the object of `[load]` where there is one, else contraction.
    #[arg(long, value_enum)]
    goal: Option<GoalArg>,
    /// Numbers of points, "3..8" or one.
    #[arg(long, default_value = "3..12", value_parser = points)]
    points: (u32, u32),
    /// Tip angles; default: 10 to 90 deg.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Angle>(Allowed::between(0.0, 180.0)))]
    tip_angle: Option<(Angle, Angle)>,
    /// Tube widths; default: half to one and a half times the spec's.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Length>(SIZE))]
    tube_width: Option<(Length, Length)>,
    /// Tip radii; default: the spec's.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Length>(EXTRA))]
    tip_radius: Option<(Length, Length)>,
    /// Corner radii; default: the spec's.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Length>(EXTRA))]
    corner_radius: Option<(Length, Length)>,
    /// Inner radii; default: the spec's.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Length>(SIZE))]
    inner_radius: Option<(Length, Length)>,
    /// Pressures; default: the spec's.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Pressure>(PRESSURES))]
    pressure: Option<(Pressure, Pressure)>,
    /// Numbers of stars, "1..6" or one, as few as hold the mass; default: the spec's.
    #[arg(long, value_parser = counts)]
    count: Option<(u32, u32)>,
    /// Radii that it must be able to hold, inflated: close to the first, open to the second.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Length>(SIZE))]
    grasp: Option<(Length, Length)>,
    /// Payload of the stack in kg, with the pressure, object and friction of `[load]`.
    #[arg(long, value_name = "KG", value_parser = number(Allowed::above(0.0, 1e6)))]
    payload: Option<f64>,
    /// Largest radial force of one star, N; default: the `[load]`'s largest_force.
    #[arg(long, value_name = "N", value_parser = number(Allowed::above(0.0, 1e6)))]
    largest_force: Option<f64>,
    /// Least burst pressure over pressure; default: 1 where the seal's strength is known.
    #[arg(long, value_name = "RATIO", value_parser = number(Allowed::above(0.0, 1e3)))]
    burst_margin: Option<f64>,
    /// Ask the shell about the winner: seconds to minutes.
    #[arg(long)]
    confirm: bool,
}

/// Pressures that a spec may have, kPa.
const PRESSURES: Allowed = Allowed::closed(1e-3, 1e6);

#[derive(Clone, Copy, Debug, PartialEq, clap::ValueEnum)]
enum GoalArg {
    /// To hold the object's mass with the least fabric; without a mass, the most payload.
    Hold,
    /// Most contraction.
    Contraction,
    /// Most radial stiffness.
    Stiffness,
    /// Least fabric.
    Fabric,
}

fn points(text: &str) -> Result<(u32, u32), String> {
    whole(text, "points", [3, 64])
}

fn counts(text: &str) -> Result<(u32, u32), String> {
    whole(text, "stars", [1, 64])
}

/// Reads "3..8" or one number.
fn whole(text: &str, what: &str, [least, most]: [u32; 2]) -> Result<(u32, u32), String> {
    let fault = || format!("`{text}` is not a number of {what} from {least} to {most}, or a range of them");
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let (from, to): (u32, u32) = (from.parse().map_err(|_| fault())?, to.parse().map_err(|_| fault())?);
    if from >= least && to <= most && from <= to { Ok((from, to)) } else { Err(fault()) }
}

/// What a search has come to.
pub(super) struct Answered {
    /// All that was found.
    pub(super) found: Found,
    /// What must hold.
    pub(super) constraints: Constraints,
    /// The spec's text with the best that can be built, that design, and which it is; `None` if none of the best can be.
    pub(super) best: Option<(String, Design, Evaluated)>,
}

/// Searches around the spec that was `loaded`.
pub(super) fn answer(args: &Args, loaded: &Loaded) -> Result<Answered, Failure> {
    let read = &loaded.reading.spec;
    let base = Candidate::of(read).ok_or_else(|| message("the spec has no star"))?;
    // Whether the text can take a star is known before the search.
    if let Some(star) = read.stars.first() {
        let _ = with_star(&loaded.source, &StarEdit::of(star))?;
    }
    let (goal, constraints) = wanted(args, loaded, &base)?;
    let table = RingTable::new().map_err(|fault| message(&fault.to_string()))?;
    let found = search(&base, &bounds(args, &base), &constraints, goal, &table);
    // Other values in the spec may forbid a star: four points have no inlet at tip 5.
    let best = found.best.iter().filter(|candidate| candidate.violation == 0.0).find_map(|candidate| {
        let text = edited(loaded, candidate).ok()?;
        let design = buildable(loaded, &text)?;
        Some((text, design, candidate.clone()))
    });
    Ok(Answered { found, constraints, best })
}

/// Searches, and prints the candidates, the front, and the best one's spec.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let Answered { found, constraints, best } = answer(args, &Loaded::new(&args.spec)?)?;
    let mut out = String::new();
    let _ = writeln!(out, "# {} designs computed; the best for each number of points:", found.computed);
    out.push_str(&rows(&found.best, &constraints));
    if found.front.is_empty() {
        return Err(message(&format!(
            "{out}# no design meets all constraints; 'short' says by how much each misses which"
        )));
    }
    let _ = writeln!(
        out,
        "# trade-off between contraction, stiffness and fabric, {} designs, every so many shown:",
        found.front.len()
    );
    out.push_str(&rows(&thinned(&found.front, SHOWN), &constraints));
    let Some((text, design, candidate)) = best else {
        return Err(message(&format!(
            "{out}# none of the best designs can be sealed and cut as the spec asks for"
        )));
    };
    if args.confirm {
        out.push_str(&confirmed(&text, &design, &candidate)?);
    }
    let _ = writeln!(out, "# the best that can be built:\n{text}");
    say(&out)
}

fn message(text: &str) -> Failure {
    Failure::Message(text.to_owned())
}

/// What is wanted most, and what must hold.
fn wanted(args: &Args, loaded: &Loaded, base: &Candidate) -> Result<(Goal, Constraints), Failure> {
    let load = &base.load;
    let pressed = load.pressure.is_some() || args.pressure.is_some();
    if !pressed && is_at_pressure(base.model) {
        return Err(message(
            "what a star does depends on the pressure: give [load] one, or --pressure FROM..TO",
        ));
    }
    let holds = pressed && load.object_radius.is_some() && load.friction.is_some();
    let asked = args.goal.unwrap_or(if holds { GoalArg::Hold } else { GoalArg::Contraction });
    let mass = args.payload.or(load.mass.filter(|_| holds).map(|Mass(mass)| mass));
    let goal = match asked {
        GoalArg::Hold if mass.is_some() => Goal::Fabric,
        GoalArg::Hold => Goal::Payload,
        GoalArg::Contraction => Goal::Contraction,
        GoalArg::Stiffness => Goal::Stiffness,
        GoalArg::Fabric => Goal::Fabric,
    };
    if goal == Goal::Stiffness && !pressed {
        return Err(message("stiffness needs a pressure: give [load] one"));
    }
    if (args.payload.is_some() || asked == GoalArg::Hold) && !holds {
        return Err(message("payload needs [load] with pressure, object_radius and friction"));
    }
    let strong = pressed && base.fabric.seal_strength.is_some();
    if args.burst_margin.is_some() && !strong {
        return Err(message("a burst margin needs [load] pressure and [fabric] seal_strength"));
    }
    let margin = args.burst_margin.or((strong && is_at_pressure(base.model)).then_some(1.0));
    let sheet = &loaded.reading.spec.sheet;
    let side = [sheet.width, sheet.height].into_iter().flatten().map(|side| side.0).reduce(f64::min);
    let constraints = Constraints {
        grasp: args.grasp.map(|(from, to)| [Length(from.0 * (1.0 - ROUNDING)), to]),
        payload: mass.map(|mass| mass * (1.0 + ROUNDING)),
        largest_force: args
            .largest_force
            .or(load.largest_force.map(|force| force.0))
            .map(|most| most * (1.0 - ROUNDING)),
        sheet: side.map(|side| Length(side - 2.0 * sheet.margin.0)),
        burst_margin: margin.map(|margin| margin * (1.0 + ROUNDING)),
    };
    Ok((goal, constraints))
}

fn bounds(args: &Args, base: &Candidate) -> Bounds {
    let star = &base.star;
    let lengths = |range: Option<(Length, Length)>, default: [Length; 2]| range.map_or(default, Into::into);
    let width = star.tube_width.0;
    let (from, to) = args.count.unwrap_or((base.stars, base.stars));
    Bounds {
        points: args.points.0..=args.points.1,
        tip_angle: args.tip_angle.unwrap_or((Angle(10.0), Angle(90.0))).into(),
        width: lengths(args.tube_width, [Length(0.5 * width), Length(1.5 * width)]),
        tip_radius: lengths(args.tip_radius, [star.tip_radius; 2]),
        corner_radius: lengths(args.corner_radius, [star.corner_radius; 2]),
        inner_radius: lengths(args.inner_radius, [star.inner_radius; 2]),
        pressure: args.pressure.map(Into::into),
        stars: from..=to,
    }
}

/// Candidates as a table; every line begins with "# ", so that the whole output is a spec.
fn rows(candidates: &[Evaluated], constraints: &Constraints) -> String {
    let mut out = String::from(
        "#   n  stars  p/kPa   rho_0/mm  angle/deg  width/mm  R_i/mm  R_e/mm  arm/mm  rho_f/mm              opens/mm  K/(N/m)  \
         force/N               payload/kg            fabric/cm2  short\n",
    );
    for Evaluated { point, answer, .. } in candidates {
        let (star, own) = (&point.star, answer.outcome.as_ref());
        let ranged = |value: Option<f64>, range| match (value, range) {
            (Some(value), Some(range)) => shown::with(value, range, ""),
            (Some(value), None) => format!("{value:.3}, range unknown"),
            (None, _) => "-".to_owned(),
        };
        let radius = own.map(|own| Length::from_metres(own.rest.radius).0);
        let short: Vec<String> = shortfalls(point, answer, constraints)
            .into_iter()
            .map(|(what, part)| format!("{what} {:.1} %", 100.0 * part))
            .collect();
        let _ = writeln!(
            out,
            "# {:3}  {:5}  {:>6}  {:8.2}  {:9.3}  {:8.3}  {:6.3}  {:6.3}  {:6.2}  {:20}  {:>8}  {:>7}  {:20}  {:20}  {:>10}  {}",
            star.points,
            point.stars,
            point.load.pressure.map_or("-".to_owned(), |p| format!("{:.1}", p.0)),
            star.inner_radius.0,
            star.tip_angle.0,
            star.tube_width.0,
            star.tip_radius.0,
            star.corner_radius.0,
            answer.star.l,
            ranged(radius, own.and_then(|own| own.ranges.radius).map(mm)),
            own.map_or("-".to_owned(), |own| format!("{:.2}", 1e3 * own.graspable[1])),
            own.and_then(|own| own.stiffness).map_or("-".to_owned(), |k| format!("{k:.0}")),
            ranged(own.and_then(Outcome::object_force), own.and_then(|own| own.force_range)),
            ranged(answer.payload, answer.payload_range),
            // mm^2 to cm^2.
            answer.fabric.map_or("-".to_owned(), |area| format!("{:.1}", area / 100.0)),
            if short.is_empty() { "-".to_owned() } else { short.join(", ") },
        );
    }
    out
}

/// The spec's text with the candidate's values, rounded to a micrometre, a thousandth of a degree and a Pascal.
fn edited(loaded: &Loaded, candidate: &Evaluated) -> Result<String, Failure> {
    let Evaluated { point, .. } = candidate;
    let star = &point.star;
    let thousandths = |value: f64| (value * 1e3).round() / 1e3;
    let mm = |length: Length| Length(thousandths(length.0));
    let edit = StarEdit {
        points: star.points,
        tube_width: mm(star.tube_width),
        tip_angle: Angle(thousandths(star.tip_angle.0)),
        tip_radius: mm(star.tip_radius),
        corner_radius: mm(star.corner_radius),
    };
    let mut text = with_star(&loaded.source, &edit)?;
    let before = Candidate::of(&loaded.reading.spec);
    let was = |of: fn(&Candidate) -> Option<f64>| before.as_ref().and_then(of);
    let changes = [
        (key::star::INNER_RADIUS, was(|c| Some(c.star.inner_radius.0)), Some(star.inner_radius.0), "mm"),
        (key::stack::COUNT, was(|c| Some(f64::from(c.stars))), Some(f64::from(point.stars)), ""),
        (key::stack::PITCH, was(|c| Some(c.star.pitch.0)), Some(star.pitch.0), "mm"),
        (key::load::PRESSURE, was(|c| Some(c.load.pressure?.0)), point.load.pressure.map(|p| p.0), "kPa"),
    ];
    for (key, was, is, unit) in changes {
        let Some(is) = is.filter(|_| was != is) else { continue };
        let value = if unit.is_empty() { format!("{is}") } else { format!("\"{} {unit}\"", thousandths(is)) };
        text = with_value(&Source::new("optimised", text), key, &value)?;
    }
    Ok(text)
}

/// The design, if the design stage accepts it.
fn buildable(loaded: &Loaded, text: &str) -> Option<Design> {
    let reading = spec::read(&Source::new("optimised", text)).ok()?;
    Design::new(&reading.spec, &loaded.machine).ok()
}

/// What the shell says of the winner, as comments.
fn confirmed(text: &str, design: &Design, candidate: &Evaluated) -> Result<String, Failure> {
    let spec = spec::read(&Source::new("optimised", text))?.spec;
    let (found, _) = watched(|watch| {
        star_by_shell::predict((&spec, design), &[], Detail::Medium, watch).map_err(|refusal| match refusal {
            Refusal::Cancelled => Failure::Interrupted,
            Refusal::Fault(fault) => {
                message(&format!("the shell refuses the best design, which --confirm asks for: {fault}"))
            }
        })
    })?;
    let star = &found.first;
    let radius = candidate.answer.outcome.map_or(f64::NAN, |own| 1e3 * own.rest.radius);
    let force =
        |force: Option<f64>| force.map_or(String::new(), |force| format!(", {force:.2} N on the object"));
    Ok(format!(
        "# confirmed by the shell: it closes to {:.2} mm (predicted {radius:.2}){}\n",
        star.final_radius_mm,
        force(star.object_force_N)
    ))
}
