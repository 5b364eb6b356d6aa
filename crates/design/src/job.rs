//! The job of a program: its contacts in the order of sealing, each with its process.
//!
//! A **contact** is one way of the iron along the fabric: a seam, or where it has several lines or passes one line of it once. Seams of
//! one temperature follow each other, the coolest first, because an iron heats up sooner than it cools down; among those the order is
//! that of the pieces. Passes of open seams go there and back, those of closed ones always the same way.

use crate::{CutEdge, Design, Drawing, Layer, PlacedPart, SeamLines};
use geom::order::sort_by;
use geom::{Isometry, Path, Segment};
use sealed::{LaidSeam, PieceName, PlacedPiece, Seam};
use spec::units::{Duration, Temperature};
use spec::{SealPause, SealProcess, Spec};

/// One contact of the iron with the fabric.
#[derive(Clone, Debug, PartialEq)]
pub struct SealContact {
    /// The way of the iron, with the name of the seam.
    pub laid: LaidSeam,
    /// The place of its process in [`SealJob::processes`].
    pub process: usize,
    /// Number of the line, from 1.
    pub line: u32,
    /// Number of the pass along the line, from 1.
    pub pass: u32,
}

/// A stop of the iron, parked, before a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SealStop {
    /// Whether the operator looks at the last seam.
    pub pauses: bool,
    /// The temperature to which the iron is heated.
    pub heat: Option<Temperature>,
}

/// Path that is cut twice where a cut meets its start, mm: less may leave a thread where the tool came down.
const CUT_OVERLAP: f64 = 1.0;

/// The arc length at the middle of the longest straight piece of `path`, mm; of its longest piece where none is straight.
fn calm_place(path: &Path) -> f64 {
    let (mut best, mut place, mut start) = ((false, 0.0), 0.0, 0.0);
    for segment in &path.segments {
        let (is_line, length) = (matches!(segment, Segment::Line(_)), segment.length());
        // Rounding must not decide between pieces that are equally long.
        if (is_line && !best.0) || (is_line == best.0 && length > best.1 + 1e-6) {
            (best, place) = ((is_line, length), start + 0.5 * length);
        }
        start += length;
    }
    place
}

/// The contacts of one program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SealJob {
    /// The processes of its contacts, in the order of their first contacts.
    pub processes: Vec<SealProcess>,
    /// The contacts in the order of sealing.
    pub contacts: Vec<SealContact>,
}

impl SealJob {
    /// The job that seals the pieces `placed` of `design`, with ways down and up of `ramp` mm.
    pub fn new(spec: &Spec, design: &Design, placed: &[&PlacedPart], ramp: f64) -> Self {
        let mut job = Self::default();
        for (piece, part) in design.pieces(placed).iter().zip(placed) {
            for seam in design.part(part).seam_lines() {
                job.add(spec.process(&seam.process), &seam.lines, piece, ramp);
            }
        }
        job.sorted()
    }

