//! The task of one program: its seams, their places, and their names in its comments.

use design::{Design, PlacedPart, SealJob};
use geom::{Bounds, Path, Point};
use sealed::{LaidSeam, PieceName, frame, laid_seams, scope};
use spec::{Machine, Spec};

/// The task of one program, independent of the product of its seams.
#[derive(Clone, Debug)]
pub struct ProgramTask<'a> {
    /// Temperature, speed and tolerances.
    pub spec: &'a Spec,
    /// The machine that runs it.
    pub machine: &'a Machine,
    /// Whether it seals; else it traces the way, cold.
    pub hot: bool,
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
}

impl<'a> ProgramTask<'a> {
    /// The task of the program for piece number `piece`, or for all pieces of `sheet`; `None` if the design has no such part.
    pub(super) fn of_pieces(
        (spec, machine, design): (&'a Spec, &'a Machine, &Design),
        hot: bool,
        sheet: usize,
        piece: Option<usize>,
    ) -> Option<Self> {
        let layout = design.sheets.iter().find(|layout| layout.index == sheet)?;
        let placed: Vec<&PlacedPart> = match piece {
            Some(index) => design.on_sheet(sheet).filter(|placed| placed.index == index).collect(),
            None => design.nearest_first(sheet),
        };
        let pieces = design.pieces(&placed);
        let names: Vec<PieceName> = pieces.iter().map(|piece| piece.name.clone()).collect();
        let _ = names.first()?;
        let corner = Point::new(layout.width, layout.height);
        let reach = machine.bench.work_area;
        let reach = reach.map_or(corner, |(x, y)| Point::new(corner.x.min(x.0), corner.y.min(y.0)));
        let seams = laid_seams(&pieces, machine.process.ramp.0);
        Some(Self {
            spec,
            machine,
            hot,
            scope: format!("sheet={sheet} {}", scope(&names)),
            frame: frame(&pieces, &seams),
            seams,
            job: SealJob::new(spec, design, &placed, machine.process.ramp.0),
            area: Bounds { min: Point::ORIGIN, max: reach },
        })
    }
}
