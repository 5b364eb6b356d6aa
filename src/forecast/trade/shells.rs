//! Every model against shells: the paper's stars of three to eight points and one V-actuator, at the pressures that grippers work at.
//!
//! The shells are data ([`stars`](crate::forecast::stars)); what is computed here are the models that know no arms but by a table.

use crate::forecast::actuator::{Actuator, actuate};
use crate::forecast::case::Case;
use crate::forecast::choice::{corrected, hinge_model, tabled};
use crate::forecast::ranges::against::case_of;
use crate::forecast::stars::computed::{Computed, Found};
use crate::forecast::stars::draw::{POISSON, Set, YOUNG};
use crate::forecast::stars::shipped::shipped;
use crate::mechanics::fault::StarFault;
use crate::mechanics::hinge::{HingeModel, Level};
use crate::mechanics::star::response::Inflated;
use crate::mechanics::strength::ElasticSheet;
use std::fmt::Write;

/// The V-actuator with W 20 mm, R 2 mm, arms of 80 mm, 60 deg, t 0.3 mm as a shell of four meshes up to 98,840 unknowns: pressure
/// (kPa), angle at rest (deg, mesh errors up to 0.14) and stiffness (N m, up to 0.0008). By
/// `stargrip-cam actuator --tube-width "20 mm" --radius "2 mm" --arm-length "80 mm" --angle "60 deg" --pressure "14 kPa" --model shell --fineness fine`
/// and so on.
const ACTUATORS: [[f64; 3]; 3] = [[14.0, 36.347, 0.0781], [37.0, 31.516, 0.1055], [60.0, 30.470, 0.1309]];

/// The models that are compared: by their levels, and the section from its table.
const MODELS: [(&str, Option<Level>); 5] = [
    ("fit", Some(Level::Fit)),
    ("ring", Some(Level::Ring)),
    ("bvp", Some(Level::Bvp)),
    ("section", Some(Level::Section)),
    ("section, table", None),
];
/// The part of a stiffness that meshes may leave open, to be compared.
const SETTLED: f64 = 0.25;

/// One model at one pressure.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellRow {
    /// The model.
    pub model: &'static str,
    /// Gauge pressure, kPa.
    pub pressure: f64,
    /// Time for a star at rest, its hinges included, s.
    pub time: f64,
    /// The V-actuator's angle at rest less the shell's, deg; `None` for the table, which is asked for stars.
    pub angle: Option<f64>,
    /// Its stiffness over the shell's, less 1.
    pub bending: Option<f64>,
    /// Final radii over the shell's, less 1.
    pub radius: Vec<f64>,
    /// The same of radial stiffnesses.
    pub stiffness: Vec<f64>,
    /// The same of forces, each at the same opening.
    pub force: Vec<f64>,
}

/// Compares every model with the shells; `clock` tells the time in s.
///
/// # Errors
/// If a model refuses one of the hinges.
pub fn against_shells(clock: &dyn Fn() -> f64) -> Result<Vec<ShellRow>, StarFault> {
    let stars: Vec<Computed> = shipped().into_iter().filter(|star| star.star.set == Set::Paper).collect();
    let mut rows = Vec::new();
    for (model, level) in MODELS {
        for [pressure, angle, bending] in ACTUATORS {
            #[expect(clippy::float_cmp, reason = "both are the constants of the set")]
            let at = stars.iter().filter(|star| star.star.pressure == pressure);
            let mut row = ShellRow {
                model,
                pressure,
                time: f64::INFINITY,
                angle: None,
                bending: None,
                radius: Vec::new(),
                stiffness: Vec::new(),
                force: Vec::new(),
            };
            if let Some(level) = level {
                let own = actuate(&actuator(pressure)?, level, &[])?;
                row.angle = Some(own.angle_deg - angle);
                row.bending = Some(own.stiffness_Nm / bending - 1.0);
            }
            for star in at {
                if let Some(found) = &star.found {
                    row.add(star, found, level, clock)?;
                }
            }
            rows.push(row);
        }
    }
    Ok(rows)
}

/// The V-actuator of [`ACTUATORS`].
fn actuator(kilopascals: f64) -> Result<Actuator, StarFault> {
    let sheet = ElasticSheet::new(0.3e-3, 1e6 * YOUNG, POISSON)?;
    let angle = 60_f64.to_radians();
    Ok(Actuator { width: 0.02, radius: 0.002, arm: 0.08, angle, pressure: 1e3 * kilopascals, sheet })
}

