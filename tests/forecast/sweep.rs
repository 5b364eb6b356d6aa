//! A sweep's rows: which design each is, and that it says what that design alone says.

use crate::{candidate, close, paper};
use stargrip_cam::forecast::candidate::TableRing;
use stargrip_cam::forecast::sweep::{Axis, Key, Sweep};
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::ring::{Ring, RingTable};
use std::ops::Range;

fn sweep(axes: &[&str]) -> Sweep {
    let axes = axes.iter().map(|text| Axis::parse(text).expect("valid")).collect();
    Sweep::new(candidate(&paper(5)), axes).expect("small")
}

fn lines(sweep: &Sweep, rows: Range<usize>) -> Vec<String> {
    let mut out = String::new();
    sweep.run(rows, |text, _| {
        out.push_str(text);
        true
    });
    out.lines().map(str::to_owned).collect()
}

#[test]
fn the_last_axis_runs_fastest() {
    let sweep = sweep(&["star.points=4,5", "star.tube_width=20 mm..30 mm/3", "star.tip_angle=30 deg,40 deg"]);
    let mut row = 0;
    for points in [4, 5] {
        for width in [20.0, 25.0, 30.0] {
            for angle in [30.0, 40.0] {
                let star = sweep.point(row).star;
                assert_eq!((star.points, star.tube_width.0, star.tip_angle.0), (points, width, angle));
                let found = &lines(&sweep, row..row + 1)[0];
                assert!(found.starts_with(&format!("{row},{points},{width},{angle},")), "{found}");
                row += 1;
            }
        }
    }
    assert_eq!(sweep.rows(), row);
    assert_eq!(
        sweep.header(),
        "row,star.points,star.tube_width_mm,star.tip_angle_deg,arm_length_mm,tip_equilibrium_angle_deg,\
         final_radius_mm,contraction,operating_pressure_kPa,radial_stiffness_N_per_m,object_force_N,payload_kg,\
         burst_pressure_kPa,fabric_cm2,bendability,stretch,burst_margin,widest_radius_mm,final_radius_lo_mm,\
         final_radius_hi_mm,object_force_lo_N,object_force_hi_N,payload_lo_kg,payload_hi_kg,refused\n"
    );
}

#[test]
fn a_row_says_what_its_design_says() {
    let sweep = sweep(&["star.points=4,5,6", "load.pressure=20 kPa,37 kPa"]);
    let table = RingTable::new().expect("solved");
    for (row, line) in lines(&sweep, 0..sweep.rows()).iter().enumerate() {
        let answer = sweep.point(row).answer(&table).expect("feasible");
        let outcome = answer.outcome.as_ref().expect("a limit");
        let expected = [
            Some(answer.star.l),
            Some(outcome.rest.equilibrium.to_degrees()),
            Some(outcome.rest.radius * 1e3),
            Some(1.0 - outcome.rest.radius / 0.05),
            Some(answer.operating_pressure.0),
            outcome.stiffness,
            outcome.object_force(),
            answer.payload,
            answer.burst.map(|burst| burst.0),
            answer.fabric.map(|area| area * 0.01),
        ];
        let cells: Vec<&str> = line.split(',').collect();
        // A limit has no ranges.
        assert!(cells.len() == 24 && cells[17..].iter().all(|cell| cell.is_empty()), "{line}");
        for (cell, expected) in cells[3..13].iter().zip(expected) {
            // Nine digits are written.
            close(cell.parse().expect("a number"), expected.expect("asked for"), 5e-9);
        }
        // Three equal stars hold three times what one holds.
        close(answer.payload.expect("asked for"), 3.0 * outcome.payload.expect("asked for"), 1e-12);
    }
}

#[test]
fn every_key_sets_its_own_value() {
    let texts = [
        ("star.points", "7", 7.0),
        ("star.inner_radius", "61 mm", 61.0),
        ("star.tube_width", "2.2 cm", 22.0),
        ("star.tip_angle", "33 deg", 33.0),
        ("star.tip_radius", "1.5 mm", 1.5),
        ("star.corner_radius", "2.5 mm", 2.5),
        ("fabric.thickness", "0.2 mm", 0.2),
        ("fabric.young_modulus", "90 MPa", 90e3),
        ("fabric.seal_strength", "2 N/mm", 2.0),
        ("load.pressure", "21 kPa", 21.0),
        ("load.object_radius", "31 mm", 31.0),
        ("load.friction", "0.7", 0.7),
    ];
    let base = candidate(&paper(5));
    for (i, (name, text, value)) in texts.into_iter().enumerate() {
        let axis = Axis::parse(&format!("{name} = {text}")).expect("valid");
        close(axis.values[0], value, 1e-12);
        let mut point = base.clone();
        axis.key.set(&mut point, axis.values[0]);
        let (star, fabric, load) = (&point.star, &point.fabric, &point.load);
        let own = [
            f64::from(star.points),
            star.inner_radius.0,
            star.tube_width.0,
            star.tip_angle.0,
            star.tip_radius.0,
            star.corner_radius.0,
            fabric.thickness.0,
            fabric.young_modulus.0,
            fabric.seal_strength.expect("given").0,
            load.pressure.expect("given").0,
            load.object_radius.expect("given").0,
            load.friction.expect("given"),
        ];
        close(own[i], value, 1e-12);
        assert!(point != base, "{name}");
    }
}

