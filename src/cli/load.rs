//! Reads a spec and its machine profile from a path, and makes their design.

use std::path::{Path, PathBuf};

use crate::answer::refused::at_keys;
use crate::cli::escape::escaped_line;
use crate::cli::failure::{Failure, reason, tell, warn};
use crate::cli::findings::Unproven;
use crate::cli::material::FabricArg;
use crate::cli::progress;
use crate::cli::source_file::{SPEC, read_source};
use crate::cli::verbosity::Verbosity;
use crate::cli::whole_file::{SPECIAL, first_bytes, is_special, is_standard_input};
use crate::cli::words::count_beyond;
use crate::manifest::MANIFEST;
use crate::pipeline::{Forecast, Planned, Proven, Sources, no_programs, unfit_besides};
use design::{RefusalCode, Refusals, Warning, drawing_notes};
use forecast::drawn::Watch;
use proof::artifact::KindRequest;
use proof::verify::Finding;
use spec::{Fault, FaultCode, Faults, Machine, ProductKind, Reading, Source, key};

/// The profile's name in a published directory.
pub(super) const MACHINE: &str = "machine.toml";

/// Nothing but errors is printed.
const QUIET: Verbosity = Verbosity { verbose: false, quiet: true, json: false };

/// Notes on a refused drawing that are printed without -v.
const SHOWN_NOTES: usize = 2;

/// A valid spec with its valid machine profile.
#[derive(Debug)]
pub struct Loaded {
    /// The parsed spec.
    pub reading: Reading,
    /// The spec's text and its name.
    pub source: Source,
    /// The parsed machine profile.
    pub machine: Machine,
    /// The spec's own path; the path of its machine profile is relative to it.
    pub path: PathBuf,
    machine_text: String,
    verbosity: Verbosity,
}

impl Loaded {
    /// Reads the spec at `path` and its machine profile; prints warnings unless `verbosity` is quiet.
    pub(super) fn read_spec(path: &Path, verbosity: Verbosity) -> Result<Self, Failure> {
        Self::from_source(read_source(path)?, path, verbosity)
    }

    /// The spec at `path` with the values of a fabric, read as by [`Loaded::read_spec`].
    pub(super) fn with_fabric(
        path: &Path,
        fabric: &FabricArg,
        verbosity: Verbosity,
    ) -> Result<Self, Failure> {
        let source = fabric.written_into(read_source(path)?, verbosity.quiet)?;
        Self::from_source(source, path, verbosity)
    }

    /// The spec of the file `path`, without printing; "-" is standard input.
    ///
    /// # Errors
    /// If the file cannot be read, or if the spec or its machine profile is invalid; all faults are listed.
    pub fn from_file(path: &Path) -> Result<Self, Failure> {
        Self::read_spec(path, QUIET)
    }

    /// The spec of a text called `name`; a path of its machine profile is relative to the directory of `path`.
    ///
    /// # Errors
    /// The errors of [`Loaded::from_file`].
    pub fn from_text(name: &str, text: &str, path: &Path) -> Result<Self, Failure> {
        // A text has the same limits as a file.
        Self::from_source(Source::from_bytes(name, text.as_bytes())?, path, QUIET)
    }

    fn from_source(source: Source, path: &Path, verbosity: Verbosity) -> Result<Self, Failure> {
        let (reading, [drawing_note, note], profile) = named_by(path, &source)?;
        if !verbosity.quiet {
            warn(&reading.warnings);
            tell(&note.unwrap_or_default());
            tell(&drawing_note.unwrap_or_default());
        }
        let machine = spec::read_machine(&profile)?;
        Ok(Self { reading, source, machine, path: path.to_owned(), machine_text: profile.text, verbosity })
    }

    /// Refuses a spec without stars; `command` is for stars only.
    ///
    /// # Errors
    /// If the spec has a drawing.
    pub(super) fn with_stars(self, command: &str) -> Result<Self, Failure> {
        let (key, product) = match self.reading.spec.product() {
            ProductKind::Stars => return Ok(self),
            ProductKind::Drawing => (key::drawing::FILE, "a drawing"),
        };
        let place = self.reading.raw.span_of(key);
        let message = format!("`{command}` is for stars only, and this spec has {product}");
        let fault = Fault::error(RefusalCode::NoPrediction, place, message).label("needs [star] instead");
        Err(Faults::new(&self.source, vec![fault]).into())
    }

