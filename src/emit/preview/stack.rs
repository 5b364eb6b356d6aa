//! The whole stack: from above, flat and shut, and from the side, to scale, beside the first sheet.

use geom::order::sort_by;
use std::f64::consts::{PI, TAU};

use crate::emit::picture::{Anchor, Group, Text};
use crate::emit::preview::place::Places;
use crate::emit::preview::style::{GREY, IRON, OBJECT, Style, TEXT, circle, star_ink, straight};
use crate::emit::preview::subject::Preview;
use design::{Object, Stand, StarAssembly, StarDesign, round_tube, tube_height};
use forecast::pose::PosedStar;
use geom::{Bounds, Isometry, Path, Point, Vec2};
use spec::Spec;
use spec::units::Length;

/// The two views, and how much room they need to the right of the sheet.
pub(super) struct StackView<'a> {
    preview: &'a Preview<'a>,
    assembly: &'a StarAssembly,
    /// Largest distance from the axis that anything reaches.
    reach: f64,
    /// The object beside the stars.
    side: Option<SideObject>,
}

/// The object as it is seen from the side: heights in mm above the bottom of the lowest plate.
struct SideObject {
    profile: Path,
    /// From the lowest to the highest point that is shown.
    shown: [f64; 2],
    /// The table on which it stands, or the top of what it must be lifted by.
    table: f64,
}

/// Stars that lie alike, seen from above.
struct Alike<'a> {
    stars: Vec<usize>,
    part: &'a StarDesign,
    motion: Isometry,
}

impl<'a> StackView<'a> {
    /// The views of a gripper's stack; `None` for another product.
    pub(super) fn new(preview: &'a Preview<'a>) -> Option<Self> {
        let assembly = preview.design.assembly()?;
        let mouths = assembly.distinct.iter().filter_map(|part| Some(part.channel?.mouth));
        let reach = mouths.fold(assembly.frame.radius, f64::max);
        Some(Self { preview, assembly, reach, side: SideObject::new(preview.spec, assembly.stack.height) })
    }

    /// Width and height that the views need, one above the other, with labels at both sides, where type is of the size `unit`.
    pub(super) fn size(&self, unit: f64) -> (f64, f64) {
        let wide = 2.0 * self.reach;
        let [low, high] = self.side_extent();
        (wide + 20.0 * unit, wide + (high - low) + 12.0 * unit)
    }

    /// The views, in the middle of a strip whose top is at ordinate `top`.
    pub(super) fn group(&self, middle: f64, top: f64, style: Style) -> Group {
        let mut group = Group::new("stack");
        let axis = Point::new(middle, top - self.reach - 3.0 * style.unit);
        self.seen_from_above(&mut group, axis, style);
        let foot = Point::new(middle, axis.y - self.reach - 6.0 * style.unit - self.side_extent()[1]);
        self.seen_from_the_side(&mut group, foot, style);
        group
    }

    /// From the lowest to the highest point that is seen from the side, mm above the bottom of the lowest plate.
    fn side_extent(&self) -> [f64; 2] {
        let [low, high] = self.side.as_ref().map_or([0.0; 2], |object| object.shown);
        [low.min(0.0), high.max(self.assembly.stack.height)]
    }

    fn seen_from_above(&self, group: &mut Group, axis: Point, style: Style) {
        // Object, plates and posts are drawn first, then the edges of every distinct star, flat and closed. Lines keep
        // the names off themselves, which are placed last.
        let (design, shut) = (self.assembly, self.preview.shut);
        let frame = &design.frame;
        let half = self.reach + 9.5 * style.unit;
        let mut places = Places::new(Bounds::of_points([axis]).outset(half), 0.25 * style.unit);
        if let Some(Length(radius)) = self.preview.spec.load.as_ref().and_then(|load| load.object_radius) {
            group.area(vec![circle(axis, radius)], OBJECT);
            group.line(circle(axis, radius), style.pen(GREY, 0.7));
        }
        let edge = circle(axis, frame.radius);
        places.keep_off(&edge, 0.0);
        group.line(edge, style.pen(GREY, 1.2));
        for plate in &frame.plates {
            let opening = circle(axis, plate.opening);
            places.keep_off(&opening, 0.0);
            group.line(opening, style.dashes(GREY, 1.0));
        }
        for post in &frame.posts {
            let post = circle(axis + (*post - Point::ORIGIN), frame.post_diameter / 2.0);
            places.keep_off_box(post.bounds());
            group.area(vec![post], IRON);
        }
        let alike = self.alike(axis);
        for Alike { stars, part, motion } in &alike {
            let index = stars[0];
            for edge in part.edges.iter().map(|edge| motion.path(edge)) {
                places.keep_off(&edge, 0.0);
                group.line(edge, style.pen(star_ink(index), if shut.is_empty() { 2.0 } else { 1.2 }));
            }
            for edge in shut.get(index - 1).map(PosedStar::edges).unwrap_or_default() {
                let edge = motion.path(&edge);
                places.keep_off(&edge, 0.0);
                group.line(edge, style.pen(star_ink(index), 2.8));
            }
        }
        for alike in &alike {
            self.name(group, alike, &mut places, style);
        }
    }

