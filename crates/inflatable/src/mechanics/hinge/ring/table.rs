//! The ring at its target as a series in R*, for sweeps over many designs.
//!
//! All target quantities are analytic in `x = R* / (R* + 1/2)` on [0, 1], both ends included (after
//! division by 1 + R* where they grow), so one Chebyshev series covers every R* from 0 to infinity.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::ring::section::{LAMBDA, PHI_0, TENSION};
use crate::mechanics::hinge::ring::{Ring, target_and_onset};
use crate::mechanics::hinge::{Edges, HingeEffort, HingeModel, HingeState, Level, check_r_star};
use crate::numerics::Chebyshev;

/// Terms of each series: 40 bring all errors below [`RingTable::ERROR`], 30 do not.
const TERMS: usize = 40;
/// The R* in the middle of the table. It centres the strongest variation; 0.1 or 3 need more terms.
const CENTRE: f64 = 0.5;

/// The exact ring, whose target and onset come from series.
#[derive(Clone, Debug)]
pub struct RingTable {
    /// Of lambda_t, lambda_c, V_bar, V_bar'', tension, width and angle, bounded for R* -> infinity.
    series: [Chebyshev; 7],
}

impl RingTable {
    /// Bound of the relative error of every entry against [`Ring`], for any R*.
    pub const ERROR: f64 = 1e-10;

    /// Solves the ring at the table's points; takes about a millisecond.
    ///
    /// # Errors
    /// Only if the ring cannot be solved at one of the points, which the tests exclude.
    pub fn new() -> Result<Self, HingeFault> {
        let mut columns: [Vec<f64>; 7] = Default::default();
        for x in Chebyshev::points(TERMS) {
            let r_star = CENTRE * x / (1.0 - x);
            let [target, onset] = target_and_onset(r_star)?;
            let grow = 1.0 + r_star;
            let scaled = [
                target.unknowns[LAMBDA],
                onset.unknowns[LAMBDA],
                target.section.volume.value / grow,
                target.curvature / grow,
                target.unknowns[TENSION] / grow,
                target.section.width.value,
                target.unknowns[PHI_0],
            ];
            columns.iter_mut().zip(scaled).for_each(|(column, value)| column.push(value));
        }
        Ok(Self { series: columns.map(|column| Chebyshev::interpolating(&column)) })
    }

    /// The entry of series `number` at R*.
    fn entry(&self, number: usize, r_star: f64) -> f64 {
        self.series[number].value(r_star / (r_star + CENTRE))
    }
}

impl HingeModel for RingTable {
    fn level(&self) -> Level {
        Level::Ring
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        Ring.state(r_star, lambda)
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        check_r_star(r_star, f64::MAX)?;
        let grow = 1.0 + r_star;
        let (tension, angle) = (self.entry(4, r_star) * grow, self.entry(6, r_star));
        Ok(HingeState {
            lambda: self.entry(0, r_star),
            volume: Some(self.entry(2, r_star) * grow),
            slope: 0.0,
            curvature: self.entry(3, r_star) * grow,
            edges: Some(Edges {
                tension,
                angle,
                width: self.entry(5, r_star),
                rim_force: 2.0 * tension * libm::cos(angle),
            }),
            effort: HingeEffort { residual: 0.0, iterations: 0, error: Self::ERROR },
        })
    }

    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        check_r_star(r_star, f64::MAX)?;
        Ok(Some(self.entry(1, r_star)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The series' own estimate of their largest relative error.
    fn error_estimate(table: &RingTable) -> f64 {
        let relative =
            |series: &Chebyshev| series.error() / series.value(0.0).abs().min(series.value(1.0).abs());
        table.series.iter().map(relative).fold(0.0, f64::max)
    }

    #[test]
    fn agrees_with_the_ring_between_its_points() {
        let table = RingTable::new().expect("the ring is solved at every point");
        assert!(error_estimate(&table) < RingTable::ERROR, "{:.1e}", error_estimate(&table));
        let mut worst: f64 = 0.0;
        let inner_radii = (0..150).map(|i| f64::from(i) / 150.0).map(|x| CENTRE * x / (1.0 - x));
        for r_star in inner_radii.chain([1e-6, 1e-3, 1e3, 1e4, 1e6]) {
            let exact = Ring.target(r_star).expect("solved");
            let onset = Ring.onset(r_star).expect("solved").expect("the ring has an onset");
            let entry = table.target(r_star).expect("in range");
            let [tabled_edges, edges] =
                [entry, exact].map(|state| state.edges.expect("the ring knows its edges"));
            let pairs = [
                (entry.lambda, exact.lambda),
                (table.onset(r_star).expect("in range").expect("the table has an onset"), onset),
                (entry.volume.unwrap_or(f64::NAN), exact.volume.unwrap_or(f64::NAN)),
                (entry.curvature, exact.curvature),
                (tabled_edges.tension, edges.tension),
                (tabled_edges.width, edges.width),
                (tabled_edges.angle, edges.angle),
            ];
            for (got, want) in pairs {
                let error = (got / want - 1.0).abs();
                assert!(error <= RingTable::ERROR, "R* = {r_star}: {got} is not {want}");
                worst = worst.max(error);
            }
        }
        println!("largest relative error {worst:.1e}, own estimate {:.1e}", error_estimate(&table));
    }

    #[test]
    fn refuses_what_is_no_radius() {
        let table = RingTable::new().expect("solved");
        for r_star in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(table.target(r_star).is_err() && table.onset(r_star).is_err(), "{r_star}");
        }
    }
}
