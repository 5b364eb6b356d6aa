//! The weights of residuals without a star, against those of all others.

use inflatable::mechanics::star::residuals::{LENGTHS, StarPlace};
use research::residuals::regression::{ResidualRows, SolvedResiduals};
use research::residuals::sample::ResidualSample;
use std::array::from_fn;

/// Forty stars in places like those of a lattice, with three residuals each that are smooth functions of them, some missing.
fn samples() -> Vec<ResidualSample> {
    let sample = |star: u32| {
        let place: StarPlace =
            from_fn(|i| (f64::from(star) * [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0][i].sqrt()).fract());
        let value =
            |which: usize| (place[0] + 0.3 * f64::from(u32::try_from(which).unwrap_or(0))).sin() * place[5];
        let known = |which: usize| !star.is_multiple_of(5) || which != 4;
        ResidualSample { place, residuals: from_fn(|which| known(which).then(|| (0.1 * value(which), 0.01))) }
    };
    (1..=40).map(sample).collect()
}

#[test]
fn the_weights_without_a_star_are_those_of_the_others() {
    let (samples, centres) = (samples(), [1, 5, 9, 17, 22, 31]);
    for of in [0..1, 3..6] {
        let all = SolvedResiduals::new(ResidualRows::new(&samples, of.clone(), &LENGTHS), &centres)
            .expect("it is found");
        for star in [5, 20] {
            let others = ResidualRows::new(&samples, of.clone(), &LENGTHS).without_star(star);
            let expected = SolvedResiduals::new(others, &centres).expect("it is found").weights;
            let found = all.weights_without(star);
            assert!((&found - &expected).amax() < 1e-9 && (&found - &all.weights).amax() > 1e-6);
        }
    }
}
