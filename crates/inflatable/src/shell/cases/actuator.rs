//! The paper's V-actuator: two arms, one hinge, sealed ends.

use crate::shell::assembly::{Plane, Sheet, Supports};
use crate::shell::cases::arm_line::ArmLine;
use crate::shell::cases::bend::{Bend, angle_of};
use crate::shell::cases::fault::{Input, ShellFault};
use crate::shell::cases::margin::Margin;
use crate::shell::cases::refinement::{Evidence, Family, Watch};
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
use crate::shell::mesh::{Border, HalfActuator, MarginWidths, Mesh, MeshFault, Meshed, Sizes, plane};
use crate::shell::solver::{Equilibrium, Solver};
use std::f64::consts::PI;

/// A V-actuator, SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VActuator {
    /// The tube of hinge and arms.
    pub tube: Tube,
    /// Inner radius R of its hinge, m.
    pub radius: f64,
    /// Length l of each arm, from the hinge's end to the sealed end, m.
    pub arm_length: f64,
    /// Angle phi_0 between the arms when flat.
    pub angle: f64,
    /// What of the sealed margin is modelled beyond its long rims.
    pub margin: Margin,
}

/// A V-actuator under pressure.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Angle phi at rest, rad: twice that between the plane of symmetry and the arm's line.
    pub angle: Value,
    /// (pi - phi)/(pi - phi_0).
    pub coiling: Value,
    /// Volume of the whole actuator, m^3.
    pub volume: Value,
    /// d2U/dphi2 at rest, N m per rad, whole tube.
    pub stiffness: Value,
    /// Requested angles, rad, and the applied moment dU/dphi that holds each, N m; positive opens.
    pub moments: Vec<(f64, Value)>,
    /// The modelled sheet at rest.
    pub shape: InflatedShape,
    /// The evidence for these values.
    pub evidence: Evidence,
}

/// Largest number of angles of one call.
pub const MOST_ANGLES: usize = 24;

/// Numbers that each mesh gives, without moments.
const NUMBERS: usize = 3;

/// Fineness of the meshes of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Edges across a hinge of the coarsest mesh.
    pub cells: f64,
    /// Number of times that its triangles are cut into four.
    pub cuts: usize,
}

impl Default for Fineness {
    /// 4,000, 17,000 and 67,000 unknowns for a V-actuator with arms of 4 W.
    fn default() -> Self {
        Self { cells: 6.0, cuts: 3 }
    }
}

/// Three unknowns of each point and one of each edge, by triangle.
pub(super) const UNKNOWNS_OF_TRIANGLE: f64 = 3.0;

impl Fineness {
    /// About how many unknowns the finest mesh has whose coarsest is `coarsest`.
    pub(super) fn unknowns(self, coarsest: &Mesh) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
        let triangles = coarsest.triangles.len() as f64;
        // Each cut makes four triangles of one.
        UNKNOWNS_OF_TRIANGLE * triangles * (0..self.cuts).fold(1.0, |times, _| 4.0 * times)
    }
}

/// Arms must leave a line to fit between one W behind the hinge and one W before the end.
const SHORTEST_ARM: f64 = 2.5;
/// Length of arms beyond which meshes get large and the result does not change.
const LONGEST_ARM: f64 = 50.0;

/// Half of one sheet of a V-actuator whose lengths are divided by W: the part that is modelled.
#[derive(Clone, Copy, Debug)]
pub struct ModelledActuator {
    half: HalfActuator,
    margin: MarginWidths,
}

impl VActuator {
    /// The modelled half, of a tube whose pressure and fabric may be beyond the range of shells.
    ///
    /// # Errors
    /// If its arms are too short or too long.
    pub fn modelled(&self) -> Result<ModelledActuator, ShellFault> {
        let w = self.tube.width;
        let l = self.arm_length / w;
        if !(SHORTEST_ARM..=LONGEST_ARM).contains(&l) {
            let (minimum, maximum) = (SHORTEST_ARM, LONGEST_ARM);
            return Err(ShellFault::Range { name: Input::Arms, found: l, least: minimum, most: maximum });
        }
        let half = HalfActuator { r: self.radius / w, w: 1.0, l, phi_0: self.angle };
        Ok(ModelledActuator { half, margin: self.margin.widths(w) })
    }
}

