//! A **preview** of one sheet: fabric, tube and bands to scale, the path of the iron, work area and clamps, and beside the first
//! sheet the stack.

mod bench;
mod block;
mod cells;
mod faults;
mod labels;
mod piece;
mod place;
mod stack;
mod style;
mod subject;
mod travel;
mod words;

use crate::emit::picture::{Group, Picture};
use crate::emit::preview::bench::{bench_group, clamp_labels, sheet_box, sheet_group, view};
use crate::emit::preview::block::flow;
use crate::emit::preview::labels::{drawn_labels, star_labels, start_labels};
use crate::emit::preview::piece::{keep_off_piece, piece_group};
use crate::emit::preview::place::Places;
use crate::emit::preview::stack::StackView;
use crate::emit::preview::style::{PAGE, Style};
use crate::emit::preview::travel::travel_group;
use design::{FlatPiece, PlacedPart, SheetLayout};
use geom::{Bounds, Path, Point};

pub use cells::{GridCell, cells};
pub use faults::{FaultMark, faults, is_faults};
pub use subject::Preview;

/// Pixels along the longer side of a PNG: a screen's width.
const SCREEN: f64 = 1920.0;

impl Preview<'_> {
    /// Sheet number `sheet` as an SVG at 1:1; `None` if there is no such sheet.
    pub fn svg(&self, sheet: usize) -> Option<String> {
        Some(self.picture(sheet)?.svg())
    }

    /// The preview as a PNG of 1920 pixels along its longer side.
    pub fn png(&self, sheet: usize) -> Option<Vec<u8>> {
        self.picture(sheet)?.png(SCREEN)
    }

    fn picture(&self, sheet: usize) -> Option<Picture> {
        let layout = self.design.sheets.iter().find(|layout| layout.index == sheet)?;
        // The stack is drawn beside the first sheet.
        let stack = StackView::new(self).filter(|_| sheet == 1);
        let size = |unit: f64| stack.as_ref().map_or((0.0, 0.0), |stack| stack.size(unit));
        let (stack_width, least_height) = size(0.0);
        let style = Style::new((layout.width + stack_width).max(layout.height).max(least_height) * 1.15);
        let sheet_view = view(layout, style);
        let blocks = words::blocks(self, sheet, style);
        let (strip, tall) = size(style.unit);
        let widest = blocks.iter().map(|block| block.width(style)).fold(0.0, f64::max);
        let width = (sheet_view.width() + strip).max(widest + 4.0 * style.unit);
        let low = sheet_view.min.y.min(sheet_view.max.y - tall);
        let mut groups = self.sheet_groups(layout, &sheet_view, style);
        groups
            .extend(stack.map(|stack| stack.group(sheet_view.max.x + 0.5 * strip, sheet_view.max.y, style)));
        let mut words = Group::new("words");
        let corner = Point::new(sheet_view.min.x + 2.0 * style.unit, low);
        let block = flow(&mut words, &blocks, corner, width - 4.0 * style.unit, style);
        groups.push(words);
        let window = Bounds {
            min: Point::new(sheet_view.min.x, low - block - 2.0 * style.unit),
            max: Point::new(sheet_view.min.x + width, sheet_view.max.y),
        };
        let mut page = Group::new("page");
        page.area(vec![Path::rectangle(&window)], PAGE);
        groups.insert(0, page);
        Some(Picture { title: self.spec.name.clone(), window, top: layout.height, groups })
    }

    /// The sheet with its pieces and their notes.
    fn sheet_groups(&self, layout: &SheetLayout, view: &Bounds, style: Style) -> Vec<Group> {
        let pieces: Vec<&PlacedPart> = self.design.on_sheet(layout.index).collect();
        // Labels stay on the sheet; around it there are sizes and axes.
        let mut places = Places::new(sheet_box(layout), 0.12 * style.unit);
        let mut groups =
            vec![sheet_group(layout, style), bench_group(self.machine, view, style, &mut places)];
        for placed in &pieces {
            let part = self.design.part(placed);
            keep_off_piece(&mut places, part, placed, self.machine.process.ramp.0);
            groups.push(piece_group(self.spec, part, placed, style));
        }
        let mut starts = Vec::new();
        for program in self.programs.iter().filter(|program| program.sheet == layout.index) {
            let (group, travel_starts) = travel_group(self.design, program, style, &mut places);
            groups.push(group);
            starts.extend(travel_starts);
        }
        groups.push(start_labels(&starts, style, &mut places));
        for placed in pieces {
            groups.push(match self.design.part(placed) {
                FlatPiece::Star(star) => star_labels(star, placed, style, &mut places),
                FlatPiece::Drawn(piece) => drawn_labels(piece, placed, style, &mut places),
            });
        }
        groups.push(clamp_labels(self.machine, view, style, &mut places));
        groups
    }
}
