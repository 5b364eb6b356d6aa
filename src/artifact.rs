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
    /// A coating mask.
    MaskSvg,
    /// A coating mask.
    MaskDxf,
    /// A coating mask on paper, at 1:1.
    MaskPdf,
    /// A coating mask as a solid.
    MaskStl,
    /// A plate of the frame.
    FrameSvg,
    /// A plate of the frame.
    FrameDxf,
    /// A picture for people.
    PreviewSvg,
    /// What the gripper will do; only for a spec with a load.
    Prediction,
}

impl Kind {
    /// Every kind, in the order in which the manifest lists them.
    pub const ALL: [Self; 16] = [
        Self::Spec,
        Self::Machine,
        Self::SealGcode,
        Self::TraceGcode,
        Self::SealSvg,
        Self::SealDxf,
        Self::OutlineSvg,
        Self::OutlineDxf,
        Self::MaskSvg,
        Self::MaskDxf,
        Self::MaskPdf,
        Self::MaskStl,
        Self::FrameSvg,
        Self::FrameDxf,
        Self::PreviewSvg,
        Self::Prediction,
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
            Self::MaskSvg => "mask-svg",
            Self::MaskDxf => "mask-dxf",
            Self::MaskPdf => "mask-pdf",
            Self::MaskStl => "mask-stl",
            Self::FrameSvg => "frame-svg",
            Self::FrameDxf => "frame-dxf",
            Self::PreviewSvg => "preview-svg",
            Self::Prediction => "prediction",
        }
    }

    /// The kind called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// Which one of several files of its kind an artifact is, beyond its sheet and its star.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variant {
    /// The lowest plate of the frame that it is for.
    pub plate: Option<usize>,
    /// The paper that it is laid out for, see [`crate::design::Paper`].
    pub paper: Option<&'static str>,
    /// Whether it is for the face that the iron does not touch.
    pub mirrored: bool,
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
    /// What tells it apart from others of its kind.
    pub variant: Variant,
    /// Its content.
    pub bytes: Vec<u8>,
}
