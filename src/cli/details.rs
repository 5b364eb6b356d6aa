//! All details of a gripper for `-v`, printed below the overview.

use std::fmt::Write;

use crate::airtight;
use crate::answer::{hours, processes_in_words, sealing_in_words};
use crate::cli::words::count_beyond;
use crate::pipeline::{Forecast, Proven};
use design::{COATING_ASSUMES, Design, DrawnPiece, DrawnPieces, FlatPiece, Plate, StarAssembly, StarDesign};
use forecast::drawn::text::text as drawn_text;
use forecast::report;
use program::plan::{Program, SeamReport};
use proof::artifact::Output;
use spec::units::Readable;
use spec::{MaskKind, Spec};

/// The details of a check.
pub(super) fn checked(forecast: &Forecast) -> String {
    let seal = airtight::report(&forecast.spec, &forecast.machine, &forecast.design);
    format!("\n{}{}{}", design(forecast), predicted(forecast), seal)
}

/// Largest number of listed notes on a drawing.
const MOST_NOTES: usize = 100;

/// The design: geometry, seams, fabric, and the realised radii of tips and corners. Of equal stars only the first is listed.
fn design(forecast: &Forecast) -> String {
    // Each distinct piece is listed with its seams, then the sheets, and the materials of a gripper or the paper of a
    // drawing. Totals come last.
    let Forecast { spec, design, programs, .. } = forecast;
    let mut text = design.drawn_pieces().map_or_else(String::new, notes);
    for placed in design.firsts() {
        let part = design.part(placed);
        match part {
            FlatPiece::Star(star) => text += &of_star(spec, placed.index, star),
            FlatPiece::Drawn(_) => {
                let mass = part.mass(&spec.fabric).map_or(String::new(), |grams| format!(", {grams:.1} g"));
                let fabric = part.fabric() / 100.0;
                let _ = writeln!(text, "{}: fabric {fabric:.0} cm2 in both sheets{mass}", placed.name());
            }
        }
        for program in programs {
            for seam in program.seams.iter().filter(|seam| seam.name.piece == placed.name()) {
                let _ = writeln!(
                    text,
                    "  {}{}: {:.1} mm of seam, {}",
                    seam.name.in_piece(),
                    made_by(program, seam),
                    seam.length,
                    hours(seam.time)
                );
            }
        }
    }
    for sheet in &design.sheets {
        let _ = writeln!(
            text,
            "sheet {}: {} x {} mm",
            sheet.index,
            Readable(sheet.width),
            Readable(sheet.height)
        );
    }
    text += &design.assembly().map_or_else(String::new, |assembly| materials(spec, assembly));
    text.extend(design.drawn_pieces().iter().flat_map(|drawn| drawn.pieces.iter().map(paper)));
    if spec.press.is_some() {
        let _ = writeln!(text, "sealed in {}", sealing_in_words(forecast));
        return text;
    }
    let time: f64 = programs.iter().map(|program| program.time).sum();
    let length: f64 = programs.iter().flat_map(|program| &program.seams).map(|seam| seam.length).sum();
    let process = processes_in_words(programs)
        .map_or_else(|| format!(" at {}", spec.seal.speed), |processes| format!(": {processes}"));
    let _ = writeln!(text, "in total {length:.1} mm of seam, {}{process}", hours(time));
    text
}

/// The process, the line and the pass of a contact, in brackets; empty where every seam is sealed once by the process of `[seal]`.
fn made_by(program: &Program, seam: &SeamReport) -> String {
    if program.is_plain() {
        return String::new();
    }
    let process = &program.processes[seam.process].process;
    let seal = &process.seal;
    format!(
        " (process {}, {}, {}, line {}, pass {})",
        process.name,
        seal.heat_in_words(),
        seal.speed,
        seam.line,
        seam.pass
    )
}

/// The notes on a drawing.
fn notes(pieces: &DrawnPieces) -> String {
    let mut lines = String::new();
    for note in pieces.notes.iter().take(MOST_NOTES) {
        let _ = writeln!(lines, "drawing: {note}");
    }
    if let Some(rest) = count_beyond(pieces.notes.len(), MOST_NOTES) {
        let _ = writeln!(lines, "drawing: and {rest} more, by --json");
    }
    lines
}

/// The separator of each copy.
fn paper(piece: &DrawnPiece) -> String {
    let Some(separator) = &piece.separator else { return String::new() };
    let (count, area) = (separator.part.pieces.len(), separator.part.area() / 100.0);
    let pieces = if count == 1 { "one piece".to_owned() } else { format!("{count} pieces") };
    format!("separator: {pieces} of paper, {area:.0} cm2, for each copy\n")
}

/// A star's geometry, and the radii of tips and corners that the iron's band realises.
fn of_star(spec: &Spec, index: usize, part: &StarDesign) -> String {
    let (tip, corner) = (part.realised_tip(), part.realised_corner());
    format!(
        "star {index}: arms {:.2} mm long\n  \
         realised radius: tips {:.2} mm (cusp {:.2} mm), corners {:.2} mm (cusp {:.2} mm)\n  \
         clear hole {:.2} mm across, fabric {:.0} cm2 in both sheets{}\n",
        part.star.l,
        tip.radius,
        tip.cusp,
        corner.radius,
        corner.cusp,
        2.0 * part.clear_radius(),
        part.fabric() / 100.0,
        FlatPiece::Star(part).mass(&spec.fabric).map_or(String::new(), |grams| format!(", {grams:.1} g")),
    )
}

