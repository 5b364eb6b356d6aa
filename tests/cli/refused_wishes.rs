//! Requests that no gripper meets: the reason, and ways out that work.

use crate::choosing::{can_be_had, folder, headings, run, text};
use serde_json::Value;
use std::fs;

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
