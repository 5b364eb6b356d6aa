//! Seams of several processes: each is sealed as often as stated, at its own temperature, speed and height, in every dialect, and a
//! program that differs is found.

use stargrip_cam::design::{Refusal, RefusalCode};
use stargrip_cam::pipeline::{Built, read_back};
use stargrip_cam::resume::{ResumeAt, resume};

use crate::clock::judge::TOTAL;
use crate::pouch::{
    Contact, FILE, POUCH, PROCESSES, clocked, clocked_speeds, contacts, pouch, read_pouch, seam_of,
    stated_total, try_drawing, try_pouch,
};
use crate::{PRINTERS, findings_after, has_floor, machine, profile, profiles_of_dialects, read_for, text};

/// The contacts of the seams whose names begin alike.
struct SealedAs {
    seam: &'static str,
    contacts: usize,
    temperature: f64,
    speed: f64,
    height: f64,
}

impl SealedAs {
    fn assert_seals(&self, contact: &Contact, speed: f64, name: &str) {
        let Self { seam, temperature, height, .. } = *self;
        assert!(contact.moves.iter().all(|step| step.heated == Some(temperature)), "{name}: {seam}");
        // A stop at either end takes up to 1.5 % of the shortest, fastest seam.
        assert!((speed / self.speed - 1.0).abs() < 0.02, "{name}: {seam} {speed}");
        assert!((contact.low - height).abs() < 1e-6, "{name}: {seam} {}", contact.low);
    }
}

/// Two lines of 1 mm fill a band of 2 mm, and a hose on either side opens the rim twice.
const EXPECTED: [SealedAs; 3] = [
    SealedAs { seam: "wall", contacts: 2, temperature: 170.0, speed: 1.5, height: -0.1 },
    SealedAs { seam: "spot", contacts: 9, temperature: 185.0, speed: 0.5, height: -0.3 },
    SealedAs { seam: "rim", contacts: 8, temperature: 200.0, speed: 0.5, height: -0.3 },
];

#[test]
fn every_seam_is_sealed_as_its_process_says_on_every_machine() {
    for name in profiles_of_dialects() {
        let built = pouch(PROCESSES, name);
        assert_eq!(read_back(&built.output_files()).findings, [], "{name}");
        let program = read_pouch(&built, name);
        let all = contacts(&program);
        let (stretches, seconds) = clocked(&text(&built, FILE), name);
        let speeds = clocked_speeds(&all, &stretches);
        let total = stated_total(&program);
        // Where the profile states no acceleration, travels count as at speed at once.
        let is_known = machine(profile(name)).motion.acceleration.is_some();
        assert!(!is_known || (seconds / total - 1.0).abs() < TOTAL, "{name}: {seconds} s, stated {total} s");
        let seams: Vec<String> = all.iter().map(|contact| seam_of(&built, contact)).collect();
        for process in EXPECTED {
            let of_seam = |index: &usize| seams[*index].starts_with(process.seam);
            let indices: Vec<usize> = (0..all.len()).filter(of_seam).collect();
            assert_eq!(indices.len(), process.contacts, "{name}: {} of {seams:?}", process.seam);
            for index in indices {
                process.assert_seals(&all[index], speeds[index], name);
            }
        }
        // The coolest first, each temperature once.
        let heats: Vec<f64> = all.iter().filter_map(|contact| contact.moves[0].heated).collect();
        assert!(heats.is_sorted(), "{name}: {heats:?}");
        let count_of = ["cool", "pause"]
            .map(|key| program.comments.iter().filter(|comment| comment.key() == Some(key)).count());
        assert_eq!(count_of, [1, 1], "{name}");
    }
}

