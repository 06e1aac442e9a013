//! What refers to the tree from outside: tendons, equalities, excluded contacts. If what they refer to is replicated, so are
//! they; of an attached model, those remain whose bodies and joints are attached.

use super::{
    attributes::MjAttributes,
    names::{MjCopy, MjNamed},
    reader::MjReader,
};
use crate::{
    codes,
    document::MjElement,
    model::{MjContactExclusion, MjEquality, MjEqualityKind, MjTendon},
};

/// A reference: the element and attribute that state it, and the kind of what it means.
#[derive(Clone, Copy)]
pub(super) struct MjReference<'e> {
    pub(super) element: &'e MjElement,
    pub(super) key: &'static str,
    pub(super) kind: MjNamed,
}

/// One of the copies of an element, with the indices of what it refers to.
pub(super) struct MjInstance {
    pub(super) replica: String,
    pub(super) indices: Vec<usize>,
}

impl MjReader<'_, '_> {
    /// The copies that a reference means; `None` if it means nothing here: with an error, or because that part of an attached
    /// model is not attached.
    fn copies(&mut self, attachment: usize, reference: MjReference<'_>) -> Option<Vec<MjCopy>> {
        let MjReference { element, key, kind } = reference;
        let name = element.text(key)?;
        let found = self.names.copies(attachment, kind, name);
        if !found.is_empty() {
            return Some(found.to_vec());
        }
        if kind == MjNamed::Body && name == "world" {
            return Some(vec![MjCopy { replica: String::new(), index: 0 }]);
        }
        if !self.scope(attachment).declared.contains(&(kind, name.to_owned())) || attachment == 0 {
            let fault = self.names.unknown(attachment, kind, key, element);
            self.diagnostics.push(fault);
        }
        None
    }

