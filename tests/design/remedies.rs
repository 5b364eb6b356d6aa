//! What a refusal advises works: the design with that value, or drawn as it says, is not refused for the same reason.

use stargrip_cam::design::{Design, Refusal, Refusals};

use crate::support;

/// The one refusal.
fn only(refusals: &Refusals) -> Refusal {
    let [refusal] = refusals.iter().as_slice() else { panic!("{refusals}") };
    refusal.clone()
}

fn star(text: &str) -> Result<Design, Refusals> {
    Design::new(&support::read(text), &support::machine())
}

#[test]
fn the_kerf_that_is_named_leaves_a_hole() {
    for hole in ["1.3 mm", "1.5 mm", "1.8 mm", "2 mm", "3 mm"] {
        let with = |kerf: &str| {
            star(&format!(
                "{}[sheet]\nhole_diameter = \"{hole}\"\n[cut]\nkerf = \"{kerf}\"\n",
                support::PAPER
            ))
        };
        let refusal = only(&with(hole).expect_err("no hole"));
        let most = refusal.remedy.strip_prefix("kerf must be at most ").expect("a kerf");
        assert!(with(most).is_ok(), "{hole}: {refusal}");
    }
}
