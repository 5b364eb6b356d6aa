//! Clips that hide nothing: those of pages and artboards, which many programs put around all that they export.

use geom::{Path, Point};
use roxmltree::Node;

use super::document::is_svg;
use super::viewport::Viewport;
use super::{shapes, transform};
use crate::affine::Affine;
use crate::piece::Piece;
use crate::{Element, Figure};

/// Distance by which a figure may reach over a clip, mm: clips have the decimals of their program.
const OVER: f64 = 0.01;

/// The region of `value`, the property `clip-path` of `node`; `None` if it is not a simple one. `map` leads from the user units of
/// `node` to mm, `find` to the element of an id.
pub(super) fn declared<'a, 'd: 'a>(
    node: Node<'a, 'd>,
    value: &str,
    map: &Affine,
    viewport: Viewport,
    find: impl Fn(&str) -> Option<Node<'a, 'd>>,
) -> Option<ConvexClip> {
    let target = find(value.strip_prefix("url(#")?.strip_suffix(')')?)?;
    // A nested frame has its own view box inside its clip.
    (node.tag_name().name() != "svg").then(|| ConvexClip::new(target, map, viewport, find)).flatten()
}

/// A convex polygon, mm.
#[derive(Debug)]
pub(super) struct ConvexClip(Vec<Point>);

impl ConvexClip {
    /// The region of a `<clipPath>` that has one figure, a convex polygon; `None` of any other. `map` leads from the user units of the
    /// clipped element to mm, `find` to the target of a `<use>`.
    fn new<'a, 'd: 'a>(
        clip: Node<'a, 'd>,
        map: &Affine,
        viewport: Viewport,
        find: impl Fn(&str) -> Option<Node<'a, 'd>>,
    ) -> Option<Self> {
        let is_clip = clip.tag_name().name() == "clipPath" && clip.attribute("clip-path").is_none();
        let units = clip.attribute("clipPathUnits");
        let mut figures = clip.children().filter(|child| is_svg(*child));
        let figure = figures.next().filter(|_| is_clip && figures.next().is_none())?;
        if units.is_some_and(|units| units != "userSpaceOnUse") {
            return None;
        }
        let mut map = map.following(&transform::plain(clip)?).following(&transform::plain(figure)?);
        let mut figure = figure;
        if figure.tag_name().name() == "use" {
            if figure.attribute("x").or(figure.attribute("y")).is_some() {
                return None;
            }
            let href = figure.attributes().find(|attribute| attribute.name() == "href")?.value();
            figure = find(href.trim().strip_prefix('#')?)?;
            map = map.following(&transform::plain(figure)?);
        }
        let tag = figure.tag_name().name();
        let [chain] =
            &shapes::TAGS.contains(&tag).then(|| shapes::chains(figure, viewport).ok()).flatten()?[..]
        else {
            return None;
        };
        let corner =
            |piece: &Piece| if let Piece::Line(start, _) = piece { Some(map.point(*start)) } else { None };
        let mut corners: Vec<Point> = chain.pieces.iter().map(corner).collect::<Option<_>>()?;
        if let (Some(Piece::Line(_, end)), Some(first)) = (chain.pieces.last(), corners.first()) {
            let end = map.point(*end);
            // An open chain ends beside its start.
            if end.distance(*first) > OVER {
                corners.push(end);
            }
        }
        corners.dedup_by(|a, b| a.distance(*b) <= OVER);
        let clip = Self(corners);
        let corners = clip.sides().zip(clip.sides().cycle().skip(1));
        let turns: Vec<f64> = corners.map(|([a, b], [_, c])| (b - a).cross(c - b)).collect();
        let is_convex = turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0);
        (is_convex && clip.0.len() >= 3).then_some(clip)
    }

    fn sides(&self) -> impl Iterator<Item = [Point; 2]> + Clone + '_ {
        self.0.iter().zip(self.0.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
    }

    /// Whether the boxes of all elements lie in it.
    pub(super) fn covers<'e>(&self, mut elements: impl Iterator<Item = &'e Element>) -> bool {
        let turn = Path::closed(self.sides().map(|[a, b]| geom::Line::new(a, b).into()).collect()).area();
        elements.all(|element| match &element.figure {
            Figure::Point(p) => self.contains(*p, turn),
            Figure::Path(path) => {
                let bounds = path.bounds();
                let (min, max) = (bounds.min, bounds.max);
                [min, max, Point::new(min.x, max.y), Point::new(max.x, min.y)]
                    .into_iter()
                    .all(|p| self.contains(p, turn))
            }
        })
    }

    /// Whether `p` lies in the polygon, which is clockwise where `turn` is negative.
    fn contains(&self, p: Point, turn: f64) -> bool {
        self.sides().all(|[a, b]| (b - a).normalized().cross(p - a) * turn.signum() >= -OVER)
    }
}

/// The text of the note on a clip or a mask.
pub(super) fn unapplied(name: &str, value: &str) -> String {
    format!("The {name} {value} is not applied; the whole outlines are read.")
}
