//! The gripper put together from its written files alone: parts that belong together fit, in every format.

use crate::support;
use stargrip_cam::artifact::{Format, Kind, Output, Subject};
use stargrip_cam::design::{Layer, PaperPage, Shape};
use stargrip_cam::geom::{Path, Point, Vec2};
use stargrip_cam::manifest::{Manifest, ManifestFile};
use stargrip_cam::pipeline::Built;
use stargrip_cam::verify::{Drawing, SvgOrigin, read_dxf, read_svg};
use std::fs;
use std::path::Path as FilePath;

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
pub(super) struct Box<'a> {
    build: &'a Built,
    manifest: Manifest,
}

impl<'a> Box<'a> {
    pub(super) fn new(build: &'a Built) -> Self {
        let files = build.output_files();
        let manifest = serde_json::from_slice(files.get("manifest.json").expect("one")).expect("JSON");
        Self { build, manifest }
    }

    fn read(&self, file: &ManifestFile) -> Drawing {
        let files = self.build.output_files();
        let text = std::str::from_utf8(files.get(&file.path).expect("a file")).expect("text").to_owned();
        let is_of_sheet = [Subject::Outline, Subject::Seal].contains(&file.kind.subject());
        let origin = if is_of_sheet { SvgOrigin::LowerLeft } else { SvgOrigin::Axis };
        let is_svg = file.kind.format() == Format::Svg;
        let drawing = if is_svg { read_svg(&text, origin) } else { read_dxf(&text) };
        assert_eq!(drawing.findings, [], "{}", file.path);
        drawing
    }

    /// All drawings of either format.
    pub(super) fn all(&self, subject: Subject) -> Vec<(&ManifestFile, Drawing)> {
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

pub(super) fn circles(drawing: &Drawing, layer: &str) -> Vec<(Point, f64)> {
    drawing.layer(layer).iter().map(circle).collect()
}

pub(super) fn near(a: f64, b: f64) {
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
