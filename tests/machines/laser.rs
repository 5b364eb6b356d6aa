//! A laser: its programs are proven and timed, its lines cover the band, and a beam where none belongs is found.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::Design;
use stargrip_cam::geom::{Path, Point};
use stargrip_cam::pipeline::{Built, read_back};
use stargrip_cam::spec::LASER_PROFILE;

use crate::clock::controller::{Motors, run};
use crate::clock::judge::TOTAL;
use crate::clock::text::Text;
use crate::danger::missed;
use crate::{
    builtin_machine, findings_with, machine, profile, recounted, spec, spec_text, text, try_built,
    try_built_with,
};

pub(crate) const SEAL: &str = "star-1-seal.gcode";
const TRACE: &str = "star-1-trace.gcode";
/// S words of the two loops.
const INNER: &str = "S95";

/// Two loops of different powers, with a wait and a pause between them.
pub(crate) const POWERS: &str = "inner_process = \"strong\"\n[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\npause = \"seam\"\n\
    [process.strong]\npower = \"9.5 %\"\nspeed = \"8 mm/s\"\ncool = \"1 s\"\n";

/// The star with two powers on the machine `machine_text`.
fn built_on(machine_text: &str) -> Built {
    let request = KindRequest::exactly(&[Kind::SealGcode, Kind::TraceGcode]);
    try_built_with(&spec_text(POWERS), machine_text, &request)
        .unwrap_or_else(|refusals| panic!("{refusals:?}"))
}

/// The profile of a laser on a controller of `dialect`.
pub(crate) fn profile_of(dialect: &str) -> String {
    profile(LASER_PROFILE).replace("dialect = \"grbl\"", &format!("dialect = \"{dialect}\""))
}

#[test]
fn a_laser_is_proven_for_every_controller_that_drives_one() {
    for (dialect, setting) in
        [("grbl", "$32=1"), ("grblhal", "$32=1"), ("fluidnc", "a Laser spindle in the configuration")]
    {
        let build = built_on(&profile_of(dialect));
        assert_eq!(read_back(&build.output_files()).findings, [], "{dialect}");
        let code = text(&build, SEAL);
        assert!(
            code.contains(&format!("; requires: {setting}")) && code.contains("; safety: goggles"),
            "{dialect}"
        );
        assert!(!code.contains("set the iron") && !code.contains("temperature"), "{dialect}");
        let trace = text(&build, TRACE);
        assert!(
            !trace.contains("M4") && !trace.contains("\nM0"),
            "{dialect}: a trace without a beam and a stop"
        );
    }
}

/// The place of an inserted line.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// Before the first motion.
    Head,
    /// Before the stop at which the operator arms the laser.
    Stop,
    /// Between a seam and the way to the next one.
    Travel,
    /// Before the way down to a seam, after the laser is armed.
    Armed,
    /// Among the moves along a seam.
    Seam,
    /// Before the wait for a seam to cool.
    Wait,
    /// Before the last line of code.
    End,
}

