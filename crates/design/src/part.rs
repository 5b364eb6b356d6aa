//! One distinct star with everything that is drawn of it, in the star's own frame.

use crate::placement::footprint;
use crate::separator::air_of_star;
use crate::star_seam::star_seam;
use crate::{
    Channel, CutLines, MaskPlate, MaskTiles, Outline, PaperSeparator, Refusal, Refusals, SeamLines, Side,
    Star,
};
use geom::{Bounds, Path};
use sealed::{Port, SealedShape, Seam};
use spec::units::Length;
use spec::{SealProcess, Spec, StarSpec, key};

/// A star with its seams and its cut.
#[derive(Clone, Debug, PartialEq)]
pub struct StarDesign {
    /// The flat geometry.
    pub star: Star,
    /// The inlet; `None` if the tube is closed all around.
    pub channel: Option<Channel>,
    /// The tube's edges as drawn, towards the hole and outside (that one open where the inlet is).
    pub edges: [Path; 2],
    /// The tube's edges as a round iron makes them: no concave hinge sharper than half a band.
    pub realised_edges: [Path; 2],
    /// The sealed shape: the inner loop, then the outer loop.
    pub shape: SealedShape,
    /// The sealing of both loops, in their order.
    pub seam_lines: Vec<SeamLines>,
    /// The cut.
    pub outline: Outline,
    /// The coating mask.
    pub mask: MaskPlate,
    /// The paths of the tool that cuts both.
    pub cut: CutLines,
    /// The tiles in which the mask is printed: one, until it is divided for a bed.
    pub tiles: MaskTiles,
    /// The paper that keeps the air from welding in a heat press, if the spec has one.
    pub separator: Option<PaperSeparator>,
}

/// The radius that the band makes of a hinge, and the cusp that it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Realised {
    /// max(R, w/2).
    pub radius: f64,
    /// From the hinge's edge as drawn to the band's edge, along the hinge's ray: the part that stays unsealed.
    pub cusp: f64,
}

impl StarDesign {
    /// `star` of `spec` with the inner radius of curvature `radius` at tips and corners; `None` if it cannot be made, or its arms would fall
    /// through the plates that it needs.
    pub fn with_radii(spec: &Spec, star: &Star, radius: Length) -> Option<Star> {
        let round = StarSpec { tip_radius: radius, corner_radius: radius, ..star.spec() };
        let Self { star, .. } = Self::new(spec, &round).ok()?;
        star.lies_on(star.rho_0 + spec.frame.clearance.0).then_some(star)
    }

    /// The design of one star of `spec`.
    ///
    /// # Errors
    /// Every reason for which it cannot be made, each once.
    pub fn new(spec: &Spec, star_spec: &StarSpec) -> Result<Self, Refusals> {
        let seal = &spec.seal;
        let star = Star::for_band(star_spec, seal.band)?;
        let half_band = seal.band.0 / 2.0;
        let channel = spec.inlet.as_ref().map(|inlet| Channel::new(&star, inlet, star_spec.inlet_tip));
        let mut refusals = Refusals::new();
        let processes = [&star_spec.inner_process, &star_spec.outer_process].map(|name| spec.process(name));
        let inner = refusals.keep(star_loop(spec, &star, Side::Hole, None, &processes[0]));
        // Before the outer seam: the cut lies farther out, so its limits for the inlet are the stricter ones.
        let hole_diameter = spec.sheet.hole_diameter.0;
        let outline =
            refusals.keep(Outline::new(&star, channel.as_ref(), star_spec.inlet_tip, seal, hole_diameter));
        let outer = refusals.keep(star_loop(spec, &star, Side::Outside, channel.as_ref(), &processes[1]));
        let loops = [&inner, &outer].into_iter().zip(&processes);
        let seam_lines: Vec<SeamLines> = loops
            .filter_map(|(seam, process)| refusals.keep(SeamLines::new(seam.as_ref()?, process)))
            .collect();
        let drawn_edges = refusals.keep(edges(&star, channel.as_ref(), 0.0));
        let realised = refusals.keep(edges(&star, channel.as_ref(), half_band));
        let mask = outline
            .as_ref()
            .and_then(|outline| refusals.keep(MaskPlate::new(spec, star_spec, &star, outline)));
        let cut = outline
            .as_ref()
            .zip(mask.as_ref())
            .and_then(|(outline, mask)| refusals.keep(CutLines::new(spec.cut.kerf.0, &star, outline, mask)));
        match (inner.zip(outer), outline, drawn_edges.zip(realised), mask, cut) {
            (Some((inner, outer)), Some(outline), Some((edges, realised_edges)), Some(mask), Some(cut))
                if refusals.is_empty() =>
            {
                let port = |channel: &Channel| Port {
                    at: channel.mouth_center(&star),
                    width: 2.0 * channel.half_width,
                };
                let shape = SealedShape {
                    seams: vec![inner, outer],
                    band: seal.band.0,
                    cut: Some(outline.outside.clone()),
                    ports: channel.iter().map(port).collect(),
                    valves: Vec::new(),
                };
                let tiles = MaskTiles::one_piece(&mask);
                let air = air_of_star(&star, &realised_edges, channel.as_ref());
                let separator = PaperSeparator::new(spec, &shape, &air)?;
                Ok(Self {
                    star,
                    channel,
                    edges,
                    realised_edges,
                    shape,
                    seam_lines,
                    outline,
                    mask,
                    cut,
                    tiles,
                    separator,
                })
            }
            _ => Err(refusals.each_once()),
        }
    }

