//! The header of a program: the machine, the seal and the processes that its structured comments state.

use std::collections::HashMap;

use crate::resume::ResumeFault;
use program::plan::{Chop, Pace, Precision, stepper};
use proof::verify::ContactRule;
use proof::verify::gcode::Comment;
use spec::units::{Acceleration, Duration, Length, Percent, Speed, Temperature};
use spec::{Comments, Controller, Dialect, DwellUnit, Dwells, Heating, Heights, LaserDrive};
use spec::{Motion, Process, Seal, SheetPlace, StepRate, ZLimits};

/// Largest number of lines searched for the header.
const HEADER: usize = 1000;

/// A process as a file states it.
#[derive(Clone, Debug)]
pub(super) struct StatedProcess {
    pub(super) name: String,
    /// Temperature, speed and height in contact.
    pub(super) seal: Seal,
    /// The way in which its speed is reached.
    pub(super) pace: Pace,
}

impl StatedProcess {
    /// Height in contact, mm.
    pub(super) fn contact(&self, process: &Process) -> Length {
        self.seal.contact(process)
    }

    /// The rule for its contacts on a machine that leads the iron as `process` states.
    pub(super) fn rule(&self, process: &Process) -> ContactRule {
        ContactRule { seal: self.seal.clone(), height: self.contact(process).0, cool: self.seal.cool.0 }
    }

    /// The speed of a move in contact, mm/s.
    pub(super) fn feed(&self) -> f64 {
        match self.pace {
            Pace::Steady => self.seal.speed.0,
            Pace::Chopped(chop) => chop.speed,
        }
    }
}

/// The comments before the first line of G-code.
pub(super) struct Header(Vec<Comment>);

impl Header {
    pub(super) fn read(text: &str, comments: Comments) -> Self {
        let lines = text.lines().take(HEADER).map_while(|line| match comments {
            Comments::Semicolon => line.strip_prefix(';'),
            Comments::Parentheses => line.strip_prefix('(').and_then(|line| line.strip_suffix(')')),
        });
        Self(lines.map(|text| Comment::new(0, text.trim().to_owned())).collect())
    }

    pub(super) fn find(&self, key: &'static str) -> Result<&Comment, ResumeFault> {
        self.comments(key).next().ok_or(ResumeFault::NotOurs(key))
    }

    /// The value of a word; a line without space for it continues in the next one under the same key.
    pub(super) fn word(&self, key: &'static str, word: &str) -> Option<&str> {
        self.comments(key).find_map(|comment| comment.word(word))
    }

    fn number(&self, key: &'static str, word: &str) -> Result<f64, ResumeFault> {
        self.comments(key).find_map(|comment| comment.number(word)).ok_or(ResumeFault::NotOurs(key))
    }

    fn comments(&self, key: &'static str) -> impl Iterator<Item = &Comment> {
        self.0.iter().filter(move |comment| comment.key() == Some(key))
    }

    pub(super) fn length(&self, key: &'static str, word: &str) -> Result<Length, ResumeFault> {
        self.number(key, word).map(Length)
    }

    /// A number of a chopped program, within the range that the program writes; strokes of zero length would never end.
    pub(super) fn written_number(&self, key: &'static str, word: &str) -> Result<f64, ResumeFault> {
        let x = self.number(key, word)?;
        if (1e-4..=1e7).contains(&x) { Ok(x) } else { Err(ResumeFault::NotOurs(key)) }
    }

    /// The timer's tick: 0, or a period that a timer may have.
    fn tick(&self) -> Result<f64, ResumeFault> {
        let tick = self.number("chop-ticks", "tick_s")?;
        let fits = tick == 0.0 || (1e-4..=1.0).contains(&tick);
        if fits { Ok(tick) } else { Err(ResumeFault::NotOurs("chop-ticks")) }
    }

    fn dialect(&self) -> Result<Dialect, ResumeFault> {
        let name = self.word("machine", "dialect").unwrap_or_default();
        let dialect = Dialect::ALL.iter().find(|(word, _)| *word == name);
        dialect.map(|(_, dialect)| *dialect).ok_or(ResumeFault::NotOurs("machine"))
    }

