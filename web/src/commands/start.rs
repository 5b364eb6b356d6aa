//! The initial data of a page: `start`; and the meaning of a code: `explain`.

use serde_json::{Value, json};
use stargrip_cam::answer::codes::word_of;
use stargrip_cam::artifact::Kind;
use stargrip_cam::design::RefusalCode;
use stargrip_cam::pipeline::PrecautionCode;
use stargrip_cam::spec;
use stargrip_cam::spec::{Code, FaultCode, Machine};
use stargrip_cam::verify::FindingCode;

use crate::question::text;

/// The schema, the starter, the machine profiles and the kinds of file.
pub(super) fn start() -> Value {
    let machines = spec::builtin_machines().filter_map(|name| {
        let machine = Machine::builtin(name).ok()?;
        Some(json!({ "name": name, "description": machine.description }))
    });
    let kinds = Kind::ALL.iter().map(|kind| json!({ "name": kind.name(), "extra": kind.is_extra() }));
    let schema: Value = serde_json::from_str(&spec::schema()).unwrap_or_default();
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "schema": schema,
        "starter": spec::starter("star").unwrap_or_default(),
        "machines": machines.collect::<Vec<_>>(),
        "kinds": kinds.collect::<Vec<_>>(),
    })
}

/// The `meaning` of a code, with its remedy; null if there is no such code. Examples are in docs/codes.md.
pub(super) fn explain(question: &Value) -> Value {
    let word = word_of(text(question, "code").unwrap_or_default());
    let meaning = meaning_in(FaultCode::ALL, word)
        .or_else(|| meaning_in(RefusalCode::ALL, word))
        .or_else(|| meaning_in(FindingCode::ALL, word))
        .or_else(|| meaning_in(PrecautionCode::ALL, word));
    json!({ "meaning": meaning })
}

/// The meaning of the code `word` among `codes`.
fn meaning_in<C: Code>(codes: &[C], word: &str) -> Option<&'static str> {
    codes.iter().find(|code| code.as_str() == word).map(|code| code.meaning())
}
