//! How hard a drawn chamber pulls at two bars that hold seams of it, and how far.

use crate::drawn::chambers::DrawnChamber;
use crate::drawn::measures::{furthest, nearest_edge};
use crate::meshed::{MeshedValue, six};
use crate::predict::PredictFault;
use design::{Measure, MeasureForm};
use geom::{Line, Nearest, Point, Segment};
use inflatable::mechanics::strength::GRAVITY;
use inflatable::shell::cases::{Pull, PullAtStroke, PulledRegion, Wrinkles};
use serde::Serialize;
use spec::units::{Length, Mass, Readable};
use spec::{KeyPath, Spec, key};

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
    /// What hangs on the bars, by `mass` in [load].
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
    /// The ends of each on the edge of its air, mm.
    bars: [[Point; 2]; 2],
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
        let without_bars = "`mass` hangs on bars, and no layer has the role `pull`: draw two lines along seams, or delete it";
        return mass.map_or(Ok(None), |_| Err(fault(key::load::MASS, without_bars.to_owned(), "")));
    }
    if load.is_some_and(|load| load.plates.is_some()) {
        let problem = "a chamber is computed between plates or between bars, not both";
        return Err(fault(key::load::PLATES, problem.to_owned(), "delete `plates`, or the role `pull`"));
    }
    let [first, second] = figures else {
        let problem = format!("role `pull` has {} figures, and bars are two", figures.len());
        return Err(fault(key::drawing::LAYERS, problem, "draw two straight lines, each along a seam"));
    };
    let bars = [first, second];
    let reach = spec.seal.band.0 + spec.seal.allowance.0;
    let placed_bars = [place(first, chambers, reach)?, place(second, chambers, reach)?];
    if placed_bars[0].chamber != placed_bars[1].chamber {
        let problem = format!(
            "bars {:?} and {:?} hold different chambers, and each chamber is computed alone",
            first.name, second.name
        );
        return Err(fault(key::drawing::LAYERS, problem, "draw both along seams of one chamber"));
    }
    let [from, to] = placed_bars.each_ref().map(|bar| bar.ends[0].midpoint(bar.ends[1]));
    if from.distance(to) < LEAST_DISTANCE {
        let problem = format!(
            "bars {:?} and {:?} are {} mm apart",
            first.name,
            second.name,
            Readable(six(from.distance(to)))
        );
        return Err(fault(
            key::drawing::LAYERS,
            problem,
            "draw them along seams that come nearer to each other",
        ));
    }
    Ok(Some(PlacedPull {
        names: bars.map(|bar| bar.name.clone()),
        chamber: placed_bars[0].chamber,
        bars: placed_bars.map(|bar| bar.ends),
        mass,
    }))
}

fn fault(key: KeyPath, problem: String, remedy: &str) -> PredictFault {
    let remedy = (!remedy.is_empty()).then(|| remedy.to_owned());
    PredictFault { remedy, ..PredictFault::new(key, problem) }
}

/// A bar on the edge of a chamber's air.
struct PlacedBar {
    chamber: usize,
    ends: [Point; 2],
}

/// `bar` on the straight seam next to it.
fn place(bar: &Measure, chambers: &[DrawnChamber], reach: f64) -> Result<PlacedBar, PredictFault> {
    let MeasureForm::Line(ends) = &bar.form else {
        let problem = format!("bar {:?} is no straight line", bar.name);
        return Err(fault(key::drawing::LAYERS, problem, "draw a straight line along a straight seam"));
    };
    let edges = chambers.iter().map(|chamber| on_air_edge(chamber, ends)).enumerate();
    let nearest = edges
        .filter(|(_, places)| places.len() == ends.len())
        .min_by(|(_, a), (_, b)| furthest(a).total_cmp(&furthest(b)));
    let problem = match nearest {
        Some((chamber, places)) if furthest(&places) <= reach => {
            let ends = [places[0].point, places[1].point];
            if is_along_edge(&chambers[chamber], ends) {
                return Ok(PlacedBar { chamber, ends });
            }
            format!("bar {:?} does not lie along a straight seam", bar.name)
        }
        _ => format!("bar {:?} lies more than {} mm from the air", bar.name, Readable(reach)),
    };
    Err(fault(
        key::drawing::LAYERS,
        problem,
        "draw it along a straight seam: on the edge of the air, the band or the allowance",
    ))
}

/// The places on the edges of a chamber's air that are nearest to `points`.
fn on_air_edge(chamber: &DrawnChamber, points: &[Point]) -> Vec<Nearest> {
    points.iter().filter_map(|point| nearest_edge(&chamber.flat, *point)).collect()
}

/// Whether the line between `ends` is as long as a bar may be and lies on edges of the air.
fn is_along_edge(chamber: &DrawnChamber, ends: [Point; 2]) -> bool {
    let line: Segment = Line::new(ends[0], ends[1]).into();
    let points = (0..POINTS_ON_BAR)
        .map(|k| line.point(f64::from(k) / f64::from(POINTS_ON_BAR - 1)))
        .collect::<Vec<Point>>();
    let places = on_air_edge(chamber, &points);
    line.length() > ON_SEAM && places.len() == points.len() && furthest(&places) <= ON_SEAM
}

impl PlacedPull {
    /// The bars and their load in SI units.
    pub(super) fn request(&self) -> Pull {
        Pull {
            bars: self.bars.map(|bar| bar.map(|end| [end.x, end.y].map(|x| Length(x).metres()))),
            load: self.mass.map(|mass| mass.0 * GRAVITY),
        }
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
            distance_mm: six(1e3 * pulled.distance),
            blocked_force_N: MeshedValue::rounded(blocked),
            free_stroke_mm: MeshedValue::rounded(free_stroke.scaled(1e3)),
            mass_kg: self.mass.map(|mass| mass.0),
            lifted_mm: loaded_stroke.map(|stroke| MeshedValue::rounded(stroke.scaled(1e3))),
            curve: curve.iter().map(row).collect(),
            wrinkles: if pulled.wrinkles == Wrinkles::Resolved { "resolved" } else { "averaged" },
        }
    }
}
