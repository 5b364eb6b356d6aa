//! The window: the part of a seam around the place where the new program continues it.

use std::collections::VecDeque;

use crate::emit::Decimals;
use crate::resume::resume_at::StopPoint;
use crate::resume::toolpath::{TimedMove, Toolpath};
use geom::{Path, Segment};
use proof::verify::Phase;
use proof::verify::gcode::MoveKind;

/// The continuation of the job.
pub(super) enum Next {
    /// In the seam that was interrupted.
    Within(Window),
    /// With the travel to the next seam: the index of its line.
    Travel(usize),
}

/// The moves of one seam, on the way down and in contact, from the requested distance before the stop.
pub(super) struct Window {
    steps: VecDeque<TimedMove>,
    /// Length of them all, seen from above, mm.
    length: f64,
    /// Path in contact completed at the stop, mm.
    pub(super) done: f64,
    /// The comment that begins the seam.
    pub(super) title: Option<String>,
}

impl Window {
    /// The moves around `stop`, from `back` mm before it; `None` if nothing is left.
    pub(super) fn enclosing(toolpath: &Toolpath<'_>, stop: &StopPoint, back: f64) -> Option<Next> {
        // On the way up all of the seam has been sealed, overlap and all: the next one follows.
        let in_contact = stop.phase == Phase::Contact;
        let mut window = Self { steps: VecDeque::new(), length: 0.0, done: stop.along, title: None };
        let (mut travel, mut past) = (toolpath.hot, false);
        for step in toolpath.moves() {
            if step.phase == Phase::Clear && step.step.kind == MoveKind::Rapid && step.step.path.is_some() {
                travel = step.step.line - 1;
            }
            if past {
                // One more move is kept, because nothing of the interrupted one may be left.
                if step.phase == Phase::Contact {
                    window.add(step);
                }
                break;
            }
            if in_contact {
                window.add(step);
                window.forget(back);
                past = step.step.line >= stop.line;
                if past {
                    let title = step.title.and_then(|line| toolpath.line(line));
                    window.title = title.map(|line| line.trim_end().to_owned());
                }
            } else if step.step.line >= stop.line && step.phase == Phase::Down {
                // During the ramp down, or between seams, the next seam is the one that begins here.
                return Some(Next::Travel(travel.max(toolpath.hot)));
            }
        }
        in_contact.then_some(Next::Within(window))
    }

    /// Adds the next move; a ramp down begins a new seam.
    fn add(&mut self, step: TimedMove) {
        let is_new =
            step.phase == Phase::Down && self.steps.back().is_some_and(|last| last.phase != Phase::Down);
        if step.phase == Phase::Clear || is_new {
            self.steps.clear();
            self.length = 0.0;
        }
        if !matches!(step.phase, Phase::Down | Phase::Contact) {
            return;
        }
        self.length += step.flat();
        self.steps.push_back(step);
    }

    /// Drops the moves farther than `back` mm before the last one.
    fn forget(&mut self, back: f64) {
        let last = self.steps.back().map_or(0.0, TimedMove::flat);
        while let Some(first) = self.steps.front()
            && self.length - first.flat() - last > back
        {
            self.length -= first.flat();
            let _ = self.steps.pop_front();
        }
    }

    /// Position of the window's start along the path in contact, mm: negative on the way down.
    fn begins(&self) -> f64 {
        let down: f64 = self.down().map(TimedMove::flat).sum();
        self.contact().next().map_or(0.0, |first| first.along) - down
    }

    fn down(&self) -> impl Iterator<Item = &TimedMove> {
        self.steps.iter().take_while(|step| step.phase == Phase::Down)
    }

    fn contact(&self) -> impl Iterator<Item = &TimedMove> {
        self.steps.iter().filter(|step| step.phase == Phase::Contact)
    }

    /// The last place at or before `place`, mm along the run, at which the iron stops: the start of the run, or a dwell.
    pub(super) fn stop_before(&self, place: f64) -> Option<(f64, usize)> {
        let begins = self.down().last().map(|step| (0.0, step.step.line));
        let stops = self.contact().filter(|step| step.rests);
        let ends = stops.map(|step| (step.along + step.flat(), step.step.line));
        begins.into_iter().chain(ends).take_while(|(end, _)| *end <= place + 1e-6).last()
    }

    /// The moves from the stop at `place`, mm along the run, to the next one, and the line of the last; `None` if it lies beyond the
    /// window.
    pub(super) fn run_from(&self, place: f64) -> Option<(Vec<Segment>, usize)> {
        let mut moves = self.contact().skip_while(|step| step.along < place - 1e-6);
        let mut pieces = Vec::new();
        let end = moves.find(|step| {
            pieces.extend(step.step.path);
            step.rests
        })?;
        Some((pieces, end.step.line))
    }

    /// The ramp down along the seam that ends at `place`; `ramp` is its length.
    pub(super) fn way_down(&self, place: f64, ramp: f64) -> Vec<Segment> {
        let begins = self.begins();
        self.track().part((place - ramp - begins).max(0.0), place - begins).segments
    }

    fn track(&self) -> Path {
        Path::open(self.steps.iter().filter_map(|step| step.step.path).collect())
    }

    /// The rest of the move that contains `place`, and the line of that move. The rest is at least `least_length` long, if necessary with
    /// the next move, because the old lines begin at a stop.
    pub(super) fn rest_from(&self, place: f64, least_length: f64) -> Option<(Vec<Segment>, usize)> {
        // A remainder of a move within rounding is ignored; the next move is used instead.
        let ends = [place + least_length.max(1e-6), place + 1e-6];
        let last_move =
            ends.into_iter().find_map(|end| self.contact().find(|step| step.along + step.flat() > end));
        let last = last_move.or_else(|| self.contact().last())?;
        let begins = self.begins();
        let rest = last_move
            .map(|step| self.track().part(place - begins, step.along + step.flat() - begins).segments);
        Some((rest.unwrap_or_default(), last.step.line))
    }
}

/// The first feed move at or after the line of index `line`, with the feed in force there: its index and text; `None` if it has its own
/// feed.
pub(super) fn with_feed(toolpath: &Toolpath<'_>, line: usize) -> Option<(usize, String)> {
    let is_next = |step: &TimedMove| step.step.line > line && step.step.kind == MoveKind::Feed;
    let step = toolpath.moves().find(is_next)?.step;
    let text = toolpath.line(step.line - 1).filter(|text| !text.contains(['F', ';', '(']))?;
    Some((step.line - 1, format!("{} F{}", text.trim_end(), Decimals::exactly(9).text(step.feed?))))
}
