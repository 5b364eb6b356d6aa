//! Measures of a drawn piece: distances, angles, radii, shifts and heights of its marked points, flat and inflated.
//!
//! The points of a measure are material points of one chamber. The shell gives their positions on its three meshes, where the inflated
//! chamber lies best on the flat one; each quantity is computed on each mesh, and so has a mesh error of its own.

use crate::drawn::chambers::DrawnChamber;
use crate::interval::{Interval, hull};
use crate::meshed::{MeshedValue, six, with_error};
use crate::predict::PredictFault;
use design::{Measure, MeasureForm};
use geom::{Nearest, Point, Vec2, fitted_circle};
use inflatable::shell::cases::{InflatedRegion, Value};
use inflatable::shell::mesh::FlatChamber;
use serde::Serialize;
use spec::units::{Length, Readable};
use spec::{Spec, key};

/// A quantity of a measure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeasuredQuantity {
    /// On the flat piece.
    pub flat: f64,
    /// After inflation; `None` without the shell, or where it has no value.
    pub inflated: Option<MeshedValue>,
    /// On the finest mesh, as its VTU file has it.
    pub finest_mesh: Option<f64>,
    /// Range with the mesh errors of both computed shapes, where these differ by more than the mesh error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<Interval>,
}

/// One measure: the quantities that its form has, flat and inflated.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct MeasurePrediction {
    /// The name of the figure in the drawing.
    pub measure: String,
    /// The number of its chamber, from 1.
    pub chamber: usize,
    /// The largest distance by which a point was moved to the edge of the air.
    pub moved_mm: f64,
    /// Distance of its ends, straight in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance_mm: Option<MeasuredQuantity>,
    /// Direction from its first to its last point in the plane, counterclockwise from x; inflated within half a turn of flat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction_deg: Option<MeasuredQuantity>,
    /// The line to which `angle_deg` counts: the first straight line of the chamber. Absent of a corner.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_to: Option<String>,
    /// Angle between its two lines, or between it and the line `angle_to`, in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<MeasuredQuantity>,
    /// Radius of the circle that fits its points best, in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<MeasuredQuantity>,
    /// Position along x.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_mm: Option<MeasuredQuantity>,
    /// Position along y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_mm: Option<MeasuredQuantity>,
    /// Distance between the sheets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_mm: Option<MeasuredQuantity>,
}

/// The quantities of a measure, in the order in which they are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MeasuredKind {
    /// Distance of the ends.
    Distance,
    /// Direction from the first to the last point.
    Direction,
    /// Angle at the corner, or between the line and its reference.
    Angle,
    /// Radius of the fitted circle.
    Radius,
    /// Position along an axis of the drawing.
    Position(usize),
    /// Distance between the sheets.
    Height,
}

impl MeasuredKind {
    /// The quantities that a form has.
    fn of_form(form: &MeasureForm) -> &'static [Self] {
        match form {
            MeasureForm::Point(_) => &[Self::Position(0), Self::Position(1), Self::Height],
            MeasureForm::Line(_) => &[Self::Distance, Self::Angle, Self::Direction],
            MeasureForm::Corner(_) => &[Self::Angle, Self::Distance],
            MeasureForm::Curve(_) => &[Self::Radius, Self::Distance],
        }
    }

    /// The value in mm or degrees for points and those of a reference line, in mm; `None` where there is none, as for the radius of points on a
    /// line.
    fn value(self, points: &[[f64; 3]], reference: &[[f64; 3]]) -> Option<f64> {
        let ([first, last], plane) =
            ([*points.first()?, *points.last()?], |[x, y, _]: [f64; 3]| Point::new(x, y));
        match self {
            Self::Distance => Some(libm::hypot(plane(first).distance(plane(last)), last[2] - first[2])),
            Self::Direction => Some((plane(last) - plane(first)).angle().to_degrees()),
            Self::Angle => match (points, reference) {
                (_, [start, end]) => {
                    Some(angle_between(plane(last) - plane(first), plane(*end) - plane(*start)))
                }
                ([_, corner, _], []) => {
                    let corner = plane(*corner);
                    Some(angle_between(plane(first) - corner, plane(last) - corner))
                }
                _ => None,
            },
            Self::Radius => {
                let points: Vec<Point> = points.iter().map(|point| plane(*point)).collect();
                fitted_circle(&points).map(|(_, radius)| radius)
            }
            Self::Position(axis) => first.get(axis).copied(),
            Self::Height => Some(2.0 * first[2]),
        }
    }
}

