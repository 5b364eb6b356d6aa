//! The process of sealing: heights, ramp, speeds.

use crate::spec::FaultCode;
use crate::spec::allowed::{Allowed, SIZE};
use crate::spec::fault::Fault;
use crate::spec::machine::{Heights, Process, lowest_contact};
use crate::spec::section::{Reader, Section};
use crate::units::{Length, Speed};

/// Height in contact: a thick release layer is less than 5 mm.
const CONTACT: Allowed = Allowed::closed(lowest_contact(true), 5.0);
/// Heights without contact: above the release layer, below any gantry.
pub(super) const HEIGHT: Allowed = Allowed::above(0.0, 1000.0);
/// Speeds of moves without sealing, up to 10 m/s.
const FAST: Allowed = Allowed::closed(0.01, 1e4);

/// The keys before the first section: whether there is a spring, if the profile states it, and the ramp's length.
pub(super) fn read_tip(root: &mut Section<'_, '_>) -> (Option<bool>, Length) {
    (root.truth("spring_loaded"), root.quantity("ramp", SIZE).unwrap_or(Length(3.0)))
}

/// Reads `[heights]` and `[speeds]`, with the result of [`read_tip`].
pub(super) fn read_process(
    reader: &mut Reader<'_>,
    (spring_loaded, ramp): (Option<bool>, Length),
) -> Process {
    let heights = read_heights(&mut reader.section("heights"), spring_loaded);
    let mut speeds = reader.section("speeds");
    let travel_speed = speeds.quantity("travel", FAST).unwrap_or(Speed(20.0));
    let trace_speed = speeds.quantity("trace", FAST).unwrap_or(Speed(20.0));
    let spring_loaded = spring_loaded.unwrap_or(heights.contact.0 < 0.0);
    Process { spring_loaded, heights, ramp, travel_speed, trace_speed }
}

/// Heights are whole micrometres, which every program can state: a program that rounded one would not be at it.
fn to_micrometres(mm: f64) -> f64 {
    (mm * 1000.0).round() / 1000.0
}

fn read_heights(s: &mut Section<'_, '_>, spring_loaded: Option<bool>) -> Heights {
    s.require(&[("contact", "\"0 mm\""), ("travel", "\"5 mm\""), ("park", "\"30 mm\"")]);
    let mut height = |key, allowed| s.quantity(key, allowed).map(|Length(x)| Length(to_micrometres(x)));
    let contact = height("contact", CONTACT);
    let travel = height("travel", HEIGHT);
    let park = height("park", HEIGHT);
    if let (Some(false), Some(Length(contact))) = (spring_loaded, contact)
        && contact < lowest_contact(false)
    {
        let fault = Fault::error(
            FaultCode::OutOfRange,
            s.place_of("contact"),
            format!("`contact` is {}", Length(contact)),
        )
        .label("must be 0 mm or above for a tip without a spring (`spring_loaded = false`)");
        s.report(fault);
    }
    for (low, low_key, high, high_key) in
        [(contact, "contact", travel, "travel"), (travel, "travel", park, "park")]
    {
        if let (Some(Length(low)), Some(Length(high))) = (low, high)
            && high <= low
        {
            let fault = Fault::error(
                FaultCode::OutOfRange,
                s.place_of(high_key),
                format!("`{high_key}` is {}", Length(high)),
            )
            .label(format!("must be above `{low_key}`, {}", Length(low)));
            s.report(fault);
        }
    }
    Heights {
        contact: contact.unwrap_or(Length(0.0)),
        travel: travel.unwrap_or(Length(5.0)),
        park: park.unwrap_or(Length(30.0)),
    }
}
