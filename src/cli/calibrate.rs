//! `stargrip-cam calibrate`

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::answer::quantity::{number, quantity};
use crate::cli::bench::{BenchArgs, Coiling, Stiffnesses};
use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::load::{Loaded, refuse_two_stdin};
use crate::cli::shell::{not_computed, watched_by};
use crate::cli::text_file::{TABLE, read_text};
use crate::cli::verbosity::Verbosity;
use crate::coupon::{
    Calibration, ToolPace, calibrate, listing, read_laser_rows, read_press_rows, read_rows, settings, steady,
};
use design::Design;
use forecast::case::Case;
use forecast::drawn::inflate;
use forecast::seal_load::seal_loads;
use forecast::shell::Detail;
use spec::units::LineForce;
use spec::{Allowed, Source};

/// Arguments of `calibrate`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Without --needed and --spec every setting is listed with its strength, no setting is chosen, and the exit code is 1. \
    Without RESULTS only the bench tests are evaluated: V-actuator, disc, bias strip."
)]
pub(super) struct Args {
    /// The filled-in table that `coupon` wrote: CSV with temperature_C, speed_mm_s, height_mm and peel_N; of a press with time_s, of a laser with power_percent
    /// and focus_mm.
    #[arg(required_unless_present_any = ["inflated_angle", "disc_width", "bias_strip"])]
    results: Option<PathBuf>,
    /// Required strength of the seal, such as "1.2 N/mm".
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true, value_parser = quantity::<LineForce>(Allowed::half_open(0.0, 1e4)), conflicts_with = "spec", requires = "results")]
    needed: Option<LineForce>,
    /// The spec whose seal must hold: the largest load on it at the pressure of its `load` section.
    /// For a drawing the shell is computed: seconds to minutes.
    #[arg(long)]
    spec: Option<PathBuf>,
    /// Required ratio of the seal's strength to its load, 1 to 100.
    #[arg(long, default_value_t = 1.5, allow_hyphen_values = true, value_parser = number(Allowed::closed(1.0, 100.0)))]
    margin: f64,
    /// The process that the values are for: a section `[process.NAME]` is printed in the place of `[seal]`.
    #[arg(long, value_name = "NAME", requires = "results", value_parser = process_name)]
    process: Option<String>,
    /// The table is of a heat press: a section `[press]` is printed in the place of `[seal]`.
    #[arg(long, requires = "results", conflicts_with = "process")]
    press: bool,
    /// The table is of a laser: `power` and `focus` are printed in the place of `temperature`.
    #[arg(long, requires = "results", conflicts_with = "press")]
    laser: bool,
    #[command(flatten)]
    bench: BenchArgs,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// The name of a process.
fn process_name(text: &str) -> Result<String, String> {
    spec::check_process_name(text).map(|()| text.to_owned())
}

/// Prints the values that the spec should have.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    refuse_two_stdin(args.results.iter().chain(&args.spec).chain(args.bench.table()))?;
    let settings = match &args.results {
        Some(path) => {
            let table = Source::new(path.display().to_string(), read_text(path, TABLE)?);
            settings(&match (args.press, args.laser) {
                (true, _) => read_press_rows(&table)?,
                (false, true) => read_laser_rows(&table)?,
                (false, false) => read_rows(&table)?,
            })
        }
        None => Vec::new(),
    };
    let spec = args.spec.as_deref().map(|path| Loaded::read_spec(path, args.verbosity)).transpose()?;
    let coiling = args.bench.coiling(spec.as_ref())?;
    let fabric =
        spec.as_ref().map_or_else(|| Ok(Stiffnesses::default()), |spec| args.bench.stiffnesses(spec))?;
    args.verbosity.remark(&coiling.as_ref().map_or_else(String::new, Coiling::text))?;
    let bench_result = BenchResult { args, spec, settings, coiling, fabric };
    let Some(results) = &args.results else {
        return args.verbosity.report(&bench_result.fabric.section(), &bench_result.json(None, None));
    };
    // The V-actuator's result does not depend on the strips.
    let choice = bench_result.choose(results);
    if choice.is_err() {
        args.verbosity.remark(&bench_result.fabric.section())?;
    }
    choice
}

/// Results of the bench tests and of the strips.
struct BenchResult<'a> {
    args: &'a Args,
    spec: Option<Loaded>,
    settings: Vec<Calibration>,
    coiling: Option<Coiling>,
    fabric: Stiffnesses,
}

