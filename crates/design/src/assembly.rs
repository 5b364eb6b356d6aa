//! Stars with their stack and frame: the design of a gripper of stars.

use crate::mask_tiles::divide_masks;
use crate::object::tight;
use crate::placement::{SheetLayout, place};
use crate::{Frame, Meeting, Object, PlacedPart, Refusals, Stack, StarDesign, Warning};
use geom::Bounds;
use spec::{Machine, Spec};

/// The stars of a gripper with their stack and their frame.
#[derive(Clone, Debug, PartialEq)]
pub struct StarAssembly {
    /// The distinct stars.
    pub distinct: Vec<StarDesign>,
    /// Every star from bottom to top, where it lies.
    pub stars: Vec<PlacedPart>,
    /// Heights and turns of the stars.
    pub stack: Stack,
    /// The frame around them.
    pub frame: Frame,
}

impl StarAssembly {
    /// The kind of its pieces.
    pub(super) const KIND: &'static str = "star";

    /// The stars of `spec`, laid on sheets for `machine`, and the warnings about them.
    ///
    /// # Errors
    /// Every reason for which a star cannot be made or does not fit on a sheet.
    pub(super) fn new(
        spec: &Spec,
        machine: &Machine,
    ) -> Result<(Self, Vec<SheetLayout>, Vec<Warning>), Refusals> {
        let mut distinct: Vec<StarDesign> = Vec::new();
        let mut part_numbers: Vec<usize> = Vec::new();
        let mut refusals = Refusals::new();
        for (i, star) in spec.stars.iter().enumerate() {
            if let Some(twin) = spec.stars[..i].iter().position(|other| other.same_part(star)) {
                part_numbers.extend(part_numbers.get(twin).copied());
                continue;
            }
            match StarDesign::new(spec, star) {
                Ok(design) => {
                    part_numbers.push(distinct.len());
                    distinct.push(design);
                }
                Err(found) => refusals.extend(found.into_iter().map(|refusal| refusal.of_star(i + 1))),
            }
        }
        if let Some(bed) = spec.mask.bed {
            let _ = refusals.keep(divide_masks(&mut distinct, bed));
        }
        refusals.or_value(())?;
        let boxes: Vec<Bounds> = distinct.iter().map(|part| part.footprint(machine.process.ramp.0)).collect();
        let footprints: Vec<Bounds> = part_numbers.iter().map(|i| boxes[*i]).collect();
        let (places, sheets) = place(&footprints, &spec.sheet, machine)?;
        let stack = Stack::new(spec)?;
        let parts: Vec<&StarDesign> = part_numbers.iter().map(|i| &distinct[*i]).collect();
        let frame = Frame::new(spec, &stack, &parts)?;
        let stars = PlacedPart::place_all(Self::KIND, &part_numbers, places);
        let assembly = Self { distinct, stars, stack, frame };
        let warnings = assembly
            .firsts()
            .zip(&assembly.distinct)
            .flat_map(|(s, part)| {
                let hose = part.channel.and_then(|channel| channel.too_thick(s.index, &part.star));
                let loose = assembly.stack.loose(spec, s.index);
                [part.mask.cut_short(s.index, &part.star), hose, loose]
            })
            .flatten();
        let warnings = warnings.chain(assembly.tightest(spec)).collect();
        Ok((assembly, sheets, warnings))
    }

    /// The contact of each star with the object of `spec`, bottom first; `None` without an object.
    pub fn meetings(&self, spec: &Spec) -> Option<Vec<Meeting>> {
        let object = Object::new(spec.load.as_ref()?)?;
        let holes: Vec<f64> =
            self.stars.iter().map(|placed| self.part(placed).star.hole(&spec.seal)).collect();
        Some(object.meetings(&self.stack.stars, &holes))
    }

    /// The first star in whose hole the object has little room.
    fn tightest(&self, spec: &Spec) -> Option<Warning> {
        let meetings = self.meetings(spec)?;
        let mut stars = self.stars.iter().zip(meetings);
        stars.find_map(|(placed, meeting)| tight(spec, placed.index, &self.part(placed).star, meeting))
    }

    /// The design of a placed star.
    pub fn part(&self, star: &PlacedPart) -> &StarDesign {
        &self.distinct[star.distinct]
    }

    /// The first star of each distinct kind, in order of the stack.
    pub fn firsts(&self) -> impl Iterator<Item = &PlacedPart> {
        (0..self.distinct.len()).filter_map(|i| self.stars.iter().find(|star| star.distinct == i))
    }
}
