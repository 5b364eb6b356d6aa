//! Labels: the text on a part, as strokes on a layer of their own.
//!
//! The text runs around a tip, tops outwards, where no inlet and no registration hole is in the way.

use geom::order::sort_by;
use std::f64::consts::{FRAC_PI_2, PI};

use crate::{DrawnPiece, MaskPlate, PlacedPart, StarDesign, lettering};
use geom::{Isometry, Path, Point, Vec2};

/// Height of a capital, mm: large enough for a laser or a pen, and as high as a label needs to be.
const HEIGHTS: (f64, f64) = (1.0, 3.5);
/// Part of a strip's width that a capital may take; a label keeps clear of the seal and of the cut.
const FILLING: f64 = 0.45;

/// A free stretch beside a tip's arc.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    tip: u32,
    /// Directions against the tip's ray.
    from: f64,
    to: f64,
}

/// Number, side and warp direction on the flap of a placed star, in the sheet's frame: the warp runs along X.
pub(super) fn on_outline(part: &StarDesign, placed: &PlacedPart) -> Vec<Path> {
    let rim = part.star.r_i + part.star.w + part.shape.band;
    let strip = part.outline.flap;
    let text = format!("STAR {} THIS SIDE UP WARP ", placed.index);
    let turn = placed.placement.rotation;
    let Some(line) = fit(part, &text, rim + strip / 2.0, strip) else { return Vec::new() };
    let center = placed.placement.point(part.star.tip_center(line.stretch.tip));
    let mut strokes =
        lettering::circular_text(&text, center, rim + strip / 2.0, line.middle(part) + turn, line.height);
    // Behind the text: the advance of the last blank is half of the arrow's length.
    let half_angle = lettering::width(&text, line.height) / 2.0;
    let direction = line.middle(part) + turn - half_angle / (rim + strip / 2.0);
    strokes.extend(arrow(center + Vec2::unit(direction) * (rim + strip / 2.0), 0.8 * line.height));
    strokes
}

/// The labels of a drawn piece where it is placed, in the sheet's frame: the warp runs along X.
pub(super) fn on_piece(piece: &DrawnPiece, placed: &PlacedPart) -> Vec<Path> {
    let mut strokes: Vec<Path> =
        piece.labels.strokes.iter().map(|path| placed.placement.path(path)).collect();
    if let Some((middle, half)) = piece.labels.warp {
        strokes.extend(arrow(placed.placement.point(middle), half));
    }
    strokes
}

/// The star's number and its side on the border of a mask, mirrored or not, in the mask's frame.
pub(super) fn on_mask(part: &StarDesign, mask: &MaskPlate, star: usize, mirrored: bool) -> Vec<Path> {
    let rim = part.star.r_i + part.star.w + part.shape.band + part.outline.flap;
    let side = if mirrored { "OTHER SIDE" } else { "THIS SIDE UP" };
    let text = format!("MASK STAR {star} {side}");
    let radius = rim + mask.border / 2.0;
    let Some(line) = fit(part, &text, radius, mask.border) else { return Vec::new() };
    let (motion, sign) = if mirrored { (Isometry::mirror(), -1.0) } else { (Isometry::IDENTITY, 1.0) };
    let center = motion.point(part.star.tip_center(line.stretch.tip));
    lettering::circular_text(&text, center, radius, sign * line.middle(part), line.height)
}

/// A text that has found its place.
struct Fitted {
    stretch: Stretch,
    height: f64,
}

impl Fitted {
    fn middle(&self, part: &StarDesign) -> f64 {
        part.star.tip_ray(self.stretch.tip) + 0.5 * (self.stretch.from + self.stretch.to)
    }
}

/// The widest stretch, and the height at which the text fits on it; `None` if it would be too small to read.
fn fit(part: &StarDesign, text: &str, radius: f64, strip: f64) -> Option<Fitted> {
    let widest = (1..=part.star.n).map(|tip| free(part, tip, radius + strip / 2.0));
    let stretch = widest.flatten().reduce(|a, b| if b.to - b.from > a.to - a.from + 1e-9 { b } else { a })?;
    let room = 0.92 * (stretch.to - stretch.from) * radius;
    let height = (room / lettering::width(text, 1.0)).min(FILLING * strip).min(HEIGHTS.1);
    (height >= HEIGHTS.0).then_some(Fitted { stretch, height })
}

/// The widest stretch beside a tip's arc that no registration hole takes; `None` where the inlet is.
///
/// It ends where the arms begin, or where the circle of radius `edge` around T meets the neighbouring tip's on the
/// corner's ray: seen from T at `pi/2 + pi/n - acos(d_t sin(pi/n) / edge)`.
fn free(part: &StarDesign, tip: u32, edge: f64) -> Option<Stretch> {
    if part.channel.is_some_and(|channel| channel.tip == tip) {
        return None;
    }
    let star = &part.star;
    let alpha = star.half_sector();
    let meet = FRAC_PI_2 + alpha - libm::acos((star.d_t * libm::sin(alpha) / edge).min(1.0));
    let half = ((PI - star.phi_i) / 2.0).min(meet);
    let center = star.tip_center(tip);
    let mut holes: Vec<(f64, f64)> = part
        .outline
        .registration
        .iter()
        .filter(|hole| hole.center.distance(center) < part.outline.reach - star.d_t + hole.diameter)
        .map(|hole| {
            let v = hole.center - center;
            let turn = Isometry::rotation(-star.tip_ray(tip)).point(Point::ORIGIN + v).angle();
            // The hole, as much beside it, and the ear around it.
            (turn, libm::asin((2.5 * hole.diameter / v.length()).min(1.0)))
        })
        .filter(|(turn, wide)| turn.abs() < half + wide)
        .collect();
    sort_by(&mut holes, |a, b| a.0.total_cmp(&b.0));
    let mut from = -half;
    let mut best: Option<Stretch> = None;
    for (turn, wide) in holes.into_iter().chain([(half, 0.0)]) {
        let to = turn - wide;
        if best.is_none_or(|b| to - from > b.to - b.from) {
            best = Some(Stretch { tip, from, to });
        }
        from = turn + wide;
    }
    best.filter(|stretch| stretch.to > stretch.from)
}

/// A double arrow along X.
pub(super) fn arrow(middle: Point, half: f64) -> Vec<Path> {
    let (shaft, heads) =
        ([(-1.0, 0.0), (1.0, 0.0)], [-1.0, 1.0].map(|x| [(0.6 * x, 0.4), (x, 0.0), (0.6 * x, -0.4)]));
    let lines = [&shaft[..], &heads[0], &heads[1]]
        .map(|line| line.iter().map(|(x, y)| middle + Vec2::new(*x, *y) * half));
    lines.into_iter().map(|line| Path::polyline(&line.collect::<Vec<_>>())).collect()
}
