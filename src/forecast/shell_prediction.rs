//! What a shell answers about stars: the keys of other predictions, with what only a shell knows, and none of what only a
//! hinge's model knows.

use crate::forecast::prediction::{ForceAt, Hinges};
use crate::forecast::ranges::{StarRanges, shown};
use crate::spec::Spec;
use crate::units::Readable;
use serde::Serialize;
use std::fmt::Write;

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
    /// Radial stiffness at rest, all corners together; `None` where the meshes leave it open by more than itself.
    pub radial_stiffness_N_per_m: Option<f64>,
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
    /// Radius of the hole's cut edge: what is wider does not enter the flat star.
    pub hole_radius_mm: f64,
    /// Radius of the object at the star's height; 0 where the star passes above or below it.
    pub object_radius_mm: Option<f64>,
    /// Room between the cut hole and what of the object must pass it, before inflation; below 0 the object does not enter.
    pub object_gap_mm: Option<f64>,
    /// Radial force on the object; needs object_diameter.
    pub object_force_N: Option<f64>,
    /// Radius, mm, and radial force, N, of a round object; its range is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<ForceAt>>,
    /// Bendability 1/eps.
    pub bendability: f64,
    /// Pressure from which the hinges are fully coiled.
    pub operating_pressure_kPa: f64,
    /// Inner radius of curvature that the band makes of a hinge; the shell has that of the spec.
    pub realised_radius_mm: Hinges<f64>,
    /// A limit's; the shell says what the seal bears at this pressure.
    pub burst_pressure_kPa: Option<f64>,
    /// The fabric's largest tension at the rim, at one point: its part across the seam's plane is what peels, see docs/models.md.
    pub seal_tension: Place,
    /// The largest principal stretch.
    pub stretch: Place,
    /// Mass of the two sheets that are cut for the star; needs areal_density.
    pub mass_g: Option<f64>,
    /// Mass that friction holds; needs object_radius and friction.
    pub payload_kg: Option<f64>,
    /// Ranges of predictions: not known of any, but by how much the meshes leave each number open.
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

/// The evidence for a shell's answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShellEvidence {
    /// What of the fabric was measured, if anything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fabric: Option<&'static str>,
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
            let open =
                self.stars.iter().filter_map(ShellStar::payload_mesh_error).reduce(|sum, one| sum + one);
            let said =
                open.map_or(format!("{} kg", Readable(payload)), |open| shown::meshed(payload, open, "kg"));
            let _ = writeln!(out, "\npayload of the whole stack      {said}");
        }
        out
    }
}

impl ShellStar {
    /// How far the meshes leave its payload open, kg: by as much as the force on the object.
    fn payload_mesh_error(&self) -> Option<f64> {
        let (payload, force) = (self.payload_kg?, self.object_force_N?);
        let open = self.evidence.mesh_errors.object_force_N?;
        (force > 0.0).then_some(payload * open / force)
    }

    fn text(&self, out: &mut String) {
        let mut line = |what: &str, value: String| {
            let _ = writeln!(out, "  {what:30}{value}");
        };
        let mesh = &self.evidence.mesh_errors;
        let show = |value: f64, unit: &str, error: f64| shown::meshed(value, error, unit);
        line("model", self.model.to_owned());
        line("arm length", format!("{} mm", Readable(self.arm_length_mm)));
        line("tip angle at rest", show(self.tip_angle_deg, "deg", mesh.tip_angle_deg));
        line("final radius", show(self.final_radius_mm, "mm", mesh.final_radius_mm));
        line("contraction", show(100.0 * self.contraction, "%", 100.0 * mesh.contraction));
        if let Some(stiffness) = self.radial_stiffness_N_per_m {
            line("radial stiffness", show(stiffness, "N/m", mesh.radial_stiffness_N_per_m));
        }
        line("volume", show(self.volume_mm3, "mm^3", mesh.volume_mm3));
        if self.arm_contact_N > 0.0 {
            line("arms press on each other", show(self.arm_contact_N, "N", mesh.arm_contact_N));
            line("on an area of", show(self.arm_contact_mm2, "mm^2", mesh.arm_contact_mm2));
        }
        if let (Some(force), Some(error)) = (self.object_force_N, mesh.object_force_N) {
            line("force on the object", show(force, "N", error));
        }
        for (ForceAt(radius, force, ..), error) in
            self.force_curve.iter().flatten().zip(mesh.force_curve.iter().flatten())
        {
            if let Some(force) = *force {
                line(&format!("force at {} mm", Readable(*radius)), show(force, "N", *error));
            }
        }
        let place = |place: &Place, unit: &str| {
            let [x, y] = place.at_mm;
            format!("{}, at {x:.1}, {y:.1} mm", show(place.value, unit, place.mesh_error))
        };
        line("largest tension at the rim", place(&self.seal_tension, "N/mm"));
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
