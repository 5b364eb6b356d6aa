//! The `d` attribute of an SVG path: absolute `M L H V A Z`, in user units, Y down.

use crate::verify::finding::quote;
use crate::verify::read::drawing::{JOIN, PathPen};
use crate::verify::read::number::{self, Number};
use crate::verify::{Finding, FindingCode};
use geom::{Arc, Line, Path, Point, Segment};

/// The subpaths of `d`; a fault drops the rest.
pub(super) fn parse(d: &str) -> (Vec<Path>, Option<Finding>) {
    let mut pen = PathPen::default();
    let fault = draw(&mut PathScan { rest: d }, &mut pen).err();
    pen.lift(false);
    (pen.paths, fault)
}

/// Draws the commands of `scan` with `pen`, until the data end.
///
/// Only absolute commands of lines and circular arcs are allowed. A second pair of numbers after `M` is a line, as SVG has it.
fn draw(scan: &mut PathScan<'_>, pen: &mut PathPen) -> Result<(), Finding> {
    while let Some(command) = scan.command()? {
        if command == 'Z' {
            check_begun(pen)?;
            pen.close(JOIN);
            continue;
        }
        let mut first = true;
        // A command letter applies to all sets of numbers that follow it.
        while first || scan.has_number() {
            match command {
                'M' if first => pen.begin(scan.point()?),
                'M' | 'L' => line(pen, scan.point()?)?,
                'H' => line(pen, Point::new(scan.number()?, pen.here.y))?,
                'V' => line(pen, Point::new(pen.here.x, scan.number()?))?,
                'A' => {
                    let (rx, ry, turned) = (scan.radius()?, scan.radius()?, scan.number()?);
                    if turned != 0.0 {
                        let fault = format!("an arc turned by {turned} deg");
                        return Err(Finding::new(
                            FindingCode::BadArc,
                            fault,
                            "0, as a circle needs no turning",
                        ));
                    }
                    let (large, sweep, end) = (scan.flag()?, scan.flag()?, scan.point()?);
                    if rx != ry {
                        let fault = format!("an ellipse with radii {rx} and {ry}");
                        return Err(Finding::new(FindingCode::BadArc, fault, "circular arcs"));
                    }
                    if let Some(segment) = arc(pen.here, end, rx.abs(), large, sweep) {
                        check_begun(pen)?;
                        pen.push(segment, end);
                    }
                }
                _ => {
                    let fault = format!("path command {command}");
                    return Err(Finding::new(FindingCode::UnknownWord, fault, ALLOWED));
                }
            }
            first = false;
        }
    }
    Ok(())
}

/// Checks that a path has begun.
fn check_begun(pen: &PathPen) -> Result<(), Finding> {
    let fault = || Finding::new(FindingCode::BadPath, "a path that does not begin with M", ALLOWED);
    pen.start.map(|_| ()).ok_or_else(fault)
}

fn line(pen: &mut PathPen, end: Point) -> Result<(), Finding> {
    check_begun(pen)?;
    pen.push(Line::new(pen.here, end), end);
    Ok(())
}

const ALLOWED: &str = "M L H V A Z, absolute";

/// The rest of the text.
struct PathScan<'a> {
    rest: &'a str,
}

impl<'a> PathScan<'a> {
    fn skip(&mut self, comma: bool) {
        let blank = |c: char| matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{c}');
        self.rest = self.rest.trim_start_matches(blank);
        if comma {
            self.rest = self.rest.strip_prefix(',').unwrap_or(self.rest).trim_start_matches(blank);
        }
    }

    fn command(&mut self) -> Result<Option<char>, Finding> {
        self.skip(false);
        let Some(c) = self.rest.chars().next() else { return Ok(None) };
        if !c.is_ascii_alphabetic() {
            return Err(self.fault("a path command"));
        }
        self.rest = &self.rest[1..];
        self.skip(false);
        Ok(Some(c))
    }

    fn has_number(&self) -> bool {
        number::read(self.rest, true).is_some()
    }

    fn number(&mut self) -> Result<f64, Finding> {
        let number = self.next_number()?;
        self.pass(number.rest, number.text, number.value)
    }

    fn radius(&mut self) -> Result<f64, Finding> {
        let number = self.next_number()?;
        self.pass(number.rest, number.text, number.radius())
    }

    fn next_number(&self) -> Result<Number<'a>, Finding> {
        number::read(self.rest, true).ok_or_else(|| self.fault("a number"))
    }

    /// The `value` of a number's `text`, with the path read on from its `rest`; `None` is a value beyond the limit.
    fn pass(&mut self, rest: &'a str, text: &str, value: Option<f64>) -> Result<f64, Finding> {
        let value = value.ok_or_else(|| {
            Finding::new(FindingCode::BadNumber, quote(text), format!("at most {}", number::LARGEST))
        })?;
        self.rest = rest;
        self.skip(true);
        Ok(value)
    }

    fn point(&mut self) -> Result<Point, Finding> {
        Ok(Point::new(self.number()?, self.number()?))
    }

    /// A flag is one digit, and need not be set off from the next word.
    fn flag(&mut self) -> Result<bool, Finding> {
        let flag = match self.rest.as_bytes().first() {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err(self.fault("a flag 0 or 1")),
        };
        self.rest = &self.rest[1..];
        self.skip(true);
        Ok(flag)
    }

    fn fault(&self, allowed: &str) -> Finding {
        Finding::new(FindingCode::BadPath, quote(self.rest), allowed)
    }
}

