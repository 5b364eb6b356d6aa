//! The scene: all products in three dimensions and to scale, as one GLB file.
//!
//! The stack is at the origin, with plates, posts and stars; where the spec has a pressure the stars inflate. Sheets lie beside
//! it on one side, masks on the other. It is for the eye: meshes are those of [`mesh`], and nothing is cut, sealed or printed
//! from them.

mod drawn;
mod glb;
mod mesh;
mod pose;

use std::f64::consts::{FRAC_PI_2, PI};

use crate::emit::palette::{STAR_SURFACES, SURFACES, SceneSurface};
use crate::emit::scene::glb::{Glb, Node};
use crate::emit::scene::mesh::{Mesh, quarters};
use crate::emit::scene::pose::{PoseMotion, ScenePose, tube};
use design::{CutEdge, Design, Drawing, Layer, Side, Stand, StarAssembly, StarDesign};
use forecast::pose::PosedStar;
use geom::{Arc, Bounds, Path, Point};
use spec::{ObjectShape, Spec};

pub use drawn::drawn_scene;

/// Width of a cut's line, mm.
const CUT: f64 = 1.0;
/// Between the stack, sheets and masks, mm.
const GAP: f64 = 60.0;

/// Everything of the gripper `design`, its stars `inflated` to these, bottom to top, or not if there are none, and the spec's object; `None` where lyon
/// has no triangles for it.
pub fn scene(spec: &Spec, design: &Design, inflated: &[PosedStar]) -> Option<Vec<u8>> {
    let mut glb = Glb::new(&SURFACES.map(|(surface, ..)| surface)[..STAR_SURFACES]);
    let assembly = design.assembly()?;
    let stack_nodes = stack(&mut glb, assembly, inflated)?;
    let object_nodes: Vec<Node> = object(&mut glb, spec).unwrap_or_default();
    let bands = [(SceneSurface::InnerBand, Layer::SealInner), (SceneSurface::OuterBand, Layer::SealOuter)];
    let sheet_nodes = sheets(&mut glb, design, (reach(assembly), band_of(assembly)), &bands)?;
    let mask_nodes = masks(&mut glb, spec, assembly)?;
    // The object's material comes last: validators remark on a material without use.
    let surface_count = STAR_SURFACES - usize::from(object_nodes.is_empty());
    let groups =
        [("stack", stack_nodes), ("object", object_nodes), ("sheets", sheet_nodes), ("masks", mask_nodes)];
    Some(glb.finish(&spec.name, &groups, surface_count))
}

/// Plates, posts and stars, in their places.
fn stack(glb: &mut Glb, design: &StarAssembly, inflated: &[PosedStar]) -> Option<Vec<Node>> {
    let (frame, stack) = (&design.frame, &design.stack);
    let mut nodes = Vec::new();
    let mut stand = |name: String, mesh: usize, [x, y, z]: [f64; 3], turn: f64| {
        nodes.push(Node { name, mesh, at: [x, y, z], turn });
    };
    let half = frame.thickness / 2.0;
    for plate in &frame.plates {
        let mut paths = vec![circle(Point::ORIGIN, frame.radius), circle(Point::ORIGIN, plate.opening)];
        paths.extend(frame.posts.iter().map(|post| circle(*post, frame.post_diameter / 2.0)));
        let solid = Mesh::extruded(&paths, [-half, half])?;
        let mesh = glb.mesh("plate", &[(SceneSurface::Plate, solid)]);
        for number in &plate.numbers {
            stand(format!("plate {number}"), mesh, [0.0, 0.0, *stack.plates.get(number - 1)?], 0.0);
        }
    }
    if !frame.posts.is_empty() {
        let solid =
            Mesh::extruded(&[circle(Point::ORIGIN, frame.post_diameter / 2.0)], [0.0, frame.post_length])?;
        let mesh = glb.mesh("post", &[(SceneSurface::Post, solid)]);
        for (post, number) in frame.posts.iter().zip(1..) {
            stand(format!("post {number}"), mesh, [post.x, post.y, 0.0], 0.0);
        }
    }
    // Stars of one kind have one mesh where they close alike: on a ball each meets it at its own height.
    let mut meshes: Vec<(usize, Option<&PosedStar>, usize)> = Vec::new();
    for ((placed, z), turn) in design.stars.iter().zip(&stack.stars).zip(&stack.turns) {
        let (posed, name) = (inflated.get(placed.index - 1), format!("fabric of star {}", placed.index));
        let alike = meshes.iter().find(|(kind, closed, _)| *kind == placed.distinct && *closed == posed);
        let mesh = match alike {
            Some((.., mesh)) => glb.copy_mesh(*mesh, &name),
            None => star(glb, design.part(placed), posed, &name)?,
        };
        meshes.push((placed.distinct, posed, mesh));
        stand(format!("star {}", placed.index), mesh, [0.0, 0.0, *z], *turn);
    }
    Some(nodes)
}

