//! Errors of `section` against stars computed as shells: the constants of the ranges, and their sources.
//!
//! The stars of the set `range` and stars 61 to 240 of the set `test` (docs/ranges.md) gave the pairs of radius and stiffness. The radius's
//! holds 98.5 % of them strictly, without the shell's mesh error. The stiffness's holds 95 %, at each n 94 %, with the mesh error added to
//! the error. The angle's holds 95 % where the mesh error counts as inside. The force's holds 95 % of all forces of stars up to 240 strictly,
//! and 90 % at each n and opening. The hinges' are of single hinges that the table of arms does not hold (docs/models.md).

use crate::forecast::ranges::Interval;
use inflatable::mechanics::star::correction;

/// The shell's radius less the predicted one, over W / sin(pi/n) and [`radius_unit`].
pub const RADIUS: Interval = [-0.021, 0.020];
/// The shell's angle of the tips at rest less the predicted one, rad, over [`angle_unit`](super::angle_unit).
pub const ANGLE: Interval = [-0.052, 0.044];
/// The shell's radial stiffness over the predicted one, to the power 1 / [`stiffness_unit`].
pub const STIFFNESS: Interval = [0.835, 1.197];
/// The shell's stiffness of a hinge over the predicted one.
pub const HINGE: Interval = [0.86, 1.03];
/// The shell's angle of a V-actuator less the predicted one, rad.
pub const ACTUATOR: Interval = [-0.0105, 0.0105];
/// Validated flat arcs of V-actuators, deg.
pub const ARC: Interval = [60.0, 150.0];
/// Validated arms of V-actuators by W; with 3 W their sealed ends make them softer by a third.
pub const ACTUATOR_ARM: Interval = [4.0, 7.5];
/// The shell's force over the predicted one, both where they are opened equally far, by up to 0.9 W; the range of the radius comes on top.
pub const FORCE: Interval = [0.66, 1.36];

/// Largest validated opening by W: 0.9 from the shell's own rest, which may be a little further out than the predicted one.
pub const OPENING: f64 = 0.95;

/// Arms shorter than W: the error of the angle grows as this power of W / l. A star of eight points with l / W of 0.69, computed by two
/// independent shells, is off by 1.2 times what W / l alone allows.
pub const SHORT_ARM: f64 = 1.75;

/// Middle of the validated numbers of points, and its distance from their ends.
const POINTS_ABOUT: [f64; 2] = [5.5, 2.5];
/// By how much the range of the radius is wider at eight points than at five, and that of the stiffness at three points; both grow with the
/// square of the distance from the middle.
const MORE_POINTS: [f64; 2] = [0.4, 0.8];
/// By how much the range of the stiffness is wider where arms are shorter than W, by each ln(W / l).
const SHORT_STIFFNESS: f64 = 0.5;

/// By how much the range of the radius of stars of `points` points is wider than [`RADIUS`]: stars of many points have short arms.
pub fn radius_unit(points: u32) -> f64 {
    1.0 + MORE_POINTS[0] * from_middle(points).max(0.0).powi(2)
}

/// By how much the range of the stiffness of stars of `points` points and arms of `arm` widths is wider than [`STIFFNESS`].
pub fn stiffness_unit(points: u32, arm: f64) -> f64 {
    1.0 + MORE_POINTS[1] * from_middle(points).min(0.0).powi(2)
        + SHORT_STIFFNESS * libm::log(1.0 / arm).max(0.0)
}

fn from_middle(points: u32) -> f64 {
    let [middle, ends] = POINTS_ABOUT;
    (f64::from(points) - middle) / ends
}

/// By how much ranges are wider where they end: it grows in proportion to the logarithm of the factor by which a star lies outside.
pub const BEYOND: f64 = 4.0;
/// End of the ranges: a factor beyond the validated interval of any of the quantities below.
pub const NOT_FAR: f64 = 1.5;
/// Validated numbers of points.
pub const POINTS: Interval = [3.0, 8.0];
/// Validated 1/eps.
pub const BENDABILITY: Interval = correction::BENDABILITY;
/// Validated arms by W.
pub const ARM: Interval = [0.5, 5.0];
/// Validated rho_0 by W.
pub const HOLE: Interval = [0.5, 6.0];
/// t/W of the table of arms.
pub const SLENDERNESS: Interval = [0.01, 0.0316];
/// Largest p W / Y of the table of arms.
pub const STRETCH: Interval = [0.0, 0.1];
/// Validated R*, including 0.
pub const R_STAR: Interval = [0.0, 0.3];
/// Validated phi_i0, deg.
pub const TIP_ANGLE: Interval = [15.0, 70.0];
/// Validated flat arcs of corners, deg.
pub const CORNER_ARC: Interval = [20.0, 120.0];
/// Message for a star far beyond the validated domain, or whose hinges' arms are not in their table.
pub const UNKNOWN_WORDS: &str = "nothing is known of stars like this one, none was computed as a shell";
/// Message for a star beyond the validated domain.
pub const BEYOND_WORDS: &str = "stars like this one were not computed as shells";
