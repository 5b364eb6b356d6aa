//! Numbers by chance, the same on every machine.

use std::ops::Range;

/// A small generator of numbers (xorshift).
pub struct Dice(pub u64);

impl Dice {
    /// A number below `n`; 0 for none.
    pub fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 16).unwrap_or(0) % n.max(1)
    }

    /// A stretch of at most `longest` bytes within `length`.
    pub fn stretch(&mut self, length: usize, longest: usize) -> Range<usize> {
        let from = self.below(length + 1);
        from..(from + self.below(longest)).min(length)
    }
}
