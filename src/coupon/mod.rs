//! Coupons: small test pieces; their results on the user's own machine and fabric become values of a spec.
//!
//! A **strip** is a straight seal across which legs are pulled apart (T-peel); a **pouch** is a closed seam with a mouth for a hose: a
//! **disc** (inflated width and thickness), a **V** (two arms and one hinge, the bench test for lambda), and **burst** discs at the corners
//! and in the middle of the bed. Two bench tests are reduced: the **calibration** reads the filled-in table of a peel test, the **bias
//! strip** gives the shear modulus. Both use one reader of **tables**.

pub mod bias;
mod calibration;
mod peel_rows;
mod press_cards;
mod shapes;
mod strips;
mod table;

use crate::coupon::strips::program_name;
use crate::emit;
use design::{Drawing, Layer, Origin, Refusals, SealJob, Shape, lettered};
use geom::{Bounds, Isometry, Path, Point, Vec2};
use program::plan::{Program, Purpose, Scope, refusal_beyond, refusals, seal_program};
use sealed::{LaidSeam, PieceName, PlacedPiece, SealedShape, Seam, laid_seams};
use spec::{Machine, Spec};

pub use calibration::{Calibration, calibrate, listing, settings, steady};
pub use peel_rows::{PeelRow, ToolPace, read_laser_rows, read_press_rows, read_rows};
pub use press_cards::{PressGrid, press_drawings, press_table};
pub use shapes::{disc, hose, vee};
pub use strips::{StripGrid, StripHeat, TEMPERATURES, TestStrip, overview, table};
pub use table::{TableColumn, read_table};

/// A kind of coupons, which can be made on its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CouponGroup {
    /// Seal strips for the T-peel test.
    Strips,
    /// A disc.
    Disc,
    /// A V-actuator.
    VActuator,
    /// Discs to burst.
    Burst,
}

impl CouponGroup {
    /// Every group, by its name.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("strips", Self::Strips),
        ("disc", Self::Disc),
        ("v-actuator", Self::VActuator),
        ("burst", Self::Burst),
    ];
}

/// One program of a coupon set, with the spec and the machine that it is checked against.
#[derive(Clone, Debug)]
pub struct Coupon {
    /// File name without its ending.
    pub name: String,
    /// The spec with the coupon's own temperature or power, and speed.
    pub spec: Spec,
    /// The machine with the coupon's own height in contact.
    pub machine: Machine,
    /// Pieces in the sheet's frame, in the order of sealing.
    pub pieces: Vec<CouponPiece>,
    /// The program.
    pub program: Program,
    /// Seams, cuts and numbers in the sheet's frame, as SVG.
    pub svg: String,
}

/// One piece of a coupon, with its place.
#[derive(Clone, Debug)]
pub struct CouponPiece {
    /// Name of the piece: "strip-7", or that of the coupon if it is the only piece.
    pub name: PieceName,
    /// Seams and cuts; a strip has no cut, its specimen is cut out of the middle.
    pub shape: SealedShape,
    /// Number on the drawing, and the number's lower left corner, if it has one.
    label: Option<(usize, Point)>,
}

/// Flat diameter of the disc between its bands, mm.
pub const DISC: f64 = 100.0;
/// Flat diameter of the discs to burst, mm.
const BURST_DISC: f64 = 40.0;
/// Height of a number, mm.
const LABEL: f64 = 5.0;
/// Least distance of a cut from the axes of the machine, mm.
const MARGIN: f64 = 1.0;
/// Assumed size of an unknown bed along X and Y, mm.
const USUAL_BED: f64 = 300.0;

impl Coupon {
    /// The program as text.
    pub fn gcode(&self) -> String {
        emit::gcode(&self.spec, &self.machine, &self.program)
    }

    /// The area of the tool: from the origin to the farthest end of a contact.
    pub fn area(&self) -> Bounds {
        let job = self.job();
        let paths = job.contacts.iter().flat_map(|contact| contact.laid.paths());
        let contact_bounds = paths.map(Path::bounds).fold(Bounds::EMPTY, Bounds::union);
        Bounds { min: Point::ORIGIN, max: contact_bounds.max }
    }

