//! Closed curves of a file: those that it closes, and rings of open ones whose ends meet.

use std::collections::BTreeMap;

use artwork::{Artwork, Figure};
use geom::{Path, Point};

/// Ends up to this far apart meet, mm: the default of `join`.
const MEETS: f64 = 0.02;

/// A closed curve, and the numbers of the elements that make it.
pub(super) struct DrawnLoop {
    pub path: Path,
    pub elements: Vec<usize>,
}

/// The closed curves of a drawing.
pub(super) fn rings(drawing: &Artwork) -> Vec<DrawnLoop> {
    let mut rings = Vec::new();
    let mut open: Vec<(usize, &Path)> = Vec::new();
    for (number, element) in drawing.elements.iter().enumerate() {
        match &element.figure {
            Figure::Path(path) if path.closed => {
                rings.push(DrawnLoop { path: path.clone(), elements: vec![number] });
            }
            Figure::Path(path) => open.push((number, path)),
            Figure::Point(_) => {}
        }
    }
    rings.extend(joined(&open));
    rings
}

/// The rings of open curves in which each end meets one end of another curve.
///
/// Ends are numbered: curve `i` starts at end `2 i` and ends at `2 i + 1`. A walk goes from an end to the other one of its curve and
/// from there to its partner until it is back; a walk that comes to an end without a partner is no ring.
fn joined(open: &[(usize, &Path)]) -> Vec<DrawnLoop> {
    let ends: Vec<Point> =
        open.iter().flat_map(|(_, path)| [path.start(), path.end()]).map(Option::unwrap_or_default).collect();
    let neighbours = partners(&ends);
    let mut is_walked = vec![false; open.len()];
    let mut rings = Vec::new();
    for first in 0..open.len() {
        let (mut end, mut elements, mut segments) = (2 * first, Vec::new(), Vec::new());
        while !is_walked[end / 2] {
            is_walked[end / 2] = true;
            let (number, path) = open[end / 2];
            elements.push(number);
            segments.extend(if end % 2 == 0 { path.segments.clone() } else { path.reversed().segments });
            let Some(next) = neighbours[end ^ 1] else { break };
            end = next;
        }
        if end == 2 * first && elements.len() > 1 {
            rings.push(DrawnLoop { path: Path::closed(segments), elements });
        }
    }
    rings
}

/// The only other end that meets each end; `None` where there is none or more than one.
fn partners(ends: &[Point]) -> Vec<Option<usize>> {
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (number, end) in ends.iter().enumerate() {
        cells.entry(cell(*end)).or_default().push(number);
    }
    let nearest_end = |number: usize| -> Option<usize> {
        let [x, y] = cell(ends[number]);
        let cells_nearby = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x + i, y + j]));
        let candidates = cells_nearby.filter_map(|cell| cells.get(&cell)).flatten().copied();
        let mut meeting =
            candidates.filter(|other| *other != number && ends[*other].distance(ends[number]) <= MEETS);
        meeting.next().filter(|_| meeting.next().is_none())
    };
    let nearest: Vec<Option<usize>> = (0..ends.len()).map(nearest_end).collect();
    let is_mutual = |number: usize| nearest[number].filter(|other| nearest[*other] == Some(number));
    (0..ends.len()).map(is_mutual).collect()
}

/// The cell of a grid with cells as large as [`MEETS`] in which `p` lies.
#[expect(clippy::cast_possible_truncation, reason = "coordinates are at most a kilometre")]
fn cell(p: Point) -> [i64; 2] {
    [(p.x / MEETS).floor() as i64, (p.y / MEETS).floor() as i64]
}
