//! A reduced model of a star gripper for MuJoCo, in its format MJCF: rigid arms, hinges with springs, and the object.
//!
//! Each star is a [`Linkage`]: a chain of links from corner 1 around the axis, closed by a constraint. The hinge at corner 1, where the chain
//! closes, has a tendon over all other joints as its spring: their angles sum to its own. The ring slides in its plane and touches nothing but
//! the object. SI units; z is the axis of the gripper, and 0 the bottom of the lowest plate.

use std::f64::consts::PI;
use std::fmt::Write as _;

use design::{Object, Stand, Star, StarAssembly};
use forecast::linkage::{JointSpring, LinkTube, Linkage, StiffnessBasis};
use forecast::prediction::{Prediction, StarPrediction};
use geom::{Point, Vec2};
use program::text::inert;
use spec::units::Length;
use spec::{ObjectShape, Spec};

/// Longest name of a model.
const NAME: usize = 80;
/// Fabric of both sheets where `areal_density` is not set, kg/m^2. Masses have no part in forces at rest.
const ASSUMED_DENSITY: f64 = 0.3;
/// Time constant of the hinges, s. Each has an armature and a damper of a critically damped spring: neither was measured, but hinges as light
/// as fabric make the solver of contacts chatter at steps of a millisecond.
const TIME_CONSTANT: f64 = 0.02;
/// Contacts, limits and the closing of the ring are stiff: with MuJoCo's own settings corners sink into the object by 1 % of its radius.
const STIFF: &str = "solref=\"0.005 1\" solimp=\"0.99 0.999 0.0001\"";

/// The model of the gripper of `spec` with these predicted stars.
pub fn mjcf(spec: &Spec, design: &StarAssembly, prediction: &Prediction) -> String {
    // The stars are written first, each as a ring in three parts. The parts then go into the sections of the model, and what a reader must know of
    // each star into its comment.
    let mut rings = RingParts::default();
    let mut comment = notes(spec, prediction);
    let widest = spec.load.as_ref().and_then(|load| load.object_radius);
    let heights = design.stack.stars.iter().zip(&design.stack.turns);
    for ((placed, predicted), (z, turn)) in design.stars.iter().zip(&prediction.stars).zip(heights) {
        let star = &design.part(placed).star;
        let linkage = Linkage::new(star, predicted, widest);
        comment.push_str(&star_note(placed.index, predicted, linkage.map(|linkage| linkage.basis)));
        if let Some(linkage) = linkage {
            let name = format!("star-{}", placed.index);
            let (z, mass) = (Length(*z).metres(), link_mass(star, predicted));
            LinkRing { name, linkage, z, mass, pins: pins(&linkage, *turn) }.write(&mut rings);
        }
    }
    let name = inert(&spec.name, NAME);
    let friction = friction_of(spec).map(|friction| format!(" friction=\"{}\"", number_of(friction)));
    let friction = friction.unwrap_or_default();
    let mut xml = format!(
        "<mujoco model=\"{name}\">\n  <!--\n{comment}  -->\n  <compiler angle=\"radian\"/>\n  \
         <option timestep=\"0.001\" integrator=\"implicitfast\" cone=\"elliptic\"/>\n  <default>\n    \
         <geom contype=\"0\" conaffinity=\"1\" {STIFF}{friction}/>\n    <joint type=\"hinge\" axis=\"0 0 1\"/>\n    \
         <default class=\"tube\">\n      <geom conaffinity=\"0\" rgba=\"0.8 0.3 0.2 1\"/>\n    </default>\n  </default>\n  \
         <worldbody>\n{}{}  </worldbody>\n",
        object(spec),
        rings.bodies
    );
    if !rings.closings.is_empty() {
        let RingParts { closings, tendons, .. } = rings;
        let _ = write!(xml, "  <equality>\n{closings}  </equality>\n  <tendon>\n{tendons}  </tendon>\n");
    }
    xml + "</mujoco>\n"
}

/// What a reader of the model must know.
fn notes(spec: &Spec, prediction: &Prediction) -> String {
    let mut text = String::from(
        "    stargrip-cam: reduced model, SI units. Corners touch the object, arms do not. Dampers and armatures are chosen, not measured.\n",
    );
    if prediction.stars.iter().any(|star| star.mass_g.is_none()) {
        let _ = writeln!(text, "    areal_density is not set: masses are those of {ASSUMED_DENSITY} kg/m^2.");
    }
    if friction_of(spec).is_none() {
        text.push_str("    friction is not set: it is that of MuJoCo.\n");
    }
    text
}

