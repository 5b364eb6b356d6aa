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
use crate::design::{Drawing, LaidSeam, Layer, Origin, Refusals, Shape, lettered};
use crate::emit;
use crate::geom::{Bounds, Isometry, Path, Point};
use crate::plan::{Program, Purpose, Scope, refusals, seal_program};
use crate::spec::{Machine, Spec};

pub use calibration::{Calibration, CalibrationFault, Row, calibrate, listing, read_rows, settings, steady};
pub use shapes::{Pouch, disc, hose, vee};
pub use strips::{Grid, Strip, overview, table};
pub use table::{Column, read_table};

/// A kind of coupons, which can be made alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Seal strips for the T-peel test.
    Strips,
    /// A disc.
    Disc,
    /// A V-actuator.
    VActuator,
    /// Discs that are burst.
    Burst,
}

impl Group {
    /// Every group, by its name.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("strips", Self::Strips),
        ("disc", Self::Disc),
        ("v-actuator", Self::VActuator),
        ("burst", Self::Burst),
    ];
}

/// One program of a coupon set, with all that it is judged by.
#[derive(Clone, Debug)]
pub struct Coupon {
    /// File name without its ending.
    pub name: String,
    /// The spec with the coupon's own temperature and speed.
    pub spec: Spec,
    /// The machine with the coupon's own height in contact.
    pub machine: Machine,
    /// Its seams, in the order of sealing.
    pub seams: Vec<LaidSeam>,
    /// Flat width of the mouth that a pouch needs for its hose, mm; `None` for strips.
    pub mouth: Option<f64>,
    /// The program.
    pub program: Program,
    /// Its seams, cuts and numbers in the sheet's frame, as SVG.
    pub svg: String,
}

/// One piece of a coupon, where it lies.
#[derive(Clone, Debug)]
struct Piece {
    number: usize,
    /// The iron's way in contact.
    seam: Path,
    /// The cut around it; `None` for a strip, whose specimen is cut out of the middle.
    cut: Option<Path>,
    /// Lower left corner of the number on the drawing, if it has one.
    label: Option<Point>,
}

/// Flat diameter of the disc between its bands, mm.
pub const DISC: f64 = 100.0;
/// Flat diameter of the discs that are burst, mm.
const BURST_DISC: f64 = 40.0;
/// Height of a number, mm.
const LABEL: f64 = 5.0;
/// A bed of unknown size is taken to be so large along X and Y, mm.
const USUAL_BED: f64 = 300.0;

impl Coupon {
    /// The program as text.
    pub fn gcode(&self) -> String {
        emit::gcode(&self.spec, &self.machine, &self.program)
    }

    /// Where the iron may go: from the origin to the farthest end of a seam.
    pub fn area(&self) -> Bounds {
        let paths = self.seams.iter().flat_map(|seam| [&seam.lead_in, &seam.run, &seam.lead_out]);
        let reached = paths.map(Path::bounds).fold(Bounds::EMPTY, Bounds::union);
        Bounds { min: Point::ORIGIN, max: reached.max }
    }
}

