//! Reasons why a gripper does not suit the load of its own spec: the found value, the allowed value, and the remedy.

use crate::interval::Interval;
use crate::payload::limit_in_words;
use crate::prediction::StackPayload;
use crate::prediction::StarPrediction;
use crate::ranges::shown::{distinct, or_unknown};
use crate::seal_load::{Bursting, bursts_at};
use design::{Object, Refusal, RefusalCode, does_not_enter};
use inflatable::mechanics::hinge::section;
use inflatable::mechanics::strength::GRAVITY;
use spec::units::{Least, Length, Mass, Most, Pressure, tenths_up};
use spec::{Load, Spec, StarSpec, key};

/// Largest friction that is proposed, and how to get it: silicone-coated corners reach about 1, in the paper 0.85 to 1.57.
pub(super) const COATED: f64 = 1.1;
/// Rounding of radii, mm: an object as wide as the hole enters, and is held.
pub(super) const ROUNDING: f64 = 1e-9;
/// A pressure is taken for a slip of the unit if it is off by more than this factor.
const SLIP: f64 = 5.0;
/// Pressures in other units that were meant as kPa: bar, MPa, mbar, Pa.
const UNITS: [f64; 4] = [1e-2, 1e-3, 1e1, 1e3];

/// `star`, made of `part`, does not let the object in: its widest part does not pass the cut hole.
pub(super) fn too_wide_to_enter(spec: &Spec, part: &StarSpec, star: &StarPrediction) -> Option<Refusal> {
    let gap = star.object_gap_mm.filter(|gap| *gap < -ROUNDING)?;
    let hole = star.hole_radius_mm;
    // One that enters may still be wider than the inflated star opens.
    let widest = match held_sizes(star) {
        HeldSizes::Radii([_, most]) => {
            let (load, radius) = (spec.load.as_ref()?, star.object_radius_mm?);
            Some(hole.min(Object::widest_for(load, radius, most)))
        }
        HeldSizes::None => None,
        HeldSizes::Unknown => Some(hole),
    };
    Some(does_not_enter(spec, (part.inner_radius.0, hole), hole - gap, widest))
}

/// The radii of objects, mm, that a star surely holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum HeldSizes {
    /// From the least to the largest.
    Radii(Interval),
    /// It surely holds no object.
    None,
    /// No model covers the star.
    Unknown,
}

/// The objects that `star` surely holds. Models without ranges hold all that they reach.
pub(super) fn held_sizes(star: &StarPrediction) -> HeldSizes {
    match (star.graspable_radius_mm, star.ranges.final_radius_mm) {
        (None, _) => HeldSizes::Unknown,
        (Some(radii), None) => HeldSizes::Radii(radii),
        (Some(_), Some(_)) => star.evidence.surely_held_mm.map_or(HeldSizes::None, HeldSizes::Radii),
    }
}

/// No star of the stack touches the object.
pub(super) fn too_short(load: &Load) -> Refusal {
    let (key, height) = match load.object_height {
        Some(height) => (key::load::OBJECT_HEIGHT, format!("{height} high")),
        None => (load.size_key(), "as high as it is wide, the default of object_height".to_owned()),
    };
    Refusal::new(
        key,
        RefusalCode::ObjectTooShort,
        format!("the object is {height}: none of it is at the height of a star"),
        "another count or pitch of [stack], so that a star is at the object's height; or object_height, if it is higher"
            .to_owned(),
    )
}

/// The star closes to `smallest` (mm) at the least, and the object of radius `object` is thinner than the held `sizes`.
pub(super) fn too_thin(load: &Load, object: f64, smallest: f64, sizes: HeldSizes) -> Refusal {
    let closer = "a star that closes further: a smaller inner_radius";
    let remedy = match sizes {
        HeldSizes::Radii([wanted, _]) => format!("{}, or {closer}", at_least(load, object, wanted)),
        HeldSizes::None | HeldSizes::Unknown => format!("{NONE_HELD}; {closer}"),
    };
    Refusal::new(
        load.size_key(),
        RefusalCode::ObjectTooThin,
        format!(
            "the inflated star closes to {} mm across at the least, and the object is {} mm across there: its corners do \
             not reach it",
            Least(2.0 * smallest),
            Most(2.0 * object)
        ),
        remedy,
    )
}

