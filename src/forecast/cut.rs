//! Area of the fabric that a star takes: the tube, its bands and flaps, and the inlet.
//!
//! Both edges of the tube are straight lines and arcs, so the strips beyond them have closed forms; registration
//! holes and their ears are left out, and arms are taken as longer than the strips' corners need. For stars with
//! fair arms this is within 2 % of the outline that is cut.

use crate::mechanics::star::Star;
use std::f64::consts::PI;

/// What surrounds the tube; lengths in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flaps {
    /// From the tube's outer edge to the cut: band and allowance.
    pub outside: f64,
    /// From the tube's inner edge to the cut: band and hole allowance.
    pub hole: f64,
    /// Outer diameter of the inlet's hose and length of its channel.
    pub inlet: Option<(f64, f64)>,
}

/// Area inside the cut of one sheet of `star`, m^2.
pub fn cut_area(star: &Star, flaps: &Flaps) -> f64 {
    let geometry = star.geometry();
    let points = f64::from(geometry.points);
    let (tip, corner) = (star.tip().arc(), star.corner().arc());
    let (r_i, r_e, width) = (geometry.tip_radius, geometry.corner_radius, geometry.width);
    let strip = |d: f64, (convex, far): (f64, f64), (concave, near): (f64, f64)| {
        2.0 * star.arm_length() * d + convex * (far + 0.5 * d) * d + inner_corner(concave, near, d)
    };
    let outside = strip(flaps.outside, (tip, width + r_i), (corner, r_e));
    let hole = strip(flaps.hole, (corner, width + r_e), (tip, r_i));
    let channel = flaps.inlet.map_or(0.0, |(diameter, length)| {
        (0.5 * PI * diameter + 2.0 * flaps.outside) * (length - flaps.outside).max(0.0)
    });
    star.tube_area() + points * (outside + hole).max(0.0) + channel
}

/// Area that a strip of width `d` has more than along the straight lines alone, inside a concave arc of the given
/// turn and radius: where the strip is wider than the radius, its edges meet in a vertex.
fn inner_corner(turn: f64, radius: f64, d: f64) -> f64 {
    if d <= radius {
        return turn * (radius - 0.5 * d) * d;
    }
    let tan = (0.5 * turn).tan();
    tan * (2.0 * radius - d) * d - radius * radius * (tan - 0.5 * turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::StarGeometry;

    #[test]
    fn a_strip_in_a_corner_is_continuous_in_its_width() {
        let [below, above] = [0.999_999, 1.000_001].map(|d| inner_corner(1.2, 1.0, d));
        assert!((below - above).abs() < 1e-5);
        // A sharp corner of 90 deg: the strip loses a square.
        assert!((inner_corner(PI / 2.0, 0.0, 0.3) + 0.09).abs() < 1e-15);
    }

    #[test]
    fn without_flaps_it_is_the_tube() {
        let star = Star::new(StarGeometry::paper(5)).expect("feasible");
        let bare = Flaps { outside: 0.0, hole: 0.0, inlet: None };
        assert_eq!(cut_area(&star, &bare), star.tube_area());
    }

    #[test]
    fn the_papers_three_stars_weigh_about_sixty_grams() {
        let star = Star::new(StarGeometry::paper(5)).expect("feasible");
        let flaps = Flaps { outside: 0.004, hole: 0.002, inlet: None };
        // Nylon with TPU, 0.3 mm: about 0.25 to 0.3 kg/m^2.
        let mass = 3.0 * 2.0 * 0.27 * cut_area(&star, &flaps);
        assert!((0.045..0.075).contains(&mass), "{mass}");
    }
}
