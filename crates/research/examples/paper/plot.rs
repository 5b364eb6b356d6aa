//! A plot as an SVG: lines, points with their errors, bands. The same bytes on every machine.
//!
//! The plot of `stargrip-cam trade` has fixed logarithmic axes and circles, and no lines; this one takes any.

use std::fmt::Write;

/// Colours of series, by number.
pub(crate) const COLOURS: [&str; 5] = ["#1b6ca8", "#c0392b", "#27865c", "#8e44ad", "#b7791f"];
/// Colour of limits and published numbers.
pub(crate) const GREY: &str = "#777";

/// The frame of the curves in the picture: left, top, width, height.
const FRAME: [f64; 4] = [62.0, 16.0, 420.0, 300.0];

/// One axis.
pub(crate) struct Axis {
    /// The quantity, with its unit.
    pub(crate) name: &'static str,
    /// Both ends.
    pub(crate) ends: [f64; 2],
    /// Values of the labelled ticks.
    pub(crate) ticks: Vec<f64>,
    /// Whether it is logarithmic.
    pub(crate) is_log: bool,
}

impl Axis {
    /// An even axis with a number every `step`.
    pub(crate) fn even(name: &'static str, ends: [f64; 2], step: f64) -> Self {
        let count = ((ends[1] - ends[0]) / step).round();
        let ticks = (0..).map(f64::from).take_while(|k| *k <= count).map(|k| ends[0] + k * step);
        Self { name, ends, ticks: ticks.collect(), is_log: false }
    }

    /// Position of `value` on it, from 0 to 1.
    fn part(&self, value: f64) -> f64 {
        let by = |value: f64| if self.is_log { value.log10() } else { value };
        (by(value) - by(self.ends[0])) / (by(self.ends[1]) - by(self.ends[0]))
    }
}

/// The style of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Look {
    /// A thick line.
    Line,
    /// A thin line.
    Thin,
    /// A thin line of dashes.
    Dashed,
    /// Discs, with error bars.
    Discs,
    /// Rings.
    Rings,
}

/// One series: x, y, and the lower and upper end of y.
pub(crate) struct Series {
    /// Its name in the key; empty if another series has it.
    pub(crate) name: String,
    /// Its colour.
    pub(crate) colour: &'static str,
    /// Its style.
    pub(crate) look: Look,
    /// Its points; a line's ends are a band, a disc's a bar.
    pub(crate) points: Vec<(f64, f64, Option<[f64; 2]>)>,
}

/// A plot.
pub(crate) struct Plot {
    /// The alternative text, for readers who cannot see the picture.
    pub(crate) title: &'static str,
    /// The horizontal axis.
    pub(crate) x: Axis,
    /// The vertical axis.
    pub(crate) y: Axis,
    /// In the order in which they are drawn.
    pub(crate) series: Vec<Series>,
}

