//! The instructions for a heat press: what lies between the plates, how hot, how long, with which force, and what to do before and after.

use crate::lettering::{lettered, width};
use crate::mask::GRAVITY;
use crate::overview::Scaled;
use crate::paper::Page;
use crate::{CutEdge, Design, Drawing, Layer, Origin, Shape, separator};
use geom::{Bounds, Path, Point, Vec2};
use sealed::Tongue;
use spec::units::{Readable, count_text};
use spec::{PaperSize, Press, PressLayer, Spec};

/// The instructions for the press of a spec.
#[derive(Clone, Debug, PartialEq)]
pub struct PressPlan {
    /// Number of pressings: one a sheet of fabric.
    pub pressings: usize,
    /// Time under pressure of all pressings, s.
    pub seconds: f64,
    /// Fabric under the plates in the largest pressing, mm^2.
    pub area: f64,
    /// Force of the press on that area, N.
    pub force: f64,
    /// Temperature, time, pressure, and force in one line.
    pub settings: String,
    /// The instructions under their headings.
    pub sections: Vec<PlanSection>,
}

/// A heading with its lines.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanSection {
    /// The heading.
    pub heading: &'static str,
    /// One statement each.
    pub lines: Vec<String>,
}

impl PressPlan {
    /// The plan of `design`; `None` for a machine that is no press.
    pub fn new(spec: &Spec, design: &Design) -> Option<Self> {
        let press = spec.press.as_ref()?;
        let area = design.sheets.iter().map(|sheet| sheet.width * sheet.height).fold(0.0, f64::max);
        let pressings = design.sheets.len();
        let force = press.force(area);
        let settings = format!(
            "{}, {}, {}: a force of {}",
            press.temperature,
            press.time,
            press.pressure_in_bar(),
            force_in_words(force)
        );
        let sections = vec![
            PlanSection { heading: "Prepare", lines: preparation(spec, design, press) },
            PlanSection { heading: "Layers, from below", lines: layers(design, press) },
            PlanSection { heading: "Press", lines: pressing(design, press, area, force) },
            PlanSection { heading: "Finish", lines: finish(spec, design) },
            PlanSection { heading: "Check", lines: checks(spec) },
        ];
        let seconds = press.time.0 * f64::from(u32::try_from(pressings).unwrap_or(u32::MAX));
        Some(Self { pressings, seconds, area, force, settings, sections })
    }

    /// The force of the press, to two digits: "18 kN (1800 kg)".
    pub fn force_in_words(&self) -> String {
        force_in_words(self.force)
    }

    /// "1 pressing of 10 s at 145 C and 2 bar"
    pub fn in_words(&self, press: &Press) -> String {
        let number = count_text(self.pressings, "pressing");
        format!("{number} of {} at {} and {}", press.time, press.temperature, press.pressure_in_bar())
    }

    /// The page for the workshop: the text, and a small picture of the first sheet. `name` is the design's.
    pub fn page(&self, name: &str, design: &Design) -> Page {
        // Long instructions get smaller letters, so that all of them are on one page.
        let heights = [2.6, 2.3, 2.0, 1.8, LEAST_LETTERS];
        let mut candidates = heights.iter().map(|height| self.strokes(name, *height));
        let fitting = candidates.find(|(_, bottom)| *bottom >= BORDER);
        let (mut strokes, bottom) = fitting.unwrap_or_else(|| self.strokes(name, LEAST_LETTERS));
        strokes.extend(picture(design, bottom));
        let layers = vec![(Layer::PaperMark, vec![Shape::Figure(strokes)])];
        Page {
            name: "PRESS".to_owned(),
            window: Bounds { min: Point::ORIGIN, max: Point::new(PAGE[0], PAGE[1]) },
            drawing: Drawing { origin: Origin::LowerLeft, width: PAGE[0], height: PAGE[1], layers },
        }
    }

