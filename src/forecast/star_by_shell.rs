//! A spec's stars as shells: the same keys as other predictions, with what only a shell knows, and none of what only a
//! hinge's model knows.

use crate::design::{Design, StarDesign};
use crate::forecast::by_shell::{Detail, SHELL, fabric};
use crate::forecast::case::{Case, measured};
use crate::forecast::predict::PredictFault;
use crate::forecast::prediction::{ForceAt, Hinges};
use crate::forecast::ranges::StarRanges;
use crate::forecast::shell_prediction::{Place, ShellEvidence, ShellPrediction, ShellStar, StarMeshErrors};
use crate::mechanics::strength::payload;
use crate::shell::cases::{
    FlatStar, InflatedStar, MOST_OBJECTS, Objects, Shape, ShellFault, Tube, Value, Watch, star,
};
use crate::spec::{KeyPath, Spec, key};
use crate::units::{Length, Pressure, Readable};

/// Points with which shells of stars are computed.
const MOST_POINTS: u32 = 16;
/// Points with which they were tried.
const TRIED_POINTS: u32 = 8;

/// Why shells give no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// They were told to stop.
    Cancelled,
    /// They refuse.
    Fault(PredictFault),
}

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
    let mut distinct = Vec::new();
    for placed in design.firsts() {
        let found = predict_star((spec, design.part(placed)), radii, detail, watch);
        distinct.push(found.map_err(|refusal| refusal.of_star(placed.index))?);
    }
    let stars: Vec<ShellStar> = design
        .stars
        .iter()
        .filter_map(|placed| distinct.get(placed.distinct))
        .map(|(star, _)| star.clone())
        .collect();
    let shape = distinct.into_iter().next().map(|(_, shape)| shape).unwrap_or_default();
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

fn fault(key: KeyPath, what: String) -> Refusal {
    Refusal::Fault(PredictFault { star: None, key, what })
}

fn predict_star(
    (spec, part): (&Spec, &StarDesign),
    radii: &[f64],
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<(ShellStar, Shape), Refusal> {
    let case = Case::of(spec, &part.star).map_err(|why| fault(key::fabric::THICKNESS, why.to_string()))?;
    let Some(pressure) = case.pressure else {
        let what = "a shell is computed at its pressure, and none is given: give one, or take ring";
        return Err(fault(key::load::PRESSURE, what.to_owned()));
    };
    let points = case.mechanism.points;
    if points > MOST_POINTS {
        let what = format!("{points} points, and shells of stars are computed with 3 to {MOST_POINTS}");
        return Err(fault(key::star::POINTS, what));
    }
    let flat = FlatStar {
        tube: Tube { width: case.mechanism.width, fabric: fabric(&case.sheet), pressure },
        points,
        inner_radius: case.inner_radius,
        tip_angle: case.mechanism.tip_angle,
        tip_radius: case.mechanism.tip_radius,
        corner_radius: case.mechanism.corner_radius,
    };
    // An object that does not enter is not asked about.
    let object = case.object.filter(|object| *object <= case.inner_radius);
    let mut objects: Vec<f64> = radii.iter().copied().chain(object).collect();
    objects.sort_by(f64::total_cmp);
    objects.dedup();
    if objects.len() > MOST_OBJECTS {
        let what = format!("{} radii, and one call takes {MOST_OBJECTS}: ask for fewer", objects.len());
        return Err(fault(key::load::OBJECT_RADIUS, what));
    }
    let found =
        star(&flat, Objects::Radii(&objects), detail.fineness(), watch).map_err(|why| refused(&why))?;
    let answered = Answered { case: &case, part, spec, flat: &flat, found: &found };
    Ok((answered.star(radii, object), found.shape))
}

/// The key that is best changed.
fn refused(why: &ShellFault) -> Refusal {
    let key = match why {
        ShellFault::Cancelled => return Refusal::Cancelled,
        ShellFault::Range { name, .. } if name.starts_with("t/W") => key::star::TUBE_WIDTH,
        ShellFault::Range { name, .. } if name.starts_with("Poisson") => key::fabric::POISSON_RATIO,
        ShellFault::Range { name, .. } if name.starts_with("the") => key::fabric::THICKNESS,
        ShellFault::Range { .. } | ShellFault::Stopped { .. } => key::load::PRESSURE,
        ShellFault::Mesh(_) | ShellFault::TooLarge { .. } => key::star::TIP_ANGLE,
        ShellFault::TooMany { .. } => key::load::OBJECT_RADIUS,
    };
    fault(key, why.to_string())
}

/// An answer of the shell, with all that it is about.
struct Answered<'a> {
    case: &'a Case,
    part: &'a StarDesign,
    spec: &'a Spec,
    flat: &'a FlatStar,
    found: &'a InflatedStar,
}

/// No value of a hinge.
const NONE: Hinges<Option<f64>> = Hinges { tip: None, corner: None };

