//! Faults and warnings of ports: copies, neighbours, hairpins, mouths in uncut fabric.

use crate::sketch_faults::{across, cushion, fault, faults, warnings};
use crate::sketches::{RULES, circle, drawn, open, p, port, rectangle, sketch};
use stargrip_cam::geom::Path;
use stargrip_cam::sealed::{DrawnPort, Rules, ShapeCode, Sketch, sealed_shape};
use std::f64::consts::FRAC_PI_2;

#[test]
fn a_port_marks_one_place() {
    let with = |port| Sketch { ports: vec![port], ..cushion() };
    let both = fault(&with(across("p", (10.0, 70.0), (150.0, 70.0))));
    assert_eq!(both.code, ShapeCode::LostPort);
    assert!(
        both.what.contains("crosses outer edges 2 times") && both.what.contains("X 140.000 Y 70.000"),
        "{both:?}"
    );
    let disc = |port| sketch(vec![("d", circle(80.0, 80.0, 40.0))], vec![port]);
    let along = fault(&disc(across("p", (76.0, 120.0), (84.0, 120.0))));
    assert!(along.code == ShapeCode::LostPort && along.remedy.contains("across the edge"), "{along:?}");
    for port in [across("p", (80.0, 116.0), (80.0, 124.0)), across("p", (78.0, 116.0), (82.0, 124.0))] {
        assert_eq!(warnings(&disc(port)), []);
    }
    // A short line on a straight edge marks its middle.
    assert_eq!(warnings(&with(across("p", (20.0, 66.0), (20.0, 74.0)))), []);
}

#[test]
fn copies_of_ports_are_merged_and_other_near_ports_are_told() {
    let twice = Sketch {
        ports: vec![across("p", (16.0, 70.0), (24.0, 70.0)), across("q", (24.0, 70.0), (16.0, 70.0))],
        ..cushion()
    };
    let sealing = sealed_shape(&twice, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}"));
    assert_eq!(sealing.shape.ports.len(), 1);
    assert!(sealing.repairs.iter().any(|repair| repair.what == "a port drawn twice in 'p' and 'q' merged"));
    for distance in [4.5, 5.0, 7.0] {
        let second = across("q", (16.0, 70.0 + distance), (24.0, 70.0 + distance));
        let ports = vec![across("p", (16.0, 70.0), (24.0, 70.0)), second];
        let air = Sketch { ports, ..cushion() };
        let seams = Sketch { seams: air.air.clone(), air: vec![], ..air.clone() };
        for fault in [air, seams].iter().flat_map(faults) {
            assert!(fault.remedy.starts_with("put ports at least 10.000 mm from each other"), "{fault:?}");
        }
    }
}

/// A port lies on the drawn edge, not on the channel of another one.
#[test]
fn ports_nearer_than_a_hose_are_refused() {
    let first = || across("p", (16.0, 70.0), (24.0, 70.0));
    let near = [0.03, 0.5, 1.0, 2.0, 2.9, 3.0, 3.5, 5.0];
    let beside = near.map(|more| across("q", (16.0, 70.0 + more), (24.0, 70.0 + more)));
    let others =
        [across("q", (17.0, 67.0), (23.0, 74.0)), DrawnPort { name: "q".to_owned(), ..port(20.0, 72.0) }];
    for second in beside.into_iter().chain(others) {
        for ports in [vec![first(), second.clone()], vec![second.clone(), first()]] {
            let air = Sketch { ports, ..cushion() };
            let seams = Sketch { seams: air.air.clone(), air: vec![], ..air.clone() };
            for sketch in [air, seams] {
                let found = fault(&sketch);
                assert!(
                    found.code == ShapeCode::LostPort && found.what.contains("the channel of another port")
                );
                assert_eq!(found.names, [sketch.ports[1].name.as_str()], "{found:?}");
            }
        }
    }
}

/// The legs of a V lie on each other as two parallel welds do, unless they diverge.
#[test]
fn a_hairpin_is_refused_and_a_v_is_not() {
    let with = |points: &[(f64, f64)]| {
        let points: Vec<_> = points.iter().map(|(x, y)| p(*x, *y)).collect();
        Sketch { seams: vec![drawn("w", open(&points))], ..cushion() }
    };
    for width in [0.1, 0.5, 1.0, 1.9] {
        for points in [
            [(80.0, 90.0), (80.0, 55.0), (80.0 + width, 90.0)],
            [(80.0 + width, 90.0), (80.0, 55.0), (80.0, 90.0)],
        ] {
            let found = fault(&with(&points));
            assert!(found.code == ShapeCode::BandsOverlap && found.place == p(80.0, 55.0), "{found:?}");
            assert!((found.found - width).abs() < 0.03 && found.allowed == 2.0, "{found:?}");
        }
        let parallel = [(80.0, 90.0), (80.0, 55.0), (80.0 + width, 55.0), (80.0 + width, 90.0)];
        assert_eq!(fault(&with(&parallel)).code, ShapeCode::BandsOverlap, "{width}");
    }
    let spread = [
        vec![(80.0, 90.0), (80.0, 55.0), (82.1, 90.0)],
        vec![(70.0, 90.0), (80.0, 55.0), (90.0, 90.0), (100.0, 55.0)],
        // Legs of several segments, the first ones close; a barb shorter than the band.
        vec![(60.0, 90.0), (79.0, 60.0), (80.0, 55.0), (81.0, 60.0), (100.0, 90.0)],
        vec![(80.0, 90.0), (80.0, 55.0), (80.3, 56.9)],
    ];
    for points in spread {
        assert!(sealed_shape(&with(&points), &RULES).is_ok(), "{points:?}");
    }
}

