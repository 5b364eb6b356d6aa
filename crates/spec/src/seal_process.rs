//! The process of each name, with what it takes from `[seal]`.

use crate::processes::{DEFAULT_PROCESS, ProcessSpec};
use crate::seal::{Seal, SealPause};
use crate::units::LineForce;
use crate::{Fabric, Spec};

/// A process with all of its values.
#[derive(Clone, Debug, PartialEq)]
pub struct SealProcess {
    /// Name of the process.
    pub name: String,
    /// How its seams are made.
    pub seal: Seal,
    /// Peel strength of its seams; `None` if unknown.
    pub strength: Option<LineForce>,
}

impl SealProcess {
    /// Whether it is the process that `[seal]` is.
    pub fn is_default(&self) -> bool {
        self.name == DEFAULT_PROCESS
    }

    /// Whether it is that of `[seal]`, seals every seam once along its centre line, and goes on without a wait or a pause.
    pub fn is_plain(&self) -> bool {
        let Seal { passes, cool, pause, .. } = &self.seal;
        let is_once = *passes == 1 && self.seal.line_count() == 1;
        self.is_default() && is_once && cool.0 == 0.0 && *pause == SealPause::Never
    }
}

/// Peel strength of the seams that the process called `name` among `processes` makes: a process without one has that of the `fabric`, and
/// so has `[seal]`. `None` if it is unknown.
pub fn seam_strength(processes: &[ProcessSpec], name: &str, fabric: &Fabric) -> Option<LineForce> {
    let process = processes.iter().find(|process| process.name == name);
    process.and_then(|process| process.strength).or(fabric.seal_strength)
}

impl Spec {
    /// The process that `[seal]` is.
    pub fn default_process(&self) -> SealProcess {
        let (seal, strength) = (self.seal.clone(), self.fabric.seal_strength);
        SealProcess { name: DEFAULT_PROCESS.to_owned(), seal, strength }
    }

    /// The process called `name`; that of `[seal]` where no other has the name.
    pub fn process(&self, name: &str) -> SealProcess {
        let default = self.default_process();
        let Some(process) = self.processes.iter().find(|process| process.name == name) else {
            return default;
        };
        let base = default.seal;
        SealProcess {
            name: process.name.clone(),
            strength: seam_strength(&self.processes, name, &self.fabric),
            seal: Seal {
                temperature: process.temperature.unwrap_or(base.temperature),
                power: process.power.or(base.power),
                speed: process.speed.unwrap_or(base.speed),
                overlap: process.overlap.unwrap_or(base.overlap),
                height: process.height.or(base.height),
                passes: process.passes.unwrap_or(base.passes),
                lines: process.lines.or(base.lines),
                cool: process.cool.unwrap_or(base.cool),
                pause: process.pause.unwrap_or(base.pause),
                ..base
            },
        }
    }

    /// The spec with `process` in the place of `[seal]`: every seam is made by it.
    #[must_use]
    pub fn sealed_by(&self, process: &SealProcess) -> Self {
        let fabric = Fabric { seal_strength: process.strength, ..self.fabric.clone() };
        Self { seal: process.seal.clone(), fabric, ..self.clone() }
    }
}
