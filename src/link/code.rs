//! A link as a QR code (ISO/IEC 18004).

use std::fmt::Write;

use qrcodegen::{QrCode, QrCodeEcc};

/// Most letters of a link in a code: 40-L, bytes.
pub const MOST_LETTERS: usize = 2953;

/// Light modules around a code, which readers need (9.1).
const QUIET: i32 = 4;

/// A link as a QR code.
#[derive(Clone)]
pub struct LinkCode {
    link: String,
    code: QrCode,
}

impl LinkCode {
    /// The code of `link`; `None` if it is longer than [`MOST_LETTERS`].
    pub(super) fn new(link: String) -> Option<Self> {
        let code = QrCode::encode_text(&link, QrCodeEcc::Low).ok()?;
        Some(Self { link, code })
    }

    /// The link.
    pub fn link(&self) -> &str {
        &self.link
    }

    /// Side of the code with the quiet zone, in modules.
    pub fn side(&self) -> i32 {
        self.code.size() + 2 * QUIET
    }

    /// The runs of dark modules: column and row of the first, from the upper left of the quiet zone, and their number.
    pub fn runs(&self) -> Vec<[i32; 3]> {
        let size = self.code.size();
        let mut runs = Vec::new();
        for y in 0..size {
            let mut x = 0;
            while x < size {
                let end = (x..size).find(|x| !self.code.get_module(*x, y)).unwrap_or(size);
                if end > x {
                    runs.push([x + QUIET, y + QUIET, end - x]);
                }
                x = end + 1;
            }
        }
        runs
    }

    /// The dark modules as the path of an SVG, a module a unit.
    pub fn svg_path(&self) -> String {
        let mut path = String::new();
        for [x, y, length] in self.runs() {
            // A String takes everything.
            let _ = write!(path, "M{x} {y}h{length}v1h-{length}z");
        }
        path
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_the_dark_modules() {
        let code = LinkCode::new("https://example.org/#spec=abc".to_owned()).expect("short");
        let runs = code.runs();
        for y in 0..code.side() {
            for x in 0..code.side() {
                let covering =
                    runs.iter().filter(|run| run[1] == y && (run[0]..run[0] + run[2]).contains(&x));
                let dark = code.code.get_module(x - QUIET, y - QUIET);
                assert_eq!(covering.count(), usize::from(dark), "{x}, {y}");
            }
        }
        assert!(code.svg_path().starts_with("M4 4h7v1h-7z"));
    }

    #[test]
    fn a_link_that_is_too_long_has_no_code() {
        let code = |length| LinkCode::new("a".repeat(length));
        assert_eq!(code(MOST_LETTERS).map(|code| code.side()), Some(177 + 2 * QUIET));
        assert!(code(MOST_LETTERS + 1).is_none());
    }
}