    /// The numbers of the stars that have these edges: in a tube, else outside of the frame, with a line to the tip.
    fn name(&self, group: &mut Group, alike: &Alike<'_>, places: &mut Places, style: Style) {
        let star = &alike.part.star;
        let (ink, words) = (star_ink(alike.stars[0]), listed(&alike.stars));
        let name_at = |radius: f64, ray: f64, size: f64| {
            Text::centered(alike.motion.point(Point::polar(radius, ray)), size, ink, words.clone())
        };
        // The tip of the hose has a line already.
        let hose = alike.part.channel.map_or(0, |channel| channel.tip);
        let rays = (1..=star.n).filter(move |k| *k != hose).map(|k| star.tip_ray(k));
        let places_inside = [1.0, 0.8, 0.6].into_iter().flat_map(|share| {
            let size = (share * style.unit).min(0.4 * star.w);
            rays.clone().flat_map(move |ray| {
                [0.5, 0.35, 0.65].map(|part| (star.d_t + star.r_i + part * star.w, ray, size))
            })
        });
        let texts_inside: Vec<Text> =
            places_inside.map(|(radius, ray, size)| name_at(radius, ray, size)).collect();
        if let Some(text) = places.first(texts_inside) {
            group.text(text);
            return;
        }
        let half = 0.5 * name_at(0.0, 0.0, style.unit).width();
        for ray in rays {
            let turned =
                (alike.motion.point(Point::polar(1.0, ray)) - alike.motion.point(Point::ORIGIN)).angle();
            let radius = self.reach + 1.5 * style.unit + half * libm::cos(turned).abs();
            let (from, to) = (star.tip_reach(), self.reach + 0.6 * style.unit);
            let ends = [from, to].map(|radius| alike.motion.point(Point::polar(radius, ray)));
            let leader = straight(ends[0], ends[1]);
            if !places.is_clear(&leader) {
                continue;
            }
            if let Some(text) = places.first([name_at(radius, ray, style.unit)]) {
                places.keep_off(&leader, 0.0);
                group.line(leader, style.pen(ink, 0.8));
                group.text(text);
                return;
            }
        }
    }

