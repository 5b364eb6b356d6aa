//! Every model against the finest shells: the paper's stars of three to eight points and one V-actuator, at the working
//! pressures of grippers.
//!
//! The shells are data ([`computed`](super::computed)); computed here are the models that
//! include arms by a table only.

use crate::actuator::{Actuator, actuate};
use crate::case::Case;
use crate::meshed::MeshedValue;
use crate::model_selection::{corrected, hinge_model, tabled};
use crate::trade::computed::{FINENESSES, Finest, OPENING, POISSON, Shell, THICKNESS, YOUNG, finest, shells};
use design::Star;
use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::hinge::{HingeModel, Level};
use inflatable::mechanics::star::response::Inflated;
use inflatable::mechanics::strength::ElasticSheet;
use spec::StarSpec;
use spec::units::Pressure;

/// Pressures of the comparison, kPa.
pub const PRESSURES: [f64; 3] = [14.0, 37.0, 60.0];
/// Points of its stars.
pub const STARS: [u32; 6] = [3, 4, 5, 6, 7, 8];
/// The models that are compared; the last one is the table of `section`.
const MODELS: [(&str, Option<Level>); 5] = [
    ("fit", Some(Level::Fit)),
    ("ring", Some(Level::Ring)),
    ("bvp", Some(Level::Bvp)),
    ("section, solver", Some(Level::Section)),
    ("section, table", None),
];

/// One star by one model: relative errors against the finest shell; for that shell, its relative mesh errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarErrors {
    /// n.
    pub points: u32,
    /// Error of the final radius.
    pub radius: f64,
    /// Error of the radial stiffness; `None` where a shell's meshes do not agree on it.
    pub stiffness: Option<f64>,
    /// Error of the force on one object, 0.45 W wider than the finest shell's final radius.
    pub force: Option<f64>,
}

/// One model at one pressure.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellRow {
    /// The model.
    pub model: String,
    /// Gauge pressure, kPa.
    pub pressure: f64,
    /// Whether the model is computed and timed by the call; shells are stored.
    pub is_measured: bool,
    /// Time for a star, s: at rest, its hinges included; of shells the mean user time, the force included; 0 if none was timed.
    pub time: f64,
    /// Error of the V-actuator's angle at rest, deg, and relative error of its stiffness, against the finest shell; `None` for the table,
    /// which is for stars only.
    pub actuator: Option<[f64; 2]>,
    /// Errors of each star.
    pub stars: Vec<StarErrors>,
}

/// Agreement of one number of a fineness with the finest: its distance is compared with the mesh errors of both.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// The fineness.
    pub fineness: &'static str,
    /// The number.
    pub quantity: &'static str,
    /// Number of values within them.
    pub held: usize,
    /// Number of values compared.
    pub of: usize,
    /// Number of values left out, because their mesh error is larger than themselves.
    pub unknown: usize,
    /// Largest distance, by the mesh errors.
    pub furthest: f64,
}

/// Compares every model and the coarser shells with the finest; `clock` returns the time in s.
///
/// # Errors
/// If a model refuses one of the hinges.
pub fn against_shells(clock: &dyn Fn() -> f64) -> Result<Vec<ShellRow>, StarFault> {
    let (finest, computed) = (finest(), shells());
    let mut rows = Vec::new();
    for (name, level) in MODELS {
        for pressure in PRESSURES {
            let mut row = ShellRow {
                model: name.to_owned(),
                pressure,
                is_measured: true,
                time: f64::INFINITY,
                actuator: None,
                stars: Vec::new(),
            };
            if let Some((level, finest_shell)) = level.zip(matching_shell(&computed, "fine", None, pressure))
            {
                let answer = actuate(&actuator(pressure)?, level, &[])?;
                row.actuator = Some([
                    answer.angle_deg - finest_shell.rest.value,
                    answer.stiffness_Nm / finest_shell.stiffness.value - 1.0,
                ]);
            }
            for finest_shell in at_pressure(&finest, pressure) {
                row.add(finest_shell, level, clock)?;
            }
            rows.push(row);
        }
    }
    for fineness in FINENESSES {
        rows.extend(PRESSURES.map(|pressure| by_shell(fineness, pressure, &finest, &computed)));
    }
    Ok(rows)
}

fn at_pressure(finest: &[Finest], pressure: f64) -> impl Iterator<Item = &Finest> {
    finest.iter().filter(move |shell| shell.pressure.total_cmp(&pressure).is_eq())
}