impl ShellRow {
    fn add(
        &mut self,
        star: &Computed,
        found: &Found,
        level: Option<Level>,
        clock: &dyn Fn() -> f64,
    ) -> Result<(), StarFault> {
        let Some((case, pressure)) = case_of(&star.star) else { return Ok(()) };
        let start = clock();
        let model = model(level, &case, pressure)?;
        let case = corrected(&case, &*model)?;
        let inflated = Inflated::new(&case.mechanism, &*model, pressure)?;
        let rest = inflated.linear_rest();
        self.time = self.time.min(clock() - start);
        self.radius.push(1e3 * rest.radius / found.radius.value - 1.0);
        // Where arms touch, a shell's stiffness is that of their contact.
        if found.arm_contact.value > 0.0 || found.stiffness.error > SETTLED * found.stiffness.value {
            return Ok(());
        }
        self.stiffness.push(1e-3 * rest.stiffness / found.stiffness.value - 1.0);
        for (part, secant) in &found.secants {
            let opening = part * case.mechanism.width;
            let shell = 1e3 * found.stiffness.value * secant.value * opening;
            if let Ok(force) = inflated.linear_force(rest.radius + opening, &rest) {
                self.force.push(force / shell - 1.0);
            }
        }
        Ok(())
    }
}

fn model(level: Option<Level>, case: &Case, pressure: f64) -> Result<Box<dyn HingeModel>, StarFault> {
    Ok(match level {
        Some(level) => hinge_model(level, &case.sheet, Some(pressure), case.mechanism.width)?,
        None => Box::new(tabled(case, pressure)?),
    })
}

/// Root of the mean square, and largest magnitude.
fn off(errors: &[f64]) -> Option<[f64; 2]> {
    let most = errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()));
    #[expect(clippy::cast_precision_loss, reason = "a dozen")]
    let count = errors.len() as f64;
    (!errors.is_empty())
        .then(|| [(errors.iter().map(|error| error * error).sum::<f64>() / count).sqrt(), most])
}

/// The rows as a table for a terminal.
pub fn shell_table(rows: &[ShellRow]) -> String {
    let mut out = format!(
        "{:15}{:>9}{:>12}{:>11}{:>8}{:>17}{:>17}{:>17}\n",
        "model", "pressure", "time", "actuator", "C", "rho_f rms, most", "K rms, most", "F rms, most"
    );
    for row in rows {
        let _ = write!(out, "{:15}{:>5} kPa{:>9.1} us", row.model, row.pressure, row.time * 1e6);
        let angle = row.angle.map_or("-".to_owned(), |angle| format!("{angle:+.1} deg"));
        let bending = row.bending.map_or("-".to_owned(), |part| format!("{:+.0} %", 100.0 * part));
        let _ = write!(out, "{angle:>11}{bending:>8}");
        for errors in [&row.radius, &row.stiffness, &row.force] {
            let said = off(errors)
                .map_or("-".to_owned(), |[rms, most]| format!("{:.0}, {:.0} %", 100.0 * rms, 100.0 * most));
            let _ = write!(out, "{said:>17}");
        }
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_work_the_section_is_nearer_to_shells_than_any_limit() {
        let rows = against_shells(&|| 0.0).expect("all models answer");
        assert_eq!(rows.len(), MODELS.len() * ACTUATORS.len());
        let table = shell_table(&rows);
        assert_eq!(table.lines().count(), rows.len() + 1, "{table}");
        for [pressure, ..] in ACTUATORS {
            let at = |model: &str| {
                let found =
                    rows.iter().find(|row| row.model == model && row.pressure.total_cmp(&pressure).is_eq());
                found.expect("compared").clone()
            };
            let (ring, section, fast) = (at("ring"), at("section"), at("section, table"));
            assert_eq!((ring.radius.len(), section.radius.len()), (6, 6));
            let rms = |errors: &[f64]| off(errors).expect("some")[0];
            assert!(rms(&section.radius) < 0.75 * rms(&ring.radius), "{pressure}: {table}");
            assert!(rms(&section.force) < 0.75 * rms(&ring.force), "{pressure}: {table}");
            assert!((rms(&section.radius) - rms(&fast.radius)).abs() < 0.02, "{pressure}: {table}");
            assert!(
                section.angle.map(f64::abs) < Some(1.0) && ring.angle < Some(-3.0),
                "{pressure}: {table}"
            );
        }
    }
}
