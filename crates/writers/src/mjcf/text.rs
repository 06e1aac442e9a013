//! The whole MJCF: settings, classes, assets, bodies, actuators, couplings, exclusions.

use std::{collections::BTreeSet, path::Path};

use congruent_description::{Link, LinkIndex, Robot};

use super::{
    assets::Assets,
    body::{pose, write_geom, write_inertia, write_joint},
    plan::{BodyPlan, bodies},
    world::WORLD,
};
use crate::xml_text::{Attributes, XmlText};

/// Writes all that a robot has as MJCF, with the pairs of links whose contacts are excluded, for a file in `folder`.
pub(crate) fn mjcf_text(robot: &Robot, excluded: &BTreeSet<(LinkIndex, LinkIndex)>, folder: &Path) -> String {
    let mut text = XmlText::new();
    text.begin("mujoco", Attributes::default().text("model", robot.name()));
    // Masses are those of `<inertial>` alone: shapes would give one to links that have none.
    let compiler = Attributes::default().text("angle", "radian").text("autolimits", "true");
    text.element("compiler", compiler.text("inertiafromgeom", "false"));
    write_classes(&mut text);
    let assets = Assets::of_robot(robot);
    assets.write(&mut text, folder);
    text.begin("worldbody", Attributes::default());
    let plans = bodies(robot);
    let writer = BodyWriter { robot, assets: &assets, plans: &plans, text: &mut text };
    writer.write_all();
    text.end();
    write_actuators(&mut text, robot);
    write_couplings(&mut text, robot);
    write_exclusions(&mut text, robot, excluded);
    text.finish()
}

/// Shapes that are drawn in a group that MuJoCo shows, and shapes that collide in one that it hides.
fn write_classes(text: &mut XmlText) {
    text.begin("default", Attributes::default());
    let class = |name: &str| Attributes::default().text("class", name);
    text.begin("default", class("visual"));
    let drawn = Attributes::default().text("contype", "0").text("conaffinity", "0");
    text.element("geom", drawn.text("group", "2").text("density", "0"));
    text.end();
    text.begin("default", class("collision"));
    text.element("geom", Attributes::default().text("group", "3").text("density", "0"));
    text.end();
    text.end();
}

struct BodyWriter<'a> {
    robot: &'a Robot,
    assets: &'a Assets,
    plans: &'a [BodyPlan],
    text: &'a mut XmlText,
}

impl BodyWriter<'_> {
    /// Depth first, by a list of bodies that are open: a chain of thousands would overflow a stack.
    fn write_all(mut self) {
        let root = &self.robot.links()[0];
        if root.name == WORLD {
            self.write_shapes(root);
        }
        let mut open: Vec<LinkIndex> = Vec::new();
        for plan in self.plans {
            // Links are sorted depth first, so the parent is open, and all after it is finished.
            while open.last().is_some_and(|last| *last != plan.parent) {
                open.pop();
                self.text.end();
            }
            self.write_body(plan);
            open.push(plan.link);
        }
        for _ in &open {
            self.text.end();
        }
    }

    fn write_body(&mut self, plan: &BodyPlan) {
        let link = self.robot.link(plan.link);
        self.text.begin("body", pose(Attributes::default().text("name", &link.name), &plan.parent_from_body));
        let has_mass =
            |of: &&congruent_description::Inertia| of.mass_kg > 0.0 || of.tensor_kg_m2.amax() > 0.0;
        if let Some(inertia) = link.inertia.as_ref().filter(has_mass) {
            write_inertia(self.text, inertia);
        }
        for joint in &plan.joints {
            write_joint(self.text, joint, self.robot);
        }
        self.write_shapes(link);
    }

    fn write_shapes(&mut self, link: &Link) {
        for (class, shapes) in [("visual", &link.visuals), ("collision", &link.collisions)] {
            for shape in shapes {
                write_geom(self.text, class, shape, self.assets);
            }
        }
    }
}

/// A motor for each joint that has a largest effort, with which it is limited.
fn write_actuators(text: &mut XmlText, robot: &Robot) {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    let driven: Vec<_> = joints.filter_map(|joint| Some((joint, joint.limit?.effort?))).collect();
    if driven.is_empty() {
        return;
    }
    text.begin("actuator", Attributes::default());
    for (joint, effort) in driven {
        let motor = Attributes::default().text("name", &joint.name).text("joint", &joint.name);
        text.element("motor", motor.numbers("ctrlrange", [-effort, effort]));
    }
    text.end();
}

fn write_couplings(text: &mut XmlText, robot: &Robot) {
    if robot.joints().iter().all(|joint| joint.mimic.is_none()) {
        return;
    }
    text.begin("equality", Attributes::default());
    for joint in robot.joints() {
        let Some(mimic) = joint.mimic else { continue };
        let pair = Attributes::default().text("joint1", &joint.name);
        let pair = pair.text("joint2", &robot.joint(mimic.master).name);
        text.element("joint", pair.numbers("polycoef", [mimic.offset, mimic.multiplier, 0.0, 0.0, 0.0]));
    }
    text.end();
}

/// Links that are joints of a body have no shapes and no name here, so their pairs are nothing.
pub(crate) fn excluded_bodies<'a>(
    robot: &'a Robot,
    excluded: &BTreeSet<(LinkIndex, LinkIndex)>,
) -> BTreeSet<[&'a str; 2]> {
    let mut is_body = vec![false; robot.links().len()];
    is_body[0] = true;
    for plan in bodies(robot) {
        is_body[plan.link.get()] = true;
    }
    let pairs = excluded.iter().filter(|(one, other)| is_body[one.get()] && is_body[other.get()]);
    pairs.map(|&(one, other)| [one, other].map(|link| robot.link(link).name.as_str())).collect()
}

fn write_exclusions(text: &mut XmlText, robot: &Robot, excluded: &BTreeSet<(LinkIndex, LinkIndex)>) {
    let pairs = excluded_bodies(robot, excluded);
    if pairs.is_empty() {
        return;
    }
    text.begin("contact", Attributes::default());
    for [one, other] in pairs {
        text.element("exclude", Attributes::default().text("body1", one).text("body2", other));
    }
    text.end();
}
