//! One chamber, inflated on a family of meshes.

use crate::shell::assembly::{Sheet, State};
use crate::shell::cases::actuator::Fineness;
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Family, Watch};
use crate::shell::cases::region::answer::{InflatedRegion, Wrinkles, answer};
use crate::shell::cases::region::chambers::FlatRegion;
use crate::shell::cases::region::measure::{self, Measured, NUMBERS};
use crate::shell::cases::region::pressures::PartialPressure;
use crate::shell::cases::region::probes;
use crate::shell::cases::region::seams::{self, Station};
use crate::shell::cases::region::supports::{self, SealedNodes};
use crate::shell::cases::region::surface::Surface;
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::tube::Tube;
use crate::shell::element::Fabric;
use crate::shell::mesh::Meshed;

impl FlatRegion {
    /// About how many unknowns the finest mesh of `fineness` has; 0 where the chamber has no mesh.
    pub fn unknowns(&self, fineness: Fineness) -> f64 {
        let chamber = self.chamber.by(self.chamber.widest());
        let Ok((meshed, _)) = chamber.mesh(fineness.cells) else { return 0.0 };
        #[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
        let triangles = meshed.mesh.triangles.len() as f64;
        // Each cut makes four triangles of one.
        self.unknowns_of_triangle() * triangles * (0..fineness.cuts).fold(1.0, |times, _| 4.0 * times)
    }

    /// Three unknowns of each point and one of each edge are three by triangle; a sheet whose wrinkles are averaged has those of points only.
    fn unknowns_of_triangle(&self) -> f64 {
        let tube = Tube { width: self.chamber.widest(), fabric: self.fabric, pressure: self.pressure };
        match Wrinkles::of(&tube) {
            Wrinkles::Resolved => 3.0,
            Wrinkles::Averaged => 1.5,
        }
    }

    /// Coarse meshes: some 800 unknowns on the coarsest mesh and 16 times as many on the finest, if that leaves one edge across the
    /// chamber. Islands, corners and narrow places take more than the area suggests.
    pub fn quick(&self) -> Fineness {
        let width = self.chamber.widest();
        let squares = self.chamber.area() / (width * width);
        let chamber = self.chamber.by(width);
        let of_triangle = self.unknowns_of_triangle();
        let of_squares = TRIANGLES_OF_SQUARE * of_triangle * squares;
        let mut cells = (QUICK / of_squares).sqrt().clamp(LEAST_CELLS, MOST_QUICK);
        let mut best = (f64::INFINITY, cells);
        for _ in 0..LOOKS {
            let Ok((meshed, _)) = chamber.mesh(cells) else { break };
            #[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
            let unknowns = of_triangle * meshed.mesh.triangles.len() as f64;
            if unknowns < best.0 {
                best = (unknowns, cells);
            }
            if unknowns <= ENOUGH * QUICK || cells <= LEAST_CELLS {
                break;
            }
            cells = (cells * (QUICK / unknowns).sqrt()).max(LEAST_CELLS);
        }
        Fineness { cells: best.1, cuts: 2 }
    }
}

/// Unknowns of a quick look's coarsest mesh, triangles of a square of the chamber's width with one edge across, and the most edges across.
const QUICK: f64 = 800.0;
const TRIANGLES_OF_SQUARE: f64 = 4.2;
const MOST_QUICK: f64 = 8.0;
/// Accepted factor on the number of unknowns, and number of trials for it.
const ENOUGH: f64 = 1.3;
const LOOKS: u32 = 4;

/// t/W and 1/eps of regions.
const THINNEST: f64 = 1e-6;
const MOST_BENDABLE_REGION: f64 = 1e10;

/// Factors on the edges across for other meshes, tried where the requested meshes give no equilibrium: the wrinkles that a
/// mesh shows depend on chance.
const OTHER_MESHES: [f64; 4] = [0.85, 1.2, 0.7, 1.45];
const LEAST_CELLS: f64 = 1.0;

/// Inflates one chamber from flat, on meshes of about the requested fineness.
///
/// # Errors
/// If its curves cross or leave the outline, if it is out of range, or if it has no stable equilibrium that keeps z = 0 a plane of symmetry;
/// the fault gives the place and the reason of the stop.
pub fn region(case: &FlatRegion, fineness: Fineness, watch: &Watch) -> Result<InflatedRegion, ShellFault> {
    let mut inflated = on_meshes(case, fineness, watch);
    for times in OTHER_MESHES {
        if !matches!(inflated, Err(ShellFault::Stopped { .. })) {
            break;
        }
        let cells = (times * fineness.cells).max(LEAST_CELLS);
        // The first reason is the one to report.
        inflated = match on_meshes(case, Fineness { cells, ..fineness }, watch) {
            Err(ShellFault::Stopped { .. }) => inflated,
            other => other,
        };
    }
    inflated
}

