//! A spec's text with other values in its `[star]` section, everything else as it was, comments included.

use crate::spec::{Source, read};
use std::fmt::Write;

/// The text with `values` (key, TOML value) set in `[star]`; the result is read back and must say so.
///
/// # Errors
/// One sentence, if the text's layout is not the usual one (`[star]` on a line of its own, one key a line).
pub fn with_star(text: &str, values: &[(&str, String)]) -> Result<String, String> {
    let mut out = String::new();
    let mut written = vec![false; values.len()];
    let mut inside = false;
    let mut end_of_section = 0;
    for line in text.split_inclusive('\n') {
        let trimmed = line.trim_start();
        if trimmed.starts_with('[') {
            inside = trimmed.trim_end().split('#').next().unwrap_or_default().trim() == "[star]";
        }
        let key = trimmed.split('=').next().unwrap_or_default().trim();
        let place = values.iter().position(|(name, _)| inside && trimmed.contains('=') && *name == key);
        match place {
            Some(i) => {
                let comment = line.find('#').map_or("", |at| line[at..].trim_end());
                let gap = if comment.is_empty() { "" } else { "  " };
                let _ = writeln!(out, "{key} = {}{gap}{comment}", values[i].1);
                written[i] = true;
            }
            None => out.push_str(line),
        }
        if inside && !trimmed.trim().is_empty() && !trimmed.starts_with('#') {
            end_of_section = out.len();
        }
    }
    let mut missing = String::new();
    for ((key, value), _) in values.iter().zip(&written).filter(|(_, written)| !**written) {
        let _ = writeln!(missing, "{key} = {value}");
    }
    out.insert_str(end_of_section, &missing);
    let source = Source::new("the optimised spec", out.as_str());
    let _ = read(&source)
        .map_err(|_| "the spec's layout is not understood: write [star] with one key a line".to_owned())?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 5   # n\ninner_radius = \"50 mm\"\n\
                        tube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n\n# the end\n[stack]\ncount = 2\n";

    #[test]
    fn values_are_replaced_or_added_and_the_rest_stays() {
        let values = [("points", "4".to_owned()), ("tip_radius", "\"2 mm\"".to_owned())];
        let text = with_star(TEXT, &values).expect("the usual layout");
        let spec = read(&Source::new("x", text.as_str())).expect("valid").spec;
        assert_eq!((spec.stars[0].points, spec.stars[0].tip_radius.0, spec.stars.len()), (4, 2.0, 2));
        assert!(text.contains("points = 4  # n\n") && text.contains("# the end\n"));
        assert_eq!(
            text.replace("tip_radius = \"2 mm\"\n", "").replace("points = 4  # n", "points = 5   # n"),
            TEXT
        );
    }

    #[test]
    fn another_layout_is_refused() {
        let text = "schema = 1\nname = \"x\"\nstar = { points = 5, inner_radius = \"50 mm\", tube_width = \"30 mm\", tip_angle = \"30 deg\" }\n";
        assert!(with_star(text, &[("points", "4".to_owned())]).is_err());
    }
}
