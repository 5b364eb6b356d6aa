//! Specs that `check` once passed and `build` refused, each with the fault that it found.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::{Forecast, Sources, prove_files};
use stargrip_cam::spec;
use stargrip_cam::spec::{Machine, Source};
use stargrip_cam::verify::gcode::Dialect;

/// A star with its inner radius, and the rest of its spec.
fn star(radius: f64, rest: &str) -> String {
    format!(
        "schema = 1\nname = \"named\"\n[star]\npoints = 5\ninner_radius = \"{radius} mm\"\ntube_width = \"30 mm\"\n\
         tip_angle = \"30 deg\"\n{rest}"
    )
}

fn profile(name: &str) -> &'static str {
    spec::builtin_machine(name).expect("built in")
}

/// The findings of `verify` about the files with these kinds, of a spec that `check` passes.
fn findings(text: &str, profile: &str, extras: &[Kind]) -> Vec<String> {
    let reading = spec::read(&Source::new("spec", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let machine =
        spec::read_machine(&Source::new("own", profile)).unwrap_or_else(|faults| panic!("{faults}"));
    let forecast = Forecast::new(reading.spec, machine).unwrap_or_else(|refusals| panic!("{refusals}"));
    let request = KindRequest { with: extras.to_vec(), ..KindRequest::default() };
    let built = forecast.build(Sources { spec: text, machine: profile }, &request);
    prove_files(&built.output_files()).findings.iter().map(ToString::to_string).collect()
}

/// The codes with which `check` refuses a spec on a profile.
fn refused(text: &str, profile: &str) -> Vec<String> {
    let reading = spec::read(&Source::new("spec", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let machine: Machine =
        spec::read_machine(&Source::new("own", profile)).unwrap_or_else(|faults| panic!("{faults}"));
    let refusals = Forecast::new(reading.spec, machine).err().unwrap_or_default();
    refusals.iter().map(|refusal| refusal.code.to_string()).collect()
}

/// A number of chords that was not a multiple of four missed the top and the bottom of a plate.
#[test]
fn a_plate_in_a_scene_is_as_high_as_wide() {
    for radius in [70.0, 200.0] {
        assert_eq!(findings(&star(radius, ""), profile("generic"), &[Kind::SceneGlb]), [""; 0], "{radius}");
    }
}

/// The edges of windows lay on the edge of the plate.
#[test]
fn windows_at_the_edge_of_the_plate_are_refused_and_a_narrow_rim_is_made() {
    let bordered = |border: &str, round: &str| {
        let rest = format!("{round}[seal]\nallowance = \"0 mm\"\n[mask]\nborder = \"{border}\"\n");
        star(50.0, &rest)
    };
    for round in ["", "corner_radius = \"15 mm\"\n"] {
        for border in ["0 mm", "0.001 mm", "0.099 mm"] {
            assert_eq!(refused(&bordered(border, round), profile("generic")), ["thin-rim"], "{border}");
        }
        assert_eq!(findings(&bordered("0.1 mm", round), profile("generic"), &[]), [""; 0], "{round}");
    }
}

/// A height is written to a thousandth, which of a thin mask is more than its edges may be off.
#[test]
fn a_thin_mask_in_a_scene_has_its_volume_but_for_rounding() {
    let text = "schema = 1\nname = \"x\"\n[star]\npoints = 57\ninner_radius = \"978.66 mm\"\ntube_width = \"51.17 mm\"\n\
                tip_angle = \"56.18 deg\"\n[inlet]\nnone = true\n[seal]\nspeed = \"3 mm/s\"\n[mask]\nthickness = \"0.2625 mm\"\n";
    assert_eq!(findings(text, profile("generic"), &[Kind::SceneGlb]), [""; 0]);
}

/// 65 strokes on a ramp of 0.05 mm each began where the one before had ended.
#[test]
fn a_ramp_without_length_is_refused_and_the_length_that_the_remedy_names_is_not() {
    let chop = star(50.0, "[machine]\nprofile = \"own.toml\"\nfeed_floor = \"chop\"\n");
    let with_ramp = |ramp: &str| {
        let text = profile("grbl").replace("contact = \"-0.3 mm\"", "contact = \"-5 mm\"");
        text.replace("ramp = \"3 mm\"", &format!("ramp = \"{ramp} mm\""))
    };
    assert_eq!(refused(&chop, &with_ramp("0.005")), ["steep-ramp"]);
    let reading = spec::read(&Source::new("spec", &chop)).unwrap_or_else(|faults| panic!("{faults}"));
    let machine = spec::read_machine(&Source::new("own", with_ramp("0.005"))).expect("valid");
    let refusals = Forecast::new(reading.spec, machine).expect_err("steep");
    let shortest = refusals[0].remedy.split(' ').find(|word| word.parse::<f64>().is_ok()).expect("a length");
    assert_eq!(findings(&chop, &with_ramp(shortest), &[]), [""; 0], "{shortest}");
}

/// Programs have three decimals; without rounding first, the iron went deeper than set, or below the height of its travels.
#[test]
fn heights_of_a_profile_are_those_of_its_programs() {
    let text = profile("grbl").replace("contact = \"-0.3 mm\"", "contact = \"-2.6238638162612915 mm\"");
    let text = text.replace("travel = \"5 mm\"", "travel = \"7.36466 mm\"");
    let spec = star(50.0, "[seal]\nspeed = \"1 mm/s\"\n[machine]\nprofile = \"own.toml\"\n");
    assert_eq!(findings(&spec, &text, &[]), [""; 0]);
}

/// A page has no place for the two code points, so that a report of this name could not be read back.
#[test]
fn a_name_consists_of_characters() {
    for c in ["\\uFFFE", "\\uFFFF"] {
        let text = star(50.0, "").replace("named", &format!("a{c}b"));
        let faults = spec::read(&Source::new("spec", text)).expect_err("no character");
        assert_eq!(faults.list()[0].code, "name", "{faults}");
    }
}

/// Stars of one kind shared the first one's mesh, which on a ball closes less far than those beside its middle.
#[test]
fn each_star_of_a_scene_closes_on_the_ball_at_its_own_height() {
    let load = "[stack]\ncount = 3\n[load]\npressure = \"37 kPa\"\nobject_radius = \"45 mm\"\n";
    assert_eq!(findings(&star(50.0, load), profile("generic"), &[Kind::SceneGlb]), [""; 0]);
}

/// The comment for the operator was cut in its last word by the digits of a temperature, and compared with all of them.
#[test]
fn a_temperature_with_many_digits_is_the_operators_too() {
    let spec = star(50.0, "[seal]\ntemperature = \"282.89015823602676 C\"\n");
    for name in ["generic", "linuxcnc"] {
        let spec = format!("{spec}[machine]\nprofile = {name:?}\n");
        assert_eq!(findings(&spec, profile(name), &[]), [""; 0], "{name}");
    }
}

/// A trace was timed along its arcs, and is written as chords.
#[test]
fn a_coarse_trace_states_the_time_of_its_chords() {
    let text = profile("generic").replace("trace = \"20 mm/s\"", "trace = \"1 mm/s\"");
    let spec = star(50.0, "[accuracy]\npath = \"1 mm\"\n[machine]\nprofile = \"own.toml\"\n");
    assert_eq!(findings(&spec, &text, &[]), [""; 0]);
}

/// A profile could have longer lines than its dialect, and long figures then filled them.
#[test]
fn a_profile_has_no_longer_lines_than_its_dialect() {
    for dialect in spec::Dialect::ALL.map(|(_, dialect)| Dialect::new(dialect)) {
        let text = |length: usize| {
            let text = profile(dialect.name);
            let line = text.lines().find(|line| line.starts_with("line_length")).expect("a length");
            text.replace(line, &format!("line_length = {length}"))
        };
        let longest = dialect.line_length.min(255);
        let machine = spec::read_machine(&Source::new("own", text(longest)));
        assert_eq!(machine.expect("valid").controller.line_length, longest, "{}", dialect.name);
        if longest < 255 {
            let faults = spec::read_machine(&Source::new("own", text(longest + 1))).expect_err("too long");
            assert_eq!(faults.list()[0].code, "conflict", "{faults}");
        }
    }
    let seal = "[seal]\nspeed = \"2.6086207022772157 mm/s\"\nband = \"1.6123456789 mm\"\n\
                [machine]\nprofile = \"own.toml\"\n";
    assert_eq!(findings(&star(50.0, seal), profile("generic"), &[]), [""; 0]);
}

/// Chopped moves had 1.2 times the lowest feed of the plane, which ramps are below where Z has few steps.
#[test]
fn chopped_moves_are_held_on_ramps_of_a_coarse_z() {
    let text = [("x", 80, 463), ("y", 80, 463), ("z", 400, 200)].into_iter().fold(
        profile("fluidnc").to_owned(),
        |text, (axis, old, new)| {
            let [old, new] = [old, new].map(|steps| format!("{axis}_steps_per_mm = {steps}"));
            assert!(text.contains(&old), "{old}");
            text.replace(&old, &new)
        },
    );
    let spec = star(50.0, "[machine]\nprofile = \"own.toml\"\nfeed_floor = \"chop\"\n");
    assert_eq!(findings(&spec, &text, &[]), [""; 0]);
}

/// Beside an arm of 0.13 mm Marlin joins moves that go back on each other, and the wait after them would be too long for one place.
#[test]
fn a_corner_at_which_the_iron_would_rest_for_too_long_is_refused() {
    let text = "schema = 1\nname = \"x\"\n[star]\npoints = 4\ninner_radius = \"5.191886932942953 mm\"\n\
                tube_width = \"9.541801810117967 mm\"\ntip_angle = \"18.980064392089844 deg\"\n\
                [inlet]\ntube_diameter = \"1.2796252271151292 mm\"\nlength = \"10.846852452343184 mm\"\n\
                [seal]\noverlap = \"6.811753511428833 mm\"\n[sheet]\nmargin = \"29.766620993614197 mm\"\n\
                [machine]\nprofile = \"marlin\"\nfeed_floor = \"chop\"\n";
    assert_eq!(refused(text, profile("marlin")), ["no-chop"]);
    // A machine with finer steps makes each of these moves.
    let fine = ["x", "y"].into_iter().fold(profile("marlin").to_owned(), |text, axis| {
        text.replace(&format!("{axis}_steps_per_mm = 80"), &format!("{axis}_steps_per_mm = 320"))
    });
    let own_profile = text.replace("\"marlin\"", "\"own.toml\"");
    assert_eq!(findings(&own_profile, &fine, &[]), [""; 0]);
}

/// A hole that a coarse `path` rounds to nothing was written as a circle of radius 0.
#[test]
fn a_registration_hole_that_would_be_rounded_away_is_refused() {
    let text = |hole: &str| {
        star(50.0, &format!("[sheet]\nhole_diameter = \"{hole}\"\n[accuracy]\npath = \"1 mm\"\n"))
    };
    for hole in ["0.00091 mm", "0.199 mm"] {
        let faults = spec::read(&Source::new("spec", text(hole))).expect_err(hole);
        assert_eq!(faults.list()[0].code, "out-of-range", "{hole}");
    }
    for hole in ["0 mm", "0.2 mm"] {
        assert_eq!(findings(&text(hole), profile("generic"), &[]), [""; 0], "{hole}");
    }
}

/// A cut that leaves less than a micrometre of a hole was written as a circle of radius 0.
#[test]
fn a_cut_nearly_as_wide_as_a_hole_is_refused() {
    for (rest, code) in
        [("[cut]\nkerf = \"2.9991 mm\"\n", "wide-kerf"), ("[frame]\nkerf = \"5.9999 mm\"\n", "wide-kerf")]
    {
        assert_eq!(refused(&star(50.0, rest), profile("generic")), [code], "{rest}");
    }
}
