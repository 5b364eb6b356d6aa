//! Pictures of the comparison: which model to take for which question, with its cost, and below it the limits against the exact ring; and
//! error against time, of every model against the shells.

use crate::trade::shells::{ShellRow, StarErrors, mean, rms};
use crate::trade::shown;
use crate::trade::{QUANTITIES, TradeRow};
use geom::order::sort_by;
use std::fmt::Write;

/// Sizes of the pictures, pixels.
const CHOICE: [u32; 2] = [980, 640];
const SHELLS: [u32; 2] = [1090, 480];
/// Sizes of pictures of earlier versions, which are replaced, too.
const EARLIER: [[u32; 2]; 1] = [[860, 480]];
/// Colours, one a model.
const COLOURS: [&str; 8] =
    ["#b7791f", "#1b6ca8", "#8e44ad", "#c0392b", "#e67e22", "#7fb3a0", "#27865c", "#0b3d2e"];
/// Colours, one a quantity of the limits.
const QUANTITY_COLOURS: [&str; 5] = ["#1b6ca8", "#c0392b", "#27865c", "#8e44ad", "#b7791f"];

/// Distance between two rows, pixels.
const ROW: f64 = 24.0;
/// First rows of the choice and of the limits.
const CHOICE_TOP: f64 = 100.0;
const RING_TOP: f64 = 440.0;
/// Columns of names (left), and of times (right).
const NAMES: f64 = 16.0;
const TIMES: f64 = 205.0;

/// A logarithmic axis of errors, rising to the right: its ends in pixels and in decades.
struct LogAxis {
    left: f64,
    width: f64,
    decades: [i32; 2],
}

/// The questions: 0.1 % to 1000 %.
const QUESTIONS: [LogAxis; 3] = [question(230.0), question(480.0), question(730.0)];
/// The limits: 1e-16 to 1.
const RING: LogAxis = LogAxis { left: 230.0, width: 660.0, decades: [-16, 0] };

const fn question(left_side: f64) -> LogAxis {
    LogAxis { left: left_side, width: 185.0, decades: [-3, 1] }
}

/// The errors by which a question is answered, and its words.
type Errors = fn(&StarErrors) -> Option<f64>;
const ANSWERS: [(&str, Errors); 3] = [
    ("How far does it close?", |star| Some(star.radius)),
    ("How stiff is it?", |star| star.stiffness),
    ("How hard does it grip?", |star| star.force),
];

impl LogAxis {
    fn x(&self, error: f64) -> f64 {
        let [first, last] = self.decades.map(f64::from);
        self.left + (libm::log10(error).clamp(first, last) - first) / (last - first) * self.width
    }

    /// Upright lines through `rows` rows below `top`, each with the name of its decade below.
    fn lines(&self, svg: &mut String, top: f64, rows: u8, decades: impl Iterator<Item = (i32, String)>) {
        let bottom = top + f64::from(rows) * ROW;
        for (decade, name) in decades {
            let x = format!("{:.1}", self.x(10_f64.powi(decade)));
            let _ = writeln!(svg, "<path d=\"M{x} {top}V{bottom}\" stroke=\"#ddd\"/>");
            text(svg, &x, bottom + 16.0, "middle", &name);
        }
    }
}

/// A panel: its box in pixels; the decades of time from its left edge, and of the error from its top.
struct Panel {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    times: [i32; 2],
    errors: [i32; 2],
}

/// Closing and force: 100 ns to 100 s, 1000 % to 0.1 %.
const CLOSING: Panel =
    Panel { left: 70.0, top: 40.0, width: 405.0, height: 360.0, times: [-7, 2], errors: [1, -3] };
const FORCE: Panel = Panel { left: 520.0, ..CLOSING };

impl Panel {
    fn x(&self, time: f64) -> f64 {
        let [first, last] = self.times.map(f64::from);
        self.left + (libm::log10(time.max(1e-9)) - first) / (last - first) * self.width
    }

