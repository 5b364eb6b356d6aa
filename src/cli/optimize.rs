//! `stargrip-cam optimize`

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use crate::answer::quantity::{EXTRA, SIZE, number, quantity_or_number, range};
use crate::cli::failure::{Failure, say, tell};
use crate::cli::load::Loaded;
use crate::cli::verbosity::{Verbosity, pretty};
use crate::cli::{candidates, progress};
use design::{Design, room};
use forecast::candidate::Candidate;
use forecast::optimize::{
    Constraints, DesignSearch, Evaluation, Goal, ROUNDING, SearchBounds, SearchResult, is_at_pressure,
    thousandths,
};
use forecast::sizing::{BURST_MARGIN, is_result};
use inflatable::mechanics::hinge::ring::RingTable;
use spec::edit::{StarEdit, with_comments, with_star, with_value};
use spec::units::{Angle, Force, Length, Mass, Pressure};
use spec::{Allowed, Setting, Source, key, settings};

/// Arguments of `optimize`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to start from; the values that are not searched stay unchanged.
    spec: PathBuf,
    /// Goal of the search; default: to hold the object of `[load]` if there is one, else contraction.
    #[arg(long, value_enum)]
    goal: Option<GoalArg>,
    /// Numbers of points, "3..8" or one.
    #[arg(long, default_value = "3..12", value_parser = |text: &str| whole_range(text, "points", [3, 64]))]
    points: (u32, u32),
    /// Tip angles; default: 10 to 90 deg.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Angle>(Allowed::open(0.0, 180.0)))]
    tip_angle: Option<(Angle, Angle)>,
    /// Tube widths; default: half to one and a half times the spec's.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Length>(SIZE))]
    tube_width: Option<(Length, Length)>,
    /// Tip radii; default: the spec's.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Length>(EXTRA))]
    tip_radius: Option<(Length, Length)>,
    /// Corner radii; default: the spec's.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Length>(EXTRA))]
    corner_radius: Option<(Length, Length)>,
    /// Inner radii; default: the spec's.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Length>(SIZE))]
    inner_radius: Option<(Length, Length)>,
    /// Pressures; default: the spec's.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Pressure>(PRESSURES))]
    pressure: Option<(Pressure, Pressure)>,
    /// Numbers of stars, "1..6" or one, as few as hold the mass; default: the spec's.
    #[arg(long, value_parser = |text: &str| whole_range(text, "stars", [1, 64]))]
    count: Option<(u32, u32)>,
    /// Radii that it must be able to hold, inflated: close to the first, open to the second.
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true, value_parser = range::<Length>(SIZE))]
    grasp: Option<(Length, Length)>,
    /// Payload of the stack, such as "1.2 kg", with the pressure, object and friction of `[load]`.
    #[arg(long, value_name = "MASS", allow_hyphen_values = true, value_parser = quantity_or_number::<Mass>(Allowed::half_open(0.0, 1e6)))]
    payload: Option<f64>,
    /// Largest radial force of one star, such as "20 N"; default: the `[load]`'s largest_force.
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true, value_parser = quantity_or_number::<Force>(Allowed::half_open(0.0, 1e6)))]
    largest_force: Option<f64>,
    /// Least burst pressure over pressure; default: 1.5 if the seal's strength is given, as for `new`.
    #[arg(long, value_name = "RATIO", allow_hyphen_values = true, value_parser = number(Allowed::half_open(0.0, 1e3)))]
    burst_margin: Option<f64>,
    #[command(flatten)]
    verbosity: Verbosity,
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

/// Reads "3..8" or one number.
fn whole_range(text: &str, quantity: &str, [minimum, maximum]: [u32; 2]) -> Result<(u32, u32), String> {
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let ends = from.parse().ok().zip(to.parse().ok());
    ends.filter(|(from, to)| *from >= minimum && *to <= maximum && from <= to).ok_or_else(|| {
        format!("`{text}` is not a number of {quantity} from {minimum} to {maximum}, or a range of them")
    })
}

/// The result of a search around the spec `loaded`, and its constraints. Raising `cancel` ends the search.
pub(super) fn answer(
    args: &Args,
    loaded: &Loaded,
    cancel: Option<&AtomicBool>,
) -> Result<(SearchResult, Constraints), Failure> {
    let read = &loaded.reading.spec;
    let base = Candidate::from_spec(read).ok_or_else(|| Failure::message("the spec has no star"))?;
    // A text that cannot take a star is refused before the search.
    if let Some(star) = read.stars.first() {
        let _ = with_star(&loaded.source, &StarEdit::new(star))?;
    }
    let (goal, constraints) = search_goal(args, loaded, &base)?;
    let table = RingTable::new().map_err(Failure::message)?;
    let search_bounds = bounds(args, &base);
    let search =
        DesignSearch { cancel, ..DesignSearch::new(&base, &search_bounds, &constraints, goal, &table) };
    Ok((progress::with_line(args.verbosity, "searching", |_| search.run()), constraints))
}