/// Masks, coating and frame.
fn materials(spec: &Spec, design: &StarAssembly) -> String {
    let mut text = String::new();
    for placed in design.firsts().filter(|_| spec.mask.kind == MaskKind::Coating) {
        let part = design.part(placed);
        let [thin, thick] = part.mask.coating_um();
        let _ = writeln!(
            text,
            "mask of star {}: windows reach {:.2} mm, plate {:.0} cm2, {:.1} cm3 at {}",
            placed.index,
            part.mask.extent,
            part.mask.area(&part.outline) / 100.0,
            part.mask.area(&part.outline) * spec.mask.thickness.0 / 1000.0,
            spec.mask.thickness,
        );
        text += &printed(spec, part);
        let _ = writeln!(text, "  coating about {thin:.0} to {thick:.0} um thick");
    }
    if spec.mask.kind == MaskKind::Coating {
        let _ = writeln!(text, "  the coating's thickness assumes {COATING_ASSUMES}");
    }
    let (frame, stack) = (&design.frame, &design.stack);
    let _ = writeln!(
        text,
        "frame: {} posts of {:.2} mm, diameter {} mm, on a circle {:.2} mm across",
        frame.posts.len(),
        frame.post_length,
        Readable(frame.post_diameter),
        2.0 * (frame.radius - frame.post_diameter),
    );
    for placed in &design.stars {
        // The plates below and above it.
        let is_beside =
            |plate: &&Plate| plate.numbers.iter().any(|n| (placed.index..placed.index + 2).contains(n));
        let opening = frame.plates.iter().filter(is_beside).map(|plate| plate.opening).fold(0.0, f64::max);
        let shut = design::shut_reach(&design.part(placed).star);
        if shut <= opening {
            let _ = writeln!(
                text,
                "  note: fully closed, star {} reaches {shut:.2} mm, less than an opening of {opening:.2} mm",
                placed.index
            );
        }
    }
    for plate in &frame.plates {
        let numbers: Vec<String> = plate.numbers.iter().map(ToString::to_string).collect();
        let heights = plate.numbers.iter().map(|number| format!("{:.2}", stack.plates[number - 1]));
        let _ = writeln!(
            text,
            "  plate {}: opening {:.2} mm across, {:.0} cm2, middle at a height of {} mm",
            numbers.join(", "),
            2.0 * plate.opening,
            frame.area(plate) / 100.0,
            heights.collect::<Vec<_>>().join(", "),
        );
    }
    text
}

/// Size of a common 3-D printer's bed, mm, on both sides.
const COMMON_BED: f64 = 220.0;

/// The layout of a mask on a printer's bed.
fn printed(spec: &Spec, part: &StarDesign) -> String {
    let pieces = &part.tiles.tiles;
    let sizes: Vec<String> =
        pieces.iter().map(|piece| piece.size.map(|mm| format!("{mm:.0}")).join(" x ")).collect();
    match (spec.mask.bed, &sizes[..]) {
        (Some(bed), [one]) => format!("  printed: {one} mm, fits the bed of {} x {}\n", bed.width, bed.depth),
        (Some(_), all) => format!("  printed in {} pieces: {} mm\n", all.len(), all.join(", ")),
        (None, _) if pieces.iter().any(|piece| piece.size.iter().any(|mm| *mm > COMMON_BED)) => {
            let size_list = sizes.join(", ");
            format!(
                "  note: printed, the plate takes {size_list} mm, and many beds have {COMMON_BED} x {COMMON_BED} mm; \
                 `bed = \"220 mm x 220 mm\"` in [mask] prints it in pieces\n"
            )
        }
        (None, all) => format!("  printed: {} mm\n", all.join(", ")),
    }
}

/// The design, and its written files.
pub(super) fn built(proven: &Proven) -> String {
    let built = proven.built();
    let Forecast { machine, .. } = &built.forecast;
    let (design, predicted) = (design(&built.forecast), predicted(&built.forecast));
    let mut text =
        format!("\n{design}machine: {} ({})\n{predicted}files:\n", machine.name, machine.description);
    for (name, bytes) in built.files() {
        let output = built.artifacts.iter().find(|artifact| artifact.name == name).map(|file| &file.output);
        let pages = output.and_then(|output| pages(output, &built.forecast.design)).unwrap_or_default();
        let _ = writeln!(text, "  {name} ({} bytes{pages})", bytes.len());
    }
    text
}

/// The number of pages of a printable file.
fn pages(output: &Output, design: &Design) -> Option<String> {
    match output.paper?.pages(&output.drawing(design)?, "").len() {
        1 => Some(", 1 page".to_owned()),
        all => Some(format!(", an overview and {} pages to tape", all - 1)),
    }
}

/// The prediction, for a spec with a load.
fn predicted(forecast: &Forecast) -> String {
    let text = if let Some(drawn_forecast) = &forecast.drawn {
        let mut prediction = drawn_forecast.prediction.clone();
        prediction.evidence.warnings.clear();
        drawn_text(&forecast.spec, &prediction, true)
    } else {
        let Some(mut prediction) = forecast.prediction.clone() else { return String::new() };
        prediction.stars.iter_mut().for_each(|star| star.evidence.warnings.clear());
        report::text(&forecast.spec, &prediction, true)
    };
    // The heading already contains the name.
    let body = text.split_once('\n').map_or("", |(_, body)| body);
    format!("predicted:\n{}", body.trim_start_matches('\n'))
}
