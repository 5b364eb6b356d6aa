//! SVG and DXF files against the drawings they should be, and against each other.

use std::f64::consts::PI;

use crate::design::{Drawing as Exact, Layer, Origin, Shape};
use crate::geom::{Arc, Bounds, Path, Point, Segment};
use crate::verify::{Drawing, Finding, FindingCode, Findings, SvgOrigin, deviation, read_dxf, read_svg};

/// Reads an SVG; its page must be the drawing's.
pub(in crate::verify) fn read_page(text: &str, exact: &Exact, findings: &mut Findings) -> Drawing {
    let origin = match exact.origin {
        Origin::LowerLeft => SvgOrigin::LowerLeft,
        Origin::Axis(_) => SvgOrigin::Axis,
    };
    let mut drawing = read_svg(text, origin);
    findings.extend(std::mem::take(&mut drawing.findings));
    within_page(&drawing, exact, findings);
    // Extents are written with as many decimals as coordinates.
    let same = |(w, h): (f64, f64)| (w - exact.width).abs() <= 1e-2 && (h - exact.height).abs() <= 1e-2;
    if !drawing.page.is_some_and(same) {
        let found = drawing.page.map_or("no page".to_owned(), |(w, h)| format!("{w} x {h} mm"));
        findings.add(FindingCode::WrongSize, None, found, format!("{} x {} mm", exact.width, exact.height));
    }
    drawing
}

/// Nothing lies outside the page, where a reader may cut it off.
fn within_page(drawing: &Drawing, exact: &Exact, findings: &mut Findings) {
    let corner = exact.corner();
    let page = Bounds { min: corner, max: Point::new(corner.x + exact.width, corner.y + exact.height) };
    let page = page.grown(1e-3);
    for (layer, paths) in &drawing.layers {
        let bounds = paths.iter().map(Path::bounds).fold(Bounds::EMPTY, Bounds::union);
        let inside = paths.is_empty() || page.contains(bounds.min) && page.contains(bounds.max);
        if !inside {
            findings.add(
                FindingCode::OutsidePage,
                None,
                format!("{bounds:?} on layer {layer}"),
                format!("{page:?}"),
            );
        }
    }
}

/// Reads a DXF.
pub(in crate::verify) fn read_plan(text: &str, findings: &mut Findings) -> Drawing {
    let mut drawing = read_dxf(text);
    findings.extend(std::mem::take(&mut drawing.findings));
    drawing
}

/// Compares what was read with what should be there; the largest deviation either way.
pub(in crate::verify) fn compare(
    found: &Drawing,
    exact: &Exact,
    tolerance: f64,
    findings: &mut Findings,
) -> f64 {
    let mut largest = 0.0_f64;
    for (name, paths) in found.layers.iter().filter(|(_, paths)| !paths.is_empty()) {
        if !exact.layers.iter().any(|(layer, _)| layer.name() == name) {
            let found = format!("{} paths on layer {name}", paths.len());
            findings.add(FindingCode::UnknownLayer, None, found, "only the layers of the drawing");
        }
    }
    for (layer, shapes) in &exact.layers {
        let expected: Vec<Path> = shapes.iter().map(path_of).collect();
        let paths = found.layer(layer.name());
        largest = largest.max(compare_layer(*layer, paths, &expected, tolerance, findings));
    }
    largest
}

fn compare_layer(
    layer: Layer,
    paths: &[Path],
    expected: &[Path],
    tolerance: f64,
    findings: &mut Findings,
) -> f64 {
    let name = layer.name();
    if paths.len() != expected.len() {
        let (found, allowed) = (format!("{} paths on layer {name}", paths.len()), expected.len().to_string());
        findings.add(FindingCode::PathCount, None, found, allowed);
    }
    let closed = |paths: &[Path]| paths.iter().filter(|path| path.closed).count();
    if closed(paths) != closed(expected) {
        let found = format!("{} closed paths on layer {name}", closed(paths));
        findings.add(FindingCode::OpenLoop, None, found, closed(expected).to_string());
    }
    // Rounding moves each vertex by less than a tolerance, so a doubled stretch stands out by far.
    let (length, right) = (total(paths), total(expected));
    let slack: f64 = paths.iter().flat_map(|path| &path.segments).map(|_| tolerance).sum();
    if (length - right).abs() > slack.max(tolerance) {
        let found = format!("{length:.3} mm on layer {name}");
        findings.add(FindingCode::PathLength, None, found, format!("{right:.3} mm"));
    }
    if expected.is_empty() && paths.is_empty() {
        return 0.0;
    }
    let measured =
        one_by_one(paths, expected, tolerance).unwrap_or_else(|| deviation(paths, expected).largest());
    if measured.is_nan() || measured > tolerance {
        findings.add(
            FindingCode::Deviation,
            None,
            format!("{measured:.6} mm on layer {name}"),
            format!("{tolerance} mm"),
        );
    }
    measured
}