/// The lines of a band are apart by at most the tip, end where the band ends, and passes of open ones go there and back.
#[test]
fn lines_fill_the_band_and_passes_go_there_and_back() {
    let built = pouch(PROCESSES, "linuxcnc");
    let program = read_pouch(&built, "linuxcnc");
    let spot: Vec<Contact> =
        contacts(&program).into_iter().filter(|contact| seam_of(&built, contact) == "spot").collect();
    let ends: Vec<[f64; 3]> = spot
        .iter()
        .map(|contact| {
            let run = contact.run();
            let (start, end) = (run.start().expect("a way"), run.end().expect("a way"));
            assert!((start.x - end.x).abs() < 1e-3);
            [start.x, start.y, end.y]
        })
        .collect();
    let mut places: Vec<f64> = ends.iter().map(|[x, ..]| *x).collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| (*a - *b).abs() < 1e-3);
    assert_eq!(places.len(), 3);
    assert!((places[2] - places[0] - 1.0).abs() < 1e-3 && (places[1] - places[0] - 0.5).abs() < 1e-3);
    for passes in ends.chunks(3) {
        assert!((passes[0][1] - passes[1][2]).abs() < 1e-3 && (passes[0][1] - passes[2][1]).abs() < 1e-3);
    }
}

/// Other numbers of passes, lines and speeds, each read back.
#[test]
fn processes_of_many_kinds_are_read_back() {
    let mut built_for_marlin = 0;
    let kinds = ["none", "seam", "piece"]
        .into_iter()
        .flat_map(|pause| profiles_of_dialects().map(move |name| (pause, name)));
    for (index, (pause, name)) in kinds.enumerate() {
        // Nine dialects: each has all pauses, and all counts of passes.
        let (passes, lines) = (1 + (index + index / 9) % 3, 2 + index % 2);
        let (temperature, cool) = (150 + 4 * index, index % 4);
        let copies = if PRINTERS.contains(&name) { 1 } else { 2 };
        let rest = format!(
            "program = \"sheet\"\n[sheet]\ncopies = {copies}\n[drawing.process]\na-1 = [\"tear\"]\nb_2 = [\"seam\"]\n\
             [seal]\nspeed = \"0.4 mm/s\"\ntip = \"1.2 mm\"\nlines = 2\npause = \"{pause}\"\n\
             [process.a-1]\ntemperature = \"{temperature} C\"\npasses = {passes}\ncool = \"{cool} s\"\n\
             [process.b_2]\nspeed = \"{}.5 mm/s\"\nlines = {lines}\noverlap = \"2 mm\"\n",
            1 + index % 2
        );
        match try_pouch(&rest, name) {
            Ok(built) => {
                assert_eq!(read_back(&built.output_files()).findings, [], "{name}: {rest}");
                built_for_marlin += usize::from(name == "marlin");
            }
            // Beside the corners of the pouch Marlin joins moves, which not every speed allows.
            Err(refusals) => assert_eq!(name, "marlin", "{refusals}"),
        }
    }
    assert!(built_for_marlin > 0, "Marlin runs one of them at least");
}

/// The codes of the findings after `change` of the lines of the program of the pouch.
fn codes_after(build: &Built, change: impl FnOnce(&mut Vec<String>)) -> Vec<&'static str> {
    findings_after(build, FILE, change).iter().map(|finding| finding.code).collect()
}

/// Index of the first line that contains `needle`.
fn place_of(lines: &[String], needle: &str) -> usize {
    lines.iter().position(|line| line.contains(needle)).unwrap_or_else(|| panic!("no {needle}"))
}

