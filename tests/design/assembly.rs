//! The gripper put together from its written files alone: parts that belong together fit, in every format.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path as FilePath;

use stargrip_cam::artifact::{Format, Kind, Output, Subject};
use stargrip_cam::design::{Layer, PaperPage, Shape};
use stargrip_cam::geom::{Isometry, Path, Point, Vec2};
use stargrip_cam::manifest::{Manifest, ManifestFile};
use stargrip_cam::pipeline::Built;
use stargrip_cam::verify::{Drawing, SvgOrigin, read_dxf, read_svg};

use crate::support;

/// Largest difference between parts, mm.
const FIT: f64 = 0.001;

fn designs() -> Vec<(String, Built)> {
    let folder = FilePath::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let mut out: Vec<(String, Built)> = fs::read_dir(folder)
        .expect("designs/")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let text = fs::read_to_string(&path).expect("a design");
            (name, support::build(&text).expect("a design that can be made"))
        })
        .collect();
    out.sort_by(|a, b| a.0.cmp(&b.0));
    out
}

/// The files of a build as someone finds them.
struct Box<'a> {
    build: &'a Built,
    manifest: Manifest,
}

impl<'a> Box<'a> {
    fn new(build: &'a Built) -> Self {
        let files = build.output_files();
        let manifest = serde_json::from_slice(files.get("manifest.json").expect("one")).expect("JSON");
        Self { build, manifest }
    }

    fn read(&self, file: &ManifestFile) -> Drawing {
        let files = self.build.output_files();
        let text = std::str::from_utf8(files.get(&file.path).expect("a file")).expect("text").to_owned();
        let drawing = match file.kind {
            Kind::OutlineSvg | Kind::SealSvg => read_svg(&text, SvgOrigin::LowerLeft),
            kind if kind.format() == Format::Svg => read_svg(&text, SvgOrigin::Axis),
            _ => read_dxf(&text),
        };
        assert_eq!(drawing.findings, [], "{}", file.path);
        drawing
    }

    /// All drawings of either format.
    fn all(&self, subject: Subject) -> Vec<(&ManifestFile, Drawing)> {
        let drawn =
            |kind: Kind| kind.subject() == subject && [Format::Svg, Format::Dxf].contains(&kind.format());
        let of = self.manifest.files.iter().filter(|file| drawn(file.kind));
        of.map(|file| (file, self.read(file))).collect()
    }
}

/// Centre and radius of a round path.
fn circle(path: &Path) -> (Point, f64) {
    let bounds = path.bounds();
    (bounds.center(), bounds.width() / 2.0)
}

fn circles(drawing: &Drawing, layer: &str) -> Vec<(Point, f64)> {
    drawing.layer(layer).iter().map(circle).collect()
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() <= FIT, "{a} is not {b}");
}

/// The outline of every star on the sheets of one format, moved into the star's frame by laying the mask's holes on its own.
fn star_outlines<'a>(
    mask: &Drawing,
    sheets: &'a [(&ManifestFile, Drawing)],
) -> Vec<(Vec2, &'a Path, &'a Path)> {
    let holes = circles(mask, "registration");
    let mut out = Vec::new();
    for (_, sheet) in sheets {
        let on_sheet = circles(sheet, "registration");
        for (first, _) in &on_sheet {
            let shift = *first - holes[0].0;
            let fits = holes.iter().all(|(center, radius)| {
                let there = *center + shift;
                on_sheet.iter().any(|(c, r)| c.distance(there) <= FIT && (r - radius).abs() <= FIT)
            });
            if !fits {
                continue;
            }
            let axis = Point::ORIGIN + shift;
            let around =
                |layer: &str| sheet.layer(layer).iter().find(|path| path.encloses(axis)).expect("a cut");
            out.push((shift, around("cut-outside"), around("cut-hole")));
        }
    }
    out
}

