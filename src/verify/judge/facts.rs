//! What a program's comments should say, from the design alone.
//!
//! A comment is compared word by word, and a number by its value: see `comments`.

use crate::design::{PlacedStar, Side};
use crate::spec::{Comments, DwellUnit, Heating, StepRate};
use crate::verify::judge::expected::Expected;

/// Where a comment stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Before the first line of code.
    Head,
    /// Before the first motion.
    Start,
    /// Between the first motion and the last.
    Body,
    /// Behind the last motion.
    End,
}

/// One program, of which is told what its comments should say.
pub(super) struct Facts<'a> {
    pub(super) expected: &'a Expected<'a>,
    pub(super) hot: bool,
    pub(super) sheet: usize,
    /// The stars, in the order of sealing.
    pub(super) stars: &'a [&'a PlacedStar],
    /// Whether the program is of strokes and waits.
    pub(super) chopped: bool,
    /// Time of the whole program, s.
    pub(super) seconds: f64,
}

impl Facts<'_> {
    /// All comments but those of progress and the last, in order.
    pub(super) fn all(&self) -> Vec<(String, Place)> {
        let script = &self.expected.machine.script;
        let at = |place: Place| move |text: String| (text, place);
        let mut all: Vec<_> = self.head().into_iter().map(at(Place::Head)).collect();
        all.extend(self.remarks(&script.start).map(at(Place::Start)));
        all.extend(self.body().into_iter().map(at(Place::Body)));
        all.extend(self.remarks(&script.end).map(at(Place::End)));
        all
    }

    /// The remarks of lines of the profile.
    fn remarks<'l>(&self, lines: &'l [String]) -> impl Iterator<Item = String> + use<'l> {
        let mark = self.expected.machine.controller.comments;
        let remark = move |line: &String| match mark {
            Comments::Semicolon => line.split_once(';').map(|(_, text)| text.trim().to_owned()),
            Comments::Parentheses => {
                let (_, text) = line.split_once('(')?;
                Some(text.trim_end().trim_end_matches(')').trim().to_owned())
            }
        };
        lines.iter().filter_map(remark).filter(|text| !text.is_empty())
    }

    fn head(&self) -> Vec<String> {
        let mut out = self.title();
        if self.hot {
            let seams = self.seams();
            self.job(&mut out);
            if self.chopped {
                self.strokes(&mut out);
            } else {
                out.extend(self.rounding());
            }
            let requires = &self.expected.machine.script.requires;
            out.extend(requires.iter().map(|line| format!("requires: {line}")));
            out.extend(seams.iter().map(|(words, _)| format!("length: {words}")));
            let length: f64 = seams.iter().map(|(_, length)| length).sum();
            out.push(format!("total: length_mm={length} time_s={}", self.seconds));
        }
        out
    }

    fn body(&self) -> Vec<String> {
        let mut out = Vec::new();
        if self.hot {
            let t = self.expected.spec.seal.temperature.0;
            out.push(format!("heat: temperature_C={t}"));
            if self.expected.machine.controller.heating == Heating::Operator {
                out.push(format!("set the iron to {t} C, standby off, wait until hot, press start"));
            }
            out.extend(self.seams().iter().map(|(words, _)| format!("seam: {words}")));
        }
        out
    }

    fn title(&self) -> Vec<String> {
        let purpose = if self.hot { "seal" } else { "trace" };
        let stars = match (self.stars.first(), self.stars.last()) {
            (Some(first), Some(last)) if first.index != last.index => {
                format!("{}-{}", first.index, last.index)
            }
            (Some(only), _) => only.index.to_string(),
            _ => "none".to_owned(),
        };
        vec![
            format!("stargrip-cam {purpose} program"),
            format!("name: {}", self.expected.spec.name),
            format!("program: purpose={purpose} sheet={} stars={stars}", self.sheet),
            "frame: origin at lower left of the sheet, Z0 on the release layer".to_owned(),
        ]
    }

    /// What `resume` goes by.
    fn job(&self, out: &mut Vec<String>) {
        let Expected { spec, machine, .. } = *self.expected;
        let (seal, controller, process) = (&spec.seal, &machine.controller, &machine.process);
        let (t, v, w, o) = (seal.temperature.0, seal.speed.0, seal.band.0, seal.overlap.0);
        out.push(format!("seal: temperature_C={t} speed_mm_s={v} band_mm={w} overlap_mm={o}"));
        let heating = match controller.heating {
            Heating::Operator => "operator",
            Heating::Hotend => "hotend",
        };
        let arcs = if controller.arcs { "yes" } else { "no" };
        let (dialect, line) = (controller.dialect.name(), controller.line_length);
        out.push(format!("machine: dialect={dialect} heating={heating} arcs={arcs} line={line}"));
        let heights = &process.heights;
        let (contact, travel, park) = (heights.contact.0, heights.travel.0, heights.park.0);
        let ramp = process.ramp.0;
        out.push(format!("heights: contact_mm={contact} travel_mm={travel} park_mm={park} ramp_mm={ramp}"));
        let unit = match controller.dwell.unit {
            DwellUnit::Seconds => "s",
            DwellUnit::Milliseconds => "ms",
        };
        let (path, rapid) = (spec.accuracy.path.0, process.travel_speed.0);
        out.push(format!("path: tolerance_mm={path} travel_mm_s={rapid} dwell={unit}"));
    }

    /// How strokes are made, and what they rely on.
    fn strokes(&self, out: &mut Vec<String>) {
        let Expected { spec, machine, .. } = *self.expected;
        let (motion, seal) = (&machine.motion, &spec.seal);
        let (Some(speed), Some(a)) = (motion.chop_speed(), motion.acceleration.map(|a| a.0)) else { return };
        let step = machine.controller.dwell.step.0;
        let delay = motion.start_delay.0;
        let least = (delay + speed / a + step) / (1.0 / seal.speed.0 - 1.0 / speed);
        let longest = least.max(seal.band.0 / 12.0);
        out.push(format!("chop: feed_mm_min={} longest_mm={longest}", speed * 60.0));
        out.push(format!("chop-rest: acceleration_mm_s2={a} step_s={step}"));
        out.push(format!("chop-start: delay_s={delay}"));
        if let (StepRate::AtLeast(rate), Some([x, y, z]), Some(tick)) =
            (motion.step_rate, motion.steps_per_mm, motion.tick)
        {
            out.push(format!("chop-steps: x={x} y={y} z={z}"));
            out.push(format!("chop-ticks: rate_Hz={rate} tick_s={}", tick.0));
        }
        // What steps in ticks is timed with the ramps of Z, too.
        let ticks = motion.tick.is_some_and(|tick| tick.0 > 0.0);
        let axes = if ticks { "X, Y and Z" } else { "X and Y" };
        out.push(format!("requires: an acceleration of {a} mm/s2 in {axes}"));
        if let Some([x, y, _]) = motion.steps_per_mm {
            out.push(format!("requires: at least {x} and {y} steps/mm in X and Y"));
        }
    }

    /// How much too fast whole steps a second may be, where nothing is chopped (Marlin, planner.cpp, `nominal_rate`): the
    /// slowest axis-equal direction makes r of them, run as the next whole number; just above that, one more.
    fn rounding(&self) -> Option<String> {
        let Expected { spec, machine, .. } = *self.expected;
        let [x, y, _] =
            machine.motion.steps_per_mm.filter(|_| machine.motion.tick.is_some_and(|t| t.0 == 0.0))?;
        let slowest = spec.seal.speed.0 / (1.0 / x).hypot(1.0 / y);
        let next = slowest.ceil();
        let percent = 100.0 * f64::max((next - slowest) / slowest, 1.0 / next);
        Some(format!(
            "rounding: whole steps/s, at worst {:.1} per cent too fast",
            (10.0 * percent - 1e-9).ceil() / 10.0
        ))
    }

    /// The words about each seam, and its length in contact, mm.
    fn seams(&self) -> Vec<(String, f64)> {
        let Expected { spec, machine, design, .. } = *self.expected;
        let heights = &machine.process.heights;
        let (rise, ramp) = (heights.travel.0 - heights.contact.0, machine.process.ramp.0);
        let all =
            self.stars.iter().flat_map(|star| design.part(star).seams.iter().map(|seam| (star.index, seam)));
        all.zip(1..)
            .map(|((star, seam), i)| {
                let side = if seam.side == Side::Hole { "inner" } else { "outer" };
                let length = seam.run().length();
                let ramps: f64 = [seam.lead_in(ramp), seam.lead_out(ramp)]
                    .iter()
                    .map(|path| path.length().hypot(rise))
                    .sum();
                let time = (length + ramps) / spec.seal.speed.0;
                (format!("seam={i} star={star} loop={side} length_mm={length} time_s={time}"), length)
            })
            .collect()
    }
}
