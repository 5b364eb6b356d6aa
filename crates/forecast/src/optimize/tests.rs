//! Searches against grids, their order, and their front.

use super::*;
use spec::{ModelChoice, Source, read, starter};

fn base() -> Candidate {
    let load = "\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nobject_height = \"400 mm\"\nobject_shape = \"cylinder\"\nfriction = 0.5\n";
    let text = starter("x").expect("a name") + load;
    let base = Candidate::from_spec(&read(&Source::new("x", text)).expect("valid").spec).expect("a star");
    Candidate { model: ModelChoice::Ring, ..base }
}

fn bounds() -> SearchBounds {
    SearchBounds { points: 3..=9, ..SearchBounds::fixed(&base()) }
}

fn table() -> RingTable {
    RingTable::new().expect("solved")
}

#[test]
fn the_papers_star_contracts_most_with_four_or_five_points() {
    let result =
        DesignSearch::new(&base(), &bounds(), &Constraints::default(), Goal::Contraction, &table()).run();
    assert!([4, 5].contains(&result.best[0].point.star.points), "{:?}", result.best[0].point.star);
    // n = 8 has arms of 6 mm, too short, and comes after all others; n = 9 has none.
    assert!(result.best.len() == 6 && result.best[5].violation > 0.0);
}

#[test]
fn the_optimum_is_the_best_of_a_dense_grid() {
    let bounds = SearchBounds {
        tip_angle: [20.0, 57.0].map(Angle),
        width: [15.0, 40.0].map(Length),
        points: 4..=5,
        ..bounds()
    };
    let constraints =
        Constraints { payload: Some(0.5), grasp: Some([20.0, 47.0].map(Length)), ..Constraints::default() };
    let ring_table = table();
    let result = DesignSearch::new(&base(), &bounds, &constraints, Goal::Fabric, &ring_table).run();
    let best = result.best[0].clone();
    assert_eq!(best.violation, 0.0);
    for n in 4..=5 {
        for i in 0..=60 {
            for j in 0..=60 {
                let mut point = base();
                point.star.points = n;
                point.star.tip_angle = Angle(20.0 + 37.0 * f64::from(i) / 60.0);
                point.star.tube_width = Length(15.0 + 25.0 * f64::from(j) / 60.0);
                if let Ok(answer) = point.answer(&ring_table)
                    && shortfalls(&point, &answer, &constraints).is_empty()
                    && let Some(area) = answer.fabric
                {
                    assert!(area > best.fabric() * 0.999, "{point:?} is smaller");
                }
            }
        }
    }
}

