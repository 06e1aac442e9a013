//! The certificate of a robot: how far its declared table and its URDF chain can be apart at link
//! `tip`, over the whole joint range, sampled or not.

use congruent_description::{Mimic, Robot, RobotDescription};
use congruent_kinematics::{
    Bracket, Budget, DhChain, KinematicsError, Pose, ScrewChain, Twist, UrdfTree, certify_driven,
};
use serde::Serialize;

use crate::{configurations::range, sample::LinkError, verdict::NamedValue};

/// How far a probed chain may be from what it was probed from, for each metre of its screws'
/// moments and of its home pose (and as an angle). Kind: rounding; a logarithm over half a unit and
/// three products for each joint, some 20 eps; worst seen 6 eps.
const PROBE_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// No configuration is further apart than this.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// Distance of the origins of link `tip`.
    pub position_m: f64,
    /// Angle between the orientations of link `tip`.
    pub orientation_rad: f64,
}

/// One worst disagreement, bracketed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedBracket {
    /// The disagreement at `at`; m or rad.
    pub attained: f64,
    /// The bound; m or rad.
    pub certified: f64,
    /// A configuration that attains it: the joints that move the tip, rad or m.
    #[serde(serialize_with = "crate::check::as_map")]
    pub at: Vec<NamedValue>,
}

/// Both brackets of one robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Brackets {
    /// Of the position, m.
    pub position_m: ReportedBracket,
    /// Of the orientation, rad.
    pub orientation_rad: ReportedBracket,
}

impl Brackets {
    /// The bounds alone.
    pub fn bounds(&self) -> Bounds {
        Bounds { position_m: self.position_m.certified, orientation_rad: self.orientation_rad.certified }
    }
}

/// Brackets the disagreement of table and URDF at link `tip`, seen from link `base`; `None` where no
/// table is declared, or a joint has no end.
///
/// # Errors
/// [`KinematicsError`] when table and robot do not fit together.
pub fn certificate(description: &RobotDescription) -> Result<Option<Brackets>, KinematicsError> {
    let (Some(table), robot) = (&description.dh, &description.robot) else { return Ok(None) };
    let by_table = DhChain::new(table, robot);
    let Some(joints) = robot.chain(description.base, description.tip) else { return Ok(None) };
    let by_urdf: Vec<usize> = joints.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
    let pair = Pair::new(description, &by_table, &by_urdf)?;
    let ranges: Vec<(f64, f64)> =
        robot.movable_joints().iter().map(|&joint| range(robot.joint(joint))).collect();
    if pair.drivers.iter().any(|&driver| !(ranges[driver].0.is_finite() && ranges[driver].1.is_finite())) {
        return Ok(None);
    }
    // Positions that drive nothing may have any range.
    let ranges: Vec<(f64, f64)> = ranges
        .iter()
        .enumerate()
        .map(|(index, range)| if pair.drivers.contains(&index) { *range } else { (0.0, 0.0) })
        .collect();
    let found = certify_driven((&pair.table, &pair.urdf), &pair.drivers, &ranges, Budget::default())?;
    let tree = UrdfTree::new(robot);
    let rounding = pair.rounding();
    let report = |bracket: Bracket, measure: fn(LinkError) -> f64| -> Result<_, KinematicsError> {
        let mut q = bracket.at;
        robot.apply_mimic(&mut q);
        let root_from = |link| tree.root_from_link(&q, link);
        let base_from_tip = root_from(description.base)?.inverse() * root_from(description.tip)?;
        let certified = bracket.certified + rounding;
        let attained = measure(LinkError::of(&by_table.base_from_tip(&q)?, &base_from_tip)).min(certified);
        let name = |index: usize| robot.joint(robot.movable_joints()[index]).name.clone();
        let driving = q.iter().enumerate().filter(|(index, _)| pair.drivers.contains(index));
        let at = driving.map(|(index, &value)| NamedValue { joint: name(index), value }).collect();
        Ok(ReportedBracket { attained, certified, at })
    };
    Ok(Some(Brackets {
        position_m: report(found.position_m, |error| error.position_m)?,
        orientation_rad: report(found.orientation_rad, |error| error.orientation_rad)?,
    }))
}

/// Table and URDF with the same joints in the same order: what one of them lacks does not move in it.
#[derive(Debug, Clone)]
struct Pair {
    table: ScrewChain,
    urdf: ScrewChain,
    /// For each joint the entry of the configuration vector that moves it, a mimicked joint's own.
    drivers: Vec<usize>,
}

/// A joint of the pair, and which of the two have it.
#[derive(Debug, Clone, Copy)]
struct Place {
    coordinate: usize,
    in_table: bool,
    in_urdf: bool,
}

impl Pair {
    fn new(
        description: &RobotDescription,
        by_table: &DhChain,
        by_urdf: &[usize],
    ) -> Result<Self, KinematicsError> {
        let robot = &description.robot;
        let places = common_order(by_table.coordinates(), by_urdf);
        let table = ScrewChain::from_dh(by_table, robot.dof())?;
        let urdf = ScrewChain::from_urdf(robot, (description.base, description.tip), by_urdf)?;
        let ties: Vec<Tie> = places.iter().map(|place| Tie::of(robot, place.coordinate)).collect();
        let spread = |chain: &ScrewChain, has: fn(&Place) -> bool| tied(&ties, chain, places.iter().map(has));
        Ok(Self {
            table: spread(&table, |place| place.in_table),
            urdf: spread(&urdf, |place| place.in_urdf),
            drivers: ties.iter().map(|tie| tie.driver).collect(),
        })
    }

