//! Cost and error of each model: the limits of high pressure against the exact ring, and all models against shells
//! ([`shells`]).
//!
//! The caller provides the clock, so that this module stays a function of its arguments.

pub mod computed;
pub mod picture;
pub mod shells;
pub mod shown;

use crate::case::mechanism;
use design::Star;
use inflatable::mechanics::fault::{HingeFault, StarFault};
use inflatable::mechanics::hinge::bvp::Bvp;
use inflatable::mechanics::hinge::fit::Fit;
use inflatable::mechanics::hinge::ring::{Ring, RingTable};
use inflatable::mechanics::hinge::{HingeModel, HingeState, Level, seal_load};
use inflatable::mechanics::star::Mechanism;
use inflatable::mechanics::star::response::Inflated;
use spec::StarSpec;
use spec::units::Length;
use std::fmt::Write;

/// R* of the comparison; k is infinite at 0 and is compared on the others.
pub const R_STARS: [f64; 7] = [0.0, 0.02, 0.1, 0.3, 1.0, 3.0, 10.0];
/// Points of the stars of the comparison, with the R* from 0 to 0.1 that such stars can have.
pub const POINTS: [u32; 4] = [3, 4, 5, 6];

/// One model: its time and its largest relative errors.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeRow {
    /// The model.
    pub model: String,
    /// Time for one hinge's target, s, the mean over the R*.
    pub time: f64,
    /// Errors of lambda_t, V_bar''(lambda_t), seal load k, final radius, radial stiffness; `None` where the model has none.
    pub errors: [Option<f64>; 5],
}

/// Names of the errors.
pub const QUANTITIES: [&str; 5] = ["lambda_t", "V''", "k", "rho_f", "stiffness"];

/// Measures every model; `clock` returns the time in s.
///
/// `base` gives the star's size; its points and radii are those of the comparison.
///
/// # Errors
/// If a model refuses one of the hinges.
pub fn measure(base: &StarSpec, clock: &dyn Fn() -> f64) -> Result<Vec<TradeRow>, StarFault> {
    let table = RingTable::new()?;
    let penalised = [1e2, 1e3, 1e4, 1e5].map(|beta| Bvp::new(beta, 1e-6));
    let mut models: Vec<(String, &dyn HingeModel)> =
        vec![("fit".to_owned(), &Fit), ("ring, table".to_owned(), &table), ("ring".to_owned(), &Ring)];
    models
        .extend(penalised.iter().map(|bvp| (format!("bvp, beta = {}", bvp.beta()), bvp as &dyn HingeModel)));
    let trade_stars = stars(base);
    let exact = TargetTable::new(&Ring)?;
    models
        .into_iter()
        .map(|(title, model)| {
            let (time, table) = time_of(model, clock)?;
            let mut errors = [Some(0.0), Some(0.0), None, Some(0.0), Some(0.0)];
            for ((exact, state), r_star) in exact.targets.iter().zip(&table.targets).zip(R_STARS) {
                raise(&mut errors[0], state.lambda, exact.lambda);
                raise(&mut errors[1], state.curvature, exact.curvature);
                if let Some((load, exact)) = seal_load(r_star, state).zip(seal_load(r_star, exact)) {
                    raise(&mut errors[2], load, exact);
                }
            }
            for star in &trade_stars {
                let exact = Inflated::new(star, &exact, 1e4)?.linear_rest();
                let rest = Inflated::new(star, &table, 1e4)?.linear_rest();
                raise(&mut errors[3], rest.radius, exact.radius);
                raise(&mut errors[4], rest.stiffness, exact.stiffness);
            }
            Ok(TradeRow { model: title, time, errors })
        })
        .collect()
}

/// A model's targets at the R* of the comparison, computed once: all that linear stars need.
struct TargetTable {
    level: Level,
    targets: [HingeState; R_STARS.len()],
}

impl TargetTable {
    fn new(model: &dyn HingeModel) -> Result<Self, StarFault> {
        let mut targets = [model.target(R_STARS[0])?; R_STARS.len()];
        for (target, r_star) in targets.iter_mut().zip(R_STARS).skip(1) {
            *target = model.target(std::hint::black_box(r_star))?;
        }
        Ok(Self { level: model.level(), targets })
    }
}

