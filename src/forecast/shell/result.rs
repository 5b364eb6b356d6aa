//! The shell's values of a star as a text for people: each number with its mesh error.

use crate::forecast::meshed::MeshedPlace;
use crate::forecast::prediction::{FabricStretch, ForceAt, StarPrediction};
use crate::forecast::ranges::shown;
use crate::units::Readable;
use std::fmt::Write;

/// The mesh error of the payload of `star`, kg: in proportion to that of the force on the object.
pub fn payload_mesh_error(star: &StarPrediction) -> Option<f64> {
    let (payload, force) = (star.payload_kg?, star.object_force_N?);
    let open = star.evidence.mesh_errors.as_ref()?.object_force_N?;
    (force > 0.0).then_some(payload * open / force)
}

/// Adds the shell's values of `star` to `out`, a line each; adds no line for another model's answer.
pub fn star_text(out: &mut String, star: &StarPrediction) {
    let Some(mesh) = &star.evidence.mesh_errors else { return };
    let mut line = |what: &str, value: String| {
        let _ = writeln!(out, "  {what:30}{value}");
    };
    let show =
        |value: Option<f64>, unit: &str, error: f64| value.map(|value| shown::meshed(value, error, unit));
    let place = |place: MeshedPlace, unit: &str| {
        let [x, y] = place.at_mm;
        Some(format!("{}, at {x:.1}, {y:.1} mm", shown::meshed(place.value, place.mesh_error, unit)))
    };
    line("model", star.model.to_owned());
    line("arm length", format!("{} mm", Readable(star.arm_length_mm)));
    let touching = star.arm_contact_N.is_some_and(|force| force > 0.0);
    let rubbing = star
        .object_force_friction_N
        .map(|[least, most]| format!("{} to {} N", shown::rounded(least), shown::rounded(most)));
    let percent = |part: Option<f64>| part.map(|part| 100.0 * part);
    let pull = star.seal_pull_N_per_mm.zip(star.seal_pull_at_mm);
    let pull = pull.map(|(value, at_mm)| MeshedPlace { value, mesh_error: mesh.seal_pull_N_per_mm, at_mm });
    let forces = star.force_curve.iter().flatten().zip(mesh.force_curve.iter().flatten());
    let forces = forces.map(|(ForceAt(radius, force, ..), error)| {
        (format!("force at {} mm", Readable(*radius)), show(*force, "N", *error))
    });
    let stretch = match star.stretch {
        FabricStretch::Largest(largest) => place(largest, ""),
        FabricStretch::Ratio(_) => None,
    };
    let known = |what: &str, value: Option<String>| (what.to_owned(), value);
    let numbers = [
        known("tip angle at rest", show(star.tip_angle_deg, "deg", mesh.tip_angle_deg)),
        known("final radius", show(star.final_radius_mm, "mm", mesh.final_radius_mm)),
        known("radius of the flap's edge", show(star.flap_edge_radius_mm, "mm", mesh.final_radius_mm)),
        known("contraction", show(percent(star.contraction), "%", 100.0 * mesh.contraction)),
        known("radial stiffness", show(star.radial_stiffness_N_per_m, "N/m", mesh.radial_stiffness_N_per_m)),
        known("volume", show(star.volume_mm3, "mm^3", mesh.volume_mm3)),
        known(
            "arms press on each other",
            show(star.arm_contact_N, "N", mesh.arm_contact_N).filter(|_| touching),
        ),
        known("on an area of", show(star.arm_contact_mm2, "mm^2", mesh.arm_contact_mm2).filter(|_| touching)),
        known(
            "force on the object",
            mesh.object_force_N.and_then(|error| show(star.object_force_N, "N", error)),
        ),
        known("the same if corners rub on it", rubbing),
    ];
    let of_the_seal = [
        known("largest pull on the seal", pull.and_then(|pull| place(pull, "N/mm"))),
        known("largest tension at the rim", star.seal_tension.and_then(|tension| place(tension, "N/mm"))),
        known("largest stretch", stretch),
        known("bendability", star.bendability.map(|bendability| Readable(bendability).to_string())),
        known("mass", star.mass_g.map(|mass| format!("{} g", Readable(mass)))),
    ];
    for (what, value) in numbers.into_iter().chain(forces).chain(of_the_seal) {
        if let Some(value) = value {
            line(&what, value);
        }
    }
    let unknowns: Vec<String> = star.evidence.unknowns.iter().flatten().map(ToString::to_string).collect();
    line("unknowns of meshes", unknowns.join(", "));
    for warning in &star.evidence.warnings {
        line("warning", warning.clone());
    }
}
