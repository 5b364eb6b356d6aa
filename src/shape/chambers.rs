//! Chambers and leaks, from the curves alone.
//!
//! Every boundary is a closed curve, or an open one whose ends a port joins. Where no two curves meet, the plane falls into regions
//! by which curves lie inside which: a curve at an even depth is the outer edge of a chamber, the curves right inside it are its
//! islands. All that keeps the curves from doing so is a leak.

use crate::shape::{Port, Role, SealedShape, Seam};
use inflatable::geom::{Line, Path, Point, intersections, path_intersections};

/// Gaps below this are rounding, mm.
const GAP: f64 = 1e-9;
/// Slack of a port's width, mm.
const SLACK: f64 = 1e-6;

/// A region that air can reach. Seams and ports are counted from 0 in the shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chamber {
    /// The seam around it.
    pub outside: usize,
    /// The seams of its islands.
    pub islands: Vec<usize>,
    /// The ports into it.
    pub ports: Vec<usize>,
}

/// A way for air that is no port. Seams and ports are counted from 0 in the shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Leak {
    /// A gap between two neighbouring segments of a seam, mm.
    Gap(usize, f64),
    /// A seam meets itself at these places.
    CrossesItself(usize, Vec<Point>),
    /// Two seams meet at these places.
    Cross([usize; 2], Vec<Point>),
    /// A boundary is open, and no port is between its ends.
    Open(usize, [Point; 2]),
    /// No open seam ends at a port: it is sealed.
    SealedPort(usize),
    /// The bands leave a port narrower than its hose needs: width, mm.
    NarrowPort(usize, f64),
}

/// The chambers of a shape, and its leaks. The chambers are right only where there are no leaks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Topology {
    /// The chambers.
    pub chambers: Vec<Chamber>,
    /// The leaks, seam by seam, then port by port.
    pub leaks: Vec<Leak>,
}

impl SealedShape {
    /// Its chambers and its leaks.
    pub fn topology(&self) -> Topology {
        let mut leaks = Vec::new();
        let mut curves: Vec<(usize, Path)> = Vec::new();
        for (i, seam) in self.seams.iter().enumerate() {
            let path = &seam.center_line;
            if path.largest_gap() > GAP {
                leaks.push(Leak::Gap(i, path.largest_gap()));
            }
            let own = self_crossings(path);
            if !own.is_empty() {
                leaks.push(Leak::CrossesItself(i, own));
            }
            for (j, other) in self.seams.iter().enumerate().skip(i + 1) {
                let places = path_intersections(path, &other.center_line);
                if !places.is_empty() {
                    leaks.push(Leak::Cross([i, j], places));
                }
            }
            if seam.role == Role::Weld {
                continue;
            }
            match (path.closed, ends(seam)) {
                (false, Some([start, end])) => {
                    if self.port_between(start, end).is_some() {
                        let mut closed = path.segments.clone();
                        closed.push(Line::new(end, start).into());
                        curves.push((i, Path::closed(closed)));
                    } else {
                        leaks.push(Leak::Open(i, [start, end]));
                    }
                }
                _ => curves.push((i, path.clone())),
            }
        }
        for (i, port) in self.ports.iter().enumerate() {
            match self.port_width(i) {
                None => leaks.push(Leak::SealedPort(i)),
                Some(width) if width < port.width - SLACK => leaks.push(Leak::NarrowPort(i, width)),
                Some(_) => {}
            }
        }
        Topology { chambers: self.chambers(&curves), leaks }
    }

    /// The width between the bands at port number `port`, mm; `None` if it is sealed.
    pub fn port_width(&self, port: usize) -> Option<f64> {
        let is_open = |seam: &&Seam| seam.role == Role::Boundary && !seam.center_line.closed;
        let ends = self.seams.iter().filter(is_open).filter_map(ends);
        let mut open = ends.filter(|[a, b]| self.port_between(*a, *b) == Some(port));
        open.next().map(|[a, b]| a.distance(b) - self.band)
    }

    /// The port between the two ends of a seam.
    fn port_between(&self, start: Point, end: Point) -> Option<usize> {
        let middle = start.midpoint(end);
        let reach = |port: &Port| port.width + self.band;
        self.ports.iter().position(|port| port.at.distance(middle) <= reach(port))
    }

