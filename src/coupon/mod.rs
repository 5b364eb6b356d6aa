//! Coupons: small pieces that tell, on the user's own machine and fabric, what to write into a spec.
//!
//! A **strip** is a straight seal across which legs are pulled apart (T-peel); a **pouch** is a closed seam with a mouth
//! for a hose: a **disc** (inflated width and thickness), a **V** (two arms and one hinge, the bench test for lambda), and
//! **burst** discs at the corners and in the middle of the bed. Two bench tests are reduced: the **calibration** reads the
//! filled-in table of a peel test, the **cone** test tells the radial force. Both read their **table** with one reader.

mod calibration;
pub mod cone;
mod reach;
mod shapes;
mod strips;
mod table;

use crate::coupon::reach::beyond;
use crate::coupon::strips::program_name;
use crate::design::{Drawing, Layer, Origin, Refusals, Shape, Side, lettered};
use crate::emit;
use crate::geom::{Bounds, Isometry, Path, Point, Segment};
use crate::plan::{Height, Program, Purpose, Ramp, Scope, SeamReport, Step, refusals, seal_pieces};
use crate::spec::{Machine, Spec};
use crate::units::Length;

pub use calibration::{Calibration, CalibrationFault, Row, calibrate, listing, read_rows, settings, steady};
pub use shapes::{disc, vee};
pub use strips::{Grid, Strip, overview, table};
pub use table::{Column, read_table};

/// One program of a coupon set, as text, with a drawing of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupon {
    /// File name without its ending.
    pub name: String,
    /// The program.
    pub gcode: String,
    /// Its seams in the sheet's frame, and their numbers.
    pub svg: String,
}

/// One seam of a coupon.
#[derive(Clone, Debug)]
struct Piece {
    number: usize,
    /// What the iron travels in contact.
    path: Path,
    /// Height of the tip in contact.
    height: Length,
    /// Lower left corner of the number on the drawing, if it has one.
    label: Option<Point>,
}

/// Flat diameter of the disc between its bands, mm.
pub const DISC: f64 = 100.0;
/// Height of a number, mm.
const LABEL: f64 = 5.0;

/// Everything of a coupon set but the table.
///
/// # Errors
/// If the machine cannot go at one of the speeds, or does not reach a seam.
pub fn coupons(spec: &Spec, machine: &Machine, grid: &Grid) -> Result<Vec<Coupon>, Refusals> {
    let mut out = Vec::new();
    let strips = grid.strips(machine);
    let (contact, band) = (machine.process.heights.contact, spec.seal.band.0);
    for (temperature, speed) in grid.settings() {
        let mut spec = spec.clone();
        spec.seal.temperature = temperature;
        spec.seal.speed = speed;
        let mine = strips.iter().filter(|s| s.temperature == temperature && s.speed == speed);
        let piece = |strip: &Strip| Piece {
            number: strip.number,
            path: strip.seam(),
            height: strip.height,
            label: Some(strip.label(band)),
        };
        let seams: Vec<Piece> = mine.map(piece).collect();
        out.push(coupon(&spec, machine, &program_name(temperature, speed), &seams)?);
    }
    let edge = machine.process.ramp.0.max(10.0);
    let place = |number: usize, path: Path, x: f64, y: f64| {
        let motion = Isometry::translation(Point::new(x + edge, y + edge) - path.bounds().min);
        let path = motion.path(&path);
        let label = Some(path.bounds().min.lerp(path.bounds().max, 0.4));
        Piece { number, path, height: contact, label }
    };
    out.push(coupon(spec, machine, "disc", &[place(1, disc(DISC, band), 0.0, 0.0)])?);
    if let Some(star) = spec.stars.first() {
        // There is one of it, and a number might fall onto its band.
        let seam = Piece { label: None, ..place(1, vee(star, band), 0.0, 0.0) };
        out.push(coupon(spec, machine, "v-actuator", &[seam])?);
    }
    let (x, y) = machine.bench.work_area.map_or((300.0, 300.0), |(x, y)| (x.0, y.0));
    let small = disc(40.0, band);
    let (w, h) = (small.bounds().width() + 2.0 * edge, small.bounds().height() + 2.0 * edge);
    let (right, top) = ((x - w).max(w), (y - h).max(h));
    let mut places = vec![(0.0, 0.0), (right, 0.0), (right, top), (0.0, top)];
    // On a small bed the corners leave no room in the middle.
    if right >= 2.0 * w || top >= 2.0 * h {
        places.push((0.5 * right, 0.5 * top));
    }
    let burst: Vec<Piece> = (1..).zip(places).map(|(i, (x, y))| place(i, small.clone(), x, y)).collect();
    out.push(coupon(spec, machine, "burst", &burst)?);
    Ok(out)
}

/// The program and the drawing of these seams.
fn coupon(spec: &Spec, machine: &Machine, name: &str, seams: &[Piece]) -> Result<Coupon, Refusals> {
    let mut steps = vec![Step::Height(Height::Park), Step::Heat(spec.seal.temperature)];
    let mut reports = Vec::new();
    let travel = machine.process.heights.travel.0;
    for Piece { number, path, height, .. } in seams {
        let (down, up) = leads(path, machine.process.ramp.0);
        let Some(start) = down.start() else { continue };
        let ramp = |path: &Path, from, to| Ramp { pieces: seal_pieces(spec, machine, path), from, to };
        let (down, up) = (ramp(&down, travel, height.0), ramp(&up, height.0, travel));
        let time = (down.length() + path.length() + up.length()) / spec.seal.speed.0;
        steps.extend([
            Step::Travel(start),
            Step::Height(Height::Travel),
            Step::Seam(reports.len()),
            Step::TouchDown(down),
            Step::Seal(seal_pieces(spec, machine, path)),
            Step::Lift(up),
        ]);
        reports.push(SeamReport {
            star: *number,
            side: Side::Outside,
            length: path.length(),
            overlap: 0.0,
            time,
        });
    }
    steps.push(Step::Height(Height::Park));
    steps.push(Step::Travel(Point::ORIGIN));
    let stars = seams.iter().map(|piece| piece.number).collect();
    let scope = Scope { purpose: Purpose::Seal, sheet: 1, stars };
    let program = Program::new(spec, machine, scope, steps, reports);
    let mut found = refusals(spec, machine, std::slice::from_ref(&program), &[]);
    found.extend(beyond(machine, name, &program));
    found.or(())?;
    let gcode = emit::gcode(spec, machine, &program);
    let svg = drawing(name, spec, seams);
    Ok(Coupon { name: name.to_owned(), gcode, svg })
}

/// The seams and their numbers at 1:1.
fn drawing(name: &str, spec: &Spec, seams: &[Piece]) -> String {
    let label = |piece: &Piece| Shape::figure(lettered(&piece.number.to_string(), piece.label?, LABEL));
    let labels: Vec<Shape> = seams.iter().filter_map(label).collect();
    let bounds = seams.iter().map(|piece| piece.path.bounds()).chain(labels.iter().map(Shape::bounds));
    let bounds = bounds.fold(Bounds::EMPTY, Bounds::union);
    let seals = seams.iter().map(|piece| Shape::Path(piece.path.clone())).collect();
    let layers = vec![(Layer::SealOuter, seals), (Layer::Label, labels)];
    let (width, height) = (bounds.max.x + 10.0, bounds.max.y + 10.0);
    let drawing = Drawing { origin: Origin::LowerLeft, width, height, layers };
    emit::svg(&format!("coupon {name}"), &drawing, spec.accuracy.path, spec.cut.colours)
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
