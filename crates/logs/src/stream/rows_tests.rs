//! Rows of joints on several topics, and of messages that lack some.

use super::*;

fn topic(name: &str, maximum_gap_s: f64, joints: &[(&str, usize)]) -> SelectedJoints {
    let joint = |(name, joint): &(&str, usize)| SelectedJoint {
        name: (*name).to_owned(),
        joint: *joint,
        si_per_unit: 1.0,
    };
    SelectedJoints {
        topic: name.to_owned(),
        is_setpoint: false,
        maximum_gap_s,
        effort_is_torque: true,
        joints: joints.iter().map(joint).collect(),
    }
}

fn rows(joints: Vec<SelectedJoints>) -> RowMaker {
    RowMaker::new(&StreamSelection {
        clock: crate::survey::ClockKind::Log,
        origin_s: 0.0,
        joints_of_row: 3,
        joints,
        poses: Vec::new(),
        between_s: [f64::NEG_INFINITY, f64::INFINITY],
        is_live: false,
    })
}

fn message(names: &[&str], position: &[f64]) -> LoggedJoints {
    LoggedJoints {
        topic: 0,
        time: crate::event::EventTime::new(0, None, 0),
        names: names.iter().map(|&name| name.to_owned()).collect(),
        position: position.to_vec(),
        velocity: Vec::new(),
        effort: Vec::new(),
    }
}

/// Times and positions of all rows.
fn all(rows: &mut RowMaker) -> Vec<(f64, Vec<f64>)> {
    rows.flush();
    let next = |rows: &mut RowMaker| rows.advance().then(|| (rows.row().time_s, rows.row().q.clone()));
    std::iter::from_fn(|| next(rows)).collect()
}

#[test]
fn joints_in_two_messages_of_one_time_make_one_row() {
    let mut rows = rows(vec![topic("a", 0.05, &[("one", 0), ("two", 1)])]);
    for step in 0..5_u32 {
        let time_s = f64::from(step) * 0.01;
        rows.take(0, time_s, message(&["one"], &[time_s]));
        rows.take(0, time_s, message(&["two"], &[2.0 * time_s]));
        // Published again.
        rows.take(0, time_s, message(&["two"], &[9.0]));
    }
    let found = all(&mut rows);
    assert_eq!(found.len(), 5, "{found:?}");
    assert!(
        found.iter().all(|(time_s, q)| (q[0] - time_s).abs() + (q[1] - 2.0 * time_s).abs() < 1e-12),
        "{found:?}"
    );
}

#[test]
fn a_joint_that_messages_lack_is_interpolated_and_unknown_in_a_gap() {
    let mut rows = rows(vec![topic("a", 0.05, &[("one", 0), ("two", 1)])]);
    for step in 0..20_u32 {
        let time_s = f64::from(step) * 0.01;
        // The second joint is missing in every other message, is NaN once, and is not there between 0.1 and 0.18 s.
        let two = if step == 4 { f64::NAN } else { 2.0 * time_s };
        let is_there = step % 2 == 0 && !(10..18).contains(&step);
        let with_two = message(&["two", "one"], &[two, time_s]);
        rows.take(0, time_s, if is_there { with_two } else { message(&["one"], &[time_s]) });
    }
    let all = all(&mut rows);
    for (time_s, q) in &all {
        assert!((q[0] - time_s).abs() < 1e-12 && (q[1] - 2.0 * time_s).abs() < 1e-12, "{time_s}: {q:?}");
        assert!(q[2].is_nan(), "no topic has the third joint");
    }
    // Of 20 instants nine lie in the gap from 0.08 to 0.18 s, and behind the last message with the joint is one more.
    assert_eq!((all.len(), rows.counts().incomplete), (10, 10));
}

#[test]
fn joints_on_two_topics_have_the_times_of_the_first() {
    let fast = topic("fast", 0.02, &[("one", 0), ("two", 1)]);
    let mut rows = rows(vec![fast, topic("slow", 0.2, &[("three", 2)])]);
    for step in 0..100_u32 {
        let time_s = f64::from(step) * 0.004;
        rows.take(0, time_s, message(&["one", "two"], &[time_s, -time_s]));
        if step % 10 == 0 {
            rows.take(1, time_s, message(&["three"], &[3.0 * time_s]));
        }
    }
    let all = all(&mut rows);
    // The last message of the slow topic is at 0.36 s.
    assert_eq!(all.len(), 91);
    assert!(all.iter().all(|(time_s, q)| (q[2] - 3.0 * time_s).abs() < 1e-12), "{all:?}");
}

#[test]
fn rows_do_not_wait_for_a_topic_that_is_silent() {
    let mut rows = rows(vec![topic("a", 0.05, &[("one", 0)]), topic("b", 0.05, &[("two", 1)])]);
    rows.take(1, 0.0, message(&["two"], &[1.0]));
    let mut given = 0;
    for step in 0..1000_u32 {
        rows.take(0, f64::from(step) * 0.01, message(&["one"], &[0.0]));
        while rows.advance() {
            given += 1;
        }
    }
    // Only the first instant has both; those that can be decided are left out while the log is read.
    assert_eq!(given, 1);
    assert!(rows.counts().incomplete > 700, "{:?}", rows.counts());
}

#[test]
fn messages_that_cannot_be_used_are_counted_beside_the_rows() {
    let mut rows = rows(vec![topic("a", 0.05, &[("one", 0)])]);
    let mut take = |time_s: f64, message| rows.take(0, time_s, message);
    take(0.0, message(&["one"], &[0.0]));
    take(0.01, message(&[], &[]));
    take(0.02, message(&["one", "two"], &[0.0]));
    // Of a gripper on the same topic: the arm is known between the messages beside it.
    take(0.03, message(&["gripper"], &[0.0]));
    take(0.04, message(&["one"], &[0.4]));
    // The clock does not advance to the end.
    (0..100).for_each(|_| take(0.04, message(&["one"], &[0.5])));
    rows.lose(3);
    rows.flush();
    let next = |rows: &mut RowMaker| rows.advance().then(|| (rows.row().time_s, rows.row().unusable));
    let found: Vec<(f64, u64)> = std::iter::from_fn(|| next(&mut rows)).collect();
    let unusable: u64 = found.iter().map(|(_, unusable)| unusable).sum();
    let times: Vec<f64> = found.into_iter().map(|(time_s, _)| time_s).collect();
    assert_eq!((times, unusable, rows.left_out()), (vec![0.0, 0.03, 0.04], 1 + 1 + 100 + 3, [0, 0]));
}
