//! Lines that must not be in a program for a printer, each with the code of the finding at its line or the next.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::{Built, read_back};
use stargrip_cam::spec::{builtin_machine, read_machine};

use crate::danger::missed;
use crate::{profile, spec_text, text, try_built_with};

const SEAL: &str = "star-1-seal.gcode";

/// The place of an inserted line.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// Before the profile's first line.
    First,
    /// Before the first motion.
    Head,
    /// Among the moves in contact.
    Contact,
    /// After the last motion.
    Tail,
}

/// Profile, place, code, and the lines that have it there.
type LineRow = (&'static str, Place, &'static str, &'static [&'static str]);

const ROWS: &[LineRow] = &[
    // The extruder, and what lets it move cold.
    (
        "ender",
        Place::Contact,
        "unknown-word",
        &[
            "G1 E5 F300",
            "G1 X50 Y50 E5",
            "G0 E-1 F300",
            "M302",
            "M302 S0",
            "M302 P1",
            "M82",
            "M83",
            "M221 S50",
            "M207 S3",
            "G10",
            "G11",
            "M600",
            "M701",
            "M702",
            "T1",
            "T0",
        ],
    ),
    // Coordinates and their zero.
    (
        "ender",
        Place::Contact,
        "unknown-word",
        &[
            "G92",
            "G92 Z0",
            "G92 X0 Y0",
            "G92 E0",
            "G92.1",
            "M206 Z-5",
            "M428",
            "M851 Z-5",
            "M290 Z-1",
            "G53",
            "G54",
            "G20",
            "G18",
            "M211 S1",
            "M420 S0",
            "M92 X40",
            "G29 P1",
        ],
    ),
    // Settings and power.
    (
        "ender",
        Place::Contact,
        "unknown-word",
        &[
            "M201 X9",
            "M204 P1",
            "M203 Z1",
            "M500",
            "M502",
            "M303 E0 S250 C8",
            "M106 S255",
            "M3 S255",
            "M5",
            "M42 P1 S255",
            "M81",
            "M112",
            "M999",
            "M997",
            "M30 a.g",
            "M23 a.g",
            "M24",
            "M226",
            "M98 P1",
            "M48",
            "M108",
            "M410",
        ],
    ),
    ("ender", Place::Contact, "unhomed-axis", &["G28", "G28 Z", "G28 X Y", "G28 W"]),
    (
        "ender",
        Place::Contact,
        "profile-line",
        &["G29", "M420 S1", "M211 S0", "M107", "M17", "M220 S100", "G91", "M205 S50", "M0"],
    ),
    ("ender", Place::Contact, "feed-override", &["M220 S50", "M220 S200", "M220 S0"]),
    ("ender", Place::Contact, "hot-bed", &["M140 S120", "M190 S120", "M190 S61", "M141 S80", "M191 S80"]),
    (
        "ender",
        Place::Contact,
        "stray-heat",
        &["M104 S250", "M109 S250", "M104 S0", "M104 T1 S200", "M109 T1 S200"],
    ),
    ("ender", Place::Contact, "iron-at-rest", &["G4 P60000", "M0"]),
    ("ender", Place::Contact, "too-deep", &["G1 Z-5 F600"]),
    ("ender", Place::Contact, "after-end", &["M84"]),
    (
        "ender",
        Place::First,
        "unhomed-axis",
        &[
            "G29",
            "M420 S1",
            "G28 X Y\nG29",
            "G0 X50 Y50 F1200",
            "G0 Z5 F1200",
            "G1 X50 Y50 F600",
            "G28 Z\nG0 X50 F1200",
        ],
    ),
    ("ender", Place::First, "hot-bed", &["M140 S120", "M190 S120", "M191 S80"]),
    ("ender", Place::First, "feed-override", &["M220 S50"]),
    ("ender", Place::Head, "blind-move", &["G0 Z-5 F1200", "G0 X50 Y50 F1200", "G1 Z31 F1200"]),
    ("ender", Place::Head, "stray-heat", &["M104 S250", "M109 S250"]),
    ("ender", Place::Head, "hot-bed", &["M140 S40", "M190 S100"]),
    ("ender", Place::Head, "feed-override", &["M220 S99", "M220 S50"]),
    ("ender", Place::Head, "profile-line", &["G28", "M211 S0", "M107", "M17"]),
    ("ender", Place::Tail, "stray-heat", &["M104 S200", "M140 S40", "M190 S40"]),
    ("ender", Place::Tail, "unhomed-axis", &["G28", "G28 X Y"]),
    (
        "klipper-printer",
        Place::Contact,
        "unknown-word",
        &["G92 Z0", "G92 E0", "G1 E5 F300", "M302", "M83", "M141 S80", "M420 S1", "M211 S0"],
    ),
    (
        "klipper-printer",
        Place::Contact,
        "heat-without-pause",
        &["SET_HEATER_TEMPERATURE HEATER=extruder TARGET=300"],
    ),
    (
        "klipper-printer",
        Place::Contact,
        "stray-heat",
        &["TEMPERATURE_WAIT SENSOR=extruder MINIMUM=20", "SET_HEATER_TEMPERATURE HEATER=extruder TARGET=0"],
    ),
    (
        "klipper-printer",
        Place::Contact,
        "profile-line",
        &["BED_MESH_PROFILE LOAD=default", "BED_MESH_CALIBRATE", "SET_VELOCITY_LIMIT ACCEL=1"],
    ),
    ("klipper-printer", Place::First, "unhomed-axis", &["BED_MESH_PROFILE LOAD=default"]),
    (
        "bambu",
        Place::Contact,
        "unknown-word",
        &[
            "G1 E5 F300",
            "G92 E0",
            "M302 P1",
            "M83",
            "M1002 gcode_claim_action : 4",
            "G29.1 Z-0.5",
            "G380 S3 Z-5 F1200",
            "M400",
            "T255",
            "M17 X0.5",
            "M970.3 Q1 A5 K0 O3",
            "M221 X0 Y0 Z0",
            "G29.2 S0",
            "M0",
        ],
    ),
    ("bambu", Place::Contact, "profile-line", &["M400 U1", "M211 X0 Y0 Z0", "M106 P1 S0"]),
    (
        "prusa",
        Place::Contact,
        "unknown-word",
        &[
            "G1 E5 F300",
            "G92 E0",
            "M302 S0",
            "M83",
            "G80",
            "M601",
            "M602",
            "M900 K0.05",
            "M572 S0.05",
            "G64",
            "M486 S-1",
        ],
    ),
    // Words of more than a letter that no program needs.
    (
        "klipper-printer",
        Place::Contact,
        "bad-number",
        &[
            "SET_KINEMATIC_POSITION X=0 Y=0 Z=0",
            "SET_GCODE_OFFSET Z=-1",
            "FORCE_MOVE STEPPER=stepper_z DISTANCE=-5 VELOCITY=5",
            "BED_MESH_CLEAR",
            "SAVE_GCODE_STATE NAME=a",
            "RESTORE_GCODE_STATE NAME=a MOVE=1",
            "SET_PRESSURE_ADVANCE ADVANCE=1",
            "ACTIVATE_EXTRUDER EXTRUDER=extruder1",
            "CANCEL_PRINT",
            "RESUME",
            "RUN_SHELL_COMMAND CMD=x",
            "FIRMWARE_RESTART",
            "SET_FAN_SPEED FAN=a SPEED=1",
        ],
    ),
    ("bambu", Place::Contact, "bad-number", &["M620 S0A", "M621 S0A"]),
    ("prusa", Place::Contact, "bad-number", &["M861.3 P\"MK4\""]),
    ("ender", Place::Contact, "unused-word", &["M0 S1", "P0 S1"]),
];

