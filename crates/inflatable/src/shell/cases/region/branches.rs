//! Several computed shapes of one chamber as one answer: two stable ones, or a folded and a smooth one.

use crate::shell::cases::region::answer::{InflatedRegion, SeamPull, Wrinkles};
use crate::shell::cases::region::surface::Surface;
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::value::Value;

/// Relative difference of height or volume from which on two shapes are different ones: patterns of folds that differ by chance change less.
const DIFFERENT: f64 = 0.03;

/// The one of two stable shapes that has less energy on the finest mesh; the other is its second, if they differ by more than both mesh
/// errors.
pub(super) fn lower_of(first: InflatedRegion, second: InflatedRegion) -> InflatedRegion {
    let is_second_lower = second.energy.meshes[2] < first.energy.meshes[2];
    let (lower, higher) = if is_second_lower { (second, first) } else { (first, second) };
    let differs = |a: Value, b: Value| (a.meshes[2] - b.meshes[2]).abs() > DIFFERENT * b.meshes[2].abs();
    let is_other = differs(higher.height, lower.height) || differs(higher.volume, lower.volume);
    let evidence = lower.evidence.after(&higher.evidence);
    let second = is_other.then(|| Box::new(higher));
    InflatedRegion { second, evidence, ..lower }
}

/// The weight of a shape with folds against the mean of its wrinkles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blend {
    /// Part of the way from the smooth to the folded shape.
    pub(super) part: f64,
    /// Part of their difference by which it may be wrong.
    pub(super) open: f64,
}

/// A chamber between its shape with folds, `folded`, and the mean of all wrinkles, `smooth`.
///
/// What the blend leaves open widens the mesh errors; of the pull the whole way to that of the folds,
/// because a pull that is too small is on the unsafe side of bursting.
pub(super) fn blended(smooth: &InflatedRegion, folded: &InflatedRegion, blend: Blend) -> InflatedRegion {
    // Both were computed on the same meshes, so that places, stations and triangles agree. Numbers are blended mesh by
    // mesh, shapes point by point.
    let Blend { part, open } = blend;
    let value = |smooth: Value, folded: Value| smooth.blended(folded, part, open);
    let pull = |smooth: Value, folded: Value| smooth.blended(folded, part, 1.0 - part);
    let nearest = if part > 0.5 { folded } else { smooth };
    let seams: Vec<SeamPull> = (smooth.seams.iter().zip(&folded.seams))
        .map(|(own, of_folds)| SeamPull { pull: pull(own.pull, of_folds.pull), ..*own })
        .collect();
    let largest = seams.iter().max_by(|a, b| a.pull.meshes[2].total_cmp(&b.pull.meshes[2]));
    InflatedRegion {
        bendability: smooth.bendability,
        wrinkles: Wrinkles::Blended,
        height: value(smooth.height, folded.height),
        extents: [0, 1].map(|axis| value(smooth.extents[axis], folded.extents[axis])),
        volume: value(smooth.volume, folded.volume),
        seal_pull: pull(smooth.seal_pull, folded.seal_pull),
        pull_at: largest.map_or(nearest.pull_at, |largest| largest.at),
        seams,
        stretch: value(smooth.stretch, folded.stretch),
        tension: value(smooth.tension, folded.tension),
        symmetric_eigenvalue: value(smooth.symmetric_eigenvalue, folded.symmetric_eigenvalue),
        antisymmetric_eigenvalue: value(smooth.antisymmetric_eigenvalue, folded.antisymmetric_eigenvalue),
        shape: blended_shape(&smooth.shape, &folded.shape, part),
        surface: blended_surface(&smooth.surface, &folded.surface, part),
        probed: (smooth.probed.iter().zip(&folded.probed))
            .map(|(own, of_folds)| mixed_all(own, of_folds, part))
            .collect(),
        energy: value(smooth.energy, folded.energy),
        second: folded.second.as_ref().map(|second| Box::new(blended(smooth, second, blend))),
        evidence: smooth.evidence.after(&folded.evidence),
        ..nearest.clone()
    }
}

fn blended_shape(smooth: &InflatedShape, folded: &InflatedShape, part: f64) -> InflatedShape {
    InflatedShape {
        points: mixed_all(&smooth.points, &folded.points, part),
        tension: mixed_all(&smooth.tension, &folded.tension, part),
        stretch: mixed_all(&smooth.stretch, &folded.stretch, part),
        curvature: mixed_all(&smooth.curvature, &folded.curvature, part),
        ..smooth.clone()
    }
}

fn blended_surface(smooth: &Surface, folded: &Surface, part: f64) -> Surface {
    Surface {
        points: mixed_all(&smooth.points, &folded.points, part),
        tension: smooth.tension.iter().zip(&folded.tension).map(|(a, b)| a + part * (b - a)).collect(),
        ..smooth.clone()
    }
}

/// Rows of numbers, each `part` of the way from the first to the second.
fn mixed_all<const N: usize>(from: &[[f64; N]], to: &[[f64; N]], part: f64) -> Vec<[f64; N]> {
    let mixed = |a: &[f64; N], b: &[f64; N]| std::array::from_fn(|k| a[k] + part * (b[k] - a[k]));
    from.iter().zip(to).map(|(a, b)| mixed(a, b)).collect()
}
