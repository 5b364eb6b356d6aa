//! How far `section` is from stars computed as shells: the constants that ranges are made of, and where they were taken.
//!
//! Each pair of radius, angle and stiffness was chosen so that at least 95 % of the stars of the second set (docs/ranges.md) and of stars 61 to 240
//! of the third lie within it, a shell's number counted with its mesh error. The force's is of all stars that were opened. The hinges' are of single hinges that the table of arms does not hold (docs/models.md).

use crate::forecast::ranges::Interval;
use inflatable::mechanics::star::correction;

/// The shell's radius less the predicted one, over W / sin(pi/n).
pub const RADIUS: Interval = [-0.016, 0.018];
/// The shell's angle of the tips at rest less the predicted one, rad, over [`angle_unit`](super::angle_unit).
pub const ANGLE: Interval = [-0.052, 0.044];
/// The shell's radial stiffness over the predicted one.
pub const STIFFNESS: Interval = [0.87, 1.17];
/// The shell's stiffness of a hinge over the predicted one.
pub const HINGE: Interval = [0.86, 1.03];
/// The shell's angle of a V-actuator less the predicted one, rad.
pub const ACTUATOR: Interval = [-0.0105, 0.0105];
/// Flat arcs of the V-actuators that were tried, deg.
pub const ARC: Interval = [60.0, 150.0];
/// Arms by W of the V-actuators that were tried; with 3 W their sealed ends make them softer by a third.
pub const ACTUATOR_ARM: Interval = [4.0, 7.5];
/// The shell's force over the predicted one, both where they are opened equally far, by up to 0.9 W; the range of the radius comes on top.
pub const FORCE: Interval = [0.72, 1.32];

/// Openings by W that were tried: 0.9 from the shell's own rest, which may be a little further out than the predicted one.
pub const OPENING: f64 = 0.95;

/// Arms shorter than W: the error of the angle grows as this power of W / l. A star of eight points with l / W of 0.69, computed by two
/// independent shells, is off by 1.2 times what W / l alone allows.
pub const SHORT_ARM: f64 = 1.75;

/// By how much ranges are wider where they end: it grows in proportion to the logarithm of the factor by which a star lies outside.
pub const BEYOND: f64 = 4.0;
/// Where ranges end: outside of what was tried by this factor in any of what follows.
pub const NOT_FAR: f64 = 1.5;
/// Points that were tried.
pub const POINTS: Interval = [3.0, 8.0];
/// 1/eps that was tried.
pub const BENDABILITY: Interval = correction::BENDABILITY;
/// Arms by W that were tried.
pub const ARM: Interval = [0.5, 5.0];
/// rho_0 by W that was tried.
pub const HOLE: Interval = [0.5, 6.0];
/// t/W of the table of arms.
pub const SLENDERNESS: Interval = [0.01, 0.0316];
/// Largest p W / Y of the table of arms.
pub const STRETCH: Interval = [0.0, 0.1];
/// R* that were tried; 0 among them.
pub const R_STAR: Interval = [0.0, 0.3];
/// phi_i0 that were tried, deg.
pub const TIP_ANGLE: Interval = [15.0, 70.0];
/// Flat arcs of corners that were tried, deg.
pub const CORNER_ARC: Interval = [20.0, 120.0];
/// What is said of a star that lies far beyond it, or whose hinges' arms are not in their table.
pub const UNKNOWN_WORDS: &str = "nothing is known of stars like this one, none was computed as a shell";
/// What is said of a star that lies beyond what was tried.
pub const BEYOND_WORDS: &str = "stars like this one were not computed as shells";
