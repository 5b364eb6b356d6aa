//! The geometry of the star against its exact relations.

use std::f64::consts::PI;

use proptest::prelude::*;

use stargrip_cam::design::{Channel, Design, Outline, Part, RefusalCode, Side, Star, StarDesign, cut_area};
use stargrip_cam::geom::{Isometry, Path, Point, Segment, path_distance, path_intersections};
use stargrip_cam::spec::{Inlet, StarSpec, key};
use stargrip_cam::units::Length;
use stargrip_cam::verify::deviation;

use crate::support;
use crate::support::Shape;

fn star_spec(shape: &Shape) -> StarSpec {
    support::read(&shape.toml()).stars.remove(0)
}

fn star_of(shape: &Shape) -> Star {
    Star::new(&star_spec(shape)).expect("a star with arms")
}

fn paper(n: u32) -> StarSpec {
    StarSpec { points: n, ..support::read(support::PAPER).stars.remove(0) }
}

/// Points along a path, seven on every segment.
fn samples(path: &Path) -> impl Iterator<Item = Point> + '_ {
    path.segments.iter().flat_map(|segment| (0..7).map(|i| segment.point(f64::from(i) / 6.0)))
}

/// Pairs of segments of one path that are not neighbours must not touch.
fn is_simple(path: &Path) -> bool {
    let n = path.segments.len();
    (0..n).all(|i| {
        (i + 2..n).filter(|j| !(path.closed && i == 0 && *j == n - 1)).all(|j| {
            let single = |k: usize| Path::open(vec![path.segments[k]]);
            path_intersections(&single(i), &single(j)).is_empty()
        })
    })
}

/// Arm lengths of the paper's stars (rho_0 = 50 mm, W = 30 mm, phi_i0 = 30 deg, sharp hinges).
#[test]
fn the_papers_stars_have_the_papers_arms() {
    for (n, l) in [(3, 155.72), (4, 106.60), (5, 69.72), (6, 42.59), (7, 22.15), (8, 6.32)] {
        let star = Star::new(&paper(n)).expect("a star");
        assert!((star.l - l).abs() < 0.005, "n = {n}: {}", star.l);
    }
    let refusal = Star::new(&paper(9)).expect_err("no arms are left");
    assert!(refusal.found.ends_with("the arms would be -6.2 mm long"), "{refusal}");
    assert!(
        refusal.remedy.starts_with("must be: points at most 8; or alone: inner_radius above "),
        "{refusal}"
    );
}

#[test]
fn a_straight_corner_is_refused() {
    let spec = StarSpec { tip_angle: stargrip_cam::units::Angle(108.0), ..paper(5) };
    let refusal = Star::new(&spec).expect_err("phi_e = 180 deg");
    assert_eq!((refusal.code, refusal.key), (RefusalCode::StraightCorner, key::star::TIP_ANGLE));
    assert!(refusal.remedy.contains("below 108 deg"), "{}", refusal.remedy);
}

#[test]
fn a_number_of_points_is_not_promised_where_none_fits() {
    let spec = StarSpec { inner_radius: stargrip_cam::units::Length(0.01), ..paper(5) };
    let refusal = Star::new(&spec).expect_err("no arms");
    assert!(!refusal.remedy.contains("points at most"), "{}", refusal.remedy);
}

