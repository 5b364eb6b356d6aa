//! The contact of a stack's stars with the object, and the part of the object that must pass their holes. Lengths in mm.
//!
//! The object is on the gripper's axis with its middle at the middle of the stack: half way between the lowest and the highest
//! star. A **ball** of diameter d and height h is the ellipsoid of revolution, r(z) = d/2 sqrt(1 - (2 z / h)^2).

use crate::{Refusal, RefusalCode, Star, Warning};
use spec::units::{Least, Length, Most, Readable};
use spec::{Load, ObjectShape, Seal, Spec, key};

/// Room that is left around an object before it is gripped: this part of its radius, and at least [`LEAST_ROOM`].
const ROOM: f64 = 0.05;
/// See [`ROOM`], mm.
const LEAST_ROOM: f64 = 2.0;
/// A gap below this part of [`room`] is a warning: hand and gripper must be aligned that exactly.
const TIGHT: f64 = 0.5;

/// The room around an object of `radius`, mm, with which it enters without exact alignment.
pub fn room(radius: Length) -> Length {
    Length((ROOM * radius.0).max(LEAST_ROOM))
}

/// A round object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    radius: f64,
    height: f64,
    shape: ObjectShape,
}

/// The contact of one star with the object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Radius of the object at the star's height; 0 where the star passes above or below it.
    pub radius: f64,
    /// Radius of the part that must pass the star's hole until the object is in its place.
    pub entering: f64,
    /// Angle of the object's surface against the axis at the star's height, rad: above 0 where it leans inwards, above the widest part.
    pub slope: f64,
}

impl Meeting {
    /// Whether a star presses equally hard in both: all but the slope is equal.
    pub fn is_like(&self, other: &Self) -> bool {
        (self.radius, self.entering) == (other.radius, other.entering)
    }
}

impl Object {
    /// The object of `load`: a ball unless another shape is given, as tall as wide unless a height is given. `None` without a size.
    pub fn new(load: &Load) -> Option<Self> {
        let radius = load.object_radius?.0;
        let height = load.object_height.map_or(2.0 * radius, |height| height.0);
        Some(Self { radius, height, shape: load.object_shape.unwrap_or(ObjectShape::Ball) })
    }

    /// The largest radius of the object of `load` if it is to have the radius `local_goal` where it has `local_radius` now, all in mm: one without a
    /// height of its own grows in height, too.
    pub fn widest_for(load: &Load, local_radius: f64, local_goal: f64) -> f64 {
        let radius = load.object_radius.map_or(local_radius, |radius| radius.0);
        match load.object_height {
            // r(z)^2 = R^2 - z^2, with the same z.
            None => (radius * radius - local_radius * local_radius + local_goal * local_goal).max(0.0).sqrt(),
            Some(_) if local_radius > 0.0 => radius * local_goal / local_radius,
            Some(_) => local_goal,
        }
    }

    /// Height of the object along the axis.
    pub fn height(&self) -> Length {
        Length(self.height)
    }

    /// Shape of the object.
    pub fn shape(&self) -> ObjectShape {
        self.shape
    }

    /// Radius of the object `z` above its middle; 0 above and below the object.
    pub fn radius_at(&self, z: f64) -> f64 {
        let part = 2.0 * z / self.height;
        match self.shape {
            _ if part.abs() > 1.0 => 0.0,
            ObjectShape::Cylinder => self.radius,
            ObjectShape::Ball => self.radius * (1.0 - part * part).max(0.0).sqrt(),
        }
    }

    /// Angle of its surface against the axis `z` above its middle, rad; above 0 where it leans inwards.
    fn slope_at(&self, z: f64) -> f64 {
        let part = 2.0 * z / self.height;
        match self.shape {
            _ if part.abs() > 1.0 => 0.0,
            ObjectShape::Cylinder => 0.0,
            // -dr/dz = 2 R/h part / sqrt(1 - part^2)
            ObjectShape::Ball => {
                libm::atan2(2.0 * self.radius * part, self.height * (1.0 - part * part).sqrt())
            }
        }
    }

    /// The contacts of stars at `heights`, rising, with holes of radii `holes`. The object enters from the end where more holes
    /// let it pass; from below if both ends are equal.
    pub fn meetings(&self, heights: &[f64], holes: &[f64]) -> Vec<Meeting> {
        let middle = match (heights.first(), heights.last()) {
            (Some(low), Some(high)) => 0.5 * (low + high),
            _ => 0.0,
        };
        let (below, above) = (self.spread(heights, middle, 1.0), self.spread(heights, middle, -1.0));
        if passed_count(&above, holes) > passed_count(&below, holes) { above } else { below }
    }

