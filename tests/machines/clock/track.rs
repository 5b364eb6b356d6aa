//! The track of the iron: the mean speed of every stretch in contact, its windows, and the total time.

use super::legs::Leg;

/// Path between two marks, mm.
const MARK: f64 = 0.25;
/// Tolerance of a mark, mm.
const ON_MARK: f64 = 1e-3;

/// A stretch of cuts between two travels.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stretch {
    /// First line of the stretch.
    pub(crate) line: usize,
    /// Length in the program, mm.
    pub(crate) length: f64,
    /// From the start of its first cut to the end of the wait after its last, s.
    pub(crate) seconds: f64,
    /// The time at each mark, a quarter of a millimetre apart.
    marks: Vec<f64>,
    begun: f64,
}

/// A record of one program.
#[derive(Debug, Default)]
pub(crate) struct Track {
    /// Now, s.
    pub(crate) now: f64,
    pub(crate) stretches: Vec<Stretch>,
    /// The start time of each line's first leg.
    pub(crate) lines: Vec<(usize, f64)>,
    /// The current stretch.
    open: Option<Stretch>,
    leg: f64,
    done: f64,
}

impl Stretch {
    /// mm/s.
    pub(crate) fn speed(&self) -> f64 {
        self.length / self.seconds
    }

    /// The least and the greatest speed within `window` mm.
    pub(crate) fn windows(&self, window: f64) -> (f64, f64) {
        let steps = (window / MARK).round();
        let pairs = self.marks.iter().zip(self.marks.iter().skip(steps as usize));
        let speeds = pairs.map(|(begin, end)| steps * MARK / (end - begin));
        speeds.fold((f64::INFINITY, 0.0), |(least, most), v| (v.min(least), v.max(most)))
    }
}

impl Track {
    /// A leg begins now.
    pub(crate) fn begin(&mut self, leg: &Leg) {
        (self.leg, self.done) = (leg.length(), 0.0);
        self.lines.push((leg.line, self.now));
        if !leg.cut {
            self.halt();
        } else if self.open.is_none() {
            let start = self.now;
            self.open =
                Some(Stretch { line: leg.line, begun: start, marks: vec![start], ..Stretch::default() });
        }
    }

    /// The part `share` of the leg is reached after `seconds` more, at constant speed.
    pub(crate) fn moved(&mut self, share: f64, seconds: f64) {
        let (begun, way) = (self.now, (share - self.done) * self.leg);
        self.now += seconds;
        self.done = share;
        let Some(open) = &mut self.open else { return };
        let length_before = open.length;
        open.length += way;
        loop {
            let mark = MARK * open.marks.len() as f64;
            if mark > open.length + ON_MARK {
                break;
            }
            open.marks.push(begun + seconds * (mark - length_before) / way);
        }
        open.seconds = self.now - open.begun;
    }

    /// Nothing moves for this time: a dwell, which belongs to the stretch.
    pub(crate) fn rest(&mut self, seconds: f64) {
        self.now += seconds;
        if let Some(open) = &mut self.open {
            let last_mark = MARK * (open.marks.len() as f64 - 1.0);
            if let Some(mark) = open.marks.last_mut().filter(|_| (open.length - last_mark).abs() < ON_MARK) {
                // The mark is reached before the rest and left after it: half of the rest counts for each side.
                *mark += 0.5 * seconds;
            }
            open.seconds = self.now - open.begun;
        }
    }

    /// A stretch ends.
    pub(crate) fn halt(&mut self) {
        self.stretches.extend(self.open.take());
    }
}
