//! From an object to a gripper: every request gives a spec that builds and holds it, or a refusal with the nearest possible request.

use crate::support::dice::Dice;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

pub(super) fn run(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stargrip-cam")).current_dir(dir).args(args).output().expect("it runs")
}

pub(super) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

pub(super) fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

/// Asserts that the gripper of `wish.toml` in `dir` can be made and certainly holds `mass` kg, `width` mm across.
fn holds(dir: &Path, mass: f64, width: f64, asked: &str) {
    let check = run(dir, &["check", "wish.toml"]);
    assert_eq!(check.status.code(), Some(0), "{asked}: {}", text(&check.stderr));
    let predicted = run(dir, &["predict", "wish.toml", "--json"]);
    let value: Value = serde_json::from_slice(&predicted.stdout).expect("JSON");
    let low = value["ranges"]["payload_kg"][0].as_f64().expect("known");
    // A friction that is assumed may be two thirds of it: by itself it has half as much again, and at its least all of the mass.
    let spec = fs::read_to_string(dir.join("wish.toml")).expect("written");
    let margin = if spec.contains("friction_least = 0.2 ") { 1.0 } else { 1.15 };
    assert!(low >= margin * mass, "{asked}: {low} kg of {mass}: {value}");
    let ends = value["graspable_radius_mm"].as_array().expect("ends");
    assert!(ends[1].as_f64() > Some(0.5 * width) && value["model"] == "section", "{asked}: {value}");
    let closes = &value["ranges"]["final_radius_mm"];
    assert!(closes[1].as_f64() < Some(0.5 * width), "{asked}: {closes}");
}

/// The words of a command line with double quotes.
fn words(line: &str) -> Vec<String> {
    let parts = line.split('"').enumerate();
    parts
        .flat_map(|(i, part)| match i % 2 {
            0 => part.split_whitespace().map(str::to_owned).collect::<Vec<_>>(),
            _ => vec![part.to_owned()],
        })
        .collect()
}

/// The command lines of the requests near a refused one that `said` offers.
fn offers(said: &str) -> Vec<Vec<String>> {
    said.lines().filter_map(|line| line.trim().strip_prefix("stargrip-cam ")).map(words).collect()
}

/// The headings of the requests that `said` offers, each with its changes.
pub(super) fn headings(said: &str) -> impl Iterator<Item = (&str, &str)> {
    said.lines().filter(|line| line.starts_with("a request ")).filter_map(|line| line.split_once(" be met: "))
}

/// Asserts that each command that `said` offers gives a gripper which holds as its heading tells, and that there is one; the spec of the first
/// one is left in `dir`.
pub(super) fn can_be_had(dir: &Path, said: &str, asked: &str) {
    let certainties: Vec<bool> = headings(said).map(|(heading, _)| heading.ends_with(" can")).collect();
    assert!(!certainties.is_empty() && certainties.len() == offers(said).len(), "{asked}: {said}");
    for (command, is_certain) in offers(said).iter().zip(certainties).rev() {
        let _ = fs::remove_file(dir.join("wish.toml"));
        let command: Vec<&str> = command.iter().map(String::as_str).collect();
        let output = run(dir, &command);
        assert_eq!(output.status.code(), Some(0), "{asked}: {said}: {}", text(&output.stderr));
        let expected = if is_certain { "wish: holds the object" } else { "wish: may hold the object" };
        assert!(text(&output.stdout).starts_with(expected), "{asked}: {said}: {}", text(&output.stdout));
        let check = run(dir, &["check", "wish.toml"]);
        assert_eq!(check.status.code(), Some(0), "{asked}: {said}: {}", text(&check.stderr));
    }
}

