//! From an object to the spec of a gripper that holds it, checked as by `check`.

use geom::order::sort_by_key;

use crate::answer::new_gripper::{NearRequest, NewGripper};
use crate::answer::quantity::{SIZE, number, stated};
use crate::pipeline::Forecast;
use design::{RefusalCode, Refusals};
use forecast::candidate::Candidate;
use forecast::sizing::{
    Choice, ENDLESS, FRICTION, Infeasible, NearestRequirements, Requirements, StatedUnits, Workspace, choose,
    spec_text,
};
use inflatable::mechanics::hinge::ring::RingTable;
use spec::units::{Force, Length, Mass, Most, Pressure, Stated, factor, hundredths_down};
use spec::{Allowed, FeedFloor, Machine, ObjectShape, Source, Spec};

/// Masses of objects, kg.
pub const MASSES: Allowed = Allowed::half_open(0.0, 1e4);
/// Pressures of pumps, kPa.
pub const PRESSURES: Allowed = Allowed::closed(1e-3, 1e6);
/// Friction between corners and object.
pub const FRICTIONS: Allowed = Allowed::half_open(0.0, 10.0);
/// Radial forces of one star on the object, N.
pub const FORCES: Allowed = Allowed::half_open(0.0, 1e6);

/// Inner radius of curvature of tips and corners: at 2 mm the load on the seal is about two fifths of the load at sharp ones.
const ROUND: Length = Length(2.0);

/// Paper sizes of ISO 216 from A0, mm, landscape.
const PAPERS: [[f64; 2]; 6] =
    [[1189.0, 841.0], [841.0, 594.0], [594.0, 420.0], [420.0, 297.0], [297.0, 210.0], [210.0, 148.0]];

/// Widths of usual objects, mm: outside of this range the unit may be wrong.
const USUAL_SIZES: Allowed = Allowed::closed(5.0, 1000.0);

/// Reads "400x300", in mm, or "A3".
///
/// # Errors
/// If `text` has neither form; the text states the allowed ones.
pub fn sheet(text: &str) -> Result<[Length; 2], String> {
    let paper =
        text.trim().strip_prefix(['A', 'a']).and_then(|number| PAPERS.get(number.parse::<usize>().ok()?));
    if let Some(paper) = paper {
        return Ok(paper.map(Length));
    }
    let sides =
        text.split_once(['x', 'X', '\u{d7}']).and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| format!("`{text}` is not WIDTHxHEIGHT in mm, like 400x300, and not A0 to A5"))
}

/// The length of a side of a sheet: "400" or "400 mm".
fn side(text: &str) -> Option<Length> {
    let text = text.trim().trim_end_matches("mm").trim();
    text.parse().ok().filter(|mm| SIZE.contains(*mm)).map(Length)
}

/// The object to grip and the conditions.
#[derive(Clone, Debug)]
pub struct Request {
    /// Width of the object across the grip.
    pub object: Stated<Length>,
    /// Height of the object along the gripper's axis; `None`: equal to the width.
    pub height: Option<Stated<Length>>,
    /// Shape of the object; `None` for a ball.
    pub shape: Option<ObjectShape>,
    /// Mass of the object.
    pub mass: Stated<Mass>,
    /// The pressure of the pump; `None`: the best one is chosen.
    pub pressure: Option<Stated<Pressure>>,
    /// Friction between corners and object; `None`: the value for bare fabric on a smooth surface.
    pub friction: Option<f64>,
    /// Largest radial force of one star that the object withstands.
    pub fragile: Option<Stated<Force>>,
}

/// The reason why there is no gripper for a request.
#[derive(Clone, Debug)]
pub enum NoGripper {
    /// A sentence about the name, the base spec, or this program.
    Fault(String),
    /// No gripper meets the request: the reasons, and the requests near it that can be met.
    Infeasible(Vec<String>, Vec<NearRequest>),
}

/// A value of a request that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongValue {
    /// Name of the value.
    pub name: &'static str,
    /// The reason, as a sentence.
    pub reason: String,
}

/// The value of `text`, if there is one, by `read`; the reason why it cannot be read goes to `wrong`.
pub fn read_value<T>(
    name: &'static str,
    text: Option<&str>,
    read: impl Fn(&str) -> Result<T, String>,
    wrong: &mut Vec<WrongValue>,
) -> Option<T> {
    read(text?).map_err(|reason| wrong.push(WrongValue { name, reason })).ok()
}

