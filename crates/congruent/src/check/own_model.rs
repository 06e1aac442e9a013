//! A description without a URDF, a table or screws, against another one: its links are called and placed as there, and a cause
//! is named in the lines of its table.

use std::{collections::BTreeSet, sync::Arc};

use congruent_agreement::{
    SourcePair,
    compare::{CheckError, CheckOptions, CheckReport},
};
use congruent_description::{
    ChainEnd, DhRow, DhTable, Joint, JointIndex, JointKind, JointParts, JointRounding, Link, LinkIndex,
    Places, RequestedTolerance, Robot, RobotDescription, Tolerance,
};
use congruent_input::{Diagnostic, Findings};
use congruent_kinematics::{Pose, PoseError, ScrewTree, Twist};
use congruent_mapping::free_frame;
use nalgebra::{Isometry3, Unit, Vector3};

use super::{own_screws::replace_diagnosis, poses_of_other::matched_robots};

/// Why a model on its own is not compared with anything.
pub(super) const ONE_MODEL: &str =
    "there is one description, which is the robot: --against gives a second one";

/// The description as its links and joints alone describe it: a table that is the robot is no second source.
pub(super) fn without_own_table(description: &RobotDescription) -> RobotDescription {
    let places = Places { robot_file: None, ..description.places.clone() };
    RobotDescription { dh: None, places, ..description.clone() }
}

/// A model on its own with the links of another description: neither a table nor screws say where the frames of links lie, so
/// each gets the frame that its joint's link has there, moved to the nearest point of its own axis. Base and tip are the ends of
/// the chain there, or the links of their names. `None` if it is no model on its own.
///
/// Joints move as the model says: only frames are chosen.
pub(super) fn placed_as_in(own: &RobotDescription, other: &RobotDescription) -> Option<RobotDescription> {
    own.own_model()?;
    let screws = [&own.robot, &other.robot].map(ScrewTree::new);
    let end = |link, end: ChainEnd, there| {
        let name = &own.robot.link(link).name;
        (end != ChainEnd::Chosen).then(|| other.robot.find_link(name)).flatten().unwrap_or(there)
    };
    let base = end(own.base, own.chain_ends.base, other.base);
    let tip = end(own.tip, own.chain_ends.tip, other.tip);
    let root_from_own_root = *screws[1].home(base) * screws[0].home(own.base).inverse();
    let twists = own.robot.movable_joints().iter().map(|&joint| {
        let twist = screws[0].screw(joint)?.twist().transformed_by(&root_from_own_root);
        Some((own.robot.joint(joint), twist))
    });
    let twists: Vec<(&Joint, Twist)> = twists.collect::<Option<_>>()?;
    let root_from_tip = root_from_own_root * *screws[0].home(own.tip);
    let mut tree = PlacedTree::new(&other.robot, base, tip, &screws[1]);
    tree.moved = moved_behind(&twists, &root_from_tip, tip, &other.robot, &screws[1]);
    let in_root = |joint: &Joint| {
        let root_from_parent = root_from_own_root * *screws[0].home(joint.parent);
        let rounding = joint.rounding.expressed_in(&root_from_parent.to_isometry());
        Joint { rounding, ..joint.clone() }
    };
    for (joint, twist) in &twists {
        tree.add(&in_root(joint), twist, &screws[1]);
    }
    let tip_name = other.robot.link(tip).name.clone();
    let to_tip = own.robot.parent_joint(own.tip).map(|joint| own.robot.joint(joint));
    let to_tip = to_tip.filter(|joint| joint.kind == JointKind::Fixed);
    let rounding = to_tip.map(|joint| in_root(joint).rounding).unwrap_or_default();
    let robot = tree.finish(own.robot.name(), &tip_name, root_from_tip, rounding)?;
    let base = robot.find_link(&other.robot.link(base).name)?;
    let tip = robot.find_link(&tip_name)?;
    Some(RobotDescription { base, tip, robot, ..without_own_table(own) })
}

/// The tree of a model on its own while it grows along its chain.
struct PlacedTree<'a> {
    other: &'a Robot,
    links: Vec<Link>,
    parts: Vec<JointParts>,
    /// Names that a link of a joint must not have.
    taken: BTreeSet<String>,
    parent: String,
    root_from_parent: Pose,
    /// How far the last frame was moved onto its own axis, in the root at zero, m.
    moved_m: Vector3<f64>,
    /// The joint from which on all is where the other has it, moved by a motion in the root at zero.
    moved: Option<(String, Pose)>,
    /// That motion, from that joint on.
    root_from_unmoved: Pose,
}

/// Twists that differ by less are those of one axis, in rad and m. Kind: choice; frames alone are chosen by it.
const SAME_TWIST: f64 = 1e-6;

