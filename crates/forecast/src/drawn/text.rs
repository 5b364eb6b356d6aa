//! The prediction of a drawn piece as a text for people: each number with its mesh error.

use crate::drawn::prediction::{ChamberPrediction, DrawnPrediction};
use crate::meshed::{MeshedPlace, MeshedValue};
use crate::ranges::shown::{self, line, listed};
use crate::shell::SHELL;
use spec::Spec;
use spec::units::Readable;
use std::fmt::Write;

/// A page about `prediction`.
pub fn text(spec: &Spec, prediction: &DrawnPrediction) -> String {
    let mut out = format!("{}\n", spec.name);
    let (said, count) = (&prediction.evidence.choice, prediction.chambers.len());
    line(&mut out, "model", format!("{} ({said})", prediction.model));
    line(&mut out, "mass of one piece", prediction.mass_g.map(|mass| format!("{} g", Readable(mass))));
    line(&mut out, "volume of all chambers", prediction.volume_mm3.filter(|_| count > 1).map(litres));
    let burst = prediction.burst_pressure_kPa.zip(prediction.burst_range_kPa);
    let burst = burst.map(|(burst, range)| shown::with_limit(burst, range, "kPa", prediction.pressure_kPa));
    line(&mut out, "burst pressure", burst);
    line(&mut out, "burst margin", prediction.burst_margin.map(shown::rounded));
    for warning in &prediction.evidence.warnings {
        line(&mut out, "warning", warning.clone());
    }
    if spec.fabric.shear_modulus.is_none() && prediction.model == SHELL {
        let isotropic = "isotropic; a weave that is soft in shear inflates otherwise (docs/weave.md)";
        line(&mut out, "fabric", isotropic.to_owned());
    }
    for chamber in &prediction.chambers {
        let [x, y] = chamber.at_mm;
        let number = chamber.chamber;
        let _ = writeln!(out, "\nchamber {number} of {count}, around X {x:.1} Y {y:.1} mm:");
        of_chamber(&mut out, chamber);
    }
    out
}

fn of_chamber(out: &mut String, chamber: &ChamberPrediction) {
    let [x, y] = chamber.flat_extents_mm.map(Readable);
    line(out, "flat", format!("{x} x {y} mm, {} mm^2", Readable(chamber.flat_area_mm2)));
    line(out, "largest circle in it", format!("{} mm across", shown::rounded(chamber.width_mm)));
    line(out, "inflated, along x", chamber.extents_mm.map(|[x, _]| number(x, "mm")));
    line(out, "inflated, along y", chamber.extents_mm.map(|[_, y]| number(y, "mm")));
    line(out, "height", place(chamber.height_mm, "mm"));
    line(out, "largest pull on the seal", place(chamber.seal_pull_N_per_mm, "N/mm"));
    for seam in chamber.seams.iter().filter(|seams| seams.len() > 1).flatten() {
        line(out, &format!("  {}", seam.seam), place(Some(seam.pull_N_per_mm), "N/mm"));
    }
    line(out, "volume", chamber.volume_mm3.map(litres));
    line(out, "largest stretch", place(chamber.largest_stretch, ""));
    line(out, "largest tension", place(chamber.largest_tension_N_per_mm, "N/mm"));
    let stays = chamber.plane_eigenvalue.zip(chamber.leaves_plane).map(|(value, leaves)| {
        let word = if leaves { "not sure" } else { "yes" };
        format!("{word}: lowest eigenvalue {} p/W", number(value, ""))
    });
    line(out, "stays in its plane", stays);
    let wrinkles = chamber.wrinkles.map_or(String::new(), |how| format!(", wrinkles {how}"));
    line(out, "bendability", chamber.bendability.map(|number| shown::rounded(number) + &wrinkles));
    line(out, "unknowns of meshes", chamber.unknowns.as_deref().map(listed));
}

fn number(value: MeshedValue, unit: &str) -> String {
    shown::meshed(value.value, value.mesh_error, unit)
}

fn litres(volume: MeshedValue) -> String {
    shown::meshed(1e-3 * volume.value, 1e-3 * volume.mesh_error, "cm^3")
}

fn place(value: Option<MeshedPlace>, unit: &str) -> Option<String> {
    let MeshedPlace { value, mesh_error, at_mm: [x, y] } = value?;
    Some(format!("{}, at X {x:.1} Y {y:.1} mm", shown::meshed(value, mesh_error, unit)))
}
