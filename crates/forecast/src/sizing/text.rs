//! A sized gripper as a spec, each value with its reason.

use crate::case::sheet;
use crate::interval::{mm, scaled};
use crate::optimize::{SEARCHED, sure_payload};
use crate::outcome::Outcome;
use crate::ranges::shown;
use crate::sizing::{Choice, FRICTION, FRICTION_RANGE, MARGIN};
use design::inflated_height;
use inflatable::mechanics::strength::GRAVITY;
use spec::units::{Length, Readable};
use spec::{FeedFloor, ObjectShape, Seal, SealPause, Spec, quoted};
use std::fmt::{Display, Write};

/// The spec of `choice`, called `name`, on the machine and with the sheet of `base`.
///
/// # Errors
/// If `name` cannot be a spec's name.
pub fn spec_text(name: &str, choice: &Choice, base: &Spec) -> Result<String, String> {
    let mut lines = Lines { text: String::new() };
    lines.head(choice);
    let _ = write!(lines.text, "schema = 1\nname = {}\n\n", quoted(name)?);
    lines.fabric(base);
    lines.seal(base);
    lines.star(choice);
    lines.stack(choice);
    lines.sheet_and_machine(base);
    lines.load(choice);
    Ok(lines.text)
}

/// The first words of the comments with results of all values together: they become outdated once a value changes.
const RESULTS: [&str; 13] = [
    "Holds an object ",
    "Designed for ",
    "The program searched ",
    "the least fabric (",
    "the object's ",
    "the object, ",
    "t/W is ",
    "the empty star closes to ",
    "one star presses with ",
    "each star presses with ",
    "the inflated tube is ",
    "the fabric stretches ",
    "safe payload ",
];

/// Whether `comment`, without its "# ", is a result that [`spec_text`] writes.
pub fn is_result(comment: &str) -> bool {
    RESULTS.iter().any(|begin| comment.starts_with(begin))
}

