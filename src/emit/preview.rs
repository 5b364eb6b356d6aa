//! A picture of one sheet for people: fabric, tube and bands to scale, and how the iron will travel.

use svg::node::element::Element;
use svg::{Document, Node};

use crate::design::{Design, PlacedStar, StarDesign};
use crate::emit::number::Decimals;
use crate::emit::stack_view::StackView;
use crate::emit::svg::{SvgPage, element};
use crate::emit::text::inert;
use crate::emit::travel_view::travel_group;
use crate::geom::{Path, Point, Vec2};
use crate::plan::Program;
use crate::spec::Spec;
use crate::units::{Duration, Readable};

/// Length of the scale bar, mm.
const SCALE_BAR: f64 = 50.0;

/// The picture of sheet number `sheet`; `programs` are the sealing programs.
pub fn preview(spec: &Spec, design: &Design, programs: &[Program], sheet: usize) -> Option<String> {
    let layout = design.sheets.iter().find(|layout| layout.index == sheet)?;
    // Two decimals are a hundredth of a millimetre: enough for the eye.
    let page = SvgPage { height: layout.height, decimals: Decimals::exactly(2) };
    let size = (layout.width.min(layout.height) / 45.0).clamp(1.5, 12.0);
    let stars: Vec<&PlacedStar> = design.on_sheet(sheet).collect();
    let title = Title { size, width: layout.width };
    let lines = title_lines(spec, design, programs, sheet);
    let block = lines.iter().map(|_| 1.5 * size).sum::<f64>() + 3.0 * size;
    // The stack stands beside the first sheet.
    let stack = (sheet == 1).then(|| StackView::new(design));
    let (beside, least) = stack.as_ref().map_or((0.0, 0.0), |view| (view.width(), view.height()));
    let block = block.max(least - layout.height);
    let mut picture = page.picture(&spec.name, layout.width + beside, layout.height + block);
    picture.append(rectangle(layout.width, layout.height, beside, block));
    if let Some(view) = &stack {
        picture.append(view.group(&page, layout.width, layout.height, size));
    }
    for star in &stars {
        picture.append(star_group(&page, design.part(star), star));
    }
    for program in programs.iter().filter(|program| program.sheet == sheet) {
        picture.append(travel_group(&page, design, program, size));
    }
    for star in stars {
        picture.append(labels(&page, design.part(star), star, size));
    }
    picture.append(title.group(&page, &lines));
    Some(format!("{picture}\n"))
}

fn rectangle(width: f64, height: f64, beside: f64, block: f64) -> Element {
    let mut group = element("g");
    group.assign("id", "sheet");
    let number = |x: f64| Decimals::exactly(2).text(x);
    for (w, h, fill) in [(width + beside, height + block, "#ffffff"), (width, height, "#f7f7f4")] {
        let mut rect = element("rect");
        rect.assign("width", number(w));
        rect.assign("height", number(h));
        rect.assign("fill", fill);
        group.append(rect);
    }
    group
}

/// Fabric, tube, bands and edges of one star.
fn star_group(page: &SvgPage, part: &StarDesign, star: &PlacedStar) -> Element {
    let data = |path: &Path| page.data(&star.placement.path(path));
    let mut group = element("g");
    group.assign("id", format!("star-{}", star.index));
    let shape = |d: String, attributes: &[(&str, &str)]| {
        let mut out = element("path");
        out.assign("d", d);
        for (name, value) in attributes {
            out.assign(*name, *value);
        }
        out
    };
    let cut = format!("{} {}", data(&part.outline.outside), data(&part.outline.hole));
    let fabric =
        [("fill", "#dfe6ee"), ("fill-rule", "evenodd"), ("stroke", "#c00000"), ("stroke-width", "0.25")];
    group.append(shape(cut, &fabric));
    let [inner, outer] = &part.realised_edges;
    let tube = format!("{} {}", data(outer), data(inner));
    group.append(shape(tube, &[("fill", "#9cc3e6"), ("fill-rule", "evenodd")]));
    let width = Decimals::exactly(3).text(part.band);
    for seam in &part.seams {
        let band = [
            ("fill", "none"),
            ("stroke", "#e8a33d"),
            ("stroke-width", width.as_str()),
            ("stroke-linejoin", "round"),
            ("stroke-linecap", "round"),
        ];
        group.append(shape(data(&seam.center_line), &band));
    }
    for (edges, dash) in [(&part.realised_edges, "none"), (&part.edges, "1 1")] {
        for edge in edges {
            let thin = [
                ("fill", "none"),
                ("stroke", "#1f4e79"),
                ("stroke-width", "0.15"),
                ("stroke-dasharray", dash),
            ];
            group.append(shape(data(edge), &thin));
        }
    }
    for hole in &part.outline.registration {
        let center = star.placement.point(hole.center);
        let mut circle = element("circle");
        circle.assign("cx", page.x(center));
        circle.assign("cy", page.y(center));
        circle.assign("r", Decimals::exactly(3).text(hole.diameter / 2.0));
        circle.assign("fill", "#ffffff");
        circle.assign("stroke", "#c00000");
        circle.assign("stroke-width", "0.25");
        group.append(circle);
    }
    group
}

