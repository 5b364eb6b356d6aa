//! The seams of a star in a file that this program wrote, given as a drawing.
//!
//! Such a file has centre lines only. The outer one is open: its ends run past the mouth of the inlet. The **port** lies between them, and
//! the **cut** runs beside the outer seam as beside any other; the hole of the star is cut beside the inner one. The ends are drawn
//! back to where the channel of a port begins, so that the sealed shape has the same seams again.

use crate::Layer;
use crate::offset::offset;
use crate::star_seam::MOUTH_OVERRUN;
use artwork::{Artwork, Element, Figure};
use geom::{Line, Path, Segment, Vec2};
use sealed::{DrawnCurve, DrawnPort, PortPlace, Rules, Sketch};
use spec::{DrawingSpec, LayerRole};

/// Flap on the hole side, mm: the default of `hole_allowance`, which a drawing does not have.
const HOLE_FLAP: f64 = 1.0;
/// Distances and angles, mm and rad, by which the two ends of a channel may differ: files have four decimals.
const ALIKE: f64 = 0.01;

/// Whether `element` is on the layer that this program names so.
fn is_on_layer(element: &Element, layer: Layer) -> bool {
    element.names().any(|name| name == layer.name())
}

/// Adds ports and cuts to `sketch`, as far as `drawing` has the seams of stars on the layers of this program; the notes on them.
///
/// A drawing with ports or cuts of its own is left alone: a person has edited it.
pub(super) fn complete(
    sketch: &mut Sketch,
    drawing: &Artwork,
    spec: &DrawingSpec,
    rules: &Rules,
) -> Vec<String> {
    let is_seam = |element: &&Element| spec.role(element.names()) == Some(LayerRole::Seam);
    let figures = drawing.elements.iter().filter(is_seam);
    if !sketch.ports.is_empty() || !sketch.cuts.is_empty() || !sketch.holes.is_empty() {
        return Vec::new();
    }
    let mut names = Vec::new();
    for element in figures.clone().filter(|element| is_on_layer(element, Layer::SealOuter)) {
        let Figure::Path(path) = &element.figure else { continue };
        let Some((closed, port)) = closed_at_mouth(path, rules) else { continue };
        let Some(seam) = sketch.seams.iter_mut().find(|seam| seam.path == *path) else { continue };
        seam.path = closed;
        sketch.ports.push(DrawnPort { name: element.id.clone(), place: PortPlace::At(port) });
        names.push(element.id.clone());
    }
    if names.is_empty() {
        return Vec::new();
    }
    let inner = figures.filter(|element| is_on_layer(element, Layer::SealInner));
    let holes = inner.filter_map(|element| {
        let Figure::Path(path) = &element.figure else { return None };
        let outline = path.counterclockwise();
        let path = offset(&outline, -(rules.band / 2.0 + HOLE_FLAP))?;
        Some(DrawnCurve { name: element.id.clone(), path })
    });
    sketch.holes.extend(holes);
    vec![format!(
        "{}: seams of stars that this program wrote; ports are between their ends, and the cuts {} mm beside the bands, {HOLE_FLAP} mm at the hole.",
        names.join(", "),
        rules.allowance
    )]
}

/// Width of the channel between the bands of the first open outer seam of a star in `drawing`, mm; `None` without one. The hose has it, not
/// `[inlet]`.
pub(super) fn port_width(drawing: &Artwork, spec: &DrawingSpec, band: f64) -> Option<f64> {
    let is_outer = |element: &&Element| {
        spec.role(element.names()) == Some(LayerRole::Seam)
            && element.names().any(|name| name == Layer::SealOuter.name())
    };
    drawing.elements.iter().filter(is_outer).find_map(|element| match &element.figure {
        Figure::Path(path) if !path.closed => Some(path.start()?.distance(path.end()?) - band),
        Figure::Path(_) | Figure::Point(_) => None,
    })
}

/// The open outer seam of a star, closed where the channel of a port begins, and the place of the port; `None` if its ends are not those of
/// a channel.
fn closed_at_mouth(path: &Path, rules: &Rules) -> Option<(Path, geom::Point)> {
    let (Some(Segment::Line(inwards)), Some(Segment::Line(outwards))) =
        (path.segments.first(), path.segments.last())
    else {
        return None;
    };
    let direction: Vec2 = outwards.direction();
    let opening = outwards.end - inwards.start;
    let are_parallel = (inwards.direction() + direction).length() < ALIKE;
    let is_square = opening.dot(direction).abs() < ALIKE && opening.length() > rules.band;
    // From the end of the seam to where the channel of a port begins beside a closed seam.
    let back = MOUTH_OVERRUN + rules.band / 2.0 + rules.allowance;
    let is_long = inwards.length().min(outwards.length()) > back;
    if path.closed || !are_parallel || !is_square || !is_long {
        return None;
    }
    let [start, end] = [inwards.start - direction * back, outwards.end - direction * back];
    let mut segments = path.segments.clone();
    *segments.first_mut()? = Line::new(start, inwards.end).into();
    *segments.last_mut()? = Line::new(outwards.start, end).into();
    segments.push(Line::new(end, start).into());
    Some((Path::closed(segments), start.midpoint(end)))
}
