//! Lengths, view boxes, and the size of the page in mm.

use std::str::FromStr;

use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

use crate::affine::Affine;
use crate::collector::Collector;
use crate::{Place, Unit, Weight};

/// Length of a CSS pixel, mm.
const PIXEL: f64 = 25.4 / 96.0;
/// Length of a point, mm.
const POINT: f64 = 25.4 / 72.0;

/// The reason for which a page has no size, and the remedy.
type ViewportFinding = (String, String);

/// Width and height to which percentages refer, in user units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport(pub(super) [f64; 2]);

impl Viewport {
    /// A length in user units along X (0), along Y (1) or of a radius (2).
    pub(super) fn length(self, name: &str, value: &str, axis: usize) -> Result<f64, String> {
        let [w, h] = self.0;
        let reference = [w, h, libm::hypot(w, h) / std::f64::consts::SQRT_2][axis];
        let units = parsed(value).and_then(|length| match (length.unit, millimetres(length)) {
            (LengthUnit::None, _) => Some(length.number),
            (LengthUnit::Percent, _) => Some(length.number / 100.0 * reference),
            (_, mm) => Some(mm? / PIXEL),
        });
        units.ok_or_else(|| {
            let beginning: String = value.chars().take(20).collect();
            format!(
                "Its {name} is \"{beginning}\"; a number, or one with mm, cm, Q, in, pt, pc, px or % is allowed."
            )
        })
    }

    /// The translation by the attributes `x` and `y` of an element.
    pub(super) fn shift(self, node: Node<'_, '_>) -> Result<Affine, String> {
        let [x, y] = [("x", 0), ("y", 1)]
            .map(|(name, axis)| node.attribute(name).map_or(Ok(0.0), |value| self.length(name, value, axis)));
        Ok(Affine::translate(x?, y?))
    }
}

/// A length as SVG and programs write it: units of CSS have capitals or not, and some leave a blank before them. `None` if it is none.
fn parsed(text: &str) -> Option<Length> {
    let text = text.trim().to_ascii_lowercase();
    let number = text.trim_end_matches(|c: char| c == '%' || c.is_ascii_alphabetic());
    let (number, unit) = (number.trim_end(), &text[number.len()..]);
    // The parser does not know quarters of a millimetre.
    let quarters = |length: Length| Length::new(0.25 * length.number, LengthUnit::Mm);
    match unit {
        "q" => Length::from_str(number).ok().map(quarters),
        unit => Length::from_str(&format!("{number}{unit}")).ok(),
    }
}

/// A length with a unit of its own, mm.
fn millimetres(length: Length) -> Option<f64> {
    let unit = match length.unit {
        LengthUnit::Mm => 1.0,
        LengthUnit::Cm => 10.0,
        LengthUnit::In => 25.4,
        LengthUnit::Pt => POINT,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::Px => PIXEL,
        _ => return None,
    };
    Some(length.number * unit)
}

/// The view box of an element; `Err` if it is malformed or its size is not above 0.
fn view_box(node: Node<'_, '_>) -> Result<Option<ViewBox>, String> {
    let read = |value: &str| {
        let view_box = ViewBox::from_str(value).ok().filter(|found| found.w > 0.0 && found.h > 0.0);
        view_box
            .ok_or_else(|| "Its viewBox is not four numbers with a width and a height above 0.".to_owned())
    };
    node.attribute("viewBox").map(read).transpose()
}

