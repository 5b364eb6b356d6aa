//! Chambers and leaks, from the curves alone.
//!
//! Every boundary is a closed curve, an open one whose ends ports join to a **ring**, or a **wall**: an open one that ends on other bands.
//! The curves part the plane into faces. Air reaches those that an odd number of rings lies around: each is a chamber, and the rings right
//! inside it are its islands. All that keeps the curves from doing so is a leak.

use crate::graph::{GraphEdge, walk_path, walks};
use crate::joints::{Joints, MouthEnds, is_under_another, meetings};
use crate::mouth::ON_SIDE;
use crate::network::{Network, network};
use crate::pieces::Piece;
use crate::regions::side_points;
use crate::{Role, SealedShape};
use geom::order::sort_by_key;
use geom::{Enclosures, Line, Path, Point};

/// Gaps below this are rounding, mm.
const GAP: f64 = 1e-9;
/// Slack of a port's width, mm.
const SLACK: f64 = 1e-6;
/// A port is narrow where the bands leave less of it by more than this, mm: the sides of its channel are offsets, each as far off as
/// their joints.
const NARROWER: f64 = 2.0 * ON_SIDE;

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
    /// The place of the leak; `None` if `shape` does not have it.
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

/// A region that air can reach. Seams, ports and valves are counted from 0 in the shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chamber {
    /// The seam around it: of several the first.
    pub outside: usize,
    /// The seams of its islands.
    pub islands: Vec<usize>,
    /// The ports into it.
    pub ports: Vec<usize>,
    /// The valves in its face.
    pub valves: Vec<usize>,
}

/// The chambers of a shape, and its leaks. The chambers are right only where there are no leaks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Topology {
    /// The chambers.
    pub chambers: Vec<Chamber>,
    /// A point in each chamber.
    pub insides: Vec<Point>,
    /// The leaks, seam by seam, then port by port.
    pub leaks: Vec<Leak>,
}

impl SealedShape {
    /// The chambers and the leaks of the shape.
    pub fn topology(&self) -> Topology {
        let joints = Joints::new(self);
        let leaks = self.leaks(&joints);
        let mut faces = self.chambers(&joints);
        sort_by_key(&mut faces, |(chamber, _)| chamber.outside);
        let (chambers, insides) = faces.into_iter().unzip();
        Topology { chambers, insides, leaks }
    }

    /// The leaks, seam by seam, then port by port.
    fn leaks(&self, joints: &Joints) -> Vec<Leak> {
        let mut leaks = self.leaks_of_seams(joints);
        for (i, port) in self.ports.iter().enumerate() {
            match joints.width(self, i) {
                None => leaks.push(Leak::SealedPort(i)),
                Some(width) if width < port.width - NARROWER => leaks.push(Leak::NarrowPort(i, width)),
                Some(_) => {}
            }
        }
        leaks
    }

    fn leaks_of_seams(&self, joints: &Joints) -> Vec<Leak> {
        let crossings = meetings(self, joints);
        let mut leaks = Vec::new();
        for (i, seam) in self.seams.iter().enumerate() {
            let path = &seam.center_line;
            if path.largest_gap() > GAP {
                leaks.push(Leak::Gap(i, path.largest_gap()));
            }
            leaks.extend(crossings.range([i, 0]..[i + 1, 0]).map(|(&[a, b], places)| {
                let places = places.clone();
                if a == b { Leak::CrossesItself(a, places) } else { Leak::Cross([a, b], places) }
            }));
            let ends = path.start().zip(path.end());
            if let (Role::Boundary, false, Some((start, end))) = (seam.role, path.closed, ends) {
                let ends_touch = start.distance(end) <= SLACK && !is_under_another(self, i, start);
                if ends_touch || !joints.is_shut(i, 0) {
                    leaks.push(Leak::Open(i, [start, end]));
                } else if !joints.is_shut(i, 1) {
                    leaks.push(Leak::Open(i, [end, start]));
                }
            }
        }
        leaks
    }

    /// The width between the bands at port number `port`, mm; `None` if it is sealed.
    pub fn port_width(&self, port: usize) -> Option<f64> {
        Joints::new(self).width(self, port)
    }

    /// The chambers, and a point in each.
    fn chambers(&self, joints: &Joints) -> Vec<(Chamber, Point)> {
        let seam_count = self.seams.len();
        let mouth_piece =
            |mouth: &MouthEnds| Piece { path: Path::polyline(&mouth.ends), source: seam_count + mouth.port };
        let mut pieces: Vec<Piece> = joints.mouths.iter().map(mouth_piece).collect();
        let boundaries = self.seams.iter().enumerate().filter(|(_, seam)| seam.role == Role::Boundary);
        pieces.extend(boundaries.map(|(source, seam)| Piece { path: seam.center_line.clone(), source }));
        let is_ring = |piece: &&Piece| joints.joined.get(piece.source) != Some(&[true; 2]);
        let ring_pieces: Vec<Piece> = pieces.iter().filter(is_ring).cloned().collect();
        // Ends of rings and mouths are the same points.
        let plane = AirPlane::new(
            rings(network(&ring_pieces, SLACK)),
            bounded_faces(&network(&pieces, self.band / 2.0 + SLACK)),
            seam_count,
        );
        let valves: Vec<Point> = self.valves.iter().filter_map(|valve| valve.hole.start()).collect();
        plane.chambers(&valves)
    }
}

