//! Pouches: the band around a flat tube, open at a mouth for the hose of `[inlet]`, and the cut around it.

use std::f64::consts::PI;

use design::{Channel, MOUTH_OVERRUN, Refusal, RefusalCode, round_tube};
use geom::{Arc, Line, Path, Point, Segment, Vec2};
use sealed::{Port, Role, SealedShape, Seam};
use spec::units::{Least, Length, Most, Readable};
use spec::{Inlet, Seal, StarSpec, key};

/// The hose of a spec without an inlet.
const USUAL_HOSE: Inlet = Inlet { tube_diameter: Length(4.0), length: Length(20.0), fillet: Length(1.0) };

/// The hose for the pouches.
pub fn hose(inlet: Option<&Inlet>) -> &Inlet {
    inlet.unwrap_or(&USUAL_HOSE)
}

/// A disc of flat diameter `diameter` between the inner edges of its band, its mouth on +X.
///
/// # Errors
/// If the hose is too thick for it.
pub fn disc(diameter: f64, hose: &Inlet, seal: &Seal) -> Result<SealedShape, Refusal> {
    let (radius, half, flap) = (diameter / 2.0, seal.band.0 / 2.0, seal.band.0 + seal.allowance.0);
    outside_the_flap(hose, flap)?;
    let channel = Channel::of_disc(radius, hose);
    let (seam, cut) = channel
        .open_disc(radius, half, 0.0, MOUTH_OVERRUN)
        .zip(channel.open_disc(radius, flap, 0.0, 0.0))
        .ok_or_else(|| too_thick(hose, "disc", round_tube(diameter - 2.0 * flap)))?;
    Ok(pouch(seal, seam, Channel::mouth_cut(cut), 2.0 * channel.half_width))
}

/// The paper's single actuator: two arms of the star's width, one tip of its angle and radius, 4 W from the hinge to
/// the arms' straight ends, the mouth at the end of the upper arm. The hinge points along +X.
///
/// # Errors
/// If the hose is too thick for the arm's end.
pub fn vee(star: &StarSpec, hose: &Inlet, seal: &Seal) -> Result<SealedShape, Refusal> {
    let half_mouth = PI * hose.tube_diameter.0 / 4.0;
    if 2.0 * half_mouth >= star.tube_width.0 {
        return Err(too_thick(hose, "V-actuator", round_tube(star.tube_width.0)));
    }
    let (half, flap) = (seal.band.0 / 2.0, seal.band.0 + seal.allowance.0);
    outside_the_flap(hose, flap)?;
    // A flap between the arms has less space: it may take half of an arm.
    let notch = 2.0 * star.tube_width.0 * libm::tan(star.tip_angle.rad() / 2.0) + star.tip_radius.0;
    let arm = Arm { star, half_mouth, mouth: hose.length.0 };
    let seam = arm.vee(half, half, MOUTH_OVERRUN);
    let cut = Channel::mouth_cut(arm.vee(flap, flap.min(notch.max(seal.band.0)), 0.0));
    Ok(pouch(seal, seam, cut, 2.0 * half_mouth))
}

/// A pouch in its own coordinates: one band around a tube, from one side of the mouth of `width` mm to the other.
fn pouch(seal: &Seal, band: Path, cut: Path, width: f64) -> SealedShape {
    let mouth = band.start().zip(band.end()).map(|(start, end)| start.midpoint(end));
    let seam = Seam { role: Role::Boundary, ..Seam::weld(band) };
    let ports = mouth.map(|mouth| Port { at: mouth, width }).into_iter().collect();
    SealedShape { seams: vec![seam], band: seal.band.0, cut: Some(cut), ports, valves: Vec::new() }
}

/// Checks that the mouth lies outside of a flap of this width with its band.
fn outside_the_flap(hose: &Inlet, flap: f64) -> Result<(), Refusal> {
    if hose.length.0 > flap {
        return Ok(());
    }
    let problem =
        format!("the mouth of a pouch would lie {} mm inside the flap", Readable(flap - hose.length.0));
    let remedy = format!("length must be above {} mm", Least(flap));
    Err(Refusal::new(key::inlet::LENGTH, RefusalCode::ShortInlet, problem, remedy))
}

fn too_thick(hose: &Inlet, coupon: &str, largest: f64) -> Refusal {
    let problem = format!("a hose of {} has no room on the {coupon}", hose.tube_diameter);
    let remedy = format!(
        "tube_diameter must be below {} mm: take a thinner hose, or make other coupons only",
        Most(largest.max(0.0))
    );
    Refusal::new(key::inlet::TUBE_DIAMETER, RefusalCode::InletMeetsArm, problem, remedy)
}

/// The arms of a V, and the mouth at the end of the upper one.
struct Arm<'a> {
    star: &'a StarSpec,
    /// Half the flat width of the channel.
    half_mouth: f64,
    /// Length of the channel.
    mouth: f64,
}

