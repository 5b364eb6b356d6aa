//! Tables of bench tests: CSV as an editor or a spreadsheet saves it. A faulty table is refused with all of its faults.
//!
//! A **column** is found by the name and the unit in its header, at any position; columns of other names are ignored. The unit follows the
//! name as `coupon` writes it, or in brackets: `speed_mm_s`, `speed (mm/s)`, `speed [mm/s]`. Cells are separated by comma, semicolon or
//! tab, whichever the header uses. Empty lines and lines that begin with `#` are skipped; every other line has as many cells as the header.
//! Decimals have a point: a comma there is a fault, because `10,5` is two cells in one table and one in another.

use std::ops::Range;

use csv::{ReaderBuilder, StringRecord, Trim};

use spec::units::count_text;
use spec::{Allowed, Fault, FaultCode, Faults, Source};

/// Largest number of collected faults: a wrong file has one a line.
const FAULTS: usize = 100;
/// Longest line, bytes: above any row of numbers. A file without lines is no table, and would need a multiple of its size in memory.
const LONGEST_LINE: usize = 1 << 16;
/// The byte order mark that spreadsheets write before UTF-8.
const MARK: char = '\u{feff}';

/// A column of numbers that a table must have.
#[derive(Clone, Copy, Debug)]
pub struct TableColumn {
    /// Names of the column, in lower case; `coupon` writes the first, the others are synonyms.
    pub names: &'static [&'static str],
    /// Unit of the column: `mm_s` for mm/s.
    pub unit: &'static str,
    /// The range of its numbers.
    pub allowed: Allowed,
    /// Whether its cells may be empty.
    pub optional: bool,
    /// The remedy for a number outside its range: the likely slip.
    pub slip: &'static str,
}

impl TableColumn {
    /// The header as `coupon` writes it.
    fn header(&self) -> String {
        format!("{}_{}", self.names[0], self.unit)
    }

    /// The unit in a `header` that names this column, empty without a unit; `None` if it names another column.
    fn unit_in(&self, header: &str) -> Option<String> {
        let (name, unit) = match header.split_once(['(', '[']) {
            Some((name, unit)) => (name, unit.strip_suffix([')', ']']).unwrap_or_default()),
            None => header.split_once('_').unwrap_or((header, "")),
        };
        let name = name.trim().to_ascii_lowercase();
        self.names.contains(&name.as_str()).then(|| unit.trim().replace('/', "_"))
    }
}

/// The numbers of every row of `source`, in the order of `columns`; `None` where an optional cell is empty.
///
/// The work is linear in the length of the text.
///
/// # Errors
/// All faults (at most 100) with their places: no header; a column that is missing, duplicate or in another unit; a row with more or fewer
/// cells than the header; a cell that is not a number in its range.
pub fn read_table<const N: usize>(
    source: &Source,
    columns: &[TableColumn; N],
) -> Result<Vec<[Option<f64>; N]>, Faults> {
    let mut table = Table::new(source);
    let rows = table.read(columns);
    if table.faults.is_empty() { Ok(rows) } else { Err(Faults::new(source, table.faults)) }
}

/// The state of the reader.
struct Table<'a> {
    text: &'a str,
    delimiter: u8,
    faults: Vec<Fault>,
}

impl<'a> Table<'a> {
    fn new(source: &'a Source) -> Self {
        let text = source.text.as_str();
        let is_said = |line: &&str| !line.starts_with('#') && line.contains(char::is_alphanumeric);
        let header = text.trim_start_matches(MARK).lines().find(is_said).unwrap_or_default();
        let delimiter = [b';', b'\t'].into_iter().find(|d| header.as_bytes().contains(d)).unwrap_or(b',');
        Self { text, delimiter, faults: Vec::new() }
    }

