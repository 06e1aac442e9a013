//! `[[obstacle]] path` and `[[grasp]]` as moving bodies, and the masses of carried bodies as payloads.

use congruent_description::{CarriedBody, Geometry, Inertia, LinkIndex, Obstacle, RobotDescription};
use congruent_input::{Diagnostic, Diagnostics, Findings, known_names};
use congruent_kinematics::UrdfTree;
use congruent_monitors::{HEAVIEST_KG, RunPayload, too_heavy};
use congruent_motion::Trajectory;
use congruent_proximity::{BodyTrack, Grasp, MovingBody, ObstacleMobility, PathPose};
use congruent_scenario::{FilePlace, GraspSettings, ObstacleSettings, PoseSettings, Scenario};
use nalgebra::{Isometry3, Matrix3, Translation3, Vector3};

use super::{
    reach::{GraspedBody, examine_reach},
    spaces,
};
use crate::{codes, setup::written_at::WrittenAt};

/// The bodies around the robot.
pub(in crate::setup) struct Surroundings {
    /// All obstacles; `None` if one of them is wrong.
    pub(in crate::setup) obstacles: Option<Vec<Obstacle>>,
    /// The obstacles that move.
    pub(in crate::setup) moving: Vec<MovingBody>,
    /// The masses of the obstacles that are carried.
    pub(in crate::setup) payloads: Vec<RunPayload>,
}

impl Surroundings {
    /// Builds all; their faults are kept in `found`.
    pub(in crate::setup) fn new(
        scenario: &Scenario,
        written: WrittenAt<'_>,
        description: &RobotDescription,
        trajectory: Option<&Trajectory>,
        found: &mut Diagnostics,
    ) -> Self {
        let WrittenAt { place, folder, .. } = written;
        let places = place.key("obstacle");
        let (mut moving, mut payloads) = (Vec::new(), Vec::new());
        let built = spaces::build(&scenario.obstacle, places, &spaces::OBSTACLE, folder, &description.robot);
        let mut obstacles = built.map_err(|errors| found.extend(errors)).ok();
        // Paths before grasps, since an obstacle with a path cannot be grasped.
        if let Some(obstacles) = &mut obstacles {
            let paths = paths(&scenario.obstacle, places, obstacles);
            moving = paths.map_err(|errors| found.extend(errors)).unwrap_or_default();
        }
        // The mass in the link follows from the planned pose at the grasp.
        if let (Some(obstacles), Some(trajectory)) = (&obstacles, trajectory) {
            let held = grasps(scenario, place.key("grasp"), description, obstacles, &moving);
            let carried = held.and_then(|held| follow(held, description, trajectory, obstacles, &mut moving));
            payloads = carried.map_err(|errors| found.extend(errors)).unwrap_or_default();
        }
        Self { obstacles, moving, payloads }
    }
}

/// How each obstacle moves, by index; `obstacles` is their number.
pub(in crate::setup) fn mobility(bodies: &[MovingBody], obstacles: usize) -> Vec<ObstacleMobility> {
    let mut mobility = vec![ObstacleMobility::Still; obstacles];
    for body in bodies {
        mobility[body.obstacle] = match &body.track {
            BodyTrack::Path(_) => ObstacleMobility::Moves,
            BodyTrack::Grasps(grasps) => {
                ObstacleMobility::Carried(grasps.iter().map(|grasp| grasp.link).collect())
            }
        };
    }
    mobility
}

