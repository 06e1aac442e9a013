//! Contacts: links against obstacles, never links against links. Shapes have no mass; mass comes from the
//! description's inertias only.

use congruent_description::{Geometry, HullPoints, Obstacle, Robot};
use rapier3d_f64::prelude::{
    Collider, ColliderBuilder, Group, InteractionGroups, InteractionTestMode, Pose, Rotation, SharedShape,
};

use super::ellipsoid::EllipsoidShape;
use crate::{
    adapter,
    error::SimulationError,
    lumping::{Bodies, LinkOnBody},
    settings::WorldSettings,
};

/// Group of the robot's links.
const LINKS: Group = Group::GROUP_1;
/// Group of the obstacles.
const OBSTACLES: Group = Group::GROUP_2;

/// Colliders of all moving links, each with the number of its body; the user data of each is its link.
pub(crate) fn link_colliders(
    robot: &Robot,
    bodies: &Bodies,
    settings: &WorldSettings,
) -> Result<Vec<(usize, Collider)>, SimulationError> {
    let mut colliders = Vec::new();
    for (index, (place, link)) in bodies.links.iter().zip(robot.links()).enumerate() {
        let LinkOnBody { body, body_from_link, .. } = place;
        // The root body is at rest, as obstacles are: the two never meet.
        let shapes = if *body == 0 { &[][..] } else { &link.collisions };
        for shape in shapes {
            let owner = || format!("link \"{}\"", link.name);
            let body_from_shape = adapter::pose(&(body_from_link * shape.link_from_shape));
            if let Some(builder) = shaped(&shape.geometry, body_from_shape, owner)? {
                let builder = surface(builder, settings).collision_groups(groups(LINKS, OBSTACLES));
                colliders.push((*body, builder.user_data(index as u128).build()));
            }
        }
    }
    Ok(colliders)
}

/// The collider of an obstacle, whose user data is its number; `None` for a mesh without a vertex.
pub(crate) fn obstacle_collider(
    number: usize,
    obstacle: &Obstacle,
    settings: &WorldSettings,
) -> Result<Option<Collider>, SimulationError> {
    let owner = || format!("obstacle \"{}\"", obstacle.name);
    let pose = adapter::pose(&obstacle.world_from_obstacle);
    let builder = shaped(&obstacle.geometry, pose, owner)?;
    let complete = |builder| {
        surface(builder, settings)
            .collision_groups(groups(OBSTACLES, LINKS))
            .user_data(number as u128)
            .build()
    };
    Ok(builder.map(complete))
}

/// Friction and restitution: the same on both sides, so that their mean is that of the contact.
fn surface(builder: ColliderBuilder, settings: &WorldSettings) -> ColliderBuilder {
    builder.friction(settings.contact_friction).restitution(settings.contact_restitution)
}

/// Whether a collider is of an obstacle, not of a link.
pub(crate) fn is_obstacle(collider: &Collider) -> bool {
    collider.collision_groups().memberships == OBSTACLES
}

fn groups(member: Group, meets: Group) -> InteractionGroups {
    // Both groups must agree: links meet obstacles, never each other, and obstacles never meet.
    InteractionGroups::new(member, meets, InteractionTestMode::And)
}

/// A collider of the shape, or `None` if a mesh is empty.
fn shaped(
    geometry: &Geometry,
    pose: Pose,
    owner: impl Fn() -> String,
) -> Result<Option<ColliderBuilder>, SimulationError> {
    let (shape, pose) = match geometry {
        Geometry::Box { size_m } => {
            let half = size_m * 0.5;
            (SharedShape::cuboid(half.x, half.y, half.z), pose)
        }
        Geometry::Sphere { radius_m } => (SharedShape::ball(*radius_m), pose),
        Geometry::Ellipsoid { semi_axes_m } => {
            let semi_axes_m = adapter::vector(semi_axes_m);
            (SharedShape::new(EllipsoidShape { semi_axes_m }), pose)
        }
        Geometry::Cylinder { radius_m, length_m } => {
            // Along z in a description, along y in rapier.
            let y_onto_z = Pose::from_rotation(Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
            (SharedShape::cylinder(length_m * 0.5, *radius_m), pose * y_onto_z)
        }
        Geometry::Mesh(mesh) if mesh.vertices_m.is_empty() => return Ok(None),
        Geometry::Mesh(mesh) => {
            let hull = SharedShape::convex_hull(&adapter::points(
                &HullPoints::from_vertices(&mesh.vertices_m).points_m,
            ));
            (hull.ok_or_else(|| SimulationError::Shape { owner: owner() })?, pose)
        }
    };
    // Without density: masses are those of the description, not of shapes.
    Ok(Some(ColliderBuilder::new(shape).position(pose).density(0.0)))
}
