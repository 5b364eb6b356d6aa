//! Mask tiles: a printed mask that is larger than the printer's bed, cut up.
//!
//! All windows stay together in the **middle**, so no joint is near one and none can be out of place. As few **tips** as possible
//! are cut off, each by a **joint** straight across its ray, behind the windows. The middle has **knobs** on the joint, which
//! lock into sockets of the tip like a jigsaw puzzle's; the straight parts lie against each other and position the tip. The
//! registration holes come with the tips and the middle that they lie in.

use geom::order::sort_by;
use std::cell::OnceCell;

use crate::joint::{JointCut, RADII};
use crate::{MaskPlate, Outline, Refusal, RefusalCode, Star, StarDesign};
use geom::{Bounds, Isometry, Path, Point, Vec2};
use spec::units::{Length, Readable, tenths_up};
use spec::{Bed, key};

/// The tiles in which the mask of one star is printed.
#[derive(Clone, Debug, PartialEq)]
pub struct MaskTiles {
    /// The whole plate if there is one, else the middle and then tips, counterclockwise.
    pub tiles: Vec<MaskTile>,
    /// The joints, open, in the star's frame.
    pub joints: Vec<Path>,
}

/// One tile of a printed mask.
#[derive(Clone, Debug, PartialEq)]
pub struct MaskTile {
    /// The edge in the star's frame, closed and counterclockwise.
    pub edge: Path,
    /// The tip that was cut off; `None` for the middle and the whole.
    pub tip: Option<u32>,
    /// The rotation about the axis to lie on the bed, rad.
    pub turn: f64,
    /// The extent on the bed, mm.
    pub size: [f64; 2],
}

/// The bounds of a path at each of [`turns`], which are compared with many beds.
struct TurnedPath {
    bounds: Vec<Bounds>,
}

impl TurnedPath {
    fn new(path: &Path) -> Self {
        Self { bounds: turns().map(|turn| Isometry::rotation(turn).path(path).bounds()).collect() }
    }

    /// The turn at which the path leaves most of the bed free; of equal ones the first.
    fn best_fit(&self, bed: Bed) -> BedFit {
        let mut best: Option<BedFit> = None;
        for (turn, bounds) in turns().zip(&self.bounds) {
            let clearance = clearance_on(bounds, bed);
            if best.as_ref().is_none_or(|fit| clearance > fit.clearance + 1e-6) {
                best = Some(BedFit { turn, size: [bounds.width(), bounds.height()], clearance });
            }
        }
        best.unwrap_or(BedFit { turn: 0.0, size: [0.0; 2], clearance: f64::NEG_INFINITY })
    }
}

/// A plate with all of its tips cut off, which does not depend on the bed.
struct Division {
    cuts: Vec<JointCut>,
    /// The middle with all windows, without any tip.
    core: TurnedPath,
    /// The edges of the tips; fewer than the cuts if one does not cut the plate.
    tips: Vec<Path>,
}

impl Division {
    fn new(cuts: Vec<JointCut>, plate: &Path) -> Self {
        let (mut core, mut tips) = (plate.clone(), Vec::new());
        for cut in &cuts {
            let Some((tip, rest)) = cut.split(&core) else { break };
            core = rest;
            tips.push(tip);
        }
        Self { cuts, core: TurnedPath::new(&core), tips }
    }
}

/// The turn at which a path fits best on a bed.
struct BedFit {
    turn: f64,
    size: [f64; 2],
    /// Width of the free strip, mm; negative if it does not fit.
    clearance: f64,
}

impl MaskTiles {
    /// The pieces of `mask`, whose star is `star`, for a printer with this `bed`; the whole without a `bed`.
    ///
    /// # Errors
    /// If the middle with all windows is too large for the bed, or a tip is.
    pub(super) fn new(star: &Star, outline: &Outline, mask: &MaskPlate, bed: Bed) -> Result<Self, LargeMask> {
        let plate = TurnedPath::new(&mask.plate);
        let fit = plate.best_fit(bed);
        if fit.clearance >= 0.0 {
            return Ok(Self::one_tile(mask, fit.turn, fit.size));
        }
        let divisions: [OnceCell<Division>; RADII.len()] = Default::default();
        let divisions = divisions.iter().zip(RADII).map(|(cell, most)| -> &Division {
            cell.get_or_init(|| {
                let cuts = (1..=star.n).filter_map(|tip| JointCut::new(star, outline, mask, tip, most));
                Division::new(cuts.collect(), &mask.plate)
            })
        });
        Self::fitted(divisions.clone(), &plate, mask, bed).map_err(|TooLarge { what, size }| LargeMask {
            what,
            size,
            bed: bed_for_all(&divisions, &plate, mask, bed),
        })
    }

    /// The mask in one piece, for any bed.
    pub(super) fn one_piece(mask: &MaskPlate) -> Self {
        let bounds = mask.plate.bounds();
        Self::one_tile(mask, 0.0, [bounds.width(), bounds.height()])
    }

