//! Placement: parts side by side on as many sheets as needed, within reach of the iron.

use std::f64::consts::FRAC_PI_2;

use crate::{Refusal, RefusalCode};
use geom::{Bounds, Isometry, Path, Point};
use sealed::{PieceName, SealedShape};
use spec::units::{Least, Length, Readable, tenths_down, tenths_up};
use spec::{Machine, SealingTool, Sheet, key};

/// One sheet: its frame has the origin at the lower left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetLayout {
    /// Number of the sheet, from 1.
    pub index: usize,
    /// Extent along X.
    pub width: f64,
    /// Extent along Y.
    pub height: f64,
}

/// Number of a part's sheet, and where it lies on it.
pub(super) type Placement = (usize, Isometry);

/// Places the boxes row by row, in order.
///
/// An extent that the spec leaves open grows with the parts: in width for as many columns as make the
/// sheet about square, in height as far as the machine reaches. On a sheet larger than that the parts stay within reach.
///
/// # Errors
/// The parts that do not fit on the sheet, or that the machine does not reach all of.
pub(super) fn place(
    boxes: &[Bounds],
    sheet: &Sheet,
    machine: &Machine,
) -> Result<(Vec<Placement>, Vec<SheetLayout>), Refusal> {
    sheet_on_plates(sheet, machine)?;
    let room = FreeArea::new(sheet, machine);
    room.refuse(boxes, sheet, machine)?;
    let columns = match sheet.width {
        Some(_) => usize::MAX,
        None => (1..=boxes.len()).find(|c| c * c >= boxes.len()).unwrap_or(1),
    };
    let mut rows = Rows::new(sheet, room, columns);
    let places = boxes.iter().map(|bounds| rows.add(bounds)).collect();
    rows.end_sheet();
    Ok((places, rows.done))
}

/// The largest extent that parts may take on a sheet, mm.
#[derive(Clone, Copy)]
struct FreeArea {
    width: f64,
    height: f64,
}

/// Rows of parts, filled from the lower left.
struct Rows<'a> {
    sheet: &'a Sheet,
    room: FreeArea,
    /// Most parts in a row.
    columns: usize,
    /// The place of the next part, without the margin.
    next: Point,
    row_height: f64,
    in_row: usize,
    /// Extent that is taken on this sheet.
    used: Point,
    done: Vec<SheetLayout>,
}

impl FreeArea {
    /// The room on the sheet and the machine between the margins.
    fn new(sheet: &Sheet, machine: &Machine) -> Self {
        let area = machine.bench.work_area;
        Self {
            width: room_along(sheet.width, area.map(|(x, _)| x), sheet),
            height: room_along(sheet.height, area.map(|(_, y)| y), sheet),
        }
    }

    fn has_room_for(self, bounds: &Bounds) -> bool {
        bounds.width() <= self.width && bounds.height() <= self.height
    }

    /// Whether the sheet or the machine is too small for one of `parts`; the refusal names the sides that all of them need.
    fn refuse(self, parts: &[Bounds], sheet: &Sheet, machine: &Machine) -> Result<(), Refusal> {
        // Of the parts without room the longest width and height are named together, so that one change is enough for all.
        // The sheet is asked first, then the plates of a press, then the reach of the machine.
        let oversized = parts
            .iter()
            .filter(|part| !(self.has_room_for(part) || sheet.turn && self.has_room_for(&turned(part))))
            .map(|part| Point::new(part.width(), part.height()));
        let Some(largest) = oversized.reduce(|a, b| Point::new(a.x.max(b.x), a.y.max(b.y))) else {
            return Ok(());
        };
        let part = &Bounds { min: Point::ORIGIN, max: largest };
        fits(part, sheet)?;
        let Some((x, y)) = machine.bench.work_area else { return Ok(()) };
        if machine.tool == SealingTool::Press {
            let margins = 2.0 * sheet.margin.0;
            return Err(beyond_plates(
                [part.width() + margins, part.height() + margins],
                [x, y],
                "a part with its margins",
            ));
        }
        let size_text = size_in_words(tenths_up(part.width()), tenths_up(part.height()));
        let missing = Readable(tenths_up((part.width() - self.width).max(part.height() - self.height)));
        let reach_text = if self.width.min(self.height) > 0.0 {
            format!("within the margins {} reaches {}", machine.name, size_in_words(self.width, self.height))
        } else {
            format!("the margins leave nothing of what {} reaches", machine.name)
        };
        let fault = format!("a part with its ramps needs {size_text}; {reach_text}");
        let remedy = format!(
            "{missing} mm are missing: a smaller part, a smaller margin in [sheet], or a machine with more than {}",
            size_in_words(x.0, y.0)
        );
        Err(Refusal::new(key::machine::PROFILE, RefusalCode::OutOfReach, fault, remedy))
    }
}

