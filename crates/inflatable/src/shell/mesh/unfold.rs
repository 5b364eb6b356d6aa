//! Half a sector unfolded into a sector or a whole star, by turning and mirroring.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::shell::mesh::{Border, Edge, MeshFault, Meshed, Piece, plane};
use geom::{Isometry, Point};

impl Meshed {
    /// `count` half sectors of a star of `n` points around the origin, each glued to the mirror image before it: 2 are a
    /// sector from corner to corner, 2 `n` the whole star, which has no plane left. `self` is the first of them.
    ///
    /// # Errors
    /// If `self` has no planes at the angles 0 and pi/n to unfold at, or `count` is not from 1 to 2 `n`.
    pub fn unfolded(&self, n: u32, count: u32) -> Result<Self, MeshFault> {
        if count < 1 || count > 2 * n {
            let (name, allowed) = ("the number of half sectors", "1 to 2 n");
            return Err(MeshFault::Dimension { name, found: f64::from(count), allowed });
        }
        let closed = count == 2 * n;
        let planes = [plane::FIRST, plane::SECOND].map(|number| self.points_on(Border::Mirror(number)));
        let numbers = self.numbers(&planes, count, closed);
        let fresh = numbers.iter().flatten().max().map_or(0, |last| last + 1);
        let mut points = vec![[0.0; 2]; fresh];
        let (mut triangles, mut margin) = (Vec::new(), Vec::new());
        let (mut pieces, mut piece_at) = (Vec::new(), BTreeMap::new());
        for (copy, numbers) in (0..count).zip(&numbers) {
            let copy_image = image(n, copy);
            let begins = if copy_image.mirrored { plane::SECOND } else { plane::FIRST };
            for (&[x, y], &number) in self.mesh.points.iter().zip(numbers).rev() {
                let Point { x, y } = copy_image.point(Point::new(x, y));
                points[number] = [x, y];
            }
            let of_copy = |corners: &[usize; 3]| {
                let [a, b, c] = corners.map(|point| numbers[point]);
                if copy_image.mirrored { [a, c, b] } else { [a, b, c] }
            };
            let (tube, margin_triangles) = self.mesh.triangles.split_at(self.tube);
            triangles.extend(tube.iter().map(of_copy));
            margin.extend(margin_triangles.iter().map(of_copy));
            for (index, piece) in self.pieces.iter().enumerate() {
                let border = match piece.border {
                    // The plane at which the copy begins, then the one at which it ends.
                    Border::Mirror(number) if number == begins && copy == 0 && !closed => {
                        Border::Mirror(plane::FIRST)
                    }
                    Border::Mirror(number) if number != begins && copy + 1 == count && !closed => {
                        Border::Mirror(plane::SECOND)
                    }
                    Border::Mirror(_) => continue, // glued to the next copy
                    other => other,
                };
                let ends = self.edges_on(index).map(|edge| sorted(edge.ends.map(|end| numbers[end])));
                piece_at.extend(ends.map(|ends| (ends, pieces.len())));
                pieces.push(Piece { curve: copy_image.segment(&piece.curve), border });
            }
        }
        let tube = triangles.len();
        triangles.append(&mut margin);
        Ok(Self { tube, ..Self::new(points, triangles, pieces, &piece_at)? })
    }

    /// The edges on a piece of the border.
    fn edges_on(&self, piece: usize) -> impl Iterator<Item = &Edge> {
        let with_pieces = self.mesh.edges.iter().zip(&self.piece_of);
        with_pieces.filter_map(move |(edge, on)| (*on == Some(piece)).then_some(edge))
    }

    fn points_on(&self, border: Border) -> Vec<bool> {
        let mut is_on_border = vec![false; self.mesh.points.len()];
        for edge in self.mesh.edges.iter().filter(|edge| edge.border == Some(border)) {
            edge.ends.iter().for_each(|&end| is_on_border[end] = true);
        }
        is_on_border
    }

    /// The number that each point has in each copy.
    fn numbers(&self, planes: &[Vec<bool>; 2], count: u32, closed: bool) -> Vec<Vec<usize>> {
        let mut numbers_of_copies: Vec<Vec<usize>> = Vec::new();
        let mut fresh = 0;
        for copy in 0..count {
            // An even copy begins at its first plane, an odd one is a mirror image and begins at its second.
            let (begins, ends) = if copy % 2 == 0 { (0, 1) } else { (1, 0) };
            let number = |point: usize| {
                let previous = numbers_of_copies.last().filter(|_| planes[begins][point]);
                let first =
                    numbers_of_copies.first().filter(|_| closed && copy + 1 == count && planes[ends][point]);
                previous.or(first).map(|numbers: &Vec<usize>| numbers[point])
            };
            let numbers: Vec<Option<usize>> = (0..self.mesh.points.len()).map(number).collect();
            let mut next = || {
                fresh += 1;
                fresh - 1
            };
            numbers_of_copies
                .push(numbers.into_iter().map(|numbers| numbers.unwrap_or_else(&mut next)).collect());
        }
        numbers_of_copies
    }
}

/// Copy `k` lies between the rays at k pi/n and (k + 1) pi/n.
fn image(n: u32, copy: u32) -> Isometry {
    let mirrored = copy % 2 == 1;
    let rays = f64::from(if mirrored { copy + 1 } else { copy });
    Isometry { mirrored, ..Isometry::rotation(0.5 * rays * TAU / f64::from(n)) }
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
