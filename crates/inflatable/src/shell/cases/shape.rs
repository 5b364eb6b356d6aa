//! An inflated sheet to be looked at.

use crate::shell::assembly::State;
use crate::shell::cases::tube::Tube;
use crate::shell::mesh::{FieldFault, Mesh, VtuField, vtu};
use crate::shell::solver::Solver;

/// The sheet that was modelled, on its finest mesh: the rest of the tube is its mirror images. SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InflatedShape {
    /// Positions of the points, m.
    pub points: Vec<[f64; 3]>,
    /// Their positions on the flat sheet, m.
    pub flat: Vec<[f64; 2]>,
    /// The points of each triangle.
    pub triangles: Vec<[usize; 3]>,
    /// Principal tensions of each triangle, N/m; the larger first. Below 0 it is compressed.
    pub tension: Vec<[f64; 2]>,
    /// Stretches along them.
    pub stretch: Vec<[f64; 2]>,
    /// Principal curvatures of each triangle, 1/m; the larger in size first.
    pub curvature: Vec<[f64; 2]>,
}

impl InflatedShape {
    /// `state` of `solver`.
    pub(crate) fn new(tube: &Tube, solver: &mut Solver, mesh: &Mesh, state: &State) -> Self {
        let w = tube.width;
        let kappa = solver.assembly.curvatures(state);
        let sheet = &solver.assembly.sheet;
        let principal: Vec<[[f64; 2]; 2]> = (mesh.triangles.iter().enumerate())
            .map(|(triangle, corners)| {
                let corners = corners.map(|corner| state.points[corner]);
                sheet.stretched(triangle, corners).principal()
            })
            .collect();
        Self {
            points: state.points.iter().map(|x| x.map(|x| x * w)).collect(),
            flat: mesh.points.iter().map(|x| x.map(|x| x * w)).collect(),
            triangles: mesh.triangles.clone(),
            tension: principal.iter().map(|[tension, _]| tension.map(|t| t * tube.fabric.stretch)).collect(),
            stretch: principal.iter().map(|[_, stretch]| *stretch).collect(),
            curvature: kappa.into_iter().map(|kappa| curvatures(kappa).map(|k| k / w)).collect(),
        }
    }

    /// Several sheets as one.
    #[must_use]
    pub fn joined(shapes: &[Self]) -> Self {
        let mut union = Self::default();
        for shape in shapes {
            let offset = union.points.len();
            union.points.extend(&shape.points);
            union.flat.extend(&shape.flat);
            union
                .triangles
                .extend(shape.triangles.iter().map(|corners| corners.map(|corner| corner + offset)));
            union.tension.extend(&shape.tension);
            union.stretch.extend(&shape.stretch);
            union.curvature.extend(&shape.curvature);
        }
        union
    }

    /// The text of a VTU file: lengths in mm, tensions in N/m, curvatures in 1/m.
    ///
    /// # Errors
    /// If its parts do not fit each other.
    pub fn vtu(&self) -> Result<String, FieldFault> {
        let points: Vec<[f64; 3]> = self.points.iter().map(|point| point.map(|x| 1e3 * x)).collect();
        let flat: Vec<f64> = self.flat.iter().flat_map(|[x, y]| [1e3 * x, 1e3 * y, 0.0]).collect();
        let fields = [
            ("stretch", column(&self.stretch, 0)),
            ("least stretch", column(&self.stretch, 1)),
            ("tension, N/m", column(&self.tension, 0)),
            ("least tension, N/m", column(&self.tension, 1)),
            ("curvature, 1/m", column(&self.curvature, 0)),
            ("other curvature, 1/m", column(&self.curvature, 1)),
        ];
        let fields = fields.each_ref().map(|(name, values)| VtuField { name, components: 1, values });
        vtu(&points, &self.triangles, &[VtuField { name: "flat, mm", components: 3, values: &flat }], &fields)
    }
}

fn column(pairs: &[[f64; 2]], index: usize) -> Vec<f64> {
    pairs.iter().map(|pair| pair[index]).collect()
}

/// The eigenvalues of a shape operator, the larger in size first.
fn curvatures([k11, k22, k12]: [f64; 3]) -> [f64; 2] {
    let (mean, half) = (f64::midpoint(k11, k22), libm::hypot((k11 - k22) / 2.0, k12));
    if mean < 0.0 { [mean - half, mean + half] } else { [mean + half, mean - half] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curvatures_are_those_of_a_turned_cylinder() {
        let (sine, cosine) = 0.3_f64.sin_cos();
        let [principal, straight] =
            curvatures([-2.0 * cosine * cosine, -2.0 * sine * sine, -2.0 * sine * cosine]);
        assert!((principal + 2.0).abs() < 1e-14 && straight.abs() < 1e-14, "{principal} {straight}");
    }
}
