//! The grid of positions that a file can state.

use crate::Point;

/// Positions with a fixed number of decimals: every coordinate is a whole multiple of one quantum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid(u32);

impl Grid {
    /// A quantum of 10^-`decimals`, at most 9 decimals.
    pub const fn new(decimals: u32) -> Self {
        Self(if decimals < 9 { decimals } else { 9 })
    }

    /// The number of decimals that keeps rounding below a tenth of `tolerance`, so that the shape gets the rest: 3 to
    /// 6.
    ///
    /// Never fewer than 3: GRBL refuses an arc whose radii at its ends differ by more than 0.005 mm, as
    /// hundredths would cause for a small one.
    pub fn for_tolerance(tolerance: f64) -> Self {
        let quantum = tolerance / 10.0;
        Self((3..6).find(|d| 10_f64.powi(-d) <= quantum * (1.0 + 1e-9)).map_or(6, i32::unsigned_abs))
    }

    /// The number of decimals.
    pub fn decimals(self) -> u32 {
        self.0
    }

    fn scale(self) -> f64 {
        // From a table, because this is the most frequent call.
        const SCALES: [f64; 10] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];
        SCALES[self.0 as usize]
    }

    /// `x` in quanta, halves away from zero.
    pub fn quanta(self, x: f64) -> i64 {
        let scaled = x * self.scale();
        // Coordinates are below 1e6 mm and quanta at least 1e-9 mm, so this is far inside the range of i64.
        #[expect(clippy::cast_possible_truncation, reason = "a saturating cast; see above")]
        let quanta = (scaled + 0.5_f64.copysign(scaled)) as i64;
        quanta
    }

    /// The nearest coordinate on the grid.
    pub fn round(self, x: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "below 2^53, see `quanta`")]
        let rounded = self.quanta(x) as f64 / self.scale();
        rounded
    }

    /// The nearest point on the grid.
    pub fn round_point(self, p: Point) -> Point {
        Point::new(self.round(p.x), self.round(p.y))
    }
}
