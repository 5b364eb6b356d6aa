//! The grid: accelerations from 10 to 1,000 mm/s^2, 80 to 800 steps/mm, every dialect, every shipped design.

use std::collections::BTreeMap;

use super::controller::{BOARDS, Board, Motors, run, run_marlin};
use super::judge::{Deviations, deviations};
use stargrip_cam::spec::Machine;

use super::marlin::Version;
use super::programs::{
    DIALECTS, Named, coupon_programs, feed_check, has_floor, machine, machine_of_marlin, seals, spec,
};
use super::text::Text;

const ACCELERATIONS: [f64; 6] = [10.0, 25.0, 50.0, 200.0, 500.0, 1000.0];
const STEPS: [f64; 5] = [80.0, 160.0, 320.0, 432.0, 800.0];

const DESIGNS: [(&str, &str); 10] = [
    ("basketball-gripper", include_str!("../../../designs/basketball-gripper.toml")),
    ("basketball", include_str!("../../../designs/basketball.toml")),
    ("conical-stack", include_str!("../../../designs/conical-stack.toml")),
    ("paper-eight-points", include_str!("../../../designs/paper-eight-points.toml")),
    ("paper-five-points", include_str!("../../../designs/paper-five-points.toml")),
    ("paper-four-points", include_str!("../../../designs/paper-four-points.toml")),
    ("paper-gripper", include_str!("../../../designs/paper-gripper.toml")),
    ("paper-six-points", include_str!("../../../designs/paper-six-points.toml")),
    ("paper-three-points", include_str!("../../../designs/paper-three-points.toml")),
    ("round-hinges", include_str!("../../../designs/round-hinges.toml")),
];

/// A controller: a dialect, and the board if it is Marlin.
type Controller = (&'static str, Option<Board>);

/// The controllers for the programs of a dialect, each with its profile on these motors.
fn boards(dialect: &'static str, motors: Motors) -> Vec<(Controller, Machine)> {
    if dialect == "marlin" {
        let own = |board| (("marlin", Some(board)), machine_of_marlin(motors, board));
        return BOARDS.map(own).into();
    }
    vec![((dialect, None), machine(dialect, motors))]
}

fn name((dialect, board): Controller) -> String {
    match board {
        Some(Board { bits, version }) => {
            let version = if version == Version::Two { "2.0.x" } else { "newest" };
            format!("{dialect} {version}, {bits} bits")
        }
        None => dialect.to_owned(),
    }
}

/// The motors of a dialect: a single number of steps where it has no effect.
fn motors(dialect: &str) -> impl Iterator<Item = Motors> {
    let steps = if has_floor(dialect) { &STEPS[..] } else { &STEPS[..1] };
    ACCELERATIONS.into_iter().flat_map(move |acceleration| {
        steps.iter().map(move |&steps_per_mm| Motors { acceleration, steps_per_mm })
    })
}

/// The largest deviations of the programs of a kind.
#[derive(Default)]
struct Worst {
    programs: usize,
    chopped: usize,
    most: Deviations,
    complaints: Vec<String>,
}

impl Worst {
    /// Judges a program on a controller.
    fn take(&mut self, controller: Controller, motors: Motors, speed: f64, (program, code): &Named) {
        let text = Text::read(code);
        let speed = text.fact("seal.speed_mm_s").unwrap_or(speed);
        let track = match controller {
            (_, Some(board)) => run_marlin(&text, motors, board),
            (dialect, None) => run(dialect, &text, motors),
        };
        let (found, complaints) = deviations(&text, &track, speed, motors.stop(speed));
        self.programs += 1;
        self.chopped += usize::from(code.contains("\nG4 "));
        let most = &mut self.most;
        most.mean = if found.mean.abs() > most.mean.abs() { found.mean } else { most.mean };
        most.total = if found.total.abs() > most.total.abs() { found.total } else { most.total };
        most.window = most.window.max(found.window);
        let Motors { acceleration, steps_per_mm } = motors;
        let place =
            format!("{}, {acceleration} mm/s^2, {steps_per_mm} steps/mm, {program}", name(controller));
        self.complaints.extend(complaints.into_iter().map(|complaint| format!("{place}: {complaint}")));
    }
}

/// The three lines of the feed check, on every machine of the grid.
#[test]
fn the_feed_check_is_right_on_every_machine_of_the_grid() {
    let mut worst = Worst::default();
    for dialect in DIALECTS {
        let spec = spec(dialect, super::FIVE);
        for motors in motors(dialect) {
            for (controller, machine) in boards(dialect, motors) {
                worst.take(controller, motors, spec.seal.speed.0, &feed_check(&spec, &machine));
            }
        }
    }
    assert!(worst.complaints.is_empty(), "{:#?}", worst.complaints);
}

/// The names in the variable, or all.
fn chosen(variable: &str) -> impl Fn(&str) -> bool {
    let names = std::env::var(variable).ok();
    move |name| names.as_ref().is_none_or(|names| names.split(',').any(|one| one == name))
}

/// All programs of all designs and dialects, or of those in the variables `CLOCK_DESIGNS` and `CLOCK_DIALECTS`: minutes.
/// `cargo test --release --locked --test machines clock:: -- --ignored --nocapture`
#[test]
#[ignore = "takes minutes; its table is in docs/clock.md"]
fn every_program_on_every_machine_of_the_grid() {
    let mut table: BTreeMap<(String, &str), Worst> = BTreeMap::new();
    let (is_chosen, is_spoken) = (chosen("CLOCK_DESIGNS"), chosen("CLOCK_DIALECTS"));
    for dialect in DIALECTS.into_iter().filter(|dialect| is_spoken(dialect)) {
        for motors in motors(dialect) {
            let boards = boards(dialect, motors);
            let cases = DESIGNS.iter().filter(|(name, _)| is_chosen(name));
            for ((design_name, design), (controller, machine)) in
                cases.flat_map(|one| boards.iter().map(move |board| (one, board)))
            {
                let spec = spec(dialect, design);
                let mut take = |kind, program: &Named| {
                    let worst = table.entry((name(*controller), kind)).or_default();
                    worst.take(*controller, motors, spec.seal.speed.0, program);
                };
                seals(&spec, machine).0.iter().for_each(|program| take("seal", program));
                // These programs do not depend on the design.
                if *design_name == "paper-five-points" {
                    take("feedcheck", &feed_check(&spec, machine));
                    for program in &coupon_programs(&spec, machine) {
                        take("coupon", program);
                    }
                }
            }
        }
    }
    println!(
        "| dialect | program | programs | chopped | mean speed | windows | total |\n|---|---|---|---|---|---|---|"
    );
    for ((dialect, kind), Worst { programs, chopped, most, .. }) in &table {
        let Deviations { mean, window, total } = *most;
        let (mean, window, total) = (100.0 * mean, 100.0 * window, 100.0 * total);
        println!(
            "| {dialect} | {kind} | {programs} | {chopped} | {mean:+.2} % | {window:.1} % | {total:+.2} % |"
        );
    }
    let complaints: Vec<&String> = table.values().flat_map(|worst| &worst.complaints).collect();
    assert!(complaints.is_empty(), "{}: {:#?}", complaints.len(), complaints);
}
