//! Each part alone: windows, cut pieces, labels, room on the sheet and the bed.

use crate::assembly::{Box, circles, near};
use crate::support;
use stargrip_cam::artifact::{Kind, Subject};
use stargrip_cam::geom::{Isometry, Vec2};
use std::f64::consts::TAU;

#[test]
fn windows_stay_apart_and_shrink_by_the_creep() {
    for points in [3, 5, 6, 8] {
        for creep in [0.0, 0.5] {
            let text = support::PAPER.replace("points = 5", &format!("points = {points}"));
            let text = format!("{text}\n[mask]\ncreep = \"{creep} mm\"\n");
            let build = support::build(&text).expect("a design");
            let windows = &build.forecast.design.assembly().expect("stars").distinct[0].mask.windows;
            assert_eq!(windows.len(), points);
            for (i, a) in windows.iter().enumerate() {
                assert!(a.area() > 0.0 && a.largest_gap() < 1e-9);
                for b in &windows[i + 1..] {
                    assert!(stargrip_cam::geom::path_distance(a, b) >= 4.0 - 1e-9, "{points} points");
                }
                // The window is its own image, turned by a sector.
                let turn = TAU / f64::from(u32::try_from(points).expect("few"));
                let next = &windows[(i + 1) % points];
                let p = a.start().expect("a path");
                let image = stargrip_cam::geom::Isometry::rotation(turn).point(p);
                assert!(next.distance(image) < 1e-9);
            }
            let wide =
                support::build(&text.replace(&format!("\"{creep} mm\""), "\"0 mm\"")).expect("a design");
            let full = &wide.forecast.design.assembly().expect("stars").distinct[0].mask.windows[0];
            for segment in &windows[0].segments {
                let d = full.distance(segment.point(0.5));
                assert!(d >= creep - 1e-6, "{points} points: {d} from the full window at a creep of {creep}");
            }
        }
    }
}

