//! The star: half a sector of it between a reentrant corner's plane of symmetry and a tip's.

use crate::shell::assembly::{Sheet, Supports};
use crate::shell::cases::actuator::Fineness;
use crate::shell::cases::extremes::{self, Extremes};
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::margin::Margin;
use crate::shell::cases::objects::{Hysteresis, MOST_OBJECTS, Objects, hysteresis, press};
use crate::shell::cases::refinement::{Evidence, Family, Watch};
use crate::shell::cases::sector::ModelledSector;
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
use crate::shell::contact::Contact;
use crate::shell::mesh::{HalfSector, Mesh, Meshed, Sizes};
use crate::shell::solver::{Equilibrium, Solver};

/// A flat star, SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatStar {
    /// The star's tube; the warp's angle is that to the ray of its first corner.
    pub tube: Tube,
    /// Number of points n.
    pub points: u32,
    /// Inner radius rho_0, m.
    pub inner_radius: f64,
    /// Angle phi_i0 of its tips.
    pub tip_angle: f64,
    /// Inner radius R_i of its tips, m.
    pub tip_radius: f64,
    /// Inner radius R_e of its reentrant corners, m.
    pub corner_radius: f64,
    /// Width of the band that seals its rims, m: over so long a piece of rim the pull on the seal is the
    /// mean.
    pub band: f64,
    /// What of the sealed margin is modelled beyond its rims.
    pub margin: Margin,
}

/// A star under pressure; values per star count both sheets and all sectors.
#[derive(Clone, Debug, PartialEq)]
pub struct InflatedStar {
    /// From the axis to the apex of a corner's inner rim, m.
    pub final_radius: Value,
    /// From the axis to the cut edge in front of that apex, m: the apex itself without a margin.
    pub edge_radius: Value,
    /// Twice the angle between a tip's plane and the line of its arm, rad.
    pub tip_angle: Value,
    /// Volume, m^3.
    pub volume: Value,
    /// Force with which the two arms of a tip press on each other, N; 0 where they do not touch.
    pub preload: Value,
    /// Flat area of an arm's sheet that touches the next arm, m^2.
    pub contact_area: Value,
    /// Sum of the radial forces on all corners by their radial displacement, N/m, where each corner's section moves as a whole.
    pub radial_stiffness: Value,
    /// Each requested object, by its radius or its opening, m, and the sum of the radial forces on it, N.
    pub forces: Vec<(f64, Value)>,
    /// For each of them how far the corners slide along the object for each unit by which its radius grows, the mean by force: friction mu
    /// changes the force by at most mu times that part of it, to first order.
    pub slips: Vec<Value>,
    /// The largest object before and after the star was opened further, m and N; `None` where it does not press on it. It is of the finest mesh
    /// where that is small or the middle one shows a snap, else of the middle one.
    pub hysteresis: Option<Hysteresis>,
    /// The hardest loaded places; on the finest mesh.
    pub extremes: Extremes,
    /// The modelled sheet at rest.
    pub shape: InflatedShape,
    /// The evidence for these values.
    pub evidence: Evidence,
}

/// Numbers that each mesh gives, by the scales of the shell: those of one sheet of half a sector.
struct StarNumbers<T> {
    final_radius: T,
    edge_radius: T,
    tip_angle: T,
    volume: T,
    preload: T,
    contact_area: T,
    stiffness: T,
    seal_tension: T,
    stretch: T,
    seal_pull: T,
    forces: [T; MOST_OBJECTS],
    slips: [T; MOST_OBJECTS],
}

/// Most unknowns of a mesh on which every star is opened further to look for a snap: the middle one of medium fineness, at a fifth of the cost
/// of the finest. A finer mesh is opened further only where the one before it shows a snap.
const MOST_OPENED: usize = 25_000;

/// Number of fields of [`StarNumbers`] that do not depend on an object.
const SINGLE: usize = 10;
const NUMBERS: usize = SINGLE + 2 * MOST_OBJECTS;

impl<T: Copy> From<StarNumbers<T>> for [T; NUMBERS] {
    fn from(numbers: StarNumbers<T>) -> Self {
        let single = [
            numbers.final_radius,
            numbers.edge_radius,
            numbers.tip_angle,
            numbers.volume,
            numbers.preload,
            numbers.contact_area,
            numbers.stiffness,
            numbers.seal_tension,
            numbers.stretch,
            numbers.seal_pull,
        ];
        std::array::from_fn(|index| match index.checked_sub(SINGLE) {
            None => single[index],
            Some(object) if object < MOST_OBJECTS => numbers.forces[object],
            Some(object) => numbers.slips[object - MOST_OBJECTS],
        })
    }
}

