//! All segments of several paths, with a search for those near a place.

use geom::{Bounds, BoxIndex, Path, Segment};

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
}
