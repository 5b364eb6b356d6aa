//! The job: the content of each sheet, and the iron's steps there, from the programs themselves.

use serde_json::{Value, json};

use crate::emit::report::polyline::{hundredths, polyline};
use crate::emit::report::subject::Report;
use design::{Circle, CutEdge, FlatPiece, PlacedPart, SheetLayout};
use geom::{Path, Point, Segment};
use program::plan::{Program, Ramp, SeamReport, Step, height_of};

/// The distinct pieces, each in a frame of its own.
pub(super) fn parts(report: &Report<'_>) -> Vec<Value> {
    report.design.firsts().map(|placed| part(placed, report.design.part(placed))).collect()
}

fn part(placed: &PlacedPart, part: FlatPiece<'_>) -> Value {
    let (shape, cut) = (part.shape(), part.cut(CutEdge::Part));
    let mut value = json!({
        "star": placed.index,
        "band_mm": shape.band,
        "outside": polyline(cut.outside),
        // In the air the page shows the holes of valves, through which the lower sheet is seen.
        "tube": part.tube().iter().chain(cut.valves).map(polyline).collect::<Vec<_>>(),
        "bands": shape.seams.iter().map(|seam| polyline(&seam.center_line)).collect::<Vec<_>>(),
        "closed": shape.seams.iter().map(|seam| seam.center_line.closed).collect::<Vec<_>>(),
        "holes": [],
    });
    match part {
        FlatPiece::Star(part) => {
            let hole = |hole: &Circle| json!([hole.center.x, hole.center.y, hole.diameter].map(hundredths));
            value["points"] = part.star.n.into();
            value["arm_length_mm"] = thousandths(part.star.l).into();
            value["hole"] = json!(polyline(&part.outline.hole));
            value["holes"] = cut.holes.iter().map(hole).collect();
        }
        FlatPiece::Drawn(_) => value["insides"] = json!(cut.inside.iter().map(polyline).collect::<Vec<_>>()),
    }
    value
}

/// The sheets, and where each star lies on them.
pub(super) fn sheets(report: &Report<'_>) -> Vec<Value> {
    let design = report.design;
    let star = |star: &PlacedPart| {
        let placement = star.placement;
        json!({
            "star": star.index, "part": star.distinct, "x_mm": thousandths(placement.shift.x), "y_mm": thousandths(placement.shift.y),
            "turn_deg": thousandths(placement.rotation.to_degrees()),
        })
    };
    let sheet = |sheet: &SheetLayout| {
        json!({
            "sheet": sheet.index, "width_mm": thousandths(sheet.width), "height_mm": thousandths(sheet.height),
            "stars": design.on_sheet(sheet.index).map(star).collect::<Vec<_>>(),
        })
    };
    design.sheets.iter().map(sheet).collect()
}

/// The sealing programs, in order.
pub(super) fn programs(report: &Report<'_>) -> Vec<Value> {
    // Each step has the time at which it ends and the seam to which it belongs. A program with several processes names that of
    // each seam, with line and pass.
    let program = |program: &Program| {
        let times = program.timeline(report.spec, report.machine);
        let mut seam = 0;
        let steps: Vec<Value> = program
            .steps
            .iter()
            .zip(times)
            .filter_map(|(step, end)| {
                if let Step::Seam(index) = step {
                    seam = *index;
                }
                step_of(report, step, seam, thousandths(end))
            })
            .collect();
        let seams = program.seams.iter().map(|seam| {
            json!({
                "star": seam.name.piece.number(), "loop": seam.name.seam, "length_mm": thousandths(seam.length),
                "overlap_mm": thousandths(seam.overlap), "time_s": thousandths(seam.time),
            })
        });
        let processed = |(mut value, seam): (Value, &SeamReport)| {
            if !program.is_plain() {
                value["process"] = json!(program.processes[seam.process].process.name);
                value["line"] = json!(seam.line);
                value["pass"] = json!(seam.pass);
            }
            value
        };
        let seams = seams.zip(&program.seams).map(processed);
        json!({
            "sheet": program.sheet, "stars": program.numbers(), "time_s": thousandths(program.time),
            "seams": seams.collect::<Vec<_>>(), "steps": steps,
        })
    };
    report.programs.iter().map(program).collect()
}

/// One step that ends at `end`, s; `None` for a step without time and way.
fn step_of(report: &Report<'_>, step: &Step, seam: usize, end: f64) -> Option<Value> {
    Some(match step {
        Step::Height(level) => {
            json!({ "do": "height", "end_s": end, "height_mm": height_of(&report.machine.process, *level) })
        }
        Step::Heat(temperature) => {
            json!({ "do": "heat", "end_s": end, "temperature": temperature.to_string() })
        }
        Step::Travel(Point { x, y }) => {
            json!({ "do": "travel", "end_s": end, "to": [hundredths(*x), hundredths(*y)] })
        }
        Step::TouchDown(down) => ramp_step("down", down, seam, end),
        Step::Seal(pieces) => path_step("seal", pieces, seam, end),
        Step::Lift(up) => ramp_step("up", up, seam, end),
        Step::Pause(_) => json!({ "do": "pause", "end_s": end }),
        Step::Cool(wait) => json!({ "do": "cool", "end_s": end, "wait_s": wait.0 }),
        Step::Seam(_) | Step::Trace(_) => return None,
    })
}

/// A step `action` along `pieces` of the seam `seam`, which ends at `end`, s.
fn path_step(action: &str, pieces: &[Segment], seam: usize, end: f64) -> Value {
    let path = polyline(&Path::open(pieces.to_vec()));
    json!({ "do": action, "end_s": end, "seam": seam, "path": path })
}

/// The step `action` down or up a ramp of the seam `seam`, which ends at `end`, s.
fn ramp_step(action: &str, ramp: &Ramp, seam: usize, end: f64) -> Value {
    let mut value = path_step(action, &ramp.pieces, seam, end);
    value["height_mm"] = json!([ramp.from, ramp.to]);
    value
}

/// A figure for people: a difference in the last bits of a sum must not change the file.
pub(super) fn thousandths(x: f64) -> f64 {
    (x * 1000.0).round() / 1000.0 + 0.0
}
