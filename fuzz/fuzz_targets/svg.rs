//! Any text as an SVG drawing; what is read has a finite length.
#![no_main]

use libfuzzer_sys::fuzz_target;
use stargrip_cam::geom::Path;
use stargrip_cam::verify::SvgOrigin;
use stargrip_cam::verify::read_svg;

fuzz_target!(|text: &str| {
    let drawing = read_svg(text, SvgOrigin::Axis);
    assert!(drawing.layers.values().flatten().map(Path::length).sum::<f64>().is_finite());
});