/// The shape of an object by its word.
fn shape(word: &str) -> Result<ObjectShape, String> {
    let shape = ObjectShape::ALL.iter().find(|(own, _)| *own == word).map(|(_, shape)| *shape);
    shape.ok_or_else(|| format!("`{word}` is not a shape: ball or cylinder"))
}

impl Request {
    /// Reads a request from the texts of its values by their names, those of its fields.
    ///
    /// # Errors
    /// All values that cannot be read, or are missing.
    pub fn read<'t>(value: impl Fn(&str) -> Option<&'t str>) -> Result<Self, Vec<WrongValue>> {
        let mut wrong = Vec::new();
        let object = read_value("object", value("object"), stated(SIZE), &mut wrong);
        let height = read_value("height", value("height"), stated(SIZE), &mut wrong);
        let shape = read_value("shape", value("shape"), shape, &mut wrong);
        let mass = read_value("mass", value("mass"), stated(MASSES), &mut wrong);
        let pressure = read_value("pressure", value("pressure"), stated(PRESSURES), &mut wrong);
        let friction = read_value("friction", value("friction"), number(FRICTIONS), &mut wrong);
        let fragile = read_value("fragile", value("fragile"), stated(FORCES), &mut wrong);
        for (name, is_absent) in [("object", object.is_none()), ("mass", mass.is_none())] {
            if is_absent && wrong.iter().all(|value| value.name != name) {
                wrong.push(WrongValue { name, reason: "is needed: a number and its unit".to_owned() });
            }
        }
        match object.zip(mass) {
            Some((object, mass)) if wrong.is_empty() => {
                Ok(Self { object, height, shape, mass, pressure, friction, fragile })
            }
            _ => Err(wrong),
        }
    }

    /// The requirements of the search, on the sheet of `base` and within the work area of `machine`.
    pub fn requirements(&self, base: &Spec, machine: &Machine) -> Requirements {
        // The inlet reaches beyond the tip on one side.
        let inlet = base.inlet.as_ref().map_or(0.0, |inlet| inlet.length.0);
        let units = StatedUnits {
            object: Some(self.object.unit),
            height: self.height.map(|height| height.unit),
            mass: Some(self.mass.unit),
            pressure: self.pressure.map(|pressure| pressure.unit),
            force: self.fragile.map(|force| force.unit),
        };
        Requirements {
            object: Length(0.5 * self.object.quantity.0),
            height: self.height.map(|height| height.quantity),
            shape: self.shape,
            mass: self.mass.quantity,
            // As it is written: never more than the pump has.
            pressure: self.pressure.map(|Stated { quantity, unit }| {
                let size = factor::<Pressure>(Some(unit));
                Pressure(Most(quantity.0 / size).printed() * size)
            }),
            friction: self.friction.unwrap_or(FRICTION),
            friction_assumed: self.friction.is_none(),
            largest_force: self.fragile.map(|force| force.quantity),
            room: Workspace {
                sheet: [base.sheet.width, base.sheet.height].map(or_endless),
                machine: machine.bench.work_area.map_or(ENDLESS, |(x, y)| [x, y]),
                edges: [inlet, 0.0].map(|edge| Length(2.0 * base.sheet.margin.0 + edge)),
            },
            units,
        }
    }

    /// A gripper called `name`; the values that the search does not change come from `base`.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn gripper(&self, name: &str, base: &Spec, machine: &Machine) -> Result<NewGripper, NoGripper> {
        let _ = spec::quoted(name).map_err(NoGripper::Fault)?;
        let requirements = self.requirements(base, machine);
        let ring = RingTable::new().map_err(|fault| NoGripper::Fault(fault.to_string()))?;
        let candidate =
            Candidate::from_spec(base).ok_or_else(|| NoGripper::Fault("the spec has no star".to_owned()))?;
        let gripper_of = |choices: &[Choice], base: &Spec| {
            let mut first_refusals = None;
            for choice in choices {
                match buildable(name, choice, base, machine) {
                    Ok((text, forecast)) => {
                        return Ok(NewGripper {
                            text,
                            forecast,
                            friction_assumed: choice.requirements.friction_assumed,
                            pressure_unit: choice.requirements.units.pressure,
                        });
                    }
                    Err(refusals) => first_refusals = first_refusals.or(Some(refusals)),
                }
            }
            Err(first_refusals.unwrap_or_default())
        };
        let choices =
            choose(&requirements, &candidate, &ring).map_err(|Infeasible { reasons, nearest }| {
                // The nearest requirements are tested like the requested ones, so that they can really be met.
                let mut near_requests: Vec<NearRequest> = nearest
                    .into_iter()
                    .filter_map(|nearest| {
                        let mut base = base.clone();
                        let sheet = nearest.requirements.room.sheet;
                        [base.sheet.width, base.sheet.height] =
                            sheet.map(|side| Some(side).filter(|side| side.0.is_finite()));
                        let NearestRequirements { requirements: eased, choices } = &nearest;
                        let gripper = gripper_of(choices, &base).ok()?;
                        Some(NearRequest {
                            requirements: *eased,
                            changes: nearest.changes(&requirements),
                            is_near: nearest.is_near(&requirements),
                            gripper,
                        })
                    })
                    .collect();
                // Those that certainly hold the object come first.
                sort_by_key(&mut near_requests, |request| !request.gripper.surely_holds());
                let width = self.object.quantity;
                let unit = (!USUAL_SIZES.contains(width.0))
                    .then(|| format!("an object {} across: is the unit right (mm, cm, m, in)?", self.object));
                NoGripper::Infeasible(unit.into_iter().chain(reasons).collect(), near_requests)
            })?;
        gripper_of(&choices, base).map_err(|refusals| {
            let reasons: Vec<String> =
                refusals.iter().map(|refusal| format!("{}: {}", refusal.found, refusal.remedy)).collect();
            let text = format!("the gripper that would hold this cannot be made: {}", reasons.join("; "));
            NoGripper::Fault(text)
        })
    }
}

