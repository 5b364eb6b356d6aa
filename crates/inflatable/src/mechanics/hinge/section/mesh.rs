//! The flat meridian in cubic elements: shorter at the rims, where bending and hoop stress end in layers, and in the
//! middle, where a stiff sheet folds.

use crate::mechanics::hinge::section::ELEMENTS;
use crate::numerics::gauss::gauss_legendre;
use std::sync::LazyLock;

/// Gauss points of an element: exact to degree 7, which the bending of a cubic needs with its weight; with 3 the soft
/// sheets are as good, the stiff ones 10 times worse.
const POINTS: usize = 4;
/// Share of the elements and reach of the layers at the inner and the outer rim, and of the fold at s = 1/2. Tuned on
/// the stiffest sheets: without the fold's share their stiffness is ten times less accurate.
const INNER: GradedLayer = GradedLayer { share: 0.1, reach: 0.01 };
const OUTER: GradedLayer = GradedLayer { share: 0.1, reach: 0.02 };
const FOLD: GradedLayer = GradedLayer { share: 0.15, reach: 0.05 };
/// Flat radius within which a sharp rim is one element. A point on the axis is a singular point: the coiling of a
/// stretching sheet falls with the logarithm of the innermost element, for as long as one makes it smaller. A thousandth
/// of the width is less than any fabric's thickness in range, and below that a sheet is none.
const CORE: f64 = 1e-3;

/// A place where elements are smaller.
#[derive(Clone, Copy, Debug)]
struct GradedLayer {
    share: f64,
    reach: f64,
}

/// One Gauss point of the flat meridian.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GaussPoint {
    /// Distance s from the inner rim, in units of W.
    pub(super) place: f64,
    /// Flat radius w = R* + s.
    pub(super) radius: f64,
    /// Part of the integral of w ds.
    pub(super) area: f64,
    /// Contributions of value and slope at the element's start, and then at its end, to the function here, to its first
    /// and to its second derivative.
    pub(super) shape: [[f64; 4]; 3],
}

/// The flat meridian of one R*.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MeridianMesh {
    /// R*; at 0 the inner rim is a point on the axis.
    pub(super) r_star: f64,
    /// Whether that point is not a seal, but the middle of a disc, which rises.
    pub(super) is_disc: bool,
    /// Places of the nodes, rising from 0 to 1.
    pub(super) nodes: Vec<f64>,
    /// Gauss points of each element.
    pub(super) elements: Vec<[GaussPoint; POINTS]>,
}

impl MeridianMesh {
    /// `count` elements, two or more.
    pub(super) fn new(r_star: f64, count: usize) -> Self {
        Self::with_nodes(r_star, nodes(count))
    }

    /// The mesh on every `step`-th of the nodes, with the core of a sharp rim.
    pub(super) fn coarser(&self, step: usize) -> Self {
        let last = self.nodes.len() - 1;
        let coarse = self.nodes.iter().enumerate().filter(|(i, _)| i % step == 0 || *i == last);
        Self { is_disc: self.is_disc, ..Self::with_nodes(self.r_star, coarse.map(|(_, s)| *s).collect()) }
    }

    fn with_nodes(r_star: f64, mut nodes: Vec<f64>) -> Self {
        if r_star < CORE {
            let core = CORE - r_star;
            nodes.retain(|s| *s == 0.0 || *s > 1.5 * core);
            nodes.insert(1, core);
        }
        let rule = gauss_legendre::<POINTS>();
        let elements = nodes.windows(2).map(|ends| rule.map(|at| point(r_star, [ends[0], ends[1]], at)));
        let elements = elements.collect();
        Self { r_star, is_disc: false, nodes, elements }
    }

    /// A disc's radius, of length 1, from its middle.
    pub(super) fn disc(count: usize) -> Self {
        Self { is_disc: true, ..Self::new(0.0, count) }
    }

    /// Number of unknowns: Q, Q', z, z' at each node.
    pub(super) fn unknowns(&self) -> usize {
        4 * self.nodes.len()
    }

    /// The shape that has the `unknowns` on the nodes of `coarse`, on the nodes of this mesh.
    pub(super) fn refined(&self, coarse: &Self, unknowns: &[f64]) -> Vec<f64> {
        let mut element = 0;
        let mut fine_unknowns = Vec::with_capacity(self.unknowns());
        for &s in &self.nodes {
            while element + 2 < coarse.nodes.len() && coarse.nodes[element + 1] <= s {
                element += 1;
            }
            let h = coarse.nodes[element + 1] - coarse.nodes[element];
            let nodal = &unknowns[4 * element..4 * element + 8];
            for of in [[0, 1, 4, 5], [2, 3, 6, 7]] {
                let shape_functions = cubics((s - coarse.nodes[element]) / h, h);
                fine_unknowns.extend(
                    shape_functions.map(|n| n.iter().zip(of).map(|(n, place)| n * nodal[place]).sum::<f64>()),
                );
            }
        }
        fine_unknowns
    }

