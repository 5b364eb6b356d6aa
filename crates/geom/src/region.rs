//! The region inside a closed path.

use std::f64::consts::TAU;

use crate::{Path, Point, Segment};

impl Path {
    /// Signed area enclosed by a closed path, positive if it runs counterclockwise (exact for lines and arcs).
    ///
    /// Green's theorem: half the sum of the vertices' vector products plus each arc's circular segment,
    /// r^2 (sweep - sin sweep) / 2.
    pub fn area(&self) -> f64 {
        let Some(origin) = self.start() else { return 0.0 };
        self.segments
            .iter()
            .map(|segment| {
                let chord = (segment.start() - origin).cross(segment.end() - origin);
                let cap = match segment {
                    Segment::Line(_) => 0.0,
                    Segment::Arc(arc) => arc.radius * arc.radius * (arc.sweep - libm::sin(arc.sweep)),
                };
                0.5 * (chord + cap)
            })
            .sum()
    }

    /// The number of counterclockwise turns of a closed path around `p` (which must not lie on the path).
    pub fn winding_number(&self, p: Point) -> i32 {
        let turn: f64 = self.segments.iter().map(|segment| turn_around(segment, p)).sum();
        // A sum of a few dozen angles is a whole number of turns to about 1e-14.
        #[expect(clippy::cast_possible_truncation, reason = "a winding number is a small whole number")]
        let turns = (turn / TAU).round() as i32;
        turns
    }

    /// Whether `p` lies inside a closed path.
    pub fn encloses(&self, p: Point) -> bool {
        self.bounds().contains(p) && self.winding_number(p) != 0
    }
}

/// Angle by which the direction from `p` to a point on the segment turns from its start to its end.
fn turn_around(segment: &Segment, p: Point) -> f64 {
    let pieces = match segment {
        Segment::Line(_) => 1,
        // Below 90 degrees the chord and the arc lie on the same side of any point outside the cap.
        Segment::Arc(_) => 4,
    };
    (0..pieces)
        .map(|i| {
            let part = segment.part(f64::from(i) / f64::from(pieces), f64::from(i + 1) / f64::from(pieces));
            let (a, b) = (part.start() - p, part.end() - p);
            let chord = libm::atan2(a.cross(b), a.dot(b));
            let Segment::Arc(arc) = part else { return chord };
            // For a point between chord and arc the chord passes on the wrong side: one turn is missing.
            let in_circle = p.distance(arc.center) < arc.radius;
            let beyond_chord = (part.end() - part.start()).cross(p - part.start()) * arc.sweep < 0.0;
            if in_circle && beyond_chord { chord + TAU * arc.sweep.signum() } else { chord }
        })
        .sum()
}