#[test]
fn masks_lie_on_the_outlines_by_their_holes() {
    for (name, build) in designs() {
        let parts = Box::new(&build);
        let outlines = parts.all(Subject::Outline);
        let by_format = |format: Format| {
            let of = outlines.iter().filter(|(file, _)| file.kind.format() == format);
            of.map(|(file, drawing)| (*file, drawing.clone())).collect::<Vec<_>>()
        };
        for (file, mask) in parts.all(Subject::Mask).iter().filter(|(file, _)| !file.mirrored) {
            let sheets = by_format(file.kind.format());
            let wanted = parts.manifest.masks.iter().find(|m| Some(m.star) == file.star).expect("a mask");
            let stars = star_outlines(mask, &sheets);
            assert!(stars.len() >= wanted.stars.len(), "{name}: {} fits {} stars", file.path, stars.len());
            let plate = &mask.layer("mask-plate")[0];
            for (shift, outside, hole) in stars.iter().take(wanted.stars.len()) {
                // The plate covers the whole part by the border or more, and nothing pokes out of it.
                for segment in &outside.segments {
                    let p = segment.start() - *shift;
                    assert!(plate.encloses(p), "{name}: {p:?} outside the plate");
                    assert!(plate.distance(p) >= 10.0 - FIT, "{name}: border {}", plate.distance(p));
                }
                for window in mask.layer("mask-window") {
                    // Windows lie inside the cut, and end on the hole side where the fabric ends.
                    let apex = window.nearest(Point::ORIGIN).expect("a path");
                    near(hole.distance(apex.point + *shift), 0.0);
                    let middle = window.bounds().center() + *shift;
                    assert!(outside.encloses(middle) && !hole.encloses(middle));
                }
            }
        }
    }
}

#[test]
fn a_mirrored_mask_is_the_other_one_turned_over() {
    let text = format!("{}\n[mask]\nmirror = true\n", support::PAPER);
    let build = support::build(&text).expect("a design");
    let parts = Box::new(&build);
    let masks = parts.all(Subject::Mask);
    assert_eq!(masks.len(), 4);
    let holes = |mirrored: bool| {
        let (_, mask) = masks.iter().find(|(file, _)| file.mirrored == mirrored).expect("a mask");
        let plate = mask.layer("mask-plate")[0].clone();
        (circles(mask, "registration"), plate)
    };
    let ((up, plate), (down, back)) = (holes(false), holes(true));
    for ((a, _), (b, _)) in up.iter().zip(&down) {
        near(a.x, b.x);
        near(a.y, -b.y);
    }
    assert!(plate.area() > 0.0);
    near(plate.area().abs() / back.area().abs(), 1.0);
    // The inlet lies at tip 1, above +X; turned over it lies below.
    near(plate.bounds().max.y, -back.bounds().min.y);
}

#[test]
fn plates_stand_on_the_same_posts_outside_of_every_star() {
    for (name, build) in designs() {
        let parts = Box::new(&build);
        let kerf = if name == "conical-stack" { 0.2 } else { 0.0 };
        let frames = parts.all(Subject::Frame);
        let first = circles(&frames[0].1, "post-hole");
        let posts: usize = parts.manifest.posts.iter().map(|posts| posts.count).sum();
        assert_eq!(first.len(), posts);
        for (file, plate) in &frames {
            let holes = circles(plate, "post-hole");
            for ((a, r), (b, s)) in holes.iter().zip(&first) {
                assert!(a.distance(*b) <= FIT, "{name}: {}", file.path);
                near(*r, *s);
            }
            let [(center, edge)] = circles(plate, "frame-edge")[..] else { panic!("one edge") };
            near(center.distance(Point::ORIGIN), 0.0);
            let listed = parts.manifest.plates.iter().find(|p| p.plates.first() == file.plate.as_ref());
            let listed = listed.expect("in the bill of materials");
            let [(center, opening)] = circles(plate, "frame-opening")[..] else { panic!("one opening") };
            near(center.distance(Point::ORIGIN), 0.0);
            near(opening + kerf / 2.0, listed.opening_mm);
            near(edge - kerf / 2.0, listed.radius_mm);
            for (post, r) in &holes {
                assert!(post.distance(Point::ORIGIN) + r < edge, "{name}: a post at the edge");
            }
        }
        // Posts are between the inlets, which reach further than the tips.
        for placed in &build.forecast.design.assembly().expect("stars").stars {
            let turn = build.forecast.design.assembly().expect("stars").stack.turns[placed.index - 1];
            let outside = &build.forecast.design.assembly().expect("stars").part(placed).outline.outside;
            for (post, r) in &first {
                let seen = Point::polar(post.distance(Point::ORIGIN), (*post - Point::ORIGIN).angle() - turn);
                assert!(
                    !outside.encloses(seen) && outside.distance(seen) >= r + 5.0 - FIT,
                    "{name}: {post:?}"
                );
            }
        }
    }
}

