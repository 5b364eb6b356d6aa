//! Contact of the sheet: with planes of symmetry, where an arm meets its image, with a rigid round object, and with a rigid plate above it.
//!
//! Each point of the mesh has the flat area a around it and must keep its **gap** g >= 0 to each **obstacle**. The
//! augmented Lagrangian is the sum of a/(2 k) (max(0, q - k g)^2 - q^2), with a contact pressure q kept for each pair and
//! a stiffness k. A **round** minimises it and then updates q = max(0, q - k g); penetration falls by a large factor a round,
//! for any k. Nocedal and Wright, "Numerical Optimization", section 17.4.
//!
//! Points slide along an obstacle without friction. On a round object they can also **stick**: each stays where it first touched as long as it
//! touches, held by a spring along the surface whose other end each round moves by how far the point still slides. That is friction without
//! a limit.

use crate::shell::assembly::{Assembly, Plane, State};
use crate::shell::element::vector::{Vector, add_scaled, dot, times};

/// An obstacle that the sheet must not penetrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// The far side of an upright plane.
    Wall(Plane),
    /// A rigid round object around the z axis, endless upwards.
    Post {
        /// Radius of the object.
        radius: f64,
    },
    /// A rigid level plate above the sheet.
    Plate {
        /// Height of its lower face.
        height: f64,
    },
}

impl Obstacle {
    /// The gap of a point, and its gradient.
    fn gap(&self, x: Vector) -> (f64, Vector) {
        match self {
            Self::Wall(plane) => (plane.distance(x), times(-1.0, plane.upright())),
            Self::Post { radius } => {
                let distance = libm::hypot(x[0], x[1]);
                (distance - radius, [x[0] / distance, x[1] / distance, 0.0])
            }
            Self::Plate { height } => (height - x[2], [0.0, 0.0, -1.0]),
        }
    }

    /// The second derivative of the gap along the obstacle.
    fn curvature(&self, x: Vector) -> f64 {
        match self {
            Self::Wall(_) | Self::Plate { .. } => 0.0,
            Self::Post { .. } => 1.0 / libm::hypot(x[0], x[1]),
        }
    }
}

/// Points of a sheet against obstacles.
#[derive(Clone, Debug)]
pub struct Contact {
    obstacles: Vec<Obstacle>,
    /// Contact pressure of each point on each obstacle.
    pressures: Vec<Vec<f64>>,
    /// Flat area of each point; 0 where it has no business with the obstacle.
    areas: Vec<Vec<f64>>,
    /// k: contact pressure a unit of penetration.
    pub stiffness: f64,
    /// Least k with which a solve begins.
    pub floor: f64,
    sticking: Option<Sticking>,
}

/// Shear traction of a point that sticks, p for each W that it slides. Springs four times as stiff change a force by 0.03 %.
const STICKING: f64 = 1e4;

/// Points that stick to a round object.
#[derive(Clone, Debug)]
struct Sticking {
    obstacle: usize,
    /// Shear traction a unit of sliding.
    stiffness: f64,
    /// Of each point that sticks.
    places: Vec<Option<TouchedPlace>>,
}

/// Where a point first touched a round object.
#[derive(Clone, Copy, Debug)]
struct TouchedPlace {
    /// Direction from the axis.
    direction: [f64; 2],
    height: f64,
    /// How far the spring's end has moved, around the axis and upwards.
    pulled: [f64; 2],
}

impl TouchedPlace {
    fn new(x: Vector) -> Self {
        let distance = libm::hypot(x[0], x[1]);
        Self { direction: [x[0] / distance, x[1] / distance], height: x[2], pulled: [0.0; 2] }
    }

    /// Around the axis.
    fn tangent(&self) -> Vector {
        [-self.direction[1], self.direction[0], 0.0]
    }

    /// How far the point at `x` has slid, around the axis and upwards. The object may have grown meanwhile.
    fn slid(&self, x: Vector) -> [f64; 2] {
        [dot(self.tangent(), x), x[2] - self.height]
    }
}

impl Sticking {
    /// Each point that sticks, with its place.
    fn sticking_points(&self) -> impl Iterator<Item = (usize, &TouchedPlace)> {
        self.places.iter().enumerate().filter_map(|(point, place)| Some((point, place.as_ref()?)))
    }
}

