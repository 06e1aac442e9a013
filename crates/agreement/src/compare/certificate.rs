//! The certificates of a robot: how far two of its models can be apart at link `tip`, over the whole
//! joint range, sampled or not. Table and URDF are known, the physics as far as it was identified.

use congruent_description::{DhTable, JointValues, Mimic, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{
    DhChain, LinkPoses, Pose, PoseError, ScrewChain, Twist, UrdfTree, move_inside_limits, range,
};
use serde::Serialize;

use crate::{
    bound::{Bracket, Budget, Certificate, certify_driven},
    compare::{
        error::CheckError,
        identified::{IdentifiedChain, SCREW_RESIDUAL_LIMIT, base_from_tip},
    },
};

pub use crate::compare::identified::Premise;

/// How far a identified chain may be from what it was identified from, for each metre of its screws'
/// moments and of its home pose (and as an angle). Kind: rounding; a logarithm over half a unit and
/// three products for each joint, some 20 eps; worst seen 6 eps.
const IDENTIFICATION_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// One worst disagreement, bracketed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedBracket {
    /// The disagreement at `at`; m or rad.
    pub attained: f64,
    /// The bound; m or rad.
    pub certified: f64,
    /// A configuration that attains it: the joints that move the tip, rad or m.
    pub at: JointValues,
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
    /// The configurations of the robot that attain them; joints that do not move the tip stand at
    /// zero, or at the limit nearest to it.
    pub(crate) fn attained_at(&self, robot: &Robot) -> [RobotQ; 2] {
        [&self.position_m, &self.orientation_rad].map(|bracket| {
            let mut q = RobotQ::zeros(robot.dof());
            for (joint, value) in bracket.at.iter() {
                let joint = robot.find_joint(joint).expect("the bracket names joints of the robot");
                q[robot.coordinate(joint).expect("a joint that drives the tip moves")] = value;
            }
            move_inside_limits(&mut q, robot);
            q
        })
    }

    /// The bounds alone: no configuration is further apart.
    pub fn bounds(&self) -> PoseError {
        PoseError { position_m: self.position_m.certified, orientation_rad: self.orientation_rad.certified }
    }
}

/// What is certified about two models of the chain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedCertificate {
    /// Which two: `model_urdf`, `model_simulation` or `urdf_simulation`.
    pub name: &'static str,
    /// The same in words.
    pub between: &'static str,
    /// Both brackets; none where a joint has no end, or the premise does not hold.
    #[serde(flatten)]
    pub brackets: Option<Brackets>,
    /// Of the physics: that each joint is one screw.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub premise: Option<Premise>,
}

/// The largest bounds of several certificates, each with where it is attained.
pub(crate) fn worst(certificates: &[ReportedCertificate]) -> Option<Brackets> {
    let brackets = || certificates.iter().filter_map(|certificate| certificate.brackets.as_ref());
    let largest = |of: fn(&Brackets) -> &ReportedBracket| {
        let larger = |a: &&ReportedBracket, b: &&ReportedBracket| a.certified.total_cmp(&b.certified);
        // Of equal ones the first.
        brackets().map(of).rev().max_by(larger).cloned()
    };
    Some(Brackets {
        position_m: largest(|brackets| &brackets.position_m)?,
        orientation_rad: largest(|brackets| &brackets.orientation_rad)?,
    })
}

/// Brackets the disagreement of table and URDF and of table and physics at link `tip`, seen from link
/// `base`; of a robot without table that of URDF and physics.
///
/// # Errors
/// [`CheckError`] when table and robot do not fit together, or the physics refuses a configuration.
pub(crate) fn certificates(
    description: &RobotDescription,
    identified: &IdentifiedChain,
    physics: &mut dyn LinkPoses,
) -> Result<Vec<ReportedCertificate>, CheckError> {
    let robot = &description.robot;
    if robot.chain(description.base, description.tip).is_none() {
        return Ok(Vec::new());
    }
    let (urdf, simulated) = (Side::urdf(description)?, Side::physics(description, identified));
    let urdf_physics = if identified.premise.holds { certified(robot, [&urdf, &simulated])? } else { None };
    let premise = Some(identified.premise);
    let Some(table) = &description.dh else {
        let brackets = report(robot, [&urdf, &simulated], urdf_physics, physics)?;
        let (name, between) = ("urdf_simulation", "URDF and physics");
        return Ok(vec![ReportedCertificate { name, between, brackets, premise }]);
    };
    let table = Side::table(robot, table)?;
    let table_urdf = certified(robot, [&table, &urdf])?;
    let table_physics = match (&table_urdf, urdf_physics) {
        (Some(table_urdf), Some(urdf_physics)) if is_rounding(&urdf_physics) => {
            Some(by_way_of(table_urdf, &urdf_physics))
        }
        (_, Some(_)) => certified(robot, [&table, &simulated])?,
        (_, None) => None,
    };
    let of_urdf = report(robot, [&table, &urdf], table_urdf, physics)?;
    let of_physics = report(robot, [&table, &simulated], table_physics, physics)?;
    Ok(vec![
        ReportedCertificate {
            name: "model_urdf",
            between: "table and URDF",
            brackets: of_urdf,
            premise: None,
        },
        ReportedCertificate {
            name: "model_simulation",
            between: "table and physics",
            brackets: of_physics,
            premise,
        },
    ])
}

