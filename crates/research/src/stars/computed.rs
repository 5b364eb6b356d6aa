//! One star of a set as the shell computes it: a self-contained text with a checksum in its last line, and the line that
//! the shipped table keeps of it.

use std::fmt::Write;

use crate::stars::draw::{DrawnStar, Set};
use crate::{sealed, unsealed};
use inflatable::mechanics::star::residuals::OPENINGS;
use inflatable::shell::cases::{Fineness, Objects, ShellFault, Value, Watch, star};

/// Meshes of some 2,500, 10,000 and 40,000 unknowns.
pub const FINENESS: Fineness = Fineness { cells: 12.0, cuts: 2 };
/// One mesh more for the paper's stars, up to some 160,000: they are the reference for others.
pub const PAPER_FINENESS: Fineness = Fineness { cells: 12.0, cuts: 3 };
/// Meshes for forces, which take many more solves: some 6,000, 24,000 and 100,000, begun on one of 1,500.
pub const FORCE_FINENESS: Fineness = Fineness { cells: 8.0, cuts: 3 };

/// A number of the shell, with its mesh error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshedNumber {
    /// Value of the number.
    pub value: f64,
    /// Mesh error of the number.
    pub error: f64,
}

/// The shell's numbers of a star at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellNumbers {
    /// rho_f, mm.
    pub radius: MeshedNumber,
    /// The tips' angle, deg.
    pub angle: MeshedNumber,
    /// Radial stiffness, all corners together, N/mm.
    pub stiffness: MeshedNumber,
    /// Force between the arms of a tip, N.
    pub arm_contact: MeshedNumber,
    /// Openings by W, and the **secant** there: the radial force that opens the star so far over the opening times the radial stiffness,
    /// all of the same mesh. Meshes agree on that ratio where they are far apart in either.
    pub secants: Vec<(f64, MeshedNumber)>,
}

impl ShellNumbers {
    /// The numbers that have the names of the fields, and the secants; `None` if one but a secant is missing.
    fn from_fields(
        number: impl Fn(&str) -> Option<MeshedNumber>,
        secant: impl Fn(f64) -> Option<(f64, MeshedNumber)>,
    ) -> Option<Self> {
        Some(Self {
            radius: number("radius")?,
            angle: number("angle")?,
            stiffness: number("stiffness")?,
            arm_contact: number("arm_contact")?,
            secants: OPENINGS.into_iter().filter_map(secant).collect(),
        })
    }
}

/// A star with the shell's numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputedStar {
    /// The star.
    pub star: DrawnStar,
    /// The numbers; `None` where the shell refuses.
    pub found: Option<ShellNumbers>,
}

impl DrawnStar {
    /// Computes it at rest and opened by `openings` (by W); returns its text. A refusal by the shell is written to the text, too.
    ///
    /// # Errors
    /// If it is cancelled.
    pub fn compute(
        &self,
        openings: &[f64],
        fineness: Fineness,
        watch: &Watch<'_>,
    ) -> Result<String, ShellFault> {
        let Fineness { cells, cuts } = fineness;
        let mut text = String::from(
            "# A star as a shell; `research stars`. Lengths mm, t mm, angles deg, p kPa, E 128 MPa, nu 0.39.\n# Each number, its \
             mesh error, and what the last three meshes gave.\n",
        );
        let _ = writeln!(text, "{} cells {cells} cuts {cuts}", self.words());
        let objects: Vec<f64> = openings.iter().map(|part| 1e-3 * part * self.width).collect();
        match star(&self.flat(), Objects::Openings(&objects), fineness, watch) {
            Err(ShellFault::Cancelled) => return Err(ShellFault::Cancelled),
            Err(fault) => {
                let _ = writeln!(text, "refused {fault}");
            }
            Ok(found) => {
                let mut values = vec![
                    ("radius".to_owned(), found.final_radius.scaled(1e3)),
                    ("angle".to_owned(), found.tip_angle.scaled(1.0_f64.to_degrees())),
                    ("stiffness".to_owned(), found.radial_stiffness.scaled(1e-3)),
                    ("arm_contact".to_owned(), found.preload),
                    ("volume".to_owned(), found.volume.scaled(1e6)),
                ];
                let forces = openings.iter().zip(&found.forces);
                values.extend(forces.map(|(part, (_, force))| (format!("force {part}"), *force)));
                for (name, Value { value, error, meshes: [a, b, c] }) in values {
                    let _ = writeln!(text, "{name} {value:.5} {error:.5} {a:.5} {b:.5} {c:.5}");
                }
                let _ = writeln!(text, "unknowns {:?}", found.evidence.unknowns);
            }
        }
        Ok(sealed(&text))
    }

