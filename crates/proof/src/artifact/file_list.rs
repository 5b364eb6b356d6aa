//! The list of a design's files, which both the builder and the verifier use.
//!
//! The subject of a kind decides for which [`Parts`] of a design its files are made, so that each kind is made somewhere.

use crate::artifact::kind::{Format, Kind, KindRequest, Subject};
use crate::artifact::output::{NGC, Output, OutputPart};
use design::{Design, DrawnPiece, FlatPiece, StarAssembly};
use geom::order::sort_by_key;
use spec::{Dialect, MaskKind, ProgramScope, Spec};

/// The ending of programs in `dialect`.
pub fn program_ending(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::LinuxCnc => NGC,
        Dialect::Generic
        | Dialect::Grbl
        | Dialect::GrblHal
        | Dialect::FluidNc
        | Dialect::Marlin
        | Dialect::Klipper
        | Dialect::RepRapFirmware
        | Dialect::Bambu => Format::Gcode.ending(),
    }
}

/// Whether the machines of `dialect` take programs in packages.
pub fn takes_packages(dialect: Dialect) -> bool {
    match dialect {
        Dialect::Bambu => true,
        Dialect::Generic
        | Dialect::Grbl
        | Dialect::GrblHal
        | Dialect::FluidNc
        | Dialect::LinuxCnc
        | Dialect::Marlin
        | Dialect::Klipper
        | Dialect::RepRapFirmware => false,
    }
}

/// Whether a design of `spec` has a model for simulators: stars at a pressure.
pub fn has_mjcf(spec: &Spec) -> bool {
    spec.has_stars() && spec.load.as_ref().is_some_and(|load| load.pressure.is_some())
}

/// All files of `design`, described by `spec` for a machine of `dialect`, of the kinds in `request`, in the order of the manifest.
pub fn outputs(spec: &Spec, dialect: Dialect, design: &Design, request: &KindRequest) -> Vec<Output> {
    list_files(spec, dialect, design, request, true)
}

/// The files of the kinds in `request` that are left out because their drawing is too large for their paper.
pub fn too_large(spec: &Spec, design: &Design, request: &KindRequest) -> Vec<Output> {
    let mut outputs = list_files(spec, Dialect::Generic, design, request, false);
    outputs.retain(|output| output.paper.is_some());
    outputs
}

/// The parts of a design for each of which there is a file of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parts {
    /// The whole design: its sources, at the head of the list.
    Sources,
    /// What a machine does in one go: each sheet, or each star or piece.
    Programs,
    /// Each sheet.
    Sheets,
    /// Each star, or each drawn piece with a separator.
    Masks,
    /// Each plate of the frame.
    Plates,
    /// Each sheet of paper with separators.
    Papers,
    /// The whole design: its results, at the end of the list.
    Results,
}

impl Parts {
    /// The parts for each of which there is a file of `kind`.
    fn of_kind(kind: Kind) -> Self {
        match kind.subject() {
            Subject::Spec | Subject::Machine | Subject::Drawing => Self::Sources,
            Subject::Seal if kind.is_program() => Self::Programs,
            Subject::Trace => Self::Programs,
            Subject::Seal | Subject::Cut | Subject::Outline | Subject::Preview => Self::Sheets,
            Subject::Mask | Subject::Pieces => Self::Masks,
            Subject::Frame => Self::Plates,
            Subject::Separator => Self::Papers,
            Subject::PressPlan | Subject::Prediction | Subject::Scene | Subject::Mjcf | Subject::Report => {
                Self::Results
            }
        }
    }

    /// The kinds of files that these parts have, in the order of the list: those on paper last.
    fn kinds(self) -> Vec<Kind> {
        let of_parts = Kind::ALL.iter().copied().filter(|kind| Self::of_kind(*kind) == self);
        let mut kinds: Vec<Kind> = of_parts.collect();
        sort_by_key(&mut kinds, |kind| kind.format() == Format::Pdf);
        kinds
    }

    /// The files of kinds that `spec` has, one each: the parts are the whole design.
    fn whole_design(self, spec: &Spec) -> impl Iterator<Item = Output> {
        self.kinds().into_iter().filter(|kind| is_of_spec(spec, *kind)).map(Output::new)
    }
}

/// Whether a design of `spec` has files of `kind`.
fn is_of_spec(spec: &Spec, kind: Kind) -> bool {
    match kind.subject() {
        Subject::Drawing => {
            let is_dxf = kind.format() == Format::Dxf;
            spec.drawing.as_ref().is_some_and(|drawing| drawing.is_dxf() == is_dxf)
        }
        Subject::Prediction => spec.load.is_some(),
        Subject::PressPlan => spec.press.is_some(),
        Subject::Mjcf => has_mjcf(spec),
        Subject::Cut => spec.cut.program.is_some() && spec.press.is_none(),
        Subject::Spec
        | Subject::Machine
        | Subject::Seal
        | Subject::Trace
        | Subject::Outline
        | Subject::Mask
        | Subject::Pieces
        | Subject::Frame
        | Subject::Separator
        | Subject::Preview
        | Subject::Scene
        | Subject::Report => true,
    }
}

/// Whether machines of `dialect` take files of `kind`: most take no package.
fn is_taken(kind: Kind, dialect: Dialect) -> bool {
    kind.format() != Format::Package || takes_packages(dialect)
}

