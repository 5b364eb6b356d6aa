//! Ranges of stars that shells were computed of, and what becomes of ranges away from them.

use crate::{case, close, gripper};
use stargrip_cam::forecast::case::Case;
use stargrip_cam::forecast::choice::{corrected, tabled};
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::forecast::ranges::against::{Against, Pair, against};
use stargrip_cam::forecast::ranges::{Standing, errors, sum};
use stargrip_cam::forecast::stars::draw::Set;
use stargrip_cam::forecast::stars::shipped::shipped;
use stargrip_cam::mechanics::star::response::Inflated;

/// What the section says of `case` at `kilopascals`.
fn at(case: Case, kilopascals: f64) -> Outcome {
    let pressure = 1e3 * kilopascals;
    let model = tabled(&case, pressure).expect("covered");
    let case = corrected(&Case { pressure: Some(pressure), ..case }, &model).expect("covered");
    let inflated = Inflated::new(&case.mechanism, &model, pressure).expect("solvable");
    Outcome::linear(&case, &inflated)
}

fn of(points: u32, kilopascals: f64) -> Outcome {
    at(case(&gripper(points)), kilopascals)
}

/// Radii, mm, of the paper's stars as shells of up to 155,000 unknowns, at 14, 20 and 37 kPa: none of them was fitted to, nor are
/// ranges made of them.
const RADII: [(f64, [f64; 5]); 3] = [
    (14.0, [25.38, 17.51, 18.32, 22.48, 29.12]),
    (20.0, [24.25, 16.60, 17.35, 21.78, 28.40]),
    (37.0, [23.03, 15.57, 17.23, 21.69, 28.36]),
];

#[test]
fn the_papers_stars_lie_in_their_ranges() {
    let mut outside = Vec::new();
    for (kilopascals, radii) in RADII {
        for (points, radius) in (3..).zip(radii) {
            let [low, high] =
                of(points, kilopascals).ranges.radius.expect("tried").map(|metres| metres * 1e3);
            if !(low..=high).contains(&radius) {
                outside.push(format!("n = {points} at {kilopascals} kPa: {radius} in [{low:.2}, {high:.2}]"));
            }
        }
    }
    assert!(outside.len() <= 1, "more than one of fifteen: {outside:?}");
}

/// Nine in ten at least: 95 of 100 are promised, and of some 50 stars, or of the forces on 14, that leaves room for two more outside.
#[test]
fn ranges_hold_on_stars_that_they_were_not_taken_from() {
    let all: Vec<Against> = shipped().iter().filter_map(against).filter(|one| one.set == Set::Test).collect();
    assert!(all.len() >= 20, "{}", all.len());
    let quantities: [(&str, Vec<Pair>); 4] = [
        ("radius", all.iter().map(|one| one.radius).collect()),
        ("angle", all.iter().filter_map(|one| one.angle).collect()),
        ("stiffness", all.iter().filter_map(|one| one.stiffness).collect()),
        ("force", all.iter().flat_map(|one| &one.forces).map(|(_, pair)| *pair).collect()),
    ];
    for (what, pairs) in quantities {
        let inside = pairs.iter().filter(|pair| pair.holds()).count();
        assert!(10 * inside >= 9 * pairs.len(), "{what}: {inside} of {}", pairs.len());
    }
}

#[test]
fn beyond_what_was_tried_ranges_are_wider_and_further_away_there_are_none() {
    let star = case(&gripper(5));
    let tried = at(star, 30.0);
    assert_eq!(tried.ranges.standing, Standing::Tried);
    let width = |own: &Outcome, case: &Case| {
        let [low, high] = own.ranges.radius.expect("known");
        (high - low) / case.mechanism.width * (std::f64::consts::PI / f64::from(case.mechanism.points)).sin()
    };
    close(width(&tried, &star), errors::RADIUS[1] - errors::RADIUS[0], 1e-9);
    let mut long = star;
    long.mechanism.arm = 6.0 * long.mechanism.width;
    let beyond = at(long, 30.0);
    assert_eq!(beyond.ranges.standing, Standing::Beyond);
    close(width(&beyond, &long), errors::BEYOND * (errors::RADIUS[1] - errors::RADIUS[0]), 1e-9);
    long.mechanism.arm = 9.0 * long.mechanism.width;
    let unknown = at(long, 30.0).ranges;
    assert_eq!((unknown.standing, unknown.radius, unknown.stiffness), (Standing::Unknown, None, None));
    // Where the table of arms ends nothing is known either: 0.2 mm of fabric in a tube of 30 mm.
    let mut thin = star;
    thin.sheet.thickness = 0.2e-3;
    assert_eq!(at(thin, 10.0).ranges.standing, Standing::Unknown);
}

#[test]
fn a_sum_is_known_where_all_of_it_is() {
    assert_eq!(sum([Some([1.0, 2.0]), Some([0.5, 4.0])]), Some([1.5, 6.0]));
    assert_eq!(sum([Some([1.0, 2.0]), None]), None);
}
