//! The joints of one description in the variables of another: names, directions, zeros.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::{
    joint::{Joint, JointIndex, JointKind, JointLimit, JointParts},
    link::{Link, LinkIndex},
    robot::Robot,
};

/// A joint of a robot in the variable of another description: `q = sign * q_there + offset`.
#[derive(Debug, Clone, PartialEq)]
pub struct MappedJoint {
    /// The joint of the robot.
    pub joint: JointIndex,
    /// Its name in the other description.
    pub name: String,
    /// Whether it moves in the opposite direction there: then `sign` is -1.
    pub is_flipped: bool,
    /// Its position where the other description has its zero, rad or m.
    pub offset: f64,
}

impl MappedJoint {
    /// 1, or -1 if the joint moves in the opposite direction.
    pub fn sign(&self) -> f64 {
        if self.is_flipped { -1.0 } else { 1.0 }
    }

    /// A position of the robot's joint in the variable of the other description.
    pub fn there(&self, q: f64) -> f64 {
        let from_zero = q - self.offset;
        // Of two equal numbers with other last digits nothing is left.
        let is_rounding = from_zero.abs() < 4.0 * f64::EPSILON * q.abs().max(self.offset.abs());
        if is_rounding { 0.0 } else { self.sign() * from_zero }
    }

    /// Whether the variable is the same.
    pub fn has_same_variable(&self) -> bool {
        !self.is_flipped && self.offset == 0.0
    }

    /// The joint with the other name, in the other variable.
    fn rewritten(&self, joint: &Joint) -> Joint {
        let axis = if self.is_flipped { -joint.axis_in_joint } else { joint.axis_in_joint };
        let limit = joint.limit.map(|limit| {
            let ends = [limit.lower, limit.upper].map(|end| self.there(end));
            JointLimit { lower: ends[0].min(ends[1]), upper: ends[0].max(ends[1]), ..limit }
        });
        Joint {
            name: self.name.clone(),
            parent_from_joint: joint.parent_from_joint * joint.motion(self.offset),
            axis_in_joint: axis,
            limit,
            ..joint.clone()
        }
    }
}

impl Joint {
    /// The motion of the child link against the joint frame at a position, rad or m; none of a fixed joint.
    pub fn motion(&self, q: f64) -> Isometry3<f64> {
        match self.kind {
            JointKind::Fixed => Isometry3::identity(),
            JointKind::Revolute | JointKind::Continuous => {
                let turn = UnitQuaternion::from_axis_angle(&self.axis_in_joint, q);
                Isometry3::from_parts(Translation3::identity(), turn)
            }
            JointKind::Prismatic => Translation3::from(self.axis_in_joint.into_inner() * q).into(),
        }
    }
}

impl Robot {
    /// The same robot in the variables of another description: joints that `mapping` names get the name, the direction and
    /// the zero that they have there. Limits and followers come along; the poses of all links stay what they were.
    ///
    /// # Examples
    /// ```
    /// use congruent_description::{MappedJoint, parse_urdf};
    /// let robot = parse_urdf(
    ///     r#"<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/>
    ///       <child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint></robot>"#,
    /// ).unwrap();
    /// let mapped = MappedJoint { joint: robot.movable_joints()[0], name: "k".into(), is_flipped: true, offset: 0.5 };
    /// let there = robot.in_variables(&[mapped]);
    /// let joint = &there.joints()[0];
    /// assert_eq!((joint.name.as_str(), joint.axis_in_joint.z, joint.position_range()), ("k", -1.0, Some((-1.5, 1.5))));
    /// ```
    #[must_use]
    pub fn in_variables(&self, mapping: &[MappedJoint]) -> Self {
        let mapped = |index: JointIndex| mapping.iter().find(|of| of.joint == index);
        let taken: BTreeSet<&str> = mapping.iter().map(|of| of.name.as_str()).collect();
        let name = |index: JointIndex| match mapped(index) {
            Some(of) => of.name.clone(),
            None => free_name(&self.joint(index).name, &taken),
        };
        let parts = self.joints().iter().enumerate().map(|(at, joint)| {
            let index = JointIndex(at);
            let rewritten = mapped(index).map_or_else(|| joint.clone(), |of| of.rewritten(joint));
            // q_f = m q + c, with q = s q' + o on both sides.
            let mimic = joint.mimic.map(|mimic| {
                let variable =
                    |index| mapped(index).map_or((1.0, 0.0), |of: &MappedJoint| (of.sign(), of.offset));
                let ((own, own_offset), (master, master_offset)) = (variable(index), variable(mimic.master));
                let offset = own * (mimic.multiplier * master_offset + mimic.offset - own_offset);
                (name(mimic.master), own * mimic.multiplier * master, offset)
            });
            self.parts(Joint { name: name(index), ..rewritten }, mimic)
        });
        self.rebuilt(self.links().to_vec(), parts.collect())
    }

