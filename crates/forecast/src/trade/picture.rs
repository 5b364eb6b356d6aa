//! Error against time, both logarithmic: the limits against the exact ring, and every model against the shells.

use crate::trade::shells::{ShellRow, rms};
use crate::trade::{QUANTITIES, TradeRow};
use std::fmt::Write;

/// Widths of the pictures, pixels.
const RING_WIDTH: u32 = 860;
const SHELLS_WIDTH: u32 = 1090;
/// Colours, one a model.
const COLOURS: [&str; 8] =
    ["#b7791f", "#1b6ca8", "#8e44ad", "#c0392b", "#e67e22", "#7fb3a0", "#27865c", "#0b3d2e"];

/// A panel: its box in pixels; the decades of time from its left edge, and of the error from its top.
struct Panel {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    times: [i32; 2],
    errors: [i32; 2],
}

/// The limits: 10 ns to 1 s, 1 to 1e-16.
const RING: Panel =
    Panel { left: 70.0, top: 30.0, width: 640.0, height: 400.0, times: [-8, 0], errors: [0, -16] };
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
    fn axes(&self, out: &mut String, errors: impl Iterator<Item = (i32, String)>) {
        let Self { left, top, width, .. } = self;
        let bottom = self.bottom();
        for decade in (self.times[0]..=self.times[1]).step_by(2) {
            let at = format!("{:.1}", self.x(10_f64.powi(decade)));
            let _ = writeln!(out, "<path d=\"M{at} {top}V{bottom}\" stroke=\"#ddd\"/>");
            text(out, &at, bottom + 18.0, "middle", &format!("1e{decade} s"));
        }
        for (decade, name) in errors {
            let at = self.y(10_f64.powi(decade));
            let _ = writeln!(out, "<path d=\"M{left} {at:.1}h{width}\" stroke=\"#ddd\"/>");
            text(out, left - 8.0, format!("{:.1}", at + 4.0), "end", &name);
        }
    }
}

/// A line of text.
fn text(out: &mut String, x: impl std::fmt::Display, y: impl std::fmt::Display, anchor: &str, words: &str) {
    let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{words}</text>");
}

/// The beginning of a picture `width` pixels wide.
fn head(width: u32) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} 480\" width=\"{width}\" height=\"480\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"480\" fill=\"white\"/>\n"
    )
}

/// Whether `text` begins as one of these pictures.
pub fn is_picture(text: &str) -> bool {
    [RING_WIDTH, SHELLS_WIDTH].iter().any(|width| text.starts_with(&head(*width)))
}

/// The errors of the limits against the exact ring.
pub fn against_ring(rows: &[TradeRow]) -> String {
    let colours = ["#1b6ca8", "#c0392b", "#27865c", "#8e44ad", "#b7791f"];
    let mut out = head(RING_WIDTH);
    RING.axes(&mut out, (-16..=0).step_by(4).map(|decade| (decade, format!("1e{decade}"))));
    for row in rows {
        let x = RING.x(row.time);
        for (error, colour) in row.errors.iter().zip(colours) {
            if let Some(error) = error {
                let y = RING.y(*error);
                let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>");
            }
        }
        let above = RING.top - 6.0;
        let _ = writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{above}\" text-anchor=\"start\" transform=\"rotate(-50 {x:.1} {above})\">{}</text>",
            row.model
        );
    }
    for ((quantity, colour), i) in QUANTITIES.iter().zip(colours).zip(0_u8..) {
        let at = RING.top + 20.0 * f64::from(i) + 20.0;
        let _ = writeln!(out, "<circle cx=\"730\" cy=\"{}\" r=\"4\" fill=\"{colour}\"/>", at - 4.0);
        let _ = writeln!(out, "<text x=\"740\" y=\"{at}\">{quantity}</text>");
    }
    text(&mut out, 390, 475, "middle", "time of one hinge's target");
    out + "</svg>\n"
}

/// The errors of every model against the shells, the root of the mean square over the stars: a circle a pressure, a panel for closing
/// and one for force.
pub fn against_shells(rows: &[ShellRow]) -> String {
    let mut out = head(SHELLS_WIDTH);
    let names = ["0.1 %", "1 %", "10 %", "100 %", "1000 %"].map(str::to_owned);
    for (panel, title) in [(CLOSING, "closing: rho_f"), (FORCE, "force on an object")] {
        panel.axes(&mut out, (-3..).zip(names.clone()));
        text(&mut out, panel.left + panel.width / 2.0, panel.top - 12.0, "middle", title);
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
                out,
                "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{radius}\" fill=\"{colour}\" fill-opacity=\"0.8\"/>"
            );
        }
    }
    for ((model, colour), place) in models.iter().zip(COLOURS).zip(0_u8..) {
        let at = CLOSING.top + 20.0 * f64::from(place) + 20.0;
        let _ =
            writeln!(out, "<rect x=\"946\" y=\"{}\" width=\"8\" height=\"8\" fill=\"{colour}\"/>", at - 8.0);
        let _ = writeln!(out, "<text x=\"960\" y=\"{at}\">{model}</text>");
    }
    let about = "time of a star; circles of rising size: 14, 37, 60 kPa; of shell, fine its own mesh error";
    text(&mut out, 500, CLOSING.bottom() + 45.0, "middle", about);
    out + "</svg>\n"
}
