//! Compares the predictions with the stars computed as shells: the source of the constants of [`errors`](stargrip_cam::forecast::ranges::errors),
//! and a check of the ranges.

use crate::predicted::{SETTLED, predicted};
use crate::residuals::fitted;
use crate::stars::computed::{ComputedStar, MeshedNumber, ShellNumbers};
use crate::stars::draw::Set;
use crate::stars::shipped::shipped;
use inflatable::mechanics::star::residuals::Ratios;
use inflatable::mechanics::star::response::Inflated;
use inflatable::mechanics::star::{Correction, Mechanism};
use stargrip_cam::forecast::case::Case;
use stargrip_cam::forecast::interval::Interval;
use stargrip_cam::forecast::outcome::Outcome;
use std::f64::consts::PI;

/// A number of the shell beside the predicted one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The shell's.
    pub shell: f64,
    /// Mesh error of the shell's number.
    pub mesh: f64,
    /// The prediction's.
    pub predicted: f64,
    /// Range of the prediction.
    pub range: Interval,
    /// The error as its constant counts it: see [`errors`](stargrip_cam::forecast::ranges::errors).
    pub error: f64,
}

/// One star with its shell's and its predicted values.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Set of the star.
    pub set: Set,
    /// Number of the star in its set.
    pub number: u32,
    /// n.
    pub points: u32,
    /// W, m.
    pub width: f64,
    /// rho_f, m.
    pub radius: Pair,
    /// The tips' angle at rest, rad; `None` where arms touch.
    pub angle: Option<Pair>,
    /// Radial stiffness, N/m; `None` where arms touch, or where meshes leave a quarter of it open.
    pub stiffness: Option<Pair>,
    /// Radial forces on objects that pass the flat tube's hole; none where arms touch, or where meshes leave a quarter open.
    pub forces: Vec<Pressed>,
}

/// A force on an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressed {
    /// By how much the object opens the shell, over W.
    pub opening: f64,
    /// Whether it passes the hole as a spec cuts it that has no other band and flap than the default ones: only then such a spec gets this number.
    pub passes: bool,
    /// The gap between the object and the flat tube's hole, over W.
    pub gap: f64,
    /// N. The mesh error counts that of the radius, too: the object is the same, not the opening.
    pub force: Pair,
}

/// Depth of the default flap in front of the corners, mm: `band` and `hole_allowance`.
pub const FLAP: f64 = 3.0;

/// Compares `star` with its prediction; `None` where the shell refuses it, or there is no prediction.
pub fn compare(star: &ComputedStar) -> Option<Comparison> {
    compare_by(star, Correction::new)
}

/// All shipped stars compared with their predictions. Those that the table of residuals is made of are predicted from all others of it.
///
/// # Errors
/// As for [`fitted`].
pub fn compare_all() -> Result<Vec<Comparison>, &'static str> {
    let stars = shipped();
    let left_out = fitted(&stars)?.left_out;
    let compared = |one: &ComputedStar| match left_out.iter().find(|(star, _)| *star == one.star) {
        Some((_, own)) => compare_by(one, |moves, width, ratios| {
            Correction::trend(moves, width, ratios).with_residuals(own)
        }),
        None => compare(one),
    };
    Ok(stars.iter().filter_map(compared).collect())
}

fn compare_by(
    star: &ComputedStar,
    correction: impl Fn(&Mechanism, f64, Ratios) -> Correction,
) -> Option<Comparison> {
    let shell = star.found.as_ref()?;
    predicted(&star.star, correction, |case, inflated, own| compared(star, shell, (case, inflated, own)))
}

