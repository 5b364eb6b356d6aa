//! Sheets: the whole design, its parts placed side by side on fabric.

use crate::design::object::tight;
use crate::design::placement::{SheetLayout, place};
use crate::design::{Frame, Meeting, Object, Refusals, Stack, StarDesign, Warning};
use crate::shape::{PieceName, PlacedPiece};
use crate::spec::{Machine, Spec};
use inflatable::geom::{Bounds, Isometry, Point};

/// Everything that is made, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The distinct stars.
    pub distinct: Vec<StarDesign>,
    /// Every star from bottom to top, where it lies.
    pub stars: Vec<PlacedStar>,
    /// The sheets.
    pub sheets: Vec<SheetLayout>,
    /// Heights and turns of the stars.
    pub stack: Stack,
    /// The frame around them.
    pub frame: Frame,
    /// What a person should know before making it.
    pub warnings: Vec<Warning>,
}

/// One star of the stack, on its sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedStar {
    /// Number of the star, 1 = bottom.
    pub index: usize,
    /// Which of [`Design::distinct`] it is.
    pub distinct: usize,
    /// Number of its sheet, from 1.
    pub sheet: usize,
    /// From the star's frame to the sheet's.
    pub placement: Isometry,
}

impl PlacedStar {
    /// Its name as a piece: star 2.
    pub fn name(&self) -> PieceName {
        PieceName::numbered("star", self.index)
    }
}

impl Design {
    /// The design of `spec` for `machine`.
    ///
    /// # Errors
    /// Every reason for which a star cannot be made or does not fit on a sheet.
    pub fn new(spec: &Spec, machine: &Machine) -> Result<Self, Refusals> {
        let mut distinct: Vec<StarDesign> = Vec::new();
        let mut which: Vec<usize> = Vec::new();
        let mut refusals = Refusals::new();
        for (i, star) in spec.stars.iter().enumerate() {
            let same = |other: usize| spec.stars[other].same_part(star);
            if let Some(twin) = (0..i).find(|other| same(*other)) {
                which.extend(which.get(twin).copied());
                continue;
            }
            match StarDesign::new(spec, star) {
                Ok(design) => {
                    which.push(distinct.len());
                    distinct.push(design);
                }
                Err(found) => refusals.extend(found.into_iter().map(|refusal| refusal.of_star(i + 1))),
            }
        }
        refusals.or(())?;
        let boxes: Vec<Bounds> = distinct.iter().map(|part| part.footprint(machine.process.ramp.0)).collect();
        let footprints: Vec<Bounds> = which.iter().map(|i| boxes[*i]).collect();
        let (places, sheets) = place(&footprints, &spec.sheet, machine)?;
        let stack = Stack::new(spec)?;
        let parts: Vec<&StarDesign> = which.iter().map(|i| &distinct[*i]).collect();
        let frame = Frame::new(spec, &stack, &parts)?;
        let stars = which
            .iter()
            .zip(places)
            .zip(1..)
            .map(|((&distinct, (sheet, placement)), index)| PlacedStar { index, distinct, sheet, placement })
            .collect();
        let mut design = Self { distinct, stars, sheets, stack, frame, warnings: Vec::new() };
        let warnings = design
            .firsts()
            .zip(&design.distinct)
            .flat_map(|(s, part)| {
                let hose = part.channel.and_then(|channel| channel.too_thick(s.index, &part.star));
                let loose = design.stack.loose(spec, s.index);
                [part.mask.cut_short(s.index, &part.star), hose, loose]
            })
            .flatten();
        design.warnings = warnings.chain(design.tightest(spec)).collect();
        Ok(design)
    }

    /// What each star meets of the object of `spec`, bottom first; `None` without an object.
    pub fn meetings(&self, spec: &Spec) -> Option<Vec<Meeting>> {
        let object = Object::of(spec.load.as_ref()?)?;
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

    /// `stars` as pieces, in their order.
    pub fn pieces(&self, stars: &[&PlacedStar]) -> Vec<PlacedPiece<'_>> {
        let piece = |placed: &&PlacedStar| PlacedPiece {
            name: placed.name(),
            shape: &self.part(placed).shape,
            placement: placed.placement,
        };
        stars.iter().map(piece).collect()
    }

    /// The design of a placed star.
    pub fn part(&self, star: &PlacedStar) -> &StarDesign {
        &self.distinct[star.distinct]
    }

    /// Of every distinct star the first star of the stack that is one, in order.
    pub fn firsts(&self) -> impl Iterator<Item = &PlacedStar> {
        (0..self.distinct.len()).filter_map(|i| self.stars.iter().find(|star| star.distinct == i))
    }

    /// The stars on sheet number `sheet`, beginning with the one nearest to the sheet's origin, then always the one
    /// nearest to the one before; of equals the lowest.
    pub fn nearest_first(&self, sheet: usize) -> Vec<&PlacedStar> {
        let mut left: Vec<&PlacedStar> = self.on_sheet(sheet).collect();
        let mut out = Vec::with_capacity(left.len());
        let mut here = Point::ORIGIN;
        let axis = |star: &PlacedStar| star.placement.point(Point::ORIGIN);
        while let Some(next) = (0..left.len())
            // Rounding must not decide between stars that are equally far away.
            .reduce(
                |a, b| if axis(left[b]).distance(here) < axis(left[a]).distance(here) - 1e-6 { b } else { a },
            )
        {
            let star = left.remove(next);
            here = axis(star);
            out.push(star);
        }
        out
    }

    /// The stars on sheet number `sheet`, in order.
    pub fn on_sheet(&self, sheet: usize) -> impl Iterator<Item = &PlacedStar> {
        self.stars.iter().filter(move |star| star.sheet == sheet)
    }
}
