//! Files of other kinds, also other TOML files of this program: named once, instead of a fault for each of their lines.

use crate::FaultCode;
use crate::fault::{Fault, NewSpec};
use crate::product::ProductKind;
use crate::value::RawTable;

/// The TOML files that this program reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Document {
    Spec,
    Profile,
    Study,
    /// A person's own values for new specs.
    Defaults,
}

impl Document {
    /// The name of the kind in messages, keys of the first level that no other kind has, and the remedy in messages.
    const fn words(self) -> (&'static str, &'static [&'static str], &'static str) {
        match self {
            Self::Spec => ("a spec", &["stack", "seal"], "name it as the spec of a command"),
            Self::Profile => (
                "a machine profile",
                &["dialect", "work_area", "heights", "motion"],
                "name it as `profile` in the [machine] section of a spec",
            ),
            Self::Study => ("a study", &["vary", "rows", "draw"], "name it after `stargrip-cam study run`"),
            Self::Defaults => ("a file of defaults", &[], ""),
        }
    }

    /// One fault if `root` is plainly another kind of file than this one.
    pub(super) fn mistaken(self, root: &RawTable) -> Option<Fault> {
        let other_kinds = [Self::Spec, Self::Profile, Self::Study].into_iter().filter(|other| *other != self);
        let other = other_kinds
            .into_iter()
            .find(|other| other.has_key_in(root))
            .filter(|_| self != Self::Defaults && !self.has_key_in(root))?;
        let ((kind_words, ..), (name, _, use_of_it)) = (self.words(), other.words());
        let fault = Fault::error(FaultCode::NotASpec, 0..0, format!("this is {name}, not {kind_words}"));
        Some(
            fault
                .label("its sections are those of such a file")
                .help(format!("{use_of_it}; here {kind_words} is read")),
        )
    }

    /// Whether `root` has a key by which this kind of file is recognized.
    fn has_key_in(self, root: &RawTable) -> bool {
        let products: &[&str] = if self == Self::Spec { &ProductKind::WORDS } else { &[] };
        self.words().1.iter().chain(products).any(|key| root.get(key).is_some())
    }
}

/// One fault about the whole `text`, which has syntax errors, if it is plainly a file of another kind.
pub(super) fn fault(text: &str) -> Option<Fault> {
    if text.contains('\r') && !text.contains('\n') {
        let fault = Fault::error(FaultCode::LineEnd, 0..0, "the lines end with CR alone")
            .label("the text is one line");
        return Some(fault.help("save the file with line ends of LF or CRLF"));
    }
    let format = kind(text)?;
    let fault = Fault::error(FaultCode::NotASpec, 0..0, format!("this is {format}, not TOML"))
        .label("recognised by its beginning");
    let new_spec = if format.ends_with("drawing") { NewSpec::FromDrawing } else { NewSpec::Starter };
    Some(
        fault
            .help("name a TOML file instead: a build keeps its own beside its files")
            .or_new_spec(Some(new_spec)),
    )
}

/// The kind of the text, in plain words.
fn kind(text: &str) -> Option<&'static str> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let mut words = text.split_whitespace();
    if text.starts_with('<') {
        Some("XML, such as an SVG drawing")
    } else if text.starts_with('{') {
        Some("JSON")
    } else if text.starts_with("%PDF") {
        Some("a PDF")
    } else if words.next() == Some("0") && words.next() == Some("SECTION") {
        Some("a DXF drawing")
    } else if text.lines().find(|line| !is_comment(line)).is_some_and(is_gcode) {
        Some("G-code")
    } else if text.lines().next().is_some_and(is_heading) {
        Some("a table of values")
    } else {
        None
    }
}

/// Whether the line has columns, as the first of a CSV has, and gives no key a value.
fn is_heading(line: &str) -> bool {
    let has_columns = [',', ';', '\t'].iter().any(|between| line.contains(*between));
    has_columns && !line.contains(['=', '[', '#', '"'])
}

/// Whether the line is empty or a comment, so that a controller ignores it.
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
    use crate::{Faults, Source};

    #[test]
    fn another_toml_file_of_the_program_is_named_once() {
        let profile = crate::builtin_machine("grbl").expect("shipped");
        let study = "schema = 1\nspec = \"a.toml\"\n[vary]\n\"star.points\" = [3, 4]\n";
        let star = crate::starter("star").expect("a name");
        let read = |text: &str| crate::read(&Source::new("a.toml", text)).map(|_| ());
        let as_profile = |text: &str| crate::read_machine(&Source::new("a.toml", text)).map(|_| ());
        let as_study = |text: &str| crate::study::read_study(&Source::new("a.toml", text)).map(|_| ());
        for (read, text, says) in [
            (&read as &dyn Fn(&str) -> Result<(), Faults>, profile, "a machine profile, not a spec"),
            (&read, study, "a study, not a spec"),
            (&as_profile, &star, "a spec, not a machine profile"),
            (&as_profile, study, "a study, not a machine profile"),
            (&as_study, &star, "a spec, not a study"),
            (&as_study, profile, "a machine profile, not a study"),
        ] {
            let faults = read(text).expect_err(says);
            let codes: Vec<&str> = faults.list().iter().map(|fault| fault.code).collect();
            assert_eq!(codes, ["not-a-spec"], "{says}");
            assert!(faults.to_string().contains(says), "{faults}");
        }
        assert!(read(&star).is_ok() && as_profile(profile).is_ok());
    }

    #[test]
    fn a_file_of_another_kind_is_known_by_its_beginning() {
        for (text, found) in [
            ("; a program\n\nG21 ; mm\n", Some("G-code")),
            ("%\n(comment)\nN10 G0 X5\n", Some("G-code")),
            ("\u{feff} {\n \"a\": 1 }", Some("JSON")),
            ("<svg/>", Some("XML, such as an SVG drawing")),
            ("%PDF-1.7\n%\n", Some("a PDF")),
            ("  0\nSECTION\n", Some("a DXF drawing")),
            ("name,radius,width\n1,2,3\n", Some("a table of values")),
            ("g1 = 5", None),
            ("[star]\npoints = five", None),
            ("# G1 X5\nname = \"x", None),
            ("", None),
        ] {
            assert_eq!(kind(text), found, "{text}");
        }
        for (text, new_spec) in [("<svg/>", NewSpec::FromDrawing), ("{", NewSpec::Starter)] {
            assert_eq!(fault(text).and_then(|fault| fault.new_spec), Some(new_spec));
        }
        assert_eq!(fault("schema = 1\rname = \"x\"\r").map(|fault| fault.code), Some("line-end"));
        assert_eq!(fault("schema = 1\r\nname = x\r\n"), None);
    }
}
