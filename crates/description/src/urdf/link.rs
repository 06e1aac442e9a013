//! `<link>`: mass, inertia and shapes of one link.

use congruent_input::Capability;
use congruent_robot::{Inertia, Link};
use nalgebra::Matrix3;
use roxmltree::Node;

use super::{
    node::{element, elements},
    pose,
    shape::ShapeReader,
    value_digits,
};

pub(super) fn read(link: &urdf_rs::Link, node: Node<'_, '_>, shapes: &mut ShapeReader<'_, '_>) -> Link {
    let written = element(node, "inertial");
    let inertia = written.map(|inertial| inertia(&link.inertial, inertial, shapes));
    let inertia_rounding = written.zip(inertia.as_ref()).map(|(node, of)| value_digits::of_inertia(node, of));
    let visuals = link
        .visual
        .iter()
        .zip(elements(node, "visual"))
        .flat_map(|(visual, node)| shapes.visual(visual, node))
        .collect();
    let collisions = link
        .collision
        .iter()
        .zip(elements(node, "collision"))
        .flat_map(|(collision, node)| shapes.collision(collision, node))
        .collect();
    let inertia_rounding = inertia_rounding.unwrap_or_default();
    Link { name: link.name.clone(), inertia, inertia_rounding, visuals, collisions }
}

/// The inertia as written. Whether a body can have it is checked later, when the links that are fixed to each other are known.
fn inertia(inertial: &urdf_rs::Inertial, node: Node<'_, '_>, shapes: &mut ShapeReader<'_, '_>) -> Inertia {
    let owner = node.parent_element().unwrap_or(node);
    let m = &inertial.inertia;
    let place = pose::OriginPlace { parent: node, owner, needed_by: Some(Capability::Physics) };
    Inertia {
        mass_kg: inertial.mass.value,
        link_from_inertial: pose::read(&inertial.origin, place, shapes.diagnostics),
        tensor_kg_m2: Matrix3::new(
            m.ixx, m.ixy, m.ixz, //
            m.ixy, m.iyy, m.iyz, //
            m.ixz, m.iyz, m.izz,
        ),
    }
}
