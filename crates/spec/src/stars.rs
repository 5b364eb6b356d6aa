//! The stars of the stack: `[star]`, `[stack]` with its `[[stack.star]]`, and `[inlet]`.

use crate::allowed::{Allowed, EXTRA, SIZE};
use crate::fault::Fault;
use crate::model::{Inlet, StarSpec};
use crate::section::{Reader, Section};
use crate::shape::ValueShape;
use crate::units::Angle;
use crate::{FaultCode, key};

/// Most points of a star, and most stars of a stack.
const MOST: u32 = 64;
/// Ten turns either way: enough for any stack that is written down turn by turn.
const TURN: Allowed = Allowed::closed(-3600.0, 3600.0);

/// The stars from bottom to top, and the inlet that each of them has.
/// Empty where there is a drawing instead.
pub(super) fn read(reader: &mut Reader<'_>, has_drawing: bool) -> (Vec<StarSpec>, Option<Inlet>) {
    // The paper's star substitutes faulty required values.
    let paper = StarSpec::paper(5);
    let mut section = reader.section("star");
    section.require_if(
        !has_drawing,
        &[
            ("points", "5"),
            ("inner_radius", "\"50 mm\""),
            ("tube_width", "\"30 mm\""),
            ("tip_angle", "\"30 deg\""),
        ],
    );
    let base = read_shape(&mut section, &paper);
    let (inlet, tip) = read_inlet(&mut reader.section("inlet"));

    let mut stack = reader.section("stack");
    let count = stack.count("count", 1, MOST);
    // A faulty count is reported already; then any index passes.
    let highest = if count.is_none() && stack.contains("count") { MOST } else { count.unwrap_or(1) };
    let base = StarSpec { inlet_tip: tip.unwrap_or(base.inlet_tip), ..read_place(&mut stack, &base) };
    read_list(&mut stack);
    let mut stars = vec![base; usize::try_from(count.unwrap_or(1)).unwrap_or(1)];
    // The bottom star has no star below it: it is not rotated unless its own section sets a rotation.
    stars[0].rotation = Angle(0.0);
    read_overrides(reader, &mut stars, highest, inlet.is_some());
    check_inlet_tips(reader, &stars, inlet.is_some());
    if has_drawing {
        stars.clear();
    }
    (stars, inlet)
}

/// The keys of `[star]`, each as in `base` if it is absent.
fn read_shape(s: &mut Section<'_, '_>, base: &StarSpec) -> StarSpec {
    StarSpec {
        points: s.count("points", 3, MOST).unwrap_or(base.points),
        inner_radius: s.quantity("inner_radius", SIZE).unwrap_or(base.inner_radius),
        tube_width: s.quantity("tube_width", SIZE).unwrap_or(base.tube_width),
        tip_angle: s.quantity("tip_angle", Allowed::open(0.0, 180.0)).unwrap_or(base.tip_angle),
        tip_radius: s.quantity("tip_radius", EXTRA).unwrap_or(base.tip_radius),
        corner_radius: s.quantity("corner_radius", EXTRA).unwrap_or(base.corner_radius),
        inner_process: process(s, "inner_process", &base.inner_process),
        outer_process: process(s, "outer_process", &base.outer_process),
        ..base.clone()
    }
}

/// The process that `key` names; that of `base` if it is absent.
fn process(s: &mut Section<'_, '_>, key: &'static str, base: &str) -> String {
    s.text(key).map_or(base, |(name, _)| name).to_owned()
}

/// The keys of `[stack]` that place a star, each as in `base` if it is absent.
fn read_place(s: &mut Section<'_, '_>, base: &StarSpec) -> StarSpec {
    StarSpec {
        rotation: s.quantity("rotation", TURN).unwrap_or(base.rotation),
        pitch: s.quantity("pitch", SIZE).unwrap_or(base.pitch),
        ..base.clone()
    }
}

