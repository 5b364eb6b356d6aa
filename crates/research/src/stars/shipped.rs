//! All computed stars, one a line, as they are shipped.

use crate::sha256;
use crate::stars::computed::ComputedStar;

/// The stars.
const SHIPPED: &str = include_str!("stars.txt");

/// The table of `computed`, as the text that is shipped.
pub fn join(computed: &[ComputedStar]) -> String {
    let body: String = computed.iter().map(|star| star.line() + "\n").collect();
    let hash = sha256(&body);
    format!(
        "# Stars as shells; read by crates/research/src/stars/shipped.rs. E 128 MPa, nu 0.39; lengths mm, p kPa, angles deg.\n\
         # Made by `research stars DIR --set all`, the same with --forces, and --join. SHA-256 of the lines below: {hash}\n\
         # Radius and angle at rest, radial stiffness K (N/mm), force between arms (N), secants at openings by W (force over K times \
         the opening); each with its mesh error.\n{body}"
    )
}

/// The stars that are shipped, those that the shell refuses among them.
pub fn shipped() -> Vec<ComputedStar> {
    SHIPPED.lines().filter(|line| !line.starts_with('#')).filter_map(ComputedStar::of_line).collect()
}
