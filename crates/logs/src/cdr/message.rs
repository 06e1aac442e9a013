//! The messages that are decoded: joint states, poses, TF and texts.

use super::reader::{CdrFault, CdrReader};

/// A type of message that is decoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MessageKind {
    /// `sensor_msgs/msg/JointState`.
    JointState,
    /// `geometry_msgs/msg/PoseStamped`, and one with a covariance behind it, which is not read.
    Pose,
    /// `geometry_msgs/msg/TransformStamped`.
    Transform,
    /// `tf2_msgs/msg/TFMessage`.
    Transforms,
    /// `std_msgs/msg/String`.
    Text,
}

/// The types with what is decoded of them. ROS 1 and old bags of ROS 2 write them without `/msg`.
const TYPES: [(&str, MessageKind); 6] = [
    ("sensor_msgs/JointState", MessageKind::JointState),
    ("geometry_msgs/PoseStamped", MessageKind::Pose),
    ("geometry_msgs/PoseWithCovarianceStamped", MessageKind::Pose),
    ("geometry_msgs/TransformStamped", MessageKind::Transform),
    ("tf2_msgs/TFMessage", MessageKind::Transforms),
    ("std_msgs/String", MessageKind::Text),
];

/// A decoded message. Stamps are ns; 0 means none.
#[derive(Debug, PartialEq)]
pub(crate) enum Decoded<'a> {
    Joints {
        stamp_ns: Option<i64>,
        names: Vec<&'a str>,
        position: Vec<f64>,
        velocity: Vec<f64>,
        effort: Vec<f64>,
    },
    Poses(Vec<DecodedPose<'a>>),
    Text(&'a str),
}

/// A decoded pose or edge of TF.
#[derive(Debug, PartialEq)]
pub(crate) struct DecodedPose<'a> {
    pub(crate) stamp_ns: Option<i64>,
    pub(crate) frame: &'a str,
    pub(crate) child: Option<&'a str>,
    pub(crate) child_in_frame_m: [f64; 3],
    pub(crate) frame_from_child_wxyz: [f64; 4],
}

impl MessageKind {
    /// The kind of a type; `None` if it is not decoded.
    pub(crate) fn of_type(message_type: &str) -> Option<Self> {
        let plain = message_type.replace("/msg/", "/");
        TYPES.iter().find(|(name, _)| *name == plain).map(|(_, kind)| *kind)
    }

    /// Decodes a message of this kind.
    pub(crate) fn decode(self, message: &[u8]) -> Result<Decoded<'_>, CdrFault> {
        let mut reader = CdrReader::new(message)?;
        Ok(match self {
            Self::JointState => joint_state(&mut reader)?,
            Self::Pose => Decoded::Poses(vec![pose(&mut reader)?]),
            Self::Transform => Decoded::Poses(vec![transform(&mut reader)?]),
            Self::Transforms => Decoded::Poses(transforms(&mut reader)?),
            Self::Text => Decoded::Text(reader.text()?),
        })
    }
}

struct StampAndFrame<'a> {
    stamp_ns: Option<i64>,
    frame: &'a str,
}

fn header<'a>(reader: &mut CdrReader<'a>) -> Result<StampAndFrame<'a>, CdrFault> {
    let (seconds, nanoseconds) = (reader.i32()?, reader.u32()?);
    let ns = i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds);
    // A header that nobody filled has the stamp 0.
    Ok(StampAndFrame { stamp_ns: (ns != 0).then_some(ns), frame: reader.text()? })
}

fn joint_state<'a>(reader: &mut CdrReader<'a>) -> Result<Decoded<'a>, CdrFault> {
    /// Bytes of the shortest text: its length alone.
    const LEAST_TEXT: usize = 4;
    let StampAndFrame { stamp_ns, .. } = header(reader)?;
    let count = reader.entry_count(LEAST_TEXT)?;
    let names = (0..count).map(|_| reader.text()).collect::<Result<_, _>>()?;
    let mut list = || reader.f64_list();
    Ok(Decoded::Joints { stamp_ns, names, position: list()?, velocity: list()?, effort: list()? })
}

