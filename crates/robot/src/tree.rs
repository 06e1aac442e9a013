//! Builds a sorted tree from named parts; detects everything that keeps links and joints from forming one tree.

use std::collections::BTreeMap;

use congruent_input::units::LARGEST;

use super::{
    error::RobotError,
    joint::{Joint, JointIndex, JointParts, Mimic},
    link::{Link, LinkIndex},
};

/// Links and joints with names resolved, parents before children, depth first in file order.
pub(super) fn sorted(
    links: Vec<Link>,
    joints: Vec<JointParts>,
) -> Result<(Vec<Link>, Vec<Joint>), RobotError> {
    // In this order, since each step needs what the one before has excluded: names must be unique before they are resolved,
    // and each link must have one parent before roots and loops can be distinguished.
    let by_name = index_links(&links)?;
    refuse_repeated_joints(&joints)?;
    let ends = resolve_ends(&joints, &links, &by_name)?;
    let parent_joints = parents(&joints, &links, &ends)?;
    let root = single_root(&joints, &links, &ends, &parent_joints)?;
    let order = depth_first(root, links.len(), &ends);
    let mimics = resolve_mimics(&joints)?;
    Ok(assemble(links, joints, &Layout { ends, order, root, mimics }))
}

/// Parent and child of one joint, as indices in file order.
#[derive(Clone, Copy)]
struct Ends {
    parent: usize,
    child: usize,
}

/// What `assemble` needs to sort the parts; all indices are in file order.
struct Layout {
    ends: Vec<Ends>,
    order: Vec<usize>,
    root: usize,
    mimics: Vec<Option<ResolvedMimic>>,
}

/// A mimic joint's master, by its index in file order: `q = multiplier * q_master + offset`.
#[derive(Clone, Copy)]
struct ResolvedMimic {
    master: usize,
    multiplier: f64,
    offset: f64,
}

impl ResolvedMimic {
    /// This joint follows one that follows another: what the first has to do with the last.
    fn through(self, further: Self) -> Self {
        Self {
            master: further.master,
            multiplier: self.multiplier * further.multiplier,
            offset: self.multiplier * further.offset + self.offset,
        }
    }

    /// The value whose products with positions would lose all digits, or overflow.
    fn too_large(self) -> Option<(&'static str, f64)> {
        let values = [("multiplier", self.multiplier), ("offset", self.offset)];
        values.into_iter().find(|(_, value)| value.is_nan() || value.abs() > LARGEST)
    }
}

fn index_links(links: &[Link]) -> Result<BTreeMap<&str, usize>, RobotError> {
    let mut by_name = BTreeMap::new();
    for (index, link) in links.iter().enumerate() {
        if by_name.insert(link.name.as_str(), index).is_some() {
            return Err(RobotError::DuplicateLink { link: link.name.clone() });
        }
    }
    if links.is_empty() { Err(RobotError::NoLink) } else { Ok(by_name) }
}

fn refuse_repeated_joints(joints: &[JointParts]) -> Result<(), RobotError> {
    let mut names = std::collections::BTreeSet::new();
    match joints.iter().find(|parts| !names.insert(&parts.joint.name)) {
        Some(parts) => Err(RobotError::DuplicateJoint { joint: parts.joint.name.clone() }),
        None => Ok(()),
    }
}

fn resolve_ends(
    joints: &[JointParts],
    links: &[Link],
    by_name: &BTreeMap<&str, usize>,
) -> Result<Vec<Ends>, RobotError> {
    let find = |parts: &JointParts, role, name: &str| {
        by_name.get(name).copied().ok_or_else(|| RobotError::UnknownLink {
            joint: parts.joint.name.clone(),
            role,
            link: name.to_owned(),
            known: links.iter().map(|link| link.name.clone()).collect(),
        })
    };
    let resolve = |parts: &JointParts| {
        let ends = Ends {
            parent: find(parts, "parent", &parts.parent)?,
            child: find(parts, "child", &parts.child)?,
        };
        if ends.parent == ends.child {
            return Err(RobotError::SelfJoint {
                joint: parts.joint.name.clone(),
                link: parts.parent.clone(),
            });
        }
        Ok(ends)
    };
    joints.iter().map(resolve).collect()
}

