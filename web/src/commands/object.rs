//! `new`: from an object to the spec of a gripper.

use serde_json::{Value, json};
use stargrip_cam::answer::object::{NoGripper, Request, WrongValue, base, read_value, sheet};
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
    let mut wrong_values = Vec::new();
    let size = read_value("sheet", field(question, "sheet"), sheet, &mut wrong_values);
    let request = Request::read(|name| field(question, name)).map_err(|wrong| fields(&wrong))?;
    if !wrong_values.is_empty() {
        return Err(fields(&wrong_values));
    }
    let starter = spec::starter("base").map_err(wrong)?;
    let base_spec = base(starter, field(question, "machine"), size).map_err(|faults| refused(&faults))?;
    let machine = Machine::builtin(&base_spec.machine.profile).map_err(wrong)?;
    Ok(match request.gripper(name, &base_spec, &machine) {
        Ok(made) => json!({ "spec": made.text, "in_words": made.in_words(), "chosen": made.json() }),
        Err(NoGripper::Fault(why)) => json!({ "reasons": [why] }),
        Err(NoGripper::Infeasible(reasons, nearest)) => {
            let nearest = nearest.first().map(|nearest| near_fields(&nearest.requirements));
            json!({ "reasons": reasons, "nearest": nearest })
        }
    })
}

/// The text of a field; `None` if it is empty.
fn field<'q>(question: &'q Value, name: &str) -> Option<&'q str> {
    text(question, name).map(str::trim).filter(|text| !text.is_empty())
}

/// The faults of fields, for the page.
fn fields(wrong: &[WrongValue]) -> Value {
    let list = wrong.iter().map(|value| json!({ "field": value.name, "found": value.reason }));
    json!({ "fields": list.collect::<Vec<_>>() })
}

/// The fields of a request with the requirements `eased`.
fn near_fields(eased: &Requirements) -> Value {
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
