//! Style sheets: rules, at-rules, declarations.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::paint::Paint;
use super::properties::{GEOMETRY, is_zero};
use super::selector::{Selector, SelectorWork};

/// Steps of matching rules with elements of a file. A file of 100,000 elements with a hundred rules for each needs half of them.
const MOST_WORK: usize = 20_000_000;

/// The rules of all style sheets of a file.
pub(super) struct StyleSheet {
    rules: Vec<Rule>,
    /// Numbers of rules by the subjects of their selectors.
    by_subject: BTreeMap<String, Vec<usize>>,
    /// Selectors, at-rules and statements that are not applied.
    pub(super) unread: Vec<Unread>,
    work: SelectorWork,
}

/// A selector with its declarations.
struct Rule {
    selector: Selector,
    declarations: Vec<Declaration>,
}

/// A property and its value, as far as a sheet or an element declares it.
#[derive(Clone, Debug)]
pub(super) struct Declaration {
    pub(super) name: String,
    pub(super) value: String,
    /// Importance, specificity, order: the highest rank applies.
    pub(super) rank: (bool, u32, usize),
}

/// A part of a style sheet that is not applied.
#[derive(Debug, PartialEq)]
pub(super) struct Unread {
    /// Selector of the rule, or the rule's beginning.
    pub(super) text: String,
    /// Whether it may hide, show or move something; else it colours at most.
    pub(super) changes_geometry: bool,
}

impl StyleSheet {
    pub(super) fn new() -> Self {
        let (rules, by_subject, unread) = (Vec::new(), BTreeMap::new(), Vec::new());
        Self { rules, by_subject, unread, work: SelectorWork::new(MOST_WORK) }
    }

    /// Adds the rules of a `<style>` element.
    pub(super) fn add(&mut self, text: &str) {
        self.rules_of(&without_comments(text), 0);
    }

    /// Adds the rules of a sheet, or of an at-rule that applies, `depth` at-rules deep.
    fn rules_of(&mut self, text: &str, depth: usize) {
        let mut rest = text;
        while let Some(brace) = find_outside(rest, '{') {
            let head = &rest[..brace];
            // Statements such as @import end with a semicolon.
            let mut statements: Vec<&str> = split_outside(head, ';').collect();
            let prelude = statements.pop().unwrap_or_default().trim();
            self.statements(&statements);
            let end = block_end(&rest[brace..]);
            let block = &rest[brace..brace + end];
            let body = block[1..].strip_suffix('}').unwrap_or(&block[1..]);
            rest = &rest[brace + end..];
            if prelude.starts_with('@') {
                match applies(prelude) {
                    Some(true) if depth < 8 => self.rules_of(body, depth + 1),
                    Some(false) => {}
                    _ => self.skip(prelude, body),
                }
                continue;
            }
            for selector in split_outside(prelude, ',') {
                self.rule(selector.trim(), body);
            }
        }
        let statements: Vec<&str> = split_outside(rest, ';').collect();
        self.statements(&statements);
    }

    /// Lists the statements that take rules from elsewhere.
    fn statements(&mut self, statements: &[&str]) {
        for statement in statements.iter().map(|text| text.trim()).filter(|text| text.starts_with('@')) {
            let harmless =
                ["@charset", "@namespace", "@layer"].iter().any(|name| statement.starts_with(name));
            // Web fonts change texts only.
            if !(harmless || statement.starts_with("@import") && statement.contains("font")) {
                self.unread.push(Unread { text: statement.to_owned(), changes_geometry: true });
            }
        }
    }

    fn rule(&mut self, text: &str, body: &str) {
        let Some(selector) = Selector::parsed(text) else { return self.skip(text, body) };
        let specificity = selector.specificity();
        let number = self.rules.len();
        let declarations = declared(body, |important| (important, specificity, number + 1));
        self.by_subject.entry(selector.subject()).or_default().push(number);
        self.rules.push(Rule { selector, declarations });
    }

    /// Lists a rule that is not applied, if it can change anything that is read.
    fn skip(&mut self, text: &str, body: &str) {
        let inner = body.replace(['{', '}'], ";");
        let declarations = declared(&inner, |important| (important, 0, 0));
        let changes_geometry = declarations.iter().any(changes_geometry);
        if changes_geometry
            || declarations.iter().any(|d| matches!(d.name.as_str(), "stroke" | "fill" | "color"))
        {
            self.unread.push(Unread { text: text.to_owned(), changes_geometry });
        }
    }

