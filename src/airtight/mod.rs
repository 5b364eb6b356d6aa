//! Whether the seal is tight: topology of every seam, and what the forecast says of its strength.
//!
//! A **leak** is a way for air that the design leaves open; a **weakness** is a place that may fail. Both are read off the
//! geometry and the order in which the iron travels it, not assumed from how they were made.

mod leaks;
mod topology;

use std::fmt;

use crate::design::{Design, Refusal, RefusalCode, Refusals};
use crate::forecast::case::Case;
use crate::forecast::seal_load::{SealLoad, seal_loads};
use crate::spec::{Machine, Spec, key};

pub use leaks::shape_leaks;
pub use topology::{Passage, passage};

/// What is to be said about the seals of a design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Every distinct star: the number of the first that is like it, its passages, its loads.
    pub stars: Vec<StarReport>,
    /// Ways for air that are open, each with the key that is best changed.
    pub leaks: Refusals,
    /// Places that may fail.
    pub weaknesses: Vec<String>,
}

/// One distinct star.
#[derive(Clone, Debug, PartialEq)]
pub struct StarReport {
    /// Number of the first star that is like it.
    pub index: usize,
    /// Where air goes and where it must not.
    pub passage: Passage,
    /// The load on the seal where it bends and where it is straight.
    pub loads: Vec<SealLoad>,
}

/// The ways for air that `design` leaves open; best none. Read off the geometry alone, no mechanics is solved.
pub fn leaks(spec: &Spec, machine: &Machine, design: &Design) -> Refusals {
    open_ways(&passages(spec, machine, design), design)
}

/// The report on `design`.
pub fn report(spec: &Spec, machine: &Machine, design: &Design) -> Report {
    let passages = passages(spec, machine, design);
    let mut report = Report { leaks: open_ways(&passages, design), ..Report::default() };
    for ((index, passage), part) in passages.into_iter().zip(&design.distinct) {
        let of_star = |text: &String| format!("star {index}: {text}");
        report.weaknesses.extend(passage.weaknesses.iter().map(of_star));
        // No valid spec has a fabric without a case; without one there would be no load to speak of.
        let loads = Case::of(spec, &part.star).map_or_else(|_| Vec::new(), |case| seal_loads(&case, part));
        report.weaknesses.extend(loads.iter().filter_map(SealLoad::weakness).map(|text| of_star(&text)));
        report.stars.push(StarReport { index, passage, loads });
    }
    report
}

/// Of every distinct star the number of the first that is like it, and its passages.
fn passages(spec: &Spec, machine: &Machine, design: &Design) -> Vec<(usize, Passage)> {
    let first =
        |number| design.stars.iter().find(|star| star.distinct == number).map_or(0, |star| star.index);
    let parts = design.distinct.iter().enumerate();
    parts.map(|(number, part)| (first(number), passage(spec, machine, part))).collect()
}

fn open_ways(passages: &[(usize, Passage)], design: &Design) -> Refusals {
    let of_stars = passages.iter().flat_map(|(index, passage)| {
        passage.leaks.iter().cloned().map(move |leak| Refusal {
            key: leak.key.of_star(*index),
            found: format!("star {index}: {}", leak.found),
            ..leak
        })
    });
    let between = topology::between_stars(design).filter(|distance| *distance <= 0.0).map(|distance| {
        let found = format!("the bands of two stars overlap by {:.3} mm", -distance);
        let remedy = format!("gap must be {:.3} mm larger, or the allowance", 1e-3 - distance);
        Refusal::new(key::sheet::GAP, RefusalCode::StarsOverlap, found, remedy)
    });
    of_stars.chain(between).collect()
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "seal:")?;
        for star in &self.stars {
            writeln!(f, "  star {}", star.index)?;
            write!(f, "{}", star.passage)?;
            for load in &star.loads {
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
            let but = if self.stars.iter().any(|star| star.passage.inlet.is_some()) {
                " but the inlet"
            } else {
                ": the tube is closed all around, without an inlet"
            };
            writeln!(f, "  tight: no way for air{but}")?;
        }
        Ok(())
    }
}
