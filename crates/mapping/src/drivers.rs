//! Coupled joints that another description drives at another one of them.

use congruent_description::{Joint, JointIndex, Mimic, Robot};

/// The other description with its coupled joints driven as in `robot`, and the names of the joints that drive in it as written and
/// follow in `robot`. Both have the same moving joints by name. No motion changes: where `b = m a + c` drives `a` in one file and
/// `b` in the other, the coupling is solved for the one that drives in `robot`.
pub fn driven_as_in(robot: &Robot, other: &Robot) -> (Robot, Vec<String>) {
    let mut driven = other.clone();
    let mut names = Vec::new();
    for &master in other.movable_joints() {
        let Some(driver) = driver_in(robot, other, master) else { continue };
        let Some(Mimic { multiplier, offset, .. }) = other.joint(driver).mimic else { continue };
        names.push(other.joint(master).name.clone());
        // b = m a + c is a = b / m - c / m; what else follows a follows b in its place.
        let follows_driver = |ratio: f64, constant: f64| Mimic {
            master: driver,
            multiplier: ratio / multiplier,
            offset: constant - ratio * offset / multiplier,
        };
        driven = driven.with_joints(|joint: &mut Joint| {
            let index = other.find_joint(&joint.name);
            joint.mimic = match joint.mimic {
                _ if index == Some(driver) => None,
                None if index == Some(master) => Some(follows_driver(1.0, 0.0)),
                Some(of) if of.master == master => Some(follows_driver(of.multiplier, of.offset)),
                other => other,
            };
        });
    }
    (driven, names)
}

/// The joint of the other description that follows `master` there, and that `master` follows in the robot.
fn driver_in(robot: &Robot, other: &Robot, master: JointIndex) -> Option<JointIndex> {
    if other.joint(master).mimic.is_some() {
        return None;
    }
    let own = robot.joint(robot.find_joint(&other.joint(master).name)?);
    let driver = other.find_joint(&robot.joint(own.mimic?.master).name)?;
    let there = other.joint(driver).mimic?;
    (there.master == master && there.multiplier != 0.0).then_some(driver)
}

#[cfg(test)]
mod tests {
    use congruent_description::{RobotQ, parse_urdf};

    use super::*;

    /// Three slides of which the first or the second drives.
    fn gripper(mimics: [&str; 3]) -> Robot {
        let joint = |(name, mimic): (&str, &str)| {
            format!(
                r#"<link name="l{name}"/><joint name="{name}" type="prismatic"><parent link="palm"/><child link="l{name}"/>
                <limit lower="-1" upper="1" effort="1" velocity="1"/>{mimic}</joint>"#
            )
        };
        let joints: String = ["a", "b", "c"].into_iter().zip(mimics).map(joint).collect();
        parse_urdf(&format!(r#"<robot name="g"><link name="palm"/>{joints}</robot>"#)).unwrap()
    }

    #[test]
    fn the_coupling_is_the_same_whichever_joint_drives() {
        let own = gripper([r#"<mimic joint="b" multiplier="2"/>"#, "", r#"<mimic joint="b"/>"#]);
        let other = gripper([
            "",
            r#"<mimic joint="a" multiplier="0.5" offset="0.1"/>"#,
            r#"<mimic joint="a" multiplier="4" offset="0.3"/>"#,
        ]);
        let (driven, names) = driven_as_in(&own, &other);
        assert_eq!(names, ["a"]);
        // b = a / 2 + 0.1, c = 4 a + 0.3.
        let mut q = RobotQ::from([0.0, 0.35, 0.0]);
        driven.apply_mimic(&mut q);
        assert!((q[0] - 0.5).abs() < 1e-15 && (q[2] - 2.3).abs() < 1e-15, "{q:?}");
        assert_eq!(driven_as_in(&own, &own).1, Vec::<String>::new());
    }
}
