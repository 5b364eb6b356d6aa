//! Strips for a heat press: temperature by time, one **card** a setting.
//!
//! A card is two rectangles of fabric, pressed on its own. Paper between them leaves one straight band free along the lower edge, so that
//! all specimens of a setting have welds of one width. The specimens are cut out of the card.
//!
//! ```text
//!   +--+--+--+--+   paper, up to 10 mm beyond the fabric
//!   |  |  |  |  |   legs of 75 mm, 25 mm wide
//!   |==|==|==|==|   band
//! ```

use std::fmt::Write;

use crate::coupon::strips::{LEGS, TEMPERATURES, WIDTH, out_of_range};
use crate::emit;
use crate::emit::GridCell;
use design::{Drawing, Layer, Origin, Shape, lettered};
use geom::{Bounds, Line, Path, Point, Vec2};
use spec::units::{Duration, Temperature};
use spec::{PRESS_TIMES, Press, Spec};

/// Strip at both sides of a card that is cut off, mm.
const WASTE: f64 = 5.0;
/// Paper beyond the fabric, mm, by which it is laid and pulled out.
const BEYOND: f64 = 10.0;
/// Distance of cards, and of the first one from the sheet's edges, mm.
const GAP: f64 = 15.0;
/// Largest number of cards in a row.
const ROW: usize = 3;
/// Height of a specimen's number, mm.
const NUMBER: f64 = 5.0;
/// Height of the letters of its setting, mm: five of them fit beside each other.
const LETTERS: f64 = 3.0;

/// The settings to vary.
#[derive(Clone, Debug, PartialEq)]
pub struct PressGrid {
    /// Temperatures of the plates.
    pub temperatures: Vec<Temperature>,
    /// Times under pressure.
    pub times: Vec<Duration>,
    /// Number of specimens of each setting; at least three for a spread.
    pub repeats: usize,
}

/// One card: a setting with its specimens.
struct Card {
    temperature: Temperature,
    time: Duration,
    /// Number of its first specimen, from 1.
    first: usize,
    /// The fabric on the sheet.
    fabric: Bounds,
}

impl PressGrid {
    /// The settings around those of `press`: 10 C below and above, half and twice the time, as far as they are allowed.
    pub fn around_press(press: &Press, repeats: usize) -> Self {
        let temperatures = [-10.0, 0.0, 10.0].map(|step| Temperature(press.temperature.0 + step));
        let times = [0.5, 1.0, 2.0].map(|factor| Duration(factor * press.time.0));
        Self {
            temperatures: temperatures.into_iter().filter(|value| TEMPERATURES.contains(value.0)).collect(),
            times: times.into_iter().filter(|value| PRESS_TIMES.contains(value.0)).collect(),
            repeats,
        }
    }

    /// The first value that no press has, or that is stated twice, as text with the allowed ones; `None` if all are possible.
    pub fn refusal(&self) -> Option<String> {
        let temperatures: Vec<f64> = self.temperatures.iter().map(|value| value.0).collect();
        let times: Vec<f64> = self.times.iter().map(|value| value.0).collect();
        let is_double = [temperatures, times]
            .iter()
            .any(|values| values.iter().enumerate().any(|(i, value)| values[..i].contains(value)));
        out_of_range("temperature", &self.temperatures, TEMPERATURES)
            .or_else(|| out_of_range("time", &self.times, PRESS_TIMES))
            .or_else(|| {
                is_double
                    .then(|| "a setting is given twice; `repeats` presses a setting more often".to_owned())
            })
    }

    /// Number of settings.
    pub fn cards(&self) -> usize {
        self.temperatures.len() * self.times.len()
    }

    /// Number of specimens.
    pub fn strips(&self) -> usize {
        self.cards() * self.repeats
    }

    /// The cards in rows from the lower left, with bands of `band` mm.
    fn placed_cards(&self, band: f64) -> Vec<Card> {
        let size = Vec2::new(float(self.repeats) * WIDTH + 2.0 * WASTE, LEGS + band);
        let settings = self
            .temperatures
            .iter()
            .flat_map(|temperature| self.times.iter().map(move |time| (*temperature, *time)));
        let card = |(index, (temperature, time)): (usize, (Temperature, Duration))| {
            let (column, row) = (float(index % ROW), float(index / ROW));
            let min = Point::new(GAP + column * (size.x + GAP), GAP + row * (size.y + BEYOND + GAP));
            let fabric = Bounds { min, max: min + size };
            Card { temperature, time, first: 1 + index * self.repeats, fabric }
        };
        settings.enumerate().map(card).collect()
    }
}

#[expect(clippy::cast_precision_loss, reason = "at most some thousand strips")]
fn float(number: usize) -> f64 {
    number as f64
}

