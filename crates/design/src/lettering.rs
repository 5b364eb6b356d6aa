//! Lettering: text as strokes that any cutter or plotter can draw, without a font in the reader.
//!
//! Every glyph is on a grid 4 wide and 6 high; a stroke is a chain of grid points, two digits each.

use geom::{Path, Point, Vec2};

/// Height of a capital on the grid.
pub(super) const CAPITAL: f64 = 6.0;
/// From one glyph to the next on the grid.
pub(super) const ADVANCE: f64 = 6.0;

/// The strokes of every glyph: as few as can be, and no line twice, as a laser burns a line that it passes twice. Other
/// characters are drawn as a blank.
const GLYPHS: [(char, &str); 41] = [
    ('A', "002640 1232"),
    ('B', "030636453433424130000333"),
    ('C', "4536160501103041"),
    ('D', "00062645412000"),
    ('E', "40000646 0333"),
    ('F', "000646 0333"),
    ('G', "45361605011030414323"),
    ('H', "0006 4046 0343"),
    ('I', "1030 2026 1636"),
    ('J', "0110304146"),
    ('K', "0006 0246 1340"),
    ('L', "060040"),
    ('M', "0006234640"),
    ('N', "00064046"),
    ('O', "103041453616050110"),
    ('P', "00063645343303"),
    ('Q', "103041453616050110 2240"),
    ('R', "00063645343303 2340"),
    ('S', "011030414233130405163645"),
    ('T', "2026 0646"),
    ('U', "060110304146"),
    ('V', "062046"),
    ('W', "0610233046"),
    ('X', "0046 0640"),
    ('Y', "062346 2320"),
    ('Z', "06460040"),
    ('0', "01103041453616050145"),
    ('1', "052620 1030"),
    ('2', "05163645440040"),
    ('3', "0516364534334241301001 1333"),
    ('4', "42023630"),
    ('5', "460603334241301001"),
    ('6', "0333424130100105163645"),
    ('7', "064610"),
    ('8', "13334445361605041302011030414233"),
    ('9', "0110304145361605041343"),
    ('-', "1333"),
    ('.', "2021"),
    (',', "2110"),
    ('/', "0046"),
    (':', "2122 2425"),
];

/// The strokes of `c` as points of the grid; empty for characters drawn as a blank.
fn strokes(c: char) -> Vec<Vec<[u8; 2]>> {
    let Some((_, strokes)) = GLYPHS.iter().find(|(known, _)| *known == c) else { return Vec::new() };
    let point = |xy: &[u8]| [xy[0] - b'0', xy[1] - b'0'];
    strokes.split(' ').map(|stroke| stroke.as_bytes().chunks_exact(2).map(point).collect()).collect()
}

/// Width of a text, mm.
pub(super) fn width(text: &str, height: f64) -> f64 {
    let glyphs = text.chars().map(|_| ADVANCE).sum::<f64>();
    (glyphs - (ADVANCE - 4.0)).max(0.0) * height / CAPITAL
}

/// The text in a straight line, from `origin` to the right.
pub fn lettered(text: &str, origin: Point, height: f64) -> Vec<Path> {
    let mut strokes = Vec::new();
    for (i, c) in (0_u32..).zip(text.chars()) {
        let shift = Vec2::new(f64::from(i) * ADVANCE * height / CAPITAL, 0.0);
        strokes.extend(glyph(c, origin + shift, Vec2::new(1.0, 0.0), height));
    }
    strokes
}

/// The text along a circle around `center`, clockwise, its tops outwards, its middle in direction `middle`;
/// `radius` is that of the middle of the capitals.
pub(super) fn circular_text(text: &str, center: Point, radius: f64, middle: f64, height: f64) -> Vec<Path> {
    let scale = height / CAPITAL;
    let total = width(text, height);
    let mut strokes = Vec::new();
    for (i, c) in (0_u32..).zip(text.chars()) {
        // Distance of this glyph's middle to the right of the text's middle.
        let right = f64::from(i) * ADVANCE * scale + 2.0 * scale - total / 2.0;
        let upward = Vec2::unit(middle - right / radius);
        let baseline = -upward.perp();
        let origin = center + upward * (radius - height / 2.0) - baseline * (2.0 * scale);
        strokes.extend(glyph(c, origin, baseline, height));
    }
    strokes
}

