//! The moment of a tabled hinge around its rest.

/// Places of the moment's samples, as parts of lambda_t - 1 from lambda_t: from the flat angle to as far beyond.
pub const OFFSETS: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];

/// The moment of a hinge around its rest: a quartic for the logarithm of its secant stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Coiling factor at rest.
    pub(super) lambda: f64,
    /// `C alpha_0 / (p W^3)` at rest.
    pub(super) stiffness: f64,
    /// Logarithms of the secant stiffness over the stiffness, at [`OFFSETS`].
    pub(super) secants: [f64; 4],
}

impl Moment {
    /// dV_bar/dlambda at `lambda`: the closing moment over p W^3. Between the flat angle and as far beyond the rest.
    pub fn slope(&self, lambda: f64) -> f64 {
        let change = lambda - self.lambda;
        let x = change / (self.lambda - 1.0);
        -change * self.stiffness * libm::exp(self.secant(x))
    }

    /// d2V_bar/dlambda2 at `lambda`, in the same range.
    pub fn curvature(&self, lambda: f64) -> f64 {
        let change = lambda - self.lambda;
        let x = change / (self.lambda - 1.0);
        -self.stiffness * libm::exp(self.secant(x)) * (1.0 + x * self.secant_slope(x))
    }

    /// The derivative of the quartic by x.
    fn secant_slope(&self, x: f64) -> f64 {
        let term = |i: usize| {
            let roots = OFFSETS.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, at)| *at);
            // The product over the roots, 0 among them, and its derivative.
            let (_, slope) = std::iter::once(0.0).chain(roots).fold((1.0, 0.0), |(value, slope), root| {
                let scale = OFFSETS[i] - root;
                (value * (x - root) / scale, (slope * (x - root) + value) / scale)
            });
            self.secants[i] * slope
        };
        (0..4).map(term).sum()
    }

    /// The quartic through the logarithms of the secants, which is 0 at 0.
    fn secant(&self, x: f64) -> f64 {
        let terms = (0..4).map(|i| {
            let other_offsets = OFFSETS.iter().enumerate().filter(|(j, _)| *j != i);
            let weight = other_offsets.map(|(_, at)| (x - at) / (OFFSETS[i] - at)).product::<f64>();
            self.secants[i] * x / OFFSETS[i] * weight
        });
        terms.sum()
    }
}
