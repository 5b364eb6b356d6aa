//! The third pass, from regions to **mouths**: each port opens the edge that it lies on, and those that no edge takes are faults.
//!
//! Ports open the edges of the air first, then closed seams that are drawn as centre lines.

use crate::fault::{Noted, SealingNotes, ShapeCode, ShapeFault, quoted};
use crate::mended::MendedEdges;
use crate::mouth::{ChannelSize, Mouth, NoChannel, channel, unambiguous};
use crate::regions::Regions;
use crate::sketch::{DrawnPort, PortPlace, Rules, thousandths_up};
use geom::{Bounds, Path, Point};

/// Regions of the air with the channels of ports.
#[derive(Default)]
pub(crate) struct OpenedRegions {
    /// Boundaries with channels, and walls.
    pub regions: Regions,
    /// The boundaries without the channels.
    pub closed: Vec<Path>,
    pub mouths: Vec<Mouth>,
    /// The numbers of the ports that edges have taken, with a channel or with a fault.
    pub taken_ports: Vec<usize>,
}

/// The regions of `edges` with a channel through an outer boundary for each port. Where seams are drawn, a port that is too far away may
/// belong to one of them.
pub(crate) fn opened_regions(
    mut regions: Regions,
    edges: &MendedEdges,
    ports: &[DrawnPort],
    has_seams: bool,
    rules: &Rules,
) -> Noted<OpenedRegions> {
    let mut notes = SealingNotes::default();
    let closed = regions.boundaries.iter().map(|boundary| boundary.path.clone()).collect();
    let outer = regions.boundaries.iter().filter(|boundary| boundary.outer);
    let outlines = OpenedEdges {
        edges: outer.map(|boundary| boundary.path.clone()).collect(),
        mouths: edges.mouths.clone(),
        taken_ports: edges.mouths.iter().map(|mouth| mouth.port).collect(),
    };
    let opening = Opening { half_band: 0.0, length: rules.band + rules.allowance, may_wait: has_seams };
    let (OpenedEdges { edges, mouths, taken_ports }, pass_notes) =
        open_ports(outlines, ports, &opening, rules);
    notes += pass_notes;
    let outer = regions.boundaries.iter_mut().filter(|boundary| boundary.outer);
    for (boundary, edge) in outer.zip(edges) {
        boundary.path = edge;
    }
    (OpenedRegions { regions, closed, mouths, taken_ports }, notes)
}

/// How ports open edges.
pub(crate) struct Opening {
    /// Half a band where the edges are its centre lines, 0 where they are those of the air, mm.
    pub half_band: f64,
    /// Length of a channel past the edge, mm.
    pub length: f64,
    /// Whether ports that are too far away wait for other edges.
    pub may_wait: bool,
}

/// Closed outer edges as far as ports have opened them.
pub(crate) struct OpenedEdges {
    pub edges: Vec<Path>,
    pub mouths: Vec<Mouth>,
    /// The numbers of the ports that edges have taken, with a channel or with a fault.
    pub taken_ports: Vec<usize>,
}

/// The edges with channels for those of `ports` that are not taken, each through the edge that is nearest.
///
/// Nearness is that to the edges as they are drawn, before other ports open them. A port without a channel is taken, too: its fault is
/// told once.
pub(crate) fn open_ports(
    mut opened: OpenedEdges,
    ports: &[DrawnPort],
    opening: &Opening,
    rules: &Rules,
) -> Noted<OpenedEdges> {
    let mut notes = SealingNotes::default();
    let drawn_edges = opened.edges.clone();
    let bounds: Vec<Bounds> = drawn_edges.iter().map(Path::bounds).collect();
    let half_band = opening.half_band;
    let size = ChannelSize {
        width: rules.port_width + 2.0 * half_band,
        length: opening.length,
        overrun: rules.overrun + 1.0,
    };
    for (number, port) in ports.iter().enumerate() {
        let place = port.place.middle();
        if opened.taken_ports.contains(&number) {
            continue;
        }
        let Some(nearest) = nearest_path(&drawn_edges, &bounds, place) else { continue };
        let (path, original) = (&opened.edges[nearest], &drawn_edges[nearest]);
        let passage = unambiguous(&port.place, &drawn_edges)
            .and_then(|()| rounded_channel(path, original, number, &port.place, size, rules.join));
        match passage {
            Ok((path, mouth)) => {
                opened.edges[nearest] = path;
                opened.mouths.push(Mouth { half: mouth.half - half_band, ..mouth });
            }
            Err(NoChannel::Far(_)) if opening.may_wait => continue,
            Err(reason) => {
                let reason = obstacle(reason, place, &opened.mouths, rules);
                notes.faults.push(no_channel(reason, port, rules));
            }
        }
        opened.taken_ports.push(number);
    }
    (opened, notes)
}

