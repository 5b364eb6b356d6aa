//! The report on the seal: correct designs are tight, and each seeded leak is found.

use stargrip_cam::airtight::report;
use stargrip_cam::design::{Design, Product, StarAssembly};
use stargrip_cam::geom::Path;
use stargrip_cam::spec::{Source, key, read};

use crate::{machine, profile, spec, spec_text};

fn design(rest: &str) -> (stargrip_cam::spec::Spec, stargrip_cam::spec::Machine, Design) {
    let (spec, machine) = (spec(&spec_text(rest)), machine(profile("generic")));
    let design = Design::new(&spec, &machine).expect("a design");
    (spec, machine, design)
}

#[test]
fn a_design_is_tight_and_its_channel_as_wide_as_the_tube() {
    for rest in ["", "[inlet]\nnone = true\n", "[stack]\ncount = 3\n"] {
        let (spec, machine, design) = design(rest);
        let found = report(&spec, &machine, &design);
        assert_eq!((&found.leaks[..], found.pieces.len()), (&[][..], 1), "{rest}");
        let passage = &found.pieces[0].passage;
        assert!((passage.channel.expect("a hose") - 10.0).abs() < 1e-6, "{passage:?}");
        assert!(passage.starts_apart > Some(20.0) && passage.loops[0].closed);
        assert_eq!(passage.loops[1].closed, rest.contains("none"));
        assert_eq!(passage.inlet.is_some(), !rest.contains("none"));
        assert_eq!(found.to_string().contains("no opening except the inlet"), passage.inlet.is_some());
        assert_eq!(found.to_string().contains("closed all around"), passage.inlet.is_none());
    }
}

/// A hose goes into each of the hand rest's two chambers.
#[test]
fn all_inlets_of_a_piece_are_counted() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/drawings/");
    let text = std::fs::read_to_string(format!("{folder}hand-rest.toml")).expect("a design");
    let bytes = std::fs::read(format!("{folder}hand-rest.svg")).expect("a drawing");
    let reading = read(&Source::new("spec", text.as_str())).unwrap_or_else(|faults| panic!("{faults}"));
    let (spec, machine) = (reading.with_drawing(&bytes).spec, machine(profile("generic")));
    let found = report(&spec, &machine, &Design::new(&spec, &machine).expect("a design"));
    assert!(found.to_string().contains("airtight: no opening except the 2 inlets\n"), "{found}");
}

#[test]
fn every_seeded_leak_is_seen() {
    let (spec, machine, good) = design("");
    let leaks = |change: &dyn Fn(&mut StarAssembly)| {
        let mut bad = good.clone();
        let Product::Stars(assembly) = &mut bad.product else { panic!("no stars") };
        change(assembly);
        report(&spec, &machine, &bad).leaks
    };
    assert!(leaks(&|_| {}).is_empty());
    // The inner loop left open.
    let open = leaks(&|d| d.distinct[0].shape.seams[0].center_line.closed = false);
    assert!(
        open.iter().any(|leak| leak.code == "wrong-opening" && leak.found.contains("open without an inlet")),
        "{open:?}"
    );
    // A piece of a seam missing.
    let gap = leaks(&|d| {
        let _ = d.distinct[0].shape.seams[1].center_line.segments.remove(4);
    });
    assert!(gap.iter().any(|leak| leak.code == "seam-gap" && leak.found.contains("a gap of")), "{gap:?}");
    // A closure without overlap.
    let bare = leaks(&|d| d.distinct[0].shape.seams[0].overlap = 0.0);
    assert!(bare.iter().any(|leak| leak.code == "no-overlap" && leak.key == key::seal::OVERLAP), "{bare:?}");
    assert_eq!(bare[0].key.star(), None, "no star has an overlap of its own");
    // Bands that meet, and seams that cross.
    let wide = leaks(&|d| d.distinct[0].shape.band = 12.0);
    assert!(
        wide.iter().any(|leak| leak.code == "bands-meet" && leak.found.contains("the bands meet")),
        "{wide:?}"
    );
    let cross = leaks(&|d| {
        let moved = stargrip_cam::geom::Isometry::translation(stargrip_cam::geom::Vec2::new(16.0, 0.0));
        let seam = &mut d.distinct[0].shape.seams[0];
        seam.center_line = Path { closed: true, ..moved.path(&seam.center_line) };
    });
    assert!(
        cross.iter().any(|leak| leak.code == "seams-cross" && leak.found.contains("cross or touch")),
        "{cross:?}"
    );
    // A tube that is open although it has no inlet.
    let lost = leaks(&|d| d.distinct[0].shape.ports.clear());
    assert!(
        lost.iter().any(|leak| leak.code == "wrong-opening"
            && leak.found.contains("the outer loop is open without an inlet")),
        "{lost:?}"
    );
}

#[test]
fn a_weak_seal_is_warned_of_with_the_radius_that_would_hold() {
    let strong = design("[fabric]\nseal_strength = \"3 N/mm\"\n[load]\npressure = \"37 kPa\"\n");
    let found = report(&strong.0, &strong.1, &strong.2);
    assert!(found.pieces[0].loads.iter().all(|load| load.weakness().is_none()), "{found:?}");
    let weak = design("[fabric]\nseal_strength = \"1.7 N/mm\"\n[load]\npressure = \"37 kPa\"\n");
    let found = report(&weak.0, &weak.1, &weak.2);
    assert!(found.leaks.is_empty());
    let weak = found.pieces[0].loads.iter().filter_map(stargrip_cam::forecast::seal_load::SealLoad::weakness);
    let at_tips = weak.into_iter().find(|text| text.contains("at the tips")).expect("a warning");
    assert!(at_tips.contains("a radius of") && at_tips.contains("would hold"), "{at_tips}");
    let loads = &found.pieces[0].loads;
    assert!(loads[0].factor > loads[1].factor && loads[1].factor > loads[2].factor, "{loads:?}");
}
