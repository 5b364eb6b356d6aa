//! A column of answers: what it is called, what it means, and who knows it.

use crate::forecast::candidate::{Answer, Candidate};
use crate::forecast::outcome::Outcome;
use crate::forecast::shell::request::Measurements;
use crate::spec::ModelChoice;
use inflatable::mechanics::strength::payload;

/// A design with its answer.
pub(super) struct StudyRow<'a> {
    pub(super) point: &'a Candidate,
    pub(super) answer: &'a Answer,
    /// What a shell says, if it was asked.
    pub(super) shell: Option<&'a Measurements>,
    /// Whether what no model is needed for is said where none answers; the columns of `sweep --vary` never did.
    pub(super) all: bool,
}

impl StudyRow<'_> {
    /// What a model of the hinges says, if it knows such stars.
    pub(super) fn own(&self) -> Option<&Outcome> {
        self.answer.outcome.as_ref().filter(|own| own.known)
    }

    /// What either says.
    pub(super) fn says(
        &self,
        hinges: fn(&Outcome) -> Option<f64>,
        shell: fn(&Measurements) -> Option<f64>,
    ) -> Option<f64> {
        self.shell.map_or_else(|| hinges(self.own()?), shell)
    }

    /// Mass that friction holds with a radial force of this many N of each star, of the whole stack, kg; `None` where stars of the stack meet
    /// different radii of the object, of which a shell was asked for one only.
    pub(super) fn held(&self, force: f64) -> Option<f64> {
        if !self.point.meets_alike(&self.answer.star) {
            return None;
        }
        Some(f64::from(self.point.stars) * payload(self.point.load.friction?, [force]))
    }
}

/// A column of answers.
#[derive(Debug)]
pub(super) struct OutputColumn {
    pub(super) name: &'static str,
    pub(super) unit: Option<&'static str>,
    pub(super) about: &'static str,
    /// Whether `sweep --vary` has it, too: these columns and their order do not change.
    pub(super) plain: bool,
    pub(super) of: Of,
}

/// Who knows a column, and how it is read from a row.
#[derive(Debug)]
pub(super) enum Of {
    /// Every model.
    Any(fn(&StudyRow<'_>) -> Option<f64>),
    /// Models of the hinges.
    Hinges(fn(&StudyRow<'_>) -> Option<f64>),
    /// Shells.
    Shell(fn(&StudyRow<'_>, &Measurements) -> Option<f64>),
}

/// Which models the rows of a study ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ModelKinds {
    /// One of the hinges.
    pub(super) hinges: bool,
    /// The shell.
    pub(super) shells: bool,
}

impl ModelKinds {
    /// By rows of these models.
    pub(super) fn of(models: &[ModelChoice]) -> Self {
        let is_shell = |model: &ModelChoice| *model == ModelChoice::Shell;
        Self { hinges: !models.iter().all(is_shell), shells: models.iter().any(is_shell) }
    }
}

impl OutputColumn {
    /// Its value; `None` where nothing is known.
    pub(super) fn value(&self, row: &StudyRow<'_>) -> Option<f64> {
        match self.of {
            Of::Any(of) => of(row),
            Of::Hinges(of) => of(row).filter(|_| row.shell.is_none()),
            Of::Shell(of) => of(row, row.shell?),
        }
    }

    /// Whether one of the models that are `asked` knows it.
    pub(super) fn is_known(&self, asked: ModelKinds) -> bool {
        match self.of {
            Of::Any(_) => true,
            Of::Hinges(_) => asked.hinges,
            Of::Shell(_) => asked.shells,
        }
    }
}