impl ModelledActuator {
    /// The mesh with edges of these lengths, by W.
    ///
    /// # Errors
    /// If it has no mesh.
    pub fn meshed(&self, sizes: &Sizes) -> Result<Meshed, MeshFault> {
        self.half.mesh_with(sizes, self.margin)
    }

    /// The plane of symmetry of `mesh` through the hinge, and a support against sliding along it.
    pub fn supports(&self, mesh: &Mesh) -> Supports {
        let mut supports = Supports::new(mesh, vec![Plane::first()]);
        if let Some(inner) = mesh.innermost(Border::Mirror(plane::FIRST)) {
            supports.fix(inner, 0);
        }
        supports
    }

    /// Angle phi, and by the scales of the shell the volume and the stiffness d2U/dphi2 of the whole at an `equilibrium`, the last one of
    /// `solver`.
    pub fn measure(&self, solver: &mut Solver, mesh: &Mesh, equilibrium: &Equilibrium) -> [f64; 3] {
        let line = self.arm_line(mesh);
        let angle = angle_of(&line, &equilibrium.state);
        [angle, 4.0 * equilibrium.rest.energy.volume, stiffness(solver, &line, equilibrium)]
    }

    fn arm_line(&self, mesh: &Mesh) -> ArmLine {
        let (sine, cosine) = libm::sincos((PI - self.half.phi_0) / 2.0);
        ArmLine::new(mesh, [-sine, cosine], [1.0, self.half.l - 1.0])
    }
}

/// Inflates a V-actuator from flat, then holds it at each of `angles` (rad) in turn.
///
/// # Errors
/// If it is out of range or has no stable equilibrium at its pressure: where it stopped, and why.
pub fn actuator(
    case: &VActuator,
    angles: &[f64],
    fineness: Fineness,
    watch: &Watch,
) -> Result<Actuator, ShellFault> {
    case.tube.check()?;
    let modelled = case.modelled()?;
    if angles.len() > MOST_ANGLES {
        return Err(ShellFault::TooMany { name: "angles", found: angles.len(), most: MOST_ANGLES });
    }
    let coarsest = modelled.meshed(&Sizes::for_tube(1.0, fineness.cells))?;
    let hold = |meshed: &Meshed, sheet: &mut Sheet| {
        let mut supports = modelled.supports(&meshed.mesh);
        case.margin.apply(meshed, sheet, &mut supports);
        supports
    };
    let family = Family::new(case.tube, coarsest, fineness.cuts, &hold);
    let mut shape = InflatedShape::default();
    let (values, evidence) = family.run(watch, |solver, meshed, equilibrium, _| {
        let line = modelled.arm_line(&meshed.mesh);
        let mut numbers = [0.0; NUMBERS + MOST_ANGLES];
        numbers[..NUMBERS].copy_from_slice(&modelled.measure(solver, &meshed.mesh, equilibrium));
        let bend = Bend { line: &line, aim: case.tube.continuation().aim(equilibrium.pressure) };
        let moments = bend.moments(solver, &equilibrium.state, angles);
        let moments = moments.map_err(|why| case.tube.stopped(why, solver.triangles()))?;
        numbers[NUMBERS..][..moments.len()].copy_from_slice(&moments);
        shape = InflatedShape::new(&case.tube, solver, &meshed.mesh, &equilibrium.state);
        Ok(numbers)
    })?;
    let [angle, volume, stiffness] = [values[0], values[1], values[2]];
    let unit = case.tube.energy();
    let arc = PI - case.angle;
    Ok(Actuator {
        angle,
        coiling: angle.shifted(-PI).scaled(-1.0 / arc),
        volume: volume.scaled(case.tube.width.powi(3)),
        stiffness: stiffness.scaled(unit),
        moments: angles.iter().zip(&values[NUMBERS..]).map(|(angle, m)| (*angle, m.scaled(unit))).collect(),
        shape,
        evidence,
    })
}

/// d2U/dphi2 of the whole, by one solve with the last factor: a unit moment turns the angle by g.H^-1 g.
fn stiffness(solver: &mut Solver, line: &ArmLine, equilibrium: &Equilibrium) -> f64 {
    let [x, y] = line.direction(&equilibrium.state);
    let square = x * x + y * y;
    4.0 / solver.compliance(&line.times([2.0 * y / square, -2.0 * x / square]))
}
