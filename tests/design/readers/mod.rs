//! Readers of files for the eye: scenes, pictures, pages.

pub(crate) mod glb;
pub(crate) mod html;
pub(crate) mod png;
