//! The residuals of one computed star.

use crate::predicted::{SETTLED, predicted};
use crate::stars::computed::{ComputedStar, MeshedNumber};
use inflatable::mechanics::star::Correction;
use inflatable::mechanics::star::residuals::{OPENINGS, Residuals, StarPlace, WEIGHTS, place};
use std::cell::Cell;

/// A residual with the mesh error of the shell's number.
pub type Residual = (f64, f64);

/// A computed star, its ratios, and its residuals in the order of the weights; `None` where the number is missing, or not settled.
pub struct ResidualSample {
    /// Ratios of the star.
    pub place: StarPlace,
    /// Residuals of the star.
    pub residuals: [Option<Residual>; WEIGHTS],
}

/// The residuals of `star` where its angle is `angle` (rad) further open than that of the closed form.
pub(super) fn sample(star: &ComputedStar, angle: f64) -> Option<ResidualSample> {
    let numbers = star.found.as_ref()?;
    let place_cell = Cell::new(None);
    let moved = Residuals { angle, ..Residuals::default() };
    let residuals = predicted(
        &star.star,
        |moves, width, ratios| {
            place_cell.set(Some(place(moves, ratios)));
            Correction::trend(moves, width, ratios).with_residuals(&moved)
        },
        |case, inflated, own| {
            let (moves, rest) = (&case.mechanism, &own.rest);
            let unit = 1e3 * moves.width / moves.sector_sine();
            // Where arms touch, contact is part of the angle and the stiffness.
            let has_no_contact =
                numbers.arm_contact.value == 0.0 && rest.equilibrium > moves.correction.contact_angle;
            let MeshedNumber { value, error } = numbers.angle;
            let tips = (value.to_radians() - rest.equilibrium, error.to_radians());
            let radius = ((numbers.radius.value - 1e3 * rest.radius) / unit, numbers.radius.error / unit);
            let MeshedNumber { value: stiffness, error } = numbers.stiffness;
            let open = error / stiffness.abs();
            let spring = ((1e3 * stiffness / rest.stiffness).ln(), open);
            let force = |part: f64| {
                let (_, secant) = numbers.secants.iter().find(|(opening, _)| *opening == part)?;
                let opening = part * moves.width;
                let shell = secant.value * 1e3 * stiffness * opening;
                let passes = 1e-3 * numbers.radius.value + opening <= case.inner_radius;
                let settled = secant.error.abs() < SETTLED * secant.value && passes;
                let force = inflated.linear_force(rest.radius + opening, rest).ok()?;
                settled.then(|| ((shell / force).ln(), open + secant.error / secant.value))
            };
            let settled = has_no_contact && open < SETTLED && stiffness > 0.0;
            let [a, b, c] = OPENINGS.map(|part| force(part).filter(|_| settled));
            Some([has_no_contact.then_some(tips), Some(radius), settled.then_some(spring), a, b, c])
        },
    )?;
    // As the table has it.
    Some(ResidualSample { place: place_cell.take()?.map(|ratio| (1e5 * ratio).round() / 1e5), residuals })
}
