//! The constraints of a search in closed form, and the order of its results.
//!
//! A box of equal ends holds one design: the search then gives the violation of that one.

use crate::{candidate, close, paper};
use stargrip_cam::forecast::candidate::{Answer, Candidate};
use stargrip_cam::forecast::optimize::{
    Constraints, DesignSearch, Evaluation, Goal, ROUNDING, SearchBounds, SearchResult, thinned,
};
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::mechanics::hinge::ring::RingTable;
use stargrip_cam::units::{Angle, Length};
use std::sync::LazyLock;

static TABLE: LazyLock<RingTable> = LazyLock::new(|| RingTable::new().expect("solved"));

fn just(base: &Candidate) -> SearchBounds {
    SearchBounds::fixed(base)
}

fn violation(base: &Candidate, constraints: Constraints) -> f64 {
    let found = DesignSearch::new(base, &just(base), &constraints, Goal::Fabric, &TABLE).run();
    assert_eq!((found.best.len(), found.best[0].violation == 0.0), (1, !found.front.is_empty()));
    found.best[0].violation
}

fn outcome(base: &Candidate) -> Outcome {
    answer(base).outcome.expect("a limit")
}

fn answer(base: &Candidate) -> Answer {
    base.answer(&TABLE).expect("feasible")
}

#[test]
fn each_constraint_is_a_relative_shortfall() {
    let base = candidate(&paper(5));
    let (own, none) = (answer(&base), Constraints::default());
    let payload = own.payload.expect("asked for");
    close(violation(&base, Constraints { payload: Some(4.0 * payload), ..none }), 0.75, 1e-9);
    assert_eq!(violation(&base, Constraints { payload: Some(payload * (1.0 - 1e-9)), ..none }), 0.0);
    let margin = own.burst.expect("a strength").0 / 37.0;
    close(violation(&base, Constraints { burst_margin: Some(4.0 * margin), ..none }), 0.75, 1e-9);
    assert_eq!(violation(&base, Constraints { burst_margin: Some(margin * (1.0 - 1e-9)), ..none }), 0.0);
    // The cut star reaches a band and an allowance beyond its tube on either side.
    let across = 2.0 * (own.star.tip_reach() + base.seal.band.0 + base.seal.allowance.0);
    close(violation(&base, Constraints { sheet: Some(Length(0.8 * across)), ..none }), 0.25, 1e-9);
    assert_eq!(violation(&base, Constraints { sheet: Some(Length(across)), ..none }), 0.0);
}

#[test]
fn a_grasp_is_closed_to_entered_and_opened_to() {
    let grasp = |base: &Candidate, close: f64, open: f64| {
        violation(base, Constraints { grasp: Some([close, open].map(Length)), ..Constraints::default() })
    };
    let five = candidate(&paper(5));
    let closed = outcome(&five).rest.radius * 1e3;
    assert_eq!(grasp(&five, closed + 1e-6, 48.0), 0.0);
    close(grasp(&five, closed / 1.25, 48.0), 0.25, 1e-9);
    // Five points open wide enough, and the cut hole's 48 mm are a fifth short of 60 mm.
    let widest = outcome(&five).rest.widest.radius * 1e3;
    assert!(widest > 50.0);
    let short = |found: f64, least: f64| ((least - found) / least).max(0.0);
    let expected = 0.2 + short(widest, 60.0 * (1.0 + ROUNDING));
    close(grasp(&five, 49.0, 60.0), expected, 1e-9);
    // Seven points open to 48.3 mm only, though without band and flap 50 mm enter.
    let mut seven = candidate(&paper(7));
    (seven.seal.band, seven.seal.hole_allowance) = (Length(0.0), Length(0.0));
    let widest = outcome(&seven).rest.widest.radius * 1e3;
    close(grasp(&seven, 49.0, 50.0), short(widest, 50.0 * (1.0 + ROUNDING)), 1e-9);
}

