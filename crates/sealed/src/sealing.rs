//! A sketch as a sealed shape, or all its faults.

use crate::around::around_air;
use crate::checks::{checked, sharp_corners};
use crate::drawn_seams::{drawn_seams, join_ends, lost_ports};
use crate::fault::{Repair, ShapeCode, ShapeFault, ShapeWarning, quoted};
use crate::layout::{Layout, Line, LineUse};
use crate::notes::SealingNotes;
use crate::order::{ordered, seam_names};
use crate::outline::outline;
use crate::ports::once;
use crate::sketch::{Rules, Sketch};
use crate::unsound::unsound_chambers;
use crate::valve::placed_valves;
use crate::{AirSide, Port, Role, SealedShape, Seam};
use geom::{Path, Point};

/// A sketch that can be sealed.
#[derive(Clone, Debug, PartialEq)]
pub struct Sealing {
    /// The shape.
    pub shape: SealedShape,
    /// The air that the seams enclose.
    pub air: AirSide,
    /// Bands within the air: walls and welds, by their centre lines as they are sealed.
    pub inner: Vec<Path>,
    /// Closed paths that are cut inside the outline: holes, and drawn cuts inside it.
    pub holes: Vec<Path>,
    /// The repairs of the drawing.
    pub repairs: Vec<Repair>,
    /// Places that may fail or differ from the drawing.
    pub warnings: Vec<ShapeWarning>,
}

/// The sealed shape of a sketch.
///
/// # Errors
/// All faults that were found, each with its place. Faults of single curves hide those of bands.
pub fn sealed_shape(sketch: &Sketch, rules: &Rules) -> Result<Sealing, Vec<ShapeFault>> {
    let mut notes = SealingNotes::default();
    let sketch = &Sketch { ports: once(&sketch.ports, rules.join, &mut notes), ..sketch.clone() };
    let mut taken = Vec::new();
    let mut lines = around_air(sketch, rules, &mut taken, &mut notes);
    drawn_seams(sketch, rules, &mut taken, &mut lines, &mut notes);
    if notes.faults.is_empty() {
        lost_ports(sketch, rules, &taken, &mut notes);
    }
    if lines.lines.is_empty() && notes.faults.is_empty() {
        let text = ("no edge of air and no seam is drawn", "give a layer the role air or seam");
        notes.fault(ShapeCode::Empty, &[], Point::ORIGIN, text, [0.0, 1.0]);
    }
    if !notes.faults.is_empty() {
        return Err(notes.faults);
    }
    join_ends(&mut lines.lines, rules.band);
    let (cut, holes) = outline(sketch, rules, &lines, &mut notes);
    let valves = placed_valves(sketch, rules, &lines, &mut notes);
    lines.lines = ordered(lines.lines);
    checked(&lines, sketch, rules, &mut notes);
    sharp_corners(&lines, rules, &mut notes);
    let is_inner = |line: &&Line| matches!(line.kind, LineUse::Weld | LineUse::Wall);
    let inner = lines.lines.iter().filter(is_inner).map(|line| line.path.clone()).collect();
    let shape = SealedShape {
        seams: seams(&lines, rules, &mut notes),
        band: rules.band,
        cut,
        ports: ports(&lines),
        valves,
    };
    unsound_chambers(&shape, &lines, sketch, rules, &mut notes);
    if !notes.faults.is_empty() {
        return Err(notes.faults);
    }
    let air = AirSide { mouths: lines.mouths, ..lines.air };
    Ok(Sealing { shape, air, inner, holes, repairs: notes.repairs, warnings: notes.warnings })
}

fn ports(lines: &Layout) -> Vec<Port> {
    let mut mouths = lines.mouths.clone();
    mouths.sort_by_key(|mouth| mouth.port);
    mouths.iter().map(|mouth| Port { at: mouth.at, width: 2.0 * mouth.half }).collect()
}

/// The seams along `lines`. A closed seam is sealed twice along half of its length at most.
fn seams(lines: &Layout, rules: &Rules, notes: &mut SealingNotes) -> Vec<Seam> {
    let named = lines.lines.iter().zip(seam_names(&lines.lines));
    let seam = |(line, name): (&Line, String)| {
        let overlap = if line.path.closed { rules.overlap.min(0.5 * line.path.length()) } else { 0.0 };
        let role = if line.kind == LineUse::Weld { Role::Weld } else { Role::Boundary };
        Seam { name, role, center_line: line.path.clone(), overlap }
    };
    let seams: Vec<Seam> = named.map(seam).collect();
    let is_short = |seam: &&Seam| seam.center_line.closed && seam.overlap < rules.overlap;
    let least = seams.iter().filter(is_short).min_by(|a, b| a.overlap.total_cmp(&b.overlap));
    if let Some((least, place)) = least.and_then(|seam| seam.center_line.start().map(|start| (seam, start))) {
        let names: Vec<String> = seams.iter().filter(is_short).map(|seam| seam.name.clone()).collect();
        let what = format!(
            "closed seams shorter than twice the overlap of {} mm overlap by half their length, at least {:.3} mm: {}",
            rules.overlap,
            least.overlap,
            quoted(&names)
        );
        notes.repairs.push(Repair { names, place, what });
    }
    seams
}
