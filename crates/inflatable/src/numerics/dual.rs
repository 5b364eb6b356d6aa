//! Forward derivatives: a number together with its slopes along `N` directions.
//!
//! Evaluating a formula on [`Dual`] gives its value and its exact gradient in one pass, without
//! differencing. `Dual<0>` is a plain number: the same code then runs without derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its partial derivatives with respect to `N` variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// The partial derivatives.
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A number that depends on none of the variables.
    pub const fn constant(value: f64) -> Self {
        Self { value, slope: [0.0; N] }
    }

    /// The variable of number `index` itself; a constant if there is no such variable.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut slope = [0.0; N];
        if let Some(derivative) = slope.get_mut(index) {
            *derivative = 1.0;
        }
        Self { value, slope }
    }

    /// All variables of a point, in order.
    pub fn variables(point: [f64; N]) -> [Self; N] {
        std::array::from_fn(|i| Self::variable(point[i], i))
    }

    /// Chain rule: a function of this number that has value `value` and derivative `derivative` here.
    #[inline]
    pub fn chain(self, value: f64, derivative: f64) -> Self {
        Self { value, slope: std::array::from_fn(|i| derivative * self.slope[i]) }
    }

    /// Square root; its slope is infinite at 0.
    #[inline]
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }

    /// Sine and cosine.
    #[inline]
    pub fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = libm::sincos(self.value);
        (self.chain(sin, cos), self.chain(cos, -sin))
    }

    /// Angle of the vector (`x`, `self`), in rad.
    #[inline]
    pub fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let slope = std::array::from_fn(|i| (x.value * self.slope[i] - self.value * x.slope[i]) / square);
        Self { value: libm::atan2(self.value, x.value), slope }
    }

    /// `1 / self`.
    #[inline]
    pub fn recip(self) -> Self {
        let recip = 1.0 / self.value;
        self.chain(recip, -recip * recip)
    }

    /// `self * self`.
    #[inline]
    pub fn squared(self) -> Self {
        self.chain(self.value * self.value, 2.0 * self.value)
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            slope: std::array::from_fn(|i| self.slope[i] + other.slope[i]),
        }
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            slope: std::array::from_fn(|i| self.slope[i] - other.slope[i]),
        }
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline]
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule is a sum")]
    fn mul(self, other: Self) -> Self {
        let slope = |i: usize| self.slope[i] * other.value + self.value * other.slope[i];
        Self { value: self.value * other.value, slope: std::array::from_fn(slope) }
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let recip = 1.0 / other.value;
        let value = self.value * recip;
        Self { value, slope: std::array::from_fn(|i| (self.slope[i] - value * other.slope[i]) * recip) }
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(self, other: f64) -> Self {
        Self { value: self.value + other, slope: self.slope }
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(self, other: f64) -> Self {
        Self { value: self.value - other, slope: self.slope }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        self.chain(self.value * other, other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A formula that uses every operation.
    fn formula<const N: usize>(x: Dual<N>, y: Dual<N>) -> Dual<N> {
        let (sin, cos) = (x * y).sin_cos();
        (sin.squared() + 2.0 - cos * 0.5).sqrt() / (x + y.recip()) - x.atan2(y) - (-y)
    }

    #[test]
    fn slopes_agree_with_central_differences() {
        let plain = |x: f64, y: f64| formula(Dual::<0>::constant(x), Dual::constant(y)).value;
        for (x, y) in [(0.3, 0.7), (1.9, -2.4), (-0.2, 3.0)] {
            let [dx, dy] = Dual::variables([x, y]);
            let result = formula(dx, dy);
            let step = 1e-6;
            let by_x = (plain(x + step, y) - plain(x - step, y)) / (2.0 * step);
            let by_y = (plain(x, y + step) - plain(x, y - step)) / (2.0 * step);
            assert_eq!(result.value, plain(x, y));
            assert!((result.slope[0] - by_x).abs() < 1e-8, "{x} {y}: {} {by_x}", result.slope[0]);
            assert!((result.slope[1] - by_y).abs() < 1e-8, "{x} {y}: {} {by_y}", result.slope[1]);
        }
    }
}
