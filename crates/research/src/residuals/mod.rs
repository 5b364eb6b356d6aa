//! Makes the table of residuals of `inflatable`: the weights of the computed stars, and what all others give for each of them.
//!
//! Residuals count from the closed forms. Those of the radius, the stiffness and the forces also count from the angle that the
//! interpolation gives, because a star is as wide as its angle makes it.

pub mod regression;
pub mod sample;

use self::regression::{ResidualRows, SolvedResiduals, place_kernel};
use self::sample::{ResidualSample, sample};
use crate::sha256;
use crate::stars::computed::ComputedStar;
use crate::stars::draw::{DrawnStar, Set};
use inflatable::mechanics::star::residuals::{LENGTHS, Residuals, StarPlace, WEIGHTS};
use std::array::from_fn;
use std::fmt::Write;

/// Stars that get a weight; all others count in it.
const CENTRES: usize = 216;

/// The weights of the centres, and what is found without each star.
pub struct FittedStars {
    centres: Vec<(StarPlace, [f64; WEIGHTS])>,
    /// The residuals of each star as all others give them.
    pub left_out: Vec<(DrawnStar, Residuals)>,
}

/// Whether the table counts star `number` of `set`. Others are for its validation: stars 361 on of the set `test`, and 41 on of the sets `wide`
/// and `narrow`.
pub fn is_used(set: Set, number: u32) -> bool {
    match set {
        Set::Fit | Set::Range | Set::Paper => true,
        Set::Test => number <= 360,
        Set::Wide | Set::Narrow => number <= 40,
    }
}

/// The interpolation of `stars`, of those that are used.
///
/// # Errors
/// If stars are the same.
pub fn fitted(stars: &[ComputedStar]) -> Result<FittedStars, &'static str> {
    let (table_stars, samples) = stars_with_samples(stars);
    let places: Vec<StarPlace> = samples.iter().map(|sample| sample.place).collect();
    let centres = spread(&places);
    let solved = |samples: &[ResidualSample], of| {
        SolvedResiduals::new(ResidualRows::new(samples, of, &LENGTHS), &centres)
    };
    let angles = solved(&samples, 0..1)?;
    let moved = |(star, place): (&&ComputedStar, &StarPlace)| {
        sample(star, angles.residual(place, &angles.weights, 0))
    };
    let samples: Vec<ResidualSample> = table_stars.iter().zip(&places).filter_map(moved).collect();
    let solved_kind = |which| solved(&samples, which);
    let kinds = [angles, solved_kind(1..2)?, solved_kind(2..3)?, solved_kind(3..WEIGHTS)?];
    // Residuals and weights in their order: one of angle, radius and stiffness each, and one for each opening.
    let place_of = |which: usize| if which < 3 { (which, 0) } else { (3, which - 3) };
    let weights = |centre: usize| {
        from_fn(|which| {
            let (kind, opening) = place_of(which);
            kinds[kind].weight_of(centre, opening)
        })
    };
    let left_out = table_stars.iter().enumerate().map(|(star, one)| {
        let weights = kinds.each_ref().map(|kind| kind.weights_without(star));
        let [angle, radius, stiffness, force @ ..]: [f64; WEIGHTS] = from_fn(|which| {
            let (kind, opening) = place_of(which);
            kinds[kind].residual(&places[star], &weights[kind], opening)
        });
        (one.star, Residuals { angle, radius, stiffness, force })
    });
    let left_out = left_out.collect();
    let of_centres = centres.iter().enumerate().map(|(centre, star)| (places[*star], weights(centre)));
    Ok(FittedStars { centres: of_centres.collect(), left_out })
}

/// The stars among `places` that serve as centres: each the one that is worst interpolated from those before it (a pivoted Cholesky
/// factor of the kernel).
fn spread(places: &[StarPlace]) -> Vec<usize> {
    let mut variances = vec![1.0_f64; places.len()];
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut centres = Vec::new();
    while centres.len() < CENTRES.min(places.len()) {
        let Some((pivot, root)) = variances
            .iter()
            .enumerate()
            .max_by(|one, other| one.1.total_cmp(other.1))
            .map(|(i, variances)| (i, variances.sqrt()))
        else {
            break;
        };
        let entry = |row: usize| {
            let product: f64 = columns.iter().map(|column| column[row] * column[pivot]).sum();
            (place_kernel([&places[row], &places[pivot]], &LENGTHS) - product) / root
        };
        let column: Vec<f64> = (0..places.len()).map(entry).collect();
        for (variances, entry) in variances.iter_mut().zip(&column) {
            *variances -= entry * entry;
        }
        variances[pivot] = f64::NEG_INFINITY;
        columns.push(column);
        centres.push(pivot);
    }
    centres
}

/// The lengths of the most likely interpolation of `stars`, by steps along one after the other.
pub fn likeliest(stars: &[ComputedStar]) -> StarPlace {
    let (_, samples) = stars_with_samples(stars);
    let (mut best, mut step) = (LENGTHS, [1.5_f64; LENGTHS.len()]);
    let mut smallest = unlikelihood(&samples, &best);
    while step.iter().any(|step| *step > 1.02) {
        for i in 0..best.len() {
            let trials = [step[i], 1.0 / step[i]].map(|factor| {
                let mut lengths = best;
                lengths[i] *= factor;
                (unlikelihood(&samples, &lengths), lengths)
            });
            match trials.into_iter().min_by(|one, other| one.0.total_cmp(&other.0)) {
                Some((unlikelihood, lengths)) if unlikelihood < smallest => {
                    (smallest, best) = (unlikelihood, lengths);
                }
                _ => step[i] = step[i].sqrt(),
            }
        }
    }
    best
}

fn unlikelihood(samples: &[ResidualSample], lengths: &StarPlace) -> f64 {
    [0..1, 1..2, 2..3, 3..WEIGHTS]
        .map(|of| ResidualRows::new(samples, of, lengths).unlikelihood())
        .iter()
        .sum()
}

/// The stars of the table among `stars` for which there are a shell and a prediction, with their residuals beyond the closed forms.
fn stars_with_samples(stars: &[ComputedStar]) -> (Vec<&ComputedStar>, Vec<ResidualSample>) {
    let of_table = stars.iter().filter(|one| is_used(one.star.set, one.star.number));
    of_table.filter_map(|star| Some((star, sample(star, 0.0)?))).unzip()
}

impl FittedStars {
    /// The table as it is shipped.
    pub fn table(&self) -> String {
        let mut body = String::new();
        for (place, weights) in &self.centres {
            let numbers: Vec<String> = place.iter().map(|ratio| format!("{ratio:.5}")).collect();
            let weights: Vec<String> = weights.iter().map(|weight| format!("{weight:.6}")).collect();
            let _ = writeln!(body, "{} {}", numbers.join(" "), weights.join(" "));
        }
        let hash = sha256(&body);
        format!(
            "# Residuals of computed stars; read by crates/inflatable/src/mechanics/star/residuals.rs.\n\
             # Made by `cargo run --release -p research -- residuals`. SHA-256 of the lines below: {hash}\n\
             # ln(l/W), R_i*, R_e*, phi_i0 rad, ln(p W / Y), ln(1/eps), sin(pi/n); weights of angle, radius, stiffness, and force at \
             three openings.\n{body}"
        )
    }
}