    /// The contacts of stars at `heights`, where the object's middle is at `middle`, and it enters from below if `side` is 1, from above if
    /// it is -1.
    fn spread(&self, heights: &[f64], middle: f64, side: f64) -> Vec<Meeting> {
        let meeting = |height: &f64| {
            let z = height - middle;
            let radius = self.radius_at(z);
            // A star that it has to go through with its widest part, or only with its end.
            let entering = if side * z <= 0.0 { self.radius } else { radius };
            Meeting { radius, entering, slope: self.slope_at(z) }
        };
        heights.iter().map(meeting).collect()
    }

    /// The contacts of `count` equal stars `pitch` apart with a hole of radius `hole`, bottom first.
    pub fn equal_meetings(&self, count: u32, pitch: f64, hole: f64) -> Vec<Meeting> {
        let heights: Vec<f64> = (0..count).map(|i| f64::from(i) * pitch).collect();
        self.meetings(&heights, &vec![hole; heights.len()])
    }

    /// The assumption about its shape between `stars` stars; `None` if there is none, or one star alone grips its middle.
    pub fn assumed(load: &Load, stars: usize) -> Option<String> {
        let object = Self::new(load).filter(|_| stars > 1)?;
        let shape = object.shape.word();
        match (load.object_height, load.object_shape) {
            (Some(_), Some(_)) => None,
            (Some(_), None) => Some(format!("assumed to be a {shape}: set object_shape")),
            (None, Some(_)) => Some(format!("assumed to be {} tall: set object_height", object.height())),
            (None, None) => Some(format!(
                "assumed to be a {shape} {} tall: set object_height and object_shape",
                object.height()
            )),
        }
    }
}

impl Star {
    /// Radius of the hole's cut edge, mm: band and flap lie between it and the tube. 0 if they close the hole.
    pub fn hole(&self, seal: &Seal) -> f64 {
        (self.rho_0 - seal.band.0 - seal.hole_allowance.0).max(0.0)
    }
}

/// An object of radius `entering` that does not pass the hole of radius `hole` of a star of inner radius `inner`, which surely holds
/// objects up to the radius `widest`; `None` if it holds none. All in mm.
pub fn does_not_enter(spec: &Spec, (inner, hole): (f64, f64), entering: f64, widest: Option<f64>) -> Refusal {
    let key = spec.load.as_ref().map_or(key::load::OBJECT_DIAMETER, Load::size_key);
    let flap = inner - hole;
    let ([diameter, rho, margin], hole_diameter) =
        ([2.0 * entering, inner, flap].map(Readable), Most(2.0 * hole));
    let fault = format!(
        "the object is {diameter} mm across, the cut hole {hole_diameter} mm (inner radius {rho} mm less {margin} mm of \
         band and flap): it does not enter"
    );
    let needed_radius = entering + room(Length(entering)).0 + flap;
    let narrower = widest.map_or_else(String::new, |radius| {
        format!("an object of at most {} mm across, or ", Most(2.0 * radius))
    });
    // An inner radius that lets it in is not enough where the inflated star opens less than its hole.
    let larger = if widest.is_some_and(|radius| radius > hole - 1e-6) {
        format!("an inner_radius of at least {} mm", Least(needed_radius))
    } else {
        "a larger inner_radius, with which the star also opens wider than the object".to_owned()
    };
    let remedy = format!("{narrower}{larger}");
    Refusal::new(key, RefusalCode::ObjectTooWide, fault, remedy)
}

/// The warning that an object which passes the hole of `star`, number `index`, has little room.
pub(super) fn tight(spec: &Spec, index: usize, star: &Star, meeting: Meeting) -> Option<Warning> {
    let (hole, entering) = (star.hole(&spec.seal), meeting.entering);
    let (gap, usual_gap) = (hole - entering, room(Length(entering)).0);
    (gap >= 0.0 && gap < TIGHT * usual_gap).then(|| {
        let (room, hole_diameter) = (Most(gap), Most(2.0 * hole));
        let (usual_gap, inner) = (Readable(usual_gap), Least(star.rho_0 + usual_gap - gap));
        Warning::new(
            key::star::INNER_RADIUS.of_star(index),
            RefusalCode::TightHole,
            format!("{room} mm of room between the object and the cut hole of {hole_diameter} mm across"),
            format!(
                "inner_radius of {inner} mm leaves {usual_gap} mm and needs no exact alignment; check that the star still \
                 holds the object"
            ),
        )
    })
}

