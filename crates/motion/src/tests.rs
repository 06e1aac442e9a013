//! One motion after another, looked up at instants.

use std::path::Path;

use congruent_description::load_robot;
use congruent_scenario::{OverLimit, Profile};

use super::{
    motion_plan::{JointSpacePath, Motion, MotionPlan, PlannedMove},
    reference_generator::ReferenceGenerator,
    timing::{MotionLimits, TimeScaling},
    trajectory::Trajectory,
};

fn no_limits() -> MotionLimits {
    let none = || vec![f64::INFINITY];
    MotionLimits {
        velocity: none(),
        acceleration: none(),
        jerk: none(),
        declared_acceleration: none(),
        declared_jerk: none(),
        over_limit: OverLimit::Refuse,
    }
}

/// From 1 to 3 in 2 s, then to -1 in 1 s.
fn trajectory() -> Trajectory {
    let motion = |from, to, duration_s| Motion {
        duration_s,
        motion_plan: MotionPlan::Planned(PlannedMove {
            joint_path: JointSpacePath::Straight([from].into()),
            to: [to].into(),
            time_scaling: TimeScaling::Shape { profile: Profile::Linear, duration_s },
            begins_s: 0.0,
        }),
    };
    Trajectory {
        start: [1.0].into(),
        motions: vec![motion(1.0, 3.0, 2.0), motion(3.0, -1.0, 1.0)],
        starts_s: vec![0.0, 2.0],
        lines: Vec::new(),
        limits: no_limits(),
    }
}

#[track_caller]
fn at(trajectory: &Trajectory, time_s: f64, q: f64, qd: f64) {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/planar_2r");
    let description = load_robot(&robot).unwrap();
    let mut reference_generator = ReferenceGenerator::with(trajectory, &description, None);
    reference_generator.advance(time_s, &[f64::NAN].into()).unwrap();
    assert_eq!(
        (&reference_generator.q()[..], reference_generator.qd()),
        (&[q][..], &[qd][..]),
        "at {time_s} s"
    );
}

#[test]
fn one_motion_after_another() {
    let trajectory = trajectory();
    at(&trajectory, 0.0, 1.0, 0.0);
    at(&trajectory, 1.5, 2.5, 1.0);
    // Where one ends the next begins: the position is the same, and both rest there.
    at(&trajectory, 2.0, 3.0, 0.0);
    at(&trajectory, 2.5, 1.0, -4.0);
    at(&trajectory, 3.0, -1.0, 0.0);
    at(&trajectory, 100.0, -1.0, 0.0);
    assert_eq!((trajectory.duration_s(), &trajectory.end()[..]), (3.0, [-1.0].as_slice()));
}

#[test]
fn without_motions_it_holds_the_start() {
    let still = Trajectory {
        start: [1.0].into(),
        motions: Vec::new(),
        starts_s: Vec::new(),
        lines: Vec::new(),
        limits: no_limits(),
    };
    at(&still, 7.0, 1.0, 0.0);
    assert_eq!((still.duration_s(), &still.end()[..]), (0.0, [1.0].as_slice()));
}
