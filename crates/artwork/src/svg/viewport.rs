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
type Finding = (String, String);

/// Width and height to which percentages refer, in user units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport(pub(super) [f64; 2]);

impl Viewport {
    /// A length in user units along X (0), along Y (1) or of a radius (2).
    pub(super) fn length(self, name: &str, value: &str, axis: usize) -> Result<f64, String> {
        let fault = || {
            let found: String = value.chars().take(20).collect();
            format!(
                "Its {name} is \"{found}\"; a number, or one with mm, cm, Q, in, pt, pc, px or % is allowed."
            )
        };
        let length = parsed(value).ok_or_else(fault)?;
        let [w, h] = self.0;
        let whole = [w, h, libm::hypot(w, h) / std::f64::consts::SQRT_2][axis];
        match (length.unit, millimetres(length)) {
            (LengthUnit::None, _) => Ok(length.number),
            (LengthUnit::Percent, _) => Ok(length.number / 100.0 * whole),
            (_, Some(mm)) => Ok(mm / PIXEL),
            _ => Err(fault()),
        }
    }

    /// The translation by the attributes `x` and `y` of an element.
    pub(super) fn shift(self, node: Node<'_, '_>) -> Result<Affine, String> {
        let length =
            |name, axis| node.attribute(name).map_or(Ok(0.0), |value| self.length(name, value, axis));
        Ok(Affine::translate(length("x", 0)?, length("y", 1)?))
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
pub(super) fn view_box(node: Node<'_, '_>) -> Result<Option<ViewBox>, String> {
    let read = |value: &str| {
        let found = ViewBox::from_str(value).ok().filter(|found| found.w > 0.0 && found.h > 0.0);
        found.ok_or_else(|| "Its viewBox is not four numbers with a width and a height above 0.".to_owned())
    };
    node.attribute("viewBox").map(read).transpose()
}

/// The map of a view box into a viewport of the given size, by `preserveAspectRatio`.
pub(super) fn fitted(node: Node<'_, '_>, from: ViewBox, [w, h]: [f64; 2]) -> Result<Affine, String> {
    let ratio = match node.attribute("preserveAspectRatio") {
        Some(text) => {
            AspectRatio::from_str(text).map_err(|_| "Its preserveAspectRatio is faulty.".to_owned())?
        }
        None => AspectRatio::default(),
    };
    let [sx, sy] = [w / from.w, h / from.h];
    let [x, y] = match ratio.align {
        Align::None => return Ok(Affine::scale(sx, sy).after(&Affine::translate(-from.x, -from.y))),
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
    let shift = Affine::translate(x * (w - s * from.w), y * (h - s * from.h));
    Ok(shift.after(&Affine::scale(s, s)).after(&Affine::translate(-from.x, -from.y)))
}

/// The map of the root's user units to mm with y up, and the viewport of its children; `None` with a fault recorded.
pub(super) fn page(root: Node<'_, '_>, head: &str, out: &mut Collector<'_>) -> Option<(Affine, Viewport)> {
    measured(root, head, out).map_err(|(text, remedy)| out.fault(Place::line(1), text, remedy)).ok()
}

/// The same, or the finding and its remedy.
fn measured(root: Node<'_, '_>, head: &str, out: &mut Collector<'_>) -> Result<(Affine, Viewport), Finding> {
    let from = view_box(root).map_err(|text| (text, "Set it to the size of the drawing.".to_owned()))?;
    let length = |name| root.attribute(name).and_then(parsed);
    let lengths = [length("width"), length("height")];
    for (name, length) in ["width", "height"].into_iter().zip(lengths) {
        if length.is_some_and(|length| length.number < 0.0) {
            let text = format!("The {name} of the page is negative.");
            return Err((text, "Correct width and height.".to_owned()));
        }
    }
    let own = sizes(lengths, from);
    if let Some(given) = out.options.unit {
        return Ok(by_unit(given, from, lengths, own, out));
    }
    doubt(root, head, lengths, from)?;
    let points = from.filter(|_| head.contains("Adobe Illustrator"));
    let Some(size) = own.or(points.map(|from| [from.w * POINT, from.h * POINT])) else {
        let names: Vec<_> = Unit::names().collect();
        let text = "The drawing has no physical size: width and height have no unit.".to_owned();
        let remedy = format!(
            "Set width and height with a unit, such as 210mm, or give the unit: {}. Exports of Illustrator have pt, those of web programs px.",
            names.join(", ")
        );
        return Err((text, remedy));
    };
    if own.is_none() {
        let text = "The file has no size; its unit is 1/72 in, since Illustrator wrote it.";
        out.note(Weight::Information, Place::default(), text);
    }
    let (map, view) = if let Some(from) = from {
        (fitted(root, from, size).map_err(|text| (text, "Remove the attribute.".into()))?, [from.w, from.h])
    } else {
        let text = "The file has no viewBox; its unit is 1/96 in, as SVG defines it.";
        out.note(Weight::Information, Place::default(), text);
        (Affine::scale(PIXEL, PIXEL), size.map(|mm| mm / PIXEL))
    };
    let unit_mm = map.x.length();
    if !(1e-9..=1e6).contains(&unit_mm) {
        let [width, height] = view;
        let text = format!(
            "One unit of the viewBox, which is {width:e} x {height:e} units, is not 1e-9 mm to 1e6 mm."
        );
        return Err((text, "Correct width, height and viewBox.".into()));
    }
    out.drawing.unit_mm = unit_mm;
    Ok((flipped(size[1]).after(&map), Viewport(view)))
}

/// Refuses sizes of programs whose px is not 1/96 in.
fn doubt(
    root: Node<'_, '_>,
    head: &str,
    lengths: [Option<Length>; 2],
    from: Option<ViewBox>,
) -> Result<(), Finding> {
    let version = |a: &roxmltree::Attribute<'_, '_>| {
        a.name() == "version" && a.namespace().is_some_and(|namespace| namespace.contains("inkscape"))
    };
    let old = ["0.3", "0.4", "0.91"];
    let is_old = |a: roxmltree::Attribute<'_, '_>| old.iter().any(|old| a.value().starts_with(old));
    if from.is_none() && root.attributes().find(version).is_some_and(is_old) {
        let text = "Inkscape before 0.92 wrote it: its unit may be 1/90 in.";
        return Err((text.into(), "Save it with a newer Inkscape, or give the unit.".into()));
    }
    let pixels = lengths.iter().flatten().any(|length| length.unit == LengthUnit::Px);
    if pixels && head.contains("Adobe Illustrator") {
        let text = "Illustrator wrote it: its px is 1/72 in, not 1/96 in.";
        return Err((text.into(), "Give the unit: pt.".into()));
    }
    Ok(())
}

/// Width and height in mm, if at least one has a unit; the missing one follows from the view box.
fn sizes(lengths: [Option<Length>; 2], from: Option<ViewBox>) -> Option<[f64; 2]> {
    let [w, h] = lengths.map(|length| length.and_then(millimetres).filter(|mm| *mm > 0.0));
    match (w, h, from) {
        (Some(w), Some(h), _) => Some([w, h]),
        (Some(w), None, Some(from)) => Some([w, w * from.h / from.w]),
        (None, Some(h), Some(from)) => Some([h * from.w / from.h, h]),
        (Some(mm), None, None) | (None, Some(mm), None) => Some([mm, mm]),
        (None, None, _) => None,
    }
}

/// The map for a unit that the user gives.
fn by_unit(
    given: Unit,
    from: Option<ViewBox>,
    lengths: [Option<Length>; 2],
    own: Option<[f64; 2]>,
    out: &mut Collector<'_>,
) -> (Affine, Viewport) {
    let unit = given.millimetres();
    let written = from.map_or(own.map(|_| PIXEL), |from| own.map(|[w, h]| (w / from.w).min(h / from.h)));
    if let Some(written) = written.filter(|written| (written / unit - 1.0).abs() > 1e-6) {
        let text = format!(
            "The unit \"{}\" ({unit:.6} mm) replaces the file's unit of {written:.6} mm.",
            given.name()
        );
        out.note(Weight::Information, Place::default(), text);
    }
    let number =
        |length: Option<Length>| length.filter(|l| l.unit != LengthUnit::Percent).map_or(0.0, |l| l.number);
    let (view, origin) = match from {
        Some(from) => ([from.w, from.h], Affine::translate(-from.x, -from.y)),
        None => (own.map_or(lengths.map(number), |mm| mm.map(|mm| mm / PIXEL)), Affine::IDENTITY),
    };
    out.drawing.unit_mm = unit;
    (flipped(view[1] * unit).after(&Affine::scale(unit, unit)).after(&origin), Viewport(view))
}

/// From y down to y up, with the origin at the lower left corner of the page.
fn flipped(height: f64) -> Affine {
    Affine::new([1.0, 0.0, 0.0, -1.0, 0.0, height])
}
