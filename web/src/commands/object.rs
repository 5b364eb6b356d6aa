//! `new`: from an object to the spec of a gripper.

use serde_json::{Value, json};
use stargrip_cam::answer::object::{FORCES, FRICTIONS, MASSES, NoGripper, PRESSURES, Request, base, sheet};
use stargrip_cam::answer::quantity::{SIZE, number, quantity};
use stargrip_cam::forecast::sizing::{FRICTION, NearestRequirements};
use stargrip_cam::spec;
use stargrip_cam::spec::{Allowed, Machine, ObjectShape};
use stargrip_cam::units::{Length, Quantity};

use crate::commands::text;

/// A spec with its verdict; or the faults of the fields; or the reason why there is no gripper, with the nearest possible request.
///
/// # Errors
/// If the program's own texts are refused.
pub(super) fn new(question: &Value) -> Result<Value, String> {
    let name = text(question, "name").filter(|name| !name.trim().is_empty()).unwrap_or("gripper");
    let request = match request(question) {
        Ok(request) => request,
        Err(wrong) => return Ok(json!({ "fields": wrong })),
    };
    let size = field(question, "sheet").map(sheet).transpose();
    let size = match size {
        Ok(size) => size,
        Err(why) => return Ok(json!({ "fields": [{ "field": "sheet", "found": why }] })),
    };
    let starter = spec::starter("base")?;
    let base = base(starter, field(question, "machine"), size).map_err(|faults| faults.to_string())?;
    let machine = Machine::builtin(&base.machine.profile)?;
    Ok(match request.gripper(name, &base, &machine) {
        Ok(made) => json!({ "spec": made.text, "in_words": made.in_words(), "chosen": made.json() }),
        Err(NoGripper::Fault(why)) => json!({ "reasons": [why] }),
        Err(NoGripper::Infeasible(reasons, nearest)) => {
            let nearest = nearest.map(|nearest| near(&nearest, &request));
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
    let object = taken(question, "object", SIZE, &mut wrong);
    let height = taken(question, "height", SIZE, &mut wrong);
    let mass = taken(question, "mass", MASSES, &mut wrong);
    let pressure = taken(question, "pressure", PRESSURES, &mut wrong);
    let fragile = taken(question, "fragile", FORCES, &mut wrong);
    let friction = field(question, "friction").map(number(FRICTIONS)).transpose();
    let friction = friction.unwrap_or_else(|why| {
        wrong.push(json!({ "field": "friction", "found": why }));
        None
    });
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

/// The quantity in a field; its fault is added to `wrong`.
fn taken<Q: Quantity>(question: &Value, name: &str, allowed: Allowed, wrong: &mut Vec<Value>) -> Option<Q> {
    match quantity::<Q>(allowed)(field(question, name)?) {
        Ok(found) => Some(found),
        Err(why) => {
            wrong.push(json!({ "field": name, "found": why }));
            None
        }
    }
}

/// The fields of a request near `request` that can be met.
fn near(nearest: &NearestRequirements, request: &Request) -> Value {
    let had = &nearest.requirements;
    let is_assumed = request.friction.is_none() && had.friction == FRICTION;
    let sheet = had.room.sheet.map(|side| format!("{}x{}", side.0, side.0));
    json!({
        "object": Length(2.0 * had.object.0).to_string(),
        "height": had.height.map(|height| height.to_string()),
        "shape": had.shape.map(ObjectShape::word),
        "mass": had.mass.to_string(),
        "pressure": had.pressure.map(|pressure| pressure.to_string()),
        "friction": (!is_assumed).then(|| had.friction.to_string()),
        "fragile": had.largest_force.map(|force| force.to_string()),
        "sheet": sheet,
    })
}
