//! Artifacts: output files as bytes, between the emitters that make them and the verifier that reads them.

mod file_list;
mod kind;
mod output;

pub use file_list::{has_mjcf, outputs, program_ending, takes_packages, too_large};
pub use kind::{Format, Kind, KindRequest, Subject};
pub use output::{NGC, Output, OutputPart};

/// One output file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Artifact {
    /// Kind and part of the file.
    pub output: Output,
    /// Name of the file in the output directory.
    pub name: String,
    /// Content of the file.
    pub bytes: Vec<u8>,
}

impl Artifact {
    /// The file `output` with this content.
    pub fn new(output: Output, bytes: impl Into<Vec<u8>>) -> Self {
        Self { output, name: output.name(), bytes: bytes.into() }
    }
}
