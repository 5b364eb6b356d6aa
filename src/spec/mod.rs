//! What the user asks for: from TOML text to a complete, valid [`Spec`], or all of its faults at once.
//!
//! A **raw spec** is what was written, with the place of each key and value in the source; a **spec**
//! is complete (every default filled in) and valid (every value in its range). What only the
//! geometry can tell, for instance that the arms would have a negative length, is refused later, by
//! the design stage.

mod machine;
mod model;

pub use machine::{Dialect, Heating, Heights, Machine};
pub use model::{
    Accuracy, Fabric, FeedFloor, Frame, Inlet, Load, MachineChoice, Mask, ModelChoice, ProgramScope, Seal,
    Sheet, Spec, StarSpec,
};
