//! The profile's own lines and the header: their content is proven like every other line.

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::pipeline::{Sources, build};
use stargrip_cam::spec::DialectFamily;
use stargrip_cam::verify::Finding;

use crate::{
    PROFILES, built, findings_after, findings_with, is_printer, profile, profiles_of, spec_text, star,
};

const SEAL: &str = "star-1-seal.gcode";
const TRACE: &str = "star-1-trace.gcode";

/// The place where a line is inserted or changed.
#[derive(Clone, Copy, Debug)]
enum At {
    /// Before the first motion.
    Head,
    /// Before the first line in contact that begins with this text.
    Contact,
    /// Before the last line of code.
    Tail,
}

/// Index of a place in a program.
fn place(lines: &[String], at: At) -> usize {
    let code = |line: &String| !line.starts_with(';');
    match at {
        At::Head => lines.iter().position(|line| line.starts_with("G0 Z")),
        At::Contact => lines.iter().rposition(|line| {
            ["G1 ", "G2 ", "G3 "].iter().any(|word| line.starts_with(word)) && !line.contains(['Z', 'F'])
        }),
        At::Tail => lines.iter().rposition(code),
    }
    .expect("such a line")
}

/// The findings after `change` of the lines of `file`.
fn after(name: &str, file: &str, change: impl FnOnce(&mut Vec<String>)) -> Vec<Finding> {
    findings_after(&star(name), file, change)
}

#[track_caller]
fn assert_found(name: &str, findings: &[Finding], code: &str, line: usize) {
    let found = findings.iter().any(|finding| finding.code == code && finding.line == Some(line));
    assert!(found, "{name}: no {code} in line {line}: {:#?}", &findings[..findings.len().min(6)]);
}

/// An inserted line gives a finding at that line.
#[track_caller]
fn assert_inserted(names: &[&str], file: &str, at: At, inserted: &str, code: &str) {
    for name in names {
        let place = std::cell::Cell::new(0);
        let findings = after(name, file, |lines| {
            place.set(self::place(lines, at));
            lines.insert(place.get(), inserted.to_owned());
        });
        assert_found(name, &findings, code, place.get() + 1);
    }
}

#[test]
fn the_first_motion_goes_up_in_every_dialect() {
    for file in [SEAL, TRACE] {
        assert_inserted(&PROFILES, file, At::Head, "G0 Z-50", "blind-move");
        assert_inserted(&PROFILES, file, At::Head, "G0 Z-999999", "blind-move");
    }
    assert_inserted(&PROFILES, SEAL, At::Head, "G0 Z4", "blind-move");
    assert_inserted(&PROFILES, SEAL, At::Head, "G0 Z400", "blind-move");
    assert_inserted(&PROFILES, SEAL, At::Head, "G0 X0 Y0", "blind-move");
    assert_inserted(&PROFILES, SEAL, At::Head, "G1 Z30 F60", "blind-move");
    for name in PROFILES {
        let raised = std::cell::Cell::new(0);
        let findings = after(name, SEAL, |lines| {
            raised.set(place(lines, At::Head) + 1);
            // Before X and Y are defined: down, and far away.
            lines.insert(raised.get(), "G0 Z-1".to_owned());
            lines.insert(raised.get() + 1, "G0 Z30".to_owned());
            lines.insert(raised.get() + 2, "G0 X99999".to_owned());
        });
        assert_found(name, &findings, "blind-move", raised.get() + 1);
        assert_found(name, &findings, "blind-move", raised.get() + 3);
    }
    // After the start no motion goes above the park height.
    assert_inserted(&["generic", "marlin"], SEAL, At::Tail, "G0 Z400", "outside-work-area");
}

#[test]
fn settings_stand_where_the_profile_puts_them() {
    assert_inserted(&["reprapfirmware"], SEAL, At::Contact, "M203 I600", "profile-line");
    assert_inserted(&["marlin"], SEAL, At::Contact, "M205 S50", "profile-line");
    assert_inserted(&["marlin"], SEAL, At::Contact, "M205 T500", "profile-line");
    assert_inserted(
        &["klipper"],
        SEAL,
        At::Contact,
        "SET_VELOCITY_LIMIT VELOCITY=0.05 ACCEL=1",
        "profile-line",
    );
    assert_inserted(&["klipper"], SEAL, At::Contact, "SET_IDLE_TIMEOUT TIMEOUT=1", "profile-line");
    assert_inserted(&["linuxcnc"], SEAL, At::Contact, "G61", "profile-line");
    assert_inserted(&PROFILES, SEAL, At::Contact, "G90", "profile-line");
    assert_inserted(&PROFILES, SEAL, At::Head, "G90", "profile-line");
    assert_inserted(&["klipper"], SEAL, At::Head, "SET_IDLE_TIMEOUT TIMEOUT=1", "profile-line");
    // A missing line of the start or the end is reported at the next line.
    for (name, gone) in [
        ("reprapfirmware", "M203 I5"),
        ("marlin", "M205 S0 T0"),
        ("klipper", "SET_IDLE_TIMEOUT TIMEOUT=86400"),
        ("klipper", "SET_IDLE_TIMEOUT TIMEOUT=600"),
        ("reprapfirmware", "M104 S0"),
        ("marlin", "M104 S0"),
        ("klipper", "M104 S0"),
    ] {
        for file in [SEAL, TRACE] {
            let findings = after(name, file, |lines| {
                let at = lines.iter().position(|line| line == gone).expect("a line of the profile");
                let _ = lines.remove(at);
            });
            let found = findings.iter().any(|f| {
                f.code == "profile-line"
                    && f.file.starts_with(file.trim_end_matches("gcode"))
                    && f.line.is_some()
            });
            assert!(found, "{name} without {gone}: {findings:#?}");
        }
    }
}

