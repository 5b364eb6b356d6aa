//! A heat press: paper instead of programs, for stars and drawings, proven from the files.

use stargrip_cam::artifact::{Format, Kind, KindRequest};
use stargrip_cam::design::{CutEdge, Design, Drawing, Layer, PressPlan, Refusals, Shape};
use stargrip_cam::emit;
use stargrip_cam::geom::{Isometry, Path, Vec2};
use stargrip_cam::pipeline::{self, Built, Sources, read_back};
use stargrip_cam::spec::{self, Machine, Source, Spec};
use stargrip_cam::verify::Finding;

use crate::support::{files_of, replace, reseal};

/// Two equal stars for a press.
const STARS: &str = "schema = 1\nname = \"pressed\"\n[star]\npoints = 5\ninner_radius = \"40 mm\"\n\
    tube_width = \"24 mm\"\ntip_angle = \"30 deg\"\ncorner_radius = \"3 mm\"\n[stack]\ncount = 2\n\
    [seal]\nband = \"4 mm\"\n[machine]\nprofile = \"press\"\n[press]\n";

/// The program's text of a square pouch with an island and a port.
const POUCH: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="140mm" height="120mm" viewBox="0 0 140 120">
<g id="air"><rect x="30" y="20" width="80" height="80"/><circle cx="70" cy="60" r="8"/></g>
<g id="port"><path d="M26 60H34"/></g></svg>"#;

const DRAWN: &str = "schema = 1\nname = \"pouch\"\n[drawing]\nfile = \"pouch.svg\"\n\
    layers = { air = [\"air\"], port = [\"port\"] }\n[sheet]\ncopies = 2\n[machine]\nprofile = \"press\"\n[press]\n";

fn press() -> Machine {
    Machine::builtin("press").expect("built in")
}

fn read(text: &str, drawing: &str) -> Spec {
    let reading = spec::read(&Source::new("test", text)).unwrap_or_else(|faults| panic!("{faults}"));
    reading.with_drawing(drawing.as_bytes()).spec
}

fn built(text: &str, drawing: &str) -> Built {
    let sources = Sources { spec: text, machine: spec::builtin_machine("press").expect("built in") };
    pipeline::build(&read(text, drawing), &press(), sources, &KindRequest::default())
        .unwrap_or_else(|refusals| panic!("{refusals}"))
}

/// The findings in the first sheet of separators after `change` of its layers, with a manifest that agrees.
fn mutated(text: &str, drawing: &str, change: impl Fn(&mut Vec<(Layer, Vec<Shape>)>)) -> Vec<Finding> {
    let build = built(text, drawing);
    let (design, spec) = (&build.forecast.design, &build.forecast.spec);
    let mut paper = Drawing::separators(design, 1, CutEdge::Tool).expect("paper");
    change(&mut paper.layers);
    let name = "paper-1-separator.svg";
    let output = build.artifacts.iter().find(|file| file.name == name).expect("a file").output;
    let svg = emit::svg(&output.title(&spec.name), &paper, spec.accuracy.path, spec.cut.colours);
    let mut files = files_of(&build);
    replace(&mut files, name, svg.into_bytes());
    reseal(&mut files);
    read_back(&files).findings
}

fn has_code(findings: &[Finding], code: &str) -> bool {
    findings.iter().any(|finding| finding.code == code)
}

fn moved(shapes: &mut [Shape], shift: Vec2) {
    for shape in shapes {
        *shape = shape.moved(&Isometry::translation(shift));
    }
}

#[test]
fn a_press_gets_paper_outlines_and_a_plan_but_no_program() {
    for (text, drawing) in [(STARS, ""), (DRAWN, POUCH)] {
        let build = built(text, drawing);
        assert_eq!(read_back(&files_of(&build)).findings, []);
        let kinds: Vec<Kind> = build.artifacts.iter().map(|file| file.output.kind).collect();
        for kind in
            [Kind::SeparatorSvg, Kind::SeparatorDxf, Kind::SeparatorPdf, Kind::PressPlan, Kind::OutlinePdf]
        {
            assert!(kinds.contains(&kind), "{kind}");
        }
        assert!(kinds.iter().all(|kind| kind.format() != Format::Gcode));
        let design = &build.forecast.design;
        let separators: usize = design.papers.iter().map(|paper| paper.separators.len()).sum();
        assert_eq!(separators, 2, "one for each piece");
        assert!(build.manifest.pieces.iter().flat_map(|piece| &piece.seams).all(|seam| seam.time_s == 10.0));
    }
}