    fn chambers(&self, curves: &[(usize, Path)]) -> Vec<Chamber> {
        let inside = |a: &Path, b: &Path| a.start().is_some_and(|start| b.encloses(start));
        let around = |i: usize| -> Vec<usize> {
            (0..curves.len()).filter(|j| *j != i && inside(&curves[i].1, &curves[*j].1)).collect()
        };
        let around: Vec<Vec<usize>> = (0..curves.len()).map(around).collect();
        let outsides = (0..curves.len()).filter(|i| around[*i].len().is_multiple_of(2));
        let seam = |i: usize| curves[i].0;
        let right_inside = |i: usize, outside: usize| {
            around[i].contains(&outside) && around[i].len() == around[outside].len() + 1
        };
        let ports = |members: &[usize]| -> Vec<usize> {
            let own = members.iter().filter_map(|seam| ends(&self.seams[*seam]));
            own.filter_map(|[start, end]| self.port_between(start, end)).collect()
        };
        outsides
            .map(|outside| {
                let islands = (0..curves.len()).filter(|i| right_inside(*i, outside));
                let islands: Vec<usize> = islands.map(seam).collect();
                let members = [&[seam(outside)], islands.as_slice()].concat();
                let open: Vec<usize> =
                    members.into_iter().filter(|i| !self.seams[*i].center_line.closed).collect();
                Chamber { outside: seam(outside), ports: ports(&open), islands }
            })
            .collect()
    }
}

/// Both ends of a seam's centre line.
fn ends(seam: &Seam) -> Option<[Point; 2]> {
    Some([seam.center_line.start()?, seam.center_line.end()?])
}

/// Where a path meets itself, neighbours left out.
fn self_crossings(path: &Path) -> Vec<Point> {
    let (segments, n) = (&path.segments, path.segments.len());
    let pairs = (0..n).flat_map(|i| (i + 2..n).map(move |j| (i, j)));
    pairs
        .filter(|(i, j)| !(path.closed && *i == 0 && *j == n - 1))
        .flat_map(|(i, j)| intersections(&segments[i], &segments[j]))
        .collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use inflatable::geom::Arc;

    fn circle(x: f64, radius: f64) -> Path {
        Path::closed(vec![Arc::new(Point::new(x, 0.0), radius, 0.0, TAU).into()])
    }

    /// Around (x, 0), open on +X by `mouth` mm between its ends.
    fn opened(x: f64, radius: f64, mouth: f64) -> Path {
        let half = (mouth / 2.0 / radius).asin();
        Path::open(vec![Arc::new(Point::new(x, 0.0), radius, half, TAU - 2.0 * half).into()])
    }

    fn shape(lines: Vec<Path>, ports: Vec<Port>) -> SealedShape {
        let seam =
            |center_line| Seam { name: String::new(), role: Role::Boundary, center_line, overlap: 5.0 };
        SealedShape { seams: lines.into_iter().map(seam).collect(), band: 2.0, cut: None, ports }
    }

    fn port(x: f64, width: f64) -> Port {
        Port { at: Point::new(x, 0.0), width }
    }

    #[test]
    fn nested_curves_are_chambers_with_islands() {
        // A ring with a port and an island; in the island a chamber of its own; beside them one more.
        let lines = vec![opened(0.0, 50.0, 10.0), circle(0.0, 30.0), circle(0.0, 20.0), circle(200.0, 9.0)];
        let found = shape(lines, vec![port(50.0, 6.0)]).topology();
        assert_eq!(found.leaks, []);
        let chamber = |outside, islands: &[usize], ports: &[usize]| Chamber {
            outside,
            islands: islands.to_vec(),
            ports: ports.to_vec(),
        };
        assert_eq!(found.chambers, [chamber(0, &[1], &[0]), chamber(2, &[], &[]), chamber(3, &[], &[])]);
    }

    #[test]
    fn every_way_out_is_a_leak_with_its_place() {
        let leaks = |lines, ports| shape(lines, ports).topology().leaks;
        assert!(matches!(leaks(vec![opened(0.0, 50.0, 10.0)], vec![])[..], [Leak::Open(0, _)]));
        assert_eq!(leaks(vec![circle(0.0, 50.0)], vec![port(50.0, 6.0)]), [Leak::SealedPort(0)]);
        let narrow = leaks(vec![opened(0.0, 50.0, 7.0)], vec![port(50.0, 6.0)]);
        let [Leak::NarrowPort(0, width)] = narrow[..] else { panic!("{narrow:?}") };
        assert!((width - 5.0).abs() < 1e-9);
        let crossed = leaks(vec![circle(0.0, 50.0), circle(60.0, 50.0)], vec![]);
        let [Leak::Cross([0, 1], places)] = &crossed[..] else { panic!("{crossed:?}") };
        assert!(places.len() == 2 && places.iter().all(|place| (place.x - 30.0).abs() < 1e-9));
        let p = |x: f64, y: f64| Point::new(x, y);
        let eight = [p(0.0, 0.0), p(10.0, 10.0), p(10.0, 0.0), p(0.0, 10.0), p(0.0, 0.0)];
        let eight = Path::closed(eight.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect());
        assert_eq!(leaks(vec![eight], vec![]), [Leak::CrossesItself(0, vec![p(5.0, 5.0)])]);
        let mut gap = circle(0.0, 50.0);
        gap.segments[0] = Arc::new(Point::ORIGIN, 50.0, 0.0, TAU - 0.01).into();
        assert!(matches!(leaks(vec![gap], vec![])[..], [Leak::Gap(0, size)] if (size - 0.5).abs() < 1e-3));
    }
}
