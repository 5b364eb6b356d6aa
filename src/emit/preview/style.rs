//! The style of pictures: colours, and sizes that grow with the picture, so that it reads alike at any size.

use crate::emit::picture::{Colour, Pen};
use geom::{Arc, Line, Path, Point, Vec2};
use spec::Spec;

pub(super) const PAGE: Colour = Colour(0xff, 0xff, 0xff);
pub(super) const SHEET: Colour = Colour(0xf7, 0xf7, 0xf4);
pub(super) const FABRIC: Colour = Colour(0xdf, 0xe6, 0xee);
pub(super) const TUBE: Colour = Colour(0x9c, 0xc3, 0xe6);
pub(super) const BAND: Colour = Colour(0xe8, 0xa3, 0x3d);
/// Covered twice.
pub(super) const TWICE: Colour = Colour(0xd0, 0x00, 0x00);
pub(super) const CUT: Colour = Colour(0xc0, 0x00, 0x00);
/// The iron on its way down or up.
pub(super) const RAMP: Colour = Colour(0x70, 0x30, 0xa0);
pub(super) const IRON: Colour = Colour(0x40, 0x40, 0x40);
pub(super) const START: Colour = Colour(0x00, 0x70, 0x00);
pub(super) const TEXT: Colour = Colour(0x20, 0x20, 0x20);
/// Of QR codes.
pub(super) const CODE: Colour = Colour(0x00, 0x00, 0x00);
pub(super) const LABEL: Colour = Colour(0x1f, 0x4e, 0x79);
/// Frames, dimensions, the sheet's border.
pub(super) const GREY: Colour = Colour(0x80, 0x80, 0x80);
pub(super) const WORK_AREA: Colour = Colour(0x00, 0x80, 0x80);
pub(super) const CLAMP: Colour = Colour(0x8a, 0x4b, 0x1f);
pub(super) const CLAMP_AREA: Colour = Colour(0xea, 0xd9, 0xcb);
pub(super) const OBJECT: Colour = Colour(0xf3, 0xdd, 0xb4);

/// Colours of the bands of processes beside that of `[seal]`, over and over.
const PROCESSES: [Colour; 6] = [
    Colour(0x2e, 0x9e, 0x6b),
    Colour(0xb0, 0x5c, 0xc8),
    Colour(0xd9, 0x5f, 0x6f),
    Colour(0x8a, 0x8f, 0x2a),
    Colour(0x3f, 0x8f, 0xd0),
    Colour(0x7a, 0x5a, 0x3c),
];

/// The colour of bands that are sealed by the process `name` of `spec`.
pub(super) fn band_ink(spec: &Spec, name: &str) -> Colour {
    let index = spec.processes.iter().position(|process| process.name == name);
    index.map_or(BAND, |index| PROCESSES[index % PROCESSES.len()])
}

/// Colours of the stars from bottom to top, over and over.
const STARS: [Colour; 8] = [
    Colour(0x1f, 0x4e, 0x79),
    Colour(0xa6, 0x56, 0x28),
    Colour(0x4d, 0x7c, 0x0f),
    Colour(0x6a, 0x3d, 0x9a),
    Colour(0x00, 0x8b, 0x8b),
    Colour(0xc2, 0x18, 0x5b),
    Colour(0xb8, 0x86, 0x0b),
    Colour(0x2b, 0x8c, 0xff),
];

/// The colour of star number `index`, from 1.
pub(super) fn star_ink(index: usize) -> Colour {
    STARS[index.saturating_sub(1) % STARS.len()]
}

/// Sizes in mm.
#[derive(Clone, Copy)]
pub(super) struct Style {
    /// Size of the type.
    pub(super) unit: f64,
}

impl Style {
    /// The style of a picture whose longer side is `extent`: on a screen's width of 1500 pixels type is 14 pixels high.
    pub(super) fn new(extent: f64) -> Self {
        Self { unit: extent / 110.0 }
    }

    /// A line, `weight` times as wide as the thinnest that is seen well.
    pub(super) fn pen(self, ink: Colour, weight: f64) -> Pen {
        Pen::new(ink, 0.05 * weight * self.unit)
    }

    /// A dashed pen.
    pub(super) fn dashes(self, ink: Colour, weight: f64) -> Pen {
        self.pen(ink, weight).dashed(0.5 * self.unit, 0.35 * self.unit)
    }
}

/// A straight line.
pub(super) fn straight(from: Point, to: Point) -> Path {
    Path::open(vec![Line::new(from, to).into()])
}

/// A circle.
pub(super) fn circle(center: Point, radius: f64) -> Path {
    Path::closed(vec![Arc::new(center, radius, 0.0, std::f64::consts::TAU).into()])
}

/// An arrow head of length `size` with its tip at `tip`, pointing along the unit vector `direction`.
pub(super) fn arrow_head(tip: Point, direction: Vec2, size: f64) -> Path {
    let (back, side) = (tip - direction * size, direction.perp() * (0.35 * size));
    Path::polygon(&[tip, back + side, back - side])
}
