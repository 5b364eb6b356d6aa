//! Ranges of a drawn chamber whose shape its mesh errors alone do not bound: folds that are too fine to resolve, or two stable shapes.
//!
//! Where wrinkles are blended or a second shape was found, a range contains every shape with its error. Where folds are finer still, or
//! no shape with folds was found, all wrinkles are averaged. A sheet that bears no compression inflates higher and narrower than one whose folds are stiff, and its folds pull less
//! on the seal. The bounds of its ranges contain shells with resolved wrinkles of square pouches of 40 and 100 mm, a disc of 100 mm, bent tubes and
//! V-actuators, at 1/eps from 1,000 to 30,000 (docs/drawings.md). There the difference falls as the root of 1/eps.

use crate::interval::{Interval, hull};
use crate::meshed::{MeshedPlace, MeshedValue, six, with_error};
use inflatable::shell::cases::{InflatedRegion, Value, Wrinkles};
use serde::Serialize;

/// 1/eps at which the bounds of averaged wrinkles were measured.
const MEASURED: f64 = 1000.0;
/// By how much of itself a resolved shell is less high at 1/eps = 1,000: 11.3 mm where the averaged one has 19.8 mm.
const HEIGHT: f64 = 0.45;
/// By how much of itself the volume of a resolved shell is less there, and more by [`MORE_VOLUME`] at any 1/eps: a square of film.
const VOLUME: f64 = 0.22;
const MORE_VOLUME: f64 = 0.01;
/// By how much of itself an extent differs there: pouches are wider by a tenth, bent tubes coil less, by up to 0.04 of lambda.
const EXTENT: f64 = 0.15;
/// The largest pull of a resolved shell over that of the averaged one: 0.178 and 0.062 N/mm at 1/eps = 1,000.
const PULL: f64 = 3.0;

/// Ranges of a chamber's numbers, mesh errors included, in their units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ShapeRanges {
    /// Range of the largest distance between the sheets.
    pub height_mm: Interval,
    /// Ranges of the extents along x and y.
    pub extents_mm: [Interval; 2],
    /// Range of the volume.
    pub volume_mm3: Interval,
    /// Range of the largest pull on a seam.
    pub seal_pull_N_per_mm: Interval,
}

impl ShapeRanges {
    /// The ranges of `region`; `None` where the mesh errors of its numbers say all. `pulls` are the largest on a seam of its shape and of its
    /// second one, or twice that of its only one.
    pub(super) fn of_region(region: &InflatedRegion, pulls: [MeshedPlace; 2]) -> Option<Self> {
        if region.wrinkles == Wrinkles::Resolved && region.second.is_none() {
            return None;
        }
        let rounded = |value: &Value| MeshedValue::rounded(*value);
        let height = region.height.scaled(1e3);
        let (extents, volume) = (region.extents.map(|extent| extent.scaled(1e3)), region.volume.scaled(1e9));
        if region.wrinkles == Wrinkles::Averaged {
            let [height, volume] = [height, volume].each_ref().map(rounded);
            let pull = pulls[0].number();
            return Some(Self::of_averaged(
                region.bendability,
                height,
                extents.each_ref().map(rounded),
                volume,
                pull,
            ));
        }
        let second = region.second.as_deref().unwrap_or(region);
        Some(Self {
            height_mm: hull_of_values(height, second.height.scaled(1e3)),
            extents_mm: [0, 1].map(|axis| hull_of_values(extents[axis], second.extents[axis].scaled(1e3))),
            volume_mm3: hull_of_values(volume, second.volume.scaled(1e9)),
            seal_pull_N_per_mm: hull(with_errors(pulls[0]), with_errors(pulls[1])),
        })
    }

    /// The ranges of averaged wrinkles at 1/eps = `bendability`.
    fn of_averaged(
        bendability: f64,
        height: MeshedValue,
        extents: [MeshedValue; 2],
        volume: MeshedValue,
        pull: MeshedValue,
    ) -> Self {
        let part = (MEASURED / bendability).sqrt().min(1.0);
        Self {
            height_mm: stated_range(height, [1.0 - HEIGHT * part, 1.0]),
            extents_mm: extents
                .map(|extent| stated_range(extent, [1.0 - EXTENT * part, 1.0 + EXTENT * part])),
            volume_mm3: stated_range(volume, [1.0 - VOLUME * part, 1.0 + MORE_VOLUME]),
            seal_pull_N_per_mm: stated_range(pull, [1.0, PULL]),
        }
    }
}