/// Builds the paths of obstacles and places each obstacle at the beginning of its path.
fn paths(
    all: &[ObstacleSettings],
    places: FilePlace<'_>,
    obstacles: &mut [Obstacle],
) -> Result<Vec<MovingBody>, Findings> {
    let (mut bodies, mut errors) = (Vec::new(), Vec::new());
    for (index, settings) in all.iter().enumerate().filter(|(_, settings)| !settings.path.is_empty()) {
        match path(settings, places.item(index)) {
            Ok(path) => {
                // Not empty, by the filter above. Until its first time the obstacle stays at the first pose.
                obstacles[index].world_from_obstacle = path[0].world_from_obstacle;
                bodies.push(MovingBody { obstacle: index, track: BodyTrack::Path(path) });
            }
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(bodies) } else { Err(errors.into()) }
}

fn path(settings: &ObstacleSettings, place: FilePlace<'_>) -> Result<Vec<PathPose>, Diagnostic> {
    let refused = |place: FilePlace<'_>, message: String, help: &'static str| {
        Err(place.mark(Diagnostic::error(codes::scenario::OBSTACLE_PATH, message).with_help(help)))
    };
    let name = &settings.name;
    let has_pose = settings.xyz_m.is_some() || settings.xyz_mm.is_some();
    if has_pose || settings.rpy_deg.is_some() || settings.rpy_rad.is_some() {
        let message = format!("obstacle \"{name}\" has a pose of its own and a path");
        return refused(
            place,
            message,
            "remove the pose: until the first `at_s` of its path the obstacle stays at the first pose of the path",
        );
    }
    let mut path: Vec<PathPose> = Vec::with_capacity(settings.path.len());
    for (index, written) in settings.path.iter().enumerate() {
        let place = place.key("path").item(index);
        if let Some(before) = path.last().filter(|before| written.at_s <= before.at_s) {
            let message =
                format!("obstacle \"{name}\": at_s = {} s is not after {} s", written.at_s, before.at_s);
            return refused(
                place.key("at_s"),
                message,
                "each pose of a path must be later than the pose before",
            );
        }
        let (xyz_m, xyz_mm, rpy_deg, rpy_rad) =
            (written.xyz_m, written.xyz_mm, written.rpy_deg, written.rpy_rad);
        let pose = PoseSettings { xyz_m, xyz_mm, rpy_rad, rpy_deg, ..PoseSettings::default() };
        let world_from_obstacle = pose.isometry(place)?;
        if world_from_obstacle.translation.vector.amax() > spaces::LARGEST_M {
            let message =
                format!("obstacle \"{name}\": a coordinate is beyond the limit of {} m", spaces::LARGEST_M);
            return refused(
                place,
                message,
                "give the path in metres under `xyz_m`, or in millimetres under `xyz_mm`",
            );
        }
        path.push(PathPose { at_s: written.at_s, world_from_obstacle });
    }
    Ok(path)
}

/// The grasps of obstacles; an obstacle with a path cannot be grasped.
fn grasps<'a>(
    scenario: &'a Scenario,
    places: FilePlace<'a>,
    description: &RobotDescription,
    obstacles: &[Obstacle],
    bodies: &[MovingBody],
) -> Result<Vec<GraspedBody<'a>>, Findings> {
    let (mut held, mut errors) = (Vec::new(), Vec::new());
    for (index, settings) in scenario.grasp.iter().enumerate() {
        let place = places.item(index);
        match grasp(settings, place, description, obstacles) {
            // Only bodies with paths are in the list so far.
            Ok((obstacle, _)) if bodies.iter().any(|body| body.obstacle == obstacle) => {
                let message = format!(
                    "obstacle \"{}\" moves along a path, so that no link can carry it",
                    settings.body
                );
                errors.push(place.key("body").mark(Diagnostic::error(codes::scenario::GRASP, message)));
            }
            Ok((obstacle, grasp)) => held.push(GraspedBody { obstacle, grasp, settings, place }),
            Err(error) => errors.push(error),
        }
    }
    if errors.is_empty() { Ok(held) } else { Err(errors.into()) }
}

/// Adds the grasped obstacles to the moving bodies; returns their payloads.
fn follow(
    mut held: Vec<GraspedBody<'_>>,
    description: &RobotDescription,
    trajectory: &Trajectory,
    obstacles: &[Obstacle],
    bodies: &mut Vec<MovingBody>,
) -> Result<Vec<RunPayload>, Findings> {
    let (mut payloads, mut errors) = (Vec::new(), Vec::new());
    // By body and time: `chunk_by` joins neighbours only, and the poses of one body follow from its grasp before.
    held.sort_by(|a, b| a.obstacle.cmp(&b.obstacle).then(a.grasp.from_s.total_cmp(&b.grasp.from_s)));
    for of_body in held.chunk_by(|a, b| a.obstacle == b.obstacle) {
        match of_one_body(of_body, description, trajectory, &obstacles[of_body[0].obstacle]) {
            Ok(found) => payloads.extend(found),
            Err(error) => errors.push(error),
        }
        let grasps = of_body.iter().map(|held| held.grasp).collect();
        bodies.push(MovingBody { obstacle: of_body[0].obstacle, track: BodyTrack::Grasps(grasps) });
    }
    if errors.is_empty() { Ok(payloads) } else { Err(errors.into()) }
}

