//! Reads PNG: pixels of three colours, 8 bits each.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, Limits, Transformations};

/// A picture, row by row from the top, three bytes a pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Raster {
    /// Pixels a row.
    pub(crate) width: usize,
    /// Rows.
    pub(crate) height: usize,
    /// Red, green and blue of every pixel.
    pub(crate) rgb: Vec<u8>,
}

/// Largest picture that is read, pixels: several times that of a build.
const MOST: usize = 1 << 24;

/// The picture of a PNG; `None` if the bytes are not a PNG, have other colours, or are larger than any that is written.
pub(crate) fn read_png(bytes: &[u8]) -> Option<Raster> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 1 << 27 });
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().ok()?;
    let size = |pixels: u32| usize::try_from(pixels).ok();
    let (width, height) = (size(reader.info().width)?, size(reader.info().height)?);
    let is_plain = reader.output_color_type() == (ColorType::Rgb, BitDepth::Eight);
    if !is_plain || width.checked_mul(height)? > MOST {
        return None;
    }
    let mut rgb = vec![0; 3 * width * height];
    let _ = reader.next_frame(&mut rgb).ok()?;
    reader.finish().ok()?;
    Some(Raster { width, height, rgb })
}

impl Raster {
    /// The colour of a pixel; `None` outside of the picture.
    pub(crate) fn pixel(&self, column: usize, row: usize) -> Option<[u8; 3]> {
        let offset = (column < self.width && row < self.height).then_some(3 * (row * self.width + column))?;
        self.rgb.get(offset..offset + 3)?.try_into().ok()
    }
}
