//! Which outputs of the controller are taken, and what they become.

use std::sync::Arc;

use super::options::RTDE_JOINTS;
use crate::{
    event::{EventTime, LogEvent, LogTopic, LoggedJoints, TopicContent},
    tcp_pose::pose_of_ur,
};

/// The outputs with their types, in the order of a data package.
pub(super) const OUTPUTS: [(&str, &str); 5] = [
    ("timestamp", "DOUBLE"),
    ("actual_q", "VECTOR6D"),
    ("actual_qd", "VECTOR6D"),
    ("actual_current", "VECTOR6D"),
    ("actual_TCP_pose", "VECTOR6D"),
];
/// Numbers of a data package.
const NUMBERS: usize = 1 + 4 * RTDE_JOINTS;

/// The numbers of one data package.
#[derive(Debug, PartialEq)]
pub(super) struct RobotState {
    pub(super) timestamp_ns: i64,
    q: [f64; RTDE_JOINTS],
    qd: [f64; RTDE_JOINTS],
    current_a: [f64; RTDE_JOINTS],
    tcp_pose: [f64; 6],
}

/// The topics of the joints and of the pose, in this order.
pub(super) fn topics() -> [LogTopic; 2] {
    let topic = |name: &str, content| LogTopic {
        name: name.to_owned(),
        message_type: "outputs of the controller".to_owned(),
        encoding: "rtde".to_owned(),
        content,
    };
    [topic("actual_q", TopicContent::Joints), topic("actual_TCP_pose", TopicContent::Pose)]
}

impl RobotState {
    /// Reads the numbers behind the number of the recipe; `None` if these are not the numbers that were asked for.
    pub(super) fn from_payload(payload: &[u8]) -> Option<Self> {
        let (_recipe, bytes) = payload.split_first()?;
        let (numbers, rest) = bytes.as_chunks::<8>();
        if numbers.len() != NUMBERS || !rest.is_empty() {
            return None;
        }
        let number = |at: usize| f64::from_be_bytes(numbers[at]);
        let six = |vector: usize| std::array::from_fn(|at| number(1 + RTDE_JOINTS * vector + at));
        #[expect(clippy::cast_possible_truncation, reason = "seconds since the controller was switched on")]
        let timestamp_ns = (number(0) * 1e9).round() as i64;
        Some(Self { timestamp_ns, q: six(0), qd: six(1), current_a: six(2), tcp_pose: six(3) })
    }

    /// The pose and the joints as events, the pose first: it is judged with the joints of its own package.
    pub(super) fn events(&self, names: &Arc<[String]>, time: EventTime) -> Vec<LogEvent> {
        let joints = LoggedJoints {
            topic: 0,
            time,
            names: Arc::clone(names),
            position: self.q.to_vec(),
            velocity: self.qd.to_vec(),
            effort: self.current_a.to_vec(),
        };
        vec![LogEvent::Pose(pose_of_ur(self.tcp_pose, 1, time)), LogEvent::Joints(joints)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_has_its_numbers_in_the_order_of_the_outputs() {
        let numbers: Vec<u8> = (0..25_u8).flat_map(|number| f64::from(number).to_be_bytes()).collect();
        let payload = [&[1], &numbers[..]].concat();
        let state = RobotState::from_payload(&payload).unwrap();
        assert_eq!((state.q[0], state.qd[5], state.current_a[0], state.tcp_pose[5]), (1.0, 12.0, 13.0, 24.0));
        assert_eq!(RobotState::from_payload(&payload[..payload.len() - 1]), None);
    }
}