/// The coupons of `groups`, in order: every program of the set but no table.
///
/// # Errors
/// If the machine cannot go at one of the speeds, or does not reach a seam, or the hose does not fit a pouch.
pub fn coupons(
    spec: &Spec,
    machine: &Machine,
    grid: &Grid,
    groups: &[Group],
) -> Result<Vec<Coupon>, Refusals> {
    let mut out = Vec::new();
    let has = |group: Group| groups.contains(&group);
    if has(Group::Strips) {
        for (temperature, speed, height) in grid.settings() {
            let (mut spec, mut machine) = (spec.clone(), machine.clone());
            (spec.seal.temperature, spec.seal.speed) = (temperature, speed);
            let strips = grid.strips(&machine);
            machine.process.heights.contact = height;
            let is_own = |s: &&Strip| s.temperature == temperature && s.speed == speed && s.height == height;
            let piece = |strip: &Strip| Piece {
                number: strip.number,
                seam: strip.seam(),
                cut: None,
                label: Some(strip.label(spec.seal.band.0)),
            };
            let pieces: Vec<Piece> = strips.iter().filter(is_own).map(piece).collect();
            let name = program_name(grid, temperature, speed, height);
            out.push(coupon(&spec, &machine, &name, "strip", None, &pieces)?);
        }
    }
    let hose = hose(spec.inlet.as_ref());
    let flap = 0.5 * spec.seal.band.0 + spec.seal.allowance.0 + 1.0;
    let edge = machine.process.ramp.0.max(10.0).max(flap);
    let place = |number: usize, pouch: &Pouch, x: f64, y: f64| {
        let motion = Isometry::translation(Point::new(x + edge, y + edge) - pouch.seam.bounds().min);
        let seam = motion.path(&pouch.seam);
        let label = Some(seam.bounds().min.lerp(seam.bounds().max, 0.4));
        Piece { number, seam, cut: Some(motion.path(&pouch.cut)), label }
    };
    if has(Group::Disc) {
        let pouch = disc(DISC, hose, &spec.seal)?;
        out.push(coupon(spec, machine, "disc", "disc", Some(pouch.mouth), &[place(1, &pouch, 0.0, 0.0)])?);
    }
    if let Some(star) = spec.stars.first().filter(|_| has(Group::VActuator)) {
        let pouch = vee(star, hose, &spec.seal)?;
        // There is one of it, and a number might fall onto its band.
        let piece = Piece { label: None, ..place(1, &pouch, 0.0, 0.0) };
        out.push(coupon(spec, machine, "v-actuator", "v-actuator", Some(pouch.mouth), &[piece])?);
    }
    if has(Group::Burst) {
        let pouch = disc(BURST_DISC, hose, &spec.seal)?;
        let (x, y) = machine.bench.work_area.map_or((USUAL_BED, USUAL_BED), |(x, y)| (x.0, y.0));
        let bounds = pouch.seam.bounds();
        let (w, h) = (bounds.width() + 2.0 * edge, bounds.height() + 2.0 * edge);
        let (right, top) = ((x - w).max(w), (y - h).max(h));
        let mut places = vec![(0.0, 0.0), (right, 0.0), (right, top), (0.0, top)];
        // On a small bed the corners leave no room in the middle.
        if right >= 2.0 * w || top >= 2.0 * h {
            places.push((0.5 * right, 0.5 * top));
        }
        let pieces: Vec<Piece> = (1..).zip(places).map(|(i, (x, y))| place(i, &pouch, x, y)).collect();
        out.push(coupon(spec, machine, "burst", "burst", Some(pouch.mouth), &pieces)?);
    }
    Ok(out)
}

/// The coupon `name` of `pieces`, each called `kind` and its number.
fn coupon(
    spec: &Spec,
    machine: &Machine,
    name: &str,
    kind: &str,
    mouth: Option<f64>,
    pieces: &[Piece],
) -> Result<Coupon, Refusals> {
    let seam = |piece: &Piece| {
        let own = if pieces.len() == 1 && kind == name {
            name.to_owned()
        } else {
            format!("{kind}-{}", piece.number)
        };
        LaidSeam::open(own, piece.seam.clone(), machine.process.ramp.0)
    };
    let seams: Vec<LaidSeam> = pieces.iter().map(seam).collect();
    let scope = Scope { purpose: Purpose::Seal, sheet: 1, stars: Vec::new(), piece: Some(name.to_owned()) };
    let program = seal_program(spec, machine, scope, &seams);
    let mut found = refusals(spec, machine, std::slice::from_ref(&program), &[]);
    found.extend(beyond(machine, name, &program));
    found.or(())?;
    let svg = drawing(name, spec, pieces);
    let (spec, machine) = (spec.clone(), machine.clone());
    Ok(Coupon { name: name.to_owned(), spec, machine, seams, mouth, program, svg })
}

/// The seams, the cuts and the numbers at 1:1.
fn drawing(name: &str, spec: &Spec, pieces: &[Piece]) -> String {
    let label = |piece: &Piece| Shape::figure(lettered(&piece.number.to_string(), piece.label?, LABEL));
    let labels: Vec<Shape> = pieces.iter().filter_map(label).collect();
    let seals: Vec<Shape> = pieces.iter().map(|piece| Shape::Path(piece.seam.clone())).collect();
    let cuts: Vec<Shape> = pieces.iter().filter_map(|piece| piece.cut.clone()).map(Shape::Path).collect();
    let bounds =
        seals.iter().chain(&cuts).chain(&labels).map(Shape::bounds).fold(Bounds::EMPTY, Bounds::union);
    let layers = [(Layer::SealOuter, seals), (Layer::CutOutside, cuts), (Layer::Label, labels)];
    let layers = layers
        .into_iter()
        .filter(|(layer, shapes)| *layer != Layer::CutOutside || !shapes.is_empty())
        .collect();
    let (width, height) = (bounds.max.x + 10.0, bounds.max.y + 10.0);
    let drawing = Drawing { origin: Origin::LowerLeft, width, height, layers };
    emit::svg(&format!("coupon {name}"), &drawing, spec.accuracy.path, spec.cut.colours)
}
