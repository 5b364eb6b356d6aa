//! `link` and `qr`: what leads back to a spec.

use serde_json::{Value, json};
use stargrip_cam::link::LinkedSpec;

use crate::question::text;

/// Longest drawing in a link, letters: mails and chats break longer links.
const LONGEST_DRAWING: usize = 1 << 15;

/// What the link of a question shall hold.
fn linked_spec<'q>(question: &'q Value, files: &'q [(String, Vec<u8>)]) -> LinkedSpec<'q> {
    let drawing = files.first().map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
    LinkedSpec {
        spec: text(question, "spec").unwrap_or_default(),
        machine: text(question, "machine"),
        drawing,
    }
}

/// The `fragment` of the link; `is_long` if it does not hold the drawing, which would be too long for it.
pub(super) fn link(question: &Value, files: &[(String, Vec<u8>)]) -> Value {
    let linked = linked_spec(question, files);
    let (full, bare) = (linked.fragment(), LinkedSpec { drawing: None, ..linked }.fragment());
    let is_long = full.len() - bare.len() > LONGEST_DRAWING;
    json!({ "fragment": if is_long { bare } else { full }, "is_long": is_long })
}

/// The code of the link to the page at `address`: its `side` in modules with the quiet zone, and the `path` of its dark modules, in words of
/// SVG. Nothing of both if the link is too long for a code.
pub(super) fn qr(question: &Value, files: &[(String, Vec<u8>)]) -> Value {
    let code = linked_spec(question, files).code(text(question, "address").unwrap_or_default());
    code.map_or_else(|| json!({}), |code| json!({ "side": code.side(), "path": code.svg_path() }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_leaves_a_long_drawing_out_and_a_code_does_not() {
        let question = json!({ "spec": "name = 1\n", "address": "https://example.org/" });
        // Bytes that no packer shortens much.
        let mut state = 1_u64;
        let byte = std::iter::repeat_with(|| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state.to_le_bytes()[7]
        });
        let noise: Vec<u8> = byte.take(60_000).collect();
        for (drawing, is_long) in [(vec![7; 60_000], false), (noise, true)] {
            let files = [("a b.svg".to_owned(), drawing)];
            let answer = link(&question, &files);
            assert_eq!(answer["is_long"], is_long);
            let fragment = answer["fragment"].as_str().expect("a fragment");
            assert_eq!(fragment.contains("&file=a%20b.svg&drawing="), !is_long);
            assert_eq!(qr(&question, &files).get("path").is_none(), is_long);
        }
    }
}
