//! The scene of a drawn piece: one piece, flat or as the shell inflates it, and the sheets beside it.

use crate::emit::palette::SceneSurface;
use crate::emit::scene::glb::{Glb, Node};
use crate::emit::scene::mesh::{Mesh, index};
use crate::emit::scene::sheets;
use design::{Design, DrawnPiece, Layer};
use forecast::drawn::Surface;
use geom::Path;
use spec::Spec;
use spec::units::Length;

/// The surfaces of such a scene.
const DRAWN: [SceneSurface; 4] =
    [SceneSurface::Fabric, SceneSurface::Tube, SceneSurface::OuterBand, SceneSurface::Cut];

/// `piece` of `design`, its chambers `inflated` to these surfaces, or flat if there are none, and the sheets; `None` where lyon has no
/// triangles for it. An inflated piece is shown without its flaps and bands, which the shell does not model.
pub fn drawn_scene(
    spec: &Spec,
    design: &Design,
    piece: &DrawnPiece,
    inflated: &[Surface],
) -> Option<Vec<u8>> {
    let mut glb = Glb::new(&DRAWN);
    let bounds = piece.part.outside.bounds();
    let middle = bounds.center();
    let rise =
        inflated.iter().flat_map(|surface| &surface.points).map(|[_, _, z]| mm(*z)).fold(0.0, f64::max);
    let parts =
        if inflated.is_empty() { flat(piece)? } else { vec![(SceneSurface::Tube, surface(inflated))] };
    let mesh = glb.mesh("fabric of a piece", &parts);
    let node = Node { name: "piece".to_owned(), mesh, at: [-middle.x, -middle.y, rise], turn: 0.0 };
    let reach = 0.5 * bounds.width().max(bounds.height());
    let bands = [(SceneSurface::OuterBand, Layer::Seal)];
    let sheets = sheets(&mut glb, design, (reach, piece.shape.band), &bands)?;
    // Validators remark on a material without use.
    let used = if inflated.is_empty() || !sheets.is_empty() { DRAWN.len() } else { 2 };
    Some(glb.finish(&spec.name, &[("pieces", vec![node]), ("sheets", sheets)], used))
}

/// The piece as it is cut: fabric around the air, the air, and bands.
fn flat(piece: &DrawnPiece) -> Option<Vec<(SceneSurface, Mesh)>> {
    let around: Vec<Path> =
        [&piece.part.outside].into_iter().chain(&piece.part.inside).chain(&piece.air).cloned().collect();
    let seams: Vec<Path> = piece.shape.seams.iter().map(|seam| seam.center_line.clone()).collect();
    Some(vec![
        (SceneSurface::Fabric, Mesh::fill(&around, 0.0)?),
        (SceneSurface::Tube, Mesh::fill(&piece.air, 0.0)?),
        (SceneSurface::OuterBand, Mesh::ribbons(&seams, piece.shape.band)?),
    ])
}

fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

/// Both sheets of all chambers, from flat to inflated.
fn surface(inflated: &[Surface]) -> Mesh {
    let mut all = Mesh::default();
    for surface in inflated {
        all.append(Mesh {
            points: surface.flat.iter().map(|[x, y]| [mm(*x), mm(*y), 0.0]).collect(),
            inflated: surface.points.iter().map(|at| at.map(mm)).collect(),
            triangles: surface.triangles.iter().map(|corners| corners.map(index)).collect(),
        });
    }
    all
}
