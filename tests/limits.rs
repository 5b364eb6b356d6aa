//! The limit that a refusal names is where the refusal ends: a little beyond it is accepted, a little before it is not.

mod support;

use stargrip_cam::design::{Design, Refusal, RefusalCode};
use stargrip_cam::spec::{KeyPath, key};

/// One value that is wrong, and what is said about it.
struct Limit {
    code: RefusalCode,
    key: KeyPath,
    /// The spec with this value.
    spec: fn(f64) -> String,
    wrong: f64,
}

fn paper(rest: &str) -> String {
    format!("{}{rest}", support::PAPER)
}

fn star(points: u32, radius: f64, width: f64, angle: f64) -> String {
    format!(
        "schema = 1\nname = \"x\"\n[star]\npoints = {points}\ninner_radius = \"{radius} mm\"\n\
         tube_width = \"{width} mm\"\ntip_angle = \"{angle} deg\"\n"
    )
}

const LIMITS: [Limit; 11] = [
    Limit {
        code: RefusalCode::StraightCorner,
        key: key::star::TIP_ANGLE,
        spec: |deg| star(5, 50.0, 30.0, deg),
        wrong: 120.0,
    },
    Limit {
        code: RefusalCode::HoleClosed,
        key: key::seal::HOLE_ALLOWANCE,
        spec: |mm| star(3, mm, 10.0, 30.0) + "[seal]\nhole_allowance = \"30 mm\"\n",
        wrong: 20.0,
    },
    Limit {
        code: RefusalCode::BandEatsArm,
        key: key::seal::BAND,
        spec: |mm| paper(&format!("[seal]\nband = \"{mm} mm\"\n")),
        wrong: 45.0,
    },
    Limit {
        code: RefusalCode::LongOverlap,
        key: key::seal::OVERLAP,
        spec: |mm| paper(&format!("[seal]\noverlap = \"{mm} mm\"\n")),
        wrong: 900.0,
    },
    Limit {
        code: RefusalCode::ShortInlet,
        key: key::inlet::LENGTH,
        spec: |mm| paper(&format!("[inlet]\nlength = \"{mm} mm\"\n")),
        wrong: 2.0,
    },
    Limit {
        code: RefusalCode::NoWindow,
        key: key::mask::CREEP,
        spec: |mm| paper(&format!("[mask]\nextent = \"15 mm\"\ncreep = \"{mm} mm\"\n")),
        wrong: 40.0,
    },
    Limit {
        code: RefusalCode::NoWindow,
        key: key::mask::CREEP,
        spec: |mm| paper(&format!("[mask]\nextent = \"60 mm\"\ncreep = \"{mm} mm\"\n")),
        wrong: 40.0,
    },
    Limit {
        code: RefusalCode::LongExtent,
        key: key::mask::EXTENT,
        spec: |mm| paper(&format!("[mask]\nextent = \"{mm} mm\"\n")),
        wrong: 150.0,
    },
    Limit {
        code: RefusalCode::SheetTooSmall,
        key: key::sheet::WIDTH,
        spec: |mm| paper(&format!("[sheet]\nturn = false\nwidth = \"{mm} mm\"\nheight = \"400 mm\"\n")),
        wrong: 100.0,
    },
    Limit {
        code: RefusalCode::SheetTooSmall,
        key: key::sheet::HEIGHT,
        spec: |mm| paper(&format!("[sheet]\nturn = false\nwidth = \"400 mm\"\nheight = \"{mm} mm\"\n")),
        wrong: 100.0,
    },
    Limit {
        code: RefusalCode::TubeBetweenPlates,
        key: key::stack::PITCH,
        spec: |mm| paper(&format!("[stack]\ncount = 2\npitch = \"{mm} mm\"\n")),
        wrong: 5.0,
    },
];

/// The refusals of `code` of the design of `text`.
fn refused(text: &str, code: RefusalCode) -> Vec<Refusal> {
    match Design::new(&support::read(text), &support::machine()) {
        Ok(_) => Vec::new(),
        Err(refusals) => refusals.iter().filter(|refusal| refusal.code == code).cloned().collect(),
    }
}

/// The last number with a unit.
fn number(remedy: &str) -> f64 {
    let words: Vec<&str> = remedy.split([' ', ',', ';', ':']).collect();
    let with_unit = words.windows(2).rev().find(|pair| ["mm", "deg"].contains(&pair[1]));
    with_unit.and_then(|pair| pair[0].parse().ok()).expect("a number with a unit")
}

#[test]
fn the_limit_that_is_named_is_where_it_ends() {
    for Limit { code, key, spec, wrong } in LIMITS {
        let found = refused(&spec(wrong), code);
        assert!(found.iter().any(|refusal| refusal.key.key() == key.key()), "{code:?}: {found:?}");
        // Where two parts of a star set one, the stricter counts.
        let limits = found.iter().map(|refusal| number(&refusal.remedy));
        let least = limits.clone().fold(f64::INFINITY, f64::min);
        let limit = if wrong > least { least } else { limits.fold(0.0, f64::max) };
        // Six digits are printed, and some limits are whole hundredths.
        let little = (1e-5 * limit).max(0.0101) * (wrong - limit).signum();
        assert_eq!(refused(&spec(limit - little), code), [], "{code:?}: {limit}");
        assert!(!refused(&spec(limit + little), code).is_empty(), "{code:?}: {limit} is no limit");
    }
}
