//! A spec's stars as shells: the same keys as other predictions, with what only a shell knows, and none of what only a
//! hinge's model knows.

use crate::design::{Design, Meeting, PlacedStar, StarDesign};
use crate::forecast::answered::mm;
use crate::forecast::by_shell::{Detail, SHELL};
use crate::forecast::case::{Case, measured_stiffnesses};
use crate::forecast::predict::PredictFault;
use crate::forecast::prediction::{ForceAt, Hinges};
use crate::forecast::ranges::StarRanges;
use crate::forecast::shell_prediction::{Place, ShellEvidence, ShellPrediction, ShellStar, StarMeshErrors};
use crate::forecast::shell_star::{Measured, ask, entered, fault};
use crate::mechanics::strength::payload;
use crate::shell::cases::{FlatStar, InflatedStar, Shape, Value, Watch};
use crate::spec::{Spec, key};
use crate::units::{Pressure, Readable};

pub use crate::forecast::shell_star::{Refusal, flat};

/// Points with which they were tried.
const TRIED_POINTS: u32 = 8;

/// What shells say of the stars of `design`, made from `spec`: at rest, and around round objects of `radii` (m, rising).
/// With it, the inflated sheet of star 1.
///
/// # Errors
/// If a shell refuses a star or finds no equilibrium of it, or was told to stop.
pub fn predict(
    (spec, design): (&Spec, &Design),
    radii: &[f64],
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<(ShellPrediction, Shape), Refusal> {
    let meetings = design.meetings(spec);
    let meeting = |placed: &PlacedStar| meetings.as_ref().and_then(|all| all.get(placed.index - 1)).copied();
    let mut computed = Vec::new();
    for placed in design.firsts() {
        let alike = design.stars.iter().filter(|other| other.distinct == placed.distinct);
        let meetings: Vec<Option<Meeting>> = alike.map(meeting).collect();
        let found = compute((spec, design.part(placed)), (radii, &meetings), detail, watch);
        computed.push(found.map_err(|refusal| refusal.of_star(placed.index))?);
    }
    let answer = |placed: &PlacedStar| {
        let one = computed.get(placed.distinct)?;
        Some(one.star((spec, design.part(placed)), meeting(placed), radii))
    };
    let stars: Vec<ShellStar> = design.stars.iter().filter_map(answer).collect();
    let shape = computed.into_iter().next().map(|one| one.found.shape).unwrap_or_default();
    let Some(first) = stars.first() else {
        return Err(fault(key::stack::COUNT, "there is no star".to_owned()));
    };
    let mut first = first.clone();
    first.payload_kg = stars.iter().map(|star| star.payload_kg).sum();
    let stack_mass_g = stars.iter().map(|star| star.mass_g).sum();
    Ok((ShellPrediction { first, stack_mass_g, stars }, shape))
}

impl Refusal {
    fn of_star(self, star: usize) -> Self {
        match self {
            Self::Fault(fault) => Self::Fault(PredictFault { star: fault.star.or(Some(star)), ..fault }),
            Self::Cancelled => Self::Cancelled,
        }
    }
}

/// A shell of one distinct star, opened to all that was asked.
struct Computed {
    case: Case,
    flat: FlatStar,
    found: InflatedStar,
    measured: Measured,
}

/// The star as a shell, around round objects of `radii` (m) and what stars like it meet of the object.
fn compute(
    (spec, part): (&Spec, &StarDesign),
    (radii, meetings): (&[f64], &[Option<Meeting>]),
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<Computed, Refusal> {
    let case = Case::of(spec, &part.star).map_err(|why| fault(key::fabric::THICKNESS, why.to_string()))?;
    let met = meetings.iter().filter_map(|meeting| entered(&case.meeting(*meeting)));
    let all: Vec<f64> = radii.iter().copied().chain(met).collect();
    let (flat, found, measured) = ask(&Case { object: None, ..case }, &all, detail, watch)?;
    Ok(Computed { case, flat, found, measured })
}

impl Computed {
    /// What it says of a star that meets the object as `meeting` says.
    fn star(&self, (spec, part): (&Spec, &StarDesign), meeting: Option<Meeting>, radii: &[f64]) -> ShellStar {
        let case = self.case.meeting(meeting);
        let measured = Measured { object: entered(&case), ..self.measured.clone() };
        let Self { flat, found, .. } = self;
        Answered { case: &case, part, spec, flat, found, measured: &measured }.star(radii)
    }
}

/// An answer of the shell, with all that it is about.
struct Answered<'a> {
    case: &'a Case,
    part: &'a StarDesign,
    spec: &'a Spec,
    flat: &'a FlatStar,
    found: &'a InflatedStar,
    measured: &'a Measured,
}

/// No value of a hinge.
const NONE: Hinges<Option<f64>> = Hinges { tip: None, corner: None };

impl Answered<'_> {
    fn star(&self, radii: &[f64]) -> ShellStar {
        let Self { case, part, spec, flat, found, measured } = *self;
        let on_object = measured.object_force();
        let beside = case.object.is_some_and(|radius| radius <= 0.0);
        let curve: Vec<(f64, Value)> =
            radii.iter().filter_map(|radius| Some((mm(*radius), measured.force_at(*radius)?))).collect();
        let extremes = &measured.extremes;
        let [pull, pull_error] = measured.seal_tension();
        ShellStar {
            model: SHELL,
            lambda_t: NONE,
            lambda_c: NONE,
            d2v_dlambda2: NONE,
            arm_length_mm: part.star.l,
            tip_target_angle_deg: None,
            corner_target_angle_deg: None,
            tip_equilibrium_angle_deg: measured.equilibrium(),
            tip_angle_deg: measured.tip_angle.value,
            final_radius_mm: measured.radius.value,
            contraction: measured.contraction.value,
            hinge_stiffness_Nm: None,
            radial_stiffness_N_per_m: measured.known_stiffness(),
            preload_N: None,
            arm_contact_N: measured.contact.value,
            arm_contact_mm2: measured.contact_area.value,
            volume_mm3: measured.volume.value,
            graspable_radius_mm: None,
            hole_radius_mm: mm(case.hole),
            object_radius_mm: case.object.map(mm),
            object_gap_mm: case.entering.map(|entering| mm(case.hole) - mm(entering)),
            object_force_N: on_object.map(|force| force.value).or(beside.then_some(0.0)),
            force_curve: (!radii.is_empty()).then(|| {
                curve.iter().map(|(radius, force)| ForceAt(*radius, Some(force.value), None, None)).collect()
            }),
            bendability: flat.tube.bendability(),
            operating_pressure_kPa: Pressure::from_pascals(case.operating_pressure()).0,
            realised_radius_mm: Hinges {
                tip: part.realised_tip().radius,
                corner: part.realised_corner().radius,
            },
            burst_pressure_kPa: None,
            seal_tension: Place { value: pull, mesh_error: pull_error, at_mm: extremes.seal_at.map(mm) },
            stretch: Place {
                value: extremes.stretch,
                mesh_error: extremes.stretch_error,
                at_mm: extremes.stretch_at.map(mm),
            },
            mass_g: part.mass(&spec.fabric),
            payload_kg: case
                .friction
                .zip(on_object.map(|force| force.value).or(beside.then_some(0.0)))
                .map(|(mu, force)| payload(mu, [force])),
            ranges: StarRanges::default(),
            evidence: ShellEvidence {
                fabric: measured_stiffnesses(&spec.fabric),
                residual: found.evidence.residual,
                iterations: found.evidence.efforts.iter().map(|effort| effort.iterations).sum(),
                unknowns: found.evidence.unknowns.clone(),
                stretch: flat.tube.stretch(),
                mesh_errors: StarMeshErrors {
                    final_radius_mm: measured.radius.error,
                    contraction: measured.contraction.error,
                    tip_angle_deg: measured.tip_angle.error,
                    radial_stiffness_N_per_m: measured.stiffness.error,
                    arm_contact_N: measured.contact.error,
                    arm_contact_mm2: measured.contact_area.error,
                    volume_mm3: measured.volume.error,
                    object_force_N: on_object.map(|force| force.error),
                    force_curve: (!radii.is_empty())
                        .then(|| curve.iter().map(|(_, force)| force.error).collect()),
                },
                warnings: self.warnings(),
            },
        }
    }

    fn warnings(&self) -> Vec<String> {
        let Self { case, flat, measured, .. } = self;
        let (radius, object) = (measured.radius, measured.object);
        let too_wide = case.object.is_some_and(|radius| radius > 0.0) && object.is_none();
        let pull = measured.extremes.seal_tension;
        let sharp = flat.tip_radius == 0.0 || flat.corner_radius == 0.0;
        let said = [
            (flat.points > TRIED_POINTS, format!("shells of stars were tried with 3 to {TRIED_POINTS} points")),
            (measured.touches(), "the arms touch: the star is pressed shut".to_owned()),
            (
                too_wide,
                format!("the object is wider than the cut hole, {} mm in radius: it does not enter", Readable(mm(case.hole))),
            ),
            (
                object.is_some_and(|object| mm(object) < radius.value),
                format!("the object is thinner than the final radius, {:.2} mm: the star does not reach it", radius.value),
            ),
            (
                case.peel.is_some_and(|peel| pull > peel) && !sharp,
                format!("the rim is pulled by up to {:.2} N/mm, which is more than the seal's strength", 1e-3 * pull),
            ),
            (
                sharp,
                "a hinge of inner radius 0 turns on a point, where pull and stretch have no largest value: those given are of \
                 the finest mesh"
                    .to_owned(),
            ),
            (
                measured.known_stiffness().is_none(),
                "the meshes do not agree on the radial stiffness: take finer ones".to_owned(),
            ),
            (
                radius.error > 0.05 * radius.value,
                format!("the meshes leave the final radius open by {:.2} mm: take finer ones", radius.error),
            ),
        ];
        said.into_iter().filter(|(holds, _)| *holds).map(|(_, text)| text).collect()
    }
}
