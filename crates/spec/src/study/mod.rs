//! Study files: the keys that vary, the keys that are set, the model, and the columns.
//!
//! A **field** is a key of the spec that a study sets. An **axis** is a field with its values. A **block** is
//! axes that go on together; a study has a row for every combination of its blocks, and the last runs
//! fastest.

mod axis;
mod field;
mod reading;
mod spec_text;

pub use axis::{Axis, Block, MOST_VALUES, RandomSample};
pub use field::{Field, KeyValue};
pub use reading::{NamedProcess, StudyFile, Wanted, read_study};
pub use spec_text::with_fields;
