//! Effect of arms on a hinge: the angle by which it coils further, and the loss of stiffness.
//!
//! At the two mouths of a hinge hoop compression is let out into the arms, so between arms it coils to `alpha = lambda
//! alpha_0 + delta tanh(alpha_0 / 45 deg)`, with delta the **arms' angle**; and their compliance, the **arms' give** g, is that of g more
//! hinge, `C = p W^3 |V_bar''| / (alpha_0 + g)`. There are no formulas for delta and g: they were taken from V-actuators
//! with arms of 4 W, computed as shells (longer arms are more compliant, with the same coiling).
//!
//! Both depend on the flat arc alpha_0, on 1/eps, on `tau = t / [W sqrt(12 (1 - nu^2))]`, so that `p W / Y = tau^2 / eps`, and on R*. The grid
//! is regular in ln tau, in `ln(R* + 0.03)` and, from [`LEAST_BENDABILITY`] to where p W / Y is 0.1, in ln(1/eps); its arcs are [`ARCS`].
//! Of more arc a hinge has the delta and g of the largest, its two mouths being apart; of less, those of the least.
//!
//! Fabric thinner than that of the grid has a coarser table at [`THIN_TAU`], of one arc. By how much it differs from the grid's edge is read between
//! its places and goes for all arcs, in proportion to the logarithm of tau.

use crate::mechanics::hinge::Arms;
use std::f64::consts::FRAC_PI_4;
use std::sync::LazyLock;

/// Flat arcs of the grid, deg.
pub const ARCS: [f64; 3] = [120.0, 60.0, 30.0];
/// tau of the grid: from t/W = 0.01 at nu = 0.39 to 0.03 at nu = 0.49. From the first on stretch ends the pressures, not 1/eps.
pub const TAUS: [f64; 3] = [3.162e-3, 5.604e-3, 9.935e-3];
/// tau of thin fabric, with a table of its own: t/W = 0.0048 at nu = 0.39. Wrinkles leave so much open there that fewer places are as good.
pub const THIN_TAU: f64 = 1.5e-3;
/// The arc of that table, deg: delta and `alpha_0 + g` of hinges with other arcs differ from the grid's edge by as much, or by the same part.
pub const THIN_ARC: f64 = ARCS[0];
/// R* of that table.
pub const THIN_R_STARS: [f64; 2] = [0.0, 0.15];
/// Pressures of that table: the last of the grid's, from 1/eps = 631 on. Below, no mesh follows the folds of so thin a sheet.
pub const THIN_PRESSURES: usize = 4;
/// How far beyond the first tau the table is still read, in logarithms: so that t/W = 0.01 at nu = 0.39 is inside.
pub const SLACK: f64 = 0.01;
/// R* of the grid.
pub const R_STARS: [f64; 6] = [0.0, 0.02, 0.06, 0.15, 0.4, 1.0];
/// Pressures of the grid.
pub const PRESSURES: usize = 6;
/// Least 1/eps.
pub const LEAST_BENDABILITY: f64 = 100.0;
/// Largest 1/eps.
pub const MOST_BENDABILITY: f64 = 1e4;
/// Largest p W / Y.
const MOST_STRETCH: f64 = 0.1;
/// Offset of R* before its logarithm is taken.
const SHARP: f64 = 0.03;
/// nu of the grid; others enter by tau and by lambda.
pub const POISSON: f64 = 0.39;

/// Least 1/eps that is read at [`THIN_TAU`]; at the grid's edge it is [`LEAST_BENDABILITY`], and between them follows the logarithms.
const THIN_LEAST_BENDABILITY: f64 = 400.0;
/// Largest R* that is read of thin fabric: from the last place of its table on the difference stays.
const THIN_MOST_R_STAR: f64 = 0.45;
/// By which factor beyond [`THIN_TAU`] the table is still read, as it is there.
const THINNER: f64 = 1.05;

