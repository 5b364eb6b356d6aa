//! The unordered comparer: how far two sets of paths lie apart, whatever their order and direction.

use crate::verify::judge::path::measure::{Farthest, Prepared, furthest};
use crate::verify::read::drawing::JOIN;
use geom::{Bounds, BoxIndex, Path, Point};

/// So few targets are measured all at once.
const FEW: usize = 6;

/// Most halvings of one segment: pieces of 2 m become 2 mm long, far shorter than drawn ones.
const HALVINGS: u32 = 10;

/// The difference of a file's paths from the exact ones. Distances alone do not show a path drawn twice: the lengths do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Largest distance from a point of the file to the exact geometry; infinite if that is empty.
    pub file_to_exact: f64,
    /// Largest distance from a point of the exact geometry to the file; infinite if that is empty.
    pub exact_to_file: f64,
    /// The place of the larger of the two.
    pub at: Point,
    /// Total length in the file.
    pub file_length: f64,
    /// Total length of the exact geometry.
    pub exact_length: f64,
    /// Number of paths in the file.
    pub file_count: usize,
    /// Number of exact paths.
    pub exact_count: usize,
    /// Number of closed paths in the file: declared closed, or with their ends together.
    pub file_closed: usize,
    /// Number of exact paths that are closed.
    pub exact_closed: usize,
    /// Largest gap between neighbouring segments of a path in the file, at the seam of the closed ones too.
    pub largest_gap: f64,
}

impl Deviation {
    /// The larger of the distances both ways.
    pub fn largest(&self) -> f64 {
        self.file_to_exact.max(self.exact_to_file)
    }
}

/// Compares the paths of a file with the exact ones.
///
/// The distances are exact to rounding for lines and arcs (extremes are computed, not sampled).
pub fn deviation(file: &[Path], exact: &[Path]) -> Deviation {
    let (from_file, from_exact) = (Prepared::prepare_all(file), Prepared::prepare_all(exact));
    let forth = directed(&from_file, &from_exact);
    let back = directed(&from_exact, &from_file);
    Deviation {
        file_to_exact: forth.distance,
        exact_to_file: back.distance,
        at: forth.max(back).at,
        file_length: file.iter().map(Path::length).sum(),
        exact_length: exact.iter().map(Path::length).sum(),
        file_count: file.len(),
        exact_count: exact.len(),
        file_closed: file.iter().filter(|path| is_closed(path)).count(),
        exact_closed: exact.iter().filter(|path| is_closed(path)).count(),
        largest_gap: file.iter().map(Path::largest_gap).fold(0.0, f64::max),
    }
}

fn directed(probes: &[Prepared], targets: &[Prepared]) -> Farthest {
    let index = BoxIndex::new(targets.iter().map(|target| target.bounds));
    let (mut candidates, mut scratch) = (Vec::new(), Vec::new());
    let mut worst = Farthest::default();
    for probe in probes {
        let reach = zone(probe, |p| index.least_distance(p, |number| targets[number].distance(p)));
        candidates.clear();
        candidates.extend(index.overlapping(&reach).into_iter().map(|number| &targets[number]));
        worst = worst.max(by_halves(probe, &candidates, targets.len(), HALVINGS, &mut scratch));
    }
    worst
}

/// The region that reaches the nearest target of any point of the probe: distance has a slope of at most 1.
fn zone(probe: &Prepared, nearest: impl Fn(Point) -> f64) -> Bounds {
    probe.bounds.outset(nearest(probe.start).max(nearest(probe.end)) + 0.5 * probe.length)
}

/// As [`furthest`], with the probe halved until few targets can be near a piece.
fn by_pieces(probe: &Prepared, targets: &[&Prepared], halvings: u32, scratch: &mut Vec<f64>) -> Farthest {
    if targets.len() <= FEW || halvings == 0 {
        return furthest(probe, targets, scratch);
    }
    let reach = zone(probe, |p| targets.iter().map(|t| t.distance(p)).fold(f64::INFINITY, f64::min));
    let candidates: Vec<&Prepared> = targets.iter().copied().filter(|t| t.bounds.overlaps(&reach)).collect();
    by_halves(probe, &candidates, targets.len(), halvings, scratch)
}

/// As [`by_pieces`], of the `candidates` ones among `total` targets.
fn by_halves(
    probe: &Prepared,
    candidates: &[&Prepared],
    total: usize,
    halvings: u32,
    scratch: &mut Vec<f64>,
) -> Farthest {
    if candidates.len() <= FEW {
        return furthest(probe, candidates, scratch);
    }
    // Where halving does not reduce the targets (many copies of one line), it ends early.
    let rest = halvings.saturating_sub(if candidates.len() < total { 1 } else { 4 });
    let halves = [(0.0, 0.5), (0.5, 1.0)].map(|(start, end)| Prepared::new(probe.segment.part(start, end)));
    let [first, second] = halves.map(|half| by_pieces(&half, candidates, rest, scratch));
    first.max(second)
}