impl<'a> Rows<'a> {
    fn new(sheet: &'a Sheet, room: FreeArea, columns: usize) -> Self {
        let (next, extent) = (Point::ORIGIN, Point::ORIGIN);
        Self { sheet, room, columns, next, row_height: 0.0, in_row: 0, used: extent, done: Vec::new() }
    }

    fn add(&mut self, part: &Bounds) -> Placement {
        let turn = self.turns(part);
        let bounds = if turn { turned(part) } else { *part };
        let (w, h) = (bounds.width(), bounds.height());
        if self.in_row == self.columns || self.next.x + w > self.room.width {
            self.next = Point::new(0.0, self.next.y + self.row_height + self.sheet.gap.0);
            (self.row_height, self.in_row) = (0.0, 0);
        }
        if self.next.y + h > self.room.height {
            self.end_sheet();
        }
        let margin = self.sheet.margin.0;
        let corner = Point::new(margin + self.next.x, margin + self.next.y);
        let rotation = if turn { FRAC_PI_2 } else { 0.0 };
        let placement = Isometry { shift: corner - bounds.min, ..Isometry::rotation(rotation) };
        self.used = Point::new(self.used.x.max(self.next.x + w), self.used.y.max(self.next.y + h));
        self.row_height = self.row_height.max(h);
        self.next.x += w + self.sheet.gap.0;
        self.in_row += 1;
        (self.done.len() + 1, placement)
    }

    /// A part is turned where it fits no other way, or where it then still fits into the row.
    fn turns(&self, part: &Bounds) -> bool {
        let lying = turned(part);
        let ends_row = self.in_row == self.columns || self.next.x + part.width() > self.room.width;
        let fits_row = self.in_row < self.columns
            && self.next.x + lying.width() <= self.room.width
            && self.next.y + lying.height() <= self.room.height;
        self.sheet.turn
            && self.room.has_room_for(&lying)
            && (!self.room.has_room_for(part) || ends_row && fits_row)
    }

    fn end_sheet(&mut self) {
        // Whole tenths of a millimetre read well in a file and lose nothing.
        let sides = [(self.sheet.width, self.used.x), (self.sheet.height, self.used.y)];
        let [width, height] = sides.map(|(side, used)| {
            side.map_or_else(|| tenths_up(used + 2.0 * self.sheet.margin.0), |length| length.0)
        });
        self.done.push(SheetLayout { index: self.done.len() + 1, width, height });
        (self.next, self.used, self.row_height, self.in_row) = (Point::ORIGIN, Point::ORIGIN, 0.0, 0);
    }
}

/// The box that a piece needs on its sheet: the tool's way around it, and the bands with ramps of length `ramp`.
pub(super) fn footprint(shape: &SealedShape, tool_path: &Path, ramp: f64) -> Bounds {
    shape
        .seams
        .iter()
        .map(|seam| seam.run().chain(seam.lead_in(ramp)).chain(seam.lead_out(ramp)).bounds())
        .map(|bounds| bounds.outset(shape.band / 2.0))
        .fold(tool_path.bounds(), Bounds::union)
}

/// Rounding of sizes, mm: a part that needs all of a sheet fits on it.
const ROUNDING: f64 = 1e-9;

/// The room on the sheet between its margins, mm; infinite without an extent.
fn on_sheet(extent: Option<Length>, sheet: &Sheet) -> f64 {
    extent.map_or(f64::INFINITY, |length| length.0 - 2.0 * sheet.margin.0 + ROUNDING)
}

/// The box turned by a quarter turn about the origin, counterclockwise.
fn turned(bounds: &Bounds) -> Bounds {
    let (min, max) = (bounds.min, bounds.max);
    Bounds { min: Point::new(-max.y, min.x), max: Point::new(-min.y, max.x) }
}

