//! Sheets: the whole design, its pieces placed side by side on fabric.

use std::borrow::Cow;

use crate::paper_sheet::paper_sheets;
use crate::placement::SheetLayout;
use crate::{Alignment, DrawnPieces, FlatPiece, PaperSheet, PlacedPart, Refusals, StarAssembly, Warning};
use geom::Point;
use sealed::PlacedPiece;
use spec::{Machine, ProductKind, Spec};

/// Everything that is made, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The pieces, and the data that only their product has.
    pub product: Product,
    /// The sheets.
    pub sheets: Vec<SheetLayout>,
    /// The sheets of paper with the separators for a heat press; none for an iron.
    pub papers: Vec<PaperSheet>,
    /// The warnings before it is made.
    pub warnings: Vec<Warning>,
    /// The place where one of the sheets was found again; `None`: each lies where it was laid out.
    pub alignment: Option<Alignment>,
}

/// The product of a spec.
#[derive(Clone, Debug, PartialEq)]
pub enum Product {
    /// A gripper of stars.
    Stars(Box<StarAssembly>),
    /// Pieces by a person's own drawing.
    Drawing(Box<DrawnPieces>),
}

impl Design {
    /// The design of `spec` for `machine`.
    ///
    /// # Errors
    /// Every reason for which a piece cannot be made or does not fit on a sheet.
    pub fn new(spec: &Spec, machine: &Machine) -> Result<Self, Refusals> {
        let machine = &*with_plates(spec, machine);
        let (product, sheets, warnings) = match (spec.product(), &spec.drawing) {
            (ProductKind::Drawing, Some(drawing)) => {
                let (pieces, sheets, warnings) = DrawnPieces::new(spec, drawing, machine)?;
                (Product::Drawing(Box::new(pieces)), sheets, warnings)
            }
            (ProductKind::Stars, _) | (ProductKind::Drawing, None) => {
                let (assembly, sheets, warnings) = StarAssembly::new(spec, machine)?;
                (Product::Stars(Box::new(assembly)), sheets, warnings)
            }
        };
        let design = Self { product, sheets, papers: Vec::new(), warnings, alignment: None };
        let papers = paper_sheets(spec, machine, &design)?;
        Ok(Self { papers, ..design })
    }

    /// The stars with stack and frame; `None` for another product.
    pub fn assembly(&self) -> Option<&StarAssembly> {
        match &self.product {
            Product::Stars(assembly) => Some(assembly),
            Product::Drawing(_) => None,
        }
    }

    /// The pieces by a drawing; `None` for another product.
    pub fn drawn_pieces(&self) -> Option<&DrawnPieces> {
        match &self.product {
            Product::Stars(_) => None,
            Product::Drawing(pieces) => Some(pieces),
        }
    }

    /// Every piece where it lies, by its number.
    pub fn placed(&self) -> &[PlacedPart] {
        match &self.product {
            Product::Stars(assembly) => &assembly.stars,
            Product::Drawing(drawn) => &drawn.copies,
        }
    }

    /// The design of a placed piece.
    pub fn part(&self, placed: &PlacedPart) -> FlatPiece<'_> {
        match &self.product {
            Product::Stars(assembly) => FlatPiece::Star(assembly.part(placed)),
            Product::Drawing(drawn) => FlatPiece::Drawn(&drawn.pieces[placed.distinct]),
        }
    }

    /// `placed` as pieces, in their order.
    pub fn pieces(&self, placed: &[&PlacedPart]) -> Vec<PlacedPiece<'_>> {
        let piece = |placed: &&PlacedPart| PlacedPiece {
            name: placed.name(),
            shape: self.part(placed).shape(),
            placement: placed.placement,
        };
        placed.iter().map(piece).collect()
    }

    /// The first piece of each distinct kind, in order.
    pub fn firsts(&self) -> impl Iterator<Item = &PlacedPart> {
        let placed = self.placed();
        let is_first = |i: &usize| placed[..*i].iter().all(|other| other.distinct != placed[*i].distinct);
        (0..placed.len()).filter(is_first).map(|i| &placed[i])
    }

    /// The pieces on sheet number `sheet`, beginning with the one nearest to the sheet's origin, then always the one
    /// nearest to the one before; of equals the lowest.
    pub fn nearest_first(&self, sheet: usize) -> Vec<&PlacedPart> {
        let mut remaining: Vec<(&PlacedPart, Point)> = self
            .on_sheet(sheet)
            .map(|placed| (placed, placed.placement.point(self.part(placed).middle())))
            .collect();
        let mut order = Vec::with_capacity(remaining.len());
        let mut position = Point::ORIGIN;
        while let Some(next) = (0..remaining.len())
            // Rounding must not decide between pieces that are equally far away.
            .reduce(|a, b| {
                if remaining[b].1.distance(position) < remaining[a].1.distance(position) - 1e-6 {
                    b
                } else {
                    a
                }
            })
        {
            let (placed, middle) = remaining.remove(next);
            position = middle;
            order.push(placed);
        }
        order
    }

    /// The pieces on sheet number `sheet`, in order.
    pub fn on_sheet(&self, sheet: usize) -> impl Iterator<Item = &PlacedPart> {
        self.placed().iter().filter(move |placed| placed.sheet == sheet)
    }
}

/// `machine` with the plates of the press of `spec` as the area that it reaches.
fn with_plates<'m>(spec: &Spec, machine: &'m Machine) -> Cow<'m, Machine> {
    let Some([width, depth]) = spec.press.as_ref().and_then(|press| press.plates) else {
        return Cow::Borrowed(machine);
    };
    let mut pressed = machine.clone();
    pressed.bench.work_area = Some((width, depth));
    Cow::Owned(pressed)
}
