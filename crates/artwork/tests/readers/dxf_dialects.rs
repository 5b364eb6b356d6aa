//! DXF files as drawing programs write them, shortened.

#![expect(clippy::format_push_string, clippy::needless_for_each, reason = "short texts are put together")]

use std::f64::consts::{FRAC_PI_2, PI};

use super::lookup::{element, lost, near, path};
use artwork::{Artwork, Figure, Options, Unit, Weight, read_dxf};
use geom::{Point, Segment};

fn dxf(text: &str) -> Artwork {
    read_dxf(text.as_bytes(), &Options::new(0.01)).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// A DXF file with the given header variables, tables, blocks and entities, from "code value" pairs separated by bars.
fn file(sections: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (name, body) in sections {
        text.push_str(&format!("0|SECTION|2|{name}|{body}|0|ENDSEC|"));
    }
    text.push_str("0|EOF|");
    text.replace('|', "\r\n")
}

const MM: (&str, &str) = ("HEADER", "9|$ACADVER|1|AC1015|9|$INSUNITS|70|     4");

#[test]
fn fusion_360_sketches_with_arcs_circles_and_splines() {
    let drawing = dxf(&file(&[
        ("HEADER", "9|$ACADVER|1|AC1015|9|$INSUNITS|70|5|9|$MEASUREMENT|70|1"),
        (
            "ENTITIES",
            "0|LINE|5|2F|100|AcDbEntity|8|0|100|AcDbLine|10|-1.0|20|0.0|30|0.0|11|1.0|21|0.0|31|0.0\
             |0|ARC|5|30|8|0|100|AcDbCircle|10|1.0|20|1.0|30|0.0|40|1.0|100|AcDbArc|50|270.0|51|90.0\
             |0|CIRCLE|5|31|8|0|10|0.0|20|0.0|30|0.0|40|2.5\
             |0|SPLINE|5|32|8|0|210|0|220|0|230|1|70|8|71|3|72|8|73|4|74|0|42|1e-7|43|1e-7|44|1e-10|40|0|40|0|40|0|40|0|40|1|40|1|40|1|40|1\
             |10|0|20|0|30|0|10|1|20|2|30|0|10|3|20|2|30|0|10|4|20|0|30|0",
        ),
    ]));
    assert_eq!(drawing.unit_mm, 10.0);
    let line = path(&drawing, "LINE 2F");
    assert!(near(line.start().unwrap(), -10.0, 0.0) && near(line.end().unwrap(), 10.0, 0.0));
    let arc = path(&drawing, "ARC 30");
    assert!(near(arc.start().unwrap(), 10.0, 0.0) && near(arc.end().unwrap(), 10.0, 20.0));
    assert!((arc.length() - 10.0 * PI).abs() < 1e-12 && !arc.closed);
    assert!(path(&drawing, "CIRCLE 31").closed);
    let spline = path(&drawing, "SPLINE 32");
    assert!(near(spline.end().unwrap(), 40.0, 0.0) && (spline.bounds().max.y - 15.0).abs() < 0.011);
    assert!(drawing.notes.is_empty(), "{:?}", drawing.notes);
}

#[test]
fn rhino_rational_circles_bulges_and_layers() {
    // A circle as Rhino writes closed curves: a rational quadratic of nine points.
    let w = 0.5_f64.sqrt();
    let ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
    let mut spline = "0|SPLINE|5|4A|8|Weld|70|5|71|2|72|12|73|9|74|0".to_owned();
    [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4].iter().for_each(|k| spline.push_str(&format!("|40|{k}")));
    ring.iter()
        .enumerate()
        .for_each(|(i, _)| spline.push_str(&format!("|41|{}", if i % 2 == 1 { w } else { 1.0 })));
    ring.iter().for_each(|(x, y)| spline.push_str(&format!("|10|{}|20|{}|30|0", 10 * x, 10 * y)));
    let slot =
        "0|LWPOLYLINE|5|4B|8|Cut|90|4|70|1|43|0.0|10|0|20|0|10|30|20|0|42|1|10|30|20|10|10|0|20|10|42|1";
    let drawing = dxf(&file(&[MM, ("ENTITIES", &format!("{spline}|{slot}"))]));
    let circle = path(&drawing, "SPLINE 4A");
    assert!(circle.closed && circle.segments.len() == 4, "{}", circle.segments.len());
    assert!((circle.length() - 20.0 * PI).abs() < 1e-9);
    let slot = path(&drawing, "LWPOLYLINE 4B");
    assert_eq!((slot.segments.len(), slot.closed), (4, true));
    assert!((slot.length() - (60.0 + 10.0 * PI)).abs() < 1e-9 && slot.largest_gap() < 1e-12);
    assert!((slot.bounds().max.x - 35.0).abs() < 1e-12);
    assert_eq!(element(&drawing, "LWPOLYLINE 4B").layers, ["Cut"]);
    // Characters outside of the code page.
    let text = "0|LINE|5|4C|8|K\\U+00F6rper \\U+4E2D\\U+|10|0|20|0|11|9|21|0";
    let drawing = dxf(&file(&[MM, ("ENTITIES", text)]));
    assert_eq!(element(&drawing, "LINE 4C").layers, ["K\u{f6}rper \u{4e2d}\\U+"]);
}

#[test]
fn librecad_layers_off_blocks_and_ellipses() {
    let tables = "0|TABLE|2|LAYER|70|3|0|LAYER|5|10|2|0|70|0|62|7|0|LAYER|5|11|2|Hidden|70|0|62|-3|0|LAYER|5|12|2|Ice|70|1|62|3|0|ENDTAB";
    let blocks = "0|BLOCK|5|20|8|0|2|part|70|0|10|5|20|0|30|0|3|part|1||0|CIRCLE|5|21|8|0|10|5|20|0|40|1\
                  |0|LINE|5|22|8|edge|10|5|20|0|11|6|21|0|0|ENDBLK|5|23|8|0";
    let entities = "0|INSERT|5|30|8|weld|2|PART|10|100|20|50|30|0|41|2|42|3|50|90\
                    |0|INSERT|5|31|8|row|2|part|10|0|20|0|70|3|71|2|44|10|45|20\
                    |0|LINE|5|32|8|Hidden|10|0|20|0|11|1|21|1\
                    |0|INSERT|5|33|8|ice|2|part|10|0|20|0\
                    |0|ELLIPSE|5|34|8|0|10|0|20|0|30|0|11|0|21|20|31|0|40|0.5|41|0|42|3.141592653589793\
                    |0|TEXT|5|35|8|notes|10|7|20|8|40|2.5|1|inlet\
                    |0|POINT|5|36|8|port|10|3|20|4|30|0";
    let drawing = dxf(&file(&[MM, ("TABLES", tables), ("BLOCKS", blocks), ("ENTITIES", entities)]));
    // Scaled by 2 and 3, turned by 90 deg, with its base point (5, 0) at (100, 50): an ellipse.
    let ellipse = path(&drawing, "INSERT 30 > CIRCLE 21");
    assert!(ellipse.closed && ellipse.segments.len() > 8);
    let bounds = ellipse.bounds();
    assert!((bounds.min.x - 97.0).abs() < 0.011 && (bounds.max.y - 52.0).abs() < 0.011, "{bounds:?}");
    assert_eq!(element(&drawing, "INSERT 30 > CIRCLE 21").layers, ["weld"]);
    assert_eq!(element(&drawing, "INSERT 30 > LINE 22").layers, ["edge", "weld"]);
    assert!(near(path(&drawing, "INSERT 30 > LINE 22").end().unwrap(), 100.0, 52.0));
    let copy = path(&drawing, "INSERT 31[3,2] > CIRCLE 21");
    assert!(near(copy.start().unwrap(), 21.0, 20.0) && copy.segments.len() == 1);
    assert_eq!(drawing.elements.len(), 2 + 12 + 2);
    // A half ellipse with its major axis along y: it goes to the left.
    let half = path(&drawing, "ELLIPSE 34");
    assert!(near(half.start().unwrap(), 0.0, 20.0) && near(half.end().unwrap(), 0.0, -20.0));
    assert!((half.bounds().min.x + 10.0).abs() < 0.011 && half.bounds().max.x < 0.011);
    assert!(matches!(element(&drawing, "POINT 36").figure, Figure::Point(p) if p == Point::new(3.0, 4.0)));
    let [(id, text)] = &lost(&drawing)[..] else { panic!("{:?}", drawing.notes) };
    assert!(id == "TEXT 35" && text.contains("Texts"));
    let text = drawing.notes.iter().find(|note| note.weight == Weight::Annotation).expect("a note");
    assert_eq!(
        (text.place.at, &text.place.layers[..]),
        (Some(Point::new(7.0, 8.0)), &["notes".to_owned()][..])
    );
    let hidden: Vec<_> = drawing.notes.iter().filter_map(|note| note.place.element.as_deref()).collect();
    assert_eq!(hidden, ["LINE 32", "INSERT 33", "TEXT 35"]);
}

#[test]
fn freecad_r12_polylines_without_a_unit() {
    let text = file(&[
        ("HEADER", "9|$ACADVER|1|AC1009"),
        (
            "ENTITIES",
            "0|POLYLINE|8|none|66|1|70|1|0|VERTEX|8|none|10|0.0|20|0.0|0|VERTEX|8|none|10|10.0|20|0.0|42|1.0\
             |0|VERTEX|8|none|10|10.0|20|10.0|0|VERTEX|8|none|10|0.0|20|10.0|0|SEQEND",
        ),
    ]);
    let faults = read_dxf(text.as_bytes(), &Options::new(0.01)).expect_err("no unit");
    assert!(faults[0].text.contains("$INSUNITS") && faults[0].remedy.contains("mm"), "{faults:?}");
    for (code, what) in [
        ("0", "The file has no unit"),
        ("7", "The file's unit is not read"),
        ("12", "The file's unit is not read"),
    ] {
        let head = format!("9|$ACADVER|1|AC1015|9|$INSUNITS|70|{code}");
        let text = file(&[("HEADER", &head), ("ENTITIES", "0|LINE|8|0|10|0|20|0|11|9|21|0")]);
        let faults = read_dxf(text.as_bytes(), &Options::new(0.01)).expect_err("no unit");
        assert!(faults[0].text.starts_with(&format!("{what}: $INSUNITS is {code}")), "{faults:?}");
    }
    let options = Options { unit: Some(Unit::Inch), ..Options::new(0.01) };
    let drawing = read_dxf(text.as_bytes(), &options).expect("a drawing");
    let outline = path(&drawing, "POLYLINE at line 15");
    assert!(outline.closed && (outline.length() / 25.4 - (30.0 + 5.0 * PI)).abs() < 1e-9);
}

#[test]
fn qcad_mirrored_planes_and_heights() {
    let entities = "0|ARC|5|1|8|a|10|-10|20|0|30|0|40|5|50|0|51|90|210|0|220|0|230|-1\
                    |0|LWPOLYLINE|5|2|8|a|90|2|70|0|38|3.5|10|-1|20|0|42|0.5|10|-2|20|0|210|0|220|0|230|-1\
                    |0|ELLIPSE|5|3|8|a|10|10|20|0|30|0|11|5|21|0|31|0|40|1|41|0|42|1.5707963267948966|210|0|220|0|230|-1\
                    |0|LINE|5|4|8|a|10|0|20|0|30|0|11|1|21|0|31|2|210|0|220|0|230|-1\
                    |0|CIRCLE|5|5|8|a|10|0|20|0|40|1|210|1|220|0|230|0";
    let drawing = dxf(&file(&[MM, ("ENTITIES", entities)]));
    let arc = path(&drawing, "ARC 1");
    assert!(near(arc.start().unwrap(), 5.0, 0.0) && near(arc.end().unwrap(), 10.0, 5.0));
    let [Segment::Arc(arc)] = arc.segments[..] else { panic!("an arc") };
    assert!(near(arc.center, 10.0, 0.0) && (arc.sweep + FRAC_PI_2).abs() < 1e-12);
    // In its own plane it goes left and bulges to its right side, up; mirrored in x it goes right, and up still.
    let bulge = path(&drawing, "LWPOLYLINE 2");
    assert!(near(bulge.start().unwrap(), 1.0, 0.0) && near(bulge.end().unwrap(), 2.0, 0.0));
    let bounds = bulge.bounds();
    assert!((bounds.max.y - 0.25).abs() < 1e-12 && bounds.min.y.abs() < 1e-12, "{bounds:?}");
    // The centre of an ellipse is in world coordinates; it turns clockwise from its major axis.
    let ellipse = path(&drawing, "ELLIPSE 3");
    assert!(near(ellipse.start().unwrap(), 15.0, 0.0) && near(ellipse.end().unwrap(), 10.0, -5.0));
    assert_eq!(ellipse.segments.len(), 1);
    let found = lost(&drawing);
    assert_eq!(found.iter().map(|row| row.0.as_str()).collect::<Vec<_>>(), ["LINE 4", "CIRCLE 5"]);
    assert!(drawing.notes.iter().any(|note| note.text.contains("z = 3.5")), "{:?}", drawing.notes);
}

#[test]
fn ezdxf_metres_fit_points_and_paper_space() {
    let entities = "0|SPLINE|5|2F|330|1F|100|AcDbEntity|8|0|100|AcDbSpline|70|1024|71|3|72|0|73|0|74|4|42|1e-9|43|1e-10|44|1e-10\
                    |11|0|21|0|31|0|11|0.01|21|0.01|31|0|11|0.02|21|0|31|0|11|0.03|21|0.01|31|0\
                    |0|MTEXT|5|30|8|0|67|1|10|0|20|0|30|0|1|hello\
                    |0|HATCH|5|31|8|fill|10|0|20|0|30|0|1001|ACAD|1010|0|1020|0|1030|0";
    let drawing = dxf(&file(&[("HEADER", "9|$ACADVER|1|AC1024|9|$INSUNITS|70|6"), ("ENTITIES", entities)]));
    assert_eq!(drawing.unit_mm, 1000.0);
    let spline = path(&drawing, "SPLINE 2F");
    let gap =
        |x, y| spline.segments.iter().map(|s| s.distance(Point::new(x, y))).fold(f64::INFINITY, f64::min);
    for (x, y) in [(0.0, 0.0), (10.0, 10.0), (20.0, 0.0), (30.0, 10.0)] {
        assert!(gap(x, y) < 0.01, "{x}, {y}");
    }
    assert_eq!(lost(&drawing).iter().map(|row| row.0.as_str()).collect::<Vec<_>>(), ["HATCH 31"]);
}

/// The places of a hatch and of a polyline are points of theirs, not their heights.
#[test]
fn hatches_and_polylines_have_places() {
    let text = "0|SECTION|2|HEADER|9|$INSUNITS|70|4|0|ENDSEC|0|SECTION|2|ENTITIES|\
        0|HATCH|5|A|8|L|10|0|20|0|30|0|2|SOLID|70|1|91|1|92|2|10|7|20|8|\
        0|POLYLINE|5|B|8|L|10|0|20|0|0|VERTEX|10|3|20|4|30|0|0|VERTEX|10|5|20|4|30|5|0|SEQEND|0|ENDSEC|0|EOF|";
    let drawing = dxf(&text.replace('|', "\n"));
    let places: Vec<_> = drawing.notes.iter().map(|note| (note.weight, note.place.at)).collect();
    let at = |x, y| Some(Point::new(x, y));
    assert_eq!(places, [(Weight::Annotation, at(7.0, 8.0)), (Weight::Changed, at(3.0, 4.0))]);
    assert_eq!(drawing.notes[1].text, "It is not flat (z 0 to 5); it is read as if z were 0.");
    assert_eq!(drawing.elements[0].own_names, 1);
}
