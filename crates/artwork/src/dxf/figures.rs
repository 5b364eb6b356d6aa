//! Entities as chains of pieces in the plane.

use std::f64::consts::TAU;

use geom::{Point, Vec2};

use super::geometry::{EntityShape, Geometry, flat};
use super::group::{EntityRecord, Flaw};
use super::polyline;
use crate::collector::CurveChain;
use crate::piece::Piece;
use crate::spline::{Nurbs, interpolated};

/// Reads an entity; `parts` are the vertices that follow a POLYLINE.
pub(super) fn read(record: &EntityRecord<'_, '_>, parts: &[EntityRecord<'_, '_>]) -> Result<Geometry, Flaw> {
    match record.kind {
        // In world coordinates, whatever their extrusion.
        "LINE" => line(record),
        "SPLINE" => spline(record),
        "POINT" => point(record),
        "ARC" | "CIRCLE" => in_plane(record, circle),
        "ELLIPSE" => in_plane(record, ellipse),
        "LWPOLYLINE" => in_plane(record, polyline::light),
        "POLYLINE" => in_plane(record, |record| polyline::heavy(record, parts)),
        _ => Err(record.unknown()),
    }
}

/// Reads an entity that has a plane of its own.
fn in_plane<'a, 'g>(
    record: &EntityRecord<'a, 'g>,
    reader: impl Fn(&EntityRecord<'a, 'g>) -> Result<Geometry, Flaw>,
) -> Result<Geometry, Flaw> {
    let is_mirrored = mirrored(record)?;
    let geometry = reader(record)?;
    // The centre and axis of an ellipse are in world coordinates; its direction is mirrored where it is read.
    let is_mirrored = is_mirrored && record.kind != "ELLIPSE" && !polyline::in_space(record)?;
    Ok(Geometry { mirrored: is_mirrored, ..geometry })
}

/// Whether the extrusion is along -z; refuses one along neither z nor -z.
pub(super) fn mirrored(record: &EntityRecord<'_, '_>) -> Result<bool, Flaw> {
    let [x, y] = [record.number_or(210, 0.0)?, record.number_or(220, 0.0)?];
    let z = record.number_or(230, 1.0)?;
    // AutoCAD takes an axis as the z axis below 1/64; here the plane must be that of the drawing to 1e-9.
    let upright = x.abs().max(y.abs()) <= 1e-9 * z.abs();
    if upright && z != 0.0 {
        Ok(z < 0.0)
    } else {
        Err(Flaw::Lost("It lies in another plane than the drawing and is left out.".into()))
    }
}

fn place(record: &EntityRecord<'_, '_>, code: i32) -> Result<Point, Flaw> {
    Ok(Point::new(record.number(code)?, record.number(code + 10)?))
}

fn line(record: &EntityRecord<'_, '_>) -> Result<Geometry, Flaw> {
    let (a, b) = (place(record, 10)?, place(record, 11)?);
    let heights = [record.number_or(30, 0.0)?, record.number_or(31, 0.0)?];
    Ok(flat(EntityShape::Chain(CurveChain::single(Piece::Line(a, b), a)), &heights))
}

fn point(record: &EntityRecord<'_, '_>) -> Result<Geometry, Flaw> {
    Ok(flat(EntityShape::Point(place(record, 10)?), &record.numbers(30)?))
}

fn circle(record: &EntityRecord<'_, '_>) -> Result<Geometry, Flaw> {
    let center = place(record, 10)?;
    let radius = record.number(40)?;
    if radius < 0.0 {
        return Err(
            record.flaw(format!("The radius of {} is {radius}; it must not be negative.", record.kind))
        );
    }
    let (start, sweep, closed) = if record.kind == "ARC" {
        let (start, end) = (record.number(50)?, record.number(51)?);
        let turn = (end - start).rem_euclid(360.0);
        (start.to_radians(), if turn == 0.0 { TAU } else { turn.to_radians() }, turn == 0.0)
    } else {
        (0.0, TAU, true)
    };
    let piece = Piece::arc(center, radius, start, sweep);
    let chain = CurveChain { closed, ..CurveChain::single(piece, center) };
    Ok(flat(EntityShape::Chain(chain), &record.numbers(30)?))
}

