//! The messages about faulty specs, word by word.

use stargrip_cam::spec::{Faults, Source, read, read_machine};

use super::{SHORTEST, codes, spec, try_read};

fn snapshot(name: &str, faults: &Faults) {
    insta::with_settings!({
        snapshot_path => concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"),
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, { insta::assert_snapshot!(format!("faults_{name}"), faults.to_string()) });
}

macro_rules! refused {
    ($($(#[$doc:meta])* $name:ident: $text:expr;)+) => {$(
        $(#[$doc])*
        #[test]
        fn $name() {
            snapshot(stringify!($name), &try_read(&$text).expect_err("faulty"));
        }
    )+};
}

refused! {
    /// An empty text.
    empty: "";
    /// Slips of the keyboard, keys in the wrong section, sections that do not exist.
    slips: "schema = 1\nname = \"slips\"\ntube_width = \"30 mm\"\n[stars]\npoints = 5\n[star]\npoints = 5\ninner_radius = \"50 mm\"\n\
        tube_widht = \"30 mm\"\ntip_angel = \"30 deg\"\nband = \"2 mm\"\ncolour = \"red\"\n[seal]\noverlapp = \"5 mm\"\n";
    /// Malformed quantities, or quantities of another kind.
    quantities: format!("{SHORTEST}corner_radius = 3\n[fabric]\nthickness = \"nan mm\"\nyoung_modulus = \"128 mpa\"\n\
        [seal]\ntemperature = \"473 K\"\nspeed = \"1e999 mm/s\"\nband = \"\"\noverlap = \"5\"\nallowance = true\n\
        [accuracy]\nresponse = \"10\"\n");
    /// Inputs of people who are used to other signs and names.
    habits: "schema = 1\nname = \"habits\"\n[star]\npoints = 5\ninner_radius = \"50,5 mm\"\ntube_width = \"2 inches\"\n\
        tip_angle = \"30\u{b0}\"\ncorner_radius = nan\n[stack]\nrotation = \"\u{2212}36 deg\"\n[sheet]\nmargin = \"1,5,5 mm\"\n";
    /// Values out of their ranges.
    ranges: "schema = 1\nname = \"ranges\"\n[star]\npoints = 1000000000\ninner_radius = \"-50 mm\"\ntube_width = \"1e300 mm\"\n\
        tip_angle = \"180 deg\"\n[fabric]\npoisson_ratio = nan\n[load]\nfriction = -inf\n[frame]\nposts = 2\n\
        [stack]\ncount = 99999999999999999999\nrotation = \"1e9 rad\"\n[accuracy]\npath = \"2 mm\"\nresponse = \"0 %\"\n";
    /// Wrong types.
    types: "schema = \"1\"\nname = 5\nseal = 3\nmask = []\n[star]\npoints = 5.0\ninner_radius = [1]\ntube_width = 1979-05-27\n\
        tip_angle = {}\n[sheet]\nturn = \"yes\"\n[fabric]\npoisson_ratio = \"0.39\"\n[machine]\nprofile = false\n";
    /// Broken TOML, and the faults that can still be reported about the rest.
    syntax: "schema = 1\nname = \"syntax\n[star\npoints = 5\n[seal]\nband = 2 mm\nbnd = \"2 mm\"\nspeed = \"0.1 mm/s\"\nspeed = \"0.2 mm/s\"\n\
        [fabric]\npoisson_ratio = 3\n";
    /// Sections that contradict each other.
    stack: format!("{SHORTEST}[stack]\ncount = 2\n[[stack.star]]\nindex = 3\n[[stack.star]]\nindex = 2\ninlet_tip = 6\n\
        [[stack.star]]\nindex = 2\nidnex = 1\n[[stack.star]]\nrotation = \"5 deg\"\n[inlet]\nnone = true\ntip = 1\n");
    /// Words that are not among the choices.
    choices: format!("{SHORTEST}[machine]\nprofile = \"\"\nprogram = \"sheets\"\nfeed_floor = \"slow\"\n[accuracy]\nmodel = \"fem\"\n");
    /// An error with a warning beside it.
    hot: format!("{SHORTEST}tip_radius = \"-1 mm\"\n[seal]\ntemperature = \"280 C\"\n");
    /// A schema of the future, and a name that would end a comment.
    future: SHORTEST.replace("schema = 1", "schema = 2").replace("shortest", "a\\nM104 S300");
}

#[test]
fn machine() {
    let text = "schema = 1\nname = \"m\"\ndialect = \"grlb\"\nline_length = 10\nheating = \"oven\"\n[work_area]\nx = \"600 mm\"\n\
        [heights]\ncontact = \"0 mm\"\ntravel = \"5 mm\"\npark = \"4 mm\"\n[program]\nstart = [\"G21\", 5]\n\
        pause = \"M0\\nM3\"\nend = [\"; µ\", \"\"]\nbegin = []\n";
    snapshot("machine", &read_machine(&Source::new("machine.toml", text)).expect_err("faulty"));
}

#[test]
fn colour_changes_no_word() {
    let faults = try_read("name = 5").expect_err("faulty");
    let mut plain = String::new();
    let coloured = faults.for_terminal(None, true);
    let mut chars = coloured.chars();
    while let Some(c) = chars.next() {
        match c {
            '\u{1b}' => assert!(chars.any(|c| c == 'm'), "an escape sequence that does not end"),
            c => plain.push(c),
        }
    }
    assert_eq!(plain, faults.to_string());
    assert_ne!(coloured, plain);
}

#[test]
fn a_terminal_is_not_commanded_by_what_it_shows() {
    let faults = read(&Source::new("a\u{1b}[2J\n.toml", "name = \"\u{1b}[31m\u{7}\"")).expect_err("faulty");
    let is_command = |c: char| c.is_control() && c != '\n';
    assert!(!faults.to_string().contains(is_command), "{faults:?}");
    assert_eq!(faults.to_string().lines().filter(|line| line.starts_with(".toml")).count(), 0);
}

#[test]
fn a_hot_iron_is_warned_of_and_a_hotter_one_refused() {
    let with_temperature = |temperature: &str| format!("{SHORTEST}[seal]\ntemperature = \"{temperature}\"\n");
    assert_eq!(codes(&with_temperature("260 C")), [""; 0]);
    assert_eq!(codes(&with_temperature("260.5 C")), ["ptfe"]);
    assert_eq!(spec(&with_temperature("299.9 C")).seal.temperature.0, 299.9);
    assert!(!try_read(&with_temperature("299.9 C")).expect("a warning only").warnings.refuse());
    assert!(try_read(&with_temperature("300 C")).is_err());
    assert_eq!(codes(&with_temperature("401 C")), ["out-of-range"]);
    assert_eq!(codes(&with_temperature("0 C")), ["out-of-range"]);
}

/// The pitch is the distance from the star below; a single star's gives its plates room.
#[test]
fn a_pitch_below_the_bottom_star_is_warned_of() {
    let with_pitch = |count: u32, index: u32| {
        format!("{SHORTEST}[stack]\ncount = {count}\n[[stack.star]]\nindex = {index}\npitch = \"50 mm\"\n")
    };
    assert_eq!(codes(&with_pitch(2, 1)), ["no-effect"]);
    for [count, index] in [[1, 1], [2, 2], [3, 2], [3, 3]] {
        assert_eq!(codes(&with_pitch(count, index)), [""; 0], "{count}, {index}");
    }
}

#[test]
fn a_wrong_file_is_not_told_line_by_line() {
    let faults = try_read(&"= 1\n".repeat(100_000)).expect_err("no spec");
    let text = faults.to_string();
    assert!(
        text.ends_with("spec.toml: 3 errors\n")
            && text.contains("more syntax errors: is this the right file?"),
        "{text}"
    );
    // Slips are all reported, however many.
    let slips = try_read(&"a = 5 mm\n".repeat(6)).expect_err("no spec");
    assert_eq!(slips.list().iter().filter(|fault| fault.code == "syntax").count(), 6, "{slips}");
}

#[test]
fn windows_files_read_as_others_do() {
    let text = format!("\u{feff}{SHORTEST}").replace('\n', "\r\n");
    assert_eq!(spec(&text), spec(SHORTEST));
    let faults = try_read(&text.replace("points = 5", "points = 2")).expect_err("faulty");
    assert!(
        faults.to_string().contains("spec.toml:4:10\r\n") || faults.to_string().contains("spec.toml:4:10\n")
    );
}

#[test]
fn a_friction_lies_between_its_ends() {
    let with_friction = |more: &str| format!("{SHORTEST}\n[load]\nfriction = 0.3\n{more}");
    for ok in ["", "friction_least = 0.3", "friction_least = 0.2\nfriction_most = 0.42"] {
        assert_eq!(codes(&with_friction(ok)), [""; 0], "{ok}");
    }
    for wrong in ["friction_least = 0.4", "friction_most = 0.2"] {
        assert_eq!(codes(&with_friction(wrong)), ["conflict"], "{wrong}");
    }
    for end in ["friction_least", "friction_most"] {
        let without_middle = with_friction(&format!("{end} = 0.3")).replace("\nfriction = 0.3", "");
        assert_eq!(codes(&without_middle), ["conflict"], "{end}");
    }
    let crossed_ends =
        try_read(&with_friction("friction_least = 0.9\nfriction_most = 0.1")).expect_err("two faults");
    assert_eq!(crossed_ends.list().iter().map(|fault| fault.code).collect::<Vec<_>>(), ["conflict"; 2]);
    assert!(crossed_ends.to_string().contains("write friction_least = 0.3"), "{crossed_ends}");
}
