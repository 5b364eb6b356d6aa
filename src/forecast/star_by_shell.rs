//! A spec's stars as shells: the same keys as other predictions, with what only a shell knows, and none of what only a
//! hinge's model knows.

use crate::design::{Design, StarDesign};
use crate::forecast::by_shell::{Detail, SHELL, fabric};
use crate::forecast::case::Case;
use crate::forecast::predict::PredictFault;
use crate::forecast::prediction::Hinges;
use crate::mechanics::strength::payload;
use crate::shell::cases::{
    FlatStar, InflatedStar, MOST_OBJECTS, Shape, ShellFault, Tube, Value, Watch, star,
};
use crate::spec::{KeyPath, Spec, key};
use crate::units::{Length, Pressure, Readable};
use serde::Serialize;
use std::fmt::Write;

/// Points with which shells of stars are computed.
const MOST_POINTS: u32 = 16;
/// Points with which they were tried.
const TRIED_POINTS: u32 = 8;

/// What shells say of a gripper. The keys at the top speak of star 1, `stars` of each.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShellPrediction {
    /// Star 1; only `payload_kg` is the whole stack's.
    #[serde(flatten)]
    pub first: ShellStar,
    /// Mass of all stars' fabric; needs areal_density.
    pub stack_mass_g: Option<f64>,
    /// All stars, bottom first.
    pub stars: Vec<ShellStar>,
}

/// What a shell says of one star. `None` where something is missing that the answer needs, or a shell does not know it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct ShellStar {
    /// shell.
    pub model: &'static str,
    /// A hinge's; a shell has none.
    pub lambda_t: Hinges<Option<f64>>,
    /// A hinge's; a shell has none.
    pub lambda_c: Hinges<Option<f64>>,
    /// A hinge's; a shell has none.
    pub d2v_dlambda2: Hinges<Option<f64>>,
    /// Arm length l.
    pub arm_length_mm: f64,
    /// A hinge's; a shell has none.
    pub tip_target_angle_deg: Option<f64>,
    /// A hinge's; a shell has none.
    pub corner_target_angle_deg: Option<f64>,
    /// Angle of the tips where no arms touch; else `None`, because contact is part of the equilibrium.
    pub tip_equilibrium_angle_deg: Option<f64>,
    /// Angle of the tips between the lines of their arms, contact or not.
    pub tip_angle_deg: f64,
    /// From the axis to the apex of a corner's inner rim.
    pub final_radius_mm: f64,
    /// 1 - rho_f / rho_0.
    pub contraction: f64,
    /// A hinge's; a shell has none.
    pub hinge_stiffness_Nm: Option<f64>,
    /// Radial stiffness at rest, all corners together.
    pub radial_stiffness_N_per_m: f64,
    /// The radial force on an object that just touches grows from 0 in a shell: arms that press give way.
    pub preload_N: Option<f64>,
    /// Force with which the two arms of a tip press on each other; 0 where they do not touch.
    pub arm_contact_N: f64,
    /// Flat area of an arm's sheet that touches the next arm.
    pub arm_contact_mm2: f64,
    /// Volume of the star.
    pub volume_mm3: f64,
    /// How far it opens is not known.
    pub graspable_radius_mm: Option<[f64; 2]>,
    /// Radial force on the object; needs object_radius.
    pub object_force_N: Option<f64>,
    /// Radius, mm, and radial force, N, of a round object; its range is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<(f64, f64, Option<f64>, Option<f64>)>>,
    /// Bendability 1/eps.
    pub bendability: f64,
    /// Pressure from which the hinges are fully coiled.
    pub operating_pressure_kPa: f64,
    /// Inner radius of curvature that the band makes of a hinge; the shell has that of the spec.
    pub realised_radius_mm: Hinges<f64>,
    /// A limit's; the shell says what the seal bears at this pressure.
    pub burst_pressure_kPa: Option<f64>,
    /// The largest pull across the rim.
    pub seal_tension: Place,
    /// The largest principal stretch.
    pub stretch: Place,
    /// Mass of the two sheets that are cut for the star; needs areal_density.
    pub mass_g: Option<f64>,
    /// Mass that friction holds; needs object_radius and friction.
    pub payload_kg: Option<f64>,
    /// In which intervals the truth lies.
    pub ranges: StarRanges,
    /// How good all this is.
    pub evidence: ShellEvidence,
}

/// The hardest loaded place for one quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Its value: N/mm of pull, or a stretch.
    pub value: f64,
    /// Its mesh error; where a hinge turns on a point there is no largest value, and this says so by being as large.
    pub mesh_error: f64,
    /// Where on the flat star: in the half sector next to corner 1, the axis at the origin.
    pub at_mm: [f64; 2],
}

/// Intervals in which the truth lies in at least 95 % of cases: not known of any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct StarRanges {
    /// Of the final radius.
    pub final_radius_mm: Option<[f64; 2]>,
    /// Of the contraction.
    pub contraction: Option<[f64; 2]>,
    /// Of the tips' angle.
    pub tip_equilibrium_angle_deg: Option<[f64; 2]>,
    /// Of the radial stiffness.
    pub radial_stiffness_N_per_m: Option<[f64; 2]>,
    /// Of the force on the object.
    pub object_force_N: Option<[f64; 2]>,
    /// Of the payload.
    pub payload_kg: Option<[f64; 2]>,
    /// Of the burst pressure.
    pub burst_pressure_kPa: Option<[f64; 2]>,
}

