//! The sealed margin beyond a tube's rims: a band in which both sheets are fused, and a flap of two loose sheets beyond it.
//!
//! In the plane both are as stiff as two sheets. Out of it they buckle under little, which a model that is symmetric about that plane cannot
//! show. Two laws enclose what they do.

use crate::shell::assembly::{Compression, Sheet, Supports};
use crate::shell::mesh::{MarginWidths, Meshed};

/// A margin beyond the rims, band and flap together, SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Margin {
    /// Width beyond the inner rim, m: of a star on the side of the hole. At 0 there is none.
    pub inner: f64,
    /// Width beyond the outer rim, m.
    pub outer: f64,
    /// How it bears compression.
    pub law: MarginLaw,
}

/// How a margin bears compression in its plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MarginLaw {
    /// It stays plane and bears it as tension; objects and other arms press on its edge. The stiffest that a margin can be.
    #[default]
    Plane,
    /// It buckles at once: it bears tension only, and gives way to objects and other arms. The softest.
    Slack,
}

/// Part of its stiffness that a slack margin keeps in compression: less is of no use, and lets its triangles collapse.
const LEFT: f64 = 0.01;

impl Margin {
    /// No margin: the tube alone.
    pub const NONE: Self = Self { inner: 0.0, outer: 0.0, law: MarginLaw::Plane };

    /// Widths of the margin by that of the tube.
    pub(super) fn widths(&self, w: f64) -> MarginWidths {
        MarginWidths { inner: self.inner / w, outer: self.outer / w }
    }

    /// Adds the margin of `meshed` to `sheet` and `supports`.
    pub(super) fn apply(&self, meshed: &Meshed, sheet: &mut Sheet, supports: &mut Supports) {
        if meshed.tube == meshed.mesh.triangles.len() {
            return;
        }
        let law = match self.law {
            MarginLaw::Plane => Compression::Elastic,
            MarginLaw::Slack => Compression::Wrinkled(LEFT),
        };
        sheet.set_margin(meshed.tube, law);
        supports.keep_level(&meshed.mesh, meshed.tube);
    }
}
