//! Any text as a program.
#![no_main]

use libfuzzer_sys::fuzz_target;
use stargrip_cam::verify::gcode::Dialect;
use stargrip_cam::verify::gcode::read_program;

fuzz_target!(|text: &str| {
    let _ = read_program(text, Dialect::GENERIC);
});