    /// The copies of an element that refers to others: one for each replica of them. If some are replicated and some are not,
    /// MuJoCo drops the element, which is reported.
    pub(super) fn instances(
        &mut self,
        attachment: usize,
        element: &MjElement,
        references: &[MjReference<'_>],
    ) -> Vec<MjInstance> {
        let found: Option<Vec<Vec<MjCopy>>> =
            references.iter().map(|reference| self.copies(attachment, *reference)).collect();
        let Some([first, others @ ..]) = found.as_deref() else { return Vec::new() };
        let is_alike = |copies: &Vec<MjCopy>| {
            copies.iter().map(|copy| &copy.replica).eq(first.iter().map(|copy| &copy.replica))
        };
        if !others.iter().all(is_alike) {
            let message =
                format!("{} joins what is replicated with what is not, so MuJoCo drops it", element.label());
            let help = "write one for each replica, by their full names";
            self.diagnostics.push(element.warning(codes::mjcf::REPLICATE, message).with_help(help));
            return Vec::new();
        }
        let at = |number: usize| others.iter().map(move |copies| copies[number].index);
        let copies = first.iter().enumerate();
        copies
            .map(|(number, copy)| MjInstance {
                replica: copy.replica.clone(),
                indices: [copy.index].into_iter().chain(at(number)).collect(),
            })
            .collect()
    }

    /// The full name of an element that refers to the tree; empty without a name.
    pub(super) fn name_of(
        &mut self,
        kind: MjNamed,
        element: &MjElement,
        attachment: usize,
        replica: &str,
    ) -> String {
        let Some(name) = element.name() else { return String::new() };
        let full = self.full_name(attachment, replica, name);
        let taken = self.names.take(kind, &full, element);
        self.diagnostics.keep(taken);
        full
    }

    pub(super) fn tendons(&mut self, attachment: usize) -> Option<()> {
        for element in self.scope(attachment).root.in_sections("tendon") {
            // A tendon in space has no joints; each of its copies would be one more that nothing reads.
            let joints: Vec<&MjElement> = element.all("joint").collect();
            let references: Vec<MjReference<'_>> = joints
                .iter()
                .map(|&joint| MjReference { element: joint, key: "joint", kind: MjNamed::Joint })
                .collect();
            let coefficient = |joint: &&MjElement| MjAttributes::own(joint).number("coef", 0.0).value;
            let coefficients: Vec<f64> = joints.iter().map(coefficient).collect();
            let instances = if joints.is_empty() {
                vec![MjInstance { replica: String::new(), indices: Vec::new() }]
            } else {
                self.instances(attachment, element, &references)
            };
            for MjInstance { replica, indices } in instances {
                self.count(element)?;
                let index = self.model.tendons.len();
                let name = self.name_of(MjNamed::Tendon, element, attachment, &replica);
                if let Some(local) = element.name() {
                    self.names.add(attachment, MjNamed::Tendon, local, MjCopy { replica, index });
                }
                let joints = indices.into_iter().zip(coefficients.iter().copied()).collect();
                self.model.tendons.push(MjTendon { name, joints, place: element.place() });
            }
        }
        Some(())
    }

    pub(super) fn equalities(&mut self, attachment: usize) -> Option<()> {
        for element in self.scope(attachment).root.in_sections("equality") {
            if matches!(element.tag.as_str(), "flex" | "flexstrain") {
                self.unread(element);
                continue;
            }
            let Some(references) = self.ends(element) else { continue };
            for instance in self.instances(attachment, element, &references) {
                self.count(element)?;
                self.equality(element, attachment, &instance);
            }
        }
        Some(())
    }

    /// The references of an equality to its ends.
    fn ends<'e>(&mut self, element: &'e MjElement) -> Option<Vec<MjReference<'e>>> {
        let given = |key: &'static str, kind| element.text(key).map(|_| MjReference { element, key, kind });
        let [first, second] = match element.tag.as_str() {
            "joint" => [given("joint1", MjNamed::Joint), given("joint2", MjNamed::Joint)],
            "tendon" => [given("tendon1", MjNamed::Tendon), given("tendon2", MjNamed::Tendon)],
            _ if element.text("site1").is_some() => {
                [given("site1", MjNamed::Site), given("site2", MjNamed::Site)]
            }
            _ => [given("body1", MjNamed::Body), given("body2", MjNamed::Body)],
        };
        let is_at_sites = element.text("site1").is_some();
        let lacks_anchor = element.tag == "connect" && !is_at_sites && element.text("anchor").is_none();
        if first.is_none() || (is_at_sites && second.is_none()) || lacks_anchor {
            let message = format!("the equality {} lacks one of its ends", element.label());
            let help = match element.tag.as_str() {
                "joint" => "give joint1",
                "tendon" => "give tendon1",
                "connect" => "give body1 and anchor, or site1 and site2",
                _ => "give body1, or site1 and site2",
            };
            self.diagnostics.push(element.fault(codes::mjcf::EQUALITY, message).with_help(help));
            return None;
        }
        if let (Some(first), Some(second)) = (first, second)
            && element.text(first.key) == element.text(second.key)
        {
            let message = format!("the equality {} has the same end twice", element.label());
            self.diagnostics.push(element.fault_at(second.key, codes::mjcf::EQUALITY, message));
            return None;
        }
        Some(first.into_iter().chain(second).collect())
    }

    fn equality(&mut self, element: &MjElement, attachment: usize, instance: &MjInstance) {
        let attributes = self.attributes(element, attachment).of_kind("equality");
        let is_active = attributes.text("active") != Some("false");
        let (first, second) = (instance.indices[0], instance.indices.get(1).copied());
        let is_at_sites = element.text("site1").is_some();
        let body = |index: usize| if is_at_sites { self.model.sites[index].body } else { index };
        let bodies = [body(first), second.map_or(0, body)];
        let kind = match element.tag.as_str() {
            "joint" => {
                let coefficients = attributes.array("polycoef", [0.0, 1.0, 0.0, 0.0, 0.0]);
                MjEqualityKind::Joint { follower: first, leader: second, coefficients }
            }
            "tendon" => MjEqualityKind::Tendon { tendons: instance.indices.clone() },
            "connect" => MjEqualityKind::Connect { bodies },
            _ => MjEqualityKind::Weld { bodies },
        };
        if let MjEqualityKind::Joint { follower, leader, .. } = kind {
            let ends = [("joint1", Some(follower)), ("joint2", leader)];
            let is_scalar = |joint: usize| self.model.joints[joint].kind.positions() == 1;
            let is_odd = |&(_, joint): &(&str, Option<usize>)| joint.is_some_and(|joint| !is_scalar(joint));
            if let Some((key, Some(joint))) = ends.into_iter().find(is_odd) {
                let name = &self.model.joints[joint].name;
                let message = format!("joint \"{name}\" of an equality is no hinge and no slide");
                self.diagnostics.push(element.fault_at(key, codes::mjcf::EQUALITY, message));
            }
        }
        if is_active && matches!(kind, MjEqualityKind::Connect { .. } | MjEqualityKind::Weld { .. }) {
            let [first, second] = bodies.map(|body| &self.model.bodies[body].name);
            let message = format!("<{}> of bodies \"{first}\" and \"{second}\" closes a loop", element.tag);
            let help = "the loop is not closed: joints move freely, also to poses that the loop forbids";
            let names = format!("{first} - {second}");
            let found = element.warning(codes::mjcf::LOOP, message).with_help(help);
            self.diagnostics.push(found.one_of("equalities close loops", names));
        }
        let name = self.name_of(MjNamed::Equality, element, attachment, &instance.replica);
        self.model.equalities.push(MjEquality { name, kind, is_active, place: element.place() });
    }

    pub(super) fn exclusions(&mut self, attachment: usize) -> Option<()> {
        let root = &self.scope(attachment).root;
        for element in root.in_sections("contact").filter(|child| child.tag == "exclude") {
            let reference = |key| MjReference { element, key, kind: MjNamed::Body };
            let first = self.copies(attachment, reference("body1"));
            let second = self.copies(attachment, reference("body2"));
            let (Some(first), Some(second)) = (first, second) else { continue };
            for one in &first {
                // A replica is excluded from its own copy of the other, or from the only one there is.
                let own = second.iter().find(|other| other.replica == one.replica);
                let others = own.map_or(&second[..], std::slice::from_ref);
                for other in others {
                    self.count(element)?;
                    let bodies = [one.index, other.index];
                    self.model.exclusions.push(MjContactExclusion { bodies, place: element.place() });
                }
            }
        }
        Some(())
    }
}
