//! The picture that a page draws by itself, as paths of an SVG: the sheets with their named seams, or a drawing by the roles of its layers.
//!
//! Lengths are mm. Y points down: the origin of a sheet is its upper left corner, that of a drawing is the drawing's own.

use serde_json::{Value, json};
use stargrip_cam::design::{CutEdge, PlacedPart, SheetLayout, roled_figures};
use stargrip_cam::emit::chords;
use stargrip_cam::geom::{Bounds, Path, Point};
use stargrip_cam::pipeline::Forecast;
use stargrip_cam::sealed::Seam;
use stargrip_cam::spec::{LayerRole, Spec};

/// Largest distance between a curve and its picture, mm.
const WITHIN: f64 = 0.02;

/// The point as a picture has it whose upper edge lies at `top`.
fn picture_point(point: Point, top: f64) -> [f64; 2] {
    [point.x, top - point.y].map(|length| (length * 100.0).round() / 100.0 + 0.0)
}

/// `path` in words of an SVG.
fn words(path: &Path, top: f64) -> String {
    let corners: Vec<String> = chords(path, WITHIN)
        .into_iter()
        .map(|point| {
            let [x, y] = picture_point(point, top);
            format!("{x} {y}")
        })
        .collect();
    format!("M{}{}", corners.join("L"), if path.closed { "Z" } else { "" })
}

/// All sheets of a design with their pieces.
pub(super) fn sheets(forecast: &Forecast) -> Value {
    let sheet = |layout: &SheetLayout| {
        let pieces =
            forecast.design.on_sheet(layout.index).map(|placed| piece(forecast, placed, layout.height));
        json!({ "width": layout.width, "height": layout.height, "pieces": pieces.collect::<Vec<_>>() })
    };
    forecast.design.sheets.iter().map(sheet).collect()
}

/// A piece on a sheet that is `top` mm high: cut, air, ports and seams.
fn piece(forecast: &Forecast, placed: &PlacedPart, top: f64) -> Value {
    let part = forecast.design.part(placed);
    let (shape, cut) = (part.shape(), part.cut(CutEdge::Part));
    let lay = |path: &Path| words(&placed.placement.path(path), top);
    let place = |point: Point| picture_point(placed.placement.point(point), top);
    let holes = cut.holes.iter().map(|hole| json!([place(hole.center), hole.diameter]));
    let seams = (1..).zip(&shape.seams).map(|(order, own)| seam(forecast, placed, own, order, top));
    json!({
        "name": placed.name().to_string(),
        "middle": place(part.middle()),
        "cut": std::iter::once(cut.outside).chain(cut.inside).map(lay).collect::<String>(),
        "air": part.tube().iter().chain(cut.valves).map(lay).collect::<String>(),
        "band_mm": shape.band,
        "seams": seams.collect::<Vec<_>>(),
        "ports": shape.ports.iter().map(|port| place(port.at)).collect::<Vec<_>>(),
        "holes": holes.collect::<Vec<_>>(),
    })
}

/// A seam of a piece, the `order`-th that is sealed, with its length and its time (null if no program seals it).
fn seam(forecast: &Forecast, placed: &PlacedPart, seam: &Seam, order: usize, top: f64) -> Value {
    let line = placed.placement.path(&seam.center_line);
    let piece = placed.name();
    let mut reports = forecast.programs.iter().flat_map(|program| &program.seams);
    let report = reports.find(|report| report.name.piece == piece && report.name.seam == seam.name);
    json!({
        "name": seam.name,
        "order": order,
        "path": words(&line, top),
        "start": line.start().map(|point| picture_point(point, top)),
        "middle": line.point_at(0.5 * line.length()).map(|point| picture_point(point, top)),
        "length_mm": line.length(),
        "time_s": report.map(|report| report.time),
    })
}

/// The figures of the drawing of `spec`, each with its names, its role, the process that the spec names for it, and the name that
/// decides this process; null if the spec has none, or the file cannot be read.
pub(super) fn drawing(spec: &Spec) -> Value {
    let figures = roled_figures(spec);
    if figures.is_empty() {
        return Value::Null;
    }
    let bounds = figures.iter().map(|figure| figure.path.bounds()).fold(Bounds::EMPTY, Bounds::union);
    let [x, y] = picture_point(Point::new(bounds.min.x, bounds.max.y), 0.0);
    let figures = figures.iter().map(|figure| {
        let (process_of, process) = figure.process.as_ref().map(|(name, process)| (name, process)).unzip();
        json!({
            "id": figure.id, "layers": figure.layers, "layer": figure.layer,
            "role": figure.role.map(LayerRole::word), "process": process, "process_of": process_of,
            "path": words(&figure.path, 0.0),
        })
    });
    json!({ "box": [x, y, bounds.width(), bounds.height()], "figures": figures.collect::<Vec<_>>() })
}