impl Arm<'_> {
    /// The line at the distance `delta` outside of the tube, `inner_delta` on the side where the arms face each other; its ends are
    /// `overrun` beyond the mouth.
    fn vee(&self, delta: f64, inner_delta: f64, overrun: f64) -> Path {
        let (w, r, half) = (self.star.tube_width.0, self.star.tip_radius.0, self.star.tip_angle.rad() / 2.0);
        let arm = 4.0 * w + delta;
        let end = 4.0 * w + self.mouth + overrun;
        let (sin, cos) = libm::sincos(half);
        // In the frame of an arm: away from the hinge, and outwards.
        let point = |side: f64, along: f64, out: f64| {
            Point::ORIGIN + Vec2::new(-cos, side * sin) * along + Vec2::new(sin, side * cos) * out
        };
        let (outer, inner) = (r + w + delta, r - inner_delta);
        let (middle, h) = (r + w / 2.0, self.half_mouth + delta);
        // A sharp inner hinge is a vertex that eats into the arms.
        let eaten = (-inner).max(0.0) / libm::tan(half);
        let mut segments = Vec::new();
        // If the channel's flap is as wide as the arm's, the end has no shoulder.
        let (low, high) = ((middle - h).max(inner), (middle + h).min(outer));
        segments.extend(lines(&[
            point(1.0, end, high),
            point(1.0, arm, high),
            point(1.0, arm, outer),
            point(1.0, 0.0, outer),
        ]));
        segments.push(Arc::new(Point::ORIGIN, outer, PI / 2.0 - half, 2.0 * half - PI).into());
        segments.extend(lines(&[
            point(-1.0, 0.0, outer),
            point(-1.0, arm, outer),
            point(-1.0, arm, inner),
            point(-1.0, eaten, inner),
        ]));
        if inner > 0.0 {
            segments.push(Arc::new(Point::ORIGIN, inner, half - PI / 2.0, PI - 2.0 * half).into());
        }
        segments.extend(lines(&[
            point(1.0, eaten, inner),
            point(1.0, arm, inner),
            point(1.0, arm, low),
            point(1.0, end, low),
        ]));
        Path::open(segments)
    }
}

/// The lines between neighbouring points, without lines of zero length.
fn lines(points: &[Point]) -> Vec<Segment> {
    let is_long = |pair: &&[Point]| pair[0].distance(pair[1]) > 1e-9;
    points.windows(2).filter(is_long).map(|pair| Line::new(pair[0], pair[1]).into()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::units::{Speed, Temperature};

    fn seal() -> Seal {
        Seal {
            temperature: Temperature(200.0),
            power: None,
            speed: Speed(0.1),
            band: Length(2.0),
            overlap: Length(5.0),
            allowance: Length(8.0),
            hole_allowance: Length(1.0),
            ..Seal::default()
        }
    }

    fn inlet_of(diameter: f64) -> Inlet {
        Inlet { tube_diameter: Length(diameter), ..USUAL_HOSE }
    }

    fn width(path: &Path) -> f64 {
        path.start().expect("a path").distance(path.end().expect("a path"))
    }

    fn parts(pouch: &SealedShape) -> (&Path, &Path) {
        (&pouch.seams[0].center_line, pouch.cut.as_ref().expect("a cut"))
    }

    #[test]
    fn a_disc_has_its_diameter_and_a_mouth_for_its_hose() {
        for hose in [4.0, 8.0] {
            let pouch = disc(100.0, &inlet_of(hose), &seal()).expect("a disc");
            let (seam, cut) = parts(&pouch);
            assert_eq!(pouch.topology().leaks, []);
            assert!(seam.largest_gap() < 1e-9 && cut.largest_gap() < 1e-9);
            assert!((seam.bounds().height() - 102.0).abs() < 1e-9);
            assert!((cut.bounds().height() - 120.0).abs() < 1e-9);
            // Half the hose's circumference between the bands.
            assert!((width(seam) - 2.0 - PI * hose / 2.0).abs() < 1e-9);
            assert!((pouch.ports[0].width - PI * hose / 2.0).abs() < 1e-9);
            assert!((seam.bounds().max.x - 71.0).abs() < 1e-9 && (cut.bounds().max.x - 70.0).abs() < 1e-9);
        }
        assert_eq!(
            disc(40.0, &inlet_of(30.0), &seal()).map_err(|refusal| refusal.code),
            Err(RefusalCode::InletMeetsArm)
        );
    }

    #[test]
    fn a_v_is_one_unbroken_line_as_wide_as_its_tube() {
        for radius in [0.0, 0.5, 3.0] {
            let star = StarSpec { tip_radius: Length(radius), ..StarSpec::paper(5) };
            let pouch = vee(&star, &inlet_of(8.0), &seal()).expect("a V");
            let (seam, cut) = parts(&pouch);
            assert_eq!(pouch.topology().leaks, []);
            assert!(
                seam.largest_gap() < 1e-9 && cut.largest_gap() < 1e-9,
                "{radius}: {}",
                seam.largest_gap()
            );
            // Half way along an arm the two bands are apart by a tube's width and a band.
            let outwards = Vec2::new(15_f64.to_radians().sin(), 15_f64.to_radians().cos());
            let middle =
                Point::ORIGIN + Vec2::new(-outwards.y, outwards.x) * 60.0 + outwards * (radius + 15.0);
            assert!((seam.distance(middle) - 16.0).abs() < 1e-9, "{radius}");
            assert!((width(seam) - 2.0 - 4.0 * PI).abs() < 1e-9, "{radius}");
            // The cut keeps a distance from the band, except at the mouth.
            let distance = seam.segments[1..seam.segments.len() - 1]
                .iter()
                .map(|s| cut.distance(s.start()))
                .fold(f64::INFINITY, f64::min);
            assert!(distance >= 1.0 - 1e-9, "{radius}: {distance}");
            assert_eq!(
                vee(&star, &inlet_of(20.0), &seal()).map_err(|refusal| refusal.code),
                Err(RefusalCode::InletMeetsArm)
            );
        }
    }
}
