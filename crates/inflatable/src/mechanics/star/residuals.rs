//! What shells give beyond the closed forms of a star: their **residuals**, interpolated between the computed stars (kriging).
//!
//! The closed forms of [`Correction`](super::Correction) and [`Grasp`](super::grasp::Grasp) leave residuals that change smoothly from star
//! to star. A star has seven ratios z: ln(l/W), R_i*, R_e*, phi_i0, ln(p W / Y), ln(1/eps) and sin(pi/n). Some of the computed stars are
//! the centres z_j, and a residual is the sum of kernels around them:
//!
//! ```text
//! r(z) = sum_j w_j k(q_j)        q_j = sum_i [(z_i - z_ji) / L_i]^2        k(q) = (1 + q/4)^-2
//! ```
//!
//! k is the rational quadratic kernel (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, eq. 4.19, with alpha = 2): a
//! division, no exponential. A residual fades with the distance from the computed stars, and the closed form is left. The weights w_j are
//! those of least squares over all computed stars, with the kernel as the prior (eq. 8.14) and noise from the shells' mesh errors. They are
//! shipped; the research crate makes them, finds the lengths L_i by maximum likelihood, and predicts each star from all others
//! (docs/ranges.md).

use crate::mechanics::star::Mechanism;
use crate::numerics::single;
use std::array::from_fn;
use std::cell::RefCell;
use std::sync::LazyLock;
use wide::f32x8;

/// Dimensionless properties of a star's fabric at its pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratios {
    /// t/W.
    pub thickness: f64,
    /// p W / Y.
    pub stretch: f64,
    /// 1/eps = p W^3 / B.
    pub bendability: f64,
}

/// Openings by W of the stars whose forces were computed.
pub const OPENINGS: [f64; 3] = [0.15, 0.45, 0.9];
/// The ratios z of a star, in the order of the text above.
pub type StarPlace = [f64; 7];
/// L_i, in the units of z.
pub const LENGTHS: StarPlace = [0.92, 0.79, 0.54, 0.76, 2.02, 1.96, 0.28];
/// The table as it is shipped.
const SHIPPED: &str = include_str!("residuals.txt");
/// Weights of a centre: of angle, radius, stiffness, and of the force at each opening.
pub const WEIGHTS: usize = 3 + OPENINGS.len();

/// What shells give beyond the closed forms of one star.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residuals {
    /// Angle of the tips at rest, rad.
    pub angle: f64,
    /// Radius at rest, over W / sin(pi/n).
    pub radius: f64,
    /// Logarithm of the radial stiffness.
    pub stiffness: f64,
    /// Logarithm of the force on an object that opens the star by each of the [`OPENINGS`], both with the stiffness of the closed form.
    pub force: [f64; OPENINGS.len()],
}

/// Centres that the processor takes at a time; they are always added in the same order. Single precision is a hundred times finer than the table.
const LANES: usize = 8;
/// Ratios that most rows of a study share with the row before.
const SLOW: [usize; 5] = [1, 2, 4, 5, 6];
/// The other ratios.
const FAST: [usize; 2] = [0, 3];

/// So many centres.
#[derive(Clone, Copy, Debug)]
struct LaneBlock {
    /// Their [`halved`] ratios.
    slow: [f32x8; SLOW.len()],
    fast: [f32x8; FAST.len()],
    weights: [f32x8; WEIGHTS],
}

/// The last star of a thread.
#[derive(Debug, Default)]
struct LastStar {
    /// Slow ratios of the last star; none before the first star.
    slow: Option<[f32; SLOW.len()]>,
    /// 1 and its distances from the blocks in these ratios, squared.
    apart: Vec<f32x8>,
}

impl Residuals {
    /// The residuals of `star` with `ratios`.
    pub fn new(star: &Mechanism, ratios: Ratios) -> Self {
        static TABLE: LazyLock<Vec<LaneBlock>> = LazyLock::new(|| read(SHIPPED));
        thread_local! {
            static LAST: RefCell<LastStar> = RefCell::default();
        }
        LAST.with_borrow_mut(|last| Self::interpolated(&place(star, ratios), &TABLE, last))
    }

    fn interpolated(place: &StarPlace, table: &[LaneBlock], last: &mut LastStar) -> Self {
        // 1 + q/4 = 1 + (u - v)^2, u and v being the halved ratios of two places.
        let place = halved(place);
        let (slow, fast) = (SLOW.map(|i| place[i]), FAST.map(|i| place[i]));
        if last.slow != Some(slow) {
            last.slow = Some(slow);
            last.apart.clear();
            last.apart.extend(table.iter().map(|block| further(f32x8::ONE, &slow, &block.slow)));
        }
        let mut sums = [f32x8::ZERO; WEIGHTS];
        for (block, apart) in table.iter().zip(&last.apart) {
            let root = further(*apart, &fast, &block.fast);
            let kernel = f32x8::ONE / (root * root);
            sums = from_fn(|i| sums[i] + block.weights[i] * kernel);
        }
        let [angle, radius, stiffness, force @ ..] =
            sums.map(|sum| sum.to_array().iter().map(|lane| f64::from(*lane)).sum());
        Self { angle, radius, stiffness, force }
    }
}

/// `sum_of_squares` and the squared distance of `place` from `places`.
fn further<const N: usize>(sum_of_squares: f32x8, place: &[f32; N], places: &[f32x8; N]) -> f32x8 {
    place.iter().zip(places).fold(sum_of_squares, |sum_of_squares, (own, other)| {
        let difference = f32x8::splat(*own) - *other;
        sum_of_squares + difference * difference
    })
}

