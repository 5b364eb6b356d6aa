//! Tests of edits.

use proptest::prelude::*;

use super::*;

const TEXT: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 5   # n\ninner_radius = \"50 mm\"\n\
                    tube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n\n# the end\n[stack]\ncount = 2\n";

#[test]
fn a_section_goes_with_its_last_key() {
    let text = "name = \"a\"\n[mask]\nkind = \"separator\"\n[load]\npressure = \"5 kPa\"\nmass = \"1 kg\"\n";
    let keys = [(key::mask::KIND, None), (key::load::PRESSURE, None)];
    let rest = super::edited(&Source::new("x", text), &keys).expect("TOML");
    assert_eq!(rest, "name = \"a\"\n[load]\nmass = \"1 kg\"\n");
}

#[test]
fn processes_are_changed_and_added_in_their_sections() {
    let process = |text: &str, name: &str, key: KeyPath, value: Option<&str>| {
        with_process(&Source::new("x", text), name, key, value).expect("TOML")
    };
    let (speed, passes) = (key::process::SPEED, key::process::PASSES);
    let added = process(TEXT, "weak", speed, Some("\"0.2 mm/s\""));
    assert!(added.starts_with(TEXT) && added.ends_with("[process.weak]\nspeed = \"0.2 mm/s\"\n"), "{added}");
    let extended = process(&added, "weak", passes, Some("2"));
    assert!(extended.ends_with("speed = \"0.2 mm/s\"\npasses = 2\n"), "{extended}");
    assert_eq!(process(&extended, "weak", passes, None), added);
    assert!(process(&added, "weak", speed, None).ends_with("[process.weak]\n"), "seams may name it");
    let inline = process("process = { weak = { passes = 1 } }\n", "weak", passes, Some("3"));
    assert_eq!(inline, "process = { weak = { passes = 3 } }\n");
    assert!(with_process(&Source::new("x", "process = 1\n"), "weak", passes, Some("3")).is_err());
    assert!(with_process(&Source::new("x", "process.weak = 1\n"), "weak", passes, Some("3")).is_err());
    assert!(with_process(&Source::new("x", TEXT), "weak", passes, Some("= 3")).is_err());
}

#[test]
fn single_values_are_set_wherever_they_stand() {
    let source = |text: &str| Source::new("x", text);
    let larger = with_value(&source(TEXT), key::stack::COUNT, "4").expect("a count");
    assert!(larger.contains("count = 4\n") && larger.contains("# the end"), "{larger}");
    let load = with_value(&source(TEXT), key::load::PRESSURE, "\"20 kPa\"").expect("a pressure");
    let loaded = read(&source(&load)).expect("valid").spec;
    assert_eq!(loaded.load.and_then(|load| load.pressure).map(|p| p.0), Some(20.0));
    let dotted = TEXT.replace("[stack]\ncount = 2\n", "").replace("[star]", "stack.count = 2\n[star]");
    assert!(
        with_value(&source(&dotted), key::stack::COUNT, "3").expect("a count").contains("stack.count = 3")
    );
    assert!(with_value(&source(TEXT), key::stack::COUNT, "0").is_err());
    assert!(with_value(&source(TEXT), key::stack::COUNT, "= 0").is_err());
}

#[test]
fn comments_behind_values_are_renewed_or_dropped() {
    let source = Source::new(
        "x",
        TEXT.replace("\"50 mm\"", "\"50 mm\"   # old").replace("count = 2", "count = 2 # kept"),
    );
    let renewed = |section: &str, key: &str, comment: &str| match (section, key) {
        ("star", "points" | "tube_width") => "was 4".to_owned(),
        ("star", _) => String::new(),
        _ => comment.to_owned(),
    };
    let text = with_comments(&source, renewed).expect("TOML");
    assert!(text.contains("points = 5   # was 4\n"), "{text}");
    assert!(text.contains("tube_width = \"30 mm\"  # was 4\n"), "{text}");
    assert!(text.contains("inner_radius = \"50 mm\"\n") && text.contains("count = 2 # kept\n"), "{text}");
    assert!(text.contains("# the end\n"), "{text}");
}

