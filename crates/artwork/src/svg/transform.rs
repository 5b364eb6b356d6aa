//! The attribute `transform`.

use roxmltree::Node;
use svgtypes::{TransformListParser, TransformListToken as Token};

use crate::affine::Affine;

/// The transform of an element; `None` if it is malformed.
pub(super) fn of(node: Node<'_, '_>) -> Option<Affine> {
    let mut map = Affine::IDENTITY;
    for token in TransformListParser::from(node.attribute("transform").unwrap_or_default()) {
        map = map.after(&match token.ok()? {
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