/// The spec's object where the stars meet it, its axis that of the stars, on a support where it must be lifted; empty without one.
fn object(glb: &mut Glb, spec: &Spec) -> Option<Vec<Node>> {
    let (load, stand) = (spec.load.as_ref()?, Stand::new(spec)?);
    let radius = load.object_radius?.0;
    let half = load.object_height.map_or(radius, |height| height.0 / 2.0);
    let curve = match load.object_shape {
        Some(ObjectShape::Cylinder) => vec![[0.0, -half], [radius, -half], [radius, half], [0.0, half]],
        Some(ObjectShape::Ball) | None => {
            let steps = quarters(radius.max(half)) / 2;
            let point = |k: u32| {
                // The poles lie on the axis; rounding must not move them.
                let (sin, cos) = libm::sincos(PI * f64::from(k) / f64::from(steps));
                [if k == 0 || k == steps { 0.0 } else { radius * sin }, -half * cos]
            };
            (0..=steps).map(point).collect()
        }
    };
    let mesh = glb.mesh("surface of the object", &[(SceneSurface::Object, Mesh::turned(&curve))]);
    let mut nodes =
        vec![Node { name: "object".to_owned(), mesh, at: [0.0, 0.0, stand.object + half], turn: 0.0 }];
    if stand.object > 0.0 {
        let support = Mesh::extruded(&[circle(Point::ORIGIN, SUPPORT * radius)], [0.0, stand.object])?;
        let mesh = glb.mesh("support of the object", &[(SceneSurface::Object, support)]);
        nodes.push(Node { name: "support".to_owned(), mesh, at: [0.0; 3], turn: 0.0 });
    }
    Some(nodes)
}

/// Radius of the support below an object over that of the object.
const SUPPORT: f64 = 0.5;

/// A star of the stack: tube, flaps, bands, and where they go if it inflates.
fn star(glb: &mut Glb, part: &StarDesign, inflated: Option<&PosedStar>, name: &str) -> Option<usize> {
    let flat = ScenePose::flat(&part.star);
    let full = inflated.map(|to| ScenePose::inflated(part.star.w, to));
    let carried = |mesh: Mesh| match full {
        Some(to) => mesh.inflating(|p| PoseMotion { from: flat, to }.carried(p)),
        None => mesh,
    };
    let edge = |side: Side| part.star.contour(side, 0.0, 0.0).map(|contour| contour.path());
    let mut paths = vec![part.outline.outside.clone(), part.outline.hole.clone()];
    paths.extend([edge(Side::Outside)?, edge(Side::Hole)?]);
    paths.extend(part.outline.registration.iter().map(|hole| circle(hole.center, hole.diameter / 2.0)));
    let band = |name: &str| {
        let path = &part.shape.seam(name)?.center_line;
        Mesh::ribbons(std::slice::from_ref(path), part.shape.band).map(carried)
    };
    let parts = [
        (SceneSurface::Tube, tube(flat, full)),
        (SceneSurface::Fabric, carried(Mesh::fill(&paths, 0.0)?)),
        (SceneSurface::InnerBand, band("inner")?),
        (SceneSurface::OuterBand, band("outer")?),
    ];
    Some(glb.mesh(name, &parts))
}

