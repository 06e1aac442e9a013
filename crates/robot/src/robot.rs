//! The robot: a checked tree of links and joints. Reading it from a file is `urdf/`.

use std::collections::BTreeSet;

use super::{
    error::RobotError,
    inertia::Inertia,
    joint::{Joint, JointIndex, JointKind, JointParts, Mimic},
    link::{Link, LinkIndex},
    positions::RobotQ,
    tree,
};

/// A robot: one tree of links, joined by joints, parents before children in both lists.
///
/// Configuration vectors (`q`, `qd`) hold one entry for each movable joint, mimic joints
/// included, in the order of [`Robot::movable_joints`].
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    name: String,
    links: Vec<Link>,
    joints: Vec<Joint>,
    parent_joints: Vec<Option<JointIndex>>,
    movable: Vec<JointIndex>,
    coordinates: Vec<Option<usize>>,
}

impl Robot {
    /// Builds the tree: names are resolved, links and joints sorted depth first in file order.
    ///
    /// # Errors
    /// [`RobotError`] if names repeat or are unknown, or if the joints form no tree.
    pub fn new(
        name: impl Into<String>,
        links: Vec<Link>,
        joints: Vec<JointParts>,
    ) -> Result<Self, RobotError> {
        let (links, joints) = tree::sorted(links, joints)?;
        Ok(Self::from_tree(name.into(), links, joints))
    }

    /// From a sorted tree.
    fn from_tree(name: String, links: Vec<Link>, joints: Vec<Joint>) -> Self {
        let mut parent_joints = vec![None; links.len()];
        let mut coordinates = vec![None; joints.len()];
        let mut movable = Vec::new();
        for (index, joint) in joints.iter().enumerate() {
            parent_joints[joint.child.0] = Some(JointIndex(index));
            if joint.kind.is_movable() {
                coordinates[index] = Some(movable.len());
                movable.push(JointIndex(index));
            }
        }
        Self { name, links, joints, parent_joints, movable, coordinates }
    }

    /// The same tree with its joints changed in what is not the tree: kind, parent and child stay.
    ///
    /// # Examples
    /// ```
    /// use congruent_description::parse_urdf;
    /// let robot = parse_urdf(
    ///     r#"<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous">
    ///       <parent link="a"/><child link="b"/><dynamics damping="0.1"/></joint></robot>"#,
    /// ).unwrap();
    /// let undamped = robot.with_joints(|joint| joint.damping = 0.0);
    /// assert_eq!((robot.joints()[0].damping, undamped.joints()[0].damping), (0.1, 0.0));
    /// ```
    #[must_use]
    pub fn with_joints(&self, mut change: impl FnMut(&mut Joint)) -> Self {
        let mut changed = self.clone();
        for (joint, before) in changed.joints.iter_mut().zip(&self.joints) {
            change(joint);
            (joint.kind, joint.parent, joint.child) = (before.kind, before.parent, before.child);
        }
        changed
    }

    /// The same tree with its links changed in what is not the tree: names stay.
    #[must_use]
    pub fn with_links(&self, mut change: impl FnMut(&mut Link)) -> Self {
        let mut changed = self.clone();
        for (link, before) in changed.links.iter_mut().zip(&self.links) {
            change(link);
            link.name.clone_from(&before.name);
        }
        changed
    }

    /// The same robot with another inertia of one link.
    ///
    /// # Panics
    /// If there is no such link.
    #[must_use]
    pub fn with_inertia(mut self, link: LinkIndex, inertia: Inertia) -> Self {
        self.links[link.0].inertia = Some(inertia);
        self
    }

    /// Name of the robot in its URDF.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All links, parents before children; the first is the root.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// All joints, parents before children.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The link without a joint above it.
    pub fn root(&self) -> LinkIndex {
        LinkIndex(0)
    }

    /// The link with this index.
    pub fn link(&self, index: LinkIndex) -> &Link {
        &self.links[index.0]
    }

    /// Replaces the inertia of a link.
    pub fn set_inertia(&mut self, link: LinkIndex, inertia: Inertia) {
        self.links[link.0].inertia = Some(inertia);
    }

    /// The joint with this index.
    pub fn joint(&self, index: JointIndex) -> &Joint {
        &self.joints[index.0]
    }

    /// Indices of all links, in order.
    pub fn link_indices(&self) -> impl ExactSizeIterator<Item = LinkIndex> + use<> {
        (0..self.links.len()).map(LinkIndex)
    }

    /// The link with this name.
    pub fn find_link(&self, name: &str) -> Option<LinkIndex> {
        self.links.iter().position(|link| link.name == name).map(LinkIndex)
    }

