//! Faults and warnings of sketches: each has the right code, the place and a remedy that works.

use std::f64::consts::FRAC_PI_2;

use stargrip_cam::geom::Path;
use stargrip_cam::sealed::{DrawnPort, PortPlace, Rules, ShapeCode, ShapeFault, Sketch, sealed_shape};

use crate::sketches::{RULES, circle, drawn, open, p, port, rectangle, sketch};

/// A cushion with a port on its left edge.
fn cushion() -> Sketch {
    sketch(vec![("r", rectangle(20.0, 30.0, 120.0, 80.0))], vec![port(20.0, 70.0)])
}

fn across(name: &str, from: (f64, f64), to: (f64, f64)) -> DrawnPort {
    DrawnPort { name: name.to_owned(), place: PortPlace::Across([p(from.0, from.1), p(to.0, to.1)]) }
}

fn faults(sketch: &Sketch) -> Vec<ShapeFault> {
    sealed_shape(sketch, &RULES).expect_err("faulty")
}

/// The one fault of a sketch.
fn fault(sketch: &Sketch) -> ShapeFault {
    let mut found = faults(sketch);
    assert_eq!(found.len(), 1, "{found:#?}");
    found.remove(0)
}

fn warnings(sketch: &Sketch) -> Vec<ShapeFault> {
    sealed_shape(sketch, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}")).warnings
}

#[test]
fn a_hole_keeps_off_the_cut() {
    let with = |x: f64| Sketch {
        holes: vec![drawn("h", circle(x, 70.0, 2.0))],
        cuts: vec![drawn("c", rectangle(15.0, 15.0, 145.0, 110.0))],
        ..cushion()
    };
    for x in [160.0, 159.0, 158.0, 161.5] {
        let found = faults(&with(x));
        let hole = found.iter().find(|fault| fault.what.starts_with("'h' crosses or touches 'c'"));
        let hole = hole.unwrap_or_else(|| panic!("{x}: {found:#?}"));
        assert_eq!(hole.code, ShapeCode::CutInBand);
        assert!((hole.place.x - 160.0).abs() < 4.1 && (hole.place.y - 70.0).abs() < 2.1, "{hole:?}");
    }
    let thin = warnings(&with(157.0));
    let [web] = thin.as_slice() else { panic!("{thin:#?}") };
    assert!(web.code == ShapeCode::ThinWeb && (web.found - 1.0).abs() < 1e-6, "{web:?}");
    assert_eq!(warnings(&with(154.9)), []);
    // Without a drawn cut the hole keeps off the cut along the bands; holes keep off each other.
    let automatic = Sketch { holes: vec![drawn("h", circle(150.0, 70.0, 2.0))], ..cushion() };
    assert!(faults(&automatic).iter().any(|fault| fault.what == "'h' crosses or touches the cut"));
    let two = Sketch {
        holes: vec![drawn("h", circle(148.0, 70.0, 0.5)), drawn("i", circle(148.0, 72.0, 0.5))],
        ..with(0.0)
    };
    let two = warnings(&two);
    assert!(two.len() == 1 && two[0].names == ["i", "h"] && (two[0].found - 1.0).abs() < 1e-6, "{two:#?}");
}

#[test]
fn a_pouch_does_not_lie_in_a_hole() {
    let (near, far) = (rectangle(5.0, 15.0, 150.0, 110.0), rectangle(-20.0, -20.0, 200.0, 200.0));
    let hole =
        Sketch { holes: vec![drawn("h", near.clone())], cuts: vec![drawn("c", far.clone())], ..cushion() };
    let hole = fault(&hole);
    assert!(hole.code == ShapeCode::CutInBand && hole.what == "the hole 'h' lies around a band", "{hole:?}");
    let frame = |cuts: Vec<(&str, Path)>| {
        fault(&Sketch { cuts: cuts.into_iter().map(|(name, path)| drawn(name, path)).collect(), ..cushion() })
    };
    for cuts in [vec![("c", near.clone()), ("f", far.clone())], vec![("f", far), ("c", near)]] {
        let nested = frame(cuts);
        assert!(nested.code == ShapeCode::Outlines && nested.names == ["c"], "{nested:?}");
    }
}

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
            found.code == ShapeCode::BandsOverlap
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
    assert!(found.code == ShapeCode::BandsOverlap && found.place == p(70.0, 100.0), "{found:?}");
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

#[test]
fn a_leak_away_from_ports_names_the_bands() {
    let edge = vec![("a", rectangle(20.0, 40.0, 60.0, 60.0)), ("b", rectangle(80.0, 50.0, 60.0, 40.0))];
    let touching = sketch(edge, vec![port(20.0, 70.0)]);
    let over = Sketch { seams: vec![drawn("w", open(&[p(80.0, 80.0), p(80.0, 116.0)]))], ..cushion() };
    for sketch in [touching, over] {
        for fault in sealed_shape(&sketch, &RULES).err().into_iter().flatten() {
            let is_port = fault.remedy.contains("the port");
            assert!(!is_port && (fault.code == ShapeCode::NoPort || !fault.names.is_empty()), "{fault:?}");
        }
    }
}

