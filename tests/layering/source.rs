//! Rust source as tokens, and what the lints of names read from them: functions, parameters, `let`s and docs.

use std::ops::Range;

/// A word, a number or a punctuation mark with its line, from 1 on. Texts and comments are left out; so are lifetimes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub(super) text: String,
    pub(super) line: usize,
}

/// A function with its parameters as (pattern, type), each a range of tokens.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: usize,
    pub(super) parameters: Vec<(Range<usize>, Range<usize>)>,
    /// The tokens between the braces; empty for a declaration in a trait.
    pub(super) body: Range<usize>,
}

/// A `let` with its pattern and its value, each a range of tokens. The value of `let x;` is empty.
#[derive(Debug)]
pub(super) struct Binding {
    pub(super) pattern: Range<usize>,
    pub(super) value: Range<usize>,
}

/// Marks of several characters, the longest first.
const MARKS: [&str; 22] = [
    "..=", "...", "<<=", ">>=", "::", "->", "=>", "==", "!=", "<=", ">=", "&&", "||", "+=", "-=", "*=", "/=",
    "%=", "^=", "&=", "|=", "..",
];

const KEYWORDS: [&str; 8] = ["mut", "ref", "self", "box", "true", "false", "_", "crate"];

/// The tokens of `text`.
pub(super) fn tokens(text: &str) -> Vec<Token> {
    let (mut tokens, mut line, mut rest) = (Vec::new(), 1, text);
    while let Some(first) = rest.chars().next() {
        let length = skipped(rest).unwrap_or_else(|| {
            let length = word(rest);
            if !first.is_whitespace() {
                tokens.push(Token { text: rest[..length].to_owned(), line });
            }
            length
        });
        line += rest[..length].matches('\n').count();
        rest = &rest[length..];
    }
    tokens
}

/// The length of the word, number or mark at the start of `rest`, in bytes.
fn word(rest: &str) -> usize {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    match rest.find(|c: char| !is_of_word(c)) {
        Some(0) => MARKS
            .iter()
            .find(|mark| rest.starts_with(**mark))
            .map_or_else(|| rest.chars().next().map_or(0, char::len_utf8), |mark| mark.len()),
        Some(length) => length,
        None => rest.len(),
    }
}

/// The length of the comment, text, character or lifetime at the start of `rest`, in bytes; `None` for anything else.
fn skipped(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    if rest.starts_with("/*") {
        return Some(rest.find("*/").map_or(rest.len(), |end| end + 2));
    }
    let raw = rest.trim_start_matches(['b', 'c']);
    let prefix = rest.len() - raw.len();
    if let Some(hashes) = raw.strip_prefix('r').map(|raw| raw.len() - raw.trim_start_matches('#').len())
        && raw[1 + hashes..].starts_with('"')
        && prefix < 2
    {
        let end = format!("\"{}", "#".repeat(hashes));
        let start = prefix + hashes + 2;
        return Some(rest[start..].find(&end).map_or(rest.len(), |length| start + length + end.len()));
    }
    if prefix < 2 && raw.starts_with('"') {
        return Some(prefix + quoted(raw, '"'));
    }
    if prefix < 2 && raw.starts_with('\'') {
        let mut characters = raw.chars().skip(1);
        let (first, second) = (characters.next()?, characters.next());
        return Some(if first == '\\' || second == Some('\'') {
            prefix + quoted(raw, '\'')
        } else {
            // A lifetime or a label.
            prefix + 1 + raw[1..].find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(raw.len() - 1)
        });
    }
    None
}

/// The length of the text between two `mark`s that `rest` starts with, in bytes.
fn quoted(rest: &str, mark: char) -> usize {
    let mut is_escaped = false;
    for (place, c) in rest.char_indices().skip(1) {
        if !is_escaped && c == mark {
            return place + 1;
        }
        is_escaped = !is_escaped && c == '\\';
    }
    rest.len()
}

/// The place of the bracket that closes the one at `open`.
fn closing(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0;
    for (place, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return place;
        }
    }
    tokens.len()
}

/// The first token of `ends` in `range` that no bracket encloses, or the end of `range`.
fn end_outside_brackets(tokens: &[Token], range: Range<usize>, ends: &[&str]) -> usize {
    let mut place = range.start;
    while place < range.end {
        let text = tokens[place].text.as_str();
        if ends.contains(&text) {
            return place;
        }
        place = if ["(", "[", "{"].contains(&text) { closing(tokens, place) + 1 } else { place + 1 };
    }
    range.end
}

/// Every function of `tokens`, those within functions too.
pub(super) fn functions(tokens: &[Token]) -> Vec<Function> {
    let is_start = |place: &usize| {
        tokens[*place].text == "fn" && tokens.get(place + 1).is_some_and(|next| is_word(&next.text))
    };
    (0..tokens.len()).filter(is_start).filter_map(|place| function(tokens, place + 1)).collect()
}

