//! STL: a drawing's outermost path extruded, with every other closed path as a hole through it.
//!
//! Binary, in millimetres, the lower face at Z 0. Top and bottom are one triangulation; the walls stand on the
//! edges that it uses once, so the solid is closed whatever the triangulation did with points in line.

use std::collections::BTreeMap;

use earcut::Earcut;

use crate::design::{Drawing, Layer};
use crate::emit::number::Decimals;
use crate::geom::{Path, Point, Segment};

/// How far a chord may leave its arc, mm: a fifth of what a fine printer resolves.
const CHORD: f64 = 0.02;

/// Decimals of a coordinate; single precision tells them apart up to several metres.
const DECIMALS: u32 = 3;

/// The plate of a mask's `drawing`, `thickness` high.
pub fn stl(drawing: &Drawing, thickness: f64) -> Vec<u8> {
    let on = |layer: Layer| drawing.layers.iter().filter(move |(l, _)| *l == layer).flat_map(|(_, s)| s);
    let plate = on(Layer::MaskPlate);
    let holes = on(Layer::MaskWindow).chain(on(Layer::Registration));
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut starts: Vec<u32> = Vec::new();
    for path in plate.chain(holes).flat_map(|shape| shape.paths().into_owned()) {
        starts.push(index(points.len()));
        points.extend(corners(&path));
    }
    let mut triangles: Vec<u32> = Vec::new();
    Earcut::new().earcut(points.iter().copied(), starts.get(1..).unwrap_or_default(), &mut triangles);
    let faces: Vec<[u32; 3]> =
        triangles.chunks_exact(3).map(|t| upwards(&points, [t[0], t[1], t[2]])).collect();
    let mut writer = Writer { points: &points, out: Vec::new(), count: 0 };
    writer.out.extend([b' '; 80]);
    writer.out.extend([0; 4]);
    for [a, b, c] in &faces {
        writer.facet([(*a, thickness), (*b, thickness), (*c, thickness)], [0.0, 0.0, 1.0]);
        writer.facet([(*a, 0.0), (*c, 0.0), (*b, 0.0)], [0.0, 0.0, -1.0]);
    }
    for (a, b) in border(&faces) {
        writer.wall(a, b, thickness);
    }
    let count = writer.count.to_le_bytes();
    let mut out = writer.out;
    out[80..84].copy_from_slice(&count);
    out
}

fn index(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// The corners of a path as a polygon, rounded; no two neighbours are the same.
fn corners(path: &Path) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::new();
    for segment in &path.segments {
        let count = pieces(segment);
        let mut i = 0.0;
        while i < count {
            let Point { x, y } = Decimals::exactly(DECIMALS).round_point(segment.point(i / count));
            if out.last() != Some(&[x, y]) {
                out.push([x, y]);
            }
            i += 1.0;
        }
    }
    if out.len() > 1 && out.first() == out.last() {
        let _ = out.pop();
    }
    out
}

/// Number of chords that stay within [`CHORD`] of an arc: r (1 - cos(sweep / 2)) each.
fn pieces(segment: &Segment) -> f64 {
    let Segment::Arc(arc) = segment else { return 1.0 };
    let widest = 2.0 * (1.0 - (CHORD / arc.radius).min(1.0)).acos();
    (arc.sweep.abs() / widest).ceil().max(1.0)
}

/// The triangle counterclockwise from above.
fn upwards(points: &[[f64; 2]], [a, b, c]: [u32; 3]) -> [u32; 3] {
    let at = |i: u32| points[i as usize];
    let ([ax, ay], [bx, by], [cx, cy]) = (at(a), at(b), at(c));
    if (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// The directed edges that no other triangle has the other way round, sorted.
fn border(faces: &[[u32; 3]]) -> Vec<(u32, u32)> {
    let mut uses: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    for [a, b, c] in faces {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            *uses.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    let edges = uses.into_iter().filter(|(_, uses)| *uses != 0);
    edges.map(|((low, high), uses)| if uses > 0 { (low, high) } else { (high, low) }).collect()
}

struct Writer<'a> {
    points: &'a [[f64; 2]],
    out: Vec<u8>,
    count: u32,
}

impl Writer<'_> {
    /// Two triangles below the edge from `a` to `b`, whose left side is solid.
    fn wall(&mut self, a: u32, b: u32, top: f64) {
        let ([ax, ay], [bx, by]) = (self.points[a as usize], self.points[b as usize]);
        let length = (bx - ax).hypot(by - ay);
        let normal = [(by - ay) / length, (ax - bx) / length, 0.0];
        self.facet([(a, top), (a, 0.0), (b, 0.0)], normal);
        self.facet([(a, top), (b, 0.0), (b, top)], normal);
    }

    fn facet(&mut self, corners: [(u32, f64); 3], normal: [f64; 3]) {
        let mut number = |x: f64| {
            #[expect(clippy::cast_possible_truncation, reason = "STL is single precision, see DECIMALS")]
            let single = x as f32;
            self.out.extend(single.to_le_bytes());
        };
        normal.into_iter().for_each(&mut number);
        for (i, z) in corners {
            let [x, y] = self.points[i as usize];
            [x, y, z].into_iter().for_each(&mut number);
        }
        self.out.extend([0, 0]);
        self.count += 1;
    }
}
