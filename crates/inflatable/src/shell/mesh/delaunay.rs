//! A region filled with triangles: points on its border and welds at the density of the sizing, **seeds** within by Delaunay insertion
//! of circumcentres, evened out by moving each to the middle of its triangles.
//!
//! Order is fixed and predicates are exact, so the same region gives the same bits.

use std::collections::BTreeMap;

use spade::handles::VertexHandle;
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, Point2, PositionInTriangulation, Triangulation};

use crate::shell::mesh::sizing::Sizing;
use crate::shell::mesh::{MeshFault, Meshed, Piece, Region, angles, signed_area};
use geom::{Point, Segment};

type Triangles = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// More seeds or border points than this are no mesh to begin with: 200,000 unknowns before the first refinement.
const MOST: usize = 30_000;

/// Circumradius above which a triangle gets a point in its middle, over the requested size; edges come out near that size, as a
/// test asserts.
const LARGE: f64 = 0.7;

/// Distance of seeds from the border, over the requested size: nearer, triangles at the border get flat.
const CLEAR: f64 = 0.5;

/// Ends of welds that are nearer to a point, in the mesh's unit, are that point.
const SAME: f64 = 1e-6;

/// Rounds of evening out. Chosen, not tuned.
const ROUNDS: usize = 20;

/// Fills `region` with triangles of the sizes in `sizing`.
pub(super) fn fill(region: &Region, sizing: &Sizing) -> Result<Meshed, MeshFault> {
    let border = BorderPoints::new(region, sizing);
    let (points, triangles) = fill_border(&border, sizing)?;
    let pieces = region.all_pieces().copied().collect();
    Meshed::new(points, triangles, pieces, &border.pieces())
}

/// Points, and the corners of triangles by the numbers of those.
pub(super) type PointsAndTriangles = (Vec<[f64; 2]>, Vec<[usize; 3]>);

/// Points, those of the border first, and triangles within `border`, as small as `sizing` asks for.
pub(super) fn fill_border(border: &BorderPoints, sizing: &Sizing) -> Result<PointsAndTriangles, MeshFault> {
    if border.points.len() > MOST {
        return Err(MeshFault::TooMany { most: MOST });
    }
    let mut seeds = border.seeds(sizing)?;
    // The last rounds still exchange a triangle here and there: the round with the widest smallest angle is taken.
    let mut best = (0.0, seeds.clone());
    for _ in 0..ROUNDS {
        let former_seeds = seeds.clone();
        let smallest = border.even_out(&mut seeds, sizing)?;
        if smallest > best.0 {
            best = (smallest, former_seeds);
        }
    }
    let seeds = best.1;
    let points = border.points.iter().chain(&seeds).map(|p| [p.x, p.y]).collect();
    Ok((points, border.inner(&border.triangulation(&seeds)?)))
}

/// The points of a border, counterclockwise, then those of the welds within it, and the edges between them.
pub(super) struct BorderPoints {
    points: Vec<Point>,
    /// Ends of each edge and the piece that it lies on; those of the border first, with the region on their left.
    edges: Vec<([usize; 2], usize)>,
    /// The number of edges of the border.
    outer: usize,
}

impl BorderPoints {
    /// One closed loop, counterclockwise: its points, and the piece that the edge from each to the next lies on.
    pub(super) fn closed(points: Vec<Point>, pieces: &[usize]) -> Self {
        let count = points.len();
        let edges = pieces.iter().enumerate().map(|(at, piece)| ([at, (at + 1) % count], *piece)).collect();
        Self { points, edges, outer: count }
    }

    fn new(region: &Region, sizing: &Sizing) -> Self {
        let mut border = Self { points: Vec::new(), edges: Vec::new(), outer: 0 };
        let mut piece = 0;
        for pieces in std::iter::once(&region.pieces).chain(&region.holes) {
            border.add_loop(pieces, sizing, piece);
            piece += pieces.len();
        }
        border.outer = border.edges.len();
        for (index, weld) in region.welds.iter().enumerate() {
            border.add_weld(sizing.divide(&weld.curve), weld.curve.end(), piece + index);
        }
        border
    }