/// The base of a search: the spec `text` with a machine profile, a sheet and radii of curvature.
///
/// # Errors
/// If `text` is refused.
pub fn base(text: String, profile: Option<&str>, sheet: Option<[Length; 2]>) -> Result<Spec, spec::Faults> {
    let mut base = spec::read(&Source::new("starter", text))?.spec;
    if let Some(profile) = profile {
        profile.clone_into(&mut base.machine.profile);
    }
    if let Some([width, height]) = sheet {
        [base.sheet.width, base.sheet.height] = [Some(width), Some(height)];
    }
    for star in &mut base.stars {
        (star.tip_radius, star.corner_radius) = (ROUND, ROUND);
    }
    Ok(base)
}

/// A side that may be unlimited.
fn or_endless(side: Option<Length>) -> Length {
    side.unwrap_or(Length(f64::INFINITY))
}

/// The spec of `choice`, if it passes all steps of `check`; low feeds of the controller are chopped if necessary.
fn buildable(
    name: &str,
    choice: &Choice,
    base: &Spec,
    machine: &Machine,
) -> Result<(String, Forecast), Refusals> {
    let attempt = |base: &Spec| {
        let text = spec_text(name, choice, base).map_err(|_| Refusals::new())?;
        let spec = spec::read(&Source::new("chosen", text.clone())).map_err(|_| Refusals::new())?.spec;
        let forecast = Forecast::new(spec, machine.clone())?;
        forecast.unfit().or_value(())?;
        Ok((text, forecast))
    };
    let mut base = base.clone();
    // A default for another profile may not suit this one.
    base.machine.feed_floor = FeedFloor::Refuse;
    let (text, forecast) = attempt(&base).or_else(|why: Refusals| {
        base.machine.feed_floor = FeedFloor::Chop;
        attempt(&base).map_err(|_| why)
    })?;
    // Windows that are shorter than the default are accepted in the spec: `check` need not warn of them.
    let is_short = forecast.design.warnings.iter().any(|warning| warning.code == RefusalCode::ShortWindow);
    let stars = forecast.design.assembly().into_iter().flat_map(|assembly| &assembly.distinct);
    let reaches = stars.map(|part| part.mask.extent);
    let Some(shortest) = reaches.reduce(f64::min).filter(|_| is_short) else { return Ok((text, forecast)) };
    base.mask.extent = Some(Length(hundredths_down(shortest)));
    attempt(&base)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_is_two_lengths() {
        assert_eq!(sheet("400x300"), Ok([Length(400.0), Length(300.0)]));
        assert_eq!(sheet("400 mm x 300 mm"), Ok([Length(400.0), Length(300.0)]));
        assert_eq!(sheet("A3"), Ok([Length(420.0), Length(297.0)]));
        assert_eq!(sheet("a0"), Ok([Length(1189.0), Length(841.0)]));
        for bad in ["400", "400x", "x", "0x5", "nanx5", "400x300x2", "A", "A6", "A-1"] {
            assert!(sheet(bad).is_err(), "{bad}");
        }
    }
}
