//! The last step: files are read back, and only correct ones may be published.

use std::borrow::Cow;

use crate::manifest::{
    CouponManifest, MANIFEST, Manifest, ManifestAlignment, ManifestFile, Tool, manifest_of, sha256,
};
use crate::pipeline::coupons::prove_coupons;
use crate::pipeline::directory::{refused, sources_of};
use crate::pipeline::{AlignedFault, Built, Forecast, Planned, Sources};
use forecast::drawn::Watch;
use proof::artifact::{KindRequest, Subject, outputs};
use proof::verify;
use proof::verify::{Expected, Finding, FindingCode, Method, OutputFiles, Proof};
use spec::{Code, DrawingSpec, Machine};

/// A gripper whose files have been read back and agree with the design; only it can be published.
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

    /// The files for the verifier.
    pub fn output_files(&self) -> OutputFiles<'_> {
        self.files().collect()
    }

    /// Reads every file back and compares it with the design.
    pub fn proof(&self) -> Proof {
        prove_against(&self.forecast, &self.output_files())
    }

    /// The gripper, ready to be published.
    ///
    /// # Errors
    /// All findings; each is a fault of this program.
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
        let mut kinds = self.built.artifacts.iter().map(|artifact| artifact.output.kind);
        let has_program = kinds.any(|kind| kind.is_program() && kind.subject() == Subject::Seal);
        has_program.then(|| self.built.forecast.programs.iter().map(|program| program.time).sum())
    }

    /// The result of reading back: the compared files and their deviations from the design.
    pub fn proof(&self) -> &Proof {
        &self.proof
    }
}

/// The reference for a directory's files, from its own spec, profile and manifest.
#[derive(Clone, Debug)]
pub struct PublishedBuild {
    forecast: Result<Forecast, Vec<Finding>>,
    /// The manifest, if it is one of a build.
    written: Option<Manifest>,
    /// The manifest, if it is one of coupons.
    coupons: Option<CouponManifest>,
}

impl PublishedBuild {
    /// Reads spec, profile and manifest among `files`.
    pub fn read(files: &OutputFiles<'_>) -> Self {
        let coupons = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice(bytes).ok());
        if coupons.is_some() {
            return Self { forecast: Err(Vec::new()), written: None, coupons };
        }
        let manifest = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice(bytes).ok());
        let aligned = manifest.as_ref().and_then(|manifest: &Manifest| manifest.aligned);
        Self { forecast: forecast_of(files, aligned), written: manifest, coupons: None }
    }

    /// The names of all files that the directory must have; empty if its request is refused.
    pub fn required_names(&self) -> Vec<String> {
        if let Some(coupons) = &self.coupons {
            return coupons.files.iter().map(|entry| entry.path.clone()).collect();
        }
        let request = self.written.as_ref().map_or(KindRequest::default(), Manifest::request);
        let output_lists = self.forecast.iter().map(|forecast| {
            outputs(&forecast.spec, forecast.machine.controller.dialect, &forecast.design, &request)
        });
        output_lists.flatten().map(|output| output.name()).collect()
    }

    /// The length of each file, bytes, as stated in the manifest.
    pub fn stated_sizes(&self) -> impl Iterator<Item = (&str, usize)> {
        let of_coupons = self.coupons.iter().flat_map(|manifest| &manifest.files);
        let files = self.written.iter().flat_map(|manifest| &manifest.files).chain(of_coupons);
        files.map(|entry| (entry.path.as_str(), entry.bytes))
    }

    /// Proves `files` by the same steps as `build`: all of them are made again, and each one that differs by a byte is a finding. Each one
    /// is also read back and compared with the design, whether it is equal or not.
    ///
    /// A directory of another version is judged by reading alone. It is also compared: equal files are proven by that, and a file that
    /// neither reading nor comparison proves is listed.
    pub fn prove(self, files: &OutputFiles<'_>) -> Proof {
        if let Some(coupons) = &self.coupons {
            return prove_coupons(coupons, files);
        }
        if self.written.is_none() && self.forecast.is_ok() && files.names().any(|name| name == MANIFEST) {
            return self.without_manifest(files);
        }
        let forecast = match self.forecast {
            Ok(forecast) => forecast,
            Err(findings) => return Proof { findings, ..Proof::default() },
        };
        let mut proof = prove_claimed(&forecast, self.written.as_ref(), files);
        let [spec, machine] = ["spec.toml", "machine.toml"]
            .map(|name| files.get(name).and_then(|bytes| std::str::from_utf8(bytes).ok()));
        if let (Some(manifest), Some(spec), Some(machine)) = (self.written, spec, machine) {
            let sources = Sources { spec, machine };
            if manifest.tool == Tool::current() {
                compare_anew(&forecast, sources, &manifest.request(), files, &mut proof);
            } else {
                compare_with_other(&forecast, sources, &manifest, files, &mut proof);
            }
        }
        proof
    }

    /// The findings for an unreadable manifest: the fault itself, and files that are not outputs of a build. Without the manifest's lengths no
    /// other file was read, so each would seem empty.
    fn without_manifest(&self, files: &OutputFiles<'_>) -> Proof {
        let right = "the manifest.json of the build: build it again";
        let problem = match files.get(MANIFEST) {
            Some(_) => "it is damaged, or another program wrote it".to_owned(),
            None => files.lacks(MANIFEST, right).found,
        };
        let finding = Finding::new(FindingCode::Manifest, problem, right);
        let wanted_names = self.required_names();
        let is_foreign = |name: &&str| *name != MANIFEST && wanted_names.iter().all(|wanted| wanted != name);
        let foreign = files.names().filter(is_foreign).map(|name| {
            Finding::new(FindingCode::UnnamedFile, "it is not a file of the build", "the files of the build")
                .in_file(name)
        });
        let findings = [finding.in_file(MANIFEST)].into_iter().chain(foreign).collect();
        Proof { findings, ..Proof::default() }
    }
}