    /// Description of the star, in one line.
    pub fn words(&self) -> String {
        format!(
            "{} {} n {} W {} rho_0 {} phi_i0 {} R_i {} R_e {} t {} p {}",
            self.set.name(),
            self.number,
            self.points,
            self.width,
            self.inner_radius,
            self.tip_angle,
            self.tip_radius,
            self.corner_radius,
            self.thickness,
            self.pressure
        )
    }

    /// Reads its text; `None` if it is torn, or another star's.
    pub fn read(&self, text: &str) -> Option<ComputedStar> {
        let mut lines = unsealed(text)?;
        if !lines.next()?.starts_with(&format!("{} cells ", self.words())) {
            return None;
        }
        let lines: Vec<&str> = lines.collect();
        if lines.iter().any(|line| line.starts_with("refused ")) {
            return Some(ComputedStar { star: *self, found: None });
        }
        // Value, mesh error, and the values of the three meshes.
        let numbers = |name: &str| {
            let rest = lines.iter().find_map(|line| line.strip_prefix(name)?.strip_prefix(' '))?;
            let numbers: Vec<f64> = rest.split(' ').filter_map(|word| word.parse().ok()).collect();
            <[f64; 5]>::try_from(numbers).ok()
        };
        let number = |name: &str| numbers(name).map(|[value, error, ..]| MeshedNumber { value, error });
        let secant = |part: f64| {
            let ([_, _, forces @ ..], [_, _, stiffness @ ..]) =
                (numbers(&format!("force {part}"))?, numbers("stiffness")?);
            let by_mesh = |mesh: usize| forces[mesh] / (stiffness[mesh] * part * self.width);
            let Value { value, error, .. } = Value::new([0, 1, 2].map(by_mesh));
            value.is_finite().then_some((part, MeshedNumber { value, error }))
        };
        Some(ComputedStar { star: *self, found: Some(ShellNumbers::from_fields(number, secant)?) })
    }
}

impl ComputedStar {
    /// The star's line in the shipped table.
    pub fn line(&self) -> String {
        let mut line = self.star.words();
        let Some(shell) = &self.found else { return line + " refused" };
        let mut numbers = vec![
            ("radius".to_owned(), shell.radius, 3),
            ("angle".to_owned(), shell.angle, 2),
            ("stiffness".to_owned(), shell.stiffness, 4),
            ("arm_contact".to_owned(), shell.arm_contact, 3),
        ];
        numbers.extend(shell.secants.iter().map(|(part, secant)| (format!("secant {part}"), *secant, 3)));
        for (name, MeshedNumber { value, error }, decimals) in numbers {
            let _ = write!(line, " {name} {value:.decimals$} {error:.decimals$}");
        }
        line
    }

    /// Reads a line of the shipped table.
    pub fn of_line(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split(' ').collect();
        let set = Set::ALL.into_iter().find(|set| Some(&set.name()) == words.first())?;
        let star = set.star(words.get(1)?.parse().ok().filter(|number| *number >= 1)?);
        let rest = line.strip_prefix(&star.words())?.trim_start();
        if rest == "refused" {
            return Some(Self { star, found: None });
        }
        let words: Vec<&str> = rest.split(' ').collect();
        let numbers_after = |name: &[&str]| {
            let index = words.windows(name.len()).position(|part| part == name)? + name.len();
            Some(MeshedNumber {
                value: words.get(index)?.parse().ok()?,
                error: words.get(index + 1)?.parse().ok()?,
            })
        };
        let secant = |part: f64| Some((part, numbers_after(&["secant", &part.to_string()])?));
        Some(Self { star, found: Some(ShellNumbers::from_fields(|name| numbers_after(&[name]), secant)?) })
    }
}

/// All stars of all sets, one of each set in turn, so that any beginning is of use.
pub fn in_turn() -> Vec<DrawnStar> {
    let longest = Set::ALL.map(Set::count).into_iter().max().unwrap_or(0);
    let numbered = |number: u32| {
        Set::ALL.into_iter().filter(move |set| number <= set.count()).map(move |set| set.star(number))
    };
    (1..=longest).flat_map(numbered).collect()
}
