//! Supports of the sheet: which coordinates are unknowns, and in which axes.

use crate::shell::element::vector::Vector;
use crate::shell::mesh::{Border, Mesh};

/// An upright plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of it, in plan view.
    pub point: [f64; 2],
    /// Unit normal, out of the sheet.
    pub normal: [f64; 2],
}

impl Plane {
    /// The plane through the origin that begins a sheet there: it holds the x axis.
    pub fn first() -> Self {
        Self { point: [0.0, 0.0], normal: [0.0, -1.0] }
    }

    /// The plane through the origin that ends a sheet there, at the angle `angle` (rad) to the first.
    pub fn second(angle: f64) -> Self {
        Self { point: [0.0, 0.0], normal: [-libm::sin(angle), libm::cos(angle)] }
    }

    /// The normal in space.
    pub(crate) fn upright(&self) -> Vector {
        [self.normal[0], self.normal[1], 0.0]
    }

    /// Distance of a point from the plane, positive on the sheet's side.
    pub fn distance(&self, x: Vector) -> f64 {
        -((x[0] - self.point[0]) * self.normal[0] + (x[1] - self.point[1]) * self.normal[1])
    }
}

/// The axes in which a point may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hold {
    /// Orthonormal; those of space unless the point lies in a mirror plane.
    pub(crate) axes: [Vector; 3],
    /// Which of them it may not move along.
    pub(crate) fixed: [bool; 3],
    /// The mirror plane that it lies in; the axes are then along it, across it and up.
    pub(crate) plane: Option<usize>,
}

const SPACE: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The support of each point of a mesh, and the planes of symmetry by their numbers in [`Border::Mirror`].
#[derive(Clone, Debug)]
pub struct Supports {
    pub(crate) planes: Vec<Plane>,
    pub(crate) holds: Vec<Hold>,
}

impl Supports {
    /// The supports of the borders of `mesh`. Rims stay at z = 0, mirrored points in their plane.
    ///
    /// A border on a plane that `planes` does not have is not held.
    pub fn new(mesh: &Mesh, planes: Vec<Plane>) -> Self {
        let mut supports = Self { planes, ..Self::free(mesh.points.len()) };
        for edge in &mesh.edges {
            for point in edge.ends {
                match edge.border {
                    Some(Border::Rim(_)) => supports.holds[point].fixed[2] = true,
                    Some(Border::Mirror(plane)) => supports.keep_in(point, usize::from(plane)),
                    Some(Border::Free) | None => {}
                }
            }
        }
        supports
    }

    /// Keeps the triangles of `mesh` from number `first` on in the plane of the rims.
    pub fn keep_level(&mut self, mesh: &Mesh, first: usize) {
        for point in mesh.triangles[first..].iter().flatten() {
            self.holds[*point].fixed[2] = true;
        }
    }

    /// The supports of a free sheet of `count` points.
    pub fn free(count: usize) -> Self {
        let free = Hold { axes: SPACE, fixed: [false; 3], plane: None };
        Self { planes: Vec::new(), holds: vec![free; count] }
    }

    /// Holds `point` along one of its axes: 0 along its mirror plane (or x), 1 across it (or y), 2 upwards.
    pub fn fix(&mut self, point: usize, axis: usize) {
        self.holds[point].fixed[axis] = true;
    }

    /// Turns a plane and the axes of the points in it; where they are is the caller's to change.
    #[cfg(test)]
    pub(crate) fn turn_plane(&mut self, number: usize, plane: Plane) {
        let normal = plane.upright();
        self.planes[number] = plane;
        for hold in self.holds.iter_mut().filter(|hold| hold.plane == Some(number)) {
            hold.axes = [[-normal[1], normal[0], 0.0], normal, SPACE[2]];
        }
    }

    fn keep_in(&mut self, point: usize, number: usize) {
        let Some(plane) = self.planes.get(number) else { return };
        let normal = plane.upright();
        let hold = &mut self.holds[point];
        if hold.fixed[1] && hold.axes[1] != normal {
            hold.fixed[0] = true; // where two planes meet only the way up is left
        } else {
            hold.axes = [[-normal[1], normal[0], 0.0], normal, SPACE[2]];
            hold.fixed[1] = true;
            hold.plane = Some(number);
        }
    }
}