    /// How far the probed chains may be from what they stand for, together.
    fn rounding(&self) -> f64 {
        let size = |chain: &ScrewChain| {
            let moments = chain.twists_in_base.iter().map(|twist| 1.0 + twist.linear.norm());
            moments.sum::<f64>() + 1.0 + chain.base_from_tip_at_zero.translation.norm()
        };
        PROBE_ROUNDING * (size(&self.table) + size(&self.urdf))
    }
}

/// The joints of both, base to tip: those of the URDF, and between them those of the table that the
/// URDF lacks or has in another place.
fn common_order(table: &[usize], urdf: &[usize]) -> Vec<Place> {
    let in_urdf = |&coordinate: &usize| Place { coordinate, in_table: false, in_urdf: true };
    let mut places: Vec<Place> = urdf.iter().map(in_urdf).collect();
    let mut next = 0;
    for &coordinate in table {
        match places[next..].iter().position(|place| place.coordinate == coordinate) {
            Some(ahead) => next += ahead,
            None => places.insert(next, Place { coordinate, in_table: false, in_urdf: false }),
        }
        places[next].in_table = true;
        next += 1;
    }
    places
}

/// What moves a joint: `multiplier * q[driver] + offset`.
#[derive(Debug, Clone, Copy)]
struct Tie {
    driver: usize,
    multiplier: f64,
    offset: f64,
}

impl Tie {
    fn of(robot: &Robot, coordinate: usize) -> Self {
        let mimic = robot.joint(robot.movable_joints()[coordinate]).mimic;
        let tied = |Mimic { master, multiplier, offset }| {
            Some(Self { driver: robot.coordinate(master)?, multiplier, offset })
        };
        mimic.and_then(tied).unwrap_or(Self { driver: coordinate, multiplier: 1.0, offset: 0.0 })
    }
}

/// The chain in terms of its drivers, with a joint that does not move for each that it lacks: an
/// offset `o` turns `exp(S (m q + o))` into `exp(m S q) exp(S o)`, and what follows is moved by the latter.
fn tied(ties: &[Tie], chain: &ScrewChain, has: impl Iterator<Item = bool>) -> ScrewChain {
    let still = Twist { angular: nalgebra::Vector3::zeros(), linear: nalgebra::Vector3::zeros() };
    let mut twists = chain.twists_in_base.iter();
    let mut moved = Pose::identity();
    let mut twists_in_base = Vec::with_capacity(ties.len());
    for (tie, has) in ties.iter().zip(has) {
        let twist = if has { *twists.next().expect("a place for each joint") } else { still };
        let twist = twist.seen_from(&moved);
        moved = twist.exp(tie.offset) * moved;
        let Twist { angular, linear } = twist;
        twists_in_base.push(Twist { angular: angular * tie.multiplier, linear: linear * tie.multiplier });
    }
    ScrewChain { twists_in_base, base_from_tip_at_zero: moved * chain.base_from_tip_at_zero }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_order(table: &[usize], urdf: &[usize], expected: &[usize]) {
        let places = common_order(table, urdf);
        let of = |has: fn(&&Place) -> bool| -> Vec<usize> {
            places.iter().filter(has).map(|place| place.coordinate).collect()
        };
        assert_eq!(of(|_| true), expected);
        assert_eq!(of(|place| place.in_table), table);
        assert_eq!(of(|place| place.in_urdf), urdf);
    }

    /// The allowance for probing is kept by every robot of the workspace.
    #[test]
    fn probed_chains_are_what_they_were_probed_from() {
        let robots = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
        let mut worst = 0.0_f64;
        for folder in std::fs::read_dir(robots).unwrap().flatten() {
            let description = congruent_description::load_robot(&folder.path()).unwrap();
            let robot = &description.robot;
            let by_table = DhChain::new(description.dh.as_ref().unwrap(), robot);
            let tree = UrdfTree::new(robot);
            let joints = robot.chain(description.base, description.tip).unwrap();
            let by_urdf: Vec<usize> = joints.iter().filter_map(|&joint| robot.coordinate(joint)).collect();
            let pair = Pair::new(&description, &by_table, &by_urdf).unwrap();
            for q in crate::configurations::probe_configurations(robot, 0, 50) {
                let driven: Vec<f64> = pair.drivers.iter().map(|&driver| q[driver]).collect();
                let root_from = |link| tree.root_from_link(&q, link).unwrap();
                let by_tree = root_from(description.base).inverse() * root_from(description.tip);
                for (chain, pose) in
                    [(&pair.table, by_table.base_from_tip(&q).unwrap()), (&pair.urdf, by_tree)]
                {
                    let error = LinkError::of(&chain.base_from_tip(&driven).unwrap(), &pose);
                    worst = worst.max(error.position_m.max(error.orientation_rad) / pair.rounding());
                }
            }
        }
        assert!(worst <= 0.5, "{worst} of the allowance for both, by one");
    }

    #[test]
    fn both_keep_their_order() {
        assert_order(&[0, 1, 2], &[0, 1, 2], &[0, 1, 2]);
        assert_order(&[0, 2], &[0, 1, 2], &[0, 1, 2]);
        assert_order(&[0, 1, 2], &[0, 2], &[0, 1, 2]);
        assert_order(&[0, 2, 1], &[0, 1, 2], &[0, 1, 2, 1]);
        assert_order(&[3, 0], &[0], &[3, 0]);
    }
}
