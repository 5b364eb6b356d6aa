//! Sketches as sealed shapes: seams half a band outside the air, mended drawings, faults with places.

use crate::separators::spares_the_bands;
use crate::shapes::blob;
use proptest::prelude::*;
use stargrip_cam::geom::{Arc, Isometry, Line, Path, Point, Segment, Vec2};
use stargrip_cam::sealed::{
    DrawnCurve, DrawnPort, PortPlace, Role, Rules, Sealing, ShapeCode, ShapeFault, Sketch, sealed_shape,
};
use std::f64::consts::{PI, TAU};

pub(crate) const RULES: Rules = Rules {
    band: 2.0,
    allowance: 8.0,
    join: 0.02,
    overlap: 5.0,
    port_width: 6.0,
    overrun: 1.0,
    least_passage: 15.0,
    flange: 10.0,
};

pub(crate) fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

pub(crate) fn open(points: &[Point]) -> Path {
    Path::open(points.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect())
}

pub(crate) fn polygon(points: &[Point]) -> Path {
    let ends: Vec<Point> = points.iter().chain(&points[..1]).copied().collect();
    Path { closed: true, ..open(&ends) }
}

pub(crate) fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Path {
    polygon(&[p(x, y), p(x + width, y), p(x + width, y + height), p(x, y + height)])
}

pub(crate) fn circle(x: f64, y: f64, radius: f64) -> Path {
    Path::closed(vec![Arc::new(p(x, y), radius, 0.3, TAU).into()])
}

pub(crate) fn drawn(name: &str, path: Path) -> DrawnCurve {
    DrawnCurve { name: name.to_owned(), path }
}

pub(crate) fn port(x: f64, y: f64) -> DrawnPort {
    DrawnPort { name: "port".to_owned(), place: PortPlace::At(p(x, y)) }
}

pub(crate) fn sketch(air: Vec<(&str, Path)>, ports: Vec<DrawnPort>) -> Sketch {
    let air = air.into_iter().map(|(name, path)| drawn(name, path)).collect();
    Sketch { air, ports, ..Sketch::default() }
}

pub(super) fn sealed(sketch: &Sketch) -> Sealing {
    let sealing = sealed_shape(sketch, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}"));
    let topology = sealing.shape.topology();
    assert_eq!(topology.leaks, []);
    for seam in &sealing.shape.seams {
        assert!(seam.center_line.largest_gap() < 1e-9, "{}", seam.name);
    }
    assert!(sealing.shape.cut.as_ref().is_some_and(|cut| cut.largest_gap() < 1e-9 && cut.area() > 0.0));
    sealing
}

pub(super) fn refused(sketch: &Sketch) -> Vec<ShapeFault> {
    sealed_shape(sketch, &RULES).err().unwrap_or_default()
}

/// Places along a path, the ends of segments among them.
pub(crate) fn samples(path: &Path) -> Vec<Point> {
    path.segments
        .iter()
        .flat_map(|s| (0..=8).map(|i| s.point(f64::from(i) / 8.0)).collect::<Vec<_>>())
        .collect()
}

fn names(sealing: &Sealing) -> Vec<&str> {
    sealing.shape.seams.iter().map(|seam| seam.name.as_str()).collect()
}

#[test]
fn a_pillow_is_sealed_half_a_band_outside_and_open_at_its_port() {
    let air = rectangle(0.0, 0.0, 100.0, 60.0);
    let sealing = sealed(&sketch(vec![("", air.clone())], vec![port(50.0, 60.0)]));
    assert_eq!(names(&sealing), ["outer"]);
    let seam = &sealing.shape.seams[0];
    assert_eq!((seam.role, seam.center_line.closed), (Role::Boundary, false));
    let (start, end) = (seam.center_line.start().unwrap(), seam.center_line.end().unwrap());
    // The channel has the hose's width, and its bands run past the cut.
    assert!(start.distance(p(46.0, 71.0)) < 1e-9 && end.distance(p(54.0, 71.0)) < 1e-9, "{start:?} {end:?}");
    for at in samples(&seam.center_line).into_iter().filter(|at| (at.x - 50.0).abs() > 4.0 + 1e-9) {
        assert!((air.distance(at) - 1.0).abs() < 1e-9, "{at:?}");
    }
    let cut = sealing.shape.cut.as_ref().unwrap();
    let area = 100.0 * 60.0 + 10.0 * 320.0 + PI * 100.0;
    assert!((cut.area() - area).abs() < 1e-6, "{}", cut.area());
    let topology = sealing.shape.topology();
    assert_eq!((topology.chambers.len(), topology.chambers[0].ports.as_slice()), (1, &[0][..]));
    assert!((sealing.shape.port_width(0).unwrap() - 6.0).abs() < 1e-9);
    assert_eq!(sealing.shape.ports[0].at, p(50.0, 70.0));
}

