//! Leaks: ways for air other than ports.

use crate::SealedShape;
use geom::Point;

/// A way for air other than a port. Seams and ports are counted from 0 in the shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Leak {
    /// A gap between two neighbouring segments of a seam, mm.
    Gap(usize, f64),
    /// A seam meets itself at these places.
    CrossesItself(usize, Vec<Point>),
    /// Two seams meet at these places.
    Cross([usize; 2], Vec<Point>),
    /// A boundary is open: its ends, of which the first lies at no port and on no other band.
    Open(usize, [Point; 2]),
    /// No open seam ends at a port: it is sealed.
    SealedPort(usize),
    /// The bands leave a port narrower than its hose needs: width, mm.
    NarrowPort(usize, f64),
}

impl Leak {
    /// Its place; `None` if `shape` does not have it.
    pub fn place(&self, shape: &SealedShape) -> Option<Point> {
        match self {
            Self::Gap(seam, gap) => {
                let path = &shape.seams.get(*seam)?.center_line;
                let next = path.segments.iter().cycle().skip(1);
                let mut pairs = path.segments.iter().zip(next);
                pairs.find(|(a, b)| a.end().distance(b.start()) >= *gap).map(|(a, _)| a.end())
            }
            Self::CrossesItself(_, places) | Self::Cross(_, places) => places.first().copied(),
            Self::Open(_, [end, _]) => Some(*end),
            Self::SealedPort(port) | Self::NarrowPort(port, _) => shape.ports.get(*port).map(|port| port.at),
        }
    }
}
