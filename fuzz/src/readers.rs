//! The readers of drawings, pages and solids.

use stargrip_cam::geom::Path;
use stargrip_cam::verify::{Drawing, SvgOrigin, read_dxf, read_stl, read_svg};

use super::shown;

/// Any text as an SVG drawing.
pub(super) fn svg(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    for origin in [SvgOrigin::Axis, SvgOrigin::LowerLeft] {
        drawing(text.len(), &read_svg(text, origin));
    }
}

/// Any text as a DXF drawing; its line ends do not matter.
pub(super) fn dxf(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let read = read_dxf(text);
    drawing(text.len(), &read);
    if !text.contains('\r') {
        assert_eq!(read_dxf(&text.replace('\n', "\r\n")), read);
    }
}

/// Any bytes as a solid; its corners written again are the bytes that were read.
pub(super) fn stl(bytes: &[u8]) {
    let Some(facets) = read_stl(bytes) else { return };
    assert_eq!(facets.len(), (bytes.len() - 84) / 50);
    for (facet, raw) in facets.iter().zip(bytes[84..].chunks_exact(50)) {
        let again: Vec<u8> = facet.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        assert_eq!(again, raw[12..48]);
    }
}

/// Every path is finite, there are no more than the file has room for, and no finding shows a control character.
fn drawing(length: usize, drawing: &Drawing) {
    let paths = || drawing.layers.values().flatten();
    assert!(paths().map(Path::length).sum::<f64>().is_finite());
    assert!(paths().all(|path| path.bounds().width().is_finite() || path.segments.is_empty()));
    assert!(paths().map(|path| path.segments.len()).sum::<usize>() <= length, "more than was written");
    assert!(drawing.order.iter().all(|layer| drawing.layers.contains_key(layer)));
    shown::findings(&drawing.findings);
}
