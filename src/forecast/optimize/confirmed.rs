//! What the shell says of a winner: each number that was predicted beside the shell's, and each constraint that a shell can judge.

use std::fmt::Write;

use serde::Serialize;

use crate::forecast::optimize::{Constraints, Evaluated};
use crate::forecast::outcome::Outcome;
use crate::forecast::ranges::{Interval, mm, shown};
use crate::forecast::shell_prediction::ShellPrediction;
use crate::units::Length;

/// A winner as a shell.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Confirmed {
    /// The predicted numbers beside the shell's.
    pub compared: Vec<Compared>,
    /// The constraints that a shell can judge.
    pub judged: Vec<Judgement>,
}

/// One number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// Its key in a prediction.
    pub what: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The prediction.
    pub predicted: Option<f64>,
    /// Its range.
    pub range: Option<Interval>,
    /// The shell's.
    pub shell: f64,
    /// By how much its meshes leave it open.
    pub mesh_error: f64,
    /// Whether the shell's number, as far as its meshes leave it open, lies in the range; `None` without one.
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
    /// Whether it is met by the shell's number, whatever the meshes leave open.
    pub met: bool,
}

impl Confirmed {
    /// `candidate`, which met `constraints`, beside what the `shell` says of it.
    pub fn new(candidate: &Evaluated, constraints: &Constraints, shell: &ShellPrediction) -> Self {
        let (star, own) = (&shell.first, candidate.answer.outcome.as_ref());
        let errors = &star.evidence.mesh_errors;
        let mut compared = vec![compare(
            ("final_radius_mm", "mm"),
            own.map(|own| Length::from_metres(own.rest.radius).0),
            own.and_then(|own| own.ranges.radius).map(mm),
            (star.final_radius_mm, errors.final_radius_mm),
        )];
        if let Some(stiffness) = star.radial_stiffness_N_per_m {
            compared.push(compare(
                ("radial_stiffness_N_per_m", "N/m"),
                own.and_then(|own| own.stiffness),
                own.and_then(|own| own.ranges.stiffness),
                (stiffness, errors.radial_stiffness_N_per_m),
            ));
        }
        if let Some(force) = star.object_force_N.zip(errors.object_force_N) {
            compared.push(compare(
                ("object_force_N", "N"),
                own.and_then(Outcome::object_force),
                own.and_then(|own| own.force_range),
                force,
            ));
        }
        Self { compared, judged: judged(constraints, shell) }
    }

    /// Whether the shell meets all that it can judge.
    pub fn holds(&self) -> bool {
        self.judged.iter().all(|one| one.met)
    }

    /// As a person reads it, a line each.
    pub fn lines(&self) -> Vec<String> {
        let word = match (self.judged.is_empty(), self.holds()) {
            (true, _) => "there is no constraint that it can judge",
            (_, true) => "it meets all constraints that it can judge",
            (_, false) => "it does NOT meet all constraints",
        };
        let mut lines = vec![format!("the shell of the winner: {word}")];
        for one in &self.compared {
            let Compared { what, unit, shell, mesh_error, .. } = *one;
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
    (shell, mesh_error): (f64, f64),
) -> Compared {
    let holds = |[low, high]: Interval| shell + mesh_error >= low && shell - mesh_error <= high;
    Compared { what, unit, predicted, range, shell, mesh_error, in_range: range.map(holds) }
}

/// What a shell says of how far it closes, how much it holds and how hard it presses. How far it opens and when it bursts it does not say.
fn judged(constraints: &Constraints, shell: &ShellPrediction) -> Vec<Judgement> {
    let star = &shell.first;
    let closing = constraints.grasp.map(|[close, _]| Judgement {
        what: "closing",
        bound: close.0,
        shell: star.final_radius_mm,
        met: star.final_radius_mm <= close.0,
    });
    let force = shell.stars.iter().filter_map(|star| star.object_force_N).reduce(f64::max);
    let carried = constraints.payload.zip(star.payload_kg).map(|(bound, held)| Judgement {
        what: "payload",
        bound,
        shell: held,
        met: held >= bound,
    });
    let pressing = constraints.largest_force.zip(force).map(|(bound, force)| Judgement {
        what: "pressing",
        bound,
        shell: force,
        met: force <= bound,
    });
    [closing, carried, pressing].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_s_number_lies_in_a_range_as_far_as_its_meshes_leave_it_open() {
        let of = |shell, mesh_error| {
            let key = ("object_force_N", "N");
            compare(key, Some(10.0), Some([8.0, 12.0]), (shell, mesh_error)).in_range
        };
        assert_eq!([of(9.0, 0.1), of(7.5, 0.6), of(12.4, 0.5)], [Some(true); 3]);
        assert_eq!([of(7.5, 0.4), of(13.0, 0.9)], [Some(false); 2]);
        assert_eq!(compare(("object_force_N", "N"), None, None, (9.0, 0.1)).in_range, None);
    }

    #[test]
    fn what_does_not_hold_is_said() {
        let one = |met| Judgement { what: "payload", bound: 1.0, shell: 0.9, met };
        let said = |judged: Vec<Judgement>| Confirmed { compared: Vec::new(), judged }.lines().join("\n");
        assert!(
            said(vec![one(true), one(false)]).contains("does NOT meet all")
                && said(vec![one(true)]).contains("it meets all")
        );
        assert!(said(vec![one(false)]).contains("payload: NOT met, 0.900 where 1.000 is the bound"));
        assert!(said(Vec::new()).contains("no constraint that it can judge"));
    }
}
