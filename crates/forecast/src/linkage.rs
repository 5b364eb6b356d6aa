//! The inflated star as a **linkage**: a ring of rigid links with springs in its joints, as simulators of rigid bodies take it.
//!
//! An arm is the link from the centre T of a tip's arc to the centre P of a corner's, long `L = hypot(l, h)` with `h = w + r_i + r_e`. It
//! leans by `phi/2 + beta`, `tan(beta) = h / l`, from the ray of its tip, so that P is `L sin(phi/2 + beta) / sin(pi/n)` away from the axis. The
//! corner presses on an object with a sphere of radius q around P. The widths of the closed star are kept, and q is such that the closed star
//! has the predicted radius. With sharp hinges this is the mechanism of the prediction at every angle; round hinges also coil, and their
//! pins would move. Where a star meets a ball of radius R beside its middle, at the radius r, the sphere touches it at a smaller angle:
//! P is then `sqrt(r^2 + 2 R q + q^2)` away, which is r + q at the middle and on a cylinder.
//!
//! The springs are linear. Both hinges of a star rest at their targets, moved alike so that they balance where the star is predicted to, and
//! have their stiffnesses times one factor. It gives the predicted force on the object; where none is predicted, the predicted radial
//! stiffness of the closed star. So forces on objects of other radii differ from those of a prediction, which takes hinges to stiffen.

use std::f64::consts::PI;

use crate::case::mechanism;
use crate::pose::at_angle;
use crate::prediction::{Hinges, StarPrediction};
use design::Star;
use inflatable::mechanics::star::Mechanism;
use spec::units::Length;

/// A ring of links in a pose: around the object that it holds, or closed. SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linkage {
    /// Number of tips, and of corners.
    pub points: u32,
    /// Distance of the tips' pins from the axis.
    pub tip_pin: f64,
    /// Distance of the corners' pins from the axis.
    pub corner_pin: f64,
    /// Radius q of a corner around its pin.
    pub corner_radius: f64,
    /// The tube between two pins.
    pub tube: LinkTube,
    /// The springs of the joints.
    pub springs: Hinges<JointSpring>,
    /// By how much tips turn from the pose until their arms touch, rad, 0 or less.
    pub touching_turn: f64,
    /// The prediction that gave the stiffness of the springs.
    pub basis: StiffnessBasis,
}

/// A straight tube beside the link from a corner's to a tip's pin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkTube {
    /// Angle between tube and link, rad.
    pub lean: f64,
    /// Length l of the tube.
    pub length: f64,
    /// Half the width of the tube.
    pub radius: f64,
    /// Distance of its centre line from the corner's pin.
    pub corner_offset: f64,
}

/// A spring in a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSpring {
    /// Stiffness, N m per rad.
    pub stiffness: f64,
    /// By how much the joint opens from the pose to the spring's rest, rad.
    pub rest_turn: f64,
}

/// What the springs' stiffness is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffnessBasis {
    /// The predicted force on the object.
    ObjectForce,
    /// The predicted radial stiffness of the closed star.
    RadialStiffness,
    /// The predicted stiffness of each hinge: neither force nor radial stiffness is known.
    Hinges,
}

/// The link of an arm.
#[derive(Clone, Copy, Debug)]
struct ArmLink {
    length: f64,
    lean: f64,
    sector_sine: f64,
}

impl ArmLink {
    /// Distance of a corner's pin from the axis at the tips' angle `phi`, and its derivative, m and m per rad.
    fn corner_pin(self, phi: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(0.5 * phi + self.lean);
        [sin, 0.5 * cos].map(|part| self.length * part / self.sector_sine)
    }

    /// The tips' angle at which a corner's pin is at `distance` from the axis, m; `None` if it never is.
    fn angle_at(self, distance: f64) -> Option<f64> {
        let sine = distance * self.sector_sine / self.length;
        (sine < 1.0).then(|| 2.0 * (libm::asin(sine) - self.lean))
    }
}

