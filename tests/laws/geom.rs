//! Lines and arcs under every motion: invariants hold, and distances agree with brute force.

use std::f64::consts::TAU;

use proptest::prelude::*;
use stargrip_cam::geom::{Arc, Isometry, Line, Point, Segment, Vec2, intersections, segment_distance};

use crate::shapes::{arc, blob, close, point, segment};

/// Points on each segment at which the brute force looks.
const SAMPLES: u32 = 200;

fn motion() -> impl Strategy<Value = Isometry> {
    (any::<bool>(), -7.0..7.0, -100.0..100.0, -100.0..100.0).prop_map(|(mirrored, rotation, x, y)| Isometry {
        mirrored,
        rotation,
        shift: Vec2::new(x, y),
    })
}

fn samples(segment: &Segment) -> impl Iterator<Item = Point> + '_ {
    (0..=SAMPLES).map(|i| segment.point(f64::from(i) / f64::from(SAMPLES)))
}

proptest! {
    #[test]
    fn a_motion_changes_no_measure((path, center) in blob(), motion in motion(), s in 0.0..1.0) {
        let moved = motion.path(&path);
        let sign = if motion.mirrored { -1.0 } else { 1.0 };
        close(moved.length(), path.length(), 1e-9)?;
        close(moved.area(), sign * path.area(), 1e-8)?;
        prop_assert!(moved.largest_gap() < 1e-11 && moved.closed);
        let turns = if motion.mirrored { -1 } else { 1 };
        prop_assert_eq!((path.winding_number(center), moved.winding_number(motion.point(center))), (1, turns));
        let distance = s * path.length();
        let (a, b) = (path.point_at(distance).unwrap(), moved.point_at(distance).unwrap());
        close(motion.point(a).distance(b), 0.0, 1e-9)?;
    }

    #[test]
    fn start_and_direction_change_no_measure((path, center) in blob(), s in -3.0..3.0) {
        let length = path.length();
        let shifted = path.starting_at(s * length);
        close(shifted.length(), length, 1e-9)?;
        close(shifted.area(), path.area(), 1e-8)?;
        prop_assert!(shifted.largest_gap() < 1e-9, "{}", shifted.largest_gap());
        let back = path.reversed();
        close(back.area(), -path.area(), 1e-9)?;
        prop_assert_eq!((shifted.winding_number(center), back.winding_number(center)), (1, -1));
        let distance = 0.3 * length;
        close(back.point_at(length - distance).unwrap().distance(path.point_at(distance).unwrap()), 0.0, 1e-9)?;
    }

    #[test]
    fn area_is_that_of_a_fine_polygon((path, _) in blob()) {
        let points: Vec<Point> = path.segments.iter().flat_map(|s| samples(s).collect::<Vec<_>>()).collect();
        let next = points.iter().cycle().skip(1);
        let area: f64 = points.iter().zip(next).map(|(a, b)| 0.5 * (a.x * b.y - a.y * b.x)).sum();
        close(path.area(), area, 0.01)?;
    }

    #[test]
    fn winding_counts_the_sheets_of_a_point((path, center) in blob(), angle in 0.0..TAU, reach in 0.0..3.0_f64) {
        // Star-shaped: a point is inside if the ray from the centre through it leaves beyond it.
        let p = center + Vec2::unit(angle) * (10.0 * reach);
        let ray = Line::new(center, center + Vec2::unit(angle) * 100.0).into();
        let exits: Vec<Point> = path.segments.iter().flat_map(|s| intersections(s, &ray)).collect();
        let exit = exits.iter().map(|q| q.distance(center)).fold(0.0_f64, f64::max);
        let margin: f64 = exit - 10.0 * reach;
        prop_assume!(!exits.is_empty() && margin.abs() > 1e-6);
        prop_assert_eq!(path.winding_number(p), i32::from(margin > 0.0));
        prop_assert_eq!(path.encloses(p), margin > 0.0);
    }

    #[test]
    fn parts_make_the_whole((path, _) in blob(), cuts in proptest::collection::vec(0.0..1.0, 1..6), first in -2.0..2.0) {
        let length = path.length();
        let mut cuts = cuts;
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        let station = |t: f64| (first + t) * length;
        let (mut sum, mut end_so_far) = (0.0, path.part(station(0.0), station(1.0)).start().unwrap());
        for pair in cuts.windows(2) {
            let part = path.part(station(pair[0]), station(pair[1]));
            close(part.length(), (pair[1] - pair[0]) * length, 1e-9)?;
            prop_assert!(part.largest_gap() < 1e-9);
            if let (Some(start), Some(end)) = (part.start(), part.end()) {
                close(start.distance(end_so_far), 0.0, 1e-8)?;
                end_so_far = end;
            }
            sum += part.length();
        }
        close(sum, length, 1e-8)?;
    }

    #[test]
    fn a_part_beyond_one_turn_repeats((path, _) in blob(), overlap in 0.0..0.5) {
        let length = path.length();
        let part = path.part(0.2 * length, (1.2 + overlap) * length);
        close(part.length(), (1.0 + overlap) * length, 1e-8)?;
        close(part.end().unwrap().distance(path.point_at((0.2 + overlap) % 1.0 * length).unwrap()), 0.0, 1e-8)?;
    }

    #[test]
    fn nearest_agrees_with_brute_force((path, center) in blob(), offset in point(30.0)) {
        let p = center + (offset - Point::ORIGIN);
        let nearest = path.nearest(p).unwrap();
        close(nearest.distance, path.distance(p), 1e-12)?;
        close(nearest.point.distance(p), nearest.distance, 1e-12)?;
        close(path.point_at(nearest.s).unwrap().distance(nearest.point), 0.0, 1e-9)?;
        for q in path.segments.iter().flat_map(|s| samples(s).collect::<Vec<_>>()) {
            prop_assert!(q.distance(p) >= nearest.distance - 1e-9);
        }
    }

    #[test]
    fn bounds_hold_the_segment_tightly(s in segment()) {
        let bounds = s.bounds();
        let bounds_with_slack = bounds.outset(1e-9);
        prop_assert!(samples(&s).all(|p| bounds_with_slack.contains(p)));
        let step = s.length() / f64::from(SAMPLES);
        for side in [bounds.min.x - 1.0, bounds.max.x + 1.0] {
            let nearest = samples(&s).map(|p| (p.x - side).abs()).fold(f64::INFINITY, f64::min);
            close(nearest, 1.0, step)?;
        }
        for side in [bounds.min.y - 1.0, bounds.max.y + 1.0] {
            let nearest = samples(&s).map(|p| (p.y - side).abs()).fold(f64::INFINITY, f64::min);
            close(nearest, 1.0, step)?;
        }
    }

    #[test]
    fn reversing_and_moving_a_segment(s in segment(), motion in motion(), t in 0.0..1.0) {
        let back = s.reversed();
        close(back.point(1.0 - t).distance(s.point(t)), 0.0, 1e-10)?;
        close((back.tangent(1.0 - t) + s.tangent(t)).length(), 0.0, 1e-9)?;
        close(motion.segment(&s).point(t).distance(motion.point(s.point(t))), 0.0, 1e-10)?;
        let part = s.part(0.25 * t, t);
        close(part.start().distance(s.point(0.25 * t)), 0.0, 1e-10)?;
        close(part.end().distance(s.point(t)), 0.0, 1e-10)?;
    }

    #[test]
    fn bulge_there_and_back(arc in arc()) {
        prop_assume!(arc.start().distance(arc.end()) > 1e-3 * arc.radius);
        let rebuilt = Arc::from_bulge(arc.start(), arc.end(), arc.bulge()).unwrap();
        close(rebuilt.sweep, arc.sweep, 1e-9)?;
        close(rebuilt.radius, arc.radius, 1e-9 * arc.radius.max(1.0))?;
        close(rebuilt.center.distance(arc.center), 0.0, 1e-8 * arc.radius.max(1.0))?;
    }

    #[test]
    fn intersections_lie_on_both_and_are_symmetrical(a in segment(), b in segment()) {
        let (forth, back) = (intersections(&a, &b), intersections(&b, &a));
        for p in &forth {
            close(a.distance(*p).max(b.distance(*p)), 0.0, 1e-6)?;
            let distance = back.iter().map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min);
            close(distance, 0.0, 1e-6)?;
        }
        prop_assert_eq!(forth.len(), back.len());
    }

    #[test]
    fn a_change_of_sides_is_an_intersection(a in segment(), b in arc()) {
        // Where the samples of `a` change from inside to outside the circle, they cross it; on the arc or not.
        let circle = Arc { sweep: TAU, ..b }.into();
        let is_inside: Vec<bool> = samples(&a).map(|p| p.distance(b.center) < b.radius).collect();
        let changes = is_inside.windows(2).filter(|pair| pair[0] != pair[1]).count();
        prop_assert!(intersections(&a, &circle).len() >= changes);
    }

    #[test]
    fn segment_distance_agrees_with_brute_force(a in segment(), b in segment()) {
        let distance = segment_distance(&a, &b);
        close(distance, segment_distance(&b, &a), 1e-9)?;
        let brute = samples(&a).map(|p| b.distance(p)).fold(f64::INFINITY, f64::min);
        prop_assert!(distance <= brute + 1e-9, "{} > {}", distance, brute);
        // Between two samples the distance falls by at most half a step.
        let step = a.length() / f64::from(SAMPLES);
        prop_assert!(brute <= distance + 0.5 * step + 1e-9, "{} << {}", distance, brute);
    }
}
