//! `stargrip-cam new`

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::Failure;
use crate::cli::load::drawing_bytes;
use crate::cli::material::FabricArg;
use crate::cli::new_object::{NewGripper, OBJECT_OPTIONS, ObjectArgs, machine, spec_for_object};
use crate::cli::text_file::write_new;
use crate::cli::verbosity::Verbosity;
use crate::cli::words::count_beyond;
use crate::cli::{defaults, progress, schema};
use artwork::{Format, Unit};
use design::{Layer, LayerProposal, Refusals, propose_layers, unit_question};
use spec::units::Readable;
use spec::{self, LayerRole, Source, shortened};

/// Faults of a drawing that are listed; the others are counted.
const LISTED_FAULTS: usize = 3;

/// Arguments of `new`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Name of the design, and of its file; default: that of the drawing, without one "star".
    name: Option<String>,
    /// Your own drawing, SVG or DXF: a spec that names all of its layers. Not with --object and its options.
    #[arg(long, value_name = "FILE", conflicts_with_all = OBJECT_OPTIONS)]
    drawing: Option<PathBuf>,
    /// Unit of the drawing's numbers, in place of the file's own: mm, cm, in, px and others.
    #[arg(long, value_name = "UNIT", requires = "drawing", value_parser = unit)]
    units: Option<Unit>,
    #[command(flatten)]
    object: ObjectArgs,
    #[command(flatten)]
    fabric: FabricArg,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Writes a starter spec into the current directory; an existing file is never overwritten.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if let Some(drawing) = &args.drawing {
        return by_drawing(args, drawing);
    }
    let (name, path) = named(args.name.as_deref().unwrap_or("star"))?;
    if names_file(name) {
        let (file, option) = (escaped_line(name), argument(name));
        let text = format!("{file} is a drawing: use `stargrip-cam new --drawing {option}`");
        return Err(Failure::Message(text));
    }
    let gripper = progress::with_line(args.verbosity, "searching for a gripper", |_| {
        spec_for_object(name, &args.object, &args.fabric)
    })?;
    let text = match &gripper {
        // The search has applied the user's defaults already.
        Some(made) => format!("#:schema ./{}\n{}", spec::SCHEMA_FILE, made.text),
        None => with_defaults(spec::starter(name).map_err(Failure::message)?, &args.fabric)?,
    };
    let verdict = gripper.as_ref().and_then(|made| made.forecast.verdict());
    let gripper_json = gripper.as_ref().map(NewGripper::json);
    let json = json!({ "verdict": verdict, "chosen": gripper_json });
    let headline = gripper.map_or_else(String::new, |made| format!("{name}: {}", made.in_words()));
    write(args.verbosity, (&path, &text), json, (&headline, "edit it", "build"))
}

/// Writes the spec `text` and its schema; prints `json` with their paths, or these after the text `headline`, with what is `next`, and the
/// `command` for it.
fn write(
    verbosity: Verbosity,
    (path, text): (&Path, &str),
    mut json: Value,
    (headline, next, command): (&str, &str, &str),
) -> Result<(), Failure> {
    write_new(path, text)?;
    json["wrote"] = json!(path);
    json["schema"] = json!(schema::write_beside(path)?);
    let (path, word, schema) = (escaped_line(path), argument(path), spec::SCHEMA_FILE);
    let report = format!(
        "{headline}wrote {path}, and beside it {schema} for editors\nnext: {next}, then `stargrip-cam {command} {word}`\n"
    );
    verbosity.report(&report, &json)
}

/// Whether the name of a design is that of a drawing.
fn names_file(name: &str) -> bool {
    Format::of_name(name).is_some()
}

/// The name of the design, and its file.
fn named(argument: &str) -> Result<(&str, PathBuf), Failure> {
    let name = argument.strip_suffix(".toml").unwrap_or(argument);
    let stem = file_stem(name).ok_or_else(|| {
        Failure::Message(format!("{}; a name is such as my-star", nameless(argument, "a file")))
    })?;
    Ok((name, PathBuf::from(format!("{stem}.toml"))))
}

/// The reason why the design's `name` names no file, or no directory.
pub(super) fn nameless(name: &str, path_kind: &str) -> String {
    format!(
        "the name `{}` has no letter from a to z and no digit for the name of {path_kind}",
        escaped_line(name)
    )
}

/// `text` with the user's defaults, whose machine profile exists, and then with the values of `fabric`.
fn with_defaults(text: String, fabric: &FabricArg) -> Result<String, Failure> {
    let text = fabric.written_into(Source::new("starter", defaults::written_into(text)?), true)?.text;
    let profile = spec::read(&Source::new("starter", text.as_str()))?.spec.machine.profile;
    match machine(&profile) {
        Err(Failure::Message(fault)) => Err(Failure::Message(format!("your defaults: {fault}"))),
        other => other.map(|_| text),
    }
}

/// The unit of this name.
fn unit(name: &str) -> Result<Unit, String> {
    let names: Vec<&str> = Unit::names().collect();
    Unit::from_name(name).ok_or_else(|| format!("units are {}", names.join(", ")))
}

