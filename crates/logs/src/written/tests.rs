//! What was written is what is read back, to the last bit.

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::*;
use crate::{LogEvent, LogOptions, TopicContent, open_log, recorded_description};

const URDF: &str = "<robot name='arm'><link name='base'/></robot>";

fn written(path: &Path) {
    let mut log = LogWriter::create(path).unwrap();
    let pose = Isometry3::from_parts(
        Translation3::new(0.1, -0.2, 1.0 / 3.0),
        UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.1, 0.7)),
    );
    let edges = [WrittenEdge { frame: "base", child: "tool", frame_from_child: pose }];
    log.description(URDF).unwrap();
    log.static_transforms(edges.into_iter()).unwrap();
    let names = ["elbow".to_owned(), "slide".to_owned()];
    for (time_s, q) in [(0.0, [0.1, 2.0]), (0.001, [1.0 / 3.0, -2.0])] {
        let joints = WrittenJoints { names: &names, position: &q, velocity: &[], effort: &[7.5, 0.0] };
        log.joint_states(JointTopic::Measured, time_s, &joints).unwrap();
        log.joint_states(JointTopic::Desired, time_s, &joints).unwrap();
        log.transforms(time_s, edges.into_iter()).unwrap();
    }
    let values = vec![("limit".to_owned(), "1 mm".to_owned())];
    let [name, message, hardware_id] = ["agreement", "pass", "arm"].map(str::to_owned);
    log.diagnostics(
        0.001,
        &[WrittenDiagnostic { level: DiagnosticLevel::Ok, name, message, hardware_id, values }],
    )
    .unwrap();
    log.finish().unwrap();
}

#[test]
fn a_log_is_read_back_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    written(&path);
    let mut reader = open_log(&path, &LogOptions::default()).unwrap();
    let (mut positions, mut poses) = (Vec::new(), 0);
    while let Some(event) = reader.next_event().unwrap() {
        match event {
            LogEvent::Joints(joints) => {
                assert!(joints.velocity.is_empty() && joints.effort == [7.5, 0.0]);
                positions.push((joints.time.stamp_ns.unwrap(), joints.position));
            }
            LogEvent::Pose(pose) | LogEvent::StaticEdge(pose) => {
                poses += 1;
                assert_eq!((&*pose.frame, pose.child.as_deref()), ("base", Some("tool")));
                assert_eq!(pose.child_in_frame_m[2].to_bits(), (1.0_f64 / 3.0).to_bits());
            }
            LogEvent::Description(found) => assert_eq!(found.text, URDF),
            LogEvent::Other(other) => assert_eq!(other.fault, None),
            LogEvent::Unusable(_) | LogEvent::Gap(_) => panic!("{event:?}"),
        }
    }
    assert_eq!((poses, positions.len()), (3, 4));
    assert_eq!(positions[3], (1_001_000_000, vec![1.0 / 3.0, -2.0]));
    let contents: Vec<_> = reader.topics().iter().map(|topic| (topic.content, &*topic.name)).collect();
    assert!(contents.contains(&(TopicContent::StaticTransforms, "/tf_static")), "{contents:?}");
    assert_eq!(recorded_description(&path).unwrap().source.text, URDF);
}

#[test]
fn of_a_program_that_was_killed_all_whole_chunks_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    written(&path);
    // Before the footer: as if the end had not been written.
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() * 3 / 4]).unwrap();
    assert_eq!(recorded_description(&path).unwrap().source.text, URDF);
}
