//! Common options and functions of commands that run the shell model: fineness, progress, interruption, cache.

use std::cell::LazyCell;
use std::path::{Path, PathBuf};

use crate::cli::cache::Cache;
use crate::cli::failure::Failure;
use crate::cli::interrupt::Listening;
use crate::cli::load::Loaded;
use crate::cli::progress;
use crate::cli::text_file::{refuse_foreign, replace_bytes};
use crate::cli::verbosity::Verbosity;
use crate::cli::words::words;
use crate::pipeline::no_prediction;
use design::{RefusalCode, Refusals};
use forecast::pressures::pressure_finding;
use forecast::shell::sheet::ModelledSheet;
use forecast::shell::star::ShellRefusal;
use forecast::shell::{Detail, SHELL};
use inflatable::shell::cases::{SOLID_TITLE, ShellFault, Watch};

/// Arguments for the shell model only.
#[derive(clap::Args, Debug)]
pub(super) struct ShellArgs {
    /// For the shell: fineness of its meshes; default: medium for stars, coarse for drawings. Every number is printed with its mesh error.
    #[arg(long, value_name = "HOW", value_parser = words(&Detail::ALL, &MESHES))]
    pub(super) fineness: Option<Detail>,
    /// For the shell: write the inflated sheet as a VTU file, which ParaView reads.
    #[arg(long, value_name = "FILE")]
    vtu: Option<PathBuf>,
    /// For the shell: write the inflated body, both sheets and all sectors, as a closed STL file in mm.
    #[arg(long, value_name = "FILE")]
    stl: Option<PathBuf>,
    /// For the shell: write the inflated body as an OBJ file in mm, with groups for sheets and seams.
    #[arg(long, value_name = "FILE")]
    obj: Option<PathBuf>,
    /// For the shell: do not use the cache.
    #[arg(long)]
    no_cache: bool,
}

/// The help of the meshes, in the order of [`Detail::ALL`].
const MESHES: [&str; 3] = ["A first look: seconds", "For most purposes", "Where mesh errors matter"];

impl ShellArgs {
    /// Refuses options that only the shell model has.
    pub(super) fn not_by_others(&self) -> Result<(), Failure> {
        let files = SheetFile::ALL.map(|file| (self.path(file).is_some(), file.option()));
        let options = files.into_iter().chain([(self.fineness.is_some(), "--fineness")]);
        match options.into_iter().find(|(is_given, _)| *is_given) {
            Some((_, option)) => Err(Failure::Usage(format!(
                "{option} needs the shell model: add --model shell, or leave it out"
            ))),
            None => Ok(()),
        }
    }

    /// Where `file` is written; `None` if it is not.
    fn path(&self, file: SheetFile) -> Option<&Path> {
        match file {
            SheetFile::Vtu => self.vtu.as_deref(),
            SheetFile::Stl => self.stl.as_deref(),
            SheetFile::Obj => self.obj.as_deref(),
        }
    }