/// The pose of a ring, and what its springs' stiffness is multiplied by.
#[derive(Clone, Copy, Debug)]
struct RingPose {
    /// The tips' angle, rad.
    angle: f64,
    factor: f64,
    basis: StiffnessBasis,
}

impl RingPose {
    /// The pose on an object that corners touch with their pins at `touching_pin`, m; `None` without a force on it in `predicted`. `spring` is
    /// the stiffness of all hinges, N m per rad, and `balance` the tips' angle at which they balance.
    fn on_object(
        link: ArmLink,
        touching_pin: f64,
        [spring, balance]: [f64; 2],
        predicted: &StarPrediction,
    ) -> Option<Self> {
        let force = predicted.object_force_N.filter(|force| *force > 0.0)?;
        let angle = link.angle_at(touching_pin)?;
        let factor = force * link.corner_pin(angle)[1] / (spring * (angle - balance));
        Some(Self { angle, factor, basis: StiffnessBasis::ObjectForce })
    }

    /// The closed pose, at the tips' angle `angle`.
    fn closed(link: ArmLink, spring: f64, angle: f64, predicted: &StarPrediction) -> Self {
        let [_, slope] = link.corner_pin(angle);
        match predicted.radial_stiffness_N_per_m {
            Some(stiffness) => Self {
                angle,
                factor: stiffness * slope * slope / spring,
                basis: StiffnessBasis::RadialStiffness,
            },
            None => Self { angle, factor: 1.0, basis: StiffnessBasis::Hinges },
        }
    }
}

