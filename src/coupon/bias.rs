//! The bias strip: a strip of one sheet, cut at 45 deg to the warp and pulled, gives the shear modulus.
//!
//! An orthotropic sheet that is as stiff along the warp as along the weft has at 45 deg to both
//!
//! ```text
//! 4 / E_45 = 1/G + 2 (1 - nu) / E        so        1 / (G t) = 4 / (E_45 t) - 2 (1 - nu) / Y
//! ```
//!
//! from 1/E(theta) = (c^4 + s^4)/E + (1/G - 2 nu/E) c^2 s^2 with c^2 = s^2 = 1/2: Jones, "Mechanics of composite materials" (1999),
//! equation 2.97. E_45 t is the slope of load over travel times length over width. Clamps hold the strip's width, so a short strip is stiffer.

use crate::coupon::table::{TableColumn, read_table};
use spec::units::Readable;
use spec::{Allowed, Fault, FaultCode, Faults, Source};

/// The columns of a test.
const COLUMNS: [TableColumn; 2] = [
    TableColumn {
        names: &["travel", "displacement", "extension"],
        unit: "mm",
        allowed: Allowed::closed(-1e5, 1e5),
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

/// Least length over width: the clamps stiffen a shorter strip by more than 6 % where the sheet is soft in shear.
const SLENDER: f64 = 5.0;
/// Least number of points for a straight line with a check.
const LEAST: usize = 3;
/// Largest distance of a point from the fitted line, relative to the range of loads: a curve has no single slope.
const STRAIGHT: f64 = 0.05;
/// Largest stiffness along the bias over that along the warp: a weave is softer along the bias, an isotropic sheet as stiff, and clamps
/// add up to a tenth.
const STIFFEST: f64 = 1.1;
/// Least shear modulus over that of an isotropic sheet: in a looser weave the threads lie apart.
const SOFTEST: f64 = 1e-3;

/// One point of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PullPoint {
    /// Travel of the clamp, mm.
    pub travel: f64,
    /// Load on the strip, N.
    pub load: f64,
}

/// Reads a test of a strip: columns `travel_mm` (or `displacement`, `extension`) and `load_N`.
///
/// # Errors
/// All faults of the table, see [`read_table`]; or that it has no rows.
pub fn read_strip(source: &Source) -> Result<Vec<PullPoint>, Faults> {
    // No cell of these columns may be empty.
    let point = |row: [Option<f64>; 2]| Some(PullPoint { travel: row[0]?, load: row[1]? });
    let points: Vec<PullPoint> = read_table(source, &COLUMNS)?.into_iter().filter_map(point).collect();
    if points.is_empty() {
        let end = source.text.len();
        let fault = Fault::error(FaultCode::NoRows, end..end, "no rows below the header")
            .label("a travel and a load");
        return Err(Faults::new(source, vec![fault]));
    }
    Ok(points)
}

/// A strip between two clamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasStrip {
    /// Width, mm.
    pub width: f64,
    /// Free length between the clamps, mm.
    pub length: f64,
}

impl BiasStrip {
    /// E_45 t of the strip in `test`, N/mm, by least squares.
    ///
    /// # Errors
    /// If the strip is shorter than five widths, or the points do not lie on a straight, rising line.
    pub fn stiffness(&self, test: &[PullPoint]) -> Result<f64, String> {
        let shortest = SLENDER * self.width;
        if self.length < shortest {
            return Err(format!(
                "the strip is {} mm long between the clamps; at least {shortest} mm, {SLENDER} times its width, are \
                 needed: clamp it farther apart, or cut a narrower strip",
                self.length
            ));
        }
        if test.len() < LEAST {
            return Err(format!("{} points; at least {LEAST} are needed", test.len()));
        }
        #[expect(clippy::cast_precision_loss, reason = "a table's rows")]
        let count = test.len() as f64;
        let x = test.iter().map(|point| point.travel).sum::<f64>() / count;
        let y = test.iter().map(|point| point.load).sum::<f64>() / count;
        let offsets = test.iter().map(|point| (point.travel - x, point.load - y));
        let slope = offsets.clone().map(|(x, y)| x * y).sum::<f64>()
            / offsets.clone().map(|(x, _)| x * x).sum::<f64>();
        if slope.is_nan() || slope <= 0.0 {
            let reason = "the load does not rise with the travel; check whether the columns are exchanged";
            return Err(reason.to_owned());
        }
        let loads = test.iter().map(|point| point.load);
        let range = loads.clone().fold(f64::NEG_INFINITY, f64::max) - loads.fold(f64::INFINITY, f64::min);
        let largest = offsets.map(|(x, y)| (y - slope * x).abs() / range).fold(0.0, f64::max);
        if largest > STRAIGHT {
            return Err(format!(
                "the load deviates from a straight line by {:.0} %; at most {:.0} % are allowed: keep the rows of \
                 the first, straight part",
                100.0 * largest,
                100.0 * STRAIGHT
            ));
        }
        Ok(slope * self.length / self.width)
    }
}

