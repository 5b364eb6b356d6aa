//! Leaks of a sealed shape, and chambers without ports, as faults of the sketch.

use crate::fault::{ShapeCode, ShapeFault, quoted};
use crate::layout::Layout;
use crate::leak::Leak;
use crate::mouth::{Mouth, ON_SIDE};
use crate::notes::SealingNotes;
use crate::sketch::{Rules, Sketch};
use crate::{Chamber, SealedShape};
use geom::{Line as Chord, Point, Segment, intersections};

/// Faults of leaks, and of chambers that no port leads into.
pub(super) fn unsound_chambers(
    shape: &SealedShape,
    lines: &Layout,
    sketch: &Sketch,
    rules: &Rules,
    notes: &mut SealingNotes,
) {
    let topology = shape.topology();
    for leak in &topology.leaks {
        leaking(leak, shape, lines, sketch, rules, notes);
    }
    let chambers = topology.chambers.iter().zip(&topology.insides);
    // A leak may be the reason why a port is not recognised as that of its chamber: the band goes on past its mouth, or closes it.
    let has_mouth = |chamber: &Chamber| {
        let path = &lines.lines[chamber.outside].path;
        lines.mouths.iter().any(|mouth| {
            let across = mouth.half + rules.band / 2.0;
            let sides = [across, -across].map(|side| mouth.point(rules.overrun, side));
            sides.iter().any(|side| path.distance(*side) < ON_SIDE)
                || path.distance(mouth.at) <= across + mouth.beyond
        })
    };
    let is_closed = |chamber: &Chamber| {
        let is_open = !chamber.ports.is_empty() || !chamber.valves.is_empty();
        !is_open && (topology.leaks.is_empty() || !has_mouth(chamber))
    };
    for (chamber, inside) in chambers.filter(|(chamber, _)| is_closed(chamber)) {
        let names = &lines.lines[chamber.outside].names;
        let what = format!("the chamber inside of {} has no port", quoted(names));
        let remedy =
            "draw a port on its outer edge or a valve in its face, or open a wall to a chamber with a port";
        notes.fault(ShapeCode::NoPort, names, amid(shape, *inside), (what, remedy), [0.0, 1.0]);
    }
}

/// The fault of a leak, unless a fault of the bands at its place is known.
fn leaking(
    leak: &Leak,
    shape: &SealedShape,
    lines: &Layout,
    sketch: &Sketch,
    rules: &Rules,
    notes: &mut SealingNotes,
) {
    let place = leak.place(shape).unwrap_or(Point::ORIGIN);
    // A band that crosses another is told with the names of both.
    let is_band = |code| {
        use ShapeCode::{BandsOverlap, ChannelOverlap, Crossing, CutInBand};
        matches!(code, Crossing | BandsOverlap | ChannelOverlap | CutInBand)
    };
    let known = notes
        .faults
        .iter()
        .any(|fault| is_band(fault.code) && fault.place.distance(place) <= 4.0 * rules.band);
    if known && !matches!(leak, Leak::SealedPort(_) | Leak::NarrowPort(..)) {
        return;
    }
    // A band or an edge that is told to close the channel of a port seals the port.
    if let Leak::SealedPort(port) | Leak::NarrowPort(port, _) = leak {
        let mut numbers: Vec<usize> = lines.mouths.iter().map(|mouth| mouth.port).collect();
        numbers.sort_unstable();
        let name = numbers.get(*port).map(|number| &sketch.ports[*number].name);
        let is_told = |fault: &ShapeFault| {
            fault.code == ShapeCode::ChannelOverlap && name.is_some_and(|name| fault.names.contains(name))
        };
        if notes.faults.iter().any(is_told) {
            return;
        }
    }
    let of = |seam: usize| lines.lines[seam].names.clone();
    let names = match leak {
        Leak::Gap(seam, _) | Leak::CrossesItself(seam, _) | Leak::Open(seam, _) => of(*seam),
        Leak::Cross([a, b], _) => [of(*a), of(*b)].concat(),
        Leak::SealedPort(_) | Leak::NarrowPort(..) => Vec::new(),
    };
    let reach = |mouth: &&Mouth| {
        place.distance(mouth.at) <= 2.0 * (mouth.half + rules.band) + mouth.depth + mouth.beyond
    };
    let near = lines.mouths.iter().filter(reach);
    let ports: Vec<String> = near.map(|mouth| sketch.ports[mouth.port].name.clone()).collect();
    let found = match leak {
        Leak::CrossesItself(..) => format!("the band along {} crosses itself", quoted(&names)),
        Leak::Cross(..) => format!("the bands of {} cross", quoted(&names)),
        Leak::Gap(..) | Leak::Open(..) => format!("the band along {} stays open", quoted(&names)),
        Leak::SealedPort(_) => "a band seals the port".to_owned(),
        Leak::NarrowPort(_, width) => format!("the bands leave {width:.3} mm of the port"),
    };
    let (code, names, found, remedy) = match ports.as_slice() {
        [] => (
            ShapeCode::Crossing,
            names,
            found,
            "move the drawn edges apart, or unite their areas; end a weld in the air or on an edge"
                .to_owned(),
        ),
        [port] => (
            ShapeCode::Leak,
            vec![port.clone()],
            format!("{found} at port {}", quoted(std::slice::from_ref(port))),
            "move the port to where its channel leads straight out".to_owned(),
        ),
        ports => (
            ShapeCode::Leak,
            ports.to_vec(),
            format!("the channels of ports {} meet", quoted(ports)),
            format!("{}, and draw each as one line or point", rules.ports_apart()),
        ),
    };
    let same = |fault: &ShapeFault| fault.code == code && fault.what == found;
    if !notes.faults.iter().any(same) {
        notes.fault(code, &names, place, (found, remedy), [f64::NAN; 2]);
    }
}

/// From a point in the air beside a seam, the point halfway to the seam across.
fn amid(shape: &SealedShape, inside: Point) -> Point {
    let segments = || shape.seams.iter().flat_map(|seam| &seam.center_line.segments);
    let on_seam = |segment: &Segment| segment.point(segment.nearest_fraction(inside));
    let nearest = segments().map(on_seam).min_by(|a, b| a.distance(inside).total_cmp(&b.distance(inside)));
    let Some(nearest) = nearest else { return inside };
    let reach = segments().map(|segment| segment.start().distance(inside)).fold(0.0, f64::max);
    let across = inside + (inside - nearest).normalized() * (2.0 * reach);
    let ray = Chord::new(inside, across).into();
    let met = segments().flat_map(|segment| intersections(segment, &ray)).map(|p| p.distance(inside));
    let width = met.fold(f64::INFINITY, f64::min);
    if width.is_finite() { inside.lerp(across, width / (4.0 * reach)) } else { inside }
}
