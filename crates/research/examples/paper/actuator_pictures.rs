//! The pictures of a single V-actuator.

use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::fit::Fit;
use stargrip_cam::mechanics::hinge::ring::Ring;

use super::actuators::{limit_moment, ring_stiffness, section, smooth};
use super::paper_fabric::{WIDTHS, hinge};
use super::plot::{Axis, COLOURS, GREY, Look, Plot, Series};
use super::shells::{
    ANGLE_PRESSURES, ANGLES, BENDABILITIES, Case, HELD, PRESSURES, case, coiled, held, long,
};

/// All of them, with the names of their files.
pub(crate) fn pictures() -> [(&'static str, String); 5] {
    [
        ("paper-angle.svg", angle().svg()),
        ("paper-coiling.svg", coiling().svg()),
        ("paper-stiffness.svg", stiffness().svg()),
        ("paper-stiffness-angle.svg", stiffness_by_angle().svg()),
        ("paper-moment.svg", moment().svg()),
    ]
}

/// A value with its mesh error on both sides.
pub(crate) fn open([value, error]: [f64; 2]) -> (f64, Option<[f64; 2]>) {
    (value, Some([value - error, value + error]))
}

fn line(name: &str, colour: &'static str, look: Look, points: impl Iterator<Item = (f64, f64)>) -> Series {
    Series { name: name.to_owned(), colour, look, points: points.map(|(x, y)| (x, y, None)).collect() }
}

/// Whole numbers from `from` to `to` in steps of `step`.
fn every(from: f64, to: f64, step: f64) -> impl Iterator<Item = f64> {
    (0_u16..).map(move |k| from + step * f64::from(k)).take_while(move |x| *x <= to)
}

fn angle() -> Plot {
    let limit = |name, look, lambda: f64| {
        let at = |x: f64| (x, hinge(20.0, x).angle(lambda).to_degrees());
        line(name, GREY, look, [20.0, 180.0].map(at).into_iter())
    };
    let ring = Ring.target(0.1).expect("in range").lambda;
    let mut series = vec![limit("published 1.28", Look::Dashed, 1.28), limit("exact ring", Look::Thin, ring)];
    for (pressure, colour) in ANGLE_PRESSURES.into_iter().zip(COLOURS) {
        let of = |angle: f64| {
            let found = section(&long(angle, pressure))?;
            Some((angle, found.angle_deg, found.ranges.angle_deg))
        };
        series.push(Series {
            name: format!("section, {pressure} kPa"),
            colour,
            look: Look::Line,
            points: every(30.0, 150.0, 5.0).filter_map(of).collect(),
        });
        let shells = ANGLES.into_iter().filter_map(|angle| Some((angle, long(angle, pressure).kept()?)));
        series.push(Series {
            name: format!("shell, {pressure} kPa"),
            colour,
            look: Look::Discs,
            points: shells.map(|(x, found)| with(x, open(found.angle))).collect(),
        });
    }
    Plot {
        title: "Angle of a V-actuator at rest against its flat angle: limits, section with its range, shells",
        x: Axis::even("flat angle phi_0, deg", [20.0, 180.0], 20.0),
        y: Axis::even("angle at rest phi, deg", [-30.0, 180.0], 30.0),
        series,
    }
}

/// A point of a plot.
pub(crate) fn with(x: f64, (y, ends): (f64, Option<[f64; 2]>)) -> (f64, f64, Option<[f64; 2]>) {
    (x, y, ends)
}

fn coiling() -> Plot {
    let ring = Ring.target(0.1).expect("in range").lambda;
    let mut series = vec![
        line("published 1.28", GREY, Look::Dashed, [100.0, 2e4].into_iter().map(|b| (b, 1.28))),
        line("exact ring", GREY, Look::Thin, [100.0, 2e4].into_iter().map(|b| (b, ring))),
    ];
    for (width, colour) in WIDTHS.into_iter().zip(COLOURS) {
        let smooth = smooth(width);
        if !smooth.is_empty() {
            let points = smooth.iter().map(|(b, found)| (*b, found.coiling, found.ranges.coiling));
            let name = format!("section, W = {width} mm");
            series.push(Series { name, colour, look: Look::Line, points: points.collect() });
        }
        let shells = BENDABILITIES.into_iter().filter_map(|b| Some((b, coiled(width, b)?.kept()?)));
        series.push(Series {
            name: format!("shell, W = {width} mm"),
            colour,
            look: Look::Discs,
            points: shells.map(|(x, found)| with(x, open(found.coiling))).collect(),
        });
    }
    Plot {
        title: "Coiling of V-actuators of three widths against 1/eps: it rises, has a maximum, and falls",
        x: Axis {
            name: "bendability 1/eps = p W^3 / B",
            ends: [80.0, 2e4],
            ticks: vec![100.0, 300.0, 1e3, 3e3, 1e4],
            is_log: true,
        },
        y: Axis::even("coiling factor lambda at rest", [1.1, 1.3], 0.05),
        series,
    }
}

/// Series of C: ring, section, shell.
fn stiffnesses(
    series: &mut Vec<Series>,
    (name, colour): (&str, &'static str),
    [smooth, shells]: [&[(f64, Case)]; 2],
) {
    let ring = smooth.iter().map(|(x, own)| (*x, ring_stiffness(own.width, own.angle, own.pressure)));
    series.push(line(&format!("exact ring{name}"), colour, Look::Dashed, ring));
    let points: Vec<_> = smooth
        .iter()
        .filter_map(|(x, own)| {
            let found = section(own)?;
            let range = found.ranges.stiffness_Nm.map(|range| range.map(|end| 1e3 * end));
            Some((*x, 1e3 * found.stiffness_Nm, range))
        })
        .collect();
    if !points.is_empty() {
        series.push(Series { name: format!("section{name}"), colour, look: Look::Line, points });
    }
    let points = shells.iter().filter_map(|(x, own)| Some((*x, own.kept()?)));
    series.push(Series {
        name: format!("shell{name}"),
        colour,
        look: Look::Discs,
        points: points.map(|(x, found)| with(x, open(found.stiffness.map(|c| 1e3 * c)))).collect(),
    });
}

fn stiffness() -> Plot {
    let mut series = Vec::new();
    for (width, colour) in WIDTHS.into_iter().zip(COLOURS) {
        let at = |p: f64| (p, case(width, 30.0, p));
        let smooth: Vec<_> = every(2.0, 60.0, 2.0).map(at).collect();
        stiffnesses(&mut series, (&format!(", W = {width} mm"), colour), [&smooth, &PRESSURES.map(at)]);
    }
    Plot {
        title: "Stiffness of hinges of three widths against pressure: ring, section with its range, shells",
        x: Axis::even("pressure p, kPa", [0.0, 60.0], 10.0),
        y: Axis::even("stiffness C, mN m per rad", [0.0, 700.0], 100.0),
        series,
    }
}

fn stiffness_by_angle() -> Plot {
    let mut series = Vec::new();
    let at = |angle: f64| (angle, case(30.0, angle, 20.0));
    let smooth: Vec<_> = every(30.0, 150.0, 5.0).map(at).collect();
    stiffnesses(&mut series, ("", COLOURS[0]), [&smooth, &[30.0, 60.0, 90.0, 120.0, 150.0].map(at)]);
    Plot {
        title: "Stiffness of a hinge against its flat angle: ring, section with its range, shells",
        x: Axis::even("flat angle phi_0, deg", [20.0, 160.0], 20.0),
        y: Axis::even("stiffness C, mN m per rad", [0.0, 600.0], 100.0),
        series,
    }
}

fn moment() -> Plot {
    let own = held();
    let at = every(10.0, 60.0, 1.0).collect::<Vec<_>>();
    let limit = |name, look, model: &dyn HingeModel| {
        line(name, GREY, look, at.iter().map(|angle| (*angle, limit_moment(model, *angle))))
    };
    let said = every(10.0, 50.0, 2.0).collect::<Vec<_>>();
    let moments = section(&Case { held: said.clone(), ..own.clone() }).and_then(|found| found.moment);
    let points = said.iter().zip(moments.unwrap_or_default()).map(|(x, [_, applied])| (*x, -1e3 * applied));
    let shell = own.kept().map(|found| found.moments).unwrap_or_default();
    let discs = HELD.into_iter().zip(shell).map(|(x, m)| with(x, open(m.map(|m| 1e3 * m))));
    let series = vec![
        limit("published parabola", Look::Dashed, &Fit),
        limit("exact ring", Look::Thin, &Ring),
        line("section with arms", COLOURS[0], Look::Line, points),
        Series { name: "shell".to_owned(), colour: COLOURS[0], look: Look::Discs, points: discs.collect() },
    ];
    Plot {
        title: "Moment of a hinge against its angle at 13.8 kPa: limits, section, shell",
        x: Axis::even("angle phi, deg", [10.0, 60.0], 10.0),
        y: Axis::even("moment M, mN m; below 0 it closes", [-50.0, 30.0], 10.0),
        series,
    }
}