fn compared(
    star: &ComputedStar,
    shell: &ShellNumbers,
    (case, inflated, outcome): (&Case, &Inflated<'_>, &Outcome),
) -> Option<Comparison> {
    // The star at rest is compared first. Then each force, where the arms do not touch: the error at the same opening, and the
    // prediction with its range on the same object. Meshes that leave a stiffness open settle nothing.
    let moves = &case.mechanism;
    let unit = moves.width / (PI / f64::from(moves.points)).sin();
    let ShellNumbers { radius, angle, stiffness, .. } = shell;
    let rest = pair(1e-3 * radius.value, 1e-3 * radius.error, outcome.rest.radius, outcome.ranges.radius)?;
    let angle = [angle.value, angle.error].map(f64::to_radians);
    let angle = pair(angle[0], angle[1], outcome.rest.equilibrium, outcome.ranges.angle);
    let open = (stiffness.error / stiffness.value).abs();
    let settled = open < SETTLED;
    let spring =
        pair(1e3 * stiffness.value, 1e3 * stiffness.error, outcome.rest.stiffness, outcome.ranges.stiffness);
    let opened = |(part, secant): &(f64, MeshedNumber)| {
        let opening = part * moves.width;
        let shell = secant.value * 1e3 * stiffness.value * opening;
        let open = (secant.error / secant.value).abs() + open;
        // The constant counts forces at the same opening; a range, on the same object.
        let force = inflated.linear_force(outcome.rest.radius + opening, &outcome.rest).ok()?;
        let object = 1e-3 * radius.value + opening;
        let extra = secant.value * stiffness.value * radius.error;
        let predicted = if object < outcome.rest.radius {
            0.0
        } else {
            inflated.linear_force(object, &outcome.rest).ok()?
        };
        let grasp = inflated.grasp(&outcome.rest)?;
        let range = outcome.ranges.force(&grasp, grasp.force(object), object, &outcome.rest)?;
        let force = Pair { shell, mesh: open * shell + extra, predicted, range, error: shell / force };
        let passes = object <= case.inner_radius - 1e-3 * FLAP;
        (open < SETTLED && shell > 0.0 && object <= case.inner_radius).then_some(Pressed {
            opening: *part,
            passes,
            gap: (case.inner_radius - object) / moves.width,
            force,
        })
    };
    let touch = outcome.ranges.angle.is_none() || shell.arm_contact.value > 0.0;
    let forces = shell.secants.iter().filter(|_| !touch).filter_map(opened);
    Some(Comparison {
        set: star.star.set,
        number: star.star.number,
        points: star.star.points,
        width: moves.width,
        radius: Pair { error: rest.error / unit, ..rest },
        angle,
        stiffness: spring.filter(|_| settled).map(|pair| Pair { error: pair.shell / pair.predicted, ..pair }),
        forces: forces.collect(),
    })
}

fn pair(shell: f64, mesh: f64, predicted: f64, range: Option<Interval>) -> Option<Pair> {
    Some(Pair { shell, mesh, predicted, range: range?, error: shell - predicted })
}

impl Pair {
    /// Whether the shell's number itself lies in the range.
    pub fn holds_strictly(&self) -> bool {
        (self.range[0]..=self.range[1]).contains(&self.shell)
    }

    /// Whether the shell's number, within its mesh error, lies in the range.
    pub fn is_in_range(&self) -> bool {
        self.shell + self.mesh >= self.range[0] && self.shell - self.mesh <= self.range[1]
    }
}

/// Forces of coarse shells on objects, among them those within stars whose arms touch: a star a line.
const OPENED: &str = include_str!("stars/opened.txt");

/// A force of a coarse shell on an object.
#[derive(Clone, Copy, Debug)]
pub struct Opened {
    /// Set and number of the star.
    pub star: (Set, u32),
    /// Whether its arms touch while it is empty, by the prediction.
    pub touches: bool,
    /// By how much the object opens the shell, over W.
    pub opening: f64,
    /// Radial forces, N, on the same object. The error is their ratio.
    pub force: Pair,
}

/// The forces of `opened.txt` whose meshes leave less than a quarter open, where there is a range.
pub fn opened() -> Vec<Opened> {
    let stars = shipped();
    OPENED.lines().filter(|line| !line.starts_with('#')).filter_map(|line| one_opened(&stars, line)).collect()
}

fn one_opened(stars: &[ComputedStar], line: &str) -> Option<Opened> {
    let (names, numbers) = line.split_once(' ').and_then(|(set, rest)| Some((set, rest.split_once(' ')?)))?;
    let star = &stars
        .iter()
        .find(|one| one.star.set.name() == names && one.star.number.to_string() == numbers.0)?
        .star;
    let numbers: Vec<f64> = numbers.1.split(' ').filter_map(|number| number.parse().ok()).collect();
    let [object, shell, mesh, radius] = numbers[..] else { return None };
    predicted(star, Correction::new, |case, inflated, own| {
        let object = 1e-3 * object;
        let predicted = inflated.linear_force(object, &own.rest).ok()?;
        let range = own.ranges.force(&inflated.grasp(&own.rest)?, predicted, object, &own.rest)?;
        (mesh < SETTLED * shell && object <= case.hole).then_some(Opened {
            star: (star.set, star.number),
            touches: own.rest.equilibrium < own.rest.angle,
            opening: (object - 1e-3 * radius) / case.mechanism.width,
            force: Pair { shell, mesh, predicted, range, error: shell / predicted },
        })
    })
}
