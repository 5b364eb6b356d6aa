//! Names that say what they hold, docs that can be read alone, functions that fit a screen: counted in each crate, and never more
//! than before.

use std::ops::Range;

use super::source::{Binding, Function, Token, bindings, bound, docs, functions, tokens};

/// Prepositions, pronouns, participles and fillers: as names they do not say what they hold. `other` is the second of two of a
/// kind, as in `PartialEq`, and `built` a state of the pipeline.
const NAMELESS: &str = "\
    about above across after again against all alone along already also although always among another any apart around as aside \
    asked asks at away became because before began begun behind being below beneath beside besides between beyond both bent broken \
    brought but by called came chosen come comes counted did does doing done drawn driven during each either else enough every \
    everything except fallen far felt few finds for found from gave gets getting given gives goes going gone got grown had has have \
    heard held here hers his holds how inside instead into it its itself just keeps kept knows known laid lain late later least left \
    less lies like likes lost made makes many meant meets met mine more most much near nearby needed needs neither never no none \
    nor nothing now of off often on once one ones only onto or others ought ours out outside over owed own owes paid per perhaps plus \
    proved put quite ran rather reached said same says seems seen several shall she shown since so some something soon spoken stays \
    still stood stuck such sure taken takes tells than that their theirs them then there these they thing things this those though \
    thought through throughout thrown till to together told too toward towards tried tries under underneath unlike until up upon us \
    used very via wanted wants was went what whatever when where whether which while who whole whom whose why wished wishes with \
    within without won worn worth written yet you your yours";

/// Words that name a side, an end or a direction where their opposites are named too.
const OPPOSITES: [(&str, &str); 7] = [
    ("left", "right"),
    ("from", "to"),
    ("before", "after"),
    ("inside", "outside"),
    ("above", "below"),
    ("up", "down"),
    ("along", "across"),
];

/// Names of functions that a trait of the standard library asks for.
const OF_TRAITS: [&str; 1] = ["from"];

/// Beginnings of docs that lean on the item above.
const LEANING: [&str; 5] = ["The same", "As for ", "Its ", "Those ", "Likewise"];

/// Most lines of a function, and the lines above which it says how it goes about it. Comments do not count.
const LONGEST: usize = 60;
const EXPLAINED: usize = 30;

/// The kinds of faults, each with its remedy.
const KINDS: [(&str, &str); 7] = [
    ("nameless", "name it by a noun of the field, or a verb with its object"),
    ("leaning", "begin the doc with the noun: it is read alone"),
    ("shadowing", "give the local another name than the function that makes it"),
    ("closures", "write a function: only a closure that is passed on may have a name in another function"),
    ("tuples", "write parameters, or a struct; only a pair of one kind may be a tuple"),
    ("long", "split the function"),
    ("unexplained", "say in two or three sentences how the function goes about it"),
];

/// How many there may be in each folder, in the order of `KINDS`. The numbers only fall.
const ALLOWED: [(&str, [usize; KINDS.len()]); 14] = [
    ("crates/geom/src", [0, 0, 0, 0, 0, 0, 0]),
    ("crates/artwork/src", [0, 0, 0, 2, 0, 0, 0]),
    ("crates/sealed/src", [0, 0, 0, 8, 0, 0, 0]),
    ("crates/inflatable/src", [0, 0, 0, 95, 13, 0, 0]),
    ("crates/spec/src", [0, 0, 0, 20, 3, 0, 6]),
    ("crates/design/src", [0, 0, 0, 14, 0, 0, 1]),
    ("crates/forecast/src", [0, 0, 0, 24, 0, 0, 0]),
    ("crates/program/src", [0, 0, 0, 5, 0, 0, 0]),
    ("crates/proof/src", [0, 0, 0, 14, 1, 0, 1]),
    ("src", [0, 0, 0, 48, 8, 0, 0]),
    ("python/src", [5, 0, 0, 1, 2, 0, 0]),
    ("web/src", [0, 0, 0, 4, 0, 0, 0]),
    ("crates/research/src", [0, 0, 0, 6, 2, 0, 0]),
    ("tests", [646, 0, 110, 300, 4, 9, 70]),
];

/// The faults of one folder, a list for each of `KINDS`.
type Faults = [Vec<String>; KINDS.len()];

/// A source file with all that is read from it.
struct Source<'a> {
    name: &'a str,
    lines: Vec<&'a str>,
    tokens: Vec<Token>,
    functions: Vec<Function>,
    bindings: Vec<Binding>,
}

impl<'a> Source<'a> {
    fn new(name: &'a str, text: &'a str) -> Self {
        let words = tokens(text);
        let (functions, bindings) = (functions(&words), bindings(&words));
        Self { name, lines: text.lines().map(str::trim_start).collect(), tokens: words, functions, bindings }
    }