/// A wall that is drawn to the edges ends there to a file's decimals only.
#[test]
fn a_wall_may_miss_an_edge_by_join() {
    let with = |a: f64, b: f64| {
        let ports = vec![port(0.0, 30.0), port(100.0, 30.0)];
        let air = sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], ports);
        Sketch { seams: vec![drawn("w", open(&[p(50.0, a), p(50.0, b)]))], ..air }
    };
    let exact = sealed(&with(0.0, 60.0));
    assert_eq!((exact.repairs.len(), exact.shape.topology().chambers.len()), (0, 2));
    for gap in [1e-7, 1e-5, 0.001, 0.0199] {
        for (a, b, count) in [(gap, 60.0, 1), (0.0, 60.0 - gap, 1), (gap, 60.0 - gap, 2)] {
            let near = sealed(&with(a, b));
            assert_eq!(near.shape.topology().chambers.len(), 2, "{gap}");
            // Within the slack of a band there is nothing to mend.
            if gap > 1e-6 {
                assert_eq!(near.repairs.len(), count, "{:?}", near.repairs);
                assert!(near.repairs.iter().all(|repair| repair.names == ["w", "r"]));
                assert_eq!((&near.shape, &near.inner), (&exact.shape, &exact.inner), "{gap}");
            }
        }
    }
    assert!(sealed(&with(0.001, 60.0)).repairs[0].what == "gap of 0.0010 mm in 'w' and 'r' closed");
    assert!(refused(&with(0.021, 60.0)).iter().all(|fault| fault.code == ShapeCode::BandsOverlap));
    // Past the edge it ends in the band.
    assert_eq!(sealed(&with(-0.01, 60.5)).repairs, []);
}

/// A file's decimals turn a port's line by some millionths, a drawer by some tenths of a degree: the cut crosses the mouth all the same.
#[test]
fn a_cut_is_straight_across_a_mouth_that_is_nearly_square() {
    let air = rectangle(0.0, 0.0, 100.0, 60.0);
    let height = |degrees: f64| {
        let lean = 5.0 * degrees.to_radians().tan();
        let place = PortPlace::Across([p(50.0 - lean, 55.0), p(50.0 + lean, 65.0)]);
        let port = DrawnPort { name: String::new(), place };
        sealed(&sketch(vec![("", air.clone())], vec![port])).shape.cut.unwrap().bounds().height()
    };
    // Where the flaps on both sides are whole: 13 mm beside the channel, and 10 mm outside the edge.
    for degrees in [0.0, 1e-9, 1e-7, 1e-5, 0.001, 0.01, 0.1, 1.0, 4.0, -0.01, -4.0_f64] {
        let expected = 80.0 + 26.0 * degrees.to_radians().abs().sin();
        assert!((height(degrees) - expected).abs() < 1e-6, "{degrees}: {}", height(degrees));
    }
    // Farther out the bands end, and the cut runs around the channel.
    assert!(height(6.0) > 90.0);
}

#[test]
fn a_disc_is_a_disc() {
    let mut disc = sketch(vec![("disc", circle(0.0, 0.0, 40.0))], vec![]);
    disc.ports =
        vec![DrawnPort { name: String::new(), place: PortPlace::Across([p(0.0, 38.0), p(0.0, 45.0)]) }];
    let sealing = sealed(&disc);
    assert_eq!(names(&sealing), ["disc"]);
    for at in samples(&sealing.shape.seams[0].center_line).into_iter().filter(|at| at.y < 30.0) {
        assert!((at.distance(Point::ORIGIN) - 41.0).abs() < 1e-9);
    }
    assert!((sealing.shape.cut.as_ref().unwrap().bounds().width() - 100.0).abs() < 1e-9);
}

