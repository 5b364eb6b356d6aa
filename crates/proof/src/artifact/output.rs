//! Outputs: the list of a design's files, which both the builder and the verifier use.

use crate::artifact::kind::{Format, Kind, KindRequest, Subject};
use design::{CutEdge, Design, Drawing, DrawnPiece, FlatPiece, MaskPlate, Paper, StarAssembly};
use spec::{Dialect, ProgramScope, Spec};

/// The ending of programs for LinuxCNC.
pub const NGC: &str = "ngc";

/// One file of a design: its kind and its part. All else follows from these, also the name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// The kind of the file.
    pub kind: Kind,
    /// The sheet it belongs to.
    pub sheet: Option<usize>,
    /// The star it belongs to; for equal stars the first.
    pub star: Option<usize>,
    /// The drawn piece that it belongs to, by its number.
    pub copy: Option<usize>,
    /// The lowest plate of the frame that uses it.
    pub plate: Option<usize>,
    /// The number of its piece of a printed mask, from 1; `None` for the whole.
    pub piece: Option<usize>,
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
    /// The file of this kind for the whole gripper.
    pub fn of(kind: Kind) -> Self {
        Self {
            kind,
            sheet: None,
            star: None,
            copy: None,
            plate: None,
            piece: None,
            paper: None,
            mirrored: false,
            valves: false,
            ngc: false,
        }
    }

    /// The part's prefix of the file name; "" for the whole gripper.
    fn part(&self) -> String {
        match (self.star, self.copy, self.plate, self.sheet) {
            (Some(star), ..) => format!("star-{star}-"),
            (_, Some(copy), ..) => format!("piece-{copy}-"),
            (_, _, Some(plate), _) => format!("plate-{plate}-"),
            (.., Some(sheet)) => format!("sheet-{sheet}-"),
            _ => String::new(),
        }
    }

    /// Its name without paper and ending.
    fn stem(&self) -> String {
        let face = if self.mirrored { "-mirrored" } else { "" };
        let piece = self.piece.map_or(String::new(), |piece| format!("-piece-{piece}"));
        let valves = if self.valves { "-valves" } else { "" };
        format!("{}{}{valves}{face}{piece}", self.part(), self.kind.subject().name())
    }

    /// Its name in the output directory: letters, digits, `-` and `.` only.
    pub fn name(&self) -> String {
        let paper = self.paper.and_then(Paper::name).map_or(String::new(), |paper| format!("-{paper}"));
        let ending = if self.ngc { NGC } else { self.kind.format().ending() };
        format!("{}{paper}.{ending}", self.stem())
    }

    /// The title inside the file, for a design called `name`.
    pub fn title(&self, name: &str) -> String {
        match (self.kind.subject(), self.sheet) {
            (subject @ (Subject::Seal | Subject::Outline), Some(sheet)) => {
                let valves = if self.valves { " with valves" } else { "" };
                format!("{}{valves}, sheet {sheet}: {name}", subject.name())
            }
            _ => format!("{}: {name}", self.stem()),
        }
    }

    /// The caption of every printed page.
    pub fn caption(&self) -> String {
        let number = |number: Option<usize>| number.unwrap_or(0);
        match self.kind.subject() {
            Subject::Outline if self.valves => format!("OUTLINE WITH VALVES SHEET {}", number(self.sheet)),
            Subject::Outline => format!("OUTLINE SHEET {}", number(self.sheet)),
            Subject::Frame => format!("FRAME PLATE {}", number(self.plate)),
            Subject::Mask if self.copy.is_some() => format!("SEPARATOR PIECE {}", number(self.copy)),
            _ => MaskPlate::caption(number(self.star), self.mirrored),
        }
    }

    /// The name in the header of a solid, for a design called `name`.
    pub fn solid_name(&self, name: &str) -> String {
        let piece = self.piece.map_or(String::new(), |piece| format!(", piece {piece}"));
        match (self.star, self.plate) {
            (Some(star), _) => {
                let side = if self.mirrored { "other side" } else { "this side up" };
                format!("mask of star {star}, {side}{piece}: {name}")
            }
            (_, plate) => format!("frame plate {}: {name}", plate.unwrap_or(0)),
        }
    }

    /// Thickness of the plate that a solid shows, mm.
    pub fn thickness(&self, spec: &Spec) -> f64 {
        match self.kind.subject() {
            Subject::Frame => spec.frame.plate_thickness.0,
            _ => spec.mask.thickness.0,
        }
    }

    /// The edge of a part: printed parts keep the drawn edge, cut parts are offset by the kerf.
    fn edge(&self) -> CutEdge {
        match self.kind.format() {
            Format::Stl | Format::Pdf => CutEdge::Part,
            _ => CutEdge::Tool,
        }
    }

    /// The exact geometry of the file; `None` if it is no drawing, or shows a part that `design` does not have.
    pub fn drawing(&self, design: &Design) -> Option<Drawing> {
        let is_solid = self.kind.format() == Format::Stl;
        match self.kind.subject() {
            Subject::Seal => Drawing::seals(design, self.sheet?),
            Subject::Outline if self.valves => Drawing::valve_outlines(design, self.sheet?, self.edge()),
            Subject::Outline => Drawing::outlines(design, self.sheet?, self.edge()),
            Subject::Mask if is_solid => Drawing::printed_mask(
                design.assembly()?,
                self.star?,
                self.mirrored,
                self.piece.map_or(0, |piece| piece - 1),
            ),
            Subject::Mask if self.copy.is_some() => {
                let placed = design.placed().iter().find(|placed| self.copy == Some(placed.index))?;
                let FlatPiece::Drawn(piece) = design.part(placed) else { return None };
                Drawing::separator(piece, self.edge())
            }
            Subject::Mask => Drawing::mask(design.assembly()?, self.star?, self.mirrored, self.edge()),
            Subject::Pieces => Drawing::pieces(design.assembly()?, self.star?, self.mirrored),
            Subject::Frame => {
                let design = design.assembly()?;
                let plate =
                    design.frame.plates.iter().find(|plate| plate.numbers.first() == self.plate.as_ref())?;
                Some(if is_solid {
                    Drawing::printed_plate(design, plate)
                } else {
                    Drawing::plate(design, plate, self.edge())
                })
            }
            _ => None,
        }
    }

    /// The same for each paper that takes it, or with `fits` false for each that does not.
    fn on_paper(self, design: &Design, fits: bool) -> impl Iterator<Item = Self> {
        let drawing = self.drawing(design);
        let chosen =
            move |paper: &Paper| drawing.as_ref().is_some_and(|drawing| paper.takes(drawing) == fits);
        Paper::ALL.into_iter().filter(chosen).map(move |paper| Self { paper: Some(paper), ..self })
    }
}

