//! A **preview** of one sheet for people: fabric, tube and bands to scale, how the iron will travel, what the machine has to
//! do with it, and beside the first sheet the whole stack.

mod bench;
mod block;
mod cells;
mod labels;
mod look;
mod place;
mod stack;
mod star;
mod subject;
mod travel;
mod words;

use crate::design::{PlacedStar, SheetLayout};
use crate::emit::picture::{Group, Picture};
use crate::emit::preview::bench::{Margins, bench_group, clamp_labels, sheet_box, sheet_group};
use crate::emit::preview::block::{Block, flow};
use crate::emit::preview::labels::{star_labels, start_labels};
use crate::emit::preview::look::{Look, PAGE, rectangle};
use crate::emit::preview::place::Places;
use crate::emit::preview::stack::StackView;
use crate::emit::preview::star::{keep_off_star, star_group};
use crate::emit::preview::travel::travel_group;
use crate::geom::{Bounds, Point, Vec2};

pub use cells::{Cell, cells};
pub use subject::Preview;

/// Pixels along the longer side of a PNG: a screen's width.
const SCREEN: f64 = 1920.0;

impl Preview<'_> {
    /// Sheet number `sheet` as an SVG at 1:1; `None` if there is no such sheet.
    pub fn svg(&self, sheet: usize) -> Option<String> {
        Some(self.picture(sheet)?.svg())
    }

    /// The same picture as a PNG of 1920 pixels along its longer side.
    pub fn png(&self, sheet: usize) -> Option<Vec<u8>> {
        self.picture(sheet)?.png(SCREEN)
    }

    fn picture(&self, sheet: usize) -> Option<Picture> {
        let layout = self.design.sheets.iter().find(|layout| layout.index == sheet)?;
        // The stack stands beside the first sheet.
        let stack = (sheet == 1).then(|| StackView::new(self));
        let (beside, least) =
            stack.as_ref().map_or((0.0, 0.0), |view| (view.bare_width(), view.bare_height()));
        let look = Look::new((layout.width + beside).max(layout.height).max(least) * 1.15);
        let margins = Margins::new(layout, look);
        let around = sheet_box(layout);
        let view = Bounds {
            min: around.min - Vec2::new(margins.left, margins.below),
            max: around.max + Vec2::new(margins.right, margins.above),
        };
        let blocks = self.words(sheet, look);
        let strip = stack.as_ref().map_or(0.0, |stack| stack.width(look));
        let widest = blocks.iter().map(|block| block.width(look)).fold(0.0, f64::max);
        let width = (view.width() + strip).max(widest + 4.0 * look.unit);
        let low = stack.as_ref().map_or(view.min.y, |stack| view.min.y.min(view.max.y - stack.height(look)));
        let mut groups = self.sheet_groups(layout, &view, look);
        groups.extend(stack.map(|stack| stack.group(view.max.x + 0.5 * strip, view.max.y, look)));
        let mut said = Group::new("words");
        let at = Point::new(view.min.x + 2.0 * look.unit, low);
        let block = flow(&mut said, &blocks, at, width - 4.0 * look.unit, look);
        groups.push(said);
        let window = Bounds {
            min: Point::new(view.min.x, low - block - 2.0 * look.unit),
            max: Point::new(view.min.x + width, view.max.y),
        };
        let mut page = Group::new("page");
        page.area(vec![rectangle(&window)], PAGE);
        groups.insert(0, page);
        Some(Picture { title: self.spec.name.clone(), window, top: layout.height, groups })
    }

    /// The sheet with its stars, and what is said of them there.
    fn sheet_groups(&self, layout: &SheetLayout, view: &Bounds, look: Look) -> Vec<Group> {
        let stars: Vec<&PlacedStar> = self.design.on_sheet(layout.index).collect();
        // Labels stay on the sheet; around it there are sizes and axes.
        let mut places = Places::new(sheet_box(layout), 0.12 * look.unit);
        let mut groups = vec![sheet_group(layout, look), bench_group(self.machine, view, look, &mut places)];
        for star in &stars {
            let part = self.design.part(star);
            keep_off_star(&mut places, part, star, self.machine.process.ramp.0);
            groups.push(star_group(part, star, look));
        }
        let mut starts = Vec::new();
        for program in self.programs.iter().filter(|program| program.sheet == layout.index) {
            let (group, more) = travel_group(self.design, program, look, &mut places);
            groups.push(group);
            starts.extend(more);
        }
        groups.push(start_labels(&starts, look, &mut places));
        for star in stars {
            groups.push(star_labels(self.design.part(star), star, look, &mut places));
        }
        groups.push(clamp_labels(self.machine, view, look, &mut places));
        groups
    }

    /// What stands below.
    fn words(&self, sheet: usize, look: Look) -> Vec<Block> {
        words::blocks(self, sheet, look)
    }
}
