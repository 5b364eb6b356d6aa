//! The whole body of which one sheet was modelled, or a part of it: both sheets and all mirror images, closed.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use crate::shell::cases::shape::InflatedShape;

/// How the modelled sheet is repeated in the whole body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Both sheets alone: a chamber of any outline.
    Sheets,
    /// A mirror at y = 0: a V-actuator, of which one half was modelled.
    Mirror,
    /// This number of sectors around the z axis: a star, of which half a sector was modelled, from y = 0 to the ray at its end.
    Sectors(u32),
}

/// A closed surface in triangles, counterclockwise from outside. SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WholeBody {
    /// Positions of the points, m.
    pub points: Vec<[f64; 3]>,
    /// Their positions on the flat sheets, m.
    pub flat: Vec<[f64; 2]>,
    /// The points of each triangle: the upper sheet, then the lower one.
    pub triangles: Vec<[usize; 3]>,
    /// For each triangle the one of the modelled sheet of which it is an image.
    pub images: Vec<usize>,
    /// The points at which the sheets are sealed to each other, in order.
    pub sealed: Vec<usize>,
}

/// Largest distance of a point that lies on a mirror, by the size of the sheet.
const ON_MIRROR: f64 = 1e-7;

/// One image of the modelled sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Image {
    is_lower: bool,
    sector: u32,
    is_mirrored: bool,
}

/// Where a point of the modelled sheet lies: there it is one point of several images.
#[derive(Clone, Copy, Debug, Default)]
struct SharedPoint {
    by_first_mirror: bool,
    by_second_mirror: bool,
    is_sealed: bool,
}

impl Symmetry {
    /// That of a star with `points`, of which `sheet` was modelled: half a sector, or where the fabric is woven askew one whole sheet.
    pub fn of_star(points: u32, sheet: &InflatedShape) -> Self {
        let is_half = sheet.flat.iter().all(|[x, y]| *y >= -ON_MIRROR * x.abs());
        if is_half { Self::Sectors(points) } else { Self::Sheets }
    }

    /// Number of sectors.
    fn sectors(self) -> u32 {
        match self {
            Self::Sheets | Self::Mirror => 1,
            Self::Sectors(count) => count.max(1),
        }
    }

    /// All images, the upper sheet first.
    fn images(self) -> Vec<Image> {
        let mirrors: &[bool] = if self == Self::Sheets { &[false] } else { &[false, true] };
        let mut images = Vec::new();
        for is_lower in [false, true] {
            for sector in 0..self.sectors() {
                images.extend(mirrors.iter().map(|&is_mirrored| Image { is_lower, sector, is_mirrored }));
            }
        }
        images
    }

    /// Whether the flat point is on the first and on the second mirror of a sheet of this `size`.
    fn mirrors(self, [x, y]: [f64; 2], size: f64) -> [bool; 2] {
        let is_first = y.abs() <= ON_MIRROR * size;
        match self {
            Self::Sheets => [false, false],
            Self::Mirror => [is_first, false],
            Self::Sectors(_) => {
                let (sine, cosine) = libm::sincos(PI / f64::from(self.sectors()));
                [is_first, (x * sine - y * cosine).abs() <= ON_MIRROR * size]
            }
        }
    }

    /// The flat point, or the first two coordinates of another, in `image`.
    fn turned(self, image: Image, [x, y]: [f64; 2]) -> [f64; 2] {
        let y = if image.is_mirrored { -y } else { y };
        if image.sector == 0 {
            return [x, y];
        }
        let turn = 2.0 * PI * f64::from(image.sector) / f64::from(self.sectors());
        let (sine, cosine) = libm::sincos(turn);
        [x * cosine - y * sine, x * sine + y * cosine]
    }

    /// The one of the images that share a point by which it is numbered.
    fn home(self, image: Image, shared: SharedPoint) -> Image {
        let mut home = image;
        home.is_lower &= !shared.is_sealed;
        if home.is_mirrored && shared.by_first_mirror {
            home.is_mirrored = false;
        } else if home.is_mirrored && shared.by_second_mirror {
            home = Image {
                is_mirrored: false,
                sector: (home.sector + self.sectors() - 1) % self.sectors(),
                ..home
            };
        }
        home
    }
}

/// Height above and below the plane of a point between two sealed ones, m: enough for files with single digits of a micrometre.
const PARTED: f64 = 1e-6;

