//! The margin of a tube: the sealed band and the loose flap beyond it, which lie in the plane of its rims.
//!
//! The tube's own triangles stay as they are, so that numbers with and without a margin belong to the same mesh of the tube.

use crate::shell::mesh::delaunay::{BorderPoints, fill_border};
use crate::shell::mesh::sizing::Sizing;
use crate::shell::mesh::{Border, MeshFault, Meshed, Piece, rim};
use geom::{Arc, Line, Point, Segment, Vec2};
use std::collections::BTreeMap;

/// How far the margin stands out from each rim, band and flap together, in the mesh's unit of length; 0 where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MarginWidths {
    /// From the inner rim.
    pub inner: f64,
    /// From the outer rim.
    pub outer: f64,
}

/// Rounds of bisection for the place where an offset curve meets a plane of symmetry.
const ROUNDS: usize = 60;

/// One rim from its begin to its end, as the border of the tube runs, and what lies before and after it.
struct RimPieces {
    pieces: Vec<usize>,
    before: Piece,
    after: Piece,
}

impl Meshed {
    /// This mesh of a tube alone with the margin beyond its rims, in triangles as small as `sizing` asks for.
    ///
    /// # Errors
    /// If a width is negative or not finite, or if the margin has no room between the planes of symmetry.
    pub(super) fn with_margin(self, widths: MarginWidths, sizing: &Sizing) -> Result<Self, MeshFault> {
        let mut meshed = self;
        let (tube, count) = (meshed.tube, meshed.pieces.len());
        for (border, width) in [(rim::INNER, widths.inner), (rim::OUTER, widths.outer)] {
            if !(width >= 0.0 && width.is_finite()) {
                let (name, allowed) = ("the margin's width", "0 or more");
                return Err(MeshFault::Dimension { name, found: width, allowed });
            }
            if width > 0.0 {
                let rim = meshed.rim(border, count);
                meshed = meshed.widened(&rim, width, sizing)?;
            }
        }
        Ok(Self { tube, ..meshed })
    }

    /// The pieces of a rim. The first `count` pieces are the border of the tube alone: one loop, and a rim is one run of it.
    fn rim(&self, border: u8, count: usize) -> RimPieces {
        let is_own = |at: &usize| self.pieces[*at].border == Border::Rim(border);
        let pieces: Vec<usize> = (0..count).filter(is_own).collect();
        let (first, last) = (pieces.first().copied().unwrap_or(0), pieces.last().copied().unwrap_or(0));
        let neighbours = [(first + count - 1) % count, (last + 1) % count].map(|at| self.pieces[at]);
        RimPieces { pieces, before: neighbours[0], after: neighbours[1] }
    }

    /// This mesh with a margin of this `width` beyond one rim.
    fn widened(self, rim: &RimPieces, width: f64, sizing: &Sizing) -> Result<Self, MeshFault> {
        let edge = self.margin_edge(rim, width)?;
        // Counterclockwise: back along the rim, out, along the cut edge, in.
        let (rim_points, mut loop_pieces) = self.rim_loop(rim);
        let Self { mesh, mut pieces, piece_of, .. } = self;
        let place = |point: &usize| Point::new(mesh.points[*point][0], mesh.points[*point][1]);
        let mut points: Vec<Point> = rim_points.iter().map(place).collect();
        let ends = [edge[0].start(), edge[edge.len() - 1].end()];
        let corners = [points[points.len() - 1], points[0]];
        let outward =
            Piece { curve: Line::new(corners[0], ends[0]).into(), border: rim.before.side_border() };
        let back = Piece { curve: Line::new(ends[1], corners[1]).into(), border: rim.after.side_border() };
        let cut = edge.into_iter().map(|curve| Piece { curve, border: Border::Free });
        for (at, piece) in [outward].into_iter().chain(cut).chain([back]).enumerate() {
            let run = sizing.divide(&piece.curve);
            // The first point of the way out is the rim's.
            loop_pieces.extend(run.iter().map(|_| pieces.len()));
            points.extend(run.into_iter().skip(usize::from(at == 0)));
            pieces.push(piece);
        }
        let border = BorderPoints::closed(points, &loop_pieces);
        let (points_of_margin, triangles) = fill_border(&border, sizing)?;
        let fresh = mesh.points.len();
        let number =
            |at: usize| rim_points.get(at).copied().unwrap_or(fresh + at.saturating_sub(rim_points.len()));
        let mut joined_points = mesh.points.clone();
        joined_points.extend(&points_of_margin[rim_points.len()..]);
        let mut piece_at: BTreeMap<[usize; 2], usize> = mesh
            .edges
            .iter()
            .zip(&piece_of)
            .filter_map(|(edge, piece)| Some((edge.ends, (*piece)?)))
            .collect();
        piece_at.extend(border.pieces().into_iter().map(|(ends, piece)| {
            let [a, b] = ends.map(number);
            ([a.min(b), a.max(b)], piece)
        }));
        let triangles =
            mesh.triangles.iter().copied().chain(triangles.iter().map(|corners| corners.map(number)));
        Self::new(joined_points, triangles.collect(), pieces, &piece_at)
    }

