//! Fabric between edges of the air: it has room for the bands of both, or is a wall that is sealed once.

use crate::air::Air;
use crate::bottleneck::{Bottleneck, GapCurve, bottlenecks};
use crate::fault::{ShapeCode, ShapeFault, quoted};
use crate::flanks::flank_text;
use crate::mouth::Mouth;
use crate::narrow_places::narrow_places;
use crate::notes::{SealingNotes, named};
use crate::sketch::{Rules, Sketch};
use geom::Enclosures;

/// Faults where fabric between two edges has no room for their bands.
pub(super) fn necks(
    (air, mouths): (&Air, &[Mouth]),
    sketch: &Sketch,
    rules: &Rules,
    names: &[String],
    notes: &mut SealingNotes,
) {
    let curves: Vec<GapCurve<'_>> =
        air.boundaries.iter().map(|edge| GapCurve { path: &edge.path, joined: [false; 2] }).collect();
    let closed = Enclosures::new(air.boundaries.iter().map(|edge| &edge.path));
    let both = 2.0 * rules.band;
    let mut fabric = notes.unless_crowded(bottlenecks(&curves, both - 1e-6));
    fabric.retain(|neck| {
        let is_wall = (neck.width - rules.band).abs() <= rules.join;
        let is_in_front = || mouths.iter().any(|mouth| mouth.is_in_front(neck.middle(), both));
        closed.around(neck.middle()).len().is_multiple_of(2) && (!is_wall || is_in_front())
    });
    for neck in narrow_places(fabric, &curves, both) {
        let fault = thin_fabric(&neck, (air, mouths), sketch, rules, names);
        notes.faults.push(fault);
    }
}

/// The fault of fabric too narrow for two bands: between edges, beside the channel of a port, in front of it, or between two channels.
fn thin_fabric(
    neck: &Bottleneck,
    (air, mouths): (&Air, &[Mouth]),
    sketch: &Sketch,
    rules: &Rules,
    names: &[String],
) -> ShapeFault {
    let (width, both) = (neck.width, 2.0 * rules.band);
    let (mut sources, mut channels): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    for (curve, p) in neck.curves.into_iter().zip(neck.points) {
        match mouths.iter().find(|mouth| mouth.has_edge(p)) {
            Some(mouth) => channels.push(mouth.port),
            None => sources.extend(&air.boundaries[curve].sources),
        }
    }
    sources.dedup();
    channels.dedup();
    let port_name = |port: usize| sketch.ports[port].name.clone();
    let mut ports: Vec<String> = channels.into_iter().map(port_name).collect();
    let edges = named(&sources, names);
    let in_front =
        mouths.iter().find(|mouth| mouth.is_in_front(neck.middle(), both)).map(|mouth| port_name(mouth.port));
    let (what, remedy) = match (&ports[..], in_front) {
        (ports @ [_, _, ..], _) => {
            let place = format!("between the channels of ports {}", quoted(ports));
            (format!("{width:.3} mm of fabric {place}"), rules.ports_apart())
        }
        (_, Some(port)) => {
            let place = format!("in front of the channel of port {}", quoted(std::slice::from_ref(&port)));
            ports = vec![port];
            (format!("{width:.3} mm of fabric {place}"), rules.room_in_front())
        }
        ([_], None) => {
            let place = format!("between {}", flank_text(&edges, &ports, "edge"));
            let remedy =
                format!("move the port, so that at least {both} mm of fabric lie beside its channel");
            (format!("{width:.3} mm of fabric {place} are too narrow for two bands"), remedy)
        }
        ([], None) => {
            let [a, b] = neck.curves;
            let apart = a != b && air.boundaries[a].outer && air.boundaries[b].outer;
            let pieces = if apart && sketch.cuts.is_empty() { " of two pieces" } else { "" };
            let remedy = format!(
                "make it {} mm, for a wall that is sealed once, or at least {both} mm, for two bands{pieces}",
                rules.band
            );
            let place = format!("between edges of {}", quoted(&edges));
            (format!("{width:.3} mm of fabric {place} are too narrow for two bands"), remedy)
        }
    };
    let code = if ports.is_empty() { ShapeCode::BandsOverlap } else { ShapeCode::ChannelOverlap };
    let names = [edges, ports].concat();
    ShapeFault::new(code, &names, neck.middle(), (what, remedy), [width, both])
}
