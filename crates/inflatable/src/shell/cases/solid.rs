//! The whole body as files of other programs, in mm: STL, and OBJ with its sheets and seams as groups.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use geom::{Path, Point};

use crate::shell::cases::whole::WholeBody;

/// How STL and OBJ files of bodies begin, by which they are recognised.
pub const SOLID_TITLE: &str = "stargrip-cam: inflated body, mm";

/// Length of the head of a binary STL file.
const HEAD: usize = 80;

/// A seam of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySeam {
    /// The name of the seam.
    pub name: String,
    /// The centre line of the seam on the flat sheets, mm.
    pub center_line: Path,
}

impl WholeBody {
    /// The sealed points by the name of the nearest of `seams`, or of "seam" if there is none.
    pub fn points_by_seam(&self, seams: &[BodySeam]) -> BTreeMap<String, Vec<usize>> {
        let mut points_by_seam: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for point in &self.sealed {
            let [x, y] = self.flat[*point].map(|metres| 1e3 * metres);
            let place = Point::new(x, y);
            let nearest = seams
                .iter()
                .min_by(|a, b| a.center_line.distance(place).total_cmp(&b.center_line.distance(place)));
            let name = nearest.map_or("seam", |seam| seam.name.as_str());
            points_by_seam.entry(name.to_owned()).or_default().push(*point);
        }
        points_by_seam
    }

    /// A binary STL file, mm. Its numbers are rounded to single precision.
    pub fn stl(&self) -> Vec<u8> {
        let mut bytes = SOLID_TITLE.as_bytes().to_vec();
        bytes.resize(HEAD, b' ');
        bytes.extend(u32::try_from(self.triangles.len()).unwrap_or(u32::MAX).to_le_bytes());
        for triangle in &self.triangles {
            let corners = triangle.map(|point| self.points[point]);
            let numbers =
                std::iter::once(normal(corners)).chain(corners.map(|corner| corner.map(|x| 1e3 * x)));
            bytes.extend(numbers.flatten().flat_map(|x| single(x).to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes
    }

    /// The text of an OBJ file, mm: groups `upper-sheet` and `lower-sheet` of triangles, and a group `seam-NAME` of lines for each seam
    /// of `points_by_seam`. Coordinates are not rounded. A line belongs to the seam of its first point.
    pub fn obj(&self, points_by_seam: &BTreeMap<String, Vec<usize>>) -> String {
        let mut text = format!("# {SOLID_TITLE}\no inflated-body\n");
        for point in &self.points {
            let [x, y, z] = point.map(|x| 1e3 * x + 0.0);
            // Writing to a String does not fail.
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        let (upper, lower) = self.triangles.split_at(self.triangles.len() / 2);
        for (name, sheet) in [("upper-sheet", upper), ("lower-sheet", lower)] {
            let _ = writeln!(text, "g {name}");
            for [a, b, c] in sheet.iter().map(|triangle| triangle.map(|point| point + 1)) {
                let _ = writeln!(text, "f {a} {b} {c}");
            }
        }
        let edges = edges_of(upper);
        for (name, points) in points_by_seam {
            let _ = writeln!(text, "g seam-{}", word(name));
            let points: BTreeSet<usize> = points.iter().copied().collect();
            for [from, to] in edges.iter().filter(|[from, _]| points.contains(from)) {
                let _ = writeln!(text, "l {} {}", from + 1, to + 1);
            }
        }
        text
    }
}

/// The edges at which a sheet ends: those of one triangle alone, in its direction.
fn edges_of(sheet: &[[usize; 3]]) -> BTreeSet<[usize; 2]> {
    let mut edges = BTreeSet::new();
    for [a, b, c] in sheet {
        for [from, to] in [[*a, *b], [*b, *c], [*c, *a]] {
            if !edges.remove(&[to, from]) {
                let _ = edges.insert([from, to]);
            }
        }
    }
    edges
}

/// A name as one word of an OBJ file, which ends at a blank.
fn word(name: &str) -> String {
    name.replace(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '-' | '.'), "_")
}

/// The unit normal of a triangle, counterclockwise from outside; 0 of one without an area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [u, v]: [[f64; 3]; 2] = [b, c].map(|corner| std::array::from_fn(|k| corner[k] - a[k]));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = libm::hypot(libm::hypot(cross[0], cross[1]), cross[2]);
    if length > 0.0 { cross.map(|x| x / length) } else { [0.0; 3] }
}

/// The nearest number in single precision, without a sign of 0.
#[expect(clippy::cast_possible_truncation, reason = "STL has single precision")]
fn single(x: f64) -> f32 {
    x as f32 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pyramid on a square, and its image below: the sheets meet in the square.
    fn bipyramid() -> WholeBody {
        let base = [[0.0, 0.0], [0.002, 0.0], [0.002, 0.002], [0.0, 0.002]];
        let upper: Vec<[usize; 3]> = (0..4).map(|k| [k, (k + 1) % 4, 4]).collect();
        let lower = upper.iter().map(|[a, b, _]| [*b, *a, 5]);
        let mut points: Vec<[f64; 3]> = base.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
        points.extend([[0.001, 0.001, 0.001], [0.001, 0.001, -0.001]]);
        WholeBody {
            flat: points.iter().map(|[x, y, _]| [*x, *y]).collect(),
            points,
            images: [0, 1, 2, 3, 0, 1, 2, 3].to_vec(),
            triangles: upper.iter().copied().chain(lower).collect(),
            sealed: vec![0, 1, 2, 3],
        }
    }

    #[test]
    fn a_seam_is_a_group_of_the_lines_that_begin_on_it() {
        let body = bipyramid();
        let seams = [("near edge\nv 1", 0.0), ("far", 2.0)].map(|(name, y)| BodySeam {
            name: name.to_owned(),
            center_line: Path::polyline(&[Point::new(0.0, y), Point::new(2.0, y)]),
        });
        let by_seam = body.points_by_seam(&seams);
        assert_eq!(by_seam["far"], [2, 3]);
        assert_eq!(by_seam["near edge\nv 1"], [0, 1]);
        let text = body.obj(&by_seam);
        assert!(text.starts_with("# stargrip-cam: inflated body, mm\no inflated-body\nv 0 0 0\nv 2 0 0\n"));
        assert!(text.contains("g upper-sheet\nf 1 2 5\n") && text.contains("g lower-sheet\nf 2 1 6\n"));
        assert!(text.ends_with("g seam-far\nl 3 4\nl 4 1\ng seam-near_edge_v_1\nl 1 2\nl 2 3\n"), "{text}");
        assert_eq!(
            body.points_by_seam(&[]).into_iter().collect::<Vec<_>>(),
            [("seam".to_owned(), vec![0, 1, 2, 3])]
        );
    }

    #[test]
    fn a_solid_has_a_head_and_fifty_bytes_a_triangle() {
        let bytes = bipyramid().stl();
        assert_eq!((bytes.len(), &bytes[80..84]), (84 + 8 * 50, &[8, 0, 0, 0][..]));
        let numbers: Vec<f32> = bytes[84..132]
            .chunks_exact(4)
            .map(|four| f32::from_le_bytes(four.try_into().expect("four bytes")))
            .collect();
        let slope = 0.5_f32.sqrt();
        assert!((numbers[1] + slope).abs() < 1e-6 && (numbers[2] - slope).abs() < 1e-6, "{numbers:?}");
        assert_eq!(numbers[3..], [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    }
}
