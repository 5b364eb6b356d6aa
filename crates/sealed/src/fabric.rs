//! Fabric between edges of the air: it has room for the bands of both, or is a wall that is sealed once.

use crate::bottleneck::{Bottleneck, GapCurve, bottlenecks};
use crate::fault::{Quoted, SealingNotes, ShapeCode, ShapeFault, flank_text, named, quoted};
use crate::mouth::Mouth;
use crate::narrow_places::narrow_places;
use crate::ports::OpenedRegions;
use crate::sketch::{DrawnPort, Rules};
use geom::Enclosures;

/// What the faults of fabric tell of a sketch.
pub(crate) struct FabricSketch<'a> {
    pub ports: &'a [DrawnPort],
    /// Whether cuts are drawn. Without them, edges far enough from each other are pieces of their own.
    pub has_cuts: bool,
}

/// Faults where fabric between two edges has no room for their bands.
pub(super) fn narrow_fabric(
    opened: &OpenedRegions,
    names: &[String],
    sketch: &FabricSketch<'_>,
    rules: &Rules,
) -> SealingNotes {
    let mut notes = SealingNotes::default();
    let boundaries = &opened.regions.boundaries;
    let curves: Vec<GapCurve<'_>> =
        boundaries.iter().map(|edge| GapCurve { path: &edge.path, joined: [false; 2] }).collect();
    let air = Enclosures::new(boundaries.iter().map(|edge| &edge.path));
    let two_bands = 2.0 * rules.band;
    let mut necks = notes.unless_crowded(bottlenecks(&curves, two_bands - 1e-6));
    necks.retain(|neck| {
        let is_wall = (neck.width - rules.band).abs() <= rules.join;
        let is_fabric = air.enclosing(neck.middle()).len().is_multiple_of(2);
        is_fabric && (!is_wall || channel_behind(neck, opened, two_bands).is_some())
    });
    let places = narrow_places(necks, &curves, two_bands);
    notes.faults.extend(places.iter().map(|neck| thin_fabric(neck, opened, names, sketch, rules)));
    notes
}

/// The channel that ends at most `distance` mm behind a neck.
fn channel_behind<'a>(neck: &Bottleneck, opened: &'a OpenedRegions, distance: f64) -> Option<&'a Mouth> {
    opened.mouths.iter().find(|mouth| mouth.is_in_front(neck.middle(), distance))
}

/// The fault of fabric too narrow for two bands: between edges, beside the channel of a port, in front of it, or between two channels.
///
/// A side of the neck belongs to a channel if it lies on one outside the drawn edge, else to the curves of its boundary. The remedy is to
/// move the port where there is one.
fn thin_fabric(
    neck: &Bottleneck,
    opened: &OpenedRegions,
    names: &[String],
    sketch: &FabricSketch<'_>,
    rules: &Rules,
) -> ShapeFault {
    let (width, two_bands) = (neck.width, 2.0 * rules.band);
    let boundaries = &opened.regions.boundaries;
    let (mut sources, mut channels): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    for (curve, p) in neck.curves.into_iter().zip(neck.points) {
        match opened.mouths.iter().find(|mouth| mouth.has_edge(p)) {
            Some(mouth) => channels.push(mouth.port),
            None => sources.extend(&boundaries[curve].sources),
        }
    }
    sources.dedup();
    channels.dedup();
    let mut ports: Vec<String> = channels.into_iter().map(|port| sketch.ports[port].name.clone()).collect();
    let edges = named(&sources, names);
    let port_behind =
        channel_behind(neck, opened, two_bands).map(|mouth| sketch.ports[mouth.port].name.clone());
    let (finding, remedy) = match (&ports[..], port_behind) {
        (ports @ [_, _, ..], _) => {
            let place = format!("between the channels of ports {}", Quoted(ports));
            (format!("{width:.3} mm of fabric {place}"), rules.ports_apart())
        }
        (_, Some(port)) => {
            let place = format!("in front of the channel of port {}", quoted(&port));
            ports = vec![port];
            (format!("{width:.3} mm of fabric {place}"), rules.room_in_front())
        }
        ([_], None) => {
            let place = format!("between {}", flank_text(&edges, &ports, "edge"));
            let remedy =
                format!("move the port, so that at least {two_bands} mm of fabric lie beside its channel");
            (format!("{width:.3} mm of fabric {place} are too narrow for two bands"), remedy)
        }
        ([], None) => {
            let [a, b] = neck.curves;
            let are_apart = a != b && boundaries[a].outer && boundaries[b].outer;
            let pieces = if are_apart && !sketch.has_cuts { " of two pieces" } else { "" };
            let remedy = format!(
                "make it {} mm, for a wall that is sealed once, or at least {two_bands} mm, for two bands{pieces}",
                rules.band
            );
            let place = format!("between edges of {}", Quoted(&edges));
            (format!("{width:.3} mm of fabric {place} are too narrow for two bands"), remedy)
        }
    };
    let code = if ports.is_empty() { ShapeCode::BandsOverlap } else { ShapeCode::ChannelOverlap };
    let fault = ShapeFault::new(code, neck.middle(), finding, remedy);
    ShapeFault { names: [edges, ports].concat(), found: width, allowed: two_bands, ..fault }
}
