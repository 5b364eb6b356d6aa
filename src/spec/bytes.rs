//! From the bytes of a file to a [`Source`].

use crate::spec::FaultCode;
use crate::spec::fault::Fault;
use crate::spec::faults::Faults;
use crate::spec::source::{SIZE_LIMIT, Source};

impl Source {
    /// A source from the bytes of a file.
    ///
    /// # Errors
    /// If there are more than [`SIZE_LIMIT`] bytes, or if they are not UTF-8; the fault shows the first line that is not.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> Result<Self, Faults> {
        let name = name.into();
        if bytes.len() > SIZE_LIMIT {
            let message = format!("the file is larger than {} MiB", SIZE_LIMIT >> 20);
            let fault = Fault::error(FaultCode::TooLarge, 0..0, message)
                .label("a spec or a profile is a few kB of text")
                .help("is this the right file?");
            return Err(Faults::new(&Self::new(name, ""), vec![fault]));
        }
        match std::str::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, text)),
            Err(error) => {
                let at = error.valid_up_to();
                let byte = bytes.get(at).copied().unwrap_or_default();
                let line_end = bytes[at..].iter().position(|b| *b == b'\n').map_or(bytes.len(), |n| at + n);
                let shown = String::from_utf8_lossy(&bytes[..line_end]);
                let fault = Fault::error(
                    FaultCode::NotText,
                    at..at + 1,
                    format!("byte {} is {byte:#04x}: not UTF-8", at + 1),
                )
                .label("the text ends here")
                .help("save the file as UTF-8");
                Err(Faults::new(&Self::new(name, shown), vec![fault]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_taken_as_it_is() {
        let source = Source::from_bytes("a.toml", "schema = 1\r\n# µ\n".as_bytes()).expect("UTF-8");
        assert_eq!(source, Source::new("a.toml", "schema = 1\r\n# µ\n"));
    }

    #[test]
    fn the_line_that_is_not_utf8_is_named() {
        let faults =
            Source::from_bytes("a.toml", b"schema = 1\nname = \"\xe9t\xe9\"\nx").expect_err("Latin-1");
        assert_eq!(faults.list()[0].code, "not-text");
        assert!(faults.to_string().contains("a.toml:2:9"), "{faults}");
    }

    #[test]
    fn a_file_above_the_limit_is_refused_unread() {
        assert!(Source::from_bytes("a", &vec![b'\n'; SIZE_LIMIT]).is_ok());
        let faults = Source::from_bytes("a", &vec![0xff; SIZE_LIMIT + 1]).expect_err("one byte too many");
        assert_eq!(faults.list()[0].code, "too-large");
        assert!(faults.to_string().contains("larger than 1 MiB"), "{faults}");
    }
}
