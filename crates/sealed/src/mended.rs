//! The first pass, from a sketch to **mended** curves: what is drawn twice counts once, small gaps are closed, and curves that meet are one
//! network.
//!
//! Curves of each role are mended by themselves. Where edges cross or end in the open, none goes on to the next pass. The notes of seams,
//! cuts and valves are told by the passes that use them.

use crate::doubles::{Doubled, without_doubles};
use crate::fault::{Noted, Quoted, Repair, SealingNotes, named};
use crate::loose_ends::{crossings, loose_ends};
use crate::mouth::Mouth;
use crate::network::{Network, NetworkEdge, network as joined};
use crate::pieces::{Piece, PieceCrossing, crossings_of_open, pieces, split_pieces};
use crate::port_gaps::{PortGaps, port_gaps};
use crate::sketch::{DrawnCurve, DrawnPort, PortPlace, Rules, Sketch};
use crate::spikes::{Spike, without_spikes};
use geom::Path;

/// A sketch, mended role by role.
pub(crate) struct MendedSketch {
    /// The ports, each once.
    pub ports: Vec<DrawnPort>,
    pub edges: MendedEdges,
    pub seams: Noted<MendedCurves>,
    pub cuts: MendedCuts,
    pub valves: Noted<Vec<NamedPath>>,
}

/// Edges of the air, mended. The network is empty where they have faults.
#[derive(Default)]
pub(crate) struct MendedEdges {
    pub network: Network,
    /// The names of the drawn curves, by the numbers that sources are.
    pub names: Vec<String>,
    /// The drawn curves that are closed, with their numbers.
    pub rings: Vec<(usize, Path)>,
    /// The mouths of necks that are drawn open.
    pub mouths: Vec<Mouth>,
}

/// Curves that are only cut: closed paths, each kind with its notes.
pub(crate) struct MendedCuts {
    pub holes: Noted<Vec<NamedPath>>,
    pub cuts: Noted<Vec<NamedPath>>,
}

/// Drawn curves of one role, mended.
pub(crate) struct MendedCurves {
    pub pieces: Vec<Piece>,
    pub network: Network,
    /// The names of the drawn curves, by the numbers that sources are.
    pub names: Vec<String>,
}

/// A path with the names of the drawn curves that it is made of.
#[derive(Clone, Debug)]
pub(crate) struct NamedPath {
    pub path: Path,
    pub names: Vec<String>,
}

/// How the curves of a role are mended.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mending {
    /// Edges and cuts enclose something: a spike, which encloses nothing, is left out.
    Edges,
    /// Welds that cross are sealed as welds that meet: they are split there.
    Welds,
}

/// A sketch, mended. Its notes are those of ports and of edges of the air.
pub(crate) fn mended(sketch: &Sketch, rules: &Rules) -> Noted<MendedSketch> {
    let (ports, mut notes) = ports_once(&sketch.ports, rules.join);
    let (edges, edge_notes) = mended_edges(&sketch.air, &ports, rules);
    notes += edge_notes;
    let (seams, mut seam_notes) = mended_curves(&sketch.seams, Mending::Welds, rules.join);
    seam_notes.faults.extend(crossings(&seams.network, &seams.names, rules.join));
    let cuts = MendedCuts {
        holes: closed_paths(&sketch.holes, rules.join),
        cuts: closed_paths(&sketch.cuts, rules.join),
    };
    let valves = closed_paths(&sketch.valves, rules.join);
    (MendedSketch { ports, edges, seams: (seams, seam_notes), cuts, valves }, notes)
}

/// The ports, each that was drawn twice at one place once.
fn ports_once(ports: &[DrawnPort], join: f64) -> Noted<Vec<DrawnPort>> {
    let mut single: Vec<DrawnPort> = Vec::new();
    let mut notes = SealingNotes::default();
    for port in ports {
        let first = single.iter().find(|earlier| is_same_place(&earlier.place, &port.place, join));
        let Some(first) = first else {
            single.push(port.clone());
            continue;
        };
        let names = vec![first.name.clone(), port.name.clone()];
        let finding = format!("a port drawn twice in {} merged", Quoted(&names));
        notes.repairs.push(Repair { names, place: port.place.middle(), what: finding });
    }
    (single, notes)
}

