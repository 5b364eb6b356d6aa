//! Reads ASCII DXF drawings (AC1015 or later): tags to layers of lines and arcs.
//!
//! A **tag** is a group code and a value, on two lines. Tags are gathered into **records**, which begin with
//! group code 0; sections are records too.

use std::f64::consts::TAU;

use crate::verify::finding::quote;
use crate::verify::read::number;
use crate::verify::{Drawing, FindingCode, Findings};
use geom::{Arc, Line, Path, Point, Segment};

/// Arcs of a larger radius are read as their chord, mm: at this radius a 1 m chord has a sagitta of a nanometre.
const STRAIGHT: f64 = 1e11;

/// The versions that support LWPOLYLINE with all features used here.
const VERSIONS: [&str; 6] = ["AC1015", "AC1018", "AC1021", "AC1024", "AC1027", "AC1032"];

#[derive(Clone, Copy, Debug)]
struct DxfTag<'a> {
    line: usize,
    code: i32,
    value: &'a str,
}

/// Reads a DXF file.
pub fn read_dxf(text: &str) -> Drawing {
    let mut reader = DxfReader::default();
    let tags = reader.tags(text);
    let mut section = None;
    let mut ended = false;
    // A record runs from its group code 0 to the next.
    let starts: Vec<usize> = (0..tags.len()).filter(|i| tags[*i].code == 0).collect();
    if starts.first() != Some(&0) {
        reader.refuse(1, "no record at the beginning", "0, SECTION");
    }
    for (k, start) in starts.iter().enumerate() {
        let record = &tags[*start..starts.get(k + 1).copied().unwrap_or(tags.len())];
        let Some((head, body)) = record.split_first() else { continue };
        if ended {
            reader.refuse(head.line, "records after EOF", "EOF last");
            break;
        }
        match head.value {
            "SECTION" => {
                section = body.iter().find(|tag| tag.code == 2).map(|tag| tag.value);
                if section == Some("HEADER") {
                    reader.header(body);
                }
            }
            "ENDSEC" => section = None,
            "EOF" => {
                ended = true;
                if section.is_some() {
                    let found = "EOF within a section";
                    reader.findings.add_at(FindingCode::Truncated, head.line, found, "ENDSEC first");
                }
            }
            "LAYER" if section == Some("TABLES") => {
                if let Some(name) = body.iter().find(|tag| tag.code == 2) {
                    let _ = reader.drawing.layers.entry(name.value.to_owned()).or_default();
                }
            }
            _ if section == Some("ENTITIES") => reader.entity(*head, body),
            _ => {}
        }
    }
    if !ended {
        reader.findings.add(FindingCode::Truncated, "no EOF", "0, EOF at the end");
    }
    if !reader.has_version || !reader.has_units {
        reader.findings.add(FindingCode::WrongScale, "no $ACADVER or no $INSUNITS", "both");
    }
    Drawing { findings: reader.findings.into_vec(), ..reader.drawing }
}

#[derive(Default)]
struct DxfReader {
    drawing: Drawing,
    findings: Findings,
    has_version: bool,
    has_units: bool,
}

impl DxfReader {
    fn refuse(&mut self, line: usize, found: impl Into<String>, allowed: &str) {
        self.findings.add_at(FindingCode::BadDxf, line, found, allowed);
    }

