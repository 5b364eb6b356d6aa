//! The verdict on the object of a gripper's `[load]`, with its reasons; and the refusal of a gripper that cannot hold it.

use crate::interval::{Interval, sum};
use crate::load_check::{
    ROUNDING, bursts, held_sizes, may_be_too_heavy, may_burst, may_not_press, outside_models, too_hard,
    too_heavy, too_heavy_for_stars, too_short, too_thin, too_wide_to_enter, too_wide_to_open,
};
use crate::outcome::Grip;
use crate::prediction::StackPayload;
use crate::prediction::{Prediction, StarPrediction, groups_of_equals};
use crate::ranges::shown::{distinct, listed};
pub use crate::verdict_answer::{Holds, Verdict};
use design::{Object, Refusal, RefusalCode, Stand};
use inflatable::mechanics::strength::GRAVITY;
use spec::units::{Force, Mass, tenths_up};
use spec::{Code, Load, Spec, key};

/// The verdict on the object of `spec` between the predicted stars; `None` without an object or a pressure.
pub fn verdict(spec: &Spec, prediction: &Prediction) -> Option<Verdict> {
    let stars = &prediction.stars[..];
    let load = spec.load.as_ref()?;
    let _ = load.object_radius.filter(|_| load.pressure.is_some())?;
    let judged = VerdictLines::new(spec, load, prediction);
    let hardest = stars
        .iter()
        .filter(|star| star.object_force_N.is_some())
        .max_by(|a, b| a.object_force_N.unwrap_or(0.0).total_cmp(&b.object_force_N.unwrap_or(0.0)));
    Some(Verdict {
        holds: judged.answer(),
        code: judged.code(),
        force_N: force(stars),
        force_range_N: force_range(stars),
        needed_N: needed_force(load),
        star_force_N: hardest.and_then(|star| star.object_force_N),
        star_force_range_N: hardest.and_then(|star| star.ranges.object_force_N),
        star_flap_force_N: largest_flap_force(stars),
        base_height_mm: Stand::new(spec).map(|stand| stand.base),
        largest_force_N: load.largest_force.map(|force| force.0),
        stars: stars.len(),
        assumed: Object::assumed(load, stars.len()),
        reasons: judged.findings.iter().map(VerdictLine::reason).collect(),
    })
}

/// The reasons of `check` and `build` to refuse the gripper of `spec`: it bursts, no star of it can hold the object, it cannot carry the
/// mass, breaks the object, or no model covers it. Empty if none of this is certain, or without a load.
pub fn refusals(spec: &Spec, prediction: &Prediction) -> Vec<Refusal> {
    let Some(load) = spec.load.as_ref().filter(|load| load.pressure.is_some()) else { return Vec::new() };
    let judged = VerdictLines::new(spec, load, prediction);
    // One star that holds the object will do.
    let idle = judged.is_idle();
    let counts = |finding: &&VerdictLine| match finding.weight {
        LineWeight::Idle => idle,
        weight => weight != LineWeight::Doubted,
    };
    judged.findings.iter().filter(counts).map(VerdictLine::refusal).collect()
}

fn force(stars: &[StarPrediction]) -> Option<f64> {
    stars.iter().map(|star| star.object_force_N).sum()
}

fn force_range(stars: &[StarPrediction]) -> Option<Interval> {
    sum(stars.iter().map(|star| star.ranges.object_force_N))
}

/// The largest force of one of `stars` whose flap stays straight, N; `None` if that of any of them is unknown.
fn largest_flap_force(stars: &[StarPrediction]) -> Option<f64> {
    let touching = stars.iter().filter(|star| star.object_radius_mm.is_some_and(|radius| radius > 0.0));
    touching.map(|star| star.ranges.flap_force_N.map(|[_, most]| most)).reduce(|a, b| Some(a?.max(b?)))?
}

