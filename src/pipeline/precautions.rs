//! Precautions before sealing: tasks and warnings for the user before hours of work begin.

use crate::airtight;
use crate::pipeline::code::PrecautionCode;
use crate::pipeline::weak_process::weak_processes;
use crate::pipeline::{Forecast, Interface};
use design::{PressPlan, SheetLayout};
use forecast::ranges::shown::rounded;
use forecast::seal_load::{Bursting, SealLoad};
use forecast::warning::{PredictionWarning, WarningCode};
use program::plan::{
    Chop, LASER_SAFETY, MEAN_TOLERANCE, Pace, Program, homing_by_hand, laser_settings, other_version,
};
use spec::units::{Readable, Speed};
use spec::{CutTool, Machine, Marks, SealingTool};

/// Below this speed the lowest step rate of a controller matters: firmwares step at 30 to 120 steps/s at least, and a belt has 25 steps/mm
/// or more, which gives about 5 mm/s.
const SLOW: Speed = Speed(5.0);

/// Ten times the seal speed of the paper, 0.1 mm/s; a faster seal gets a warning.
const FAST: Speed = Speed(1.0);

/// The profile for an unknown machine.
const UNKNOWN: &str = "generic";

/// One task or warning before sealing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Precaution {
    /// Subject of the precaution.
    pub code: PrecautionCode,
    /// The task or warning: a sentence without its full stop. Commands are in backticks.
    pub text: String,
}

impl Precaution {
    fn new(code: PrecautionCode, text: String) -> Self {
        Self { code, text }
    }
}

impl Forecast {
    /// All precautions, the most urgent first, in the words of `interface`.
    pub fn precautions(&self, interface: Interface<'_>) -> Vec<Precaution> {
        // First what concerns the design: whether it holds, bursts, or can be trusted. Then the workshop: a press has steps of its
        // own, an unknown machine is told to be tried, a known one has its own words.
        let unfit = self.unfit();
        let is_fit = unfit.is_empty();
        let mut list: Vec<Precaution> = unfit
            .iter()
            .map(|refusal| Precaution::new(PrecautionCode::Unfit, refusal.found.clone()))
            .collect();
        list.extend(self.doubt());
        list.extend(weak_seal(self, is_fit));
        list.extend(strength(self, interface));
        list.extend(predicted(self, is_fit));
        list.extend(of_drawing(self));
        list.extend(fit_valves(self));
        let notes = weak_processes(self, interface).into_iter();
        list.extend(notes.map(|text| Precaution::new(PrecautionCode::WeakProcess, text)));
        list.extend(cut_sheet(self));
        list.extend(marks(self, interface));
        if let Some(plan) = PressPlan::new(&self.spec, &self.design) {
            list.extend(before_pressing(&plan));
            return unique(list);
        }
        if is_unknown(&self.machine) && !matches!(pace(self), Some(Pace::Chopped(_))) {
            list.extend(fast(self, interface));
            list.push(generic(self, interface));
            return unique(list);
        }
        list.extend(laser(self, interface));
        list.extend(speed(self, interface));
        let requires = self.machine.script.requires.iter();
        let homing = homing_by_hand(&self.machine).map(str::to_owned);
        let tasks = homing.into_iter().chain(requires.cloned());
        list.extend(tasks.map(|text| Precaution::new(PrecautionCode::MachineRequires, text)));
        list.extend(version(self));
        if self.machine.bench.work_area.is_none() {
            let text = format!(
                "the machine must reach {}: `x` and `y` in [work_area] of its profile are unknown",
                self.sheet_sizes()
            );
            list.push(Precaution::new(PrecautionCode::UnknownReach, text));
        }
        unique(list)
    }

    /// The warning that it may not hold its object, unless it is refused for that; printed even with --quiet.
    pub fn doubt(&self) -> Option<Precaution> {
        let text = self.uncertain().filter(|_| self.unfit().is_empty())?;
        Some(Precaution::new(PrecautionCode::MayNotHold, text))
    }

    /// The sheets' sizes as text, mm.
    pub fn sheet_sizes(&self) -> String {
        let size = |sheet: &SheetLayout| format!("{} x {} mm", rounded(sheet.width), rounded(sheet.height));
        let mut sizes: Vec<String> = self.design.sheets.iter().map(size).collect();
        sizes.dedup();
        sizes.join(", ")
    }
}

