//! Readers of what is only looked at: scenes, pictures, pages.

pub(crate) mod glb;
pub(crate) mod html;
pub(crate) mod png;