    /// The same robot with these joints fixed where their positions are 0, and with them those that follow one of them.
    #[must_use]
    pub fn locked(&self, joints: &BTreeSet<JointIndex>) -> Self {
        let is_locked = |index: JointIndex| joints.contains(&index);
        let parts = self.joints().iter().enumerate().map(|(at, joint)| {
            let follows = joint.mimic.filter(|mimic| is_locked(mimic.master));
            if !is_locked(JointIndex(at)) && follows.is_none() {
                let mimic =
                    joint.mimic.map(|of| (self.joint(of.master).name.clone(), of.multiplier, of.offset));
                return self.parts(joint.clone(), mimic);
            }
            let position = joint.mimic.map_or(0.0, |mimic| mimic.offset);
            let locked = Joint {
                kind: JointKind::Fixed,
                parent_from_joint: joint.parent_from_joint * joint.motion(position),
                limit: None,
                ..joint.clone()
            };
            self.parts(locked, None)
        });
        self.rebuilt(self.links().to_vec(), parts.collect())
    }

    /// The same robot with the frames of its links elsewhere in them: `link_from_frame` has one pose for each link, identity
    /// where the frame stays. The origin of a link behind a moving joint must stay on the axis of that joint.
    ///
    /// # Panics
    /// If there is not one pose for each link.
    #[must_use]
    pub fn with_link_frames(&self, link_from_frame: &[Isometry3<f64>]) -> Self {
        assert_eq!(link_from_frame.len(), self.links().len(), "one frame for each link");
        let parts = self.joints().iter().map(|joint| {
            let [parent, child] = [joint.parent, joint.child].map(|link| link_from_frame[link.0]);
            let mimic = joint.mimic.map(|of| (self.joint(of.master).name.clone(), of.multiplier, of.offset));
            let moved = Joint {
                parent_from_joint: parent.inverse() * joint.parent_from_joint * child,
                axis_in_joint: child.rotation.inverse() * joint.axis_in_joint,
                ..joint.clone()
            };
            self.parts(moved, mimic)
        });
        let links = self.links().iter().zip(link_from_frame).map(|(link, frame)| link_in_frame(link, frame));
        self.rebuilt(links.collect(), parts.collect())
    }

    /// The same robot with other names of some links; a link that has one of these names already gets a mark behind its own.
    #[must_use]
    pub fn with_link_names(&self, names: &BTreeMap<LinkIndex, String>) -> Self {
        let taken: BTreeSet<&str> = names.values().map(String::as_str).collect();
        let name = |index: LinkIndex| {
            names.get(&index).cloned().unwrap_or_else(|| free_name(&self.link(index).name, &taken))
        };
        let links = self.link_indices().map(|index| Link { name: name(index), ..self.link(index).clone() });
        let parts = self.joints().iter().map(|joint| {
            let mimic = joint.mimic.map(|of| (self.joint(of.master).name.clone(), of.multiplier, of.offset));
            let [parent, child] = [joint.parent, joint.child].map(name);
            JointParts { joint: joint.clone(), parent, child, mimic }
        });
        self.rebuilt(links.collect(), parts.collect())
    }

    /// The parts of a joint between the links that it has here.
    fn parts(&self, joint: Joint, mimic: Option<(String, f64, f64)>) -> JointParts {
        let [parent, child] = [joint.parent, joint.child].map(|link| self.link(link).name.clone());
        JointParts { joint, parent, child, mimic }
    }

    fn rebuilt(&self, links: Vec<Link>, joints: Vec<JointParts>) -> Self {
        Self::new(self.name(), links, joints).expect("names and tree are those of a robot")
    }
}

/// A name that no mapped joint has taken.
fn free_name(name: &str, taken: &BTreeSet<&str>) -> String {
    let mut free = name.to_owned();
    while taken.contains(free.as_str()) {
        free.push('\'');
    }
    free
}

/// A link whose inertia and shapes are given in another frame of it.
fn link_in_frame(link: &Link, link_from_frame: &Isometry3<f64>) -> Link {
    let frame_from_link = link_from_frame.inverse();
    let mut moved = link.clone();
    if let Some(inertia) = &mut moved.inertia {
        inertia.link_from_inertial = frame_from_link * inertia.link_from_inertial;
    }
    for shape in moved.visuals.iter_mut().chain(&mut moved.collisions) {
        shape.link_from_shape = frame_from_link * shape.link_from_shape;
    }
    moved
}

