//! Results of a search: candidates as a table of text and as JSON.

use std::fmt::Write;
use std::io::stdout;

use serde_json::{Value, json};

use crate::cli::terminal::width;
use forecast::interval::mm;
use forecast::optimize::{
    Constraints, Evaluation, SEARCHED, SearchResult, Shortfall, is_at_pressure, shortfalls, thinned,
};
use forecast::outcome::{Grip, Outcome};
use forecast::ranges::shown;
use spec::ModelChoice;
use spec::units::Length;

/// Number of rows of the front in the printed table.
const SHOWN: usize = 12;

/// The printed text; every line begins with "# ", so that it can precede a spec in one file.
pub(super) fn text(search: &SearchResult, constraints: &Constraints) -> String {
    let SearchResult { best, front, computed } = search;
    let mut table = format!(
        "# {computed} designs computed; the best for each number of points, the best of all first. \
         `short` lists the constraints that a design misses, and by how much; one that misses none is \
         worse in the goal.\n"
    );
    table.push_str(&rows(best, constraints));
    let model = best.first().map(|best| best.point.model);
    if matches!(model, Some(ModelChoice::Bvp | ModelChoice::Shell)) {
        table.push_str(
            "# searches compute with section, not with the model of the spec: it takes seconds a design\n",
        );
    }
    let limits_force = constraints.payload.is_some() || constraints.largest_force.is_some();
    if let Some(model) = model.filter(|_| limits_force) {
        let text = if is_at_pressure(model) {
            format!(
                "a search prefers designs that the model overestimates: so `short` uses {SEARCHED} of a payload's \
                 lower end, and a force's upper end divided by {SEARCHED}"
            )
        } else {
            "the model of the spec has no ranges: payloads and forces have no margin here, and `check` doubts them; \
             section has ranges"
                .to_owned()
        };
        // Writing to a String does not fail.
        let _ = writeln!(table, "# {text}");
    }
    if !front.is_empty() {
        let sample = rows(&thinned(front, SHOWN), constraints);
        let number = front.len();
        let title = "trade-off between contraction, stiffness and fabric";
        let _ = write!(table, "# {title}, {number} designs, evenly sampled:\n{sample}");
    }
    table
}

/// The JSON answer; `spec` is the text of the winner's spec.
pub(super) fn json(search: &SearchResult, constraints: &Constraints, spec: Option<&str>) -> Value {
    let [best, front] = [&search.best, &search.front]
        .map(|list| list.iter().map(|one| row(one, constraints)).collect::<Vec<_>>());
    json!({
        "computed": search.computed,
        "best": best,
        "front": front,
        "spec": spec,
    })
}

/// A candidate as JSON; null where a value is unknown.
fn row(candidate: &Evaluation, constraints: &Constraints) -> Value {
    // Keys and units are those of `predict --json`. A value that the model does not cover is null.
    let Evaluation { point, answer, .. } = candidate;
    let (star, outcome) = (&point.star, answer.outcome.as_ref());
    let outcome_in_range = outcome.filter(|outcome| outcome.known);
    let short: Vec<Value> = shortfalls(point, answer, constraints)
        .into_iter()
        .map(|Shortfall { constraint, part }| json!({ "what": constraint.name(), "part": part }))
        .collect();
    json!({
        "points": star.points,
        "stars": point.stars,
        "pressure_kPa": point.load.pressure.map(|pressure| pressure.0),
        "inner_radius_mm": star.inner_radius.0,
        "tip_angle_deg": star.tip_angle.0,
        "tube_width_mm": star.tube_width.0,
        "tip_radius_mm": star.tip_radius.0,
        "corner_radius_mm": star.corner_radius.0,
        "arm_length_mm": answer.star.l,
        "final_radius_mm": outcome_in_range.map(|outcome| Length::from_metres(outcome.rest.radius).0),
        "graspable_radius_mm": outcome_in_range.map(|outcome| outcome.graspable.map(|radius| Length::from_metres(radius).0)),
        "radial_stiffness_N_per_m": outcome.and_then(|outcome| outcome.stiffness),
        "object_force_N": outcome.and_then(Outcome::object_force),
        "payload_kg": answer.payload,
        "fabric_mm2": answer.fabric,
        "bendability": outcome.and(answer.case.bendability()),
        "stretch": outcome.and(answer.case.stretch()),
        "burst_margin": burst_margin(candidate),
        "ranges": {
            "final_radius_mm": outcome.and_then(|outcome| outcome.ranges.radius).map(mm),
            "radial_stiffness_N_per_m": outcome.and_then(|outcome| outcome.ranges.stiffness),
            "object_force_N": outcome.and_then(|outcome| outcome.force_range),
            "payload_kg": answer.payload_range,
        },
        "short": short,
    })
}

/// Burst pressure over pressure.
fn burst_margin(candidate: &Evaluation) -> Option<f64> {
    let Evaluation { point, answer, .. } = candidate;
    answer.burst.zip(point.load.pressure).map(|(burst, pressure)| burst.0 / pressure.0)
}

/// Columns of the table: heading, width, and the order in which they are dropped on a narrow terminal.
const COLUMNS: [(&str, usize, u8); 18] = [
    ("n", 3, 0),
    ("stars", 5, 1),
    ("p/kPa", 6, 2),
    ("rho_0/mm", 8, 5),
    ("angle/deg", 9, 4),
    ("width/mm", 8, 4),
    ("R_i/mm", 6, 9),
    ("R_e/mm", 6, 9),
    ("arm/mm", 6, 10),
    ("rho_f/mm", 20, 6),
    ("opens/mm", 8, 8),
    ("K/(N/m)", 18, 11),
    ("force/N", 20, 7),
    ("payload/kg", 20, 3),
    ("fabric/cm2", 10, 5),
    ("stretch/%", 9, 12),
    ("burst", 5, 13),
    ("short", 5, 0),
];

