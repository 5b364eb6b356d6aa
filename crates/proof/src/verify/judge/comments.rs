//! Comments against the design: the facts that `resume` and the operator rely on, each once and in order.
//!
//! A number is compared by its value, any other word by its letters.

use crate::verify::finding::quote;
use crate::verify::judge::Judge;
use crate::verify::judge::expected_comments::{KEYS, OPERATOR, expected_comments};
use crate::verify::judge::task::ProgramTask;
use crate::verify::read::gcode::{Comment, Dwell};
use crate::verify::{FindingCode, Findings};

/// Lengths are written to a thousandth, mm.
const LENGTH: f64 = 0.51e-3;
/// Times are written to a second.
const TIME: f64 = 0.501;
/// The operator's temperature has six digits.
const OPERATORS: f64 = 1e-5;
/// All other figures, relative: nine digits behind the point.
const EXACT: f64 = 0.51e-9;

/// Reports the first comment of [`KEYS`] that differs from the design, is missing, or is one too many.
pub(super) struct CommentJudge<'a> {
    task: &'a ProgramTask<'a>,
    /// The comments of [`KEYS`] read: as many as a program can have, and one more.
    found: Vec<Comment>,
    most: usize,
    /// Whether strokes were seen of each process of the job.
    chopped: Vec<bool>,
    /// Number of contacts that were announced, and whether a wait for a seam to cool was.
    contacts: usize,
    cools: bool,
}

impl<'a> CommentJudge<'a> {
    pub(super) fn new(task: &'a ProgramTask<'a>) -> Self {
        // A comment that is longer than a line goes on in a second one.
        let chopped = vec![true; task.job.processes.len()];
        let limit = 2 * expected_comments(task, &chopped).len() + 1;
        let chopped = vec![false; task.job.processes.len()];
        Self { task, found: Vec::new(), most: limit, chopped, contacts: 0, cools: false }
    }

    /// Compares all comments with those of the design.
    fn compare(&self, findings: &mut Findings) {
        let mut expected = expected_comments(self.task, &self.chopped).into_iter();
        let mut comments = self.found.iter().peekable();
        while let Some(comment) = comments.next() {
            let next = expected.next();
            let mut text = comment.text.clone();
            while let Some(words) =
                comments.peek().and_then(|more| continued(&text, next.as_deref(), &more.text))
            {
                text.push_str(words);
                let _ = comments.next();
            }
            if !next.as_ref().is_some_and(|expected| agrees(&text, expected)) {
                let allowed = next.map_or("no further such comment".to_owned(), |expected| quote(&expected));
                findings.add_at(FindingCode::OtherComment, comment.line, quote(&comment.text), allowed);
                return;
            }
        }
        if let Some(missing) = expected.next() {
            findings.add(FindingCode::OtherComment, "no such comment", quote(&missing));
        }
    }
}

impl Judge for CommentJudge<'_> {
    fn dwell(&mut self, _: &Dwell, _: &mut Findings) {
        if std::mem::take(&mut self.cools) {
            return;
        }
        let contact = self.contacts.checked_sub(1).and_then(|last| self.task.job.contacts.get(last));
        let process = contact.map_or(0, |contact| contact.process);
        if let Some(chopped) = self.chopped.get_mut(process) {
            *chopped = true;
        }
    }

    fn comment(&mut self, comment: &Comment, _: &mut Findings) {
        self.contacts += usize::from(comment.key() == Some("seam"));
        self.cools = comment.key() == Some("cool");
        let is_fact = comment.key().is_some_and(|key| KEYS.contains(&key));
        if self.found.len() < self.most && (is_fact || comment.text.starts_with(OPERATOR)) {
            self.found.push(comment.clone());
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.compare(findings);
    }
}

/// The words of the comment `next`, a blank before each, if `comment` has fewer than `expected` and `next` the same key.
fn continued<'t>(comment: &str, expected: Option<&str>, next: &'t str) -> Option<&'t str> {
    let expected = expected?;
    let (key, _) = expected.split_once(": ")?;
    let is_short = comment.split(' ').count() < expected.split(' ').count();
    next.strip_prefix(key)?.strip_prefix(':').filter(|_| is_short)
}

/// Whether both have the same words, with the same numbers.
fn agrees(comment: &str, expected: &str) -> bool {
    let (words, expected_words) = (comment.split(' '), expected.split(' '));
    words.clone().count() == expected_words.clone().count()
        && words.zip(expected_words).all(|(a, b)| a == b || is_same(a, b))
}

/// Whether both are the same `word=number`, or the same number, to the digits that are written.
fn is_same(word: &str, expected: &str) -> bool {
    let ((word, number_text), (other, expected_text)) = match (word.split_once('='), expected.split_once('='))
    {
        (Some(number_text), Some(expected_text)) => (number_text, expected_text),
        // The operator's temperature is alone in its comment.
        (None, None) => (("", word), ("", expected)),
        _ => return false,
    };
    let Some((value, right)) = finite_number(number_text).zip(finite_number(expected_text)) else {
        return false;
    };
    let allowed = match word {
        "time_s" => TIME,
        "length_mm" => LENGTH,
        "" => OPERATORS * right.abs(),
        _ => EXACT * right.abs().max(1.0),
    };
    word == other && (value - right).abs() <= allowed
}

fn finite_number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_compared_by_value_and_words_by_letters() {
        let expected = "seam: seam=1 star=2 loop=inner length_mm=10.00049 time_s=100.4";
        assert!(agrees("seam: seam=1 star=2 loop=inner length_mm=10.000 time_s=100", expected));
        for wrong in [
            "seam: seam=1 star=2 loop=inner length_mm=10.002 time_s=100",
            "seam: seam=1 star=2 loop=inner length_mm=10.000 time_s=101",
            "seam: seam=1 star=3 loop=inner length_mm=10.000 time_s=100",
            "seam: seam=1 star=2 loop=outer length_mm=10.000 time_s=100",
            "seam: seam=1 star=2 loop=inner length_mm=10.000",
            "seam: seam=1 star=2 loop=inner length_mm=nan time_s=100",
            "length: seam=1 star=2 loop=inner length_mm=10.000 time_s=100",
        ] {
            assert!(!agrees(wrong, expected), "{wrong}");
        }
    }
}