fn grasp(
    settings: &GraspSettings,
    place: FilePlace<'_>,
    description: &RobotDescription,
    obstacles: &[Obstacle],
) -> Result<(usize, Grasp), Diagnostic> {
    let unknown = |key: &str, message: String, known: String| {
        place.key(key).mark(Diagnostic::error(codes::scenario::GRASP, message).with_help(known))
    };
    let names = || obstacles.iter().map(|obstacle| obstacle.name.as_str());
    let obstacle = names().position(|name| name == settings.body).ok_or_else(|| {
        let message = format!("no obstacle is named \"{}\"", settings.body);
        unknown("body", message, known_names(&settings.body, "obstacles", names()))
    })?;
    let robot = &description.robot;
    let link = match &settings.link {
        None => description.tip,
        Some(name) => robot.find_link(name).ok_or_else(|| {
            let links = robot.links().iter().map(|link| link.name.as_str());
            let message = format!("robot \"{}\" has no link \"{name}\"", robot.name());
            unknown("link", message, known_names(name, "links", links))
        })?,
    };
    if let Some(mass_kg) = settings.mass_kg.filter(|&mass_kg| mass_kg > HEAVIEST_KG) {
        let message = format!("\"{}\": {}", settings.body, too_heavy(mass_kg));
        return Err(place.key("mass_kg").mark(Diagnostic::error(codes::scenario::GRASP, message)));
    }
    settings.reach().examine(place)?;
    let of_the_mass = [("inertia_kg_m2", settings.inertia_kg_m2), ("com_m", settings.com_m)];
    let without_mass =
        of_the_mass.into_iter().find(|(_, given)| given.is_some() && settings.mass_kg.is_none());
    if let Some((key, _)) = without_mass {
        let message = format!("`{key}` of \"{}\" has no effect without `mass_kg`", settings.body);
        let error = Diagnostic::error(codes::scenario::GRASP, message);
        return Err(place.key(key).mark(error.with_help(format!("give `mass_kg`, or remove `{key}`"))));
    }
    let (from_s, until_s) = (settings.from_s, settings.until_s.unwrap_or(f64::INFINITY));
    if until_s <= from_s {
        let message =
            format!("\"{}\": until_s = {until_s} s must be later than from_s = {from_s} s", settings.body);
        return Err(place.key("until_s").mark(Diagnostic::error(codes::scenario::GRASP, message)));
    }
    Ok((obstacle, Grasp { link, from_s, until_s }))
}

