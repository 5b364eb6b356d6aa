//! Bench tests of `calibrate`: measurements of a V-actuator, a disc and a strip, and the stiffnesses that follow from them.

use std::fmt::Write;
use std::path::PathBuf;

use serde_json::{Value, json};

use crate::answer::quantity::{number, quantity, quantity_or_number};
use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::text_file::{TABLE, read_text};
use crate::coupon::DISC;
use crate::coupon::bias::{BiasFault, BiasStrip, shear_stiffness};
use crate::coupon::cone::read_test;
use crate::design::realised_radius;
use crate::forecast::case::sheet;
use crate::forecast::stiffness::{BenchFault, DiscBench, VBench, least_angle};
use crate::spec::{Allowed, Source, Spec};
use crate::units::{Angle, BendingStiffness, Length, LineForce, Pressure};
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::mechanics::hinge::{Hinge, HingeModel};
use inflatable::mechanics::strength::ElasticSheet;

/// Range of a bench's pressure, kPa; the same as in a spec.
const PRESSURE: Allowed = Allowed::closed(1e-3, 1e6);
/// Assumed errors of a measured angle, deg, and of a measured width, m: they give the ranges beside the stiffnesses.
const OFF_ANGLE: f64 = 1.0;
const OFF_WIDTH: f64 = 0.2e-3;
/// Assumed relative error of the bias strip's stiffness.
const OFF_BIAS: f64 = 0.05;

/// Arguments about the bench.
#[derive(clap::Args, Debug)]
pub(super) struct BenchArgs {
    /// The V-actuator's angle between its arms, flat, such as "58 deg".
    #[arg(long, value_name = "ANGLE", requires = "inflated_angle", allow_hyphen_values = true, value_parser = quantity_or_number::<Angle>(Allowed::between(0.0, 180.0)))]
    flat_angle: Option<f64>,
    /// The V-actuator's angle, inflated and without load; not above the flat one.
    #[arg(long, value_name = "ANGLE", requires = "flat_angle", allow_hyphen_values = true, value_parser = quantity_or_number::<Angle>(Allowed::between(-180.0, 180.0)))]
    inflated_angle: Option<f64>,
    /// The V-actuator's pressure, such as "30 kPa": with it and --spec the fabric's bending_stiffness is found.
    #[arg(long, value_name = "PRESSURE", requires_all = ["inflated_angle", "spec"], allow_hyphen_values = true, value_parser = quantity::<Pressure>(PRESSURE))]
    angle_pressure: Option<Pressure>,
    /// The disc's width between its bands, inflated, such as "78.2 mm".
    #[arg(long, value_name = "LENGTH", requires_all = ["disc_pressure", "spec"], allow_hyphen_values = true, value_parser = quantity::<Length>(Allowed::between(0.0, DISC)))]
    disc_width: Option<Length>,
    /// The disc's pressure: with it, its width and --spec the fabric's stretch_stiffness is found.
    #[arg(long, value_name = "PRESSURE", requires = "disc_width", allow_hyphen_values = true, value_parser = quantity::<Pressure>(PRESSURE))]
    disc_pressure: Option<Pressure>,
    /// A pulled strip of one sheet, cut at 45 deg to the warp: CSV with travel_mm and load_N. With it and --spec the fabric's shear_modulus is
    /// found.
    #[arg(long, value_name = "FILE", requires_all = ["spec", "bias_length"])]
    bias_strip: Option<PathBuf>,
    /// Free length of the bias strip between the clamps, at least five times its width.
    #[arg(long, value_name = "LENGTH", requires = "bias_strip", allow_hyphen_values = true, value_parser = quantity::<Length>(Allowed::above(0.0, 1e4)))]
    bias_length: Option<Length>,
    /// Width of the bias strip.
    #[arg(long, value_name = "LENGTH", default_value = "25 mm", allow_hyphen_values = true, value_parser = quantity::<Length>(Allowed::above(0.0, 1e4)))]
    bias_width: Length,
    /// The V-actuator's R / W as the band makes it; default: that of the spec's tips, without --spec 1/30.
    #[arg(long, allow_hyphen_values = true, value_parser = number(Allowed::above(0.0, 1e3)))]
    radius_ratio: Option<f64>,
}

impl BenchArgs {
    /// The path of the table that is read for the bias strip.
    pub(super) fn table(&self) -> Option<&PathBuf> {
        self.bias_strip.as_ref()
    }