/// Paper as it may not be: the finding does not depend on how the right paper is made.
#[test]
fn paper_that_does_not_fit_the_seams_is_found() {
    for (text, drawing) in [(STARS, ""), (DRAWN, POUCH)] {
        let shift = mutated(text, drawing, |layers| {
            layers.iter_mut().skip(2).for_each(|(_, shapes)| moved(shapes, Vec2::new(0.7, 0.3)));
        });
        assert!(has_code(&shift, "narrow-band") && has_code(&shift, "deviation"), "{shift:#?}");
        let filled = mutated(text, drawing, |layers| layers[2].1.clear());
        assert!(has_code(&filled, "narrow-band") && has_code(&filled, "path-count"), "{filled:#?}");
        let partial = mutated(text, drawing, |layers| {
            let _ = layers[3].1.pop();
        });
        assert!(has_code(&partial, "welded-air"), "{partial:#?}");
    }
    // Shrunk: smaller paper lets some of the air weld.
    let shrunk = mutated(DRAWN, POUCH, |layers| {
        for shape in &mut layers[3].1 {
            let Shape::Path(path) = shape else { continue };
            *path = stargrip_cam::sealed::offset_right(path, -0.5).swap_remove(0);
        }
    });
    assert!(has_code(&shrunk, "welded-air"), "{shrunk:#?}");
    // A tongue cut off: the channel welds.
    let cut_off = mutated(DRAWN, POUCH, |layers| {
        for shape in &mut layers[3].1 {
            let bounds = shape.bounds();
            *shape = Shape::Path(Path::rectangle(&stargrip_cam::geom::Bounds {
                min: bounds.min + Vec2::new(bounds.width() - 79.4, 0.0),
                max: bounds.max,
            }));
        }
    });
    assert!(has_code(&cut_off, "welded-air"), "{cut_off:#?}");
    // A second tongue, beside the port.
    let stray = mutated(DRAWN, POUCH, |layers| {
        let bounds = layers[3].1[0].bounds();
        let strip = stargrip_cam::geom::Bounds {
            min: bounds.max - Vec2::new(30.0, 10.0),
            max: bounds.max + Vec2::new(-20.0, 40.0),
        };
        layers[3].1.push(Shape::Path(Path::rectangle(&strip)));
    });
    assert!(has_code(&stray, "stray-paper"), "{stray:#?}");
}

fn stars_on(paper: &str) -> Result<Design, Refusals> {
    Design::new(&read(&format!("{STARS}paper = \"{paper}\"\n"), ""), &press())
}

#[test]
fn separators_are_nested_on_the_users_paper_or_refused_by_name() {
    for (paper, sheets) in [("A3", 2), ("600 mm x 300 mm", 1), ("a3", 2)] {
        let design = stars_on(paper).unwrap_or_else(|refusals| panic!("{refusals}"));
        assert_eq!(design.papers.len(), sheets, "{paper}");
        for sheet in &design.papers {
            let drawing = Drawing::separators(&design, sheet.index, CutEdge::Tool).expect("paper");
            for shape in drawing.layers.iter().flat_map(|(_, shapes)| shapes) {
                let bounds = shape.bounds();
                assert!(bounds.min.x >= 5.0 && bounds.min.y >= 5.0, "{bounds:?}");
                assert!(
                    bounds.max.x <= sheet.width - 5.0 + 1e-6 && bounds.max.y <= sheet.height - 5.0 + 1e-6
                );
            }
        }
    }
    let refusals = stars_on("A4").expect_err("too small");
    let refusal = refusals.iter().next().expect("one");
    assert_eq!(
        (refusal.code.to_string().as_str(), refusal.key.to_string().as_str()),
        ("sheet-too-small", "press.paper")
    );
    assert!(refusal.found.contains("star 1") && refusal.remedy.contains("246.2 x 267 mm"), "{refusal:?}");
    // A press of the user's own needs the section, and the section a press.
    let user_press =
        spec::read_machine(&Source::new("own", "schema = 1\nname = \"own\"\ntool = \"press\"\n"));
    let user_press = user_press.unwrap_or_else(|faults| panic!("{faults}"));
    let code = |text: &str, machine: &Machine| {
        let planned =
            pipeline::Planned::new(read(&text.replace("\"press\"", "\"own.toml\""), ""), machine.clone());
        planned.err().and_then(|refusals| refusals.iter().next().map(|refusal| refusal.code.to_string()))
    };
    assert_eq!(code(STARS, &user_press), None);
    assert_eq!(code(STARS, &Machine::builtin("generic").expect("one")).as_deref(), Some("no-press"));
    assert_eq!(code(&STARS.replace("[press]\n", ""), &user_press).as_deref(), Some("no-press"));
    // The size that is named is enough.
    let size = refusal.remedy.split('"').nth(1).expect("a size").to_owned();
    assert!(stars_on(&size).is_ok(), "{size}");
}

