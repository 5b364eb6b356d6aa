//! Errors of `section` against stars computed as shells: the constants of the ranges, and their sources.
//!
//! Each star of the table of residuals is predicted from all others of it (docs/ranges.md). Those of the sets `fit`, `range`, `paper` and
//! `test` gave the pairs, all strictly, without the shells' mesh errors: the ranges hold 98 % of the radii, angles, stiffnesses and forces, and
//! 93 % at each n, of the forces at each n and opening. The hinges' are of single hinges that the table of arms does not hold (docs/models.md).

use crate::interval::Interval;
use inflatable::mechanics::star::correction;

/// The shell's radius less the predicted one, over W / sin(pi/n) and [`radius_unit`].
pub const RADIUS: Interval = [-0.0166, 0.0166];
/// The shell's angle of the tips at rest less the predicted one, rad, over [`radius_unit`].
pub const ANGLE: Interval = [-0.0205, 0.0205];
/// The shell's radial stiffness over the predicted one, to the power 1 / [`stiffness_unit`].
pub const STIFFNESS: Interval = [0.9, 1.11];
/// The shell's stiffness of a hinge over the predicted one.
pub const HINGE: Interval = [0.86, 1.03];
/// The shell's angle of a V-actuator less the predicted one, rad.
pub const ACTUATOR: Interval = [-0.0105, 0.0105];
/// [`HINGE`] of the thinnest fabric. Seven V-actuators with t/W = 0.0075, of which the table of arms has none (docs/paper.md), have 0.79 to 1.32
/// times the predicted stiffness, of which their meshes leave up to 0.3 open.
const THIN_HINGE: Interval = [0.6, 1.9];
/// By how much [`ACTUATOR`] is wider of the thinnest fabric: those seven are off by up to 1.6 deg, of which their meshes leave up to 2 open.
const THIN_ACTUATOR: f64 = 7.0;
/// Flat arcs of the V-actuators that were tried, deg.
pub const ARC: Interval = [60.0, 150.0];
/// Validated arms of V-actuators by W; with 3 W their sealed ends make them softer by a third.
pub const ACTUATOR_ARM: Interval = [4.0, 7.5];
/// The shell's force over the predicted one, both where they are opened equally far, by up to 0.9 W; the range of the radius comes on top.
pub const FORCE: Interval = [0.87, 1.18];

/// Largest validated opening by W: 0.9 from the shell's own rest, which may be a little further out than the predicted one.
pub const OPENING: f64 = 0.95;

/// Largest opening by W at which shells were compared, those of `opened.txt` in the research crate; beyond [`OPENING`] the range of a force is
/// wider.
pub const OPENING_REACHED: f64 = 1.6;

/// By how much the range of a force is wider on objects that nearly fill the flat tube's hole, where arms are almost as flat as they were made;
/// [`FLAT_GAPS`] are the gaps by W between object and hole where that begins and where it is reached.
const NEARLY_FLAT: f64 = 1.5;
const FLAT_GAPS: Interval = [0.2, 0.1];

/// Radius of the objects, m, from which on [`flat_unit`] is above 1, in a star of this `flat_hole`'s radius and tube `width`, m.
pub fn flat_begins(flat_hole: f64, width: f64) -> f64 {
    flat_hole - FLAT_GAPS[0] * width
}

/// By how much the range of a force is wider than [`FORCE`] on an object that leaves a gap of `gap` W to the flat tube's hole.
pub fn flat_unit(gap: f64) -> f64 {
    let [begins, least_gap] = FLAT_GAPS;
    1.0 + (NEARLY_FLAT - 1.0) * ((begins - gap) / (begins - least_gap)).clamp(0.0, 1.0)
}

/// nu of the computed stars.
const POISSON: f64 = 0.39;
/// The ends of nu at which others were tried, and by how much the ranges of stiffness and force are wider there: with it they hold those of stars
/// 1 to 24 of `crates/research/poisson.py`.
const POISSON_REACHED: Interval = [0.0, 0.49];
const BEYOND_POISSON: f64 = 1.5;

/// By how much the ranges of stiffness and force of fabric with `nu` are wider than [`STIFFNESS`] and [`FORCE`]: the more, the farther it lies
/// from that of the computed stars.
pub fn poisson_unit(nu: f64) -> f64 {
    let [smallest, largest] = POISSON_REACHED;
    let end = if nu < POISSON { smallest } else { largest };
    1.0 + (BEYOND_POISSON - 1.0) * (nu - POISSON) / (end - POISSON)
}

/// Middle of the validated numbers of points, and its distance from their ends.
const POINTS_ABOUT: [f64; 2] = [5.5, 2.5];
/// By how much the ranges of radius and angle are wider at three and at eight points than between, and that of the stiffness at three; they grow
/// with the square of the distance from the middle: at the ends a star has fewer neighbours.
const MORE_POINTS: f64 = 0.5;

