//! The process of sealing and the bench: heights, ramp, speeds, work area, clamps.

use crate::FaultCode;
use crate::allowed::{Allowed, SIZE};
use crate::fault::Fault;
use crate::machine::{Bench, CONTACT, Heights, KeepOut, Process, SheetPlace, lowest_contact, to_micrometres};
use crate::profile::controller::PLACE;
use crate::profile::known::{known_as, quantity_or_unknown};
use crate::section::{Reader, Section};
use crate::units::{Length, Speed};
use crate::value::RawValue;

/// Heights without contact: above the release layer, below any gantry.
pub(super) const HEIGHT: Allowed = Allowed::half_open(0.0, 1000.0);
/// Speeds of moves without sealing, up to 10 m/s.
const FAST: Allowed = Allowed::closed(0.01, 1e4);

/// The keys before the first section: whether there is a spring, if the profile states it, and the ramp's length.
pub(super) fn read_tip(root: &mut Section<'_, '_>) -> (Option<bool>, Length) {
    (root.truth("spring_loaded"), root.length("ramp", SIZE, 3.0))
}

/// Reads `[heights]` and `[speeds]`, with the result of [`read_tip`]; `focus` is that of a laser, which takes the place of a contact.
pub(super) fn read_process(
    reader: &mut Reader<'_>,
    (spring_loaded, ramp): (Option<bool>, Length),
    focus: Option<Length>,
) -> Process {
    let heights = read_heights(&mut reader.section("heights"), spring_loaded, focus);
    let mut speeds = reader.section("speeds");
    let travel_speed = speeds.quantity("travel", FAST).unwrap_or(Speed(20.0));
    let trace_speed = speeds.quantity("trace", FAST).unwrap_or(Speed(20.0));
    let spring_loaded = spring_loaded.unwrap_or(heights.contact.0 < 0.0);
    Process { spring_loaded, heights, ramp, travel_speed, trace_speed }
}

fn read_heights(s: &mut Section<'_, '_>, spring_loaded: Option<bool>, focus: Option<Length>) -> Heights {
    // A laser's focus takes the place of the contact that an iron must have. Then each height must be above the one before it,
    // as far as both could be read.
    s.require_if(focus.is_none(), &[("contact", "\"0 mm\"")]);
    s.require(&[("travel", "\"5 mm\""), ("park", "\"30 mm\"")]);
    let [stated_contact, travel, park] = [("contact", CONTACT), ("travel", HEIGHT), ("park", HEIGHT)]
        .map(|(key, allowed)| s.quantity(key, allowed).map(|Length(x)| Length(to_micrometres(x))));
    if focus.is_some() && s.contains("contact") {
        let fault = Fault::error(FaultCode::Conflict, s.place_of("contact"), "`contact` beside a laser");
        s.report(
            fault.label("a laser touches nothing").help("delete it: `focus` in [laser] takes its place"),
        );
    }
    let contact = focus.or(stated_contact);
    if let (Some(false), Some(Length(contact))) = (spring_loaded, contact)
        && contact < lowest_contact(false)
    {
        let allowed = "must be 0 mm for a tip without a spring (`spring_loaded = false`)";
        s.refuse(FaultCode::OutOfRange, "contact", format!("`contact` is {}", Length(contact)), allowed);
    }
    let lowest_key = if focus.is_some() { "focus" } else { "contact" };
    for (low, low_key, high, high_key) in
        [(contact, lowest_key, travel, "travel"), (travel, "travel", park, "park")]
    {
        if let (Some(low), Some(high)) = (low, high)
            && high <= low
        {
            let (message, allowed) =
                (format!("`{high_key}` is {high}"), format!("must be above `{low_key}`, {low}"));
            s.refuse(FaultCode::OutOfRange, high_key, message, allowed);
        }
    }
    Heights {
        contact: contact.unwrap_or(Length(0.0)),
        travel: travel.unwrap_or(Length(5.0)),
        park: park.unwrap_or(Length(30.0)),
    }
}

/// Reads the bench, from `[work_area]` and each `[[keep_out]]`. The work area counts from the machine's zero, and what is left of it
/// from the sheet's corner at `place`.
pub(super) fn read_bench(reader: &mut Reader<'_>, place: SheetPlace) -> Bench {
    let mut section = reader.section("work_area");
    let work_area =
        read_work_area(&mut section).map(|(x, y)| (Length(x.0 - place.x.0), Length(y.0 - place.y.0)));
    if work_area.is_some_and(|(x, y)| x.0 <= 0.0 || y.0 <= 0.0) {
        let allowed = "must reach beyond the sheet's corner, [origin]: it counts from the machine's zero";
        let fault =
            Fault::error(FaultCode::Conflict, section.place(), "[work_area] ends before the sheet begins");
        section.report(fault.label(allowed));
    }
    Bench { work_area, keep_out: read_keep_out(reader) }
}

/// Reads `[origin]`: X and Y of the sheet's lower left corner.
pub(super) fn read_origin(s: &mut Section<'_, '_>) -> (Length, Length) {
    let [x, y] = ["x", "y"].map(|key| Length(to_micrometres(s.length(key, PLACE, 0.0).0)));
    (x, y)
}

/// Both sizes, or neither: an absent one and "unknown" mean the same.
fn read_work_area(s: &mut Section<'_, '_>) -> Option<(Length, Length)> {
    // A faulty side counts as set, so that it is not reported as missing too.
    let sides = ["x", "y"].map(|key| {
        known_as(s, key, |s| s.quantity(key, SIZE).or_else(|| s.contains(key).then_some(Length(1.0))))
    });
    match sides {
        [Some(x), Some(y)] => Some((x, y)),
        [None, None] => None,
        _ => {
            let fault = Fault::error(FaultCode::Conflict, s.place(), "[work_area] has one side only")
                .label("must set both `x` and `y`, or neither, or \"unknown\" for both");
            s.report(fault);
            None
        }
    }
}

fn read_keep_out(reader: &mut Reader<'_>) -> Vec<KeepOut> {
    let Some(list) = reader.raw.root().get("keep_out").and_then(RawValue::as_list) else {
        // Registers the section, even where the profile has none.
        let _ = reader.section("keep_out");
        return Vec::new();
    };
    list.iter()
        .map(|value| {
            let mut s = reader.element("keep_out", value);
            s.require(&[
                ("x", "\"0 mm\""),
                ("y", "\"0 mm\""),
                ("width", "\"20 mm\""),
                ("depth", "\"20 mm\""),
            ]);
            let place = Allowed::closed(-1e5, 1e5);
            KeepOut {
                name: s.name().unwrap_or_else(|| "clamp".to_owned()),
                x: s.length("x", place, 0.0),
                y: s.length("y", place, 0.0),
                width: s.length("width", SIZE, 1.0),
                depth: s.length("depth", SIZE, 1.0),
                height: quantity_or_unknown(&mut s, "height", HEIGHT),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::source::Source;
    use crate::{builtin_machine, read_machine};

    #[test]
    fn the_iron_is_in_contact_at_the_release_layer_or_below() {
        let faults = |height: &str| {
            let text = builtin_machine("grbl").expect("built in").replace("-0.3 mm", height);
            read_machine(&Source::new("own", text)).err().map_or(0, |faults| faults.list().len())
        };
        assert_eq!(["-0.3 mm", "0 mm", "0.001 mm", "1 mm"].map(faults), [0, 0, 1, 1]);
    }
}
