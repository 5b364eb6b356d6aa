//! The keys of a spec by name, so that a later stage can point at the one that is best changed.
//!
//! Every key is a constant, `key::seal::BAND`: a typo does not compile, and a test holds the constants to the keys that
//! the reader takes.

use std::fmt;

use crate::unknown::nearest;

/// One key of a spec, of one star where stars can have it of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct KeyPath {
    section: &'static str,
    key: &'static str,
    star: Option<u32>,
    process: Option<u32>,
}

impl KeyPath {
    /// The section that holds it, without brackets; "" for the keys before the first section.
    pub const fn section(self) -> &'static str {
        self.section
    }

    /// The name of the key in that section.
    pub const fn key(self) -> &'static str {
        self.key
    }

    /// The star of which it is (1 = bottom); `None` if it is about the whole spec, or about no star in particular.
    pub const fn star(self) -> Option<u32> {
        self.star
    }

    /// The place of its process in the order of the alphabet, from 0; `None` if it is of no process in particular.
    pub const fn process(self) -> Option<u32> {
        self.process
    }

    /// This key of the process at place `index` in the order of the alphabet, if it is one of processes.
    #[must_use]
    pub fn of_process(self, index: usize) -> Self {
        let process = u32::try_from(index).ok().filter(|_| self.section == process::SPEED.section);
        Self { process, ..self }
    }

    /// This key of star `index` (1 = bottom), if it is one that stars can have of their own.
    #[must_use]
    pub fn of_star(self, index: usize) -> Self {
        Self { star: u32::try_from(index).ok().filter(|_| self.own_name().is_some()), ..self }
    }

    /// The name of the key in a `[[stack.star]]`; `None` if single stars cannot have it different.
    pub fn own_name(self) -> Option<&'static str> {
        match self.section {
            "star" => Some(self.key),
            "stack" => Some(self.key).filter(|key| ["rotation", "pitch"].contains(key)),
            "inlet" => Some("inlet_tip").filter(|_| self.key == "tip"),
            _ => None,
        }
    }

    /// The other key of the same value: the object's radius for its diameter, and back; `None` for other keys.
    pub fn twin(self) -> Option<Self> {
        match self {
            load::OBJECT_DIAMETER => Some(load::OBJECT_RADIUS),
            load::OBJECT_RADIUS => Some(load::OBJECT_DIAMETER),
            _ => None,
        }
    }
}

/// "star.points"; the star it is of is left out.
impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let dot = if self.section.is_empty() { "" } else { "." };
        write!(f, "{}{dot}{}", self.section, self.key)
    }
}

macro_rules! keys {
    ($($room:ident $section:literal { $($name:ident $key:literal),+ $(,)? })+) => {
        $(
            #[doc = concat!("Keys of the section \"", $section, "\".")]
            pub mod $room {
                use crate::KeyPath;
                $(
                    #[doc = concat!("`", $key, "`")]
                    pub const $name: KeyPath = KeyPath { section: $section, key: $key, star: None, process: None };
                )+
            }
        )+

        /// Every key of a spec, in the order of the starter.
        pub const ALL: &[KeyPath] = &[$($($room::$name),+),+];
    };
}

