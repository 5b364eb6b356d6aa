//! The preview as a person sees it: every label can be read, and nothing lies beneath it that matters.

use std::fs;
use std::path::Path as File;

use proptest::prelude::*;
use roxmltree::{Document, Node};

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::Design;
use stargrip_cam::geom::{Bounds, Line, Path, Point, Segment, segment_distance};
use stargrip_cam::pipeline::{Built, Sources, build};
use stargrip_cam::spec::{self, Machine, Source};

use crate::readers::png::read_png;

use crate::support;

/// The face of the pictures; other faces are no wider.
const FACE: &[u8] = include_bytes!("../../templates/font/DejaVuSans-ASCII.ttf");

/// A word of the picture and its box, in the sheet's frame.
#[derive(Debug)]
struct Word {
    text: String,
    size: f64,
    bounds: Bounds,
}

fn built(text: &str, profile: &str) -> Built {
    let machine = Machine::builtin(profile).expect("built in");
    let sources = Sources { spec: text, machine: spec::builtin_machine(profile).expect("built in") };
    let spec = spec::read(&Source::new("spec", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
    let request = KindRequest { only: vec![Kind::PreviewSvg], with: vec![Kind::PreviewPng] };
    build(&spec, &machine, sources, &request).unwrap_or_else(|refusals| panic!("{refusals:?}"))
}

/// Every sheet's number and picture.
fn pictures(build: &Built) -> Vec<(usize, String)> {
    let files = build.artifacts.iter().filter(|file| file.output.kind == Kind::PreviewSvg);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
    files.map(|file| (file.output.part.sheet().expect("a sheet"), text(&file.bytes))).collect()
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{name} of {node:?}"))
}

/// The words of a picture whose sheet is `height` high.
fn words_of(picture: &str, height: f64) -> Vec<Word> {
    let face = ttf_parser::Face::parse(FACE, 0).expect("a face");
    let advance = |c: char| {
        let glyph = face.glyph_index(c).unwrap_or_else(|| panic!("{c:?} is not in the face"));
        f64::from(face.glyph_hor_advance(glyph).expect("a width")) / f64::from(face.units_per_em())
    };
    let document = Document::parse(picture).expect("XML");
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    texts
        .map(|node| {
            let text = node.text().unwrap_or("").to_owned();
            let size = number(node, "font-size");
            let width = size * text.chars().map(advance).sum::<f64>();
            let offset = match node.attribute("text-anchor") {
                Some("start") => 0.0,
                Some("middle") => 0.5 * width,
                _ => width,
            };
            let (x, y) = (number(node, "x") - offset, height - number(node, "y"));
            // From the lowest of g and y to the highest of l and d.
            let bounds =
                Bounds { min: Point::new(x, y - 0.236 * size), max: Point::new(x + width, y + 0.76 * size) };
            Word { text, size, bounds }
        })
        .collect()
}

/// Smallest distance between a box and a path; 0 if they share a point.
fn distance(bounds: &Bounds, path: &Path) -> f64 {
    let (a, c) = (bounds.min, bounds.max);
    let (b, d) = (Point::new(c.x, a.y), Point::new(a.x, c.y));
    let sides = [(a, b), (b, c), (c, d), (d, a)].map(|(from, to)| Segment::Line(Line::new(from, to)));
    if path.segments.iter().any(|segment| bounds.contains(segment.start())) {
        return 0.0;
    }
    let distances =
        path.segments.iter().flat_map(|s| sides.iter().map(move |side| segment_distance(side, s)));
    distances.fold(f64::INFINITY, f64::min)
}

/// Everything that is wrong with the labels of the pictures of a build.
fn faults(build: &Built) -> Vec<String> {
    let design: &Design = &build.forecast.design;
    let mut list = Vec::new();
    for (sheet, picture) in pictures(build) {
        let layout = design.sheets.iter().find(|layout| layout.index == sheet).expect("a sheet");
        let words = words_of(&picture, layout.height);
        let page = page_of(&picture, layout.height).outset(0.02);
        for (i, word) in words.iter().enumerate() {
            if !page.contains(word.bounds.min) || !page.contains(word.bounds.max) {
                list.push(format!("{:?} leaves the page", word.text));
            }
            for other in &words[..i] {
                if word.bounds.overlaps(&other.bounds) {
                    list.push(format!("{:?} covers {:?}", word.text, other.text));
                }
            }
            for star in design.on_sheet(sheet) {
                let part = design.assembly().expect("stars").part(star);
                for seam in &part.shape.seams {
                    if distance(&word.bounds, &star.placement.path(&seam.center_line))
                        <= 0.5 * part.shape.band - 0.01
                    {
                        list.push(format!("{:?} lies on a band of star {}", word.text, star.index));
                    }
                }
                let mouth =
                    part.channel.map(|channel| star.placement.point(channel.mouth_center(&part.star)));
                if mouth.is_some_and(|mouth| word.bounds.contains(mouth)) {
                    list.push(format!("{:?} covers the inlet of star {}", word.text, star.index));
                }
            }
        }
    }
    list
}

/// The area of the picture, in the frame of its sheet.
fn page_of(picture: &str, height: f64) -> Bounds {
    let document = Document::parse(picture).expect("XML");
    let view = document.root_element().attribute("viewBox").expect("a view");
    let view: Vec<f64> = view.split(' ').map(|number| number.parse().expect("a number")).collect();
    let min = Point::new(view[0], height - view[1] - view[3]);
    Bounds { min, max: Point::new(view[0] + view[2], height - view[1]) }
}

fn designs() -> Vec<(String, String)> {
    let root = File::new(env!("CARGO_MANIFEST_DIR"));
    let shipped = fs::read_dir(root.join("designs")).expect("designs/");
    let mut paths: Vec<_> =
        shipped.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file()).collect();
    paths.push(root.join("tests/golden/every-feature.toml"));
    paths.sort();
    paths.iter().map(|path| (path.display().to_string(), fs::read_to_string(path).expect("text"))).collect()
}

#[test]
fn no_label_of_a_shipped_design_covers_another_a_band_or_the_inlet() {
    for (name, text) in designs() {
        let profile = support::read(&text).machine.profile;
        let build = built(&text, &profile);
        assert_eq!(faults(&build), Vec::<String>::new(), "{name}");
        let (_, picture) = pictures(&build).swap_remove(0);
        let words = words_of(&picture, build.forecast.design.sheets[0].height);
        let has_word = |word: &str| {
            words.iter().any(|other| {
                other.text == word || word == "sealed band" && other.text.starts_with("band of process ")
            })
        };
        for word in
            ["X0 Y0", "X", "Y", "star 1", "this side up", "inlet", "tube", "sealed band", "flap", "plate 1"]
        {
            assert!(has_word(word), "{name} does not say {word:?}");
        }
        let star = &build.forecast.design.assembly().expect("stars").distinct[0].star;
        for k in 1..=star.n {
            let has_names = has_word(&format!("tip {k}")) && has_word(&format!("corner {k}"));
            assert!(has_names || has_word(&format!("T{k}")) && has_word(&format!("C{k}")), "{name}: {k}");
        }
        let layout = &build.forecast.design.sheets[0];
        assert!(has_word(&format!("{} mm", stargrip_cam::units::Readable(layout.width))), "{name}");
        // On a screen of 1500 pixels nothing is below 7 of them.
        let pixels = 1500.0 / page_of(&picture, layout.height).width();
        let smallest = words.iter().min_by(|a, b| a.size.total_cmp(&b.size)).expect("words");
        assert!(
            smallest.size * pixels > 5.0,
            "{name}: {:?} is {} pixels high",
            smallest.text,
            smallest.size * pixels
        );
    }
}

/// Equal stars lie upon each other in the stack: they have one label there, with all of their numbers.
#[test]
fn equal_stars_are_numbered_apart() {
    let gripper =
        fs::read_to_string(File::new(env!("CARGO_MANIFEST_DIR")).join("designs/paper-gripper.toml"));
    let build = built(&gripper.expect("a design"), "generic");
    let (_, picture) = pictures(&build).swap_remove(0);
    let words = words_of(&picture, build.forecast.design.sheets[0].height);
    let times = |word: &str| words.iter().filter(|other| other.text == word).count();
    assert!(times("stars 1, 2, 3") == 1, "{words:?}");
    // On the sheet, and from the side.
    assert_eq!([times("star 1"), times("star 2"), times("star 3")], [2, 2, 2], "{words:?}");
}

#[test]
fn clamps_work_area_object_and_the_closed_star_are_shown() {
    let profile = spec::builtin_machine("generic").expect("built in");
    let profile = profile.replace("x = \"unknown\"\ny = \"unknown\"", "x = \"345 mm\"\ny = \"900 mm\"")
        + "\n[[keep_out]]\nname = \"left clamp of oak, 40 x 30\"\nx = \"352 mm\"\ny = \"150 mm\"\nwidth = \"40 mm\"\ndepth = \"30 mm\"\n";
    let text = format!("{}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\n", support::PAPER);
    let text = text.replace("[load]", "\n[sheet]\nwidth = \"420 mm\"\n\n[load]");
    let machine =
        spec::read_machine(&Source::new("machine", &profile)).unwrap_or_else(|faults| panic!("{faults}"));
    let sources = Sources { spec: &text, machine: &profile };
    let build = build(&support::read(&text), &machine, sources, &KindRequest::default()).expect("a gripper");
    assert_eq!(faults(&build), Vec::<String>::new());
    let (_, picture) = pictures(&build).swap_remove(0);
    let words = words_of(&picture, build.forecast.design.sheets[0].height);
    let has_word = |word: &str| words.iter().any(|other| other.text.contains(word));
    for word in [
        "left clamp of oak, 40 x 30",
        "clamp",
        "end of the work area",
        "work area 345 x 900 mm",
        "object, 60 mm across",
    ] {
        assert!(has_word(word), "{word}: {words:?}");
    }
    assert!(has_word("shut on the object: 60.0 mm across") && has_word("sealed twice"), "{words:?}");
}

/// The colours of a preview, as docs/pictures.md lists them.
const TUBE: [u8; 3] = [0x9c, 0xc3, 0xe6];
const BAND: [u8; 3] = [0xe8, 0xa3, 0x3d];

/// The colour of the band of a seam that is sealed by `process`: those of the golden design are its first and its second.
fn band_colour(process: &str) -> [u8; 3] {
    match process {
        "inner" => [0x2e, 0x9e, 0x6b],
        "outer" => [0xb0, 0x5c, 0xc8],
        _ => BAND,
    }
}

/// The picture of pixels shows tube and bands where the design has them; labels and arrows cover a few places.
#[test]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels: a few thousand"
)]
fn pixels_show_the_design() {
    for (name, text) in designs() {
        let build = built(&text, &support::read(&text).machine.profile);
        let design = &build.forecast.design;
        for file in build.artifacts.iter().filter(|file| file.output.kind == Kind::PreviewPng) {
            let sheet = file.output.part.sheet().expect("a sheet");
            let layout = design.sheets.iter().find(|layout| layout.index == sheet).expect("a sheet");
            let (_, picture) = pictures(&build).into_iter().find(|(own, _)| *own == sheet).expect("an SVG");
            let page = page_of(&picture, layout.height);
            let raster = read_png(&file.bytes).expect("a PNG");
            assert_eq!(raster.width.max(raster.height), 1920, "{name}");
            let scale = raster.width as f64 / page.width();
            let color = |p: Point| {
                let (x, y) = ((p.x - page.min.x) * scale, (page.max.y - p.y) * scale);
                raster.pixel(x as usize, y as usize).expect("inside of the picture")
            };
            // The nearest of three colours: thin lines are smoothed.
            let nearest = |p: Point, band: [u8; 3]| {
                let pixel = color(p);
                let color_distance = |one: &[u8; 3]| -> u32 {
                    one.iter().zip(pixel).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
                };
                [TUBE, band, [0xf7, 0xf7, 0xf4]].into_iter().min_by_key(color_distance).expect("three")
            };
            for star in design.on_sheet(sheet) {
                let part = design.assembly().expect("stars").part(star);
                let share = |path: &Path, left: f64, right: [u8; 3]| {
                    let points = (0..60).filter_map(|k| {
                        let station = (f64::from(k) + 0.5) / 60.0 * path.length();
                        Some(
                            star.placement
                                .point(path.point_at(station)? + path.tangent_at(station)?.perp() * left),
                        )
                    });
                    points
                        .filter(|point| nearest(*point, if right == TUBE { BAND } else { right }) == right)
                        .count()
                };
                let w = part.star.w;
                assert!(share(&part.realised_edges[0], -0.5 * w, TUBE) >= 48, "{name}: tube");
                let seams = part.shape.seams.iter().zip(&part.seam_lines);
                for (seam, lines) in seams.filter(|_| part.shape.band * scale >= 2.5) {
                    let run = seam.center_line.part(w, seam.center_line.length() - w);
                    assert!(share(&run, 0.0, band_colour(&lines.process)) >= 48, "{name}: band");
                }
            }
        }
    }
}

