//! The data besides its steps that a program is written from.

use crate::spec::{Controller, Machine, Process, Seal, Spec};
use crate::units::Length;

/// The data besides the steps from which a program is written.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// The user's name for the design; any text.
    pub name: &'a str,
    /// Temperature, speed, band and overlap.
    pub seal: &'a Seal,
    /// Largest deviation from the exact geometry.
    pub path: Length,
    /// The controller that reads the program.
    pub controller: &'a Controller,
    /// The way in which the iron is led.
    pub process: &'a Process,
}

impl<'a> Facts<'a> {
    /// The facts about programs of `spec` for `machine`.
    pub fn new(spec: &'a Spec, machine: &'a Machine) -> Self {
        let Machine { controller, process, .. } = machine;
        Self { name: &spec.name, seal: &spec.seal, path: spec.accuracy.path, controller, process }
    }
}
