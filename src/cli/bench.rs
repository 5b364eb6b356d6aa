//! Bench tests of `calibrate`: measurements of a V-actuator, a disc and a strip, and the stiffnesses that follow from them.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::answer::quantity::{number, quantity, quantity_or_number};
use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::text_file::{TABLE, read_text};
use crate::coupon::DISC;
use crate::coupon::bias::{BiasStrip, read_strip, shear_stiffness};
use design::realised_radius;
use forecast::case::sheet;
use forecast::stiffness::{BenchFault, DiscBench, VBench, least_angle};
use inflatable::mechanics::hinge::ring::Ring;
use inflatable::mechanics::hinge::{Hinge, HingeModel};
use inflatable::mechanics::strength::ElasticSheet;
use spec::units::{Angle, BendingStiffness, Length, LineForce, Pressure};
use spec::{Allowed, Source, Spec};

/// Range of a bench's pressure, kPa; the same as in a spec.
const PRESSURE: Allowed = Allowed::closed(1e-3, 1e6);
/// Assumed error of a measured angle, deg: it gives the range beside the bending stiffness.
const OFF_ANGLE: f64 = 1.0;
/// Assumed error of a disc's mean width, m: it gives the range beside the stretch stiffness. The rim of a disc folds into scallops, and
/// single widths differ by a tenth. The tension field of the inversion has a round rim: the mean width of a disc whose folds were resolved
/// (0.3 mm, 40 kPa) was 0.2 mm larger on the finer mesh, and 0.8 mm on the coarser one.
const OFF_WIDTH: f64 = 0.5e-3;
/// Assumed relative error of the bias strip's stiffness.
const OFF_BIAS: f64 = 0.05;