/// Makes every file again and compares it with that of `files`, one after the other, so that no two are in memory.
fn compare_anew(
    forecast: &Forecast,
    sources: Sources<'_>,
    request: &KindRequest,
    files: &OutputFiles<'_>,
    proof: &mut Proof,
) {
    let mut entries = Vec::new();
    forecast.make(sources, request, |made| {
        // Equal bytes have equal hashes, and one has been computed already.
        let hash = verify::compare_bytes(&made.name, &made.bytes, files, proof);
        entries.push(ManifestFile::with_hash(&made, hash.unwrap_or_else(|| sha256(&made.bytes))));
    });
    let manifest = forecast.manifest(entries, request).to_json();
    let _ = verify::compare_bytes(MANIFEST, &manifest, files, proof);
}

/// Longest version that is printed, in characters.
const VERSION_LENGTH: usize = 40;

/// Makes every file again and compares it with the file of another version in `files`. A difference is no finding; the part that no reader
/// judges completely is unproven.
fn compare_with_other(
    forecast: &Forecast,
    sources: Sources<'_>,
    manifest: &Manifest,
    files: &OutputFiles<'_>,
    proof: &mut Proof,
) {
    let Tool { name, version } = &manifest.tool;
    let current = Tool::current();
    let writer = if *name == current.name { version.clone() } else { format!("{name} {version}") };
    proof.written_by = Some(writer.chars().take(VERSION_LENGTH).collect());
    let request = manifest.request();
    forecast.make(sources, &request, |made| {
        let _ = verify::mark_equal(&made.name, &made.bytes, files, proof);
    });
    let differs = proof.files.iter().filter(|file| {
        let kind = file.output.kind;
        file.by != Method::Bytes && (kind.is_by_bytes() || kind.subject() == Subject::Prediction)
    });
    let mut unproven: Vec<String> = differs.map(|file| file.path.clone()).collect();
    if other_profile(forecast, files).is_some() {
        unproven.push(format!("machine.toml as the profile {:?}", forecast.spec.machine.profile));
    }
    let prediction = forecast.manifest(Vec::new(), &request).prediction;
    // Models change from version to version: other numbers than those of this version are no finding.
    if prediction.is_some() {
        proof.findings.retain(|finding| {
            finding.code != FindingCode::Prediction.as_str()
                || !is_json(files.get(&finding.file).unwrap_or_default())
        });
    }
    if prediction != manifest.prediction {
        unproven.push(format!("the prediction in {MANIFEST}"));
    }
    proof.unproven = unproven;
}

