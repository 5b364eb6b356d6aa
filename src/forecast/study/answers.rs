//! Who answers a row: the model of its design.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::design::RefusalCode;
use crate::forecast::candidate::{Answer, Candidate, RefusedDesign};
use crate::forecast::case::weave;
use crate::forecast::model_selection::hinge_model;
use crate::forecast::outcome::Outcome;
use crate::forecast::shell::Detail;
use crate::forecast::shell::request::{Measurements, ShellRefusal, ask, fault};
use crate::spec::{Code, ModelChoice, key};
use inflatable::mechanics::hinge::Level;
use inflatable::mechanics::hinge::ring::RingTable;
use inflatable::shell::cases::Watch;

/// What is known of a row's design.
pub(super) struct RowAnswer {
    /// What a model of the hinges says; by a shell, what needs no model.
    pub(super) answer: Answer,
    /// What a shell says.
    pub(super) shell: Option<Box<Measurements>>,
}

/// Why there is no answer.
pub(super) enum RowRefusal {
    /// There is no such star, or no model has an answer.
    Refused(RefusedDesign),
    /// It was told to stop.
    Cancelled,
}

impl From<RefusedDesign> for RowRefusal {
    fn from(refused: RefusedDesign) -> Self {
        Self::Refused(refused)
    }
}

/// Who answers.
#[derive(Debug)]
pub(super) struct Models {
    /// The ring's table.
    pub(super) ring: RingTable,
    /// How fine the meshes of shells are; `None`: `section` stands in for `bvp` and `shell`.
    pub(super) detail: Option<Detail>,
}

impl Models {
    /// What `point` does, by its own model.
    pub(super) fn answer(
        &self,
        point: &Candidate,
        cancel: &Arc<AtomicBool>,
    ) -> Result<RowAnswer, RowRefusal> {
        match (point.model, self.detail) {
            (ModelChoice::Bvp, Some(_)) => {
                let answer = point.answer_by(&self.ring, |case| {
                    let width = case.mechanism.width;
                    let model = hinge_model(Level::Bvp, &case.sheet, case.pressure, width)?;
                    Outcome::of(case, model.as_ref()).map(Some)
                });
                Ok(RowAnswer { answer: answer?, shell: None })
            }
            (ModelChoice::Shell, Some(detail)) => {
                // What no model is needed for.
                let answer = point.answer_by(&self.ring, |_| Ok(None))?;
                let watch = Watch { progress: None, cancel: Arc::clone(cancel) };
                let weave = weave(&point.fabric)
                    .map_err(|why| unanswered(fault(key::fabric::SHEAR_MODULUS, why.to_string())))?;
                let (_, _, shell) = ask((&answer.case, weave), &[], detail, &watch).map_err(unanswered)?;
                Ok(RowAnswer { answer, shell: Some(Box::new(shell)) })
            }
            _ => Ok(RowAnswer { answer: point.answer(&self.ring)?, shell: None }),
        }
    }
}

fn unanswered(refusal: ShellRefusal) -> RowRefusal {
    match refusal {
        ShellRefusal::Cancelled => RowRefusal::Cancelled,
        ShellRefusal::Fault(fault) => {
            let code = RefusalCode::NoPrediction.as_str();
            RowRefusal::Refused(RefusedDesign { code, text: fault.to_string() })
        }
    }
}
