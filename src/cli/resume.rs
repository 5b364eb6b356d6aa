//! `stargrip-cam resume`

use std::path::PathBuf;

use crate::cli::failure::{Failure, say};
use crate::cli::harmless::shown;
use crate::cli::text_file::{read_text, write_new};
use crate::geom::Point;
use crate::resume::{ResumeAt, resume};
use crate::units::{Length, Quantity};

/// Arguments of `resume`.
#[derive(clap::Args, Debug)]
#[command(group(clap::ArgGroup::new("place").required(true)))]
pub(super) struct Args {
    /// The sealing program that was interrupted.
    job: PathBuf,
    /// The line that was running, counted from 1.
    #[arg(long, group = "place")]
    line: Option<usize>,
    /// The part of the job's time that was over: 37%.
    #[arg(long, group = "place", value_name = "PERCENT", value_parser = share)]
    at: Option<f64>,
    /// A point near which the iron stopped, in mm from the sheet's lower left corner.
    #[arg(long, group = "place", value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    near: Option<Point>,
    /// What to seal again before the stop, such as "5 mm"; default: as much as the closures overlap.
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    overlap: Option<f64>,
    /// The program to write; default: the job's name with -resume. Never over a file that is there.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

fn share(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches('%').trim().parse::<f64>().ok();
    let share = number.filter(|percent| (0.0..100.0).contains(percent)).map(|percent| percent / 100.0);
    share.ok_or_else(|| "a percentage from 0 to below 100, such as 37%".to_owned())
}

fn point(text: &str) -> Result<Point, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.abs() < 1e6);
    let (x, y) = text.split_once(',').unwrap_or((text, ""));
    match (number(x), number(y)) {
        (Some(x), Some(y)) => Ok(Point::new(x, y)),
        _ => Err("two numbers, such as 120.5,80".to_owned()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    match Length::parse(text) {
        Ok(length) if (0.0..=1000.0).contains(&length.0) => Ok(length.0),
        _ => Err("a length from 0 to 1 m with its unit, such as \"5 mm\"".to_owned()),
    }
}

/// Writes the program for the rest of the job.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let text = read_text(&args.job)?;
    let place = match (args.line, args.at, args.near) {
        (Some(line), _, _) => ResumeAt::Line(line),
        (_, Some(share), _) => ResumeAt::Share(share),
        (_, _, Some(point)) => ResumeAt::Near(point),
        _ => return Err(Failure::Message("where did it stop? --line, --at or --near".to_owned())),
    };
    let resumed = resume(&text, place, args.overlap)
        .map_err(|fault| Failure::Message(format!("{}: {fault}", shown(&args.job))))?;
    let target = args.output.clone().unwrap_or_else(|| {
        let stem = args.job.file_stem().unwrap_or_default().to_string_lossy();
        args.job.with_file_name(format!("{stem}-resume.gcode"))
    });
    write_new(&target, &resumed.text)?;
    say(&format!(
        "wrote {}\ngoes on in line {} of the old program, {:.1} % of its time done; seals {:.1} mm again\n\
         before you start it: same sheet, same zero, iron above the fabric\n",
        shown(&target),
        resumed.line,
        100.0 * resumed.done,
        resumed.overlap
    ))
}
