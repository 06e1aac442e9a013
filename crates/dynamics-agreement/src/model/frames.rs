//! Poses of the links of a robot at zero, and other frames in which their parameters could have been given by mistake. Both
//! models of a comparison share them.

use congruent_description::{DhTable, JointIndex, LinkIndex, Robot, RobotQ};
use congruent_dynamics::BodyTree;
use congruent_input::SiUnit;
use congruent_kinematics::{DhChain, KinematicsError, Pose};

/// The geometry that both models of a comparison have in common.
#[derive(Debug, Clone)]
pub struct Frames {
    pub(crate) tree: BodyTree,
    pub(crate) links: Vec<LinkPlace>,
    pub(crate) joints: Vec<JointPlace>,
    pub(crate) others: Vec<OtherFrame>,
    pub(crate) reach_m: f64,
}

/// A link with its body and its pose at zero.
#[derive(Debug, Clone)]
pub(crate) struct LinkPlace {
    pub(crate) name: String,
    /// The moving joint that carries it; `None` if it is fixed to the root.
    pub(crate) body: Option<usize>,
    /// Pose in the frame of the link that its body is named by.
    pub(crate) body_from_link: Pose,
    /// Pose in the root link, joints at zero.
    pub(crate) root_from_link: Pose,
    /// Whether the link has a visual or collision shape, so that it should have mass.
    pub(crate) has_shape: bool,
}

/// A moving joint with its parent, range and mimic relation.
#[derive(Debug, Clone)]
pub(crate) struct JointPlace {
    pub(crate) name: String,
    /// The nearest moving joint towards the root; `None` if there is none.
    pub(crate) parent: Option<usize>,
    pub(crate) is_angular: bool,
    /// The range of positions: one turn if it has no limits; for mimic joints and their masters the range that both allow.
    pub(crate) range: (f64, f64),
    /// Master, ratio and offset of a mimic joint.
    pub(crate) follows: Option<(usize, f64, f64)>,
    /// Index of the link that it carries.
    pub(crate) link: usize,
}

impl JointPlace {
    /// Unit of its torque or force.
    pub(crate) fn effort_unit(&self) -> SiUnit {
        if self.is_angular { SiUnit::NewtonMetre } else { SiUnit::Newton }
    }
}

/// A frame other than the link's own in which the parameters of a link could have been given by mistake.
#[derive(Debug, Clone)]
pub(crate) struct OtherFrame {
    /// Name of the frame, as in `root` or `parent`.
    pub(crate) name: String,
    /// For each link the name that the frame has there, if it is another one.
    pub(crate) names_at_links: Vec<Option<String>>,
    /// Its pose in each link, joints at zero; `None` for links that do not have it.
    pub(crate) link_from_frame: Vec<Option<Pose>>,
}

/// Name of a link's own frame among the others, used if its parameters are given in another frame.
pub(super) const LINK_FRAME: &str = "link";

impl OtherFrame {
    fn new(name: &str, link_from_frame: Vec<Option<Pose>>) -> Self {
        let names_at_links = vec![None; link_from_frame.len()];
        Self { name: name.to_owned(), names_at_links, link_from_frame }
    }

    /// Whether it is the link's own frame, which is among the others only if the parameters are given in another frame.
    pub(crate) fn is_links_own_at(&self, link: usize) -> bool {
        let turns = |own: &Pose| own.rotation != nalgebra::Matrix3::identity();
        self.name == LINK_FRAME && self.link_from_frame[link].as_ref().is_some_and(turns)
    }
}