/// Requests grippers for `count` random objects, 30 to 300 mm across, 10 g to 100 kg; returns the number of grippers.
fn wished(seed: u64, count: usize) -> usize {
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let mut part = || f64::from(u32::try_from(dice.below(10_000)).expect("small")) / 1e4;
    let mut held = 0;
    for _ in 0..count {
        let width = 30.0 * 10_f64.powf(part());
        let mass = 0.01 * 10_000_f64.powf(part());
        let (width, mass) = ((10.0 * width).round() / 10.0, (1e3 * mass).round() / 1e3);
        let (across, weight) = (format!("{width} mm"), format!("{mass} kg"));
        let mut args = vec!["new", "wish", "--object", &across, "--mass", &weight];
        if part() < 0.3 {
            args.extend(["--friction", "1.0"]);
        }
        if part() < 0.3 {
            args.extend(["--sheet", "600x600"]);
        }
        if part() < 0.2 {
            args.extend(["--pressure", "30 kPa"]);
        }
        let asked = args.join(" ");
        let dir = folder();
        let output = run(dir.path(), &args);
        match output.status.code() {
            Some(0) => {
                holds(dir.path(), mass, width, &asked);
                held += 1;
            }
            Some(1) => {
                assert!(!dir.path().join("wish.toml").exists());
                can_be_had(dir.path(), &text(&output.stderr), &asked);
            }
            code => panic!("{asked}: {code:?}"),
        }
    }
    held
}

#[test]
fn a_wish_is_granted_or_refused_with_what_comes_nearest() {
    let held = wished(1, 12);
    // The random numbers are the same on every machine, so another count is a changed result.
    assert_eq!(held, 9);
}

#[test]
#[ignore = "half a minute"]
fn two_hundred_wishes() {
    let held = wished(2, 200);
    assert_eq!(held, 112);
}

/// In the unit of the request.
#[test]
fn a_pressure_that_is_requested_is_written() {
    for (requested, written) in [("34.52 kPa", "34.52 kPa"), ("27.38 kPa", "27.38 kPa"), ("5 psi", "5 psi")] {
        let dir = folder();
        let output = run(
            dir.path(),
            &["new", "wish", "--object", "70 mm", "--mass", "300 g", "--pressure", requested],
        );
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
        let line = format!("pressure = \"{written}\"");
        assert!(spec.lines().any(|found| found.starts_with(&line)), "{line}: {spec}");
        holds(dir.path(), 0.3, 70.0, requested);
    }
}

#[test]
fn what_is_said_is_kept() {
    let dir = folder();
    let wish = [
        "new",
        "wish",
        "--object",
        "70 mm",
        "--mass",
        "300 g",
        "--pressure",
        "25 kPa",
        "--machine",
        "grbl",
        "--sheet",
        "500x500",
    ];
    let output = run(dir.path(), &wish);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
    for line in [
        "pressure = \"25 kPa\"",
        "profile = \"grbl\"",
        "width = \"500 mm\"",
        "mass = \"300 g\"",
        "object_diameter = \"70 mm\"",
    ] {
        assert!(spec.lines().any(|found| found.starts_with(line)), "{line}: {spec}");
    }
    // GRBL cannot move so slowly: the spec has the remedy, and the reason.
    assert!(
        spec.contains("feed_floor = \"chop\"")
            && spec
                .lines()
                .filter(|line| line.contains(" = "))
                .all(|line| line.contains('#') || line.starts_with("schema") || line.starts_with("name")),
        "{spec}"
    );
    holds(dir.path(), 0.3, 70.0, "what is said");
    // An existing file is never overwritten.
    assert_eq!(run(dir.path(), &wish).status.code(), Some(1));
}

/// Requests of real users: width, mass, and other options; the height is the object's, where it matters.
const WISHES: [(f64, &str, &[&str]); 18] = [
    (75.0, "1.2 kg", &["--height", "300 mm", "--shape", "cylinder"]),
    (44.0, "60 g", &["--height", "57 mm", "--fragile", "5 N"]),
    (240.0, "620 g", &[]),
    (30.0, "20 g", &[]),
    (30.0, "20 g", &["--fragile", "1 N"]),
    (16.0, "30 g", &["--height", "150 mm", "--shape", "cylinder"]),
    (150.0, "3 kg", &[]),
    (180.0, "500 g", &[]),
    (180.0, "500 g", &["--fragile", "15 N"]),
    (95.0, "300 g", &["--fragile", "3 N"]),
    (65.0, "89 g", &["--fragile", "1 N"]),
    (300.0, "10 kg", &["--height", "400 mm", "--shape", "cylinder", "--friction", "1"]),
    (60.0, "1 kg", &["--friction", "0.5"]),
    (90.0, "800 g", &[]),
    (30.0, "100 g", &["--friction", "0.5"]),
    (75.0, "500 g", &["--friction", "0.3"]),
    (120.0, "1.5 kg", &["--height", "200 mm", "--shape", "cylinder"]),
    (60.0, "200 g", &["--pressure", "30 kPa"]),
];

