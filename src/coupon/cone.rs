//! The cone test: a cone pressed down into the star opens it; its vertical load gives the radial force.
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
//!
//! Where a balance leaves no force outwards the cone **locks**: by the derived one from `mu = (1 - sin(gamma)) / cos(gamma)` on,
//! because the plate's friction then bears all that the cone pushes; by the paper's from `mu = 1 / tan(gamma)` on.

use std::fmt::Write;

use crate::coupon::table::{TableColumn, read_table};
use spec::units::Readable;
use spec::{Allowed, Fault, FaultCode, Faults, Source};

/// Range of a travel, mm.
const TRAVELS: [f64; 2] = [-1e5, 1e5];

/// The columns of a test; `travel` is 0 at first contact.
const COLUMNS: [TableColumn; 2] = [
    TableColumn {
        names: &["travel", "displacement", "extension"],
        unit: "mm",
        allowed: Allowed::closed(TRAVELS[0], TRAVELS[1]),
        optional: false,
        slip: "convert um to mm",
    },
    TableColumn {
        names: &["load"],
        unit: "N",
        allowed: Allowed::closed(-1e6, 1e6),
        optional: false,
        slip: "convert mN to N",
    },
];

/// The balance of forces that reduces the test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Balance {
    /// The plate's friction opposes the opening.
    #[default]
    Derived,
    /// As printed in the paper.
    Published,
}

impl Balance {
    /// Every balance, by its name.
    pub const ALL: [(&'static str, Self); 2] = [("derived", Self::Derived), ("published", Self::Published)];

    /// The least friction at which a cone of half the angle `half_angle` (rad) locks.
    ///
    /// With `mu = tan(phi)` the cone pushes outwards with `P / tan(gamma + phi)`. This is `mu P` where `gamma + 2 phi` is a
    /// right angle, and 0 where `gamma + phi` is.
    fn locks(self, half_angle: f64) -> f64 {
        match self {
            Self::Derived => (1.0 - libm::sin(half_angle)) / libm::cos(half_angle),
            Self::Published => 1.0 / libm::tan(half_angle),
        }
    }
}

/// The cone of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Half the cone's angle gamma, rad, in (0, pi/2).
    pub half_angle: f64,
    /// Kinetic friction mu with cone and plate, 0 or more, and below that at which the cone locks.
    pub friction: f64,
    /// The balance of forces at its corners.
    pub balance: Balance,
}

impl Cone {
    /// The cone, checked.
    ///
    /// # Errors
    /// If the angle or the friction is out of range, or friction locks the cone.
    pub fn new(half_angle: f64, friction: f64, balance: Balance) -> Result<Self, String> {
        if !(half_angle > 0.0 && half_angle < std::f64::consts::FRAC_PI_2) {
            let found = Readable(half_angle.to_degrees());
            return Err(format!("half the cone's angle is {found} deg; it must be above 0 and below 90 deg"));
        }
        let locks = balance.locks(half_angle);
        let cone = Self { half_angle, friction, balance };
        // Within rounding of the lock the ratio may already be 0.
        if friction >= 0.0 && friction < locks && cone.ratio() > 0.0 {
            return Ok(cone);
        }
        Err(format!(
            "the friction is {}; it must be 0 or more, and below {}, where the cone locks: check the friction, or press a \
             cone with a smaller half angle",
            Readable(friction),
            Readable(locks)
        ))
    }

    /// Radial force per vertical load, F_s / P, above 0.
    pub fn ratio(&self) -> f64 {
        let (tan, mu) = (libm::tan(self.half_angle), self.friction);
        let cone = (1.0 - mu * tan) / (mu + tan);
        match self.balance {
            Balance::Derived => cone - mu,
            Balance::Published => cone + mu,
        }
    }

    /// Radius (m) at which the corners touch the cone after a travel of `travel` (m) from first contact at `first` (m).
    pub fn radius(&self, first: f64, travel: f64) -> f64 {
        first + travel * libm::tan(self.half_angle)
    }
}

/// One point of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Press {
    /// Travel of the cone since first contact, mm.
    pub travel: f64,
    /// Vertical load on the cone, N.
    pub load: f64,
}

/// Reads a test: columns `travel_mm` (or `displacement`, `extension`) and `load_N`.
///
/// # Errors
/// All faults of the table, see [`read_table`]; or that it has no rows.
pub fn read_test(source: &Source) -> Result<Vec<Press>, Faults> {
    read_presses(source, &COLUMNS)
}

