//! The section at rest, and its moment around, as one series over (1/eps, t/W, R*, nu): for microseconds.
//!
//! In `b = 1/eps`, `tau = t / [W sqrt(12 (1 - nu^2))]`, R* and nu, with `p W / Y = b tau^2`, every quantity is smooth, and its
//! Chebyshev coefficients fall fast in all four; those below 3e-5 are left out. `b` goes to a bound that falls with
//! tau, so that the series end a little beyond p W / Y = 0.1 and not far from it. R* enters by its logarithm from a
//! thousandth on, where the solver's own core begins.
//!
//! A series is summed over one dimension after the other: nu, tau, b, and R* last. Designs that follow one another in a study
//! often share fabric and pressure, so each thread keeps the sums of its last hinge, and begins at the first dimension that
//! changed. The order of summation is always the same, so an answer does not depend on earlier calls.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::check_r_star;
use crate::mechanics::hinge::section::Section;
use std::cell::RefCell;
use std::sync::LazyLock;

/// Points of each series: b, tau, R*, nu.
const COUNTS: [usize; 4] = [11, 7, 9, 3];
/// Number of quantities.
const QUANTITIES: usize = 8;
/// tau at the ends of the series: t/W = 0.003 at nu = 0, and 0.03 at 0.49.
const TAU: [f64; 2] = [8.660_254e-4, 9.934_52e-3];
/// Largest R*: that of stars and actuators. The solver goes further.
pub(super) const MOST_TABLED_R_STAR: f64 = 3.0;
/// R* below which nothing changes any more.
const SHARPEST: f64 = 1e-3;
/// Places of the moment's samples, as parts of lambda_t - 1 from lambda_t: from the flat angle to as far beyond.
pub const OFFSETS: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];

/// The series, as they are shipped.
const SHIPPED: &str = include_str!("table.txt");

/// The section's table.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionTable {
    /// The coefficients of the eight quantities by the orders of R*, b, tau and nu, the last one fastest: in each sum the next
    /// dimension is the last one.
    coefficients: Vec<Quantities>,
}

/// The series at one fabric, width and pressure: the rest depends on R* alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiusSeries([Quantities; COUNTS[2]]);

/// The partial sums of the last hinge: over nu; over nu and tau; over nu, tau and b.
#[derive(Debug, Default)]
struct PartialSums {
    /// The place of the sums: nu, tau and b, each 0 to 1.
    places: [f64; 3],
    sums: [Vec<Quantities>; 3],
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
    /// Logarithms of the secant stiffness over the stiffness, at [`OFFSETS`].
    secants: [f64; 4],
}

/// The eight smooth quantities: logarithms of those that span decades.
type Quantities = [f64; QUANTITIES];

impl SectionEntry {
    /// dV_bar/dlambda at `lambda`: the closing moment over p W^3. Between the flat angle and as far beyond the rest.
    pub fn slope(&self, lambda: f64) -> f64 {
        let away = lambda - self.lambda;
        let x = away / (self.lambda - 1.0);
        -away * self.stiffness * libm::exp(self.secant(x))
    }

    /// d2V_bar/dlambda2 at `lambda`, in the same range.
    pub fn curvature(&self, lambda: f64) -> f64 {
        let away = lambda - self.lambda;
        let x = away / (self.lambda - 1.0);
        -self.stiffness * libm::exp(self.secant(x)) * (1.0 + x * self.secant_slope(x))
    }

    /// The derivative of the quartic by x.
    fn secant_slope(&self, x: f64) -> f64 {
        let term = |i: usize| {
            let others = OFFSETS.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, at)| *at);
            // The product over the roots, 0 among them, and its derivative.
            let (_, slope) = std::iter::once(0.0).chain(others).fold((1.0, 0.0), |(value, slope), root| {
                let scale = OFFSETS[i] - root;
                (value * (x - root) / scale, (slope * (x - root) + value) / scale)
            });
            self.secants[i] * slope
        };
        (0..4).map(term).sum()
    }

    /// The quartic through the logarithms of the secants, which is 0 at 0.
    fn secant(&self, x: f64) -> f64 {
        let others = |i: usize| {
            let each = OFFSETS.iter().enumerate().filter(move |(j, _)| *j != i);
            each.map(move |(_, at)| (x - at) / (OFFSETS[i] - at)).product::<f64>()
        };
        (0..4).map(|i| self.secants[i] * x / OFFSETS[i] * others(i)).sum()
    }
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
        let [of_b, of_tau, of_r, of_nu] = COUNTS;
        let mut coefficients = vec![[0.0; QUANTITIES]; of_b * of_tau * of_r * of_nu];
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let ([b, tau, r, nu], own) = term(line)?;
            *coefficients.get_mut(((r * of_b + b) * of_tau + tau) * of_nu + nu)? = own;
        }
        Some(Self { coefficients })
    }

    /// The hinge at rest: the same arguments and ranges as [`Section::new`], and R* up to 3.
    ///
    /// # Errors
    /// As for [`Section::new`] and [`HingeModel::target`](crate::mechanics::hinge::HingeModel::target).
    pub fn at(
        &self,
        bendability: f64,
        thickness: f64,
        poisson: f64,
        r_star: f64,
    ) -> Result<SectionEntry, HingeFault> {
        self.along_radii(bendability, thickness, poisson)?.at(r_star)
    }

    /// The series in R* at 1/eps = `bendability`, t/W = `thickness` and nu = `poisson`.
    ///
    /// # Errors
    /// As for [`Section::new`].
    pub fn along_radii(
        &self,
        bendability: f64,
        thickness: f64,
        poisson: f64,
    ) -> Result<RadiusSeries, HingeFault> {
        thread_local! {
            static LAST: RefCell<PartialSums> = RefCell::default();
        }
        let _ = Section::new(bendability, thickness, poisson)?;
        let place = place(bendability, thickness, poisson);
        Ok(LAST.with_borrow_mut(|last| last.at(&self.coefficients, place)))
    }
}

