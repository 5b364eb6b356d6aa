//! Numbers and words on a star: sized by its tube, each where it covers nothing.

use std::f64::consts::TAU;

use crate::emit::picture::{Group, Pen, Text};
use crate::emit::preview::place::Places;
use crate::emit::preview::style::{LABEL, START, Style, TEXT, circle, straight};
use crate::emit::preview::travel::Start;
use design::{DrawnPiece, PlacedPart, StarDesign};
use geom::{Bounds, Point, Vec2};
use program::text::shortened;

/// Sizes that are tried in turn, relative to the first; smaller text is not readable.
const SIZES: [f64; 8] = [1.0, 0.85, 0.72, 0.61, 0.52, 0.44, 0.37, 0.3];
/// Size from which words are read with ease, by that of the picture's type.
const LEGIBLE: f64 = 0.62;
/// Ways out that are tried around a point.
const WAYS: u32 = 24;
/// Distances from the point, by the label's size.
const REACHES: [f64; 9] = [1.2, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0, 6.5, 8.0];
/// After so many tries in a picture, labels are placed close by and in full size or left out: a picture with hundreds of labels
/// has no room for most.
const MANY: usize = 200_000;

/// Name, tips, corners and inlet of one star.
pub(super) fn star_labels(part: &StarDesign, star: &PlacedPart, style: Style, places: &mut Places) -> Group {
    // The name takes the largest size that fits the hole. Hinges and inlet are named beside themselves, where a place
    // is free.
    let mut group = Group::new(format!("labels-{}", star.index));
    let geometry = &part.star;
    let middle = star.placement.point(Point::ORIGIN);
    let name = format!("star {}", star.index);
    for size in SIZES.map(|share| share * (1.6 * style.unit).min(0.4 * geometry.rho_0)) {
        let lines = [(name.as_str(), 0.8, size), ("this side up", -0.8, 0.75 * size)];
        let lines = lines.map(|(words, up, size)| {
            vec![Text::centered(middle + Vec2::new(0.0, up * size), size, TEXT, words)]
        });
        if let Some(lines) = places.place_all(lines) {
            for line in lines {
                group.text(line);
            }
            break;
        }
    }
    for text in hinges(part, star, style, places) {
        group.text(text);
    }
    if let Some(channel) = &part.channel {
        let mouth = star.placement.point(channel.mouth_center(geometry));
        let direction =
            mouth - star.placement.point(Point::polar(geometry.d_t, geometry.tip_ray(channel.tip)));
        let size = (0.9 * style.unit).min(0.3 * geometry.w);
        draw_callout(
            &mut group,
            places,
            &Callout { at: mouth, along: direction, size, words: "inlet", ring: false },
        );
    }
    group
}

/// Name of a drawn piece, of each of its seams beside its middle, and of its ports and valves.
///
/// What lies on an edge is labelled on the side away from the piece's middle or from the valve's. The piece's name comes last, in the
/// largest type for which room is left.
pub(super) fn drawn_labels(
    piece: &DrawnPiece,
    placed: &PlacedPart,
    style: Style,
    places: &mut Places,
) -> Group {
    let mut group = Group::new(format!("labels-{}", placed.index));
    for seam in &piece.shape.seams {
        let path = placed.placement.path(&seam.center_line);
        let middle = 0.5 * path.length();
        let (Some(point), Some(tangent)) = (path.point_at(middle), path.tangent_at(middle)) else { continue };
        let normal = tangent.perp();
        let size = (0.9 * style.unit).min(0.3 * piece.label_width());
        let words = shortened(&seam.name, 24);
        draw_callout(
            &mut group,
            places,
            &Callout { at: point, along: normal, size, words: &words, ring: false },
        );
    }
    let middle = placed.placement.point(piece.part.outside.bounds().center());
    let size = (0.9 * style.unit).min(0.3 * piece.label_width());
    for port in &piece.shape.ports {
        let point = placed.placement.point(port.at);
        draw_callout(
            &mut group,
            places,
            &Callout { at: point, along: point - middle, size, words: "port", ring: false },
        );
    }
    for valve in &piece.shape.valves {
        let bounds = valve.rim.bounds();
        let place = placed.placement.point(Point::new(bounds.max.x, bounds.center().y));
        let direction = place - placed.placement.point(bounds.center());
        let callout = Callout { at: place, along: direction, size, words: "valve, upper sheet", ring: false };
        draw_callout(&mut group, places, &callout);
    }
    let name = placed.name().to_string();
    let texts = SIZES.map(|share| Text::centered(middle, share * 1.6 * style.unit, TEXT, name.clone()));
    if let Some(text) = places.first(texts) {
        group.text(text);
    }
    group
}

