//! Shells of the paper's V-actuators and of its stars on coarse meshes: they take minutes, and are kept in shells.txt.
//!
//! Lengths mm, angles deg, pressures kPa, stiffnesses and moments N m; each number is followed by its mesh error.

use research::stars::draw::Set;
use stargrip_cam::shell::cases::{
    Fineness, Margin, Objects, ShellFault, Tube, VActuator, Value, Watch, actuator, star_by_sizes,
};
use stargrip_cam::shell::element::Fabric;
use stargrip_cam::shell::mesh::Sizes;

use super::paper_fabric::{WIDTHS, sheet};

/// Results computed before.
const KEPT: &str = include_str!("shells.txt");
/// Meshes of `stargrip-cam actuator --model shell --fineness fine`.
const FINE: Fineness = Fineness { cells: 12.0, cuts: 3 };
/// One mesh less for tubes of 40 mm above 1/eps = 900: so thin a sheet wrinkles there, and the last mesh takes many minutes a case.
const THIN: Fineness = Fineness { cells: 12.0, cuts: 2 };
/// 1/eps at which coiling is computed, as far as p W/Y stays below 0.1; the shell ends at 5,000.
pub(crate) const BENDABILITIES: [f64; 6] = [100.0, 300.0, 1e3, 2e3, 3e3, 4e3];
/// Flat angles of the figure of target angles.
pub(crate) const ANGLES: [f64; 6] = [30.0, 60.0, 75.0, 90.0, 120.0, 150.0];
/// Pressures of that figure, kPa: that of the paper's picture, and 1/eps = 2000.
pub(crate) const ANGLE_PRESSURES: [f64; 2] = [14.0, 85.0];
/// Pressures at which the stiffness of three widths is computed, kPa.
pub(crate) const PRESSURES: [f64; 5] = [5.0, 10.0, 20.0, 37.0, 60.0];
/// Fixed angles of the hinge for the moments, deg.
pub(crate) const HELD: [f64; 11] = [10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0];

/// One V-actuator of R* = 0.1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Case {
    /// W.
    pub(crate) width: f64,
    /// l.
    pub(crate) arm: f64,
    /// phi_0.
    pub(crate) angle: f64,
    /// p.
    pub(crate) pressure: f64,
    /// Angles at which it is held.
    pub(crate) held: Vec<f64>,
}

/// The shell's values; each number with its mesh error.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Computed {
    /// phi at rest.
    pub(crate) angle: [f64; 2],
    /// lambda at rest.
    pub(crate) coiling: [f64; 2],
    /// C.
    pub(crate) stiffness: [f64; 2],
    /// M, which closes where it is negative, at each angle at which it is held.
    pub(crate) moments: Vec<[f64; 2]>,
}

/// p in kPa at 1/eps = `b` in a tube of `width` mm, as it is computed.
pub(crate) fn pressure_at(b: f64, width: f64) -> f64 {
    let kilopascals = 1e-3 * b * sheet().bending_modulus() / (1e-3 * width).powi(3);
    (1e3 * kilopascals).round() / 1e3
}

/// The V-actuator of a figure, with arms of 4 W.
pub(crate) fn case(width: f64, angle: f64, pressure: f64) -> Case {
    Case { width, arm: 4.0 * width, angle, pressure, held: Vec::new() }
}

/// The case of the figure of target angles, whose arms the paper gives: 15 cm.
pub(crate) fn long(angle: f64, pressure: f64) -> Case {
    Case { arm: 150.0, ..case(20.0, angle, pressure) }
}

/// The case of the moments.
pub(crate) fn held() -> Case {
    Case { held: HELD.to_vec(), ..case(20.0, 60.0, 13.8) }
}

/// The case whose coiling is computed at 1/eps = `b`; `None` where p W/Y is above 0.1.
pub(crate) fn coiled(width: f64, b: f64) -> Option<Case> {
    let pressure = pressure_at(b, width);
    (sheet().stretch(1e3 * pressure, 1e-3 * width) <= 0.1).then(|| case(width, 60.0, pressure))
}

/// All of them, figure by figure.
fn cases() -> Vec<Case> {
    let mut cases = vec![held()];
    cases.extend(ANGLE_PRESSURES.iter().flat_map(|p| ANGLES.map(|angle| long(angle, *p))));
    cases.extend(WIDTHS.iter().flat_map(|w| BENDABILITIES.into_iter().filter_map(|b| coiled(*w, b))));
    cases.extend(WIDTHS.iter().flat_map(|w| PRESSURES.map(|p| case(*w, 30.0, p))));
    cases.extend([60.0, 90.0, 120.0, 150.0].map(|angle| case(30.0, angle, 20.0)));
    cases
}

impl Case {
    fn words(&self) -> String {
        let Self { width, arm, angle, pressure, .. } = self;
        format!("W {width} l {arm} phi_0 {angle} p {pressure} held {}", self.held.len())
    }

