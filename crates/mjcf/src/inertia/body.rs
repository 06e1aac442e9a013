//! Mass properties of bodies: stated or inferred, then bounded, balanced and scaled by the settings of the compiler.

use congruent_input::Diagnostic;
use nalgebra::{Matrix3, Vector3};

use super::{
    mesh::MeshMass,
    primitive::{MjFill, primitive},
    tensor::{is_possible, moments, shifted, with_moments},
};
use crate::{
    codes,
    model::{MjBody, MjGeom, MjGeomMass, MjInference, MjMesh, MjModel, MjShape},
};

/// Least mass and moment of a body that moves, kg and kg m^2. Source: `mjMINVAL` of MuJoCo 4.0.
const LEAST: f64 = 1e-14;

/// Mass, centre and inertia of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct MjMassProperties {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass in the body, m.
    pub center_in_body: Vector3<f64>,
    /// Inertia about the centre of mass, in the axes of the body, kg m^2.
    pub inertia_kg_m2: Matrix3<f64>,
}

impl MjMassProperties {
    fn none() -> Self {
        Self { mass_kg: 0.0, center_in_body: Vector3::zeros(), inertia_kg_m2: Matrix3::zeros() }
    }
}

impl MjModel {
    /// Mass properties of all bodies as MuJoCo compiles them; the world has none. Bodies are not joined with those that are
    /// fixed to them, whatever `fusestatic` says.
    ///
    /// `mesh_mass` gives amount and inertia of a mesh: it has to find its triangles
    /// ([`mesh_mass`](crate::mesh_mass) does the rest).
    ///
    /// # Errors
    /// The inertia of a mesh cannot be computed, or a geom has a shape whose sizes are not known.
    pub fn mass_properties(
        &self,
        mesh_mass: &mut dyn FnMut(&MjMesh) -> Result<MeshMass, Diagnostic>,
    ) -> Result<Vec<MjMassProperties>, Diagnostic> {
        let mut meshes: Vec<Option<MeshMass>> = vec![None; self.meshes.len()];
        let mut of_mesh = |index: usize| -> Result<MeshMass, Diagnostic> {
            if let Some(known) = &meshes[index] {
                return Ok(known.clone());
            }
            let found = mesh_mass(&self.meshes[index])?;
            meshes[index] = Some(found.clone());
            Ok(found)
        };
        let mut all = vec![MjMassProperties::none()];
        for (index, body) in self.bodies.iter().enumerate().skip(1) {
            all.push(compiled(body, self.geoms_of(index), &mut of_mesh)?);
        }
        let sum: f64 = all.iter().map(|body| body.mass_kg).sum();
        if let Some(total) = self.total_mass_kg.as_ref().filter(|_| sum > 0.0) {
            let factor = total.value / sum;
            for body in &mut all {
                body.mass_kg *= factor;
                body.inertia_kg_m2 *= factor;
            }
        }
        Ok(all)
    }
}

impl MjModel {
    /// The geoms that the mass of a body follows from; none if its `<inertial>` states it, or if it has no mass.
    pub fn geoms_of_mass(&self, body: usize) -> Vec<&MjGeom> {
        inferring(&self.bodies[body], self.geoms_of(body)).unwrap_or_default()
    }
}

type MjMeshes<'a> = dyn FnMut(usize) -> Result<MeshMass, Diagnostic> + 'a;

fn compiled(
    body: &MjBody,
    geoms: &[MjGeom],
    meshes: &mut MjMeshes<'_>,
) -> Result<MjMassProperties, Diagnostic> {
    let stated = || {
        body.inertial.as_ref().map(|inertial| {
            let axes = inertial.body_from_inertial.rotation.to_rotation_matrix();
            let bounded = bounded(body, &inertial.inertia.value);
            MjMassProperties {
                mass_kg: inertial.mass.value,
                center_in_body: inertial.body_from_inertial.translation.vector,
                inertia_kg_m2: axes * bounded * axes.inverse(),
            }
        })
    };
    let mut found = match inferring(body, geoms) {
        Some(geoms) => {
            let found = from_geoms(&geoms, meshes)?;
            MjMassProperties { inertia_kg_m2: bounded(body, &found.inertia_kg_m2), ..found }
        }
        None => stated().unwrap_or_else(|| MjMassProperties {
            inertia_kg_m2: bounded(body, &Matrix3::zeros()),
            ..MjMassProperties::none()
        }),
    };
    found.mass_kg = found.mass_kg.max(body.inertia_rules.least_mass_kg);
    Ok(found)
}

/// The geoms that the mass follows from; `None` if it does not follow from geoms.
fn inferring<'a>(body: &MjBody, geoms: &'a [MjGeom]) -> Option<Vec<&'a MjGeom>> {
    let rules = body.inertia_rules;
    let is_inferred = match rules.inference {
        MjInference::Never => false,
        MjInference::WithoutInertial => body.inertial.is_none(),
        MjInference::Always => true,
    };
    let [first, last] = rules.groups;
    let counts = |geom: &&MjGeom| (first..=last).contains(&geom.group) && stated_mass(geom) > 0.0;
    let found: Vec<&MjGeom> = geoms.iter().filter(counts).collect();
    (is_inferred && !found.is_empty()).then_some(found)
}

