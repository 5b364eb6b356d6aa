//! The star: half a sector of it between a reentrant corner's plane of symmetry and a tip's.

use crate::shell::assembly::{Plane, State, Supports};
use crate::shell::cases::actuator::Fineness;
use crate::shell::cases::arm_line::ArmLine;
use crate::shell::cases::extremes::{self, Extremes};
use crate::shell::cases::family::{Evidence, Family, Watch};
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::shape::Shape;
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
use crate::shell::contact::Obstacle;
use crate::shell::mesh::{Border, HalfSector, Mesh, Sizes, plane};
use crate::shell::solver::{Rung, Solver};

/// A flat star, SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatStar {
    /// Its tube.
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
}

/// A star under pressure; what is per star counts both sheets and all sectors.
#[derive(Clone, Debug, PartialEq)]
pub struct InflatedStar {
    /// From the axis to the apex of a corner's inner rim, m.
    pub final_radius: Value,
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
    /// Radius of a round object, m, and the sum of the radial forces on it, N.
    pub forces: Vec<(f64, Value)>,
    /// The hardest loaded places; on the finest mesh.
    pub extremes: Extremes,
    /// Its modelled sheet at rest.
    pub shape: Shape,
    /// How it was come by.
    pub evidence: Evidence,
}

/// Numbers that each mesh gives of the whole star, and with those of its hardest loaded places.
const WHOLE: usize = 6;
const NUMBERS: usize = WHOLE + 2;
/// The corner's plane of symmetry.
const CORNER: Border = Border::Mirror(plane::FIRST);
/// Objects of one call: more are asked for in another.
pub const MOST_OBJECTS: usize = 8;

/// Largest growth of an object in one solve, by W.
const OPENING: f64 = 0.05;

impl FlatStar {
    fn sector(&self) -> Result<HalfSector, ShellFault> {
        self.tube.check()?;
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

/// Inflates a star from flat, then presses it against round objects of the given radii (m), smallest first.
///
/// # Errors
/// If it is out of range or has no stable equilibrium: where it stopped, and why.
pub fn star(
    case: &FlatStar,
    objects: &[f64],
    fineness: Fineness,
    watch: &Watch,
) -> Result<InflatedStar, ShellFault> {
    let sector = case.sector()?;
    if objects.len() > MOST_OBJECTS {
        return Err(ShellFault::TooMany { name: "objects", found: objects.len(), most: MOST_OBJECTS });
    }
    let coarsest = sector.mesh(&Sizes::across(1.0, fineness.cells))?;
    let planes = [Plane::first(), Plane::second(sector.half_angle())];
    let obstacles = [Obstacle::Wall(planes[0]), Obstacle::Wall(planes[1]), Obstacle::Post { radius: 0.0 }];
    let hold = |mesh: &Mesh| Supports::new(mesh, planes.to_vec());
    let family =
        Family { tube: case.tube, coarsest, cuts: fineness.cuts, hold: &hold, obstacles: &obstacles };
    let (mut worst, mut shape) = (Extremes::default(), Shape::default());
    let (values, evidence) = family.run(watch, |solver, meshed, rung| {
        let mut numbers = [0.0; NUMBERS + MOST_OBJECTS];
        worst = extremes::extremes(&solver.assembly.sheet, &meshed.mesh, &rung.state);
        let whole = measure(&sector, solver, &meshed.mesh, rung);
        numbers[..WHOLE].copy_from_slice(&whole);
        numbers[WHOLE..NUMBERS].copy_from_slice(&[worst.seal_tension, worst.stretch]);
        shape = Shape::new(&case.tube, solver, &meshed.mesh, &rung.state);
        press(case, objects, solver, rung, &mut numbers[NUMBERS..])?;
        Ok(numbers)
    })?;
    let w = case.tube.width;
    let force = case.tube.fabric.stretch * w;
    let sheets = 4.0 * f64::from(case.points);
    Ok(InflatedStar {
        final_radius: values[0].scaled(w),
        tip_angle: values[1],
        volume: values[2].scaled(sheets * w.powi(3)),
        preload: values[3].scaled(2.0 * force),
        contact_area: values[4].scaled(w * w),
        radial_stiffness: values[5].scaled(sheets * force / w),
        forces: objects.iter().zip(&values[NUMBERS..]).map(|(r, f)| (*r, f.scaled(sheets * force))).collect(),
        extremes: worst.scaled(case.tube.fabric.stretch, w, [values[6], values[7]]),
        shape,
        evidence,
    })
}

/// Points of the corner's section, in its plane of symmetry, with the flat length that each stands for.
fn section(mesh: &Mesh) -> Vec<(usize, f64)> {
    let on = mesh.along(CORNER);
    on.flat_map(|edge| mesh.edges[edge].ends.map(|end| (end, mesh.length(edge) / 2.0))).collect()
}

/// Radius, tip angle, volume, force and area of contact, stiffness.
fn measure(sector: &HalfSector, solver: &mut Solver, mesh: &Mesh, rung: &Rung) -> [f64; WHOLE] {
    let radius = mesh.innermost(CORNER).map_or(0.0, |apex| rung.state.points[apex][0]);
    let contact = solver.contact.as_ref();
    let (force, area) = contact.map_or((0.0, 0.0), |contact| (contact.force(1), contact.patch(1)));
    let parts: Vec<(usize, [f64; 3])> =
        section(mesh).into_iter().map(|(point, length)| (point, [length, 0.0, 0.0])).collect();
    [
        radius,
        tip_angle(sector, mesh, &rung.state),
        rung.rest.energy.volume,
        force,
        area,
        1.0 / solver.compliance(&parts),
    ]
}

/// Twice the angle between the tip's plane and the arm's line, which leaves out one W at each hinge, or a third of a short arm.
fn tip_angle(sector: &HalfSector, mesh: &Mesh, state: &State) -> f64 {
    let half_corner = sector.phi_i / 2.0 + sector.half_angle();
    let (sine, cosine) = half_corner.sin_cos();
    let start = (sector.rho_0 + sector.w + sector.r_e) * cosine;
    let l = sector.l();
    let left_out = (l / 3.0).min(1.0);
    let [x, y] =
        ArmLine::new(mesh, [cosine, sine], [start + left_out, start + l - left_out]).direction(state);
    2.0 * (y.atan2(x) - sector.half_angle())
}

/// Opens the star by each object in turn, and writes the force of one sheet of half a sector on it.
fn press(
    case: &FlatStar,
    objects: &[f64],
    solver: &mut Solver,
    rung: &Rung,
    forces: &mut [f64],
) -> Result<(), ShellFault> {
    let mut state = rung.state.clone();
    let nearest = state.points.iter().map(|x| x[0].hypot(x[1])).fold(f64::INFINITY, f64::min);
    let mut radius = nearest;
    let aim = case.tube.ladder().aim(rung.pressure);
    for (object, force) in objects.iter().zip(forces) {
        let last = (object / case.tube.width).max(nearest);
        while radius < last {
            radius = (radius + OPENING).min(last);
            if let Some(contact) = &mut solver.contact {
                contact.replace(2, Obstacle::Post { radius });
            }
            let _ = solver.rest(&mut state, aim).map_err(|why| case.tube.stopped(why, solver.triangles()))?;
        }
        *force = solver.contact.as_ref().map_or(0.0, |contact| contact.force(2));
    }
    Ok(())
}
