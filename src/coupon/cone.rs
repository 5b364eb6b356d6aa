//! The cone test: a cone pressed down into the star opens it; its vertical load tells the radial force.
//!
//! At each corner the cone (half angle gamma, friction mu) pushes down with `P` and outwards with
//! `P (1 - mu tan(gamma)) / (mu + tan(gamma))`; the plate below carries P, and its friction mu P points
//! inwards, because the corner slides outwards. So the star's own force is
//!
//! ```text
//! F_s = [(1 - mu tan(gamma)) / (mu + tan(gamma)) - mu] P
//! ```
//!
//! The paper prints `+ mu`, which is the balance of a corner that slides inwards on the plate.

use crate::mechanics::fault::StarFault;
use std::fmt::Write;

/// Which balance of forces reduces the test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Balance {
    /// The plate's friction opposes the opening.
    #[default]
    Derived,
    /// As printed in the paper.
    Published,
}

/// The cone of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Half the cone's angle gamma, rad, in (0, pi/2).
    pub half_angle: f64,
    /// Kinetic friction mu with cone and plate, 0 or more.
    pub friction: f64,
}

impl Cone {
    /// The cone, checked.
    ///
    /// # Errors
    /// If the angle or the friction is out of range, or friction locks the cone (`mu tan(gamma) >= 1`).
    pub fn new(half_angle: f64, friction: f64) -> Result<Self, StarFault> {
        let need = |holds: bool, symbol, found, allowed| {
            if holds { Ok(()) } else { Err(StarFault::Dimension { symbol, found, allowed }) }
        };
        let acute = half_angle > 0.0 && half_angle < std::f64::consts::FRAC_PI_2;
        need(acute, "gamma", half_angle, "above 0 and below pi/2 (in rad)")?;
        let slides = friction >= 0.0 && friction * half_angle.tan() < 1.0;
        need(slides, "mu", friction, "0 or more, and below 1 / tan(gamma)")?;
        Ok(Self { half_angle, friction })
    }

    /// Radial force per vertical load, F_s / P.
    pub fn ratio(&self, balance: Balance) -> f64 {
        let (tan, mu) = (self.half_angle.tan(), self.friction);
        let cone = (1.0 - mu * tan) / (mu + tan);
        match balance {
            Balance::Derived => cone - mu,
            Balance::Published => cone + mu,
        }
    }

    /// Radius (m) at which the corners touch the cone after a travel of `travel` (m) from first contact at `first` (m).
    pub fn radius(&self, first: f64, travel: f64) -> f64 {
        first + travel * self.half_angle.tan()
    }
}

/// What a prediction says of a radius (m): the radial force, N, of linear hinges and of the model's own.
pub type Overlay<'a> = &'a dyn Fn(f64) -> [Option<f64>; 2];

/// Reduces a test's CSV (a header, then travel in mm and vertical load in N) to radius and radial force.
///
/// `first` is the radius (m) at first contact, where the travel is 0. With `overlay` two columns of predicted force
/// are added; they are empty where the star cannot be.
///
/// # Errors
/// One sentence with the line, if one is not two finite numbers.
pub fn reduce(
    csv: &str,
    cone: &Cone,
    balance: Balance,
    first: f64,
    overlay: Option<Overlay<'_>>,
) -> Result<String, String> {
    let mut out = String::from("travel_mm,load_N,radius_mm,force_N");
    out.push_str(if overlay.is_some() { ",linear_N,nonlinear_N\n" } else { "\n" });
    let ratio = cone.ratio(balance);
    let mut found = false;
    for (line, number) in csv.lines().zip(1_usize..) {
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let mut fields = line.split([',', ';', '\t']).map(|field| field.trim().parse::<f64>());
        let (Some(Ok(travel)), Some(Ok(load))) = (fields.next(), fields.next()) else {
            if !found && number == 1 {
                continue;
            }
            return Err(format!("line {number}: `{line}` is not a travel in mm and a load in N"));
        };
        if !(travel.is_finite() && load.is_finite()) {
            return Err(format!("line {number}: `{line}` is not finite"));
        }
        found = true;
        let radius = cone.radius(first, travel * 1e-3);
        let _ = write!(out, "{travel},{load},{:.6},{:.6}", radius * 1e3, ratio * load);
        for force in overlay.map_or([None; 2], |overlay| overlay(radius)).iter().filter(|_| overlay.is_some())
        {
            let _ = match force {
                Some(force) => write!(out, ",{force:.6}"),
                None => write!(out, ","),
            };
        }
        out.push('\n');
    }
    if found { Ok(out) } else { Err("there are no rows of travel and load".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_is_reduced_line_by_line() {
        let cone = Cone::new(30.0_f64.to_radians(), 0.1).expect("valid");
        let csv = "travel_mm,load_N\n0,0\n10,2.5\n";
        let plain = reduce(csv, &cone, Balance::Derived, 0.015, None).expect("two rows");
        assert_eq!(plain.lines().nth(2), Some("10,2.5,20.773503,3.227761"));
        let overlay = |radius: f64| [Some(radius * 100.0), None];
        let laid = reduce(csv, &cone, Balance::Published, 0.015, Some(&overlay)).expect("two rows");
        assert_eq!(laid.lines().next(), Some("travel_mm,load_N,radius_mm,force_N,linear_N,nonlinear_N"));
        assert_eq!(laid.lines().nth(1), Some("0,0,15.000000,0.000000,1.500000,"));
    }

    #[test]
    fn a_bad_line_is_named() {
        let cone = Cone::new(0.5, 0.1).expect("valid");
        let fault = |csv| reduce(csv, &cone, Balance::Derived, 0.01, None).expect_err("refused");
        assert!(fault("a,b\n1,2\nx,3\n").starts_with("line 3"));
        assert!(
            fault("a,b\n1,NaN\n").starts_with("line 2") && fault("a,b\n").starts_with("there are no rows")
        );
    }

    #[test]
    fn balances_of_the_papers_cone() {
        let cone = Cone::new(30.0_f64.to_radians(), 0.1).expect("valid");
        let (derived, published) = (cone.ratio(Balance::Derived), cone.ratio(Balance::Published));
        assert!((published - derived - 0.2).abs() < 1e-15);
        assert!((published - 1.491).abs() < 1e-3, "{published}");
    }

    #[test]
    fn without_friction_it_is_a_wedge() {
        let cone = Cone::new(0.4, 0.0).expect("valid");
        for balance in [Balance::Derived, Balance::Published] {
            assert!((cone.ratio(balance) - 1.0 / 0.4_f64.tan()).abs() < 1e-15);
        }
        assert!((cone.radius(0.02, 0.01) - (0.02 + 0.01 * 0.4_f64.tan())).abs() < 1e-15);
    }

    #[test]
    fn a_cone_that_locks_is_refused() {
        assert!(
            Cone::new(0.5, 2.0).is_err()
                && Cone::new(0.5, -0.1).is_err()
                && Cone::new(0.5, f64::NAN).is_err()
        );
        assert!(Cone::new(0.0, 0.1).is_err() && Cone::new(1.6, 0.1).is_err());
    }
}
