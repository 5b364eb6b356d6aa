//! Specs, profiles and tables with one fault each, and the program's messages.

use stargrip_cam::coupon::bias::read_strip;
use stargrip_cam::design::Refusals;
use stargrip_cam::pipeline::{Forecast, Interface};
use stargrip_cam::spec;
use stargrip_cam::spec::{Faults, Machine, Source};

/// A code with its message.
pub(crate) type Message = (String, String);

const STAR: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
                    tip_angle = \"30 deg\"\n";
/// The paper's object and pressure.
const LOAD: &str = "[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nfriction = 0.3\n";

/// A code, the part of the star that is replaced, and the text that is added.
const EDITS: &[(&str, &str, &str)] = &[
    ("conflict", "", "[inlet]\nnone = true\ntip = 1\n"),
    ("duplicate-index", "", "[stack]\ncount = 2\n[[stack.star]]\nindex = 2\n[[stack.star]]\nindex = 2\n"),
    ("link", "", "[build]\nlink = \"example.org\"\n"),
    ("missing-key", "points = 5\n", ""),
    ("name", "\"x\"", "\"\""),
    ("no-unit", "\"50 mm\"", "50"),
    ("not-a-number", "50 mm", "fifty mm"),
    ("out-of-range", "points = 5", "points = 2"),
    ("profile", "", "[machine]\nprofile = \"\"\n"),
    ("ptfe", "", "[seal]\ntemperature = \"320 C\"\n"),
    ("schema", "schema = 1", "schema = 2"),
    ("syntax", "points = 5", "points 5"),
    ("unknown-choice", "", "[accuracy]\nmodel = \"fem\"\n"),
    ("unknown-key", "tube_width", "tube_widht"),
    ("unknown-process", "", "outer_process = \"weka\"\n[process.weak]\n"),
    ("unknown-section", "", "[seals]\nband = \"2 mm\"\n"),
    ("unknown-unit", "50 mm", "50 kg"),
    ("wrong-type", "points = 5", "points = \"5\""),
    ("no-arm", "inner_radius = \"50 mm\"", "inner_radius = \"5 mm\""),
    ("straight-corner", "30 deg", "120 deg"),
    ("hole-closed", "", "[seal]\nhole_allowance = \"60 mm\"\n"),
    (
        "short-window",
        "points = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"",
        "points = 8\ninner_radius = \"30 mm\"\ntube_width = \"12 mm\"",
    ),
    ("too-large", "inner_radius = \"50 mm\"", "inner_radius = \"99 m\""),
    ("inlet-meets-arm", "", "[inlet]\ntube_diameter = \"45 mm\"\n"),
];

