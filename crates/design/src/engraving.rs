//! Engraving: text as closed outlines that can be sunk into the surface of a solid.
//!
//! Every stroke of a glyph is drawn by an eight-sided pen, which leaves a convex **mark**; what is sunk is the union of the
//! marks. Marks have whole numbers for corners, [`FINE`] in a step of the glyphs' grid, so whether an edge of one lies in
//! another is decided exactly.

use std::collections::BTreeMap;

use crate::lettering;
use geom::{Line, Path, Point, Vec2};

/// Depth of engravings, mm: two layers of a common print.
const ENGRAVED: f64 = 0.4;

/// Depth of engravings in a plate of `thickness`: at most a quarter of it.
pub fn engraved_depth(thickness: f64) -> f64 {
    ENGRAVED.min(thickness / 4.0)
}

/// Height of a capital, mm: at the least its strokes are 0.8 mm wide, two lines of a common nozzle.
const HEIGHTS: (f64, f64) = (6.0, 9.0);

/// From one line of text to the next, by the height of a capital.
const LINE: f64 = 1.7;

/// Parts of a step of the glyphs' grid.
const FINE: i64 = 60;

/// Corners of the pen, counterclockwise: 0.8 of a grid step from side to side, 8 % more from corner to corner.
const PEN: [[i64; 2]; 8] =
    [[24, -10], [24, 10], [10, 24], [-10, 24], [-24, 10], [-24, -10], [-10, -24], [10, -24]];

/// A corner of a mark, in parts of a grid step.
type Corner = [i64; 2];

/// A place for text: a disc that nothing else needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    /// Its middle.
    pub(super) middle: Point,
    /// Unit vector towards the top of the text.
    pub(super) up: Vec2,
    /// Its radius.
    pub(super) radius: f64,
}

/// The first of `texts`, each a list of lines, that fits on the spot, as closed outlines: outer ones counterclockwise, islands
/// within a letter clockwise. Empty if none fits.
pub(super) fn engraved(texts: &[Vec<String>], spot: &Spot) -> Vec<Path> {
    let fitted = texts.iter().find_map(|lines| {
        let height = (spot.radius / reach(lines)).min(HEIGHTS.1);
        (height >= HEIGHTS.0).then_some((lines, height))
    });
    let Some((lines, height)) = fitted else { return Vec::new() };
    let mut out = Vec::new();
    for (line, row) in lines.iter().zip(rows(lines.len())) {
        written(line, spot.middle + spot.up * (row * height), spot.up, height, &mut out);
    }
    out
}

/// Heights of the middles of `count` lines above the middle of all, by the height of a capital.
fn rows(count: usize) -> impl Iterator<Item = f64> {
    let count = u32::try_from(count).unwrap_or(u32::MAX);
    (0..count).map(move |i| LINE * (0.5 * f64::from(count - 1) - f64::from(i)))
}

/// Radius of the smallest disc around the middle of the text that holds it, by the height of a capital.
fn reach(lines: &[String]) -> f64 {
    let pen = 0.08;
    let corner = |(line, row): (&String, f64)| {
        libm::hypot(0.5 * lettering::width(line, 1.0) + pen, row.abs() + 0.5 + pen)
    };
    lines.iter().zip(rows(lines.len())).map(corner).fold(0.0, f64::max)
}

/// Appends the outlines of one line of text around `middle`.
fn written(text: &str, middle: Point, up: Vec2, height: f64, out: &mut Vec<Path>) {
    let step = height / lettering::CAPITAL;
    let along = -up.perp();
    let start = middle - along * (lettering::width(text, height) / 2.0) - up * (height / 2.0);
    for (i, c) in (0_u32..).zip(text.chars()) {
        let origin = start + along * (f64::from(i) * lettering::ADVANCE * step);
        let at = |[x, y]: [f64; 2]| origin + along * (x * step) + up * (y * step);
        for outline in outlines(c) {
            let corners: Vec<Point> = outline.into_iter().map(at).collect();
            let next = corners.iter().cycle().skip(1);
            let sides = corners.iter().zip(next).map(|(a, b)| Line::new(*a, *b).into());
            out.push(Path::closed(sides.collect()));
        }
    }
}

