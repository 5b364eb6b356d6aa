//! The interpolation of one kind of residual: kernels, weights, and the weights without a star.

use crate::residuals::sample::ResidualSample;
use inflatable::mechanics::star::residuals::{LENGTHS, OPENINGS, StarPlace, kernel};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use std::ops::Range;

/// Standard deviations of the residuals: of angle (rad), radius (W / sin(pi/n)), stiffness and force (logarithms).
const SCALES: [f64; 4] = [0.033, 0.02, 0.16, 0.21];
/// Part of a residual that is no smooth function of the ratios, over its scale.
const NUGGET: f64 = 0.1;
/// Standard deviation of a number of a shell over its mesh error.
const MESH: f64 = 0.5;
/// Length of the forces' kernel along the logarithm of the opening.
const ALONG_OPENING: f64 = 1.5;

/// One residual of a star.
struct ResidualRow {
    /// Numbers of the star and of the opening.
    star: usize,
    opening: usize,
    value: f64,
    /// Variance of its noise, over the square of its scale.
    noise: f64,
}

/// Residuals of one kind.
pub struct ResidualRows {
    pub(super) places: Vec<StarPlace>,
    lengths: StarPlace,
    all: Vec<ResidualRow>,
}

impl ResidualRows {
    /// The residuals `numbers` these numbers, in the order of the weights, of `samples`.
    pub fn new(samples: &[ResidualSample], numbers: Range<usize>, lengths: &StarPlace) -> Self {
        let scale = SCALES[numbers.start];
        let pairs = (0..samples.len()).flat_map(|star| numbers.clone().map(move |which| (star, which)));
        let rows = pairs.filter_map(|(star, which)| {
            let (value, error) = samples[star].residuals[which]?;
            let noise = NUGGET.powi(2) + (MESH * error / scale).powi(2);
            Some(ResidualRow { star, opening: which - numbers.start, value, noise })
        });
        Self {
            places: samples.iter().map(|sample| sample.place).collect(),
            lengths: *lengths,
            all: rows.collect(),
        }
    }

    /// These rows without those of a star.
    #[must_use]
    pub fn without_star(mut self, star: usize) -> Self {
        self.all.retain(|row| row.star != star);
        self
    }

    fn values(&self) -> DVector<f64> {
        DVector::from_iterator(self.all.len(), self.all.iter().map(|row| row.value))
    }

    fn factor(&self) -> Option<Cholesky<f64, Dyn>> {
        let entry = |i: usize, j: usize| {
            let (first, other) = (&self.all[i], &self.all[j]);
            let noise = if i == j { first.noise } else { 0.0 };
            let places = [&self.places[first.star], &self.places[other.star]];
            place_kernel(places, &self.lengths) * opening_kernel([first.opening, other.opening]) + noise
        };
        Cholesky::new(DMatrix::from_fn(self.all.len(), self.all.len(), entry))
    }

    /// Minus the logarithm of the marginal likelihood, with the scale that makes it least (Rasmussen and Williams, eq. 2.30), without
    /// what is the same for all lengths.
    pub(super) fn unlikelihood(&self) -> f64 {
        let Some(factor) = self.factor() else { return f64::INFINITY };
        let values = self.values();
        let count = f64::from(u32::try_from(values.len()).unwrap_or(u32::MAX));
        let logarithms: f64 = factor.l_dirty().diagonal().iter().map(|entry| entry.ln()).sum();
        logarithms + 0.5 * count * values.dot(&factor.solve(&values)).ln()
    }
}

/// k between two places.
pub(super) fn place_kernel([first, other]: [&StarPlace; 2], lengths: &StarPlace) -> f64 {
    let scaled_square = |i: usize| ((first[i] - other[i]) / lengths[i]).powi(2);
    kernel((0..first.len()).map(scaled_square).sum())
}

/// The kernel between two openings.
fn opening_kernel([first, other]: [usize; 2]) -> f64 {
    let distance = (OPENINGS[first] / OPENINGS[other]).ln() / ALONG_OPENING;
    (-0.5 * distance * distance).exp()
}

