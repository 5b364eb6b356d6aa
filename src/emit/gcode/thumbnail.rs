//! Thumbnails: small pictures of a program's path, in comments of its head, for hosts that show them beside a file's name.
//!
//! The form is PrusaSlicer's, which Moonraker (components/file_manager/metadata.py), OctoPrint's thumbnail plugins and
//! RepRapFirmware read: `thumbnail begin WxH N`, a PNG as N characters of base64, `thumbnail end`.

use std::fmt;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::emit::gcode::writer::Writer;
use crate::emit::picture::{Colour, Group, Pen, Picture};
use crate::plan::{Program, Step};
use inflatable::geom::{Bounds, Path, Vec2};

/// Sides, pixels: for a list, and for the selected file.
const SIDES: [f64; 2] = [32.0, 300.0];
/// Characters a line: fewer than the shortest line of a profile has.
const LINE: usize = 64;
/// Least width of a seam, pixels.
const LEAST: f64 = 1.6;
/// Blank around, as a part of the way's extent.
const BLANK: f64 = 0.06;
/// Colours of sealed lines and of traced ones.
const SEAM: Colour = Colour(0xe8, 0xa3, 0x3d);
const TRACED: Colour = Colour(0x5b, 0x8d, 0xb8);

/// Writes the pictures of `program` with a band `band` wide, mm.
pub(super) fn thumbnails(
    writer: &mut Writer<'_, impl fmt::Write>,
    program: &Program,
    band: f64,
) -> fmt::Result {
    for side in SIDES {
        let Some(png) = picture(program, band, side).and_then(|picture| picture.png(side)) else { continue };
        let text = STANDARD.encode(png);
        writer.comment(&format!("thumbnail begin {side}x{side} {}", text.len()))?;
        let mut rest = text.as_str();
        while !rest.is_empty() {
            // Base64 is ASCII.
            let (line, after) = rest.split_at(rest.len().min(LINE));
            writer.comment(line)?;
            rest = after;
        }
        writer.comment("thumbnail end")?;
    }
    Ok(())
}

/// The ways of the iron on a square; `None` for a program without a way.
fn picture(program: &Program, band: f64, side: f64) -> Option<Picture> {
    let ways: Vec<(Path, Colour)> = program
        .steps
        .iter()
        .filter_map(|step| match step {
            Step::Seal(pieces) => Some((Path::open(pieces.clone()), SEAM)),
            Step::Trace(pieces) => Some((Path::open(pieces.clone()), TRACED)),
            _ => None,
        })
        .collect();
    let bounds = ways.iter().map(|(path, _)| path.bounds()).fold(Bounds::EMPTY, Bounds::union);
    let half = (0.5 + BLANK) * bounds.width().max(bounds.height()) + band;
    if !half.is_finite() || ways.is_empty() {
        return None;
    }
    let around = Vec2::new(half, half);
    let window = Bounds { min: bounds.center() - around, max: bounds.center() + around };
    let width = band.max(LEAST * 2.0 * half / side);
    let mut group = Group::new("way");
    for (path, ink) in ways {
        group.line(path, Pen::new(ink, width));
    }
    Some(Picture { title: String::new(), window, top: window.max.y, groups: vec![group] })
}
