//! Payload of the paper's gripper: friction, coating, mass; and its stars on coarse meshes.

use stargrip_cam::design::StarDesign;
use stargrip_cam::mechanics::strength::GRAVITY;
use stargrip_cam::spec::{Source, read};
use std::fmt::Write;

use super::shells::{GRADINGS, coarse};
use super::stars::{HOLE, force};

/// Stars of the gripper, their published mass in g, and the published payloads in kg.
const STARS: f64 = 3.0;
const MASS: f64 = 60.0;
const HELD: [f64; 2] = [2.2, 8.7];
/// Density of VPS-32 by its maker, kg/m^3.
const SILICONE: f64 = 1160.0;
/// Mass of a drained film over that of a film as thick as its lower edge everywhere; the thickness grows like a square root.
const MEAN: f64 = 2.0 / 3.0;

/// Friction that the payloads take.
pub(crate) fn payload() -> String {
    let mut out = String::from(
        "| object radius | F of three stars, section | its range | mu for 2.2 kg, bare | its range | mu for 8.7 kg, coated | its range |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for rho in [20.0, 30.0, 40.0, HOLE] {
        let Some((one, range)) = force(5, 37.0, rho) else { continue };
        let all = STARS * one;
        let range = range.map(|range| range.map(|end| STARS * end));
        let said = range.map_or("unknown".to_owned(), |[low, high]| format!("{low:.1} to {high:.1} N"));
        let _ = write!(out, "| {rho} mm | {all:.1} N | {said}");
        for weight in HELD.map(|mass| mass * GRAVITY) {
            let range = range.map(|[low, high]| [weight / high, weight / low]);
            let said = range.map_or("unknown".to_owned(), |[low, high]| format!("{low:.2} to {high:.2}"));
            let _ = write!(out, " | {:.2} | {said}", weight / all);
        }
        out.push_str(" |\n");
    }
    out + "\n"
}

/// The coating of the paper's gripper, and payloads over masses.
pub(crate) fn coating() -> String {
    let text = include_str!("../../../../designs/paper-gripper.toml");
    let spec = read(&Source::new("paper-gripper.toml", text)).expect("it is sound").spec;
    let design = StarDesign::new(&spec, &spec.stars[0]).expect("it can be made");
    let [thin, thick] = design.mask.coating_um();
    let windows = design.mask.window_area() * f64::from(spec.stars[0].points);
    let film = [thin, thick].map(|um| 1e-9 * MEAN * um * windows * SILICONE);
    let fabric = STARS * design.fabric();
    let [bare, coated] = HELD.map(|mass| 1e3 * mass / MASS);
    let all = film.map(|grams| 1e3 * HELD[1] / (MASS + STARS * grams));
    format!(
        "| quantity | value |\n|---|---|\n\
         | extent of a window along the gripping edge from a corner's apex | {:.0} mm |\n\
         | windows of one star, {} corners | {windows:.0} mm^2 |\n\
         | thickness at a window's lower edge; published: about 200 um | {thin:.0} to {thick:.0} um |\n\
         | its mean, two thirds of that | {:.0} to {:.0} um |\n\
         | silicone of one star, of three | {:.1} to {:.1} g, {:.1} to {:.1} g |\n\
         | fabric of three stars, both sheets | {:.4} m^2 |\n\
         | areal density that makes it the published 60 g | {:.3} kg/m^2 |\n\
         | payload over mass, bare: 2.2 kg over 60 g | {bare:.0} |\n\
         | payload over mass, coated: 8.7 kg over 60 g; published: greater than 100 | {coated:.0} |\n\
         | the same, if the 60 g are without the silicone | {:.0} to {:.0} |\n\n",
        design.mask.extent,
        spec.stars[0].points,
        MEAN * thin,
        MEAN * thick,
        film[0],
        film[1],
        STARS * film[0],
        STARS * film[1],
        1e-6 * fabric,
        1e3 * MASS * 1e-3 / fabric * 1e3,
        all[1],
        all[0]
    )
}

/// The paper's stars on single meshes.
pub(crate) fn coarse_stars() -> String {
    let mut out = String::from(
        "| n | triangles | edges, by W | unknowns | rho_f | contraction |\n|---|---|---|---|---|---|\n",
    );
    for (points, grading) in [4, 5].into_iter().flat_map(|n| GRADINGS.map(|grading| (n, grading))) {
        let (radii, unknowns) = coarse(points, grading);
        for ((radius, unknowns), edge) in radii.into_iter().zip(unknowns).zip([12.5, 25.0, 50.0]) {
            let part = 100.0 * (1.0 - radius / HOLE);
            let _ = writeln!(
                out,
                "| {points} | {grading} | 1/{edge} | {unknowns} | {radius:.1} mm | {part:.1} % |"
            );
        }
    }
    out + "\n"
}
