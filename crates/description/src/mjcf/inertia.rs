//! Mass and inertia of links, as MuJoCo compiles them from `<inertial>` or geoms.

use congruent_input::{Capability, Diagnostic, Diagnostics};
use congruent_mjcf::{
    MeshMass, MjBody, MjGeom, MjGeomMass, MjInference, MjMassProperties, MjModel, MjShape, MjWritten,
};
use congruent_robot::Inertia;
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};

use super::{mesh::ModelMeshes, placed::placed, rounding::of_inertial, tree::RobotParts};

/// Gives the links their inertia. A body whose inertia follows from a mesh that cannot be read has none, which stops forces
/// but no poses.
pub(super) fn add(
    model: &MjModel,
    parts: &mut RobotParts,
    meshes: &mut ModelMeshes<'_, '_>,
    diagnostics: &mut Diagnostics,
) {
    let mut unknown = vec![false; model.meshes.len()];
    let known = without_fitted(model, diagnostics);
    let model = known.as_ref().unwrap_or(model);
    let found = model.mass_properties(&mut |mesh| {
        // The reader hands out the mesh, of which only the position in the list is needed.
        let index = model.meshes.iter().position(|of| std::ptr::eq(of, mesh)).unwrap_or_default();
        Ok(meshes.mass(index, diagnostics).unwrap_or_else(|fault| {
            let message =
                format!("{}, so the inertia of bodies that follows from it is not known", fault.message);
            let found = Diagnostic { message, ..fault }.needed_by(Some(Capability::Physics));
            diagnostics.push(found.with_help("give the body an <inertial>, or the path of its mesh"));
            unknown[index] = true;
            // No amount: the geom counts nothing, and its body is left out below.
            MeshMass { amount: 0.0, center: Vector3::zeros(), inertia: Matrix3::zeros() }
        }))
    });
    let Some(found) = diagnostics.keep(found) else { return };
    for (index, (body, mass)) in model.bodies.iter().zip(&found).enumerate() {
        let is_unknown = model.geoms_of(index).iter().any(|geom| needs(body, geom, &unknown));
        let link = parts.link_of_body(index);
        link.inertia = inertia(mass).filter(|_| !is_unknown);
        // Of one that follows from geoms, or is scaled to a total mass, no digits are written.
        let written = body.inertial.as_ref().filter(|_| !is_inferred(body) && model.total_mass_kg.is_none());
        link.inertia_rounding = written.map(of_inertial).unwrap_or_default();
    }
}

/// The inertia of a link; `None` for a body without mass and inertia, as a frame.
fn inertia(mass: &MjMassProperties) -> Option<Inertia> {
    let is_some = mass.mass_kg > 0.0 || mass.inertia_kg_m2 != Matrix3::zeros();
    is_some.then(|| Inertia {
        mass_kg: mass.mass_kg,
        link_from_inertial: Isometry3::from_parts(
            Translation3::from(mass.center_in_body),
            UnitQuaternion::identity(),
        ),
        // Rounding may have made it asymmetric.
        tensor_kg_m2: (mass.inertia_kg_m2 + mass.inertia_kg_m2.transpose()) * 0.5,
    })
}

/// Whether the inertia of a body follows from geoms.
fn is_inferred(body: &MjBody) -> bool {
    match body.inertia_rules.inference {
        MjInference::Never => false,
        MjInference::WithoutInertial => body.inertial.is_none(),
        MjInference::Always => true,
    }
}

/// Whether the inertia of a body needs one of the meshes that could not be read.
fn needs(body: &MjBody, geom: &MjGeom, unknown: &[bool]) -> bool {
    let [first, last] = body.inertia_rules.groups;
    let is_unknown = matches!(geom.shape, MjShape::Mesh { mesh } if unknown[mesh]);
    is_inferred(body) && (first..=last).contains(&geom.group) && is_unknown
}

/// The model with geoms of no mass where inertias follow from shapes of unknown size, which are reported; `None` if there are
/// none, so that the model is as it is.
fn without_fitted(model: &MjModel, diagnostics: &mut Diagnostics) -> Option<MjModel> {
    let is_fitted = |geom: &MjGeom| {
        let body = &model.bodies[geom.body];
        matches!(geom.shape, MjShape::Fitted { .. }) && is_inferred(body) && has_mass(geom)
    };
    if !model.geoms.iter().any(is_fitted) {
        return None;
    }
    let mut known = model.clone();
    for (geom, of) in known.geoms.iter_mut().zip(&model.geoms).filter(|(_, of)| is_fitted(of)) {
        let body = &model.bodies[of.body].name;
        let message =
            format!("body \"{body}\": the mass of a shape that is fitted to a mesh is not computed");
        let found = Diagnostic::warning(congruent_mjcf::codes::mjcf::MESH_INERTIA, message)
            .needed_by(Some(Capability::Physics))
            .with_help("give the body an <inertial>, or the geom the type mesh");
        diagnostics.push(placed(found, &of.place));
        geom.mass = MjWritten::unwritten(MjGeomMass::Mass(0.0));
    }
    Some(known)
}

fn has_mass(geom: &MjGeom) -> bool {
    match geom.mass.value {
        MjGeomMass::Mass(value) | MjGeomMass::Density(value) => value > 0.0,
    }
}