    /// Unknowns that are 0: z at both rims, but not in the middle of a disc; at a point on the axis also Q and the slope.
    pub(super) fn pinned(&self) -> impl Iterator<Item = usize> {
        let apex = self.r_star == 0.0;
        let outer = self.unknowns() - 2;
        [(!self.is_disc).then_some(2), Some(outer), apex.then_some(0), apex.then_some(3)]
            .into_iter()
            .flatten()
    }
}

/// Values and slopes at `x` (0 to 1) of an element of length `h`: Hermite's cubics, and their derivatives.
fn cubics(x: f64, h: f64) -> [[f64; 4]; 2] {
    let y = 1.0 - x;
    [
        [(1.0 + 2.0 * x) * y * y, h * x * y * y, x * x * (3.0 - 2.0 * x), -h * x * x * y],
        [-6.0 * x * y / h, y * (1.0 - 3.0 * x), 6.0 * x * y / h, x * (3.0 * x - 2.0)],
    ]
}

/// A Gauss point at `x` with `weight` of the element between `ends`, with Hermite's cubics.
fn point(r_star: f64, ends: [f64; 2], (x, weight): (f64, f64)) -> GaussPoint {
    let h = ends[1] - ends[0];
    let place = ends[0] + h * x;
    let radius = r_star + place;
    let [value, slope] = cubics(x, h);
    GaussPoint {
        place,
        radius,
        area: weight * h * radius,
        shape: [
            value,
            slope,
            [
                (12.0 * x - 6.0) / (h * h),
                (6.0 * x - 4.0) / h,
                (6.0 - 12.0 * x) / (h * h),
                (6.0 * x - 2.0) / h,
            ],
        ],
    }
}

/// [`graded`]; the usual ones are made once.
fn nodes(count: usize) -> Vec<f64> {
    static USUAL: LazyLock<Vec<f64>> = LazyLock::new(|| graded(ELEMENTS));
    if count == ELEMENTS { USUAL.clone() } else { graded(count) }
}

/// Nodes at equal steps of the number of elements, whose density is 1 and the layers' `share / (reach + distance)`.
fn graded(count: usize) -> Vec<f64> {
    let total = element_number(1.0);
    let mut nodes = vec![0.0];
    for i in 1..count {
        #[expect(clippy::cast_precision_loss, reason = "meshes have at most thousands of elements")]
        let number = total * i as f64 / count as f64;
        let (mut low, mut high) = (nodes[i - 1], 1.0);
        // 45 halvings: to rounding.
        for _ in 0..45 {
            let middle = 0.5 * (low + high);
            *(if element_number(middle) > number { &mut high } else { &mut low }) = middle;
        }
        nodes.push(high);
    }
    nodes.push(1.0);
    nodes
}

/// The number of elements from the inner rim to `s`, in units of their density: the integral of [`graded`]'s density.
fn element_number(s: f64) -> f64 {
    s + INNER.share * libm::log1p(s / INNER.reach)
        + OUTER.share * libm::log((1.0 + OUTER.reach) / (1.0 - s + OUTER.reach))
        + FOLD.share * (libm::atan((s - 0.5) / FOLD.reach) + libm::atan(0.5 / FOLD.reach))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_rise_from_rim_to_rim_and_the_areas_are_the_annulus() {
        for r_star in [0.0, 1e-9, 5e-4, 1e-3, 0.1, 3.0] {
            let mesh = MeridianMesh::new(r_star, 48);
            assert!(mesh.nodes.windows(2).all(|pair| pair[0] < pair[1]), "{r_star}");
            assert_eq!((mesh.nodes[0], mesh.nodes[mesh.nodes.len() - 1]), (0.0, 1.0));
            let area: f64 = mesh.elements.iter().flatten().map(|point| point.area).sum();
            assert!((area - (r_star + 0.5)).abs() < 1e-13, "{r_star}: {area}");
        }
    }

    #[test]
    fn shapes_reproduce_cubics() {
        let f = |s: f64| [s * s * s - 2.0 * s, 3.0 * s * s - 2.0, 6.0 * s];
        let mesh = MeridianMesh::new(0.1, 6);
        for (ends, points) in mesh.nodes.windows(2).zip(&mesh.elements) {
            let [start, end] = [f(ends[0]), f(ends[1])];
            for point in points {
                for (shape, exact) in point.shape.iter().zip(f(point.place)) {
                    let value =
                        shape[0] * start[0] + shape[1] * start[1] + shape[2] * end[0] + shape[3] * end[1];
                    assert!((value - exact).abs() < 1e-11, "{} {value} {exact}", point.place);
                }
            }
        }
    }
}
