//! The paper's hinges and stars at the pressures at which they work, as the last tables of docs/paper.md: by the section with its arms, and by
//! the shells that are shipped.
//!
//! `cargo run --release --example paper_at_pressure`

use stargrip_cam::forecast::ranges::against::{Against, against};
use stargrip_cam::forecast::stars::computed::Computed;
use stargrip_cam::forecast::stars::draw::{PAPER_PRESSURES, Set};
use stargrip_cam::forecast::stars::shipped::shipped;
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::hinge::section::Section;
use stargrip_cam::mechanics::hinge::{Hinge, HingeModel};
use stargrip_cam::mechanics::strength::ElasticSheet;
use std::fmt::Write;

fn main() {
    print!("{}", tables());
}

/// All tables, in the order of the page.
pub fn tables() -> String {
    [coiling(), moment(), stiffness(), radii(), forces()].concat()
}

/// Tube widths of the paper, m.
const WIDTHS: [f64; 3] = [0.02, 0.03, 0.04];

fn sheet() -> ElasticSheet {
    ElasticSheet::new(0.3e-3, 128e6, 0.39).expect("valid")
}

fn hinge(width: f64, degrees: f64) -> Hinge {
    Hinge { r_star: 0.1, width, rest_angle: f64::to_radians(degrees) }
}

fn section(width: f64, pressure: f64) -> Option<Section> {
    let sheet = sheet();
    Section::new(sheet.bendability(pressure, width), sheet.thickness / width, sheet.poisson_ratio).ok()
}

/// alpha / alpha_0 of a V-actuator, arms included where their table reaches.
fn coiling() -> String {
    let mut out =
        String::from("| 1/eps | W = 20 mm | W = 30 mm | W = 40 mm, without arms |\n|---|---|---|---|\n");
    for bendability in [100.0, 300.0, 1000.0, 2000.0, 3000.0, 4000.0] {
        let _ = write!(out, "| {bendability}");
        for width in WIDTHS {
            let pressure = bendability * sheet().bending_modulus() / width.powi(3);
            let said = section(width, pressure).and_then(|section| {
                let hinge = hinge(width, 60.0);
                let rest = hinge.rest(&section).ok()?;
                let alpha = hinge.coiling(hinge.angle_of(&section, &rest));
                Some(format!("{alpha:.3} at {:.1} kPa", 1e-3 * pressure))
            });
            let _ = write!(out, " | {}", said.unwrap_or_default());
        }
        out.push_str(" |\n");
    }
    out + "\n"
}

fn moment() -> String {
    let mut out = String::from("| phi | M, exact ring | M, section with arms |\n|---|---|---|\n");
    let (hinge, pressure) = (hinge(0.02, 60.0), 13.8e3);
    let section = section(0.02, pressure).expect("in range");
    for phi in [20.0_f64, 26.0, 30.0, 36.0, 40.0, 50.0, 60.0] {
        let said = |model: &dyn HingeModel| {
            let state = hinge.state_at(model, phi.to_radians());
            state.map_or("refused".to_owned(), |state| {
                format!("{:.2} mN m", 1e3 * hinge.moment(pressure, &state))
            })
        };
        let _ = writeln!(out, "| {phi} deg | {} | {} |", said(&Ring), said(&section));
    }
    out + "\n"
}

fn stiffness() -> String {
    let mut out =
        String::from("| W | phi_0 | C at 14 kPa, exact ring | C at 14 kPa, section |\n|---|---|---|---|\n");
    for (width, degrees) in
        [(0.02, 30.0), (0.02, 60.0), (0.02, 90.0), (0.02, 120.0), (0.03, 60.0), (0.04, 60.0)]
    {
        let (hinge, pressure) = (hinge(width, degrees), 14e3);
        let section = section(width, pressure).expect("in range");
        let [ring, own] = [&Ring as &dyn HingeModel, &section]
            .map(|model| hinge.rest(model).map_or(f64::NAN, |rest| 1e3 * hinge.stiffness(pressure, &rest)));
        let arms = if section.arms(0.1, 1.0).is_some() { "" } else { ", without arms" };
        let _ =
            writeln!(out, "| {} mm | {degrees} deg | {ring:.1} mN m | {own:.1} mN m{arms} |", 1e3 * width);
    }
    out + "\n"
}

/// The paper's stars with what the section says of them.
fn stars() -> Vec<(Computed, Option<Against>)> {
    let own = shipped().into_iter().filter(|star| star.star.set == Set::Paper);
    own.map(|star| (star.clone(), against(&star))).collect()
}

fn radii() -> String {
    let mut out = String::from(
        "| p | n | rho_f, shell | its mesh error | contraction | rho_f, section | its range |\n|---|---|---|---|---|---|---|\n",
    );
    let stars = stars();
    for pressure in PAPER_PRESSURES {
        #[expect(clippy::float_cmp, reason = "both are the constants of the set")]
        let at = stars.iter().filter(|(star, _)| star.star.pressure == pressure);
        for (star, own) in at {
            let Some(found) = &star.found else { continue };
            let radius = found.radius;
            let _ = write!(
                out,
                "| {pressure} kPa | {} | {:.1} mm | {:.1} mm | {:.0} %",
                star.star.points,
                radius.value,
                radius.error,
                100.0 * (1.0 - radius.value / star.star.inner_radius)
            );
            let _ = match own {
                Some(Against { radius, .. }) => {
                    let [low, high] = radius.range.map(|end| 1e3 * end);
                    writeln!(out, " | {:.1} mm | {low:.1} to {high:.1} mm |", 1e3 * radius.predicted)
                }
                None => writeln!(out, " | | unknown |"),
            };
        }
    }
    out + "\n"
}

fn forces() -> String {
    let mut out = String::from(
        "| p | n | object | F, shell | its mesh error | F, section | its range |\n|---|---|---|---|---|---|---|\n",
    );
    for (star, own) in stars() {
        let (Some(found), Some(own)) = (&star.found, own) else { continue };
        for (part, force) in own.forces {
            let [low, high] = force.range;
            let _ = writeln!(
                out,
                "| {} kPa | {} | {:.1} mm | {:.1} N | {:.1} N | {:.1} N | {low:.1} to {high:.1} N |",
                star.star.pressure,
                star.star.points,
                found.radius.value + part * star.star.width,
                force.shell,
                force.mesh,
                force.predicted
            );
        }
    }
    out + "\n"
}
