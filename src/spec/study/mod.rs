//! Study files: what varies of a spec, what is kept, which model answers, which columns are wanted.
//!
//! A **field** is a key of the spec that a study sets. A **lane** is a field with its values. A **block** is lanes that go on
//! together; a study has a row for every combination of its blocks, and the last runs fastest.

mod draw;
mod field;
mod lane;
mod leaves;
mod reading;

pub use draw::Draw;
pub use field::{Field, KeyValue};
pub use lane::{Block, Lane, MOST_VALUES};
pub use reading::{StudyFile, Wanted, read_study};