    /// The strokes of the text in letters `height` mm high, and the height of the last line on the page, mm.
    fn strokes(&self, name: &str, height: f64) -> (Vec<Path>, f64) {
        let mut rows = vec![
            (format!("Press plan: {name}"), 0.0, 1.5 * height),
            (self.settings.clone(), 0.0, 1.2 * height),
        ];
        for section in &self.sections {
            rows.push((" ".to_owned(), 0.0, 0.4 * height));
            rows.push((section.heading.to_owned(), 0.0, 1.2 * height));
            let lines = (1..).zip(&section.lines);
            rows.extend(lines.map(|(number, line)| (format!("{number}. {line}"), height, height)));
        }
        let (mut strokes, mut y) = (Vec::new(), PAGE[1] - BORDER);
        for (text, indent, size) in rows {
            for line in wrapped(&text, PAGE[0] - 2.0 * BORDER - indent, size) {
                y -= LEADING * size;
                strokes.extend(lettered(&line, Point::new(BORDER + indent, y), size));
            }
        }
        (strokes, y)
    }
}

/// Width and height of the page, mm: A4, of which a printer for letter paper prints all but the lowest lines' margin.
const PAGE: [f64; 2] = [210.0, 297.0];
/// Strip without text along the page's border, mm.
const BORDER: f64 = 15.0;
/// Height of the smallest capitals on the page, mm.
const LEAST_LETTERS: f64 = 1.6;
/// Distance of lines, in heights of a capital.
const LEADING: f64 = 1.7;

