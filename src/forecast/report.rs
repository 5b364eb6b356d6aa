//! The answer as a person reads it: what the gripper does, what was assumed, what to beware of.

use crate::forecast::prediction::{Prediction, StarPrediction};
use crate::spec::Spec;
use crate::units::Readable;
use std::fmt::Write;

/// A page about `prediction`.
pub fn text(spec: &Spec, prediction: &Prediction) -> String {
    let mut out = format!("{}\n", spec.name);
    let all_equal = prediction.stars.windows(2).all(|pair| pair[0] == pair[1]);
    if let Some(star) = prediction.stars.first().filter(|_| all_equal) {
        if prediction.stars.len() > 1 {
            let _ = writeln!(out, "\n{} equal stars, each:", prediction.stars.len());
        }
        star_text(&mut out, star);
    } else {
        for (i, star) in prediction.stars.iter().enumerate() {
            let _ = writeln!(out, "\nstar {}:", i + 1);
            star_text(&mut out, star);
        }
    }
    if let Some(mass) = prediction.stack_mass_g.filter(|_| prediction.stars.len() > 1) {
        let _ = writeln!(out, "\nmass of the whole stack         {} g", Readable(mass));
    }
    if let Some(payload) = prediction.first.payload_kg {
        let _ = writeln!(out, "\npayload of the whole stack      {} kg", Readable(payload));
    }
    out
}

fn star_text(out: &mut String, star: &StarPrediction) {
    let mut line = |what: &str, value: String| {
        let _ = writeln!(out, "  {what:30}{value}");
    };
    let show = |value: f64, unit: &str| format!("{} {unit}", Readable(value)).trim_end().to_owned();
    // Why no model will do is a warning, and said there.
    let why = Some(&star.evidence.choice).filter(|choice| !star.evidence.warnings.contains(choice));
    line("model", why.map_or(star.model.to_owned(), |why| format!("{} ({why})", star.model)));
    line("arm length", show(star.arm_length_mm, "mm"));
    line(
        "target coiling tip, corner",
        format!("{}, {}", Readable(star.lambda_t.tip), Readable(star.lambda_t.corner)),
    );
    line("tip angle at rest", show(star.tip_equilibrium_angle_deg.max(0.0), "deg"));
    line("final radius", show(star.final_radius_mm, "mm"));
    line("contraction", show(100.0 * star.contraction, "%"));
    let [least, most] = star.graspable_radius_mm;
    line("holds radii from, to", format!("{} mm, {} mm", Readable(least), Readable(most)));
    line("full actuation from", show(star.operating_pressure_kPa, "kPa"));
    // Without a pressure the limit of high pressure is meant, and only the model's own error is known.
    let closing = match star.evidence.stiffness_error {
        Some(_) => "error of closing, estimated",
        None => "error at high pressure",
    };
    let optional = [
        ("bendability", star.bendability, ""),
        ("hinge stiffness tip", star.hinge_stiffness_Nm.map(|c| c.tip), "N m/rad"),
        ("hinge stiffness corner", star.hinge_stiffness_Nm.map(|c| c.corner), "N m/rad"),
        ("radial stiffness", star.radial_stiffness_N_per_m, "N/m"),
        ("preload when shut", star.preload_N.filter(|f| *f > 0.0), "N"),
        ("force on the object", star.object_force_N, "N"),
        ("burst pressure", star.burst_pressure_kPa, "kPa"),
        ("mass", star.mass_g, "g"),
        (closing, Some(100.0 * star.evidence.coiling_error), "%"),
        ("error of forces, estimated", star.evidence.stiffness_error.map(|e| 100.0 * e), "%"),
    ];
    for (what, value, unit) in optional {
        if let Some(value) = value {
            line(what, show(value, unit));
        }
    }
    for warning in &star.evidence.warnings {
        line("warning", warning.clone());
    }
}
