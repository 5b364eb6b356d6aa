//! The shells of every fineness, as they were computed once: `by_shell.txt`, by `by_shell.py`.

/// One computation a line.
const SHIPPED: &str = include_str!("by_shell.txt");

/// The finenesses, from the coarsest.
pub const FINENESSES: [&str; 3] = ["coarse", "medium", "fine"];

/// A number of the shell, with its mesh error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshedNumber {
    /// Its value.
    pub value: f64,
    /// Its mesh error.
    pub error: f64,
}

/// One shell.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell {
    /// How fine its meshes are, as `--fineness` says it.
    pub fineness: String,
    /// n; `None` for the V-actuator.
    pub points: Option<u32>,
    /// Gauge pressure, kPa.
    pub pressure: f64,
    /// Final radius, mm; the V-actuator's angle at rest, deg.
    pub rest: MeshedNumber,
    /// Radial stiffness, N/m, no number where meshes leave more open than itself; the V-actuator's stiffness, N m.
    pub stiffness: MeshedNumber,
    /// Force on a round object 0.45 W wider than the finest shell's final radius, N; stars only.
    pub force: Option<MeshedNumber>,
    /// Unknowns of its finest mesh.
    pub unknowns: u32,
    /// User time, s.
    pub time: f64,
    /// Largest memory of the process, MB.
    pub memory: f64,
}

/// All of them.
pub fn shells() -> Vec<Shell> {
    SHIPPED.lines().filter(|line| !line.starts_with('#')).filter_map(shell).collect()
}

fn shell(line: &str) -> Option<Shell> {
    let words: Vec<&str> = line.split(' ').collect();
    let number = |at: usize| words.get(at)?.parse::<f64>().ok();
    let meshed = |at: usize| Some(MeshedNumber { value: number(at)?, error: number(at + 1)? });
    let points: u32 = words.get(1)?.parse().ok()?;
    Some(Shell {
        fineness: (*words.first()?).to_owned(),
        points: (points > 0).then_some(points),
        pressure: number(2)?,
        rest: meshed(3)?,
        stiffness: meshed(5)?,
        force: number(7).zip(number(9)).map(|(value, error)| MeshedNumber { value, error }),
        unknowns: words.get(10)?.parse().ok()?,
        time: number(11)?,
        memory: number(12)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_read() {
        let lines = SHIPPED.lines().filter(|line| !line.starts_with('#')).count();
        assert_eq!(shells().len(), lines);
        for pressure in [14.0, 37.0, 60.0] {
            let of = |fineness: &str, points: Option<u32>| {
                let found = shells().into_iter().find(|shell| {
                    (shell.fineness.as_str(), shell.points) == (fineness, points)
                        && shell.pressure.total_cmp(&pressure).is_eq()
                });
                found.unwrap_or_else(|| panic!("{fineness} {points:?} {pressure}"))
            };
            assert!((3..=8).all(|n| of("coarse", Some(n)).force.is_some()));
            assert!(FINENESSES.iter().all(|fineness| of(fineness, None).force.is_none()));
        }
    }
}
