//! Between unknowns and points: steps, forces, contributions of single points.

use crate::shell::assembly::numbering::{KINK, NONE};
use crate::shell::assembly::sheet::{self, Piece};
use crate::shell::assembly::{Assembly, Compression, Plane, Sheet, State};
use crate::shell::element::vector::{Vector, add_scaled, dot};

impl Assembly {
    /// Puts the points of `state` back to where the supports keep them: on rims and in mirror planes.
    pub fn hold(&self, state: &mut State) {
        for (point, hold) in state.points.iter_mut().zip(&self.supports.holds) {
            if hold.fixed[2] {
                point[2] = 0.0;
            }
            if let Some(plane) = hold.plane {
                let plane = self.supports.planes[plane];
                *point = add_scaled(*point, plane.distance(*point), plane.upright());
            }
        }
    }

    /// Moves `state` by `fraction` of a step of the unknowns.
    pub fn advance(&self, state: &mut State, step: &[f64], fraction: f64) {
        for (point, numbers) in self.numbering.points.iter().enumerate() {
            let axes = &self.supports.holds[point].axes;
            for (number, axis) in numbers.iter().zip(axes).filter(|(number, _)| **number != NONE) {
                state.points[point] =
                    add_scaled(state.points[point], fraction * step[*number as usize], *axis);
            }
        }
        for (lean, number) in state.leans.iter_mut().zip(&self.numbering.edges) {
            if *number != NONE {
                *lean += fraction * step[*number as usize];
            }
        }
    }

    /// The derivatives by the unknowns of a sum of products of points with vectors.
    pub fn project(&self, parts: &[(usize, [f64; 3])]) -> Vec<f64> {
        let mut row = vec![0.0; self.numbering.count];
        for (point, vector) in parts {
            let axes = &self.supports.holds[*point].axes;
            for (number, axis) in self.numbering.points[*point].iter().zip(axes).filter(|(k, _)| **k != NONE)
            {
                row[*number as usize] += dot(*axis, *vector);
            }
        }
        row
    }

    /// For each unknown a spring: the geometric mean of the flat area of its point and of a mean point's; 0 for a
    /// director. By area alone the smallest triangles, which bending makes the stiffest, would have hardly any spring.
    pub fn springs(&self) -> Vec<f64> {
        let areas = &self.sheet.areas;
        #[expect(clippy::cast_precision_loss, reason = "a mesh has far fewer than 2^53 points")]
        let mean = areas.iter().sum::<f64>() / areas.len() as f64;
        self.by_area(|area| (area * mean).sqrt())
    }

    /// For each unknown the flat area around its point; 0 for a director.
    pub(crate) fn masses(&self) -> Vec<f64> {
        self.by_area(|area| area)
    }

    fn by_area(&self, density: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut values = vec![0.0; self.numbering.count];
        for (numbers, area) in self.numbering.points.iter().zip(&self.sheet.areas) {
            for number in numbers.iter().filter(|number| **number != NONE) {
                values[*number as usize] = density(*area);
            }
        }
        values
    }

    /// Flat area of each point, 0 for those that are held in the plane of which `is_wall` is true; a margin that bears no compression gives
    /// way and does not count.
    pub(crate) fn contact_areas(&self, is_wall: impl Fn(Plane) -> bool) -> Vec<f64> {
        let Sheet { pieces, points, areas, .. } = &self.sheet;
        let gives_way = |piece: &Piece| matches!(piece.law, Some(Compression::Wrinkled(_)));
        let mut tributary = if pieces.iter().any(gives_way) {
            sheet::areas(points.len(), pieces.iter().filter(|piece| piece.law.is_none()))
        } else {
            areas.clone()
        };
        for (area, hold) in tributary.iter_mut().zip(&self.supports.holds) {
            if hold.plane.is_some_and(|plane| is_wall(self.supports.planes[plane])) {
                *area = 0.0;
            }
        }
        tributary
    }

    /// Adds the kinks' part to the Hessian.
    pub(super) fn add_kinks(&mut self) {
        for (kink, places) in self.sheet.kinks.iter().zip(&self.pattern.kinks) {
            let axes = kink.corners.map(|corner| self.supports.holds[corner].axes);
            let mut places = places.iter();
            for a in 0..KINK {
                for (b, place) in (0..=a).zip(&mut places) {
                    let turned = dot(axes[a / 3][a % 3], axes[b / 3][b % 3]);
                    self.values[*place as usize] += kink.stiffness(a / 3, b / 3) * turned;
                }
            }
        }
    }

    /// Adds the contribution of one point to the last gradient and Hessian: a force, and a symmetric matrix as a function of a vector.
    pub(crate) fn add_at_point(&mut self, point: usize, slope: Vector, matrix: impl Fn(Vector) -> Vector) {
        let axes = self.supports.holds[point].axes;
        let numbers = self.numbering.points[point];
        let mut places = self.pattern.point_places[point].iter();
        for i in 0..3 {
            if numbers[i] != NONE {
                self.gradient[numbers[i] as usize] += dot(axes[i], slope);
            }
            let answer = matrix(axes[i]);
            for (axis, place) in axes[..=i].iter().zip(&mut places) {
                self.values[*place as usize] += dot(*axis, answer);
            }
        }
    }
}
