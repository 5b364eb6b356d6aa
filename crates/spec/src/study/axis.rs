//! A field with its values, listed or sampled at random, and axes that go on together.

use std::borrow::Cow;

use crate::study::field::{Field, KeyValue};

/// Most values that are listed or counted out in one axis.
pub const MOST_VALUES: u32 = 1_000_000;

/// A field with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The field that is set.
    pub field: Field,
    values: Values,
}

#[derive(Clone, Debug, PartialEq)]
enum Values {
    Listed(Vec<KeyValue>),
    Sampled(RandomSample),
}

/// Axes of equal length that go on together.
#[derive(Clone, Debug, PartialEq)]
pub struct Block(Vec<Axis>);

impl Axis {
    /// A field with values in its range, at least one.
    pub fn listed(field: Field, values: Vec<KeyValue>) -> Self {
        Self { field, values: Values::Listed(values) }
    }

    /// A field with values that are drawn.
    pub fn sampled(field: Field, sample: RandomSample) -> Self {
        Self { field, values: Values::Sampled(sample) }
    }

    /// Reads `KEY=A,B,C` or `KEY=FROM..TO/COUNT`: `star.points=3,4,5`, `star.tube_width=10 mm..40 mm/31`.
    ///
    /// # Errors
    /// One sentence that states the fault.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (name, values) = text.split_once('=').ok_or(format!("`{text}` is not KEY=VALUES"))?;
        let field = Field::find(name.trim()).ok_or_else(|| unknown(name.trim()))?;
        let values = match values.split_once("..") {
            Some(_) => counted_out(&field, values)?,
            None => values.split(',').map(|value| field.parse(value)).collect::<Result<_, _>>()?,
        };
        Ok(Self::listed(field, values))
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        match &self.values {
            Values::Listed(values) => values.len(),
            Values::Sampled(sample) => usize::try_from(sample.count).unwrap_or(usize::MAX),
        }
    }

    /// Whether it is empty; a study refuses such an axis.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Value number `i`, from 0; beyond the last the last.
    pub fn value(&self, i: usize) -> Cow<'_, KeyValue> {
        match &self.values {
            Values::Listed(values) => {
                values.get(i).or(values.last()).map_or(Cow::Owned(KeyValue::Number(f64::NAN)), Cow::Borrowed)
            }
            Values::Sampled(sample) => Cow::Owned(KeyValue::Number(sample.value(i as u64))),
        }
    }
}

/// The message for a key that no study can set.
fn unknown(name: &str) -> String {
    let hint = match Field::nearest_name(name) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("these can: {}", Field::names().collect::<Vec<_>>().join(", ")),
    };
    format!("`{name}` is not a key of a spec that can be varied; {hint}")
}

/// Reads `FROM..TO/COUNT`: values at equal distances, both ends included.
pub(super) fn counted_out(field: &Field, text: &str) -> Result<Vec<KeyValue>, String> {
    // The slash of a unit such as N/mm is not that of the count.
    let of_unit = field.unit().and_then(|unit| unit.split_once('/')).map(|(_, below)| below);
    let (ends, count) = text
        .rsplit_once('/')
        .filter(|(_, count)| of_unit != Some(count.trim()))
        .ok_or(format!("`{text}` lacks the number of values: FROM..TO/COUNT"))?;
    let count = count.trim();
    let allowed = format!("allowed are 1 to {MOST_VALUES}");
    // A count may have more digits than a number of this program.
    if count.is_empty() || count.contains(|c: char| !c.is_ascii_digit()) {
        return Err(format!("`{count}` is not a number of values; {allowed}"));
    }
    let valid_count = count.parse().ok().filter(|count| (1..=MOST_VALUES).contains(count));
    let count = valid_count.ok_or_else(|| format!("{count} values; {allowed}"))?;
    let [from, to] = ends_of(field, ends)?;
    if count == 1 && from != to {
        return Err(format!(
            "`{text}` has two ends and takes 1 value; take 2 or more, or write one end alone"
        ));
    }
    let step = f64::from(count.saturating_sub(1)).max(1.0);
    let values: Vec<f64> = (0..count).map(|i| from + (to - from) * f64::from(i) / step).collect();
    if let Some(part) = values.iter().find(|value| field.is_whole() && value.fract() != 0.0) {
        let key = field.name();
        return Err(format!(
            "{part} is not a value of `{key}`: choose the number of values so that all are whole"
        ));
    }
    Ok(values.into_iter().map(KeyValue::Number).collect())
}

