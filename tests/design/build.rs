//! Whole builds of random specs: refused with a reason, or proven; and files that keep arcs of any size exact.

use std::f64::consts::PI;

use proptest::prelude::*;

use stargrip_cam::design::{Drawing, Layer, Origin, Shape};
use stargrip_cam::geom::{Arc, Isometry, Line, Path, Point, Segment};
use stargrip_cam::plan::{Height, LONGEST_MOVE, PacedProcess, Program, Purpose, SeamReport, Step, moves};
use stargrip_cam::sealed::{PieceName, SeamName};
use stargrip_cam::spec::Colours;
use stargrip_cam::units::Length;
use stargrip_cam::verify::gcode::{Dialect, read_program};
use stargrip_cam::verify::{SvgOrigin, deviation};
use stargrip_cam::{emit, verify};

use crate::support;

/// The rest of a random spec beside its star.
fn details() -> impl Strategy<Value = String> {
    (0.2..8.0_f64, 0.0..30.0_f64, 0.0..20.0_f64, 0.0..5.0_f64, any::<bool>(), 0.0..6.0_f64, 1_u32..=3).prop_map(
        |(band, overlap, allowance, hole_allowance, inlet, hole, tip)| {
            // Smaller holes are refused.
            let hole = if hole < 0.2 { 0.0 } else { hole };
            let inlet = if inlet { format!("tip = {tip}") } else { "none = true".to_owned() };
            format!(
                "[seal]\nband = \"{band} mm\"\noverlap = \"{overlap} mm\"\nallowance = \"{allowance} mm\"\n\
                 hole_allowance = \"{hole_allowance} mm\"\n[inlet]\n{inlet}\n[sheet]\nhole_diameter = \"{hole} mm\"\n"
            )
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Every build is refused with numbers, or proven within its tolerance. 20 mm to 2 m, 3 to 64 points.
    #[test]
    fn a_build_is_refused_or_proven(shape in support::shapes(), details in details(), digits in 0..3_i32) {
        let path = 0.1 * 10.0_f64.powi(-digits);
        let text = format!("{}{details}[accuracy]\npath = \"{path} mm\"\n", shape.toml());
        match support::build(&text) {
            Err(refusals) => {
                prop_assert!(!refusals.is_empty());
                for refusal in refusals {
                    prop_assert!(!refusal.found.contains("NaN") && !refusal.found.contains("inf"), "{refusal}");
                    prop_assert!(refusal.found.chars().any(|c| c.is_ascii_digit()), "no numbers: {refusal}");
                }
            }
            Ok(build) => {
                let proof = build.proof();
                prop_assert_eq!(&proof.findings, &[]);
                let measured = proof.files.iter().filter_map(|file| Some((&file.path, file.deviation?)));
                prop_assert!(measured.clone().count() >= 6);
                for (file, mm) in measured {
                    // PDF approximates arcs by curves in single precision, STL by chords.
                    let allowed = match file.rsplit_once('.') {
                        Some((_, "pdf")) => 0.01,
                        Some((_, "stl")) => 0.025,
                        _ => path,
                    };
                    prop_assert!(mm <= allowed, "{file}: {mm}");
                }
            }
        }
    }

    /// A rounded rectangle with arcs of any angle around the half turn, anywhere, in every format.
    #[test]
    fn arcs_around_a_half_turn_stay_exact(
        sweep in 170.0..190.0_f64, radius in 0.05..1000.0_f64, turn in 0.0..360.0_f64, clockwise in any::<bool>(),
    ) {
        let path = placed(&arched(radius, sweep.to_radians(), clockwise), turn.to_radians());
        let bounds = path.bounds();
        let drawing = Drawing {
            origin: Origin::LowerLeft,
            width: bounds.max.x + 10.0,
            height: bounds.max.y + 10.0,
            layers: vec![(Layer::SealOuter, vec![Shape::Path(path.clone())])],
        };
        let tolerance = Length(0.001);
        let exact = [path.clone()];
        let svg = verify::read_svg(&emit::svg("arcs", &drawing, tolerance, Colours::One), SvgOrigin::LowerLeft);
        let dxf = verify::read_dxf(&emit::dxf(&drawing, tolerance, Colours::One));
        for found in [&svg, &dxf] {
            prop_assert_eq!(&found.findings, &[]);
            let deviation_of_drawing = deviation(found.layer("seal-outer"), &exact).largest();
            prop_assert!(deviation_of_drawing <= 0.001, "{deviation_of_drawing} mm");
        }
        let run = read_back(&path);
        let deviation_of_program = deviation(&[Path::open(run)], &exact).largest();
        prop_assert!(deviation_of_program <= 0.001, "G-code is {deviation_of_program} mm off");
    }
}

/// Two arcs of angle `sweep` whose ends two lines join; closed.
fn arched(radius: f64, sweep: f64, clockwise: bool) -> Path {
    let center = Point::new(4.0 * radius, 0.0);
    let right = Arc::new(center, radius, -sweep / 2.0, sweep);
    let left = Arc::new(Point::ORIGIN, radius, PI - sweep / 2.0, sweep);
    let path = Path::closed(vec![
        right.into(),
        Line::new(right.end(), left.start()).into(),
        left.into(),
        Line::new(left.end(), right.start()).into(),
    ]);
    if clockwise { path.reversed() } else { path }
}

/// Turned, and moved into the first quadrant.
fn placed(path: &Path, turn: f64) -> Path {
    let turned = Isometry::rotation(turn).path(path);
    let corner = turned.bounds().min;
    Isometry::translation(Point::new(10.0, 10.0) - corner).path(&turned)
}

/// The moves in contact that the G-code of one seam along `path` has, for a controller that draws arcs.
fn read_back(path: &Path) -> Vec<Segment> {
    let linuxcnc = stargrip_cam::spec::builtin_machine("linuxcnc").expect("built in");
    let source = stargrip_cam::spec::Source::new("linuxcnc", linuxcnc);
    let machine = stargrip_cam::spec::read_machine(&source).expect("valid");
    let spec = support::read(support::PAPER);
    let seam = SeamReport {
        name: SeamName { piece: PieceName::numbered("star", 1), seam: "outer".to_owned() },
        length: path.length(),
        overlap: 0.0,
        time: 0.0,
        process: 0,
        line: 1,
        pass: 1,
    };
    let program = Program {
        purpose: Purpose::Seal,
        sheet: 1,
        pieces: vec![PieceName::numbered("star", 1)],
        steps: vec![
            Step::Height(Height::Park),
            Step::Travel(path.start().expect("a path")),
            Step::Height(Height::Travel),
            Step::Seal(moves(path, LONGEST_MOVE)),
        ],
        seams: vec![seam],
        processes: vec![PacedProcess {
            process: spec.default_process(),
            pace: stargrip_cam::plan::Pace::Steady,
            overdue: 0.0,
        }],
        time: 0.0,
        motion: None,
    };
    let text = emit::gcode(&spec, &machine, &program);
    let program = read_program(&text, Dialect::new(spec::Dialect::LinuxCnc));
    assert_eq!(program.findings, []);
    for (step, next) in program.moves.iter().zip(program.moves.iter().skip(1)) {
        assert_eq!(step.to, next.from);
    }
    let feeds = program.moves.iter().filter(|step| step.feed.is_some());
    let segments: Vec<Segment> = feeds.filter_map(|step| step.path).collect();
    assert!(segments.iter().all(|segment| segment.length() <= LONGEST_MOVE + 0.001));
    segments
}

/// Found by chance: on a page of 70 m a PDF's numbers are too coarse. None is written then.
#[test]
fn no_paper_is_written_that_numbers_are_too_coarse_for() {
    let fast = format!("{}\n[seal]\nspeed = \"2 mm/s\"\n", support::PAPER);
    let text = fast
        .replace("\"50 mm\"", "\"30000 mm\"")
        .replace("\"30 mm\"", "\"463.7 mm\"")
        .replace("30 deg", "60 deg");
    let build = support::build(&text).expect("a design");
    let proof = build.proof();
    assert_eq!(proof.findings, []);
}