/// A closed boundary: its path, and the numbers of the curves that it is made of.
struct BoundaryRing {
    path: Path,
    sources: Vec<usize>,
}

/// The edges of a network as rings. An open ring is a leak; its chamber closes where its ends do.
fn rings(network: Network) -> Vec<BoundaryRing> {
    let mut rings = Vec::with_capacity(network.edges.len());
    for edge in network.edges {
        let mut segments = edge.path.segments;
        if let (Some(_), Some(first), Some(last)) = (edge.nodes, segments.first(), segments.last()) {
            segments.push(Line::new(last.end(), first.start()).into());
        }
        rings.push(BoundaryRing { path: Path::closed(segments), sources: edge.sources });
    }
    rings
}

/// A face: its edge, the numbers of the curves along it, and a point in it.
struct Face {
    path: Path,
    sources: Vec<usize>,
    inside: Point,
}

/// The bounded faces of a network.
fn bounded_faces(network: &Network) -> Vec<Face> {
    let mut faces = Vec::new();
    let mut edges: Vec<GraphEdge<'_>> = Vec::new();
    let mut edge_sources: Vec<&[usize]> = Vec::new();
    for edge in &network.edges {
        if let Some(nodes) = edge.nodes {
            edges.push(GraphEdge { path: &edge.path, nodes });
            edge_sources.push(&edge.sources);
        } else {
            let (_, [left, right]) = side_points(&edge.path, 1e-6);
            let face_point = if edge.path.area() > 0.0 { left } else { right };
            faces.push(Face { path: edge.path.clone(), sources: edge.sources.clone(), inside: face_point });
        }
    }
    for walk in walks(&edges) {
        let path = walk_path(&edges, &walk);
        if path.area() <= 1e-9 {
            continue;
        }
        let (_, [face_point, _]) = side_points(&path, 1e-6);
        let mut sources: Vec<usize> =
            walk.iter().flat_map(|travel| edge_sources[travel.edge].to_vec()).collect();
        sources.sort_unstable();
        sources.dedup();
        faces.push(Face { path, sources, inside: face_point });
    }
    faces
}

/// The plane, parted by rings into air and fabric, and by all curves into faces.
struct AirPlane {
    rings: Vec<BoundaryRing>,
    faces: Vec<Face>,
    ring_enclosures: Enclosures,
    face_enclosures: Enclosures,
    /// Areas of the faces, mm^2.
    areas: Vec<f64>,
    /// Number of seams: the curves after them are ports.
    seam_count: usize,
}

impl AirPlane {
    fn new(rings: Vec<BoundaryRing>, faces: Vec<Face>, seam_count: usize) -> Self {
        let ring_enclosures = Enclosures::new(rings.iter().map(|ring| &ring.path));
        let face_enclosures = Enclosures::new(faces.iter().map(|face| &face.path));
        let areas = faces.iter().map(|face| face.path.area().abs()).collect();
        Self { rings, faces, ring_enclosures, face_enclosures, areas, seam_count }
    }

    /// The smallest face around `p`.
    fn innermost_face(&self, p: Point) -> Option<usize> {
        let faces = self.face_enclosures.enclosing(p).into_iter();
        faces.min_by(|a, b| self.areas[*a].total_cmp(&self.areas[*b]))
    }

    /// The first seam of a ring.
    fn first_seam(&self, ring: usize) -> Option<usize> {
        self.rings[ring].sources.iter().copied().find(|source| *source < self.seam_count)
    }

    /// The faces with air, each with a point in it. `valves` are places in the holes of valves.
    ///
    /// Air lies in a face where an odd number of rings lies around. The deepest of them is the outside of the chamber, and rings that lie in
    /// the face are islands.
    fn chambers(&self, valves: &[Point]) -> Vec<(Chamber, Point)> {
        let mut depth = Vec::with_capacity(self.rings.len());
        let mut rings_within: Vec<Vec<usize>> = vec![Vec::new(); self.faces.len()];
        for (number, BoundaryRing { path, .. }) in self.rings.iter().enumerate() {
            let (_, [left, right]) = side_points(path, 1e-6);
            let outside = if path.area() > 0.0 { right } else { left };
            depth.push(self.ring_enclosures.enclosing(outside).len());
            if let Some(face) = self.innermost_face(outside) {
                rings_within[face].push(number);
            }
        }
        let valve_faces: Vec<Option<usize>> =
            valves.iter().map(|valve| self.innermost_face(*valve)).collect();
        let mut chambers = Vec::new();
        for (number, face) in self.faces.iter().enumerate() {
            let rings = self.ring_enclosures.enclosing(face.inside);
            let deepest = rings.iter().copied().max_by_key(|ring| depth[*ring]);
            let Some(outside) = deepest.and_then(|ring| self.first_seam(ring)) else { continue };
            if rings.len().is_multiple_of(2) {
                continue;
            }
            let mut islands: Vec<usize> =
                rings_within[number].iter().filter_map(|ring| self.first_seam(*ring)).collect();
            islands.sort_unstable();
            let ports =
                face.sources.iter().filter_map(|source| source.checked_sub(self.seam_count)).collect();
            let valves = (0..valves.len()).filter(|valve| valve_faces[*valve] == Some(number)).collect();
            chambers.push((Chamber { outside, islands, ports, valves }, face.inside));
        }
        chambers
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::{Port, Seam};
    use geom::Arc;

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
        SealedShape {
            seams: lines.into_iter().map(seam).collect(),
            band: 2.0,
            cut: None,
            ports,
            valves: Vec::new(),
        }
    }

