//! The scene of drawn pieces: each once, flat or as the shell inflates it, where it is drawn, and the sheets beside them.

use crate::emit::palette::SceneSurface;
use crate::emit::scene::glb::{Glb, Node};
use crate::emit::scene::mesh::{Mesh, index};
use crate::emit::scene::sheets;
use design::{Design, DrawnPieces, Layer};
use forecast::drawn::Surface;
use geom::Path;
use spec::Spec;
use spec::units::Length;

/// The surfaces of such a scene.
const DRAWN: [SceneSurface; 4] =
    [SceneSurface::Fabric, SceneSurface::Tube, SceneSurface::OuterBand, SceneSurface::Cut];

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
    let parts = if inflated.is_empty() {
        flat(pieces, spec.seal.band.0)?
    } else {
        vec![(SceneSurface::Tube, surface(inflated))]
    };
    let mesh = glb.mesh("fabric of a piece", &parts);
    let node = Node { name: "piece".to_owned(), mesh, at: [-middle.x, -middle.y, rise], turn: 0.0 };
    let reach = 0.5 * bounds.width().max(bounds.height());
    let bands = [(SceneSurface::OuterBand, Layer::Seal)];
    let sheet_nodes = sheets(&mut glb, design, (reach, spec.seal.band.0), &bands)?;
    // Validators remark on a material without use.
    let surface_count = if inflated.is_empty() || !sheet_nodes.is_empty() { DRAWN.len() } else { 2 };
    Some(glb.finish(&spec.name, &[("pieces", vec![node]), ("sheets", sheet_nodes)], surface_count))
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
