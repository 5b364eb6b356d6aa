//! Every dialect: built, proven, refused with numbers, chopped.

use stargrip_cam::pipeline::read_back;

use stargrip_cam::spec::DialectFamily;

use crate::{
    PROFILES, built, dialect, has_floor, has_modal_travel, is_printer, profile, spec_text, text, try_built,
};

const CHOP: &str = "[machine]\nfeed_floor = \"chop\"\n";

#[test]
fn every_dialect_writes_what_its_controller_reads() {
    for name in PROFILES {
        let can = !has_floor(name);
        let build = built(&spec_text(if can { "" } else { CHOP }), profile(name));
        let proof = read_back(&build.output_files());
        assert_eq!(proof.findings, [], "{name}");
        let code = text(&build, "star-1-seal.gcode");
        assert_eq!(code.contains("\nG4 P"), !can, "{name}");
        let chords = !crate::machine(profile(name)).controller.arcs;
        assert_eq!(code.contains("\nG3 ") || code.contains("\nG2 "), !chords, "{name}");
        assert!(code.contains("; progress: percent=50 remaining_s="), "{name}");
        assert_eq!(code.contains("\nM73 P50"), is_printer(name));
    }
}

/// Some controllers read G91.1 as G91, and then every position as a displacement.
#[test]
fn the_plain_subset_has_no_arcs_and_nothing_that_may_be_read_as_relative() {
    let build = built(&spec_text(""), profile("generic"));
    for file in ["star-1-seal.gcode", "star-1-trace.gcode"] {
        let code = text(&build, file);
        for word in ["G2 ", "G3 ", "G91", " I", " J"] {
            assert!(!code.lines().any(|line| line.starts_with('G') && line.contains(word)), "{file}: {word}");
        }
        assert!(file != "star-1-seal.gcode" || code.contains("\n; requires: M0 must stop the machine"));
    }
    let code = text(&build, "star-1-seal.gcode");
    let line = code.lines().position(|line| line == "G90").expect("absolute") + 1;
    let found = crate::findings_with(&build, "star-1-seal.gcode", &code.replacen("G90\n", "G91.1\n", 1));
    assert!(found.iter().any(|f| (f.code, f.line) == ("unknown-word", Some(line))), "{found:?}");
    // A profile of the user's own may state that its controller draws arcs.
    let arcs =
        profile("generic").replace("arcs = false", "arcs = true").replace("\"G90\"", "\"G91.1\", \"G90\"");
    let own = built(&spec_text(""), &arcs);
    assert_eq!(read_back(&own.output_files()).findings, []);
    assert!(text(&own, "star-1-seal.gcode").contains("\nG3 "));
    let tables = PROFILES.map(|name| (name, crate::machine(profile(name)).script.start));
    for (name, start) in tables {
        let at = |word: &str| start.iter().position(|line| line == word);
        let family = dialect(name).family() == DialectFamily::Mill;
        assert_eq!(at("G91.1").is_some(), family, "{name}");
        assert!(at("G91.1") < at("G90"), "{name}");
    }
}

/// The picture shows the design: chords of a machine that draws no arcs would make it four times as large.
#[test]
fn the_preview_does_not_grow_where_arcs_are_cut() {
    let preview = |name| text(&built(&spec_text(""), profile(name)), "sheet-1-preview.svg");
    let (cut, drawn) = (preview("generic"), preview("linuxcnc"));
    assert!(cut.len().abs_diff(drawn.len()) < 100, "{} and {} bytes", cut.len(), drawn.len());
    assert_eq!(cut.matches(" A").count(), drawn.matches(" A").count());
    assert!(cut.matches(" A").count() > 20, "{cut}");
}

#[test]
fn a_reversed_arc_is_found_at_its_line() {
    let build = built(&spec_text(""), profile("linuxcnc"));
    let code = text(&build, "star-1-seal.gcode");
    let line = code.lines().position(|line| line.starts_with("G3 ")).expect("an arc") + 1;
    let found = crate::findings_with(&build, "star-1-seal.gcode", &code.replacen("\nG3 ", "\nG2 ", 1));
    assert!(found.iter().any(|f| (f.code, f.line) == ("deviation", Some(line))), "{found:?}");
}

