//! Places of single points of the flat sheet after inflation, for measures.

use crate::shell::assembly::State;
use crate::shell::mesh::Mesh;

/// The positions of `places` of the flat sheet in `state`, by linear interpolation in the triangle that holds each. A place beyond the mesh,
/// as between an arc and its chord, belongs to the nearest triangle.
pub(super) fn positions(mesh: &Mesh, state: &State, places: &[[f64; 2]]) -> Vec<[f64; 3]> {
    places.iter().map(|place| position(mesh, state, *place)).collect()
}

/// The triangle that holds `place` of the flat sheet, or is nearest to it.
pub(super) fn triangle_at(mesh: &Mesh, place: [f64; 2]) -> Option<usize> {
    let of_triangles = mesh.triangles.iter().map(|corners| weights(mesh, corners, place));
    let holder =
        of_triangles.enumerate().max_by(|(_, a), (_, b)| least_weight(a).total_cmp(&least_weight(b)));
    holder.map(|(triangle, _)| triangle)
}

fn position(mesh: &Mesh, state: &State, place: [f64; 2]) -> [f64; 3] {
    let Some(triangle) = triangle_at(mesh, place) else { return [place[0], place[1], 0.0] };
    let corners = &mesh.triangles[triangle];
    let shares = weights(mesh, corners, place);
    let points = corners.map(|corner| state.points[corner]);
    std::array::from_fn(|axis| (0..3).map(|corner| shares[corner] * points[corner][axis]).sum())
}

fn least_weight(weights: &[f64; 3]) -> f64 {
    weights.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The barycentric coordinates of `place` in the flat triangle with these `corners`; the least is negative outside of it.
fn weights(mesh: &Mesh, corners: &[usize; 3], place: [f64; 2]) -> [f64; 3] {
    let points = corners.map(|corner| mesh.points[corner]);
    let triangle_area = doubled_area(points[0], points[1], points[2]);
    std::array::from_fn(|k| doubled_area(place, points[(k + 1) % 3], points[(k + 2) % 3]) / triangle_area)
}

/// Twice the signed area of a triangle, positive if its corners run counterclockwise.
fn doubled_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