/// One star in every layout that TOML has for it.
const LAYOUTS: [&str; 9] = [
    TEXT,
    "schema = 1\nname = \"x\"\n[ star ]  # spaced\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"3 cm\"\ntip_angle = \"30 deg\"",
    "schema = 1\nname = \"x\"\nstar.points = 5\nstar.inner_radius = \"50 mm\"\nstar.tube_width = \"30 mm\" # W\nstar.tip_angle = \"30 deg\"\n[stack]\ncount = 2\n",
    "schema = 1\nname = \"x\"\nstar = { points = 5, inner_radius = \"50 mm\", tube_width = \"30 mm\", tip_angle = \"30 deg\" }\n",
    "schema = 1\nname = \"x\"\nstar = { points = 5, inner_radius = \"50 mm\", # hole\n  tube_width = \"30 mm\",\n  tip_angle = \"30 deg\", # sharp\n}\n[seal]\n",
    "schema = 1\nname = \"x\"\n[\"star\"]\n\"points\" = 5\n'inner_radius' = '50 mm'\n\"tube_width\" = '''30 mm'''\ntip_angle = \"30 deg\"\n",
    "schema = 1\nname = \"x\"\n\"star\".'points' = 5\nstar . inner_radius = \"50 mm\"\nstar.tube_width = \"30 mm\"\nstar.tip_angle = \"30 deg\"\n",
    "schema = 1\r\nname = \"x\"\r\n[stack]\r\ncount = 2\r\n\r\n[star] # last\r\npoints = 5\r\ninner_radius = \"50 mm\"\r\ntube_width = \"30 mm\"\r\ntip_angle = \"30 deg\"\r\n# end\r\n",
    "\u{feff}schema = 1\nname = \"x\"\n[star]\n    points    =   5\n    inner_radius = \"50 mm\"\n    tube_width   = \"30 mm\"    # W = 1\n    tip_angle = \"30 deg\"\n    tip_radius = \"1 mm\"\n    corner_radius = \"1 mm\"\n[[stack.star]]\nindex = 1\nrotation = \"45 deg\"\n",
];

const EDIT: StarEdit = StarEdit {
    points: 4,
    tube_width: Length(28.125),
    tip_angle: Angle(31.5),
    tip_radius: Length(2.0),
    corner_radius: Length(0.0),
};

fn edited(text: &str, star: &StarEdit) -> String {
    with_star(&Source::new("x.toml", text), star).unwrap_or_else(|faults| panic!("{text}\n{faults}"))
}

#[test]
fn values_are_replaced_or_added_and_the_rest_stays() {
    let expected = TEXT
        .replace("points = 5 ", "points = 4 ")
        .replace("30 mm", "28.125 mm")
        .replace("\"30 deg\"\n", "\"31.5 deg\"\ntip_radius = \"2 mm\"\ncorner_radius = \"0 mm\"\n");
    assert_eq!(edited(TEXT, &EDIT), expected);
}

#[test]
fn several_values_are_judged_together_and_a_key_without_one_gets_its_default() {
    let source = Source::new("x", format!("{TEXT}[inlet]\ntip = 5\nlength = \"9 mm\"\n"));
    let four = (key::star::POINTS, Some("4"));
    assert!(with_changes(&source, &[four]).is_err(), "four points have no tip 5");
    let changes =
        [four, (key::inlet::TIP, Some("4")), (key::inlet::LENGTH, None), (key::root::NAME, Some("\"y\""))];
    let text = with_changes(&source, &changes).expect("valid together");
    assert!(text.starts_with("schema = 1\nname = \"y\"\n"), "{text}");
    let spec = read(&Source::new("back", text)).expect("valid").spec;
    assert_eq!((spec.stars[0].points, spec.inlet.map(|inlet| inlet.length)), (4, Some(Length(20.0))));
    let untouched = with_changes(&source, &[(key::load::MASS, None)]).expect("was not there");
    assert_eq!(untouched, source.text);
}

