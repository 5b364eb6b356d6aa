//! Drawn ports: copies are merged, and those that no edge takes are faults.

use crate::shape::fault::{Repair, ShapeCode, quoted};
use crate::shape::mouth::{Mouth, NoChannel};
use crate::shape::notes::SealingNotes;
use crate::shape::sketch::{DrawnPort, PortPlace, Rules, thousandths_up};
use inflatable::geom::Point;

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

/// The reason `why` there is no channel at `place`: the channel of `mouths` which takes the room, if one does.
pub(super) fn reason(why: NoChannel, place: Point, mouths: &[Mouth], rules: &Rules) -> NoChannel {
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
    match why {
        NoChannel::Far(distance) => {
            let allowed = rules.farthest_port();
            let name = quoted(&names);
            let text = if distance.is_finite() {
                let what = format!("port {name} lies {distance:.3} mm from the nearest outer edge");
                (what, format!("put it on an edge, or at most {allowed:.3} mm from it"))
            } else {
                let what = format!("port {name} is not on the outer edge of a chamber");
                (what, "draw a closed edge of air, or give a layer that role".to_owned())
            };
            notes.fault(ShapeCode::LostPort, &names, place, text, [*distance, allowed]);
        }
        NoChannel::Beside => {
            let what = format!("port {} lies in the channel of another port, or beside it", quoted(&names));
            let remedy = format!("{}, or remove it", rules.ports_apart());
            notes.fault(ShapeCode::LostPort, &names, place, (what, remedy), [f64::NAN; 2]);
        }
        NoChannel::Blocked { far, at } => {
            let what =
                format!("the channel of port {} meets the edge {far:.3} mm in front of it", quoted(&names));
            let numbers = [*far, f64::NAN];
            notes.fault(ShapeCode::BandsOverlap, &names, *at, (what, rules.room_in_front()), numbers);
        }
        NoChannel::Along => {
            let what = format!("port {} runs along the edge", quoted(&names));
            let remedy = "draw a short line across the edge, or a point on it".to_owned();
            notes.fault(ShapeCode::LostPort, &names, place, (what, remedy), [f64::NAN; 2]);
        }
        NoChannel::Twice(places) => {
            let list: Vec<String> = places.iter().map(|p| format!("X {:.3} Y {:.3}", p.x, p.y)).collect();
            let what = format!(
                "port {} crosses outer edges {} times ({})",
                quoted(&names),
                places.len(),
                list.join(", ")
            );
            let remedy =
                "draw a short line for each port, with one end in the air and one outside".to_owned();
            notes.fault(ShapeCode::LostPort, &names, place, (what, remedy), [f64::NAN; 2]);
        }
        NoChannel::Narrow { width, at } => {
            let what = format!("the edge at port {} has room for {width:.3} mm only", quoted(&names));
            let remedy = format!(
                "the hose needs {:.3} mm: make the edge longer, or take a thinner hose",
                rules.port_width
            );
            notes.fault(ShapeCode::PortTooWide, &names, *at, (what, remedy), [*width, rules.port_width]);
        }
        NoChannel::Deep { depth, most, at } => {
            let what = format!(
                "across the hose at port {} the edge falls back by {:.3} mm",
                quoted(&names),
                thousandths_up(*depth)
            );
            let remedy = format!(
                "it may by at most {most:.3} mm: put the port on a straighter or wider part of the edge, or take a \
                 thinner hose"
            );
            notes.fault(ShapeCode::PortTooWide, &names, *at, (what, remedy), [*depth, *most]);
        }
    }
}