#[cfg(test)]
mod tests {
    use nalgebra::Unit;

    use super::*;
    use crate::parse_urdf;

    /// A slide that follows a hinge, and a hinge on it.
    const URDF: &str = r#"<robot name="r">
      <link name="base"/><link name="arm"><inertial><mass value="2"/><origin xyz="0.1 0 0"/>
        <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <link name="slide"/><link name="hand"/>
      <joint name="a" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.3" rpy="0.4 0 0"/>
        <axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
      <joint name="b" type="prismatic"><parent link="arm"/><child link="slide"/><origin xyz="0.2 0 0"/>
        <axis xyz="1 0 0"/><limit lower="0" upper="0.5" effort="1" velocity="1"/><mimic joint="a" multiplier="0.2" offset="0.1"/></joint>
      <joint name="c" type="continuous"><parent link="slide"/><child link="hand"/><origin rpy="0 0.7 0"/></joint>
    </robot>"#;

    /// Pose of the hand in the base at the positions of a and c.
    fn base_from_hand(robot: &Robot, a: f64, c: f64) -> Isometry3<f64> {
        let mut q = super::super::RobotQ::from([a, 0.0, c]);
        robot.apply_mimic(&mut q);
        let joints = robot.joints().iter().map(|joint| {
            let at = robot.coordinate(robot.find_joint(&joint.name).unwrap());
            joint.parent_from_joint * joint.motion(at.map_or(0.0, |at| q[at]))
        });
        joints.fold(Isometry3::identity(), |before, joint| before * joint)
    }

    #[track_caller]
    fn assert_same(found: &Isometry3<f64>, expected: &Isometry3<f64>) {
        let off = found.to_homogeneous() - expected.to_homogeneous();
        assert!(off.amax() < 1e-15, "{off}");
    }

    #[test]
    fn the_same_positions_in_other_variables_give_the_same_poses() {
        let robot = parse_urdf(URDF).unwrap();
        let [a, b, c] = [0, 1, 2].map(|at| robot.movable_joints()[at]);
        let mapped = |joint, name: &str, is_flipped, offset| MappedJoint {
            joint,
            name: name.into(),
            is_flipped,
            offset,
        };
        let mapping = [mapped(a, "b", true, 0.3), mapped(b, "x", true, -0.05), mapped(c, "c", false, 1.0)];
        let there = robot.in_variables(&mapping);
        assert_eq!(there.movable_joint_names().collect::<Vec<_>>(), ["b", "x", "c"]);
        for (q_a, q_c) in [(0.0, 0.0), (0.7, -0.4), (-1.2, 2.0)] {
            let found = base_from_hand(&there, mapping[0].there(q_a), mapping[2].there(q_c));
            assert_same(&found, &base_from_hand(&robot, q_a, q_c));
        }
        let (lower, upper) = there.joints()[0].position_range().unwrap();
        assert!((lower + 1.7).abs() < 1e-15 && (upper - 1.3).abs() < 1e-15, "{lower} {upper}");
    }

    #[test]
    fn a_locked_joint_stays_at_zero_and_its_follower_at_its_offset() {
        let robot = parse_urdf(URDF).unwrap();
        let locked = robot.locked(&BTreeSet::from([robot.movable_joints()[0]]));
        assert_eq!(locked.movable_joint_names().collect::<Vec<_>>(), ["c"]);
        assert!((locked.joints()[1].parent_from_joint.translation.vector.x - 0.3).abs() < 1e-15);
    }

    #[test]
    fn frames_that_lie_elsewhere_carry_inertia_and_children_along() {
        let robot = parse_urdf(URDF).unwrap();
        let axis = Unit::new_normalize(robot.joints()[0].axis_in_joint.into_inner());
        let along = Translation3::from(axis.into_inner() * 0.2);
        let mut frames = vec![Isometry3::identity(); 4];
        frames[1] = along * UnitQuaternion::from_euler_angles(0.2, 0.5, -0.3);
        let there = robot.with_link_frames(&frames);
        for (q_a, q_c) in [(0.0, 0.0), (0.7, -0.4)] {
            assert_same(&base_from_hand(&there, q_a, q_c), &base_from_hand(&robot, q_a, q_c));
        }
        let com = |robot: &Robot| {
            let joint = &robot.joints()[0];
            let link = robot.link(joint.child).inertia.unwrap().link_from_inertial;
            joint.parent_from_joint * joint.motion(0.9) * link
        };
        assert_same(&com(&there), &com(&robot));
    }
}