/// Refuses a sheet that is too small for a part of the size of `part`, with all sides that are too short.
fn fits(part: &Bounds, sheet: &Sheet) -> Result<(), Refusal> {
    let sides = [
        (key::sheet::WIDTH, "wide", part.width(), on_sheet(sheet.width, sheet)),
        (key::sheet::HEIGHT, "high", part.height(), on_sheet(sheet.height, sheet)),
    ];
    let short: Vec<_> =
        sides.into_iter().filter(|(_, _, needed_length, room)| needed_length > room).collect();
    let Some((key, ..)) = short.first() else { return Ok(()) };
    let faults = short.iter().map(|(_, word, needed_length, room)| {
        // Rounded apart, so that the digits show the difference.
        let (needed_length, room) = (Readable(tenths_up(*needed_length)), tenths_down(*room));
        let room = if room > 0.0 { format!("{} mm", Readable(room)) } else { "nothing".to_owned() };
        format!("{needed_length} mm {word} where the margins leave {room}")
    });
    let remedy = short.iter().map(|(key, _, needed_length, _)| {
        let smallest = Least(needed_length + 2.0 * sheet.margin.0);
        format!("`{}` at least {smallest} mm", key.key())
    });
    let fault = format!("a part is {}", faults.collect::<Vec<_>>().join(", and one is "));
    let remedy = format!("must be {}", remedy.collect::<Vec<_>>().join(" and "));
    Err(Refusal::new(*key, RefusalCode::SheetTooSmall, fault, remedy))
}

/// The room along one side of `sheet`, which is `extent` long, on a machine that reaches `area` along it.
fn room_along(extent: Option<Length>, area: Option<Length>, sheet: &Sheet) -> f64 {
    // A sheet that has no extent of its own ends, with its margin, where the machine does.
    let margins = if extent.is_some() { 1.0 } else { 2.0 } * sheet.margin.0;
    on_sheet(extent, sheet).min(area.map_or(f64::INFINITY, |area| area.0 - margins))
}

/// A width and a height, mm, in words.
pub(super) fn size_in_words(width: f64, height: f64) -> String {
    format!("{} x {} mm", Readable(width), Readable(height))
}

/// The refusal of a `subject` of these sides, mm, which no press of these `plates` presses at once.
fn beyond_plates(sides: [f64; 2], plates: [Length; 2], subject: &str) -> Refusal {
    let [width, height] = sides.map(tenths_up);
    let [x, y] = plates.map(|length| length.0);
    let fault =
        format!("{subject} is {}, and the plates are {}", size_in_words(width, height), size_in_words(x, y));
    let remedy = format!(
        "must be plates of at least {}: a larger press, a smaller part, or smaller `width`, `height` and `margin` in [sheet]",
        size_in_words(width.max(x), height.max(y))
    );
    Refusal::new(key::press::PLATES, RefusalCode::OutOfReach, fault, remedy)
}

/// The refusal of a sheet whose stated sides are larger than the plates of the press.
fn sheet_on_plates(sheet: &Sheet, machine: &Machine) -> Result<(), Refusal> {
    let Some((x, y)) = machine.bench.work_area.filter(|_| machine.tool == SealingTool::Press) else {
        return Ok(());
    };
    let sides = [sheet.width, sheet.height].map(|side| side.map_or(0.0, |length| length.0));
    if sides[0] <= x.0 && sides[1] <= y.0 {
        return Ok(());
    }
    let stated = [sheet.width.unwrap_or(x).0, sheet.height.unwrap_or(y).0];
    Err(beyond_plates(stated, [x, y], "the sheet"))
}

/// One piece on its sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedPart {
    /// The kind of piece: "star".
    pub kind: &'static str,
    /// Number of the piece; of the stars of a stack 1 = bottom.
    pub index: usize,
    /// Index of the distinct piece, from 0.
    pub distinct: usize,
    /// Number of its sheet, from 1.
    pub sheet: usize,
    /// From the piece's frame to the sheet's.
    pub placement: Isometry,
}

impl PlacedPart {
    /// Name of the piece: star 2.
    pub fn name(&self) -> PieceName {
        PieceName::numbered(self.kind, self.index)
    }

    /// Pieces of one `kind`, numbered from 1, of which each is one of the distinct ones and has its place.
    pub(super) fn place_all(kind: &'static str, part_numbers: &[usize], places: Vec<Placement>) -> Vec<Self> {
        let placed = part_numbers.iter().zip(places).zip(1..);
        placed
            .map(|((&distinct, (sheet, placement)), index)| Self { kind, index, distinct, sheet, placement })
            .collect()
    }
}
