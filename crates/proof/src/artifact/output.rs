//! Outputs: one file of a design, with its name, title, caption and geometry.

use crate::artifact::kind::{Format, Kind, Subject};
use design::{CutEdge, Design, Drawing, FlatPiece, MaskPlate, Paper};
use spec::Spec;

/// The ending of programs for LinuxCNC.
pub const NGC: &str = "ngc";

/// The part of a design that a file shows, by its number from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputPart {
    /// The whole design.
    Design,
    /// All that lies on a sheet.
    Sheet(usize),
    /// A star, of equal ones the first; in a program also the sheet on which it lies.
    Star {
        /// The number of the star.
        star: usize,
        /// The number of the sheet.
        sheet: Option<usize>,
    },
    /// A drawn piece, of equal ones the first; in a program also the sheet on which it lies.
    Piece {
        /// The number of the piece.
        piece: usize,
        /// The number of the sheet.
        sheet: Option<usize>,
    },
    /// A plate of the frame, of equal ones the lowest.
    Plate(usize),
    /// All separators on a sheet of paper.
    Paper(usize),
}

impl OutputPart {
    /// The number of the sheet: the part itself, or where it lies.
    pub fn sheet(self) -> Option<usize> {
        match self {
            Self::Sheet(sheet) => Some(sheet),
            Self::Star { sheet, .. } | Self::Piece { sheet, .. } => sheet,
            Self::Design | Self::Plate(_) | Self::Paper(_) => None,
        }
    }

    /// The number of the star.
    pub fn star(self) -> Option<usize> {
        if let Self::Star { star, .. } = self { Some(star) } else { None }
    }

    /// The number of the drawn piece.
    pub fn piece(self) -> Option<usize> {
        if let Self::Piece { piece, .. } = self { Some(piece) } else { None }
    }

    /// The number of the plate.
    pub fn plate(self) -> Option<usize> {
        if let Self::Plate(plate) = self { Some(plate) } else { None }
    }

    /// The number of the sheet of paper.
    pub fn paper(self) -> Option<usize> {
        if let Self::Paper(paper) = self { Some(paper) } else { None }
    }

    /// The number of the star or piece that is sealed as a whole.
    pub fn sealed(self) -> Option<usize> {
        self.star().or(self.piece())
    }

    /// The prefix of file names; "" for the whole design.
    fn prefix(self) -> String {
        match self {
            Self::Design => String::new(),
            Self::Sheet(sheet) => format!("sheet-{sheet}-"),
            Self::Star { star, .. } => format!("star-{star}-"),
            Self::Piece { piece, .. } => format!("piece-{piece}-"),
            Self::Plate(plate) => format!("plate-{plate}-"),
            Self::Paper(paper) => format!("paper-{paper}-"),
        }
    }
}

/// One file of a design: its kind and its part. All else follows from these, also the name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// The kind of the file.
    pub kind: Kind,
    /// The part that it shows.
    pub part: OutputPart,
    /// The number of its tile of a printed mask, from 1; `None` for the whole.
    pub tile: Option<usize>,
    /// The paper that it is laid out for; `None` for a file that is not printed.
    pub paper: Option<Paper>,
    /// Whether it is mirrored, for the face that the iron does not touch.
    pub mirrored: bool,
    /// Whether it is for the sheet of fabric that has the valves.
    pub valves: bool,
    /// Whether it is a program for LinuxCNC, whose file dialog lists only `.ngc`.
    pub ngc: bool,
}

impl Output {
    /// The file of this kind for the whole design.
    pub fn new(kind: Kind) -> Self {
        Self {
            kind,
            part: OutputPart::Design,
            tile: None,
            paper: None,
            mirrored: false,
            valves: false,
            ngc: false,
        }
    }

    /// Name of the file without paper and ending.
    fn stem(&self) -> String {
        let face = if self.mirrored { "-mirrored" } else { "" };
        let tile = self.tile.map_or(String::new(), |tile| format!("-piece-{tile}"));
        let valves = if self.valves { "-valves" } else { "" };
        format!("{}{}{valves}{face}{tile}", self.part.prefix(), self.kind.subject().name())
    }