#[test]
fn faults_of_an_axis_say_what_is_allowed() {
    let faults = [
        ("star.points", "`star.points` is not KEY=VALUES"),
        ("star.points=2", "`2`: points are 3 to 64, friction is above 0"),
        ("star.points=65", "`65`: points are 3 to 64, friction is above 0"),
        ("star.points=x", "`x` is not a number"),
        ("load.friction=0", "`0`: points are 3 to 64, friction is above 0"),
        ("load.friction=inf", "`inf`: points are 3 to 64, friction is above 0"),
        ("load.pressure=1 kPa..2 kPa", "`1 kPa..2 kPa` lacks the number of values: FROM..TO/COUNT"),
        ("load.pressure=1 kPa..2 kPa/x", "`x` is not a number of values"),
        ("load.pressure=1 kPa..2 kPa/0", "0 values; allowed are 1 to 1000000"),
        ("load.pressure=1 kPa..2 kPa/1000001", "1000001 values; allowed are 1 to 1000000"),
        (
            "star.points=3..6/3",
            "4.5 is not a number of points: choose the number of values so that all are whole",
        ),
    ];
    for (text, what) in faults {
        assert_eq!(Axis::parse(text), Err(what.to_owned()), "{text}");
    }
    assert_eq!(Axis::parse("star.points=3,64").expect("valid").values, [3.0, 64.0]);
    assert_eq!(Axis::parse("load.friction=1.5").expect("valid").key, Key::Friction);
    assert_eq!(Axis::parse("load.pressure=1 kPa..2 kPa/1000000").expect("valid").values.len(), 1_000_000);
}

#[test]
fn faults_of_a_sweep_say_which_axis() {
    let new = |axes: &[&str]| {
        let axes = axes.iter().map(|text| Axis::parse(text).expect("valid")).collect();
        Sweep::new(candidate(&paper(5)), axes).map(|sweep| sweep.rows())
    };
    assert_eq!(new(&[]), Err("nothing is varied".to_owned()));
    let twice = new(&["star.points=3", "load.friction=1", "star.points=4"]);
    assert_eq!(twice, Err("`star.points` is varied twice".to_owned()));
    let thousand =
        ["load.pressure=1 kPa..2 kPa/1000", "star.tip_angle=30 deg..40 deg/1000", "load.friction=1..2/1000"];
    assert_eq!(new(&thousand), Ok(1_000_000_000));
    let more = [&thousand[..2], &["load.friction=1..2/1001"]].concat();
    assert_eq!(new(&more), Err("more than 1000000000 rows".to_owned()));
}

#[test]
fn parts_are_a_partition_of_equal_sizes() {
    let sweep = sweep(&["star.points=3,4,5,6,7", "load.friction=0.1..1/11"]);
    for parts in [1, 2, 7, 55, 60] {
        let cuts: Vec<Range<usize>> = (1..=parts).map(|part| sweep.part(part, parts)).collect();
        assert_eq!((cuts[0].start, cuts[parts - 1].end), (0, 55));
        assert!(cuts.windows(2).all(|pair| pair[0].end == pair[1].start));
        let (least, most) = (55 / parts, 55_usize.div_ceil(parts));
        assert!(cuts.iter().all(|cut| (least..=most).contains(&cut.len())), "{parts}: {cuts:?}");
    }
}

#[test]
fn a_reader_that_has_enough_stops_the_run() {
    let sweep = sweep(&["star.tip_angle=30 deg..40 deg/9000"]);
    let (mut calls, mut rows) = (0, 0);
    sweep.run(0..sweep.rows(), |text, count| {
        assert_eq!(text.lines().count(), count);
        (calls, rows) = (calls + 1, rows + count);
        calls < 2
    });
    assert_eq!((calls, rows), (2, 8192));
}

#[test]
fn the_table_is_the_ring() {
    let table = RingTable::new().expect("solved");
    for r_star in [1e-3, 0.1, 1.0, 7.0] {
        let (fast, exact) = (TableRing(&table), &Ring as &dyn HingeModel);
        let [a, b] = [fast.target(r_star), exact.target(r_star)].map(|state| state.expect("in range"));
        let [x, y] = [a, b].map(|state| state.edges.expect("a ring has edges"));
        let pairs = [
            (a.lambda, b.lambda),
            (a.volume.expect("known"), b.volume.expect("known")),
            (a.curvature, b.curvature),
            (x.tension, y.tension),
            (x.angle, y.angle),
            (x.width, y.width),
            (x.rim_force, y.rim_force),
        ];
        for (fast, exact) in pairs {
            close(fast, exact, 1e-8);
        }
        let [a, b] = [fast.onset(r_star), exact.onset(r_star)].map(|onset| onset.expect("in range"));
        close(a.expect("known"), b.expect("known"), 1e-8);
    }
}
