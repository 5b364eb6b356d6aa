//! The last two look-ups of a thread: rows of a study often repeat them, and beyond the validated pressures a star is computed at two.

/// The last two values that were made, the newer one first.
#[derive(Debug)]
pub(super) struct LastTwo<T>(Vec<T>);

impl<T> LastTwo<T> {
    /// Nothing was made yet.
    pub(super) const NONE: Self = Self(Vec::new());

    /// The value that `is` it, or else what `make` makes.
    pub(super) fn find_or_make<E>(
        &mut self,
        is: impl Fn(&T) -> bool,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<&T, E> {
        if let Some(place) = self.0.iter().position(is) {
            return Ok(&self.0[place]);
        }
        let made_entry = make()?;
        self.0.truncate(1);
        self.0.insert(0, made_entry);
        Ok(&self.0[0])
    }
}

/// Whether all numbers have the same bits.
pub(super) fn have_same_bits<const N: usize>(a: [f64; N], b: [f64; N]) -> bool {
    a.map(f64::to_bits) == b.map(f64::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_keeps_two_and_drops_the_older() {
        let (mut last, mut calls) = (LastTwo::NONE, Vec::new());
        for asked in [1, 2, 1, 2, 3, 2, 1, 3] {
            let make = || {
                calls.push(asked);
                Ok::<_, ()>(asked)
            };
            assert_eq!(last.find_or_make(|own| *own == asked, make), Ok(&asked));
        }
        assert_eq!(calls, [1, 2, 3, 1]);
        let failed = last.find_or_make(|own| *own == 9, || Err("no"));
        assert_eq!(failed, Err("no"));
        assert_eq!(last.find_or_make(|own| *own == 3, || Err("lost")), Ok(&3));
    }

    #[test]
    fn numbers_are_the_same_by_their_bits() {
        assert!(have_same_bits([0.5, f64::NAN], [0.5, f64::NAN]) && !have_same_bits([0.0], [-0.0]));
    }
}
