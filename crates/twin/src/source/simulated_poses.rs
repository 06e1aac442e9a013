//! Link poses by physics, for comparisons that do not know the engine.

use congruent_description::{Robot, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose};
use congruent_simulation::{SimulationError, World, WorldSettings};
use nalgebra::Isometry3;

/// The physics twin of a robot as a source of poses: it is placed at configurations, not stepped.
pub struct SimulatedPoses {
    world: World,
    at_rest: Vec<f64>,
    root_from_links: Vec<Isometry3<f64>>,
}

impl std::fmt::Debug for SimulatedPoses {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SimulatedPoses").finish_non_exhaustive()
    }
}

impl SimulatedPoses {
    /// A world with this robot and nothing else.
    ///
    /// # Errors
    /// [`SimulationError`] if the robot cannot be simulated.
    pub fn new(robot: &Robot) -> Result<Self, SimulationError> {
        Ok(Self {
            world: World::new(robot, &WorldSettings::default())?,
            at_rest: vec![0.0; robot.dof()],
            root_from_links: vec![Isometry3::identity(); robot.links().len()],
        })
    }
}

impl LinkPoses for SimulatedPoses {
    fn root_from_links_into(
        &mut self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), LinkPosesError> {
        self.world.set_state(q, &self.at_rest).map_err(LinkPosesError::source)?;
        self.world.root_from_links_into(&mut self.root_from_links);
        for (pose, isometry) in root_from_links.iter_mut().zip(&self.root_from_links) {
            *pose = Pose::from(*isometry);
        }
        Ok(())
    }
}
