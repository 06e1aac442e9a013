//! The series of a recording as one table.

use congruent_results::comparison::Scalars;

use super::summary::RecordingSummary;

/// Values with less than this time, in seconds, hold at all times: 292 years before the start.
const NO_TIME_S: f64 = -9e9;

/// All scalar series as CSV: the time, then a column for each series, named by its path.
///
/// There is a row for each instant at which any series has a value. A series without a value at that instant has an
/// empty cell: nothing is interpolated or repeated. Values without a time are in a row whose time is empty. Of several
/// values of a series at one instant the last one counts.
///
/// # Panics
/// Never: memory takes every row.
pub fn scalars_csv(summary: &RecordingSummary, scalars: &Scalars) -> Vec<u8> {
    let mut times: Vec<f64> = scalars.values().flatten().map(|&(time_s, _)| time_s).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut table = csv::Writer::from_writer(Vec::new());
    let (name, scale) = time_column(summary);
    let header = std::iter::once(name.as_str()).chain(scalars.keys().map(String::as_str));
    let in_memory = "memory takes every row";
    table.write_record(header).expect(in_memory);
    let mut series: Vec<&[(f64, f64)]> = scalars.values().map(Vec::as_slice).collect();
    for time_s in times {
        let shown = if time_s < NO_TIME_S { String::new() } else { format!("{:?}", time_s * scale) };
        // Times ascend and each series is sorted: every value is passed once, however many series there are.
        let cells = series.iter_mut().map(|rest| {
            let now = rest.partition_point(|&(at_s, _)| at_s <= time_s);
            let (here, later) = rest.split_at(now);
            *rest = later;
            here.last().map_or_else(String::new, |(_, value)| format!("{value:?}"))
        });
        table.write_record(std::iter::once(shown).chain(cells)).expect(in_memory);
    }
    table.into_inner().expect(in_memory)
}

/// Name of the first column, and what its seconds are multiplied by: a recording of another program may count its rows
/// instead, as if each took a nanosecond.
fn time_column(summary: &RecordingSummary) -> (String, f64) {
    match summary.timelines.first() {
        Some(counted) if summary.timelines.iter().all(|timeline| timeline.kind == "sequence") => {
            (counted.name.clone(), 1e9)
        }
        _ => ("time_s".to_owned(), 1.0),
    }
}
