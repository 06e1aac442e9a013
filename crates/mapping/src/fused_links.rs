//! Bodies whose mass two files write at different links: programs that fuse links write the sum of links that are fixed to each
//! other at one of them.

use std::collections::BTreeSet;

use congruent_description::{Inertia, InertiaRounding, Link, LinkIndex, Robot};
use congruent_kinematics::ScrewTree;
use nalgebra::{Isometry3, Matrix3, Vector3};

use crate::link_names::OF_FITTED_BASE;

/// Links that one of two descriptions has as one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FusedLinks {
    /// The heaviest link of the body in the robot: what its links together differ by is compared there.
    pub link: String,
    /// The other links of the body that have a mass in one of the files, without one that the other file lacks.
    pub with: Vec<String>,
}

/// The other robot with the mass of each body at the links where `robot` has it, if both have about the same mass there at
/// different links; and these bodies. Both have the same joints by name, in the same variables.
///
/// A link that is missing, such as a camera without which the body is as much lighter, is a difference and stays one.
pub fn with_masses_at_links_of([robot, other]: [&Robot; 2]) -> (Robot, Vec<FusedLinks>) {
    let other = &with_negligible_masses_of([robot, other]);
    let mut fused = Vec::new();
    let same = for_each_body([robot, other], |body, same| {
        let (changed, links) = body.with_masses_moved(same)?;
        fused.push(links);
        Some(changed)
    });
    (same, fused)
}

/// The other robot with the masses of this one that are negligible in their body, such as those of frames that an importer wants to
/// have one, and without its own.
fn with_negligible_masses_of(robots: [&Robot; 2]) -> Robot {
    #[expect(
        clippy::redundant_closure_for_method_calls,
        reason = "the method itself is of one lifetime only"
    )]
    for_each_body(robots, |body, same| body.with_negligible_masses(same))
}

/// The other robot after what `change` makes of it for each body that both have.
fn for_each_body(
    [robot, other]: [&Robot; 2],
    mut change: impl FnMut(&BodyPair<'_>, &Robot) -> Option<Robot>,
) -> Robot {
    let trees = [robot, other].map(ScrewTree::new);
    let mut same = other.clone();
    for own in robot.link_indices().filter(|&link| robot.body(link) == link) {
        let joint = robot.parent_joint(own).map(|joint| &robot.joint(joint).name);
        let there = joint.map_or(Some(other.root()), |name| Some(other.joint(other.find_joint(name)?).child));
        let Some(there) = there.filter(|&there| other.body(there) == there) else { continue };
        let body = BodyPair { robots: [robot, other], trees: &trees, bodies: [own, there] };
        same = change(&body, &same).unwrap_or(same);
    }
    same
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

    /// `same` with the negligible masses that the robot alone has on this body, and without those that it alone has; `None` if there are
    /// none.
    fn with_negligible_masses(&self, same: &Robot) -> Option<Robot> {
        /// A mass that is a smaller part of that of its body. Kind: choice; it changes torques by less than a sensor sees.
        const NEGLIGIBLE: f64 = 1e-6;
        let [own, there] = [0, 1].map(|of| self.parts(of));
        let most_kg = NEGLIGIBLE * mass_kg(&own).min(mass_kg(&there));
        let [names, other_names] = [&own, &there].map(|parts| names(parts));
        let is_negligible = |part: &&Part<'_>, known: &BTreeSet<&str>| {
            part.inertia.mass_kg < most_kg && !known.contains(part.link.name.as_str())
        };
        let added = own.iter().filter(|part| is_negligible(part, &other_names));
        let kept = there.iter().filter(|part| !is_negligible(part, &names));
        let parts: Vec<Part<'_>> = kept.chain(added.clone()).copied().collect();
        let is_changed = added.count() > 0 || parts.len() < there.len();
        if is_changed { self.moved(same, &parts, None) } else { None }
    }

    /// `same` with the masses of this body where the robot has them; `None` if they are there, or if the sums differ by what
    /// one of the two lacks.
    fn with_masses_moved(&self, same: &Robot) -> Option<(Robot, FusedLinks)> {
        let [mut own, mut there] = [0, 1].map(|of| self.parts(of));
        let [names, other_names] = [&own, &there].map(|parts| names(parts));
        // Links of a fitted base are not compared.
        if other_names.iter().any(|name| name.ends_with(OF_FITTED_BASE)) {
            return None;
        }
        let alone: BTreeSet<&str> = names.symmetric_difference(&other_names).copied().collect();
        let is_alone = |part: &Part<'_>| alone.contains(part.link.name.as_str());
        let missing = missing_link(&own, &there, is_alone);
        let missing = missing.map(|part| part.link.name.clone());
        for parts in [&mut own, &mut there] {
            parts.retain(|part| Some(&part.link.name) != missing.as_ref());
        }
        let alone_kg = mass_kg(own.iter().chain(&there).filter(|part| is_alone(part)));
        // Nearer to the sum than to a link that is missing.
        if (mass_kg(&own) - mass_kg(&there)).abs() >= 0.5 * alone_kg {
            return None;
        }
        let carrier = own.iter().max_by(|a, b| a.inertia.mass_kg.total_cmp(&b.inertia.mass_kg))?;
        let rest: Vec<Part<'_>> =
            own.iter().filter(|part| part.link.name != carrier.link.name).copied().collect();
        let carried = remainder(carrier, &there, &rest)?;
        let parts: Vec<Part<'_>> = std::iter::once(carried).chain(rest).collect();
        let moved = self.moved(same, &parts, missing.as_ref())?;
        let all = own.iter().chain(&there).map(|part| part.link.name.as_str()).collect::<BTreeSet<&str>>();
        let with = all.into_iter().filter(|name| *name != carrier.link.name).map(str::to_owned);
        Some((moved, FusedLinks { link: carrier.link.name.clone(), with: with.collect() }))
    }

    /// `same` with these masses alone on this body, beside that of a link which the robot lacks; `None` if one of the links is
    /// elsewhere there.
    fn moved(&self, same: &Robot, parts: &[Part<'_>], missing: Option<&String>) -> Option<Robot> {
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
            if Some(&link.name) == missing {
                return;
            }
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

fn names<'a>(parts: &[Part<'a>]) -> BTreeSet<&'a str> {
    parts.iter().map(|part| part.link.name.as_str()).collect()
}

