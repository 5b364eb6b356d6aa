//! Display meshes: triangles from lyon's tessellators, for the eye only. Printed solids have a path of their own, exact and
//! closed ([`mod@crate::emit::stl`]).

use std::f64::consts::TAU;

use lyon_tessellation::geometry_builder::{BuffersBuilder, Positions};
use lyon_tessellation::math::point;
use lyon_tessellation::path::Path as Outline;
use lyon_tessellation::{
    FillOptions, FillTessellator, LineJoin, StrokeOptions, StrokeTessellator, VertexBuffers,
};

use crate::emit::chords::chords;
use geom::{Path, Point};
use program::number::single;

/// Largest distance of a chord from its arc, mm: a tenth of a pixel where a star fills a screen. A region with an arc on either
/// side is too narrow by twice that, which with single precision must stay below the tenth that the verifier allows.
const CHORD: f64 = 0.045;
/// Height of ribbons over the fabric that they lie on, mm, so that they are seen.
const ABOVE: f64 = 0.3;
/// Pieces of a wire, times its points, so that it lies on a curved surface: a line of 120 mm has pieces of 2.5 mm.
const WIRE_STEPS: u32 = 96;

/// Triangles in mm, +Z up, counterclockwise seen from outside, or from above where there is only one side.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Mesh {
    /// Corners of the triangles.
    pub(super) points: Vec<[f64; 3]>,
    /// The places of the same corners when the star is inflated; empty for a mesh that does not move.
    pub(super) inflated: Vec<[f64; 3]>,
    /// Three corners each.
    pub(super) triangles: Vec<[u32; 3]>,
}

type Buffers = VertexBuffers<lyon_tessellation::math::Point, u32>;

impl Mesh {
    /// The region inside an odd number of `paths`, at height `z`; `None` where the tessellator fails.
    pub(super) fn fill(paths: &[Path], z: f64) -> Option<Self> {
        let mut buffers = Buffers::new();
        FillTessellator::new()
            .tessellate_path(
                &outline(paths),
                &FillOptions::even_odd(),
                &mut BuffersBuilder::new(&mut buffers, Positions),
            )
            .ok()?;
        Some(Self::flat(&buffers, z))
    }

    /// Ribbons of `width` along `paths`, round at corners, above the fabric; `None` where the tessellator has no answer.
    pub(super) fn ribbons(paths: &[Path], width: f64) -> Option<Self> {
        let mut buffers = Buffers::new();
        // lyon is single precision, and a display needs no more.
        let options = StrokeOptions::tolerance(single(CHORD)).with_line_width(single(width));
        StrokeTessellator::new()
            .tessellate_path(
                &outline(paths),
                &options.with_line_join(LineJoin::Round),
                &mut BuffersBuilder::new(&mut buffers, Positions),
            )
            .ok()?;
        Some(Self::flat(&buffers, ABOVE))
    }

    /// The solid between two heights inside the first of `paths` and outside the others, which lie in it.
    pub(super) fn extruded(paths: &[Path], [low, high]: [f64; 2]) -> Option<Self> {
        let mut solid = Self::fill(paths, high)?;
        let bottom = Self::fill(paths, low)?;
        solid.append(Self {
            triangles: bottom.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect(),
            ..bottom
        });
        for (path, is_hole) in paths.iter().zip(std::iter::once(false).chain(std::iter::repeat(true))) {
            solid.wall(&chords(path, CHORD), is_hole, [low, high]);
        }
        Some(solid)
    }

    /// The solid that a closed curve of `[radius, height]`, from the axis outwards and back to it, makes when it is turned around it.
    pub(super) fn turned(curve: &[[f64; 2]]) -> Self {
        let widest = curve.iter().map(|[radius, _]| *radius).fold(0.0, f64::max);
        let count_around = quarters(widest);
        let mut surface = Self::default();
        for pair in curve.windows(2) {
            for k in 0..count_around {
                let corners = [(pair[0], k), (pair[0], k + 1), (pair[1], k + 1), (pair[1], k)];
                surface.quad(corners.map(|([radius, z], k)| {
                    let p = Point::polar(radius, TAU * f64::from(k % count_around) / f64::from(count_around));
                    [p.x, p.y, z]
                }));
            }
        }
        surface
    }

    /// Takes the wall on a closed polygon, too, its outside where the solid is not.
    fn wall(&mut self, corners: &[Point], is_hole: bool, [low, high]: [f64; 2]) {
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let doubled: f64 = edges.clone().map(|(p, next)| p.x * next.y - p.y * next.x).sum();
        // The solid has to lie on the left: counterclockwise around it, clockwise around a hole.
        let turned = (doubled < 0.0) != is_hole;
        for (p, next) in edges {
            let (from, to) = if turned { (next, p) } else { (p, next) };
            self.quad([[from.x, from.y, low], [to.x, to.y, low], [to.x, to.y, high], [from.x, from.y, high]]);
        }
    }