/// A point that touches an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPoint {
    pub(crate) point: usize,
    /// Flat area around the point.
    pub(crate) area: f64,
    /// Force on the point, contact pressure times area.
    pub(crate) force: f64,
    /// The gradient of its gap.
    pub(crate) normal: Vector,
}

/// Remaining error of contact after a solve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactError {
    /// Deepest penetration.
    pub penetration: f64,
    /// Largest change of a contact pressure in the last round.
    pub change: f64,
    /// Largest contact pressure.
    pub largest: f64,
}

impl Contact {
    /// Every point of `assembly`'s sheet against every obstacle; points that are held in a wall's plane do not touch that wall.
    pub fn new(assembly: &Assembly, obstacles: Vec<Obstacle>) -> Self {
        let contact_areas =
            |obstacle: &Obstacle| assembly.contact_areas(|plane| *obstacle == Obstacle::Wall(plane));
        let areas = obstacles.iter().map(contact_areas).collect();
        let count = assembly.sheet.flat().points.len();
        Self {
            pressures: vec![vec![0.0; count]; obstacles.len()],
            obstacles,
            areas,
            stiffness: 0.0,
            floor: 0.0,
            sticking: None,
        }
    }

    /// Lets points stick to the round obstacle `index` from now on, each where it first touches, in a sheet under `pressure`.
    pub fn stick(&mut self, index: usize, pressure: f64) {
        let places = vec![None; self.areas[index].len()];
        self.sticking = Some(Sticking { obstacle: index, stiffness: STICKING * pressure, places });
    }

    /// The start on the finer sheet of `finer`, whose points are these and then the middles of edges with these `ends`. The pressure on a
    /// middle is the average of its ends', and the total force on an obstacle is as before.
    pub fn carried(&self, finer: &Assembly, ends: impl Iterator<Item = [usize; 2]>) -> Self {
        let mut fine = Self::new(finer, self.obstacles.clone());
        (fine.stiffness, fine.floor) = (self.stiffness, self.stiffness);
        let ends: Vec<[usize; 2]> = ends.collect();
        for (index, pressures) in self.pressures.iter().enumerate() {
            let middles = ends.iter().map(|[a, b]| f64::midpoint(pressures[*a], pressures[*b]));
            fine.pressures[index] = pressures.iter().copied().chain(middles).collect();
            let (coarse_force, fine_force) = (self.force(index), fine.force(index));
            if fine_force > 0.0 {
                fine.pressures[index].iter_mut().for_each(|pressure| *pressure *= coarse_force / fine_force);
            }
        }
        fine
    }

    /// Changes an obstacle; contact pressures stay as they are.
    pub fn replace(&mut self, index: usize, obstacle: Obstacle) {
        self.obstacles[index] = obstacle;
    }

    /// The part of the energy that contact adds.
    pub(crate) fn energy(&self, state: &State) -> f64 {
        let mut energy = 0.0;
        self.visit_pairs(state, |area, kept, push, _, _, _| {
            energy += area * (push * push - kept * kept) / (2.0 * self.stiffness);
        });
        if let Some(sticking) = &self.sticking {
            for (point, place) in sticking.sticking_points() {
                let part = 0.5 * self.areas[sticking.obstacle][point] * sticking.stiffness;
                let slid = place.slid(state.points[point]).into_iter().zip(place.pulled);
                energy += slid.map(|(slid, pulled)| part * slid * (slid + 2.0 * pulled)).sum::<f64>();
            }
        }
        energy
    }