    /// The cut edge of a margin of this `width` beyond `rim`, in the direction of the rim.
    fn margin_edge(&self, rim: &RimPieces, width: f64) -> Result<Vec<Segment>, MeshFault> {
        let edge: Vec<Segment> =
            rim.pieces.iter().filter_map(|at| offset(&self.pieces[*at].curve, width)).collect();
        let edge = trimmed(edge, rim.before).map(|edge| reversed(&edge));
        let edge = edge.and_then(|edge| trimmed(edge, rim.after)).map(|edge| reversed(&edge));
        edge.filter(|edge| !edge.is_empty()).ok_or(MeshFault::Dimension {
            name: "the margin's width",
            found: width,
            allowed: "a smaller one, for which there is room",
        })
    }

    /// The points of `rim` from its last to its first, and the piece of each but the last.
    fn rim_loop(&self, rim: &RimPieces) -> (Vec<usize>, Vec<usize>) {
        let (mut rim_points, mut loop_pieces) = (Vec::new(), Vec::new());
        for piece in rim.pieces.iter().rev() {
            let mut run: Vec<[(f64, usize); 2]> = (self.mesh.edges.iter().zip(&self.piece_of))
                .filter(|(_, on)| **on == Some(*piece))
                .map(|(edge, _)| edge.ends.map(|point| (self.fraction(*piece, point), point)))
                .map(|[a, b]| if a.0 > b.0 { [a, b] } else { [b, a] })
                .collect();
            run.sort_by(|[a, _], [b, _]| b.0.total_cmp(&a.0));
            rim_points.extend(run.iter().map(|[(_, start), _]| *start));
            loop_pieces.extend(run.iter().map(|_| *piece));
            if *piece == rim.pieces[0] {
                rim_points.extend(run.last().map(|[_, (_, end)]| *end));
            }
        }
        (rim_points, loop_pieces)
    }

    /// The place of `point` along the curve of a piece, from 0 to 1.
    fn fraction(&self, piece: usize, point: usize) -> f64 {
        let [x, y] = self.mesh.points[point];
        self.pieces[piece].curve.nearest_fraction(Point::new(x, y))
    }
}

/// `curve` moved by `distance` to its right; `None` if it is an arc around a centre that lies nearer.
fn offset(curve: &Segment, distance: f64) -> Option<Segment> {
    match curve {
        Segment::Line(line) => {
            let shift = line.direction().perp() * -distance;
            Some(Line::new(line.start + shift, line.end + shift).into())
        }
        Segment::Arc(arc) => {
            let radius = arc.radius + if arc.is_ccw() { distance } else { -distance };
            (radius > 1e-9 * distance).then(|| Arc { radius, ..*arc }.into())
        }
    }
}

/// The part of a run of curves that lies on the left of the border's piece `before` it, if that is a plane of symmetry; `None` if none does.
fn trimmed(edge: Vec<Segment>, neighbour: Piece) -> Option<Vec<Segment>> {
    let (Border::Mirror(_), Segment::Line(line)) = (neighbour.border, neighbour.curve) else {
        return Some(edge);
    };
    let direction: Vec2 = line.direction();
    let slack = 1e-12 * line.length();
    let first = edge.iter().position(|curve| direction.cross(curve.end() - line.start) > slack)?;
    let curve = edge[first];
    let (mut low, mut high) = (0.0, 1.0);
    if direction.cross(curve.start() - line.start) < -slack {
        for _ in 0..ROUNDS {
            let middle = f64::midpoint(low, high);
            let side = direction.cross(curve.point(middle) - line.start);
            if side < 0.0 { low = middle } else { high = middle }
        }
    } else {
        high = 0.0;
    }
    Some([curve.part(high, 1.0)].into_iter().chain(edge.into_iter().skip(first + 1)).collect())
}

fn reversed(edge: &[Segment]) -> Vec<Segment> {
    edge.iter().rev().map(Segment::reversed).collect()
}