/// Reads `FROM..TO`.
pub(super) fn ends_of(field: &Field, text: &str) -> Result<[f64; 2], String> {
    if !field.is_number() {
        return Err(format!("`{}` takes no numbers: list its values", field.name()));
    }
    let (from, to) = text.split_once("..").ok_or(format!("`{text}` is not FROM..TO"))?;
    Ok([number(field, from)?, number(field, to)?])
}

fn number(field: &Field, text: &str) -> Result<f64, String> {
    match field.parse(text)? {
        KeyValue::Number(number) => Ok(number),
        KeyValue::Word(_) | KeyValue::Truth(_) => Err(format!("`{text}` is not a number")),
    }
}

impl Block {
    /// Lanes that go on together; `None` if there are none, or their lengths differ, or are 0.
    pub fn new(axes: Vec<Axis>) -> Option<Self> {
        let len = axes.first()?.len();
        (len > 0 && axes.iter().all(|axis| axis.len() == len)).then_some(Self(axes))
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis] {
        &self.0
    }

    /// Number of values of each axis; at least 1.
    pub fn len(&self) -> usize {
        self.0.first().map_or(0, Axis::len)
    }

    /// Never.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Values drawn between two ends.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomSample {
    /// The least value.
    pub from: f64,
    /// The largest.
    pub to: f64,
    /// Whether values are whole numbers, ends included.
    pub whole: bool,
    /// The seed of the draw.
    pub seed: u64,
    /// [`RandomSample::number`] of the key, so that no two draw the same.
    pub key: u64,
    /// Number of values.
    pub count: u64,
    /// Whether each `count`-th of the way from end to end holds exactly one of them: a Latin hypercube.
    pub latin: bool,
}

impl RandomSample {
    /// The number of a key, by its name.
    pub fn number(key: &str) -> u64 {
        mixed(&key.bytes().map(u64::from).collect::<Vec<_>>())
    }

