//! One chamber, inflated on a family of meshes.

use crate::shell::assembly::{Sheet, State};
use crate::shell::cases::actuator::{Fineness, UNKNOWNS_OF_TRIANGLE};
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Family, LoadPath, Watch};
use crate::shell::cases::region::answer::{FamilyResults, InflatedRegion, Wrinkles};
use crate::shell::cases::region::branches::{Blend, blended, lower_of};
use crate::shell::cases::region::chambers::FlatRegion;
use crate::shell::cases::region::measure::{self, Measured, NUMBERS};
use crate::shell::cases::region::overlap;
use crate::shell::cases::region::pressures::PartialPressure;
use crate::shell::cases::region::probes;
use crate::shell::cases::region::seams::{self, Station};
use crate::shell::cases::region::supports::{self, SealedNodes};
use crate::shell::cases::region::surface::Surface;
use crate::shell::cases::shape::InflatedShape;
use crate::shell::cases::tube::{MOST_BENDABLE, Tube};
use crate::shell::contact::Obstacle;
use crate::shell::element::Fabric;
use crate::shell::mesh::{FlatChamber, Meshed};
use geom::Path;

impl FlatRegion {
    /// About how many unknowns the finest mesh of `fineness` has; 0 where the chamber has no mesh.
    pub fn unknowns(&self, fineness: Fineness) -> f64 {
        let chamber = self.chamber.in_units(self.chamber.widest());
        chamber.mesh(fineness.cells).map_or(0.0, |(meshed, _)| fineness.unknowns(&meshed.mesh))
    }

