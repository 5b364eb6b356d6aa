//! Arms of a star, and the value to blame for a star that cannot be made.
//!
//! Several values together leave a star no arms, and changing any one of them would do. The refusal names every such
//! single change, and points at the key whose value is **farthest out of line**, as a
//! ratio to the paper's star.

use geom::order::sort_by_key;
use std::f64::consts::PI;

use crate::{Refusal, RefusalCode};
use spec::units::{Angle, Length, Readable};
use spec::{KeyPath, StarSpec, key};

/// Largest inner radius that is proposed, mm: that of a spec.
const WIDEST: f64 = 1e5;

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

/// The refusal of a star whose arms would be `l` mm long, 0 or less. Its changes leave arms between bands of half width `half`, mm.
pub(super) fn no_arm(spec: &StarSpec, l: f64, half: f64) -> Refusal {
    let (blamed, advice) = remedy(spec, half, None);
    let StarSpec { points, inner_radius, tube_width, tip_angle, .. } = spec;
    let radii = [("a tip radius", spec.tip_radius), ("a corner radius", spec.corner_radius)].into_iter();
    let round = radii.filter(|(_, radius)| radius.0 > 0.0);
    let round = round.map(|(what, radius)| format!(", {what} of {radius}")).collect::<Vec<_>>().concat();
    let l = if l > -0.05 { -0.0 } else { l };
    let fault = format!(
        "with {points} points, an inner radius of {inner_radius}, a tube width of {tube_width}{round} and a \
         tip angle of {tip_angle} the arms would be {l:.1} mm long"
    );
    Refusal::new(blamed, RefusalCode::NoArm, fault, advice)
}

/// The key to blame and the remedy where the `band` of a star with arms uses them up.
pub(super) fn arms_for_band(spec: &StarSpec, band: Length) -> (KeyPath, String) {
    let narrower = largest(band.0, |band| has_arms(spec, band / 2.0));
    remedy(spec, band.0 / 2.0, narrower.map(|most| (key::seal::BAND, format!("below {} mm", Readable(most)))))
}

/// The key to blame, and all single changes that leave arms between bands of half width `half`, mm; the one of the blamed key first, which
/// is that of `first` if there is one.
fn remedy(spec: &StarSpec, half: f64, first: Option<(KeyPath, String)>) -> (KeyPath, String) {
    let mut changes = single_changes(spec, half);
    let keys = changes.iter().map(|(key, _)| *key);
    let worst = keys.reduce(|a, b| if out_of_line(spec, b) > out_of_line(spec, a) { b } else { a });
    let blamed = first.as_ref().map(|(key, _)| *key).or(worst).unwrap_or(key::star::INNER_RADIUS);
    changes.extend(first);
    // The one that the caret shows comes first.
    sort_by_key(&mut changes, |(key, _)| *key != blamed);
    let words: Vec<String> = changes.iter().map(|(key, change)| format!("{} {change}", key.key())).collect();
    let remedy = match words.as_slice() {
        [] => "no single change is enough: make inner_radius larger and tube_width smaller".to_owned(),
        [only] => format!("must be: {only}"),
        [first, rest @ ..] => format!("must be: {first}; or alone: {}", rest.join(", or ")),
    };
    (blamed, remedy)
}

/// Every single change that would leave arms between bands of half width `half`, mm, each with its limit, at which it does.
fn single_changes(spec: &StarSpec, half: f64) -> Vec<(KeyPath, String)> {
    let points = (3..spec.points).rev().find(|n| fits(spec, half, |star| star.points = *n));
    let straight = 180.0 - 360.0 / f64::from(spec.points) - 0.005;
    let radius =
        smallest([spec.inner_radius.0, WIDEST], |mm| fits(spec, half, |star| star.inner_radius = Length(mm)));
    let width = largest(spec.tube_width.0, |mm| fits(spec, half, |star| star.tube_width = Length(mm)));
    let angle =
        smallest([spec.tip_angle.0, straight], |deg| fits(spec, half, |star| star.tip_angle = Angle(deg)));
    let tip = largest(spec.tip_radius.0, |mm| fits(spec, half, |star| star.tip_radius = Length(mm)));
    let corner = largest(spec.corner_radius.0, |mm| fits(spec, half, |star| star.corner_radius = Length(mm)));
    let upper_limit = |limit: f64| format!("below {} mm", Readable(limit));
    let changes = [
        (key::star::POINTS, points.map(|most| format!("at most {most}"))),
        (key::star::INNER_RADIUS, radius.map(|limit| format!("above {} mm", Readable(limit)))),
        (key::star::TUBE_WIDTH, width.map(upper_limit)),
        (key::star::TIP_ANGLE, angle.map(|limit| format!("above {} deg", Readable(limit)))),
        (key::star::TIP_RADIUS, tip.map(upper_limit)),
        (key::star::CORNER_RADIUS, corner.map(upper_limit)),
    ];
    changes.into_iter().filter_map(|(key, change)| Some((key, change?))).collect()
}