impl Answered<'_> {
    fn star(&self, radii: &[f64], object: Option<f64>) -> ShellStar {
        let Self { case, part, spec, flat, found } = *self;
        let radius = found.final_radius.scaled(1e3);
        let angle = found.tip_angle.scaled(1.0_f64.to_degrees());
        let area = found.contact_area.scaled(1e6);
        let volume = found.volume.scaled(1e9);
        let contraction = found.final_radius.shifted(-case.inner_radius).scaled(-1.0 / case.inner_radius);
        // Coarse meshes close further, so that an object which only they reach would pull by extrapolation.
        let pressing = |force: &Value| Value { value: force.value.max(0.0), ..*force };
        let force = |radius: f64| found.forces.iter().find(|(at, _)| *at == radius).map(|(_, f)| pressing(f));
        let on_object = object.and_then(force);
        let curve: Vec<(f64, Value)> =
            radii.iter().filter_map(|radius| Some((mm(*radius), force(*radius)?))).collect();
        let extremes = &found.extremes;
        let touches = found.preload.value > 0.0;
        ShellStar {
            model: SHELL,
            lambda_t: NONE,
            lambda_c: NONE,
            d2v_dlambda2: NONE,
            arm_length_mm: part.star.l,
            tip_target_angle_deg: None,
            corner_target_angle_deg: None,
            tip_equilibrium_angle_deg: (!touches).then_some(angle.value),
            tip_angle_deg: angle.value,
            final_radius_mm: radius.value,
            contraction: contraction.value,
            hinge_stiffness_Nm: None,
            radial_stiffness_N_per_m: known(found.radial_stiffness),
            preload_N: None,
            arm_contact_N: found.preload.value,
            arm_contact_mm2: area.value,
            volume_mm3: volume.value,
            graspable_radius_mm: None,
            object_force_N: on_object.map(|force| force.value),
            force_curve: (!radii.is_empty()).then(|| {
                curve.iter().map(|(radius, force)| ForceAt(*radius, force.value, None, None)).collect()
            }),
            bendability: flat.tube.bendability(),
            operating_pressure_kPa: Pressure::from_pascals(case.operating_pressure()).0,
            realised_radius_mm: Hinges {
                tip: part.realised_tip().radius,
                corner: part.realised_corner().radius,
            },
            burst_pressure_kPa: None,
            seal_tension: Place {
                value: 1e-3 * extremes.seal_tension,
                mesh_error: 1e-3 * extremes.seal_tension_error,
                at_mm: extremes.seal_at.map(mm),
            },
            stretch: Place {
                value: extremes.stretch,
                mesh_error: extremes.stretch_error,
                at_mm: extremes.stretch_at.map(mm),
            },
            mass_g: part.mass(&spec.fabric),
            payload_kg: case.friction.zip(on_object).map(|(mu, force)| payload(mu, [force.value])),
            ranges: StarRanges::default(),
            evidence: ShellEvidence {
                fabric: measured(&spec.fabric),
                residual: found.evidence.residual,
                iterations: found.evidence.efforts.iter().map(|effort| effort.iterations).sum(),
                unknowns: found.evidence.unknowns.clone(),
                stretch: flat.tube.stretch(),
                mesh_errors: StarMeshErrors {
                    final_radius_mm: radius.error,
                    contraction: contraction.error,
                    tip_angle_deg: angle.error,
                    radial_stiffness_N_per_m: found.radial_stiffness.error,
                    arm_contact_N: found.preload.error,
                    arm_contact_mm2: area.error,
                    volume_mm3: volume.error,
                    object_force_N: on_object.map(|force| force.error),
                    force_curve: (!radii.is_empty())
                        .then(|| curve.iter().map(|(_, force)| force.error).collect()),
                },
                warnings: self.warnings(object),
            },
        }
    }

    fn warnings(&self, object: Option<f64>) -> Vec<String> {
        let Self { case, flat, found, .. } = self;
        let radius = found.final_radius;
        let too_wide = case.object.is_some() && object.is_none();
        let pull = found.extremes.seal_tension;
        let sharp = flat.tip_radius == 0.0 || flat.corner_radius == 0.0;
        let said = [
            (flat.points > TRIED_POINTS, format!("shells of stars were tried with 3 to {TRIED_POINTS} points")),
            (found.preload.value > 0.0, "the arms touch: the star is pressed shut".to_owned()),
            (
                too_wide,
                format!("the object is wider than the flat star's {} mm: it does not enter", Readable(mm(case.inner_radius))),
            ),
            (
                object.is_some_and(|object| object < radius.value),
                format!("the object is thinner than the final radius, {:.2} mm: the star does not reach it", mm(radius.value)),
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
                known(found.radial_stiffness).is_none(),
                "the meshes do not agree on the radial stiffness: take finer ones".to_owned(),
            ),
            (
                radius.error > 0.05 * radius.value,
                format!("the meshes leave the final radius open by {:.2} mm: take finer ones", mm(radius.error)),
            ),
        ];
        said.into_iter().filter(|(holds, _)| *holds).map(|(_, text)| text).collect()
    }
}

/// A value that the meshes know to less than itself.
fn known(value: Value) -> Option<f64> {
    Some(value.value).filter(|number| *number > value.error)
}

fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}
