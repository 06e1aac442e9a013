//! The certificates of a robot: bounds of the difference of two of its models at link `tip` over the whole
//! joint range. Table and URDF are known chains, the physics is the chain that was identified.

use std::cell::RefCell;

use congruent_description::{DhTable, JointValues, Mimic, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{
    DhChain, LinkPoses, Pose, PoseError, ScrewChain, Twist, UrdfTree, move_inside_limits, range,
};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    bound::{Bracket, Budget, Certificate, DrivenScrews, certify_driven},
    compare::{
        error::CheckError,
        identified::{IdentifiedChain, SCREW_RESIDUAL_LIMIT, base_from_tip},
    },
    source_pair::SourcePair,
};

pub use crate::compare::identified::Premise;

/// Largest difference of an identified chain from its source, per metre of its screws' moments and of its
/// home pose (and as an angle). Kind: rounding; a logarithm over half a unit and three products for each
/// joint, some 20 eps; worst seen 6 eps.
const IDENTIFICATION_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Bracket of one worst disagreement.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedBracket {
    /// The difference at the configuration `at`; m or rad.
    pub attained: f64,
    /// The bound that no configuration exceeds; m or rad.
    pub certified: f64,
    /// The configuration of `attained`: the joints that move the tip, rad or m.
    pub at: JointValues,
}

/// The brackets of position and orientation.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Brackets {
    /// Bracket of the largest distance of the tips, m.
    pub position_m: ReportedBracket,
    /// Bracket of the largest angle between the tips, rad.
    pub orientation_rad: ReportedBracket,
}

impl Brackets {
    /// The configurations of the robot that attain them; joints that do not move the tip are at zero, or at
    /// the limit nearest to zero.
    ///
    /// # Panics
    /// If the robot is not the one that was bracketed.
    pub fn attained_at(&self, robot: &Robot) -> [RobotQ; 2] {
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

    /// The bounds alone: no configuration has a larger difference.
    pub fn bounds(&self) -> PoseError {
        PoseError { position_m: self.position_m.certified, orientation_rad: self.orientation_rad.certified }
    }
}

/// The certificate of two models of the chain.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedCertificate {
    /// The pair: `model_urdf`, `model_simulation`, `urdf_simulation` or `urdf_other`.
    pub name: SourcePair,
    /// The pair in words.
    pub title: &'static str,
    /// Both brackets; none if a joint has no limits, or if the premise does not hold.
    #[serde(flatten)]
    pub brackets: Option<Brackets>,
    /// Premise of a pair with the physics: each joint is a pure screw motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub premise: Option<Premise>,
    /// The joint that slides without a range, if there is one: the two may then be any distance apart, and there is no
    /// bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unranged: Option<String>,
}

impl ReportedCertificate {
    fn new(
        pair: SourcePair,
        brackets: Option<Brackets>,
        premise: Option<Premise>,
        unranged: Option<&str>,
    ) -> Self {
        Self { name: pair, title: pair.title(), brackets, premise, unranged: unranged.map(str::to_owned) }
    }
}

/// The largest bounds of several certificates, with their configurations.
pub(crate) fn worst(certificates: &[ReportedCertificate]) -> Option<Brackets> {
    let brackets = || certificates.iter().filter_map(|certificate| certificate.brackets.as_ref());
    let largest = |of: fn(&Brackets) -> &ReportedBracket| {
        // Position and orientation separately: their worst cases can be of different pairs.
        let larger = |a: &&ReportedBracket, b: &&ReportedBracket| a.certified.total_cmp(&b.certified);
        // Of equal ones the first.
        brackets().map(of).rev().max_by(larger).cloned()
    };
    Some(Brackets {
        position_m: largest(|brackets| &brackets.position_m)?,
        orientation_rad: largest(|brackets| &brackets.orientation_rad)?,
    })
}

