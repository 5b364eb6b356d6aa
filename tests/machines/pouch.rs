//! A pouch whose seams have several processes: its program, and the contacts that are read back from it.

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::design::Refusals;
use stargrip_cam::geom::Path;
use stargrip_cam::pipeline::{Built, Sources, build};
use stargrip_cam::spec::{Source, read};
use stargrip_cam::verify::gcode::{Move, Program};

use crate::clock::controller::run;
use crate::clock::own_motors;
use crate::clock::text::Text;
use crate::clock::track::Stretch;
use crate::{has_floor, machine, profile, read_for, text};

pub(super) const FILE: &str = "piece-1-seal.gcode";

/// A pouch of 40 x 30 mm with a wall, and a weld in one of its chambers.
pub(super) const POUCH: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"80mm\" height=\"60mm\" viewBox=\"0 0 80 60\">\
    <g id=\"pouch\"><rect id=\"rim\" x=\"15\" y=\"12\" width=\"40\" height=\"30\" rx=\"6\"/></g>\
    <g id=\"tear\"><path id=\"wall\" d=\"M 38 12 V 42\"/></g>\
    <g id=\"spots\"><path id=\"spot\" d=\"M 24 24 V 30\"/></g>\
    <g id=\"hose\"><path id=\"in\" d=\"M 11 27 H 19\"/><path id=\"out\" d=\"M 51 27 H 59\"/></g></svg>";

