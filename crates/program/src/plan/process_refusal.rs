//! Refusals of one process among several.

use design::Refusal;
use spec::{SealProcess, Spec, key};

/// `refusal` of a spec whose `[seal]` is `process`, as one of the process in `spec`.
pub(super) fn of_process(spec: &Spec, process: &SealProcess, refusal: Refusal) -> Refusal {
    let place = spec.processes.iter().position(|other| other.name == process.name);
    let Some(place) = place else { return refusal };
    let key = match refusal.key {
        key::seal::SPEED => key::process::SPEED,
        key => key,
    };
    Refusal {
        key: key.of_process(place),
        found: format!("process {}: {}", process.name, refusal.found),
        ..refusal
    }
}