/// A model of the chain from base to tip.
struct Side<'a> {
    driven: DrivenScrews,
    /// How far the model was found from its screws.
    residual: PoseError,
    /// The model itself, at a configuration of the robot.
    base_from_tip: Box<TipPose<'a>>,
}

/// Pose of the tip in the base; the physics is asked in its world.
type TipPose<'a> = dyn Fn(&mut dyn LinkPoses, &RobotQ) -> Result<Pose, CheckError> + 'a;

impl<'a> Side<'a> {
    fn table(robot: &Robot, table: &DhTable) -> Result<Self, CheckError> {
        let by_table = DhChain::new(table, robot);
        let chain = ScrewChain::from_dh(&by_table, robot.dof())?;
        Ok(Self {
            driven: DrivenScrews::new(robot, by_table.coordinates(), &chain),
            residual: PoseError::default(),
            base_from_tip: Box::new(move |_, q| Ok(by_table.base_from_tip(q)?)),
        })
    }

    fn urdf(description: &RobotDescription) -> Result<Self, CheckError> {
        let RobotDescription { robot, base, tip, .. } = description;
        let (tree, base, tip, coordinates) =
            (UrdfTree::new(robot), *base, *tip, description.moving_coordinates());
        let chain = ScrewChain::from_urdf(robot, (base, tip), &coordinates)?;
        Ok(Self {
            driven: DrivenScrews::new(robot, &coordinates, &chain),
            residual: PoseError::default(),
            base_from_tip: Box::new(move |_, q| {
                Ok(tree.root_from_link(q, base)?.inverse() * tree.root_from_link(q, tip)?)
            }),
        })
    }

    fn physics(description: &'a RobotDescription, identified: &IdentifiedChain) -> Self {
        let Premise { residual_m: position_m, residual_rad: orientation_rad, .. } = identified.premise;
        Self {
            driven: DrivenScrews::new(
                &description.robot,
                &description.moving_coordinates(),
                &identified.chain,
            ),
            residual: PoseError { position_m, orientation_rad },
            base_from_tip: Box::new(|physics, q| Ok(base_from_tip(description, physics, q)?)),
        }
    }
}