#[test]
fn islands_are_sealed_inwards_and_first() {
    let air = vec![
        ("", rectangle(0.0, 0.0, 200.0, 100.0)),
        ("", circle(50.0, 50.0, 10.0)),
        ("eye", circle(150.0, 50.0, 10.0)),
    ];
    let sealing = sealed(&sketch(air, vec![port(0.0, 50.0)]));
    assert_eq!(names(&sealing), ["island-1", "eye", "outer"]);
    for (seam, x) in sealing.shape.seams.iter().zip([50.0, 150.0]) {
        assert!(seam.center_line.closed && seam.overlap == 5.0);
        for at in samples(&seam.center_line) {
            assert!((at.distance(p(x, 50.0)) - 9.0).abs() < 1e-9);
        }
    }
    let chambers = sealing.shape.topology().chambers;
    assert_eq!(chambers.len(), 1);
    assert_eq!((chambers[0].outside, chambers[0].islands.as_slice()), (2, &[0, 1][..]));
}

/// A wall between two chambers is sealed once, however it is drawn.
#[test]
fn a_shared_wall_is_one_seam() {
    let ports = || vec![port(0.0, 20.0), port(100.0, 20.0)];
    let line = open(&[p(50.0, 0.0), p(50.0, 40.0)]);
    let across = vec![("a", rectangle(0.0, 0.0, 100.0, 40.0)), ("w", line)];
    let right = rectangle(50.0, 0.0, 50.0, 40.0);
    let twice = vec![("a", rectangle(0.0, 0.0, 50.0, 40.0)), ("b", right.clone())];
    let reversed = vec![("a", rectangle(0.0, 0.0, 50.0, 40.0).reversed()), ("b", right)];
    let three = vec![
        ("a", open(&[p(50.0, 0.0), p(0.0, 0.0), p(0.0, 40.0), p(50.0, 40.0)])),
        ("b", open(&[p(50.0, 0.0), p(100.0, 0.0), p(100.0, 40.0), p(50.0, 40.0)])),
        ("w", open(&[p(50.0, 40.0), p(50.0, 0.0)])),
    ];
    for air in [across, twice, reversed, three] {
        let first = air[0].0.to_owned() + air[1].0;
        let sealing = sealed(&sketch(air, ports()));
        let seams = &sealing.shape.seams;
        assert_eq!(seams.len(), 3, "{first}: {:?}", names(&sealing));
        let wall = seams.iter().find(|seam| (seam.center_line.length() - 42.0).abs() < 1e-9).expect("a wall");
        assert!(samples(&wall.center_line).iter().all(|at| (at.x - 50.0).abs() < 1e-9));
        assert_eq!(wall.role, Role::Boundary);
        let topology = sealing.shape.topology();
        assert_eq!(
            topology.chambers.iter().map(|c| c.ports.clone()).collect::<Vec<_>>(),
            [vec![0], vec![1]],
            "{first}"
        );
    }
    // Two edges a band apart.
    let apart = vec![("a", rectangle(0.0, 0.0, 49.0, 40.0)), ("b", rectangle(51.0, 0.0, 49.0, 40.0))];
    let sealing = sealed(&sketch(apart, ports()));
    let topology = sealing.shape.topology();
    assert_eq!(topology.chambers.len(), 2, "{:?}", sealing.shape);
    let once: f64 = sealing.shape.seams.iter().map(|seam| seam.center_line.length()).sum();
    let outer = 2.0 * (100.0 + 40.0) + TAU * 1.0;
    assert!(once < outer + 42.0 + 2.0 * 20.0, "{once}");
}

#[test]
fn a_barrier_ends_in_the_air_and_is_no_leak() {
    let mut comb = sketch(vec![("", rectangle(0.0, 0.0, 200.0, 100.0))], vec![port(100.0, 0.0)]);
    for i in 1..6 {
        let (x, foot) = (f64::from(i) * 32.0, if i % 2 == 0 { 100.0 } else { 0.0 });
        if (x - 100.0).abs() > 10.0 {
            comb.seams.push(drawn("", open(&[p(x, foot), p(x, (foot - 70.0).abs())])));
        }
    }
    comb.seams.push(drawn("spot", open(&[p(16.0, 40.0), p(16.0, 60.0)])));
    let sealing = sealed(&comb);
    let welds = sealing.shape.seams.iter().filter(|seam| seam.role == Role::Weld).count();
    // The wall at x = 96 would close the port.
    assert_eq!(welds, 5);
    assert_eq!(sealing.shape.topology().chambers.len(), 1);
    assert!(names(&sealing).contains(&"spot"));
    let narrow: Vec<&ShapeFault> =
        sealing.warnings.iter().filter(|w| w.code == ShapeCode::NarrowPassage).collect();
    // Beside the spot: 16 mm to the edge's band, 16 mm to the first barrier's, less half a band on one side, a whole one on the other.
    assert!(
        narrow.iter().any(|w| (w.found - 14.0).abs() < 1e-9 && (w.place.x - 24.0).abs() < 1.0),
        "{narrow:#?}"
    );
}

