//! The straight line of an arm: fitted by least squares to both its rims, each point of which counts with its flat place.

use crate::shell::assembly::State;
use crate::shell::mesh::{Border, Mesh, rim};

/// The direction of an arm as a sum over the points of its rims.
///
/// On each rim, the line a + b s that is nearest to the rim's points x(s) in the mean of squares over the flat length s has
/// the direction b = int (s - mean) x ds / int (s - mean)^2 ds; the arm's is the mean of both. It is linear in the points.
pub(crate) struct ArmLine {
    /// Points and their weights.
    weights: Vec<(usize, f64)>,
}

impl ArmLine {
    /// The arm whose flat rims run along `direction` (a unit vector); s counts from the origin, and only points with s within
    /// `reach` belong to it.
    pub(crate) fn new(mesh: &Mesh, direction: [f64; 2], reach: [f64; 2]) -> Self {
        let length = reach[1] - reach[0];
        let middle = f64::midpoint(reach[0], reach[1]);
        let mut weights = Vec::new();
        for edge in &mesh.edges {
            let on_rim = matches!(edge.border, Some(Border::Rim(rim::INNER | rim::OUTER)));
            let [a, b] = edge.ends;
            let [sa, sb] = edge.ends.map(|end| {
                let [x, y] = mesh.points[end];
                x * direction[0] + y * direction[1]
            });
            let (from, to) = (sa.min(sb).max(reach[0]), sa.max(sb).min(reach[1]));
            if !on_rim || from >= to {
                continue;
            }
            for (end, here, there) in [(a, sa, sb), (b, sb, sa)] {
                let integrand = |s: f64| (s - middle) * (s - there) / (here - there);
                let simpson = integrand(from) + 4.0 * integrand(f64::midpoint(from, to)) + integrand(to);
                weights.push((end, (to - from) / 6.0 * simpson * 12.0 / length.powi(3) / 2.0));
            }
        }
        Self { weights }
    }

    /// Direction of the line in `state`; of length 1 where the arm is neither bent nor stretched.
    pub(crate) fn direction(&self, state: &State) -> [f64; 2] {
        [0, 1].map(|c| self.weights.iter().map(|(point, weight)| weight * state.points[*point][c]).sum())
    }

    /// A point near its end.
    pub(crate) fn last(&self) -> usize {
        self.weights.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(point, _)| *point)
    }

    /// The parts of the derivative of `vector` times the direction.
    pub(crate) fn times(&self, vector: [f64; 2]) -> Vec<(usize, [f64; 3])> {
        let part = |(point, weight): &(usize, f64)| (*point, [weight * vector[0], weight * vector[1], 0.0]);
        self.weights.iter().map(part).collect()
    }
}