impl Plot {
    /// The picture.
    pub(crate) fn svg(&self) -> String {
        let [left, top, width, height] = FRAME;
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 366\" width=\"720\" height=\"366\" font-family=\"sans-serif\" \
             font-size=\"12\">\n<title>{}</title>\n<rect width=\"720\" height=\"366\" fill=\"white\"/>\n<clipPath id=\"frame\"><rect \
             x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n",
            self.title
        );
        self.axes(&mut out);
        out.push_str("<g clip-path=\"url(#frame)\">\n");
        self.series.iter().for_each(|series| self.draw(&mut out, series));
        out.push_str("</g>\n");
        let named = self.series.iter().filter(|series| !series.name.is_empty());
        for (series, k) in named.zip(0_u8..) {
            let y = top + 10.0 + 19.0 * f64::from(k);
            key(&mut out, series, [left + width + 14.0, y]);
        }
        out + "</svg>\n"
    }

    /// A place in the picture.
    fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, width, height] = FRAME;
        [left + width * self.x.part(x), top + height * (1.0 - self.y.part(y))]
    }

    fn axes(&self, out: &mut String) {
        let [left, top, width, height] = FRAME;
        let bottom = top + height;
        for tick in &self.x.ticks {
            let x = left + width * self.x.part(*tick);
            let _ = writeln!(out, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#e4e4e4\"/>");
            let _ = writeln!(
                out,
                "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{tick}</text>",
                bottom + 17.0
            );
        }
        for tick in &self.y.ticks {
            let y = top + height * (1.0 - self.y.part(*tick));
            let tick = (1e6 * tick).round() / 1e6;
            let _ = writeln!(out, "<path d=\"M{left} {y:.1}h{width}\" stroke=\"#e4e4e4\"/>");
            let _ = writeln!(
                out,
                "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{tick}</text>",
                left - 7.0,
                y + 4.0
            );
        }
        let _ = writeln!(
            out,
            "<path d=\"M{left} {top}V{bottom}h{width}\" fill=\"none\" stroke=\"#333\"/>\n<text x=\"{}\" y=\"{}\" \
             text-anchor=\"middle\">{}</text>\n<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            left + width / 2.0,
            bottom + 38.0,
            self.x.name,
            top + height / 2.0,
            self.y.name
        );
    }

    fn draw(&self, out: &mut String, Series { colour, look, points, .. }: &Series) {
        match look {
            Look::Line | Look::Thin | Look::Dashed => {
                let ends =
                    |end: usize| points.iter().filter_map(move |(x, _, ends)| Some((*x, (*ends)?[end])));
                let band: Vec<(f64, f64)> =
                    ends(0).chain(ends(1).collect::<Vec<_>>().into_iter().rev()).collect();
                if !band.is_empty() {
                    let path = self.path(&band);
                    let _ = writeln!(out, "<path d=\"{path}Z\" fill=\"{colour}\" fill-opacity=\"0.16\"/>");
                }
                let line: Vec<(f64, f64)> = points.iter().map(|(x, y, _)| (*x, *y)).collect();
                let stroke = stroke(*look);
                let path = self.path(&line);
                let _ = writeln!(out, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" {stroke}/>");
            }
            Look::Discs | Look::Rings => {
                for (x, y, ends) in points {
                    if let Some([low, high]) = ends {
                        let ([at, bottom], [_, top]) = (self.at(*x, *low), self.at(*x, *high));
                        let _ = writeln!(
                            out,
                            "<path d=\"M{at:.1} {bottom:.1}V{top:.1}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>"
                        );
                    }
                    disc(out, *look, colour, self.at(*x, *y));
                }
            }
        }
    }

    fn path(&self, points: &[(f64, f64)]) -> String {
        let places = points.iter().map(|(x, y)| self.at(*x, *y));
        let words = places.map(|[x, y]| format!("{x:.1} {y:.1}")).collect::<Vec<_>>();
        format!("M{}", words.join("L"))
    }
}

fn stroke(look: Look) -> &'static str {
    match look {
        Look::Line => "stroke-width=\"2\"",
        Look::Dashed => "stroke-width=\"1.2\" stroke-dasharray=\"5 4\"",
        _ => "stroke-width=\"1.2\"",
    }
}

fn disc(out: &mut String, look: Look, colour: &str, [x, y]: [f64; 2]) {
    let fill = if look == Look::Discs { colour } else { "white" };
    let _ = writeln!(
        out,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.2\"/>"
    );
}

/// One line of the key, its middle at `y`.
fn key(out: &mut String, series: &Series, [x, y]: [f64; 2]) {
    match series.look {
        Look::Discs | Look::Rings => disc(out, series.look, series.colour, [x + 11.0, y]),
        look => {
            if series.points.iter().any(|(_, _, ends)| ends.is_some()) {
                let colour = series.colour;
                let _ = writeln!(
                    out,
                    "<rect x=\"{x}\" y=\"{}\" width=\"22\" height=\"10\" fill=\"{colour}\" fill-opacity=\"0.16\"/>",
                    y - 5.0
                );
            }
            let (colour, stroke) = (series.colour, stroke(look));
            let _ = writeln!(out, "<path d=\"M{x} {y}h22\" stroke=\"{colour}\" {stroke}/>");
        }
    }
    let _ = writeln!(out, "<text x=\"{}\" y=\"{}\">{}</text>", x + 29.0, y + 4.0, series.name);
}
