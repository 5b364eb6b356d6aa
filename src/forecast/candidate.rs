//! One design among many: the same closed forms as a prediction's, by the ring's table, in a few microseconds.

use crate::forecast::cut::{Flaps, cut_area};
use crate::forecast::predict::geometry;
use crate::mechanics::fault::{HingeFault, StarFault};
use crate::mechanics::hinge::ring::{Ring, RingTable};
use crate::mechanics::hinge::{Edges, Effort, HingeModel, HingeState, Level};
use crate::mechanics::star::response::Inflated;
use crate::mechanics::star::{Star, StarGeometry};
use crate::mechanics::strength::{ElasticSheet, burst_pressure, payload};
use crate::spec::Spec;

/// The exact ring with its targets from the table.
#[derive(Clone, Copy, Debug)]
pub struct TableRing<'a>(pub &'a RingTable);

impl HingeModel for TableRing<'_> {
    fn level(&self) -> Level {
        Level::Ring
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        Ring.state(r_star, lambda)
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        let entry = self.0.at(r_star)?;
        Ok(HingeState {
            lambda: entry.lambda_t,
            volume: Some(entry.volume),
            slope: 0.0,
            curvature: entry.curvature,
            edges: Some(Edges {
                tension: entry.tension,
                angle: entry.angle,
                width: entry.width,
                rim_force: 2.0 * entry.tension * entry.angle.cos(),
            }),
            effort: Effort { residual: 0.0, iterations: 0, error: RingTable::ERROR },
        })
    }

    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        Ok(Some(self.0.at(r_star)?.lambda_c))
    }
}

/// One gripper of equal stars; SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The star.
    pub geometry: StarGeometry,
    /// Fabric thickness t, m.
    pub thickness: f64,
    /// Young's modulus E, Pa.
    pub young_modulus: f64,
    /// Poisson ratio.
    pub poisson_ratio: f64,
    /// Gauge pressure, Pa.
    pub pressure: Option<f64>,
    /// Radius of the object, m.
    pub object: Option<f64>,
    /// Friction with the object.
    pub friction: Option<f64>,
    /// Peel strength of the seal, N per m.
    pub peel: Option<f64>,
    /// Width of the band, m.
    pub band: f64,
    /// What surrounds the tube.
    pub flaps: Flaps,
    /// Number of equal stars.
    pub stars: u32,
}

/// What one design does; `None` where something is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Arm length, m.
    pub arm: f64,
    /// Equilibrium angle of the tips, rad, not clamped.
    pub equilibrium: f64,
    /// Final inner radius, m.
    pub final_radius: f64,
    /// 1 - rho_f / rho_0.
    pub contraction: f64,
    /// Radial stiffness of one star, N per m.
    pub stiffness: Option<f64>,
    /// Pressure of full actuation, Pa.
    pub operating_pressure: f64,
    /// Force of one star on the object, N.
    pub force: Option<f64>,
    /// Payload of the stack, kg.
    pub payload: Option<f64>,
    /// Burst pressure, Pa.
    pub burst: Option<f64>,
    /// Fabric area of one sheet of one star, m^2.
    pub area: f64,
    /// Distance from the axis to the outermost cut, m.
    pub reach: f64,
}

impl Candidate {
    /// The first star of `spec`, with the whole stack's count.
    pub fn of(spec: &Spec) -> Option<Self> {
        let mm = 1e-3;
        let load = spec.load.as_ref();
        Some(Self {
            geometry: geometry(spec.stars.first()?),
            thickness: spec.fabric.thickness.0 * mm,
            young_modulus: spec.fabric.young_modulus.0 * 1e3,
            poisson_ratio: spec.fabric.poisson_ratio,
            pressure: load.and_then(|load| load.pressure).map(|p| p.0 * 1e3),
            object: load.and_then(|load| load.object_radius).map(|r| r.0 * mm),
            friction: load.and_then(|load| load.friction),
            peel: spec.fabric.seal_strength.map(|strength| strength.0 * 1e3),
            band: spec.seal.band.0 * mm,
            flaps: Flaps {
                outside: (spec.seal.band.0 + spec.seal.allowance.0) * mm,
                hole: (spec.seal.band.0 + spec.seal.hole_allowance.0) * mm,
                inlet: spec.inlet.as_ref().map(|inlet| (inlet.tube_diameter.0 * mm, inlet.length.0 * mm)),
            },
            stars: u32::try_from(spec.stars.len()).unwrap_or(u32::MAX),
        })
    }

