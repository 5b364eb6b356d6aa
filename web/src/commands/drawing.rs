//! `drawing`: from a user's drawing to a spec that names its layers.

use serde_json::{Value, json};
use stargrip_cam::design::{LayerProposal, propose_layers};
use stargrip_cam::spec::{drawing_starter, quoted};

/// The name of a drawing whose file has a name that a spec may not contain.
const NAMELESS: &str = "drawing";

/// The answer of `new --drawing` for the one file: the spec, and the role of each layer with its reason; or the reason why it cannot be
/// read.
///
/// # Errors
/// If the question has no drawing.
pub(super) fn drawing(files: &[(String, Vec<u8>)]) -> Result<Value, String> {
    let [(file, bytes)] = files else { return Err("a drawing is one file".to_owned()) };
    let LayerProposal { layers, unit, .. } = match propose_layers(file, bytes, None) {
        Ok(proposal) => proposal,
        Err(refusals) => {
            let reasons =
                refusals.into_iter().map(|refusal| format!("{}: {}", refusal.found, refusal.remedy));
            return Ok(json!({ "reasons": reasons.collect::<Vec<_>>() }));
        }
    };
    let stem = file.rsplit_once('.').map_or(file.as_str(), |(stem, _)| stem);
    let name = if quoted(stem).is_ok() { stem } else { NAMELESS };
    let spec = drawing_starter(name, file, &layers, unit)?;
    let roles = layers.iter().map(|(layer, role, reason)| json!([layer, role.word(), reason]));
    Ok(json!({ "spec": spec, "layers": roles.collect::<Vec<_>>() }))
}