    /// The texts as read.
    pub fn sources(&self) -> Sources<'_> {
        Sources { spec: &self.source.text, machine: &self.machine_text }
    }

    /// Prints the design's warnings at their keys.
    pub(super) fn warn(&self, warnings: &[Warning]) {
        if self.verbosity.quiet {
            return;
        }
        let faults = warnings.iter().map(|warning| {
            Fault::warning(warning.code, self.reading.raw.span_of(warning.key), warning.found.clone())
                .label(warning.remedy.clone())
                .drawn_at(warning.drawn.clone())
        });
        warn(&Faults::new(&self.source, faults.collect()));
    }

    /// The forecast of the spec, without files; prints the design's warnings. Unless `anyway` is set, a shell of many unknowns is refused, and
    /// refusals of the design are joined by the reasons why the gripper does not meet its own `[load]`.
    pub(super) fn forecast(&self, anyway: bool) -> Result<Forecast, Failure> {
        let (spec, machine) = (self.reading.spec.clone(), self.machine.clone());
        let forecast = progress::with_line(self.verbosity, "designing", |progress| {
            let tell = |part: f64, what: &str| progress.tell_part(part, &format!("shell: {what}"));
            let watch = Watch { progress: Some(&tell), is_bounded: !anyway, ..Watch::default() };
            Planned::new(spec, machine)?.forecast(&watch)
        });
        let forecast = forecast.map_err(|mut refusals| {
            refusals.offer(RefusalCode::LargeShell, "`--anyway` computes it");
            if !anyway {
                let mut unfit = acceptable(unfit_besides(&self.reading.spec, &self.machine, &refusals));
                unfit.retain(|unfit| refusals.iter().all(|refusal| refusal.code != unfit.code));
                refusals.extend(unfit);
            }
            self.refused(refusals)
        })?;
        self.warn(&forecast.warnings(self.sources()));
        Ok(forecast)
    }

    /// Refuses a gripper that does not meet its own `[load]`, unless `anyway` is set.
    pub(super) fn fit(&self, forecast: &Forecast, anyway: bool) -> Result<(), Failure> {
        if anyway {
            return Ok(());
        }
        acceptable(forecast.unfit()).or_value(()).map_err(|refusals| self.refused(refusals))
    }

    /// Makes the files of `request` and reads them back, in memory, for `check` and `build`.
    pub(super) fn proven(&self, forecast: Forecast, request: &KindRequest) -> Result<Proven, Failure> {
        progress::with_line(self.verbosity, "making the files", |progress| {
            let built = forecast.build(self.sources(), request);
            progress.tell("proving the files");
            built.prove()
        })
        .map_err(|findings| self.unproven(findings))
    }

    /// The findings in files that were just made, as a failure.
    pub(super) fn unproven(&self, findings: Vec<Finding>) -> Failure {
        let (spec, profile) = (self.source.name.clone(), self.reading.spec.machine.profile.clone());
        Failure::Unproven(Unproven { findings, spec, profile })
    }

    /// Refuses programs for a heat press, which runs none; `subject` is what needs them.
    pub(super) fn with_programs(&self, subject: &str) -> Result<(), Failure> {
        let refusal: Refusals = no_programs(&self.reading.spec, subject).into_iter().collect();
        refusal.or_value(()).map_err(|refusals| self.refused(refusals))
    }

    /// Refusals of the design as faults at their keys; prints the notes on its drawing, with -v all of them.
    pub(super) fn refused(&self, refusals: Refusals) -> Failure {
        if !self.verbosity.quiet {
            let mut notes = drawing_notes(&self.reading.spec);
            // Some are the refusals themselves.
            notes.retain(|note| refusals.iter().all(|refusal| refusal.found != note.trim_end_matches('.')));
            let number = if self.verbosity.verbose { notes.len() } else { SHOWN_NOTES };
            let mut lines: Vec<String> =
                notes.iter().take(number).map(|note| format!("drawing: {note}")).collect();
            let rest = count_beyond(notes.len(), number);
            lines.extend(rest.map(|rest| format!("drawing: {rest} more notes by -v")));
            tell(&lines.join("\n"));
        }
        Failure::Faults(at_keys(&self.source, &self.reading.raw, refusals))
    }
}

/// Refusals about the load, each with the option that accepts it.
fn acceptable(mut unfit: Refusals) -> Refusals {
    for refusal in unfit.iter_mut() {
        refusal.remedy += "; `--anyway` accepts it";
    }
    unfit
}

/// Refuses to read standard input for more than one of `paths`: the first would take all of it.
///
/// # Errors
/// If two of them are "-".
pub(super) fn refuse_two_stdin<'a>(paths: impl IntoIterator<Item = &'a PathBuf>) -> Result<(), Failure> {
    match paths.into_iter().filter(|path| is_standard_input(path)).count() {
        0 | 1 => Ok(()),
        number => Err(Failure::Usage(format!(
            "standard input is named {number} times, and can be read once: leave one `-`, and name files for the others"
        ))),
    }
}

/// The path of the spec in commands that follow: for standard input that of its copy in the published `directory`.
pub(super) fn lasting(spec: &Path, directory: &Path) -> PathBuf {
    if is_standard_input(spec) { directory.join(SPEC) } else { spec.to_owned() }
}

