//! The section `[load]`: pressure, object and friction.

use crate::spec::FaultCode;
use crate::spec::allowed::{Allowed, SIZE};
use crate::spec::fault::Fault;
use crate::spec::model::{Load, ObjectShape, ObjectSize};
use crate::spec::section::Section;
use crate::units::Length;

/// `[load]`; `None` where it is not written.
pub(super) fn read_load(s: &mut Section<'_, '_>) -> Option<Load> {
    let pressure = s.quantity("pressure", Allowed::closed(1e-3, 1e6));
    let (object_radius, object_size) = read_object_size(s);
    let load = Load {
        pressure,
        object_radius,
        object_size,
        object_height: s.quantity("object_height", SIZE),
        object_shape: s.choice("object_shape", &ObjectShape::ALL),
        friction: s.number("friction", Allowed::above(0.0, 10.0)),
        friction_least: s.number("friction_least", Allowed::above(0.0, 10.0)),
        friction_most: s.number("friction_most", Allowed::above(0.0, 10.0)),
        mass: s.quantity("mass", Allowed::above(0.0, 1e4)),
        largest_force: s.quantity("largest_force", Allowed::above(0.0, 1e6)),
    };
    check_friction(s, &load);
    s.is_written().then_some(load)
}

/// `friction_least` <= `friction` <= `friction_most`, and none of the ends without `friction`.
fn check_friction(s: &mut Section<'_, '_>, load: &Load) {
    let Some(friction) = load.friction else {
        // A faulty friction is reported already.
        let ends =
            ["friction_least", "friction_most"].into_iter().filter(|key| s.has(key) && !s.has("friction"));
        for key in ends.collect::<Vec<_>>() {
            let fault =
                Fault::error(FaultCode::Conflict, s.place_of(key), format!("`{key}` without `friction`"))
                    .label("it is an end of the range of `friction`")
                    .help(format!("write friction, or delete {key}"));
            s.report(fault);
        }
        return;
    };
    let ends = [
        ("friction_least", load.friction_least, "above", load.friction_least > Some(friction)),
        (
            "friction_most",
            load.friction_most,
            "below",
            load.friction_most.is_some_and(|most| most < friction),
        ),
    ];
    for (key, end, word, _) in ends.into_iter().filter(|(.., is_wrong)| *is_wrong) {
        let end = end.unwrap_or(friction);
        let message = format!("`{key}` is {end}, {word} `friction`, {friction}");
        let fault = Fault::error(FaultCode::Conflict, s.place_of(key), message)
            .label("the friction lies between friction_least and friction_most")
            .help(format!("write {key} = {friction}, or change friction"));
        s.report(fault);
    }
}

/// The object's radius, and the key that gave it: `object_diameter` or `object_radius`, not both.
fn read_object_size(s: &mut Section<'_, '_>) -> (Option<Length>, ObjectSize) {
    let diameter: Option<Length> = s.quantity("object_diameter", SIZE);
    let radius = s.quantity("object_radius", SIZE);
    if s.has("object_diameter") && s.has("object_radius") {
        let message = "`object_diameter` and `object_radius` are both set";
        let fault = Fault::error(FaultCode::Conflict, s.place_of("object_radius"), message)
            .label("one of them gives the object's size")
            .help("delete object_radius");
        s.report(fault);
    }
    match diameter {
        None if s.has("object_radius") => (radius, ObjectSize::Radius),
        diameter => (diameter.map(|diameter| Length(0.5 * diameter.0)), ObjectSize::Diameter),
    }
}