/// By how much the ranges of radius and angle of stars of `points` points are wider than [`RADIUS`] and [`ANGLE`].
pub fn radius_unit(points: u32) -> f64 {
    1.0 + MORE_POINTS * from_middle(points).powi(2)
}

/// By how much the range of the stiffness of stars of `points` points is wider than [`STIFFNESS`].
pub fn stiffness_unit(points: u32) -> f64 {
    1.0 + MORE_POINTS * from_middle(points).min(0.0).powi(2)
}

/// Where `points` lies among those that were tried, from -1 to 1; more are as far out as the most.
fn from_middle(points: u32) -> f64 {
    let [middle, ends] = POINTS_ABOUT;
    ((f64::from(points) - middle) / ends).min(1.0)
}

/// By how much ranges are wider where they end: it grows in proportion to the logarithm of the factor by which a star lies outside of what was
/// tried.
pub const BEYOND: f64 = 4.0;
/// The factor for thin fabric, of which half of the stars of the set `wide` are.
pub const BEYOND_THIN: f64 = 3.0;
/// The factor for points, arms and holes. With both, 95 % of the radii, angles and stiffnesses of stars 1 to 40 of the set `wide` lie strictly in
/// their ranges, each star predicted from all others.
pub const BEYOND_SIZES: f64 = 2.5;
/// Where ranges end in a quantity without computed stars further out: outside of what was tried by this factor.
pub const NOT_FAR: f64 = 1.5;
/// Validated numbers of points.
pub const POINTS: Interval = [3.0, 8.0];
/// Points of the stars of the set `wide`, where ranges end; what follows with this name is of them, too.
pub const POINTS_REACHED: Interval = [2.0, 12.0];
/// 1/eps that was tried.
pub const BENDABILITY: Interval = correction::BENDABILITY;
/// Least 1/eps that was tried of the thinnest fabric.
const THIN_BENDABILITY: f64 = 631.0;
/// Arms by W that were tried.
pub const ARM: Interval = [0.5, 5.0];
/// Arms by W of the set `wide`.
pub const ARM_REACHED: Interval = [0.2, 8.0];
/// rho_0 by W that was tried.
pub const HOLE: Interval = [0.5, 6.0];
/// rho_0 by W of the set `wide`.
pub const HOLE_REACHED: Interval = [0.33, 12.0];
/// t/W that were tried, to the end of the table of arms.
pub const SLENDERNESS: Interval = [0.01, 0.0316];
/// t/W of the set `wide`.
pub const SLENDERNESS_REACHED: Interval = [0.005, 0.04];
/// Largest p W / Y of the table of arms.
pub const STRETCH: Interval = [0.0, 0.1];
/// Validated R*, including 0.
pub const R_STAR: Interval = [0.0, 0.3];
/// Validated phi_i0, deg.
pub const TIP_ANGLE: Interval = [15.0, 70.0];
/// Validated flat arcs of corners, deg.
pub const CORNER_ARC: Interval = [20.0, 120.0];
/// The message for a star far beyond the validated ranges, or with hinges whose arms are not in their tables.
pub const UNKNOWN_MESSAGE: &str =
    "no star like this one was computed as a shell, so its prediction is unknown";
/// The message for a star beyond the validated ranges.
pub const EXTRAPOLATED_MESSAGE: &str = "few stars like this one, or none, were computed as shells";

/// 1/eps that was tried of fabric of t/W = `slender`: from 100 on, of thin fabric from more on.
pub fn bendability(slender: f64) -> Interval {
    let ([lowest, highest], thin) = (BENDABILITY, thinness(slender));
    [if thin > 0.0 { lowest * libm::pow(THIN_BENDABILITY / lowest, thin) } else { lowest }, highest]
}

/// [`HINGE`] of fabric of t/W = `slender`, wider where that is thin.
pub fn hinge(slender: f64) -> Interval {
    let thin = thinness(slender);
    [0, 1].map(|end: usize| HINGE[end] * libm::pow(THIN_HINGE[end] / HINGE[end], thin))
}

/// [`ACTUATOR`] of fabric of t/W = `slender`, wider where that is thin.
pub fn actuator(slender: f64) -> Interval {
    ACTUATOR.map(|error| error * (1.0 + (THIN_ACTUATOR - 1.0) * thinness(slender)))
}

/// The factors `range` to the power `wider`: mostly 1, and designs come in millions.
pub(crate) fn widened(range: Interval, wider: f64) -> Interval {
    if wider == 1.0 { range } else { range.map(|factor| libm::pow(factor, wider)) }
}

/// How thin fabric is, by its logarithm: from 0 at t/W = 0.01 to 1 where ranges end.
fn thinness(slender: f64) -> f64 {
    let [thick, thin] = [SLENDERNESS[0], SLENDERNESS_REACHED[0]];
    if slender >= thick {
        return 0.0;
    }
    (libm::log(thick / slender) / libm::log(thick / thin)).clamp(0.0, 1.0)
}
