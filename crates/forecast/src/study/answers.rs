//! The models that answer a row.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::candidate::{Answer, Candidate, RefusedDesign};
use crate::model_selection::hinge_model;
use crate::outcome::Outcome;
use crate::shell::Detail;
use crate::shell::request::{Measurements, ShellRefusal, ask};
use inflatable::mechanics::hinge::Level;
use inflatable::mechanics::hinge::ring::RingTable;
use inflatable::shell::cases::Watch;
use spec::ModelChoice;

/// The values of a row's design by a hinge model; for a shell, the values that need no model, and the shell's.
type RowAnswer = (Answer, Option<Box<Measurements>>);

/// The models of a study.
#[derive(Debug)]
pub(super) struct Models {
    /// The ring's table.
    pub(super) ring: RingTable,
    /// Fineness of the shells' meshes; `None`: `section` replaces `bvp` and `shell`.
    pub(super) detail: Option<Detail>,
}

impl Models {
    /// The values of `point`, by its own model; `None` if the computation was cancelled.
    pub(super) fn answer(
        &self,
        point: &Candidate,
        cancel: &Arc<AtomicBool>,
    ) -> Result<Option<RowAnswer>, RefusedDesign> {
        match (point.model, self.detail) {
            (ModelChoice::Bvp, Some(_)) => {
                let answer = point.answer_by(&self.ring, |case| {
                    let width = case.mechanism.width;
                    let model = hinge_model(Level::Bvp, &case.sheet, case.pressure, width)?;
                    Outcome::correcting(case, model.as_ref()).map(Some)
                });
                Ok(Some((answer?, None)))
            }
            (ModelChoice::Shell, Some(detail)) => {
                // The values that need no model.
                let answer = point.answer_by(&self.ring, |_| Ok(None))?;
                let watch = Watch { cancel: Arc::clone(cancel), ..Watch::default() };
                match ask(&answer.case, &point.fabric, &[], detail, &watch) {
                    Ok((_, _, shell)) => Ok(Some((answer, Some(Box::new(shell))))),
                    Err(ShellRefusal::Cancelled) => Ok(None),
                    Err(ShellRefusal::Fault(fault)) => Err(RefusedDesign::unpredicted(fault.to_string())),
                }
            }
            _ => Ok(Some((point.answer(&self.ring)?, None))),
        }
    }
}
