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
pub(super) fn jet(point: &GaussPoint, x: &[f64; WIDTH]) -> Jet {
    let mut derivatives = [0.0; 6];
    for (i, n) in point.shape.iter().enumerate() {
        for (part, shift) in [0, TO_Z].into_iter().enumerate() {
            let [a, b, c, d] = OF_Q.map(|place| x[place + shift]);
            derivatives[i + 3 * part] = n[0] * a + n[1] * b + n[2] * c + n[3] * d;
        }
    }
    derivatives
}

/// The unknowns of element number `element` among all of them.
pub(super) fn of_element(x: &[f64], element: usize) -> &[f64; WIDTH] {
    x[4 * element..].first_chunk().unwrap_or(&[0.0; WIDTH])
}

/// Pi at the shape `x`; `None` where the sheet would cross the axis, or a value is not finite.
pub(super) fn value(scales: &Scales, mesh: &MeridianMesh, lambda: f64, x: &[f64]) -> Option<f64> {
    let mut sum = 0.0;
    for (element, points) in mesh.elements.iter().enumerate() {
        let nodal = of_element(x, element);
        for point in points {
            let jet_here = jet(point, nodal);
            let [q, slope, _, z, ..] = jet_here;
            if q <= 0.0 {
                return None;
            }
            let strains = Strains::new(scales, point.radius, lambda, &jet_here);
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
    /// Vertical force that holds the inner rim down, per flat angle, in units of p W^2: the force that opens the seal.
    pub(super) reaction: f64,
}

/// A block of an element's Hessian, by its four unknowns of Q or of z.
type Block = [[f64; 4]; 4];

/// The contribution of one element: gradient by Q and by z; Hessian blocks of Q twice, of Q and z, of z twice.
#[derive(Default)]
struct Element {
    gradient: [[f64; 4]; 2],
    mixed: [[f64; 4]; 2],
    blocks: [Block; 3],
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
            let (unknowns, mut sums) = (of_element(x, number), Element::default());
            for point in points {
                let density_here = density(scales, point.radius, lambda, &jet(point, unknowns), exact);
                self.slope += point.area * density_here.slope;
                self.curvature += point.area * density_here.curvature;
                sums.add(point, &density_here.gradient, &density_here.mixed, &density_here.hessian);
            }
            self.add(4 * number, &sums);
        }
        self.reaction = -self.gradient[TO_Z];
        for pinned in mesh.pinned() {
            (self.gradient[pinned], self.mixed[pinned]) = (0.0, 0.0);
            self.hessian.pin(pinned);
        }
    }

    /// Adds the contribution of `element` to the unknowns from number `first` on.
    fn add(&mut self, first: usize, element: &Element) {
        let [qq, qz, zz] = &element.blocks;
        for (l, row) in OF_Q.into_iter().enumerate() {
            for (part, shift) in [0, TO_Z].into_iter().enumerate() {
                self.gradient[first + row + shift] += element.gradient[part][l];
                self.mixed[first + row + shift] += element.mixed[part][l];
            }
            for (k, column) in OF_Q.into_iter().enumerate() {
                if column <= row {
                    *self.hessian.entry(first + row, row - column) += qq[l][k];
                    *self.hessian.entry(first + row + TO_Z, row - column) += zz[l][k];
                }
                let (low, high) = (row.min(column + TO_Z), row.max(column + TO_Z));
                *self.hessian.entry(first + high, high - low) += qz[l][k];
            }
        }
    }
}

impl Element {
    /// Adds a point's density.
    #[inline]
    fn add(&mut self, point: &GaussPoint, gradient: &Jet, mixed: &Jet, h: &[Jet; 6]) {
        let n = &point.shape;
        let weighted = n.map(|row| row.map(|n| point.area * n));
        let [g0, g1, g2, g3, g4, g5] = *gradient;
        add(&mut self.gradient[0], by_unknowns(&weighted, [g0, g1, g2]));
        add(&mut self.gradient[1], by_unknowns(&weighted, [g3, g4, g5]));
        let [m0, m1, m2, m3, m4, m5] = *mixed;
        add(&mut self.mixed[0], by_unknowns(&weighted, [m0, m1, m2]));
        add(&mut self.mixed[1], by_unknowns(&weighted, [m3, m4, m5]));
        let [qq, qz, zz] = &mut self.blocks;
        twice(qq, n, &weighted, block(h, [0, 1, 2], [0, 1, 2]));
        twice(qz, n, &weighted, block(h, [0, 1, 2], [3, 4, 5]));
        twice(zz, n, &weighted, block(h, [3, 4, 5], [3, 4, 5]));
    }
}

/// A block of the symmetric matrix of which `h` has the upper triangle.
#[inline]
fn block(h: &[Jet; 6], rows: [usize; 3], columns: [usize; 3]) -> [[f64; 3]; 3] {
    rows.map(|i| columns.map(|j| if i <= j { h[i][j] } else { h[j][i] }))
}

/// Three derivatives of Q or z, times the contribution of each of the four unknowns to them.
#[inline]
fn by_unknowns(n: &[[f64; 4]; 3], [a, b, c]: [f64; 3]) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for (k, sum) in sums.iter_mut().enumerate() {
        *sum = n[0][k] * a + n[1][k] * b + n[2][k] * c;
    }
    sums
}

/// Adds `h`, second derivatives by three derivatives of Q or z, as second derivatives by unknowns.
#[inline]
fn twice(block: &mut Block, n: &[[f64; 4]; 3], weighted: &[[f64; 4]; 3], h: [[f64; 3]; 3]) {
    let rows = h.map(|row| by_unknowns(weighted, row));
    for (l, row) in block.iter_mut().enumerate() {
        add(row, by_unknowns(&rows, [n[0][l], n[1][l], n[2][l]]));
    }
}

#[inline]
fn add(totals: &mut [f64; 4], addends: [f64; 4]) {
    totals.iter_mut().zip(addends).for_each(|(total, addend)| *total += addend);
}
