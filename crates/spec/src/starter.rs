//! The starter: a commented spec for a person to begin with.

use std::fmt::Write;

use crate::LayerRole;
use crate::name::check_name;
use artwork::Unit;

/// The starter, with a placeholder for the name.
pub(super) const TEMPLATE: &str = include_str!("../templates/spec.toml");
/// The placeholder, a whole TOML string so that nothing else in the text can match it.
const PLACEHOLDER: &str = "\"NAME\"";

/// The starter of a drawing.
const DRAWING: &str = include_str!("../templates/drawing.toml");

/// A valid spec called `name`, commented, with every key and its default: the paper's star.
///
/// # Errors
/// If `name` cannot be a spec's name.
pub fn starter(name: &str) -> Result<String, String> {
    Ok(TEMPLATE.replacen(PLACEHOLDER, &quoted(name)?, 1))
}

/// A spec called `name` of the drawing `file`, whose `layers` have these roles for these reasons, with the unit of its numbers if the file is not to decide.
///
/// # Errors
/// If `name` cannot be a spec's name.
pub fn drawing_starter(
    name: &str,
    file: &str,
    layers: &[(String, LayerRole, String)],
    unit: Option<Unit>,
) -> Result<String, String> {
    let mut roles = String::new();
    for (word, role) in LayerRole::ALL {
        let role_layers: Vec<&(String, LayerRole, String)> =
            layers.iter().filter(|layer| layer.1 == role).collect();
        for (layer, _, reason) in &role_layers {
            let _ = writeln!(roles, "# {}: {reason}", in_quotes(layer));
        }
        if !role_layers.is_empty() {
            let names: Vec<String> = role_layers.iter().map(|(layer, ..)| in_quotes(layer)).collect();
            let _ = writeln!(roles, "{word} = [{}]", names.join(", "));
        }
    }
    let absent = || "## units = \"mm\"        # in place of the unit that the file states".to_owned();
    let units = unit.map_or_else(absent, |unit| format!("units = \"{}\"", unit.name()));
    Ok(DRAWING
        .replacen(PLACEHOLDER, &quoted(name)?, 1)
        .replacen("\"FILE\"", &in_quotes(file), 1)
        .replacen("UNITS", &units, 1)
        .replacen("ROLES\n", &roles, 1))
}

/// `name` as TOML writes it.
///
/// # Errors
/// If `name` cannot be a spec's name.
pub fn quoted(name: &str) -> Result<String, String> {
    check_name(name)?;
    Ok(in_quotes(name))
}

/// `text` in quotes, with the characters escaped that TOML does not take as they are.
fn in_quotes(text: &str) -> String {
    let escaped = |c: char| match c {
        '\\' | '"' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
        c => c.to_string(),
    };
    format!("\"{}\"", text.chars().map(escaped).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Spec;
    use crate::reading::read;
    use crate::source::Source;

    fn spec(text: &str) -> Spec {
        match read(&Source::new("starter", text)) {
            Ok(reading) => {
                assert!(reading.warnings.is_empty(), "{}", reading.warnings);
                reading.spec
            }
            Err(faults) => panic!("{faults}"),
        }
    }

    /// The starter with the lines behind `mark` switched on.
    fn switched_on(mark: &str) -> String {
        let text = starter("x").expect("a name");
        // The section of a press is for its profile only, and an offset for a drag knife.
        let mut section = "";
        let lines = text.lines().map(|line| match line.strip_prefix(mark) {
            Some(rest) if begins_with_key(rest) => {
                section = if rest.starts_with('[') { rest } else { section };
                if section.starts_with("[press]") || rest.starts_with("blade_offset") { "" } else { rest }
            }
            _ => {
                section = if line.starts_with('[') { line } else { section };
                line
            }
        });
        lines.collect::<Vec<_>>().join("\n")
    }

    /// Whether `rest` of a line is a key with its value, or the head of a section.
    fn begins_with_key(rest: &str) -> bool {
        let word = rest.trim_start_matches('[').split([' ', ']']).next().unwrap_or_default();
        rest.starts_with('[') || rest[word.len()..].starts_with(" = ")
    }

    #[test]
    fn the_starter_reads_back_under_any_name() {
        for name in
            ["paper star", r#"a "b" \ 'c' {{name}} NAME"#, "\\", "\"\"\"", "../é星 # x = 1", &"n".repeat(80)]
        {
            assert_eq!(spec(&starter(name).expect("a name")).name, name);
        }
        for (name, words) in
            [("a\nb", "without control characters, here is U+000A"), ("", "at least one visible character")]
        {
            assert!(starter(name).expect_err("no name").contains(words), "{name:?}");
        }
    }

    /// Labels and ids of a drawing may have any character.
    #[test]
    fn layers_of_any_name_read_back() {
        let names = ["air\nouter", "a\r\tb", "\u{7f}\u{85}", "\u{56fe}\u{7eb8}", "\"\\"];
        let layers = names.map(|name| (name.to_owned(), LayerRole::Air, "a test".to_owned()));
        let text = drawing_starter("x", "a.svg", &layers, None).expect("a name");
        let drawing = spec(&text).drawing.expect("a drawing");
        let read: Vec<&str> = drawing.layers.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(read, names);
    }

    #[test]
    fn every_default_shown_is_the_default() {
        let text = switched_on("# ");
        assert!(text.lines().filter(|line| line.contains(" = ")).count() >= 40, "{text}");
        assert_eq!(spec(&text), spec(&starter("x").expect("a name")));
    }

    #[test]
    fn everything_shown_as_absent_can_be_written() {
        let full = spec(&switched_on("## "));
        let bare = spec(&starter("x").expect("a name"));
        assert_eq!((bare.load, bare.sheet.width, bare.mask.extent), (None, None, None));
        assert!(full.load.is_some() && full.sheet.width.is_some() && full.mask.extent.is_some());
        assert!(full.fabric.seal_strength.is_some() && full.fabric.areal_density.is_some());
        assert!(full.stars[0].inner_radius < bare.stars[0].inner_radius);
    }
}
