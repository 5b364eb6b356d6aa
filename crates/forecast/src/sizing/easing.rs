//! Easing of requirements: how each of them can be given up, and by how little that is enough.
//!
//! A requirement is given up first. If that gives a gripper, a bisection goes back towards what was required, in round values, as far as
//! a gripper is found. Each value that is returned was searched for as it is.

use crate::candidate::Candidate;
use crate::load_check::COATED;
use crate::optimize::SEARCHED;
use crate::sizing::{Choice, ENDLESS, MARGIN, NearestRequirements, Requirements, Workspace, feasible};
use geom::order::sort_by;
use inflatable::mechanics::hinge::ring::RingTable;
use spec::units::{Force, Length, Mass, Pressure, factor};

/// A requirement that can be eased.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Requirement {
    /// More friction between the corners and the object.
    Friction,
    /// Another pressure.
    Pressure,
    /// A larger sheet.
    Sheet,
    /// An object that bears more.
    Force,
    /// A lighter object.
    Mass,
    /// A machine that reaches farther.
    Machine,
    /// An object of another size.
    Size,
}

/// A mass that every gripper carries, kg.
const NO_MASS: Mass = Mass(1e-6);
/// Most trials of one bisection: of a range of a factor of 10^7 they leave 1 %.
const TRIALS: u32 = 12;
/// A bisection ends where the relative difference is smaller.
const CLOSE: f64 = 0.01;
/// Most doublings of a value that the best gripper without a limit was expected to meet: its flap may press much harder than its tube.
const DOUBLINGS: i32 = 6;
/// Factors by which values beyond the end of a bisection are tried.
const BEYOND: [f64; 2] = [1.12, 1.06];
/// Diameters of objects that are tried where the one that is required is of a size for which no gripper was found, mm.
const SIZES: [f64; 12] = [8.0, 12.0, 20.0, 30.0, 50.0, 80.0, 120.0, 200.0, 300.0, 450.0, 700.0, 1000.0];

/// The search for grippers: the base of all candidates, and the ring's table.
#[derive(Clone, Copy)]
pub(super) struct Finder<'a> {
    pub(super) base: &'a Candidate,
    pub(super) ring: &'a RingTable,
}

impl Finder<'_> {
    /// The grippers that meet `requirements`; `None` if there is none.
    pub(super) fn grippers(&self, requirements: &Requirements) -> Option<NearestRequirements> {
        let choices = feasible(requirements, self.base, self.ring);
        (!choices.is_empty()).then_some(NearestRequirements { requirements: *requirements, choices })
    }

    /// `required`, with each of `requirements` eased as little as is enough; `None` if no gripper is found without them.
    ///
    /// All are given up at once, then tightened again one after the other.
    pub(super) fn eased(
        &self,
        required: &Requirements,
        requirements: &[Requirement],
    ) -> Option<NearestRequirements> {
        let loosest = requirements
            .iter()
            .try_fold(*required, |loosened, requirement| requirement.given_up(&loosened))?;
        let mut nearest = match requirements {
            [Requirement::Size] => self.of_a_usual_size(&loosest)?,
            _ => self.grippers(&loosest)?,
        };
        for requirement in requirements {
            nearest = self.tightened(required, *requirement, nearest);
        }
        // A side of the sheet that was long enough stays.
        let (sheet, needed_sheet) = (required.room.sheet, &mut nearest.requirements.room.sheet);
        *needed_sheet = [needed_sheet[0].0.max(sheet[0].0), needed_sheet[1].0.max(sheet[1].0)].map(Length);
        Some(nearest)
    }

    /// `required` with the object of the usual size that is nearest to its own and has a gripper.
    fn of_a_usual_size(&self, required: &Requirements) -> Option<NearestRequirements> {
        let distance = |size: &f64| libm::fabs(libm::log(0.5 * size / required.object.0));
        let mut sizes = SIZES;
        sort_by(&mut sizes, |a, b| distance(a).total_cmp(&distance(b)));
        sizes.into_iter().find_map(|size| self.grippers(&Requirement::Size.with_value(required, 0.5 * size)))
    }

    /// The grippers that meet `loose` with the first of the values `start`, twice as much, and so on that is granted.
    fn first_granted(
        &self,
        easing: Requirement,
        loose: &Requirements,
        start: f64,
    ) -> Option<NearestRequirements> {
        (0..=DOUBLINGS).find_map(|doublings| {
            let value = easing.rounded(loose, start * 2.0_f64.powi(doublings), f64::INFINITY);
            self.grippers(&easing.with_value(loose, value))
        })
    }

    /// `loose`, which has grippers, with the value that `easing` changed as near to the one that is `required` as a bisection comes.
    fn tightened(
        &self,
        required: &Requirements,
        easing: Requirement,
        loose: NearestRequirements,
    ) -> NearestRequirements {
        let mut nearest = if easing.value(&loose.requirements).is_finite() {
            loose
        } else {
            match easing
                .sufficient_value(&loose)
                .and_then(|start| self.first_granted(easing, &loose.requirements, start))
            {
                Some(nearest) => nearest,
                None => return loose,
            }
        };
        let mut refused = easing.value(required);
        for _ in 0..TRIALS {
            let granted = easing.value(&nearest.requirements);
            let Some(middle) = easing.round_value(&nearest.requirements, granted, refused) else { break };
            match self.grippers(&easing.with_value(&nearest.requirements, middle)) {
                Some(nearer) => nearest = nearer,
                None => refused = middle,
            }
        }
        // Near the limit a search misses some grippers: beyond a value without one there may be others with one.
        for factor in BEYOND {
            let (granted, last) = (easing.value(&nearest.requirements), easing.value(required));
            let value = if last > granted { granted * factor } else { granted / factor };
            let value = easing.rounded(&nearest.requirements, value, granted);
            if (value - granted) * (last - value) > 0.0 {
                nearest = self.grippers(&easing.with_value(&nearest.requirements, value)).unwrap_or(nearest);
            }
        }
        nearest
    }
}