/// What a press must give, and what is to be tested before it is used.
fn before_pressing(plan: &PressPlan) -> Vec<Precaution> {
    let force = format!(
        "the press must give {} on the whole sheet; each kN of a smaller one gives {} bar there: set the `pressure` that yours reaches, \
         or seal smaller sheets one after another",
        plan.force_in_words(),
        rounded(1e4 / plan.area)
    );
    let peel =
        "only a peel test of strips of this fabric shows whether temperature, time and pressure seal it"
            .to_owned();
    [force, peel].map(|text| Precaution::new(PrecautionCode::Pressing, text)).into()
}

/// What protects from a laser, the settings that its programs rely on, and the test of its power.
fn laser(forecast: &Forecast, interface: Interface<'_>) -> Vec<Precaution> {
    let controller = &forecast.machine.controller;
    let Some(drive) = controller.laser else { return Vec::new() };
    let safety = LASER_SAFETY.map(|text| Precaution::new(PrecautionCode::LaserSafety, text.to_owned()));
    let settings = laser_settings(controller, drive);
    let settings = settings.map(|text| Precaution::new(PrecautionCode::MachineRequires, text));
    let peel = format!(
        "only a peel test shows whether {} at {} seals this fabric: {} writes one",
        forecast.spec.seal.heat_in_words(),
        forecast.spec.seal.speed,
        interface.command("coupon")
    );
    let peel = Precaution::new(PrecautionCode::LaserSafety, peel);
    safety.into_iter().chain(settings).chain([peel]).collect()
}

/// The version of Marlin for which the strokes are timed, where another one would leave the speed.
fn version(forecast: &Forecast) -> Option<Precaution> {
    let other = other_version(&forecast.programs)?;
    let percent = Readable((1e3 * other.error).round() / 10.0);
    let (versions, remedy) = if other.has_first_rate {
        ("with it (1.1, 2.0.x)", "first_step_rate = 120")
    } else {
        ("without it", "first_step_rate = \"none\"")
    };
    let text = format!(
        "look for MINIMAL_STEP_RATE in planner.cpp of your Marlin: on a version {versions} the seal's speed is up to {percent} % off; \
         for it write `{remedy}` in [motion]"
    );
    Some(Precaution::new(PrecautionCode::MachineRequires, text))
}

/// `list` without duplicate texts.
fn unique(list: Vec<Precaution>) -> Vec<Precaution> {
    let mut unique: Vec<Precaution> = Vec::new();
    for one in list {
        if unique.iter().all(|other| other.text != one.text) {
            unique.push(one);
        }
    }
    unique
}

/// Whether the profile is the generic one, which has neither a speed range nor a work area.
fn is_unknown(machine: &Machine) -> bool {
    machine.name == UNKNOWN && machine.motion.speed_range().is_none() && machine.bench.work_area.is_none()
}

/// The list of missing checks on an unknown machine.
fn generic(forecast: &Forecast, interface: Interface<'_>) -> Precaution {
    let text = format!(
        "{} profile: speed, pause and reach are not checked; name your machine with `profile` in [machine], \
         or time the program that {} writes",
        forecast.machine.name,
        interface.command("feedcheck")
    );
    Precaution::new(PrecautionCode::GenericMachine, text)
}

fn pace(forecast: &Forecast) -> Option<Pace> {
    forecast.programs.first().map(Program::pace)
}

/// Weak places of the seal; for an unfit gripper without seals that certainly burst, which its refusal reports.
fn weak_seal(forecast: &Forecast, is_fit: bool) -> Vec<Precaution> {
    let report = airtight::report(&forecast.spec, &forecast.machine, &forecast.design);
    let unsaid = |load: &&SealLoad| is_fit || load.bursting == Some(Bursting::Perhaps);
    let weak = report.pieces.iter().flat_map(|piece| {
        let bursting = piece.loads.iter().filter(unsaid).filter_map(SealLoad::weakness);
        let texts = piece.passage.weaknesses.iter().cloned().chain(bursting);
        texts.map(|text| Precaution::new(PrecautionCode::WeakSeal, format!("{}: {text}", piece.name)))
    });
    weak.collect()
}