/// Conditions that a printer does not report itself: unhomed, or with Z 0 as its lowest, it stops or presses nothing after heating.
#[test]
fn printers_say_what_has_to_be_true() {
    for name in crate::profiles_of(DialectFamily::Printer) {
        let pause = format!("{} ", crate::machine(profile(name)).script.pause);
        let rest = if has_floor(name) { CHOP } else { "" };
        let build = built(&spec_text(rest), profile(name));
        let code = text(&build, "star-1-seal.gcode");
        let requires: Vec<&str> = code.lines().filter_map(|line| line.strip_prefix("; requires: ")).collect();
        for needed in ["homed", "Z 0 set on the release layer", pause.as_str()] {
            assert!(requires.iter().any(|line| line.contains(needed)), "{name}: {needed}: {requires:?}");
        }
        let lowest = |line: &&str| ["position_min", "M211", "M564"].iter().any(|word| line.contains(word));
        assert!(requires.iter().any(lowest), "{name}: {requires:?}");
        for line in crate::machine(profile(name)).script.requires {
            assert!(requires.contains(&line.as_str()), "{name}: {line:?} is cut or changed");
        }
    }
}

/// Klipper, Marlin and RepRapFirmware run G0 at the feed in force: without an F a travel would run at the seal's speed. The controller of a
/// generic program is unknown.
#[test]
fn travels_of_printers_carry_their_feed_and_seals_their_own_after_it() {
    for name in PROFILES {
        let printer = has_modal_travel(name);
        let rest = if has_floor(name) { CHOP } else { "" };
        let build = built(&spec_text(rest), profile(name));
        for file in ["star-1-seal.gcode", "star-1-trace.gcode"] {
            let code = text(&build, file);
            let mut after_travel = false;
            for line in code.lines().filter(|line| line.starts_with("G0") || line.starts_with("G1")) {
                let travel = line.starts_with("G0");
                assert!(!travel || line.ends_with(" F1200") == printer, "{name}: {line}");
                assert!(!printer || !after_travel || line.contains(" F"), "{name}: {line}");
                after_travel = travel;
            }
        }
        // One travel without its F is found at its line.
        let code = text(&build, "star-1-seal.gcode");
        let (line, crawl) =
            code.lines().enumerate().filter(|(_, l)| l.starts_with("G0 X")).nth(1).expect("two");
        let slow = code.replacen(crawl, crawl.trim_end_matches(" F1200"), 1);
        let found = crate::findings_with(&build, "star-1-seal.gcode", &slow);
        let expected = printer.then_some(("travel-feed", Some(line + 1)));
        assert_eq!(found.first().map(|f| (f.code, f.line)), expected, "{name}: {found:?}");
        // Another speed of the first travels is found as well; no earlier line sets their start.
        for (line, first) in code.lines().enumerate().filter(|(_, l)| l.starts_with("G0")).take(2) {
            let fast = code.replacen(first, &first.replace(" F1200", " F12000"), 1);
            let found = crate::findings_with(&build, "star-1-seal.gcode", &fast);
            let expected = printer.then_some(("travel-feed", Some(line + 1)));
            assert_eq!(found.first().map(|f| (f.code, f.line)), expected, "{name}: {found:?}");
        }
    }
}

#[test]
fn below_the_lowest_feed_the_numbers_are_told() {
    let refusals = try_built(&spec_text(""), profile("grbl")).map(|_| ()).expect_err("too slow for GRBL");
    let [refusal] = &refusals[..] else { panic!("{refusals:?}") };
    assert_eq!(refusal.code, "feed-floor");
    assert_eq!(refusal.found, "at 80 steps/mm GRBL runs this at 0.38 to 0.54 mm/s instead of 0.1");
    assert!(refusal.remedy.contains("feed_floor = \"chop\"") && refusal.remedy.contains("at least 432"));
    // A machine with enough steps needs no strokes.
    let fine = profile("grbl").replace("y_steps_per_mm = 80", "y_steps_per_mm = 440");
    let fine = fine.replace("x_steps_per_mm = 80", "x_steps_per_mm = 440");
    assert!(!text(&built(&spec_text(CHOP), &fine), "star-1-seal.gcode").contains("G4"));
    assert!(try_built(&spec_text("[seal]\nspeed = \"0.6 mm/s\"\n"), profile("grbl")).is_ok());
}

