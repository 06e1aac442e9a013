//! Tables as they are met, read to their end.

use std::io::Write;

use super::*;
use crate::csv;

fn open(text: &[u8], options: &LogOptions) -> Result<(TableReader, tempfile::NamedTempFile), Diagnostic> {
    let mut file = tempfile::NamedTempFile::with_suffix(".csv").unwrap();
    file.write_all(text).unwrap();
    let table = csv::open(file.path())?;
    TableReader::new(file.path(), table, options).map(|reader| (reader, file))
}

#[track_caller]
fn events(text: &[u8], options: &LogOptions) -> Vec<LogEvent> {
    let (mut reader, _file) = open(text, options).unwrap();
    std::iter::from_fn(|| reader.next_event().unwrap()).collect()
}

fn joints(events: &[LogEvent]) -> Vec<&LoggedJoints> {
    events
        .iter()
        .filter_map(|event| if let LogEvent::Joints(joints) = event { Some(joints) } else { None })
        .collect()
}

fn at_rate(rate_hz: f64) -> LogOptions {
    LogOptions { rate_hz: Some(rate_hz), ..LogOptions::default() }
}

#[test]
fn rows_with_decimal_commas_in_milliseconds() {
    let text = b"Zeit time_ms;elbow_position;elbow_velocity\n0;0,5;1\n8;-0,25;\n";
    let found = events(text, &LogOptions::default());
    let found = joints(&found);
    assert_eq!(found.iter().map(|row| row.time.log_s).collect::<Vec<_>>(), [0.0, 0.008]);
    assert_eq!(found.iter().map(|row| row.position[0]).collect::<Vec<_>>(), [0.5, -0.25]);
    assert!(found[1].velocity[0].is_nan() && found[1].effort.is_empty());
    assert_eq!(&found[0].names[..], ["elbow"]);
}

#[test]
fn values_in_the_units_that_names_state_are_converted() {
    let text =
        b"Zeit_ms,elbow_pos_deg,slide_pos_mm,elbow_vel_deg_s,wrist_pos\n0,180,250,90,1\n8,-90,-1,0,2\n";
    let found = events(text, &LogOptions::default());
    let found = joints(&found);
    let row = |at: usize| found[at].position.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    let bits = |values: [f64; 3]| values.map(f64::to_bits);
    assert_eq!(row(0), bits([180_f64.to_radians(), 0.25, 1.0]));
    assert_eq!(row(1), bits([(-90_f64).to_radians(), -0.001, 2.0]));
    assert_eq!(found[0].velocity[0].to_bits(), 90_f64.to_radians().to_bits());
}

#[test]
fn rows_and_cells_that_are_not_used_are_counted() {
    let text = b"t,elbow_position,wrist_position\n0,1,2\n0.1,1\nx,1,2\n0.2,1,broken\n";
    let found = events(text, &LogOptions::default());
    assert_eq!(joints(&found).len(), 2);
    let faults: Vec<String> = found
        .iter()
        .filter_map(
            |event| if let LogEvent::Gap(gap) = event { Some(gap.cause.message.clone()) } else { None },
        )
        .collect();
    let ends = ["the first is in line 3", "the first is in line 4", "the first is in line 5"];
    assert!(
        faults.len() == 3 && faults.iter().zip(ends).all(|(fault, end)| fault.ends_with(end)),
        "{faults:?}"
    );
}

#[test]
fn without_times_the_rate_is_needed() {
    let text = b"0.5 1\n0.5 2\n0.4 0\n";
    let refused = open(text, &LogOptions::default()).err().unwrap();
    assert_eq!(refused.code, codes::log::TIME);
    let found = events(text, &at_rate(125.0));
    assert_eq!(joints(&found)[2].time.log_ns, 16_000_000);
    let coarse = b"t,q1\n1,0\n1,0\n1,0\n2,0\n";
    assert_eq!(open(coarse, &LogOptions::default()).err().unwrap().code, codes::log::TIME);
    assert_eq!(joints(&events(coarse, &at_rate(1.0)))[0].names.len(), 1);
}

#[test]
fn rows_that_are_not_used_take_their_time() {
    let found = events(b"q1,q2\n0,0\n1\n2,0\n", &at_rate(1.0));
    assert_eq!(joints(&found).iter().map(|row| row.time.log_s).collect::<Vec<_>>(), [0.0, 2.0]);
}

#[test]
fn an_empty_row_before_the_names_is_none() {
    let found = events(b",,\nt,q1,q2\n0,1,2\n0.1,1,2\n", &LogOptions::default());
    assert_eq!((joints(&found).len(), found.len()), (2, 2));
}

#[test]
fn a_header_of_another_width_is_refused_with_both() {
    let refused = open(b"t,q1,q2\n0,1,2,3\n1,2,3,4\n", &LogOptions::default()).err().unwrap();
    assert!(refused.message.ends_with("has 3 names in its header and 4 cells in its rows"), "{refused}");
    let found = events(b"Arm,left\nt,q1,q2\n0,1,2,\n0.1,1,2,\n", &LogOptions::default());
    assert_eq!(joints(&found).len(), 2);
}

#[test]
fn the_pose_of_a_ur() {
    let names = |prefix: &str| (0..6).map(|at| format!("{prefix}{at}")).collect::<Vec<_>>().join(" ");
    let head = format!("timestamp {} {}\n", names("actual_q_"), names("actual_TCP_pose_"));
    let row = |time: f64| format!("{time} 0 0 0 0 0 0 0.1 0.2 0.3 0 0 {}\n", std::f64::consts::PI);
    let text = [head, row(0.0), row(0.002)].concat();
    let found = events(text.as_bytes(), &LogOptions::default());
    let LogEvent::Pose(pose) = &found[1] else { panic!("{:?}", found[1]) };
    assert_eq!((pose.child_in_frame_m, pose.frame.as_str()), ([0.1, 0.2, 0.3], "base"));
    let [w, x, y, z] = pose.frame_from_child_wxyz;
    assert!(w.abs() < 1e-15 && x == 0.0 && y == 0.0 && (z - 1.0).abs() < 1e-15);
}

#[test]
fn a_quote_that_is_not_closed_costs_a_cell_or_the_table_but_no_memory() {
    let rows: Vec<String> = (0..20_000).map(|at| format!("{},1,2", f64::from(at) / 100.0)).collect();
    let head = "t,elbow_position,wrist_position";
    let late = format!("{head}\n{}\n300,\"1,2\n301,1,2\n", rows.join("\n"));
    assert_eq!(joints(&events(late.as_bytes(), &LogOptions::default())).len(), 20_002);
    // Quotes in the beginning have their meaning.
    let rows = rows.join("\n").repeat(6);
    let early = format!("t,\"elbow_position\",wrist_position\n0,1,2\n1,1,2\n2,\"1,2\n{rows}\n");
    let (mut reader, _file) = open(early.as_bytes(), &LogOptions::default()).unwrap();
    let refused = loop {
        if let Err(refused) = reader.next_event() {
            break refused;
        }
    };
    assert!(refused.message.contains("a row is longer"), "{refused}");
}

#[test]
fn what_is_no_table_is_refused() {
    let code = |text: &[u8]| open(text, &LogOptions::default()).err().unwrap().code;
    assert_eq!(code(b""), congruent_input::codes::file::EMPTY);
    assert_eq!(code(b"\xff\xfea\0"), codes::log::TABLE_ENCODING);
    assert_eq!(code(b"only text\nand more\n"), codes::log::TABLE_ENCODING);
    assert_eq!(code(b"t,temperature\n0,20\n1,20\n"), codes::log::COLUMNS);
}
