//! Coupons: small pieces that tell, on the user's own machine and fabric, what to write into a spec.
//!
//! A **strip** is a straight seal across which legs are pulled apart (T-peel); a **pouch** is a closed seam with a mouth
//! for a hose: a **disc** (inflated width and thickness), a **V** (two arms and one hinge, the bench test for lambda), and
//! **burst** discs at five places of the bed. The **calibration** reads the filled-in table.

mod calibration;
mod shapes;
mod strips;

use crate::design::Drawing;
use crate::design::Layer;
use crate::design::Origin;
use crate::design::Refusal;
use crate::design::Shape;
use crate::design::Side;
use crate::emit;
use crate::emit::Facts;
use crate::geom::Isometry;
use crate::geom::Path;
use crate::geom::Point;
use crate::geom::Segment;
use crate::plan::Level;
use crate::plan::Pace;
use crate::plan::Program;
use crate::plan::Purpose;
use crate::plan::Ramp;
use crate::plan::SeamReport;
use crate::plan::Step;
use crate::plan::program_time;
use crate::plan::refusals;
use crate::plan::seal_pieces;
use crate::spec::Machine;
use crate::spec::Spec;

pub use calibration::{Calibration, CalibrationFault, Row, calibrate, read_rows};
pub use shapes::{disc, vee};
pub use strips::{Grid, Strip, table};

/// One program of a coupon set, as text, with a drawing of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupon {
    /// File name without its ending.
    pub name: String,
    /// The program.
    pub gcode: String,
    /// Its seams in the sheet's frame.
    pub svg: String,
}

/// Everything of a coupon set but the table.
///
/// # Errors
/// If the machine cannot go at one of the speeds.
pub fn coupons(spec: &Spec, machine: &Machine, grid: &Grid) -> Result<Vec<Coupon>, Vec<Refusal>> {
    let mut out = Vec::new();
    let strips = grid.strips();
    for (temperature, speed) in grid.settings() {
        let mut spec = spec.clone();
        spec.seal.temperature = temperature;
        spec.seal.speed = speed;
        let mine = strips.iter().filter(|s| s.temperature == temperature && s.speed == speed);
        let seams: Vec<_> = mine.map(|strip| (strip.number, strip.seam(), strip.height)).collect();
        let name = format!("strips-{}C-{}um-s", temperature.0.round(), (speed.0 * 1e3).round());
        out.push(coupon(&spec, machine, &name, &seams)?);
    }
    let contact = machine.heights.contact;
    let band = spec.seal.band.0;
    let place = |path: Path, x: f64, y: f64| {
        let corner = path.bounds().min;
        Isometry::translation(Point::new(x + 10.0, y + 10.0) - corner).path(&path)
    };
    out.push(coupon(spec, machine, "disc", &[(1, place(disc(100.0, band), 0.0, 0.0), contact)])?);
    if let Some(star) = spec.stars.first() {
        let seam = place(vee(star, band), 0.0, 0.0);
        out.push(coupon(spec, machine, "v-actuator", &[(1, seam, contact)])?);
    }
    let (x, y) = machine.work_area.map_or((300.0, 300.0), |(x, y)| (x.0, y.0));
    let small = disc(40.0, band);
    let (w, h) = (small.bounds().width() + 20.0, small.bounds().height() + 20.0);
    let (right, top) = ((x - w).max(w), (y - h).max(h));
    let corners = [(0.0, 0.0), (right, 0.0), (right, top), (0.0, top), (0.5 * right, 0.5 * top)];
    let burst: Vec<_> =
        (1..).zip(corners).map(|(i, (x, y))| (i, place(small.clone(), x, y), contact)).collect();
    out.push(coupon(spec, machine, "burst", &burst)?);
    Ok(out)
}

/// The program and the drawing of these seams: number, path in contact, height in contact.
fn coupon(
    spec: &Spec,
    machine: &Machine,
    name: &str,
    seams: &[(usize, Path, crate::units::Length)],
) -> Result<Coupon, Vec<Refusal>> {
    let mut steps = vec![Step::Height(Level::Park), Step::Heat(spec.seal.temperature)];
    let mut reports = Vec::new();
    let travel = machine.heights.travel.0;
    for (star, path, height) in seams {
        let (down, up) = leads(path, machine.ramp.0);
        let Some(start) = down.start() else { continue };
        let ramp = |path: &Path, from, to| Ramp { pieces: seal_pieces(spec, machine, path), from, to };
        let (down, up) = (ramp(&down, travel, height.0), ramp(&up, height.0, travel));
        let time = (down.length() + path.length() + up.length()) / spec.seal.speed.0;
        steps.extend([
            Step::Travel(start),
            Step::Height(Level::Travel),
            Step::Seam(reports.len()),
            Step::TouchDown(down),
            Step::Seal(seal_pieces(spec, machine, path)),
            Step::Lift(up),
        ]);
        reports.push(SeamReport {
            star: *star,
            side: Side::Outside,
            length: path.length(),
            overlap: 0.0,
            time,
        });
    }
    steps.push(Step::Height(Level::Park));
    steps.push(Step::Travel(Point::ORIGIN));
    let pace = Pace::new(spec, machine);
    let stars = seams.iter().map(|(star, _, _)| *star).collect();
    let mut program =
        Program { purpose: Purpose::Seal, sheet: 1, stars, steps, seams: reports, pace, time: 0.0 };
    program.time = program_time(machine, &program, spec.seal.speed.0);
    let found = refusals(spec, machine, std::slice::from_ref(&program), &[]);
    if !found.is_empty() {
        return Err(found);
    }
    let facts = Facts { name: &spec.name, seal: &spec.seal, path: spec.accuracy.path, machine };
    let mut gcode = String::new();
    // A String takes everything.
    let _ = emit::write_gcode(&mut gcode, facts, &program);
    let bounds = seams
        .iter()
        .map(|(_, path, _)| path.bounds())
        .fold(crate::geom::Bounds::EMPTY, crate::geom::Bounds::union);
    let shapes = seams.iter().map(|(_, path, _)| Shape::Path(path.clone())).collect();
    let (width, height) = (bounds.max.x + 10.0, bounds.max.y + 10.0);
    let drawing =
        Drawing { origin: Origin::LowerLeft, width, height, layers: vec![(Layer::SealOuter, shapes)] };
    let svg = emit::svg(&format!("coupon {name}"), &drawing, spec.accuracy.path);
    Ok(Coupon { name: name.to_owned(), gcode, svg })
}

/// Straight ways down and up before and after an open path.
fn leads(path: &Path, length: f64) -> (Path, Path) {
    let line = |from: Point, to: Point| -> Path {
        let segment: Segment = crate::geom::Line::new(from, to).into();
        Path::open(vec![segment])
    };
    let ends = path.start().zip(path.end()).zip(path.tangent_at(0.0).zip(path.tangent_at(path.length())));
    ends.map_or_else(Default::default, |((start, end), (first, last))| {
        (line(start - first * length, start), line(end, end + last * length))
    })
}