    /// Adds a closed loop, whose pieces are numbered from `first`.
    fn add_loop(&mut self, pieces: &[Piece], sizing: &Sizing, first: usize) {
        let start = self.points.len();
        let mut piece = Vec::new();
        let previous_pieces = pieces.iter().cycle().skip(pieces.len().saturating_sub(1));
        for (index, (this, previous_pieces)) in pieces.iter().zip(previous_pieces).enumerate() {
            let mut run = sizing.divide(&this.curve);
            // A line's ends are given, those of an arc are computed.
            if let (Segment::Line(line), Some(first)) = (previous_pieces.curve, run.first_mut()) {
                *first = line.end;
            }
            piece.extend(run.iter().map(|_| first + index));
            self.points.extend(run);
        }
        let count = piece.len();
        let edges = piece.into_iter().enumerate();
        self.edges.extend(edges.map(|(at, piece)| ([start + at, start + (at + 1) % count], piece)));
    }

    /// Adds a piece of weld through `run` to `end`; points that are there already are shared.
    fn add_weld(&mut self, run: Vec<Point>, end: Point, piece: usize) {
        let mut previous = None;
        let last = run.len();
        for (at, p) in run.into_iter().chain([end]).enumerate() {
            let is_end = at == 0 || at == last;
            let existing = self.points.iter().position(|q| is_end && q.distance(p) < SAME);
            let point = existing.unwrap_or_else(|| {
                self.points.push(p);
                self.points.len() - 1
            });
            if let Some(previous) = previous.filter(|previous| *previous != point) {
                self.edges.push(([previous, point], piece));
            }
            previous = Some(point);
        }
    }

    pub(super) fn pieces(&self) -> BTreeMap<[usize; 2], usize> {
        self.edges.iter().map(|&([a, b], piece)| ([a.min(b), a.max(b)], piece)).collect()
    }

    /// The edges of the border by their points.
    fn outer(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        self.edges[..self.outer].iter().map(|(ends, _)| ends.map(|end| self.points[end]))
    }

    /// The Delaunay triangulation of border and seeds, vertex `i` at point `i`, with the border's edges in it.
    fn triangulation(&self, seeds: &[Point]) -> Result<Triangles, MeshFault> {
        let mut triangles = Triangles::new();
        for (at, p) in self.points.iter().chain(seeds).enumerate() {
            let vertex = triangles.insert(Point2::new(p.x, p.y));
            if vertex.ok().is_none_or(|vertex| vertex.index() != at) {
                return Err(MeshFault::BorderLost { ends: [at, at] });
            }
        }
        let vertices: Vec<_> = triangles.fixed_vertices().collect();
        for &(ends, _) in &self.edges {
            let [a, b] = ends.map(|end| vertices[end]);
            if triangles.can_add_constraint(a, b) {
                let _ = triangles.add_constraint(a, b);
            }
            if !triangles.exists_constraint(a, b) {
                return Err(MeshFault::BorderLost { ends });
            }
        }
        Ok(triangles)
    }