/// The angle between two directions, degrees from 0 to 180.
fn angle_between(first: Vec2, second: Vec2) -> f64 {
    libm::atan2(first.cross(second), first.dot(second)).abs().to_degrees()
}

/// A measure with its place: the chamber, and its points on the chamber's flat sheet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlacedMeasure {
    name: String,
    kinds: &'static [MeasuredKind],
    /// Index of its chamber.
    pub(super) chamber: usize,
    points: Vec<Point>,
    /// The first straight line of the chamber, if it is another one.
    reference: Option<ReferenceLine>,
    moved: f64,
}

/// A line to which the angle of others counts.
#[derive(Clone, Debug, PartialEq)]
struct ReferenceLine {
    name: String,
    ends: Vec<Point>,
}

impl PlacedMeasure {
    /// The quantities on the flat sheet.
    pub(super) fn flat(&self) -> MeasurePrediction {
        let flat: Vec<[f64; 3]> = self.all_points().map(|point| [point.x, point.y, 0.0]).collect();
        let (points, reference) = flat.split_at(self.points.len());
        let mut answer = MeasurePrediction {
            measure: self.name.clone(),
            chamber: self.chamber + 1,
            moved_mm: six(self.moved),
            angle_to: self.reference.as_ref().map(|line| line.name.clone()),
            ..MeasurePrediction::default()
        };
        for kind in self.kinds {
            let quantity = kind.value(points, reference).map(|value| MeasuredQuantity {
                flat: six(value),
                inflated: None,
                finest_mesh: None,
                range: None,
            });
            *answer.quantity_mut(*kind) = quantity;
        }
        answer
    }

    /// The points, and then those of the reference line.
    fn all_points(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().chain(self.reference.iter().flat_map(|line| &line.ends))
    }

    /// Adds to `answer` its quantities after inflation, from the positions of its points on each mesh, coarse to fine, mm; `other_meshes` are
    /// those of the other computed shape, or empty.
    fn fill(&self, answer: &mut MeasurePrediction, meshes: &[Vec<[f64; 3]>], other_meshes: &[Vec<[f64; 3]>]) {
        for kind in self.kinds {
            let Some(quantity) = answer.quantity_mut(*kind) else { continue };
            let Some(value) = self.meshed(*kind, quantity.flat, meshes) else { continue };
            quantity.inflated = Some(MeshedValue::rounded(value));
            quantity.finest_mesh = Some(value.meshes[2]);
            let other = self.meshed(*kind, quantity.flat, other_meshes);
            quantity.range = other.and_then(|other| range_of_shapes(value, other));
        }
    }

    /// The quantity `kind` from the positions of all points on each mesh; `None` without a mesh, or where it has no value. A direction is within
    /// half a turn of `flat`.
    fn meshed(&self, kind: MeasuredKind, flat: f64, meshes: &[Vec<[f64; 3]>]) -> Option<Value> {
        let last = meshes.len().checked_sub(1)?;
        let mut values = [0.0; 3];
        for (mesh, value) in values.iter_mut().enumerate() {
            let (points, reference) = meshes[mesh.min(last)].split_at(self.points.len());
            *value = kind.value(points, reference)?;
            if kind == MeasuredKind::Direction {
                *value = unwrapped(*value, flat);
            }
        }
        Some(Value::new(values))
    }
}

