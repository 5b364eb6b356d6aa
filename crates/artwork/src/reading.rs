//! Files by their names.

use crate::{Artwork, Fault, Format, Options, Place};

/// Reads a file by the ending of its name, `.svg` or `.dxf`.
///
/// # Errors
/// Another ending, content of another format, and the faults of [`crate::read_svg`] and [`crate::read_dxf`].
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Artwork, Vec<Fault>> {
    match Format::of_name(name) {
        Some(Format::Svg) => crate::read_svg(bytes, options),
        Some(Format::Dxf) => crate::read_dxf(bytes, options),
        None => {
            let ending = name.rsplit_once('.').map_or("no ending", |(_, ending)| ending);
            let ending: String = ending.chars().take(20).collect();
            let text = format!("The ending of the file name is \"{ending}\"; \"svg\" and \"dxf\" are read.");
            Err(Fault::single(Place::default(), text, "Export the drawing as SVG or as ASCII DXF."))
        }
    }
}
