//! Which columns of a Parquet have numbers, and its values as text.

use std::{fs::File, sync::Arc};

use parquet::{
    basic::{Compression, LogicalType, Type as PhysicalType},
    file::{
        metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData},
        reader::SerializedFileReader,
    },
    record::{Field, Row, RowAccessor, reader::RowIter},
    schema::types::{Type, TypePtr},
};

/// The state of the robot in a dataset of LeRobot, a list of numbers.
pub(super) const STATE: &str = "observation.state";
/// Its time in s, from the beginning of each episode on.
pub(super) const TIMESTAMP: &str = "timestamp";

/// The columns that are read.
#[derive(Clone)]
pub(super) struct NumberColumns {
    pub(super) names: Vec<String>,
    /// Whether they are those of a dataset of LeRobot.
    pub(super) are_of_lerobot: bool,
    /// The others, with their types: nothing is read of them.
    pub(super) others: Vec<String>,
    schema: Type,
}

impl NumberColumns {
    /// The columns of a file with numbers; of a dataset of LeRobot time and state alone.
    pub(super) fn new(metadata: &ParquetMetaData) -> Result<Self, String> {
        let schema = metadata.file_metadata().schema();
        let has = |name: &str, is_list: bool| {
            let named = |field: &&TypePtr| field.name() == name && field.is_group() == is_list;
            schema.get_fields().iter().any(|field| named(&field))
        };
        let are_of_lerobot = has(STATE, true) && has(TIMESTAMP, false);
        let is_read = |field: &&TypePtr| {
            if are_of_lerobot { [STATE, TIMESTAMP].contains(&field.name()) } else { is_number(field) }
        };
        let fields: Vec<TypePtr> = schema.get_fields().iter().filter(is_read).map(Arc::clone).collect();
        let is_other = |field: &&TypePtr| !is_read(field);
        let others = schema.get_fields().iter().filter(is_other).map(with_type).collect();
        let names = fields.iter().map(|field| field.name().to_owned()).collect();
        let builder = Type::group_type_builder(schema.name()).with_fields(fields);
        Ok(Self {
            names,
            are_of_lerobot,
            others,
            schema: builder.build().map_err(|fault| fault.to_string())?,
        })
    }

    /// The rows of a file, as far as these columns go.
    pub(super) fn rows(&self, file: SerializedFileReader<File>) -> Result<RowIter<'static>, String> {
        let rows = RowIter::from_file_into(Box::new(file));
        rows.project(Some(self.schema.clone())).map_err(|fault| fault.to_string())
    }

    /// The compression of one of these columns that is not read.
    pub(super) fn unread_compression(&self, metadata: &ParquetMetaData) -> Option<Compression> {
        let columns = metadata.row_groups().iter().flat_map(RowGroupMetaData::columns);
        let is_here = |path: &[String]| path.first().is_some_and(|name| self.names.contains(name));
        let mut compressions = columns
            .filter(|column| is_here(column.column_path().parts()))
            .map(ColumnChunkMetaData::compression);
        compressions.find(|found| ![Compression::UNCOMPRESSED, Compression::SNAPPY].contains(found))
    }
}

fn is_number(field: &TypePtr) -> bool {
    let numbers = [PhysicalType::INT32, PhysicalType::INT64, PhysicalType::FLOAT, PhysicalType::DOUBLE];
    field.is_primitive() && numbers.contains(&field.get_physical_type())
}

/// The name of a column with its type, as `robot_type (text)`; a number needs no word.
fn with_type(field: &TypePtr) -> String {
    let name = field.name();
    if is_number(field) {
        return name.to_owned();
    }
    let is_list = field.is_group() && field.get_basic_info().logical_type_ref() == Some(&LogicalType::List);
    let what = match (field.is_group(), is_list) {
        (true, true) => "list",
        (true, false) => "struct",
        (false, _) => match field.get_physical_type() {
            PhysicalType::BOOLEAN => "yes or no",
            PhysicalType::INT96 => "time in INT96",
            _ => "text or bytes",
        },
    };
    format!("{name} ({what})")
}

/// The cells of a row: a list has one for each of its values.
pub(super) fn cells(row: &Row) -> Vec<String> {
    let mut cells = Vec::new();
    for (_, field) in row.get_column_iter() {
        match field {
            Field::ListInternal(list) => cells.extend(list.elements().iter().map(cell)),
            other => cells.push(cell(other)),
        }
    }
    cells
}

/// The number of values of the list of a row; `None` without a list.
pub(super) fn list_length(row: &Row) -> Option<usize> {
    (0..row.len()).find_map(|at| row.get_list(at).ok()).map(parquet::record::List::len)
}

/// A number as the shortest text that gives it again; times since 1970 in s.
fn cell(field: &Field) -> String {
    match field {
        Field::Float(number) => number.to_string(),
        Field::Double(number) => number.to_string(),
        Field::Int(number) => number.to_string(),
        Field::Long(number) => number.to_string(),
        Field::TimestampMillis(ms) => decimal(*ms, 3),
        Field::TimestampMicros(us) => decimal(*us, 6),
        _ => String::new(),
    }
}

/// A number of parts with this many decimal places, as a decimal number.
fn decimal(parts: i64, places: usize) -> String {
    let digits = format!("{:0width$}", parts.unsigned_abs(), width = places + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places);
    format!("{}{whole}.{fraction}", if parts < 0 { "-" } else { "" })
}