/// At its pressure, with constraints at the bad end of the ranges, and the number of stars chosen.
#[test]
fn at_a_pressure_the_winner_is_the_best_of_a_grid_too() {
    // A grid over angle and width is searched for each number of stars. No feasible point of it takes clearly less
    // fabric than the search's winner with as many points.
    let mut base = Candidate { model: ModelChoice::Auto, ..base() };
    (base.star.tip_radius, base.star.corner_radius) = (Length(2.0), Length(2.0));
    let bounds = SearchBounds {
        tip_angle: [20.0, 60.0].map(Angle),
        width: [12.0, 29.0].map(Length),
        points: 4..=6,
        stars: 1..=4,
        ..SearchBounds::fixed(&base)
    };
    let constraints =
        Constraints { payload: Some(0.6), grasp: Some([25.0, 38.0].map(Length)), ..Constraints::default() };
    let ring_table = table();
    let result = DesignSearch::new(&base, &bounds, &constraints, Goal::Fabric, &ring_table).run();
    assert!(result.best[0].violation == 0.0, "{:?}", result.best[0]);
    for best in result.best.iter().filter(|best| best.violation == 0.0) {
        for i in 0..=40 {
            for j in 0..=40 {
                let mut point = base.clone();
                point.star.points = best.point.star.points;
                point.star.tip_angle = Angle(20.0 + f64::from(i));
                point.star.tube_width = Length(12.0 + 17.0 * f64::from(j) / 40.0);
                let Ok(answer) = point.answer(&ring_table) else { continue };
                for stars in 1..=4 {
                    let (point, answer) = (Candidate { stars, ..point.clone() }, answer.of_stars(stars));
                    let area = answer.fabric.map_or(f64::INFINITY, |area| f64::from(stars) * area);
                    let is_feasible = shortfalls(&point, &answer, &constraints).is_empty();
                    assert!(
                        !is_feasible || area > 0.995 * best.fabric(),
                        "{point:?} is smaller than {best:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn nothing_on_the_front_is_beaten() {
    let bounds = SearchBounds {
        tip_angle: [12.0, 69.0].map(Angle),
        width: [10.0, 40.0].map(Length),
        points: 3..=6,
        ..bounds()
    };
    let result =
        DesignSearch::new(&base(), &bounds, &Constraints::default(), Goal::Contraction, &table()).run();
    assert!(result.front.len() > 10 && result.computed > 1000);
    for (i, a) in result.front.iter().enumerate().step_by(7) {
        for (j, b) in result.front.iter().enumerate() {
            let [x, y] = [a, b].map(|of| of.answer.outcome.expect("a limit"));
            let beats =
                y.contraction >= x.contraction && y.stiffness >= x.stiffness && b.fabric() <= a.fabric();
            assert!(i == j || !beats, "{i} {j}");
        }
    }
    let sample = thinned(&result.front, 5);
    assert!(
        sample.len() == 5
            && sample[0] == result.front[0]
            && sample[4] == result.front[result.front.len() - 1]
    );
}

#[test]
fn a_search_is_the_same_in_any_number_of_threads() {
    let bounds = SearchBounds { tip_angle: [12.0, 69.0].map(Angle), ..bounds() };
    let run =
        || DesignSearch::new(&base(), &bounds, &Constraints::default(), Goal::Stiffness, &table()).run();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    assert_eq!(run(), pool.install(run));
}

/// The paper's star by `section`, with a tip angle and a tube width.
fn at_pressure(angle: f64, width: f64) -> (Candidate, Answer) {
    let mut point = Candidate { model: ModelChoice::Auto, ..base() };
    (point.star.tip_angle, point.star.tube_width) = (Angle(angle), Length(width));
    let answer = point.answer(&table()).expect("there is such a star");
    (point, answer)
}

#[test]
fn a_star_outside_of_what_was_tried_is_short_the_more_the_further_out() {
    let untried = |angle, width| {
        let (point, answer) = at_pressure(angle, width);
        let missed = shortfalls(&point, &answer, &Constraints::default());
        let untried = missed.into_iter().find(|shortfall| shortfall.constraint == Constraint::Untried);
        untried.map_or(0.0, |shortfall| shortfall.part)
    };
    // Arms of 3.5, 5.5, 6.5 and 8.5 W; five may be.
    let shortfall_by_angle = [30.0, 20.0, 18.0, 15.0].map(|angle| untried(angle, 20.0));
    assert!(
        shortfall_by_angle[0] == 0.0
            && shortfall_by_angle[1] > 0.0
            && shortfall_by_angle.windows(2).all(|pair| pair[0] < pair[1]),
        "{shortfall_by_angle:?}"
    );
}

#[test]
fn a_force_of_which_nothing_is_known_counts_for_nothing() {
    // The arms touch, and the object opens the star by 1.7 W.
    let (mut point, _) = at_pressure(17.0, 20.0);
    point.load.object_radius = Some(Length(46.0));
    let answer = point.answer(&table()).expect("there is such a star");
    let outcome = answer.outcome.expect("a radius");
    assert!(outcome.known && outcome.stiffness.is_none() && outcome.object_force().is_none(), "{outcome:?}");
    assert_eq!((sure_payload(&point, &answer), answer.payload), (None, None));
    let constraints = Constraints { payload: Some(0.1), largest_force: Some(1e3), ..Constraints::default() };
    let missed = shortfalls(&point, &answer, &constraints);
    for constraint in [Constraint::Payload, Constraint::Pressing, Constraint::Touching] {
        let is_short = missed.iter().any(|shortfall| shortfall.constraint == constraint);
        assert!(is_short, "{constraint:?}: {missed:?}");
    }
}

#[test]
fn searches_count_on_less_than_the_end_of_a_force_s_range() {
    let (point, answer) = at_pressure(30.0, 25.0);
    let [low, _] = answer.payload_range.expect("it holds the object");
    let safe = sure_payload(&point, &answer).expect("known");
    assert!(low > 0.0 && safe.total_cmp(&(SEARCHED * low)).is_eq(), "{safe} {low}");
    let misses_payload = |payload: f64| {
        let constraints = Constraints { payload: Some(payload), ..Constraints::default() };
        let missed = shortfalls(&point, &answer, &constraints);
        missed.iter().any(|shortfall| shortfall.constraint == Constraint::Payload)
    };
    assert!(!misses_payload(0.99 * safe) && misses_payload(0.5 * (safe + low)));
}
