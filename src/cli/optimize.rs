//! `stargrip-cam optimize`

use std::fmt::Write;
use std::path::PathBuf;

use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::quantity::{EXTRA, SIZE, number, range};
use crate::design::Design;
use crate::forecast::candidate::Candidate;
use crate::forecast::optimize::{Bounds, Constraints, Evaluated, Goal, ROUNDING, search, thinned};
use crate::mechanics::hinge::ring::RingTable;
use crate::spec;
use crate::spec::edit::{StarEdit, with_star};
use crate::spec::{Allowed, Source};
use crate::units::{Angle, Length};

/// Rows of the front that are shown.
const SHOWN: usize = 12;

/// Arguments of `optimize`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to start from; what is not searched stays as it says.
    spec: PathBuf,
    /// What is wanted most.
    #[arg(long, value_enum, default_value = "contraction")]
    goal: GoalArg,
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
    /// Radii that it must be able to hold: close to the first, open to the second.
    #[arg(long, value_name = "FROM..TO", value_parser = range::<Length>(SIZE))]
    grasp: Option<(Length, Length)>,
    /// Payload of the stack in kg, with the pressure, object and friction of `[load]`.
    #[arg(long, value_name = "KG", value_parser = number(Allowed::above(0.0, 1e6)))]
    payload: Option<f64>,
    /// Least burst pressure over pressure.
    #[arg(long, value_name = "RATIO", value_parser = number(Allowed::above(0.0, 1e3)))]
    burst_margin: Option<f64>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum GoalArg {
    /// Most contraction.
    Contraction,
    /// Most radial stiffness.
    Stiffness,
    /// Least fabric.
    Fabric,
}

fn points(text: &str) -> Result<(u32, u32), String> {
    let fault = || format!("`{text}` is not a number of points from 3 to 64, or a range of them");
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let (from, to): (u32, u32) = (from.parse().map_err(|_| fault())?, to.parse().map_err(|_| fault())?);
    if from >= 3 && to <= 64 && from <= to { Ok((from, to)) } else { Err(fault()) }
}

/// Searches, and prints the candidates, the front, and the best one's spec.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let message = |text: &str| Failure::Message(text.to_owned());
    let loaded = Loaded::new(&args.spec)?;
    let read = &loaded.reading.spec;
    let base = Candidate::of(read).ok_or_else(|| message("the spec has no star"))?;
    // Whether the text can take a star is known before the search.
    if let Some(star) = read.stars.first() {
        let _ = with_star(&loaded.source, &StarEdit::of(star))?;
    }
    let goal = match args.goal {
        GoalArg::Contraction => Goal::Contraction,
        GoalArg::Stiffness => Goal::Stiffness,
        GoalArg::Fabric => Goal::Fabric,
    };
    if goal == Goal::Stiffness && base.load.pressure.is_none() {
        return Err(message("stiffness needs a pressure: give [load] one"));
    }
    let load = &base.load;
    let holds = load.pressure.is_some() && load.object_radius.is_some() && load.friction.is_some();
    if args.payload.is_some() && !holds {
        return Err(message("payload needs [load] with pressure, object_radius and friction"));
    }
    if args.burst_margin.is_some() && (load.pressure.is_none() || base.fabric.seal_strength.is_none()) {
        return Err(message("a burst margin needs [load] pressure and [fabric] seal_strength"));
    }
    let sheet = &read.sheet;
    let side = [sheet.width, sheet.height].into_iter().flatten().map(|side| side.0).reduce(f64::min);
    let constraints = Constraints {
        grasp: args.grasp.map(|(from, to)| [Length(from.0 * (1.0 - ROUNDING)), to]),
        payload: args.payload.map(|mass| mass * (1.0 + ROUNDING)),
        sheet: side.map(|side| Length(side - 2.0 * sheet.margin.0)),
        burst_margin: args.burst_margin.map(|margin| margin * (1.0 + ROUNDING)),
    };
    let table = RingTable::new().map_err(|fault| message(&fault.to_string()))?;
    let found = search(&base, &bounds(args, &base), &constraints, goal, &table);
    let mut out = String::new();
    let _ = writeln!(out, "# {} designs computed; the best for each number of points:", found.computed);
    out.push_str(&rows(&found.best));
    if found.front.is_empty() {
        return Err(message(&format!(
            "{out}# no design meets all constraints; 'short' says by how much each misses them"
        )));
    }
    let _ = writeln!(
        out,
        "# trade-off between contraction, stiffness and fabric, {} designs, every so many shown:",
        found.front.len()
    );
    out.push_str(&rows(&thinned(&found.front, SHOWN)));
    let met = found.best.iter().filter(|candidate| candidate.violation == 0.0);
    for candidate in met {
        // Other values in the spec may forbid this star: four points have no inlet at tip 5.
        let Ok(text) = with_star(&loaded.source, &rounded(candidate)) else { continue };
        if buildable(&loaded, &text) {
            let _ = writeln!(out, "# the best that can be built:\n{text}");
            return say(&out);
        }
    }
    Err(message(&format!("{out}# none of the best designs can be sealed and cut as the spec asks for")))
}