#[test]
fn openings_let_the_corners_pass_and_carry_the_tips() {
    for (name, build) in designs() {
        let parts = Box::new(&build);
        for plates in &parts.manifest.plates {
            for number in &plates.plates {
                for star in
                    parts.manifest.stars.iter().filter(|s| s.index == *number || s.index + 1 == *number)
                {
                    assert!(plates.opening_mm > star.clear_radius_mm, "{name}: plate {number}");
                }
            }
        }
        // Posts reach from the bottom of the lowest plate to the top of the highest.
        let heights =
            parts.manifest.plates.iter().flat_map(|p| p.heights_mm.iter().map(|h| (*h, p.thickness_mm)));
        let (low, high) = heights
            .fold((f64::MAX, f64::MIN), |(low, high), (h, t)| (low.min(h - t / 2.0), high.max(h + t / 2.0)));
        near(low, 0.0);
        near(high, parts.manifest.posts[0].length_mm);
    }
}

/// The pages of `output`, as they are written.
fn pages(build: &Built, output: &Output) -> Vec<PaperPage> {
    let drawing = output.drawing(&build.forecast.design).expect("a drawing");
    output.paper.expect("paper").pages(&drawing, &output.caption().expect("a caption"))
}

/// The outlines of the shapes on `layer` of `page`.
fn outlines(page: &PaperPage, layer: Layer) -> Vec<Path> {
    let layers = page.drawing.layers.iter().filter(|(drawn, _)| *drawn == layer);
    let paths = |shape: &Shape| match shape {
        Shape::Path(path) => vec![path.clone()],
        Shape::Figure(paths) => paths.clone(),
        Shape::Circle { .. } => Vec::new(),
    };
    layers.flat_map(|(_, shapes)| shapes).flat_map(paths).collect()
}

#[test]
fn the_paper_shows_the_mask_at_its_size() {
    let build = support::build(support::PAPER).expect("a design");
    let parts = Box::new(&build);
    let (_, mask) = &parts.all(Subject::Mask)[0];
    let papers = build.artifacts.iter().map(|artifact| &artifact.output);
    for output in papers.filter(|output| output.kind == Kind::MaskPdf) {
        let pages = pages(&build, output);
        // The first of several is the overview, which is smaller.
        let pages = if pages.len() > 1 { &pages[1..] } else { &pages };
        for page in pages {
            // The check square and the ruler.
            let marks = outlines(page, Layer::PaperMark);
            let square = marks.iter().find(|path| path.closed).expect("a square").bounds();
            assert!((square.width() - 20.0).abs() < 1e-9 && (square.height() - 20.0).abs() < 1e-9);
            assert!(marks.iter().any(|path| (path.length() - 100.0).abs() < 1e-9), "a ruler");
            for window in outlines(page, Layer::MaskWindow) {
                assert!((window.area() - mask.layer("mask-window")[0].area()).abs() < 0.5);
            }
        }
        // Every window shows on some page.
        let shown: usize = pages.iter().map(|page| outlines(page, Layer::MaskWindow).len()).sum();
        assert!(shown >= 5, "{}: {shown}", output.name());
    }
}

#[test]
fn neighbouring_pages_carry_the_same_crosses() {
    let build = support::build(support::PAPER).expect("a design");
    let artifact = build.artifacts.iter().find(|artifact| artifact.name == "star-1-mask-a4.pdf");
    let pages = pages(&build, &artifact.expect("a file").output);
    assert_eq!(pages.len(), 5);
    // A cross is two strokes of 6 mm; its place against the drawing follows from the drawing itself.
    let crosses = |page: usize| -> Vec<Point> {
        let page = &pages[1 + page];
        let plate = outlines(page, Layer::MaskPlate)[0].bounds().min;
        let strokes = outlines(page, Layer::PaperMark);
        let strokes = strokes.iter().filter(|path| (path.length() - 6.0).abs() < 1e-9);
        strokes.map(|path| Point::ORIGIN + (path.bounds().center() - plate)).collect()
    };
    for (left, right) in [(0, 1), (2, 3), (0, 2), (1, 3)] {
        let (a, b) = (crosses(left), crosses(right));
        let shared = a.iter().filter(|p| b.iter().any(|q| q.distance(**p) < 0.01)).count();
        assert_eq!((a.len(), b.len(), shared), (8, 8, 4), "pages {left} and {right}");
    }
}