/// The ending of programs in `dialect`.
pub fn program_ending(dialect: Dialect) -> &'static str {
    if dialect == Dialect::LinuxCnc { NGC } else { Format::Gcode.ending() }
}

/// All files of `design`, described by `spec` for a machine of `dialect`, of the kinds in `request`, in the order of the manifest.
pub fn outputs(spec: &Spec, dialect: Dialect, design: &Design, request: &KindRequest) -> Vec<Output> {
    all(spec, dialect, design, request, true)
}

/// The files of the kinds in `request` that are left out because their drawing is too large for their paper.
pub fn too_large(spec: &Spec, design: &Design, request: &KindRequest) -> Vec<Output> {
    let mut out = all(spec, Dialect::Generic, design, request, false);
    out.retain(|output| output.paper.is_some());
    out
}

/// All files of `design`: with `fits` as they are written, else with those on paper that are not.
fn all(spec: &Spec, dialect: Dialect, design: &Design, request: &KindRequest, fits: bool) -> Vec<Output> {
    let mut out = vec![Output::of(Kind::Spec), Output::of(Kind::Machine)];
    if let Some(drawing) = &spec.drawing {
        out.push(Output::of(if drawing.is_dxf() { Kind::DrawingDxf } else { Kind::DrawingSvg }));
    }
    for kind in [Kind::SealGcode, Kind::TraceGcode] {
        programs(spec, dialect, design, kind, &mut out);
    }
    let of_sheet = [
        Kind::SealSvg,
        Kind::SealDxf,
        Kind::OutlineSvg,
        Kind::OutlineDxf,
        Kind::PreviewSvg,
        Kind::PreviewPng,
        Kind::OutlinePdf,
    ];
    for sheet in &design.sheets {
        let of_kind = |kind| Output { sheet: Some(sheet.index), ..Output::of(kind) };
        out.extend(of_sheet.map(of_kind));
        if design.on_sheet(sheet.index).any(|placed| !design.part(placed).shape().valves.is_empty()) {
            let outlines = [Kind::OutlineSvg, Kind::OutlineDxf, Kind::OutlinePdf];
            out.extend(outlines.map(|kind| Output { valves: true, ..of_kind(kind) }));
        }
    }
    if let Some(assembly) = design.assembly() {
        of_assembly(spec, assembly, &mut out);
    }
    // Equal copies have one separator.
    for first in design.firsts() {
        if let FlatPiece::Drawn(DrawnPiece { separator: Some(_), .. }) = design.part(first) {
            let of_mask = |kind| Output { copy: Some(first.index), ..Output::of(kind) };
            out.extend([Kind::MaskSvg, Kind::MaskDxf, Kind::MaskPdf].map(of_mask));
        }
    }
    if spec.load.is_some() {
        out.push(Output::of(Kind::Prediction));
    }
    out.extend([Kind::SceneGlb, Kind::Report].map(Output::of));
    out.retain(|output| request.takes(output.kind));
    let on_paper = |output: Output| match output.kind.format() {
        Format::Pdf => output.on_paper(design, fits).collect(),
        _ => vec![output],
    };
    out.into_iter().flat_map(on_paper).collect()
}

