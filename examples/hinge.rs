//! One hinge and the paper's stars through every model, without any file.
//!
//! `cargo run --release --example hinge`

use stargrip_cam::design::Star;
use stargrip_cam::forecast::case::mechanism;
use stargrip_cam::mechanics::hinge::bvp::Bvp;
use stargrip_cam::mechanics::hinge::fit::Fit;
use stargrip_cam::mechanics::hinge::ring::Ring;
use stargrip_cam::mechanics::hinge::{HingeModel, seal_load};
use stargrip_cam::mechanics::star::response::Inflated;
use stargrip_cam::spec::StarSpec;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let bvp = Bvp::default();
    let models: [&dyn HingeModel; 3] = [&Fit, &Ring, &bvp];

    println!("hinge, R* = 0.1");
    for model in models {
        let target = model.target(0.1)?;
        let load = seal_load(0.1, &target).map_or("-".to_owned(), |k| format!("{k:.4}"));
        println!(
            "  {:4}  lambda_t {:.6}  V'' {:.6}  seal load k {load}",
            model.level().name(),
            target.lambda,
            target.curvature
        );
    }

    println!(
        "star, rho_0 = 50 mm, W = 30 mm, phi_i0 = 30 deg, R = 0, 37 kPa: rest angle, rho_f, preload, stiffness"
    );
    for points in 3..=8 {
        let star = mechanism(&Star::new(&StarSpec::paper(points))?);
        for model in models {
            let inflated = Inflated::new(&star, model, 37e3)?;
            let rest = inflated.rest()?;
            println!(
                "  n = {points}  {:4}  {:6.2} deg  {:5.2} mm  {:5.1} N  {:6.0} N/m",
                model.level().name(),
                rest.equilibrium.to_degrees(),
                rest.radius * 1e3,
                rest.preload,
                rest.stiffness
            );
        }
    }
    Ok(())
}