/// That the object, of radius `object` (mm) at a star, would have to have the radius `needed_radius` there, in the words of its key.
fn at_least(load: &Load, object: f64, needed_radius: f64) -> String {
    let widest = Object::widest_for(load, object, needed_radius);
    size(load, [Least(2.0 * widest).to_string(), Least(widest).to_string()], "at least")
}

/// `star` may press on the object of radius `object` (mm) with no force, in words.
pub(super) fn may_not_press(load: &Load, star: &StarPrediction, object: f64) -> Option<String> {
    let _ = star.ranges.object_force_N.filter(|[low, _]| *low <= 0.0)?;
    let surely = match held_sizes(star) {
        HeldSizes::Radii([wanted, _]) if wanted > object => {
            format!("an object of {} is surely held", at_least(load, object, wanted))
        }
        _ => NONE_HELD.to_owned(),
    };
    Some(format!("it may touch the object without force: {surely}"))
}

const NONE_HELD: &str = "its range is too wide to promise any size of object";

/// The star opens to `largest` (mm) and the object of radius `object` is wider than the held `sizes`.
pub(super) fn too_wide_to_open(load: &Load, object: f64, largest: f64, sizes: HeldSizes) -> Refusal {
    let wider = "a larger inner_radius, fewer points or a smaller tube_width";
    let remedy = match sizes {
        HeldSizes::Radii([smallest, largest_held]) => format!(
            "from {} to {} mm across; or {wider}",
            Least(2.0 * Object::widest_for(load, object, smallest)),
            Most(2.0 * Object::widest_for(load, object, largest_held))
        ),
        HeldSizes::None | HeldSizes::Unknown => format!("{NONE_HELD}; {wider}"),
    };
    Refusal::new(
        load.size_key(),
        RefusalCode::ObjectTooWide,
        format!(
            "the inflated star opens to {} mm across and does not close around the object, which is {} mm across there",
            Most(2.0 * largest),
            Least(2.0 * object)
        ),
        remedy,
    )
}

/// A limit of the object's size in the words of the key that gave it: diameter and radius.
fn size(load: &Load, [diameter, radius]: [String; 2], limit: &str) -> String {
    if load.size_key() == key::load::OBJECT_RADIUS {
        format!("{limit} {radius} mm of radius")
    } else {
        format!("{limit} {diameter} mm across")
    }
}

/// The seal of `star` may peel, in words.
pub(super) fn may_burst(star: &StarPrediction) -> Option<String> {
    let _ = star.evidence.bursting.filter(|one| *one == Bursting::Perhaps)?;
    let burst = or_unknown(star.burst_pressure_kPa?, star.ranges.burst_pressure_kPa, "kPa");
    Some(format!("the seal may burst: its burst pressure is {burst}"))
}

/// The seal peels below the pressure of `load`.
pub(super) fn bursts(load: &Load, star: &StarPrediction) -> Option<Refusal> {
    let _ = star.evidence.bursting.filter(|one| *one == Bursting::Yes)?;
    let (pressure, burst, range) = (load.pressure?, star.burst_pressure_kPa?, star.ranges.burst_pressure_kPa);
    let lower_pressure = star.evidence.safe_pressure_kPa.map(|kpa| format!("at most {} kPa", Most(kpa)));
    let round = star.evidence.safe_radius_mm;
    let round = round.map(|mm| format!("tip_radius and corner_radius of at least {}", Length(mm)));
    let finding = bursts_at(pressure, burst, range);
    let other = "a stronger seal or a smaller tube_width".to_owned();
    let remedy = [lower_pressure, round, Some(other)].into_iter().flatten().collect::<Vec<_>>().join(", or ");
    Some(Refusal::new(key::load::PRESSURE, RefusalCode::Bursts, finding, remedy))
}

/// A star presses with `low` to `high` N, and the object bears `bears` N.
pub(super) fn too_hard([low, high]: Interval, bears: f64) -> Refusal {
    let [low, _] = distinct(low, bears);
    Refusal::new(
        key::load::LARGEST_FORCE,
        RefusalCode::TooHard,
        format!("it presses with at least {low} N, but the object bears {bears} N"),
        format!(
            "an object that bears at least {:.1} N; or less pressure, or a larger inner_radius",
            tenths_up(high)
        ),
    )
}

