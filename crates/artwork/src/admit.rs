//! Formats of files, by the ending of the name and by the first bytes.

use crate::{Fault, Options, Place};

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Scalable Vector Graphics, as XML text.
    Svg,
    /// Artwork Exchange Format, ASCII.
    Dxf,
}

impl Format {
    /// The format of a file name's ending, in upper or lower case.
    pub fn of_name(name: &str) -> Option<Self> {
        let ending = name.rsplit_once('.')?.1;
        [(Self::Svg, "svg"), (Self::Dxf, "dxf")]
            .iter()
            .find(|row| ending.eq_ignore_ascii_case(row.1))
            .map(|row| row.0)
    }

    fn name(self) -> &'static str {
        match self {
            Self::Svg => "SVG",
            Self::Dxf => "DXF",
        }
    }
}

/// First bytes of formats that are not read, their names, and the remedy.
const OTHERS: [(&[u8], &str, &str); 7] = [
    (b"AutoCAD Binary DXF", "binary DXF", "Export the drawing as ASCII DXF."),
    (b"AC10", "DWG", "Export the drawing as ASCII DXF."),
    (b"\x1f\x8b", "gzip (SVGZ)", "Save the drawing as plain SVG, or unpack it with gunzip."),
    (b"PK\x03\x04", "ZIP", "Unpack it."),
    (b"%PDF", "PDF", "Export the drawing as SVG."),
    (b"%!PS", "PostScript", "Export the drawing as SVG."),
    (b"\x89PNG", "PNG", "Trace the picture in a drawing program, and save SVG."),
];

/// A fault of the file as a whole.
fn file_fault(text: String, remedy: &str) -> Vec<Fault> {
    Fault::single(Place::default(), text, remedy)
}

/// Refuses bytes that are of another format or too many, and options out of their range.
pub(crate) fn admit(bytes: &[u8], format: Format, options: &Options) -> Result<(), Vec<Fault>> {
    if !(1e-6..=10.0).contains(&options.tolerance) {
        let text = format!("The tolerance is {} mm; 1e-6 mm to 10 mm are allowed.", options.tolerance);
        return Err(file_fault(text, "Change it."));
    }
    if bytes.len() > options.limits.bytes {
        let text = format!("The file has {} bytes; {} are allowed.", bytes.len(), options.limits.bytes);
        return Err(file_fault(
            text,
            "Remove what is not needed, such as embedded pictures, or split the drawing.",
        ));
    }
    if let Some((_, name, remedy)) = OTHERS.iter().find(|row| bytes.starts_with(row.0)) {
        return Err(file_fault(format!("The file is {name}, not {}.", format.name()), remedy));
    }
    // A file of two bytes a character begins alike once its zeros are left out.
    let head: Vec<u8> = bytes.iter().take(4096).copied().filter(|byte| *byte != 0).collect();
    let marks: [&[u8]; 3] = [b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"];
    let text = marks.iter().find_map(|mark| head.strip_prefix(*mark)).unwrap_or(&head).trim_ascii_start();
    let actual_format = if text.starts_with(b"<") {
        Some(Format::Svg)
    } else if text.first().is_some_and(u8::is_ascii_digit) {
        Some(Format::Dxf)
    } else {
        None
    };
    match actual_format {
        Some(actual_format) if actual_format == format => Ok(()),
        Some(actual_format) => {
            let text = format!("The file is {}, not {}.", actual_format.name(), format.name());
            Err(file_fault(text, "Change the ending of its name."))
        }
        None if text.is_empty() => Err(file_fault("The file is empty.".into(), "Export the drawing again.")),
        None => Err(file_fault(
            format!("The file is not {}.", format.name()),
            "Export the drawing as SVG or as ASCII DXF.",
        )),
    }
}
