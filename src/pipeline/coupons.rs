//! Coupons in the pipeline: planned, read back, and only then published.

use crate::airtight;
use crate::coupon::{
    Coupon, CouponGroup, PressGrid, StripGrid, coupons, overview, press_drawings, press_table, table,
};
use crate::emit;
use crate::manifest::{CouponChoice, CouponManifest, MANIFEST, ManifestFile, Tool, coupon_piece, sha256};
use crate::pipeline::directory::{refused, sources_of};
use crate::pipeline::{PACKAGE_ENDING, Sources};
use design::{Refusal, Refusals};
use geom::Path;
use proof::artifact::{Artifact, Kind, Output, program_ending, takes_packages};
use proof::verify;
use proof::verify::{
    FileProof, Finding, FindingCode, Findings, Method, OutputFiles, ProgramTask, ProgramWork, Proof,
    program_in,
};
use spec::units::{Duration, Length, Percent, Speed, Temperature};
use spec::{Machine, Spec};
use std::borrow::Cow;

/// Every strip with its setting and its cut.
pub const OVERVIEW: &str = "strips.svg";
/// The table to fill in; it is not part of the proof.
pub const TABLE: &str = "results.csv";

/// Largest number of strips that a manifest may state.
const MOST_STRIPS: usize = 10_000;

/// Coupons with their files, in memory, not read back yet.
#[derive(Clone, Debug)]
pub struct MadeCoupons {
    /// Every program of the set.
    pub coupons: Vec<Coupon>,
    /// Every file but the manifest and the table.
    pub files: Vec<Artifact>,
    /// The table to fill in; `None` without strips.
    pub table: Option<String>,
    /// The manifest of the files.
    pub manifest: CouponManifest,
}

/// Coupons whose files have been read back; only they can be published.
#[derive(Clone, Debug)]
pub struct ProvenCoupons(MadeCoupons);

impl MadeCoupons {
    /// The coupons of `groups` with the strips of `grid`.
    ///
    /// # Errors
    /// If the machine cannot seal one of them, if the hose fits none, or if a pouch would leak.
    pub fn new(
        spec: &Spec,
        machine: &Machine,
        sources: Sources<'_>,
        grid: &StripGrid,
        groups: &[CouponGroup],
    ) -> Result<Self, Refusals> {
        let coupon_list = coupons(spec, machine, grid, groups)?;
        let leaks = coupon_list.iter().flat_map(|coupon| &coupon.pieces).flat_map(|piece| {
            let leaks = airtight::shape_leaks(&piece.shape, false).into_iter();
            leaks.map(|leak| Refusal { found: format!("{}: {}", piece.name, leak.found), ..leak })
        });
        leaks.collect::<Refusals>().or_value(())?;
        let mut files = vec![
            file("spec.toml", Kind::Spec, sources.spec),
            file("machine.toml", Kind::Machine, sources.machine),
        ];
        let ending = program_ending(machine.controller.dialect);
        for coupon in &coupon_list {
            let program = coupon.gcode();
            files.push(file(&format!("{}.{ending}", coupon.name), Kind::SealGcode, program.as_str()));
            if takes_packages(machine.controller.dialect) {
                let (name, output) =
                    (format!("{}.{ending}{PACKAGE_ENDING}", coupon.name), Output::new(Kind::Seal3mf));
                let bytes = emit::package(&program, coupon.program.time);
                files.extend(bytes.map(|bytes| Artifact { output, name, bytes }));
            }
            files.push(file(&format!("{}.svg", coupon.name), Kind::SealSvg, coupon.svg.as_str()));
        }
        let has_strips = groups.contains(&CouponGroup::Strips);
        let strips = if has_strips { grid.strips(machine) } else { Vec::new() };
        if has_strips {
            files.push(file(OVERVIEW, Kind::SealSvg, overview(spec, grid, &strips)));
        }
        let coupon_manifest = manifest(spec, grid, groups, &coupon_list, &files);
        Ok(Self {
            coupons: coupon_list,
            files,
            table: has_strips.then(|| table(&strips)),
            manifest: coupon_manifest,
        })
    }

