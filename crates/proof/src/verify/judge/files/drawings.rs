//! SVG and DXF files against the drawings they should be, and against each other.

use std::f64::consts::PI;

use crate::verify::judge::files::layers::{LayerStyle, in_file, look};
use crate::verify::judge::path::measure::{Prepared, furthest};
use crate::verify::read::dxf_words::DxfFrame;
use crate::verify::read::{dxf_words, svg, svg_words};
use crate::verify::{Drawing, Finding, FindingCode, Findings, SvgOrigin, deviation, read_dxf};
use design::{Drawing as Exact, Layer, Origin, Shape};
use geom::{Arc, Bounds, Path, Point, Segment};
use spec::{Colours, Spec};

/// Reads an SVG, whose words and page must be the drawing's, in the colours of the spec.
pub(super) fn read_page(
    text: &str,
    exact: &Exact,
    title: &str,
    spec: &Spec,
    findings: &mut Findings,
) -> Drawing {
    let tolerance = spec.accuracy.path.0;
    let document = match svg::parse(text) {
        Ok(document) => document,
        Err(finding) => {
            findings.push(finding);
            return Drawing::default();
        }
    };
    let colour = |name: &str| {
        layers(exact, spec.cut.colours).find(|(layer, _)| *layer == name).map(|(_, look)| look.svg)
    };
    svg_words::check(&document, &in_file(title, 120), &colour, findings);
    let (origin, corner) = match exact.origin {
        Origin::LowerLeft => (SvgOrigin::LowerLeft, (0.0, 0.0)),
        Origin::Axis(corner) => (SvgOrigin::Axis, (corner.x, -(corner.y + exact.height))),
    };
    let mut drawing = svg::read_document(&document, origin);
    findings.extend(std::mem::take(&mut drawing.findings));
    check_page(&drawing, exact, findings);
    // Extents are written with as many decimals as coordinates.
    let page = drawing.page.zip(drawing.corner);
    let is_right = page.is_some_and(|((width, height), (x, y))| {
        let errors = [width - exact.width, height - exact.height, x - corner.0, y - corner.1];
        errors.iter().all(|error| error.abs() <= tolerance)
    });
    if !is_right {
        let fault = page.map_or("no page".to_owned(), |(size, corner)| page_text(size, corner));
        findings.add(FindingCode::WrongSize, fault, page_text((exact.width, exact.height), corner));
    }
    drawing
}

/// The size and the corner of a page, mm, for a message.
fn page_text((width, height): (f64, f64), (x, y): (f64, f64)) -> String {
    format!("{width} x {height} mm from ({x}, {y})")
}

/// The layers of a drawing with their look.
fn layers(exact: &Exact, colours: Colours) -> impl Iterator<Item = (&'static str, LayerStyle)> {
    exact.layers.iter().map(move |(layer, _)| (layer.name(), look(*layer, colours)))
}

/// Checks that everything is inside the page: a reader may cut off the rest.
fn check_page(drawing: &Drawing, exact: &Exact, findings: &mut Findings) {
    let corner = exact.corner();
    let page = Bounds { min: corner, max: Point::new(corner.x + exact.width, corner.y + exact.height) };
    let page = page.outset(1e-3);
    for (layer, paths) in &drawing.layers {
        let bounds = paths.iter().map(Path::bounds).fold(Bounds::EMPTY, Bounds::union);
        let is_inside = paths.is_empty() || page.contains(bounds.min) && page.contains(bounds.max);
        if !is_inside {
            findings.add(FindingCode::OutsidePage, format!("{bounds} on layer {layer}"), page.to_string());
        }
    }
}

/// Reads a DXF, of which every tag must be one that the drawing's file has.
pub(super) fn read_plan(text: &str, exact: &Exact, spec: &Spec, findings: &mut Findings) -> Drawing {
    let corner = exact.corner();
    let layer_names: Vec<(&str, &str)> =
        layers(exact, spec.cut.colours).map(|(name, look)| (name, look.dxf)).collect();
    let frame = DxfFrame {
        layers: &layer_names,
        min: (corner.x, corner.y),
        max: (corner.x + exact.width, corner.y + exact.height),
        tolerance: spec.accuracy.path.0,
    };
    if let Err(finding) = dxf_words::check(text, &frame) {
        findings.push(finding);
    }
    let mut drawing = read_dxf(text);
    findings.extend(std::mem::take(&mut drawing.findings));
    drawing
}

