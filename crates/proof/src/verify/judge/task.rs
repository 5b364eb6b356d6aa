//! The task of one program: its seams, their places, and their names in its comments.

use design::{Design, PlacedPart, SealJob};
use geom::{Bounds, Isometry, Path, Point};
use sealed::{LaidSeam, PieceName, frame, laid_seams, scope};
use spec::{CutTool, Machine, Spec};

/// What a program does along its paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProgramWork {
    /// It seals, hot.
    Seal,
    /// It shows the way, cold and above the fabric.
    Trace,
    /// It cuts with this tool.
    Cut(CutTool),
}

impl ProgramWork {
    /// The key of the comment before every contact; `None` where there is none.
    pub(super) fn title(self) -> Option<&'static str> {
        match self {
            Self::Seal => Some("seam"),
            Self::Trace => None,
            Self::Cut(_) => Some("cut"),
        }
    }
}

/// The task of one program, independent of the product of its seams.
#[derive(Clone, Debug)]
pub struct ProgramTask<'a> {
    /// Temperature, speed and tolerances.
    pub spec: &'a Spec,
    /// The machine that runs it.
    pub machine: &'a Machine,
    /// What it does along its paths.
    pub work: ProgramWork,
    /// Scope of the program, in the words of its comment: "sheet=1 stars=1-3", "piece=disc".
    pub scope: String,
    /// The seams along their centre lines, in the order of the pieces: what a trace shows.
    pub seams: Vec<LaidSeam>,
    /// The contacts, in the order of sealing.
    pub job: SealJob,
    /// The rectangle that a trace shows first.
    pub frame: Path,
    /// The work area of the iron.
    pub area: Bounds,
    /// The marks above which it stops first.
    pub marks: Vec<Point>,
    /// The motion of its sheet, which was found again; `None` for a sheet where it was laid out.
    pub motion: Option<Isometry>,
}

impl<'a> ProgramTask<'a> {
    /// Whether the program seals with a laser, which waits for the operator before its first seam.
    pub(super) fn arms_laser(&self) -> bool {
        self.work == ProgramWork::Seal && self.machine.controller.laser.is_some()
    }

    /// The task of the program for piece number `piece`, or for all pieces of `sheet`; `None` if the design has no such part.
    pub(super) fn of_pieces(
        (spec, machine, design): (&'a Spec, &'a Machine, &Design),
        work: ProgramWork,
        sheet: usize,
        piece: Option<usize>,
    ) -> Option<Self> {
        let placed: Vec<&PlacedPart> = match piece {
            Some(index) => design.on_sheet(sheet).filter(|placed| placed.index == index).collect(),
            None => design.nearest_first(sheet),
        };
        let pieces = design.pieces(&placed);
        let names: Vec<PieceName> = pieces.iter().map(|piece| piece.name.clone()).collect();
        let _ = names.first()?;
        let seams = laid_seams(&pieces, machine.process.ramp.0);
        Some(Self {
            spec,
            machine,
            work,
            scope: format!("sheet={sheet} {}", scope(&names)),
            frame: frame(&pieces, &seams),
            seams,
            job: SealJob::new(spec, design, &placed, machine.process.ramp.0),
            area: area(machine, design, sheet)?,
            marks: design.stops(spec, sheet),
            motion: design.motion(sheet),
        })
    }

    /// The task of the program that cuts `sheet` with `tool`; `spec` has the cut in the place of its seal. `None` if there is no such sheet.
    pub(super) fn of_cut(
        spec: &'a Spec,
        machine: &'a Machine,
        design: &Design,
        tool: CutTool,
        sheet: usize,
    ) -> Option<Self> {
        let names: Vec<PieceName> = design.on_sheet(sheet).map(PlacedPart::name).collect();
        // An axis that leads a blade may be ahead of the sheet's edge.
        let reach = tool.blade_offset().0;
        Some(Self {
            spec,
            machine,
            work: ProgramWork::Cut(tool),
            scope: format!("sheet={sheet} {}", scope(&names)),
            seams: Vec::new(),
            job: SealJob::of_cuts(spec, design, sheet, machine.process.ramp.0),
            frame: Path::default(),
            area: area(machine, design, sheet)?.outset(reach),
            marks: Vec::new(),
            motion: design.motion(sheet),
        })
    }
}

/// The part of a sheet that `machine` reaches, with the sheet's corner where programs begin; `None` if there is no such sheet.
fn area(machine: &Machine, design: &Design, sheet: usize) -> Option<Bounds> {
    let bounds = design.sheet_bounds(sheet)?.union(Bounds::of_points([Point::ORIGIN]));
    let Some((x, y)) = machine.bench.work_area else { return Some(bounds) };
    let min = Point::new(bounds.min.x.max(0.0), bounds.min.y.max(0.0));
    Some(Bounds { min, max: Point::new(bounds.max.x.min(x.0), bounds.max.y.min(y.0)) })
}
