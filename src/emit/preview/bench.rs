//! The bench below the star: the sheet with its size, the machine's origin, axes and work area, and the clamps.

use crate::emit::picture::{Anchor, Group, Text};
use crate::emit::preview::place::Places;
use crate::emit::preview::style::{
    CLAMP, CLAMP_AREA, GREY, PAGE, SHEET, Style, TEXT, WORK_AREA, arrow_head, circle, straight,
};
use design::SheetLayout;
use geom::{Bounds, Path, Point, Vec2};
use program::plan::clamp_bounds;
use program::text::{inert, shortened};
use spec::units::Readable;
use spec::{KeepOut, Machine, NAME_LENGTH};

/// The sheet's own area.
pub(super) fn sheet_box(layout: &SheetLayout) -> Bounds {
    Bounds { min: Point::ORIGIN, max: Point::new(layout.width, layout.height) }
}

/// The part of the plane that is shown: the sheet, and blank around it, by the type's size: at its lower left there are axes and sizes.
pub(super) fn view(layout: &SheetLayout, style: Style) -> Bounds {
    let Bounds { min, max } = sheet_box(layout);
    let (unit, margin) = (style.unit, 4.5 * style.unit + height_of(layout, style).width());
    Bounds { min: min - Vec2::new(margin, 5.6 * unit), max: max + Vec2::new(2.5 * unit, 2.0 * unit) }
}

/// The sheet and its sizes.
pub(super) fn sheet_group(layout: &SheetLayout, style: Style) -> Group {
    let mut group = Group::new("sheet");
    let (unit, sheet) = (style.unit, sheet_box(layout));
    group.area(vec![Path::rectangle(&sheet)], SHEET);
    group.line(Path::rectangle(&sheet), style.pen(GREY, 1.0));
    let (row, column) = (-3.2 * unit, -3.2 * unit);
    let ends = [
        (Point::new(0.0, row), Point::new(layout.width, row)),
        (Point::new(column, 0.0), Point::new(column, layout.height)),
    ];
    for (from, to) in ends {
        let direction = (to - from).normalized();
        group.line(straight(from, to), style.pen(GREY, 1.0));
        for (end, outwards) in [(from, direction * -1.0), (to, direction)] {
            group.area(vec![arrow_head(end, outwards, 0.7 * unit)], GREY);
            // From the sheet's corner to the line.
            let reach = direction.perp() * (if direction.x > 0.0 { -1.0 } else { 1.0 });
            let corner = end - reach * (3.2 * unit);
            group.line(
                straight(corner + reach * (0.6 * unit), end + reach * (0.4 * unit)),
                style.pen(GREY, 0.7),
            );
        }
    }
    let width = format!("{} mm", Readable(layout.width));
    group.text(Text::centered(Point::new(0.5 * layout.width, row - unit), unit, TEXT, width));
    group.text(height_of(layout, style));
    group
}

fn height_of(layout: &SheetLayout, style: Style) -> Text {
    let content = format!("{} mm", Readable(layout.height));
    let anchor_point = Point::new(-3.8 * style.unit, 0.5 * layout.height);
    Text { at: anchor_point, size: style.unit, anchor: Anchor::End, ink: TEXT, content }
}

/// The machine's origin with its axes, as far as it reaches, and its clamps.
pub(super) fn bench_group(machine: &Machine, window: &Bounds, style: Style, places: &mut Places) -> Group {
    let mut group = Group::new("machine");
    if let Some((x, y)) = machine.bench.work_area {
        for path in visible_sides(x.0, y.0, window) {
            places.keep_off(&path, 0.0);
            group.line(path, style.dashes(WORK_AREA, 1.5));
        }
    }
    for (_, seen) in clamps(machine, window) {
        group.area(vec![Path::rectangle(&seen)], CLAMP_AREA);
        group.line(Path::rectangle(&seen), style.pen(CLAMP, 1.2));
        places.keep_off(&Path::rectangle(&seen), 0.0);
    }
    axes(&mut group, style);
    group
}

/// The clamps' names, in them or beside them; after everything else has its place.
pub(super) fn clamp_labels(machine: &Machine, window: &Bounds, style: Style, places: &mut Places) -> Group {
    let mut group = Group::new("clamps");
    for (clamp, seen) in clamps(machine, window) {
        // The whole name where there is room for it.
        let names = [inert(&clamp.name, NAME_LENGTH), shortened(&clamp.name, 24)];
        let candidates =
            names.iter().flat_map(|words| [0.9, 0.7, 0.5].map(|share| (words, share * style.unit)));
        let texts = candidates.flat_map(|(words, size)| {
            let half = 0.5 * Text::centered(seen.min, size, CLAMP, words.clone()).width();
            let (shift_x, shift_y) = (0.5 * seen.width() + half + size, 0.5 * seen.height() + size);
            let shifts = [
                (0.0, 0.0),
                (0.0, shift_y),
                (0.0, -shift_y),
                (shift_x, 0.0),
                (-shift_x, 0.0),
                (shift_x, shift_y),
                (-shift_x, -shift_y),
            ];
            shifts.map(|(x, y)| Text::centered(seen.center() + Vec2::new(x, y), size, CLAMP, words.clone()))
        });
        let texts: Vec<Text> = texts.collect();
        if let Some(text) = places.first(texts) {
            group.text(text);
        }
    }
    group
}

fn axes(group: &mut Group, style: Style) {
    let (unit, length) = (style.unit, 6.0 * style.unit);
    for (along, name, aside) in
        [(Vec2::new(1.0, 0.0), "X", Vec2::new(0.0, -1.2)), (Vec2::new(0.0, 1.0), "Y", Vec2::new(-1.2, 0.0))]
    {
        let tip = Point::ORIGIN + along * length;
        group.line(straight(Point::ORIGIN, tip - along * (0.5 * unit)), style.pen(TEXT, 3.0));
        group.area(vec![arrow_head(tip, along, 1.1 * unit)], TEXT);
        group.text(Text::centered(tip + aside * unit, unit, TEXT, name));
    }
    let dot = circle(Point::ORIGIN, 0.45 * unit);
    group.area(vec![dot.clone()], PAGE);
    group.line(dot, style.pen(TEXT, 2.0));
    let place = Point::new(-0.6 * unit, -1.5 * unit);
    group.text(Text { at: place, size: unit, anchor: Anchor::End, ink: TEXT, content: "X0 Y0".to_owned() });
}

/// The sides of the work area that are seen.
fn visible_sides(x: f64, y: f64, window: &Bounds) -> Vec<Path> {
    let (right, top) = (x.min(window.max.x), y.min(window.max.y));
    let mut lines = Vec::new();
    if x < window.max.x {
        lines.push(straight(Point::new(x, 0.0), Point::new(x, top)));
    }
    if y < window.max.y {
        lines.push(straight(Point::new(0.0, y), Point::new(right, y)));
    }
    lines
}

/// The clamps that are seen, each with its visible part.
fn clamps<'a>(machine: &'a Machine, window: &Bounds) -> impl Iterator<Item = (&'a KeepOut, Bounds)> {
    let keep_out = machine.bench.keep_out.iter();
    keep_out.filter_map(|clamp| Some((clamp, common(&clamp_bounds(clamp), window)?)))
}

/// The intersection of two boxes; `None` if it has no area.
fn common(a: &Bounds, b: &Bounds) -> Option<Bounds> {
    let min = Point::new(a.min.x.max(b.min.x), a.min.y.max(b.min.y));
    let max = Point::new(a.max.x.min(b.max.x), a.max.y.min(b.max.y));
    (min.x < max.x && min.y < max.y).then_some(Bounds { min, max })
}
