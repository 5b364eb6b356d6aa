//! The file format PNG (W3C, third edition): pixels of three colours of 8 bits, each row by the filter that leaves the smallest numbers.
//!
//! The writer has no table for its checksums beyond 16 numbers: those of crates take 16 kB, which no compression makes smaller, of the
//! program of a web page.

use fdeflate::Compressor;

/// Bytes of a pixel.
const PIXEL: usize = 3;
const SIGNATURE: [u8; 8] = [137, 80, 78, 71, 13, 10, 26, 10];
/// Remainders of four bits by the polynomial of CRC-32, reflected.
const REMAINDERS: [u32; 16] = remainders();

/// What the filter of a row subtracts from a byte.
#[derive(Clone, Copy)]
enum Filter {
    Sub = 1,
    Up,
    Average,
    Paeth,
}

/// The file of `pixels`, rows of `width` by `height` from the top, for `density` pixels a metre; `None` if there are none.
pub(super) fn png_file([width, height]: [u32; 2], pixels: &[u8], density: u32) -> Option<Vec<u8>> {
    let row_length = usize::try_from(width).ok()? * PIXEL;
    if row_length == 0 || pixels.len() != row_length * usize::try_from(height).ok()? {
        return None;
    }
    let mut packer = Compressor::new(Vec::new()).ok()?;
    // A row stands behind a pixel of zeros, which is to the left of its first one.
    let mut row = vec![0; PIXEL + row_length];
    let mut row_above = row.clone();
    for bytes in pixels.chunks_exact(row_length) {
        row[PIXEL..].copy_from_slice(bytes);
        packer.write_data(&filtered(&row, &row_above)).ok()?;
        std::mem::swap(&mut row, &mut row_above);
    }
    let mut file = SIGNATURE.to_vec();
    // 8 bits a colour, three colours, no interlacing.
    let header = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, 2, 0, 0, 0]].concat();
    let metres = 1;
    let scale = [&density.to_be_bytes()[..], &density.to_be_bytes(), &[metres]].concat();
    add_chunk(&mut file, *b"IHDR", &header)?;
    add_chunk(&mut file, *b"pHYs", &scale)?;
    add_chunk(&mut file, *b"IDAT", &packer.finish().ok()?)?;
    add_chunk(&mut file, *b"IEND", &[])?;
    Some(file)
}

/// `row` behind the number of its filter. The filter is the one whose differences have the least sum; of equal ones the last, or the first
/// without differences.
fn filtered(row: &[u8], row_above: &[u8]) -> Vec<u8> {
    let mut smallest: Option<(u32, Vec<u8>)> = None;
    for filter in [Filter::Up, Filter::Sub, Filter::Average, Filter::Paeth] {
        let bytes = differences(row, row_above, filter);
        let sum = bytes[1..].iter().map(|byte| u32::from(byte.cast_signed().unsigned_abs())).sum();
        if smallest.as_ref().is_none_or(|(least, _)| sum <= *least) {
            smallest = Some((sum, bytes));
        }
        if sum == 0 {
            break;
        }
    }
    smallest.map(|(_, differences)| differences).unwrap_or_default()
}

/// The number of `filter`, then what it leaves of `row`, which has the row `row_above` it; each behind a pixel of zeros.
fn differences(row: &[u8], row_above: &[u8], filter: Filter) -> Vec<u8> {
    let places = row[PIXEL..].iter().zip(row).zip(row_above[PIXEL..].iter().zip(row_above));
    let mut differences = Vec::with_capacity(row.len());
    differences.push(filter as u8);
    match filter {
        Filter::Sub => differences.extend(places.map(|((byte, left), _)| byte.wrapping_sub(*left))),
        Filter::Up => differences.extend(places.map(|((byte, _), (above, _))| byte.wrapping_sub(*above))),
        Filter::Average => {
            differences
                .extend(places.map(|((byte, left), (above, _))| byte.wrapping_sub(left.midpoint(*above))));
        }
        Filter::Paeth => differences.extend(
            places.map(|((byte, left), (above, corner))| byte.wrapping_sub(paeth(*left, *above, *corner))),
        ),
    }
    differences
}

/// Of the bytes to the left, above, and above to the left the nearest to `left + above - corner`, by PNG's predictor of Paeth.
fn paeth(left_byte: u8, above_byte: u8, corner_byte: u8) -> u8 {
    let to_left = above_byte.abs_diff(corner_byte);
    let to_above = left_byte.abs_diff(corner_byte);
    let to_corner =
        (i16::from(left_byte) + i16::from(above_byte) - 2 * i16::from(corner_byte)).unsigned_abs();
    if to_left <= to_above && u16::from(to_left) <= to_corner {
        left_byte
    } else if u16::from(to_above) <= to_corner {
        above_byte
    } else {
        corner_byte
    }
}

/// Adds a chunk with its length and checksum; `None` if it is too long for the format.
fn add_chunk(file: &mut Vec<u8>, name: [u8; 4], content: &[u8]) -> Option<()> {
    file.extend(u32::try_from(content.len()).ok()?.to_be_bytes());
    let start = file.len();
    file.extend(name);
    file.extend(content);
    let checksum = crc32(&file[start..]);
    file.extend(checksum.to_be_bytes());
    Some(())
}

/// CRC-32 of `bytes`, four bits at a time.
pub(in crate::emit) fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..2).fold(crc ^ u32::from(*byte), |crc, _| REMAINDERS[(crc & 15) as usize] ^ (crc >> 4))
    })
}

const fn remainders() -> [u32; 16] {
    let mut table = [0; 16];
    let mut bits = 0;
    while bits < 16 {
        let (mut crc, mut bit) = (bits, 0);
        while bit < 4 {
            crc = if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
            bit += 1;
        }
        table[bits as usize] = crc;
        bits += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use png::{ColorType, Compression, Encoder, PixelDimensions, Unit};
    use proptest::prelude::*;

    /// The file as the crate `png` writes it.
    fn reference([width, height]: [u32; 2], pixels: &[u8], density: u32) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_compression(Compression::Fast);
        encoder.set_pixel_dims(Some(PixelDimensions { xppu: density, yppu: density, unit: Unit::Meter }));
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(pixels).expect("pixels");
        writer.finish().expect("an end");
        file
    }

    #[test]
    fn no_pixels_are_no_file() {
        assert_eq!(png_file([0, 3], &[], 1), None);
        assert_eq!(png_file([2, 1], &[0; 5], 1), None);
    }

    proptest! {
        /// Areas of few colours, large enough that they are packed.
        #[test]
        fn files_are_those_of_the_crate(
            width in 40_u32..120, height in 20_u32..60, steps in 1_u32..60, colours in 1_u32..6, density in any::<u32>(),
        ) {
            let value = |x: u32, y: u32, c: u32| (x * x + steps * y) / 997 % colours * 51 + c * (x / steps % 3);
            let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            let pixels: Vec<u8> = places.flat_map(|(x, y)| [0, 1, 2].map(|c| u8::try_from(value(x, y, c)).unwrap_or(u8::MAX))).collect();
            prop_assert_eq!(png_file([width, height], &pixels, density), Some(reference([width, height], &pixels, density)));
        }
    }
}
