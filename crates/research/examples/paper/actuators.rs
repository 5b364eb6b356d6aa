//! The paper's figures of a single V-actuator, at its pressures: by the limits, by `section` and by shells.

use stargrip_cam::forecast::actuator::{Actuator, ActuatorPrediction, actuate};
use stargrip_cam::mechanics::hinge::fit::Fit;
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::hinge::{HingeModel, Level};
use std::fmt::Write;

use super::paper_fabric::{WIDTHS, hinge, sheet};
use super::shells::{
    ANGLE_PRESSURES, ANGLES, BENDABILITIES, Case, Computed, HELD, PRESSURES, case, coiled, held, long,
};

/// All tables, in the order of the page.
pub(crate) fn tables() -> [String; 5] {
    [angles(), coiling(), stiffness_by_width(), stiffness_by_angle(), moment()]
}

/// The prediction of a V-actuator by `section`; `None` where its arms are outside of the table, or it is out of range.
pub(crate) fn section(case: &Case) -> Option<ActuatorPrediction> {
    let actuator = Actuator {
        width: 1e-3 * case.width,
        radius: 1e-4 * case.width,
        arm: 1e-3 * case.arm,
        angle: case.angle.to_radians(),
        pressure: 1e3 * case.pressure,
        sheet: sheet(),
    };
    let held: Vec<f64> = case.held.iter().map(|angle| angle.to_radians()).collect();
    let found = actuate(&actuator, Level::Section, &held).ok()?;
    let known = !found.evidence.warnings.iter().any(|warning| warning.contains("without arms"));
    known.then_some(found)
}

/// A value and its range as two cells of a table.
pub(crate) fn ranged(value: f64, range: Option<[f64; 2]>, decimals: usize, unit: &str) -> String {
    match range {
        Some([low, high]) => format!("{value:.decimals$}{unit} | {low:.decimals$} to {high:.decimals$}"),
        None => format!("{value:.decimals$}{unit} | unknown"),
    }
}

/// A shell's number and its mesh error as two cells of a table.
fn meshed(number: Option<[f64; 2]>, decimals: usize, unit: &str) -> String {
    number.map_or("not computed | ".to_owned(), |[value, error]| {
        format!("{value:.decimals$}{unit} | {error:.decimals$}")
    })
}

fn of(found: Option<&Computed>, which: fn(&Computed) -> [f64; 2], scale: f64) -> Option<[f64; 2]> {
    found.map(|found| which(found).map(|number| scale * number))
}

fn angles() -> String {
    let mut out = String::from(
        "| p | phi_0 | phi_t, published 1.28 | phi_t, exact ring | phi, section | its range | phi, shell | its mesh error |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for (pressure, angle) in ANGLE_PRESSURES.into_iter().flat_map(|p| ANGLES.map(|angle| (p, angle))) {
        let (own, hinge) = (long(angle, pressure), hinge(20.0, angle));
        let limit =
            |model: &dyn HingeModel| hinge.angle(model.target(0.1).expect("in range").lambda).to_degrees();
        let said = section(&own).map_or("unknown | ".to_owned(), |found| {
            ranged(found.angle_deg, found.ranges.angle_deg, 1, " deg")
        });
        let shell = meshed(of(own.kept().as_ref(), |found| found.angle, 1.0), 1, " deg");
        let _ = writeln!(
            out,
            "| {pressure} kPa | {angle} deg | {:.1} deg | {:.1} deg | {said} | {shell} |",
            limit(&Fit),
            limit(&Ring)
        );
    }
    out + "\n"
}

fn coiling() -> String {
    let mut out = String::from(
        "| W | 1/eps | p | p W / Y | lambda, section | its range | lambda, shell | its mesh error |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (width, b) in WIDTHS.into_iter().flat_map(|w| BENDABILITIES.map(|b| (w, b))) {
        let Some(own) = coiled(width, b) else { continue };
        let said = section(&own)
            .map_or("unknown | ".to_owned(), |found| ranged(found.coiling, found.ranges.coiling, 3, ""));
        let shell = meshed(of(own.kept().as_ref(), |found| found.coiling, 1.0), 3, "");
        let stretch = sheet().stretch(1e3 * own.pressure, 1e-3 * width);
        let _ =
            writeln!(out, "| {width} mm | {b} | {:.1} kPa | {stretch:.3} | {said} | {shell} |", own.pressure);
    }
    out.push_str(
        "\n| W | largest lambda, section | at 1/eps | largest lambda, shell | at 1/eps | last lambda, shell | at 1/eps |\n|---|---|---|---|---|---|---|\n",
    );
    for width in WIDTHS {
        let most = |values: Vec<(f64, f64)>| values.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let smooth = most(smooth_coiling(width));
        let smooth =
            smooth.map_or("unknown | ".to_owned(), |(b, lambda)| format!("{lambda:.3} | {:.0}", b.round()));
        let shells: Vec<(f64, f64)> = BENDABILITIES
            .into_iter()
            .filter_map(|b| Some((b, coiled(width, b)?.kept()?.coiling[0])))
            .collect();
        let last = shells.last().copied().unwrap_or_default();
        let (b, lambda) = most(shells).unwrap_or_default();
        let _ = writeln!(out, "| {width} mm | {smooth} | {lambda:.3} | {b} | {:.3} | {} |", last.1, last.0);
    }
    out + "\n"
}

