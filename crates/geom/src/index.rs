//! Search for boxes near a place among many boxes.

use static_aabb2d_index::{StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use crate::{Bounds, Point, Segment};

/// Boxes in a packed R-tree: the cost of a query is the logarithm of their number plus the number of results.
#[derive(Debug, Default)]
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
        let mut numbers = Vec::new();
        self.visit(zone, |number| numbers.push(number));
        numbers.sort_unstable();
        numbers
    }

    /// Whether `is` is true for the number of any box that shares a point with `zone`. The search stops at the first such box.
    pub fn any_overlapping(&self, zone: &Bounds, mut is: impl FnMut(usize) -> bool) -> bool {
        let mut see = |number| if is(number) { Err(()) } else { Ok(()) };
        let Bounds { min, max } = zone;
        self.0.as_ref().is_some_and(|tree| tree.visit_query(min.x, min.y, max.x, max.y, &mut see).is_err())
    }

    /// The least `distance` from `p` of the items in the boxes; infinite if there is none. No item is nearer than its box.
    pub fn least_distance(&self, p: Point, mut distance: impl FnMut(usize) -> f64) -> f64 {
        let mut shortest = f64::INFINITY;
        // Bound on the rounding of a squared distance.
        let slack = 1.0 + 1e-12;
        let mut see = |number, square: f64| {
            if square > shortest * shortest * slack {
                return Err(());
            }
            shortest = distance(number).min(shortest);
            Ok(())
        };
        if let Some(tree) = &self.0 {
            let _ = tree.visit_neighbors(p.x, p.y, &mut see);
        }
        shortest
    }
}

/// Segments, to test for many points whether a segment is near.
#[derive(Debug, Default)]
pub struct SegmentIndex {
    segments: Vec<Segment>,
    index: BoxIndex,
}

impl SegmentIndex {
    /// These segments.
    pub fn new(segments: Vec<Segment>) -> Self {
        Self { index: BoxIndex::new(segments.iter().map(Segment::bounds)), segments }
    }

    /// Whether one of them is nearer to `p` than `distance`.
    pub fn has_within(&self, p: Point, distance: f64) -> bool {
        let zone = Bounds::of_points([p]).outset(distance);
        self.index.any_overlapping(&zone, |number| self.segments[number].distance(p) < distance)
    }
}

/// Boxes that become more: those of a [`BoxIndex`], and a short list of the latest.
#[derive(Debug, Default)]
pub struct GrowingIndex {
    boxes: Vec<Bounds>,
    index: BoxIndex,
    indexed: usize,
}

impl GrowingIndex {
    /// Box number `number`.
    ///
    /// # Panics
    /// If there are not so many.
    pub fn get(&self, number: usize) -> &Bounds {
        &self.boxes[number]
    }

    /// The number of boxes.
    pub fn len(&self) -> usize {
        self.boxes.len()
    }

    /// Whether there is no box.
    pub fn is_empty(&self) -> bool {
        self.boxes.is_empty()
    }

    /// One more box.
    pub fn push(&mut self, bounds: Bounds) {
        self.boxes.push(bounds);
        if self.boxes.len() > 16 + self.indexed + self.indexed / 32 {
            self.indexed = self.boxes.len();
            self.index = BoxIndex::new(self.boxes.iter().copied());
        }
    }

    /// Only the first `count` boxes.
    pub fn truncate(&mut self, count: usize) {
        self.boxes.truncate(count);
        if count < self.indexed {
            (self.index, self.indexed) = (BoxIndex::new(self.boxes.iter().copied()), self.boxes.len());
        }
    }

    /// Whether `is` is true for the number of any box that shares a point with `zone`.
    pub fn any_overlapping(&self, zone: &Bounds, mut is: impl FnMut(usize) -> bool) -> bool {
        let latest = self.boxes.iter().enumerate().skip(self.indexed);
        latest.filter(|(_, bounds)| zone.overlaps(bounds)).any(|(number, _)| is(number))
            || self.index.any_overlapping(zone, is)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes of 1 mm along a diagonal.
    fn staircase(i: u32) -> Bounds {
        let corner = Point::new(3.0 * f64::from(i), 2.0 * f64::from(i));
        Bounds { min: corner, max: Point::new(corner.x + 1.0, corner.y + 1.0) }
    }

    #[test]
    fn the_nearest_box_is_found_as_by_looking_at_all() {
        let boxes: Vec<Bounds> = (0..100).map(staircase).collect();
        let index = BoxIndex::new(boxes.iter().copied());
        for p in
            [Point::new(-5.0, 1.0), Point::new(77.0, 41.0), Point::new(150.0, 90.0), Point::new(900.0, 0.0)]
        {
            let expected = boxes.iter().map(|bounds| bounds.distance(p)).fold(f64::INFINITY, f64::min);
            let mut calls = 0;
            let distance = index.least_distance(p, |number| {
                calls += 1;
                boxes[number].distance(p)
            });
            assert!(distance == expected && calls < 30, "{distance} is not {expected}, by {calls}");
        }
        assert_eq!(BoxIndex::default().least_distance(Point::ORIGIN, |_| 0.0), f64::INFINITY);
    }

    #[test]
    fn a_growing_index_knows_what_is_in_it() {
        let mut index = GrowingIndex::default();
        for i in 0..300 {
            assert!(!index.any_overlapping(&staircase(i), |_| true), "{i}");
            index.push(staircase(i));
            assert!(
                (0..=i)
                    .all(|known| index.any_overlapping(&staircase(known), |number| number == known as usize)),
                "{i}"
            );
        }
        index.truncate(40);
        assert!(
            index.any_overlapping(&staircase(39), |_| true)
                && !index.any_overlapping(&staircase(40), |_| true)
                && index.len() == 40
        );
        index.push(staircase(70));
        assert!(
            index.any_overlapping(&staircase(70), |number| number == 40)
                && !index.any_overlapping(&staircase(0), |_| false)
        );
    }
}
