//! A triangle stretched in its plane: constant strain, St Venant-Kirchhoff, plane stress.
//!
//! With the deformation gradient F = (f1, f2) and the strain E = (F^T F - I)/2 the energy is
//! A Y/(1 - nu^2) [E11^2 + E22^2 + 2 nu E11 E22 + 2 (1 - nu) E12^2]/2, plus the contribution of a weave.

use crate::shell::element::vector::{Vector, dot, minus};
use crate::shell::element::{Fabric, Square, Weave, weave};

/// The flat triangle: how a field given at its corners grows across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flat {
    /// Area.
    pub area: f64,
    /// Slopes of the three linear functions that are 1 at one corner and 0 at the others.
    pub slopes: [[f64; 2]; 3],
}

impl Flat {
    /// The flat triangle with these corners, counterclockwise.
    pub fn new(corners: [[f64; 2]; 3]) -> Self {
        let [a, b, c] = corners;
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        let slopes = [(b, c), (c, a), (a, b)]
            .map(|(start, end)| [(start[1] - end[1]) / twice, (end[0] - start[0]) / twice]);
        Self { area: twice / 2.0, slopes }
    }
}

/// A stretched triangle: deformation gradient, strain and stress.
#[derive(Clone, Copy, Debug)]
pub struct Membrane {
    columns: [Vector; 2],
    /// Strain E11, E22, 2 E12 in the axes of the flat sheet.
    pub strain: [f64; 3],
    /// Second Piola-Kirchhoff stress resultants S11, S22, S12, force a unit of flat length.
    pub stress: [f64; 3],
    /// Derivatives of the stress by E11, E22, 2 E12 if they differ from the elastic ones.
    tangent: Option<[[f64; 3]; 3]>,
}