    /// Takes two triangles between these corners, too.
    fn quad(&mut self, corners: [[f64; 3]; 4]) {
        let triangles = vec![[0, 1, 2], [0, 2, 3]];
        self.append(Self { points: corners.into(), inflated: Vec::new(), triangles });
    }

    /// Takes the triangles of `other`, too.
    pub(super) fn append(&mut self, other: Self) {
        let offset = index(self.points.len());
        self.points.extend(other.points);
        self.inflated.extend(other.inflated);
        self.triangles.extend(other.triangles.into_iter().map(|corners| corners.map(|i| i + offset)));
    }

    /// The mesh with corners that `inflate` carries elsewhere.
    pub(super) fn inflating(self, inflate: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let inflated = self.points.iter().map(|p| inflate(*p)).collect();
        Self { inflated, ..self }
    }

    /// A wire of `radius` along `points` on the upper sheet of this fabric, which carries it: a square across, with an edge on top.
    pub(super) fn wire(&self, points: &[Point], radius: f64) -> Self {
        let mut wire = Self::default();
        let step_count = (WIRE_STEPS / index(points.len().max(1))).max(1);
        for pair in points.windows(2) {
            let side = (pair[1] - pair[0]).normalized().perp() * radius;
            let section =
                [[side.x, side.y, 0.0], [0.0, 0.0, radius], [-side.x, -side.y, 0.0], [0.0, 0.0, -radius]];
            let mut piece = Self::default();
            for step in 0..=step_count {
                let place = pair[0].lerp(pair[1], f64::from(step) / f64::from(step_count));
                let position = self.carried(place);
                for [x, y, z] in section {
                    piece.points.push([place.x + x, place.y + y, z]);
                    piece.inflated.push([position[0] + x, position[1] + y, position[2] + z]);
                }
            }
            for (ring, corner) in (0..step_count).flat_map(|ring| (0..4).map(move |corner| (ring, corner))) {
                let [low, high] = [corner, (corner + 1) % 4].map(|corner| 4 * ring + corner);
                piece.triangles.extend([[low, high, high + 4], [low, high + 4, low + 4]]);
            }
            wire.append(piece);
        }
        wire
    }

    /// The place to which the fabric carries a point of its upper sheet when it inflates: linear in the triangle that holds the point, or is
    /// nearest to it. Triangles of the lower sheet are clockwise.
    fn carried(&self, place: Point) -> [f64; 3] {
        let (mut least_share, mut position) = (f64::NEG_INFINITY, [place.x, place.y, 0.0]);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| {
                let [x, y, _] = self.points[corner as usize];
                Point::new(x, y)
            });
            let area = (b - a).cross(c - a);
            let shares = [(b, c), (c, a), (a, b)].map(|(from, to)| (from - place).cross(to - place) / area);
            let share = shares.iter().copied().fold(f64::INFINITY, f64::min);
            if area > 0.0 && share > least_share {
                least_share = share;
                let corners = triangle.map(|corner| self.inflated[corner as usize]);
                position = std::array::from_fn(|axis| (0..3).map(|k| shares[k] * corners[k][axis]).sum());
            }
        }
        position
    }

    fn flat(buffers: &Buffers, z: f64) -> Self {
        let points: Vec<[f64; 3]> =
            buffers.vertices.iter().map(|p| [f64::from(p.x), f64::from(p.y), z]).collect();
        let upwards = |corners: &[u32]| {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            let [[x1, y1, _], [x2, y2, _], [x3, y3, _]] = [a, b, c].map(|i| points[i as usize]);
            if (x2 - x1) * (y3 - y1) - (y2 - y1) * (x3 - x1) < 0.0 { [a, c, b] } else { [a, b, c] }
        };
        let triangles = buffers.indices.chunks_exact(3).map(upwards).collect();
        Self { points, inflated: Vec::new(), triangles }
    }
}

/// Into how many chords a circle of this radius, mm, is divided: fours, so that it is as wide as it should be along both axes.
pub(super) fn quarters(radius: f64) -> u32 {
    let step = 8.0 * libm::acos(1.0 - (CHORD / radius.max(CHORD)).min(1.0));
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 4 and a few thousand"
    )]
    let fours = (TAU / step).ceil().clamp(4.0, 512.0) as u32;
    4 * fours
}

/// A number of corners; no mesh here has as many as would not fit.
pub(super) fn index(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// The paths for lyon. Their arcs are chords already, cut in double precision.
fn outline(paths: &[Path]) -> Outline {
    let mut builder = Outline::builder();
    for path in paths {
        let mut corners = chords(path, CHORD).into_iter().map(|p| point(single(p.x), single(p.y)));
        let Some(first) = corners.next() else { continue };
        let _ = builder.begin(first);
        for corner in corners {
            let _ = builder.line_to(corner);
        }
        builder.end(path.closed);
    }
    builder.build()
}
