//! The verdict as part of an answer: whether the gripper holds its object, forces, reasons, and all of it in words.

use crate::interval::Interval;
use crate::ranges::shown;
use serde::Serialize;
use spec::units::tenths_up;

/// Whether the object is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Holds {
    /// Yes, over all of its ranges.
    Yes,
    /// Nowhere in its ranges, or it is impossible.
    No,
    /// It depends on the position within the ranges, or no range is available.
    Unknown,
}

impl Holds {
    /// As a truth value; `None` for [`Holds::Unknown`].
    pub fn as_bool(self) -> Option<bool> {
        match self {
            Self::Yes => Some(true),
            Self::No => Some(false),
            Self::Unknown => None,
        }
    }
}

/// Whether the gripper holds the object, with reasons.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct Verdict {
    /// The verdict.
    pub holds: Holds,
    /// The first reason as a code of docs/codes.md; `None` if it holds.
    pub code: Option<&'static str>,
    /// Radial force of all stars.
    pub force_N: Option<f64>,
    /// Range of the force of all stars.
    pub force_range_N: Option<Interval>,
    /// Radial force that friction needs to hold the mass.
    pub needed_N: Option<f64>,
    /// Radial force of the star that presses hardest.
    pub star_force_N: Option<f64>,
    /// Range of the hardest star's force.
    pub star_force_range_N: Option<Interval>,
    /// The largest radial force of one star, if its flap stays straight; `None` if unknown.
    pub star_flap_force_N: Option<f64>,
    /// Radial force of one star that the object bears.
    pub largest_force_N: Option<f64>,
    /// Height of the gripper's base above the table on which the object stands, mm. Below 0 the object must be lifted.
    pub base_height_mm: Option<f64>,
    /// Number of stars.
    pub stars: usize,
    /// Assumptions about the object that the stars of a stack depend on and the spec leaves open.
    pub assumed: Option<String>,
    /// The reasons and remedies, one sentence each; empty if it holds.
    pub reasons: Vec<String>,
}

impl Verdict {
    /// As a phrase: "holds the object".
    pub fn word(&self) -> &'static str {
        match self.holds {
            Holds::Yes => "holds the object",
            Holds::No => "does not hold the object",
            Holds::Unknown => "may hold the object",
        }
    }

    /// As one line, without the reasons.
    pub fn line(&self) -> String {
        let word = self.word();
        let force = match (self.force_N, self.force_range_N) {
            (Some(force), Some(range)) if range[1] > 0.0 => {
                let limit = Some(self.needed_N.unwrap_or(0.0));
                format!(" with {}", shown::with_limit(force, range, "N", limit))
            }
            _ => String::new(),
        };
        let needed_text = self.needed_N.map_or(String::new(), |needed| {
            let needed_digits = shown::apart_from(needed, self.force_range_N.unwrap_or([0.0; 2]));
            format!(" ({needed_digits} N are needed)")
        });
        format!("{word}{force}{needed_text}")
    }

    /// The force of one star, if it differs from the force of all and a limit is set.
    pub fn one_star(&self) -> Option<String> {
        let bears = self.largest_force_N.filter(|_| self.stars > 1)?;
        let force = shown::with_limit(self.star_force_N?, self.star_force_range_N?, "N", Some(bears));
        Some(format!(
            "of these {} stars the hardest presses with {force}; the object bears {bears} N of one star",
            self.stars
        ))
    }

    /// The force of a star whose flap stays straight, if a limit is set and above it. A force above the limit is one of the reasons.
    pub fn flap_in_words(&self) -> Option<String> {
        let (object_limit, flap_force) = (self.largest_force_N?, self.star_flap_force_N?);
        if flap_force > object_limit {
            return None;
        }
        Some(format!(
            "a star whose flap stays straight presses with at most {:.1} N; the object bears {object_limit} N",
            tenths_up(flap_force)
        ))
    }

    /// The place of the gripper, as a sentence.
    pub fn base_in_words(&self) -> Option<String> {
        let base = self.base_height_mm.filter(|base| *base >= 0.0)?;
        Some(format!(
            "the gripper's base is {} mm above the table on which the object stands",
            shown::rounded(base)
        ))
    }

    /// The sentences beside the verdict that are no reasons: forces of one star, the place of the gripper, assumptions.
    pub fn remarks(&self) -> Vec<String> {
        [self.one_star(), self.flap_in_words(), self.base_in_words(), self.assumed_in_words()]
            .into_iter()
            .flatten()
            .collect()
    }

    /// The assumption about the object, as a sentence.
    pub fn assumed_in_words(&self) -> Option<String> {
        self.assumed.as_ref().map(|what| format!("the object is {what}"))
    }
}