/// G t (N/mm) of a sheet of the stretch stiffness `stretch` Y (N/mm) and the Poisson ratio `poisson`, whose bias strip has the stiffness
/// `along_bias` E_45 t (N/mm).
///
/// # Errors
/// If no weave has this stiffness. E_45 t is at most 1.1 Y, and below 2 Y / (1 - nu), where the shear modulus would be infinite; G is at
/// least a thousandth of the isotropic one.
pub fn shear_stiffness(along_bias: f64, stretch: f64, poisson: f64) -> Result<f64, String> {
    let rigid = 2.0 * (1.0 - poisson) / stretch;
    let stiffest = STIFFEST * stretch;
    if along_bias > stiffest || along_bias * rigid >= 4.0 {
        let stiffest = stiffest.min(4.0 / rigid);
        return Err(format!(
            "the strip bears {along_bias:.3} N/mm of width and strain; must be at most {stiffest:.3}, {STIFFEST} times the \
             stiffness along the warp, because a weave is softer along the bias: check the strip's length, width \
             and units, that it is one sheet, cut at 45 deg, and the stretch stiffness; leave `shear_modulus` out \
             for an isotropic sheet"
        ));
    }
    let softest = SOFTEST * stretch / (2.0 * (1.0 + poisson));
    let softest_strip = 4.0 / (1.0 / softest + rigid);
    if along_bias < softest_strip {
        return Err(format!(
            "the strip bears {} N/mm of width and strain; must be at least {}, where the shear modulus is a \
             thousandth of the isotropic one: check the strip's length, width and units, and the stretch stiffness",
            Readable(along_bias),
            Readable(softest_strip)
        ));
    }
    Ok(1.0 / (4.0 / along_bias - rigid))
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRIP: BiasStrip = BiasStrip { width: 40.0, length: 200.0 };

    fn line(slope: f64, bend: f64) -> Vec<PullPoint> {
        [0.0, 1.0, 2.0, 3.0].map(|x| PullPoint { travel: x, load: 2.0 + slope * x + bend * x * x }).to_vec()
    }

    #[test]
    fn a_table_of_another_kind_or_without_rows_is_refused() {
        let read = |csv: &str| read_strip(&Source::new("strip.csv", csv));
        for (csv, code) in [
            ("a,b\n1,2\n", "no-header"),
            ("travel_mm,load_N\n1,2\nx,3\n", "cell"),
            ("travel_mm,load_N\n1,NaN\n", "cell"),
            ("travel_mm,load_N\n1,\n", "cell"),
            ("travel_mm,load_N\n\n", "no-rows"),
            ("travel_mm;load_N\n10,5;2,5\n", "decimal-comma"),
        ] {
            assert_eq!(read(csv).expect_err(csv).list()[0].code, code, "{csv:?}");
        }
        let points = vec![PullPoint { travel: 10.5, load: 2.5 }];
        assert_eq!(read("Load (N);Extension (mm)\n2.5;10.5\n"), Ok(points));
    }

    #[test]
    fn a_strip_gives_the_shear_modulus_back() {
        // Y = 38.4 N/mm, nu = 0.39, G t = 3 N/mm; by 1/E(theta) at 45 deg.
        let (y, nu, g) = (38.4, 0.39, 3.0);
        let bias = 1.0 / (0.5 / y + (1.0 / g - 2.0 * nu / y) / 4.0);
        let measured = STRIP.stiffness(&line(bias / 5.0, 0.0)).expect("a line");
        assert!((measured / bias - 1.0).abs() < 1e-12, "{measured}");
        assert!((shear_stiffness(measured, y, nu).expect("soft") / g - 1.0).abs() < 1e-12);
        // Isotropic fabric is as stiff along the bias as along the warp.
        let even = shear_stiffness(y, y, nu).expect("isotropic");
        assert!((even / (y / (2.0 * (1.0 + nu))) - 1.0).abs() < 1e-12, "{even}");
    }

    #[test]
    fn what_is_no_line_or_no_strip_is_refused() {
        let short = BiasStrip { width: 41.0, ..STRIP };
        let reason = |strip: BiasStrip, test: &[PullPoint]| strip.stiffness(test).expect_err("refused");
        let long = reason(short, &line(1.0, 0.0));
        assert!(long.starts_with("the strip is 200 mm long between the clamps; at least 205 mm"), "{long}");
        assert_eq!(reason(STRIP, &line(1.0, 0.0)[..2]), "2 points; at least 3 are needed");
        for test in [&line(-1.0, 0.0)[..], &[PullPoint { travel: 1.0, load: 1.0 }; 3]] {
            assert!(reason(STRIP, test).starts_with("the load does not rise with the travel"));
        }
        assert!(reason(STRIP, &line(1.0, 0.5)).starts_with("the load deviates from a straight line"));
        assert!(STRIP.stiffness(&line(1.0, 0.05)).is_ok());
        let stiff = shear_stiffness(130.0, 38.4, 0.39).expect_err("refused");
        assert!(stiff.contains("must be at most"), "{stiff}");
    }

    #[test]
    fn no_weave_is_much_stiffer_along_the_bias_or_nearly_without_shear() {
        let (y, nu) = (38.4, 0.39);
        // Ten times the length, and loads in kN.
        for (strip, words) in [(113.0, "at most 42.240"), (0.0113, "at least 0.0552")] {
            let fault = shear_stiffness(strip, y, nu).expect_err(words);
            assert!(fault.contains(words) && fault.contains("length, width and units"), "{fault}");
        }
        assert!(shear_stiffness(1.09 * y, y, nu).is_ok() && shear_stiffness(0.06, y, nu).is_ok());
        // A sheet that widens when it is pulled has an earlier asymptote.
        assert!(shear_stiffness(40.0, y, -0.9).is_ok() && shear_stiffness(41.0, y, -0.9).is_err());
    }
}