impl Linkage {
    /// The linkage of `star` by `predicted`, around an object that is `widest` at its widest, radius; `None` where its closing or its hinges' stiffness is not predicted.
    ///
    /// The closed star gives the length of the links and the corners' radius. Then comes the pose, which gives the factor of the springs. The
    /// springs' rests count from the pose.
    pub fn new(star: &Star, predicted: &StarPrediction, widest: Option<Length>) -> Option<Self> {
        let moves = Mechanism { correction: predicted.correction, ..mechanism(star) };
        let Hinges { tip, corner } = predicted.hinge_stiffness_Nm?;
        let balance = predicted.tip_equilibrium_angle_deg?.to_radians();
        let rest = balance.max(predicted.correction.contact_angle);
        let closed = at_angle(star, &moves, rest);
        let [width, r_i, r_e] =
            [closed.width, closed.tip_radius, closed.corner_radius].map(|mm| Length(mm).metres());
        let h = width + r_i + r_e;
        let link = ArmLink {
            length: libm::hypot(moves.arm, h),
            lean: libm::atan2(h, moves.arm),
            sector_sine: moves.sector_sine(),
        };
        let corner_radius = link.corner_pin(rest)[0] - Length(predicted.final_radius_mm?).metres();
        let spring = f64::from(moves.points) * (tip + corner);
        let touching_pin = widest.zip(predicted.object_radius_mm).map(|(widest, radius)| {
            let [widest, radius] = [widest, Length(radius)].map(Length::metres);
            (radius * radius + corner_radius * (2.0 * widest + corner_radius)).sqrt()
        });
        let held_pose =
            touching_pin.and_then(|pin| RingPose::on_object(link, pin, [spring, balance], predicted));
        let RingPose { angle, factor, basis } =
            held_pose.unwrap_or_else(|| RingPose::closed(link, spring, rest, predicted));
        let tip_target = predicted.tip_target_angle_deg?.to_radians();
        let corner_target = predicted.corner_target_angle_deg?.to_radians() - moves.turn();
        let shift = balance - (tip * tip_target + corner * corner_target) / (tip + corner);
        let [corner_pin, _] = link.corner_pin(angle);
        let half_sector = PI / f64::from(moves.points);
        Some(Self {
            points: moves.points,
            tip_pin: corner_pin * libm::cos(half_sector) + link.length * libm::cos(0.5 * angle + link.lean),
            corner_pin,
            corner_radius,
            tube: LinkTube {
                lean: link.lean,
                length: moves.arm,
                radius: 0.5 * width,
                corner_offset: r_e + 0.5 * width,
            },
            springs: Hinges {
                tip: JointSpring { stiffness: factor * tip, rest_turn: tip_target + shift - angle },
                corner: JointSpring { stiffness: factor * corner, rest_turn: corner_target + shift - angle },
            },
            touching_turn: predicted.correction.contact_angle - angle,
            basis,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predict::predict;
    use design::Design;
    use spec::{Machine, Source, read};

    /// The linkages and predictions of the stars of the paper's gripper around an object of this radius, mm.
    fn linkages(hinges: &str, radius: &str) -> Vec<(Linkage, StarPrediction)> {
        let text = format!(
            "schema = 1\nname = \"x\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
             tip_angle = \"30 deg\"\n{hinges}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"{radius}\"\n"
        );
        let spec = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
        let design = Design::new(&spec, &Machine::builtin("generic").expect("built in")).expect("a star");
        let prediction = predict(&spec, &design).expect("section");
        let stars = &design.assembly().expect("stars").distinct;
        let predicted = &prediction.stars;
        stars
            .iter()
            .zip(predicted)
            .map(|(part, star)| {
                let widest = spec.load.as_ref().and_then(|load| load.object_radius);
                (Linkage::new(&part.star, star, widest).expect("known"), star.clone())
            })
            .collect()
    }

    /// The link's length, which no pose changes.
    fn link_length(linkage: &Linkage) -> f64 {
        let half_sector = PI / f64::from(linkage.points);
        let (across, along) = libm::sincos(half_sector);
        libm::hypot(linkage.corner_pin * across, linkage.tip_pin - linkage.corner_pin * along)
    }

    #[test]
    fn its_springs_press_on_the_object_as_predicted() {
        for hinges in ["", "tip_radius = \"2 mm\"\ncorner_radius = \"3 mm\""] {
            let (linkage, star) = linkages(hinges, "36 mm").remove(0);
            assert_eq!(linkage.basis, StiffnessBasis::ObjectForce);
            assert!((linkage.corner_pin - linkage.corner_radius - 0.036).abs() < 1e-12, "{linkage:?}");
            // Virtual work by finite differences of the pins.
            let torque = [linkage.springs.tip, linkage.springs.corner]
                .map(|spring| 5.0 * spring.stiffness * -spring.rest_turn)
                .iter()
                .sum::<f64>();
            let (length, sine) = (link_length(&linkage), libm::sin(PI / 5.0));
            let leaning = libm::asin(linkage.corner_pin * sine / length);
            let pins = [1e-5, -1e-5].map(|turn| length * libm::sin(leaning + 0.5 * turn) / sine);
            let slope = (pins[0] - pins[1]) / 2e-5;
            let force = star.object_force_N.expect("held");
            assert!((torque / slope / force - 1.0).abs() < 1e-8, "{torque} {slope} {force}");
        }
    }

    #[test]
    fn closed_it_has_the_predicted_radius_and_balances() {
        let (linkage, star) = linkages("", "10 mm").remove(0);
        let radius = linkage.corner_pin - linkage.corner_radius;
        assert!((1e3 * radius - star.final_radius_mm.expect("known")).abs() < 1e-9, "{linkage:?}");
        assert_eq!(linkage.basis, StiffnessBasis::RadialStiffness);
        let Hinges { tip, corner } = linkage.springs;
        assert!((tip.stiffness * tip.rest_turn + corner.stiffness * corner.rest_turn).abs() < 1e-12);
        assert!(linkage.touching_turn < 0.0 && tip.rest_turn < 0.0 && corner.rest_turn > 0.0, "{linkage:?}");
        let (opened, _) = linkages("", "40 mm").remove(0);
        assert!((link_length(&linkage) - link_length(&opened)).abs() < 1e-12);
    }
}
