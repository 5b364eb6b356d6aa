//! The stack: how high stars and plates stand, and how far each star is turned.
//!
//! A star lies between two plates. Between neighbouring stars a plate stands half way; below the first and above
//! the last one it stands as far away as the neighbour on the other side, but never so near that the inflated tube
//! touches it. A flat tube of width W inflates to a circle of diameter 2 W / pi.

use crate::design::{Refusal, RefusalCode, Refusals, round_tube};
use crate::spec::{Spec, key};
use crate::units::Readable;

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
    /// The stack of `spec`, with plates of the thickness that it says.
    ///
    /// # Errors
    /// For every pitch that leaves the inflated tube no room between its plates.
    pub fn new(spec: &Spec) -> Result<Self, Refusals> {
        let thickness = spec.frame.plate_thickness.0;
        let count = spec.stars.len();
        // What one star needs from its middle to the middle of a plate.
        let needs = |i: usize| (round_tube(spec.stars[i].tube_width.0) + thickness) / 2.0;
        let mut refusals = Refusals::new();
        for i in 1..count {
            let pitch = spec.stars[i].pitch.0;
            let needed = 2.0 * needs(i - 1).max(needs(i));
            if pitch < needed {
                refusals.push(too_tight(i, pitch, needed, thickness));
            }
        }
        refusals.or(())?;
        let bottom = needs(0).max(spec.stars[1.min(count - 1)].pitch.0 / 2.0);
        let top = needs(count - 1).max(spec.stars[count - 1].pitch.0 / 2.0);
        let mut at = thickness / 2.0;
        let (mut stars, mut turns, mut plates) = (Vec::new(), Vec::new(), vec![at]);
        let mut turn = 0.0;
        for (i, star) in spec.stars.iter().enumerate() {
            at += if i == 0 { bottom } else { star.pitch.0 / 2.0 };
            turn += star.rotation.rad();
            stars.push(at);
            turns.push(turn);
            at += spec.stars.get(i + 1).map_or(top, |above| above.pitch.0 / 2.0);
            plates.push(at);
        }
        Ok(Self { stars, turns, plates, height: at + thickness / 2.0 })
    }
}

fn too_tight(below: usize, pitch: f64, needed: f64, thickness: f64) -> Refusal {
    Refusal::new(
        key::stack::PITCH.of_star(below + 1),
        RefusalCode::TubeBetweenPlates,
        format!(
            "between star {below} and star {} a pitch of {} mm leaves {} mm between plates of {} mm, the inflated tube is {} mm high",
            below + 1,
            Readable(pitch),
            Readable(pitch - thickness),
            Readable(thickness),
            Readable(needed - thickness),
        ),
        format!("pitch must be at least {} mm", Readable((needed * 100.0).ceil() / 100.0)),
    )
}
