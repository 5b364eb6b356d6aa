//! STL files against the plates they should be: closed, of the right volume, with their edges where they belong.

use std::collections::{HashMap, HashSet};

use crate::verify::finding::quote;
use crate::verify::judge::files::drawings::paths_of;
use crate::verify::judge::files::layers::in_file;
use crate::verify::judge::path::measure::Prepared;
use crate::verify::read::stl::{SolidNotes, read_solid};
use crate::verify::{FindingCode, Findings, StlFacet};
use design::{Drawing, Layer};
use geom::{Path, Point};

/// Largest distance of a chord from its arc, mm, with the error of single precision.
pub(super) const CHORD: f64 = 0.022;

/// Largest distance of a corner from its path or its face, mm: it is rounded to a thousandth, and to single precision.
const CORNER: f64 = 0.002;

/// Largest shift of a corner by rounding to a thousandth, mm.
const ROUNDED: f64 = 0.0008;

/// Largest error of a normal, beside the turn by its corners' rounding: slicers use either.
const NORMAL: f64 = 0.002;

/// Reads a binary STL and checks that it is the solid `name` of this thickness, mm, with the edges and the holes in
/// `drawing`; its facets, and the largest deviation of its edges, mm.
pub(super) fn check(
    bytes: &[u8],
    drawing: &Drawing,
    name: &str,
    thickness: f64,
    findings: &mut Findings,
) -> (Vec<StlFacet>, f64) {
    let Some((facets, notes)) = read_solid(bytes) else {
        let problem = format!("{} bytes that are not a binary STL", bytes.len());
        let allowed = "a head of 84 bytes and 50 a facet, all numbers finite";
        findings.add(FindingCode::BadStl, problem, allowed);
        return (Vec::new(), f64::INFINITY);
    };
    named(&notes, name, findings);
    normals(&facets, &notes.normals, thickness, findings);
    let corners = numbered(&facets);
    closed(&corners, findings);
    let layers = drawing.layers.iter();
    let areas = layers.flat_map(|(layer, shapes)| {
        let sign = if matches!(layer, Layer::MaskPlate | Layer::FrameEdge) { 1.0 } else { -1.0 };
        shapes.iter().flat_map(paths_of).map(move |path| sign * path.area().abs())
    });
    let right = areas.sum::<f64>() * thickness;
    let volume: f64 = facets.iter().map(sixfold).sum::<f64>() / 6.0;
    let paths: Vec<Path> =
        drawing.layers.iter().flat_map(|(_, shapes)| shapes.iter().flat_map(paths_of)).collect();
    // Chords cut off less than the tolerance along all edges.
    let slack = paths.iter().map(Path::length).sum::<f64>() * CHORD * thickness;
    if (volume - right).abs() > slack {
        findings.add(FindingCode::WrongVolume, format!("{volume:.1} mm3"), format!("{right:.1} mm3"));
    }
    let deviation = edges(&facets, &corners, &paths, thickness, findings);
    (facets, deviation)
}

/// Checks that the head names the solid, and that the facets have no other data.
fn named(notes: &SolidNotes, name: &str, findings: &mut Findings) {
    if !notes.plain {
        findings.add(FindingCode::BadStl, "a facet with notes", "two zeros a facet");
    }
    let right = format!("{:80}", in_file(name, 80));
    if notes.head != right.as_bytes() {
        let title = quote(&String::from_utf8_lossy(&notes.head));
        findings.add(FindingCode::WrongTitle, title, quote(&right));
    }
}

