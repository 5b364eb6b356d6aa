//! A chosen gripper as a spec, each value with the reason why it is what it is.

use crate::design::inflated_height;
use crate::forecast::case::sheet;
use crate::forecast::choosing::{Choice, MARGIN};
use crate::forecast::optimize::{SEARCHED, sure_payload};
use crate::forecast::ranges::{Interval, mm, shown};
use crate::mechanics::strength::GRAVITY;
use crate::spec::{FeedFloor, NameFault, Spec, quoted};
use crate::units::{Length, Readable};
use std::fmt::Write;

/// The spec of `choice`, called `name`, on the machine and with the sheet of `base`.
///
/// # Errors
/// If `name` cannot be a spec's name.
pub fn spec_text(name: &str, choice: &Choice, base: &Spec) -> Result<String, NameFault> {
    let mut out = Lines { text: String::new() };
    out.head(choice);
    let _ = write!(out.text, "schema = 1\nname = {}\n\n", quoted(name)?);
    out.fabric(base);
    out.star(choice);
    out.stack(choice);
    out.sheet(base);
    out.load(choice);
    Ok(out.text)
}

/// The text so far. A String takes everything.
struct Lines {
    text: String,
}

impl Lines {
    fn comment(&mut self, text: &str) {
        let _ = writeln!(self.text, "# {text}");
    }

    fn value(&mut self, key: &str, value: &str, why: &str) {
        let line = format!("{key} = {value}");
        let _ = writeln!(self.text, "{line:34}# {why}");
    }

    fn quantity(&mut self, key: &str, value: impl std::fmt::Display, why: &str) {
        self.value(key, &format!("\"{value}\""), why);
    }

    fn head(&mut self, choice: &Choice) {
        let wish = &choice.wish;
        self.comment(&format!(
            "Holds an object {} across and of {}, with friction {}: `stargrip-cam predict` says how it does that.",
            Length(2.0 * wish.object.0),
            wish.mass,
            Readable(wish.friction)
        ));
        self.comment(&format!(
            "Counted on is {MARGIN} times the mass at least: {SEARCHED} of the range's lower end."
        ));
        self.comment("The values below were searched; the comments say why each is what it is.");
        self.text.push('\n');
    }

    fn fabric(&mut self, base: &Spec) {
        let fabric = &base.fabric;
        self.text += "[fabric]\n";
        self.quantity("thickness", fabric.thickness, "your fabric's: the tube's width goes with it");
        let megapascals = format!("{} MPa", Readable(1e-3 * fabric.young_modulus.0));
        self.quantity("young_modulus", megapascals, "of one sheet");
        self.value("poisson_ratio", &format!("{}", fabric.poisson_ratio), "of one sheet");
        if let Some(strength) = fabric.seal_strength {
            self.quantity(
                "seal_strength",
                strength,
                "from your peel test; the pressure keeps away from bursting",
            );
        } else {
            self.comment("seal_strength = \"3 N/mm\"  your own T-peel result: without it nobody knows at which pressure the seal bursts");
        }
        if let Some(density) = fabric.areal_density {
            self.quantity("areal_density", density, "of one sheet");
        }
        if let Some(stiffness) = fabric.bending_stiffness {
            self.quantity("bending_stiffness", stiffness, "measured");
        }
        if let Some(stiffness) = fabric.stretch_stiffness {
            self.quantity("stretch_stiffness", stiffness, "measured");
        }
        self.text.push('\n');
    }

    fn star(&mut self, choice: &Choice) {
        let (star, own) = (&choice.best.point.star, choice.best.answer.outcome.as_ref());
        let radius = own.map(|own| Length::from_metres(own.rest.radius).0);
        let closes = shown::known(radius, own.and_then(|own| own.ranges.radius).map(mm), "mm");
        let opens = own.map_or(0.0, |own| 1e3 * own.graspable[1]);
        let others: Vec<String> =
            choice.others.iter().map(|(points, area)| format!("{points}: {:.0} cm2", area / 100.0)).collect();
        self.text += "[star]\n";
        self.value(
            "points",
            &format!("{}", star.points),
            &format!("the least fabric ({})", others.join(", ")),
        );
        self.quantity(
            "inner_radius",
            star.inner_radius,
            &format!(
                "the object's {} and room to go in; inflated it opens to {opens:.1} mm",
                choice.wish.object
            ),
        );
        let fabric = &choice.best.point.fabric;
        let thickness = sheet(fabric).map_or(fabric.thickness, |sheet| Length::from_metres(sheet.thickness));
        let slender = thickness.0 / star.tube_width.0;
        self.quantity(
            "tube_width",
            star.tube_width,
            &format!("t/W is {slender:.3}: 0.010 to 0.030 was tried"),
        );
        self.quantity("tip_angle", star.tip_angle, &format!("closes to {closes} without the object"));
        self.quantity("tip_radius", star.tip_radius, "round tips load the seal less");
        self.quantity("corner_radius", star.corner_radius, "and so do round corners");
        self.text.push('\n');
    }

