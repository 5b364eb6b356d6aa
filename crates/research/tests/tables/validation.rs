//! Ranges of predictions, held against stars as shells from which no constant was taken; and the table of residuals.

use research::residuals::{fitted, is_used};
use research::stars::draw::Set;
use research::stars::shipped::shipped;
use research::validation::{Comparison, FLAP, Opened, Pair, Pressed, compare, compare_all, opened};
use stargrip_cam::spec::{self, Source};
use std::ops::RangeInclusive;

/// The stars of a set that no constant was taken from.
fn unused(set: Set, numbers: RangeInclusive<u32>) -> Vec<Comparison> {
    let of_set = |one: &Comparison| one.set == set && numbers.contains(&one.number);
    shipped().iter().filter_map(compare).filter(of_set).collect()
}

/// Asserts that `of` in `all` of the numbers lie strictly in their ranges.
fn hold(what: &str, pairs: &[Pair], [of, all]: [usize; 2]) {
    let inside = pairs.iter().filter(|pair| pair.holds_strictly()).count();
    assert!(all * inside >= of * pairs.len(), "{what}: {inside} of {}", pairs.len());
}

#[test]
fn the_shipped_residuals_are_those_of_the_stars() {
    let table = fitted(&shipped()).expect("no star is there twice").table();
    let known = include_str!("../../../inflatable/src/mechanics/star/residuals.txt");
    // Weights differ by rounding from processor to processor.
    let numbers = |text: &str| -> Vec<Vec<f64>> {
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        lines.map(|line| line.split(' ').map(|word| word.parse().expect("a number")).collect()).collect()
    };
    let (table, known) = (numbers(&table), numbers(known));
    assert_eq!(table.len(), known.len());
    for (one, other) in table.iter().zip(&known) {
        assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 2e-6), "{one:?} {other:?}");
    }
}

/// Where fewer stars were computed: thin fabric, many points, short and long arms. Ranges were taken from stars 1 to 40 of the set.
#[test]
fn wider_ranges_hold_stars_that_are_unlike_the_others() {
    let all = unused(Set::Wide, 41..=60);
    let numbers = |one: &Comparison| [Some(one.radius), one.angle, one.stiffness];
    let pairs: Vec<Pair> = all.iter().flat_map(numbers).flatten().collect();
    assert!(all.len() == 20 && pairs.len() > 55);
    hold("wide", &pairs, [95, 100]);
}

/// Strictly, without their mesh errors, 95 of 100 radii, angles and stiffnesses lie in their ranges, and nine of ten of each number of points.
#[test]
fn ranges_hold_on_stars_that_they_were_not_taken_from() {
    let all = unused(Set::Test, 361..=456);
    assert_eq!(all.len(), 96);
    for points in std::iter::once(None).chain((3..=8).map(Some)) {
        let of_n = || all.iter().filter(|one| points.is_none_or(|points| one.points == points));
        let quantities: [(&str, Vec<Pair>); 3] = [
            ("radius", of_n().map(|one| one.radius).collect()),
            ("angle", of_n().filter_map(|one| one.angle).collect()),
            ("stiffness", of_n().filter_map(|one| one.stiffness).collect()),
        ];
        for (what, pairs) in quantities {
            assert!(pairs.len() >= if points.is_some() { 12 } else { 80 }, "{what}: {}", pairs.len());
            hold(what, &pairs, if points.is_some() { [9, 10] } else { [95, 100] });
        }
    }
}

/// Of the forces on the same object eight of ten are within 15 %, and the error is 13 % rms: of stars of the table, each predicted from all
/// others. Of stars that no constant was taken from it is 10 %. Ranges hold 95 of 100 strictly, and nine of ten of each number of points.
#[test]
fn forces_are_as_accurate_as_stated() {
    let all = compare_all().expect("no star is there twice");
    let of = |is_meant: &dyn Fn(&Comparison) -> bool| -> Vec<Pressed> {
        all.iter().filter(|one| is_meant(one)).flat_map(|one| one.forces.iter().copied()).collect()
    };
    let is_new = |one: &Comparison| one.set == Set::Test && !is_used(one.set, one.number);
    let new = of(&is_new);
    let passing = new.iter().filter(|one| one.passes).copied().collect();
    let newest = of(&|one| one.set == Set::Test && one.number > 420);
    let left_out = of(&|one| is_used(one.set, one.number));
    for (what, forces, count, most, held) in [
        ("new", new, 140, 0.1, [95, 100]),
        ("newest", newest, 60, 0.1, [95, 100]),
        ("through the hole as it is cut", passing, 120, 0.1, [97, 100]),
        ("left out", left_out, 430, 0.13, [95, 100]),
    ] {
        let pairs: Vec<Pair> = forces.iter().map(|one| one.force).collect();
        let off: Vec<f64> = pairs.iter().map(|pair| pair.predicted / pair.shell - 1.0).collect();
        let near = off.iter().filter(|off| off.abs() <= 0.15).count();
        assert!(off.len() >= count && 10 * near >= 8 * off.len(), "{what}: {near} of {}", off.len());
        #[expect(clippy::cast_precision_loss, reason = "a few hundred forces")]
        let rms = (off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64).sqrt();
        assert!(rms <= most, "{what}: {rms}");
        hold(what, &pairs, held);
    }
    for points in 3..=8 {
        let pairs: Vec<Pair> =
            of(&|one| is_new(one) && one.points == points).iter().map(|one| one.force).collect();
        assert!(pairs.len() >= 10, "{points} points: {}", pairs.len());
        hold("forces by points", &pairs, [9, 10]);
    }
}

#[test]
fn the_flap_of_the_comparison_is_the_default_one() {
    let star = "schema = 1\nname = \"star\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n";
    let seal = spec::read(&Source::new("spec.toml", star)).expect("a spec").spec.seal;
    assert_eq!(seal.band.0 + seal.hole_allowance.0, FLAP);
}

/// Forces on coarse shells whose arms touch while they are empty, and on objects that open a star by more than 0.95 W. No constant was taken
/// from them: the forces of the table are of stars whose arms are apart, opened by up to 0.9 W.
#[test]
fn ranges_hold_forces_of_touching_arms_and_of_wide_objects() {
    let (touching, wide): (Vec<Opened>, Vec<Opened>) = opened().into_iter().partition(|one| one.touches);
    let wide = wide.into_iter().filter(|one| one.opening > 0.95).collect();
    for (what, group) in [("touching", touching), ("wide", wide)] {
        let outside: Vec<&Opened> = group.iter().filter(|one| !one.force.is_in_range()).collect();
        assert!(group.len() >= 20, "{what}: {}", group.len());
        assert!(outside.len() * 20 <= group.len(), "{what}: of {} outside {outside:?}", group.len());
    }
}