/// Brackets the disagreements of table and URDF and of table and physics at link `tip` relative to link `base`; for
/// a robot without table those of URDF and physics. Without physics there is no pair with it.
///
/// # Errors
/// [`CheckError`] if table and robot do not fit together, or if the physics rejects a configuration.
pub(crate) fn certificates(
    description: &RobotDescription,
    physics: Option<(&IdentifiedChain, &mut dyn LinkPoses)>,
) -> Result<Vec<ReportedCertificate>, CheckError> {
    let robot = &description.robot;
    if robot.chain(description.base, description.tip).is_none() {
        return Ok(Vec::new());
    }
    let urdf = ComparedChain::urdf(description)?;
    let table = description.dh.as_ref().map(|table| ComparedChain::table(robot, table)).transpose()?;
    let table_urdf = match &table {
        Some(table) => certified(robot, [table, &urdf])?,
        None => None,
    };
    let unranged = urdf.driven.drivers.iter().find_map(|&driver| unranged_slide(robot, driver));
    let mut certificates = Vec::new();
    if let Some(table) = &table {
        let brackets = report(robot, [table, &urdf], table_urdf.clone())?;
        certificates.push(ReportedCertificate::new(SourcePair::ModelUrdf, brackets, None, unranged));
    }
    let Some((identified, physics)) = physics else { return Ok(certificates) };
    let simulated = ComparedChain::physics(description, identified, physics);
    // A chain that was identified from poses represents the physics only if the premise holds; otherwise there is no
    // bound.
    let urdf_physics = if identified.premise.holds { certified(robot, [&urdf, &simulated])? } else { None };
    let (pair, model, certificate) = match (&table, table_urdf, urdf_physics) {
        (None, _, urdf_physics) => (SourcePair::UrdfSimulation, &urdf, urdf_physics),
        // URDF and physics are the same chain up to rounding, as for every robot that the physics reads from its
        // URDF. Then the bracket of table and URDF serves again, and a second search is saved.
        (Some(table), Some(table_urdf), Some(urdf_physics)) if is_rounding(&urdf_physics) => {
            (SourcePair::ModelSimulation, table, Some(through_intermediate(&table_urdf, &urdf_physics)))
        }
        (Some(table), _, Some(_)) => {
            (SourcePair::ModelSimulation, table, certified(robot, [table, &simulated])?)
        }
        (Some(table), _, None) => (SourcePair::ModelSimulation, table, None),
    };
    let brackets = report(robot, [model, &simulated], certificate)?;
    certificates.push(ReportedCertificate::new(pair, brackets, Some(identified.premise), unranged));
    Ok(certificates)
}

/// The name of the joint of a coordinate if it slides without a range. One that turns without a range is covered by one turn.
fn unranged_slide(robot: &Robot, coordinate: usize) -> Option<&str> {
    let joint = robot.joint(robot.movable_joints()[coordinate]);
    joint.largest_shift_m().is_infinite().then_some(&joint.name)
}

/// A model of the chain from base to tip.
struct ComparedChain<'a> {
    driven: DrivenScrews,
    /// Largest difference of the model from its screws.
    residual: PoseError,
    /// The model itself, at a configuration of the robot.
    base_from_tip: Box<TipPose<'a>>,
}

/// Pose of the tip in the base.
type TipPose<'a> = dyn Fn(&RobotQ) -> Result<Pose, CheckError> + 'a;

impl<'a> ComparedChain<'a> {
    fn table(robot: &Robot, table: &DhTable) -> Result<Self, CheckError> {
        let by_table = DhChain::new(table, robot);
        let chain = ScrewChain::from_dh(&by_table, robot.dof())?;
        Ok(Self {
            driven: driven_screws(robot, by_table.coordinates(), &chain),
            residual: PoseError::default(),
            base_from_tip: Box::new(move |q| Ok(by_table.base_from_tip(q)?)),
        })
    }

    fn urdf(description: &RobotDescription) -> Result<Self, CheckError> {
        let RobotDescription { robot, base, tip, .. } = description;
        let (tree, base, tip, coordinates) =
            (UrdfTree::new(robot), *base, *tip, description.moving_coordinates());
        let chain = ScrewChain::from_urdf(robot, base, tip, &coordinates)?;
        Ok(Self {
            driven: driven_screws(robot, &coordinates, &chain),
            residual: PoseError::default(),
            base_from_tip: Box::new(move |q| {
                Ok(tree.root_from_link(q, base)?.inverse() * tree.root_from_link(q, tip)?)
            }),
        })
    }

