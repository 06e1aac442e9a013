//! Obstacles that overlap the robot at the start: the physics would push them apart with forces that no robot meets.

use congruent_description::{Diagnostic, Link, Robot, RobotQ, Shape, display::length};
use congruent_kinematics::{Pose, UrdfTree};
use congruent_simulation::Obstacle;
use nalgebra::Isometry3;

use crate::{
    bodies::{BodyCourse, MovingBody},
    proximity::Hulls,
    scenario::FilePlace,
};

/// An overlap that is let pass, m: a body that a link touches is given with few digits. Kind: engineering; the physics
/// pushes such a depth away at 8 mm/s.
const TOUCHING_M: f64 = 1e-3;
/// Less than any distance of shapes that are apart, m.
const APART_M: f64 = f64::MIN_POSITIVE;

/// Where everything stands in the first step.
#[derive(Debug, Clone, Copy)]
pub(in crate::setup) struct FirstStep<'a> {
    /// The configuration.
    pub(in crate::setup) q: &'a RobotQ,
    /// The obstacles, those on a path at its beginning.
    pub(in crate::setup) obstacles: &'a [Obstacle],
    /// Those of them that move.
    pub(in crate::setup) moving: &'a [MovingBody],
    /// The length of the step.
    pub(in crate::setup) step_s: f64,
}

/// An error for each obstacle that overlaps a link that can move; what is carried from the start on touches nothing, and
/// the root's links stand still as obstacles do.
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
        let course = start.moving.iter().find(|body| body.obstacle == index).map(|body| &body.course);
        if is_carried(course, start.step_s) {
            return None;
        }
        let (link, depth_m) = deepest(obstacle, &links)?;
        Some(refused(obstacle, (link, depth_m), course, places.item(index)))
    };
    start.obstacles.iter().enumerate().filter_map(overlapping).collect()
}

/// The links with a shape that are not fixed to the root, where they stand; `None` if a shape has no hull, which the run
/// says itself.
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

/// The link that an obstacle overlaps most, if any, with the depth.
fn deepest<'a>(obstacle: &Obstacle, links: &[(&'a Link, Hulls, Isometry3<f64>)]) -> Option<(&'a Link, f64)> {
    let shape = Shape {
        link_from_shape: Isometry3::identity(),
        geometry: obstacle.geometry.clone(),
        color_rgba: None,
    };
    let hulls = Hulls::new(&obstacle.name, &[shape]).ok()?;
    let depths = links.iter().filter_map(|(link, of_link, root_from_link)| {
        let link_from_obstacle = root_from_link.inv_mul(&obstacle.world_from_obstacle);
        // Balls decide for most; a depth costs much more than a distance.
        if of_link.distance_below_m(&hulls, &link_from_obstacle, APART_M) >= APART_M {
            return None;
        }
        Some((*link, -of_link.signed_distance_m(&hulls, &link_from_obstacle)))
    });
    depths.filter(|(_, depth_m)| *depth_m > TOUCHING_M).max_by(|(_, a), (_, b)| a.total_cmp(b))
}

fn is_carried(course: Option<&BodyCourse>, time_s: f64) -> bool {
    match course {
        Some(BodyCourse::Grasps(grasps)) => {
            grasps.iter().any(|grasp| (grasp.from_s..grasp.until_s).contains(&time_s))
        }
        Some(BodyCourse::Path(_)) | None => false,
    }
}

fn refused(
    obstacle: &Obstacle,
    (link, depth_m): (&Link, f64),
    course: Option<&BodyCourse>,
    place: FilePlace<'_>,
) -> Diagnostic {
    let message = format!(
        "obstacle \"{}\" overlaps link \"{}\" at the start, {} deep, so that the physics would throw them apart",
        obstacle.name,
        link.name,
        length(depth_m)
    );
    let carried = match course {
        Some(BodyCourse::Grasps(_)) => {
            "; or let its [[grasp]] begin with `from_s = 0.0`: what is carried touches nothing"
        }
        _ => "",
    };
    let help = format!(
        "move the obstacle or the start of the joints (meshes are taken as their convex hulls){carried}; a controller of \
         kind \"kinematic\" moves the robot without forces, and the check `clearance` measures"
    );
    place.mark(Diagnostic::error("scenario::obstacle_overlap", message).with_help(help))
}
