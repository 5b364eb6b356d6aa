//! From an object to a gripper: every request gives a spec that builds and holds it, or a refusal with the nearest possible request.

use crate::support::dice::Dice;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stargrip-cam")).current_dir(dir).args(args).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn folder() -> tempfile::TempDir {
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
fn headings(said: &str) -> impl Iterator<Item = (&str, &str)> {
    said.lines().filter(|line| line.starts_with("a request ")).filter_map(|line| line.split_once(" be met: "))
}

/// Asserts that each command that `said` offers gives a gripper which holds as its heading tells, and that there is one; the spec of the first
/// one is left in `dir`.
fn can_be_had(dir: &Path, said: &str, asked: &str) {
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

#[test]
fn a_wish_that_cannot_be_is_told_by_its_reason() {
    let refused = |more: &[&str], why: &str| {
        let dir = folder();
        let output = run(dir.path(), &[&["new", "wish", "--object", "70 mm", "--mass"], more].concat());
        let said = text(&output.stderr);
        assert!(output.status.code() == Some(1) && said.contains(why), "{why}: {said}");
        if !said.contains("not a machine profile") {
            can_be_had(dir.path(), &said, why);
        }
    };
    refused(&["1000 kg"], "it can safely carry");
    refused(&["1 kg", "--sheet", "90x90"], "the star needs a sheet of ");
    refused(
        &["1 kg", "--pressure", "500 kPa"],
        "is in the range in which shells were computed; the nearest pressure is ",
    );
    refused(&["1 kg", "--machine", "loom"], "not a machine profile");
    refused(
        &["1 kg", "--machine", "Ender-3"],
        "not a machine profile, and not a file; it usually has Marlin: --machine ender",
    );
    for wrong in [
        &["--mass", "1 kg"][..],
        &["--object", "7 mm"],
        &["--sheet", "4x4"],
        &["--object", "x", "--mass", "1 kg"],
        &["--object", "-75 mm", "--mass", "1 kg"],
        &["--object", "75 mm", "--mass", "1 kg", "--friction", "50%"],
    ] {
        let output = run(folder().path(), &[&["new", "wish"], wrong].concat());
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
    }
    let help = text(&run(folder().path(), &["new", "--help"]).stdout);
    assert!(help.contains("required with --object"), "{help}");
    // An option that a drawing excludes is named, and not what it would need without a drawing.
    for (option, value) in [
        ("--object", "70 mm"),
        ("--height", "70 mm"),
        ("--shape", "ball"),
        ("--mass", "1 kg"),
        ("--pressure", "30 kPa"),
        ("--friction", "0.3"),
        ("--fragile", "20 N"),
        ("--machine", "grbl"),
        ("--sheet", "A4"),
    ] {
        let said = text(&run(folder().path(), &["new", "wish", "--drawing", "a.svg", option, value]).stderr);
        assert!(said.contains("cannot be used with") && said.contains(option), "{option}: {said}");
    }
}

/// The proposal keeps the object's largest force, or its mass. The flap counts, so that coated corners do not hold 20 g with 1 N.
#[test]
fn the_closest_request_keeps_what_was_asked() {
    for (args, kept) in [
        (["65 mm", "150 g", "0.1 N"], [" --mass \"150 g\"", " --fragile \""]),
        (["30 mm", "20 g", "1 N"], [" --fragile \"1 N\"", " --mass \"20 g\""]),
        (["9 mm", "1 g", "0.3 N"], [" --mass \"1 g\"", " --fragile \""]),
    ] {
        let dir = folder();
        let [object, mass, fragile] = args;
        let args = ["new", "wish", "--object", object, "--mass", mass, "--fragile", fragile];
        let said = text(&run(dir.path(), &args).stderr);
        assert!(kept.iter().all(|kept| said.contains(kept)), "{said}");
        can_be_had(dir.path(), &said, &args.join(" "));
    }
    let wish = ["new", "wish", "--object", "65 mm", "--mass", "150 g", "--fragile", "0.1 N", "--json"];
    let value: Value = serde_json::from_slice(&run(folder().path(), &wish).stdout).expect("JSON");
    let refused = &value["refused"][0];
    assert_eq!(refused["code"], "infeasible");
    assert!(refused["remedy"].as_str().is_some_and(|text| text.contains("stargrip-cam new")), "{refused}");
}

/// Refused requests: their reason, and the ways out that are offered. Objects of a size for which there is no gripper keep it.
#[test]
fn the_reason_binds_and_every_way_out_works() {
    for (request, reason, ways) in [
        // Less mass, or friction.
        (
            "--object 8mm --height 80mm --shape cylinder --mass 180g",
            "it can safely carry ",
            &["friction ", "a mass of "][..],
        ),
        ("--object 12mm --height 100mm --shape cylinder --mass 5kg", "it can safely carry ", &["a mass of "]),
        // Of the object's size, even without a mass.
        ("--object 340mm --mass 0.5kg --friction 1", "the largest is about 3", &["an object 3"]),
        ("--object 600mm --mass 9kg --height 200mm --shape cylinder", "the largest is about 3", &[]),
        ("--object 3mm --mass 1g", "the smallest is about ", &[]),
        // A machine has no option that makes it larger, and an object does not shrink.
        ("--object 150mm --mass 1kg --machine small.toml", "the star needs a bed of ", &[]),
        (
            "--object 66mm --mass 350g --friction 1 --sheet 300x120",
            "the star needs a sheet of ",
            &["a sheet of "],
        ),
        (
            "--object 76.2mm --mass 170g --fragile 0.1N",
            "the object bears 0.1 N of each star",
            &["an object that bears "],
        ),
        // The flap presses harder than the tube: the force that is offered counts it.
        (
            "--object 9mm --shape cylinder --mass 5g --fragile 0.31N",
            "the gentlest star that can safely carry 5 g is for an object that bears ",
            &["an object that bears "],
        ),
        (
            "--object 6mm --shape cylinder --mass 5g --fragile 1N --friction 0.36",
            ": this one bears 1 N",
            &["an object that bears "],
        ),
        // A force and a sheet, each with a number.
        (
            "--object 270mm --mass 1.3kg --height 260mm --shape ball --fragile 1.9N --sheet 600x400",
            "the star needs a sheet of ",
            &["a sheet of "],
        ),
        // The least mass is that under all conditions, also those that are met.
        ("--object 14mm --height 2.7mm --mass 290g --fragile 20N", "it can safely carry ", &["a mass of "]),
        // A ball that is lower than the lowest star: every way out needs it lifted.
        (
            "--object 20mm --mass 8g --fragile 2N",
            "it can safely carry ",
            &["friction ", "an object that bears ", "a mass of "],
        ),
        // The gentlest star is that for the object's mass, on a sheet of any size.
        (
            "--object 12mm --height 35mm --shape cylinder --mass 6g --fragile 1N --sheet A5",
            "the gentlest star that can safely carry 6 g is for an object that bears 2.1 N: this one bears 1 N",
            &["a sheet of "],
        ),
        // Two reasons, and one way out of both.
        ("--object 66mm --mass 35kg --sheet 90x90", "the star needs a sheet of ", &["a sheet of "]),
    ] {
        let dir = folder();
        let unlimited = "x = \"unknown\"\ny = \"unknown\"";
        let small = text(&run(dir.path(), &["machines", "show", "marlin"]).stdout)
            .replace(unlimited, "x = \"235 mm\"\ny = \"235 mm\"");
        fs::write(dir.path().join("small.toml"), small).expect("written");
        let args: Vec<&str> = ["new", "wish"].into_iter().chain(request.split(' ')).collect();
        let output = run(dir.path(), &args);
        let refusal = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{request}: {refusal}");
        assert!(refusal.contains(reason), "{request}: {refusal}");
        assert_offers(request, &refusal, ways);
        if !ways.is_empty() {
            can_be_had(dir.path(), &refusal, request);
        }
    }
}

/// Asserts that `refusal` offers `ways`, each with a number, and that the mass which can be carried is the one that is offered.
fn assert_offers(request: &str, refusal: &str, ways: &[&str]) {
    let offers: Vec<&str> = headings(refusal).map(|(_, changes)| changes).collect();
    assert_eq!(offers.len(), ways.len(), "{request}: {refusal}");
    for (offer, way) in offers.iter().zip(ways) {
        assert!(offer.starts_with(way) && !offer.contains("any "), "{request}: {refusal}");
    }
    let carried = refusal.split("it can safely carry ").nth(1).and_then(|rest| rest.split(" of the ").next());
    let eased = offers.iter().find_map(|offer| offer.strip_prefix("a mass of "));
    if let Some((carried, eased)) = carried.zip(eased) {
        assert_eq!(carried, eased, "{request}: {refusal}");
    }
}

/// A way out that is far from the request is not called near it, whatever it changes.
#[test]
fn only_what_differs_by_a_tenth_is_near() {
    for (request, is_near) in [
        ("--object 76.2mm --mass 170g --fragile 0.1N", false),
        ("--object 12mm --height 100mm --shape cylinder --mass 5kg", false),
        ("--object 66mm --mass 35kg --sheet 90x90", false),
        ("--object 340mm --mass 0.5kg --friction 1", true),
        ("--object 20mm --mass 8g --fragile 2N", true),
    ] {
        let args: Vec<&str> = ["new", "wish"].into_iter().chain(request.split(' ')).collect();
        let refusal = text(&run(folder().path(), &args).stderr);
        let distance = if is_near { "a request near it " } else { "a request farther away " };
        assert!(headings(&refusal).count() > 0, "{refusal}");
        assert!(headings(&refusal).all(|(heading, _)| heading.starts_with(distance)), "{request}: {refusal}");
    }
}

/// Units are those of the request, in the spec and in what is offered.
#[test]
fn units_are_kept() {
    let dir = folder();
    let wish =
        ["new", "wish", "--object", "3 in", "--mass", "6 oz", "--pressure", "7 psi", "--fragile", "9000 mN"];
    let output = run(dir.path(), &[&wish[..], &["--friction", "0.6"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("; 7 psi; "), "{}", text(&output.stdout));
    let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
    for value in ["\"3 in\"", "\"6 oz\"", "\"7 psi\"", "\"9000 mN\""] {
        assert!(spec.contains(value), "{value}: {spec}");
    }
    let verdict = text(&run(dir.path(), &["check", "wish.toml"]).stdout);
    assert!(verdict.contains(" at 48.3 kPa"), "{verdict}");
    let heavy = ["new", "heavy", "--object", "3 in", "--mass", "600 oz", "--pressure", "7 psi"];
    let said = text(&run(dir.path(), &heavy).stderr);
    assert!(said.contains(" oz of the 600 oz") && said.contains(" oz\" --pressure \"7 psi\""), "{said}");
}

/// `--fabric` takes what `calibrate` prints.
#[test]
fn a_fabric_alone_is_a_fabric() {
    let dir = folder();
    let fabric = "[fabric]\nthickness = \"0.25 mm\"\nseal_strength = \"3 N/mm\"\n";
    let with = |more: &str| {
        fs::write(dir.path().join("fabric.toml"), format!("{fabric}{more}")).expect("written");
        run(dir.path(), &["new", "wish", "--object", "70 mm", "--mass", "300 g", "--fabric", "fabric.toml"])
    };
    let output = with("[seal]\ntemperature = \"190 C\"\n");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
    assert!(
        spec.contains("thickness = \"0.25 mm\"") && spec.contains("seal_strength = \"3 N/mm\""),
        "{spec}"
    );
    let wrong = text(&with("thicknes = \"1 mm\"\n").stderr);
    assert!(wrong.contains("unknown-key") && !wrong.contains("schema"), "{wrong}");
}

/// A default friction is named as an assumption; `check` accepts the spec without warnings; the schema is named.
#[test]
fn the_answer_says_what_was_chosen_and_what_was_assumed() {
    let dir = folder();
    let wish = ["new", "f0.2", "--object", "75 mm", "--mass", "300 g", "--sheet", "A3"];
    let output = run(dir.path(), &wish);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let chosen = said.lines().find(|line| line.starts_with("1 star of ")).expect("a line of the star");
    for words in [
        " points, tube ",
        " mm wide, ",
        " mm of fabric; ",
        " kPa; ",
        " min of sealing; ",
        "friction 0.3 assumed: change `friction` in [load]",
    ] {
        assert!(chosen.contains(words), "{words}: {said}");
    }
    assert!(said.contains("wrote f0.2.toml, and beside it stargrip-cam.schema.json for editors"), "{said}");
    let spec = fs::read_to_string(dir.path().join("f0.2.toml")).expect("written");
    assert!(spec.contains("friction_least = 0.2 ") && spec.contains("friction_most = 0.42 "), "{spec}");
    assert!(spec.contains("friction = 0.3 ") && spec.contains("width = \"420 mm\""), "{spec}");
    // The same friction, if it is given, has no range.
    let given =
        run(dir.path(), &["new", "given", "--object", "75 mm", "--mass", "300 g", "--friction", "0.3"]);
    assert_eq!(given.status.code(), Some(0), "{}", text(&given.stderr));
    assert!(!fs::read_to_string(dir.path().join("given.toml")).expect("written").contains("friction_least"));
    let check = run(dir.path(), &["check", "f0.2.toml"]);
    let answer_text = text(&check.stderr);
    assert!(check.status.code() == Some(0) && !answer_text.contains("warning["), "{answer_text}");
    assert!(!answer_text.contains("may be off by"), "{answer_text}");

    let again = folder();
    let output = run(again.path(), &[&wish[..], &["--friction", "0.5", "--json"]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(
        (&json["chosen"]["friction"], &json["chosen"]["friction_assumed"]),
        (&0.5.into(), &false.into())
    );
    assert!(json["chosen"]["sealing_time_s"].as_f64() > Some(600.0), "{json}");
    assert!(fs::read_to_string(again.path().join("f0.2.toml")).is_ok_and(|spec| !spec.contains("measured")));
}

/// Coating windows that are shorter than the default are accepted by the spec itself.
#[test]
fn a_spec_that_is_new_is_not_warned_of() {
    for wish in [
        ["--object", "75 mm", "--mass", "1.2 kg", "--friction", "0.5"],
        ["--object", "30 mm", "--mass", "20 g", "--machine", "marlin"],
        ["--object", "16 mm", "--mass", "30 g", "--machine", "grbl"],
    ] {
        let dir = folder();
        let output = run(dir.path(), &[&["new", "wish"], &wish[..]].concat());
        assert_eq!(output.status.code(), Some(0), "{wish:?}: {}", text(&output.stderr));
        let answer_text = text(&run(dir.path(), &["check", "wish.toml"]).stderr);
        assert!(!answer_text.contains("warning["), "{wish:?}: {answer_text}");
    }
}

#[test]
fn what_has_another_unit_in_mind_is_asked() {
    for size in ["0.1 mm", "75 m"] {
        let dir = folder();
        let output = run(dir.path(), &["new", "wish", "--object", size, "--mass", "1 kg"]);
        let answer_text = text(&output.stderr);
        assert!(
            output.status.code() == Some(1) && answer_text.contains("is the unit right"),
            "{size}: {answer_text}"
        );
        // The pressure was free, so it is not the cause.
        assert!(!answer_text.contains("another pressure"), "{size}: {answer_text}");
    }
}

/// A search keeps the user's comments; comments with computed values are renewed or removed.
#[test]
fn no_comment_is_about_values_that_were_replaced() {
    let dir = folder();
    let wish = ["new", "wish", "--object", "75 mm", "--mass", "300 g"];
    assert_eq!(run(dir.path(), &wish).status.code(), Some(0));
    let path = dir.path().join("wish.toml");
    let spec = fs::read_to_string(&path).expect("written");
    let points = spec.lines().find(|line| line.starts_with("points = ")).expect("points");
    let number: u32 = points.split(' ').nth(2).and_then(|word| word.parse().ok()).expect("a number");
    let commented = |line: &str| match line.split_once(" = ") {
        Some(("tip_angle", _)) => line.split('#').next().unwrap_or_default().to_owned() + "# steep",
        Some(("tube_width", _)) => line.split('#').next().unwrap_or_default().trim_end().to_owned(),
        _ => line.to_owned(),
    };
    let own =
        spec.lines().map(commented).collect::<Vec<_>>().join("\n") + "\n[seal]\nband = \"2 mm\"  # mine\n";
    fs::write(&path, own).expect("written");
    let other = if number == 5 { "6" } else { "5" };
    let output = run(dir.path(), &["optimize", "wish.toml", "--points", other, "-q"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let found = text(&output.stdout);
    assert!(found.contains(&format!("# was {number}\n")) && found.contains("# mine"), "{found}");
    // A comment of the user stays before the old value; without one the old value is written, too.
    assert!(found.contains("# steep; was ") && found.contains(" mm\"  # was "), "{found}");
    for stale in
        ["least fabric (", "closes to", "presses with", "safe payload", "Designed for", "opens to", "t/W is"]
    {
        assert!(spec.contains(stale) && !found.contains(stale), "{stale}: {found}");
    }
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
