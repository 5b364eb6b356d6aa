//! Batches as Parquet: one file stands alone, with its schema, units and meanings; nulls where nothing is known.
//!
//! The bytes depend on the rows alone, not on the batches in which they came: row groups have a fixed number of rows.

use std::io;
use std::io::Write;
use std::ops::Range;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::reader::ColumnReader;
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type, TypePtr};
use serde_json::json;

use crate::forecast::study::batch::{Batch, Values};
use crate::forecast::study::columns::{Column, Kind};

/// Rows of a row group: some tens of megabytes in memory.
const GROUP: usize = 65_536;

/// Under which name a file says which study it is of.
const STUDY: &str = "stargrip-cam.study";
/// Under which name a file says what its columns mean.
const COLUMNS: &str = "stargrip-cam.columns";

/// Writes batches of one study.
pub struct Writer<W: Write + Send> {
    file: SerializedFileWriter<W>,
    waiting: Vec<Values>,
}

impl<W: Write + Send> Writer<W> {
    /// Begins a file of `columns` for the study `fingerprint`.
    ///
    /// # Errors
    /// If `out` cannot be written to.
    pub fn new(out: W, columns: &[Column], fingerprint: &str) -> io::Result<Self> {
        let fields = columns.iter().map(field).collect::<Result<Vec<_>, _>>().map_err(told)?;
        let schema = Type::group_type_builder("study").with_fields(fields).build().map_err(told)?;
        let about: Vec<_> = columns
            .iter()
            .map(|column| json!({ "name": column.name, "unit": column.unit, "about": column.about }))
            .collect();
        let notes = vec![
            KeyValue::new(STUDY.to_owned(), fingerprint.to_owned()),
            KeyValue::new(COLUMNS.to_owned(), json!(about).to_string()),
        ];
        Self::with(out, Arc::new(schema), notes)
    }

    /// Begins a file with the schema and the notes of another.
    ///
    /// # Errors
    /// If `out` cannot be written to.
    pub fn like<R: ChunkReader + 'static>(out: W, other: &Reader<R>) -> io::Result<Self> {
        let metadata = other.file.metadata().file_metadata();
        let notes = metadata.key_value_metadata().cloned().unwrap_or_default();
        Self::with(out, metadata.schema_descr().root_schema_ptr(), notes)
    }

    fn with(out: W, schema: TypePtr, notes: Vec<KeyValue>) -> io::Result<Self> {
        let mut properties = WriterProperties::builder()
            .set_created_by(concat!("stargrip-cam ", env!("CARGO_PKG_VERSION")).to_owned())
            .set_compression(Compression::SNAPPY)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_max_row_group_row_count(Some(GROUP))
            .set_key_value_metadata(Some(notes));
        // Answers are seldom equal: a dictionary of them only costs time. What varies has one.
        for field in schema.get_fields() {
            let is_axis = field.name().contains('.') || field.get_physical_type() == Physical::BYTE_ARRAY;
            let path = ColumnPath::new(vec![field.name().to_owned()]);
            properties = properties.set_column_dictionary_enabled(path, is_axis);
        }
        let waiting = schema.get_fields().iter().map(|field| empty(field.get_physical_type())).collect();
        let file = SerializedFileWriter::new(out, schema, Arc::new(properties.build())).map_err(told)?;
        Ok(Self { file, waiting })
    }

    /// Adds rows.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn write(&mut self, batch: Batch) -> io::Result<()> {
        for (waiting, more) in self.waiting.iter_mut().zip(batch.columns) {
            waiting.append(more);
        }
        while self.waiting.first().is_some_and(|column| column.len() >= GROUP) {
            self.group(GROUP)?;
        }
        Ok(())
    }

    /// Writes what is left, and the end of the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        let left = self.waiting.first().map_or(0, Values::len);
        if left > 0 {
            self.group(left)?;
        }
        self.file.into_inner().map_err(told)
    }

    /// Writes the first `len` of the rows that wait.
    fn group(&mut self, len: usize) -> io::Result<()> {
        let mut group = self.file.next_row_group().map_err(told)?;
        for waiting in &mut self.waiting {
            let values = waiting.take(len);
            let Some(mut column) = group.next_column().map_err(told)? else { break };
            put(column.untyped(), &values).map_err(told)?;
            column.close().map_err(told)?;
        }
        let _ = group.close().map_err(told)?;
        Ok(())
    }
}

fn field(column: &Column) -> Result<TypePtr, ParquetError> {
    let (physical, repetition) = match column.kind {
        Kind::Real => (Physical::DOUBLE, Repetition::OPTIONAL),
        Kind::Whole => (Physical::INT64, Repetition::REQUIRED),
        Kind::Text => (Physical::BYTE_ARRAY, Repetition::OPTIONAL),
    };
    let logical = (column.kind == Kind::Text).then_some(LogicalType::String);
    let builder = Type::primitive_type_builder(&column.name, physical);
    Ok(Arc::new(builder.with_repetition(repetition).with_logical_type(logical).build()?))
}

fn empty(physical: Physical) -> Values {
    match physical {
        Physical::INT64 => Values::Whole(Vec::new()),
        Physical::BYTE_ARRAY => Values::Text(Vec::new()),
        _ => Values::Real(Vec::new()),
    }
}

