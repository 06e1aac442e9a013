//! The picture of a run: model and twin where they differ most, with what stands around them and the path of the TCP.

use congruent_description::display::{angle, length, quantity};
use congruent_kinematics::Pose;
use congruent_simulation::Obstacle;
use maud::{Markup, html};
use nalgebra::Isometry3;

use super::recorder::RunContent;
use crate::picture::{Arm, Body, Figure, Skeleton, TwoArms, corners, shapes};

/// The section.
pub(super) fn scene(run: &RunContent) -> Markup {
    let largest = &run.series.largest;
    let (robot, tip) = (&run.description.robot, run.description.tip);
    let model: Vec<Isometry3<f64>> = largest.model.iter().map(Pose::to_isometry).collect();
    let arm = |class: &'static str, name: &str, poses: &[Isometry3<f64>]| Arm {
        class,
        name: name.to_owned(),
        skeleton: Skeleton::new(robot, poses, tip),
    };
    let around = |class: &'static str, body: &Obstacle| Body {
        class,
        name: Some(body.name.clone()),
        points: corners(&body.geometry, &body.world_from_obstacle),
    };
    let shapes = shapes(robot, &largest.twin).into_iter();
    let mut bodies: Vec<Body> = run.obstacles.iter().map(|body| around("obstacle", body)).collect();
    bodies.extend(run.zones.iter().map(|zone| around("zone", zone)));
    bodies.extend(shapes.map(|points| Body { class: "shape", name: None, points }));
    let arms = vec![arm("twin", "twin (physics)", &largest.twin), arm("model", "model", &model)];
    let figure = Figure { bodies, arms, path: run.series.tcp_path.points() };
    let [a, b] = [&largest.twin, &model].map(|poses| poses[tip.get()].translation.vector);
    let two = TwoArms { figure, tips_apart_m: (a - b).norm() };
    let link = &run.names.links[largest.link];
    let error = largest.error;
    let caption = html! {
        "Model and twin where they differ most, at " (quantity(largest.time_s, "s")) ": by " (length(error.position_m))
        " and " (angle(error.orientation_rad)) " at link " (link) "."
        @if run.obstacles_move { " Obstacles are where they are at the start." }
    };
    html! { section { h2 { "The arm" } (two.markup(&caption)) } }
}