impl<T: Copy> From<[T; NUMBERS]> for StarNumbers<T> {
    fn from(numbers: [T; NUMBERS]) -> Self {
        let [
            final_radius,
            edge_radius,
            tip_angle,
            volume,
            preload,
            contact_area,
            stiffness,
            seal_tension,
            stretch,
            seal_pull,
            ..,
        ] = numbers;
        Self {
            final_radius,
            edge_radius,
            tip_angle,
            volume,
            preload,
            contact_area,
            stiffness,
            seal_tension,
            stretch,
            seal_pull,
            forces: std::array::from_fn(|object| numbers[SINGLE + object]),
            slips: std::array::from_fn(|object| numbers[SINGLE + MOST_OBJECTS + object]),
        }
    }
}

impl StarNumbers<Value> {
    /// The hardest loaded places of a star of `tube`, which are at `places` by W.
    fn extremes(&self, tube: &Tube, places: [[f64; 2]; 3]) -> Extremes {
        let stretch = tube.fabric.stretch;
        let [seal_at, stretch_at, pull_at] = places.map(|place| place.map(|x| x * tube.width));
        Extremes {
            seal_tension: self.seal_tension.scaled(stretch),
            seal_at,
            stretch: self.stretch,
            stretch_at,
            seal_pull: self.seal_pull.scaled(stretch),
            pull_at,
        }
    }
}

impl FlatStar {
    /// A star whose hinges turn on points, without band and margin.
    pub fn sharp(tube: Tube, points: u32, inner_radius: f64, tip_angle: f64) -> Self {
        let (tip_radius, corner_radius, band, margin) = (0.0, 0.0, 0.0, Margin::NONE);
        Self { tube, points, inner_radius, tip_angle, tip_radius, corner_radius, band, margin }
    }

    /// Checks that its tube, fabric and pressure are in the range of shells.
    ///
    /// # Errors
    /// If one of them is not: its range.
    pub fn check(&self) -> Result<(), ShellFault> {
        self.tube.check()
    }

    /// Whether the planes of symmetry through its corners and tips leave its weave as it is, so that half a sector stands for the star.
    pub fn is_symmetric(&self) -> bool {
        let weave = self.tube.fabric.weave;
        let half_angle = std::f64::consts::PI / f64::from(self.points);
        weave.is_mirrored_at(0.0) && weave.is_mirrored_at(half_angle)
    }

    /// About how many unknowns the finest mesh of `fineness` has; 0 where the star has no mesh.
    pub fn unknowns(&self, fineness: Fineness) -> f64 {
        let sizes = Sizes::for_tube(1.0, fineness.cells);
        let meshed = self.modelled().ok().and_then(|modelled| modelled.meshed(&sizes).ok());
        meshed.map_or(0.0, |meshed| fineness.unknowns(&meshed.mesh))
    }

    /// Half a sector, scaled.
    ///
    /// # Errors
    /// As of [`FlatStar::check`].
    pub fn modelled(&self) -> Result<ModelledSector, ShellFault> {
        Ok(ModelledSector { sector: self.sector()?, margin: self.margin.widths(self.tube.width) })
    }

    /// The supports of a mesh of `modelled`; it adds the margin to the sheet.
    pub(super) fn hold(&self, modelled: &ModelledSector) -> impl Fn(&Meshed, &mut Sheet) -> Supports {
        move |meshed, sheet| {
            let mut supports = modelled.supports(&meshed.mesh);
            self.margin.apply(meshed, sheet, &mut supports);
            supports
        }
    }

    pub(super) fn sector(&self) -> Result<HalfSector, ShellFault> {
        self.check()?;
        let w = self.tube.width;
        Ok(HalfSector {
            n: self.points,
            rho_0: self.inner_radius / w,
            w: 1.0,
            phi_i: self.tip_angle,
            r_i: self.tip_radius / w,
            r_e: self.corner_radius / w,
        })
    }
}

/// Inflates a star from flat, then presses it against round objects.
///
/// # Errors
/// If it is out of range or has no stable equilibrium: where it stopped, and why.
pub fn star(
    case: &FlatStar,
    objects: Objects<'_>,
    fineness: Fineness,
    watch: &Watch,
) -> Result<InflatedStar, ShellFault> {
    star_by_sizes(case, objects, (&Sizes::for_tube(1.0, fineness.cells), fineness.cuts), watch)
}

