//! The models that answer a row.

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

/// The values of a row's design.
pub(super) struct RowAnswer {
    /// The values by a hinge model; for a shell, the values that need no model.
    pub(super) answer: Answer,
    /// The shell's values.
    pub(super) shell: Option<Box<Measurements>>,
}

/// Reason for a row without an answer.
pub(super) enum RowRefusal {
    /// There is no such star, or no model has an answer.
    Refused(RefusedDesign),
    /// The computation was cancelled.
    Cancelled,
}

impl From<RefusedDesign> for RowRefusal {
    fn from(refused: RefusedDesign) -> Self {
        Self::Refused(refused)
    }
}

/// The models of a study.
#[derive(Debug)]
pub(super) struct Models {
    /// The ring's table.
    pub(super) ring: RingTable,
    /// Fineness of the shells' meshes; `None`: `section` stands in for `bvp` and `shell`.
    pub(super) detail: Option<Detail>,
}

impl Models {
    /// The values of `point`, by its own model.
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
                    Outcome::correcting(case, model.as_ref()).map(Some)
                });
                Ok(RowAnswer { answer: answer?, shell: None })
            }
            (ModelChoice::Shell, Some(detail)) => {
                // The values that need no model.
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