impl WholeBody {
    /// Parts both sheets where they meet other than at the rims: along edges of the mesh from one sealed point to another, which have four
    /// triangles, and at welds and islands, whose points each sheet has for itself. Such an edge gets a point in its middle on each sheet.
    fn part_sheets(&mut self) {
        self.part_edges();
        let upper_count = self.triangles.len() / 2;
        for (number, corners) in self.triangles.iter().enumerate() {
            let height = if number < upper_count { PARTED } else { -PARTED };
            for point in corners.iter().filter(|point| self.sealed.binary_search(point).is_err()) {
                let z = &mut self.points[*point][2];
                if z.abs() < PARTED {
                    *z = height;
                }
            }
        }
    }

    /// Gives edges with four triangles a point in their middle on each sheet.
    fn part_edges(&mut self) {
        let mut counts: BTreeMap<[usize; 2], u32> = BTreeMap::new();
        for corners in &self.triangles {
            for side in 0..3 {
                *counts.entry(edge(corners, side)).or_default() += 1;
            }
        }
        let common: BTreeSet<[usize; 2]> =
            counts.into_iter().filter(|(_, count)| *count > 2).map(|(edge, _)| edge).collect();
        let upper_count = self.triangles.len() / 2;
        let triangles = std::mem::take(&mut self.triangles);
        let images = std::mem::take(&mut self.images);
        let mut middles: BTreeMap<(bool, [usize; 2]), usize> = BTreeMap::new();
        for (number, (corners, image)) in triangles.into_iter().zip(images).enumerate() {
            let is_lower = number >= upper_count;
            let mut parts = vec![corners];
            while let Some(corners) = parts.pop() {
                let Some(side) = (0..3).find(|side| common.contains(&edge(&corners, *side))) else {
                    self.triangles.push(corners);
                    self.images.push(image);
                    continue;
                };
                let ends = edge(&corners, side);
                let middle =
                    *middles.entry((is_lower, ends)).or_insert_with(|| self.add_middle(ends, is_lower));
                let [start, end, opposite] = [0, 1, 2].map(|turn| corners[(side + turn) % 3]);
                parts.extend([[middle, end, opposite], [start, middle, opposite]]);
            }
        }
    }

    /// Adds the point between two sealed ones on one of the sheets; its number.
    fn add_middle(&mut self, [start, end]: [usize; 2], is_lower: bool) -> usize {
        let [[x, y, _], [other_x, other_y, _]] = [start, end].map(|point| self.points[point]);
        let height = if is_lower { -PARTED } else { PARTED };
        self.points.push([f64::midpoint(x, other_x), f64::midpoint(y, other_y), height]);
        let [[u, v], [other_u, other_v]] = [start, end].map(|point| self.flat[point]);
        self.flat.push([f64::midpoint(u, other_u), f64::midpoint(v, other_v)]);
        self.points.len() - 1
    }
}

/// One side of a triangle by the numbers of its ends, the lower one first.
fn edge(corners: &[usize; 3], side: usize) -> [usize; 2] {
    let (start, end) = (corners[side], corners[(side + 1) % 3]);
    [start.min(end), start.max(end)]
}

impl InflatedShape {
    /// The whole body, closed. Every image of the sheet is added in turn. Points on a mirror and on a seal belong to several images and occur
    /// once: then neighbours share their edges, and each edge has two triangles.
    pub fn body(&self, symmetry: Symmetry) -> WholeBody {
        let shared_points = self.shared_points(symmetry);
        let mut body = WholeBody::default();
        let mut numbers: BTreeMap<(Image, usize), usize> = BTreeMap::new();
        for image in symmetry.images() {
            let is_flipped = image.is_lower != image.is_mirrored;
            for corners in &self.triangles {
                let [a, b, c] = corners.map(|point| {
                    let home = symmetry.home(image, shared_points[point]);
                    *numbers.entry((home, point)).or_insert_with(|| {
                        let [x, y, z] = self.points[point];
                        let [x, y] = symmetry.turned(image, [x, y]);
                        body.points.push([x, y, if image.is_lower { -z } else { z }]);
                        body.flat.push(symmetry.turned(image, self.flat[point]));
                        body.points.len() - 1
                    })
                });
                body.triangles.push(if is_flipped { [a, c, b] } else { [a, b, c] });
            }
            body.images.extend(0..self.triangles.len());
        }
        let sealed = numbers.iter().filter(|((_, point), _)| shared_points[*point].is_sealed);
        body.sealed = sealed.map(|(_, number)| *number).collect();
        body.sealed.sort_unstable();
        body.part_sheets();
        body
    }

