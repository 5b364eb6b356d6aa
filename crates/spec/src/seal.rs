//! How seams are made: `[seal]`, the process of every seam that names no other.

use crate::FaultCode;
use crate::allowed::{Allowed, EXTRA, SEAL_SPEEDS, SIZE};
use crate::fault::Fault;
use crate::laser::{POWERS, read_focus};
use crate::machine::{CONTACT, Process, to_micrometres};
use crate::raw::RawSpec;
use crate::release_layer::check_ptfe;
use crate::section::{Reader, Section};
use crate::units::{Duration, Length, LineForce, Percent, Speed, Temperature};

/// Most passes of a seam, and most lines of a band.
pub(super) const MOST: u32 = 20;
/// Longest wait after a seam, s.
pub(super) const LONGEST_WAIT: f64 = 3600.0;
/// Peel strengths, N/mm.
pub(super) const STRENGTHS: Allowed = Allowed::closed(1e-6, 1e4);

/// Path, temperature and speed of a seal: `[seal]`, or a process with what it takes from `[seal]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Seal {
    /// Temperature of the iron; 0 C of a laser, which is cold.
    pub temperature: Temperature,
    /// Power of a laser, as a part of its full power; `None` of an iron.
    pub power: Option<Percent>,
    /// Speed of the iron in contact.
    pub speed: Speed,
    /// Width w of the band.
    pub band: Length,
    /// Path covered twice at contact height where a loop closes, ramps excluded.
    pub overlap: Length,
    /// Flap outside the star.
    pub allowance: Length,
    /// Flap on the hole side.
    pub hole_allowance: Length,
    /// Height in contact, of a laser that of its focus above the sheet; `None`: that of the machine's profile.
    pub height: Option<Length>,
    /// Number of times that every line is sealed before the next seam.
    pub passes: u32,
    /// Number of parallel lines of a band; `None`: as many as it takes.
    pub lines: Option<u32>,
    /// Width of the tool's contact, or of a laser's spot; `None`: that of the band.
    pub tip: Option<Length>,
    /// Wait at travel height after every seam.
    pub cool: Duration,
    /// The place of a pause after a seam.
    pub pause: SealPause,
}

/// Pauses of a job beside those for heating.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SealPause {
    /// None.
    #[default]
    Never,
    /// Before the next seam.
    Seam,
    /// Before the next seam of another piece.
    Piece,
}

