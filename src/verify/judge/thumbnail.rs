//! Thumbnails in a program's head: `thumbnail begin WxH N`, N characters of base64 that are a PNG of that size, `thumbnail end`.
//!
//! What they show is not read. Bytes are compared elsewhere.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::verify::read::png::read_png;

/// Most characters of one, several times what a build writes.
const MOST: usize = 1 << 18;

/// Reads thumbnails, a comment after the other, where the profile asks for them.
pub(super) struct Thumbnails {
    asked: bool,
    open: Option<Open>,
}

/// One that is being read.
struct Open {
    /// "32x32".
    size: String,
    characters: usize,
    text: String,
}

/// What a comment is to it.
pub(super) enum Seen {
    /// Of another subject.
    Other,
    /// A part of a picture.
    Part,
    /// The end of one; the words for what it is.
    Whole(String),
}

impl Thumbnails {
    pub(super) fn new(asked: bool) -> Self {
        Self { asked, open: None }
    }

    /// Takes the text of a comment.
    pub(super) fn see(&mut self, text: &str) -> Seen {
        let Some(mut open) = self.open.take() else {
            let begun = text.strip_prefix("thumbnail begin ").and_then(|rest| rest.split_once(' '));
            let begun = begun.filter(|_| self.asked).and_then(|(size, n)| Some((size, n.parse().ok()?)));
            let Some((size, characters)) = begun else { return Seen::Other };
            self.open = Some(Open { size: size.to_owned(), characters, text: String::new() });
            return Seen::Part;
        };
        if text == "thumbnail end" {
            return Seen::Whole(open.words());
        }
        if open.text.len() + text.len() > open.characters.min(MOST) {
            return Seen::Whole(format!("thumbnail of more than {} characters", open.text.len()));
        }
        open.text.push_str(text);
        self.open = Some(open);
        Seen::Part
    }
}

impl Open {
    fn words(&self) -> String {
        let bytes = STANDARD.decode(&self.text).ok().filter(|_| self.text.len() == self.characters);
        match bytes.and_then(|bytes| read_png(&bytes)) {
            Some(raster) if format!("{}x{}", raster.width, raster.height) == self.size => {
                format!("thumbnail: {}", self.size)
            }
            _ => "thumbnail that is no picture of its size".to_owned(),
        }
    }
}
