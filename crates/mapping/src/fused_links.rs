//! Bodies whose mass two files write at different links: programs that fuse links write the sum of links that are fixed to each
//! other at one of them.

use std::collections::BTreeSet;

use congruent_description::{Inertia, InertiaRounding, Link, LinkIndex, Robot};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Matrix3, Vector3};

/// Links that one of two descriptions has as one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FusedLinks {
    /// The link that carries what the other file has elsewhere.
    pub link: String,
    /// The links that are fixed to it and have a mass in one of the files alone.
    pub with: Vec<String>,
}

/// The other robot with the mass of each body at the links where `robot` has it, if both have about the same mass there at
/// different links; and these bodies. Both have the same joints by name, in the same variables.
///
/// A link that is missing, such as a camera without which the body is as much lighter, is a difference and stays one.
pub fn with_masses_at_links_of([robot, other]: [&Robot; 2]) -> (Robot, Vec<FusedLinks>) {
    let trees = [robot, other].map(ScrewTree::new);
    let mut same = other.clone();
    let mut fused = Vec::new();
    for own in robot.link_indices().filter(|&link| robot.body(link) == link) {
        let joint = robot.parent_joint(own).map(|joint| &robot.joint(joint).name);
        let there = joint.map_or(Some(other.root()), |name| Some(other.joint(other.find_joint(name)?).child));
        let Some(there) = there.filter(|&there| other.body(there) == there) else { continue };
        let body = BodyPair { robots: [robot, other], trees: &trees, bodies: [own, there] };
        if let Some((changed, links)) = body.with_masses_moved(&same) {
            same = changed;
            fused.push(links);
        }
    }
    (same, fused)
}

/// One body of both descriptions, each named by the first of its links.
struct BodyPair<'a> {
    robots: [&'a Robot; 2],
    trees: &'a [ScrewTree; 2],
    bodies: [LinkIndex; 2],
}

/// A link with a mass.
#[derive(Clone, Copy)]
struct Part<'a> {
    link: &'a Link,
    body_from_link: Isometry3<f64>,
    inertia: Inertia,
    rounding: InertiaRounding,
}

impl BodyPair<'_> {
    /// The links of the body that have a mass in one of the descriptions, in the frame of the body of the first.
    fn parts(&self, of: usize) -> Vec<Part<'_>> {
        let robot = self.robots[of];
        let home = |of: usize, link: LinkIndex| self.trees[of].home(link).to_isometry();
        let body_from_root = home(0, self.bodies[0]).inverse();
        let part = |index: LinkIndex| {
            let inertia = robot.link(index).inertia.filter(|inertia| inertia.mass_kg > 0.0)?;
            let (link, body_from_link) = (robot.link(index), body_from_root * home(of, index));
            Some(Part { link, body_from_link, inertia, rounding: link.inertia_rounding })
        };
        let of_body = robot.link_indices().filter(|&link| robot.body(link) == self.bodies[of]);
        of_body.filter_map(part).collect()
    }

    /// `same` with the masses of this body where the robot has them; `None` if they are there, or if the sums differ by what
    /// one of the two lacks.
    fn with_masses_moved(&self, same: &Robot) -> Option<(Robot, FusedLinks)> {
        let [own, there] = [0, 1].map(|of| self.parts(of));
        let [names, other_names] = [&own, &there]
            .map(|parts| parts.iter().map(|part| part.link.name.as_str()).collect::<BTreeSet<&str>>());
        let alone: BTreeSet<&str> = names.symmetric_difference(&other_names).copied().collect();
        let mass_kg = |parts: &[Part<'_>], is_asked: &dyn Fn(&Part<'_>) -> bool| -> f64 {
            parts.iter().filter(|part| is_asked(part)).map(|part| part.inertia.mass_kg).sum()
        };
        let is_alone = |part: &Part<'_>| alone.contains(part.link.name.as_str());
        let alone_kg = mass_kg(&own, &is_alone) + mass_kg(&there, &is_alone);
        let apart_kg = mass_kg(&own, &|_| true) - mass_kg(&there, &|_| true);
        // Nearer to the sum than to a link that is missing.
        if apart_kg.abs() >= 0.5 * alone_kg || there.is_empty() {
            return None;
        }
        let carrier = own.iter().max_by(|a, b| a.inertia.mass_kg.total_cmp(&b.inertia.mass_kg))?;
        let rest: Vec<Part<'_>> =
            own.iter().filter(|part| part.link.name != carrier.link.name).copied().collect();
        let carried = remainder(carrier, &there, &rest)?;
        let parts: Vec<Part<'_>> = std::iter::once(carried).chain(rest).collect();
        let moved = self.moved(same, &parts)?;
        let with = alone.into_iter().filter(|name| *name != carrier.link.name).map(str::to_owned);
        Some((moved, FusedLinks { link: carrier.link.name.clone(), with: with.collect() }))
    }

    /// `same` with these masses alone on this body; `None` if one of the links is elsewhere there.
    fn moved(&self, same: &Robot, parts: &[Part<'_>]) -> Option<Robot> {
        let [body, there] = self.bodies;
        let other = self.robots[1];
        let is_of_body = |index: LinkIndex| other.body(index) == there;
        if parts.iter().any(|part| other.find_link(&part.link.name).is_some_and(|index| !is_of_body(index))) {
            return None;
        }
        let there_from_body =
            self.trees[1].home(there).to_isometry().inverse() * self.trees[0].home(body).to_isometry();
        let mut changed = same.with_links(|link| {
            let Some(index) = other.find_link(&link.name).filter(|&index| is_of_body(index)) else { return };
            link.inertia = None;
            let Some(part) = parts.iter().find(|part| part.link.name == link.name) else { return };
            let home = self.trees[1].home(index).to_isometry();
            let there_from_link = self.trees[1].home(there).to_isometry().inverse() * home;
            let link_from_part = there_from_link.inverse() * there_from_body * part.body_from_link;
            let inertial = link_from_part * part.inertia.link_from_inertial;
            link.inertia = Some(Inertia { link_from_inertial: inertial, ..part.inertia });
            link.inertia_rounding = part.rounding.expressed_in(&link_from_part.rotation);
        });
        for part in parts.iter().filter(|part| other.find_link(&part.link.name).is_none()) {
            let link = Link {
                name: part.link.name.clone(),
                inertia: Some(part.inertia),
                inertia_rounding: part.rounding,
                ..Link::default()
            };
            let there_from_link = there_from_body * part.body_from_link;
            changed = changed.with_fixed_link(&other.link(there).name, there_from_link, link);
        }
        Some(changed)
    }
}