    fn one_tile(mask: &MaskPlate, turn: f64, size: [f64; 2]) -> Self {
        let tile = MaskTile { edge: mask.plate.clone(), tip: None, turn, size };
        Self { tiles: vec![tile], joints: Vec::new() }
    }

    /// The pieces with the largest knobs with which all fit on `bed`, of the divisions with each largest radius.
    fn fitted<'a>(
        divisions: impl Iterator<Item = &'a Division>,
        plate: &TurnedPath,
        mask: &MaskPlate,
        bed: Bed,
    ) -> Result<Self, TooLarge> {
        // Knobs take room, too: with smaller ones the middle may fit.
        let mut large = TooLarge { what: "the plate", size: plate.best_fit(bed).size };
        for division in divisions {
            match Self::cut_up(division, mask, bed) {
                Ok(tiles) => return Ok(tiles),
                Err(found) => large = found,
            }
        }
        Err(large)
    }

    /// The middle, with the tips that the bed has room for, and the other tips as pieces of their own.
    ///
    /// The largest middle is found first; then each tip that does not stay on it is split off and gets its best place on the bed.
    fn cut_up(division: &Division, mask: &MaskPlate, bed: Bed) -> Result<Self, TooLarge> {
        let Division { cuts, core, tips } = division;
        if tips.len() < cuts.len() {
            return Err(TooLarge::new("a tip", core, bed));
        }
        let (turn, is_kept) = most_kept(core, tips, bed)
            .ok_or_else(|| TooLarge::new("the middle with all windows", core, bed))?;
        let mut divided = Self { tiles: Vec::new(), joints: Vec::new() };
        let mut middle = mask.plate.clone();
        for ((cut, edge), _) in cuts.iter().zip(tips).zip(&is_kept).filter(|(_, is_kept)| !**is_kept) {
            let fit = TurnedPath::new(edge).best_fit(bed);
            if fit.clearance < 0.0 {
                return Err(TooLarge { what: "a tip", size: fit.size });
            }
            if let Some((_, rest)) = cut.split(&middle) {
                middle = rest;
            }
            divided.joints.extend(cut.joint(&mask.plate));
            divided.tiles.push(MaskTile {
                edge: edge.clone(),
                tip: Some(cut.tip),
                turn: fit.turn,
                size: fit.size,
            });
        }
        let bounds = Isometry::rotation(turn).path(&middle).bounds();
        let size = [bounds.width(), bounds.height()];
        divided.tiles.insert(0, MaskTile { edge: middle, tip: None, turn, size });
        Ok(divided)
    }

    /// Whether the mask is more than one piece.
    pub fn are_several(&self) -> bool {
        self.tiles.len() > 1
    }
}

impl MaskTile {
    /// The pose on the bed; mirrored, for the mask of the other face, all of it is a mirror image.
    pub fn motion(&self, mirrored: bool) -> Isometry {
        let sign = if mirrored { -1.0 } else { 1.0 };
        Isometry { mirrored, ..Isometry::rotation(sign * self.turn) }
    }

    /// The point with the most room for a text around it, clear of the piece's edge and of everything cut out of it: the axis, or a point on
    /// the ray of its tip.
    pub(super) fn roomiest_point(&self, star: &Star, outline: &Outline, mask: &MaskPlate) -> Point {
        let Some(tip) = self.tip else { return Point::ORIGIN };
        let ray = Vec2::unit(star.tip_ray(tip));
        let on_ray = (0_u32..200).map(|i| Point::ORIGIN + ray * (star.tip_reach() * f64::from(i) / 200.0));
        let places = on_ray.map(|place| (self.room(place, outline, mask), place));
        // Of equal places the first.
        let roomiest = places.reduce(|best, next| if next.0 > best.0 + 1e-6 { next } else { best });
        roomiest.map_or(Point::ORIGIN, |(_, place)| place)
    }

    /// Distance of `p`, in the piece, from its edge and from everything cut out of it.
    fn room(&self, p: Point, outline: &Outline, mask: &MaskPlate) -> f64 {
        let holes = outline.registration.iter().map(|hole| hole.center.distance(p) - hole.diameter / 2.0);
        let windows = mask.windows.iter().map(|window| window.distance(p));
        let edge_distance = if self.edge.encloses(p) { self.edge.distance(p) } else { 0.0 };
        holes.chain(windows).fold(edge_distance, f64::min)
    }
}

/// Turns that are tried, rad: whole degrees up to half a turn, where a bed's rectangle begins again.
fn turns() -> impl Iterator<Item = f64> {
    (0_u32..180).map(|degrees| f64::from(degrees).to_radians())
}

/// Free room on the bed beside something of this extent, mm.
fn clearance_on(bounds: &Bounds, bed: Bed) -> f64 {
    (bed.width.0 - bounds.width()).min(bed.depth.0 - bounds.height())
}

