//! A chamber between two rigid level plates. By symmetry each is one plate above the modelled sheet.

use crate::shell::assembly::State;
use crate::shell::element::volume::projected_area;
use crate::shell::mesh::Mesh;
use crate::shell::solver::Solver;

/// Force on the plate, and the area of the sheet that touches it at the chamber's `pressure`; zeros without a plate.
///
/// A third of each triangle, as it is stretched, belongs to each of its corners. A corner at the edge of the area counts by its part of the
/// pressure, which the plate takes over from the sheet there: by whole corners the area would jump with the mesh.
pub(super) fn force_and_area(solver: &Solver, mesh: &Mesh, state: &State, pressure: f64) -> [f64; 2] {
    let Some(contact) = &solver.contact else { return [0.0; 2] };
    let mut parts = vec![0.0; mesh.points.len()];
    for touching in contact.touching(0, state) {
        parts[touching.point] = (touching.force / (touching.area * pressure)).min(1.0);
    }
    let mut is_edge = vec![false; mesh.points.len()];
    for corners in mesh.triangles.iter().filter(|corners| corners.iter().any(|corner| parts[*corner] == 0.0))
    {
        for corner in corners {
            is_edge[*corner] = true;
        }
    }
    let mut area = 0.0;
    for corners in &mesh.triangles {
        let third = projected_area(corners.map(|corner| state.points[corner])) / 3.0;
        for corner in corners {
            let is_inside = parts[*corner] > 0.0 && !is_edge[*corner];
            area += third * if is_inside { 1.0 } else { parts[*corner] };
        }
    }
    [contact.force(0), area]
}

#[cfg(test)]
mod tests {
    use crate::shell::cases::{Fineness, FlatRegion, InflatedRegion, PlateContact, Watch, chambers, region};
    use crate::shell::element::Fabric;
    use geom::{Line, Path, Point};

    const PRESSURE: f64 = 14e3;

    /// A pouch of film, 20 mm wide and 60 mm long, between plates `gap` apart, m.
    fn pouch(gap: f64) -> InflatedRegion {
        let corners = [[0.0, 0.0], [0.06, 0.0], [0.06, 0.02], [0.0, 0.02]].map(|[x, y]| Point::new(x, y));
        let outline =
            Path::closed((0..4).map(|k| Line::new(corners[k], corners[(k + 1) % 4]).into()).collect());
        let (e, nu, t) = (2e9, 0.39, 0.05e-3_f64);
        let case = FlatRegion {
            chamber: chambers(&[outline], &[], &[]).expect("a chamber").remove(0),
            fabric: Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu),
            pressure: PRESSURE,
            band: 0.003,
            probes: Vec::new(),
            partial: Vec::new(),
            plates: Some(gap),
        };
        region(&case, Fineness { cells: 4.0, cuts: 2 }, &Watch::default()).expect("an equilibrium")
    }

    /// The force is what the energy loses by a wider gap. A sheet leaves a plate along its tangent, so that the plate bears the pressure on the
    /// area that touches it, and at the edge of that area a little more, by which the sheet is bent: 8.7 % for this one.
    #[test]
    fn plates_bear_the_pressure_on_what_touches_them() {
        let gap = 6e-3;
        let [narrow, middle, wide] = [-5e-5, 0.0, 5e-5].map(|change| pouch(gap + change));
        let PlateContact { force, area } = middle.plates.expect("plates");
        let slope = (narrow.energy.meshes[2] - wide.energy.meshes[2]) / 1e-4;
        assert!((force.meshes[2] / slope - 1.0).abs() < 0.005, "{force:?}, by energy {slope}");
        let by_area = force.meshes[2] / (PRESSURE * area.meshes[2]);
        assert!(by_area > 0.98 && by_area < 1.12, "{force:?} on {area:?}");
        assert!((middle.height.meshes[2] / gap - 1.0).abs() < 1e-3, "{:?}", middle.height);
        // Between the ends the section is two half circles with straight lines between.
        let flat_part = 0.02 - std::f64::consts::PI * gap / 2.0;
        let covered = area.meshes[2] / (0.06 * flat_part);
        assert!(covered > 0.7 && covered < 1.05, "{covered}");
    }

    #[test]
    fn plates_that_are_far_apart_bear_nothing() {
        let free = pouch(0.02);
        let PlateContact { force, area } = free.plates.expect("plates");
        assert_eq!((force.value, area.value), (0.0, 0.0));
        assert!(free.height.value < 0.015, "{:?}", free.height);
    }
}