    /// Coarse meshes: some 800 unknowns on the coarsest mesh and 16 times as many on the finest, if that leaves one edge across the
    /// chamber. Islands, corners and narrow places take more than the area suggests.
    pub fn quick(&self) -> Fineness {
        let width = self.chamber.widest();
        let squares = self.chamber.area() / (width * width);
        let chamber = self.chamber.in_units(width);
        let of_squares = TRIANGLES_OF_SQUARE * UNKNOWNS_OF_TRIANGLE * squares;
        let mut cells = (QUICK / of_squares).sqrt().clamp(LEAST_CELLS, MOST_QUICK);
        let mut best = (f64::INFINITY, cells);
        for _ in 0..LOOKS {
            let Ok((meshed, _)) = chamber.mesh(cells) else { break };
            let unknowns = Fineness { cells, cuts: 0 }.unknowns(&meshed.mesh);
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

/// Largest 1/eps at which wrinkles are resolved, as those of stars. Coarse meshes show the folds of cushions there.
const MOST_RESOLVED: f64 = MOST_BENDABLE;
/// 1/eps below which other meshes are tried rather than stiffer sheets, and to which a sheet is stiffened at last.
const SURELY_RESOLVED: f64 = 1000.0;
/// Least 1/eps at which a second shape is looked for: at 750 the shape from flat is the only one of a square pouch.
const LEAST_FOLDED: f64 = 500.0;
/// 1/eps from which on folds are fine, by that which is resolved: between both the difference of a folded and a smooth shape falls as the root of
/// 1/eps. Independent shells of square pouches differ by 6 % at 11,000 and 5 % at 29,000 from the smooth height, a disc by 8 % at 29,000.
const FADED: f64 = 20.0;
/// What the law leaves open, by its distance from both ends: ranges on coarse meshes then contain those shells.
const OPEN: f64 = 1.6;
/// Newton steps on one mesh above which a sheet counts as not resolved; usual are 50 to 150, at most 200.
const MOST_STEPS: u32 = 250;

/// Largest 1/eps at which the wrinkles of `chamber`, `width` wide, are resolved.
pub(super) fn most_resolved(chamber: &FlatChamber, width: f64) -> f64 {
    if is_tube(chamber, width) { MOST_RESOLVED_OF_TUBES } else { MOST_RESOLVED }
}

/// Whether `chamber`, `width` wide, is a long tube without welds.
fn is_tube(chamber: &FlatChamber, width: f64) -> bool {
    let is_divided = !chamber.islands.is_empty() || !chamber.welds.is_empty();
    let rims = chamber.curves().map(Path::length).sum::<f64>();
    !is_divided && 2.0 * chamber.area() > TUBE * width * rims
}

impl InflatedRegion {
    /// Whether it may have folds that could lie elsewhere: long tubes and stiff sheets have none.
    pub fn may_fold(&self, flat: &FlatRegion) -> bool {
        self.bendability >= LEAST_FOLDED && !is_tube(&flat.chamber, self.width)
    }
}

/// Area of a chamber by half its width and rims from which on it is a tube: one whose length is three times its width.
const TUBE: f64 = 0.75;
/// Largest 1/eps at which bent and straight tubes are resolved: their hinges bear compression, and coarse meshes show what wrinkles there are.
const MOST_RESOLVED_OF_TUBES: f64 = 1e5;

/// A try to inflate a chamber.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Attempt {
    /// Edges across the chamber.
    cells: f64,
    /// 1/eps of the sheet whose folds are on the mesh, at most that of the chamber; `None` to average all wrinkles.
    resolved: Option<f64>,
}

/// The tries for a chamber of 1/eps = `bendability`, whose wrinkles are resolved up to 1/eps = `most_resolved`, in their order.
fn attempts(bendability: f64, most_resolved: f64, cells: f64) -> Vec<Attempt> {
    let limits = [most_resolved, MOST_RESOLVED, SURELY_RESOLVED];
    let shown_limits = limits.into_iter().filter(|limit| bendability < FADED * limit);
    let mut treatments: Vec<Option<f64>> = shown_limits.map(|limit| Some(bendability.min(limit))).collect();
    let last_treatment = (bendability <= SURELY_RESOLVED).then_some(bendability);
    treatments.push(last_treatment);
    treatments.dedup();
    let mut sequence: Vec<Attempt> =
        treatments.into_iter().map(|resolved| Attempt { cells, resolved }).collect();
    let other_cells = OTHER_MESHES.map(|times| (times * cells).max(LEAST_CELLS));
    for attempt in other_cells.map(|cells| Attempt { cells, resolved: last_treatment }) {
        if !sequence.contains(&attempt) {
            sequence.push(attempt);
        }
    }
    sequence
}

/// The widest place of `case` as a tube.
///
/// # Errors
/// If it is out of range.
pub(super) fn tube_of(case: &FlatRegion) -> Result<Tube, ShellFault> {
    let tube = Tube { width: case.chamber.widest(), fabric: case.fabric, pressure: case.pressure };
    tube.check_within(THINNEST, MOST_BENDABLE_REGION)?;
    Ok(tube)
}

/// Inflates one chamber, on meshes of about the requested fineness.
///
/// # Errors
/// If its curves cross or leave the outline, if it is out of range, if it has no stable equilibrium that keeps z = 0 a plane of symmetry, or if
/// rims cross in it; the fault gives the place and the reason of the stop.
pub fn region(case: &FlatRegion, fineness: Fineness, watch: &Watch) -> Result<InflatedRegion, ShellFault> {
    let tube = tube_of(case)?;
    // The first reason is the one to report.
    let mut first_stop = None;
    for Attempt { cells, resolved } in
        attempts(tube.bendability(), most_resolved(&case.chamber, tube.width), fineness.cells)
    {
        let meshes = Fineness { cells, ..fineness };
        let inflated = match resolved {
            Some(resolved) => resolved_up_to(case, tube, resolved, meshes, watch),
            None => Run::averaged(tube).on_meshes(case, meshes, watch),
        };
        match inflated {
            Err(stop @ ShellFault::Stopped { .. }) => first_stop = first_stop.or(Some(stop)),
            Ok(InflatedRegion { overlap: Some(places), .. }) => return Err(ShellFault::Overlap { places }),
            other => return other,
        }
    }
    Err(first_stop.unwrap_or(ShellFault::Cancelled))
}

/// The chamber with its wrinkles resolved up to 1/eps = `resolved`. Beyond, the sheet is computed twice: so stiff that it has this 1/eps, and
/// without stiffness against compression. From [`FADED`] times this 1/eps on only the second would count: [`attempts`] averages all wrinkles.
fn resolved_up_to(
    case: &FlatRegion,
    tube: Tube,
    resolved: f64,
    fineness: Fineness,
    watch: &Watch,
) -> Result<InflatedRegion, ShellFault> {
    let bendability = tube.bendability();
    if bendability <= resolved {
        // Where nothing else is tried, a sheet may take its time.
        let most_steps = if bendability <= SURELY_RESOLVED { u32::MAX } else { MOST_STEPS };
        return lowest(case, Run::resolved(tube, most_steps), fineness, watch);
    }
    let bending = tube.fabric.bending * bendability / resolved;
    let stiff = Tube { fabric: Fabric { bending, ..tube.fabric }, ..tube };
    // The folded sheet is computed on two ways to its pressure.
    let folded = watch.run_part([0.0, 2.0 / 3.0], |watch| {
        lowest(case, Run::resolved(stiff, MOST_STEPS), fineness, watch)
    })?;
    let smooth =
        watch.run_part([2.0 / 3.0, 1.0], |watch| Run::averaged(tube).on_meshes(case, fineness, watch))?;
    let root = (resolved / bendability).sqrt();
    let end = (1.0 / FADED).sqrt();
    // What the law leaves open is nothing at its start.
    let blend = Blend { part: (root - end) / (1.0 - end), open: OPEN * root * (1.0 - root) };
    Ok(blended(&smooth, &folded, blend))
}

/// The resolved shape of the lowest energy, of those of `flat_run` and of a run from a higher pressure; with the other one, if it
/// differs.
fn lowest(
    case: &FlatRegion,
    flat_run: Run,
    fineness: Fineness,
    watch: &Watch,
) -> Result<InflatedRegion, ShellFault> {
    if flat_run.tube.bendability() < LEAST_FOLDED {
        return flat_run.on_meshes(case, fineness, watch);
    }
    let high_run = Run { approach: LoadPath::FromAbove, most_steps: MOST_STEPS, ..flat_run };
    let from_flat = watch.run_part([0.0, 0.5], |watch| flat_run.on_meshes(case, fineness, watch))?;
    match watch.run_part([0.5, 1.0], |watch| high_run.on_meshes(case, fineness, watch)) {
        Ok(from_above) => Ok(lower_of(from_flat, from_above)),
        Err(ShellFault::Stopped { .. }) => Ok(from_flat),
        Err(fault) => Err(fault),
    }
}

/// One way to compute a chamber.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    tube: Tube,
    wrinkles: Wrinkles,
    approach: LoadPath,
    most_steps: u32,
}

impl Run {
    pub(super) fn averaged(tube: Tube) -> Self {
        let tube = softened(tube);
        Self { tube, wrinkles: Wrinkles::Averaged, approach: LoadPath::FromFlat, most_steps: u32::MAX }
    }