impl Requirement {
    /// The requirement is one that `required` has, and can be given up.
    pub(super) fn applies(self, required: &Requirements) -> bool {
        self.given_up(required).is_some_and(|eased| eased != *required)
    }

    /// `required` without this requirement; `None` if it cannot be eased.
    pub(super) fn given_up(self, required: &Requirements) -> Option<Requirements> {
        let Requirements { room, .. } = *required;
        Some(match self {
            Self::Friction if required.friction < COATED => self.with_value(required, COATED),
            Self::Friction => return None,
            Self::Pressure => Requirements { pressure: None, ..*required },
            Self::Sheet => Requirements { room: Workspace { sheet: ENDLESS, ..room }, ..*required },
            Self::Machine => Requirements { room: Workspace { machine: ENDLESS, ..room }, ..*required },
            Self::Force => Requirements { largest_force: None, ..*required },
            Self::Mass => Requirements { mass: Mass(NO_MASS.0.min(required.mass.0)), ..*required },
            Self::Size => *required,
        })
    }

    /// A value that the best gripper of `loose`, which has none, may meet; of a force without its flap.
    fn sufficient_value(self, loose: &NearestRequirements) -> Option<f64> {
        let best = &loose.choices.first()?.best;
        match self {
            Self::Pressure => best.point.load.pressure.map(|pressure| pressure.0),
            Self::Sheet | Self::Machine => star_diameter(loose),
            // A search keeps its margin to this limit, and rounding takes a part of it.
            Self::Force => Some(1.1 * MARGIN * best.answer.grip.as_ref()?.force_range?[1] / SEARCHED),
            Self::Friction | Self::Mass | Self::Size => None,
        }
    }

    /// The value in `required`; of a sheet or a machine the largest diameter of a star, mm.
    pub(super) fn value(self, required: &Requirements) -> f64 {
        match self {
            Self::Friction => required.friction,
            Self::Pressure => required.pressure.map_or(f64::INFINITY, |pressure| pressure.0),
            Self::Sheet => required.room.diameter_on(&required.room.sheet),
            Self::Machine => required.room.diameter_on(&required.room.machine),
            Self::Force => required.largest_force.map_or(f64::INFINITY, |force| force.0),
            Self::Mass => required.mass.0,
            Self::Size => required.object.0,
        }
    }

    /// `required` with this value.
    pub(super) fn with_value(self, required: &Requirements, value: f64) -> Requirements {
        let Requirements { room, .. } = *required;
        match self {
            Self::Friction => Requirements { friction: value, friction_assumed: false, ..*required },
            Self::Pressure => Requirements { pressure: Some(Pressure(value)), ..*required },
            Self::Sheet => {
                let sheet = room.area_for(value);
                Requirements { room: Workspace { sheet, ..room }, ..*required }
            }
            Self::Machine => {
                let machine = room.area_for(value);
                Requirements { room: Workspace { machine, ..room }, ..*required }
            }
            Self::Force => Requirements { largest_force: Some(Force(value)), ..*required },
            Self::Mass => Requirements { mass: Mass(value), ..*required },
            Self::Size => Requirements { object: Length(value), ..*required },
        }
    }

    /// The unit of its values in `required`, and the step of round values near `value`, in that unit: two digits, a hundredth of a
    /// friction, or a millimetre.
    fn grid(self, required: &Requirements, value: f64) -> [f64; 2] {
        let units = &required.units;
        let unit = match self {
            Self::Friction => return [1.0, 0.01],
            Self::Sheet | Self::Machine => return [1.0, 1.0],
            Self::Pressure => factor::<Pressure>(units.pressure),
            Self::Force => factor::<Force>(units.force),
            Self::Mass => factor::<Mass>(units.mass),
            // The radius of an object whose width is a round number.
            Self::Size => 0.5 * factor::<Length>(units.object),
        };
        [unit, libm::pow(10.0, libm::log10(value / unit).floor() - 1.0)]
    }

    /// `value`, rounded towards `granted`.
    fn rounded(self, required: &Requirements, value: f64, granted: f64) -> f64 {
        let [unit, step] = self.grid(required, value);
        let steps = value / unit / step;
        let steps =
            if granted < value { (steps * (1.0 + 1e-12)).floor() } else { (steps * (1.0 - 1e-12)).ceil() };
        // Divided by a whole number: 0.35, not 0.35000000000000003.
        if step < 1.0 { steps / (1.0 / step).round() * unit } else { steps * step * unit }
    }

    /// A round value between `granted` and `refused`, near their geometric mean; `None` if they are neighbours.
    fn round_value(self, required: &Requirements, granted: f64, refused: f64) -> Option<f64> {
        if !refused.is_finite() || libm::fabs(granted / refused - 1.0) < CLOSE {
            return None;
        }
        let mean = (refused * granted).sqrt();
        let candidates = [granted, refused].map(|end| self.rounded(required, mean, end));
        // Of a value that was rounded to an end, the last digit may differ.
        candidates.into_iter().find(|value| {
            [granted, refused].iter().all(|end| libm::fabs(value - end) > 1e-9 * value)
                && (value - refused) * (granted - value) > 0.0
        })
    }
}

/// The diameter of the best star of `nearest` with its band and allowance, mm.
fn star_diameter(nearest: &NearestRequirements) -> Option<f64> {
    let Choice { best, .. } = nearest.choices.first()?;
    let seal = &best.point.seal;
    Some(2.0 * (best.answer.star.tip_reach() + seal.band.0 + seal.allowance.0))
}