#[test]
fn near_corners_are_counted() {
    let path = |points: &[(f64, f64)]| -> Path {
        let ends: Vec<_> = points.iter().chain(&points[..1]).map(|(x, y)| p(*x, *y)).collect();
        Path { closed: true, ..open(&ends) }
    };
    let notch = path(&[
        (0.0, 0.0),
        (150.0, 0.0),
        (150.0, 90.0),
        (90.0, 90.0),
        (90.0, 60.0),
        (82.0, 60.0),
        (82.0, 90.0),
        (0.0, 90.0),
    ]);
    let found = warnings(&sketch(vec![("n", notch)], vec![port(0.0, 50.0)]));
    let sharp: Vec<_> = found.iter().filter(|warning| warning.code == ShapeCode::SharpCorner).collect();
    assert_eq!(sharp.len(), 1, "{found:#?}");
    assert!(sharp[0].what.ends_with("(and 1 more within 10 mm)"), "{}", sharp[0].what);
}

#[test]
fn a_join_is_named_only_where_it_works() {
    // Lines past each other by 1 mm.
    let past = sketch(
        vec![
            ("a", open(&[p(19.0, 20.0), p(101.0, 20.0)])),
            ("b", open(&[p(100.0, 19.0), p(100.0, 81.0)])),
            ("c", open(&[p(101.0, 80.0), p(19.0, 80.0)])),
            ("d", open(&[p(20.0, 81.0), p(20.0, 19.0)])),
        ],
        vec![port(20.0, 50.0)],
    );
    let found = faults(&past);
    assert_eq!(found.len(), 4, "{found:#?}");
    for fault in &found {
        assert!(
            fault.code == ShapeCode::Crossing && fault.remedy.starts_with("trim the 1.000 mm"),
            "{fault:?}"
        );
    }
    let gap = sketch(
        vec![("e", open(&[p(20.0, 20.4), p(20.0, 80.0), p(90.0, 80.0), p(90.0, 20.0), p(20.0, 20.0)]))],
        vec![port(20.0, 50.0)],
    );
    assert!(fault(&gap).remedy.ends_with("join = \"0.4 mm\" would close it"));
    // The line of a port on the layer of air.
    let mark = sketch(
        vec![("r", rectangle(20.0, 30.0, 120.0, 80.0)), ("p", open(&[p(16.0, 70.0), p(24.0, 70.0)]))],
        vec![],
    );
    let mark = fault(&mark);
    assert!(mark.remedy.contains("a layer with the role `port`"), "{mark:?}");
}

#[test]
fn cuts_are_told_by_what_is_wrong_with_them() {
    let with = |cuts: Vec<(&str, Path)>| Sketch {
        cuts: cuts.into_iter().map(|(name, path)| drawn(name, path)).collect(),
        ..cushion()
    };
    let shared = fault(&with(vec![
        ("c", rectangle(10.0, 20.0, 70.0, 100.0)),
        ("d", rectangle(80.0, 20.0, 70.0, 100.0)),
    ]));
    assert!(shared.code == ShapeCode::Outlines && shared.what.contains("'c' and 'd'"), "{shared:?}");
    assert!((shared.place.x - 10.0).abs() < 70.1 && shared.place.y >= 20.0, "{shared:?}");
    let ends =
        faults(&with(vec![("c", open(&[p(10.0, 20.0), p(150.0, 20.0), p(150.0, 120.0), p(10.0, 120.0)]))]));
    assert!(
        ends.iter().all(|fault| fault.code == ShapeCode::DanglingEnd && fault.remedy == "close it"),
        "{ends:#?}"
    );
    let crossed = faults(&with(vec![("c", rectangle(19.0, 15.0, 150.0, 110.0))]));
    assert!(crossed.iter().any(|fault| fault.what == "'c' crosses a band"), "{crossed:#?}");
    // Two cushions near each other: the first message names the way out, which works.
    let two = |gap: f64| {
        sketch(
            vec![("a", rectangle(0.0, 0.0, 60.0, 60.0)), ("b", rectangle(60.0 + gap, 0.0, 60.0, 60.0))],
            vec![port(0.0, 30.0), port(120.0 + gap, 30.0)],
        )
    };
    let near = faults(&two(3.0));
    assert!(near[0].remedy.ends_with("with a drawn cut around both"), "{near:#?}");
    let apart = fault(&two(10.0));
    assert!(apart.code == ShapeCode::Outlines && apart.remedy.contains("the role `cut`"), "{apart:?}");
    let cut = Sketch { cuts: vec![drawn("c", rectangle(-10.0, -10.0, 150.0, 80.0))], ..two(10.0) };
    assert!(sealed_shape(&cut, &RULES).is_ok());
}

#[test]
fn a_chamber_without_a_port_has_the_name_of_the_drawing() {
    let name = "gr\u{f6}\u{df}e \u{2300}";
    let found = fault(&sketch(vec![(name, rectangle(0.0, 0.0, 60.0, 60.0))], vec![]));
    assert_eq!((found.code, found.names.as_slice()), (ShapeCode::NoPort, &[name.to_owned()][..]));
    assert!(found.what.contains(name), "{}", found.what);
}
