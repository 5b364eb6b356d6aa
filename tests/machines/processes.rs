//! Seams of several processes: each is sealed as often as stated, at its own temperature, speed and height, in every dialect, and a
//! program that differs is found.

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::design::Refusals;
use stargrip_cam::geom::Path;
use stargrip_cam::pipeline::{Built, Sources, build, read_back};
use stargrip_cam::resume::{ResumeAt, resume};
use stargrip_cam::spec::{Source, read};
use stargrip_cam::verify::gcode::{Dialect, Move, Program, read_program};

use crate::clock::controller::run;
use crate::clock::judge::TOTAL;
use crate::clock::own_motors;
use crate::clock::text::Text;
use crate::clock::track::Stretch;
use crate::{PROFILES, findings_with, has_floor, machine, profile, text};

const FILE: &str = "piece-1-seal.gcode";

/// A pouch of 40 x 30 mm with a wall, and a weld in one of its chambers.
const POUCH: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"80mm\" height=\"60mm\" viewBox=\"0 0 80 60\">\
    <g id=\"pouch\"><rect id=\"rim\" x=\"15\" y=\"12\" width=\"40\" height=\"30\" rx=\"6\"/></g>\
    <g id=\"tear\"><path id=\"wall\" d=\"M 38 12 V 42\"/></g>\
    <g id=\"spots\"><path id=\"spot\" d=\"M 24 24 V 30\"/></g>\
    <g id=\"hose\"><path id=\"in\" d=\"M 11 27 H 19\"/><path id=\"out\" d=\"M 51 27 H 59\"/></g></svg>";

