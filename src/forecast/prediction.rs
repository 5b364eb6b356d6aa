//! The prediction of one spec's stars, with its evidence. Lengths in mm, angles in deg.

pub use crate::forecast::case::Hinges;
use crate::forecast::outcome::Grip;
use crate::forecast::pressures::PressureRow;
use crate::forecast::ranges::{Interval, StarRanges, shown};
use inflatable::mechanics::star::Correction;
use serde::Serialize;

/// The prediction of a gripper. The keys at the top describe star 1, `stars` each star.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct Prediction {
    /// Star 1, and so is its `mass_g`; only `payload_kg` is the whole stack's.
    #[serde(flatten)]
    pub first: StarPrediction,
    /// Whether the object is held; needs object_diameter and a pressure.
    pub verdict: Option<Verdict>,
    /// Mass of all stars' fabric, the top-level `mass_g` of a manifest; needs areal_density.
    pub stack_mass_g: Option<f64>,
    /// All stars, bottom first; `payload_kg` is the star's own share.
    pub stars: Vec<StarPrediction>,
}

/// Whether the object is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Holds {
    /// Yes, over all of its ranges.
    Yes,
    /// Nowhere in its ranges, or it is impossible.
    No,
    /// It depends on the position within the ranges, or no range is available.
    Unknown,
}

impl Holds {
    /// As a truth value; `None` for [`Holds::Unknown`].
    pub fn known(self) -> Option<bool> {
        match self {
            Self::Yes => Some(true),
            Self::No => Some(false),
            Self::Unknown => None,
        }
    }
}

/// Whether the gripper holds the object, with reasons.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct Verdict {
    /// The verdict.
    pub holds: Holds,
    /// The first reason as a code of docs/codes.md; `None` if it holds.
    pub code: Option<&'static str>,
    /// Radial force of all stars.
    pub force_N: Option<f64>,
    /// Its range.
    pub force_range_N: Option<Interval>,
    /// Radial force that friction needs to hold the mass.
    pub needed_N: Option<f64>,
    /// Radial force of the star that presses hardest.
    pub star_force_N: Option<f64>,
    /// Its range.
    pub star_force_range_N: Option<Interval>,
    /// Radial force of one star that the object bears.
    pub largest_force_N: Option<f64>,
    /// Number of stars.
    pub stars: usize,
    /// Assumptions about the object that the stars of a stack depend on and the spec leaves open.
    pub assumed: Option<String>,
    /// The reasons and remedies, one sentence each; empty if it holds.
    pub reasons: Vec<String>,
}

impl Verdict {
    /// As a phrase: "holds the object".
    pub fn word(&self) -> &'static str {
        match self.holds {
            Holds::Yes => "holds the object",
            Holds::No => "does not hold the object",
            Holds::Unknown => "may hold the object",
        }
    }

    /// As one line, without the reasons.
    pub fn line(&self) -> String {
        let word = self.word();
        let force = match (self.force_N, self.force_range_N) {
            (Some(force), Some(range)) if range[1] > 0.0 => {
                format!(" with {}", shown::with(force, range, "N"))
            }
            _ => String::new(),
        };
        let needed = self.needed_N.map_or(String::new(), |needed| format!(" ({needed:.1} N are needed)"));
        format!("{word}{force}{needed}")
    }

    /// The force of one star, if it differs from the force of all and a limit is set.
    pub fn one_star(&self) -> Option<String> {
        let bears = self.largest_force_N.filter(|_| self.stars > 1)?;
        let force = shown::with(self.star_force_N?, self.star_force_range_N?, "N");
        Some(format!(
            "of these {} stars the hardest presses with {force}; the object bears {bears} N of one star",
            self.stars
        ))
    }

    /// The assumption about the object, as a sentence.
    pub fn assumed_in_words(&self) -> Option<String> {
        self.assumed.as_ref().map(|what| format!("the object is {what}"))
    }
}

