//! The time of a travel: a way without contact, from rest or from a bend to the next.
//!
//! Where G0 has no feed of its own, every axis is limited to the travel speed, so a diagonal is faster. Where it has one (F), the
//! limit holds along the way. Acceleration is limited along the way for Klipper (`max_accel`) and Marlin (M204), for each axis
//! elsewhere (GRBL $120 to $122; RepRapFirmware M201; LinuxCNC MAX_ACCELERATION). Two controllers do not stop where a level way
//! meets one straight up or down.

use spec::{Dialect, ZLimits};

/// The travel of a dialect.
struct TravelHabits {
    /// Whether the speed holds along the way; else along each axis.
    whole_speed: bool,
    /// Whether the acceleration holds along the way; else along each axis.
    whole_ramp: bool,
    /// The speed, mm/s, at which it passes a right angle between a level way and one straight up or down.
    bend: f64,
}

/// The travel of `dialect`.
///
/// Klipper: printer.cfg, `square_corner_velocity`, 5 by default; RepRapFirmware: M566 Z, 10 mm/s by default (Configuration.h,
/// DefaultZInstantDv). The junction deviations of GRBL and Marlin leave less than 0.6 mm/s at 10 mm/s^2; a faster machine gains
/// less than 0.03 s: they are not counted. Nor are the ends of Marlin's travels up to 2.0.x, at 120 steps/s instead of rest: 0.3 s a level
/// travel at 10 mm/s^2 and 80 steps/mm, less than 0.1 s from 50 mm/s^2 on (docs/clock.md).
fn habits(dialect: Dialect) -> TravelHabits {
    match dialect {
        // Bambu's firmware is not known: as the controller that is assumed for `generic`.
        Dialect::Generic | Dialect::Bambu => TravelHabits { whole_speed: true, whole_ramp: false, bend: 0.0 },
        Dialect::LinuxCnc | Dialect::Grbl | Dialect::GrblHal | Dialect::FluidNc => {
            TravelHabits { whole_speed: false, whole_ramp: false, bend: 0.0 }
        }
        Dialect::Marlin => TravelHabits { whole_speed: true, whole_ramp: true, bend: 0.0 },
        Dialect::Klipper => TravelHabits { whole_speed: true, whole_ramp: true, bend: 5.0 },
        Dialect::RepRapFirmware => TravelHabits { whole_speed: true, whole_ramp: false, bend: 10.0 },
    }
}

/// How fast a controller travels.
#[derive(Clone, Copy, Debug)]
pub struct TravelLimits {
    /// The dialect, whose firmware applies the limits along the way or for each axis.
    pub dialect: Dialect,
    /// mm/s
    pub speed: f64,
    /// mm/s^2; `None`: at speed at once.
    pub acceleration: Option<f64>,
    /// Limits of Z, where they are lower.
    pub z: ZLimits,
}

impl TravelLimits {
    /// Time of travels along `ways`, mm, one after the other, from rest to rest, s.
    pub fn seconds(self, ways: &[[f64; 3]]) -> f64 {
        let mut elapsed = 0.0;
        let mut last = None;
        for mut travel in ways.iter().filter_map(|way| Travel::new(self, *way)) {
            elapsed += travel.seconds_after(last.as_ref());
            last = Some(travel);
        }
        elapsed
    }
}

/// One travel: where it can go how fast.
#[derive(Clone, Copy, Debug)]
pub(super) struct Travel {
    length: f64,
    /// mm/s
    speed: f64,
    /// mm/s^2; `None`: at speed at once.
    acceleration: Option<f64>,
    /// Speed at its beginning, mm/s.
    entry: f64,
    /// Speed at which a bend may be passed, mm/s.
    bend: f64,
    upright: bool,
}

impl Travel {
    /// The travel along `way`, mm, from rest; `None` if that is nothing.
    pub(super) fn new(limits: TravelLimits, way: [f64; 3]) -> Option<Self> {
        let length = way.iter().map(|d| d * d).sum::<f64>().sqrt();
        if length <= 0.0 {
            return None;
        }
        let TravelHabits { whole_speed, whole_ramp, bend } = habits(limits.dialect);
        let share = way.iter().fold(0.0_f64, |most, d| most.max(d.abs())) / length;
        let rise = way[2].abs() / length;
        let z_speed = limits.z.speed.map_or(f64::INFINITY, |z| z.0 / rise);
        let z_acceleration = limits.z.acceleration.map_or(f64::INFINITY, |z| z.0 / rise);
        let acceleration = limits.acceleration.map(|a| if whole_ramp { a } else { a / share });
        let speed = if whole_speed { limits.speed } else { limits.speed / share };
        Some(Self {
            length,
            speed: speed.min(z_speed),
            acceleration: acceleration.map(|a| a.min(z_acceleration)),
            entry: 0.0,
            bend,
            upright: way[2] != 0.0,
        })
    }

