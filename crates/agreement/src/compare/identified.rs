//! The physics as a black box: the screws of the chain from base to tip, identified from its poses, and the
//! residual of that identification.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose, PoseError, ScrewChain};
use schemars::JsonSchema;
use serde::Serialize;

/// Largest residual of screws that were identified, over a whole joint range. Unit: m or rad; kind:
/// rounding, which certificates add; worst seen 3.8e-14.
pub(crate) const SCREW_RESIDUAL_LIMIT: f64 = 1e-10;

/// The premise that each joint of the physics is a pure screw motion, verified at configurations: the worst
/// difference of the physics from the chain that was identified.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Premise {
    /// Number of configurations of the whole robot at which it was verified.
    pub configurations: usize,
    /// Largest distance of the tips there, m.
    pub residual_m: f64,
    /// Largest angle between the tips there, rad.
    pub residual_rad: f64,
    /// Whether the residuals are rounding, so that the premise holds.
    pub holds: bool,
}

/// The chain that was identified, with the premise of the identification.
#[derive(Debug, Clone)]
pub(crate) struct IdentifiedChain {
    /// Its joints are the moving joints from base to tip.
    pub(crate) chain: ScrewChain,
    pub(crate) premise: Premise,
}

impl IdentifiedChain {
    /// Identifies the chain around one configuration, with all other joints at zero, and verifies it at
    /// `configurations`, where these joints are not at zero.
    ///
    /// # Errors
    /// [`LinkPosesError`] if the physics rejects a configuration.
    pub(crate) fn new(
        description: &RobotDescription,
        physics: &mut dyn LinkPoses,
        configurations: &[RobotQ],
    ) -> Result<Self, LinkPosesError> {
        let coordinates = description.moving_coordinates();
        let mut q = RobotQ::zeros(description.robot.dof());
        let mut rejected = None;
        let chain = ScrewChain::identify(coordinates.len(), |values| {
            // `identify` takes a function without errors: the first rejection is kept and returned after it.
            q.set_chain(&coordinates, values);
            base_from_tip(description, physics, &q).unwrap_or_else(|error| {
                rejected = Some(error);
                Pose::identity()
            })
        });
        if let Some(error) = rejected {
            return Err(error);
        }
        let mut worst = PoseError::default();
        // The screws come from some `2 n + 1` poses. Whether each joint is one screw can only be verified at other
        // poses, with all joints of the robot away from zero.
        for q in configurations {
            let expected =
                chain.base_from_tip(&q.chain_positions(&coordinates)).expect("as many positions as joints");
            worst = worst.larger(PoseError::between(&base_from_tip(description, physics, q)?, &expected));
        }
        let premise = Premise {
            configurations: configurations.len(),
            residual_m: worst.position_m,
            residual_rad: worst.orientation_rad,
            holds: worst.position_m <= SCREW_RESIDUAL_LIMIT && worst.orientation_rad <= SCREW_RESIDUAL_LIMIT,
        };
        Ok(Self { chain, premise })
    }
}

/// Pose of the tip in the base by a source of link poses.
pub(crate) fn base_from_tip(
    description: &RobotDescription,
    source: &mut dyn LinkPoses,
    q: &RobotQ,
) -> Result<Pose, LinkPosesError> {
    let mut root_from_links = vec![Pose::identity(); description.robot.links().len()];
    source.root_from_links_into(q, &mut root_from_links)?;
    let [base, tip] = [description.base, description.tip].map(|link| root_from_links[link.get()]);
    Ok(base.inverse() * tip)
}