/// The number of holes that let the object pass.
fn passed_count(meetings: &[Meeting], holes: &[f64]) -> usize {
    meetings.iter().zip(holes).filter(|(meeting, hole)| meeting.entering <= **hole).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn object(radius: f64, height: Option<f64>, shape: Option<ObjectShape>) -> Object {
        let load = Load {
            object_radius: Some(Length(radius)),
            object_height: height.map(Length),
            object_shape: shape,
            ..Load::default()
        };
        Object::new(&load).expect("a size")
    }

    fn radii(object: Object, heights: &[f64]) -> Vec<f64> {
        object.meetings(heights, &vec![1e3; heights.len()]).iter().map(|one| one.radius).collect()
    }

    /// The stars of a stack meet the object that is proposed where they should.
    #[test]
    fn the_proposed_object_has_the_wanted_radius_at_the_star() {
        let shapes = [None, Some(ObjectShape::Ball), Some(ObjectShape::Cylinder)];
        for (height, shape) in [None, Some(150.0)].into_iter().flat_map(|h| shapes.map(|shape| (h, shape))) {
            let load = |radius: f64| Load {
                object_radius: Some(Length(radius)),
                object_height: height.map(Length),
                object_shape: shape,
                ..Load::default()
            };
            let local_radius = |load: &Load| Object::new(load).expect("a size").radius_at(20.0);
            let current = load(60.0);
            for wanted in [30.0, 55.0, 70.0] {
                let radius =
                    local_radius(&load(Object::widest_for(&current, local_radius(&current), wanted)));
                assert!((radius - wanted).abs() < 1e-9, "{height:?} {shape:?} {wanted}: {radius}");
            }
        }
    }

    /// A ball of 180 mm has a radius of 80.6 mm at 40 mm off its middle.
    #[test]
    fn a_ball_is_met_at_each_star_s_height() {
        let ball_radii = radii(object(90.0, None, None), &[25.0, 65.0, 105.0]);
        let square = 8100.0_f64 - 1600.0;
        assert!(
            (ball_radii[0] - square.sqrt()).abs() < 1e-12 && (ball_radii[0] - 80.62).abs() < 0.01,
            "{ball_radii:?}"
        );
        assert_eq!([ball_radii[1], ball_radii[2]], [90.0, ball_radii[0]]);
        assert_eq!(radii(object(15.0, None, None), &[0.0, 40.0]), [0.0, 0.0]);
        assert_eq!(radii(object(15.0, Some(100.0), Some(ObjectShape::Cylinder)), &[0.0, 40.0]), [15.0, 15.0]);
        assert_eq!(
            radii(object(15.0, None, Some(ObjectShape::Cylinder)), &[0.0, 40.0, 80.0]),
            [0.0, 15.0, 0.0]
        );
    }

    /// The slope is that of a fine chord, and opposite below the middle.
    #[test]
    fn a_ball_leans_as_its_profile_does() {
        let ball = object(35.0, Some(120.0), None);
        for z in [-50.0, -20.0, 0.0, 10.0, 40.0, 55.0] {
            let chord = (ball.radius_at(z - 1e-5) - ball.radius_at(z + 1e-5)) / 2e-5;
            assert!((libm::tan(ball.slope_at(z)) - chord).abs() < 1e-6 * (1.0 + chord.abs()), "{z}");
            assert_eq!(ball.slope_at(z), -ball.slope_at(-z));
        }
        assert_eq!(object(35.0, Some(120.0), Some(ObjectShape::Cylinder)).slope_at(30.0), 0.0);
    }

    #[test]
    fn one_star_alone_grips_the_middle_whatever_the_shape() {
        for shape in [None, Some(ObjectShape::Ball), Some(ObjectShape::Cylinder)] {
            let meeting = object(30.0, Some(1.0), shape).equal_meetings(1, 40.0, 50.0);
            assert_eq!(meeting, [Meeting { radius: 30.0, entering: 30.0, slope: 0.0 }]);
        }
    }

    #[test]
    fn a_ball_enters_a_cone_of_stars_from_its_wide_end() {
        let ball = object(50.0, None, None);
        let entering = |holes: &[f64]| -> Vec<f64> {
            ball.meetings(&[0.0, 40.0], holes).iter().map(|one| one.entering).collect()
        };
        let end = 2100.0_f64.sqrt();
        assert_eq!(entering(&[55.0, 47.0]), [50.0, end]);
        assert_eq!(entering(&[47.0, 55.0]), [end, 50.0]);
    }

    #[test]
    fn what_is_assumed_is_named_where_it_matters() {
        let load = |height: Option<f64>, shape| Load {
            object_radius: Some(Length(90.0)),
            object_height: height.map(Length),
            object_shape: shape,
            ..Load::default()
        };
        assert_eq!(Object::assumed(&load(None, None), 1), None);
        let assumption = Object::assumed(&load(None, None), 2).expect("two stars");
        assert!(assumption.contains("ball 180 mm tall"), "{assumption}");
        assert!(Object::assumed(&load(Some(57.0), None), 2).is_some());
        assert_eq!(Object::assumed(&load(Some(57.0), Some(ObjectShape::Ball)), 2), None);
        assert_eq!(Object::assumed(&Load::default(), 2), None);
    }
}
