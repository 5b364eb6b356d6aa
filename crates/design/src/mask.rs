//! Masks: plates that leave the corners of one star free for the coating, and how thick it stays.

use crate::offset::offset;
use crate::window::{Reach, Zone};
use crate::{Outline, Refusal, RefusalCode, Star, Warning};
use geom::{Isometry, Path};
use spec::units::{Least, Readable, hundredths_down};
use spec::{Spec, StarSpec, key};

/// Least width of the plate's **rim**, the strip between its edge and the windows, mm: no tool leaves a narrower one, and the
/// chords of an STL stay within 0.02 mm of either side, so that walls of two sides never meet.
const LEAST_RIM: f64 = 0.1;

/// Rounding of a sum of lengths of a spec, mm.
const ROUNDING: f64 = 1e-9;

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
    /// If the requested extent does not fit, the windows become empty, or they reach the plate's edge.
    pub fn new(spec: &Spec, star_spec: &StarSpec, star: &Star, outline: &Outline) -> Result<Self, Refusal> {
        let mask = &spec.mask;
        let zone = Zone::new(star, &spec.seal, mask);
        let Reach { hinge, most: longest } = zone.reach();
        let (wish, extent) = match mask.extent {
            Some(wish) if wish.0 > longest => return Err(too_far(wish.0, longest)),
            Some(wish) => (wish.0, wish.0),
            None => {
                let default_extent = star_spec.tube_width.0.max(hinge);
                (default_extent, default_extent.min(longest))
            }
        };
        let window = zone.window(extent)?;
        let windows = (1..=star.n).map(|k| Isometry::rotation(star.corner_ray(k)).path(&window)).collect();
        // Outside, a window ends where the band does, less the creep; the plate's edge is `allowance` and `border` farther out.
        let rim = mask.border.0 + spec.seal.allowance.0 + mask.creep.0;
        if rim < LEAST_RIM - ROUNDING {
            return Err(thin_rim(rim, spec));
        }
        let border = mask.border.0;
        let plate = offset(&outline.outside, border).ok_or_else(|| {
            let fault = format!("the outline cannot be grown by {} mm", Readable(border));
            Refusal::new(key::mask::BORDER, RefusalCode::NoPlate, fault, "make border smaller")
        })?;
        Ok(Self { plate, windows, extent, wanted: wish, border })
    }

    /// A default that was cut, for the mask of star number `index`, which is `star`.
    pub(super) fn cut_short(&self, index: usize, star: &Star) -> Option<Warning> {
        if self.extent >= self.wanted {
            return None;
        }
        let hinge = Zone::hinge(star);
        let [extent, hinged, wish] =
            [self.extent, hinge, self.wanted].map(|length| Readable(hundredths_down(length)));
        let part = if self.extent < hinge {
            format!("less than the hinge of {hinged} mm")
        } else {
            format!("less than the default of {wish} mm")
        };
        let fault = format!(
            "the coating windows of star {index} reach {extent} mm from a corner's apex, {part}: neighbouring windows \
             leave no more room"
        );
        let remedy = format!(
            "write extent = \"{extent} mm\" in [mask] to accept it; fewer points or a larger inner_radius make room"
        );
        Some(Warning::new(key::mask::EXTENT, RefusalCode::ShortWindow, fault, remedy))
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

fn too_far(wish: f64, longest: f64) -> Refusal {
    Refusal::new(
        key::mask::EXTENT,
        RefusalCode::LongExtent,
        format!("at {} mm neighbouring windows would leave no bridge or run past the arms", Readable(wish)),
        format!("extent must be at most {} mm", Readable(hundredths_down(longest))),
    )
}

/// The refusal of a mask of `spec` whose rim is too narrow, with the border and the allowance that would be just enough if the other stayed.
fn thin_rim(rim: f64, spec: &Spec) -> Refusal {
    let [border, allowance] =
        [spec.mask.border, spec.seal.allowance].map(|width| Least(width.0 + LEAST_RIM - rim));
    let fault =
        format!("{} mm of the mask's plate stay between its edge and the coating windows", Readable(rim));
    let remedy =
        format!("border must be at least {border} mm; or alone: an allowance of at least {allowance} mm");
    Refusal::new(key::mask::BORDER, RefusalCode::ThinRim, fault, remedy)
}

/// Density of VPS-32 (Elite Double 32), kg/m^3, by its maker.
const DENSITY: f64 = 1160.0;
/// Standard gravity, m/s^2.
pub(crate) const GRAVITY: f64 = 9.806_65;
/// The time integral of the inverse viscosity until the silicone gels, 1/Pa: the range for pours from at once to
/// some minutes after mixing (mu = 7.1 Pa s exp(2.06e-3 t), Lee et al. 2016).
const FLUIDITY: [f64; 2] = [50.0, 68.0];

/// The assumptions of the thickness estimate, for reports.
pub const COATING_ASSUMES: &str = "VPS-32 of 1160 kg/m3, poured at once and drained on a vertical star, 50 to 68 /Pa until it gels (Lee et al. 2016); at the lower edge of a window of this extent";

impl MaskPlate {
    /// The drained thickness at a window's lower edge, from thin to thick, um.
    ///
    /// `sqrt(x / (rho g sin(theta) Phi))`, Lee et al. 2016, on a plane tilted by theta, at the distance x below
    /// the upper edge, here x = extent and theta = 90 degrees; Phi = ∫ dt / mu. Thickness grows like the root of x: the mean is
    /// two thirds of this. Less tilt leaves more: twice as much at 14.5 degrees.
    pub fn coating_um(&self) -> [f64; 2] {
        let x = self.extent / 1e3;
        let [thinnest, thickest] = FLUIDITY;
        [thickest, thinnest].map(|phi| 1e6 * (x / (DENSITY * GRAVITY * phi)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use geom::Path;

    use super::*;

    #[test]
    fn the_papers_coating_is_two_tenths_of_a_millimetre() {
        let plate = MaskPlate {
            plate: Path::default(),
            windows: Vec::new(),
            extent: 30.0,
            wanted: 30.0,
            border: 0.0,
        };
        let [thin, thick] = plate.coating_um();
        assert!(thin < 200.0 && 200.0 < thick, "{thin} to {thick} um, the paper has about 200");
    }
}
