//! Space that links are forbidden to enter.

use congruent_description::{LinkIndex, Obstacle};

/// Space that is forbidden to some links.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Name, pose and shape of the zone.
    pub space: Obstacle,
    /// The links that may not enter, in the robot's order: at least one, each with a collision
    /// shape.
    pub links: Vec<LinkIndex>,
}