/// `text` about the stars with `numbers`; without numbers about all of them.
pub fn of_stars(numbers: &[usize], text: &str) -> String {
    match numbers {
        [] => text.to_owned(),
        [star] => format!("star {star}: {text}"),
        _ => format!("stars {}: {text}", listed(numbers)),
    }
}

/// m g / mu, N.
fn needed_force(load: &Load) -> Option<f64> {
    required_force(load, load.friction?)
}

/// The radial force that friction of this coefficient needs to carry the mass, N.
fn required_force(load: &Load, friction: f64) -> Option<f64> {
    let Mass(mass) = load.mass?;
    Some(mass * GRAVITY / friction)
}

/// The weight of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LineWeight {
    /// The star does not hold the object: another one may.
    Idle,
    /// The gripper does not meet its purpose.
    Refuted,
    /// Whether it does depends on the position within its ranges.
    Doubted,
    /// No model covers it.
    Unknown,
}

/// One thing that was found.
#[derive(Debug)]
struct VerdictLine {
    weight: LineWeight,
    /// Numbers of its stars, 1 = bottom, where there are several.
    stars: Vec<usize>,
    /// Of a doubt only the words and the code count.
    refusal: Refusal,
}

impl VerdictLine {
    fn reason(&self) -> String {
        of_stars(&self.stars, &self.refusal.found)
    }

    fn refusal(&self) -> Refusal {
        let key = self.stars.first().map_or(self.refusal.key, |star| self.refusal.key.of_star(*star));
        Refusal { key, found: self.reason(), ..self.refusal.clone() }
    }
}

/// The findings of a verdict.
#[derive(Debug, Default)]
struct VerdictLines {
    findings: Vec<VerdictLine>,
    /// How many stars they name; 1 if all are equal, and none is named.
    stars: usize,
    /// Whether the lowest or the highest star lets the object in.
    enters: bool,
}

impl VerdictLines {
    fn new(spec: &Spec, load: &Load, prediction: &Prediction) -> Self {
        let stars = &prediction.stars[..];
        // Equal stars are judged together.
        let groups = groups_of_equals(stars);
        let lets_in = |star: &StarPrediction| {
            load.object_radius.is_some_and(|widest| widest.0 <= star.hole_radius_mm + ROUNDING)
        };
        let enters = [stars.first(), stars.last()].into_iter().flatten().any(lets_in);
        let mut judged =
            Self { stars: if groups.len() > 1 { stars.len() } else { 1 }, enters, ..Self::default() };
        for (star, numbers) in groups {
            judged.star(spec, load, star, &numbers);
        }
        if load.object_radius.is_some() && !judged.is_refuted() {
            judged.mass(load, stars, prediction.payload());
        }
        if let Some(stand) = Stand::new(spec) {
            stand.doubts().into_iter().for_each(|text| judged.doubt(&[], text));
        }
        judged
    }

    fn has_weight(&self, weight: LineWeight) -> bool {
        self.findings.iter().any(|finding| finding.weight == weight)
    }

    /// Whether no star holds the object.
    fn is_idle(&self) -> bool {
        let idle = self.findings.iter().filter(|finding| finding.weight == LineWeight::Idle);
        idle.map(|finding| finding.stars.len().max(1)).sum::<usize>() == self.stars
    }

    fn is_refuted(&self) -> bool {
        self.has_weight(LineWeight::Refuted) || self.is_idle()
    }

    /// Whether the gripper holds the object.
    fn answer(&self) -> Holds {
        match (
            self.is_refuted(),
            self.has_weight(LineWeight::Doubted) || self.has_weight(LineWeight::Unknown),
        ) {
            (true, _) => Holds::No,
            (_, true) => Holds::Unknown,
            _ => Holds::Yes,
        }
    }

