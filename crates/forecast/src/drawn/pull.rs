//! How hard a drawn chamber pulls at two bars that hold seams of it, and how far.

use crate::drawn::chambers::DrawnChamber;
use crate::drawn::measures::{furthest, nearest_chamber, nearest_edge};
use crate::meshed::{MeshedValue, six};
use crate::predict::PredictFault;
use design::{Measure, MeasureForm};
use geom::{Line, Point, Segment};
use inflatable::mechanics::strength::GRAVITY;
use inflatable::shell::cases::{Pull, PullAtStroke, PulledRegion, Wrinkles};
use serde::Serialize;
use spec::units::{Length, Mass, Readable};
use spec::{Spec, key};

/// The pull of a chamber at two bars.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct PullPrediction {
    /// Names of the bars in the drawing.
    pub bars: [String; 2],
    /// The number of their chamber, from 1.
    pub chamber: usize,
    /// Their distance on the flat piece.
    pub distance_mm: f64,
    /// The force with which the chamber pulls while the bars are at that distance.
    pub blocked_force_N: MeshedValue,
    /// How far it draws the bars together if nothing holds them.
    pub free_stroke_mm: MeshedValue,
    /// What hangs on the bars, by `mass` in `[load]`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// How far it lifts that; absent where it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lifted_mm: Option<MeshedValue>,
    /// Rows of stroke, mm, force, N, and mesh error of the force, N, from blocked to free.
    pub curve: Vec<[f64; 3]>,
    /// Whether wrinkles are on the mesh (resolved), or the shape is their mean (averaged).
    pub wrinkles: &'static str,
}

/// Two bars with their chamber.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlacedPull {
    names: [String; 2],
    /// Index of the chamber.
    pub(super) chamber: usize,
    /// Each on the edge of its air, mm.
    bars: [Line; 2],
    /// Distance of their middles, mm.
    distance: f64,
    mass: Option<Mass>,
}

/// Points along a bar that must lie on a seam, and how far they may lie from it, mm.
const POINTS_ON_BAR: u32 = 9;
const ON_SEAM: f64 = 1e-3;
/// The least distance of two bars, mm.
const LEAST_DISTANCE: f64 = 1.0;

/// The two bars of `figures`, the figures of role `pull`, in the chamber that they pull at; `None` without figures.
///
/// # Errors
/// If there are not two straight lines along straight seams of one chamber, if the spec has plates, too, or a mass without bars.
pub(super) fn placed(
    spec: &Spec,
    figures: &[Measure],
    chambers: &[DrawnChamber],
) -> Result<Option<PlacedPull>, PredictFault> {
    let load = spec.load.as_ref();
    let mass = load.and_then(|load| load.mass);
    if figures.is_empty() {
        let fault = PredictFault::new(
            key::load::MASS,
            "`mass` hangs on bars, and no layer has the role `pull`".to_owned(),
        );
        return mass.map_or(Ok(None), |_| Err(fault.with_remedy("draw two lines along seams, or delete it")));
    }
    if load.is_some_and(|load| load.plates.is_some()) {
        let problem = "a chamber is computed between plates or between bars, not both".to_owned();
        return Err(
            PredictFault::new(key::load::PLATES, problem).with_remedy("delete `plates`, or the role `pull`")
        );
    }
    let [first, second] = figures else {
        let problem = format!("role `pull` has {} figures, and bars are two", figures.len());
        return Err(misdrawn(problem, "draw two straight lines, each along a seam"));
    };
    let names = [first, second].map(|bar| bar.name.clone());
    let reach = spec.seal.band.0 + spec.seal.allowance.0;
    let [(chamber, bar), (other_chamber, other_bar)] =
        [place(first, chambers, reach)?, place(second, chambers, reach)?];
    if chamber != other_chamber {
        let [name, other_name] = &names;
        let problem = format!(
            "bars {name:?} and {other_name:?} hold different chambers, and each chamber is computed alone"
        );
        return Err(misdrawn(problem, "draw both along seams of one chamber"));
    }
    let distance = middle(bar).distance(middle(other_bar));
    if distance < LEAST_DISTANCE {
        let [name, other_name] = &names;
        let problem = format!("bars {name:?} and {other_name:?} are {} mm apart", Readable(six(distance)));
        return Err(misdrawn(problem, "draw them along seams that come nearer to each other"));
    }
    Ok(Some(PlacedPull { names, chamber, bars: [bar, other_bar], distance, mass }))
}