/// The interval that holds two values with their errors; none is below 0.
pub(super) fn hull_of_values(first: Value, second: Value) -> Interval {
    hull(with_error(first), with_error(second)).map(|end| six(end.max(0.0)))
}

/// The range of a `pull` by its mesh error.
pub(super) fn with_errors(pull: MeshedPlace) -> Interval {
    stated_range(pull.number(), [1.0, 1.0])
}

/// The range of a `pull` on a seam, N/mm, where wrinkles are averaged.
pub(super) fn averaged_pull(pull: MeshedPlace) -> Interval {
    stated_range(pull.number(), [1.0, PULL])
}

/// `value`, from `factors[0]` to `factors[1]` times itself, and its mesh error beyond.
fn stated_range(value: MeshedValue, factors: Interval) -> Interval {
    let MeshedValue { value, mesh_error } = value;
    [(factors[0] * (value - mesh_error)).max(0.0), factors[1] * (value + mesh_error)]
}

/// The warning about the averaged wrinkles of `chambers`, names in words.
pub(super) fn averaged_warning(chambers: &str) -> String {
    format!(
        "the wrinkles of {chambers} are averaged, because they are too fine or no shape with folds was found: the ranges contain shapes with \
         folds; bent tubes coil up to 0.04 of lambda too far; no burst pressure is predicted, because folds may pull {PULL} times as hard on the seal"
    )
}

/// The warning about the blended wrinkles of `chambers`.
pub(super) fn blended_warning(chambers: &str) -> String {
    format!(
        "the wrinkles of {chambers} are too fine to resolve: numbers lie between those of a stiffer sheet with folds and those of one without \
         stiffness against compression; the ranges say how far"
    )
}

/// The warning about the second shape of `chambers`.
pub(super) fn second_warning(chambers: &str) -> String {
    format!(
        "two stable shapes were found of {chambers}: numbers are those of the lower energy, and the ranges contain both; a pouch that is \
         inflated further and let down may keep the higher one"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranges(bendability: f64, value: f64) -> ShapeRanges {
        let exact = MeshedValue { value, mesh_error: 0.0 };
        ShapeRanges::of_averaged(bendability, exact, [exact; 2], exact, exact)
    }

    fn assert_within([low, high]: Interval, resolved: f64, bendability: f64) {
        assert!(low <= resolved && resolved <= high, "1/eps {bendability}: {resolved} in {low} to {high}");
    }

    /// 1/eps, averaged and resolved height, mm: square pouches of 40 mm, from flat and from above, and of 100 mm; discs of 100 mm.
    #[test]
    fn heights_with_folds_are_in_range() {
        for (bendability, averaged, resolved) in [
            (1_020.0, 19.76, 11.34),
            (1_020.0, 19.76, 15.9),
            (1_880.0, 20.13, 13.9),
            (1_880.0, 20.13, 17.7),
            (4_700.0, 20.5, 18.2),
            (11_300.0, 21.0, 19.7),
            (2_900.0, 50.3, 38.0),
            (8_700.0, 50.7, 45.0),
            (29_000.0, 51.4, 48.7),
            (29_000.0, 47.08, 43.3),
            (4e5, 46.1, 45.69),
        ] {
            assert_within(ranges(bendability, averaged).height_mm, resolved, bendability);
        }
    }

    /// 1/eps, averaged and resolved extent, mm: a bent tube along x and y, a square pouch, a V-actuator, the paper's star, a square, discs.
    #[test]
    fn extents_with_folds_are_in_range() {
        for (bendability, averaged, resolved) in [
            (1_000.0, 62.8, 65.95),
            (1_000.0, 41.59, 42.38),
            (1_020.0, 35.29, 39.12),
            (1_010.0, 104.8, 120.0),
            (2_941.0, 223.7, 229.7),
            (29_000.0, 90.6, 93.0),
            (29_000.0, 76.9, 77.4),
            (4e5, 76.6, 76.27),
        ] {
            assert_within(ranges(bendability, averaged).extents_mm[0], resolved, bendability);
        }
    }

    /// 1/eps, averaged and resolved volume, and the pull: a square pouch, a bent tube, a disc, a square of film.
    #[test]
    fn volumes_and_pulls_with_folds_are_in_range() {
        for (bendability, averaged, resolved) in [
            (1_020.0, 12.473, 10.138),
            (1_000.0, 10.96, 10.97),
            (29_000.0, 155.3, 150.9),
            (4e5, 0.2035, 0.2055),
        ] {
            assert_within(ranges(bendability, averaged).volume_mm3, resolved, bendability);
        }
        assert_within(ranges(1_020.0, 0.062).seal_pull_N_per_mm, 0.178, 1_020.0);
    }
}
