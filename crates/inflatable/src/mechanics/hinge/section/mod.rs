//! A hinge at its pressure, in one dimension: bending, stretch and hoop compression, with no fitted constant.
//!
//! An endless hinge stays a surface of revolution while it does not wrinkle: its flat meridian `s` goes over into
//! `Q(s), z(s)`, the same at every angle. The shape minimises the potential of `density`, by Newton's method in cubic
//! elements (`mesh`, `potential`, `solve`). z = 0 at both rims; Q and the slope are free there, but at a point on the
//! axis (R = 0) both are 0.
//!
//! By the envelope theorem the moment is the potential's derivative at a fixed shape: with both sheets `V_bar' =
//! -2 dPi/dlambda` and `V_bar'' = -2 S` in the words of [`HingeModel`], S the Schur complement that `solve` has anyway.
//! V_bar itself is no volume here but the potential's negative, so it is not given.
//!
//! Left out: arms (hoop compression is let out into them, and the hinge coils further), and wrinkles,
//! which come above 1/eps of some 1,500 with t/W below 0.01.

pub mod arms;
mod density;
mod last_two;
mod mesh;
mod moment;
mod potential;
mod profile;
mod series;
mod solve;
mod table;
mod tabled;
/// Refuses a `ratio` of the hinge whose `value` is outside of `range`.
fn check(ratio: HingeRatio, value: f64, range: RangeInclusive<f64>) -> Result<(), HingeFault> {
    let (minimum, maximum) = (*range.start(), *range.end());
    let fault = HingeFault::Scale { ratio, found: value, least: minimum, most: maximum };
    if spans(&range, value) { Ok(()) } else { Err(fault) }
}

#[cfg(test)]
mod tests;

pub use self::moment::{Moment, OFFSETS};
pub use self::profile::{Meridian, MeridianPoint};
pub use self::table::{SectionEntry, SectionTable, hinge_at};
pub use self::tabled::Tabled;

use self::density::{Hoop, Scales};
use self::mesh::MeridianMesh;
use self::solve::ShapeSearch;
use crate::mechanics::fault::{HingeFault, HingeRatio};
use crate::mechanics::hinge::{
    Arms, Edges, HingeEffort, HingeModel, HingeState, Level, check_lambda, check_r_star,
};
use crate::numerics::spans;
use std::ops::RangeInclusive;

/// 1/eps that is covered.
pub const BENDABILITY: RangeInclusive<f64> = 10.0..=1e4;
/// t/W that is covered.
pub const THICKNESS: RangeInclusive<f64> = 0.003..=0.03;
/// nu that is covered.
pub const POISSON: RangeInclusive<f64> = 0.0..=0.49;
/// Largest R*. A hinge of a hundred widths is a bent tube: its lambda is within 2e-4 of the one at 50.
pub const MOST_R_STAR: f64 = 100.0;
/// Largest p W / Y: beyond, fabric stretches by more than a tenth, and the linear law of stretch is none of it.
pub const MOST_STRETCH: f64 = 0.1;
/// Least lambda.
pub const LEAST_LAMBDA: f64 = 0.3;
/// Largest lambda.
pub const MOST_LAMBDA: f64 = 1.7;
/// Elements: 48 are within 5e-5 of lambda and 1e-3 of C of 200 wherever p W / Y is in range.
const ELEMENTS: usize = 48;
/// Relative error of moments against the exact solution of the same equations.
const ERROR: f64 = 1e-3;

/// The section at one pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    scales: Scales,
    elements: usize,
}

impl Section {
    /// The section at 1/eps = `bendability` of fabric of thickness t/W = `thickness` and Poisson ratio `poisson`.
    ///
    /// # Errors
    /// If one of them, or the p W / Y that they make, is outside of its range.
    pub fn new(bendability: f64, thickness: f64, poisson: f64) -> Result<Self, HingeFault> {
        // The fabric first: no pressure helps where it is out of range.
        check(HingeRatio::Poisson, poisson, POISSON)?;
        check(HingeRatio::Thickness, thickness, THICKNESS)?;
        check(HingeRatio::Bendability, bendability, BENDABILITY)?;
        // B = Y t^2 / [12 (1 - nu^2)].
        let stiffness = 12.0 * (1.0 - poisson * poisson) / (bendability * thickness * thickness);
        check(HingeRatio::Stretch, stiffness.recip(), 0.0..=MOST_STRETCH)?;
        Ok(Self::unchecked(bendability, stiffness, poisson))
    }

