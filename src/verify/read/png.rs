//! Reads PNG: pixels of three colours, 8 bits each.

use std::io::Cursor;

use png::{BitDepth, ColorType, Decoder, Limits, Transformations};

/// A picture, row by row from the top, three bytes a pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue of every pixel.
    pub rgb: Vec<u8>,
}

/// Largest picture that is read, pixels: several times what a build writes.
const MOST: usize = 1 << 24;

/// The picture of a PNG; `None` if it is none, of other colours, or larger than any that is written.
pub fn read_png(bytes: &[u8]) -> Option<Raster> {
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
    pub fn pixel(&self, column: usize, row: usize) -> Option<[u8; 3]> {
        let at = (column < self.width && row < self.height).then_some(3 * (row * self.width + column))?;
        self.rgb.get(at..at + 3)?.try_into().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(color: ColorType, width: u32, height: u32, data: &[u8]) -> Vec<u8> {
        let mut out = Vec::new();
        let mut encoder = png::Encoder::new(&mut out, width, height);
        encoder.set_color(color);
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(data).expect("data");
        writer.finish().expect("an end");
        out
    }

    #[test]
    fn reads_pixels_and_nothing_else() {
        let right = encoded(ColorType::Rgb, 2, 1, &[1, 2, 3, 4, 5, 6]);
        let raster = read_png(&right).expect("a picture");
        assert_eq!((raster.width, raster.height), (2, 1));
        assert_eq!((raster.pixel(1, 0), raster.pixel(2, 0)), (Some([4, 5, 6]), None));
        assert_eq!(read_png(&encoded(ColorType::Grayscale, 2, 1, &[1, 2])), None);
        assert_eq!(read_png(&right[..right.len() - 20]), None);
        assert_eq!(read_png(b"P6 2 1 255 abcdef"), None);
    }

    /// A header may claim anything.
    #[test]
    fn a_picture_that_claims_to_be_huge_is_not_read() {
        let mut huge = encoded(ColorType::Rgb, 2, 1, &[1, 2, 3, 4, 5, 6]);
        huge[16..20].copy_from_slice(&0x7fff_ffff_u32.to_be_bytes());
        assert_eq!(read_png(&huge), None);
    }
}
