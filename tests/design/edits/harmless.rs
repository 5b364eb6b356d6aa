//! Harmless edits: the rules by which an edit changes no product and no message. None of them is the verifier's.

use serde_json::Value;
use stargrip_cam::manifest::MANIFEST;
use stargrip_cam::spec;
use stargrip_cam::spec::{Machine, Source};

use super::directories::kind_of;
use super::same_way::same_way;

/// The reason why an edit changes no product and no message; `None` if it changes one.
pub(crate) fn harmless(name: &str, before: &[u8], after: &[u8]) -> Option<&'static str> {
    if before == after {
        return Some("the same bytes");
    }
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).ok();
    let (Some(a), Some(b)) = (text(before), text(after)) else {
        return match kind_of(name) {
            "stl" => same_solid(before, after).then_some("a normal off by less than 0.3 %"),
            _ => None,
        };
    };
    match kind_of(name) {
        "spec.toml" | "machine.toml" => same_meaning(name, &a, &b).then_some("the same meaning"),
        "prediction" | MANIFEST => same_values(&a, &b).then_some("the same values"),
        "gcode" => same_way(&a, &b).then_some("the same way at the same speed, and nothing else said"),
        "dxf" if a.lines().map(str::trim).eq(b.lines().map(str::trim)) => Some("white space"),
        "svg" if same_but_blanks(&a, &b) => Some("white space"),
        kind @ ("svg" | "dxf") => {
            same_numbers(kind, &a, &b, 1e-3).then_some("a number off by less than asked for")
        }
        _ => None,
    }
}

/// Whether figures and names are equal, whatever the version of the tool: for another version only reading is a proof, and `verify`
/// reports it.
fn same_values(a: &str, b: &str) -> bool {
    let value = |text: &str| {
        let mut value: Value = serde_json::from_str(text).ok()?;
        if let Some(version) = value.pointer_mut("/tool/version").filter(|version| version.is_string()) {
            *version = "any".into();
        }
        Some(value)
    };
    let (Some(a), Some(b)) = (value(a), value(b)) else { return false };
    are_near(&a, &b)
}

/// Whether values are equal; numbers to one in 10^9, as another processor may calculate them.
fn are_near(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().expect("a number"), b.as_f64().expect("a number"));
            (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-9)
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| are_near(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| are_near(a, b)))
        }
        _ => a == b,
    }
}

/// Whether texts are equal except for blanks, and for blanks and zeros between the numbers of a path as SVG's grammar reads them.
fn same_but_blanks(a: &str, b: &str) -> bool {
    let parts = |text: &str| -> Vec<String> {
        let quoted = text.split('"').zip([false, true].into_iter().cycle());
        let part = |(part, quoted): (&str, bool)| {
            if quoted && part.starts_with('M') {
                format!("{:?}", path_words(part))
            } else {
                part.split_ascii_whitespace().collect()
            }
        };
        quoted.map(part).collect()
    };
    parts(a) == parts(b)
}

/// The letters and numbers of path data; flags of arcs are one digit and need no blank after them.
fn path_words(data: &str) -> Vec<(char, Option<f64>)> {
    let (mut words, mut rest) = (Vec::new(), data);
    let (mut letter, mut count) = (' ', 0);
    loop {
        rest = rest.trim_start_matches([' ', ',', '\n']);
        let Some(first) = rest.chars().next() else { return words };
        if first.is_ascii_alphabetic() {
            (letter, count, rest) = (first, 0, &rest[1..]);
            words.push((letter, None));
            continue;
        }
        let flag = letter == 'A' && matches!(count % 7, 3 | 4);
        let digits =
            rest.char_indices().find(|(i, c)| !(c.is_ascii_digit() || *c == '.' || *i == 0 && *c == '-'));
        let end = if flag { 1 } else { digits.map_or(rest.len(), |(i, _)| i) };
        let Some(Ok(number)) = rest.get(..end).map(str::parse::<f64>) else { return vec![('?', None)] };
        words.push((letter, Some(number)));
        (count, rest) = (count + 1, &rest[end..]);
    }
}

/// Whether specs or profiles are equal, except for texts without effect: the name of the profile in a spec whose profile lies beside it, and
/// the profile's description of itself.
fn same_meaning(name: &str, a: &str, b: &str) -> bool {
    let read = |text: &str| {
        let source = Source::new(name, text);
        if name == "machine.toml" {
            let machine = spec::read_machine(&source).ok()?;
            Some(format!("{:?}", Machine { description: String::new(), ..machine }))
        } else {
            let mut spec = spec::read(&source).ok()?.spec;
            spec.machine.profile = String::new();
            Some(format!("{spec:?}"))
        }
    };
    let (a, b) = (read(a), read(b));
    a.is_some() && a == b
}

/// Whether words are equal except for numbers that differ by no more than `tolerance`, mm.
fn same_numbers(kind: &str, a: &str, b: &str, tolerance: f64) -> bool {
    let split = |text: &str| -> Vec<String> {
        text.split(|c: char| c.is_ascii_whitespace() || "\"'<>=,".contains(c))
            .filter(|word| !word.is_empty())
            .map(|word| word.trim_start_matches(|c: char| kind == "svg" && "MLA".contains(c)).to_owned())
            .filter(|word| !word.is_empty())
            .collect()
    };
    let (a, b) = (split(a), split(b));
    let are_near = |a: &str, b: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= tolerance,
        _ => false,
    };
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a == b || are_near(a, b))
}

fn same_solid(before: &[u8], after: &[u8]) -> bool {
    before.len() == after.len()
        && before[..84] == after[..84]
        && before[84..].chunks_exact(50).zip(after[84..].chunks_exact(50)).all(|(a, b)| {
            let number =
                |raw: &[u8], k: usize| f32::from_le_bytes(raw[4 * k..4 * k + 4].try_into().expect("four"));
            a[12..] == b[12..] && (0..3).all(|k| (number(a, k) - number(b, k)).abs() <= 0.003)
        })
}
