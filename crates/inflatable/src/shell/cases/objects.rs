//! Round objects that a star is pressed against.

use crate::shell::assembly::State;
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::Indented;
use crate::shell::cases::tube::Tube;
use crate::shell::contact::Obstacle;
use crate::shell::solver::{Aim, Equilibrium, Solver, Stop};

/// Largest number of objects of one call.
pub const MOST_OBJECTS: usize = 8;
/// Largest growth of an object in one solve, by W, and how often it is halved where that is too much.
const GROWTH: f64 = 0.15;
const MOST_HALVINGS: i32 = 4;

/// How much wider than an object a star is opened to look for another equilibrium around it, by W: as far as one solve leads.
const BEYOND: f64 = GROWTH;

/// The radial forces of a star on one object, before and after it was opened further. They differ where the rims of the corners snap: corners
/// then have two stable shapes around that object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hysteresis {
    /// Radius of the object.
    pub radius: f64,
    /// Force on the object when it has opened the star from rest.
    pub opening_force: f64,
    /// Force on the object when the star has closed on it from a wider opening.
    pub closing_force: f64,
}

/// Least difference of the two forces on one object that is a snap, by the larger one: less is the noise of single points of contact.
const LEAST_DIFFERENCE: f64 = 0.02;

impl Hysteresis {
    /// By which part the lower of the two forces is less than the higher one.
    pub fn difference(self) -> f64 {
        (self.opening_force - self.closing_force).abs() / self.opening_force.max(self.closing_force)
    }

    /// With lengths `length` times as long and forces `force` times as large.
    pub(super) fn scaled(self, length: f64, force: f64) -> Self {
        Self {
            radius: length * self.radius,
            opening_force: force * self.opening_force,
            closing_force: force * self.closing_force,
        }
    }

    /// Whether the forces differ by more than noise.
    pub fn is_snap(self) -> bool {
        self.difference() > LEAST_DIFFERENCE
    }
}

/// Opens a star from `star`, its equilibrium around an object of `radius`, by [`BEYOND`], and lets it close on the object again. `None` where
/// the star does not press on the object, or where a solve finds no equilibrium. The solver's contact is as before.
///
/// # Errors
/// If it is cancelled.
pub(super) fn hysteresis(
    tube: &Tube,
    solver: &mut Solver,
    post: usize,
    star: &Indented,
    radius: f64,
) -> Result<Option<Hysteresis>, ShellFault> {
    let Some(opening_force) =
        star.contact.as_ref().map(|contact| contact.force(post)).filter(|force| *force > 0.0)
    else {
        return Ok(None);
    };
    let former_contact = std::mem::replace(&mut solver.contact, star.contact.clone());
    let aim = tube.continuation().aim(tube.continuation().last);
    let mut state = star.state.clone();
    let outcome = open((&mut *solver, post), &mut state, aim, [radius, radius + BEYOND])
        .and_then(|()| rest_around(&mut *solver, post, &mut state, aim, radius));
    let closing_force = solver.contact.as_ref().map_or(0.0, |contact| contact.force(post));
    solver.contact = former_contact;
    match outcome {
        Ok(()) => Ok(Some(Hysteresis { radius, opening_force, closing_force })),
        Err(Stop::Cancelled) => Err(tube.stopped(Stop::Cancelled, solver.triangles())),
        Err(_) => Ok(None),
    }
}

/// Solves for an equilibrium around an object of `radius`, from `state`.
fn rest_around(
    solver: &mut Solver,
    post: usize,
    state: &mut State,
    aim: Aim,
    radius: f64,
) -> Result<(), Stop> {
    if let Some(contact) = &mut solver.contact {
        contact.replace(post, Obstacle::Post { radius });
    }
    solver.rest(state, aim).map(|_| ())
}

/// Distance of the star's innermost point from the axis.
fn nearest(state: &State) -> f64 {
    state.points.iter().map(|x| libm::hypot(x[0], x[1])).fold(f64::INFINITY, f64::min)
}