/// Warnings of the prediction, without the reasons that make the gripper unfit, and without the distance to bursting, which is reported
/// already.
fn predicted(forecast: &Forecast, is_fit: bool) -> Vec<Precaution> {
    let mut list = Vec::new();
    for star in forecast.prediction.iter().flat_map(|prediction| &prediction.stars) {
        let warnings = star.evidence.warnings.iter().filter(|warning| match warning.code {
            WarningCode::NoModel | WarningCode::Bursting => false,
            WarningCode::Object => is_fit,
            WarningCode::LeavesPlane | WarningCode::Validity => true,
        });
        list.extend(
            warnings.map(|warning| Precaution::new(PrecautionCode::Prediction, warning.text.clone())),
        );
    }
    list
}

/// Warnings of the prediction of a drawn piece.
fn of_drawing(forecast: &Forecast) -> Vec<Precaution> {
    let Some(drawn_forecast) = &forecast.drawn else { return Vec::new() };
    let is_unfit = drawn_forecast.prediction.bursts().is_some();
    let precaution = |warning: &PredictionWarning| {
        let code = match warning.code {
            WarningCode::Bursting if is_unfit => return None,
            WarningCode::LeavesPlane => PrecautionCode::LeavesPlane,
            WarningCode::NoModel | WarningCode::Bursting | WarningCode::Object | WarningCode::Validity => {
                PrecautionCode::Prediction
            }
        };
        Some(Precaution::new(code, warning.text.clone()))
    };
    drawn_forecast.prediction.evidence.warnings.iter().filter_map(precaution).collect()
}

/// The task to seal the valves to their sheet first.
fn fit_valves(forecast: &Forecast) -> Option<Precaution> {
    let clearance = match forecast.machine.tool {
        SealingTool::Iron | SealingTool::Laser => {
            let height = Readable(forecast.machine.process.heights.travel.0);
            format!("the tool passes {height} mm above the fabric between seams")
        }
        SealingTool::Press => {
            "the valves must bear the heat of the plates, or foam with holes for them lies between".to_owned()
        }
    };
    let text = format!(
        "cut one sheet along the outline with valves, and seal the flange of each valve to it around its hole; lay it on \
         the other, the valves upwards: {clearance}"
    );
    let mut shapes = forecast.design.placed().iter().map(|placed| forecast.design.part(placed).shape());
    shapes.any(|shape| !shape.valves.is_empty()).then(|| Precaution::new(PrecautionCode::FitValve, text))
}

/// The tasks before the cut of the sheet, and its length and time.
fn cut_sheet(forecast: &Forecast) -> Option<Precaution> {
    let process = forecast.spec.cut.program.filter(|_| !forecast.cuts.is_empty())?;
    let fumes = match process.tool {
        CutTool::HotTip { .. } => "; hot fabric gives off fumes, so draw them off",
        CutTool::DragKnife { .. } => "",
        CutTool::Laser { .. } => {
            let text = "before the cut leave the sheet clamped, with a honeycomb or something else under it that does not burn: a cut \
                        sets fire sooner than a seal";
            return Some(Precaution::new(PrecautionCode::CutSheet, text.to_owned()));
        }
    };
    let (tool, height) = (process.tool.in_words(), Readable(-process.height.0));
    let text = format!(
        "before the cut take the release layer off, leave the sheet clamped, and put the {tool} in at the same X, Y and Z0: it goes \
         {height} mm below Z0, so what lies under the fabric must bear that{fumes}"
    );
    Some(Precaution::new(PrecautionCode::CutSheet, text))
}

/// The places of the marks above which programs stop.
fn marks(forecast: &Forecast, interface: Interface<'_>) -> Vec<Precaution> {
    let sheets = forecast.design.sheets.iter().filter(|_| forecast.spec.machine.marks == Marks::Pause);
    let text = |sheet: &SheetLayout| {
        let [a, b] = forecast.design.marks(sheet.index)?;
        Some(format!(
            "trace and seal stop above two marks of sheet {}, X{:.2} Y{:.2} and X{:.2} Y{:.2}: mark the sheet there; if it is moved later, \
             {} takes where they lie then",
            sheet.index,
            a.x,
            a.y,
            b.x,
            b.y,
            interface.align()
        ))
    };
    sheets.filter_map(text).map(|text| Precaution::new(PrecautionCode::SheetMarks, text)).collect()
}

