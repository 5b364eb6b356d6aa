//! The inflated sheet as a thin **shell**: membrane and bending, finite pressure, contact; the only level that
//! has arms, ends and whole stars.

pub mod assembly;
pub mod cases;
pub mod contact;
pub mod element;
pub mod mesh;
pub mod solver;
