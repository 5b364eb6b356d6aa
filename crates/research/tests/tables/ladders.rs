//! The table of arms against shells computed anew.

use inflatable::mechanics::hinge::section::arms;
use inflatable::shell::cases::{Fineness, Watch};
use research::ladders::{JoinFault, Ladder, LadderTable, join, ladders};

/// A coarse ladder of the table's own, which takes seconds.
fn coarse(number: usize) -> LadderTable {
    let ladder = ladders()[number - 1];
    let text = ladder.compute(Fineness { cells: 4.0, cuts: 2 }, &Watch::default()).expect("an equilibrium");
    for torn in [text.len() / 2, text.len() - 2] {
        assert_eq!(LadderTable::read(&text[..torn]), None);
    }
    assert_eq!(LadderTable::read(&text.replacen("alpha", "beta", 1)), None);
    LadderTable::read(&text).expect("whole")
}

/// Two of the table's ladders, R* = 0.15 at two tau, phi_0 of 60 and of 120 deg: C within a twentieth, of the thicker within a hundredth, or
/// within the mesh error of coarse meshes.
#[test]
fn the_shipped_table_is_what_shells_say() {
    for (number, open) in [(10, 10.0), (34, 2.0)] {
        let climbed = coarse(number);
        let Ladder { tau, r_star, .. } = climbed.ladder;
        let found = climbed.arms().expect("sections");
        assert_eq!(found.len(), arms::PRESSURES);
        for [b, angle, angle_error, give, give_error] in found {
            let shipped = arms::arms(b, tau, r_star).expect("on the grid").arms(climbed.ladder.arc());
            let (delta, g) = (shipped.angle.to_degrees(), shipped.give.to_degrees());
            assert!((angle - delta).abs() < angle_error.max(0.5), "{b}: {angle} +- {angle_error}, {delta}");
            assert!((give - g).abs() < give_error.max(open), "{b}: {give} +- {give_error}, {g}");
        }
        assert_eq!(join(&[climbed], false), Err(JoinFault::Missing(1)));
    }
}

#[test]
fn every_ladder_is_one_of_the_grid_or_tries_another_poisson_ratio() {
    let all = ladders();
    assert_eq!(
        all.iter().filter(|ladder| ladder.is_in_table()).count(),
        arms::ARCS.len() * arms::TAUS.len() * arms::R_STARS.len()
    );
    assert!(all.iter().zip(1..).all(|(ladder, number)| ladder.number == number));
}
