//! Measures: points, lines and curves of a drawing whose places after inflation are wanted; and lines that bars hold.

use crate::{Refusal, RefusalCode};
use artwork::{Artwork, Element, Figure};
use geom::{Line, Path, Point, Segment};
use spec::units::count_text;
use spec::{DrawingSpec, LayerRole, MeasuredFigure, key, nearest};

/// Points along a curve through which a circle is laid.
const CURVE_POINTS: u32 = 33;
/// The largest distance of a line's points from its chord, as a part of the chord.
const STRAIGHT: f64 = 1e-4;

/// A figure of the role `measure` or `pull`, or a measure of the spec, in the drawing's frame, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// The name of the figure in the file, or that of the measure in the spec.
    pub name: String,
    /// The form, which decides what is measured.
    pub form: MeasureForm,
}

/// The form of a measure.
#[derive(Clone, Debug, PartialEq)]
pub enum MeasureForm {
    /// A point, or the middle of a closed mark: its shift and the height at it.
    Point(Point),
    /// A straight line: the distance of its ends and its direction.
    Line([Point; 2]),
    /// Two straight lines that meet: the angle there and the distance of the other ends.
    Corner([Point; 3]),
    /// Any other open curve, as points along it: the radius of the circle that fits them best.
    Curve(Vec<Point>),
}

impl MeasureForm {
    /// The form of `figure`.
    fn new(figure: &Figure) -> Self {
        let path = match figure {
            Figure::Point(point) => return Self::Point(*point),
            Figure::Path(path) => path,
        };
        let (Some(start), Some(end)) = (path.start(), path.end()) else {
            return Self::Point(path.bounds().center());
        };
        if path.closed {
            return Self::Point(path.bounds().center());
        }
        match corners(path).as_deref() {
            Some([]) => Self::Line([start, end]),
            Some([corner]) => Self::Corner([start, *corner, end]),
            _ => {
                let step = path.length() / f64::from(CURVE_POINTS - 1);
                Self::Curve((0..CURVE_POINTS).filter_map(|k| path.point_at(f64::from(k) * step)).collect())
            }
        }
    }

    /// The form of these `points`, which are at least one.
    fn of_points(points: &[Point]) -> Self {
        match points {
            [point] => Self::Point(*point),
            [start, end] => Self::Line([*start, *end]),
            [start, corner, end] => Self::Corner([*start, *corner, *end]),
            _ => Self::Curve(points.to_vec()),
        }
    }

    /// The points of the flat sheet that it needs.
    pub fn points(&self) -> &[Point] {
        match self {
            Self::Point(point) => std::slice::from_ref(point),
            Self::Line(points) => points,
            Self::Corner(points) => points,
            Self::Curve(points) => points,
        }
    }
}

/// The points where a chain of lines turns; `None` if it has an arc that is not straight.
fn corners(path: &Path) -> Option<Vec<Point>> {
    let mut corners: Vec<Point> = Vec::new();
    let mut line_start = path.start()?;
    for (before, after) in path.segments.iter().zip(path.segments.iter().skip(1)) {
        let chord: Segment = Line::new(line_start, after.end()).into();
        if chord.distance(before.end()) > STRAIGHT * chord.length() {
            corners.push(before.end());
            line_start = before.end();
        }
    }
    path.segments.iter().all(is_straight).then_some(corners)
}

fn is_straight(segment: &Segment) -> bool {
    let chord: Segment = Line::new(segment.start(), segment.end()).into();
    chord.distance(segment.point(0.5)) <= STRAIGHT * chord.length()
}

/// The figures of `drawing` with `role`, in the order of the file.
pub(super) fn of_role(drawing: &Artwork, spec: &DrawingSpec, role: LayerRole) -> Vec<Measure> {
    let elements = drawing.elements.iter();
    let of_role = elements.filter(|element| spec.role(element.names()) == Some(role));
    of_role
        .map(|element| Measure { name: element.id.clone(), form: MeasureForm::new(&element.figure) })
        .collect()
}

