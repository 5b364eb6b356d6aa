//! A seam: the centre line of a band, and how the iron enters and leaves it.

use inflatable::geom::{Line, Path, Segment};

/// The purpose of a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// An edge of a chamber.
    Boundary,
    /// A band that encloses nothing, such as a strip for a peel test.
    Weld,
}

/// One seam: the centre line of a band.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// Its name among the seams of its piece; empty for the only one.
    pub name: String,
    /// Its purpose.
    pub role: Role,
    /// The band's centre line from where the sealing starts: closed, or open from end to end.
    pub center_line: Path,
    /// Path covered twice where a closed line meets its start, mm; 0 for an open one.
    pub overlap: f64,
}

impl Seam {
    /// The only seam of a piece: an open line that encloses nothing.
    pub fn weld(center_line: Path) -> Self {
        Self { name: String::new(), role: Role::Weld, center_line, overlap: 0.0 }
    }

    /// The path in contact: the center line, and its overlap again.
    pub fn run(&self) -> Path {
        if self.center_line.closed {
            self.center_line.part(0.0, self.center_line.length() + self.overlap)
        } else {
            self.center_line.clone()
        }
    }

    /// The path of `length` on which the iron goes down before the run: along the loop, or straight on before an open end.
    pub fn lead_in(&self, length: f64) -> Path {
        if self.center_line.closed {
            return self.center_line.part(-length, 0.0);
        }
        straight_in(&self.center_line, length)
    }

    /// The path of `length` on which the iron goes up after the run.
    pub fn lead_out(&self, length: f64) -> Path {
        if self.center_line.closed {
            return self.center_line.part(self.overlap, self.overlap + length);
        }
        straight_out(&self.center_line, length)
    }
}

/// Whether a segment is long enough to give a line's direction; shorter ones may be rounding of a drawing.
fn has_direction(segment: &Segment) -> bool {
    segment.length() > 0.01
}

/// The straight way of `length` that ends where the open `path` begins.
fn straight_in(path: &Path, length: f64) -> Path {
    let direction = path.segments.iter().find(|segment| has_direction(segment)).or(path.segments.first());
    let (Some(start), Some(first)) = (path.start(), direction) else { return Path::default() };
    let tangent = first.tangent(0.0);
    Path::open(vec![Line::new(start - tangent * length, start).into()])
}

/// The straight way of `length` that goes on where the open `path` ends.
fn straight_out(path: &Path, length: f64) -> Path {
    let direction =
        path.segments.iter().rev().find(|segment| has_direction(segment)).or(path.segments.last());
    let (Some(end), Some(last)) = (path.end(), direction) else { return Path::default() };
    let tangent = last.tangent(1.0);
    Path::open(vec![Line::new(end, end + tangent * length).into()])
}
