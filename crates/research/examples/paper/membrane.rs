//! The limit of high pressure: an inextensible membrane, the paper's own model.

use stargrip_cam::mechanics::hinge::bvp::Bvp;
use stargrip_cam::mechanics::hinge::fit::target_curvature;
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::hinge::{HingeModel, HingeState};
use stargrip_cam::mechanics::star::Mechanism;
use stargrip_cam::mechanics::star::response::Inflated;
use std::fmt::Write;

use super::paper_fabric::sheet;
use super::stars::paper_star;

/// Its tables up to the target coiling.
pub(crate) fn before() -> String {
    [fabric(), target()].concat()
}

/// Its tables of the volume.
pub(crate) fn volumes() -> String {
    [fit(), volume()].concat()
}

fn state(model: &dyn HingeModel, r_star: f64, lambda: f64) -> HingeState {
    model.state(r_star, lambda).expect("within the model's range")
}

fn of(model: &dyn HingeModel, r_star: f64) -> HingeState {
    model.target(r_star).expect("within the model's range")
}

fn fabric() -> String {
    let sheet = sheet();
    format!(
        "| quantity | value |\n|---|---|\n| B = E t^3 / [12 (1 - nu^2)] | {:.3e} N m |\n| 10^3 B / W^3, W = 20, 30, 40 mm | \
         {:.1}, {:.1}, {:.1} kPa |\n| 1/eps at 37 kPa, W = 30 mm | {:.0} |\n| p W / Y there | {:.3} |\n\n",
        sheet.bending_modulus(),
        sheet.operating_pressure(0.02) * 1e-3,
        sheet.operating_pressure(0.03) * 1e-3,
        sheet.operating_pressure(0.04) * 1e-3,
        sheet.bendability(37e3, 0.03),
        sheet.stretch(37e3, 0.03)
    )
}

/// The lambda at which the bare volume of the penalised problem is largest, by golden sections.
fn bare_target(beta: f64) -> f64 {
    let bvp = Bvp::new(beta, 1e-6);
    let volume = |lambda: f64| bvp.bare_volume(0.1, lambda).expect("within the model's range");
    let ratio = 0.5 * (5_f64.sqrt() - 1.0);
    let (mut low, mut high) = (1.2, 1.36);
    for _ in 0..24 {
        let (a, b) = (high - ratio * (high - low), low + ratio * (high - low));
        if volume(a) > volume(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}

fn target() -> String {
    let mut out = String::from("| lambda_t at R* = 0.1 | value |\n|---|---|\n| published | 1.28 |\n");
    let _ = writeln!(out, "| exact ring | {:.5} |", of(&Ring, 0.1).lambda);
    for beta in [1e3, 1e4, 1e5] {
        let own = of(&Bvp::new(beta, 1e-6), 0.1).lambda;
        let _ = writeln!(
            out,
            "| penalised, beta = {beta}: of its potential, of the bare volume | {own:.4}, {:.4} |",
            bare_target(beta)
        );
    }
    let _ = writeln!(out, "| exact ring at R* = 0, the paper's stars | {:.5} |\n", of(&Ring, 0.0).lambda);
    out
}

/// Second derivative of the least-squares parabola through the exact volume within `window` of the target.
fn parabola(r_star: f64, window: f64) -> f64 {
    let centre = of(&Ring, r_star).lambda;
    let nodes: Vec<(f64, f64)> = (-20..=20)
        .map(|i| window * f64::from(i) / 20.0)
        .map(|d| (d, state(&Ring, r_star, centre + d).volume.expect("known")))
        .collect();
    // The even part of the fit: V = a + c d^2, orthogonal to the odd part on symmetric nodes.
    let mean = |f: &dyn Fn(f64, f64) -> f64| nodes.iter().map(|&(d, v)| f(d, v)).sum::<f64>() / 41.0;
    let (d2, d4) = (mean(&|d, _| d * d), mean(&|d, _| d.powi(4)));
    let (v, vd2) = (mean(&|_, v| v), mean(&|d, v| v * d * d));
    2.0 * (vd2 - v * d2) / (d4 - d2 * d2)
}

fn fit() -> String {
    let mut out = String::from(
        "| R* | published -(0.4659 R* + 0.3986) | exact V'' | published / exact | parabola through +-0.1 / exact |\n|---|---|---|---|---|\n",
    );
    for r_star in [0.05, 0.1, 0.2, 0.5, 1.0, 2.0] {
        let (published, exact) = (target_curvature(r_star), of(&Ring, r_star).curvature);
        let _ = writeln!(
            out,
            "| {r_star} | {published:.4} | {exact:.4} | {:.3} | {:.3} |",
            published / exact,
            parabola(r_star, 0.1) / exact
        );
    }
    out + "\n"
}

fn volume() -> String {
    let mut out = String::from("| lambda | V/V_max, R* = 0.1 | V/V_max, R* = 10 |\n|---|---|---|\n");
    for lambda in [1.0, 1.1, 1.2, 1.25, 1.3, 1.35, 1.4, 1.45, 1.5] {
        let relative = |r_star| {
            state(&Ring, r_star, lambda).volume.expect("known") / of(&Ring, r_star).volume.expect("known")
        };
        let _ = writeln!(out, "| {lambda} | {:.4} | {:.4} |", relative(0.1), relative(10.0));
    }
    out.push_str(
        "\n| R* | kink lambda_c | V'' below | V'' above | target lambda_t |\n|---|---|---|---|---|\n",
    );
    for r_star in [0.0, 0.1, 1.0, 10.0] {
        let onset = Ring.onset(r_star).expect("in range").expect("the ring has one");
        let (below, above) = (state(&Ring, r_star, onset - 1e-9), state(&Ring, r_star, onset + 1e-9));
        let (below, above, target) = (below.curvature, above.curvature, of(&Ring, r_star).lambda);
        let _ = writeln!(out, "| {r_star} | {onset:.4} | {below:.4} | {above:.4} | {target:.4} |");
    }
    out + "\n"
}

/// Stiffness against the scale of all lengths.
pub(crate) fn scale() -> String {
    let mut out = String::from("| lengths by 3 | K / K_0, n = 4 |\n|---|---|\n");
    let stiffness = |eta: f64, pressure: f64| {
        let one = paper_star(4).expect("feasible");
        let star = Mechanism { arm: one.arm * eta, width: one.width * eta, ..one };
        Inflated::new(&star, &Ring, pressure).expect("in range").linear_rest().stiffness
    };
    for (what, power, law) in
        [("p", 0, "eta = 3"), ("p / eta", 1, "1"), ("p / eta^3", 3, "1 / eta^2 = 0.1111")]
    {
        let ratio = stiffness(3.0, 2e4 / 3_f64.powi(power)) / stiffness(1.0, 2e4);
        let _ = writeln!(out, "| pressure {what} (published: {law}) | {ratio:.4} |");
    }
    out + "\n"
}
