//! Whether a body that is grasped is within reach of the gripper when it is taken: a body that is far away would follow the arm
//! through the air.

use congruent_description::{Geometry, LinkIndex, Obstacle, RobotDescription, RobotQ, Shape};
use congruent_input::{Diagnostic, display::quantity};
use congruent_kinematics::{Pose, UrdfTree};
use congruent_motion::Trajectory;
use congruent_proximity::{Grasp, Hulls};
use congruent_scenario::{FilePlace, GraspSettings};
use nalgebra::Isometry3;

use crate::codes;

/// Distance from the gripper within which a body is taken if the scenario does not give one, m. Kind: engineering; a gripper that
/// the description does not have is about as long.
pub(in crate::setup) const DEFAULT_REACH_M: f64 = 0.1;
/// Size of a point as a shape, m: below the digits of a file.
const POINT_M: f64 = 1e-9;

/// A grasp with its place in the file.
pub(super) struct GraspedBody<'a> {
    pub(super) obstacle: usize,
    pub(super) grasp: Grasp,
    pub(super) settings: &'a GraspSettings,
    pub(super) place: FilePlace<'a>,
}

/// Whether the grasps of one body, in the order of time, take it within reach, by the planned motions. What follows a motion
/// without a plan is not examined.
///
/// # Errors
/// The first grasp that does not.
pub(super) fn examine_reach(
    held: &[GraspedBody<'_>],
    description: &RobotDescription,
    trajectory: &Trajectory,
    obstacle: &Obstacle,
) -> Result<(), Diagnostic> {
    let tree = UrdfTree::new(&description.robot);
    let link_at = |link: LinkIndex, time_s: f64| {
        let q = trajectory.planned_at(time_s)?;
        Some(tree.root_from_link(&q, link).ok()?.to_isometry())
    };
    let mut world_from_obstacle = obstacle.world_from_obstacle;
    for (index, body) in held.iter().enumerate() {
        let GraspedBody { grasp, settings, place, .. } = body;
        let Some(q) = trajectory.planned_at(grasp.from_s) else { return Ok(()) };
        let keys = settings.reach();
        let reach_m = keys.value().unwrap_or(DEFAULT_REACH_M);
        let of_body = Obstacle { world_from_obstacle, ..obstacle.clone() };
        let distance_m = distance_m(&of_body, grasp.link, &q, description, reach_m);
        if let Some(distance_m) = distance_m.filter(|distance_m| *distance_m > reach_m) {
            let link = &description.robot.link(grasp.link).name;
            let message = format!(
                "\"{}\" is {} from the gripper (link \"{link}\" and what is behind it) at from_s = {} s, reach <= {}",
                obstacle.name,
                quantity(distance_m, "m"),
                grasp.from_s,
                quantity(reach_m, "m")
            );
            let error = Diagnostic::error(codes::scenario::GRASP, message).with_help(
                "move the arm to the body before `from_s`, or give the reach of the gripper as `reach_mm`",
            );
            return Err(place.key("from_s").mark(error));
        }
        // Where it is put down matters only if it is taken again.
        if index + 1 < held.len() {
            let (Some(taken), Some(put_down)) =
                (link_at(grasp.link, grasp.from_s), link_at(grasp.link, grasp.until_s))
            else {
                return Ok(());
            };
            world_from_obstacle = put_down * taken.inv_mul(&world_from_obstacle);
        }
    }
    Ok(())
}

/// Distance of a body from the tool of a link: its TCP, and the shapes of its body and of all that it carries. `None` if a shape has
/// no hull, which the run reports. A TCP within reach decides without hulls, which take long for large meshes.
fn distance_m(
    obstacle: &Obstacle,
    link: LinkIndex,
    q: &RobotQ,
    description: &RobotDescription,
    reach_m: f64,
) -> Option<f64> {
    let robot = &description.robot;
    let mut poses = vec![Pose::identity(); robot.links().len()];
    UrdfTree::new(robot).root_from_links_into(q, &mut poses).ok()?;
    let shape =
        |geometry: Geometry| Shape { link_from_shape: Isometry3::identity(), geometry, color_rgba: None };
    let body = Hulls::new(&obstacle.name, &[shape(obstacle.geometry.clone())]).ok()?;
    let point = Hulls::new("TCP", &[shape(Geometry::Sphere { radius_m: POINT_M })]).ok()?;
    let apart_m = |hulls: &Hulls, root_from_hulls: &Isometry3<f64>| {
        hulls.distance_m(&body, &root_from_hulls.inv_mul(&obstacle.world_from_obstacle))
    };
    let pose = |link: LinkIndex| poses[link.get()].to_isometry();
    let tcp = description.tip_from_tcp.filter(|_| link == description.tip);
    let mut least_m = apart_m(&point, &(pose(link) * tcp.unwrap_or_else(Isometry3::identity)));
    // The body of the link, with what is fixed to it before or beside the link, and all that moves on it.
    let gripper = robot.body(link);
    let is_behind = |mut link: LinkIndex| loop {
        if robot.body(link) == gripper {
            return true;
        }
        match robot.parent_joint(link) {
            Some(joint) => link = robot.joint(joint).parent,
            None => return false,
        }
    };
    for other in robot.link_indices().filter(|&link| is_behind(link)) {
        if least_m <= reach_m {
            break;
        }
        let hulls = Hulls::new(&robot.link(other).name, &robot.link(other).collisions).ok()?;
        if !hulls.is_empty() {
            least_m = least_m.min(apart_m(&hulls, &pose(other)));
        }
    }
    Some(least_m)
}
