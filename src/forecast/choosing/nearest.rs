//! Grippers for a wish, or what comes nearest to one that cannot be had: a wish that differs from it in as little as will do, and is granted.

use crate::forecast::candidate::Candidate;
use crate::forecast::choosing::{Choice, Lack, MOST_STARS, Room, SEARCHED_MARGIN, Wish, granted, no_tube};
use crate::forecast::optimize::{Bounds, Constraints, Effort, Goal, Search, sure_payload};
use crate::mechanics::hinge::ring::RingTable;
use crate::units::{Length, Mass};

/// A wish that cannot be had, and what comes nearest.
#[derive(Clone, Debug, PartialEq)]
pub struct Miss {
    /// What cannot be had, one sentence each.
    pub reasons: Vec<String>,
    /// What can; `None` if nothing was found that is near.
    pub nearest: Option<Box<Nearest>>,
}

/// A wish that is granted in place of another, and its grippers.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// What can be had: less mass, a larger sheet, any pressure, an object that bears more, or an object of another size.
    pub wish: Wish,
    /// How, the best first.
    pub choices: Vec<Choice>,
}

/// Sheets are taken larger by this, mm: they are cut by hand.
const SHEET: f64 = 10.0;
/// Parts of the most mass that are tried: near the most there are few grippers, and a search may miss them.
const RESERVES: [f64; 3] = [0.9, 0.7, 0.4];
/// Sizes of objects that are tried where nothing else helps, over the one wished for.
const SIZES: [f64; 4] = [0.7, 0.4, 0.2, 2.0];

/// The grippers for `wish`, the best first, from `base`: its fabric, seal and radii of curvature.
///
/// # Errors
/// If there is none.
pub fn choose(wish: &Wish, base: &Candidate, ring: &RingTable) -> Result<Vec<Choice>, Miss> {
    granted(wish, base, ring).map_err(|lack| match lack {
        Lack::Star(best) => Miss {
            reasons: wish.reasons(base, best.as_deref()),
            nearest: nearest(wish, base, ring).map(Box::new),
        },
        Lack::Tube => Miss { reasons: vec![no_tube(base)], nearest: None },
    })
}

/// What comes nearest to `wish`, which is not granted.
fn nearest(wish: &Wish, base: &Candidate, ring: &RingTable) -> Option<Nearest> {
    let tried = |wish: Wish| {
        let choices = granted(&wish, base, ring).ok()?;
        Some(Nearest { wish, choices })
    };
    if let Some(most) = heaviest(wish, base, ring) {
        let most = most.min(wish.mass.0);
        return RESERVES
            .into_iter()
            .find_map(|part| tried(Wish { mass: three_digits(part * most)?, ..*wish }));
    }
    // It is not the mass: one thing less, then all of them, and then there is the object itself.
    let endless = Room { sheet: None, ..wish.room };
    let free = Wish { pressure: None, largest_force: None, room: endless, ..*wish };
    let of_size = |factor: f64| Wish { object: Length((factor * wish.object.0).round().max(1.0)), ..free };
    wish.room
        .sheet
        .and_then(|_| on_larger_sheet(wish, base, ring))
        .or_else(|| wish.pressure.and_then(|_| tried(Wish { pressure: None, ..*wish })))
        .or_else(|| wish.largest_force.and_then(|_| tried(Wish { largest_force: None, ..*wish })))
        .or_else(|| (free != *wish).then(|| tried(free)).flatten())
        .or_else(|| SIZES.into_iter().map(of_size).find_map(tried))
}

/// The most mass that can be counted on with all else granted, kg; `None` if nothing else is.
fn heaviest(wish: &Wish, base: &Candidate, ring: &RingTable) -> Option<f64> {
    let base = wish.candidate(base);
    let bounds = Bounds { stars: 1..=MOST_STARS, ..wish.bounds(&base)? };
    let constraints = Constraints { payload: None, ..wish.constraints(&base, 1.0) };
    let search = Search {
        base: &base,
        bounds: &bounds,
        constraints: &constraints,
        goal: Goal::Payload,
        table: ring,
        effort: Effort::QUICK,
        cancel: None,
    };
    let most = search.run().best.into_iter().find(|one| one.violation == 0.0)?;
    Some(sure_payload(&most.point, &most.answer)? / SEARCHED_MARGIN)
}

/// A mass rounded down to three digits and whole milligrams; `None` if nothing is left.
pub(super) fn three_digits(mass: f64) -> Option<Mass> {
    let digit = 10_f64.powf(mass.log10().floor() - 2.0);
    let mass = ((mass / digit).floor() * digit * 1e6).round() / 1e6;
    (mass > 0.0).then_some(Mass(mass))
}

/// The same on a sheet that is as large as it must be, as far as the machine reaches.
fn on_larger_sheet(wish: &Wish, base: &Candidate, ring: &RingTable) -> Option<Nearest> {
    let endless = Wish { room: Room { sheet: None, ..wish.room }, ..*wish };
    let choices = granted(&endless, base, ring).ok()?;
    let best = &choices.first()?.best;
    let reach = best.answer.star.tip_reach() + best.point.seal.band.0 + best.point.seal.allowance.0;
    let side = Length(((2.0 * reach + wish.room.edge.0) / SHEET).ceil() * SHEET);
    let exact = Wish { room: Room { sheet: Some(side), ..wish.room }, ..*wish };
    match granted(&exact, base, ring) {
        Ok(choices) => Some(Nearest { wish: exact, choices }),
        Err(_) => Some(Nearest { wish: endless, choices }),
    }
}
