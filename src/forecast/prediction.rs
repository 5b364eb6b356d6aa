//! The answer: what one spec's stars do, with the evidence for it. Lengths in mm, angles in deg.

pub use crate::forecast::case::Hinges;
use crate::forecast::outcome::Grip;
use crate::forecast::pressures::PressureRow;
use crate::forecast::ranges::{Interval, StarRanges, scaled, shown};
use inflatable::mechanics::star::Correction;
use serde::Serialize;

/// What a gripper does. The keys at the top speak of star 1, `stars` of each.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct Prediction {
    /// Star 1, and so is its `mass_g`; only `payload_kg` is the whole stack's.
    #[serde(flatten)]
    pub first: StarPrediction,
    /// What becomes of the object; needs object_diameter and a pressure.
    pub verdict: Option<Verdict>,
    /// Mass of all stars' fabric, what a manifest calls `mass_g` at its top; needs areal_density.
    pub stack_mass_g: Option<f64>,
    /// All stars, bottom first; `payload_kg` is the star's own share.
    pub stars: Vec<StarPrediction>,
}

/// One word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Holds {
    /// Over all of its ranges.
    Yes,
    /// Nowhere in them, or it cannot be.
    No,
    /// Within its ranges it may or may not, or no range is known.
    Unknown,
}

impl Holds {
    /// As a truth value; `None` where it is not known.
    pub fn known(self) -> Option<bool> {
        match self {
            Self::Yes => Some(true),
            Self::No => Some(false),
            Self::Unknown => None,
        }
    }
}

/// What becomes of the object.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct Verdict {
    /// In one word.
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
    /// What the spec leaves open about the object and stars of a stack depend on.
    pub assumed: Option<String>,
    /// Why, and what to do: one sentence each; none if it holds.
    pub reasons: Vec<String>,
}

impl Verdict {
    /// In a word or two: "holds the object".
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

    /// How hard one star presses, where that is not the force of all and a limit is set.
    pub fn one_star(&self) -> Option<String> {
        let bears = self.largest_force_N.filter(|_| self.stars > 1)?;
        let force = shown::with(self.star_force_N?, self.star_force_range_N?, "N");
        Some(format!(
            "of these {} stars the hardest presses with {force}; the object bears {bears} N of one star",
            self.stars
        ))
    }

    /// What is assumed of the object, as a sentence.
    pub fn assumed_in_words(&self) -> Option<String> {
        self.assumed.as_ref().map(|what| format!("the object is {what}"))
    }

    /// The share of the needed force that there is at the least.
    pub fn margin(&self) -> Option<f64> {
        let [low, _] = self.force_range_N?;
        Some(scaled([low, low], self.needed_N?.recip())[0])
    }
}

/// What one star does. `None` where something is missing that the answer needs.
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
    /// Radius of the hole's cut edge: what is wider does not enter the flat star.
    pub hole_radius_mm: f64,
    /// Radius of the hole's cut edge in front of the corners of the closed star, `final_radius_mm` less band and flap: objects touch it first.
    pub flap_edge_radius_mm: Option<f64>,
    /// Radial force on the object while the flap in front of the corners stays straight; `object_force_N` is that of a flap which gives way.
    pub flap_force_N: Option<f64>,
    /// Load per length of contact under which a flap of two fused sheets buckles (Euler); `None` without a flap.
    pub flap_load_N_per_mm: Option<f64>,
    /// Radius of the object at the star's height; 0 where the star passes above or below it.
    pub object_radius_mm: Option<f64>,
    /// Room between the cut hole and what of the object must pass it, before inflation; below 0 the object does not enter.
    pub object_gap_mm: Option<f64>,
    /// Radial force on the object; needs pressure and object_diameter.
    pub object_force_N: Option<f64>,
    /// Radius, mm, and radial force, N, of a round object, with its range, for the radii that were asked for; no force where the star does not hold them.
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
    /// Largest force with which one sheet pulls away from the seam's plane, per length of seam as long as the band is wide: what a T-peel
    /// test measures. Needs a pressure.
    pub seal_pull_N_per_mm: Option<f64>,
    /// At which kind of hinge it is: tips or corners.
    pub seal_pull_at: Option<&'static str>,
    /// Where on the flat star it is, as in `seal_tension`; by the shell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seal_pull_at_mm: Option<[f64; 2]>,
    /// Pressure at which the pull on the seal is seal_strength; needs it.
    pub burst_pressure_kPa: Option<f64>,
    /// The fabric's largest tension at the rim, at one point: its part across the seam's plane is what peels,
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
    /// Whose values `ranges` hold: those of computed shells; no gripper was measured.
    pub ranges_of: &'static str,
    /// In which intervals their values lie in at least 95 % of cases.
    pub ranges: StarRanges,
    /// Without a pressure, what it does at several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressures: Option<Vec<PressureRow>>,
    /// The star with a limit's own, asymmetric V_bar in place of linear hinges; of `section` linear ones are nearer to shells.
    pub nonlinear: Option<Nonlinear>,
    /// How good all this is.
    pub evidence: ModelEvidence,
    /// What becomes of the object; needs pressure and object_diameter.
    #[serde(skip)]
    pub hold: Option<Grip>,
    /// Where no model covers the star at its pressure: the pressures, kPa, at which one does.
    #[serde(skip)]
    pub modelled_kPa: Option<Interval>,
    /// What inflation does to the star beyond hinges and rigid arms.
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
    /// Its mesh error; where a hinge turns on a point there is no largest value, and this says so by being as
    /// large.
    pub mesh_error: f64,
    /// Where on the flat star: in the half sector next to corner 1, the axis at the origin.
    pub at_mm: [f64; 2],
}

/// A radius, mm, the radial force there, N, and the ends of its range; `None` where they are not known.
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
    /// The answer as one JSON object and a line end.
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
    /// Why this model.
    pub choice: String,
    /// What of the fabric was measured, if anything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fabric: Option<&'static str>,
    /// What the model makes of `shear_modulus`, if it is given; without it every model is of isotropic fabric.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weave: Option<&'static str>,
    /// Largest residual of the model's equations.
    pub residual: f64,
    /// Newton steps.
    pub iterations: u32,
    /// Estimated relative error of V_bar against the exact solution of the model's own equations; the shell
    /// has mesh errors.
    pub numerical_error: Option<f64>,
    /// Of the shell: unknowns of each mesh, coarse to fine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknowns: Option<Vec<usize>>,
    /// Stretch p W / Y of the fabric.
    pub stretch: Option<f64>,
    /// Inflated width of the hinges over W; the arms' is 2/pi.
    pub hinge_width: Hinges<Option<f64>>,
    /// Of the shell: how far the meshes leave each number open, in its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_errors: Option<MeshErrors>,
    /// Inner radius from which the seal would hold the pressure, mm, rounded up to a hundredth; `None` if it holds, no
    /// radius helps, or nothing is known.
    pub safe_radius_mm: Option<f64>,
    /// What lies outside of a model's validity, and what a person should know.
    pub warnings: Vec<String>,
    /// Which of the warnings is of a seal that bursts.
    #[serde(skip)]
    pub of_burst: Option<String>,
    /// Which of the warnings is of an object that is not held.
    #[serde(skip)]
    pub of_object: Option<String>,
}

/// Mesh errors: the difference of the last two meshes, or what the extrapolation adds if that is more.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "the keys carry their units as people write them")]
pub struct MeshErrors {
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
    /// Of the pull on the seal.
    pub seal_pull_N_per_mm: f64,
    /// Of the force on the object.
    pub object_force_N: Option<f64>,
    /// Of each force of the curve, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<f64>>,
}
