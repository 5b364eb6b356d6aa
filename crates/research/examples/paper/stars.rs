//! The paper's stars of three to nine points: how far they close, and how hard they press.

use research::predicted::case_of;
use research::stars::computed::ComputedStar;
use research::stars::draw::{PAPER_PRESSURES, Set};
use research::stars::shipped::shipped;
use research::validation::{Comparison, Pressed, compare};
use stargrip_cam::design::{Refusal, Star};
use stargrip_cam::forecast::case::{Case, mechanism};
use stargrip_cam::forecast::interval::Interval;
use stargrip_cam::forecast::model_selection::tabled;
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::mechanics::hinge::fit::Fit;
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::star::Mechanism;
use stargrip_cam::mechanics::star::response::Inflated;
use stargrip_cam::spec::StarSpec;
use std::fmt::Write;

/// rho_0, mm.
pub(crate) const HOLE: f64 = 50.0;
/// Radii of objects in the table of forces, mm.
const RADII: [f64; 6] = [20.0, 25.0, 30.0, 35.0, 40.0, 45.0];

/// The paper's star of W = 30 mm as a mechanism of rigid arms.
pub(crate) fn paper_star(points: u32) -> Result<Mechanism, Refusal> {
    Star::new(&StarSpec::paper(points)).map(|star| mechanism(&star))
}

/// Final radii in m by the closed form, with 1.28, with the exact target, and with the exact V(lambda).
pub(crate) fn limits(star: &Mechanism) -> [f64; 3] {
    let fit = Inflated::new(star, &Fit, 1e4).expect("in range").linear_rest();
    let ring = Inflated::new(star, &Ring, 1e4).expect("in range");
    [fit.radius, ring.linear_rest().radius, ring.rest().expect("in range").radius]
}

/// The closed form's table.
pub(crate) fn closed_form() -> String {
    let mut out = String::from(
        "| n | arm | rho_f, lambda_t = 1.28 | contraction | rho_f, exact target | contraction | rho_f, exact V(lambda) | contraction |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for points in 3..=9 {
        match paper_star(points) {
            Ok(star) => {
                let _ = write!(out, "| {points} | {:.2} mm", star.arm * 1e3);
                for radius in limits(&star).map(|radius| 1e3 * radius) {
                    let _ = write!(out, " | {radius:.1} mm | {:.1} %", 100.0 * (1.0 - radius / HOLE));
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

/// The paper's stars as shells, with the prediction of `section`.
pub(crate) fn stars() -> Vec<(ComputedStar, Option<Comparison>)> {
    let own = shipped().into_iter().filter(|star| star.star.set == Set::Paper);
    own.map(|star| (star.clone(), compare(&star))).collect()
}

/// Final radii at the pressures of the shells.
pub(crate) fn radii() -> String {
    let mut out = String::from(
        "| p | n | rho_f, shell | its mesh error | contraction | rho_f, section | its range |\n|---|---|---|---|---|---|---|\n",
    );
    let stars = stars();
    for pressure in PAPER_PRESSURES {
        let at = stars.iter().filter(|(star, _)| star.star.pressure.total_cmp(&pressure).is_eq());
        for (star, own) in at {
            let Some(found) = &star.found else { continue };
            let radius = found.radius;
            let _ = write!(
                out,
                "| {pressure} kPa | {} | {:.1} mm | {:.1} mm | {:.0} %",
                star.star.points,
                radius.value,
                radius.error,
                100.0 * (1.0 - radius.value / HOLE)
            );
            let _ = match own {
                Some(Comparison { radius, .. }) => {
                    let [low, high] = radius.range.map(|end| 1e3 * end);
                    writeln!(out, " | {:.1} mm | {low:.1} to {high:.1} mm |", 1e3 * radius.predicted)
                }
                None => writeln!(out, " | | unknown |"),
            };
        }
    }
    out + "\n"
}

/// The case of the paper's star of `points` points, and its pressure in Pa.
pub(crate) fn case(points: u32, pressure: f64) -> (Case, f64) {
    let mut all = (1..=Set::Paper.count()).map(|number| Set::Paper.star(number));
    let star = all.find(|star| star.points == points && star.pressure.total_cmp(&pressure).is_eq());
    case_of(&star.expect("it is in the set")).expect("it exists")
}

/// The outcome of that star by `section` around an object of the radius `rho`, mm.
pub(crate) fn around(points: u32, pressure: f64, rho: f64) -> Outcome {
    let (case, pascals) = case(points, pressure);
    let model = tabled(&case, pascals).expect("in range");
    Outcome::by_model(&Case { object: Some(1e-3 * rho), ..case }, &model).expect("in range").1
}

/// F on an object of the radius `rho`, mm, and its range; `None` where the star does not reach it.
pub(crate) fn force(points: u32, pressure: f64, rho: f64) -> Option<(f64, Option<Interval>)> {
    let outcome = around(points, pressure, rho);
    let reached = 1e-3 * rho >= outcome.rest.radius;
    outcome.object_force().filter(|_| reached).map(|force| (force, outcome.force_range))
}

/// F(rho) of five points by `section`.
pub(crate) fn curves() -> String {
    let mut out = String::from("| p | rho_f");
    for rho in RADII {
        let _ = write!(out, " | F at rho = {rho} mm");
    }
    out.push_str(" |\n|---|---|---|---|---|---|---|---|\n");
    for pressure in PAPER_PRESSURES {
        let _ = write!(out, "| {pressure} kPa | {:.1} mm", 1e3 * around(5, pressure, HOLE).rest.radius);
        for rho in RADII {
            let said = force(5, pressure, rho).map(|(force, range)| match range {
                Some([low, high]) => format!("{force:.1} N, {low:.1} to {high:.1}"),
                None => format!("{force:.1} N, unknown"),
            });
            let _ = write!(out, " | {}", said.unwrap_or_default());
        }
        out.push_str(" |\n");
    }
    out + "\n"
}

/// Forces of shells beside those of `section`.
pub(crate) fn forces() -> String {
    let mut out = String::from(
        "| p | n | object | F, shell | its mesh error | F, section | its range |\n|---|---|---|---|---|---|---|\n",
    );
    for (star, own) in stars() {
        let (Some(found), Some(own)) = (&star.found, own) else { continue };
        for Pressed { opening, force, .. } in own.forces {
            let [low, high] = force.range;
            let _ = writeln!(
                out,
                "| {} kPa | {} | {:.1} mm | {:.1} N | {:.1} N | {:.1} N | {low:.1} to {high:.1} N |",
                star.star.pressure,
                star.star.points,
                found.radius.value + opening * star.star.width,
                force.shell,
                force.mesh,
                force.predicted
            );
        }
    }
    out + "\n"
}
