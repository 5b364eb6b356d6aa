//! Labels of a drawn piece: the ids of its seams beside them, and which side is up.

use crate::Circle;
use crate::drawn::clearance::Clearance;
use crate::lettering;
use geom::{Bounds, Path, Point};
use sealed::{Role, SealedShape, Seam};

/// Heights of capitals that are tried in turn, mm.
const HEIGHTS: [f64; 5] = [3.5, 2.5, 1.8, 1.3, 1.0];
/// Free space around a text, by its height.
const MARGIN: f64 = 0.35;
/// Parts of a seam at which its text may have its middle.
const STATIONS: [f64; 16] = [
    0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875, 0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125,
    0.9375, 0.02,
];
/// Largest sine of the turn from one glyph to the next: at corners they would lie on each other.
const TURN: f64 = 0.2;
/// Seams that get a label: in a longer list a label is no longer found by reading.
const MOST: usize = 64;
/// Longest text, in characters.
const LONGEST: usize = 24;
/// The side and the warp direction; the arrow is drawn on the blanks.
const SIDE: &str = "THIS SIDE UP WARP   ";

/// The labels of a piece, in its own frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnLabels {
    /// The strokes of all texts.
    pub strokes: Vec<Path>,
    /// The middle of the warp's arrow, and half of its length, mm.
    pub warp: Option<(Point, f64)>,
}

/// The free room for texts on the flap.
struct FlapRoom<'a> {
    room: &'a Clearance<'a>,
    holes: &'a [Circle],
    taken: Vec<Bounds>,
}

/// The labels of a piece of this `shape` with these registration holes, each on the flap or an island where it covers nothing.
pub(super) fn labels(
    shape: &SealedShape,
    room: &Clearance<'_>,
    holes: &[Circle],
    allowance: f64,
) -> DrawnLabels {
    let mut flap_room = FlapRoom { room, holes, taken: Vec::new() };
    let mut drawn_labels = DrawnLabels::default();
    let flap = 0.5 * (shape.band + allowance);
    for seam in shape.seams.iter().filter(|seam| !seam.name.is_empty()).take(MOST) {
        let text: String = seam.name.to_uppercase().replace('_', "-").chars().take(LONGEST).collect();
        if let Some((strokes, ..)) = flap_room.write(seam, &text, shape.band, flap) {
            drawn_labels.strokes.extend(strokes);
        }
    }
    let edges = shape.seams.iter().filter(|seam| seam.role == Role::Boundary);
    let longest =
        edges.reduce(|a, b| if b.center_line.length() > a.center_line.length() + 1e-6 { b } else { a });
    if let Some((strokes, end, height)) =
        longest.and_then(|seam| flap_room.write(seam, SIDE, shape.band, flap))
    {
        drawn_labels.strokes.extend(strokes);
        drawn_labels.warp = Some((end, 0.7 * height));
    }
    drawn_labels
}

/// One character of a text: its middle, and its strokes.
type Glyph = (Point, Vec<Path>);

impl FlapRoom<'_> {
    /// The strokes of `text` along `seam`, in the middle of a flap or close to the band; the place of its last blank but one, and the
    /// height.
    fn write(&mut self, seam: &Seam, text: &str, band: f64, flap: f64) -> Option<(Vec<Path>, Point, f64)> {
        for height in HEIGHTS {
            let close = 0.5 * band + (MARGIN + 0.55) * height;
            for station in STATIONS {
                for aside in [-flap, -close, close] {
                    let text_glyphs = text_along(&seam.center_line, station, aside, text, height);
                    let Some(glyphs) = text_glyphs.filter(|glyphs| self.is_free(glyphs, MARGIN * height))
                    else {
                        continue;
                    };
                    let glyph_box = |(middle, _): &Glyph| Bounds::of_points([*middle]).outset(0.5 * height);
                    self.taken.extend(glyphs.iter().map(glyph_box));
                    let end = glyphs.iter().rev().nth(1).map_or(Point::ORIGIN, |(middle, _)| *middle);
                    let strokes = glyphs.into_iter().flat_map(|(_, strokes)| strokes).collect();
                    return Some((strokes, end, height));
                }
            }
        }
        None
    }

    fn is_free(&self, glyphs: &[Glyph], margin: f64) -> bool {
        // The middles first: most places fail there.
        let mut lines = glyphs.iter().flat_map(|(_, strokes)| strokes).flat_map(|path| &path.segments);
        glyphs.iter().all(|(middle, _)| self.is_point_free(*middle, margin))
            && lines.all(|line| {
                self.is_point_free(line.start(), margin) && self.is_point_free(line.end(), margin)
            })
    }

    /// Whether `p` lies in the room, and off holes and other texts.
    fn is_point_free(&self, p: Point, margin: f64) -> bool {
        self.room.is_free(p, margin, margin)
            && self.holes.iter().all(|hole| hole.center.distance(p) >= 0.5 * hole.diameter + margin)
            && self.taken.iter().all(|bounds| !bounds.contains(p))
    }
}

/// The characters of `text` along a path, their middles `offset` mm to its left, around the part `station` of its length, as upright as can
/// be; `None` where the path is too short or bends too sharply.
fn text_along(path: &Path, station: f64, offset: f64, text: &str, height: f64) -> Option<Vec<Glyph>> {
    let (total, width) = (path.length(), lettering::width(text, height));
    let middle = station * total;
    let way = path.tangent_at(middle)?;
    let forward = if way.x < -1e-6 || way.x < 1e-6 && way.y < 0.0 { -1.0 } else { 1.0 };
    let scale = height / lettering::CAPITAL;
    let (mut direction, mut glyphs) = (way, Vec::new());
    for (i, c) in (0_u32..).zip(text.chars()) {
        let right = (f64::from(i) * lettering::ADVANCE + 2.0) * scale - 0.5 * width;
        let s = middle + forward * right;
        let s = if path.closed { s.rem_euclid(total) } else { s };
        let (point, tangent) = (path.point_at(s)?, path.tangent_at(s)?);
        let bends = i > 0 && direction.cross(tangent).abs() > TURN;
        if width > 0.9 * total || !(0.0..=total).contains(&s) || bends {
            return None;
        }
        direction = tangent;
        let (center, writing) = (point + tangent.perp() * offset, tangent * forward);
        let origin = center - writing * (2.0 * scale) - writing.perp() * (0.5 * height);
        glyphs.push((center, lettering::glyph(c, origin, writing, height).collect()));
    }
    Some(glyphs)
}