/// The grid's values, as they are shipped.
const SHIPPED: &str = include_str!("arms.txt");
/// The values for thin fabric, as they are shipped.
const SHIPPED_THIN: &str = include_str!("arms-thin.txt");

/// Logarithms of the grid's tau and R*.
static LOGARITHMS: LazyLock<([f64; TAUS.len()], [f64; R_STARS.len()])> =
    LazyLock::new(|| (TAUS.map(libm::log), R_STARS.map(|r| libm::log(r + SHARP))));

/// Effect of arms on hinges of any arc: delta and g, rad, at each of [`ARCS`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmsByArc([[f64; 2]; ARCS.len()]);

impl ArmsByArc {
    /// The effect on a hinge with the flat arc `arc`, rad.
    pub fn arms(&self, arc: f64) -> Arms {
        let [largest_arc, .., smallest_arc] = ARCS;
        let place = arc.to_degrees().clamp(smallest_arc, largest_arc);
        // The grid's arcs fall.
        let arc_weights = weights(&ARCS.map(|arc| -arc), -place, 0.0).unwrap_or([f64::NAN; ARCS.len()]);
        let mut sum = [0.0; 2];
        for (weight, values) in arc_weights.iter().zip(&self.0) {
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        let [delta, give] = sum;
        Arms { angle: delta * libm::tanh(arc / FRAC_PI_4), give }
    }
}

/// 1/eps of the grid at one tau: regular in its logarithm.
pub fn bendabilities(tau: f64) -> [f64; PRESSURES] {
    let maximum = most_bendability(tau);
    #[expect(clippy::cast_precision_loss, reason = "a handful of pressures")]
    std::array::from_fn(|k| {
        LEAST_BENDABILITY * libm::pow(maximum / LEAST_BENDABILITY, k as f64 / (PRESSURES - 1) as f64)
    })
}

fn most_bendability(tau: f64) -> f64 {
    (MOST_STRETCH / (tau * tau)).min(MOST_BENDABILITY)
}

/// The arms of hinges at 1/eps = `bendability`, tau and R*; `None` outside of the tables.
pub fn arms(bendability: f64, tau: f64, r_star: f64) -> Option<ArmsByArc> {
    ArmsByRadius::new(bendability, tau)?.by_arc(r_star)
}

/// The arms of hinges at one 1/eps and tau, of any R*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArmsByRadius {
    grid: GridPlace,
    thin: Option<ThinPlace>,
}

/// The weights of the grid's places at one 1/eps and tau.
#[derive(Clone, Copy, Debug, PartialEq)]
struct GridPlace {
    along_tau: [f64; TAUS.len()],
    along_b: [f64; PRESSURES],
}

/// The weights of the places of the table of thin fabric at one 1/eps and tau.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ThinPlace {
    /// How thin the fabric is: from 0 at the grid's edge to 1 at [`THIN_TAU`], by its logarithm.
    part: f64,
    along_b: [f64; THIN_PRESSURES],
}

/// The least tau that the grid is read at.
fn edge() -> f64 {
    static EDGE: LazyLock<f64> = LazyLock::new(|| TAUS[0] * libm::exp(-SLACK));
    *EDGE
}

/// What thin fabric does beyond the grid's edge at each place of its table, by R* and pressure: what is added to delta, and the logarithm of the
/// factor on `alpha_0 + g`, so that stiffnesses stay above 0 whatever the arc.
type ThinDifferences = [[[f64; 2]; THIN_PRESSURES]; THIN_R_STARS.len()];

