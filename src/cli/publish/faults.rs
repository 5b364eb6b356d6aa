//! Publishing under injected faults: each operation fails, is the last one, or is preceded by another process's change.
//!
//! The disk is real; [`step`] runs before each operation. After a simulated kill all operations fail, clean-up included.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use tempfile::TempDir;

use crate::cli::publish::disk::DiskStep;
use crate::cli::publish::place::TargetPlace;
use crate::cli::publish::stage::StagedFile;
use crate::cli::publish::{PublishFault, Published, publish_files, retire};
use crate::manifest::{MANIFEST, sha256};

/// The abilities of the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum System {
    /// Exchange two names in one step.
    Exchange,
    /// Only rename.
    Rename,
    /// Neither: something is mounted at the target.
    Mount,
}

const SYSTEMS: [System; 2] = [System::Exchange, System::Rename];

/// The event at one operation.
#[derive(Clone, Copy, Debug)]
enum Event {
    Fails(io::ErrorKind),
    Killed,
    /// A file is put into the target.
    Added,
    /// A file of the target is changed.
    Edited,
}

const EVENTS: [Event; 7] = [
    Event::Fails(io::ErrorKind::StorageFull),
    Event::Fails(io::ErrorKind::PermissionDenied),
    Event::Fails(io::ErrorKind::Other),
    Event::Fails(io::ErrorKind::ResourceBusy),
    Event::Killed,
    Event::Added,
    Event::Edited,
];

/// No event: operation 0 does not exist.
const NOTHING: Event = Event::Fails(io::ErrorKind::Other);

/// The fault injected into one publication.
#[derive(Debug)]
struct Fate {
    version: u8,
    system: System,
    target: PathBuf,
    at: usize,
    event: Event,
    steps: usize,
    /// The text that the other process wrote.
    written: Option<String>,
}

thread_local! {
    static FATE: RefCell<Option<Fate>> = const { RefCell::new(None) };
}

/// Before an operation on `path`.
pub(super) fn step(step: DiskStep, path: &Path) -> io::Result<()> {
    // Counts the operations of one publishing. At the chosen one it fails, ends the process, or lets another process
    // write into the target. The kind of file system decides which operations are refused at all.
    FATE.with_borrow_mut(|fate| {
        let Some(fate) = fate else { return Ok(()) };
        fate.steps += 1;
        match fate.system {
            System::Mount
                if step == DiskStep::Exchange || (step == DiskStep::Rename && path == fate.target) =>
            {
                return Err(io::ErrorKind::ResourceBusy.into());
            }
            System::Rename if step == DiskStep::Exchange => return Err(io::ErrorKind::InvalidInput.into()),
            _ => {}
        }
        match fate.event {
            Event::Fails(kind) if fate.steps == fate.at => Err(kind.into()),
            Event::Killed if fate.steps >= fate.at => Err(io::ErrorKind::Interrupted.into()),
            Event::Added | Event::Edited if fate.steps == fate.at => {
                let added = matches!(fate.event, Event::Added);
                let file = fate.target.join(if added { "notes.txt" } else { "star-1.gcode" });
                if fate.target.is_dir() && file.exists() != added {
                    let text = format!("my work on version {}, {}. ", fate.version, fate.at);
                    let earlier_bytes = if added { Vec::new() } else { fs::read(&file)? };
                    fs::write(file, [&earlier_bytes, text.as_bytes()].concat())?;
                    fate.written = Some(text);
                }
                Ok(())
            }
            _ => Ok(()),
        }
    })
}

/// The files of version `version` of a build: one changes, one stays, one exists in every second version.
fn build(version: u8) -> Vec<StagedFile<'static>> {
    let passing = if version.is_multiple_of(2) { "sheet-1.svg" } else { "sheet-2.svg" };
    let mut files: Vec<StagedFile<'static>> = vec![
        ("machine.toml", Cow::Borrowed(b"the same")),
        ("star-1.gcode", format!("version {version}").into_bytes().into()),
        (passing, Cow::Borrowed(b"passing")),
    ];
    let listed = |(name, bytes): &StagedFile<'_>| serde_json::json!({ "path": name, "bytes": bytes.len(), "sha256": sha256(bytes) });
    let listed: Vec<_> = files.iter().map(listed).collect();
    let manifest = serde_json::json!({ "name": format!("design {version}"), "files": listed });
    files.push((MANIFEST, manifest.to_string().into_bytes().into()));
    files
}

