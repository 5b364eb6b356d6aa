//! DXF drawings (AC1015, millimetres): a polyline with bulges for every path, a layer for every purpose.
//!
//! The constant parts of a drawing are in `templates/drawing.dxf`; this room fills in layers and entities.

use crate::emit::palette::ink;
use design::{Drawing, Layer, Shape};
use geom::{Path, Point, Segment, Vec2};
use program::number::Decimals;
use program::text::filled;
use spec::Colours;
use spec::units::Length;

const SKELETON: &str = include_str!("../../templates/drawing.dxf");

/// First handle that the skeleton leaves free.
const FIRST_HANDLE: u32 = 0x100;

/// Bulges are pure numbers; with nine decimals an arc with a chord of 4 m is off by 1e-6 mm at most.
const BULGE: u32 = 9;

/// The drawing as a DXF document.
pub fn dxf(drawing: &Drawing, path: Length, colours: Colours) -> String {
    let mut writer =
        DxfWriter { decimals: Decimals::for_tolerance(path), handle: FIRST_HANDLE, out: String::new() };
    for (layer, _) in &drawing.layers {
        writer.layer(*layer, ink(*layer, colours).dxf);
    }
    let layers = std::mem::take(&mut writer.out);
    for (layer, shapes) in &drawing.layers {
        for shape in shapes {
            match shape {
                Shape::Path(path) => writer.polyline(*layer, path),
                Shape::Circle { center, radius } => writer.circle(*layer, *center, *radius),
                // A polyline cannot lift the pen.
                Shape::Figure(paths) => paths.iter().for_each(|path| writer.polyline(*layer, path)),
            }
        }
    }
    let corner = drawing.corner();
    let (high, middle) = (
        corner + Vec2::new(drawing.width, drawing.height),
        corner + Vec2::new(drawing.width / 2.0, drawing.height / 2.0),
    );
    let numbers = [corner.x, corner.y, high.x, high.y, drawing.height, middle.x, middle.y];
    let [min_x, min_y, max_x, max_y, height, center_x, center_y] =
        numbers.map(|number| writer.decimals.text(number));
    filled(
        SKELETON,
        ["@", "@"],
        &[
            ("HANDSEED", &format!("{:X}", writer.handle)),
            ("MIN_X", &min_x),
            ("MIN_Y", &min_y),
            ("MAX_X", &max_x),
            ("MAX_Y", &max_y),
            ("HEIGHT", &height),
            ("CENTER_X", &center_x),
            ("CENTER_Y", &center_y),
            ("LAYER_COUNT", &(drawing.layers.len() + 1).to_string()),
            ("LAYERS", &layers),
            ("ENTITIES", &writer.out),
        ],
    )
}

struct DxfWriter {
    decimals: Decimals,
    handle: u32,
    out: String,
}

impl DxfWriter {
    /// A group code, right in three columns, and its value.
    fn tag(&mut self, code: &str, value: &str) {
        self.out.push_str(code);
        self.out.push('\n');
        self.out.push_str(value);
        self.out.push('\n');
    }

    fn number(&mut self, code: &str, value: f64) {
        self.out.push_str(code);
        self.out.push('\n');
        self.decimals.write(&mut self.out, value);
        self.out.push('\n');
    }

    /// Begins an object with a handle of its own; `owner` is the skeleton's handle of its container.
    fn begin(&mut self, kind: &str, owner: &str) {
        self.tag("  0", kind);
        let handle = format!("{:X}", self.handle);
        self.handle += 1;
        self.tag("  5", &handle);
        self.tag("330", owner);
    }

    fn layer(&mut self, layer: Layer, color: &str) {
        self.begin("LAYER", "2");
        self.tag("100", "AcDbSymbolTableRecord");
        self.tag("100", "AcDbLayerTableRecord");
        self.tag("  2", layer.name());
        self.tag(" 70", "0");
        self.tag(" 62", color);
        self.tag("  6", "Continuous");
        self.tag("390", "F");
    }

    fn entity(&mut self, kind: &str, layer: Layer, class: &str) {
        self.begin(kind, "1F");
        self.tag("100", "AcDbEntity");
        self.tag("  8", layer.name());
        self.tag("100", class);
    }

    fn circle(&mut self, layer: Layer, center: Point, radius: f64) {
        self.entity("CIRCLE", layer, "AcDbCircle");
        self.vertex(center);
        self.tag(" 30", "0");
        self.number(" 40", radius);
    }

    fn polyline(&mut self, layer: Layer, path: &Path) {
        self.entity("LWPOLYLINE", layer, "AcDbPolyline");
        let segments: Vec<Segment> = path.segments.iter().flat_map(halved).collect();
        let open_end = path.end().filter(|_| !path.closed);
        self.tag(" 90", &(segments.len() + usize::from(open_end.is_some())).to_string());
        self.tag(" 70", if path.closed { "1" } else { "0" });
        for segment in segments {
            self.vertex(segment.start());
            if let Segment::Arc(arc) = segment {
                self.tag(" 42", &Decimals::exactly(BULGE).text(arc.bulge()));
            }
        }
        if let Some(end) = open_end {
            self.vertex(end);
        }
    }

    fn vertex(&mut self, p: Point) {
        self.number(" 10", p.x);
        self.number(" 20", p.y);
    }
}

/// The segment, in halves if it turns by more than 180 degrees: a large arc over a short chord magnifies the
/// rounding of the chord's ends.
fn halved(segment: &Segment) -> impl Iterator<Item = Segment> {
    let (first, second) = match segment {
        Segment::Arc(arc) if arc.sweep.abs() > std::f64::consts::PI => {
            (segment.part(0.0, 0.5), Some(segment.part(0.5, 1.0)))
        }
        _ => (*segment, None),
    };
    std::iter::once(first).chain(second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use design::Origin;

    /// A name in the skeleton without a value would leave a line empty, which only strict readers notice.
    #[test]
    fn every_number_is_there() {
        let drawing = Drawing {
            origin: Origin::Axis(Point::new(-3.0, -4.0)),
            width: 6.0,
            height: 8.0,
            layers: vec![(Layer::PostHole, vec![Shape::Circle { center: Point::ORIGIN, radius: 1.0 }])],
        };
        let text = dxf(&drawing, Length(0.001), Colours::One);
        let lines: Vec<&str> = text.lines().collect();
        assert!(!text.contains('@') && lines.len().is_multiple_of(2));
        for pair in lines.chunks_exact(2) {
            let code: u32 = pair[0].trim().parse().expect("a group code");
            if (10..60).contains(&code) || (140..148).contains(&code) {
                assert!(pair[1].parse::<f64>().is_ok(), "{pair:?}");
            }
        }
        assert!(text.contains("$EXTMIN\n 10\n-3\n 20\n-4\n"));
    }
}
