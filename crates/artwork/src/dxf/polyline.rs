//! Polylines: chains of lines and arcs, given by points and bulges.

use geom::Point;

use super::geometry::{EntityShape, Geometry, flat};
use super::group::{EntityRecord, Flaw};
use crate::collector::{CurveChain, bulged};
use crate::piece::Piece;

/// A vertex and the bulge of the piece behind it.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    point: Point,
    bulge: f64,
}

/// LWPOLYLINE: all vertices in one entity.
pub(super) fn light(record: &EntityRecord<'_, '_>) -> Result<Geometry, Flaw> {
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut missing = false;
    for (i, group) in record.groups.iter().enumerate() {
        match (group.code, vertices.last_mut()) {
            (10, _) => {
                missing |= vertices.last().is_some_and(|vertex| vertex.point.y.is_nan());
                // The y follows; NaN marks that it has not come.
                vertices.push(Vertex { point: Point::new(record.parse(i, group)?, f64::NAN), bulge: 0.0 });
            }
            (20, Some(vertex)) => vertex.point.y = record.parse(i, group)?,
            (42, Some(vertex)) => vertex.bulge = record.parse(i, group)?,
            _ => {}
        }
    }
    if missing || vertices.last().is_some_and(|vertex| vertex.point.y.is_nan()) {
        return Err(record.flaw("A vertex of LWPOLYLINE has no y (code 20).".into()));
    }
    chain(record, &vertices, record.flags(70)? & 1 != 0, &record.numbers(38)?)
}

/// POLYLINE: the vertices are entities of their own.
pub(super) fn heavy(record: &EntityRecord<'_, '_>, parts: &[EntityRecord<'_, '_>]) -> Result<Geometry, Flaw> {
    const FRAME: i64 = 16;
    let flags = record.flags(70)?;
    if flags & (16 | 64) != 0 {
        return Err(record.unknown()); // meshes
    }
    let mut vertices = Vec::with_capacity(parts.len());
    let mut heights = Vec::with_capacity(parts.len());
    for part in parts {
        // Control points of a smoothed polyline do not lie on it; its smoothed points are listed beside them.
        if part.flags(70)? & FRAME == 0 {
            let point = Point::new(part.number(10)?, part.number(20)?);
            vertices.push(Vertex { point, bulge: part.number_or(42, 0.0)? });
            heights.push(part.number_or(30, 0.0)?);
        }
    }
    chain(record, &vertices, flags & 1 != 0, &heights)
}

/// Whether the vertices are in world coordinates: a polyline in space.
pub(super) fn in_space(record: &EntityRecord<'_, '_>) -> Result<bool, Flaw> {
    Ok(record.kind == "POLYLINE" && record.flags(70)? & 8 != 0)
}

fn chain(
    record: &EntityRecord<'_, '_>,
    vertices: &[Vertex],
    closed: bool,
    heights: &[f64],
) -> Result<Geometry, Flaw> {
    let Some(first) = vertices.first() else {
        return Err(record.flaw(format!("{} has no vertices.", record.kind)));
    };
    let piece = |pair: &[Vertex]| bulged(pair[0].point, pair[1].point, pair[0].bulge);
    let mut pieces: Vec<Piece> = vertices.windows(2).map(piece).collect();
    if let Some(last) = vertices.last().filter(|_| closed && vertices.len() > 1) {
        pieces.push(bulged(last.point, first.point, last.bulge));
    }
    Ok(flat(EntityShape::Chain(CurveChain { pieces, closed, start: first.point }), heights))
}