    /// Its kept result; `None` where the shell refused it.
    pub(crate) fn kept(&self) -> Option<Computed> {
        let own = self.words();
        let line = KEPT.lines().find_map(|line| line.strip_prefix(&own)?.strip_prefix(": "));
        let line = line.unwrap_or_else(|| panic!("shells.txt has no {own}"));
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        let mut pairs = numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
        Some(Computed {
            angle: pairs.next()?,
            coiling: pairs.next()?,
            stiffness: pairs.next()?,
            moments: pairs.collect(),
        })
    }

    fn compute(&self) -> Result<String, ShellFault> {
        let mm = |length: f64| 1e-3 * length;
        let tube = Tube { width: mm(self.width), fabric: fabric(), pressure: 1e3 * self.pressure };
        let flat = VActuator {
            tube,
            radius: mm(0.1 * self.width),
            arm_length: mm(self.arm),
            angle: self.angle.to_radians(),
            margin: Margin::NONE,
        };
        let angles: Vec<f64> = self.held.iter().map(|angle| angle.to_radians()).collect();
        let wrinkles = self.width >= 40.0 && sheet().bendability(1e3 * self.pressure, mm(self.width)) > 900.0;
        let fineness = if wrinkles { THIN } else { FINE };
        let found = actuator(&flat, &angles, fineness, &Watch::default())?;
        let said = |Value { value, error, .. }: Value| format!("{value:.5} {error:.5}");
        let degrees = found.angle.scaled(1.0_f64.to_degrees());
        let mut text = [degrees, found.coiling, found.stiffness].map(said).join(" ");
        // The applied moment opens; the hinge's own moment has the opposite sign.
        for (_, moment) in &found.moments {
            text.push(' ');
            text += &said(moment.scaled(-1.0));
        }
        Ok(text)
    }
}

fn fabric() -> Fabric {
    let sheet = sheet();
    Fabric::isotropic(sheet.stretching_modulus(), sheet.bending_modulus(), sheet.poisson_ratio)
}

/// Layouts of the triangles of a coarse star.
pub(crate) const GRADINGS: [&str; 2] = ["even", "graded"];
/// Edges a width of its first mesh, W/12.5; each further mesh has twice as many.
pub(crate) const COARSE: f64 = 12.5;

/// rho_f, mm, of the paper's star of `points` points at 37 kPa on three meshes from W/12.5 on, and the unknowns of each.
pub(crate) fn coarse(points: u32, grading: &str) -> ([f64; 3], [f64; 3]) {
    let own = format!("star n {points} p 37 {grading}: ");
    let line = KEPT.lines().find_map(|line| line.strip_prefix(&own)).unwrap_or_default();
    let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
    let three = |from: usize| [0, 1, 2].map(|k| numbers.get(from + k).copied().unwrap_or(f64::NAN));
    (three(0), three(3))
}

fn compute_coarse(points: u32, grading: &str) -> Result<String, ShellFault> {
    let drawn = (1..=Set::Paper.count()).map(|number| Set::Paper.star(number));
    let star = drawn.into_iter().find(|star| star.points == points && star.pressure == 37.0);
    let edge = 1.0 / COARSE;
    let sizes = match grading {
        "even" => Sizes { hinge: edge, point: edge, arm: edge },
        _ => Sizes::for_tube(1.0, COARSE),
    };
    let flat = star.expect("it is in the set").flat();
    let found = star_by_sizes(&flat, Objects::Radii(&[]), (&sizes, 2), &Watch::default())?;
    let radii = found.final_radius.meshes.map(|radius| format!("{:.3}", 1e3 * radius));
    let unknowns: Vec<String> = found.evidence.unknowns.iter().map(ToString::to_string).collect();
    Ok(format!("{} {}", radii.join(" "), unknowns.join(" ")))
}

/// Computes all of it, and prints it line by line as shells.txt is.
pub(crate) fn compute() {
    println!(
        "# V-actuators and stars as shells; made by `cargo run --release -p research --example paper -- --shells`. t 0.3 mm, E 128 MPa, nu 0.39.\n\
         # R = W/10; lengths mm, angles deg, p kPa: phi, lambda, C (N m), moments (N m) where held; each with its mesh error.\n\
         # Stars of the paper's figure: rho_f on three single meshes, the first of edges W/12.5, and their unknowns."
    );
    for case in cases() {
        let said = case.compute().unwrap_or_else(|fault| format!("refused: {fault}"));
        println!("{}: {said}", case.words());
    }
    for (points, grading) in [4, 5].into_iter().flat_map(|n| GRADINGS.map(|grading| (n, grading))) {
        let said = compute_coarse(points, grading).unwrap_or_else(|fault| format!("refused: {fault}"));
        println!("star n {points} p 37 {grading}: {said}");
    }
}
