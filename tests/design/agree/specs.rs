//! Random specs: every section and every kind of file, from usual values to far beyond them.

use crate::agree::machines::machine;
use crate::support::dice::Dice;
use stargrip_cam::artifact::{Kind, KindRequest};
use std::f64::consts::PI;
use std::fmt::Write;

/// One random case.
pub(crate) struct Case {
    pub(crate) spec: String,
    pub(crate) machine: String,
    pub(crate) asked: KindRequest,
}

/// Case `number`; always the same one.
pub(crate) fn case(number: u64) -> Case {
    // The constant of splitmix64 takes neighbouring numbers far apart; a generator must not begin at 0.
    let mut dice = Dice((number + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let _ = (0..4).map(|_| dice.below(2)).sum::<usize>();
    let is_changed = dice.chance(0.4);
    let (profile, chops) = machine(&mut dice, is_changed);
    let mut text = spec(&mut dice, if is_changed { "own.toml" } else { profile.0 }, chops);
    if profile.1.contains("tool = \"laser\"") {
        text = for_laser(&mut dice, &text);
    }
    Case { spec: text, machine: profile.1, asked: request_of(&mut dice) }
}

impl Dice {
    /// From 0 up to 1.
    pub(super) fn share(&mut self) -> f64 {
        u32::try_from(self.below(1 << 24)).map_or(0.0, |x| f64::from(x) / f64::from(1 << 24))
    }

    pub(super) fn chance(&mut self, share: f64) -> bool {
        self.share() < share
    }

    pub(super) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    /// Every decade alike.
    pub(super) fn decades(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high / low).ln() * self.share()).exp()
    }

    pub(super) fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// A section that is being written.
struct Section {
    text: String,
}

impl Section {
    fn new(head: &str) -> Self {
        Self { text: format!("{head}\n") }
    }

    /// `key`, in every `1 / share` specs.
    fn maybe(&mut self, dice: &mut Dice, share: f64, key: &str, value: impl FnOnce(&mut Dice) -> String) {
        if dice.chance(share) {
            let drawn_value = value(dice);
            let _ = writeln!(self.text, "{key} = {drawn_value}");
        }
    }
}

pub(super) fn mm(x: f64) -> String {
    format!("\"{x} mm\"")
}

/// Between `low` and `high` of `unit`, rounded as people write, or not at all.
fn some_mm(dice: &mut Dice, unit: f64, [low, high]: [f64; 2]) -> String {
    let x = unit * dice.uniform(low, high);
    mm(if dice.chance(0.5) { (x * 10.0).round().max(1.0) / 10.0 } else { x })
}

/// A star that exists, by its arm length instead of its inner radius.
fn star(dice: &mut Dice) -> (String, f64, f64) {
    let n = match dice.below(10) {
        0 => 3 + dice.below(62),
        1 => dice.one_of(&[3, 64]),
        _ => 3 + dice.below(8),
    };
    let points = f64::from(u32::try_from(n).unwrap_or(3));
    let (low, high) = if dice.chance(0.2) { (0.3, 400.0) } else { (8.0, 60.0) };
    let w = dice.decades(low, high);
    let widest = (178.0 - 360.0 / points).max(4.0);
    let usual = dice.chance(0.8);
    let phi = if usual { dice.uniform(10.0, widest.min(70.0)) } else { dice.uniform(2.0, widest) };
    let l = w * dice.decades(0.3, if usual { 4.0 } else { 30.0 });
    let mut radius = || if dice.chance(0.5) { 0.0 } else { dice.uniform(0.0, 0.6) * w };
    let (r_i, r_e) = (radius(), radius());
    let half = (phi / 2.0).to_radians();
    let rho = (l * half.sin() + (w + r_i + r_e) * half.cos()) / (PI / points).sin() - w - r_e;
    let rho = rho.max(0.2 * w);
    let text = format!(
        "[star]\npoints = {n}\ninner_radius = \"{rho} mm\"\ntube_width = \"{w} mm\"\ntip_angle = \"{phi} deg\"\n\
         tip_radius = \"{r_i} mm\"\ncorner_radius = \"{r_e} mm\"\n"
    );
    (text, w, rho)
}

pub(super) fn spec(dice: &mut Dice, profile: &str, chops: bool) -> String {
    let name = dice.one_of(&["random", "a \\\"quoted\\\" <name> & ;(x)", "星 é", "x"]);
    let (sections, w, rho) = star(dice);
    let (of_star, of_processes) = processes(dice);
    let mut text =
        format!("schema = 1\nname = \"{name}\"\n{}{sections}{of_star}{of_processes}", fabric(dice));
    text += &stack(dice, w, rho);
    text += &inlet(dice, w);
    text += &seal(dice, w);
    text += &mask(dice, w, rho);
    text += &frame(dice, w);
    text += &sheet(dice, w, rho);
    text += &load(dice, rho);
    let mut accuracy = Section::new("[accuracy]");
    accuracy.maybe(dice, 0.5, "path", |dice| mm(dice.decades(1e-4, 1.0)));
    accuracy
        .maybe(dice, 0.3, "model", |dice| format!("{:?}", dice.one_of(&["auto", "fit", "ring", "section"])));
    text += &accuracy.text;
    let mut machine = Section::new("[machine]");
    let _ = writeln!(machine.text, "profile = {profile:?}");
    machine.maybe(dice, 0.2, "marks", |_| "\"pause\"".to_owned());
    machine.maybe(dice, 0.3, "program", |_| "\"sheet\"".to_owned());
    // Strokes are thousands of lines: only stars that are not large.
    let chop = chops && w * rho < 2000.0;
    machine.maybe(dice, if chop { 0.7 } else { 0.02 }, "feed_floor", |_| "\"chop\"".to_owned());
    text + &machine.text
}

/// The spec `text` of an iron for a laser: powers take the place of temperatures and heights, and a laser alone cuts.
fn for_laser(dice: &mut Dice, text: &str) -> String {
    let (mut lasered, mut section) = (String::new(), String::new());
    let band = text.split_once("\nband = \"").and_then(|(_, rest)| rest.split_once(" mm")?.0.parse().ok());
    let seal = text.split_once("[seal]\n").and_then(|(_, rest)| rest.split("\n[").next()).unwrap_or_default();
    // Line by line: those of irons are left out of their sections, and the keys of a laser follow the heads of theirs. A spot is no wider
    // than the band, and the usual speed of an iron is below what a laser's controller holds.
    // Everything else stays, so that a laser meets the same stars, sheets and masks.
    for line in text.lines() {
        if line.starts_with('[') {
            line.clone_into(&mut section);
        }
        let key = line.split(" = ").next().unwrap_or_default();
        let is_of_iron = match section.as_str() {
            "[cut]" => ["tool", "temperature", "speed", "height", "blade_offset"].contains(&key),
            "[machine]" => key == "feed_floor",
            "[seal]" => ["temperature", "height"].contains(&key),
            process => process.starts_with("[process.") && ["temperature", "height"].contains(&key),
        };
        if !is_of_iron {
            let _ = writeln!(lasered, "{line}");
        }
        if line == "[cut]" && dice.chance(0.3) {
            let (power, speed, focus) =
                (dice.uniform(1.0, 100.0), dice.decades(1.0, 100.0), dice.uniform(3.0, 14.0));
            let _ = writeln!(
                lasered,
                "tool = \"laser\"\npower = \"{power} %\"\nspeed = \"{speed} mm/s\"\nfocus = \"{focus} mm\""
            );
        }
        if line == "[seal]" {
            let mut keys = Section { text: String::new() };
            keys.maybe(dice, 1.0, "power", |dice| format!("\"{} %\"", dice.uniform(1.0, 100.0)));
            keys.maybe(dice, 0.3, "focus", |dice| mm(dice.uniform(3.0, 12.9)));
            if !seal.contains("tip = ") {
                keys.maybe(dice, 1.0, "tip", |dice| mm(band.unwrap_or(2.0) * dice.uniform(0.15, 1.0)));
            }
            if !seal.contains("speed = ") {
                keys.maybe(dice, 1.0, "speed", |dice| format!("\"{} mm/s\"", dice.decades(1.0, 100.0)));
            }
            lasered += &keys.text;
        } else if line.starts_with("[process.") {
            let mut keys = Section { text: String::new() };
            keys.maybe(dice, 0.5, "power", |dice| format!("\"{} %\"", dice.uniform(1.0, 100.0)));
            lasered += &keys.text;
        }
    }
    lasered
}

fn fabric(dice: &mut Dice) -> String {
    let mut s = Section::new("[fabric]");
    s.maybe(dice, 0.2, "thickness", |dice| mm(dice.decades(0.02, 3.0)));
    s.maybe(dice, 0.1, "young_modulus", |dice| format!("\"{} MPa\"", dice.decades(1.0, 5000.0)));
    s.maybe(dice, 0.3, "seal_strength", |dice| format!("\"{} N/mm\"", dice.decades(0.1, 20.0)));
    s.maybe(dice, 0.3, "areal_density", |_| "\"0.3 kg/m^2\"".to_owned());
    s.text
}

fn stack(dice: &mut Dice, w: f64, rho: f64) -> String {
    if dice.chance(0.6) {
        return String::new();
    }
    let count = 1 + dice.below(4);
    let mut s = Section::new("[stack]");
    let _ = writeln!(s.text, "count = {count}");
    s.maybe(dice, 0.3, "rotation", |dice| format!("\"{} deg\"", dice.uniform(-180.0, 180.0)));
    s.maybe(dice, 0.7, "pitch", |dice| some_mm(dice, w.max(8.0), [0.7, 3.0]));
    for index in 1..=count {
        if !dice.chance(0.4) {
            continue;
        }
        let _ = writeln!(s.text, "[[stack.star]]\nindex = {index}");
        // Cones, and stars of other kinds.
        s.maybe(dice, 0.7, "inner_radius", |dice| some_mm(dice, rho, [0.8, 1.4]));
        s.maybe(dice, 0.1, "points", |dice| (3 + dice.below(8)).to_string());
        s.maybe(dice, 0.2, "tube_width", |dice| some_mm(dice, w, [0.7, 1.1]));
        s.maybe(dice, 0.1, "rotation", |dice| format!("\"{} deg\"", dice.uniform(0.0, 90.0)));
    }
    s.text
}

fn inlet(dice: &mut Dice, w: f64) -> String {
    match dice.below(5) {
        0 => "[inlet]\nnone = true\n".to_owned(),
        1 => format!("[inlet]\ntip = {}\n", 1 + dice.below(3)),
        2 => format!(
            "[inlet]\ntube_diameter = \"{} mm\"\nlength = \"{} mm\"\n",
            w * dice.uniform(0.05, 0.3),
            w * dice.uniform(0.1, 2.0)
        ),
        _ if w < 20.0 => {
            format!("[inlet]\ntube_diameter = \"{} mm\"\nfillet = \"{} mm\"\n", 0.2 * w, 0.05 * w)
        }
        _ => String::new(),
    }
}

fn seal(dice: &mut Dice, w: f64) -> String {
    let mut s = Section::new("[seal]");
    s.maybe(dice, if w < 8.0 { 1.0 } else { 0.4 }, "band", |dice| some_mm(dice, w.min(60.0), [0.03, 0.2]));
    s.maybe(dice, 0.2, "overlap", |dice| mm(dice.uniform(0.0, 20.0)));
    s.maybe(dice, if w < 8.0 { 1.0 } else { 0.3 }, "allowance", |dice| {
        mm(w.min(60.0) * dice.uniform(0.15, 0.5))
    });
    s.maybe(dice, if w < 8.0 { 1.0 } else { 0.3 }, "hole_allowance", |dice| {
        mm(w.min(60.0) * dice.uniform(0.0, 0.1))
    });
    s.maybe(dice, 0.2, "speed", |dice| format!("\"{} mm/s\"", dice.decades(0.05, 20.0)));
    s.maybe(dice, 0.1, "temperature", |dice| format!("\"{} C\"", dice.uniform(50.0, 299.0)));
    contact(&mut s, dice);
    s.maybe(dice, 0.1, "tip", |dice| mm(dice.uniform(0.5, 2.0)));
    s.text
}

/// The keys of [seal] and of its processes that say how often and how high a seam is sealed, and what follows it.
fn contact(s: &mut Section, dice: &mut Dice) {
    s.maybe(dice, 0.2, "height", |dice| mm(-dice.uniform(0.0, 1.0)));
    s.maybe(dice, 0.1, "passes", |dice| (1 + dice.below(3)).to_string());
    s.maybe(dice, 0.1, "lines", |dice| (1 + dice.below(3)).to_string());
    s.maybe(dice, 0.2, "cool", |dice| format!("\"{} s\"", dice.uniform(0.0, 30.0)));
    s.maybe(dice, 0.2, "pause", |dice| format!("{:?}", dice.one_of(&["none", "seam", "piece"])));
    s.maybe(dice, 0.1, "strength", |dice| format!("\"{} N/mm\"", dice.decades(0.1, 20.0)));
}

/// The keys of [star] that name processes, and the sections of these.
fn processes(dice: &mut Dice) -> (String, String) {
    let (mut of_star, mut sections) = (String::new(), String::new());
    for (key, name) in [("inner_process", "weak"), ("outer_process", "strong")] {
        if dice.chance(0.3) {
            let mut s = Section::new(&format!("[process.{name}]"));
            s.maybe(dice, 0.5, "temperature", |dice| format!("\"{} C\"", dice.uniform(50.0, 299.0)));
            s.maybe(dice, 0.5, "speed", |dice| format!("\"{} mm/s\"", dice.decades(0.05, 20.0)));
            s.maybe(dice, 0.3, "overlap", |dice| mm(dice.uniform(0.0, 20.0)));
            contact(&mut s, dice);
            let _ = writeln!(of_star, "{key} = {name:?}");
            sections += &s.text;
        }
    }
    (of_star, sections)
}

fn mask(dice: &mut Dice, w: f64, rho: f64) -> String {
    let mut s = Section::new("[mask]");
    s.maybe(dice, 0.2, "extent", |dice| mm(w * dice.uniform(0.2, 1.2)));
    s.maybe(dice, 0.2, "creep", |dice| mm(w * dice.uniform(0.0, 0.05)));
    s.maybe(dice, 0.3, "border", |dice| mm(dice.uniform(0.0, 30.0)));
    s.maybe(dice, 0.3, "mirror", |_| "true".to_owned());
    s.maybe(dice, 0.2, "thickness", |dice| mm(dice.decades(0.2, 10.0)));
    s.maybe(dice, 0.3, "bed", |dice| {
        let size = 2.0 * (rho + w);
        let mut side = || (size * dice.uniform(0.6, 2.0)).round().max(1.0);
        format!("\"{} mm x {} mm\"", side(), side())
    });
    s.text
}

fn frame(dice: &mut Dice, w: f64) -> String {
    let mut s = Section::new("[frame]");
    s.maybe(dice, 0.2, "plate_thickness", |dice| mm(dice.decades(0.5, 20.0)));
    s.maybe(dice, 0.2, "clearance", |dice| mm(dice.uniform(0.0, 10.0)));
    s.maybe(dice, 0.2, "post_diameter", |dice| mm(w * dice.uniform(0.05, 0.5)));
    s.maybe(dice, 0.2, "posts", |dice| (3 + dice.below(12)).to_string());
    s.maybe(dice, 0.2, "kerf", |dice| mm(dice.uniform(0.0, 0.5)));
    s.text += "[cut]\n";
    let widest = if dice.chance(0.2) { 3.0 } else { 0.4 };
    s.maybe(dice, 0.3, "kerf", |dice| mm(dice.uniform(0.0, widest)));
    s.maybe(dice, 0.3, "colours", |_| "\"ordered\"".to_owned());
    if dice.chance(0.2) {
        let is_hot = dice.chance(0.5);
        let (tool, key, value) = if is_hot {
            ("hot-tip", "temperature", format!("\"{} C\"", dice.uniform(100.0, 500.0)))
        } else {
            ("drag-knife", "blade_offset", mm(dice.uniform(0.0, 1.0)))
        };
        let (speed, depth) = (dice.decades(1.0, 50.0), dice.uniform(0.2, 3.0));
        let _ = writeln!(
            s.text,
            "tool = {tool:?}\n{key} = {value}\nspeed = \"{speed} mm/s\"\nheight = \"-{depth} mm\""
        );
    }
    s.text
}

fn sheet(dice: &mut Dice, w: f64, rho: f64) -> String {
    let mut s = Section::new("[sheet]");
    if dice.chance(0.3) {
        let reach = 2.0 * (rho + 2.0 * w) + 60.0;
        let mut side = || reach * dice.uniform(0.9, 4.0);
        let _ = write!(s.text, "width = \"{} mm\"\nheight = \"{} mm\"\n", side(), side());
    }
    s.maybe(dice, 0.3, "margin", |dice| mm(dice.uniform(0.0, 30.0)));
    s.maybe(dice, 0.2, "gap", |dice| mm(dice.uniform(0.0, 30.0)));
    s.maybe(dice, 0.3, "turn", |_| "true".to_owned());
    s.maybe(dice, if w < 8.0 { 1.0 } else { 0.3 }, "hole_diameter", |dice| {
        mm(w.min(30.0) * dice.uniform(0.0, 0.15))
    });
    s.text
}

fn load(dice: &mut Dice, rho: f64) -> String {
    if dice.chance(0.4) {
        return String::new();
    }
    let mut s = Section::new("[load]");
    s.maybe(dice, 0.9, "pressure", |dice| {
        let kpa = if dice.chance(0.8) { dice.uniform(5.0, 100.0) } else { dice.decades(0.05, 5000.0) };
        format!("\"{kpa} kPa\"")
    });
    s.maybe(dice, 0.7, "object_radius", |dice| some_mm(dice, rho, [0.2, 1.1]));
    if dice.chance(0.7) {
        s.maybe(dice, 1.0, "friction", |dice| format!("{:?}", dice.uniform(0.1, 1.2)));
        s.maybe(dice, 0.3, "friction_least", |dice| format!("{:?}", dice.uniform(0.05, 0.1)));
        s.maybe(dice, 0.3, "friction_most", |dice| format!("{:?}", dice.uniform(1.2, 1.5)));
    }
    s.maybe(dice, 0.3, "mass", |dice| format!("\"{} kg\"", dice.decades(0.01, 20.0)));
    s.maybe(dice, 0.2, "largest_force", |dice| format!("\"{} N\"", dice.decades(1.0, 500.0)));
    s.text
}

fn request_of(dice: &mut Dice) -> KindRequest {
    let extras: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_extra()).collect();
    match dice.below(10) {
        0 => KindRequest { with: extras, ..KindRequest::default() },
        1 | 2 => {
            let kinds: Vec<Kind> = (0..=dice.below(3)).map(|_| dice.one_of(Kind::ALL)).collect();
            KindRequest::exactly(&kinds)
        }
        3..=6 => {
            let extras = (0..=dice.below(2)).map(|_| dice.one_of(&extras)).collect();
            KindRequest { with: extras, ..KindRequest::default() }
        }
        _ => KindRequest::default(),
    }
}
