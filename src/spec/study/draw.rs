//! Values drawn at random, each by its number alone: value i is the same in any order and on any machine.

/// Values drawn between two ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// The least value.
    pub from: f64,
    /// The largest.
    pub to: f64,
    /// Whether values are whole numbers, ends included.
    pub whole: bool,
    /// The seed of the draw.
    pub seed: u64,
    /// Index of the axis in the study, so that no two draw the same.
    pub axis: u64,
    /// Number of values.
    pub count: u64,
    /// Whether each `count`-th of the way from end to end holds exactly one of them: a Latin hypercube.
    pub latin: bool,
}

impl Draw {
    /// Value number `i`, from 0.
    pub fn value(&self, i: u64) -> f64 {
        let own = unit(mixed(&[self.seed, self.axis, i]));
        #[expect(clippy::cast_precision_loss, reason = "at most 1e9")]
        let part = if self.latin { (self.stratum(i) as f64 + own) / self.count as f64 } else { own };
        if self.whole {
            (self.from + (part * (self.to - self.from + 1.0)).floor()).min(self.to)
        } else {
            (self.from + part * (self.to - self.from)).min(self.to)
        }
    }

    /// The place of number `i` in a shuffled row of `count`: a Feistel network over the next even number of bits, applied again
    /// until the result is in range. It needs no memory, however many there are.
    fn stratum(&self, i: u64) -> u64 {
        let bits = u64::BITS - self.count.saturating_sub(1).leading_zeros();
        let half = bits.div_ceil(2).max(1);
        let mask = (1_u64 << half) - 1;
        let mut at = i;
        loop {
            let (mut left, mut right) = (at >> half, at & mask);
            for round in 0..ROUNDS {
                let next = left ^ (mixed(&[!self.seed, self.axis, round, right]) & mask);
                (left, right) = (right, next);
            }
            at = left << half | right;
            if at < self.count {
                return at;
            }
        }
    }
}

/// Fewer than four rounds leave patterns.
const ROUNDS: u64 = 6;

/// A number in [0, 1) of the upper 53 bits.
#[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

/// The numbers as one: each is added to the result of the finaliser of `SplitMix64` (Steele, Lea, Flood 2014) for those before
/// it.
fn mixed(numbers: &[u64]) -> u64 {
    numbers.iter().fold(0, |state: u64, number| {
        let mut z = state.wrapping_add(*number).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn draw(count: u64, latin: bool) -> Draw {
        Draw { from: 10.0, to: 20.0, whole: false, seed: 7, axis: 1, count, latin }
    }

    #[test]
    fn a_latin_draw_takes_each_stratum_once() {
        for count in [1, 2, 3, 10, 64, 1000, 4097] {
            let draw = draw(count, true);
            let mut taken: Vec<u64> = (0..count).map(|i| draw.stratum(i)).collect();
            assert!(count < 10 || taken.windows(2).any(|pair| pair[0] > pair[1]), "{count}: shuffled");
            taken.sort_unstable();
            assert!(taken.into_iter().eq(0..count), "{count}");
            assert!((0..count).all(|i| (10.0..=20.0).contains(&draw.value(i))));
        }
    }

    /// The mean of n even draws is 15 with a deviation of 10 / sqrt(12 n): five of those are never left by a fair draw.
    #[test]
    fn draws_are_even_and_their_own() {
        let mean = |draw: &Draw| (0..10_000).map(|i| draw.value(i)).sum::<f64>() / 1e4;
        let random = draw(10_000, false);
        assert!((mean(&random) - 15.0).abs() < 5.0 * 10.0 / (12.0 * 1e4_f64).sqrt());
        assert!((mean(&draw(10_000, true)) - 15.0).abs() < 1e-3, "strata leave no room for chance");
        let others = [Draw { seed: 8, ..random.clone() }, Draw { axis: 2, ..random.clone() }];
        for other in others {
            let product = |i| (random.value(i) - 15.0) * (other.value(i) - 15.0);
            let correlation = (0..10_000).map(product).sum::<f64>() / 1e4 / (100.0 / 12.0);
            assert!(correlation.abs() < 0.05, "{correlation}");
        }
    }

    #[test]
    fn whole_draws_take_both_ends_equally_often() {
        let points = Draw { from: 3.0, to: 6.0, whole: true, ..draw(4000, false) };
        let mut counts = [0; 4];
        for i in 0..4000 {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "3 to 6")]
            let value = points.value(i) as usize;
            counts[value - 3] += 1;
        }
        assert!(counts.iter().all(|count| (850..1150).contains(count)), "{counts:?}");
    }

    #[test]
    fn draws_are_the_same_on_every_machine() {
        let first: Vec<String> = (0..3).map(|i| format!("{:.12}", draw(100, true).value(i))).collect();
        assert_eq!(first, FIRST, "a change here changes every study that draws");
    }

    /// Worked out beside, in Python.
    const FIRST: [&str; 3] = ["11.798355711334", "12.262453383575", "13.547514130262"];
}
