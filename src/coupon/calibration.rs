//! From the filled-in table of a peel test to what a spec should say.
//!
//! A setting **holds** if the lower bound of its peel strength, mean less two standard deviations, is at least the margin
//! times what is needed. Of the settings that hold the fastest is chosen, of equals the strongest. Fewer than three
//! specimens of a setting, or a spread above a quarter, support no choice.

use std::fmt;

use crate::coupon::strips::WIDTH;

/// Fewest specimens of a setting.
const LEAST: usize = 3;
/// The least that a spec can say, N/mm: below it nothing holds.
const WEAKEST: f64 = 1e-3;
/// Largest standard deviation over the mean.
const SPREAD: f64 = 0.25;

/// One filled-in row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Temperature, in degrees Celsius.
    pub temperature: f64,
    /// Speed, mm/s.
    pub speed: f64,
    /// Height, mm.
    pub height: f64,
    /// Peel force of the specimen, N over its 25 mm.
    pub peel: f64,
}

/// Why there is nothing to choose.
#[derive(Clone, Debug, PartialEq)]
pub enum CalibrationFault {
    /// A line of the table that cannot be read: number, what is wrong.
    Line(usize, String),
    /// The data do not support a choice: why.
    Unsupported(String),
}

impl fmt::Display for CalibrationFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line, what) => write!(f, "line {line}: {what}"),
            Self::Unsupported(why) => write!(f, "the data do not support a choice: {why}"),
        }
    }
}

impl std::error::Error for CalibrationFault {}

/// What was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// The setting, with its mean peel force in place of a single one.
    pub setting: Row,
    /// Mean peel strength, N/mm.
    pub mean: f64,
    /// Standard deviation of the peel strength, N/mm.
    pub deviation: f64,
    /// Mean less two standard deviations, N/mm: what the spec should count on.
    pub strength: f64,
    /// Number of specimens.
    pub count: usize,
}

/// Reads the table; rows without a peel force were not tested and are left out.
///
/// # Errors
/// For the first line that cannot be read.
pub fn read_rows(csv: &str) -> Result<Vec<Row>, CalibrationFault> {
    let mut lines = (1..).zip(csv.lines()).filter(|(_, line)| !line.trim().is_empty());
    let fault = |line: usize, what: &str| CalibrationFault::Line(line, what.to_owned());
    let (_, head) = lines.next().ok_or_else(|| fault(1, "an empty table"))?;
    let names: Vec<&str> = head.trim_start_matches('\u{feff}').split(',').map(str::trim).collect();
    let column = |name: &str| {
        let missing = format!("no column {name}; the columns are those that `coupon` wrote");
        names.iter().position(|known| *known == name).ok_or(CalibrationFault::Line(1, missing))
    };
    let (t, v, h) = (column("temperature_C")?, column("speed_mm_s")?, column("height_mm")?);
    let p = column("peel_N")?;
    let mut rows = Vec::new();
    for (number, line) in lines {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if cells.get(p).is_none_or(|cell| cell.is_empty()) {
            continue;
        }
        let value = |at: usize, name: &str, low: f64| {
            let cell = cells.get(at).copied().unwrap_or_default();
            let number_of = cell.parse::<f64>().ok().filter(|x| x.is_finite() && *x >= low && *x <= 1e6);
            number_of
                .ok_or_else(|| fault(number, &format!("{name} is {cell:?}; a number from {low} is needed")))
        };
        rows.push(Row {
            temperature: value(t, "temperature_C", 0.0)?,
            speed: value(v, "speed_mm_s", 1e-3)?,
            height: value(h, "height_mm", -20.0)?,
            peel: value(p, "peel_N", 0.0)?,
        });
    }
    Ok(rows)
}