/// Searches, and prints the candidates, the front, and the best candidate's spec.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::read_spec(&args.spec, args.verbosity)?.with_stars("optimize")?;
    let (search, constraints) = answer(args, &loaded, None)?;
    let Some(spec) = best_spec(args, &loaded, &search) else {
        if args.verbosity.is_heard() {
            tell(&candidates::text(&search, &constraints));
        }
        let reason = if search.front.is_empty() {
            "no design meets all constraints; `short` lists those that each misses, and by how much"
        } else {
            "none of the best designs can be sealed and cut as the spec requires"
        };
        return Err(if args.verbosity.json {
            Failure::answered(candidates::json(&search, &constraints, None), reason)
        } else {
            Failure::message(reason)
        });
    };
    if args.verbosity.json {
        return say(&pretty(&candidates::json(&search, &constraints, Some(&spec))));
    }
    if args.verbosity.quiet {
        return say(&spec);
    }
    let table = candidates::text(&search, &constraints);
    say(&format!("{table}# the best that can be built:\n{spec}\n"))
}

/// The spec of the best candidate that meets all constraints and can be built; `None` if there is none.
pub(super) fn best_spec(args: &Args, loaded: &Loaded, result: &SearchResult) -> Option<String> {
    if result.front.is_empty() {
        return None;
    }
    let feasible = result.best.iter().filter(|candidate| candidate.violation == 0.0);
    // Other values in the spec may forbid a star: four points have no inlet at tip 5.
    let mut specs = feasible.filter_map(|candidate| edited(args, loaded, candidate).ok());
    specs.find(|spec| {
        let reading = spec::read(&Source::new("optimised", spec.as_str()));
        reading.is_ok_and(|reading| Design::new(&reading.spec, &loaded.machine).is_ok())
    })
}

/// The goal of the search and its constraints.
fn search_goal(args: &Args, loaded: &Loaded, base: &Candidate) -> Result<(Goal, Constraints), Failure> {
    let load = &base.load;
    let pressed = load.pressure.is_some() || args.pressure.is_some();
    if !pressed && is_at_pressure(base.model) {
        return Err(Failure::message(
            "the result depends on the pressure: set `pressure` in [load], or give --pressure FROM..TO",
        ));
    }
    let has_object = pressed && load.object_radius.is_some() && load.friction.is_some();
    let goal_word = args.goal.unwrap_or(if has_object { GoalArg::Hold } else { GoalArg::Contraction });
    let mass = args.payload.or(load.mass.filter(|_| has_object).map(|Mass(mass)| mass));
    let goal = match goal_word {
        GoalArg::Hold if mass.is_some() => Goal::Fabric,
        GoalArg::Hold => Goal::Payload,
        GoalArg::Contraction => Goal::Contraction,
        GoalArg::Stiffness => Goal::Stiffness,
        GoalArg::Fabric => Goal::Fabric,
    };
    if goal == Goal::Stiffness && !pressed {
        return Err(Failure::message("stiffness needs a pressure: set `pressure` in [load]"));
    }
    if (args.payload.is_some() || goal_word == GoalArg::Hold) && !has_object {
        return Err(Failure::message("payload needs [load] with pressure, object_diameter and friction"));
    }
    let strong = pressed && base.fabric.seal_strength.is_some();
    if args.burst_margin.is_some() && !strong {
        return Err(Failure::message("a burst margin needs [load] pressure and [fabric] seal_strength"));
    }
    let margin = args.burst_margin.or((strong && is_at_pressure(base.model)).then_some(BURST_MARGIN));
    let sheet = &loaded.reading.spec.sheet;
    let side = [sheet.width, sheet.height].into_iter().flatten().map(|side| side.0).reduce(f64::min);
    let constraints = Constraints {
        grasp: args.grasp.map(|(from, to)| [Length(from.0 * (1.0 - ROUNDING)), to]),
        // A variable hole must leave room for the object.
        hole: load
            .object_radius
            .filter(|_| args.inner_radius.is_some())
            .map(|own| Length(own.0 + room(own).0)),
        payload: mass.map(|mass| mass * (1.0 + ROUNDING)),
        largest_force: args
            .largest_force
            .or(load.largest_force.map(|force| force.0))
            .map(|most| most * (1.0 - ROUNDING)),
        sheet: side.map(|side| Length(side - 2.0 * sheet.margin.0)),
        burst_margin: margin.map(|margin| margin * (1.0 + ROUNDING)),
        apart: matches!(goal, Goal::Stiffness | Goal::Payload),
    };
    Ok((goal, constraints))
}

