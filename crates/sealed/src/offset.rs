//! Closed paths of lines and arcs, offset exactly.

use cavalier_contours::polyline::{PlineOffsetOptions, PlineSource, PlineSourceMut, Polyline};

use geom::{Arc, BoxIndex, Line, Path, Point, Segment};

/// Distance below which positions are one, and by how much a point of an offset may be nearer to its path than the distance, mm.
/// The first is above the rounding of coordinates of metres. A file states lines and arcs that touch to its own decimals, so that
/// with the first their offsets may miss each other or cross far away: then the next are taken.
pub(super) const SLACKS: [(f64, f64); 4] = [(1e-9, 1e-8), (1e-7, 1e-6), (1e-6, 1e-5), (1e-5, 1e-4)];
/// A point of an offset is at its distance to this, mm.
const SOUND: f64 = 2e-4;

/// Segments shorter than this have no length, mm.
const SAME: f64 = 1e-9;
/// Neighbours that differ by less from one line or circle are one segment, mm: below the largest gap of a seam.
const ALIKE: f64 = 1e-10;

/// The closed paths at `by` mm to the right of the closed `path`: lines and arcs, round at corners that turn left, trimmed at those
/// that turn right. None where nothing is left; several where it falls apart.
pub fn offset_right(path: &Path, by: f64) -> Vec<Path> {
    if by == 0.0 {
        return vec![path.clone()];
    }
    let line = polyline(path);
    let offset = |(same, slack)| -> Vec<Path> {
        let options =
            PlineOffsetOptions { pos_equal_eps: same, offset_dist_eps: slack, ..PlineOffsetOptions::new() };
        let loops = line.parallel_offset_opt(-by, &options);
        loops.iter().map(of_polyline).map(|path| merged(&path)).collect()
    };
    let index = BoxIndex::new(path.segments.iter().map(Segment::bounds));
    let far = |p: Point| index.least(p, |number| path.segments[number].distance(p));
    let sound = |loops: &Vec<Path>| is_sound(path, by, loops, &far);
    SLACKS.into_iter().map(offset).find(sound).unwrap_or_else(|| offset(SLACKS[0]))
}

/// Whether `loops` lie at `by` from the closed `path` all along, and wherever they can. `far` is the distance from the path.
fn is_sound(path: &Path, by: f64, loops: &[Path], far: &impl Fn(Point) -> f64) -> bool {
    let off = by.abs();
    let segments: Vec<&Segment> = loops.iter().flat_map(|line| &line.segments).collect();
    let on_loops = BoxIndex::new(segments.iter().map(|segment| segment.bounds()));
    let is_at = |segment: &&Segment| (far(segment.point(0.5)) - off).abs() <= SOUND;
    let is_met = |segment: &Segment| {
        let p = segment.point(0.5) - segment.tangent(0.5).perp() * by;
        // A stretch that is nearer to another one is trimmed.
        far(p) < off - 1e-7 || on_loops.least(p, |number| segments[number].distance(p)) <= SOUND
    };
    let length: f64 = loops.iter().map(Path::length).sum();
    let is_line = |line: &Path| line.length() > 10.0 * SOUND;
    length <= path.length() + std::f64::consts::TAU * off + SOUND
        && loops.iter().all(is_line)
        && segments.iter().all(is_at)
        && path.segments.iter().all(is_met)
}

/// A path as vertices and bulges, arcs above half a turn in two.
pub fn polyline(path: &Path) -> Polyline<f64> {
    let mut line: Polyline<f64> = Polyline::new_closed();
    for segment in &path.segments {
        // A bulge can express up to half a turn.
        let pieces = match segment {
            Segment::Arc(arc) if arc.sweep.abs() > 3.0 => 2,
            _ => 1,
        };
        for i in 0..pieces {
            let part = segment.part(f64::from(i) / f64::from(pieces), f64::from(i + 1) / f64::from(pieces));
            let bulge = if let Segment::Arc(arc) = part { arc.bulge() } else { 0.0 };
            let start = part.start();
            line.add(start.x, start.y, bulge);
        }
    }
    line
}