/// Publishes `version`; returns the number of operations, and the text that another process wrote meanwhile.
fn run(
    target: &Path,
    version: u8,
    system: System,
    step: usize,
    event: Event,
) -> (Result<Published, PublishFault>, usize, Option<String>) {
    let fate = Fate { version, system, target: target.to_owned(), at: step, event, steps: 0, written: None };
    FATE.set(Some(fate));
    let result = publish_files(target, &build(version));
    let fate = FATE.take().unwrap();
    (result, fate.steps, fate.written)
}

/// All entries of `directory` that are not hidden.
fn visible(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(directory).into_iter().flatten().map(|entry| entry.unwrap());
    let named = entries.map(|entry| (entry.file_name().into_string().unwrap(), entry.path()));
    let files = named.filter(|(name, path)| !name.starts_with('.') && path.is_file());
    files.map(|(name, path)| (name, fs::read(path).unwrap())).collect()
}

fn is_whole(directory: &Path, version: u8) -> bool {
    let files = build(version).into_iter();
    visible(directory) == files.map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
}

/// Hidden entries beside `target`.
fn leftovers(target: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(target.parent().unwrap()).into_iter().flatten();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.file_name().unwrap().to_string_lossy().starts_with('.')).collect()
}

/// Whether a visible file contains `text`.
fn contains_text(directory: &Path, text: &str) -> bool {
    fs::read_dir(directory).unwrap().map(|entry| entry.unwrap()).any(|entry| {
        let path = entry.path();
        let hidden = entry.file_name().to_string_lossy().starts_with('.');
        !hidden
            && if path.is_dir() {
                contains_text(&path, text)
            } else {
                String::from_utf8_lossy(&fs::read(&path).unwrap()).contains(text)
            }
    })
}

/// Moves the file in the way elsewhere, as the message advises, and publishes again.
fn publish_again(root: &Path, target: &Path, version: u8, system: System) {
    for _ in 0..10 {
        match run(target, version, system, 0, NOTHING).0 {
            Ok(_) => return,
            Err(PublishFault::Foreign(path)) => {
                let desk = (0..100).map(|n| root.join(format!("desk-{n}"))).find(|path| !path.exists());
                fs::rename(path, desk.unwrap()).unwrap();
            }
            Err(fault) => panic!("{fault}"),
        }
    }
    panic!("never done");
}

fn workshop(old_version: Option<u8>) -> (TempDir, PathBuf) {
    // In memory, if possible: a disk takes milliseconds for each sync, and a round has dozens.
    let root = tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap();
    let target = fs::canonicalize(root.path()).unwrap().join("out/star");
    fs::create_dir(root.path().join("out")).unwrap();
    if let Some(version) = old_version {
        assert!(publish_files(&target, &build(version)).is_ok());
    }
    (root, target)
}

/// The number of rounds: `ROUNDS` of the environment, or a few.
fn rounds() -> usize {
    env::var("ROUNDS").ok().and_then(|text| text.parse().ok()).unwrap_or(300)
}