#[test]
fn drawn_seams_make_a_shape_of_their_own() {
    let mut only = Sketch { seams: vec![drawn("rim", circle(0.0, 0.0, 50.0))], ..Sketch::default() };
    only.ports = vec![port(50.0, 0.0)];
    let sealing = sealed(&only);
    assert_eq!(names(&sealing), ["rim"]);
    assert!((sealing.shape.port_width(0).unwrap() - 6.0).abs() < 1e-9);
    assert!((sealing.shape.cut.as_ref().unwrap().bounds().height() - 118.0).abs() < 1e-9);
    for at in samples(&sealing.shape.seams[0].center_line).into_iter().filter(|at| at.x < 45.0) {
        assert!((at.distance(Point::ORIGIN) - 50.0).abs() < 1e-9);
    }
}

/// Every point of a seam is half a band from the nearest edge of the air, for any outline and island. Only parallels that miss each other
/// at a corner by less than 1e-5 mm are joined, which moves their points by less.
fn check_offset(edges: &[&Path], lines: &[&Path]) {
    for segment in lines.iter().flat_map(|line| &line.segments) {
        let ends = [segment.start(), segment.end()].map(|end| offset_error(edges, end));
        let most = if ends[0].max(ends[1]) > 1e-9 { 1e-5 } else { 1e-9 };
        for place in (0..=8).map(|i| segment.point(f64::from(i) / 8.0)) {
            let error = offset_error(edges, place);
            assert!(error < most, "{error} at {place:?}");
        }
    }
}

/// How much the distance of `place` from the nearest of `edges` differs from half a band, mm.
fn offset_error(edges: &[&Path], place: Point) -> f64 {
    let nearest = edges.iter().map(|edge| edge.distance(place)).fold(f64::INFINITY, f64::min);
    (nearest - 1.0).abs()
}

proptest! {
    #[test]
    fn seams_keep_half_a_band_from_the_air((blob, center) in blob(), turn in 0.0..TAU, flip in any::<bool>(), scale in 3.0..8.0) {
        let motion = Isometry { mirrored: flip, rotation: turn, shift: Vec2::new(3.0, -7.0) };
        let grown: Vec<Segment> = blob.segments.iter().map(|segment| scaled(segment, center, scale)).collect();
        let outline = motion.path(&Path::closed(grown));
        let island = motion.path(&circle(center.x, center.y, 4.0));
        let mut both = sketch(vec![("a", outline.clone()), ("i", island.clone())], vec![]);
        let at = outline.point_at(0.1 * outline.length()).unwrap();
        both.ports = vec![DrawnPort { name: String::new(), place: PortPlace::At(at) }];
        match sealed_shape(&both, &RULES) {
            Ok(sealing) => {
                let seam = |name: &str| &sealing.shape.seam(name).expect("a seam").center_line;
                // Segments farther out than the band of the edge belong to the channel.
                let outer: Vec<Segment> = seam("a").segments.iter().filter(|s| {
                    (0..=8).all(|i| {
                        let p = s.point(f64::from(i) / 8.0);
                        p.distance(at) > 20.0
                    })
                }).copied().collect();
                check_offset(&[&outline, &island], &[&Path::open(outer), seam("i")]);
                prop_assert_eq!(sealing.shape.topology().leaks, []);
                let chambers = sealing.shape.topology().chambers;
                prop_assert_eq!(chambers.len(), 1);
                prop_assert_eq!(chambers[0].islands.len(), 1);
            }
            Err(faults) => {
                for fault in &faults {
                    prop_assert!(fault.place.distance(at) < 200.0 && !fault.remedy.is_empty(), "{}", fault);
                    prop_assert!(matches!(fault.code, ShapeCode::NarrowTube | ShapeCode::PortTooWide | ShapeCode::BandsOverlap | ShapeCode::ChannelOverlap
                        | ShapeCode::Crossing), "{}", fault);
                }
            }
        }
    }

    /// Curves in pieces of any order and direction, with small gaps, give the shape of the whole.
    #[test]
    fn pieces_join_in_any_order((blob, center) in blob(), order in any::<u64>(), gap in 0.0..0.009) {
        let grown: Vec<Segment> = blob.segments.iter().map(|segment| scaled(segment, center, 8.0)).collect();
        let outline = Path::closed(grown.clone());
        let at = outline.point_at(0.1 * outline.length()).unwrap();
        let ports = || vec![DrawnPort { name: String::new(), place: PortPlace::At(at) }];
        let mut pieces: Vec<(&str, Path)> = Vec::new();
        let mut seed = order;
        for segment in grown {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let segment = Isometry::translation(Vec2::unit(f64::from((seed >> 40) as u32)) * gap).segment(&segment);
            let segment = if seed >> 63 == 0 { segment.reversed() } else { segment };
            pieces.insert((seed >> 33) as usize % (pieces.len() + 1), ("", Path::open(vec![segment])));
        }
        let whole = sealed_shape(&sketch(vec![("", outline)], ports()), &RULES);
        let joined = sealed_shape(&sketch(pieces, ports()), &RULES);
        match (whole, joined) {
            (Ok(whole), Ok(joined)) => {
                let (a, b) = (&whole.shape.seams[0].center_line, &joined.shape.seams[0].center_line);
                // Beside a corner a hundredth decides from which side the channel leads.
                for (a, b) in [(a, b), (b, a)] {
                    let off = samples(b).into_iter().filter(|p| p.distance(at) > 30.0 && a.distance(*p) > 0.2);
                    prop_assert_eq!(off.count(), 0, "{:?}", joined.repairs);
                }
            }
            (Err(a), Err(b)) => prop_assert!(a.iter().any(|f| b.iter().any(|g| g.code == f.code)), "{:?} {:?}", a, b),
            (a, b) => {
                // At the limit a hundredth decides.
                let faults = a.err().or(b.err()).unwrap_or_default();
                prop_assert!(faults.iter().all(|f| (f.found - f.allowed).abs() < 0.1), "{:?}", faults);
            }
        }
    }
}

