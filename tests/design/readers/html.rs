//! HTML as reports have it: a frame of plain elements, one style, one script, and two blocks of data.
//!
//! A page is read by a list of what it may contain: every element and every attribute is on the list, links lead only to other
//! places on the page, and only the style and the script that the policy names by their hashes can run. Outside of scripts and
//! styles the page is well-formed XML, which both kinds of readers understand in the same way.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
use roxmltree::{Document, Node};
use serde_json::Value;
use sha2::{Digest, Sha256};

/// Elements that a report has, beside scripts, the style and meta.
const ELEMENTS: [&str; 39] = [
    "html",
    "head",
    "title",
    "body",
    "a",
    "header",
    "nav",
    "main",
    "section",
    "footer",
    "noscript",
    "p",
    "h1",
    "h2",
    "h3",
    "div",
    "dl",
    "ul",
    "li",
    "label",
    "span",
    "b",
    "code",
    "figure",
    "figcaption",
    "svg",
    "select",
    "button",
    "input",
    "output",
    "fieldset",
    "legend",
    "canvas",
    "table",
    "caption",
    "meta",
    "style",
    "script",
    "details",
];

/// Attributes that they may have, beside `aria-...`; none of them runs or fetches anything, `href` is looked into.
const ATTRIBUTES: [&str; 26] = [
    "lang",
    "charset",
    "http-equiv",
    "name",
    "content",
    "class",
    "id",
    "href",
    "role",
    "for",
    "type",
    "min",
    "max",
    "step",
    "value",
    "hidden",
    "tabindex",
    "viewBox",
    "width",
    "height",
    "data-say",
    "data-only",
    "data-when",
    "checked",
    "disabled",
    "title",
];

/// Largest scene that is unpacked, bytes: hundreds of times that of a gripper.
const LARGEST: usize = 1 << 28;

const HEAD: &str = "<!doctype html>\n";

/// The content of a report.
#[derive(Clone, Debug)]
pub(crate) struct HtmlReport {
    /// Title of the page.
    pub(crate) title: String,
    /// The block of figures.
    pub(crate) data: Value,
    /// The scene, unpacked.
    pub(crate) scene: Vec<u8>,
}

/// Reads a report.
///
/// # Errors
/// The difference from a report.
pub(crate) fn read_html(text: &str) -> Result<HtmlReport, String> {
    let body = text.strip_prefix(HEAD).ok_or("no `<!doctype html>` at its beginning")?;
    if text.contains("://") {
        return Err("an address of a network".to_owned());
    }
    let (frame, raw) = without_raw(body)?;
    if frame.contains("<!") || frame.contains("<?") {
        return Err("a comment or an instruction, which readers take differently".to_owned());
    }
    let document = Document::parse(&frame).map_err(|error| format!("no plain elements: {error}"))?;
    for node in document.descendants().filter(Node::is_element) {
        element(&node)?;
    }
    let [style, data, scene, script] = &raw[..] else {
        return Err(format!("{} styles and scripts instead of 4", raw.len()));
    };
    for (block, open) in [
        (style, "<style>"),
        (data, "<script type=\"application/json\" id=\"data\">"),
        (scene, "<script type=\"text/plain\" id=\"scene-data\">"),
        (script, "<script>"),
    ] {
        if block.open != open {
            return Err(format!("{:?} where {open:?} has to be", block.open));
        }
    }
    let policy = format!(
        "default-src 'none'; script-src '{}'; style-src '{}'; img-src data:; base-uri 'none'; form-action 'none'",
        hash(script.text),
        hash(style.text)
    );
    let stated = document.descendants().filter(|node| node.attribute("http-equiv").is_some());
    let stated: Vec<Option<&str>> = stated.map(|node| node.attribute("content")).collect();
    if stated != [Some(policy.as_str())] {
        return Err("a policy that is not the one of its script and style".to_owned());
    }
    let title = document.descendants().find(|node| node.has_tag_name("title"));
    let packed = STANDARD.decode(scene.text.trim()).map_err(|error| format!("its scene: {error}"))?;
    Ok(HtmlReport {
        title: title.and_then(|node| node.text()).unwrap_or_default().to_owned(),
        data: serde_json::from_str(data.text).map_err(|error| format!("its figures: {error}"))?,
        scene: decompress_to_vec_zlib_with_limit(&packed, LARGEST)
            .map_err(|error| format!("its scene: {error}"))?,
    })
}

/// An element whose text is not looked into for others.
struct Raw<'a> {
    open: &'a str,
    text: &'a str,
}

/// The text without the content of styles and scripts, and these, in order.
fn without_raw(text: &str) -> Result<(String, Vec<Raw<'_>>), String> {
    let (mut frame, mut raw, mut rest) = (String::new(), Vec::new(), text);
    loop {
        let next = ["<style", "<script"].iter().filter_map(|name| Some((rest.find(name)?, *name))).min();
        let Some((start, name)) = next else { break };
        let (before, element_on) = rest.split_at(start);
        let (open, content) =
            element_on.split_at(element_on.find('>').ok_or("an element without an end")? + 1);
        let close = format!("</{}>", &name[1..]);
        let end = content.find(&close[..close.len() - 1]).ok_or("a script without an end")?;
        let (text, after) = content.split_at(end);
        if text.contains("<!--") {
            return Err("a comment in a script, which moves its end".to_owned());
        }
        frame.push_str(before);
        frame.push_str(open);
        frame.push_str(&close);
        raw.push(Raw { open, text });
        rest = after.strip_prefix(&close).ok_or("a script whose end has more in it")?;
    }
    frame.push_str(rest);
    Ok((frame, raw))
}

/// An element is one of the list, and so are its attributes.
fn element(node: &Node<'_, '_>) -> Result<(), String> {
    let name = node.tag_name().name();
    if node.tag_name().namespace().is_some() || !ELEMENTS.contains(&name) {
        return Err(format!("an element `{name}`"));
    }
    for attribute in node.attributes() {
        let (attribute_name, value) = (attribute.name(), attribute.value());
        let is_known = attribute.namespace().is_none()
            && (ATTRIBUTES.contains(&attribute_name) || attribute_name.starts_with("aria-"));
        let is_local = attribute_name != "href" || value.starts_with('#');
        let plain = attribute_name != "http-equiv" || value == "Content-Security-Policy";
        if !(is_known && is_local && plain) {
            return Err(format!("an attribute `{attribute_name}` of `{name}` that says `{value}`"));
        }
    }
    Ok(())
}

fn hash(text: &str) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(text.as_bytes())))
}
