//! Shells as they were computed once: of every fineness, `by_shell.txt`, and the finest of the paper's stars, `finest.txt`. Both are
//! made by `crates/research`.

use crate::meshed::MeshedValue;

/// One computation a line.
const SHIPPED: &str = include_str!("by_shell.txt");

/// One of the paper's stars a line.
const FINEST: &str = include_str!("finest.txt");

/// E of all of them, MPa.
pub const YOUNG: f64 = 128.0;
/// nu of all of them.
pub const POISSON: f64 = 0.39;
/// Their thickness, m.
pub const THICKNESS: f64 = 0.3e-3;
/// Opening of the finest shell by an object, over W.
pub const OPENING: f64 = 0.45;
/// W of the stars, mm.
const WIDTH: f64 = 30.0;

/// The finenesses, from the coarsest.
pub const FINENESSES: [&str; 3] = ["coarse", "medium", "fine"];

/// One shell.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell {
    /// Fineness of its meshes, as in `--fineness`.
    pub fineness: String,
    /// n; `None` for the V-actuator.
    pub points: Option<u32>,
    /// Gauge pressure, kPa.
    pub pressure: f64,
    /// Final radius, mm; the V-actuator's angle at rest, deg.
    pub rest: MeshedValue,
    /// Radial stiffness, N/m, NaN where its mesh error is larger than itself; the V-actuator's stiffness, N m.
    pub stiffness: MeshedValue,
    /// Force on a round object 0.45 W wider than the finest shell's final radius, N; stars only.
    pub force: Option<MeshedValue>,
    /// Unknowns of its finest mesh.
    pub unknowns: u32,
    /// User time, s.
    pub time: f64,
    /// Largest memory of the process, MB.
    pub memory: f64,
}

/// One of the paper's stars by its finest shell: four meshes up to some 160,000 unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Finest {
    /// n.
    pub points: u32,
    /// Gauge pressure, kPa.
    pub pressure: f64,
    /// Final radius, mm.
    pub radius: MeshedValue,
    /// Radial stiffness, N/m.
    pub stiffness: MeshedValue,
    /// Force on a round object that opens it by [`OPENING`], N.
    pub force: MeshedValue,
}

/// The program that computed the shells of every fineness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// Abbreviated commit of the program.
    pub commit: &'static str,
    /// The day, `2026-11-27`.
    pub date: &'static str,
}

/// The words of `by_shell.txt` before the commit, and between it and the date.
const COMPUTED_BY: &str = "# Computed by commit ";
const ON: &str = " on ";

/// The program that computed [`shells`]; its parts are empty if the table does not say.
pub fn provenance() -> Provenance {
    let line = SHIPPED.lines().find_map(|line| line.strip_prefix(COMPUTED_BY)).unwrap_or_default();
    let (commit, date) = line.trim_end_matches('.').split_once(ON).unwrap_or_default();
    Provenance { commit, date }
}

/// The lines of a table that are no comments.
fn rows(table: &'static str) -> impl Iterator<Item = &'static str> {
    table.lines().filter(|line| !line.starts_with('#'))
}

/// All of the paper's stars.
pub fn finest() -> Vec<Finest> {
    rows(FINEST).filter_map(star).collect()
}

fn star(line: &str) -> Option<Finest> {
    let (points, rest) = line.split_once(' ')?;
    let numbers: Vec<f64> = rest.split(' ').filter_map(|word| word.parse().ok()).collect();
    let [pressure, radius, radius_error, spring, spring_error, secant, secant_error] = numbers[..] else {
        return None;
    };
    // N/mm times mm.
    let force = spring * secant * OPENING * WIDTH;
    let open = spring_error / spring + secant_error / secant;
    Some(Finest {
        points: points.parse().ok()?,
        pressure,
        radius: MeshedValue { value: radius, mesh_error: radius_error },
        stiffness: MeshedValue { value: 1e3 * spring, mesh_error: 1e3 * spring_error },
        force: MeshedValue { value: force, mesh_error: open * force },
    })
}

/// All shells of every fineness.
pub fn shells() -> Vec<Shell> {
    rows(SHIPPED).filter_map(shell).collect()
}

fn shell(line: &str) -> Option<Shell> {
    let words: Vec<&str> = line.split(' ').collect();
    let points: u32 = words.get(1)?.parse().ok()?;
    Some(Shell {
        fineness: (*words.first()?).to_owned(),
        points: (points > 0).then_some(points),
        pressure: number(&words, 2)?,
        rest: meshed(&words, 3)?,
        stiffness: meshed(&words, 5)?,
        force: number(&words, 7)
            .zip(number(&words, 9))
            .map(|(value, mesh_error)| MeshedValue { value, mesh_error }),
        unknowns: words.get(10)?.parse().ok()?,
        time: number(&words, 11)?,
        memory: number(&words, 12)?,
    })
}

fn number(words: &[&str], place: usize) -> Option<f64> {
    words.get(place)?.parse().ok()
}

fn meshed(words: &[&str], place: usize) -> Option<MeshedValue> {
    Some(MeshedValue { value: number(words, place)?, mesh_error: number(words, place + 1)? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_read() {
        let lines = SHIPPED.lines().filter(|line| !line.starts_with('#')).count();
        assert_eq!(shells().len(), lines);
        assert_eq!(finest().len(), 24);
        let Provenance { commit, date } = provenance();
        assert!(commit.len() >= 7 && commit.chars().all(|digit| digit.is_ascii_hexdigit()), "{commit}");
        assert!(date.len() == 10 && date.starts_with("20"), "{date}");
        for pressure in [14.0, 37.0, 60.0] {
            let shell_of = |fineness: &str, points: Option<u32>| {
                let shell = shells().into_iter().find(|shell| {
                    (shell.fineness.as_str(), shell.points) == (fineness, points)
                        && shell.pressure.total_cmp(&pressure).is_eq()
                });
                shell.unwrap_or_else(|| panic!("{fineness} {points:?} {pressure}"))
            };
            assert!((3..=8).all(|n| shell_of("coarse", Some(n)).force.is_some()));
            assert!(FINENESSES.iter().all(|fineness| shell_of(fineness, None).force.is_none()));
        }
    }
}
