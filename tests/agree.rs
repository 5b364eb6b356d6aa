//! What `check` lets pass, `build` can prove: there is no finding about outputs that no refusal named before.
//!
//! 500 random specs on random machines in `make test`; ten thousand with
//! `PROPTEST_CASES=10000 cargo test --release --locked --test agree`.

mod support;

use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use stargrip_cam::artifact::Asked;
use stargrip_cam::pipeline::{Forecast, Sources};
use stargrip_cam::spec;
use stargrip_cam::spec::Source;

use support::Shape;

/// What may stand in a spec beside its star.
#[derive(Clone, Debug)]
struct Rest {
    sheet: Option<(f64, f64)>,
    margin: f64,
    turn: bool,
    count: u32,
    inlet: &'static str,
    band: f64,
    overlap: f64,
    hole_allowance: f64,
    load: Option<(f64, f64)>,
    model: &'static str,
    by_sheet: bool,
    chop: bool,
}

/// What may be different about a machine.
#[derive(Clone, Debug)]
struct Bench {
    profile: &'static str,
    area: Option<(f64, f64)>,
    clamp: Option<(f64, f64)>,
    ramp: f64,
}

fn rests() -> impl Strategy<Value = Rest> {
    let page = (
        prop::option::weighted(0.4, (60.0..400.0_f64, 60.0..400.0_f64)),
        0.0..30.0_f64,
        any::<bool>(),
        1_u32..4,
        prop_oneof![
            Just(""),
            Just("[inlet]\nnone = true\n"),
            Just("[inlet]\ntip = 2\n"),
            Just("[inlet]\ntube_diameter = \"8 mm\"\nlength = \"30 mm\"\n")
        ],
    );
    let seal = (0.5..6.0_f64, 0.5..15.0_f64, 0.0..6.0_f64);
    let load = prop::option::weighted(0.4, (5.0..100.0_f64, 5.0..80.0_f64));
    let model = prop_oneof![4 => Just("auto"), 1 => Just("fit"), 1 => Just("ring")];
    (page, seal, load, model, any::<bool>(), any::<bool>()).prop_map(
        |(
            (sheet, margin, turn, count, inlet),
            (band, overlap, hole_allowance),
            load,
            model,
            by_sheet,
            chop,
        )| {
            Rest {
                sheet,
                margin,
                turn,
                count,
                inlet,
                band,
                overlap,
                hole_allowance,
                load,
                model,
                by_sheet,
                chop,
            }
        },
    )
}

fn benches() -> impl Strategy<Value = Bench> {
    let profiles: Vec<&'static str> = spec::builtin_machines().collect();
    let area = prop::option::weighted(0.6, (80.0..400.0_f64, 80.0..400.0_f64));
    let clamp = prop::option::weighted(0.2, (0.0..400.0_f64, 0.0..400.0_f64));
    (prop::sample::select(profiles), area, clamp, 0.5..8.0_f64)
        .prop_map(|(profile, area, clamp, ramp)| Bench { profile, area, clamp, ramp })
}

impl Rest {
    fn toml(&self, shape: &Shape, bench: &Bench) -> String {
        let sheet =
            self.sheet.map_or(String::new(), |(w, h)| format!("width = \"{w} mm\"\nheight = \"{h} mm\"\n"));
        let load = self.load.map_or(String::new(), |(pressure, radius)| {
            format!(
                "[load]\npressure = \"{pressure} kPa\"\nobject_radius = \"{radius} mm\"\nfriction = 0.5\n"
            )
        });
        format!(
            "{}[stack]\ncount = {}\n{}[seal]\nband = \"{} mm\"\noverlap = \"{} mm\"\nhole_allowance = \"{} mm\"\n\
             [sheet]\nmargin = \"{} mm\"\nturn = {}\n{sheet}{load}[accuracy]\nmodel = \"{}\"\n\
             [machine]\nprofile = \"{}\"\nprogram = \"{}\"\nfeed_floor = \"{}\"\n",
            shape.toml(),
            self.count,
            self.inlet,
            self.band,
            self.overlap,
            self.hole_allowance,
            self.margin,
            self.turn,
            self.model,
            bench.profile,
            if self.by_sheet { "sheet" } else { "star" },
            if self.chop { "chop" } else { "refuse" },
        )
    }
}

impl Bench {
    /// The built-in profile with this bench's values.
    fn toml(&self) -> String {
        let mut text = spec::builtin_machine(self.profile).expect("built in").to_owned();
        if let Some((x, y)) = self.area {
            text =
                text.replace("x = \"unknown\"\ny = \"unknown\"", &format!("x = \"{x} mm\"\ny = \"{y} mm\""));
        }
        text = text.replace("ramp = \"3 mm\"", &format!("ramp = \"{} mm\"", self.ramp));
        if let Some((x, y)) = self.clamp {
            let clamp = format!(
                "\n[[keep_out]]\nx = \"{x} mm\"\ny = \"{y} mm\"\nwidth = \"15 mm\"\ndepth = \"15 mm\"\n"
            );
            text.push_str(&clamp);
        }
        text
    }
}

/// Small stars, so that many fit and many do not.
fn stars() -> impl Strategy<Value = Shape> {
    (3_u32..=12)
        .prop_flat_map(|n| {
            let angle = 5.0..(178.0 - 360.0 / f64::from(n)).max(6.0);
            (Just(n), angle, 4.0..45.0_f64, 0.1..3.0_f64, prop_oneof![Just(0.0), 0.0..0.5_f64])
        })
        .prop_map(|(n, phi_i, w, arm, r)| Shape { n, phi_i, w, l: arm * w, r_i: r * w, r_e: r * w })
        .prop_filter("a hole to grip in", |shape| shape.rho_0() > 0.1 * shape.w)
}

/// Builds what `check` lets pass; whether there was anything to build.
fn agree(shape: &Shape, rest: &Rest, bench: &Bench) -> Result<bool, TestCaseError> {
    let (text, profile) = (rest.toml(shape, bench), bench.toml());
    let Ok(reading) = spec::read(&Source::new("spec", text.as_str())) else { return Ok(false) };
    let machine = spec::read_machine(&Source::new("machine", profile.as_str())).expect("a valid profile");
    // Everything that `check` looks at.
    let Ok(forecast) = Forecast::of(reading.spec, machine) else { return Ok(false) };
    let built = forecast.build(Sources { spec: &text, machine: &profile }, &Asked::default());
    let findings = built.proof().findings;
    prop_assert!(findings.is_empty(), "{:#?}\n{text}\n{profile}", &findings[..findings.len().min(5)]);
    Ok(true)
}

#[test]
fn what_check_lets_pass_build_can_prove() {
    let config = ProptestConfig::default();
    // As many as were asked for; without that, as many as a developer waits for.
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() { config.cases } else { 500 };
    let reached = std::cell::Cell::new(0);
    let mut runner = TestRunner::new(ProptestConfig {
        cases,
        max_global_rejects: 100_000,
        failure_persistence: None,
        ..config
    });
    let outcome = runner.run(&(stars(), rests(), benches()), |(shape, rest, bench)| {
        reached.set(reached.get() + u32::from(agree(&shape, &rest, &bench)?));
        Ok(())
    });
    assert!(outcome.is_ok(), "{}", outcome.err().map_or(String::new(), |error| error.to_string()));
    assert!(reached.get() > cases / 20, "only {} of {cases} specs were built", reached.get());
    println!("{} of {cases} specs were built", reached.get());
}
