//! The text below the picture: the design, its stars, the order of sealing, and the meaning of the colours.

use crate::emit::picture::Pen;
use crate::emit::preview::block::{Block, Swatch};
use crate::emit::preview::stack::listed;
use crate::emit::preview::style::{
    CLAMP_AREA, CUT, FABRIC, GREY, IRON, LABEL, OBJECT, RAMP, START, Style, TUBE, TWICE, WORK_AREA, band_ink,
    star_ink,
};
use crate::emit::preview::subject::Preview;
use design::{PlacedPart, StarAssembly};
use program::plan::{SeamReport, distinct_processes};
use program::text::{inert, shortened};
use spec::units::Readable;
use spec::{CutProcess, NAME_LENGTH, Seal, SealProcess};

/// Length of the scale bar, mm.
const SCALE_BAR: f64 = 50.0;

/// All blocks, in order.
pub(super) fn blocks<'a>(preview: &Preview<'a>, sheet: usize, style: Style) -> Vec<Block<'a>> {
    let assembly = preview.design.assembly();
    let mut listed_blocks = vec![design(preview, sheet)];
    listed_blocks.extend(assembly.map(|assembly| stars(assembly, sheet)));
    listed_blocks.extend([order(preview, sheet), legend(preview, sheet, style)]);
    if let Some(assembly) = assembly.filter(|_| sheet == 1) {
        listed_blocks.push(stack(preview, assembly, style));
    }
    listed_blocks.extend(preview.code.map(|code| Block::new("This spec in the page").with_code(code)));
    listed_blocks
}

fn design(preview: &Preview<'_>, sheet: usize) -> Block<'static> {
    // What is sealed and how, process by process; then the cut, the machine, its area and its origin, as far as they are known.
    // The scale bar comes last.
    let Preview { spec, machine, design, .. } = preview;
    let mut block = Block::new(inert(&spec.name, NAME_LENGTH));
    block.say(format!("sheet {sheet} of {}, seen from the iron's side, 1:1 in mm", design.sheets.len()));
    block.say(format!(
        "sealed at {} and {}, band {}",
        spec.seal.heat_in_words(),
        spec.seal.speed,
        spec.seal.band
    ));
    for process in processes(preview, sheet) {
        block.say(format!(
            "process {}: {} and {}",
            process.name,
            process.seal.heat_in_words(),
            process.seal.speed
        ));
        block.say(format!("    {}", repeats(process)));
    }
    if let Some(CutProcess { tool, speed, .. }) = spec.cut.program {
        block.say(format!("then cut at {speed} with a {}", tool.in_words()));
    }
    block.say(format!("machine: {}", shortened(&machine.name, 40)));
    if let Some((x, y)) = machine.bench.work_area {
        block.say(format!("work area {} x {} mm from X0 Y0", Readable(x.0), Readable(y.0)));
    }
    if let [x, y, z] = machine.controller.place.shift().map(Readable)
        && !machine.controller.place.is_origin()
    {
        block.say(format!("X0 Y0 here is X{x} Y{y} of the machine, the surface Z{z}"));
    }
    block.explain(Swatch::Scale(SCALE_BAR), "50 mm");
    block
}

/// The processes of the programs of `sheet` that do more than seal once by `[seal]`, each once.
fn processes<'a>(preview: &Preview<'a>, sheet: usize) -> Vec<&'a SealProcess> {
    distinct_processes(
        preview.programs.iter().filter(|program| program.sheet == sheet && !program.is_plain()),
    )
}

/// The names of the processes of all seams on `sheet`, each once, in the order of the seams.
fn band_processes<'a>(preview: &Preview<'a>, sheet: usize) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for placed in preview.design.on_sheet(sheet) {
        for seam in preview.design.part(placed).seam_lines() {
            if !names.contains(&seam.process.as_str()) {
                names.push(&seam.process);
            }
        }
    }
    names
}

/// Passes, lines and waits of a process in words.
fn repeats(process: &SealProcess) -> String {
    let Seal { passes, cool, .. } = &process.seal;
    let cool = if cool.0 > 0.0 { format!(", {cool} to cool") } else { String::new() };
    let (lines, plural) =
        (process.seal.line_count(), |count: u32, ending| if count == 1 { "" } else { ending });
    format!("{passes} pass{}, {lines} line{}{cool}", plural(*passes, "es"), plural(lines, "s"))
}

/// Every distinct star once, with the numbers of all that are like it.
fn stars(design: &StarAssembly, sheet: usize) -> Block<'static> {
    let mut block = Block::new("Stars");
    for distinct in 0..design.distinct.len() {
        let alike: Vec<&PlacedPart> =
            design.stars.iter().filter(|star| star.sheet == sheet && star.distinct == distinct).collect();
        let Some(first) = alike.first() else { continue };
        let star = &design.part(first).star;
        block.say(format!(
            "{}: {} points",
            listed(&alike.iter().map(|star| star.index).collect::<Vec<_>>()),
            star.n
        ));
        block.say(format!("    inner radius {} mm, tube {} mm wide", Readable(star.rho_0), Readable(star.w)));
        block.say(format!(
            "    tips {} deg, radius {} mm",
            Readable(star.phi_i.to_degrees()),
            Readable(star.r_i)
        ));
        block.say(format!(
            "    corners {} deg, radius {} mm",
            Readable(star.phi_e.to_degrees()),
            Readable(star.r_e)
        ));
        block.say(format!("    arms {:.1} mm long", star.l));
    }
    block
}

