//! The section at one pressure from its table, with its arms: the solver's answer in microseconds.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::section::LEAST_LAMBDA;
use crate::mechanics::hinge::section::arms::{ArmsByArc, ArmsByRadius};
use crate::mechanics::hinge::section::last_two::{LastTwo, have_same_bits};
use crate::mechanics::hinge::section::moment::Moment;
use crate::mechanics::hinge::section::series::AlongRadii;
use crate::mechanics::hinge::section::table::{SectionEntry, SectionTable};
use crate::mechanics::hinge::{Arms, Edges, HingeEffort, HingeModel, HingeState, Level, check_lambda};
use std::cell::RefCell;
use std::sync::OnceLock;

/// Largest lambda: the straight line beyond the table's end leads there, as a short hinge between strong ones needs it.
const MOST_LAMBDA: f64 = 3.0;

/// The section at one pressure, for the hinges of one star. Hinges of other R* are looked up each time.
#[derive(Clone, Debug)]
pub struct Tabled {
    /// 1/eps, t/W and nu.
    scales: [f64; 3],
    known: [TabledState; 2],
}

/// A hinge that was looked up.
#[derive(Clone, Debug)]
struct TabledState {
    r_star: f64,
    entry: SectionEntry,
    arms: Option<ArmsByArc>,
    /// Moment of the hinge, once it was needed: among millions only the rest is.
    moment: OnceLock<Result<Moment, HingeFault>>,
}

/// What hinges of any R* have in common: 1/eps, t/W and nu.
#[derive(Debug)]
struct Common {
    scales: [f64; 3],
    rest: AlongRadii,
    arms: Option<ArmsByRadius>,
}

impl Tabled {
    /// The section at 1/eps = `bendability` of fabric of thickness t/W = `thickness` and Poisson ratio `poisson`, with
    /// hinges of R* = `r_stars`.
    ///
    /// # Errors
    /// The errors of [`SectionTable::entry`].
    pub fn new(scales: [f64; 3], r_stars: [f64; 2]) -> Result<Self, HingeFault> {
        thread_local! {
            static LAST: RefCell<LastTwo<Tabled>> = const { RefCell::new(LastTwo::NONE) };
        }
        LAST.with_borrow_mut(|last| {
            last.find_or_make(|own| own.is_made_of(scales, r_stars), || Self::look_up(scales, r_stars))
                .cloned()
        })
    }

    /// Whether it was made of these numbers.
    fn is_made_of(&self, scales: [f64; 3], r_stars: [f64; 2]) -> bool {
        have_same_bits(self.scales, scales)
            && have_same_bits([0, 1].map(|i: usize| self.known[i].r_star), r_stars)
    }

    fn look_up(scales: [f64; 3], r_stars: [f64; 2]) -> Result<Self, HingeFault> {
        Common::take_from_last(scales, |common| {
            let tip = common.state(r_stars[0])?;
            let corner = if r_stars[0] == r_stars[1] {
                TabledState { r_star: r_stars[1], ..tip.clone() }
            } else {
                common.state(r_stars[1])?
            };
            Ok(Self { scales, known: [tip, corner] })
        })
    }

    /// What `take` takes from the hinge of R*.
    fn take_from_state<T>(
        &self,
        r_star: f64,
        take: impl FnOnce(&TabledState) -> Result<T, HingeFault>,
    ) -> Result<T, HingeFault> {
        match self.known.iter().find(|known| known.r_star == r_star) {
            Some(known) => take(known),
            None => take(&Common::take_from_last(self.scales, |common| common.state(r_star))?),
        }
    }
}

impl Common {
    /// What `take` takes from what hinges have in common at 1/eps, t/W and nu = `scales`.
    fn take_from_last<T>(
        scales: [f64; 3],
        take: impl FnOnce(&Self) -> Result<T, HingeFault>,
    ) -> Result<T, HingeFault> {
        thread_local! {
            /// Rows of a study may share fabric, width and pressure, but no radius.
            static LAST: RefCell<LastTwo<Common>> = const { RefCell::new(LastTwo::NONE) };
        }
        LAST.with_borrow_mut(|last| {
            take(last.find_or_make(|own| have_same_bits(own.scales, scales), || Self::new(scales))?)
        })
    }

    fn new(scales: [f64; 3]) -> Result<Self, HingeFault> {
        let [bendability, thickness, poisson] = scales;
        let rest = SectionTable::shipped()?.along_radii(scales)?;
        let tau = thickness / (12.0 * (1.0 - poisson * poisson)).sqrt();
        Ok(Self { scales, rest, arms: ArmsByRadius::new(bendability, tau) })
    }

