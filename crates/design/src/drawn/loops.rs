//! Closed curves of a file: those that it closes, rings of open ones whose ends meet, and outlines that are open where a hose goes in.

use std::collections::BTreeMap;

use artwork::{Artwork, Figure};
use geom::{Enclosures, Line, Path, Point, Segment, intersections};

/// Ends up to this far apart meet, mm: the default of `join`.
const MEETS: f64 = 0.02;
/// Largest gap of an outline that is open at a port, mm; longest line that shows the port.
const LARGEST_NECK: f64 = 20.0;
/// An outline is at least this many times as long as its gap.
const LEAST_OUTLINE: f64 = 4.0;

/// A closed curve, and the numbers of the elements that make it.
pub(super) struct DrawnLoop {
    pub path: Path,
    pub elements: Vec<usize>,
    /// Whether the file leaves it open at a port.
    pub has_neck: bool,
}

/// The closed curves of a drawing, those that are open at a port included.
pub(super) fn rings(drawing: &Artwork) -> Vec<DrawnLoop> {
    let mut rings = Vec::new();
    let mut open: Vec<(usize, &Path)> = Vec::new();
    for (number, element) in drawing.elements.iter().enumerate() {
        match &element.figure {
            Figure::Path(path) if path.closed => {
                rings.push(DrawnLoop { path: path.clone(), elements: vec![number], has_neck: false });
            }
            Figure::Path(path) => open.push((number, path)),
            Figure::Point(_) => {}
        }
    }
    let (joined_rings, chains) = joined(&open);
    rings.extend(joined_rings);
    let necks = outlines_with_necks(&chains, &rings, &open);
    rings.extend(necks);
    rings
}

/// The `chains` whose ends are so near that a port lies between them, if a short line of `open` crosses the gap and no ring encloses it: within a
/// ring such a curve is a weld. A straight line closes each.
fn outlines_with_necks(chains: &[Chain], rings: &[DrawnLoop], open: &[(usize, &Path)]) -> Vec<DrawnLoop> {
    let ring_paths: Vec<Path> = rings.iter().map(|ring| ring.path.clone()).collect();
    let enclosures = Enclosures::new(&ring_paths);
    let short: Vec<&(usize, &Path)> = open.iter().filter(|(_, line)| line.length() <= LARGEST_NECK).collect();
    let mut outlines = Vec::new();
    for chain in chains {
        let Some((start, end)) = chain.path.start().zip(chain.path.end()) else { continue };
        let gap = start.distance(end);
        let chord = Segment::from(Line::new(end, start));
        let mut lines = short.iter().filter(|(number, _)| !chain.elements.contains(number));
        let is_wide = gap > LARGEST_NECK.min(chain.path.length() / LEAST_OUTLINE);
        if !is_wide && enclosures.enclosing(start).is_empty() && lines.any(|(_, line)| crosses(line, &chord))
        {
            let segments = chain.path.segments.iter().copied().chain([chord]);
            outlines.push(DrawnLoop {
                path: Path::closed(segments.collect()),
                elements: chain.elements.clone(),
                has_neck: true,
            });
        }
    }
    outlines
}

/// Whether `line` crosses `chord`.
fn crosses(line: &Path, chord: &Segment) -> bool {
    line.segments.iter().any(|segment| !intersections(segment, chord).is_empty())
}

/// Open curves, each of which begins where the one before ends, and the numbers of their elements.
struct Chain {
    path: Path,
    elements: Vec<usize>,
}

/// The rings of open curves in which each end meets one end of another curve, and the chains with two free ends.
///
/// Ends are numbered: curve `i` starts at end `2 i` and ends at `2 i + 1`. A walk goes from an end to the other one of its curve and
/// from there to its partner until it is back, or comes to an end without a partner. Walks from such ends come first.
fn joined(open: &[(usize, &Path)]) -> (Vec<DrawnLoop>, Vec<Chain>) {
    let ends: Vec<Point> =
        open.iter().flat_map(|(_, path)| [path.start(), path.end()]).map(Option::unwrap_or_default).collect();
    let neighbours = partners(&ends);
    let mut is_walked = vec![false; open.len()];
    let (mut rings, mut chains) = (Vec::new(), Vec::new());
    let free_ends = (0..ends.len()).filter(|end| neighbours[*end].is_none());
    for first in free_ends.chain((0..open.len()).map(|curve| 2 * curve)) {
        let (mut end, mut elements, mut segments) = (first, Vec::new(), Vec::new());
        while !is_walked[end / 2] {
            is_walked[end / 2] = true;
            let (number, path) = open[end / 2];
            elements.push(number);
            segments.extend(if end % 2 == 0 { path.segments.clone() } else { path.reversed().segments });
            let Some(next) = neighbours[end ^ 1] else { break };
            end = next;
        }
        if elements.is_empty() {
            continue;
        }
        if neighbours[first].is_none() {
            chains.push(Chain { path: Path::open(segments), elements });
        } else if end == first && elements.len() > 1 {
            rings.push(DrawnLoop { path: Path::closed(segments), elements, has_neck: false });
        }
    }
    (rings, chains)
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