/// The segment as seen from `center`, `scale` times as large.
pub(crate) fn scaled(segment: &Segment, center: Point, scale: f64) -> Segment {
    let at = |p: Point| center + (p - center) * scale;
    match segment {
        Segment::Line(line) => Line::new(at(line.start), at(line.end)).into(),
        Segment::Arc(arc) => Arc { center: at(arc.center), radius: arc.radius * scale, ..*arc }.into(),
    }
}

/// Polylines and arcs on a coarse grid: doubled, crossing, touching, folded.
fn scribble() -> impl Strategy<Value = Vec<Path>> {
    let at = (0_i8..7, 0_i8..7).prop_map(|(x, y)| p(f64::from(x) * 10.0, f64::from(y) * 10.0));
    let path =
        (proptest::collection::vec((at, prop_oneof![3 => Just(0.0), 1 => -1.0..1.0]), 1..7), any::<bool>());
    let path = path.prop_map(|(corners, closed)| {
        let next = corners.iter().skip(1).chain(corners.iter().take(usize::from(closed)));
        let segments = corners.iter().zip(next).map(|((a, bulge), (b, _))| {
            Arc::from_bulge(*a, *b, *bulge).map_or_else(|| Line::new(*a, *b).into(), Segment::Arc)
        });
        Path { segments: segments.collect(), closed }
    });
    proptest::collection::vec(path, 0..4)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn whatever_is_drawn_is_sealed_or_refused(air in scribble(), seams in scribble(), cuts in scribble(), mouth in (0.0..60.0, 0.0..60.0)) {
        let curves = |paths: Vec<Path>| paths.into_iter().map(|path| drawn("x", path)).collect();
        let cuts = if cuts.len() > 2 { curves(cuts) } else { Vec::new() };
        let all = Sketch { air: curves(air), seams: curves(seams), cuts, ports: vec![port(mouth.0, mouth.1)], ..Sketch::default() };
        for sketch in [Sketch { seams: vec![], ..all.clone() }, Sketch { air: vec![], ..all.clone() }, all] {
            match sealed_shape(&sketch, &RULES) {
                Ok(sealing) => {
                    let topology = sealing.shape.topology();
                    prop_assert_eq!(&topology.leaks, &[]);
                    prop_assert!(topology.chambers.iter().all(|chamber| !chamber.ports.is_empty()));
                    spares_the_bands(&sealing, 0.0)?;
                    spares_the_bands(&sealing, 0.7)?;
                }
                Err(faults) => prop_assert!(!faults.is_empty()),
            }
        }
    }
}
