//! Kinds of output files, a subject in a format, and the kinds that a build makes.

use std::fmt;

use serde::{Deserialize, Serialize};

use spec::{Extra, Spec};

spec::choices! {
    /// The subject of a file.
    Subject,
    /// The subject's name in file names.
    name;
    /// The spec, unchanged.
    Spec: "spec",
    /// The resolved machine profile.
    Machine: "machine",
    /// The drawing that the spec names.
    Drawing: "drawing",
    /// The seams.
    Seal: "seal",
    /// The trace of the iron's path without heat.
    Trace: "trace",
    /// The cut of the sheet on the machine.
    Cut: "cut",
    /// The cut.
    Outline: "outline",
    /// A coating mask.
    Mask: "mask",
    /// Assembly of the pieces of a printed mask.
    Pieces: "pieces",
    /// A plate of the frame.
    Frame: "frame",
    /// The papers between the sheets of fabric in a heat press.
    Separator: "separator",
    /// The instructions for a heat press.
    PressPlan: "press-plan",
    /// A picture of the design.
    Preview: "preview",
    /// The prediction; only for a spec with a load.
    Prediction: "prediction",
    /// The gripper in three dimensions, for viewing.
    Scene: "scene",
    /// A reduced model of the gripper for MuJoCo.
    Mjcf: "mjcf",
    /// All results on one page.
    Report: "report",
}

spec::choices! {
    /// The format of a file.
    Format,
    /// The ending of its files.
    ending;
    /// A spec or a profile.
    Toml: "toml",
    /// A program.
    Gcode: "gcode",
    /// A program in the package that Bambu Lab's printers take.
    Package: "gcode.3mf",
    /// A drawing whose page is in mm.
    Svg: "svg",
    /// A drawing in mm.
    Dxf: "dxf",
    /// A drawing on paper, at 1:1.
    Pdf: "pdf",
    /// A solid.
    Stl: "stl",
    /// Figures.
    Json: "json",
    /// A picture of pixels.
    Png: "png",
    /// Triangles for viewing.
    Glb: "glb",
    /// A model for simulators.
    Xml: "xml",
    /// A page for browsers.
    Html: "html",
}

/// Declares [`Kind`] from one table, one line a kind.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident: $name:literal, $subject:ident as $format:ident;)+) => {
        /// The kind of an output file: a subject in a format.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        #[non_exhaustive]
        pub enum Kind {
            $($(#[$doc])* #[serde(rename = $name)] $kind,)+
        }

        impl Kind {
            /// Every kind.
            pub const ALL: &'static [Self] = &[$(Self::$kind),+];

            /// Name of the kind in the manifest and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)+
                }
            }

            /// The subject of its files.
            pub fn subject(self) -> Subject {
                match self {
                    $(Self::$kind => Subject::$subject,)+
                }
            }

            /// The format of its files.
            pub fn format(self) -> Format {
                match self {
                    $(Self::$kind => Format::$format,)+
                }
            }
        }
    };
}

