//! The whole stack for people: from above, and from the side, to scale, beside the first sheet.

use svg::Node;
use svg::node::element::Element;

use crate::design::Design;
use crate::emit::number::Decimals;
use crate::emit::svg::{SvgPage, element};
use crate::geom::{Arc, Isometry, Line, Path, Point, Vec2};

/// Blank strip around each view, mm.
const BLANK: f64 = 15.0;

/// Colours of the stars from bottom to top, over and over.
const COLORS: [&str; 4] = ["#1f4e79", "#a65628", "#4d7c0f", "#6a3d9a"];

/// The two views, and how much room they need to the right of the sheet.
pub(super) struct StackView<'a> {
    design: &'a Design,
    /// Largest distance from the axis that anything reaches.
    reach: f64,
}

impl<'a> StackView<'a> {
    pub(super) fn new(design: &'a Design) -> Self {
        let mouths = design.distinct.iter().filter_map(|part| Some(part.channel?.mouth));
        let reach = mouths.fold(design.frame.radius, f64::max);
        Self { design, reach }
    }

    /// Width of the strip that the views take.
    pub(super) fn width(&self) -> f64 {
        2.0 * (self.reach + BLANK)
    }

    /// Height that the views need, one above the other.
    pub(super) fn height(&self) -> f64 {
        2.0 * (self.reach + BLANK) + self.design.stack.height + 2.0 * BLANK
    }

    /// The views, their strip beginning at abscissa `left`; the top of the page is at ordinate `top`.
    pub(super) fn group(&self, page: &SvgPage, left: f64, top: f64, size: f64) -> Element {
        let mut group = element("g");
        group.assign("id", "stack");
        let middle = left + self.reach + BLANK;
        self.seen_from_above(page, &mut group, Point::new(middle, top - self.reach - BLANK), size);
        let bottom = top - 2.0 * (self.reach + BLANK) - BLANK - self.design.stack.height;
        self.seen_from_the_side(page, &mut group, Point::new(middle, bottom), size);
        group
    }

    fn seen_from_above(&self, page: &SvgPage, group: &mut Element, axis: Point, size: f64) {
        let frame = &self.design.frame;
        let ring = |radius: f64, center: Point| {
            Path::closed(vec![Arc::new(center, radius, 0.0, std::f64::consts::TAU).into()])
        };
        group.append(stroke(page, &ring(frame.radius, axis), "#808080", 0.4, "none"));
        for plate in &frame.plates {
            group.append(stroke(page, &ring(plate.opening, axis), "#808080", 0.4, "2 1.5"));
        }
        for post in &frame.posts {
            let center = axis + (*post - Point::ORIGIN);
            group.append(stroke(page, &ring(frame.post_diameter / 2.0, center), "#808080", 0.4, "none"));
        }
        for ((star, turn), color) in self.design.stars.iter().zip(&self.design.stack.turns).zip(colors()) {
            let motion = Isometry { shift: axis - Point::ORIGIN, ..Isometry::rotation(*turn) };
            let part = self.design.part(star);
            for edge in &part.edges {
                group.append(stroke(page, &motion.path(edge), color, 0.5, "none"));
            }
            let corner = motion.point(Point::new(part.star.rho_0 + 0.5 * part.star.w, 0.0));
            group.append(page.text(corner, 0.8 * size, "middle", color, &star.index.to_string()));
        }
        let below = axis - Vec2::new(0.0, self.reach + 0.5 * BLANK);
        group.append(page.text(below, size, "middle", "#202020", "the stack from above"));
    }

    fn seen_from_the_side(&self, page: &SvgPage, group: &mut Element, foot: Point, size: f64) {
        let (design, frame) = (self.design, &self.design.frame);
        let at = |x: f64, z: f64| foot + Vec2::new(x, z);
        let mut block = |half: f64, from: f64, to: f64, color: &str, dash: &str| {
            let corners = [at(-half, from), at(half, from), at(half, to), at(-half, to), at(-half, from)];
            let sides = corners.windows(2).map(|ends| Line::new(ends[0], ends[1]).into());
            group.append(stroke(page, &Path::closed(sides.collect()), color, 0.4, dash));
        };
        for plate in &frame.plates {
            for z in plate.numbers.iter().map(|number| design.stack.plates[number - 1]) {
                let (low, high) = (z - frame.thickness / 2.0, z + frame.thickness / 2.0);
                block(frame.radius, low, high, "#808080", "none");
                block(plate.opening, low, high, "#808080", "2 1.5");
            }
        }
        for ((star, z), color) in design.stars.iter().zip(&design.stack.stars).zip(colors()) {
            let star = &design.part(star).star;
            // The tube is round when it is inflated.
            let half = star.w / std::f64::consts::PI;
            block(star.tip_reach(), z - half, z + half, color, "none");
            block(star.rho_0, z - half, z + half, color, "2 1.5");
        }
        for post in &frame.posts {
            let x = post.x;
            let sides = Path::open(vec![Line::new(at(x, 0.0), at(x, design.stack.height)).into()]);
            group.append(stroke(page, &sides, "#404040", frame.post_diameter.min(1.0), "none"));
        }
        let below = at(0.0, -0.8 * BLANK);
        let text = format!("from the side, inflated: {:.2} mm high", design.stack.height);
        group.append(page.text(below, size, "middle", "#202020", &text));
    }
}

fn colors() -> impl Iterator<Item = &'static str> {
    COLORS.into_iter().cycle()
}

fn stroke(page: &SvgPage, path: &Path, color: &str, width: f64, dash: &str) -> Element {
    let mut out = element("path");
    out.assign("d", page.data(path));
    out.assign("fill", "none");
    out.assign("stroke", color);
    out.assign("stroke-width", Decimals::exactly(3).text(width));
    out.assign("stroke-dasharray", dash);
    out
}