    /// The declarations whose selectors match an element.
    pub(super) fn matching(&self, node: Node<'_, '_>) -> impl Iterator<Item = &Declaration> {
        let mut keys: Vec<String> = Vec::new();
        if !self.rules.is_empty() {
            keys.extend(["*".to_owned(), node.tag_name().name().to_owned()]);
            let classes = node.attribute("class").unwrap_or_default().split_ascii_whitespace();
            keys.extend(classes.map(|class| format!(".{class}")));
            keys.extend(node.attribute("id").map(|id| format!("#{id}")));
        }
        let candidates = keys.into_iter().filter_map(|key| self.by_subject.get(&key)).flatten();
        let rules = candidates.filter_map(|number| self.rules.get(*number));
        rules.filter(move |rule| rule.selector.matches(node, &self.work)).flat_map(|rule| &rule.declarations)
    }

    /// Whether matching ended before all elements had their rules.
    pub(super) fn is_exhausted(&self) -> bool {
        self.work.is_used_up()
    }
}

/// Whether the rules in an at-rule or of a `media` apply to a drawing on a light screen; `None` if that is not known.
pub(super) fn applies(prelude: &str) -> Option<bool> {
    let text = prelude.to_ascii_lowercase();
    let Some(query) = text.strip_prefix("@media") else {
        let unseen = ["@font", "@page", "@keyframes", "@-", "@property", "@counter-style", "@position-try"];
        return unseen.iter().any(|name| text.starts_with(name)).then_some(false);
    };
    let query_applies = |query: &str| match query.trim().trim_start_matches("only ").trim() {
        "" | "all" | "screen" => Some(true),
        "print" | "speech" => Some(false),
        query if query.contains("prefers-color-scheme") && !query.contains("not") => {
            Some(query.contains("light"))
        }
        _ => None,
    };
    let answers: Vec<Option<bool>> = query.split(',').map(query_applies).collect();
    if answers.contains(&Some(true)) {
        Some(true)
    } else if answers.contains(&None) {
        None
    } else {
        Some(false)
    }
}

/// Whether a declaration can hide, show or change geometry.
fn changes_geometry(declaration: &Declaration) -> bool {
    let (name, value) = (declaration.name.as_str(), declaration.value.as_str());
    match name {
        "display" | "visibility" | "clip-path" | "mask" => true,
        "opacity" | "stroke-opacity" | "fill-opacity" | "stroke-width" => is_zero(value),
        "stroke" | "fill" => {
            Paint::declared(name, value, [0; 3]) == Some(Some(Paint::None)) && name == "stroke"
        }
        _ => GEOMETRY.contains(&name) || name.starts_with("marker"),
    }
}

/// The declarations "name: value; ..." of a block or an attribute, each with the rank for its importance.
pub(super) fn declared(text: &str, rank: impl Fn(bool) -> (bool, u32, usize)) -> Vec<Declaration> {
    let pairs = split_outside(text, ';').filter_map(|part| part.split_once(':'));
    pairs
        .map(|(name, value)| {
            let (value, important) = without_importance(value.trim());
            Declaration {
                name: name.trim().to_ascii_lowercase(),
                value: value.to_owned(),
                rank: rank(important),
            }
        })
        .collect()
}

/// The value without "!important", and whether it had that.
fn without_importance(value: &str) -> (&str, bool) {
    let Some((declaration, word)) = value.rsplit_once('!') else { return (value, false) };
    if word.trim().eq_ignore_ascii_case("important") {
        (declaration.trim_end(), true)
    } else {
        (value, false)
    }
}

fn without_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find("/*") {
        plain.push_str(&rest[..start]);
        // A comment separates words.
        plain.push(' ');
        rest = rest[start..].find("*/").map_or("", |end| &rest[start + end + 2..]);
    }
    plain.push_str(rest);
    plain.replace("<!--", "").replace("-->", "")
}

/// The place of the first `character` outside of quotes and brackets.
fn find_outside(text: &str, character: char) -> Option<usize> {
    let (mut quote, mut depth) = (None, 0_usize);
    for (place, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), _) if open == c => quote = None,
            (None, '"' | '\'') => quote = Some(c),
            (None, _) if c == character && depth == 0 => return Some(place),
            (None, '(' | '[') => depth += 1,
            (None, ')' | ']') => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    None
}

/// The parts of a text between separators outside of quotes and brackets.
fn split_outside(text: &str, separator: char) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let place = find_outside(text, separator);
        rest = place.map(|place| &text[place + separator.len_utf8()..]);
        Some(place.map_or(text, |place| &text[..place]))
    })
}

/// Length of the block that starts with the text, its inner blocks included.
fn block_end(text: &str) -> usize {
    let (mut depth, mut quote) = (0, None);
    for (place, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (Some(open), _) if open == byte => quote = None,
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'{') => depth += 1,
            (None, b'}') if depth == 1 => return place + 1,
            (None, b'}') => depth -= 1,
            _ => {}
        }
    }
    text.len()
}