/// The shell of this fineness and pressure with so many points; without points the V-actuator.
fn matching_shell<'a>(
    computed: &'a [Shell],
    fineness: &str,
    points: Option<u32>,
    pressure: f64,
) -> Option<&'a Shell> {
    computed.iter().find(|one| {
        one.fineness == fineness && one.points == points && one.pressure.total_cmp(&pressure).is_eq()
    })
}

/// The V-actuator of W 20 mm, R 2 mm, arms of 80 mm, 60 deg, t 0.3 mm.
fn actuator(kilopascals: f64) -> Result<Actuator, StarFault> {
    let sheet = ElasticSheet::new(THICKNESS, 1e6 * YOUNG, POISSON)?;
    let angle = 60_f64.to_radians();
    Ok(Actuator { width: 0.02, radius: 0.002, arm: 0.08, angle, pressure: 1e3 * kilopascals, sheet })
}

/// The row of the shells of one fineness at `pressure`.
///
/// The errors are distances from the finest shells. The row of the finest meshes has their relative mesh errors instead, with which the
/// others are compared. The time is the mean over the stars that were computed.
fn by_shell(fineness: &str, pressure: f64, finest: &[Finest], computed: &[Shell]) -> ShellRow {
    let pair = matching_shell(computed, fineness, None, pressure)
        .zip(matching_shell(computed, "fine", None, pressure));
    let mut row = ShellRow {
        model: format!("shell, {fineness}"),
        pressure,
        is_measured: false,
        time: 0.0,
        actuator: pair.map(|(shell, fine)| {
            if fineness == "fine" {
                return [fine.rest.mesh_error, fine.stiffness.mesh_error / fine.stiffness.value];
            }
            [shell.rest.value - fine.rest.value, shell.stiffness.value / fine.stiffness.value - 1.0]
        }),
        stars: Vec::new(),
    };
    let mut times = Vec::new();
    for reference in at_pressure(finest, pressure) {
        let points = reference.points;
        if fineness == "fine" {
            let [radius, stiffness, force] = [reference.radius, reference.stiffness, reference.force]
                .map(|value: MeshedValue| value.mesh_error / value.value);
            row.stars.push(StarErrors { points, radius, stiffness: Some(stiffness), force: Some(force) });
            continue;
        }
        let Some(shell) = matching_shell(computed, fineness, Some(points), pressure) else { continue };
        times.push(shell.time);
        row.stars.push(StarErrors {
            points,
            radius: shell.rest.value / reference.radius.value - 1.0,
            stiffness: relative_error(shell.stiffness, reference.stiffness),
            force: shell.force.and_then(|force| relative_error(force, reference.force)),
        });
    }
    if times.is_empty() {
        let shells = computed.iter().filter(|one| one.fineness == fineness && one.points.is_some());
        times.extend(shells.map(|one| one.time));
    }
    row.time = mean(&times);
    row
}

/// Distance of `value` from `reference`, by that; `None` if it is not finite.
fn relative_error(value: MeshedValue, reference: MeshedValue) -> Option<f64> {
    Some(value.value / reference.value - 1.0).filter(|error| error.is_finite())
}

/// Checks the mesh errors of coarser shells against the finest.
pub fn mesh_errors() -> Vec<Agreement> {
    let (finest, computed) = (finest(), shells());
    let mut rows = Vec::new();
    for fineness in FINENESSES {
        for quantity in ["rho_f", "K", "F"] {
            // Radius and stiffness of `fine` are those of the finest: the same meshes.
            if fineness == "fine" && quantity != "F" {
                continue;
            }
            let mut row = Agreement { fineness, quantity, held: 0, of: 0, unknown: 0, furthest: 0.0 };
            for star in &finest {
                let Some(shell) = matching_shell(&computed, fineness, Some(star.points), star.pressure)
                else {
                    continue;
                };
                let (value, reference) = match quantity {
                    "rho_f" => (Some(shell.rest), star.radius),
                    "K" => (Some(shell.stiffness), star.stiffness),
                    _ => (shell.force, star.force),
                };
                let Some(value) = value.filter(|value| value.value.is_finite()) else {
                    row.unknown += 1;
                    continue;
                };
                let deviation =
                    (value.value - reference.value).abs() / (value.mesh_error + reference.mesh_error);
                row.of += 1;
                row.held += usize::from(deviation <= 1.0);
                row.furthest = row.furthest.max(deviation);
            }
            rows.push(row);
        }
    }
    rows
}