/// One pressing a sheet, and the force on all of it.
#[test]
fn the_plan_tells_the_force_of_the_press() {
    let text = format!(
        "{STARS}pressure = \"0.5 bar\"\ntime = \"12 s\"\n[sheet]\nwidth = \"280 mm\"\nheight = \"300 mm\"\n"
    );
    let spec = read(&text, "");
    let design = Design::new(&spec, &press()).expect("a design");
    let plan = PressPlan::new(&spec, &design).expect("a press");
    assert_eq!((plan.pressings, plan.seconds), (2, 24.0));
    // 50 kPa on 280 mm x 300 mm.
    assert!((plan.force - 4200.0).abs() < 1e-9, "{}", plan.force);
    let lines: Vec<&String> = plan.sections.iter().flat_map(|section| &section.lines).collect();
    for word in ["4.2 kN", "S1", "S2", "12 s", "port 1 at X"] {
        assert!(lines.iter().any(|line| line.contains(word)), "no {word} in {lines:#?}");
    }
}

/// The seams of a star that a file of this program shows, given as a drawing, are the star's own again.
#[test]
fn a_star_comes_back_from_its_own_seal_file() {
    // Another hose than a drawing's default: the port is as wide as the file has it.
    let star = built(&format!("{STARS}[inlet]\ntube_diameter = \"6 mm\"\n"), "");
    for ending in ["svg", "dxf"] {
        let file =
            star.artifacts.iter().find(|file| file.name == format!("sheet-1-seal.{ending}")).expect("a file");
        let text = format!(
            "schema = 1\nname = \"back\"\n[drawing]\nfile = \"seal.{ending}\"\n\
             layers = {{ seam = [\"seal-inner\", \"seal-outer\"] }}\n[seal]\nband = \"4 mm\"\n\
             [machine]\nprofile = \"press\"\n"
        );
        let drawing = String::from_utf8(file.bytes.clone()).expect("text");
        let spec = read(&text, &drawing);
        let design = Design::new(&spec, &press()).unwrap_or_else(|refusals| panic!("{ending}: {refusals}"));
        let (pieces, stars) = (&design.drawn_pieces().expect("drawn").pieces, &star.forecast.design);
        assert_eq!(pieces.len(), 2, "{ending}");
        let part = stars.part(&stars.placed()[0]);
        for piece in pieces {
            assert_eq!((piece.shape.ports.len(), piece.part.inside.len()), (1, 1), "{ending}");
            let [length, right] = [&piece.shape, part.shape()]
                .map(|shape| shape.seams.iter().map(|seam| seam.center_line.length()).sum::<f64>());
            assert!((length - right).abs() < 0.02, "{ending}: {length} mm, not {right}");
            // The cut at the mouth is square in one and round in the other.
            let (area, right) = (piece.part.outside.area(), part.cut(CutEdge::Part).outside.area());
            assert!((area / right - 1.0).abs() < 0.005, "{ending}: {area} mm2, not {right}");
        }
    }
}
