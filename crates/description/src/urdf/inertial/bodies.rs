//! Checks the inertias of moving bodies. Links that are fixed to each other are one body and are checked as one: frames
//! without mass, such as `tool0`, are normal on a body that has mass, and a body that cannot move needs none.

use std::{collections::BTreeMap, fmt::Write};

use congruent_input::{Capability, Diagnostic, Diagnostics, display::quantity, known_names, toml_key};
use congruent_robot::{Inertia, LinkIndex, Robot, principal_moments};
use nalgebra::Isometry3;
use roxmltree::Node;

use super::{
    possible::{Impossible, UNIT, suspicious_size},
    repair::{Repairs, nearest_possible_tensor},
};
use crate::{
    codes,
    urdf::node::{element, elements, place, tag},
};

/// Repairs the inertias that the robot file names, then reports impossible inertias and moving bodies without mass.
pub(in crate::urdf) fn judge(
    robot: &mut Robot,
    root: Node<'_, '_>,
    repairs: &Repairs,
    diagnostics: &mut Diagnostics,
) {
    // Repairs before the checks, which then see the repaired tensors.
    repair_inertias(robot, repairs, diagnostics);
    let nodes: BTreeMap<&str, Node<'_, '_>> =
        elements(root, "link").filter_map(|node| Some((node.attribute("name")?, node))).collect();
    let judge = InertiaCheck { robot, nodes, bodies: LinkBodies::from_robot(robot), diagnostics };
    judge.all();
}

/// Repairs the inertias that the robot file names.
pub(crate) fn repair_inertias(robot: &mut Robot, repairs: &Repairs, diagnostics: &mut Diagnostics) {
    for (name, at) in &repairs.links {
        let repair_finding = repair(robot, name).unwrap_or_else(|fault| fault).at(at.clone());
        diagnostics.push(match &repairs.source {
            Some(source) => repair_finding.in_file(source),
            None => repair_finding,
        });
    }
}

/// Replaces the tensor of a link by the nearest possible one.
fn repair(robot: &mut Robot, name: &str) -> Result<Diagnostic, Diagnostic> {
    let refused =
        |what: String| Diagnostic::error(codes::robot_file::INERTIA, format!("[inertia] {name}: {what}"));
    let Some(link) = robot.find_link(name) else {
        let links = robot.links().iter().map(|link| link.name.as_str());
        return Err(
            refused("the robot has no such link".to_owned()).with_help(known_names(name, "links", links))
        );
    };
    let Some(inertia) = robot.link(link).inertia else {
        return Err(refused(
            "the link has no <inertial> that could be read, so there is nothing to repair".to_owned(),
        )
        .with_help("give it an <inertial> with mass and inertia in the URDF"));
    };
    if inertia.mass_kg <= 0.0 {
        let what = format!(
            "its mass of {} is not positive, and a repair changes only the inertia",
            quantity(inertia.mass_kg, "kg")
        );
        return Err(refused(what).with_help("correct <mass> in the URDF"));
    }
    if Impossible::find(&inertia).is_none() {
        let message = format!(
            "[inertia] {name}: the inertia in the URDF is physically possible, so nothing is repaired"
        );
        return Ok(Diagnostic::warning(codes::robot_file::INERTIA, message).with_help("remove the line"));
    }
    let tensor_kg_m2 = nearest_possible_tensor(&inertia.tensor_kg_m2);
    let listed = |tensor| principal_moments(tensor).map(|moment| quantity(moment, UNIT)).join(", ");
    let message = format!(
        "link \"{name}\": inertia repaired: principal moments {} in the URDF, {} after the repair ({} apart in the Frobenius \
         norm)",
        listed(&inertia.tensor_kg_m2),
        listed(&tensor_kg_m2),
        quantity((tensor_kg_m2 - inertia.tensor_kg_m2).norm(), UNIT)
    );
    robot.set_inertia(link, Inertia { tensor_kg_m2, ..inertia });
    // The name in the words keeps repairs of different links apart: each has its own values to report.
    Ok(Diagnostic::warning(codes::robot_file::INERTIA, message)
        .one_of(format!("times {name} is repaired"), name))
}

/// The body of each link and its pose in it, in the order of the links; a body has the index of its first link.
struct LinkBodies(Vec<(usize, Isometry3<f64>)>);

impl LinkBodies {
    fn from_robot(robot: &Robot) -> Self {
        let mut bodies: Vec<(usize, Isometry3<f64>)> = Vec::with_capacity(robot.links().len());
        // Parents come first, so a link's body is known when the link is reached.
        for link in robot.link_indices() {
            let above = robot.parent_joint(link).map(|joint| robot.joint(joint));
            bodies.push(match above {
                Some(joint) if !joint.kind.is_movable() => {
                    let (body, body_from_parent) = bodies[joint.parent.get()];
                    (body, body_from_parent * joint.parent_from_joint)
                }
                // A body has the number of its first link.
                _ => (link.get(), Isometry3::identity()),
            });
        }
        Self(bodies)
    }

    fn inertia(&self, robot: &Robot, body: usize) -> Inertia {
        let on_body = self.0.iter().zip(robot.links()).filter(move |((of, _), _)| *of == body);
        Inertia::sum_of_parts(
            on_body.filter_map(|((_, body_from_link), link)| Some((*body_from_link, link.inertia?))),
        )
    }
}

struct InertiaCheck<'a, 'd> {
    robot: &'a Robot,
    nodes: BTreeMap<&'a str, Node<'a, 'a>>,
    bodies: LinkBodies,
    diagnostics: &'d mut Diagnostics,
}

