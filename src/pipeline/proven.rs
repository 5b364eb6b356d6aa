//! The last step: files are read back, and only what is found right may be published.

use std::borrow::Cow;

use crate::artifact::{Kind, Output, outputs};
use crate::design::{Design, Refusal};
use crate::manifest::{MANIFEST, Manifest};
use crate::pipeline::{Built, Forecast, Sources};
use crate::spec;
use crate::spec::{Faults, Machine, Reading, Source};
use crate::verify;
use crate::verify::{Expected, Finding, FindingCode, OutputFiles, Proof};

/// A gripper whose files have been read back and say what the design says: the only thing that can be published.
#[derive(Clone, Debug)]
pub struct Proven {
    built: Built,
    proof: Proof,
}

impl Built {
    /// All files with their names, the manifest last.
    pub fn files(&self) -> impl Iterator<Item = (&str, Cow<'_, [u8]>)> {
        let artifacts = self.artifacts.iter().map(|a| (a.name.as_str(), a.bytes.as_slice().into()));
        artifacts.chain(std::iter::once((MANIFEST, self.manifest.to_json().into())))
    }

    /// The files as the verifier sees them.
    pub fn output_files(&self) -> OutputFiles<'_> {
        OutputFiles { files: self.files().map(|(name, bytes)| (name.into(), bytes)).collect() }
    }

    /// Reads every file back and compares it with the design.
    pub fn proof(&self) -> Proof {
        prove_against(&self.forecast, &self.output_files())
    }

    /// The same gripper, fit to be published.
    ///
    /// # Errors
    /// Everything that is not as it should be; each is a fault of this program.
    pub fn prove(self) -> Result<Proven, Vec<Finding>> {
        let proof = self.proof();
        if proof.findings.is_empty() { Ok(Proven { built: self, proof }) } else { Err(proof.findings) }
    }
}

impl Proven {
    /// The gripper and its files.
    pub fn built(&self) -> &Built {
        &self.built
    }

    /// Time of all sealing programs that were written, s; `None` if none was.
    pub fn sealing_time(&self) -> Option<f64> {
        let written = self.built.artifacts.iter().any(|artifact| artifact.output.kind == Kind::SealGcode);
        written.then(|| self.built.forecast.programs.iter().map(|program| program.time).sum())
    }

    /// What was read back, and how near to the design it is.
    pub fn proof(&self) -> &Proof {
        &self.proof
    }
}

/// Proves an output directory from its files alone, by the same steps as `build`.
///
/// The directory's own spec and profile say what should be there. All of it is made again, and every file that differs by
/// a byte is named; and every file is read back and compared with the design, equal or not. A directory that another
/// version wrote is judged by reading alone.
pub fn prove_files(files: &OutputFiles<'_>) -> Proof {
    let forecast = match forecast_of(files) {
        Ok(forecast) => forecast,
        Err(findings) => return Proof { findings, ..Proof::default() },
    };
    let mut proof = prove_against(&forecast, files);
    let written = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice::<Manifest>(bytes).ok());
    let text = |name| files.get(name).and_then(|bytes| std::str::from_utf8(bytes).ok());
    if let (Some(written), Some(spec), Some(machine)) = (written, text("spec.toml"), text("machine.toml")) {
        let made = forecast.build(Sources { spec, machine }, &written.only);
        if written.tool == made.manifest.tool {
            verify::compare_bytes(&made.output_files(), files, &mut proof);
        }
    }
    proof
}

/// Proves an output directory by reading alone, as [`Built::prove`] does.
pub fn read_back(files: &OutputFiles<'_>) -> Proof {
    match forecast_of(files) {
        Ok(forecast) => prove_against(&forecast, files),
        Err(findings) => Proof { findings, ..Proof::default() },
    }
}

fn prove_against(forecast: &Forecast, files: &OutputFiles<'_>) -> Proof {
    let Forecast { spec, machine, design, programs, prediction, .. } = forecast;
    let manifest = Manifest::new(spec, design, programs);
    let (prediction, manifest) = (prediction.as_ref(), &manifest);
    let expected = Expected { design, spec, machine, prediction, manifest };
    verify::prove(&expected, files)
}

/// The names of all files that a directory must have, by its own spec, profile and manifest; none where these are refused.
pub fn wanted(files: &OutputFiles<'_>) -> Vec<String> {
    let (Ok(reading), Ok(machine)) = sources_of(files) else { return Vec::new() };
    let Ok(design) = Design::new(&reading.spec, &machine) else { return Vec::new() };
    let manifest = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice::<Manifest>(bytes).ok());
    let only = manifest.map_or(Vec::new(), |manifest| manifest.only);
    outputs(&reading.spec, &design, &only).iter().map(Output::name).collect()
}

/// The directory's own spec and profile.
fn sources_of(files: &OutputFiles<'_>) -> (Result<Reading, Finding>, Result<Machine, Finding>) {
    let read_spec = |source: &Source| spec::read(source);
    (source_of(files, "spec.toml", read_spec), source_of(files, "machine.toml", spec::read_machine))
}

/// What the directory's own spec and profile ask for.
fn forecast_of(files: &OutputFiles<'_>) -> Result<Forecast, Vec<Finding>> {
    let (reading, machine) = match sources_of(files) {
        (Ok(spec), Ok(machine)) => (spec, machine),
        (spec, machine) => return Err(spec.err().into_iter().chain(machine.err()).collect()),
    };
    Forecast::of(reading.spec, machine).map_err(|refusals| refusals.into_iter().map(refused).collect())
}

fn source_of<T>(
    files: &OutputFiles<'_>,
    name: &'static str,
    read: impl Fn(&Source) -> Result<T, Faults>,
) -> Result<T, Finding> {
    let Some(bytes) = files.get(name) else {
        return Err(Finding::new(FindingCode::MissingFile, None, "no such file", "the file of the build")
            .in_file(name));
    };
    Source::from_bytes(name, bytes).and_then(|source| read(&source)).map_err(|faults| {
        let found = faults.list().first().map_or("faults", |fault| &fault.message).to_owned();
        Finding::new(FindingCode::Unreadable, None, found, "text that `check` accepts").in_file(name)
    })
}

fn refused(refusal: Refusal) -> Finding {
    Finding::new(refusal.code, None, refusal.found, refusal.remedy).in_file("spec.toml")
}