    /// What a tool centre point that is declared beside the links is called among them: `tcp`, or `declared_tcp` if a
    /// link is called `tcp`, which must not hide it.
    pub fn tcp_name(&self) -> &'static str {
        if self.find_link("tcp").is_none() { "tcp" } else { "declared_tcp" }
    }

    /// The joint with this name.
    pub fn find_joint(&self, name: &str) -> Option<JointIndex> {
        self.joints.iter().position(|joint| joint.name == name).map(JointIndex)
    }

    /// The joint that carries a link; `None` for the root.
    pub fn parent_joint(&self, link: LinkIndex) -> Option<JointIndex> {
        self.parent_joints[link.0]
    }

    /// The joints with a coordinate, in the order of configuration vectors.
    pub fn movable_joints(&self) -> &[JointIndex] {
        &self.movable
    }

    /// Names of the joints with a coordinate, in the order of configuration vectors.
    pub fn movable_joint_names(&self) -> impl ExactSizeIterator<Item = &str> + Clone {
        self.movable.iter().map(|&joint| self.joint(joint).name.as_str())
    }

    /// Length of a configuration vector: the number of movable joints, mimic joints included.
    pub fn dof(&self) -> usize {
        self.movable.len()
    }

    /// Index of a joint's position in a configuration vector; `None` for a fixed joint.
    pub fn coordinate(&self, joint: JointIndex) -> Option<usize> {
        self.coordinates[joint.0]
    }

    /// The joints that move link `tip` against link `base`, fixed ones between them included, from
    /// the first out of the body of `base`; `None` if `tip` is not a descendant of that body.
    ///
    /// `base` need not be above `tip` itself, as the link `base` of a Universal Robots arm is not: its body
    /// must be.
    pub fn chain(&self, base: LinkIndex, tip: LinkIndex) -> Option<Vec<JointIndex>> {
        let base_body = self.body(base);
        let mut joints = Vec::new();
        let mut link = tip;
        while self.body(link) != base_body {
            let joint = self.parent_joint(link)?;
            joints.push(joint);
            link = self.joint(joint).parent;
        }
        joints.reverse();
        Some(joints)
    }

    /// The link nearest to the root that `link` is rigidly attached to: links with the same
    /// answer move as one body.
    pub fn body(&self, mut link: LinkIndex) -> LinkIndex {
        while let Some(joint) = self.parent_joint(link) {
            let joint = self.joint(joint);
            if joint.kind != JointKind::Fixed {
                break;
            }
            link = joint.parent;
        }
        link
    }

    /// Names of the moving joints on which the pose of a link depends: those on its path from the root, and the masters of
    /// those that follow others, with the joints on their paths.
    pub fn joints_that_move(&self, link: LinkIndex) -> BTreeSet<&str> {
        let mut names = BTreeSet::new();
        let mut next = vec![link];
        while let Some(link) = next.pop() {
            let Some(index) = self.parent_joint(link) else { continue };
            let joint = self.joint(index);
            next.push(joint.parent);
            if joint.kind.is_movable() && names.insert(joint.name.as_str()) {
                next.extend(joint.mimic.map(|mimic| self.joint(mimic.master).child));
            }
        }
        names
    }

    /// The part of the tree that these joints move, with the links that do not move: links beyond other moving joints are
    /// left out.
    #[must_use]
    pub fn moved_by(&self, names: &BTreeSet<&str>) -> Self {
        let mut is_kept = vec![true; self.links.len()];
        let mut parts = Vec::new();
        for joint in &self.joints {
            let is_part = !joint.kind.is_movable() || names.contains(joint.name.as_str());
            is_kept[joint.child.0] = is_kept[joint.parent.0] && is_part;
            if is_kept[joint.child.0] {
                parts.push(joint);
            }
        }
        let kept = |of: JointIndex| is_kept[self.joint(of).child.0];
        let parts = parts.into_iter().map(|joint| JointParts {
            joint: joint.clone(),
            parent: self.link(joint.parent).name.clone(),
            child: self.link(joint.child).name.clone(),
            mimic: joint
                .mimic
                .filter(|mimic| kept(mimic.master))
                .map(|of| (self.joint(of.master).name.clone(), of.multiplier, of.offset)),
        });
        let links = self.links.iter().zip(&is_kept).filter(|(_, is_kept)| **is_kept);
        self.part(links.map(|(link, _)| link.clone()).collect(), parts.collect())
    }

    /// A part of the tree, from its root.
    fn part(&self, links: Vec<Link>, joints: Vec<JointParts>) -> Self {
        Self::new(self.name.clone(), links, joints).expect("a part of a tree from its root is a tree")
    }

    /// Overwrites the entries of mimic joints in `q` by what their masters imply.
    ///
    /// # Panics
    /// If `q` is not a configuration vector of this robot.
    pub fn apply_mimic(&self, q: &mut RobotQ) {
        self.follow_masters(q, |mimic| mimic.offset);
    }

    /// The same for speeds, which no offset changes.
    ///
    /// # Panics
    /// If `qd` is not a configuration vector of this robot.
    /// # Examples
    /// ```
    /// use congruent_description::{RobotQ, parse_urdf};
    /// let robot = parse_urdf(
    ///     r#"<robot name="gripper">
    ///         <link name="palm"/><link name="left"/><link name="right"/>
    ///         <joint name="a" type="continuous"><parent link="palm"/><child link="left"/></joint>
    ///         <joint name="b" type="continuous"><parent link="palm"/><child link="right"/>
    ///             <mimic joint="a" multiplier="-2" offset="0.5"/></joint>
    ///     </robot>"#,
    /// ).unwrap();
    /// let (mut q, mut qd) = (RobotQ::from([0.1, 9.0]), [0.1, 9.0]);
    /// robot.apply_mimic(&mut q);
    /// robot.apply_mimic_to_speeds(&mut qd);
    /// assert_eq!((&q[..], qd), (&[0.1, 0.3][..], [0.1, -0.2]));
    /// ```
    pub fn apply_mimic_to_speeds(&self, qd: &mut [f64]) {
        self.follow_masters(qd, |_| 0.0);
    }

    fn follow_masters(&self, vector: &mut [f64], constant: fn(&Mimic) -> f64) {
        assert_eq!(vector.len(), self.dof(), "one entry for each movable joint");
        // One pass is enough: chains of mimic joints were resolved when the robot was built, so no master is a mimic itself.
        for (coordinate, &joint) in self.movable.iter().enumerate() {
            if let Some(mimic) = &self.joint(joint).mimic {
                let master = self.coordinates[mimic.master.0].expect("a mimicked joint moves");
                vector[coordinate] = mimic.multiplier * vector[master] + constant(mimic);
            }
        }
    }
}