/// The pouch with `rest` in its spec, on the machine `name`.
fn try_pouch(rest: &str, name: &str) -> Result<Built, Refusals> {
    let floor = if has_floor(name) { "feed_floor = \"chop\"\n" } else { "" };
    let spec_text = format!(
        "schema = 1\nname = \"pouch\"\n[drawing]\nfile = \"a.svg\"\npassage = \"1 mm\"\n[drawing.layers]\nair = [\"pouch\"]\n\
         seam = [\"tear\", \"spots\"]\nport = [\"hose\"]\n[inlet]\ntube_diameter = \"3 mm\"\n[machine]\nprofile = \"own.toml\"\n{floor}{rest}"
    );
    let reading = read(&Source::new("spec", spec_text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(POUCH.as_bytes()).spec;
    let sources = Sources { spec: &spec_text, machine: profile(name) };
    build(&spec, &machine(profile(name)), sources, &KindRequest::default())
}

fn pouch(rest: &str, name: &str) -> Built {
    try_pouch(rest, name).unwrap_or_else(|refusals| panic!("{name}: {refusals}"))
}

/// The wait after the wall, s.
const COOL: f64 = 4.0;

/// Two processes beside [seal], with passes, lines, a wait and a pause.
const PROCESSES: &str = "[drawing.process]\nweak = [\"tear\"]\nspot = [\"spot\"]\n\
    [seal]\nspeed = \"0.5 mm/s\"\ntip = \"1 mm\"\npasses = 2\n\
    [process.weak]\ntemperature = \"170 C\"\nspeed = \"1.5 mm/s\"\nheight = \"-0.1 mm\"\npasses = 1\ncool = \"4 s\"\npause = \"seam\"\n\
    [process.spot]\ntemperature = \"185 C\"\nlines = 3\npasses = 3\n";

/// One contact of a program.
struct Contact {
    moves: Vec<Move>,
    /// Mean speed with the dwells of its strokes, without the time that these take to start and stop, mm/s.
    speed: f64,
    /// Lowest height, mm.
    low: f64,
}

impl Contact {
    /// The way at the lowest height.
    fn run(&self) -> Path {
        let low = |step: &&Move| step.from.z.max(step.to.z) < self.low + 1e-6;
        Path::open(self.moves.iter().filter(low).filter_map(|step| step.path).collect())
    }
}

/// The contacts of `program`, in order. A wait that a comment announces is none of them.
fn contacts(program: &Program) -> Vec<Contact> {
    let mut groups: Vec<Vec<Move>> = Vec::new();
    let mut is_clear = true;
    for step in &program.moves {
        let is_low = step.from.z.min(step.to.z) < 5.0 - 1e-6;
        if is_low && is_clear {
            groups.push(Vec::new());
        }
        if is_low {
            groups.last_mut().expect("pushed").push(*step);
        }
        is_clear = !is_low;
    }
    let is_cooling =
        |line: usize| program.comments.iter().any(|one| one.key() == Some("cool") && one.line + 1 == line);
    let contact = |moves: Vec<Move>| {
        let lines = moves[0].line..=moves[moves.len() - 1].line + 1;
        let dwells = program.dwells.iter().filter(|one| lines.contains(&one.line) && !is_cooling(one.line));
        let way: f64 = moves.iter().map(Move::length).sum();
        let moving: f64 = moves.iter().filter_map(Move::seconds).sum();
        let speed = way / (moving + dwells.map(|one| one.seconds).sum::<f64>());
        let low = moves.iter().map(|step| step.to.z).fold(f64::INFINITY, f64::min);
        Contact { moves, speed, low }
    };
    groups.into_iter().map(contact).collect()
}

/// The program of the pouch as it is read back.
fn read_pouch(built: &Built, name: &str) -> Program {
    let program =
        read_program(&text(built, FILE), Dialect::for_controller(&machine(profile(name)).controller));
    assert_eq!(program.findings, [], "{name}");
    program
}

/// The name of the seam along which `contact` goes: the one whose band holds all of its way.
fn seam_of(built: &Built, contact: &Contact) -> String {
    let design = &built.forecast.design;
    let placed = &design.placed()[0];
    let run = contact.run();
    let is_within = |line: &Path| {
        let places = (0..=20).filter_map(|i| run.point_at(run.length() * f64::from(i) / 20.0));
        places.map(|p| line.distance(p)).fold(0.0, f64::max) < 1.0
    };
    let seams = &design.part(placed).shape().seams;
    let seam = seams.iter().find(|seam| is_within(&placed.placement.path(&seam.center_line)));
    seam.expect("every contact lies in a band").name.clone()
}

/// The stretches in contact of the program `code`, and the time of the whole program, s, by the clock that shares no code with the plan.
/// Waits for seams to cool belong to no stretch.
fn clocked(code: &str, name: &str) -> (Vec<Stretch>, f64) {
    let (mut kept, mut waits, mut cools) = (String::new(), 0.0, false);
    for line in code.lines() {
        if std::mem::take(&mut cools) {
            waits += COOL;
        } else {
            kept.push_str(line);
        }
        kept.push('\n');
        cools = line.contains("cool: time_s=");
    }
    let track = run(name, &Text::read(&kept), own_motors(name));
    (track.stretches, track.now + waits)
}

/// The time that `program` states, s.
fn stated_total(program: &Program) -> f64 {
    let stated = program.comments.iter().find(|one| one.key() == Some("total"));
    stated.and_then(|total| total.number("time_s")).expect("a total")
}

/// (seam, contacts, temperature, speed, height): two lines of 1 mm fill a band of 2 mm.
const EXPECTED: [(&str, usize, f64, f64, f64); 3] =
    [("wall", 2, 170.0, 1.5, -0.1), ("spot", 9, 185.0, 0.5, -0.3), ("rim", 4, 200.0, 0.5, -0.3)];

#[test]
fn every_seam_is_sealed_as_its_process_says_on_every_machine() {
    for name in PROFILES {
        let built = pouch(PROCESSES, name);
        assert_eq!(read_back(&built.output_files()).findings, [], "{name}");
        let program = read_pouch(&built, name);
        let all = contacts(&program);
        let (stretches, seconds) = clocked(&text(&built, FILE), name);
        // Between two passes over an open seam there may be no travel: they are one stretch.
        let stretch_of = |contact: &Contact| stretches.iter().rfind(|one| one.line <= contact.moves[0].line);
        let speeds: Vec<f64> = all.iter().filter_map(stretch_of).map(Stretch::speed).collect();
        assert_eq!(speeds.len(), all.len(), "{name}");
        let total = stated_total(&program);
        // Where the profile states no acceleration, travels count as at speed at once.
        let is_known = machine(profile(name)).motion.acceleration.is_some();
        assert!(!is_known || (seconds / total - 1.0).abs() < TOTAL, "{name}: {seconds} s, stated {total} s");
        let rim = |seam: String| if seam.starts_with("rim") { "rim".to_owned() } else { seam };
        let seams: Vec<String> = all.iter().map(|contact| rim(seam_of(&built, contact))).collect();
        for (seam, count, temperature, speed, height) in EXPECTED {
            let of_seam: Vec<(&Contact, f64)> = all
                .iter()
                .zip(speeds.iter().copied())
                .zip(&seams)
                .filter(|(_, name)| *name == seam)
                .map(|(contact, _)| contact)
                .collect();
            // A hose on either side opens the rim twice.
            let count = if seam == "rim" { 2 * count } else { count };
            assert_eq!(of_seam.len(), count, "{name}: {seam} of {seams:?}");
            for (contact, mean) in of_seam {
                assert!(contact.moves.iter().all(|step| step.heated == Some(temperature)), "{name}: {seam}");
                // A stop at either end takes up to 1.5 % of the shortest, fastest seam.
                assert!((mean / speed - 1.0).abs() < 0.02, "{name}: {seam} {mean}");
                assert!((contact.low - height).abs() < 1e-6, "{name}: {seam} {}", contact.low);
            }
        }
        // The coolest first, each temperature once.
        let heats: Vec<f64> = all.iter().filter_map(|contact| contact.moves[0].heated).collect();
        assert!(heats.is_sorted(), "{name}: {heats:?}");
        let waits = program.comments.iter().filter(|one| one.key() == Some("cool")).count();
        let pauses = program.comments.iter().filter(|one| one.key() == Some("pause")).count();
        assert_eq!((waits, pauses), (1, 1), "{name}");
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
    for (index, name) in PROFILES.iter().cycle().take(24).enumerate() {
        let (passes, lines) = (1 + index % 3, 2 + index % 2);
        let (temperature, cool) = (150 + 4 * index, index % 4);
        let pause = ["none", "seam", "piece"][index % 3];
        let rest = format!(
            "program = \"sheet\"\n[sheet]\ncopies = 2\n[drawing.process]\na-1 = [\"tear\"]\nb_2 = [\"seam\"]\n\
             [seal]\nspeed = \"0.4 mm/s\"\ntip = \"1.2 mm\"\nlines = 2\npause = \"{pause}\"\n\
             [process.a-1]\ntemperature = \"{temperature} C\"\npasses = {passes}\ncool = \"{cool} s\"\n\
             [process.b_2]\nspeed = \"{}.5 mm/s\"\nlines = {lines}\noverlap = \"2 mm\"\n",
            1 + index % 2
        );
        // Beside the corners of the pouch Marlin joins moves, which not every speed allows.
        let Ok(built) = try_pouch(&rest, name) else {
            assert_eq!(*name, "marlin");
            continue;
        };
        assert_eq!(read_back(&built.output_files()).findings, [], "{name}: {rest}");
    }
}

/// The codes of the findings after `change` of the lines of the program of the pouch.
fn codes_after(name: &str, change: impl Fn(&mut Vec<String>)) -> Vec<&'static str> {
    let built = pouch(PROCESSES, name);
    let mut lines: Vec<String> = text(&built, FILE).lines().map(str::to_owned).collect();
    let before = lines.clone();
    change(&mut lines);
    assert!(lines != before, "{name}: the change changes nothing");
    let (last, count) = (lines.len() - 1, lines.len());
    let close = if lines[last].ends_with(')') { ")" } else { "" };
    let mark = lines[last].find("end of program").expect("a last line");
    lines[last] = format!("{}end of program, {count} lines{close}", &lines[last][..mark]);
    let file = crate::actual_name(&built, FILE);
    let findings = findings_with(&built, FILE, &(lines.join("\n") + "\n"));
    assert!(findings.iter().all(|finding| finding.file == file), "{findings:#?}");
    findings.iter().map(|finding| finding.code).collect()
}

/// Index of the first line that contains `needle`.
fn place_of(lines: &[String], needle: &str) -> usize {
    lines.iter().position(|line| line.contains(needle)).unwrap_or_else(|| panic!("no {needle}"))
}

#[test]
fn a_program_with_another_process_is_found() {
    for name in ["grbl", "marlin", "klipper", "linuxcnc"] {
        // Another temperature: that of the operator's comment, or of the controller's word.
        let cooler = codes_after(name, |lines| {
            for line in lines.iter_mut() {
                *line =
                    line.replace("temperature_C=185", "temperature_C=175").replace("M109 R185", "M109 R175");
                *line = line.replace("M109 S185", "M109 S175").replace("iron to 185 C", "iron to 175 C");
            }
        });
        assert!(cooler.contains(&"cold-seal"), "{name}: {cooler:?}");
        // A missing pass: all lines from the last title to the way home.
        let missing = codes_after(name, |lines| {
            let from = place_of(lines, "seam: seam=19 ");
            let to = from + place_of(&lines[from..], "G0 Z30");
            let _ = lines.drain(from..to);
        });
        assert!(missing.contains(&"missing-seam"), "{name}: {missing:?}");
        // A missing wait.
        let hasty = codes_after(name, |lines| {
            let wait = place_of(lines, "cool: time_s=4") + 1;
            let _ = lines.remove(wait);
        });
        assert!(hasty.contains(&"missing-wait"), "{name}: {hasty:?}");
        // A shorter one.
        let short = codes_after(name, |lines| {
            let wait = place_of(lines, "cool: time_s=4") + 1;
            lines[wait] = if lines[wait].contains("P4000") { "G4 P1000" } else { "G4 P1" }.to_owned();
        });
        assert!(short.contains(&"missing-wait"), "{name}: {short:?}");
        // Swapped processes: the wall at the speed of the spot.
        let swapped = codes_after(name, |lines| {
            let (from, to) = (place_of(lines, "seam: seam=1 "), place_of(lines, "seam: seam=2 "));
            for line in &mut lines[from..to] {
                *line = line.replace(" F90", " F30").replace("Z-0.1", "Z-0.3");
            }
        });
        assert!(swapped.contains(&"wrong-feed") || swapped.contains(&"too-deep"), "{name}: {swapped:?}");
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
    let swapped = codes_after("marlin", |lines| {
        for line in lines.iter_mut() {
            *line = line.replace("M109 R170", "M109 S210").replace("M109 R185", "M109 S185");
        }
    });
    assert!(swapped.contains(&"cold-seal"), "{swapped:?}");
    let foreign = codes_after("klipper", |lines| {
        let heat = place_of(lines, "M109 S185");
        lines[heat] = "M109 R185".to_owned();
    });
    assert!(foreign.contains(&"unused-word"), "{foreign:?}");
}

/// A rest heats to the temperature of the seam that it goes on with, and seals what was left.
#[test]
fn a_job_resumes_in_the_middle_of_any_process() {
    for name in ["grbl", "marlin", "klipper", "linuxcnc", "generic"] {
        let built = pouch(PROCESSES, name);
        let (program, old) = (read_pouch(&built, name), text(&built, FILE));
        let all = contacts(&program);
        for index in [0, 1, 3, 10, 11, all.len() - 1] {
            let contact = &all[index];
            let middle = contact.moves[contact.moves.len() / 2];
            let rest = resume(&old, ResumeAt::Line(middle.line), Some(1.0))
                .unwrap_or_else(|fault| panic!("{name} {index}: {fault}"));
            let dialect = Dialect::for_controller(&machine(profile(name)).controller);
            let new = read_program(&rest.text, dialect);
            assert_eq!(new.findings, [], "{name} {index}");
            let remaining = contacts(&new);
            assert_eq!(remaining.len(), all.len() - index, "{name} {index}");
            for (left, whole) in remaining.iter().zip(&all[index..]) {
                assert_eq!(left.moves[0].heated, whole.moves[0].heated, "{name} {index}");
                assert!((left.speed / whole.speed - 1.0).abs() < 0.1, "{name} {index}: {}", left.speed);
                assert!((left.low - whole.low).abs() < 1e-6, "{name} {index}");
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
    let rest = "[drawing.process]\nslow = [\"tear\"]\n[seal]\nspeed = \"20 mm/s\"\n[process.slow]\nspeed = \"0.01 mm/s\"\n";
    let refusals = try_pouch(rest, "grbl").map(|_| ());
    let refusals = refusals.err().map_or_else(Vec::new, |refusals| refusals.to_vec());
    for refusal in &refusals {
        assert!(refusal.found.starts_with("process slow: ") || refusal.key.section() == "seal", "{refusal}");
    }
    let lost = "[drawing.process]\nweak = [\"tera\"]\nspot = [\"hose\"]\n[process.weak]\n[process.spot]\n";
    let refusals = try_pouch(lost, "linuxcnc").map(|_| ()).expect_err("no such seams");
    let codes: Vec<&str> = refusals.iter().map(|refusal| refusal.code.to_string().leak() as &str).collect();
    assert_eq!(codes, ["process-without-seam"; 2], "{refusals}");
    assert!(refusals.iter().any(|refusal| refusal.remedy.contains("did you mean \"tear\"?")), "{refusals}");
}
