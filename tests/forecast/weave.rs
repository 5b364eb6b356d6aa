//! Woven fabric: the models that support it, and the warnings of the others.

use std::f64::consts::FRAC_PI_4;

use super::{case, close, gripper, predict};
use stargrip_cam::forecast::case::weave;
use stargrip_cam::forecast::report::text;
use stargrip_cam::forecast::shell::star::{ShellRefusal, flat};
use stargrip_cam::forecast::warning::PredictionWarning;
use stargrip_cam::spec::{ModelChoice, Spec, key};
use stargrip_cam::units::{Angle, LineForce, Pressure};

/// The paper's gripper of fabric with a fifth of the isotropic shear modulus, its warp at `warp` deg.
fn woven(points: u32, warp: f64) -> Spec {
    let mut spec = gripper(points);
    let fabric = &mut spec.fabric;
    let isotropic = fabric.young_modulus.0 / (2.0 * (1.0 + fabric.poisson_ratio));
    (fabric.shear_modulus, fabric.warp) = (Some(Pressure(0.2 * isotropic)), Angle(warp));
    spec
}

#[test]
fn the_shear_modulus_is_a_part_of_that_of_isotropic_fabric() {
    let found = weave(&woven(5, 45.0).fabric).expect("in range");
    close(found.shear, 0.2, 1e-12);
    close(found.warp, FRAC_PI_4, 1e-12);
    assert!(weave(&gripper(5).fabric).expect("in range").is_isotropic());
    // A measured stretch stiffness is that of the isotropic sheet: half of it, and the same G, are twice the part.
    let mut spec = woven(5, 45.0);
    let stretch = spec.fabric.young_modulus.pascals() * spec.fabric.thickness.metres();
    spec.fabric.stretch_stiffness = Some(LineForce::from_newtons_per_metre(stretch / 2.0));
    close(weave(&spec.fabric).expect("in range").shear, 0.4, 1e-12);
}

#[test]
fn the_shell_refuses_a_star_whose_weave_lies_askew() {
    for (points, warp, is_computed) in [(4, 0.0, true), (4, -45.0, true), (4, 20.0, false), (5, 0.0, false)] {
        let spec = woven(points, warp);
        let flat = flat(&case(&spec), weave(&spec.fabric).expect("in range"));
        match flat {
            Ok(_) => assert!(is_computed, "{points} {warp}"),
            Err(ShellRefusal::Fault(fault)) => {
                assert!(!is_computed && fault.key == key::fabric::WARP, "{points} {warp}: {fault:?}");
                let remedy = fault.remedy.expect("a remedy");
                assert!(remedy.contains("remove `shear_modulus`"), "{remedy}");
                assert_eq!(remedy.contains("\"45 deg\""), points == 4, "{remedy}");
            }
            Err(refusal) => panic!("{refusal:?}"),
        }
    }
    // Without a weave every star is computed.
    assert!(flat(&case(&gripper(5)), weave(&gripper(5).fabric).expect("in range")).is_ok());
}

/// Shells close less from 1/eps = 1,500 on only (docs/weave.md).
#[test]
fn a_soft_weave_closes_less_only_where_shells_do() {
    for (pressure, closes_less) in
        [(Some(37.0), true), (Some(20.0), true), (Some(18.0), false), (None, false)]
    {
        let mut spec = gripper(5);
        spec.load.as_mut().expect("a load").pressure = pressure.map(Pressure);
        let page = text(&spec, &predict(&spec), true);
        assert_eq!(page.contains("soft in shear closes less"), closes_less, "{pressure:?}: {page}");
    }
}

#[test]
fn models_of_hinges_leave_it_out_and_say_so() {
    for model in [ModelChoice::Auto, ModelChoice::Section, ModelChoice::Ring, ModelChoice::Fit] {
        let [mut even, mut woven] = [gripper(5), woven(5, 0.0)];
        (even.accuracy.model, woven.accuracy.model) = (model, model);
        let (even, woven) = (predict(&even), predict(&woven));
        assert_eq!(even.first.final_radius_mm, woven.first.final_radius_mm, "{model:?}");
        let said = |warning: &&PredictionWarning| {
            warning.text.starts_with("shear_modulus is not used")
                && warning.text.contains("0.20 of its shear")
        };
        assert_eq!(woven.first.evidence.warnings.iter().filter(said).count(), 1, "{model:?}");
        assert_eq!(even.first.evidence.warnings.iter().filter(said).count(), 0, "{model:?}");
        assert!(woven.first.evidence.weave.is_some_and(|weave| weave.starts_with("not used")));
        assert_eq!(even.first.evidence.weave, None);
    }
}
