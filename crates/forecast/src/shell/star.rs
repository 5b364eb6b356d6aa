//! A spec's stars as shells: the keys of all predictions and those of shells, without those of hinge
//! models.

use crate::case::Case;
use crate::folding::until_arms_fold;
use crate::meshed::MeshedPlace;
use crate::predict::{PredictFault, assembled_prediction, stars_of};
use crate::prediction::{FabricStretch, ForceAt, MeshErrors, ModelEvidence, Prediction, StarPrediction};
use crate::ranges::shown::meshed;
use crate::shell::request::{Measurements, ask, entered, fabric_weave, fault};
use crate::shell::work::ShellWork;
use crate::shell::{Detail, SHELL, fineness};
use crate::star_answer::{mm, without_model};
use crate::warning::PredictionWarning;
use design::{Design, PlacedPart, StarAssembly, StarDesign};
use geom::order::sort_by;
use inflatable::mechanics::star::bearing::FOLDING;
use inflatable::mechanics::strength::payload;
use inflatable::shell::cases::{FlatStar, Hysteresis, InflatedShape, InflatedStar, Value, Watch};
use spec::units::Readable;
use spec::{Spec, key};

pub use crate::shell::request::{ShellRefusal, flat};

/// Use of a shear modulus by a shell.
const IN_THE_MESH: &str = "shear_modulus and warp in every triangle";

/// Largest number of points with which shells were tested.
const TRIED_POINTS: u32 = 8;

