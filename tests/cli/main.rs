//! The program as a user runs it, command by command.

mod align;
mod choosing;
mod desk;
mod diagnostics;
mod drawings;
mod editor;
mod machines;
mod materials;
mod mechanics;
mod press;
mod program;
mod publish;
mod screen;
mod shell;
mod spine;
mod study;
#[path = "../support/mod.rs"]
mod support;
mod terminal;
