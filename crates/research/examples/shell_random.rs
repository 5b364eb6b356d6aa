//! Random shells over the whole supported range: counts those without an equilibrium.
//!
//! `cargo run --release -p research --example shell_random -- 100`: that number of V-actuators, and of stars of 3 to 8, 12 and 16 points.
//! Half of all hinges turn on a point. The inputs of each failure are printed.

#[path = "support/dice.rs"]
mod dice;

use dice::Dice;
use stargrip_cam::shell::cases::{
    Fineness, FlatStar, Margin, Objects, ShellFault, Tube, VActuator, Watch, actuator, star,
};
use stargrip_cam::shell::element::Fabric;
use std::env;
use std::error::Error;
use std::f64::consts::PI;

/// Three meshes, of some 300, 1,000 and 4,000 unknowns a hinge.
const FINENESS: Fineness = Fineness { cells: 4.0, cuts: 2 };
const POINTS: [u32; 8] = [3, 4, 5, 6, 7, 8, 12, 16];

impl Dice {
    fn even(&mut self, [from, to]: [f64; 2]) -> f64 {
        from + (to - from) * self.throw()
    }

    fn log(&mut self, ends: [f64; 2]) -> f64 {
        self.even(ends.map(f64::ln)).exp()
    }

    fn radius(&mut self, width: f64) -> f64 {
        if self.throw() < 0.5 { 0.0 } else { width * self.throw() }
    }

    /// W of 10 to 100 mm, t of 0.05 to 1 mm, 1/eps of 1 to 5,000; t/W at most 0.03 and p W / Y at most 0.1.
    fn tube(&mut self) -> Tube {
        loop {
            let (width, t) = (self.log([0.01, 0.1]), self.log([0.05e-3, 1e-3]));
            let poisson = self.even([0.0, 0.49]);
            let stretch = 128e6 * t;
            let bending = stretch * t * t / (12.0 * (1.0 - poisson * poisson));
            let pressure = self.log([1.0, 5000.0]) * bending / width.powi(3);
            let tube = Tube { width, fabric: Fabric::isotropic(stretch, bending, poisson), pressure };
            if t / width <= 0.03 && tube.stretch() <= 0.1 {
                return tube;
            }
        }
    }

    fn actuator(&mut self) -> VActuator {
        let tube = self.tube();
        let angle = self.even([20.0, 160.0]).to_radians();
        VActuator {
            tube,
            radius: self.radius(tube.width),
            arm_length: tube.width * self.log([2.5, 10.0]),
            angle,
            margin: Margin::NONE,
        }
    }

    /// A star whose arms are half a width long at least.
    fn star(&mut self, points: u32) -> FlatStar {
        loop {
            let tube = self.tube();
            let widest = 160.0 - 360.0 / f64::from(points);
            let tip_angle = self.even([20.0, widest.max(30.0)]).to_radians();
            let (tip_radius, corner_radius) = (self.radius(tube.width), self.radius(tube.width));
            let inner_radius = tube.width * self.log([0.3, 8.0]);
            let (sine, cosine) = (0.5 * tip_angle).sin_cos();
            let reach = (inner_radius + tube.width + corner_radius) * (PI / f64::from(points)).sin();
            let arm = (reach - (tube.width + tip_radius + corner_radius) * cosine) / sine;
            if (0.5..10.0).contains(&(arm / tube.width)) {
                let sharp = FlatStar::sharp(tube, points, inner_radius, tip_angle);
                return FlatStar { tip_radius, corner_radius, ..sharp };
            }
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: u32 = env::args().nth(1).unwrap_or("20".to_owned()).parse()?;
    let mut dice = Dice(5);
    let tell = |what: String, found: Result<(), ShellFault>| match found {
        Ok(()) => 0,
        Err(fault) => {
            println!("{what}: {fault}");
            1
        }
    };
    let mut failed = [0, 0];
    for (number, points) in (1..=wanted).zip(POINTS.into_iter().cycle()) {
        let case = dice.actuator();
        let found = actuator(&case, &[], FINENESS, &Watch::default()).map(|_| ());
        failed[0] += tell(format!("{number}: {case:?}"), found);
        let case = dice.star(points);
        let found = star(&case, Objects::Radii(&[]), FINENESS, &Watch::default()).map(|_| ());
        failed[1] += tell(format!("{number}: {case:?}"), found);
    }
    println!("{wanted} V-actuators, {} not found; {wanted} stars, {} not found", failed[0], failed[1]);
    Ok(())
}
