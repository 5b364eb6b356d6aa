//! The forecast of one star's seal, for any model of the star.

use crate::case::Case;
use crate::interval::Interval;
use crate::prediction::Hinges;
use crate::ranges::StarRanges;
use crate::seal_load::{
    Bursting, burst, burst_range, factor, largest_pull, possible_radius, remedy, sharpest_need,
    weakest_bounds,
};
use design::Star;
use inflatable::mechanics::hinge::ring::Ring;
use spec::Spec;
use spec::units::{Length, LineForce, Pressure};

/// N per mm from N per m.
pub(super) fn per_mm(pull: f64) -> f64 {
    LineForce::from_newtons_per_metre(pull).0
}

/// The load on the seal at the radii that the band gives the hinges, for any model.
pub(super) struct SealForecast {
    pub(super) load: Hinges<Option<f64>>,
    pub(super) pull: Option<(f64, Option<Interval>, &'static str)>,
    pub(super) burst: Option<f64>,
    burst_range: Option<Interval>,
    /// The least and most pressure, Pa, at which it may burst.
    bounds: Option<Interval>,
    pub(super) bursting: Option<Bursting>,
    /// The inner radius of tips and corners from which it surely holds, if it does not and there is such a star.
    pub(super) safe: Option<Length>,
}

impl SealForecast {
    pub(super) fn new(spec: &Spec, case: &Case, star: &Star) -> Self {
        let [tip, corner] = [case.realised.tip, case.realised.corner]
            .map(|radius| factor(&Ring, radius / case.mechanism.width));
        let (burst, burst_range) = (burst(case, &Ring), burst_range(case));
        // They differ only for hinges that are too sharp for a range.
        let bounds = burst_range.or_else(|| weakest_bounds(case));
        let bursting = burst.zip(case.pressure).map(|(burst, p)| Bursting::at_pressure(p, burst, bounds));
        let bursts = bursting.is_some_and(|at| at != Bursting::No);
        Self {
            load: Hinges { tip, corner },
            pull: largest_pull(case),
            burst,
            burst_range,
            bounds,
            bursting,
            safe: if bursts { possible_radius(spec, case, star, sharpest_need(case)) } else { None },
        }
    }

    /// The largest pressure, Pa, at which it surely does not burst; `None` if no seal is known.
    pub(super) fn safe_pressure(&self) -> Option<f64> {
        self.bounds.map(|[lowest, _]| lowest)
    }

    pub(super) fn ranges(&self) -> StarRanges {
        StarRanges {
            seal_pull_N_per_mm: self.pull.and_then(|(_, range, _)| range).map(|range| range.map(per_mm)),
            burst_pressure_kPa: self.burst_range.map(|range| range.map(|p| Pressure::from_pascals(p).0)),
            ..StarRanges::default()
        }
    }

    pub(super) fn warning(&self) -> Option<String> {
        let (burst, bursting) = self.burst.zip(self.bursting)?;
        let finding = match bursting {
            Bursting::No => return None,
            Bursting::Perhaps if self.burst_range.is_none() => {
                "the seal may burst: the range of its burst pressure is unknown"
            }
            Bursting::Perhaps => "the seal may burst: the pressure is within the range of its burst pressure",
            Bursting::Yes => "the pressure is above the seal's burst pressure",
        };
        Some(format!("{finding}, {:.2} kPa; {}", Pressure::from_pascals(burst).0, remedy(self.safe)))
    }
}