/// The controller's lowest speed is so near the seal's that a stroke leaves hardly any time for a dwell.
#[test]
fn strokes_just_below_the_floor_keep_their_mean_speed() {
    for (name, speed) in [("grbl", 0.5), ("grbl", 0.2), ("fluidnc", 0.6), ("marlin", 0.5), ("grblhal", 0.15)]
    {
        let rest = format!("[seal]\nspeed = \"{speed} mm/s\"\n{CHOP}");
        let build = built(&spec_text(&rest), profile(name));
        assert_eq!(read_back(&build.output_files()).findings, [], "{name}");
        let code = text(&build, "star-1-seal.gcode");
        // One dwell is longer than programmed.
        let from = code.find("; seam:").expect("a seam");
        let (at, dwell) = code[from..].match_indices("\nG4 ").nth(40).expect("dwells");
        let line = code[..from + at].lines().count() + 1;
        let end = from + at + 1 + code[from + at + 1..].find('\n').expect("a line end");
        let long = if name == "marlin" { "P900" } else { "P9" };
        let slow = format!("{}{dwell}{long}{}", &code[..from + at], &code[end..]);
        let found = crate::findings_with(&build, "star-1-seal.gcode", &slow);
        assert!(found.iter().any(|f| f.code == "wrong-feed" || f.code == "iron-at-rest"), "{name} {line}");
    }
    // A speed at which a stroke of half a band leaves no time for a dwell is refused with the number.
    let chop_feed = "acceleration = \"10 mm/s^2\"\nchop_feed = \"36 mm/min\"";
    let own = profile("grbl").replace("acceleration = \"10 mm/s^2\"", chop_feed);
    let fast = spec_text(&format!("[seal]\nspeed = \"0.5 mm/s\"\nband = \"0.6 mm\"\n{CHOP}"));
    let refusals = try_built(&fast, &own).map(|_| ()).expect_err("no time for a dwell");
    assert_eq!(refusals[0].code, "no-chop");
    let limit =
        refusals[0].remedy.split(' ').rev().nth(1).and_then(|x| x.parse::<f64>().ok()).expect("a speed");
    let fine = fast.replace("0.5 mm/s", &format!("{:.3} mm/s", limit - 0.001));
    assert_eq!(read_back(&built(&fine, &own).output_files()).findings, []);
}

/// In Marlin a move that meets an empty queue waits, and so does every move after a dwell.
#[test]
fn the_wait_of_a_start_is_taken_off_the_dwell() {
    let with = text(&built(&spec_text(CHOP), profile("marlin")), "star-1-seal.gcode");
    let none = profile("marlin").replace("start_delay = \"100 ms\"", "start_delay = \"0 s\"");
    let without = text(&built(&spec_text(CHOP), &none), "star-1-seal.gcode");
    // The mean dwell, ms.
    let dwell = |code: &str| {
        let times = code.lines().filter_map(|line| line.strip_prefix("G4 P")?.parse::<f64>().ok());
        let (sum, count) = times.fold((0.0, 0.0), |(sum, count), ms| (sum + ms, count + 1.0));
        sum / count
    };
    assert!((dwell(&without) - dwell(&with) - 100.0).abs() < 0.5, "{} {}", dwell(&without), dwell(&with));
}

#[test]
fn what_is_unknown_is_not_chopped() {
    let refusals = try_built(&spec_text(CHOP), profile("generic")).map(|_| ()).expect_err("unknown");
    assert_eq!(refusals[0].code, "no-chop");
    assert!(refusals[0].found.contains("no steps per mm and no lowest step rate and no acceleration"));
    let known = profile("generic")
        .replace("acceleration = \"unknown\"", "acceleration = \"50 mm/s^2\"")
        .replace("# chop_feed", "chop_feed");
    let build = built(&spec_text(CHOP), &known);
    assert_eq!(read_back(&build.output_files()).findings, []);
    assert!(text(&build, "star-1-seal.gcode").contains(" F60\nG4 P"));
}

#[test]
fn chopped_programs_keep_their_time_and_say_what_they_need() {
    let steady = built(&spec_text(""), profile("generic"));
    for name in crate::with_floor() {
        let chopped = built(&spec_text(CHOP), profile(name));
        let (a, b) = (&steady.manifest.stars[0], &chopped.manifest.stars[0]);
        assert_eq!((a.seam_mm, a.time_s), (b.seam_mm, b.time_s));
        let code = text(&chopped, "star-1-seal.gcode");
        assert!(code.contains("; chop: feed_mm_min="), "{name}");
        assert!(code.contains("; requires: at least 80 and 80 steps/mm in X and Y"), "{name}");
        if name == "grbl" {
            assert!(code.contains("; requires: $1=255 "));
        }
        let bare = |program: &stargrip_cam::plan::Program| program.time;
        let (t, u) = (bare(&steady.forecast.programs[0]), bare(&chopped.forecast.programs[0]));
        assert!((t - u).abs() < 2e-3 * t, "{name}: {t} {u}");
    }
}