fn thin_differences() -> Option<ThinDifferences> {
    let values = read(SHIPPED_THIN)?;
    let pressures = bendabilities(THIN_TAU);
    let mut differences = ThinDifferences::default();
    let mut of_line = values.iter();
    for (by_pressure, r_star) in differences.iter_mut().zip(THIN_R_STARS) {
        for (difference, b) in by_pressure.iter_mut().zip(&pressures[PRESSURES - THIN_PRESSURES..]) {
            let (value, at_edge) = (of_line.next()?, GridPlace::new(*b, edge())?.by_arc(r_star)?);
            let [[angle, give], [angle_at_edge, give_at_edge]] = [value, &at_edge.0[0]];
            let softer = (THIN_ARC.to_radians() + give) / (THIN_ARC.to_radians() + give_at_edge);
            *difference = [angle - angle_at_edge, libm::log(softer)];
        }
    }
    // What meshes leave open of the give of a sharp hinge in thin fabric is more than the give: it is that of the round one.
    let [sharp, round] = &mut differences;
    for (one, other) in sharp.iter_mut().zip(round) {
        one[1] = other[1];
    }
    of_line.next().is_none().then_some(differences)
}

impl ArmsByRadius {
    /// The arms at 1/eps = `bendability` and tau; `None` where the tables have none of any R*.
    pub(super) fn new(bendability: f64, tau: f64) -> Option<Self> {
        let grid_edge = edge();
        // Rounding is the grid's.
        if tau >= grid_edge * (1.0 - 1e-6) {
            return Some(Self { grid: GridPlace::new(bendability, tau)?, thin: None });
        }
        let thin = ThinPlace::new(bendability, tau, grid_edge)?;
        Some(Self { grid: GridPlace::new(bendability, grid_edge)?, thin: Some(thin) })
    }

    /// The arms at R*; `None` outside of the tables.
    pub(super) fn by_arc(&self, r_star: f64) -> Option<ArmsByArc> {
        let on_grid = self.grid.by_arc(r_star)?;
        match &self.thin {
            None => Some(on_grid),
            Some(thin) => thin.by_arc(r_star, on_grid),
        }
    }
}

impl ThinPlace {
    /// The place of fabric thinner than that of the grid's edge.
    fn new(bendability: f64, tau: f64, edge: f64) -> Option<Self> {
        static PLACES: LazyLock<[f64; THIN_PRESSURES]> = LazyLock::new(|| {
            let tabled = bendabilities(THIN_TAU);
            std::array::from_fn(|k| libm::log(tabled[PRESSURES - THIN_PRESSURES + k]))
        });
        if tau.is_nan() || tau < THIN_TAU / THINNER {
            return None;
        }
        let part = (libm::log(edge / tau) / libm::log(edge / THIN_TAU)).min(1.0);
        let minimum = LEAST_BENDABILITY * libm::pow(THIN_LEAST_BENDABILITY / LEAST_BENDABILITY, part);
        if bendability < minimum {
            return None;
        }
        let along_b = weights(&PLACES, libm::log(bendability).max(PLACES[0]), 0.0)?;
        Some(Self { part, along_b })
    }

    /// `arms_on_grid`, the arms at the grid's edge, with what thin fabric changes.
    fn by_arc(&self, r_star: f64, mut arms_on_grid: ArmsByArc) -> Option<ArmsByArc> {
        static DIFFERENCES: LazyLock<Option<ThinDifferences>> = LazyLock::new(thin_differences);
        let differences = DIFFERENCES.as_ref()?;
        if r_star > THIN_MOST_R_STAR {
            return None;
        }
        let [sharp, round] = THIN_R_STARS.map(|r| libm::log(r + SHARP));
        let rounder = ((libm::log(r_star + SHARP) - sharp) / (round - sharp)).min(1.0);
        let mut sum = [0.0; 2];
        for (weight, by_pressure) in [1.0 - rounder, rounder].iter().zip(differences) {
            for (along, difference) in self.along_b.iter().zip(by_pressure) {
                sum.iter_mut().zip(difference).for_each(|(sum, d)| *sum += self.part * weight * along * d);
            }
        }
        let softer = libm::exp(sum[1]);
        for ([angle, give], arc) in arms_on_grid.0.iter_mut().zip(ARCS.map(f64::to_radians)) {
            *angle += sum[0];
            *give = softer * (arc + *give) - arc;
        }
        Some(arms_on_grid)
    }
}