fn is_closed(path: &Path) -> bool {
    let ends = path.start().zip(path.end());
    !path.segments.is_empty() && (path.closed || ends.is_some_and(|(a, b)| a.distance(b) <= JOIN))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use geom::{Arc, Isometry, Line, Segment, Vec2};

    fn line(a: (f64, f64), b: (f64, f64)) -> Segment {
        Line::new(Point::new(a.0, a.1), Point::new(b.0, b.1)).into()
    }

    /// A stadium: two lines and two half circles.
    fn stadium(r: f64, l: f64) -> Path {
        Path::closed(vec![
            line((0.0, -r), (l, -r)),
            Arc::new(Point::new(l, 0.0), r, -PI / 2.0, PI).into(),
            line((l, r), (0.0, r)),
            Arc::new(Point::ORIGIN, r, PI / 2.0, PI).into(),
        ])
    }

    fn assert_near(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-9 * (1.0 + b.abs()), "{a} is not {b}");
    }

    #[test]
    fn finds_nothing_where_nothing_is() {
        for r in [0.01, 1.0, 30.0, 2000.0] {
            let exact = stadium(r, 3.0 * r);
            for file in
                [exact.clone(), exact.reversed(), exact.starting_at(r), exact.part(0.0, exact.length())]
            {
                let d = deviation(&[file], std::slice::from_ref(&exact));
                assert!(d.largest() <= 1e-12 * r.max(1.0), "{d:?}");
                assert_near(d.file_length, d.exact_length);
                assert_eq!((d.file_closed, d.exact_closed), (1, 1));
            }
        }
    }

    #[test]
    fn measures_a_shift() {
        let exact = stadium(20.0, 60.0);
        for shift in [1e-6, 1e-3, 0.5] {
            let moved = Isometry::translation(Vec2::new(shift, 0.0)).path(&exact);
            let d = deviation(&[moved], std::slice::from_ref(&exact));
            assert_near(d.file_to_exact, shift);
            assert_near(d.exact_to_file, shift);
        }
    }

    #[test]
    fn measures_a_radius_between_the_ends() {
        // Same end points, bulge changed: only the arc's middle is off, by the change of its sagitta.
        for sweep in [170.0_f64, 180.0, 190.0, 10.0] {
            let exact = Arc::new(Point::new(3.0, 4.0), 25.0, 0.3, sweep.to_radians());
            let bulge = exact.bulge() * 1.0001;
            let file = Arc::from_bulge(exact.start(), exact.end(), bulge).unwrap();
            let chord = exact.start().distance(exact.end());
            let sagitta = 0.5 * chord * (bulge - exact.bulge());
            let d = deviation(&[Path::open(vec![file.into()])], &[Path::open(vec![exact.into()])]);
            assert!((d.file_to_exact - sagitta).abs() < 1e-3 * sagitta, "{sweep}: {d:?} against {sagitta}");
        }
    }

    #[test]
    fn measures_a_chord_and_a_cut_corner() {
        let r = 10.0;
        let exact = Path::open(vec![Arc::new(Point::ORIGIN, r, 0.0, 1.0).into()]);
        let chord = Path::open(vec![Line::new(exact.start().unwrap(), exact.end().unwrap()).into()]);
        let d = deviation(&[chord], &[exact]);
        assert_near(d.file_to_exact, r * (1.0 - 0.5_f64.cos()));
        assert_near(d.exact_to_file, r * (1.0 - 0.5_f64.cos()));

        let corner = Path::open(vec![line((-2.0, 0.0), (0.0, 0.0)), line((0.0, 0.0), (0.0, 2.0))]);
        let cut = Path::open(vec![
            line((-2.0, 0.0), (-1.5, 0.0)),
            line((-1.5, 0.0), (0.0, 0.5)),
            line((0.0, 0.5), (0.0, 2.0)),
        ]);
        let d = deviation(&[cut], &[corner]);
        // On the cut, y = -x where both legs are equally far: x = -0.375.
        assert!((d.file_to_exact - 0.375).abs() < 1e-6, "{d:?}");
        assert_near(d.exact_to_file, 1.5 * 0.5 / 1.5_f64.hypot(0.5));
    }

    #[test]
    fn notices_what_is_missing_doubled_or_extra() {
        let exact = stadium(20.0, 60.0);
        let cut = exact.part(5.0, exact.length());
        let d = deviation(&[cut], std::slice::from_ref(&exact));
        assert_near(d.exact_to_file, 2.5);
        assert!(d.file_closed == 0 && d.file_to_exact < 1e-12);

        let d = deviation(&[exact.clone(), exact.clone()], std::slice::from_ref(&exact));
        assert_eq!((d.file_count, d.exact_count), (2, 1));
        assert_near(d.file_length, 2.0 * d.exact_length);

        let circle = Path::closed(vec![Arc::new(Point::new(30.0, 0.0), 3.0, 0.0, TAU).into()]);
        let d = deviation(&[exact.clone(), circle], std::slice::from_ref(&exact));
        assert_near(d.file_to_exact, 20.0);
        assert!(d.exact_to_file < 1e-12);
    }

    #[test]
    fn empty_sets_are_infinitely_far() {
        let exact = stadium(1.0, 1.0);
        assert_eq!(deviation(&[], std::slice::from_ref(&exact)).exact_to_file, f64::INFINITY);
        assert_eq!(deviation(std::slice::from_ref(&exact), &[]).file_to_exact, f64::INFINITY);
        assert_eq!(deviation(&[], &[]).largest(), 0.0);
    }
}