    /// Adds gradient and Hessian of that part to those of `assembly`.
    pub(crate) fn add(&self, state: &State, assembly: &mut Assembly) {
        self.visit_pairs(state, |area, _, push, point, normal, obstacle| {
            if push == 0.0 {
                return;
            }
            let tangent = [-normal[1], normal[0], 0.0];
            let curvature_force = -area * push * self.obstacles[obstacle].curvature(state.points[point]);
            assembly.add_at_point(point, times(-area * push, normal), |v| {
                let pressed = area * self.stiffness * dot(normal, v);
                let turned = curvature_force * (tangent[0] * v[0] + tangent[1] * v[1]);
                add_scaled(times(pressed, normal), turned, tangent)
            });
        });
        if let Some(sticking) = &self.sticking {
            for (point, place) in sticking.sticking_points() {
                let stiffness = self.areas[sticking.obstacle][point] * sticking.stiffness;
                let ([slide_around, slide_up], tangent) = (place.slid(state.points[point]), place.tangent());
                let [pull_around, pull_up] = [slide_around + place.pulled[0], slide_up + place.pulled[1]];
                let slope = add_scaled([0.0, 0.0, stiffness * pull_up], stiffness * pull_around, tangent);
                assembly.add_at_point(point, slope, |v| {
                    add_scaled([0.0, 0.0, stiffness * v[2]], stiffness * dot(tangent, v), tangent)
                });
            }
        }
    }

    /// Calls `see` with area, kept pressure, push max(0, q - k g), point, normal and obstacle of every pair.
    fn visit_pairs(&self, state: &State, mut see: impl FnMut(f64, f64, f64, usize, Vector, usize)) {
        for (index, obstacle) in self.obstacles.iter().enumerate() {
            for (point, area) in self.areas[index].iter().enumerate().filter(|(_, area)| **area > 0.0) {
                let (gap, normal) = obstacle.gap(state.points[point]);
                let pressure = self.pressures[index][point];
                see(*area, pressure, (pressure - self.stiffness * gap).max(0.0), point, normal, index);
            }
        }
    }

    /// Ends a round: updates the contact pressures for `state`, and returns the error before the update.
    pub fn keep(&mut self, state: &State) -> ContactError {
        let mut worst = ContactError::default();
        let mut pushes = Vec::new();
        self.visit_pairs(state, |_, before, push, point, _, index| {
            let (gap, _) = self.obstacles[index].gap(state.points[point]);
            worst.penetration = worst.penetration.max(-gap);
            worst.change = worst.change.max((push - before).abs());
            worst.largest = worst.largest.max(push);
            pushes.push((index, point, push));
        });
        for (index, point, push) in pushes {
            self.pressures[index][point] = push;
        }
        if let Some(sticking) = &mut self.sticking {
            let pressures = &self.pressures[sticking.obstacle];
            for ((place, x), pressure) in sticking.places.iter_mut().zip(&state.points).zip(pressures) {
                let touched = (*pressure > 0.0).then(|| place.unwrap_or_else(|| TouchedPlace::new(*x)));
                *place = touched.map(|touched| {
                    let [slide_around, slide_up] = touched.slid(*x);
                    TouchedPlace {
                        pulled: [touched.pulled[0] + slide_around, touched.pulled[1] + slide_up],
                        ..touched
                    }
                });
            }
        }
        worst
    }

    /// The sum of contact pressure times area on one obstacle.
    pub fn force(&self, index: usize) -> f64 {
        self.pressures[index].iter().zip(&self.areas[index]).map(|(pressure, area)| pressure * area).sum()
    }

    /// The sum of all shear forces that hold points where they stick.
    pub fn shear(&self) -> f64 {
        let force = |sticking: &Sticking| {
            let forces =
                sticking.sticking_points().map(|(point, TouchedPlace { pulled: [around, up], .. })| {
                    self.areas[sticking.obstacle][point] * sticking.stiffness * libm::hypot(*around, *up)
                });
            forces.sum::<f64>()
        };
        self.sticking.iter().map(force).sum()
    }

    /// The points that touch an obstacle.
    pub(crate) fn touching(&self, index: usize, state: &State) -> Vec<ContactPoint> {
        let pairs = self.pressures[index].iter().zip(&self.areas[index]).enumerate();
        let touching = pairs.filter(|(_, (pressure, area))| **pressure > 0.0 && **area > 0.0);
        let point = |(point, (pressure, area)): (usize, (&f64, &f64))| {
            let (_, normal) = self.obstacles[index].gap(state.points[point]);
            ContactPoint { point, area: *area, force: pressure * area, normal }
        };
        touching.map(point).collect()
    }

    /// Flat area of the points that touch an obstacle.
    pub fn patch(&self, index: usize) -> f64 {
        let touching =
            self.pressures[index].iter().zip(&self.areas[index]).filter(|(pressure, _)| **pressure > 0.0);
        touching.map(|(_, area)| area).sum()
    }
}
