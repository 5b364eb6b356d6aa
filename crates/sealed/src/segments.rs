//! All segments of several paths, with a search for those near a place.

use geom::{Bounds, BoxIndex, Path, Point, Segment};

/// A segment of one of several paths.
pub(super) struct PathSegment {
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
pub(super) struct Approach {
    /// The distance between them, mm.
    pub distance: f64,
    /// A place on the segment near the path.
    pub place: Point,
    /// The number of the path.
    pub path: usize,
}

impl Approach {
    fn of(segment: &Segment, across: &PathSegment) -> Self {
        let facing = across.segment.point(across.segment.nearest_fraction(segment.point(0.5)));
        Self {
            distance: geom::segment_distance(segment, &across.segment),
            place: segment.point(segment.nearest_fraction(facing)),
            path: across.path,
        }
    }
}

/// The segments of several paths, path by path.
pub(super) struct Segments {
    pub list: Vec<PathSegment>,
    pub index: BoxIndex,
}

impl Segments {
    /// The segments of `paths`.
    pub(super) fn of<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Self {
        let mut list = Vec::new();
        for (path, Path { segments, .. }) in paths.into_iter().enumerate() {
            let mut before = 0.0;
            for (at, segment) in segments.iter().enumerate() {
                list.push(PathSegment { path, at, before, segment: *segment, bounds: segment.bounds() });
                before += segment.length();
            }
        }
        Self { index: BoxIndex::new(list.iter().map(|one| one.bounds)), list }
    }

    /// Those whose boxes overlap `zone`, in their order.
    pub(super) fn near(&self, zone: Bounds) -> impl Iterator<Item = &PathSegment> {
        self.index.overlapping(&zone).into_iter().map(|i| &self.list[i])
    }

    /// The approaches of `path` to these paths, a pair of segments each, as far as their boxes come within `reach` mm.
    pub(super) fn approaches<'s>(
        &'s self,
        path: &'s Path,
        reach: f64,
    ) -> impl Iterator<Item = Approach> + 's {
        path.segments.iter().flat_map(move |segment| {
            self.near(segment.bounds().grown(reach)).map(|across| Approach::of(segment, across))
        })
    }

    /// Whether an end of the path number `number` lies within `reach` of another path, or of its own where it closes a loop. A path is
    /// near to itself beside its own end, and a loop no wider than twice the `reach` is a hairpin.
    pub(super) fn has_joint(
        &self,
        (number, path): (usize, &Path),
        end: Point,
        is_start: bool,
        reach: f64,
    ) -> bool {
        let length = path.length();
        self.near(Bounds::of_points([end]).grown(reach)).any(|near| {
            let t = near.segment.nearest_fraction(end);
            let s = near.before + t * near.segment.length();
            let ends = if is_start { [0.0, s] } else { [s, length] };
            let closes_loop = || {
                let area = Path::closed(path.part(ends[0], ends[1]).segments).area().abs();
                ends[1] - ends[0] > 4.0 * reach && 2.0 * area > reach * (ends[1] - ends[0])
            };
            near.segment.point(t).distance(end) <= reach && (near.path != number || closes_loop())
        })
    }
}