/// `text` in capitals, in lines of at most `room` mm. Signs without strokes are left out.
fn wrapped(text: &str, room: f64, height: f64) -> Vec<String> {
    let plain = text
        .to_uppercase()
        .replace(" (", ", ")
        .replace([')', '"'], "")
        .replace('\u{b2}', "2")
        .replace(';', ",");
    let mut lines = vec![String::new()];
    for word in plain.split(' ') {
        let line = lines.last().map_or("", String::as_str);
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        match lines.last_mut() {
            Some(last) if last.is_empty() || width(&longer, height) <= room => *last = longer,
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The first sheet of fabric made small below `top`, with outlines, holes, and separators where they lie.
fn picture(design: &Design, top: f64) -> Vec<Path> {
    // The sheet is scaled into the room below the text, and left out where that is too low to be read. Edges, papers
    // and holes of each piece follow, with the piece's number in its middle.
    let room = Bounds {
        min: Point::new(BORDER, BORDER),
        max: Point::new(PAGE[0] - BORDER, top - 2.0 * LEADING * 2.6),
    };
    let Some(sheet) = design.sheets.first().filter(|_| room.height() > 25.0) else { return Vec::new() };
    let scale = (room.width() / sheet.width).min(room.height() / sheet.height);
    let small = Scaled { scale, shift: room.min - Point::ORIGIN };
    let mut paths =
        vec![small.path(&Path::rectangle(&Bounds {
            min: Point::ORIGIN,
            max: Point::new(sheet.width, sheet.height),
        }))];
    for placed in design.on_sheet(sheet.index) {
        let part = design.part(placed);
        let cut = part.cut(CutEdge::Part);
        let edges = std::iter::once(cut.outside).chain(cut.inside);
        let papers = part
            .separator()
            .into_iter()
            .flat_map(|paper| paper.part.pieces.iter().chain(&paper.part.windows));
        paths.extend(edges.chain(papers).map(|path| small.path(&placed.placement.path(path))));
        let holes =
            cut.holes.iter().map(|hole| Shape::Circle { center: hole.center, radius: hole.diameter / 2.0 });
        paths.extend(holes.flat_map(|hole| {
            hole.paths().iter().map(|path| small.path(&placed.placement.path(path))).collect::<Vec<_>>()
        }));
        let text = separator::name(placed);
        let middle = small.point(placed.placement.point(part.middle()));
        paths.extend(lettered(&text, middle - Vec2::new(width(&text, NUMBER), NUMBER) * 0.5, NUMBER));
    }
    paths
}

/// Height of a piece's number in the picture, mm.
const NUMBER: f64 = 2.5;

/// `x`, 0 or more, rounded to two digits.
fn two_digits(x: f64) -> f64 {
    let unit = libm::pow(10.0, (libm::log10(x.max(1e-9)) - 1.0).floor());
    (x / unit).round() * unit
}

/// "18 kN (1800 kg)", to two digits.
fn force_in_words(newton: f64) -> String {
    let kilograms = two_digits(newton / GRAVITY);
    if newton < 1000.0 {
        format!("{} N ({} kg)", Readable(two_digits(newton)), Readable(kilograms))
    } else {
        format!("{} kN ({} kg)", Readable(two_digits(newton / 1000.0)), Readable(kilograms))
    }
}

fn preparation(spec: &Spec, design: &Design, press: &Press) -> Vec<String> {
    // One line for each thing to do before the first pressing, in the order of doing it. Lines that depend on the
    // design are left out where it does not have what they speak of.
    let sheets: Vec<String> = design
        .sheets
        .iter()
        .map(|sheet| format!("{} x {} mm", Readable(sheet.width), Readable(sheet.height)))
        .collect();
    let hole = spec.sheet.hole_diameter;
    let mut lines = vec![format!("Cut two equal sheets of fabric for each pressing: {}.", sheets.join(", "))];
    if hole.0 > 0.0 {
        lines.push(format!(
            "Print the outlines at 100 percent, and measure the ruler. Punch the holes of {hole} through both sheets of fabric. Do not cut the outlines yet."
        ));
    }
    let (papers, is_nested) = (design.papers.len(), press.paper.is_some());
    let size = match press.paper {
        Some(PaperSize::A4) => "A4".to_owned(),
        Some(PaperSize::A3) => "A3".to_owned(),
        Some(PaperSize::Letter) => "letter paper".to_owned(),
        Some(PaperSize::Custom(width, height)) => {
            format!("paper of {} x {} mm", Readable(width.0), Readable(height.0))
        }
        None => "paper as large as the fabric".to_owned(),
    };
    lines.push(format!(
        "Take {} of {size}: baking paper or silk paper, at most 0.1 mm thick. Punch the holes, then cut the windows, then around the separators, but for some bridges that keep the sheet whole.",
        count_text(papers, "sheet"),
    ));
    if is_nested {
        lines.push("Cut the paper apart between the separators: each keeps its three holes.".to_owned());
    }
    let has_ring = design
        .placed()
        .iter()
        .any(|placed| design.part(placed).separator().is_some_and(|paper| !paper.part.windows.is_empty()));
    if has_ring {
        lines.push(
            "A separator that goes around a window cannot be pulled out whole: cut it open once, opposite of its tongue, without taking paper away."
                .to_owned(),
        );
    }
    lines
}

fn layers(design: &Design, press: &Press) -> Vec<String> {
    let (mut fabrics, mut lines) = (0, Vec::new());
    for layer in &press.layers {
        lines.push(match layer {
            PressLayer::Board => "Board: flat, larger than the sheet.".to_owned(),
            PressLayer::Release => "Release layer: baking paper or PTFE, larger than the sheet.".to_owned(),
            PressLayer::Fabric => {
                fabrics += 1;
                match fabrics {
                    1 => "Lower sheet of fabric: the side that welds up, on three pins through its holes.".to_owned(),
                    _ => "Upper sheet of fabric: the side that welds down, on the same pins.".to_owned(),
                }
            }
            PressLayer::Separator => {
                let names: Vec<String> = design
                    .placed()
                    .iter()
                    .filter(|placed| design.sheets.len() < 2 || placed.sheet == 1)
                    .map(separator::name)
                    .collect();
                let of_first = if design.sheets.len() > 1 { " (first pressing)" } else { "" };
                format!(
                    "Separators {}{of_first}: lay the paper on the pins, numbers up, cut the bridges, and lift off all but the separators.",
                    names.join(", ")
                )
            }
        });
    }
    lines
}

fn pressing(design: &Design, press: &Press, area: f64, force: f64) -> Vec<String> {
    let plural = if design.sheets.len() == 1 { "Press once" } else { "Press each sheet once" };
    vec![
        "Pull the pins out without moving the layers.".to_owned(),
        format!(
            "{plural}: {} for {}. The plates must cover the sheet at once.",
            press.temperature, press.time
        ),
        format!(
            "Pressure {} on {} cm\u{b2}: the press must give {}. If yours gives less, press smaller sheets or test a coupon with what it gives.",
            press.pressure_in_bar(),
            Readable((area / 100.0).round()),
            force_in_words(force)
        ),
        "Take everything out together, and let it cool flat under a board until it is hand-warm. Then lift the release layers off.".to_owned(),
    ]
}

fn finish(spec: &Spec, design: &Design) -> Vec<String> {
    let mut lines = vec!["Cut along the outlines, holes first.".to_owned()];
    let placed = design.placed();
    for piece in placed.iter().take(LISTED) {
        let Some(paper) = design.part(piece).separator() else { continue };
        let name = separator::name(piece);
        let ends = paper.tongues.iter().map(|tongue| place_of(tongue, piece.placement.point(tongue.end)));
        let ends: Vec<String> = ends.collect();
        let sheet =
            if design.sheets.len() > 1 { format!(" on sheet {}", piece.sheet) } else { String::new() };
        lines.push(if ends.is_empty() {
            format!("{name}: there is no port, so the paper stays inside.")
        } else {
            format!("{name}: pull the paper out by its tongue, {}{sheet}.", ends.join(" and "))
        });
    }
    if let Some(further_count) = placed.len().checked_sub(LISTED).filter(|further_count| *further_count > 0) {
        lines.push(format!("The other {further_count} in the same way: the number is on each tongue."));
    }
    lines.push("Paper wider than its port crumples on its way out: pull slowly, with flat tweezers. Thin paper may also stay inside.".to_owned());
    if let Some(inlet) = &spec.inlet {
        lines.push(format!("Push the hose of {} into the port, and glue or clamp it.", inlet.tube_diameter));
    }
    lines
}

/// Pieces whose tongues are listed.
const LISTED: usize = 8;

/// The place of a tongue's end on the sheet, mm.
fn place_of(tongue: &Tongue, end: Point) -> String {
    format!("port {} at X {} Y {} mm", tongue.port + 1, Readable(end.x.round()), Readable(end.y.round()))
}

fn checks(spec: &Spec) -> Vec<String> {
    let mut lines = vec![
        "Before the first part: peel a strip of the same fabric, sealed with these settings. The fabric should tear before the seal opens.".to_owned(),
        format!("Against the light: every band is at least {} wide, even, without wrinkles or burns.", spec.seal.band),
        "A hose or a knitting needle goes through each port into the chamber.".to_owned(),
    ];
    lines.push(match spec.load.as_ref().and_then(|load| load.pressure) {
        Some(pressure) => format!("Inflate under water, first to a tenth of {pressure}: no bubbles."),
        None => "Inflate gently under water: no bubbles.".to_owned(),
    });
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_has_two_digits() {
        assert_eq!(force_in_words(18_000.0), "18 kN (1800 kg)");
        assert_eq!(force_in_words(250.0), "250 N (25 kg)");
    }

    #[test]
    fn lines_are_as_long_as_the_room() {
        let lines = wrapped("press with 18 kN (1835 kg); then cool", 60.0, 3.0);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 3.0) <= 60.0), "{lines:?}");
        assert_eq!(lines.join(" "), "PRESS WITH 18 KN, 1835 KG, THEN COOL");
    }
}
