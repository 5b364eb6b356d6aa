//! The comparison with shells as tables for a terminal: closing, force, the V-actuator, mesh errors, cost.

use crate::trade::computed::{Provenance, provenance};
use crate::trade::shells::{STARS, ShellRow, StarErrors, costs, mesh_errors, rms};
use std::fmt::Write;

/// Which models are measured where the program runs, and which are stored with it.
pub fn sources(rows: &[ShellRow]) -> String {
    let mut measured: Vec<&str> =
        rows.iter().filter(|row| row.is_measured).map(|row| row.model.as_str()).collect();
    measured.dedup();
    let Provenance { commit, date } = provenance();
    format!(
        "Measured on this machine: {}. Stored: shells, computed on {date} by commit {commit}",
        measured.join("; ")
    )
}

/// All tables.
pub fn tables(rows: &[ShellRow]) -> String {
    format!(
        "Closing: errors of rho_f in %, against the finest shells of the paper's stars (those of `shell, fine`: its own mesh errors).\n\n\
         {}\nForce: errors in % of radial stiffness K, and of the force F on an object 0.45 W wider than the finest shell's rho_f.\n\n{}\n\
         V-actuator: against its finest shell.\n\n{}\nMesh errors: how often a shell lies within both mesh errors of the finest.\n\n{}\n\
         Cost of shells of stars, each a process, the force on one object included.\n\n{}",
        closing(rows),
        force(rows),
        actuator(rows),
        meshes(),
        cost()
    )
}

/// A time in the unit for people.
pub(super) fn time(seconds: f64) -> String {
    if seconds == 0.0 {
        return "- us".to_owned();
    }
    match seconds {
        ..1e-6 => format!("{:.2} us", seconds * 1e6),
        ..1e-3 => format!("{:.1} us", seconds * 1e6),
        ..0.1 => format!("{:.1} ms", seconds * 1e3),
        _ => format!("{seconds:.1} s "),
    }
}

fn head(row: &ShellRow) -> String {
    format!("{:15}{:>4} kPa", row.model, row.pressure)
}

/// Every n in its column, and the root of the mean square.
fn columns(row: &ShellRow, decimals: usize, error_of: impl Fn(&StarErrors) -> Option<f64>) -> String {
    let text = |points: u32| {
        let error = row.stars.iter().find(|star| star.points == points).and_then(&error_of);
        error.map_or("-".to_owned(), |error| format!("{:+.decimals$}", 100.0 * error))
    };
    let percent = 100.0 * rms(row.stars.iter().filter_map(&error_of));
    aligned(text, &format!("{percent:.1}"))
}

/// A text for every n, and the last one.
fn aligned(text: impl Fn(u32) -> String, last: &str) -> String {
    STARS.map(|points| format!("{:>7}", text(points))).concat() + &format!("{last:>8}")
}

fn names(heading: &str) -> String {
    aligned(|points| format!("n = {points}"), heading)
}

fn closing(rows: &[ShellRow]) -> String {
    let mut text = format!("{:23}{:>14}{}\n", "rho_f", "time", names("rms"));
    for row in rows.iter().filter(|row| !row.stars.is_empty()) {
        let errors = columns(row, 1, |star| Some(star.radius));
        let _ = writeln!(text, "{}{:>14}{errors}", head(row), time(row.time));
    }
    text
}

fn force(rows: &[ShellRow]) -> String {
    let mut text = format!("{:23}{}  |{}\n", "K | F", names("K rms"), names("F rms"));
    for row in rows.iter().filter(|row| !row.stars.is_empty()) {
        let (stiffness, force) = (columns(row, 0, |star| star.stiffness), columns(row, 0, |star| star.force));
        let _ = writeln!(text, "{}{stiffness}  |{force}", head(row));
    }
    text
}

fn actuator(rows: &[ShellRow]) -> String {
    let mut text = format!("{:23}{:>11}{:>8}\n", "V-actuator", "angle", "C");
    for (row, [angle, stiffness]) in rows.iter().filter_map(|row| row.actuator.map(|own| (row, own))) {
        let (angle, stiffness) = (format!("{angle:+.1} deg"), format!("{:+.0} %", 100.0 * stiffness));
        let _ = writeln!(text, "{}{angle:>11}{stiffness:>8}", head(row));
    }
    text
}

fn meshes() -> String {
    let mut text = format!(
        "{:14}{:10}{:>10}{:>12}{:>20}\n",
        "fineness", "quantity", "holds", "unknown", "furthest, by both"
    );
    for row in mesh_errors().into_iter().filter(|row| row.of + row.unknown > 0) {
        let agreement = format!("{} of {}", row.held, row.of);
        let _ = writeln!(
            text,
            "{:14}{:10}{agreement:>10}{:>12}{:>20.1}",
            row.fineness, row.quantity, row.unknown, row.furthest
        );
    }
    text
}

fn cost() -> String {
    let mut text =
        format!("{:10}{:>8}{:>18}{:>12}{:>12}\n", "fineness", "stars", "finest mesh", "user time", "memory");
    for (fineness, stars, seconds, memory, unknowns) in costs().into_iter().filter(|cost| cost.1 > 0) {
        let _ = writeln!(text, "{fineness:10}{stars:>8}{unknowns:>18}{seconds:>10.1} s{memory:>9.0} MB");
    }
    text
}