/// As [`star`], on meshes of any grading: the edge lengths of the coarsest one, by W, and how often its triangles are cut into four. Half a
/// sector of a weave without its planes of symmetry models a star that has none: each half sector of it is cut as the first one is, or as
/// its mirror image.
///
/// # Errors
/// As of [`star`].
pub fn star_by_sizes(
    case: &FlatStar,
    objects: Objects<'_>,
    (sizes, cuts): (&Sizes, usize),
    watch: &Watch,
) -> Result<InflatedStar, ShellFault> {
    let modelled = case.modelled()?;
    let count = objects.sizes().len();
    if count > MOST_OBJECTS {
        return Err(ShellFault::TooMany { name: "objects", found: count, most: MOST_OBJECTS });
    }
    let coarsest = modelled.meshed(sizes)?;
    let obstacles = modelled.obstacles();
    let post = obstacles.len() - 1;
    let hold = case.hold(&modelled);
    let family = Family { obstacles: &obstacles, ..Family::new(case.tube, coarsest, cuts, &hold) };
    // Both are those of the last mesh, which is the finest.
    let (mut places, mut shape) = ([[0.0; 2]; 3], InflatedShape::default());
    let mut snap_forces = None::<Hysteresis>;
    let (values, evidence) = family.run(watch, |solver, meshed, equilibrium, beside| {
        let [tension, stretch] = extremes::extremes(&solver.assembly.sheet, meshed, &equilibrium.state);
        let _ = solver.assembly.differentiate(&equilibrium.state, equilibrium.pressure);
        let pull = extremes::pull(&meshed.mesh, solver.assembly.forces(), case.band / case.tube.width);
        places = [tension, stretch, pull].map(|(_, at)| at);
        let [seal_tension, stretch, seal_pull] = [tension, stretch, pull].map(|(number, _)| number);
        let at_rest = measure(&modelled, solver, &meshed.mesh, equilibrium);
        shape = InflatedShape::new(&case.tube, solver, &meshed.mesh, &equilibrium.state);
        // The next mesh begins without the objects.
        let former_contact = solver.contact.clone();
        let [forces, slips] = press(&case.tube, objects, (solver, post), equilibrium, beside)?;
        solver.contact = former_contact;
        let is_opened =
            solver.assembly.unknowns() <= MOST_OPENED || snap_forces.is_some_and(Hysteresis::is_snap);
        let largest = objects.largest(&case.tube, &equilibrium.state);
        if let Some((radius, pressed)) = largest.zip(beside.get(count.wrapping_sub(1))).filter(|_| is_opened)
        {
            snap_forces = hysteresis(&case.tube, solver, post, pressed, radius)?;
        }
        Ok(StarNumbers { seal_tension, stretch, seal_pull, forces, slips, ..at_rest }.into())
    })?;
    let values = StarNumbers::from(values);
    let w = case.tube.width;
    let force = case.tube.fabric.stretch * w;
    let sheets = modelled.count();
    let forces = objects.sizes().iter().zip(&values.forces);
    Ok(InflatedStar {
        final_radius: values.final_radius.scaled(w),
        edge_radius: values.edge_radius.scaled(w),
        tip_angle: values.tip_angle,
        volume: values.volume.scaled(sheets * w.powi(3)),
        preload: values.preload.scaled(2.0 * force),
        contact_area: values.contact_area.scaled(w * w),
        radial_stiffness: values.stiffness.scaled(sheets * force / w),
        forces: forces.map(|(size, value)| (*size, value.scaled(sheets * force))).collect(),
        slips: values.slips[..count].to_vec(),
        hysteresis: snap_forces.map(|forces: Hysteresis| forces.scaled(w, sheets * force)),
        extremes: values.extremes(&case.tube, places),
        shape,
        evidence,
    })
}

/// The numbers of the star at rest; those of its hardest loaded places and of objects are 0.
fn measure(
    modelled: &ModelledSector,
    solver: &mut Solver,
    mesh: &Mesh,
    equilibrium: &Equilibrium,
) -> StarNumbers<f64> {
    let [final_radius, edge_radius] = modelled.corner_radii(mesh, &equilibrium.state);
    let tip = |contact: &Contact| {
        let tip = ModelledSector::TIP;
        [contact.force(tip), contact.patch(tip)]
    };
    let [preload, contact_area] = solver.contact.as_ref().map_or([0.0; 2], tip);
    StarNumbers {
        final_radius,
        edge_radius,
        tip_angle: modelled.tip_angle(mesh, &equilibrium.state),
        volume: equilibrium.rest.energy.volume,
        preload,
        contact_area,
        stiffness: 1.0 / solver.compliance(&modelled.section(mesh)),
        seal_tension: 0.0,
        stretch: 0.0,
        seal_pull: 0.0,
        forces: [0.0; MOST_OBJECTS],
        slips: [0.0; MOST_OBJECTS],
    }
}
