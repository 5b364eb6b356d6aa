//! The outline: where the fabric is cut, and the registration holes.

use crate::contour::{Trimmed, Turns};
use crate::star_seam::hole_closed;
use crate::{Channel, Contour, Part, Refusal, Refusals, Side, Star, registration};
use geom::{Path, Point, Segment};
use spec::{Inlet, Seal};

/// A round hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// Centre of the hole.
    pub center: Point,
    /// Diameter of the hole.
    pub diameter: f64,
}

impl Circle {
    /// Area of the hole, mm^2.
    pub fn area(&self) -> f64 {
        std::f64::consts::FRAC_PI_4 * self.diameter * self.diameter
    }
}

/// The cut of one star, in the star's frame. Both paths are closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Around the star, band plus allowance outside the tube, square across the inlet's mouth.
    pub outside: Path,
    /// Around the hole, band plus hole allowance inside the tube.
    pub hole: Path,
    /// Distance from the axis to the outermost point of the cut, the inlet left out.
    pub reach: f64,
    /// Width of the flap outside the band.
    pub flap: f64,
    /// The registration holes: three, so placed that the part fits in one position only; or none.
    pub registration: Vec<Circle>,
}

impl Outline {
    /// The outline of `star`; `hole_diameter` 0 for no registration holes. They keep clear of tip `first`.
    ///
    /// # Errors
    /// Every reason for which it cannot be cut.
    pub fn new(
        star: &Star,
        channel: Option<&Channel>,
        first: u32,
        seal: &Seal,
        hole_diameter: f64,
    ) -> Result<Self, Refusals> {
        let band = seal.band.0;
        let mut refusals = Refusals::new();
        let hole = star.contour(Side::Hole, band + seal.hole_allowance.0, 0.0).map(|contour| contour.path());
        if hole.is_none() {
            refusals.push(hole_closed(star, seal));
        }
        let delta = band + seal.allowance.0;
        let Some(flap) = star.contour(Side::Outside, delta, 0.0) else { return Err(refusals) };
        let ears = punched(star, flap, first, seal, hole_diameter);
        let Some((flap, registration)) = refusals.keep(ears) else { return Err(refusals) };
        let reach = flap.path().furthest(Point::ORIGIN);
        let outer = match channel {
            Some(channel) => {
                refusals.keep(channel.open(star, &flap, delta, 0.0, 0.0)).map(Channel::mouth_cut)
            }
            None => Some(flap.path()),
        };
        match (outer, hole) {
            (Some(outer), Some(hole)) if refusals.is_empty() => {
                Ok(Self { outside: outer, hole, reach, flap: seal.allowance.0, registration })
            }
            _ => Err(refusals),
        }
    }

    /// Area of the fabric inside the cut, registration holes left out, mm^2.
    pub fn area(&self) -> f64 {
        self.outside.area() - self.hole.area()
    }
}

/// Area inside the cut of the star's outline, mm^2, in closed form; `None` if it cannot be cut.
///
/// It is [`Outline::area`] of [`Outline::new`], without drawing the outline: for searches over many stars.
pub fn cut_area(
    star: &Star,
    seal: &Seal,
    inlet: Option<&Inlet>,
    inlet_tip: u32,
    hole_diameter: f64,
) -> Option<f64> {
    let n = f64::from(star.n);
    let hole = star.trimmed(Side::Hole, seal.band.0 + seal.hole_allowance.0, 0.0)?;
    let delta = seal.band.0 + seal.allowance.0;
    let flap = star.trimmed(Side::Outside, delta, 0.0)?;
    let turns = Turns::new(star);
    let mut area = n * (flap.sector_area(&turns) - hole.sector_area(&turns));
    let (Trimmed::Arms { tip, .. } | Trimmed::Tips(tip)) = flap else { return None };
    if hole_diameter > 0.0 {
        let sites = registration::sites(star, tip.half, inlet_tip, seal, hole_diameter).ok()?;
        area += sites.iter().map(|site| site.ear_area(tip.radius)).sum::<f64>();
    }
    if let Some(inlet) = inlet {
        area += Channel::new(star, inlet, inlet_tip).cut_area(star, tip.radius, tip.half, delta)?;
    }
    Some(area)
}

/// The flap's contour with the registration holes in it, on ears where the flap is too narrow; without any for the diameter 0.
fn punched(
    star: &Star,
    flap: Contour,
    first: u32,
    seal: &Seal,
    diameter: f64,
) -> Result<(Contour, Vec<Circle>), Refusal> {
    if diameter <= 0.0 {
        return Ok((flap, Vec::new()));
    }
    let half = flap.parts.iter().find_map(|(part, segment)| match (part, segment) {
        (Part::Tip(_), Segment::Arc(arc)) => Some(arc.sweep / 2.0),
        _ => None,
    });
    let sites = registration::sites(star, half.unwrap_or(0.0), first, seal, diameter)?;
    let holes = sites.iter().map(|site| Circle { center: site.center(star), diameter }).collect();
    let mut parts = Vec::with_capacity(flap.parts.len() + 2 * sites.len());
    for (part, segment) in flap.parts {
        let on_it = sites.iter().filter(|site| part == Part::Tip(site.tip));
        let pieces = registration::with_ears(segment, on_it);
        parts.extend(pieces.into_iter().map(|piece| (part, piece)));
    }
    Ok((Contour { parts, arm: flap.arm }, holes))
}