/// Round objects that a star is pressed against, smallest first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objects<'a> {
    /// By their radii, m.
    Radii(&'a [f64]),
    /// By how much wider than the star at rest they are, m, on each mesh: meshes agree better on the force against the opening
    /// than on the rest. Those that a mesh does not reach are not numbers.
    Openings(&'a [f64]),
}

impl Objects<'_> {
    /// Radius of the largest, by the width of `tube`, around a star at rest in `state`; `None` without objects.
    pub(super) fn largest(&self, tube: &Tube, state: &State) -> Option<f64> {
        let origin = if matches!(self, Self::Openings(_)) { nearest(state) } else { 0.0 };
        self.sizes().last().map(|size| origin + size / tube.width)
    }

    pub(super) fn sizes(&self) -> &[f64] {
        match self {
            Self::Radii(sizes) | Self::Openings(sizes) => sizes,
        }
    }
}

/// Opens the star by each object in turn. Returns the force of one sheet of the modelled part on each, and how far it slides on each; 0
/// behind the last object. It starts from the coarser mesh's result for each, if there is one and it leads to an equilibrium, and keeps
/// its own results in `indented`.
pub(super) fn press(
    tube: &Tube,
    objects: Objects<'_>,
    (solver, post): (&mut Solver, usize),
    equilibrium: &Equilibrium,
    indented: &mut Vec<Indented>,
) -> Result<[[f64; MOST_OBJECTS]; 2], ShellFault> {
    let [mut forces, mut slips] = [[0.0; MOST_OBJECTS]; 2];
    let mut starts = std::mem::take(indented).into_iter();
    let mut state = equilibrium.state.clone();
    let innermost = nearest(&state);
    let origin = if matches!(objects, Objects::Openings(_)) { innermost } else { 0.0 };
    let mut radius = innermost;
    let aim = tube.continuation().aim(equilibrium.pressure);
    for (index, size) in objects.sizes().iter().enumerate() {
        let last = (origin + size / tube.width).max(innermost);
        let outcome = match starts.next() {
            Some(start) => open_from(start, (solver, post), &mut state, aim, [radius, last]),
            None => open((solver, post), &mut state, aim, [radius, last]),
        };
        match outcome {
            Ok(()) => indented.push(Indented { state: state.clone(), contact: solver.contact.clone() }),
            Err(why) if why == Stop::Cancelled || origin == 0.0 => {
                return Err(tube.stopped(why, solver.triangles()));
            }
            Err(_) => {
                forces[index..].fill(f64::NAN);
                slips[index..].fill(f64::NAN);
                break;
            }
        }
        radius = last;
        slips[index] = solver.slip(post, &state);
        forces[index] = solver.contact.as_ref().map_or(0.0, |contact| contact.force(post));
    }
    Ok([forces, slips])
}

/// As [`open`], but at once where the coarser mesh's result leads to an equilibrium.
fn open_from(
    Indented { state: mut start, contact }: Indented,
    (solver, post): (&mut Solver, usize),
    state: &mut State,
    aim: Aim,
    [from, to]: [f64; 2],
) -> Result<(), Stop> {
    let former_contact = std::mem::replace(&mut solver.contact, contact);
    solver.is_rough = true;
    match rest_around(&mut *solver, post, &mut start, aim, to) {
        Ok(()) => {
            *state = start;
            Ok(())
        }
        Err(Stop::Cancelled) => Err(Stop::Cancelled),
        Err(_) => {
            solver.contact = former_contact;
            open((solver, post), state, aim, [from, to])
        }
    }
}