    fn read<const N: usize>(&mut self, columns: &[TableColumn; N]) -> Vec<[Option<f64>; N]> {
        // If a lone CR ended lines, a comment would hide the rest of the file.
        let bytes = self.text.as_bytes();
        if let Some(place) = (0..bytes.len()).find(|i| bytes[*i] == b'\r' && bytes.get(i + 1) != Some(&b'\n'))
        {
            let fault = Fault::error(FaultCode::LineEnd, place..place + 1, "a line ends with CR alone");
            self.faults.push(fault.label("must be LF or CRLF").help("save the table as CSV again"));
            return Vec::new();
        }
        if let Some((place, length)) = self.long_line() {
            let fault = Fault::error(FaultCode::TooLarge, place..place, format!("a line of {length} bytes"));
            let label = format!("must have at most {LONGEST_LINE}");
            self.faults.push(fault.label(label).help("is this the right file?"));
            return Vec::new();
        }
        let start = if self.text.starts_with(MARK) { MARK.len_utf8() } else { 0 };
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(self.delimiter)
            .comment(Some(b'#'))
            .trim(Trim::All)
            .from_reader(&bytes[start..]);
        let (mut record, mut header, mut rows) = (StringRecord::new(), None, Vec::new());
        // Reading cannot fail: the bytes are in memory, and the text is UTF-8.
        while self.faults.len() < FAULTS && reader.read_record(&mut record).unwrap_or(false) {
            let place = record.position().and_then(|place| usize::try_from(place.byte()).ok()).unwrap_or(0);
            let line = self.line(start + place);
            if record.iter().all(str::is_empty) {
                continue;
            }
            match header {
                None => match self.header(&record, &line, columns) {
                    Some(places) => header = Some((places, record.len())),
                    None => return Vec::new(),
                },
                Some((places, count)) => rows.extend(self.row(&record, &line, columns, places, count)),
            }
        }
        if header.is_none() && self.faults.is_empty() {
            let fault = Fault::error(FaultCode::NoHeader, self.text.len()..self.text.len(), "an empty table");
            self.faults.push(fault.label(format!("needs {}", headers(columns))));
        }
        rows
    }

    /// The start and the length of the first line that is too long for a table.
    fn long_line(&self) -> Option<(usize, usize)> {
        let mut end = 0;
        let mut lines = self.text.split_inclusive('\n').map(|line| {
            end += line.len();
            (end - line.len(), line.len())
        });
        lines.find(|(_, length)| *length > LONGEST_LINE)
    }

    /// The line of the record that begins at or after `place`: past ends of lines and comments.
    fn line(&self, place: usize) -> Range<usize> {
        let mut start = place;
        loop {
            let end = self.text[start..].find('\n').map_or(self.text.len(), |length| start + length);
            match self.text.as_bytes().get(start) {
                Some(b'\n' | b'\r') => start += 1,
                Some(b'#') => start = end,
                _ => return start..end,
            }
        }
    }

    /// The index of each of `columns`; `None` with faults if one is missing.
    fn header<const N: usize>(
        &mut self,
        record: &StringRecord,
        line: &Range<usize>,
        columns: &[TableColumn; N],
    ) -> Option<[usize; N]> {
        // A line without any of the names is no header. Else each column is looked for by itself, so that all that are missing,
        // doubled or in another unit are reported at once.
        let mut places = [0; N];
        let is_header = |cell: &str| columns.iter().any(|column| column.unit_in(cell).is_some());
        if !record.iter().any(is_header) {
            let fault = Fault::error(FaultCode::NoHeader, line.clone(), "this line is not a header")
                .label(format!("must have the columns {}", headers(columns)))
                .help("write the names above the numbers, with these units");
            self.faults.push(fault);
            return None;
        }
        for (column, place) in columns.iter().zip(&mut places) {
            let name = column.header();
            let matches: Vec<(usize, String)> = (0..)
                .zip(record)
                .filter_map(|(i, cell)| column.unit_in(cell).map(|unit| (i, unit)))
                .collect();
            let fault = match matches.as_slice() {
                [(i, unit)] if unit == column.unit => {
                    *place = *i;
                    continue;
                }
                [(i, unit)] => {
                    let is = if unit.is_empty() { "has no unit" } else { "is in another unit" };
                    let message = format!("`{}` {is}", shortened(&record[*i]));
                    Fault::error(FaultCode::Unit, self.cell(line, *i), message)
                        .label(format!("must be `{name}`"))
                        .help("convert the numbers if they are in another one")
                }
                [] => Fault::error(FaultCode::NoColumn, line.clone(), format!("no column `{name}`"))
                    .label(format!("must have the columns {}", headers(columns))),
                [_, (i, _), ..] => {
                    let message = format!("a second column `{}`", shortened(&record[*i]));
                    Fault::error(FaultCode::TwoColumns, self.cell(line, *i), message)
                        .label(format!("`{name}` must occur once"))
                }
            };
            self.faults.push(fault);
        }
        self.faults.is_empty().then_some(places)
    }