/// Refusals of designs; each row adds text to the star.
const DESIGNS: &[(&str, &str)] = &[
    ("arms-fall-through", "[stack]\ncount = 2\n[[stack.star]]\nindex = 2\ninner_radius = \"160 mm\"\n"),
    ("band-eats-arm", "[seal]\nband = \"45 mm\"\n"),
    ("chopped-seal", "[machine]\nprofile = \"grbl\"\nfeed_floor = \"chop\"\n"),
    ("fast-seal", "[seal]\nspeed = \"5 mm/s\"\n"),
    ("feed-floor", "[machine]\nprofile = \"grbl\"\n"),
    ("job-too-large", "[seal]\nspeed = \"0.001 mm/s\"\n"),
    (
        "high-focus",
        "[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\nfocus = \"13 mm\"\n[machine]\nprofile = \"grbl-laser\"\n",
    ),
    (
        "laser-safety",
        "[seal]\npower = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"1 mm\"\n[machine]\nprofile = \"grbl-laser\"\n",
    ),
    ("long-extent", "[mask]\nextent = \"150 mm\"\n"),
    ("long-overlap", "[seal]\noverlap = \"900 mm\"\n"),
    ("machine-requires", "[machine]\nprofile = \"klipper\"\n"),
    ("no-chop", "[machine]\nfeed_floor = \"chop\"\n"),
    ("no-overlap", "[seal]\noverlap = \"0 mm\"\n"),
    ("pressing", "[machine]\nprofile = \"press\"\n"),
    ("no-room-for-holes", "[sheet]\nhole_diameter = \"40 mm\"\n"),
    ("no-window", "[mask]\nextent = \"15 mm\"\ncreep = \"40 mm\"\n"),
    ("out-of-reach", "[machine]\nprofile = \"own.toml\"\n"),
    (
        "post-meets-hose",
        "[stack]\ncount = 2\nrotation = \"20 deg\"\n[frame]\nposts = 64\npost_diameter = \"10 mm\"\n",
    ),
    (
        "shallow-cut",
        "[cut]\ntool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"5 mm/s\"\nheight = \"0 mm\"\n",
    ),
    (
        "tight-cut",
        "[cut]\ntool = \"drag-knife\"\nblade_offset = \"0.25 mm\"\nspeed = \"20 mm/s\"\nheight = \"-0.8 mm\"\n[sheet]\nhole_diameter = \"0.9 mm\"\n",
    ),
    (
        "cut-sheet",
        "[cut]\ntool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"5 mm/s\"\nheight = \"-1 mm\"\n",
    ),
    ("sheet-marks", "[machine]\nmarks = \"pause\"\n"),
    ("no-marks", "[machine]\nmarks = \"pause\"\n[sheet]\nhole_diameter = \"0 mm\"\n"),
    ("sheet-too-small", "[sheet]\nwidth = \"100 mm\"\nheight = \"400 mm\"\n"),
    ("short-inlet", "[inlet]\nlength = \"2 mm\"\n"),
    ("small-bed", "[mask]\nbed = \"50 mm x 50 mm\"\n"),
    ("thick-hose", "[inlet]\ntube_diameter = \"22 mm\"\n"),
    ("thin-rim", "[seal]\nallowance = \"0 mm\"\n[mask]\nborder = \"0 mm\"\n"),
    ("tube-between-plates", "[stack]\ncount = 2\npitch = \"5 mm\"\n"),
    ("wide-frame", "[stack]\ncount = 2\npitch = \"200 mm\"\n"),
    ("wide-kerf", "[cut]\nkerf = \"20 mm\"\n"),
    (
        "weak-process",
        "inner_process = \"weak\"\n[process.weak]\nstrength = \"2 N/mm\"\n[fabric]\nseal_strength = \"3 N/mm\"\n",
    ),
    ("weak-seal", "[seal]\noverlap = \"1 mm\"\n"),
    ("unknown-reach", "[machine]\nprofile = \"linuxcnc\"\n"),
];

/// Refusals with [`LOAD`], in which a part is replaced, or to which text is added.
const LOADS: &[(&str, &str, &str)] = &[
    (
        "object-too-short",
        "[load]",
        "[stack]\ncount = 2\npitch = \"80 mm\"\n[load]\nobject_height = \"20 mm\"",
    ),
    ("object-too-thin", "30 mm", "3 mm"),
    ("object-too-wide", "30 mm", "60 mm"),
    ("outside-models", "37 kPa", "5700 kPa"),
    ("too-heavy", "", "mass = \"50 kg\"\n"),
    ("too-hard", "", "largest_force = \"1 N\"\n"),
    ("may-not-hold", "", "mass = \"0.35 kg\"\n"),
    ("tight-hole", "30 mm", "46.5 mm"),
    ("unknown-strength", "", ""),
    ("prediction", "", ""),
    ("unfit", "", "mass = \"50 kg\"\n"),
    ("bursts", "[load]", "[fabric]\nseal_strength = \"0.1 N/mm\"\n[load]"),
    ("generic-machine", "", ""),
];

/// Lines of the test of a bias strip.
const TABLES: &[(&str, &str)] = &[
    ("cell", "travel_mm,load_N\n0,0\n1,x\n"),
    ("cell-count", "travel_mm,load_N\n0,0\n1\n"),
    ("decimal-comma", "travel_mm,load_N\n0,\"0,5\"\n"),
    ("no-column", "travel_mm\n0\n"),
    ("no-header", "0,0\n1,1\n"),
    ("no-rows", "travel_mm,load_N\n"),
    ("two-columns", "travel_mm,load_N,load_N\n0,0,0\n"),
    ("unit", "travel_mm,load_kg\n0,0\n"),
];

/// Bytes that are not a spec.
const BYTES: [&[u8]; 4] =
    [b"G21\nG90\nG0 Z30\n", b"\xff\xfe\x00", b"schema = 1\rname = \"x\"\r", &[b'#'; (1 << 20) + 1]];