/// What the springs of star `number` were made from.
fn star_note(number: usize, predicted: &StarPrediction, basis: Option<StiffnessBasis>) -> String {
    let springs = match basis {
        Some(StiffnessBasis::ObjectForce) => "springs by the predicted force on the object",
        Some(StiffnessBasis::RadialStiffness) => {
            "springs by the predicted radial stiffness of the closed star"
        }
        Some(StiffnessBasis::Hinges) => "springs by the predicted hinges alone: the force may be far off",
        None => "left out, because its closing is not predicted",
    };
    let figures =
        [("final radius", predicted.final_radius_mm, "mm"), ("force", predicted.object_force_N, "N")]
            .into_iter()
            .filter_map(|(word, value, unit)| Some(format!("; {word} {} {unit}", number_of(value?))));
    format!("    Star {number}: {springs}{}.\n", figures.collect::<String>())
}

/// The friction between corners and object; `None` if it is not set.
fn friction_of(spec: &Spec) -> Option<f64> {
    spec.load.as_ref()?.friction
}

/// Mass of a link, kg: its share of the star's fabric.
fn link_mass(star: &Star, predicted: &StarPrediction) -> f64 {
    let sheets = 2.0 * Length(star.w).metres() * Length(star.l).metres();
    match predicted.mass_g {
        Some(grams) => 1e-3 * grams / f64::from(2 * star.n),
        None => ASSUMED_DENSITY * sheets,
    }
}

/// The object of `spec`, in its place and fixed; empty without one.
fn object(spec: &Spec) -> String {
    let object = spec.load.as_ref().and_then(Object::new);
    let Some((object, stand)) = object.zip(Stand::new(spec)) else { return String::new() };
    let half = 0.5 * object.height().metres();
    let radius = Length(object.radius_at(0.0)).metres();
    let shape = match object.shape() {
        ObjectShape::Cylinder => {
            format!("type=\"cylinder\" size=\"{} {}\"", number_of(radius), number_of(half))
        }
        ObjectShape::Ball => {
            let size = [radius, radius, half].map(number_of).join(" ");
            format!("type=\"ellipsoid\" size=\"{size}\"")
        }
    };
    let middle = number_of(Length(stand.object).metres() + half);
    format!(
        "    <body name=\"object\" pos=\"0 0 {middle}\">\n      <!-- Fixed: add a freejoint and a mass to lift it. -->\n      \
         <geom name=\"object\" contype=\"1\" {shape}/>\n    </body>\n"
    )
}

/// The parts of rings in the sections of a model.
#[derive(Debug, Default)]
struct RingParts {
    bodies: String,
    closings: String,
    tendons: String,
}

/// A star as a chain of links from corner 1 around the axis.
#[derive(Debug)]
struct LinkRing {
    name: String,
    linkage: Linkage,
    /// Height of its plane, m.
    z: f64,
    /// Mass of a link, kg.
    mass: f64,
    /// The pins at the beginnings of the links, counterclockwise from corner 1, m.
    pins: Vec<Point>,
}

impl LinkRing {
    /// Adds the ring to `parts`. Each link is a child of the one before, so its body ends after all others.
    fn write(&self, parts: &mut RingParts) {
        let mut indent = String::from("    ");
        for index in 0..self.pins.len() {
            self.write_link(&indent, index, &mut parts.bodies);
            indent.push_str("  ");
        }
        for _ in &self.pins {
            indent.truncate(indent.len() - 2);
            let _ = writeln!(parts.bodies, "{indent}</body>");
        }
        let (name, count) = (&self.name, self.pins.len());
        let end = coordinates(self.pins[0] - self.pins[count - 1]);
        let _ = writeln!(
            parts.closings,
            "    <connect name=\"{name}-ring\" body1=\"{name}-arm-{count}\" body2=\"{name}-arm-1\" anchor=\"{end} 0\" {STIFF}/>"
        );
        let JointSpring { stiffness, rest_turn } = self.linkage.springs.corner;
        let [stiffness, damping, length] = [stiffness, damping_of(stiffness), -rest_turn].map(number_of);
        let _ = writeln!(
            parts.tendons,
            "    <fixed name=\"{name}-corner-1\" stiffness=\"{stiffness}\" damping=\"{damping}\" springlength=\"{length}\">"
        );
        for index in 1..count {
            let _ =
                writeln!(parts.tendons, "      <joint joint=\"{}\" coef=\"1\"/>", hinge_name(name, index));
        }
        parts.tendons.push_str("    </fixed>\n");
    }

