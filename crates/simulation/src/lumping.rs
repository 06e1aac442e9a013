//! Bodies: links that are connected by fixed joints move as one, with one mass. Pure nalgebra.

use congruent_description::{Inertia, JointKind, LinkIndex, Robot};
use nalgebra::Isometry3;

/// The body that a link is fixed to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LinkOnBody {
    pub body: usize,
    pub body_from_link: Isometry3<f64>,
    /// The link whose frame is the body's: its pose needs no product.
    pub is_first: bool,
}

/// The bodies of a robot: body 0 holds the root, body `i + 1` hangs on movable joint `i`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bodies {
    /// In the order of [`Robot::links`].
    pub links: Vec<LinkOnBody>,
    /// Inertia of each body, in the axes of its first link; zero if none of its links has an inertia.
    pub inertias: Vec<Inertia>,
}

impl Bodies {
    pub(crate) fn lumped(robot: &Robot) -> Self {
        let mut links: Vec<LinkOnBody> = Vec::with_capacity(robot.links().len());
        for link in robot.link_indices() {
            links.push(place(robot, link, &links));
        }
        let inertias = (0..=robot.dof()).map(|body| inertia(robot, body, &links)).collect();
        Self { links, inertias }
    }
}

/// Parents come before children, so `before` holds the parent.
fn place(robot: &Robot, link: LinkIndex, before: &[LinkOnBody]) -> LinkOnBody {
    let first_of = |body| LinkOnBody { body, body_from_link: Isometry3::identity(), is_first: true };
    let Some(index) = robot.parent_joint(link) else {
        return first_of(0);
    };
    let joint = robot.joint(index);
    if joint.kind == JointKind::Fixed {
        let parent = before[joint.parent.get()];
        let body_from_link = parent.body_from_link * joint.parent_from_joint;
        return LinkOnBody { body: parent.body, body_from_link, is_first: false };
    }
    // Body 0 is the root's.
    first_of(robot.coordinate(index).expect("a movable joint has a coordinate") + 1)
}

fn inertia(robot: &Robot, body: usize, links: &[LinkOnBody]) -> Inertia {
    let on_body = links.iter().zip(robot.links()).filter(move |(place, _)| place.body == body);
    // Links without inertia add nothing; a body of such links alone is found later by the mass matrix.
    Inertia::sum_of_parts(on_body.filter_map(|(place, link)| Some((place.body_from_link, link.inertia?))))
}

#[cfg(test)]
mod tests {
    use congruent_description::{JointParts, Link};
    use nalgebra::{Matrix3, Vector3};

    use super::*;

    /// Sums of a few products of order 1; rounding, 4 eps; worst seen 4.5e-16.
    const ROUNDING: f64 = 1e-15;

    fn point_mass(name: &str, at_m: Vector3<f64>) -> Link {
        let link_from_inertial = Isometry3::new(at_m, Vector3::new(0.4, -0.2, 0.9));
        let inertia = Inertia { mass_kg: 1.0, link_from_inertial, tensor_kg_m2: Matrix3::zeros() };
        Link { name: name.into(), inertia: Some(inertia), ..Link::default() }
    }

    #[test]
    fn links_on_fixed_joints_are_one_body() {
        let root_link = Link { name: "root".into(), ..Link::default() };
        // b is at (1, 2, 0) in a, turned by 90 deg about z: its (0, 2, 0) is a's (-1, 2, 0).
        let quarter_turn = Vector3::z() * std::f64::consts::FRAC_PI_2;
        let a_from_b = Isometry3::new(Vector3::new(1.0, 2.0, 0.0), quarter_turn);
        let links = vec![
            root_link,
            point_mass("a", Vector3::new(1.0, 2.0, 0.0)),
            point_mass("b", Vector3::new(0.0, 2.0, 0.0)),
        ];
        let joints = vec![
            JointParts::new("turn", JointKind::Revolute, "root", "a", Isometry3::translation(5.0, 6.0, 7.0)),
            JointParts::new("fixed", JointKind::Fixed, "a", "b", a_from_b),
        ];
        let bodies = Bodies::lumped(&Robot::new("two", links, joints).unwrap());

        assert_eq!(bodies.links.iter().map(|link| link.body).collect::<Vec<_>>(), [0, 1, 1]);
        assert_eq!(bodies.inertias[0].mass_kg.to_bits(), 0.0_f64.to_bits());
        let body = bodies.inertias[1];
        assert_eq!(body.mass_kg.to_bits(), 2.0_f64.to_bits());
        assert!((body.link_from_inertial.translation.vector - Vector3::new(0.0, 2.0, 0.0)).amax() < ROUNDING);
        let expected = Matrix3::from_diagonal(&Vector3::new(0.0, 2.0, 2.0));
        assert!((body.tensor_kg_m2 - expected).amax() < ROUNDING, "{}", body.tensor_kg_m2);
    }
}
