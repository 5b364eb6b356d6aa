//! Shapes that are known, as regions: `cargo run --release -p inflatable --example region [cells] [cuts] [shape]`.

use inflatable::geom::{Arc, Line, Path, Point, Segment};
use inflatable::shell::cases::{FlatRegion, Fineness, InflatedRegion, Value, Watch, chambers, region};
use inflatable::shell::element::Fabric;
use std::error::Error;
use std::f64::consts::{PI, TAU};

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| words.get(at).map(|word| word.parse::<f64>()).transpose();
    let cells = number(0)?.unwrap_or(Fineness::COARSE.cells);
    let cuts = (0..9).take_while(|k| f64::from(*k) < words.get(1).map_or(2.0, |w| w.parse().unwrap_or(2.0))).count();
    let which = words.get(2).cloned().unwrap_or_default();
    let fineness = Fineness { cells, cuts };
    for (name, outline) in shapes() {
        if !name.contains(&which) { continue; }
        for (t, p) in [(0.3e-3_f64, 14e3), (0.05e-3, 500.0)] {
        let (e, nu) = (128e6, 0.39);
        let fabric = Fabric { stretch: e * t, bending: e * t.powi(3) / (12.0 * (1.0 - nu * nu)), poisson: nu };
        let start = std::time::Instant::now();
        for chamber in chambers(&outline, &[], &[Path::closed(vec![Arc::new(Point::ORIGIN, 0.01, 0.0, TAU).into()])])? {
            let case = FlatRegion { chamber, fabric, pressure: p, band: 0.003 };
            println!("{name}");
            match region(&case, fineness, &Watch::default()) {
                Ok(found) => print(&found),
                Err(why) => println!("  {why}"),
            }
        }
        println!("  {:.1} s", start.elapsed().as_secs_f64());
        }
    }
    Ok(())
}

fn print(found: &InflatedRegion) {
    let w = found.width;
    println!("  W {:.4} 1/eps {:.3e} {:?}", w, found.bendability, found.wrinkles);
    let print = |name: &str, value: Value| {
        let Value { value, error, meshes: [a, b, c] } = value;
        println!("  {name:24} {value:12.5} +- {error:.5}   meshes {a:.5} {b:.5} {c:.5}");
    };
    print("volume / W^3", found.volume.scaled(w.powi(-3)));
    print("height / W", found.height.scaled(1.0 / w));
    print("x", found.extents[0].scaled(1.0 / found.flat_extents[0]));
    print("y", found.extents[1].scaled(1.0 / found.flat_extents[1]));
    print("pull N/m", found.seal_pull);
    print("stretch", found.stretch);
    print("tension N/m", found.tension);
    print("sym", found.symmetric_eigenvalue);
    print("antisym", found.antisymmetric_eigenvalue);
    println!("  {:?} {:?}", found.evidence.unknowns, found.evidence.efforts.iter().map(|e| e.iterations).collect::<Vec<_>>());
}

fn shapes() -> Vec<(&'static str, Vec<Path>)> {
    let disc = Path::closed(vec![Segment::Arc(Arc::new(Point::ORIGIN, 0.05, 0.0, TAU))]);
    vec![("disc", vec![disc]), ("square", vec![polygon(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]])]),
    ("tube", vec![polygon(&[[0.0, 0.0], [0.2, 0.0], [0.2, 0.02], [0.0, 0.02]])]), ("star", star())]
}

/// The tube of a star of five points: W = 30 mm around a hole of 50 mm, tips of 60 deg, all corners sharp inside.
fn star() -> Vec<Path> {
    let (n, w, rho, tip) = (5_u32, 0.03, 0.05, 60.0_f64.to_radians());
    let half = PI / f64::from(n);
    let l = ((rho + w) * half.sin() - w * (tip / 2.0).cos()) / (tip / 2.0).sin();
    let (mut outer, mut inner) = (Vec::<Segment>::new(), Vec::<Segment>::new());
    for k in 0..n {
        let axis = 2.0 * half * f64::from(k);
        // A reentrant corner turns the outer rim on a point, the inner rim on an arc around it; a tip the other way round.
        let corner = Point::polar(rho + w, axis);
        let turn = (PI - tip) / 2.0 - half;
        let along = axis + PI / 2.0 - turn;
        let side = |at: Point, away: f64, length: f64| {
            let unit = inflatable::geom::Vec2::unit(along);
            let start = at + inflatable::geom::Vec2::unit(along + PI / 2.0) * away;
            Line::new(start, start + unit * length)
        };
        let up = [side(corner, 0.0, l), side(corner, w, l)];
        let tip_at = up[1].end;
        inner.push(Arc::new(corner, w, axis + PI + turn, -2.0 * turn).into());
        inner.push(up[1].into());
        let next = axis + 2.0 * half;
        let fold = PI - tip;
        outer.push(up[0].into());
        outer.push(Arc::new(tip_at, w, along - PI / 2.0, fold).into());
        let back = along + fold;
        let unit = inflatable::geom::Vec2::unit(back);
        let from = tip_at + inflatable::geom::Vec2::unit(back - PI / 2.0) * w;
        outer.push(Line::new(from, Point::polar(rho + w, next)).into());
        inner.push(Line::new(tip_at, tip_at + unit * l).into());
    }
    vec![Path::closed(outer), Path::closed(inner)]
}

fn polygon(points: &[[f64; 2]]) -> Path {
    let point = |k: usize| Point::new(points[k % points.len()][0], points[k % points.len()][1]);
    Path::closed((0..points.len()).map(|k| Line::new(point(k), point(k + 1)).into()).collect())
}
