//! The section at rest, and its moment around, as one series over (1/eps, t/W, R*, nu): for microseconds.
//!
//! In `b = 1/eps`, `tau = t / [W sqrt(12 (1 - nu^2))]`, R* and nu, with `p W / Y = b tau^2`, every quantity is smooth, and its
//! Chebyshev coefficients fall fast in all four; those below 3e-5 are left out. `b` goes to a bound that falls with
//! tau, so that the series end a little beyond p W / Y = 0.1 and not far from it. R* enters by its logarithm from a
//! thousandth on, where the solver's own core begins.
//!
//! The four quantities of the rest and the four of the moment are two series: designs among millions need the rest alone.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::check_r_star;
use crate::mechanics::hinge::section::Section;
use crate::mechanics::hinge::section::moment::Moment;
use crate::mechanics::hinge::section::series::{AlongRadii, PartialSums, Quantities, Series};
use std::cell::RefCell;
use std::sync::LazyLock;

/// tau at the ends of the series: t/W = 0.003 at nu = 0, and 0.03 at 0.49.
const TAU: [f64; 2] = [8.660_254e-4, 9.934_52e-3];
/// Largest R*: that of stars and actuators. The solver goes further.
pub(super) const MOST_TABLED_R_STAR: f64 = 3.0;
/// R* below which nothing changes any more.
const SHARPEST: f64 = 1e-3;
/// The series, as they are shipped.
const SHIPPED: &str = include_str!("table.txt");

/// The section's table.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionTable {
    /// ln(lambda - 1), ln C, the logarithm of the opening force, and the width.
    rest: Series,
    /// The moment's secants.
    moment: Series,
}

/// A hinge at rest, as the table gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionEntry {
    /// Coiling factor at rest.
    pub lambda: f64,
    /// `C alpha_0 / (p W^3)`: minus d2V_bar/dlambda2 in the words of the models.
    pub stiffness: f64,
    /// Force that opens the seal at the inner rim per flat radian, in units of p W^2.
    pub opening: f64,
    /// Inflated width in units of W.
    pub width: f64,
}

impl SectionTable {
    /// Largest error of lambda and width against the solver at R* from a thousandth on; at a point on the axis 7e-3.
    pub const COILING_ERROR: f64 = 3e-3;
    /// Largest relative error of stiffness and opening force.
    pub const STIFFNESS_ERROR: f64 = 4e-2;
    /// Largest relative error of the moment half way to the flat angle, from t/W = 0.006 on. Thinner sheets fold and
    /// unfold on the way, and a quartic does not follow: there the moment is an estimate only.
    pub const MOMENT_ERROR: f64 = 3e-2;

    /// The shipped table, the only one. It is read once, in a fraction of a millisecond.
    ///
    /// # Errors
    /// Never: a test reads it.
    pub fn shipped() -> Result<&'static Self, HingeFault> {
        static TABLE: LazyLock<Option<SectionTable>> = LazyLock::new(|| SectionTable::read(SHIPPED));
        let unread = HingeFault::Unsolved { r_star: 0.0, lambda: 0.0, residual: f64::MAX };
        TABLE.as_ref().ok_or(unread)
    }

    fn read(text: &str) -> Option<Self> {
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let terms: Vec<([usize; 4], [Quantities; 2])> = lines.map(term).collect::<Option<_>>()?;
        let [rest, moment] =
            [0, 1].map(|half| Series::from_terms(terms.iter().map(|(orders, own)| (*orders, own[half]))));
        Some(Self { rest: rest?, moment: moment? })
    }

    /// The hinge at rest: the same arguments and ranges as [`Section::new`], and R* up to 3.
    ///
    /// # Errors
    /// The errors of [`Section::new`] and [`HingeModel::target`](crate::mechanics::hinge::HingeModel::target).
    pub fn entry(
        &self,
        bendability: f64,
        thickness: f64,
        poisson: f64,
        r_star: f64,
    ) -> Result<SectionEntry, HingeFault> {
        SectionEntry::new(&self.along_radii([bendability, thickness, poisson])?, r_star)
    }

    /// The rest at 1/eps, t/W and nu = `scales`: it depends on R* alone.
    pub(super) fn along_radii(&self, scales: [f64; 3]) -> Result<AlongRadii, HingeFault> {
        thread_local! {
            static LAST: RefCell<PartialSums> = RefCell::default();
        }
        let grid_place = place(scales)?;
        Ok(LAST.with_borrow_mut(|last| self.rest.along_radii(grid_place, last)))
    }

    /// The moment of the hinge that rests as `rest` around that: the same arguments and ranges as [`SectionTable::entry`].
    ///
    /// # Errors
    /// The errors of [`SectionTable::entry`].
    pub fn moment(&self, scales: [f64; 3], r_star: f64, rest: &SectionEntry) -> Result<Moment, HingeFault> {
        thread_local! {
            static LAST: RefCell<PartialSums> = RefCell::default();
        }
        check_r_star(r_star, MOST_TABLED_R_STAR)?;
        let grid_place = place(scales)?;
        let series = LAST.with_borrow_mut(|last| self.moment.along_radii(grid_place, last));
        let secants = series.quantities(place_of_radius(r_star));
        Ok(Moment { lambda: rest.lambda, stiffness: rest.stiffness, secants })
    }
}

