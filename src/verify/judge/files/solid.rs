//! STL files against the plates they should be: closed, of the right volume, with their edges where they belong.

use std::collections::BTreeMap;

use crate::design::{Drawing, Layer};
use crate::geom::{Bounds, Path, Point};
use crate::verify::judge::files::drawings::path_of;
use crate::verify::{FindingCode, Findings};

/// What chords and single precision may take away, mm.
const TOLERANCE: f64 = 0.025;

type Vertex = [f32; 3];

/// Reads a binary STL and checks it as the plate of `drawing`, `thickness` high; the largest deviation of its edges, mm.
pub(in crate::verify) fn check(
    bytes: &[u8],
    drawing: &Drawing,
    thickness: f64,
    findings: &mut Findings,
) -> f64 {
    let Some(facets) = facets(bytes) else {
        let found = format!("{} bytes that are no binary STL", bytes.len());
        findings.add(
            FindingCode::BadStl,
            None,
            found,
            "a head of 84 bytes and 50 a facet, all numbers finite",
        );
        return f64::INFINITY;
    };
    closed(&facets, findings);
    let exact: Vec<(Layer, Path)> = drawing
        .layers
        .iter()
        .filter(|(layer, _)| *layer != Layer::Label)
        .flat_map(|(layer, shapes)| shapes.iter().map(|shape| (*layer, path_of(shape))))
        .collect();
    let area = |(layer, path): &(Layer, Path)| {
        if *layer == Layer::MaskPlate { path.area().abs() } else { -path.area().abs() }
    };
    let length: f64 = exact.iter().map(|(_, path)| path.length()).sum();
    let right = exact.iter().map(area).sum::<f64>() * thickness;
    let volume: f64 = facets.iter().map(sixfold).sum::<f64>() / 6.0;
    // Chords cut off less than the tolerance along all edges.
    if (volume - right).abs() > length * TOLERANCE * thickness {
        findings.add(FindingCode::WrongVolume, None, format!("{volume:.1} mm3"), format!("{right:.1} mm3"));
    }
    let paths: Vec<Path> = exact.into_iter().map(|(_, path)| path).collect();
    edges(&facets, &paths, length, thickness, findings)
}

fn facets(bytes: &[u8]) -> Option<Vec<[Vertex; 3]>> {
    let count = usize::try_from(u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?)).ok()?;
    if bytes.len() != 84 + 50 * count {
        return None;
    }
    let number = |raw: &[u8], at: usize| -> Option<f32> {
        Some(f32::from_le_bytes(raw.get(at..at + 4)?.try_into().ok()?)).filter(|x| x.is_finite())
    };
    let vertex = |raw: &[u8], at: usize| -> Option<Vertex> {
        Some([number(raw, at)?, number(raw, at + 4)?, number(raw, at + 8)?])
    };
    let facet = |raw: &[u8]| Some([vertex(raw, 12)?, vertex(raw, 24)?, vertex(raw, 36)?]);
    bytes[84..].chunks_exact(50).map(facet).collect()
}

/// Six times the signed volume of the tetrahedron over the origin.
fn sixfold(facet: &[Vertex; 3]) -> f64 {
    let [a, b, c] = facet.map(|v| v.map(f64::from));
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Every edge is passed once each way.
fn closed(facets: &[[Vertex; 3]], findings: &mut Findings) {
    let mut uses: BTreeMap<[[u32; 3]; 2], (u32, u32)> = BTreeMap::new();
    for facet in facets {
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (facet[from].map(bits), facet[to].map(bits));
            let entry = uses.entry([a.min(b), a.max(b)]).or_default();
            if a < b { entry.0 += 1 } else { entry.1 += 1 }
        }
    }
    let open = uses.values().filter(|uses| **uses != (1, 1)).count();
    if open > 0 || uses.is_empty() {
        findings.add(
            FindingCode::NotWatertight,
            None,
            format!("{open} of {} edges", uses.len()),
            "each once each way",
        );
    }
}

/// The bits of a number; both zeros are the same.
fn bits(x: f32) -> u32 {
    (x + 0.0).to_bits()
}

/// The walls stand on the exact paths, all along them, from Z 0 to the thickness.
fn edges(facets: &[[Vertex; 3]], paths: &[Path], right: f64, thickness: f64, findings: &mut Findings) -> f64 {
    let boxes: Vec<Bounds> = paths.iter().map(Path::bounds).collect();
    let near = |x: f64, y: f64| {
        let p = Point::new(x, y);
        // Small paths first: a path whose box is farther than what is found already cannot be nearer.
        let nearer = |best: f64, (path, bounds): (&Path, &Bounds)| {
            if bounds.distance(p) < best { best.min(path.distance(p)) } else { best }
        };
        paths.iter().zip(&boxes).rev().fold(f64::INFINITY, nearer)
    };
    let (mut largest, mut length) = (0.0_f64, 0.0);
    for facet in facets {
        let corners = facet.map(|v| v.map(f64::from));
        for [_, _, z] in corners {
            let off = z.abs().min((z - thickness).abs());
            largest = largest.max(off);
        }
        // A wall has corners on both faces; its horizontal edge is a chord of the paths.
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let ([ax, ay, az], [bx, by, bz]) = (corners[a], corners[b]);
            let other = corners[3 - a - b];
            if az == bz && other[2] != az && az < thickness / 2.0 {
                length += (bx - ax).hypot(by - ay);
                for t in [0.0, 0.5] {
                    largest = largest.max(near(ax + t * (bx - ax), ay + t * (by - ay)));
                }
            }
        }
    }
    if largest.is_nan() || largest > TOLERANCE {
        findings.add(FindingCode::Deviation, None, format!("{largest:.6} mm"), format!("{TOLERANCE} mm"));
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
    largest
}