/// The prediction of one star. `None` where a required input is missing.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct StarPrediction {
    /// The model that answered: fit, ring, bvp, section or shell.
    pub model: &'static str,
    /// Target coiling factor lambda_t.
    pub lambda_t: Hinges<Option<f64>>,
    /// Onset lambda_c of hoop tension away from the rim.
    pub lambda_c: Hinges<Option<f64>>,
    /// d2V_bar/dlambda2 at the target.
    pub d2v_dlambda2: Hinges<Option<f64>>,
    /// Arm length l.
    pub arm_length_mm: f64,
    /// Target angle phi_it of a free tip; below 0 its arms would cross.
    pub tip_target_angle_deg: Option<f64>,
    /// Target angle phi_et of a free corner.
    pub corner_target_angle_deg: Option<f64>,
    /// Equilibrium angle phi_i^eq of the star's tips, linear hinges, not clamped.
    pub tip_equilibrium_angle_deg: Option<f64>,
    /// Angle of the tips between the lines of their arms, contact or not; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_angle_deg: Option<f64>,
    /// Final inner radius rho_f: of hinges' models with linear hinges.
    pub final_radius_mm: Option<f64>,
    /// 1 - rho_f / rho_0.
    pub contraction: Option<f64>,
    /// Hinge stiffness C at the target; needs a pressure.
    pub hinge_stiffness_Nm: Option<Hinges<f64>>,
    /// Radial stiffness K at rest, all corners together; needs a pressure.
    pub radial_stiffness_N_per_m: Option<f64>,
    /// Radial force stored in a star that is pressed shut; 0 for one that is free; needs a pressure.
    pub preload_N: Option<f64>,
    /// Force with which the two arms of a tip press on each other, 0 where they do not touch; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm_contact_N: Option<f64>,
    /// Flat area of an arm's sheet that touches the next arm; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm_contact_mm2: Option<f64>,
    /// Volume of the star; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_mm3: Option<f64>,
    /// Radii that the star can hold: from rho_f to the largest that the inflated star opens to, or to hole_radius_mm where that is
    /// less, because a wider object does not enter the flat star.
    pub graspable_radius_mm: Option<[f64; 2]>,
    /// Radius of the hole's cut edge: a wider object does not enter the flat star.
    pub hole_radius_mm: f64,
    /// Radius of the hole's cut edge in front of the corners of the closed star, `final_radius_mm` less band and flap: objects touch it first.
    pub flap_edge_radius_mm: Option<f64>,
    /// Radial force on the object while the flap in front of the corners stays straight; `object_force_N` is that of a flap which gives way.
    pub flap_force_N: Option<f64>,
    /// Load per length of contact under which a flap of two fused sheets buckles (Euler); `None` without a flap.
    pub flap_load_N_per_mm: Option<f64>,
    /// Radius of the object at the star's height; 0 where the star passes above or below it.
    pub object_radius_mm: Option<f64>,
    /// Clearance between the cut hole and the part of the object that must pass it, before inflation; the object does not enter if
    /// negative.
    pub object_gap_mm: Option<f64>,
    /// Radial force on the object; needs pressure and object_diameter.
    pub object_force_N: Option<f64>,
    /// Radius, mm, and radial force, N, of a round object, with its range, for each requested radius; no force where the star does not hold it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<ForceAt>>,
    /// Bendability 1/eps; needs a pressure.
    pub bendability: Option<f64>,
    /// Pressure from which the hinges are fully coiled.
    pub operating_pressure_kPa: f64,
    /// Inner radius of curvature that the band makes of a hinge, at least half the band.
    pub realised_radius_mm: Hinges<f64>,
    /// The ring's tension over p W at the realised radius: of the fabric at an inner rim that cannot stretch. The seal's own load is
    /// `seal_pull_N_per_mm`.
    pub seal_load: Hinges<Option<f64>>,
    /// Largest force with which one sheet pulls away from the seam's plane, per length of seam, averaged over the width of the band: the
    /// quantity of a T-peel test. Needs a pressure.
    pub seal_pull_N_per_mm: Option<f64>,
    /// The kind of hinge with the largest pull: tips or corners.
    pub seal_pull_at: Option<&'static str>,
    /// Its position on the flat star, as in `seal_tension`; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seal_pull_at_mm: Option<[f64; 2]>,
    /// Pressure at which the pull on the seal is seal_strength; needs it.
    pub burst_pressure_kPa: Option<f64>,
    /// The fabric's largest tension at the rim, at one point; its component across the seam's plane peels the seal,
    /// see docs/models.md; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seal_tension: Option<LoadedPlace>,
    /// Mass of the two sheets that are cut for the star; needs areal_density.
    pub mass_g: Option<f64>,
    /// Mass that friction holds; needs pressure, object_radius and friction.
    pub payload_kg: Option<f64>,
    /// Stretch of the fabric; needs a pressure.
    pub stretch: FabricStretch,
    /// Burst pressure over the pressure; needs both.
    pub burst_margin: Option<f64>,
    /// The source of the values in `ranges`: computed shells; no gripper was measured.
    pub ranges_of: &'static str,
    /// Intervals that contain the shells' values in at least 95 % of cases.
    pub ranges: StarRanges,
    /// Values at several pressures, if the spec gives none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressures: Option<Vec<PressureRow>>,
    /// The star with a limit's own, asymmetric V_bar in place of linear hinges; of `section` linear ones are nearer to shells.
    pub nonlinear: Option<Nonlinear>,
    /// The evidence for these values.
    pub evidence: ModelEvidence,
    /// The object's state; needs pressure and object_diameter.
    #[serde(skip)]
    pub hold: Option<Grip>,
    /// The pressures, kPa, at which a model covers the star, if none does at its own pressure.
    #[serde(skip)]
    pub modelled_kPa: Option<Interval>,
    /// Corrections of the inflated star beyond hinges and rigid arms.
    #[serde(skip)]
    pub correction: Correction,
}