/// The bracket with what probing may have missed; `None` where a joint that moves one of them has no
/// end.
fn certified(robot: &Robot, sides: [&Side<'_>; 2]) -> Result<Option<Certificate>, CheckError> {
    let [a, b] = sides.map(|side| &side.driven);
    // Positions that drive nothing may have any range.
    let joints = robot.movable_joints().iter().enumerate();
    let ranges: Vec<(f64, f64)> = joints
        .map(|(index, &joint)| if drives(sides, index) { range(robot.joint(joint)) } else { (0.0, 0.0) })
        .collect();
    if !ranges.iter().all(|range| range.0.is_finite() && range.1.is_finite()) {
        return Ok(None);
    }
    let mut found =
        certify_driven((&a.chain, &a.drivers), (&b.chain, &b.drivers), &ranges, Budget::default())?;
    let rounding = a.rounding() + b.rounding();
    let residual = sides.map(|side| side.residual);
    found.position_m.certified += rounding + residual[0].position_m + residual[1].position_m;
    found.orientation_rad.certified += rounding + residual[0].orientation_rad + residual[1].orientation_rad;
    Ok(Some(found))
}

/// Whether a position moves one of the two.
fn drives(sides: [&Side<'_>; 2], index: usize) -> bool {
    sides.iter().any(|side| side.driven.drivers.contains(&index))
}

/// Whether two models are the same but for rounding.
fn is_rounding(certificate: &Certificate) -> bool {
    certificate.position_m.certified.max(certificate.orientation_rad.certified) <= SCREW_RESIDUAL_LIMIT
}

/// From a to c by way of b, which is all but c: no further than both ways together.
fn by_way_of(a_b: &Certificate, b_c: &Certificate) -> Certificate {
    let sum =
        |far: &Bracket, near: &Bracket| Bracket { certified: far.certified + near.certified, ..far.clone() };
    Certificate {
        position_m: sum(&a_b.position_m, &b_c.position_m),
        orientation_rad: sum(&a_b.orientation_rad, &b_c.orientation_rad),
    }
}

/// A certificate in names, with what the models themselves attain.
fn report(
    robot: &Robot,
    sides: [&Side<'_>; 2],
    certificate: Option<Certificate>,
    physics: &mut dyn LinkPoses,
) -> Result<Option<Brackets>, CheckError> {
    let Some(certificate) = certificate else { return Ok(None) };
    let mut bracket = |Bracket { at, certified, .. }: Bracket, measure: fn(PoseError) -> f64| {
        let mut at = RobotQ::from(at);
        robot.apply_mimic(&mut at);
        let [a, b] = sides.map(|side| (side.base_from_tip)(physics, &at));
        let attained = measure(PoseError::between(&a?, &b?)).min(certified);
        let name = |index: usize| robot.joint(robot.movable_joints()[index]).name.clone();
        let driving = at.iter().enumerate().filter(|&(index, _)| drives(sides, index));
        let at = driving.map(|(index, &value)| (name(index), value)).collect();
        Ok::<_, CheckError>(ReportedBracket { attained, certified, at })
    };
    Ok(Some(Brackets {
        position_m: bracket(certificate.position_m, |error| error.position_m)?,
        orientation_rad: bracket(certificate.orientation_rad, |error| error.orientation_rad)?,
    }))
}

/// A chain in terms of the positions that drive it.
#[derive(Debug, Clone)]
struct DrivenScrews {
    chain: ScrewChain,
    /// For each joint the entry of the configuration vector that moves it, a mimicked joint's own.
    drivers: Vec<usize>,
}

impl DrivenScrews {
    /// Of a chain whose joints are these entries of the configuration vector.
    fn new(robot: &Robot, coordinates: &[usize], chain: &ScrewChain) -> Self {
        let ties: Vec<Tie> = coordinates.iter().map(|&coordinate| Tie::of(robot, coordinate)).collect();
        Self { chain: tied(&ties, chain), drivers: ties.iter().map(|tie| tie.driver).collect() }
    }

    /// How far a identified chain may be from what it stands for.
    fn rounding(&self) -> f64 {
        let ScrewChain { twists_in_base, base_from_tip_at_zero } = &self.chain;
        let moments = twists_in_base.iter().map(|twist| 1.0 + twist.linear.norm());
        IDENTIFICATION_ROUNDING * (moments.sum::<f64>() + 1.0 + base_from_tip_at_zero.translation.norm())
    }
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

/// The chain in terms of its drivers: an offset `o` turns `exp(S (m q + o))` into
/// `exp(m S q) exp(S o)`, and what follows is moved by the latter.
fn tied(ties: &[Tie], chain: &ScrewChain) -> ScrewChain {
    let mut moved = Pose::identity();
    let mut twists_in_base = Vec::with_capacity(ties.len());
    for (tie, twist) in ties.iter().zip(&chain.twists_in_base) {
        let twist = twist.transformed_by(&moved);
        moved = twist.exp(tie.offset) * moved;
        let Twist { angular, linear } = twist;
        twists_in_base.push(Twist { angular: angular * tie.multiplier, linear: linear * tie.multiplier });
    }
    ScrewChain { twists_in_base, base_from_tip_at_zero: moved * chain.base_from_tip_at_zero }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let by_urdf = description.moving_coordinates();
            let table = ScrewChain::from_dh(&by_table, robot.dof()).unwrap();
            let table = DrivenScrews::new(robot, by_table.coordinates(), &table);
            let urdf = ScrewChain::from_urdf(robot, (description.base, description.tip), &by_urdf).unwrap();
            let urdf = DrivenScrews::new(robot, &by_urdf, &urdf);
            for q in congruent_kinematics::sample_configurations(robot, 0, 50) {
                let root_from = |link| tree.root_from_link(&q, link).unwrap();
                let by_tree = root_from(description.base).inverse() * root_from(description.tip);
                for (side, pose) in [(&table, by_table.base_from_tip(&q).unwrap()), (&urdf, by_tree)] {
                    let driven = q.of_chain(&side.drivers);
                    let error = PoseError::between(&side.chain.base_from_tip(&driven).unwrap(), &pose);
                    worst = worst.max(error.position_m.max(error.orientation_rad) / side.rounding());
                }
            }
        }
        assert!(worst <= 1.0, "{worst} of the allowance");
    }
}
