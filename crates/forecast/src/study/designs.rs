//! The design of each row.
//!
//! Fourteen numeric keys are written straight into the design in microseconds: most studies vary these. Every other key is written
//! into the text of the spec, which is then read again, so that it has its meaning in a spec, with every range and every
//! default that depends on it. The designs of these **slow** keys are kept if they have few combinations.

use crate::candidate::{Candidate, RefusedDesign};
use spec::study::{Axis, Block, KeyValue, with_fields};
use spec::units::{Angle, Length, LineForce, Pressure};
use spec::{KeyPath, ModelChoice, Reading, Severity, Source, Spec, key, read};
use std::sync::OnceLock;

/// Most combinations of slow keys that are kept: some megabytes.
const KEPT: usize = 16_384;

/// Puts a number, in the base unit, into a design.
type Quick = fn(&mut Candidate, f64);

/// The keys that need no reading.
const QUICK: [(KeyPath, Quick); 14] = [
    (key::star::POINTS, |point, value| point.star.points = whole_number(value)),
    (key::star::INNER_RADIUS, |point, value| point.star.inner_radius = Length(value)),
    (key::star::TUBE_WIDTH, |point, value| point.star.tube_width = Length(value)),
    (key::star::TIP_ANGLE, |point, value| point.star.tip_angle = Angle(value)),
    (key::star::TIP_RADIUS, |point, value| point.star.tip_radius = Length(value)),
    (key::star::CORNER_RADIUS, |point, value| point.star.corner_radius = Length(value)),
    (key::fabric::THICKNESS, |point, value| point.fabric.thickness = Length(value)),
    (key::fabric::YOUNG_MODULUS, |point, value| point.fabric.young_modulus = Pressure(value)),
    (key::fabric::POISSON_RATIO, |point, value| point.fabric.poisson_ratio = value),
    (key::fabric::SEAL_STRENGTH, |point, value| point.fabric.seal_strength = Some(LineForce(value))),
    (key::load::PRESSURE, |point, value| point.load.pressure = Some(Pressure(value))),
    (key::load::OBJECT_DIAMETER, |point, value| set_size(point, 0.5 * value, false)),
    (key::load::OBJECT_RADIUS, |point, value| set_size(point, value, true)),
    (key::load::FRICTION, |point, value| point.load.friction = Some(value)),
];