impl Frames {
    /// The frames of a robot.
    pub fn new(robot: &Robot) -> Self {
        // Resistances are added by each model; mimic joints stay independent, since torques are compared joint by
        // joint.
        let tree = BodyTree::new(robot).without_resistances().with_independent_mimics();
        let mut links: Vec<LinkPlace> = Vec::with_capacity(robot.links().len());
        let mut reach_m = vec![0.0; robot.links().len()];
        for index in robot.link_indices() {
            let link = robot.link(index);
            let (mut body, mut body_from_link, mut root_from_link) =
                (None, Pose::identity(), Pose::identity());
            if let Some(joint) = robot.parent_joint(index) {
                let coordinate = robot.coordinate(joint);
                let joint = robot.joint(joint);
                let parent = joint.parent.get();
                let parent_from_joint = Pose::from(joint.parent_from_joint);
                root_from_link = links[parent].root_from_link * parent_from_joint;
                // Only a sliding joint lengthens the arm; a turning one moves the link on a circle of the offset
                // that is counted already.
                let stroke = joint.position_range().filter(|_| !joint.kind.is_angular());
                reach_m[index.get()] = reach_m[parent]
                    + parent_from_joint.translation.norm()
                    + stroke.map_or(0.0, |(lower, upper)| lower.abs().max(upper.abs()));
                if coordinate.is_some() {
                    body = coordinate;
                } else {
                    body = links[parent].body;
                    // A fixed joint extends the body of its parent, at a constant pose.
                    body_from_link = links[parent].body_from_link * parent_from_joint;
                }
            }
            let has_shape = !(link.visuals.is_empty() && link.collisions.is_empty());
            let name = link.name.clone();
            links.push(LinkPlace { name, body, body_from_link, root_from_link, has_shape });
        }
        let mut joints: Vec<JointPlace> =
            robot.movable_joints().iter().map(|&joint| joint_place(robot, joint, &links)).collect();
        // After all joints are known, since a follower may come before its master in the file.
        keep_within_followers(&mut joints);
        let others = others(robot, &links);
        Self { tree, links, joints, others, reach_m: reach_m.into_iter().fold(0.0, f64::max) }
    }

    /// With one more frame that parameters could have been given in, such as a DH frame: one for each link that has it.
    ///
    /// # Panics
    /// If there is not one entry for each link of the robot.
    #[must_use]
    pub fn with_other_frame(mut self, name: &str, link_from_frame: Vec<Option<Pose>>) -> Self {
        assert_eq!(link_from_frame.len(), self.links.len(), "one for each link");
        self.others.push(OtherFrame::new(name, link_from_frame));
        self
    }

    /// With the frames of a table of the same robot, in which vendors publish parameters: frame `dhk` at each link that the
    /// joint of row `k` carries.
    ///
    /// # Errors
    /// [`KinematicsError`] if the table is another robot's.
    pub fn with_dh_frames(
        mut self,
        table: &DhTable,
        robot: &Robot,
        base: LinkIndex,
    ) -> Result<Self, KinematicsError> {
        let chain = DhChain::new(table, robot);
        let mut base_from_dh = vec![Pose::identity(); chain.joint_count() + 1];
        chain.dh_frames_into(&RobotQ::zeros(robot.dof()), &mut base_from_dh)?;
        let root_from_base = *self.root_from_link(base.get());
        let row_of = |place: &LinkPlace| {
            let body = place.body?;
            chain.coordinates().iter().position(|coordinate| *coordinate == body)
        };
        let link_from = |place: &LinkPlace| {
            let root_from_dh = root_from_base * base_from_dh[row_of(place)? + 1];
            Some(place.root_from_link.inverse() * root_from_dh)
        };
        let name = |place: &LinkPlace| row_of(place).map(|row| format!("dh{}", row + 1));
        let frame = OtherFrame {
            name: "dh".to_owned(),
            names_at_links: self.links.iter().map(name).collect(),
            link_from_frame: self.links.iter().map(link_from).collect(),
        };
        self.others.push(frame);
        Ok(self)
    }

    /// Pose of the DH frame of a link in the link; `None` if the link has none.
    pub fn dh_frame(&self, link: &str) -> Option<Pose> {
        let link = self.find_link(link)?;
        let mut numbered = self.others.iter().filter(|other| other.names_at_links[link].is_some());
        numbered.find_map(|other| other.link_from_frame[link])
    }

    /// Upper bound of the distance of any link from the root, m: all offsets and strokes added up.
    pub fn reach_m(&self) -> f64 {
        self.reach_m
    }

    /// Number of moving joints.
    pub fn dof(&self) -> usize {
        self.joints.len()
    }

    /// Index of the link with this name.
    pub fn find_link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// Index of the moving joint with this name.
    pub fn find_joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Name of the link with this index.
    ///
    /// # Panics
    /// If there is no such link.
    pub fn link_name(&self, link: usize) -> &str {
        &self.links[link].name
    }

