//! A chamber of any outline, with islands and welds within it, and its mesh.

use crate::shell::mesh::sizing::Sizing;
use crate::shell::mesh::width::ChamberWalls;
use crate::shell::mesh::{Border, MeshFault, Meshed, Piece, Region, delaunay, rim};
use geom::{Bounds, Path, Point, Segment, Vec2, intersections};

/// One chamber between two sheets; lengths in any unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlatChamber {
    /// Sealed outline: closed, counterclockwise.
    pub outline: Path,
    /// Rims around holes in the fabric: closed, clockwise. They slide in the plane as the outline does.
    pub holes: Vec<Path>,
    /// Closed curves within which both sheets are welded to each other.
    pub islands: Vec<Path>,
    /// Open curves along which they are; they may end on the outline, on islands and on each other.
    pub welds: Vec<Path>,
}

/// Ends of welds that are nearer than this to a curve lie on it; by the widest width.
const MEETS: f64 = 5e-7;
/// Edges along walls by those within the chamber: the sheet is steepest there.
const ALONG_WALLS: f64 = 0.7;
/// Edges in the narrowest places by those in the widest.
const NARROWEST: f64 = 1.0 / 8.0;
/// Edges at a corner that points into the chamber by those within it: tension is largest there.
const AT_CORNERS: f64 = 1.0 / 8.0;
/// Corners that turn by less, rad, are smooth.
const SMOOTH: f64 = 0.35;
/// Turn of an arc along one edge, rad; on coarse meshes so many by their edges across the chamber, up to a sixth of a circle.
const TURN: f64 = 0.5;
const COARSE_TURN: f64 = 1.6;
const MOST_TURN: f64 = std::f64::consts::FRAC_PI_3;
/// Samples of a wall at most.
const MOST_SAMPLES: f64 = 1000.0;

impl FlatChamber {
    /// All its curves: outline, holes, islands, welds.
    pub fn curves(&self) -> impl Iterator<Item = &Path> {
        std::iter::once(&self.outline).chain(&self.holes).chain(&self.islands).chain(&self.welds)
    }

    /// Whether there is fabric at `p`.
    fn has_fabric(&self, p: Point) -> bool {
        self.outline.encloses(p) && !self.holes.iter().any(|hole| hole.encloses(p))
    }

    fn walls(&self) -> ChamberWalls {
        ChamberWalls::new(self.curves().flat_map(|path| path.segments.iter().copied()))
    }

    /// Whether there is air at `p`.
    pub fn has_air(&self, p: Point) -> bool {
        self.has_fabric(p) && !self.is_welded(p)
    }

    /// Whether `p` lies on an island.
    pub fn is_welded(&self, p: Point) -> bool {
        self.islands.iter().any(|island| island.encloses(p))
    }

    /// Flat area of one sheet, including islands.
    pub fn area(&self) -> f64 {
        self.outline.area() - self.holes.iter().map(|hole| hole.area().abs()).sum::<f64>()
    }

    /// Diameter of the largest circle that it holds, within 0.1 %.
    pub fn widest(&self) -> f64 {
        self.walls().widest(self.outline.bounds(), |p| self.has_air(p))
    }

    /// The chamber in units of `unit`.
    pub fn in_units(&self, unit: f64) -> Self {
        Self {
            outline: scaled(&self.outline, 1.0 / unit),
            holes: self.holes.iter().map(|path| scaled(path, 1.0 / unit)).collect(),
            islands: self.islands.iter().map(|path| scaled(path, 1.0 / unit)).collect(),
            welds: self.welds.iter().map(|path| scaled(path, 1.0 / unit)).collect(),
        }
    }

    /// The chamber's mesh with `cells` edges across the widest place, which is 1 wide. The numbers give the curve of each piece, in the order of
    /// [`FlatChamber::curves`].
    ///
    /// # Errors
    /// If curves cross or leave the outline, or the mesh has too many triangles.
    pub fn mesh(&self, cells: f64) -> Result<(Meshed, Vec<usize>), MeshFault> {
        if !(1.0..=200.0).contains(&cells) {
            return Err(MeshFault::Dimension { name: "edges a width", found: cells, allowed: "1 to 200" });
        }
        let (region, curve_of) = self.region()?;
        let meshed = delaunay::fill(&region, &self.sizing(&region, 1.0 / cells))?;
        Ok((meshed, curve_of))
    }

    /// The region, its curves parted where they meet.
    fn region(&self) -> Result<(Region, Vec<usize>), MeshFault> {
        let pieces_of_curves = parted(&self.curves().collect::<Vec<_>>());
        let holes = self.holes.len();
        let mut region = Region { pieces: Vec::new(), holes: Vec::new(), welds: Vec::new() };
        let mut curve_of = Vec::new();
        for (number, segments) in pieces_of_curves.into_iter().enumerate() {
            curve_of.extend(segments.iter().map(|_| number));
            let border = Border::Rim(match number {
                0 => rim::OUTER,
                hole if hole <= holes => rim::INNER,
                _ => rim::WELD,
            });
            let pieces = segments.into_iter().map(|curve| Piece { curve, border });
            match number {
                0 => region.pieces = pieces.collect(),
                hole if hole <= holes => region.holes.push(pieces.collect()),
                _ => region.welds.extend(pieces),
            }
        }
        for weld in &region.welds {
            let middle = weld.curve.point(0.5);
            let mut rims = self.curves().take(1 + holes);
            if !self.has_fabric(middle) && rims.all(|rim| rim.distance(middle) > MEETS) {
                return Err(MeshFault::Outside { at: [middle.x, middle.y] });
            }
        }
        Ok((region, curve_of))
    }

