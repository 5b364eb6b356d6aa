//! The prediction of one spec's stars, with its evidence. Lengths in mm, angles in deg.

pub use crate::case::Hinges;
pub use crate::evidence::{MeshErrors, ModelEvidence};
use crate::interval::Interval;
use crate::keys::{Key, keyed, kinds};
use crate::meshed::MeshedPlace;
use crate::outcome::Grip;
use crate::pressures::PressureRow;
use crate::ranges::StarRanges;
use crate::verdict_answer::Verdict;
use inflatable::mechanics::star::Correction;
use serde::Serialize;

/// The payload of a stack, kg, with its range; `None` if unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StackPayload {
    /// Predicted value.
    pub kg: Option<f64>,
    /// Range, from the ranges of force and friction.
    pub range_kg: Option<Interval>,
}

/// The prediction of a gripper. The keys at the top describe star 1, `stars` each star.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct Prediction {
    /// Star 1, `mass_g` included; only `payload_kg` is the whole stack's.
    #[serde(flatten)]
    pub first: StarPrediction,
    /// Whether the object is held; needs object_diameter and a pressure.
    pub verdict: Option<Verdict>,
    /// Mass of all stars' fabric, the top-level `mass_g` of a manifest; needs areal_density.
    pub stack_mass_g: Option<f64>,
    /// All stars, bottom first; `payload_kg` is the star's own share.
    pub stars: Vec<StarPrediction>,
}

