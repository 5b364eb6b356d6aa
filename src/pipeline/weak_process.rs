//! Seams of several strengths: whether the weak one opens first.

use crate::pipeline::{Forecast, Interface};
use design::FlatPiece;
use forecast::case::Case;
use forecast::seal_load::{LoadedHinge, first_to_open};
use program::plan::distinct_processes;
use spec::SealProcess;
use spec::units::LineForce;

/// What the words of a process that is to open first begin with.
const WEAK: [&str; 3] = ["weak", "tear", "peel"];

/// The notes on the processes of the seams of `forecast`: which is the weakest, and which should be but is not.
pub(super) fn weak_processes(forecast: &Forecast, interface: Interface<'_>) -> Vec<String> {
    let processes = distinct_processes(&forecast.programs);
    if processes.len() < 2 {
        return Vec::new();
    }
    let mut texts: Vec<String> = Vec::new();
    for weak in processes.iter().filter(|process| is_weak(process)) {
        texts.extend(stronger_than_others(weak, &processes));
    }
    let drawn_first = forecast.drawn.as_ref().and_then(|drawn| drawn.prediction.bursts_first.as_ref());
    let first = drawn_first
        .map(|first| (format!("seam {}", first.place()), first.process.clone()))
        .or_else(|| forecast.first_loop().map(|first| (first.name.to_owned(), first.process)));
    match (weakest(&processes), first) {
        (Some((weakest, strength)), Some((seam, process))) if process != weakest.name => texts.push(format!(
            "process {} is the weakest, {strength}, and the {seam} of process {process} opens before its seams: the pull there is larger",
            weakest.name,
        )),
        (Some((weakest, strength)), None) => texts.push(format!(
            "process {} is the weakest, {strength}: its seams open first unless others are pulled harder; {}",
            weakest.name,
            pull_of_each(forecast, interface)
        )),
        _ => {}
    }
    texts
}

/// A loop of a star that opens before every other seam.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstLoop {
    /// The loop and the places where it is pulled hardest, in words.
    pub name: &'static str,
    /// The name of its process.
    pub process: String,
}

impl Forecast {
    /// The loop that opens first in the star with the lowest burst pressure; `None` where both loops are equally strong, or one is of
    /// unknown strength, or without a pressure.
    pub fn first_loop(&self) -> Option<FirstLoop> {
        let stars = &self.prediction.as_ref()?.stars;
        let bursts =
            stars.iter().zip(1..).filter_map(|(star, index)| Some((star.burst_pressure_kPa?, index)));
        let (_, index) = bursts.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let placed = self.design.placed().iter().find(|placed| placed.index == index)?;
        let FlatPiece::Star(star) = self.design.part(placed) else { return None };
        let (loop_index, name) = match first_to_open(&Case::of_part(&self.spec, star).ok()?)? {
            LoadedHinge::Tip => (0, "inner loop at the tips"),
            LoadedHinge::Corner => (1, "outer loop at the corners"),
        };
        Some(FirstLoop { name, process: star.seam_lines.get(loop_index)?.process.clone() })
    }
}

/// The way to the pull on each seam.
fn pull_of_each(forecast: &Forecast, interface: Interface<'_>) -> String {
    let Some(inflated) = &forecast.drawn else { return interface.pulls().to_owned() };
    if inflated.prediction.chambers.iter().any(|chamber| chamber.seams.is_some()) {
        // The shell was computed, but its wrinkles were averaged: folds may pull harder.
        let list = interface.drawn_pulls();
        format!(
            "{list} lists the largest pull on each seam, but no burst pressure: which opens first is unknown"
        )
    } else {
        interface.shell().to_owned()
    }
}

fn is_weak(process: &SealProcess) -> bool {
    WEAK.iter().any(|word| process.name.starts_with(word))
}