#[test]
fn every_layout_keeps_its_form_and_its_comments() {
    let texts = LAYOUTS.map(|text| edited(text, &EDIT));
    for (text, kept) in texts.iter().zip([
        "points = 4   # n\n",
        "[ star ]  # spaced\npoints = 4\n",
        "star.tube_width = \"28.125 mm\" # W\nstar.tip_angle = \"31.5 deg\"\nstar.tip_radius = \"2 mm\"\n",
        "tube_width = \"28.125 mm\", tip_angle = \"31.5 deg\", tip_radius = \"2 mm\", corner_radius = \"0 mm\" }\n",
        "inner_radius = \"50 mm\", # hole\n  tube_width = \"28.125 mm\",\n",
        "[\"star\"]\n\"points\" = 4\n'inner_radius' = '50 mm'\n",
        "\"star\".'points' = 4\n\"star\". inner_radius = \"50 mm\"\n",
        "# end",
        "    tube_width   = \"28.125 mm\"    # W = 1\n",
    ]) {
        assert!(text.contains(kept) && !text.contains('\r'), "{kept}\n{text}");
    }
}

#[test]
fn a_value_that_a_star_has_of_its_own_is_named() {
    for (index, value, section) in [
        (1, "tube_width = \"25 mm\"", "[star]"),
        (2, "inner_radius = \"55 mm\"", "[star]"),
        (2, "pitch = \"50 mm\"", "[stack]"),
    ] {
        let text = format!("{TEXT}[[stack.star]]\nindex = {index}\n{value}\n");
        let faults = with_star(&Source::new("x.toml", text), &EDIT).expect_err("refused");
        let fault = &faults.list()[0];
        assert_eq!((fault.code, faults.list().len()), ("own-value", 1), "{faults}");
        assert!(fault.message.starts_with(&format!("star {index} has its own")), "{faults}");
        assert!(fault.label.contains(section) && faults.to_string().contains("x.toml:14:"), "{faults}");
    }
    let turned = format!("{TEXT}[[stack.star]]\nindex = 2\nrotation = \"5 deg\"\n");
    let _ = with_star(&Source::new("x.toml", turned), &EDIT).expect("predictions do not depend on it");
}

#[test]
fn what_the_new_values_make_invalid_is_refused() {
    let text = format!("{TEXT}[inlet]\ntip = 5\n");
    let faults = with_star(&Source::new("x.toml", text), &EDIT).expect_err("four points have no tip 5");
    assert!(faults.to_string().contains("x.toml, edited:"), "{faults}");
}

proptest! {
    /// The layouts times the values: the values read are those written.
    #[test]
    fn what_is_set_is_what_is_read(
        layout in 0..LAYOUTS.len(),
        points in 3..=64_u32,
        w in 1e-3..1e5_f64, angle in 1e-9..180.0_f64, r_i in 0.0..1e5_f64, r_e in 0.0..1e5_f64,
    ) {
        let star = StarEdit {
            points, tube_width: Length(w), tip_angle: Angle(angle), tip_radius: Length(r_i), corner_radius: Length(r_e),
        };
        let text = edited(LAYOUTS[layout], &star);
        let spec = read(&Source::new("back", text.as_str())).map_err(|f| TestCaseError::fail(f.to_string()))?.spec;
        prop_assert_eq!(StarEdit::new(&spec.stars[0]), star);
        // With the old values back, the spec is the old one.
        let old = read(&Source::new("old", LAYOUTS[layout])).expect("valid").spec;
        let back = edited(&text, &StarEdit::new(&old.stars[0]));
        prop_assert_eq!(read(&Source::new("x", back)).expect("valid").spec, old);
    }
}