/// Whether `content` is JSON.
fn is_json(content: &[u8]) -> bool {
    serde_json::from_slice::<serde_json::Value>(content).is_ok()
}

/// Proves an output directory from its files alone: see [`PublishedBuild::prove`].
pub fn prove_files(files: &OutputFiles<'_>) -> Proof {
    PublishedBuild::read(files).prove(files)
}

/// Proves an output directory by reading alone, as [`Built::prove`] does.
pub fn read_back(files: &OutputFiles<'_>) -> Proof {
    match PublishedBuild::read(files) {
        PublishedBuild { coupons: Some(coupons), .. } => prove_coupons(&coupons, files),
        PublishedBuild { forecast: Ok(forecast), written, .. } => {
            prove_claimed(&forecast, written.as_ref(), files)
        }
        PublishedBuild { forecast: Err(findings), .. } => Proof { findings, ..Proof::default() },
    }
}

/// Proves `files` of a directory, whose profile must also agree with its name in the spec: in every value if this version wrote it, else in the
/// dialect, which no version of a profile changes.
fn prove_claimed(forecast: &Forecast, manifest: Option<&Manifest>, files: &OutputFiles<'_>) -> Proof {
    let mut proof = prove_against(forecast, files);
    let is_own = manifest.is_some_and(|manifest| manifest.tool == Tool::current());
    let builtin = Machine::builtin(&forecast.spec.machine.profile).ok();
    let has_other_dialect =
        builtin.is_some_and(|builtin| builtin.controller.dialect != forecast.machine.controller.dialect);
    if is_own || has_other_dialect {
        proof.findings.extend(other_profile(forecast, files));
    }
    proof
}

/// The first difference from this version's profile of the name in the spec, if the directory's profile differs in meaning. A profile of
/// the user's own has no name here, and is not compared.
fn other_profile(forecast: &Forecast, files: &OutputFiles<'_>) -> Option<Finding> {
    let name = &forecast.spec.machine.profile;
    let (builtin, text) = (Machine::builtin(name).ok()?, spec::builtin_machine(name)?);
    let bytes = files.get("machine.toml")?;
    let differs = builtin != forecast.machine;
    differs.then(|| verify::first_difference(bytes, text.as_bytes()).in_file("machine.toml"))
}

fn prove_against(forecast: &Forecast, files: &OutputFiles<'_>) -> Proof {
    let Forecast { spec, machine, design, programs, cuts, prediction, drawn: drawn_forecast, .. } = forecast;
    let manifest = &manifest_of(spec, design, programs, cuts, prediction.as_ref());
    let drawn_json = drawn_forecast.as_ref().map(|drawn_forecast| drawn_forecast.prediction.to_json());
    let prediction = drawn_json.or_else(|| Some(prediction.as_ref()?.to_json()));
    let expected = Expected { design, spec, machine, prediction: prediction.as_deref(), manifest };
    verify::prove(&expected, files)
}

/// The forecast of the directory's own spec and profile.
fn forecast_of(
    files: &OutputFiles<'_>,
    aligned: Option<ManifestAlignment>,
) -> Result<Forecast, Vec<Finding>> {
    let (reading, machine) = sources_of(files)?;
    let drawing = reading.spec.drawing.as_ref().map(DrawingSpec::published_name);
    if let Some(name) = drawing.filter(|name| files.get(name).is_none()) {
        return Err(vec![files.lacks(name, "the file of the build")]);
    }
    let Some(aligned) = aligned else { return Forecast::new(reading.spec, machine).map_err(refused) };
    let planned = Planned::aligned(reading.spec, machine, Some(aligned.sheet), aligned.measured());
    let planned = planned.map_err(|fault| match fault {
        AlignedFault::Refused(refusals) => refused(refusals),
        fault => {
            let allowed = "marks that `align` accepts";
            vec![Finding::new(FindingCode::Manifest, fault.to_string(), allowed).in_file(MANIFEST)]
        }
    })?;
    planned.forecast(&Watch::default()).map_err(refused)
}