    /// The hinge of R*.
    fn state(&self, r_star: f64) -> Result<TabledState, HingeFault> {
        let entry = SectionEntry::new(&self.rest, r_star)?;
        let arms = self.arms.as_ref().and_then(|arms| arms.by_arc(r_star));
        Ok(TabledState { r_star, entry, arms, moment: OnceLock::new() })
    }
}

impl TabledState {
    /// The hinge at rest: no moment, and the stiffness of the table.
    fn rest(&self) -> HingeState {
        self.with_moment(self.entry.lambda, [-0.0, -self.entry.stiffness])
    }

    /// The hinge at `lambda`, of 1/eps, t/W and nu = `scales`.
    fn state(&self, scales: [f64; 3], lambda: f64) -> Result<HingeState, HingeFault> {
        let entry = &self.entry;
        let look_up = || SectionTable::shipped()?.moment(scales, self.r_star, entry);
        let moment = (*self.moment.get_or_init(look_up))?;
        // Beyond the ends of the table its last secant goes on: a straight line.
        let way = entry.lambda - 1.0;
        let clamped = lambda.clamp(entry.lambda - way, entry.lambda + way);
        let change = lambda - entry.lambda;
        let slope = if clamped == lambda || change == 0.0 {
            moment.slope(lambda)
        } else {
            moment.slope(clamped) * change / (clamped - entry.lambda)
        };
        let curvature = if clamped == lambda { moment.curvature(lambda) } else { slope / change };
        Ok(self.with_moment(lambda, [slope, curvature]))
    }

    /// The hinge at `lambda` with V_bar' and V_bar''.
    fn with_moment(&self, lambda: f64, [slope, curvature]: [f64; 2]) -> HingeState {
        let entry = &self.entry;
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
        self.take_from_state(r_star, |hinge| hinge.state(self.scales, lambda))
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        self.take_from_state(r_star, |hinge| Ok(hinge.rest()))
    }

    fn arms(&self, r_star: f64, arc: f64) -> Option<Arms> {
        self.take_from_state(r_star, |hinge| Ok(hinge.arms.map(|arms| arms.arms(arc)))).ok()?
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::hinge::section::Section;

    fn pair(scales: [f64; 3], r_star: f64) -> (Tabled, Section) {
        let tabled = Tabled::new(scales, [r_star, r_star]).expect("in range");
        (tabled, Section::new(scales[0], scales[1], scales[2]).expect("in range"))
    }

    #[test]
    fn it_is_the_section_within_the_tables_bounds() {
        for scales in [[330.0, 0.015, 0.39], [1500.0, 0.01, 0.39], [500.0, 0.02, 0.2]] {
            for r_star in [0.02, 0.1, 0.7] {
                let (fast, slow) = pair(scales, r_star);
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
        let (tabled, _) = pair([900.0, 0.012, 0.39], 0.1);
        let rest = tabled.target(0.1).expect("at rest").lambda;
        let slope = |lambda| tabled.state(0.1, lambda).expect("covered").slope;
        let mut previous = f64::INFINITY;
        for step in 0..=60 {
            let lambda = 0.8 + 0.7 * f64::from(step) / 60.0;
            assert!(slope(lambda) < previous, "closing moments fall: {lambda}");
            previous = slope(lambda);
            let ends = [1.0, rest, 2.0 * rest - 1.0];
            if ends.iter().all(|end| (lambda - end).abs() > 1e-3) {
                let curvature = tabled.state(0.1, lambda).expect("covered").curvature;
                let expected = (slope(lambda + 1e-5) - slope(lambda - 1e-5)) / 2e-5;
                assert!(
                    (curvature - expected).abs() < 1e-4 * expected.abs(),
                    "{lambda}: {curvature} {expected}"
                );
            }
        }
        assert_eq!(slope(rest), 0.0);
        assert_eq!(tabled.state(0.1, rest), tabled.target(0.1));
    }

    #[test]
    fn an_answer_does_not_depend_on_those_before() {
        let answers = |scales: [f64; 3], r_stars: [f64; 2]| {
            let tabled = Tabled::new(scales, r_stars).expect("in range");
            r_stars.map(|r_star| (tabled.target(r_star).expect("at rest"), tabled.arms(r_star, 1.0)))
        };
        let cases = [
            ([330.0, 0.015, 0.39], [0.1, 0.0]),
            ([330.0, 0.015, 0.39], [0.0, 0.1]),
            ([500.0, 0.015, 0.39], [0.1, 0.1]),
            ([500.0, 0.012, 0.2], [0.1, 0.1]),
        ];
        let expected = cases.map(|(scales, r_stars)| {
            std::thread::spawn(move || answers(scales, r_stars)).join().expect("no panic")
        });
        for (k, j) in (0..cases.len()).flat_map(|k| (0..cases.len()).map(move |j| (k, j))) {
            for own in [k, j, k] {
                assert_eq!(answers(cases[own].0, cases[own].1), expected[own], "{own}");
            }
        }
    }
}