/// Flaps of both arms bridge the gap of a U: no hose can be pushed in there.
#[test]
fn a_mouth_in_uncut_fabric_is_refused() {
    let u = |gap: f64, port: DrawnPort| {
        let (a, b, c) = (60.0, 60.0 + gap, 120.0 + gap);
        let corners =
            [(0.0, 0.0), (c, 0.0), (c, 130.0), (b, 130.0), (b, 50.0), (a, 50.0), (a, 130.0), (0.0, 130.0)];
        let points: Vec<_> = corners.iter().chain(&corners[..1]).map(|(x, y)| p(*x, *y)).collect();
        sketch(vec![("u", Path { closed: true, ..open(&points) })], vec![port])
    };
    let arm = || across("p", (55.0, 100.0), (65.0, 100.0));
    for gap in [8.0, 10.0, 12.0, 13.0, 14.0, 15.0, 18.0, 22.0, 26.0, 31.9] {
        let found = fault(&u(gap, arm()));
        assert!(
            found.code == ShapeCode::ChannelOverlap
                && found.names.contains(&"p".to_owned())
                && found.what.contains("port 'p'"),
            "{gap}: {found:?}"
        );
        assert!(found.remedy.contains("at least 32.000 mm of fabric in front of it"), "{found:?}");
    }
    assert!(sealed_shape(&u(32.0, arm()), &RULES).is_ok() && sealed_shape(&u(40.0, arm()), &RULES).is_ok());
    // At the foot of the gap the way out is long, but uncut.
    let foot = |gap: f64| u(gap, across("p", (60.0 + gap / 2.0, 45.0), (60.0 + gap / 2.0, 55.0)));
    // 70 mm to the tops of the arms, and sqrt(10^2 - 9^2) to where their flaps meet.
    assert_eq!(fault(&foot(18.0)).what, "the cut passes 74.359 mm in front of the mouth of port 'p'");
    assert!(sealed_shape(&foot(60.0), &RULES).is_ok());
    // Drawn cuts may lead through the gap.
    let cuts = |cut: Path| Sketch { cuts: vec![drawn("c", cut)], ..u(22.0, arm()) };
    let found = fault(&cuts(rectangle(-20.0, -20.0, 182.0, 170.0)));
    assert!(found.code == ShapeCode::ChannelOverlap && found.place == p(81.0, 100.0), "{found:?}");
    let points = [(-20.0, -20.0), (162.0, -20.0), (162.0, 150.0), (72.0, 150.0), (72.0, 60.0), (70.0, 60.0)];
    let points = points.into_iter().chain([(70.0, 150.0), (-20.0, 150.0), (-20.0, -20.0)]);
    let slit = Path { closed: true, ..open(&points.map(|(x, y)| p(x, y)).collect::<Vec<_>>()) };
    assert_eq!(sealed_shape(&cuts(slit), &RULES).err(), None);
}

/// The bands of two ports may touch, whatever the number of ports and their distance from there on.
#[test]
fn ports_are_no_farther_from_each_other_than_is_told() {
    let apart = |distance: f64, rules: &Rules| {
        let ports = (0..3).map(|i| port(20.0, 40.0 + f64::from(i) * distance)).collect();
        sealed_shape(&Sketch { ports, ..cushion() }, rules)
    };
    for width in [6.0, 4.0 * FRAC_PI_2] {
        let rules = Rules { port_width: width, ..RULES };
        let near = apart(width + 3.9, &rules).expect_err("too near");
        let told = near[0].remedy.trim_start_matches("put ports at least ").split(' ').next();
        let least: f64 = told.expect("a number").parse().expect("a number");
        assert!((least - width - 4.0).abs() < 1e-3, "{near:#?}");
        for more in [0.0, 0.01, 1.0, 2.0, 5.0, 6.5, 8.0, 12.0] {
            let found = apart(least + more, &rules);
            let ports = found.as_ref().map(|sealing| sealing.shape.ports.len());
            assert!(matches!(ports, Ok(3)), "{width} {more}: {found:#?}");
        }
    }
}