/// The sheets as they lie on the machine, beside everything within `reach` mm of the origin: holes, cut lines, and bands `band` mm wide,
/// each with its surface and its layer.
fn sheets(
    glb: &mut Glb,
    design: &Design,
    (reach, band): (f64, f64),
    bands: &[(SceneSurface, Layer)],
) -> Option<Vec<Node>> {
    let mut left_edge = reach + GAP;
    let mut nodes = Vec::new();
    for layout in &design.sheets {
        let cuts = Drawing::outlines(design, layout.index, CutEdge::Part)?;
        let seals = Drawing::seals(design, layout.index)?;
        let bounds = Bounds { min: Point::ORIGIN, max: Point::new(layout.width, layout.height) };
        let mut paths = vec![Path::rectangle(&bounds)];
        paths.extend(
            [Layer::Registration, Layer::CutHole].into_iter().flat_map(|layer| paths_on(&cuts, layer)),
        );
        let mut parts = vec![(SceneSurface::Fabric, Mesh::fill(&paths, 0.0)?)];
        for (surface, layer) in bands {
            parts.push((*surface, Mesh::ribbons(&paths_on(&seals, *layer), band)?));
        }
        parts.push((SceneSurface::Cut, Mesh::ribbons(&paths_on(&cuts, Layer::CutOutside), CUT)?));
        let mesh = glb.mesh("sheet", &parts);
        let corner = [left_edge, -layout.height / 2.0, 0.0];
        nodes.push(Node { name: format!("sheet {}", layout.index), mesh, at: corner, turn: 0.0 });
        left_edge += layout.width + GAP;
    }
    Some(nodes)
}

/// The masks, for the other face, too, where the spec has them.
fn masks(glb: &mut Glb, spec: &Spec, design: &StarAssembly) -> Option<Vec<Node>> {
    let mut right = -reach(design) - GAP;
    let mut nodes = Vec::new();
    for first in design.firsts() {
        for mirrored in [false, true].into_iter().take(1 + usize::from(spec.mask.mirror)) {
            let drawing = Drawing::mask(design, first.index, mirrored, CutEdge::Part)?;
            let layers = [Layer::MaskPlate, Layer::MaskWindow, Layer::Registration];
            let paths: Vec<Path> = layers.into_iter().flat_map(|layer| paths_on(&drawing, layer)).collect();
            let Bounds { min, max } = paths.first()?.bounds();
            let solid = Mesh::extruded(&paths, [0.0, spec.mask.thickness.0])?;
            let mesh = glb.mesh("mask", &[(SceneSurface::Mask, solid)]);
            let name = format!("mask {}{}", first.index, if mirrored { " mirrored" } else { "" });
            nodes.push(Node { name, mesh, at: [right - max.x, 0.0, 0.0], turn: 0.0 });
            right -= max.x - min.x + GAP;
        }
    }
    Some(nodes)
}

fn paths_on(drawing: &Drawing, layer: Layer) -> Vec<Path> {
    let shapes = drawing.layers.iter().filter(|(own, _)| *own == layer).flat_map(|(_, shapes)| shapes);
    shapes.flat_map(|shape| shape.paths().into_owned()).collect()
}

/// Reach of the stack from its axis, mm.
fn reach(design: &StarAssembly) -> f64 {
    let mouths = design.distinct.iter().filter_map(|part| Some(part.channel?.mouth));
    mouths.fold(design.frame.radius, f64::max)
}

/// Width of the bands, which all stars have from the spec's one `[seal]`.
fn band_of(design: &StarAssembly) -> f64 {
    design.distinct.first().map_or(0.0, |part| part.shape.band)
}

/// A circle in quarters, so that its chords have corners where it is widest and highest.
fn circle(center: Point, radius: f64) -> Path {
    let quarter = |i: f64| Arc::new(center, radius, i * FRAC_PI_2, FRAC_PI_2).into();
    Path::closed([0.0, 1.0, 2.0, 3.0].map(quarter).into())
}