#[test]
fn a_profile_changed_after_the_build_is_found() {
    let build = built(&spec_text(""), profile("generic"));
    let other = profile("generic").replacen("\"G94\"]", "\"G94\", \"G90\"]", 1);
    let findings = findings_with(&build, "machine.toml", &other);
    for file in [SEAL, TRACE] {
        let found = findings.iter().any(|f| {
            f.code == "profile-line" && f.file.starts_with(file.trim_end_matches("gcode")) && f.line.is_some()
        });
        assert!(found, "{file}: {findings:#?}");
    }
}

#[test]
fn heaters_are_told_once_and_turned_off() {
    for name in profiles_of(DialectFamily::Printer) {
        for file in [SEAL, TRACE] {
            assert_inserted(&[name], file, At::Tail, "M109 S200", "stray-heat");
            assert_inserted(&[name], file, At::Tail, "M104 S200", "stray-heat");
            assert_inserted(&[name], file, At::Head, "M104 S450", "stray-heat");
        }
        // Hotter at first, then correct.
        let hot = std::cell::Cell::new(0);
        let findings = after(name, SEAL, |lines| {
            hot.set(lines.iter().position(|line| line.starts_with("M109")).expect("a heating"));
            lines.insert(hot.get(), "M109 S450".to_owned());
        });
        assert_found(name, &findings, "stray-heat", hot.get() + 1);
    }
}

#[test]
fn waits_in_one_place_are_added_up() {
    for name in PROFILES {
        let wait = if is_printer(name) { "G4 P1900" } else { "G4 P1.9" };
        let at = std::cell::Cell::new(0);
        let findings = after(name, SEAL, |lines| {
            at.set(place(lines, At::Contact));
            for _ in 0..50 {
                lines.insert(at.get(), wait.to_owned());
            }
        });
        assert_found(name, &findings, "iron-at-rest", at.get() + 2);
        // Also between short remainders of a move.
        let findings = after(name, SEAL, |lines| {
            at.set(place(lines, At::Contact));
            lines.insert(at.get(), wait.to_owned());
        });
        let first = findings.iter().find(|f| f.code == "wrong-feed" || f.code == "iron-at-rest");
        assert!(
            first.is_some_and(|f| f.line.is_some_and(|line| line.abs_diff(at.get() + 1) <= 4)),
            "{name}: {findings:#?}"
        );
    }
}

#[test]
fn comments_are_facts() {
    for name in ["generic", "grbl", "klipper", "marlin"] {
        let changes: &[(&str, &str)] = &[
            ("speed_mm_s=0.1", "speed_mm_s=10"),
            ("contact_mm=-0.3", "contact_mm=1"),
            ("travel_mm=5", "travel_mm=0.5"),
            ("ramp_mm=3", "ramp_mm=30"),
            ("overlap_mm=5", "overlap_mm=0"),
            ("seal: temperature_C=200", "seal: temperature_C=450"),
            ("; machine: dialect=", "; machine: dialect=x"),
            ("seam: seam=2 star=1", "seam: seam=2 star=2"),
        ];
        for (from, to) in changes {
            let at = std::cell::Cell::new(0);
            let findings = after(name, SEAL, |lines| {
                at.set(
                    lines
                        .iter()
                        .position(|line| line.contains(from))
                        .unwrap_or_else(|| panic!("{name}: {from}")),
                );
                lines[at.get()] = lines[at.get()].replacen(from, to, 1);
            });
            assert_found(name, &findings, "other-comment", at.get() + 1);
        }
    }
    // Instructions to the operator, who has no other source.
    let at = std::cell::Cell::new(0);
    let findings = after("generic", SEAL, |lines| {
        at.set(lines.iter().position(|line| line.contains("set the iron to 200 C")).expect("a word"));
        lines[at.get()] = lines[at.get()].replacen("200", "450", 1);
    });
    assert_found("generic", &findings, "other-comment", at.get() + 1);
}

#[test]
fn a_trace_goes_at_its_speed() {
    for name in ["generic", "klipper"] {
        let at = std::cell::Cell::new(0);
        let findings = after(name, TRACE, |lines| {
            at.set(
                lines.iter().position(|line| line.starts_with("G1 ") && line.contains(" F")).expect("a feed"),
            );
            let line = lines[at.get()].split(" F").next().unwrap_or_default().to_owned();
            lines[at.get()] = line + " F60000";
        });
        assert_found(name, &findings, "wrong-feed", at.get() + 1);
    }
}

/// A built-in name in the spec requires the profile of that name, in every value that the files depend on.
#[test]
fn a_profile_is_the_one_that_the_spec_names() {
    let name =
        |profile: &str| spec_text(&format!("[machine]\nfeed_floor = \"chop\"\nprofile = \"{profile}\"\n"));
    let grbl = profile("grbl");
    let build_of = |text: &str| {
        let sources = Sources { spec: text, machine: grbl };
        build(&crate::spec(text), &crate::machine(grbl), sources, &KindRequest::default()).expect("a gripper")
    };
    let (named, own) = (build_of(&name("grbl")), build_of(&name("mine.toml")));
    let without =
        |key: &str| -> String { grbl.split_inclusive('\n').filter(|line| !line.starts_with(key)).collect() };
    let line = grbl.lines().position(|line| line.starts_with("min_feed")).map(|line| line + 1);
    let found = findings_with(&named, "machine.toml", &without("min_feed"));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].code, found[0].file.as_str(), found[0].line), ("differs", "machine.toml", line));
    assert_eq!(findings_with(&own, "machine.toml", &without("min_feed")), []);
    assert_eq!(findings_with(&named, "machine.toml", &without("# ")), []);
    assert_eq!(findings_with(&named, "machine.toml", grbl), []);
}