/// Numbers of tips and corners, all of one size: whole words where they can be read, else letters.
fn hinges(part: &StarDesign, star: &PlacedPart, style: Style, places: &mut Places) -> Vec<Text> {
    let geometry = &part.star;
    for (tip, corner, least) in [("tip ", "corner ", LEGIBLE), ("T", "C", 0.0)] {
        for size in SIZES.map(|share| share * (0.9 * style.unit).min(0.26 * geometry.w)) {
            if size < least * style.unit {
                break;
            }
            let hinge_texts = |from: f64, ray: f64, words: String| -> Vec<Text> {
                let shares = [0.5, 0.58, 0.42, 0.66, 0.34, 0.74, 0.26];
                let places = shares.map(|share| {
                    let center = star.placement.point(Point::polar(from + share * geometry.w, ray));
                    Text::centered(center, size, LABEL, words.clone())
                });
                places.to_vec()
            };
            let labels = (1..=geometry.n).flat_map(|k| {
                [
                    hinge_texts(geometry.d_t + geometry.r_i, geometry.tip_ray(k), format!("{tip}{k}")),
                    hinge_texts(geometry.rho_0, geometry.corner_ray(k), format!("{corner}{k}")),
                ]
            });
            if let Some(labels) = places.place_all(labels) {
                return labels;
            }
        }
    }
    Vec::new()
}

/// The numbers of the seams, beside where they begin.
pub(super) fn start_labels(starts: &[Start], style: Style, places: &mut Places) -> Group {
    let mut group = Group::new("order");
    for start in starts {
        let size = style.unit.min(0.3 * start.tube);
        let words = start.order.to_string();
        let callout = Callout { at: start.at, along: start.along.perp(), size, words: &words, ring: true };
        draw_callout(&mut group, places, &callout);
    }
    group
}

/// A label beside a point, with a line to it.
struct Callout<'a> {
    at: Point,
    /// The preferred direction from the point.
    along: Vec2,
    size: f64,
    words: &'a str,
    /// Whether there is a ring around it.
    ring: bool,
}

fn draw_callout(group: &mut Group, places: &mut Places, callout: &Callout<'_>) {
    // Sizes from large to small, reaches from near to far, and directions from straight ahead to behind are tried
    // until a place is free. Where many places were tried already, only the likely ones are, because a crowded sheet
    // would take seconds. Without a free place the callout is left out.
    let Callout { at: anchor, along: direction, words, ring, .. } = *callout;
    let ink = if ring { START } else { LABEL };
    // Straight ahead first, then ever farther to both sides.
    let turns =
        (0..WAYS).map(|way| f64::from(way.div_ceil(2)) * if way.is_multiple_of(2) { 1.0 } else { -1.0 });
    let ways: Vec<Vec2> =
        turns.map(|turn| Vec2::unit(direction.angle() + turn * TAU / f64::from(WAYS))).collect();
    let (sizes, reaches) =
        if places.tried_places() < MANY { (&SIZES[..], &REACHES[..]) } else { (&SIZES[..1], &REACHES[..2]) };
    for size in sizes.iter().map(|share| share * callout.size) {
        let mut text = Text::centered(anchor, size, ink, words);
        let half = 0.5 * text.width();
        let radius = (half + 0.25 * size).max(0.75 * size);
        for reach in reaches {
            for out in &ways {
                let middle = anchor + *out * (reach * size + if ring { 0.0 } else { half * out.x.abs() });
                text = text.centered_at(middle);
                let area = if ring { Bounds::of_points([middle]).outset(radius) } else { text.bounds() };
                if !places.is_free(&area) {
                    continue;
                }
                places.keep_off_box(area);
                let edge =
                    if ring { middle - *out * radius } else { nearest(&area.outset(0.15 * size), anchor) };
                group.line(straight(anchor, edge), Pen::new(ink, 0.07 * size));
                if ring {
                    group.line(circle(middle, radius), Pen::new(ink, 0.07 * size));
                }
                group.text(text);
                return;
            }
        }
    }
}

/// The point of the box that is nearest to `p`.
fn nearest(bounds: &Bounds, p: Point) -> Point {
    Point::new(p.x.clamp(bounds.min.x, bounds.max.x), p.y.clamp(bounds.min.y, bounds.max.y))
}