/// The same of a `cone` that first touches the star at the radius `first` (m).
///
/// # Errors
/// As for [`read_test`]; or for each travel at which the radius would not be above 0.
pub fn read_cone_test(source: &Source, cone: &Cone, first: f64) -> Result<Vec<Press>, Faults> {
    let [mut travel, load] = COLUMNS;
    let tip = -1e3 * first / libm::tan(cone.half_angle);
    if tip > TRAVELS[0] {
        travel.allowed = Allowed::above(tip, TRAVELS[1]);
        travel.slip = "travel is 0 at first contact and grows as the cone goes down, and at the least one the radius would be 0: \
                       check its sign and unit, and the contact radius";
    }
    read_presses(source, &[travel, load])
}

/// The rows of a test in `source` with `columns`.
fn read_presses(source: &Source, columns: &[TableColumn; 2]) -> Result<Vec<Press>, Faults> {
    // No cell of these columns may be empty.
    let press = |row: [Option<f64>; 2]| Some(Press { travel: row[0]?, load: row[1]? });
    let presses: Vec<Press> = read_table(source, columns)?.into_iter().filter_map(press).collect();
    if presses.is_empty() {
        let end = source.text.len();
        let fault = Fault::error(FaultCode::NoRows, end..end, "no rows below the header")
            .label("a travel and a load");
        return Err(Faults::new(source, vec![fault]));
    }
    Ok(presses)
}

/// A predicted radial force; `None` if the star cannot have this radius, or if the force is unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Predicted {
    /// The force, N.
    pub force: Option<f64>,
    /// Its range.
    pub range: Option<[f64; 2]>,
}

/// The prediction at a radius (m).
pub type Overlay<'a> = &'a dyn Fn(f64) -> Predicted;

/// One point of a test, reduced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedPoint {
    /// The measured point.
    pub press: Press,
    /// Radius at which the corners touch the cone, mm.
    pub radius: f64,
    /// Radial force of the star, N.
    pub force: f64,
    /// The predicted radial force at this radius, with a prediction.
    pub predicted: Option<Predicted>,
}

/// Reduces a test to radius and radial force.
///
/// `first` is the radius (m) at first contact, where the travel is 0; with `overlay` each point has its prediction.
pub fn reduce(test: &[Press], cone: &Cone, first: f64, overlay: Option<Overlay<'_>>) -> Vec<ReducedPoint> {
    let ratio = cone.ratio();
    let reduced = |press: &Press| {
        let radius = cone.radius(first, press.travel * 1e-3);
        ReducedPoint {
            press: *press,
            radius: radius * 1e3,
            force: ratio * press.load,
            predicted: overlay.map(|overlay| overlay(radius)),
        }
    };
    test.iter().map(reduced).collect()
}