kinds! {
    /// The spec, unchanged.
    Spec: "spec", Spec as Toml;
    /// The resolved machine profile.
    Machine: "machine", Machine as Toml;
    /// The drawing that the spec names.
    DrawingSvg: "drawing-svg", Drawing as Svg;
    /// The drawing that the spec names.
    DrawingDxf: "drawing-dxf", Drawing as Dxf;
    /// The sealing program.
    SealGcode: "seal-gcode", Seal as Gcode;
    /// The sealing program in a package; only for Bambu Lab's printers.
    Seal3mf: "seal-3mf", Seal as Package;
    /// The trace of the iron's path without heat.
    TraceGcode: "trace-gcode", Trace as Gcode;
    /// The trace in a package; only for Bambu Lab's printers.
    Trace3mf: "trace-3mf", Trace as Package;
    /// The program that cuts the sheet after the seal; only for a spec with a tool for it.
    CutGcode: "cut-gcode", Cut as Gcode;
    /// The program that cuts in a package; only for Bambu Lab's printers.
    Cut3mf: "cut-3mf", Cut as Package;
    /// Centre lines of the seams.
    SealSvg: "seal-svg", Seal as Svg;
    /// Centre lines of the seams.
    SealDxf: "seal-dxf", Seal as Dxf;
    /// The cut.
    OutlineSvg: "outline-svg", Outline as Svg;
    /// The cut.
    OutlineDxf: "outline-dxf", Outline as Dxf;
    /// The cut on paper, at 1:1.
    OutlinePdf: "outline-pdf", Outline as Pdf;
    /// A coating mask.
    MaskSvg: "mask-svg", Mask as Svg;
    /// A coating mask.
    MaskDxf: "mask-dxf", Mask as Dxf;
    /// A coating mask on paper, at 1:1.
    MaskPdf: "mask-pdf", Mask as Pdf;
    /// A coating mask as a solid.
    MaskStl: "mask-stl", Mask as Stl;
    /// The papers between the sheets of fabric in a heat press.
    SeparatorSvg: "separator-svg", Separator as Svg;
    /// The papers between the sheets of fabric in a heat press.
    SeparatorDxf: "separator-dxf", Separator as Dxf;
    /// The papers between the sheets of fabric on paper, at 1:1.
    SeparatorPdf: "separator-pdf", Separator as Pdf;
    /// The instructions for a heat press, one page.
    PressPlan: "press-plan", PressPlan as Pdf;
    /// Assembly of the pieces of a printed mask.
    PiecesSvg: "pieces-svg", Pieces as Svg;
    /// A plate of the frame.
    FrameSvg: "frame-svg", Frame as Svg;
    /// A plate of the frame.
    FrameDxf: "frame-dxf", Frame as Dxf;
    /// A plate of the frame on paper, at 1:1.
    FramePdf: "frame-pdf", Frame as Pdf;
    /// A plate of the frame as a solid.
    FrameStl: "frame-stl", Frame as Stl;
    /// A picture of the design.
    PreviewSvg: "preview-svg", Preview as Svg;
    /// The preview as pixels.
    PreviewPng: "preview-png", Preview as Png;
    /// The prediction; only for a spec with a load.
    Prediction: "prediction", Prediction as Json;
    /// The gripper in three dimensions, for viewing.
    SceneGlb: "scene-glb", Scene as Glb;
    /// A reduced model of the gripper for MuJoCo; only for stars with a pressure.
    Mjcf: "mjcf", Mjcf as Xml;
    /// All results on one page.
    Report: "report", Report as Html;
}

impl Kind {
    /// The kind called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// Whether it is always made, even if only other kinds are requested: a directory is proven from its own spec, profile and drawing.
    pub fn is_source(self) -> bool {
        match self.subject() {
            Subject::Spec | Subject::Machine | Subject::Drawing => true,
            Subject::Seal
            | Subject::Trace
            | Subject::Cut
            | Subject::Outline
            | Subject::Mask
            | Subject::Pieces
            | Subject::Frame
            | Subject::Separator
            | Subject::PressPlan
            | Subject::Preview
            | Subject::Prediction
            | Subject::Scene
            | Subject::Mjcf
            | Subject::Report => false,
        }
    }

    /// Whether no reader compares its content with the design: it is proven by its bytes alone.
    pub fn is_by_bytes(self) -> bool {
        match self.subject() {
            Subject::Preview | Subject::Scene | Subject::Mjcf | Subject::Report => true,
            Subject::Seal
            | Subject::Outline
            | Subject::Mask
            | Subject::Pieces
            | Subject::Frame
            | Subject::Separator
            | Subject::PressPlan => self.format() == Format::Pdf,
            Subject::Spec
            | Subject::Machine
            | Subject::Drawing
            | Subject::Trace
            | Subject::Cut
            | Subject::Prediction => false,
        }
    }