/// A code, a built-in profile, a part of it that is replaced, its new text, and the text added to the star.
const PROFILES: &[(&str, &str, &str, &str, &str)] = &[
    (
        "clamp-in-the-way",
        "generic",
        "[heights]",
        "[[keep_out]]\nname = \"clamp\"\nx = \"200 mm\"\ny = \"200 mm\"\nwidth = \"40 mm\"\ndepth = \"40 mm\"\n[heights]",
        "",
    ),
    ("clamped-contact", "ender", "surface = \"1 mm\"", "surface = \"0 mm\"", ""),
    ("no-laser", "grbl-laser", "ramp = \"3 mm\"", "ramp = \"3 mm\"", ""),
    ("profile-limit", "klipper", "TIMEOUT=86400", "TIMEOUT=600", ""),
    ("steep-ramp", "grbl", "ramp = \"3 mm\"", "ramp = \"0.005 mm\"", "feed_floor = \"chop\"\n"),
    ("unknown-feed", "generic", "name = \"generic\"", "name = \"shop\"", ""),
];

/// All messages about specs, profiles and tables: faults, refusals and precautions, each as a list.
pub(crate) fn messages() -> [Vec<Message>; 3] {
    let mut messages = [Vec::new(), Vec::new(), Vec::new()];
    let changed = |text: &str, old: &str, new: &str| match old {
        "" => format!("{text}{new}"),
        _ => text.replacen(old, new, 1),
    };
    for &(_, old, new) in EDITS {
        of_spec(&changed(STAR, old, new), None, &mut messages);
    }
    for &(_, rest) in DESIGNS {
        of_spec(&format!("{STAR}{rest}"), None, &mut messages);
    }
    for &(_, old, new) in LOADS {
        of_spec(&format!("{STAR}{}", changed(LOAD, old, new)), None, &mut messages);
    }
    for &(_, layers, body) in DRAWINGS {
        let text =
            format!("schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\n{layers}\n");
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"200mm\" viewBox=\"-20 -20 200 200\">{body}</svg>"
        );
        of_drawing(&text, svg.as_bytes(), &mut messages);
    }
    of_drawing(DRAWING, b"solid x", &mut messages);
    of_spec(DRAWING, None, &mut messages);
    for &(_, profile, old, new, rest) in PROFILES {
        let profile_text = spec::builtin_machine(profile).expect("built in").replacen(old, new, 1);
        of_spec(
            &format!("{STAR}[machine]\nprofile = \"own.toml\"\n{rest}"),
            Some(&profile_text),
            &mut messages,
        );
    }
    let rigid = generic()
        .replace("spring_loaded = true", "spring_loaded = false")
        .replace("contact = \"-0.3 mm\"", "contact = \"0 mm\"");
    let deep = format!("{STAR}[machine]\nprofile = \"own.toml\"\n[seal]\nheight = \"-0.2 mm\"\n");
    of_spec(&deep, Some(&rigid), &mut messages);
    let [faults, ..] = &mut messages;
    for &(_, text) in TABLES {
        faults.extend(read_strip(&Source::new("strip.csv", text)).err().iter().flat_map(of_faults));
    }
    for bytes in BYTES {
        let read = Source::from_bytes("spec.toml", bytes).and_then(|source| spec::read(&source));
        faults.extend(read.err().iter().flat_map(of_faults));
    }
    let idle = format!("{STAR}[stack]\ncount = 2\n[[stack.star]]\nindex = 1\npitch = \"50 mm\"\n");
    faults.extend(of_faults(&spec::read(&Source::new("spec.toml", idle)).expect("a warning only").warnings));
    let profile = generic().replace("\"G90\"", "\"G91\"");
    faults.extend(spec::read_machine(&Source::new("own.toml", profile)).err().iter().flat_map(of_faults));
    messages
}

