//! The stable shape out of the plane of the drawing, of a chamber that does not stay in it.
//!
//! Where the shape with z = 0 as its plane of symmetry is unstable, both sheets together are pushed along the eigenvector that releases energy,
//! and settle without that plane. Energy, elements and solver are those of one sheet; seams and welds turn as freely as there. The coarsest mesh
//! begins at the shape in the plane, each finer one at the shape out of it. The opposite push gives the image of this shape. Contact of the
//! sheets with themselves is left out.

use crate::shell::assembly::{Assembly, BothSheets, Sheet, State};
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Evidence, Watch, part, values};
use crate::shell::cases::region::answer::{Equilibria, InflatedRegion};
use crate::shell::cases::region::chambers::FlatRegion;
use crate::shell::cases::region::probes;
use crate::shell::cases::region::rigid_motion::RigidMotion;
use crate::shell::cases::region::scaled::ScaledChamber;
use crate::shell::cases::region::stability::leaving_mode;
use crate::shell::cases::region::supports::{SealedNodes, in_space};
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
use crate::shell::element::vector::add_scaled;
use crate::shell::mesh::Meshed;
use crate::shell::solver::{Solver, Stop};
use std::sync::Arc;

/// The largest displacements of the pushes, by the chamber's width, tried in turn: along a mode of a few triangles Newton's method stalls after a
/// long one.
const PUSHES: [f64; 3] = [0.05, 0.01, 0.002];
/// Newton steps on one mesh at most.
const MOST_STEPS: u32 = 1000;
/// Part of the energy in the plane up to which a difference is rounding: the shape has settled in the plane again.
const ROUNDING: f64 = 1e-7;

/// A stable shape out of the plane; positions where its middle surface, half way between the sheets, lies best on the flat chamber.
#[derive(Clone, Debug, PartialEq)]
pub struct OutOfPlane {
    /// Energy of the shape in the plane less that of this one, J.
    pub released: Value,
    /// Largest less least height of the middle surface, m.
    pub rise: Value,
    /// Positions of each probe on the upper and on the lower sheet, m; of each mesh, coarse to fine.
    pub probed: Vec<Vec<[[f64; 3]; 2]>>,
    /// The upper and the lower sheet on the finest mesh; normals of both point upwards.
    pub sheets: [InflatedShape; 2],
    /// The evidence for these values.
    pub evidence: Evidence,
}

/// The stable shape out of the plane of `case`, whose shape in the plane is `inflated`. `None` where one of the meshes finds no such shape, where
/// `inflated` is a blend of shapes, and between plates.
///
/// # Errors
/// If a mesh is too large, or the computation is cancelled.
pub fn out_of_plane(
    case: &FlatRegion,
    inflated: &InflatedRegion,
    watch: &Watch,
) -> Result<Option<OutOfPlane>, ShellFault> {
    // The meshes and shapes of the answer in the plane are taken up one after the other. Each gives its numbers; the
    // finest also the sheets.
    let equilibria = inflated.equilibria.as_ref().filter(|_| case.plates.is_none());
    let Some(Equilibria { tube, fineness, states }) = equilibria else { return Ok(None) };
    let scaled = ScaledChamber::new(case, *tube, inflated.wrinkles);
    let (mut meshed, _) = scaled.chamber.mesh(fineness.cells)?;
    for _ in states.len()..=fineness.cuts {
        meshed = meshed.refined()?;
    }
    let places: Vec<[f64; 2]> = case.probes.iter().map(|place| place.map(|x| x / tube.width)).collect();
    let (mut numbers, mut probed, mut evidence) = (Vec::new(), Vec::new(), Evidence::default());
    let (mut coarse, mut shapes) = (None::<FreeMesh>, <[InflatedShape; 2]>::default());
    for (number, in_plane) in states.iter().enumerate() {
        if number > 0 {
            meshed = meshed.refined()?;
        }
        let mut mesh = FreeMesh::new(&scaled, &meshed, in_plane, watch)?;
        let is_settled = match &mut coarse {
            None => mesh.leave(in_plane)?,
            Some(coarse) => mesh.carry(coarse)?,
        };
        if !is_settled {
            return Ok(None);
        }
        let sheets = mesh.laid_sheets();
        numbers.push([mesh.released(), rise(&sheets)]);
        let [upper, lower] = sheets.each_ref().map(|sheet| probes::positions(&meshed.mesh, sheet, &places));
        let in_metres = |point: [f64; 3]| point.map(|x| x * tube.width);
        probed.push(upper.into_iter().zip(lower).map(|(a, b)| [a, b].map(in_metres)).collect());
        shapes = sheets.map(|sheet| InflatedShape::new(tube, &mut mesh.upper, &sheet));
        evidence.unknowns.push(mesh.solver.assembly.unknowns());
        evidence.efforts.push(mesh.solver.effort);
        evidence.residual = mesh.residual / tube.stretch();
        watch.tell(part(states.len() - 1 - number), &format!("out of the plane, mesh {}", number + 1));
        coarse = Some(mesh);
    }
    let [released, rise] = values(&numbers);
    let (released, rise) = (released.scaled(tube.energy()), rise.scaled(tube.width));
    Ok(Some(OutOfPlane { released, rise, probed, sheets: shapes, evidence }))
}

