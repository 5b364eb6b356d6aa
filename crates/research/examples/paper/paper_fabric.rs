//! The paper's fabric and tubes.

use stargrip_cam::mechanics::hinge::Hinge;
use stargrip_cam::mechanics::strength::ElasticSheet;

/// Tube widths, mm.
pub(crate) const WIDTHS: [f64; 3] = [20.0, 30.0, 40.0];

/// Nylon of 0.3 mm.
pub(crate) fn sheet() -> ElasticSheet {
    ElasticSheet::new(0.3e-3, 128e6, 0.39).expect("valid")
}

/// A hinge of R* = 0.1 in a tube of `width` mm whose arms are `degrees` apart when flat.
pub(crate) fn hinge(width: f64, degrees: f64) -> Hinge {
    Hinge { r_star: 0.1, width: 1e-3 * width, rest_angle: degrees.to_radians() }
}
