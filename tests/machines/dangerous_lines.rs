//! Dangerous lines in a profile: each is refused, in every dialect and at every place.

use stargrip_cam::spec::{Source, builtin_machine, read_machine};

use crate::{PROFILES, profile};

/// 82 lines, each of which moves, heats, ends, reconfigures, shifts coordinates, runs another program, contradicts the
/// seal, or tells the operator something that the program does not.
const LINES: [&str; 82] = [
    "G0 Z-50",
    "g0z-50",
    "G1 X5 F600",
    "G2 X5 I1",
    "G28 E",
    "G29",
    "G30",
    "G38.2 Z-5 F10",
    "G53 G0 Z0",
    "G54",
    "G92 Z0",
    "G92.1",
    "G10 L2 P1 Z5",
    "G43 H1",
    "G51 X2",
    "G68 R90",
    "G20",
    "G91",
    "G90.1",
    "G93",
    "G18",
    "G12",
    "G64",
    "G4 P9999",
    "G21 G91",
    "G90 X5",
    "Z-50",
    "M3 S1000",
    "M4",
    "M5",
    "M7",
    "M8",
    "M6",
    "T1",
    "T1 M6",
    "M0",
    "M1",
    "M30 evil.g",
    "M98 P1",
    "M98 P\"x.g\"",
    "M104 S450",
    "M104 S200 R1",
    "M109 S300",
    "M109 R300",
    "M140 S120",
    "M190 S120",
    "M112",
    "M118 x",
    "M117 x",
    "M303 E0 S300 C8",
    "M500",
    "M501",
    "M502",
    "M600",
    "M999",
    "M203 Z5",
    "M203 I600",
    "M203 S1",
    "M203",
    "M205 S500",
    "M205 T500",
    "M205 S60 T60",
    "M205",
    "M211 S0",
    "M92 X999",
    "$H",
    "$X",
    "%",
    "#1=5",
    "O100 call",
    "/M112",
    "N5 M112",
    "SET_KINEMATIC_POSITION X=0 Y=0 Z=0",
    "FORCE_MOVE STEPPER=stepper_z DISTANCE=-50 VELOCITY=5",
    "SET_GCODE_OFFSET Z=-5",
    "SET_HEATER_TEMPERATURE HEATER=extruder TARGET=300",
    "SAVE_CONFIG",
    "RUN_SHELL_COMMAND CMD=x",
    "FIRMWARE_RESTART",
    "SET_VELOCITY_LIMIT VELOCITY=0.05 ACCEL=1",
    "SET_IDLE_TIMEOUT TIMEOUT=0",
    "; set the iron to 400 C",
];

/// Remarks that a controller obeys, or that contradict the program.
const REMARKS: [&str; 14] = [
    "(LOGOPEN,/tmp/x)",
    "(PROBEOPEN x)",
    "(py,import os)",
    "(print,x)",
    "(DEBUG,#1)",
    "(MSG,wait)",
    ";py,import evil",
    "; heat: temperature_C=400",
    "; seal: temperature_C=400 speed_mm_s=1",
    "; seam: seam=1",
    "; set the iron to 400 C",
    "G21 ; set the iron to 400 C",
    "G21 (print,x)",
    "; end of program, 3 lines",
];

/// The profile `name` with `line` added to `part`, or as its pause.
fn profile_with(name: &str, part: &str, line: &str) -> String {
    let quoted = line.replace('\\', "\\\\").replace('"', "\\\"");
    let (from, to) = match part {
        "pause" => ("pause = \"", format!("pause = \"{quoted}\" # \"")),
        _ => (if part == "start" { "start = [" } else { "end = [" }, format!("{part} = [\"{quoted}\", ")),
    };
    let text = profile(name);
    assert!(text.contains(from), "{name}: {from}");
    text.replacen(from, &to, 1)
}