/// Mass or density.
fn stated_mass(geom: &MjGeom) -> f64 {
    match geom.mass.value {
        MjGeomMass::Mass(value) | MjGeomMass::Density(value) => value,
    }
}

/// Bounds, then balance, as MuJoCo: of the principal moments.
fn bounded(body: &MjBody, inertia: &Matrix3<f64>) -> Matrix3<f64> {
    let rules = body.inertia_rules;
    let bound = |moments: Vector3<f64>| moments.map(|moment| moment.max(rules.least_moment_kg_m2));
    let found = bound(moments(inertia));
    if found == moments(inertia) && is_possible(&found, 0.0) {
        return *inertia;
    }
    let is_replaced = rules.is_balanced && !is_possible(&found, 0.0);
    with_moments(inertia, |moments| {
        let found = bound(moments);
        if is_replaced { Vector3::repeat(found.mean()) } else { found }
    })
}

fn from_geoms(geoms: &[&MjGeom], meshes: &mut MjMeshes<'_>) -> Result<MjMassProperties, Diagnostic> {
    let parts = geoms.iter().map(|geom| of_geom(geom, meshes)).collect::<Result<Vec<_>, _>>()?;
    let mass_kg: f64 = parts.iter().map(|part| part.mass_kg).sum();
    if mass_kg < LEAST {
        return Ok(MjMassProperties::none());
    }
    let first: Vector3<f64> = parts.iter().map(|part| part.center_in_body * part.mass_kg).sum();
    let center_in_body = first / mass_kg;
    let about = |part: &MjMassProperties| {
        shifted(&part.inertia_kg_m2, part.mass_kg, &(part.center_in_body - center_in_body))
    };
    Ok(MjMassProperties { mass_kg, center_in_body, inertia_kg_m2: parts.iter().map(about).sum() })
}

fn of_geom(geom: &MjGeom, meshes: &mut MjMeshes<'_>) -> Result<MjMassProperties, Diagnostic> {
    let fill = if geom.is_shell { MjFill::Surface } else { MjFill::Volume };
    let shape = match (&geom.shape, primitive(&geom.shape, fill)) {
        (_, Some(primitive)) => MeshMass {
            amount: primitive.amount,
            center: Vector3::zeros(),
            inertia: Matrix3::from_diagonal(&(primitive.moments_per_mass * primitive.amount)),
        },
        (MjShape::Mesh { mesh }, _) => meshes(*mesh)?,
        _ => {
            let message = "the mass of a shape that is fitted to a mesh is not computed".to_owned();
            let help = "give the body an <inertial>, or the geom the type mesh";
            return Err(geom.place.fault(codes::mjcf::MESH_INERTIA, message).with_help(help));
        }
    };
    if shape.amount <= 0.0 {
        return Ok(MjMassProperties::none());
    }
    let density = match geom.mass.value {
        MjGeomMass::Mass(mass) => mass / shape.amount,
        MjGeomMass::Density(density) => density,
    };
    let axes = geom.body_from_geom.rotation.to_rotation_matrix();
    Ok(MjMassProperties {
        mass_kg: density * shape.amount,
        center_in_body: (geom.body_from_geom * nalgebra::Point3::from(shape.center)).coords,
        inertia_kg_m2: axes * shape.inertia * density * axes.inverse(),
    })
}

/// The bodies that move and, with what is fixed to them, have no mass or no inertia. What follows from a mesh counts as some.
pub fn moving_body_without_mass(model: &MjModel) -> Vec<usize> {
    let mut has_mass: Vec<bool> = (0..model.bodies.len())
        .map(|index| may_have_mass(&model.bodies[index], model.geoms_of(index)))
        .collect();
    let moves = |index: usize| !model.bodies[index].joints.is_empty();
    // Parents are before their children, so a fixed body passes its mass on before its parent is asked.
    for index in (1..model.bodies.len()).rev() {
        if let Some(parent) = model.bodies[index].parent.filter(|_| has_mass[index] && !moves(index)) {
            has_mass[parent] = true;
        }
    }
    (1..model.bodies.len()).filter(|&index| moves(index) && !has_mass[index]).collect()
}

/// Whether a body itself has mass and inertia, as far as that is known without meshes.
fn may_have_mass(body: &MjBody, geoms: &[MjGeom]) -> bool {
    let mut has_mesh = false;
    let mut of_mesh = |_: usize| {
        has_mesh = true;
        Ok(MeshMass { amount: 1.0, center: Vector3::zeros(), inertia: Matrix3::identity() })
    };
    match compiled(body, geoms, &mut of_mesh) {
        // A shape whose size is not known.
        Err(_) => true,
        Ok(found) => has_mesh || (found.mass_kg >= LEAST && moments(&found.inertia_kg_m2).min() >= LEAST),
    }
}
