//! One star as a shell: the question that its case puts, and the numbers of the answer in the units of predictions.

use crate::case::{Case, weave};
use crate::interval::Interval;
use crate::predict::PredictFault;
use crate::pressures::pressure_finding;
use crate::shell::{Detail, MOST_POINTS, SHELL, fineness, flat_star};
use crate::star_refusal::{poisson_values, thickness_values};
use inflatable::shell::cases::{
    Extremes, FlatStar, Hysteresis, InflatedStar, Input, MOST_OBJECTS, Objects, ShellFault, Value, Watch,
    star,
};
use inflatable::shell::element::Weave;
use spec::{Fabric, KeyPath, key};

/// Reason why a shell gives no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellRefusal {
    /// The computation was cancelled.
    Cancelled,
    /// The shell refuses the input.
    Fault(PredictFault),
}

impl From<PredictFault> for ShellRefusal {
    fn from(fault: PredictFault) -> Self {
        Self::Fault(fault)
    }
}

/// A fault that is best mended at `key`.
pub(crate) fn fault(key: KeyPath, problem: String) -> ShellRefusal {
    ShellRefusal::Fault(PredictFault::new(key, problem))
}

/// The fault of a shell without a pressure.
pub fn no_pressure() -> ShellRefusal {
    let remedy = Some("set `pressure` in [load]".to_owned());
    let problem = "model shell needs a pressure".to_owned();
    ShellRefusal::Fault(PredictFault { remedy, ..PredictFault::new(key::load::PRESSURE, problem) })
}

/// The fault of a pressure, Pa, at which there is no shell.
fn out_of_range(pressure: f64, range: Interval) -> PredictFault {
    let (problem, remedy) = pressure_finding(SHELL, pressure, range);
    PredictFault::new(key::load::PRESSURE, problem).with_remedy(remedy)
}

/// The shell's values of a star: each number with its mesh error.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measurements {
    /// From the axis to the apex of a corner's inner rim, mm.
    pub(crate) radius: Value,
    /// 1 - rho_f / rho_0.
    pub(crate) contraction: Value,
    /// Angle of the tips between the lines of their arms, contact or not, deg.
    pub(crate) tip_angle: Value,
    /// Radial stiffness at rest, all corners together, N/m.
    pub(crate) stiffness: Value,
    /// Force with which the two arms of a tip press on each other, N.
    pub(crate) contact: Value,
    /// Flat area of an arm's sheet that touches the next arm, mm^2.
    pub(crate) contact_area: Value,
    /// Volume of the star, mm^3.
    pub(crate) volume: Value,
    /// Radius of each requested object, m, and the radial force on it, N.
    pub(crate) forces: Vec<(f64, Value)>,
    /// For each of them how far the corners slide along the object, by the growth of its radius.
    pub(crate) slips: Vec<Value>,
    /// The largest requested object before and after the star was opened further.
    pub(crate) hysteresis: Option<Hysteresis>,
    /// Radius of the object of the load, m; `None` if there is none, it does not enter, or the star does not meet it.
    pub(crate) object: Option<f64>,
    /// The hardest loaded places, SI.
    pub(crate) extremes: Extremes,
}

/// The star of `case`, of fabric with the weave `weave`, as the shell's input.
///
/// # Errors
/// If no pressure is given, it has too many points, or its weave has other planes of symmetry than the star.
pub fn flat(case: &Case, weave: Weave) -> Result<FlatStar, ShellRefusal> {
    let pressure = case.pressure.ok_or_else(no_pressure)?;
    let points = case.mechanism.points;
    if points > MOST_POINTS {
        let problem = format!("{points} points, and shells of stars are computed with 3 to {MOST_POINTS}");
        return Err(fault(key::star::POINTS, problem));
    }
    let star = flat_star(case, weave, pressure);
    if star.is_symmetric() { Ok(star) } else { Err(askew(points).into()) }
}

/// The fault of a star of `points` points whose weave its planes of symmetry do not leave as it is.
fn askew(points: u32) -> PredictFault {
    let problem = format!(
        "the shell computes woven stars of 4 points with the warp at a multiple of 45 deg only, where half a sector stands \
         for the star; this one has {points} points"
    );
    let warp = if points == 4 { "set `warp` to \"0 deg\" or \"45 deg\"; or " } else { "" };
    let remedy = format!(
        "{warp}remove `shear_modulus` from [fabric] for isotropic fabric, or compute with the model \"section\", which leaves the \
         weave out; docs/weave.md tells how much a weave changes"
    );
    PredictFault::new(key::fabric::WARP, problem).with_remedy(remedy)
}

/// The weave of `fabric`, as the shell's input.
///
/// # Errors
/// If its values have none.
pub(crate) fn fabric_weave(fabric: &Fabric) -> Result<Weave, ShellRefusal> {
    weave(fabric).map_err(|why| fault(key::fabric::SHEAR_MODULUS, why.to_string()))
}

/// Inflates the star of `case`, made of `fabric`, then presses it against its object and round ones of `radii` (m).
///
/// # Errors
/// If the shell refuses, finds no equilibrium, or is cancelled.
pub(crate) fn ask(
    case: &Case,
    fabric: &Fabric,
    radii: &[f64],
    detail: Detail,
    watch: &Watch<'_>,
) -> Result<(FlatStar, InflatedStar, Measurements), ShellRefusal> {
    let flat_star = flat(case, fabric_weave(fabric)?)?;
    let object = entered(case);
    let mut objects: Vec<f64> = radii.iter().copied().chain(object).collect();
    objects.sort_by(f64::total_cmp);
    objects.dedup();
    if objects.len() > MOST_OBJECTS {
        let problem = format!("{} radii; one call takes at most {MOST_OBJECTS}: give fewer", objects.len());
        return Err(fault(key::load::OBJECT_DIAMETER, problem));
    }
    let of_shape = |why: &ShellFault| match why {
        ShellFault::Range { name: Input::Arms, .. } => key::load::PRESSURE,
        ShellFault::Range { .. } => key::star::TUBE_WIDTH,
        ShellFault::TooMany { .. } => key::load::OBJECT_DIAMETER,
        _ => key::star::TIP_ANGLE,
    };
    let shell_star = star(&flat_star, Objects::Radii(&objects), fineness(detail), watch)
        .map_err(|why| refused(&why, "", fabric, of_shape))?;
    let measured = Measurements::new(case, object, &shell_star);
    Ok((flat_star, shell_star, measured))
}

