//! How far a sheet slides along an object that it presses on, which bounds what friction does.
//!
//! Let Phi(R, t) be the least energy with an object of radius R and dead loads t on the points. Then F = dPhi/dR and -u = dPhi/dt, so
//! dF/dt = -du/dR: a load along the object changes the force by what it does against the sliding of its point for each unit of R. Friction mu
//! bears at most mu times the normal force N of each point, in any direction and after any history. To first order in mu the force then
//! lies within F (1 +- mu s), where s is the mean of |du/dR| along the object, weighted by N. It reaches the upper end where the object grows
//! and the lower one where it shrinks, with all points sliding.

use crate::shell::assembly::State;
use crate::shell::contact::ContactPoint;
use crate::shell::element::vector::{Vector, add_scaled, dot, minus, times};
use crate::shell::solver::factor::EXACT;
use crate::shell::solver::newton::Solver;

impl Solver {
    /// s at the last equilibrium, `state`, whose factor is the last one; 0 where nothing touches.
    pub(crate) fn slip(&mut self, obstacle: usize, state: &State) -> f64 {
        let slides = self.slides(obstacle, state);
        let total_force: f64 = slides.iter().map(|(point, _)| point.force).sum();
        if total_force > 0.0 {
            slides.iter().map(|(point, slide)| point.force * dot(*slide, *slide).sqrt()).sum::<f64>()
                / total_force
        } else {
            0.0
        }
    }

    /// The points that touch, and du/dR of each along the object.
    pub(crate) fn slides(&mut self, obstacle: usize, state: &State) -> Vec<(ContactPoint, Vector)> {
        let Some(contact) = &self.contact else { return Vec::new() };
        let touching = contact.touching(obstacle, state);
        let loads: Vec<_> =
            touching.iter().map(|one| (one.point, times(contact.stiffness * one.area, one.normal))).collect();
        let mut answer = self.assembly.project(&loads);
        self.factor.solve(&mut answer, EXACT);
        let mut moved = state.clone();
        self.assembly.advance(&mut moved, &answer, 1.0);
        let slide = |one: ContactPoint| {
            let motion = minus(moved.points[one.point], state.points[one.point]);
            (one, add_scaled(motion, -dot(motion, one.normal), one.normal))
        };
        touching.into_iter().map(slide).collect()
    }
}