#[test]
fn no_dangerous_line_is_read_in_any_dialect() {
    let own_pause =
        |name: &str| ["generic", "linuxcnc", "grbl", "grblhal", "fluidnc", "marlin"].contains(&name);
    for name in PROFILES {
        for part in ["start", "pause", "end"] {
            for line in LINES.into_iter().chain(REMARKS) {
                // The pause command of these controllers is not dangerous in the place of the pause.
                if line == "M0" && part == "pause" && own_pause(name) {
                    continue;
                }
                let text = profile_with(name, part, line);
                let faults = read_machine(&Source::new("mine", text.clone()))
                    .expect_err(&format!("{name} {part} {line}"));
                let codes: Vec<_> = faults.list().iter().map(|fault| fault.code).collect();
                assert!(
                    codes.iter().all(|code| ["program-line", "conflict"].contains(code)),
                    "{name} {part} {line}: {codes:?}"
                );
                // The fault is at its line.
                let number = 1 + text
                    .lines()
                    .position(|text| text.starts_with(&format!("{part} = ")))
                    .expect("a line");
                assert!(
                    faults.to_string().contains(&format!("mine:{number}:")),
                    "{name} {part} {line}: {faults}"
                );
            }
        }
        assert!(
            read_machine(&Source::new("mine", builtin_machine(name).expect("built in"))).is_ok(),
            "{name}"
        );
    }
}

/// A setting is compared with other values of the profile.
#[test]
fn settings_agree_with_the_profile() {
    let read = |name: &str, from: &str, to: &str| {
        let text = profile(name);
        assert!(text.contains(from), "{name}: {from}");
        let read = read_machine(&Source::new("mine", text.replacen(from, to, 1)));
        read.map(|_| ()).map_err(|faults| faults.list().iter().map(|fault| fault.code).collect::<Vec<_>>())
    };
    let conflict = Err(vec!["conflict"]);
    assert_eq!(read("reprapfirmware", "\"M203 I5\"", "\"M203 I4\""), Ok(()));
    assert_eq!(read("reprapfirmware", "\"M203 I5\"", "\"M203 I6\""), conflict);
    assert_eq!(read("reprapfirmware", "min_feed = \"5 mm/min\"", "min_feed = \"4 mm/min\""), conflict);
    assert_eq!(read("marlin", "M205 S0 T0", "M205 S0 T1"), conflict);
    let limit = |line: &str| format!("\"{line}\", \"SET_IDLE");
    assert_eq!(read("klipper", "\"SET_IDLE", &limit("SET_VELOCITY_LIMIT VELOCITY=20")), Ok(()));
    assert_eq!(read("klipper", "\"SET_IDLE", &limit("SET_VELOCITY_LIMIT VELOCITY=19")), conflict);
    assert_eq!(read("klipper", "\"SET_IDLE", &limit("SET_VELOCITY_LIMIT ACCEL=500")), conflict);
    assert_eq!(read("klipper", "acceleration = \"unknown\"", "acceleration = \"500 mm/s^2\""), Ok(()));
}

/// A setting is compared with the seal's speed and the job's time, which the profile does not contain.
#[test]
fn settings_agree_with_the_seal() {
    let codes = |rest: &str, from: &str, to: &str| {
        let machine = profile("klipper").replacen(from, to, 1);
        match crate::try_built(&crate::spec_text(rest), &machine) {
            Ok(_) => Vec::new(),
            Err(refusals) => refusals.iter().map(|refusal| refusal.code.to_string()).collect(),
        }
    };
    let limited = "[\"SET_VELOCITY_LIMIT VELOCITY=25\", ";
    assert_eq!(codes("", "start = [", &format!("start = {limited}")), [""; 0]);
    assert_eq!(
        codes("[seal]\nspeed = \"26 mm/s\"\n", "start = [", &format!("start = {limited}")),
        ["profile-limit"]
    );
    assert_eq!(codes("", "TIMEOUT=86400", "TIMEOUT=1"), ["profile-limit"]);
    assert_eq!(codes("", "TIMEOUT=86400", "TIMEOUT=600"), ["profile-limit"]);
}