    /// The strips of `grid` for the heat press of `spec`: drawings of fabric and paper, without programs.
    pub fn pressed(spec: &Spec, sources: Sources<'_>, grid: &PressGrid) -> Self {
        let mut files = vec![
            file("spec.toml", Kind::Spec, sources.spec),
            file("machine.toml", Kind::Machine, sources.machine),
        ];
        let drawings = press_drawings(spec, grid);
        files.extend(drawings.into_iter().map(|(name, text)| file(name, Kind::SealSvg, text)));
        let manifest = CouponManifest {
            tool: Tool::current(),
            name: spec.name.clone(),
            coupons: CouponChoice {
                temperatures: grid.temperatures.iter().map(|temperature| temperature.0).collect(),
                powers: Vec::new(),
                speeds: Vec::new(),
                heights: Vec::new(),
                times: grid.times.iter().map(|time| time.0).collect(),
                repeats: grid.repeats,
                only: vec!["strips".to_owned()],
                process: None,
            },
            files: files.iter().map(ManifestFile::new).collect(),
            pieces: Vec::new(),
        };
        Self { coupons: Vec::new(), files, table: Some(press_table(spec, grid)), manifest }
    }

    /// These coupons, which are sealed by the process called `name` in the place of `[seal]`.
    #[must_use]
    pub fn of_process(mut self, name: Option<String>) -> Self {
        self.manifest.coupons.process = name;
        self
    }

    /// The coupons, ready to be published.
    ///
    /// # Errors
    /// All findings; each is a fault of this program.
    pub fn prove(self) -> Result<ProvenCoupons, Vec<Finding>> {
        let findings = self.proof(&self.manifest, &self.output_files()).findings;
        if findings.is_empty() { Ok(ProvenCoupons(self)) } else { Err(findings) }
    }

    /// The files and the manifest for the verifier.
    fn output_files(&self) -> OutputFiles<'_> {
        let manifest = (MANIFEST, Cow::from(self.manifest.to_json()));
        let files = self.files.iter().map(|file| (file.name.as_str(), Cow::from(&file.bytes)));
        files.chain([manifest]).collect()
    }

    /// Reads every program among `files`, whose manifest is `manifest`, and compares all files with these.
    fn proof(&self, manifest: &CouponManifest, files: &OutputFiles<'_>) -> Proof {
        let mut proof = Proof::default();
        if manifest.tool != Tool::current() {
            proof.written_by = Some(manifest.tool.version.clone());
        }
        for file in &self.files {
            let mut findings = Findings::default();
            if let Some(bytes) = files.get(&file.name) {
                self.judge(file, bytes, manifest, &mut findings, &mut proof);
            } else {
                findings.push(files.lacks(&file.name, &format!("the {}", file.output.kind)));
            }
            let findings = findings.into_vec().into_iter();
            proof.findings.extend(findings.map(|finding| finding.in_file(&file.name)));
        }
        let mut listed_names = vec![MANIFEST, TABLE];
        listed_names.extend(self.files.iter().map(|file| &*file.name));
        for name in files.names().filter(|name| !listed_names.contains(name)) {
            let problem = "a file that the coupons do not have";
            let finding = Finding::new(FindingCode::UnnamedFile, problem, "only their files");
            proof.findings.push(finding.in_file(name));
        }
        let (written_bytes, right) = (files.get(MANIFEST).unwrap_or_default(), self.manifest.to_json());
        if proof.findings.is_empty() && proof.written_by.is_none() && written_bytes != right.as_slice() {
            proof.findings.push(verify::first_difference(written_bytes, &right).in_file(MANIFEST));
        }
        proof
    }

    /// Compares one file with `written_bytes`, and reads it if it is a program.
    fn judge(
        &self,
        Artifact { output, name, bytes }: &Artifact,
        written_bytes: &[u8],
        manifest: &CouponManifest,
        findings: &mut Findings,
        proof: &mut Proof,
    ) {
        let (kind, sha256) = (output.kind, sha256(written_bytes));
        let stated =
            manifest.files.iter().find(|entry| entry.path == *name).map(|entry| entry.sha256.as_str());
        if stated != Some(sha256.as_str()) {
            let stated = stated.unwrap_or("named in the manifest");
            findings.add(FindingCode::Hash, sha256.clone(), stated);
        }
        let is_of =
            |coupon: &&Coupon| name.strip_prefix(&coupon.name).is_some_and(|rest| rest.starts_with('.'));
        let coupon = self.coupons.iter().find(is_of).filter(|_| kind.is_program());
        let deviation = coupon.and_then(|coupon| {
            let program = if kind == Kind::Seal3mf {
                Cow::from(program_in(written_bytes, findings)?)
            } else {
                String::from_utf8_lossy(written_bytes)
            };
            Some(coupon_task(coupon).check(&program, findings))
        });
        let equal = written_bytes == bytes;
        if !equal && proof.written_by.is_none() {
            findings.push(verify::first_difference(written_bytes, bytes));
        } else if !equal && coupon.is_none() {
            proof.unproven.push(name.clone());
        }
        let method = match (equal, coupon) {
            // Spec and profile are inputs: they are not made again.
            _ if kind.is_source() => Method::Hash,
            (true, _) => Method::Bytes,
            (false, Some(_)) => Method::Reading,
            (false, None) => Method::Hash,
        };
        proof.files.push(FileProof { path: name.clone(), output: *output, by: method, sha256, deviation });
    }
}

