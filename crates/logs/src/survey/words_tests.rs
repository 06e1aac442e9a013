//! A survey in words, of a small table.

use std::io::Write;

use super::*;
use crate::{LogOptions, survey_log};

#[test]
fn a_table_with_a_gap_a_repeated_row_and_a_missing_value() {
    let mut file = tempfile::NamedTempFile::with_suffix(".csv").unwrap();
    let mut rows: Vec<String> =
        (0..40).map(|at| format!("{},0.5,", at * 8 + if at < 20 { 0 } else { 200 })).collect();
    rows.insert(5, rows[4].clone());
    rows[9] += "0.1";
    write!(file, "time_ms,elbow_position,wrist_position\n{}\n", rows.join("\n")).unwrap();
    let survey = survey_log(file.path(), &LogOptions::default(), None).unwrap().survey;
    let words = survey_words(&survey, 5);
    assert!(words.head[0].ends_with(": table, 512 ms, 41 rows"), "{:?}", words.head);
    let read =
        "read as: separator comma, decimal point, columns have names; time in \"time_ms\", in ms by its name";
    assert_eq!(words.head[1], read);
    let name = file.path().file_name().unwrap().to_string_lossy();
    let expected = [
        format!("{name}: 2 joints with positions: elbow, wrist"),
        format!(
            "{name}: 1 gap of 208 ms from 152 ms on; 1 row repeated; 48.8 % of the positions are missing"
        ),
    ];
    assert_eq!(words.about, expected);
    assert!(
        survey_line(&survey).ends_with(&format!("; {name} 2 joints at 125 Hz")),
        "{}",
        survey_line(&survey)
    );
}