keyed! {
    /// The prediction of one star. `None` where a required input is missing.
    #[derive(Clone, Debug, Default, PartialEq, Serialize)]
    #[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
    pub struct StarPrediction {
        /// Model used: fit, ring, bvp, section or shell.
        pub model: &'static str,
        /// Target coiling factor of the hinges. By hinges' models only.
        pub lambda_t: Hinges<Option<f64>>,
        /// Coiling factor at the onset of hoop tension away from the rim. Some models have none.
        pub lambda_c: Hinges<Option<f64>>,
        /// Second derivative of the dimensionless volume by the coiling factor, at the target. By hinges' models only.
        pub d2v_dlambda2: Hinges<Option<f64>>,
        /// Length of the straight arms, mm.
        pub arm_length_mm: f64,
        /// Target angle of a free tip, degrees. Below 0 its arms would cross.
        pub tip_target_angle_deg: Option<f64>,
        /// Target angle of a free corner, degrees.
        pub corner_target_angle_deg: Option<f64>,
        /// Angle of the star's tips at equilibrium, degrees, not clamped where arms touch.
        pub tip_equilibrium_angle_deg: Option<f64>,
        /// Angle between the arms of a tip, degrees, with or without contact. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub tip_angle_deg: Option<f64>,
        /// Inner radius of the inflated, empty star, mm: from the axis to the apex of a corner's inner rim.
        pub final_radius_mm: Option<f64>,
        /// 1 - final radius / inner radius of the flat star.
        pub contraction: Option<f64>,
        /// Stiffness of the hinges at the target, N m per rad. Needs a pressure.
        pub hinge_stiffness_Nm: Option<Hinges<f64>>,
        /// Radial stiffness at rest, all corners together, N/m. Needs a pressure.
        pub radial_stiffness_N_per_m: Option<f64>,
        /// Radial force stored in a star whose arms press on each other, N; 0 if they are free. Needs a pressure.
        pub preload_N: Option<f64>,
        /// Force with which the two arms of a tip press on each other, N; 0 if they do not touch. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub arm_contact_N: Option<f64>,
        /// Flat area of an arm's sheet that touches the next arm, mm^2. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub arm_contact_mm2: Option<f64>,
        /// Volume of the inflated star, mm^3. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub volume_mm3: Option<f64>,
        /// Smallest and largest radius of a round object that the star can hold, mm; at most `hole_radius_mm`, since wider ones do not
        /// enter.
        pub graspable_radius_mm: Option<[f64; 2]>,
        /// Radius of the hole's cut edge, mm. A wider object does not enter the flat star.
        pub hole_radius_mm: f64,
        /// Radius of the hole's cut edge in front of the corners of the closed star, mm: the final radius less band and flap, or 0. It
        /// touches first.
        pub flap_edge_radius_mm: Option<f64>,
        /// Radial force of one star on the object while the flap in front of its corners stays straight, N: the largest that it can be.
        /// `object_force_N` is that of a flap which gives way.
        pub flap_force_N: Option<f64>,
        /// Load under which the flap in front of the corners buckles, N per mm of contact, if both of its sheets are fused.
        pub flap_load_N_per_mm: Option<f64>,
        /// Radius of the object at the star's height, mm; 0 if the star passes above or below it.
        pub object_radius_mm: Option<f64>,
        /// Room between the cut hole and the object before inflation, mm. Below 0 the object does not enter.
        pub object_gap_mm: Option<f64>,
        /// Radial force of one star on the object, N. Needs a pressure and an object.
        pub object_force_N: Option<f64>,
        /// The least and the largest `object_force_N` where the corners rub on the object with the spec's largest friction, N.
        /// By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub object_force_friction_N: Option<[f64; 2]>,
        /// Rows of an object's radius (mm), the radial force of one star (N) and the ends of its range, for the radii that were
        /// requested; null where the star does not hold such an object.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub force_curve: Option<Vec<ForceAt>>,
        /// Pressure over the fabric's resistance to bending, 1/eps = p W^3 / B. Needs a pressure.
        pub bendability: Option<f64>,
        /// Pressure from which the hinges are fully coiled, kPa.
        pub operating_pressure_kPa: f64,
        /// Inner radius of curvature of the hinges as the sealed band makes them, mm.
        pub realised_radius_mm: Hinges<f64>,
        /// Tension of the ring over p W at the realised radius, at an inner rim that cannot stretch. `seal_pull_N_per_mm` is the seal's
        /// own load.
        pub seal_load: Hinges<Option<f64>>,
        /// Largest force that pulls one sheet off the seam's plane, N per mm of seam, as a T-peel test measures it: averaged over the
        /// width of the band. Needs a pressure.
        pub seal_pull_N_per_mm: Option<f64>,
        /// The hinges at which the seal's pull is largest: tips or corners.
        pub seal_pull_at: Option<&'static str>,
        /// Where on the flat star the seal's pull is largest, mm. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub seal_pull_at_mm: Option<[f64; 2]>,
        /// Pressure at which the pull on the seal is the strength of its seam, kPa. Needs the strengths of both loops.
        pub burst_pressure_kPa: Option<f64>,
        /// Largest pull across the rim: `value` in N/mm, its mesh error and its place on the flat star. By the shell only.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub seal_tension: Option<MeshedPlace>,
        /// Mass of the fabric of one star, both sheets, g. Needs `areal_density`.
        pub mass_g: Option<f64>,
        /// Mass that friction holds until arms fold, kg: of the whole stack on the object's slopes, in `stars` of each star on an upright
        /// surface. Needs a pressure, an object and friction.
        pub payload_kg: Option<f64>,
        /// Mass on one star at which its arms wrinkle between plate and object, kg. Needs a pressure and an object.
        pub arm_wrinkling_kg: Option<f64>,
        /// Mass on one star at which its arms fold, kg: the most that it carries.
        pub arm_folding_kg: Option<f64>,
        /// Stretch p W / Y of the fabric. By the shell the largest principal stretch with mesh error and place. Needs a pressure.
        pub stretch: Option<FabricStretch>,
        /// Burst pressure over the pressure. Needs both.
        pub burst_margin: Option<f64>,
        /// Source of the ranges: computed shells. No gripper was measured.
        pub ranges_of: &'static str,
        /// For each number that depends on a model the interval that holds a computed shell's value in at least 95 % of cases. Some may
        /// be unknown.
        pub ranges: StarRanges,
        /// Predictions at several pressures. Only if the spec has no pressure.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub pressures: Option<Vec<PressureRow>>,
        /// The star with the model's own, asymmetric hinges instead of linear ones. By ring and bvp only.
        pub nonlinear: Option<Nonlinear>,
        /// Why this model was used, residuals, iterations, error estimates and `warnings`.
        pub evidence: ModelEvidence,
    } and {
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
}

/// Groups of equal values of `values`: each value once, with the numbers of those that equal it, from 1; of stars the bottom one.
pub fn groups_of_equals<T: PartialEq>(values: impl IntoIterator<Item = T>) -> Vec<(T, Vec<usize>)> {
    let mut groups: Vec<(T, Vec<usize>)> = Vec::new();
    for (number, value) in (1..).zip(values) {
        match groups.iter_mut().find(|(member, _)| *member == value) {
            Some((_, numbers)) => numbers.push(number),
            None => groups.push((value, vec![number])),
        }
    }
    groups
}

kinds! {
    Hinges: Hinges<f64>, Hinges<Option<f64>>;
    Object: Verdict, MeshedPlace, StarRanges, Nonlinear, ModelEvidence;
    List: Vec<PressureRow>, Vec<StarPrediction>;
    Rows: Vec<ForceAt>;
    Variant: FabricStretch;
}

/// Stretch of the fabric.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum FabricStretch {
    /// p W / Y.
    Ratio(f64),
    /// The largest principal stretch; by the shell.
    Largest(MeshedPlace),
}