fn file(name: &str, kind: Kind, text: impl Into<Vec<u8>>) -> Artifact {
    Artifact { output: Output::new(kind), name: name.to_owned(), bytes: text.into() }
}

impl ProvenCoupons {
    /// The coupons and their files.
    pub fn made_coupons(&self) -> &MadeCoupons {
        &self.0
    }

    /// Whether a laser makes them.
    pub fn is_of_laser(&self) -> bool {
        !self.0.manifest.coupons.powers.is_empty()
    }

    /// All files with their names; the table and the manifest are last.
    pub fn files(&self) -> Vec<(&str, Vec<u8>)> {
        let MadeCoupons { files, table, manifest, .. } = &self.0;
        let table = table.iter().map(|table| (TABLE, table.clone().into_bytes()));
        let files = files.iter().map(|file| (file.name.as_str(), file.bytes.clone()));
        files.chain(table).chain(std::iter::once((MANIFEST, manifest.to_json()))).collect()
    }
}

/// Proves a directory of coupons from its files alone: they are made again from its spec, its profile and the settings in its manifest.
pub(super) fn prove_coupons(manifest: &CouponManifest, files: &OutputFiles<'_>) -> Proof {
    let (reading, machine) = match sources_of(files) {
        Ok(sources) => sources,
        Err(findings) => return failed(findings),
    };
    let text = |name| files.get(name).and_then(|bytes| std::str::from_utf8(bytes).ok()).unwrap_or_default();
    let sources = Sources { spec: text("spec.toml"), machine: text("machine.toml") };
    if reading.spec.press.is_some() {
        return match press_settings_of(&manifest.coupons) {
            Some(grid) => MadeCoupons::pressed(&reading.spec, sources, &grid).proof(manifest, files),
            None => other_settings(),
        };
    }
    let Some((grid, groups)) = settings_of(&manifest.coupons, &machine) else {
        return other_settings();
    };
    let process = manifest.coupons.process.as_deref();
    let process = process.map(|name| reading.spec.process(name));
    let spec = process.as_ref().map_or(reading.spec.clone(), |process| reading.spec.sealed_by(process));
    match MadeCoupons::new(&spec, &machine, sources, &grid, &groups) {
        Ok(made) => made.of_process(process.map(|process| process.name)).proof(manifest, files),
        Err(refusals) => failed(refused(refusals)),
    }
}

