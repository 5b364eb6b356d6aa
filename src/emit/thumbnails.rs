//! Pictures of programs, which the hosts of printers show: for a list, and for the selected file.

use crate::emit::picture::{Colour, Group, Pen, Picture};
use geom::{Bounds, Path, Vec2};
use program::gcode::{self, Thumbnail};
use program::plan::{Program, Step};
use spec::{Machine, Spec};

/// Sides of the pictures, pixels: for a list, and for the selected file.
const SIDES: [u32; 2] = [32, 300];
/// Least width of a seam, pixels.
const LEAST: f64 = 1.6;
/// Margin around the path, as a part of its extent.
const MARGIN: f64 = 0.06;
/// Colour of sealed lines.
const SEALED: Colour = Colour(0xe8, 0xa3, 0x3d);
/// Colour of traced lines.
const TRACED: Colour = Colour(0x5b, 0x8d, 0xb8);

/// `program` as G-code, with its pictures if the machine's host shows them.
pub fn gcode(spec: &Spec, machine: &Machine, program: &Program) -> String {
    let pictures =
        if machine.controller.thumbnails { thumbnails(program, spec.seal.band.0) } else { Vec::new() };
    gcode::gcode(spec, machine, program, &pictures)
}

/// The pictures of `program`, whose seams are `band` mm wide.
fn thumbnails(program: &Program, band: f64) -> Vec<Thumbnail> {
    let thumbnail = |side| {
        let png = picture(program, band, f64::from(side))?.png(f64::from(side))?;
        Some(Thumbnail { side, png })
    };
    SIDES.into_iter().filter_map(thumbnail).collect()
}

/// The paths of the iron on a square of `side` pixels; `None` for a program without a path.
fn picture(program: &Program, band: f64, side: f64) -> Option<Picture> {
    let colour_of = |step: &Step| match step {
        Step::Seal(pieces) => Some((Path::open(pieces.clone()), SEALED)),
        Step::Trace(pieces) => Some((Path::open(pieces.clone()), TRACED)),
        Step::Height(_)
        | Step::Heat(_)
        | Step::Pause(_)
        | Step::Cool(_)
        | Step::Travel(_)
        | Step::Seam(_)
        | Step::TouchDown(_)
        | Step::Lift(_) => None,
    };
    let paths: Vec<(Path, Colour)> = program.steps.iter().filter_map(colour_of).collect();
    let bounds = paths.iter().map(|(path, _)| path.bounds()).fold(Bounds::EMPTY, Bounds::union);
    let half = (0.5 + MARGIN) * bounds.width().max(bounds.height()) + band;
    if !half.is_finite() || paths.is_empty() {
        return None;
    }
    let corner = Vec2::new(half, half);
    let window = Bounds { min: bounds.center() - corner, max: bounds.center() + corner };
    let width = band.max(LEAST * 2.0 * half / side);
    let mut group = Group::new("way");
    for (path, ink) in paths {
        group.line(path, Pen::new(ink, width));
    }
    Some(Picture { title: String::new(), window, top: window.max.y, groups: vec![group] })
}
