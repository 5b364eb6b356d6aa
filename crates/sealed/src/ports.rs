//! Drawn ports: copies are merged, each opens the edge that it lies on, and those that no edge takes are faults.

use crate::fault::{Repair, ShapeCode, quoted};
use crate::mouth::{Mouth, NoChannel, channel, unambiguous};
use crate::notes::SealingNotes;
use crate::sketch::{DrawnPort, PortPlace, Rules, Sketch, thousandths_up};
use geom::{Bounds, Path, Point};

/// The ports, each that was drawn twice at one place once.
pub(super) fn once(ports: &[DrawnPort], join: f64, notes: &mut SealingNotes) -> Vec<DrawnPort> {
    let near = |a: Point, b: Point| a.distance(b) <= join;
    let alike = |a: &PortPlace, b: &PortPlace| match (a, b) {
        (PortPlace::At(a), PortPlace::At(b)) => near(*a, *b),
        (PortPlace::Across([a, b]), PortPlace::Across([c, d])) => {
            near(*a, *c) && near(*b, *d) || near(*a, *d) && near(*b, *c)
        }
        _ => false,
    };
    let mut kept: Vec<DrawnPort> = Vec::new();
    for port in ports {
        let Some(first) = kept.iter().find(|known| alike(&known.place, &port.place)) else {
            kept.push(port.clone());
            continue;
        };
        let names = vec![first.name.clone(), port.name.clone()];
        let what = format!("a port drawn twice in {} merged", quoted(&names));
        notes.repairs.push(Repair { place: port.place.middle(), what, names });
    }
    kept
}

/// How ports open edges.
pub(super) struct Opening {
    /// Half a band where the edges are its centre lines, 0 where they are those of the air, mm.
    pub half: f64,
    /// Length of a channel past the edge, mm.
    pub length: f64,
    /// Whether ports that are too far away wait for other edges.
    pub may_wait: bool,
}

/// Parts of `join` by which a channel may be narrower than the hose needs: a tube as wide as the hose, to the rounding of the drawing, takes
/// it.
const ROUNDED: [f64; 4] = [0.125, 0.25, 0.5, 1.0];

/// Channels through the outer `edges` for the ports that are not taken.
pub(super) fn open_ports(
    sketch: &Sketch,
    rules: &Rules,
    opening: &Opening,
    mut edges: Vec<&mut Path>,
    mouths: &mut Vec<Mouth>,
    taken: &mut Vec<usize>,
    notes: &mut SealingNotes,
) {
    let drawn: Vec<Path> = edges.iter().map(|path| (**path).clone()).collect();
    let around: Vec<Bounds> = drawn.iter().map(Path::bounds).collect();
    let Opening { half, length, may_wait } = *opening;
    let (width, beyond) = (rules.port_width + 2.0 * half, rules.overrun + 1.0);
    for (number, port) in sketch.ports.iter().enumerate() {
        let place = port.place.middle();
        if taken.contains(&number) {
            continue;
        }
        let Some(nearest) = nearest_path(drawn.iter().zip(around.iter().copied()), place) else { continue };
        let paths = (&*edges[nearest], &drawn[nearest]);
        let rounded = |why| match why {
            NoChannel::Narrow { .. } | NoChannel::Deep { .. } => {
                let mut widths = ROUNDED.iter().map(|part| width - part * rules.join);
                widths
                    .find_map(|width| channel(paths, number, &port.place, width, length, beyond).ok())
                    .ok_or(why)
            }
            why => Err(why),
        };
        let made = unambiguous(&port.place, &drawn)
            .and_then(|()| channel(paths, number, &port.place, width, length, beyond).or_else(rounded));
        match made {
            Ok((path, mouth)) => {
                *edges[nearest] = path;
                mouths.push(Mouth { half: mouth.half - half, ..mouth });
            }
            Err(NoChannel::Far(_)) if may_wait => continue,
            Err(why) => no_channel(&reason(why, place, mouths, rules), &port.name, place, rules, notes),
        }
        taken.push(number);
    }
}

/// The number of the first path that is nearest to `p`; each comes with its box.
fn nearest_path<'a>(paths: impl Iterator<Item = (&'a Path, Bounds)>, p: Point) -> Option<usize> {
    let mut best: Option<(f64, usize)> = None;
    for (number, (path, around)) in paths.enumerate() {
        if best.is_some_and(|(least, _)| around.distance(p) > least) {
            continue;
        }
        let far = path.distance(p);
        if best.is_none_or(|(least, _)| far < least) {
            best = Some((far, number));
        }
    }
    best.map(|(_, number)| number)
}

