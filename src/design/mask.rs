//! Masks: plates that leave the corners of one star free for the coating.

use crate::design::offset::offset;
use crate::design::window::{Reach, Zone};
use crate::design::{Outline, Refusal, RefusalCode, Star, Warning};
use crate::spec::{Spec, StarSpec, key};
use crate::units::Readable;
use inflatable::geom::{Isometry, Path};

/// The mask of one star, in the star's frame, for the face that the iron touches; seen from above it is
/// turned over, mirrored, for the other face. Its registration holes are the outline's.
#[derive(Clone, Debug, PartialEq)]
pub struct MaskPlate {
    /// The plate's edge: the outline grown by the border, round at its outward corners. Closed, counterclockwise.
    pub plate: Path,
    /// One window a corner, in their order. Closed, counterclockwise.
    pub windows: Vec<Path>,
    /// Reach of each window along the gripping edge from its corner's apex, mm.
    pub extent: f64,
    /// Reach without neighbouring windows, mm: more than `extent` only where the default was cut.
    pub wanted: f64,
    /// Width of the plate beyond the outline, mm.
    pub border: f64,
}

impl MaskPlate {
    /// The mask of the star that `spec` describes, cut along `outline`.
    ///
    /// An extent that the spec leaves open is W, but at least the whole hinge, and at most the reach that leaves a bridge between
    /// neighbouring windows.
    ///
    /// # Errors
    /// If the requested extent does not fit, or the windows become empty.
    pub fn new(spec: &Spec, star_spec: &StarSpec, star: &Star, outline: &Outline) -> Result<Self, Refusal> {
        let mask = &spec.mask;
        let zone = Zone::new(star, &spec.seal, mask);
        let Reach { hinge, most } = zone.reach();
        let (wanted, extent) = match mask.extent {
            Some(wanted) if wanted.0 > most => return Err(too_far(wanted.0, most)),
            Some(wanted) => (wanted.0, wanted.0),
            None => {
                let wanted = star_spec.tube_width.0.max(hinge);
                (wanted, wanted.min(most))
            }
        };
        let window = zone.window(extent)?;
        let windows = (1..=star.n).map(|k| Isometry::rotation(star.corner_ray(k)).path(&window)).collect();
        let plate = offset(&outline.outside, mask.border.0).ok_or_else(|| no_plate(mask.border.0))?;
        Ok(Self { plate, windows, extent, wanted, border: mask.border.0 })
    }

    /// A default that was cut, for the mask of star number `index`, which is `star`.
    pub(super) fn cut_short(&self, index: usize, star: &Star) -> Option<Warning> {
        if self.extent >= self.wanted {
            return None;
        }
        let hinge = Zone::hinge(star);
        let hundredths = |length: f64| Readable((length * 100.0).floor() / 100.0);
        let part = if self.extent < hinge {
            format!("less than the hinge of {} mm", hundredths(hinge))
        } else {
            format!("less than the default of {} mm", hundredths(self.wanted))
        };
        let found = format!(
            "the coating windows of star {index} reach {} mm from a corner's apex, {part}: neighbouring windows \
             leave no more room",
            hundredths(self.extent)
        );
        let remedy = format!(
            "write extent = \"{} mm\" in [mask] to accept it; fewer points or a larger inner_radius make room",
            hundredths(self.extent)
        );
        Some(Warning { key: key::mask::EXTENT, code: RefusalCode::ShortWindow, found, remedy, drawn: None })
    }

    /// The caption of every page on which the mask of star number `star` is printed.
    pub fn caption(star: usize, mirrored: bool) -> String {
        format!("MASK STAR {star}{}", if mirrored { " OTHER SIDE" } else { "" })
    }

    /// Area of one window, mm^2.
    pub fn window_area(&self) -> f64 {
        self.windows.first().map_or(0.0, Path::area)
    }

    /// Area of the plate with its windows and the registration holes of `outline` cut out, mm^2.
    pub fn area(&self, outline: &Outline) -> f64 {
        let holes: f64 = outline.registration.iter().map(super::outline::Circle::area).sum();
        self.plate.area() - self.windows.iter().map(Path::area).sum::<f64>() - holes
    }
}

fn too_far(wanted: f64, most: f64) -> Refusal {
    Refusal::new(
        key::mask::EXTENT,
        RefusalCode::LongExtent,
        format!("at {} mm neighbouring windows would leave no bridge or run past the arms", Readable(wanted)),
        format!("extent must be at most {} mm", Readable((most * 100.0).floor() / 100.0)),
    )
}

fn no_plate(border: f64) -> Refusal {
    Refusal::new(
        key::mask::BORDER,
        RefusalCode::NoPlate,
        format!("the outline cannot be grown by {} mm", Readable(border)),
        "make border smaller, or \"0 mm\" for a plate as large as the outline".to_owned(),
    )
}