/// Follows one body along the planned motions: its pose in the link is that of the plan, in which the arm is exactly at its
/// setpoint. Clearance and recording use the pose at which the arm really takes the body.
fn of_one_body(
    held: &[GraspedBody<'_>],
    description: &RobotDescription,
    trajectory: &Trajectory,
    obstacle: &Obstacle,
) -> Result<Vec<RunPayload>, Diagnostic> {
    // In the order of time, so that neighbours suffice.
    let overlap = held.windows(2).find(|pair| pair[1].grasp.from_s < pair[0].grasp.until_s);
    if let Some(pair) = overlap {
        let message = format!(
            "\"{}\": from_s = {} s is before the end of its previous grasp at {} s",
            obstacle.name, pair[1].grasp.from_s, pair[0].grasp.until_s
        );
        let error = Diagnostic::error(codes::scenario::GRASP, message).with_help(
            "only one link carries a body at a time: change `from_s`, or `until_s` of the previous grasp",
        );
        return Err(pair[1].place.key("from_s").mark(error));
    }
    examine_reach(held, description, trajectory, obstacle)?;
    // Without a mass nothing loads the robot, so the plan is not needed: a body may be taken after a servo.
    if held.iter().all(|held| held.settings.mass_kg.is_none()) {
        return Ok(Vec::new());
    }
    let tree = UrdfTree::new(&description.robot);
    let link_at = |link: LinkIndex,
                   time_s: f64,
                   place: FilePlace<'_>|
     -> Result<Isometry3<f64>, Diagnostic> {
        let q = trajectory.planned_at(time_s).ok_or_else(|| {
            let message =
                format!("the position of the mass in the link is unknown at {time_s} s, after the start of a servo_tcp");
            let help = "take the body before the servo_tcp, or remove `mass_kg`";
            place.key("from_s").mark(Diagnostic::error(codes::scenario::GRASP, message).with_help(help))
        })?;
        let pose = tree.root_from_link(&q, link);
        pose.map(|pose| pose.to_isometry())
            .map_err(|error| place.mark(Diagnostic::error(codes::scenario::GRASP, error.to_string())))
    };
    let mut world_from_obstacle = obstacle.world_from_obstacle;
    let mut payloads = Vec::new();
    for (index, GraspedBody { grasp, settings, place, .. }) in held.iter().enumerate() {
        let link_from_obstacle = link_at(grasp.link, grasp.from_s, *place)?.inv_mul(&world_from_obstacle);
        if let Some(mass_kg) = settings.mass_kg {
            let inertia =
                inertia(settings, mass_kg, &obstacle.geometry).map_err(|error| place.mark(error))?;
            let link_from_inertial = link_from_obstacle * inertia.link_from_inertial;
            let carried =
                CarriedBody { link: grasp.link, inertia: Inertia { link_from_inertial, ..inertia } };
            let (from_s, until_s) = (grasp.from_s, grasp.until_s);
            payloads.push(RunPayload { name: obstacle.name.clone(), carried, from_s, until_s });
        }
        // Where it is put down matters only if it is taken again; the time may be infinite for the last grasp.
        if index + 1 < held.len() {
            world_from_obstacle = link_at(grasp.link, grasp.until_s, *place)? * link_from_obstacle;
        }
    }
    Ok(payloads)
}

/// The inertia in the frame of the obstacle.
fn inertia(settings: &GraspSettings, mass_kg: f64, geometry: &Geometry) -> Result<Inertia, Diagnostic> {
    let refused = |message: &str, help: &str| {
        Err(Diagnostic::error(codes::scenario::GRASP_INERTIA, message).with_help(help.to_owned()))
    };
    let diagonal = if let Some(given) = settings.inertia_kg_m2 {
        let sum: f64 = given.iter().sum();
        // 1e-9: rounding of a plate, whose largest moment is the sum of the others.
        if given.iter().any(|&moment| 2.0 * moment > sum * (1.0 + 1e-9)) {
            let help = "each of the three moments must be at most the sum of the other two";
            return refused("no body has this `inertia_kg_m2`", help);
        }
        Vector3::from(given)
    } else {
        match geometry {
            Geometry::Box { size_m } => {
                // Ixx = m (y^2 + z^2) / 12.
                let squares = size_m.component_mul(size_m);
                (Vector3::repeat(squares.sum()) - squares) * (mass_kg / 12.0)
            }
            // Solid bodies of constant density.
            Geometry::Sphere { radius_m } => Vector3::repeat(0.4 * mass_kg * radius_m * radius_m),
            Geometry::Cylinder { radius_m, length_m } => {
                let across = mass_kg * (3.0 * radius_m * radius_m + length_m * length_m) / 12.0;
                Vector3::new(across, across, mass_kg * radius_m * radius_m / 2.0)
            }
            Geometry::Ellipsoid { semi_axes_m } => {
                // Ixx = m (b^2 + c^2) / 5.
                let squares = semi_axes_m.component_mul(semi_axes_m);
                (Vector3::repeat(squares.sum()) - squares) * (mass_kg / 5.0)
            }
            Geometry::Mesh(_) => {
                let help = "give `inertia_kg_m2`, and `com_m` if it is not at the origin of the mesh";
                return refused("the inertia of a mesh is not known", help);
            }
        }
    };
    let com = Vector3::from(settings.com_m.unwrap_or_default());
    if !com.iter().all(|entry| entry.abs() <= spaces::LARGEST_M) {
        return refused(
            "`com_m` is not finite, or beyond the limit of 100000 m",
            "give three coordinates in metres",
        );
    }
    let link_from_inertial =
        Isometry3::from_parts(Translation3::from(com), nalgebra::UnitQuaternion::identity());
    Ok(Inertia { mass_kg, link_from_inertial, tensor_kg_m2: Matrix3::from_diagonal(&diagonal) })
}