#[test]
fn comments_between_parentheses_are_proven_too() {
    let old = profile("generic").replace("comments = \"semicolon\"", "comments = \"parentheses\"");
    let build = built(&spec_text(""), &old);
    assert_eq!(read_back(&build.output_files()).findings, []);
    assert!(text(&build, "star-1-seal.gcode").starts_with("(stargrip-cam seal program)\n"));
}

#[test]
fn a_clamp_in_the_way_is_refused_and_one_beside_it_is_not() {
    let clamp = |x: u32, y: u32, more: &str| {
        format!(
            "{}\n[[keep_out]]\nname = \"clamp\"\nx = \"{x} mm\"\ny = \"{y} mm\"\nwidth = \"8 mm\"\ndepth = \"8 mm\"\n{more}",
            profile("generic")
        )
    };
    let spec = spec_text("[sheet]\nwidth = \"300 mm\"\nheight = \"300 mm\"\nmargin = \"20 mm\"\n");
    let code = text(&built(&spec, profile("generic")), "star-1-seal.gcode");
    let cut =
        code.lines().find(|line| line.starts_with("G1 X") && line.contains("Z-0.3")).expect("touch-down");
    let at = |letter: char| {
        let word = cut.split(' ').find_map(|word| word.strip_prefix(letter)).expect("a coordinate");
        word.split('.').next().and_then(|whole| whole.parse::<u32>().ok()).expect("a number") - 4
    };
    let (x, y) = (at('X'), at('Y'));
    let refusals = try_built(&spec, &clamp(x, y, "")).map(|_| ()).expect_err("in the way");
    assert_eq!(refusals[0].code, "clamp-in-the-way");
    let free = built(&spec, &clamp(280, 280, ""));
    assert_eq!(read_back(&free.output_files()).findings, []);
    // The seal's file against a profile with a clamp on it.
    let mut archive = free.output_files();
    for (name, bytes) in &mut archive.files {
        if name == "machine.toml" {
            *bytes = clamp(x, y, "").into_bytes().into();
        }
    }
    assert!(read_back(&archive).findings.iter().any(|f| f.code == "clamp-in-the-way"));
}

#[test]
fn the_feed_check_takes_as_long_as_it_says_in_every_dialect() {
    use stargrip_cam::verify::gcode::{Dialect, Event, Interpreter, MoveKind};
    use stargrip_cam::verify::stroke_seconds;
    for name in PROFILES {
        let chop = crate::has_floor(name);
        let spec = crate::spec(&spec_text(if chop { CHOP } else { "" }));
        let machine = crate::machine(profile(name));
        let code = stargrip_cam::emit::feed_check(
            &spec,
            &machine,
            &stargrip_cam::plan::feed_checks(&spec, &machine),
        );
        let mut interpreter = Interpreter::new(Dialect::for_controller(&machine.controller));
        let mut events = Vec::new();
        for line in code.split_inclusive('\n') {
            interpreter.feed(line, &mut events);
        }
        interpreter.finish(&mut events);
        // The time between the pauses, as on a watch.
        let (mut watch, mut pauses) = (Vec::new(), 0);
        for event in events {
            match event {
                Event::Finding(finding) => panic!("{name}: {finding}"),
                Event::Pause(_) => {
                    pauses += 1;
                    watch.push(0.0);
                }
                Event::Dwell(dwell) => *watch.last_mut().expect("a pause first") += dwell.seconds,
                Event::Move(step) => {
                    if let (Some(feed), Some(last)) = (step.feed, watch.last_mut()) {
                        let [from, to] = [step.from, step.to].map(|at| [at.x, at.y, at.z]);
                        let stroke = chop && step.kind == MoveKind::Feed;
                        *last += if stroke {
                            stroke_seconds(&machine.motion, from, to, feed / 60.0)
                        } else {
                            step.length() / feed * 60.0
                        };
                    }
                }
                _ => {}
            }
        }
        // Three lines, and with arcs one in either direction.
        assert_eq!(pauses, if machine.controller.arcs { 10 } else { 6 }, "{name}");
        for code_of in ["G2 ", "G3 "] {
            assert_eq!(code.lines().any(|line| line.starts_with(code_of)), machine.controller.arcs, "{name}");
        }
        for seconds in watch.iter().step_by(2) {
            assert!((seconds - 100.0).abs() < 0.2, "{name}: {watch:?}");
        }
    }
}