fn ellipse(record: &EntityRecord<'_, '_>) -> Result<Geometry, Flaw> {
    let center = place(record, 10)?;
    let major = Vec2::new(record.number(11)?, record.number(21)?);
    let ratio = record.number(40)?;
    if ratio <= 0.0 {
        return Err(
            record.flaw(format!("The ratio of axes of an ELLIPSE is {ratio}; it must be greater than 0."))
        );
    }
    let sign = if mirrored(record)? { -1.0 } else { 1.0 };
    let start = record.number_or(41, 0.0)? % TAU;
    let turn = (record.number_or(42, TAU)? - start).rem_euclid(TAU);
    // Ends are written with some digits of 2 pi; a gap below a millionth of a turn does not count.
    let closed = !(1e-6..=TAU - 1e-6).contains(&turn);
    let sweep = if closed { TAU } else { turn };
    let piece = Piece::ellipse(center, [major, major.perp() * (ratio * sign)], start, sweep);
    let mut heights = record.numbers(30)?;
    let rise = record.number_or(31, 0.0)?;
    heights.extend(heights.first().copied().map(|z| z + rise));
    Ok(flat(EntityShape::Chain(CurveChain { closed, ..CurveChain::single(piece, center) }), &heights))
}

fn spline(record: &EntityRecord<'_, '_>) -> Result<Geometry, Flaw> {
    let control = points(record, [10, 20])?;
    let flags = record.flags(70)?;
    let mut heights = record.numbers(30)?;
    if control.is_empty() {
        heights.extend(record.numbers(31)?);
        return fitted(record, flags & 1 != 0, &heights);
    }
    let degree = usize::try_from(record.flags(71)?).unwrap_or(0);
    let weights = record.numbers(41)?;
    if !weights.is_empty() && weights.len() != control.len() {
        let text = format!("A spline with {} points has {} weights.", control.len(), weights.len());
        return Err(record.flaw(text));
    }
    let start = control[0];
    let weights = weights.into_iter().chain(std::iter::repeat(1.0));
    let points = control.into_iter().zip(weights).collect();
    let nurbs = Nurbs { degree, knots: record.numbers(40)?, points };
    if let Some(text) = nurbs.finding() {
        return Err(record.flaw(text));
    }
    Ok(flat(EntityShape::Chain(CurveChain { pieces: nurbs.pieces(), closed: false, start }), &heights))
}

/// A spline that has fit points alone.
fn fitted(record: &EntityRecord<'_, '_>, closed: bool, heights: &[f64]) -> Result<Geometry, Flaw> {
    let fit = points(record, [11, 21])?;
    if fit.len() < 2 {
        return Err(record.flaw("A SPLINE has neither control points nor two fit points.".into()));
    }
    let pieces = interpolated(&fit, [tangent(record, 12)?, tangent(record, 13)?], closed);
    let remark = Some("It has fit points only; they are joined by a cubic spline, as CAD programs do.");
    Ok(Geometry { remark, ..flat(EntityShape::Chain(CurveChain { pieces, closed, start: fit[0] }), heights) })
}

/// The direction at an end of a spline, whose x has the code `code`; `None` if there is none.
fn tangent(record: &EntityRecord<'_, '_>, code: i32) -> Result<Option<Vec2>, Flaw> {
    let coordinates = record.optional(code)?.zip(record.optional(code + 10)?);
    Ok(coordinates.map(|(x, y)| Vec2::new(x, y)).filter(|v| v.length() > 0.0))
}

/// The points of two codes.
fn points(record: &EntityRecord<'_, '_>, codes: [i32; 2]) -> Result<Vec<Point>, Flaw> {
    let [x, y] = [record.numbers(codes[0])?, record.numbers(codes[1])?];
    if x.len() != y.len() {
        return Err(record.flaw(format!("{} has {} x and {} y coordinates.", record.kind, x.len(), y.len())));
    }
    Ok(x.into_iter().zip(y).map(|(x, y)| Point::new(x, y)).collect())
}
