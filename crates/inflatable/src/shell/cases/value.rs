//! A number with its mesh error.

/// A number computed on three meshes of a regularly refined family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Extrapolated to triangles of no size.
    pub value: f64,
    /// Mesh error: the difference between the last two meshes or from the finest to the extrapolated value,
    /// whichever is larger.
    pub error: f64,
    /// Computed values, coarse to fine.
    pub meshes: [f64; 3],
}

impl Value {
    /// Richardson's extrapolation. The order is the observed one, kept between 1 and 2: a higher one is chance, and a lower
    /// one, or a sequence that turns back, is taken as 1.
    pub fn new(meshes: [f64; 3]) -> Self {
        let [coarse, middle, fine] = meshes;
        let (first_change, last) = (middle - coarse, fine - middle);
        let ratio = if last == 0.0 { 4.0 } else { (first_change / last).clamp(2.0, 4.0) };
        let ratio = if ratio.is_nan() { 2.0 } else { ratio };
        let value = fine + last / (ratio - 1.0);
        Self { value, error: last.abs().max((value - fine).abs()), meshes }
    }

    /// The value in another unit, `factor` of which are one of this.
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            value: factor * self.value,
            error: factor.abs() * self.error,
            meshes: self.meshes.map(|mesh| factor * mesh),
        }
    }

    /// `part` of the way from it to `other`, mesh by mesh; the part `open` of the difference between both adds to the error.
    #[must_use]
    pub(super) fn blended(self, other: Self, part: f64, open: f64) -> Self {
        let meshes = std::array::from_fn(|mesh| {
            let smooth = self.meshes[mesh];
            smooth + part * (other.meshes[mesh] - smooth)
        });
        let blend = Self::new(meshes);
        Self { error: blend.error + open * (other.value - self.value).abs(), ..blend }
    }

    /// The value from an origin that lies `offset` lower.
    pub fn shifted(self, offset: f64) -> Self {
        Self { value: self.value + offset, error: self.error, meshes: self.meshes.map(|mesh| mesh + offset) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_converges_regularly_is_extrapolated_exactly() {
        for (order, factor) in [(1, 2.0_f64), (2, 4.0)] {
            let meshes = [0, 1, 2].map(|level| 3.0 + 0.8 / factor.powi(level));
            let value = Value::new(meshes);
            assert!((value.value - 3.0).abs() < 1e-14, "order {order}: {value:?}");
            assert!(value.error > 0.999 * (meshes[2] - 3.0).abs());
        }
    }

    #[test]
    fn what_turns_back_is_not_trusted_beyond_its_last_step() {
        let value = Value::new([1.0, 2.0, 1.5]);
        assert_eq!((value.value, value.error), (1.0, 0.5));
        assert_eq!(Value::new([2.0; 3]), Value { value: 2.0, error: 0.0, meshes: [2.0; 3] });
    }
}