/// A reduced test as CSV, with columns of predicted forces if there is a prediction.
pub fn csv(points: &[ReducedPoint]) -> String {
    let mut out = String::from("travel_mm,load_N,radius_mm,force_N");
    let is_laid_over = points.iter().any(|point| point.predicted.is_some());
    out.push_str(if is_laid_over { ",predicted_N,predicted_lo_N,predicted_hi_N\n" } else { "\n" });
    for ReducedPoint { press: Press { travel, load }, radius, force, predicted } in points {
        // Writing to a String does not fail.
        let _ = write!(out, "{travel},{load},{radius:.6},{force:.6}");
        let forces = predicted.iter().flat_map(|Predicted { force, range }| {
            let [low, high] = range.map_or([None; 2], |ends| ends.map(Some));
            [*force, low, high]
        });
        for force in forces {
            let _ = match force {
                Some(force) => write!(out, ",{force:.6}"),
                None => write!(out, ","),
            };
        }
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn test(csv: &str) -> Result<Vec<Press>, Faults> {
        read_test(&Source::new("test.csv", csv))
    }

    #[test]
    fn a_test_is_reduced_line_by_line() {
        let cone = Cone::new(30.0_f64.to_radians(), 0.1, Balance::Derived).expect("valid");
        let test = test("travel_mm,load_N\n0,0\n10,2.5\n").expect("two rows");
        let plain = csv(&reduce(&test, &cone, 0.015, None));
        assert_eq!(plain.lines().nth(2), Some("10,2.5,20.773503,3.227761"));
        let overlay = |radius: f64| Predicted { force: Some(radius * 100.0), range: None };
        let laid = csv(&reduce(&test, &cone, 0.015, Some(&overlay)));
        assert_eq!(
            laid.lines().next(),
            Some("travel_mm,load_N,radius_mm,force_N,predicted_N,predicted_lo_N,predicted_hi_N")
        );
        assert_eq!(laid.lines().nth(1), Some("0,0,15.000000,0.000000,1.500000,,"));
        // The output can be read and reduced again, for instance with another friction.
        assert_eq!(read_test(&Source::new("again", laid)).expect("columns by name"), test);
    }

    #[test]
    fn a_table_of_another_kind_or_without_rows_is_refused() {
        let code = |csv| test(csv).expect_err(csv).list()[0].code;
        assert_eq!(code("a,b\n1,2\n"), "no-header");
        assert_eq!(code("travel_mm,load_N\n1,2\nx,3\n"), "cell");
        assert_eq!(code("travel_mm,load_N\n1,NaN\n"), "cell");
        assert_eq!(code("travel_mm,load_N\n1,\n"), "cell");
        assert_eq!(code("travel_mm,load_N\n\n"), "no-rows");
        assert_eq!(code("travel_mm;load_N\n10,5;2,5\n"), "decimal-comma");
        assert_eq!(test("Load (N);Extension (mm)\n2.5;10.5\n"), Ok(vec![Press { travel: 10.5, load: 2.5 }]));
    }

    #[test]
    fn balances_of_the_papers_cone() {
        let ratio = |balance| Cone::new(30.0_f64.to_radians(), 0.1, balance).expect("valid").ratio();
        let (derived, published) = (ratio(Balance::Derived), ratio(Balance::Published));
        assert!((published - derived - 0.2).abs() < 1e-15);
        assert!((published - 1.491).abs() < 1e-3, "{published}");
    }

    #[test]
    fn without_friction_it_is_a_wedge() {
        for (_, balance) in Balance::ALL {
            let cone = Cone::new(0.4, 0.0, balance).expect("valid");
            assert!((cone.ratio() - 1.0 / 0.4_f64.tan()).abs() < 1e-15);
            assert!((cone.radius(0.02, 0.01) - (0.02 + 0.01 * 0.4_f64.tan())).abs() < 1e-15);
        }
    }

    #[test]
    fn a_cone_that_locks_is_refused() {
        let derived = |half_angle, friction| Cone::new(half_angle, friction, Balance::Derived);
        assert!(derived(0.5, -0.1).is_err() && derived(0.5, f64::NAN).is_err());
        assert!(derived(0.0, 0.1).is_err() && derived(1.6, 0.1).is_err());
        // By the derived balance from gamma + 2 phi = 90 deg on, by the published one from gamma + phi = 90 deg on.
        for (balance, degrees, locks) in [
            (Balance::Derived, 30.0_f64, 30.0_f64),
            (Balance::Derived, 60.0, 15.0),
            (Balance::Published, 30.0, 60.0),
            (Balance::Published, 60.0, 30.0),
        ] {
            let (half_angle, locks) = (degrees.to_radians(), locks.to_radians().tan());
            let cone = Cone::new(half_angle, locks - 1e-9, balance).expect("slides");
            assert!(cone.ratio() > 0.0, "{cone:?}");
            let fault = Cone::new(half_angle, locks + 1e-9, balance).expect_err("locks");
            assert!(fault.contains(&format!("below {}, where the cone locks", Readable(locks))), "{fault}");
        }
    }

    #[test]
    fn a_travel_past_the_tip_of_the_cone_is_refused_with_its_row() {
        let cone = Cone::new(30.0_f64.to_radians(), 0.1, Balance::Derived).expect("valid");
        let read = |csv: &str| read_cone_test(&Source::new("test.csv", csv), &cone, 0.015);
        assert_eq!(read("travel_mm,load_N\n-25.9,3\n0,0\n").expect("above 0").len(), 2);
        let faults = read("travel_mm,load_N\n-1,0\n-26,3\n-40,3\n").expect_err("below 0");
        assert_eq!(faults.list().len(), 2);
        let said = faults.to_string();
        for words in ["test.csv:3", "`travel_mm` is `-26`", "more than -25.9808", "the contact radius"] {
            assert!(said.contains(words), "{said}");
        }
        // A blunt cone's tip lies beyond every travel.
        let blunt = Cone::new(1e-9, 0.1, Balance::Derived).expect("valid");
        assert!(
            read_cone_test(&Source::new("test.csv", "travel_mm,load_N\n-99999,1\n"), &blunt, 1.0).is_ok()
        );
    }
}
