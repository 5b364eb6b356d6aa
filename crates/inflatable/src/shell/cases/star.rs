//! The star: half a sector of it between a reentrant corner's plane of symmetry and a tip's, or all of it where the weave has other
//! directions of symmetry.

use crate::shell::assembly::{Sheet, Supports};
use crate::shell::cases::actuator::Fineness;
use crate::shell::cases::extremes::{self, Extremes};
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::margin::Margin;
use crate::shell::cases::objects::{MOST_OBJECTS, Objects, OpeningStep, is_followed, opening_curve, press};
use crate::shell::cases::refinement::{Evidence, Family, Watch};
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::star_part::{ModelledPart, StarPart};
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
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
    /// From the axis to the apex of a corner's inner rim, m; of a whole star the mean of all corners, from the point in their middle.
    pub final_radius: Value,
    /// From the axis to the cut edge in front of that apex, m: the apex itself without a margin.
    pub edge_radius: Value,
    /// The least and the largest of all corners, m.
    pub corner_radii: [Value; 2],
    /// Distance of the point in the middle of the corners from that of the tips, m.
    pub off_center: Value,
    /// Twice the angle between a tip's plane and the line of its arm, rad; of a whole star the mean of all tips.
    pub tip_angle: Value,
    /// The least angle of a tip. Arms of a whole star pass through each other where it is below 0.
    pub least_tip_angle: Value,
    /// Volume, m^3.
    pub volume: Value,
    /// Force with which the two arms of a tip press on each other, N; 0 where they do not touch, and of a whole star.
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
    /// The force on a growing object in small steps (radius m, force N) to somewhat more than the largest requested one, on a coarse mesh:
    /// where it falls, the rims of the corners snap inwards.
    pub opening: Vec<OpeningStep>,
    /// The hardest loaded places; on the finest mesh.
    pub extremes: Extremes,
    /// The modelled sheet at rest.
    pub shape: InflatedShape,
    /// The evidence for these values.
    pub evidence: Evidence,
}

/// Numbers that each mesh gives of the whole star, and with those of its hardest loaded places.
pub(super) const WHOLE: usize = 11;
const NUMBERS: usize = WHOLE + 3;
/// The tip's plane of symmetry among the obstacles.
const TIP: usize = 1;

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

    /// The smallest part of it that is valid for its weave.
    pub fn part(&self) -> StarPart {
        let weave = self.tube.fabric.weave;
        let half_angle = std::f64::consts::PI / f64::from(self.points);
        if weave.is_mirrored_at(0.0) && weave.is_mirrored_at(half_angle) {
            StarPart::HalfSector
        } else {
            StarPart::Whole
        }
    }

    /// The `part` of the star, scaled.
    pub(super) fn modelled(&self, part: StarPart) -> Result<ModelledPart, ShellFault> {
        Ok(ModelledPart { part, sector: self.sector()?, margin: self.margin.widths(self.tube.width) })
    }

    /// The supports of a mesh of `modelled`; it adds the margin to the sheet.
    pub(super) fn hold(&self, modelled: &ModelledPart) -> impl Fn(&Meshed, &mut Sheet) -> Supports {
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
    star_by_sizes((case, case.part()), objects, (&Sizes::across(1.0, fineness.cells), fineness.cuts), watch)
}