    /// The section at 1/eps, tau = t / [W sqrt(12 (1 - nu^2))] and nu, unchecked: for tables that end a little beyond its range.
    pub fn by_ratios(bendability: f64, tau: f64, poisson: f64) -> Self {
        Self::unchecked(bendability, (bendability * tau * tau).recip(), poisson)
    }

    /// The section at 1/eps, Y / (p W) and nu, whatever they are.
    fn unchecked(bendability: f64, stiffness: f64, poisson: f64) -> Self {
        Self { scales: Scales { bendability, stiffness, poisson, hoop: Hoop::Stiff }, elements: ELEMENTS }
    }

    /// This section without hoop compression, as if the sheet wrinkled without resistance: the tension field, which tends to
    /// the ring as B -> 0 and Y -> infinity. Real hinges at working pressures are nearer to the section as it is.
    #[must_use]
    pub fn slack(self) -> Self {
        Self { scales: Scales { hoop: Hoop::Slack, ..self.scales }, ..self }
    }

    /// The stretch p W / Y.
    pub fn stretch(&self) -> f64 {
        self.scales.stiffness.recip()
    }

    /// The meridian of the hinge at rest: shape, strains and forces along it.
    ///
    /// # Errors
    /// The errors of [`HingeModel::target`].
    pub fn meridian(&self, r_star: f64) -> Result<Meridian, HingeFault> {
        self.rest(r_star).map(|search| Meridian::new(&search))
    }

    /// The hinge at rest, and at each of `lambdas`, which are best sorted: each is followed from the one before.
    ///
    /// # Errors
    /// The errors of [`HingeModel::state`].
    pub fn curve(&self, r_star: f64, lambdas: &[f64]) -> Result<Vec<HingeState>, HingeFault> {
        let mut search = self.rest(r_star)?;
        let state_at = |lambda: &f64| {
            check_lambda(*lambda, LEAST_LAMBDA, MOST_LAMBDA)?;
            search.hold(*lambda)?;
            Ok(state(&search))
        };
        lambdas.iter().map(state_at).collect()
    }

    /// Inflated width over the flat one, and thickness over the flat width, of a **disc** sealed around its rim whose flat radius is W.
    ///
    /// A disc wrinkles at its rim, so it is one for [`Section::slack`]. Without stretch and bending it is the balloon of W. H. Paulsen,
    /// "What Is the Shape of a Mylar Balloon?" (1994).
    ///
    /// # Errors
    /// If no shape is found.
    pub fn disc(&self) -> Result<[f64; 2], HingeFault> {
        let mut search = ShapeSearch::new(self.scales, MeridianMesh::disc(self.elements));
        search.search_from_arcs(Some(1.0))?;
        let shape = &search.shape;
        Ok([shape[shape.len() - 4], shape[2]])
    }

    fn rest(&self, r_star: f64) -> Result<ShapeSearch, HingeFault> {
        check_r_star(r_star, MOST_R_STAR)?;
        let mut search = ShapeSearch::new(self.scales, MeridianMesh::new(r_star, self.elements));
        search.rest()?;
        Ok(search)
    }
}

impl HingeModel for Section {
    fn level(&self) -> Level {
        Level::Section
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        check_lambda(lambda, LEAST_LAMBDA, MOST_LAMBDA)?;
        let mut search = self.rest(r_star)?;
        search.hold(lambda)?;
        Ok(state(&search))
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        self.rest(r_star).map(|search| state(&search))
    }

    fn arms(&self, r_star: f64, arc: f64) -> Option<Arms> {
        let Scales { bendability, stiffness, .. } = self.scales;
        Some(arms::arms(bendability, (stiffness * bendability).sqrt().recip(), r_star)?.arms(arc))
    }
}

fn state(search: &ShapeSearch) -> HingeState {
    let ShapeSearch { lambda, shape, potential, .. } = search;
    HingeState {
        lambda: *lambda,
        volume: None,
        slope: -2.0 * potential.slope,
        curvature: -2.0 * search.stiffness,
        edges: Some(Edges {
            // Per radian of the inflated arc, of which there are lambda for each flat one.
            tension: potential.reaction / lambda,
            angle: libm::atan2(shape[3], shape[1]),
            width: shape[shape.len() - 4] - shape[0],
            // The rim is sheet like the rest, and carries no force of its own.
            rim_force: 0.0,
        }),
        effort: HingeEffort { residual: search.decrement, iterations: search.factorisations, error: ERROR },
    }
}