/// From end points to centre: SVG 1.1, appendix F.6.5 and F.6.6, for equal radii.
///
/// A radius below half the chord is scaled up to it; a radius 0 gives a line, equal end points nothing.
fn arc(from: Point, to: Point, radius: f64, large: bool, sweep: bool) -> Option<Segment> {
    let chord = to - from;
    let half = 0.5 * chord.length();
    if half == 0.0 {
        return None;
    }
    if radius == 0.0 {
        return Some(Line::new(from, to).into());
    }
    let r = radius.max(half);
    // Factored, so that it stays exact for arcs near 180 degrees, where the difference of the squares cancels.
    let apothem = ((r - half) * (r + half)).sqrt();
    let offset = if large == sweep { -apothem } else { apothem };
    let center = from.midpoint(to) + chord.perp() * (offset / (2.0 * half));
    let angle = 2.0 * libm::atan2(half, apothem);
    let turn = if large { std::f64::consts::TAU - angle } else { angle };
    let turn = if sweep { turn } else { -turn };
    Some(Arc::new(center, r, (from - center).angle(), turn).into())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use spec::Code;

    fn good(d: &str) -> Vec<Path> {
        let (paths, fault) = parse(d);
        assert_eq!(fault, None, "{d}");
        paths
    }

    #[test]
    fn lines_by_every_command_and_spelling() {
        let square = good("M 0 0 L 4 0 L 4 3 L 0 3 Z");
        assert_eq!(square[0].length(), 14.0);
        assert!(square[0].closed);
        for d in ["M0,0H4V3H0Z", "M0 0 4 0 4,3 0,3Z", "M0-0L4 0,4 3 0 3 0 0Z", "M0 0L4.0.0L4 3e0L.0 3z"] {
            let (paths, fault) = parse(d);
            if d.ends_with('z') {
                assert_eq!(fault.map(|f| f.code), Some(FindingCode::UnknownWord.as_str()));
            } else {
                assert_eq!((paths, fault), (square.clone(), None), "{d}");
            }
        }
        let two = good("M0 0L1 0Z L0 1M5 5L6 6");
        assert_eq!(two.iter().map(|p| p.closed).collect::<Vec<_>>(), [true, false, false]);
    }

    #[test]
    fn arcs_of_any_turn() {
        for radius in [0.01, 30.0, 2000.0] {
            for degrees in [1.0_f64, 90.0, 170.0, 179.9, 180.1, 190.0, 270.0, 359.0] {
                for sign in [1.0, -1.0] {
                    let exact = Arc::new(Point::new(3.0, 4.0), radius, 1.0, sign * degrees.to_radians());
                    let (a, b) = (exact.start(), exact.end());
                    let (large, sweep) = (u8::from(degrees > 180.0), u8::from(sign > 0.0));
                    let d = format!("M{} {}A{radius} {radius} 0 {large}{sweep}{} {}", a.x, a.y, b.x, b.y);
                    let Segment::Arc(fitted) = good(&d)[0].segments[0] else { panic!("{d}") };
                    // Near 180 degrees the centre hangs on the square root of a rounding error.
                    assert!(fitted.center.distance(exact.center) < 1e-6 * radius, "{d}: {fitted:?}");
                    assert!((fitted.sweep - exact.sweep).abs() < 1e-5, "{d}: {fitted:?}");
                }
            }
        }
    }

    #[test]
    fn degenerate_arcs() {
        let Segment::Arc(half) = good("M0 0A1 1 0 0 1 4 0")[0].segments[0] else { panic!() };
        assert_eq!((half.radius, half.sweep), (2.0, PI));
        assert!(matches!(good("M0 0A0 0 0 0 1 4 0")[0].segments[0], Segment::Line(_)));
        assert!(good("M0 0A1 1 0 0 1 0 0").is_empty());
    }

    #[test]
    fn refusals() {
        for (d, code) in [
            ("L1 1", "bad-path"),
            ("Z", "bad-path"),
            ("M1", "bad-path"),
            ("M1 1 l2 2", "unknown-word"),
            ("M0 0C1 1 2 2 3 3", "unknown-word"),
            ("M0 0A1 2 0 0 1 1 1", "bad-arc"),
            ("M0 0A1 1 30 0 1 1 1", "bad-arc"),
            ("M0 0A1 1 0 2 1 1 1", "bad-path"),
            ("M0 0L1e9 0", "bad-number"),
            ("M0 0L nan 0", "bad-path"),
            ("M0 0 Lé", "bad-path"),
        ] {
            assert_eq!(parse(d).1.map(|f| f.code), Some(code), "{d}");
        }
    }
}
