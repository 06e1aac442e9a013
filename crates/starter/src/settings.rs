//! What a scenario is made of: controllers, checks, positions by name.

use congruent_description::{Joint, JointKind, RobotDescription, RobotQ};
use congruent_scenario::{
    AgreementCheck, Check, ControllerKind, ControllerSettings, DynamicsCheck, EffortCheck, InvariantsCheck,
    JointMotion, LimitsCheck, MotionSettings, PowerCheck, Profile, StartSettings, TrackingCheck, TwistCheck,
};

use crate::joint_move::JointMove;

/// Agreement of table and twin, if the robot's tolerance is not wider. Kind: rounding over a run of some thousand steps.
const AGREEMENT: f64 = 1e-9;
/// Tracking of joints that turn, that slide, and at the end.
const PATH_DEG: f64 = 1.0;
const PATH_MM: f64 = 1.0;
const GOAL_DEG: f64 = 0.5;
const GOAL_MM: f64 = 0.5;

/// Any masses are moved alike.
pub(super) fn computed_torque() -> ControllerSettings {
    ControllerSettings {
        kind: ControllerKind::ComputedTorque,
        stiffness: 400.0.into(),
        damping: 40.0.into(),
        ..ControllerSettings::default()
    }
}

/// Stiffer than computed torque where dry friction holds light links.
pub(super) fn gravity_compensation() -> ControllerSettings {
    ControllerSettings {
        kind: ControllerKind::GravityCompensation,
        stiffness: 2000.0.into(),
        damping: 120.0.into(),
        ..ControllerSettings::default()
    }
}

/// The checks but those of distances.
pub(super) fn checks(description: &RobotDescription) -> Vec<Check> {
    let robot = &description.robot;
    let kinds = robot.movable_joints().iter().map(|&joint| robot.joint(joint).kind);
    let (sliding, turning): (Vec<_>, Vec<_>) = kinds.partition(|kind| *kind == JointKind::Prismatic);
    let of = |joints: &[JointKind], value: f64| (!joints.is_empty()).then_some(value);
    let tolerance = description.tolerance;
    vec![
        Check::Agreement(AgreementCheck {
            position_m: Some(tolerance.position_m.max(AGREEMENT)),
            orientation_rad: Some(tolerance.orientation_rad.max(AGREEMENT)),
            ..AgreementCheck::default()
        }),
        Check::Limits(LimitsCheck::default()),
        Check::Tracking(TrackingCheck {
            path_deg: of(&turning, PATH_DEG),
            path_mm: of(&sliding, PATH_MM),
            goal_deg: of(&turning, GOAL_DEG),
            goal_mm: of(&sliding, GOAL_MM),
            ..TrackingCheck::default()
        }),
        Check::Invariants(InvariantsCheck::default()),
        Check::Twist(TwistCheck::default()),
        Check::Dynamics(DynamicsCheck::default()),
        Check::Power(PowerCheck::default()),
        Check::Effort(EffortCheck::default()),
    ]
}

/// Every joint that has a position of its own, at the start.
pub(super) fn start_settings(description: &RobotDescription, motion: &JointMove) -> StartSettings {
    let mut settings = StartSettings::default();
    let robot = &description.robot;
    for (coordinate, &joint) in robot.movable_joints().iter().enumerate() {
        let joint = robot.joint(joint);
        if joint.mimic.is_some() {
            continue;
        }
        let (name, value) = (joint.name.clone(), motion.start[coordinate]);
        match joint.kind {
            JointKind::Prismatic => settings.joints_m.insert(name, in_metres(value)),
            _ => settings.joints_deg.insert(name, in_degrees(joint, value)),
        };
    }
    settings
}

/// To the target and back.
pub(super) fn motion_settings(description: &RobotDescription, motion: &JointMove) -> Vec<MotionSettings> {
    let to = |q: &RobotQ| {
        let mut settings = JointMotion {
            duration_s: Some(motion.duration_s),
            profile: Profile::Quintic,
            ..JointMotion::default()
        };
        for &coordinate in &motion.moving {
            let joint = description.robot.joint(description.robot.movable_joints()[coordinate]);
            match joint.kind {
                JointKind::Prismatic => {
                    settings.move_joints_m.insert(joint.name.clone(), in_metres(q[coordinate]))
                }
                _ => settings.move_joints_deg.insert(joint.name.clone(), in_degrees(joint, q[coordinate])),
            };
        }
        MotionSettings::Joints(settings)
    };
    vec![to(&motion.target), to(&motion.start)]
}

/// Far more than the rounding of a conversion to degrees and back, far less than a motion.
const INWARDS_DEG: f64 = 1e-9;

/// In degrees, without the digits that the conversion has added to tenths. At the end of a range it is a little inside: the
/// conversion back may be rounded to outside of it.
fn in_degrees(joint: &Joint, radians: f64) -> f64 {
    let degrees = without_noise(radians.to_degrees());
    match joint.position_range() {
        Some((lower, _)) if degrees.to_radians() < lower => degrees + INWARDS_DEG,
        Some((_, upper)) if degrees.to_radians() > upper => degrees - INWARDS_DEG,
        _ => degrees,
    }
}

fn in_metres(metres: f64) -> f64 {
    without_noise(metres)
}

fn without_noise(value: f64) -> f64 {
    let short = (value * 1e4).round() / 1e4 + 0.0;
    if (short - value).abs() < 1e-9 { short } else { value }
}

#[cfg(test)]
mod tests {
    use congruent_description::{JointLimit, JointParts};

    use super::*;

    fn joint(range: Option<(f64, f64)>) -> Joint {
        let mut parts = JointParts::new("j", JointKind::Revolute, "a", "b", nalgebra::Isometry3::identity());
        parts.joint.limit = range.map(|(lower, upper)| JointLimit { lower, upper, ..JointLimit::default() });
        parts.joint
    }

    /// Ends of ranges as URDFs have them: degrees with seven digits in radians.
    #[test]
    fn the_end_of_a_range_is_still_inside_after_conversion_to_degrees_and_back() {
        for tenth in 1..3600_u32 {
            let digits = (f64::from(tenth) * 0.1).to_radians() * 1e7;
            for end in [digits.floor() / 1e7, digits.round() / 1e7, digits.ceil() / 1e7] {
                for (lower, upper) in [(end, end + 1.0), (end - 1.0, end)] {
                    let back = in_degrees(&joint(Some((lower, upper))), end).to_radians();
                    assert!((lower..=upper).contains(&back), "{end}: {back}");
                    assert!((back - end).abs() < 1e-10, "{end}: {back}");
                }
            }
        }
    }

    #[test]
    fn tenths_of_a_degree_are_written_as_such() {
        let joint = joint(None);
        let found = [in_degrees(&joint, 0.1_f64.to_radians()), in_degrees(&joint, 1.0)];
        assert_eq!(found.map(f64::to_bits), [0.1, 1_f64.to_degrees()].map(f64::to_bits));
    }
}