/// Whether `spec` with `change` has arms between bands of half width `half`, mm.
fn fits(spec: &StarSpec, half: f64, change: impl FnOnce(&mut StarSpec)) -> bool {
    let mut changed = spec.clone();
    change(&mut changed);
    has_arms(&changed, half)
}

/// The least hundredth above `from` that `fits`, where all larger ones up to `to` do; `None` if none does.
fn smallest([from, to]: [f64; 2], fits: impl Fn(f64) -> bool) -> Option<f64> {
    first_fitting((100.0 * from).floor(), (100.0 * to).floor(), fits)
}

/// The greatest hundredth below `start` that `fits`, where all smaller ones above 0 do; `None` if none does.
fn largest(start: f64, fits: impl Fn(f64) -> bool) -> Option<f64> {
    if start > 0.01 { first_fitting((100.0 * start).ceil(), 1.0, fits) } else { None }
}

/// Of the whole hundredths from `bad`, which does not fit, to `good` the first that `fits`.
fn first_fitting(mut bad: f64, mut good: f64, fits: impl Fn(f64) -> bool) -> Option<f64> {
    if !fits(good / 100.0) {
        return None;
    }
    while (good - bad).abs() > 1.0 {
        let middle = f64::midpoint(bad, good).round();
        if fits(middle / 100.0) { good = middle } else { bad = middle }
    }
    Some(good / 100.0)
}

/// Whether the star that `spec` describes has arms, and bands of half width `half`, mm, leave a part of each: at tips and corners sharper
/// than that the band takes some (design/contour.rs).
fn has_arms(spec: &StarSpec, half: f64) -> bool {
    let sector = 2.0 * PI / f64::from(spec.points);
    let (l, phi) = (arm_length(spec), spec.tip_angle.rad());
    let ends = [(spec.tip_radius, phi), (spec.corner_radius, phi + sector)];
    let [tip_end, corner_end] =
        ends.map(|(radius, phi)| l - (half - radius.0).max(0.0) / libm::tan(phi / 2.0));
    let shortest = tip_end.min(corner_end);
    phi + sector < PI - 1e-6 && l > 0.0 && shortest > 1e-9 * l
}

/// Arm length l of the star that `spec` describes, mm; it may come out negative.
///
/// `(rho_0 + W + R_e) sin(pi/n) = l sin(phi_i0/2) + (W + R_i + R_e) cos(phi_i0/2)`: Andrade-Silva and
/// Marthelot, supplement, Eq. for l, which is the case R_i = R_e = 0.
pub fn arm_length(spec: &StarSpec) -> f64 {
    let (sin, cos) = libm::sincos(spec.tip_angle.rad() / 2.0);
    let (w, r_i, r_e) = (spec.tube_width.0, spec.tip_radius.0, spec.corner_radius.0);
    ((spec.inner_radius.0 + w + r_e) * libm::sin(PI / f64::from(spec.points)) - (w + r_i + r_e) * cos) / sin
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Star;
    use spec::units::{Angle, Length};

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
        let changes = single_changes(&bad, 0.0);
        assert!(changes.len() >= 3, "{changes:?}");
        for (key, change) in changes {
            let number =
                change.split_whitespace().find_map(|word| word.parse::<f64>().ok()).expect("a number");
            let holds_with = |value: f64| {
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
            assert!(holds_with(number) && !holds_with(worse), "{key}: {change}");
        }
    }
}
