//! What one program should do: its seams, where they lie, and what its comments call it.

use crate::design::{Design, LaidSeam, PlacedStar};
use crate::geom::{Bounds, Line, Path, Point};
use crate::spec::{Machine, Spec};

/// What one program should do, whatever its seams belong to.
#[derive(Clone, Debug)]
pub struct ProgramTask<'a> {
    /// Temperature, speed and tolerances.
    pub spec: &'a Spec,
    /// The machine that runs it.
    pub machine: &'a Machine,
    /// Whether it seals; else it shows the way, cold.
    pub hot: bool,
    /// What it covers, in the words of its comment: "sheet=1 stars=1-3", "piece=disc".
    pub scope: String,
    /// The seams, in the order of sealing.
    pub seams: Vec<LaidSeam>,
    /// The rectangle that a trace shows first.
    pub frame: Path,
    /// Where the iron may go.
    pub area: Bounds,
}

impl<'a> ProgramTask<'a> {
    /// The task of the program for `star`, or for all stars of `sheet`; `None` if the design has no such part.
    pub(in crate::verify) fn of_stars(
        (spec, machine, design): (&'a Spec, &'a Machine, &Design),
        hot: bool,
        sheet: usize,
        star: Option<usize>,
    ) -> Option<Self> {
        let layout = design.sheets.iter().find(|layout| layout.index == sheet)?;
        let all = design.nearest_first(sheet).into_iter();
        let stars: Vec<&PlacedStar> =
            all.filter(|placed| star.is_none_or(|index| placed.index == index)).collect();
        let (first, last) = (stars.first()?.index, stars.last()?.index);
        let numbers = if first == last { first.to_string() } else { format!("{first}-{last}") };
        let corner = Point::new(layout.width, layout.height);
        let reach = machine.bench.work_area;
        let reach = reach.map_or(corner, |(x, y)| Point::new(corner.x.min(x.0), corner.y.min(y.0)));
        let seams = design.laid_seams(&stars, machine.process.ramp.0);
        Some(Self {
            spec,
            machine,
            hot,
            scope: format!("sheet={sheet} stars={numbers}"),
            frame: frame(design, &stars, &seams),
            seams,
            area: Bounds { min: Point::ORIGIN, max: reach },
        })
    }
}

/// The rectangle around the cut, and around everything that the iron does to the fabric.
fn frame(design: &Design, stars: &[&PlacedStar], seams: &[LaidSeam]) -> Path {
    let parts = stars.iter().map(|placed| (placed, design.part(placed)));
    let bounds = parts.fold(Bounds::EMPTY, |bounds, (placed, part)| {
        bounds.union(placed.placement.path(&part.outline.outside).bounds())
    });
    let band = stars.first().map_or(0.0, |placed| design.part(placed).band);
    let seams = seams.iter().flat_map(|seam| [&seam.lead_in, &seam.run, &seam.lead_out]);
    let touched = seams.map(|path| path.bounds().grown(band / 2.0));
    let Bounds { min, max } = touched.fold(bounds, Bounds::union);
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y), min];
    Path::closed(corners.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect())
}
