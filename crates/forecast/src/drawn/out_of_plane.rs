//! A drawn piece that leaves its plane: the stable shape out of it, and measures in space.
//!
//! Positions are those where the surface half way between the sheets, the middle surface, lies best on the flat chamber. The opposite shape,
//! which leaves the plane to the other side, has the same energy and the same measures, but heights of the opposite sign.

use crate::drawn::chamber_prediction::{ChamberPrediction, PlaneAnswer};
use crate::drawn::measures::{MeasurePrediction, MeasuredKind, PlacedMeasure};
use crate::meshed::MeshedValue;
use geom::{Point, fitted_circle};
use inflatable::shell::cases::{OutOfPlane, Value};
use serde::Serialize;
use spec::units::Length;

/// The stable shape out of the plane of a chamber. Null where it is unknown: a mesh found none, or wrinkles are blended.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct OutOfPlanePrediction {
    /// By how much its energy, the work of the pressure included, is less than that in the plane.
    pub less_energy_mJ: Option<MeshedValue>,
    /// Largest less least height of the middle surface.
    pub rise_mm: Option<MeshedValue>,
    /// Unknowns of each mesh, both sheets together, coarse to fine.
    pub unknowns: Option<Vec<usize>>,
}

impl ChamberPrediction {
    /// Adds the shape out of its plane, or that it is unknown, unless the chamber stays in its plane.
    pub(super) fn fill_out_of_plane(&mut self, shape: Option<&OutOfPlane>) {
        if self.plane != Some(PlaneAnswer::Stays) {
            self.out_of_plane = Some(OutOfPlanePrediction {
                less_energy_mJ: shape.map(|shape| in_thousandths(shape.released)),
                rise_mm: shape.map(|shape| in_thousandths(shape.rise)),
                unknowns: shape.map(|shape| shape.evidence.unknowns.clone()),
            });
        }
    }
}

/// A value in mJ or mm of one in J or m.
fn in_thousandths(value: Value) -> MeshedValue {
    MeshedValue::rounded(value.scaled(1e3))
}

/// A quantity of a measure out of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SpaceQuantity {
    /// The number.
    pub value: f64,
    /// Mesh error of the value.
    pub mesh_error: f64,
    /// On the finest mesh, as its VTU file has it.
    pub finest_mesh: f64,
}

/// A measure out of the plane of its chamber.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct SpaceMeasure {
    /// Distance of its ends, straight in space: the mean of both sheets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_mm: Option<SpaceQuantity>,
    /// Angle in space between its two lines on the middle surface, or between it and the line `angle_to`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<SpaceQuantity>,
    /// Radius of the circle in space that fits its points on the middle surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<SpaceQuantity>,
    /// Position along x on the middle surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_mm: Option<SpaceQuantity>,
    /// Position along y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_mm: Option<SpaceQuantity>,
    /// Height of the middle surface over the flat chamber.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_mm: Option<SpaceQuantity>,
    /// Distance between the sheets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<SpaceQuantity>,
}

impl SpaceMeasure {
    /// The quantities with their words and units, in the order in which they are written.
    pub fn quantities(&self) -> impl Iterator<Item = (&'static str, &'static str, SpaceQuantity)> {
        let quantities = [
            ("radius", "mm", self.radius_mm),
            ("angle", "deg", self.angle_deg),
            ("distance", "mm", self.distance_mm),
            ("x", "mm", self.x_mm),
            ("y", "mm", self.y_mm),
            ("z", "mm", self.z_mm),
            ("height", "mm", self.height_mm),
        ];
        quantities.into_iter().filter_map(|(word, unit, quantity)| Some((word, unit, quantity?)))
    }

    /// The quantities of `measure` from its places on each mesh, coarse to fine.
    fn new(measure: &PlacedMeasure, meshes: &[PlacesInSpace]) -> Self {
        let mut answer = Self::default();
        for kind in measure.kinds {
            match kind {
                MeasuredKind::Distance => answer.distance_mm = meshed(meshes, PlacesInSpace::distance),
                MeasuredKind::Angle => answer.angle_deg = meshed(meshes, PlacesInSpace::angle),
                MeasuredKind::Radius => answer.radius_mm = meshed(meshes, PlacesInSpace::radius),
                MeasuredKind::Position(0) => {
                    answer.x_mm = meshed(meshes, |places| places.coordinate(0));
                    answer.z_mm = meshed(meshes, |places| places.coordinate(2));
                }
                MeasuredKind::Position(_) => answer.y_mm = meshed(meshes, |places| places.coordinate(1)),
                MeasuredKind::Height => answer.height_mm = meshed(meshes, PlacesInSpace::height),
                // Where the shape turns in space there is no plane for it.
                MeasuredKind::Direction => {}
            }
        }
        answer
    }
}

