//! The joints of one description in the variables of another: names, directions, zeros.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::{
    joint::{Joint, JointIndex, JointKind, JointParts},
    joint_limit::JointLimit,
    link::{Link, LinkIndex},
    robot::Robot,
    rounding::{JointForm, SmallMotion},
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

    /// What the digits of the axis of a joint leave open of what it carries, where the joint is at the offset: an axis that lies
    /// elsewhere turns and shifts it to elsewhere. In the parent link.
    fn motions_at_offset<'a>(&self, joint: &'a Joint) -> impl Iterator<Item = SmallMotion> + 'a {
        let parent_from_joint = joint.parent_from_joint;
        let by_offset = parent_from_joint * joint.motion(self.offset) * parent_from_joint.inverse();
        let axes = if self.offset == 0.0 { &[][..] } else { &joint.rounding.axis };
        axes.iter().map(move |motion| motion.less(&motion.expressed_in(&by_offset)))
    }

    /// The joint with the other name, in the other variable.
    fn rewritten(&self, joint: &Joint) -> Joint {
        let axis = if self.is_flipped { -joint.axis_in_joint } else { joint.axis_in_joint };
        let limit = joint.limit.map(|limit| {
            let ends = [limit.lower, limit.upper].map(|end| self.there(end));
            JointLimit { lower: ends[0].min(ends[1]), upper: ends[0].max(ends[1]), ..limit }
        });
        let mut value_rounding = joint.value_rounding;
        if self.is_flipped {
            std::mem::swap(&mut value_rounding.limit.lower, &mut value_rounding.limit.upper);
        }
        Joint {
            name: self.name.clone(),
            parent_from_joint: joint.parent_from_joint * joint.motion(self.offset),
            axis_in_joint: axis,
            limit,
            value_rounding,
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
        let is_other = mapping.iter().any(|of| !of.has_same_variable());
        let parts = self.joints().iter().enumerate().map(|(at, joint)| {
            let index = JointIndex(at);
            let mut rewritten = mapped(index).map_or_else(|| joint.clone(), |of| of.rewritten(joint));
            if is_other && joint.rounding.form != JointForm::Pose {
                rewritten.rounding.form = JointForm::Rewritten;
            }
            if let Some(of) = mapped(index) {
                rewritten.rounding.frame.extend(of.motions_at_offset(joint));
            }
            let before = self
                .parent_joint(joint.parent)
                .and_then(|before| Some((mapped(before)?, self.joint(before))));
            if let Some((of, before)) = before {
                let link_from_before = (before.parent_from_joint * before.motion(of.offset)).inverse();
                let moved = of.motions_at_offset(before);
                rewritten.rounding.origin.extend(moved.map(|motion| motion.expressed_in(&link_from_before)));
            }
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
                return self.parts(joint.clone(), self.written_mimic(joint));
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
            let moved = Joint {
                parent_from_joint: parent.inverse() * joint.parent_from_joint * child,
                axis_in_joint: child.rotation.inverse() * joint.axis_in_joint,
                rounding: joint.rounding.expressed_in(&parent.inverse()),
                ..joint.clone()
            };
            self.parts(moved, self.written_mimic(joint))
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
            let [parent, child] = [joint.parent, joint.child].map(name);
            JointParts { joint: joint.clone(), parent, child, mimic: self.written_mimic(joint) }
        });
        self.rebuilt(links.collect(), parts.collect())
    }

    /// The same robot with one more link, fixed to one that it has.
    ///
    /// # Panics
    /// If there is no link called `parent`, or one of the new name already.
    #[must_use]
    pub fn with_fixed_link(&self, parent: &str, parent_from_link: Isometry3<f64>, link: Link) -> Self {
        let taken = self.joints().iter().map(|joint| joint.name.as_str()).collect();
        let name = free_name(&format!("{}_joint", link.name), &taken);
        let fixed = JointParts::new(&name, JointKind::Fixed, parent, &link.name, parent_from_link);
        let parts = self.joints().iter().map(|joint| self.parts(joint.clone(), self.written_mimic(joint)));
        self.rebuilt(self.links().iter().cloned().chain([link]).collect(), parts.chain([fixed]).collect())
    }

    /// What a joint follows, with its name.
    fn written_mimic(&self, joint: &Joint) -> Option<(String, f64, f64)> {
        joint.mimic.map(|of| (self.joint(of.master).name.clone(), of.multiplier, of.offset))
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
        moved.inertia_rounding = moved.inertia_rounding.expressed_in(&frame_from_link.rotation);
    }
    for shape in moved.visuals.iter_mut().chain(&mut moved.collisions) {
        shape.link_from_shape = frame_from_link * shape.link_from_shape;
    }
    moved
}
