//! Every number of the paper that the models can give, as the tables of docs/paper.md.
//!
//! `cargo run --release --example paper`

use stargrip_cam::coupon::cone::{Balance, Cone};
use stargrip_cam::design::{Refusal, Star};
use stargrip_cam::forecast::case::mechanism;
use stargrip_cam::mechanics::hinge::bvp::Bvp;
use stargrip_cam::mechanics::hinge::fit::{Fit, target_curvature};
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::hinge::{Hinge, HingeModel, HingeState};
use stargrip_cam::mechanics::star::Mechanism;
use stargrip_cam::mechanics::star::response::Inflated;
use stargrip_cam::mechanics::strength::{ElasticSheet, GRAVITY};
use stargrip_cam::spec::StarSpec;
use std::fmt::Write;

fn main() {
    print!("{}", tables());
}

/// All tables, in the order of the page.
pub fn tables() -> String {
    [
        fabric(),
        target(),
        angles(),
        fit(),
        volume(),
        stiffness(),
        moment(),
        radii(),
        scale(),
        payload(),
        cone(),
    ]
    .concat()
}

fn state(model: &dyn HingeModel, r_star: f64, lambda: f64) -> HingeState {
    model.state(r_star, lambda).expect("within the model's range")
}

fn of(model: &dyn HingeModel, r_star: f64) -> HingeState {
    model.target(r_star).expect("within the model's range")
}

fn fabric() -> String {
    let sheet = ElasticSheet::new(0.3e-3, 128e6, 0.39).expect("valid");
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

fn angles() -> String {
    let mut out = String::from("| phi_0 | phi_t, published 1.28 | phi_t, exact ring |\n|---|---|---|\n");
    for phi_0 in [30.0_f64, 60.0, 75.0, 90.0, 120.0, 150.0, 180.0] {
        let hinge = Hinge { r_star: 0.1, width: 0.02, rest_angle: phi_0.to_radians() };
        let [fit, ring] = [of(&Fit, 0.1), of(&Ring, 0.1)].map(|s| hinge.angle(s.lambda).to_degrees());
        let _ = writeln!(out, "| {phi_0} deg | {fit:.1} deg | {ring:.1} deg |");
    }
    out + "\n"
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

fn stiffness() -> String {
    let mut out = String::from("| W | C/p, published fit | C/p, exact ring |\n|---|---|---|\n");
    for width in [0.02, 0.03, 0.04] {
        let hinge = Hinge { r_star: 0.1, width, rest_angle: 30_f64.to_radians() };
        let [fit, ring] = [of(&Fit, 0.1), of(&Ring, 0.1)].map(|s| hinge.stiffness(1e3, &s) * 1e3);
        let _ =
            writeln!(out, "| {} mm | {fit:.3} mN m/rad per kPa | {ring:.3} mN m/rad per kPa |", width * 1e3);
    }
    out + "\n"
}

fn moment() -> String {
    let mut out =
        String::from("| phi | lambda | M, published parabola | M, exact ring |\n|---|---|---|---|\n");
    let hinge = Hinge { r_star: 0.1, width: 0.02, rest_angle: 60_f64.to_radians() };
    for phi in [0.0_f64, 10.0, 20.0, 26.0, 30.0, 40.0, 50.0, 60.0] {
        let lambda = hinge.coiling(phi.to_radians());
        let [fit, ring] =
            [&Fit as &dyn HingeModel, &Ring].map(|m| hinge.moment(13.8e3, &state(m, 0.1, lambda)) * 1e3);
        let _ = writeln!(out, "| {phi} deg | {lambda:.3} | {fit:.2} mN m | {ring:.2} mN m |");
    }
    out + "\n"
}

fn paper_star(points: u32) -> Result<Mechanism, Refusal> {
    Star::new(&StarSpec::paper(points)).map(|star| mechanism(&star))
}

fn radii() -> String {
    let mut out = String::from(
        "| n | arm | rho_f, lambda_t = 1.28 | contraction | rho_f, exact target | contraction | rho_f, exact V(lambda) | contraction |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for points in 3..=9 {
        match paper_star(points) {
            Ok(star) => {
                let fit = Inflated::new(&star, &Fit, 1e4).expect("in range").linear_rest();
                let ring = Inflated::new(&star, &Ring, 1e4).expect("in range");
                let (linear, own) = (ring.linear_rest(), ring.rest().expect("in range"));
                let _ = write!(out, "| {points} | {:.2} mm", star.arm * 1e3);
                for rest in [fit, linear, own] {
                    let _ = write!(
                        out,
                        " | {:.1} mm | {:.1} %",
                        rest.radius * 1e3,
                        100.0 * (1.0 - rest.radius / 0.05)
                    );
                }
                out.push_str(" |\n");
            }
            Err(fault) => {
                let _ = writeln!(out, "| {points} | {fault} | | | | | | |");
            }
        }
    }
    out + "\n"
}

fn scale() -> String {
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

fn payload() -> String {
    let mut out = String::from(
        "| object radius | F of three stars at 37 kPa, linear | mu for 2.2 kg, 8.7 kg | F, exact V(lambda) | mu for 2.2 kg, 8.7 kg |\n|---|---|---|---|---|\n",
    );
    let star = paper_star(5).expect("feasible");
    let inflated = Inflated::new(&star, &Ring, 37e3).expect("in range");
    let (linear, own) = (inflated.linear_rest(), inflated.rest().expect("in range"));
    for rho in [0.02, 0.03, 0.04, 0.05] {
        let forces = [inflated.linear_force(rho, &linear), inflated.force(rho, &own)];
        let _ = write!(out, "| {} mm", rho * 1e3);
        for force in forces {
            let force = 3.0 * force.expect("in reach");
            let friction = [2.2, 8.7].map(|mass| mass * GRAVITY / force);
            let _ = write!(out, " | {force:.1} N | {:.2}, {:.2}", friction[0], friction[1]);
        }
        out.push_str(" |\n");
    }
    out + "\n"
}

fn cone() -> String {
    let cone = Cone::new(30_f64.to_radians(), 0.1).expect("valid");
    let (derived, published) = (cone.ratio(Balance::Derived), cone.ratio(Balance::Published));
    format!(
        "| balance | F_s / P, gamma = 30 deg, mu = 0.1 |\n|---|---|\n| derived | {derived:.4} |\n| published | {published:.4} |\n"
    )
}