    fn y(&self, error: f64) -> f64 {
        let [first, last] = self.errors.map(f64::from);
        self.top + (first - libm::log10(error).clamp(last, first)) / (first - last) * self.height
    }

    fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Lines at every second decade of time, and at each of `errors` with its name.
    fn axes(&self, svg: &mut String, errors: impl Iterator<Item = (i32, String)>) {
        let Self { left: left_edge, top, width, .. } = self;
        let bottom = self.bottom();
        for decade in (self.times[0]..=self.times[1]).step_by(2) {
            let x = format!("{:.1}", self.x(10_f64.powi(decade)));
            let _ = writeln!(svg, "<path d=\"M{x} {top}V{bottom}\" stroke=\"#ddd\"/>");
            text(svg, &x, bottom + 18.0, "middle", &format!("1e{decade} s"));
        }
        for (decade, name) in errors {
            let y = self.y(10_f64.powi(decade));
            let _ = writeln!(svg, "<path d=\"M{left_edge} {y:.1}h{width}\" stroke=\"#ddd\"/>");
            text(svg, left_edge - 8.0, format!("{:.1}", y + 4.0), "end", &name);
        }
    }
}

/// A line of text.
fn text(svg: &mut String, x: impl std::fmt::Display, y: impl std::fmt::Display, anchor: &str, words: &str) {
    let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{words}</text>");
}

/// A heading.
fn title(svg: &mut String, y: f64, words: &str) {
    let _ =
        writeln!(svg, "<text x=\"{NAMES}\" y=\"{y}\" font-size=\"15\" font-weight=\"bold\">{words}</text>");
}

fn dot(svg: &mut String, [x, y]: [f64; 2], colour: &str) {
    let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>");
}

/// The beginning of a picture.
fn head([width, height]: [u32; 2]) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    )
}

/// Whether `text` begins as one of these pictures.
pub fn is_picture(text: &str) -> bool {
    [CHOICE, SHELLS].iter().chain(&EARLIER).any(|size| text.starts_with(&head(*size)))
}

/// One model against the shells, over all pressures: its cost, s, and the roots of the mean square errors of the three questions.
struct ModelMark<'a> {
    model: &'a str,
    time: f64,
    errors: [f64; 3],
}

/// Every model of `rows`, the cheapest first.
fn choices(rows: &[ShellRow]) -> Vec<ModelMark<'_>> {
    let mut models: Vec<&str> = rows.iter().map(|row| row.model.as_str()).collect();
    models.dedup();
    let mut choices: Vec<ModelMark<'_>> = models
        .into_iter()
        .map(|model| {
            let alike: Vec<&ShellRow> =
                rows.iter().filter(|row| row.model == model && !row.stars.is_empty()).collect();
            let times: Vec<f64> = alike.iter().map(|row| row.time).collect();
            let errors =
                ANSWERS.map(|(_, errors)| rms(alike.iter().flat_map(|row| &row.stars).filter_map(errors)));
            ModelMark { model, time: mean(&times), errors }
        })
        .collect();
    sort_by(&mut choices, |a, b| a.time.total_cmp(&b.time));
    choices
}

