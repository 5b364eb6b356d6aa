//! From triangles to a mesh: its edges, and the triangle or border on each side of them.

use crate::shell::mesh::{Border, Edge, Mesh, MeshFault, signed_area};

/// A side of a triangle: the ends of its edge (the smaller index first), whether the triangle lies to the right of it,
/// the triangle, and the triangle's point opposite.
type BorderSide = ([usize; 2], bool, usize, usize);

impl Mesh {
    /// The mesh of `triangles` over `points`. Its edges are sorted by their ends, so the triangles alone decide their order.
    ///
    /// `name` returns the border of an edge between two points that has a triangle on one side only.
    ///
    /// # Errors
    /// If a triangle is not counterclockwise, names a point that does not exist or overlaps its neighbour, if a point is
    /// unused or not finite, if the border touches itself, or if an edge has one side only and no name.
    pub fn from_triangles(
        points: Vec<[f64; 2]>,
        triangles: Vec<[usize; 3]>,
        name: impl Fn([usize; 2]) -> Option<Border>,
    ) -> Result<Self, MeshFault> {
        check_triangles(&points, &triangles)?;
        let mut sides: Vec<BorderSide> =
            triangles.iter().enumerate().flat_map(|(t, corners)| sides(t, corners)).collect();
        sides.sort_unstable();
        let mut edges: Vec<Edge> = Vec::with_capacity(sides.len() / 2 + 1);
        let mut triangle_edges = vec![[0; 3]; triangles.len()];
        for (ends, right, triangle, opposite) in sides {
            if edges.last().is_none_or(|edge| edge.ends != ends) {
                edges.push(Edge { ends, sides: [None, None], border: None });
            }
            let index = edges.len() - 1;
            let side = &mut edges[index].sides[usize::from(right)];
            if let Some(other) = *side {
                return Err(MeshFault::Overlap { ends, triangles: [other, triangle] });
            }
            *side = Some(triangle);
            triangle_edges[triangle][opposite] = index;
        }
        for edge in &mut edges {
            if let [Some(triangle), None] | [None, Some(triangle)] = edge.sides {
                let ends = edge.ends;
                edge.border = Some(name(ends).ok_or(MeshFault::Unnamed { ends, triangle })?);
            }
        }
        let mesh = Self { points, triangles, triangle_edges, edges };
        mesh.check_border()?;
        Ok(mesh)
    }

    /// Every point of the border must have one border edge before and one after it.
    fn check_border(&self) -> Result<(), MeshFault> {
        let mut borders = vec![0; self.points.len()];
        for edge in self.edges.iter().filter(|edge| edge.border.is_some()) {
            edge.ends.iter().for_each(|&end| borders[end] += 1);
        }
        match borders.iter().position(|count| ![0, 2].contains(count)) {
            Some(point) => Err(MeshFault::Pinched { point, borders: borders[point] }),
            None => Ok(()),
        }
    }
}

fn check_triangles(points: &[[f64; 2]], triangles: &[[usize; 3]]) -> Result<(), MeshFault> {
    if triangles.is_empty() {
        return Err(MeshFault::Empty);
    }
    if let Some(point) = points.iter().position(|xy| !xy.iter().all(|x| x.is_finite())) {
        return Err(MeshFault::NotFinite { point });
    }
    let mut is_used = vec![false; points.len()];
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&missing) = corners.iter().find(|&&point| point >= points.len()) {
            return Err(MeshFault::NoSuchPoint { triangle, found: missing, points: points.len() });
        }
        let area = signed_area(corners.map(|point| points[point]));
        if area <= 0.0 {
            return Err(MeshFault::NotCounterclockwise { triangle, area });
        }
        for &point in corners {
            is_used[point] = true;
        }
    }
    is_used.iter().position(|is_used| !is_used).map_or(Ok(()), |point| Err(MeshFault::Unused { point }))
}

fn sides(triangle: usize, corners: &[usize; 3]) -> [BorderSide; 3] {
    [0, 1, 2].map(|opposite| {
        let (from, to) = (corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]);
        ([from.min(to), from.max(to)], from > to, triangle, opposite)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    fn mesh(points: &[[f64; 2]], triangles: &[[usize; 3]]) -> Result<Mesh, MeshFault> {
        Mesh::from_triangles(points.to_vec(), triangles.to_vec(), |_| Some(Border::Free))
    }

    #[test]
    fn two_triangles_share_their_diagonal() -> Result<(), MeshFault> {
        let square = mesh(&SQUARE, &[[0, 1, 2], [2, 3, 0]])?;
        assert_eq!(square.edges.len(), 5);
        let ends: Vec<_> = square.edges.iter().map(|edge| edge.ends).collect();
        assert_eq!(ends, [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]);
        // From 0 to 2 the triangle 2 3 0 lies to the left.
        assert_eq!(square.edges[1].sides, [Some(1), Some(0)]);
        assert_eq!(square.triangle_edges, [[3, 1, 0], [2, 1, 4]]);
        assert_eq!(square.edges[1].border, None);
        assert_eq!((square.area(0), square.length(0)), (0.5, 1.0));
        assert!((square.length(1) - 2.0_f64.sqrt()).abs() < 1e-15);
        assert!((square.smallest_angle().to_degrees() - 45.0).abs() < 1e-12);
        Ok(())
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        use MeshFault as F;
        assert_eq!(mesh(&SQUARE, &[]), Err(F::Empty));
        assert_eq!(mesh(&SQUARE, &[[0, 2, 1]]), Err(F::NotCounterclockwise { triangle: 0, area: -0.5 }));
        assert_eq!(mesh(&SQUARE, &[[0, 1, 1]]), Err(F::NotCounterclockwise { triangle: 0, area: 0.0 }));
        assert_eq!(mesh(&SQUARE, &[[0, 1, 4]]), Err(F::NoSuchPoint { triangle: 0, found: 4, points: 4 }));
        assert_eq!(mesh(&SQUARE, &[[0, 1, 2]]), Err(F::Unused { point: 3 }));
        let overlap = F::Overlap { ends: [0, 1], triangles: [0, 1] };
        assert_eq!(mesh(&SQUARE, &[[0, 1, 2], [0, 1, 3]]), Err(overlap));
        let mut nan = SQUARE;
        nan[1][1] = f64::NAN;
        assert_eq!(mesh(&nan, &[[0, 1, 2], [2, 3, 0]]), Err(F::NotFinite { point: 1 }));
    }

    #[test]
    fn a_hanging_point_is_seen() {
        // Point 4 lies in the middle of the diagonal, and only the triangles on one side use it.
        let mut points = SQUARE.to_vec();
        points.push([0.5, 0.5]);
        let outer = |ends: [usize; 2]| (!ends.contains(&4) && ends != [0, 2]).then_some(Border::Free);
        let fault = Mesh::from_triangles(points, vec![[0, 1, 4], [1, 2, 4], [2, 3, 0]], outer);
        assert_eq!(fault, Err(MeshFault::Unnamed { ends: [0, 2], triangle: 2 }));
    }

    #[test]
    fn a_sheet_that_hangs_by_a_point_is_refused() {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        assert_eq!(mesh(&points, &[[0, 1, 2], [0, 3, 4]]), Err(MeshFault::Pinched { point: 0, borders: 4 }));
    }
}
