//! From the filled-in table of a peel test to the seal settings of a spec.
//!
//! A **setting** is a commanded temperature, and speed and height of an iron or time of a press; of a laser it is power, speed and focus.
//! It **holds** if the lower bound of its peel strength, mean less two standard deviations, is at least the margin times the required
//! strength. Of the settings that hold the fastest is chosen, of equals the strongest. Fewer than three specimens of a setting, or a
//! spread above a quarter, support no choice. Without a required strength there is none either, because even the weakest seal would pass.

use geom::order::sort_by;
use std::collections::HashMap;
use std::fmt::Write;

use crate::coupon::peel_rows::{PeelRow, ToolPace};
use crate::coupon::strips::WIDTH;
use spec::units::Readable;

/// Least number of specimens of a setting.
const LEAST: usize = 3;
/// Smallest strength that a spec may state, N/mm.
const WEAKEST: f64 = 1e-3;
/// Largest standard deviation over the mean.
const SPREAD: f64 = 0.25;

/// Ten times the speed of the paper, mm/s: above it, mm/min may have been written as mm/s.
const FAST: f64 = 1.0;

/// A setting with the results of its specimens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// The setting, with its mean peel force in place of a single one.
    pub setting: PeelRow,
    /// Mean peel strength, N/mm.
    pub mean: f64,
    /// Standard deviation of the peel strength, N/mm; not a number for a single specimen.
    pub deviation: f64,
    /// Mean less two standard deviations, N/mm: the strength to write into the spec.
    pub strength: f64,
    /// Number of specimens.
    pub count: usize,
}

/// Every setting that was tested, in the order of the table. The work is linear in the number of rows.
pub fn settings(rows: &[PeelRow]) -> Vec<Calibration> {
    let mut places = HashMap::new();
    let mut groups: Vec<(PeelRow, Vec<f64>)> = Vec::new();
    for row in rows {
        // 0 is added because 0 and -0 are one height.
        let [first, second] = row.pace.numbers();
        let key = [row.heat, first, second].map(|x| (x + 0.0).to_bits());
        let place = *places.entry(key).or_insert(groups.len());
        match groups.get_mut(place) {
            Some((_, peels)) => peels.push(row.peel / WIDTH),
            None => groups.push((*row, vec![row.peel / WIDTH])),
        }
    }
    groups.iter().map(|(setting, peels)| judge(*setting, peels)).collect()
}

/// Chooses one of `settings` that holds `required` (N/mm, above 0) with `margin`.
///
/// # Errors
/// If the data do not support a choice.
pub fn calibrate(settings: &[Calibration], required: f64, margin: f64) -> Result<Calibration, String> {
    let required_mean = (margin * required).max(WEAKEST);
    let steady_settings = steady(settings)?;
    let best = steady_settings.iter().filter(|c| c.written_strength() >= required_mean).max_by(|a, b| {
        let of_haste = a.setting.pace.haste().total_cmp(&b.setting.pace.haste());
        of_haste.then(a.strength.total_cmp(&b.strength))
    });
    best.copied().ok_or_else(|| {
        let strongest = steady_settings.iter().map(|c| c.strength).fold(0.0, f64::max);
        unsupported(&format!(
            "the strongest setting holds {strongest:.3} N/mm, but {required_mean:.3} N/mm are needed ({margin} times \
             {required:.3}): seal slower, longer or hotter, or use less pressure"
        ))
    })
}

/// The settings with enough specimens and a small spread.
///
/// # Errors
/// If there are none.
pub fn steady(settings: &[Calibration]) -> Result<Vec<Calibration>, String> {
    let tested = settings.len();
    if tested == 0 {
        let reason = "no row has a `peel_N`: write the force of each tested strip into that column";
        return Err(unsupported(reason));
    }
    if !settings.iter().any(|c| c.count >= LEAST) {
        return Err(unsupported(&format!("no setting has {LEAST} specimens; tested settings: {tested}")));
    }
    let steady: Vec<Calibration> = settings.iter().filter(|c| c.unfit().is_none()).copied().collect();
    if steady.is_empty() {
        return Err(unsupported(&format!(
            "every setting's standard deviation is above {:.0} % of its mean: test more specimens, or seal \
             more evenly",
            100.0 * SPREAD
        )));
    }
    Ok(steady)
}

/// That the data do not support a choice, with the reason.
fn unsupported(reason: &str) -> String {
    format!("the data do not support a choice: {reason}")
}

