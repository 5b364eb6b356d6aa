//! A sheet and its image in the plane z = 0 as one sheet, joined where they are sealed to each other.
//!
//! The image keeps the triangles, the directions and the normals of the sheet, so that a mirrored shape is an image of each point and of each
//! lean with the opposite sign. Its load is the opposite one: the volume below the sheet less that below the image lies between both.

use crate::shell::assembly::sheet::{Beyond, Piece, Sheet, State};
use crate::shell::element::vector::{add_scaled, minus};

/// The numbers of points and edges in both sheets: those of the upper sheet, and then the others.
#[derive(Clone, Debug)]
pub(crate) struct BothSheets {
    /// The lower point of each upper one: itself where both are joined.
    lower: Vec<usize>,
    /// Number of points.
    count: usize,
}

impl BothSheets {
    /// The sheet `upper`, ready to be inflated, and its image as one sheet, joined at the points that are sealed.
    pub(crate) fn join(upper: &Sheet, is_sealed: &[bool]) -> (Sheet, Self) {
        let count = upper.points.len();
        let mut points = upper.points.clone();
        let mut areas = upper.areas.clone();
        let mut lower: Vec<usize> = (0..count).collect();
        for point in 0..count {
            if is_sealed[point] {
                areas[point] *= 2.0;
            } else {
                lower[point] = points.len();
                points.push(upper.points[point]);
                areas.push(upper.areas[point]);
            }
        }
        let triangles = upper.pieces.len();
        let images = upper.pieces.iter().map(|piece| image_of(piece, &lower, triangles, upper.edge_count));
        let kinks = upper.kinks.iter().map(|kink| kink.with_points(&lower));
        // An eliminated node is followed by its image: what divides one sheet divides both.
        let mut order = Vec::with_capacity(points.len() + 2 * upper.edge_count);
        for node in &upper.order {
            if let Some(&image) = lower.get(*node) {
                order.push(*node);
                order.extend((image != *node).then_some(image));
            } else {
                let edge = points.len() + node - count;
                order.extend([edge, edge + upper.edge_count]);
            }
        }
        let sheet = Sheet {
            fabric: upper.fabric,
            pieces: upper.pieces.iter().cloned().chain(images).collect(),
            kinks: upper.kinks.iter().cloned().chain(kinks).collect(),
            edge_count: 2 * upper.edge_count,
            compression: upper.compression,
            points,
            areas,
            order,
        };
        let count = sheet.points.len();
        (sheet, Self { lower, count })
    }

    /// Both sheets of which the upper one has the shape `upper` and the lower one `lower`; joined points lie between both.
    pub(crate) fn joined(&self, upper: &State, lower: &State) -> State {
        let mut points = upper.points.clone();
        points.resize(self.count, [0.0; 3]);
        for (point, &image) in self.lower.iter().enumerate() {
            if image == point {
                let gap = minus(lower.points[point], upper.points[point]);
                points[point] = add_scaled(upper.points[point], 0.5, gap);
            } else {
                points[image] = lower.points[point];
            }
        }
        State { points, leans: upper.leans.iter().chain(&lower.leans).copied().collect() }
    }

    /// The shapes of the upper and of the lower sheet.
    pub(crate) fn parted(&self, state: &State) -> [State; 2] {
        let (upper_leans, lower_leans) = state.leans.split_at(state.leans.len() / 2);
        let lower_points = self.lower.iter().map(|&point| state.points[point]).collect();
        [
            State { points: state.points[..self.lower.len()].to_vec(), leans: upper_leans.to_vec() },
            State { points: lower_points, leans: lower_leans.to_vec() },
        ]
    }
}

/// The image of a piece of a sheet of so many `triangles` and `edges`, whose points have the images `lower`.
fn image_of(piece: &Piece, lower: &[usize], triangles: usize, edges: usize) -> Piece {
    let beyond = piece.beyond.map(|beyond| match beyond {
        Beyond::Neighbour { triangle, edge, corner } => {
            Beyond::Neighbour { triangle: triangle + triangles, edge, corner: lower[corner] }
        }
        Beyond::Image(_) | Beyond::Nothing => beyond,
    });
    Piece {
        corners: piece.corners.map(|corner| lower[corner]),
        edges: piece.edges.map(|edge| edge + edges),
        load: -piece.load,
        beyond,
        ..piece.clone()
    }
}

impl State {
    /// The image in the plane z = 0.
    pub(crate) fn image(&self) -> Self {
        Self {
            points: self.points.iter().map(|[x, y, z]| [*x, *y, -z]).collect(),
            leans: self.leans.iter().map(|lean| -lean).collect(),
        }
    }
}
