//! The page: the frame, its style and scripts, and the blocks of data, joined.
//!
//! The spec's own words enter it in two places only: the title, and the block of figures. Both are escaped so that nothing in them
//! can end the place they are in, and no address of a network can be read out of them. A policy in the head lets the browser run
//! the page's own scripts and styles, which it names by their hashes, and fetch nothing at all.

use std::borrow::Cow;
use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use serde_json::Value;
use sha2::{Digest, Sha256};

use crate::emit::report::bare::bare;
use crate::link::LinkCode;
use design::PressPlan;
use program::text::filled;

const FRAME: &str = include_str!("../../../templates/report/page.html");

/// The styles of the page: on a screen, on paper.
const STYLES: [&str; 2] =
    [bare!("../../../templates/report/screen.css"), bare!("../../../templates/report/paper.css")];

/// The scripts, in the order in which they run: each uses only those before it.
const SCRIPTS: [&str; 12] = [
    bare!("../../../templates/report/words.js"),
    bare!("../../../templates/report/drawing.js"),
    bare!("../../../templates/report/drawing_page.js"),
    bare!("../../../templates/report/verdict.js"),
    bare!("../../../templates/report/player.js"),
    bare!("../../../templates/report/star.js"),
    bare!("../../../templates/report/plots.js"),
    bare!("../../../templates/report/glb.js"),
    bare!("../../../templates/report/scene.js"),
    bare!("../../../templates/report/tables.js"),
    bare!("../../../templates/report/place.js"),
    bare!("../../../templates/report/start.js"),
];

/// The script of the page for a heat press, behind the others but the last, which starts the page.
const PRESS_SCRIPT: &str = bare!("../../../templates/report/press.js");

/// Compression level of the scene, 0 to 10: beyond 6 it takes twice the time for a hundredth of the size.
const PACKED: u8 = 6;

/// The page for a design called `name`, with its figures, its scene, the code of the link to its spec, and the plan of a press.
pub(super) fn page(
    name: &str,
    data: &Value,
    scene: &[u8],
    code: Option<&LinkCode>,
    plan: Option<&PressPlan>,
) -> String {
    // Styles and scripts are inside the page, and its policy names them by their hashes, so that nothing else runs. The scene is
    // packed; a press has a frame and a script of its own.
    let mut scripts = SCRIPTS.to_vec();
    if plan.is_some() {
        scripts.insert(SCRIPTS.len() - 1, PRESS_SCRIPT);
    }
    let (style, script) = (joined(&STYLES), joined(&scripts));
    let policy = format!(
        "default-src 'none'; script-src '{}'; style-src '{}'; img-src data:; base-uri 'none'; form-action 'none'",
        hash(&script),
        hash(&style)
    );
    let scene = STANDARD.encode(compress_to_vec_zlib(scene, PACKED));
    let title = text(name);
    let data = block(data);
    let code = code.map(of_link).unwrap_or_default();
    let parts = [
        ("POLICY", policy.as_str()),
        ("TITLE", title.as_str()),
        ("STYLE", style.as_str()),
        ("DATA", data.as_str()),
        ("SCENE", scene.as_str()),
        ("SCRIPT", script.as_str()),
        ("CODE", code.as_str()),
    ];
    let frame = plan.map_or(Cow::Borrowed(FRAME), |plan| Cow::Owned(press_frame(plan)));
    filled(&frame, ["{{", "}}"], &parts)
}

/// The frame with the plan of a press, without what is about programs and an iron.
fn press_frame(plan: &PressPlan) -> String {
    let mut html = format!(
        "<section id=\"press\" aria-labelledby=\"press-title\">\n<h2 id=\"press-title\">Pressing</h2>\n<p class=\"lead\">{}</p>\n",
        text(&plan.settings)
    );
    for section in &plan.sections {
        let _ = write!(html, "<h3>{}</h3>\n<ol>\n", text(section.heading));
        for line in &section.lines {
            let _ = writeln!(html, "<li>{}</li>", text(line));
        }
        html.push_str("</ol>\n");
    }
    html.push_str("</section>\n\n");
    // Text of a spec must not look like a place that is filled in.
    let html = html.replace("{{", "{ {");
    let changes = [
        ("<section id=\"seal\"", format!("{html}<section id=\"seal\" hidden")),
        (
            "<section aria-labelledby=\"before-title\"",
            "<section hidden aria-labelledby=\"before-title\"".to_owned(),
        ),
        (
            "<section aria-labelledby=\"sealing-title\"",
            "<section hidden aria-labelledby=\"sealing-title\"".to_owned(),
        ),
        ("<a href=\"#seal\">Sealing</a>", "<a href=\"#press\">Pressing</a>".to_owned()),
    ];
    changes.iter().fold(FRAME.to_owned(), |frame, (from, to)| frame.replacen(from, to, 1))
}

