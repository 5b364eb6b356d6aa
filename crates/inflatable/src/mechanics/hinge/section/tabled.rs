//! The section at one pressure from its table, with its arms: the solver's answer in microseconds.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::section::LEAST_LAMBDA;
use crate::mechanics::hinge::section::arms::{ArmsByArc, arms};
use crate::mechanics::hinge::section::table::{MOST_TABLED_R_STAR, RadiusSeries, SectionEntry, SectionTable};
use crate::mechanics::hinge::{
    Arms, Edges, HingeEffort, HingeModel, HingeState, Level, check_lambda, check_r_star,
};

/// Largest lambda: the straight line beyond the table's end leads there, as a short hinge between strong ones needs it.
const MOST_LAMBDA: f64 = 3.0;

/// The section at one pressure, for the hinges of one star. Hinges of other R* are looked up each time.
#[derive(Clone, Copy, Debug)]
pub struct Tabled {
    series: RadiusSeries,
    /// 1/eps and tau.
    scales: [f64; 2],
    known: [TabledState; 2],
}

/// A hinge that was looked up.
#[derive(Clone, Copy, Debug)]
struct TabledState {
    r_star: f64,
    entry: SectionEntry,
    arms: Option<ArmsByArc>,
}

impl Tabled {
    /// The section at 1/eps = `bendability` of fabric of thickness t/W = `thickness` and Poisson ratio `poisson`, with
    /// hinges of R* = `r_stars`.
    ///
    /// # Errors
    /// As for [`SectionTable::at`].
    pub fn new(
        table: &SectionTable,
        [bendability, thickness, poisson]: [f64; 3],
        r_stars: [f64; 2],
    ) -> Result<Self, HingeFault> {
        let series = table.along_radii(bendability, thickness, poisson)?;
        let scales = [bendability, thickness / (12.0 * (1.0 - poisson * poisson)).sqrt()];
        let one = known(&series, scales, r_stars[0])?;
        let other = if r_stars[0] == r_stars[1] { one } else { known(&series, scales, r_stars[1])? };
        Ok(Self { series, scales, known: [one, other] })
    }

    fn at(&self, r_star: f64) -> Result<TabledState, HingeFault> {
        match self.known.iter().find(|known| known.r_star == r_star) {
            Some(known) => Ok(*known),
            None => known(&self.series, self.scales, r_star),
        }
    }
}

fn known(
    series: &RadiusSeries,
    [bendability, tau]: [f64; 2],
    r_star: f64,
) -> Result<TabledState, HingeFault> {
    let entry = series.at(r_star)?;
    Ok(TabledState { r_star, entry, arms: arms(bendability, tau, r_star) })
}

impl TabledState {
    fn state(&self, lambda: f64) -> HingeState {
        let entry = &self.entry;
        // Beyond the ends of the table its last secant goes on: a straight line.
        let way = entry.lambda - 1.0;
        let inside = lambda.clamp(entry.lambda - way, entry.lambda + way);
        let away = lambda - entry.lambda;
        let slope = if inside == lambda || away == 0.0 {
            entry.slope(lambda)
        } else {
            entry.slope(inside) * away / (inside - entry.lambda)
        };
        let curvature = if inside == lambda { entry.curvature(lambda) } else { slope / away };
        HingeState {
            lambda,
            volume: None,
            slope,
            curvature,
            edges: Some(Edges {
                tension: entry.opening / entry.lambda,
                // The table has no angle; the load on the seal does not depend on it.
                angle: 0.0,
                width: entry.width,
                rim_force: 0.0,
            }),
            effort: HingeEffort { residual: 0.0, iterations: 0, error: SectionTable::STIFFNESS_ERROR },
        }
    }
}

impl HingeModel for Tabled {
    fn level(&self) -> Level {
        Level::Section
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        check_lambda(lambda, LEAST_LAMBDA, MOST_LAMBDA)?;
        Ok(self.at(r_star)?.state(lambda))
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        let known = self.at(r_star)?;
        Ok(known.state(known.entry.lambda))
    }

    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        check_r_star(r_star, MOST_TABLED_R_STAR).map(|()| None)
    }

    fn arms(&self, r_star: f64, arc: f64) -> Option<Arms> {
        self.at(r_star).ok()?.arms.map(|arms| arms.at(arc))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::hinge::section::Section;

    fn pair(table: &SectionTable, scales: [f64; 3], r_star: f64) -> (Tabled, Section) {
        let tabled = Tabled::new(table, scales, [r_star, r_star]).expect("in range");
        (tabled, Section::new(scales[0], scales[1], scales[2]).expect("in range"))
    }

    #[test]
    fn it_is_the_section_within_the_tables_bounds() {
        let table = SectionTable::shipped().expect("whole");
        for scales in [[330.0, 0.015, 0.39], [1500.0, 0.01, 0.39], [500.0, 0.02, 0.2]] {
            for r_star in [0.02, 0.1, 0.7] {
                let (fast, slow) = pair(table, scales, r_star);
                let (a, b) = (fast.target(r_star).expect("at rest"), slow.target(r_star).expect("at rest"));
                assert!((a.lambda - b.lambda).abs() < SectionTable::COILING_ERROR);
                assert!((a.curvature / b.curvature - 1.0).abs() < SectionTable::STIFFNESS_ERROR);
                assert_eq!(fast.arms(r_star, 1.0), slow.arms(r_star, 1.0));
                let open = 1.0 + 0.5 * (b.lambda - 1.0);
                let [a, b] = [&fast as &dyn HingeModel, &slow]
                    .map(|model| model.state(r_star, open).expect("held").slope);
                assert!((a / b - 1.0).abs() < 0.05, "{scales:?} {r_star}: {a} {b}");
            }
        }
    }

    #[test]
    fn moments_lead_on_beyond_the_tables_ends_and_their_slopes_are_theirs() {
        let table = SectionTable::shipped().expect("whole");
        let (tabled, _) = pair(table, [900.0, 0.012, 0.39], 0.1);
        let rest = tabled.target(0.1).expect("at rest").lambda;
        let slope = |lambda| tabled.state(0.1, lambda).expect("covered").slope;
        let mut before = f64::INFINITY;
        for step in 0..=60 {
            let lambda = 0.8 + 0.7 * f64::from(step) / 60.0;
            assert!(slope(lambda) < before, "closing moments fall: {lambda}");
            before = slope(lambda);
            let ends = [1.0, rest, 2.0 * rest - 1.0];
            if ends.iter().all(|end| (lambda - end).abs() > 1e-3) {
                let found = tabled.state(0.1, lambda).expect("covered").curvature;
                let expected = (slope(lambda + 1e-5) - slope(lambda - 1e-5)) / 2e-5;
                assert!((found - expected).abs() < 1e-4 * expected.abs(), "{lambda}: {found} {expected}");
            }
        }
        assert_eq!(slope(rest), 0.0);
    }
}
