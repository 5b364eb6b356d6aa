//! Rigid bars along seams of a mesh.

use crate::shell::assembly::{State, Supports};
use crate::shell::cases::region::supports::SealedNodes;
use crate::shell::mesh::Mesh;
use geom::{Line, Point, Segment};

/// Distance of a sealed node from a bar that holds it, by the chamber's width.
const ON_BAR: f64 = 1e-6;

/// The nodes that two bars hold, and the line along which these are guided; lengths by the chamber's width.
pub(super) struct HeldNodes {
    /// Of each bar, with their positions on the flat sheet.
    nodes: [Vec<(usize, [f64; 2])>; 2],
    /// Unit vector from the first bar to the second.
    direction: [f64; 2],
    /// Distance of the bars on the flat sheet.
    pub(super) distance: f64,
    /// Of each point of the mesh how far it lies between the bars: 0 at the first, 1 at the second.
    parts: Vec<f64>,
}

impl HeldNodes {
    pub(super) fn new(mesh: &Mesh, sealed: &SealedNodes, bars: [Line; 2]) -> Self {
        let [first, second] = bars.map(middle);
        let distance = first.distance(second);
        let direction = [(second.x - first.x) / distance, (second.y - first.y) / distance];
        let offsets = mesh.points.iter().map(|[x, y]| [x - first.x, y - first.y]);
        let parts = offsets.map(|[x, y]| (x * direction[0] + y * direction[1]) / distance);
        Self {
            nodes: bars.map(|bar| nodes_on(bar, mesh, sealed)),
            direction,
            distance,
            parts: parts.map(|part| part.clamp(0.0, 1.0)).collect(),
        }
    }

    /// Holds the nodes in `supports`.
    pub(super) fn hold(&self, supports: &mut Supports) {
        for (node, _) in self.nodes.iter().flatten() {
            for axis in 0..3 {
                supports.fix(*node, axis);
            }
        }
    }

    /// Puts the held nodes of `state` where the bars are with this `stroke`: half of it by each.
    pub(super) fn place(&self, state: &mut State, stroke: f64) {
        for (nodes, share) in self.nodes.iter().zip([0.5, -0.5]) {
            for (node, [x, y]) in nodes {
                let [shift_x, shift_y] = self.direction.map(|part| share * stroke * part);
                state.points[*node] = [x + shift_x, y + shift_y, 0.0];
            }
        }
    }

    /// Shortens `state` by a further `stroke`, each point by its place between the bars: a start for a larger stroke.
    pub(super) fn shorten(&self, state: &mut State, stroke: f64) {
        for (point, part) in state.points.iter_mut().zip(&self.parts) {
            for axis in [0, 1] {
                point[axis] += (0.5 - part) * stroke * self.direction[axis];
            }
        }
    }

    /// The force that pulls the second bar towards the first, from the energy's derivatives by each point of one sheet: of both sheets.
    pub(super) fn force(&self, derivatives: &[[f64; 3]]) -> f64 {
        let nodes = self.nodes[1].iter().map(|(node, _)| derivatives[*node]);
        2.0 * nodes.map(|[x, y, _]| x * self.direction[0] + y * self.direction[1]).sum::<f64>()
    }
}

/// The sealed nodes of `mesh` on a bar.
fn nodes_on(bar: Line, mesh: &Mesh, sealed: &SealedNodes) -> Vec<(usize, [f64; 2])> {
    let bar = Segment::from(bar);
    let nodes = mesh.points.iter().copied().enumerate();
    nodes
        .filter(|(node, [x, y])| sealed.points[*node] && bar.distance(Point::new(*x, *y)) <= ON_BAR)
        .collect()
}

fn middle(bar: Line) -> Point {
    bar.start.midpoint(bar.end)
}