    /// Shows the answer to `question`, which must contain all inputs: from the cache, or computed by `compute` as JSON, text and sheet.
    pub(super) fn show(
        &self,
        question: &str,
        verbosity: Verbosity,
        compute: impl FnOnce(&Watch<'_>) -> Result<(String, String, Option<ModelledSheet>), Failure>,
    ) -> Result<(), Failure> {
        for file in SheetFile::ALL {
            self.path(file).map_or(Ok(()), |path| file.refuse_foreign(path))?;
        }
        let cache = Cache::new(self.no_cache);
        let files = SheetFile::ALL.map(|file| self.path(file).is_some());
        let key = cache.key(&[question, &format!("{:?} {files:?}", self.fineness)]);
        let stored = cache.get(&key).and_then(|parts| parts.try_into().ok());
        let [json, text, vtu, stl, obj] = if let Some(stored) = stored {
            stored
        } else {
            let (json, text, sheet) = watched_by(verbosity, self.fineness.is_some(), compute)?;
            let [vtu, stl, obj] = self.files_of(sheet.as_ref())?;
            let parts = [json.into_bytes(), text.into_bytes(), vtu, stl, obj];
            cache.store(&key, &parts);
            parts
        };
        for (file, bytes) in SheetFile::ALL.into_iter().zip([vtu, stl, obj]) {
            self.path(file).map_or(Ok(()), |path| replace_bytes(path, &bytes))?;
        }
        let [text, json] = [text, json].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        verbosity.show(&text, &json)
    }

    /// The files of `sheet`, in the order of [`SheetFile::ALL`]; empty where none is written.
    fn files_of(&self, sheet: Option<&ModelledSheet>) -> Result<[Vec<u8>; 3], Failure> {
        let mut files = [const { Vec::new() }; 3];
        let Some(sheet) = sheet else { return Ok(files) };
        let body = LazyCell::new(|| sheet.shape.body(sheet.symmetry));
        for (file, bytes) in SheetFile::ALL.into_iter().zip(&mut files) {
            *bytes = match (file, self.path(file)) {
                (_, None) => continue,
                (SheetFile::Vtu, _) => sheet.shape.vtu().map_err(Failure::message)?.into_bytes(),
                (SheetFile::Stl, _) => body.stl(),
                (SheetFile::Obj, _) => body.obj(&body.points_by_seam(&sheet.seams)).into_bytes(),
            };
        }
        Ok(files)
    }
}

/// A file of the inflated sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SheetFile {
    /// The modelled sheet for ParaView.
    Vtu,
    /// The whole body as a solid.
    Stl,
    /// The whole body with named groups.
    Obj,
}

impl SheetFile {
    /// Every file.
    const ALL: [Self; 3] = [Self::Vtu, Self::Stl, Self::Obj];

    /// The option that asks for it.
    fn option(self) -> &'static str {
        match self {
            Self::Vtu => "--vtu",
            Self::Stl => "--stl",
            Self::Obj => "--obj",
        }
    }

    /// Refuses to write to `path` over a file of another kind.
    fn refuse_foreign(self, path: &Path) -> Result<(), Failure> {
        match self {
            Self::Vtu => refuse_foreign(path, "a VTU file", |text| text.contains("<VTKFile ")),
            Self::Stl => {
                refuse_foreign(path, "an STL file of an inflated body", |text| text.starts_with(SOLID_TITLE))
            }
            Self::Obj => refuse_foreign(path, "an OBJ file of an inflated body", |text| {
                text.strip_prefix("# ").is_some_and(|text| text.starts_with(SOLID_TITLE))
            }),
        }
    }
}

/// The shell's fault as a failure of the command.
pub(super) fn refused(fault: &ShellFault) -> Failure {
    match fault {
        ShellFault::Cancelled => Failure::Interrupted,
        ShellFault::Pressure { found, least, most } => {
            let (message, remedy) = pressure_finding(SHELL, *found, [*least, *most]);
            Failure::Message(format!("{message}: {remedy}"))
        }
        fault => Failure::message(fault),
    }
}

/// The shell's refusal as a failure of the command.
pub(super) fn not_computed(loaded: &Loaded, refusal: ShellRefusal) -> Failure {
    match refusal {
        ShellRefusal::Cancelled => Failure::Interrupted,
        ShellRefusal::Fault(fault) => {
            let mut refusals = Refusals::from(no_prediction(&fault));
            // A whole command: `--fineness` excludes `--accuracy`.
            let command = "`stargrip-cam predict SPEC --model shell --fineness coarse` computes it";
            refusals.offer(RefusalCode::LargeShell, command);
            loaded.refused(refusals)
        }
    }
}

/// Computes while Ctrl-C is caught: the first one asks the computation to stop, the second one ends the program. A terminal shows the
/// progress unless `verbosity` is quiet. A drawing of many unknowns is refused, unless it `is_asked` for.
pub(super) fn watched_by<T>(
    verbosity: Verbosity,
    is_asked: bool,
    compute: impl FnOnce(&Watch<'_>) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let listening = Listening::new();
    progress::listening(verbosity, "the shell", |progress| {
        let tell = |part: f64, what: &str| progress.tell_part(part, &format!("shell: {what}"));
        compute(&Watch { progress: Some(&tell), cancel: listening.flag(), is_bounded: !is_asked })
    })
}
