//! Random numbers, the same on every machine.

/// Numbers between 0 and 1.
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    /// The next one.
    pub(crate) fn throw(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap_or(0)) / 4_294_967_296.0
    }
}
