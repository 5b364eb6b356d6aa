//! Ends of drawn welds that miss an edge of the air by a gap: it is closed as one between two ends is.

use crate::clean::{NOTHING, with_end};
use crate::layout::Layout;
use crate::notes::SealingNotes;
use crate::segments::Segments;
use crate::sketch::Rules;
use geom::{Bounds, Path, SegmentIndex};

/// Moves each end of `welds` that lies off every band of `lines`, but within `join` of an edge of the air, to that edge, where the band
/// begins. Each weld comes with its names.
pub(super) fn close_edge_gaps(
    welds: &mut [(Path, Vec<String>)],
    lines: &Layout,
    rules: &Rules,
    notes: &mut SealingNotes,
) {
    let edges = Segments::of(&lines.air.closed);
    let bands = SegmentIndex::new(lines.lines.iter().flat_map(|line| line.path.segments.clone()).collect());
    let reach = rules.band / 2.0 + 2e-6;
    for (path, names) in welds {
        for is_start in [true, false] {
            let mut way = if is_start { path.reversed() } else { path.clone() };
            let Some(last) = way.segments.last_mut() else { continue };
            let end = last.end();
            let near = edges.near(Bounds::of_points([end]).grown(rules.join));
            let feet = near.map(|edge| edge.segment.point(edge.segment.nearest_fraction(end)));
            let feet = feet.map(|foot| (foot.distance(end), foot)).filter(|(gap, _)| *gap <= rules.join);
            let Some((gap, foot)) = feet.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
            if gap <= NOTHING || bands.has_within(end, reach) {
                continue;
            }
            *last = with_end(last, foot);
            *path = if is_start { way.reversed() } else { way };
            let nearest = lines.lines.iter().find(|line| line.path.distance(foot) < reach);
            let other = nearest.map_or(Vec::new(), |line| line.names.clone());
            notes.gap_closed([names.clone(), other].concat(), foot, gap);
        }
    }
}
