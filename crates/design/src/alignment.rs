//! Marks on a sheet, and the motion of a sheet that was taken off and lies elsewhere now.
//!
//! Two **marks** of known place are two registration holes that lie far apart. Measured again, they give the turn and the shift of the
//! sheet; the change of their distance shows a wrong mark.

use std::fmt;

use crate::{CutEdge, Design, Drawing, Layer, Product, Shape};
use geom::{Bounds, Isometry, Path, Point};
use spec::{Marks, Spec};

/// Largest turn, rad: 2 degrees. A sheet that lies more askew is laid straight by hand.
const LARGEST_TURN: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// Largest shift of the middle of the marks, as a part of the longer side of the sheet.
const LARGEST_SHIFT: f64 = 0.05;
/// Largest change of the distance of the marks, as a part of it: more is another mark, or a wrong reading.
const LARGEST_STRETCH: f64 = 3e-3;

/// The place where a sheet lies, by its two marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// Number of the sheet, from 1.
    pub sheet: usize,
    /// The marks where they were measured, in the machine's frame.
    pub measured: [Point; 2],
    /// From the sheet's frame to the machine's.
    pub motion: Isometry,
    /// Change of the distance of the marks, mm.
    pub stretch: f64,
}

impl Alignment {
    /// Turn, shift and the error of the marks' distance in words, as the operator can check them.
    pub fn in_words(&self) -> String {
        let (turn, shift) = (self.motion.rotation.to_degrees(), self.motion.shift);
        format!(
            "sheet {}: turned by {turn:.3} deg, shifted by X {:.2} Y {:.2} mm; the marks are {:+.2} mm off their distance",
            self.sheet, shift.x, shift.y, self.stretch
        )
    }
}

/// The reason for which a sheet cannot be aligned.
#[derive(Clone, Debug, PartialEq)]
pub enum AlignmentFault {
    /// There is no sheet of this number.
    NoSheet(usize),
    /// The sheet has no two registration holes.
    NoMarks,
    /// A coordinate is not a number.
    NotFinite,
    /// The marks are this far apart, mm, and should be this far.
    Stretch(f64, f64),
    /// The sheet is turned by this angle, deg.
    Turn(f64),
    /// The sheet is shifted this far, mm; so far is allowed.
    Shift(f64, f64),
}

impl fmt::Display for AlignmentFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSheet(sheet) => write!(f, "there is no sheet {sheet}"),
            Self::NoMarks => f.write_str(
                "the sheet has no two registration holes for marks: write hole_diameter in [sheet], and build again",
            ),
            Self::NotFinite => f.write_str("a coordinate of a mark is not a number"),
            Self::Stretch(measured, right) => write!(
                f,
                "the marks are {measured:.2} mm apart, and {right:.2} mm in the design: 0.3 % may differ; look which marks they are, and measure again"
            ),
            Self::Turn(degrees) => write!(
                f,
                "the sheet is turned by {degrees:.2} deg: at most 2 deg are allowed; lay it straighter, and measure again"
            ),
            Self::Shift(distance, largest) => write!(
                f,
                "the sheet is shifted by {distance:.1} mm: at most {largest:.1} mm are allowed, 5 % of its longer side; lay it nearer to its place, and measure again"
            ),
        }
    }
}

impl Design {
    /// The marks of sheet number `sheet`: of its registration holes the two that are farthest apart, the one nearer to the origin first.
    /// `None` where it has no two.
    pub fn marks(&self, sheet: usize) -> Option<[Point; 2]> {
        let layers = Drawing::outlines(self, sheet, CutEdge::Part)?.layers;
        let holes = layers.into_iter().filter(|(layer, _)| *layer == Layer::Registration);
        let centers: Vec<Point> = holes
            .flat_map(|(_, shapes)| shapes)
            .filter_map(|shape| match shape {
                Shape::Circle { center, .. } => Some(center),
                Shape::Path(_) | Shape::Figure(_) => None,
            })
            .collect();
        let mut farthest: Option<([Point; 2], f64)> = None;
        for (first, i) in centers.iter().zip(1..) {
            for second in &centers[i..] {
                let distance = first.distance(*second);
                // Rounding must not decide between pairs that are equally far apart.
                if farthest.is_none_or(|(_, largest)| distance > largest + 1e-6) {
                    farthest = Some(([*first, *second], distance));
                }
            }
        }
        let [a, b] = farthest?.0;
        Some(if b.distance(Point::ORIGIN) < a.distance(Point::ORIGIN) - 1e-6 { [b, a] } else { [a, b] })
    }

