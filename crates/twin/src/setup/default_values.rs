//! Writes the defaults of a scenario out, so that the resolved scenario alone defines the run.

use congruent_description::{JointKind, Robot, RobotDescription, RobotQ};
use congruent_monitors::{RunClock, write_out_limits};
use congruent_motion::{ACCELERATION_M_S2, DEFAULT_GAIN_PER_S, default_jerk_m_s3};
use congruent_scenario::{MotionSettings, Scenario, StartSettings};

use super::{surroundings::DEFAULT_REACH_M, written_at::WrittenAt};

/// Fills in defaults: the duration, the whole start, limits, and the absolute paths of the robot and of files.
pub(super) fn write_out(
    scenario: &mut Scenario,
    description: &RobotDescription,
    clock: &RunClock,
    start: &RobotQ,
    written: WrittenAt<'_>,
) {
    write_out_paths(scenario, written);
    let path = &description.path;
    // A robot that was made in code may have a path that does not exist.
    let whole = path.canonicalize().or_else(|_| std::path::absolute(path));
    scenario.robot = whole.unwrap_or_else(|_| path.clone()).display().to_string();
    // The log has its own length.
    scenario.simulation.duration_s = clock.steps.map(|steps| clock.time_s(steps));
    // Keys of [uncertainty] name values of the start in the unit in which they are written.
    if scenario.uncertainty.is_none() {
        scenario.start = written_start(&description.robot, start);
    }
    for motion in &mut scenario.motion {
        write_out_profile(motion);
        let rates = match motion {
            MotionSettings::Servo(servo) => {
                servo.gain_per_s.get_or_insert(DEFAULT_GAIN_PER_S);
                continue;
            }
            MotionSettings::Line(line) if line.speed_m_s.is_some() => {
                (&mut line.acceleration_m_s2, &mut line.jerk_m_s3)
            }
            MotionSettings::Arc(arc) if arc.speed_m_s.is_some() => {
                (&mut arc.acceleration_m_s2, &mut arc.jerk_m_s3)
            }
            MotionSettings::TcpPath(path) => (&mut path.acceleration_m_s2, &mut path.jerk_m_s3),
            // Lines and arcs with a duration have a profile instead.
            _ => continue,
        };
        let acceleration_m_s2 = *rates.0.get_or_insert(ACCELERATION_M_S2);
        rates.1.get_or_insert_with(|| default_jerk_m_s3(acceleration_m_s2));
    }
    for grasp in &mut scenario.grasp {
        let tip = || description.robot.link(description.tip).name.clone();
        grasp.link.get_or_insert_with(tip);
        if grasp.reach_mm.is_none() {
            grasp.reach_m.get_or_insert(DEFAULT_REACH_M);
        }
    }
    for check in &mut scenario.check {
        write_out_limits(check, description, clock.step_s);
    }
}

/// Fills in the default profile of motions with a duration; with a speed there is none.
fn write_out_profile(motion: &mut MotionSettings) {
    let profile = match motion {
        MotionSettings::Line(line) if line.duration_s.is_some() => &mut line.profile,
        MotionSettings::Arc(arc) if arc.duration_s.is_some() => &mut arc.profile,
        _ => return,
    };
    profile.get_or_insert_default();
}

/// Makes the paths of other files absolute.
fn write_out_paths(scenario: &mut Scenario, WrittenAt { folder, stream, .. }: WrittenAt<'_>) {
    // Meshes keep their paths: those that leave the project of the folder are refused.
    if scenario.folder.is_some() || scenario.obstacle.iter().any(|obstacle| obstacle.mesh.is_some()) {
        scenario.folder = Some(folder.whole(".").display().to_string());
    }
    let source = scenario.source.clone();
    for file in scenario.named_files_mut() {
        *file = folder.whole(file).display().to_string();
    }
    if stream.is_some() {
        // What a stream comes from is no file in the folder.
        scenario.source = source;
    }
}

/// Positions of all joints that follow no other, by name, in radians and metres.
fn written_start(robot: &Robot, q: &RobotQ) -> StartSettings {
    let mut start = StartSettings::default();
    for (&joint, &position) in robot.movable_joints().iter().zip(q) {
        let joint = robot.joint(joint);
        // A position of a follower would be refused when the written scenario is read again.
        if joint.mimic.is_none() {
            let group = match joint.kind {
                JointKind::Prismatic => &mut start.joints_m,
                _ => &mut start.joints_rad,
            };
            group.insert(joint.name.clone(), position);
        }
    }
    start
}