/// The process with the least strength, if all strengths are known and differ.
fn weakest<'p>(processes: &[&'p SealProcess]) -> Option<(&'p SealProcess, LineForce)> {
    let strengths: Vec<(&SealProcess, LineForce)> =
        processes.iter().map(|process| Some((*process, process.strength?))).collect::<Option<_>>()?;
    let lowest = strengths.iter().copied().min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    strengths.iter().any(|(_, strength)| *strength != lowest.1).then_some(lowest)
}

/// The warning that a process whose name says that it is weak is as strong as another.
fn stronger_than_others(weak: &SealProcess, processes: &[&SealProcess]) -> Option<String> {
    let peel = weak.strength?;
    let other = processes.iter().find(|other| {
        other.name != weak.name && other.strength.is_some_and(|strength| strength.0 <= peel.0)
    })?;
    let strength = other.strength?;
    Some(format!(
        "process {} has a strength of {peel}, and process {} has {strength}: its seams are not the first to open; \
         write a lower `strength` in [process.{}] if a peel test shows one",
        weak.name, other.name, weak.name
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::{Machine, Source, read};

    /// The forecast of a star whose loops have processes of these strengths, N/mm, with the lines `rest` in its spec.
    fn forecast(name: &str, [inner, outer]: [f64; 2], rest: &str) -> Forecast {
        let text = format!(
            "schema = 1\nname = \"x\"\n[fabric]\nseal_strength = \"{outer} N/mm\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\n\
             tube_width = \"30 mm\"\ntip_angle = \"30 deg\"\ninner_process = \"{name}\"\n[process.{name}]\nstrength = \"{inner} N/mm\"\n{rest}"
        );
        let reading = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}"));
        Forecast::new(reading.spec, Machine::builtin("generic").expect("built in")).expect("a design")
    }

    /// The notes on that star without a pressure.
    fn texts(name: &str, strengths: [f64; 2]) -> Vec<String> {
        weak_processes(&forecast(name, strengths, ""), Interface::Command("x.toml"))
    }

    /// Under pressure the loop that opens first is told: the tips pull harder at the inner one, unless it is much stronger.
    #[test]
    fn the_loop_that_opens_first_is_named() {
        for (strengths, name, process) in [
            ([1.0, 3.0], "inner loop at the tips", "strong"),
            ([9.0, 1.0], "outer loop at the corners", "seal"),
            ([3.1, 3.0], "inner loop at the tips", "strong"),
        ] {
            let star = forecast("strong", strengths, "[load]\npressure = \"10 kPa\"\n");
            let first = FirstLoop { name, process: process.to_owned() };
            assert_eq!(star.first_loop(), Some(first), "{strengths:?}");
            let notes = weak_processes(&star, Interface::Command("x.toml"));
            // The third is pulled harder at the stronger loop.
            assert_eq!(notes.len(), usize::from(strengths[0] > 3.0 && process == "strong"), "{notes:?}");
        }
        let equal = forecast("strong", [3.0, 3.0], "[load]\npressure = \"10 kPa\"\n");
        assert_eq!(equal.first_loop(), None);
    }

    #[test]
    fn a_weak_seam_that_is_as_strong_as_another_is_warned_of() {
        for name in ["weak", "weak-tip", "tear", "peel2"] {
            for strengths in [[2.0, 1.0], [1.0, 1.0]] {
                let notes = texts(name, strengths);
                let text = notes.first().expect("a warning");
                let [inner, outer] = strengths;
                assert!(
                    text.starts_with(&format!("process {name} has a strength of {inner} N/mm, and process seal has {outer} N/mm: its seams are not the first to open")),
                    "{text}"
                );
            }
        }
        let [text] = &texts("weak", [0.5, 1.0])[..] else { panic!("one note") };
        assert!(
            text.starts_with("process weak is the weakest, 0.5 N/mm: its seams open first unless"),
            "{text}"
        );
        // A process that is not to open first may be as strong as it likes.
        assert_eq!(texts("strong", [1.0, 1.0]), [""; 0]);
    }
}