/// The turn at which most tips can stay on the middle, and which; `None` if it does not even fit without any.
fn most_kept(core: &TurnedPath, tips: &[Path], bed: Bed) -> Option<(f64, Vec<bool>)> {
    let mut best: Option<(usize, f64, f64, Vec<bool>)> = None;
    for (turn, alone) in turns().zip(&core.bounds) {
        let mut bounds = *alone;
        if clearance_on(&bounds, bed) < 0.0 {
            continue;
        }
        let is_kept: Vec<bool> = tips
            .iter()
            .map(|tip| {
                let union = bounds.union(Isometry::rotation(turn).path(tip).bounds());
                let fits = clearance_on(&union, bed) >= 0.0;
                if fits {
                    bounds = union;
                }
                fits
            })
            .collect();
        let (count, free) = (is_kept.iter().filter(|is_kept| **is_kept).count(), clearance_on(&bounds, bed));
        let is_better = |(most, widest, ..): &(usize, f64, f64, Vec<bool>)| {
            count > *most || count == *most && free > *widest + 1e-6
        };
        if best.as_ref().is_none_or(is_better) {
            best = Some((count, free, turn, is_kept));
        }
    }
    best.map(|(_, _, turn, kept)| (turn, kept))
}

/// A piece that is larger than the bed.
struct TooLarge {
    what: &'static str,
    /// Extent of the piece where it is least too large, mm.
    size: [f64; 2],
}

impl TooLarge {
    /// The piece `name` with this `edge`, as it fits `bed` best.
    fn new(name: &'static str, edge: &TurnedPath, bed: Bed) -> Self {
        Self { what: name, size: edge.best_fit(bed).size }
    }
}

/// A mask of which a piece is larger than the bed.
pub(super) struct LargeMask {
    what: &'static str,
    /// The extent of the piece where it is least too large, mm.
    size: [f64; 2],
    /// A bed that has room for all pieces.
    bed: Bed,
}

impl LargeMask {
    /// The refusal of the bed, for the masks of `count` stars of which this is the largest. `bed` has room for all of them.
    fn refusal(&self, count: usize, bed: Bed) -> Refusal {
        let [w, h] = self.size.map(|side| Readable(tenths_up(side)));
        let [width, depth] = [bed.width, bed.depth].map(|side| Readable(side.0));
        let masks = if count > 1 { format!("the largest of {count} masks") } else { "a mask".to_owned() };
        let problem = format!("{} of {masks} takes {w} x {h} mm, in any orientation", self.what);
        let remedy = format!(
            "bed must be at least \"{width} mm x {depth} mm\" for all pieces; without bed the mask is written whole, \
             to be cut from its drawings"
        );
        Refusal::new(key::mask::BED, RefusalCode::SmallBed, problem, remedy)
    }
}

/// Divides the masks of `parts` for `bed`.
///
/// The largest plate comes first. After one that is too large the others are divided for the bed that has room for it, so that the
/// refusal names a bed for all.
///
/// # Errors
/// The masks that are too large, as one refusal.
pub(super) fn divide_masks(parts: &mut [StarDesign], bed: Bed) -> Result<(), Refusal> {
    let mut order: Vec<usize> = (0..parts.len()).collect();
    let widths: Vec<f64> = parts.iter().map(|part| part.mask.plate.bounds().width()).collect();
    sort_by(&mut order, |a, b| widths[*b].total_cmp(&widths[*a]));
    let mut roomy_bed = bed;
    let mut largest: Option<LargeMask> = None;
    for number in order {
        let part = &mut parts[number];
        match MaskTiles::new(&part.star, &part.outline, &part.mask, roomy_bed) {
            Ok(tiles) => part.tiles = tiles,
            Err(large) => {
                roomy_bed = large.bed;
                let _ = largest.get_or_insert(large);
            }
        }
    }
    largest.map_or(Ok(()), |large| Err(large.refusal(parts.len(), roomy_bed)))
}

/// A bed on which all pieces fit: `bed`, grown by each piece that is too large for it until none is, or the whole plate fits.
fn bed_for_all<'a, I: Iterator<Item = &'a Division> + Clone>(
    divisions: &I,
    plate: &TurnedPath,
    mask: &MaskPlate,
    bed: Bed,
) -> Bed {
    let mut bed = bed;
    loop {
        let plate_fit = plate.best_fit(bed);
        if plate_fit.clearance >= 0.0 {
            return bed;
        }
        let Err(TooLarge { size, .. }) = MaskTiles::fitted(divisions.clone(), plate, mask, bed) else {
            return bed;
        };
        let larger = enlarged(bed, size);
        // A plate that no joint cuts must fit as a whole, whatever rounding takes.
        bed = if larger == bed { enlarged(bed, plate_fit.size.map(|side| side + 0.1)) } else { larger };
    }
}

/// `bed`, where its sides are shorter as long as `size`, in tenths of a millimetre.
fn enlarged(bed: Bed, size: [f64; 2]) -> Bed {
    let [width, depth] = size.map(tenths_up);
    Bed { width: Length(bed.width.0.max(width)), depth: Length(bed.depth.0.max(depth)) }
}