#[test]
fn a_program_with_another_process_is_found() {
    for name in ["grbl", "marlin", "klipper", "linuxcnc", "bambu"] {
        let build = pouch(PROCESSES, name);
        // Another temperature: that of the operator's comment, or of the controller's word.
        let cooler = codes_after(&build, |lines| {
            for line in lines.iter_mut() {
                *line =
                    line.replace("temperature_C=185", "temperature_C=175").replace("M109 R185", "M109 R175");
                *line = line.replace("M109 S185", "M109 S175").replace("iron to 185 C", "iron to 175 C");
            }
        });
        assert!(cooler.contains(&"cold-seal"), "{name}: {cooler:?}");
        // A missing pass: all lines from the last title to the way home.
        let missing = codes_after(&build, |lines| {
            let from = place_of(lines, "seam: seam=19 ");
            let to = from + place_of(&lines[from..], "G0 Z30");
            let _ = lines.drain(from..to);
        });
        assert!(missing.contains(&"missing-seam"), "{name}: {missing:?}");
        // A missing wait.
        let hasty = codes_after(&build, |lines| {
            let wait = place_of(lines, "cool: time_s=4") + 1;
            let _ = lines.remove(wait);
        });
        assert!(hasty.contains(&"missing-wait"), "{name}: {hasty:?}");
        // A shorter one.
        let short = codes_after(&build, |lines| {
            let wait = place_of(lines, "cool: time_s=4") + 1;
            lines[wait] = if lines[wait].contains("P4000") { "G4 P1000" } else { "G4 P1" }.to_owned();
        });
        assert!(short.contains(&"missing-wait"), "{name}: {short:?}");
        // Swapped processes: the wall at the height of the spot, and at its speed.
        let deep = codes_after(&build, |lines| replace_in_wall(lines, "Z-0.1", "Z-0.3"));
        assert!(deep.contains(&"too-deep"), "{name}: {deep:?}");
        // In strokes the speed is that of their dwells.
        if !has_floor(name) {
            let slow = codes_after(&build, |lines| replace_in_wall(lines, " F90", " F30"));
            assert!(slow.contains(&"wrong-feed"), "{name}: {slow:?}");
        }
    }
}

/// Replaces words of the program's second seam, which is the first of the wall.
fn replace_in_wall(lines: &mut [String], word: &str, replacement: &str) {
    let (start, end) = (place_of(lines, "seam: seam=1 "), place_of(lines, "seam: seam=2 "));
    for line in &mut lines[start..end] {
        *line = line.replace(word, replacement);
    }
}

/// Marlin and RepRapFirmware wait with S for a cold nozzle only.
#[test]
fn a_nozzle_that_is_too_hot_is_waited_for() {
    for (name, letter) in [("marlin", 'R'), ("reprapfirmware", 'R'), ("klipper", 'S')] {
        let lines = text(&pouch(PROCESSES, name), FILE);
        let heats: Vec<&str> = lines.lines().filter(|line| line.starts_with("M109")).collect();
        let expected: Vec<String> = [170, 185, 200].map(|celsius| format!("M109 {letter}{celsius}")).to_vec();
        assert_eq!(heats, expected, "{name}");
    }
    let swapped = codes_after(&pouch(PROCESSES, "marlin"), |lines| {
        for line in lines.iter_mut() {
            *line = line.replace("M109 R170", "M109 S210").replace("M109 R185", "M109 S185");
        }
    });
    assert!(swapped.contains(&"cold-seal"), "{swapped:?}");
    let foreign = codes_after(&pouch(PROCESSES, "klipper"), |lines| {
        let heat = place_of(lines, "M109 S185");
        lines[heat] = "M109 R185".to_owned();
    });
    assert!(foreign.contains(&"unused-word"), "{foreign:?}");
}

/// A rest heats to the temperature of the seam that it goes on with, and seals what was left.
#[test]
fn a_job_resumes_in_the_middle_of_any_process() {
    for name in ["grbl", "marlin", "klipper", "linuxcnc", "generic", "bambu"] {
        let built = pouch(PROCESSES, name);
        let (program, old) = (read_pouch(&built, name), text(&built, FILE));
        let all = contacts(&program);
        for index in [0, 1, 3, 10, 11, all.len() - 1] {
            let contact = &all[index];
            let middle = contact.moves[contact.moves.len() / 2];
            let rest = resume(&old, ResumeAt::Line(middle.line), Some(1.0))
                .unwrap_or_else(|fault| panic!("{name} {index}: {fault}"));
            let new = read_for(&machine(profile(name)), &rest.text);
            assert_eq!(new.findings, [], "{name} {index}");
            let remaining = contacts(&new);
            assert_eq!(remaining.len(), all.len() - index, "{name} {index}");
            for (resumed, whole) in remaining.iter().zip(&all[index..]) {
                assert_eq!(resumed.moves[0].heated, whole.moves[0].heated, "{name} {index}");
                assert!((resumed.speed / whole.speed - 1.0).abs() < 0.1, "{name} {index}: {}", resumed.speed);
                assert!((resumed.low - whole.low).abs() < 1e-6, "{name} {index}");
            }
            // And once more from the rest.
            let last = remaining.last().expect("one");
            let again = resume(&rest.text, ResumeAt::Line(last.moves[last.moves.len() / 2].line), Some(1.0));
            assert!(again.is_ok(), "{name} {index}: {again:?}");
        }
    }
}

