//! DXF files: ASCII, from R12 to 2018.
//!
//! Groups make records, records make sections; a walk over the entities resolves blocks. Entities with a plane of their own have its
//! coordinates mirrored where the plane faces down. All else is in [`figures`].

mod figures;
mod geometry;
mod group;
mod polyline;
mod tables;
mod walk;

use std::borrow::Cow;

use crate::affine::Affine;
use crate::collector::Collector;
use crate::{Artwork, Fault, Options, Place, Unit, Weight};

/// Reads an ASCII DXF file.
///
/// # Errors
/// All faults of the file, each with its place: content other than DXF, malformed numbers, missing values, unknown units, and
/// exceeded limits.
pub fn read_dxf(bytes: &[u8], options: &Options) -> Result<Artwork, Vec<Fault>> {
    crate::admit::admit(bytes, crate::Format::Dxf, options)?;
    let (decoded, is_latin) = crate::encoding::dxf(bytes);
    let text = unescaped(&decoded);
    let groups = group::groups(&text, options.limits.visits.saturating_mul(16))?;
    let sections = tables::sections(&groups);
    let mut collector = Collector::new(options);
    if is_latin {
        collector.note(
            Weight::Information,
            Place::default(),
            "The text is not UTF-8; it is read as Latin-1.",
        );
    }
    if !sections.has_entities {
        collector.refuse(
            Place::default(),
            "The file has no section ENTITIES.",
            "Export the drawing as ASCII DXF again.",
        );
    }
    if let Some(unit_mm) = unit(&sections, &mut collector) {
        collector.drawing.unit_mm = unit_mm;
        // A limit that is exceeded is among the faults.
        let _ = walk::DxfWalk::new(&sections, &mut collector).run(&Affine::scale(unit_mm, unit_mm));
    }
    collector.finish()
}

/// The text with the characters that `\U+XXXX` stands for, as programs write those outside of the code page.
fn unescaped(text: &str) -> Cow<'_, str> {
    const MARK: &str = "\\U+";
    let mut parts = text.split(MARK);
    let first = parts.next().unwrap_or_default();
    if first.len() == text.len() {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len());
    plain.push_str(first);
    for part in parts {
        let code = part.get(..4).and_then(|digits| u32::from_str_radix(digits, 16).ok());
        if let Some(c) = code.and_then(char::from_u32).filter(|c| !c.is_control()) {
            plain.push(c);
            plain.push_str(&part[4..]);
        } else {
            plain.push_str(MARK);
            plain.push_str(part);
        }
    }
    Cow::Owned(plain)
}

/// Length of the file's unit, mm: the user's, or $INSUNITS.
fn unit(sections: &tables::Sections<'_, '_>, collector: &mut Collector<'_>) -> Option<f64> {
    // The user's unit wins over the file's, with a note where both differ. Without either, millimetres are assumed if
    // the caller allows that, else the file is refused.
    let code = sections.units.map_or(0, |value| value.parse::<i64>().unwrap_or(-1));
    let file_unit = match code {
        1 => Some(Unit::Inch),
        2 => Some(Unit::Foot),
        4 => Some(Unit::Millimetre),
        5 => Some(Unit::Centimetre),
        6 => Some(Unit::Metre),
        9 => Some(Unit::Mil),
        10 => Some(Unit::Yard),
        13 => Some(Unit::Micrometre),
        14 => Some(Unit::Decimetre),
        _ => None,
    };
    match (collector.options.unit, file_unit) {
        (Some(chosen), Some(stated)) if chosen != stated => {
            let text =
                format!("The unit \"{}\" replaces the file's unit \"{}\".", chosen.name(), stated.name());
            collector.note(Weight::Information, Place::default(), text);
            Some(chosen.millimetres())
        }
        (Some(unit), _) | (None, Some(unit)) => Some(unit.millimetres()),
        (None, None) => {
            let state = sections.units.map_or("is missing".into(), |value| format!("is {value}"));
            let text = match code {
                0 => format!("The file has no unit: $INSUNITS {state}."),
                _ => format!(
                    "The file's unit is not read: $INSUNITS {state}; 1, 2, 4 to 6, 9, 10, 13 and 14 are."
                ),
            };
            if collector.options.assume {
                collector.assume(Unit::Millimetre, text);
                return Some(Unit::Millimetre.millimetres());
            }
            let names: Vec<_> = Unit::names().collect();
            collector.refuse(Place::default(), text, format!("Give the unit: {}.", names.join(", ")));
            None
        }
    }
}