    /// Value number `i`, from 0.
    pub fn value(&self, i: u64) -> f64 {
        let unit_value = unit(mixed(&[self.seed, self.key, i]));
        #[expect(clippy::cast_precision_loss, reason = "at most 1e9")]
        let part =
            if self.latin { (self.stratum(i) as f64 + unit_value) / self.count as f64 } else { unit_value };
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
        let mut place = i;
        loop {
            let (mut left, mut right) = (place >> half, place & mask);
            for round in 0..ROUNDS {
                let next = left ^ (mixed(&[!self.seed, self.key, round, right]) & mask);
                (left, right) = (right, next);
            }
            place = left << half | right;
            if place < self.count {
                return place;
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

    fn numbers(text: &str) -> Vec<f64> {
        let axis = Axis::parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        let number = |i| match axis.value(i).into_owned() {
            KeyValue::Number(number) => number,
            other => panic!("{other:?}"),
        };
        (0..axis.len()).map(number).collect()
    }

    #[test]
    fn lanes_are_read_with_units() {
        assert_eq!(numbers("star.tube_width=1 cm..40 mm/4"), [10.0, 20.0, 30.0, 40.0]);
        assert_eq!(numbers("load.pressure = 10 kPa, 0.2 bar"), [10.0, 20.0]);
        assert_eq!(numbers("star.points=5..5/1"), [5.0]);
        assert_eq!(numbers("star.points=3,64"), [3.0, 64.0]);
        assert_eq!(numbers("fabric.seal_strength=1 N/mm..3 N/mm/3"), [1.0, 2.0, 3.0]);
        assert_eq!(numbers("seal.speed=0.1 mm/s..0.2 mm/s/2"), [0.1, 0.2]);
        assert_eq!(numbers("load.pressure=1 kPa..2 kPa/1000000").len(), 1_000_000);
        let words = Axis::parse("mask.mirror=true,false").expect("two values");
        assert_eq!(*words.value(1), KeyValue::Truth(false));
    }

    #[test]
    fn faults_say_what_is_allowed() {
        let faults = [
            ("star.points", "`star.points` is not KEY=VALUES"),
            (
                "star.width=1 mm",
                "`star.width` is not a key of a spec that can be varied; did you mean `star.tube_width`?",
            ),
            ("star.points=2", "`points` is 2: must be from 3 to 64"),
            (
                "star.points=x",
                "`points` in [star] is the text `x`: must be a whole number, without quotes and unit",
            ),
            ("load.friction=0", "`friction` is 0: must be more than 0 and at most 10"),
            ("load.pressure=1 kPa..2 kPa", "`1 kPa..2 kPa` lacks the number of values: FROM..TO/COUNT"),
            (
                "fabric.seal_strength=1 N/mm..3 N/mm",
                "`1 N/mm..3 N/mm` lacks the number of values: FROM..TO/COUNT",
            ),
            (
                "load.pressure=1 kPa..2 kPa/1",
                "`1 kPa..2 kPa/1` has two ends and takes 1 value; take 2 or more, or write one end alone",
            ),
            ("load.pressure=1 kPa..2 kPa/x", "`x` is not a number of values; allowed are 1 to 1000000"),
            ("load.pressure=1 kPa..2 kPa/0", "0 values; allowed are 1 to 1000000"),
            ("load.pressure=1 kPa..2 kPa/1000001", "1000001 values; allowed are 1 to 1000000"),
            ("load.pressure=1 kPa..2 kPa/99999999999", "99999999999 values; allowed are 1 to 1000000"),
            ("mask.mirror=true..false/2", "`mask.mirror` takes no numbers: list its values"),
            (
                "star.points=3..6/3",
                "4.5 is not a value of `star.points`: choose the number of values so that all are whole",
            ),
        ];
        for (text, what) in faults {
            assert_eq!(Axis::parse(text).expect_err("refused"), what, "{text}");
        }
    }
}

#[cfg(test)]
mod draw_tests {
    use super::*;

    fn draw(count: u64, latin: bool) -> RandomSample {
        RandomSample { from: 10.0, to: 20.0, whole: false, seed: 7, key: 1, count, latin }
    }

    #[test]
    fn a_latin_draw_takes_each_stratum_once() {
        for count in [1, 2, 3, 10, 64, 1000, 4097] {
            let sample = draw(count, true);
            let mut strata: Vec<u64> = (0..count).map(|i| sample.stratum(i)).collect();
            assert!(count < 10 || strata.windows(2).any(|pair| pair[0] > pair[1]), "{count}: shuffled");
            strata.sort_unstable();
            assert!(strata.into_iter().eq(0..count), "{count}");
            assert!((0..count).all(|i| (10.0..=20.0).contains(&sample.value(i))));
        }
    }

    /// The mean of n even draws is 15 with a deviation of 10 / sqrt(12 n): five of those are never left by a fair draw.
    #[test]
    fn draws_are_even_and_their_own() {
        let mean = |draw: &RandomSample| (0..10_000).map(|i| draw.value(i)).sum::<f64>() / 1e4;
        let random = draw(10_000, false);
        assert!((mean(&random) - 15.0).abs() < 5.0 * 10.0 / (12.0 * 1e4_f64).sqrt());
        assert!((mean(&draw(10_000, true)) - 15.0).abs() < 1e-3, "strata leave no room for chance");
        let unequal = [RandomSample { seed: 8, ..random.clone() }, RandomSample { key: 2, ..random.clone() }];
        for other in unequal {
            let product = |i| (random.value(i) - 15.0) * (other.value(i) - 15.0);
            let correlation = (0..10_000).map(product).sum::<f64>() / 1e4 / (100.0 / 12.0);
            assert!(correlation.abs() < 0.05, "{correlation}");
        }
    }

    #[test]
    fn whole_draws_take_both_ends_equally_often() {
        let points = RandomSample { from: 3.0, to: 6.0, whole: true, ..draw(4000, false) };
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