/// Widens the object from one radius to another, by W, as fast as the star follows, by at most [`GROWTH`] in one solve.
fn open(
    (solver, post): (&mut Solver, usize),
    state: &mut State,
    aim: Aim,
    [from, to]: [f64; 2],
) -> Result<(), Stop> {
    let (mut radius, mut growth) = (from, GROWTH);
    while radius < to {
        let (start, pressed) = (state.clone(), solver.contact.clone());
        let next = if to - radius < 1.001 * growth { to } else { radius + growth };
        match rest_around(&mut *solver, post, state, aim, next) {
            Ok(()) => {
                radius = next;
                // A stiffness that was enough for this step saves the next one rounds.
                if let Some(contact) = &mut solver.contact {
                    contact.floor = contact.stiffness / 4.0;
                }
            }
            Err(why) if why == Stop::Cancelled || growth < GROWTH * 0.5_f64.powi(MOST_HALVINGS) => {
                return Err(why);
            }
            Err(_) => {
                state.clone_from(&start);
                solver.contact = pressed;
                growth /= 2.0;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::assembly::Sheet;
    use crate::shell::cases::sector::ModelledSector;
    use crate::shell::cases::tests::tube;
    use crate::shell::contact::Contact;
    use crate::shell::element::vector::{Vector, dot, times};
    use crate::shell::mesh::{HalfSector, MarginWidths, Sizes};
    use crate::shell::solver::DisplacementControl;

    /// The force after loads along the object, for each point that slides `friction` times its force against its sliding, and the friction
    /// that it came to.
    fn with_friction(
        (solver, post): (&mut Solver, usize),
        state: &State,
        aim: Aim,
        friction: f64,
    ) -> (f64, f64) {
        let mut state = state.clone();
        // The last factor may be that of another load.
        let _ = solver.rest(&mut state, aim).expect("an equilibrium");
        let former_contact = solver.contact.clone();
        let slides = solver.slides(post, &state).into_iter();
        let loads: Vec<(usize, Vector)> = slides
            .map(|(touching, slide)| {
                (touching.point, times(touching.force / dot(slide, slide).sqrt(), slide))
            })
            .collect();
        let drag = -friction * solver.compliance(&loads);
        let row = solver.assembly.project(&loads);
        solver.lever = Some(DisplacementControl { row, point: 0, direction: [1.0, 0.0, 0.0], brace: 0.0 });
        assert!(solver.pull(&mut state, aim, drag));
        let _ = solver.rest(&mut state, aim).expect("an equilibrium");
        solver.lever = None;
        let contact = std::mem::replace(&mut solver.contact, former_contact).expect("contact");
        (contact.force(post), solver.multiplier)
    }

    /// The paper's star at 37 kPa on a coarse mesh, inflated, with its object as the last obstacle.
    fn inflated() -> (Solver, usize, State, Aim) {
        inflated_star(5, &tube(0.03, 37e3), 8.0)
    }

    /// The paper's star of `points` points with this tube, on a mesh with so many edges across the tube.
    fn inflated_star(points: u32, paper_tube: &Tube, cells: f64) -> (Solver, usize, State, Aim) {
        let sector = HalfSector {
            n: points,
            rho_0: 5.0 / 3.0,
            w: 1.0,
            phi_i: 30.0_f64.to_radians(),
            r_i: 1.0 / 30.0,
            r_e: 1.0 / 30.0,
        };
        let modelled = ModelledSector { sector, margin: MarginWidths::default() };
        let mesh = modelled.meshed(&Sizes::for_tube(1.0, cells)).expect("a mesh").mesh;
        let (sheet, supports) = (Sheet::new(&mesh, paper_tube.scaled()), modelled.supports(&mesh));
        let mut solver = Solver::new(sheet, supports).expect("small");
        let obstacles = modelled.obstacles();
        let post = obstacles.len() - 1;
        solver.contact = Some(Contact::new(&solver.assembly, obstacles));
        let equilibrium = paper_tube.continuation().run(&mut solver, |_| {}).expect("an equilibrium");
        let aim = paper_tube.continuation().aim(equilibrium.pressure);
        (solver, post, equilibrium.state, aim)
    }

    /// Around one object a star of three points has one shape; around a wider one it has two, and presses less once it was further open.
    #[test]
    fn a_snap_is_two_forces_on_one_object() {
        let paper_tube = tube(0.03, 14e3);
        let (mut solver, post, mut state, aim) = inflated_star(3, &paper_tube, 10.0);
        let rest = nearest(&state);
        let mut radius = rest;
        let [single, double] = [0.3, 0.45].map(|opening| {
            open((&mut solver, post), &mut state, aim, [radius, rest + opening]).expect("an equilibrium");
            radius = rest + opening;
            let star = Indented { state: state.clone(), contact: solver.contact.clone() };
            let forces = hysteresis(&paper_tube, &mut solver, post, &star, radius).expect("not cancelled");
            let [before, after] =
                [&star.contact, &solver.contact].map(|contact| contact.as_ref().map(|c| c.force(post)));
            assert_eq!(before, after, "the contact is as before");
            forces.expect("it presses")
        });
        assert!(!single.is_snap() && single.difference() < 1e-3, "{single:?}");
        assert!(double.is_snap() && double.closing_force < 0.9 * double.opening_force, "{double:?}");
    }

    #[test]
    fn friction_changes_the_force_as_the_slip_says() {
        let (mut solver, post, mut state, aim) = inflated();
        let mut largest = 0.0_f64;
        for radius in [1.25, 1.35, 1.45] {
            open((&mut solver, post), &mut state, aim, [radius - 0.4, radius]).expect("an equilibrium");
            let (slip, force) =
                (solver.slip(post, &state), solver.contact.as_ref().expect("contact").force(post));
            largest = slip.max(largest);
            for friction in [-0.2, 0.2] {
                let (changed, friction) = with_friction((&mut solver, post), &state, aim, friction);
                let error = changed / force - 1.0 - friction * slip;
                assert!(error.abs() < 0.003, "R {radius}, friction {friction}, slip {slip}: {error}");
            }
        }
        assert!(largest > 0.1, "friction changes the force by more than the test tolerates: {largest}");
    }

    /// Points that stick stay where they are while the object grows. Their force is still the energy's slope, and it rises faster than that of
    /// points that slide.
    #[test]
    fn points_that_stick_hold_an_opening_back() {
        let (mut solver, post, mut state, aim) = inflated();
        open((&mut solver, post), &mut state, aim, [1.0, 1.35]).expect("an equilibrium");
        let sliding = solver.contact.clone();
        let touching = solver.contact.as_ref().expect("contact").touching(post, &state);
        solver.contact.as_mut().expect("contact").stick(post, aim.pressure);
        let _ = solver.rest(&mut state, aim).expect("an equilibrium");
        let sticking = solver.contact.clone();
        let mut opened = |contact: &Option<Contact>, growth: f64| {
            let mut opened = state.clone();
            solver.contact.clone_from(contact);
            solver.contact.as_mut().expect("contact").replace(post, Obstacle::Post { radius: 1.35 + growth });
            let rest = solver.rest(&mut opened, aim).expect("an equilibrium");
            let turned_by = |point: usize| {
                let [angle, old_angle] = [&opened, &state]
                    .map(|shape| libm::atan2(shape.points[point][1], shape.points[point][0]));
                (angle - old_angle).abs()
            };
            let farthest = touching.iter().map(|one| turned_by(one.point)).fold(0.0, f64::max);
            let energy = rest.energy.total(aim.pressure);
            (solver.contact.as_ref().expect("contact").force(post), energy, farthest)
        };
        let step = 2e-3;
        let [(_, below, _), (force, _, _), (sticking_force, above, sticking_slip)] =
            [-step, 0.0, step].map(|growth| opened(&sticking, growth));
        let (slid, _, slides) = opened(&sliding, step);
        let slope = (above - below) / (2.0 * step);
        assert!((slope / force - 1.0).abs() < 1e-4, "{slope} {force}");
        assert!(
            sticking_force - force > 1.5 * (slid - force) && slid > force,
            "{sticking_force} {slid} {force}"
        );
        assert!(sticking_slip < 0.05 * slides, "{sticking_slip} {slides}");
    }
}