/// The joint above each link. A second parent whose joint closes a loop is reported as the loop.
fn parents(joints: &[JointParts], links: &[Link], ends: &[Ends]) -> Result<Vec<Option<usize>>, RobotError> {
    let mut above: Vec<Option<usize>> = vec![None; links.len()];
    for (index, end) in ends.iter().enumerate() {
        if let Some(first) = above[end.child] {
            if let Some(path) = path_up(end.parent, end.child, ends, &above) {
                return Err(loop_error(&path, &joints[index], links));
            }
            return Err(RobotError::TwoParents {
                link: links[end.child].name.clone(),
                first: joints[first].joint.name.clone(),
                second: joints[index].joint.name.clone(),
            });
        }
        above[end.child] = Some(index);
    }
    Ok(above)
}

/// Links from `link` up to `ancestor`, both included, or `None` if `ancestor` is not above it.
fn path_up(link: usize, ancestor: usize, ends: &[Ends], above: &[Option<usize>]) -> Option<Vec<usize>> {
    let mut path = vec![link];
    let mut at = link;
    while at != ancestor {
        at = ends[above[at]?].parent;
        path.push(at);
        if path.len() > above.len() {
            return None; // a loop that `ancestor` is not part of
        }
    }
    Some(path)
}

fn loop_error(path_up: &[usize], closing: &JointParts, links: &[Link]) -> RobotError {
    let mut names: Vec<String> = path_up.iter().rev().map(|&link| links[link].name.clone()).collect();
    names.push(names[0].clone());
    RobotError::Loop { links: names, joint: closing.joint.name.clone() }
}

fn single_root(
    joints: &[JointParts],
    links: &[Link],
    ends: &[Ends],
    above: &[Option<usize>],
) -> Result<usize, RobotError> {
    let roots: Vec<usize> = (0..links.len()).filter(|&link| above[link].is_none()).collect();
    // Each link has at most one parent, so what no root reaches is a loop.
    if let Some(start) = unreached(&roots, links.len(), ends) {
        return Err(find_loop(start, joints, links, ends, above));
    }
    match roots[..] {
        [root] => Ok(root),
        _ => Err(RobotError::SeveralRoots {
            roots: roots.iter().map(|&root| links[root].name.clone()).collect(),
        }),
    }
}

fn unreached(roots: &[usize], links: usize, ends: &[Ends]) -> Option<usize> {
    let children = children(links, ends);
    let mut reached = vec![false; links];
    let mut open = roots.to_vec();
    while let Some(link) = open.pop() {
        reached[link] = true;
        open.extend(children[link].iter().map(|&joint| ends[joint].child));
    }
    reached.iter().position(|&reached| !reached)
}

fn find_loop(
    start: usize,
    joints: &[JointParts],
    links: &[Link],
    ends: &[Ends],
    above: &[Option<usize>],
) -> RobotError {
    let up = |link: usize| above[link].map_or(link, |joint| ends[joint].parent);
    // After as many steps as there are links the walk is inside the loop; the smallest index
    // in it makes the report independent of where it began.
    let inside = (0..links.len()).fold(start, |link, _| up(link));
    let mut path = vec![inside];
    while up(*path.last().expect("not empty")) != inside {
        path.push(up(*path.last().expect("not empty")));
    }
    let first = path.iter().enumerate().min_by_key(|(_, link)| **link).map_or(0, |(at, _)| at);
    let cut = (first + 1) % path.len();
    // To the end, since the names of a loop are written in reverse.
    path.rotate_left(cut);
    let closing = above[*path.last().expect("not empty")].expect("a link of a loop has a parent");
    loop_error(&path, &joints[closing], links)
}

/// Joints below each link, in file order.
fn children(links: usize, ends: &[Ends]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); links];
    for (joint, end) in ends.iter().enumerate() {
        children[end.parent].push(joint);
    }
    children
}

/// Joints depth first from the root, siblings in file order, without recursion.
fn depth_first(root: usize, links: usize, ends: &[Ends]) -> Vec<usize> {
    let children = children(links, ends);
    let mut order = Vec::with_capacity(ends.len());
    // Reversed: the last one on the stack is the first one taken.
    let mut open: Vec<usize> = children[root].iter().rev().copied().collect();
    while let Some(joint) = open.pop() {
        order.push(joint);
        open.extend(children[ends[joint].child].iter().rev());
    }
    order
}

