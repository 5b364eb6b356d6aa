//! Scenes against the design: all of it is there, as large as it should be, and inflates to what is predicted.
//!
//! A scene is for the eye, so it is held to a tolerance of its own, [`DISPLAY`], and tells no deviation.

use std::f64::consts::{PI, TAU};

use crate::design::{Design, Drawing, Edge, Layer, PlacedStar, Star, tube_height};
use crate::forecast::pose;
use crate::geom::{Bounds, Isometry, Path};
use crate::spec::ObjectShape;
use crate::verify::judge::expected::Expected;
use crate::verify::read::glb::{GlbNode, GlbPart, read_glb};
use crate::verify::{FindingCode, Findings};

/// How far an edge may be off, mm: chords within 0.05 mm, and rounding.
const DISPLAY: f64 = 0.1;
/// How far a chord may leave its arc, mm; along all edges that is how much an area may be off.
const CHORD: f64 = 0.055;
/// How much a height may be off, mm: coordinates are rounded to thousandths.
const ROUNDED: f64 = 0.0006;

/// What one node has to show.
struct Wanted {
    name: String,
    /// The material that the rest is said of.
    material: &'static str,
    /// Extent along X, Y and Z, mm.
    size: [f64; 3],
    /// Least X, Y and Z, where the design says it.
    least: Option<[f64; 3]>,
    /// Area seen from above and length of all edges, mm^2 and mm; `None` where it is not held to one.
    surface: Option<[f64; 2]>,
}

/// Reads a scene and compares it.
pub(in crate::verify) fn check(expected: &Expected<'_>, bytes: &[u8], findings: &mut Findings) {
    let mut wrong = |found: String, allowed: String| findings.add(FindingCode::BadGlb, None, found, allowed);
    let nodes = match read_glb(bytes) {
        Ok(nodes) => nodes,
        Err(fault) => return wrong(fault, "a GLB of glTF 2.0".to_owned()),
    };
    let wanted = wanted(expected);
    let names = |names: Vec<&str>| names.join(", ");
    if !nodes.iter().map(|node| &node.name).eq(wanted.iter().map(|node| &node.name)) {
        let found = names(nodes.iter().map(|node| node.name.as_str()).collect());
        return wrong(found, names(wanted.iter().map(|node| node.name.as_str()).collect()));
    }
    for (node, wanted) in nodes.iter().zip(&wanted) {
        shows(node, wanted, findings);
    }
    let inflated = pose::inflated(expected.spec, expected.design, expected.prediction);
    for placed in &expected.design.stars {
        let name = format!("stack/star {}", placed.index);
        if let Some(node) = nodes.iter().find(|node| node.name == name) {
            inflates(expected, placed, inflated.get(placed.index - 1), node, findings);
            has_its_own_mesh(node, &nodes, findings);
        }
    }
}

/// Every node, in order.
fn wanted(expected: &Expected<'_>) -> Vec<Wanted> {
    let (spec, design) = (expected.spec, expected.design);
    let (frame, stack) = (&design.frame, &design.stack);
    let mut out = Vec::new();
    for plate in &frame.plates {
        for (number, z) in plate.numbers.iter().map(|number| (number, stack.plates[number - 1])) {
            let (r, t) = (frame.radius, frame.thickness);
            let posts = f64::from(spec.frame.posts) * frame.post_diameter / 2.0;
            out.push(Wanted {
                name: format!("stack/plate {number}"),
                material: "plate",
                size: [2.0 * r, 2.0 * r, t],
                least: Some([-r, -r, z - t / 2.0]),
                surface: Some([frame.area(plate), TAU * (r + plate.opening + posts)]),
            });
        }
    }
    for (post, number) in frame.posts.iter().zip(1..) {
        let (d, h) = (frame.post_diameter, frame.post_length);
        out.push(Wanted {
            name: format!("stack/post {number}"),
            material: "post",
            size: [d, d, h],
            least: Some([post.x - d / 2.0, post.y - d / 2.0, 0.0]),
            surface: Some([PI * d * d / 4.0, PI * d]),
        });
    }
    for ((placed, z), turn) in design.stars.iter().zip(&stack.stars).zip(&stack.turns) {
        let cut = Isometry::rotation(*turn).path(&design.part(placed).outline.outside).bounds();
        out.push(flat(format!("stack/star {}", placed.index), &cut, Some([cut.min.x, cut.min.y, *z]), None));
    }
    out.extend(object(expected));
    out.extend(design.sheets.iter().filter_map(|sheet| {
        let cuts = Drawing::outlines(design, sheet.index, Edge::Part)?;
        let size = [sheet.width, sheet.height, 0.0];
        let [holes, edges] = within(&cuts, &[Layer::Registration, Layer::CutHole]);
        let surface = Some([sheet.width * sheet.height - holes, edges]);
        Some(Wanted {
            name: format!("sheets/sheet {}", sheet.index),
            material: "fabric",
            size,
            least: None,
            surface,
        })
    }));
    for first in design.firsts() {
        for mirrored in [false, true].into_iter().take(1 + usize::from(spec.mask.mirror)) {
            out.extend(mask(design, first.index, mirrored, spec.mask.thickness.0));
        }
    }
    out
}

