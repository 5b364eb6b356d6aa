//! The scene of drawn pieces: each once, flat or as the shell inflates it, with its measures, where it is drawn, and the sheets beside them.

use crate::emit::palette::SceneSurface;
use crate::emit::scene::glb::{Glb, Node};
use crate::emit::scene::mesh::{Mesh, index};
use crate::emit::scene::sheets;
use design::{Design, DrawnPieces, Layer, Measure};
use forecast::drawn::Surface;
use geom::{Path, Vec2};
use spec::Spec;
use spec::units::Length;

/// The surfaces of such a scene.
const DRAWN: [SceneSurface; 5] = [
    SceneSurface::Fabric,
    SceneSurface::Tube,
    SceneSurface::OuterBand,
    SceneSurface::Cut,
    SceneSurface::Measure,
];
/// Radius of the wire that shows a measure, mm: as wide as a narrow band.
const WIRE: f64 = 0.8;

/// `pieces` of `design`, their chambers `inflated` to these surfaces, or flat if there are none, and the sheets; `None` where lyon has no
/// triangles for them. An inflated piece is shown without its flaps and bands, which the shell does not model.
pub fn drawn_scene(
    spec: &Spec,
    design: &Design,
    pieces: &DrawnPieces,
    inflated: &[Surface],
) -> Option<Vec<u8>> {
    let mut glb = Glb::new(&DRAWN);
    let bounds = pieces.bounds();
    let middle = bounds.center();
    let rise =
        inflated.iter().flat_map(|surface| &surface.points).map(|[_, _, z]| mm(*z)).fold(0.0, f64::max);
    let origin = [-middle.x, -middle.y, rise];
    let (parts, measure_nodes) = if inflated.is_empty() {
        (flat(pieces, spec.seal.band.0)?, Vec::new())
    } else {
        let fabric = surface(inflated);
        let measure_nodes = measures(&mut glb, &pieces.measures, &fabric, origin);
        (vec![(SceneSurface::Tube, fabric)], measure_nodes)
    };
    let mesh = glb.mesh("fabric of a piece", &parts);
    let node = Node { name: "piece".to_owned(), mesh, at: origin, turn: 0.0 };
    let reach = 0.5 * bounds.width().max(bounds.height());
    let bands = [(SceneSurface::OuterBand, Layer::Seal)];
    let sheet_nodes = sheets(&mut glb, design, (reach, spec.seal.band.0), &bands)?;
    // Validators remark on a material without use.
    let surface_count = DRAWN.len() - usize::from(measure_nodes.is_empty());
    let groups = [("pieces", vec![node]), ("measures", measure_nodes), ("sheets", sheet_nodes)];
    Some(glb.finish(&spec.name, &groups, surface_count))
}

/// Each of the `measures` as a wire on the inflating `fabric`, by its name; the fabric lies at `origin`.
fn measures(glb: &mut Glb, measures: &[Measure], fabric: &Mesh, origin: [f64; 3]) -> Vec<Node> {
    let node = |measure: &Measure| {
        let wire = match measure.form.points() {
            [point] => {
                let half = Vec2::new(2.0 * WIRE, 0.0);
                fabric.wire(&[*point - half, *point + half], WIRE)
            }
            points => fabric.wire(points, WIRE),
        };
        let mesh = glb.mesh(&measure.name, &[(SceneSurface::Measure, wire)]);
        Node { name: measure.name.clone(), mesh, at: origin, turn: 0.0 }
    };
    measures.iter().map(node).collect()
}

/// The pieces as they are cut: fabric around the air, the air, and bands.
fn flat(pieces: &DrawnPieces, band: f64) -> Option<Vec<(SceneSurface, Mesh)>> {
    let (mut fabric, mut air, mut bands) = (Mesh::default(), Mesh::default(), Mesh::default());
    for piece in &pieces.pieces {
        let boundaries: Vec<Path> =
            [&piece.part.outside].into_iter().chain(&piece.part.inside).chain(&piece.air).cloned().collect();
        let seams: Vec<Path> = piece.shape.seams.iter().map(|seam| seam.center_line.clone()).collect();
        fabric.append(Mesh::fill(&boundaries, 0.0)?);
        air.append(Mesh::fill(&piece.air, 0.0)?);
        bands.append(Mesh::ribbons(&seams, band)?);
    }
    Some(vec![(SceneSurface::Fabric, fabric), (SceneSurface::Tube, air), (SceneSurface::OuterBand, bands)])
}

fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

/// Both sheets of all chambers, from flat to inflated.
fn surface(inflated: &[Surface]) -> Mesh {
    let mut mesh = Mesh::default();
    for surface in inflated {
        mesh.append(Mesh {
            points: surface.flat.iter().map(|[x, y]| [mm(*x), mm(*y), 0.0]).collect(),
            inflated: surface.points.iter().map(|at| at.map(mm)).collect(),
            triangles: surface.triangles.iter().map(|corners| corners.map(index)).collect(),
        });
    }
    mesh
}
