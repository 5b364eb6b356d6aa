//! Roots of one function of one variable, safeguarded by a bracket.

/// Reason for a search without a root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RootFault {
    /// The function has the same sign at both ends.
    NoSignChange {
        /// Value at the lower end.
        low: f64,
        /// Value at the upper end.
        high: f64,
    },
    /// The function is not a finite number somewhere in the bracket.
    NotFinite {
        /// The point.
        at: f64,
    },
}

/// Root of `function` between `low` and `high`, to `tolerance` in the argument.
///
/// Ridders' method: each round halves the bracket, takes out the exponential trend, and keeps the
/// sign change enclosed, so it never leaves the bracket and needs no derivative. A discontinuous
/// function is led to the jump.
///
/// # Errors
/// See [`RootFault`]; an error of the function itself is passed on.
pub fn bracketed_root<E: From<RootFault>>(
    mut low: f64,
    mut high: f64,
    tolerance: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let mut value = |x: f64| {
        let y = function(x)?;
        if y.is_finite() { Ok(y) } else { Err(E::from(RootFault::NotFinite { at: x })) }
    };
    let (mut at_low, mut at_high) = (value(low)?, value(high)?);
    if at_low == 0.0 {
        return Ok(low);
    }
    if at_high == 0.0 {
        return Ok(high);
    }
    if at_low.signum() == at_high.signum() {
        return Err(E::from(RootFault::NoSignChange { low: at_low, high: at_high }));
    }
    // 120 rounds bring any bracket of f64 down to rounding even if each only halves it.
    for _ in 0..120 {
        if (high - low).abs() <= tolerance {
            break;
        }
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        let at_middle = value(middle)?;
        let discriminant = (at_middle * at_middle - at_low * at_high).sqrt();
        if at_middle == 0.0 || discriminant == 0.0 {
            return Ok(middle);
        }
        let point = middle + (middle - low) * (at_low - at_high).signum() * at_middle / discriminant;
        let at_point = value(point)?;
        if at_point == 0.0 {
            return Ok(point);
        }
        if at_middle.signum() != at_point.signum() {
            (low, at_low, high, at_high) = (middle, at_middle, point, at_point);
        } else if at_low.signum() == at_point.signum() {
            (low, at_low) = (point, at_point);
        } else {
            (high, at_high) = (point, at_point);
        }
        // Converged from one side: step over the root to close the bracket.
        let probe = if low == point { point + tolerance } else { point - tolerance };
        let is_one_sided = (point - middle).abs() <= tolerance && (high - low).abs() > tolerance;
        if is_one_sided && probe > low.min(high) && probe < low.max(high) {
            let at_beyond = value(probe)?;
            if at_beyond.signum() == at_low.signum() {
                (low, at_low) = (probe, at_beyond);
            } else {
                (high, at_high) = (probe, at_beyond);
            }
        }
    }
    Ok(if at_low.abs() < at_high.abs() { low } else { high })
}

/// The number nearest to `fails` at which `test` holds, of those between it and `passing`. Both are above 0, and `test` holds at `passing`. Each
/// round halves the logarithm of their ratio.
pub fn last_holding(mut passing: f64, mut fails: f64, rounds: u32, test: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..rounds {
        let middle = (passing * fails).sqrt();
        if test(middle) {
            passing = middle;
        } else {
            fails = middle;
        }
    }
    passing
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(low: f64, high: f64, f: impl Fn(f64) -> f64) -> Result<f64, RootFault> {
        bracketed_root(low, high, 1e-14, |x| Ok(f(x)))
    }

    #[test]
    fn finds_roots_of_several_shapes() {
        assert!((root(0.0, 2.0, |x| x * x - 2.0).unwrap() - 2.0_f64.sqrt()).abs() < 1e-13);
        assert!((root(-1.0, 30.0, |x| x.exp() - 5.0).unwrap() - 5.0_f64.ln()).abs() < 1e-13);
        assert!((root(2.0, -1.0, |x| x.powi(9)).unwrap()).abs() < 1e-6);
        assert!((root(0.0, 3.0, |x| if x < 1.25 { -1.0 } else { 2.0 }).unwrap() - 1.25).abs() < 1e-13);
    }

    #[test]
    fn refuses_what_it_cannot_do() {
        assert!(matches!(root(1.0, 2.0, |x| x), Err(RootFault::NoSignChange { .. })));
        assert!(matches!(root(-1.0, 2.0, f64::ln), Err(RootFault::NotFinite { .. })));
    }

    #[test]
    fn the_last_number_that_holds_lies_on_its_side() {
        for (holds, fails) in [(1.0, 100.0), (100.0, 1e-3)] {
            let test = |x: f64| if holds < fails { x <= 7.0 } else { x >= 7.0 };
            let bound = last_holding(holds, fails, 50, test);
            assert!(test(bound) && (bound / 7.0 - 1.0).abs() < 1e-14, "{bound}");
        }
        assert_eq!(last_holding(2.0, 8.0, 1, |x| x < 4.0), 2.0);
        assert_eq!(last_holding(2.0, 8.0, 1, |x| x <= 4.0), 4.0);
    }
}
