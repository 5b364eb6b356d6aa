//! Predictions of a star at several pressures: the answer to a spec without a pressure.

use crate::case::Case;
use crate::interval::{Interval, mm};
use crate::model_selection::tabled;
use crate::outcome::Outcome;
use crate::ranges::Domain;
use inflatable::mechanics::fault::{HingeFault, StarFault};
use inflatable::mechanics::hinge::section::{BENDABILITY, MOST_STRETCH};
use inflatable::mechanics::strength::ElasticSheet;
use inflatable::numerics::last_holding;
use serde::Serialize;
use spec::units::{Least, Length, Most, Pressure};

/// One pressure, with the star's values there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct PressureRow {
    /// Gauge pressure.
    pub pressure_kPa: f64,
    /// Final inner radius.
    pub final_radius_mm: f64,
    /// Range of the final radius; `None` if unknown.
    pub radius_range_mm: Option<Interval>,
    /// Radial force on the object; needs object_radius.
    pub object_force_N: Option<f64>,
    /// Range of the force; `None` if unknown.
    pub force_range_N: Option<Interval>,
    /// Stretch p W / Y of the fabric.
    pub stretch: f64,
    /// Burst pressure over this one; needs the strength of the seam.
    pub burst_margin: Option<f64>,
    /// Whether stars around it were computed as shells; otherwise ranges are four times as wide.
    pub tried: bool,
    /// Whether it is the best of those at which no seal may burst: the largest lower end of the object's force, or without an object the least
    /// radius.
    pub best: bool,
}

/// Steps within a decade.
const STEPS: [f64; 8] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0];
/// Least pressure that is shown, kPa.
pub const LEAST: f64 = 1.0;
/// Largest, kPa.
pub const MOST: f64 = 100.0;

/// The pressures at which `section` and its arms cover the star of `case`, which bursts at `burst` and surely holds `safe_pressure` (Pa), if
/// these are known.
pub fn rows(case: &Case, burst: Option<f64>, safe_pressure: Option<f64>) -> Vec<PressureRow> {
    let decades = [LEAST, 10.0 * LEAST, MOST];
    let steps = decades.iter().flat_map(|decade| STEPS.iter().map(move |step| decade * step));
    let mut rows: Vec<PressureRow> =
        steps.filter(|kpa| *kpa <= MOST).filter_map(|kpa| row(case, burst, kpa).ok().flatten()).collect();
    // The first of equals: less pressure does the same.
    let has_object = case.object.is_some();
    let any_tried = rows.iter().any(|row| row.tried);
    // Of equals `max_by` takes the last, which is the first of the reversed.
    let best = (0..rows.len())
        .rev()
        .filter(|i| rows[*i].is_safe(safe_pressure) && (rows[*i].tried || !any_tried))
        .max_by(|a, b| merit(&rows[*a], has_object).total_cmp(&merit(&rows[*b], has_object)));
    if let Some(best) = best.filter(|best| !has_object || merit(&rows[*best], has_object) > 0.0) {
        rows[best].best = true;
    }
    rows
}

/// The finding that nothing of this width and fabric is computed by `model` at `pressure`, Pa, and the remedy: the pressures, Pa, at which
/// it is.
pub fn pressure_finding(model: &str, pressure: f64, [lowest, highest]: Interval) -> (String, String) {
    let finding =
        format!("{model} covers no tube of this width and fabric at {}", Pressure::from_pascals(pressure));
    (finding, pressures([lowest, highest].map(|pascals| Pressure::from_pascals(pascals).0)))
}

/// The remedy that names pressures, kPa.
pub(super) fn pressures([lowest, highest]: Interval) -> String {
    format!("a pressure from {} to {} kPa", Least(lowest), Most(highest))
}

/// [`pressure_finding`], if the `fault` of `section` with hinges of `sheet` in a tube `width` m wide is due to the `pressure`, Pa.
pub fn outside_section(
    fault: &StarFault,
    sheet: &ElasticSheet,
    width: f64,
    pressure: f64,
) -> Option<(String, String)> {
    let StarFault::Hinge(HingeFault::Scale { .. }) = fault else { return None };
    // Both are in proportion to the pressure.
    let [bendability, stretch] = [sheet.bendability(1.0, width), sheet.stretch(1.0, width)];
    let highest = (BENDABILITY.end() / bendability).min(MOST_STRETCH / stretch);
    let lowest = BENDABILITY.start() / bendability;
    let is_due = lowest < highest && !(lowest..=highest).contains(&pressure);
    is_due.then(|| pressure_finding("section", pressure, [lowest, highest]))
}