/// The largest deviation of any path from the one that stands at its place in the list.
///
/// It is never less than that of all from all. `None` where it is not within the tolerance: files may be in another order.
fn one_by_one(paths: &[Path], expected: &[Path], tolerance: f64) -> Option<f64> {
    if paths.len() != expected.len() {
        return None;
    }
    let mut largest = 0.0_f64;
    for (path, right) in paths.iter().zip(expected) {
        let measured = strokes_apart(path, right)
            .unwrap_or_else(|| deviation(std::slice::from_ref(path), std::slice::from_ref(right)).largest());
        if measured.is_nan() || measured > tolerance {
            return None;
        }
        largest = largest.max(measured);
    }
    Some(largest)
}

/// How far two chains of as many straight lines lie apart: at most what their vertices do, as lines change evenly in between.
fn strokes_apart(path: &Path, right: &Path) -> Option<f64> {
    if path.segments.len() != right.segments.len() {
        return None;
    }
    path.segments.iter().zip(&right.segments).try_fold(0.0_f64, |largest, pair| match pair {
        (Segment::Line(a), Segment::Line(b)) => {
            Some(largest.max(a.start.distance(b.start)).max(a.end.distance(b.end)))
        }
        _ => None,
    })
}

fn total(paths: &[Path]) -> f64 {
    paths.iter().map(Path::length).sum()
}

/// A shape as a path; a circle as two half turns.
pub(in crate::verify) fn path_of(shape: &Shape) -> Path {
    match shape {
        Shape::Path(path) => path.clone(),
        Shape::Circle { center, radius } => Path::closed(vec![
            Arc::new(*center, *radius, 0.0, PI).into(),
            Arc::new(*center, *radius, PI, PI).into(),
        ]),
    }
}

/// What one file holds.
struct Seen {
    sheet: usize,
    file: String,
    /// (layer, number of paths, their length), empty layers left out.
    layers: Vec<(String, usize, f64)>,
}

/// The seal drawings of all formats, to be held against each other.
#[derive(Default)]
pub(in crate::verify) struct Seals {
    seen: Vec<Seen>,
}

impl Seals {
    /// Notes what a file holds.
    pub(in crate::verify) fn add(&mut self, sheet: usize, file: &str, drawing: &Drawing) {
        let layers = drawing.layers.iter().filter(|(_, paths)| !paths.is_empty());
        let layers = layers.map(|(name, paths)| (name.clone(), paths.len(), total(paths))).collect();
        self.seen.push(Seen { sheet, file: file.to_owned(), layers });
    }

    /// Files of the same sheet that hold different things.
    pub(in crate::verify) fn disagreements(&self, tolerance: f64) -> Vec<Finding> {
        let mut findings = Vec::new();
        for (i, Seen { sheet, file, layers }) in self.seen.iter().enumerate() {
            let Some(first) = self.seen[..i].iter().find(|seen| seen.sheet == *sheet) else { continue };
            let Seen { file: other, layers: theirs, .. } = first;
            for (layer, count, length) in layers {
                let twin = theirs.iter().find(|(name, _, _)| name == layer);
                // As much as the rounding of a hundred vertices each could add up to.
                if twin.is_some_and(|(_, c, l)| c == count && (l - length).abs() <= 200.0 * tolerance) {
                    continue;
                }
                let found = format!("{count} paths of {length:.3} mm on layer {layer}");
                let allowed = twin.map_or(format!("none, as in {other}"), |(_, c, l)| {
                    format!("{c} of {l:.3} mm, as in {other}")
                });
                findings.push(Finding::new(FindingCode::FormatsDisagree, None, found, allowed).in_file(file));
            }
        }
        findings
    }
}
