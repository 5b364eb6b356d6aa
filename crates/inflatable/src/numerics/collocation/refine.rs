//! Residuals of the mesh's intervals, and a better mesh.

use crate::numerics::collocation::{Problem, Profile};

/// Root mean square of `(y' - f) / (1 + |f|)` on each interval, by five-point Lobatto quadrature, whose end and
/// middle points are collocation points and contribute nothing.
pub(super) fn residuals<const N: usize>(problem: &impl Problem<N>, profile: &Profile<N>) -> Vec<f64> {
    let Profile { mesh, values } = profile;
    let place = 0.5 - 0.5 * (3.0_f64 / 7.0).sqrt();
    let slopes: Vec<[f64; N]> = mesh.iter().zip(values).map(|(&x, y)| problem.slope(x, y)).collect();
    let squared_defect = |i: usize, t: f64| {
        let h = mesh[i + 1] - mesh[i];
        let (y0, y1, f0, f1) = (&values[i], &values[i + 1], &slopes[i], &slopes[i + 1]);
        let f = problem.slope(mesh[i] + t * h, &cubic([y0, y1], [f0, f1], t, h));
        let squares = (0..N).map(|k| {
            let rise = 6.0 * t * (1.0 - t) * (y1[k] - y0[k]) / h;
            let hermite_slope = rise + (1.0 - t) * (1.0 - 3.0 * t) * f0[k] + t * (3.0 * t - 2.0) * f1[k];
            ((hermite_slope - f[k]) / (1.0 + f[k].abs())).powi(2)
        });
        squares.sum::<f64>()
    };
    // Weights of the five-point rule at these two points: 49/90 each, on an interval of length 2.
    let rms = |i: usize| (49.0 / 180.0 * (squared_defect(i, place) + squared_defect(i, 1.0 - place))).sqrt();
    (0..mesh.len() - 1).map(rms).map(|r| if r.is_finite() { r } else { f64::MAX }).collect()
}

/// Splits intervals whose residual is above the tolerance, and merges pairs far below it.
pub(super) fn remesh<const N: usize>(
    problem: &impl Problem<N>,
    profile: &Profile<N>,
    residuals: &[f64],
    tolerance: f64,
) -> Profile<N> {
    let Profile { mesh, values } = profile;
    let mut next = Profile { mesh: vec![mesh[0]], values: vec![values[0]] };
    let mut is_previous_kept = true;
    for i in 0..residuals.len() {
        let (a, b) = (mesh[i], mesh[i + 1]);
        if residuals[i] > tolerance {
            // Fourth order: three parts bring it down by 81, two by 16.
            let parts: usize = if residuals[i] > 16.0 * tolerance { 3 } else { 2 };
            let [f0, f1] = [i, i + 1].map(|j| problem.slope(mesh[j], &values[j]));
            for part in 1..parts {
                #[expect(clippy::cast_precision_loss, reason = "two or three parts")]
                let t = part as f64 / parts as f64;
                let h = b - a;
                next.mesh.push(a + t * h);
                next.values.push(cubic([&values[i], &values[i + 1]], [&f0, &f1], t, h));
            }
        }
        let last = i + 1 == residuals.len();
        // Merging multiplies the residual by 16 to 81; a hundredth of the tolerance leaves room.
        let idle = !last && residuals[i] < 0.01 * tolerance && residuals[i + 1] < 0.01 * tolerance;
        let similar = !last && (mesh[i + 2] - b) < 2.0 * (b - a) && (b - a) < 2.0 * (mesh[i + 2] - b);
        if is_previous_kept && idle && similar {
            is_previous_kept = false;
        } else {
            next.mesh.push(b);
            next.values.push(values[i + 1]);
            is_previous_kept = true;
        }
    }
    next
}

/// The cubic with the values and slopes at the ends of an interval of length `h`, at its fraction `t`.
fn cubic<const N: usize>(values: [&[f64; N]; 2], slopes: [&[f64; N]; 2], t: f64, h: f64) -> [f64; N] {
    let ([y0, y1], [f0, f1], c) = (values, slopes, 1.0 - t);
    std::array::from_fn(|k| {
        c * c * ((1.0 + 2.0 * t) * y0[k] + h * t * f0[k]) + t * t * ((3.0 - 2.0 * t) * y1[k] - h * c * f1[k])
    })
}