/// The programs of one kind; a program of a whole sheet has no piece.
fn programs(spec: &Spec, dialect: Dialect, design: &Design, kind: Kind, out: &mut Vec<Output>) {
    let of_sheet =
        |sheet| Output { sheet: Some(sheet), ngc: dialect == Dialect::LinuxCnc, ..Output::of(kind) };
    match (spec.machine.program, design.assembly()) {
        (ProgramScope::Sheet, _) => out.extend(design.sheets.iter().map(|sheet| of_sheet(sheet.index))),
        (ProgramScope::Piece, Some(assembly)) => out.extend(
            assembly.stars.iter().map(|star| Output { star: Some(star.index), ..of_sheet(star.sheet) }),
        ),
        (ProgramScope::Piece, None) => out.extend(
            design.placed().iter().map(|copy| Output { copy: Some(copy.index), ..of_sheet(copy.sheet) }),
        ),
    }
}

/// The masks and plates of a gripper.
fn of_assembly(spec: &Spec, assembly: &StarAssembly, out: &mut Vec<Output>) {
    for placed in assembly.firsts() {
        let pieces = &assembly.part(placed).pieces;
        // Also for the other face, if the spec requests it.
        for mirrored in [false, true].into_iter().take(1 + usize::from(spec.mask.mirror)) {
            let of_mask = |kind| Output { star: Some(placed.index), mirrored, ..Output::of(kind) };
            out.extend([Kind::MaskSvg, Kind::MaskDxf].map(of_mask));
            if pieces.are_several() {
                let piece = |number| Output { piece: Some(number), ..of_mask(Kind::MaskStl) };
                out.extend((1..=pieces.list.len()).map(piece));
                out.push(of_mask(Kind::PiecesSvg));
            } else {
                out.push(of_mask(Kind::MaskStl));
            }
            out.push(of_mask(Kind::MaskPdf));
        }
    }
    for plate in &assembly.frame.plates {
        let plate = plate.numbers.first().copied();
        let of_plate = |kind| Output { plate, ..Output::of(kind) };
        out.extend([Kind::FrameSvg, Kind::FrameDxf, Kind::FrameStl, Kind::FramePdf].map(of_plate));
    }
}
