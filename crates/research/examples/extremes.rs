//! The mechanics at the ends of every range, as the tables of docs/stability.md.
//!
//! `cargo run --release -p research --example extremes`

use stargrip_cam::design::Star;
use stargrip_cam::forecast::case::mechanism;
use stargrip_cam::mechanics::fault::{HingeFault, StarFault};
use stargrip_cam::mechanics::hinge::bvp::Bvp;
use stargrip_cam::mechanics::hinge::ring::{Ring, limit};
use stargrip_cam::mechanics::hinge::section::Section;
use stargrip_cam::mechanics::hinge::{Hinge, HingeModel, HingeState, seal_load};
use stargrip_cam::mechanics::star::response::Inflated;
use stargrip_cam::spec::StarSpec;
use stargrip_cam::units::{Angle, Length};
use std::fmt::Write;

#[path = "support/edges.rs"]
mod edges;

fn main() {
    print!("{}", tables());
}

/// All tables, in the order of the page.
pub fn tables() -> String {
    let limit = [radius(), coiling(), beta(), rest_angle(), stars(), sizes(), "\n".to_owned()].concat();
    [limit, edges::sizes(), section(), held(), arms(), edges::edges()].concat()
}

fn radius() -> String {
    let mut out =
        String::from("| R* | lambda_t | V''/(1 + R*) | seal load k | r(1) |\n|---|---|---|---|---|\n");
    for r_star in [0.0, 1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 1e2, 1e4, 1e6] {
        let state = Ring.target(r_star).expect("in range");
        let load = seal_load(r_star, &state).map_or("infinite".to_owned(), |k| format!("{k:.6e}"));
        let width = state.edges.map_or(0.0, |edges| edges.width);
        let curvature = state.curvature / (1.0 + r_star);
        let _ = writeln!(out, "| {r_star:e} | {:.9} | {curvature:.8} | {load} | {width:.7} |", state.lambda);
    }
    let limit = limit();
    let _ = writeln!(
        out,
        "| limit | {:.9} | {:.8} | {:.6e} | {:.7} |",
        limit.lambda, limit.curvature_per_r_star, limit.seal_load, limit.width
    );
    for r_star in [-1e-9, 2e6, f64::NAN] {
        let _ = writeln!(
            out,
            "| {r_star:e} | refused: {} | | | |",
            Ring.target(r_star).expect_err("out of range")
        );
    }
    out + "\n"
}

fn coiling() -> String {
    let mut out = String::from(
        "| lambda | V, R* = 0 | V', R* = 0 | V, R* = 1e4 | V', R* = 1e4 |\n|---|---|---|---|---|\n",
    );
    for lambda in [0.01, 0.5, 1.0, 1.25, 1.5, 2.0, 3.0, 3.1] {
        let _ = write!(out, "| {lambda}");
        for r_star in [0.0, 1e4] {
            let _ = match Ring.state(r_star, lambda) {
                Ok(state) => write!(out, " | {:.6} | {:.5}", state.volume.unwrap_or(0.0), state.slope),
                Err(fault) => write!(out, " | refused: {fault} |"),
            };
        }
        out.push_str(" |\n");
    }
    out + "\n"
}

fn beta() -> String {
    let mut out = String::from(
        "| beta | V - V_ring, R* = 0.1, lambda = 1.28 | times beta / ln(beta) | R* = 100 | times beta / ln(beta) |\n|---|---|---|---|---|\n",
    );
    for beta in [5e1, 1e2, 1e3, 1e4, 1e5, 1e6] {
        let _ = write!(out, "| {beta:e}");
        for r_star in [0.1, 100.0] {
            let volume = |model: &dyn HingeModel| model.state(r_star, 1.28).map(|s| s.volume.unwrap_or(0.0));
            let _ = match (volume(&Bvp::new(beta, 1e-6)), volume(&Ring)) {
                (Ok(own), Ok(exact)) => {
                    let gap = own - exact;
                    write!(out, " | {gap:.2e} | {:.3}", gap * beta / beta.ln())
                }
                (Err(fault), _) | (_, Err(fault)) => write!(out, " | refused: {fault} |"),
            };
        }
        out.push_str(" |\n");
    }
    out + "\n"
}

