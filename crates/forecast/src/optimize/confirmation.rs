//! Compares an optimum with the shell: each predicted number beside the shell's, and each constraint that a shell can check.

use std::fmt::Write;

use serde::Serialize;

use crate::optimize::{Constraints, Evaluation};
use crate::outcome::Outcome;
use crate::prediction::Prediction;
use crate::ranges::{Interval, mm, shown};
use spec::units::Length;

/// A winner as a shell.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Confirmation {
    /// The predicted numbers beside the shell's.
    pub compared: Vec<ShellComparison>,
    /// The constraints that a shell can judge.
    pub judged: Vec<Judgement>,
}

/// One number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShellComparison {
    /// Its key in a prediction.
    pub what: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The prediction.
    pub predicted: Option<f64>,
    /// Its range.
    pub range: Option<Interval>,
    /// The shell's value.
    pub shell: f64,
    /// Its mesh error.
    pub mesh_error: f64,
    /// Whether the shell's number, within its mesh error, lies in the range; `None` without a range.
    pub in_range: Option<bool>,
}

/// One constraint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judgement {
    /// Its name among the shortfalls.
    pub what: &'static str,
    /// The bound.
    pub bound: f64,
    /// The shell's number.
    pub shell: f64,
    /// Whether the shell's number meets it at the bad end of its mesh error.
    pub met: bool,
}

impl Confirmation {
    /// Compares `candidate`, which met `constraints`, with the prediction of the `shell`.
    pub fn new(candidate: &Evaluation, constraints: &Constraints, shell: &Prediction) -> Self {
        let (star, own) = (&shell.first, candidate.answer.outcome.as_ref());
        let errors = star.evidence.mesh_errors.as_ref();
        let radius = compare(
            ("final_radius_mm", "mm"),
            own.map(|own| Length::from_metres(own.rest.radius).0),
            own.and_then(|own| own.ranges.radius).map(mm),
            star.final_radius_mm.zip(errors.map(|errors| errors.final_radius_mm)),
        );
        let stiffness = compare(
            ("radial_stiffness_N_per_m", "N/m"),
            own.and_then(|own| own.stiffness),
            own.and_then(|own| own.ranges.stiffness),
            star.radial_stiffness_N_per_m.zip(errors.map(|errors| errors.radial_stiffness_N_per_m)),
        );
        let force = compare(
            ("object_force_N", "N"),
            own.and_then(Outcome::object_force),
            own.and_then(|own| own.force_range),
            star.object_force_N.zip(errors.and_then(|errors| errors.object_force_N)),
        );
        let compared = [radius, stiffness, force].into_iter().flatten().collect();
        Self { compared, judged: judged(constraints, shell) }
    }

    /// Whether the shell meets every constraint that it can check.
    pub fn holds(&self) -> bool {
        self.judged.iter().all(|one| one.met)
    }

    /// The comparison as text, one line each.
    pub fn lines(&self) -> Vec<String> {
        let word = match (self.judged.is_empty(), self.holds()) {
            (true, _) => "there is no constraint that it can judge",
            (_, true) => "it meets all constraints that it can judge",
            (_, false) => "it does NOT meet all constraints",
        };
        let mut lines = vec![format!("the shell of the winner: {word}")];
        for one in &self.compared {
            let ShellComparison { what, unit, shell, mesh_error, .. } = *one;
            let mut line = format!("  {what}: {}", shown::meshed(shell, mesh_error, unit));
            let _ = write!(line, "; predicted {}", shown::known(one.predicted, one.range, unit));
            if one.in_range == Some(false) {
                line += ", which does not hold it";
            }
            lines.push(line);
        }
        for Judgement { what, bound, shell, met } in &self.judged {
            let is = if *met { "met" } else { "NOT met" };
            lines.push(format!("  {what}: {is}, {shell:.3} where {bound:.3} is the bound"));
        }
        lines
    }
}

fn compare(
    (what, unit): (&'static str, &'static str),
    predicted: Option<f64>,
    range: Option<Interval>,
    shell: Option<(f64, f64)>,
) -> Option<ShellComparison> {
    let (shell, mesh_error) = shell?;
    let holds = |[low, high]: Interval| shell + mesh_error >= low && shell - mesh_error <= high;
    Some(ShellComparison { what, unit, predicted, range, shell, mesh_error, in_range: range.map(holds) })
}

/// The constraints on closing, payload and force, checked with the shell. The shell gives neither the widest opening nor the burst
/// pressure.
fn judged(constraints: &Constraints, shell: &Prediction) -> Vec<Judgement> {
    let star = &shell.first;
    let force = shell.stars.iter().filter_map(|star| star.object_force_N).reduce(f64::max);
    let at_most = |shell: f64, bound: f64| shell <= bound;
    let at_least = |shell: f64, bound: f64| shell >= bound;
    let judge = |what, shell: Option<f64>, meets: fn(f64, f64) -> bool, bound: Option<f64>| {
        let (shell, bound) = shell.zip(bound)?;
        Some(Judgement { what, bound, shell, met: meets(shell, bound) })
    };
    let all = [
        judge("closing", star.final_radius_mm, at_most, constraints.grasp.map(|[close, _]| close.0)),
        judge("payload", star.payload_kg, at_least, constraints.payload),
        judge("pressing", force, at_most, constraints.largest_force),
    ];
    all.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_s_number_lies_in_a_range_as_far_as_its_meshes_leave_it_open() {
        let of = |shell, mesh_error| {
            let key = ("object_force_N", "N");
            compare(key, Some(10.0), Some([8.0, 12.0]), Some((shell, mesh_error)))
                .and_then(|one| one.in_range)
        };
        assert_eq!([of(9.0, 0.1), of(7.5, 0.6), of(12.4, 0.5)], [Some(true); 3]);
        assert_eq!([of(7.5, 0.4), of(13.0, 0.9)], [Some(false); 2]);
        let unknown = compare(("object_force_N", "N"), None, None, Some((9.0, 0.1)));
        assert_eq!(unknown.and_then(|one| one.in_range), None);
    }

    #[test]
    fn what_does_not_hold_is_said() {
        let one = |met| Judgement { what: "payload", bound: 1.0, shell: 0.9, met };
        let said = |judged: Vec<Judgement>| Confirmation { compared: Vec::new(), judged }.lines().join("\n");
        assert!(
            said(vec![one(true), one(false)]).contains("does NOT meet all")
                && said(vec![one(true)]).contains("it meets all")
        );
        assert!(said(vec![one(false)]).contains("payload: NOT met, 0.900 where 1.000 is the bound"));
        assert!(said(Vec::new()).contains("no constraint that it can judge"));
    }
}