fn put(column: &mut ColumnWriter<'_>, values: &Values) -> Result<(), ParquetError> {
    let _ = match (column, values) {
        (ColumnWriter::DoubleColumnWriter(column), Values::Real(values)) => {
            let levels: Vec<i16> = values.iter().map(|value| i16::from(!value.is_nan())).collect();
            let known: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
            column.write_batch(&known, Some(&levels), None)?
        }
        (ColumnWriter::Int64ColumnWriter(column), Values::Whole(values)) => {
            column.write_batch(values, None, None)?
        }
        (ColumnWriter::ByteArrayColumnWriter(column), Values::Text(values)) => {
            let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
            let known: Vec<ByteArray> =
                values.iter().flatten().map(|word| ByteArray::from(&**word)).collect();
            column.write_batch(&known, Some(&levels), None)?
        }
        _ => return Err(ParquetError::General("a column of another kind".to_owned())),
    };
    Ok(())
}

/// Reads what a [`Writer`] wrote.
pub struct Reader<R: ChunkReader + 'static> {
    file: SerializedFileReader<R>,
}

impl<R: ChunkReader + 'static> Reader<R> {
    /// Opens a file.
    ///
    /// # Errors
    /// If it is no Parquet.
    pub fn new(file: R) -> io::Result<Self> {
        Ok(Self { file: SerializedFileReader::new(file).map_err(told)? })
    }

    /// Which study it is of, if it says so.
    pub fn fingerprint(&self) -> Option<String> {
        let notes = self.file.metadata().file_metadata().key_value_metadata()?;
        notes.iter().find(|note| note.key == STUDY)?.value.clone()
    }

    /// The names of its columns.
    pub fn names(&self) -> Vec<String> {
        let schema = self.file.metadata().file_metadata().schema_descr();
        schema.columns().iter().map(|column| column.name().to_owned()).collect()
    }

    /// Its batches, in order.
    pub fn batches(&self) -> impl Iterator<Item = io::Result<Batch>> {
        let mut from = 0;
        (0..self.file.num_row_groups()).map(move |number| {
            let group = self.file.get_row_group(number).map_err(told)?;
            let count = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            let rows = from..from + count;
            from = rows.end;
            let columns = (0..group.num_columns()).map(|k| {
                let column = group.get_column_reader(k)?;
                got(column, &rows)
            });
            Ok(Batch { columns: columns.collect::<Result<_, _>>().map_err(told)?, rows })
        })
    }
}

fn got(column: ColumnReader, rows: &Range<usize>) -> Result<Values, ParquetError> {
    let count = rows.len();
    let mut levels = Vec::with_capacity(count);
    Ok(match column {
        ColumnReader::DoubleColumnReader(mut column) => {
            let mut known = Vec::with_capacity(count);
            let _ = column.read_records(count, Some(&mut levels), None, &mut known)?;
            let mut known = known.into_iter();
            let value = |level: i16| if level == 0 { f64::NAN } else { known.next().unwrap_or(f64::NAN) };
            Values::Real(levels.into_iter().map(value).collect())
        }
        ColumnReader::Int64ColumnReader(mut column) => {
            let mut values = Vec::with_capacity(count);
            let _ = column.read_records(count, None, None, &mut values)?;
            Values::Whole(values)
        }
        ColumnReader::ByteArrayColumnReader(mut column) => {
            let mut known = Vec::with_capacity(count);
            let _ = column.read_records(count, Some(&mut levels), None, &mut known)?;
            let mut known = known.into_iter();
            let mut words = Vec::with_capacity(count);
            for level in levels {
                let word = if level == 0 { None } else { known.next() };
                words.push(
                    word.map(|word: ByteArray| Ok::<_, ParquetError>(word.as_utf8()?.into())).transpose()?,
                );
            }
            Values::Text(words)
        }
        _ => return Err(ParquetError::General("a column of a kind that studies do not have".to_owned())),
    })
}

/// What is wrong, as the operating system says it where it is its own.
fn told(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forecast::study::{Study, csv};
    use crate::spec::study::Lane;
    use crate::spec::{Source, starter};
    use std::sync::atomic::AtomicBool;

    /// Bytes of a file, rows in batches of `size`.
    fn bytes(study: &Study, size: usize) -> Vec<u8> {
        let mut writer = Writer::new(Vec::new(), study.columns(), "abc").expect("begun");
        for from in (0..study.rows()).step_by(size) {
            let batch =
                study.batch(from..from + size, &Arc::new(AtomicBool::new(false))).expect("not stopped");
            writer.write(batch).expect("written");
        }
        writer.finish().expect("finished")
    }

    fn on_disk(bytes: &[u8]) -> impl ChunkReader + 'static {
        let mut file = tempfile::tempfile().expect("a file");
        file.write_all(bytes).expect("written");
        file
    }

    #[test]
    fn what_is_written_is_read_back_and_does_not_depend_on_batches() {
        let text = starter("x").expect("a name") + "\n[load]\npressure = \"37 kPa\"\n";
        let lanes = ["star.points=3,5,9", "mask.mirror=true,false", "star.tip_angle=20 deg..60 deg/11000"];
        let lanes = lanes.map(|text| Lane::parse(text).expect("valid")).to_vec();
        let study = Study::vary(&Source::new("x", text), lanes).expect("valid").expect("small");
        let once = bytes(&study, 100_000);
        assert!(once == bytes(&study, 4096), "the same rows are the same bytes");
        let reader = Reader::new(on_disk(&once)).expect("Parquet");
        assert_eq!(reader.fingerprint().as_deref(), Some("abc"));
        assert!(reader.names().iter().eq(study.columns().iter().map(|column| &column.name)));
        let mut back = Writer::like(Vec::new(), &reader).expect("begun");
        let mut text = Vec::new();
        for batch in reader.batches() {
            let batch = batch.expect("a row group");
            text.extend(csv::lines(&batch));
            back.write(batch).expect("written");
        }
        let whole = study.batch(0..study.rows(), &Arc::new(AtomicBool::new(false))).expect("not stopped");
        assert!(text == csv::lines(&whole));
        assert!(back.finish().expect("finished") == once);
    }
}