    /// What each point shares. An edge of one triangle alone lies on a mirror if both of its ends do, else on a seal.
    fn shared_points(&self, symmetry: Symmetry) -> Vec<SharedPoint> {
        let size = self.flat.iter().flatten().fold(0.0, |size: f64, length| size.max(length.abs()));
        let mirrors: Vec<[bool; 2]> = self.flat.iter().map(|point| symmetry.mirrors(*point, size)).collect();
        let mut single = BTreeSet::new();
        for [a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let edge = (from.min(to), from.max(to));
                if !single.remove(&edge) {
                    let _ = single.insert(edge);
                }
            }
        }
        let mut shared: Vec<SharedPoint> = mirrors
            .iter()
            .map(|[first, second]| SharedPoint {
                by_first_mirror: *first,
                by_second_mirror: *second,
                is_sealed: false,
            })
            .collect();
        for (from, to) in single {
            let is_on_mirror = (0..2).any(|k| mirrors[*from][k] && mirrors[*to][k]);
            if !is_on_mirror {
                for end in [*from, *to] {
                    shared[end].is_sealed = true;
                }
            }
        }
        shared
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::cases::tests::tube;
    use crate::shell::cases::{Fineness, FlatStar, Objects, Watch, star};

    /// The volume inside, and the number of edges that do not lie between two triangles of opposite directions.
    fn measured(body: &WholeBody) -> (f64, usize) {
        let mut open: BTreeMap<(usize, usize), i32> = BTreeMap::new();
        let mut volume = 0.0;
        for corners in &body.triangles {
            let [a, b, c] = corners.map(|corner| body.points[corner]);
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]))
                / 6.0;
            for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                let (from, to) = (corners[from], corners[to]);
                *open.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
            }
        }
        (volume, open.values().filter(|count| **count != 0).count())
    }

    /// A sheet of two triangles over a part of the plane, whose free edges away from mirrors are sealed.
    fn sheet(flat: [[f64; 2]; 4], rise: [f64; 4]) -> InflatedShape {
        let points = std::array::from_fn::<_, 4, _>(|i| [flat[i][0], flat[i][1], rise[i]]);
        InflatedShape {
            points: points.to_vec(),
            flat: flat.to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            tension: vec![[0.0; 2]; 2],
            stretch: vec![[1.0; 2]; 2],
            curvature: vec![[0.0; 2]; 2],
        }
    }

    #[test]
    fn images_meet_in_shared_points() {
        // Half of a roof over a square: the ridge is the mirror's.
        let half = sheet([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]], [0.0; 4]);
        let mirrored = half.body(Symmetry::Mirror);
        assert_eq!((mirrored.points.len(), mirrored.triangles.len(), measured(&mirrored).1), (12, 20, 0));
        // Four images of two triangles: the ridge and both diagonals lie between sealed corners and have a point on each sheet.
        assert_eq!(mirrored.images.iter().filter(|image| **image == 0).count(), 12);
        // All corners are on the edge of the square.
        assert_eq!(mirrored.sealed.len(), 6);
    }

    /// The diagonal of a flat square lies between two sealed corners, where both sheets would meet.
    #[test]
    fn sheets_meet_at_seals_alone() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let body = sheet(square, [0.0; 4]).body(Symmetry::Sheets);
        assert_eq!((body.points.len(), body.triangles.len(), measured(&body).1), (6, 8, 0));
        let mut edges: BTreeMap<[usize; 2], u32> = BTreeMap::new();
        for corners in &body.triangles {
            for side in 0..3 {
                *edges.entry(edge(corners, side)).or_default() += 1;
            }
        }
        assert!(edges.values().all(|count| *count == 2), "{edges:?}");
        assert_eq!(body.images, [0, 0, 1, 1, 0, 0, 1, 1]);
        assert_eq!(body.sealed, [0, 1, 2, 3]);
    }

    #[test]
    fn the_whole_star_is_closed_and_has_the_volume_of_the_answer() {
        for points in [4, 5] {
            let case = FlatStar::sharp(tube(0.03, 37e3), points, 0.05, 30.0_f64.to_radians());
            let fineness = Fineness { cells: 2.0, cuts: 2 };
            let answer = star(&case, Objects::Radii(&[]), fineness, &Watch::default()).expect("a shell");
            let body = answer.shape.body(Symmetry::Sectors(points));
            let (volume, open) = measured(&body);
            assert_eq!(open, 0, "{points} points");
            let finest = answer.volume.meshes[2];
            assert!((volume / finest - 1.0).abs() < 1e-6, "{points} points: {volume} {finest}");
            assert!(body.sealed.iter().all(|point| body.points[*point][2] == 0.0));
            assert!(body.triangles.len() == 4 * points as usize * answer.shape.triangles.len());
        }
    }
}