/// Pressures that a spec may have, kPa: 1 Pa to 1 GPa.
const ALL: [f64; 2] = [1e-3, 1e6];
/// Number of pressures of [`ALL`] to evaluate, evenly spaced in their logarithm: twenty a decade.
const TRIED: u32 = 181;

impl PressureRow {
    /// Whether the star surely holds this pressure, where the largest that it holds is `safe_pressure`, Pa, if that is known.
    fn is_safe(&self, safe_pressure: Option<f64>) -> bool {
        safe_pressure.is_none_or(|safe| Pressure(self.pressure_kPa).pascals() <= safe)
    }
}

/// Whether the star of `case` has a prediction at `pressure`, Pa.
pub(super) fn is_modelled(case: &Case, pressure: f64) -> bool {
    let outcome = tabled(case, pressure)
        .and_then(|model| Outcome::by_model(&Case { pressure: Some(pressure), ..*case }, &model));
    outcome.is_ok_and(|(_, outcome)| outcome.known)
}

/// The lowest and the highest pressure, kPa, at which the star of `case` has a prediction, rounded inwards to three digits; `None`
/// if there is none.
pub fn modelled(case: &Case) -> Option<Interval> {
    let is_known = |kpa: f64| is_modelled(case, Pressure(kpa).pascals());
    let modelled: Vec<u32> =
        (0..TRIED).filter(|k| is_modelled(case, Pressure(tried_pressure(*k)).pascals())).collect();
    let (first, last) = (*modelled.first()?, *modelled.last()?);
    // From a pressure with a prediction towards its neighbour without one.
    let neighbours = [(first, first.checked_sub(1)), (last, Some(last + 1).filter(|k| *k < TRIED))];
    let [low, high] = neighbours.map(|(end, neighbour)| {
        neighbour.map_or(tried_pressure(end), |neighbour| {
            last_holding(tried_pressure(end), tried_pressure(neighbour), 20, is_known)
        })
    });
    Some([three_digits(low, f64::ceil), three_digits(high, f64::floor)])
}

/// Number `k` of the pressures to evaluate, kPa.
fn tried_pressure(k: u32) -> f64 {
    ALL[0] * libm::pow(ALL[1] / ALL[0], f64::from(k) / f64::from(TRIED - 1))
}

/// `x` with three digits, by `round`.
fn three_digits(x: f64, round: fn(f64) -> f64) -> f64 {
    let digit = libm::pow(10_f64, libm::log10(x).floor() - 2.0);
    round(x / digit) * digit
}

/// The value to maximise: with an object the lower end of the force's range, 0 if unknown; else the negative final radius.
fn merit(row: &PressureRow, object: bool) -> f64 {
    if object { row.force_range_N.map_or(0.0, |range| range[0]) } else { -row.final_radius_mm }
}

/// `None` if the star has no prediction at this pressure.
fn row(case: &Case, burst: Option<f64>, kpa: f64) -> Result<Option<PressureRow>, StarFault> {
    let pressure = Pressure(kpa).pascals();
    let model = tabled(case, pressure)?;
    let (case, outcome) = Outcome::by_model(&Case { pressure: Some(pressure), ..*case }, &model)?;
    let Some(radius) = outcome.ranges.radius else { return Ok(None) };
    Ok(Some(PressureRow {
        pressure_kPa: kpa,
        final_radius_mm: Length::from_metres(outcome.rest.radius).0,
        radius_range_mm: Some(mm(radius)),
        object_force_N: outcome.object_force(),
        force_range_N: outcome.force_range,
        stretch: case.sheet.stretch(pressure, case.mechanism.width),
        burst_margin: burst.map(|burst| burst / pressure),
        tried: outcome.ranges.domain == Domain::Validated,
        best: false,
    }))
}
