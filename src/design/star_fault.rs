//! Arms of a star, and the value to blame for a star that cannot be made.
//!
//! Several values together leave a star no arms, and changing any one of them would do. The refusal names every such
//! single change, and points at the key whose value is **farthest out of line**, as a
//! ratio to the paper's star.

use std::f64::consts::PI;

use crate::design::{Refusal, RefusalCode};
use crate::spec::{KeyPath, StarSpec, key};
use crate::units::Readable;

/// The candidate (key, ratio to the usual value) farthest out of line; the first of equals.
pub(super) fn blamed<const N: usize>(candidates: [(KeyPath, f64); N]) -> KeyPath {
    let [first, ..] = candidates.as_slice() else { return key::star::POINTS };
    candidates.iter().fold(first, |a, b| if b.1 > a.1 { b } else { a }).0
}

/// The ratio of the value of `key` to that of the paper's star (5, 50 mm, 30 mm, 30 deg, sharp), on the side where arms become
/// short. Width and radius are compared with each other, so that a large star is not out of line by its size; of the two, the one
/// with the less usual size counts. A radius of half a width counts as twice the usual.
fn out_of_line(spec: &StarSpec, key: KeyPath) -> f64 {
    let (rho, w) = (spec.inner_radius.0, spec.tube_width.0);
    let wide = w / 30.0 >= 50.0 / rho;
    let ratio = (w / rho) / (30.0 / 50.0);
    match key {
        key::star::POINTS => f64::from(spec.points) / 5.0,
        key::star::TUBE_WIDTH if wide => ratio,
        key::star::INNER_RADIUS if !wide => ratio,
        key::star::TIP_ANGLE => 30.0 / spec.tip_angle.0,
        key::star::TIP_RADIUS => 1.0 + 2.0 * spec.tip_radius.0 / w,
        key::star::CORNER_RADIUS => 1.0 + 2.0 * spec.corner_radius.0 / w,
        _ => 0.0,
    }
}

/// The refusal of a star whose arms would be `l` mm long, 0 or less.
pub(super) fn no_arm(spec: &StarSpec, l: f64) -> Refusal {
    let mut changes = single_changes(spec);
    let keys = changes.iter().map(|(key, _)| *key);
    let worst = keys.reduce(|a, b| if out_of_line(spec, b) > out_of_line(spec, a) { b } else { a });
    let blamed = worst.unwrap_or(key::star::INNER_RADIUS);
    // The one that the caret shows comes first.
    changes.sort_by_key(|(key, _)| *key != blamed);
    let words: Vec<String> = changes.iter().map(|(key, change)| format!("{} {change}", key.key())).collect();
    let remedy = match words.as_slice() {
        [] => "no single change is enough: make inner_radius larger and tube_width smaller".to_owned(),
        [only] => format!("must be: {only}"),
        [first, rest @ ..] => format!("must be: {first}; or alone: {}", rest.join(", or ")),
    };
    let round: Vec<String> = [("a tip radius", spec.tip_radius), ("a corner radius", spec.corner_radius)]
        .into_iter()
        .filter(|(_, radius)| radius.0 > 0.0)
        .map(|(what, radius)| format!(", {what} of {radius}"))
        .collect();
    let round = round.concat();
    let found = format!(
        "with {} points, an inner radius of {}, a tube width of {}{round} and a tip angle of {} the arms would be {:.1} mm long",
        spec.points,
        spec.inner_radius,
        spec.tube_width,
        spec.tip_angle,
        if l > -0.05 { -0.0 } else { l }
    );
    Refusal::new(blamed, RefusalCode::NoArm, found, remedy)
}