    /// The tips as the band realises them.
    pub fn realised_tip(&self) -> Realised {
        self.star.realised_tip(self.shape.band)
    }

    /// The reentrant corners as the band realises them.
    pub fn realised_corner(&self) -> Realised {
        self.star.realised_corner(self.shape.band)
    }

    /// Fabric of the star, both sheets, mm^2: the area inside the cut, registration holes included.
    pub fn fabric(&self) -> f64 {
        SHEETS * self.outline.area()
    }

    /// The box that the part needs on the sheet: its cut, and the bands with ramps of length `ramp`.
    pub fn footprint(&self, ramp: f64) -> Bounds {
        footprint(&self.shape, &self.cut.outside, ramp)
    }

    /// Radius of the largest circle around the axis that the hole-side flap leaves free.
    pub fn clear_radius(&self) -> f64 {
        self.outline.hole.distance(geom::Point::ORIGIN)
    }
}

/// Sheets of fabric that one star is made of.
pub const SHEETS: f64 = 2.0;

impl Star {
    /// The tips as a band of width `band` (mm) realises them.
    pub fn realised_tip(&self, band: f64) -> Realised {
        realised(self.r_i, self.phi_i, band)
    }

    /// The reentrant corners as a band of width `band` (mm) realises them.
    pub fn realised_corner(&self, band: f64) -> Realised {
        realised(self.r_e, self.phi_e, band)
    }
}

/// Inner radius of curvature, mm, that a round iron makes of the drawn one `r`: at least half the band's width.
pub fn realised_radius(r: f64, band: f64) -> f64 {
    r.max(band / 2.0)
}

/// A round iron of radius w/2 leaves `(w/2 - R) (1/sin(phi/2) - 1)` of a sharper hinge unsealed.
fn realised(r: f64, phi: f64, band: f64) -> Realised {
    let shortage = (band / 2.0 - r).max(0.0);
    Realised { radius: realised_radius(r, band), cusp: shortage * (1.0 / libm::sin(phi / 2.0) - 1.0) }
}

/// The seam of `star` on `side`, which `process` seals. A refusal of its overlap is at the key of the process, if that is where it differs
/// from `[seal]`.
fn star_loop(
    spec: &Spec,
    star: &Star,
    side: Side,
    channel: Option<&Channel>,
    process: &SealProcess,
) -> Result<Seam, Refusal> {
    star_seam(star, side, channel, &process.seal).map_err(|refusal| {
        let place = spec.processes.iter().position(|other| other.name == process.name);
        let has_overlap = process.seal.overlap != spec.seal.overlap;
        match place.filter(|_| has_overlap && refusal.key == key::seal::OVERLAP) {
            Some(place) => Refusal { key: key::process::OVERLAP.of_process(place), ..refusal },
            None => refusal,
        }
    })
}

/// The tube's two edges, concave hinges and fillets at least `least_radius` round.
fn edges(star: &Star, channel: Option<&Channel>, least_radius: f64) -> Result<[Path; 2], Refusal> {
    let [hole_edge, outer_edge] =
        [Side::Hole, Side::Outside].map(|side| star.contour(side, 0.0, least_radius).unwrap_or_default());
    let outer = match channel {
        Some(channel) => channel.open(star, &outer_edge, 0.0, least_radius, 0.0)?,
        None => outer_edge.path(),
    };
    Ok([hole_edge.path(), outer])
}
