//! Sheets: the whole design, its parts placed side by side on fabric.

use crate::design::{Frame, Refusal, RefusalCode, Refusals, Stack, StarDesign, Warning};
use crate::geom::{Bounds, Isometry, Point};
use crate::spec::{KeyPath, Machine, Sheet, Spec, key};
use crate::units::{Least, Most, Readable};

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

/// One sheet: its frame has the origin at the lower left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetLayout {
    /// Number of the sheet, from 1.
    pub index: usize,
    /// Extent along X.
    pub width: f64,
    /// Extent along Y.
    pub height: f64,
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
            .filter_map(|(s, part)| part.mask.cut_short(s.index, &part.star));
        design.warnings = warnings.collect();
        Ok(design)
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

type Placement = (usize, Isometry);

/// Places the boxes row by row, in order, on as many sheets as needed.
///
/// An extent that the spec leaves open grows with the parts: in width for as many columns as make the
/// sheet about square, in height as far as the machine reaches. On a sheet larger than that the parts stay within reach.
fn place(
    boxes: &[Bounds],
    sheet: &Sheet,
    machine: &Machine,
) -> Result<(Vec<Placement>, Vec<SheetLayout>), Refusal> {
    let (margin, gap) = (sheet.margin.0, sheet.gap.0);
    let given = |extent: Option<crate::units::Length>| extent.map_or(f64::INFINITY, |l| l.0 - 2.0 * margin);
    // A sheet that has no extent of its own ends, with its margin, where the machine does.
    let reach = |extent: Option<crate::units::Length>, area: Option<f64>| {
        area.map_or(f64::INFINITY, |area| area - if extent.is_some() { margin } else { 2.0 * margin })
    };
    let area = machine.bench.work_area;
    let sheet_room = (given(sheet.width), given(sheet.height));
    let reach = (reach(sheet.width, area.map(|(x, _)| x.0)), reach(sheet.height, area.map(|(_, y)| y.0)));
    let (max_width, max_height) = (sheet_room.0.min(reach.0), sheet_room.1.min(reach.1));
    let upright = |bounds: &Bounds| bounds.width() <= max_width && bounds.height() <= max_height;
    for bounds in boxes {
        let can_stand = upright(bounds) || sheet.turn && upright(&turned(bounds));
        if !can_stand {
            fits(key::sheet::WIDTH, bounds.width(), sheet_room.0, margin)?;
            fits(key::sheet::HEIGHT, bounds.height(), sheet_room.1, margin)?;
            within_reach(bounds, (max_width, max_height), machine)?;
        }
    }
    let columns = match sheet.width {
        Some(_) => usize::MAX,
        None => (1..=boxes.len()).find(|c| c * c >= boxes.len()).unwrap_or(1),
    };
    let mut places = Vec::with_capacity(boxes.len());
    let mut sheets: Vec<SheetLayout> = Vec::new();
    let (mut used_width, mut used_height) = (0.0_f64, 0.0_f64);
    let (mut x, mut y, mut row_height, mut in_row) = (0.0, 0.0, 0.0_f64, 0);
    for bounds in boxes {
        let ends_row = in_row == columns || x + bounds.width() > max_width;
        // A part is turned where it fits no other way, or where it then still fits into the row.
        let turn = sheet.turn
            && upright(&turned(bounds))
            && (!upright(bounds)
                || (ends_row
                    && in_row < columns
                    && x + bounds.height() <= max_width
                    && y + bounds.width() <= max_height));
        let bounds = if turn { turned(bounds) } else { *bounds };
        let (w, h) = (bounds.width(), bounds.height());
        if in_row == columns || x + w > max_width {
            (x, y, row_height, in_row) = (0.0, y + row_height + gap, 0.0, 0);
        }
        if y + h > max_height {
            sheets.push(layout(sheets.len() + 1, used_width, used_height, sheet));
            (x, y, row_height, in_row, used_width, used_height) = (0.0, 0.0, 0.0, 0, 0.0, 0.0);
        }
        let corner = Point::new(margin + x, margin + y);
        let rotation = if turn { std::f64::consts::FRAC_PI_2 } else { 0.0 };
        let shift = corner - bounds.min;
        places.push((sheets.len() + 1, Isometry { shift, ..Isometry::rotation(rotation) }));
        used_width = used_width.max(x + w);
        used_height = used_height.max(y + h);
        row_height = row_height.max(h);
        x += w + gap;
        in_row += 1;
    }
    sheets.push(layout(sheets.len() + 1, used_width, used_height, sheet));
    Ok((places, sheets))
}

/// The box turned by a quarter turn about the origin, counterclockwise.
fn turned(bounds: &Bounds) -> Bounds {
    let (min, max) = (bounds.min, bounds.max);
    Bounds { min: Point::new(-max.y, min.x), max: Point::new(-min.y, max.x) }
}

fn layout(index: usize, used_width: f64, used_height: f64, sheet: &Sheet) -> SheetLayout {
    // Whole tenths of a millimetre read well in a file and lose nothing.
    let extent = |given: Option<crate::units::Length>, used: f64| {
        given.map_or_else(|| ((used + 2.0 * sheet.margin.0) * 10.0).ceil() / 10.0, |l| l.0)
    };
    SheetLayout { index, width: extent(sheet.width, used_width), height: extent(sheet.height, used_height) }
}

fn fits(key: KeyPath, needed: f64, room: f64, margin: f64) -> Result<(), Refusal> {
    if needed <= room {
        return Ok(());
    }
    Err(Refusal::new(
        key,
        RefusalCode::SheetTooSmall,
        format!("a part needs {} mm where the margins leave {} mm", Least(needed), Most(room.max(0.0))),
        format!("{} mm are missing: at least {} mm", Least(needed - room), Least(needed + 2.0 * margin)),
    ))
}

/// Refuses a part that the iron cannot reach all of.
fn within_reach(part: &Bounds, room: (f64, f64), machine: &Machine) -> Result<(), Refusal> {
    let Some((x, y)) = machine.bench.work_area else { return Ok(()) };
    let size = |width: f64, height: f64| format!("{} x {} mm", Readable(width), Readable(height));
    let missing = (part.width() - room.0).max(part.height() - room.1);
    Err(Refusal::new(
        key::machine::PROFILE,
        RefusalCode::OutOfReach,
        format!(
            "a part with its ramps needs {}; within the margins {} reaches {}",
            size(round_up(part.width()), round_up(part.height())),
            machine.name,
            size(room.0.max(0.0), room.1.max(0.0))
        ),
        format!(
            "{} mm are missing: a smaller star, a smaller margin in [sheet], or a machine with more than {}",
            Readable(round_up(missing)),
            size(x.0, y.0)
        ),
    ))
}

/// Up to a tenth of a millimetre: what is needed is never said to be less.
fn round_up(x: f64) -> f64 {
    (x * 10.0).ceil() / 10.0
}