/// The outlines of a glyph, in steps of its grid.
fn outlines(c: char) -> Vec<Vec<[f64; 2]>> {
    chained(&edges_of(&marks(c)))
}

/// The marks of a glyph, each with its corners counterclockwise.
fn marks(c: char) -> Vec<Vec<Corner>> {
    let mut out = Vec::new();
    for stroke in lettering::strokes(c) {
        for (a, b) in stroke.iter().zip(stroke.iter().skip(1)) {
            let ends = [a, b].map(|[x, y]| [FINE * i64::from(*x), FINE * i64::from(*y)]);
            let corners = ends.iter().flat_map(|[x, y]| PEN.map(|[dx, dy]| [x + dx, y + dy]));
            out.push(hull(corners.collect()));
        }
    }
    out
}

/// On which side of the line from `a` to `b` the point `p` lies: positive for left.
fn side(a: Corner, b: Corner, p: Corner) -> i64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The convex hull, counterclockwise, without corners in line.
fn hull(mut points: Vec<Corner>) -> Vec<Corner> {
    points.sort_unstable();
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = &Corner>| {
        let mut chain: Vec<Corner> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                if side(a, b, *p) > 0 {
                    break;
                }
                let _ = chain.pop();
            }
            chain.push(*p);
        }
        let _ = chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter());
    lower.extend(chain(&mut points.iter().rev()));
    lower
}

/// The corners of a mark, each with the next one.
fn sides(mark: &[Corner]) -> impl Iterator<Item = (Corner, Corner)> + '_ {
    mark.iter().zip(mark.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
}

/// The parts of the marks' edges that lie in no other mark: from, to.
fn edges_of(marks: &[Vec<Corner>]) -> Vec<[[f64; 2]; 2]> {
    let mut out = Vec::new();
    for (i, mark) in marks.iter().enumerate() {
        for (a, b) in sides(mark) {
            let mut free = vec![(0.0, 1.0)];
            for (j, other) in marks.iter().enumerate().filter(|(j, _)| *j != i) {
                let Some((from, to)) = covered(a, b, other, j < i) else { continue };
                let parts = free.iter().flat_map(|&(s, e): &(f64, f64)| [(s, e.min(from)), (s.max(to), e)]);
                free = parts.filter(|(s, e)| e - s > 1e-9).collect();
            }
            #[expect(clippy::cast_precision_loss, reason = "corners are small whole numbers")]
            let at = |t: f64| {
                let along = |k: usize| (a[k] as f64 + t * (b[k] - a[k]) as f64) / FINE as f64;
                [along(0), along(1)]
            };
            out.extend(free.into_iter().map(|(s, e)| [at(s), at(e)]));
        }
    }
    out
}

/// The part of the edge from `a` to `b` that the convex `mark` takes away; of two equal edges the one that comes `before`
/// stays.
fn covered(a: Corner, b: Corner, mark: &[Corner], before: bool) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (c, d) in sides(mark) {
        match (side(c, d, a), side(c, d, b)) {
            (0, 0) => {
                let same = (b[0] - a[0]) * (d[0] - c[0]) + (b[1] - a[1]) * (d[1] - c[1]) > 0;
                if same && !before {
                    return None;
                }
            }
            (p, q) if p <= 0 && q <= 0 => return None,
            (p, q) if p < 0 || q < 0 => {
                #[expect(clippy::cast_precision_loss, reason = "corners are small whole numbers")]
                let t = p as f64 / (p - q) as f64;
                if p < 0 { from = from.max(t) } else { to = to.min(t) }
            }
            _ => {}
        }
    }
    (to - from > 1e-9).then_some((from, to))
}