    /// The measured angle of the V-actuator and its prediction: at its pressure by `section` for the fabric of the spec, else by the exact
    /// ring; `None` without a measurement.
    pub(super) fn coiling(&self, spec: Option<&Loaded>) -> Result<Option<Coiling>, Failure> {
        let Some((flat, inflated)) = self.flat_angle.zip(self.inflated_angle) else { return Ok(None) };
        if inflated > flat {
            return Err(Failure::Message(format!(
                "--inflated-angle is {inflated} deg; must be: at most the flat one, {flat} deg, because a \
                 hinge closes; check whether the two are exchanged"
            )));
        }
        let least = least_angle(flat.to_radians()).to_degrees();
        if inflated < least {
            return Err(Failure::Message(format!(
                "--inflated-angle is {inflated} deg; must be: at least {least:.1} deg, because no hinge of {flat} deg, flat, \
                 closes further; check the sign, and that both are the angle between the arms"
            )));
        }
        let measured = (180.0 - inflated) / (180.0 - flat);
        if let (Some(loaded), Some(pressure)) = (spec, self.angle_pressure) {
            let known = known(loaded)?;
            let bench = self.vee(&loaded.reading.spec, pressure, 0.0);
            let predicted = bench.and_then(|bench| {
                let (bending, stretch) = (known.bending_modulus(), known.stretching_modulus());
                bench.predicted(bending, stretch, known.poisson_ratio).ok()
            });
            if let Some(angle) = predicted {
                let predicted = (180.0 - angle.to_degrees()) / (180.0 - flat);
                return Ok(Some(Coiling { measured, predicted, model: "section" }));
            }
        }
        let state = Ring
            .target(self.radius_ratio(spec.map(|loaded| &loaded.reading.spec)))
            .map_err(|fault| Failure::Message(format!("R / W of the V-actuator: {fault}")))?;
        Ok(Some(Coiling { measured, predicted: state.lambda, model: "ring" }))
    }

    /// R / W of the V-actuator's hinge.
    fn radius_ratio(&self, spec: Option<&Spec>) -> f64 {
        let of_tips = |spec: &Spec| {
            let star = spec.stars.first()?;
            Some(realised_radius(star.tip_radius.0, spec.seal.band.0) / star.tube_width.0)
        };
        self.radius_ratio.or_else(|| of_tips(spec?)).unwrap_or(1.0 / 30.0)
    }

    /// The V-actuator of the spec's tips, with a measured angle that is `off` deg too wide; `None` without angles.
    fn vee(&self, spec: &Spec, pressure: Pressure, off: f64) -> Option<VBench> {
        let ((flat, inflated), star) = (self.flat_angle.zip(self.inflated_angle)?, spec.stars.first()?);
        let (width, rest_angle) = (star.tube_width.metres(), flat.to_radians());
        let hinge = Hinge { r_star: self.radius_ratio(Some(spec)), width, rest_angle };
        Some(VBench { hinge, pressure: pressure.pascals(), inflated: (inflated + off).to_radians() })
    }

    /// The stiffnesses of the spec's fabric that follow from the bench tests.
    pub(super) fn stiffnesses(&self, loaded: &Loaded) -> Result<Stiffnesses, Failure> {
        let mut found = Stiffnesses::default();
        if self.angle_pressure.is_none() && self.disc_width.is_none() && self.bias_strip.is_none() {
            return Ok(found);
        }
        let known = known(loaded)?;
        let (poisson, mut stretch) = (known.poisson_ratio, known.stretching_modulus());
        if let Some((width, pressure)) = self.disc_width.zip(self.disc_pressure) {
            let at = |off: f64| {
                let (flat, inflated) = (Length(DISC).metres(), width.metres() + off);
                DiscBench { flat, inflated, pressure: pressure.pascals() }
                    .stretch_stiffness(known.bending_modulus(), poisson)
            };
            let named = |fault: BenchFault| Failure::Message(format!("--disc-width: {fault}"));
            stretch = at(0.0).map_err(named)?;
            let ends = [at(-OFF_WIDTH), at(OFF_WIDTH)].map(Result::ok);
            found.stretch = Some(MeasuredStiffness { value: stretch, ends, at: pressure });
        }
        if let Some(pressure) = self.angle_pressure {
            let spec = &loaded.reading.spec;
            let at = |off: f64| match self.vee(spec, pressure, off) {
                Some(bench) => bench.bending_stiffness(stretch, poisson),
                None => Err(BenchFault::Beyond),
            };
            let named = |fault: BenchFault| Failure::Message(format!("--inflated-angle: {fault}"));
            let value = at(0.0).map_err(named)?;
            let ends = [at(-OFF_ANGLE), at(OFF_ANGLE)].map(Result::ok);
            found.bending = Some(MeasuredStiffness { value, ends, at: pressure });
        }
        found.shear = self.shear(loaded, stretch, poisson)?;
        Ok(found)
    }

    /// The shear modulus from the bias strip, for fabric of the stretch stiffness `stretch`, N per m.
    fn shear(&self, loaded: &Loaded, stretch: f64, poisson: f64) -> Result<Option<MeasuredShear>, Failure> {
        let Some((path, length)) = self.bias_strip.as_ref().zip(self.bias_length) else { return Ok(None) };
        let test = read_test(&Source::new(path.display().to_string(), read_text(path, TABLE)?))?;
        let named = |fault: BiasFault| Failure::Message(format!("{}: {fault}", shown(path)));
        let strip = BiasStrip { width: self.bias_width.0, length: length.0 };
        let bias = strip.stiffness(&test).map_err(named)?;
        let thickness = loaded.reading.spec.fabric.thickness.metres();
        let modulus = |bias: f64| {
            let stiffness = shear_stiffness(bias, LineForce::from_newtons_per_metre(stretch).0, poisson)?;
            Ok(1e-6 * LineForce(stiffness).newtons_per_metre() / thickness)
        };
        let ends = [1.0 - OFF_BIAS, 1.0 + OFF_BIAS].map(|part| modulus(part * bias).ok());
        Ok(Some(MeasuredShear { megapascals: modulus(bias).map_err(named)?, ends, bias }))
    }
}