/// Arguments about the bench.
#[derive(clap::Args, Debug)]
pub(super) struct BenchArgs {
    /// The V-actuator's angle between its arms, flat, such as "58 deg".
    #[arg(long, value_name = "ANGLE", requires = "inflated_angle", allow_hyphen_values = true, value_parser = quantity_or_number::<Angle>(Allowed::open(0.0, 180.0)))]
    flat_angle: Option<f64>,
    /// The V-actuator's angle, inflated and without load; not above the flat one.
    #[arg(long, value_name = "ANGLE", requires = "flat_angle", allow_hyphen_values = true, value_parser = quantity_or_number::<Angle>(Allowed::open(-180.0, 180.0)))]
    inflated_angle: Option<f64>,
    /// The V-actuator's pressure, such as "30 kPa": with it and --spec the fabric's bending_stiffness is found.
    #[arg(long, value_name = "PRESSURE", requires_all = ["inflated_angle", "spec"], allow_hyphen_values = true, value_parser = quantity::<Pressure>(PRESSURE))]
    angle_pressure: Option<Pressure>,
    /// The disc's mean width between its bands, inflated, such as "78.2 mm": the mean of 12 or more widths at equal angles, because folds
    /// make its rim wavy. The largest width is too large.
    #[arg(long, value_name = "LENGTH", requires_all = ["disc_pressure", "spec"], allow_hyphen_values = true, value_parser = quantity::<Length>(Allowed::open(0.0, DISC)))]
    disc_width: Option<Length>,
    /// The disc's pressure: with it, its width and --spec the fabric's stretch_stiffness is found.
    #[arg(long, value_name = "PRESSURE", requires = "disc_width", allow_hyphen_values = true, value_parser = quantity::<Pressure>(PRESSURE))]
    disc_pressure: Option<Pressure>,
    /// A pulled strip of one sheet, cut at 45 deg to the warp: CSV with travel_mm and load_N. With it and --spec the fabric's shear_modulus is
    /// found.
    #[arg(long, value_name = "FILE", requires_all = ["spec", "bias_length"])]
    bias_strip: Option<PathBuf>,
    /// Free length of the bias strip between the clamps, at least five times its width.
    #[arg(long, value_name = "LENGTH", requires = "bias_strip", allow_hyphen_values = true, value_parser = quantity::<Length>(Allowed::half_open(0.0, 1e4)))]
    bias_length: Option<Length>,
    /// Width of the bias strip.
    #[arg(long, value_name = "LENGTH", default_value = "25 mm", allow_hyphen_values = true, value_parser = quantity::<Length>(Allowed::half_open(0.0, 1e4)))]
    bias_width: Length,
    /// The V-actuator's R / W as the band makes it; default: that of the spec's tips, without --spec 1/30.
    #[arg(long, allow_hyphen_values = true, value_parser = number(Allowed::half_open(0.0, 1e3)))]
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
        let smallest_angle = least_angle(flat.to_radians()).to_degrees();
        if inflated < smallest_angle {
            return Err(Failure::Message(format!(
                "--inflated-angle is {inflated} deg; must be: at least {smallest_angle:.1} deg, because no hinge of {flat} deg, flat, \
                 closes further; check the sign, and that both are the angle between the arms"
            )));
        }
        let measured = (180.0 - inflated) / (180.0 - flat);
        if let (Some(loaded), Some(pressure)) = (spec, self.angle_pressure) {
            let elastic_sheet = elastic_properties(loaded)?;
            let bench = self.vee(&loaded.reading.spec, pressure, 0.0);
            let predicted = bench.and_then(|bench| {
                let (bending, stretch) =
                    (elastic_sheet.bending_modulus(), elastic_sheet.stretching_modulus());
                bench.predicted(bending, stretch, elastic_sheet.poisson_ratio).ok()
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
        let of_tips = spec.and_then(|spec| {
            let star = spec.stars.first()?;
            Some(realised_radius(star.tip_radius.0, spec.seal.band.0) / star.tube_width.0)
        });
        self.radius_ratio.or(of_tips).unwrap_or(1.0 / 30.0)
    }

    /// The V-actuator of the spec's tips, with a measured angle that is `angle_error` deg too wide; `None` without angles.
    fn vee(&self, spec: &Spec, pressure: Pressure, angle_error: f64) -> Option<VBench> {
        let ((flat, inflated), star) = (self.flat_angle.zip(self.inflated_angle)?, spec.stars.first()?);
        let (width, rest_angle) = (star.tube_width.metres(), flat.to_radians());
        let hinge = Hinge { r_star: self.radius_ratio(Some(spec)), width, rest_angle };
        Some(VBench { hinge, pressure: pressure.pascals(), inflated: (inflated + angle_error).to_radians() })
    }

    /// The stiffnesses of the spec's fabric that follow from the bench tests.
    pub(super) fn stiffnesses(&self, loaded: &Loaded) -> Result<Stiffnesses, Failure> {
        // The disc gives the stretching stiffness, which the V-actuator and the bias strip then need. Each measurement
        // is inverted by the model. It is inverted again with the instrument's error on both sides, which gives the
        // range that is printed.
        let mut stiffnesses = Stiffnesses::default();
        if self.angle_pressure.is_none() && self.disc_width.is_none() && self.bias_strip.is_none() {
            return Ok(stiffnesses);
        }
        let elastic_sheet = elastic_properties(loaded)?;
        let (poisson, mut stretch) = (elastic_sheet.poisson_ratio, elastic_sheet.stretching_modulus());
        if let Some((width, pressure)) = self.disc_width.zip(self.disc_pressure) {
            let stiffness_at = |off: f64| {
                let (flat, inflated) = (Length(DISC).metres(), width.metres() + off);
                DiscBench { flat, inflated, pressure: pressure.pascals() }
                    .stretch_stiffness(elastic_sheet.bending_modulus(), poisson)
            };
            stretch =
                stiffness_at(0.0).map_err(|fault| Failure::Message(format!("--disc-width: {fault}")))?;
            let in_newtons_per_mm = |stiffness: f64| LineForce::from_newtons_per_metre(stiffness).0;
            stiffnesses.0.push(MeasuredStiffness {
                key: "stretch_stiffness",
                unit: "N/mm",
                value: in_newtons_per_mm(stretch),
                ends: [-OFF_WIDTH, OFF_WIDTH].map(|off| stiffness_at(off).ok().map(in_newtons_per_mm)),
                origin: format!("the disc's mean width at {pressure}; 0.5 mm"),
            });
        }
        if let Some(pressure) = self.angle_pressure {
            let stiffness_at = |off: f64| match self.vee(&loaded.reading.spec, pressure, off) {
                Some(bench) => bench.bending_stiffness(stretch, poisson),
                None => Err(BenchFault::Beyond),
            };
            let value =
                stiffness_at(0.0).map_err(|fault| Failure::Message(format!("--inflated-angle: {fault}")))?;
            let in_newton_mm = |stiffness: f64| BendingStiffness::from_newton_metres(stiffness).0;
            stiffnesses.0.push(MeasuredStiffness {
                key: "bending_stiffness",
                unit: "N mm",
                value: in_newton_mm(value),
                ends: [-OFF_ANGLE, OFF_ANGLE].map(|off| stiffness_at(off).ok().map(in_newton_mm)),
                origin: format!("the V-actuator at {pressure}; a degree"),
            });
        }
        stiffnesses.0.extend(self.shear(loaded, stretch, poisson)?);
        Ok(stiffnesses)
    }

    /// The shear modulus from the bias strip, for fabric of the stretch stiffness `stretch`, N per m.
    fn shear(
        &self,
        loaded: &Loaded,
        stretch: f64,
        poisson: f64,
    ) -> Result<Option<MeasuredStiffness>, Failure> {
        let Some((path, length)) = self.bias_strip.as_ref().zip(self.bias_length) else { return Ok(None) };
        let test = read_strip(&Source::new(path.display().to_string(), read_text(path, TABLE)?))?;
        let named = |fault: String| Failure::Message(format!("{}: {fault}", escaped_line(path)));
        let strip = BiasStrip { width: self.bias_width.0, length: length.0 };
        let bias = strip.stiffness(&test).map_err(named)?;
        let thickness = loaded.reading.spec.fabric.thickness.metres();
        let modulus = |bias: f64| {
            let stiffness = shear_stiffness(bias, LineForce::from_newtons_per_metre(stretch).0, poisson)?;
            Ok(1e-6 * LineForce(stiffness).newtons_per_metre() / thickness)
        };
        Ok(Some(MeasuredStiffness {
            key: "shear_modulus",
            unit: "MPa",
            value: modulus(bias).map_err(named)?,
            ends: [1.0 - OFF_BIAS, 1.0 + OFF_BIAS].map(|part| modulus(part * bias).ok()),
            origin: format!("a strip along the bias that bears {} N/mm; 5 %", digits(bias)),
        }))
    }
}

/// The elastic properties of the spec's fabric.
fn elastic_properties(loaded: &Loaded) -> Result<ElasticSheet, Failure> {
    let refused = |fault| Failure::Message(format!("{}: {fault}", escaped_line(&loaded.source.name)));
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
        let deviation = (1e3 * (measured / predicted - 1.0)).round() / 10.0 + 0.0;
        format!(
            "# lambda measured: {measured:.3}\n# lambda predicted ({model}): {predicted:.3}; measured is {deviation:+.1} %\n"
        )
    }

    /// The JSON answer.
    pub(super) fn json(&self) -> Value {
        json!({ "measured": self.measured, "predicted": self.predicted, "model": self.model })
    }
}

/// A measured value of the fabric: its key and unit in a spec, its values at both ends of the measurement's error, where they exist, and
/// its origin with that error.
struct MeasuredStiffness {
    key: &'static str,
    unit: &'static str,
    value: f64,
    ends: [Option<f64>; 2],
    origin: String,
}

/// Stiffnesses of a fabric; those without a bench test are absent.
#[derive(Default)]
pub(super) struct Stiffnesses(Vec<MeasuredStiffness>);

impl Stiffnesses {
    /// The whole `[fabric]` section, for an answer without a seal setting; empty without a measurement.
    pub(super) fn section(&self) -> String {
        let lines = self.toml();
        if lines.is_empty() { lines } else { format!("[fabric]\n{lines}") }
    }