/// The map of a view box into a viewport of the given size, by `preserveAspectRatio`.
fn fitted(node: Node<'_, '_>, view_box: ViewBox, [w, h]: [f64; 2]) -> Result<Affine, String> {
    let ratio = match node.attribute("preserveAspectRatio") {
        Some(text) => {
            AspectRatio::from_str(text).map_err(|_| "Its preserveAspectRatio is faulty.".to_owned())?
        }
        None => AspectRatio::default(),
    };
    let [sx, sy] = [w / view_box.w, h / view_box.h];
    let [x, y] = match ratio.align {
        Align::None => {
            return Ok(Affine::scale(sx, sy).following(&Affine::translate(-view_box.x, -view_box.y)));
        }
        Align::XMinYMin => [0.0, 0.0],
        Align::XMidYMin => [0.5, 0.0],
        Align::XMaxYMin => [1.0, 0.0],
        Align::XMinYMid => [0.0, 0.5],
        Align::XMidYMid => [0.5, 0.5],
        Align::XMaxYMid => [1.0, 0.5],
        Align::XMinYMax => [0.0, 1.0],
        Align::XMidYMax => [0.5, 1.0],
        Align::XMaxYMax => [1.0, 1.0],
    };
    let s = if ratio.slice { sx.max(sy) } else { sx.min(sy) };
    let shift = Affine::translate(x * (w - s * view_box.w), y * (h - s * view_box.h));
    Ok(shift.following(&Affine::scale(s, s)).following(&Affine::translate(-view_box.x, -view_box.y)))
}

/// The map of the root's user units to mm with y up, and the viewport of its children; `None` with a fault recorded.
pub(super) fn page(
    root: Node<'_, '_>,
    head: &str,
    collector: &mut Collector<'_>,
) -> Option<(Affine, Viewport)> {
    measured(root, head, collector)
        .map_err(|(text, remedy)| collector.refuse(Place::line(1), text, remedy))
        .ok()
}

/// The map and the viewport, or the finding and its remedy.
///
/// The unit of plain numbers, and of px, is that of the caller or of the program that wrote the file; with it width and height give
/// the size of the page, and the view box is fitted into that. Without a size a unit of the view box is the unit itself.
fn measured(
    root: Node<'_, '_>,
    head: &str,
    collector: &mut Collector<'_>,
) -> Result<(Affine, Viewport), ViewportFinding> {
    let page_box = view_box(root).map_err(|text| (text, "Set it to the size of the drawing.".to_owned()))?;
    let lengths = ["width", "height"].map(|name| root.attribute(name).and_then(parsed));
    for (name, length) in ["width", "height"].into_iter().zip(lengths) {
        if length.is_some_and(|length| length.number < 0.0) {
            let text = format!("The {name} of the page is negative.");
            return Err((text, "Correct width and height.".to_owned()));
        }
    }
    let stated = sizes(lengths, page_box, &millimetres);
    let unit = if let Some(unit) = collector.options.unit {
        Some(unit)
    } else {
        let lack = stated.is_none().then(|| lack_of_size(root));
        unstated(WritingProgram::read(root, head), lengths, page_box, lack, collector)?
    };
    let size = match unit {
        Some(unit) => sizes(lengths, page_box, &|length| by_unit(length, unit, page_box.is_some())),
        None => stated,
    };
    let scale = unit.unwrap_or(Unit::Pixel).millimetres();
    let (map, view) = match (page_box, size) {
        (Some(page_box), size) => {
            let size = size.unwrap_or([page_box.w * scale, page_box.h * scale]);
            let fit = fitted(root, page_box, size).map_err(|text| (text, "Remove the attribute.".into()))?;
            (flipped(size[1]).following(&fit), [page_box.w, page_box.h])
        }
        (None, size) => {
            if unit.is_none() {
                let text = "The file has no viewBox; its unit is 1/96 in, as SVG defines it.";
                collector.note(Weight::Information, Place::default(), text);
            }
            let size = size.unwrap_or_default();
            (flipped(size[1]).following(&Affine::scale(scale, scale)), size.map(|mm| mm / scale))
        }
    };
    let unit_mm = map.x.length();
    if !(1e-9..=1e6).contains(&unit_mm) {
        let [width, height] = view;
        let text = format!(
            "One unit of the viewBox, which is {width:e} x {height:e} units, is not 1e-9 mm to 1e6 mm."
        );
        return Err((text, "Correct width, height and viewBox.".into()));
    }
    if let (Some(unit), Some(stated)) = (collector.options.unit, stated) {
        let stated_mm = match page_box {
            Some(view_box) => fitted(root, view_box, stated).map_or(unit_mm, |map| map.x.length()),
            None => PIXEL,
        };
        note_replaced(unit, stated_mm, unit_mm, collector);
    }
    collector.drawing.unit_mm = unit_mm;
    Ok((map, Viewport(view)))
}