#[test]
fn windows_stay_apart_and_shrink_by_the_creep() {
    for points in [3, 5, 6, 8] {
        for creep in [0.0, 0.5] {
            let text = support::PAPER.replace("points = 5", &format!("points = {points}"));
            let text = format!("{text}\n[mask]\ncreep = \"{creep} mm\"\n");
            let build = support::build(&text).expect("a design");
            let windows = &build.forecast.design.assembly().expect("stars").distinct[0].mask.windows;
            assert_eq!(windows.len(), points);
            for (i, a) in windows.iter().enumerate() {
                assert!(a.area() > 0.0 && a.largest_gap() < 1e-9);
                for b in &windows[i + 1..] {
                    assert!(stargrip_cam::geom::path_distance(a, b) >= 4.0 - 1e-9, "{points} points");
                }
                // The window is its own image, turned by a sector.
                let turn = TAU / f64::from(u32::try_from(points).expect("few"));
                let next = &windows[(i + 1) % points];
                let p = a.start().expect("a path");
                let image = stargrip_cam::geom::Isometry::rotation(turn).point(p);
                assert!(next.distance(image) < 1e-9);
            }
            let wide =
                support::build(&text.replace(&format!("\"{creep} mm\""), "\"0 mm\"")).expect("a design");
            let full = &wide.forecast.design.assembly().expect("stars").distinct[0].mask.windows[0];
            for segment in &windows[0].segments {
                let d = full.distance(segment.point(0.5));
                assert!(d >= creep - 1e-6, "{points} points: {d} from the full window at a creep of {creep}");
            }
        }
    }
}