    /// A run from flat with at most `most_steps` Newton steps on one mesh.
    fn resolved(tube: Tube, most_steps: u32) -> Self {
        Self { tube, wrinkles: Wrinkles::Resolved, approach: LoadPath::FromFlat, most_steps }
    }

    /// Inflates `case` on these meshes.
    pub(super) fn on_meshes(
        self,
        case: &FlatRegion,
        fineness: Fineness,
        watch: &Watch,
    ) -> Result<InflatedRegion, ShellFault> {
        // The chamber is scaled to the width 1 and meshed. On each mesh of the family the equilibrium is measured: numbers
        // for the mesh error, pulls along the seams, and probed points. The finest mesh gives shape and surface.
        let Self { tube, wrinkles, approach, most_steps } = self;
        let width = tube.width;
        let chamber = case.chamber.in_units(width);
        let (coarsest, curve_of) = chamber.mesh(fineness.cells)?;
        let partial: Vec<PartialPressure> = case.partial.iter().map(|part| part.in_units(width)).collect();
        let hold = |meshed: &Meshed, sheet: &mut Sheet| {
            let sealed = SealedNodes::new(&chamber, &partial, meshed);
            let supports = supports::symmetric(meshed, &sealed, sheet);
            wrinkles.prepare(sheet, &tube);
            load_parts(&sealed, sheet, &tube);
            supports
        };
        let plate = case.plates.map(|gap| Obstacle::Plate { height: gap / (2.0 * width) });
        let family = Family {
            approach,
            most_steps,
            obstacles: plate.as_slice(),
            ..Family::new(tube, coarsest, fineness.cuts, &hold)
        };
        let mut pulls: Vec<Vec<Station>> = Vec::new();
        let probed_places: Vec<[f64; 2]> = case.probes.iter().map(|place| place.map(|x| x / width)).collect();
        let mut probed: Vec<Vec<[f64; 3]>> = Vec::new();
        let mut last = (Measured::default(), InflatedShape::default(), Surface::default(), None);
        let (values, evidence) = family.run(watch, |solver, meshed, equilibrium, _| {
            let sealed = SealedNodes::new(&chamber, &partial, meshed);
            let state: State = measure::aligned(&solver.assembly.sheet, &equilibrium.state);
            let measured = measure::measure(solver, meshed, (&state, equilibrium.pressure), &sealed);
            let _ = solver.assembly.differentiate(&equilibrium.state, equilibrium.pressure);
            let stations =
                seams::pulls(&chamber, case.band / width, (meshed, &curve_of), solver.assembly.forces());
            let mut numbers = measured.numbers;
            numbers[NUMBERS - 2] = equilibrium.rest.energy.total(equilibrium.pressure);
            numbers[NUMBERS - 1] = stations.iter().map(|station| station.pull).fold(0.0, f64::max);
            pulls.push(stations);
            let positions = probes::positions(&meshed.mesh, &state, &probed_places);
            probed.push(positions.into_iter().map(|position| position.map(|x| x * width)).collect());
            let shape = InflatedShape::new(&tube, solver, &meshed.mesh, &state);
            let surface = Surface::new(&shape, &sealed);
            last = (measured, shape, surface, overlap::crossing(&meshed.mesh, &state.points));
            Ok(numbers)
        })?;
        let (measured, shape, surface, overlap) = last;
        let results = FamilyResults { values, evidence, pulls, probed, measured, overlap, shape, surface };
        Ok(results.answer(case, &tube, wrinkles))
    }
}

/// Puts its part of the pressure on each triangle. A sheet without pressure buckles at any compression.
pub(super) fn load_parts(sealed: &SealedNodes, sheet: &mut Sheet, tube: &Tube) {
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
    let most_stiffness = tube.pressure * tube.width / LEAST_STRETCHED;
    let stretch = tube.fabric.stretch.min(most_stiffness);
    Tube { fabric: Fabric { stretch, ..tube.fabric }, ..tube }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges across and the resolved 1/eps of each try.
    fn treatments_on_meshes(bendability: f64, most_resolved: f64, cells: f64) -> Vec<(f64, Option<f64>)> {
        attempts(bendability, most_resolved, cells)
            .iter()
            .map(|attempt| (attempt.cells, attempt.resolved))
            .collect()
    }

    /// `treatments` on meshes of 10 edges across, and the last one on other meshes.
    fn with_other_meshes(treatments: &[Option<f64>]) -> Vec<(f64, Option<f64>)> {
        let last = *treatments.last().expect("treatments");
        let other_meshes = OTHER_MESHES.map(|times| (10.0 * times, last));
        treatments.iter().map(|treatment| (10.0, *treatment)).chain(other_meshes).collect()
    }

    #[test]
    fn no_try_repeats_another_one() {
        for (bendability, most_resolved, treatments) in [
            (800.0, MOST_RESOLVED, vec![Some(800.0)]),
            (1000.0, MOST_RESOLVED, vec![Some(1000.0)]),
            (3e3, MOST_RESOLVED, vec![Some(3e3), Some(1e3), None]),
            (1.5e4, MOST_RESOLVED, vec![Some(5e3), Some(1e3), None]),
            (5e4, MOST_RESOLVED, vec![Some(5e3), None]),
            (1e5, MOST_RESOLVED, vec![None]),
            (2e5, MOST_RESOLVED, vec![None]),
            (3e3, MOST_RESOLVED_OF_TUBES, vec![Some(3e3), Some(1e3), None]),
            (5e4, MOST_RESOLVED_OF_TUBES, vec![Some(5e4), Some(5e3), None]),
            (2e5, MOST_RESOLVED_OF_TUBES, vec![Some(1e5), None]),
            (5e6, MOST_RESOLVED_OF_TUBES, vec![None]),
        ] {
            assert_eq!(
                treatments_on_meshes(bendability, most_resolved, 10.0),
                with_other_meshes(&treatments),
                "{bendability}"
            );
        }
        // Meshes of one edge across are the coarsest.
        assert_eq!(
            treatments_on_meshes(800.0, MOST_RESOLVED, 1.0),
            [(1.0, Some(800.0)), (1.2, Some(800.0)), (1.45, Some(800.0))]
        );
        assert_eq!(treatments_on_meshes(2e5, MOST_RESOLVED, 1.0), [(1.0, None), (1.2, None), (1.45, None)]);
    }
}
