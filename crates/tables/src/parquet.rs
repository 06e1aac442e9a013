//! Rows of Apache Parquet. A file without its end, of a run that was killed, cannot be read.

use congruent_input::catch_panic;
use parquet::{
    file::reader::{ChunkReader, FileReader, SerializedFileReader},
    record::{Field, reader::RowIter},
};

use crate::row_reader::{RowReader, Value};

pub(crate) struct ParquetRows {
    rows: RowIter<'static>,
    columns: Vec<String>,
}

impl ParquetRows {
    /// The rows of a file, or of its bytes.
    pub(crate) fn new(from: impl ChunkReader + 'static) -> Result<Self, String> {
        catch_panic(|| {
            let reader = SerializedFileReader::new(from).map_err(|error| error.to_string())?;
            let schema = reader.metadata().file_metadata().schema();
            let columns = schema.get_fields().iter().map(|field| field.name().to_owned()).collect();
            Ok(Self { rows: RowIter::from_file_into(Box::new(reader)), columns })
        })
    }
}

impl RowReader for ParquetRows {
    fn columns(&self) -> &[String] {
        &self.columns
    }

    fn next_row(&mut self, row: &mut Vec<Value>) -> Result<bool, String> {
        let next = catch_panic(|| self.rows.next().transpose().map_err(|error| error.to_string()))?;
        let Some(next) = next else { return Ok(false) };
        row.clear();
        row.extend(next.get_column_iter().map(|(_, field)| value(field)));
        Ok(true)
    }
}

#[expect(clippy::cast_precision_loss, reason = "steps are far below 2^52")]
fn value(field: &Field) -> Value {
    match field {
        Field::Null => Value::Missing,
        Field::Double(number) => Value::Number(*number),
        Field::Float(number) => Value::Number(f64::from(*number)),
        Field::Long(count) => Value::Number(*count as f64),
        Field::Int(count) => Value::Number(f64::from(*count)),
        Field::Str(name) => Value::Name(name.clone()),
        other => Value::Name(other.to_string()),
    }
}
