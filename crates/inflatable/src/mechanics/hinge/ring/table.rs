//! The ring at its target as a series in R*, for sweeps over many designs.
//!
//! All target quantities are analytic in `x = R* / (R* + 1/2)` on [0, 1], both ends included (after
//! division by 1 + R* where they grow), so one Chebyshev series covers every R* from 0 to infinity.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::check_r_star;
use crate::mechanics::hinge::ring::solve::{Solved, solve_onset, solve_target};
use crate::mechanics::hinge::ring::unsolved;
use crate::numerics::Chebyshev;

/// Terms of each series: 40 bring all errors below [`RingTable::ERROR`], 30 do not.
const TERMS: usize = 40;
/// The R* in the middle of the table. It centres the strongest variation; 0.1 or 3 need more terms.
const CENTRE: f64 = 0.5;

/// Target quantities of the ring for any R*.
#[derive(Clone, Debug)]
pub struct RingTable {
    series: [Chebyshev; 7],
}

/// A hinge at its target, as the table gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetEntry {
    /// Target coiling factor lambda_t.
    pub lambda_t: f64,
    /// Onset of the cone, lambda_c.
    pub lambda_c: f64,
    /// V_bar at the target.
    pub volume: f64,
    /// d2V_bar/dlambda2 at the target.
    pub curvature: f64,
    /// Meridional tension at the inner edge per radian, in units of p W^2.
    pub tension: f64,
    /// Inflated width r(1) in units of W.
    pub width: f64,
    /// Slope angle at the inner edge, rad.
    pub angle: f64,
}

impl RingTable {
    /// Bound of the relative error of every entry against [`super::Ring`], for any R*.
    pub const ERROR: f64 = 1e-10;

    /// Solves the ring at the table's points; takes about a millisecond.
    ///
    /// # Errors
    /// Only if the ring cannot be solved at one of the points, which the tests exclude.
    pub fn new() -> Result<Self, HingeFault> {
        let mut columns: [Vec<f64>; 7] = Default::default();
        for x in Chebyshev::points(TERMS) {
            let r_star = CENTRE * x / (1.0 - x);
            let target = solve_target(r_star).map_err(|fault| unsolved(r_star, 1.3, fault))?;
            let onset = solve_onset(r_star, &target).map_err(|fault| unsolved(r_star, 1.3, fault))?;
            for (column, value) in columns.iter_mut().zip(scaled(r_star, &target, &onset)) {
                column.push(value);
            }
        }
        Ok(Self { series: columns.map(|column| Chebyshev::through(&column)) })
    }

    /// The target at `r_star`.
    ///
    /// # Errors
    /// If `r_star` is not a finite number from 0 on.
    pub fn at(&self, r_star: f64) -> Result<TargetEntry, HingeFault> {
        check_r_star(r_star, f64::MAX)?;
        let x = r_star / (r_star + CENTRE);
        let grow = 1.0 + r_star;
        let value = |i: usize| self.series[i].at(x);
        Ok(TargetEntry {
            lambda_t: value(0),
            lambda_c: value(1),
            volume: value(2) * grow,
            curvature: value(3) * grow,
            tension: value(4) * grow,
            width: value(5),
            angle: value(6),
        })
    }

    /// The series' own estimate of their largest relative error.
    pub fn error_estimate(&self) -> f64 {
        let relative = |series: &Chebyshev| series.error() / series.at(0.0).abs().min(series.at(1.0).abs());
        self.series.iter().map(relative).fold(0.0, f64::max)
    }
}

/// The seven quantities, bounded for R* -> infinity.
fn scaled(r_star: f64, target: &Solved, onset: &Solved) -> [f64; 7] {
    let grow = 1.0 + r_star;
    [
        target.unknowns[3],
        onset.unknowns[3],
        target.section.volume.value / grow,
        target.curvature / grow,
        target.unknowns[1] / grow,
        target.section.width.value,
        target.unknowns[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::hinge::HingeModel;
    use crate::mechanics::hinge::ring::Ring;

    #[test]
    fn agrees_with_the_ring_between_its_points() {
        let table = RingTable::new().expect("the ring is solved at every point");
        assert!(table.error_estimate() < RingTable::ERROR, "{:.1e}", table.error_estimate());
        let mut worst: f64 = 0.0;
        let between = (0..150).map(|i| f64::from(i) / 150.0).map(|x| CENTRE * x / (1.0 - x));
        for r_star in between.chain([1e-6, 1e-3, 1e3, 1e4, 1e6]) {
            let exact = Ring.target(r_star).expect("solved");
            let onset = Ring.onset(r_star).expect("solved").expect("the ring has an onset");
            let entry = table.at(r_star).expect("in range");
            let edges = exact.edges.expect("the ring knows its edges");
            let pairs = [
                (entry.lambda_t, exact.lambda),
                (entry.lambda_c, onset),
                (entry.volume, exact.volume.unwrap_or(f64::NAN)),
                (entry.curvature, exact.curvature),
                (entry.tension, edges.tension),
                (entry.width, edges.width),
                (entry.angle, edges.angle),
            ];
            for (got, want) in pairs {
                let error = (got / want - 1.0).abs();
                assert!(error <= RingTable::ERROR, "R* = {r_star}: {got} is not {want}");
                worst = worst.max(error);
            }
        }
        println!("largest relative error {worst:.1e}, own estimate {:.1e}", table.error_estimate());
    }

    #[test]
    fn refuses_what_is_no_radius() {
        let table = RingTable::new().expect("solved");
        assert!(table.at(-1.0).is_err() && table.at(f64::NAN).is_err() && table.at(f64::INFINITY).is_err());
    }
}
