//! The inputs of a spec for one star, in SI units: the only conversion from mm to m and from kPa to Pa.

use crate::interval::Interval;
use design::{Meeting, Star, StarDesign};
use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::star::{Correction, Mechanism};
use inflatable::mechanics::strength::{ElasticSheet, GRAVITY};
use inflatable::shell::element::Weave;
use serde::Serialize;
use spec::units::{BendingStiffness, Length, LineForce, Pressure};
use spec::{Fabric, Load, Seal, Spec};

/// One value for the tips, one for the reentrant corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Hinges<T> {
    /// Value of the tips.
    pub tip: T,
    /// Value of the reentrant corners.
    pub corner: T,
}

/// One star with all inputs of its prediction, in SI units. `None` where the spec gives no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// The mechanism of rigid arms and hinges.
    pub mechanism: Mechanism,
    /// Inner radius rho_0 of the flat star, m.
    pub inner_radius: f64,
    /// Inner radius of curvature that the band makes of tip and corner, m.
    pub realised: Hinges<f64>,
    /// Width of the sealed band, m.
    pub band: f64,
    /// The fabric.
    pub sheet: ElasticSheet,
    /// Peel strength of the seams at tips and corners, N per m: of the inner loop at the tips, of the outer one at the corners.
    pub peel: Hinges<Option<f64>>,
    /// Gauge pressure, Pa.
    pub pressure: Option<f64>,
    /// Radius of the hole's cut edge, m: a wider object does not enter.
    pub hole: f64,
    /// Radius of the object where the star meets it, m; 0 where the star passes above or below it.
    pub object: Option<f64>,
    /// Largest radius of the object's parts that must pass the hole, m.
    pub entering: Option<f64>,
    /// Friction with the object.
    pub friction: Option<f64>,
    /// Within which it lies.
    pub friction_range: Option<Interval>,
    /// Radius of the opening of the plate below, from whose edge on arms are supported, m; `None` without a frame.
    pub opening: Option<f64>,
    /// Largest radial force that the object bears of one star, N.
    pub largest_force: Option<f64>,
}

/// The strengths of the inner and the outer loop, by the hinges that they hold.
fn loop_strengths(loops: [Option<LineForce>; 2]) -> Hinges<Option<f64>> {
    let [tip, corner] = loops.map(|strength| strength.map(LineForce::newtons_per_metre));
    Hinges { tip, corner }
}

impl Case {
    /// The case of `star` around the middle of its object, made of `fabric`, with the seal `seal` and the load `load`.
    ///
    /// # Errors
    /// If a property of the fabric is out of its range; a spec's never is.
    pub fn new(star: &Star, fabric: &Fabric, seal: &Seal, load: Option<&Load>) -> Result<Self, StarFault> {
        let band = seal.band.0;
        let realised = [star.realised_tip(band), star.realised_corner(band)];
        let [tip, corner] = realised.map(|hinge| Length(hinge.radius).metres());
        Ok(Self {
            mechanism: mechanism(star),
            inner_radius: Length(star.rho_0).metres(),
            realised: Hinges { tip, corner },
            band: seal.band.metres(),
            sheet: sheet(fabric)?,
            peel: loop_strengths([fabric.seal_strength; 2]),
            pressure: load.and_then(|load| load.pressure).map(Pressure::pascals),
            hole: Length(star.hole(seal)).metres(),
            object: load.and_then(|load| load.object_radius).map(Length::metres),
            entering: load.and_then(|load| load.object_radius).map(Length::metres),
            friction: load.and_then(|load| load.friction),
            friction_range: load.and_then(Load::friction_range),
            opening: None,
            largest_force: load.and_then(|load| load.largest_force).map(|force| force.0),
        })
    }

    /// The case of `star` alone, made of `sheet` at `pressure`, Pa: without band, flap, load and object, as shells of stars are computed.
    pub fn bare(star: &Star, sheet: ElasticSheet, pressure: f64) -> Self {
        let inner_radius = Length(star.rho_0).metres();
        Self {
            mechanism: mechanism(star),
            inner_radius,
            realised: Hinges::default(),
            band: 0.0,
            sheet,
            peel: Hinges::default(),
            pressure: Some(pressure),
            hole: inner_radius,
            object: None,
            entering: None,
            friction: None,
            friction_range: None,
            opening: None,
            largest_force: None,
        }
    }

    /// The case of the star of `part`, made by `spec`, with the strengths of its two loops.
    ///
    /// # Errors
    /// The errors of [`Case::new`].
    pub fn of_part(spec: &Spec, part: &StarDesign) -> Result<Self, StarFault> {
        let strengths =
            [0, 1].map(|index: usize| spec.process(&part.seam_lines.get(index)?.process).strength);
        Ok(Self::of_star(spec, &part.star)?.with_strengths(strengths))
    }

    /// This star with the strengths of its inner and its outer loop.
    #[must_use]
    pub fn with_strengths(self, loops: [Option<LineForce>; 2]) -> Self {
        Self { peel: loop_strengths(loops), ..self }
    }