#[test]
fn arms_shorter_than_half_a_width_count_and_all_shortfalls_add_up() {
    // Eight points of the paper's width have arms of 6 mm; half a width is 15 mm. They hold objects above 30.8 mm.
    let mut base = candidate(&paper(8));
    base.load.object_radius = Some(Length(32.0));
    let own = answer(&base);
    let arms = (15.0 - own.star.l) / 15.0;
    close(violation(&base, Constraints::default()), arms, 1e-9);
    let rest = own.outcome.expect("a limit").rest;
    let [least, widest] = [rest.radius, rest.widest.radius].map(|m| m * 1e3);
    let across = 2.0 * (own.star.tip_reach() + base.seal.band.0 + base.seal.allowance.0);
    let margin = own.burst.expect("a strength").0 / 37.0;
    let constraints = Constraints {
        grasp: Some([least / 1.5, 100.0].map(Length)),
        payload: own.payload.map(|payload| 2.0 * payload),
        sheet: Some(Length(across / 1.75)),
        burst_margin: Some(margin / 0.4),
        ..Constraints::default()
    };
    let opened = 1.0 - widest / (100.0 * (1.0 + ROUNDING));
    close(violation(&base, constraints), arms + 0.5 + 0.52 + opened + 0.5 + 0.75 + 0.6, 1e-9);
}

#[test]
fn what_is_not_known_is_as_bad_as_nothing() {
    let mut base = candidate(&paper(5));
    base.load.friction = None;
    close(violation(&base, Constraints { payload: Some(1.0), ..Constraints::default() }), 1.0, 1e-12);
    base.fabric.seal_strength = None;
    close(violation(&base, Constraints { burst_margin: Some(2.0), ..Constraints::default() }), 1.0, 1e-12);
}

/// Angle and width in a box, three to six points.
fn found(goal: Goal) -> SearchResult {
    let base = candidate(&paper(5));
    let bounds = SearchBounds {
        points: 3..=6,
        tip_angle: [20.0, 60.0].map(Angle),
        width: [12.0, 35.0].map(Length),
        ..just(&base)
    };
    DesignSearch::new(&base, &bounds, &Constraints::default(), goal, &TABLE).run()
}

/// The quantity that a goal minimises.
fn cost(goal: Goal, of: &Evaluation) -> f64 {
    match goal {
        Goal::Contraction => -of.answer.outcome.expect("a limit").contraction,
        Goal::Stiffness => -of.answer.outcome.expect("a limit").stiffness.expect("a pressure"),
        Goal::Fabric => of.fabric(),
        Goal::Payload => -of.answer.payload.expect("all is given"),
    }
}

const GOALS: [Goal; 3] = [Goal::Contraction, Goal::Stiffness, Goal::Fabric];

#[test]
fn each_goal_is_served_best_by_its_own_search() {
    let all = GOALS.map(found);
    for (goal, own) in GOALS.into_iter().zip(&all) {
        let costs: Vec<f64> = own.best.iter().map(|best| cost(goal, best)).collect();
        assert!(costs.len() == 4 && costs.windows(2).all(|pair| pair[0] <= pair[1]), "{goal:?}: {costs:?}");
        for other in &all {
            assert!(costs[0] <= cost(goal, &other.best[0]), "{goal:?}");
            // The end of the front in this goal is the optimum, and no computed design is better.
            let least = other.front.iter().map(|on| cost(goal, on)).fold(f64::INFINITY, f64::min);
            assert!(costs[0] <= least, "{goal:?}: {} {least}", costs[0]);
        }
        let least = own.front.iter().map(|on| cost(goal, on)).fold(f64::INFINITY, f64::min);
        assert_eq!(least, costs[0], "{goal:?}");
        let contractions: Vec<f64> =
            own.front.iter().map(|on| on.answer.outcome.expect("a limit").contraction).collect();
        assert!(contractions.windows(2).all(|pair| pair[0] >= pair[1]));
    }
}

/// The least fabric has an optimum on a known edge of the box: the narrowest tube, and the widest angle. With fewer points it
/// would not close to the object.
#[test]
fn an_optimum_at_the_corner_of_the_box_is_reached() {
    let best = &found(Goal::Fabric).best[0].point.star;
    assert_eq!((best.tube_width, best.points), (Length(12.0), 6));
}

#[test]
fn a_front_is_thinned_evenly_with_both_ends() {
    let front = found(Goal::Contraction).front;
    let count = front.len();
    assert!(count > 9);
    for most in [2, 3, 7] {
        let shown = thinned(&front, most);
        let places: Vec<usize> =
            shown.iter().filter_map(|one| front.iter().position(|other| other == one)).collect();
        let expected: Vec<usize> = (0..most).map(|i| i * (count - 1) / (most - 1)).collect();
        assert_eq!(places, expected);
    }
    assert_eq!(thinned(&front, count), front);
    assert_eq!(thinned(&front, 1), front[..1]);
    assert_eq!(thinned(&front, 0), front[..1]);
    assert_eq!(thinned(&front[..2], 3), front[..2]);
}
