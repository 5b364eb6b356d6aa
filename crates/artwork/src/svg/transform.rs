//! Transforms of elements, and their origins.

use roxmltree::Node;
use svgtypes::{TransformListParser, TransformListToken as Token};

use super::style::Cascade;
use super::viewport::Viewport;
use crate::affine::Affine;

/// The transform of an element in a viewport, about its `transform-origin`; the reason if one of the two is not read.
pub(super) fn declared(
    node: Node<'_, '_>,
    cascade: &Cascade<'_, '_>,
    viewport: Viewport,
) -> Result<Affine, String> {
    let map = listed(node).ok_or("Its transform is faulty.")?;
    let Some(origin) = cascade.value("transform-origin").filter(|_| map != Affine::IDENTITY) else {
        return Ok(map);
    };
    if cascade.value("transform-box").is_some_and(|value| value != "view-box") {
        return Err(
            "The origin of its transform depends on its own box (transform-box), which is not read.".into()
        );
    }
    let [x, y] = origin_of(origin, viewport)?;
    Ok(Affine::translate(x, y).following(&map).following(&Affine::translate(-x, -y)))
}

/// The transform of a part of a clip; `None` if it is malformed or has an origin.
pub(super) fn plain(node: Node<'_, '_>) -> Option<Affine> {
    listed(node).filter(|_| node.attribute("transform-origin").is_none())
}

/// The attribute `transform`; `None` if it is malformed.
fn listed(node: Node<'_, '_>) -> Option<Affine> {
    let mut map = Affine::IDENTITY;
    for token in TransformListParser::from(node.attribute("transform").unwrap_or_default()) {
        map = map.following(&match token.ok()? {
            Token::Matrix { a, b, c, d, e, f } => Affine::new([a, b, c, d, e, f]),
            Token::Translate { tx, ty } => Affine::translate(tx, ty),
            Token::Scale { sx, sy } => Affine::scale(sx, sy),
            Token::Rotate { angle } => Affine::rotate(angle),
            Token::SkewX { angle } => Affine::new([1.0, 0.0, libm::tan(angle.to_radians()), 1.0, 0.0, 0.0]),
            Token::SkewY { angle } => Affine::new([1.0, libm::tan(angle.to_radians()), 0.0, 1.0, 0.0, 0.0]),
        });
    }
    Some(map)
}

/// The point of a `transform-origin`, user units: lengths, or parts of the viewport in per cent or words. A single word or length
/// leaves the other one in the middle; a third length is along z.
fn origin_of(text: &str, viewport: Viewport) -> Result<[f64; 2], String> {
    let text = text.replace(',', " ");
    let mut words: Vec<&str> = text.split_ascii_whitespace().take(2).collect();
    if words.len() == 1 {
        words.push("center");
    }
    // Words say their axis, so they may be in either order.
    if matches!(words[..], ["top" | "bottom", _] | [_, "left" | "right"]) {
        words.reverse();
    }
    let mut origin = [0.0; 2];
    for (axis, word) in words.iter().enumerate().take(2) {
        let part = match (axis, *word) {
            (0, "left") | (1, "top") => "0",
            (0, "right") | (1, "bottom") => "100%",
            (_, "center") => "50%",
            (_, length) => length,
        };
        origin[axis] = viewport.length("transform-origin", part, axis)?;
    }
    Ok(origin)
}
