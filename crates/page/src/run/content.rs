//! What the page of a run shows beside the report.

use congruent_description::{Obstacle, RobotDescription};
use congruent_monitors::Names;

use super::events::Events;
use crate::series::RunSeries;

/// What a page shows beside the report: names, bodies, series and poses that the report does not hold.
#[derive(Debug)]
pub(super) struct RunContent {
    pub(super) names: Names,
    pub(super) description: RobotDescription,
    pub(super) obstacles: Vec<Obstacle>,
    /// Whether an obstacle does not stay where it is at first.
    pub(super) obstacles_move: bool,
    pub(super) zones: Vec<Obstacle>,
    /// Grasps and payloads, which the report does not have.
    pub(super) events: Events,
    pub(super) series: RunSeries,
}
