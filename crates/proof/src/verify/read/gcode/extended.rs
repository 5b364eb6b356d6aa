//! Klipper's extended commands to heaters (docs/G-Codes.md): one sets the temperature of a heater with a name, the next waits for it.

use crate::verify::read::gcode::Heater;
use crate::verify::read::number;
use spec::is_plain_word;

/// Largest difference between a heater's temperature and the one that is waited for, in degrees Celsius.
const NEAR: f64 = 2.5;

/// Whether the line is a command to a heater with a name.
pub(super) fn is_heating(line: &str) -> bool {
    line.starts_with("SET_HEATER_TEMPERATURE") || line.starts_with("TEMPERATURE_WAIT")
}

/// The heater that was set last, until the program waits for it.
#[derive(Clone, Debug, Default)]
pub(super) struct PendingHeater(Option<(String, f64)>);

/// The effect of a line.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum HeaterLine {
    /// A temperature is set.
    Set,
    /// A heater is turned off.
    Off(Heater),
    /// The heater is hot.
    Hot { heater: Heater, celsius: f64, waits_for_cooler: bool },
}

impl PendingHeater {
    /// Whether a heater was set without a wait; there is none from here on.
    pub(super) fn take(&mut self) -> bool {
        self.0.take().is_some()
    }

    /// The effect of `line`; `None` if it is in the wrong form, or waits for another temperature or heater than was set.
    pub(super) fn read(&mut self, line: &str) -> Option<HeaterLine> {
        if let Some(rest) = line.strip_prefix("SET_HEATER_TEMPERATURE HEATER=") {
            let (name, target) = rest.split_once(" TARGET=")?;
            let (name, celsius) =
                (Some(name.to_owned()).filter(|name| is_plain_word(name))?, number::value(target)?);
            if self.0.is_some() {
                return None;
            }
            if celsius == 0.0 {
                return Some(HeaterLine::Off(Heater::Named(name)));
            }
            self.0 = Some((name, celsius));
            return (celsius > 0.0).then_some(HeaterLine::Set);
        }
        let rest = line.strip_prefix("TEMPERATURE_WAIT SENSOR=\"heater_generic ")?;
        let (name, limits) = rest.split_once("\" MINIMUM=")?;
        let (minimum, maximum) = match limits.split_once(" MAXIMUM=") {
            Some((minimum, maximum)) => (number::value(minimum)?, Some(number::value(maximum)?)),
            None => (number::value(limits)?, None),
        };
        let (heater, celsius) = self.0.take()?;
        let mut limits = [Some(minimum), maximum].into_iter().flatten();
        let right = heater == name && limits.all(|limit| (limit - celsius).abs() <= NEAR);
        let waits_for_cooler = maximum.is_some();
        right.then_some(HeaterLine::Hot { heater: Heater::Named(heater), celsius, waits_for_cooler })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(lines: &[&str]) -> Vec<Option<HeaterLine>> {
        let mut pending = PendingHeater::default();
        lines.iter().map(|line| pending.read(line)).collect()
    }

    #[test]
    fn a_heater_is_set_and_waited_for() {
        let set = "SET_HEATER_TEMPERATURE HEATER=tip TARGET=200.0";
        let heater = Heater::Named("tip".to_owned());
        for (wait, waits_for_cooler) in [("MINIMUM=198", false), ("MINIMUM=198 MAXIMUM=202", true)] {
            let wait = format!("TEMPERATURE_WAIT SENSOR=\"heater_generic tip\" {wait}");
            let hot = HeaterLine::Hot { heater: heater.clone(), celsius: 200.0, waits_for_cooler };
            assert_eq!(read(&[set, &wait]), [Some(HeaterLine::Set), Some(hot)]);
        }
        assert_eq!(read(&["SET_HEATER_TEMPERATURE HEATER=tip TARGET=0"]), [Some(HeaterLine::Off(heater))]);
        for wait in [
            "TEMPERATURE_WAIT SENSOR=\"heater_generic tip\" MINIMUM=190",
            "TEMPERATURE_WAIT SENSOR=\"heater_generic other\" MINIMUM=198",
            "TEMPERATURE_WAIT SENSOR=\"heater_generic tip\" MAXIMUM=400",
            "TEMPERATURE_WAIT SENSOR=\"heater_generic tip\" MINIMUM=198 MAXIMUM=400",
            "TEMPERATURE_WAIT SENSOR=tip MINIMUM=198",
            "SET_HEATER_TEMPERATURE HEATER=tip TARGET=200",
            "SET_HEATER_TEMPERATURE HEATER=tip",
        ] {
            assert_eq!(read(&[set, wait])[1], None, "{wait}");
        }
        assert_eq!(read(&["TEMPERATURE_WAIT SENSOR=\"heater_generic tip\" MINIMUM=198"]), [None]);
    }
}