#[test]
fn one_fault_leaves_the_old_build_or_the_new_one() {
    // Publishing is tried with one event at its first operation, then at its second, until it ends before the event.
    // After each, one whole version is in the target, no foreign text is lost, and publishing works again.
    let mut rounds = 0;
    for system in SYSTEMS {
        for event in EVENTS {
            for at in 1.. {
                let (root, target) = workshop(Some(1));
                let (result, steps, foreign_text) = run(&target, 2, system, at, event);
                if at > steps {
                    break;
                }
                rounds += 1;
                let place = TargetPlace::new(&target).unwrap();
                let case = format!("{system:?}, {event:?} at {at} of {steps}: {result:?}");
                match event {
                    Event::Fails(_) => {
                        let version = if result.is_ok() { 2 } else { 1 };
                        assert!(is_whole(&target, version), "{case}: {:?}", visible(&target));
                    }
                    Event::Killed => {
                        let _ = retire::sweep(&place, true).unwrap();
                        assert!(
                            is_whole(&target, 1) || is_whole(&target, 2),
                            "{case}: {:?}",
                            visible(&target)
                        );
                    }
                    Event::Added | Event::Edited => {
                        let text = foreign_text.unwrap_or_default();
                        assert!(
                            text.is_empty() || contains_text(root.path(), &text),
                            "{case}: {text} is lost"
                        );
                    }
                }
                publish_again(root.path(), &target, 3, system);
                assert!(is_whole(&target, 3), "{case}: {:?}", visible(&target));
                assert_eq!(leftovers(&target), Vec::<PathBuf>::new(), "{case}");
            }
        }
    }
    println!("one fault: {rounds} rounds");
    assert!(rounds > 250, "{rounds}");
}

/// A directory that is bound from the same file system is seen only when it is renamed.
#[test]
fn a_target_that_cannot_be_renamed_is_refused_unchanged() {
    let (_root, target) = workshop(Some(1));
    let (result, ..) = run(&target, 2, System::Mount, 0, NOTHING);
    let fault = result.expect_err("a mount point");
    assert!(
        matches!(&fault, PublishFault::Refused(path, why) if *path == target && why.contains("mount point")),
        "{fault}"
    );
    assert!(is_whole(&target, 1), "{:?}", visible(&target));
    assert_eq!(leftovers(&target), Vec::<PathBuf>::new());
}

#[test]
fn a_first_publication_leaves_all_or_nothing() {
    for system in [System::Exchange, System::Rename] {
        for event in [Event::Fails(io::ErrorKind::StorageFull), Event::Killed] {
            for at in 1.. {
                let (root, target) = workshop(None);
                let (result, steps, _) = run(&target, 1, system, at, event);
                if at > steps {
                    break;
                }
                let case = format!("{event:?} at {at}: {result:?}");
                assert!(!target.exists() || is_whole(&target, 1), "{case}");
                assert!(result.is_err() || target.exists(), "{case}");
                if !matches!(event, Event::Killed) && result.is_err() {
                    // A failed removal may leave the directory that it was removing, and nothing else.
                    assert!(leftovers(&target).len() <= usize::from(at == steps), "{case}");
                }
                publish_again(root.path(), &target, 2, system);
                assert!(is_whole(&target, 2) && leftovers(&target).is_empty(), "{case}");
            }
        }
    }
}

/// Long sequences: successive publications, each with its own fault, including faults in the recovery.
#[test]
fn many_faults_lose_nothing() {
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = |below: usize| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        usize::try_from(seed % 1_000_003).unwrap() % below
    };
    for round in 0..rounds() {
        let system = SYSTEMS[random(2)];
        let (root, target) = workshop(Some(1));
        let mut texts = Vec::new();
        let mut lives = Vec::new();
        for life in 0..=random(4) {
            let (step, event) = (1 + random(50), EVENTS[random(7)]);
            let version = u8::try_from(2 + life).unwrap();
            let (result, _, foreign_text) = run(&target, version, system, step, event);
            lives.push(format!("{event:?} at {step}: {result:?}"));
            texts.extend(foreign_text);
        }
        publish_again(root.path(), &target, 9, system);
        assert!(is_whole(&target, 9), "{round}, {system:?}: {lives:#?}");
        assert_eq!(leftovers(&target), Vec::<PathBuf>::new(), "{round}, {system:?}: {lives:#?}");
        for text in texts {
            assert!(contains_text(root.path(), &text), "{round}, {system:?}: {text} is lost: {lives:#?}");
        }
    }
}
