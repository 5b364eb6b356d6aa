//! Ranges of predictions, held against stars as shells from which no constant was taken.

use research::stars::draw::Set;
use research::stars::shipped::shipped;
use research::validation::{Comparison, Opened, Pair, compare, opened};

/// Where fewer stars were computed: thin fabric, many points, short and long arms, and the paper's star of eight points. The widths of ranges were
/// taken from stars 1 to 13 and 17 and from the paper's, and hold all of their numbers strictly; of the others' they hold 95 of 100.
#[test]
fn wider_ranges_hold_stars_that_are_unlike_the_others() {
    let all: Vec<Comparison> = shipped().iter().filter_map(compare).collect();
    let eight = |one: &&Comparison| one.set == Set::Paper && one.points == 8;
    assert_eq!(all.iter().filter(eight).count(), 4);
    let wide: Vec<&Comparison> = all.iter().filter(|one| one.set == Set::Wide || eight(one)).collect();
    assert_eq!(wide.len(), 44);
    let taken = |one: &&Comparison| eight(one) || one.number <= 13 || one.number == 17;
    let (taken, others): (Vec<&Comparison>, Vec<&Comparison>) = wide.into_iter().partition(taken);
    let numbers = |stars: &[&Comparison]| -> Vec<(String, Pair)> {
        let of = |one: &&Comparison| {
            let pairs = [("radius", Some(one.radius)), ("angle", one.angle), ("stiffness", one.stiffness)];
            let number = one.number;
            pairs
                .map(|(what, pair)| pair.map(|pair| (format!("{what} of {number}"), pair)))
                .into_iter()
                .flatten()
        };
        stars.iter().flat_map(of).collect()
    };
    let outside = |numbers: &[(String, Pair)]| -> Vec<String> {
        numbers.iter().filter(|(_, pair)| !pair.holds_strictly()).map(|(what, _)| what.clone()).collect()
    };
    assert_eq!(outside(&numbers(&taken)), Vec::<String>::new());
    let others = numbers(&others);
    let outside = outside(&others);
    assert!(
        others.len() > 60 && 20 * outside.len() <= others.len(),
        "{} of {}: {outside:?}",
        outside.len(),
        others.len()
    );
}

/// Stars 241 to 300 of the test set: no constant was taken from them. Strictly, without their mesh errors, 95 of 100 radii and stiffnesses lie
/// in their ranges, and nine of ten of each number of points.
#[test]
fn ranges_hold_on_stars_that_they_were_not_taken_from() {
    let unused = |one: &Comparison| one.set == Set::Test && (241..=300).contains(&one.number);
    let all: Vec<Comparison> = shipped().iter().filter_map(compare).filter(unused).collect();
    assert_eq!(all.len(), 60);
    let quantities: [(&str, Vec<Pair>); 3] = [
        ("radius", all.iter().map(|one| one.radius).collect()),
        ("angle", all.iter().filter_map(|one| one.angle).collect()),
        ("stiffness", all.iter().filter_map(|one| one.stiffness).collect()),
    ];
    for (what, pairs) in quantities {
        assert!(pairs.len() >= 50, "{what}: {}", pairs.len());
        let inside = pairs.iter().filter(|pair| pair.holds_strictly()).count();
        assert!(20 * inside >= 19 * pairs.len(), "{what}: {inside} of {}", pairs.len());
    }
    for points in 3..=8 {
        let of_n: Vec<&Comparison> = all.iter().filter(|one| one.points == points).collect();
        let radii: Vec<Pair> = of_n.iter().map(|one| one.radius).collect();
        let stiffnesses: Vec<Pair> = of_n.iter().filter_map(|one| one.stiffness).collect();
        for (what, pairs) in [("radius", radii), ("stiffness", stiffnesses)] {
            let inside = pairs.iter().filter(|pair| pair.holds_strictly()).count();
            assert!(10 * inside >= 9 * pairs.len(), "{what}, {points} points: {inside} of {}", pairs.len());
        }
    }
}

/// Forces on coarse shells whose arms touch while they are empty, and on objects that open a star by more than 0.95 W. No constant was taken
/// from them: the law of forces was fitted to stars whose arms are apart, opened by up to 0.9 W.
#[test]
fn ranges_hold_forces_of_touching_arms_and_of_wide_objects() {
    let (touching, wide): (Vec<Opened>, Vec<Opened>) = opened().into_iter().partition(|one| one.touches);
    let wide = wide.into_iter().filter(|one| one.opening > 0.95).collect();
    for (what, group) in [("touching", touching), ("wide", wide)] {
        let outside: Vec<&Opened> = group.iter().filter(|one| !one.force.holds()).collect();
        assert!(group.len() >= 20, "{what}: {}", group.len());
        assert!(outside.len() * 20 <= group.len(), "{what}: of {} outside {outside:?}", group.len());
    }
}