/// Lines that must not be in a program that welds by a laser.
const ROWS: &[LineRow] = &[
    (Place::Head, "beam-at-rest", &["M4 S80", "M3 S1000", "M4 S0.5"]),
    (Place::Head, "beam-constant", &["M3", "M3 S0"]),
    (Place::Stop, "beam-at-rest", &["M4", "M4 S0", "M3", "M4 S80"]),
    (Place::Travel, "beam-at-rest", &["M4 S80", "M3 S80", "M4 S1"]),
    (Place::Travel, "beam-constant", &["M3 S80", "M3 S0"]),
    (
        Place::Travel,
        "beam-in-travel",
        &["M4 S80\nG0 X10 Y10", "M4 S0\nG1 X10 Y10 F600 S80", "M4 S0\nG0 X10 Y10 S80"],
    ),
    (Place::Travel, "wrong-power", &["M4 S1001", "S5000"]),
    (Place::Armed, "beam-at-rest", &["S80", "M4 S80", "M3 S80", "G4 P1\nS80"]),
    (Place::Armed, "beam-off-focus", &["G1 X20 Y20 Z12.5 F600 S80", "S80\nG1 X20 Y20 Z12.2 F600"]),
    (Place::Seam, "beam-at-rest", &["G4 P1", "G4 P0.05", "M0", "S80", "S95", "M4 S95", "F600 S50"]),
    (Place::Seam, "beam-in-travel", &["G0 X1 Y1", "G0 Z13", "G0 Z30", "G0 X50"]),
    (Place::Seam, "beam-off-focus", &["G1 X40 Y40 Z13", "G1 X40 Y40 Z11.9"]),
    (
        Place::Seam,
        "wrong-power",
        &["G1 X40 Y40 S96", "G1 X40 Y40 S0", "G1 X40 Y40 S1000", "S1200", "M5\nG1 X40 Y40", "S0\nG1 X40 Y40"],
    ),
    (Place::Seam, "beam-constant", &["M3", "M3 S95", "M3 S1000"]),
    (Place::Seam, "beam-at-end", &["M2", "M30"]),
    (Place::Seam, "bad-number", &["G1 X40 S-95", "S-1"]),
    (Place::Seam, "modal-conflict", &["M3 M4", "M4 M5", "M3 M5 S0"]),
    (Place::Seam, "repeated-word", &["G1 X40 S95 S1000"]),
    (
        Place::Seam,
        "unknown-word",
        &[
            "M6",
            "T1",
            "M7",
            "M8",
            "M9",
            "M106 S255",
            "M62 P0",
            "M64 P0",
            "M67 E0 Q50",
            "M42 P1",
            "G38.2 Z-5 F10",
            "G53",
            "G54",
            "G92 X0",
            "G28",
            "G30",
            "G10 L2 P1 X0",
            "G43.1 Z5",
            "G80",
            "M56",
            "$32=0",
            "$30=100",
            "$X",
            "M1",
        ],
    ),
    (Place::Seam, "bad-character", &["!", "~", "?"]),
    (Place::Seam, "profile-line", &["G91", "G20", "G93", "G21"]),
    (Place::Seam, "too-deep", &["G1 Z5 F100", "G1 X40 Y40 Z-1"]),
    (Place::Wait, "beam-at-rest", &["M4 S80", "M4 S0.2", "M3 S80"]),
    (Place::End, "beam-at-end", &["M4", "M4 S0", "M3 S0", "M4 S80"]),
    (Place::End, "profile-line", &["M4 S0", "G91"]),
];

/// The index of the first of `lines` that begins with `beginning`.
fn first(lines: &[&str], beginning: &str) -> usize {
    lines.iter().position(|line| line.starts_with(beginning)).expect("such a line")
}

/// The index before which a line is inserted at `place`; `beam` is the S word of the seam.
fn index(lines: &[&str], place: Place, beam: &str) -> usize {
    let armed = first(lines, "M4 S0");
    match place {
        Place::Head => first(lines, "G0 Z"),
        Place::Stop => first(lines, "M0"),
        Place::Travel => armed + first(&lines[armed..], "M5") + 1,
        Place::Armed => armed + 1,
        Place::Seam => 2 + lines.iter().position(|line| line.ends_with(beam)).expect("a beam"),
        Place::Wait => first(lines, "G4"),
        Place::End => lines.iter().rposition(|line| !line.starts_with(';')).expect("an end"),
    }
}

