//! `qr`: a link as a QR code.

use std::fmt::Write;

use qrcodegen::{QrCode, QrCodeEcc};
use serde_json::{Value, json};

use crate::commands::text;

/// Light modules around a code, which readers require (ISO/IEC 18004, 9.1).
const QUIET: i32 = 4;

/// The code of `link`: its `side` in modules with the quiet zone, and the `path` of its dark modules, as SVG path data. An empty object if
/// the link is longer than a code can hold: 2953 bytes.
pub(super) fn qr(question: &Value) -> Value {
    let link = text(question, "link").unwrap_or_default();
    let Ok(code) = QrCode::encode_text(link, QrCodeEcc::Low) else { return json!({}) };
    json!({ "side": code.size() + 2 * QUIET, "path": path(&code) })
}

/// One rectangle for each run of dark modules in a row.
fn path(code: &QrCode) -> String {
    let mut path = String::new();
    for y in 0..code.size() {
        let mut x = 0;
        while x < code.size() {
            let length = (x..code.size()).take_while(|x| code.get_module(*x, y)).count();
            if length > 0 {
                let _ = write!(path, "M{} {}h{length}v1h-{length}z", x + QUIET, y + QUIET);
            }
            x += i32::try_from(length).unwrap_or(0) + 1;
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_has_the_modules_of_its_code() {
        let code = QrCode::encode_text("https://example.org/#spec=abc", QrCodeEcc::Low).expect("short");
        let path = path(&code);
        let runs = path.split('h').skip(1).filter_map(|run| run.split_once('v')?.0.parse::<usize>().ok());
        let row = |y: i32| (0..code.size()).filter(|x| code.get_module(*x, y)).count();
        let dark: usize = (0..code.size()).map(row).sum();
        // `h-` moves back, so it is not a length.
        assert_eq!(runs.sum::<usize>(), dark);
    }

    #[test]
    fn a_link_that_is_too_long_has_no_code() {
        let code = |length| qr(&json!({ "link": "a".repeat(length) }));
        assert_eq!(code(2953)["side"], 177 + 2 * QUIET);
        assert_eq!(code(2954), json!({}));
    }
}