/// Parts of `join` by which a channel may be narrower than the hose needs: a tube as wide as the hose, to the rounding of the drawing, takes
/// it.
const ROUNDED: [f64; 4] = [0.125, 0.25, 0.5, 1.0];

/// The channel through `path` for the port number `number`, as wide as it needs or narrower by the rounding of a drawing.
fn rounded_channel(
    path: &Path,
    original: &Path,
    number: usize,
    place: &PortPlace,
    size: ChannelSize,
    join: f64,
) -> Result<(Path, Mouth), NoChannel> {
    let reason = match channel(path, original, number, place, size) {
        Err(reason @ (NoChannel::Narrow { .. } | NoChannel::Deep { .. })) => reason,
        result => return result,
    };
    let mut widths = ROUNDED.iter().map(|part| size.width - part * join);
    let narrower =
        widths.find_map(|width| channel(path, original, number, place, ChannelSize { width, ..size }).ok());
    narrower.ok_or(reason)
}

/// The number of the first path that is nearest to `p`. `bounds` are the boxes around `paths`.
fn nearest_path(paths: &[Path], bounds: &[Bounds], p: Point) -> Option<usize> {
    let mut nearest: Option<(f64, usize)> = None;
    for (number, (path, bounds)) in paths.iter().zip(bounds).enumerate() {
        if nearest.is_some_and(|(least, _)| bounds.distance(p) > least) {
            continue;
        }
        let distance = path.distance(p);
        if nearest.is_none_or(|(least, _)| distance < least) {
            nearest = Some((distance, number));
        }
    }
    nearest.map(|(_, number)| number)
}

/// The `reason` for which there is no channel at `place`: the channel of `mouths` which takes the room, if one does.
fn obstacle(reason: NoChannel, place: Point, mouths: &[Mouth], rules: &Rules) -> NoChannel {
    let aside_most = rules.port_width / 2.0 + 2.0 * rules.band;
    match reason {
        NoChannel::Narrow { .. } | NoChannel::Deep { .. }
            if mouths.iter().any(|mouth| mouth.is_beside(place, aside_most)) =>
        {
            NoChannel::Beside
        }
        reason => reason,
    }
}

/// The faults of ports that no edge took. Of ports with one name the first has the fault.
pub(crate) fn lost_ports(ports: &[DrawnPort], taken_ports: &[usize], rules: &Rules) -> Vec<ShapeFault> {
    let mut faults: Vec<ShapeFault> = Vec::new();
    for (number, port) in ports.iter().enumerate() {
        let is_known = faults.iter().any(|fault| fault.names == [port.name.as_str()]);
        if !taken_ports.contains(&number) && !is_known {
            faults.push(no_channel(NoChannel::Far(f64::INFINITY), port, rules));
        }
    }
    faults
}