/// Compares the drawing read with the expected one; the largest deviation either way.
pub(super) fn compare(read: &Drawing, exact: &Exact, tolerance: f64, findings: &mut Findings) -> f64 {
    let mut largest = 0.0_f64;
    for (name, paths) in read.layers.iter().filter(|(_, paths)| !paths.is_empty()) {
        if !exact.layers.iter().any(|(layer, _)| layer.name() == name) {
            let fault = format!("{} paths on layer {name}", paths.len());
            findings.add(FindingCode::UnknownLayer, fault, "only the layers of the drawing");
        }
    }
    order(read, exact, findings);
    for (layer, shapes) in &exact.layers {
        let expected: Vec<Path> = shapes.iter().flat_map(paths_of).collect();
        let paths = read.layer(layer.name());
        largest = largest.max(compare_layer(*layer, paths, &expected, tolerance, findings));
    }
    largest
}

/// Layers are in the drawing's order: holes are cut before the parts around them come loose.
fn order(read: &Drawing, exact: &Exact, findings: &mut Findings) {
    let right: Vec<&str> =
        exact.layers.iter().filter(|(_, shapes)| !shapes.is_empty()).map(|(layer, _)| layer.name()).collect();
    let drawn_layers: Vec<&str> =
        read.order.iter().map(String::as_str).filter(|name| !read.layer(name).is_empty()).collect();
    let are_all_known =
        drawn_layers.iter().all(|name| right.contains(name)) && drawn_layers.len() == right.len();
    if are_all_known && drawn_layers != right {
        findings.add(FindingCode::Order, drawn_layers.join(", "), right.join(", "));
    }
}

/// Many times the segments that a drawing has are not measured: the time would grow with their number's square.
const MANY: usize = 20;

fn segments(paths: &[Path]) -> usize {
    paths.iter().map(|path| path.segments.len()).sum()
}

/// Compares the paths of one layer with the expected ones; the largest deviation either way, mm.
///
/// Numbers of paths and their length are compared first, because a missing or doubled path may lie within the tolerance of
/// another one. Paths in the same order are compared one by one, which is fast; else each with the nearest of all.
fn compare_layer(
    layer: Layer,
    paths: &[Path],
    expected: &[Path],
    tolerance: f64,
    findings: &mut Findings,
) -> f64 {
    let name = layer.name();
    if paths.len() != expected.len() {
        let (fault, allowed) = (format!("{} paths on layer {name}", paths.len()), expected.len().to_string());
        findings.add(FindingCode::PathCount, fault, allowed);
    }
    if closed_count(paths) != closed_count(expected) {
        let fault = format!("{} closed paths on layer {name}", closed_count(paths));
        findings.add(FindingCode::OpenLoop, fault, closed_count(expected).to_string());
    }
    // Rounding moves each vertex by less than a tolerance, so a doubled stretch exceeds it by far.
    let (length, right) = (total(paths), total(expected));
    let slack: f64 = paths.iter().flat_map(|path| &path.segments).map(|_| tolerance).sum();
    if (length - right).abs() > slack.max(tolerance) {
        let fault = format!("{length:.3} mm on layer {name}");
        findings.add(FindingCode::PathLength, fault, format!("{right:.3} mm"));
    }
    if expected.is_empty() && paths.is_empty() {
        return 0.0;
    }
    let measured = match one_by_one(paths, expected, tolerance) {
        Some(measured) => measured,
        None if segments(paths) > MANY * (segments(expected) + 10) => f64::INFINITY,
        None => {
            let measured = deviation(paths, expected).largest();
            if measured <= tolerance && paths.len() == expected.len() && paths.len() > 1 {
                let fault = format!("paths in another order on layer {name}");
                findings.add(FindingCode::Order, fault, "the order of the drawing");
            }
            measured
        }
    };
    if measured.is_nan() || measured > tolerance {
        let deviation =
            if measured.is_finite() { &format!("{measured:.6} mm") } else { "no path to measure" };
        findings.add(
            FindingCode::Deviation,
            format!("{deviation} on layer {name}"),
            format!("{tolerance} mm"),
        );
    }
    measured
}