/// A tool that takes 0.3 mm away runs 0.15 mm inside of a part's cut-outs, and outside of its cut edges.
#[test]
fn what_is_cut_comes_out_as_it_is_drawn() {
    let kerf = "[cut]\nkerf = \"0.3 mm\"\n";
    let cut = support::build(&format!("{}\n{kerf}", support::PAPER)).expect("a design");
    let plain = support::build(support::PAPER).expect("a design");
    let (with, without) = (Box::new(&cut), Box::new(&plain));
    for (subject, outside) in [
        (Subject::Outline, &["cut-outside"][..]),
        (Subject::Mask, &["mask-plate"]),
        (Subject::Frame, &["frame-edge"]),
    ] {
        for ((file, drawn), (_, part)) in with.all(subject).iter().zip(without.all(subject)) {
            for (layer, paths) in drawn.layers.iter().filter(|(layer, _)| *layer != "label") {
                // The sheet is larger by the kerf around the part, so the part lies farther in.
                let shift =
                    if subject == Subject::Outline { Vec2::new(0.15, 0.15) } else { Vec2::new(0.0, 0.0) };
                let move_back = Isometry::translation(-shift);
                for (path, edge) in paths.iter().zip(part.layer(layer)) {
                    for segment in &path.segments {
                        let p = move_back.point(segment.point(0.3));
                        near(edge.distance(p), 0.15);
                        assert_eq!(
                            edge.encloses(p),
                            !outside.contains(&layer.as_str()),
                            "{}: {layer}",
                            file.path
                        );
                    }
                }
            }
        }
    }
    // Printed parts have no kerf.
    for (a, b) in cut.artifacts.iter().zip(&plain.artifacts) {
        if matches!(a.output.kind, Kind::MaskPdf | Kind::MaskStl) {
            assert!(a.bytes == b.bytes, "{}", a.output.name());
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_with_numbers() {
    for (more, key, number) in [
        ("[mask]\nextent = \"90 mm\"\n", "mask.extent", "at most 7"),
        ("[mask]\ncreep = \"20 mm\"\n", "mask.creep", "at most 17.49 mm"),
        ("[stack]\ncount = 2\npitch = \"20 mm\"\n", "stack.pitch", "at least 24.1"),
        ("[frame]\nkerf = \"6 mm\"\n", "frame.kerf", "at most 5.8 mm"),
        ("[cut]\nkerf = \"3 mm\"\n", "cut.kerf", "a registration hole of 3 mm"),
        (
            "[cut]\nkerf = \"40 mm\"\n[sheet]\nhole_diameter = \"0 mm\"\n",
            "cut.kerf",
            "nothing of a coating window",
        ),
        ("[frame]\nposts = 60\n", "frame.posts", "needs 21.2"),
        ("[sheet]\nwidth = \"300 mm\"\n", "sheet.width", "33.04"),
    ] {
        let refusals = support::build(&format!("{}\n{more}", support::PAPER)).expect_err(more);
        let said = refusals.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert!(said.contains(key) && said.contains(number), "{more}: {said}");
    }
}

#[test]
fn a_part_is_turned_only_where_that_is_allowed() {
    let narrow = format!("{}\n[sheet]\nwidth = \"334 mm\"\nheight = \"400 mm\"\n", support::PAPER);
    let tall = narrow.replace("334 mm", "400 mm").replace("height = \"400 mm\"", "height = \"334 mm\"");
    assert!(support::build(&narrow).is_ok());
    let refusals = support::build(&tall).expect_err("336.5 mm high");
    assert!(refusals[0].remedy.contains("`height` at least 336.437 mm"), "{}", refusals[0]);
    let turned = support::build(&format!("{tall}turn = true\n")).expect("turned it fits");
    let proof = stargrip_cam::pipeline::read_back(&turned.output_files());
    assert_eq!(proof.findings, []);
    let rotation = turned.forecast.design.assembly().expect("stars").stars[0].placement.rotation;
    assert!((rotation - TAU / 4.0).abs() < 1e-12);
}

#[test]
fn labels_stand_on_the_fabric_clear_of_seams_and_holes() {
    for points in 3..=8 {
        for allowance in ["2.5 mm", "8 mm", "20 mm"] {
            let text = support::PAPER.replace("points = 5", &format!("points = {points}"));
            let build = support::build(&format!("{text}\n[seal]\nallowance = \"{allowance}\"\n"));
            let Ok(build) = build else { continue };
            let parts = Box::new(&build);
            let (_, sheet) = &parts.all(Subject::Outline)[0];
            let labels = sheet.layer("label");
            let (outside, hole) = (&sheet.layer("cut-outside")[0], &sheet.layer("cut-hole")[0]);
            let placed = &build.forecast.design.assembly().expect("stars").stars[0];
            let [_, tube] = &build.forecast.design.assembly().expect("stars").part(placed).edges;
            let tube = placed.placement.path(tube);
            for label in labels {
                for segment in &label.segments {
                    let p = segment.point(0.5);
                    let where_ = format!("{points} points, {allowance}: {p:?}");
                    assert!(outside.encloses(p) && !hole.encloses(p), "off the fabric: {where_}");
                    assert!(outside.distance(p) > 0.2, "at the cut: {where_}");
                    assert!(tube.distance(p) > 2.0, "on the band: {where_}");
                    for (center, radius) in circles(sheet, "registration") {
                        assert!(center.distance(p) > radius, "in a hole: {where_}");
                    }
                }
            }
            assert!(allowance == "2.5 mm" || !labels.is_empty(), "{points} points, {allowance}");
        }
    }
}

/// Every shipped mask but the basketball's on a common bed.
#[test]
fn pieces_fit_the_bed_and_are_the_plate() {
    let designs = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/designs")).expect("designs/");
    let mut several = 0;
    for path in designs.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file()) {
        let text = std::fs::read_to_string(&path).expect("a design");
        let bed = "[mask]\nbed = \"220 mm x 220 mm\"\n";
        let text = if text.contains("[mask]\n") { text.replace("[mask]\n", bed) } else { text + "\n" + bed };
        let design = stargrip_cam::design::Design::new(&support::read(&text), &support::machine());
        if path.to_string_lossy().contains("basketball") {
            assert_eq!(design.expect_err("too large")[0].code, "small-bed");
            continue;
        }
        let design = design.unwrap_or_else(|refusals| panic!("{}: {refusals:?}", path.display()));
        for part in &design.assembly().expect("stars").distinct {
            let pieces = &part.tiles.tiles;
            several += usize::from(part.tiles.are_several());
            assert!(pieces.iter().flat_map(|piece| piece.size).all(|mm| mm <= 220.0), "{pieces:?}");
            // The size of each piece is that of its edge after it is turned.
            for piece in pieces {
                let bounds = piece.motion(false).path(&piece.edge).bounds();
                assert!((bounds.width() - piece.size[0]).abs() < 1e-9);
                assert!(piece.edge.largest_gap() < 1e-9 && piece.edge.area() > 0.0);
            }
            let area: f64 = pieces.iter().map(|piece| piece.edge.area()).sum();
            let missing = part.mask.plate.area() - area;
            assert!((0.0..1e-3 * part.mask.area(&part.outline)).contains(&missing), "{missing} mm2");
            // Windows stay whole, at least 4 mm of plate around them.
            for window in &part.mask.windows {
                assert!(pieces[0].edge.encloses(window.start().expect("a path")));
                assert!(stargrip_cam::geom::path_distance(&pieces[0].edge, window) >= 4.0 - 1e-9);
            }
            for hole in &part.outline.registration {
                let around = pieces.iter().filter(|piece| piece.edge.encloses(hole.center));
                let least = around.map(|piece| piece.edge.distance(hole.center) - hole.diameter / 2.0);
                assert_eq!(least.clone().count(), 1);
                assert!(least.fold(f64::INFINITY, f64::min) >= 2.5 - 1e-9);
            }
        }
    }
    assert!(several >= 8, "{several}");
}
