//! `<link>`: mass, inertia and shapes of one link.

use nalgebra::{Matrix3, SymmetricEigen};
use roxmltree::Node;

use super::{
    node::{element, elements, label, place},
    pose,
    shape::ShapeReader,
};
use crate::{
    diagnostic::Diagnostic,
    model::{Inertia, Link},
};

/// Rounding in files: principal moments may miss a bound by so much of the largest one. Real
/// robots miss by up to 1e-4 if inertias are written with four digits.
const MOMENT: f64 = 1e-3;
/// No link of a robot has a larger radius of gyration: the tensor is taken for kg mm^2.
const LARGEST_GYRATION_M: f64 = 3.0;

pub(super) fn read(link: &urdf_rs::Link, node: Node<'_, '_>, shapes: &mut ShapeReader<'_, '_>) -> Link {
    let inertia = element(node, "inertial").map(|inertial| inertia(&link.inertial, inertial, shapes));
    let visuals = link
        .visual
        .iter()
        .zip(elements(node, "visual"))
        .filter_map(|(visual, node)| shapes.visual(visual, node))
        .collect();
    let collisions = link
        .collision
        .iter()
        .zip(elements(node, "collision"))
        .filter_map(|(collision, node)| shapes.collision(collision, node))
        .collect();
    Link { name: link.name.clone(), inertia, visuals, collisions }
}

fn inertia(inertial: &urdf_rs::Inertial, node: Node<'_, '_>, shapes: &mut ShapeReader<'_, '_>) -> Inertia {
    let owner = node.parent_element().unwrap_or(node);
    let mass_kg = inertial.mass.value;
    let m = &inertial.inertia;
    let tensor_kg_m2 = Matrix3::new(
        m.ixx, m.ixy, m.ixz, //
        m.ixy, m.iyy, m.iyz, //
        m.ixz, m.iyz, m.izz,
    );
    let mut report = |diagnostic: Diagnostic, child: &str| {
        let message = format!("{}: {}", label(owner), diagnostic.message);
        shapes.diagnostics.push(Diagnostic { message, ..diagnostic }.at(place(node, child)));
    };
    if mass_kg < 0.0 {
        report(Diagnostic::error("urdf::mass", format!("mass {mass_kg} is negative")), "mass");
    }
    if let Some(fault) = tensor_fault(mass_kg, &tensor_kg_m2) {
        report(fault, "inertia");
    }
    let link_from_inertial = pose::read(&inertial.origin, node, owner, shapes.diagnostics);
    Inertia { mass_kg, link_from_inertial, tensor_kg_m2 }
}

fn tensor_fault(mass_kg: f64, tensor_kg_m2: &Matrix3<f64>) -> Option<Diagnostic> {
    let [least, middle, most] = principal_moments(tensor_kg_m2);
    let slack = MOMENT * most.abs();
    if least < -slack || most < 0.0 {
        let message =
            format!("inertia is not positive definite: its smallest principal moment is {least:.4e}");
        return Some(Diagnostic::error("urdf::inertia", message));
    }
    if least + middle < most - slack {
        let message = format!(
            "inertia breaks the triangle inequality: principal moments {least:.4e} + {middle:.4e} < {most:.4e}"
        );
        return Some(
            Diagnostic::error("urdf::inertia", message)
                .with_help("no body has it: the largest principal moment is at most the sum of the others"),
        );
    }
    let gyration_m = (most / mass_kg).sqrt();
    (mass_kg > 0.0 && gyration_m > LARGEST_GYRATION_M).then(|| {
        let message = format!("inertia is that of a body with a radius of gyration of {gyration_m:.1} m");
        Diagnostic::warning("urdf::inertia_size", message).with_help("kg mm^2 instead of kg m^2?")
    })
}

/// In ascending order.
fn principal_moments(tensor_kg_m2: &Matrix3<f64>) -> [f64; 3] {
    // Entries near the largest double overflow inside the solver, which then never ends.
    let largest = tensor_kg_m2.amax();
    if largest == 0.0 {
        return [0.0; 3];
    }
    let mut moments: [f64; 3] =
        SymmetricEigen::new(tensor_kg_m2.map(|entry| entry / largest)).eigenvalues.into();
    moments.sort_by(f64::total_cmp);
    moments.map(|moment| moment * largest)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[track_caller]
    fn check(mass_kg: f64, moments: [f64; 3], expected: Option<&str>) {
        // Turned, so that no check can lean on a diagonal tensor.
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.2, 0.9);
        let tensor = turn * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.inverse();
        assert_eq!(tensor_fault(mass_kg, &tensor).map(|fault| fault.code), expected);
    }

    #[test]
    fn a_tensor_must_be_that_of_a_body() {
        check(1.0, [0.01, 0.01, 0.0004], None);
        check(1.0, [1.0, 1.0, 1.0], None);
        check(0.0001, [0.0, 0.0, 0.0], None);
        // A thin plate has equality, and files round.
        check(1.0, [0.010, 0.010, 0.020_001], None);
        check(1.0, [-0.04, 0.01, 0.05], Some("urdf::inertia"));
        check(1.0, [-0.01, -0.01, -0.01], Some("urdf::inertia"));
        check(1.0, [0.05, 0.01, 0.01], Some("urdf::inertia"));
        check(1.0, [1e-310, 1e-310, 1e-310], None);
        check(1.0, [1e307, 1e307, 1e307], Some("urdf::inertia_size"));
        check(1.3, [10_000.0, 10_000.0, 400.0], Some("urdf::inertia_size"));
    }
}