/// Numbers of star, tips and corners.
fn labels(page: &SvgPage, part: &StarDesign, star: &PlacedStar, size: f64) -> Element {
    let mut group = element("g");
    group.assign("id", format!("labels-{}", star.index));
    let geometry = &part.star;
    let center = star.placement.point(Point::ORIGIN);
    group.append(page.text(center, 1.4 * size, "middle", "#202020", &format!("star {}", star.index)));
    let beneath = center - Vec2::new(0.0, 1.6 * size);
    group.append(page.text(beneath, size, "middle", "#202020", "this side up"));
    for k in 1..=geometry.n {
        let tip = Point::polar(geometry.tip_reach() - 0.5 * geometry.w, geometry.tip_ray(k));
        let corner = Point::polar(geometry.rho_0 + 0.5 * geometry.w, geometry.corner_ray(k));
        for (at, name) in [(tip, format!("tip {k}")), (corner, format!("corner {k}"))] {
            group.append(page.text(star.placement.point(at), 0.8 * size, "middle", "#1f4e79", &name));
        }
    }
    if let Some(channel) = &part.channel {
        let mouth = star.placement.point(channel.mouth_center(geometry));
        group.append(page.text(mouth, 0.8 * size, "middle", "#1f4e79", "inlet"));
    }
    group
}
/// What the title block says, a line each.
fn title_lines(spec: &Spec, design: &Design, programs: &[Program], sheet: usize) -> Vec<String> {
    let mut lines = vec![
        inert(&spec.name, 80),
        format!("sheet {sheet} of {}   scale 1:1, mm   seen from the iron's side", design.sheets.len()),
        format!("seal at {} and {}, band {}", spec.seal.temperature, spec.seal.speed, spec.seal.band),
    ];
    for placed in design.on_sheet(sheet) {
        let star = &design.part(placed).star;
        lines.push(format!(
            "star {}: n = {}, rho_0 = {} mm, W = {} mm, phi_i0 = {} deg, R_i = {} mm, R_e = {} mm, l = {} mm",
            placed.index,
            star.n,
            Readable(star.rho_0),
            Readable(star.w),
            Readable(star.phi_i.to_degrees()),
            Readable(star.r_i),
            Readable(star.r_e),
            Readable(star.l),
        ));
    }
    for program in programs.iter().filter(|program| program.sheet == sheet) {
        for (seam, order) in program.seams.iter().zip(1..) {
            lines.push(format!(
                "{order}. star {} {} loop: {:.0} mm in {}",
                seam.star,
                seam.loop_name(),
                seam.length,
                hours(Duration(seam.time))
            ));
        }
    }
    lines
}

/// A duration as hours and minutes.
fn hours(duration: Duration) -> String {
    let minutes = (duration.0 / 60.0).round();
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}

struct Title {
    size: f64,
    width: f64,
}

impl Title {
    fn group(&self, page: &SvgPage, lines: &[String]) -> Element {
        let (size, step) = (self.size, 1.5 * self.size);
        let mut group = element("g");
        group.assign("id", "title");
        // Below the sheet's lower edge: negative ordinates of its frame.
        let mut y = -step;
        for line in lines {
            group.append(page.text(
                Point::new(size, y),
                size.min(self.width / 60.0),
                "start",
                "#202020",
                line,
            ));
            y -= step;
        }
        let (from, to) = (Point::new(size, y - 0.3 * size), Point::new(size + SCALE_BAR, y - 0.3 * size));
        let mut bar = element("path");
        let tick = Vec2::new(0.0, 0.5 * size);
        bar.assign(
            "d",
            [("M", from + tick), ("L", from), ("L", to), ("L", to + tick)]
                .map(|(command, p)| format!("{command}{} {}", page.x(p), page.y(p)))
                .join(" "),
        );
        bar.assign("fill", "none");
        bar.assign("stroke", "#202020");
        bar.assign("stroke-width", "0.3");
        group.append(bar);
        group.append(page.text(to + Vec2::new(0.5 * size, 0.0), size, "start", "#202020", "50 mm"));
        group
    }
}

impl SvgPage {
    /// A document that is higher than the sheet: what lies below the sheet's lower edge is visible too.
    fn picture(&self, title: &str, width: f64, height: f64) -> Document {
        let (w, h) = (self.decimals.text(width), self.decimals.text(height));
        self.document(title, width).set("height", format!("{h}mm")).set("viewBox", format!("0 0 {w} {h}"))
    }
}