fn closed_count(paths: &[Path]) -> usize {
    paths.iter().filter(|path| path.closed).count()
}

/// The largest deviation of any path from the one at its place in the list.
///
/// It is never less than that of all from all. `None` where it is not within the tolerance: files may be in another order.
fn one_by_one(paths: &[Path], expected: &[Path], tolerance: f64) -> Option<f64> {
    if paths.len() != expected.len() {
        return None;
    }
    let mut largest = 0.0_f64;
    for (path, right) in paths.iter().zip(expected) {
        // Segments shorter than the tolerance can be taken for each other; distances cannot.
        let measured = in_step(path, right, tolerance)
            .filter(|measured| *measured <= tolerance)
            .unwrap_or_else(|| deviation(std::slice::from_ref(path), std::slice::from_ref(right)).largest());
        if measured.is_nan() || measured > tolerance {
            return None;
        }
        largest = largest.max(measured);
    }
    Some(largest)
}

/// The largest distance of a path from the exact one, if both take the same way from the same start; `None` if they do not.
///
/// Writers cut segments into pieces. Each piece is compared, both ways, with its part of the exact segment. The parts are all of
/// the exact path, so no distance is underrated, and the cost is linear.
fn in_step(path: &Path, right: &Path, tolerance: f64) -> Option<f64> {
    let mut scratch = Vec::new();
    let mut largest = 0.0_f64;
    let mut pieces = path.segments.iter();
    for exact in &right.segments {
        let mut progress = 0.0;
        while progress < 1.0 {
            let piece = pieces.next()?;
            let end = piece.end();
            let reach =
                if end.distance(exact.end()) <= tolerance { 1.0 } else { exact.nearest_fraction(end) };
            if reach <= progress {
                return None;
            }
            let is_whole = progress == 0.0 && reach >= 1.0;
            let part = if is_whole { *exact } else { exact.part(progress, reach) };
            largest = largest.max(separation(piece, &part, &mut scratch));
            progress = reach;
        }
    }
    pieces.next().is_none().then_some(largest)
}

/// The largest distance between two segments.
fn separation(a: &Segment, b: &Segment, scratch: &mut Vec<f64>) -> f64 {
    if let (Segment::Line(a), Segment::Line(b)) = (a, b) {
        // Between the ends, the distance changes evenly.
        return a.start.distance(b.start).max(a.end.distance(b.end));
    }
    let (a, b) = ([Prepared::new(*a)], [Prepared::new(*b)]);
    furthest(&a[0], &b, scratch).max(furthest(&b[0], &a, scratch)).distance
}

fn total(paths: &[Path]) -> f64 {
    // The sum of nothing is -0.
    paths.iter().map(Path::length).sum::<f64>() + 0.0
}

/// A shape as paths; a circle as two half turns.
pub(super) fn paths_of(shape: &Shape) -> Vec<Path> {
    match shape {
        Shape::Path(path) => vec![path.clone()],
        Shape::Circle { center, radius } => {
            vec![Path::closed([0.0, PI].map(|start| Arc::new(*center, *radius, start, PI).into()).to_vec())]
        }
        Shape::Figure(paths) => paths.clone(),
    }
}

/// The curves in one file.
struct DrawnCurves {
    sheet: usize,
    file: String,
    /// (layer, number of paths, their length), empty layers left out.
    layers: Vec<(String, usize, f64)>,
}

/// The seal drawings of all formats, to be held against each other.
#[derive(Default)]
pub(super) struct Seals(Vec<DrawnCurves>);

impl Seals {
    /// Notes the content of a file.
    pub(super) fn add(&mut self, sheet: usize, file: &str, drawing: &Drawing) {
        let layers = drawing.layers.iter().filter(|(_, paths)| !paths.is_empty());
        let layers = layers.map(|(name, paths)| (name.clone(), paths.len(), total(paths))).collect();
        self.0.push(DrawnCurves { sheet, file: file.to_owned(), layers });
    }