impl PartialSums {
    /// The series in R* of `coefficients` at nu, tau and b.
    fn at(&mut self, coefficients: &[Quantities], places: [f64; 3]) -> RadiusSeries {
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        let unchanged = if self.sums[2].is_empty() {
            0
        } else {
            self.places.iter().zip(&places).take_while(|pair| same(*pair)).count()
        };
        self.places = places;
        for (dimension, place) in places.into_iter().enumerate().skip(unchanged) {
            let (before, own) = self.sums.split_at_mut(dimension);
            let all = before.last().map_or(coefficients, Vec::as_slice);
            let summed = match dimension {
                0 => summed::<{ COUNTS[3] }>,
                1 => summed::<{ COUNTS[1] }>,
                _ => summed::<{ COUNTS[0] }>,
            };
            summed(all, place, &mut own[0]);
        }
        let mut series = [[0.0; QUANTITIES]; COUNTS[2]];
        series.copy_from_slice(&self.sums[2]);
        RadiusSeries(series)
    }
}

impl RadiusSeries {
    /// The hinge at rest at R*.
    ///
    /// # Errors
    /// As for [`HingeModel::target`](crate::mechanics::hinge::HingeModel::target).
    pub fn at(&self, r_star: f64) -> Result<SectionEntry, HingeFault> {
        check_r_star(r_star, MOST_TABLED_R_STAR)?;
        let mut sum = [0.0; QUANTITIES];
        let polynomials = polynomials(place_of_radius(r_star));
        for (polynomial, coefficients) in polynomials.iter().zip(&self.0) {
            sum.iter_mut().zip(coefficients).for_each(|(sum, c)| *sum += polynomial * c);
        }
        let [lambda, stiffness, opening, width, secants @ ..] = sum;
        Ok(SectionEntry {
            lambda: 1.0 + libm::exp(lambda),
            stiffness: libm::exp(stiffness),
            opening: libm::exp(opening),
            width,
            secants,
        })
    }
}

/// Sums `coefficients` over their last dimension, of `ORDERS` orders, at `place` into `out`.
fn summed<const ORDERS: usize>(coefficients: &[Quantities], place: f64, out: &mut Vec<Quantities>) {
    let polynomials = polynomials(place);
    out.clear();
    // One sum after the other, so that it stays in registers.
    out.extend(coefficients.chunks_exact(ORDERS).map(|of_order| {
        let mut sum = [0.0; QUANTITIES];
        for (polynomial, own) in polynomials.iter().zip(of_order) {
            sum.iter_mut().zip(own).for_each(|(sum, c)| *sum += polynomial * c);
        }
        sum
    }));
}

/// One line of the table: four orders, eight coefficients in millionths.
fn term(line: &str) -> Option<([usize; 4], Quantities)> {
    let mut words = line.split_ascii_whitespace();
    let mut orders = [0; 4];
    for order in &mut orders {
        *order = words.next()?.parse().ok()?;
    }
    let mut coefficients = [0.0; QUANTITIES];
    for c in &mut coefficients {
        *c = 1e-6 * f64::from(words.next()?.parse::<i32>().ok()?);
    }
    Some((orders, coefficients))
}

/// Chebyshev polynomials of 2 x - 1.
fn polynomials(x: f64) -> [f64; 16] {
    let y = 2.0 * x - 1.0;
    let mut own = [1.0, y, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for k in 2..16 {
        own[k] = 2.0 * y * own[k - 1] - own[k - 2];
    }
    own
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
fn place(bendability: f64, thickness: f64, poisson: f64) -> [f64; 3] {
    let tau = thickness / (12.0 * (1.0 - poisson * poisson)).sqrt();
    [
        poisson / 0.49,
        libm::log(tau / TAU[0]) / libm::log(TAU[1] / TAU[0]),
        libm::log(bendability / 10.0) / libm::log(most_bendability(tau) / 10.0),
    ]
}

/// Position of a hinge in R*, 0 to 1.
fn place_of_radius(r_star: f64) -> f64 {
    libm::log1p(r_star / SHARPEST) / libm::log1p(MOST_TABLED_R_STAR / SHARPEST)
}
