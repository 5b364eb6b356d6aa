//! All segments of several paths, with a search for those near a place.

use geom::{Bounds, BoxIndex, Path, Point, Segment};

/// A segment of one of several paths.
pub(crate) struct PathSegment {
    /// The number of the path.
    pub path: usize,
    /// The number of the segment in its path.
    pub at: usize,
    /// Length of the path before it, mm.
    pub before: f64,
    pub segment: Segment,
    pub bounds: Bounds,
}

/// The approach of a segment to one of several paths.
pub(crate) struct Approach {
    /// The distance between them, mm.
    pub distance: f64,
    /// A place on the segment near the path.
    pub place: Point,
    /// The number of the path.
    pub path: usize,
}

impl Approach {
    fn new(segment: &Segment, other: &PathSegment) -> Self {
        let facing = other.segment.point(other.segment.nearest_fraction(segment.point(0.5)));
        Self {
            distance: geom::segment_distance(segment, &other.segment),
            place: segment.point(segment.nearest_fraction(facing)),
            path: other.path,
        }
    }
}

/// The segments of several paths, path by path.
pub(crate) struct Segments {
    pub list: Vec<PathSegment>,
    pub index: BoxIndex,
}

impl Segments {
    /// The segments of `paths`.
    pub(crate) fn new<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Self {
        let mut list = Vec::new();
        for (path, Path { segments, .. }) in paths.into_iter().enumerate() {
            let mut length = 0.0;
            for (at, segment) in segments.iter().enumerate() {
                let bounds = segment.bounds();
                list.push(PathSegment { path, at, before: length, segment: *segment, bounds });
                length += segment.length();
            }
        }
        Self { index: BoxIndex::new(list.iter().map(|part| part.bounds)), list }
    }

    /// The segments whose boxes overlap `zone`, in their order.
    pub(crate) fn overlapping(&self, zone: Bounds) -> impl Iterator<Item = &PathSegment> {
        self.index.overlapping(&zone).into_iter().map(|i| &self.list[i])
    }

    /// The approaches of `path` to these paths, a pair of segments each, as far as their boxes come within `reach` mm.
    pub(crate) fn approaches<'s>(
        &'s self,
        path: &'s Path,
        reach: f64,
    ) -> impl Iterator<Item = Approach> + 's {
        path.segments.iter().flat_map(move |segment| {
            self.overlapping(segment.bounds().outset(reach)).map(|other| Approach::new(segment, other))
        })
    }

    /// Whether the start, or the end, of the path number `number` lies within `reach` of another path, or of its own where it closes a loop. A
    /// path is near to itself beside its own end, and a loop no wider than twice the `reach` is a hairpin.
    pub(crate) fn has_joint(&self, number: usize, path: &Path, is_start: bool, reach: f64) -> bool {
        let Some(end) = (if is_start { path.start() } else { path.end() }) else { return false };
        let length = path.length();
        self.overlapping(Bounds::of_points([end]).outset(reach)).any(|part| {
            let t = part.segment.nearest_fraction(end);
            let s = part.before + t * part.segment.length();
            let stations = if is_start { [0.0, s] } else { [s, length] };
            part.segment.point(t).distance(end) <= reach
                && (part.path != number || closes_loop(path, stations, reach))
        })
    }
}

/// Whether the stretch of `path` between two stations closes a loop wider than twice the `reach`.
fn closes_loop(path: &Path, stations: [f64; 2], reach: f64) -> bool {
    let length = stations[1] - stations[0];
    let area = Path::closed(path.part(stations[0], stations[1]).segments).area().abs();
    length > 4.0 * reach && 2.0 * area > reach * length
}
