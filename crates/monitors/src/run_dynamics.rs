//! The declared dynamics of a run: the robot with its resistances, under its gravity, with the payloads at a time.
//! Controllers and checks compute with it; it does not have the changes that a fault makes in the physics.

use congruent_description::{Inertia, Robot};
use congruent_dynamics::{BodyTree, DynamicsBuffer, JointResistance};
use nalgebra::{Isometry3, Vector3};

use super::payload::RunPayload;

/// The declared dynamics of a run, at one time after another.
#[derive(Debug, Clone)]
pub struct RunDynamics<'a> {
    robot: &'a Robot,
    payloads: &'a [RunPayload],
    /// Which of the payloads the tree has.
    is_carried: Vec<bool>,
    /// Counts the changes of the tree.
    revision: u64,
    tree: BodyTree,
    buffer: DynamicsBuffer,
}

impl<'a> RunDynamics<'a> {
    /// Of a robot with what it carries; one resistance for each joint of `Robot::movable_joints`.
    ///
    /// # Panics
    /// `resistances` has another length.
    pub fn new(
        robot: &'a Robot,
        payloads: &'a [RunPayload],
        resistances: &[JointResistance],
        gravity_in_root_m_s2: Vector3<f64>,
    ) -> Self {
        let tree = BodyTree::new(robot).with_gravity(gravity_in_root_m_s2);
        let tree = tree.with_resistances(resistances.to_vec()).expect("a setup has one for each joint");
        let is_carried = vec![false; payloads.len()];
        let mut declared = Self { robot, payloads, is_carried, revision: 0, buffer: tree.buffer(), tree };
        declared.at(0.0);
        declared
    }

    /// The equations of motion at a time, with memory for them.
    ///
    /// The payloads are those that a step from this time on carries. Nothing is allocated unless one comes or goes.
    ///
    /// # Panics
    /// Never: the same robot has as many bodies.
    pub fn at(&mut self, time_s: f64) -> (&BodyTree, &mut DynamicsBuffer) {
        let mut has_changed = false;
        for (payload, is_carried) in self.payloads.iter().zip(&mut self.is_carried) {
            let now = payload.is_carried_at(time_s);
            has_changed |= std::mem::replace(is_carried, now) != now;
        }
        // Only inertias differ, so that the tree's shape, and with it the buffer, stays valid.
        if has_changed {
            self.revision += 1;
            let loaded = self.loaded(time_s);
            let inertias: Vec<_> = (0..loaded.dof()).map(|joint| loaded.inertia_in_link(joint)).collect();
            let tree = self.tree.clone().with_inertias_in_links(&inertias);
            self.tree = tree.expect("the same robot has as many bodies");
        }
        (&self.tree, &mut self.buffer)
    }

    /// A number that is another one whenever the equations of motion are others than before.
    pub fn revision_at(&mut self, time_s: f64) -> u64 {
        self.at(time_s);
        self.revision
    }

    /// The robot with the payloads that it carries at a time.
    fn loaded(&self, time_s: f64) -> BodyTree {
        let mut robot = self.robot.clone();
        for payload in self.payloads.iter().filter(|payload| payload.is_carried_at(time_s)) {
            // In the link's frame, to which the payload is fixed: hence identities below.
            let link = payload.carried.link;
            let parts = [robot.link(link).inertia, Some(payload.carried.inertia)];
            let parts = parts.into_iter().flatten().map(|part| (Isometry3::identity(), part));
            let whole = Inertia::sum_of_parts(parts);
            robot = robot.with_inertia(link, whole);
        }
        BodyTree::new(&robot)
    }
}

#[cfg(test)]
mod tests {
    use congruent_description::CarriedBody;
    use congruent_description::{RobotQ, parse_urdf};

    use super::*;

    #[test]
    fn a_payload_weighs_while_it_is_carried() {
        let robot = parse_urdf(
            r#"<robot name="rod"><link name="base"/><link name="rod"/><link name="hand"/>
               <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
               <joint name="grip" type="fixed"><parent link="rod"/><child link="hand"/><origin xyz="0.5 0 0"/></joint>
             </robot>"#,
        )
        .unwrap();
        let link = robot.find_link("hand").unwrap();
        let link_from_inertial = Isometry3::translation(0.25, 0.0, 0.0);
        let inertia = Inertia { mass_kg: 2.0, link_from_inertial, tensor_kg_m2: nalgebra::Matrix3::zeros() };
        let carried = CarriedBody { link, inertia };
        let payloads = [RunPayload { name: "box".into(), carried, from_s: 1.0, until_s: 2.0 }];
        let resistance = JointResistance { damping: 0.0, friction: 0.0, armature: 0.125 };
        let gravity = Vector3::new(0.0, 0.0, -10.0);
        let mut declared = RunDynamics::new(&robot, &payloads, &[resistance], gravity);
        // About +y, gravity turns a level rod with +2 kg x 10 m/s2 x 0.75 m; the torque that holds it is the opposite.
        for (time_s, expected_n_m) in [(0.0, 0.0), (0.999, 0.0), (1.0, -15.0), (1.5, -15.0), (2.0, 0.0)] {
            let (tree, buffer) = declared.at(time_s);
            let mut tau = [0.0];
            tree.gravity_into(&RobotQ::zeros(1), buffer, &mut tau).unwrap();
            assert!((tau[0] - expected_n_m).abs() < 1e-13, "{tau:?} at {time_s} s");
        }
        assert_eq!(declared.at(1.5).0.resistances(), [resistance]);
    }
}
