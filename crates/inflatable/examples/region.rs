//! Regions with published inflated sizes: `cargo run --release -p stargrip-inflatable --example region [cells]`.
//!
//! E = 128 MPa, nu = 0.39. Prints each number with its mesh error; without `cells`, on the coarse default meshes.

use geom::{Arc, Line, Path, Point, Segment, Vec2};
use inflatable::shell::cases::{
    Fineness, FlatRegion, FlatStar, InflatedRegion, Objects, Tube, Value, Watch, chambers, region, star,
};
use inflatable::shell::element::Fabric;
use std::error::Error;
use std::f64::consts::{PI, TAU};

/// The star: points, inner radius, width, m, angle of tips, rad.
const STAR: (u32, f64, f64, f64) = (5, 0.05, 0.03, PI / 3.0);

fn main() -> Result<(), Box<dyn Error>> {
    let cells = std::env::args().nth(1).map(|word| word.parse::<f64>()).transpose()?;
    let rectangle = |w, h| polygon(&[[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]);
    let found = run("disc of 0.1 m, 500 Pa, t = 0.05 mm", &[circle(0.05)], (0.05e-3, 500.0), cells)?;
    print("width / D (0.7627)", found.extents[0].scaled(10.0));
    print("height / D (0.4569)", found.height.scaled(10.0));
    print("volume / D^3 (0.1523)", found.volume.scaled(1e3));
    let found = run("square of 0.1 m, 500 Pa, t = 0.05 mm", &[rectangle(0.1, 0.1)], (0.05e-3, 500.0), cells)?;
    print("volume / a^3 (0.2055)", found.volume.scaled(1e3));
    let found =
        run("tube of 0.2 by 0.02 m, 5 kPa, t = 0.3 mm", &[rectangle(0.2, 0.02)], (0.3e-3, 5e3), cells)?;
    print("height / W (0.6366)", found.height.scaled(50.0));
    let (points, inner_radius, width, tip_angle) = STAR;
    let found = run("star of five points, 14 kPa, t = 0.3 mm", &star_loops(), (0.3e-3, 14e3), cells)?;
    print("volume, cm^3", found.volume.scaled(1e6));
    let tube = Tube { width, fabric: fabric(0.3e-3), pressure: 14e3 };
    let case = FlatStar::sharp(tube, points, inner_radius, tip_angle);
    let fineness = Fineness { cells: 4.0, cuts: 2 };
    let known = star(&case, Objects::Radii(&[]), fineness, &Watch::default())?;
    print("  of half a sector", known.volume.scaled(1e6));
    Ok(())
}

fn run(
    name: &str,
    loops: &[Path],
    (t, pressure): (f64, f64),
    cells: Option<f64>,
) -> Result<InflatedRegion, Box<dyn Error>> {
    // Fabric is cut out in the middle of the star.
    let cuts = if loops.len() > 1 { vec![circle(0.01)] } else { Vec::new() };
    let chamber = chambers(loops, &[], &cuts)?.remove(0);
    let case = FlatRegion {
        chamber,
        fabric: fabric(t),
        pressure,
        band: 0.003,
        probes: Vec::new(),
        partial: Vec::new(),
        plates: None,
    };
    let quick = case.quick();
    let fineness = Fineness { cells: cells.unwrap_or(quick.cells), ..quick };
    let found = region(&case, fineness, &Watch::default())?;
    println!("{name}: 1/eps {:.0}, wrinkles {:?}", found.bendability, found.wrinkles);
    let iterations: Vec<u32> = found.evidence.efforts.iter().map(|effort| effort.iterations).collect();
    println!("  unknowns {:?}, Newton steps {iterations:?}", found.evidence.unknowns);
    print("pull, N/m", found.seal_pull);
    print("out of its plane, p/W", found.antisymmetric_eigenvalue);
    Ok(found)
}

fn print(name: &str, Value { value, error, meshes: [a, b, c] }: Value) {
    println!("  {name:24} {value:12.5} +- {error:.5}   meshes {a:.5} {b:.5} {c:.5}");
}

fn fabric(t: f64) -> Fabric {
    let (e, nu) = (128e6, 0.39);
    Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu)
}

fn circle(radius: f64) -> Path {
    Path::closed(vec![Arc::new(Point::ORIGIN, radius, 0.0, TAU).into()])
}

fn polygon(points: &[[f64; 2]]) -> Path {
    let point = |k: usize| Point::new(points[k % points.len()][0], points[k % points.len()][1]);
    Path::closed((0..points.len()).map(|k| Line::new(point(k), point(k + 1)).into()).collect())
}

/// Outer and inner rim of the star, whose hinges turn on points.
fn star_loops() -> [Path; 2] {
    let (n, rho, w, tip) = STAR;
    let half = PI / f64::from(n);
    let length = ((rho + w) * half.sin() - w * (tip / 2.0).cos()) / (tip / 2.0).sin();
    let (mut outer, mut inner) = (Vec::<Segment>::new(), Vec::<Segment>::new());
    for k in 0..n {
        let axis = 2.0 * half * f64::from(k);
        let turn = (PI - tip) / 2.0 - half;
        let (out, back) = (axis + PI / 2.0 - turn, axis + PI / 2.0 - turn + PI - tip);
        let corner = Point::polar(rho + w, axis);
        let inside = corner + Vec2::unit(out + PI / 2.0) * w;
        let at_tip = inside + Vec2::unit(out) * length;
        inner.push(Arc::new(corner, w, axis + PI + turn, -2.0 * turn).into());
        inner.push(Line::new(inside, at_tip).into());
        inner.push(Line::new(at_tip, at_tip + Vec2::unit(back) * length).into());
        outer.push(Line::new(corner, corner + Vec2::unit(out) * length).into());
        outer.push(Arc::new(at_tip, w, out - PI / 2.0, PI - tip).into());
        let next = Point::polar(rho + w, axis + 2.0 * half);
        outer.push(Line::new(at_tip + Vec2::unit(back - PI / 2.0) * w, next).into());
    }
    [Path::closed(outer), Path::closed(inner)]
}