    /// Writes link `index` without its end: its joints, the corner's sphere if it begins there, and its tube.
    fn write_link(&self, indent: &str, index: usize, bodies: &mut String) {
        let Self { name, linkage, pins, .. } = self;
        let (pin, next, is_tip) = (pins[index], pins[(index + 1) % pins.len()], index % 2 == 1);
        let (parent, z) = if index == 0 { (Point::ORIGIN, self.z) } else { (pins[index - 1], 0.0) };
        let place = format!("{} {}", coordinates(pin - parent), number_of(z));
        let _ = writeln!(bodies, "{indent}<body name=\"{name}-arm-{}\" pos=\"{place}\">", index + 1);
        if index == 0 {
            self.write_carriage(indent, bodies);
        } else {
            self.write_hinge(indent, index, bodies);
        }
        if !is_tip {
            let (corner, size) = (index / 2 + 1, number_of(linkage.corner_radius));
            let _ = writeln!(
                bodies,
                "{indent}  <geom name=\"{name}-corner-{corner}\" size=\"{size}\" mass=\"0\"/>"
            );
        }
        let ends = tube(linkage, next - pin, is_tip).map(|end| format!("{} 0", coordinates(end))).join(" ");
        let (radius, mass) = (number_of(linkage.tube.radius), number_of(self.mass));
        let _ = writeln!(
            bodies,
            "{indent}  <geom class=\"tube\" type=\"capsule\" fromto=\"{ends}\" size=\"{radius}\" mass=\"{mass}\"/>"
        );
    }

    /// Writes the joints that let the ring slide and turn in its plane.
    fn write_carriage(&self, indent: &str, bodies: &mut String) {
        let name = &self.name;
        let sliding = f64::from(2 * self.linkage.points) * self.mass / TIME_CONSTANT;
        let turning = sliding * self.linkage.tip_pin * self.linkage.tip_pin;
        let [sliding, turning] = [sliding, turning].map(number_of);
        for (axis, direction) in [("x", "1 0 0"), ("y", "0 1 0")] {
            let _ = writeln!(
                bodies,
                "{indent}  <joint name=\"{name}-{axis}\" type=\"slide\" axis=\"{direction}\" damping=\"{sliding}\"/>"
            );
        }
        let _ = writeln!(bodies, "{indent}  <joint name=\"{name}-turn\" damping=\"{turning}\"/>");
    }

    /// Writes the hinge at the beginning of link `index`. Tips that open turn the next link clockwise, corners counterclockwise.
    fn write_hinge(&self, indent: &str, index: usize, bodies: &mut String) {
        let Linkage { springs, touching_turn, .. } = self.linkage;
        let is_tip = index % 2 == 1;
        let (JointSpring { stiffness, rest_turn }, sign) =
            if is_tip { (springs.tip, -1.0) } else { (springs.corner, 1.0) };
        let armature = TIME_CONSTANT * TIME_CONSTANT * stiffness;
        let [stiffness, damping, armature, reference] =
            [stiffness, damping_of(stiffness), armature, sign * rest_turn].map(number_of);
        let limit = if is_tip {
            let [opened, touching] = [-PI, -touching_turn].map(number_of);
            format!(" range=\"{opened} {touching}\" solreflimit=\"0.005 1\"")
        } else {
            String::new()
        };
        let _ = writeln!(
            bodies,
            "{indent}  <joint name=\"{}\" stiffness=\"{stiffness}\" springref=\"{reference}\" damping=\"{damping}\" armature=\"{armature}\"{limit}/>",
            hinge_name(&self.name, index)
        );
    }
}

/// The damper of a hinge of this stiffness, N m s per rad.
fn damping_of(stiffness: f64) -> f64 {
    2.0 * TIME_CONSTANT * stiffness
}

/// The name of the hinge at the beginning of link `index`.
fn hinge_name(star: &str, index: usize) -> String {
    let kind = if index % 2 == 1 { "tip" } else { "corner" };
    format!("{star}-{kind}-{}", index / 2 + 1)
}

/// The pins of a ring, counterclockwise from corner 1 in the direction `turn`, m.
fn pins(linkage: &Linkage, turn: f64) -> Vec<Point> {
    let step = PI / f64::from(linkage.points);
    let distances = [linkage.corner_pin, linkage.tip_pin];
    (0..2 * linkage.points)
        .zip(distances.into_iter().cycle())
        .map(|(index, distance)| Point::polar(distance, turn + step * f64::from(index)))
        .collect()
}

/// The ends of the tube beside the link to the pin `next`, from the pin at its beginning, which is a tip's or a corner's.
fn tube(linkage: &Linkage, next: Vec2, is_from_tip: bool) -> [Vec2; 2] {
    let LinkTube { lean, length, corner_offset, .. } = linkage.tube;
    // Of arms on both sides of a corner one is the mirror image of the other.
    let (corner, outward, side) =
        if is_from_tip { (next, -next, -1.0) } else { (Vec2::new(0.0, 0.0), next, 1.0) };
    let direction = Vec2::unit(outward.angle() - side * lean);
    let start = corner + direction.perp() * (side * corner_offset);
    [start, start + direction * length]
}

/// Two coordinates.
fn coordinates(vector: Vec2) -> String {
    format!("{} {}", number_of(vector.x), number_of(vector.y))
}

/// A number with nine decimals at most: a nanometre.
fn number_of(value: f64) -> String {
    format!("{}", (1e9 * value).round() / 1e9 + 0.0)
}
