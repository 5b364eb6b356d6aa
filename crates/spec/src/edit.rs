//! A spec's text with other values for its star, everything else as it was, comments included.

use toml_edit::{DocumentMut, Item, TableLike, TomlError, Value};

use crate::fault::Fault;
use crate::faults::Faults;
use crate::key::KeyPath;
use crate::model::{Spec, StarSpec};
use crate::reading::{Reading, read};
use crate::source::Source;
use crate::units::{Angle, Length};
use crate::{FaultCode, key};
use std::ops::Range;

/// The values of `[star]` that a search may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarEdit {
    /// Number of points, 3 to 64.
    pub points: u32,
    /// Tube width W.
    pub tube_width: Length,
    /// Tip angle phi_i0.
    pub tip_angle: Angle,
    /// Tip radius R_i.
    pub tip_radius: Length,
    /// Corner radius R_e.
    pub corner_radius: Length,
}

impl StarEdit {
    /// The values that `star` has already.
    pub fn new(star: &StarSpec) -> Self {
        let StarSpec { points, tube_width, tip_angle, tip_radius, corner_radius, .. } = *star;
        Self { points, tube_width, tip_angle, tip_radius, corner_radius }
    }

    /// Keys and values as TOML. `{}` prints the shortest decimals that read back to the same number.
    fn entries(&self) -> [(KeyPath, String); 5] {
        [
            (key::star::POINTS, self.points.to_string()),
            (key::star::TUBE_WIDTH, in_millimetres(self.tube_width)),
            (key::star::TIP_ANGLE, format!("\"{} deg\"", self.tip_angle.0)),
            (key::star::TIP_RADIUS, in_millimetres(self.tip_radius)),
            (key::star::CORNER_RADIUS, in_millimetres(self.corner_radius)),
        ]
    }
}

/// `length` as the text of a value, in mm.
fn in_millimetres(length: Length) -> String {
    format!("\"{} mm\"", length.0)
}

/// The text of `source` with the values of `star` set in `[star]`, however that section is written: a table, dotted
/// keys (which then all spell `star` as the first does), an inline table, quoted keys. Lines end with LF. The result has
/// been read back: its first star has exactly these values.
///
/// # Errors
/// If `source` is refused, if a `[[stack.star]]` decides one of the keys, the inner radius or the pitch for a star, or if the result is
/// refused (five points may have an inlet at tip 5, four may not).
pub fn with_star(source: &Source, star: &StarEdit) -> Result<String, Faults> {
    let Reading { raw, spec, .. } = read(source)?;
    let entries = star.entries();
    let searched = entries.iter().map(|(key, _)| *key).chain([key::star::INNER_RADIUS, key::stack::PITCH]);
    let has_own = |(key, star): &(KeyPath, usize)| raw.span_of(key.of_star(*star)) != raw.span_of(*key);
    let own_keys =
        searched.flat_map(|key| (1..=spec.stars.len()).map(move |star| (key, star))).filter(has_own);
    let star_faults = own_keys.map(|(key, star)| {
        let message = format!("star {star} has its own `{}`", key.key());
        Fault::error(FaultCode::OwnValue, raw.span_of(key.of_star(star)), message)
            .label(format!("a value in [{}] does not reach it", key.section()))
            .help(format!("move it into [{}]", key.section()))
    });
    let star_faults: Vec<Fault> = star_faults.collect();
    if !star_faults.is_empty() {
        return Err(Faults::new(source, star_faults));
    }
    let (text, spec_read) = read_back(source, with_values(source, &entries)?)?;
    if spec_read.stars.first().map(StarEdit::new) == Some(*star) {
        Ok(text)
    } else {
        Err(cannot_edit(source, raw.span_of(key::star::POINTS), "the star", "must take new values"))
    }
}

/// The text of `source` with `value`, TOML of its own ("3", "\"40 mm\""), set at `key`, which is no key of a single star. Lines
/// end with LF. The result has been read back.
///
/// # Errors
/// If `source`, the value or the result is refused.
pub fn with_value(source: &Source, key: KeyPath, value: &str) -> Result<String, Faults> {
    with_changes(source, &[(key, Some(value))])
}

/// `source` with several values, of which only all together need be valid; `None` takes a key away, so that its default holds.
///
/// # Errors
/// If `source`, a value or the result is refused.
pub fn with_changes(source: &Source, values: &[(KeyPath, Option<&str>)]) -> Result<String, Faults> {
    let _ = read(source)?;
    read_back(source, edited(source, values)?).map(|(text, _)| text)
}

