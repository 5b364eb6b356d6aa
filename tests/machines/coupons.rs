//! Coupons: every program is readable by its controller, heats, and has its own speed and height.

use stargrip_cam::coupon::{Coupon, CouponGroup, StripGrid, read_rows, table};
use stargrip_cam::pipeline::{MadeCoupons, Sources};
use stargrip_cam::spec::{Machine, Source, Spec};
use stargrip_cam::units::{Length, Speed, Temperature};

use crate::{PROFILES, machine, profile, read_for, spec, spec_text, star_text};

/// All coupons, read back like every program.
fn proven(spec: &Spec, machine: &Machine, grid: &StripGrid) -> Vec<Coupon> {
    let groups = CouponGroup::NAMES.map(|(_, group)| group);
    let sources = Sources { spec: "", machine: "" };
    let result = MadeCoupons::new(spec, machine, sources, grid, &groups);
    let coupons = result.unwrap_or_else(|refusals| panic!("{}: {refusals}", machine.name));
    let proven = coupons.prove().unwrap_or_else(|findings| panic!("{}: {findings:#?}", machine.name));
    proven.made_coupons().coupons.clone()
}

#[test]
fn every_coupon_is_sound_in_every_dialect() {
    for name in PROFILES {
        let (spec, machine) = (spec(&star_text(name)), machine(profile(name)));
        let grid = StripGrid {
            temperatures: vec![Temperature(180.0), Temperature(210.0)],
            powers: Vec::new(),
            speeds: vec![Speed(0.1), Speed(0.5)],
            heights: vec![Length(-0.3), Length(-0.1)],
            repeats: 3,
        };
        let set = proven(&spec, &machine, &grid);
        assert_eq!(set.len(), 8 + 3);
        for coupon in &set {
            let program = read_for(&machine, &coupon.gcode());
            assert_eq!(program.findings, [], "{name} {}", coupon.name);
            let low: Vec<_> = program.moves.iter().filter(|step| step.to.z < 4.9).collect();
            let hot = if coupon.name.starts_with("strips-180") { 180.0 } else { 200.0 };
            let hot = if coupon.name.starts_with("strips-210") { 210.0 } else { hot };
            assert!(
                !low.is_empty() && low.iter().all(|step| step.heated == Some(hot)),
                "{name} {}",
                coupon.name
            );
            if coupon.name.starts_with("strips") {
                let height = if coupon.name.ends_with("-z-100um") { -0.1 } else { -0.3 };
                assert!(
                    low.iter().all(|step| step.to.z >= height) && low.iter().any(|step| step.to.z == height)
                );
            }
            assert!(program.moves.iter().all(|step| step.to.x >= -1e-9 && step.to.y >= -1e-9));
        }
        let strips = grid.strips(&machine);
        assert_eq!(strips.len(), 24);
        // The table is not filled in yet.
        assert_eq!(read_rows(&Source::new("results.csv", table(&strips))), Ok(Vec::new()));
    }
}

/// Along X a controller may hold a speed that it cannot hold at 45 degrees: a strip there needs no strokes.
#[test]
fn strips_that_the_controller_holds_go_steadily() {
    let (spec, machine) = (spec(&spec_text("[machine]\nfeed_floor = \"chop\"\n")), machine(profile("grbl")));
    let grid = StripGrid {
        temperatures: vec![Temperature(200.0)],
        powers: Vec::new(),
        speeds: vec![Speed(0.2), Speed(0.5)],
        heights: vec![Length(-0.3)],
        repeats: 3,
    };
    let set = proven(&spec, &machine, &grid);
    let code = |name: &str| set.iter().find(|coupon| coupon.name == name).expect(name).gcode();
    let (slow, fast) = (code("strips-200C-200um-s"), code("strips-200C-500um-s"));
    assert!(slow.contains("\nG4 P") && !fast.contains("\nG4 P") && fast.contains(" F30\n"));
    // Strokes and dwells of one strip give the required speed, to 0.2 %.
    let program = read_for(&machine, &slow);
    let contact = |z: f64| (z + 0.3).abs() < 1e-9;
    let run: Vec<_> = program.moves.iter().filter(|m| contact(m.from.z) && contact(m.to.z)).collect();
    let point = |at: stargrip_cam::verify::gcode::Point3| [at.x, at.y, at.z];
    let moving = run.iter().map(|m| {
        stargrip_cam::verify::stroke_seconds(
            &machine.motion,
            point(m.from),
            point(m.to),
            m.feed.expect("F") / 60.0,
        )
    });
    // Dwells after a move of the run; the ramp down ends with one of its own.
    let waits = program.dwells.iter().filter(|d| run.iter().any(|m| m.line + 1 == d.line));
    let seconds = moving.sum::<f64>() + waits.map(|d| d.seconds).sum::<f64>();
    let length: f64 = run.iter().map(|m| m.length()).sum();
    assert!((seconds * 0.2 / length - 1.0).abs() < 0.002, "{} mm/s", length / seconds);
}