/// Why a page has no physical size: an attribute that is no length is named.
fn lack_of_size(root: Node<'_, '_>) -> String {
    let attributes = ["width", "height"].map(|name| (name, root.attribute(name)));
    let faulty = attributes.into_iter().find_map(|(name, value)| {
        let beginning: String = value.filter(|value| parsed(value).is_none())?.chars().take(20).collect();
        Some(format!("the {name} is \"{beginning}\", which is no length with mm, cm, Q, in, pt, pc or px"))
    });
    let lack = faulty.unwrap_or_else(|| "width and height lack a unit".to_owned());
    format!("The drawing has no physical size: {lack}.")
}

/// A length of the page by a unit that replaces its own, mm; without a view box lengths with a unit of their own keep it.
fn by_unit(length: Length, unit: Unit, has_view_box: bool) -> Option<f64> {
    let is_fixed = !has_view_box && !matches!(length.unit, LengthUnit::None | LengthUnit::Px);
    match length.unit {
        LengthUnit::Percent => None,
        _ if is_fixed => millimetres(length),
        _ => Some(length.number * unit.millimetres()),
    }
}

/// Notes that a given unit, of which a coordinate is `unit_mm` mm, replaces that of the file, `stated_mm` mm, where the two differ.
fn note_replaced(unit: Unit, stated_mm: f64, unit_mm: f64, collector: &mut Collector<'_>) {
    if (stated_mm / unit_mm - 1.0).abs() > 1e-6 {
        let text = format!(
            "The unit \"{}\" replaces that of the file: a unit of its coordinates is {unit_mm:.6} mm in place of {stated_mm:.6} mm.",
            unit.name()
        );
        collector.note(Weight::Information, Place::default(), text);
    }
}

/// The program that saved a file last, as far as its unit depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WritingProgram {
    /// Illustrator, whose px and plain numbers are 1/72 in.
    Illustrator,
    /// Inkscape before 0.92, whose px and plain numbers are 1/90 in.
    OldInkscape,
    /// Inkscape from 0.92 on, whose plain numbers are 1/96 in.
    Inkscape,
    Unknown,
}

/// Beginnings of the versions of Inkscape before 0.92.
const OLD_INKSCAPE: [&str; 3] = ["0.3", "0.4", "0.91"];

impl WritingProgram {
    /// Inkscape keeps the comment of Illustrator, and Illustrator no attribute of Inkscape: so the attribute counts.
    fn read(root: Node<'_, '_>, head: &str) -> Self {
        let version = root.attributes().find(|attribute| {
            attribute.name() == "version" && attribute.namespace().is_some_and(|n| n.contains("inkscape"))
        });
        match version.map(|attribute| attribute.value().trim()) {
            Some(version) if OLD_INKSCAPE.iter().any(|old| version.starts_with(old)) => Self::OldInkscape,
            Some(_) => Self::Inkscape,
            None if head.contains("Adobe Illustrator") => Self::Illustrator,
            None => Self::Unknown,
        }
    }
}