/// Reads the table: a centre a line, its ratios and its weights. The last block is filled up with centres without weight.
fn read(text: &str) -> Vec<LaneBlock> {
    const NUMBERS: usize = LENGTHS.len() + WEIGHTS;
    let star = |line: &str| {
        let mut numbers = line.split(' ').map(|word| word.parse().unwrap_or(f64::NAN));
        from_fn::<f64, NUMBERS, _>(|_| numbers.next().unwrap_or(f64::NAN))
    };
    let stars: Vec<[f64; NUMBERS]> = text.lines().filter(|line| !line.starts_with('#')).map(star).collect();
    let block = |stars: &[[f64; NUMBERS]]| {
        let mut lanes = [[0.0; NUMBERS]; LANES];
        lanes[..stars.len()].copy_from_slice(stars);
        let places: [[f32; LENGTHS.len()]; LANES] = lanes.map(|star| halved(&from_fn(|i| star[i])));
        LaneBlock {
            slow: SLOW.map(|i| f32x8::new(places.map(|place| place[i]))),
            fast: FAST.map(|i| f32x8::new(places.map(|place| place[i]))),
            weights: from_fn(|i| f32x8::new(from_fn(|lane| single(lanes[lane][LENGTHS.len() + i])))),
        }
    };
    stars.chunks(LANES).map(block).collect()
}

/// The ratios of `star`, with `ratios` of its fabric at its pressure.
pub fn place(star: &Mechanism, ratios: Ratios) -> StarPlace {
    [
        libm::log(star.arm / star.width),
        star.tip().r_star,
        star.corner().r_star,
        star.tip_angle,
        libm::log(ratios.stretch),
        libm::log(ratios.bendability),
        star.sector_sine(),
    ]
}

/// k of q, the square of a distance: from 1 at the same place to 0.
pub fn kernel(squared_distance: f64) -> f64 {
    let root = 1.0 + 0.25 * squared_distance;
    1.0 / (root * root)
}

/// Ratios over twice their lengths.
fn halved(place: &StarPlace) -> [f32; LENGTHS.len()] {
    from_fn(|i| single(place[i] / (2.0 * LENGTHS[i])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::tests::{flat, paper};

    const RATIOS: Ratios = Ratios { thickness: 0.01, stretch: 0.01, bendability: 1000.0 };

    /// The places and weights of the shipped table.
    fn shipped() -> Vec<(StarPlace, [f64; WEIGHTS])> {
        let star = |line: &str| {
            let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().expect("a number")).collect();
            assert_eq!(numbers.len(), LENGTHS.len() + WEIGHTS);
            (from_fn(|i| numbers[i]), from_fn(|i| numbers[LENGTHS.len() + i]))
        };
        SHIPPED.lines().filter(|line| !line.starts_with('#')).map(star).collect()
    }

    #[test]
    fn they_are_the_sum_of_the_weights_by_distance() {
        let table = shipped();
        let sharp = paper(5);
        for star in [sharp, flat(0.05, Mechanism { tip_radius: 0.004, corner_radius: 0.002, ..paper(7) })] {
            let star_place = place(&star, RATIOS);
            let mut sums = [0.0; WEIGHTS];
            for (other, weights) in &table {
                let squared_distance: f64 =
                    (0..star_place.len()).map(|i| ((star_place[i] - other[i]) / LENGTHS[i]).powi(2)).sum();
                for (sum, weight) in sums.iter_mut().zip(weights) {
                    *sum += weight * kernel(squared_distance);
                }
            }
            let Residuals { angle, radius, stiffness, force } = Residuals::new(&star, RATIOS);
            let residuals = [angle, radius, stiffness, force[0], force[1], force[2]];
            assert!(
                residuals.iter().zip(sums).all(|(residuals, sum)| (residuals - sum).abs() < 3e-6),
                "{residuals:?} {sums:?}"
            );
            assert!(sums.iter().any(|sum| sum.abs() > 1e-3));
        }
    }

    #[test]
    fn they_do_not_depend_on_the_star_before() {
        let five_points = paper(5);
        let first = Residuals::new(&five_points, RATIOS);
        let like_it = Mechanism { tip_angle: 0.9, ..five_points };
        for (before, ratios) in
            [(like_it, RATIOS), (paper(7), RATIOS), (five_points, Ratios { stretch: 0.02, ..RATIOS })]
        {
            assert_ne!(Residuals::new(&before, ratios), first);
            assert_eq!(Residuals::new(&five_points, RATIOS), first);
        }
    }

    #[test]
    fn they_fade_with_the_distance_from_the_computed_stars() {
        let residual_at = |bendability| {
            let Residuals { angle, radius, stiffness, force } =
                Residuals::new(&paper(5), Ratios { bendability, ..RATIOS });
            [angle, radius, stiffness, force[0]].into_iter().map(f64::abs).fold(0.0, f64::max)
        };
        assert!(residual_at(1e12) < 0.1 * residual_at(1e3), "{} {}", residual_at(1e12), residual_at(1e3));
        assert_eq!(residual_at(f64::INFINITY), 0.0);
        assert_eq!([kernel(0.0), kernel(4.0)], [1.0, 0.25]);
    }

    #[test]
    fn all_lengths_scale_together() {
        let unscaled = flat(0.05, Mechanism { tip_radius: 0.002, ..paper(5) });
        let Mechanism { arm, width, tip_radius, .. } = unscaled;
        let two = Mechanism { arm: 2.0 * arm, width: 2.0 * width, tip_radius: 2.0 * tip_radius, ..unscaled };
        assert_eq!(Residuals::new(&unscaled, RATIOS), Residuals::new(&two, RATIOS));
    }
}