impl Card {
    /// The specimens: rectangles beside each other.
    fn specimens(&self, repeats: usize) -> impl Iterator<Item = (usize, Bounds)> {
        let (mut left_edge, first) = (self.fabric.min.x + WASTE, self.first);
        let (bottom, top) = (self.fabric.min.y, self.fabric.max.y);
        (0..repeats).map(move |index| {
            let bounds =
                Bounds { min: Point::new(left_edge, bottom), max: Point::new(left_edge + WIDTH, top) };
            left_edge += WIDTH;
            (first + index, bounds)
        })
    }

    /// The paper above a band of `band` mm, wider than the fabric on the other three sides.
    fn paper(&self, band: f64) -> Bounds {
        let Bounds { min, max } = self.fabric;
        Bounds {
            min: Point::new(min.x - WASTE, min.y + band),
            max: Point::new(max.x + WASTE, max.y + BEYOND),
        }
    }

    /// The outline of a specimen, its number and its setting above the band.
    fn marks(&self, number: usize, bounds: &Bounds, band: f64) -> Vec<Shape> {
        let rows = [
            (number.to_string(), NUMBER),
            (self.temperature.to_string(), LETTERS),
            (self.time.to_string(), LETTERS),
        ];
        let mut y = bounds.min.y + band + LEGS / 2.0;
        let mut shapes = vec![Shape::Path(Path::rectangle(bounds))];
        for (text, height) in rows {
            shapes.extend(Shape::figure(lettered(
                &text.to_uppercase(),
                Point::new(bounds.min.x + 3.0, y),
                height,
            )));
            y -= 2.0 * height;
        }
        shapes
    }
}

/// The drawings of the cards at 1:1 as SVG with their names: every strip with its setting, the fabric with its lines and
/// numbers, and the paper, which is the same for all cards.
pub fn press_drawings(spec: &Spec, grid: &PressGrid) -> [(&'static str, String); 3] {
    // All drawings show the cards at the same places. A cutter cuts fabric and paper; edges of bands, specimens and their
    // settings are marks.
    let band = spec.seal.band.0;
    let cards = grid.placed_cards(band);
    let cells: Vec<GridCell> = cards
        .iter()
        .flat_map(|card| {
            card.specimens(grid.repeats).map(move |(number, bounds)| cell(card, number, bounds, band))
        })
        .collect();
    let fabric = rectangles(cards.iter().map(|card| card.fabric));
    let edges = cards.iter().map(|card| card.fabric.min.y + band).zip(&cards);
    let edges = edges.map(|(y, card)| [card.fabric.min.x, card.fabric.max.x].map(|x| Point::new(x, y)));
    let edges = edges.map(|[start, end]| Shape::Path(Path::open(vec![Line::new(start, end).into()])));
    let marks = cards.iter().flat_map(|card| {
        let specimens = card.specimens(grid.repeats);
        specimens.flat_map(move |(number, bounds)| card.marks(number, &bounds, band))
    });
    let sheet = vec![(Layer::CutOutside, fabric), (Layer::Label, edges.chain(marks).collect())];
    let paper = cards.iter().take(1).map(|card| card.paper(band));
    [
        ("strips.svg", emit::cells(&format!("press strips: {}", spec.name), &cells, band)),
        ("cards.svg", sheet_svg("fabric cards", spec, sheet)),
        ("paper.svg", sheet_svg("paper of a card", spec, vec![(Layer::SeparatorEdge, rectangles(paper))])),
    ]
}

/// The strip `number` of `card`, with its setting.
fn cell(card: &Card, number: usize, specimen: Bounds, band: f64) -> GridCell {
    let middle = specimen.min.y + band / 2.0;
    let line = Line::new(Point::new(specimen.min.x, middle), Point::new(specimen.max.x, middle));
    let words = vec![card.temperature.to_string(), card.time.to_string()];
    GridCell { number, seam: Path::open(vec![line.into()]), specimen, words }
}

fn rectangles(bounds: impl Iterator<Item = Bounds>) -> Vec<Shape> {
    bounds.map(|bounds| Shape::Path(Path::rectangle(&bounds))).collect()
}

/// The `layers` on a sheet as large as they need.
fn sheet_svg(title: &str, spec: &Spec, layers: Vec<(Layer, Vec<Shape>)>) -> String {
    let shapes = layers.iter().flat_map(|(_, shapes)| shapes);
    let bounds = shapes.map(Shape::bounds).fold(Bounds::EMPTY, Bounds::union);
    let drawing =
        Drawing { origin: Origin::LowerLeft, width: bounds.max.x + GAP, height: bounds.max.y + GAP, layers };
    emit::svg(title, &drawing, spec.accuracy.path, spec.cut.colours)
}

/// The table to fill in, as CSV.
pub fn press_table(spec: &Spec, grid: &PressGrid) -> String {
    let mut lines = String::from("strip,temperature_C,time_s,peel_N,failure\n");
    for card in grid.placed_cards(spec.seal.band.0) {
        for (number, _) in card.specimens(grid.repeats) {
            // Writing to a String does not fail.
            let _ = writeln!(lines, "{number},{},{},,", card.temperature.0, card.time.0);
        }
    }
    lines
}