/// All files of `design`: with `fits` as they are written, else with those on paper that are not.
///
/// The parts follow one another as in [`Parts`], and of each part all kinds of files together.
fn list_files(
    spec: &Spec,
    dialect: Dialect,
    design: &Design,
    request: &KindRequest,
    fits: bool,
) -> Vec<Output> {
    let mut outputs: Vec<Output> = Parts::Sources.whole_design(spec).collect();
    // A press runs no programs.
    let is_run = |kind: &Kind| spec.press.is_none() && is_taken(*kind, dialect);
    for kind in Parts::Programs.kinds().into_iter().filter(is_run) {
        programs(spec, dialect, design, kind, &mut outputs);
    }
    for sheet in &design.sheets {
        of_sheet(spec, dialect, design, sheet.index, &mut outputs);
    }
    if let Some(assembly) = design.assembly() {
        of_assembly(spec, assembly, &mut outputs);
    }
    for paper in &design.papers {
        let part = OutputPart::Paper(paper.index);
        outputs.extend(Parts::Papers.kinds().into_iter().map(|kind| Output { part, ..Output::new(kind) }));
    }
    // Equal copies have one separator. It is thin paper: no solid.
    for first in design.firsts().filter(|_| design.papers.is_empty()) {
        if let FlatPiece::Drawn(DrawnPiece { separator: Some(_), .. }) = design.part(first) {
            let part = OutputPart::Piece { piece: first.index, sheet: None };
            let is_flat = |kind: &Kind| kind.subject() == Subject::Mask && kind.format() != Format::Stl;
            let kinds = Parts::Masks.kinds().into_iter().filter(is_flat);
            outputs.extend(kinds.map(|kind| Output { part, ..Output::new(kind) }));
        }
    }
    outputs.extend(Parts::Results.whole_design(spec));
    outputs.retain(|output| request.includes(output.kind));
    // Of a sheet that was found again only its programs are made again.
    if let Some(alignment) = design.alignment {
        outputs.retain(|output| output.kind.is_source() || output.part.sheet() == Some(alignment.sheet));
    }
    let on_paper = |output: Output| match output.kind.format() {
        Format::Pdf if output.kind == Kind::PressPlan => Vec::from_iter(fits.then_some(output)),
        Format::Pdf => output.on_paper(design, fits).collect(),
        Format::Toml
        | Format::Gcode
        | Format::Package
        | Format::Svg
        | Format::Dxf
        | Format::Stl
        | Format::Json
        | Format::Png
        | Format::Glb
        | Format::Xml
        | Format::Html => vec![output],
    };
    outputs.into_iter().flat_map(on_paper).collect()
}

/// Drawings of one sheet, and templates for its valves.
fn of_sheet(spec: &Spec, dialect: Dialect, design: &Design, sheet: usize, outputs: &mut Vec<Output>) {
    let part = OutputPart::Sheet(sheet);
    let mut kinds = Parts::Sheets.kinds();
    kinds.retain(|kind| is_of_spec(spec, *kind) && is_taken(*kind, dialect));
    outputs.extend(kinds.iter().map(|kind| {
        let ngc = kind.format() == Format::Gcode && program_ending(dialect) == NGC;
        Output { part, ngc, ..Output::new(*kind) }
    }));
    if design.on_sheet(sheet).any(|placed| !design.part(placed).shape().valves.is_empty()) {
        let outlines = kinds.iter().filter(|kind| kind.subject() == Subject::Outline);
        outputs.extend(outlines.map(|kind| Output { part, valves: true, ..Output::new(*kind) }));
    }
}

/// The programs of one kind: one a sheet, or one a star or piece.
fn programs(spec: &Spec, dialect: Dialect, design: &Design, kind: Kind, outputs: &mut Vec<Output>) {
    let program = Output { ngc: program_ending(dialect) == NGC, ..Output::new(kind) };
    match (spec.machine.program, design.assembly()) {
        (ProgramScope::Sheet, _) => {
            let parts = design.sheets.iter().map(|sheet| OutputPart::Sheet(sheet.index));
            outputs.extend(parts.map(|part| Output { part, ..program }));
        }
        (ProgramScope::Piece, Some(assembly)) => {
            let stars = assembly.stars.iter();
            let parts = stars.map(|star| OutputPart::Star { star: star.index, sheet: Some(star.sheet) });
            outputs.extend(parts.map(|part| Output { part, ..program }));
        }
        (ProgramScope::Piece, None) => {
            let pieces = design.placed().iter();
            let parts =
                pieces.map(|placed| OutputPart::Piece { piece: placed.index, sheet: Some(placed.sheet) });
            outputs.extend(parts.map(|part| Output { part, ..program }));
        }
    }
}

/// The masks and plates of a gripper.
fn of_assembly(spec: &Spec, assembly: &StarAssembly, outputs: &mut Vec<Output>) {
    for placed in assembly.firsts() {
        let tiles = &assembly.part(placed).tiles;
        let part = OutputPart::Star { star: placed.index, sheet: None };
        // Also for the other face, if the spec requests it.
        let faces = match spec.mask.kind {
            MaskKind::Coating => 1 + usize::from(spec.mask.mirror),
            MaskKind::Separator => 0,
        };
        for mirrored in [false, true].into_iter().take(faces) {
            for kind in Parts::Masks.kinds() {
                let file = Output { part, mirrored, ..Output::new(kind) };
                if kind.format() == Format::Stl && tiles.are_several() {
                    outputs
                        .extend((1..=tiles.tiles.len()).map(|number| Output { tile: Some(number), ..file }));
                } else if kind.subject() == Subject::Mask || tiles.are_several() {
                    outputs.push(file);
                }
            }
        }
    }
    for plate in &assembly.frame.plates {
        let Some(lowest) = plate.numbers.first() else { continue };
        let of_plate = |kind| Output { part: OutputPart::Plate(*lowest), ..Output::new(kind) };
        outputs.extend(Parts::Plates.kinds().into_iter().map(of_plate));
    }
}