/// If all joints from one on, and the tip, are those of the other description moved by one motion: the name of the first, and the
/// motion. A wrong origin does that, and frames that are moved with it show it as one difference. All in the root at zero.
fn moved_behind(
    twists: &[(&Joint, Twist)],
    root_from_tip: &Pose,
    tip: LinkIndex,
    other: &Robot,
    there: &ScrewTree,
) -> Option<(String, Pose)> {
    let motion = *root_from_tip * there.home(tip).inverse();
    let is_moved_by = |(joint, twist): &(&Joint, Twist), by: &Pose| {
        let same = other.find_joint(&joint.name).and_then(|joint| there.screw(joint));
        same.is_some_and(|same| {
            let same = same.twist().transformed_by(by);
            (twist.angular - same.angular).norm().max((twist.linear - same.linear).norm()) < SAME_TWIST
        })
    };
    let first = twists.iter().position(|of| !is_moved_by(of, &Pose::identity()))?;
    let is_all = twists[first..].iter().all(|of| is_moved_by(of, &motion));
    // A motion of the joint before is another zero of it, which is found by the axes as they are.
    let turn = Twist::log(&motion);
    let is_zero = first.checked_sub(1).is_some_and(|before| {
        let own = &twists[before].1;
        let by = own.angular.dot(&turn.angular) + own.linear.dot(&turn.linear);
        let by = by / (own.angular.norm_squared() + own.linear.norm_squared());
        (turn.angular - own.angular * by).norm().max((turn.linear - own.linear * by).norm()) < SAME_TWIST
    });
    (is_all && !is_zero).then(|| (twists[first].0.name.clone(), motion))
}

impl<'a> PlacedTree<'a> {
    fn new(other: &'a Robot, base: LinkIndex, tip: LinkIndex, there: &ScrewTree) -> Self {
        let [root, base_name, tip] = [other.root(), base, tip].map(|link| other.link(link).name.clone());
        let mut tree = Self {
            other,
            links: vec![named(&root)],
            parts: Vec::new(),
            taken: [root.clone(), base_name.clone(), tip].into(),
            parent: root,
            root_from_parent: Pose::identity(),
            moved_m: Vector3::zeros(),
            moved: None,
            root_from_unmoved: Pose::identity(),
        };
        if base != other.root() {
            let name = format!("{}_to_{base_name}", tree.parent);
            tree.put(&fixed(&name), base_name, *there.home(base));
        }
        tree
    }

    /// Adds a joint that moves by `twist`, and whose digits leave open what its rounding says, both in the root at zero.
    fn add(&mut self, joint: &Joint, twist: &Twist, there: &ScrewTree) {
        let same = self.other.find_joint(&joint.name).map(|same| self.other.joint(same).child);
        if let Some((_, motion)) = self.moved.take_if(|moved| moved.0 == joint.name) {
            self.root_from_unmoved = motion;
        }
        let frame = same.map_or(self.root_from_parent, |link| self.root_from_unmoved * *there.home(link));
        let direction = if joint.kind.is_angular() { twist.angular } else { twist.linear };
        let axis = Unit::new_normalize(direction);
        let at = if joint.kind.is_angular() {
            let on_axis = axis.cross(&twist.linear);
            on_axis + axis.into_inner() * (frame.translation - on_axis).dot(&axis)
        } else {
            // Where the axis of a sliding joint lies the model does not say: as far from the link before it as there.
            frame.translation + self.moved_m
        };
        if same.is_some() {
            self.moved_m = at - frame.translation;
        }
        let wanted = same.map(|link| self.other.link(link).name.clone());
        let name = wanted
            .filter(|name| !self.taken.contains(name))
            .unwrap_or_else(|| format!("{}_link", joint.name));
        let name = if self.taken.contains(&name) { format!("{}_frame", joint.name) } else { name };
        let axis_in_joint: Vector3<f64> = frame.rotation.transpose() * axis.into_inner();
        let mut moved = Joint { axis_in_joint: Unit::new_normalize(axis_in_joint), ..joint.clone() };
        // Its digits say nothing of a frame that was chosen here.
        moved.rounding.frame = free_frame(&at);
        self.put(&moved, name, Pose { translation: at, ..frame });
    }

    fn put(&mut self, joint: &Joint, child: String, root_from_child: Pose) {
        let parent_from_root = self.root_from_parent.inverse();
        let parent_from_joint = (parent_from_root * root_from_child).to_isometry();
        let rounding = joint.rounding.expressed_in(&parent_from_root.to_isometry());
        self.links.push(named(&child));
        self.taken.insert(child.clone());
        self.parts.push(JointParts {
            joint: Joint { parent_from_joint, mimic: None, rounding, ..joint.clone() },
            parent: std::mem::replace(&mut self.parent, child.clone()),
            child,
            mimic: None,
        });
        self.root_from_parent = root_from_child;
    }