    /// Time to rest after `last`, a travel that needs not end at rest any more, less the time that `last` is spared, s.
    pub(super) fn seconds_after(&mut self, last: Option<&Self>) -> f64 {
        let spared = last.map_or(0.0, |last| self.join(last));
        self.seconds() - spared
    }

    /// Time to rest, s.
    fn seconds(&self) -> f64 {
        self.time_to(0.0)
    }

    /// Begins where `previous` ends; the time that `previous` no longer needs, s.
    fn join(&mut self, previous: &Self) -> f64 {
        if previous.upright == self.upright {
            return 0.0;
        }
        self.entry = self.bend.min(self.speed).min(previous.speed).min(self.reach()).min(previous.reach());
        previous.seconds() - previous.time_to(self.entry)
    }

    /// The highest speed that can be reached from rest, or stopped from.
    fn reach(&self) -> f64 {
        self.acceleration.map_or(f64::INFINITY, |a| (2.0 * a * self.length).sqrt())
    }

    /// Time up to its end, which is passed at the speed `exit`, s.
    fn time_to(&self, exit: f64) -> f64 {
        let Some(a) = self.acceleration else { return self.length / self.speed };
        let ends = 0.5 * (self.entry * self.entry + exit * exit);
        let top = self.speed.min((a * self.length + ends).sqrt());
        let even = self.length - (top * top - ends) / a;
        (2.0 * top - self.entry - exit) / a + even.max(0.0) / top
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(dialect: &str) -> TravelLimits {
        let (_, dialect) = Dialect::ALL.iter().find(|(name, _)| *name == dialect).expect("a dialect");
        TravelLimits { dialect: *dialect, speed: 20.0, acceleration: Some(10.0), z: ZLimits::default() }
    }

    fn seconds(dialect: &str, way: [f64; 3]) -> f64 {
        limits(dialect).seconds(&[way])
    }

    /// 20 mm/s and 10 mm/s^2: L / v + v / a, at 45 degrees of each axis or along the way.
    #[test]
    fn limits_hold_along_the_way_or_for_each_axis() {
        let diagonal = [300.0, 300.0, 0.0];
        let length = 300.0 * 2.0_f64.sqrt();
        for (dialect, expected) in [
            ("grbl", 17.0),
            ("linuxcnc", 17.0),
            ("generic", length / 20.0 + 2.0 / 2.0_f64.sqrt()),
            ("klipper", length / 20.0 + 2.0),
            ("marlin", length / 20.0 + 2.0),
            ("reprapfirmware", length / 20.0 + 2.0 / 2.0_f64.sqrt()),
        ] {
            assert!((seconds(dialect, diagonal) - expected).abs() < 1e-9, "{dialect}");
            // Along an axis there is one limit; 2 sqrt(L / a) where the speed is not reached.
            assert!((seconds(dialect, [0.0, -300.0, 0.0]) - 17.0).abs() < 1e-9, "{dialect}");
            assert!((seconds(dialect, [0.0, 0.0, 25.0]) - 2.0 * 2.5_f64.sqrt()).abs() < 1e-9, "{dialect}");
        }
        assert!(Travel::new(limits("grbl"), [0.0; 3]).is_none());
    }

    /// A bend passed at c instead of 0 saves c / a - c^2 / (2 a v) before it, and as much after it.
    #[test]
    fn a_bend_saves_time_where_it_is_no_stop() {
        let saving = 5.0 / 10.0 - 25.0 / 400.0;
        assert!((seconds_saved("klipper", [0.0, 0.0, -100.0]) - 2.0 * saving).abs() < 1e-9);
        assert_eq!(seconds_saved("klipper", [0.0, 100.0, 0.0]), 0.0);
        assert_eq!(seconds_saved("grbl", [0.0, 0.0, -100.0]), 0.0);
    }

    fn seconds_saved(dialect: &str, second: [f64; 3]) -> f64 {
        let first = [100.0, 0.0, 0.0];
        seconds(dialect, first) + seconds(dialect, second) - limits(dialect).seconds(&[first, second])
    }
}
