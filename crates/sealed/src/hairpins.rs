//! **Hairpins**: corners of a weld whose legs lie on each other. The search for bottlenecks leaves out neighbours, which are near each
//! other at every corner.

use crate::fault::{ShapeCode, quoted};
use crate::layout::{Line, LineUse};
use crate::notes::SealingNotes;
use geom::{Path, Point};

/// Faults of sharp corners of welds and walls whose legs, as far as both go, are never a band from each other. Legs shorter than the band
/// are its end.
pub(super) fn hairpins(lines: &[Line], band: f64, notes: &mut SealingNotes) {
    for line in lines.iter().filter(|line| matches!(line.kind, LineUse::Weld | LineUse::Wall)) {
        let segments = &line.path.segments;
        let mut before = vec![0.0];
        for segment in segments {
            before.push(before[before.len() - 1] + segment.length());
        }
        for (i, pair) in segments.windows(2).enumerate() {
            if pair[0].tangent(1.0).dot(pair[1].tangent(0.0)) >= 0.0 {
                continue;
            }
            let widest = widest(&line.path, &before, i + 1, band);
            if let Some(widest) = widest.filter(|widest| *widest < band - 1e-6) {
                let own = quoted(&line.names);
                let what =
                    format!("the legs of a corner of {own} lie at most {widest:.3} mm from each other");
                let remedy = format!("spread them to at least {band} mm, or draw one line");
                let numbers = [widest, band];
                notes.fault(ShapeCode::BandsOverlap, &line.names, pair[1].start(), (what, remedy), numbers);
            }
        }
    }
}

/// The largest distance of points equally far from the corner before segment `at` on both legs, where it is known to be below `band`;
/// `None` for legs shorter than that. `before` is the length before each segment.
fn widest(path: &Path, before: &[f64], at: usize, band: f64) -> Option<f64> {
    let (corner, whole) = (before[at], before[before.len() - 1]);
    let shorter = corner.min(whole - corner);
    if shorter <= band {
        return None;
    }
    let point = |s: f64| -> Point {
        let i = before.partition_point(|start| *start <= s).clamp(1, path.segments.len()) - 1;
        path.segments[i].point(((s - before[i]) / (before[i + 1] - before[i])).clamp(0.0, 1.0))
    };
    let apart = |far: f64| point(corner - far).distance(point(corner + far));
    let mut widest = apart(shorter);
    // A quarter more each time: few places, however long the legs are.
    let mut far = band / 2.0;
    while far < shorter && widest < band {
        widest = widest.max(apart(far));
        far *= 1.25;
    }
    Some(widest)
}