    /// The triangles to the left of the border and on both sides of welds, and all that are reached from them without crossing it. (A test whether a
    /// triangle's middle lies within would fail for flat ones between points of one line.)
    fn inner(&self, triangulation: &Triangles) -> Vec<[usize; 3]> {
        let vertices: Vec<_> = triangulation.fixed_vertices().collect();
        let mut is_within = vec![false; triangulation.num_all_faces()];
        let edges = self.edges.iter().map(|(ends, _)| ends.map(|end| vertices[end]));
        let edges = edges.filter_map(|[a, b]| triangulation.get_edge_from_neighbors(a, b));
        let mut open: Vec<_> = edges
            .enumerate()
            .flat_map(|(at, edge)| [Some(edge), (at >= self.outer).then(|| edge.rev())])
            .filter_map(|edge| edge?.face().as_inner())
            .collect();
        while let Some(face) = open.pop() {
            if !std::mem::replace(&mut is_within[face.index()], true) {
                let open_edges = face.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge());
                open.extend(open_edges.filter_map(|edge| edge.rev().face().as_inner()));
            }
        }
        let inner = triangulation.inner_faces().filter(|face| is_within[face.index()]);
        inner.map(|face| face.vertices().map(|vertex| vertex.fix().index())).collect()
    }

    fn encloses(&self, p: Point) -> bool {
        let crosses = |&[a, b]: &[Point; 2]| {
            let rises = (a.y <= p.y) != (b.y <= p.y);
            rises && ((b - a).cross(p - a) > 0.0) == (b.y > a.y)
        };
        self.outer().filter(crosses).count() % 2 == 1
    }

    /// Whether `p` lies within the border, at least `clear` away from it and from welds.
    fn has_room(&self, p: Point, clear: f64) -> bool {
        let is_near = |(ends, _): &([usize; 2], usize)| {
            let [a, b] = ends.map(|end| self.points[end]);
            let chord = b - a;
            let t = ((p - a).dot(chord) / chord.dot(chord)).clamp(0.0, 1.0);
            (a + chord * t).distance(p) < clear
        };
        self.encloses(p) && !self.edges.iter().any(is_near)
    }

    /// Seeds until no triangle is too large: the circumcentre of the largest first, pass by pass.
    fn seeds(&self, sizing: &Sizing) -> Result<Vec<Point>, MeshFault> {
        // A triangle is too large if its circumcircle exceeds the size wanted at its centre. All such centres of a
        // pass are tried, the largest first, and those too near to a point or to the border are left out. The order is
        // by size, then by place, so that every machine makes the same mesh.
        let mut seeds = Vec::new();
        let mut triangulation = self.triangulation(&seeds)?;
        loop {
            let mut large: Vec<(f64, Point)> = Vec::new();
            for corners in self.inner(&triangulation) {
                let [a, b, c] = corners.map(|at| point_of(at, &self.points, &seeds));
                let center = circumcenter(a, b, c);
                let excess = center.distance(a) / sizing.edge_length(center);
                if excess > LARGE {
                    large.push((excess, center));
                }
            }
            large
                .sort_by(|(a, p), (b, q)| b.total_cmp(a).then(p.x.total_cmp(&q.x)).then(p.y.total_cmp(&q.y)));
            let former_count = seeds.len();
            for (_, p) in large {
                let size = sizing.edge_length(p);
                let is_clear =
                    clear_of_points(&triangulation, p, LARGE * size) && self.has_room(p, CLEAR * size);
                if is_clear && triangulation.insert(Point2::new(p.x, p.y)).is_ok() {
                    seeds.push(p);
                }
            }
            if seeds.len() == former_count {
                return Ok(seeds);
            }
            if seeds.len() > MOST {
                return Err(MeshFault::TooMany { most: MOST });
            }
        }
    }

    /// Moves each seed to the mean of its triangles' centres, weighted so that small triangles stay at their places,
    /// and returns the smallest angle before the move.
    fn even_out(&self, seeds: &mut [Point], sizing: &Sizing) -> Result<f64, MeshFault> {
        let border = self.points.len();
        let mut sums = vec![[0.0; 3]; seeds.len()];
        let mut smallest = f64::MAX;
        for corners in self.inner(&self.triangulation(seeds)?) {
            let [a, b, c] = corners.map(|at| point_of(at, &self.points, seeds));
            smallest = angles([a, b, c].map(|p| [p.x, p.y])).into_iter().fold(smallest, f64::min);
            let middle = Point::new((a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0);
            let weight = signed_area([a, b, c].map(|p| [p.x, p.y])) / sizing.edge_length(middle).powi(3);
            for seed in corners.into_iter().filter_map(|corner| corner.checked_sub(border)) {
                let [sum, x, y] = sums[seed];
                sums[seed] = [sum + weight, x + weight * middle.x, y + weight * middle.y];
            }
        }
        for (seed, [sum, x, y]) in seeds.iter_mut().zip(sums) {
            if sum > 0.0 {
                *seed = Point::new(x / sum, y / sum);
            }
        }
        Ok(smallest)
    }
}

fn point_of(index: usize, border: &[Point], seeds: &[Point]) -> Point {
    index.checked_sub(border.len()).map_or_else(|| border[index], |seed| seeds[seed])
}

/// Whether the corners of the triangle in which `p` lies are at least `clear` away from it.
fn clear_of_points(triangulation: &Triangles, p: Point, clear: f64) -> bool {
    let is_far = |vertex: VertexHandle<'_, Point2<f64>, (), CdtEdge<()>>| {
        let q = vertex.position();
        Point::new(q.x, q.y).distance(p) >= clear
    };
    match triangulation.locate(Point2::new(p.x, p.y)) {
        PositionInTriangulation::OnFace(face) => triangulation.face(face).vertices().into_iter().all(is_far),
        PositionInTriangulation::OnEdge(edge) => {
            triangulation.directed_edge(edge).vertices().into_iter().all(is_far)
        }
        _ => false,
    }
}

fn circumcenter(a: Point, b: Point, c: Point) -> Point {
    let (u, v) = (b - a, c - a);
    let (uu, vv) = (u.dot(u), v.dot(v));
    let scale = 0.5 / u.cross(v);
    a + (-(u * vv).perp() + (v * uu).perp()) * -scale
}