    /// What it does, with linear hinges at the ring's target.
    ///
    /// # Errors
    /// If there is no such star.
    pub fn outcome(&self, table: &RingTable) -> Result<Outcome, StarFault> {
        let star = Star::new(self.geometry)?;
        let sheet = ElasticSheet::new(self.thickness, self.young_modulus, self.poisson_ratio)?;
        let StarGeometry { inner_radius, width, .. } = self.geometry;
        let model = TableRing(table);
        let inflated = Inflated::new(&star, &model, self.pressure.unwrap_or(1.0))?;
        let rest = inflated.linear_rest();
        let force = match (self.pressure, self.object) {
            (Some(_), Some(rho)) if rho <= inner_radius && rho >= rest.radius => {
                Some(inflated.linear_force(rho, &rest)?)
            }
            (Some(_), Some(rho)) if rho < rest.radius => Some(0.0),
            _ => None,
        };
        let stack = f64::from(self.stars);
        Ok(Outcome {
            arm: star.arm_length(),
            equilibrium: rest.equilibrium,
            final_radius: rest.radius,
            contraction: 1.0 - rest.radius / inner_radius,
            stiffness: self.pressure.map(|_| rest.stiffness),
            operating_pressure: sheet.operating_pressure(width),
            force,
            payload: self.friction.zip(force).map(|(mu, force)| payload(mu, [stack * force])),
            burst: self.burst(table)?,
            area: cut_area(&star, &self.flaps),
            reach: star.tip_distance() + self.geometry.tip_radius + width + self.flaps.outside,
        })
    }

    /// Burst pressure at the realised radii.
    fn burst(&self, table: &RingTable) -> Result<Option<f64>, StarFault> {
        let Some(peel) = self.peel else { return Ok(None) };
        let StarGeometry { width, tip_radius, corner_radius, .. } = self.geometry;
        let r_star = tip_radius.min(corner_radius).max(0.5 * self.band) / width;
        let entry = table.at(r_star)?;
        Ok(Some(burst_pressure(peel, width, entry.tension * entry.lambda_t / r_star)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forecast::predict::predict;
    use crate::spec::{Source, read, starter};

    #[test]
    fn a_point_says_what_the_prediction_says() {
        let text = starter("x").expect("a name")
            + "\n[load]\npressure = \"37 kPa\"\nobject_radius = \"30 mm\"\nfriction = 0.5\n";
        let mut spec = read(&Source::new("x", text)).expect("valid").spec;
        spec.accuracy.model = crate::spec::ModelChoice::Ring;
        spec.fabric.seal_strength = Some(crate::units::LineForce(3.0));
        let full = predict(&spec).expect("predictable").first;
        let table = RingTable::new().expect("solved");
        let fast = Candidate::of(&spec).expect("a star").outcome(&table).expect("feasible");
        let pairs = [
            (fast.arm * 1e3, full.arm_length_mm),
            (fast.final_radius * 1e3, full.final_radius_mm),
            (fast.contraction, full.contraction),
            (fast.operating_pressure * 1e-3, full.operating_pressure_kPa),
            (fast.stiffness.unwrap_or(0.0), full.radial_stiffness_N_per_m.unwrap_or(1.0)),
            (fast.payload.unwrap_or(0.0), full.payload_kg.unwrap_or(1.0)),
            (fast.burst.unwrap_or(0.0) * 1e-3, full.burst_pressure_kPa.unwrap_or(1.0)),
        ];
        for (a, b) in pairs {
            assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        }
    }
}
