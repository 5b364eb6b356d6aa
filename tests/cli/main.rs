//! The program as a user runs it, command by command.

mod align;
mod bad_input;
mod calibrate;
mod choosing;
mod chosen_texts;
mod coupon;
mod desk;
mod diagnostics;
mod drawing_faults;
mod drawings;
mod editor;
mod machines;
mod materials;
mod mechanics;
mod misspelt;
mod optimize;
mod other_versions;
mod press;
mod program;
mod publish;
mod refused_wishes;
mod resume;
mod screen;
mod shell;
mod spine;
mod study;
#[path = "../support/mod.rs"]
mod support;
mod terminal;
mod watch;
