//! Error against time at the pressures of a gripper: every model and the shells, a panel for closing and one for force.

use crate::forecast::trade::shells::{ShellRow, rms};
use std::fmt::Write;

/// Pixels: left edges of the panels, their top, width and height.
const LEFT: [f64; 2] = [70.0, 520.0];
const TOP: f64 = 40.0;
const WIDTH: f64 = 405.0;
const HEIGHT: f64 = 360.0;
/// Decades shown: 100 ns to 100 s, 0.1 % to 1000 %.
const DECADES: [f64; 2] = [9.0, 4.0];
/// Colours, one a model.
const COLOURS: [&str; 8] =
    ["#b7791f", "#1b6ca8", "#8e44ad", "#c0392b", "#e67e22", "#7fb3a0", "#27865c", "#0b3d2e"];

fn x(panel: usize, time: f64) -> f64 {
    LEFT[panel] + (libm::log10(time.clamp(1e-7, 1e2)) + 7.0) / DECADES[0] * WIDTH
}

fn y(error: f64) -> f64 {
    TOP + (1.0 - libm::log10(error.clamp(1e-3, 1e1))) / DECADES[1] * HEIGHT
}

/// The rows as a plot: the root of the mean square over the stars against time, a circle a pressure.
pub fn picture(rows: &[ShellRow]) -> String {
    let mut out = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1090 480\" width=\"1090\" height=\"480\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"1090\" height=\"480\" fill=\"white\"/>\n",
    );
    for (panel, title) in ["closing: rho_f", "force on an object"].into_iter().enumerate() {
        axes(&mut out, panel, title);
    }
    let mut models: Vec<&str> = rows.iter().map(|row| row.model.as_str()).collect();
    models.dedup();
    let sized = rows.iter().zip([3.0, 4.0, 5.0].into_iter().cycle());
    for (row, radius) in sized.filter(|(row, _)| row.time > 0.0 && !row.stars.is_empty()) {
        let place = models.iter().position(|model| *model == row.model).unwrap_or(0);
        let colour = COLOURS[place % COLOURS.len()];
        let errors = [
            rms(row.stars.iter().map(|star| star.radius)),
            rms(row.stars.iter().filter_map(|star| star.force)),
        ];
        for (panel, error) in errors.into_iter().enumerate() {
            let (cx, cy) = (x(panel, row.time), y(error));
            let _ = writeln!(
                out,
                "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{radius}\" fill=\"{colour}\" fill-opacity=\"0.8\"/>"
            );
        }
    }
    for ((model, colour), place) in models.iter().zip(COLOURS).zip(0_u8..) {
        let at = TOP + 20.0 * f64::from(place) + 20.0;
        let _ =
            writeln!(out, "<rect x=\"946\" y=\"{}\" width=\"8\" height=\"8\" fill=\"{colour}\"/>", at - 8.0);
        let _ = writeln!(out, "<text x=\"960\" y=\"{at}\">{model}</text>");
    }
    let below = TOP + HEIGHT + 45.0;
    let _ = writeln!(
        out,
        "<text x=\"500\" y=\"{below}\" text-anchor=\"middle\">time of a star; circles of rising size: 14, 37, 60 kPa; \
         of shell, fine its own mesh error</text>"
    );
    out.push_str("</svg>\n");
    out
}

fn axes(out: &mut String, panel: usize, title: &str) {
    let bottom = TOP + HEIGHT;
    for decade in (-7..=1).step_by(2) {
        let at = x(panel, 10_f64.powi(decade));
        let _ = writeln!(out, "<path d=\"M{at:.1} {TOP}V{bottom}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            out,
            "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">1e{decade} s</text>",
            bottom + 18.0
        );
    }
    for (error, name) in [(1e-3, "0.1 %"), (1e-2, "1 %"), (1e-1, "10 %"), (1.0, "100 %"), (1e1, "1000 %")] {
        let (at, left) = (y(error), LEFT[panel]);
        let _ = writeln!(out, "<path d=\"M{left} {at:.1}h{WIDTH}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>",
            left - 8.0,
            at + 4.0
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{title}</text>",
        LEFT[panel] + WIDTH / 2.0,
        TOP - 12.0
    );
}
