//! Whether the seal is tight: topology of every seam, and what the forecast says of its strength.
//!
//! A **leak** is a way for air that the design leaves open; a **weakness** is a place that may fail. Both are read off the
//! geometry and the order in which the iron travels it, not assumed from how they were made.

mod leaks;
mod topology;

use std::fmt;

use crate::design::{Design, FlatPiece, PlacedPart, Refusal, RefusalCode, Refusals};
use crate::forecast::case::Case;
use crate::forecast::seal_load::{SealLoad, seal_loads};
use crate::shape::PieceName;
use crate::spec::{Machine, Spec, key};

pub use leaks::shape_leaks;
pub use topology::{Passage, passage};

/// What is to be said about the seals of a design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SealReport {
    /// Every distinct piece: the first that is like it, its passages, its loads.
    pub pieces: Vec<PieceReport>,
    /// Ways for air that are open, each with the key that is best changed.
    pub leaks: Refusals,
    /// Places that may fail.
    pub weaknesses: Vec<String>,
}

/// One distinct piece.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceReport {
    /// The first piece that is like it.
    pub name: PieceName,
    /// Where air goes and where it must not.
    pub passage: Passage,
    /// The load on the seal where it bends and where it is straight; only of stars.
    pub loads: Vec<SealLoad>,
}

/// The ways for air that `design` leaves open; best none. Read off the geometry alone, no mechanics is solved.
pub fn leaks(spec: &Spec, machine: &Machine, design: &Design) -> Refusals {
    open_ways(&passages(spec, machine, design), design)
}

/// The report on `design`.
pub fn report(spec: &Spec, machine: &Machine, design: &Design) -> SealReport {
    let passages = passages(spec, machine, design);
    let mut report = SealReport { leaks: open_ways(&passages, design), ..SealReport::default() };
    for (placed, passage) in passages {
        let name = placed.name();
        let of_piece = |text: &String| format!("{name}: {text}");
        report.weaknesses.extend(passage.weaknesses.iter().map(of_piece));
        let loads = match design.part(placed) {
            // No valid spec has a fabric without a case; without one there would be no load to speak of.
            FlatPiece::Star(star) => {
                Case::of(spec, &star.star).map_or_else(|_| Vec::new(), |case| seal_loads(&case, star))
            }
            FlatPiece::Drawn(_) => Vec::new(),
        };
        report.weaknesses.extend(loads.iter().filter_map(SealLoad::weakness).map(|text| of_piece(&text)));
        report.pieces.push(PieceReport { name, passage, loads });
    }
    report
}

/// Of every distinct piece the first that is like it, and its passages.
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
    let between = topology::between_pieces(design).filter(|distance| *distance <= 0.0).map(|distance| {
        let kind = design.placed().first().map_or("piece", |placed| placed.kind);
        let found = format!("the bands of two {kind}s overlap by {:.3} mm", -distance);
        let remedy = format!("gap must be {:.3} mm larger, or the allowance", 1e-3 - distance);
        Refusal::new(key::sheet::GAP, RefusalCode::StarsOverlap, found, remedy)
    });
    of_pieces.chain(between).collect()
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
        for leak in &self.leaks {
            writeln!(f, "  LEAK: {}", leak.found)?;
        }
        for weakness in &self.weaknesses {
            writeln!(f, "  warning: {weakness}")?;
        }
        if self.leaks.is_empty() {
            let but = if self.pieces.iter().any(|piece| piece.passage.inlet.is_some()) {
                " but the inlet"
            } else {
                ": the tube is closed all around, without an inlet"
            };
            writeln!(f, "  tight: no way for air{but}")?;
        }
        Ok(())
    }
}
