//! The inlet: a stub channel that opens the outer loop at one tip and runs outwards along the tip's ray.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::star_fault::blamed;
use crate::{Contour, Part, Refusal, RefusalCode, Star, Warning, round_tube};
use geom::{Arc, Line, Path, Point, Segment, Vec2};
use spec::units::{Least, Most, Readable};
use spec::{Inlet, key};

/// The channel of one star, in the star's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channel {
    /// The tip that carries it.
    pub tip: u32,
    /// Half the flat width, pi d / 4 for a hose of outer diameter d: the flat tube has the hose's circumference.
    pub half_width: f64,
    /// Radius of the fillet between the channel and the tip's arc, at the tube's edge.
    pub fillet: f64,
    /// Distance of the mouth from the axis.
    pub mouth: f64,
}

/// The junction of channel and tip at some distance from the tube's edge, in the frame of the tip's ray
/// with the tip's centre T as the origin.
struct Junction {
    /// Half the angle of the tip's arc that the channel takes away.
    psi: f64,
    /// Start of the channel's straight side.
    x: f64,
    /// Distance of the side from the ray.
    y: f64,
    /// Radius of the fillet; 0 for a vertex.
    radius: f64,
}

impl Channel {
    /// The channel of `inlet` at tip `tip` of `star`.
    pub fn new(star: &Star, inlet: &Inlet, tip: u32) -> Self {
        Self { tip, ..Self::of_disc(star.tip_reach(), inlet) }
    }

    /// The outer contour at `delta`, opened by the channel: from the mouth inwards, around the star, out to the mouth.
    ///
    /// Both ends run `excess` past the mouth. Fillets are at least `least_radius` round.
    ///
    /// # Errors
    /// If the channel with its strips does not fit on the tip's arc, or ends before it begins.
    pub fn open(
        &self,
        star: &Star,
        contour: &Contour,
        delta: f64,
        least_radius: f64,
        excess: f64,
    ) -> Result<Path, Refusal> {
        let tip = contour.parts.iter().position(|(part, _)| *part == Part::Tip(self.tip));
        let Some((index, Segment::Arc(arc))) = tip.map(|index| (index, contour.parts[index].1)) else {
            return Err(self.too_wide(star.w, delta, star.r_i + star.w + delta));
        };
        let junction = self.fitted(star, arc.sweep / 2.0, delta, least_radius)?;
        let end = self.mouth - star.d_t + excess;
        let (inward, outward) = sides(star.tip_ray(self.tip), &arc, &junction, end);
        let rest =
            contour.parts[index + 1..].iter().chain(&contour.parts[..index]).map(|(_, segment)| *segment);
        Ok(Path::open(inward.into_iter().chain(rest).chain(outward).collect()))
    }

    /// The channel of `inlet` on a disc of flat radius `radius` about the origin, towards +X.
    pub fn of_disc(radius: f64, inlet: &Inlet) -> Self {
        Self {
            tip: 1,
            half_width: PI * inlet.tube_diameter.0 / 4.0,
            fillet: inlet.fillet.0,
            mouth: radius + inlet.length.0,
        }
    }

    /// The circle `delta` outside of a disc of flat radius `radius`, opened by the channel: from the mouth inwards, around, and out
    /// to the mouth, both ends `excess` past it; `None` if the channel has no room on the disc. Fillets are at least `least_radius` round.
    pub fn open_disc(&self, radius: f64, delta: f64, least_radius: f64, excess: f64) -> Option<Path> {
        let rim = radius + delta;
        let junction = self.junction(rim, delta, least_radius)?;
        if junction.x >= self.mouth {
            return None;
        }
        let circle = Arc::new(Point::ORIGIN, rim, -PI, 2.0 * PI);
        let (inward, outward) = sides(0.0, &circle, &junction, self.mouth + excess);
        Some(Path::open(inward.into_iter().chain(outward).collect()))
    }

    /// Area that the channel adds to what the contour at `delta` encloses, mm^2, the contour's arc at the tip of radius
    /// `rim` turning by `half` to either side; `None` where [`Channel::open`] refuses.
    pub(super) fn cut_area(&self, star: &Star, rim: f64, half: f64, delta: f64) -> Option<f64> {
        let Junction { psi, x, y, radius } = self.fitted(star, half, delta, 0.0).ok()?;
        // Either side of the ray: from T along the ray to the mouth, back along the channel's side, over the fillet's
        // centre to T; without the tip's sector and the fillet's.
        let end = self.mouth - star.d_t;
        let side =
            end * y - 0.5 * x * (y - radius) - 0.5 * (psi * rim * rim + (FRAC_PI_2 - psi) * radius * radius);
        Some(2.0 * side)
    }