/// Inflates it on these meshes.
fn on_meshes(case: &FlatRegion, fineness: Fineness, watch: &Watch) -> Result<InflatedRegion, ShellFault> {
    // The chamber is scaled to the width 1 and meshed. On each mesh of the family the equilibrium is measured: numbers
    // for the mesh error, pulls along the seams, and probed points. The finest mesh gives shape and surface.
    let width = case.chamber.widest();
    let tube = Tube { width, fabric: case.fabric, pressure: case.pressure };
    tube.check_within(THINNEST, MOST_BENDABLE_REGION)?;
    let tube = softened(tube);
    let chamber = case.chamber.by(width);
    let (coarsest, curve_of) = chamber.mesh(fineness.cells)?;
    let partial: Vec<PartialPressure> = case.partial.iter().map(|part| part.in_units(width)).collect();
    let hold = |meshed: &Meshed, sheet: &mut Sheet| {
        let sealed = SealedNodes::new(&chamber, &partial, meshed);
        let supports = supports::symmetric(meshed, &sealed, sheet);
        Wrinkles::of(&tube).prepare(sheet, &tube);
        load_parts(&sealed, sheet, &tube);
        supports
    };
    let family = Family { tube, coarsest, cuts: fineness.cuts, hold: &hold, obstacles: &[] };
    let mut pulls: Vec<Vec<Station>> = Vec::new();
    let probed_places: Vec<[f64; 2]> = case.probes.iter().map(|place| place.map(|x| x / width)).collect();
    let mut probed: Vec<Vec<[f64; 3]>> = Vec::new();
    let mut last = (Measured::default(), InflatedShape::default(), Surface::default());
    let (values, evidence) = family.run(watch, |solver, meshed, equilibrium, _| {
        let sealed = SealedNodes::new(&chamber, &partial, meshed);
        let state: State = measure::aligned(&solver.assembly.sheet, &equilibrium.state);
        let measured = measure::measure(solver, meshed, (&state, equilibrium.pressure), &sealed);
        let _ = solver.assembly.differentiate(&equilibrium.state, equilibrium.pressure);
        let stations =
            seams::pulls(&chamber, case.band / width, (meshed, &curve_of), solver.assembly.forces());
        let mut numbers = measured.numbers;
        numbers[NUMBERS - 1] = stations.iter().map(|station| station.pull).fold(0.0, f64::max);
        pulls.push(stations);
        let positions = probes::positions(&meshed.mesh, &state, &probed_places);
        probed.push(positions.into_iter().map(|position| position.map(|x| x * width)).collect());
        let shape = InflatedShape::new(&tube, solver, &meshed.mesh, &state);
        let surface = Surface::new(&shape, &sealed);
        last = (measured, shape, surface);
        Ok(numbers)
    })?;
    let inflated = answer(case, &tube, (values, evidence), &pulls, last);
    Ok(InflatedRegion { probed, ..inflated })
}

/// Puts its part of the pressure on each triangle. A sheet without pressure buckles at any compression.
fn load_parts(sealed: &SealedNodes, sheet: &mut Sheet, tube: &Tube) {
    for (triangle, part) in sealed.parts.iter().enumerate().filter(|(_, part)| **part != 1.0) {
        sheet.set_load(triangle, *part);
        if *part == 0.0 {
            sheet.set_law(triangle, Wrinkles::law(tube));
        }
    }
}

/// p W/Y below which a sheet that bears no compression is computed as if it stretched as much: some 0.1 % of its lengths. Stiffer ones come
/// to rest slowly or not at all.
const LEAST_STRETCHED: f64 = 5e-3;

fn softened(tube: Tube) -> Tube {
    let least_stretch = tube.pressure * tube.width / LEAST_STRETCHED;
    if Wrinkles::of(&tube) == Wrinkles::Resolved || tube.fabric.stretch < least_stretch {
        return tube;
    }
    Tube { fabric: Fabric { stretch: least_stretch, ..tube.fabric }, ..tube }
}
