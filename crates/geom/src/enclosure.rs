//! Which of many closed paths enclose a point.

use crate::{Bounds, BoxIndex, Path, Point, Segment};

/// Closed paths, cut into pieces that rise or fall all along: a ray to the right leaves a path as often as it enters it.
#[derive(Debug)]
pub struct Enclosures {
    /// A piece without an extreme ordinate inside, and the number of its path.
    pieces: Vec<(Segment, [Point; 2], usize)>,
    index: BoxIndex,
    right: f64,
}

impl Enclosures {
    /// The closed paths, counted from 0 in this order.
    pub fn new<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Self {
        let mut pieces = Vec::new();
        for (number, path) in paths.into_iter().enumerate() {
            for segment in &path.segments {
                for piece in monotone(segment) {
                    pieces.push((piece, [piece.start(), piece.end()], number));
                }
            }
            // Ends of neighbours agree to rounding only: the ray must see one point.
            let first = pieces.iter().rposition(|(_, _, other)| *other != number).map_or(0, |last| last + 1);
            for i in first..pieces.len() {
                let next = if i + 1 < pieces.len() { i + 1 } else { first };
                pieces[i].1[1] = pieces[next].1[0];
            }
        }
        let boxes: Vec<Bounds> = pieces.iter().map(|(piece, ends, _)| piece.bounds_of(*ends)).collect();
        let right = boxes.iter().map(|bounds| bounds.max.x).fold(f64::NEG_INFINITY, f64::max);
        let index = BoxIndex::new(boxes.into_iter());
        Self { pieces, index, right }
    }

    /// The numbers of the paths that enclose `p` (an odd number of times), ascending.
    pub fn enclosing(&self, p: Point) -> Vec<usize> {
        let ray = Bounds { min: p, max: Point::new(self.right.max(p.x), p.y) };
        let mut crossed: Vec<usize> = Vec::new();
        self.index.visit(&ray, |i| {
            let (piece, [start, end], path) = &self.pieces[i];
            if (start.y <= p.y) != (end.y <= p.y) && abscissa(piece, *start, *end, p.y) > p.x {
                crossed.push(*path);
            }
        });
        crossed.sort_unstable();
        let odd = crossed.chunk_by(|a, b| a == b).filter(|run| run.len() % 2 == 1);
        odd.filter_map(|run| run.first().copied()).collect()
    }
}

/// The parts of a segment between its lowest and highest points.
fn monotone(segment: &Segment) -> Vec<Segment> {
    let Segment::Arc(arc) = segment else { return vec![*segment] };
    let top = std::f64::consts::FRAC_PI_2;
    let mut fractions = vec![0.0, 1.0];
    // Turns at which the tangent is level lie half a turn apart.
    let first = ((arc.start_angle.min(arc.end_angle()) - top) / (2.0 * top)).ceil();
    for i in 0..3 {
        let t = ((first + f64::from(i)) * 2.0 * top + top - arc.start_angle) / arc.sweep;
        if t > 0.0 && t < 1.0 {
            fractions.push(t);
        }
    }
    fractions.sort_by(f64::total_cmp);
    fractions.windows(2).map(|t| segment.part(t[0], t[1])).collect()
}

/// The abscissa at which the monotone `piece` from `start` to `end` has the ordinate `y`.
fn abscissa(piece: &Segment, start: Point, end: Point, y: f64) -> f64 {
    match piece {
        Segment::Line(_) => start.x + (y - start.y) / (end.y - start.y) * (end.x - start.x),
        Segment::Arc(arc) => {
            let half = (arc.radius * arc.radius - (y - arc.center.y).powi(2)).max(0.0).sqrt();
            let right = piece.point(0.5).x >= arc.center.x;
            arc.center.x + if right { half } else { -half }
        }
    }
}
