//! The pull on each seam: force across the plane of the sheets by length, where they part.

use crate::shell::mesh::{FlatChamber, Meshed};
use geom::Segment;

/// A place on a seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Station {
    /// The curve, as [`FlatChamber::curves`] counts.
    pub(super) curve: usize,
    /// Position on the flat sheet.
    pub(super) at: [f64; 2],
    /// Mean force by length over a band around it.
    pub(super) pull: f64,
}

/// Stations on one curve at most.
const MOST_STATIONS: f64 = 400.0;
/// Least length over which a pull is averaged, by W: shorter ones are not resolved by the meshes.
const SHORTEST_BAND: f64 = 0.02;

/// The pull at stations half a band apart, the same ones on every mesh, from the energy's derivatives by each point. `curve_of` gives
/// the curve of each piece of the mesh.
pub(super) fn pulls(
    chamber: &FlatChamber,
    band: f64,
    (meshed, curve_of): (&Meshed, &[usize]),
    forces: &[[f64; 3]],
) -> Vec<Station> {
    let band = if band > SHORTEST_BAND { band.min(1.0) } else { SHORTEST_BAND };
    let mut stations = Vec::new();
    for (curve, path) in chamber.curves().enumerate() {
        let profile = ForceAlongCurve::new(meshed, curve_of, curve, forces);
        let length = path.length();
        let count = (2.0 * length / band).ceil().clamp(1.0, MOST_STATIONS);
        let mut k = 0.5;
        while k < count {
            let s = length * k / count;
            if let Some(point) = path.point_at(s) {
                let pull = profile.mean(s / length, band / length, path.closed);
                stations.push(Station { curve, at: [point.x, point.y], pull });
            }
            k += 1.0;
        }
    }
    stations
}

/// The force along one curve of a mesh, summed up from its start; lengths and places by the curve's length.
struct ForceAlongCurve {
    /// The end of each edge, and the sums of force and of length there; from 0.
    sums: Vec<[f64; 3]>,
}

impl ForceAlongCurve {
    fn new(meshed: &Meshed, curve_of: &[usize], curve: usize, forces: &[[f64; 3]]) -> Self {
        // Edges of the seam's curve are sorted by their place along it. The force of each point is shared between the
        // edges at it by their lengths. Running sums of length and force then give the mean pull of any part of the
        // seam by a difference.
        let mesh = &meshed.mesh;
        let mut starts = vec![0.0; meshed.pieces.len() + 1];
        for (piece, of) in curve_of.iter().enumerate() {
            let length = if *of == curve { meshed.pieces[piece].curve.length() } else { 0.0 };
            starts[piece + 1] = starts[piece] + length;
        }
        let last = starts[meshed.pieces.len()];
        let place = |segment: &Segment, edge: usize| {
            let ends = mesh.edges[edge].ends.map(|end| mesh.points[end]);
            let [x, y] = [0, 1].map(|c| f64::midpoint(ends[0][c], ends[1][c]));
            segment.nearest_fraction(geom::Point::new(x, y)) * segment.length()
        };
        let mut edges: Vec<(f64, usize)> = (0..mesh.edges.len())
            .filter_map(|edge| {
                let piece = meshed.piece_of[edge].filter(|piece| curve_of[*piece] == curve)?;
                Some((starts[piece] + place(&meshed.pieces[piece].curve, edge), edge))
            })
            .collect();
        edges.sort_by(|a, b| a.0.total_cmp(&b.0));
        // A point's force goes to the edges at it by their lengths.
        let mut lengths = std::collections::BTreeMap::<usize, f64>::new();
        for edge in (0..mesh.edges.len()).filter(|edge| meshed.piece_of[*edge].is_some()) {
            for end in mesh.edges[edge].ends {
                *lengths.entry(end).or_default() += mesh.length(edge);
            }
        }
        let chords: f64 = edges.iter().map(|(_, edge)| mesh.length(*edge)).sum();
        let mut sums = vec![[0.0; 3]];
        let mut sum = [0.0; 3];
        for (_, edge) in edges {
            let length = mesh.length(edge);
            let force: f64 =
                mesh.edges[edge].ends.iter().map(|end| -forces[*end][2] * length / lengths[end]).sum();
            sum = [sum[0] + length / chords, sum[1] + force, sum[2] + length * last / chords];
            sums.push(sum);
        }
        Self { sums }
    }

    /// Sums of force and of length up to `s`, 0 to 1.
    fn up_to(&self, s: f64) -> [f64; 2] {
        let index = self.sums.partition_point(|sum| sum[0] < s).clamp(1, self.sums.len().max(2) - 1);
        let (Some(a), Some(b)) = (self.sums.get(index - 1), self.sums.get(index)) else { return [0.0; 2] };
        let t = ((s - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
        [a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])]
    }

    /// Mean force by length over `band` around `s`.
    fn mean(&self, s: f64, band: f64, closed: bool) -> f64 {
        let [from, to] = [s - band / 2.0, s + band / 2.0];
        let whole_sum = self.up_to(1.0);
        let [[f0, l0], [f1, l1]] = [from, to].map(|s| {
            let turns = if closed { s.floor() } else { 0.0 };
            let [force, length] = self.up_to(s - turns);
            [force + turns * whole_sum[0], length + turns * whole_sum[1]]
        });
        if l1 > l0 { (f1 - f0) / (l1 - l0) } else { 0.0 }
    }
}