fn judge(setting: PeelRow, peels: &[f64]) -> Calibration {
    #[expect(clippy::cast_precision_loss, reason = "a handful of specimens")]
    let n = peels.len() as f64;
    let mean = peels.iter().sum::<f64>() / n;
    let deviation = (peels.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let setting = PeelRow { peel: mean * WIDTH, ..setting };
    Calibration { setting, mean, deviation, strength: mean - 2.0 * deviation, count: peels.len() }
}

impl Calibration {
    /// The reason why the setting cannot be chosen, whatever strength is required; `None` if it can.
    fn unfit(&self) -> Option<&'static str> {
        let is_uneven = self.deviation > SPREAD * self.mean;
        if self.count < LEAST { Some("too few") } else { is_uneven.then_some("too uneven") }
    }

    /// The strength as it is written into the spec, N/mm: a lower bound is rounded down; 1e-6 of the last digit is rounding error.
    fn written_strength(&self) -> f64 {
        (self.strength * 1e3 + 1e-6).floor() / 1e3
    }

    /// The lines for the spec: a section of the process called `name`; of a press, which has no processes, those of [`Self::toml`].
    pub fn process_toml(&self, name: &str) -> String {
        let height = match self.setting.pace {
            ToolPace::Iron { height, .. } => format!("height = \"{height} mm\"\n"),
            ToolPace::Laser { .. } => String::new(),
            ToolPace::Press { .. } => return self.toml(),
        };
        format!(
            "{}{}[process.{name}]\n{}{height}strength = \"{:.3} N/mm\"\n",
            self.specimens(),
            self.speed_comment(),
            self.keys(),
            self.written_strength()
        )
    }

    /// The keys of the setting, without the height of an iron, which a profile may have.
    fn keys(&self) -> String {
        let heat = self.setting.heat;
        match self.setting.pace {
            ToolPace::Iron { speed, .. } => format!("temperature = \"{heat} C\"\nspeed = \"{speed} mm/s\"\n"),
            ToolPace::Laser { speed, focus } => {
                format!("power = \"{heat} %\"\nspeed = \"{speed} mm/s\"\nfocus = \"{focus} mm\"\n")
            }
            ToolPace::Press { time } => format!("temperature = \"{heat} C\"\ntime = \"{time} s\"\n"),
        }
    }

    /// The comment on the speed of an iron, if it may be in another unit; a laser is as fast as its power allows.
    fn speed_comment(&self) -> String {
        match self.setting.pace {
            ToolPace::Iron { speed, .. } => warning(speed),
            ToolPace::Laser { .. } | ToolPace::Press { .. } => String::new(),
        }
    }

    /// The comment on the specimens.
    fn specimens(&self) -> String {
        let Self { mean, deviation, count, .. } = self;
        format!(
            "# {count} specimens: {mean:.3} N/mm, standard deviation {deviation:.3}; strength: mean less two \
             standard deviations\n"
        )
    }

    /// The lines for the spec.
    pub fn toml(&self) -> String {
        let (section, height_comment) = match self.setting.pace {
            ToolPace::Iron { height, .. } => {
                ("seal", format!("# tip at {height} mm: heights.contact of the machine profile\n"))
            }
            ToolPace::Laser { .. } => ("seal", String::new()),
            ToolPace::Press { .. } => ("press", String::new()),
        };
        format!(
            "{}[fabric]\nseal_strength = \"{:.3} N/mm\"\n\n{height_comment}{}[{section}]\n{}",
            self.specimens(),
            self.written_strength(),
            self.speed_comment(),
            self.keys()
        )
    }
}

/// The comment on a speed, mm/s, that may be in another unit; empty for a usual one.
fn warning(speed: f64) -> String {
    if speed > FAST {
        format!(
            "# {speed} mm/s is more than ten times the paper's 0.1 mm/s; if the strips were sealed at {speed} mm/min, \
             write speed = \"{} mm/s\"\n",
            Readable(speed / 60.0)
        )
    } else {
        String::new()
    }
}