impl InertiaCheck<'_, '_> {
    fn all(mut self) {
        let robot = self.robot;
        let impossible: Vec<(LinkIndex, Impossible)> = robot
            .link_indices()
            .filter_map(|link| Some((link, Impossible::find(robot.link(link).inertia.as_ref()?)?)))
            .collect();
        // Only the sum of a body counts in the simulation: an impossible tensor of one link does no harm if the body that the
        // link is part of has a possible one.
        let mut sums = BTreeMap::new();
        for (link, _) in &impossible {
            let (body, _) = self.bodies.0[link.get()];
            sums.entry(body).or_insert_with(|| Impossible::find(&self.bodies.inertia(robot, body)).is_none());
        }
        let stops = |link: LinkIndex| {
            let (body, _) = self.bodies.0[link.get()];
            // Body 0 holds the root link and cannot move.
            body != 0 && !sums[&body]
        };
        let (stopping, harmless): (Vec<_>, Vec<_>) = impossible.iter().partition(|(link, _)| stops(*link));
        let help = repair_help(
            stopping
                .iter()
                .map(|(link, _)| robot.link(*link))
                .map(|link| (link.name.as_str(), link.inertia.is_some_and(|inertia| inertia.mass_kg > 0.0))),
        );
        for (link, fault) in stopping {
            self.impossible(link, fault, Some((Capability::Physics, &help)));
        }
        for (link, fault) in harmless {
            self.impossible(link, fault, None);
        }
        self.sizes();
        self.massless(&sums);
    }

    fn impossible(&mut self, link: LinkIndex, fault: Impossible, stops: Option<(Capability, &str)>) {
        let name = self.robot.link(link).name.as_str();
        let (but, kind_but) = match stops {
            Some(_) => ("", ""),
            None if self.bodies.0[link.get()].0 == 0 => {
                ("; the link cannot move, so its inertia is not used", ", and cannot move")
            }
            None => (
                "; together with the links fixed to it the inertia is possible",
                ", but a possible one together with the links fixed to them",
            ),
        };
        let message = format!("link \"{name}\": {}{but}", fault.message());
        let kind = format!("{}{kind_but}", fault.kind());
        let found =
            Diagnostic::error(fault.code(), message).one_of(kind, name).needed_by(stops.map(|stops| stops.0));
        let found = match stops {
            Some((_, help)) => found.with_help(help),
            None => found,
        };
        self.report(found, name, fault.element());
    }

    /// Reports at an element of a link's `<inertial>`, or at the link.
    fn report(&mut self, found: Diagnostic, name: &str, child: &str) {
        let node = self.nodes.get(name);
        let inertial = node.and_then(|node| element(*node, "inertial"));
        let at = inertial.map(|inertial| place(inertial, child)).or(node.map(|node| tag(*node)));
        self.diagnostics.push(found.at(at.unwrap_or(0..0)));
    }

    fn sizes(&mut self) {
        for link in self.robot.links() {
            if let Some((inertia, what)) =
                link.inertia.as_ref().and_then(|inertia| Some((inertia, suspicious_size(inertia)?)))
            {
                let help = if inertia.is_example() {
                    "1 kg m^2 about every axis is a placeholder: give the inertia of a box of the link's size"
                } else {
                    "is the value in kg mm^2 instead of kg m^2?"
                };
                let found =
                    Diagnostic::warning(codes::urdf::INERTIA_SIZE, format!("link \"{}\": {what}", link.name))
                        .one_of("links have an inertia that is far too large for their mass", &link.name)
                        .with_help(help);
                self.report(found, &link.name, "inertia");
            }
        }
    }

    /// Warns of moving bodies without mass, unless an impossible inertia of theirs was reported already.
    fn massless(&mut self, judged: &BTreeMap<usize, bool>) {
        let mut mass_kg = vec![0.0; self.robot.links().len()];
        for ((body, _), link) in self.bodies.0.iter().zip(self.robot.links()) {
            mass_kg[*body] += link.inertia.map_or(0.0, |inertia| inertia.mass_kg);
        }
        for (index, link) in self.robot.links().iter().enumerate().skip(1) {
            // Only the first link of a body, and not one whose impossible inertia is an error already.
            if self.bodies.0[index].0 != index || mass_kg[index] > 0.0 || judged.get(&index) == Some(&false) {
                continue;
            }
            // An <inertial> that cannot be read was reported by the grammar already; a second warning would only hide it.
            let node = self.nodes.get(link.name.as_str());
            if node.is_some_and(|node| self.diagnostics.blocks_physics_within(&node.range())) {
                continue;
            }
            let what = if link.inertia.is_some() { "its mass is zero" } else { "has no <inertial>" };
            let message =
                format!("link \"{}\" moves but {what}: it cannot be simulated with forces", link.name);
            let at = node.map_or(0..0, |node| tag(*node));
            self.diagnostics.push(
                Diagnostic::warning(codes::urdf::MASSLESS, message)
                    .one_of(
                        "links move but have no mass, so they cannot be simulated with forces",
                        &link.name,
                    )
                    .at(at)
                    .with_help("give each link that moves an <inertial> with mass and inertia"),
            );
        }
    }
}

/// Help for impossible inertias: the lines of a robot file that repair these links. Each link comes with whether its mass is
/// positive, which a repair needs.
fn repair_help<'a>(links: impl Iterator<Item = (&'a str, bool)>) -> String {
    const MOST_LINES: usize = 40;
    let mut help = String::from("correct it in the URDF");
    let repairable: Vec<&str> =
        links.filter_map(|(name, has_mass)| has_mass.then_some(name)).take(MOST_LINES).collect();
    if !repairable.is_empty() {
        help.push_str(", or use the nearest possible inertia with these lines in robot.toml:\n[inertia]");
    }
    for name in repairable {
        let _ = write!(help, "\n{} = \"repair\"", toml_key(name));
    }
    help
}
