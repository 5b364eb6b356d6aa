//! Cushions with folds and bent tubes over the pressures at which wrinkles become fine: `cargo run --release -p stargrip-inflatable --example
//! folds [CELLS CUTS]`.
//!
//! E = 128 MPa, nu = 0.39, t = 0.3 mm. Prints a row for each shape and pressure; without CELLS on the coarse default meshes. Pouches have L0
//! = 40 mm between their long seams, whose contraction is read in the middle and as a mean over the width.

use geom::{Arc, Line, Path, Point};
use inflatable::shell::cases::{Fineness, FlatRegion, InflatedRegion, Value, Watch, chambers, region};
use inflatable::shell::element::Fabric;
use std::error::Error;
use std::f64::consts::{PI, TAU};

/// Points along each long seam of a pouch.
const STATIONS: usize = 41;

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Vec<f64> = std::env::args().skip(1).map(|word| word.parse()).collect::<Result<_, _>>()?;
    let fineness = numbers.first().map(|cells| {
        let cuts = if numbers.get(1).is_some_and(|cuts| *cuts > 2.0) { 3 } else { 2 };
        Fineness { cells: *cells, cuts }
    });
    println!(
        "| shape | p, kPa | 1/eps | wrinkles | height, mm | other height, mm | extent x, mm | pull, N/mm |"
    );
    for kilopascals in [5.0, 5.2, 5.4, 8.0, 14.0, 25.0, 26.8, 60.0] {
        let _ = row("square 40", rectangle(0.04, 0.04), kilopascals, Vec::new(), fineness)?;
    }
    for kilopascals in [1.0, 3.0, 10.0] {
        let _ = row("square 100", rectangle(0.1, 0.1), kilopascals, Vec::new(), fineness)?;
    }
    let disc = Path::closed(vec![Arc::new(Point::ORIGIN, 0.05, 0.0, TAU).into()]);
    let _ = row("disc 100", disc, 10.0, Vec::new(), fineness)?;
    for kilopascals in [10.0, 42.4, 42.5, 60.0] {
        let _ = row("arc W 20 R 20", arc(0.02, 0.02), kilopascals, Vec::new(), fineness)?;
    }
    for width in [0.06, 0.1, 0.2] {
        let name = format!("pouch 40 x {:.0}", 1e3 * width);
        let seam = |x: f64| (0..STATIONS).map(move |k| [x, width * part(k)]);
        let probes = seam(0.0).chain(seam(0.04)).collect();
        let pouch = row(&name, rectangle(0.04, width), 14.0, probes, fineness)?;
        let meshes: Vec<[f64; 2]> = pouch.probed.iter().map(|points| contractions(points)).collect();
        for (word, which) in [("middle", 0), ("mean", 1)] {
            let value = Value::new([0, 1, 2].map(|mesh| 100.0 * meshes[mesh][which]));
            println!("  contraction, {word}: {:.1} +- {:.1} %", value.value, value.error);
        }
    }
    Ok(())
}

fn part(station: usize) -> f64 {
    f64::from(u32::try_from(station).unwrap_or(0)) / 40.0
}

/// Relative contraction of a pouch from the points of both long seams: in the middle, and the mean over its width.
fn contractions(points: &[[f64; 3]]) -> [f64; 2] {
    let (first, second) = points.split_at(STATIONS);
    let all = first.iter().zip(second).map(|(a, b)| {
        let square: f64 = (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum();
        1.0 - square.sqrt() / 0.04
    });
    let all: Vec<f64> = all.collect();
    let ends = f64::midpoint(all[0], all[STATIONS - 1]);
    [all[STATIONS / 2], (all[1..STATIONS - 1].iter().sum::<f64>() + ends) / 40.0]
}

fn row(
    name: &str,
    outline: Path,
    kilopascals: f64,
    probes: Vec<[f64; 2]>,
    fineness: Option<Fineness>,
) -> Result<InflatedRegion, Box<dyn Error>> {
    let (e, nu, t) = (128e6, 0.39, 0.3e-3_f64);
    let fabric = Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu);
    let chamber = chambers(&[outline], &[], &[])?.remove(0);
    let case = FlatRegion {
        chamber,
        fabric,
        pressure: 1e3 * kilopascals,
        band: 0.003,
        probes,
        partial: Vec::new(),
        plates: None,
    };
    let inflated = region(&case, fineness.unwrap_or_else(|| case.quick()), &Watch::default())?;
    let other = inflated.second.as_ref().map_or_else(String::new, |second| number(second.height, 1e3));
    println!(
        "| {name} | {kilopascals} | {:.0} | {:?} | {} | {other} | {} | {} |",
        inflated.bendability,
        inflated.wrinkles,
        number(inflated.height, 1e3),
        number(inflated.extents[0], 1e3),
        number(inflated.seal_pull, 1e-3)
    );
    Ok(inflated)
}

fn number(value: Value, unit: f64) -> String {
    let Value { value, error, .. } = value.scaled(unit);
    format!("{value:.2} +- {error:.2}")
}

fn rectangle(width: f64, height: f64) -> Path {
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(|[x, y]| Point::new(x, y));
    Path::closed((0..4).map(|k| Line::new(corners[k], corners[(k + 1) % 4]).into()).collect())
}

/// Half a ring of the width `width` around a hole of `radius`.
fn arc(width: f64, radius: f64) -> Path {
    let outer = radius + width;
    Path::closed(vec![
        Arc::new(Point::ORIGIN, outer, 0.0, PI).into(),
        Line::new(Point::new(-outer, 0.0), Point::new(-radius, 0.0)).into(),
        Arc::new(Point::ORIGIN, radius, PI, -PI).into(),
        Line::new(Point::new(radius, 0.0), Point::new(outer, 0.0)).into(),
    ])
}
