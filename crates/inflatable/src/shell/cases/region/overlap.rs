//! Whether the inflated shape lies over itself: whether its rims cross each other in the plane.

use crate::shell::element::volume::projected_area;
use crate::shell::mesh::{Border, Mesh};

/// The flat places of two edges of rims that cross each other in the shape with these `points`, lengths by the chamber's width. Edges that lie
/// within this width on the flat sheet do not count: they are sides of one fold.
pub(super) fn crossing(mesh: &Mesh, points: &[[f64; 3]]) -> Option<[[f64; 2]; 2]> {
    // Sorted by their least x, an edge is compared only with those that begin before it ends.
    let rims = mesh.edges.iter().filter(|edge| matches!(edge.border, Some(Border::Rim(_))));
    let mut ends: Vec<[usize; 2]> = rims.map(|edge| edge.ends).collect();
    ends.sort_by(|a, b| least_x(points, a).total_cmp(&least_x(points, b)));
    for (k, first) in ends.iter().enumerate() {
        let most_x = points[first[0]][0].max(points[first[1]][0]);
        let candidates = ends[k + 1..].iter().take_while(|second| least_x(points, second) <= most_x);
        for second in candidates {
            let [place, other_place] = [first, second].map(|edge| middle(edge.map(|end| mesh.points[end])));
            let distance = libm::hypot(other_place[0] - place[0], other_place[1] - place[1]);
            if distance > 1.0 && cross(first.map(|end| points[end]), second.map(|end| points[end])) {
                return Some([place, other_place]);
            }
        }
    }
    None
}

/// The least x of an edge.
fn least_x(points: &[[f64; 3]], [a, b]: &[usize; 2]) -> f64 {
    points[*a][0].min(points[*b][0])
}

/// Whether two segments cross each other in plan view, each strictly inside of the other.
fn cross([a, b]: [[f64; 3]; 2], [c, d]: [[f64; 3]; 2]) -> bool {
    projected_area([a, b, c]) * projected_area([a, b, d]) < 0.0
        && projected_area([c, d, a]) * projected_area([c, d, b]) < 0.0
}

fn middle([a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|axis| f64::midpoint(a[axis], b[axis]))
}

#[cfg(test)]
mod tests {
    use crate::shell::cases::{Fineness, FlatRegion, ShellFault, Watch, chambers, region};
    use crate::shell::element::Fabric;
    use geom::{Arc, Line, Path, Point};

    fn place(radius: f64, angle: f64) -> Point {
        Point::new(radius * libm::cos(angle), radius * libm::sin(angle))
    }

    /// An arc of `angle`, rad, 20 mm wide around a hole of 40 mm radius.
    fn arc(angle: f64) -> Result<(), ShellFault> {
        let outline = Path::closed(vec![
            Arc::new(Point::ORIGIN, 0.06, 0.0, angle).into(),
            Line::new(place(0.06, angle), place(0.04, angle)).into(),
            Arc::new(Point::ORIGIN, 0.04, angle, -angle).into(),
            Line::new(place(0.04, 0.0), place(0.06, 0.0)).into(),
        ]);
        let (e, nu, t) = (128e6, 0.39, 0.3e-3_f64);
        let case = FlatRegion {
            chamber: chambers(&[outline], &[], &[])?.remove(0),
            fabric: Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu),
            pressure: 14e3,
            band: 0.003,
            probes: Vec::new(),
            partial: Vec::new(),
            plates: None,
        };
        region(&case, Fineness { cells: 2.0, cuts: 2 }, &Watch::default()).map(|_| ())
    }

    /// An arc coils by a fifth: one of 300 degrees would end within itself.
    #[test]
    fn a_tube_that_coils_into_itself_is_refused() {
        assert_eq!(arc(4.0), Ok(()));
        let fault = arc(5.24).expect_err("it coils into itself");
        let ShellFault::Overlap { places } = fault else { panic!("{fault:?}") };
        // Both lie near the ends of the arc.
        assert!(places.iter().all(|[x, y]| libm::atan2(*y, *x).abs() < 1.3), "{places:?}");
        let text = ShellFault::Overlap { places }.to_string();
        assert!(text.contains("contact of a chamber with itself is not computed"), "{text}");
    }
}