fn rest_angle() -> String {
    let mut out = String::from("| phi_0 | phi_t | C / (p W^3) |\n|---|---|---|\n");
    let target = Ring.target(0.1).expect("in range");
    for degrees in [1e-6, 1.0, 90.0, 179.0, 179.9999, 179.999_999_99] {
        let hinge = Hinge { r_star: 0.1, width: 1.0, rest_angle: f64::to_radians(degrees) };
        let angle = hinge.angle(target.lambda).to_degrees();
        let _ = writeln!(out, "| {degrees} deg | {angle:.6} deg | {:.4e} |", hinge.stiffness(1.0, &target));
    }
    out + "\n"
}

/// A star at `pressure` (Pa): rest and stiffness, or the refusal.
fn row(out: &mut String, what: &str, spec: &StarSpec, pressure: f64) {
    let answer = Star::new(spec)
        .map_err(|refusal| refusal.to_string())
        .and_then(|star| inflated(&star, pressure).map_err(|fault| fault.to_string()));
    let _ = match answer {
        Ok(text) => writeln!(out, "| {what} | {text} |"),
        Err(fault) => writeln!(out, "| {what} | refused: {fault} | | | | |"),
    };
}

fn inflated(star: &Star, pressure: f64) -> Result<String, StarFault> {
    let (mechanism, rho_0) = (mechanism(star), Length(star.rho_0).metres());
    let inflated = Inflated::new(&mechanism, &Ring, pressure)?;
    let (linear, own) = (inflated.linear_rest(), inflated.rest());
    let own =
        own.map_or_else(|fault| format!("refused: {fault}"), |rest| format!("{:.6}", rest.radius / rho_0));
    Ok(format!(
        "{:.4e} | {:.4} deg | {:.6} | {own} | {:.4e}",
        mechanism.arm,
        linear.equilibrium.to_degrees(),
        linear.radius / rho_0,
        linear.stiffness
    ))
}

const HEAD: &str =
    "arm, m | phi_eq | rho_f / rho_0 | the same, nonlinear | stiffness, N/m |\n|---|---|---|---|---|---|\n";

fn paper() -> StarSpec {
    StarSpec::paper(5)
}

fn stars() -> String {
    let mut out = format!("| star | {HEAD}");
    for degrees in [0.001, 1.0, 30.0, 60.0, 100.0, 107.0, 107.99, 107.9999, 108.0, 120.0] {
        let star = StarSpec { tip_angle: Angle(degrees), tube_width: Length(10.0), ..paper() };
        row(&mut out, &format!("n = 5, W = 10 mm, phi_i0 = {degrees} deg"), &star, 1e4);
    }
    // The width at which the arms vanish, from both sides; and the angle at which phi_eq crosses 0.
    let sector = (std::f64::consts::PI / 5.0).sin();
    let vanishing = 50.0 * sector / (15_f64.to_radians().cos() - sector);
    for part in [0.999_999, 0.999_999_999_9, 1.0, 1.000_001] {
        let star = StarSpec { tube_width: Length(part * vanishing), ..paper() };
        row(&mut out, &format!("W = {part} of the width at which l = 0"), &star, 1e4);
    }
    for degrees in [27.9, 28.0, 28.1, 28.2, 28.3] {
        let star = StarSpec { tip_angle: Angle(degrees), ..paper() };
        row(&mut out, &format!("phi_i0 = {degrees} deg"), &star, 1e4);
    }
    for points in [3, 16, 64] {
        let star = StarSpec { points, tube_width: Length(1.0), ..paper() };
        row(&mut out, &format!("n = {points}, W = 1 mm"), &star, 1e4);
    }
    out + "\n"
}

