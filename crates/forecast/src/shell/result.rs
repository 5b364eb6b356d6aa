//! The shell's values of a star as a text for people: each number with its mesh error.

use crate::meshed::MeshedPlace;
use crate::prediction::{FabricStretch, ForceAt, StarPrediction};
use crate::ranges::shown::{self, line, listed};
use spec::units::Readable;

/// The mesh error of the payload of `star`, kg: in proportion to that of the force on the object.
pub fn payload_mesh_error(star: &StarPrediction) -> Option<f64> {
    let (payload, force) = (star.payload_kg?, star.object_force_N?);
    let open = star.evidence.mesh_errors.as_ref()?.object_force_N?;
    (force > 0.0).then_some(payload * open / force)
}

/// Adds the shell's values of `star` to `page`, a line each; adds no line for another model's answer. The numbers of its meshes are added only if
/// the page `is_full`.
pub fn star_text(page: &mut String, star: &StarPrediction, is_full: bool) {
    let Some(mesh) = &star.evidence.mesh_errors else { return };
    let place = |place: MeshedPlace, unit: &str| {
        let [x, y] = place.at_mm;
        format!("{}, at {x:.1}, {y:.1} mm", shown::meshed(place.value, place.mesh_error, unit))
    };
    let search = star.evidence.accuracy.as_ref().map(|search| format!(" ({search})"));
    line(page, "model", format!("{}{}", star.model, search.unwrap_or_default()));
    line(page, "arm length", format!("{} mm", Readable(star.arm_length_mm)));
    line(page, "tip angle at rest", meshed(star.tip_angle_deg, "deg", mesh.tip_angle_deg));
    let [closed_width, flap_width] =
        [star.final_radius_mm, star.flap_edge_radius_mm].map(|radius| radius.map(|radius| 2.0 * radius));
    let width_error = 2.0 * mesh.final_radius_mm;
    line(page, "closes to, across", meshed(closed_width, "mm", width_error));
    line(page, "flap's edge, across", meshed(flap_width, "mm", width_error));
    let contraction = star.contraction.map(|part| 100.0 * part);
    line(page, "contraction", meshed(contraction, "%", 100.0 * mesh.contraction));
    let stiffness = star.radial_stiffness_N_per_m;
    line(page, "radial stiffness", meshed(stiffness, "N/m", mesh.radial_stiffness_N_per_m));
    line(page, "volume", meshed(star.volume_mm3, "mm^3", mesh.volume_mm3));
    if star.arm_contact_N.is_some_and(|force| force > 0.0) {
        line(page, "arms press on each other", meshed(star.arm_contact_N, "N", mesh.arm_contact_N));
        line(page, "on an area of", meshed(star.arm_contact_mm2, "mm^2", mesh.arm_contact_mm2));
    }
    let force = mesh.object_force_N.and_then(|error| meshed(star.object_force_N, "N", error));
    line(page, "force on the object", force);
    let rubbing = star.object_force_friction_N.map(|ends| ends.map(shown::rounded));
    let rubbing = rubbing.map(|[least, most]| format!("{least} to {most} N"));
    line(page, "the same if corners rub on it", rubbing);
    let forces = star.force_curve.iter().flatten().zip(mesh.force_curve.iter().flatten());
    for (ForceAt { radius, force, .. }, error) in forces {
        line(page, &format!("force on {} mm across", Readable(2.0 * radius)), meshed(*force, "N", *error));
    }
    let pull = star.seal_pull_N_per_mm.zip(star.seal_pull_at_mm);
    let pull = pull.map(|(value, at_mm)| MeshedPlace { value, mesh_error: mesh.seal_pull_N_per_mm, at_mm });
    line(page, "largest pull on the seal", pull.map(|pull| place(pull, "N/mm")));
    line(page, "largest tension at the rim", star.seal_tension.map(|tension| place(tension, "N/mm")));
    if let Some(FabricStretch::Largest(largest)) = star.stretch {
        line(page, "largest stretch", place(largest, ""));
    }
    line(page, "mass", star.mass_g.map(|mass| format!("{} g", Readable(mass))));
    if is_full {
        line(page, "bendability", star.bendability.map(|bendability| Readable(bendability).to_string()));
        line(page, "unknowns of meshes", listed(star.evidence.unknowns.as_deref().unwrap_or_default()));
    }
    for warning in &star.evidence.warnings {
        line(page, "warning", warning.text.clone());
    }
}

/// A value with its mesh error `error`; `None` for none.
fn meshed(value: Option<f64>, unit: &str, error: f64) -> Option<String> {
    Some(shown::meshed(value?, error, unit))
}
