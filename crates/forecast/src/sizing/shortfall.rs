//! Requirements in words: as a condition, by how much they are missed, and what eases them.

use crate::load_check::COATED;
use crate::sizing::Requirements;
use crate::sizing::easing::Requirement;
use spec::units::{Length, Readable, in_unit};

impl Requirement {
    /// The requirement as a condition of another one: " at 20 kPa".
    pub(super) fn condition(self, required: &Requirements) -> Option<String> {
        match self {
            Self::Force => {
                required.force_in_words().map(|force| format!(", with at most {force} of each star"))
            }
            Self::Pressure => required.pressure_in_words().map(|pressure| format!(", at {pressure}")),
            Self::Sheet => Some(format!(", on a sheet of {}", area(required.room.sheet))),
            Self::Machine => Some(format!(", on a machine that reaches {}", area(required.room.machine))),
            Self::Friction | Self::Mass | Self::Size => None,
        }
    }

    /// By how much `required` misses this requirement, which `eased` has as near to it as can be met.
    pub(super) fn shortfall(self, required: &Requirements, eased: Option<&Requirements>) -> String {
        // Each requirement says its own value beside the nearest one that can be met. Where none was reached, it says
        // in which direction to look.
        match self {
            Self::Mass => {
                let mass = required.mass_in_words();
                let friction = Readable(required.friction);
                eased.map_or_else(
                    || format!("with friction {friction} it cannot carry {mass}"),
                    |eased| {
                        let carried = eased.mass_in_words();
                        format!("it can safely carry {carried} of the {mass} with friction {friction}")
                    },
                )
            }
            Self::Force => {
                let bears = required.force_in_words().unwrap_or_default();
                let presses = eased.and_then(Requirements::force_in_words);
                let presses = presses.map_or_else(
                    || "a star may press harder".to_owned(),
                    |force| {
                        let mass = required.mass_in_words();
                        format!(
                            "the gentlest star that can safely carry {mass} is for an object that bears {force}"
                        )
                    },
                );
                format!("{presses}: this one bears {bears}")
            }
            Self::Sheet => {
                let sheet = area(required.room.sheet);
                let needed_sheet = eased.map_or_else(
                    || "a larger sheet".to_owned(),
                    |eased| format!("a sheet of {}", area(eased.room.sheet)),
                );
                format!("the star needs {needed_sheet}: this one is {sheet}")
            }
            Self::Machine => {
                let reach = area(required.room.machine);
                let needed_bed = eased.map_or_else(
                    || "a larger bed".to_owned(),
                    |eased| format!("a bed of {}", area(eased.room.machine)),
                );
                format!("the star needs {needed_bed}: the machine reaches {reach}")
            }
            Self::Pressure => {
                let pressure = required.pressure_in_words().unwrap_or_default();
                let other = eased.and_then(Requirements::pressure_in_words);
                let other =
                    other.map_or_else(String::new, |other| format!("; the nearest pressure is {other}"));
                format!(
                    "at {pressure} no gripper for it is in the range in which shells were computed{other}"
                )
            }
            Self::Friction => format!("friction {} is too little", Readable(required.friction)),
            Self::Size => format!("no gripper is for an object {} across", required.width_in_words()),
        }
    }

    /// The change from `required` to `eased`, in words; `None` if they agree in this requirement.
    pub(super) fn change(self, required: &Requirements, eased: &Requirements) -> Option<String> {
        // Each requirement whose value differs is a phrase with the eased value. The last arm names those that agree, so
        // that a new requirement does not compile without a phrase.
        Some(match self {
            Self::Friction if eased.friction > required.friction => {
                format!(
                    "friction {} (silicone-coated corners reach about {COATED})",
                    Readable(eased.friction)
                )
            }
            Self::Pressure if eased.pressure != required.pressure => eased
                .pressure_in_words()
                .map_or_else(|| "any pressure".to_owned(), |pressure| format!("a pressure of {pressure}")),
            Self::Sheet if eased.room.sheet != required.room.sheet => {
                format!("a sheet of {}", area(eased.room.sheet))
            }
            Self::Force if eased.largest_force != required.largest_force => {
                let force = eased.force_in_words().unwrap_or_else(|| "any force of a star".to_owned());
                format!("an object that bears {force}")
            }
            Self::Mass if eased.mass != required.mass => format!("a mass of {}", eased.mass_in_words()),
            Self::Size if eased.object != required.object => {
                format!("an object {} across", eased.width_in_words())
            }
            Self::Friction
            | Self::Pressure
            | Self::Sheet
            | Self::Force
            | Self::Mass
            | Self::Machine
            | Self::Size => return None,
        })
    }
}

/// Width and height, as far as they are limited: "198 x 185 mm".
fn area([width, height]: [Length; 2]) -> String {
    match [width, height].map(|side| side.0.is_finite()) {
        [true, true] => format!("{} x {}", Readable(width.0), in_unit(height, None)),
        [true, false] => format!("{width} width"),
        [false, true] => format!("{height} height"),
        [false, false] => "any size".to_owned(),
    }
}