    fn text(&self, place: usize) -> &str {
        self.tokens.get(place).map_or("", |token| &token.text)
    }

    /// A fault at the token `place`.
    fn fault(&self, place: usize, text: &str) -> String {
        format!("{}:{}: {text}", self.name, self.tokens[place].line)
    }

    /// The nameless among the names that `pattern` binds. Opposites are looked for in `scope`.
    fn nameless(&self, pattern: &Range<usize>, scope: &Range<usize>) -> Vec<String> {
        let is_in_scope = |word: &str| self.tokens[scope.clone()].iter().any(|token| token.text == word);
        let opposite =
            |name: &str| {
                OPPOSITES.iter().find_map(|(one, two)| {
                    if *one == name { Some(*two) } else { (*two == name).then_some(*one) }
                })
            };
        bound(&self.tokens, pattern)
            .into_iter()
            .filter(|place| {
                is_nameless(self.text(*place)) && !opposite(self.text(*place)).is_some_and(is_in_scope)
            })
            .map(|place| self.fault(place, self.text(place)))
            .collect()
    }

    /// The tokens of the innermost function around `place`.
    fn scope(&self, place: usize) -> Range<usize> {
        let mut enclosing = self.functions.iter().filter(|function| function.body.contains(&place));
        enclosing.next_back().map_or(0..self.tokens.len(), |function| function.name..function.body.end)
    }

    /// Whether the value of `binding` begins with a call to a function of a name that it binds.
    fn is_shadow(&self, binding: &Binding) -> bool {
        let start = binding.value.clone().find(|place| !["&", "mut"].contains(&self.text(*place)));
        let Some(start) = start else { return false };
        let names = bound(&self.tokens, &binding.pattern);
        self.text(start + 1) == "(" && names.iter().any(|place| self.text(*place) == self.text(start))
    }

    /// Whether `binding` is a closure that its function calls by name: a function without a place of its own. A closure with a
    /// name that is only passed on is an argument.
    fn is_hidden_function(&self, binding: &Binding) -> bool {
        let is_closure =
            !binding.value.is_empty() && ["|", "||", "move"].contains(&self.text(binding.value.start));
        let names = bound(&self.tokens, &binding.pattern);
        let mut calls = self.scope(binding.pattern.start).filter(|place| {
            self.text(*place + 1) == "(" && ![".", "::"].contains(&self.text(place.saturating_sub(1)))
        });
        is_closure && calls.any(|place| names.iter().any(|name| self.text(*name) == self.text(place)))
    }

    /// The lines of `function` without its comments, and its comments with those above it.
    fn lines_and_comments(&self, function: &Function) -> (usize, usize) {
        let line = |place: usize| self.tokens.get(place).map_or(self.lines.len(), |token| token.line);
        let (first, last) = (line(function.name), line(function.body.end));
        let is_comment = |line: &&&str| line.starts_with("//");
        let comments = self.lines[first - 1..last].iter().filter(is_comment).count();
        let lines_above = self.lines[..first - 1].iter().rev();
        let comments_above = lines_above
            .take_while(|line| line.starts_with("//") || line.starts_with("#["))
            .filter(is_comment)
            .count();
        (last + 1 - first - comments, comments + comments_above)
    }
}

/// Adds the faults of the file `name`.
fn collect(faults: &mut Faults, name: &str, text: &str) {
    let source = Source::new(name, text);
    let [nameless, leaning, shadowing, closures, tuples, long, unexplained] = faults;
    for (line, doc) in
        docs(text).into_iter().filter(|(_, doc)| LEANING.iter().any(|start| doc.starts_with(start)))
    {
        leaning.push(format!("{name}:{line}: {doc}"));
    }
    for function in &source.functions {
        let title = source.text(function.name);
        if is_nameless(title) && !OF_TRAITS.contains(&title) {
            nameless.push(source.fault(function.name, title));
        }
        let scope = function.name..function.body.end;
        for (pattern, kind) in &function.parameters {
            nameless.extend(source.nameless(pattern, &scope));
            if is_mixed_tuple(&source.tokens[kind.clone()]) {
                tuples.push(source.fault(pattern.start, title));
            }
        }
        let (lines, comments) = source.lines_and_comments(function);
        if lines > LONGEST {
            long.push(source.fault(function.name, &format!("{title} has {lines} lines")));
        }
        if lines > EXPLAINED && comments < 2 {
            unexplained.push(source.fault(function.name, &format!("{title} has {lines} lines")));
        }
        let closure = source.bindings.iter().find(|binding| {
            source.scope(binding.pattern.start) == scope && source.is_hidden_function(binding)
        });
        closures.extend(
            closure.map(|binding| source.fault(binding.pattern.start, source.text(binding.pattern.start))),
        );
    }
    for binding in &source.bindings {
        nameless.extend(source.nameless(&binding.pattern, &source.scope(binding.pattern.start)));
        if source.is_shadow(binding) {
            shadowing.push(source.fault(binding.pattern.start, source.text(binding.value.start)));
        }
    }
}