impl Piece {
    /// The border of a margin's side beside this piece: a plane of symmetry goes on, everything else ends free.
    fn side_border(&self) -> Border {
        if matches!(self.border, Border::Mirror(_)) { self.border } else { Border::Free }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::mesh::{HalfActuator, HalfSector, Sizes};
    use std::f64::consts::PI;

    const SIZES: [f64; 2] = [3.0, 6.0];
    const WIDTHS: MarginWidths = MarginWidths { inner: 0.1, outer: 0.3 };

    /// Stars with sharp and round hinges, and one whose short arms leave the inner margin no straight part.
    fn stars() -> [HalfSector; 3] {
        let paper = HalfSector { n: 5, rho_0: 5.0 / 3.0, w: 1.0, phi_i: PI / 6.0, r_i: 0.0, r_e: 0.0 };
        [paper, HalfSector { r_i: 0.05, r_e: 0.4, ..paper }, HalfSector { n: 8, ..paper }]
    }

    #[test]
    fn a_margin_leaves_the_tube_as_it_is() {
        for star in stars() {
            for cells in SIZES {
                let sizes = Sizes::for_tube(1.0, cells);
                let bare = star.mesh(&sizes).expect("a mesh");
                let widened = star.mesh_with(&sizes, WIDTHS).expect("a mesh");
                assert_eq!(bare, star.mesh_with(&sizes, MarginWidths::default()).expect("a mesh"));
                assert_eq!(bare.tube, bare.mesh.triangles.len());
                assert_eq!(widened.tube, bare.tube);
                assert_eq!(widened.mesh.triangles[..widened.tube], bare.mesh.triangles[..]);
                assert_eq!(widened.mesh.points[..bare.mesh.points.len()], bare.mesh.points[..]);
                let fine = widened.refined().expect("a finer mesh");
                assert_eq!(
                    (fine.tube, fine.mesh.triangles.len()),
                    (4 * widened.tube, 4 * widened.mesh.triangles.len())
                );
                let star_mesh = widened.unfolded(star.n, 2 * star.n).expect("a whole star");
                assert_eq!(star_mesh.tube, 2 * bare.tube * usize::try_from(star.n).expect("few"));
            }
        }
    }

    /// The margin's area, from two meshes, is that between the rims and the curves offset from them, by Pappus' rule: width times the length in
    /// its middle, and at a sharp hinge the kite that is cut by the plane of symmetry.
    #[test]
    fn the_margin_has_its_area() {
        let star = stars()[0];
        let coarse = star.mesh_with(&Sizes::for_tube(1.0, 8.0), WIDTHS).expect("a mesh");
        let fine = coarse.refined().expect("a finer mesh");
        let margin_area = |meshed: &Meshed| {
            (meshed.tube..meshed.mesh.triangles.len()).map(|t| meshed.mesh.area(t)).sum::<f64>()
        };
        let area = margin_area(&fine) + (margin_area(&fine) - margin_area(&coarse)) / 3.0;
        let (corner, tip) = ((PI - star.phi_i - 2.0 * star.half_angle()) / 2.0, (PI - star.phi_i) / 2.0);
        let band = |width: f64, arc: f64, cut: f64| {
            // Around an arc of radius 1, along the arm, less what lies beyond the plane that halves the sharp hinge's angle.
            width * (arc * (1.0 + width / 2.0) + star.l()) - width * width / (2.0 * cut.tan())
        };
        let exact = band(WIDTHS.inner, corner, PI / 2.0 - tip) + band(WIDTHS.outer, tip, PI / 2.0 - corner);
        assert!((area / exact - 1.0).abs() < 1e-4, "{area} {exact}");
    }

    #[test]
    fn an_actuator_has_a_margin_too_and_one_without_room_is_refused() {
        let half = HalfActuator { r: 0.1, w: 1.0, l: 4.0, phi_0: PI / 3.0 };
        let sizes = Sizes::for_tube(1.0, 6.0);
        let widened = half.mesh_with(&sizes, MarginWidths { inner: 0.1, outer: 0.1 }).expect("a mesh");
        assert!(widened.tube < widened.mesh.triangles.len());
        for widths in [MarginWidths { inner: -1.0, outer: 0.0 }, MarginWidths { inner: 0.0, outer: f64::NAN }]
        {
            assert!(half.mesh_with(&sizes, widths).is_err());
        }
        assert!(stars()[0].mesh_with(&sizes, MarginWidths { inner: 5.0, outer: 0.0 }).is_err());
    }
}
