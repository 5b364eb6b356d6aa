//! Names of pieces and seams, and how files write them.

use std::fmt;

/// The name of a piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PieceName {
    /// One of several of a kind: star 2.
    Numbered {
        /// The kind: "star".
        kind: &'static str,
        /// The number of the piece, from 1.
        number: usize,
    },
    /// A name of its own: "disc".
    Named(String),
}

/// The name of a seam.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SeamName {
    /// The piece that it is a seam of.
    pub piece: PieceName,
    /// The name of the seam in the piece: "outer". Empty for the only one.
    pub seam: String,
}

impl PieceName {
    /// Number `number` of the pieces of `kind`.
    pub fn numbered(kind: &'static str, number: usize) -> Self {
        Self::Numbered { kind, number }
    }

    /// The number of the piece; `None` for a name of its own.
    pub fn number(&self) -> Option<usize> {
        match self {
            Self::Numbered { number, .. } => Some(*number),
            Self::Named(_) => None,
        }
    }

    /// The kind of a numbered piece; "piece" for a name of its own.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Numbered { kind, .. } => kind,
            Self::Named(_) => "piece",
        }
    }

    /// The name as one word: "star-2", "disc".
    pub fn word(&self) -> String {
        match self {
            Self::Numbered { kind, number } => format!("{kind}-{number}"),
            Self::Named(name) => name.clone(),
        }
    }
}

/// The name of a seam within its piece, in words: "outer loop" of a star, "crease-left" of a drawing, "seam" where it has no name.
pub fn seam_in_words(is_star: bool, seam: &str) -> String {
    match (is_star, seam) {
        (_, "") => "seam".to_owned(),
        (true, seam) => format!("{seam} loop"),
        (false, seam) => seam.to_owned(),
    }
}

impl SeamName {
    /// The name within its piece, in words: see [`seam_in_words`].
    pub fn in_piece(&self) -> String {
        seam_in_words(self.piece.kind() == "star", &self.seam)
    }

    /// The name as words of a structured comment: "star=1 loop=outer", "piece=disc", "piece=2".
    pub fn facts(&self) -> String {
        match &self.piece {
            PieceName::Numbered { kind: kind @ "star", number } => {
                format!("{kind}={number} loop={}", self.seam)
            }
            // An element's id may be longer than a line of a program has room for.
            PieceName::Numbered { kind, number } => format!("{kind}={number}"),
            PieceName::Named(piece) if self.seam.is_empty() => format!("piece={piece}"),
            PieceName::Named(piece) => format!("piece={piece} seam={}", self.seam),
        }
    }
}

/// The pieces of one program as words of a structured comment: "stars=1-3", "piece=disc".
pub fn scope(pieces: &[PieceName]) -> String {
    match (pieces.first(), pieces.last()) {
        (
            Some(PieceName::Numbered { kind, number: first }),
            Some(PieceName::Numbered { number: last, .. }),
        ) => {
            if first == last {
                format!("{kind}s={first}")
            } else {
                format!("{kind}s={first}-{last}")
            }
        }
        (Some(piece), _) => format!("piece={piece}"),
        (None, _) => "piece=none".to_owned(),
    }
}

/// In words: "star 2", "disc".
impl fmt::Display for PieceName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Numbered { kind, number } => write!(f, "{kind} {number}"),
            Self::Named(name) => f.write_str(name),
        }
    }
}

/// In words: "outer loop of star 1", "seam of disc", "weld-1 of piece 1".
impl fmt::Display for SeamName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.in_piece(), self.piece)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_written_in_one_way() {
        let star = |number| PieceName::numbered("star", number);
        let outer = SeamName { piece: star(2), seam: "outer".to_owned() };
        assert_eq!(
            (outer.facts().as_str(), outer.to_string().as_str()),
            ("star=2 loop=outer", "outer loop of star 2")
        );
        let disc = SeamName { piece: PieceName::Named("disc".to_owned()), seam: String::new() };
        assert_eq!((disc.facts().as_str(), disc.to_string().as_str()), ("piece=disc", "seam of disc"));
        let weld = SeamName { piece: PieceName::numbered("piece", 1), seam: "crease-left".to_owned() };
        assert_eq!((weld.facts().as_str(), weld.to_string().as_str()), ("piece=1", "crease-left of piece 1"));
        assert_eq!(scope(&[star(1), star(3)]), "stars=1-3");
        assert_eq!(scope(&[star(3)]), "stars=3");
        assert_eq!(scope(&[disc.piece]), "piece=disc");
        assert_eq!(star(3).word(), "star-3");
    }
}