fn function(tokens: &[Token], name: usize) -> Option<Function> {
    let mut open = name + 1;
    let mut depth = 0;
    while tokens.get(open).is_some_and(|token| depth > 0 || token.text != "(") {
        match tokens[open].text.as_str() {
            "<" => depth += 1,
            ">" => depth -= 1,
            _ => {}
        }
        open += 1;
    }
    let end = closing(tokens, open);
    let mut parameters = Vec::new();
    let mut start = open + 1;
    while start < end {
        // `in` stands before the values of a property test's parameter.
        let colon = end_outside_brackets(tokens, start..end, &[":", ",", "in"]);
        let stop = comma_of_type(tokens, colon..end);
        parameters.push((start..colon, (colon + 1).min(stop)..stop));
        start = stop + 1;
    }
    let brace = end_outside_brackets(tokens, end + 1..tokens.len(), &["{", ";"]);
    let body = match tokens.get(brace)?.text.as_str() {
        "{" => brace + 1..closing(tokens, brace),
        _ => brace..brace,
    };
    Some(Function { name, parameters, body })
}

/// The comma after a type, which has commas of its own in `<..>`.
fn comma_of_type(tokens: &[Token], range: Range<usize>) -> usize {
    let (mut place, mut depth) = (range.start, 0);
    while place < range.end {
        match tokens[place].text.as_str() {
            "," if depth == 0 => return place,
            "<" => depth += 1,
            ">" => depth -= 1,
            "(" | "[" | "{" => place = closing(tokens, place),
            _ => {}
        }
        place += 1;
    }
    range.end
}

/// Every `let` of `tokens`, also of `if let` and `while let`.
pub(super) fn bindings(tokens: &[Token]) -> Vec<Binding> {
    let starts = (0..tokens.len()).filter(|place| tokens[*place].text == "let");
    starts
        .map(|place| {
            let end = end_outside_brackets(tokens, place + 1..tokens.len(), &["=", ":", ";"]);
            let equals = end_outside_brackets(tokens, end..tokens.len(), &["=", ";"]);
            let stop = end_outside_brackets(tokens, equals..tokens.len(), &[";"]);
            Binding { pattern: place + 1..end, value: (equals + 1).min(stop)..stop }
        })
        .collect()
}

/// The places of the names that a pattern binds.
pub(super) fn bound(tokens: &[Token], pattern: &Range<usize>) -> Vec<usize> {
    let text = |place: usize| tokens.get(place).map_or("", |token| token.text.as_str());
    let is_name = |place: &usize| {
        let is_start = *place == pattern.start;
        text(*place).starts_with(|c: char| c.is_lowercase() || c == '_')
            && !KEYWORDS.contains(&text(*place))
            && (is_start || !["::", "."].contains(&text(place - 1)))
            && (place + 1 >= pattern.end || !["::", "(", "{", "!", ":"].contains(&text(place + 1)))
    };
    pattern.clone().filter(is_name).collect()
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The first line of each doc comment, with its line.
pub(super) fn docs(text: &str) -> Vec<(usize, &str)> {
    let doc = |line: &str| ["///", "//!"].iter().any(|mark| line.trim_start().starts_with(mark));
    let mut is_inside = false;
    let mut docs = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        if doc(line) && !is_inside {
            docs.push((number, line.trim_start()[3..].trim_start()));
        }
        is_inside = doc(line);
    }
    docs
}

#[test]
fn texts_comments_and_lifetimes_are_no_tokens() {
    let words =
        |text: &str| tokens(text).iter().map(|token| token.text.clone()).collect::<Vec<_>>().join(" ");
    assert_eq!(
        words("let x = \"a \\\" b\"; // c\nf::<'a>('x', b'\\'', r#\"\"y\"\"#, 1..=2)"),
        "let x = ; f :: < > ( , , , 1 ..= 2 )"
    );
    assert_eq!(tokens("a\n/* b\n */ c")[1], Token { text: "c".to_owned(), line: 3 });
}

#[test]
fn functions_and_lets_are_seen() {
    let code = "fn f<F: Fn(A) -> B>(mut x: Vec<(A, B)>, (y, z): (A, A), &self, w in 0..9_u8) -> [u8; 2] { let Some(P { q: r, .. }) = g(x) else { return }; }";
    let code_tokens = tokens(code);
    let code_functions = functions(&code_tokens);
    let names = |range: &Range<usize>| {
        bound(&code_tokens, range).iter().map(|place| code_tokens[*place].text.as_str()).collect::<Vec<_>>()
    };
    assert_eq!(code_functions.len(), 1);
    let parameters: Vec<_> = code_functions[0].parameters.iter().map(|(pattern, _)| names(pattern)).collect();
    assert_eq!(parameters, [vec!["x"], vec!["y", "z"], vec![], vec!["w"]]);
    let code_bindings = bindings(&code_tokens);
    assert_eq!(
        (names(&code_bindings[0].pattern), code_tokens[code_bindings[0].value.start].text.as_str()),
        (vec!["r"], "g")
    );
}