    /// Name of the moving joint with this index.
    ///
    /// # Panics
    /// If there is no such joint.
    pub fn joint_name(&self, joint: usize) -> &str {
        &self.joints[joint].name
    }

    /// Pose of a link in the root, joints at zero.
    pub(crate) fn root_from_link(&self, link: usize) -> &Pose {
        &self.links[link].root_from_link
    }

    /// Indices of the links that move with a body.
    pub(crate) fn links_of(&self, body: usize) -> impl Iterator<Item = usize> {
        (0..self.links.len()).filter(move |&link| self.links[link].body == Some(body))
    }

    /// Whether a link moves and no joint moves against its body.
    pub(crate) fn is_at_tip(&self, link: usize) -> bool {
        let body = self.links[link].body;
        body.is_some() && self.joints.iter().all(|joint| joint.parent != body)
    }

    /// The joints from one up to the root, itself first.
    pub(crate) fn ancestors(&self, joint: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(joint), |&joint| self.joints[joint].parent)
    }
}

fn joint_place(robot: &Robot, index: JointIndex, links: &[LinkPlace]) -> JointPlace {
    let joint = robot.joint(index);
    JointPlace {
        name: joint.name.clone(),
        parent: links[joint.parent.get()].body,
        is_angular: joint.kind.is_angular(),
        range: congruent_kinematics::range(joint),
        follows: joint
            .mimic
            .and_then(|mimic| Some((robot.coordinate(mimic.master)?, mimic.multiplier, mimic.offset))),
        link: joint.child.get(),
    }
}

/// Cuts the ranges of masters so that their followers stay within limits, and sets the ranges of followers from them.
fn keep_within_followers(joints: &mut [JointPlace]) {
    let image = |(lower, upper): (f64, f64), of: &dyn Fn(f64) -> f64| {
        let [a, b] = [of(lower), of(upper)];
        (a.min(b), a.max(b))
    };
    for at in 0..joints.len() {
        // A ratio of 0 holds the follower at its offset, and restricts nothing.
        let Some((master, ratio, offset)) = joints[at].follows.filter(|(_, ratio, _)| *ratio != 0.0) else {
            continue;
        };
        let (lower, upper) = image(joints[at].range, &|q| (q - offset) / ratio);
        let range = (joints[master].range.0.max(lower), joints[master].range.1.min(upper));
        // Contradictory limits of master and follower would give an empty range, in which nothing can be sampled.
        if range.0 <= range.1 {
            joints[master].range = range;
        }
    }
    for at in 0..joints.len() {
        if let Some((master, ratio, offset)) = joints[at].follows {
            joints[at].range = image(joints[master].range, &|q| ratio * q + offset);
        }
    }
}

/// The frames of the root and of the parent, children and visuals of every link.
fn others(robot: &Robot, links: &[LinkPlace]) -> Vec<OtherFrame> {
    let link_from =
        |link: usize, root_from_frame: &Pose| links[link].root_from_link.inverse() * *root_from_frame;
    let frame = |name: &str, each: &dyn Fn(usize) -> Option<Pose>| {
        OtherFrame::new(name, (0..links.len()).map(each).collect())
    };
    let parent = |link: usize| robot.joints().iter().find(|joint| joint.child.get() == link);
    let child = |link: usize, which: usize| {
        robot.joints().iter().filter(|joint| joint.parent.get() == link).nth(which)
    };
    let visual = |link: usize, which: usize| robot.links()[link].visuals.get(which);
    let mut frames = vec![
        frame("root", &|link| Some(link_from(link, &Pose::identity()))),
        frame("parent", &|link| Some(link_from(link, &links[parent(link)?.parent.get()].root_from_link))),
    ];
    for which in 0..FRAMES_OF_A_KIND {
        frames.push(frame("child", &|link| {
            Some(link_from(link, &links[child(link, which)?.child.get()].root_from_link))
        }));
        frames.push(frame("visual", &|link| Some(visual(link, which)?.link_from_shape.into())));
    }
    // Frames that no link has would only add hypotheses that never apply.
    frames.retain(|frame| frame.link_from_frame.iter().any(Option::is_some));
    frames
}

/// Most children and visuals of a link that are tried. Kind: choice; a hand has two fingers.
const FRAMES_OF_A_KIND: usize = 3;