/// The file that the spec at `path` names `name`. If it is not there, and the spec is of a published build: the file `published` beside it,
/// and a note, because a copied spec's own path no longer leads to the file. A manifest must lie beside it, so that no unrelated file of
/// this name is read.
fn named_file(path: &Path, name: &str, published: &str) -> (PathBuf, Option<String>) {
    let named = path.parent().unwrap_or(Path::new("")).join(name);
    let published_file = path.with_file_name(published);
    if named.is_file() || !path.with_file_name(MANIFEST).is_file() || !published_file.is_file() {
        return (named, None);
    }
    let note = format!(
        "note: there is no {}; {} is used, as published",
        escaped_line(&named),
        escaped_line(&published_file)
    );
    (published_file, Some(note))
}

/// Largest drawing that is read, bytes.
pub(super) const DRAWING_LIMIT: u64 = 64 << 20;

/// The spec `source` at `path` with the files that it names, the notes on where its drawing and its profile were found, and the profile.
///
/// # Errors
/// All faults of the text, and of the files that it names.
fn named_by(path: &Path, source: &Source) -> Result<(Reading, [Option<String>; 2], Source), Failure> {
    let reading = match spec::read(source) {
        Ok(reading) => reading,
        Err(faults) => {
            let profile = spec::written_profile(source);
            let unknown = profile.and_then(|(name, place)| profile_file(path, &name, place).err());
            return Err(faults.with_addition(unknown).into());
        }
    };
    let place = reading.raw.span_of(key::machine::PROFILE);
    let profile = profile_file(path, &reading.spec.machine.profile, place);
    match (with_drawing(path, reading), profile) {
        (Ok((reading, drawing_note)), Ok((file, note))) => {
            let name = &reading.spec.machine.profile;
            let profile = match spec::builtin_machine(name) {
                Some(text) => Source::new(format!("built-in machine profile {name}"), text),
                None => read_source(&file)?,
            };
            Ok((reading, [drawing_note, note], profile))
        }
        (drawing, profile) => {
            Err(Faults::new(source, drawing.err().into_iter().chain(profile.err()).collect()).into())
        }
    }
}

/// `reading` of the spec at `path` with its drawing, a file relative to the spec; and a note on the drawing's place, if it is not the named
/// one.
fn with_drawing(path: &Path, reading: Reading) -> Result<(Reading, Option<String>), Fault> {
    let Some(drawing) = &reading.spec.drawing else { return Ok((reading, None)) };
    let (file, note) = named_file(path, &drawing.file, drawing.published_name());
    match drawing_bytes(&file) {
        Ok(bytes) => Ok((reading.with_drawing(&bytes), note)),
        Err(wrong) => {
            let place = reading.raw.span_of(key::drawing::FILE);
            Err(Fault::error(RefusalCode::DrawingUnread, place, wrong).label("a path relative to the spec"))
        }
    }
}

/// The content of the drawing `file`, or the reason why it cannot be read.
pub(super) fn drawing_bytes(file: &Path) -> Result<Vec<u8>, String> {
    // Reading a pipe would wait for a writer, and a device may never end.
    if is_special(file) {
        return Err(format!("cannot read {}: {SPECIAL}", escaped_line(file)));
    }
    match first_bytes(file, DRAWING_LIMIT + 1) {
        Ok(bytes) if bytes.len() as u64 > DRAWING_LIMIT => {
            Err(format!("{} is larger than 64 MiB", escaped_line(file)))
        }
        Ok(bytes) => Ok(bytes),
        Err(error) => Err(format!("cannot read {}: {}", escaped_line(file), reason("read", &error))),
    }
}

/// The file of the machine profile `name` of the spec at `path`, relative to the spec, which is not read if the profile is a built-in one;
/// and a note on its place, if it is not the named one.
///
/// # Errors
/// If there is no such profile: a fault at `place`.
fn profile_file(
    path: &Path,
    name: &str,
    place: std::ops::Range<usize>,
) -> Result<(PathBuf, Option<String>), Fault> {
    if spec::builtin_machine(name).is_some() {
        return Ok((PathBuf::from(name), None));
    }
    let (file, note) = named_file(path, name, MACHINE);
    if file.is_file() {
        return Ok((file, note));
    }
    let builtin_names: Vec<&str> = spec::builtin_machines().collect();
    let state = if file.is_dir() {
        format!("{} is a directory", escaped_line(&file))
    } else if is_special(&file) {
        format!("cannot read {}: {SPECIAL}", escaped_line(&file))
    } else {
        format!("there is no file {}", escaped_line(&file))
    };
    let message = format!("no machine profile has this name, and {state}");
    let fault = Fault::error(FaultCode::UnknownMachine, place, message)
        .label(format!("a built-in profile ({}) or a path relative to the spec", builtin_names.join(", ")));
    // A trade name says more than a name that is spelt like it: "ender3" has Marlin.
    let nearest = || spec::nearest(name, builtin_names).map(|near| format!("did you mean \"{near}\"?"));
    Err(match spec::machine_remedy(name).or_else(nearest) {
        Some(remedy) => fault.help(remedy),
        None => fault,
    })
}
