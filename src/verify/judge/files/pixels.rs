//! Pictures of pixels against the design: what lies where, by its colour.
//!
//! The sheet is found by its own colour, as a person finds it; from there on every point of the design has a pixel. Labels, arrows and
//! thin lines lie above what is looked for, so most of the pixels must be right, not all.

use crate::design::{PlacedStar, SheetLayout, StarDesign};
use crate::geom::{Path, Point};
use crate::verify::judge::expected::Expected;
use crate::verify::read::png::{Raster, read_png};
use crate::verify::{FindingCode, Findings};

/// The colours of a preview, as docs/pictures.md lists them.
const SHEET: [u8; 3] = [0xf7, 0xf7, 0xf4];
const FLAP: [u8; 3] = [0xdf, 0xe6, 0xee];
const TUBE: [u8; 3] = [0x9c, 0xc3, 0xe6];
const BAND: [u8; 3] = [0xe8, 0xa3, 0x3d];

/// Points that are looked at along each path.
const POINTS: u32 = 60;
/// Part of them that must have the right colour.
const MOST: f64 = 0.8;
/// Least width, pixels, of what is looked for.
const LEAST: f64 = 2.5;
/// How far the sides of the sheet may be off, pixels: its border lies half on it.
const SIDES: f64 = 4.0;

/// Reads a PNG and looks for the stars of sheet number `sheet` in it.
pub(in crate::verify) fn check(bytes: &[u8], expected: &Expected<'_>, sheet: usize, findings: &mut Findings) {
    let Some(raster) = read_png(bytes) else {
        let found = format!("{} bytes that are no such picture", bytes.len());
        findings.add(FindingCode::BadPng, None, found, "pixels of three colours, 8 bits each");
        return;
    };
    let Some(layout) = expected.design.sheets.iter().find(|layout| layout.index == sheet) else { return };
    let Some(seen) = Seen::find(&raster, layout) else {
        let allowed = format!("a sheet of {} x {} mm", layout.width, layout.height);
        findings.add(FindingCode::OtherPicture, None, "no sheet of this shape", allowed);
        return;
    };
    for star in expected.design.on_sheet(sheet) {
        for (what, color, points) in signs(expected.design.part(star), star, seen.scale) {
            let right = points.iter().filter(|point| seen.shows(**point, color)).count();
            #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
            let share = right as f64 / points.len().max(1) as f64;
            if !points.is_empty() && share < MOST {
                let found =
                    format!("the {what} of star {} in {:.0} % of its places", star.index, 100.0 * share);
                findings.add(
                    FindingCode::OtherPicture,
                    None,
                    found,
                    format!("at least {:.0} %", 100.0 * MOST),
                );
            }
        }
    }
}

/// A sheet in a picture.
struct Seen<'a> {
    raster: &'a Raster,
    /// Pixels a mm.
    scale: f64,
    /// Where the sheet's lower left corner is, pixels from the upper left.
    corner: (f64, f64),
}

impl<'a> Seen<'a> {
    /// The sheet by its colour; `None` if what has it is of another shape.
    fn find(raster: &'a Raster, layout: &SheetLayout) -> Option<Self> {
        let (mut left, mut right, mut top, mut low) = (usize::MAX, 0, usize::MAX, 0);
        for (row, colors) in raster.rgb.chunks_exact(3 * raster.width).enumerate() {
            let is_sheet = |color: &[u8]| color == SHEET;
            let mut columns = colors.chunks_exact(3);
            let Some(first) = columns.position(is_sheet) else { continue };
            let last = columns.rposition(is_sheet).map_or(first, |at| first + 1 + at);
            (left, right) = (left.min(first), right.max(last));
            (top, low) = (top.min(row), row);
        }
        if left > right || top > low {
            return None;
        }
        #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
        let (x, y, w, h) = (left as f64, top as f64, (right + 1 - left) as f64, (low + 1 - top) as f64);
        // By the longer side, whose error is the smaller part of it.
        let scale = if layout.width > layout.height { w / layout.width } else { h / layout.height };
        let alike = (w - scale * layout.width).abs() <= SIDES && (h - scale * layout.height).abs() <= SIDES;
        alike.then_some(Self { raster, scale, corner: (x, y + h) })
    }

    /// Whether a point of the sheet has this colour, or one that lies half a pixel beside it: where the sheet begins is known
    /// to a pixel, and of a band that is three pixels wide the outer ones are smoothed.
    fn shows(&self, p: Point, color: [u8; 3]) -> bool {
        let half = 0.5;
        let places = [(0.0, 0.0), (half, 0.0), (-half, 0.0), (0.0, half), (0.0, -half)];
        places.iter().any(|shift| self.color(p, *shift) == Some(color))
    }

    /// Which of the four colours the pixel at a point of the sheet, moved by some pixels, is nearest to.
    fn color(&self, p: Point, (right, down): (f64, f64)) -> Option<[u8; 3]> {
        let x = self.corner.0 + p.x * self.scale + right;
        let y = self.corner.1 - p.y * self.scale + down;
        if x < 0.0 || y < 0.0 {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturating, and above 0"
        )]
        let pixel = self.raster.pixel(x as usize, y as usize)?;
        let off = |color: &[u8; 3]| -> u32 {
            color.iter().zip(pixel).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
        };
        [SHEET, FLAP, TUBE, BAND].into_iter().min_by_key(off)
    }
}

/// What of a star must be seen: its name, its colour, and points in its middle; without what is too narrow at `scale` pixels a mm.
fn signs(part: &StarDesign, star: &PlacedStar, scale: f64) -> Vec<(&'static str, [u8; 3], Vec<Point>)> {
    let [inner, _] = &part.realised_edges;
    let mut out = vec![("tube", TUBE, part.star.w, beside(inner, -0.5 * part.star.w))];
    for seam in &part.seams {
        let run = seam.center_line.part(part.star.w, seam.center_line.length() - part.star.w);
        out.push(("band", BAND, part.band, beside(&run, 0.0)));
    }
    let flap = part.outline.flap;
    // From the cut inwards, to the middle between it and the band.
    let middle = 0.5 * flap;
    out.push(("flap", FLAP, flap, beside(&part.outline.outside, middle)));
    let seen = out.into_iter().filter(|(_, _, width, _)| width * scale >= LEAST);
    seen.map(|(what, color, _, points)| {
        (what, color, points.into_iter().map(|point| star.placement.point(point)).collect())
    })
    .collect()
}

/// Points along a path, `left` mm to the left of it.
fn beside(path: &Path, left: f64) -> Vec<Point> {
    let length = path.length();
    let at = |k: u32| (f64::from(k) + 0.5) / f64::from(POINTS) * length;
    (0..POINTS).filter_map(|k| Some(path.point_at(at(k))? + path.tangent_at(at(k))?.perp() * left)).collect()
}