/// The strokes of `c` from its lower left corner `origin` on, written towards the unit vector `baseline`, its capitals `height` mm high.
pub(super) fn glyph(c: char, origin: Point, baseline: Vec2, height: f64) -> impl Iterator<Item = Path> {
    let (right, upward) = (baseline * (height / CAPITAL), baseline.perp() * (height / CAPITAL));
    let grid_point = move |[x, y]: [u8; 2]| origin + right * f64::from(x) + upward * f64::from(y);
    strokes(c)
        .into_iter()
        .map(move |stroke| Path::polyline(&stroke.into_iter().map(grid_point).collect::<Vec<_>>()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_stands_on_its_grid() {
        for (c, strokes) in GLYPHS {
            assert!(strokes.split(' ').all(|s| s.len() >= 4 && s.len() % 2 == 0), "{c}: {strokes}");
            let strokes_of_glyph: Vec<Path> = glyph(c, Point::ORIGIN, Vec2::new(1.0, 0.0), 6.0).collect();
            let bounds =
                strokes_of_glyph.iter().map(Path::bounds).reduce(geom::Bounds::union).expect("strokes");
            assert!(bounds.min.x >= 0.0 && bounds.min.y >= 0.0, "{c}");
            assert!(bounds.max.x <= 4.0 && bounds.max.y <= 6.0, "{c}");
        }
    }

    /// Every stroke as grid points.
    fn grid(strokes: &str) -> Vec<Vec<(i32, i32)>> {
        let digit = |byte: u8| i32::from(byte - b'0');
        let point = |xy: &[u8]| (digit(xy[0]), digit(xy[1]));
        strokes.split(' ').map(|stroke| stroke.as_bytes().chunks_exact(2).map(point).collect()).collect()
    }

    /// The lines between neighbouring grid points of the strokes, lower end first: a line is cut where a stroke ends on it.
    fn pieces(strokes: &[Vec<(i32, i32)>]) -> Vec<[(i32, i32); 2]> {
        let mut pieces = Vec::new();
        for (a, b) in strokes.iter().flat_map(|stroke| stroke.iter().zip(&stroke[1..])) {
            let along = |p: &(i32, i32)| (p.0 - a.0) * (b.0 - a.0) + (p.1 - a.1) * (b.1 - a.1);
            let across = |p: &(i32, i32)| (p.0 - a.0) * (b.1 - a.1) - (p.1 - a.1) * (b.0 - a.0);
            let is_on = |p: &&(i32, i32)| across(p) == 0 && (0..=along(b)).contains(&along(p));
            let mut points: Vec<(i32, i32)> = strokes.iter().flatten().filter(is_on).copied().collect();
            points.sort_by_key(along);
            points.dedup();
            pieces.extend(points.windows(2).map(|ends| [ends[0].min(ends[1]), ends[0].max(ends[1])]));
        }
        pieces
    }

    /// Euler: a connected figure takes half as many strokes as it has points where an odd number of lines meet, at least one.
    #[test]
    fn no_glyph_has_more_strokes_than_it_needs_or_a_line_twice() {
        for (c, strokes) in GLYPHS {
            let strokes = grid(strokes);
            let mut glyph_pieces = pieces(&strokes);
            let count = glyph_pieces.len();
            glyph_pieces.sort_unstable();
            glyph_pieces.dedup();
            assert_eq!(glyph_pieces.len(), count, "{c} has a line twice");
            let mut fewest = 0;
            while let Some(first) = glyph_pieces.pop() {
                let mut figure = first.to_vec();
                while let Some(next) =
                    glyph_pieces.iter().position(|piece| piece.iter().any(|p| figure.contains(p)))
                {
                    figure.extend(glyph_pieces.swap_remove(next));
                }
                let meeting = |p: &(i32, i32)| figure.iter().filter(|q| *q == p).count();
                let mut odd: Vec<(i32, i32)> =
                    figure.iter().filter(|p| !meeting(p).is_multiple_of(2)).copied().collect();
                odd.sort_unstable();
                odd.dedup();
                fewest += (odd.len() / 2).max(1);
            }
            assert_eq!(strokes.len(), fewest, "{c}");
        }
    }

    #[test]
    fn text_around_a_circle_keeps_between_two_circles() {
        let paths = circular_text("STAR 12", Point::new(3.0, 4.0), 40.0, 1.0, 3.0);
        for path in &paths {
            let nearest = path.distance(Point::new(3.0, 4.0));
            let furthest = path.furthest(Point::new(3.0, 4.0));
            assert!(nearest > 38.4 && furthest < 41.7, "{nearest} {furthest}");
        }
        assert_eq!(lettered("A B", Point::ORIGIN, 6.0).len(), 3);
        assert_eq!(width("A B", 6.0), 16.0);
    }
}
