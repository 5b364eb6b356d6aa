//! The section `[load]`: pressure, object and friction.

use crate::FaultCode;
use crate::allowed::{Allowed, SIZE};
use crate::fault::Fault;
use crate::model::{Load, ObjectShape};
use crate::section::Section;
use crate::units::Length;
use std::cmp::Ordering;

/// `[load]`; `None` where it is not written.
pub(super) fn read_load(s: &mut Section<'_, '_>) -> Option<Load> {
    let pressure = s.quantity("pressure", Allowed::closed(1e-3, 1e6));
    let (object_radius, by_radius) = read_object_size(s);
    let load = Load {
        pressure,
        object_radius,
        by_radius,
        object_height: s.quantity("object_height", SIZE),
        object_shape: s.choice("object_shape", &ObjectShape::ALL),
        friction: s.number("friction", Allowed::half_open(0.0, 10.0)),
        friction_least: s.number("friction_least", Allowed::half_open(0.0, 10.0)),
        friction_most: s.number("friction_most", Allowed::half_open(0.0, 10.0)),
        mass: s.quantity("mass", Allowed::half_open(0.0, 1e4)),
        largest_force: s.quantity("largest_force", Allowed::half_open(0.0, 1e6)),
        chambers: s.quantities("chambers", Allowed::closed(0.0, 1e6)),
        plates: s.quantity("plates", SIZE),
    };
    check_friction(s, &load);
    s.is_written().then_some(load)
}

/// `friction_least` <= `friction` <= `friction_most`, and none of the ends without `friction`.
fn check_friction(s: &mut Section<'_, '_>, load: &Load) {
    let ends = [
        ("friction_least", load.friction_least, "above", Ordering::Greater),
        ("friction_most", load.friction_most, "below", Ordering::Less),
    ];
    for (key, end, word, beyond) in ends {
        let (message, label, help) = match (load.friction, end) {
            (Some(friction), Some(end)) if end.partial_cmp(&friction) == Some(beyond) => (
                format!("`{key}` is {end}, {word} `friction`, {friction}"),
                "the friction lies between friction_least and friction_most",
                format!("write {key} = {friction}, or change friction"),
            ),
            // A faulty friction is reported already.
            (None, _) if s.contains(key) && !s.contains("friction") => (
                format!("`{key}` without `friction`"),
                "it is an end of the range of `friction`",
                format!("write friction, or delete {key}"),
            ),
            _ => continue,
        };
        s.report(Fault::error(FaultCode::Conflict, s.place_of(key), message).label(label).help(help));
    }
}

/// The object's radius, and whether `object_radius` gave it: that or `object_diameter`, not both.
fn read_object_size(s: &mut Section<'_, '_>) -> (Option<Length>, bool) {
    let diameter: Option<Length> = s.quantity("object_diameter", SIZE);
    let radius = s.quantity("object_radius", SIZE);
    if s.contains("object_diameter") && s.contains("object_radius") {
        let message = "`object_diameter` and `object_radius` are both set";
        let fault = Fault::error(FaultCode::Conflict, s.place_of("object_radius"), message)
            .label("one of them gives the object's size")
            .help("delete object_radius");
        s.report(fault);
    }
    match diameter {
        None if s.contains("object_radius") => (radius, true),
        diameter => (diameter.map(|diameter| Length(0.5 * diameter.0)), false),
    }
}
