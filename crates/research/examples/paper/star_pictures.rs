//! The pictures of stars: radius by the number of points, force by the radius of the object.

use research::stars::draw::PAPER_PRESSURES;

use super::actuator_pictures::{open, with};
use super::plot::{Axis, COLOURS, GREY, Look, Plot, Series};
use super::shells::{GRADINGS, coarse};
use super::stars::{HOLE, around, force, limits, paper_star, stars};

/// Both of them, with the names of their files.
pub(crate) fn pictures() -> [(&'static str, String); 2] {
    [("paper-radius.svg", radius().svg()), ("paper-force.svg", forces().svg())]
}

fn series(name: &str, colour: &'static str, look: Look, points: Vec<(f64, f64, Option<[f64; 2]>)>) -> Series {
    Series { name: name.to_owned(), colour, look, points }
}

fn radius() -> Plot {
    let closed = (3..=8_u32).filter_map(|n| {
        let [published, ..] = limits(&paper_star(n).ok()?);
        Some((f64::from(n), 1e3 * published, None))
    });
    let at: Vec<_> =
        stars().into_iter().filter(|(star, _)| star.star.pressure.total_cmp(&37.0).is_eq()).collect();
    let shells = at.iter().filter_map(|(star, _)| {
        let found = star.found.as_ref()?.radius;
        Some(with(f64::from(star.star.points), open([found.value, found.error])))
    });
    let section = at.iter().filter_map(|(star, own)| {
        let own = own.as_ref()?.radius;
        Some((f64::from(star.star.points), 1e3 * own.predicted, Some(own.range.map(|end| 1e3 * end))))
    });
    let first = |grading: &str| [4, 5].map(|n| (f64::from(n), coarse(n, grading).0[0], None)).to_vec();
    let best = 0.26 * HOLE;
    let mut all = vec![
        series("published, 74 %", GREY, Look::Dashed, vec![(3.0, best, None), (9.0, best, None)]),
        series("closed form, 1.28", GREY, Look::Rings, closed.collect()),
        series("section, 37 kPa", COLOURS[0], Look::Line, section.collect()),
        series("shell, 37 kPa", COLOURS[0], Look::Discs, shells.collect()),
    ];
    for (grading, colour) in GRADINGS.into_iter().zip([COLOURS[1], COLOURS[4]]) {
        all.push(series(&format!("one {grading} mesh, W/12.5"), colour, Look::Rings, first(grading)));
    }
    Plot {
        title: "Final radius of the paper's stars by their number of points: closed form, section with its range, shells",
        x: Axis::even("number of points n", [2.0, 9.0], 1.0),
        y: Axis::even("final radius rho_f, mm", [0.0, 40.0], 5.0),
        series: all,
    }
}

fn forces() -> Plot {
    let mut all = Vec::new();
    let stars = stars();
    for (pressure, colour) in PAPER_PRESSURES.into_iter().zip(COLOURS) {
        let from = 1e3 * around(5, pressure, HOLE).rest.radius;
        let radii = (0..=40_u8).map(|k| from + (HOLE - from) * f64::from(k) / 40.0);
        let points = radii.filter_map(|rho| {
            let (force, range) = force(5, pressure, rho.max(from + 1e-6))?;
            Some((rho, force, range))
        });
        all.push(series(&format!("section, {pressure} kPa"), colour, Look::Line, points.collect()));
        let own = stars
            .iter()
            .filter(|(star, _)| star.star.points == 5 && star.star.pressure.total_cmp(&pressure).is_eq());
        let shells = own.filter_map(|(star, own)| Some((star, star.found.as_ref()?, own.as_ref()?)));
        let discs = shells.flat_map(|(star, found, own)| {
            let (rest, width) = (found.radius.value, star.star.width);
            own.forces
                .iter()
                .map(move |one| with(rest + one.opening * width, open([one.force.shell, one.force.mesh])))
        });
        all.push(series(&format!("shell, {pressure} kPa"), colour, Look::Discs, discs.collect()));
    }
    Plot {
        title: "Radial force of the paper's star of five points on round objects at four pressures: section with its range, shells",
        x: Axis::even("radius of the object rho, mm", [15.0, 50.0], 5.0),
        y: Axis::even("radial force F, N", [0.0, 80.0], 10.0),
        series: all,
    }
}
