//! One line for a rebuilt spec: the changed values, and their effect on the gripper.

use crate::answer::sealing_in_words;
use crate::cli::load::Loaded;
use crate::cli::words::count_beyond;
use crate::pipeline::{Forecast, Precaution};
use forecast::ranges::shown::rounded;
use forecast::verdict::Verdict;
use spec::{Setting, settings};

/// The values that two builds of one spec are compared by.
#[derive(Clone, Debug)]
pub(super) struct Snapshot {
    settings: Vec<Setting>,
    machine: String,
    verdict: Option<&'static str>,
    figures: Vec<ComparedFigure>,
    notes: Vec<String>,
}

/// A number in the line of changes: its name, the value, and the unit.
type ComparedFigure = (&'static str, String, &'static str);

/// Largest number of changed values in the line.
const NAMED: usize = 4;

impl Snapshot {
    /// The snapshot of a spec with its profile, and the precautions before sealing.
    pub(super) fn new(loaded: &Loaded, forecast: &Forecast, notes: &[Precaution]) -> Self {
        let verdict = forecast.verdict();
        let design = forecast.design.warnings.iter().map(|warning| warning.found.clone());
        Self {
            settings: settings(&loaded.source),
            machine: loaded.sources().machine.to_owned(),
            verdict: verdict.as_ref().map(Verdict::word),
            figures: figures(forecast, verdict.as_ref()),
            notes: notes.iter().map(|note| note.text.clone()).chain(design).collect(),
        }
    }

    /// The differences from `previous`, in one line: "tube_width 13 mm -> 14 mm: force 27 -> 29 N".
    pub(super) fn changes(&self, previous: &Self) -> String {
        let mut values: Vec<String> =
            self.settings.iter().filter_map(|setting| changed(setting, &previous.settings)).collect();
        values.extend(
            previous
                .settings
                .iter()
                .filter(|was| !self.settings.iter().any(|is| is.is_same_key(was)))
                .map(|was| format!("{} {} -> none", was.key, was.value.as_deref().unwrap_or("none"))),
        );
        if self.machine != previous.machine {
            values.push("machine profile".to_owned());
        }
        let rest = count_beyond(values.len(), NAMED);
        values.truncate(NAMED);
        values.extend(rest.map(|rest| format!("{rest} more")));
        let verdict = self.verdict.filter(|_| self.verdict != previous.verdict).map(str::to_owned);
        let effects: Vec<String> = verdict.into_iter().chain(self.moved(previous)).collect();
        match (values.is_empty(), effects.is_empty()) {
            (true, true) => "nothing changed".to_owned(),
            (true, false) => effects.join(", "),
            (false, true) => format!("{}: the same numbers", values.join(", ")),
            (false, false) => format!("{}: {}", values.join(", "), effects.join(", ")),
        }
    }

    /// The precautions that are not in `previous`.
    pub(super) fn new_notes<'a>(&'a self, previous: &'a Self) -> impl Iterator<Item = &'a String> {
        self.notes.iter().filter(|note| !previous.notes.contains(note))
    }

    /// The changed results.
    fn moved(&self, previous: &Self) -> Vec<String> {
        let changes = self.figures.iter().filter_map(|figure| {
            let (name, value, unit) = figure;
            match previous.figures.iter().find(|was| was.0 == *name) {
                Some(was) if was == figure => None,
                Some((_, was, _)) => Some(format!("{name} {was} -> {value}{unit}")),
                None => Some(format!("{name} {value}{unit}")),
            }
        });
        changes.collect()
    }
}

/// "tube_width 13 mm -> 14 mm", if the value differs from `previous`.
fn changed(setting: &Setting, previous: &[Setting]) -> Option<String> {
    let old = previous.iter().find(|was| was.is_same_key(setting));
    let (old_value, is) = (old.and_then(|old| old.value.as_deref()), setting.value.as_deref());
    let [old_text, text] = [old_value, is].map(|value| value.unwrap_or("none"));
    (old_value != is).then(|| format!("{} {old_text} -> {text}", setting.key))
}

/// The results that matter while values are chosen.
fn figures(forecast: &Forecast, verdict: Option<&Verdict>) -> Vec<ComparedFigure> {
    let star = forecast.prediction.as_ref().map(|prediction| &prediction.first);
    let opens = star.and_then(|star| star.graspable_radius_mm).map(|[_, most]| 2.0 * most);
    let closes = star.and_then(|star| star.final_radius_mm).map(|least| 2.0 * least);
    let sealing = ("sealing", sealing_in_words(forecast), "");
    let figures = [
        ("force", verdict.and_then(|verdict| verdict.force_N), " N"),
        ("carries", star.and_then(|star| star.payload_kg), " kg"),
        ("opens to", opens, " mm"),
        ("closes to", closes, " mm"),
    ];
    let figures = figures.into_iter().filter_map(|(name, value, unit)| Some((name, rounded(value?), unit)));
    figures.chain([sealing]).collect()
}
