//! Any bytes as a spec and as a machine profile: read or refused, and what is refused can be shown.
#![no_main]

use libfuzzer_sys::fuzz_target;
use stargrip_cam::spec;
use stargrip_cam::spec::Source;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(source) = Source::from_bytes("fuzz.toml", bytes) {
        let _ = spec::read(&source).map_err(|faults| faults.to_string());
        let _ = spec::read_machine(&source).map_err(|faults| faults.to_string());
    }
});