/// A row of lines: place, code of the finding, and the lines that have it there.
type LineRow = (Place, &'static str, &'static [&'static str]);

/// The number of lines in `rows`; each is found by its code where it is inserted into the program `file` of `build`, which seals or cuts with
/// the S word `beam`.
fn assert_found(build: &Built, file: &str, rows: &[LineRow], beam: &str) -> usize {
    let good = text(build, file);
    let lines: Vec<&str> = good.lines().collect();
    let (mut number, mut unproven) = (0, Vec::new());
    for &(place, code, dangers) in rows {
        for danger in dangers {
            number += 1;
            // What a line leaves behind is found at the next one.
            let miss = missed(build, file, &lines, index(&lines, place, beam), danger, code, 2);
            unproven.extend(miss.map(|miss| format!("{place:?} {miss}")));
        }
    }
    assert!(unproven.is_empty(), "{unproven:#?}");
    number
}

#[test]
fn no_dangerous_line_is_proven() {
    let number = assert_found(&built_on(profile(LASER_PROFILE)), SEAL, ROWS, INNER);
    assert!(number >= 80, "{number}");
}

/// A laser that cuts the sheet where it sealed it.
const CUT: &str = "[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\n[cut]\nkerf = \"0.2 mm\"\ntool = \"laser\"\n\
    power = \"60 %\"\nspeed = \"8 mm/s\"\nfocus = \"11 mm\"\n";
const CUT_FILE: &str = "sheet-1-cut.gcode";

/// Lines that must not be in a program that cuts by a laser.
const CUT_ROWS: &[LineRow] = &[
    (Place::Head, "beam-at-rest", &["M4 S600", "M3 S1000"]),
    (Place::Stop, "beam-at-rest", &["M4", "M4 S0", "M3"]),
    (Place::Travel, "beam-at-rest", &["M4 S600", "M3 S600"]),
    (Place::Travel, "beam-in-travel", &["M4 S600\nG0 X10 Y10", "M4 S0\nG1 X10 Y10 F480 S600"]),
    (Place::Armed, "beam-off-focus", &["G1 X20 Y20 Z12 F480 S600"]),
    (Place::Seam, "beam-at-rest", &["G4 P1", "M0", "S600"]),
    (Place::Seam, "beam-in-travel", &["G0 X1 Y1", "G0 Z13"]),
    (Place::Seam, "wrong-power", &["G1 X40 Y40 S601", "G1 X40 Y40 S80", "S1200", "M5\nG1 X40 Y40"]),
    (Place::Seam, "beam-constant", &["M3", "M3 S600"]),
    (Place::Seam, "beam-at-end", &["M2", "M30"]),
    (Place::Seam, "too-deep", &["G1 Z5 F100"]),
    (Place::Seam, "unknown-word", &["M6", "T1", "M7", "G92 X0", "G53", "M67 E0 Q50"]),
    (Place::End, "beam-at-end", &["M4", "M4 S600"]),
];

#[test]
fn a_laser_cuts_the_outline_and_nothing_else_for_every_controller_that_drives_one() {
    for dialect in ["grbl", "grblhal", "fluidnc"] {
        let request = KindRequest::exactly(&[Kind::CutGcode]);
        let build = try_built_with(&spec_text(CUT), &profile_of(dialect), &request)
            .unwrap_or_else(|refusals| panic!("{refusals:?}"));
        assert_eq!(read_back(&build.output_files()).findings, [], "{dialect}");
        let code = text(&build, CUT_FILE);
        assert!(code.contains("\n; cutting: tool=laser power_percent=60\n"), "{dialect}");
        assert!(code.contains("focus_mm=11") && code.contains("; safety: goggles"), "{dialect}");
        assert_eq!(code.matches("M4 S0\n").count(), code.matches("; cut: cut=").count(), "{dialect}");
        let number = assert_found(&build, CUT_FILE, CUT_ROWS, " S600");
        assert!(number >= 30, "{number}");
        // The second clock: the tool is never faster than told, and its total is right.
        let (program, motors) = (Text::read(&code), Motors { acceleration: 500.0, steps_per_mm: 80.0 });
        let controller = if dialect == "grbl" { LASER_PROFILE } else { dialect };
        let track = run(controller, &program, motors);
        let total = program.fact("total.time_s").expect("a time");
        assert!((track.now / total - 1.0).abs() <= TOTAL, "{dialect}: {} of {total} s", track.now);
    }
}

/// Lines of the program that are changed or left out.
#[test]
fn a_beam_that_comes_early_or_stays_late_is_found() {
    let build = built_on(profile(LASER_PROFILE));
    let good = text(&build, SEAL);
    let armed = good.find("\nM4 S0\n").expect("an armed laser");
    for (old, new, code) in [
        (" F480\n", " F480 S95\n", "beam-off-focus"),
        (" Z13 S0\n", " Z13\n", "beam-off-focus"),
        (" Z12 F480\n", " Z12.5 F480\n", "beam-off-focus"),
        (" S95\n", " S94\n", "wrong-power"),
        (" S95\n", "\n", "wrong-power"),
        (" S95\n", " S950\n", "wrong-power"),
        ("M4 S0\n", "", "wrong-power"),
        ("M4 S0\n", "M4 S95\n", "beam-at-rest"),
        ("M4 S0\n", "M3 S0\n", "beam-constant"),
        ("M5\n; cool", "; cool", "beam-at-rest"),
        ("; cool: time_s=1\n", "M4 S0\n; cool: time_s=1\n", "beam-at-rest"),
        ("G4 P0.999\n", "", "missing-wait"),
    ] {
        let (head, body) =
            good.split_at(if old.starts_with("M5") || old.starts_with("; cool") { 0 } else { armed });
        assert!(body.contains(old), "{old:?}");
        let forged = format!("{head}{}", body.replacen(old, new, 1));
        let findings = findings_with(&build, SEAL, &recounted(&forged.lines().collect::<Vec<_>>()));
        assert!(
            findings.iter().any(|finding| finding.code == code),
            "{old:?} -> {new:?}: no {code}: {findings:#?}"
        );
    }
    // Facts in the header, and the stop before the beam.
    for (old, new, code) in [
        ("full_power_S=1000", "full_power_S=255", "other-comment"),
        ("focus_mm=12", "focus_mm=2", "other-comment"),
        ("power_percent=9.5", "power_percent=8", "other-comment"),
        ("; beam: armed_by=operator\n", "", "other-comment"),
        ("press start\nM0\n", "press start\n", "profile-line"),
        ("\nM5\nG21", "\nG21", "profile-line"),
        ("\nM5\nM2", "\nM2", "profile-line"),
    ] {
        assert!(good.contains(old), "{old:?}");
        let forged = good.replacen(old, new, 1);
        let findings = findings_with(&build, SEAL, &recounted(&forged.lines().collect::<Vec<_>>()));
        assert!(
            findings.iter().any(|finding| finding.code == code),
            "{old:?} -> {new:?}: no {code}: {findings:#?}"
        );
    }
    let trace = text(&build, TRACE);
    for danger in ["M4 S5\nG0 Z30", "M3 S5\nG0 Z30", "M4\nG0 Z30"] {
        let forged = trace.replacen("G0 Z30", danger, 1);
        let findings = findings_with(&build, TRACE, &recounted(&forged.lines().collect::<Vec<_>>()));
        assert!(findings.iter().any(|finding| finding.code == "hot-trace"), "{danger}: {findings:#?}");
    }
}

/// The second clock: a laser is never faster than told, slower only where it brakes, and its total time is right.
#[test]
fn a_laser_takes_as_long_as_it_states() {
    for (dialect, controller) in [("grbl", LASER_PROFILE), ("grblhal", "grblhal"), ("fluidnc", "fluidnc")] {
        for (speed, acceleration) in [(2.0, 500.0), (10.0, 500.0), (20.0, 500.0), (20.0, 2000.0)] {
            let seal = format!("[seal]\npower = \"8 %\"\nspeed = \"{speed} mm/s\"\ntip = \"0.8 mm\"\n");
            let text_of_machine = profile_of(dialect)
                .replace(
                    "acceleration = \"500 mm/s^2\"",
                    &format!("acceleration = \"{acceleration} mm/s^2\""),
                )
                .replace("park = \"30 mm\"", "park = \"15 mm\"");
            let request = KindRequest::exactly(&[Kind::SealGcode]);
            let build = try_built_with(&spec_text(&seal), &text_of_machine, &request).expect("built");
            let program = Text::read(&text(&build, SEAL));
            let motors = Motors { acceleration, steps_per_mm: 80.0 };
            let track = run(controller, &program, motors);
            let total = program.fact("total.time_s").expect("a time");
            let error = track.now / total - 1.0;
            println!("{dialect} {speed} mm/s, {acceleration} mm/s^2: {:+.2} % of {total} s", 100.0 * error);
            assert!(error.abs() <= TOTAL, "{dialect} {speed} {acceleration}: {} of {total} s", track.now);
            for stretch in &track.stretches {
                let (mean, (_, fastest)) = (stretch.speed() / speed, stretch.windows(1.0));
                assert!((0.9..=1.002).contains(&mean), "{dialect} {speed}: mean {mean}");
                assert!(fastest <= 1.02 * speed, "{dialect} {speed}: {fastest}");
            }
        }
    }
}

/// The distance of `place` from the nearest of `paths`, mm.
fn distance(paths: &[&Path], place: Point) -> f64 {
    paths.iter().map(|path| path.distance(place)).fold(f64::INFINITY, f64::min)
}

/// Whether the lines of a band weld the band, and nothing beside it: the largest distance, mm, by which a place of it is off a spot, and by
/// which a spot leaves the band. Places are within the band, half a band from the ends of open seams, whose caps are round.
fn cover(spec_text: &str) -> [f64; 2] {
    let star_spec = spec(spec_text);
    let design =
        Design::new(&star_spec, &machine(profile(LASER_PROFILE))).unwrap_or_else(|why| panic!("{why:?}"));
    let part = design.part(&design.placed()[0]);
    let (band, spot) = (star_spec.seal.band.0, star_spec.seal.tip_width().0);
    let (mut open, mut excess) = (0.0_f64, 0.0_f64);
    for (seam, lines) in part.shape().seams.iter().zip(part.seam_lines()) {
        let (center, paths) = (&seam.center_line, lines.lines.iter().map(|line| &line.center_line));
        let paths: Vec<&Path> = paths.collect();
        let length = center.length();
        for i in 0..1500_u32 {
            let s = length * (f64::from(i) + 0.5) / 1500.0;
            let (place, way) = (center.point_at(s).expect("a place"), center.tangent_at(s).expect("a way"));
            for j in -12..=12_i32 {
                let p = place + way.perp() * (0.5 * band * f64::from(j) / 12.0);
                let nearest = center.nearest(p).expect("a path");
                let is_inside = nearest.distance <= 0.5 * band
                    && (center.closed || (band..length - band).contains(&nearest.s));
                if is_inside {
                    open = open.max(distance(&paths, p) - 0.5 * spot);
                }
            }
        }
        for path in paths {
            for i in 0..800_u32 {
                let p = path.point_at(path.length() * f64::from(i) / 800.0).expect("a place");
                excess = excess.max(center.distance(p) + 0.5 * spot - 0.5 * band);
            }
        }
    }
    [open, excess]
}

/// A star with tips of `tip` degrees and corners of `corner` mm, sealed by a laser with the keys `seal`.
fn star_text(tip: f64, corner: f64, seal: &str) -> String {
    format!(
        "schema = 1\nname = \"x\"\n[star]\npoints = 4\ninner_radius = \"20 mm\"\ntube_width = \"12 mm\"\ntip_angle = \"{tip} deg\"\n\
         corner_radius = \"{corner} mm\"\n[machine]\nprofile = \"grbl-laser\"\n[seal]\npower = \"8 %\"\n{seal}"
    )
}

#[test]
fn lines_side_by_side_weld_the_band_and_nothing_else() {
    for (tip, corner) in [(20.0, 0.0), (40.0, 0.5), (60.0, 2.0)] {
        for (band, spot) in [(2.0, 2.0), (2.0, 1.0), (2.0, 0.55), (3.0, 0.4), (1.5, 0.3)] {
            let [open, excess] =
                cover(&star_text(tip, corner, &format!("band = \"{band} mm\"\ntip = \"{spot} mm\"\n")));
            assert!(
                open <= 0.01 && excess <= 0.01,
                "{tip} deg, {band} by {spot} mm: {open} open, {excess} beyond"
            );
        }
    }
    // Lines that only meet leave gaps at sharp corners: the measure sees them.
    let iron = star_text(20.0, 0.0, "band = \"2 mm\"\ntip = \"1 mm\"\n")
        .replace("power = \"8 %\"\n", "")
        .replace("grbl-laser", "grbl");
    assert!(cover(&iron)[0] > 0.05, "{:?}", cover(&iron));
}

#[test]
fn a_laser_and_an_iron_are_not_mistaken_for_each_other() {
    let laser = "[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\n";
    let lasers = builtin_machine(LASER_PROFILE).expect("built in");
    for (seal, machine_text, code) in [
        (laser, profile("grbl"), "no-laser"),
        (laser, profile("marlin"), "no-laser"),
        ("[seal]\nspeed = \"10 mm/s\"\n", lasers, "no-laser"),
        (
            "[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\nfocus = \"13 mm\"\n",
            lasers,
            "high-focus",
        ),
        ("[seal]\npower = \"8 %\"\nspeed = \"0.1 mm/s\"\ntip = \"1 mm\"\n", lasers, "feed-floor"),
    ] {
        let refusals = try_built(&spec_text(seal), machine_text).map(|_| ()).expect_err("another tool");
        let codes: Vec<String> = refusals.iter().map(|refusal| refusal.code.to_string()).collect();
        assert_eq!(codes, [code], "{seal}");
        assert!(!refusals[0].remedy.contains("chop"), "{refusals:?}");
    }
}
