//! A drawing with its faults, numbered, and the list of them.

use crate::emit::picture::{Group, Picture, Text};
use crate::emit::preview::block::{Block, flow};
use crate::emit::preview::style::{CUT, GREY, PAGE, Style, circle, straight};
use geom::{Bounds, Path, Point, Vec2};
use program::text::shortened;
use spec::NAME_LENGTH;

/// Characters a line of the legend.
const LINE: usize = 110;

/// The text without the special characters of XML and those that may have no glyph.
fn legible(text: &str) -> String {
    let legible = text.chars().map(|c| match c {
        '<' | '>' | '&' => '_',
        ' ' => ' ',
        _ if c.is_ascii_graphic() => c,
        _ => '_',
    });
    legible.collect()
}

/// A fault, with its place if that is known.
pub struct FaultMark {
    /// In the frame of the drawing, mm.
    pub at: Option<Point>,
    /// The fault and the remedy.
    pub text: String,
}

/// Beginning of the picture's title.
const TITLE: &str = "check: ";

/// Whether `text` begins as a picture that [`faults`] made.
pub fn is_faults(text: &str) -> bool {
    text.starts_with("<svg ") && text.contains(&format!("<title>{TITLE}"))
}

/// `figures` with `faults` over it, as an SVG at 1:1.
pub fn faults(title: &str, figures: &[Path], faults: &[FaultMark]) -> String {
    let places = Bounds::of_points(faults.iter().filter_map(|fault| fault.at));
    let bounds = figures.iter().map(Path::bounds).fold(places, Bounds::union);
    let bounds = if bounds.width() >= 0.0 { bounds } else { Bounds::of_points([Point::ORIGIN]).outset(50.0) };
    let style = Style::new(bounds.width().max(bounds.height()).max(10.0) * 1.2);
    let unit = style.unit;
    let (mut lines, mut marks, mut words) =
        (Group::new("drawing"), Group::new("faults"), Group::new("words"));
    for path in figures {
        lines.line(path.clone(), style.pen(GREY, 1.5));
    }
    let number = match faults.len() {
        0 => "nothing found".to_owned(),
        1 => "1 finding".to_owned(),
        number => format!("{number} findings"),
    };
    let mut legend = Block::new(format!("{}: {number}", shortened(title, NAME_LENGTH)));
    for (number, fault) in (1..).zip(faults) {
        let mut rest = format!("{number}  {}", fault.text);
        while !rest.is_empty() {
            let longest = rest.char_indices().nth(LINE).map_or(rest.len(), |(at, _)| at);
            let end = if longest < rest.len() {
                rest[..longest].rfind(' ').filter(|at| *at > 0).unwrap_or(longest)
            } else {
                longest
            };
            legend.say(legible(&rest[..end]));
            let remainder = rest[end..].trim_start();
            rest = if remainder.is_empty() { String::new() } else { format!("     {remainder}") };
        }
        let Some(place) = fault.at else { continue };
        // Faults at one place keep their numbers apart.
        let earlier_here = faults[..number - 1]
            .iter()
            .filter(|other| other.at.is_some_and(|other| other.distance(place) < unit))
            .count();
        #[expect(clippy::cast_precision_loss, reason = "a few faults")]
        let label_place = place + Vec2::new(1.6 * unit * (1.0 + earlier_here as f64), 1.6 * unit);
        marks.line(circle(place, 0.8 * unit), style.pen(CUT, 3.0));
        marks.line(straight(place, label_place), style.pen(CUT, 1.0));
        words.text(Text::centered(
            label_place + Vec2::new(0.5 * unit, 0.5 * unit),
            unit,
            CUT,
            number.to_string(),
        ));
    }
    let view = bounds.outset(4.0 * unit);
    let mut legend_group = Group::new("legend");
    let width = view.width().max(legend.width(style) + 4.0 * unit);
    let height =
        flow(&mut legend_group, &[legend], Point::new(view.min.x + 2.0 * unit, view.min.y), width, style);
    let window = Bounds {
        min: Point::new(view.min.x, view.min.y - height - 2.0 * unit),
        max: Point::new(view.min.x + width, view.max.y),
    };
    let mut page = Group::new("page");
    page.area(vec![Path::rectangle(&window)], PAGE);
    let groups = vec![page, lines, marks, words, legend_group];
    Picture { title: format!("{TITLE}{title}"), window, top: bounds.max.y, groups }.svg()
}
