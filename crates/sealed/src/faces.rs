//! Faces of a network: the regions between its edges.

use geom::{Path, Point};

/// An edge and whether it is travelled from its first node to its last.
pub(super) type EdgeTravel = (usize, bool);

/// The walks around every face of a network of `edges`, each with the nodes at its ends, the face on the left: counterclockwise around
/// a bounded face, clockwise around a connected part. Every edge is travelled once either way.
pub(super) fn walks(edges: &[(&Path, [usize; 2])]) -> Vec<Vec<EdgeTravel>> {
    let nodes = edges.iter().flat_map(|(_, nodes)| *nodes).max().map_or(0, |last| last + 1);
    let mut around: Vec<Vec<EdgeTravel>> = vec![Vec::new(); nodes];
    for (number, (_, [start, end])) in edges.iter().enumerate() {
        around[*start].push((number, true));
        around[*end].push((number, false));
    }
    for leaving in &mut around {
        sort_by_direction(edges, leaving);
    }
    let slot = |(number, forward): EdgeTravel| 2 * number + usize::from(forward);
    let mut position = vec![0; 2 * edges.len()];
    for leaving in &around {
        for (at, travel) in leaving.iter().enumerate() {
            position[slot(*travel)] = at;
        }
    }
    let mut used = vec![false; 2 * edges.len()];
    let mut walks = Vec::new();
    for begin in (0..edges.len()).flat_map(|number| [(number, true), (number, false)]) {
        let (mut walk, mut at) = (Vec::new(), begin);
        while !used[slot(at)] {
            used[slot(at)] = true;
            walk.push(at);
            let (number, forward) = at;
            // Clockwise of the way back lies the next edge of the face on the left.
            let leaving = &around[edges[number].1[usize::from(forward)]];
            let back = position[slot((number, !forward))];
            at = leaving[(back + leaving.len() - 1) % leaving.len()];
        }
        if !walk.is_empty() {
            walks.push(walk);
        }
    }
    walks
}

/// The walk as one closed path.
pub(super) fn walk_path(edges: &[(&Path, [usize; 2])], walk: &[EdgeTravel]) -> Path {
    let travelled = walk.iter().map(|(number, forward)| {
        let path = edges[*number].0;
        if *forward { path.clone() } else { path.reversed() }
    });
    Path::closed(travelled.flat_map(|path| path.segments).collect())
}

/// Counterclockwise by where the edges lead a little way off: bands part along a tangent, too.
fn sort_by_direction(edges: &[(&Path, [usize; 2])], leaving: &mut Vec<EdgeTravel>) {
    if leaving.len() < 2 {
        return;
    }
    let lengths = leaving.iter().map(|(number, _)| edges[*number].0.length());
    let way = lengths.fold(1.0, f64::min) / 3.0;
    let angle = |(number, forward): EdgeTravel| {
        let path = edges[number].0;
        let length = path.length();
        let (from, to) = if forward { (0.0, way) } else { (length, length - way) };
        let at = |s: f64| path.point_at(s).unwrap_or(Point::ORIGIN);
        (at(to) - at(from)).angle()
    };
    let mut by_angle: Vec<(f64, EdgeTravel)> =
        leaving.iter().map(|travel| (angle(*travel), *travel)).collect();
    by_angle.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    *leaving = by_angle.into_iter().map(|(_, travel)| travel).collect();
}