/// Every key of `[seal]` with its value as TOML; `None` where it is absent.
fn seal_values(seal: &Seal) -> [(&'static str, Option<String>); 14] {
    fn text(value: impl Display) -> String {
        format!("\"{value}\"")
    }
    // A new setting does not compile without its line.
    let Seal {
        temperature,
        power,
        speed,
        band,
        overlap,
        allowance,
        hole_allowance,
        height,
        passes,
        lines,
        tip,
        cool,
        pause,
    } = *seal;
    [
        ("temperature", power.is_none().then(|| text(temperature))),
        ("power", power.map(text)),
        ("speed", Some(text(speed))),
        ("band", Some(text(band))),
        ("overlap", Some(text(overlap))),
        ("allowance", Some(text(allowance))),
        ("hole_allowance", Some(text(hole_allowance))),
        ("height", height.filter(|_| power.is_none()).map(text)),
        ("focus", height.filter(|_| power.is_some()).map(text)),
        ("passes", Some(passes.to_string())),
        ("lines", lines.map(|lines| lines.to_string())),
        ("tip", tip.map(text)),
        ("cool", Some(text(cool))),
        ("pause", SealPause::ALL.iter().find(|(_, value)| *value == pause).map(|(word, _)| text(word))),
    ]
}

/// The text so far. Writing to a String never fails.
struct Lines {
    text: String,
}

impl Lines {
    fn comment(&mut self, text: &str) {
        let _ = writeln!(self.text, "# {text}");
    }

    fn value(&mut self, key: &str, value: impl Display, comment: &str) {
        let line = format!("{key} = {value}");
        let _ = writeln!(self.text, "{line:34}# {comment}");
    }

    fn quantity(&mut self, key: &str, value: impl Display, comment: &str) {
        self.value(key, format!("\"{value}\""), comment);
    }

    /// A quantity that may be left out.
    fn optional(&mut self, key: &str, value: Option<impl Display>, comment: &str) {
        if let Some(value) = value {
            self.quantity(key, value, comment);
        }
    }

    fn head(&mut self, choice: &Choice) {
        let requirements = &choice.requirements;
        self.comment(&format!(
            "Holds an object {} across and of {}, with friction {}: see `stargrip-cam check`.",
            requirements.width_in_words(),
            requirements.mass_in_words(),
            Readable(requirements.friction)
        ));
        self.comment(&format!(
            "Designed for {MARGIN} times the mass, using {:.0} % of the lowest predicted payload.",
            100.0 * SEARCHED
        ));
        self.comment("The program searched the values below; each comment gives the reason for its value.");
        self.text.push('\n');
    }

    fn fabric(&mut self, base: &Spec) {
        let fabric = &base.fabric;
        self.text += "[fabric]\n";
        self.quantity("thickness", fabric.thickness, "of one sheet; the tube width depends on it");
        let megapascals = format!("{} MPa", Readable(1e-3 * fabric.young_modulus.0));
        self.quantity("young_modulus", megapascals, "of one sheet");
        self.value("poisson_ratio", fabric.poisson_ratio, "of one sheet");
        if let Some(strength) = fabric.seal_strength {
            self.quantity("seal_strength", strength, "from your peel test; limits the pressure");
        } else {
            self.comment("seal_strength = \"3 N/mm\"  your own T-peel result: without it the burst pressure is unknown");
        }
        self.optional("areal_density", fabric.areal_density, "of one sheet");
        self.optional("bending_stiffness", fabric.bending_stiffness, "measured");
        self.optional("stretch_stiffness", fabric.stretch_stiffness, "measured");
        if let Some(modulus) = fabric.shear_modulus {
            self.quantity("shear_modulus", format!("{} MPa", Readable(1e-3 * modulus.0)), "for the shell");
            self.quantity("warp", fabric.warp, "of the warp on the sheet, from X");
        }
        self.text.push('\n');
    }

    /// The settings of the seal that come with the fabric; nothing where they are the defaults.
    fn seal(&mut self, base: &Spec) {
        let usual = seal_values(&Seal::default());
        let changed = seal_values(&base.seal).into_iter().zip(usual).filter(|(value, usual)| value != usual);
        let values: Vec<_> = changed.filter_map(|((key, value), _)| Some((key, value?))).collect();
        if values.is_empty() {
            return;
        }
        self.text += "[seal]\n";
        for (key, value) in values {
            self.value(key, value, "of your fabric");
        }
        self.text.push('\n');
    }

    fn star(&mut self, choice: &Choice) {
        let (star, outcome) = (&choice.best.point.star, choice.best.answer.outcome.as_ref());
        let closed_width = outcome.map(|outcome| 2.0 * Length::from_metres(outcome.rest.radius).0);
        let range = outcome.and_then(|outcome| outcome.ranges.radius).map(|range| scaled(mm(range), 2.0));
        let closes = shown::optional_with_range(closed_width, range, "mm across");
        let opens = outcome.map_or(0.0, |outcome| 2e3 * outcome.graspable[1]);
        let areas: Vec<String> =
            choice.others.iter().map(|(points, area)| format!("{points}: {:.0} cm2", area / 100.0)).collect();
        self.text += "[star]\n";
        self.value("points", star.points, &format!("the least fabric ({})", areas.join(", ")));
        let object = choice.requirements.width_in_words();
        let room = format!(
            "the object, {object} across, enters with room; the inflated star opens to {opens:.1} mm across"
        );
        self.quantity("inner_radius", star.inner_radius, &room);
        let fabric = &choice.best.point.fabric;
        let thickness = sheet(fabric).map_or(fabric.thickness, |sheet| Length::from_metres(sheet.thickness));
        let slender = thickness.0 / star.tube_width.0;
        let slender = format!("t/W is {slender:.3}; validated from 0.010 to 0.030");
        self.quantity("tube_width", star.tube_width, &slender);
        self.quantity("tip_angle", star.tip_angle, &format!("the empty star closes to {closes}"));
        self.quantity("tip_radius", star.tip_radius, "round tips load the seal less than sharp ones");
        self.quantity(
            "corner_radius",
            star.corner_radius,
            "round corners load the seal less than sharp ones",
        );
        self.text.push('\n');
    }

    fn stack(&mut self, choice: &Choice) {
        let (point, answer) = (&choice.best.point, &choice.best.answer);
        let outcome = answer.grip.as_ref();
        let force = outcome.and_then(Outcome::object_force);
        let force_text = match outcome.and_then(|outcome| outcome.force_range) {
            Some(range) => shown::optional_with_range(force, Some(range), "N"),
            None => force.map_or("unknown".to_owned(), |force| format!("{force:.1} N by the model")),
        };
        let needed_force = choice.requirements.mass.0 * GRAVITY / choice.requirements.friction;
        self.text += "[stack]\n";
        let stars = if point.stars == 1 { "one star presses" } else { "each star presses" };
        self.value(
            "count",
            point.stars,
            &format!("{stars} with {force_text}; {} in all are needed", in_newtons(needed_force)),
        );
        let tube = inflated_height(point.star.tube_width).0;
        let comment = format!("the inflated tube is {tube:.1} mm high, a plate {} thick", point.plate);
        self.quantity("pitch", point.star.pitch, &comment);
        self.text.push('\n');
    }

    fn sheet_and_machine(&mut self, base: &Spec) {
        let sheet = &base.sheet;
        if let Some((width, height)) = sheet.width.zip(sheet.height) {
            self.text += "[sheet]\n";
            self.quantity("width", width, "of your sheet");
            self.quantity("height", height, "of your sheet");
            self.text.push('\n');
        }
        if let Some(extent) = base.mask.extent {
            self.text += "[mask]\n";
            self.quantity("extent", extent, "as far as neighbouring coating windows leave room");
            self.text.push('\n');
        }
        self.text += "[machine]\n";
        let profile = base.machine.profile.replace('\\', "\\\\").replace('"', "\\\"");
        self.quantity("profile", profile, "`stargrip-cam machines` lists the others");
        if base.machine.feed_floor == FeedFloor::Chop {
            let comment = "this controller cannot move at the seal's speed: it makes short moves and dwells";
            self.quantity("feed_floor", "chop", comment);
        }
        self.text.push('\n');
    }

    fn load(&mut self, choice: &Choice) {
        // A line for each key of the object, as its user wrote it. The comment of the pressure tells its effect on the
        // fabric and the seal.
        let (requirements, point, answer) = (&choice.requirements, &choice.best.point, &choice.best.answer);
        self.text += "[load]\n";
        let outcome = answer.outcome.as_ref();
        let stretch = outcome.and(answer.case.stretch()).unwrap_or(0.0);
        let preference =
            if requirements.pressure.is_some() { "" } else { "; less fabric than at other pressures" };
        let burst = answer
            .burst
            .zip(point.load.pressure)
            .map_or(String::new(), |(burst, pressure)| format!(", burst margin {:.2}", burst.0 / pressure.0));
        let stretches = format!("the fabric stretches {:.1} %{burst}{preference}", 100.0 * stretch);
        let pressure = requirements.pressure_in_words().or_else(|| Some(point.load.pressure?.to_string()));
        self.optional("pressure", pressure, &stretches);
        self.quantity("object_diameter", requirements.width_in_words(), "of the object");
        self.optional("object_height", requirements.height_in_words(), "along the gripper's axis");
        self.optional("object_shape", requirements.shape.map(ObjectShape::word), "of the object");
        let is_assumed = requirements.friction_assumed;
        let friction = if is_assumed {
            "bare fabric on a smooth object: 0.20 to 0.42 measured; coated corners about 1.1"
        } else {
            "between the corners and the object"
        };
        self.value("friction", requirements.friction, friction);
        if is_assumed {
            let [lowest, highest] = FRICTION_RANGE;
            self.value("friction_least", lowest, "lowest expected friction");
            self.value("friction_most", highest, "highest expected friction");
        }
        // The range of an assumed friction, which widens that of `predict`, comes on top.
        let friction_text = if is_assumed { format!(" at friction {FRICTION}") } else { String::new() };
        let safe_payload =
            sure_payload(point, answer).map_or_else(|| "unknown".to_owned(), |kg| payload(&[kg]));
        let range = answer.payload_range.map(|range| format!("; predicted {}", payload(&range)));
        let mass_text = format!("safe payload {safe_payload}{friction_text}{}", range.unwrap_or_default());
        self.quantity("mass", requirements.mass_in_words(), &mass_text);
        let bears = "that the object bears from one star, all corners together";
        self.optional("largest_force", requirements.force_in_words(), bears);
    }
}

/// A force in N to a decimal, in mN below 0.1 N.
fn in_newtons(newtons: f64) -> String {
    if newtons < 0.1 { format!("{:.0} mN", 1e3 * newtons) } else { format!("{newtons:.1} N") }
}

/// Masses in kg to two decimals, joined by "to"; in g if the first would have less than two digits.
fn payload(masses: &[f64]) -> String {
    let is_small = masses.first().is_some_and(|first| *first < 0.1);
    let mass = |kg: &f64| if is_small { format!("{:.1}", 1e3 * kg) } else { format!("{kg:.2}") };
    let numbers: Vec<String> = masses.iter().map(mass).collect();
    format!("{} {}", numbers.join(" to "), if is_small { "g" } else { "kg" })
}
