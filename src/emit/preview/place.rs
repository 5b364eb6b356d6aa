//! Places of labels: the first one where a label covers nothing.

use crate::emit::picture::Text;
use geom::{Bounds, GrowingIndex, Path, Segment, box_distance};

/// The obstacles of labels, and the places that labels have taken.
pub(super) struct Places {
    /// The area in which labels must stay.
    window: Bounds,
    /// Blank left around each, mm.
    blank: f64,
    /// Lines and half their widths.
    lines: Vec<(Segment, f64)>,
    around_lines: GrowingIndex,
    boxes: GrowingIndex,
    /// The last obstacles found, the latest first: mostly the same one obstructs the next place, too, and is found without a
    /// search.
    recent: Vec<LabelBlock>,
    /// Number of places tried.
    tries: usize,
}

/// A line or a box, by its number.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LabelBlock {
    Line(usize),
    Box(usize),
}

/// Number of recent obstacles tried before the search: more take as long as it does.
const RECENT: usize = 8;

impl Places {
    pub(super) fn new(window: Bounds, blank: f64) -> Self {
        Self {
            window,
            blank,
            lines: Vec::new(),
            around_lines: GrowingIndex::default(),
            boxes: GrowingIndex::default(),
            recent: Vec::with_capacity(RECENT + 1),
            tries: 0,
        }
    }

    /// Labels keep off a line along `path` that is `width` wide.
    pub(super) fn keep_off(&mut self, path: &Path, width: f64) {
        let half = width / 2.0;
        for segment in &path.segments {
            self.lines.push((*segment, half));
            self.around_lines.push(segment.bounds().outset(half));
        }
    }

    /// Labels keep off a box.
    pub(super) fn keep_off_box(&mut self, bounds: Bounds) {
        self.boxes.push(bounds);
    }

    /// Number of places tried.
    pub(super) fn tried_places(&self) -> usize {
        self.tries
    }

    /// Whether the place is free.
    pub(super) fn is_free(&mut self, bounds: &Bounds) -> bool {
        self.tries += 1;
        let room = bounds.outset(self.blank);
        if !self.window.contains(bounds.min) || !self.window.contains(bounds.max) {
            return false;
        }
        let recent_place = self.recent.iter().position(|obstacle| self.is_in(*obstacle, &room));
        if let Some(place) = recent_place {
            self.recent[..=place].rotate_right(1);
            return false;
        }
        let Some(obstacle) = self.obstacle(&room) else { return true };
        self.recent.insert(0, obstacle);
        self.recent.truncate(RECENT);
        false
    }

    /// Something that reaches into `room`.
    fn obstacle(&self, room: &Bounds) -> Option<LabelBlock> {
        let mut reaching = None;
        let mut is = |obstacle| {
            let is_in = self.is_in(obstacle, room);
            reaching = is_in.then_some(obstacle);
            is_in
        };
        let _ = self.boxes.any_overlapping(room, |number| is(LabelBlock::Box(number)))
            || self.around_lines.any_overlapping(room, |number| is(LabelBlock::Line(number)));
        reaching
    }

    /// Whether `obstacle` reaches into `room`.
    fn is_in(&self, obstacle: LabelBlock, room: &Bounds) -> bool {
        match obstacle {
            LabelBlock::Box(number) => self.boxes.get(number).overlaps(room),
            LabelBlock::Line(number) => {
                let (segment, half) = &self.lines[number];
                self.around_lines.get(number).overlaps(room) && box_distance(room, segment) <= *half
            }
        }
    }

    /// Whether a line along `path` crosses no label.
    pub(super) fn is_clear(&self, path: &Path) -> bool {
        let crosses = |segment: &Segment| {
            self.boxes.any_overlapping(&segment.bounds(), |number| {
                box_distance(self.boxes.get(number), segment) == 0.0
            })
        };
        !path.segments.iter().any(crosses)
    }

    /// The first of `texts` that covers nothing; its place is taken then.
    pub(super) fn first(&mut self, texts: impl IntoIterator<Item = Text>) -> Option<Text> {
        let text = texts.into_iter().find(|text| self.is_free(&text.bounds()))?;
        self.boxes.push(text.bounds());
        Some(text)
    }

    /// All of `labels`, each at the first of its places; `None`, and no place taken, if one of them has none.
    pub(super) fn place_all(&mut self, labels: impl IntoIterator<Item = Vec<Text>>) -> Option<Vec<Text>> {
        let box_count = self.boxes.len();
        let placed = labels.into_iter().map(|places| self.first(places)).collect();
        if Option::<Vec<Text>>::is_none(&placed) {
            self.boxes.truncate(box_count);
            self.recent
                .retain(|obstacle| !matches!(obstacle, LabelBlock::Box(number) if *number >= box_count));
        }
        placed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::picture::Colour;
    use geom::{Line, Point};

    fn label(x: f64) -> Text {
        Text::centered(Point::new(x, 0.0), 2.0, Colour(0, 0, 0), "ab")
    }

    #[test]
    fn labels_keep_off_lines_boxes_borders_and_each_other() {
        let window = Bounds { min: Point::new(-50.0, -5.0), max: Point::new(50.0, 5.0) };
        let mut places = Places::new(window, 0.1);
        places
            .keep_off(&Path::open(vec![Line::new(Point::new(0.0, -9.0), Point::new(0.0, 9.0)).into()]), 4.0);
        let width = label(0.0).width();
        assert!(width > 2.0 && width < 3.0);
        assert!(!places.is_free(&label(1.0).bounds()), "on the line");
        assert!(!places.is_free(&label(2.0 + 0.5 * width).bounds()), "no blank beside it");
        assert!(places.is_free(&label(2.2 + 0.5 * width).bounds()));
        assert!(!places.is_free(&label(50.0).bounds()), "half outside");
        assert!(places.first([label(0.0), label(10.0)]).is_some_and(|text| text.at.x == 10.0));
        assert!(places.first([label(10.0)]).is_none(), "taken");
        let line = |x: f64| Path::open(vec![Line::new(Point::new(x, -3.0), Point::new(x, 3.0)).into()]);
        assert!(!places.is_clear(&line(10.0)) && places.is_clear(&line(15.0)));
        assert!(places.place_all([vec![label(20.0)], vec![label(20.0)]]).is_none());
        assert!(places.is_free(&label(20.0).bounds()), "what was in the way is no longer there");
        assert_eq!(places.place_all([vec![label(20.0)], vec![label(30.0)]]).map(|all| all.len()), Some(2));
    }
}