/// The range of a quantity by two shapes with their mesh errors; `None` where that of the first contains both values.
fn range_of_shapes(value: Value, other: Value) -> Option<Interval> {
    let differs = (other.value - value.value).abs() > value.error;
    differs.then(|| hull(with_error(value), with_error(other)).map(six))
}

/// `degrees` within half a turn of `reference`.
fn unwrapped(degrees: f64, reference: f64) -> f64 {
    degrees - 360.0 * ((degrees - reference) / 360.0).round()
}

impl MeasurePrediction {
    /// The place of a quantity.
    fn quantity_mut(&mut self, kind: MeasuredKind) -> &mut Option<MeasuredQuantity> {
        match kind {
            MeasuredKind::Distance => &mut self.distance_mm,
            MeasuredKind::Direction => &mut self.direction_deg,
            MeasuredKind::Angle => &mut self.angle_deg,
            MeasuredKind::Radius => &mut self.radius_mm,
            MeasuredKind::Position(0) => &mut self.x_mm,
            MeasuredKind::Position(_) => &mut self.y_mm,
            MeasuredKind::Height => &mut self.height_mm,
        }
    }

    /// The quantities with their words and units, in the order in which they are written.
    pub fn quantities(&self) -> impl Iterator<Item = (&'static str, &'static str, MeasuredQuantity)> {
        let quantities = [
            ("radius", "mm", self.radius_mm),
            ("angle", "deg", self.angle_deg),
            ("distance", "mm", self.distance_mm),
            ("direction", "deg", self.direction_deg),
            ("x", "mm", self.x_mm),
            ("y", "mm", self.y_mm),
            ("height", "mm", self.height_mm),
        ];
        quantities.into_iter().filter_map(|(word, unit, quantity)| Some((word, unit, quantity?)))
    }
}

/// The `measures` of `spec`, each in the chamber that has all of its points. A point beside the air, on the band or its allowance, is moved to
/// the nearest edge of the air: sealed fabric moves with its edge.
///
/// # Errors
/// If the points of a measure lie in no chamber, or in several.
pub(super) fn placed(
    spec: &Spec,
    measures: &[Measure],
    chambers: &[DrawnChamber],
) -> Result<Vec<PlacedMeasure>, PredictFault> {
    let reach = spec.seal.band.0 + spec.seal.allowance.0;
    let mut placed: Vec<PlacedMeasure> = Vec::new();
    for measure in measures {
        let mut placed_measure = place(measure, chambers, reach)?;
        if matches!(measure.form, MeasureForm::Line(_)) {
            placed_measure.reference = reference_line(&placed, placed_measure.chamber);
        }
        placed.push(placed_measure);
    }
    Ok(placed)
}

/// The first straight line among `measures` in a chamber.
fn reference_line(measures: &[PlacedMeasure], chamber: usize) -> Option<ReferenceLine> {
    let mut lines = measures.iter().filter(|measure| measure.kinds.contains(&MeasuredKind::Direction));
    let first = lines.find(|line| line.chamber == chamber)?;
    Some(ReferenceLine { name: first.name.clone(), ends: first.points.clone() })
}

fn place(measure: &Measure, chambers: &[DrawnChamber], reach: f64) -> Result<PlacedMeasure, PredictFault> {
    match nearest_chamber(chambers, measure.form.points(), place_in_air) {
        Some((chamber, places)) if furthest(&places) <= reach => Ok(PlacedMeasure {
            name: measure.name.clone(),
            kinds: MeasuredKind::of_form(&measure.form),
            chamber,
            reference: None,
            moved: furthest(&places),
            points: places.iter().map(|place| place.point).collect(),
        }),
        _ => Err(misplaced(measure, chambers, reach)),
    }
}