fn is_nameless(name: &str) -> bool {
    NAMELESS.split_whitespace().any(|word| word == name)
}

/// Whether a type is a tuple other than a pair of one kind.
fn is_mixed_tuple(kind: &[Token]) -> bool {
    let mut kind =
        kind.iter().map(|token| token.text.as_str()).skip_while(|text| ["&", "mut"].contains(text));
    if kind.next() != Some("(") {
        return false;
    }
    let (mut elements, mut depth) = (vec![String::new()], 0);
    for text in kind {
        match text {
            "(" | "[" | "<" => depth += 1,
            ")" | "]" | ">" => depth -= 1,
            _ => {}
        }
        match (text, elements.last_mut()) {
            (",", _) if depth == 0 => elements.push(String::new()),
            (_, Some(element)) if depth >= 0 => element.push_str(text),
            _ => {}
        }
    }
    elements.retain(|element| !element.is_empty());
    !(elements.is_empty() || elements.len() == 2 && elements[0] == elements[1])
}

#[test]
fn names_say_what_they_hold() {
    let mut report = Vec::new();
    for (folder, allowed) in ALLOWED {
        let mut faults = Faults::default();
        for file in super::rust_files(&super::root().join(folder)) {
            let name = file.strip_prefix(super::root()).expect("below the root").display().to_string();
            collect(&mut faults, &name, &super::text_of(&file));
        }
        for ((list, allowed), (kind, remedy)) in faults.iter().zip(allowed).zip(KINDS) {
            if list.len() > allowed {
                report.push(format!("{folder} has {} {kind}, {allowed} are allowed: {remedy}", list.len()));
                report.extend(list.iter().map(|fault| format!("  {kind} {fault}")));
            } else if list.len() < allowed {
                report.push(format!(
                    "{folder} has {} {kind}: lower its number {allowed} in ALLOWED",
                    list.len()
                ));
            }
        }
    }
    assert!(report.is_empty(), "{}", report.join("\n"));
}

#[test]
fn every_source_has_an_allowance() {
    for source in super::sources() {
        let is_listed = ALLOWED.iter().any(|(folder, _)| source == super::root().join(folder));
        assert!(is_listed, "write {} in ALLOWED", source.display());
    }
}

#[test]
fn each_kind_of_fault_is_seen() {
    let counts = |text: &str| {
        let mut faults = Faults::default();
        collect(&mut faults, "x.rs", text);
        faults.map(|list| list.len())
    };
    assert_eq!(
        counts("fn found(at: u8) {\n    let Some(own) = f() else { return };\n}\n"),
        [3, 0, 0, 0, 0, 0, 0]
    );
    assert_eq!(counts("fn f(left: u8, right: u8) { let (from, to) = (1, 2); }"), [0; KINDS.len()]);
    assert_eq!(counts("fn f(left: u8) { let right_hand = 1; }"), [1, 0, 0, 0, 0, 0, 0]);
    assert_eq!(
        counts("/// Its width.\n/// Those are.\nfn width() {}\n/// It is.\nfn height() {}\n"),
        [0, 1, 0, 0, 0, 0, 0]
    );
    assert_eq!(counts("fn f() { let outline = &mut outline(1); let x = a::x(1); }"), [0, 0, 1, 0, 0, 0, 0]);
    assert_eq!(
        counts(
            "fn f() { let g = |x| x; g(1); fn i() { let j = move || 2; j() } fn k() { let l = |x| x; m(l) } }"
        ),
        [0, 0, 0, 2, 0, 0, 0]
    );
    assert_eq!(
        counts("fn f(a: (f64, f64), b: &(A<B, C>, A<B, C>), c: &(u8, f64)) {}"),
        [0, 0, 0, 0, 1, 0, 0]
    );
    let long = |lines: usize| format!("fn f() {{\n    // Why.\n{}}}\n", "    g();\n".repeat(lines - 2));
    assert_eq!(counts(&long(60)), [0, 0, 0, 0, 0, 0, 1]);
    assert_eq!(counts(&long(61)), [0, 0, 0, 0, 0, 1, 1]);
    assert_eq!(counts(&format!("/// A.\n{}", long(40))), [0; KINDS.len()]);
}
