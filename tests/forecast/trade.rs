//! The shells that `trade` stores are those of this program.

use crate::{close, design};
use stargrip_cam::forecast::drawn::Watch;
use stargrip_cam::forecast::shell::{Detail, star};
use stargrip_cam::forecast::trade::computed::{OPENING, finest, shells};
use stargrip_cam::spec::{Source, read};

/// The star of crates/research/by_shell.py with five points, at 37 kPa.
const STAR: &str = "schema = 1\nname = \"star\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
                    tip_angle = \"30 deg\"\n[load]\npressure = \"37 kPa\"\n";

#[test]
fn a_stored_shell_is_what_the_program_computes() {
    let stored = shells()
        .into_iter()
        .find(|shell| shell.fineness == "coarse" && shell.points == Some(5) && shell.pressure > 36.0)
        .expect("stored");
    let rest = finest().into_iter().find(|star| star.points == 5 && star.pressure > 36.0).expect("stored");
    let spec = read(&Source::new("star.toml", STAR)).expect("valid").spec;
    let object = 1e-3 * rest.radius.value + OPENING * 0.03;
    let watch = Watch::default();
    let (prediction, _) =
        star::predict(&spec, &design(&spec), &[object], Detail::Coarse, &watch).expect("a shell");
    let computed = &prediction.stars[0];
    let errors = computed.evidence.mesh_errors.as_ref().expect("of a shell");
    let force = stored.force.expect("of a star");
    // Stored values are rounded; processors differ in the last digits.
    close(computed.final_radius_mm.expect("at rest"), stored.rest.value, 1e-3);
    close(errors.final_radius_mm, stored.rest.mesh_error, 0.02);
    close(computed.radial_stiffness_N_per_m.expect("at rest"), stored.stiffness.value, 1e-3);
    close(computed.force_curve.as_ref().expect("requested")[0].force.expect("it presses"), force.value, 5e-3);
    assert_eq!(
        computed.evidence.unknowns.as_ref().and_then(|meshes| meshes.last().copied()),
        usize::try_from(stored.unknowns).ok()
    );
}