/// A small seal that every printer runs without strokes.
fn sealing_program(name: &str) -> Built {
    let request = KindRequest::exactly(&[Kind::SealGcode]);
    try_built_with(&spec_text("[seal]\nspeed = \"10 mm/s\"\n"), profile(name), &request)
        .unwrap_or_else(|refusals| panic!("{name}: {refusals:?}"))
}

/// The index before which a line is inserted at `place`.
fn index(lines: &[&str], place: Place) -> usize {
    let is_code = |line: &&str| !line.starts_with(';');
    match place {
        Place::First => lines.iter().position(|line| *line == "G28"),
        Place::Head => lines.iter().position(|line| line.starts_with("G0 Z")),
        Place::Contact => {
            lines.iter().rposition(|line| line.starts_with("G1 ") && !line.contains(['Z', 'F']))
        }
        Place::Tail => lines.iter().rposition(is_code),
    }
    .expect("such a line")
}

#[test]
fn no_dangerous_line_is_proven() {
    let (mut number, mut unproven) = (0, Vec::new());
    for name in ["ender", "klipper-printer", "bambu", "prusa"] {
        let build = sealing_program(name);
        assert_eq!(read_back(&build.output_files()).findings, [], "{name}");
        let good = text(&build, SEAL);
        let lines: Vec<&str> = good.lines().collect();
        for &(_, place, code, dangers) in ROWS.iter().filter(|(own, ..)| *own == name) {
            for danger in dangers {
                number += 1;
                let miss = missed(&build, SEAL, &lines, index(&lines, place), danger, code, 1);
                unproven.extend(miss.map(|miss| format!("{name} {place:?} {miss}")));
            }
        }
    }
    assert!(unproven.is_empty(), "{unproven:#?}");
    assert!(number >= 100, "{number}");
}

/// The profile of a printer takes none of them among its first lines either, except what is in order there.
#[test]
fn no_dangerous_line_is_read_in_a_profile() {
    for &(name, _, _, dangers) in ROWS {
        let text = builtin_machine(name).expect("built in");
        for danger in dangers.iter().filter(|danger| !danger.contains('\n')) {
            let quoted = danger.replace('"', "\\\"");
            let spoilt = text.replacen("start = [", &format!("start = [\"{quoted}\", "), 1);
            let read = read_machine(&stargrip_cam::spec::Source::new("own", spoilt));
            let is_harmless =
                ["G28", "G28 W", "G28 Z", "G28 X Y", "M107", "M17", "M220 S100", "M106 P1 S0", "M104 S0"]
                    .contains(danger)
                    || danger.ends_with("TARGET=0");
            assert_eq!(read.is_ok(), is_harmless, "{name}: {danger}");
        }
    }
}