fn misdrawn(problem: String, remedy: &str) -> PredictFault {
    PredictFault::new(key::drawing::LAYERS, problem).with_remedy(remedy)
}

fn middle(bar: Line) -> Point {
    bar.start.midpoint(bar.end)
}

/// `bar` on the straight seam next to it, and the index of the chamber.
fn place(bar: &Measure, chambers: &[DrawnChamber], reach: f64) -> Result<(usize, Line), PredictFault> {
    let MeasureForm::Line(ends) = &bar.form else {
        let problem = format!("bar {:?} is no straight line", bar.name);
        return Err(misdrawn(problem, "draw a straight line along a straight seam"));
    };
    let problem = match nearest_chamber(chambers, ends, nearest_edge) {
        Some((chamber, places)) if furthest(&places) <= reach => {
            let line = Line::new(places[0].point, places[1].point);
            if is_along_edge(&chambers[chamber], line) {
                return Ok((chamber, line));
            }
            format!("bar {:?} does not lie along a straight seam", bar.name)
        }
        _ => format!("bar {:?} lies more than {} mm from the air", bar.name, Readable(reach)),
    };
    Err(misdrawn(problem, "draw it along a straight seam: on the edge of the air, the band or the allowance"))
}

/// Whether `line` is long enough for a bar and lies on edges of the air.
fn is_along_edge(chamber: &DrawnChamber, line: Line) -> bool {
    let line: Segment = line.into();
    let mut points = (0..POINTS_ON_BAR).map(|k| line.point(f64::from(k) / f64::from(POINTS_ON_BAR - 1)));
    line.length() > ON_SEAM
        && points
            .all(|point| nearest_edge(&chamber.flat, point).is_some_and(|place| place.distance <= ON_SEAM))
}

impl PlacedPull {
    /// The bars and their load in SI units.
    pub(super) fn request(&self) -> Pull {
        Pull { bars: self.bars.map(in_metres), load: self.mass.map(|mass| mass.0 * GRAVITY) }
    }

    /// The answer of the shell.
    pub(super) fn prediction(&self, pulled: &PulledRegion) -> PullPrediction {
        let PulledRegion { curve, free_stroke, loaded_stroke, .. } = pulled;
        let blocked = curve.first().map_or(free_stroke.scaled(0.0), |point| point.force);
        let row = |PullAtStroke { stroke, force, .. }: &PullAtStroke| {
            [1e3 * stroke, force.value, force.error].map(six)
        };
        PullPrediction {
            bars: self.names.clone(),
            chamber: self.chamber + 1,
            distance_mm: six(self.distance),
            blocked_force_N: MeshedValue::rounded(blocked),
            free_stroke_mm: MeshedValue::rounded(free_stroke.scaled(1e3)),
            mass_kg: self.mass.map(|mass| mass.0),
            lifted_mm: loaded_stroke.map(|stroke| MeshedValue::rounded(stroke.scaled(1e3))),
            curve: curve.iter().map(row).collect(),
            wrinkles: if pulled.wrinkles == Wrinkles::Resolved { "resolved" } else { "averaged" },
        }
    }
}

/// A line in mm.
fn in_metres(line: Line) -> Line {
    let [start, end] = [line.start, line.end].map(|p| Point::new(Length(p.x).metres(), Length(p.y).metres()));
    Line::new(start, end)
}
