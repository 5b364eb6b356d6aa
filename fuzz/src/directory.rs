//! A whole directory, any of whose files are edited, with a manifest that covers it up.

use stargrip_cam::manifest::{MANIFEST, Manifest, sha256};
use stargrip_cam::pipeline::{Sources, build, prove_files, read_back};
use stargrip_cam::spec;
use stargrip_cam::spec::{FeedFloor, Source};
use stargrip_cam::verify::gcode::{Dialect, read_program};
use stargrip_cam::verify::{Method, Proof};

use super::builds::{Directory, directories, output_files};
use super::edits::{Choices, counted, edited};

/// Edits of up to three files of a directory that was just built, their sizes and hashes put right: each is found, or has no
/// effect. With its bytes compared, only a true build is accepted; by reading alone, only one that leads the iron alike.
pub(super) fn directory(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let which = usize::from(choices.byte()) % directories().len();
    let mut files = directories()[which].clone();
    let edits = 1 + usize::from(choices.byte() % 3);
    for _ in 0..edits {
        let at = choices.below(files.len());
        let covered = !choices.byte().is_multiple_of(4);
        if choices.byte() % 32 == 31 {
            structural(&mut files, at, &mut choices);
            continue;
        }
        let name = files[at].0.clone();
        let mut new = edited(&files[at].1, &mut choices);
        if covered
            && names_a_program(&name)
            && let Ok(text) = std::str::from_utf8(&new)
        {
            new = counted(text).into_bytes();
        }
        files[at].1 = new;
        if covered {
            cover_up(&mut files, &name);
        }
    }
    // A fault that reading finds is also found when the bytes are compared as well.
    if read_back(&output_files(&files)).findings.is_empty() {
        led_alike(&files);
        let proof = prove_files(&output_files(&files));
        if proof.findings.is_empty() {
            accepted(&files, &proof);
        }
    }
}

fn names_a_program(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ["gcode", "ngc"].contains(&ending))
}

/// A file away, twice, or under another's name.
fn structural(files: &mut Directory, at: usize, choices: &mut Choices<'_>) {
    let file = files[at].clone();
    match choices.byte() % 4 {
        0 => drop(files.remove(at)),
        1 => files.push((format!("copy of {}", file.0), file.1)),
        2 => {
            let other = choices.below(files.len());
            let content = files[other].1.clone();
            files[at].1 = content;
        }
        _ => files[at].0 = String::from_utf8_lossy(choices.piece()).into_owned(),
    }
}

/// A directory that is proven with its bytes compared equals, byte by byte, the build of its spec and its profile. Else it states
/// that another version wrote it, and then no file counts as equal.
pub(super) fn accepted(files: &Directory, proof: &Proof) {
    let files = output_files(files);
    let manifest: Manifest =
        serde_json::from_slice(files.get(MANIFEST).expect("a manifest")).expect("one that is read");
    let text = |name| std::str::from_utf8(files.get(name).expect(name)).expect("text");
    let (spec_text, machine_text) = (text("spec.toml"), text("machine.toml"));
    let spec = spec::read(&Source::new("spec.toml", spec_text)).expect("a spec").spec;
    let machine = spec::read_machine(&Source::new("machine.toml", machine_text)).expect("a profile");
    let sources = Sources { spec: spec_text, machine: machine_text };
    let built = build(&spec, &machine, sources, &manifest.request()).expect("a gripper");
    if manifest.tool != built.manifest.tool {
        assert!(proof.files.iter().all(|file| file.by != Method::Bytes), "{:?}", manifest.tool);
        return;
    }
    for (name, right) in built.files() {
        assert!(files.get(name) == Some(right.as_ref()), "{name} was accepted, and differs");
    }
    assert_eq!(files.files.len(), built.files().count(), "and no more files");
}

/// A directory that reading alone accepts leads the iron as its own spec requires: as deep, as fast and as hot, whatever else the
/// edit changed.
fn led_alike(files: &Directory) {
    let files = output_files(files);
    let text = |name| std::str::from_utf8(files.get(name).expect(name)).expect("text");
    let spec = spec::read(&Source::new("spec.toml", text("spec.toml"))).expect("a spec").spec;
    let machine = spec::read_machine(&Source::new("machine.toml", text("machine.toml"))).expect("a profile");
    let dialect = Dialect::for_controller(&machine.controller);
    for (name, _) in
        files.files.iter().filter(|(name, _)| name.ends_with("seal.gcode") || name.ends_with("seal.ngc"))
    {
        let program = read_program(text(name), dialect.clone());
        assert_eq!(program.findings, [], "{name}");
        assert!(
            program.blind.iter().all(|step| step.to[2].is_none_or(|z| z >= machine.process.heights.travel.0))
        );
        let heights = machine.process.heights;
        for step in &program.moves {
            assert!(step.to.z >= heights.contact.0 - 1e-6, "{name}:{}: too deep", step.line);
            if step.from.z.max(step.to.z) <= heights.contact.0 + 1e-6 {
                let feed = step.feed.expect("a feed") / 60.0;
                let chops = spec.machine.feed_floor == FeedFloor::Chop;
                assert!(
                    chops || (feed - spec.seal.speed.0).abs() <= 0.011 * spec.seal.speed.0,
                    "{name}:{}",
                    step.line
                );
                assert!(step.heated.is_some_and(|t| (t - spec.seal.temperature.0).abs() <= 0.5), "{name}");
            }
        }
    }
}

/// Makes the manifest agree with the file called `name`, if both can be read.
fn cover_up(files: &mut Directory, name: &str) {
    let Some((_, bytes)) = files.iter().find(|(known, _)| known == name) else { return };
    let (length, hash) = (bytes.len(), sha256(bytes));
    let Some(at) = files.iter().position(|(known, _)| known == MANIFEST && name != MANIFEST) else { return };
    let Ok(mut manifest) = serde_json::from_slice::<Manifest>(&files[at].1) else { return };
    for entry in manifest.files.iter_mut().filter(|entry| entry.path == name) {
        (entry.bytes, entry.sha256) = (length, hash.clone());
    }
    files[at].1 = manifest.to_json();
}
