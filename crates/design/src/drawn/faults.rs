//! Faults of files and shapes as refusals and warnings: each with the names of elements, a place, and the key to change.

use crate::{Refusal, RefusalCode};
use artwork::Fault;
use geom::Point;
use sealed::{ShapeCode, ShapeFault};
use spec::{DrawnPlace, KeyPath, key};

/// A fault of the file.
pub(super) fn unreadable(fault: &Fault) -> Refusal {
    let elements = fault.place.element.iter().cloned().collect();
    let point = fault.place.at.map(|point| [point.x, point.y]);
    let text = clause(&fault.text);
    let finding = if fault.place.is_file() { text } else { format!("{}: {text}", fault.place) };
    let refusal =
        Refusal::new(key::drawing::FILE, RefusalCode::UnreadableDrawing, finding, clause(&fault.remedy));
    refusal.drawn_at(DrawnPlace { elements, at: point })
}

/// A sentence of the reader as a clause of a message: no capital, unless the word has more of them, and no full stop.
pub(super) fn clause(sentence: &str) -> String {
    let text = sentence.trim_end_matches('.');
    let mut letters = text.chars();
    match (letters.next(), letters.next()) {
        (Some(first), Some(second)) if first.is_ascii_uppercase() && !second.is_ascii_uppercase() => {
            format!("{}{}", first.to_ascii_lowercase(), &text[1..])
        }
        _ => text.to_owned(),
    }
}

/// A fault of the shape, or a warning about it.
pub(super) fn refusal(fault: &ShapeFault) -> Refusal {
    let (key, code) = key_and_code(fault);
    let place = DrawnPlace { elements: fault.names.clone(), at: Some([fault.place.x, fault.place.y]) };
    Refusal::new(key, code, found_at(&fault.what, fault.place), fault.remedy.clone()).drawn_at(place)
}

/// The finding `subject`, and its place.
pub(super) fn found_at(subject: &str, place: Point) -> String {
    format!("{subject} at X {:.3} Y {:.3} mm", place.x, place.y)
}

/// The key that is best changed, and the code.
fn key_and_code(fault: &ShapeFault) -> (KeyPath, RefusalCode) {
    use key::drawing::{FILE, JOIN, LAYERS};
    match fault.code {
        ShapeCode::NotFinite => (FILE, RefusalCode::CurveNotFinite),
        ShapeCode::Crowded => (FILE, RefusalCode::CurvesCrowded),
        ShapeCode::Gap => (JOIN, RefusalCode::CurveGap),
        ShapeCode::DanglingEnd => (FILE, RefusalCode::CurveDanglingEnd),
        ShapeCode::Crossing => (FILE, RefusalCode::CurvesCross),
        ShapeCode::NestedIsland => (LAYERS, RefusalCode::NestedIsland),
        ShapeCode::WallOutside => (LAYERS, RefusalCode::WallOutside),
        ShapeCode::NoRoom => (key::seal::BAND, RefusalCode::NoRoomForBand),
        ShapeCode::BandsOverlap => (key::seal::BAND, RefusalCode::BandsOverlap),
        ShapeCode::ChannelOverlap => (LAYERS, RefusalCode::BandsOverlap),
        ShapeCode::NarrowTube => (key::seal::BAND, RefusalCode::NarrowTube),
        ShapeCode::NarrowPassage => (FILE, RefusalCode::NarrowPassage),
        ShapeCode::SharpCorner => (key::seal::BAND, RefusalCode::SharpCorner),
        ShapeCode::NoPort => (LAYERS, RefusalCode::ChamberWithoutPort),
        ShapeCode::LostPort => (LAYERS, RefusalCode::PortOffEdge),
        ShapeCode::PortTooWide => (key::inlet::TUBE_DIAMETER, RefusalCode::PortTooWide),
        ShapeCode::Outlines => (LAYERS, RefusalCode::WrongOutlines),
        // A cut that follows the bands has no name, and no allowance keeps it off the bands of others.
        ShapeCode::CutInBand if fault.names.is_empty() => (LAYERS, RefusalCode::CutInBand),
        ShapeCode::MisplacedValve => (LAYERS, RefusalCode::MisplacedValve),
        ShapeCode::ThinWeb => (FILE, RefusalCode::ThinWeb),
        ShapeCode::CutInBand => (FILE, RefusalCode::CutInBand),
        ShapeCode::Empty => (LAYERS, RefusalCode::NothingDrawn),
        ShapeCode::Leak => (FILE, RefusalCode::WrongOpening),
    }
}