    /// Seams of the coupon in the order of sealing.
    pub fn seams(&self) -> Vec<LaidSeam> {
        laid_seams(&placed(&self.pieces), self.machine.process.ramp.0)
    }

    /// Contacts of the coupon in the order of sealing.
    pub fn job(&self) -> SealJob {
        SealJob::of_pieces(&self.spec, &placed(&self.pieces), self.machine.process.ramp.0)
    }

    /// Whether its pieces are strips, which have no port.
    pub fn is_strips(&self) -> bool {
        self.pieces.iter().all(|piece| piece.shape.ports.is_empty())
    }
}

/// The coupons of `groups`, in order: every program of the set but no table.
///
/// # Errors
/// If the machine cannot move at one of the speeds, or does not reach a seam, or the hose does not fit a pouch.
pub fn coupons(
    spec: &Spec,
    machine: &Machine,
    grid: &StripGrid,
    groups: &[CouponGroup],
) -> Result<Vec<Coupon>, Refusals> {
    let mut coupons = Vec::new();
    if groups.contains(&CouponGroup::Strips) {
        coupons.extend(strip_coupons(spec, machine, grid)?);
    }
    let inlet = hose(spec.inlet.as_ref());
    let flap = 0.5 * spec.seal.band.0 + spec.seal.allowance.0 + MARGIN;
    let edge = machine.process.ramp.0.max(10.0).max(flap);
    if groups.contains(&CouponGroup::Disc) {
        let pouch = disc(DISC, inlet, &spec.seal)?;
        let disc_name = PieceName::Named("disc".to_owned());
        coupons.push(coupon(
            spec,
            machine,
            "disc",
            vec![placed_pouch(disc_name, 1, &pouch, Point::ORIGIN, edge)],
        )?);
    }
    if let Some(star) = spec.stars.first().filter(|_| groups.contains(&CouponGroup::VActuator)) {
        let pouch = vee(star, inlet, &spec.seal)?;
        // It is the only piece, and a number might lie on its band.
        let name = PieceName::Named("v-actuator".to_owned());
        let piece = CouponPiece { label: None, ..placed_pouch(name, 1, &pouch, Point::ORIGIN, edge) };
        coupons.push(coupon(spec, machine, "v-actuator", vec![piece])?);
    }
    if groups.contains(&CouponGroup::Burst) {
        let pouch = disc(BURST_DISC, inlet, &spec.seal)?;
        let (x, y) = machine.bench.work_area.map_or((USUAL_BED, USUAL_BED), |(x, y)| (x.0, y.0));
        let bounds = pouch.seam_bounds();
        let (w, h) = (bounds.width() + 2.0 * edge, bounds.height() + 2.0 * edge);
        let (right, top) = ((x - w).max(w), (y - h).max(h));
        let mut places = vec![(0.0, 0.0), (right, 0.0), (right, top), (0.0, top)];
        // On a small bed the corners leave no space in the middle.
        if right >= 2.0 * w || top >= 2.0 * h {
            places.push((0.5 * right, 0.5 * top));
        }
        let places = places.into_iter().map(|(x, y)| Point::new(x, y));
        let pieces =
            (1..).zip(places).map(|(i, place)| placed_pouch(named("burst", i), i, &pouch, place, edge));
        coupons.push(coupon(spec, machine, "burst", pieces.collect())?);
    }
    Ok(coupons)
}

