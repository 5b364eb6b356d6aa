//! Selectors of style sheets: **compounds** such as `path.edge` and the **links** between them.
//!
//! Tags, classes, ids, attributes, the structural pseudo-classes below, `:not()` of a compound, and the four combinators are
//! matched. Pseudo-classes of a reader's action (`:hover`) and pseudo-elements match nothing that is drawn.

use std::cell::Cell;

use roxmltree::Node;

/// A sequence of compounds with the link in front of each but the first.
#[derive(Debug)]
pub(super) struct Selector {
    compounds: Vec<Compound>,
    links: Vec<Link>,
}

/// The relation of a compound's element to that of the compound before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Link {
    /// `a b`: somewhere inside.
    Inside,
    /// `a > b`: a child.
    Child,
    /// `a + b`: the next sibling.
    Next,
    /// `a ~ b`: a later sibling.
    Later,
}

/// Conditions on one element.
#[derive(Debug, Default)]
struct Compound {
    /// `None`: any.
    tag: Option<String>,
    conditions: Vec<Condition>,
}

/// A condition on an element beside its tag.
#[derive(Debug)]
enum Condition {
    Class(String),
    Id(String),
    /// An attribute; without a test any value.
    Attribute(String, Option<(AttributeTest, String)>),
    Root,
    /// The number of the element among its siblings is `step` n + `offset` for an n from 0 on, counted from the last one if `from_end`.
    Nth {
        step: i64,
        offset: i64,
        from_end: bool,
    },
    /// The compound does not match.
    Not(Compound),
    /// An action of a reader, or a part that is no element.
    Never,
}

/// A comparison of an attribute's value.
#[derive(Clone, Copy, Debug)]
enum AttributeTest {
    Equal,
    Word,
    Start,
    End,
    Part,
    Language,
}

/// Steps of comparison that are left for a file.
pub(super) struct SelectorWork(Cell<usize>);

impl SelectorWork {
    pub(super) fn new(steps: usize) -> Self {
        Self(Cell::new(steps))
    }

    /// Takes `steps`; `false` once too few are left.
    pub(super) fn take(&self, steps: usize) -> bool {
        let remaining = self.0.get().checked_sub(steps);
        self.0.set(remaining.unwrap_or(0));
        remaining.is_some()
    }

    pub(super) fn is_used_up(&self) -> bool {
        self.0.get() == 0
    }
}

impl Selector {
    /// The selector in `text`; `None` if it is malformed or has a part that is not matched.
    pub(super) fn parsed(text: &str) -> Option<Self> {
        let mut rest = text.trim();
        let mut selector = Self { compounds: Vec::new(), links: Vec::new() };
        loop {
            let (compound, tail) = Compound::parsed(rest)?;
            selector.compounds.push(compound);
            let next = tail.trim_start();
            if next.is_empty() {
                return Some(selector);
            }
            let (link, behind_link) = match next.as_bytes()[0] {
                b'>' => (Link::Child, &next[1..]),
                b'+' => (Link::Next, &next[1..]),
                b'~' => (Link::Later, &next[1..]),
                _ if next.len() < tail.len() => (Link::Inside, next),
                _ => return None,
            };
            selector.links.push(link);
            rest = behind_link.trim_start();
        }
    }

    /// Rank of the selector by CSS: ids, then classes, attributes and pseudo-classes, then tags, a byte each.
    pub(super) fn specificity(&self) -> u32 {
        self.compounds.iter().map(Compound::specificity).fold(0, u32::saturating_add)
    }

    /// A condition that every element it matches fulfils: "#id", ".class", a tag, or "*".
    pub(super) fn subject(&self) -> String {
        let Some(subject) = self.compounds.last() else { return "*".to_owned() };
        let id = subject.conditions.iter().find_map(|condition| match condition {
            Condition::Id(id) => Some(format!("#{id}")),
            _ => None,
        });
        let class = || {
            subject.conditions.iter().find_map(|condition| match condition {
                Condition::Class(class) => Some(format!(".{class}")),
                _ => None,
            })
        };
        id.or_else(class).or_else(|| subject.tag.clone()).unwrap_or_else(|| "*".to_owned())
    }

