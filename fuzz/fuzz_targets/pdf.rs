//! Any bytes as a PDF; what is read has a finite length.
#![no_main]

use libfuzzer_sys::fuzz_target;
use stargrip_cam::geom::Path;
use stargrip_cam::verify::Findings;
use stargrip_cam::verify::read_pdf;

fuzz_target!(|bytes: &[u8]| {
    for page in read_pdf(bytes, &mut Findings::default()) {
        assert!(page.drawing.layers.values().flatten().map(Path::length).sum::<f64>().is_finite());
    }
});
