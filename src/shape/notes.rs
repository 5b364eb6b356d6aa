//! Faults, warnings and repairs on the way from a sketch to a shape.

use crate::shape::clean::{Crowd, Doubled, Piece, pieces, without_doubles};
use crate::shape::fault::{Repair, ShapeCode, ShapeFault, ShapeWarning, quoted};
use crate::shape::join::{Network, network};
use crate::shape::sketch::DrawnCurve;
use inflatable::geom::Point;

/// Repairs, warnings and faults in the order in which they are found.
#[derive(Default)]
pub(super) struct SealingNotes {
    pub repairs: Vec<Repair>,
    pub warnings: Vec<ShapeWarning>,
    pub faults: Vec<ShapeFault>,
}

impl SealingNotes {
    fn doubled(&mut self, doubled: &[Doubled], names: &[String]) {
        for (sources, place) in doubled {
            let names: Vec<String> = sources.iter().map(|source| names[*source].clone()).collect();
            let what = format!("a curve drawn twice in {} merged", quoted(&names));
            self.repairs.push(Repair { names, place: *place, what });
        }
    }

    fn gaps(&mut self, network: &Network, names: &[String]) {
        for (sources, place, gap) in &network.closed_gaps {
            let names: Vec<String> = sources.iter().map(|source| names[*source].clone()).collect();
            self.gap_closed(names, *place, *gap);
        }
    }

    /// Notes that a gap of `gap` mm between the curves `names` was closed.
    pub(super) fn gap_closed(&mut self, names: Vec<String>, place: Point, gap: f64) {
        let gap = if gap < 1e-4 { "less than 0.0001".to_owned() } else { format!("{gap:.4}") };
        let what = format!("gap of {gap} mm in {} closed", quoted(&names));
        self.repairs.push(Repair { names, place, what });
    }

    pub(super) fn fault(
        &mut self,
        code: ShapeCode,
        names: &[String],
        place: Point,
        text: (String, String),
        numbers: [f64; 2],
    ) {
        let ((what, remedy), [found, allowed], names) = (text, numbers, names.to_vec());
        self.faults.push(ShapeFault { code, names, place, found, allowed, what, remedy });
    }

    /// What was found; nothing, with a fault, where too many curves lie near each other.
    pub(super) fn unless_crowded<T: Default>(&mut self, found: Result<T, Crowd>) -> T {
        found.unwrap_or_else(|Crowd(place)| {
            let what = "too many curves lie on or near each other".to_owned();
            let remedy = "remove copies and hatches, or put them on an ignored layer".to_owned();
            self.fault(ShapeCode::Crowded, &[], place, (what, remedy), [f64::NAN; 2]);
            T::default()
        })
    }

    /// The network of drawn curves, mended.
    pub(super) fn mended(&mut self, drawn: &[DrawnCurve], join: f64) -> (Vec<Piece>, Network) {
        let names: Vec<String> = drawn.iter().map(|drawn| drawn.name.clone()).collect();
        let pieces = pieces(drawn, &mut self.repairs, &mut self.faults);
        let (pieces, doubled) = self.unless_crowded(without_doubles(pieces, join));
        self.doubled(&doubled, &names);
        let network = network(&pieces, join);
        self.gaps(&network, &names);
        (pieces, network)
    }
}

/// The names of the curves `sources`.
pub(super) fn named(sources: &[usize], names: &[String]) -> Vec<String> {
    sources.iter().filter_map(|source| names.get(*source).cloned()).collect()
}
