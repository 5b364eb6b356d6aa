//! Airtightness of the seal: topology of every seam, and the forecast of its strength.
//!
//! A **leak** is a way for air that the design leaves open; a **weakness** is a place that may fail. Both are computed from the geometry
//! and the order of the iron's path, independently of their construction.

mod leaks;
mod topology;

use std::fmt;

use design::{Design, FlatPiece, PlacedPart, Refusal, RefusalCode, Refusals};
use forecast::case::Case;
use forecast::seal_load::{SealLoad, seal_loads};
use sealed::PieceName;
use spec::{Machine, Spec, key};

pub use leaks::shape_leaks;
pub use topology::{Passage, passage};

/// The checks of a design's seals.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SealReport {
    /// All distinct pieces: the first of equal ones, its passages, its loads.
    pub pieces: Vec<PieceReport>,
    /// Leaks, each with the key to change.
    pub leaks: Refusals,
}

/// One distinct piece.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceReport {
    /// Name of the first of equal pieces.
    pub name: PieceName,
    /// The passages of air.
    pub passage: Passage,
    /// The load on the seal where it bends and where it is straight; only of stars.
    pub loads: Vec<SealLoad>,
}

/// The leaks of `design`; empty if it is tight. Computed from the geometry alone; no mechanics is solved.
pub fn leaks(spec: &Spec, machine: &Machine, design: &Design) -> Refusals {
    open_ways(&passages(spec, machine, design), design)
}

/// The report on `design`.
pub fn report(spec: &Spec, machine: &Machine, design: &Design) -> SealReport {
    let pieces_with_passages = passages(spec, machine, design);
    let mut report = SealReport { leaks: open_ways(&pieces_with_passages, design), ..SealReport::default() };
    for (placed, passage) in pieces_with_passages {
        let name = placed.name();
        let loads = match design.part(placed) {
            // A valid spec has a valid case; without one there is no load to report.
            FlatPiece::Star(star) => {
                Case::of_part(spec, star).map_or_else(|_| Vec::new(), |case| seal_loads(spec, &case, star))
            }
            FlatPiece::Drawn(_) => Vec::new(),
        };
        report.pieces.push(PieceReport { name, passage, loads });
    }
    report
}

/// The first of each group of equal pieces, with its passages.
fn passages<'a>(spec: &Spec, machine: &Machine, design: &'a Design) -> Vec<(&'a PlacedPart, Passage)> {
    design.firsts().map(|first| (first, passage(spec, machine, design.part(first)))).collect()
}

fn open_ways(passages: &[(&PlacedPart, Passage)], design: &Design) -> Refusals {
    let of_pieces = passages.iter().flat_map(|(placed, passage)| {
        passage.leaks.iter().cloned().map(move |leak| Refusal {
            key: leak.key.of_star(placed.index),
            found: format!("{}: {}", placed.name(), leak.found),
            ..leak
        })
    });
    let overlap_of_pieces =
        topology::between_pieces(design).filter(|distance| *distance <= 0.0).map(|distance| {
            let kind = design.placed().first().map_or("piece", |placed| placed.kind);
            let problem = format!("the bands of two {kind}s overlap by {:.3} mm", -distance);
            let remedy = format!("gap must be {:.3} mm larger, or the allowance", 1e-3 - distance);
            Refusal::new(key::sheet::GAP, RefusalCode::StarsOverlap, problem, remedy)
        });
    of_pieces.chain(overlap_of_pieces).collect()
}

/// "the inlet", "the 2 inlets"; `None` for none.
fn opening(number: usize, word: &str) -> Option<String> {
    match number {
        0 => None,
        1 => Some(format!("the {word}")),
        _ => Some(format!("the {number} {word}s")),
    }
}

impl fmt::Display for SealReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "seal:")?;
        for piece in &self.pieces {
            writeln!(f, "  {}", piece.name)?;
            write!(f, "{}", piece.passage)?;
            for load in &piece.loads {
                writeln!(f, "    {load}")?;
            }
        }
        for leak in self.leaks.iter() {
            writeln!(f, "  LEAK: {}", leak.found)?;
        }
        if self.leaks.is_empty() {
            let inlets = self.pieces.iter().map(|piece| piece.passage.inlets).max().unwrap_or(0);
            let valves = self.pieces.iter().map(|piece| piece.passage.valves).max().unwrap_or(0);
            let exception = match [opening(inlets, "inlet"), opening(valves, "valve")] {
                [Some(inlets), Some(valves)] => format!(" except {inlets} and {valves}"),
                [Some(openings), None] | [None, Some(openings)] => format!(" except {openings}"),
                [None, None] => "; the tube is closed all around, without an inlet".to_owned(),
            };
            writeln!(f, "  airtight: no opening{exception}")?;
        }
        Ok(())
    }
}