impl SealPause {
    /// All of them, with the words that specs write.
    pub const ALL: [(&'static str, Self); 3] =
        [("none", Self::Never), ("seam", Self::Seam), ("piece", Self::Piece)];
}

impl Seal {
    /// Height of the tip in contact on a machine that leads the iron as `process` states.
    pub fn contact(&self, process: &Process) -> Length {
        self.height.unwrap_or(process.heights.contact)
    }

    /// What heats, in words: the temperature of an iron, "200 C", or the power of a laser, "8 %".
    pub fn heat_in_words(&self) -> String {
        self.power.map_or_else(|| self.temperature.to_string(), |power| power.to_string())
    }

    /// Width of the tool's contact, or of a laser's spot.
    pub fn tip_width(&self) -> Length {
        self.tip.unwrap_or(self.band)
    }

    /// Number of parallel lines of a band: those of the spec, or the fewest that leave no gap.
    pub fn line_count(&self) -> u32 {
        self.lines.unwrap_or_else(|| self.fewest_lines())
    }

    /// The fewest lines that seal the whole band: a tip's meet, and a laser's are half a spot apart at most. Round a corner the
    /// lines on the inner side turn farther apart than they lie; half a spot covers every angle.
    fn fewest_lines(&self) -> u32 {
        let (band, tip) = (self.band.0, self.tip_width().0);
        let count = match self.power {
            Some(_) => 1.0 + ((band - tip) / (0.5 * tip) - 1e-9).ceil(),
            None => (band / tip - 1e-9).ceil(),
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked with the tip")]
        let count = count.clamp(1.0, 1e6) as u32;
        count
    }

    /// Distances of the lines from the centre line of the band, mm, from its right side to its left: spaced evenly, so that the outer
    /// ones end where the band ends.
    pub fn line_offsets(&self) -> Vec<f64> {
        let (count, reach) = (self.line_count(), self.band.0 - self.tip_width().0);
        let spacing = reach / f64::from(count.saturating_sub(1).max(1));
        if count < 2 {
            return vec![0.0];
        }
        (0..count).map(|i| f64::from(i) * spacing - reach / 2.0).collect()
    }
}

/// `[seal]`, and the peel strength that it states.
pub(super) fn read_seal(s: &mut Section<'_, '_>) -> (Seal, Option<LineForce>) {
    let power = s.quantity("power", POWERS);
    let usual = Temperature(if power.is_some() { 0.0 } else { 200.0 });
    let (temperature, focus) = (read_temperature(s).unwrap_or(usual), read_focus(s));
    let seal = Seal {
        temperature,
        power,
        speed: s.quantity("speed", SEAL_SPEEDS).unwrap_or(Speed(0.1)),
        band: s.length("band", SIZE, 2.0),
        overlap: s.length("overlap", EXTRA, 5.0),
        allowance: s.length("allowance", EXTRA, 8.0),
        hole_allowance: s.length("hole_allowance", EXTRA, 1.0),
        height: read_height(s).or(focus),
        passes: s.count("passes", 1, MOST).unwrap_or(1),
        lines: s.count("lines", 1, MOST),
        tip: s.quantity("tip", SIZE),
        cool: s.quantity("cool", Allowed::closed(0.0, LONGEST_WAIT)).unwrap_or(Duration(0.0)),
        pause: s.choice("pause", &SealPause::ALL).unwrap_or_default(),
    };
    let strength = s.quantity("strength", STRENGTHS);
    check_tip(s, &seal);
    check_lines(s, &seal);
    (seal, strength)
}

impl Default for Seal {
    /// The seal of a spec without `[seal]`.
    fn default() -> Self {
        let (raw, _) = RawSpec::parse("");
        read_seal(&mut Reader::new(&raw).section("seal")).0
    }
}

/// The strength of seams of `[seal]`: that of `[fabric]`, or that of `[seal]`, but not both.
pub(super) fn read_strength(
    reader: &mut Reader<'_>,
    of_fabric: Option<LineForce>,
    of_seal: Option<LineForce>,
) -> Option<LineForce> {
    if of_fabric.is_some() && of_seal.is_some() {
        let place = reader.raw.span_of(crate::key::seal::STRENGTH);
        let fault = Fault::error(
            FaultCode::Conflict,
            place,
            "`strength` in [seal] beside `seal_strength` in [fabric]",
        );
        reader.faults.push(fault.label("both are the strength of the same seams").help("delete one of them"));
    }
    of_fabric.or(of_seal)
}

/// The height in contact, in whole micrometres as those of a profile.
pub(super) fn read_height(s: &mut Section<'_, '_>) -> Option<Length> {
    s.quantity("height", CONTACT).map(|Length(mm)| Length(to_micrometres(mm)))
}

/// The temperature, which the release layer must bear.
pub(super) fn read_temperature(s: &mut Section<'_, '_>) -> Option<Temperature> {
    let temperature = s.quantity("temperature", Allowed::half_open(0.0, 400.0))?;
    check_ptfe(s, temperature);
    Some(temperature)
}

/// A tip seals no wider than the band, and a band takes no more lines than a seam may have.
fn check_tip(s: &mut Section<'_, '_>, seal: &Seal) {
    let Some(tip) = seal.tip else { return };
    if tip.0 > seal.band.0 {
        let message = format!("`tip` is {tip}, wider than the band of {}", seal.band);
        let fault = Fault::error(FaultCode::Conflict, s.place_of("tip"), message)
            .label("every line would leave the band")
            .help(format!("write a band of at least {tip}, or take a narrower tip"));
        s.report(fault);
    } else if seal.fewest_lines() > MOST {
        let message = format!("`tip` is {tip}, a band of {} takes {} lines", seal.band, seal.fewest_lines());
        s.refuse(FaultCode::Conflict, "tip", message, format!("at most {MOST} lines are sealed"));
    }
}

/// The lines of a band fill it, and more than one need a tip that is narrower than the band.
pub(super) fn check_lines(s: &mut Section<'_, '_>, seal: &Seal) {
    let (Some(lines), tip) = (seal.lines, seal.tip_width()) else { return };
    if tip.0 > seal.band.0 {
        return;
    }
    let message = format!("`lines` is {lines}, with a tip of {tip} and a band of {}", seal.band);
    let fault = Fault::error(FaultCode::Conflict, s.place_of("lines"), message);
    if lines < seal.fewest_lines() {
        let fault = fault.label("part of the band would stay open");
        s.report(fault.help(format!("write lines = {}, or delete it", seal.fewest_lines())));
    } else if lines > 1 && tip.0 > seal.band.0 - 1e-3 {
        let fault = fault.label("a tip as wide as the band seals it with one line");
        s.report(
            fault
                .help("write `tip` in [seal], the width of the tool's contact; or `passes` to seal it again"),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Evenly spaced, from one edge of the band to the other, whatever their number.
    #[test]
    fn lines_fill_the_band() {
        let base = Seal::default();
        for (band, tip, lines) in [(2.0, 1.0, None), (3.0, 0.8, None), (2.0, 1.9, None), (4.0, 1.0, Some(7))]
        {
            let seal = Seal { band: Length(band), tip: Some(Length(tip)), lines, ..base.clone() };
            let offsets = seal.line_offsets();
            let ends = [offsets[0], offsets[offsets.len() - 1]];
            assert!((ends[0] + (band - tip) / 2.0).abs() < 1e-12 && (ends[0] + ends[1]).abs() < 1e-12);
            assert!(offsets.windows(2).all(|pair| pair[1] - pair[0] <= tip + 1e-9), "{offsets:?}");
        }
        assert_eq!(base.line_offsets(), [0.0]);
    }
}