    /// The job that seals all seams of `pieces` by the process of `[seal]`; along its centre line where a seam bends too sharply for several
    /// lines.
    pub fn of_pieces(spec: &Spec, pieces: &[PlacedPiece<'_>], ramp: f64) -> Self {
        let mut job = Self::default();
        for piece in pieces {
            for seam in &piece.shape.seams {
                let process = spec.default_process();
                let lines =
                    SeamLines::new(seam, &process).map_or_else(|_| vec![seam.clone()], |seam| seam.lines);
                job.add(process, &lines, piece, ramp);
            }
        }
        job
    }

    /// The job that cuts sheet number `sheet` of `design` as its drawings for cutting machines have it: registration holes, then holes, then
    /// outlines, each along the tool's way. `spec` has the cut in the place of its seal ([`Spec::cut_by`]). Valves are cut out of one sheet
    /// of fabric before, and labels are not cut.
    ///
    /// A cut begins in the middle of its longest straight piece, away from corners, with its way down along itself.
    pub fn of_cuts(spec: &Spec, design: &Design, sheet: usize, ramp: f64) -> Self {
        let mut job = Self { processes: vec![spec.default_process()], contacts: Vec::new() };
        let layers =
            Drawing::outlines(design, sheet, CutEdge::Tool).map_or_else(Vec::new, |drawing| drawing.layers);
        for (layer, shapes) in &layers {
            let is_cut = match layer {
                Layer::Registration | Layer::CutHole | Layer::CutOutside => true,
                Layer::Label
                | Layer::Seal
                | Layer::SealInner
                | Layer::SealOuter
                | Layer::CutValve
                | Layer::MaskWindow
                | Layer::MaskPlate
                | Layer::SeparatorWindow
                | Layer::SeparatorEdge
                | Layer::MaskJoint
                | Layer::PostHole
                | Layer::FrameOpening
                | Layer::FrameEdge
                | Layer::PaperMark => false,
            };
            let paths = shapes.iter().filter(|_| is_cut).flat_map(|shape| shape.paths().into_owned());
            for (path, number) in paths.zip(1..) {
                let seam = Seam { overlap: CUT_OVERLAP, ..Seam::weld(path.starting_at(calm_place(&path))) };
                let name = PieceName::Named(format!("{}-{number}", layer.name()));
                let laid_cut = LaidSeam::new(&name, &seam, Isometry::IDENTITY, ramp);
                job.contacts.push(SealContact { laid: laid_cut, process: 0, line: 1, pass: 1 });
            }
        }
        job
    }

    /// Adds the contacts of one seam of `piece`.
    fn add(&mut self, process: SealProcess, lines: &[Seam], piece: &PlacedPiece<'_>, ramp: f64) {
        let passes = process.seal.passes;
        let place = self.processes.iter().position(|other| other.name == process.name);
        let index = place.unwrap_or_else(|| {
            self.processes.push(process);
            self.processes.len() - 1
        });
        for (seam, line) in lines.iter().zip(1..) {
            let forward = LaidSeam::new(&piece.name, seam, piece.placement, ramp);
            let back = (passes > 1 && !seam.center_line.closed).then(|| {
                let reversed = Seam { center_line: seam.center_line.reversed(), ..seam.clone() };
                LaidSeam::new(&piece.name, &reversed, piece.placement, ramp)
            });
            for pass in 1..=passes {
                let way = back.as_ref().filter(|_| pass % 2 == 0).unwrap_or(&forward);
                self.contacts.push(SealContact { laid: way.clone(), process: index, line, pass });
            }
        }
    }

    /// The job with its contacts sorted by temperature; of equal ones the order stays.
    fn sorted(self) -> Self {
        let Self { processes, mut contacts } = self;
        sort_by(&mut contacts, |a, b| {
            let [a, b] = [a, b].map(|contact| processes[contact.process].seal.temperature.0);
            a.total_cmp(&b)
        });
        let mut order: Vec<usize> = Vec::new();
        for contact in &mut contacts {
            let place = order.iter().position(|process| *process == contact.process);
            contact.process = place.unwrap_or_else(|| {
                order.push(contact.process);
                order.len() - 1
            });
        }
        Self { processes: order.into_iter().map(|index| processes[index].clone()).collect(), contacts }
    }

    /// The stop of the iron before the contact at place `index`.
    pub fn stop_before(&self, index: usize) -> SealStop {
        let contact = &self.contacts[index];
        let temperature = self.process(contact).seal.temperature;
        let Some(last) = index.checked_sub(1).map(|last| &self.contacts[last]) else {
            // A tool of 0 C is cold.
            return SealStop { pauses: false, heat: Some(temperature).filter(|heat| heat.0 > 0.0) };
        };
        let last_seal = &self.process(last).seal;
        let pauses = match last_seal.pause {
            SealPause::Never => false,
            SealPause::Seam => last.laid.name != contact.laid.name,
            SealPause::Piece => last.laid.name.piece != contact.laid.name.piece,
        };
        let differs = last_seal.temperature != temperature;
        SealStop { pauses, heat: differs.then_some(temperature) }
    }

    /// The wait for the seam to cool after the contact at place `index`; `None` without one, and within a seam.
    pub fn cool_after(&self, index: usize) -> Option<Duration> {
        let contact = &self.contacts[index];
        let next = self.contacts.get(index + 1);
        let is_last = next.is_none_or(|next| next.laid.name != contact.laid.name);
        Some(self.process(contact).seal.cool).filter(|cool| is_last && cool.0 > 0.0)
    }

    /// The process of `contact`.
    pub fn process(&self, contact: &SealContact) -> &SealProcess {
        &self.processes[contact.process]
    }

    /// Whether every contact is the only one of its seam, made by the process of `[seal]`.
    pub fn is_plain(&self) -> bool {
        self.processes.iter().all(SealProcess::is_plain)
    }
}