/// The choice of a model: a row a model, the cheapest first, with its error of each question; below it the errors of the limits against the
/// exact ring, a row a limit.
pub fn of_choice(rows: &[ShellRow], limits: &[TradeRow]) -> String {
    let mut svg = head(CHOICE);
    title(&mut svg, 26.0, "Which model for which question? Take the first row whose error is small enough.");
    text(
        &mut svg,
        NAMES,
        48,
        "start",
        "Errors against the finest shells of the paper's stars at 14, 37 and 60 kPa, root of the mean square.",
    );
    text(&mut svg, NAMES, CHOICE_TOP - 20.0, "start", "model");
    text(&mut svg, TIMES, CHOICE_TOP - 20.0, "end", "cost of a star");
    let by_cost = choices(rows);
    let count = u8::try_from(by_cost.len()).unwrap_or(u8::MAX);
    for (axis, (words, _)) in QUESTIONS.iter().zip(ANSWERS) {
        let names = ["0.1 %", "1 %", "10 %", "100 %", "1000 %"].map(str::to_owned);
        axis.lines(&mut svg, CHOICE_TOP - 10.0, count, (-3..).zip(names));
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\" font-weight=\"bold\">{words}</text>",
            axis.left + axis.width / 2.0,
            CHOICE_TOP - 20.0
        );
    }
    for ((choice, colour), place) in by_cost.iter().zip(COLOURS).zip(0_u8..) {
        let y = CHOICE_TOP + ROW * f64::from(place);
        row(&mut svg, y, choice.model, choice.time);
        for (axis, error) in QUESTIONS.iter().zip(choice.errors) {
            let x = axis.x(error);
            dot(&mut svg, [x, y], colour);
            text(&mut svg, format!("{:.1}", x + 8.0), y + 4.0, "start", &percent(error));
        }
    }
    let bottom = CHOICE_TOP + ROW * f64::from(count);
    let notes = [
        format!("{}.", shown::sources(rows)),
        "section was fitted to these stars: docs/ranges.md has its errors on others. shell, fine: its own mesh errors.".to_owned(),
    ];
    for (note, line) in notes.iter().zip(0_u8..) {
        text(&mut svg, NAMES, bottom + 32.0 + 18.0 * f64::from(line), "start", note);
    }
    add_limits(&mut svg, limits);
    svg + "</svg>\n"
}

/// Name and time of a row.
fn row(svg: &mut String, y: f64, model: &str, time: f64) {
    text(svg, NAMES, y + 4.0, "start", model);
    text(svg, TIMES, y + 4.0, "end", shown::time(time).trim_end());
}

/// An error for people: two digits.
fn percent(error: f64) -> String {
    let percent = 100.0 * error;
    if percent < 10.0 { format!("{percent:.1} %") } else { format!("{percent:.0} %") }
}

/// The errors of the limits of high pressure against the exact ring.
fn add_limits(svg: &mut String, rows: &[TradeRow]) {
    title(svg, RING_TOP - 58.0, "The limits of high pressure against the exact ring");
    text(svg, NAMES, RING_TOP - 20.0, "start", "limit");
    text(svg, TIMES, RING_TOP - 20.0, "end", "time of one hinge");
    for ((quantity, colour), place) in QUANTITIES.iter().zip(QUANTITY_COLOURS).zip(0_u8..) {
        let x = RING.left + 100.0 * f64::from(place);
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{}\" width=\"8\" height=\"8\" fill=\"{colour}\"/>",
            RING_TOP - 28.0
        );
        text(svg, x + 12.0, RING_TOP - 20.0, "start", quantity);
    }
    let count = u8::try_from(rows.len()).unwrap_or(u8::MAX);
    let names = (-16..=0).step_by(4).map(|decade| (decade, format!("1e{decade}")));
    RING.lines(svg, RING_TOP - 10.0, count, names);
    for (limit, place) in rows.iter().zip(0_u8..) {
        let y = RING_TOP + ROW * f64::from(place);
        row(svg, y, &limit.model, limit.time);
        for (error, colour) in limit.errors.iter().zip(QUANTITY_COLOURS) {
            if let Some(error) = error {
                dot(svg, [RING.x(*error), y], colour);
            }
        }
    }
}