/// The elastic properties of the spec's fabric.
fn known(loaded: &Loaded) -> Result<ElasticSheet, Failure> {
    let refused = |fault| Failure::Message(format!("{}: {fault}", shown(&loaded.source.name)));
    sheet(&loaded.reading.spec.fabric).map_err(refused)
}

/// Measured and predicted coiling of the V-actuator.
pub(super) struct Coiling {
    measured: f64,
    predicted: f64,
    model: &'static str,
}

impl Coiling {
    /// The text as comments of a spec.
    pub(super) fn text(&self) -> String {
        let Self { measured, predicted, model } = self;
        // Adding 0 makes +0 of -0.
        let off = (1e3 * (measured / predicted - 1.0)).round() / 10.0 + 0.0;
        format!(
            "# lambda measured: {measured:.3}\n# lambda predicted ({model}): {predicted:.3}; measured is {off:+.1} %\n"
        )
    }

    /// The JSON answer.
    pub(super) fn json(&self) -> Value {
        json!({ "measured": self.measured, "predicted": self.predicted, "model": self.model })
    }
}

/// One stiffness, SI units, and its values at both ends of the measurement's error, where they exist.
struct MeasuredStiffness {
    value: f64,
    ends: [Option<f64>; 2],
    at: Pressure,
}

/// The shear modulus, MPa, its values at both ends of the strip's error, and the strip's stiffness, N/mm.
struct MeasuredShear {
    megapascals: f64,
    ends: [Option<f64>; 2],
    bias: f64,
}

/// Stiffnesses of a fabric; those without a bench test are absent.
#[derive(Default)]
pub(super) struct Stiffnesses {
    stretch: Option<MeasuredStiffness>,
    bending: Option<MeasuredStiffness>,
    shear: Option<MeasuredShear>,
}

impl Stiffnesses {
    /// The whole `[fabric]` section, for an answer without a seal setting; empty without a measurement.
    pub(super) fn section(&self) -> String {
        let lines = self.toml();
        if lines.is_empty() { lines } else { format!("[fabric]\n{lines}") }
    }

    /// Lines of the `[fabric]` section.
    pub(super) fn toml(&self) -> String {
        let mut out = String::new();
        let mut line = |found: &Option<MeasuredStiffness>,
                        key: &str,
                        source: &str,
                        off: &str,
                        text: &dyn Fn(f64) -> String| {
            let Some(MeasuredStiffness { value, ends, at }) = found else { return };
            let ends = ends.map(|end| end.map_or("unknown".to_owned(), text));
            // Writing to a String does not fail.
            let _ = writeln!(
                out,
                "# of the {source} at {at}; {off} less or more would make it {}, {}\n{key} = \"{}\"",
                ends[0],
                ends[1],
                text(*value)
            );
        };
        line(&self.stretch, "stretch_stiffness", "disc", "0.2 mm", &|y| {
            digits(LineForce::from_newtons_per_metre(y).0) + " N/mm"
        });
        line(&self.bending, "bending_stiffness", "V-actuator", "a degree", &|b| {
            digits(BendingStiffness::from_newton_metres(b).0) + " N mm"
        });
        if let Some(MeasuredShear { megapascals, ends, bias }) = &self.shear {
            let ends = ends.map(|end| end.map_or("unknown".to_owned(), |end| digits(end) + " MPa"));
            let _ = writeln!(
                out,
                "# of a strip along the bias that bears {} N/mm; 5 % less or more would make it {}, {}\nshear_modulus = \"{} MPa\"",
                digits(*bias),
                ends[0],
                ends[1],
                digits(*megapascals)
            );
        }
        out
    }

    /// The JSON answer.
    pub(super) fn json(&self) -> Value {
        let known = |found: &Option<MeasuredStiffness>, unit: fn(f64) -> f64| {
            found.as_ref().map(|found| unit(found.value))
        };
        json!({
            "stretch_stiffness_N_mm": known(&self.stretch, |y| LineForce::from_newtons_per_metre(y).0),
            "shear_modulus_MPa": self.shear.as_ref().map(|found| found.megapascals),
            "bending_stiffness_Nmm": known(&self.bending, |b| BendingStiffness::from_newton_metres(b).0),
        })
    }
}

/// Three significant digits, without an exponent.
fn digits(value: f64) -> String {
    let before = libm::log10(value.abs()).floor();
    let decimals = if before.is_finite() { (2.0 - before).clamp(0.0, 12.0) } else { 0.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 12")]
    let decimals = decimals as usize;
    format!("{value:.decimals$}")
}