/// As [`star`], of any part of it and on meshes of any grading: the edge lengths of the coarsest one, by W, and how often its triangles are
/// cut into four. Half a sector of a weave without its planes of symmetry models a star that has none: each half sector of it is cut as
/// the first one is, or as its mirror image.
///
/// # Errors
/// As of [`star`].
pub fn star_by_sizes(
    (case, part): (&FlatStar, StarPart),
    objects: Objects<'_>,
    (sizes, cuts): (&Sizes, usize),
    watch: &Watch,
) -> Result<InflatedStar, ShellFault> {
    let modelled = case.modelled(part)?;
    let count = objects.sizes().len();
    if count > MOST_OBJECTS {
        return Err(ShellFault::TooMany { name: "objects", found: count, most: MOST_OBJECTS });
    }
    let coarsest = modelled.meshed(sizes)?;
    let obstacles = modelled.obstacles();
    let post = obstacles.len() - 1;
    let hold = case.hold(&modelled);
    let family = Family { tube: case.tube, coarsest, cuts, hold: &hold, obstacles: &obstacles };
    let (mut places, mut shape) = ([[0.0; 2]; 3], InflatedShape::default());
    let mut opening = Vec::new();
    let (values, evidence) = family.run(watch, |solver, meshed, equilibrium, beside| {
        let mut numbers = [0.0; NUMBERS + 2 * MOST_OBJECTS];
        let [tension, stretch] = extremes::extremes(&solver.assembly.sheet, meshed, &equilibrium.state);
        let _ = solver.assembly.differentiate(&equilibrium.state, equilibrium.pressure);
        let pull = extremes::pull(&meshed.mesh, solver.assembly.forces(), case.band / case.tube.width);
        let (whole, middle) = measure(&modelled, solver, &meshed.mesh, equilibrium);
        numbers[..WHOLE].copy_from_slice(&whole);
        let worst = [tension, stretch, pull];
        numbers[WHOLE..NUMBERS].copy_from_slice(&worst.map(|(number, _)| number));
        places = worst.map(|(_, at)| at);
        shape = InflatedShape::new(&case.tube, solver, &meshed.mesh, &equilibrium.state);
        // The next mesh begins without the objects.
        let alone = solver.contact.clone();
        let mut centered = equilibrium.clone();
        for x in &mut centered.state.points {
            *x = [x[0] - middle[0], x[1] - middle[1], x[2]];
        }
        press(&case.tube, objects, (solver, post), &centered, (beside, &mut numbers[NUMBERS..]))?;
        solver.contact = alone;
        if is_followed(solver, &opening) {
            opening = opening_curve(&case.tube, objects, solver, post, &centered)?;
        }
        Ok(numbers)
    })?;
    let w = case.tube.width;
    let force = case.tube.fabric.stretch * w;
    let sheets = modelled.count();
    let [seal_at, stretch_at, pull_at] = places.map(|at| at.map(|x| x * w));
    Ok(InflatedStar {
        final_radius: values[0].scaled(w),
        edge_radius: values[10].scaled(w),
        corner_radii: [values[6].scaled(w), values[7].scaled(w)],
        off_center: values[8].scaled(w),
        tip_angle: values[1],
        least_tip_angle: values[9],
        volume: values[2].scaled(sheets * w.powi(3)),
        preload: values[3].scaled(2.0 * force),
        contact_area: values[4].scaled(w * w),
        radial_stiffness: values[5].scaled(sheets * force / w),
        forces: objects
            .sizes()
            .iter()
            .zip(&values[NUMBERS..])
            .map(|(r, f)| (*r, f.scaled(sheets * force)))
            .collect(),
        slips: values[NUMBERS + MOST_OBJECTS..][..count].to_vec(),
        opening: opening
            .into_iter()
            .map(|step| OpeningStep { radius: w * step.radius, force: sheets * force * step.force })
            .collect(),
        extremes: Extremes {
            seal_tension: values[WHOLE].scaled(case.tube.fabric.stretch),
            seal_at,
            stretch: values[WHOLE + 1],
            stretch_at,
            seal_pull: values[WHOLE + 2].scaled(case.tube.fabric.stretch),
            pull_at,
        },
        shape,
        evidence,
    })
}

/// Radius, tip angle, volume, force and area of contact, stiffness, the least and the largest radius, how far the corners' middle lies
/// aside, the least tip angle, the radius of the cut edge; and the corners' middle.
pub(super) fn measure(
    modelled: &ModelledPart,
    solver: &mut Solver,
    mesh: &Mesh,
    equilibrium: &Equilibrium,
) -> ([f64; WHOLE], [f64; 2]) {
    let corners = modelled.corner_places(mesh, &equilibrium.state);
    let [angle, least_angle] = modelled.tip_angles(mesh, &equilibrium.state);
    let at_tips = solver.contact.as_ref().filter(|_| modelled.part == StarPart::HalfSector);
    let (force, area) = at_tips.map_or((0.0, 0.0), |contact| (contact.force(TIP), contact.patch(TIP)));
    let [least, largest] = corners.range;
    let numbers = [
        corners.mean,
        angle,
        equilibrium.rest.energy.volume,
        force,
        area,
        modelled.stiffness(solver.compliance(&modelled.sections(mesh))),
        least,
        largest,
        corners.aside,
        least_angle,
        corners.edge,
    ];
    (numbers, corners.middle)
}
