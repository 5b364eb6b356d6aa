//! What the spelling of a program says beside its steps.

use crate::spec::{Controller, Machine, Process, Seal, Spec};
use crate::units::Length;

/// What the spelling of steps needs to know beside them.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// What the user calls the design; any text.
    pub name: &'a str,
    /// Temperature, speed, band and overlap.
    pub seal: &'a Seal,
    /// Largest deviation from the exact geometry.
    pub path: Length,
    /// What reads the program.
    pub controller: &'a Controller,
    /// How the iron is led.
    pub process: &'a Process,
}

impl<'a> Facts<'a> {
    /// The facts about programs of `spec` for `machine`.
    pub fn new(spec: &'a Spec, machine: &'a Machine) -> Self {
        let Machine { controller, process, .. } = machine;
        Self { name: &spec.name, seal: &spec.seal, path: spec.accuracy.path, controller, process }
    }
}