    /// Whether it matches an element, as far as `work` reaches.
    pub(super) fn matches(&self, node: Node<'_, '_>, work: &SelectorWork) -> bool {
        self.compounds.len().checked_sub(1).is_some_and(|last| self.matches_to(last, node, work))
    }

    /// Whether the compounds up to number `last` match an element and those around and before it.
    fn matches_to(&self, last: usize, node: Node<'_, '_>, work: &SelectorWork) -> bool {
        if !work.take(1) || !self.compounds[last].matches(node, work) {
            return false;
        }
        let Some(previous) = last.checked_sub(1) else { return true };
        let matches = |other: Node<'_, '_>| other.is_element() && self.matches_to(previous, other, work);
        match self.links[previous] {
            Link::Inside => node.ancestors().skip(1).any(matches),
            Link::Child => node.parent().is_some_and(matches),
            Link::Next => node.prev_sibling_element().is_some_and(matches),
            Link::Later => node.prev_siblings().skip(1).any(matches),
        }
    }
}

impl Compound {
    /// The compound at the start of `text`, and the rest.
    fn parsed(text: &str) -> Option<(Self, &str)> {
        let mut compound = Self::default();
        let mut rest = text;
        if let Some(tail) = text.strip_prefix('*') {
            rest = tail;
        } else if name_length(text) > 0 {
            let (tag, tail) = text.split_at(name_length(text));
            compound.tag = Some(tag.to_owned());
            rest = tail;
        }
        while let Some(mark) = rest.chars().next().filter(|mark| ".#[:".contains(*mark)) {
            let (condition, tail) = match mark {
                '[' => attribute(&rest[1..])?,
                ':' => pseudo(&rest[1..])?,
                _ => {
                    let (name, tail) = rest[1..].split_at(name_length(&rest[1..]));
                    let text = Some(name).filter(|name| !name.is_empty())?.to_owned();
                    let condition = if mark == '.' { Condition::Class(text) } else { Condition::Id(text) };
                    (condition, tail)
                }
            };
            compound.conditions.push(condition);
            rest = tail;
        }
        (rest.len() < text.len()).then_some((compound, rest))
    }

    fn specificity(&self) -> u32 {
        let condition = |condition: &Condition| match condition {
            Condition::Id(_) => 0x1_0000,
            Condition::Not(compound) => compound.specificity(),
            _ => 0x100,
        };
        let conditions = self.conditions.iter().map(condition).fold(0, u32::saturating_add);
        conditions.saturating_add(u32::from(self.tag.is_some()))
    }

    fn matches(&self, node: Node<'_, '_>, work: &SelectorWork) -> bool {
        self.tag.as_ref().is_none_or(|tag| tag == node.tag_name().name())
            && self.conditions.iter().all(|condition| condition.is_met(node, work))
    }
}

impl Condition {
    fn is_met(&self, node: Node<'_, '_>, work: &SelectorWork) -> bool {
        match self {
            Self::Class(class) => node
                .attribute("class")
                .is_some_and(|value| value.split_ascii_whitespace().any(|c| c == class)),
            Self::Id(id) => node.attribute("id") == Some(id),
            Self::Attribute(name, test) => node
                .attribute(name.as_str())
                .is_some_and(|value| test.as_ref().is_none_or(|(test, wanted)| test.is_met(value, wanted))),
            Self::Root => node.parent().is_none_or(|parent| !parent.is_element()),
            Self::Nth { step, offset, from_end } => {
                let is_sibling = |n: &Node<'_, '_>| n.is_element() && work.take(1);
                let count = if *from_end {
                    node.next_siblings().filter(is_sibling).count()
                } else {
                    node.prev_siblings().filter(is_sibling).count()
                };
                let past = i64::try_from(count).unwrap_or(i64::MAX).saturating_sub(*offset);
                if *step == 0 { past == 0 } else { past % step == 0 && past / step >= 0 }
            }
            Self::Not(compound) => !compound.matches(node, work),
            Self::Never => false,
        }
    }
}