    fn alike(&self, axis: Point) -> Vec<Alike<'a>> {
        let design = self.assembly;
        let mut groups: Vec<Alike<'a>> = Vec::new();
        for (star, turn) in design.stars.iter().zip(&design.stack.turns) {
            let part = design.part(star);
            let is_alike = |other: &&mut Alike<'_>| {
                std::ptr::eq(other.part, part) && ((other.motion.rotation - turn) / TAU).fract().abs() < 1e-9
            };
            match groups.iter_mut().find(is_alike) {
                Some(alike) => alike.stars.push(star.index),
                None => groups.push(Alike {
                    stars: vec![star.index],
                    part,
                    motion: Isometry { shift: axis - Point::ORIGIN, ..Isometry::rotation(*turn) },
                }),
            }
        }
        groups
    }

    fn seen_from_the_side(&self, group: &mut Group, foot: Point, style: Style) {
        // All heights count from the foot of the stack. The object and its table come first, then posts, plates and
        // stars. Labels of stars stand at the left and those of plates at the right, spaced where they would overlap.
        let (design, frame) = (self.assembly, &self.assembly.frame);
        if let Some(SideObject { profile, table, .. }) = &self.side {
            let profile = Isometry { shift: foot - Point::ORIGIN, ..Isometry::rotation(0.0) }.path(profile);
            group.area(vec![profile.clone()], OBJECT);
            group.line(profile, style.pen(GREY, 0.7));
            let [from, to] = [-frame.radius, frame.radius].map(|x| foot + Vec2::new(x, *table));
            group.line(straight(from, to), style.pen(TEXT, 0.7));
        }
        let plates: Vec<(usize, f64, f64)> = frame
            .plates
            .iter()
            .flat_map(|plate| plate.numbers.iter().map(|number| (*number, plate.opening)))
            .map(|(number, opening)| (number, opening, design.stack.plates[number - 1]))
            .collect();
        for post in &frame.posts {
            let half = frame.post_diameter / 2.0;
            let area = Bounds {
                min: foot + Vec2::new(post.x - half, 0.0),
                max: foot + Vec2::new(post.x + half, design.stack.height),
            };
            group.line(Path::rectangle(&area), style.pen(IRON, 0.8));
        }
        for (_, opening, z) in &plates {
            let (low, high) = (z - frame.thickness / 2.0, z + frame.thickness / 2.0);
            group.line(block(foot, frame.radius, low, high), style.pen(GREY, 1.2));
            group.line(block(foot, *opening, low, high), style.dashes(GREY, 1.0));
        }
        for (star, z) in design.stars.iter().zip(&design.stack.stars) {
            let geometry = &design.part(star).star;
            // Inflated: as high as predicted, round where nothing is.
            let shut = self.preview.shut.get(star.index - 1);
            let half = shut.map_or(round_tube(geometry.w), |to| tube_height(geometry.w, to.width)) / 2.0;
            let ink = star_ink(star.index);
            group.line(block(foot, geometry.tip_reach(), z - half, z + half), style.pen(ink, 2.0));
            group.line(block(foot, geometry.rho_0, z - half, z + half), style.dashes(ink, 1.0));
        }
        let left: Vec<(String, f64)> =
            (1..).zip(&design.stack.stars).map(|(i, z)| (format!("star {i}"), *z)).collect();
        let right: Vec<(String, f64)> = plates.iter().map(|(i, _, z)| (format!("plate {i}"), *z)).collect();
        for (labels, side, anchor) in [(left, -1.0, Anchor::End), (right, 1.0, Anchor::Start)] {
            let x = side * (frame.radius + 0.8 * style.unit);
            for (content, z) in spaced(labels, style) {
                let label_place = foot + Vec2::new(x, z - 0.35 * style.unit);
                group.text(Text { at: label_place, size: style.unit, anchor, ink: TEXT, content });
            }
        }
    }
}

/// The rectangle from `low` to `high` above `foot`, `half` to both sides of it.
fn block(foot: Point, half: f64, low: f64, high: f64) -> Path {
    Path::rectangle(&Bounds { min: foot + Vec2::new(-half, low), max: foot + Vec2::new(half, high) })
}

impl SideObject {
    /// The object of `spec` beside a stack that is `stack` mm high; `None` without one. What lies further than that from the stack is cut off.
    fn new(spec: &Spec, stack: f64) -> Option<Self> {
        let object = Object::new(spec.load.as_ref()?)?;
        let stand = Stand::new(spec)?;
        let (low, top) = (stand.object, stand.object + object.height().0);
        let visible = [low.max(-stack), top.min(2.0 * stack)];
        let middle = f64::midpoint(low, top);
        let points = (0..=CHORDS).map(|i| {
            // Chords of equal angle, so that the poles of a ball are round.
            let z = middle - (middle - low) * libm::cos(PI * f64::from(i) / f64::from(CHORDS));
            z.clamp(visible[0], visible[1])
        });
        let heights: Vec<f64> = points.collect();
        let right = heights.iter().map(|z| Point::new(object.radius_at(z - middle), *z));
        let left = heights.iter().rev().map(|z| Point::new(-object.radius_at(z - middle), *z));
        let mut outline: Vec<Point> = right.chain(left).collect();
        outline.dedup_by(|a, b| a.distance(*b) < 1e-9);
        Some(Self { profile: Path::polygon(&outline), shown: visible, table: visible[0] })
    }
}

/// Chords of half of an object's profile.
const CHORDS: u32 = 36;

/// The labels, bottom to top, without those that would touch the one before.
fn spaced(mut labels: Vec<(String, f64)>, style: Style) -> Vec<(String, f64)> {
    sort_by(&mut labels, |a, b| a.1.total_cmp(&b.1));
    let mut last = f64::NEG_INFINITY;
    labels.retain(|(_, z)| {
        let room = z - last >= 1.1 * style.unit;
        if room {
            last = *z;
        }
        room
    });
    labels
}

/// `star 1`, `stars 1, 2, 3`, `stars 1 to 9`.
pub(super) fn listed(stars: &[usize]) -> String {
    match stars {
        [only] => format!("star {only}"),
        [first, .., last] if stars.len() > 3 && last - first + 1 == stars.len() => {
            format!("stars {first} to {last}")
        }
        _ => {
            let numbers: Vec<String> = stars.iter().map(ToString::to_string).collect();
            format!("stars {}", numbers.join(", "))
        }
    }
}