/// The name of a design by its drawing, and its file: both are those of the drawing unless `name` is given.
fn named_by_drawing<'n>(
    name: Option<&'n str>,
    stem: &'n str,
    drawing: &Path,
) -> Result<(&'n str, PathBuf), Failure> {
    let Some(name) = name else {
        let quoted = spec::quoted(stem).map(|_| (stem, PathBuf::from(format!("{stem}.toml"))));
        return quoted.map_err(|why| {
            let file = argument(drawing);
            Failure::Message(format!("{why}: give a name with `stargrip-cam new NAME --drawing {file}`"))
        });
    };
    named(name)
}

/// Writes the spec of a drawing, with a proposed role for every layer.
fn by_drawing(args: &Args, drawing: &Path) -> Result<(), Failure> {
    let stem = drawing.file_stem().unwrap_or_default().to_string_lossy();
    let (name, path) = named_by_drawing(args.name.as_deref(), &stem, drawing)?;
    let file = drawing.to_string_lossy();
    let bytes = drawing_bytes(drawing).map_err(Failure::Message)?;
    // There is no spec yet whose key could be named.
    let refused = |refusals: Refusals| {
        let reasons: Vec<String> =
            refusals.iter().map(|refusal| format!("{}; {}", refusal.found, refusal.remedy)).collect();
        let text = format!("{}: {}", escaped_line(drawing), reasons.join("\n"));
        Failure::File(drawing.display().to_string(), text)
    };
    let proposal = propose_layers(&file, &bytes, args.units).map_err(refused)?;
    let text = spec::drawing_starter(name, &file, &proposal.layers, proposal.unit);
    let text = with_defaults(text.map_err(Failure::message)?, &args.fabric)?;
    let rows: Vec<Value> = proposal
        .layers
        .iter()
        .map(|(layer, role, reason)| json!({ "layer": layer, "role": role.word(), "reason": reason }))
        .collect();
    let json = json!({
        "layers": rows, "hidden": proposal.hidden, "size_mm": proposal.size, "assumed_mm": proposal.no_unit,
        "assumed_unit": proposal.no_unit.as_ref().and(proposal.unit).map(Unit::name),
        "faults": proposal.faults,
    });
    write(args.verbosity, (&path, &text), json, (&in_words(&proposal), "look at the roles in it", "check"))
}

/// The layers of a drawing with their roles, and what a user should look at.
fn in_words(proposal: &LayerProposal) -> String {
    // The proposed roles come first, then what was not read and why. Questions about port, size and unit come last,
    // because only the user can answer them.
    let LayerProposal { layers, size, unit, no_unit, hidden, faults } = proposal;
    let (number, noun) = (layers.len(), if layers.len() == 1 { "layer" } else { "layers, each" });
    let mut lines = format!("{number} {noun} with a proposed role:\n");
    for (layer, role, reason) in layers {
        let _ = writeln!(lines, "  {}: {} ({reason})", shortened(&format!("{layer:?}")), role.word());
    }
    for layer in hidden {
        let layer = shortened(&format!("{layer:?}")).into_owned();
        let _ =
            writeln!(lines, "{layer} is hidden in the drawing and not read: show it there if you need it");
    }
    for fault in faults.iter().take(LISTED_FAULTS) {
        let _ = writeln!(lines, "left out: {}", shortened(fault));
    }
    if let Some(rest) = count_beyond(faults.len(), LISTED_FAULTS) {
        let _ = writeln!(lines, "left out: {rest} more faulty elements");
    }
    let is_own = layers.iter().any(|(layer, ..)| layer == Layer::SealOuter.name());
    if !is_own && !layers.iter().any(|(_, role, _)| matches!(role, LayerRole::Port | LayerRole::Valve)) {
        lines.push_str("no layer looks like a port: draw a short line across an edge where a hose goes in\n");
    }
    let [width, height] = size.map(Readable);
    let _ = writeln!(lines, "the figures with a role are {width} x {height} mm");
    if let Some(finding) = no_unit {
        let unit = unit.map_or("mm", Unit::name);
        let _ = writeln!(
            lines,
            "the unit {unit} is assumed: if the size is wrong, correct `units`, or use --units. {finding}"
        );
    }
    if let Some(question) = unit_question(*size) {
        let _ = writeln!(lines, "{question}");
    }
    lines
}

/// The name as a portable file name: ASCII letters, digits, dashes, and points between them; `None` if it has none of the former two.
pub(super) fn file_stem(name: &str) -> Option<String> {
    // A name that ends in .toml is that of the file.
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let mut stem = String::new();
    for c in name.chars() {
        let follows_word = stem.ends_with(|last: char| last.is_ascii_alphanumeric());
        match c {
            _ if c.is_ascii_alphanumeric() => stem.push(c.to_ascii_lowercase()),
            '.' if follows_word => stem.push('.'),
            _ if follows_word => stem.push('-'),
            _ => {}
        }
    }
    let stem = stem.trim_end_matches(['-', '.']);
    (!stem.is_empty()).then(|| stem.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_safe_and_keep_their_points() {
        for (name, stem) in [
            ("f0.2", "f0.2"),
            ("f0.2.toml", "f0.2"),
            ("../\u{e9}star", "star"),
            ("a..b - c.", "a.b-c"),
            (".hidden", "hidden"),
        ] {
            assert_eq!(file_stem(name).as_deref(), Some(stem), "{name}");
        }
        for name in ["\u{661f}", "", "-.-", ".toml"] {
            assert_eq!(file_stem(name), None, "{name}");
        }
    }
}
