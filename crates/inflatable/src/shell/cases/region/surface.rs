//! Both sheets as one closed surface.

use crate::shell::cases::region::supports::SealedNodes;
use crate::shell::cases::shape::InflatedShape;

/// The inflated surface to be looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Positions of the points, m; sealed ones occur once, those of the lower sheet come last.
    pub points: Vec<[f64; 3]>,
    /// Position of each on the flat sheets, m.
    pub flat: Vec<[f64; 2]>,
    /// The points of each triangle, counterclockwise from outside; those of the upper sheet, then those of the lower one in the same order.
    pub triangles: Vec<[usize; 3]>,
    /// The larger principal tension of each triangle, N/m.
    pub tension: Vec<f64>,
}

impl Surface {
    /// `upper` and its image.
    pub(super) fn new(upper: &InflatedShape, sealed: &SealedNodes) -> Self {
        let (mut points, mut flat) = (upper.points.clone(), upper.flat.clone());
        let image: Vec<usize> = (0..upper.points.len())
            .map(|point| {
                if sealed.points[point] {
                    return point;
                }
                let [x, y, z] = upper.points[point];
                points.push([x, y, -z]);
                flat.push(upper.flat[point]);
                points.len() - 1
            })
            .collect();
        let lower = upper.triangles.iter().map(|[a, b, c]| [image[*a], image[*c], image[*b]]);
        let tension = upper.tension.iter().map(|[most, _]| *most);
        Self {
            points,
            flat,
            triangles: upper.triangles.iter().copied().chain(lower).collect(),
            tension: tension.clone().chain(tension).collect(),
        }
    }
}
