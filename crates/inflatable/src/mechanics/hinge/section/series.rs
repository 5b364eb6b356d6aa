//! Chebyshev series of four quantities over four dimensions: summed over nu and tau together, then over 1/eps, and over R* last.
//!
//! Designs that follow one another in a study often share fabric and pressure, so each thread keeps the sums of its last hinge
//! and begins at the first one that changed. The order of summation is always the same, so an answer does not depend on earlier calls.

use crate::numerics::single;
use std::array::from_fn;
use std::ops::{Add, Mul};
use wide::{f32x4, f64x2};

/// Points of each series: 1/eps, tau, R*, nu.
const COUNTS: [usize; 4] = [11, 7, 9, 3];
/// Numbers of one nu and tau: the orders of 1/eps and R* and the quantities, the first one slowest.
const OF_FABRIC: usize = COUNTS[0] * OF_PRESSURE;
/// Numbers of one nu, tau and 1/eps.
const OF_PRESSURE: usize = COUNTS[2] * 4;
/// Sums that are taken at a time: so many registers.
const REGISTERS: usize = 9;
/// Orders of nu and tau in which nu has an influence.
const WITH_NU: usize = (COUNTS[3] - 1) * COUNTS[1];

/// The quantities, or their coefficients of one order.
pub(super) type Quantities = [f64; 4];

/// The coefficients of four quantities, in the order in which they are read. Those of nu are small, so that single precision is enough.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Series {
    /// By the orders of tau: the mean over nu.
    mean: Vec<[[f64x2; REGISTERS]; COUNTS[1]]>,
    /// By the orders of nu and tau, the first one slowest.
    with_nu: Vec<[[f32x4; REGISTERS]; WITH_NU]>,
}

/// A series at one nu, tau and 1/eps: the coefficients of R*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AlongRadii([f64; OF_PRESSURE]);

/// The partial sums of the last hinge.
#[derive(Debug)]
pub(super) struct PartialSums {
    /// nu, tau and 1/eps, each 0 to 1; NaN before the first hinge.
    places: [f64; 3],
    of_fabric: Box<[f64; OF_FABRIC]>,
    of_pressure: [f64; OF_PRESSURE],
}

impl Default for PartialSums {
    fn default() -> Self {
        Self { places: [f64::NAN; 3], of_fabric: Box::new([0.0; OF_FABRIC]), of_pressure: [0.0; OF_PRESSURE] }
    }
}

impl Series {
    /// A series of `terms`: the orders of 1/eps, tau, R* and nu, and the coefficients; the others are 0. `None` if an order is too high.
    pub(super) fn from_terms(terms: impl IntoIterator<Item = ([usize; 4], Quantities)>) -> Option<Self> {
        let [of_b, of_tau, of_r, of_nu] = COUNTS;
        let mut dense = vec![[Quantities::default(); OF_FABRIC / 4]; of_nu * of_tau];
        for ([b, tau, r, nu], own) in terms {
            if b >= of_b || tau >= of_tau || r >= of_r || nu >= of_nu {
                return None;
            }
            dense[nu * of_tau + tau][b * of_r + r] = own;
        }
        let number = |fabric: usize, i: usize| dense[fabric].as_flattened()[i];
        let pair = |fabric, i| f64x2::new(from_fn(|lane| number(fabric, 2 * i + lane)));
        let four = |fabric, i| f32x4::new(from_fn(|lane| single(number(fabric, 4 * i + lane))));
        let mean = (0..OF_FABRIC / 2 / REGISTERS)
            .map(|block| from_fn(|tau| from_fn(|i| pair(tau, block * REGISTERS + i))));
        let with_nu = (0..OF_FABRIC / 4 / REGISTERS)
            .map(|block| from_fn(|k| from_fn(|i| four(of_tau + k, block * REGISTERS + i))));
        Some(Self { mean: mean.collect(), with_nu: with_nu.collect() })
    }

    /// The series in R* at nu, tau and 1/eps = `places`, each 0 to 1; `last` are sums of this series.
    pub(super) fn along_radii(&self, places: [f64; 3], last: &mut PartialSums) -> AlongRadii {
        let [nu, tau, b] = places;
        let [nu_changed, tau_changed, b_changed] =
            from_fn(|i| last.places[i].to_bits() != places[i].to_bits());
        let fabric_changed = nu_changed || tau_changed;
        let pressure_changed = fabric_changed || b_changed;
        last.places = places;
        if fabric_changed {
            self.sum_over_fabrics([nu, tau], &mut last.of_fabric);
        }
        if pressure_changed {
            last.of_pressure = sum::<{ COUNTS[0] }, OF_PRESSURE>(last.of_fabric.as_slice(), b);
        }
        AlongRadii(last.of_pressure)
    }

    fn sum_over_fabrics(&self, [nu, tau]: [f64; 2], quantities: &mut [f64; OF_FABRIC]) {
        let (nu, tau) = (polynomials::<{ COUNTS[3] }>(nu), polynomials::<{ COUNTS[1] }>(tau));
        // The first polynomial is 1.
        let mean = tau.map(f64x2::splat);
        let with_nu: [_; WITH_NU] =
            from_fn(|k| f32x4::splat(single(nu[1 + k / COUNTS[1]] * tau[k % COUNTS[1]])));
        for (part, block) in quantities.chunks_exact_mut(2 * REGISTERS).zip(&self.mean) {
            let sums = weighted(&mean, block, f64x2::ZERO).map(f64x2::to_array);
            part.copy_from_slice(sums.as_flattened());
        }
        for (part, block) in quantities.chunks_exact_mut(4 * REGISTERS).zip(&self.with_nu) {
            let sums = weighted(&with_nu, block, f32x4::ZERO).map(f32x4::to_array);
            part.iter_mut().zip(sums.as_flattened()).for_each(|(quantity, sum)| *quantity += f64::from(*sum));
        }
    }
}

/// The sums of `numbers` with `weights`.
fn weighted<T: Copy + Add<Output = T> + Mul<Output = T>, const N: usize>(
    weights: &[T; N],
    numbers: &[[T; REGISTERS]; N],
    zero: T,
) -> [T; REGISTERS] {
    let mut sums = [zero; REGISTERS];
    // In place, so that the compiler keeps the sums in registers; a new array each time took twice as long.
    for (weight, own) in weights.iter().zip(numbers) {
        for (sum, number) in sums.iter_mut().zip(own) {
            *sum = *sum + *weight * *number;
        }
    }
    sums
}

impl AlongRadii {
    /// The quantities at R* = `place`, 0 to 1.
    pub(super) fn quantities(&self, place: f64) -> Quantities {
        sum::<{ COUNTS[2] }, 4>(&self.0, place)
    }
}

/// Sums `coefficients` over their slowest dimension, of `ORDERS` orders, at `place`.
fn sum<const ORDERS: usize, const LEN: usize>(coefficients: &[f64], place: f64) -> [f64; LEN] {
    let polynomials = polynomials::<ORDERS>(place);
    let (orders, _) = coefficients.as_chunks::<LEN>();
    let mut sums = [0.0; LEN];
    for (polynomial, of_order) in polynomials.iter().zip(orders) {
        sums = from_fn(|i| sums[i] + polynomial * of_order[i]);
    }
    sums
}

/// Chebyshev polynomials of 2 x - 1.
fn polynomials<const ORDERS: usize>(x: f64) -> [f64; ORDERS] {
    let y = 2.0 * x - 1.0;
    let mut values = [1.0; ORDERS];
    values[1] = y;
    for k in 2..ORDERS {
        values[k] = 2.0 * y * values[k - 1] - values[k - 2];
    }
    values
}
