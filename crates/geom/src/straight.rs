//! Nearly straight is straight: curves that leave their chord by less than the tolerance are lines, and arcs of kilometres are chords.
//!
//! An arc of so large a radius states its ends to few decimals, and crosses its neighbours far from where they meet.

use crate::{Arc, Line, Point, Segment};

/// Length up to which a segment is left out, mm: rounding, far below the resolution of a machine or a later step.
pub const SHORT: f64 = 1e-9;

/// Largest turn of a straight curve, rad: the corners that its chord leaves with its neighbours are smaller than the finest step of an
/// offset by a band.
const STRAIGHT_TURN: f64 = 2e-4;
/// Arcs of a larger radius are written as chords, mm: 100 m. Firmwares compute arcs to seven digits, which are 0.01 mm here.
pub const LARGEST_RADIUS: f64 = 1e5;

/// Whether a curve that leaves its chord by `rise` and turns by `turn` is straight.
pub fn is_straight(rise: f64, turn: f64, tolerance: f64) -> bool {
    rise <= tolerance && turn <= STRAIGHT_TURN
}

/// Appends an arc between `ends`: as it is, or as chords within `tolerance` where its radius is too large. `false` if `segments` would exceed
/// `limit` segments.
pub fn push_arc(
    arc: &Arc,
    ends: [Point; 2],
    tolerance: f64,
    limit: usize,
    segments: &mut Vec<Segment>,
) -> bool {
    if arc.radius <= LARGEST_RADIUS {
        segments.push((*arc).into());
        return segments.len() <= limit;
    }
    let widest = 2.0 * (2.0 * tolerance / arc.radius).sqrt();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive count; a cast saturates"
    )]
    let count = ((arc.sweep.abs() / widest).ceil() as usize).max(1);
    if count > limit.saturating_sub(segments.len()) {
        return false;
    }
    let mut start = ends[0];
    for i in 1..=count {
        #[expect(clippy::cast_precision_loss, reason = "below the limit of segments")]
        let fraction = i as f64 / count as f64;
        let end = if i == count { ends[1] } else { arc.at_angle(arc.start_angle + arc.sweep * fraction) };
        push_line(Line::new(start, end), segments);
        start = end;
    }
    true
}

/// Appends a line unless it is too short.
pub fn push_line(line: Line, segments: &mut Vec<Segment>) {
    if line.length() > SHORT {
        segments.push(line.into());
    }
}
