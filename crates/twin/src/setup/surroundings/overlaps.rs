//! Obstacles that overlap the robot at the start: the physics would push them apart with unrealistic forces.

use congruent_description::{Link, Obstacle, Robot, RobotQ, Shape};
use congruent_input::{Diagnostic, display::length};
use congruent_kinematics::{Pose, UrdfTree};
use congruent_proximity::{BodyTrack, Hulls, MovingBody};
use congruent_scenario::FilePlace;
use nalgebra::Isometry3;

use crate::codes;

/// Smaller overlaps are allowed, m: a body that a link touches is given with few digits. Kind: engineering; the physics
/// removes such an overlap at 8 mm/s.
const TOUCHING_M: f64 = 1e-3;
/// Less than any distance of shapes that are apart, m.
const APART_M: f64 = f64::MIN_POSITIVE;

/// Poses of robot and obstacles in the first step.
#[derive(Debug, Clone, Copy)]
pub(in crate::setup) struct FirstStep<'a> {
    /// The configuration of the robot at the start.
    pub(in crate::setup) q: &'a RobotQ,
    /// The obstacles; those with a path are at its beginning.
    pub(in crate::setup) obstacles: &'a [Obstacle],
    /// The obstacles that move.
    pub(in crate::setup) moving: &'a [MovingBody],
    /// Length of the first step.
    pub(in crate::setup) step_s: f64,
}

/// An error for each obstacle that overlaps a link that can move. Obstacles that are carried from the start touch nothing,
/// and links of the root body are at rest, as obstacles are.
pub(in crate::setup) fn overlaps(
    start: FirstStep<'_>,
    robot: &Robot,
    places: FilePlace<'_>,
) -> Vec<Diagnostic> {
    if start.obstacles.is_empty() {
        return Vec::new();
    }
    let Some(links) = moving_links(robot, start.q) else { return Vec::new() };
    let overlapping = |(index, obstacle): (usize, &Obstacle)| {
        let track = start.moving.iter().find(|body| body.obstacle == index).map(|body| &body.track);
        // At the end of the first step, for which the physics finds its first contacts.
        if is_carried(track, start.step_s) {
            return None;
        }
        let (link, depth_m) = deepest(obstacle, &links)?;
        Some(refused(obstacle, link, depth_m, track, places.item(index)))
    };
    start.obstacles.iter().enumerate().filter_map(overlapping).collect()
}

/// The moving links with their hulls and poses at the start; `None` if a shape has no hull, which the run reports itself.
fn moving_links<'a>(robot: &'a Robot, q: &RobotQ) -> Option<Vec<(&'a Link, Hulls, Isometry3<f64>)>> {
    let mut poses = vec![Pose::identity(); robot.links().len()];
    UrdfTree::new(robot).root_from_links_into(q, &mut poses).ok()?;
    let links = robot.link_indices().zip(robot.links()).zip(&poses);
    let moving = links.filter(|((index, _), _)| robot.body(*index) != robot.root());
    moving
        .map(|((_, link), pose)| {
            let hulls = Hulls::new(&link.name, &link.collisions).ok()?;
            Some((link, hulls, pose.to_isometry()))
        })
        .collect()
}

/// The link that an obstacle overlaps most, with the depth, m; `None` if there is no overlap.
fn deepest<'a>(obstacle: &Obstacle, links: &[(&'a Link, Hulls, Isometry3<f64>)]) -> Option<(&'a Link, f64)> {
    let shape = Shape {
        link_from_shape: Isometry3::identity(),
        geometry: obstacle.geometry.clone(),
        color_rgba: None,
    };
    let hulls = Hulls::new(&obstacle.name, &[shape]).ok()?;
    let depths = links.iter().filter_map(|(link, of_link, root_from_link)| {
        let link_from_obstacle = root_from_link.inv_mul(&obstacle.world_from_obstacle);
        // The distance first: bounding balls decide it for most links, and the depth is defined for an overlap only.
        if of_link.distance_below_m(&hulls, &link_from_obstacle, APART_M) >= APART_M {
            return None;
        }
        Some((*link, -of_link.signed_distance_m(&hulls, &link_from_obstacle)))
    });
    depths.filter(|(_, depth_m)| *depth_m > TOUCHING_M).max_by(|(_, a), (_, b)| a.total_cmp(b))
}

fn is_carried(track: Option<&BodyTrack>, time_s: f64) -> bool {
    match track {
        Some(BodyTrack::Grasps(grasps)) => {
            grasps.iter().any(|grasp| (grasp.from_s..grasp.until_s).contains(&time_s))
        }
        Some(BodyTrack::Path(_)) | None => false,
    }
}

fn refused(
    obstacle: &Obstacle,
    link: &Link,
    depth_m: f64,
    track: Option<&BodyTrack>,
    place: FilePlace<'_>,
) -> Diagnostic {
    let message = format!(
        "obstacle \"{}\" overlaps link \"{}\" by {} at the start, limit <= 1 mm: the physics would push them apart",
        obstacle.name,
        link.name,
        length(depth_m)
    );
    let carried = match track {
        Some(BodyTrack::Grasps(_)) => {
            "; or let its [[grasp]] begin with `from_s = 0.0`: a carried body touches nothing"
        }
        _ => "",
    };
    let help = format!(
        "move the obstacle or change [start] (meshes are replaced by their convex hulls){carried}; or use the controller \
         \"kinematic\", which moves the robot without forces, and the check `clearance`"
    );
    place.mark(Diagnostic::error(codes::scenario::OBSTACLE_OVERLAP, message).with_help(help))
}
