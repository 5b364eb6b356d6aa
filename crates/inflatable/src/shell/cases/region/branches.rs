//! Several computed shapes of one chamber as one answer: two stable ones, or a folded and a smooth one.

use crate::shell::cases::region::answer::{InflatedRegion, PlateContact, SeamPull, Wrinkles};
use crate::shell::cases::region::surface::Surface;
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::value::Value;

/// Relative difference of height or volume from which on two shapes are different ones: patterns of folds that differ by chance change less.
const DIFFERENT: f64 = 0.03;

/// The one of two stable shapes that has less energy on the finest mesh; the other is its second, if their heights or volumes
/// there differ by more than [`DIFFERENT`].
pub(super) fn lower_of(first: InflatedRegion, second: InflatedRegion) -> InflatedRegion {
    let is_second_lower = second.energy.meshes[2] < first.energy.meshes[2];
    let (lower, higher) = if is_second_lower { (second, first) } else { (first, second) };
    let is_other = differs(higher.height, lower.height) || differs(higher.volume, lower.volume);
    let evidence = lower.evidence.join(&higher.evidence);
    let other_probed = higher.probed.clone();
    let second = is_other.then(|| Box::new(higher));
    InflatedRegion { other_probed, second, evidence, ..lower }
}

/// Whether two values differ by more than [`DIFFERENT`] on the finest mesh.
fn differs(a: Value, b: Value) -> bool {
    (a.meshes[2] - b.meshes[2]).abs() > DIFFERENT * b.meshes[2].abs()
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
/// What the blend leaves open widens the mesh errors; of the pull the whole way to that of the folds ([`blended_pull`]).
pub(super) fn blended(smooth: &InflatedRegion, folded: &InflatedRegion, blend: Blend) -> InflatedRegion {
    // Both were computed on the same meshes, so that places, stations and triangles agree. Numbers are blended mesh by
    // mesh, shapes point by point.
    let Blend { part, open } = blend;
    let value = |smooth: Value, folded: Value| smooth.blended(folded, part, open);
    let nearest = if part > 0.5 { folded } else { smooth };
    let seams: Vec<SeamPull> = (smooth.seams.iter().zip(&folded.seams))
        .map(|(smooth_pull, folded_pull)| SeamPull {
            pull: blended_pull(smooth_pull.pull, folded_pull.pull, part),
            ..*smooth_pull
        })
        .collect();
    let largest = seams.iter().max_by(|a, b| a.pull.meshes[2].total_cmp(&b.pull.meshes[2]));
    InflatedRegion {
        width: smooth.width,
        bendability: smooth.bendability,
        wrinkles: Wrinkles::Blended,
        height: value(smooth.height, folded.height),
        height_at: nearest.height_at,
        flat_extents: smooth.flat_extents,
        extents: [0, 1].map(|axis| value(smooth.extents[axis], folded.extents[axis])),
        volume: value(smooth.volume, folded.volume),
        seal_pull: blended_pull(smooth.seal_pull, folded.seal_pull, part),
        pull_at: largest.map_or(nearest.pull_at, |largest| largest.at),
        seams,
        is_parted: smooth.is_parted,
        stretch: value(smooth.stretch, folded.stretch),
        stretch_at: nearest.stretch_at,
        tension: value(smooth.tension, folded.tension),
        tension_at: nearest.tension_at,
        symmetric_eigenvalue: value(smooth.symmetric_eigenvalue, folded.symmetric_eigenvalue),
        antisymmetric_eigenvalue: value(smooth.antisymmetric_eigenvalue, folded.antisymmetric_eigenvalue),
        shape: blended_shape(&smooth.shape, &folded.shape, part),
        surface: blended_surface(&smooth.surface, &folded.surface, part),
        probed: blended_probes(smooth, &folded.probed, part),
        other_probed: blended_probes(smooth, &folded.other_probed, part),
        plates: smooth.plates.zip(folded.plates).map(|(smooth, folded)| PlateContact {
            force: value(smooth.force, folded.force),
            area: value(smooth.area, folded.area),
        }),
        overlap: folded.overlap.or(smooth.overlap),
        energy: value(smooth.energy, folded.energy),
        second: folded.second.as_ref().map(|second| Box::new(blended(smooth, second, blend))),
        evidence: smooth.evidence.join(&folded.evidence),
    }
}

/// The probes of `smooth` and of a shape with folds, mesh by mesh.
fn blended_probes(smooth: &InflatedRegion, folded: &[Vec<[f64; 3]>], part: f64) -> Vec<Vec<[f64; 3]>> {
    let meshes = smooth.probed.iter().zip(folded);
    meshes
        .map(|(smooth_points, folded_points)| interpolated_rows(smooth_points, folded_points, part))
        .collect()
}

/// The pull on a seam, `part` of the way from that of the `smooth` shape to that of the `folded` one. Its error reaches the pull of the
/// folds with the mesh error of that, too: a pull that is too small is on the unsafe side of bursting.
fn blended_pull(smooth: Value, folded: Value, part: f64) -> Value {
    let blend = smooth.blended(folded, part, 1.0 - part);
    Value { error: blend.error.max(folded.value + folded.error - blend.value), ..blend }
}

fn blended_shape(smooth: &InflatedShape, folded: &InflatedShape, part: f64) -> InflatedShape {
    InflatedShape {
        points: interpolated_rows(&smooth.points, &folded.points, part),
        tension: interpolated_rows(&smooth.tension, &folded.tension, part),
        stretch: interpolated_rows(&smooth.stretch, &folded.stretch, part),
        curvature: interpolated_rows(&smooth.curvature, &folded.curvature, part),
        flat: smooth.flat.clone(),
        triangles: smooth.triangles.clone(),
    }
}

fn blended_surface(smooth: &Surface, folded: &Surface, part: f64) -> Surface {
    Surface {
        points: interpolated_rows(&smooth.points, &folded.points, part),
        tension: smooth.tension.iter().zip(&folded.tension).map(|(a, b)| a + part * (b - a)).collect(),
        flat: smooth.flat.clone(),
        triangles: smooth.triangles.clone(),
    }
}

/// Rows of numbers, each `part` of the way from the first to the second.
fn interpolated_rows<const N: usize>(from: &[[f64; N]], to: &[[f64; N]], part: f64) -> Vec<[f64; N]> {
    from.iter().zip(to).map(|(a, b)| std::array::from_fn(|k| a[k] + part * (b[k] - a[k]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mesh errors of both shapes cancel in the blend, but those of the folds stay in its error.
    #[test]
    fn a_blended_pull_reaches_that_of_the_folds_with_its_error() {
        let smooth = Value::new([130.0, 110.0, 100.0]);
        for folded in [Value::new([170.0, 190.0, 200.0]), Value::new([230.0, 210.0, 200.0])] {
            for part in [0.0, 0.3, 0.5, 0.9, 1.0] {
                let blend = blended_pull(smooth, folded, part);
                let reach = blend.value + blend.error;
                assert!(reach >= folded.value + folded.error - 1e-9, "{part}: {blend:?} of {folded:?}");
                assert!(
                    blend.value - blend.error <= smooth.value.min(folded.value) + 1e-9 || part > 0.5,
                    "{blend:?}"
                );
            }
        }
        assert_eq!(blended_pull(smooth, Value::new([60.0; 3]), 1.0), Value::new([60.0; 3]));
    }
}