/// The seams of the sheet in the order of sealing, equal ones of several stars on one line.
fn order(preview: &Preview<'_>, sheet: usize) -> Block<'static> {
    // Seams of one name and length are one row with all their numbers and stars. Each row has two lines: which seam, and how
    // long it takes.
    let mut block = Block::new("Order of sealing, in each program");
    let mut rows: Vec<(Vec<usize>, Vec<usize>, &SeamReport)> = Vec::new();
    for program in preview.programs.iter().filter(|program| program.sheet == sheet) {
        for (order, seam) in (1..).zip(&program.seams) {
            let is_alike = |row: &&mut (_, _, &SeamReport)| {
                row.2.name.seam == seam.name.seam && (row.2.length - seam.length).abs() < 1e-6
            };
            match rows.iter_mut().find(is_alike) {
                Some((orders, stars, _)) => {
                    if !orders.contains(&order) {
                        orders.push(order);
                    }
                    if let Some(number) = seam.name.piece.number().filter(|number| !stars.contains(number)) {
                        stars.push(number);
                    }
                }
                None => rows.push((vec![order], seam.name.piece.number().into_iter().collect(), seam)),
            }
        }
    }
    for (orders, stars, seam) in rows {
        let orders: Vec<String> = orders.iter().map(ToString::to_string).collect();
        let per_star = if stars.len() > 1 { " each" } else { "" };
        let (side, orders) = (shortened(&seam.name.in_piece(), 24), orders.join(", "));
        block.say(match seam.name.piece.kind() {
            "star" => format!("{orders}: {side} of {}", listed(&stars)),
            kind => {
                let numbers: Vec<String> = stars.iter().map(ToString::to_string).collect();
                format!("{orders}: {side} of {kind} {}", numbers.join(", "))
            }
        });
        block.say(format!("    {:.0} mm in {}{per_star}", seam.length, hours(seam.time)));
    }
    block
}

/// A time as hours and minutes.
fn hours(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round();
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}

fn legend(preview: &Preview<'_>, sheet: usize, style: Style) -> Block<'static> {
    // First the bands, each process in its own ink, then what the tool does along them. Cuts, hinges and labels follow, and last the
    // limits of the machine. Only what is on the sheet has a row, since a row without its line would mislead; a laser's ramps
    // are called by what they do to its beam.
    let mut block = Block::new("On the sheet");
    block.explain(Swatch::Area(TUBE), "tube");
    let names = band_processes(preview, sheet);
    for name in &names {
        let ink = band_ink(preview.spec, name);
        let text = if names.len() > 1 { format!("band of process {name}") } else { "sealed band".to_owned() };
        block.explain(Swatch::Line(Pen::new(ink, 0.5 * style.unit)), text);
    }
    let mut seams =
        preview.programs.iter().filter(|program| program.sheet == sheet).flat_map(|program| &program.seams);
    if seams.any(|seam| seam.overlap > 0.0) {
        block.explain(Swatch::Line(style.pen(TWICE, 2.5)), "sealed twice");
    }
    let is_laser = preview.machine.controller.laser.is_some();
    block.explain(
        Swatch::Line(style.pen(RAMP, 2.0)),
        if is_laser { "laser off" } else { "iron goes down or up" },
    );
    block.explain(Swatch::Dot(START), "start, with its order");
    block.explain(Swatch::Area(FABRIC), "flap");
    block.explain(Swatch::Line(style.pen(CUT, 1.0)), "cut, registration holes");
    let is_star = preview.design.assembly().is_some();
    let line_name = if is_star { "hinge as drawn" } else { "edge as drawn" };
    block.explain(Swatch::Line(style.dashes(LABEL, 0.5)), line_name);
    if is_star {
        block.say("T tip, C corner");
    }
    if preview.machine.bench.work_area.is_some() {
        block.explain(Swatch::Line(style.dashes(WORK_AREA, 1.5)), "end of the work area");
    }
    if !preview.machine.bench.keep_out.is_empty() {
        block.explain(Swatch::Area(CLAMP_AREA), "clamp");
    }
    block
}

fn stack(preview: &Preview<'_>, design: &StarAssembly, style: Style) -> Block<'static> {
    let Preview { spec, shut, .. } = preview;
    let mut block = Block::new(format!("Stack, {:.1} mm high", design.stack.height));
    block
        .explain(Swatch::Line(style.pen(star_ink(1), if shut.is_empty() { 2.0 } else { 1.2 })), "star, flat");
    let object = spec.load.as_ref().and_then(|load| load.object_radius);
    if let Some(first) = shut.first() {
        let is_on_object = object.is_some_and(|object| object.0 >= first.inner_radius * (1.0 - 1e-9));
        let suffix = if is_on_object { " on the object" } else { "" };
        let mut widths: Vec<String> =
            shut.iter().map(|star| format!("{:.1}", 2.0 * star.inner_radius)).collect();
        if widths.iter().all(|width| *width == widths[0]) {
            widths.truncate(1);
        }
        block.explain(
            Swatch::Line(style.pen(star_ink(1), 2.8)),
            format!("shut{suffix}: {} mm across", widths.join(", ")),
        );
    }
    if let Some(object) = object {
        block.explain(Swatch::Area(OBJECT), format!("object, {} mm across", Readable(2.0 * object.0)));
    }
    block.explain(
        Swatch::Line(style.pen(GREY, 1.2)),
        format!("plates, {:.1} mm across", 2.0 * design.frame.radius),
    );
    block.explain(Swatch::Line(style.dashes(GREY, 1.0)), "their openings");
    block.explain(Swatch::Dot(IRON), format!("{} posts", design.frame.posts.len()));
    block
}
