//! The columns that only shells have: their own measurements of a star, and the mesh error of each number.

use crate::forecast::shell::request::Measurements;
use crate::forecast::study::output::{Of, OutputColumn, StudyRow};

/// Description of a mesh error's column.
const MESH_ERROR: &str = "its mesh error";

const fn measured(
    name: &'static str,
    unit: Option<&'static str>,
    about: &'static str,
    of: fn(&StudyRow<'_>, &Measurements) -> Option<f64>,
) -> OutputColumn {
    OutputColumn { name, unit, about, of: Of::Shell(of) }
}

const fn open(
    name: &'static str,
    unit: Option<&'static str>,
    of: fn(&StudyRow<'_>, &Measurements) -> Option<f64>,
) -> OutputColumn {
    measured(name, unit, MESH_ERROR, of)
}

/// Values by shells alone, in order.
pub(super) const SHELL_OUTPUTS: [OutputColumn; 17] = [
    measured("tip_angle_deg", Some("deg"), "angle of the tips between their arms' lines", |_, shell| {
        Some(shell.tip_angle.value)
    }),
    measured("volume_mm3", Some("mm^3"), "volume of one star", |_, shell| Some(shell.volume.value)),
    measured(
        "arm_contact_N",
        Some("N"),
        "force with which the arms of a tip press on each other",
        |_, shell| Some(shell.contact.value),
    ),
    measured("arm_contact_mm2", Some("mm^2"), "flat area of an arm's sheet that touches", |_, shell| {
        Some(shell.contact_area.value)
    }),
    measured(
        "seal_tension_N_per_mm",
        Some("N/mm"),
        "largest tension of the fabric at the rim",
        |_, shell| Some(shell.seal_tension()[0]),
    ),
    measured("largest_stretch", None, "largest principal stretch of the sheet", |_, shell| {
        Some(shell.extremes.stretch)
    }),
    open("final_radius_mesh_error_mm", Some("mm"), |_, shell| Some(shell.radius.error)),
    open("contraction_mesh_error", None, |_, shell| Some(shell.contraction.error)),
    open("tip_angle_mesh_error_deg", Some("deg"), |_, shell| Some(shell.tip_angle.error)),
    open("radial_stiffness_mesh_error_N_per_m", Some("N/m"), |_, shell| Some(shell.stiffness.error)),
    open("object_force_mesh_error_N", Some("N"), |_, shell| Some(shell.object_force()?.error)),
    open("payload_mesh_error_kg", Some("kg"), |row, shell| row.held(shell.object_force()?.error)),
    open("volume_mesh_error_mm3", Some("mm^3"), |_, shell| Some(shell.volume.error)),
    open("arm_contact_mesh_error_N", Some("N"), |_, shell| Some(shell.contact.error)),
    open("arm_contact_mesh_error_mm2", Some("mm^2"), |_, shell| Some(shell.contact_area.error)),
    open("seal_tension_mesh_error_N_per_mm", Some("N/mm"), |_, shell| Some(shell.seal_tension()[1])),
    open("largest_stretch_mesh_error", None, |_, shell| Some(shell.extremes.stretch_error)),
];