/// The errors of every model against the shells, the root of the mean square over the stars: a circle a pressure, a panel for closing
/// and one for force.
pub fn against_shells(rows: &[ShellRow]) -> String {
    let mut svg = head(SHELLS);
    let names = ["0.1 %", "1 %", "10 %", "100 %", "1000 %"].map(str::to_owned);
    for (panel, title) in [(CLOSING, "closing: rho_f"), (FORCE, "force on an object")] {
        panel.axes(&mut svg, (-3..).zip(names.clone()));
        text(&mut svg, panel.left + panel.width / 2.0, panel.top - 12.0, "middle", title);
    }
    let mut models: Vec<&str> = rows.iter().map(|row| row.model.as_str()).collect();
    models.dedup();
    let sized = rows.iter().zip([3.0, 4.0, 5.0].into_iter().cycle());
    for (row, radius) in sized.filter(|(row, _)| row.time > 0.0 && !row.stars.is_empty()) {
        let place = models.iter().position(|model| *model == row.model).unwrap_or(0);
        let colour = COLOURS[place % COLOURS.len()];
        let closing = rms(row.stars.iter().map(|star| star.radius));
        let force = rms(row.stars.iter().filter_map(|star| star.force));
        for (panel, error) in [(CLOSING, closing), (FORCE, force)] {
            let (cx, cy) = (panel.x(row.time), panel.y(error));
            let _ = writeln!(
                svg,
                "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{radius}\" fill=\"{colour}\" fill-opacity=\"0.8\"/>"
            );
        }
    }
    for ((model, colour), place) in models.iter().zip(COLOURS).zip(0_u8..) {
        let y = CLOSING.top + 20.0 * f64::from(place) + 20.0;
        let _ =
            writeln!(svg, "<rect x=\"946\" y=\"{}\" width=\"8\" height=\"8\" fill=\"{colour}\"/>", y - 8.0);
        let _ = writeln!(svg, "<text x=\"960\" y=\"{y}\">{model}</text>");
    }
    let caption = "time of a star; circles of rising size: 14, 37, 60 kPa; of shell, fine its own mesh error";
    text(&mut svg, 500, CLOSING.bottom() + 45.0, "middle", caption);
    svg + "</svg>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trade::shells::against_shells as compared;

    /// A label of a picture: its ends along x, and its base line, pixels.
    struct Label<'a> {
        ends: [f64; 2],
        base: f64,
        words: &'a str,
    }

    fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
        line.split_once(&format!(" {name}=\""))?.1.split('"').next()
    }

    fn number(line: &str, name: &str) -> Option<f64> {
        attribute(line, name)?.parse().ok()
    }

    /// The label that `line` writes, as wide as a wide font makes it.
    fn label(line: &str) -> Option<Label<'_>> {
        let words = line.split_once('>')?.1.strip_suffix("</text>")?;
        let size = number(line, "font-size").unwrap_or(12.0);
        let width = 0.58 * size * f64::from(u32::try_from(words.chars().count()).ok()?);
        let offset = match attribute(line, "text-anchor") {
            Some("middle") => width / 2.0,
            Some("end") => width,
            _ => 0.0,
        };
        let x = number(line, "x")?;
        Some(Label { ends: [x - offset, x - offset + width], base: number(line, "y")?, words })
    }

    #[test]
    fn every_label_lies_inside_its_picture_and_beside_the_others() {
        let limit = TradeRow { model: "bvp, beta = 100000".to_owned(), time: 0.123, errors: [Some(0.5); 5] };
        let limits = vec![limit; 7];
        let rows = compared(&|| 0.0).expect("all models answer");
        for (picture, size) in [(of_choice(&rows, &limits), CHOICE), (against_shells(&rows), SHELLS)] {
            assert!(is_picture(&picture));
            let [width, height] = size.map(f64::from);
            let lines = picture.lines().filter(|line| line.starts_with("<text"));
            let labels: Vec<Label<'_>> = lines.map(|line| label(line).expect(line)).collect();
            assert!(labels.len() > 20);
            for (index, label) in labels.iter().enumerate() {
                assert!(label.ends[0] >= 0.0 && label.ends[1] <= width, "{} {:?}", label.words, label.ends);
                assert!(label.base >= 12.0 && label.base <= height - 3.0, "{}", label.words);
                for other in &labels[index + 1..] {
                    let is_clear = (label.base - other.base).abs() >= 10.0
                        || label.ends[1] <= other.ends[0]
                        || other.ends[1] <= label.ends[0];
                    assert!(is_clear, "{} over {}", label.words, other.words);
                }
            }
        }
    }
}