/// Six times the signed volume of the tetrahedron over the origin.
fn sixfold(facet: &StlFacet) -> f64 {
    let [a, b, c] = facet.map(|v| v.map(f64::from));
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Checks that every facet's normal agrees with its corners.
fn normals(facets: &[StlFacet], normals: &[[f32; 3]], thickness: f64, findings: &mut Findings) {
    let wrong = facets.iter().zip(normals).filter(|(facet, normal)| {
        let (right, slack) = normal_of(facet, thickness);
        let deviations = (0..3).map(|k| (f64::from(normal[k]) - right[k]).abs());
        !deviations.fold(0.0, f64::max).le(&slack) || normal.iter().any(|x| x.is_nan())
    });
    let count = wrong.count();
    if count > 0 {
        let problem = format!("{count} normals that differ from their corners'");
        findings.add(FindingCode::BadStl, problem, "none");
    }
}

/// The normal of a facet, and how far it may be off.
fn normal_of(facet: &StlFacet, thickness: f64) -> ([f64; 3], f64) {
    let [a, b, c] = facet.map(|corner| corner.map(f64::from));
    if a[2] == b[2] && b[2] == c[2] {
        // A face may have triangles with corners in line.
        return ([0.0, 0.0, if a[2] > thickness / 2.0 { 1.0 } else { -1.0 }], NORMAL);
    }
    let [u, v] = [b, c].map(|to| [to[0] - a[0], to[1] - a[1], to[2] - a[2]]);
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    // The corners are rounded; a short side is turned further by that.
    let slack = NORMAL + (1e-4 + 4.0 * single(&[*facet])) * length(u).max(length(v)) / length(cross);
    (cross.map(|x| x / length(cross)), slack)
}

fn length(v: [f64; 3]) -> f64 {
    libm::hypot(libm::hypot(v[0], v[1]), v[2])
}

/// The error of single precision at the largest coordinate, mm.
fn single(facets: &[StlFacet]) -> f64 {
    let largest = facets.iter().flatten().flatten().fold(0.0_f32, |most, x| most.max(x.abs()));
    f64::from(largest) * f64::from(f32::EPSILON)
}

/// The corners of every facet by numbers, which are given in the order in which corners first come.
fn numbered(facets: &[StlFacet]) -> Vec<[u32; 3]> {
    let mut numbers: HashMap<(u64, u32), u32> = HashMap::with_capacity(facets.len());
    let mut number = |corner: [f32; 3]| {
        let [x, y, z] = corner.map(bits);
        let next = u32::try_from(numbers.len()).unwrap_or(u32::MAX);
        *numbers.entry((u64::from(x) << 32 | u64::from(y), z)).or_insert(next)
    };
    facets.iter().map(|facet| facet.map(&mut number)).collect()
}

/// Every edge is passed once each way.
fn closed(corners: &[[u32; 3]], findings: &mut Findings) {
    // An edge in one word: its corners, and in the last bit its way. Words are sorted faster than structures.
    let edges_of = |[a, b, c]: &[u32; 3]| [edge_key(*a, *b), edge_key(*b, *c), edge_key(*c, *a)];
    let mut edges: Vec<u64> = corners.iter().flat_map(edges_of).collect();
    edges.sort_unstable();
    let (mut open, mut total) = (0_usize, 0_usize);
    for uses in edges.chunk_by(|a, b| a >> 1 == b >> 1) {
        let are_paired = matches!(uses, [back, forth] if back & 1 == 0 && forth & 1 == 1);
        total += 1;
        open += usize::from(!are_paired);
    }
    if open > 0 || total == 0 {
        let problem = format!("{open} of {total} edges");
        findings.add(FindingCode::NotWatertight, problem, "each edge once in each direction");
    }
}

/// Both directions of an edge differ in the last bit only.
fn edge_key(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 33 | u64::from(a.max(b)) << 1 | u64::from(a < b)
}

/// The bits of a number; both zeros are the same.
fn bits(x: f32) -> u32 {
    (x + 0.0).to_bits()
}

/// The targets of a search, and the one that was found last: edges come along the paths, so mostly the next one is near it.
struct Search<'a> {
    targets: &'a [Prepared],
    last: usize,
}

impl Search<'_> {
    fn distance(&mut self, x: f64, y: f64) -> f64 {
        let p = Point::new(x, y);
        let mut best = f64::INFINITY;
        for i in [self.last, self.last + 1] {
            let distance = self.targets.get(i).map_or(f64::INFINITY, |target| target.distance(p));
            if distance < best {
                (best, self.last) = (distance, i);
            }
        }
        // A nearer one would only be nearer than rounding.
        if best <= ROUNDED {
            return best;
        }
        for (i, target) in self.targets.iter().enumerate() {
            if target.bounds.distance(p) < best {
                let distance = target.distance(p);
                if distance < best {
                    (best, self.last) = (distance, i);
                }
            }
        }
        best
    }
}

/// The lower edge of the wall that a facet is part of, if it is and has one: from, to, height.
pub(super) fn foot(facet: &StlFacet) -> Option<[[f64; 3]; 2]> {
    let corners = facet.map(|v| v.map(f64::from));
    let pairs = [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(a, b, c)| (corners[a], corners[b], corners[c]));
    pairs.into_iter().find(|(a, b, c)| a[2] == b[2] && c[2] > a[2]).map(|(a, b, _)| [a, b])
}

/// Checks that the walls follow the exact paths, all along them, from Z 0 to the thickness.
fn edges(
    facets: &[StlFacet],
    corners: &[[u32; 3]],
    paths: &[Path],
    thickness: f64,
    findings: &mut Findings,
) -> f64 {
    let targets = Prepared::prepare_all(paths);
    let mut search = Search { targets: &targets, last: 0 };
    let (mut largest, mut worst, mut length) = (0.0_f64, 0.0_f64, 0.0);
    let (mut corners_seen, mut next): (HashSet<[u32; 2]>, u32) = (HashSet::new(), 0);
    for (facet, numbers) in facets.iter().zip(corners) {
        for (corner, number) in facet.iter().zip(numbers) {
            if *number < next {
                continue;
            }
            next += 1;
            let [x, y, z] = corner.map(f64::from);
            worst = worst.max(z.abs().min((z - thickness).abs()));
            // Walls have two corners above each other.
            if corners_seen.insert([bits(corner[0]), bits(corner[1])]) {
                worst = worst.max(search.distance(x, y));
            }
        }
        // A wall has corners on two heights; its lower edge is a chord of the paths.
        if let Some([a, b]) = foot(facet) {
            length += libm::hypot(b[0] - a[0], b[1] - a[1]);
            largest = largest.max(search.distance(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])));
        }
    }
    let coarse = single(facets);
    for (found, allowed, what) in [(largest, CHORD + coarse, "chord"), (worst, CORNER + coarse, "corner")] {
        if found.is_nan() || found > allowed {
            let deviation = if found.is_finite() {
                format!("a {what} {found:.6} mm off")
            } else {
                format!("a {what} near no path")
            };
            findings.add(FindingCode::Deviation, deviation, format!("{allowed} mm"));
        }
    }
    let exact: f64 = paths.iter().map(Path::length).sum();
    // A chord within the tolerance of its arc is shorter than it by far less than a hundredth.
    if (length - exact).abs() > 0.01 * exact {
        findings.add(FindingCode::PathLength, format!("{length:.1} mm of edge"), format!("{exact:.1} mm"));
    }
    largest.max(worst)
}