/// The unit of a file for which the caller gives none; `None` where the file states its size.
///
/// A unit that follows from the program is taken with a note where plain numbers have no other meaning, and left to the caller where
/// the file could mean 1/96 in as well. `lack` says why the file states no size.
fn unstated(
    writer: WritingProgram,
    lengths: [Option<Length>; 2],
    page_box: Option<ViewBox>,
    lack: Option<String>,
    collector: &mut Collector<'_>,
) -> Result<Option<Unit>, ViewportFinding> {
    let is_stated = lack.is_none();
    let in_pixels = lengths.iter().flatten().any(|length| length.unit == LengthUnit::Px);
    let sized = lengths.iter().flatten().any(|length| length.unit != LengthUnit::Percent);
    let doubt = match (writer, lack) {
        (WritingProgram::OldInkscape, lack) if in_pixels || lack.is_some() || page_box.is_none() => {
            let reason = "Inkscape before 0.92 wrote it: its unit is 1/90 in where it was not changed since.";
            Some((Unit::OldPixel, reason.to_owned()))
        }
        (WritingProgram::Illustrator, _) if in_pixels => {
            Some((Unit::Point, "Illustrator wrote it: its px is 1/72 in, not 1/96 in.".to_owned()))
        }
        (WritingProgram::Unknown, Some(lack)) => Some((Unit::Millimetre, lack)),
        (WritingProgram::Illustrator, Some(lack)) if page_box.is_none() => Some((Unit::Point, lack)),
        (
            WritingProgram::Illustrator
            | WritingProgram::Inkscape
            | WritingProgram::OldInkscape
            | WritingProgram::Unknown,
            _,
        ) => None,
    };
    if let Some((unit, reason)) = doubt {
        if collector.options.assume {
            collector.assume(unit, reason);
            return Ok(Some(unit));
        }
        let names: Vec<_> = Unit::names().collect();
        let remedy = match unit {
            Unit::Millimetre => format!(
                "Set width and height with a unit, such as 210mm, or give the unit: {}. Exports of Illustrator have pt, those of web programs px.",
                names.join(", ")
            ),
            unit => format!(
                "Give the unit: {}, or another one if a different program saved it last.",
                unit.name()
            ),
        };
        return Err((reason, remedy));
    }
    if is_stated {
        return Ok(None);
    }
    let (unit, size, name) = match writer {
        WritingProgram::Illustrator => (Unit::Point, "1/72", "Illustrator"),
        WritingProgram::Inkscape | WritingProgram::OldInkscape | WritingProgram::Unknown => {
            (Unit::Pixel, "1/96", "Inkscape")
        }
    };
    let lack = if sized { "The size of the file has no unit" } else { "The file has no size" };
    let text = format!("{lack}; its unit is {size} in, since {name} wrote it.");
    collector.note(Weight::Information, Place::default(), text);
    Ok(Some(unit))
}

/// Width and height in mm by the `unit` of each, if at least one has one; the missing one follows from the view box.
fn sizes(
    lengths: [Option<Length>; 2],
    page_box: Option<ViewBox>,
    unit: &dyn Fn(Length) -> Option<f64>,
) -> Option<[f64; 2]> {
    let [w, h] = lengths.map(|length| length.and_then(unit).filter(|mm| *mm > 0.0));
    match (w, h, page_box) {
        (Some(w), Some(h), _) => Some([w, h]),
        (Some(w), None, Some(page_box)) => Some([w, w * page_box.h / page_box.w]),
        (None, Some(h), Some(page_box)) => Some([h * page_box.w / page_box.h, h]),
        (Some(mm), None, None) | (None, Some(mm), None) => Some([mm, mm]),
        (None, None, _) => None,
    }
}

/// From y down to y up, with the origin at the lower left corner of the page.
fn flipped(height: f64) -> Affine {
    Affine::new([1.0, 0.0, 0.0, -1.0, 0.0, height])
}

/// The map and the viewport of the elements within `node`, a nested `<svg>` or a `<symbol>`, in `viewport`; the reason if an attribute is
/// faulty. A size of `frame`, the `<use>` that refers to it, goes before the element's own; the view box is fitted into it.
pub(super) fn nested_viewport(
    node: Node<'_, '_>,
    frame: Node<'_, '_>,
    viewport: Viewport,
) -> Result<(Affine, Viewport), String> {
    let [w, h] = viewport.0;
    let [width, height] = [("width", 0, w), ("height", 1, h)].map(|(name, axis, default)| {
        let value = frame.attribute(name).or_else(|| node.attribute(name));
        value.filter(|v| v.trim() != "auto").map_or(Ok(default), |v| viewport.length(name, v, axis))
    });
    let size = [width?, height?];
    if size.iter().any(|side| *side < 0.0) {
        return Err("Its width or height is negative.".to_owned());
    }
    let is_svg = node.tag_name().name() == "svg";
    let shift = if is_svg { viewport.shift(node)? } else { Affine::translate(0.0, 0.0) };
    Ok(match view_box(node)? {
        Some(from) => (shift.following(&fitted(node, from, size)?), Viewport([from.w, from.h])),
        None => (shift, Viewport(size)),
    })
}