/// Drawings with one fault each: code, roles, and the content of the file.
const DRAWINGS: &[(&str, &str, &str)] = &[
    ("layer-without-role", "port = [\"p\"]", ROOM),
    ("unknown-layer", "air = [\"a\", \"b\"]\nport = [\"p\"]", ROOM),
    ("chamber-without-port", "air = [\"a\"]\nignore = [\"p\"]", ROOM),
    (
        "process-without-seam",
        "air = [\"a\"]\nport = [\"p\"]\n[drawing.process]\nweak = [\"b\"]\n[process.weak]",
        ROOM,
    ),
    ("unknown-measure", "air = [\"a\"]\nport = [\"p\"]\n[drawing.measure]\ntip = [\"aa\"]", ROOM),
    ("nothing-drawn", "ignore = [\"a\", \"p\"]", ROOM),
    (
        "port-off-edge",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g>\
        <g id=\"p\"><path id=\"q\" d=\"M 28 30 H 32\"/></g>",
    ),
    (
        "curve-dangling-end",
        "air = [\"a\"]\nignore = [\"p\"]",
        "<g id=\"a\"><path id=\"e\" d=\"M 0 0 H 50 V 50\"/></g><g id=\"p\"><path d=\"M 1 1 H 2\"/></g>",
    ),
    (
        "curve-gap",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><path id=\"e\" d=\"M 0 0 H 50 V 50 H 0 V 0.4\"/></g>\
        <g id=\"p\"><path d=\"M 25 -3 V 3\"/></g>",
    ),
    (
        "curves-cross",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/>\
        <rect id=\"s\" x=\"30\" y=\"30\" width=\"60\" height=\"60\"/></g><g id=\"p\"><path d=\"M -3 30 H 3\"/></g>",
    ),
    (
        "narrow-passage",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"90\" height=\"60\"/><circle id=\"s\" cx=\"16\" cy=\"30\" r=\"8\"/></g>\
        <g id=\"p\"><path d=\"M 60 -3 V 3\"/></g>",
    ),
    (
        "bands-overlap",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"40\" height=\"40\"/><rect id=\"s\" x=\"43\" width=\"40\" height=\"40\"/></g>\
        <g id=\"p\"><path d=\"M 20 -3 V 3 M 63 -3 V 3\"/></g>",
    ),
    (
        "no-room-for-band",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/><circle id=\"s\" cx=\"30\" cy=\"30\" r=\"0.8\"/></g>\
        <g id=\"p\"><path d=\"M 30 -3 V 3\"/></g>",
    ),
    (
        "port-too-wide",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"5\" height=\"60\"/></g><g id=\"p\"><path d=\"M 2.5 -3 V 3\"/></g>",
    ),
    (
        "sharp-corner",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><path id=\"r\" d=\"M 0 0 H 80 V 40 H 40 V 80 H 0 Z\"/></g><g id=\"p\"><path d=\"M 30 -3 V 3\"/></g>",
    ),
    (
        "wall-outside",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"40\" height=\"40\"/><rect id=\"s\" x=\"60\" width=\"40\" height=\"40\"/>\
        <path id=\"t\" d=\"M 40 20 H 60\"/></g><g id=\"p\"><path d=\"M 20 -3 V 3 M 80 -3 V 3\"/></g>",
    ),
    (
        "narrow-tube",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"90\" height=\"3\"/></g>\
        <g id=\"p\"><path d=\"M 45 -3 V 1\"/></g>",
    ),
    (
        "nested-island",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"90\" height=\"90\"/>\
        <rect id=\"s\" x=\"25\" y=\"25\" width=\"40\" height=\"40\"/><rect id=\"t\" x=\"40\" y=\"40\" width=\"9\" height=\"9\"/></g>\
        <g id=\"p\"><path d=\"M 45 -3 V 3\"/></g>",
    ),
    (
        "wrong-outlines",
        "air = [\"a\"]\nport = [\"p\"]\ncut = [\"c\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g>\
        <g id=\"p\"><path d=\"M 30 -3 V 3\"/></g><g id=\"c\"><path id=\"k\" d=\"M 100 0 H 120 V 20 Z M 140 0 H 160 V 20 Z\"/></g>",
    ),
    (
        "cut-in-band",
        "air = [\"a\"]\nport = [\"p\"]\nhole = [\"h\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g>\
        <g id=\"p\"><path d=\"M 30 -3 V 3\"/></g><g id=\"h\"><circle id=\"k\" cx=\"61\" cy=\"30\" r=\"2\"/></g>",
    ),
    (
        "misplaced-valve",
        "air = [\"a\"]\nvalve = [\"v\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g><g id=\"v\"><circle id=\"k\" cx=\"5\" cy=\"30\" r=\"3\"/></g>",
    ),
    (
        "fit-valve",
        "air = [\"a\"]\nvalve = [\"v\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g><g id=\"v\"><circle id=\"k\" cx=\"30\" cy=\"30\" r=\"3\"/></g>",
    ),
    (
        "thin-web",
        "air = [\"a\"]\nport = [\"p\"]\nhole = [\"h\"]\ncut = [\"c\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g><g id=\"p\"><path d=\"M 30 -3 V 3\"/></g>\
        <g id=\"h\"><circle id=\"k\" cx=\"66\" cy=\"30\" r=\"2\"/></g><g id=\"c\"><rect id=\"o\" x=\"-10\" y=\"-10\" width=\"79\" height=\"80\"/></g>",
    ),
    (
        "lost-geometry",
        "air = [\"a\"]\nport = [\"p\"]",
        "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/>\
        <image id=\"t\" x=\"9\" y=\"9\" href=\"a.png\"/></g><g id=\"p\"><path d=\"M 30 -3 V 3\"/></g>",
    ),
];