fn flat(name: String, bounds: &Bounds, least: Option<[f64; 3]>, surface: Option<[f64; 2]>) -> Wanted {
    let size = [bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y, 0.0];
    Wanted { name, material: "fabric", size, least, surface }
}

/// The object of the spec, half way between the lowest and the highest star.
fn object(expected: &Expected<'_>) -> Option<Wanted> {
    let load = expected.spec.load.as_ref()?;
    let radius = load.object_radius?.0;
    let height = load.object_height.map_or(2.0 * radius, |height| height.0);
    let stars = &expected.design.stack.stars;
    let middle = f64::midpoint(*stars.first()?, *stars.last()?);
    let is_cylinder = load.object_shape == Some(ObjectShape::Cylinder);
    Some(Wanted {
        name: "object/object".to_owned(),
        material: "object",
        size: [2.0 * radius, 2.0 * radius, height],
        least: Some([-radius, -radius, middle - height / 2.0]),
        surface: is_cylinder.then_some([PI * radius * radius, TAU * radius]),
    })
}

fn mask(design: &Design, star: usize, mirrored: bool, thickness: f64) -> Option<Wanted> {
    let drawing = Drawing::mask(design, star, mirrored, Edge::Part)?;
    let plate = drawing.layers.iter().find(|(layer, _)| *layer == Layer::MaskPlate)?.1.first()?.bounds();
    let [whole, edge] = within(&drawing, &[Layer::MaskPlate]);
    let [holes, edges] = within(&drawing, &[Layer::MaskWindow, Layer::Registration]);
    let name = format!("masks/mask {star}{}", if mirrored { " mirrored" } else { "" });
    let wanted = flat(name, &plate, None, Some([whole - holes, edge + edges]));
    Some(Wanted { material: "mask", size: [wanted.size[0], wanted.size[1], thickness], ..wanted })
}

/// Area and length of all closed paths on these layers.
fn within(drawing: &Drawing, on: &[Layer]) -> [f64; 2] {
    let shapes = drawing.layers.iter().filter(|(layer, _)| on.contains(layer)).flat_map(|(_, shapes)| shapes);
    let paths: Vec<Path> = shapes.flat_map(|shape| shape.paths().into_owned()).collect();
    [paths.iter().map(|path| path.area().abs()).sum(), paths.iter().map(Path::length).sum()]
}

/// Whether the node is as large as it should be, at its place, and has its holes.
fn shows(node: &GlbNode, wanted: &Wanted, findings: &mut Findings) {
    let Some(part) = node.parts.iter().find(|part| part.material == wanted.material) else {
        let found = format!("{} without {}", node.name, wanted.material);
        return findings.add(FindingCode::BadGlb, None, found, "one");
    };
    let (least, size) = extent(&part.points);
    let off = |found: [f64; 3], right: [f64; 3]| (0..3).any(|k| (found[k] - right[k]).abs() > DISPLAY);
    if off(size, wanted.size) || wanted.least.is_some_and(|right| off(least, right)) {
        let found = format!("{} of {size:.3?} mm from {least:.3?}", node.name);
        let allowed = format!("{:.3?} mm from {:.3?}", wanted.size, wanted.least);
        findings.add(FindingCode::Deviation, None, found, allowed);
    }
    let Some([area, edges]) = wanted.surface else { return };
    let (found, high) =
        if size[2] > 0.0 { (volume(part), wanted.size[2]) } else { (seen_from_above(part), 1.0) };
    let thicker = if size[2] > 0.0 { area * ROUNDED } else { 0.0 };
    if (found - area * high).abs() > CHORD * edges * high + thicker {
        let found = format!("{} of {found:.1}", node.name);
        findings.add(FindingCode::WrongVolume, None, found, format!("{:.1}", area * high));
    }
}

