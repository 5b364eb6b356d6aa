//! The grid: accelerations from 10 to 1,000 mm/s^2, 80 to 800 steps/mm, every dialect, every shipped design.

use std::collections::BTreeMap;

use crate::controller::{Motors, run};
use crate::judge::{Deviations, deviations};
use crate::programs::{DIALECTS, Named, coupon_programs, feed_check, has_floor, machine, seals, spec};
use crate::text::Text;

const ACCELERATIONS: [f64; 6] = [10.0, 25.0, 50.0, 200.0, 500.0, 1000.0];
const STEPS: [f64; 5] = [80.0, 160.0, 320.0, 432.0, 800.0];

const DESIGNS: [(&str, &str); 10] = [
    ("basketball-gripper", include_str!("../../designs/basketball-gripper.toml")),
    ("basketball", include_str!("../../designs/basketball.toml")),
    ("conical-stack", include_str!("../../designs/conical-stack.toml")),
    ("paper-eight-points", include_str!("../../designs/paper-eight-points.toml")),
    ("paper-five-points", include_str!("../../designs/paper-five-points.toml")),
    ("paper-four-points", include_str!("../../designs/paper-four-points.toml")),
    ("paper-gripper", include_str!("../../designs/paper-gripper.toml")),
    ("paper-six-points", include_str!("../../designs/paper-six-points.toml")),
    ("paper-three-points", include_str!("../../designs/paper-three-points.toml")),
    ("round-hinges", include_str!("../../designs/round-hinges.toml")),
];

/// The motors of a dialect: one number of steps stands for all where they do not count.
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
    fn take(&mut self, dialect: &str, motors: Motors, speed: f64, (name, code): &Named) {
        let text = Text::read(code);
        let speed = text.fact("seal.speed_mm_s").unwrap_or(speed);
        let (found, complaints) =
            deviations(&text, &run(dialect, &text, motors), speed, motors.slack(dialect, speed));
        self.programs += 1;
        self.chopped += usize::from(code.contains("\nG4 "));
        let most = &mut self.most;
        most.mean = if found.mean.abs() > most.mean.abs() { found.mean } else { most.mean };
        most.total = if found.total.abs() > most.total.abs() { found.total } else { most.total };
        most.window = most.window.max(found.window);
        let Motors { acceleration, steps_per_mm } = motors;
        let place = format!("{dialect}, {acceleration} mm/s^2, {steps_per_mm} steps/mm, {name}");
        self.complaints.extend(complaints.into_iter().map(|complaint| format!("{place}: {complaint}")));
    }
}

/// The three lines of the feed check, on every machine of the grid.
#[test]
fn the_feed_check_is_right_on_every_machine_of_the_grid() {
    let mut worst = Worst::default();
    for dialect in DIALECTS {
        let spec = spec(dialect, crate::FIVE);
        for motors in motors(dialect) {
            worst.take(dialect, motors, spec.seal.speed.0, &feed_check(&spec, &machine(dialect, motors)));
        }
    }
    assert!(worst.complaints.is_empty(), "{:#?}", worst.complaints);
}

/// Every program of every design, or of those whose names are in the variable `CLOCK_DESIGNS`: minutes.
/// `cargo test --release --locked --test clock -- --ignored --nocapture`
#[test]
#[ignore = "takes minutes; its table is in docs/machines.md"]
fn every_program_on_every_machine_of_the_grid() {
    let mut table: BTreeMap<(&str, &str), Worst> = BTreeMap::new();
    let chosen = std::env::var("CLOCK_DESIGNS").ok();
    let is_chosen =
        |name: &str| chosen.as_ref().is_none_or(|chosen| chosen.split(',').any(|one| one == name));
    for dialect in DIALECTS {
        for motors in motors(dialect) {
            let machine = machine(dialect, motors);
            for (name, design) in DESIGNS.iter().filter(|(name, _)| is_chosen(name)) {
                let spec = spec(dialect, design);
                let mut take = |kind, program: &Named| {
                    table.entry((dialect, kind)).or_default().take(
                        dialect,
                        motors,
                        spec.seal.speed.0,
                        program,
                    );
                };
                seals(&spec, &machine).0.iter().for_each(|program| take("seal", program));
                // These do not depend on the design.
                if *name == "paper-five-points" {
                    take("feedcheck", &feed_check(&spec, &machine));
                    for program in &coupon_programs(&spec, &machine) {
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
