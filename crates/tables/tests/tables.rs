//! Tables of every form: marks, line ends, quotes, comments, and what is wrong in them.
#![expect(clippy::unwrap_used, reason = "helpers of tests panic")]

use std::fs;

use congruent_input::{Diagnostic, FileAccess};
use congruent_tables::{Cell, WrittenTable, codes::table::PARQUET, read_table};

/// The table of a file with these bytes.
fn cells(name: &str, bytes: &[u8]) -> Result<Vec<Vec<(String, String)>>, Diagnostic> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    let source = read_table(&FileAccess::default(), &path, 1000)?;
    let table = WrittenTable::read(&source.text, PARQUET).unwrap();
    let rows = std::iter::once(Ok(table.header.row)).chain(table.rows);
    rows.map(|row| {
        let row = row.map_err(|fault| fault.in_file(&source))?;
        let cell = |cell: Cell| (cell.text, source.text[cell.span].to_owned());
        Ok(row.cells.into_iter().map(cell).collect())
    })
    .collect()
}

#[track_caller]
fn check(bytes: &[u8], expected: &[&[(&str, &str)]]) {
    let found = cells("table.csv", bytes).unwrap();
    let found: Vec<Vec<(&str, &str)>> = found
        .iter()
        .map(|row| row.iter().map(|(text, place)| (text.as_str(), place.as_str())).collect())
        .collect();
    assert_eq!(found, expected);
}

#[test]
fn cells_come_with_their_places_whatever_wrote_the_file() {
    // A spreadsheet writes a mark, CRLF and quotes.
    check(
        b"\xEF\xBB\xBFtime_s,\"a, b_deg\",c\r\n0, 1 ,\"2\"\r\n",
        &[
            &[("time_s", "time_s"), ("a, b_deg", "\"a, b_deg\""), ("c", "c")],
            &[("0", "0"), ("1", "1"), ("2", "\"2\"")],
        ],
    );
    // Doubled quotes, a line break in quotes, letters of several bytes, an empty cell, no line break at the end.
    check(
        "\"\"\"x\"\"\",ü\n\"a\nb\",\n1,\"ö\"".as_bytes(),
        &[
            &[("x", "\"\"\"x\"\"\""), ("ü", "ü")],
            &[("a\nb", "\"a\nb\""), ("", "")],
            &[("1", "1"), ("ö", "\"ö\"")],
        ],
    );
    // Comments and empty lines.
    check(b"# \"head\n\na,b\n  \n # note\n#\n1,2\n", &[&[("a", "a"), ("b", "b")], &[("1", "1"), ("2", "2")]]);
}

#[test]
fn faults_name_line_column_and_value() {
    let text = "# from a log\r\n\r\na,b\r\n1,\"2\"\r\n3, nan\r\n,1\r\n";
    let WrittenTable { header, rows } = WrittenTable::read(text, PARQUET).unwrap();
    let rows: Vec<_> = rows.map(Result::unwrap).collect();
    let number = |row: usize, at| header.needed_number(PARQUET, &rows[row], at);
    assert_eq!(number(0, 1), Ok(2.0));
    let fault = number(1, 1).unwrap_err();
    assert_eq!(fault.message, "line 5, column \"b\": \"nan\" is not a finite number");
    assert_eq!(&text[fault.span.unwrap()], "nan");
    assert_eq!(number(2, 0).unwrap_err().message, "line 6, column \"a\": the cell is empty");
    let fault = cells("table.csv", b"a,b\n1,2,3\n").unwrap_err();
    assert_eq!(fault.message, "line 2: 3 cells, the header has 2");
    assert_eq!(fault.line_column(), Some((2, 1)));
    assert!(WrittenTable::read("# nothing\n\n", PARQUET).is_none());
}

#[test]
fn what_is_only_named_parquet_is_refused() {
    assert_eq!(cells("table.parquet", b"a,b\n1,2\n").unwrap_err().code.name, "table::parquet");
}