impl GridPlace {
    fn new(bendability: f64, tau: f64) -> Option<Self> {
        let (taus, _) = &*LOGARITHMS;
        let along_tau = weights(taus, libm::log(tau), SLACK)?;
        let place_of_b =
            libm::log(bendability / LEAST_BENDABILITY) / libm::log(most_bendability(tau) / LEAST_BENDABILITY);
        #[expect(clippy::cast_precision_loss, reason = "a handful of pressures")]
        let places: [f64; PRESSURES] = std::array::from_fn(|k| k as f64 / (PRESSURES - 1) as f64);
        Some(Self { along_tau, along_b: weights(&places, place_of_b, 0.0)? })
    }

    /// The arms by the grid at R*; `None` outside of it.
    fn by_arc(&self, r_star: f64) -> Option<ArmsByArc> {
        static TABLE: LazyLock<Option<Vec<[[f64; 2]; ARCS.len()]>>> = LazyLock::new(by_place);
        let table = TABLE.as_ref()?;
        let (_, r_stars) = &*LOGARITHMS;
        let along_r = weights(r_stars, libm::log(r_star + SHARP), 0.0)?;
        let mut sums = [[0.0; 2]; ARCS.len()];
        for (a, of_tau) in self.along_tau.iter().zip(table.chunks_exact(R_STARS.len() * PRESSURES)) {
            for (b, of_r) in along_r.iter().zip(of_tau.chunks_exact(PRESSURES)) {
                // A weight of 0 adds nothing.
                if *a == 0.0 || *b == 0.0 {
                    continue;
                }
                for (c, point) in self.along_b.iter().zip(of_r) {
                    let weight = a * b * c;
                    let entries = sums.as_flattened_mut().iter_mut().zip(point.as_flattened());
                    entries.for_each(|(sum, value)| *sum += weight * value);
                }
            }
        }
        Some(ArmsByArc(sums))
    }
}

/// The grid's values at each place, the pressures fastest.
fn by_place() -> Option<Vec<[[f64; 2]; ARCS.len()]>> {
    let values = read(SHIPPED)?;
    let one_arc = TAUS.len() * R_STARS.len() * PRESSURES;
    let is_whole = values.len() == ARCS.len() * one_arc;
    is_whole
        .then(|| (0..one_arc).map(|place| std::array::from_fn(|arc| values[arc * one_arc + place])).collect())
}

/// Reads the lines of a table: phi_0, tau, R*, 1/eps, then in deg delta, its mesh error, g and its mesh error; returns delta and g.
fn read(text: &str) -> Option<Vec<[f64; 2]>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let numbers = lines.map(|line| {
        let words: Option<Vec<f64>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
        let [_, _, _, _, delta, _, give, _] = words?[..] else { return None };
        Some([delta, give].map(f64::to_radians))
    });
    numbers.collect()
}

/// The weights of the places in the cubic through the four around `x`, or in the parabola through all three; `None` where `x` is
/// more than `slack` before the first or beyond the last.
fn weights<const N: usize>(places: &[f64; N], x: f64, slack: f64) -> Option<[f64; N]> {
    // A value at an end within rounding, also that of a text with three decimals, is inside.
    let rounding = 1e-6 * (places[N - 1] - places[0]);
    if !(places[0] - slack - rounding..=places[N - 1] + rounding).contains(&x) {
        return None;
    }
    let count = N.min(4);
    let first = places.iter().filter(|place| **place <= x).count().saturating_sub(2).min(N - count);
    let stencil = first..first + count;
    Some(std::array::from_fn(|i| {
        if !stencil.contains(&i) {
            return 0.0;
        }
        let rest = stencil.clone().filter(|j| *j != i);
        rest.map(|j| (x - places[j]) / (places[i] - places[j])).product::<f64>()
    }))
}

#[cfg(test)]
mod tests;
