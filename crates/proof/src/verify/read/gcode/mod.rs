//! Reads G-code as a controller would: lines to moves, dwells, pauses and findings.
//!
//! A **dialect** is a table of the words and limits of one family of controllers. The **lexer** cuts a line into
//! words and a comment; a **block** is a line whose words the dialect understands; the **machine** holds the
//! modes (units, distance, feed, ...) and the position, and executes blocks; the **interpreter** drives them line
//! by line and reports **events**. It holds one line at a time, and so do the judges; a
//! **program** is the list of all events of a file, for those that fit into memory.

mod block;
mod dialects;
mod event;
mod extended;
mod interpreter;
mod lexer;
mod machine;
mod modes;
mod program;

pub use dialects::{ArcTolerance, Dialect};
pub use event::{
    Beam, BeamMode, BlindMove, Comment, Dwell, Event, Heat, Heater, Move, MoveKind, Pause, Point3,
    ServiceCall,
};
pub use interpreter::Interpreter;
pub use program::{Line, Program, each_line, read_program};