/// Which columns fit into `width`; all without a terminal.
fn shown_columns(width: Option<usize>) -> [bool; COLUMNS.len()] {
    let mut ranks = (0..=u8::MAX).rev();
    let fits = |most: &u8| {
        let columns = COLUMNS.iter().filter(|(_, _, rank)| rank <= most);
        width.is_none_or(|room| columns.map(|(_, width, _)| width + 2).sum::<usize>() <= room)
    };
    let last_rank = ranks.find(fits).unwrap_or(0);
    COLUMNS.map(|(_, _, rank)| rank <= last_rank)
}

/// Candidates as a table.
fn rows(candidates: &[Evaluation], constraints: &Constraints) -> String {
    let columns = shown_columns(width(&stdout()));
    let head = line(&COLUMNS.map(|(heading, _, _)| heading.to_owned()), columns);
    candidates.iter().fold(head, |table, candidate| table + &line(&cells(candidate, constraints), columns))
}

fn line(cells: &[String; COLUMNS.len()], is_shown: [bool; COLUMNS.len()]) -> String {
    let visible = cells.iter().zip(COLUMNS).zip(is_shown).filter(|(_, is_shown)| *is_shown);
    let cells = visible.map(|((cell, (_, width, _)), _)| format!("{cell:>width$}"));
    format!("# {}", cells.collect::<Vec<_>>().join("  ")).trim_end().to_owned() + "\n"
}

/// The cells of a row.
fn cells(candidate: &Evaluation, constraints: &Constraints) -> [String; COLUMNS.len()] {
    let Evaluation { point, answer, .. } = candidate;
    let (star, outcome) = (&point.star, answer.outcome.as_ref());
    let ranged = |value: Option<f64>, range| match (value, range) {
        (Some(value), Some(range)) => shown::with_range(value, range, ""),
        // A value at a pressure is not shown without its range. A limit model shows it, because the user chose the model.
        (Some(_), None) if is_at_pressure(point.model) => "unknown".to_owned(),
        (Some(value), None) => format!("{value:.3}, range unknown"),
        (None, _) => "-".to_owned(),
    };
    let untried = outcome.is_some_and(|outcome| outcome.hold == Some(Grip::Untried));
    let of_force =
        |value: Option<f64>, range| if untried { "unknown".to_owned() } else { ranged(value, range) };
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    let radius = outcome.map(|outcome| Length::from_metres(outcome.rest.radius).0);
    let short: Vec<String> = shortfalls(point, answer, constraints)
        .into_iter()
        .map(|Shortfall { constraint, part }| match 100.0 * part {
            percent if percent < 0.05 => format!("{} below 0.1 %", constraint.name()),
            percent => format!("{} {percent:.1} %", constraint.name()),
        })
        .collect();
    [
        star.points.to_string(),
        point.stars.to_string(),
        or_none(point.load.pressure.map(|p| format!("{:.1}", p.0))),
        format!("{:.2}", star.inner_radius.0),
        format!("{:.3}", star.tip_angle.0),
        format!("{:.3}", star.tube_width.0),
        format!("{:.3}", star.tip_radius.0),
        format!("{:.3}", star.corner_radius.0),
        format!("{:.2}", answer.star.l),
        ranged(radius, outcome.and_then(|outcome| outcome.ranges.radius).map(mm)),
        or_none(
            outcome
                .filter(|outcome| outcome.known)
                .map(|outcome| format!("{:.2}", 1e3 * outcome.graspable[1])),
        ),
        ranged(
            outcome.and_then(|outcome| outcome.stiffness),
            outcome.and_then(|outcome| outcome.ranges.stiffness),
        ),
        of_force(outcome.and_then(Outcome::object_force), outcome.and_then(|outcome| outcome.force_range)),
        of_force(answer.payload, answer.payload_range),
        // mm^2 to cm^2.
        or_none(answer.fabric.map(|area| format!("{:.1}", area / 100.0))),
        or_none(outcome.and(answer.case.stretch()).map(|stretch| format!("{:.1}", 100.0 * stretch))),
        or_none(burst_margin(candidate).map(|margin| format!("{margin:.2}"))),
        if short.is_empty() { "-".to_owned() } else { short.join(", ") },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_terminal_has_the_columns_that_matter_most() {
        assert!(shown_columns(None).iter().all(|shown| *shown));
        for width in [60, 80, 120, 200] {
            let visible = shown_columns(Some(width));
            let visible_columns = COLUMNS.iter().zip(visible).filter(|(_, visible)| *visible);
            let total_width: usize = visible_columns.map(|((_, width, _), _)| width + 2).sum();
            assert!(total_width <= width && visible[0] && visible[17], "{width}: {total_width}");
        }
        let has_heading = |width: usize, heading: &str| {
            let place = COLUMNS.iter().position(|(name, _, _)| *name == heading).expect("a column");
            shown_columns(Some(width))[place]
        };
        assert!(has_heading(60, "payload/kg") && !has_heading(60, "width/mm"));
        assert!(
            has_heading(80, "payload/kg") && has_heading(80, "width/mm") && !has_heading(80, "fabric/cm2")
        );
    }
}