    /// Files of the same sheet that hold different things. A file with `proven` faults of its own does not make the others faulty.
    pub(super) fn disagreements(&self, tolerance: f64, proven: &[Finding]) -> Vec<Finding> {
        let mut findings = Vec::new();
        for (i, DrawnCurves { sheet, file, layers }) in self.0.iter().enumerate() {
            let Some(first) = self.0[..i].iter().find(|seen| seen.sheet == *sheet) else { continue };
            let DrawnCurves { file: other, layers: other_layers, .. } = first;
            let [is_other_faulty, is_faulty] =
                [other, file].map(|file| proven.iter().any(|finding| finding.file == *file));
            if is_other_faulty && !is_faulty {
                continue;
            }
            for (layer, count, length) in layers {
                let twin = other_layers.iter().find(|(name, _, _)| name == layer);
                // As much as the rounding of a hundred vertices each could add up to.
                if twin.is_some_and(|(_, c, l)| c == count && (l - length).abs() <= 200.0 * tolerance) {
                    continue;
                }
                let fault = format!("{count} paths of {length:.3} mm on layer {layer}");
                let allowed = twin.map_or(format!("none, as in {other}"), |(_, c, l)| {
                    format!("{c} of {l:.3} mm, as in {other}")
                });
                findings.push(Finding::new(FindingCode::FormatsDisagree, fault, allowed).in_file(file));
            }
        }
        findings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::{Isometry, Line, Vec2};

    /// A half disc, and the same in pieces, as a writer would cut it.
    fn half_disc(pieces: u32) -> Path {
        let (left, right) = (Point::new(-20.0, 0.0), Point::new(20.0, 0.0));
        let arc: Segment = Arc::new(Point::ORIGIN, 20.0, 0.0, PI).into();
        let fraction = |i: u32| f64::from(i) / f64::from(pieces);
        let arcs = (0..pieces).map(|i| arc.part(fraction(i), fraction(i + 1)));
        Path::closed(arcs.chain([Line::new(left, right).into()]).collect())
    }

    #[test]
    fn in_step_never_underrates() {
        let exact = half_disc(1);
        for pieces in [1, 2, 7] {
            for shift in [0.0, 1e-5, 9e-4] {
                let moved = Isometry::translation(Vec2::new(shift, shift)).path(&half_disc(pieces));
                let quick = in_step(&moved, &exact, 1e-2).expect("the same path");
                let thorough =
                    deviation(std::slice::from_ref(&moved), std::slice::from_ref(&exact)).largest();
                assert!(quick >= thorough - 1e-12, "{pieces}, {shift}: {quick} {thorough}");
                assert!(quick <= 1.5 * shift + 1e-9, "{pieces}, {shift}: {quick}");
            }
        }
    }

    /// The first half of an arc of 0.015 mm ends so near to the arc's own end that it is taken for all of it.
    #[test]
    fn segments_shorter_than_the_tolerance_stand_in_order() {
        let arc = Arc::new(Point::ORIGIN, 0.05, 0.0, 0.3);
        let line: Segment = Line::new(arc.end(), Point::new(10.0, 0.0)).into();
        let arc: Segment = arc.into();
        let exact = Path::open(vec![arc, line]);
        let cut = Path::open(vec![arc.part(0.0, 0.5), arc.part(0.5, 1.0), line]);
        let copy = |path: &Path| Isometry::translation(Vec2::new(0.0, 30.0)).path(path);
        let measured = one_by_one(&[cut.clone(), copy(&cut)], &[exact.clone(), copy(&exact)], 0.01);
        assert!(measured.is_some_and(|distance| distance < 1e-9), "{measured:?}");
    }

    #[test]
    fn another_start_or_a_missing_piece_is_left_to_the_thorough_comparer() {
        let exact = half_disc(1);
        let cut = Path::closed(half_disc(3).segments[..3].to_vec());
        let longer = Path::open(half_disc(3).segments.iter().chain(&exact.segments).copied().collect());
        for path in [exact.starting_at(10.0), exact.reversed(), cut, longer] {
            let quick = in_step(&path, &exact, 1e-3);
            assert!(quick.is_none_or(|distance| distance > 1.0), "{quick:?}");
        }
        // Another order is not a finding: it is the file's own.
        let mut findings = Findings::default();
        let turned = [exact.starting_at(10.0)];
        assert!(compare_layer(Layer::CutOutside, &turned, &[exact], 1e-3, &mut findings) < 1e-9);
        assert_eq!(findings.into_vec(), []);
    }
}