    /// The least peel strength of its seams, N per m; `None` if one is unknown.
    pub fn least_peel(&self) -> Option<f64> {
        Some(self.peel.tip?.min(self.peel.corner?))
    }

    /// The case of `star`, one of the stars of `spec`.
    ///
    /// # Errors
    /// The errors of [`Case::new`].
    pub fn of_star(spec: &Spec, star: &Star) -> Result<Self, StarFault> {
        Self::new(star, &spec.fabric, &spec.seal, spec.load.as_ref())
    }

    /// This star around a cylinder of `radius`, m.
    #[must_use]
    pub fn on_cylinder(self, radius: f64) -> Self {
        Self { object: Some(radius), entering: Some(radius), ..self }
    }

    /// This star meeting the object as `meeting` specifies; unchanged for `None`.
    #[must_use]
    pub fn meeting(self, meeting: Option<Meeting>) -> Self {
        let object = meeting.map(|meeting| Length(meeting.radius).metres());
        let entering = meeting.map(|meeting| Length(meeting.entering).metres());
        Self { object, entering, ..self }
    }

    /// This star above a plate with an `opening` of this radius, mm.
    #[must_use]
    pub fn above_plate(self, opening: Option<f64>) -> Self {
        Self { opening: opening.map(|radius| Length(radius).metres()), ..self }
    }

    /// Mass on the star, kg, at which its arms wrinkle between plate and object; `rest` is the tips' angle of the empty star, rad. `None` without
    /// a pressure, an object, or a plate whose opening is wider than it.
    pub fn wrinkling_mass(&self, rest: f64) -> Option<f64> {
        let object = self.object.filter(|object| *object > 0.0)?;
        let weight = self.mechanism.wrinkling_weight(self.pressure?, [object, self.opening?], rest);
        weight.is_finite().then_some(weight / GRAVITY)
    }

    /// Depth of the flap in front of the gripping corners, m: band and `hole_allowance`.
    pub fn flap(&self) -> f64 {
        self.inner_radius - self.hole
    }

    /// Bendability 1/eps; `None` without a pressure.
    pub fn bendability(&self) -> Option<f64> {
        Some(self.sheet.bendability(self.pressure?, self.mechanism.width))
    }

    /// Stretch p W / Y of the fabric; `None` without a pressure.
    pub fn stretch(&self) -> Option<f64> {
        Some(self.sheet.stretch(self.pressure?, self.mechanism.width))
    }

    /// Pressure from which the hinges are fully coiled, Pa.
    pub fn operating_pressure(&self) -> f64 {
        self.sheet.operating_pressure(self.mechanism.width)
    }
}

/// The sheet of `fabric`: measured stiffnesses replace those from E, t and nu.
///
/// # Errors
/// If a property is out of its range; a spec's never is.
pub fn sheet(fabric: &Fabric) -> Result<ElasticSheet, StarFault> {
    let (thickness, poisson) = (fabric.thickness.metres(), fabric.poisson_ratio);
    let even = ElasticSheet::new(thickness, fabric.young_modulus.pascals(), poisson)?;
    let (bending, stretch) = (fabric.bending_stiffness, fabric.stretch_stiffness);
    if bending.is_none() && stretch.is_none() {
        return Ok(even);
    }
    let bending = bending.map_or(even.bending_modulus(), BendingStiffness::newton_metres);
    let stretch = stretch.map_or(even.stretching_modulus(), LineForce::newtons_per_metre);
    ElasticSheet::of_stiffnesses(bending, stretch, poisson)
}

/// The weave of `fabric`: isotropic without a shear modulus. Measured stiffnesses keep their share of an isotropic sheet's shear.
///
/// # Errors
/// As of [`sheet`].
pub fn weave(fabric: &Fabric) -> Result<Weave, StarFault> {
    let Some(modulus) = fabric.shear_modulus else { return Ok(Weave::ISOTROPIC) };
    let isotropic = sheet(fabric)?.stretching_modulus() / (2.0 * (1.0 + fabric.poisson_ratio));
    let shear = modulus.pascals() * fabric.thickness.metres() / isotropic;
    Ok(Weave { shear, warp: fabric.warp.rad() })
}

/// Which stiffnesses of `fabric` were measured, in words.
pub fn measured_stiffnesses(fabric: &Fabric) -> Option<&'static str> {
    match (fabric.bending_stiffness, fabric.stretch_stiffness) {
        (None, None) => None,
        (Some(_), None) => Some("bending_stiffness as measured, the rest from young_modulus and thickness"),
        (None, Some(_)) => Some("stretch_stiffness as measured, the rest from young_modulus and thickness"),
        (Some(_), Some(_)) => Some("bending_stiffness and stretch_stiffness as measured"),
    }
}

/// The mechanism of the flat star `star`, in SI units.
pub fn mechanism(star: &Star) -> Mechanism {
    let [arm, width, tip_radius, corner_radius] =
        [star.l, star.w, star.r_i, star.r_e].map(|mm| Length(mm).metres());
    Mechanism {
        points: star.n,
        arm,
        width,
        tip_angle: star.phi_i,
        tip_radius,
        corner_radius,
        correction: Correction::default(),
    }
}