/// Every reason at once, each at the key of its process.
#[test]
fn a_process_that_the_machine_cannot_make_is_refused_by_name() {
    let slow = "[drawing.process]\nslow = [\"tear\"]\n[seal]\nspeed = \"20 mm/s\"\n[process.slow]\nspeed = \"0.01 mm/s\"\n";
    let refusals = try_drawing(POUCH, slow, "grbl").map(|_| ()).expect_err("too slow");
    let is_of_slow = |refusal: &Refusal| refusal.found.starts_with("process slow: ");
    assert!(
        refusals.iter().any(|refusal| refusal.code == RefusalCode::FeedFloor && is_of_slow(refusal)),
        "{refusals}"
    );
    assert!(
        refusals.iter().all(|refusal| is_of_slow(refusal) || refusal.key.section() == "seal"),
        "{refusals}"
    );
    let long = "inner_process = \"weak\"\n[process.weak]\noverlap = \"900 mm\"\n";
    let refusals =
        crate::try_built(&crate::spec_text(long), profile("linuxcnc")).map(|_| ()).expect_err("long");
    assert_eq!(
        refusals.iter().map(|refusal| (refusal.code, refusal.key.section())).collect::<Vec<_>>(),
        [(RefusalCode::LongOverlap, "process")]
    );
    let misspelt =
        "[drawing.process]\nweak = [\"tera\"]\nspot = [\"hose\"]\n[process.weak]\n[process.spot]\n";
    let refusals = try_pouch(misspelt, "linuxcnc").map(|_| ()).expect_err("no such seams");
    assert_eq!(
        refusals.iter().map(|refusal| refusal.code).collect::<Vec<_>>(),
        [RefusalCode::ProcessWithoutSeam; 2]
    );
    assert!(refusals.iter().any(|refusal| refusal.remedy.contains("did you mean \"tear\"?")), "{refusals}");
}

/// Lines of an island whose centre line bends more sharply than they are far from it, and a rim of two processes.
#[test]
fn seams_that_their_processes_cannot_fill_are_refused() {
    let island = "<circle id=\"island\" cx=\"48\" cy=\"27\" r=\"1.4\"/></g><g id=\"tear\">";
    let with_island = POUCH.replacen("</g><g id=\"tear\">", island, 1);
    let halves =
        "<path id=\"west\" d=\"M 35 12 H 15 V 42 H 35\"/><path id=\"east\" d=\"M 35 42 H 55 V 12 H 35\"/>";
    let rim = "<rect id=\"rim\" x=\"15\" y=\"12\" width=\"40\" height=\"30\" rx=\"6\"/>";
    let in_halves = POUCH.replacen(rim, halves, 1);
    let of_west = "[drawing.process]\nweak = [\"west\"]\n[process.weak]\n";
    for (svg, rest, code, part) in [
        (&with_island, "[seal]\ntip = \"0.5 mm\"\n", RefusalCode::LinesFallApart, "of 4 lines of island"),
        (&in_halves, of_west, RefusalCode::SeamOfTwoProcesses, "east (seal), west (weak)"),
    ] {
        let refusals = try_drawing(svg, rest, "linuxcnc").map(|_| ()).expect_err("refused");
        assert!(refusals.iter().all(|refusal| refusal.code == code), "{refusals}");
        assert!(refusals[0].found.contains(part), "{refusals}");
    }
    assert!(
        try_drawing(&with_island, "", "linuxcnc").is_ok() && try_drawing(&in_halves, "", "linuxcnc").is_ok()
    );
}
