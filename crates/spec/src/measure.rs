//! `[drawing.measure]`: what is measured after inflation, by the places of points or by elements that the drawing has for other purposes.

use std::ops::Range;

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::fault::{Fault, quoted};
use crate::section::Section;
use crate::shape::ValueShape;
use crate::units::{Length, Quantity, QuantityFault};
use crate::value::RawEntry;

/// Coordinates of a drawing, mm.
const PLACES: Allowed = Allowed::closed(-1e5, 1e5);

/// A measure that the spec defines.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenMeasure {
    /// The name in answers.
    pub name: String,
    /// What is measured.
    pub figure: MeasuredFigure,
}

/// The figure that a measure of the spec is laid on.
#[derive(Clone, Debug, PartialEq)]
pub enum MeasuredFigure {
    /// Points in the order of the spec, at least one: X to the right and Y upwards, as the drawing's places are printed.
    Points(Vec<[Length; 2]>),
    /// The element of the drawing with this name.
    Named(String),
}

/// The measures, in the order of the text. Faulty ones are reported and left out.
pub(super) fn read_measures(s: &mut Section<'_, '_>) -> Vec<WrittenMeasure> {
    let Some(value) = s.take("measure", ValueShape::NamedLists) else { return Vec::new() };
    let Some(table) = value.as_table() else {
        let message = format!("`measure` is {}", value.in_words());
        let fault = Fault::error(FaultCode::WrongType, value.span.clone(), message);
        s.report(
            fault.label("must be a section, [drawing.measure], with points or an element for each name"),
        );
        return Vec::new();
    };
    table.0.iter().filter_map(|entry| read_measure(s, entry)).collect()
}

/// The measure of `entry`: its points, or the one name in its list.
fn read_measure(s: &mut Section<'_, '_>, entry: &RawEntry) -> Option<WrittenMeasure> {
    let list = entry.value.as_list().unwrap_or_default();
    let texts: Option<Vec<(&str, Range<usize>)>> =
        list.iter().map(|item| Some((item.as_text()?, item.span.clone()))).collect();
    let figure = match texts.as_deref() {
        None | Some([]) => {
            let message = format!("`{}` is {}", entry.key, entry.value.in_words());
            let fault = Fault::error(FaultCode::WrongType, entry.value.span.clone(), message);
            s.report(fault.label("must be a list of points, [\"10 mm, 20 mm\", \"30 mm, 20 mm\"], or of one name, [\"crease\"]"));
            return None;
        }
        Some([(name, _)]) if !is_point(name) => MeasuredFigure::Named((*name).to_owned()),
        Some(texts) => {
            let points: Vec<_> =
                texts.iter().map(|(text, place)| read_point(s, &entry.key, text, place)).collect();
            MeasuredFigure::Points(points.into_iter().collect::<Option<_>>()?)
        }
    };
    Some(WrittenMeasure { name: entry.key.clone(), figure })
}

/// Whether `text` is meant as a point: two numbers with a comma between.
fn is_point(text: &str) -> bool {
    text.split_once(',').is_some_and(|(x, y)| {
        [x, y].iter().all(|part| !matches!(Length::parse(part.trim()), Err(QuantityFault::NotANumber)))
    })
}

/// The point `text` of measure `name`; `None` with a fault reported.
fn read_point(s: &mut Section<'_, '_>, name: &str, text: &str, place: &Range<usize>) -> Option<[Length; 2]> {
    let lengths = text.split_once(',').map(|(x, y)| [x, y].map(|part| Length::parse(part.trim())));
    let (code, label) = match lengths {
        Some([Ok(x), Ok(y)]) if [x, y].iter().all(|length| PLACES.contains(length.base())) => {
            return Some([x, y]);
        }
        Some([Ok(_), Ok(_)]) => {
            (FaultCode::OutOfRange, format!("X and Y {}", PLACES.in_words(Length::KIND.unit())))
        }
        Some([Err(QuantityFault::NoUnit), _] | [_, Err(QuantityFault::NoUnit)]) => {
            (FaultCode::NoUnit, format!("X and Y each need a unit: {}", Length::KIND.unit_list()))
        }
        _ => (FaultCode::NotANumber, "must be X and Y with a comma between: \"10 mm, 20 mm\"".to_owned()),
    };
    let message = format!("a point of `{name}` is {}", quoted(text));
    s.report(Fault::error(code, place.clone(), message).label(label));
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Source, read};

    fn measures(text: &str) -> Result<Vec<WrittenMeasure>, Vec<&'static str>> {
        let text = format!(
            "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = {{ air = [\"a\"] }}\n[drawing.measure]\n{text}\n"
        );
        read(&Source::new("x", &text))
            .map(|reading| reading.spec.drawing.map(|drawing| drawing.measures).unwrap_or_default())
            .map_err(|faults| faults.list().iter().map(|fault| fault.code).collect())
    }

    #[test]
    fn a_measure_has_points_or_one_name() {
        let [point, start, end] = [[10.0, 20.0], [10.0, 20.0], [-3.0, 0.0]].map(|point| point.map(Length));
        for (list, figure) in [
            ("[\"10 mm, 2 cm\"]", MeasuredFigure::Points(vec![point])),
            ("[\"10mm,20mm\", \" -3 mm , 0 mm\"]", MeasuredFigure::Points(vec![start, end])),
            ("[\"crease, left\"]", MeasuredFigure::Named("crease, left".to_owned())),
        ] {
            let measure = WrittenMeasure { name: "tip".to_owned(), figure };
            assert_eq!(measures(&format!("tip = {list}")), Ok(vec![measure]), "{list}");
        }
    }

    #[test]
    fn every_faulty_measure_is_refused_by_its_code() {
        for (list, code) in [
            ("\"10 mm, 20 mm\"", "wrong-type"),
            ("[]", "wrong-type"),
            ("[3]", "wrong-type"),
            ("[\"10, 20\"]", "no-unit"),
            ("[\"10 mm, 20 mm\", \"crease\"]", "not-a-number"),
            ("[\"10 mm, 20 mm, 30 mm\"]", "not-a-number"),
            ("[\"1 mm, 200 m\"]", "out-of-range"),
        ] {
            assert_eq!(measures(&format!("tip = {list}\nother = [\"a\"]")), Err(vec![code]), "{list}");
        }
    }
}