    /// The junction of the channel with the arc of its tip, which turns by `half` to either side of the ray.
    ///
    /// # Errors
    /// If the channel with its strips does not fit on the arc, or ends before it begins.
    fn fitted(&self, star: &Star, half: f64, delta: f64, least_radius: f64) -> Result<Junction, Refusal> {
        let rim = star.r_i + star.w + delta;
        let Some(junction) = self.junction(rim, delta, least_radius) else {
            return Err(self.too_wide(star.w, delta, rim));
        };
        // Strictly inside: the rest of the arc must be longer than rounding.
        if junction.psi >= half - 1e-9 {
            return Err(self.too_wide(star.w, delta, rim * libm::sin(half)));
        }
        let end = self.mouth - star.d_t;
        if junction.x >= end {
            let fault = format!("the mouth would lie {} mm inside the flap", Readable(junction.x - end));
            let remedy = format!("length must be above {} mm", Least(junction.x - star.r_i - star.w));
            return Err(Refusal::new(key::inlet::LENGTH, RefusalCode::ShortInlet, fault, remedy));
        }
        Ok(junction)
    }

    /// The junction of the channel with an arc of radius `rim`; `None` if the channel is wider than that.
    fn junction(&self, rim: f64, delta: f64, least_radius: f64) -> Option<Junction> {
        let y = self.half_width + delta;
        // The fillet is concave for the seal: its centre is fixed, its radius shrinks with delta.
        let radius = (self.fillet - delta).max(least_radius);
        let sin = (y + radius) / (rim + radius);
        (sin < 1.0).then(|| Junction {
            psi: libm::asin(sin),
            x: (rim + radius) * (1.0 - sin * sin).sqrt(),
            y,
            radius,
        })
    }

    /// The warning about a hose that is thicker than the inflated tube of star `index`.
    pub(super) fn too_thick(&self, index: usize, star: &Star) -> Option<Warning> {
        if 2.0 * self.half_width <= star.w {
            return None;
        }
        let (width, tube) = (Readable(2.0 * self.half_width), Readable(star.w));
        let fault = format!(
            "the hose's channel on star {index} is {width} mm wide, wider than the tube of {tube} mm that it feeds"
        );
        let thickest = Most(round_tube(star.w));
        let remedy = format!("a hose that is no thicker than the inflated tube has at most {thickest} mm");
        Some(Warning::new(key::inlet::TUBE_DIAMETER, RefusalCode::ThickHose, fault, remedy))
    }

    fn too_wide(&self, width: f64, delta: f64, room: f64) -> Refusal {
        let strips = if delta > 0.0 { " with the strips along it" } else { "" };
        // A hose too thick, or a tube too narrow: compared with the defaults.
        let hose = 4.0 * self.half_width / PI;
        let key = blamed([(key::inlet::TUBE_DIAMETER, hose / 4.0), (key::star::TUBE_WIDTH, 30.0 / width)]);
        let (tip, [wide, room]) =
            (self.tip, [self.half_width + delta, room.max(0.0)].map(|half| Readable(2.0 * half)));
        let fault = format!(
            "the channel{strips} would be {wide} mm wide and meet an arm, where tip {tip} leaves {room} mm"
        );
        let remedy = "make tube_diameter, band or allowance smaller, or the tube wider";
        Refusal::new(key, RefusalCode::InletMeetsArm, fault, remedy)
    }

    /// The cut across the mouth: from one end of an open outline to its other.
    pub fn mouth_cut(open: Path) -> Path {
        let (Some(start), Some(end)) = (open.start(), open.end()) else { return open };
        let mut segments = open.segments;
        segments.push(Line::new(end, start).into());
        Path::closed(segments)
    }

    /// The middle of the mouth in the star's frame.
    pub fn mouth_center(&self, star: &Star) -> Point {
        Point::polar(self.mouth, star.tip_ray(self.tip))
    }
}

/// The two sides of the channel along `ray` with their fillets and the remainder of `arc`: inwards and outwards.
fn sides(ray: f64, arc: &Arc, junction: &Junction, end: f64) -> (Vec<Segment>, Vec<Segment>) {
    let (along, across) = (Vec2::unit(ray), Vec2::unit(ray).perp());
    let point = |x: f64, y: f64| -> Point { arc.center + along * x + across * y };
    let Junction { psi, x, y, radius } = *junction;
    let turn = FRAC_PI_2 - psi;
    let mut inward = vec![Line::new(point(end, y), point(x, y)).into()];
    let mut outward = vec![Arc::new(arc.center, arc.radius, arc.start_angle, arc.sweep / 2.0 - psi).into()];
    if radius > 0.0 {
        inward.push(Arc::new(point(x, y + radius), radius, ray - FRAC_PI_2, -turn).into());
        outward.push(Arc::new(point(x, -y - radius), radius, ray - psi + PI, -turn).into());
    }
    inward.push(Arc::new(arc.center, arc.radius, ray + psi, arc.sweep / 2.0 - psi).into());
    outward.push(Line::new(point(x, -y), point(end, -y)).into());
    (inward, outward)
}