fn pose<'a>(reader: &mut CdrReader<'a>) -> Result<DecodedPose<'a>, CdrFault> {
    let head = header(reader)?;
    placed(reader, &head, None)
}

fn transform<'a>(reader: &mut CdrReader<'a>) -> Result<DecodedPose<'a>, CdrFault> {
    let head = header(reader)?;
    let child = reader.text()?;
    placed(reader, &head, Some(child))
}

fn transforms<'a>(reader: &mut CdrReader<'a>) -> Result<Vec<DecodedPose<'a>>, CdrFault> {
    /// Bytes of the shortest edge: stamp, two lengths, seven numbers.
    const LEAST_EDGE: usize = 8 + 2 * 4 + 7 * 8;
    let count = reader.entry_count(LEAST_EDGE)?;
    (0..count).map(|_| transform(reader)).collect()
}

fn placed<'a>(
    reader: &mut CdrReader<'a>,
    head: &StampAndFrame<'a>,
    child: Option<&'a str>,
) -> Result<DecodedPose<'a>, CdrFault> {
    let child_in_frame_m = reader.f64s()?;
    let [x, y, z, w] = reader.f64s()?;
    let StampAndFrame { stamp_ns, frame } = *head;
    Ok(DecodedPose { stamp_ns, frame, child, child_in_frame_m, frame_from_child_wxyz: [w, x, y, z] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr::write::{ByteOrder, CdrText, joint_state_text};

    #[test]
    fn a_joint_state_in_both_byte_orders() {
        let expected = Decoded::Joints {
            stamp_ns: Some(3_000_000_004),
            names: vec!["elbow", "wrist_1"],
            position: vec![0.5, -1.0],
            velocity: vec![],
            effort: vec![f64::MAX, 2.0],
        };
        for order in [ByteOrder::Little, ByteOrder::Big] {
            let mut text = CdrText::new(order);
            joint_state_text(&mut text, 3_000_000_004, ["elbow", "wrist_1"].into_iter());
            text.f64_list(&[0.5, -1.0]);
            text.f64_list(&[]);
            text.f64_list(&[f64::MAX, 2.0]);
            assert_eq!(MessageKind::JointState.decode(&text.bytes), Ok(expected.clone_for_test()));
            // Each message that is cut anywhere is an error.
            for length in 0..text.bytes.len() {
                assert!(MessageKind::JointState.decode(&text.bytes[..length]).is_err(), "{length}");
            }
        }
    }

    impl Decoded<'_> {
        fn clone_for_test(&self) -> Self {
            let Self::Joints { stamp_ns, names, position, velocity, effort } = self else { unreachable!() };
            Self::Joints {
                stamp_ns: *stamp_ns,
                names: names.clone(),
                position: position.clone(),
                velocity: velocity.clone(),
                effort: effort.clone(),
            }
        }
    }

    #[test]
    fn edges_of_tf_have_both_frames_and_the_scalar_first() {
        let mut text = CdrText::new(ByteOrder::Little);
        text.u32(1);
        text.header(7, "base");
        text.text("tool0");
        for value in [1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8] {
            text.f64(value);
        }
        let Ok(Decoded::Poses(edges)) = MessageKind::Transforms.decode(&text.bytes) else { panic!() };
        let expected = DecodedPose {
            stamp_ns: Some(7),
            frame: "base",
            child: Some("tool0"),
            child_in_frame_m: [1.0, 2.0, 3.0],
            frame_from_child_wxyz: [0.8, 0.0, 0.0, 0.6],
        };
        assert_eq!(edges, [expected]);
    }

    #[test]
    fn types_are_known_with_and_without_msg() {
        for name in ["sensor_msgs/JointState", "sensor_msgs/msg/JointState"] {
            assert_eq!(MessageKind::of_type(name), Some(MessageKind::JointState));
        }
        assert_eq!(MessageKind::of_type("sensor_msgs/msg/Image"), None);
    }
}