/// The reason `why` there is no channel at `place`: the channel of `mouths` which takes the room, if one does.
fn reason(why: NoChannel, place: Point, mouths: &[Mouth], rules: &Rules) -> NoChannel {
    let aside = rules.port_width / 2.0 + 2.0 * rules.band;
    match why {
        NoChannel::Narrow { .. } | NoChannel::Deep { .. }
            if mouths.iter().any(|mouth| mouth.is_beside(place, aside)) =>
        {
            NoChannel::Beside
        }
        why => why,
    }
}

/// Notes the fault of a port that has no channel for the reason `why`.
pub(super) fn no_channel(why: &NoChannel, name: &str, place: Point, rules: &Rules, notes: &mut SealingNotes) {
    let names = [name.to_owned()];
    let (port, unknown) = (quoted(&names), [f64::NAN; 2]);
    let lost = |notes: &mut SealingNotes, what: String, remedy: &str, numbers: [f64; 2]| {
        notes.fault(ShapeCode::LostPort, &names, place, (what, remedy), numbers);
    };
    match why {
        NoChannel::Far(distance) if distance.is_finite() => {
            let allowed = rules.farthest_port();
            let what = format!("port {port} lies {distance:.3} mm from the nearest outer edge");
            let remedy = format!("put it on an edge, or at most {allowed:.3} mm from it");
            lost(notes, what, &remedy, [*distance, allowed]);
        }
        NoChannel::Far(distance) => {
            let what = format!("port {port} is not on the outer edge of a chamber");
            let remedy = "draw a closed edge of air, or give a layer that role";
            lost(notes, what, remedy, [*distance, rules.farthest_port()]);
        }
        NoChannel::Beside => {
            let what = format!("port {port} lies in the channel of another port, or beside it");
            lost(notes, what, &format!("{}, or remove it", rules.ports_apart()), unknown);
        }
        NoChannel::Along => {
            let remedy = "draw a short line across the edge, or a point on it";
            lost(notes, format!("port {port} runs along the edge"), remedy, unknown);
        }
        NoChannel::Twice(places) => {
            let list: Vec<String> = places.iter().map(|p| format!("X {:.3} Y {:.3}", p.x, p.y)).collect();
            let (count, list) = (places.len(), list.join(", "));
            let what = format!("port {port} crosses outer edges {count} times ({list})");
            let remedy = "draw a short line for each port, with one end in the air and one outside";
            lost(notes, what, remedy, unknown);
        }
        NoChannel::Blocked { far, at } => {
            let what = format!("the channel of port {port} meets the edge {far:.3} mm in front of it");
            let text = (what, rules.room_in_front());
            notes.fault(ShapeCode::ChannelOverlap, &names, *at, text, [*far, f64::NAN]);
        }
        NoChannel::Narrow { width, at } => {
            let needed = rules.port_width;
            let what = format!("the edge at port {port} has room for {width:.3} mm only");
            let remedy =
                format!("the hose needs {needed:.3} mm: make the edge longer, or take a thinner hose");
            notes.fault(ShapeCode::PortTooWide, &names, *at, (what, remedy), [*width, needed]);
        }
        NoChannel::Deep { depth, most, at } => {
            let back = thousandths_up(*depth);
            let what = format!("across the hose at port {port} the edge falls back by {back:.3} mm");
            let remedy = format!(
                "it may by at most {most:.3} mm: put the port on a straighter or wider part of the edge, or take a \
                 thinner hose"
            );
            notes.fault(ShapeCode::PortTooWide, &names, *at, (what, remedy), [*depth, *most]);
        }
    }
}

#[cfg(test)]
mod tests {
    use geom::{Path, Point};

    use crate::{DrawnCurve, DrawnPort, PortPlace, Rules, Sketch, sealed_shape};

    const RULES: Rules = Rules {
        band: 2.0,
        allowance: 8.0,
        join: 0.05,
        overlap: 5.0,
        port_width: 6.0,
        overrun: 1.0,
        least_passage: 5.0,
        flange: 10.0,
    };

    /// Necks as wide as the hose or wider, whose sides are not quite parallel, with a closed end and an open one.
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
                for path in [Path::through(&ends), Path::polygon(&ends)] {
                    let air = vec![DrawnCurve { name: "edge".to_owned(), path }];
                    let place = PortPlace::Across([p(-length - 3.0, 0.0), p(0.4 - length, 0.0)]);
                    let ports = vec![DrawnPort { name: "port".to_owned(), place }];
                    let sealing = sealed_shape(&Sketch { air, ports, ..Sketch::default() }, &RULES);
                    let what = format!("length {length}, flare {flare}, skew {skew}, half {half}");
                    let width =
                        sealing.unwrap_or_else(|faults| panic!("{what}: {faults:?}")).shape.ports[0].width;
                    assert!(width >= RULES.port_width - RULES.join - 1e-9, "{what}: {width}");
                }
            }
        }
    }
}