/// A chamber with its port.
const ROOM: &str =
    "<g id=\"a\"><rect id=\"r\" width=\"60\" height=\"60\"/></g><g id=\"p\"><path d=\"M 30 -3 V 3\"/></g>";

fn generic() -> &'static str {
    spec::builtin_machine("generic").expect("built in")
}

/// A spec of a drawing.
const DRAWING: &str = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = { air = [\"a\"] }\n";

/// All messages about a spec of a drawing.
fn of_drawing(text: &str, bytes: &[u8], [_, refusals, precautions]: &mut [Vec<Message>; 3]) {
    let reading = spec::read(&Source::new("spec.toml", text)).expect("a spec").with_drawing(bytes);
    let machine = Machine::builtin("generic").expect("built in");
    match Forecast::new(reading.spec, machine) {
        Ok(forecast) => {
            let warnings = forecast.design.warnings.iter();
            refusals
                .extend(warnings.map(|one| (one.code.to_string(), format!("{}; {}", one.found, one.remedy))));
            let list = forecast.precautions(Interface::Command("spec.toml"));
            precautions.extend(list.iter().map(|one| (one.code.to_string(), one.text.clone())));
        }
        Err(found) => refusals.extend(of_refusals(&found)),
    }
}

/// All messages about a spec on a profile, in three lists.
fn of_spec(text: &str, profile: Option<&str>, [faults, refusals, precautions]: &mut [Vec<Message>; 3]) {
    let reading = match spec::read(&Source::new("spec.toml", text)) {
        Ok(reading) => reading,
        Err(found) => return faults.extend(of_faults(&found)),
    };
    let small = generic().replace("x = \"unknown\"\ny = \"unknown\"", "x = \"200 mm\"\ny = \"200 mm\"");
    let profile_read = profile.unwrap_or(&small);
    let machine = Machine::builtin(&reading.spec.machine.profile)
        .or_else(|_| spec::read_machine(&Source::new("own.toml", profile_read)))
        .expect("a profile");
    let forecast = match Forecast::new(reading.spec, machine) {
        Ok(forecast) => forecast,
        Err(found) => return refusals.extend(of_refusals(&found)),
    };
    refusals.extend(of_refusals(&forecast.unfit()));
    let warnings = forecast.design.warnings.iter();
    refusals.extend(warnings.map(|one| (one.code.to_string(), format!("{}; {}", one.found, one.remedy))));
    let list = forecast.precautions(Interface::Command("spec.toml"));
    let doubts = list.iter().filter(|one| one.code == "may-not-hold");
    refusals.extend(doubts.map(|one| (one.code.to_string(), one.text.clone())));
    precautions.extend(list.iter().map(|one| (one.code.to_string(), one.text.clone())));
}

fn of_faults(faults: &Faults) -> Vec<Message> {
    let message = |fault: &spec::Fault| {
        let parts =
            [&fault.message, &fault.label].into_iter().chain(&fault.help).filter(|part| !part.is_empty());
        (fault.code.to_owned(), parts.cloned().collect::<Vec<_>>().join("; "))
    };
    faults.list().iter().map(message).collect()
}

fn of_refusals(refusals: &Refusals) -> Vec<Message> {
    refusals.iter().map(|one| (one.code.to_string(), format!("{}; {}", one.found, one.remedy))).collect()
}