    fn port(x: f64, width: f64) -> Port {
        Port { at: Point::new(x, 0.0), width }
    }

    #[test]
    fn nested_curves_are_chambers_with_islands() {
        // A ring with a port and an island; in the island a chamber of its own; beside them one more.
        let lines = vec![opened(0.0, 50.0, 10.0), circle(0.0, 30.0), circle(0.0, 20.0), circle(200.0, 9.0)];
        let topology = shape(lines, vec![port(50.0, 6.0)]).topology();
        assert_eq!(topology.leaks, []);
        let chamber = |outside, islands: &[usize], ports: &[usize]| Chamber {
            outside,
            islands: islands.to_vec(),
            ports: ports.to_vec(),
            valves: Vec::new(),
        };
        assert_eq!(topology.chambers, [chamber(0, &[1], &[0]), chamber(2, &[], &[]), chamber(3, &[], &[])]);
    }

    #[test]
    fn every_way_out_is_a_leak_with_its_place() {
        let leaks = |lines, ports| shape(lines, ports).topology().leaks;
        assert!(matches!(leaks(vec![opened(0.0, 50.0, 10.0)], vec![])[..], [Leak::Open(0, _)]));
        let touching = Path::open(circle(0.0, 50.0).segments);
        assert!(matches!(leaks(vec![touching], vec![])[..], [Leak::Open(0, _)]));
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

    fn straight(a: (f64, f64), b: (f64, f64)) -> Path {
        Path::open(vec![Line::new(Point::new(a.0, a.1), Point::new(b.0, b.1)).into()])
    }

    fn topology_with(rim: &[Path], walls: &[Path]) -> Topology {
        shape([rim, walls].concat(), vec![]).topology()
    }

    /// Walls end on other bands, half a band off their centre lines too; welds end in the air.
    #[test]
    fn walls_part_chambers_and_welds_do_not() {
        let rim = [circle(0.0, 50.0), circle(0.0, 10.0)];
        let left = straight((-49.2, 0.0), (-10.0, 0.0));
        let right = straight((10.5, 0.0), (50.0, 0.0));
        let single = topology_with(&rim, std::slice::from_ref(&left));
        assert_eq!((single.leaks.len(), single.chambers.len()), (0, 1));
        assert_eq!(single.chambers[0].islands, [1]);
        let two = topology_with(&rim, &[left, right]);
        assert_eq!((two.leaks.len(), two.chambers.len()), (0, 2));
        assert!(two.insides[0].y * two.insides[1].y < 0.0, "{:?}", two.insides);
        let loose = topology_with(&rim, &[straight((-50.0, 0.0), (-20.0, 0.0))]);
        assert!(
            matches!(loose.leaks[..], [Leak::Open(2, [end, _])] if end == Point::new(-20.0, 0.0)),
            "{loose:?}"
        );
        let mut weld = shape([&rim[..], &[straight((-50.0, 0.0), (-20.0, 0.0))]].concat(), vec![]);
        weld.seams[2].role = Role::Weld;
        assert_eq!((weld.topology().leaks.len(), weld.topology().chambers.len()), (0, 1));
    }

    /// Two ports cut a rim into two seams: one chamber still.
    #[test]
    fn two_ports_open_one_ring() {
        let half = |from: f64| {
            let gap = (5.0_f64 / 50.0).asin();
            Path::open(vec![Arc::new(Point::ORIGIN, 50.0, from + gap, TAU / 2.0 - 2.0 * gap).into()])
        };
        let two_ports = vec![port(50.0, 6.0), port(-50.0, 6.0)];
        let topology = shape(vec![half(0.0), half(TAU / 2.0)], two_ports).topology();
        assert_eq!(topology.leaks, []);
        assert_eq!(
            topology.chambers,
            [Chamber { outside: 0, islands: vec![], ports: vec![0, 1], valves: vec![] }]
        );
        let open = shape(vec![half(0.0), half(TAU / 2.0)], vec![port(50.0, 6.0)]).topology();
        assert!(open.leaks.iter().all(|leak| matches!(leak, Leak::Open(..))) && open.leaks.len() == 2);
    }
}
