//! Stars of woven fabric: half a sector and the whole sheet agree where both are valid.

use super::star::{WHOLE, measure};
use super::star_part::ModelledPart;
use super::tests::tube;
use super::*;
use crate::shell::assembly::Sheet;
use crate::shell::element::Weave;
use crate::shell::mesh::{MarginWidths, Sizes};
use crate::shell::solver::Solver;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// A small star of `points` points.
fn flat(points: u32, shear: f64, warp: f64) -> FlatStar {
    let mut tube = tube(0.03, 500.0);
    tube.fabric = tube.fabric.woven(Weave { shear, warp });
    FlatStar {
        tube,
        points,
        inner_radius: 0.04,
        tip_angle: if points == 4 { 70.0_f64.to_radians() } else { 50.0_f64.to_radians() },
        tip_radius: 0.003,
        corner_radius: 0.003,
        band: 0.002,
        margin: Margin::NONE,
    }
}

/// The values of one coarse mesh of a part, pressurised from flat.
fn measured(case: &FlatStar, part: StarPart) -> [f64; WHOLE] {
    let modelled =
        ModelledPart { part, sector: case.sector().expect("a star"), margin: MarginWidths::default() };
    let meshed = modelled.meshed(&Sizes::across(1.0, 3.0)).expect("a mesh");
    let supports = modelled.supports(&meshed.mesh);
    let mut solver = Solver::new(Sheet::new(&meshed.mesh, case.tube.scaled()), supports).expect("small");
    let equilibrium = case.tube.continuation().run(&mut solver, |_| {}).expect("an equilibrium");
    measure(&modelled, &mut solver, &meshed.mesh, &equilibrium).0
}

#[test]
fn half_a_sector_stands_for_a_star_of_four_points_woven_along_its_planes() {
    for (warp, points, part) in [
        (0.0, 4, StarPart::HalfSector),
        (FRAC_PI_4, 4, StarPart::HalfSector),
        (-FRAC_PI_2, 4, StarPart::HalfSector),
        (0.3, 4, StarPart::Whole),
        (0.0, 5, StarPart::Whole),
        (FRAC_PI_4, 8, StarPart::Whole),
    ] {
        assert_eq!(flat(points, 0.3, warp).part(), part, "{points} {warp}");
        assert_eq!(flat(points, 1.0, warp).part(), StarPart::HalfSector, "{points} {warp}");
    }
}

#[test]
fn the_whole_sheet_is_half_a_sector_unfolded() {
    let case = flat(4, 0.3, FRAC_PI_4);
    let [half, whole] = [StarPart::HalfSector, StarPart::Whole].map(|part| measured(&case, part));
    // Radius, tip angle, volume and stiffness of the star, least and largest radius, the corners' middle, least angle.
    let count = 4.0 * f64::from(case.points);
    assert!((whole[0] / half[0] - 1.0).abs() < 1e-6, "{whole:?} {half:?}");
    assert!((whole[1] / half[1] - 1.0).abs() < 1e-6);
    assert!((2.0 * whole[2] / (count * half[2]) - 1.0).abs() < 1e-6);
    // The compliance is that of Newton's last step, a little before the equilibrium.
    assert!((2.0 * whole[5] / (count * half[5]) - 1.0).abs() < 0.01);
    assert!((whole[6] / half[0] - 1.0).abs() < 1e-6 && (whole[7] / half[0] - 1.0).abs() < 1e-6);
    assert!(whole[8] < 1e-6, "{whole:?}");
    assert!((whole[9] / half[1] - 1.0).abs() < 1e-6);
}

/// A warp at the mirrored angle gives the mirror image of the star, at the angle that a corner's turn leaves the same star.
#[test]
fn a_star_woven_askew_does_not_close_round() {
    let whole = |warp: f64| measured(&flat(3, 0.2, warp), StarPart::Whole);
    let one = whole(0.3);
    for warp in [-0.3, 0.3 + 2.0 * std::f64::consts::PI / 3.0] {
        let other = whole(warp);
        for number in [0, 1, 2, 6, 7, 8, 9] {
            assert!(
                (one[number] - other[number]).abs() < 1e-5 * one[number].abs().max(0.1),
                "{warp} {number}: {one:?} {other:?}"
            );
        }
    }
    assert!(one[7] - one[6] > 1e-4, "{one:?}");
}