/// `text`, the edited text of `source`, if it is valid.
fn read_back(source: &Source, text: String) -> Result<(String, Spec), Faults> {
    let edited = Source::new(format!("{}, edited", source.name), text);
    read(&edited).map(|reading| (edited.text, reading.spec))
}

fn cannot_edit(source: &Source, place: Range<usize>, subject: &str, label: &str) -> Faults {
    let fault = Fault::error(FaultCode::Edit, place, format!("{subject} cannot be edited here"));
    Faults::new(source, vec![fault.label(label).help("write its section with one key a line")])
}

/// The text of `source`, a valid spec, with every key set to its value, TOML of its own. Lines end with LF. It has not been read
/// back: the values may not go together.
///
/// # Errors
/// If a value is not TOML, or the section of a key cannot be edited.
pub fn with_values(source: &Source, values: &[(KeyPath, String)]) -> Result<String, Faults> {
    let values: Vec<_> = values.iter().map(|(key, value)| (*key, Some(value.as_str()))).collect();
    edited(source, &values)
}

/// The text of `source` with `values`, each TOML of its own; `None` takes a key away, and its section with it if that is empty then.
/// Neither text need be a valid spec.
///
/// # Errors
/// If `source` or a value is not TOML, or the section of a key cannot be edited.
pub fn edited(source: &Source, values: &[(KeyPath, Option<&str>)]) -> Result<String, Faults> {
    let mut tree = document(source)?;
    // One of the two size keys replaces the other, unless both are set here.
    let replaced = |key: KeyPath| {
        let other = key.twin()?;
        (!values.iter().any(|(key, _)| *key == other)).then_some((other, None))
    };
    let set_sizes = values.iter().filter(|(_, value)| value.is_some());
    let replaced: Vec<_> = set_sizes.filter_map(|(key, _)| replaced(*key)).collect();
    for (key, value) in replaced.into_iter().chain(values.iter().copied()) {
        let Some(value) = value else {
            let root = tree.as_table_mut();
            let section: Option<&mut dyn TableLike> = match key.section() {
                "" => Some(root),
                name => root.get_mut(name).and_then(Item::as_table_like_mut),
            };
            let is_emptied =
                section.is_some_and(|section| section.remove(key.key()).is_some() && section.is_empty());
            if is_emptied && !key.section().is_empty() {
                let _ = tree.remove(key.section());
            }
            continue;
        };
        let value: Value = value.parse().map_err(|error| syntax(source, &error))?;
        if key.section().is_empty() {
            set(tree.as_table_mut(), false, key.key(), value);
            continue;
        }
        let item = tree.entry(key.section()).or_insert_with(toml_edit::table);
        let inline = item.is_inline_table();
        let Some(section) = item.as_table_like_mut() else {
            // Not in a valid spec.
            return Err(cannot_edit(source, 0..0, &format!("`{key}`"), "must take a new value"));
        };
        set(section, inline, key.key(), value);
    }
    Ok(tree.to_string())
}

/// The text of `source` with `value`, TOML of its own, at `key` of the process `name`, which is added if it is new; `None` takes the key
/// away. The section of the process stays, because seams may name it. Neither text need be a valid spec.
///
/// # Errors
/// If `source` or the value is not TOML, or the section of the process cannot be edited.
pub fn with_process(
    source: &Source,
    name: &str,
    key: KeyPath,
    value: Option<&str>,
) -> Result<String, Faults> {
    let mut tree = document(source)?;
    let value: Option<Value> =
        value.map(str::parse).transpose().map_err(|error: TomlError| syntax(source, &error))?;
    let unnamed_section = || {
        let mut table = toml_edit::Table::new();
        table.set_implicit(true);
        Item::Table(table)
    };
    let processes = tree.entry(key.section()).or_insert_with(unnamed_section).as_table_like_mut();
    let process = processes.map(|table| table.entry(name).or_insert_with(toml_edit::table));
    let Some(process) = process else {
        return Err(cannot_edit(source, 0..0, &format!("`{key}`"), "must take a new value"));
    };
    let inline = process.is_inline_table();
    match (process.as_table_like_mut(), value) {
        (Some(section), Some(value)) => set(section, inline, key.key(), value),
        (Some(section), None) => drop(section.remove(key.key())),
        (None, _) => {
            return Err(cannot_edit(source, 0..0, &format!("`process.{name}`"), "must take a new value"));
        }
    }
    Ok(tree.to_string())
}