/// A preview holds plain shapes and words: nothing that runs, nothing from elsewhere.
#[test]
fn previews_are_inert() {
    const ELEMENTS: [&str; 8] = ["svg", "title", "g", "rect", "path", "circle", "polygon", "text"];
    for (name, text) in designs() {
        for (_, picture) in pictures(&built(&text, &support::read(&text).machine.profile)) {
            assert!(picture.starts_with("<svg") && !picture.contains("<!"), "{name}");
            for node in Document::parse(&picture).expect("XML").descendants().filter(Node::is_element) {
                assert!(ELEMENTS.contains(&node.tag_name().name()), "{name}: {node:?}");
                for attribute in node.attributes() {
                    let (key, value) = (attribute.name(), attribute.value());
                    let inert = !key.starts_with("on") && !key.ends_with("href") && !value.contains("url(");
                    assert!(inert && (key != "style" || node.tag_name().name() == "svg"), "{name}: {node:?}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn no_label_of_a_random_star_covers_anything(shape in support::shapes(), count in 1_u32..=3) {
        let text = format!("{}[stack]\ncount = {count}\npitch = \"{} mm\"\n", shape.toml(), shape.w.max(20.0));
        let spec = support::read(&text);
        let sources = Sources { spec: &text, machine: support::generic() };
        let request = KindRequest::exactly(&[Kind::PreviewSvg]);
        if let Ok(build) = build(&spec, &support::machine(), sources, &request) {
            let faults = faults(&build);
            prop_assert!(faults.is_empty(), "{text}\n{faults:#?}");
        }
    }
}