/// The settings of a press in a manifest; `None` if `coupon` would refuse them.
fn press_settings_of(choice: &CouponChoice) -> Option<PressGrid> {
    let grid = PressGrid {
        temperatures: choice.temperatures.iter().copied().map(Temperature).collect(),
        times: choice.times.iter().copied().map(Duration).collect(),
        repeats: choice.repeats,
    };
    let strips = choice.temperatures.len().checked_mul(choice.times.len())?.checked_mul(choice.repeats)?;
    let is_possible = (1..=MOST_STRIPS).contains(&strips) && choice.repeats <= 20 && grid.refusal().is_none();
    is_possible.then_some(grid)
}

/// The settings and groups of a manifest; `None` if `coupon` would refuse them.
fn settings_of(choice: &CouponChoice, machine: &Machine) -> Option<(StripGrid, Vec<CouponGroup>)> {
    let CouponChoice { temperatures, powers, speeds, heights, repeats, .. } = choice;
    let lengths = [temperatures.len().checked_add(powers.len())?, speeds.len(), heights.len()];
    let strips = lengths.iter().try_fold(*repeats, |strips, length| strips.checked_mul(*length))?;
    let group =
        |name: &String| CouponGroup::NAMES.iter().find(|(known, _)| known == name).map(|(_, group)| *group);
    let groups = choice.only.iter().map(group).collect::<Option<_>>()?;
    let grid = StripGrid {
        temperatures: temperatures.iter().copied().map(Temperature).collect(),
        powers: powers.iter().copied().map(Percent).collect(),
        speeds: speeds.iter().copied().map(Speed).collect(),
        heights: heights.iter().copied().map(Length).collect(),
        repeats: *repeats,
    };
    // Without a setting there is no strip.
    let right = (1..=MOST_STRIPS).contains(&strips) && *repeats <= 20 && grid.refusal(machine).is_none();
    right.then_some((grid, groups))
}

/// The task that the program of a coupon must perform.
fn coupon_task(coupon: &Coupon) -> ProgramTask<'_> {
    let Coupon { name, spec, machine, .. } = coupon;
    ProgramTask {
        spec,
        machine,
        work: ProgramWork::Seal,
        scope: format!("piece={name}"),
        seams: coupon.seams(),
        job: coupon.job(),
        frame: Path::default(),
        area: coupon.area(),
        marks: Vec::new(),
        motion: None,
    }
}

fn manifest(
    spec: &Spec,
    grid: &StripGrid,
    groups: &[CouponGroup],
    coupons: &[Coupon],
    files: &[Artifact],
) -> CouponManifest {
    let named_groups = CouponGroup::NAMES.iter().filter(|(_, group)| groups.contains(group));
    CouponManifest {
        tool: Tool::current(),
        name: spec.name.clone(),
        coupons: CouponChoice {
            temperatures: grid.temperatures.iter().map(|t| t.0).collect(),
            powers: grid.powers.iter().map(|power| power.0).collect(),
            speeds: grid.speeds.iter().map(|v| v.0).collect(),
            heights: grid.heights.iter().map(|h| h.0).collect(),
            times: Vec::new(),
            repeats: grid.repeats,
            only: named_groups.map(|(name, _)| (*name).to_owned()).collect(),
            process: None,
        },
        files: files.iter().map(ManifestFile::new).collect(),
        pieces: coupons.iter().map(|coupon| coupon_piece(&coupon.name, &coupon.program)).collect(),
    }
}

/// The proof of a directory that cannot be made again.
fn failed(findings: Vec<Finding>) -> Proof {
    Proof { findings, ..Proof::default() }
}

/// The proof of a directory whose manifest has settings that no `coupon` takes.
fn other_settings() -> Proof {
    let finding = Finding::new(FindingCode::Manifest, "other settings", "settings that `coupon` takes");
    failed(vec![finding.in_file(MANIFEST)])
}