fn bounds(args: &Args, base: &Candidate) -> SearchBounds {
    let star = &base.star;
    let width = star.tube_width.0;
    let (from, to) = args.count.unwrap_or((base.stars, base.stars));
    SearchBounds {
        points: args.points.0..=args.points.1,
        tip_angle: args.tip_angle.unwrap_or((Angle(10.0), Angle(90.0))).into(),
        width: args.tube_width.map_or([Length(0.5 * width), Length(1.5 * width)], Into::into),
        tip_radius: args.tip_radius.map_or([star.tip_radius; 2], Into::into),
        corner_radius: args.corner_radius.map_or([star.corner_radius; 2], Into::into),
        inner_radius: args.inner_radius.map_or([star.inner_radius; 2], Into::into),
        pressure: args.pressure.map(Into::into),
        stars: from..=to,
    }
}

/// The spec's text with the candidate's values, and those of `[load]` that it was searched for.
fn edited(args: &Args, loaded: &Loaded, candidate: &Evaluation) -> Result<String, Failure> {
    let Evaluation { point, .. } = candidate;
    let star = &point.star;
    let [tube_width, tip_radius, corner_radius] =
        [star.tube_width, star.tip_radius, star.corner_radius].map(|length| Length(thousandths(length.0)));
    let edit = StarEdit {
        points: star.points,
        tube_width,
        tip_angle: Angle(thousandths(star.tip_angle.0)),
        tip_radius,
        corner_radius,
    };
    let mut text = with_star(&loaded.source, &edit)?;
    let old_candidate = Candidate::from_spec(&loaded.reading.spec);
    let old_value = |of: fn(&Candidate) -> Option<f64>| old_candidate.as_ref().and_then(of);
    // A force on no object is no load.
    let force = args.largest_force.filter(|_| point.load.object_radius.is_some());
    let changes = [
        (
            key::star::INNER_RADIUS,
            old_value(|c| Some(c.star.inner_radius.0)),
            Some(thousandths(star.inner_radius.0)),
            "mm",
        ),
        (key::stack::COUNT, old_value(|c| Some(f64::from(c.stars))), Some(f64::from(point.stars)), ""),
        (key::stack::PITCH, old_value(|c| Some(c.star.pitch.0)), Some(thousandths(star.pitch.0)), "mm"),
        (
            key::load::PRESSURE,
            old_value(|c| Some(c.load.pressure?.0)),
            point.load.pressure.map(|p| thousandths(p.0)),
            "kPa",
        ),
        (key::load::MASS, old_value(|c| Some(c.load.mass?.0)), args.payload, "kg"),
        (key::load::LARGEST_FORCE, old_value(|c| Some(c.load.largest_force?.0)), force, "N"),
    ];
    for (key, old_value, is, unit) in changes {
        let Some(is) = is.filter(|_| old_value != is) else { continue };
        let value = if unit.is_empty() { format!("{is}") } else { format!("\"{is} {unit}\"") };
        text = with_value(&Source::new("optimised", text), key, &value)?;
    }
    recommented(loaded, &text)
}

/// `text`, the edited spec `loaded`, in which a changed value names its old one behind the user's comment. Comments that `new` had computed
/// are removed, because they depend on all values.
fn recommented(loaded: &Loaded, text: &str) -> Result<String, Failure> {
    let edited = Source::new("optimised", text);
    let (before, after) = (settings(&loaded.source), settings(&edited));
    let previous_value = |section: &str, key: &str| {
        let value_in = |all: &[Setting]| {
            all.iter().find(|one| one.section == section && one.key == key).and_then(|one| one.value.clone())
        };
        value_in(&before).filter(|previous_value| value_in(&after).is_some_and(|is| is != *previous_value))
    };
    if before == after {
        return Ok(text.to_owned());
    }
    let text = with_comments(&edited, |section, key, comment| {
        let kept_comment = if is_result(comment) { "" } else { comment };
        let Some(old) = previous_value(section, key) else { return kept_comment.to_owned() };
        // The value before the last search is outdated.
        let kept_comment =
            kept_comment.rsplit_once("; was ").map_or(kept_comment, |(kept_comment, _)| kept_comment);
        if kept_comment.is_empty() || kept_comment.starts_with("was ") {
            format!("was {old}")
        } else {
            format!("{kept_comment}; was {old}")
        }
    })?;
    let lines = text.lines().filter(|line| !line.strip_prefix("# ").is_some_and(is_result));
    Ok(lines.flat_map(|line| [line, "\n"]).collect())
}