/// A quantity from its values on the meshes; `None` where one has none.
fn meshed(meshes: &[PlacesInSpace], value: fn(&PlacesInSpace) -> Option<f64>) -> Option<SpaceQuantity> {
    let values: Option<Vec<f64>> = meshes.iter().map(value).collect();
    let values = values?;
    let last = values.len().checked_sub(1)?;
    let meshed_value = Value::new([0, 1, 2].map(|mesh: usize| values[mesh.min(last)]));
    let MeshedValue { value, mesh_error } = MeshedValue::rounded(meshed_value);
    Some(SpaceQuantity { value, mesh_error, finest_mesh: meshed_value.meshes[2] })
}

/// The points of a measure on one mesh, mm, and then those of its reference line.
struct PlacesInSpace {
    /// On the upper and on the lower sheet.
    sheets: Vec<[[f64; 3]; 2]>,
    /// How many are points of the measure itself.
    count: usize,
}

impl PlacesInSpace {
    /// Point `index` on the middle surface.
    fn middle(&self, index: usize) -> Option<[f64; 3]> {
        let [upper, lower] = self.sheets.get(index)?;
        Some(std::array::from_fn(|axis| f64::midpoint(upper[axis], lower[axis])))
    }

    /// From one point of the middle surface to another.
    fn arm(&self, from: usize, to: usize) -> Option<[f64; 3]> {
        Some(difference(self.middle(to)?, self.middle(from)?))
    }

    fn distance(&self) -> Option<f64> {
        let (first, last) = (self.sheets.first()?, self.sheets.get(self.count.checked_sub(1)?)?);
        let [upper, lower] = [0, 1].map(|sheet| length(difference(last[sheet], first[sheet])));
        Some(f64::midpoint(upper, lower))
    }

    fn angle(&self) -> Option<f64> {
        let (first, second) = if self.sheets.len() > self.count {
            (self.arm(0, self.count - 1)?, self.arm(self.count, self.count + 1)?)
        } else if self.count == 3 {
            (self.arm(1, 0)?, self.arm(1, 2)?)
        } else {
            return None;
        };
        let (across, along) = (length(cross(first, second)), dot(first, second));
        Some(libm::atan2(across, along).to_degrees())
    }

    /// The points are taken to the plane whose normal is that of the area between them and their chord.
    fn radius(&self) -> Option<f64> {
        let arms: Option<Vec<[f64; 3]>> = (0..self.count).map(|index| self.arm(0, index)).collect();
        let arms = arms?;
        let mut area = [0.0; 3];
        for pair in arms.windows(2) {
            let part = cross(pair[0], pair[1]);
            area = std::array::from_fn(|axis| area[axis] + part[axis]);
        }
        let chord = arms.iter().copied().max_by(|a, b| length(*a).total_cmp(&length(*b)))?;
        let axes = [chord, cross(area, chord)].map(|axis| axis.map(|x| x / length(axis)));
        let points: Vec<Point> =
            arms.iter().map(|arm| Point::new(dot(axes[0], *arm), dot(axes[1], *arm))).collect();
        fitted_circle(&points).map(|(_, radius)| radius)
    }

    fn coordinate(&self, axis: usize) -> Option<f64> {
        self.middle(0)?.get(axis).copied()
    }

    fn height(&self) -> Option<f64> {
        let [upper, lower] = self.sheets.first()?;
        Some(length(difference(*upper, *lower)))
    }
}

/// Fills `answers`, those of `measures`, from chamber `index` out of its plane.
pub(super) fn fill(
    measures: &[PlacedMeasure],
    answers: &mut [MeasurePrediction],
    index: usize,
    shape: &OutOfPlane,
) {
    let mut first = 0;
    for (measure, answer) in measures.iter().zip(answers).filter(|(measure, _)| measure.chamber == index) {
        let end = first + measure.all_points().count();
        let in_mm = |point: [f64; 3]| point.map(|x| Length::from_metres(x).0);
        let meshes: Vec<PlacesInSpace> = (shape.probed.iter())
            .map(|probes| PlacesInSpace {
                sheets: probes[first..end].iter().map(|sheets| sheets.map(in_mm)).collect(),
                count: measure.points.len(),
            })
            .collect();
        answer.out_of_plane = Some(SpaceMeasure::new(measure, &meshes));
        first = end;
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(vector: [f64; 3]) -> f64 {
    dot(vector, vector).sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