fn bounds(args: &Args, base: &Candidate) -> Bounds {
    let star = &base.star;
    let lengths = |range: Option<(Length, Length)>, default: [Length; 2]| range.map_or(default, Into::into);
    let width = star.tube_width.0;
    Bounds {
        points: args.points.0..=args.points.1,
        tip_angle: args.tip_angle.unwrap_or((Angle(10.0), Angle(90.0))).into(),
        width: lengths(args.tube_width, [Length(0.5 * width), Length(1.5 * width)]),
        tip_radius: lengths(args.tip_radius, [star.tip_radius; 2]),
        corner_radius: lengths(args.corner_radius, [star.corner_radius; 2]),
    }
}

/// Candidates as a table; every line begins with "# ", so that the whole output is a spec.
fn rows(candidates: &[Evaluated]) -> String {
    let mut out = String::from(
        "#   n  angle/deg  width/mm  R_i/mm  R_e/mm  arm/mm  rho_f/mm  contraction  K/(N/m)  payload/kg  fabric/cm2  short\n",
    );
    for Evaluated { point, answer, violation } in candidates {
        let (star, outcome) = (&point.star, &answer.outcome);
        let optional = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.3}"));
        let _ = writeln!(
            out,
            "# {:3}  {:9.3}  {:8.3}  {:6.3}  {:6.3}  {:6.2}  {:8.3}  {:9.2} %  {:>7}  {:>10}  {:>10}  {}",
            star.points,
            star.tip_angle.0,
            star.tube_width.0,
            star.tip_radius.0,
            star.corner_radius.0,
            answer.star.l,
            Length::from_metres(outcome.rest.radius).0,
            100.0 * outcome.contraction,
            outcome.stiffness.map_or("-".to_owned(), |k| format!("{k:.0}")),
            optional(answer.payload),
            // mm^2 to cm^2.
            answer.fabric.map_or("-".to_owned(), |area| format!("{:.1}", area / 100.0)),
            if *violation > 0.0 { format!("{:.1} %", 100.0 * violation) } else { "-".to_owned() },
        );
    }
    out
}

/// The candidate's star, rounded to a micrometre and a thousandth of a degree.
fn rounded(candidate: &Evaluated) -> StarEdit {
    let star = &candidate.point.star;
    let thousandths = |value: f64| (value * 1e3).round() / 1e3;
    let mm = |length: Length| Length(thousandths(length.0));
    StarEdit {
        points: star.points,
        tube_width: mm(star.tube_width),
        tip_angle: Angle(thousandths(star.tip_angle.0)),
        tip_radius: mm(star.tip_radius),
        corner_radius: mm(star.corner_radius),
    }
}

/// Whether the design stage accepts it.
fn buildable(loaded: &Loaded, text: &str) -> bool {
    spec::read(&Source::new("optimised", text))
        .is_ok_and(|reading| Design::new(&reading.spec, &loaded.machine).is_ok())
}
