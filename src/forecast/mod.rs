//! What a spec's gripper will do: from the exact design to a prediction that says how good it is.

pub mod candidate;
pub mod choice;
pub mod cut;
pub mod optimize;
pub mod predict;
pub mod prediction;
pub mod report;
pub mod sweep;
pub mod trade;
