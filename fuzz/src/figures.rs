//! The manifest: any text as one, alone and in the directory of a build.

use stargrip_cam::manifest::{MANIFEST, Manifest};
use stargrip_cam::pipeline::prove_files;

use super::builds::{directories, output_files};
use super::directory::accepted;

/// A manifest that was read is the same when it is written and read again; a directory is proven with its own only.
pub(super) fn manifest(bytes: &[u8]) {
    let Ok(manifest) = serde_json::from_slice::<Manifest>(bytes) else { return };
    let again: Manifest = serde_json::from_slice(&manifest.to_json()).expect("what was written");
    assert_eq!(again.to_json(), manifest.to_json());
    let mut files = directories().last().expect("all").clone();
    let own = files.iter_mut().find(|(name, _)| name == MANIFEST).expect("a manifest");
    own.1 = bytes.to_vec();
    let proof = prove_files(&output_files(&files));
    if proof.findings.is_empty() {
        accepted(&files, &proof);
    }
}
