//! A person's own defaults for fabric, sheet and machine in a new spec.
//!
//! They are written into the new spec and are read by nothing else: a spec has the same meaning everywhere.

use crate::faults::Faults;
use crate::foreign::Document;
use crate::raw::RawSpec;
use crate::reading::{read_choice, read_fabric, read_sheet, read_with};
use crate::source::Source;

/// The sections that may have personal defaults.
const SECTIONS: [&str; 3] = ["fabric", "sheet", "machine"];

/// Adds the values of fabric, sheet and machine in `config` to `spec`, a valid spec text, for keys that it does not set.
///
/// # Errors
/// All faults of `config`, by the rules of a spec.
pub fn with_defaults(spec: &str, config: &Source) -> Result<String, Faults> {
    let ((), _, raw) = read_with(config, Document::Defaults, |reader| {
        let _ = reader.root();
        let _ = read_fabric(&mut reader.section("fabric"));
        let _ = read_sheet(&mut reader.section("sheet"));
        let _ = read_choice(&mut reader.section("machine"));
    })?;
    let mut lines: Vec<String> = spec.lines().map(str::to_owned).collect();
    for section in SECTIONS {
        let entries =
            raw.root().get(section).and_then(|value| value.as_table()).into_iter().flat_map(|table| &table.0);
        for entry in entries {
            let value = config.text.get(entry.value.span.clone()).unwrap_or_default();
            write(&mut lines, section, &entry.key, value);
        }
    }
    let text = lines.join("\n") + "\n";
    // Values that are not valid as personal defaults are not written.
    let (_, faults) = RawSpec::parse(&text);
    if faults.is_empty() { Ok(text) } else { Ok(spec.to_owned()) }
}

/// Writes `key = value` into `section`, in place of the comment that shows the key, unless the section sets it already.
fn write(lines: &mut Vec<String>, section: &str, key: &str, value: &str) {
    let header = format!("[{section}]");
    let Some(start) = lines.iter().position(|line| line.trim() == header) else {
        lines.extend([String::new(), header, format!("{key} = {value}")]);
        return;
    };
    let end = lines[start + 1..]
        .iter()
        .position(|line| line.starts_with('['))
        .map_or(lines.len(), |n| start + 1 + n);
    if lines[start..end].iter().any(|line| has_key(line, "", key)) {
        return;
    }
    let template_line =
        (start..end).find(|at| ["# ", "## "].iter().any(|mark| has_key(&lines[*at], mark, key)));
    match template_line {
        Some(at) => {
            let words = lines[at].rsplit_once(" # ").map_or("", |(_, words)| words).to_owned();
            let entry = format!("{key} = {value}");
            lines[at] = if words.is_empty() { entry } else { format!("{entry:32}  # {words}") };
        }
        None => lines.insert(start + 1, format!("{key} = {value}")),
    }
}

/// Whether `line` sets `key` behind `mark`.
fn has_key(line: &str, mark: &str, key: &str) -> bool {
    let after_key = line.strip_prefix(mark).and_then(|line| line.strip_prefix(key));
    after_key.is_some_and(|rest| rest.trim_start().starts_with('='))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::read;
    use crate::starter::starter;

    fn default_text(config: &str) -> Result<String, Faults> {
        with_defaults(&starter("x").expect("a name"), &Source::new("config.toml", config))
    }

    #[test]
    fn defaults_of_ones_own_are_written_where_the_starter_shows_the_key() {
        let config = "[machine]\nprofile = 'grbl' # ours\nfeed_floor = \"chop\"\n[sheet]\nwidth = \"400 mm\"\n[fabric]\nseal_strength = \"2.5 N/mm\"\n";
        let text = default_text(config).expect("sound");
        let spec = read(&Source::new("x", text.as_str())).unwrap_or_else(|faults| panic!("{faults}")).spec;
        assert_eq!(
            (spec.machine.profile.as_str(), spec.sheet.width.map(|width| width.0)),
            ("grbl", Some(400.0))
        );
        assert_eq!(spec.fabric.seal_strength.map(|strength| strength.0), Some(2.5));
        assert_eq!(text.lines().count(), starter("x").expect("a name").lines().count());
        assert!(text.contains("profile = 'grbl'                  # a built-in profile"), "{text}");
    }

    #[test]
    fn what_a_spec_says_itself_stays() {
        let spec = "schema = 1\n[sheet]\nwidth = \"600 mm\"\n[star]\npoints = 5";
        let config = Source::new(
            "config.toml",
            "[sheet]\nwidth = \"400 mm\"\nheight = \"300 mm\"\n[machine]\nprogram = \"sheet\"\n",
        );
        let text = with_defaults(spec, &config).expect("sound");
        assert_eq!(
            text,
            "schema = 1\n[sheet]\nheight = \"300 mm\"\nwidth = \"600 mm\"\n[star]\npoints = 5\n\n[machine]\nprogram = \"sheet\"\n"
        );
    }

    #[test]
    fn faults_of_the_defaults_are_told_as_those_of_a_spec() {
        for (config, code) in [
            ("[machin]\nprofile = \"grbl\"\n", "unknown-section"),
            ("[sheet]\nwidht = \"400 mm\"\n", "unknown-key"),
            ("[sheet]\nwidth = 400\n", "no-unit"),
            ("[star]\npoints = 3\n", "unknown-section"),
            ("{", "not-a-spec"),
        ] {
            let faults = default_text(config).expect_err(config);
            assert_eq!(faults.list()[0].code, code, "{faults}");
        }
    }
}
