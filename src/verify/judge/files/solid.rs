//! STL files against the plates they should be: closed, of the right volume, with their edges where they belong.

use std::collections::HashSet;

use crate::design::{Drawing, Layer};
use crate::geom::{Path, Point};
use crate::verify::judge::files::drawings::paths_of;
use crate::verify::judge::path::measure::Prepared;
use crate::verify::read::stl::read_solid;
use crate::verify::{Facet, FindingCode, Findings};

/// How far a chord may leave its arc, mm, with what single precision takes away.
const CHORD: f64 = 0.022;

/// How far a corner may lie from its path or its face, mm: it is rounded to a thousandth, and to single precision.
const CORNER: f64 = 0.002;

/// How far a normal may be off, beside what the corners' rounding turns it by: slicers go by either.
const NORMAL: f64 = 0.002;

/// Reads a binary STL and checks it as the plate of `drawing`, `thickness` high; the largest deviation of its edges, mm.
pub(in crate::verify) fn check(
    bytes: &[u8],
    drawing: &Drawing,
    thickness: f64,
    findings: &mut Findings,
) -> f64 {
    let Some((facets, beside)) = read_solid(bytes) else {
        let found = format!("{} bytes that are no binary STL", bytes.len());
        findings.add(
            FindingCode::BadStl,
            None,
            found,
            "a head of 84 bytes and 50 a facet, all numbers finite",
        );
        return f64::INFINITY;
    };
    if !beside.blank {
        findings.add(
            FindingCode::BadStl,
            None,
            "a head or facet with notes",
            "80 blanks, and two zeros a facet",
        );
    }
    normals(&facets, &beside.normals, thickness, findings);
    closed(&facets, findings);
    let exact: Vec<(Layer, Path)> = drawing
        .layers
        .iter()
        .filter(|(layer, _)| *layer != Layer::Label)
        .flat_map(|(layer, shapes)| shapes.iter().flat_map(paths_of).map(|path| (*layer, path)))
        .collect();
    let area = |(layer, path): &(Layer, Path)| {
        if *layer == Layer::MaskPlate { path.area().abs() } else { -path.area().abs() }
    };
    let length: f64 = exact.iter().map(|(_, path)| path.length()).sum();
    let right = exact.iter().map(area).sum::<f64>() * thickness;
    let volume: f64 = facets.iter().map(sixfold).sum::<f64>() / 6.0;
    // Chords cut off less than the tolerance along all edges.
    if (volume - right).abs() > length * CHORD * thickness {
        findings.add(FindingCode::WrongVolume, None, format!("{volume:.1} mm3"), format!("{right:.1} mm3"));
    }
    let paths: Vec<Path> = exact.into_iter().map(|(_, path)| path).collect();
    edges(&facets, &paths, length, thickness, findings)
}