    /// The robot with its tip, and with what its digits leave open, in the root at zero.
    fn finish(
        mut self,
        name: &str,
        tip: &str,
        root_from_tip: Pose,
        rounding: JointRounding,
    ) -> Option<Robot> {
        let joint = fixed(&format!("{}_to_{tip}", self.parent));
        self.put(&Joint { rounding, ..joint }, tip.to_owned(), root_from_tip);
        Robot::new(name, self.links, self.parts).ok()
    }
}

fn fixed(name: &str) -> Joint {
    JointParts::new(name, JointKind::Fixed, "", "", Isometry3::identity()).joint
}

fn named(name: &str) -> Link {
    Link { name: name.to_owned(), ..Link::default() }
}

/// The check of a table against the links and joints beside it, at no requested configuration, without the physics: built from these
/// links, it says nothing about the table.
pub(super) fn table_against_links(
    description: &RobotDescription,
    options: &CheckOptions,
) -> Result<CheckReport, CheckError> {
    let no_physics = Findings::from(Diagnostic::warning(crate::codes::check::NO_SECOND_SOURCE, ONE_MODEL));
    let options = CheckOptions { configurations: Arc::default(), ..options.clone() };
    congruent_agreement::compare::check(description, Err(no_physics), &options)
}

/// Replaces the diagnosis of a difference by one in the lines of a table that is the robot of one of the two, if the table has
/// a cause: that of the first before that of the second. `compared` are the two in the same variables. Whether it has one.
pub(super) fn diagnose_by_table(
    geometry: &mut CheckReport,
    written: [&RobotDescription; 2],
    compared: [&RobotDescription; 2],
    options: &CheckOptions,
) -> Result<bool, CheckError> {
    if !geometry.poses_disagree() {
        return Ok(false);
    }
    for of in [0, 1] {
        let Some(mut with_table) = with_table_of(written[of], compared[of], compared[1 - of]) else {
            continue;
        };
        if written[1 - of].places.urdf.is_none() {
            allow_digits(&mut with_table, [compared[of], compared[1 - of]]);
        }
        let found = table_against_links(&with_table, options)?;
        let pair = SourcePair::UrdfOther;
        let mut of_table = found.diagnoses.into_iter();
        let named = of_table.find(|of| of.name == SourcePair::ModelUrdf && !of.causes.is_empty());
        if let Some(mut diagnosis) = named {
            (diagnosis.name, diagnosis.title) = (pair, pair.title());
            replace_diagnosis(geometry, diagnosis);
            return Ok(true);
        }
    }
    Ok(false)
}

/// Digits of rows count beside those of a URDF. What other files leave open is tolerated, so that their rounding is no cause.
fn allow_digits(with_table: &mut RobotDescription, [own, other]: [&RobotDescription; 2]) {
    let Some(matched) = matched_robots([&own.robot, &other.robot]) else { return };
    let PoseError { position_m, orientation_rad } = matched.open_by_digits();
    let tolerance = with_table.tolerance;
    let open = Tolerance {
        position_m: tolerance.position_m.max(position_m),
        orientation_rad: tolerance.orientation_rad.max(orientation_rad),
    };
    if open != tolerance {
        with_table.declared_tolerance = RequestedTolerance::both(open);
        with_table.tolerance = open;
    }
}

/// The other description with the table of a model on its own, as a robot file with both would declare it; `None` if `written` is
/// no table, or if the chains have other joints.
fn with_table_of(
    written: &RobotDescription,
    placed: &RobotDescription,
    other: &RobotDescription,
) -> Option<RobotDescription> {
    written.own_model()?;
    let table = written.dh.as_ref()?;
    let link = |of| other.robot.find_link(&placed.robot.link(of).name);
    let (base, tip) = (link(placed.base)?, link(placed.tip)?);
    let is_in_chain = |joint: &JointIndex| other.robot.joint(*joint).kind.is_movable();
    let chain: Vec<JointIndex> = other.robot.chain(base, tip)?.into_iter().filter(is_in_chain).collect();
    let row = |row: &DhRow| {
        let joint = other.robot.find_joint(&written.robot.joint(row.joint).name)?;
        chain.contains(&joint).then_some(DhRow { joint, ..*row })
    };
    let rows: Vec<DhRow> = table.rows.iter().map(row).collect::<Option<_>>()?;
    if rows.len() != chain.len() {
        return None;
    }
    Some(RobotDescription {
        path: written.path.clone(),
        base,
        tip,
        dh: Some(DhTable { rows, ..table.clone() }),
        dynamics: None,
        tip_from_tcp: written.tip_from_tcp,
        tolerance: placed.tolerance,
        declared_tolerance: placed.declared_tolerance,
        warnings: Vec::new(),
        places: Places { robot_file: written.places.robot_file.clone(), ..other.places.clone() },
        ..other.clone()
    })
}