    /// Lines of the `[fabric]` section.
    pub(super) fn toml(&self) -> String {
        let lines = |MeasuredStiffness { key, unit, value, ends, origin }: &MeasuredStiffness| {
            let [smaller, value, larger] = [ends[0], Some(*value), ends[1]]
                .map(|value| value.map_or("unknown".to_owned(), |value| format!("{} {unit}", digits(value))));
            format!("# of {origin} less or more would make it {smaller}, {larger}\n{key} = \"{value}\"\n")
        };
        self.0.iter().map(lines).collect()
    }

    /// The JSON answer.
    pub(super) fn json(&self) -> Value {
        let [stretch, shear, bending] = ["stretch_stiffness", "shear_modulus", "bending_stiffness"]
            .map(|key| self.0.iter().find(|found| found.key == key).map(|found| found.value));
        json!({
            "stretch_stiffness_N_mm": stretch,
            "shear_modulus_MPa": shear,
            "bending_stiffness_Nmm": bending,
        })
    }
}

/// Three significant digits, without an exponent.
fn digits(value: f64) -> String {
    let exponent = libm::log10(value.abs()).floor();
    let decimals = if exponent.is_finite() { (2.0 - exponent).clamp(0.0, 12.0) } else { 0.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 12")]
    let decimals = decimals as usize;
    format!("{value:.decimals$}")
}
