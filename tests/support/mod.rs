//! Code that the tests of whole designs share: random stars, and builds of them.
#![allow(dead_code, unreachable_pub, reason = "every test binary uses some of it")]

pub mod dice;
pub mod inputs;
pub mod keys;
pub mod program;
pub mod zip;

use std::f64::consts::PI;

use proptest::prelude::*;

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::Refusals;
use stargrip_cam::manifest::{MANIFEST, Manifest, sha256};
use stargrip_cam::pipeline::{Built, Sources};
use stargrip_cam::spec::{Machine, Source, Spec};
use stargrip_cam::verify::OutputFiles;
use stargrip_cam::{pipeline, spec};

/// A star that exists, by its arm length instead of its inner radius; lengths in mm, angles in deg.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub n: u32,
    pub phi_i: f64,
    pub w: f64,
    pub l: f64,
    pub r_i: f64,
    pub r_e: f64,
}

impl Shape {
    /// The inner radius that gives this arm length; below 0 such a star does not exist.
    pub fn rho_0(&self) -> f64 {
        let half = (self.phi_i / 2.0).to_radians();
        let reach = self.l * half.sin() + (self.w + self.r_i + self.r_e) * half.cos();
        reach / (PI / f64::from(self.n)).sin() - self.w - self.r_e
    }

    /// The required part of a spec.
    pub fn toml(&self) -> String {
        let Self { n, phi_i, w, r_i, r_e, .. } = self;
        format!(
            "schema = 1\nname = \"random\"\n[star]\npoints = {n}\ninner_radius = \"{} mm\"\ntube_width = \"{w} mm\"\n\
             tip_angle = \"{phi_i} deg\"\ntip_radius = \"{r_i} mm\"\ncorner_radius = \"{r_e} mm\"\n",
            self.rho_0()
        )
    }
}

/// Stars from about 20 mm to 2 m across, with 3 to 64 points; sharp and round hinges.
pub fn shapes() -> impl Strategy<Value = Shape> {
    let angle = (3_u32..=64).prop_flat_map(|n| (Just(n), 2.0..(178.0 - 360.0 / f64::from(n)).max(3.0)));
    let radius = || prop_oneof![Just(0.0), 0.0..1.0_f64];
    (angle, -0.3..1.3_f64, 0.2..6.0_f64, radius(), radius())
        .prop_map(|((n, phi_i), size, arm, r_i, r_e)| {
            let w = 30.0 * 10.0_f64.powf(size);
            Shape { n, phi_i, w, l: arm * w, r_i: r_i * w, r_e: r_e * w }
        })
        .prop_filter("a hole to grip in", |shape| shape.rho_0() > 0.1 * shape.w)
}

/// Reads a spec that must be valid.
pub fn read(text: &str) -> Spec {
    spec::read(&Source::new("test", text)).unwrap_or_else(|faults| panic!("{faults}")).spec
}

/// The text of the generic machine's profile.
pub fn generic() -> &'static str {
    spec::builtin_machine("generic").expect("built in")
}

/// The generic machine.
pub fn machine() -> Machine {
    Machine::builtin("generic").expect("built in")
}

/// Builds a spec that must be valid; the design may be refused.
pub fn build(text: &str) -> Result<Built, Refusals> {
    pipeline::build(
        &read(text),
        &machine(),
        Sources { spec: text, machine: generic() },
        &KindRequest::default(),
    )
}

/// Builds a spec that must have a design, with these kinds beside those that come by default.
pub fn build_with(text: &str, extras: &[Kind]) -> Built {
    let request = KindRequest { with: extras.to_vec(), ..KindRequest::default() };
    pipeline::build(&read(text), &machine(), Sources { spec: text, machine: generic() }, &request)
        .expect("a design")
}

/// The files of `build`, to be changed.
pub fn files_of(build: &Built) -> OutputFiles<'static> {
    build.files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
}

/// Gives the file `name` other bytes.
pub fn replace(files: &mut OutputFiles<'static>, name: &str, bytes: Vec<u8>) {
    let entry = files.files.iter_mut().find(|(file, _)| file == name).expect("a file");
    entry.1 = bytes.into();
}

/// Makes the manifest agree with the files.
pub fn reseal(files: &mut OutputFiles<'static>) {
    let mut manifest: Manifest = serde_json::from_slice(files.get(MANIFEST).expect("one")).expect("JSON");
    for entry in &mut manifest.files {
        let bytes = files.get(&entry.path).expect("a file");
        (entry.bytes, entry.sha256) = (bytes.len(), sha256(bytes));
    }
    replace(files, MANIFEST, manifest.to_json());
}

/// The paper's five-point star.
pub const PAPER: &str = include_str!("../../designs/paper-five-points.toml");