/// Width of a printed page, in modules of 0.5 mm, which phones read from paper.
const ACROSS: i32 = 364;

/// The QR code of the link to the spec.
fn of_link(code: &LinkCode) -> String {
    let (side, path, link) = (code.side(), code.svg_path(), text(code.link()));
    // Pictures of a report are as wide as its page: the code takes a third of that, or what its modules need.
    let shown_side = ACROSS.min(3 * side);
    format!(
        "<p><a href=\"{link}\"><svg viewBox=\"0 0 {shown_side} {side}\" role=\"img\" aria-label=\"QR code of the link to this spec\">\
         <path fill=\"#fff\" d=\"M0 0h{side}v{side}H0z\"/><path fill=\"#000\" d=\"{path}\"/></svg></a></p>\n\
         <p>The code opens this spec in the page, to be changed and made again.</p>"
    )
}

fn joined(parts: &[&str]) -> String {
    format!("\n{}", parts.join("\n"))
}

/// The name of a script or a style in a policy.
fn hash(text: &str) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(text.as_bytes())))
}

/// Text for an element or an attribute: every character with a meaning there, or at the start of an address, by its number.
fn text(words: &str) -> String {
    escaped(words, &['&', '<', '>', '"', '\'', '/', '`'], |number| format!("&#{number};"))
}

/// JSON for a script element: no `<` that could end it, no `/` of an address, and no line end that only old readers of scripts
/// treat as one.
fn block(data: &Value) -> String {
    let marks = ['<', '>', '&', '/', '\u{2028}', '\u{2029}'];
    escaped(&data.to_string(), &marks, |number| format!("\\u{number:04x}"))
}

/// The text with each of `marks` written by its number.
fn escaped(text: &str, marks: &[char], number_of: impl Fn(u32) -> String) -> String {
    let mut safe_text = String::with_capacity(text.len());
    for c in text.chars() {
        if marks.contains(&c) {
            safe_text.push_str(&number_of(u32::from(c)));
        } else {
            safe_text.push(c);
        }
    }
    safe_text
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;

    /// Words that try to break out of the place they are in.
    fn hostile() -> impl Strategy<Value = String> {
        let hostile_texts = prop::sample::select(vec![
            "</script><script>alert(1)</script>",
            "<img src=x onerror=alert(1)>",
            "\"><svg onload=alert(1)>",
            "<!--<script>",
            "]]>",
            "{{SCRIPT}}",
            "{{DATA}}",
            "&lt;b&gt;",
            "http://example.org/",
            "\u{2028}\u{202e}",
            "javascript:alert(1)",
            "' onmouseover='alert(1)",
        ]);
        prop::collection::vec(prop_oneof![hostile_texts.prop_map(str::to_owned), "\\PC{0,8}"], 0..4)
            .prop_map(|parts| parts.concat())
    }

    fn text_between<'a>(page: &'a str, from: &str, to: &str) -> &'a str {
        let (_, rest) = page.split_once(from).expect("its beginning");
        rest.split_once(to).expect("its end").0
    }

    proptest! {
        #[test]
        fn no_words_of_a_spec_get_out_of_their_place(words in hostile()) {
            let data = json!({ "name": words, words.clone(): [words] });
            let (page_of_words, plain) = (page(&words, &data, b"glb", None, None), page("", &json!({}), b"glb", None, None));
            for mark in ["<", ">", "://"] {
                prop_assert_eq!(page_of_words.matches(mark).count(), plain.matches(mark).count(), "{}", mark);
            }
            let block = text_between(&page_of_words, "<script type=\"application/json\" id=\"data\">", "</script>");
            prop_assert_eq!(serde_json::from_str::<Value>(block).expect("JSON"), data);
            let title = text_between(&page_of_words, "<title>", "</title>");
            prop_assert!(!title.contains(['<', '>', '"', '\'', '/']), "{}", title);
        }
    }

    #[test]
    fn the_policy_names_the_very_scripts_and_styles() {
        let whole_page = page("x", &json!({}), b"glb", None, None);
        for (from, to) in [("<style>", "</style>"), ("<script>", "</script>")] {
            prop_assert_hash(&whole_page, text_between(&whole_page, from, to));
        }
        assert_eq!(whole_page.matches("<script>").count(), 1);
        assert_eq!(whole_page.matches("<style>").count(), 1);
    }

    fn prop_assert_hash(page: &str, text: &str) {
        assert!(page.contains(&hash(text)), "{}", hash(text));
    }
}