/// Vertices and bulges as a closed path.
pub fn of_polyline(line: &Polyline<f64>) -> Path {
    let segments = line.iter_segments().map(|(a, b)| {
        let (from, to) = (Point::new(a.x, a.y), Point::new(b.x, b.y));
        Arc::from_bulge(from, to, a.bulge).map_or_else(|| Line::new(from, to).into(), Segment::from)
    });
    Path::closed(segments.collect())
}

/// The path with neighbours on one line or one circle as one segment, and without segments of no length.
pub(super) fn merged(path: &Path) -> Path {
    let mut segments: Vec<Segment> = Vec::with_capacity(path.segments.len());
    for segment in path.segments.iter().filter(|segment| segment.length() > SAME) {
        match segments.last().and_then(|last| joined(last, segment)) {
            Some(both) => {
                let _ = segments.pop();
                segments.push(both);
            }
            None => segments.push(*segment),
        }
    }
    if path.closed
        && segments.len() > 2
        && let Some(both) = joined(&segments[segments.len() - 1], &segments[0])
    {
        let _ = segments.pop();
        segments[0] = both;
    }
    Path { segments, closed: path.closed }
}

/// Two neighbours as one segment, if they are one to `SAME`.
fn joined(a: &Segment, b: &Segment) -> Option<Segment> {
    match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => {
            let both = Line::new(a.start, b.end);
            let bend = both.direction().cross(a.end - a.start).abs();
            let onward = a.direction().dot(b.direction()) > 0.0;
            (onward && bend < ALIKE).then(|| both.into())
        }
        (Segment::Arc(p), Segment::Arc(q)) => {
            let sweep = p.sweep + q.sweep;
            let both = Arc { sweep, ..*p };
            let onward = p.sweep * q.sweep > 0.0 && sweep.abs() < 6.2;
            let same = (p.radius - q.radius).abs() < ALIKE && both.end().distance(q.end()) < ALIKE;
            (same && onward && p.center.distance(q.center) < ALIKE).then(|| both.into())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// A rectangle with round corners, written with numbers of `decimals`: lines and arcs no longer touch.
    fn rounded(turn: f64, decimals: i32) -> Path {
        let scale = 10_f64.powi(decimals);
        let at = |x: f64, y: f64| {
            let (sine, cosine) = turn.sin_cos();
            let p = Point::new(90.0 + cosine * x - sine * y, 70.0 + sine * x + cosine * y);
            Point::new((p.x * scale).round() / scale, (p.y * scale).round() / scale)
        };
        let (w, h, r) = (10.0, 8.0, 3.0);
        let corners =
            [(-w + r, -h), (w - r, -h), (w, -h + r), (w, h - r)].map(|(x, y)| (at(x, y), at(-x, -y)));
        let corners: Vec<Point> = corners.iter().map(|c| c.0).chain(corners.iter().map(|c| c.1)).collect();
        let bulge = (FRAC_PI_2 / 4.0).tan();
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 8]);
            let arc = (i % 2 == 1).then(|| Arc::from_bulge(a, b, bulge)).flatten();
            arc.map_or_else(|| Line::new(a, b).into(), Segment::from)
        };
        Path::closed((0..8).map(side).collect())
    }

    /// Steiner's formula. Files have six decimals, or nine and a scale: their lines miss the tangents of their arcs by that.
    #[test]
    fn lines_and_arcs_that_touch_to_a_files_decimals_are_offset() {
        for decimals in 3..13 {
            for i in 0..20 {
                let path = rounded(0.3 * f64::from(i), decimals);
                for by in [1.0, -1.0] {
                    let loops = offset_right(&path, by);
                    let want = path.area() + by * path.length() + PI;
                    let [line] = loops.as_slice() else {
                        panic!("{decimals} {i} {by}: {} loops", loops.len())
                    };
                    assert!((line.area() - want).abs() < 0.05, "{decimals} {i} {by}: {}", line.area() - want);
                }
            }
        }
    }
}
