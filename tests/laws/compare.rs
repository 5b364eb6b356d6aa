//! The comparers on random shapes: silent on a faithful file, and right about how wrong a spoilt one is.

use proptest::prelude::*;
use stargrip_cam::geom::{Arc, Isometry, Line, Path, Point, Segment, Vec2};
use stargrip_cam::verify::{deviation, follow};

use crate::shapes::blob;

/// Largest error by rounding to 0.001 mm: half the diagonal of its cell, and as much again for the middle of an arc.
const ROUNDING: f64 = 0.0015;

/// The path as moves of at most 2 mm with end points rounded to 0.001 mm.
fn moves(path: &Path) -> Vec<Segment> {
    let round = |p: Point| Point::new((p.x * 1e3).round() / 1e3, (p.y * 1e3).round() / 1e3);
    let mut run = Vec::new();
    for segment in &path.segments {
        let mut t = 0.0;
        let step = 1.0 / (segment.length() / 2.0).ceil();
        while t < 1.0 - 0.5 * step {
            let part = segment.part(t, t + step);
            let (a, b) = (round(part.start()), round(part.end()));
            let arc = match part {
                Segment::Line(_) => None,
                Segment::Arc(arc) => Arc::from_bulge(a, b, arc.bulge()),
            };
            if a != b {
                run.push(arc.map_or_else(|| Line::new(a, b).into(), Segment::Arc));
            }
            t += step;
        }
    }
    run
}

/// One turn and an overlap, from somewhere.
fn seam() -> impl Strategy<Value = (Path, f64)> {
    (blob(), 0.0..1.0, 0.1..0.5, any::<bool>()).prop_map(|((path, _), start, overlap, back)| {
        let path = if back { path.reversed() } else { path };
        let length = path.length();
        (path.part(start * length, (1.0 + start + overlap) * length), length)
    })
}

proptest! {
    #[test]
    fn a_faithful_run_is_followed_to_its_end((exact, _) in seam()) {
        let walk = follow(&moves(&exact), &exact);
        prop_assert!(walk.largest() < ROUNDING, "{walk:?}");
        prop_assert!(walk.start < 0.002 && walk.exact_length - walk.end < 0.002, "{walk:?}");
        prop_assert!(walk.backwards.is_none_or(|(by, _)| by < 0.002), "{walk:?}");
        prop_assert!(walk.jump.is_none_or(|(gap, _)| gap < 1e-9), "{walk:?}");
    }

    #[test]
    fn a_missing_overlap_is_measured((exact, turn) in seam(), share in 0.0..1.0_f64) {
        let run = moves(&exact.part(0.0, turn + share * (exact.length() - turn)));
        let walk = follow(&run, &exact);
        let missing = (1.0 - share) * (exact.length() - turn);
        prop_assert!(f64::abs(walk.exact_length - walk.end - missing) < 0.01, "{missing}: {walk:?}");
    }

    #[test]
    fn a_moved_vertex_is_measured((exact, _) in seam(), place in 0.1..0.9, shift in 0.01..0.5, angle in 0.0..6.0) {
        let mut run = moves(&exact);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number >= 0")]
        let i = (place * f64::from(u32::try_from(run.len()).unwrap())) as usize;
        let moved = run[i].start() + Vec2::unit(angle) * shift;
        run[i - 1] = Line::new(run[i - 1].start(), moved).into();
        run[i] = Line::new(moved, run[i].end()).into();
        let truth = exact.distance(moved);
        prop_assume!(truth > 0.1 * shift);
        let walk = follow(&run, &exact);
        prop_assert!(walk.file_to_exact > truth - 1e-6, "{truth}: {walk:?}");
        // Chords instead of flat arcs of 2 mm cost up to 0.2 mm more.
        prop_assert!(walk.largest() < shift + 0.2, "{shift}: {walk:?}");
    }

    #[test]
    fn a_missing_or_reversed_move_is_noticed((exact, _) in seam(), place in 0.1..0.9) {
        let run = moves(&exact);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number >= 0")]
        let i = (place * f64::from(u32::try_from(run.len()).unwrap())) as usize;
        let length = run[i].start().distance(run[i].end());
        let mut cut = run.clone();
        let _ = cut.remove(i);
        prop_assert!(follow(&cut, &exact).jump.is_some_and(|(gap, k)| k == i && (gap - length).abs() < 1e-9));
        let mut turned = run;
        turned[i] = turned[i].reversed();
        let walk = follow(&turned, &exact);
        prop_assert!(walk.jump.is_some_and(|(gap, _)| (gap - length).abs() < 1e-9), "{walk:?}");
        prop_assert!(walk.backwards.is_some_and(|(by, k)| k == i && (by - length).abs() < 0.03), "{walk:?}");
    }

    #[test]
    fn deviation_measures_a_shift((path, _) in blob(), x in -0.5..0.5, y in -0.5..0.5, start in 0.0..1.0) {
        let shift = Vec2::new(x, y);
        let file = Isometry::translation(shift).path(&path.starting_at(start * path.length()).reversed());
        let d = deviation(&[file], std::slice::from_ref(&path));
        prop_assert!(d.largest() <= shift.length() + 1e-9, "{d:?}");
        // Some side of a closed curve faces the shift by at least 60 degrees.
        prop_assert!(d.largest() >= 0.4 * shift.length(), "{} {d:?}", shift.length());
        prop_assert!((d.file_length - d.exact_length).abs() < 1e-8 && d.file_closed == 1);
    }

    #[test]
    fn deviation_is_blind_to_start_and_direction_only((path, _) in blob(), start in 0.0..1.0, cut in 0.01..0.2_f64) {
        let length = path.length();
        let equal_path = deviation(&[path.starting_at(start * length).reversed()], std::slice::from_ref(&path));
        prop_assert!(equal_path.largest() < 1e-9 && equal_path.largest_gap < 1e-9, "{equal_path:?}");
        let open = deviation(&[path.part(start * length, (start + 1.0 - cut) * length)], std::slice::from_ref(&path));
        prop_assert!(open.exact_to_file > 0.0 && open.file_closed == 0);
        prop_assert!(f64::abs(open.exact_length - open.file_length - cut * length) < 1e-8);
    }
}