/// Viewers find what an animation moves by the name of its mesh: whether no other node, and no other mesh, is called like this one's.
fn has_its_own_mesh(node: &GlbNode, nodes: &[GlbNode], findings: &mut Findings) {
    // As they spell names: what is no letter, digit or hyphen becomes or is dropped beside an underscore.
    let plain = |name: &str| name.rsplit('/').next().unwrap_or(name).replace(' ', "_");
    let own = plain(&node.mesh);
    let is_taken =
        |other: &GlbNode| plain(&other.name) == own || other.name != node.name && plain(&other.mesh) == own;
    if node.animated && nodes.iter().any(is_taken) {
        let found = format!("{}, whose mesh is called `{}` like another", node.name, node.mesh);
        findings.add(FindingCode::BadGlb, None, found, "a mesh of its own, by a name of its own");
    }
}

/// Whether the star's tube closes to what is predicted, `to`, and stays as it is where nothing is.
fn inflates(
    expected: &Expected<'_>,
    placed: &PlacedStar,
    to: Option<&Star>,
    node: &GlbNode,
    findings: &mut Findings,
) {
    let star = &expected.design.part(placed).star;
    let Some(tube) = node.parts.iter().find(|part| part.material == "tube") else {
        return findings.add(FindingCode::BadGlb, None, format!("{} without a tube", node.name), "one");
    };
    let moves = node.parts.iter().all(|part| !part.inflated.is_empty());
    let rests = node.parts.iter().all(|part| part.inflated.is_empty());
    if (if to.is_some() { !moves } else { !rests }) || node.animated != to.is_some() {
        let found = format!("{}, which {}", node.name, if rests { "does not inflate" } else { "inflates" });
        findings.add(FindingCode::BadGlb, None, found, "what has a prediction inflates, and nothing else");
    }
    let mut compare = |what: &str, found: f64, right: f64| {
        if (found - right).abs() > DISPLAY {
            let found = format!("{}: {what} {found:.3} mm", node.name);
            findings.add(FindingCode::Deviation, None, found, format!("{right:.3} mm"));
        }
    };
    compare("inner radius flat", inner_radius(&tube.points), star.rho_0);
    if let Some(to) = to.filter(|_| moves) {
        compare("inner radius inflated", inner_radius(&tube.inflated), to.rho_0);
        compare("reach inflated", reach(&tube.inflated), to.tip_reach());
        compare("height inflated", extent(&tube.inflated).1[2], tube_height(star.w, to.w));
    }
}

/// Least distance from the axis.
fn inner_radius(points: &[[f64; 3]]) -> f64 {
    points.iter().map(|[x, y, _]| x.hypot(*y)).fold(f64::INFINITY, f64::min)
}

/// Largest distance from the axis.
fn reach(points: &[[f64; 3]]) -> f64 {
    points.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max)
}

/// Least X, Y and Z, and the extent along them.
fn extent(points: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    let fold = |start: f64, pick: fn(f64, f64) -> f64| {
        [0, 1, 2].map(|k| points.iter().map(|p| p[k]).fold(start, pick))
    };
    let (least, most) = (fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max));
    (least, [0, 1, 2].map(|k| most[k] - least[k]))
}

/// Area as seen from above.
fn seen_from_above(part: &GlbPart) -> f64 {
    let doubled = |[a, b, c]: &[usize; 3]| {
        let [a, b, c] = [part.points[*a], part.points[*b], part.points[*c]];
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    part.triangles.iter().map(doubled).sum::<f64>() / 2.0
}

/// Volume inside of the triangles, which all have to look outwards.
fn volume(part: &GlbPart) -> f64 {
    let sixfold = |[a, b, c]: &[usize; 3]| {
        let [a, b, c] = [part.points[*a], part.points[*b], part.points[*c]];
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    part.triangles.iter().map(sixfold).sum::<f64>() / 6.0
}
