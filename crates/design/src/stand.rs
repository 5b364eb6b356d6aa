//! The **stand**: the place of a gripper above the table on which its object stands, where the stars meet the object as predicted.

use crate::{Object, Stack, inflated_height};
use spec::units::{Least, Readable, tenths_up};
use spec::{ObjectShape, Spec};

/// The place of a gripper relative to its object. Heights in mm, along the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Height of the bottom of the lowest plate above the table. Below 0 the object must be lifted.
    pub base: f64,
    /// Height of the object's bottom above the bottom of the lowest plate: -`base`, unless the object is lifted.
    pub object: f64,
    /// The height of the base if the gripper is turned over.
    turned: f64,
    /// Height of the object.
    height: f64,
    /// Height of the thickest inflated tube.
    tube: f64,
}

impl Stand {
    /// The stand of the stack of `spec`; `None` without an object or a stack.
    ///
    /// Each star meets a ball at its own height, so the middle of the ball is that of the stack. A cylinder may also stand on the table if the
    /// highest star reaches no higher.
    pub fn new(spec: &Spec) -> Option<Self> {
        let object = Object::new(spec.load.as_ref()?)?;
        let stack = Stack::new(spec).ok()?;
        let (low, high) = (*stack.stars.first()?, *stack.stars.last()?);
        let (middle, height) = (f64::midpoint(low, high), object.height().0);
        let tubes = spec.stars.iter().map(|star| inflated_height(star.tube_width).0);
        let base_height = base(&object, middle, high);
        Some(Self {
            base: base_height,
            object: -base_height,
            turned: base(&object, stack.height - middle, stack.height - low),
            height,
            tube: tubes.fold(0.0, f64::max),
        })
    }

    /// The reasons why the object may not be held where it stands, with their remedies.
    pub fn doubts(&self) -> Vec<String> {
        let mut doubts = Vec::new();
        if self.base < 0.0 {
            let lift = Least(tenths_up(-self.base));
            let alternative = if self.turned >= 0.0 { ", or turn the gripper over" } else { "" };
            doubts.push(format!(
                "the stars lie too high for an object of {} mm on a table: lift it by {lift} mm{alternative}",
                Readable(self.height)
            ));
        }
        if self.height < self.tube {
            doubts.push(format!(
                "the object is {} mm high and the inflated tube {} mm: only the seam may touch it, and with what force is unknown",
                Readable(self.height),
                Readable(tenths_up(self.tube))
            ));
        }
        doubts
    }
}

/// The height of the base of the stack above that of `object`, if the stack's middle is at `middle` and its highest star at `high`.
fn base(object: &Object, middle: f64, high: f64) -> f64 {
    let height = object.height().0;
    let base = 0.5 * height - middle;
    if object.shape() == ObjectShape::Cylinder && high <= height { base.max(0.0) } else { base }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::{Source, read, starter};

    fn stand(stack: &str, load: &str) -> Stand {
        let text = starter("x").expect("a name").replace("[stack]", &format!("[stack]\n{stack}"));
        let text = format!("{text}\n[load]\n{load}\n");
        let spec = read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
        Stand::new(&spec).expect("an object")
    }

    /// The middle of a star of the starter is 22.5 mm above the base: half a pitch of 40 mm and half a plate of 5 mm.
    #[test]
    fn the_base_is_where_the_stars_meet_the_middle_of_the_object() {
        assert_eq!([ball_of(80.0).base, ball_of(45.0).base, ball_of(30.0).base], [17.5, 0.0, -7.5]);
        assert_eq!((ball_of(80.0).doubts(), ball_of(45.0).doubts()), (vec![], vec![]));
        assert!(ball_of(30.0).doubts()[0].contains("lift it by 7.5 mm"), "{:?}", ball_of(30.0).doubts());
    }

    fn ball_of(diameter: f64) -> Stand {
        stand("", &format!("object_diameter = \"{diameter} mm\""))
    }

    #[test]
    fn a_cylinder_stands_on_the_table_if_it_reaches_the_highest_star() {
        let base = |height: f64| {
            let load = format!(
                "object_diameter = \"80 mm\"\nobject_shape = \"cylinder\"\nobject_height = \"{height} mm\""
            );
            stand("count = 2", &load).base
        };
        // Stars are 22.5 and 62.5 mm above the base.
        assert_eq!([base(100.0), base(70.0), base(62.5), base(62.0)], [7.5, 0.0, 0.0, -11.5]);
    }

    #[test]
    fn an_object_lower_than_the_tube_is_doubted_and_a_gripper_is_turned_over_only_if_that_helps() {
        let coin =
            stand("", "object_diameter = \"80 mm\"\nobject_shape = \"cylinder\"\nobject_height = \"2 mm\"");
        assert_eq!(coin.doubts().len(), 2);
        assert!(!coin.doubts()[0].contains("turn the gripper over"));
        // The pitch of the highest star is the room above it.
        let load = "object_diameter = \"90 mm\"\nobject_height = \"100 mm\"";
        let uneven = stand("count = 3\n[[stack.star]]\nindex = 2\npitch = \"60 mm\"", load);
        let turned = stand("count = 3\n[[stack.star]]\nindex = 3\npitch = \"60 mm\"", load);
        assert!(uneven.base < 0.0 && turned.base < 0.0);
        assert_eq!(uneven.turned, turned.base);
    }
}
