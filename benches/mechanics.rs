//! What each model costs. `cargo bench --bench mechanics`

use divan::{Bencher, black_box};
use stargrip_cam::design::Design;
use stargrip_cam::forecast::candidate::Candidate;
use stargrip_cam::forecast::predict::predict;
use stargrip_cam::forecast::sweep::{Axis, Sweep};
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::bvp::Bvp;
use stargrip_cam::mechanics::hinge::ring::{Ring, RingTable};
use stargrip_cam::spec;
use stargrip_cam::spec::{Source, Spec, read, starter};

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
    bencher.bench_local(|| table.at(black_box(r_star)).expect("in range"));
}

/// Making the series.
#[divan::bench]
fn table_new() -> RingTable {
    RingTable::new().expect("solved")
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
    let axes = axes.map(|text| Axis::parse(text).expect("valid")).to_vec();
    let sweep = Sweep::new(Candidate::of(&star()).expect("a star"), axes).expect("small");
    assert_eq!(sweep.rows(), 1_000_000);
    bencher.bench_local(|| {
        let mut bytes = 0;
        sweep.run(0..sweep.rows(), |text, _| {
            bytes += text.len();
            true
        });
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
    let load = "\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nfriction = 0.5\n";
    let text = starter("bench").expect("a name") + load;
    read(&Source::new("bench", text)).expect("valid").spec
}