keys! {
    root "" { SCHEMA "schema", NAME "name" }
    fabric "fabric" {
        THICKNESS "thickness", YOUNG_MODULUS "young_modulus", POISSON_RATIO "poisson_ratio",
        SEAL_STRENGTH "seal_strength", AREAL_DENSITY "areal_density",
        BENDING_STIFFNESS "bending_stiffness", STRETCH_STIFFNESS "stretch_stiffness",
        SHEAR_MODULUS "shear_modulus", WARP "warp",
    }
    star "star" {
        POINTS "points", INNER_RADIUS "inner_radius", TUBE_WIDTH "tube_width", TIP_ANGLE "tip_angle",
        TIP_RADIUS "tip_radius", CORNER_RADIUS "corner_radius", INNER_PROCESS "inner_process",
        OUTER_PROCESS "outer_process",
    }
    stack "stack" { COUNT "count", ROTATION "rotation", PITCH "pitch", STAR "star" }
    drawing "drawing" { FILE "file", UNITS "units", JOIN "join", PASSAGE "passage", FLANGE "flange", LAYERS "layers", PROCESS "process", MEASURE "measure" }
    inlet "inlet" {
        NONE "none", TUBE_DIAMETER "tube_diameter", LENGTH "length", TIP "tip", FILLET "fillet",
    }
    seal "seal" {
        TEMPERATURE "temperature", SPEED "speed", BAND "band", OVERLAP "overlap", ALLOWANCE "allowance",
        HOLE_ALLOWANCE "hole_allowance", HEIGHT "height", PASSES "passes", LINES "lines", TIP "tip", COOL "cool",
        PAUSE "pause", STRENGTH "strength", POWER "power", FOCUS "focus",
    }
    process "process" {
        TEMPERATURE "temperature", SPEED "speed", HEIGHT "height", PASSES "passes", LINES "lines", OVERLAP "overlap",
        COOL "cool", PAUSE "pause", STRENGTH "strength", POWER "power", FOCUS "focus",
    }
    mask "mask" {
        KIND "kind", EXTENT "extent", CREEP "creep", BORDER "border", MIRROR "mirror", THICKNESS "thickness",
        BED "bed",
    }
    frame "frame" {
        PLATE_THICKNESS "plate_thickness", CLEARANCE "clearance", POST_DIAMETER "post_diameter", POSTS "posts",
        KERF "kerf",
    }
    cut "cut" {
        KERF "kerf", COLOURS "colours", TOOL "tool", TEMPERATURE "temperature", SPEED "speed", HEIGHT "height",
        BLADE_OFFSET "blade_offset", POWER "power", FOCUS "focus",
    }
    sheet "sheet" {
        WIDTH "width", HEIGHT "height", COPIES "copies", MARGIN "margin", GAP "gap", TURN "turn", HOLE_DIAMETER "hole_diameter",
    }
    machine "machine" { PROFILE "profile", PROGRAM "program", FEED_FLOOR "feed_floor", MARKS "marks" }
    press "press" {
        TEMPERATURE "temperature", TIME "time", PRESSURE "pressure", LAYERS "layers", CREEP "creep", PAPER "paper",
        PLATES "plates",
    }
    load "load" {
        PRESSURE "pressure", OBJECT_DIAMETER "object_diameter", OBJECT_RADIUS "object_radius", OBJECT_HEIGHT "object_height",
        OBJECT_SHAPE "object_shape", FRICTION "friction", FRICTION_LEAST "friction_least", FRICTION_MOST "friction_most",
        MASS "mass", LARGEST_FORCE "largest_force", CHAMBERS "chambers", PLATES "plates",
    }
    accuracy "accuracy" { PATH "path", MODEL "model", RESPONSE "response" }
    build "build" { WITH "with", LINK "link" }
}

/// The key called `name`, "star.points".
///
/// # Errors
/// If there is no such key: the name of the nearest one, if one is near.
pub fn named(name: &str) -> Result<KeyPath, Option<String>> {
    ALL.iter().find(|key| key.to_string() == name).copied().ok_or_else(|| {
        let names: Vec<String> = ALL.iter().map(ToString::to_string).collect();
        nearest(name, names.iter().map(String::as_str)).map(str::to_owned)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raw::RawSpec;
    use crate::reading::read_spec;
    use crate::section::Reader;
    use std::collections::BTreeSet;

    #[test]
    fn the_keys_by_name_are_those_that_the_reader_takes() {
        let text = "[[stack.star]]\nindex = 1\n[process.weak]\n";
        let (raw, _) = RawSpec::parse(text);
        let mut reader = Reader::new(&raw);
        let _ = read_spec(&mut reader);
        let (star_keys, keys_taken): (BTreeSet<_>, BTreeSet<_>) =
            reader.keys_taken().partition(|(section, _)| *section == "stack.star");
        assert_eq!(keys_taken, ALL.iter().map(|key| (key.section(), key.key())).collect());
        let names = ALL.iter().filter_map(|key| key.own_name()).chain(["index"]);
        assert_eq!(star_keys, names.map(|name| ("stack.star", name)).collect());
    }

    #[test]
    fn a_key_is_found_by_its_name_or_the_nearest_is_named() {
        assert!(ALL.iter().all(|key| named(&key.to_string()) == Ok(*key)));
        assert_eq!(named("star.poinst"), Err(Some("star.points".to_owned())));
        assert_eq!(named("colour"), Err(None));
    }

    #[test]
    fn a_star_has_only_its_own_keys() {
        assert_eq!(star::POINTS.of_star(2).star(), Some(2));
        assert_eq!(inlet::TIP.of_star(2).own_name(), Some("inlet_tip"));
        assert_eq!(seal::BAND.of_star(2), seal::BAND);
        assert_eq!([star::POINTS.of_star(2), root::NAME].map(|key| key.to_string()), ["star.points", "name"]);
    }
}
