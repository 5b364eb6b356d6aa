//! Any text as a DXF drawing; what is read has a finite length.
#![no_main]

use libfuzzer_sys::fuzz_target;
use stargrip_cam::geom::Path;
use stargrip_cam::verify::read_dxf;

fuzz_target!(|text: &str| {
    let drawing = read_dxf(text);
    assert!(drawing.layers.values().flatten().map(Path::length).sum::<f64>().is_finite());
});