fn sizes() -> String {
    let mut out = format!("| rho_0, p | {HEAD}");
    for (size, pressure) in
        [(1e-3, 1.0), (1e-3, 1e6), (0.05, 1.0), (0.05, 1e6), (30.0, 1.0), (30.0, 1e6), (0.05, 0.0)]
    {
        let of = |part: f64| Length::from_metres(part * size);
        let star = StarSpec { inner_radius: of(1.0), tube_width: of(0.6), tip_radius: of(0.02), ..paper() };
        row(&mut out, &format!("{size} m, {pressure} Pa"), &star, pressure);
    }
    out
}

/// A section's state, or why there is none.
fn said(
    section: Result<Section, HingeFault>,
    ask: impl Fn(&Section) -> Result<HingeState, HingeFault>,
) -> String {
    match section.and_then(|section| ask(&section)) {
        Ok(state) => {
            let width = state.edges.map_or(f64::NAN, |edges| edges.width);
            format!("{:.4} | {:.3e} | {width:.4}", state.lambda, -state.curvature)
        }
        Err(fault) => format!("refused: {fault} | |"),
    }
}

/// The section at the ends of its ranges, one number changed at a time.
fn section() -> String {
    let mut out =
        String::from("| 1/eps, t/W, nu, R* | lambda | C alpha_0 / (p W^3) | width |\n|---|---|---|---|\n");
    let usual = [330.0, 0.015, 0.39, 0.1];
    let mut rows = Vec::new();
    for (place, values) in [
        (0, &[9.9, 10.0, 1e2, 1e3, 4500.0, 4600.0][..]),
        (1, &[0.0029, 0.003, 0.01, 0.03, 0.031]),
        (2, &[-0.01, 0.0, 0.49, 0.5]),
        (3, &[-0.1, 0.0, 1e-6, 1e-3, 1.0, 3.0, 3.1, f64::NAN]),
    ] {
        rows.extend(values.iter().map(|value| {
            let mut row = usual;
            row[place] = *value;
            row
        }));
    }
    for row @ [bendability, thickness, poisson, r_star] in rows {
        let section = Section::new(bendability, thickness, poisson);
        let row = row.map(|number| format!("{number}")).join(", ");
        let _ = writeln!(out, "| {row} | {} |", said(section, |section| section.target(r_star)));
    }
    out + "\n"
}

/// A hinge of the section held far from its rest.
fn held() -> String {
    let mut out = String::from(
        "| lambda held, R* = 0.1 | lambda | -V'' | width | R* = 0 | -V'' | width |\n|---|---|---|---|---|---|---|\n",
    );
    for lambda in [0.29, 0.3, 0.6, 0.8, 1.0, 1.3, 1.7, 1.71] {
        let [even, sharp] = [0.1, 0.0]
            .map(|r_star| said(Section::new(330.0, 0.015, 0.39), |section| section.state(r_star, lambda)));
        let _ = writeln!(out, "| {lambda} | {even} | {sharp} |");
    }
    out + "\n"
}

/// The end of the table of arms.
fn arms() -> String {
    let mut out =
        String::from("| 1/eps, t/W, R* | arc | coils further by | arms give |\n|---|---|---|---|\n");
    for [bendability, thickness, r_star] in [
        [99.0, 0.015, 0.1],
        [100.0, 0.015, 0.1],
        [4400.0, 0.015, 0.1],
        [4500.0, 0.015, 0.1],
        [330.0, 0.0099, 0.1],
        [330.0, 0.01, 0.1],
        [330.0, 0.03, 1.0],
        [330.0, 0.03, 1.01],
    ] {
        for degrees in [10.0_f64, 150.0] {
            let section = Section::new(bendability, thickness, 0.39);
            let said = section
                .ok()
                .and_then(|section| section.arms(r_star, degrees.to_radians()))
                .map_or("unknown | unknown".to_owned(), |arms| {
                    format!("{:.3} deg | {:.1} deg", arms.angle.to_degrees(), arms.give.to_degrees())
                });
            let _ = writeln!(out, "| {bendability}, {thickness}, {r_star} | {degrees} deg | {said} |");
        }
    }
    out + "\n"
}
