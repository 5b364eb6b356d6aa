//! Random profiles of machines, from a shipped one.

use crate::agree::specs::mm;
use crate::support::dice::Dice;
use stargrip_cam::spec;
use std::fmt::Write;

/// A profile with its name, built in or changed, and whether it can chop.
pub(super) fn machine(dice: &mut Dice, is_changed: bool) -> ((&'static str, String), bool) {
    let names: Vec<&'static str> =
        spec::builtin_machines().filter(|name| *name != spec::PRESS_PROFILE).collect();
    let name = dice.one_of(&names);
    let mut text = spec::builtin_machine(name).expect("built in").to_owned();
    if is_changed {
        text = changed(dice, &text);
    }
    let built_in = spec::builtin_machine(name).expect("built in");
    let built_in = spec::read_machine(&spec::Source::new(name, built_in)).expect("a profile");
    ((name, text), matches!(built_in.motion.step_rate, spec::StepRate::AtLeast(_)))
}

/// The profile with other values.
fn changed(dice: &mut Dice, text: &str) -> String {
    let mut text = text.to_owned();
    let mut replace = |old: &str, new: String| {
        if text.contains(old) {
            text = text.replacen(old, &new, 1);
        }
    };
    if dice.chance(0.4) {
        let mut side = || mm(dice.uniform(100.0, 1500.0).round());
        replace("x = \"unknown\"\ny = \"unknown\"", format!("x = {}\ny = {}", side(), side()));
    }
    if dice.chance(0.5) {
        replace("ramp = \"3 mm\"", format!("ramp = {}", mm(dice.decades(0.05, 20.0))));
    }
    if dice.chance(0.3) {
        replace("contact = \"-0.3 mm\"", format!("contact = {}", mm(dice.uniform(-6.0, 0.0))));
    }
    if dice.chance(0.2) {
        replace("travel = \"5 mm\"", format!("travel = {}", mm(dice.uniform(0.5, 25.0))));
    }
    if dice.chance(0.3) {
        let [old, new] = if dice.chance(0.5) { ["false", "true"] } else { ["true", "false"] };
        replace(&format!("arcs = {old}"), format!("arcs = {new}"));
        if dice.chance(0.7) {
            replace("\"G17\", \"G90\"", "\"G17\", \"G91.1\", \"G90\"".to_owned());
        }
    }
    if dice.chance(0.3) {
        replace("thumbnails = false", "thumbnails = true".to_owned());
    }
    if dice.chance(0.2) {
        replace("x_steps_per_mm = 80 ", format!("x_steps_per_mm = {} ", 10 + dice.below(800)));
        replace("y_steps_per_mm = 80", format!("y_steps_per_mm = {}", 10 + dice.below(800)));
    }
    if dice.chance(0.2) {
        replace("line_length = 72", format!("line_length = {}", 72 + dice.below(180)));
    }
    if dice.chance(0.2) {
        replace("step = \"1 ms\"", format!("step = \"{} ms\"", 1 + dice.below(100)));
    }
    for _ in 0..if dice.chance(0.4) { 1 + dice.below(4) } else { 0 } {
        let [x, y] = [dice.uniform(0.0, 600.0), dice.uniform(0.0, 600.0)];
        let [w, d] = [dice.uniform(1.0, 40.0), dice.uniform(1.0, 40.0)];
        let _ = write!(
            text,
            "\n[[keep_out]]\nname = \"clamp\"\nx = \"{x} mm\"\ny = \"{y} mm\"\nwidth = \"{w} mm\"\ndepth = \"{d} mm\"\n"
        );
        if dice.chance(0.3) {
            let _ = writeln!(text, "height = \"{} mm\"", dice.uniform(0.5, 8.0));
        }
    }
    text
}