impl BenchResult<'_> {
    /// Chooses a setting of the table at `results`, and prints it with the bench results.
    fn choose(&self, results: &Path) -> Result<(), Failure> {
        let Self { args, settings, .. } = self;
        let refused = |fault| Failure::Message(format!("{}: {fault}", escaped_line(results)));
        let need = match (args.needed, &self.spec) {
            (Some(needed), _) => {
                Some(Need { force: needed.0, margin: args.margin, why: String::new(), hint: "" })
            }
            (None, Some(spec)) => Some(Need::for_spec(spec, args)?),
            (None, None) => None,
        };
        let Some(need) = need else {
            let _ = steady(settings).map_err(refused)?;
            let reason = "no setting is chosen: give the required strength by --needed FORCE, or by --spec SPEC with a pressure in [load]"
                .to_owned();
            if args.verbosity.json {
                return Err(Failure::answered(self.json(None, None), &reason));
            }
            args.verbosity.remark(&listing(settings))?;
            return Err(Failure::Message(reason));
        };
        let choice = calibrate(settings, need.force, need.margin)
            .map_err(|fault| Failure::Message(format!("{}: {fault}{}", escaped_line(results), need.hint)))?;
        // One [fabric] section in all, so that the lines can be copied as they are.
        let fabric = format!("[fabric]\n{}", self.fabric.toml());
        let chosen_toml = match &args.process {
            Some(name) => choice.process_toml(name),
            None => choice.toml().replacen("[fabric]\n", &fabric, 1),
        };
        let all_settings = if args.verbosity.verbose { listing(settings) } else { String::new() };
        let text = format!("{all_settings}{}{chosen_toml}", need.why);
        args.verbosity.report(&text, &self.json(Some(&need), Some(&choice)))
    }

    /// The JSON answer.
    fn json(&self, need: Option<&Need>, choice: Option<&Calibration>) -> Value {
        json!({
            "needed_N_mm": need.map(|need| need.force),
            "margin": need.map_or(self.args.margin, |need| need.margin),
            "settings": self.settings.iter().map(setting).collect::<Vec<_>>(),
            "chosen": choice.map(setting),
            "coiling": self.coiling.as_ref().map(Coiling::json),
            "fabric": self.fabric.json(),
        })
    }
}

/// The JSON answer for one setting.
fn setting(calibration: &Calibration) -> Value {
    let heat =
        if let ToolPace::Laser { .. } = calibration.setting.pace { "power_percent" } else { "temperature_C" };
    let mut setting = json!({
        heat: calibration.setting.heat,
        "specimens": calibration.count,
        "mean_N_mm": calibration.mean,
        "deviation_N_mm": Some(calibration.deviation).filter(|_| calibration.count > 1),
        "holds_N_mm": Some(calibration.strength).filter(|_| calibration.count > 1),
    });
    match calibration.setting.pace {
        ToolPace::Iron { speed, height } => {
            setting["speed_mm_s"] = json!(speed);
            setting["height_mm"] = json!(height);
        }
        ToolPace::Laser { speed, focus } => {
            setting["speed_mm_s"] = json!(speed);
            setting["focus_mm"] = json!(focus);
        }
        ToolPace::Press { time } => setting["time_s"] = json!(time),
    }
    setting
}

/// A required strength.
struct Need {
    /// The largest load on the seal, N/mm.
    force: f64,
    /// Required ratio of the seal's strength to it.
    margin: f64,
    /// A comment that names its place; empty if it was given.
    why: String,
    /// The end of the message that no setting has that strength; empty if there is nothing to add.
    hint: &'static str,
}

impl Need {
    /// The need of the seal of a spec. The margin is at least such that `check` finds no seal that may burst.
    fn for_spec(loaded: &Loaded, args: &Args) -> Result<Self, Failure> {
        // The loads of all seams are collected: of stars by the formulas, of drawings by the shell. The largest is the need; a
        // pull that is uncertain raises the margin.
        let spec = &loaded.reading.spec;
        let pressure = spec.load.as_ref().and_then(|load| load.pressure);
        let pressure =
            pressure.ok_or_else(|| refused(loaded, "[load] has no pressure; write one, or give --needed"))?;
        let design = Design::new(spec, &loaded.machine).map_err(|refusals| loaded.refused(refusals))?;
        let (mut loads, mut surely) = (Vec::new(), 0.0_f64);
        for part in design.assembly().into_iter().flat_map(|assembly| &assembly.distinct) {
            let case = Case::of_part(spec, part).map_err(|fault| refused(loaded, &fault.to_string()))?;
            for load in seal_loads(spec, &case, part) {
                surely = surely.max(load.sure_strength.map_or(0.0, |strength| strength.0));
                loads.push((load.load, load.place.to_owned()));
            }
        }
        if let Some(pieces) = design.drawn_pieces() {
            let inflated = watched_by(args.verbosity, true, |watch| {
                inflate(spec, pieces, Detail::Coarse, watch).map_err(|refusal| not_computed(loaded, refusal))
            })?;
            loads.extend(inflated.prediction.seam_loads());
        }
        let mut largest = (0.0, String::new());
        for (load, place) in loads {
            let unknown = || refused(loaded, &format!("the load at the {place} is unknown; give --needed"));
            let force = load.ok_or_else(unknown)?;
            if force.0 > largest.0 {
                largest = (force.0, place);
            }
        }
        let (force, place) = largest;
        let mut reason = format!("# at {pressure} the seal has to hold {force:.3} N/mm at the {place}\n");
        let (mut margin, mut hint) = (args.margin, "");
        if surely > margin * force {
            margin = (100.0 * surely / force).ceil() / 100.0;
            let _ = writeln!(
                reason,
                "# it may have to hold {surely:.3} N/mm, so the margin is {margin}: the pull of such hinges is uncertain"
            );
            hint =
                "; the pull of such hinges is uncertain: a larger tip_radius and corner_radius may need less";
        }
        Ok(Self { force, margin, why: reason, hint })
    }
}

fn refused(loaded: &Loaded, reason: &str) -> Failure {
    Failure::Message(format!("{}: {reason}", escaped_line(&loaded.source.name)))
}