/// What each joint follows, in file order, chains of mimics composed.
fn resolve_mimics(joints: &[JointParts]) -> Result<Vec<Option<ResolvedMimic>>, RobotError> {
    let by_name: BTreeMap<&str, usize> = joints
        .iter()
        .enumerate()
        .filter(|(_, parts)| parts.joint.kind.is_movable())
        .map(|(index, parts)| (parts.joint.name.as_str(), index))
        .collect();
    let unknown = |parts: &JointParts, target: &str| RobotError::UnknownMimic {
        joint: parts.joint.name.clone(),
        target: target.to_owned(),
        known: by_name.keys().map(|&name| name.to_owned()).collect(),
    };
    let mut direct = Vec::with_capacity(joints.len());
    for parts in joints {
        direct.push(match &parts.mimic {
            Some((target, multiplier, offset)) => {
                let master = *by_name.get(target.as_str()).ok_or_else(|| unknown(parts, target))?;
                Some(ResolvedMimic { master, multiplier: *multiplier, offset: *offset })
            }
            None => None,
        });
    }
    compose(&direct, joints)
}

/// Follows each chain of mimics to its end. A chain is walked once: its links are resolved from
/// the end back, so that ten thousand of them take no quadratic time.
fn compose(
    direct: &[Option<ResolvedMimic>],
    joints: &[JointParts],
) -> Result<Vec<Option<ResolvedMimic>>, RobotError> {
    let mut composed: Vec<Option<ResolvedMimic>> = vec![None; direct.len()];
    // On whose path a joint was met last: meeting it again there is a loop.
    let mut met_from = vec![None; direct.len()];
    for start in 0..direct.len() {
        let mut path = Vec::new();
        let mut at = start;
        while let (Some(next), None) = (direct[at], composed[at]) {
            if met_from[at] == Some(start) {
                let names = path
                    .iter()
                    .skip_while(|&&joint| joint != at)
                    .map(|&joint: &usize| joints[joint].joint.name.clone());
                return Err(RobotError::MimicLoop {
                    joint: joints[at].joint.name.clone(),
                    through: names.skip(1).collect(),
                });
            }
            met_from[at] = Some(start);
            path.push(at);
            at = next.master;
        }
        for &joint in path.iter().rev() {
            let Some(own) = direct[joint] else { continue };
            let resolved = composed[own.master].map(|further| own.through(further));
            if let Some((what, value)) = resolved.and_then(ResolvedMimic::too_large) {
                return Err(RobotError::MimicTooLarge {
                    joint: joints[joint].joint.name.clone(),
                    master: joints[own.master].joint.name.clone(),
                    what,
                    value,
                });
            }
            composed[joint] = Some(resolved.unwrap_or(own));
        }
    }
    Ok(composed)
}

fn assemble(mut links: Vec<Link>, joints: Vec<JointParts>, layout: &Layout) -> (Vec<Link>, Vec<Joint>) {
    let mut link_at = vec![0; links.len()];
    let mut sorted_links = vec![std::mem::take(&mut links[layout.root])];
    let mut joint_at = vec![0; joints.len()];
    for (position, &joint) in layout.order.iter().enumerate() {
        joint_at[joint] = position;
        let child = layout.ends[joint].child;
        link_at[child] = sorted_links.len();
        sorted_links.push(std::mem::take(&mut links[child]));
    }
    let mut parts: Vec<Option<JointParts>> = joints.into_iter().map(Some).collect();
    let sorted_joints = layout
        .order
        .iter()
        .map(|&index| Joint {
            parent: LinkIndex(link_at[layout.ends[index].parent]),
            child: LinkIndex(link_at[layout.ends[index].child]),
            mimic: layout.mimics[index].map(|follow| Mimic {
                master: JointIndex(joint_at[follow.master]),
                multiplier: follow.multiplier,
                offset: follow.offset,
            }),
            ..parts[index].take().expect("the order names each joint once").joint
        })
        .collect();
    (sorted_links, sorted_joints)
}