    /// Whether a machine runs it.
    pub fn is_program(self) -> bool {
        matches!(self.format(), Format::Gcode | Format::Package)
    }

    /// Whether it is made on request only.
    pub fn is_extra(self) -> bool {
        Extra::ALL.iter().any(|(name, _)| *name == self.name())
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The kinds of files that a build makes. Its manifest records them, so that `verify` knows the expected files. Their number and names
/// follow from the design.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KindRequest {
    /// The only kinds to make; empty: all that come by default.
    pub only: Vec<Kind>,
    /// Kinds to make in addition.
    pub with: Vec<Kind>,
}

impl KindRequest {
    /// These kinds and no others; all default kinds if `kinds` is empty.
    pub fn exactly(kinds: &[Kind]) -> Self {
        Self { only: kinds.to_vec(), with: Vec::new() }
    }

    /// Adds the kinds that `spec` names in `[build]`, unless `only` is set.
    #[must_use]
    pub fn of_spec(mut self, spec: &Spec) -> Self {
        if self.only.is_empty() {
            self.add(spec.build.with.iter().filter_map(|extra| Kind::from_name(extra.name())));
            // A press has no program that follows the outline: it is printed, and its holes are punched.
            self.add(spec.press.iter().map(|_| Kind::OutlinePdf));
        }
        self
    }

    /// Adds these kinds.
    pub fn add(&mut self, kinds: impl IntoIterator<Item = Kind>) {
        for kind in kinds {
            if !self.with.contains(&kind) {
                self.with.push(kind);
            }
        }
    }

    /// Whether files of `kind` are made.
    pub fn includes(&self, kind: Kind) -> bool {
        let named = if self.only.is_empty() { !kind.is_extra() } else { self.only.contains(&kind) };
        named || kind.is_source() || self.with.contains(&kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_spec_may_name_is_a_kind() {
        assert!(Extra::ALL.iter().all(|(name, _)| Kind::from_name(name).is_some_and(Kind::is_extra)));
    }

    #[test]
    fn a_name_is_subject_and_format_but_where_the_format_goes_without_saying() {
        for kind in Kind::ALL {
            let subject = kind.subject().name();
            let name = match kind.format() {
                Format::Toml | Format::Json | Format::Xml | Format::Html => subject.to_owned(),
                Format::Pdf if kind.subject() == Subject::PressPlan => subject.to_owned(),
                Format::Package => format!("{subject}-3mf"),
                format => format!("{subject}-{}", format.ending()),
            };
            assert_eq!(kind.name(), name);
            assert_eq!(Kind::from_name(&name), Some(*kind));
            assert_eq!(serde_json::to_value(kind).expect("plain"), name);
        }
    }
}

#[cfg(test)]
mod request_tests {
    use super::*;

    #[test]
    fn extras_come_where_they_are_named_and_sources_always() {
        let kinds = |request: &KindRequest| -> Vec<Kind> {
            Kind::ALL.iter().copied().filter(|kind| request.includes(*kind)).collect()
        };
        let extras: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_extra()).collect();
        assert!(extras.contains(&Kind::PreviewPng), "{extras:?}");
        let defaults = kinds(&KindRequest::default());
        assert_eq!(defaults.len() + extras.len(), Kind::ALL.len());
        assert!(extras.iter().all(|extra| !defaults.contains(extra)));
        let with_extras = KindRequest { with: extras, ..KindRequest::default() };
        assert_eq!(kinds(&with_extras), Kind::ALL);
        let request = KindRequest { only: vec![Kind::SealGcode], with: vec![Kind::PreviewPng] };
        let sources: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_source()).collect();
        assert_eq!(kinds(&request), [&sources[..], &[Kind::SealGcode, Kind::PreviewPng]].concat());
        assert_eq!(
            kinds(&KindRequest::exactly(&[Kind::PreviewPng])),
            [&sources[..], &[Kind::PreviewPng]].concat()
        );
    }
}
