//! Drawings of other programs: whatever is read is finite, whole, and within the limits.

use artwork::{Artwork, Fault, Figure, Limits, Options, Unit, read_dxf, read_svg};

/// Limits that hold for the longest input, so that a case that multiplies work is found soon.
const LIMITS: Limits = Limits { bytes: 1 << 20, visits: 20_000, segments: 50_000, text: 4 << 20, depth: 64 };

/// Any bytes as an SVG file of another program.
pub(super) fn svg(bytes: &[u8]) {
    both(bytes, read_svg);
}

/// Any bytes as a DXF file of another program.
pub(super) fn dxf(bytes: &[u8]) {
    both(bytes, read_dxf);
}

fn both(bytes: &[u8], reader: fn(&[u8], &Options) -> Result<Artwork, Vec<Fault>>) {
    for unit in [None, Some(Unit::Millimetre)] {
        match reader(bytes, &Options { unit, assume: unit.is_none(), limits: LIMITS, ..Options::new(0.01) }) {
            Ok(drawing) => whole(&drawing),
            Err(faults) => assert!(!faults.is_empty() && faults.iter().all(|fault| !fault.remedy.is_empty())),
        }
    }
}

/// Paths hang together, have a length, and lie where coordinates are allowed.
fn whole(drawing: &Artwork) {
    let mut segments = 0;
    for element in &drawing.elements {
        assert!(
            !element.id.is_empty()
                && !element.layers.iter().enumerate().any(|(i, name)| element.layers[..i].contains(name))
        );
        match &element.figure {
            Figure::Point(point) => assert!(point.x.abs() <= 1e6 && point.y.abs() <= 1e6),
            Figure::Path(path) => {
                segments += path.segments.len();
                assert!(path.length().is_finite() && path.length() > 0.0, "{element:?}");
                assert!(path.segments.iter().all(|segment| segment.length() > 0.0), "{element:?}");
                let bounds = path.bounds();
                // Arcs that are as flat as they are long lose digits of their ends: beyond 10 m the tolerance is the bound.
                let gap = if bounds.width().max(bounds.height()) < 1e4 { 1e-6 } else { 0.01 };
                assert!(path.largest_gap() <= gap, "{} in {element:?}", path.largest_gap());
                assert!(bounds.width() <= 5e6 && bounds.height() <= 5e6, "{element:?}");
            }
        }
    }
    assert!(segments <= LIMITS.segments + drawing.elements.len());
    assert!(drawing.unit_mm > 0.0);
}