/// The radius of the object, m, where the star meets it; `None` for an object that does not enter.
pub(crate) fn entered(case: &Case) -> Option<f64> {
    case.object.filter(|object| *object > 0.0 && case.entering.unwrap_or(*object) <= case.hole)
}

/// Why the shell refuses `subject`, made of `fabric`, with the key that is best changed; `of_shape` gives it where that depends on the product.
pub(crate) fn refused(
    shell_fault: &ShellFault,
    subject: &str,
    fabric: &Fabric,
    of_shape: impl Fn(&ShellFault) -> KeyPath,
) -> ShellRefusal {
    // A ratio of the fabric has values that its key may have, and a pressure has a range: both are the remedy. Of the other faults only the
    // key is known.
    let message = format!("{subject}{shell_fault}");
    let key = match shell_fault {
        ShellFault::Cancelled => return ShellRefusal::Cancelled,
        ShellFault::Pressure { found, least, most } => {
            let fault = out_of_range(*found, [*least, *most]);
            return ShellRefusal::Fault(PredictFault { what: format!("{subject}{}", fault.what), ..fault });
        }
        ShellFault::Range { name: Input::Poisson, least, most, .. } => {
            let values = poisson_values([*least, *most]);
            return PredictFault::new(key::fabric::POISSON_RATIO, message).with_remedy(values).into();
        }
        ShellFault::Range { name: Input::Slenderness, found: ratio, least, most } => {
            let (key, values) = thickness_values(fabric, [least / ratio, most / ratio]);
            return PredictFault::new(key, message).with_remedy(values).into();
        }
        ShellFault::Range { name: Input::Stretching | Input::Bending, .. } => key::fabric::THICKNESS,
        ShellFault::Range { name: Input::Shear, .. } => key::fabric::SHEAR_MODULUS,
        ShellFault::Range { name: Input::Bendability | Input::Stretch, .. }
        | ShellFault::Stopped { .. }
        | ShellFault::Overlap { .. } => key::load::PRESSURE,
        ShellFault::Range { name: Input::Width | Input::Arms, .. }
        | ShellFault::Mesh(_)
        | ShellFault::TooLarge { .. }
        | ShellFault::TooMany { .. } => of_shape(shell_fault),
    };
    fault(key, message)
}

impl Measurements {
    fn new(case: &Case, object: Option<f64>, inflated: &InflatedStar) -> Self {
        // Coarse meshes close further, so that an object which only they reach would pull by extrapolation.
        let pressing =
            |(radius, force): &(f64, Value)| (*radius, Value { value: force.value.max(0.0), ..*force });
        Self {
            radius: inflated.final_radius.scaled(1e3),
            contraction: inflated.final_radius.shifted(-case.inner_radius).scaled(-1.0 / case.inner_radius),
            tip_angle: inflated.tip_angle.scaled(1.0_f64.to_degrees()),
            stiffness: inflated.radial_stiffness,
            contact: inflated.preload,
            contact_area: inflated.contact_area.scaled(1e6),
            volume: inflated.volume.scaled(1e9),
            forces: inflated.forces.iter().map(pressing).collect(),
            slips: inflated.slips.clone(),
            hysteresis: inflated.hysteresis,
            object,
            extremes: inflated.extremes,
        }
    }

    /// Whether the arms touch.
    pub(crate) fn touches(&self) -> bool {
        self.contact.value > 0.0
    }

    /// Angle of the tips where no arms touch, deg; else `None`, because contact is part of the equilibrium.
    pub(crate) fn equilibrium(&self) -> Option<f64> {
        (!self.touches()).then_some(self.tip_angle.value)
    }

    /// Radial stiffness, N/m; `None` where its mesh error is larger than itself.
    pub(crate) fn known_stiffness(&self) -> Option<f64> {
        Some(self.stiffness.value).filter(|number| *number > self.stiffness.error)
    }

    /// The radial force on the object of this radius, m, if it was requested.
    pub(crate) fn force_at(&self, radius: f64) -> Option<Value> {
        self.forces.iter().find(|(at, _)| *at == radius).map(|(_, force)| *force)
    }

    /// The radial force on the object of the load, N.
    pub(crate) fn object_force(&self) -> Option<Value> {
        self.force_at(self.object?)
    }

    /// The least and the largest radial force on the object of the load, N, where the corners rub on it with `friction`.
    pub(crate) fn object_force_with(&self, friction: f64) -> Option<[f64; 2]> {
        let object = self.object?;
        let ((_, force), slip) = self.forces.iter().zip(&self.slips).find(|((at, _), _)| *at == object)?;
        let part = friction * slip.value.max(0.0);
        Some([force.value * (1.0 - part).max(0.0), force.value * (1.0 + part)])
    }

    /// The fabric's largest tension at the rim, N/mm.
    pub(crate) fn seal_tension(&self) -> [f64; 2] {
        [1e-3 * self.extremes.seal_tension.value, 1e-3 * self.extremes.seal_tension.error]
    }
}
