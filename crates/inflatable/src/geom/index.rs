//! Finding what lies near a place among many boxes.

use static_aabb2d_index::{StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use crate::geom::Bounds;

/// Boxes in a packed R-tree: a query costs the logarithm of their number and what it finds.
#[derive(Debug)]
pub struct BoxIndex(Option<StaticAABB2DIndex<f64>>);

impl BoxIndex {
    /// The boxes, counted from 0 in this order.
    pub fn new(boxes: impl ExactSizeIterator<Item = Bounds>) -> Self {
        let mut builder = StaticAABB2DIndexBuilder::new(boxes.len());
        for Bounds { min, max } in boxes {
            let _ = builder.add(min.x, min.y, max.x, max.y);
        }
        Self(builder.build().ok())
    }

    /// Calls `see` with the number of every box that shares a point with `zone`, in an order that depends on the boxes only.
    pub fn visit(&self, zone: &Bounds, mut see: impl FnMut(usize)) {
        if let Some(tree) = &self.0 {
            tree.visit_query(zone.min.x, zone.min.y, zone.max.x, zone.max.y, &mut see);
        }
    }

    /// The numbers of the boxes that share a point with `zone`, ascending.
    pub fn overlapping(&self, zone: &Bounds) -> Vec<usize> {
        let mut found = Vec::new();
        self.visit(zone, |number| found.push(number));
        found.sort_unstable();
        found
    }
}
