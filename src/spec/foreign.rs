//! Files of other kinds that are given as a spec: named once, instead of a syntax error for each of their lines.

use crate::spec::FaultCode;
use crate::spec::fault::Fault;

/// One fault about the whole `text`, which has syntax errors, if it is plainly a file of another kind.
pub(super) fn fault(text: &str) -> Option<Fault> {
    if text.contains('\r') && !text.contains('\n') {
        let fault = Fault::error(FaultCode::LineEnd, 0..0, "the lines end with CR alone")
            .label("the text is one line");
        return Some(fault.help("save the file with line ends of LF or CRLF"));
    }
    let kind = kind(text)?;
    let fault = Fault::error(FaultCode::NotASpec, 0..0, format!("this is {kind}, no TOML"))
        .label("it begins as such");
    Some(fault.help("name a TOML file instead: a build keeps its own beside its files, and `stargrip-cam new` writes one to begin with"))
}

/// What the text is, in a person's words.
fn kind(text: &str) -> Option<&'static str> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let begins = |with: &str| text.starts_with(with);
    let mut words = text.split_whitespace();
    if begins("<") {
        Some("XML, such as an SVG drawing")
    } else if begins("{") {
        Some("JSON")
    } else if begins("%PDF") {
        Some("a PDF")
    } else if words.next() == Some("0") && words.next() == Some("SECTION") {
        Some("a DXF drawing")
    } else if text.lines().find(|line| !is_comment(line)).is_some_and(is_gcode) {
        Some("G-code")
    } else {
        None
    }
}

/// Whether the line says nothing to a controller.
fn is_comment(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with([';', '(', '%'])
}

/// Whether the line begins with a word of G-code, and gives no key a value.
fn is_gcode(line: &str) -> bool {
    let code = line.split([';', '(']).next().unwrap_or_default().trim();
    let mut letters = code.chars();
    let begins = letters.next().is_some_and(|c| "GMNTFSgmntfs".contains(c))
        && letters.next().is_some_and(|c| c.is_ascii_digit());
    begins && !code.contains('=')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_another_kind_is_known_by_its_beginning() {
        for (text, found) in [
            ("; a program\n\nG21 ; mm\n", Some("G-code")),
            ("%\n(comment)\nN10 G0 X5\n", Some("G-code")),
            ("\u{feff} {\n \"a\": 1 }", Some("JSON")),
            ("<svg/>", Some("XML, such as an SVG drawing")),
            ("%PDF-1.7\n%\n", Some("a PDF")),
            ("  0\nSECTION\n", Some("a DXF drawing")),
            ("g1 = 5", None),
            ("[star]\npoints = five", None),
            ("# G1 X5\nname = \"x", None),
            ("", None),
        ] {
            assert_eq!(kind(text), found, "{text}");
        }
        assert_eq!(fault("schema = 1\rname = \"x\"\r").map(|fault| fault.code), Some("line-end"));
        assert_eq!(fault("schema = 1\r\nname = x\r\n"), None);
    }
}
