//! Reads DXF drawings by the reader of users' drawings, which shares no code with the writer: its elements as paths by layer, and all that it
//! leaves out, changes or refuses as findings.

use crate::verify::{Drawing, Finding, FindingCode};
use artwork::{Figure, Limits, Options, Place, Weight};

/// Largest deviation of curves that are neither lines nor circular arcs, mm. A file of this tool has none.
const TOLERANCE: f64 = 1e-6;

/// No bound of its own: the size of the file is bounded where its bytes are read.
const UNBOUNDED: usize = usize::MAX / 32;

/// Reads a DXF file in millimetres.
pub fn read_dxf(text: &str) -> Drawing {
    let limits = Limits {
        bytes: UNBOUNDED,
        visits: UNBOUNDED,
        segments: UNBOUNDED,
        text: UNBOUNDED,
        ..Limits::default()
    };
    let mut drawing = Drawing::default();
    let read = match artwork::read_dxf(
        text.as_bytes(),
        &Options { closes: false, limits, ..Options::new(TOLERANCE) },
    ) {
        Ok(read) => read,
        Err(faults) => {
            drawing.findings.extend(faults.into_iter().map(|fault| finding(&fault.place, &fault.text)));
            return drawing;
        }
    };
    if read.unit_mm != 1.0 {
        let unit = format!("a unit of {} mm", read.unit_mm);
        drawing.findings.push(Finding::new(FindingCode::WrongScale, unit, "1 mm"));
    }
    let left_out = read.notes.into_iter().filter(|note| note.weight != Weight::Information);
    let notes = left_out.map(|note| finding(&note.place, &note.text));
    let faults = read.faults.into_iter().map(|fault| finding(&fault.place, &fault.text));
    drawing.findings.extend(faults.chain(notes));
    for element in read.elements {
        // The layer is the last of an entity's own names.
        let layer = element.own_names.checked_sub(1).and_then(|last| element.layers.get(last));
        let paths = drawing.layer_mut(layer.map_or("0", String::as_str));
        if let Figure::Path(path) = element.figure {
            paths.push(path);
        }
    }
    drawing
}

/// The finding of what the reader tells of `place`.
fn finding(place: &Place, text: &str) -> Finding {
    let reason = format!("{:?}", text.trim_end_matches('.'));
    let allowed = "a DXF file of lines and arcs that can all be read";
    match place.line {
        Some(line) => Finding::in_line(FindingCode::BadDxf, line, reason, allowed),
        None => Finding::new(FindingCode::BadDxf, reason, allowed),
    }
}

#[cfg(test)]
mod tests {
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

    #[test]
    fn entities_by_layer() {
        let drawing = read_dxf(&dxf(
            "0 LWPOLYLINE 5 1F 8 SEAL 90 2 70 1 43 0.0 10 0.0 20 0.0 42 1.0 10 10 20 0 42 1.0 \
             0 LWPOLYLINE 8 SEAL 90 3 70 0 10 0 20 0 10 3 20 0 10 3 20 4 \
             0 LWPOLYLINE 8 SEAL 90 4 70 0 10 0 20 0 10 3 20 0 10 3 20 4 10 0 20 0 \
             0 CIRCLE 8 HOLES 10 5 20 5 40 1.5 0 ARC 8 HOLES 10 0 20 0 40 2 50 350 51 10",
        ));
        assert_eq!(
            (&drawing.findings[..], &drawing.order[..]),
            (&[][..], &["SEAL".to_owned(), "HOLES".to_owned()][..])
        );
        let seal = drawing.layer("SEAL");
        assert_eq!(seal.iter().map(|path| path.closed).collect::<Vec<_>>(), [true, false, false]);
        assert!((seal[0].length() - 10.0 * std::f64::consts::PI).abs() < 1e-9);
        assert!(seal[0].area() > 0.0 && seal[0].largest_gap() < 1e-12);
        let Segment::Arc(arc) = drawing.layer("HOLES")[1].segments[0] else { panic!("an arc") };
        assert!((arc.sweep.to_degrees() - 20.0).abs() < 1e-9);
    }

    #[test]
    fn whatever_is_left_out_or_changed_is_found() {
        for (entities, code) in [
            ("0 IMAGE 8 SEAL", "bad-dxf"),
            ("0 TEXT 8 SEAL 10 0 20 0 40 3 1 UP", "bad-dxf"),
            ("0 LINE 8 SEAL 60 1 10 0 20 0 11 3 21 4", "bad-dxf"),
            ("0 LINE 8 SEAL 10 0 20 0 30 1 11 3 21 4 31 2", "bad-dxf"),
            ("0 LINE 8 SEAL 10 0 20 0 11 3", "bad-dxf"),
            ("0 LINE 8 SEAL 10 0 20 0 11 nan 21 4", "bad-dxf"),
            ("0 LINE 8 SEAL 10 0 20 0 11 1e9 21 4", "bad-dxf"),
            ("0 CIRCLE 8 SEAL 10 0 20 0 40 -1", "bad-dxf"),
        ] {
            let codes: Vec<&str> =
                read_dxf(&dxf(entities)).findings.iter().map(|finding| finding.code).collect();
            assert_eq!(codes, [code], "{entities}");
        }
        for (from, to, code) in [
            ("$INSUNITS\n70\n4", "$INSUNITS\n70\n1", "wrong-scale"),
            ("$INSUNITS", "$OTHER", "bad-dxf"),
            ("0\nEOF\n", "", "bad-dxf"),
            ("0\nSECTION", "x\nSECTION", "bad-dxf"),
        ] {
            let text = dxf("").replacen(from, to, 1);
            let codes: Vec<&str> = read_dxf(&text).findings.iter().map(|finding| finding.code).collect();
            assert_eq!(codes, [code], "{from} -> {to}");
        }
    }
}