/// Every hole admits its object with the intended clearance, no stack is taller than its object, and forces are those at each star's
/// height.
#[test]
fn holes_admit_what_they_are_for_and_stacks_are_no_taller() {
    let (mut granted, mut stacks) = (0, 0);
    for (width, mass, more) in WISHES {
        let dir = folder();
        let across = format!("{width} mm");
        let args = [&["new", "wish", "--object", &across, "--mass", mass], more].concat();
        let asked = args.join(" ");
        let output = run(dir.path(), &args);
        match output.status.code() {
            Some(0) => granted += 1,
            Some(1) => can_be_had(dir.path(), &text(&output.stderr), &asked),
            code => panic!("{asked}: {code:?}: {}", text(&output.stderr)),
        }
        let check = run(dir.path(), &["check", "wish.toml", "--json"]);
        let value: Value = serde_json::from_slice(&check.stdout).expect("JSON");
        assert_eq!(value["verdict"]["holds"], true, "{asked}: {value}");
        let warned: Vec<&Value> =
            value["warnings"].as_array().expect("a list").iter().map(|one| &one["code"]).collect();
        assert!(
            !warned.iter().any(|code| *code == "tight-hole" || *code == "wide-frame"),
            "{asked}: {warned:?}"
        );
        let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
        let mm = |key: &str| {
            let line =
                spec.lines().find_map(|line| line.strip_prefix(key)?.trim_start().strip_prefix("= \""));
            line.and_then(|rest| rest.split_once(" mm")?.0.parse::<f64>().ok())
        };
        let width = mm("object_diameter").expect("the object's size");
        let stars = value["prediction"]["stars"].as_array().expect("stars");
        let least = f64::max(2.0, 0.025 * width);
        for star in stars {
            let (hole, gap) = (star["hole_radius_mm"].as_f64(), star["object_gap_mm"].as_f64());
            assert!(gap >= Some(least - 1e-9) && hole >= Some(0.5 * width + least - 1e-9), "{asked}: {star}");
        }
        let (count, height) = (stars.len(), mm("object_height").unwrap_or(width));
        let tall = f64::from(u32::try_from(count).expect("few")) * mm("pitch").expect("a pitch") + 5.0;
        assert!(count == 1 || tall <= height + 1e-9, "{asked}: {count} stars, {tall} mm");
        stacks += usize::from(count > 1);
    }
    assert!(granted >= 10 && stacks >= 1, "{granted} granted, {stacks} stacks");
}

#[test]
fn the_thickness_of_which_tubes_are_known_is_the_one_that_is_named() {
    let dir = folder();
    let asked = |thickness: &str, poisson: f64| {
        let fabric = format!(
            "schema = 1\nname = \"f\"\n[fabric]\nthickness = \"{thickness}\"\npoisson_ratio = {poisson}\n[star]\npoints = 5\n\
             inner_radius = \"50 mm\"\ntube_width = \"20 mm\"\ntip_angle = \"30 deg\"\n"
        );
        fs::write(dir.path().join("fabric.toml"), fabric).expect("written");
        let args = ["new", "wish.toml", "--object", "50 mm", "--mass", "1 g", "--fabric", "fabric.toml"];
        text(&run(dir.path(), &args).stderr)
    };
    for poisson in [0.1, 0.39] {
        let said = asked("0.05 mm", poisson);
        let (_, ends) = said.split_once("it must be ").expect("a remedy");
        let mut numbers = ends.split(' ').filter_map(|word| word.parse::<f64>().ok());
        let [least, most] = [(); 2].map(|()| numbers.next().expect("two ends"));
        for (thickness, known) in
            [(0.999 * least, false), (1.001 * least, true), (0.999 * most, true), (1.001 * most, false)]
        {
            let said = asked(&format!("{thickness:.6} mm"), poisson);
            assert_eq!(said.contains("makes no tube"), !known, "{thickness} {poisson}: {said}");
        }
    }
}
