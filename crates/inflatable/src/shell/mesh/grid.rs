//! A rectangle cut into a regular grid: for plates with exact solutions.

use crate::shell::mesh::{Border, Mesh, MeshFault};

/// The division of a grid's cells into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Diagonal {
    /// Along the diagonal that rises to the right.
    Rising,
    /// Along the diagonal that falls to the right.
    Falling,
    /// One and the other in turns, like a chequerboard.
    Alternating,
    /// Along both, with a point in the middle.
    Crossed,
}

/// The rectangle from (0, 0) to (`size[0]`, `size[1]`), turned counterclockwise by `turn` (rad) about the origin, of
/// `cells[0]` times `cells[1]` cells. `borders` are those at the bottom, right, top and left before it is turned.
///
/// # Errors
/// If a side is not positive and finite, or has no cell.
pub(crate) fn rectangle(
    size: [f64; 2],
    cells: [usize; 2],
    diagonal: Diagonal,
    turn: f64,
    borders: [Border; 4],
) -> Result<Mesh, MeshFault> {
    for (name, found) in [("the rectangle's width", size[0]), ("the rectangle's height", size[1])] {
        if !(found > 0.0 && found.is_finite()) {
            return Err(MeshFault::Dimension { name, found, allowed: "more than 0" });
        }
    }
    let [columns, rows] = cells;
    let corner = |i: usize, j: usize| j * (columns + 1) + i;
    let middle = |i: usize, j: usize| (columns + 1) * (rows + 1) + j * columns + i;
    let mut flat: Vec<[f64; 2]> = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| [fraction(i, columns), fraction(j, rows)]))
        .collect();
    let mut triangles = Vec::with_capacity(4 * columns * rows);
    for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let cell = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        if diagonal == Diagonal::Crossed {
            flat.push([fraction(2 * i + 1, 2 * columns), fraction(2 * j + 1, 2 * rows)]);
        }
        triangles.extend(cut(cell, diagonal, (i + j) % 2 == 0, middle(i, j)));
    }
    let (sin, cos) = libm::sincos(turn);
    let place = |[u, v]: [f64; 2]| {
        let (x, y) = (u * size[0], v * size[1]);
        [cos * x - sin * y, sin * x + cos * y]
    };
    let side = |ends: [usize; 2]| {
        let is_on = |axis: usize, at: f64| ends.iter().all(|&end| flat[end][axis] == at);
        let border =
            [is_on(1, 0.0), is_on(0, 1.0), is_on(1, 1.0), is_on(0, 0.0)].iter().position(|&is_on| is_on)?;
        Some(borders[border])
    };
    Mesh::from_triangles(flat.iter().copied().map(place).collect(), triangles, side)
}

#[expect(clippy::cast_precision_loss, reason = "a grid has far fewer than 2^53 cells")]
fn fraction(part: usize, count: usize) -> f64 {
    part as f64 / count as f64
}

fn cut([a, b, c, d]: [usize; 4], diagonal: Diagonal, even: bool, middle: usize) -> Vec<[usize; 3]> {
    match diagonal {
        Diagonal::Crossed => vec![[a, b, middle], [b, c, middle], [c, d, middle], [d, a, middle]],
        Diagonal::Rising => vec![[a, b, c], [a, c, d]],
        Diagonal::Alternating if even => vec![[a, b, c], [a, c, d]],
        Diagonal::Falling | Diagonal::Alternating => vec![[a, b, d], [b, c, d]],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BORDERS: [Border; 4] = [Border::Rim(0), Border::Mirror(1), Border::Rim(2), Border::Free];

    #[test]
    fn every_way_to_cut_fills_the_rectangle() -> Result<(), MeshFault> {
        for diagonal in [Diagonal::Rising, Diagonal::Falling, Diagonal::Alternating, Diagonal::Crossed] {
            for turn in [0.0, 0.3, -2.0] {
                let mesh = rectangle([3.0, 2.0], [4, 3], diagonal, turn, BORDERS)?;
                assert!((mesh.total_area() - 6.0).abs() < 1e-13, "{diagonal:?}");
                for (border, sides, length) in
                    [(BORDERS[0], 4, 3.0), (BORDERS[1], 3, 2.0), (BORDERS[2], 4, 3.0), (BORDERS[3], 3, 2.0)]
                {
                    let is_of_border = |e: &usize| mesh.edges[*e].border == Some(border);
                    let border_edges: Vec<usize> = (0..mesh.edges.len()).filter(is_of_border).collect();
                    assert_eq!(border_edges.len(), sides);
                    let sum: f64 = border_edges.iter().map(|&e| mesh.length(e)).sum();
                    assert!((sum - length).abs() < 1e-13);
                }
            }
        }
        Ok(())
    }

    #[test]
    fn a_rectangle_needs_sides_and_cells() {
        let fault_of = |size, cells| rectangle(size, cells, Diagonal::Rising, 0.0, BORDERS).err();
        let width =
            MeshFault::Dimension { name: "the rectangle's width", found: 0.0, allowed: "more than 0" };
        assert_eq!(fault_of([0.0, 1.0], [1, 1]), Some(width));
        assert_eq!(fault_of([1.0, 1.0], [0, 1]), Some(MeshFault::Empty));
    }
}