    /// The marks at which programs of `spec` for sheet number `sheet` stop; none unless the spec asks for it.
    pub fn stops(&self, spec: &Spec, sheet: usize) -> Vec<Point> {
        match spec.machine.marks {
            Marks::Ignored => Vec::new(),
            Marks::Pause => self.marks(sheet).map_or_else(Vec::new, Vec::from),
        }
    }

    /// The motion of sheet number `sheet`, which was found again; `None` for a sheet where it was laid out.
    pub fn motion(&self, sheet: usize) -> Option<Isometry> {
        self.alignment.filter(|alignment| alignment.sheet == sheet).map(|alignment| alignment.motion)
    }

    /// The place of sheet number `sheet` whose marks were found at `measured`.
    ///
    /// # Errors
    /// If the marks are too far from where they should be, or not as far apart as they should be.
    pub fn alignment(&self, sheet: usize, measured: [Point; 2]) -> Result<Alignment, AlignmentFault> {
        let layout = self.sheets.iter().find(|layout| layout.index == sheet);
        let layout = layout.ok_or(AlignmentFault::NoSheet(sheet))?;
        let marks = self.marks(sheet).ok_or(AlignmentFault::NoMarks)?;
        if !measured.iter().all(|mark| mark.x.is_finite() && mark.y.is_finite()) {
            return Err(AlignmentFault::NotFinite);
        }
        let [way, measured_way] = [marks, measured].map(|[from, to]| to - from);
        let [length, measured_length] = [way.length(), measured_way.length()];
        let stretch = measured_length - length;
        if stretch.is_nan() || stretch.abs() > LARGEST_STRETCH * length {
            return Err(AlignmentFault::Stretch(measured_length, length));
        }
        let turn = libm::atan2(way.cross(measured_way), way.dot(measured_way));
        if turn.is_nan() || turn.abs() > LARGEST_TURN {
            return Err(AlignmentFault::Turn(turn.to_degrees()));
        }
        let [middle, measured_middle] = [marks, measured].map(|[from, to]| from.midpoint(to));
        let (shift, largest_shift) =
            (middle.distance(measured_middle), LARGEST_SHIFT * layout.width.max(layout.height));
        if shift.is_nan() || shift > largest_shift {
            return Err(AlignmentFault::Shift(shift, largest_shift));
        }
        let rotation = Isometry::rotation(turn);
        let motion = Isometry { shift: measured_middle - rotation.point(middle), ..rotation };
        Ok(Alignment { sheet, measured, motion, stretch })
    }

    /// The design with a sheet that lies as `alignment` says.
    #[must_use]
    pub fn aligned(mut self, alignment: &Alignment) -> Self {
        let placed = match &mut self.product {
            Product::Stars(assembly) => &mut assembly.stars,
            Product::Drawing(drawn) => &mut drawn.copies,
        };
        for part in placed.iter_mut().filter(|part| part.sheet == alignment.sheet) {
            part.placement = moved(&part.placement, &alignment.motion);
        }
        self.alignment = Some(*alignment);
        self
    }

    /// The rectangle around sheet number `sheet` where it lies; `None` if there is no such sheet.
    pub fn sheet_bounds(&self, sheet: usize) -> Option<Bounds> {
        let layout = self.sheets.iter().find(|layout| layout.index == sheet)?;
        let bounds = Bounds { min: Point::ORIGIN, max: Point::new(layout.width, layout.height) };
        Some(self.motion(sheet).map_or(bounds, |motion| motion.path(&Path::rectangle(&bounds)).bounds()))
    }
}

/// `placement`, followed by the unmirrored `motion`.
fn moved(placement: &Isometry, motion: &Isometry) -> Isometry {
    Isometry {
        mirrored: placement.mirrored,
        rotation: placement.rotation + motion.rotation,
        shift: motion.point(Point::ORIGIN + placement.shift) - Point::ORIGIN,
    }
}
