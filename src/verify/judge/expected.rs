//! What the files of a build are compared with.

use crate::design::Design;
use crate::spec::{Machine, Spec};

/// What the files are compared with.
#[derive(Clone, Copy)]
pub(in crate::verify) struct Expected<'a> {
    pub(in crate::verify) design: &'a Design,
    pub(in crate::verify) spec: &'a Spec,
    pub(in crate::verify) machine: &'a Machine,
}