    /// Name of the file in the output directory: letters, digits, `-` and `.` only.
    pub fn name(&self) -> String {
        let paper = self.paper.and_then(Paper::name).map_or(String::new(), |paper| format!("-{paper}"));
        let ending = if self.ngc { NGC } else { self.kind.format().ending() };
        format!("{}{paper}.{ending}", self.stem())
    }

    /// The title inside the file, for a design called `name`.
    pub fn title(&self, name: &str) -> String {
        let subject = self.kind.subject();
        match (subject, self.part) {
            (Subject::Seal | Subject::Outline, OutputPart::Sheet(sheet)) => {
                let valves = if self.valves { " with valves" } else { "" };
                format!("{}{valves}, sheet {sheet}: {name}", subject.name())
            }
            (
                _,
                OutputPart::Design
                | OutputPart::Sheet(_)
                | OutputPart::Star { .. }
                | OutputPart::Piece { .. }
                | OutputPart::Plate(_)
                | OutputPart::Paper(_),
            ) => {
                format!("{}: {name}", self.stem())
            }
        }
    }

    /// The caption of every printed page; `None` for a file that is not printed.
    pub fn caption(&self) -> Option<String> {
        // Every kind is named, so that a new one must be given its caption.
        match self.kind {
            Kind::OutlinePdf => {
                let valves = if self.valves { " WITH VALVES" } else { "" };
                Some(format!("OUTLINE{valves} SHEET {}", self.part.sheet()?))
            }
            Kind::FramePdf => Some(format!("FRAME PLATE {}", self.part.plate()?)),
            Kind::MaskPdf => match self.part {
                OutputPart::Piece { piece, .. } => Some(format!("SEPARATOR PIECE {piece}")),
                OutputPart::Star { star, .. } => Some(MaskPlate::caption(star, self.mirrored)),
                OutputPart::Design | OutputPart::Sheet(_) | OutputPart::Plate(_) | OutputPart::Paper(_) => {
                    None
                }
            },
            Kind::SeparatorPdf => Some(format!("SEPARATORS PAPER {}", self.part.paper()?)),
            Kind::Spec
            | Kind::Machine
            | Kind::DrawingSvg
            | Kind::DrawingDxf
            | Kind::SealGcode
            | Kind::Seal3mf
            | Kind::TraceGcode
            | Kind::Trace3mf
            | Kind::CutGcode
            | Kind::Cut3mf
            | Kind::SealSvg
            | Kind::SealDxf
            | Kind::OutlineSvg
            | Kind::OutlineDxf
            | Kind::MaskSvg
            | Kind::MaskDxf
            | Kind::MaskStl
            | Kind::SeparatorSvg
            | Kind::SeparatorDxf
            | Kind::PressPlan
            | Kind::PiecesSvg
            | Kind::FrameSvg
            | Kind::FrameDxf
            | Kind::FrameStl
            | Kind::PreviewSvg
            | Kind::PreviewPng
            | Kind::Prediction
            | Kind::SceneGlb
            | Kind::Mjcf
            | Kind::Report => None,
        }
    }

    /// The name in the header of a solid, for a design called `name`; `None` for a part that is not printed as a solid.
    pub fn solid_name(&self, name: &str) -> Option<String> {
        let tile = self.tile.map_or(String::new(), |tile| format!(", piece {tile}"));
        match self.part {
            OutputPart::Star { star, .. } => {
                let side = if self.mirrored { "other side" } else { "this side up" };
                Some(format!("mask of star {star}, {side}{tile}: {name}"))
            }
            OutputPart::Plate(plate) => Some(format!("frame plate {plate}: {name}")),
            OutputPart::Design | OutputPart::Sheet(_) | OutputPart::Piece { .. } | OutputPart::Paper(_) => {
                None
            }
        }
    }