/// The inlet, `None` if there is none, and the tip that carries it.
fn read_inlet(s: &mut Section<'_, '_>) -> (Option<Inlet>, Option<u32>) {
    let has_none = s.truth("none").unwrap_or(false);
    let inlet = Inlet {
        tube_diameter: s.length("tube_diameter", SIZE, 4.0),
        length: s.length("length", SIZE, 20.0),
        fillet: s.length("fillet", EXTRA, 1.0),
    };
    let tip = s.count("tip", 1, MOST);
    if !has_none {
        return (Some(inlet), tip);
    }
    let other_keys: Vec<_> = s.other_keys("none").into_iter().map(|key| format!("`{key}`")).collect();
    if !other_keys.is_empty() {
        let message = format!("[inlet] has `none = true` beside {}", other_keys.join(", "));
        let fault = Fault::error(FaultCode::Conflict, s.place_of("none"), message)
            .label("no inlet, so no other key is allowed here")
            .help("delete the other keys, or this one");
        s.report(fault);
    }
    (None, tip)
}

/// Makes `star` a key of `[stack]`: a list of sections.
fn read_list(stack: &mut Section<'_, '_>) {
    if let Some(value) = stack.take("star", ValueShape::Sections)
        && value.as_list().is_none()
    {
        let fault =
            Fault::error(FaultCode::WrongType, value.span.clone(), "`stack.star` is not a list of sections")
                .label("must be written [[stack.star]], with two brackets");
        stack.report(fault);
    }
}

/// The values in which single stars differ.
///
/// Each section begins with the values of its star, or of the first one if its `index` is faulty, so that its other faults
/// are reported, too. Only the section of a star that exists changes it.
fn read_overrides(reader: &mut Reader<'_>, stars: &mut [StarSpec], highest: u32, has_inlet: bool) {
    let mut has_section = [false; MOST as usize + 1];
    for value in reader.raw.overrides() {
        let mut section = reader.element("stack.star", value);
        if section.is_written() {
            section.require(&[("index", "1")]);
        }
        let index = section.count("index", 1, MOST);
        if let Some(index) = index.filter(|index| *index > highest) {
            let message = format!("`index` is {index}, and `count` in [stack] is {highest}");
            let fault = Fault::error(FaultCode::OutOfRange, section.place_of("index"), message)
                .label(format!("must be from 1 to {highest}"))
                .help(format!("write count = {index} in [stack]"));
            section.report(fault);
        }
        let slot = index.and_then(|index| usize::try_from(index).ok());
        let base = slot.and_then(|slot| stars.get(slot - 1)).or(stars.first()).cloned();
        let Some(base) = base else { continue };
        let shape = read_shape(&mut section, &base);
        let mut star = read_place(&mut section, &shape);
        let tip = section.count("inlet_tip", 1, MOST);
        star.inlet_tip = tip.unwrap_or(star.inlet_tip);
        if tip.is_some() && !has_inlet {
            let message = "`inlet_tip` without an inlet";
            section.refuse(FaultCode::Conflict, "inlet_tip", message, "[inlet] has `none = true`");
        }
        if index == Some(1) && stars.len() > 1 && section.contains("pitch") {
            let fault = Fault::warning(FaultCode::NoEffect, section.place_of("pitch"), "`pitch` of star 1")
                .label("has no effect: it is the distance from the star below, and star 1 is the bottom")
                .help("write it into the section of star 2, or delete it");
            section.report(fault);
        }
        let Some(slot) = slot else { continue };
        if std::mem::replace(&mut has_section[slot], true) {
            let message = format!("`index` is {slot}");
            let fault = Fault::error(FaultCode::DuplicateIndex, section.place_of("index"), message)
                .label("this star has a section already")
                .help("write all keys of one star into one section");
            section.report(fault);
        }
        if let Some(place) = stars.get_mut(slot - 1) {
            *place = star;
        }
    }
}

/// An inlet needs a tip that its star has.
fn check_inlet_tips(reader: &mut Reader<'_>, stars: &[StarSpec], has_inlet: bool) {
    let mut places = Vec::new();
    for (index, star) in (1..).zip(stars) {
        if !has_inlet || star.inlet_tip <= star.points {
            continue;
        }
        let place = reader.raw.span_of(key::inlet::TIP.of_star(index));
        if !places.contains(&place) {
            let message =
                format!("the inlet is at tip {}, star {index} has {} points", star.inlet_tip, star.points);
            let fault = Fault::error(FaultCode::OutOfRange, place.clone(), message)
                .label(format!("must be from 1 to {}", star.points));
            reader.faults.push(fault);
            places.push(place);
        }
    }
}
