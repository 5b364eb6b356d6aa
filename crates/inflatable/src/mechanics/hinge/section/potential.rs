//! The potential of one sheet, summed over the meridian, with its exact gradient and Hessian.

use crate::mechanics::hinge::section::density::{Jet, Scales, Strains, density};
use crate::mechanics::hinge::section::mesh::{GaussPoint, MeridianMesh};
use crate::numerics::SymmetricBand;

/// Places of Q, Q' at an element's start and end among its eight unknowns; z, z' are two further on.
const OF_Q: [usize; 4] = [0, 1, 4, 5];
/// From Q to z.
const TO_Z: usize = 2;
/// Unknowns of an element, and so one more than the half band.
pub(super) const WIDTH: usize = 8;

/// The meridian at `point`, from the unknowns `x` of its element.
#[inline]
pub(super) fn jet(point: &GaussPoint, x: &[f64]) -> Jet {
    std::array::from_fn(|i| {
        let shift = if i < 3 { 0 } else { TO_Z };
        point.shape[i % 3].iter().zip(OF_Q).map(|(n, place)| n * x[place + shift]).sum()
    })
}

/// Pi at the shape `x`; `None` where the sheet would cross the axis, or nothing is finite.
pub(super) fn value(scales: &Scales, mesh: &MeridianMesh, lambda: f64, x: &[f64]) -> Option<f64> {
    let mut sum = 0.0;
    for (element, points) in mesh.elements.iter().enumerate() {
        for point in points {
            let at = jet(point, &x[4 * element..]);
            let [q, slope, _, z, ..] = at;
            if q <= 0.0 {
                return None;
            }
            let strains = Strains::of(scales, point.radius, lambda, &at);
            sum += point.area * (strains.energy(scales) - lambda * q * z * slope / point.radius);
        }
    }
    sum.is_finite().then_some(sum)
}

/// The derivatives of Pi at one shape. Pinned unknowns have a gradient of 0 and a row of the identity.
#[derive(Clone, Debug)]
pub(super) struct Potential {
    /// By the shape.
    pub(super) gradient: Vec<f64>,
    /// By the shape twice.
    pub(super) hessian: SymmetricBand<WIDTH>,
    /// By lambda: minus the closing moment of one sheet, in units of p W^3.
    pub(super) slope: f64,
    /// By lambda and the shape.
    pub(super) mixed: Vec<f64>,
    /// By lambda twice, at a fixed shape.
    pub(super) curvature: f64,
    /// Vertical force that holds the inner rim down, per flat angle, in units of p W^2: what opens the seal.
    pub(super) reaction: f64,
}

/// What one element adds.
struct Element {
    gradient: [f64; WIDTH],
    mixed: [f64; WIDTH],
    hessian: [[f64; WIDTH]; WIDTH],
}

impl Potential {
    pub(super) fn new(unknowns: usize) -> Self {
        let zero = vec![0.0; unknowns];
        let hessian = SymmetricBand::zero(unknowns);
        Self { gradient: zero.clone(), hessian, slope: 0.0, mixed: zero, curvature: 0.0, reaction: 0.0 }
    }

    /// Takes all derivatives at the shape `x`; for `exact` see [`density`].
    pub(super) fn assemble(
        &mut self,
        scales: &Scales,
        mesh: &MeridianMesh,
        lambda: f64,
        x: &[f64],
        exact: bool,
    ) {
        (self.slope, self.curvature) = (0.0, 0.0);
        self.gradient.fill(0.0);
        self.mixed.fill(0.0);
        self.hessian.clear();
        for (number, points) in mesh.elements.iter().enumerate() {
            let zero = [0.0; WIDTH];
            let mut own = Element { gradient: zero, mixed: zero, hessian: [zero; WIDTH] };
            for point in points {
                let at = density(scales, point.radius, lambda, &jet(point, &x[4 * number..]), exact);
                self.slope += point.area * at.slope;
                self.curvature += point.area * at.curvature;
                own.add(point, &at.gradient, &at.mixed, &at.hessian);
            }
            for row in 0..WIDTH {
                self.gradient[4 * number + row] += own.gradient[row];
                self.mixed[4 * number + row] += own.mixed[row];
                for column in 0..=row {
                    *self.hessian.entry(4 * number + row, row - column) += own.entry(row, column);
                }
            }
        }
        self.reaction = -self.gradient[TO_Z];
        for pinned in mesh.pinned() {
            (self.gradient[pinned], self.mixed[pinned]) = (0.0, 0.0);
            self.hessian.pin(pinned);
        }
    }
}

impl Element {
    /// Adds a point's density: rows of Q and columns of Q and z, rows of z and columns of z; the rest is symmetric.
    #[inline]
    fn add(&mut self, point: &GaussPoint, gradient: &Jet, mixed: &Jet, hessian: &[Jet; 6]) {
        let n = &point.shape;
        let dot = |k: usize, part: [f64; 3]| n[0][k] * part[0] + n[1][k] * part[1] + n[2][k] * part[2];
        let upper = |i: usize, j: usize| point.area * if i <= j { hessian[i][j] } else { hessian[j][i] };
        for (k, row) in OF_Q.into_iter().enumerate() {
            let both = |jet: &Jet| {
                [dot(k, [jet[0], jet[1], jet[2]]), dot(k, [jet[3], jet[4], jet[5]])].map(|x| point.area * x)
            };
            let ([g_q, g_z], [m_q, m_z]) = (both(gradient), both(mixed));
            self.gradient[row] += g_q;
            self.gradient[row + TO_Z] += g_z;
            self.mixed[row] += m_q;
            self.mixed[row + TO_Z] += m_z;
            // k is the column here: first the Hessian's rows along it, then across the rows.
            let along = |i: usize, j: usize| dot(k, [upper(i, j), upper(i, j + 1), upper(i, j + 2)]);
            let qq = [along(0, 0), along(1, 0), along(2, 0)];
            let qz = [along(0, 3), along(1, 3), along(2, 3)];
            let zz = [along(3, 3), along(4, 3), along(5, 3)];
            for (l, across) in OF_Q.into_iter().enumerate() {
                self.hessian[across][row] += dot(l, qq);
                self.hessian[across][row + TO_Z] += dot(l, qz);
                self.hessian[across + TO_Z][row + TO_Z] += dot(l, zz);
            }
        }
    }

    #[inline]
    fn entry(&self, row: usize, column: usize) -> f64 {
        let is_z = |place: usize| place % 4 >= TO_Z;
        if is_z(row) && !is_z(column) { self.hessian[column][row] } else { self.hessian[row][column] }
    }
}