/// What the carrier has if a body with all masses of `whole` has those of `rest` at other links; `None` if nothing is left of the
/// mass. Source: the parallel axis theorem, with the masses of `rest` counted negative.
fn remainder<'a>(carrier: &Part<'a>, whole: &[Part<'_>], rest: &[Part<'_>]) -> Option<Part<'a>> {
    let carrier_from_body = carrier.body_from_link.inverse();
    let negative = |inertia: Inertia| Inertia {
        mass_kg: -inertia.mass_kg,
        tensor_kg_m2: -inertia.tensor_kg_m2,
        ..inertia
    };
    let added = whole.iter().map(|part| (carrier_from_body * part.body_from_link, part.inertia));
    let removed = rest.iter().map(|part| (carrier_from_body * part.body_from_link, negative(part.inertia)));
    let sum = Inertia::sum_of_parts(added.chain(removed));
    if sum.mass_kg <= 0.0 {
        return None;
    }
    // In the axes of the one that is written, so that a rotation of the inertial frame that is left out still shows.
    let axes = match whole {
        [only] => (carrier_from_body * only.body_from_link * only.inertia.link_from_inertial).rotation,
        _ => carrier.inertia.link_from_inertial.rotation,
    };
    let com = sum.link_from_inertial.translation;
    let turn = axes.to_rotation_matrix();
    let inertia = Inertia {
        link_from_inertial: Isometry3::from_parts(com, axes),
        tensor_kg_m2: turn.matrix().transpose() * sum.tensor_kg_m2 * turn.matrix(),
        ..sum
    };
    let parts = whole.iter().chain(rest).map(|part| in_frame(part, &carrier_from_body));
    let rounding = rounding_of_sum(parts.collect(), &com.vector, sum.mass_kg);
    Some(Part { inertia, rounding, ..*carrier })
}

/// Mass, centre of mass and rounding of a part, in the axes of the carrier.
type RoundedMass = (f64, Vector3<f64>, InertiaRounding);

fn in_frame(part: &Part<'_>, carrier_from_body: &Isometry3<f64>) -> RoundedMass {
    let carrier_from_link = carrier_from_body * part.body_from_link;
    let com = (carrier_from_link * part.inertia.link_from_inertial).translation.vector;
    (part.inertia.mass_kg, com, part.rounding.expressed_in(&carrier_from_link.rotation))
}

