//! Loads of the sheet along its meridian.

use crate::mechanics::hinge::section::density::Strains;
use crate::mechanics::hinge::section::potential::{jet, of_element};
use crate::mechanics::hinge::section::solve::ShapeSearch;

/// One place of the meridian. Lengths in units of W, forces per flat length in units of p W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeridianPoint {
    /// Flat distance s from the inner rim.
    pub place: f64,
    /// Distance Q from the hinge's axis.
    pub radius: f64,
    /// Height z above the rims' plane.
    pub height: f64,
    /// Slope angle, rad.
    pub angle: f64,
    /// Strain along the meridian.
    pub stretch: f64,
    /// Strain around the axis.
    pub hoop_stretch: f64,
    /// Tension along the meridian.
    pub tension: f64,
    /// Tension around the axis; below 0 it is compressed.
    pub hoop_tension: f64,
}

/// A hinge's meridian at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Meridian {
    /// Coiling factor.
    pub lambda: f64,
    /// From the inner to the outer rim.
    pub points: Vec<MeridianPoint>,
    /// Volume under both sheets per flat angle, in units of W^3.
    pub volume: f64,
}

impl Meridian {
    pub(super) fn new(search: &ShapeSearch) -> Self {
        let ShapeSearch { scales, mesh, lambda, shape, .. } = search;
        let mut points = Vec::new();
        let mut volume = 0.0;
        for (number, element) in mesh.elements.iter().enumerate() {
            for point in element {
                let jet_here = jet(point, of_element(shape, number));
                let [radius, slope, _, height, ..] = jet_here;
                let strains = Strains::new(scales, point.radius, *lambda, &jet_here);
                volume += 2.0 * lambda * point.area / point.radius * radius * height * slope;
                points.push(MeridianPoint {
                    place: point.place,
                    radius,
                    height,
                    angle: libm::atan2(strains.sin, strains.cos),
                    stretch: strains.e_s,
                    hoop_stretch: strains.e_th,
                    tension: strains.n_s,
                    hoop_tension: strains.n_th,
                });
            }
        }
        Self { lambda: *lambda, points, volume }
    }

    /// The largest of one quantity.
    pub fn largest(&self, quantity: impl Fn(&MeridianPoint) -> f64) -> f64 {
        self.points.iter().map(quantity).fold(f64::NEG_INFINITY, f64::max)
    }
}