/// One mesh of both sheets, in units of the chamber's width.
struct FreeMesh {
    tube: Tube,
    /// The upper sheet alone, with z = 0 as its plane of symmetry.
    upper: Assembly,
    sealed: SealedNodes,
    numbers: BothSheets,
    solver: Solver,
    /// Both sheets.
    state: State,
    residual: f64,
    /// Energy of both sheets less the work of the pressure, in the plane and out of it.
    energies: [f64; 2],
}

impl FreeMesh {
    /// The mesh `meshed` of a chamber, whose upper sheet has the shape `in_plane` in the plane.
    fn new(
        scaled: &ScaledChamber,
        meshed: &Meshed,
        in_plane: &State,
        watch: &Watch,
    ) -> Result<Self, ShellFault> {
        let (tube, sealed) = (scaled.tube, scaled.sealed(meshed));
        let mut sheet = Sheet::new(&meshed.mesh, tube.scaled());
        let supports = scaled.prepare(meshed, &mut sheet);
        let (joined, numbers) = BothSheets::join(&sheet, &sealed.points);
        let supports_in_space = in_space(meshed, joined.points.len());
        let triangles = joined.pieces.len();
        let mut solver = Solver::new(joined, supports_in_space).ok_or(ShellFault::TooLarge { triangles })?;
        solver.cancel = Arc::clone(&watch.cancel);
        solver.most_steps = MOST_STEPS;
        let state = numbers.joined(in_plane, &in_plane.image());
        let energy = solver.assembly.energy(&state).total(tube.stretch());
        let upper = Assembly::new(sheet, supports);
        Ok(Self { tube, upper, sealed, numbers, solver, state, residual: 0.0, energies: [energy; 2] })
    }

    /// Leaves the plane along the eigenvector that releases energy; whether that leads to a stable shape.
    fn leave(&mut self, in_plane: &State) -> Result<bool, ShellFault> {
        let pressure = self.tube.stretch();
        let mode = leaving_mode(&self.upper.sheet, None, in_plane, pressure, &self.sealed);
        let Some((_, mode)) = mode.filter(|(value, _)| *value < 0.0) else { return Ok(false) };
        for length in PUSHES {
            self.push(in_plane, &mode, length);
            if self.settle()? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Pushes both sheets along `mode` of the upper one, so that its largest height is `length` upwards.
    fn push(&mut self, in_plane: &State, mode: &[[f64; 3]], length: f64) {
        let heights = mode.iter().map(|[_, _, z]| *z);
        let largest = heights.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
        let scale = length / largest;
        let (mut upper, mut lower) = (in_plane.clone(), in_plane.image());
        for ((upper_point, lower_point), [x, y, z]) in
            upper.points.iter_mut().zip(&mut lower.points).zip(mode)
        {
            *upper_point = add_scaled(*upper_point, scale, [*x, *y, *z]);
            *lower_point = add_scaled(*lower_point, scale, [-x, -y, *z]);
        }
        self.state = self.numbers.joined(&upper, &lower);
    }

    /// Begins with the shape of the mesh before, whose triangles were cut into four; whether that leads to a stable shape.
    fn carry(&mut self, coarse: &mut Self) -> Result<bool, ShellFault> {
        let [upper, lower] = coarse.numbers.parted(&coarse.state);
        let [upper, lower] = [upper, lower].map(|sheet| coarse.upper.prolong_free(&sheet, &self.upper));
        self.state = self.numbers.joined(&upper, &lower);
        self.solver.is_rough = true;
        self.settle()
    }

    /// Settles; whether the shape is stable and out of the plane.
    fn settle(&mut self) -> Result<bool, ShellFault> {
        let pressure = self.tube.stretch();
        self.solver.may_snap = true;
        let aim = self.tube.continuation().aim(pressure);
        let rest = match self.solver.settle(&mut self.state, aim) {
            Ok(rest) => rest,
            Err(Stop::Cancelled) => return Err(ShellFault::Cancelled),
            Err(_) => return Ok(false),
        };
        self.residual = rest.residual;
        self.energies[1] = rest.energy.total(pressure);
        Ok(self.released() > ROUNDING * self.energies[0].abs())
    }

    fn released(&self) -> f64 {
        self.energies[0] - self.energies[1]
    }

    /// The upper and the lower sheet where the middle surface lies best on the flat chamber.
    fn laid_sheets(&self) -> [State; 2] {
        let sheets = self.numbers.parted(&self.state);
        let sheet = &self.upper.sheet;
        let motion = RigidMotion::on_flat(&middle_surface(&sheets), &sheet.points, &sheet.areas);
        sheets.map(|State { points, leans }| State {
            points: points.into_iter().map(|point| motion.place(point)).collect(),
            leans,
        })
    }
}

/// The points half way between the sheets.
fn middle_surface([upper, lower]: &[State; 2]) -> Vec<[f64; 3]> {
    let pairs = upper.points.iter().zip(&lower.points);
    pairs.map(|(a, b)| std::array::from_fn(|axis| f64::midpoint(a[axis], b[axis]))).collect()
}

/// Largest less least height of the middle surface.
fn rise(sheets: &[State; 2]) -> f64 {
    let heights: Vec<f64> = middle_surface(sheets).iter().map(|[_, _, z]| *z).collect();
    heights.iter().copied().fold(f64::NEG_INFINITY, f64::max)
        - heights.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests;