/// The rounding of a sum of parts with this centre of mass and mass, to first order.
fn rounding_of_sum(parts: Vec<RoundedMass>, com: &Vector3<f64>, mass_kg: f64) -> InertiaRounding {
    let mut sum = InertiaRounding::default();
    for (part_kg, at, rounding) in parts {
        let arm = (at - com).abs();
        let moment = rounding.com_m * part_kg + arm * rounding.mass_kg;
        sum.mass_kg += rounding.mass_kg;
        sum.com_m += moment / mass_kg;
        // Of m (|d|^2 1 - d d^T), with d from the common centre of mass to that of the part.
        let of_mass = (Matrix3::identity() * arm.norm_squared() + arm * arm.transpose()) * rounding.mass_kg;
        let shift = rounding.com_m;
        let of_shift =
            Matrix3::identity() * (2.0 * arm.dot(&shift)) + arm * shift.transpose() + shift * arm.transpose();
        sum.tensor_kg_m2 += rounding.tensor_kg_m2 + of_mass + of_shift * part_kg;
    }
    sum
}

#[cfg(test)]
mod tests {
    use congruent_description::parse_urdf;

    use super::*;

    const HAND: &str = "<inertial><origin xyz='0.1 0.02 0'/><mass value='2'/>\
        <inertia ixx='0.02' iyy='0.03' izz='0.04' ixy='0.001' ixz='0' iyz='0'/></inertial>";
    const CAMERA: &str = "<inertial><origin xyz='0 0 0.03'/><mass value='0.5'/>\
        <inertia ixx='0.001' iyy='0.002' izz='0.002' ixy='0' ixz='0' iyz='0'/></inertial>";

    /// An arm whose camera is fixed to its hand, turned and shifted.
    fn with_camera(hand: &str, camera: &str) -> Robot {
        let text = format!(
            "<robot name='r'><link name='base'/><link name='hand'>{hand}</link><link name='camera'>{camera}</link>\
             <joint name='j' type='continuous'><parent link='base'/><child link='hand'/></joint>\
             <joint name='mount' type='fixed'><parent link='hand'/><child link='camera'/>\
             <origin xyz='0.2 -0.1 0.05' rpy='0.3 -0.4 0.5'/></joint></robot>"
        );
        parse_urdf(&text).unwrap()
    }

    /// The same arm with both as one link.
    fn fused() -> Robot {
        let whole = with_camera(HAND, CAMERA);
        let [hand, camera] = [1, 2].map(|at| whole.links()[at].inertia.unwrap());
        let parts = [(Isometry3::identity(), hand), (whole.joints()[1].parent_from_joint, camera)];
        with_camera(HAND, "").with_links(|link| {
            if link.name == "hand" {
                link.inertia = Some(Inertia::sum_of_parts(parts.iter().copied()));
            }
        })
    }

    fn masses_kg(robot: &Robot) -> Vec<f64> {
        robot.links().iter().map(|link| link.inertia.map_or(0.0, |of| of.mass_kg)).collect()
    }

    #[test]
    fn links_that_one_file_fuses_have_the_masses_of_the_other() {
        let (split, fused) = (with_camera(HAND, CAMERA), fused());
        for (own, there) in [(&split, &fused), (&fused, &split)] {
            let (same, links) = with_masses_at_links_of([own, there]);
            assert_eq!(links, [FusedLinks { link: "hand".to_owned(), with: vec!["camera".to_owned()] }]);
            assert_eq!(masses_kg(&same), masses_kg(own));
            for (same, own) in same.links().iter().zip(own.links()) {
                let Some((same, own)) = same.inertia.zip(own.inertia) else { continue };
                let off =
                    same.link_from_inertial.translation.vector - own.link_from_inertial.translation.vector;
                let of_tensor = same.tensor_in_link() - own.tensor_in_link();
                assert!(off.amax() < 1e-15 && of_tensor.amax() < 1e-15, "{off} {of_tensor}");
            }
        }
    }

    #[test]
    fn a_link_that_is_missing_is_a_difference() {
        let (whole, without) = (with_camera(HAND, CAMERA), with_camera(HAND, ""));
        for (own, there) in [(&whole, &without), (&without, &whole)] {
            assert_eq!(with_masses_at_links_of([own, there]), (there.clone(), Vec::new()));
        }
        assert_eq!(with_masses_at_links_of([&whole, &whole]), (whole.clone(), Vec::new()));
    }
}
