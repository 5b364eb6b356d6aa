//! Faults and warnings of sketches: each has the right code, the place and a remedy that works.

use crate::sketches::{RULES, circle, drawn, open, p, port, rectangle, sketch};
use stargrip_cam::geom::Path;
use stargrip_cam::sealed::{DrawnPort, PortPlace, ShapeCode, ShapeFault, Sketch, sealed_shape, separate};

/// A cushion with a port on its left edge.
pub(super) fn cushion() -> Sketch {
    sketch(vec![("r", rectangle(20.0, 30.0, 120.0, 80.0))], vec![port(20.0, 70.0)])
}

pub(super) fn across(name: &str, from: (f64, f64), to: (f64, f64)) -> DrawnPort {
    DrawnPort { name: name.to_owned(), place: PortPlace::Across([p(from.0, from.1), p(to.0, to.1)]) }
}

pub(super) fn faults(sketch: &Sketch) -> Vec<ShapeFault> {
    sealed_shape(sketch, &RULES).expect_err("faulty")
}

/// The one fault of a sketch.
pub(super) fn fault(sketch: &Sketch) -> ShapeFault {
    let mut found = faults(sketch);
    assert_eq!(found.len(), 1, "{found:#?}");
    found.remove(0)
}

pub(super) fn warnings(sketch: &Sketch) -> Vec<ShapeFault> {
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
    assert!(near[0].remedy.ends_with("for two bands of two pieces"), "{near:#?}");
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

/// A chain of pouches 40 mm high along X, joined by channels of `width` mm; `lengths` are those of pouches and channels in turn.
fn chain(lengths: &[f64], width: f64) -> Path {
    let (mut x, mut lower, mut upper) = (20.0, Vec::new(), Vec::new());
    for (i, length) in lengths.iter().enumerate() {
        let half = if i % 2 == 0 { 20.0 } else { width / 2.0 };
        for x in [x, x + length] {
            lower.push(p(x, 80.0 - half));
            upper.insert(0, p(x, 80.0 + half));
        }
        x += length;
    }
    let corners = [lower.clone(), upper, vec![lower[0]]].concat();
    Path { closed: true, ..open(&corners) }
}

/// Wherever the hose is: in line, beside the first channel, or far away; and however near the channels are to each other.
#[test]
fn narrow_channels_are_found_wherever_they_are() {
    for pouch in [9.0, 20.0, 50.0] {
        for channel in [6.0, 10.0, 40.0, 160.0] {
            let lengths = [40.0, channel, pouch, channel, pouch, channel, 40.0];
            let middle = |number: f64| 60.0 + number * (channel + pouch) + channel / 2.0;
            let top = across("p", (40.0, 95.0), (40.0, 105.0));
            let end = 100.0 + 3.0 * channel + 2.0 * pouch;
            let ports = [
                across("p", (15.0, 80.0), (25.0, 80.0)),
                across("p", (end - 5.0, 80.0), (end + 5.0, 80.0)),
                across("p", (52.0, 103.0), (52.0, 93.0)),
                top,
            ];
            for port in ports {
                for (width, code) in [(3.5, ShapeCode::NarrowTube), (10.0, ShapeCode::NarrowPassage)] {
                    // A pouch that is narrow itself does not part two passages.
                    if pouch < 15.0 && code == ShapeCode::NarrowPassage {
                        continue;
                    }
                    let chain = sketch(vec![("c", chain(&lengths, width))], vec![port.clone()]);
                    let all = match sealed_shape(&chain, &RULES) {
                        Ok(sealing) => sealing.warnings,
                        Err(faults) => faults,
                    };
                    let places: Vec<_> = all.iter().filter(|fault| fault.code == code).collect();
                    assert_eq!(places.len(), 3, "{pouch} {channel} {width} {port:?}: {all:#?}");
                    for number in 0..3_u32 {
                        let x = middle(f64::from(number));
                        let is_there = |fault: &&&ShapeFault| (fault.place.x - x).abs() < channel / 2.0 + 1.5;
                        assert_eq!(places.iter().filter(is_there).count(), 1, "{x}: {places:#?}");
                    }
                }
            }
        }
    }
}

/// A tube that stays narrow is one place, however many steps it is drawn in.
#[test]
fn a_narrow_tube_is_told_once() {
    for steps in [1, 3, 40] {
        let at = |i: u32, y: f64| p(60.0 + 120.0 * f64::from(i) / f64::from(steps), y);
        let lower = (0..=steps).map(|i| at(i, 78.5));
        let upper = (0..=steps).rev().map(|i| at(i, 81.5));
        let left = [p(60.0, 100.0), p(20.0, 100.0), p(20.0, 60.0), p(60.0, 60.0)];
        let right = [p(180.0, 60.0), p(220.0, 60.0), p(220.0, 100.0), p(180.0, 100.0)];
        let corners: Vec<_> =
            left.into_iter().chain(lower).chain(right).chain(upper).chain([left[0]]).collect();
        let path = Path { closed: true, ..open(&corners) };
        let tube = fault(&sketch(vec![("t", path)], vec![port(20.0, 80.0)]));
        assert!(tube.code == ShapeCode::NarrowTube && (tube.found - 3.0).abs() < 1e-9, "{tube:?}");
    }
}

/// One side of a place is the channel of a port: it is named, not the curve that the port opens.
#[test]
fn channels_are_named_where_they_are_one_side() {
    let edge = Path {
        closed: true,
        ..open(&[
            p(20.0, 30.0),
            p(120.0, 30.0),
            p(120.0, 60.0),
            p(80.0, 60.0),
            p(80.0, 68.0),
            p(120.0, 68.0),
            p(120.0, 110.0),
            p(20.0, 110.0),
            p(20.0, 30.0),
        ])
    };
    let mut notch = sketch(vec![("r", edge)], vec![across("p", (76.0, 64.0), (84.0, 64.0))]);
    notch.cuts = vec![drawn("c", rectangle(8.0, 10.0, 160.0, 120.0))];
    for fault in faults(&notch) {
        assert!(fault.what.contains("the channel of port 'p' and the edge of 'r'"), "{fault:?}");
        assert_eq!(fault.names, ["r", "p"]);
    }
    let facing = |gap: f64| Sketch {
        cuts: vec![drawn("c", rectangle(0.0, 10.0, 200.0, 120.0))],
        ..sketch(
            vec![("a", rectangle(20.0, 30.0, 60.0, 80.0)), ("b", rectangle(80.0 + gap, 30.0, 60.0, 80.0))],
            vec![
                across("q", (16.0, 70.0), (24.0, 70.0)),
                across("p", (76.0 + gap, 70.0), (84.0 + gap, 70.0)),
            ],
        )
    };
    for gap in [5.0, 8.0, 10.0, 12.0, 15.0, 20.0] {
        for fault in faults(&facing(gap)) {
            assert!(
                fault.names.contains(&"p".to_owned()) && fault.what.contains("port 'p'"),
                "{gap}: {fault:?}"
            );
        }
    }
    // Two hoses into one corner: their chamber has ports, whatever is wrong with them.
    let corner = |d: f64| {
        let ports = vec![
            across("p", (20.0 + d, 26.0), (20.0 + d, 34.0)),
            across("q", (16.0, 30.0 + d), (24.0, 30.0 + d)),
        ];
        let sketch = sketch(vec![("r", rectangle(20.0, 30.0, 120.0, 80.0))], ports);
        sealed_shape(&sketch, &RULES).err().unwrap_or_default()
    };
    for d in [1.0, 2.0, 3.5, 4.0, 5.0] {
        assert!(corner(d).iter().all(|fault| fault.code != ShapeCode::NoPort), "{:#?}", corner(d));
    }
    assert!(!corner(1.0).is_empty(), "the channels meet");
}

/// A gap at the hose is closed, and the hose opens the edge there; one that is no mouth is told with both ends.
#[test]
fn an_outline_that_is_open_at_the_hose_is_closed() {
    let with = |gap: f64, place: DrawnPort| {
        let (a, b) = (50.0 - gap / 2.0, 50.0 + gap / 2.0);
        let corners = [p(20.0, a), p(20.0, 20.0), p(120.0, 20.0), p(120.0, 80.0), p(20.0, 80.0), p(20.0, b)];
        sketch(vec![("r", open(&corners))], vec![place])
    };
    let closed = sketch(
        vec![("r", rectangle(20.0, 20.0, 100.0, 60.0))],
        vec![across("p", (16.0, 50.0), (24.0, 50.0))],
    );
    let closed = sealed_shape(&closed, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}")).shape;
    for gap in [0.1, 3.0, 6.0, 10.0, 14.0] {
        for place in [across("p", (16.0, 50.0), (24.0, 50.0)), port(20.0, 50.0)] {
            let sealing =
                sealed_shape(&with(gap, place), &RULES).unwrap_or_else(|faults| panic!("{gap} {faults:#?}"));
            assert!(sealing.repairs[0].what.starts_with("gap of"), "{:?}", sealing.repairs);
            let (length, wanted) =
                (sealing.shape.seams[0].center_line.length(), closed.seams[0].center_line.length());
            assert!((length - wanted).abs() < 1e-6, "{gap}: {length} {wanted}");
        }
    }
    let wide = fault(&with(30.0, across("p", (16.0, 50.0), (24.0, 50.0))));
    assert!(wide.what.contains("is open at X 20.000 Y 35.000 and X 20.000 Y 65.000 mm"), "{wide:?}");
}

/// A quilt's spots are shorter than two overlaps.
#[test]
fn short_seams_overlap_by_half() {
    let spots = Sketch { seams: vec![drawn("s", circle(60.0, 70.0, 1.25))], ..cushion() };
    let sealing = sealed_shape(&spots, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}"));
    let spot = sealing.shape.seam("s").expect("a spot");
    assert!((spot.overlap - 1.25 * std::f64::consts::PI).abs() < 1e-9, "{}", spot.overlap);
    assert!(sealing.repairs.iter().any(|repair| repair.what.contains("'s'")), "{:?}", sealing.repairs);
}

/// What is cut out by itself is a piece; what lies within another, or beside it without room for two bands, is not.
#[test]
fn pieces_are_what_cuts_part() {
    let counts = |sketch: &Sketch| {
        let pieces = separate(sketch, &RULES);
        pieces
            .iter()
            .map(|piece| [piece.air.len() + piece.seams.len(), piece.ports.len()])
            .collect::<Vec<_>>()
    };
    let letters = |gap: f64| {
        let x = 80.0 + gap;
        let lines = [
            [p(x, 0.0), p(x + 50.0, 0.0)],
            [p(x + 50.0, 60.0), p(x + 50.0, 0.0)],
            [p(x + 50.0, 60.0), p(x, 60.0)],
            [p(x, 60.0), p(x, 0.0)],
        ];
        let mut air = vec![("o", rectangle(0.0, 0.0, 80.0, 60.0)), ("i", rectangle(30.0, 20.0, 20.0, 20.0))];
        air.extend(lines.iter().map(|line| ("l", open(line))));
        sketch(air, vec![port(40.0, 0.0), port(x + 50.0, 30.0)])
    };
    assert_eq!(counts(&letters(5.0)), [[2, 1], [4, 1]]);
    assert_eq!(counts(&letters(50.0)), [[2, 1], [4, 1]]);
    assert_eq!(counts(&letters(2.0)), [[6, 2]]);
    let welded = Sketch { seams: vec![drawn("w", open(&[p(10.0, 10.0), p(20.0, 10.0)]))], ..letters(9.0) };
    assert_eq!(counts(&welded), [[3, 1], [4, 1]]);
    let around = Sketch { cuts: vec![drawn("c", rectangle(-20.0, -20.0, 200.0, 100.0))], ..letters(9.0) };
    assert_eq!(counts(&around), [[6, 2]]);
    let cuts = vec![
        drawn("c", rectangle(-20.0, -20.0, 104.0, 100.0)),
        drawn("d", rectangle(85.0, -20.0, 80.0, 100.0)),
    ];
    assert_eq!(counts(&Sketch { cuts, ..letters(9.0) }), [[2, 1], [4, 1]]);
}