/// Chooses a setting that holds `needed` (N/mm) with `margin`.
///
/// # Errors
/// If the data do not support a choice.
pub fn calibrate(rows: &[Row], needed: f64, margin: f64) -> Result<Calibration, CalibrationFault> {
    let unsupported = |why: String| Err(CalibrationFault::Unsupported(why));
    let mut settings: Vec<(Row, Vec<f64>)> = Vec::new();
    for row in rows {
        let same = |other: &Row| {
            (other.temperature, other.speed, other.height) == (row.temperature, row.speed, row.height)
        };
        match settings.iter_mut().find(|(setting, _)| same(setting)) {
            Some((_, peels)) => peels.push(row.peel / WIDTH),
            None => settings.push((*row, vec![row.peel / WIDTH])),
        }
    }
    let tested = settings.len();
    settings.retain(|(_, peels)| peels.len() >= LEAST);
    if settings.is_empty() {
        return unsupported(format!("no setting has {LEAST} specimens, of {tested} that were tested"));
    }
    let judged: Vec<Calibration> = settings.iter().map(|(setting, peels)| judge(*setting, peels)).collect();
    let steady: Vec<&Calibration> = judged.iter().filter(|c| c.deviation <= SPREAD * c.mean).collect();
    if steady.is_empty() {
        return unsupported(format!(
            "every setting's spread is above {:.0} % of its mean: test more, or seal more evenly",
            100.0 * SPREAD
        ));
    }
    let best = steady
        .iter()
        .filter(|c| c.strength >= (margin * needed).max(WEAKEST))
        .max_by(|a, b| a.setting.speed.total_cmp(&b.setting.speed).then(a.strength.total_cmp(&b.strength)));
    if let Some(best) = best {
        return Ok(**best);
    }
    let least = (margin * needed).max(WEAKEST);
    let strongest = steady.iter().map(|c| c.strength).fold(0.0, f64::max);
    unsupported(format!(
        "the strongest setting holds {strongest:.3} N/mm, and {least:.3} N/mm is needed ({margin} times {needed}): slower, hotter, or \
         less pressure"
    ))
}

fn judge(setting: Row, peels: &[f64]) -> Calibration {
    #[expect(clippy::cast_precision_loss, reason = "a handful of specimens")]
    let n = peels.len() as f64;
    let mean = peels.iter().sum::<f64>() / n;
    let deviation = (peels.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let setting = Row { peel: mean * WIDTH, ..setting };
    Calibration { setting, mean, deviation, strength: mean - 2.0 * deviation, count: peels.len() }
}

impl Calibration {
    /// The lines for the spec.
    pub fn toml(&self) -> String {
        let Self { setting, mean, deviation, strength, count } = self;
        format!(
            "# {count} specimens: {mean:.3} N/mm, standard deviation {deviation:.3}; mean less two of them:\n\
             [fabric]\nseal_strength = \"{strength:.3} N/mm\"\n\n\
             # tip at {} mm: heights.contact of the machine profile\n\
             [seal]\ntemperature = \"{} C\"\nspeed = \"{} mm/s\"\n",
            setting.height, setting.temperature, setting.speed
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n\
        1,200,0.1,-0.3,75,peel\n2,200,0.1,-0.3,78,peel\n3,200,0.1,-0.3,72,peel\n\
        4,200,0.5,-0.3,50,peel\n5,200,0.5,-0.3,52,peel\n6,200,0.5,-0.3,48,peel\n\
        7,200,1,-0.3,20,peel\n8,200,1,-0.3,40,peel\n9,200,1,-0.3,10,peel\n10,220,1,-0.3,,\n";

    #[test]
    fn the_fastest_that_holds_is_chosen() {
        let rows = read_rows(TABLE).expect("a table");
        assert_eq!(rows.len(), 9);
        let fast = calibrate(&rows, 1.0, 1.5).expect("0.5 mm/s holds");
        assert_eq!((fast.setting.speed, fast.count), (0.5, 3));
        assert!((fast.mean - 2.0).abs() < 1e-12 && (fast.deviation - 0.08).abs() < 1e-12);
        assert!((fast.strength - 1.84).abs() < 1e-12 && fast.toml().contains("speed = \"0.5 mm/s\""));
        assert_eq!(calibrate(&rows, 1.5, 1.5).expect("0.1 mm/s holds").setting.speed, 0.1);
    }

    #[test]
    fn data_that_support_nothing_are_said_to() {
        let rows = read_rows(TABLE).expect("a table");
        let why = |rows: &[Row], needed| match calibrate(rows, needed, 1.5) {
            Err(CalibrationFault::Unsupported(why)) => why,
            other => panic!("{other:?}"),
        };
        assert!(why(&rows[..2], 1.0).contains("no setting has 3 specimens"));
        assert!(why(&rows[6..], 0.1).contains("spread is above 25 %"));
        assert!(why(&rows, 10.0).contains("the strongest setting holds 2.760 N/mm"));
        for bad in ["", "a,b\n1,2\n", &TABLE.replace(",75,", ",nan,"), &TABLE.replace("1,200,0.1", "1,x,0.1")]
        {
            assert!(matches!(read_rows(bad), Err(CalibrationFault::Line(..))), "{bad}");
        }
    }
}