/// The fault of a port that has no channel.
///
/// What is wrong is the reason, measured where there is something to measure. The remedy names the place or the size that would do.
fn no_channel(reason: NoChannel, port: &DrawnPort, rules: &Rules) -> ShapeFault {
    let (place, port_name) = (port.place.middle(), quoted(&port.name));
    let (code, place, [value, limit], finding, remedy) = match reason {
        NoChannel::Far(distance) => {
            let limit = rules.farthest_port();
            let (finding, remedy) = far_port(port, distance, limit);
            (ShapeCode::LostPort, place, [distance, limit], finding, remedy)
        }
        NoChannel::Beside => {
            let finding = format!("port {port_name} lies in the channel of another port, or beside it");
            let remedy = format!("{}, or remove it", rules.ports_apart());
            (ShapeCode::LostPort, place, [f64::NAN; 2], finding, remedy)
        }
        NoChannel::Along => {
            let finding = format!("port {port_name} runs along the edge");
            let remedy = "draw a short line across the edge, or a point on it".to_owned();
            (ShapeCode::LostPort, place, [f64::NAN; 2], finding, remedy)
        }
        NoChannel::Twice(places) => {
            let list: Vec<String> = places.iter().map(|p| format!("X {:.3} Y {:.3}", p.x, p.y)).collect();
            let (count, list) = (places.len(), list.join(", "));
            let finding = format!("port {port_name} crosses outer edges {count} times ({list})");
            let remedy = "draw a short line for each port, with one end in the air and one outside";
            (ShapeCode::LostPort, place, [f64::NAN; 2], finding, remedy.to_owned())
        }
        NoChannel::Blocked { distance, place } => {
            let finding =
                format!("the channel of port {port_name} meets the edge {distance:.3} mm in front of it");
            (ShapeCode::ChannelOverlap, place, [distance, f64::NAN], finding, rules.room_in_front())
        }
        NoChannel::Narrow { width, place } => {
            let hose = rules.port_width;
            let finding = format!("the edge at port {port_name} has room for {width:.3} mm only");
            let remedy = format!("the hose needs {hose:.3} mm: make the edge longer, or take a thinner hose");
            (ShapeCode::PortTooWide, place, [width, hose], finding, remedy)
        }
        NoChannel::Deep { depth, largest, place } => {
            let back = thousandths_up(depth);
            let finding = format!("across the hose at port {port_name} the edge falls back by {back:.3} mm");
            let remedy = format!(
                "it may by at most {largest:.3} mm: put the port on a straighter or wider part of the edge, or take a \
                 thinner hose"
            );
            (ShapeCode::PortTooWide, place, [depth, largest], finding, remedy)
        }
    };
    ShapeFault {
        names: vec![port.name.clone()],
        found: value,
        allowed: limit,
        ..ShapeFault::new(code, place, finding, remedy)
    }
}

/// The finding and the remedy of a port `distance` mm from the nearest outer edge; infinite where there is none.
fn far_port(port: &DrawnPort, distance: f64, allowed: f64) -> (String, String) {
    let port_name = quoted(&port.name);
    if distance.is_finite() {
        let finding = format!("port {port_name} lies {distance:.3} mm from the nearest outer edge");
        (finding, format!("put it on an edge, or at most {allowed:.3} mm from it"))
    } else {
        let finding = format!("port {port_name} is not on the outer edge of a chamber");
        (finding, "draw a closed edge of air, or give a layer that role".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use geom::{Path, Point};

    use crate::{DrawnCurve, DrawnPort, PortPlace, Rules, Sketch, sealed_shape};

    /// Necks as wide as the hose or wider, whose sides are not quite parallel, with a closed end and an open one.
    /// Each is drawn once as a polygon and once open at the port.
    #[test]
    fn a_neck_may_flare_by_the_rounding_of_a_drawing() {
        let p = Point::new;
        for (length, flare, skew) in [5.0, 20.0, 60.0]
            .into_iter()
            .flat_map(|length| [0.0, 0.0005, 0.002, -0.002, 0.02, -0.02, 0.1].map(|flare| (length, flare)))
            .flat_map(|(length, flare)| [0.0, 1.0].map(|skew| (length, flare, skew)))
        {
            for half in [2.9995, 3.0, 3.005, 4.0, 6.0] {
                let ends = [
                    p(-length, -half - 0.5 * flare * (1.0 - skew)),
                    p(0.0, -half),
                    p(0.0, -30.0),
                    p(100.0, -30.0),
                    p(100.0, 30.0),
                    p(0.0, 30.0),
                    p(0.0, half),
                    p(-length, half + 0.5 * flare),
                ];
                for path in [Path::polyline(&ends), Path::polygon(&ends)] {
                    let air = vec![DrawnCurve { name: "edge".to_owned(), path }];
                    let place = PortPlace::Across([p(-length - 3.0, 0.0), p(0.4 - length, 0.0)]);
                    let ports = vec![DrawnPort { name: "port".to_owned(), place }];
                    let sealing = sealed_shape(&Sketch { air, ports, ..Sketch::default() }, &Rules::SAMPLE);
                    let case = format!("length {length}, flare {flare}, skew {skew}, half {half}");
                    let width =
                        sealing.unwrap_or_else(|faults| panic!("{case}: {faults:?}")).shape.ports[0].width;
                    assert!(width >= Rules::SAMPLE.port_width - Rules::SAMPLE.join - 1e-9, "{case}: {width}");
                }
            }
        }
    }
}
