//! Faults, warnings and repairs on the way from a sketch to a shape.

use crate::clean::{Crowd, Piece, pieces, without_doubles};
use crate::crossings::{PieceCrossing, crossings_of_open, split_pieces};
use crate::fault::{Repair, ShapeCode, ShapeFault, ShapeWarning, quoted};
use crate::join::{Network, network};
use crate::sketch::DrawnCurve;
use crate::spikes::{Spike, without_spikes};
use geom::Point;

/// Repairs, warnings and faults in the order in which they are found.
#[derive(Default)]
pub(super) struct SealingNotes {
    pub repairs: Vec<Repair>,
    pub warnings: Vec<ShapeWarning>,
    pub faults: Vec<ShapeFault>,
}

impl SealingNotes {
    /// Notes that a gap of `gap` mm between the curves `names` was closed.
    pub(super) fn gap_closed(&mut self, names: Vec<String>, place: Point, gap: f64) {
        let gap = if gap < 1e-4 { "less than 0.0001".to_owned() } else { format!("{gap:.4}") };
        let what = format!("gap of {gap} mm in {} closed", quoted(&names));
        self.repairs.push(Repair { names, place, what });
    }

    /// Notes a fault of the curves `names` at `place`: the finding and its remedy, and the values found and allowed.
    pub(super) fn fault(
        &mut self,
        code: ShapeCode,
        names: &[String],
        place: Point,
        text: (impl Into<String>, impl Into<String>),
        numbers: [f64; 2],
    ) {
        self.faults.push(ShapeFault::new(code, names, place, text, numbers));
    }

    /// What was found; nothing, with a fault, where too many curves lie near each other.
    pub(super) fn unless_crowded<T: Default>(&mut self, found: Result<T, Crowd>) -> T {
        found.unwrap_or_else(|Crowd(place)| {
            let what = "too many curves lie on or near each other";
            let remedy = "remove copies and hatches, or put them on an ignored layer";
            self.fault(ShapeCode::Crowded, &[], place, (what, remedy), [f64::NAN; 2]);
            T::default()
        })
    }

    /// The network of drawn curves, mended, and the names of the curves.
    pub(super) fn mended(&mut self, drawn: &[DrawnCurve], join: f64) -> (Vec<Piece>, Network, Vec<String>) {
        let names: Vec<String> = drawn.iter().map(|drawn| drawn.name.clone()).collect();
        let (pieces, spikes) = without_spikes(pieces(drawn, &mut self.repairs, &mut self.faults), join);
        for Spike { source, tip, length } in spikes {
            let names = named(&[source], &names);
            let what =
                format!("a spike in {}, {length:.3} mm out and back on itself, left out", quoted(&names));
            self.repairs.push(Repair { names, place: tip, what });
        }
        let pieces = self.once(pieces, &names, join);
        let network = self.joined(&pieces, &names, join);
        (pieces, network, names)
    }

    /// The pieces of drawn curves, each stretch once, and the names of the curves.
    pub(super) fn mended_pieces(&mut self, drawn: &[DrawnCurve], join: f64) -> (Vec<Piece>, Vec<String>) {
        let names: Vec<String> = drawn.iter().map(|drawn| drawn.name.clone()).collect();
        let pieces = pieces(drawn, &mut self.repairs, &mut self.faults);
        (self.once(pieces, &names, join), names)
    }

    /// The pieces of curves with `names`, each stretch once.
    fn once(&mut self, pieces: Vec<Piece>, names: &[String], join: f64) -> Vec<Piece> {
        let (pieces, doubled) = self.unless_crowded(without_doubles(pieces, join));
        for (sources, place) in doubled {
            let names = named(&sources, names);
            let what = format!("a curve drawn twice in {} merged", quoted(&names));
            self.repairs.push(Repair { names, place, what });
        }
        pieces
    }

    /// The network of `pieces` of curves with `names`.
    pub(super) fn joined(&mut self, pieces: &[Piece], names: &[String], join: f64) -> Network {
        let network = network(pieces, join);
        for (sources, place, gap) in &network.closed_gaps {
            self.gap_closed(named(sources, names), *place, *gap);
        }
        network
    }

    /// The pieces, of which open ones that cross are split there: welds that cross are sealed as welds that meet.
    pub(super) fn split_at_crossings(
        &mut self,
        pieces: Vec<Piece>,
        names: &[String],
        join: f64,
    ) -> Vec<Piece> {
        let crossings = crossings_of_open(&pieces, join);
        for PieceCrossing { pieces: [a, b], place, .. } in &crossings {
            let mut names = named(&[pieces[*a].source, pieces[*b].source], names);
            names.dedup();
            let what = format!("{} split at a crossing", quoted(&names));
            self.repairs.push(Repair { names, place: *place, what });
        }
        split_pieces(pieces, &crossings, join)
    }
}

/// The names of the curves `sources`.
pub(super) fn named(sources: &[usize], names: &[String]) -> Vec<String> {
    sources.iter().filter_map(|source| names.get(*source).cloned()).collect()
}