/// The text of `source` with other comments behind values. `renewed` takes section, key and comment, "" for none, and returns the new
/// comment. Comments on lines of their own, and those within inline tables, stay.
///
/// # Errors
/// If `source` is not TOML.
pub fn with_comments(
    source: &Source,
    mut renewed: impl FnMut(&str, &str, &str) -> String,
) -> Result<String, Faults> {
    let mut tree = document(source)?;
    for (section, item) in tree.iter_mut() {
        let Some(table) = item.as_table_mut() else { continue };
        for (key, item) in table.iter_mut() {
            let Some(value) = item.as_value_mut() else { continue };
            let suffix = value.decor().suffix().and_then(toml_edit::RawString::as_str).unwrap_or_default();
            let (blanks, comment) = suffix.split_once('#').unwrap_or(("  ", ""));
            let new = renewed(section.get(), key.get(), comment.trim());
            if new != comment.trim() {
                let suffix = if new.is_empty() { String::new() } else { format!("{blanks}# {new}") };
                value.decor_mut().set_suffix(suffix);
            }
        }
    }
    Ok(tree.to_string())
}

/// The text of `source` as TOML with its layout.
pub(crate) fn document(source: &Source) -> Result<DocumentMut, Faults> {
    source.text.parse().map_err(|error| syntax(source, &error))
}

/// The fault of `source` where TOML cannot be read.
fn syntax(source: &Source, error: &TomlError) -> Faults {
    let fault = Fault::error(FaultCode::Syntax, error.span().unwrap_or(0..0), error.message());
    Faults::new(source, vec![fault])
}