    /// The numbers of a row; `None` with faults if they cannot be read.
    fn row<const N: usize>(
        &mut self,
        record: &StringRecord,
        line: &Range<usize>,
        columns: &[TableColumn; N],
        places: [usize; N],
        count: usize,
    ) -> Option<[Option<f64>; N]> {
        // Faults of the whole line come first: an open quote, or another number of cells. Then each cell is read, and every bad
        // number is reported.
        if record.iter().any(|cell| cell.contains('\n')) {
            let fault = Fault::error(FaultCode::OpenQuote, line.clone(), "a cell continues in the next line");
            self.faults
                .push(fault.label("must end in its line").help("check for a quote that is not closed"));
            return None;
        }
        if record.len() != count {
            let fault = Fault::error(FaultCode::CellCount, line.clone(), count_text(record.len(), "cell"));
            let help = match (record.len() > count, self.text[line.clone()].contains(';')) {
                (_, true) => {
                    "the header is not separated by `;`: write one separator throughout, decimals with a point"
                }
                (true, _) => "write decimals with a point: 10.5",
                (false, _) => "where a value is missing, keep an empty cell",
            };
            self.faults.push(fault.label(format!("must be {count}, as the header has")).help(help));
            return None;
        }
        let fault_count = self.faults.len();
        let mut row = [None; N];
        for ((column, place), value) in columns.iter().zip(places).zip(&mut row) {
            let cell = &record[place];
            if cell.is_empty() && column.optional {
                continue;
            }
            match cell.parse::<f64>() {
                Ok(number) if column.allowed.contains(number) => *value = Some(number),
                _ => {
                    let place = self.cell(line, place);
                    self.faults.push(bad_number(column, cell, place));
                }
            }
        }
        (self.faults.len() == fault_count).then_some(row)
    }

    /// Place of cell `index` in `line`; the whole line if quotes hide the cell.
    fn cell(&self, line: &Range<usize>, index: usize) -> Range<usize> {
        let text = &self.text[line.clone()];
        let delimiter = char::from(self.delimiter);
        let cell = text.split(delimiter).nth(index).filter(|_| !text.contains('"'));
        cell.map_or(line.clone(), |cell| {
            let offset: usize = text.split(delimiter).take(index).map(|cell| cell.len() + 1).sum();
            let blanks = cell.len() - cell.trim_start().len();
            let start = line.start + offset + blanks;
            start..start + cell.trim().len()
        })
    }
}

/// A cell that is no number of its column.
fn bad_number(column: &TableColumn, cell: &str, place: Range<usize>) -> Fault {
    let name = column.header();
    let pointed = cell.replacen(',', ".", 1);
    if cell.contains(',') && pointed.parse::<f64>().is_ok() {
        let message = format!("`{name}` is `{cell}`: a decimal comma");
        return Fault::error(FaultCode::DecimalComma, place, message).label(format!("write {pointed}"));
    }
    let problem = if cell.is_empty() { "empty".to_owned() } else { format!("`{}`", shortened(cell)) };
    let label = format!("a number is needed; it {}", column.allowed.in_words(""));
    let fault = Fault::error(FaultCode::Cell, place, format!("`{name}` is {problem}")).label(label);
    if cell.parse::<f64>().is_ok_and(f64::is_finite) { fault.help(column.slip) } else { fault }
}

/// The first 40 characters of a cell, for a message.
fn shortened(cell: &str) -> String {
    cell.chars().take(40).flat_map(char::escape_debug).collect()
}

