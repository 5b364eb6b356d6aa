//! The scene of a drawn piece: one piece, flat or as the shell inflates it, and the sheets beside it.

use crate::design::{Design, DrawnPiece, Layer};
use crate::emit::palette::SURFACES;
use crate::emit::scene::glb::{Glb, Node};
use crate::emit::scene::mesh::{Mesh, index};
use crate::emit::scene::{ABOVE, SceneSurface, SheetSurfaces, material, sheets};
use crate::forecast::drawn::Surface;
use crate::spec::Spec;
use crate::units::Length;
use inflatable::geom::Path;

/// The surfaces of such a scene: materials are numbered by this.
const DRAWN: [SceneSurface; 4] =
    [SceneSurface::Fabric, SceneSurface::Tube, SceneSurface::OuterBand, SceneSurface::Cut];
const FABRIC: usize = 0;
const TUBE: usize = 1;
const BAND: usize = 2;
const CUT: usize = 3;

/// `piece` of `design`, its chambers `inflated` to these surfaces, or flat if there are none, and the sheets; `None` where lyon has no
/// triangles for it. An inflated piece is shown without its flaps and bands, which the shell does not model.
pub fn drawn_scene(
    spec: &Spec,
    design: &Design,
    piece: &DrawnPiece,
    inflated: &[Surface],
) -> Option<Vec<u8>> {
    let mut glb = Glb::default();
    let bounds = piece.part.outside.bounds();
    let middle = bounds.center();
    let rise =
        inflated.iter().flat_map(|surface| &surface.points).map(|[_, _, z]| mm(*z)).fold(0.0, f64::max);
    let parts = if inflated.is_empty() { flat(piece)? } else { vec![(TUBE, surface(inflated))] };
    let mesh = glb.mesh("fabric of a piece", &parts);
    let node = Node { name: "piece".to_owned(), mesh, at: [-middle.x, -middle.y, rise], turn: 0.0 };
    let surfaces = SheetSurfaces { fabric: FABRIC, cut: CUT, bands: &[(BAND, Layer::Seal)] };
    let reach = 0.5 * bounds.width().max(bounds.height());
    let sheets = sheets(&mut glb, design, (reach, piece.shape.band), &surfaces)?;
    let groups = [("pieces", 1), ("sheets", sheets.len())];
    let used = DRAWN.map(|surface| material(&SURFACES[surface as usize]));
    let nodes: Vec<Node> = std::iter::once(node).chain(sheets).collect();
    // Validators remark on a material without use.
    let materials = if inflated.is_empty() || !design.sheets.is_empty() { &used[..] } else { &used[..=TUBE] };
    Some(glb.finish(&spec.name, &nodes, &groups, materials))
}

/// The piece as it is cut: fabric around the air, the air, and bands.
fn flat(piece: &DrawnPiece) -> Option<Vec<(usize, Mesh)>> {
    let around: Vec<Path> =
        [&piece.part.outside].into_iter().chain(&piece.part.inside).chain(&piece.air).cloned().collect();
    let bands = piece.shape.seams.iter().try_fold(Mesh::default(), |mut all, seam| {
        all.append(Mesh::ribbon(&seam.center_line, piece.shape.band, ABOVE)?);
        Some(all)
    })?;
    Some(vec![(FABRIC, Mesh::fill(&around, 0.0)?), (TUBE, Mesh::fill(&piece.air, 0.0)?), (BAND, bands)])
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
