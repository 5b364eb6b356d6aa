//! What the Newton steps of a sheet say about the next one.

/// Accuracy of a step, relative: near an equilibrium each leaves about a thousandth of the residual.
pub(super) const STEP_ACCURACY: f64 = 1e-6;
/// The accuracy of a step far from an equilibrium.
const ROUGH_ACCURACY: f64 = 1e-2;
/// The least shift, by the pressure.
const LEAST_SHIFT: f64 = 0.01;

/// What the steps so far say about the next one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Experience {
    /// The shift of the last step.
    pub(super) shift: f64,
    /// The shift that the last search found.
    pub(super) found: f64,
    /// The residual, if one was seen since [`Experience::begin`], and its part that the last step left.
    residual: Option<f64>,
    pub(super) fall: f64,
    /// The residual that a linear sheet would have now.
    pub(super) linear: f64,
    /// The accuracy that the next step deserves, relative.
    pub(super) accuracy: f64,
}

impl Experience {
    pub(super) const NONE: Self =
        Self { shift: 0.0, found: 0.0, residual: None, fall: 1.0, linear: 0.0, accuracy: ROUGH_ACCURACY };

    /// Forgets the residuals: load or stiffness change.
    pub(super) fn begin(&mut self) {
        *self = Self { shift: self.shift, found: self.found, ..Self::NONE };
    }

    /// Compares the residual after a step with the one before and with that of a linear sheet: choice 1 of Eisenstat and Walker, "Choosing the
    /// forcing terms in an inexact Newton method" (1996).
    pub(super) fn see(&mut self, residual: f64) {
        if let Some(previous) = self.residual.replace(residual) {
            self.accuracy = ((residual - self.linear).abs() / previous).clamp(STEP_ACCURACY, ROUGH_ACCURACY);
            self.fall = (residual / previous).min(1.0);
        }
    }
}

/// The least shift at `pressure`.
pub(super) fn least_shift(pressure: f64) -> f64 {
    LEAST_SHIFT * pressure
}
