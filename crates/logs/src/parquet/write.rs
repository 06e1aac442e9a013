//! Small files of Parquet for tests.

use std::{fs::File, path::Path, sync::Arc};

use parquet::{
    basic::Compression,
    data_type::{DoubleType, FloatType, Int64Type},
    file::{
        properties::WriterProperties,
        writer::{SerializedFileWriter, SerializedRowGroupWriter},
    },
    schema::parser::parse_message_type,
};

/// A row of a dataset of LeRobot.
#[derive(Clone)]
pub(super) struct StateRow {
    pub(super) episode: i64,
    pub(super) timestamp_s: f32,
    pub(super) state: Vec<f32>,
}

const DATASET: &str = "message schema {
    optional group observation.state (LIST) { repeated group list { optional float element; } }
    optional binary observation.image;
    optional float timestamp;
    optional int64 episode_index;
}";

fn file(path: &Path, schema: &str, compression: Compression) -> SerializedFileWriter<File> {
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let properties = WriterProperties::builder().set_compression(compression).build();
    SerializedFileWriter::new(File::create(path).unwrap(), schema, Arc::new(properties)).unwrap()
}

/// Writes a file of a dataset, a group of rows for each of these.
pub(super) fn dataset_file(path: &Path, groups: &[Vec<StateRow>]) {
    let mut file = file(path, DATASET, Compression::SNAPPY);
    for rows in groups {
        let mut group = file.next_row_group().unwrap();
        let values: Vec<f32> = rows.iter().flat_map(|row| row.state.clone()).collect();
        let repeated: Vec<i16> =
            rows.iter().flat_map(|row| (0..row.state.len()).map(|at| i16::from(at > 0))).collect();
        // List, entry and value are there.
        let defined = vec![3; values.len()];
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<FloatType>().write_batch(&values, Some(&defined), Some(&repeated)).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        let images = vec![vec![7_u8; 1000].into(); rows.len()];
        let there = vec![1; rows.len()];
        column.typed::<parquet::data_type::ByteArrayType>().write_batch(&images, Some(&there), None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        let times: Vec<f32> = rows.iter().map(|row| row.timestamp_s).collect();
        column.typed::<FloatType>().write_batch(&times, Some(&there), None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        let episodes: Vec<i64> = rows.iter().map(|row| row.episode).collect();
        column.typed::<Int64Type>().write_batch(&episodes, Some(&there), None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
    }
    file.close().unwrap();
}

/// Writes a table of numbers, each column with as many values.
pub(super) fn table_file(path: &Path, columns: &[(&str, Vec<f64>)], compression: Compression) {
    let fields: Vec<String> = columns.iter().map(|(name, _)| format!("required double {name};")).collect();
    let mut file = file(path, &format!("message schema {{ {} }}", fields.join(" ")), compression);
    let mut group = file.next_row_group().unwrap();
    for (_, values) in columns {
        double_column(&mut group, values);
    }
    group.close().unwrap();
    file.close().unwrap();
}

fn double_column(group: &mut SerializedRowGroupWriter<'_, File>, values: &[f64]) {
    let mut column = group.next_column().unwrap().unwrap();
    column.typed::<DoubleType>().write_batch(values, None, None).unwrap();
    column.close().unwrap();
}