/// The evidence for a shell's answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShellEvidence {
    /// Residual of the finest mesh by p W^2.
    pub residual: f64,
    /// Newton steps on all meshes.
    pub iterations: u32,
    /// Unknowns of each mesh, coarse to fine.
    pub unknowns: Vec<usize>,
    /// Stretch p W / Y of the fabric.
    pub stretch: f64,
    /// How far the meshes leave each number open, in its unit.
    pub mesh_errors: StarMeshErrors,
    /// What a person should know.
    pub warnings: Vec<String>,
}

/// Mesh errors: the difference of the last two meshes, or what the extrapolation adds if that is more.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct StarMeshErrors {
    /// Of the final radius.
    pub final_radius_mm: f64,
    /// Of the contraction.
    pub contraction: f64,
    /// Of the tips' angle.
    pub tip_angle_deg: f64,
    /// Of the radial stiffness.
    pub radial_stiffness_N_per_m: f64,
    /// Of the force between arms.
    pub arm_contact_N: f64,
    /// Of the area of contact.
    pub arm_contact_mm2: f64,
    /// Of the volume.
    pub volume_mm3: f64,
    /// Of the force on the object.
    pub object_force_N: Option<f64>,
    /// Of each force of the curve, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<f64>>,
}

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
    let found = star(&flat, &objects, detail.fineness(), watch).map_err(|why| refused(&why))?;
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
            radial_stiffness_N_per_m: found.radial_stiffness.value,
            preload_N: None,
            arm_contact_N: found.preload.value,
            arm_contact_mm2: area.value,
            volume_mm3: volume.value,
            graspable_radius_mm: None,
            object_force_N: on_object.map(|force| force.value),
            force_curve: (!radii.is_empty())
                .then(|| curve.iter().map(|(radius, force)| (*radius, force.value, None, None)).collect()),
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
        let known = [
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
                radius.error > 0.05 * radius.value,
                format!("the meshes leave the final radius open by {:.2} mm: take finer ones", mm(radius.error)),
            ),
        ];
        known.into_iter().filter(|(holds, _)| *holds).map(|(_, text)| text).collect()
    }
}

fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

impl ShellPrediction {
    /// The answer as one JSON object and a line end.
    ///
    /// # Panics
    /// Never: every field can be written as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data") + "\n"
    }

    /// The answer as a person reads it.
    pub fn to_text(&self, spec: &Spec) -> String {
        let mut out = format!("{}\n", spec.name);
        let all_equal = self.stars.windows(2).all(|pair| pair[0] == pair[1]);
        let shown = if all_equal { &self.stars[..1.min(self.stars.len())] } else { &self.stars[..] };
        for (i, star) in shown.iter().enumerate() {
            if all_equal && self.stars.len() > 1 {
                let _ = writeln!(out, "\n{} equal stars, each:", self.stars.len());
            } else if !all_equal {
                let _ = writeln!(out, "\nstar {}:", i + 1);
            }
            star.text(&mut out);
        }
        if let Some(payload) = self.first.payload_kg {
            let _ = writeln!(out, "\npayload of the whole stack      {} kg", Readable(payload));
        }
        out
    }
}

impl ShellStar {
    fn text(&self, out: &mut String) {
        let mut line = |what: &str, value: String| {
            let _ = writeln!(out, "  {what:30}{value}");
        };
        let mesh = &self.evidence.mesh_errors;
        let show = |value: f64, unit: &str, error: f64| {
            format!("{} {unit}, mesh error {}", Readable(value), Readable(error)).replace(" ,", ",")
        };
        line("model", self.model.to_owned());
        line("arm length", format!("{} mm", Readable(self.arm_length_mm)));
        line("tip angle at rest", show(self.tip_angle_deg, "deg", mesh.tip_angle_deg));
        line("final radius", show(self.final_radius_mm, "mm", mesh.final_radius_mm));
        line("contraction", show(100.0 * self.contraction, "%", 100.0 * mesh.contraction));
        line("radial stiffness", show(self.radial_stiffness_N_per_m, "N/m", mesh.radial_stiffness_N_per_m));
        line("volume", show(self.volume_mm3, "mm^3", mesh.volume_mm3));
        if self.arm_contact_N > 0.0 {
            line("arms press on each other", show(self.arm_contact_N, "N", mesh.arm_contact_N));
            line("on an area of", show(self.arm_contact_mm2, "mm^2", mesh.arm_contact_mm2));
        }
        if let (Some(force), Some(error)) = (self.object_force_N, mesh.object_force_N) {
            line("force on the object", show(force, "N", error));
        }
        for ((radius, force, ..), error) in
            self.force_curve.iter().flatten().zip(mesh.force_curve.iter().flatten())
        {
            line(&format!("force at {} mm", Readable(*radius)), show(*force, "N", *error));
        }
        let place = |place: &Place, unit: &str| {
            let [x, y] = place.at_mm;
            format!("{}, at {}, {} mm", show(place.value, unit, place.mesh_error), Readable(x), Readable(y))
        };
        line("largest pull on the seal", place(&self.seal_tension, "N/mm"));
        line("largest stretch", place(&self.stretch, ""));
        line("bendability", Readable(self.bendability).to_string());
        if let Some(mass) = self.mass_g {
            line("mass", format!("{} g", Readable(mass)));
        }
        let unknowns: Vec<String> = self.evidence.unknowns.iter().map(ToString::to_string).collect();
        line("unknowns of meshes", unknowns.join(", "));
        for warning in &self.evidence.warnings {
            line("warning", warning.clone());
        }
    }
}
