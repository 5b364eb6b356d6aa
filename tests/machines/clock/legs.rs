//! Legs: the straight paths that a controller plans, made from its moves by its own rules for modal words and arcs.

use std::f64::consts::TAU;

use super::text::{Command, Text, Words};

/// A straight path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    /// The line of its move.
    pub(crate) line: usize,
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
    /// mm/min; `None` for the highest speed of the axes.
    pub(crate) feed: Option<f64>,
    /// Whether it was programmed as G1, G2 or G3: in contact, except in traces and feed checks.
    pub(crate) cut: bool,
}

/// The controller's tasks, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Task {
    Leg(Leg),
    /// The P word of a dwell.
    Dwell(f64),
    Halt,
}

/// The controller's rules for reading moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    /// Whether G0 runs at the feed in force, as G1 does.
    pub(crate) modal_travel: bool,
    /// The lowest feed until M203 I sets another, mm/min.
    pub(crate) lowest_feed: f64,
    /// Number of chords for an arc of this radius (mm), angle (rad) and feed (mm/min).
    pub(crate) chords: fn(f64, f64, f64) -> f64,
}

impl Leg {
    pub(crate) fn way(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.to[i] - self.from[i])
    }

    pub(crate) fn length(&self) -> f64 {
        length(self.way())
    }
}

pub(crate) fn length(way: [f64; 3]) -> f64 {
    way.iter().map(|d| d * d).sum::<f64>().sqrt()
}

/// The tasks of a program whose iron starts above the sheet's corner at the first programmed height, where every program leaves it.
pub(crate) fn tasks(text: &Text, reading: &Reading) -> Vec<Task> {
    let mut tasks = Vec::new();
    let height = text.commands.iter().find_map(|(_, command)| match command {
        Command::Move(words) => words.to[2],
        _ => None,
    });
    let corner = |axis| text.fact(axis).unwrap_or(0.0);
    let mut position = [corner("place.x_mm"), corner("place.y_mm"), height.unwrap_or(0.0)];
    let (mut feed, mut lowest) = (0.0, reading.lowest_feed);
    for (line, command) in &text.commands {
        match command {
            Command::Dwell(time) => tasks.push(Task::Dwell(*time)),
            Command::Halt => tasks.push(Task::Halt),
            Command::LowestFeed(feed) => lowest = *feed,
            Command::Move(words) => {
                feed = words.feed.unwrap_or(feed);
                let rapid = words.code == 0 && !reading.modal_travel;
                let feed_in_force = (!rapid).then(|| f64::max(feed, lowest));
                for to in ends(
                    words,
                    position,
                    feed_in_force
                        .map_or(0.0, |feed| (reading.chords)(radius(words), angle(words, position), feed)),
                ) {
                    let leg =
                        Leg { line: *line, from: position, to, feed: feed_in_force, cut: words.code > 0 };
                    position = to;
                    if leg.length() > 0.0 {
                        tasks.push(Task::Leg(leg));
                    }
                }
            }
        }
    }
    tasks
}

fn radius(words: &Words) -> f64 {
    words.center[0].hypot(words.center[1])
}

/// The angle of an arc, rad: above 0 and at most a full turn, below 0 clockwise.
fn angle(words: &Words, position: [f64; 3]) -> f64 {
    let [i, j] = words.center;
    let end = [words.to[0].unwrap_or(position[0]), words.to[1].unwrap_or(position[1])];
    let (u, v) = ([-i, -j], [end[0] - position[0] - i, end[1] - position[1] - j]);
    let turn = (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]);
    match words.code {
        2 if turn >= -5e-7 => turn - TAU,
        3 if turn <= 5e-7 => turn + TAU,
        _ => turn,
    }
}

/// The ends of the chords of a move.
fn ends(words: &Words, position: [f64; 3], chords: f64) -> Vec<[f64; 3]> {
    let last: [f64; 3] = std::array::from_fn(|i| words.to[i].unwrap_or(position[i]));
    if words.code < 2 {
        return vec![last];
    }
    let ([i, j], angle) = (words.center, angle(words, position));
    let (mut corners, mut k) = (Vec::new(), 1.0);
    while k < chords {
        let ((s, c), height) =
            ((angle * k / chords).sin_cos(), position[2] + (last[2] - position[2]) * k / chords);
        corners.push([position[0] + i - i * c + j * s, position[1] + j - i * s - j * c, height]);
        k += 1.0;
    }
    corners.push(last);
    corners
}