/// The drawing `svg` with `rest` in its spec, on the machine `name`.
pub(super) fn try_drawing(svg: &str, rest: &str, name: &str) -> Result<Built, Refusals> {
    let spec_text = format!(
        "schema = 1\nname = \"pouch\"\n[drawing]\nfile = \"a.svg\"\npassage = \"1 mm\"\n[drawing.layers]\nair = [\"pouch\"]\n\
         seam = [\"tear\", \"spots\"]\nport = [\"hose\"]\n[inlet]\ntube_diameter = \"3 mm\"\n[machine]\nprofile = \"own.toml\"\n{rest}"
    );
    let reading = read(&Source::new("spec", spec_text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let spec = reading.with_drawing(svg.as_bytes()).spec;
    let sources = Sources { spec: &spec_text, machine: profile(name) };
    build(&spec, &machine(profile(name)), sources, &KindRequest::default())
}

/// The pouch with `rest` in its spec, chopped where the machine `name` needs it.
pub(super) fn try_pouch(rest: &str, name: &str) -> Result<Built, Refusals> {
    let floor = if has_floor(name) { "feed_floor = \"chop\"\n" } else { "" };
    try_drawing(POUCH, &format!("{floor}{rest}"), name)
}

pub(super) fn pouch(rest: &str, name: &str) -> Built {
    try_pouch(rest, name).unwrap_or_else(|refusals| panic!("{name}: {refusals}"))
}

/// The wait after the wall, s.
pub(super) const COOL: f64 = 4.0;

/// Two processes beside [seal], with passes, lines, a wait and a pause.
pub(super) const PROCESSES: &str = "[drawing.process]\nweak = [\"tear\"]\nspot = [\"spot\"]\n\
    [seal]\nspeed = \"0.5 mm/s\"\ntip = \"1 mm\"\npasses = 2\n\
    [process.weak]\ntemperature = \"170 C\"\nspeed = \"1.5 mm/s\"\nheight = \"-0.1 mm\"\npasses = 1\ncool = \"4 s\"\npause = \"seam\"\n\
    [process.spot]\ntemperature = \"185 C\"\nlines = 3\npasses = 3\n";

/// One contact of a program.
pub(super) struct Contact {
    pub(super) moves: Vec<Move>,
    /// Mean speed with the dwells of its strokes, without the time that these take to start and stop, mm/s.
    pub(super) speed: f64,
    /// Lowest height, mm.
    pub(super) low: f64,
}

impl Contact {
    /// The way at the lowest height.
    pub(super) fn run(&self) -> Path {
        let low = |step: &&Move| step.from.z.max(step.to.z) < self.low + 1e-6;
        Path::open(self.moves.iter().filter(low).filter_map(|step| step.path).collect())
    }
}

/// The contacts of `program`, in order. A wait that a comment announces is none of them.
pub(super) fn contacts(program: &Program) -> Vec<Contact> {
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
    groups.into_iter().map(|moves| contact(program, moves)).collect()
}

/// The contact of `moves` with the dwells between and after them.
pub(super) fn contact(program: &Program, moves: Vec<Move>) -> Contact {
    let cools: Vec<usize> = program
        .comments
        .iter()
        .filter(|comment| comment.key() == Some("cool"))
        .map(|cool| cool.line)
        .collect();
    let lines = moves[0].line..=moves[moves.len() - 1].line + 1;
    let dwells = program
        .dwells
        .iter()
        .filter(|dwell| lines.contains(&dwell.line) && !cools.contains(&(dwell.line - 1)));
    let length: f64 = moves.iter().map(Move::length).sum();
    let moving: f64 = moves.iter().filter_map(Move::seconds).sum();
    let speed = length / (moving + dwells.map(|dwell| dwell.seconds).sum::<f64>());
    let low = moves.iter().map(|step| step.to.z).fold(f64::INFINITY, f64::min);
    Contact { moves, speed, low }
}

/// The program of the pouch as it is read back.
pub(super) fn read_pouch(built: &Built, name: &str) -> Program {
    let program = read_for(&machine(profile(name)), &text(built, FILE));
    assert_eq!(program.findings, [], "{name}");
    program
}

/// The name of the seam along which `contact` goes: the one whose band holds all of its way.
pub(super) fn seam_of(built: &Built, contact: &Contact) -> String {
    let design = &built.forecast.design;
    let placed = &design.placed()[0];
    let run = contact.run();
    let seams = &design.part(placed).shape().seams;
    let seam = seams.iter().find(|seam| is_within(&run, &placed.placement.path(&seam.center_line)));
    seam.expect("every contact lies in a band").name.clone()
}

/// Whether all of `run` lies within 1 mm of `center_line`.
pub(super) fn is_within(run: &Path, center_line: &Path) -> bool {
    let places = (0..=20).filter_map(|i| run.point_at(run.length() * f64::from(i) / 20.0));
    places.map(|place| center_line.distance(place)).fold(0.0, f64::max) < 1.0
}

/// The stretches in contact of the program `code`, and the time of the whole program, s, by the clock that shares no code with the plan.
/// Waits for seams to cool belong to no stretch.
pub(super) fn clocked(code: &str, name: &str) -> (Vec<Stretch>, f64) {
    let (mut moving, mut waits, mut cools) = (String::new(), 0.0, false);
    for line in code.lines() {
        if std::mem::take(&mut cools) {
            waits += COOL;
        } else {
            moving.push_str(line);
        }
        moving.push('\n');
        cools = line.contains("cool: time_s=");
    }
    let track = run(name, &Text::read(&moving), own_motors(name));
    (track.stretches, track.now + waits)
}

/// The time that `program` states, s.
pub(super) fn stated_total(program: &Program) -> f64 {
    let total = program.comments.iter().find(|comment| comment.key() == Some("total"));
    total.and_then(|total| total.number("time_s")).expect("a total")
}

/// The clock's speed of each contact, mm/s. Between two passes over an open seam there may be no travel: they are one stretch.
pub(super) fn clocked_speeds(contacts: &[Contact], stretches: &[Stretch]) -> Vec<f64> {
    let stretch_of =
        |contact: &Contact| stretches.iter().rfind(|stretch| stretch.line <= contact.moves[0].line);
    contacts.iter().map(|contact| stretch_of(contact).expect("a stretch").speed()).collect()
}
