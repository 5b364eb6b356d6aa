//! The filled-in tables of peel tests: a row a specimen, of an iron, a laser or a press.

use crate::coupon::strips::{TEMPERATURES, WIDTH};
use crate::coupon::table::{TableColumn, read_table};
use spec::{Allowed, CONTACT, FOCUSES, Faults, POWERS, PRESS_TIMES, SEAL_SPEEDS, Source};

/// Largest peel strength, N/mm: half a ton on a strip. What is above was written in mN.
const STRONGEST: f64 = 200.0;
const TEMPERATURE: TableColumn = TableColumn {
    names: &["temperature"],
    unit: "C",
    allowed: TEMPERATURES,
    optional: false,
    slip: "convert degrees Fahrenheit to C; check whether the columns are exchanged",
};

/// Empty where a strip was not tested.
const PEEL: TableColumn = TableColumn {
    names: &["peel"],
    unit: "N",
    allowed: Allowed::closed(0.0, STRONGEST * WIDTH),
    optional: true,
    slip: "write pulls above 0, and convert mN to N",
};

/// The columns of the table that `coupon` writes for a press, with the numbers that a spec may have.
const PRESS_COLUMNS: [TableColumn; 3] = [
    TEMPERATURE,
    TableColumn {
        names: &["time"],
        unit: "s",
        allowed: PRESS_TIMES,
        optional: false,
        slip: "convert minutes to s; check whether the columns are exchanged",
    },
    PEEL,
];

const SPEED: TableColumn = TableColumn {
    names: &["speed"],
    unit: "mm_s",
    allowed: SEAL_SPEEDS,
    optional: false,
    slip: "convert mm/min to mm/s; check whether the columns are exchanged",
};

/// The columns of the table that `coupon` writes for a laser.
const LASER_COLUMNS: [TableColumn; 4] = [
    TableColumn {
        names: &["power"],
        unit: "percent",
        allowed: POWERS,
        optional: false,
        slip: "write per cent of full power, not S words; check whether the columns are exchanged",
    },
    SPEED,
    TableColumn {
        names: &["focus"],
        unit: "mm",
        allowed: FOCUSES,
        optional: false,
        slip: "convert cm to mm; check whether the columns are exchanged",
    },
    PEEL,
];

/// The columns of the table that `coupon` writes for an iron, with the numbers that a spec and a profile may have.
const COLUMNS: [TableColumn; 4] = [
    TEMPERATURE,
    SPEED,
    TableColumn {
        names: &["height"],
        unit: "mm",
        allowed: CONTACT,
        optional: false,
        slip: "convert um to mm; check whether the columns are exchanged",
    },
    PEEL,
];

/// How long a tool heats each place of a seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolPace {
    /// An iron that moves along.
    Iron {
        /// Speed, mm/s.
        speed: f64,
        /// Height of the tip, mm.
        height: f64,
    },
    /// A laser that moves along.
    Laser {
        /// Speed, mm/s.
        speed: f64,
        /// Height of the focus above the sheet, mm.
        focus: f64,
    },
    /// Plates that rest.
    Press {
        /// Time under pressure, s.
        time: f64,
    },
}

impl ToolPace {
    /// Two numbers that tell settings of one tool apart.
    pub(super) fn numbers(self) -> [f64; 2] {
        match self {
            Self::Iron { speed, height } => [speed, height],
            Self::Laser { speed, focus } => [speed, focus],
            Self::Press { time } => [time, 0.0],
        }
    }

    /// A number that grows as a part is made faster.
    pub(super) fn haste(self) -> f64 {
        match self {
            Self::Iron { speed, .. } | Self::Laser { speed, .. } => speed,
            Self::Press { time } => 1.0 / time,
        }
    }
}

/// One filled-in row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeelRow {
    /// Temperature, in degrees Celsius; of a laser its power, %.
    pub heat: f64,
    /// Speed and height, or time.
    pub pace: ToolPace,
    /// Peel force of the specimen, N over its 25 mm.
    pub peel: f64,
}

/// Reads the table of a press; rows without a peel force were not tested and are left out.
///
/// # Errors
/// All faults of the table, see [`read_table`].
pub fn read_press_rows(source: &Source) -> Result<Vec<PeelRow>, Faults> {
    let tested = |[temperature, time, peel]: [Option<f64>; 3]| {
        Some(PeelRow { heat: temperature?, pace: ToolPace::Press { time: time? }, peel: peel? })
    };
    Ok(read_table(source, &PRESS_COLUMNS)?.into_iter().filter_map(tested).collect())
}

/// Reads the table of an iron; rows without a peel force were not tested and are left out.
///
/// # Errors
/// All faults of the table, see [`read_table`].
pub fn read_rows(source: &Source) -> Result<Vec<PeelRow>, Faults> {
    read_led_rows(source, &COLUMNS, |speed, height| ToolPace::Iron { speed, height })
}

/// Reads the table of a laser; rows without a peel force were not tested and are left out.
///
/// # Errors
/// All faults of the table, see [`read_table`].
pub fn read_laser_rows(source: &Source) -> Result<Vec<PeelRow>, Faults> {
    read_led_rows(source, &LASER_COLUMNS, |speed, focus| ToolPace::Laser { speed, focus })
}

/// Reads the table of a tool that is led along: heat, speed, height and peel force.
fn read_led_rows(
    source: &Source,
    columns: &[TableColumn; 4],
    pace: impl Fn(f64, f64) -> ToolPace,
) -> Result<Vec<PeelRow>, Faults> {
    let tested = |[heat, speed, height, peel]: [Option<f64>; 4]| {
        Some(PeelRow { heat: heat?, pace: pace(speed?, height?), peel: peel? })
    };
    Ok(read_table(source, columns)?.into_iter().filter_map(tested).collect())
}