/// Six times the signed volume of the tetrahedron over the origin.
fn sixfold(facet: &Facet) -> f64 {
    let [a, b, c] = facet.map(|v| v.map(f64::from));
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Every facet says the direction that its corners say.
fn normals(facets: &[Facet], normals: &[[f32; 3]], thickness: f64, findings: &mut Findings) {
    let wrong = facets.iter().zip(normals).filter(|(facet, normal)| {
        let (right, slack) = normal_of(facet, thickness);
        let off = (0..3).map(|k| (f64::from(normal[k]) - right[k]).abs());
        !off.fold(0.0, f64::max).le(&slack) || normal.iter().any(|x| x.is_nan())
    });
    let count = wrong.count();
    if count > 0 {
        let found = format!("{count} normals that are not those of their corners");
        findings.add(FindingCode::BadStl, None, found, "none");
    }
}

/// The normal of a facet, and how far it may be off.
fn normal_of(facet: &Facet, thickness: f64) -> ([f64; 3], f64) {
    let [a, b, c] = facet.map(|corner| corner.map(f64::from));
    if a[2] == b[2] && b[2] == c[2] {
        // A face may have triangles with corners in line.
        return ([0.0, 0.0, if a[2] > thickness / 2.0 { 1.0 } else { -1.0 }], NORMAL);
    }
    let side = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let (u, v) = (side(b), side(c));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = |v: [f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
    // The corners are rounded; a short side is turned further by that.
    let slack = NORMAL + (1e-4 + 4.0 * single(&[*facet])) * length(u).max(length(v)) / length(cross);
    (cross.map(|x| x / length(cross)), slack)
}

/// What single precision makes of the largest coordinate, mm.
fn single(facets: &[Facet]) -> f64 {
    let largest = facets.iter().flatten().flatten().fold(0.0_f32, |most, x| most.max(x.abs()));
    f64::from(largest) * f64::from(f32::EPSILON)
}

/// Every edge is passed once each way.
fn closed(facets: &[Facet], findings: &mut Findings) {
    let edge = |facet: &Facet, from: usize, to: usize| {
        let (a, b) = (facet[from].map(bits), facet[to].map(bits));
        ([a.min(b), a.max(b)], a < b)
    };
    let mut edges: Vec<([[u32; 3]; 2], bool)> = facets
        .iter()
        .flat_map(|facet| [(0, 1), (1, 2), (2, 0)].map(|(from, to)| edge(facet, from, to)))
        .collect();
    edges.sort_unstable();
    let paired = |uses: &[(_, bool)]| matches!(uses, [(_, false), (_, true)]);
    let (mut open, mut all) = (0_usize, 0_usize);
    for uses in edges.chunk_by(|a, b| a.0 == b.0) {
        all += 1;
        open += usize::from(!paired(uses));
    }
    if open > 0 || all == 0 {
        findings.add(
            FindingCode::NotWatertight,
            None,
            format!("{open} of {all} edges"),
            "each once each way",
        );
    }
}

/// The bits of a number; both zeros are the same.
fn bits(x: f32) -> u32 {
    (x + 0.0).to_bits()
}

/// The walls stand on the exact paths, all along them, from Z 0 to the thickness.
fn edges(facets: &[Facet], paths: &[Path], right: f64, thickness: f64, findings: &mut Findings) -> f64 {
    let targets: Vec<Prepared> =
        paths.iter().flat_map(|path| &path.segments).map(|segment| Prepared::new(*segment)).collect();
    // Edges come along the paths: where the last one lay, the next one lies, mostly.
    let mut last = 0;
    let mut near = |x: f64, y: f64| {
        let p = Point::new(x, y);
        let mut best = targets.get(last).map_or(f64::INFINITY, |target| target.distance(p));
        for (i, target) in targets.iter().enumerate() {
            if target.bounds.distance(p) < best {
                let distance = target.distance(p);
                if distance < best {
                    (best, last) = (distance, i);
                }
            }
        }
        best
    };
    let (mut largest, mut worst, mut length) = (0.0_f64, 0.0_f64, 0.0);
    let mut seen: HashSet<[u32; 2]> = HashSet::new();
    for facet in facets {
        let corners = facet.map(|v| v.map(f64::from));
        for (corner, [x, y, z]) in facet.iter().zip(corners) {
            worst = worst.max(z.abs().min((z - thickness).abs()));
            // Every corner of a face is a corner of walls too, and of several facets.
            if seen.insert([bits(corner[0]), bits(corner[1])]) {
                worst = worst.max(near(x, y));
            }
        }
        // A wall has corners on both faces; its horizontal edge is a chord of the paths.
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let ([ax, ay, az], [bx, by, bz]) = (corners[a], corners[b]);
            let other = corners[3 - a - b];
            if az == bz && other[2] != az && az < thickness / 2.0 {
                length += (bx - ax).hypot(by - ay);
                largest = largest.max(near(0.5 * (ax + bx), 0.5 * (ay + by)));
            }
        }
    }
    let coarse = single(facets);
    for (found, allowed, what) in [(largest, CHORD + coarse, "chord"), (worst, CORNER + coarse, "corner")] {
        if found.is_nan() || found > allowed {
            let found = format!("a {what} {found:.6} mm off");
            findings.add(FindingCode::Deviation, None, found, format!("{allowed} mm"));
        }
    }
    // A chord within the tolerance of its arc is shorter than it by far less than a hundredth.
    if (length - right).abs() > 0.01 * right {
        findings.add(
            FindingCode::PathLength,
            None,
            format!("{length:.1} mm of edges"),
            format!("{right:.1} mm"),
        );
    }
    largest.max(worst)
}