/// The strips of `grid`, a program for each setting.
fn strip_coupons(spec: &Spec, machine: &Machine, grid: &StripGrid) -> Result<Vec<Coupon>, Refusals> {
    let coupons = grid.settings().map(|(heat, speed, height)| {
        let (mut spec, mut machine) = (spec.clone(), machine.clone());
        heat.set(&mut spec.seal);
        spec.seal.speed = speed;
        // The profile of the coupon states the height.
        spec.seal.height = None;
        let strips = grid.strips(&machine);
        machine.process.heights.contact = height;
        let is_own = |s: &&TestStrip| s.heat == heat && s.speed == speed && s.height == height;
        let band = spec.seal.band.0;
        let piece = |strip: &TestStrip| {
            let seams = vec![Seam::weld(strip.seam())];
            let shape = SealedShape { seams, band, cut: None, ports: Vec::new(), valves: Vec::new() };
            CouponPiece {
                name: named("strip", strip.number),
                shape,
                label: Some((strip.number, strip.label(band))),
            }
        };
        let pieces: Vec<CouponPiece> = strips.iter().filter(is_own).map(piece).collect();
        let name = program_name(grid, heat, speed, height);
        coupon(&spec, &machine, &name, pieces)
    });
    coupons.collect()
}

/// `pouch` with its lower left corner, flap included, at `place`, and `edge` or more around its seams; its label is its `number`.
fn placed_pouch(name: PieceName, number: usize, pouch: &SealedShape, place: Point, edge: f64) -> CouponPiece {
    let (seam, cut) = (pouch.seam_bounds().min, pouch.cut.as_ref().map_or(Bounds::EMPTY, Path::bounds).min);
    // The cut around a corner reaches farther than the flap is wide.
    let (right, top) = (edge.max(MARGIN + seam.x - cut.x), edge.max(MARGIN + seam.y - cut.y));
    let shape = pouch.moved(Isometry::translation(place + Vec2::new(right, top) - seam));
    let bounds = shape.seam_bounds();
    let label = bounds.min.lerp(bounds.max, 0.4);
    CouponPiece { name, shape, label: Some((number, label)) }
}

/// The name of piece number `number` of `kind`: "strip-7".
fn named(kind: &str, number: usize) -> PieceName {
    PieceName::Named(format!("{kind}-{number}"))
}

/// `pieces` where they lie.
fn placed(pieces: &[CouponPiece]) -> Vec<PlacedPiece<'_>> {
    let pieces = pieces.iter();
    pieces
        .map(|piece| PlacedPiece {
            name: piece.name.clone(),
            shape: &piece.shape,
            placement: Isometry::IDENTITY,
        })
        .collect()
}

/// The coupon `name` of `pieces`.
fn coupon(spec: &Spec, machine: &Machine, name: &str, pieces: Vec<CouponPiece>) -> Result<Coupon, Refusals> {
    let job = SealJob::of_pieces(spec, &placed(&pieces), machine.process.ramp.0);
    let scope = Scope { purpose: Purpose::Seal, sheet: 1, pieces: vec![PieceName::Named(name.to_owned())] };
    let program = seal_program(spec, machine, scope, &job, &[]);
    let mut program_refusals = refusals(spec, machine, std::slice::from_ref(&program), &[]);
    let smaller = match name {
        _ if name.starts_with("strips") => {
            "fewer temperatures, powers, speeds, heights or repeats; try them in several sets"
        }
        "v-actuator" => "a smaller `tube_width` in [star]",
        _ => "a machine that reaches as far",
    };
    program_refusals.extend(refusal_beyond(machine, &format!("the coupon {name}"), &program.steps, smaller));
    program_refusals.or_value(())?;
    let svg = drawing(name, spec, &pieces);
    let (spec, machine) = (spec.clone(), machine.clone());
    Ok(Coupon { name: name.to_owned(), spec, machine, pieces, program, svg })
}

/// The seams, the cuts and the numbers at 1:1.
fn drawing(name: &str, spec: &Spec, pieces: &[CouponPiece]) -> String {
    let label = |piece: &CouponPiece| {
        let (number, label_point) = piece.label?;
        Shape::figure(lettered(&number.to_string(), label_point, LABEL))
    };
    let labels: Vec<Shape> = pieces.iter().filter_map(label).collect();
    let seams = pieces.iter().flat_map(|piece| &piece.shape.seams);
    let seals: Vec<Shape> = seams.map(|seam| Shape::Path(seam.center_line.clone())).collect();
    let cuts: Vec<Shape> =
        pieces.iter().filter_map(|piece| piece.shape.cut.clone()).map(Shape::Path).collect();
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
