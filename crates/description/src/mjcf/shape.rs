//! Geoms to shapes. A geom with a bit in `contype` or `conaffinity` collides. It is drawn if it does not collide, or if its group
//! is one of those that MuJoCo draws by default.

use congruent_input::{Capability, Diagnostic, Diagnostics, units::LARGEST};
use congruent_mjcf::{MjGeom, MjModel, MjShape};
use congruent_robot::{Geometry, Shape};
use nalgebra::{Isometry3, Vector3};

use super::{
    mesh::{ModelMeshes, scaled_from_mesh},
    placed::placed,
    tree::RobotParts,
};
use crate::codes;

/// The first group that MuJoCo does not draw unless a person asks for it.
const FIRST_HIDDEN_GROUP: i32 = 3;

/// Gives the links their shapes.
pub(super) fn add(
    model: &MjModel,
    parts: &mut RobotParts,
    meshes: &mut ModelMeshes<'_, '_>,
    diagnostics: &mut Diagnostics,
) {
    for (body, of) in model.bodies.iter().enumerate() {
        let is_moving = is_moving(model, body);
        for geom in model.geoms_of(body) {
            let collides = geom.contact_type != 0 || geom.contact_affinity != 0;
            let shapes = match shapes(model, geom, meshes, diagnostics) {
                Ok(shapes) => shapes,
                // A floor under the robot is no part of it.
                Err(_) if geom.shape == MjShape::Plane && !is_moving => continue,
                Err(fault) => {
                    let message = format!("body \"{}\": {}", of.name, fault.message);
                    let found = Diagnostic { message, ..fault };
                    diagnostics.push(found.needed_by(collides.then_some(Capability::Clearance)));
                    continue;
                }
            };
            let link = parts.link_of_body(body);
            if collides {
                link.collisions.extend(shapes.iter().cloned());
            }
            if !collides || geom.group < FIRST_HIDDEN_GROUP {
                link.visuals.extend(shapes);
            }
        }
    }
}

/// Whether a body or one that carries it has a joint.
fn is_moving(model: &MjModel, mut body: usize) -> bool {
    loop {
        match model.bodies[body].parent {
            _ if !model.bodies[body].joints.is_empty() => return true,
            Some(parent) => body = parent,
            None => return false,
        }
    }
}

/// The shapes of a geom: one, or three for a capsule.
fn shapes(
    model: &MjModel,
    geom: &MjGeom,
    meshes: &mut ModelMeshes<'_, '_>,
    diagnostics: &mut Diagnostics,
) -> Result<Vec<Shape>, Diagnostic> {
    let left_out = |what: &str| {
        let message = format!("a {what} cannot be expressed, so this geom is left out");
        let kind = format!("geoms are a {what}, which cannot be expressed, and are left out");
        placed(Diagnostic::warning(codes::mjcf::SHAPE, message).one_of(kind, name_of(geom)), &geom.place)
    };
    let at_center = |geometry: Geometry| vec![(Isometry3::identity(), geometry)];
    let parts = match geom.shape {
        MjShape::Sphere { radius } => at_center(Geometry::Sphere { radius_m: radius }),
        MjShape::Cylinder { radius, half_length } => {
            at_center(Geometry::Cylinder { radius_m: radius, length_m: 2.0 * half_length })
        }
        MjShape::Ellipsoid { radii } => at_center(Geometry::Ellipsoid { semi_axes_m: Vector3::from(radii) }),
        MjShape::Box { half_sizes } => at_center(Geometry::Box { size_m: Vector3::from(half_sizes) * 2.0 }),
        MjShape::Capsule { radius, half_length } => Geometry::capsule(radius, 2.0 * half_length),
        MjShape::Mesh { mesh } => {
            let found = meshes.find(mesh, diagnostics)?;
            vec![(scaled_from_mesh(&model.meshes[mesh]).inverse(), Geometry::Mesh(found))]
        }
        MjShape::Plane => return Err(left_out("plane")),
        MjShape::HeightField => return Err(left_out("height field")),
        MjShape::Fitted { ref kind, .. } => {
            return Err(left_out(&format!("{kind} that is fitted to a mesh")));
        }
    };
    let is_far = |extent_m: f64| extent_m.is_nan() || extent_m > LARGEST;
    if parts.iter().any(|(at, geometry)| is_far(extent_m(&(geom.body_from_geom * at), geometry))) {
        let message = format!("the geom reaches beyond {LARGEST:e} m, so it is left out");
        return Err(placed(Diagnostic::warning(codes::mjcf::SHAPE, message), &geom.place));
    }
    #[expect(clippy::cast_possible_truncation, reason = "a colour for the eye")]
    let color_rgba = geom.rgba.map(|rgba| rgba.map(|channel| channel.clamp(0.0, 1.0) as f32));
    let shape = |(geom_from_shape, geometry)| Shape {
        link_from_shape: geom.body_from_geom * geom_from_shape,
        geometry,
        color_rgba,
    };
    Ok(parts.into_iter().map(shape).collect())
}

fn name_of(geom: &MjGeom) -> String {
    if geom.name.is_empty() { "one without a name".to_owned() } else { geom.name.clone() }
}

/// How far the origin of a shape is away, or its largest size; a mesh was bounded when it was read.
fn extent_m(link_from_shape: &Isometry3<f64>, geometry: &Geometry) -> f64 {
    let size_m = match geometry {
        Geometry::Box { size_m } => size_m.amax(),
        Geometry::Cylinder { radius_m, length_m } => radius_m.max(*length_m),
        Geometry::Sphere { radius_m } => *radius_m,
        Geometry::Ellipsoid { semi_axes_m } => semi_axes_m.amax(),
        Geometry::Mesh(_) => 0.0,
    };
    link_from_shape.translation.vector.amax().max(size_m)
}
