//! Tables as Apache Parquet: a group of rows is gathered in memory and written at once. A file without its end, of a
//! run that was killed, cannot be read.

use std::{fs::File, path::Path, sync::Arc};

use parquet::{
    basic::{LogicalType, Repetition, Type as PhysicalType},
    data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type},
    errors::ParquetError,
    file::{properties::WriterProperties, writer::SerializedFileWriter},
    schema::types::Type,
};

use super::cells::{ColumnKind, TableWriteError, TableWriter, WrittenCell, WrittenColumn, failed};

/// Rows that are gathered: 5 MB for an arm with seven joints.
const ROWS_A_GROUP: usize = 8192;

/// The cells of one column of a group. Levels say which cells have a value: 1, or 0 for an empty cell.
enum Gathered {
    Counts(Vec<i64>),
    Numbers { values: Vec<f64>, levels: Vec<i16> },
    Names { values: Vec<ByteArray>, levels: Vec<i16> },
}

/// A table as Parquet.
pub struct ParquetTable {
    file: SerializedFileWriter<File>,
    columns: Vec<Gathered>,
    /// The column of the next cell.
    at: usize,
    rows: usize,
}

impl ParquetTable {
    /// A new file; `name` is that of its schema.
    ///
    /// # Errors
    /// It cannot be written, or is there already.
    pub fn create(path: &Path, name: &str, columns: &[WrittenColumn]) -> Result<Self, TableWriteError> {
        let fields: Result<Vec<_>, ParquetError> = columns.iter().map(field).collect();
        let schema = Type::group_type_builder(name).with_fields(fields.map_err(failed)?);
        // Measured numbers seldom repeat: a dictionary of them is work for nothing.
        let properties = WriterProperties::builder().set_dictionary_enabled(false).build();
        let file = File::create_new(path).map_err(failed)?;
        let schema = Arc::new(schema.build().map_err(failed)?);
        Ok(Self {
            file: SerializedFileWriter::new(file, schema, Arc::new(properties)).map_err(failed)?,
            columns: columns.iter().map(|column| Gathered::new(column.kind)).collect(),
            at: 0,
            rows: 0,
        })
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let mut group = self.file.next_row_group()?;
        for gathered in &mut self.columns {
            let Some(mut column) = group.next_column()? else { break };
            match gathered {
                Gathered::Counts(values) => column.typed::<Int64Type>().write_batch(values, None, None)?,
                Gathered::Numbers { values, levels } => {
                    column.typed::<DoubleType>().write_batch(values, Some(levels), None)?
                }
                Gathered::Names { values, levels } => {
                    column.typed::<ByteArrayType>().write_batch(values, Some(levels), None)?
                }
            };
            column.close()?;
            gathered.clear();
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }
}

/// The column of a schema; `OPTIONAL` columns have empty cells.
fn field(column: &WrittenColumn) -> Result<Arc<Type>, ParquetError> {
    let (physical, repetition, logical) = match column.kind {
        ColumnKind::Count => (PhysicalType::INT64, Repetition::REQUIRED, None),
        ColumnKind::Number => (PhysicalType::DOUBLE, Repetition::OPTIONAL, None),
        ColumnKind::Name => (PhysicalType::BYTE_ARRAY, Repetition::OPTIONAL, Some(LogicalType::String)),
    };
    let builder = Type::primitive_type_builder(&column.name, physical);
    builder.with_repetition(repetition).with_logical_type(logical).build().map(Arc::new)
}

impl Gathered {
    fn new(kind: ColumnKind) -> Self {
        let levels = Vec::with_capacity(ROWS_A_GROUP);
        match kind {
            ColumnKind::Count => Self::Counts(Vec::with_capacity(ROWS_A_GROUP)),
            ColumnKind::Number => Self::Numbers { values: Vec::with_capacity(ROWS_A_GROUP), levels },
            ColumnKind::Name => Self::Names { values: Vec::with_capacity(ROWS_A_GROUP), levels },
        }
    }

    fn push(&mut self, cell: WrittenCell<'_>) {
        match (self, cell) {
            (Self::Counts(values), WrittenCell::Count(count)) => {
                values.push(i64::try_from(count).unwrap_or(i64::MAX));
            }
            (Self::Numbers { values, levels }, WrittenCell::Number(number)) => {
                values.push(number);
                levels.push(1);
            }
            (Self::Names { values, levels }, WrittenCell::Name(name)) => {
                values.push(ByteArray::from(name));
                levels.push(1);
            }
            (Self::Numbers { levels, .. } | Self::Names { levels, .. }, WrittenCell::Missing) => {
                levels.push(0);
            }
            (_, cell) => panic!("{cell:?} is none of this column's kind"),
        }
    }

    fn clear(&mut self) {
        match self {
            Self::Counts(values) => values.clear(),
            Self::Numbers { values, levels } => {
                values.clear();
                levels.clear();
            }
            Self::Names { values, levels } => {
                values.clear();
                levels.clear();
            }
        }
    }
}

impl TableWriter for ParquetTable {
    fn cell(&mut self, cell: WrittenCell<'_>) {
        self.columns[self.at].push(cell);
        self.at += 1;
    }

    fn end_row(&mut self) -> Result<(), TableWriteError> {
        self.at = 0;
        self.rows += 1;
        if self.rows < ROWS_A_GROUP { Ok(()) } else { self.write_group().map_err(failed) }
    }

    fn finish(mut self: Box<Self>) -> Result<(), TableWriteError> {
        if self.rows > 0 {
            self.write_group().map_err(failed)?;
        }
        self.file.close().map(|_| ()).map_err(failed)
    }
}
