//! Inertias that MuJoCo accepts: of each body alone possible, and not zero where a body moves.

use congruent_description::{Inertia, Link, Robot, nearest_possible_tensor, principal_moments};
use congruent_input::{Diagnostic, Diagnostics, display::quantity};
use nalgebra::{Isometry3, Matrix3};

use crate::{
    codes,
    mjcf::{LEAST, bodies, has_mass},
};

/// Relative to the largest principal moment. Kind: rounding of an eigenvalue problem; the writer removes it.
const ROUNDING: f64 = 1e-12;
/// Replaces inertias that no body has, and reports them.
pub(crate) fn possible(links: &mut [Link], diagnostics: &mut Diagnostics) {
    for Link { name, inertia, .. } in links {
        let Some(inertia) = inertia else { continue };
        let before = principal_moments(&inertia.tensor_kg_m2);
        let [least, middle, most] = before;
        let slack = ROUNDING * most.abs();
        if least >= -slack && least + middle >= most - slack {
            continue;
        }
        inertia.tensor_kg_m2 = nearest_possible_tensor(&inertia.tensor_kg_m2);
        let listed = |moments: [f64; 3]| moments.map(|moment| quantity(moment, "kg m2")).join(", ");
        let message = format!(
            "link \"{name}\": no body has the principal moments {}, so {} are written",
            listed(before),
            listed(principal_moments(&inertia.tensor_kg_m2))
        );
        let kind = "links have an inertia that no body has: the nearest possible one is written";
        diagnostics.push(Diagnostic::warning(codes::write::INERTIA, message).one_of(kind, &*name));
    }
}

/// Gives a tiny mass and inertia to links that move and have none, nor a link that is fixed to them, and reports them.
pub(crate) fn massive(robot: &Robot, links: &mut [Link], diagnostics: &mut Diagnostics) {
    let has_mass = has_mass(robot);
    for body in bodies(robot).iter().filter(|body| !body.joints.is_empty()) {
        let at = body.link.get();
        if has_mass[at] {
            continue;
        }
        let link = &mut links[at];
        let given = link.inertia.unwrap_or(Inertia {
            mass_kg: 0.0,
            link_from_inertial: Isometry3::identity(),
            tensor_kg_m2: Matrix3::zeros(),
        });
        let tensor_kg_m2 = given.tensor_kg_m2 + Matrix3::identity() * LEAST;
        link.inertia = Some(Inertia { mass_kg: given.mass_kg.max(LEAST), tensor_kg_m2, ..given });
        let name = &link.name;
        let message = format!(
            "link \"{name}\" moves without mass or inertia, which MuJoCo refuses: {LEAST:e} is written"
        );
        let kind = format!(
            "links move without mass or inertia, which MuJoCo refuses: {LEAST:e} kg and kg m2 are written"
        );
        let found = Diagnostic::warning(codes::write::MASSLESS, message).one_of(kind, name);
        diagnostics.push(found.with_help("give them an <inertial> before you simulate them"));
    }
}
