//! The modelled part of a star: half a sector of one sheet, between the plane of symmetry of a reentrant corner and that of a tip. All
//! others are its images. It stands for a star of isotropic fabric, or of a weave that both planes leave as it is.

use crate::shell::assembly::{Plane, State, Supports};
use crate::shell::cases::arm_line::ArmLine;
use crate::shell::contact::Obstacle;
use crate::shell::mesh::{Border, HalfSector, MarginWidths, Mesh, MeshFault, Meshed, Sizes, distance, rim};

/// Half a sector of a star whose lengths are divided by W.
#[derive(Clone, Copy, Debug)]
pub struct ModelledSector {
    pub(super) sector: HalfSector,
    /// Width beyond its rims.
    pub(super) margin: MarginWidths,
}

/// Distance from a ray within which a flat point counts as on it, W.
const ON_RAY: f64 = 1e-7;

impl ModelledSector {
    /// The tip's plane of symmetry among the obstacles.
    pub(super) const TIP: usize = 1;

    /// The mesh with edges of these lengths, by W.
    ///
    /// # Errors
    /// If it has no mesh.
    pub fn meshed(&self, sizes: &Sizes) -> Result<Meshed, MeshFault> {
        self.sector.mesh_with(sizes, self.margin)
    }

    /// Walls where arms meet their images, and last the object, as yet of no size.
    pub fn obstacles(&self) -> Vec<Obstacle> {
        let post = Obstacle::Post { radius: 0.0 };
        self.planes().into_iter().map(Obstacle::Wall).chain([post]).collect()
    }

    fn planes(&self) -> [Plane; 2] {
        [Plane::first(), Plane::second(self.sector.half_angle())]
    }

    /// The planes of symmetry of `mesh`.
    pub fn supports(&self, mesh: &Mesh) -> Supports {
        Supports::new(mesh, self.planes().to_vec())
    }

    /// The number of copies of half a sector of one sheet in the star.
    pub fn count(&self) -> f64 {
        4.0 * f64::from(self.sector.n)
    }

    /// Distances from the axis in `state`: of the apex of the corner's inner rim, and of the cut edge in front of it, which is the apex
    /// where there is no margin.
    pub(super) fn corner_radii(&self, mesh: &Mesh, state: &State) -> [f64; 2] {
        let apex = nearest(mesh, [self.sector.rho_0, 0.0], Border::Rim(rim::INNER));
        let has_margin = self.margin.inner > 0.0;
        let edge_place = [self.sector.rho_0 - self.margin.inner, 0.0];
        let edge = if has_margin { nearest(mesh, edge_place, Border::Free) } else { apex };
        [apex, edge].map(|point| state.points[point][0])
    }

    /// Twice the angle between the tip's ray and the line of its arm, which leaves out one W at each hinge, or a third of a short arm.
    pub(super) fn tip_angle(&self, mesh: &Mesh, state: &State) -> f64 {
        let sector = &self.sector;
        let half_angle = sector.half_angle();
        let arm_angle = sector.phi_i / 2.0 + half_angle;
        let start = (sector.rho_0 + sector.w + sector.r_e) * libm::cos(arm_angle);
        let l = sector.l();
        let left_out = (l / 3.0).min(1.0);
        let reach = [start + left_out, start + l - left_out];
        let (sine, cosine) = libm::sincos(arm_angle);
        let [x, y] = ArmLine::new(mesh, [cosine, sine], reach).direction(state);
        2.0 * (libm::atan2(y, x) - half_angle)
    }

    /// Outward displacement of the corner's section: points, and the direction times the flat length of each.
    pub(super) fn section(&self, mesh: &Mesh) -> Vec<(usize, [f64; 3])> {
        let HalfSector { rho_0, w, .. } = self.sector;
        // A margin beyond the rims is no part of the section.
        let is_on = |point: usize| {
            let [x, y] = mesh.points[point];
            (rho_0 - ON_RAY..=rho_0 + w + ON_RAY).contains(&x) && y.abs() < ON_RAY
        };
        let mut parts = Vec::new();
        for (edge, ends) in mesh.edges.iter().map(|edge| edge.ends).enumerate() {
            if ends.into_iter().all(is_on) {
                let half = mesh.length(edge) / 2.0;
                parts.extend(ends.map(|end| (end, [half, 0.0, 0.0])));
            }
        }
        parts
    }
}

/// The point of a border that is nearest to `place` on the flat sheet.
fn nearest(mesh: &Mesh, place: [f64; 2], border: Border) -> usize {
    let rim = mesh.border_edges(border).flat_map(|edge| mesh.edges[edge].ends);
    let distances = rim.map(|point| (point, distance(mesh.points[point], place)));
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(point, _)| point)
}