fn mass_kg<'a, 'b: 'a>(parts: impl IntoIterator<Item = &'a Part<'b>>) -> f64 {
    parts.into_iter().map(|part| part.inertia.mass_kg).sum()
}

/// The link that one of the two has alone and whose mass is what the sums are apart: the other lacks it. Of several with one mass it is
/// the one without which the centres of mass are nearest.
fn missing_link<'a, 'b>(
    own: &'a [Part<'b>],
    there: &'a [Part<'b>],
    is_alone: impl Fn(&Part<'_>) -> bool,
) -> Option<&'a Part<'b>> {
    /// Share of its mass by which the sums may be apart otherwise. Kind: digits of a file.
    const SAME_MASS: f64 = 1e-2;
    let apart_kg = mass_kg(own) - mass_kg(there);
    let [heavier, lighter] = if apart_kg > 0.0 { [own, there] } else { [there, own] };
    let is_missing = |part: &&Part<'_>| {
        let kg = part.inertia.mass_kg;
        is_alone(part) && (kg - apart_kg.abs()).abs() < SAME_MASS * kg
    };
    let off_m = |missing: &Part<'_>| {
        let with = |part: &&Part<'_>| part.link.name != missing.link.name;
        (com_m(heavier.iter().filter(with)) - com_m(lighter)).norm()
    };
    heavier.iter().filter(is_missing).min_by(|a, b| off_m(a).total_cmp(&off_m(b)))
}

/// The common centre of mass of parts, in the body.
fn com_m<'a, 'b: 'a>(parts: impl IntoIterator<Item = &'a Part<'b>>) -> Vector3<f64> {
    let parts = parts.into_iter().map(|part| (part.body_from_link, part.inertia)).collect::<Vec<_>>();
    Inertia::sum_of_parts(parts.into_iter()).link_from_inertial.translation.vector
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
    let mut inertia = Inertia {
        link_from_inertial: Isometry3::from_parts(com, axes),
        tensor_kg_m2: turn.matrix().transpose() * sum.tensor_kg_m2 * turn.matrix(),
        ..sum
    };
    let parts: Vec<&Part<'_>> = whole.iter().chain(rest).collect();
    if is_noise(&carrier.inertia, &inertia, &parts) {
        inertia = carrier.inertia;
    }
    let off_m = com.vector - carrier.inertia.link_from_inertial.translation.vector;
    let parts = parts.into_iter().map(|part| in_frame(part, &carrier_from_body));
    let rounding = rounding_of_sum(parts.collect(), &com.vector, sum.mass_kg, &off_m);
    Some(Part { inertia, rounding, ..*carrier })
}