/// Tips on the rays (2k - 1) pi/n, corners on the rays 2 (k - 1) pi/n, corner 1 on +X and nearest to the axis.
#[test]
fn hinges_lie_on_their_rays() {
    let star = Star::new(&paper(5)).expect("a star");
    let inner = star.contour(Side::Hole, 0.0, 0.0).expect("a hole").path();
    let nearest = inner.nearest(Point::ORIGIN).expect("a path");
    assert!((nearest.distance - 50.0).abs() < 1e-12);
    for k in 1..=5 {
        let corner = Point::polar(50.0, star.corner_ray(k));
        assert!(inner.distance(corner) < 1e-12);
        let tip = Point::polar(star.tip_reach(), star.tip_ray(k));
        assert!(star.contour(Side::Outside, 0.0, 0.0).expect("a tube").path().distance(tip) < 1e-12);
    }
    assert_eq!(star.corner_ray(1), 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Area of the tube: two rectangles a sector and two annulus sectors.
    #[test]
    fn the_tube_has_the_area_of_its_parts(shape in support::shapes()) {
        let star = star_of(&shape);
        let area = |side| star.contour(side, 0.0, 0.0).expect("an edge").path().area();
        let ring = |r: f64, phi: f64| 0.5 * (PI - phi) * ((r + star.w).powi(2) - r * r);
        let sector = 2.0 * star.l * star.w + ring(star.r_i, star.phi_i) + ring(star.r_e, star.phi_e);
        let exact = f64::from(star.n) * sector;
        let area_between = area(Side::Outside) - area(Side::Hole);
        prop_assert!((area_between - exact).abs() <= 1e-10 * area(Side::Outside), "{area_between} {exact}");
    }

    /// The closed form of the cut's area is the area of the outline that is drawn, ears and inlet included.
    #[test]
    fn the_closed_form_of_the_cut_is_the_outlines(
        shape in support::shapes(),
        flaps in (0.01..0.3_f64, 0.0..0.5_f64, 0.0..0.3_f64),
        hole in prop_oneof![Just(0.0), 0.001..0.3_f64],
        inlet in prop::option::of((0.05..0.5_f64, 0.5..3.0_f64, 0.0..0.5_f64)),
    ) {
        let star = star_of(&shape);
        let w = |part: f64| Length(part * star.w);
        let mut seal = support::read(support::PAPER).seal;
        (seal.band, seal.allowance, seal.hole_allowance) = (w(flaps.0), w(flaps.1), w(flaps.2));
        let inlet = inlet.map(|(d, length, fillet)| Inlet {
            tube_diameter: w(d),
            length: w(length),
            fillet: w(fillet),
        });
        let channel = inlet.as_ref().map(|inlet| Channel::new(&star, inlet, 2));
        let outline_area = Outline::new(&star, channel.as_ref(), 2, &seal, w(hole).0).ok().map(|outline| outline.area());
        let closed_form = cut_area(&star, &seal, inlet.as_ref(), 2, w(hole).0);
        prop_assert_eq!(closed_form.is_some(), outline_area.is_some());
        if let Some((closed_form, outline_area)) = closed_form.zip(outline_area) {
            // The numbers are as large as the square around the star.
            prop_assert!((closed_form - outline_area).abs() <= 1e-11 * star.tip_reach().powi(2), "{} {}", closed_form, outline_area);
        }
    }

    /// The two edges are W apart everywhere.
    #[test]
    fn the_edges_are_a_tube_width_apart(shape in support::shapes()) {
        let star = star_of(&shape);
        let edge = |side| star.contour(side, 0.0, 0.0).expect("an edge").path();
        let (inner, outer) = (edge(Side::Hole), edge(Side::Outside));
        let size = star.tip_reach();
        for (from, to) in [(&inner, &outer), (&outer, &inner)] {
            for p in samples(from) {
                prop_assert!((to.distance(p) - star.w).abs() <= 1e-10 * size);
            }
        }
    }

    /// Every point of a contour is delta from the edge, trimmed or not; it is closed, simple and counterclockwise.
    #[test]
    fn a_contour_keeps_its_distance(shape in support::shapes(), fraction in 0.001..3.0_f64, hole in any::<bool>()) {
        let star = star_of(&shape);
        let side = if hole { Side::Hole } else { Side::Outside };
        let delta = fraction * star.w;
        let edge = star.contour(side, 0.0, 0.0).expect("an edge").path();
        let Some(contour) = star.contour(side, delta, 0.0) else {
            prop_assert!(hole && delta >= star.rho_0 * (1.0 - 1e-12), "only a filled hole has no contour");
            return Ok(());
        };
        let path = contour.path();
        let size = star.tip_reach() + delta;
        prop_assert!(path.largest_gap() <= 1e-10 * size);
        prop_assert!(path.area() > 0.0);
        prop_assert!(is_simple(&path));
        for p in samples(&path) {
            prop_assert!((edge.distance(p) - delta).abs() <= 1e-9 * size, "{} instead of {delta}", edge.distance(p));
        }
        prop_assert_eq!(path.area() < edge.area(), hole);
    }

    /// The realised edge has no concave hinge sharper than requested, and leaves the arms where they are.
    #[test]
    fn a_realised_edge_is_as_round_as_the_iron(shape in support::shapes(), fraction in 0.001..0.2_f64) {
        let star = star_of(&shape);
        let smallest_radius = fraction * star.w;
        for side in [Side::Hole, Side::Outside] {
            let Some(realised) = star.contour(side, 0.0, smallest_radius) else { continue };
            let plain_edge = star.contour(side, 0.0, 0.0).expect("an edge").path();
            for (part, segment) in realised.parts {
                match segment {
                    Segment::Arc(arc) => prop_assert!(arc.radius >= smallest_radius * (1.0 - 1e-12)),
                    Segment::Line(_) => {
                        prop_assert!(matches!(part, Part::Arm(_)));
                        prop_assert!(plain_edge.distance(segment.point(0.5)) <= 1e-10 * star.tip_reach());
                    }
                }
            }
        }
    }

    /// Scaled star, scaled contours: nothing in the geometry has a length of its own.
    #[test]
    fn geometry_scales(shape in support::shapes(), scale in 0.01..100.0_f64) {
        let Shape { n, phi_i, w, l, r_i, r_e } = shape;
        let large = Shape { n, phi_i, w: w * scale, l: l * scale, r_i: r_i * scale, r_e: r_e * scale };
        prop_assume!(large.w <= 5e4 && large.rho_0() <= 9e4 && large.r_i <= 1e5 && large.r_e <= 1e5);
        let small = star_of(&shape);
        // The largest are refused as too large.
        let Ok(large) = Star::new(&star_spec(&large)) else { return Ok(()) };
        for side in [Side::Hole, Side::Outside] {
            let length = |star: &Star| star.contour(side, 0.1 * star.w, 0.0).map(|contour| contour.path().length());
            if let (Some(a), Some(b)) = (length(&small), length(&large)) {
                prop_assert!((a * scale - b).abs() <= 1e-8 * b);
            }
        }
    }

    /// Whatever a design draws keeps its distances: bands, cuts, holes; and the registration fits one way only.
    #[test]
    fn a_design_keeps_its_parts_apart(shape in support::shapes(), inlet in any::<bool>(), tip in 1_u32..=3) {
        let inlet = if inlet { format!("[inlet]\ntip = {tip}\n") } else { "[inlet]\nnone = true\n".to_owned() };
        let spec = support::read(&(shape.toml() + &inlet));
        let Ok(design) = Design::new(&spec, &support::machine()) else { return Ok(()) };
        let part = &design.assembly().expect("stars").distinct[0];
        let outline = &part.outline;
        let half_band = part.shape.band / 2.0;
        prop_assert!(is_simple(&outline.outside) && is_simple(&outline.hole));
        prop_assert!(outline.outside.largest_gap() < 1e-9 * part.star.tip_reach());
        let [inner, outer] = &part.shape.seams[..] else { panic!("two seams") };
        prop_assert!(path_distance(&inner.center_line, &outline.hole) >= half_band + 1.0 - 1e-6);
        // The bands of an inlet cross the cut at the mouth; elsewhere the flap has the requested width.
        if part.channel.is_none() {
            prop_assert!(path_distance(&outer.center_line, &outline.outside) >= half_band + 8.0 - 1e-6);
        } else {
            prop_assert_eq!(path_intersections(&outer.center_line, &outline.outside).len(), 2);
        }
        prop_assert!(path_distance(&inner.center_line, &outer.center_line) >= part.star.w + part.shape.band - 1e-6);
        for hole in &outline.registration {
            let r = hole.diameter / 2.0;
            prop_assert!(outline.outside.encloses(hole.center));
            prop_assert!(outline.outside.distance(hole.center) >= 2.0 * r - 1e-6, "too near the cut");
            prop_assert!(outer.center_line.distance(hole.center) >= r + half_band + part.shape.band - 1e-6, "too near a band");
        }
        let misfit = least_misfit(part);
        prop_assert!(misfit > 3.0, "the pattern also fits another way, to {misfit} mm");
    }
}

proptest! {
    // The comparer looks at every pair of segments, which are thousands for the largest stars.
    #![proptest_config(ProptestConfig { cases: 30, failure_persistence: None, ..ProptestConfig::default() })]

    /// Turned by a sector, and mirrored, a contour is itself.
    #[test]
    fn a_contour_has_the_symmetry_of_the_star(shape in support::shapes(), fraction in 0.0..1.0_f64, turns in 1_u32..64) {
        let star = star_of(&shape);
        for side in [Side::Hole, Side::Outside] {
            let Some(contour) = star.contour(side, fraction * star.w, 0.0) else { continue };
            let path = contour.path();
            let turn = Isometry::rotation(f64::from(turns) * 2.0 * star.half_sector());
            for motion in [turn, Isometry::mirror()] {
                let deviation_turned = deviation(&[motion.path(&path)], std::slice::from_ref(&path)).largest();
                prop_assert!(deviation_turned <= 1e-9 * star.tip_reach(), "{deviation_turned}");
            }
        }
    }
}

/// The smallest distance by which the registration holes miss, over all ways but one to lay the star on itself.
fn least_misfit(part: &StarDesign) -> f64 {
    let holes: Vec<Point> = part.outline.registration.iter().map(|hole| hole.center).collect();
    let sector = 2.0 * part.star.half_sector();
    let mut smallest = f64::INFINITY;
    for k in 0..part.star.n {
        for mirrored in [false, true] {
            if k == 0 && !mirrored {
                continue;
            }
            let motion = Isometry { mirrored, rotation: f64::from(k) * sector, ..Isometry::IDENTITY };
            let nearest =
                |p: Point| holes.iter().map(|q| q.distance(motion.point(p))).fold(f64::INFINITY, f64::min);
            smallest = smallest.min(holes.iter().map(|p| nearest(*p)).fold(0.0, f64::max));
        }
    }
    smallest
}
