//! Jobs of absurd size are refused with a message, before anything large is made.

use stargrip_cam::design::{Refusal, RefusalCode};
use stargrip_cam::pipeline::Planned;
use stargrip_cam::spec::{Source, key, read, read_machine};

use crate::profile;

fn refusal(radius: f64, rest: &str, machine: &str) -> Option<Refusal> {
    let text = format!(
        "schema = 1\nname = \"large\"\n[star]\npoints = 5\ninner_radius = \"{radius} m\"\ntube_width = \"30 mm\"\n\
         tip_angle = \"30 deg\"\n{rest}"
    );
    let spec = read(&Source::new("spec", &text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
    let machine = read_machine(&Source::new("machine", machine)).unwrap_or_else(|faults| panic!("{faults}"));
    let planned = Planned::new(spec, machine);
    planned.err().map(|refusals| refusals.first().expect("a reason").clone())
}

#[test]
fn a_program_of_weeks_is_refused() {
    let time_refusal = refusal(3.0, "", profile("generic")).expect("1.4e6 s");
    assert_eq!((time_refusal.key, time_refusal.code), (key::seal::SPEED, RefusalCode::JobTooLarge));
    assert!(
        time_refusal.found.starts_with("a program takes 37")
            && time_refusal.remedy.contains("less than 278 h"),
        "{time_refusal}"
    );
    assert_eq!(refusal(2.0, "", profile("generic")), None);
}

#[test]
fn so_many_strokes_are_refused_and_as_many_smooth_moves_are_not() {
    let chopped = "[stack]\ncount = 16\n[machine]\nfeed_floor = \"chop\"\n";
    let size_refusal =
        refusal(1.0, chopped, profile("grbl")).expect("16 stars of 45 m in strokes of 0.154 mm");
    assert_eq!((size_refusal.key, size_refusal.code), (key::stack::COUNT, RefusalCode::JobTooLarge));
    assert_eq!(refusal(1.0, "[stack]\ncount = 16\n", profile("generic")), None);
}

/// 33 million moves take 1.7 GB: they are counted, not made.
#[test]
fn a_stack_that_no_memory_holds_is_refused_by_its_count() {
    let count_refusal = refusal(30.0, "[stack]\ncount = 64\n", profile("generic")).expect("64 stars of 30 m");
    assert_eq!((count_refusal.key, count_refusal.code), (key::stack::COUNT, RefusalCode::JobTooLarge));
    assert!(count_refusal.found.contains("moves in contact"), "{count_refusal}");
}