    pub(super) fn controller(&self, comments: Comments, pace: Pace) -> Result<Controller, ResumeFault> {
        let heating = self.word("machine", "heating").map(|name| name.replacen('-', " ", 1));
        let heating = heating.and_then(|name| Heating::read(&name)).unwrap_or(Heating::Operator);
        let unit = match self.word("path", "dwell") {
            Some("ms") => DwellUnit::Milliseconds,
            _ => DwellUnit::Seconds,
        };
        let step = if let Pace::Chopped(chop) = pace { chop.step } else { 1e-3 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a line's length, kept in range"
        )]
        let line_length = self.number("machine", "line")?.clamp(40.0, 255.0) as usize;
        Ok(Controller {
            dialect: self.dialect()?,
            line_length,
            comments,
            arcs: self.word("machine", "arcs") == Some("yes"),
            dwell: Dwells { unit, step: Duration(step) },
            heating,
            thumbnails: false,
            place: self.place()?,
            laser: self.laser()?,
        })
    }

    /// The laser that welds; `None` where an iron seals.
    fn laser(&self) -> Result<Option<LaserDrive>, ResumeFault> {
        if self.comments("laser").next().is_none() {
            return Ok(None);
        }
        Ok(Some(LaserDrive { full_power: self.written_number("laser", "full_power_S")? }))
    }

    /// The place of the sheet; programs in the sheet's frame state none.
    fn place(&self) -> Result<SheetPlace, ResumeFault> {
        if self.comments("place").next().is_none() {
            return Ok(SheetPlace::default());
        }
        let [x, y, surface] = ["x_mm", "y_mm", "surface_mm"].map(|word| self.length("place", word));
        let place = SheetPlace { x: x?, y: y?, surface: surface? };
        let is_reachable = place.shift().iter().all(|side| (0.0..=1e4).contains(side));
        if is_reachable { Ok(place) } else { Err(ResumeFault::NotOurs("place")) }
    }

    pub(super) fn process(&self) -> Result<Process, ResumeFault> {
        let heights = Heights {
            contact: self.length("heights", "contact_mm")?,
            travel: self.length("heights", "travel_mm")?,
            park: self.length("heights", "park_mm")?,
        };
        let travel_speed = self.number("path", "travel_mm_s").map(Speed)?;
        Ok(Process {
            spring_loaded: heights.contact.0 < 0.0,
            heights,
            ramp: self.length("heights", "ramp_mm")?,
            travel_speed,
            // A sealing program has no tracing.
            trace_speed: travel_speed,
        })
    }

    pub(super) fn seal(&self) -> Result<Seal, ResumeFault> {
        // A laser has a power in place of a temperature, and a focus in place of the contact.
        let power = self.laser()?.map(|_| laser_power("seal", self.comments("seal"))).transpose()?;
        let focus = power.map(|_| self.length("laser", "focus_mm")).transpose()?;
        let temperature = if power.is_some() { 0.0 } else { self.number("seal", "temperature_C")? };
        Ok(Seal {
            temperature: Temperature(temperature),
            power,
            height: focus,
            speed: self.number("seal", "speed_mm_s").map(Speed)?,
            band: self.length("seal", "band_mm")?,
            overlap: self.length("seal", "overlap_mm")?,
            allowance: Length(0.0),
            hole_allowance: Length(0.0),
            ..Seal::default()
        })
    }

    /// The processes that the header lists, each with the facts of its own; others are those of `default`.
    pub(super) fn processes(&self, default: &StatedProcess) -> Result<Vec<StatedProcess>, ResumeFault> {
        let mut names: Vec<&str> =
            self.comments("process").filter_map(|comment| comment.word("process")).collect();
        names.dedup();
        names.into_iter().map(|name| self.stated_process(name, default)).collect()
    }

    /// The comments about the process `name`.
    fn process_comments<'s>(&'s self, name: &'s str) -> impl Iterator<Item = &'s Comment> {
        self.comments("process").filter(move |comment| comment.word("process") == Some(name))
    }

    fn stated_process(&self, name: &str, default: &StatedProcess) -> Result<StatedProcess, ResumeFault> {
        let number = |word: &str| self.process_comments(name).find_map(|comment| comment.number(word));
        let stated = |word: &str| number(word).ok_or(ResumeFault::NotOurs("process"));
        let power =
            default.seal.power.map(|_| laser_power("process", self.process_comments(name))).transpose()?;
        let temperature = if power.is_some() { 0.0 } else { stated("temperature_C")? };
        let seal = Seal {
            temperature: Temperature(temperature),
            power,
            speed: Speed(stated("speed_mm_s")?),
            height: Some(Length(stated("contact_mm")?)),
            cool: Duration(stated("cool_s")?),
            ..default.seal.clone()
        };
        if !(1e-4..=1e7).contains(&seal.speed.0) {
            return Err(ResumeFault::NotOurs("process"));
        }
        let pace = match (default.pace, number("feed_mm_min"), number("longest_mm")) {
            (Pace::Chopped(chop), Some(feed), Some(longest)) => {
                let usable = 1e-4..=1e7;
                if !usable.contains(&feed) || !usable.contains(&longest) {
                    return Err(ResumeFault::NotOurs("process"));
                }
                let rest = (seal.band.0 / 10.0).max(2.0 * chop.least) / seal.speed.0;
                Pace::Chopped(Chop { speed: feed / 60.0, longest, rest, ..chop })
            }
            _ => Pace::Steady,
        };
        Ok(StatedProcess { name: name.to_owned(), seal, pace })
    }

    /// The place of its process in `processes` for the number of each contact.
    pub(super) fn sealing(&self, processes: &[StatedProcess]) -> Result<HashMap<u64, usize>, ResumeFault> {
        let places = self.comments("sealing").map(|comment| {
            let name = comment.word("process")?;
            let place = processes.iter().position(|stated| stated.name == name)?;
            Some((comment.number("seam")?.to_bits(), place))
        });
        places.collect::<Option<_>>().ok_or(ResumeFault::NotOurs("sealing"))
    }

    /// The limits of Z; a file states those that are lower than the limits of X and Y.
    pub(super) fn z_limits(&self) -> ZLimits {
        ZLimits {
            speed: self.z_limit("speed_mm_s").map(Speed),
            acceleration: self.z_limit("acceleration_mm_s2").map(Acceleration),
        }
    }

    fn z_limit(&self, word: &str) -> Option<f64> {
        self.number("z-limits", word).ok().filter(|limit| (1e-3..=1e6).contains(limit))
    }

    pub(super) fn motion(&self) -> Result<Motion, ResumeFault> {
        if self.find("chop").is_err() {
            return Ok(Motion::UNKNOWN);
        }
        let mut motion = Motion::UNKNOWN;
        if self.find("chop-steps").is_ok() {
            let [x, y, z] = ["x", "y", "z"].map(|axis| self.written_number("chop-steps", axis));
            motion.steps_per_mm = Some([x?, y?, z?]);
            motion.step_rate = StepRate::AtLeast(self.written_number("chop-ticks", "rate_Hz")?);
            motion.tick = Some(Duration(self.tick()?));
            motion.wraps = self.dialect()?.timer_wraps();
            // Older programs do not contain them.
            let first = self.number("chop-moves", "first_Hz").ok();
            motion.first_step_rate = first.filter(|rate| (1e-3..=1e5).contains(rate));
            let least_steps = self.number("chop-moves", "least_steps");
            motion.min_move_steps = least_steps.map_or(0.0, |steps| steps.clamp(0.0, 100.0));
            motion.s_curve = self.word("chop-ramps", "s_curve") == Some("yes");
        }
        motion.chop_feed = Some(Speed(self.written_number("chop", "feed_mm_min")? / 60.0));
        motion.acceleration = Some(Acceleration(self.written_number("chop-rest", "acceleration_mm_s2")?));
        // Older programs do not contain it.
        let delay = self.number("chop-start", "delay_s");
        motion.start_delay = Duration(delay.map_or(0.0, |delay| delay.clamp(0.0, 1.0)));
        Ok(motion)
    }

    pub(super) fn pace(&self, motion: &Motion) -> Result<Pace, ResumeFault> {
        let (Some(speed), Some(acceleration)) = (motion.chop_feed, motion.acceleration) else {
            return Ok(Pace::Steady);
        };
        let least_move = motion.least_move();
        let (band, seal_speed) =
            (self.written_number("seal", "band_mm")?, self.written_number("seal", "speed_mm_s")?);
        Ok(Pace::Chopped(Chop {
            least: least_move,
            file: Precision {
                path: self.length("path", "tolerance_mm")?,
                arcs: self.word("machine", "arcs") == Some("yes"),
            },
            speed: speed.0,
            longest: self.written_number("chop", "longest_mm")?,
            acceleration: acceleration.0,
            step: self.number("chop-rest", "step_s")?,
            rest: (band / 10.0).max(2.0 * least_move) / seal_speed,
            start_delay: motion.start_delay.0,
            stepper: stepper(motion),
        }))
    }
}

/// The power of a laser among `comments` with the key `key`: a part of full power.
fn laser_power<'c>(
    key: &'static str,
    mut comments: impl Iterator<Item = &'c Comment>,
) -> Result<Percent, ResumeFault> {
    let percent = comments.find_map(|comment| comment.number("power_percent"));
    let power = percent.filter(|percent| *percent > 0.0 && *percent <= 100.0).map(Percent);
    power.ok_or(ResumeFault::NotOurs(key))
}
