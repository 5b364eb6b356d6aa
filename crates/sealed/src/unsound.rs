//! Leaks of a sealed shape, and chambers without ports, as faults of the sketch.

use crate::bands::Bands;
use crate::fault::{Quoted, ShapeCode, ShapeFault, quoted};
use crate::mouth::ON_SIDE;
use crate::sketch::{DrawnPort, Rules};
use crate::{Chamber, Leak, SealedShape};
use geom::{Line, Point, Segment, intersections};

/// Faults of leaks of `shape`, and of chambers that no port leads into. `earlier` are the faults of the passes before: what they tell is not
/// told again.
pub(crate) fn unsound_chambers(
    shape: &SealedShape,
    bands: &Bands,
    ports: &[DrawnPort],
    rules: &Rules,
    earlier: &[ShapeFault],
) -> Vec<ShapeFault> {
    let topology = shape.topology();
    let mut faults = earlier.to_vec();
    for leak in &topology.leaks {
        let place = leak.place(shape).unwrap_or(Point::ORIGIN);
        if !is_told(leak, place, &faults, rules) && !is_port_told(leak, bands, ports, &faults) {
            let fault = leak_fault(leak, place, bands, ports, rules);
            if !faults.iter().any(|other| other.code == fault.code && other.what == fault.what) {
                faults.push(fault);
            }
        }
    }
    let mut faults = faults.split_off(earlier.len());
    for (chamber, inside) in topology.chambers.iter().zip(&topology.insides) {
        let is_open = !chamber.ports.is_empty() || !chamber.valves.is_empty();
        // A leak may be the reason why a port is not recognised as that of its chamber: the band goes on past its mouth, or closes it.
        if is_open || !topology.leaks.is_empty() && has_mouth(chamber, bands, rules) {
            continue;
        }
        let names = bands.list[chamber.outside].names.clone();
        let finding = format!("the chamber inside of {} has no port", Quoted(&names));
        let remedy =
            "draw a port on its outer edge or a valve in its face, or open a wall to a chamber with a port";
        let fault = ShapeFault::new(ShapeCode::NoPort, chamber_middle(shape, *inside), finding, remedy);
        faults.push(ShapeFault { names, found: 0.0, allowed: 1.0, ..fault });
    }
    faults
}

/// Whether the band around a chamber ends at the mouth of a port, or closes it.
fn has_mouth(chamber: &Chamber, bands: &Bands, rules: &Rules) -> bool {
    let path = &bands.list[chamber.outside].path;
    bands.mouths.iter().any(|mouth| {
        let lateral = mouth.half + rules.band / 2.0;
        let sides = [lateral, -lateral].map(|side| mouth.point(rules.overrun, side));
        sides.iter().any(|side| path.distance(*side) < ON_SIDE)
            || path.distance(mouth.at) <= lateral + mouth.beyond
    })
}

/// Whether a leak of a band at `place` is told by a fault of the bands there: a band that crosses another is told with the names of both.
fn is_told(leak: &Leak, place: Point, faults: &[ShapeFault], rules: &Rules) -> bool {
    use ShapeCode::{BandsOverlap, ChannelOverlap, Crossing, CutInBand};
    !matches!(leak, Leak::SealedPort(_) | Leak::NarrowPort(..))
        && faults.iter().any(|fault| {
            matches!(fault.code, Crossing | BandsOverlap | ChannelOverlap | CutInBand)
                && fault.place.distance(place) <= 4.0 * rules.band
        })
}

/// Whether a port that is sealed or narrow is told by a fault of its channel: the band or the edge that closes the channel seals the port.
fn is_port_told(leak: &Leak, bands: &Bands, ports: &[DrawnPort], faults: &[ShapeFault]) -> bool {
    let (Leak::SealedPort(port) | Leak::NarrowPort(port, _)) = leak else { return false };
    let mut numbers: Vec<usize> = bands.mouths.iter().map(|mouth| mouth.port).collect();
    numbers.sort_unstable();
    let Some(name) = numbers.get(*port).map(|number| &ports[*number].name) else { return false };
    faults.iter().any(|fault| fault.code == ShapeCode::ChannelOverlap && fault.names.contains(name))
}

/// The fault of a leak at `place`.
///
/// A leak beside the mouth of a port is one of that port, and of several ports where their channels meet there; else it is a crossing of
/// the bands.
fn leak_fault(leak: &Leak, place: Point, bands: &Bands, ports: &[DrawnPort], rules: &Rules) -> ShapeFault {
    let list = &bands.list;
    let names = match leak {
        Leak::Gap(seam, _) | Leak::CrossesItself(seam, _) | Leak::Open(seam, _) => list[*seam].names.clone(),
        Leak::Cross([a, b], _) => [&list[*a].names[..], &list[*b].names].concat(),
        Leak::SealedPort(_) | Leak::NarrowPort(..) => Vec::new(),
    };
    let mouths_near = bands.mouths.iter().filter(|mouth| {
        place.distance(mouth.at) <= 2.0 * (mouth.half + rules.band) + mouth.depth + mouth.beyond
    });
    let ports: Vec<String> = mouths_near.map(|mouth| ports[mouth.port].name.clone()).collect();
    let finding = match leak {
        Leak::CrossesItself(..) => format!("the band along {} crosses itself", Quoted(&names)),
        Leak::Cross(..) => format!("the bands of {} cross", Quoted(&names)),
        Leak::Gap(..) | Leak::Open(..) => format!("the band along {} stays open", Quoted(&names)),
        Leak::SealedPort(_) => "a band seals the port".to_owned(),
        Leak::NarrowPort(_, width) => format!("the bands leave {width:.3} mm of the port"),
    };
    let fault = match ports.as_slice() {
        [] => {
            let remedy =
                "move the drawn edges apart, or unite their areas; end a weld in the air or on an edge";
            return ShapeFault { names, ..ShapeFault::new(ShapeCode::Crossing, place, finding, remedy) };
        }
        [port] => {
            let finding = format!("{finding} at port {}", quoted(port));
            let remedy = "move the port to where its channel leads straight out";
            ShapeFault::new(ShapeCode::Leak, place, finding, remedy)
        }
        ports => {
            let finding = format!("the channels of ports {} meet", Quoted(ports));
            let remedy = format!("{}, and draw each as one line or point", rules.ports_apart());
            ShapeFault::new(ShapeCode::Leak, place, finding, remedy)
        }
    };
    ShapeFault { names: ports, ..fault }
}

/// From a point `p` in the air beside a seam, the point halfway to the seam across.
fn chamber_middle(shape: &SealedShape, p: Point) -> Point {
    let segments: Vec<&Segment> = shape.seams.iter().flat_map(|seam| &seam.center_line.segments).collect();
    let feet = segments.iter().map(|segment| segment.point(segment.nearest_fraction(p)));
    let nearest = feet.min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)));
    let Some(nearest) = nearest else { return p };
    let reach = segments.iter().map(|segment| segment.start().distance(p)).fold(0.0, f64::max);
    let opposite = p + (p - nearest).normalized() * (2.0 * reach);
    let ray = Line::new(p, opposite).into();
    let distances = segments.iter().flat_map(|segment| intersections(segment, &ray)).map(|q| q.distance(p));
    let width = distances.fold(f64::INFINITY, f64::min);
    if width.is_finite() { p.lerp(opposite, width / (4.0 * reach)) } else { p }
}