/// Whether the two differ by the rounding of the sums alone.
fn is_noise(own: &Inertia, there: &Inertia, parts: &[&Part<'_>]) -> bool {
    /// Share of the largest terms of the sums. Kind: rounding of calculation.
    const NOISE: f64 = 1e-12;
    let reach_m = parts
        .iter()
        .map(|part| (part.body_from_link * part.inertia.link_from_inertial).translation.vector.norm());
    let reach_m = reach_m.fold(0.0, f64::max);
    let all_kg: f64 = parts.iter().map(|part| part.inertia.mass_kg).sum();
    let tensors: f64 = parts.iter().map(|part| part.inertia.tensor_kg_m2.amax()).sum();
    let off_m = own.link_from_inertial.translation.vector - there.link_from_inertial.translation.vector;
    let off_kg_m2 = own.tensor_in_link() - there.tensor_in_link();
    (own.mass_kg - there.mass_kg).abs() <= NOISE * all_kg
        && off_m.amax() * there.mass_kg <= NOISE * all_kg * reach_m
        && off_kg_m2.amax() <= NOISE * (tensors + all_kg * reach_m * reach_m)
}

/// Mass, centre of mass and rounding of a part, in the axes of the carrier.
type RoundedMass = (f64, Vector3<f64>, InertiaRounding);

fn in_frame(part: &Part<'_>, carrier_from_body: &Isometry3<f64>) -> RoundedMass {
    let carrier_from_link = carrier_from_body * part.body_from_link;
    let com = (carrier_from_link * part.inertia.link_from_inertial).translation.vector;
    (part.inertia.mass_kg, com, part.rounding.expressed_in(&carrier_from_link.rotation))
}

/// The rounding of a sum of parts with this centre of mass and mass, to first order. What shifts of the parts change in the tensor
/// counts by the share of these shifts that the centre of mass, which is off by `off_m`, has taken.
fn rounding_of_sum(
    parts: Vec<RoundedMass>,
    com: &Vector3<f64>,
    mass_kg: f64,
    off_m: &Vector3<f64>,
) -> InertiaRounding {
    let mut sum = InertiaRounding::default();
    let (mut of_shifts, mut at_tensor) = (Vector3::zeros(), Matrix3::zeros());
    for (part_kg, at, rounding) in parts {
        let arm = (at - com).abs();
        let moment = rounding.com_m * part_kg + arm * rounding.mass_kg;
        sum.mass_kg += rounding.mass_kg;
        sum.com_m += moment / mass_kg;
        of_shifts += rounding.com_m * (part_kg / mass_kg);
        // Of m (|d|^2 1 - d d^T), with d from the common centre of mass to that of the part.
        let of_mass = (Matrix3::identity() * arm.norm_squared() + arm * arm.transpose()) * rounding.mass_kg;
        let shift = rounding.com_m;
        let of_shift =
            Matrix3::identity() * (2.0 * arm.dot(&shift)) + arm * shift.transpose() + shift * arm.transpose();
        sum.tensor_kg_m2 += rounding.tensor_kg_m2 + of_mass;
        at_tensor += of_shift * part_kg;
    }
    let taken =
        off_m.zip_map(&of_shifts, |off, most| if most > 0.0 { (off.abs() / most).min(1.0) } else { 0.0 });
    sum.tensor_kg_m2 += at_tensor * taken.amax();
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
        with_camera_and(hand, camera, "")
    }

    fn with_camera_and(hand: &str, camera: &str, more: &str) -> Robot {
        let text = format!(
            "<robot name='r'><link name='base'/><link name='hand'>{hand}</link><link name='camera'>{camera}</link>\
             <joint name='j' type='continuous'><parent link='base'/><child link='hand'/></joint>\
             <joint name='mount' type='fixed'><parent link='hand'/><child link='camera'/>\
             <origin xyz='0.2 -0.1 0.05' rpy='0.3 -0.4 0.5'/></joint>{more}</robot>"
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

    /// A whole tensor that is off beside an equal centre of mass is no rounding of the coarse centre of mass of the camera.
    #[test]
    fn coarse_lengths_of_a_link_leave_no_tensor_open_beside_an_equal_centre_of_mass() {
        let mut heavier = fused();
        let index = heavier.find_link("hand").unwrap();
        let mut inertia = heavier.link(index).inertia.unwrap();
        inertia.tensor_kg_m2[(0, 0)] *= 1.02;
        heavier.set_inertia(index, inertia);
        let split = with_camera(HAND, CAMERA);
        let (same, _) = with_masses_at_links_of([&split, &heavier]);
        let (_, names) = crate::with_values_within_digits([&split, &same], crate::DigitsOfFrames::default());
        assert_eq!(names, [""; 0]);
    }

    /// The camera is missing beside a hand that is fused with its cover: the camera alone is the difference.
    #[test]
    fn a_link_that_is_missing_beside_fused_ones_is_the_difference() {
        let cover = "<link name='cover'><inertial><mass value='0.7'/><inertia ixx='0.001' iyy='0.001' izz='0.001' ixy='0' \
                     ixz='0' iyz='0'/></inertial></link><joint name='clip' type='fixed'><parent link='hand'/>\
                     <child link='cover'/><origin xyz='0.1 0 0'/></joint>";
        let whole = with_camera_and(HAND, CAMERA, cover);
        let [hand, cover] =
            ["hand", "cover"].map(|name| whole.link(whole.find_link(name).unwrap()).inertia.unwrap());
        let clip = whole.joint(whole.find_joint("clip").unwrap()).parent_from_joint;
        let parts = [(Isometry3::identity(), hand), (clip, cover)];
        let fused = with_camera(HAND, "").with_links(|link| {
            if link.name == "hand" {
                link.inertia = Some(Inertia::sum_of_parts(parts.iter().copied()));
            }
        });
        let (same, links) = with_masses_at_links_of([&whole, &fused]);
        assert_eq!(links, [FusedLinks { link: "hand".to_owned(), with: vec!["cover".to_owned()] }]);
        let kg = |name: &str| same.link(same.find_link(name).unwrap()).inertia.map(|of| of.mass_kg);
        assert_eq!([kg("hand"), kg("cover"), kg("camera")], [Some(2.0), Some(0.7), None]);
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