    fn physics(
        description: &'a RobotDescription,
        identified: &IdentifiedChain,
        physics: &'a mut dyn LinkPoses,
    ) -> Self {
        let physics = RefCell::new(physics);
        let Premise { residual_m: position_m, residual_rad: orientation_rad, .. } = identified.premise;
        Self {
            driven: driven_screws(&description.robot, &description.moving_coordinates(), &identified.chain),
            residual: PoseError { position_m, orientation_rad },
            base_from_tip: Box::new(move |q| Ok(base_from_tip(description, &mut **physics.borrow_mut(), q)?)),
        }
    }
}

/// The bracket of two models, with the residual and the rounding of their identification; `None` if a joint
/// that moves one of them has no limits.
fn certified(robot: &Robot, chains: [&ComparedChain<'_>; 2]) -> Result<Option<Certificate>, CheckError> {
    let [a, b] = chains.map(|side| &side.driven);
    // The range of positions that move neither chain does not matter.
    let joints = robot.movable_joints().iter().enumerate();
    let ranges: Vec<(f64, f64)> = joints
        .map(|(index, &joint)| if drives(chains, index) { range(robot.joint(joint)) } else { (0.0, 0.0) })
        .collect();
    let drivers = || (0..ranges.len()).filter(|&index| drives(chains, index));
    if !ranges.iter().all(|range| range.0.is_finite() && range.1.is_finite())
        || drivers().any(|index| unranged_slide(robot, index).is_some())
    {
        return Ok(None);
    }
    let mut found = certify_driven(a, b, &ranges, Budget::default())?;
    let rounding = identification_rounding(a) + identification_rounding(b);
    let residual = chains.map(|side| side.residual);
    // The search bounds two screw chains. Each model differs from its chain by at most rounding and residual, so
    // the triangle inequality gives the bound of the models.
    found.position_m.certified += rounding + residual[0].position_m + residual[1].position_m;
    found.orientation_rad.certified += rounding + residual[0].orientation_rad + residual[1].orientation_rad;
    Ok(Some(found))
}

/// Whether a position moves one of the two.
fn drives(chains: [&ComparedChain<'_>; 2], index: usize) -> bool {
    chains.iter().any(|side| side.driven.drivers.contains(&index))
}

/// Whether two models differ by rounding only.
fn is_rounding(certificate: &Certificate) -> bool {
    certificate.position_m.certified.max(certificate.orientation_rad.certified) <= SCREW_RESIDUAL_LIMIT
}

/// The bracket of a and c through b, which differs from c by rounding only: by the triangle inequality the
/// bounds add up.
fn through_intermediate(a_b: &Certificate, b_c: &Certificate) -> Certificate {
    let sum =
        |a_b: &Bracket, b_c: &Bracket| Bracket { certified: a_b.certified + b_c.certified, ..a_b.clone() };
    Certificate {
        position_m: sum(&a_b.position_m, &b_c.position_m),
        orientation_rad: sum(&a_b.orientation_rad, &b_c.orientation_rad),
    }
}

/// A certificate with names of joints, and with the disagreement that the models themselves have.
fn report(
    robot: &Robot,
    chains: [&ComparedChain<'_>; 2],
    certificate: Option<Certificate>,
) -> Result<Option<Brackets>, CheckError> {
    let Some(certificate) = certificate else { return Ok(None) };
    let bracket = |Bracket { at, certified, .. }: Bracket, measure: fn(PoseError) -> f64| {
        let mut at = RobotQ::from(at);
        robot.apply_mimic(&mut at);
        let [a, b] = chains.map(|side| (side.base_from_tip)(&at));
        // Attained is what the models themselves give, not their screws; it can be above the bound by rounding
        // only.
        let attained = measure(PoseError::between(&a?, &b?)).min(certified);
        let name = |index: usize| robot.joint(robot.movable_joints()[index]).name.clone();
        let driving = at.iter().enumerate().filter(|&(index, _)| drives(chains, index));
        let at = driving.map(|(index, &value)| (name(index), value)).collect();
        Ok::<_, CheckError>(ReportedBracket { attained, certified, at })
    };
    Ok(Some(Brackets {
        position_m: bracket(certificate.position_m, |error| error.position_m)?,
        orientation_rad: bracket(certificate.orientation_rad, |error| error.orientation_rad)?,
    }))
}

/// The driven screws of a chain whose joints are these entries of the configuration vector.
fn driven_screws(robot: &Robot, coordinates: &[usize], chain: &ScrewChain) -> DrivenScrews {
    let relations: Vec<MimicRelation> =
        coordinates.iter().map(|&coordinate| MimicRelation::for_coordinate(robot, coordinate)).collect();
    DrivenScrews {
        chain: without_offsets(&relations, chain),
        drivers: relations.iter().map(|relation| relation.driver).collect(),
    }
}

/// Bound of the rounding of the identification of a chain.
fn identification_rounding(driven: &DrivenScrews) -> f64 {
    let ScrewChain { twists_in_base, base_from_tip_at_zero } = &driven.chain;
    let moments = twists_in_base.iter().map(|twist| 1.0 + twist.linear.norm());
    IDENTIFICATION_ROUNDING * (moments.sum::<f64>() + 1.0 + base_from_tip_at_zero.translation.norm())
}

/// The position of a joint: `multiplier * q[driver] + offset`.
#[derive(Debug, Clone, Copy)]
struct MimicRelation {
    driver: usize,
    multiplier: f64,
    offset: f64,
}

impl MimicRelation {
    fn for_coordinate(robot: &Robot, coordinate: usize) -> Self {
        let mimic = robot.joint(robot.movable_joints()[coordinate]).mimic;
        let relation = |Mimic { master, multiplier, offset }| {
            Some(Self { driver: robot.coordinate(master)?, multiplier, offset })
        };
        mimic.and_then(relation).unwrap_or(Self { driver: coordinate, multiplier: 1.0, offset: 0.0 })
    }
}

/// The chain as a function of its drivers: `exp(S (m q + o)) = exp(m S q) exp(S o)` for an offset `o`, and
/// the following screws and the home pose are moved by the second factor.
fn without_offsets(relations: &[MimicRelation], chain: &ScrewChain) -> ScrewChain {
    let mut moved = Pose::identity();
    let mut twists_in_base = Vec::with_capacity(relations.len());
    for (relation, twist) in relations.iter().zip(&chain.twists_in_base) {
        let twist = twist.transformed_by(&moved);
        // All later screws and the home pose are carried by the constant turn of the offset.
        moved = twist.exp(relation.offset) * moved;
        let Twist { angular, linear } = twist;
        twists_in_base
            .push(Twist { angular: angular * relation.multiplier, linear: linear * relation.multiplier });
    }
    ScrewChain { twists_in_base, base_from_tip_at_zero: moved * chain.base_from_tip_at_zero }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound of the rounding holds for every robot of the workspace.
    #[test]
    fn identified_chains_are_their_sources_up_to_rounding() {
        let robots = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
        let mut worst = 0.0_f64;
        for folder in std::fs::read_dir(robots).unwrap().flatten() {
            let description = congruent_description::load_robot(&folder.path()).unwrap();
            let robot = &description.robot;
            let by_table = DhChain::new(description.dh.as_ref().unwrap(), robot);
            let tree = UrdfTree::new(robot);
            let by_urdf = description.moving_coordinates();
            let table = ScrewChain::from_dh(&by_table, robot.dof()).unwrap();
            let table = driven_screws(robot, by_table.coordinates(), &table);
            let urdf = ScrewChain::from_urdf(robot, description.base, description.tip, &by_urdf).unwrap();
            let urdf = driven_screws(robot, &by_urdf, &urdf);
            for q in congruent_kinematics::sample_configurations(robot, 0, 50) {
                let root_from = |link| tree.root_from_link(&q, link).unwrap();
                let by_tree = root_from(description.base).inverse() * root_from(description.tip);
                for (side, pose) in [(&table, by_table.base_from_tip(&q).unwrap()), (&urdf, by_tree)] {
                    let driven = q.chain_positions(&side.drivers);
                    let error = PoseError::between(&side.chain.base_from_tip(&driven).unwrap(), &pose);
                    worst = worst
                        .max(error.position_m.max(error.orientation_rad) / identification_rounding(side));
                }
            }
        }
        assert!(worst <= 1.0, "{worst} of the bound");
    }
}
