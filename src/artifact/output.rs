//! Outputs: which files a design has. The one table that the builder fills and the verifier asks for.

use crate::artifact::asked::Asked;
use crate::artifact::kind::{Format, Kind, Subject};
use crate::design::{Design, Drawing, Edge, MaskPlate, Paper, PlacedStar};
use crate::spec::{Dialect, ProgramScope, Spec};

/// The ending of programs for LinuxCNC.
pub const NGC: &str = "ngc";

/// One file of a design: what it is, and of which part. Everything else about it follows, its name too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// What it is.
    pub kind: Kind,
    /// The sheet it belongs to.
    pub sheet: Option<usize>,
    /// The star it belongs to; of equal ones the first.
    pub star: Option<usize>,
    /// The lowest plate of the frame that it is for.
    pub plate: Option<usize>,
    /// The paper that it is laid out for; `None` for what is not printed.
    pub paper: Option<Paper>,
    /// Whether it is for the face that the iron does not touch.
    pub mirrored: bool,
    /// Whether it is a program for LinuxCNC, whose file dialog lists `.ngc` alone.
    pub ngc: bool,
}

impl Output {
    /// The file of this kind for the whole gripper.
    pub fn of(kind: Kind) -> Self {
        Self { kind, sheet: None, star: None, plate: None, paper: None, mirrored: false, ngc: false }
    }

    /// What it is a file of, in its name; "" for the whole gripper.
    fn part(&self) -> String {
        match (self.star, self.plate, self.sheet) {
            (Some(star), ..) => format!("star-{star}-"),
            (_, Some(plate), _) => format!("plate-{plate}-"),
            (_, _, Some(sheet)) => format!("sheet-{sheet}-"),
            _ => String::new(),
        }
    }

    /// Its name without paper and ending.
    fn stem(&self) -> String {
        let face = if self.mirrored { "-mirrored" } else { "" };
        format!("{}{}{face}", self.part(), self.kind.subject().name())
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
                format!("{}, sheet {sheet}: {name}", subject.name())
            }
            _ => format!("{}: {name}", self.stem()),
        }
    }

    /// What stands on every page of it, where it is printed.
    pub fn caption(&self) -> String {
        MaskPlate::caption(self.star.unwrap_or(0), self.mirrored)
    }

    /// Printed parts come out as they are drawn; what is cut loses the kerf.
    fn edge(&self) -> Edge {
        match self.kind.format() {
            Format::Stl | Format::Pdf => Edge::Part,
            _ => Edge::Tool,
        }
    }

    /// The exact geometry that it shows; `None` for what is no drawing, or shows a part that `design` does not have.
    pub fn drawing(&self, design: &Design) -> Option<Drawing> {
        match self.kind.subject() {
            Subject::Seal => Drawing::seals(design, self.sheet?),
            Subject::Outline => Drawing::outlines(design, self.sheet?),
            Subject::Mask => Drawing::mask(design, self.star?, self.mirrored, self.edge()),
            Subject::Frame => {
                let plate =
                    design.frame.plates.iter().find(|plate| plate.numbers.first() == self.plate.as_ref());
                plate.map(|plate| Drawing::plate(design, plate))
            }
            _ => None,
        }
    }
}

/// The ending of programs in `dialect`.
pub fn program_ending(dialect: Dialect) -> &'static str {
    if dialect == Dialect::LinuxCnc { NGC } else { Format::Gcode.ending() }
}

/// Every file of `design`, which `spec` describes for a machine of `dialect`, of the kinds that are `asked` for, in the order of the manifest.
pub fn outputs(spec: &Spec, dialect: Dialect, design: &Design, asked: &Asked) -> Vec<Output> {
    let mut out = vec![Output::of(Kind::Spec), Output::of(Kind::Machine)];
    for kind in [Kind::SealGcode, Kind::TraceGcode] {
        out.extend(programs(spec, design).map(|(sheet, star)| Output {
            sheet: Some(sheet),
            star,
            ngc: dialect == Dialect::LinuxCnc,
            ..Output::of(kind)
        }));
    }
    let of_sheet = [
        Kind::SealSvg,
        Kind::SealDxf,
        Kind::OutlineSvg,
        Kind::OutlineDxf,
        Kind::PreviewSvg,
        Kind::PreviewPng,
    ];
    for sheet in &design.sheets {
        out.extend(of_sheet.map(|kind| Output { sheet: Some(sheet.index), ..Output::of(kind) }));
    }
    for placed in design.firsts() {
        masks(spec, design, placed, &mut out);
    }
    for plate in &design.frame.plates {
        let plate = plate.numbers.first().copied();
        out.extend([Kind::FrameSvg, Kind::FrameDxf].map(|kind| Output { plate, ..Output::of(kind) }));
    }
    if spec.load.is_some() {
        out.push(Output::of(Kind::Prediction));
    }
    out.retain(|output| asked.takes(output.kind));
    out
}

/// Sheet and star of every program; a program of a whole sheet has no star.
fn programs(spec: &Spec, design: &Design) -> impl Iterator<Item = (usize, Option<usize>)> {
    let by_star = spec.machine.program == ProgramScope::Star;
    let stars = design.stars.iter().filter(move |_| by_star).map(|star| (star.sheet, Some(star.index)));
    stars.chain(design.sheets.iter().filter(move |_| !by_star).map(|sheet| (sheet.index, None)))
}

/// The masks of a distinct star, for its other face too if the spec says so.
fn masks(spec: &Spec, design: &Design, placed: &PlacedStar, out: &mut Vec<Output>) {
    for mirrored in [false, true].into_iter().take(1 + usize::from(spec.mask.mirror)) {
        let of_mask = |kind| Output { star: Some(placed.index), mirrored, ..Output::of(kind) };
        out.extend([Kind::MaskSvg, Kind::MaskDxf, Kind::MaskStl].map(of_mask));
        let paged = of_mask(Kind::MaskPdf);
        let Some(drawing) = paged.drawing(design) else { continue };
        let papers = Paper::ALL.into_iter().filter(|paper| paper.takes(&drawing));
        out.extend(papers.map(|paper| Output { paper: Some(paper), ..paged }));
    }
}
