//! The timers of GRBL's family: the real time of a segment's steps, and of dwells.

/// A controller's timer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Timer {
    /// GRBL on an AVR: 16 bits of 16 MHz.
    Avr,
    /// grblHAL on an ESP32: 18 bits of 20 MHz.
    Esp32,
    /// FluidNC: 16 bits of 20 MHz.
    FluidNc,
}

/// The state of a running timer.
pub(crate) struct Running {
    pub(crate) kind: Timer,
    /// Cycles of the timer since its last match, if it runs on while nothing moves; `None` while it steps.
    idle: Option<f64>,
    /// The period in force, cycles.
    period: f64,
}

/// Time of the interpreter of GRBL on an AVR for the two lines of a stroke, s: 1.1 ms, measured once on the AVR binary.
const LINES: f64 = 1.1e-3;

impl Timer {
    pub(crate) fn started(self) -> Running {
        Running { kind: self, idle: Some(0.0), period: 65_536.0 }
    }

    fn frequency(self) -> f32 {
        if self == Self::Avr { 16e6 } else { 20e6 }
    }
}

impl Running {
    /// Time for the steps of a segment, s, at `minutes` a step.
    pub(crate) fn run(&mut self, minutes: f32, steps: f32) -> f64 {
        let cycles = (self.kind.frequency() * 60.0 * minutes).ceil() as u32;
        let (period, smoothing) = match self.kind {
            Timer::Avr => avr(cycles),
            Timer::Esp32 => esp32(cycles),
            Timer::FluidNc => fluidnc(cycles),
        };
        let first = self.idle.take().map_or(0.0, |since| self.start(since, period));
        self.period = period;
        let ticks = f64::from(steps) * f64::from(1_u32 << smoothing);
        (ticks * period + first) / f64::from(self.kind.frequency())
    }

    /// Extra cycles of the first tick after a rest.
    fn start(&self, phase: f64, period: f64) -> f64 {
        match self.kind {
            // TIMER1 is never stopped, and its flag is set since its last match. So the first interrupt comes at once. The next one comes
            // when the counter, which is not reset, reaches the new period (stepper.c, st_wake_up; the ATmega328P's data sheet, TIFR1); if
            // it is past that already, it overflows first.
            Timer::Avr => {
                let count = phase % self.period;
                if count < period { -count } else { 65_536.0 - count }
            }
            // stepperWakeUp: 2 ms for the drivers to wake up.
            Timer::Esp32 => 40_000.0,
            // stepTimerStart: ten ticks.
            Timer::FluidNc => 10.0,
        }
    }

    /// The stepping ends.
    pub(crate) fn idle(&mut self) {
        let _ = self.idle.get_or_insert(0.0);
    }

    /// The time of a dwell with the P word `p_word`, s.
    pub(crate) fn dwell(&mut self, p_word: f64) -> f64 {
        let p_value = p_word as f32;
        let seconds = match self.kind {
            // nuts_bolts.c, delay_sec.
            Timer::Avr => f64::from((20.0 * p_value).ceil()) * 0.05 + LINES,
            Timer::Esp32 => f64::from((1000.0_f32 / 50.0 * p_value).ceil()) * 0.05,
            // GCode.cpp, NonModal::Dwell; NutsBolts.cpp, dwell_ms.
            Timer::FluidNc => f64::from((p_value * 1000.0).trunc()) * 1e-3,
        };
        if let Some(idle_cycles) = &mut self.idle {
            *idle_cycles += seconds * f64::from(self.kind.frequency());
        }
        seconds
    }
}

/// stepper.c, AMASS_LEVEL1 to 3: the period and the level of smoothing. CTC counts one cycle more than its setting.
fn avr(cycles: u32) -> (f64, u32) {
    let level = u32::from(cycles >= 2_000) + u32::from(cycles >= 4_000) + u32::from(cycles >= 8_000);
    (f64::from((cycles >> level).min(0xffff)) + 1.0, level)
}

/// Time and ticks of a step; driver.c, stepperCyclesPerTick.
fn esp32(cycles: u32) -> (f64, u32) {
    let level = u32::from(cycles >= 2_500) + u32::from(cycles >= 5_000) + u32::from(cycles >= 10_000);
    (f64::from((cycles >> level).min((1 << 18) - 1)), level)
}

/// Stepper.cpp: the 32-bit product overflows if a step takes a multiple of 26.8 ms.
fn fluidnc(cycles: u32) -> (f64, u32) {
    let (mut ticks, mut level) = (cycles, 0);
    while level < 3 && ticks.wrapping_mul(8_000) >= 20_000_000 {
        ticks >>= 1;
        level += 1;
    }
    (f64::from(ticks.min(0xffff)), level)
}
