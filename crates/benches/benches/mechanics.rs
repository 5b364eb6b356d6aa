//! Time of each model. `cargo bench -p benches --bench mechanics`

use divan::{Bencher, black_box};
use stargrip_cam::design::Design;
use stargrip_cam::forecast::predict::predict;
use stargrip_cam::forecast::study::{Study, csv};
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::bvp::Bvp;
use stargrip_cam::mechanics::hinge::ring::{Ring, RingTable};
use stargrip_cam::mechanics::hinge::section::{Section, SectionTable};
use stargrip_cam::spec;
use stargrip_cam::spec::study::Axis;
use stargrip_cam::spec::{Source, Spec, read, starter};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

fn main() {
    divan::main();
}

const R_STARS: [f64; 4] = [0.0, 0.1, 1.0, 1e4];

/// lambda_t with V'' of one hinge.
#[divan::bench(args = R_STARS)]
fn ring_target(r_star: f64) -> f64 {
    Ring.target(black_box(r_star)).expect("solved").curvature
}

/// One hinge at any lambda, including the search for the onset.
#[divan::bench(args = R_STARS)]
fn ring_state(r_star: f64) -> f64 {
    Ring.state(black_box(r_star), 1.35).expect("solved").slope
}

/// All target quantities of one hinge from the series.
#[divan::bench(args = R_STARS)]
fn table_entry(bencher: Bencher, r_star: f64) {
    let table = RingTable::new().expect("solved");
    bencher.bench_local(|| table.target(black_box(r_star)).expect("in range"));
}

/// Making the series.
#[divan::bench]
fn table_new() -> RingTable {
    RingTable::new().expect("solved")
}

/// (1/eps, t/W, R*) of a soft, a working and a fully actuated hinge, and of a point.
const SECTIONS: [(f64, f64, f64); 4] =
    [(10.0, 0.003, 0.1), (330.0, 0.015, 0.1), (1e4, 0.003, 1.0), (330.0, 0.015, 0.0)];

/// A hinge at its pressure, with its stiffness, without a starting shape.
#[divan::bench(args = SECTIONS)]
fn section_target((bendability, thickness, r_star): (f64, f64, f64)) -> f64 {
    let section = Section::new(black_box(bendability), thickness, 0.39).expect("in range");
    section.target(r_star).expect("found").curvature
}

/// The same with its moment at ten more angles, each followed from the one before.
#[divan::bench]
fn section_curve_of_ten_angles() -> f64 {
    let section = Section::new(black_box(330.0), 0.015, 0.39).expect("in range");
    let lambdas = [1.1, 1.12, 1.14, 1.16, 1.18, 1.2, 1.22, 1.24, 1.26, 1.28];
    section.curve(0.1, &lambdas).expect("found")[9].slope
}

/// The same hinge from its table, if one of its numbers changes from look-up to look-up.
#[divan::bench(args = ["R*", "1/eps", "t/W", "nu"])]
fn section_table_entry(bencher: Bencher, changing: &str) {
    let table = SectionTable::shipped().expect("readable");
    let mut larger = false;
    bencher.bench_local(|| {
        larger = !larger;
        let of = |name, value: f64| if larger && name == changing { 1.01 * value } else { value };
        let scales = [of("1/eps", 330.0), of("t/W", 0.015), of("nu", 0.39)];
        table.entry(black_box(scales[0]), scales[1], scales[2], of("R*", 0.1)).expect("in range")
    });
}

/// One lambda of the penalised problem, continuation included.
#[divan::bench(args = [0.0, 0.1, 1.0, 10.0, 100.0], max_time = 2)]
fn bvp_state_at_beta_1000(r_star: f64) -> f64 {
    [1.0, 1.28, 1.5].map(|lambda| Bvp::default().state(black_box(r_star), lambda).expect("solved").slope)[1]
}

/// A million designs: closing, stiffness, operating pressure, force, payload; every line as text.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn sweep_of_a_million_designs(bencher: Bencher) {
    let axes =
        ["star.points=3,4,5,6", "star.tube_width=10 mm..40 mm/500", "star.tip_angle=15 deg..60 deg/500"];
    sweep(bencher, &axes, 1_000_000);
}

/// Ten thousand designs in which one key changes from row to row.
#[divan::bench(sample_count = 20, sample_size = 1, args = [
    "star.tip_angle=15 deg..45 deg/2500",
    "star.tube_width=15 mm..30 mm/2500",
    "load.pressure=15 kPa..50 kPa/2500",
    "star.tip_radius=0.1 mm..3 mm/2500",
    "fabric.poisson_ratio=0.2..0.45/2500",
])]
fn sweep_of_ten_thousand_designs(bencher: Bencher, fastest: &str) {
    sweep(bencher, &["star.points=4,5", "star.inner_radius=45 mm,50 mm", fastest], 10_000);
}

/// The designs of `axes`, every line as text.
fn sweep(bencher: Bencher, axes: &[&str], rows: usize) {
    let axes = axes.iter().map(|text| Axis::parse(text).expect("valid")).collect();
    let study = Study::vary(&source(), axes).expect("valid").expect("small");
    assert_eq!(study.rows(), rows);
    bencher.bench_local(|| {
        let mut bytes = 0;
        let never = Arc::new(AtomicBool::new(false));
        let take = |text: Vec<u8>, _| {
            bytes += text.len();
            true
        };
        assert!(study.run(0..study.rows(), &never, |batch| csv::lines(&batch), take));
        bytes
    });
}

/// A whole prediction of a design.
#[divan::bench]
fn prediction(bencher: Bencher) {
    let spec = star();
    let profile = Source::new("generic", spec::builtin_machine("generic").expect("built in"));
    let machine = spec::read_machine(&profile).expect("valid");
    let design = Design::new(&spec, &machine).expect("makeable");
    bencher.bench_local(|| predict(black_box(&spec), &design).expect("predictable"));
}

fn star() -> Spec {
    read(&source()).expect("valid").spec
}

fn source() -> Source {
    let load = "\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nfriction = 0.5\n";
    let text = starter("bench").expect("a name") + load;
    Source::new("bench", text)
}
