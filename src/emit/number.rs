//! The only place where a coordinate becomes text.

use std::fmt::Write;

use crate::geom::Point;
use crate::units::Length;

/// A fixed number of decimals: every coordinate of a file is a whole multiple of one quantum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimals(u32);

impl Decimals {
    /// As many decimals as keep rounding below a tenth of the tolerance `path`, so that the shape gets the rest: 3 to 6.
    ///
    /// Never fewer than 3: GRBL refuses an arc whose radii at its ends differ by more than 0.005 mm, which is
    /// what hundredths would make of a small one.
    pub fn for_tolerance(path: Length) -> Self {
        let quantum = path.0 / 10.0;
        Self((3..6).find(|d| 10_f64.powi(-d) <= quantum * (1.0 + 1e-9)).map_or(6, i32::unsigned_abs))
    }

    /// Exactly `n` decimals, at most 9.
    pub fn exactly(n: u32) -> Self {
        Self(n.min(9))
    }

    fn scale(self) -> f64 {
        f64::from(10_u32.pow(self.0))
    }

    /// `x` in quanta, halves away from zero.
    fn quanta(self, x: f64) -> i64 {
        // Coordinates are below 1e6 mm and quanta at least 1e-9 mm, so this is far inside the range of i64.
        #[expect(clippy::cast_possible_truncation, reason = "a saturating cast; see above")]
        let quanta = (x * self.scale()).round() as i64;
        quanta
    }

    /// The nearest number that the file can say.
    pub fn round(self, x: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "below 2^53, see `quanta`")]
        let rounded = self.quanta(x) as f64 / self.scale();
        rounded
    }

    /// The nearest point that the file can say.
    pub fn round_point(self, p: Point) -> Point {
        Point::new(self.round(p.x), self.round(p.y))
    }

    /// Appends `x` in decimal notation without trailing zeros, never `-0`.
    pub fn write(self, out: &mut String, x: f64) {
        let quanta = self.quanta(x);
        if quanta < 0 {
            out.push('-');
        }
        let unit = 10_u64.pow(self.0);
        let (whole, mut rest) = (quanta.unsigned_abs() / unit, quanta.unsigned_abs() % unit);
        let _ = write!(out, "{whole}");
        if rest > 0 {
            out.push('.');
            let mut place = unit / 10;
            while rest > 0 {
                #[expect(clippy::cast_possible_truncation, reason = "one decimal digit")]
                out.push(char::from(b'0' + (rest / place) as u8));
                rest %= place;
                place /= 10;
            }
        }
    }

    /// `x` as text, see [`Decimals::write`].
    pub fn text(self, x: f64) -> String {
        let mut out = String::new();
        self.write(&mut out, x);
        out
    }
}