    /// Thickness of the plate that a solid shows, mm; `None` for a subject that is no plate.
    pub fn thickness(&self, spec: &Spec) -> Option<f64> {
        match self.kind.subject() {
            Subject::Frame => Some(spec.frame.plate_thickness.0),
            Subject::Mask => Some(spec.mask.thickness.0),
            Subject::Spec
            | Subject::Machine
            | Subject::Drawing
            | Subject::Seal
            | Subject::Trace
            | Subject::Cut
            | Subject::Outline
            | Subject::Pieces
            | Subject::Separator
            | Subject::PressPlan
            | Subject::Preview
            | Subject::Prediction
            | Subject::Scene
            | Subject::Mjcf
            | Subject::Report => None,
        }
    }

    /// The edge of a part: printed parts keep the drawn edge, cut parts are offset by the kerf.
    fn edge(&self) -> CutEdge {
        match self.kind.format() {
            Format::Stl | Format::Pdf => CutEdge::Part,
            Format::Toml
            | Format::Gcode
            | Format::Package
            | Format::Svg
            | Format::Dxf
            | Format::Json
            | Format::Png
            | Format::Glb
            | Format::Xml
            | Format::Html => CutEdge::Tool,
        }
    }

    /// The exact geometry of the file; `None` if it is no drawing, or shows a part that `design` does not have.
    ///
    /// The subject says which part is drawn, the numbers which one of them. Masks of stars are coating masks, those of a
    /// drawing's copies separators; solids have the outlines of their plates.
    pub fn drawing(&self, design: &Design) -> Option<Drawing> {
        let is_solid = self.kind.format() == Format::Stl;
        match self.kind.subject() {
            Subject::Seal => Drawing::seals(design, self.part.sheet()?),
            Subject::Outline if self.valves => {
                Drawing::valve_outlines(design, self.part.sheet()?, self.edge())
            }
            Subject::Outline => Drawing::outlines(design, self.part.sheet()?, self.edge()),
            Subject::Mask if is_solid => Drawing::printed_mask(
                design.assembly()?,
                self.part.star()?,
                self.mirrored,
                self.tile.map_or(0, |tile| tile - 1),
            ),
            Subject::Mask => match self.part.piece() {
                Some(piece) => {
                    let placed = design.placed().iter().find(|placed| placed.index == piece)?;
                    let FlatPiece::Drawn(piece) = design.part(placed) else { return None };
                    Drawing::separator(piece, self.edge())
                }
                None => Drawing::mask(design.assembly()?, self.part.star()?, self.mirrored, self.edge()),
            },
            Subject::Separator => Drawing::separators(design, self.part.paper()?, self.edge()),
            Subject::Pieces => Drawing::pieces(design.assembly()?, self.part.star()?, self.mirrored),
            Subject::Frame => {
                let design = design.assembly()?;
                let lowest = self.part.plate()?;
                let plate =
                    design.frame.plates.iter().find(|plate| plate.numbers.first() == Some(&lowest))?;
                Some(if is_solid {
                    Drawing::printed_plate(design, plate)
                } else {
                    Drawing::plate(design, plate, self.edge())
                })
            }
            Subject::Spec
            | Subject::Machine
            | Subject::Drawing
            | Subject::Trace
            | Subject::Cut
            | Subject::PressPlan
            | Subject::Preview
            | Subject::Prediction
            | Subject::Scene
            | Subject::Mjcf
            | Subject::Report => None,
        }
    }

    /// One output for each paper that takes it, or with `fits` false for each that does not.
    pub(super) fn on_paper(self, design: &Design, fits: bool) -> impl Iterator<Item = Self> {
        let drawing = self.drawing(design);
        let has_room =
            move |paper: &Paper| drawing.as_ref().is_some_and(|drawing| paper.has_room_for(drawing) == fits);
        Paper::ALL.into_iter().filter(has_room).map(move |paper| Self { paper: Some(paper), ..self })
    }
}