    fn tags<'a>(&mut self, text: &'a str) -> Vec<DxfTag<'a>> {
        let mut tags = Vec::new();
        let mut lines = text.lines().enumerate();
        while let Some((i, code)) = lines.next() {
            let Ok(code) = code.trim().parse::<i32>() else {
                self.refuse(i + 1, quote(code), "a group code");
                break;
            };
            let Some((_, value)) = lines.next() else {
                let found = "a group code without a value";
                self.findings.add_at(FindingCode::Truncated, i + 1, found, "pairs of lines");
                break;
            };
            // Comments are allowed anywhere.
            if code != 999 {
                tags.push(DxfTag { line: i + 1, code, value: value.trim() });
            }
        }
        tags
    }

    fn header(&mut self, body: &[DxfTag<'_>]) {
        for pair in body.windows(2) {
            let [name, tag] = pair else { continue };
            match (name.code, name.value) {
                (9, "$ACADVER") => {
                    self.has_version = true;
                    if !VERSIONS.contains(&tag.value) {
                        self.refuse(tag.line, quote(tag.value), "AC1015 or later");
                    }
                }
                (9, "$INSUNITS") => {
                    self.has_units = true;
                    if tag.value != "4" {
                        let found = format!("$INSUNITS {}", quote(tag.value));
                        self.findings.add_at(FindingCode::WrongScale, tag.line, found, "4 (millimetres)");
                    }
                }
                _ => {}
            }
        }
    }

    fn entity(&mut self, head: DxfTag<'_>, body: &[DxfTag<'_>]) {
        let text = |code: i32| body.iter().find(|tag| tag.code == code).map(|tag| tag.value);
        let layer = text(8).unwrap_or("0").to_owned();
        if !self.drawing.layers.contains_key(&layer) {
            self.findings.add_at(FindingCode::UnknownLayer, head.line, quote(&layer), "a layer of the table");
        }
        let extrusion = [(210, "x"), (220, "y"), (230, "z")].map(|(code, _)| text(code).map(number::value));
        if !matches!(extrusion, [None, None, None] | [Some(Some(0.0)), Some(Some(0.0)), Some(Some(1.0))]) {
            self.findings.add_at(FindingCode::Transform, head.line, "another extrusion direction", "0, 0, 1");
        }
        let path = match head.value {
            "LWPOLYLINE" => self.polyline(head, body),
            "LINE" => self
                .numbers(head, body, [10, 20, 11, 21])
                .map(|[a, b, c, d]| Path::open(vec![Line::new(Point::new(a, b), Point::new(c, d)).into()])),
            "CIRCLE" => self
                .numbers(head, body, [10, 20, 40])
                .and_then(|[x, y, r]| self.arc(head, Arc::new(Point::new(x, y), r, 0.0, TAU)))
                .map(Path::closed),
            "ARC" => self.numbers(head, body, [10, 20, 40, 50, 51]).and_then(|[x, y, r, from, to]| {
                let turn = (to - from).rem_euclid(360.0);
                let turn = if turn == 0.0 { 360.0 } else { turn };
                let arc = Arc::new(Point::new(x, y), r, from.to_radians(), turn.to_radians());
                self.arc(head, arc).map(Path::open)
            }),
            "TEXT" => {
                self.drawing.texts.push((layer.clone(), text(1).unwrap_or("").to_owned()));
                None
            }
            other => {
                let allowed = "LWPOLYLINE, LINE, ARC, CIRCLE, TEXT";
                self.findings.add_at(FindingCode::UnknownWord, head.line, quote(other), allowed);
                None
            }
        };
        self.drawing.layer_mut(&layer).extend(path);
    }

    /// The values of group codes that must each be there once.
    fn numbers<const N: usize>(
        &mut self,
        head: DxfTag<'_>,
        body: &[DxfTag<'_>],
        codes: [i32; N],
    ) -> Option<[f64; N]> {
        let mut values = [0.0; N];
        for (value, code) in values.iter_mut().zip(codes) {
            let mut tags = body.iter().filter(|tag| tag.code == code);
            let (Some(tag), None) = (tags.next(), tags.next()) else {
                let found = format!("{} without exactly one group {code}", quote(head.value));
                self.refuse(head.line, found, "each group once");
                return None;
            };
            *value = self.number(*tag)?;
        }
        Some(values)
    }

    fn number(&mut self, tag: DxfTag<'_>) -> Option<f64> {
        let value = number::value(tag.value);
        if value.is_none() {
            let allowed = format!("a number, at most {}", number::LARGEST);
            self.findings.add_at(FindingCode::BadNumber, tag.line + 1, quote(tag.value), allowed);
        }
        value
    }

    fn arc(&mut self, head: DxfTag<'_>, arc: Arc) -> Option<Vec<Segment>> {
        if arc.radius > 0.0 {
            return Some(vec![arc.into()]);
        }
        self.findings.add_at(FindingCode::BadNumber, head.line, format!("radius {}", arc.radius), "> 0");
        None
    }

    fn polyline(&mut self, head: DxfTag<'_>, body: &[DxfTag<'_>]) -> Option<Path> {
        let whole = |code: i32| {
            body.iter().find(|tag| tag.code == code).and_then(|tag| tag.value.parse::<u32>().ok())
        };
        let mut vertices: Vec<(f64, Option<f64>, f64)> = Vec::new();
        for tag in body {
            match (tag.code, vertices.last_mut()) {
                (10, _) => vertices.push((self.number(*tag)?, None, 0.0)),
                (20, Some(last)) => last.1 = Some(self.number(*tag)?),
                (42, Some(last)) => last.2 = self.number(*tag)?,
                (20 | 42, None) => {
                    self.refuse(tag.line, "a group 20 or 42 before 10", "10 first");
                    return None;
                }
                _ => {}
            }
        }
        let points: Option<Vec<(Point, f64)>> =
            vertices.iter().map(|(x, y, bulge)| y.map(|y| (Point::new(*x, y), *bulge))).collect();
        let points = points.filter(|p| p.len() > 1 && whole(90).is_some_and(|n| n as usize == p.len()));
        let (Some(points), Some(flags)) = (points, whole(70)) else {
            let found = format!("{} vertices, {} declared", vertices.len(), whole(90).unwrap_or(0));
            self.refuse(head.line, found, "2 or more whole ones, as many as declared, and flags");
            return None;
        };
        let closed = flags & 1 == 1;
        let next = points.iter().skip(1).chain(points.first().filter(|_| closed));
        let segments = points.iter().zip(next).map(|((a, bulge), (b, _))| {
            match Arc::from_bulge(*a, *b, *bulge).filter(|arc| arc.radius < STRAIGHT) {
                Some(arc) => arc.into(),
                None => Line::new(*a, *b).into(),
            }
        });
        Some(Path { segments: segments.collect(), closed })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use geom::Segment;

    fn dxf(entities: &str) -> String {
        let text = format!(
            "0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 4 0 ENDSEC \
             0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 SEAL 0 LAYER 2 HOLES 0 ENDTAB 0 ENDSEC \
             0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF"
        );
        text.split_whitespace().flat_map(|word| [word, "\n"]).collect()
    }

    fn codes(text: &str) -> Vec<&'static str> {
        read_dxf(text).findings.iter().map(|finding| finding.code).collect()
    }

    #[test]
    fn entities_by_layer() {
        let drawing = read_dxf(&dxf(
            "0 LWPOLYLINE 5 1F 8 SEAL 90 2 70 1 43 0.0 10 0.0 20 0.0 42 1.0 10 10 20 0 42 1.0 \
             0 LWPOLYLINE 8 SEAL 90 3 70 0 10 0 20 0 10 3 20 0 10 3 20 4 \
             0 LINE 8 SEAL 10 0 20 0 11 3 21 4 \
             0 CIRCLE 8 HOLES 10 5 20 5 40 1.5 0 ARC 8 HOLES 10 0 20 0 40 2 50 350 51 10 \
             0 TEXT 8 HOLES 10 0 20 0 40 3 1 UP",
        ));
        assert_eq!(drawing.findings, []);
        let seal = drawing.layer("SEAL");
        assert_eq!(seal.iter().map(|p| p.closed).collect::<Vec<_>>(), [true, false, false]);
        assert!((seal[0].length() - 10.0 * std::f64::consts::PI).abs() < 1e-9);
        assert!(seal[0].area() > 0.0 && seal[0].largest_gap() < 1e-12);
        assert_eq!((seal[1].length(), seal[2].length()), (7.0, 5.0));
        let Segment::Arc(arc) = drawing.layer("HOLES")[1].segments[0] else { panic!() };
        assert!((arc.sweep.to_degrees() - 20.0).abs() < 1e-9);
        assert_eq!(drawing.texts, [("HOLES".to_owned(), "UP".to_owned())]);
    }

    #[test]
    fn bulges_of_any_turn() {
        for degrees in [0.001_f64, 90.0, 170.0, 180.0, 190.0, 350.0] {
            let exact = Arc::new(Point::new(1.0, 2.0), 2000.0, 0.5, degrees.to_radians());
            let (a, b) = (exact.start(), exact.end());
            let text = format!(
                "0 LWPOLYLINE 8 SEAL 90 2 70 0 10 {} 20 {} 42 {} 10 {} 20 {}",
                a.x,
                a.y,
                exact.bulge(),
                b.x,
                b.y
            );
            let drawing = read_dxf(&dxf(&text));
            let found = drawing.layer("SEAL")[0].segments[0];
            assert!(
                (0..=8).all(|i| found
                    .point(f64::from(i) / 8.0)
                    .distance(Segment::from(exact).point(f64::from(i) / 8.0))
                    < 1e-8),
                "{degrees}: {found:?}"
            );
        }
    }

    #[test]
    fn every_seeded_fault_is_found() {
        for (entities, code) in [
            ("0 SPLINE 8 SEAL", "unknown-word"),
            ("0 LINE 8 NOWHERE 10 0 20 0 11 3 21 4", "unknown-layer"),
            ("0 LINE 8 SEAL 10 0 20 0 11 3", "bad-dxf"),
            ("0 LINE 8 SEAL 10 0 20 0 11 nan 21 4", "bad-number"),
            ("0 LINE 8 SEAL 10 0 20 0 11 1e9 21 4", "bad-number"),
            ("0 CIRCLE 8 SEAL 10 0 20 0 40 0", "bad-number"),
            ("0 CIRCLE 8 SEAL 10 0 20 0 40 1 210 0 220 0 230 -1", "transform"),
            ("0 LWPOLYLINE 8 SEAL 90 3 70 0 10 0 20 0 10 1 20 1", "bad-dxf"),
            ("0 LWPOLYLINE 8 SEAL 90 2 70 0 20 0 10 0 10 1 20 1", "bad-dxf"),
            ("0 LWPOLYLINE 8 SEAL 90 2 70 0 10 0 10 1 20 1", "bad-dxf"),
            ("0 LWPOLYLINE 8 SEAL 90 1 70 0 10 0 20 1", "bad-dxf"),
        ] {
            assert_eq!(codes(&dxf(entities)), [code], "{entities}");
        }
        let good = dxf("");
        for (from, to, code) in [
            ("AC1015", "AC1009", "bad-dxf"),
            ("$INSUNITS\n70\n4", "$INSUNITS\n70\n1", "wrong-scale"),
            ("$INSUNITS", "$OTHER", "wrong-scale"),
            ("0\nEOF\n", "", "truncated"),
            ("0\nENDSEC\n0\nEOF\n", "0\nEOF\n", "truncated"),
            ("EOF\n", "EOF\n0\nSECTION\n", "bad-dxf"),
            ("EOF\n", "EOF\n0\n", "truncated"),
            ("0\nSECTION", "x\nSECTION", "bad-dxf"),
        ] {
            assert!(codes(&good.replacen(from, to, 1)).contains(&code), "{from} -> {to}");
        }
    }

    proptest! {
        #[test]
        fn any_text_is_read(text in "\\PC*|([0-9]{1,2}\n(SECTION|ENTITIES|LWPOLYLINE|ARC|EOF|HEADER|1|-1.5|\\PC{0,5})\n){0,40}") {
            let _ = read_dxf(&text);
        }

        #[test]
        fn any_polyline_is_finite(v in proptest::collection::vec((-1e6..1e6, -1e6..1e6, prop_oneof![-1e6..1e6, -1e-9..1e-9]), 2..6)) {
            let body: Vec<String> = v.iter().map(|(x, y, b): &(f64, f64, f64)| format!("10 {x} 20 {y} 42 {b}")).collect();
            let drawing = read_dxf(&dxf(&format!("0 LWPOLYLINE 8 SEAL 90 {} 70 1 {}", v.len(), body.join(" "))));
            prop_assert!(drawing.layer("SEAL").iter().all(|path| path.length().is_finite()));
        }
    }
}