/// "`travel_mm`, `load_N`".
fn headers(columns: &[TableColumn]) -> String {
    columns.iter().map(|column| format!("`{}`", column.header())).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [TableColumn; 2] = [
        TableColumn {
            names: &["travel", "extension"],
            unit: "mm",
            allowed: Allowed::closed(-10.0, 1e3),
            optional: false,
            slip: "are these um?",
        },
        TableColumn {
            names: &["speed"],
            unit: "mm_s",
            allowed: Allowed::closed(0.0, 10.0),
            optional: true,
            slip: "are these mm/min?",
        },
    ];

    fn rows(text: &str) -> Vec<[Option<f64>; 2]> {
        read_table(&Source::new("t.csv", text), &COLUMNS)
            .unwrap_or_else(|faults| panic!("{text:?}\n{faults}"))
    }

    /// Code and line of every fault.
    fn faults(text: &str) -> Vec<(&'static str, usize)> {
        let source = Source::new("t.csv", text);
        let faults = read_table(&source, &COLUMNS).expect_err(text);
        let line = |at: usize| 1 + text[..at].matches('\n').count();
        faults.list().iter().map(|fault| (fault.code, line(fault.span.start))).collect()
    }

    #[test]
    fn columns_are_found_by_name_and_unit_wherever_they_stand() {
        let expected = [[Some(10.5), Some(2.0)], [Some(-1.0), None]];
        for text in [
            "travel_mm,speed_mm_s\n10.5,2\n-1,\n",
            "speed (mm/s);note;Extension [mm]\r\n2;x;10.5\r\n;;-1",
            "\u{feff}# a test\n\n\"travel_mm\"\tspeed_mm_s\n10.5\t 2\n# a pause\n\t\n\"-1\"\t\n\n",
        ] {
            assert_eq!(rows(text), expected, "{text:?}");
        }
    }

    #[test]
    fn no_row_is_lost_and_every_fault_is_named_with_its_line() {
        let head = "travel_mm,speed_mm_s\n";
        for (text, expected) in [
            ("", vec![("no-header", 1)]),
            ("1,2\n3,4\n", vec![("no-header", 1)]),
            ("\u{feff}\n# x\nO,0.5\n3,4\n", vec![("no-header", 3)]),
            ("10,5;2,5\n", vec![("no-header", 1)]),
            ("travel_mm\n1\n", vec![("no-column", 1)]),
            ("travel,speed_m_s\n1,2\n", vec![("unit", 1), ("unit", 1)]),
            ("travel_mm,speed_mm_s,extension_mm\n1,2,3\n", vec![("two-columns", 1)]),
            ("travel_mm;speed_mm_s\n10,5;2,5\n", vec![("decimal-comma", 2), ("decimal-comma", 2)]),
            (&format!("{head}\"10,5\",2\n"), vec![("decimal-comma", 2)]),
            (&format!("{head}1,2\n10,5,2,5\n10,5;2,5\n"), vec![("cell-count", 3), ("cell-count", 4)]),
            (&format!("{head}1\n1,2\n\n\n1,2,\n"), vec![("cell-count", 2), ("cell-count", 6)]),
            (
                &format!("{head}NaN,inf\r\n\r\n# c\r\n1,11\r\n,1\r\n"),
                vec![("cell", 2), ("cell", 2), ("cell", 5), ("cell", 6)],
            ),
            (&format!("{head}1,2\n3,\"4\n5,6\n7,8\n"), vec![("open-quote", 3)]),
            ("travel_mm,speed_mm_s\r1,2\r", vec![("line-end", 1)]),
            (&format!("{head}1,2\n{}\n", "\0".repeat(1 << 20)), vec![("too-large", 3)]),
        ] {
            assert_eq!(faults(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_fault_points_at_its_cell() {
        let source = Source::new("t.csv", "travel_mm, speed_mm_s\n1,2\n10.5 ,  2.5x\n");
        let faults = read_table(&source, &COLUMNS).expect_err("2.5x is no number");
        assert_eq!(&source.text[faults.list()[0].span.clone()], "2.5x");
        assert!(faults.to_string().contains("t.csv:3:9"), "{faults}");
    }

    #[test]
    fn of_a_wrong_file_a_hundred_faults_are_enough() {
        let text = format!("travel_mm,speed_mm_s\n{}", "x,1\n".repeat(10_000));
        assert_eq!(faults(&text).len(), FAULTS);
    }

    proptest::proptest! {
        #[test]
        fn no_text_makes_it_panic_and_no_number_is_changed(
            text in "([a-z0-9,;\t\"#\r\n_ µ.-]|travel_mm|speed_mm_s){0,60}", travel in -10.0..1e3_f64,
        ) {
            let _ = read_table(&Source::new("t", text), &COLUMNS);
            proptest::prop_assert_eq!(rows(&format!("speed_mm_s;travel_mm\n;{travel}\n")), [[Some(travel), None]]);
        }
    }
}