/// The settings as a printed table, the fastest first; every line begins with "# ", as a comment of a spec.
pub fn listing(settings: &[Calibration]) -> String {
    let mut sorted: Vec<&Calibration> = settings.iter().collect();
    sort_by(&mut sorted, |a, b| b.setting.pace.haste().total_cmp(&a.setting.pace.haste()));
    let pace_heads = match sorted.first().map(|c| c.setting.pace) {
        Some(ToolPace::Press { .. }) => "time/s  temperature/C",
        Some(ToolPace::Laser { .. }) => "speed/(mm/s)        power/%   focus/mm",
        Some(ToolPace::Iron { .. }) | None => "speed/(mm/s)  temperature/C  height/mm",
    };
    let mut lines = format!("# {pace_heads}  specimens  mean/(N/mm)  deviation  holds/(N/mm)\n");
    for c in sorted {
        let heat = c.setting.heat;
        let pace = match c.setting.pace {
            ToolPace::Iron { speed, height: place } | ToolPace::Laser { speed, focus: place } => {
                format!("{speed:12}  {heat:13}  {place:9}")
            }
            ToolPace::Press { time } => format!("{time:6}  {heat:13}"),
        };
        let strength = c.unfit().map_or_else(|| format!("{:.3}", c.strength), str::to_owned);
        let deviation = if c.count > 1 { format!("{:.3}", c.deviation) } else { "-".to_owned() };
        // Writing to a String does not fail.
        let _ = writeln!(lines, "# {pace}  {:9}  {:11.3}  {deviation:>9}  {strength:>12}", c.count, c.mean);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupon::peel_rows::{read_laser_rows, read_press_rows, read_rows};
    use spec::Source;

    const TABLE: &str = "strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n\
        1,200,0.1,-0.3,75,peel\n2,200,0.1,-0.3,78,peel\n3,200,0.1,-0.3,72,peel\n\
        4,200,0.5,-0.3,50,peel\n5,200,0.5,-0.3,52,peel\n6,200,0.5,-0.3,48,peel\n\
        7,200,1,-0.3,20,peel\n8,200,1,-0.3,40,peel\n9,200,1,-0.3,10,peel\n10,220,1,-0.3,,\n";

    fn rows() -> Vec<PeelRow> {
        read_rows(&Source::new("results.csv", TABLE)).expect("a table")
    }

    #[test]
    fn the_fastest_that_holds_is_chosen() {
        assert_eq!(rows().len(), 9);
        let tested = settings(&rows());
        let fast = calibrate(&tested, 1.0, 1.5).expect("0.5 mm/s holds");
        assert_eq!((fast.setting.pace.haste(), fast.count), (0.5, 3));
        assert!((fast.mean - 2.0).abs() < 1e-12 && (fast.deviation - 0.08).abs() < 1e-12);
        assert!((fast.strength - 1.84).abs() < 1e-12 && fast.toml().contains("speed = \"0.5 mm/s\""));
        assert!(fast.toml().contains("seal_strength = \"1.840 N/mm\""), "{}", fast.toml());
        assert_eq!(calibrate(&tested, 1.5, 1.5).expect("0.1 mm/s holds").setting.pace.haste(), 0.1);
    }

    #[test]
    fn a_strength_is_rounded_down() {
        let row = |peel| PeelRow { heat: 200.0, pace: ToolPace::Iron { speed: 1.0, height: 0.0 }, peel };
        let toml = settings(&[row(49.99), row(49.99), row(49.99)])[0].toml();
        assert!(toml.contains("seal_strength = \"1.999 N/mm\""), "{toml}");
    }

    #[test]
    fn what_no_spec_may_say_is_refused_with_its_line_and_the_likely_slip() {
        let head = "temperature_C,speed_mm_s,height_mm,peel_N\n200,0.1,-0.3,144\n";
        for (row, words) in [
            ("0.2,200,-0.3,144", ["`temperature_C` is `0.2`", "more than 40 and less than 300", "exchanged"]),
            (
                "392,0.1,-0.3,144",
                ["`temperature_C` is `392`", "more than 40 and less than 300", "Fahrenheit"],
            ),
            ("200,2000,-0.3,144", ["`speed_mm_s` is `2000`", "at most 1000", "mm/s"]),
            ("200,0.1,300,144", ["`height_mm` is `300`", "at least -20 and at most 0", "um"]),
            ("200,0.1,-0.3,144000", ["`peel_N` is `144000`", "at most 5000", "mN"]),
        ] {
            let faults = read_rows(&Source::new("results.csv", format!("{head}{row}\n"))).expect_err(row);
            let message = faults.to_string();
            assert!(message.contains("results.csv:3"), "{message}");
            assert!(words.iter().all(|word| message.contains(word)), "{message}");
        }
    }

    #[test]
    fn a_speed_that_may_be_in_mm_per_minute_is_said_to() {
        let pace = |speed| ToolPace::Iron { speed, height: 0.0 };
        let row = PeelRow { heat: 200.0, pace: pace(12.0), peel: 50.0 };
        let text = settings(&[row; 3])[0].toml();
        assert!(text.contains("sealed at 12 mm/min, write speed = \"0.2 mm/s\""), "{text}");
        let slow = settings(&[PeelRow { pace: pace(1.0), ..row }; 3])[0].toml();
        assert!(!slow.contains("mm/min"), "{slow}");
    }

    #[test]
    fn data_that_support_nothing_are_said_to() {
        let reason =
            |rows: &[PeelRow], needed| calibrate(&settings(rows), needed, 1.5).expect_err("no choice");
        assert!(reason(&rows()[..2], 1.0).contains("no setting has 3 specimens"));
        assert!(reason(&rows()[6..], 0.1).contains("standard deviation is above 25 %"));
        assert!(reason(&rows(), 10.0).contains("the strongest setting holds 2.760 N/mm"));
    }

    #[test]
    fn the_listing_says_of_every_setting_what_it_holds() {
        let text = listing(&settings(&rows()[..7]));
        let last: Vec<&str> =
            text.lines().skip(1).filter_map(|line| line.split_whitespace().last()).collect();
        assert_eq!(last, ["few", "1.840", "2.760"], "{text}");
    }

    #[test]
    fn settings_are_told_apart_by_all_of_their_values() {
        let row = |heat, speed, height| PeelRow { heat, pace: ToolPace::Iron { speed, height }, peel: 25.0 };
        let rows = [
            row(200.0, 1.0, 0.0),
            row(200.0, 1.0, -0.0),
            row(201.0, 1.0, 0.0),
            row(200.0, 2.0, 0.0),
            row(200.0, 1.0, 0.1),
        ];
        assert_eq!(settings(&rows).iter().map(|c| c.count).collect::<Vec<_>>(), [2, 1, 1, 1]);
    }

    /// A laser: the fastest that holds is chosen, and its values are those of [seal].
    #[test]
    fn the_fastest_laser_that_holds_is_chosen() {
        let table = "strip,power_percent,speed_mm_s,focus_mm,peel_N,failure\n1,8,10,12,75,\n2,8,10,12,78,\n3,8,10,12,72,\n\
            4,8,20,12,20,\n5,8,20,12,21,\n6,8,20,12,19,\n7,10,20,12,80,\n8,10,20,12,80,\n9,10,20,12,80,\n10,10,40,12,,\n";
        let tested = settings(&read_laser_rows(&Source::new("results.csv", table)).expect("a table"));
        let fastest = calibrate(&tested, 1.5, 1.5).expect("10 % hold at 20 mm/s");
        assert!(
            fastest.toml().ends_with("[seal]\npower = \"10 %\"\nspeed = \"20 mm/s\"\nfocus = \"12 mm\"\n"),
            "{}",
            fastest.toml()
        );
        assert!(fastest.process_toml("strong").contains("[process.strong]\npower = \"10 %\""));
        let faults = read_laser_rows(&Source::new("results.csv", table.replace("1,8,10", "1,800,10")))
            .expect_err("S words");
        assert!(faults.to_string().contains("not S words"), "{faults}");
    }

    /// A press: the shortest time that holds is chosen, and its values are those of [press].
    #[test]
    fn the_shortest_pressing_that_holds_is_chosen() {
        let table = "strip,temperature_C,time_s,peel_N,failure\n1,145,5,30,seal\n2,145,5,31,seal\n3,145,5,29,seal\n\
            4,145,10,75,fabric\n5,145,10,78,fabric\n6,145,10,72,fabric\n7,145,20,80,\n8,145,20,80,\n9,145,20,80,\n10,155,5,,\n";
        let tested = settings(&read_press_rows(&Source::new("results.csv", table)).expect("a table"));
        assert_eq!(tested.len(), 3);
        let choice = calibrate(&tested, 1.5, 1.5).expect("10 s hold").toml();
        assert!(choice.ends_with("[press]\ntemperature = \"145 C\"\ntime = \"10 s\"\n"), "{choice}");
        assert!(choice.contains("seal_strength = \"2.760 N/mm\""), "{choice}");
        let first = listing(&tested).lines().nth(1).map(str::to_owned).unwrap_or_default();
        assert!(first.starts_with("#      5            145          3"), "{first}");
        let iron = read_press_rows(&Source::new("results.csv", TABLE)).expect_err("no time");
        assert!(iron.to_string().contains("time_s"), "{iron}");
    }
}
