//! The record: what a program's structured comments say of its machine and its seal.

use crate::plan::{Chop, Pace};
use crate::resume::ResumeFault;
use crate::spec::{Comments, Dialect, DwellUnit, Dwells, Heating, Heights, Machine, Motion, Seal};
use crate::units::{Duration, Length, Speed, Temperature};
use crate::verify::gcode;
use crate::verify::gcode::Comment;

/// What a file says of itself.
#[derive(Clone, Debug)]
pub(super) struct Record {
    pub(super) machine: Machine,
    pub(super) seal: Seal,
    pub(super) path: Length,
    pub(super) pace: Pace,
}

/// Most lines looked at for the header.
const HEADER: usize = 1000;

impl Record {
    /// Reads the header.
    pub(super) fn read(text: &str) -> Result<Self, ResumeFault> {
        let comments = if text.starts_with('(') { Comments::Parentheses } else { Comments::Semicolon };
        let header: Vec<Comment> = text
            .lines()
            .take(HEADER)
            .map_while(|line| match comments {
                Comments::Semicolon => line.strip_prefix(';'),
                Comments::Parentheses => line.strip_prefix('(').and_then(|line| line.strip_suffix(')')),
            })
            .map(|text| Comment { line: 0, text: text.trim().to_owned() })
            .collect();
        let find = |key: &'static str| {
            header.iter().find(|comment| comment.key() == Some(key)).ok_or(ResumeFault::NotOurs(key))
        };
        let number = |key: &'static str, word: &str| find(key)?.number(word).ok_or(ResumeFault::NotOurs(key));
        if find("program")?.word("purpose") != Some("seal") {
            return Err(ResumeFault::NotOurs("program: purpose=seal"));
        }
        let machine = find("machine")?;
        let name = machine.word("dialect").unwrap_or_default();
        let dialect = Dialect::NAMES.iter().find(|(known, _)| *known == name).map(|(_, dialect)| *dialect);
        let heating = match machine.word("heating") {
            Some("hotend") => Heating::Hotend,
            _ => Heating::Operator,
        };
        let unit = match find("path")?.word("dwell") {
            Some("ms") => DwellUnit::Milliseconds,
            _ => DwellUnit::Seconds,
        };
        let pace = if find("chop").is_ok() {
            // Nothing that we write is smaller or larger; strokes without length would never end.
            let within = |key, word| {
                number(key, word).and_then(|x| {
                    if (1e-4..=1e7).contains(&x) { Ok(x) } else { Err(ResumeFault::NotOurs(key)) }
                })
            };
            Pace::Chopped(Chop {
                speed: within("chop", "feed_mm_min")? / 60.0,
                longest: within("chop", "longest_mm")?,
                acceleration: within("chop-rest", "acceleration_mm_s2")?,
                step: number("chop-rest", "step_s")?,
            })
        } else {
            Pace::Steady
        };
        let step = if let Pace::Chopped(chop) = pace { chop.step } else { 1e-3 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a line's length, kept in range"
        )]
        let line_length = number("machine", "line")?.clamp(40.0, 255.0) as usize;
        let length = |key, word| number(key, word).map(Length);
        let machine = Machine {
            name: name.to_owned(),
            description: String::new(),
            dialect: dialect.ok_or(ResumeFault::NotOurs("machine"))?,
            work_area: None,
            line_length,
            comments,
            arcs: machine.word("arcs") == Some("yes"),
            dwell: Dwells { unit, step: Duration(step) },
            heating,
            spring_loaded: true,
            heights: Heights {
                contact: length("heights", "contact_mm")?,
                travel: length("heights", "travel_mm")?,
                park: length("heights", "park_mm")?,
            },
            ramp: length("heights", "ramp_mm")?,
            travel_speed: number("path", "travel_mm_s").map(Speed)?,
            trace_speed: Speed(1.0),
            motion: Motion::UNKNOWN,
            keep_out: Vec::new(),
            start: Vec::new(),
            pause: String::new(),
            end: Vec::new(),
            requires: Vec::new(),
        };
        let seal = Seal {
            temperature: number("seal", "temperature_C").map(Temperature)?,
            speed: number("seal", "speed_mm_s").map(Speed)?,
            band: length("seal", "band_mm")?,
            overlap: length("seal", "overlap_mm")?,
            allowance: Length(0.0),
            hole_allowance: Length(0.0),
        };
        let path = length("path", "tolerance_mm")?;
        let positive =
            seal.speed.0 > 0.0 && machine.travel_speed.0 > 0.0 && path.0 > 0.0 && machine.ramp.0 > 0.0;
        if positive { Ok(Self { machine, seal, path, pace }) } else { Err(ResumeFault::NotOurs("seal")) }
    }

    /// The dialect by which the file is read.
    pub(super) fn dialect(&self) -> gcode::Dialect {
        gcode::Dialect::for_machine(&self.machine)
    }

    /// A comment as this file marks it.
    pub(super) fn comment(&self, text: &str) -> String {
        match self.machine.comments {
            Comments::Semicolon => format!("; {text}"),
            Comments::Parentheses => format!("({text})"),
        }
    }
}