impl HingeModel for TargetTable {
    fn level(&self) -> Level {
        self.level
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        Err(HingeFault::Unsolved { r_star, lambda, residual: f64::MAX })
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        // A star's R / W differs from the R* it was made from by rounding.
        let index = R_STARS.iter().position(|known| (known - r_star).abs() < 1e-9);
        let largest = R_STARS[R_STARS.len() - 1];
        index.map(|i| self.targets[i]).ok_or(HingeFault::RStar { found: r_star, most: largest })
    }

    fn onset(&self, _: f64) -> Result<Option<f64>, HingeFault> {
        Ok(None)
    }
}

/// Stars of the given size with the points and the R* of the comparison, as far as they exist.
fn stars(base: &StarSpec) -> Vec<Mechanism> {
    let r_stars = R_STARS.iter().filter(|r_star| **r_star <= 0.1);
    r_stars
        .flat_map(|r_star| POINTS.map(|points| (Length(*r_star * base.tube_width.0), points)))
        .filter_map(|(radius, points)| {
            let spec = StarSpec { points, tip_radius: radius, corner_radius: radius, ..base.clone() };
            Star::new(&spec).ok().map(|star| mechanism(&star))
        })
        .collect()
}

/// Raises `largest` to the relative error of `value`.
fn raise(largest: &mut Option<f64>, value: f64, exact: f64) {
    *largest = Some(largest.unwrap_or(0.0).max((value / exact - 1.0).abs()));
}

/// Mean time of one target, and the targets; repeated until it takes a tenth of a second, so that the clock's resolution
/// does not matter.
fn time_of(model: &dyn HingeModel, clock: &dyn Fn() -> f64) -> Result<(f64, TargetTable), StarFault> {
    let mut repeats = 1_u32;
    loop {
        let start = clock();
        let mut table = TargetTable::new(model)?;
        for _ in 1..repeats {
            table = std::hint::black_box(TargetTable::new(model)?);
        }
        let time = clock() - start;
        if time >= 0.1 || repeats >= 1 << 22 {
            #[expect(clippy::cast_precision_loss, reason = "a handful")]
            return Ok((time / f64::from(repeats) / R_STARS.len() as f64, table));
        }
        repeats *= 4;
    }
}

/// The rows as a table for a terminal.
pub fn table(rows: &[TradeRow]) -> String {
    let names = QUANTITIES.map(|quantity| format!("{quantity:>11}")).concat();
    let mut text = format!("{:20}{:>12}{names}\n", "model", "time");
    for row in rows {
        let texts = row.errors.map(|error| error.map_or("-".to_owned(), |error| format!("{error:.1e}")));
        let errors = texts.map(|text| format!("{text:>11}")).concat();
        let _ = writeln!(text, "{:20}{:>9.2} us{errors}", row.model, row.time * 1e6);
    }
    text
}

/// The rows as CSV.
pub fn csv(rows: &[TradeRow]) -> String {
    let mut text = format!("model,time_s,error_{}\n", QUANTITIES.join(",error_"));
    for row in rows {
        let errors = row.errors.map(|error| error.map_or(String::new(), |error| format!("{error:.3e}")));
        let _ = writeln!(text, "\"{}\",{:.3e},{}", row.model, row.time, errors.join(","));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn errors_fall_from_level_to_level() {
        // A clock that jumps: no test depends on the machine's speed.
        let ticks = Cell::new(0.0);
        let clock = || {
            ticks.set(ticks.get() + 1.0);
            ticks.get()
        };
        let rows = measure(&StarSpec::paper(5), &clock).expect("all models answer");
        let row = |name: &str| rows.iter().find(|row| row.model == name).expect("measured");
        assert_eq!(row("ring").errors, [Some(0.0); 5]);
        assert_eq!(row("fit").errors[2], None);
        let errors_of = |name: &str| row(name).errors.map(|e| e.unwrap_or(1.0));
        let (coarse, fine) = (errors_of("bvp, beta = 100"), errors_of("bvp, beta = 10000"));
        assert!(coarse.iter().zip(fine).all(|(a, b)| b < *a), "{coarse:?} {fine:?}");
        assert!(errors_of("ring, table").iter().all(|e| *e < 1e-9));
        assert_eq!(csv(&rows).lines().count(), rows.len() + 1);
        assert!(table(&rows).contains("ring") && picture::of_choice(&[], &rows).ends_with("</svg>\n"));
    }
}