    fn stack(&mut self, choice: &Choice) {
        let (point, answer) = (&choice.best.point, &choice.best.answer);
        let own = answer.grip.as_ref();
        let force = own.and_then(crate::forecast::outcome::Outcome::object_force);
        let one = match own.and_then(|own| own.force_range) {
            Some(range) => shown::known(force, Some(range), "N"),
            None => force.map_or("unknown".to_owned(), |force| format!("{force:.1} N by the model")),
        };
        let needed = choice.wish.mass.0 * GRAVITY / choice.wish.friction;
        self.text += "[stack]\n";
        let stars = if point.stars == 1 { "one star presses" } else { "each star presses" };
        self.value(
            "count",
            &format!("{}", point.stars),
            &format!("{stars} with {one}; friction needs {needed:.1} N in all"),
        );
        let tube = inflated_height(point.star.tube_width).0;
        self.quantity(
            "pitch",
            point.star.pitch,
            &format!("the inflated tube is {tube:.1} mm high, a plate {}", point.plate),
        );
        self.text.push('\n');
    }

    fn sheet(&mut self, base: &Spec) {
        let sheet = &base.sheet;
        if let Some((width, height)) = sheet.width.zip(sheet.height) {
            self.text += "[sheet]\n";
            self.quantity("width", width, "as you said");
            self.quantity("height", height, "as you said");
            self.text.push('\n');
        }
        self.text += "[machine]\n";
        let profile = base.machine.profile.replace('\\', "\\\\").replace('"', "\\\"");
        self.quantity("profile", profile, "`stargrip-cam machines` lists the others");
        if base.machine.feed_floor == FeedFloor::Chop {
            self.quantity(
                "feed_floor",
                "chop",
                "this controller cannot hold the seal's speed: short moves and dwells instead",
            );
        }
        self.text.push('\n');
    }

    fn load(&mut self, choice: &Choice) {
        let (wish, point, answer) = (&choice.wish, &choice.best.point, &choice.best.answer);
        self.text += "[load]\n";
        let own = answer.outcome.as_ref();
        let stretch = own.and_then(|own| own.stretch).unwrap_or(0.0);
        let said = if wish.pressure.is_some() { "as you said" } else { "with the least fabric" };
        let burst = answer
            .burst
            .zip(point.load.pressure)
            .map_or(String::new(), |(burst, pressure)| format!(", burst margin {:.2}", burst.0 / pressure.0));
        if let Some(pressure) = point.load.pressure {
            self.quantity(
                "pressure",
                pressure,
                &format!("{said}; the fabric stretches by {:.1} %{burst}", 100.0 * stretch),
            );
        }
        self.quantity("object_diameter", Length(2.0 * wish.object.0), "as you said");
        if let Some(height) = wish.height {
            self.quantity("object_height", height, "as you said");
        }
        if let Some(shape) = wish.shape {
            self.quantity("object_shape", shape.word(), "as you said");
        }
        self.value(
            "friction",
            &format!("{}", wish.friction),
            "between the corners and the object; coat the corners for more",
        );
        let sure = sure_payload(point, answer).map_or(String::new(), |payload| format!("{payload:.2} kg"));
        self.quantity("mass", wish.mass, &format!("counted on: {sure}{}", all_of(answer.payload_range)));
        if let Some(force) = wish.largest_force {
            self.quantity("largest_force", force, "what the object bears of one star, all corners together");
        }
    }
}

/// What may be held at most.
fn all_of(range: Option<Interval>) -> String {
    range.map_or(String::new(), |[_, high]| format!(", at most {high:.2} kg"))
}