/// All stars press with `low` to `high` N together and carry `payload`, and friction needs `needed_force` N to hold the mass of `load`.
pub(super) fn too_heavy(
    load: &Load,
    [low, high]: Interval,
    needed_force: f64,
    payload: StackPayload,
) -> Refusal {
    let [needed_text, high] = distinct(needed_force, high);
    let finding = format!("friction needs {needed_text} N, but at most {high} N are predicted");
    let mut ways = Vec::new();
    if let Some((_, mass)) = load.friction_range().zip(load.mass) {
        ways.extend(lighter(payload));
        let needed_friction =
            if low > 0.0 { (100.0 * mass.0 * GRAVITY / low).ceil() / 100.0 } else { f64::INFINITY };
        if needed_friction <= COATED {
            let ends = [(load.friction_least, "friction_least"), (load.friction_most, "friction_most")];
            let ends = ends.into_iter().filter(|(end, _)| end.is_some());
            let other_keys: String = ends.flat_map(|(_, key)| [", ", key, " too"]).collect();
            ways.push(format!(
                "a friction of at least {needed_friction}{other_keys}: silicone-coated corners reach about 1"
            ));
        }
    }
    ways.push("more stars, or a wider star with more pressure".to_owned());
    Refusal::new(key::load::MASS, RefusalCode::TooHeavy, finding, ways.join("; or "))
}

/// `stars` press hard enough for friction, but carry only `payload`, which is less than the mass of `load`.
pub(super) fn too_heavy_for_stars(load: &Load, stars: &[StarPrediction], payload: StackPayload) -> Refusal {
    let [mass, payload_text] =
        distinct(load.mass.map_or(0.0, |mass| mass.0), payload.range_kg.map_or(0.0, |range| range[1]));
    let reason = limit_in_words(load, stars, payload, 1).unwrap_or_default();
    let finding = format!("they carry at most {payload_text} kg of the {mass} kg: {reason}");
    let other = "more stars, of which those at and below the object's middle press hardest; a wider tube with more pressure; or a smaller \
                 clearance in [frame]";
    let ways: Vec<String> = lighter(payload).into_iter().chain([other.to_owned()]).collect();
    Refusal::new(key::load::MASS, RefusalCode::TooHeavy, finding, ways.join("; or "))
}

/// `stars` press hard enough for friction, but may carry less than the mass of `load`: `payload`. In words.
pub(super) fn may_be_too_heavy(load: &Load, stars: &[StarPrediction], payload: StackPayload) -> String {
    let [mass, payload_text] =
        distinct(load.mass.map_or(0.0, |mass| mass.0), payload.range_kg.map_or(0.0, |range| range[0]));
    let reason = limit_in_words(load, stars, payload, 0).unwrap_or_default();
    format!("they may carry only {payload_text} kg of the {mass} kg: {reason}")
}

/// The mass that stars of this `payload` surely carry, rounded down to the gram, as a remedy; `None` below a gram.
fn lighter(payload: StackPayload) -> Option<String> {
    let [safe, _] = payload.range_kg?;
    // Rounded values still hold.
    let grams = (1e3 * safe).floor();
    (grams > 0.0).then(|| format!("a mass of at most {}", Mass(grams / 1e3)))
}

/// No model covers `star`, of the fabric of `spec`, at the pressure of `load`.
pub(super) fn outside_models(spec: &Spec, load: &Load, star: &StarPrediction) -> Option<Refusal> {
    let pressure = load.pressure.filter(|_| star.graspable_radius_mm.is_none())?;
    let Some([low, high]) = star.modelled_kPa else {
        // Without an object no quantity is required that needs a model.
        let _ = load.object_radius?;
        let remedy = "another star or fabric within the stated limits; or no object_diameter in [load]: then \
             no force is predicted";
        let is_known = section::POISSON.contains(&spec.fabric.poisson_ratio);
        let key = if is_known { key::star::TUBE_WIDTH } else { key::fabric::POISSON_RATIO };
        let finding = star.evidence.choice.clone();
        return Some(Refusal::new(key, RefusalCode::OutsideModels, finding, remedy.to_owned()));
    };
    let likely_pressure = UNITS.iter().map(|unit| pressure.0 * unit).find(|kpa| (low..=high).contains(kpa));
    let slip = pressure.0 > SLIP * high || pressure.0 < low / SLIP;
    let suggestion = likely_pressure
        .filter(|_| slip)
        .map_or_else(String::new, |kpa| format!("did you mean {}? ", Pressure(kpa)));
    Some(Refusal::new(
        key::load::PRESSURE,
        RefusalCode::OutsideModels,
        format!("no model covers this star at {pressure}"),
        format!("{suggestion}it is modelled from {} to {} kPa", Least(low), Most(high)),
    ))
}