/// Every single change that would give arms, each with its limit.
///
/// All limits are where `(rho_0 + W + R_e) sin(pi/n) = (W + R_i + R_e) cos(phi_i0/2)`, the arm's length of
/// [`arm_length`] at 0; they are rounded to hundredths towards the side that works.
fn single_changes(spec: &StarSpec) -> Vec<(KeyPath, String)> {
    let n = f64::from(spec.points);
    let (sin, cos) = (libm::sin(PI / n), libm::cos(spec.tip_angle.rad() / 2.0));
    let (rho, w) = (spec.inner_radius.0, spec.tube_width.0);
    let (r_i, r_e) = (spec.tip_radius.0, spec.corner_radius.0);
    let below = |limit: f64| {
        let limit = (limit * 100.0).floor() / 100.0;
        (limit > 0.0).then(|| format!("below {} mm", Readable(limit)))
    };
    let above = |limit: f64, unit: &str| format!("above {} {unit}", Readable((limit * 100.0).ceil() / 100.0));
    let fits = |m: &u32| {
        let corner = spec.tip_angle.rad() + 2.0 * PI / f64::from(*m);
        corner < PI - 1e-6 && arm_length(spec, *m) > 0.0
    };
    let most = (3..spec.points).rev().find(fits).map(|most| format!("at most {most}"));
    // Below a straight corner cos > sin.
    let width = below(((rho + r_e) * sin - (r_i + r_e) * cos) / (cos - sin));
    let radius = above((w + r_i + r_e) * cos / sin - w - r_e, "mm");
    let wide = (rho + w + r_e) * sin / (w + r_i + r_e);
    let angle = (wide > sin && wide < 1.0).then(|| above((2.0 * libm::acos(wide)).to_degrees(), "deg"));
    let tip = below((rho + w + r_e) * sin / cos - w - r_e).filter(|_| r_i > 0.0);
    let corner = below(((rho + w) * sin - (w + r_i) * cos) / (cos - sin)).filter(|_| r_e > 0.0);
    let changes = [
        (key::star::POINTS, most),
        (key::star::INNER_RADIUS, Some(radius)),
        (key::star::TUBE_WIDTH, width),
        (key::star::TIP_ANGLE, angle),
        (key::star::TIP_RADIUS, tip),
        (key::star::CORNER_RADIUS, corner),
    ];
    changes.into_iter().filter_map(|(key, change)| Some((key, change?))).collect()
}

/// Arm length l of the star that `spec` describes with `n` points, mm; it may come out negative.
///
/// `(rho_0 + W + R_e) sin(pi/n) = l sin(phi_i0/2) + (W + R_i + R_e) cos(phi_i0/2)`: Andrade-Silva and
/// Marthelot, supplement, Eq. for l, which is the case R_i = R_e = 0.
pub fn arm_length(spec: &StarSpec, n: u32) -> f64 {
    let (sin, cos) = libm::sincos(spec.tip_angle.rad() / 2.0);
    let (w, r_i, r_e) = (spec.tube_width.0, spec.tip_radius.0, spec.corner_radius.0);
    ((spec.inner_radius.0 + w + r_e) * libm::sin(PI / f64::from(n)) - (w + r_i + r_e) * cos) / sin
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Star;
    use crate::units::{Angle, Length};

    fn paper() -> StarSpec {
        StarSpec::paper(5)
    }

    #[test]
    fn the_value_that_is_out_of_line_is_blamed() {
        let cases: [(StarSpec, KeyPath); 6] = [
            (StarSpec { tube_width: Length(300.0), ..paper() }, key::star::TUBE_WIDTH),
            (StarSpec { points: 9, ..paper() }, key::star::POINTS),
            (StarSpec { inner_radius: Length(5.0), ..paper() }, key::star::INNER_RADIUS),
            (StarSpec { points: 9, tip_angle: Angle(2.0), ..paper() }, key::star::TIP_ANGLE),
            (StarSpec { tip_radius: Length(40.0), ..paper() }, key::star::TIP_RADIUS),
            (StarSpec { corner_radius: Length(90.0), ..paper() }, key::star::CORNER_RADIUS),
        ];
        for (spec, key) in cases {
            let refusal = Star::new(&spec).expect_err("no arms");
            assert_eq!((refusal.code, refusal.key), (RefusalCode::NoArm, key), "{refusal}");
            assert!(refusal.remedy.starts_with(&format!("must be: {} ", key.key())), "{refusal}");
            // The blamed key is named in the finding.
            assert!(refusal.found.contains(&key.key().replace('_', " ")), "{refusal}");
        }
    }

    #[test]
    fn every_change_that_is_named_would_do_alone_and_little_less_would_not() {
        let bad = StarSpec {
            tube_width: Length(300.0),
            tip_radius: Length(1.0),
            corner_radius: Length(1.0),
            ..paper()
        };
        let changes = single_changes(&bad);
        assert!(changes.len() >= 3, "{changes:?}");
        for (key, change) in changes {
            let number =
                change.split_whitespace().find_map(|word| word.parse::<f64>().ok()).expect("a number");
            let with = |value: f64| {
                let mut spec = bad.clone();
                match key {
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "a few points"
                    )]
                    key::star::POINTS => spec.points = value as u32,
                    key::star::INNER_RADIUS => spec.inner_radius = Length(value),
                    key::star::TUBE_WIDTH => spec.tube_width = Length(value),
                    key::star::TIP_ANGLE => spec.tip_angle = Angle(value),
                    key::star::TIP_RADIUS => spec.tip_radius = Length(value),
                    _ => spec.corner_radius = Length(value),
                }
                Star::new(&spec).is_ok()
            };
            let worse = if change.contains("above") { number - 0.02 } else { number + 0.02 };
            let worse = if key == key::star::POINTS { number + 1.0 } else { worse };
            assert!(with(number) && !with(worse), "{key}: {change}");
        }
    }
}