impl AttributeTest {
    fn is_met(self, value: &str, operand: &str) -> bool {
        let is_given = !operand.is_empty();
        match self {
            Self::Equal => value == operand,
            Self::Word => value.split_ascii_whitespace().any(|word| word == operand),
            Self::Start => is_given && value.starts_with(operand),
            Self::End => is_given && value.ends_with(operand),
            Self::Part => is_given && value.contains(operand),
            Self::Language => {
                value.strip_prefix(operand).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
            }
        }
    }
}

/// Length of the name at the start of `text`; 0 if there is none.
fn name_length(text: &str) -> usize {
    let is_end = |c: char| !(c.is_alphanumeric() || c == '-' || c == '_' || !c.is_ascii());
    text.find(is_end).unwrap_or(text.len())
}

/// The condition on an attribute in `text`, which starts behind the opening bracket, and the rest behind the closing one.
fn attribute(text: &str) -> Option<(Condition, &str)> {
    let end = text.find(']')?;
    let (inner, rest) = (text[..end].trim(), &text[end + 1..]);
    let length = name_length(inner);
    let (name, test) = (inner[..length].to_owned(), inner[length..].trim());
    if name.is_empty() {
        return None;
    }
    if test.is_empty() {
        return Some((Condition::Attribute(name, None), rest));
    }
    let (operator, value) = test.split_once('=')?;
    let test = match operator {
        "" => AttributeTest::Equal,
        "~" => AttributeTest::Word,
        "^" => AttributeTest::Start,
        "$" => AttributeTest::End,
        "*" => AttributeTest::Part,
        "|" => AttributeTest::Language,
        _ => return None,
    };
    let value = value.trim().trim_matches(['"', '\'']).to_owned();
    Some((Condition::Attribute(name, Some((test, value))), rest))
}

/// The condition of the pseudo-class or pseudo-element in `text`, which starts behind ":", and the rest.
fn pseudo(text: &str) -> Option<(Condition, &str)> {
    let text = text.strip_prefix(':').unwrap_or(text);
    let length = name_length(text);
    let (name, mut rest) = text.split_at(length);
    let mut argument = "";
    if let Some(inner) = rest.strip_prefix('(') {
        let end = inner.find(')')?;
        (argument, rest) = (inner[..end].trim(), &inner[end + 1..]);
    }
    let condition = match name.to_ascii_lowercase().as_str() {
        "root" => Condition::Root,
        "first-child" => Condition::Nth { step: 0, offset: 1, from_end: false },
        "last-child" => Condition::Nth { step: 0, offset: 1, from_end: true },
        "nth-child" | "nth-last-child" => {
            let (step, offset) = steps(argument)?;
            Condition::Nth { step, offset, from_end: name.to_ascii_lowercase().contains("last") }
        }
        "not" => {
            let (compound, tail) = Compound::parsed(argument)?;
            let is_simple = tail.is_empty();
            return is_simple.then_some((Condition::Not(compound), rest));
        }
        "hover" | "active" | "focus" | "focus-within" | "focus-visible" | "visited" | "link" | "any-link"
        | "target" | "before" | "after" | "selection" | "first-line" | "first-letter" => Condition::Never,
        _ => return None,
    };
    Some((condition, rest))
}

/// The numbers a and b of "an+b", "odd" or "even".
fn steps(text: &str) -> Option<(i64, i64)> {
    let text: String = text.to_ascii_lowercase().split_ascii_whitespace().collect();
    match text.as_str() {
        "odd" => return Some((2, 1)),
        "even" => return Some((2, 0)),
        _ => {}
    }
    match text.split_once('n') {
        None => Some((0, integer(&text)?)),
        Some((step, offset)) => {
            let step = match step {
                "" | "+" => 1,
                "-" => -1,
                step => integer(step)?,
            };
            Some((step, if offset.is_empty() { 0 } else { integer(offset)? }))
        }
    }
}

/// An integer of 32 bits.
fn integer(text: &str) -> Option<i64> {
    text.parse::<i32>().ok().map(i64::from)
}