    /// The code of the decisive finding.
    fn code(&self) -> Option<&'static str> {
        let decides = if self.is_refuted() {
            [LineWeight::Refuted, LineWeight::Idle]
        } else {
            [LineWeight::Unknown, LineWeight::Doubted]
        };
        let of_weight = |weight| self.findings.iter().find(|finding| finding.weight == weight);
        decides.into_iter().find_map(of_weight).map(|finding| finding.refusal.code.as_str())
    }

    fn add(&mut self, weight: LineWeight, stars: &[usize], refusal: Refusal) {
        let equal =
            self.findings.iter_mut().find(|finding| finding.weight == weight && finding.refusal == refusal);
        match equal {
            Some(finding) => {
                finding.stars.extend(stars);
                finding.stars.sort_unstable();
            }
            None => self.findings.push(VerdictLine { weight, stars: stars.to_vec(), refusal }),
        }
    }

    /// Adds a doubt; its key and remedy are never read.
    fn doubt(&mut self, stars: &[usize], text: String) {
        let code = RefusalCode::MayNotHold;
        self.add(LineWeight::Doubted, stars, Refusal::new(key::load::MASS, code, text, String::new()));
    }

    /// Adds the findings about `star` and those that equal it, `group` by number. They are named where other stars differ.
    fn star(&mut self, spec: &Spec, load: &Load, star: &StarPrediction, group: &[usize]) {
        let numbers = if self.stars > 1 { group } else { &[] };
        if let Some(refusal) = bursts(load, star) {
            self.add(LineWeight::Refuted, numbers, refusal);
        }
        if let Some(reason) = may_burst(star) {
            self.doubt(numbers, reason);
        }
        if let Some(refusal) = outside_models(spec, load, star) {
            return self.add(LineWeight::Unknown, numbers, refusal);
        }
        let Some(object) = star.object_radius_mm else { return };
        if let Some(refusal) =
            spec.stars.get(group[0] - 1).and_then(|part| too_wide_to_enter(spec, part, star))
        {
            return self.blocks(numbers, refusal);
        }
        if let Some(refusal) = size_refusal(load, star, object) {
            return self.add(LineWeight::Idle, numbers, refusal);
        }
        for reason in doubts(load, star, object) {
            self.doubt(numbers, reason);
        }
        // A flap that folds at once adds nothing: only the tube's own force is sure.
        if let Some((Force(limit), range)) = load.largest_force.zip(star.ranges.object_force_N)
            && range[0] > limit
        {
            self.add(LineWeight::Refuted, numbers, too_hard(range, limit));
        }
    }

    /// Stars whose holes stop the object on the way to its place. Those before them may hold it where it stops.
    fn blocks(&mut self, numbers: &[usize], refusal: Refusal) {
        let weight = if self.enters { LineWeight::Idle } else { LineWeight::Refuted };
        self.add(weight, numbers, refusal);
        if self.enters {
            let text = "it stops there, so where other stars hold it, and how hard, is unknown";
            self.doubt(numbers, text.to_owned());
        }
    }

    /// Compares the mass with `payload`, and names what limits that: friction, the object's slope, or the arms.
    fn mass(&mut self, load: &Load, stars: &[StarPrediction], payload: StackPayload) {
        // The least friction needs the largest force.
        let ends = load.friction_range().map(|range| range.map(|friction| required_force(load, friction)));
        let ends = ends.and_then(|[largest, smallest]| Some([smallest?, largest?]));
        let carried = load.mass.map(|mass| mass.0).zip(payload.range_kg);
        let doubt = match (ends, force_range(stars), force(stars)) {
            (Some([required, _]), Some(range), _) if range[1] < required => {
                return self.add(LineWeight::Refuted, &[], too_heavy(load, range, required, payload));
            }
            (Some(_), Some(_), _) if carried.is_some_and(|(mass, [_, high])| high < mass) => {
                return self.add(LineWeight::Refuted, &[], too_heavy_for_stars(load, stars, payload));
            }
            (Some([_, required]), Some([low, _]), _) if low < required => {
                let friction = load.friction_range().map_or(0.0, |[friction, _]| friction);
                let value =
                    if load.friction == Some(friction) { String::new() } else { format!(" of {friction}") };
                let [required, low] = distinct(required, low);
                format!("friction{value} needs {required} N, but there may be only {low} N")
            }
            (Some(_), Some(_), _) if carried.is_some_and(|(mass, [low, _])| low < mass) => {
                may_be_too_heavy(load, stars, payload)
            }
            // A mass is carried by friction only.
            (None, ..) if load.mass.is_some() => {
                "[load] has a mass, but no friction: whether the gripper carries it is unknown; bare fabric has about 0.3"
                    .to_owned()
            }
            (_, None, None) if self.has_weight(LineWeight::Idle) && !self.has_weight(LineWeight::Doubted) => {
                "the force of all stars together is unknown: not each of them closes around the object".to_owned()
            }
            (_, None, Some(force)) => {
                let requirement = needed_force(load)
                    .map_or(String::new(), |required| format!(" and friction needs {required:.1} N,"));
                format!("the model's force is {force:.1} N,{requirement} but its error is unknown")
            }
            _ => return,
        };
        self.doubt(&[], doubt);
    }
}