/// The interpolation of one kind of residual: by kernels around the centres, of forces also around each opening, with the weights of least
/// squares (the subset of regressors of Rasmussen and Williams, eq. 8.14).
pub struct SolvedResiduals {
    rows: ResidualRows,
    centres: Vec<StarPlace>,
    /// How many openings there are: 1 where there is no opening.
    openings: usize,
    /// Kernels of the rows, a row each.
    kernels: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    /// A weight for each centre and opening.
    pub weights: DVector<f64>,
}

impl SolvedResiduals {
    /// Of `rows`, around the stars `centres`.
    ///
    /// # Errors
    /// If stars are the same.
    pub fn new(rows: ResidualRows, centres: &[usize]) -> Result<Self, &'static str> {
        let centres: Vec<StarPlace> = centres.iter().map(|star| rows.places[*star]).collect();
        let openings = 1 + rows.all.iter().map(|row| row.opening).max().unwrap_or(0);
        let count = centres.len() * openings;
        let kernel_at = |place: &StarPlace, opening: usize, basis: usize| {
            place_kernel([place, &centres[basis / openings]], &LENGTHS)
                * opening_kernel([opening, basis % openings])
        };
        let kernels = DMatrix::from_fn(rows.all.len(), count, |row, basis| {
            let ResidualRow { star, opening, .. } = rows.all[row];
            kernel_at(&rows.places[star], opening, basis)
        });
        let mut weighted = kernels.clone();
        for (mut row, own) in weighted.row_iter_mut().zip(&rows.all) {
            row /= own.noise;
        }
        let prior = DMatrix::from_fn(count, count, |one, other| {
            kernel_at(&centres[one / openings], one % openings, other)
        });
        let factor = Cholesky::new(prior + kernels.tr_mul(&weighted)).ok_or("stars are the same")?;
        let weights = factor.solve(&weighted.tr_mul(&rows.values()));
        Ok(Self { rows, centres, openings, kernels, factor, weights })
    }

    /// The residual at `place` and at an opening, by `weights`.
    pub(super) fn residual(&self, place: &StarPlace, weights: &DVector<f64>, opening: usize) -> f64 {
        let weighted = |(centre, near_to): (usize, &StarPlace)| {
            place_kernel([place, near_to], &LENGTHS) * self.along_opening(weights, centre, opening)
        };
        self.centres.iter().enumerate().map(weighted).sum()
    }

    /// The weight of a centre in the residual at an opening.
    pub(super) fn weight_of(&self, centre: usize, opening: usize) -> f64 {
        self.along_opening(&self.weights, centre, opening)
    }

    fn along_opening(&self, weights: &DVector<f64>, centre: usize, opening: usize) -> f64 {
        (0..self.openings)
            .map(|own| weights[centre * self.openings + own] * opening_kernel([opening, own]))
            .sum()
    }

    /// The weights without the rows of a star: of errors e of its rows, whose part H of the fit is their own, others leave
    /// `(1 - H)^-1 e`.
    pub fn weights_without(&self, star: usize) -> DVector<f64> {
        let rows = &self.rows.all;
        let star_rows: Vec<usize> = (0..rows.len()).filter(|row| rows[*row].star == star).collect();
        if star_rows.is_empty() {
            return self.weights.clone();
        }
        let kernels = self.kernels.select_rows(&star_rows);
        let noises = DVector::from_iterator(star_rows.len(), star_rows.iter().map(|row| rows[*row].noise));
        let values = DVector::from_iterator(star_rows.len(), star_rows.iter().map(|row| rows[*row].value));
        let mut moves = self.factor.solve(&kernels.transpose());
        for (mut column, noise) in moves.column_iter_mut().zip(&noises) {
            column /= *noise;
        }
        let smoothing = DMatrix::identity(star_rows.len(), star_rows.len()) - &kernels * &moves;
        let errors = smoothing.lu().solve(&(values - kernels * &self.weights));
        errors.map_or_else(|| self.weights.clone(), |errors| &self.weights - moves * errors)
    }
}