/// The index of the chamber that is nearest to all of `points`, where `place` gives the nearest place of one of them, and these places.
pub(super) fn nearest_chamber(
    chambers: &[DrawnChamber],
    points: &[Point],
    place: fn(&FlatChamber, Point) -> Option<Nearest>,
) -> Option<(usize, Vec<Nearest>)> {
    let places = chambers.iter().map(|chamber| {
        let places = points.iter().map(|point| place(&chamber.flat, *point));
        places.collect::<Option<Vec<Nearest>>>()
    });
    let placed = places.enumerate().filter_map(|(chamber, places)| Some((chamber, places?)));
    placed.min_by(|(_, a), (_, b)| furthest(a).total_cmp(&furthest(b)))
}

/// The largest distance of a point from its place in the air or on its edge.
pub(super) fn furthest(places: &[Nearest]) -> f64 {
    places.iter().map(|place| place.distance).fold(0.0, f64::max)
}

/// The fault of a measure that no chamber has whole: a point of it lies beside all air, or it goes from one chamber to another.
fn misplaced(measure: &Measure, chambers: &[DrawnChamber], reach: f64) -> PredictFault {
    let name = &measure.name;
    let points = measure.form.points();
    let (problem, remedy) = match points.iter().find(|point| is_beside_air(**point, chambers, reach)) {
        Some(Point { x, y }) => (
            format!(
                "measure {name:?} has a point at X {x:.3} Y {y:.3} mm, more than {} mm from the air",
                Readable(reach)
            ),
            "end it on the air, or on the band and the allowance beside it",
        ),
        None => (
            format!("measure {name:?} goes from one chamber to another, and each chamber is computed alone"),
            "draw a measure within one chamber",
        ),
    };
    PredictFault::new(key::drawing::LAYERS, problem).with_remedy(remedy)
}

/// Whether `point` lies further than `reach` from the air of every chamber.
fn is_beside_air(point: Point, chambers: &[DrawnChamber], reach: f64) -> bool {
    let mut places = chambers.iter().filter_map(|chamber| place_in_air(&chamber.flat, point));
    places.all(|place| place.distance > reach)
}

/// The place of a chamber's air that is nearest to `point`: the point itself if it lies in the air.
fn place_in_air(flat: &FlatChamber, point: Point) -> Option<Nearest> {
    if flat.has_air(point) {
        return Some(Nearest { distance: 0.0, point, segment: 0, s: 0.0 });
    }
    nearest_edge(flat, point)
}

/// The place on the edges of a chamber's air, its welds included, that is nearest to `point`.
pub(super) fn nearest_edge(flat: &FlatChamber, point: Point) -> Option<Nearest> {
    let edges = flat.curves().filter_map(|curve| curve.nearest(point));
    edges.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// The points of chamber `index` whose positions the shell must give, m: those of its measures, one after another.
pub(super) fn probes(measures: &[PlacedMeasure], index: usize) -> Vec<[f64; 2]> {
    let of_chamber = measures.iter().filter(|measure| measure.chamber == index);
    of_chamber
        .flat_map(PlacedMeasure::all_points)
        .map(|point| [point.x, point.y].map(|x| Length(x).metres()))
        .collect()
}

/// Fills `answers`, those of `measures`, from chamber `index` after inflation.
pub(super) fn fill(
    measures: &[PlacedMeasure],
    answers: &mut [MeasurePrediction],
    index: usize,
    inflated: &InflatedRegion,
) {
    let mut first = 0;
    for (measure, answer) in measures.iter().zip(answers).filter(|(measure, _)| measure.chamber == index) {
        let end = first + measure.all_points().count();
        let [meshes, other_meshes] = [&inflated.probed, &inflated.other_probed]
            .map(|meshes| meshes.iter().map(|probes| in_mm(&probes[first..end])).collect::<Vec<_>>());
        measure.fill(answer, &meshes, &other_meshes);
        first = end;
    }
}

/// Points in m as points in mm.
fn in_mm(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    points.iter().map(|point| point.map(|x| Length::from_metres(x).0)).collect()
}
