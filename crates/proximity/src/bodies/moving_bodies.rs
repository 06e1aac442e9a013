//! The poses of moving obstacles, step after step.

use congruent_description::{LinkIndex, Obstacle};
use nalgebra::Isometry3;

use super::moving_body::{BodyTrack, Grasp, MovingBody, on_path};
use crate::{Carried, Clearance};

/// The moving obstacles of a run with their present poses.
#[derive(Debug, Clone)]
pub struct MovingBodies<'a> {
    bodies: &'a [MovingBody],
    states: Vec<MovingBodyState>,
}

#[derive(Debug, Clone, Copy)]
struct MovingBodyState {
    world_from_obstacle: Isometry3<f64>,
    /// The grasp that holds it, with its pose in the link.
    held: Option<(Grasp, Isometry3<f64>)>,
}

impl<'a> MovingBodies<'a> {
    /// At the poses that the obstacles have at first.
    pub fn new(bodies: &'a [MovingBody], obstacles: &[Obstacle]) -> Self {
        let state = |body: &MovingBody| MovingBodyState {
            world_from_obstacle: obstacles[body.obstacle].world_from_obstacle,
            held: None,
        };
        Self { bodies, states: bodies.iter().map(state).collect() }
    }

    /// Moves all to a time at which the links have these poses.
    pub fn advance(&mut self, time_s: f64, root_from_link: impl Fn(LinkIndex) -> Isometry3<f64>) {
        for (body, state) in self.bodies.iter().zip(&mut self.states) {
            match &body.track {
                BodyTrack::Path(path) => state.world_from_obstacle = on_path(path, time_s),
                BodyTrack::Grasps(grasps) => state.follow(grasps, time_s, &root_from_link),
            }
        }
    }

    /// Moves them in `clearance` to where they are; takes effect with [`Clearance::move_links`].
    pub fn move_in(&self, clearance: &mut Clearance) {
        for (obstacle, pose, is_carried) in self.poses() {
            clearance.move_obstacle(obstacle, pose, if is_carried { Carried::Yes } else { Carried::No });
        }
    }

    /// Number, pose and whether it is carried, of each.
    pub fn poses(&self) -> impl Iterator<Item = (usize, &Isometry3<f64>, bool)> + '_ {
        self.bodies
            .iter()
            .zip(&self.states)
            .map(|(body, state)| (body.obstacle, &state.world_from_obstacle, state.held.is_some()))
    }
}

impl MovingBodyState {
    fn follow(
        &mut self,
        grasps: &[Grasp],
        time_s: f64,
        root_from_link: &impl Fn(LinkIndex) -> Isometry3<f64>,
    ) {
        // Until it is left it goes along, so that it is left where the link is then.
        if let Some((grasp, link_from_obstacle)) = self.held {
            self.world_from_obstacle = root_from_link(grasp.link) * link_from_obstacle;
        }
        // Half open: at the instant of a handover only the next link holds it.
        let now = grasps.iter().find(|grasp| (grasp.from_s..grasp.until_s).contains(&time_s));
        match (now, self.held) {
            (Some(now), Some((held, _))) if *now == held => {}
            (Some(now), _) => {
                // From the pose at this instant, which includes the motion under the grasp before: a handover has no
                // jump.
                let link_from_obstacle = root_from_link(now.link).inv_mul(&self.world_from_obstacle);
                self.held = Some((*now, link_from_obstacle));
            }
            (None, _) => self.held = None,
        }
    }
}