/// The warning that the strength of the seal is unknown.
fn strength(forecast: &Forecast, interface: Interface<'_>) -> Option<Precaution> {
    let _ = forecast.spec.load.as_ref()?.pressure?;
    if forecast.spec.fabric.seal_strength.is_some() {
        return None;
    }
    let report = airtight::report(&forecast.spec, &forecast.machine, &forecast.design);
    let loads = report.pieces.iter().flat_map(|star| &star.loads).filter_map(|load| load.load);
    let chambers = forecast.drawn.iter().flat_map(|drawn| &drawn.prediction.chambers);
    let chamber_loads = chambers.filter_map(|chamber| match chamber.ranges {
        Some(ranges) => Some(ranges.seal_pull_N_per_mm[1]),
        None => chamber.seal_pull_N_per_mm.map(|pull| pull.value),
    });
    let largest = loads.map(|load| load.0).chain(chamber_loads).reduce(f64::max)?;
    let text = format!(
        "the burst pressure is unknown: the seal must withstand {} N/mm; measure yours ({}) and set `seal_strength` in [fabric]",
        rounded(largest),
        interface.coupon()
    );
    Some(Precaution::new(PrecautionCode::UnknownStrength, text))
}

/// The difference of a chopped seal's mean speed by what else Marlin does, in words; empty where it is within the tolerance.
fn slow_display(chop: &Chop, speed: Speed) -> String {
    let error = chop.dwell_error(speed.0).filter(|error| *error > MEAN_TOLERANCE);
    error.map_or(String::new(), |error| {
        let percent = Readable((1e3 * error).ceil() / 10.0);
        format!(", and may be up to {percent} % off, slower with a slow display")
    })
}

/// Whether the machine can move as slowly as the program requires, and whether a fast seal is tested.
fn speed(forecast: &Forecast, interface: Interface<'_>) -> Vec<Precaution> {
    // A chopped seal rests on the controller's acceleration, and a slow one on its lowest feed. Neither can be known
    // from here, so the precaution names the program that measures it.
    let Forecast { spec, machine, .. } = forecast;
    let speed = spec.seal.speed;
    let slow = match pace(forecast) {
        Some(Pace::Chopped(chop)) => Some((
            PrecautionCode::ChoppedSeal,
            format!(
                "the seal's speed is an average of dwells and strokes of at most {} mm at {} mm/s: this assumes \
             an acceleration of {} mm/s^2{}{}; time the program that {} writes",
                Readable(chop.longest),
                rounded(chop.speed),
                Readable(chop.acceleration),
                machine.motion.steps_per_mm.map_or(String::new(), |[x, y, _]| {
                    format!(" and at least {x} (X) and {y} (Y) steps/mm")
                }),
                slow_display(&chop, speed),
                interface.command("feedcheck")
            ),
        )),
        _ if machine.motion.speed_range().is_none() && speed < SLOW => Some((
            PrecautionCode::UnknownFeed,
            format!(
                "the lowest feed of this machine is unknown, and some controllers go several times faster than {speed} \
             without reporting it: time the program that {} writes",
                interface.command("feedcheck")
            ),
        )),
        _ => None,
    };
    let slow = slow.map(|(code, text)| Precaution::new(code, text));
    slow.into_iter().chain(fast(forecast, interface)).collect()
}

/// The warning that such a fast seal is untested.
fn fast(forecast: &Forecast, interface: Interface<'_>) -> Option<Precaution> {
    let speed = forecast.spec.seal.speed;
    let text = format!(
        "the paper sealed at 0.1 mm/s: only a peel test shows whether this fabric is tight when sealed at {speed}; \
         {} writes one",
        interface.command("coupon")
    );
    // A laser is as fast as its power allows: the note on its power says that it needs a test.
    (speed > FAST && forecast.spec.seal.power.is_none())
        .then(|| Precaution::new(PrecautionCode::FastSeal, text))
}