/// The reason why `star`, which the object enters, certainly does not hold it where it has the radius `object` (mm).
fn size_refusal(load: &Load, star: &StarPrediction, object: f64) -> Option<Refusal> {
    let [smallest, largest] = star.graspable_radius_mm?;
    if star.hold == Some(Grip::Beside) {
        return Some(too_short(load));
    }
    // Where the range is known, the object may lie within it.
    let [closed, _] = star.ranges.final_radius_mm.unwrap_or([smallest; 2]);
    if object < closed {
        return Some(too_thin(load, object, closed, held_sizes(star)));
    }
    (object > largest + ROUNDING).then(|| too_wide_to_open(load, object, largest, held_sizes(star)))
}

/// The doubt that `star`, whose tube presses no harder than the object bears, `bears` N, does so while its flap stays straight.
fn flap_doubt(star: &StarPrediction, bears: f64) -> Option<String> {
    let folds = star.flap_load_N_per_mm?;
    let folds = format!("which folds at {folds:.2} N per mm of contact");
    match star.ranges.flap_force_N {
        Some([_, most]) if most <= bears => None,
        Some([_, most]) => Some(format!(
            "while the flap, {folds}, stays straight, it may press with {:.1} N, but the object bears {bears} N; a smaller \
             hole_allowance in [seal] or less pressure presses less",
            tenths_up(most)
        )),
        None if star.flap_force_N.is_some_and(|force| force <= bears)
            && star.ranges.object_force_N.is_none() =>
        {
            None
        }
        None => Some(format!("how hard it presses while the flap, {folds}, stays straight is unknown")),
    }
}

/// The reasons why it is not certain that a star holds the object of radius `object` (mm).
fn doubts(load: &Load, star: &StarPrediction, object: f64) -> Vec<String> {
    let mut reasons = Vec::new();
    if star.graspable_radius_mm.is_none() {
        reasons.push(star.evidence.choice.clone());
        return reasons;
    }
    if let Some([_, high]) = star.ranges.final_radius_mm.filter(|[_, high]| object < *high) {
        let diameter = tenths_up(2.0 * high);
        reasons.push(format!("it may close only to {diameter:.1} mm across, and not reach the object"));
    } else {
        reasons.extend(may_not_press(load, star, object));
    }
    if star.hold == Some(Grip::Untried) {
        reasons.push("the force on the object is unknown".to_owned());
    }
    match (load.largest_force, star.ranges.object_force_N, star.object_force_N) {
        (Some(Force(bears)), Some([low, high]), _) if low <= bears && high > bears => {
            let high = tenths_up(high);
            reasons.push(format!("it may press with {high:.1} N, but the object bears {bears} N"));
        }
        (Some(Force(bears)), None, Some(force)) if force > bears => {
            reasons
                .push(format!("by the model it presses with {force:.1} N, but the object bears {bears} N"));
        }
        (Some(Force(bears)), _, Some(_)) => reasons.extend(flap_doubt(star, bears)),
        _ => {}
    }
    reasons
}