impl SectionEntry {
    /// The hinge at rest at R*, by the `series` of its fabric, width and pressure.
    pub(super) fn new(series: &AlongRadii, r_star: f64) -> Result<Self, HingeFault> {
        check_r_star(r_star, MOST_TABLED_R_STAR)?;
        let [lambda, stiffness, opening, width] = series.quantities(place_of_radius(r_star));
        Ok(Self {
            lambda: 1.0 + libm::exp(lambda),
            stiffness: libm::exp(stiffness),
            opening: libm::exp(opening),
            width,
        })
    }
}

/// One line of the table: four orders, and the coefficients of rest and moment in millionths.
fn term(line: &str) -> Option<([usize; 4], [Quantities; 2])> {
    let mut words = line.split_ascii_whitespace();
    let mut orders = [0; 4];
    for order in &mut orders {
        *order = words.next()?.parse().ok()?;
    }
    let mut coefficients = [Quantities::default(); 2];
    for c in coefficients.as_flattened_mut() {
        *c = 1e-6 * f64::from(words.next()?.parse::<i32>().ok()?);
    }
    Some((orders, coefficients))
}

/// Largest b of the series at `tau`: sqrt(2) beyond where p W / Y = 0.1 and b = 1e4 meet, less away from there.
fn most_bendability(tau: f64) -> f64 {
    std::f64::consts::SQRT_2 / libm::hypot(1e-4, 10.0 * tau * tau)
}

/// b, tau, R* and nu at a place in the four dimensions, each 0 to 1: where the series are made.
pub fn hinge_at([b, tau, r_star, poisson]: [f64; 4]) -> [f64; 4] {
    let tau = TAU[0] * libm::pow(TAU[1] / TAU[0], tau);
    let bendability = 10.0 * libm::pow(most_bendability(tau) / 10.0, b);
    let r_star = SHARPEST * libm::expm1(libm::log1p(MOST_TABLED_R_STAR / SHARPEST) * r_star);
    [bendability, tau, r_star, 0.49 * poisson]
}

/// Position of a hinge in nu, tau and b, each 0 to 1.
fn place([bendability, thickness, poisson]: [f64; 3]) -> Result<[f64; 3], HingeFault> {
    let _ = Section::new(bendability, thickness, poisson)?;
    let tau = thickness / (12.0 * (1.0 - poisson * poisson)).sqrt();
    Ok([
        poisson / 0.49,
        libm::log(tau / TAU[0]) / libm::log(TAU[1] / TAU[0]),
        libm::log(bendability / 10.0) / libm::log(most_bendability(tau) / 10.0),
    ])
}

/// Position of a hinge in R*, 0 to 1.
fn place_of_radius(r_star: f64) -> f64 {
    libm::log1p(r_star / SHARPEST) / libm::log1p(MOST_TABLED_R_STAR / SHARPEST)
}
