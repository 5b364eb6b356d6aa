//! Chebyshev series of four quantities over four dimensions, summed over one dimension after the other: nu, tau, 1/eps, and R* last.
//!
//! Designs that follow one another in a study often share fabric and pressure, so each thread keeps the sums of its last hinge
//! and begins at the first dimension that changed. The order of summation is always the same, so an answer does not depend on earlier calls.

/// Points of each series: 1/eps, tau, R*, nu.
const COUNTS: [usize; 4] = [11, 7, 9, 3];

/// The quantities, or their coefficients of one order.
pub(super) type Quantities = [f64; 4];

/// The coefficients of four quantities.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Series {
    /// By the orders of nu, tau, 1/eps and R*, the first one slowest: each sum takes the slowest that is left.
    coefficients: Vec<f64>,
}

/// A series at one nu, tau and 1/eps: the coefficients of R*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AlongRadii([Quantities; COUNTS[2]]);

/// The partial sums of the last hinge: over nu; over nu and tau; over nu, tau and 1/eps.
#[derive(Debug, Default)]
pub(super) struct PartialSums {
    /// The place of the sums: nu, tau and 1/eps, each 0 to 1.
    places: [f64; 3],
    sums: [Vec<f64>; 3],
}

impl Series {
    /// A series of `terms`: the orders of 1/eps, tau, R* and nu, and the coefficients; the others are 0. `None` if an order is too high.
    pub(super) fn of(terms: impl IntoIterator<Item = ([usize; 4], Quantities)>) -> Option<Self> {
        let [of_b, of_tau, of_r, of_nu] = COUNTS;
        let mut coefficients = vec![Quantities::default(); of_b * of_tau * of_r * of_nu];
        for ([b, tau, r, nu], own) in terms {
            *coefficients.get_mut(((nu * of_tau + tau) * of_b + b) * of_r + r)? = own;
        }
        Some(Self { coefficients: coefficients.into_flattened() })
    }

    /// The series in R* at nu, tau and 1/eps = `places`, each 0 to 1; `last` are sums of this series.
    pub(super) fn along_radii(&self, places: [f64; 3], last: &mut PartialSums) -> AlongRadii {
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        let unchanged = if last.sums[2].is_empty() {
            0
        } else {
            last.places.iter().zip(&places).take_while(|pair| same(*pair)).count()
        };
        last.places = places;
        for (dimension, place) in places.into_iter().enumerate().skip(unchanged) {
            let (before, own) = last.sums.split_at_mut(dimension);
            let all = before.last().map_or(self.coefficients.as_slice(), Vec::as_slice);
            let own = &mut own[0];
            own.resize(all.len() / [COUNTS[3], COUNTS[1], COUNTS[0]][dimension], 0.0);
            match dimension {
                0 => sum::<{ COUNTS[3] }>(all, place, own),
                1 => sum::<{ COUNTS[1] }>(all, place, own),
                _ => sum::<{ COUNTS[0] }>(all, place, own),
            }
        }
        let mut series = [Quantities::default(); COUNTS[2]];
        series.as_flattened_mut().copy_from_slice(&last.sums[2]);
        AlongRadii(series)
    }
}

impl AlongRadii {
    /// The quantities at R* = `place`, 0 to 1.
    pub(super) fn at(&self, place: f64) -> Quantities {
        let mut own = Quantities::default();
        sum::<{ COUNTS[2] }>(self.0.as_flattened(), place, &mut own);
        own
    }
}

/// Sums `coefficients` over their slowest dimension, of `ORDERS` orders, at `place` into `out`, which has the length of one order.
fn sum<const ORDERS: usize>(coefficients: &[f64], place: f64, out: &mut [f64]) {
    let polynomials = polynomials::<ORDERS>(place);
    let len = out.len();
    let of_order: [&[f64]; ORDERS] = std::array::from_fn(|k| &coefficients[k * len..(k + 1) * len]);
    for (i, out) in out.iter_mut().enumerate() {
        // The first polynomial is 1.
        let mut sum = of_order[0][i];
        for k in 1..ORDERS {
            sum += polynomials[k] * of_order[k][i];
        }
        *out = sum;
    }
}

/// Chebyshev polynomials of 2 x - 1.
fn polynomials<const ORDERS: usize>(x: f64) -> [f64; ORDERS] {
    let y = 2.0 * x - 1.0;
    let mut own = [1.0; ORDERS];
    own[1] = y;
    for k in 2..ORDERS {
        own[k] = 2.0 * y * own[k - 1] - own[k - 2];
    }
    own
}