impl Membrane {
    /// The triangle `flat` with its corners at `corners`.
    pub fn new(fabric: Fabric, flat: &Flat, corners: [Vector; 3]) -> Self {
        let (first, second) = (minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        let columns: [Vector; 2] = [0, 1].map(|axis| {
            std::array::from_fn(|c| flat.slopes[1][axis] * first[c] + flat.slopes[2][axis] * second[c])
        });
        let strain = [
            (dot(columns[0], columns[0]) - 1.0) / 2.0,
            (dot(columns[1], columns[1]) - 1.0) / 2.0,
            dot(columns[0], columns[1]),
        ];
        let [plane, shear] = moduli(fabric);
        let nu = fabric.poisson;
        let mut stress =
            [plane * (strain[0] + nu * strain[1]), plane * (strain[1] + nu * strain[0]), shear * strain[2]];
        let mut tangent = None;
        if let Some(added) = weave::membrane(fabric) {
            let mut response = isotropic([plane, shear], nu);
            for i in 0..3 {
                for j in 0..3 {
                    stress[i] += added[i][j] * strain[j];
                    response[i][j] += added[i][j];
                }
            }
            tangent = Some(response);
        }
        Self { columns, strain, stress, tangent }
    }

    /// The response of a sheet that gives way to compression in fine wrinkles: where one principal stress would be compressive only the
    /// other is left, Y E_1, and where both would be, none. `remaining` is the part of the elastic response that remains besides. The weave
    /// is left out.
    ///
    /// The energy is the largest convex one below the elastic one: Pipkin, "The relaxed energy density for isotropic elastic membranes"
    /// (1986).
    pub fn wrinkled(fabric: Fabric, flat: &Flat, corners: [Vector; 3], remaining: f64) -> Self {
        let fabric = fabric.woven(Weave::ISOTROPIC);
        let elastic = Self::new(fabric, flat, corners);
        let [e11, e22, double] = elastic.strain;
        let (mean, half) = (f64::midpoint(e11, e22), libm::hypot((e11 - e22) / 2.0, double / 2.0));
        let (tension, compression) = (mean + half, mean - half);
        let nu = fabric.poisson;
        if compression + nu * tension >= 0.0 && tension > 0.0 {
            return elastic;
        }
        let [plane, shear] = moduli(fabric);
        let mut tangent = isotropic([plane, shear], nu).map(|row| row.map(|c| remaining * c));
        let mut stress = elastic.stress.map(|s| remaining * s);
        if tension > 0.0 {
            let (sine, cosine) = libm::sincos(0.5 * libm::atan2(double, e11 - e22));
            // E_1 by E11, E22, 2 E12; and by how much its direction turns.
            let grows = [cosine * cosine, sine * sine, sine * cosine];
            let turns = [-sine * cosine, sine * cosine, 0.5 * (cosine * cosine - sine * sine)];
            let tension_stiffness = (1.0 - remaining) * fabric.stretch;
            let turning_stiffness = tension_stiffness * tension / half;
            for i in 0..3 {
                stress[i] += tension_stiffness * tension * grows[i];
                for j in 0..3 {
                    tangent[i][j] +=
                        tension_stiffness * grows[i] * grows[j] + turning_stiffness * turns[i] * turns[j];
                }
            }
        }
        Self { stress, tangent: Some(tangent), ..elastic }
    }

    /// Energy of the triangle.
    pub fn energy(&self, flat: &Flat) -> f64 {
        let product: f64 = self.strain.iter().zip(&self.stress).map(|(e, s)| e * s).sum();
        flat.area * product / 2.0
    }

    /// Adds the gradient of its energy to that of its corners.
    pub fn add_gradient(&self, flat: &Flat, gradient: &mut [f64; 9]) {
        let [s11, s22, s12] = self.stress;
        for (k, slope) in flat.slopes.iter().enumerate() {
            let first = flat.area * (s11 * slope[0] + s12 * slope[1]);
            let second = flat.area * (s12 * slope[0] + s22 * slope[1]);
            for c in 0..3 {
                gradient[3 * k + c] += first * self.columns[0][c] + second * self.columns[1][c];
            }
        }
    }

    /// Gradients of E11, E22 and 2 E12, and the change of the stress with each: their products sum to the Hessian's first part.
    pub fn rows(&self, fabric: Fabric, flat: &Flat) -> ([[f64; 9]; 3], [[f64; 9]; 3]) {
        let [plane, shear] = moduli(fabric).map(|modulus| modulus * flat.area);
        let nu = fabric.poisson;
        let (mut strain, mut stress) = ([[0.0; 9]; 3], [[0.0; 9]; 3]);
        for (k, slope) in flat.slopes.iter().enumerate() {
            for c in 0..3 {
                let (f1, f2) = (self.columns[0][c], self.columns[1][c]);
                let (e11, e22) = (slope[0] * f1, slope[1] * f2);
                let e12 = slope[1] * f1 + slope[0] * f2;
                for (row, value) in strain.iter_mut().zip([e11, e22, e12]) {
                    row[3 * k + c] = value;
                }
                let answers = match self.tangent {
                    None => [plane * (e11 + nu * e22), plane * (e22 + nu * e11), shear * e12],
                    Some(c) => c.map(|c| flat.area * (c[0] * e11 + c[1] * e22 + c[2] * e12)),
                };
                for (row, value) in stress.iter_mut().zip(answers) {
                    row[3 * k + c] = value;
                }
            }
        }
        (strain, stress)
    }

    /// The response without compression: principal stresses below zero are zero.
    #[must_use]
    pub fn tensile(self) -> Self {
        let [s11, s22, s12] = self.stress;
        let (mean, half) = (f64::midpoint(s11, s22), libm::hypot((s11 - s22) / 2.0, s12));
        if mean >= half {
            return self;
        }
        let part = if half > 0.0 { (mean + half).max(0.0) / (2.0 * half) } else { 0.0 };
        let deviator = (s11 - s22) / 2.0;
        Self { stress: [part * (half + deviator), part * (half - deviator), part * s12], ..self }
    }

    /// Adds the Hessian's second part: the present stress on changes of the strain of second order.
    pub fn add_geometric(&self, flat: &Flat, hessian: &mut Square) {
        let [s11, s22, s12] = self.stress;
        for (k, at) in flat.slopes.iter().enumerate() {
            for (l, of) in flat.slopes.iter().enumerate() {
                let along = s11 * at[0] * of[0] + s22 * at[1] * of[1];
                let across = s12 * (at[0] * of[1] + at[1] * of[0]);
                for c in 0..3 {
                    hessian[3 * k + c][3 * l + c] += flat.area * (along + across);
                }
            }
        }
    }

    /// The force a unit of flat length across a line with this flat unit normal.
    pub fn traction(&self, normal: [f64; 2]) -> f64 {
        let [s11, s22, s12] = self.stress;
        let first = s11 * normal[0] + s12 * normal[1];
        let second = s12 * normal[0] + s22 * normal[1];
        let force: Vector = std::array::from_fn(|c| first * self.columns[0][c] + second * self.columns[1][c]);
        dot(force, force).sqrt()
    }

    /// True tension (force a unit of deformed length) along its two principal directions, larger first, and the
    /// stretches along them.
    pub fn principal(&self) -> [[f64; 2]; 2] {
        let [s11, s22, s12] = self.stress;
        let turn = 0.5 * libm::atan2(2.0 * s12, s11 - s22);
        let (sine, cosine) = libm::sincos(turn);
        let (mean, half) = (f64::midpoint(s11, s22), libm::hypot((s11 - s22) / 2.0, s12));
        let [e11, e22, e12] = self.strain;
        let stretches = [(cosine, sine), (-sine, cosine)]
            .map(|(x, y)| (1.0 + 2.0 * (x * x * e11 + y * y * e22 + x * y * e12)).max(0.0).sqrt());
        let tension =
            [(mean + half) * stretches[0] / stretches[1], (mean - half) * stretches[1] / stretches[0]];
        [tension, stretches]
    }
}

/// Derivatives of the stress of an isotropic sheet by E11, E22, 2 E12.
fn isotropic([plane, shear]: [f64; 2], nu: f64) -> [[f64; 3]; 3] {
    [[plane, nu * plane, 0.0], [nu * plane, plane, 0.0], [0.0, 0.0, shear]]
}

/// Y/(1 - nu^2) and the shear modulus Y/(2 (1 + nu)).
fn moduli(fabric: Fabric) -> [f64; 2] {
    let nu = fabric.poisson;
    [fabric.stretch / (1.0 - nu * nu), fabric.stretch / (2.0 * (1.0 + nu))]
}
