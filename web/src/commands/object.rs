//! `new`: from an object to the spec of a gripper.

use serde_json::{Value, json};
use stargrip_cam::answer::object::{FORCES, FRICTIONS, MASSES, NoGripper, PRESSURES, Request, base, sheet};
use stargrip_cam::answer::quantity::{SIZE, number, stated};
use stargrip_cam::forecast::sizing::Requirements;
use stargrip_cam::spec;
use stargrip_cam::spec::{Machine, ObjectShape};

use crate::commands::faults::refused;
use crate::question::{text, wrong};


/// A spec with its verdict; or the faults of the fields; or the reason why there is no gripper, with the nearest possible request.
///
/// # Errors
/// The faults of the fields, or the program's own texts, if they are refused.
pub(super) fn new(question: &Value) -> Result<Value, Value> {
    let name = text(question, "name").filter(|name| !name.trim().is_empty()).unwrap_or("gripper");
    let request = request(question).map_err(|wrong| json!({ "fields": wrong }))?;
    let mut faults = Vec::new();
    let size = taken(question, "sheet", sheet, &mut faults);
    if !faults.is_empty() {
        return Err(json!({ "fields": faults }));
    }
    let starter = spec::starter("base").map_err(wrong)?;
    let base = base(starter, field(question, "machine"), size).map_err(|faults| refused(&faults))?;
    let machine = Machine::builtin(&base.machine.profile).map_err(wrong)?;
    Ok(match request.gripper(name, &base, &machine) {
        Ok(made) => json!({ "spec": made.text, "in_words": made.in_words(), "chosen": made.json() }),
        Err(NoGripper::Fault(why)) => json!({ "reasons": [why] }),
        Err(NoGripper::Infeasible(reasons, nearest)) => {
            let nearest = nearest.first().map(|nearest| near(&nearest.requirements));
            json!({ "reasons": reasons, "nearest": nearest })
        }
    })
}

/// The text of a field; `None` if it is empty.
fn field<'q>(question: &'q Value, name: &str) -> Option<&'q str> {
    text(question, name).map(str::trim).filter(|text| !text.is_empty())
}

/// Reads all fields, so that all faults are reported at once.
fn request(question: &Value) -> Result<Request, Vec<Value>> {
    let mut wrong = Vec::new();
    let object = taken(question, "object", stated(SIZE), &mut wrong);
    let height = taken(question, "height", stated(SIZE), &mut wrong);
    let mass = taken(question, "mass", stated(MASSES), &mut wrong);
    let pressure = taken(question, "pressure", stated(PRESSURES), &mut wrong);
    let fragile = taken(question, "fragile", stated(FORCES), &mut wrong);
    let friction = taken(question, "friction", number(FRICTIONS), &mut wrong);
    let shape = field(question, "shape")
        .and_then(|word| ObjectShape::ALL.iter().find(|(name, _)| *name == word))
        .map(|(_, shape)| *shape);
    for (name, is_absent) in [("object", object.is_none()), ("mass", mass.is_none())] {
        if is_absent && wrong.iter().all(|one| one["field"] != name) {
            wrong.push(json!({ "field": name, "found": "is needed: a number and its unit" }));
        }
    }
    let request = object.zip(mass).map(|(object, mass)| Request {
        object,
        height,
        shape,
        mass,
        pressure,
        friction,
        fragile,
    });
    request.filter(|_| wrong.is_empty()).ok_or(wrong)
}

/// The value of a field, if it is not empty; its fault is added to `wrong`.
fn taken<T>(
    question: &Value,
    name: &str,
    read: impl Fn(&str) -> Result<T, String>,
    wrong: &mut Vec<Value>,
) -> Option<T> {
    let found = read(field(question, name)?);
    found.map_err(|why| wrong.push(json!({ "field": name, "found": why }))).ok()
}

/// The fields of a request with the requirements `eased`.
fn near(eased: &Requirements) -> Value {
    let sheet = eased.room.sheet.iter().all(|side| side.0.is_finite());
    let sheet = sheet.then(|| eased.room.sheet.map(|side| side.0.to_string()).join("x"));
    json!({
        "object": eased.width_in_words(),
        "height": eased.height_in_words(),
        "shape": eased.shape.map(ObjectShape::word),
        "mass": eased.mass_in_words(),
        "pressure": eased.pressure_in_words(),
        "friction": (!eased.friction_assumed).then(|| eased.friction.to_string()),
        "fragile": eased.force_in_words(),
        "sheet": sheet,
    })
}