/// Closed outlines out of edges, without corners in line.
fn chained(edges: &[[[f64; 2]; 2]]) -> Vec<Vec<[f64; 2]>> {
    // Ends that are one point differ by rounding; different ones lie far apart.
    #[expect(clippy::cast_possible_truncation, reason = "a glyph is a few steps wide")]
    let key = |p: [f64; 2]| p.map(|x| (x * 1e6).round() as i64);
    let mut from: BTreeMap<[i64; 2], [[f64; 2]; 2]> =
        edges.iter().map(|edge| (key(edge[0]), *edge)).collect();
    let mut out = Vec::new();
    while let Some((_, first)) = from.pop_first() {
        let mut outline = vec![first[0]];
        let mut here = first[1];
        while let Some(edge) = from.remove(&key(here)) {
            outline.push(edge[0]);
            here = edge[1];
        }
        out.push(straightened(&outline));
    }
    out
}

/// Without the corners that lie on the line between their neighbours.
fn straightened(outline: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let count = outline.len();
    let bends = |i: &usize| {
        let [a, b, c] = [outline[(i + count - 1) % count], outline[*i], outline[(i + 1) % count]];
        ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])).abs() > 1e-9
    };
    (0..count).filter(bends).map(|i| outline[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::Segment;

    fn paths(c: char) -> Vec<Path> {
        let loops = outlines(c).into_iter().map(|outline| {
            let corners: Vec<Point> = outline.into_iter().map(|[x, y]| Point::new(x, y)).collect();
            let next = corners.iter().cycle().skip(1);
            Path::closed(corners.iter().zip(next).map(|(a, b)| Line::new(*a, *b).into()).collect())
        });
        loops.collect()
    }

    fn strokes(c: char) -> Vec<Segment> {
        let mut out = Vec::new();
        for stroke in lettering::strokes(c) {
            let at = |[x, y]: [u8; 2]| Point::new(f64::from(x), f64::from(y));
            out.extend(stroke.windows(2).map(|ends| Segment::from(Line::new(at(ends[0]), at(ends[1])))));
        }
        out
    }

    /// Against the strokes themselves, from which the pen keeps 0.4 to 0.4334 of a step: every point of an outline lies that far
    /// from the nearest stroke, and a point of the grid is within the outlines if it is nearer, outside if it is farther.
    #[test]
    fn what_is_sunk_is_what_the_pen_passes() {
        for c in lettering::known() {
            let (outlines, strokes) = (paths(c), strokes(c));
            let near = |p: Point| strokes.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
            assert!(outlines.iter().all(|path| path.segments.len() >= 3), "{c}");
            for segment in outlines.iter().flat_map(|path| &path.segments) {
                assert!(segment.length() > 1e-3, "{c}: {segment:?}");
                for t in [0.0, 0.25, 0.5, 0.75] {
                    let distance = near(segment.point(t));
                    assert!((0.4 - 1e-9..0.4334).contains(&distance), "{c}: {distance}");
                }
            }
            for i in 0..60 {
                for j in 0..80 {
                    let p = Point::new(0.1 * f64::from(i) - 0.97, 0.1 * f64::from(j) - 0.93);
                    let turns: i32 = outlines.iter().map(|path| path.winding_number(p)).sum();
                    match near(p) {
                        d if d < 0.4 => assert_eq!(turns, 1, "{c} {p:?}"),
                        d if d > 0.4334 => assert_eq!(turns, 0, "{c} {p:?}"),
                        _ => {}
                    }
                }
            }
        }
    }

    #[test]
    fn text_stays_on_its_spot_or_gives_way_to_a_shorter_one() {
        let spot = |radius| Spot { middle: Point::new(3.0, -4.0), up: Vec2::unit(0.7), radius };
        let texts = [vec!["STAR 12".to_owned(), "THIS SIDE UP".to_owned()], vec!["1".to_owned()]];
        for radius in [60.0, 40.0, 30.0, 6.0, 4.6] {
            let out = engraved(&texts, &spot(radius));
            let far = out.iter().map(|path| path.furthest(spot(radius).middle)).fold(0.0, f64::max);
            assert!(far > 0.0 && far < radius, "{radius}: {far}");
        }
        assert!(engraved(&texts, &spot(60.0)).len() > 2 * engraved(&texts, &spot(6.0)).len());
        assert_eq!(engraved(&texts, &spot(4.0)), []);
    }
}
