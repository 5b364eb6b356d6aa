//! A sealed shape: seams, cut and ports in a frame of its own.

use crate::shape::Seam;
use inflatable::geom::{Bounds, Isometry, Path, Point};

/// The opening for a hose: between the two ends of an open seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Port {
    /// The middle of its mouth.
    pub at: Point,
    /// Flat width between the bands that the hose needs, mm.
    pub width: f64,
}

/// Two equal sheets, sealed and cut.
#[derive(Clone, Debug, PartialEq)]
pub struct SealedShape {
    /// The seams in the order in which they are sealed.
    pub seams: Vec<Seam>,
    /// Width of the bands, mm.
    pub band: f64,
    /// The cut around it; `None` for a piece that the user cuts out.
    pub cut: Option<Path>,
    /// Its ports.
    pub ports: Vec<Port>,
}

impl SealedShape {
    /// The seam called `name`.
    pub fn seam(&self, name: &str) -> Option<&Seam> {
        self.seams.iter().find(|seam| seam.name == name)
    }

    /// The box of all centre lines.
    pub fn seam_bounds(&self) -> Bounds {
        self.seams.iter().map(|seam| seam.center_line.bounds()).fold(Bounds::EMPTY, Bounds::union)
    }

    /// The same shape, moved.
    #[must_use]
    pub fn moved(&self, motion: Isometry) -> Self {
        let seam = |seam: &Seam| Seam { center_line: motion.path(&seam.center_line), ..seam.clone() };
        Self {
            seams: self.seams.iter().map(seam).collect(),
            band: self.band,
            cut: self.cut.as_ref().map(|cut| motion.path(cut)),
            ports: self.ports.iter().map(|port| Port { at: motion.point(port.at), ..*port }).collect(),
        }
    }
}
