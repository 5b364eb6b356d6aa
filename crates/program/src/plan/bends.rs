//! The time that a fast tool loses where it starts, bends and stops.
//!
//! An iron is so slow that none of it counts. A laser brakes at corners: GRBL's planner (planner.c) passes a bend at
//! `v_j^2 = a d s / (1 - s)`, with d the junction deviation ($11) and s the sine of half the angle between the ways. To brake from v to
//! v_j and to speed up again takes `(v - v_j)^2 / (a v)` longer than going on. Ways that are shorter than it takes to brake lose
//! less; they are not looked at.

use geom::Segment;

/// Junction deviation, mm: the default of GRBL and grblHAL ($11; defaults.h, config.h) and of FluidNC.
const DEVIATION: f64 = 0.01;

/// A direction in space, as a unit vector.
type Direction = [f64; 3];

/// A tool on its way along a path, which has not stopped yet.
#[derive(Clone, Copy, Debug)]
pub struct FastTool {
    /// Speed along the path, mm/s.
    speed: f64,
    /// Acceleration of each axis, mm/s^2.
    acceleration: f64,
    /// Direction of the path so far.
    direction: Direction,
}

impl FastTool {
    /// The tool at the end of `piece`, which it follows at `speed`, mm/s, with a rise of `rise` mm.
    pub fn following(piece: &Segment, rise: f64, speed: f64, acceleration: f64) -> Self {
        Self { speed, acceleration, direction: direction(piece, rise, 1.0) }
    }

    /// Time lost where a tool begins to follow `piece` after `previous`, or from rest, s.
    pub fn loss(self, piece: &Segment, rise: f64, previous: Option<Self>) -> f64 {
        let start = direction(piece, rise, 0.0);
        let Some(previous) = previous else { return 0.5 * self.speed / self.limit(start) };
        let bend: [f64; 3] = std::array::from_fn(|i| start[i] - previous.direction[i]);
        let turn = length(bend);
        if turn < 1e-6 {
            return 0.0;
        }
        // The ways meet at an angle whose cosine is that of the turn, negative.
        let sin_half = (1.0 - 0.25 * turn * turn).max(0.0).sqrt();
        let junction = self.limit(bend.map(|d| d / turn)) * DEVIATION * sin_half / (1.0 - sin_half);
        let passed = junction.sqrt().min(self.speed);
        let slowness = 0.5 * (self.speed - passed).powi(2) / self.speed;
        slowness / self.limit(previous.direction) + slowness / self.limit(start)
    }

    /// Time lost where it stops, s.
    pub fn stop(self) -> f64 {
        0.5 * self.speed / self.limit(self.direction)
    }

    /// Acceleration along `direction`, mm/s^2: no axis exceeds its own.
    fn limit(self, direction: Direction) -> f64 {
        self.acceleration / direction.iter().fold(0.0_f64, |most, part| most.max(part.abs()))
    }
}

/// The direction of `piece` with a rise of `rise` mm at its part `t`.
fn direction(piece: &Segment, rise: f64, t: f64) -> Direction {
    let (flat, tangent) = (piece.length(), piece.tangent(t));
    let way = [tangent.x * flat, tangent.y * flat, rise];
    let distance = length(way);
    way.map(|part| part / distance)
}

fn length(way: [f64; 3]) -> f64 {
    way.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::{Line, Point};

    fn line(from: (f64, f64), to: (f64, f64)) -> Segment {
        Line::new(Point::new(from.0, from.1), Point::new(to.0, to.1)).into()
    }

    /// 10 mm/s and 500 mm/s^2: 10 ms at each end; straight on nothing; round a right angle at 3.5 mm/s.
    #[test]
    fn corners_cost_what_braking_and_starting_cost() {
        let first = line((0.0, 0.0), (9.0, 0.0));
        let tool = FastTool::following(&first, 0.0, 10.0, 500.0);
        assert!((tool.loss(&first, 0.0, None) - 0.01).abs() < 1e-12 && (tool.stop() - 0.01).abs() < 1e-12);
        assert_eq!(tool.loss(&line((9.0, 0.0), (18.0, 0.0)), 0.0, Some(tool)), 0.0);
        let s = 0.5_f64.sqrt();
        let passed = (500.0 / s * 0.01 * s / (1.0 - s)).sqrt();
        let loss = tool.loss(&line((9.0, 0.0), (9.0, 9.0)), 0.0, Some(tool));
        assert!((loss - (10.0 - passed).powi(2) / (500.0 * 10.0)).abs() < 1e-9, "{passed}");
        // Back the way it came it stops.
        let back = line((9.0, 0.0), (0.0, 0.0));
        assert!((tool.loss(&back, 0.0, Some(tool)) - 0.02).abs() < 1e-9);
    }
}