/// The measures that `spec` defines, in its order: on points, or on an element of `drawing`.
///
/// # Errors
/// Every name that is not that of exactly one element.
pub(super) fn of_spec(drawing: &Artwork, spec: &DrawingSpec) -> Result<Vec<Measure>, Vec<Refusal>> {
    let (mut measures, mut refusals) = (Vec::new(), Vec::new());
    for measure in &spec.measures {
        let form = match &measure.figure {
            MeasuredFigure::Points(places) => {
                let points: Vec<Point> = places.iter().map(|[x, y]| Point::new(x.0, y.0)).collect();
                Ok(MeasureForm::of_points(&points))
            }
            MeasuredFigure::Named(name) => named_form(name, drawing),
        };
        match form {
            Ok(form) => measures.push(Measure { name: measure.name.clone(), form }),
            Err(refusal) => refusals.push(refusal),
        }
    }
    if refusals.is_empty() { Ok(measures) } else { Err(refusals) }
}

/// The form of the element of `drawing` called `name`.
fn named_form(name: &str, drawing: &Artwork) -> Result<MeasureForm, Refusal> {
    let elements: Vec<&Element> =
        drawing.elements.iter().filter(|element| element.names().any(|word| word == name)).collect();
    let (fault, remedy) = match elements.as_slice() {
        [element] => return Ok(MeasureForm::new(&element.figure)),
        [] => {
            let remedy = match nearest(name, drawing.elements.iter().flat_map(Element::names)) {
                Some(nearest_name) => format!("did you mean {nearest_name:?}?"),
                None => "name an element, or write points: [\"10 mm, 20 mm\"]".to_owned(),
            };
            (format!("the drawing has nothing called {name:?}, which is to be measured"), remedy)
        }
        several => {
            let ids: Vec<&str> = several.iter().take(4).map(|element| element.id.as_str()).collect();
            let count = count_text(several.len(), "element");
            let fault = format!("{name:?}, which is to be measured, is the name of {count}");
            (fault, format!("name one of them: {}", ids.join(", ")))
        }
    };
    Err(Refusal::new(key::drawing::MEASURE, RefusalCode::UnknownMeasure, fault, remedy))
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::Arc;

    fn form(points: &[[f64; 2]]) -> MeasureForm {
        let points: Vec<Point> = points.iter().map(|[x, y]| Point::new(*x, *y)).collect();
        MeasureForm::new(&Figure::Path(Path::polyline(&points)))
    }

    #[test]
    fn a_form_is_that_of_the_line_as_drawn() {
        let [a, b, c] = [[0.0, 0.0], [30.0, 0.0], [30.0, 20.0]];
        assert!(matches!(form(&[a, b]), MeasureForm::Line(_)));
        assert!(matches!(form(&[a, [10.0, 0.001], b]), MeasureForm::Line(_)), "points on it make no corner");
        assert_eq!(form(&[a, [10.0, 0.0], b, c]).points().len(), 3, "a corner at {b:?}");
        assert!(matches!(form(&[a, b, c, [60.0, 20.0]]), MeasureForm::Curve(_)));
        let arc: Segment = Arc::new(Point::ORIGIN, 40.0, 0.1, 1.5).into();
        let curve = MeasureForm::new(&Figure::Path(Path::open(vec![arc])));
        assert!(curve.points().iter().all(|point| (point.distance(Point::ORIGIN) - 40.0).abs() < 1e-9));
        let mark = Arc::new(Point::new(7.0, 8.0), 2.0, 0.0, std::f64::consts::TAU);
        let mark = MeasureForm::new(&Figure::Path(Path::closed(vec![mark.into()])));
        assert!(matches!(mark, MeasureForm::Point(point) if point.distance(Point::new(7.0, 8.0)) < 1e-9));
    }
}
