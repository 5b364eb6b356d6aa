//! The tube's edges of every shipped star, taken as a sketch, give the star's own seams and cut.

use std::fs;
use std::path::Path as File;

use stargrip_cam::design::{Design, MOUTH_OVERRUN};
use stargrip_cam::geom::{Path, Point};
use stargrip_cam::sealed::{DrawnCurve, DrawnPort, PortPlace, Rules, ShapeCode, Sketch, sealed_shape};

use crate::support;

/// The largest distance of a place on `a` from `b`, places a fraction of each segment apart.
fn furthest(a: &Path, b: &Path) -> f64 {
    let places = |path: &Path| -> Vec<Point> {
        let fraction = |i: u32| f64::from(i) / 16.0;
        path.segments
            .iter()
            .flat_map(|s| (0..=16).map(|i| s.point(fraction(i))).collect::<Vec<_>>())
            .collect()
    };
    places(a).into_iter().map(|p| b.distance(p)).fold(0.0, f64::max)
}

fn separation(a: &Path, b: &Path) -> f64 {
    furthest(a, b).max(furthest(b, a)).max((a.length() - b.length()).abs())
}

#[test]
fn shipped_stars_come_back_from_their_edges() {
    let designs = File::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let mut files: Vec<_> = fs::read_dir(designs)
        .expect("designs/")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    files.sort();
    let mut stars = 0;
    for file in files {
        let spec = support::read(&fs::read_to_string(&file).expect("a text"));
        let design = Design::new(&spec, &support::machine()).expect("a shipped design");
        for part in &design.assembly().expect("stars").distinct {
            let curve = |name: &str, path: &Path| DrawnCurve { name: name.to_owned(), path: path.clone() };
            let air = vec![curve("inner", &part.edges[0]), curve("outer", &part.edges[1])];
            let port = |at| DrawnPort { name: "hose".to_owned(), place: PortPlace::At(at) };
            let ports = part.shape.ports.iter().map(|mouth| port(mouth.at)).collect();
            let seal = &spec.seal;
            let rules = Rules {
                band: seal.band.0,
                allowance: seal.allowance.0,
                join: 0.02,
                overlap: seal.overlap.0,
                port_width: part.channel.map_or(6.0, |channel| 2.0 * channel.half_width),
                overrun: MOUTH_OVERRUN,
                least_passage: 15.0,
                flange: 10.0,
            };
            let result = sealed_shape(&Sketch { air, ports, ..Sketch::default() }, &rules);
            if part.channel.is_none() {
                let faults = result.expect_err("a closed tube");
                assert!(faults.iter().all(|fault| fault.code == ShapeCode::NoPort), "{faults:?}");
                continue;
            }
            let sealing = result.unwrap_or_else(|faults| panic!("{}: {faults:#?}", file.display()));
            stars += 1;
            assert_eq!(sealing.repairs, []);
            for seam in &part.shape.seams {
                let seam_found = sealing.shape.seam(&seam.name).expect("a seam of the same name");
                let deviation = separation(&seam_found.center_line, &seam.center_line);
                assert!(deviation < 1e-6, "{}: {} is {deviation} mm off", file.display(), seam.name);
                assert_eq!((seam_found.role, seam_found.overlap), (seam.role, seam.overlap));
                // An open seam may be sealed from either end.
                let (a, b) = (&seam_found.center_line, &seam.center_line);
                let gap = a.start().zip(b.start()).map_or(1.0, |(start, other)| {
                    start.distance(other).min(b.end().map_or(1.0, |other| start.distance(other)))
                });
                assert!(b.closed || gap < 1e-6, "{}: it ends {gap} mm off", seam.name);
            }
            let cut = sealing.shape.cut.as_ref().expect("a cut");
            let cut_deviation = separation(cut, &part.outline.outside);
            assert!(cut_deviation < 1e-6, "{}: the cut is {cut_deviation} mm off", file.display());
            assert_eq!(sealing.shape.topology().chambers, part.shape.topology().chambers);
        }
    }
    assert!(stars >= 10, "{stars}");
}