/// A tool that takes 0.3 mm away runs 0.15 mm inside of a part's cut-outs, and outside of its cut edges.
#[test]
fn what_is_cut_comes_out_as_it_is_drawn() {
    let kerf = "[cut]\nkerf = \"0.3 mm\"\n";
    let cut = support::build(&format!("{}\n{kerf}", support::PAPER)).expect("a design");
    let plain = support::build(support::PAPER).expect("a design");
    let (with, without) = (Box::new(&cut), Box::new(&plain));
    for (subject, outside) in [
        (Subject::Outline, &["cut-outside"][..]),
        (Subject::Mask, &["mask-plate"]),
        (Subject::Frame, &["frame-edge"]),
    ] {
        for ((file, drawn), (_, part)) in with.all(subject).iter().zip(without.all(subject)) {
            for (layer, paths) in drawn.layers.iter().filter(|(layer, _)| *layer != "label") {
                // The sheet is larger by the kerf around the part, so the part lies farther in.
                let shift =
                    if subject == Subject::Outline { Vec2::new(0.15, 0.15) } else { Vec2::new(0.0, 0.0) };
                let move_back = Isometry::translation(-shift);
                for (path, edge) in paths.iter().zip(part.layer(layer)) {
                    for segment in &path.segments {
                        let p = move_back.point(segment.point(0.3));
                        near(edge.distance(p), 0.15);
                        assert_eq!(
                            edge.encloses(p),
                            !outside.contains(&layer.as_str()),
                            "{}: {layer}",
                            file.path
                        );
                    }
                }
            }
        }
    }
    // Printed parts have no kerf.
    for (a, b) in cut.artifacts.iter().zip(&plain.artifacts) {
        if matches!(a.output.kind, Kind::MaskPdf | Kind::MaskStl) {
            assert!(a.bytes == b.bytes, "{}", a.output.name());
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_with_numbers() {
    for (more, key, number) in [
        ("[mask]\nextent = \"90 mm\"\n", "mask.extent", "at most 7"),
        ("[mask]\ncreep = \"20 mm\"\n", "mask.creep", "at most 17.49 mm"),
        ("[stack]\ncount = 2\npitch = \"20 mm\"\n", "stack.pitch", "at least 24.1"),
        ("[frame]\nkerf = \"6 mm\"\n", "frame.kerf", "at most 5.8 mm"),
        ("[cut]\nkerf = \"3 mm\"\n", "cut.kerf", "a registration hole of 3 mm"),
        (
            "[cut]\nkerf = \"40 mm\"\n[sheet]\nhole_diameter = \"0 mm\"\n",
            "cut.kerf",
            "nothing of a coating window",
        ),
        ("[frame]\nposts = 60\n", "frame.posts", "needs 21.2"),
        ("[sheet]\nwidth = \"300 mm\"\n", "sheet.width", "33.04"),
    ] {
        let refusals = support::build(&format!("{}\n{more}", support::PAPER)).expect_err(more);
        let said = refusals.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert!(said.contains(key) && said.contains(number), "{more}: {said}");
    }
}

#[test]
fn a_part_is_turned_only_where_that_is_allowed() {
    let narrow = format!("{}\n[sheet]\nwidth = \"334 mm\"\nheight = \"400 mm\"\n", support::PAPER);
    let tall = narrow.replace("334 mm", "400 mm").replace("height = \"400 mm\"", "height = \"334 mm\"");
    assert!(support::build(&narrow).is_ok());
    let refusals = support::build(&tall).expect_err("336.5 mm high");
    assert!(refusals[0].remedy.contains("`height` at least 336.437 mm"), "{}", refusals[0]);
    let turned = support::build(&format!("{tall}turn = true\n")).expect("turned it fits");
    let proof = stargrip_cam::pipeline::read_back(&turned.output_files());
    assert_eq!(proof.findings, []);
    let rotation = turned.forecast.design.assembly().expect("stars").stars[0].placement.rotation;
    assert!((rotation - TAU / 4.0).abs() < 1e-12);
}

#[test]
fn labels_stand_on_the_fabric_clear_of_seams_and_holes() {
    for points in 3..=8 {
        for allowance in ["2.5 mm", "8 mm", "20 mm"] {
            let text = support::PAPER.replace("points = 5", &format!("points = {points}"));
            let build = support::build(&format!("{text}\n[seal]\nallowance = \"{allowance}\"\n"));
            let Ok(build) = build else { continue };
            let parts = Box::new(&build);
            let (_, sheet) = &parts.all(Subject::Outline)[0];
            let labels = sheet.layer("label");
            let (outside, hole) = (&sheet.layer("cut-outside")[0], &sheet.layer("cut-hole")[0]);
            let placed = &build.forecast.design.assembly().expect("stars").stars[0];
            let [_, tube] = &build.forecast.design.assembly().expect("stars").part(placed).edges;
            let tube = placed.placement.path(tube);
            for label in labels {
                for segment in &label.segments {
                    let p = segment.point(0.5);
                    let where_ = format!("{points} points, {allowance}: {p:?}");
                    assert!(outside.encloses(p) && !hole.encloses(p), "off the fabric: {where_}");
                    assert!(outside.distance(p) > 0.2, "at the cut: {where_}");
                    assert!(tube.distance(p) > 2.0, "on the band: {where_}");
                    for (center, radius) in circles(sheet, "registration") {
                        assert!(center.distance(p) > radius, "in a hole: {where_}");
                    }
                }
            }
            assert!(allowance == "2.5 mm" || !labels.is_empty(), "{points} points, {allowance}");
        }
    }
}

/// Every shipped mask but the basketball's on a common bed.
#[test]
fn pieces_fit_the_bed_and_are_the_plate() {
    let designs = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/designs")).expect("designs/");
    let mut several = 0;
    for path in designs.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file()) {
        let text = std::fs::read_to_string(&path).expect("a design");
        let bed = "[mask]\nbed = \"220 mm x 220 mm\"\n";
        let text = if text.contains("[mask]\n") { text.replace("[mask]\n", bed) } else { text + "\n" + bed };
        let design = stargrip_cam::design::Design::new(&support::read(&text), &support::machine());
        if path.to_string_lossy().contains("basketball") {
            assert_eq!(design.expect_err("too large")[0].code, "small-bed");
            continue;
        }
        let design = design.unwrap_or_else(|refusals| panic!("{}: {refusals:?}", path.display()));
        for part in &design.assembly().expect("stars").distinct {
            let pieces = &part.tiles.tiles;
            several += usize::from(part.tiles.are_several());
            assert!(pieces.iter().flat_map(|piece| piece.size).all(|mm| mm <= 220.0), "{pieces:?}");
            // The size of each piece is that of its edge after it is turned.
            for piece in pieces {
                let bounds = piece.motion(false).path(&piece.edge).bounds();
                assert!((bounds.width() - piece.size[0]).abs() < 1e-9);
                assert!(piece.edge.largest_gap() < 1e-9 && piece.edge.area() > 0.0);
            }
            let area: f64 = pieces.iter().map(|piece| piece.edge.area()).sum();
            let missing = part.mask.plate.area() - area;
            assert!((0.0..1e-3 * part.mask.area(&part.outline)).contains(&missing), "{missing} mm2");
            // Windows stay whole, at least 4 mm of plate around them.
            for window in &part.mask.windows {
                assert!(pieces[0].edge.encloses(window.start().expect("a path")));
                assert!(stargrip_cam::geom::path_distance(&pieces[0].edge, window) >= 4.0 - 1e-9);
            }
            for hole in &part.outline.registration {
                let around = pieces.iter().filter(|piece| piece.edge.encloses(hole.center));
                let least = around.map(|piece| piece.edge.distance(hole.center) - hole.diameter / 2.0);
                assert_eq!(least.clone().count(), 1);
                assert!(least.fold(f64::INFINITY, f64::min) >= 2.5 - 1e-9);
            }
        }
    }
    assert!(several >= 8, "{several}");
}
