//! The way in which a family of controllers runs programs, as a table.

use crate::spec::Vocabulary;

/// Unit of the P word of a dwell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
}

/// The form of a comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommentMark {
    /// From `;` to the end of the line.
    Semicolon,
    /// Between `(` and `)`, alone on its line.
    Parentheses,
}

/// Largest difference of the distances from an arc's centre to its two ends, mm.
///
/// Accepted: a difference up to `free`, or one up to both `relative` times the radius and `limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcTolerance {
    /// Always accepted.
    pub free: f64,
    /// Accepted as a fraction of the radius ...
    pub relative: f64,
    /// ... as long as it is no larger than this.
    pub limit: f64,
}

/// A dialect: all properties of a controller that the interpreter needs. The tables are in the room `dialects`.
#[derive(Clone, Debug, PartialEq)]
pub struct Dialect {
    /// Its name in machine profiles.
    pub name: &'static str,
    /// Longest line, in bytes without the line end.
    pub line_length: usize,
    /// The words that it understands.
    pub vocabulary: Vocabulary,
    /// The form of comments.
    pub comments: CommentMark,
    /// Characters that must not occur anywhere, comments included.
    pub forbidden: &'static str,
    /// Whether G0 moves at the feed in force, as G1 does.
    pub travel_at_feed: bool,
    /// Unit of a dwell's P word.
    pub dwell: DwellUnit,
    /// A dwell lasts for a multiple of this, rounded up, s; 0 for exactly the programmed time.
    pub dwell_step: f64,
    /// The limits beyond which an arc is refused.
    pub arcs: ArcTolerance,
}

impl Dialect {
    /// The same dialect on a controller that reads lines of at most `line_length` bytes, if that is less.
    pub const fn with_line_length(self, line_length: usize) -> Self {
        let line_length = if line_length < self.line_length { line_length } else { self.line_length };
        Self { line_length, ..self }
    }

    /// The same dialect on a controller that draws no arcs.
    pub const fn without_arcs(self) -> Self {
        Self { vocabulary: self.vocabulary.without_arcs(), ..self }
    }

    /// The same dialect with comments between parentheses.
    pub const fn with_parentheses(self) -> Self {
        Self { comments: CommentMark::Parentheses, forbidden: ";!~?", ..self }
    }

    /// Duration of a dwell with this P word, s.
    pub fn dwell_seconds(&self, p: f64) -> f64 {
        let seconds = match self.dwell {
            DwellUnit::Seconds => p,
            DwellUnit::Milliseconds => p / 1000.0,
        };
        if self.dwell_step > 0.0 { (seconds / self.dwell_step).ceil() * self.dwell_step } else { seconds }
    }
}
