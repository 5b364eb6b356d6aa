//! The paper's stars as `stargrip-cam trade` compares every model with them: a copy of their lines, held to the table by a test.

use crate::stars::computed::{ComputedStar, MeshedNumber};
use crate::stars::draw::Set;
use std::fmt::Write;

/// Opening of a star by the object of the comparison, by W.
const OPENING: f64 = 0.45;

/// The stars of the set `paper` among `stars`, as the text that the program ships.
pub fn table(stars: &[ComputedStar]) -> String {
    let mut table_text = String::from(
        "# The finest shells of the paper's stars, by `research finest` (crates/research); W 30 mm, rho_0 50 mm, phi_i0 30 deg, t 0.3 mm.\n\
         # n, p kPa; radius mm, radial stiffness N/mm, secant of the force at an opening of 0.45 W: each with its mesh error.\n",
    );
    for star in stars.iter().filter(|star| star.star.set == Set::Paper) {
        let Some(shell) = &star.found else { continue };
        let Some((_, secant)) = shell.secants.iter().find(|(part, _)| *part == OPENING) else { continue };
        let _ = write!(table_text, "{} {}", star.star.points, star.star.pressure);
        for (MeshedNumber { value, error }, decimals) in
            [(shell.radius, 3), (shell.stiffness, 4), (*secant, 3)]
        {
            let _ = write!(table_text, " {value:.decimals$} {error:.decimals$}");
        }
        table_text.push('\n');
    }
    table_text
}
