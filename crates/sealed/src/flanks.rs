//! **Flanks**: the two bands beside a place, by the words of a message. A channel's band belongs to its port, not to a drawn curve.

use crate::bottleneck::Bottleneck;
use crate::channel::ChannelSides;
use crate::fault::quoted;
use crate::layout::{Layout, Line};
use crate::sketch::Sketch;
use geom::Point;

/// The bands on both sides of a place.
pub(super) struct Flanks {
    /// The curves and ports, in that order.
    pub names: Vec<String>,
    /// "the bands of 'a' and 'b'", "the channel of port 'p' and the band of 'a'".
    pub text: String,
    /// The ports whose channels they are.
    pub ports: Vec<String>,
}

impl Flanks {
    /// The bands beside `neck`.
    pub(super) fn of(
        neck: &Bottleneck,
        layout: &Layout,
        channels: &[ChannelSides<'_>],
        sketch: &Sketch,
    ) -> Self {
        Self::at(neck.curves, neck.points, &layout.lines, channels, sketch)
    }

    /// The bands along `curves`, each at its point.
    pub(super) fn at(
        curves: [usize; 2],
        points: [Point; 2],
        lines: &[Line],
        channels: &[ChannelSides<'_>],
        sketch: &Sketch,
    ) -> Self {
        let (mut curve_names, mut numbers): (Vec<String>, Vec<usize>) = (Vec::new(), Vec::new());
        for (curve, p) in curves.into_iter().zip(points) {
            // Bands that cross share the point: the channel's has its ends at the mouth.
            let side =
                channels.iter().find(|channel| channel.has_outside(p) && channel.ends(&lines[curve].path));
            match side {
                Some(channel) => numbers.push(channel.mouth.port),
                None => curve_names.extend(lines[curve].names.clone()),
            }
        }
        numbers.dedup();
        let ports: Vec<String> = numbers.iter().map(|port| sketch.ports[*port].name.clone()).collect();
        let text = flank_text(&curve_names, &ports, "band");
        curve_names.dedup();
        Self { names: [&curve_names[..], &ports[..]].concat(), text, ports }
    }
}

/// Curves and ports as the two sides of a place; along a curve there is a `word`, such as "band".
pub(super) fn flank_text(curves: &[String], ports: &[String], word: &str) -> String {
    match (curves, ports) {
        (curves, []) => format!("the {word}s of {}", quoted(curves)),
        ([], [port]) => format!("the channel of port {}", quoted(std::slice::from_ref(port))),
        ([], ports) => format!("the channels of ports {}", quoted(ports)),
        (curves, ports) => {
            format!("the channel of port {} and the {word} of {}", quoted(ports), quoted(curves))
        }
    }
}
