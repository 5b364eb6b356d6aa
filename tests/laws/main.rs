//! Laws: of geometry under every motion, of the star and its seams, of limits, and of the inputs that the readers of specs and
//! files take.

mod compare;
mod fuzzed;
mod geom;
mod limits;
mod lyon;
mod mutants;
mod rounded;
mod seams;
mod separators;
mod shapes;
mod sketch_faults;
mod sketch_mending;
mod sketch_ports;
mod sketch_welds;
mod sketched_stars;
mod sketches;
mod spec;
mod star;
#[path = "../support/mod.rs"]
mod support;
mod valves;
