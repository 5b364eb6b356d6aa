//! Drawings: shipped stars come back through files of their own edges, and shipped drawings are proven from their directory.

use std::fmt::Write;
use std::fs;
use std::path::Path as File;

use stargrip_cam::answer::overview_json;
use stargrip_cam::artifact::KindRequest;
use stargrip_cam::design::{Design, StarDesign, propose_layers};
use stargrip_cam::geom::{Bounds, Enclosures, Isometry, Path, Point, Segment, Vec2};
use stargrip_cam::pipeline::{Built, Sources, build, prove_files};
use stargrip_cam::sealed::Seam;
use stargrip_cam::spec::{self, LayerRole, Source, Spec};
use stargrip_cam::verify::Finding;

use crate::support;

/// A build of `text` whose drawing is `bytes`.
fn build_drawn(text: &str, bytes: &[u8]) -> Result<Built, stargrip_cam::design::Refusals> {
    let reading = spec::read(&Source::new("drawn", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(bytes).spec;
    let sources = Sources { spec: text, machine: support::generic() };
    build(&spec, &support::machine(), sources, &KindRequest::default())
}

/// In pictures the air reaches through the ports to the cut, and no farther.
#[test]
fn the_air_of_a_picture_is_open_at_its_ports() {
    let dir = File::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    let text = fs::read_to_string(dir.join("hand-rest.toml")).expect("shipped");
    let build = build_drawn(&text, &fs::read(dir.join("hand-rest.svg")).expect("shipped")).expect("makeable");
    let piece = &build.forecast.design.drawn_pieces().expect("a drawing").pieces[0];
    let air = piece.edges.iter().fold(Bounds::EMPTY, |all, edge| all.union(edge.bounds()));
    let (closed, cut) = (piece.air[0].bounds(), piece.part.outside.bounds());
    // A port on the left and one on the right.
    assert!(
        (air.width() - cut.width()).abs() < 1e-6 && air.width() > closed.width() + 1.0,
        "{air:?} {cut:?}"
    );
    assert!((air.height() - closed.height()).abs() < 1e-6, "{air:?} {closed:?}");
}

/// A quarter of a turn at most, so that no arc's centre is lost in rounding.
fn pieces_of(path: &Path) -> Vec<Segment> {
    let cut = |segment: &Segment| -> Vec<Segment> {
        let count = match segment {
            Segment::Arc(arc) if arc.sweep.abs() > 1.6 => (arc.sweep.abs() / 1.5).ceil(),
            _ => 1.0,
        };
        let parts = (0..8).map(f64::from).take_while(|i| *i < count);
        parts.map(|i| segment.part(i / count, (i + 1.0) / count)).collect()
    };
    path.segments.iter().flat_map(cut).collect()
}

fn svg(edges: &[(&str, &Path)], ports: &[Point]) -> String {
    let mut text = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2000mm\" height=\"2000mm\" viewBox=\"-1000 -1000 2000 2000\">\n<g id=\"tube\">\n",
    );
    for (id, path) in edges {
        let start = path.start().expect("a start");
        let _ = write!(text, "<path id=\"{id}\" d=\"M {} {}", start.x, -start.y);
        for piece in pieces_of(path) {
            let to = piece.end();
            let _ = match piece {
                Segment::Line(_) => write!(text, " L {} {}", to.x, -to.y),
                Segment::Arc(arc) => {
                    // With Y down a counterclockwise arc goes by falling angles.
                    let flag = u8::from(arc.sweep < 0.0);
                    write!(text, " A {r} {r} 0 0 {flag} {} {}", to.x, -to.y, r = arc.radius)
                }
            };
        }
        text += if path.closed { " Z\"/>\n" } else { "\"/>\n" };
    }
    text += "</g>\n<g id=\"hose\">\n";
    for at in ports {
        let _ = writeln!(text, "<circle cx=\"{}\" cy=\"{}\" r=\"1\"/>", at.x, -at.y);
    }
    text + "</g>\n</svg>\n"
}

fn dxf(edges: &[(&str, &Path)], ports: &[Point]) -> String {
    let mut text =
        String::from("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n");
    text += "0\nSECTION\n2\nENTITIES\n";
    for (id, path) in edges {
        let pieces = pieces_of(path);
        let last = pieces.last().map(Segment::end).filter(|_| !path.closed);
        let vertices = pieces.len() + usize::from(last.is_some());
        let _ =
            write!(text, "0\nLWPOLYLINE\n5\n{id}\n8\ntube\n90\n{vertices}\n70\n{}\n", u8::from(path.closed));
        for piece in &pieces {
            let _ = write!(text, "10\n{}\n20\n{}\n", piece.start().x, piece.start().y);
            if let Segment::Arc(arc) = piece {
                let _ = write!(text, "42\n{}\n", (arc.sweep / 4.0).tan());
            }
        }
        if let Some(last) = last {
            let _ = write!(text, "10\n{}\n20\n{}\n", last.x, last.y);
        }
    }
    for at in ports {
        let _ = write!(text, "0\nPOINT\n8\nhose\n10\n{}\n20\n{}\n", at.x, at.y);
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

/// A spec of a drawing that is sealed as `star`.
fn of_drawing(star: &Spec, file: &str) -> String {
    let seal = &star.seal;
    let hose = star.inlet.as_ref().expect("an inlet").tube_diameter;
    format!(
        "schema = 1\nname = \"edges\"\n[drawing]\nfile = \"{file}\"\nlayers = {{ air = [\"tube\"], port = [\"hose\"] }}\n\
         [inlet]\ntube_diameter = \"{hose}\"\n[seal]\ntemperature = \"{}\"\nspeed = \"{}\"\nband = \"{}\"\noverlap = \"{}\"\n\
         allowance = \"{}\"\n",
        seal.temperature, seal.speed, seal.band, seal.overlap, seal.allowance
    )
}

/// The largest distance of a place on `a` from `b`.
fn furthest(a: &Path, b: &Path) -> f64 {
    let places = a.segments.iter().flat_map(|segment| (0..=8).map(|i| segment.point(f64::from(i) / 8.0)));
    places.map(|place| b.distance(place)).fold(0.0, f64::max)
}

#[test]
fn shipped_stars_come_back_through_svg_and_dxf() {
    let mut stars = 0;
    let files = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/designs")).expect("designs/");
    for path in files.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file()) {
        let spec = support::read(&fs::read_to_string(&path).expect("a design"));
        let design = Design::new(&spec, &support::machine()).expect("a design");
        for part in &design.assembly().expect("stars").distinct {
            if part.channel.is_none() {
                continue;
            }
            stars += 1;
            let ports: Vec<Point> = part.shape.ports.iter().map(|port| port.at).collect();
            let [inner, outer] = &part.edges;
            for (file, text) in [
                ("edges.svg", svg(&[("inner", inner), ("outer", outer)], &ports)),
                ("edges.dxf", dxf(&[("A1", inner), ("A2", outer)], &ports)),
            ] {
                let name = format!("{} {file}", path.display());
                let back = build_drawn(&of_drawing(&spec, file), text.as_bytes())
                    .unwrap_or_else(|refusals| panic!("{name}: {refusals}"));
                assert_eq!(back.proof().findings, [], "{name}");
                // The page's lower left is the origin of an SVG.
                let shift = if file == "edges.svg" { 1000.0 } else { 0.0 };
                same_seams(part, &back, Vec2::new(shift, shift), (&name, spec.seal.speed.0));
            }
        }
    }
    assert!(stars >= 10, "{stars}");
}

/// Every seam of `part` is one of `back`, as long, and takes as long.
fn same_seams(part: &StarDesign, back: &Built, shift: Vec2, (name, speed): (&str, f64)) {
    let shape = back.forecast.design.part(&back.forecast.design.placed()[0]).shape();
    assert_eq!(shape.seams.len(), part.shape.seams.len(), "{name}");
    for seam in &part.shape.seams {
        let moved_line = Isometry::translation(shift).path(&seam.center_line);
        let is_near = |other: &&Seam| {
            furthest(&moved_line, &other.center_line) < 1e-6
                && furthest(&other.center_line, &moved_line) < 1e-6
        };
        let other = shape.seams.iter().find(is_near);
        let other = other.unwrap_or_else(|| panic!("{name}: no seam like {}", seam.name));
        assert!((other.center_line.length() - seam.center_line.length()).abs() < 1e-6, "{name}");
        let report = back.forecast.programs[0].seams.iter().find(|report| report.name.seam == other.name);
        let report = report.expect("a report");
        let length = seam.run().length();
        assert!((report.length - length).abs() < 1e-6, "{name}: {} mm, {length} mm", report.length);
        let process = support::machine().process;
        let ramp = process.ramp.0.hypot(process.heights.travel.0 - process.heights.contact.0);
        assert!((report.time * speed - length - 2.0 * ramp).abs() < 1e-6, "{name}: {} s", report.time);
    }
}

/// The content of a directory proves it, its drawing included.
#[test]
fn shipped_drawings_are_proven_from_their_directory() {
    let folder = File::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    let mut number = 0;
    for path in fs::read_dir(&folder).expect("drawings").map(|entry| entry.expect("an entry").path()) {
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        number += 1;
        let text = fs::read_to_string(&path).expect("a design");
        let file = spec::read(&Source::new("x", text.as_str()))
            .expect("valid")
            .spec
            .drawing
            .expect("a drawing")
            .file;
        let bytes = fs::read(folder.join(file)).expect("a drawing");
        let result =
            build_drawn(&text, &bytes).unwrap_or_else(|refusals| panic!("{}: {refusals}", path.display()));
        let files = || -> Vec<(String, Vec<u8>)> {
            result.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
        };
        let prove = |files: &[(String, Vec<u8>)]| {
            prove_files(&files.iter().map(|(name, bytes)| (name, bytes)).collect()).findings
        };
        assert_eq!(prove(&files()), [], "{}", path.display());
        // Another drawing in its place is found out: by its hash, and by every file that follows from it.
        let mut other = files();
        let copy = other.iter_mut().find(|(name, _)| name.starts_with("drawing.")).expect("a copy");
        let moved = String::from_utf8(copy.1.clone()).expect("text").replacen("20", "21", 3);
        assert_ne!(copy.1, moved.as_bytes());
        copy.1 = moved.into_bytes();
        assert!(!prove(&other).is_empty(), "{}", path.display());
    }
    assert!(number >= 3, "{number}");
}

/// The report lists repairs, and colours get roles where all lies on one layer.
#[test]
fn repairs_are_told_and_colours_are_layers() {
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"200mm\" viewBox=\"0 0 200 200\"><g id=\"Layer 1\" fill=\"none\">\
        <rect id=\"a\" x=\"20\" y=\"20\" width=\"90\" height=\"60\" stroke=\"blue\"/><rect id=\"b\" x=\"20\" y=\"20\" width=\"90\" height=\"60\" stroke=\"blue\"/>\
        <path id=\"w\" d=\"M60 40V60\" stroke=\"lime\"/><path id=\"h\" d=\"M14 50H26\" stroke=\"red\"/></g></svg>";
    let proposal =
        propose_layers("a.svg", svg.as_bytes(), None).unwrap_or_else(|refusals| panic!("{refusals}"));
    let roles: Vec<(&str, LayerRole)> =
        proposal.layers.iter().map(|(layer, role, _)| (layer.as_str(), *role)).collect();
    let expected = [("#0000ff", LayerRole::Air), ("#00ff00", LayerRole::Seam), ("#ff0000", LayerRole::Port)];
    assert_eq!(roles, expected);
    let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"#0000ff\"]\nseam = [\"#00ff00\"]\n\
        port = [\"#ff0000\"]\n";
    let result = build_drawn(text, svg.as_bytes()).unwrap_or_else(|refusals| panic!("{refusals}"));
    let notes = &overview_json(&result.forecast, &[])["drawing_notes"];
    assert!(
        notes[0]
            .as_str()
            .is_some_and(|note| note.starts_with("a curve drawn twice in 'a' and 'b' merged at X ")),
        "{notes}"
    );
}

/// A DXF without a unit, whose figures lie on one layer, with texts on another.
#[test]
fn colours_texts_and_a_missing_unit_of_a_dxf_are_told() {
    let dxf = "0|SECTION|2|ENTITIES|0|CIRCLE|5|A|8|0|62|5|10|100|20|100|40|50|0|LINE|5|B|8|0|62|1|10|146|20|100|11|154|21|100|\
        0|TEXT|5|C|8|Notes|10|0|20|0|1|cushion|0|ENDSEC|0|EOF|"
        .replace('|', "\n");
    let proposal =
        propose_layers("a.dxf", dxf.as_bytes(), None).unwrap_or_else(|refusals| panic!("{refusals}"));
    let roles: Vec<(&str, LayerRole)> =
        proposal.layers.iter().map(|(layer, role, _)| (layer.as_str(), *role)).collect();
    let expected = [("color 5", LayerRole::Air), ("color 1", LayerRole::Port), ("Notes", LayerRole::Ignore)];
    assert_eq!(roles, expected);
    assert!(
        (proposal.size[0] - 104.0).abs() < 1e-9 && (proposal.size[1] - 100.0).abs() < 1e-9,
        "{:?}",
        proposal.size
    );
    assert!(proposal.no_unit.is_some_and(|finding| finding.contains("$INSUNITS is missing")));
    let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.dxf\"\nunits = \"mm\"\npassage = \"5 mm\"\n[drawing.layers]\n\
        air = [\"color 5\"]\nport = [\"color 1\"]\nignore = [\"Notes\"]\n";
    let result = build_drawn(text, dxf.as_bytes()).unwrap_or_else(|refusals| panic!("{refusals}"));
    let piece = &result.forecast.design.drawn_pieces().expect("a drawing").pieces[0];
    assert_eq!((piece.shape.ports.len(), piece.passage, piece.least_passage), (1, None, 5.0));
}

/// Holes and labels keep off the air, the bands and the cuts, and the holes fit in one position only.
#[test]
fn holes_and_labels_lie_on_the_flap() {
    let folder = File::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    for (name, file) in
        [("bending-finger", "svg"), ("hand-rest", "svg"), ("letters", "svg"), ("pillow", "dxf")]
    {
        let text = fs::read_to_string(folder.join(format!("{name}.toml"))).expect("a design");
        let bytes = fs::read(folder.join(format!("{name}.{file}"))).expect("a drawing");
        let result = build_drawn(&text, &bytes).unwrap_or_else(|refusals| panic!("{name}: {refusals}"));
        assert_eq!(result.forecast.design.warnings, [], "{name}");
        let piece = &result.forecast.design.drawn_pieces().expect("a drawing").pieces[0];
        let (band, air) = (piece.shape.band, Enclosures::new(&piece.edges));
        let clear = |p: Point, from_band: f64, from_cut: f64| {
            let seams = piece.shape.seams.iter().map(|seam| seam.center_line.distance(p) - 0.5 * band);
            let cuts = piece.part.inside.iter().chain([&piece.part.outside]).map(|path| path.distance(p));
            assert!(seams.fold(f64::INFINITY, f64::min) > from_band - 1e-5, "{name}: {p:?} near a band");
            assert!(cuts.fold(f64::INFINITY, f64::min) > from_cut - 1e-5, "{name}: {p:?} near a cut");
            assert!(air.enclosing(p).len().is_multiple_of(2), "{name}: {p:?} on the air");
        };
        let [a, b, c] = piece.registration.as_slice() else { panic!("{name}: three holes") };
        for hole in [a, b, c] {
            clear(hole.center, band + 1.5, 3.0);
        }
        let sides = [a.center.distance(b.center), b.center.distance(c.center), c.center.distance(a.center)];
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            assert!((sides[i] - sides[j]).abs() >= 6.0, "{name}: {sides:?}");
        }
        assert!(piece.labels.warp.is_some(), "{name}");
        for line in piece.labels.strokes.iter().flat_map(|stroke| &stroke.segments) {
            clear(line.point(0.5), 0.3, 0.3);
        }
    }
}

/// The sheet with the valve has a hole that the other one does not have, and each file is held to its own sheet.
#[test]
fn a_valve_is_cut_out_of_one_sheet() {
    let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = { air = [\"air\"], valve = [\"valve\"] }\n\
                [fabric]\nareal_density = \"1 kg/m^2\"\n[cut]\nkerf = \"0.4 mm\"\n";
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"140mm\" height=\"100mm\" viewBox=\"0 0 140 100\">\
        <g id=\"air\"><rect x=\"20\" y=\"20\" width=\"100\" height=\"60\"/></g>\
        <g id=\"valve\"><circle cx=\"70\" cy=\"50\" r=\"3\"/></g></svg>";
    let proposal = propose_layers("a.svg", drawing.as_bytes(), None).expect("layers");
    let roles: Vec<LayerRole> = proposal.layers.iter().map(|(_, role, _)| *role).collect();
    assert_eq!(roles, [LayerRole::Air, LayerRole::Valve]);
    let built = build_drawn(text, drawing.as_bytes()).unwrap_or_else(|refusals| panic!("{refusals}"));
    for ending in ["svg", "dxf"] {
        let [plain, valves] =
            ["", "-valves"].map(|more| text_of(&built, &format!("sheet-1-outline{more}.{ending}")));
        assert!(!plain.contains("cut-valve") && valves.contains("cut-valve"), "{ending}");
        assert!([&plain, &valves].iter().all(|text| text.contains("cut-outside")), "{ending}");
        // The tool runs within the hole.
        assert!(ending != "svg" || valves.contains("A2.8 2.8"), "{valves}");
    }
    // Two sheets, one of them with a hole of 6 mm: 1 g is 1000 mm^2.
    let piece = stargrip_cam::design::FlatPiece::Drawn(
        &built.forecast.design.drawn_pieces().expect("a drawing").pieces[0],
    );
    let outline = 120.0 * 80.0 - (4.0 - std::f64::consts::PI) * 100.0;
    let area = 2.0 * outline - 9.0 * std::f64::consts::PI;
    assert!((piece.fabric() - area).abs() < 1e-6, "{} {area}", piece.fabric());
    assert_eq!(swapped_findings(&built, ["", ""]), []);
    for names in [
        ["sheet-1-outline.svg", "sheet-1-outline-valves.svg"],
        ["sheet-1-outline.dxf", "sheet-1-outline-valves.dxf"],
    ] {
        let findings = swapped_findings(&built, names);
        for name in names {
            assert!(findings.iter().any(|finding| finding.file == name), "{name}: {findings:?}");
        }
    }
}

/// The findings about a build in which the contents of two files are exchanged.
fn swapped_findings(built: &Built, names: [&str; 2]) -> Vec<Finding> {
    let files = built.files().map(|(name, bytes)| {
        let other = names.iter().position(|swapped| *swapped == name).map(|place| names[1 - place]);
        (other.unwrap_or(name), bytes)
    });
    prove_files(&files.collect()).findings
}

/// The text of a file of a build.
fn text_of(built: &Built, name: &str) -> String {
    let bytes = built.files().find(|(file, _)| *file == name).map(|(_, bytes)| bytes.into_owned());
    String::from_utf8(bytes.unwrap_or_else(|| panic!("no {name}"))).expect("text")
}

/// Every fault at once, each with its elements and its place.
#[test]
fn a_faulty_drawing_is_refused_with_elements_and_places() {
    let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = { air = [\"chambr\"], ignore = [\"notes\"] }\n";
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\">\n\
        <g id=\"chamber\"><rect id=\"room\" x=\"10\" y=\"10\" width=\"60\" height=\"60\"/></g>\n\
        <g id=\"notes\"><path id=\"note\" d=\"M 1 1 L 2 2\"/></g>\n</svg>";
    let refusals = build_drawn(text, drawing.as_bytes()).expect_err("a layer has no role");
    let codes: Vec<String> = refusals.iter().map(|refusal| refusal.code.to_string()).collect();
    assert_eq!(codes, ["layer-without-role", "unknown-layer"]);
    let place = refusals[0].drawn.as_ref().expect("a place");
    assert_eq!(place.elements, ["room"]);
    assert!(refusals[1].remedy.contains("chamber"), "{}", refusals[1].remedy);
    // With its role it has no port, which is reported with its place.
    let refusals = build_drawn(&text.replace("chambr", "chamber"), drawing.as_bytes()).expect_err("no port");
    let codes: Vec<String> = refusals.iter().map(|refusal| refusal.code.to_string()).collect();
    assert_eq!(codes, ["chamber-without-port"]);
    assert!(refusals[0].drawn.as_ref().is_some_and(|place| place.at.is_some()));
}

/// The spec of a drawing with further `sections`, read; or its faults.
fn read_with(sections: &str) -> Result<(), String> {
    let text = format!(
        "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = {{ air = [\"a\"] }}\n{sections}\n"
    );
    spec::read(&Source::new("x", text)).map(|_| ()).map_err(|faults| faults.to_string())
}

/// A key without an effect is refused.
#[test]
fn a_drawing_has_no_flap_on_the_hole_side() {
    assert_eq!(read_with("[seal]\nallowance = \"6 mm\""), Ok(()));
    let faults = read_with("[seal]\nhole_allowance = \"6 mm\"").expect_err("no effect");
    assert!(faults.contains("error[conflict]: `hole_allowance` in [seal] beside [drawing]"), "{faults}");
}

/// A drawing may have the files that its spec requests; frames are for stars only.
#[test]
fn a_drawing_has_a_report_and_a_scene_but_no_frame() {
    assert_eq!(read_with("[build]\nwith = [\"report\", \"scene-glb\"]"), Ok(()));
    let faults = read_with("[build]\nwith = [\"report\", \"frame-stl\"]").expect_err("a frame");
    assert!(faults.contains("`with` names \"frame-stl\" beside [drawing]"), "{faults}");
}