/// Stretch of the fabric.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum FabricStretch {
    /// p W / Y; `None` without a pressure.
    Ratio(Option<f64>),
    /// The largest principal stretch; by the shell.
    Largest(LoadedPlace),
}

impl FabricStretch {
    /// p W / Y, where it is that.
    pub fn ratio(self) -> Option<f64> {
        match self {
            Self::Ratio(ratio) => ratio,
            Self::Largest(_) => None,
        }
    }
}

/// The hardest loaded place for one quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LoadedPlace {
    /// Its value: N/mm of pull, or a stretch.
    pub value: f64,
    /// Its mesh error. Where a hinge turns on a point there is no largest value; then the mesh error is as large as
    /// the value.
    pub mesh_error: f64,
    /// Its position on the flat star: in the half sector next to corner 1, the axis at the origin.
    pub at_mm: [f64; 2],
}

/// A radius, mm, the radial force there, N, and the ends of its range; `None` if unknown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ForceAt(pub f64, pub Option<f64>, pub Option<f64>, pub Option<f64>);

/// The same star with the model's own V_bar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct Nonlinear {
    /// Equilibrium angle of the tips, not clamped.
    pub tip_equilibrium_angle_deg: f64,
    /// Final inner radius.
    pub final_radius_mm: f64,
    /// 1 - rho_f / rho_0.
    pub contraction: f64,
    /// Radial stiffness at rest.
    pub radial_stiffness_N_per_m: Option<f64>,
    /// Radial force stored in a star that is pressed shut.
    pub preload_N: Option<f64>,
    /// Radial force on the object.
    pub object_force_N: Option<f64>,
}

impl Prediction {
    /// The answer as one JSON object with a trailing newline.
    ///
    /// # Panics
    /// Never: every field can be written as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data") + "\n"
    }
}

/// The evidence for an answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelEvidence {
    /// Reason for the choice of this model.
    pub choice: String,
    /// The measured properties of the fabric, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fabric: Option<&'static str>,
    /// The model's use of `shear_modulus`, if it is given; without it every model assumes isotropic fabric.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weave: Option<&'static str>,
    /// Largest residual of the model's equations.
    pub residual: f64,
    /// Newton steps.
    pub iterations: u32,
    /// Estimated relative error of V_bar against the exact solution of the model's own equations; the shell
    /// has mesh errors.
    pub numerical_error: Option<f64>,
    /// Unknowns of each mesh of the shell, coarse to fine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknowns: Option<Vec<usize>>,
    /// Stretch p W / Y of the fabric.
    pub stretch: Option<f64>,
    /// Inflated width of the hinges over W; the arms' is 2/pi.
    pub hinge_width: Hinges<Option<f64>>,
    /// Mesh error of each of the shell's numbers, in its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_errors: Option<MeshErrors>,
    /// Least inner radius at which the seal withstands the pressure, mm, rounded up to a hundredth; `None` if the seal
    /// withstands it already, no radius is enough, or it is unknown.
    pub safe_radius_mm: Option<f64>,
    /// Limits of a model's validity that are exceeded, and other warnings for the user.
    pub warnings: Vec<String>,
    /// Index of the warning about a bursting seal.
    #[serde(skip)]
    pub of_burst: Option<String>,
    /// Index of the warning about an object that is not held.
    #[serde(skip)]
    pub of_object: Option<String>,
}

/// Mesh errors: the difference of the last two meshes, or the extrapolation's change if it is larger.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct MeshErrors {
    /// Error of the final radius.
    pub final_radius_mm: f64,
    /// Error of the contraction.
    pub contraction: f64,
    /// Error of the tips' angle.
    pub tip_angle_deg: f64,
    /// Error of the radial stiffness.
    pub radial_stiffness_N_per_m: f64,
    /// Error of the force between arms.
    pub arm_contact_N: f64,
    /// Error of the area of contact.
    pub arm_contact_mm2: f64,
    /// Error of the volume.
    pub volume_mm3: f64,
    /// Error of the pull on the seal.
    pub seal_pull_N_per_mm: f64,
    /// Error of the force on the object.
    pub object_force_N: Option<f64>,
    /// Error of each force of the curve, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<f64>>,
}
