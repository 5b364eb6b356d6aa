//! The stack: the heights of stars and plates, and the rotation of each star.
//!
//! A star lies between two plates. Between neighbouring stars a plate is half way; below the first and above
//! the last one its distance is that of the neighbour on the other side, but never so small that the inflated tube
//! touches it. A flat tube of width W inflates to a circle of diameter 2 W / pi.

use crate::{Refusal, RefusalCode, Refusals, Warning, round_tube};
use spec::units::{Length, Readable, tenths_up};
use spec::{Spec, key};

/// Room between an inflated tube and its plates together, mm: folds of the fabric, and hands that put it in.
const PLAY: f64 = 3.0;
/// Plates that leave more than this many tubes' heights do not keep the arms in their plane.
const LOOSE: f64 = 4.0;

/// Height of an inflated tube that is `width` wide when flat: the diameter of a circle of the circumference 2 W.
pub fn inflated_height(width: Length) -> Length {
    Length(round_tube(width.0))
}

/// The least distance of stars with tubes `width` wide and plates of thickness `plate` between them, rounded up to a tenth of a millimetre.
pub fn least_pitch(width: Length, plate: Length) -> Length {
    Length(tenths_up(inflated_height(width).0 + plate.0))
}

/// Least pitch of stars of tube width `width` between plates of thickness `plate`, with some play.
pub fn pitch_for(width: Length, plate: Length) -> Length {
    least_pitch(width, Length(plate.0 + PLAY))
}

/// Heights and turns of a stack. Heights are mm above the bottom of the lowest plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    /// Height of the middle of each star, bottom to top.
    pub stars: Vec<f64>,
    /// Turn of each star's corner 1 against the frame's +X, rad.
    pub turns: Vec<f64>,
    /// Height of the middle of each plate, bottom to top: one more than stars.
    pub plates: Vec<f64>,
    /// Height of the whole stack, from the bottom of the lowest plate to the top of the highest.
    pub height: f64,
}

impl Stack {
    /// The stack of `spec`, with plates of its thickness.
    ///
    /// # Errors
    /// For every pitch that leaves the inflated tube no room between its plates.
    pub fn new(spec: &Spec) -> Result<Self, Refusals> {
        let thickness = spec.frame.plate_thickness.0;
        let count = spec.stars.len();
        // Distance that each star requires from its middle to the middle of a plate.
        let heights = spec.stars.iter().map(|star| inflated_height(star.tube_width).0);
        let half_heights: Vec<f64> = heights.map(|height| 0.5 * (height + thickness)).collect();
        let mut refusals = Refusals::new();
        for i in 1..count {
            let pitch = spec.stars[i].pitch.0;
            let needed_pitch = 2.0 * half_heights[i - 1].max(half_heights[i]);
            if pitch < needed_pitch {
                refusals.push(too_tight(i, pitch, needed_pitch, thickness));
            }
        }
        refusals.or_value(())?;
        let bottom = half_heights[0].max(spec.stars[1.min(count - 1)].pitch.0 / 2.0);
        let top = half_heights[count - 1].max(spec.stars[count - 1].pitch.0 / 2.0);
        let mut height = thickness / 2.0;
        let (mut stars, mut turns, mut plates) = (Vec::new(), Vec::new(), vec![height]);
        let mut turn = 0.0;
        for (i, star) in spec.stars.iter().enumerate() {
            height += if i == 0 { bottom } else { star.pitch.0 / 2.0 };
            turn += star.rotation.rad();
            stars.push(height);
            turns.push(turn);
            height += spec.stars.get(i + 1).map_or(top, |above| above.pitch.0 / 2.0);
            plates.push(height);
        }
        Ok(Self { stars, turns, plates, height: height + thickness / 2.0 })
    }

    /// The warning that the plates on both sides of star `index` are too far apart to keep its arms in their plane.
    pub(super) fn loose(&self, spec: &Spec, index: usize) -> Option<Warning> {
        let plate = spec.frame.plate_thickness;
        let width = spec.stars.get(index - 1)?.tube_width;
        let tube = inflated_height(width).0;
        let gap = self.plates.get(index)? - self.plates.get(index - 1)? - plate.0;
        // The distance of a star alone is that of [stack]; of others that of the one above where it has one.
        let key = if index > 1 { key::stack::PITCH.of_star(index) } else { key::stack::PITCH };
        let fault = format!(
            "the plates leave {gap:.1} mm for star {index}, whose inflated tube is {tube:.1} mm high"
        );
        let remedy = format!("a pitch of {} keeps its arms in their plane", pitch_for(width, plate));
        (gap > LOOSE * tube).then(|| Warning::new(key, RefusalCode::WideFrame, fault, remedy))
    }
}

fn too_tight(below: usize, pitch: f64, needed_pitch: f64, thickness: f64) -> Refusal {
    let above = below + 1;
    let [room, tube] = [pitch - thickness, needed_pitch - thickness].map(Readable);
    let [pitch, plates, smallest] = [pitch, thickness, (needed_pitch * 100.0).ceil() / 100.0].map(Readable);
    let fault = format!(
        "between star {below} and star {above} a pitch of {pitch} mm leaves {room} mm between plates of \
         {plates} mm, the inflated tube is {tube} mm high"
    );
    let remedy = format!("pitch must be at least {smallest} mm");
    Refusal::new(key::stack::PITCH.of_star(above), RefusalCode::TubeBetweenPlates, fault, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Design;
    use spec::{Machine, Source, read, starter};

    #[test]
    fn plates_far_from_a_thin_tube_are_warned_of_until_the_pitch_fits_it() {
        let loose = |width: f64, pitch: f64| {
            let text = starter("x").expect("a name");
            let text = text.replace("tube_width = \"30 mm\"", &format!("tube_width = \"{width} mm\""));
            let text = text.replace("\n[stack]\n", &format!("\n[stack]\npitch = \"{pitch} mm\"\n"));
            let spec = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
            let design =
                Design::new(&spec, &Machine::builtin("generic").expect("built in")).expect("makeable");
            design.warnings.iter().any(|warning| warning.code == RefusalCode::WideFrame)
        };
        assert!(!loose(30.0, 40.0) && loose(13.0, 40.0));
        let pitch = pitch_for(Length(13.0), Length(5.0));
        assert!(!loose(13.0, pitch.0) && pitch.0 > round_tube(13.0) + 5.0 && pitch.0 < 18.0, "{pitch}");
        assert_eq!(pitch_for(Length(13.0), Length(5.0)), least_pitch(Length(13.0), Length(8.0)));
    }
}
