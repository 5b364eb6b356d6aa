//! What a person reads on the terminal after a command.

use std::fmt::Write;
use std::path::Path;

use crate::design::Design;
use crate::pipeline::Build;
use crate::plan::Pace;
use crate::plan::Program;
use crate::spec::Machine;
use crate::spec::Spec;
use crate::units::Readable;
use crate::verify::Proof;

/// The design: geometry, seams, fabric, what the iron does to the corners.
pub(super) fn design(spec: &Spec, design: &Design, programs: &[Program]) -> String {
    let mut out = format!("{}\n", spec.name);
    for placed in &design.stars {
        let part = design.part(placed);
        let star = &part.star;
        let _ = writeln!(
            out,
            "star {}: {} points, rho_0 {} mm, W {} mm, phi_i0 {} deg, arms {:.2} mm long",
            placed.index,
            star.n,
            Readable(star.rho_0),
            Readable(star.w),
            Readable(star.phi_i.to_degrees()),
            star.l
        );
        let (tip, corner) = (part.realised_tip(), part.realised_corner());
        let _ = writeln!(
            out,
            "  realised radius: tips {:.2} mm (cusp {:.2} mm), corners {:.2} mm (cusp {:.2} mm)",
            tip.radius, tip.cusp, corner.radius, corner.cusp
        );
        let _ = writeln!(
            out,
            "  clear radius at the flap {:.2} mm, fabric {:.0} cm2 a sheet",
            part.clear_radius(),
            part.outline.area() / 100.0
        );
        for program in programs {
            for seam in program.seams.iter().filter(|seam| seam.star == placed.index) {
                let _ = writeln!(
                    out,
                    "  {} loop: {:.1} mm of seam, {}",
                    seam.loop_name(),
                    seam.length,
                    hours(seam.time)
                );
            }
        }
    }
    for sheet in &design.sheets {
        let _ =
            writeln!(out, "sheet {}: {} x {} mm", sheet.index, Readable(sheet.width), Readable(sheet.height));
    }
    let time: f64 = programs.iter().map(|program| program.time).sum();
    let length: f64 = programs.iter().flat_map(|program| &program.seams).map(|seam| seam.length).sum();
    let _ = writeln!(out, "in total {length:.1} mm of seam, {} at {}", hours(time), spec.seal.speed);
    out
}

/// The design, and what was written of it where.
pub(super) fn built(spec: &Spec, machine: &Machine, build: &Build, proof: &Proof, target: &Path) -> String {
    let mut out = design(spec, &build.design, &build.programs);
    let deviation = proof.deviations.iter().map(|(_, mm)| *mm).fold(0.0, f64::max);
    let _ = writeln!(out, "proven: every file within {deviation:.6} mm of the exact geometry");
    let _ = writeln!(out, "machine: {} ({})", machine.name, machine.description);
    out.push_str(&conditions(spec, machine, &build.programs));
    let _ = writeln!(out, "wrote to {}:", target.display());
    for (name, bytes) in build.files() {
        let _ = writeln!(out, "  {name} ({} bytes)", bytes.len());
    }
    out
}

/// What has to be true of the machine for the programs to do what they say.
pub(super) fn conditions(spec: &Spec, machine: &Machine, programs: &[Program]) -> String {
    let mut out = String::new();
    for line in &machine.requires {
        let _ = writeln!(out, "requires: {line}");
    }
    match programs.first().map(|program| program.pace) {
        Some(Pace::Chopped(chop)) => {
            let _ = writeln!(
                out,
                "chopped: strokes of at most {} mm at {:.2} mm/s with dwells, {} on the whole; it counts on an \
                 acceleration of {} mm/s^2{}",
                Readable(chop.longest),
                chop.speed,
                spec.seal.speed,
                Readable(chop.acceleration),
                machine.motion.steps_per_mm.map_or(String::new(), |[x, y, _]| {
                    format!(" and at least {x} (X) and {y} (Y) steps/mm")
                }),
            );
        }
        _ if machine.motion.speed_range().is_none() => {
            let _ = writeln!(
                out,
                "note: the lowest feed of this machine is unknown, and some controllers go several times faster than \
                 {} without a word; `stargrip-cam feedcheck` writes a program that shows it",
                spec.seal.speed
            );
        }
        _ => {}
    }
    out
}

/// A time for people.
pub(super) fn hours(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round();
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}
