//! Pictures in the header, which hosts show.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::gcode::writer::Writer;

/// Characters a line of a thumbnail: fewer than the shortest line of a profile has.
const THUMBNAIL_LINE: usize = 64;

/// A picture of a program, which hosts show in their lists.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thumbnail {
    /// Width and height, pixels.
    pub side: u32,
    /// The picture as the bytes of a PNG file.
    pub png: Vec<u8>,
}

impl Thumbnail {
    /// Writes the picture as the hosts of the dialect read it.
    pub(super) fn write(&self, writer: &mut Writer<'_>) {
        let Self { side, png } = self;
        let text = STANDARD.encode(png);
        writer.comment(&format!("thumbnail begin {side}x{side} {}", text.len()));
        let mut rest = text.as_str();
        while !rest.is_empty() {
            // Base64 is ASCII.
            let (line, tail) = rest.split_at(rest.len().min(THUMBNAIL_LINE));
            writer.comment(line);
            rest = tail;
        }
        writer.comment("thumbnail end");
    }
}
