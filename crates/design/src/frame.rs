//! The frame: plates on posts that keep the arms of every star in its plane.
//!
//! All plates carry the same posts and have the same edge; they differ in their **opening**, which lets pass the object
//! and the corners of the stars beside the plate: the larger inner radius and the clearance. Posts are outside of the largest
//! star, turned so that they are as far as can be from every hose.

use std::f64::consts::{PI, TAU};

use crate::cut::leaves_no_hole;
use crate::{Refusal, RefusalCode, Refusals, Stack, Star, StarDesign, round_tube};
use geom::Point;
use spec::units::{Most, Readable, tenths_down, tenths_up};
use spec::{FEWEST_POSTS, SMALLEST_HOLE, Spec, key};

/// The frame, its axis at the origin and corner 1 of an unturned star on +X.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The distinct plates, in the order in which they first occur from the bottom.
    pub plates: Vec<Plate>,
    /// Centres of the posts, counterclockwise.
    pub posts: Vec<Point>,
    /// Diameter of a post.
    pub post_diameter: f64,
    /// Length of a post, from the bottom of the lowest plate to the top of the highest.
    pub post_length: f64,
    /// Radius of the plates.
    pub radius: f64,
    /// Thickness of a plate.
    pub thickness: f64,
    /// Width of the cut.
    pub kerf: f64,
}

/// One distinct plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Radius of the opening.
    pub opening: f64,
    /// Numbers of the stack's plates that are like this, 1 = bottom.
    pub numbers: Vec<usize>,
}

impl Frame {
    /// The frame of `stack`, whose stars are `stars` from bottom to top.
    ///
    /// # Errors
    /// If arms would slip through an opening, or posts obstruct a hose.
    pub fn new(spec: &Spec, stack: &Stack, stars: &[&StarDesign]) -> Result<Self, Refusals> {
        let frame = &spec.frame;
        let (post, clearance) = (frame.post_diameter.0, frame.clearance.0);
        let mut refusals = Refusals::new();
        if leaves_no_hole(frame.kerf.0, post) {
            let fault =
                format!("a cut of {} leaves no hole for a post of {}", frame.kerf, frame.post_diameter);
            let remedy = format!("kerf must be at most {} mm", Most((post - SMALLEST_HOLE).max(0.0)));
            refusals.push(Refusal::new(key::frame::KERF, RefusalCode::WideKerf, fault, remedy));
        }
        let reach = stars.iter().map(|part| part.outline.reach).fold(0.0, f64::max);
        let circle = reach + clearance + post / 2.0;
        let mut plates: Vec<Plate> = Vec::new();
        for i in 0..=stars.len() {
            let neighbours = &stars[i.saturating_sub(1)..(i + 1).min(stars.len())];
            let radius = opening(neighbours.iter().map(|part| part.star.rho_0), clearance);
            let falling = neighbours.iter().find(|part| !part.star.lies_on(radius));
            if let (Some(part), true) = (falling, refusals.is_empty()) {
                refusals.push(falls_through(i + 1, part.star.d_t, radius));
            }
            match plates.iter_mut().find(|plate| plate.opening == radius) {
                Some(plate) => plate.numbers.push(i + 1),
                None => plates.push(Plate { opening: radius, numbers: vec![i + 1] }),
            }
        }
        let hoses: Vec<Hose> = stars
            .iter()
            .zip(&stack.turns)
            .filter_map(|(part, turn)| {
                let channel = part.channel.as_ref()?;
                let strip = channel.half_width + spec.seal.band.0 + spec.seal.allowance.0;
                Some(Hose { direction: turn + part.star.tip_ray(channel.tip), half_width: strip })
            })
            .collect();
        let posts = posts_on(circle, frame.posts, &hoses);
        let clear_radius = post / 2.0 + clearance;
        if let Some((free, needed_room)) = obstructed(&posts, clear_radius, &hoses) {
            let helps = |count: u32, hoses: &[Hose]| {
                obstructed(&posts_on(circle, count, hoses), clear_radius, hoses).is_none()
            };
            refusals.push(meets_hose(frame.posts, (free, needed_room), &hoses, helps));
        }
        refusals.or_value(Self {
            plates,
            posts,
            post_diameter: post,
            post_length: stack.height,
            // As much plate around a post's hole as half its diameter.
            radius: circle + post,
            thickness: frame.plate_thickness.0,
            kerf: frame.kerf.0,
        })
    }

    /// Radius of the opening of the plate below star `index`, 1 = bottom.
    pub fn opening_below(&self, index: usize) -> Option<f64> {
        let plate = self.plates.iter().find(|plate| plate.numbers.contains(&index))?;
        Some(plate.opening)
    }

    /// Area of a plate without its opening and holes, as it is after cutting, mm^2.
    pub fn area(&self, plate: &Plate) -> f64 {
        let posts: f64 = self.posts.iter().map(|_| (self.post_diameter / 2.0).powi(2)).sum();
        PI * (self.radius.powi(2) - plate.opening.powi(2) - posts)
    }
}