/// Whether two ports lie within `join` mm of each other.
fn is_same_place(a: &PortPlace, b: &PortPlace, join: f64) -> bool {
    match (a, b) {
        (PortPlace::At(p), PortPlace::At(q)) => p.distance(*q) <= join,
        (PortPlace::Across([a, b]), PortPlace::Across([c, d])) => {
            let are_parallel = a.distance(*c) <= join && b.distance(*d) <= join;
            are_parallel || a.distance(*d) <= join && b.distance(*c) <= join
        }
        (PortPlace::At(_), PortPlace::Across(_)) | (PortPlace::Across(_), PortPlace::At(_)) => false,
    }
}

/// Edges of the air, whose outlines may be open at `ports`.
fn mended_edges(curves: &[DrawnCurve], ports: &[DrawnPort], rules: &Rules) -> Noted<MendedEdges> {
    let (MendedCurves { mut pieces, mut network, names }, mut notes) =
        mended_curves(curves, Mending::Edges, rules.join);
    // Curves that are left out with a fault hide no faults of the others.
    let faults_of_curves = notes.faults.len();
    let (PortGaps { closings, mouths }, gap_notes) = port_gaps(&network, &names, ports, rules);
    notes += gap_notes;
    if !closings.is_empty() {
        pieces.extend(closings);
        network = joined(&pieces, rules.join);
    }
    let remedy = "close it, or put it on a layer of seams if it is a weld that ends in the air";
    notes.faults.extend(loose_ends(&pieces, &network, &names, rules.join, remedy));
    notes.faults.extend(crossings(&network, &names, rules.join));
    if notes.faults.len() > faults_of_curves {
        return (MendedEdges { names, mouths, ..MendedEdges::default() }, notes);
    }
    let closed_curves = curves.iter().enumerate().filter(|(_, curve)| curve.path.closed);
    let rings = closed_curves.map(|(number, curve)| (number, curve.path.clone())).collect();
    (MendedEdges { network, names, rings, mouths }, notes)
}

/// The closed paths of curves that are only cut: they neither cross nor end in the open.
fn closed_paths(curves: &[DrawnCurve], join: f64) -> Noted<Vec<NamedPath>> {
    let (MendedCurves { pieces, network, names }, mut notes) = mended_curves(curves, Mending::Edges, join);
    notes.faults.extend(loose_ends(&pieces, &network, &names, join, "close it"));
    notes.faults.extend(crossings(&network, &names, join));
    let closed_edges = network.edges.into_iter().filter(|edge| edge.nodes.is_none());
    let path = |edge: NetworkEdge| NamedPath { names: named(&edge.sources, &names), path: edge.path };
    (closed_edges.map(path).collect(), notes)
}

/// Curves of one role as a network, each stretch once.
///
/// Curves become pieces first. Spikes are left out before stretches along other curves are, welds are split where they cross after it. What
/// meets within `join` mm is then one network.
pub(crate) fn mended_curves(curves: &[DrawnCurve], mending: Mending, join: f64) -> Noted<MendedCurves> {
    let names: Vec<String> = curves.iter().map(|curve| curve.name.clone()).collect();
    let (mut drawn_pieces, mut notes) = pieces(curves);
    if mending == Mending::Edges {
        let (smooth, spikes) = without_spikes(drawn_pieces, join);
        drawn_pieces = smooth;
        for Spike { source, tip, length } in spikes {
            let names = named(&[source], &names);
            let finding =
                format!("a spike in {}, {length:.3} mm out and back on itself, left out", Quoted(&names));
            notes.repairs.push(Repair { names, place: tip, what: finding });
        }
    }
    let (mut pieces, doubled) = notes.unless_crowded(without_doubles(drawn_pieces, join));
    for Doubled { sources, place } in doubled {
        let names = named(&sources, &names);
        let finding = format!("a curve drawn twice in {} merged", Quoted(&names));
        notes.repairs.push(Repair { names, place, what: finding });
    }
    if mending == Mending::Welds {
        let piece_crossings = crossings_of_open(&pieces, join);
        for PieceCrossing { pieces: [a, b], place, .. } in &piece_crossings {
            let mut names = named(&[pieces[*a].source, pieces[*b].source], &names);
            names.dedup();
            let finding = format!("{} split at a crossing", Quoted(&names));
            notes.repairs.push(Repair { names, place: *place, what: finding });
        }
        pieces = split_pieces(pieces, &piece_crossings, join);
    }
    let network = joined(&pieces, join);
    for gap in &network.closed_gaps {
        notes.gap_closed(named(&gap.sources, &names), gap.place, gap.width);
    }
    (MendedCurves { pieces, network, names }, notes)
}