impl FabricStretch {
    /// p W / Y, where it is that.
    pub fn ratio(self) -> Option<f64> {
        match self {
            Self::Ratio(ratio) => Some(ratio),
            Self::Largest(_) => None,
        }
    }
}

/// The radial force on an object, a row of four numbers in JSON.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceAt {
    /// Radius of the object, mm.
    pub radius: f64,
    /// The force, N; `None` if unknown.
    pub force: Option<f64>,
    /// Lower end of the force's range, N; `None` if unknown.
    pub low: Option<f64>,
    /// Upper end of the force's range, N; `None` if unknown.
    pub high: Option<f64>,
}

impl Serialize for ForceAt {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.radius, self.force, self.low, self.high).serialize(serializer)
    }
}

/// The star whose hinges have the model's own volume V_bar = V / (W^3 alpha_0) as their potential, in place of a linear moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct Nonlinear {
    /// Equilibrium angle of the tips, not clamped.
    pub tip_equilibrium_angle_deg: f64,
    /// Final inner radius.
    pub final_radius_mm: f64,
    /// 1 - rho_f / rho_0.
    pub contraction: f64,
    /// Radial stiffness at rest.
    pub radial_stiffness_N_per_m: Option<f64>,
    /// Radial force that is stored in a star whose arms touch and press on each other.
    pub preload_N: Option<f64>,
    /// Radial force on the object.
    pub object_force_N: Option<f64>,
}

impl Prediction {
    /// The keys of its JSON: those of star 1, then the others.
    pub const KEYS: &'static [&'static [Key]] = &[
        StarPrediction::KEYS,
        &[
            Key::new::<Option<Verdict>>(
                "verdict",
                "Whether the gripper holds the object: `holds` (yes, no or unknown), the force with its range, the needed force and reasons.",
            ),
            Key::new::<Option<f64>>(
                "stack_mass_g",
                "Mass of the fabric of all stars, g. Needs `areal_density`.",
            ),
            Key::new::<Vec<StarPrediction>>(
                "stars",
                "The same keys for each star, bottom first. Those at the top are star 1's, except `payload_kg`.",
            ),
        ],
    ];

    /// The payload of the whole stack.
    pub fn payload(&self) -> StackPayload {
        StackPayload { kg: self.first.payload_kg, range_kg: self.first.ranges.payload_kg }
    }

    /// The answer as one JSON object with a trailing newline.
    ///
    /// # Panics
    /// Never: every field can be written as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data") + "\n"
    }
}
