//! The shipped tables of stars: whole, in their order, and those that are drawn.

use research::stars::computed::{ComputedStar, in_turn};
use research::stars::draw::Set;
use research::stars::finest;
use research::stars::shipped::{join, shipped};

const SHIPPED: &str = include_str!("../../src/stars/stars.txt");

#[test]
fn the_shipped_stars_are_whole_and_are_those_that_are_drawn() {
    let stars = shipped();
    assert_eq!(SHIPPED, join(&stars));
    // In their order, and of the sets `wide` and `narrow` as many as were computed.
    let mut drawn = in_turn().into_iter();
    assert!(stars.iter().all(|star| drawn.any(|one| one == star.star)));
    for set in Set::ALL {
        let count = stars.iter().filter(|star| star.star.set == set).count();
        assert!(matches!(set, Set::Wide | Set::Narrow) || count == set.count() as usize, "{set:?}: {count}");
    }
}

#[test]
fn a_line_with_another_star_is_not_read() {
    let mut star = shipped().swap_remove(0);
    star.star.width += 0.1;
    assert_eq!(ComputedStar::of_line(&star.line()), None);
}

#[test]
fn the_programs_copy_is_that_of_the_table() {
    assert_eq!(include_str!("../../../../crates/forecast/src/trade/finest.txt"), finest::table(&shipped()));
}