/// A coupon's program has the coupon's name wherever a star's has its number and its loop.
#[test]
fn coupons_do_not_pass_for_stars() {
    let grid = StripGrid {
        temperatures: vec![Temperature(200.0)],
        powers: Vec::new(),
        speeds: vec![Speed(0.5)],
        heights: vec![Length(-0.3)],
        repeats: 3,
    };
    let (spec, machine) = (spec(&spec_text("")), machine(profile("linuxcnc")));
    for coupon in proven(&spec, &machine, &grid) {
        let text = coupon.gcode();
        assert!(
            !text.contains("star=") && !text.contains("loop=") && !text.contains("stars="),
            "{}",
            coupon.name
        );
        assert!(
            text.contains(&format!("; program: purpose=seal piece={}\n", coupon.name)),
            "{}",
            coupon.name
        );
    }
}

/// The mouth of every pouch is that of the hose of the spec.
#[test]
fn pouches_have_a_mouth_for_the_hose_of_the_spec() {
    let grid = StripGrid {
        temperatures: vec![Temperature(200.0)],
        powers: Vec::new(),
        speeds: vec![Speed(0.5)],
        heights: vec![Length(-0.3)],
        repeats: 3,
    };
    for (rest, hose) in
        [("", 4.0), ("[inlet]\ntube_diameter = \"6 mm\"\n", 6.0), ("[inlet]\nnone = true\n", 4.0)]
    {
        let (spec, machine) = (spec(&spec_text(rest)), machine(profile("linuxcnc")));
        let set = proven(&spec, &machine, &grid);
        let mut pouches = 0;
        for seam in set.iter().filter(|coupon| !coupon.is_strips()).flat_map(Coupon::seams) {
            let (start, end) = (seam.run.start().expect("a path"), seam.run.end().expect("a path"));
            let width = start.distance(end) - spec.seal.band.0;
            assert!((width - std::f64::consts::PI * hose / 2.0).abs() < 1e-9, "{}: {width}", seam.name);
            pouches += 1;
        }
        assert_eq!(pouches, 1 + 1 + 5);
    }
}

/// A cut outside of the page is not cut, and one at negative coordinates is off the machine's bed.
#[test]
fn every_cut_lies_on_its_page_and_on_the_bed() {
    let grid = StripGrid {
        temperatures: vec![Temperature(200.0)],
        powers: Vec::new(),
        speeds: vec![Speed(0.5)],
        heights: vec![Length(-0.3)],
        repeats: 3,
    };
    for (star, rest) in [
        ("", ""),
        ("", "[seal]\nallowance = \"12 mm\"\n"),
        ("", "[seal]\nallowance = \"0 mm\"\n"),
        ("tip_angle = \"60 deg\"", ""),
        ("tip_angle = \"5 deg\"", "[seal]\nallowance = \"15 mm\"\n"),
    ] {
        let text = spec_text(rest);
        let text = if star.is_empty() { text } else { text.replace("tip_angle = \"40 deg\"", star) };
        assert!(star.is_empty() || text.contains(star), "{text}");
        let (spec, machine) = (spec(&text), machine(profile("linuxcnc")));
        for coupon in proven(&spec, &machine, &grid) {
            let size = coupon.svg.split_once("viewBox=\"0 0 ").expect("a page").1;
            let size: Vec<f64> = size
                .split('"')
                .next()
                .expect("two")
                .split(' ')
                .filter_map(|side| side.parse().ok())
                .collect();
            for piece in &coupon.pieces {
                let Some(cut) = &piece.shape.cut else { continue };
                let bounds = cut.bounds();
                assert!(
                    bounds.min.x > 0.99 && bounds.min.y > 0.99,
                    "{} {rest} {star}: {bounds:?}",
                    coupon.name
                );
                assert!(
                    bounds.max.x < size[0] && bounds.max.y < size[1],
                    "{} {rest}: {bounds:?}",
                    coupon.name
                );
            }
        }
    }
}