/// Sets the object's radius, mm, and which key gave it.
fn set_size(point: &mut Candidate, radius: f64, by_radius: bool) {
    (point.load.object_radius, point.load.by_radius) = (Some(Length(radius)), by_radius);
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the reader lets 3 to 64 pass")]
fn whole_number(value: f64) -> u32 {
    value as u32
}

/// The designs of a study.
#[derive(Debug)]
pub(super) struct Designs {
    /// A design whose keys [`Designs::set`] sets.
    pub(super) base: Candidate,
    source: Source,
    spec: Spec,
    /// The varied blocks.
    pub(super) blocks: Vec<Block>,
    pub(super) rows: usize,
    /// By block and axis.
    quick: Vec<(usize, usize, Quick)>,
    slow: Vec<(usize, usize)>,
    /// Designs of the combinations of slow keys; empty if there are none, or too many.
    kept: Vec<OnceLock<Result<Candidate, RefusedDesign>>>,
}

impl Designs {
    /// The combinations of `blocks` around `base`, the gripper of the spec `source`.
    pub(super) fn new(base: Candidate, source: Source, reading: Reading, blocks: Vec<Block>) -> Self {
        let Reading { spec, raw, .. } = reading;
        let (mut quick, mut slow) = (Vec::new(), Vec::new());
        // Which tips there are to carry an inlet depends on the points: the reader must see both.
        let mut axes = blocks.iter().flat_map(Block::axes);
        let is_tip_varied = axes.any(|axis| axis.field.key() == key::inlet::TIP);
        // So must it see which stars have a value of their own.
        let has_own = raw.has_overrides();
        for (b, block) in blocks.iter().enumerate() {
            for (l, axis) in block.axes().iter().enumerate() {
                let key: KeyPath = axis.field.key();
                let is_slow = is_tip_varied && key == key::star::POINTS
                    || has_own && key.section() == key::star::POINTS.section();
                match QUICK.iter().find(|(quick_key, _)| *quick_key == key && !is_slow) {
                    Some((_, set)) => quick.push((b, l, *set)),
                    None => slow.push((b, l)),
                }
            }
        }
        let rows = blocks.iter().map(Block::len).product();
        let mut designs = Self { base, source, spec, blocks, rows, quick, slow, kept: Vec::new() };
        let combinations =
            designs.slow_blocks().try_fold(1_usize, |all, b| all.checked_mul(designs.blocks[b].len()));
        if !designs.slow.is_empty() && combinations.is_some_and(|all| all <= KEPT) {
            designs.kept = (0..combinations.unwrap_or(0)).map(|_| OnceLock::new()).collect();
        }
        designs
    }

    /// The axes in the order of their columns.
    pub(super) fn axes(&self) -> impl Iterator<Item = (usize, &Axis)> {
        self.blocks.iter().enumerate().flat_map(|(b, block)| block.axes().iter().map(move |axis| (b, axis)))
    }

    /// Writes the index of row `row` in each block to `place`; the last block runs fastest.
    pub(super) fn place(&self, row: usize, place: &mut Vec<usize>) {
        place.clear();
        let mut stride = self.rows;
        let mut rest = row;
        for block in &self.blocks {
            stride /= block.len();
            place.push((rest / stride).min(block.len() - 1));
            rest %= stride;
        }
    }

    /// The design of row `row`.
    pub(super) fn design(&self, row: usize) -> Result<Candidate, RefusedDesign> {
        let mut place = Vec::with_capacity(self.blocks.len());
        self.place(row, &mut place);
        let mut point = self.base.clone();
        self.set(&mut point, &place).map(|()| point)
    }

    /// Makes `point`, [`Designs::base`] or the design of another place, the design at a place in each block.
    pub(super) fn set(&self, point: &mut Candidate, place: &[usize]) -> Result<(), RefusedDesign> {
        if !self.slow.is_empty() {
            *point = self.slowly(place)?;
        }
        for (b, l, set) in &self.quick {
            if let KeyValue::Number(number) = *self.blocks[*b].axes()[*l].value(place[*b]) {
                set(point, number);
            }
        }
        if point.inlet.is_some() && point.star.inlet_tip > point.star.points {
            let (tip, points) = (point.star.inlet_tip, point.star.points);
            let text = format!(
                "inlet.tip: the inlet is at tip {tip}, the star has {points} points; must be from 1 to {points}"
            );
            return Err(RefusedDesign { code: "out-of-range", text });
        }
        Ok(())
    }

    /// The design of the slow keys' combination at `place`.
    fn slowly(&self, place: &[usize]) -> Result<Candidate, RefusedDesign> {
        let number = self.slow_blocks().fold(0, |number, b| number * self.blocks[b].len() + place[b]);
        match self.kept.get(number) {
            Some(kept) => kept.get_or_init(|| self.read(place)).clone(),
            None => self.read(place),
        }
    }

    /// The blocks that have slow keys.
    fn slow_blocks(&self) -> impl Iterator<Item = usize> {
        (0..self.blocks.len()).filter(|b| self.slow.iter().any(|(slow, _)| slow == b))
    }

    /// The spec with the slow keys' values, read again.
    fn read(&self, place: &[usize]) -> Result<Candidate, RefusedDesign> {
        let values = self.slow.iter().map(|(b, l)| {
            let axis = &self.blocks[*b].axes()[*l];
            (&axis.field, axis.value(place[*b]).into_owned())
        });
        let text = with_fields(&self.source, values);
        let read = text.and_then(|text| read(&Source::new(self.source.name.as_str(), text)));
        let spec = read.map(|reading| reading.spec).map_err(|faults| {
            let mut errors = faults.list().iter().filter(|fault| fault.level == Severity::Error);
            errors.next().map_or_else(
                || RefusedDesign::unpredicted("the spec is refused".to_owned()),
                |fault| RefusedDesign {
                    code: fault.code,
                    text: format!("{}: {}", fault.message, fault.label),
                },
            )
        })?;
        Candidate::from_spec(&spec).ok_or_else(|| RefusedDesign::unpredicted("there is no star".to_owned()))
    }

    /// The models of the designs.
    pub(super) fn models(&self) -> Vec<ModelChoice> {
        let Some((_, axis)) = self.axes().find(|(_, axis)| axis.field.key() == key::accuracy::MODEL) else {
            return vec![self.base.model];
        };
        let is_varied = |(word, _): &&(&str, ModelChoice)| {
            (0..axis.len()).any(|i| *axis.value(i) == KeyValue::Word((*word).to_owned()))
        };
        ModelChoice::ALL.iter().filter(is_varied).map(|(_, model)| *model).collect()
    }

    /// A text that identifies the designs: all inputs that they depend on.
    pub(super) fn identity(&self) -> String {
        format!("{:?} {:?}", self.spec, self.blocks)
    }
}
