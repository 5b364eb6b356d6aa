//! Artifacts: output files as bytes, between the emitters that make them and the verifier that reads them.

/// What an output file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// The spec as read.
    Spec,
    /// The machine profile as resolved.
    Machine,
    /// The sealing program.
    SealGcode,
    /// The unheated look at where the iron will go.
    TraceGcode,
    /// Centre lines of the seams.
    SealSvg,
    /// Centre lines of the seams.
    SealDxf,
    /// The cut.
    OutlineSvg,
    /// The cut.
    OutlineDxf,
    /// A picture for people.
    PreviewSvg,
}

impl Kind {
    /// Every kind, in the order in which the manifest lists them.
    pub const ALL: [Self; 9] = [
        Self::Spec,
        Self::Machine,
        Self::SealGcode,
        Self::TraceGcode,
        Self::SealSvg,
        Self::SealDxf,
        Self::OutlineSvg,
        Self::OutlineDxf,
        Self::PreviewSvg,
    ];

    /// Its name in the manifest and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Spec => "spec",
            Self::Machine => "machine",
            Self::SealGcode => "seal-gcode",
            Self::TraceGcode => "trace-gcode",
            Self::SealSvg => "seal-svg",
            Self::SealDxf => "seal-dxf",
            Self::OutlineSvg => "outline-svg",
            Self::OutlineDxf => "outline-dxf",
            Self::PreviewSvg => "preview-svg",
        }
    }

    /// The kind called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// One output file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Artifact {
    /// Its name in the output directory: letters, digits, `-` and `.` only.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// The sheet it belongs to.
    pub sheet: Option<usize>,
    /// The star it belongs to.
    pub star: Option<usize>,
    /// Its content.
    pub bytes: Vec<u8>,
}