/// The shell's predictions of the stars of `design`, made from `spec`: at rest, and around round objects of `radii` (m, rising).
/// Also returns the inflated sheet of star 1.
///
/// # Errors
/// If a shell refuses a star or finds no equilibrium of it, or is cancelled.
pub fn predict(
    spec: &Spec,
    design: &Design,
    radii: &[f64],
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<(Prediction, InflatedShape), ShellRefusal> {
    let design = stars_of(design)?;
    // One of each star, or none without an object.
    let meetings = design.meetings(spec).unwrap_or_default();
    begin(spec, design, detail, watch)?;
    let mut runs = Vec::new();
    for placed in design.firsts() {
        let run = star_case(spec, design.part(placed)).and_then(|case| {
            let alike = design.stars.iter().filter(|other| other.distinct == placed.distinct);
            let entered =
                alike.filter_map(|placed| entered(&case.meeting(meetings.get(placed.index - 1).copied())));
            let objects: Vec<f64> = radii.iter().copied().chain(entered).collect();
            ShellRun::new(spec, &case, &objects, detail, watch)
        });
        runs.push(run.map_err(|refusal| refusal.of_star(placed.index))?);
    }
    let answer = |placed: &PlacedPart| {
        let run = runs.get(placed.distinct)?;
        let opening = design.frame.opening_below(placed.index);
        let case = run.case.meeting(meetings.get(placed.index - 1).copied()).above_plate(opening);
        Some(run.star(spec, design.part(placed), &case, radii))
    };
    let stars: Vec<StarPrediction> = design.stars.iter().filter_map(answer).collect();
    let shape = runs.into_iter().next().map(|run| run.inflated.shape).unwrap_or_default();
    Ok((assembled_prediction(spec, design, stars)?, shape))
}

/// The longest time of a stack that a command computes unasked, s: a dozen different stars on medium meshes.
const MOST_SECONDS: f64 = 600.0;

/// Time of a star by the unknowns of its finest mesh, s, on one processor of 2024: 47 s for 81,000, and 63 s for 182,000
/// (docs/trade.md). Each further object takes longer.
const SECONDS_OF_UNKNOWN: f64 = 6e-4;

/// Tells `watch` the size of the computation before it begins, or refuses that of many different stars.
fn begin(spec: &Spec, design: &StarAssembly, detail: Detail, watch: &Watch<'_>) -> Result<(), ShellRefusal> {
    let weave = fabric_weave(&spec.fabric)?;
    let cases = design.firsts().filter_map(|placed| star_case(spec, design.part(placed)).ok());
    let flat_stars = cases.filter_map(|case| flat(&case, weave).ok());
    let unknowns: f64 = flat_stars.map(|star| star.unknowns(fineness(detail))).sum();
    let count = design.firsts().count();
    let subject = match count {
        1 => "the shell of this star is large".to_owned(),
        _ => format!("the shells of {count} different stars are large"),
    };
    let words = [subject.as_str(), "coarser meshes or fewer different stars take less"];
    let work = ShellWork { unknowns, seconds: SECONDS_OF_UNKNOWN * unknowns };
    Ok(work.begin(MOST_SECONDS, watch, words)?)
}

impl ShellRefusal {
    fn of_star(self, star: usize) -> Self {
        match self {
            Self::Fault(fault) => Self::Fault(PredictFault { star: fault.star.or(Some(star)), ..fault }),
            Self::Cancelled => Self::Cancelled,
        }
    }
}

/// A shell of one distinct star, computed around every requested object.
struct ShellRun {
    case: Case,
    flat: FlatStar,
    inflated: InflatedStar,
    measured: Measurements,
}

fn star_case(spec: &Spec, part: &StarDesign) -> Result<Case, ShellRefusal> {
    Case::of_part(spec, part).map_err(|why| fault(key::fabric::THICKNESS, why.to_string()))
}

impl ShellRun {
    /// The star of `case` as a shell, around round objects of the radii `objects` (m).
    fn new(
        spec: &Spec,
        case: &Case,
        objects: &[f64],
        detail: Detail,
        watch: &Watch<'_>,
    ) -> Result<Self, ShellRefusal> {
        let empty = Case { object: None, ..*case };
        let (flat, inflated, measured) = ask(&empty, &spec.fabric, objects, detail, watch)?;
        Ok(Self { case: *case, flat, inflated, measured })
    }

    /// The prediction of the star of `part` in its place in the stack, which `case` describes, with the forces on objects of `radii` (m).
    fn star(&self, spec: &Spec, part: &StarDesign, case: &Case, radii: &[f64]) -> StarPrediction {
        // The shell computed one star in the middle of its object. Here the case of its place in the stack is read
        // off: the radius that it meets and the plate below it. What only the geometry gives comes from the
        // prediction without a model.
        let measured = Measurements { object: entered(case), ..self.measured.clone() };
        let on_object = measured.object_force();
        let is_beside = case.object.is_some_and(|radius| radius <= 0.0);
        let curve: Vec<(f64, Value)> =
            radii.iter().filter_map(|radius| Some((mm(*radius), measured.force_at(*radius)?))).collect();
        let extremes = &measured.extremes;
        let [pull, pull_error] = measured.seal_tension();
        let force = on_object.map(|force| force.value).or(is_beside.then_some(0.0));
        let wrinkling = case.wrinkling_mass(measured.tip_angle.value.to_radians());
        let unmodelled = without_model(spec, part, case);
        StarPrediction {
            model: SHELL,
            tip_equilibrium_angle_deg: measured.equilibrium(),
            tip_angle_deg: Some(measured.tip_angle.value),
            final_radius_mm: Some(measured.radius.value),
            contraction: Some(measured.contraction.value),
            radial_stiffness_N_per_m: measured.known_stiffness(),
            arm_contact_N: Some(measured.contact.value),
            arm_contact_mm2: Some(measured.contact_area.value),
            volume_mm3: Some(measured.volume.value),
            object_force_N: force,
            object_force_friction_N: case
                .friction_range
                .and_then(|[_, most]| measured.object_force_with(most)),
            flap_edge_radius_mm: Some((measured.radius.value - mm(case.flap())).max(0.0)),
            flap_force_N: measured
                .object
                .and_then(|object| measured.force_at(object + case.flap()))
                .map(|force| force.value),
            force_curve: (!radii.is_empty()).then(|| force_curve(&curve)),
            seal_pull_N_per_mm: Some(1e-3 * extremes.seal_pull.value),
            seal_pull_at_mm: Some(extremes.pull_at.map(mm)),
            seal_tension: Some(MeshedPlace {
                value: pull,
                mesh_error: pull_error,
                at_mm: extremes.seal_at.map(mm),
            }),
            payload_kg: case
                .friction
                .zip(force)
                .map(|(friction, force)| until_arms_fold(payload(friction, [force]), wrinkling)),
            arm_wrinkling_kg: wrinkling,
            arm_folding_kg: wrinkling.map(|wrinkling| FOLDING * wrinkling),
            stretch: Some(FabricStretch::Largest(MeshedPlace {
                value: extremes.stretch.value,
                mesh_error: extremes.stretch.error,
                at_mm: extremes.stretch_at.map(mm),
            })),
            evidence: ModelEvidence {
                weave: spec.fabric.shear_modulus.map(|_| IN_THE_MESH),
                ..self.evidence(case, &measured, &curve, &unmodelled.evidence)
            },
            ..unmodelled
        }
    }

    /// Meshes, effort and warnings behind the numbers `measured` of a star of `case`, with the force on each requested object, `curve` (radius in
    /// mm, N); the rest is that of `flat_evidence`, of a prediction without a model.
    fn evidence(
        &self,
        case: &Case,
        measured: &Measurements,
        curve: &[(f64, Value)],
        flat_evidence: &ModelEvidence,
    ) -> ModelEvidence {
        let Self { flat, inflated, .. } = self;
        let snap_warning = snap(curve).or_else(|| snap_of_one_object(measured.hysteresis, &measured.forces));
        ModelEvidence {
            choice: format!("{SHELL} was requested"),
            residual: inflated.evidence.residual,
            iterations: inflated.evidence.efforts.iter().map(|effort| effort.iterations).sum(),
            unknowns: Some(inflated.evidence.unknowns.clone()),
            mesh_errors: Some(MeshErrors {
                final_radius_mm: measured.radius.error,
                contraction: measured.contraction.error,
                tip_angle_deg: measured.tip_angle.error,
                radial_stiffness_N_per_m: measured.stiffness.error,
                arm_contact_N: measured.contact.error,
                arm_contact_mm2: measured.contact_area.error,
                volume_mm3: measured.volume.error,
                seal_pull_N_per_mm: 1e-3 * measured.extremes.seal_pull.error,
                object_force_N: measured.object_force().map(|force| force.error),
                force_curve: (!curve.is_empty())
                    .then(|| curve.iter().map(|(_, force)| force.error).collect()),
            }),
            warnings: warnings(case, flat, measured)
                .into_iter()
                .chain(snap_warning)
                .map(PredictionWarning::from)
                .collect(),
            ..flat_evidence.clone()
        }
    }
}

/// The forces of a curve (radius in mm, N); a shell states no ranges.
fn force_curve(curve: &[(f64, Value)]) -> Vec<ForceAt> {
    let forces = curve.iter();
    forces
        .map(|(radius, force)| ForceAt { radius: *radius, force: Some(force.value), low: None, high: None })
        .collect()
}

fn warnings(case: &Case, flat: &FlatStar, measured: &Measurements) -> Vec<String> {
    // Each possible warning with its condition, in the order in which they are printed. Those whose condition holds
    // are kept.
    let (radius, object) = (measured.radius, measured.object);
    let too_wide = case.object.is_some_and(|radius| radius > 0.0) && object.is_none();
    let pull = measured.extremes.seal_pull.value;
    let sharp = flat.tip_radius == 0.0 || flat.corner_radius == 0.0;
    let candidates = [
        (flat.points > TRIED_POINTS, format!("shells of stars were tried with 3 to {TRIED_POINTS} points")),
        (measured.touches(), "the arms touch, and press on each other".to_owned()),
        (
            too_wide,
            format!("the object is wider than the cut hole, {} mm across: it does not enter", Readable(2.0 * mm(case.hole))),
        ),
        (
            object.is_some() && case.flap() > 0.0,
            format!(
                "objects touch the flap first: until it folds, at {:.2} N per mm of contact, the force is that on an object {} mm \
                 wider across",
                1e-3 * case.sheet.flap_load(case.flap()),
                Readable(2.0 * mm(case.flap()))
            ),
        ),
        (
            object.is_some_and(|object| mm(object) < radius.value),
            format!(
                "the object is thinner than the closed star, {:.2} mm across: the star does not reach it",
                2.0 * radius.value
            ),
        ),
        (
            case.least_peel().is_some_and(|peel| pull > peel) && !sharp,
            format!("the pull on the seal is {:.2} N/mm, which is more than its strength", 1e-3 * pull),
        ),
        (
            sharp,
            "a hinge of inner radius 0 turns on a point, where pull and stretch have no largest value: those given are of \
             the finest mesh"
                .to_owned(),
        ),
        (
            measured.known_stiffness().is_none(),
            "the radial stiffness differs between the meshes: use finer ones".to_owned(),
        ),
        (
            radius.error > 0.05 * radius.value,
            format!(
                "the star closes to {}, across: use finer meshes",
                meshed(2.0 * radius.value, 2.0 * radius.error, "mm")
            ),
        ),
    ];
    candidates.into_iter().filter(|(holds, _)| *holds).map(|(_, text)| text).collect()
}

/// A warning where the force falls while objects (radius in mm, force in N) open the star further: the rim of the corners snaps inwards, their
/// middle leaves the object, and contact jumps to two flanks.
fn snap(curve: &[(f64, Value)]) -> Option<String> {
    let mut sorted: Vec<&(f64, Value)> = curve.iter().collect();
    sort_by(&mut sorted, |a, b| a.0.total_cmp(&b.0));
    let falls = sorted.windows(2).find(|pair| pair[1].1.value < pair[0].1.value)?;
    let [(narrow, high), (wide, low)] = [falls[0], falls[1]].map(|(radius, force)| (radius, force.value));
    Some(format!(
        "the force falls from {high:.2} to {low:.2} N while the object widens from {:.2} to {:.2} mm across: the corners' rims snap \
         inwards there, and meshes may differ on where; take the lower force",
        2.0 * narrow,
        2.0 * wide
    ))
}

/// A warning where the force on the largest object, the last of `forces`, depends on whether the star opened or closed on it: its corners have
/// two stable shapes there. A difference within the mesh error of that force is none.
fn snap_of_one_object(hysteresis: Option<Hysteresis>, forces: &[(f64, Value)]) -> Option<String> {
    let hysteresis = hysteresis.filter(|forces| forces.is_snap())?;
    let (_, force) = forces.last()?;
    (hysteresis.difference() > force.error / force.value.max(f64::MIN_POSITIVE)).then(|| {
        format!(
            "the corners' rims snap on an object {:.2} mm across: they press on it with {:.2} N when it has opened the star, and with \
             {:.2} N when the star has closed on it from further open; take the force as {:.0} % lower",
            2.0 * mm(hysteresis.radius),
            hysteresis.opening_force,
            hysteresis.closing_force,
            100.0 * hysteresis.difference()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_that_falls_is_reported_with_its_opening() {
        let curve = |points: [(f64, f64); 3]| {
            points.map(|(radius, value)| (radius, Value { value, error: 0.1, meshes: [value; 3] }))
        };
        let rising = curve([(20.0, 1.0), (22.0, 2.0), (24.0, 2.5)]);
        assert_eq!(snap(&rising), None);
        assert_eq!(snap(&[]), None);
        // Radii in any order.
        let falling = curve([(24.0, 10.9), (22.0, 11.1), (20.0, 1.0)]);
        let warning = snap(&falling).expect("it falls");
        assert!(
            warning.contains("from 11.10 to 10.90 N") && warning.contains("from 44.00 to 48.00 mm"),
            "{warning}"
        );
    }

    #[test]
    fn two_forces_on_one_object_are_a_snap() {
        let force = |error: f64| [(0.025, Value { value: 4.0, error, meshes: [4.0; 3] })];
        let pair = |closing_force: f64| Some(Hysteresis { radius: 0.025, opening_force: 4.0, closing_force });
        // Noise, and less than the mesh error.
        assert_eq!(snap_of_one_object(None, &force(0.1)), None);
        assert_eq!(snap_of_one_object(pair(3.95), &force(0.01)), None);
        assert_eq!(snap_of_one_object(pair(3.0), &force(1.1)), None);
        let warning = snap_of_one_object(pair(3.0), &force(0.1)).expect("it falls");
        assert!(warning.contains("50.00 mm across") && warning.contains("25 % lower"), "{warning}");
    }
}
