//! CPU time of the stages of a build, as a library: `cargo bench -p benches --bench build`.

use std::hint::black_box;

use stargrip_cam::artifact::KindRequest;
use stargrip_cam::design::{CutEdge, Design, Drawing};
use stargrip_cam::pipeline::Sources;
use stargrip_cam::spec::{Machine, Source, Spec};
use stargrip_cam::{emit, pipeline, plan, spec};

const PAPER: &str = include_str!("../../../designs/paper-five-points.toml");

fn main() {
    divan::main();
}

fn generic() -> &'static str {
    spec::builtin_machine("generic").expect("built in")
}

fn machine() -> Machine {
    spec::read_machine(&Source::new("generic", generic())).expect("valid")
}

fn paper() -> Spec {
    spec::read(&Source::new("paper", PAPER)).expect("valid").spec
}

/// Plan, G-code (seal and trace), SVG and DXF of a stack of paper stars, for a controller that draws arcs.
#[divan::bench(args = [1, 10, 100, 1000], sample_count = 20)]
fn plan_and_emit(bencher: divan::Bencher, stars: usize) {
    planned_and_emitted(bencher, &Machine::builtin("linuxcnc").expect("built in"), stars);
}

/// The same in chords, of which a star has five times as many.
#[divan::bench(args = [1, 10, 100, 1000], sample_count = 20)]
fn plan_and_emit_chords(bencher: divan::Bencher, stars: usize) {
    planned_and_emitted(bencher, &machine(), stars);
}

fn planned_and_emitted(bencher: divan::Bencher, machine: &Machine, stars: usize) {
    let mut spec = paper();
    spec.stars = vec![spec.stars[0].clone(); stars];
    let design = Design::new(&spec, machine).expect("a design");
    bencher.bench(|| {
        let mut bytes = 0;
        let programs = plan::seal_programs(&spec, machine, &design);
        let traces = plan::trace_programs(&spec, machine, &design);
        bytes += programs
            .iter()
            .chain(&traces)
            .map(|program| emit::gcode(&spec, machine, program).len())
            .sum::<usize>();
        for sheet in &design.sheets {
            for drawing in
                [Drawing::seals(&design, sheet.index), Drawing::outlines(&design, sheet.index, CutEdge::Tool)]
            {
                let drawing = drawing.expect("a sheet");
                bytes += emit::svg("bench", &drawing, spec.accuracy.path, spec.cut.colours).len();
                bytes += emit::dxf(&drawing, spec.accuracy.path, spec.cut.colours).len();
            }
        }
        black_box(bytes)
    });
}

/// Reading the spec, with its faults or without.
#[divan::bench]
fn read_spec() -> Spec {
    paper()
}

/// The geometry of one star.
#[divan::bench]
fn design(bencher: divan::Bencher) {
    let (spec, machine) = (paper(), machine());
    bencher.bench(|| Design::new(black_box(&spec), &machine).expect("a design"));
}

/// Everything in memory, without the proof.
#[divan::bench]
fn build(bencher: divan::Bencher) {
    let (spec, machine) = (paper(), machine());
    let sources = Sources { spec: PAPER, machine: generic() };
    bencher.bench(|| {
        pipeline::build(black_box(&spec), &machine, sources, &KindRequest::default()).expect("a design")
    });
}

/// Reading every file back and comparing it with the exact geometry.
#[divan::bench]
fn prove(bencher: divan::Bencher) {
    let (spec, machine) = (paper(), machine());
    let sources = Sources { spec: PAPER, machine: generic() };
    let build = pipeline::build(&spec, &machine, sources, &KindRequest::default()).expect("a design");
    bencher.bench(|| build.proof());
}