/// Cost of each fineness over the stars: how many, mean user time (s), largest memory (MB), unknowns of the finest mesh.
pub fn costs() -> Vec<(&'static str, usize, f64, f64, u32)> {
    let computed = shells();
    FINENESSES
        .into_iter()
        .map(|fineness| {
            let shells: Vec<&Shell> =
                computed.iter().filter(|one| one.fineness == fineness && one.points.is_some()).collect();
            let times: Vec<f64> = shells.iter().map(|one| one.time).collect();
            let memory = shells.iter().fold(0.0, |most: f64, one| most.max(one.memory));
            (
                fineness,
                shells.len(),
                mean(&times),
                memory,
                shells.iter().map(|one| one.unknowns).max().unwrap_or(0),
            )
        })
        .collect()
}

#[expect(clippy::cast_precision_loss, reason = "a dozen")]
pub(super) fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// Root of the mean square.
pub fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = errors.map(|error| error * error).collect();
    mean(&squares).sqrt()
}

impl ShellRow {
    fn add(
        &mut self,
        finest_shell: &Finest,
        level: Option<Level>,
        clock: &dyn Fn() -> f64,
    ) -> Result<(), StarFault> {
        let Ok(star) = Star::new(&StarSpec::paper(finest_shell.points)) else { return Ok(()) };
        let pressure = Pressure(finest_shell.pressure).pascals();
        let case = Case::bare(&star, ElasticSheet::new(THICKNESS, 1e6 * YOUNG, POISSON)?, pressure);
        let start = clock();
        let model: Box<dyn HingeModel> = match level {
            Some(level) => hinge_model(level, &case.sheet, Some(pressure), case.mechanism.width)?,
            None => Box::new(tabled(&case, pressure)?),
        };
        let case = corrected(&case, &*model)?;
        let inflated = Inflated::new(&case.mechanism, &*model, pressure)?;
        let rest = inflated.linear_rest();
        self.time = self.time.min(clock() - start);
        let object = 1e-3 * finest_shell.radius.value + OPENING * case.mechanism.width;
        let force = if object < rest.radius { Some(0.0) } else { inflated.linear_force(object, &rest).ok() };
        self.stars.push(StarErrors {
            points: finest_shell.points,
            radius: 1e3 * rest.radius / finest_shell.radius.value - 1.0,
            stiffness: Some(rest.stiffness / finest_shell.stiffness.value - 1.0),
            force: force.map(|force| force / finest_shell.force.value - 1.0),
        });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shell::{Detail, least_errors};

    #[test]
    fn at_work_the_section_is_nearer_to_shells_than_any_limit() {
        let rows = against_shells(&|| 0.0).expect("all models answer");
        assert_eq!(rows.len(), (MODELS.len() + 3) * PRESSURES.len());
        for pressure in PRESSURES {
            let row_of = |model: &str| {
                let row =
                    rows.iter().find(|row| row.model == model && row.pressure.total_cmp(&pressure).is_eq());
                row.expect("compared").clone()
            };
            let (ring, section, fast) = (row_of("ring"), row_of("section, solver"), row_of("section, table"));
            assert_eq!(
                (ring.stars.len(), section.stars.len(), row_of("shell, coarse").stars.len()),
                (6, 6, 6)
            );
            let radii = |row: &ShellRow| rms(row.stars.iter().map(|star| star.radius));
            let forces = |row: &ShellRow| rms(row.stars.iter().filter_map(|star| star.force));
            assert!(radii(&section) < 0.75 * radii(&ring), "{pressure}");
            assert!(forces(&section) < 0.75 * forces(&ring), "{pressure}");
            assert!((radii(&section) - radii(&fast)).abs() < 0.02, "{pressure}");
            let angle = |row: &ShellRow| row.actuator.expect("asked")[0];
            assert!(angle(&section).abs() < 1.0 && angle(&ring) < -3.0, "{pressure}");
        }
        assert!(mesh_errors().iter().all(|row| row.held <= row.of) && costs()[0].1 == 18);
    }

    #[test]
    fn the_least_errors_are_those_of_the_rows() {
        let rows = against_shells(&|| 0.0).expect("all models answer");
        for (word, detail) in Detail::ALL {
            let rows = rows.iter().filter(|row| row.model == format!("shell, {word}") && word != "fine");
            let [mut radius, mut force] = [0.0_f64; 2];
            for row in rows {
                radius = radius.max(rms(row.stars.iter().map(|star| star.radius)));
                force = force.max(rms(row.stars.iter().filter_map(|star| star.force)));
            }
            let stated = least_errors(detail);
            for (stated, largest) in [(stated.radius, radius), (stated.force, force)] {
                assert!((largest..=1.2 * largest + 1e-9).contains(&stated), "{word}: {stated} of {largest}");
            }
        }
    }
}