/// lambda of `section` against 1/eps, every hundred or so, within its range; with 1/eps from 100 on.
fn smooth_coiling(width: f64) -> Vec<(f64, f64)> {
    smooth(width).into_iter().map(|(b, found)| (b, found.coiling)).collect()
}

/// The prediction of `section` at 60 values of 1/eps up to 16,000, evenly on a logarithmic axis.
pub(crate) fn smooth(width: f64) -> Vec<(f64, ActuatorPrediction)> {
    let places = (0..=60_u8).map(|k| 100.0 * 160_f64.powf(f64::from(k) / 60.0));
    places.filter_map(|b| Some((b, section(&coiled(width, b)?)?))).collect()
}

/// C of the ring, mN m per rad.
pub(crate) fn ring_stiffness(width: f64, angle: f64, pressure: f64) -> f64 {
    let target = Ring.target(0.1).expect("in range");
    1e3 * hinge(width, angle).stiffness(1e3 * pressure, &target)
}

fn stiffness_row(out: &mut String, own: &Case) {
    let Case { width, angle, pressure, .. } = *own;
    let published = Fit.target(0.1).expect("in range");
    let published = 1e3 * hinge(width, angle).stiffness(1e3 * pressure, &published);
    let ring = ring_stiffness(width, angle, pressure);
    let said = section(own).map_or("unknown | ".to_owned(), |found| {
        let range = found.ranges.stiffness_Nm.map(|range| range.map(|end| 1e3 * end));
        ranged(1e3 * found.stiffness_Nm, range, 0, " mN m")
    });
    let kept = own.kept();
    let shell = meshed(of(kept.as_ref(), |found| found.stiffness, 1e3), 0, " mN m");
    let _ = writeln!(out, "{published:.0} mN m | {ring:.0} mN m | {said} | {shell} |");
}

fn stiffness_by_width() -> String {
    let mut out = String::from(
        "| W | p | C, published fit | C, exact ring | C, section | its range | C, shell | its mesh error |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (width, pressure) in WIDTHS.into_iter().flat_map(|w| PRESSURES.map(|p| (w, p))) {
        let _ = write!(out, "| {width} mm | {pressure} kPa | ");
        stiffness_row(&mut out, &case(width, 30.0, pressure));
    }
    out + "\n"
}

fn stiffness_by_angle() -> String {
    let mut out = String::from(
        "| phi_0 | C, published fit | C, exact ring | C, section | its range | C, shell | its mesh error |\n|---|---|---|---|---|---|---|\n",
    );
    for angle in [30.0, 60.0, 90.0, 120.0, 150.0] {
        let _ = write!(out, "| {angle} deg | ");
        stiffness_row(&mut out, &case(30.0, angle, 20.0));
    }
    out + "\n"
}

/// M at `degrees`, mN m, of a limit.
pub(crate) fn limit_moment(model: &dyn HingeModel, degrees: f64) -> f64 {
    let (own, hinge) = (held(), hinge(20.0, 60.0));
    let state = model.state(0.1, hinge.coiling(degrees.to_radians())).expect("in range");
    1e3 * hinge.moment(1e3 * own.pressure, &state)
}

fn moment() -> String {
    let mut out = String::from(
        "| phi | M, published parabola | M, exact ring | M, section with arms | M, shell | its mesh error |\n|---|---|---|---|---|---|\n",
    );
    let own = held();
    let said = section(&own).and_then(|found| found.moment).unwrap_or_default();
    let shell = own.kept().map(|found| found.moments).unwrap_or_default();
    for ((angle, [_, applied]), shell) in HELD.into_iter().zip(said).zip(shell) {
        let shell = meshed(Some(shell.map(|moment| 1e3 * moment)), 2, " mN m");
        let _ = writeln!(
            out,
            "| {angle} deg | {:.2} mN m | {:.2} mN m | {:.2} mN m | {shell} |",
            limit_moment(&Fit, angle),
            limit_moment(&Ring, angle),
            -1e3 * applied
        );
    }
    out + "\n"
}