/// Radius of the opening of a plate, mm, beside stars of these inner radii, with this `clearance`.
pub fn opening(inner_radii: impl IntoIterator<Item = f64>, clearance: f64) -> f64 {
    inner_radii.into_iter().fold(0.0, f64::max) + clearance
}

/// Radius of the tips when the star is closed as far as possible: arms inflated to 2 W / pi, side by side.
///
/// Section 1 of the star's geometry with W -> 2 W / pi and phi_i = 0; a star that holds an object is less closed.
pub fn shut_reach(star: &Star) -> f64 {
    let (alpha, w) = (star.half_sector(), round_tube(star.w));
    (w + star.r_i + star.r_e) / libm::tan(alpha) + star.l + star.r_i + w
}

/// The strip along which a hose leaves a star.
#[derive(Clone, Copy)]
struct Hose {
    direction: f64,
    half_width: f64,
}

impl Hose {
    /// Distance of `p` from the half line from the axis outwards.
    fn distance(&self, p: Point) -> f64 {
        let direction = geom::Vec2::unit(self.direction);
        let v = p - Point::ORIGIN;
        if v.dot(direction) > 0.0 { direction.cross(v).abs() } else { v.length() }
    }
}

/// Centres of `count` posts on a circle of radius `circle`, as far as can be from `hoses`.
fn posts_on(circle: f64, count: u32, hoses: &[Hose]) -> Vec<Point> {
    let first = first_post(count, hoses);
    (0..count).map(|i| Point::polar(circle, first + TAU * f64::from(i) / f64::from(count))).collect()
}

/// How far the middle of the first hose that `posts` obstruct is from one of them, and how far it must be; `clear_radius` is what a post needs
/// beside a hose.
fn obstructed(posts: &[Point], clear_radius: f64, hoses: &[Hose]) -> Option<(f64, f64)> {
    hoses.iter().find_map(|hose| {
        let needed_room = hose.half_width + clear_radius;
        let free = posts.iter().map(|post| hose.distance(*post)).fold(f64::INFINITY, f64::min);
        (free < needed_room).then_some((free, needed_room))
    })
}

/// Direction of the first post: in the middle of the widest gap between hoses, all seen within one step of the posts.
fn first_post(count: u32, hoses: &[Hose]) -> f64 {
    let step = TAU / f64::from(count);
    let mut directions: Vec<f64> = hoses.iter().map(|hose| in_sector(hose.direction, step)).collect();
    directions.sort_by(f64::total_cmp);
    let Some(first) = directions.first().copied() else { return step / 2.0 };
    directions.push(first + step);
    let mut best = (0.0, 0.0);
    for pair in directions.windows(2) {
        if pair[1] - pair[0] > best.0 + 1e-9 {
            best = (pair[1] - pair[0], 0.5 * (pair[0] + pair[1]));
        }
    }
    best.1.rem_euclid(step)
}

/// The direction `angle` within one step of the posts. Directions that differ by a whole step are equal; rounding must not change that.
fn in_sector(angle: f64, step: f64) -> f64 {
    let a = angle.rem_euclid(step);
    if step - a < 1e-9 { 0.0 } else { a }
}

fn falls_through(plate: usize, tips: f64, opening: f64) -> Refusal {
    let (tips, opening) = (Readable(tips), Readable(opening));
    let fault = format!(
        "the tips of a star bend {tips} mm from the axis, the opening of plate {plate} has a radius of {opening} mm"
    );
    let remedy = "make clearance smaller, or neighbouring stars less different";
    Refusal::new(key::frame::CLEARANCE, RefusalCode::ArmsFallThrough, fault, remedy)
}

/// `helps` returns whether a number of posts leaves free hoses in these directions.
fn meets_hose(
    posts: u32,
    (free, needed_room): (f64, f64),
    hoses: &[Hose],
    helps: impl Fn(u32, &[Hose]) -> bool,
) -> Refusal {
    let first = hoses.first().map_or(0.0, |hose| hose.direction);
    let in_line: Vec<Hose> = hoses.iter().map(|hose| Hose { direction: first, ..*hose }).collect();
    let [fewer, fewer_in_line] =
        [hoses, &in_line].map(|hoses| (FEWEST_POSTS..posts).rev().find(|count| helps(*count, hoses)));
    let lined = "put the inlets of all stars in line: rotation, inlet_tip";
    let ways =
        [fewer.map(|count| format!("make posts {count}")), helps(posts, &in_line).then(|| lined.to_owned())];
    let ways: Vec<String> = ways.into_iter().flatten().collect();
    let remedy = match fewer_in_line {
        _ if !ways.is_empty() => ways.join(", or "),
        Some(count) => format!("make posts {count}, and {lined}"),
        None => "make post_diameter or clearance smaller, or take a thinner hose".to_owned(),
    };
    // Rounded apart, so that the digits show the difference.
    let (free, needed_room) = (Readable(tenths_down(free)), Readable(tenths_up(needed_room)));
    let fault = format!(
        "with {posts} posts one would be {free} mm from the middle of a hose that needs {needed_room} mm"
    );
    Refusal::new(key::frame::POSTS, RefusalCode::PostMeetsHose, fault, remedy)
}
