//! The prediction of a drawn piece as a text for people: each number with its mesh error.

use crate::forecast::drawn::prediction::{ChamberPrediction, DrawnPrediction};
use crate::forecast::meshed::{MeshedPlace, MeshedValue};
use crate::forecast::ranges::shown;
use crate::forecast::shell::SHELL;
use crate::spec::Spec;
use crate::units::Readable;
use std::fmt::Write;

/// A page about `prediction`.
pub fn text(spec: &Spec, prediction: &DrawnPrediction) -> String {
    let mut out = format!("{}\n", spec.name);
    let said = &prediction.evidence.choice;
    line(&mut out, "model", &format!("{} ({said})", prediction.model));
    if let Some(mass) = prediction.mass_g {
        line(&mut out, "mass of one piece", &format!("{} g", Readable(mass)));
    }
    if let Some(volume) = prediction.volume_mm3.filter(|_| prediction.chambers.len() > 1) {
        line(&mut out, "volume of all chambers", &litres(volume));
    }
    if let Some((burst, range)) = prediction.burst_pressure_kPa.zip(prediction.burst_range_kPa) {
        let burst = shown::with_limit(burst, range, "kPa", prediction.pressure_kPa);
        line(&mut out, "burst pressure", &burst);
    }
    if let Some(margin) = prediction.burst_margin {
        line(&mut out, "burst margin", &shown::rounded(margin));
    }
    for warning in &prediction.evidence.warnings {
        line(&mut out, "warning", warning);
    }
    if spec.fabric.shear_modulus.is_none() && prediction.model == SHELL {
        line(
            &mut out,
            "fabric",
            "isotropic; a weave that is soft in shear inflates otherwise (docs/weave.md)",
        );
    }
    for chamber in &prediction.chambers {
        let [x, y] = chamber.at_mm;
        let _ = writeln!(
            out,
            "\nchamber {} of {}, around X {x:.1} Y {y:.1} mm:",
            chamber.chamber,
            prediction.chambers.len()
        );
        of_chamber(&mut out, chamber);
    }
    out
}

fn of_chamber(out: &mut String, chamber: &ChamberPrediction) {
    let [x, y] = chamber.flat_extents_mm;
    line(
        out,
        "flat",
        &format!("{} x {} mm, {} mm^2", Readable(x), Readable(y), Readable(chamber.flat_area_mm2)),
    );
    line(out, "largest circle in it", &format!("{} mm across", shown::rounded(chamber.width_mm)));
    if let Some([x, y]) = chamber.extents_mm {
        line(out, "inflated, along x", &number(x, "mm"));
        line(out, "inflated, along y", &number(y, "mm"));
    }
    let places = [
        ("height", chamber.height_mm, "mm"),
        ("largest pull on the seal", chamber.seal_pull_N_per_mm, "N/mm"),
    ];
    for (what, value, unit) in places {
        if let Some(value) = value {
            line(out, what, &place(value, unit));
        }
    }
    for seam in chamber.seams.iter().filter(|seams| seams.len() > 1).flatten() {
        line(out, &format!("  {}", seam.seam), &place(seam.pull_N_per_mm, "N/mm"));
    }
    if let Some(volume) = chamber.volume_mm3 {
        line(out, "volume", &litres(volume));
    }
    let more = [
        ("largest stretch", chamber.largest_stretch, ""),
        ("largest tension", chamber.largest_tension_N_per_mm, "N/mm"),
    ];
    for (what, value, unit) in more {
        if let Some(value) = value {
            line(out, what, &place(value, unit));
        }
    }
    if let Some((value, leaves)) = chamber.plane_eigenvalue.zip(chamber.leaves_plane) {
        let word = if leaves { "not sure" } else { "yes" };
        line(out, "stays in its plane", &format!("{word}: lowest eigenvalue {} p/W", number(value, "")));
    }
    if let Some(bendability) = chamber.bendability {
        let how = chamber.wrinkles.map_or(String::new(), |how| format!(", wrinkles {how}"));
        line(out, "bendability", &format!("{}{how}", shown::rounded(bendability)));
    }
    if let Some(unknowns) = &chamber.unknowns {
        let unknowns: Vec<String> = unknowns.iter().map(ToString::to_string).collect();
        line(out, "unknowns of meshes", &unknowns.join(", "));
    }
}

fn line(out: &mut String, what: &str, value: &str) {
    // Writing to a String never fails.
    let _ = writeln!(out, "  {what:30}{value}");
}

fn number(value: MeshedValue, unit: &str) -> String {
    shown::meshed(value.value, value.mesh_error, unit)
}

fn litres(volume: MeshedValue) -> String {
    shown::meshed(1e-3 * volume.value, 1e-3 * volume.mesh_error, "cm^3")
}

fn place(value: MeshedPlace, unit: &str) -> String {
    let [x, y] = value.at_mm;
    format!("{}, at X {x:.1} Y {y:.1} mm", shown::meshed(value.value, value.mesh_error, unit))
}