/// Sets `key`; the blanks and comments around an old value stay.
pub(crate) fn set(section: &mut dyn TableLike, inline: bool, key: &str, mut value: Value) {
    if let Some(old) = section.get_mut(key).and_then(Item::as_value_mut) {
        *value.decor_mut() = old.decor().clone();
        *old = value;
        return;
    }
    // The blank before a `}` belongs to the last value: it goes with the end.
    let last = section.iter_mut().last().filter(|_| inline);
    if let Some(last) = last.and_then(|(_, item)| item.as_value_mut())
        && let Some(end) = last.decor().suffix().cloned()
    {
        last.decor_mut().set_suffix("");
        value.decor_mut().set_suffix(end);
    }
    let _ = section.insert(key, Item::Value(value));
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const TEXT: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 5   # n\ninner_radius = \"50 mm\"\n\
                        tube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n\n# the end\n[stack]\ncount = 2\n";

    #[test]
    fn a_section_goes_with_its_last_key() {
        let text =
            "name = \"a\"\n[mask]\nkind = \"separator\"\n[load]\npressure = \"5 kPa\"\nmass = \"1 kg\"\n";
        let keys = [(key::mask::KIND, None), (key::load::PRESSURE, None)];
        let rest = super::edited(&Source::new("x", text), &keys).expect("TOML");
        assert_eq!(rest, "name = \"a\"\n[load]\nmass = \"1 kg\"\n");
    }

    #[test]
    fn processes_are_changed_and_added_in_their_sections() {
        let process = |text: &str, name: &str, key: KeyPath, value: Option<&str>| {
            with_process(&Source::new("x", text), name, key, value).expect("TOML")
        };
        let (speed, passes) = (key::process::SPEED, key::process::PASSES);
        let added = process(TEXT, "weak", speed, Some("\"0.2 mm/s\""));
        assert!(
            added.starts_with(TEXT) && added.ends_with("[process.weak]\nspeed = \"0.2 mm/s\"\n"),
            "{added}"
        );
        let extended = process(&added, "weak", passes, Some("2"));
        assert!(extended.ends_with("speed = \"0.2 mm/s\"\npasses = 2\n"), "{extended}");
        assert_eq!(process(&extended, "weak", passes, None), added);
        assert!(process(&added, "weak", speed, None).ends_with("[process.weak]\n"), "seams may name it");
        let inline = process("process = { weak = { passes = 1 } }\n", "weak", passes, Some("3"));
        assert_eq!(inline, "process = { weak = { passes = 3 } }\n");
        assert!(with_process(&Source::new("x", "process = 1\n"), "weak", passes, Some("3")).is_err());
        assert!(with_process(&Source::new("x", "process.weak = 1\n"), "weak", passes, Some("3")).is_err());
        assert!(with_process(&Source::new("x", TEXT), "weak", passes, Some("= 3")).is_err());
    }

    #[test]
    fn single_values_are_set_wherever_they_stand() {
        let source = |text: &str| Source::new("x", text);
        let larger = with_value(&source(TEXT), key::stack::COUNT, "4").expect("a count");
        assert!(larger.contains("count = 4\n") && larger.contains("# the end"), "{larger}");
        let load = with_value(&source(TEXT), key::load::PRESSURE, "\"20 kPa\"").expect("a pressure");
        let loaded = read(&source(&load)).expect("valid").spec;
        assert_eq!(loaded.load.and_then(|load| load.pressure).map(|p| p.0), Some(20.0));
        let dotted = TEXT.replace("[stack]\ncount = 2\n", "").replace("[star]", "stack.count = 2\n[star]");
        assert!(
            with_value(&source(&dotted), key::stack::COUNT, "3")
                .expect("a count")
                .contains("stack.count = 3")
        );
        assert!(with_value(&source(TEXT), key::stack::COUNT, "0").is_err());
        assert!(with_value(&source(TEXT), key::stack::COUNT, "= 0").is_err());
    }

    #[test]
    fn comments_behind_values_are_renewed_or_dropped() {
        let source = Source::new(
            "x",
            TEXT.replace("\"50 mm\"", "\"50 mm\"   # old").replace("count = 2", "count = 2 # kept"),
        );
        let renewed = |section: &str, key: &str, comment: &str| match (section, key) {
            ("star", "points" | "tube_width") => "was 4".to_owned(),
            ("star", _) => String::new(),
            _ => comment.to_owned(),
        };
        let text = with_comments(&source, renewed).expect("TOML");
        assert!(text.contains("points = 5   # was 4\n"), "{text}");
        assert!(text.contains("tube_width = \"30 mm\"  # was 4\n"), "{text}");
        assert!(text.contains("inner_radius = \"50 mm\"\n") && text.contains("count = 2 # kept\n"), "{text}");
        assert!(text.contains("# the end\n"), "{text}");
    }

    /// One star in every layout that TOML has for it.
    const LAYOUTS: [&str; 9] = [
        TEXT,
        "schema = 1\nname = \"x\"\n[ star ]  # spaced\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"3 cm\"\ntip_angle = \"30 deg\"",
        "schema = 1\nname = \"x\"\nstar.points = 5\nstar.inner_radius = \"50 mm\"\nstar.tube_width = \"30 mm\" # W\nstar.tip_angle = \"30 deg\"\n[stack]\ncount = 2\n",
        "schema = 1\nname = \"x\"\nstar = { points = 5, inner_radius = \"50 mm\", tube_width = \"30 mm\", tip_angle = \"30 deg\" }\n",
        "schema = 1\nname = \"x\"\nstar = { points = 5, inner_radius = \"50 mm\", # hole\n  tube_width = \"30 mm\",\n  tip_angle = \"30 deg\", # sharp\n}\n[seal]\n",
        "schema = 1\nname = \"x\"\n[\"star\"]\n\"points\" = 5\n'inner_radius' = '50 mm'\n\"tube_width\" = '''30 mm'''\ntip_angle = \"30 deg\"\n",
        "schema = 1\nname = \"x\"\n\"star\".'points' = 5\nstar . inner_radius = \"50 mm\"\nstar.tube_width = \"30 mm\"\nstar.tip_angle = \"30 deg\"\n",
        "schema = 1\r\nname = \"x\"\r\n[stack]\r\ncount = 2\r\n\r\n[star] # last\r\npoints = 5\r\ninner_radius = \"50 mm\"\r\ntube_width = \"30 mm\"\r\ntip_angle = \"30 deg\"\r\n# end\r\n",
        "\u{feff}schema = 1\nname = \"x\"\n[star]\n    points    =   5\n    inner_radius = \"50 mm\"\n    tube_width   = \"30 mm\"    # W = 1\n    tip_angle = \"30 deg\"\n    tip_radius = \"1 mm\"\n    corner_radius = \"1 mm\"\n[[stack.star]]\nindex = 1\nrotation = \"45 deg\"\n",
    ];

    const EDIT: StarEdit = StarEdit {
        points: 4,
        tube_width: Length(28.125),
        tip_angle: Angle(31.5),
        tip_radius: Length(2.0),
        corner_radius: Length(0.0),
    };

    fn edited(text: &str, star: &StarEdit) -> String {
        with_star(&Source::new("x.toml", text), star).unwrap_or_else(|faults| panic!("{text}\n{faults}"))
    }

    #[test]
    fn values_are_replaced_or_added_and_the_rest_stays() {
        let expected = TEXT
            .replace("points = 5 ", "points = 4 ")
            .replace("30 mm", "28.125 mm")
            .replace("\"30 deg\"\n", "\"31.5 deg\"\ntip_radius = \"2 mm\"\ncorner_radius = \"0 mm\"\n");
        assert_eq!(edited(TEXT, &EDIT), expected);
    }

    #[test]
    fn several_values_are_judged_together_and_a_key_without_one_gets_its_default() {
        let source = Source::new("x", format!("{TEXT}[inlet]\ntip = 5\nlength = \"9 mm\"\n"));
        let four = (key::star::POINTS, Some("4"));
        assert!(with_changes(&source, &[four]).is_err(), "four points have no tip 5");
        let changes = [
            four,
            (key::inlet::TIP, Some("4")),
            (key::inlet::LENGTH, None),
            (key::root::NAME, Some("\"y\"")),
        ];
        let text = with_changes(&source, &changes).expect("valid together");
        assert!(text.starts_with("schema = 1\nname = \"y\"\n"), "{text}");
        let spec = read(&Source::new("back", text)).expect("valid").spec;
        assert_eq!((spec.stars[0].points, spec.inlet.map(|inlet| inlet.length)), (4, Some(Length(20.0))));
        let untouched = with_changes(&source, &[(key::load::MASS, None)]).expect("was not there");
        assert_eq!(untouched, source.text);
    }

    #[test]
    fn every_layout_keeps_its_form_and_its_comments() {
        let texts = LAYOUTS.map(|text| edited(text, &EDIT));
        for (text, kept) in texts.iter().zip([
            "points = 4   # n\n",
            "[ star ]  # spaced\npoints = 4\n",
            "star.tube_width = \"28.125 mm\" # W\nstar.tip_angle = \"31.5 deg\"\nstar.tip_radius = \"2 mm\"\n",
            "tube_width = \"28.125 mm\", tip_angle = \"31.5 deg\", tip_radius = \"2 mm\", corner_radius = \"0 mm\" }\n",
            "inner_radius = \"50 mm\", # hole\n  tube_width = \"28.125 mm\",\n",
            "[\"star\"]\n\"points\" = 4\n'inner_radius' = '50 mm'\n",
            "\"star\".'points' = 4\n\"star\". inner_radius = \"50 mm\"\n",
            "# end",
            "    tube_width   = \"28.125 mm\"    # W = 1\n",
        ]) {
            assert!(text.contains(kept) && !text.contains('\r'), "{kept}\n{text}");
        }
    }

    #[test]
    fn a_value_that_a_star_has_of_its_own_is_named() {
        for (index, value, section) in [
            (1, "tube_width = \"25 mm\"", "[star]"),
            (2, "inner_radius = \"55 mm\"", "[star]"),
            (2, "pitch = \"50 mm\"", "[stack]"),
        ] {
            let text = format!("{TEXT}[[stack.star]]\nindex = {index}\n{value}\n");
            let faults = with_star(&Source::new("x.toml", text), &EDIT).expect_err("refused");
            let fault = &faults.list()[0];
            assert_eq!((fault.code, faults.list().len()), ("own-value", 1), "{faults}");
            assert!(fault.message.starts_with(&format!("star {index} has its own")), "{faults}");
            assert!(fault.label.contains(section) && faults.to_string().contains("x.toml:14:"), "{faults}");
        }
        let turned = format!("{TEXT}[[stack.star]]\nindex = 2\nrotation = \"5 deg\"\n");
        let _ = with_star(&Source::new("x.toml", turned), &EDIT).expect("predictions do not depend on it");
    }

    #[test]
    fn what_the_new_values_make_invalid_is_refused() {
        let text = format!("{TEXT}[inlet]\ntip = 5\n");
        let faults = with_star(&Source::new("x.toml", text), &EDIT).expect_err("four points have no tip 5");
        assert!(faults.to_string().contains("x.toml, edited:"), "{faults}");
    }

    proptest! {
        /// The layouts times the values: the values read are those written.
        #[test]
        fn what_is_set_is_what_is_read(
            layout in 0..LAYOUTS.len(),
            points in 3..=64_u32,
            w in 1e-3..1e5_f64, angle in 1e-9..180.0_f64, r_i in 0.0..1e5_f64, r_e in 0.0..1e5_f64,
        ) {
            let star = StarEdit {
                points, tube_width: Length(w), tip_angle: Angle(angle), tip_radius: Length(r_i), corner_radius: Length(r_e),
            };
            let text = edited(LAYOUTS[layout], &star);
            let spec = read(&Source::new("back", text.as_str())).map_err(|f| TestCaseError::fail(f.to_string()))?.spec;
            prop_assert_eq!(StarEdit::new(&spec.stars[0]), star);
            // With the old values back, the spec is the old one.
            let old = read(&Source::new("old", LAYOUTS[layout])).expect("valid").spec;
            let back = edited(&text, &StarEdit::new(&old.stars[0]));
            prop_assert_eq!(read(&Source::new("x", back)).expect("valid").spec, old);
        }
    }
}