    /// Edges of length `coarse` within, shorter along walls, in narrow places and at corners that point inwards.
    fn sizing(&self, region: &Region, coarse: f64) -> Sizing {
        let walls = self.walls();
        let turn = (COARSE_TURN * coarse).clamp(TURN, MOST_TURN);
        let mut discs = Vec::new();
        for piece in region.all_pieces() {
            let is_weld = piece.border == Border::Rim(rim::WELD);
            let curve = piece.curve;
            let length = curve.length();
            let bow = if let Segment::Arc(arc) = curve { arc.radius * turn } else { f64::INFINITY };
            let count = (length / (0.5 * coarse)).ceil().clamp(1.0, MOST_SAMPLES);
            let mut step = 0.5;
            while step < count {
                let (p, tangent) = (curve.point(step / count), curve.tangent(step / count));
                let inward = tangent.perp();
                let left = walls.width(p, inward, 1.0);
                let right = if is_weld { walls.width(p, -inward, 1.0) } else { 1.0 };
                let size = coarse * (ALONG_WALLS * left.min(right)).max(NARROWEST);
                discs.push((p, 0.5 * length / count, size.min(bow).min(length)));
                step += 1.0;
            }
        }
        for path in self.curves() {
            discs.extend(self.sharp_corners(path).map(|p| (p, 0.0, coarse * AT_CORNERS)));
        }
        Sizing::on_discs(coarse, discs)
    }

    /// Corners of `path` that point into the chamber, and the ends of open curves.
    fn sharp_corners<'a>(&'a self, path: &'a Path) -> impl Iterator<Item = Point> + 'a {
        let count = path.segments.len();
        let joints = (0..count).filter(move |at| path.closed || at + 1 < count);
        let corners = joints.filter_map(move |at| {
            let (before, after) =
                (path.segments[at].tangent(1.0), path.segments[(at + 1) % count].tangent(0.0));
            let turn = libm::atan2(before.cross(after), before.dot(after));
            let corner = path.segments[at].end();
            // A step along the bisector, away from the corner, is in the air if the corner points into it.
            let ahead = Vec2::new(before.x - after.x, before.y - after.y).normalized();
            (turn.abs() > SMOOTH && self.has_air(corner + ahead * 1e-6)).then_some(corner)
        });
        let ends = [path.start(), path.end()].into_iter().flatten().filter(move |_| !path.closed);
        corners.chain(ends)
    }
}

fn scaled(path: &Path, factor: f64) -> Path {
    let segments = path.segments.iter().map(|segment| match *segment {
        Segment::Line(line) => Segment::Line(scaled_line(line, factor)),
        Segment::Arc(arc) => {
            let center = scaled_point(arc.center, factor);
            Segment::Arc(geom::Arc { center, radius: factor * arc.radius, ..arc })
        }
    });
    Path { segments: segments.collect(), closed: path.closed }
}

/// `line` with lengths `factor` times as long.
pub(in crate::shell) fn scaled_line(line: geom::Line, factor: f64) -> geom::Line {
    geom::Line::new(scaled_point(line.start, factor), scaled_point(line.end, factor))
}

fn scaled_point(p: Point, factor: f64) -> Point {
    Point::new(factor * p.x, factor * p.y)
}

/// The segments of each curve, cut where another curve meets them.
fn parted(curves: &[&Path]) -> Vec<Vec<Segment>> {
    // A segment is cut at its crossings with other curves, and where an open curve ends on it. Cuts closer together
    // than the tolerance are one. Boxes leave out the curves that are too far away.
    let boxes: Vec<Vec<Bounds>> =
        curves.iter().map(|path| path.segments.iter().map(Segment::bounds).collect()).collect();
    let bounds_of: Vec<Bounds> = curves.iter().map(|path| path.bounds().outset(MEETS)).collect();
    let cuts = |own: usize, at: usize| {
        let segment = &curves[own].segments[at];
        let bounds = boxes[own][at].outset(MEETS);
        let mut cuts = vec![0.0, 1.0];
        for (other, path) in curves.iter().enumerate() {
            if other == own || !bounds_of[other].overlaps(&bounds) {
                continue;
            }
            let crossings = path.segments.iter().zip(&boxes[other]).filter(|(_, b)| b.overlaps(&bounds));
            let mut hits: Vec<Point> =
                crossings.flat_map(|(crossing, _)| intersections(segment, crossing)).collect();
            if !path.closed {
                let ends = [path.start(), path.end()].into_iter().flatten();
                hits.extend(ends.filter(|end| segment.distance(*end) < MEETS));
            }
            cuts.extend(hits.into_iter().map(|hit| segment.nearest_fraction(hit)));
        }
        cuts.sort_by(f64::total_cmp);
        let smallest_step = 2.0 * MEETS / segment.length();
        cuts.dedup_by(|b, a| *b - *a < smallest_step);
        if let Some(last) = cuts.last_mut() {
            *last = 1.0;
        }
        cuts
    };
    let parts = |own: usize| {
        let path = curves[own];
        (0..path.segments.len()).flat_map(move |at| {
            let fractions = cuts(own, at);
            let segment = path.segments[at];
            fractions
                .windows(2)
                .map(|cut| if *cut == [0.0, 1.0] { segment } else { segment.part(cut[0], cut[1]) })
                .collect::<Vec<_>>()
        })
    };
    (0..curves.len()).map(|own| parts(own).collect()).collect()
}
