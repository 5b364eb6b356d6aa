//! `drawing`: from a user's drawing to a spec that names its layers.

use serde_json::{Value, json};
use stargrip_cam::design::{LayerProposal, propose_layers};
use stargrip_cam::spec::{drawing_starter, quoted};

use crate::question::wrong;

/// The name of a drawing whose file has a name that a spec may not contain.
const NAMELESS: &str = "drawing";

/// The answer of `new --drawing` for the one file: the spec, and the role of each layer with its reason; or the reason why it cannot be
/// read.
///
/// # Errors
/// If the question has no drawing, or one that cannot be read.
pub(super) fn drawing(files: &[(String, Vec<u8>)]) -> Result<Value, Value> {
    let [(file, bytes)] = files else { return Err(wrong("a drawing is one file")) };
    let LayerProposal { layers, unit, .. } = propose_layers(file, bytes, None).map_err(|refusals| {
        let reasons = refusals.into_iter().map(|refusal| format!("{}: {}", refusal.found, refusal.remedy));
        json!({ "reasons": reasons.collect::<Vec<_>>() })
    })?;
    let stem = file.rsplit_once('.').map_or(file.as_str(), |(stem, _)| stem);
    let name = if quoted(stem).is_ok() { stem } else { NAMELESS };
    let spec = drawing_starter(name, file, &layers, unit).map_err(wrong)?;
    let roles = layers.iter().map(|(layer, role, reason)| json!([layer, role.word(), reason]));
    Ok(json!({ "spec": spec, "layers": roles.collect::<Vec<_>>() }))
}
