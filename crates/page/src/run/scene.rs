//! The picture of a run: model and twin where they differ most, or the twin where another check was violated first; with the
//! obstacles and zones around it and the path of the TCP.

use congruent_description::{Obstacle, Robot, RobotQ};
use congruent_input::display::{angle, length, quantity};
use congruent_kinematics::{Pose, UrdfTree};
use congruent_monitors::verdict::{CheckResult, Measure, Moment};
use congruent_results::report::{RunReport, sentence_at};
use congruent_scenario::CheckKind;
use maud::{Markup, html};
use nalgebra::Isometry3;

use super::{content::RunContent, violated::violated};
use crate::picture::{DrawnArm, Figure, PictureBody, Skeleton, TwoArms, corners, shapes};

/// The picture of the arm, with its caption and its legend.
pub(super) fn scene(report: &RunReport, run: &RunContent) -> Markup {
    // Without poses of that moment there is still the picture of model and twin.
    let violated = first_violation(report).and_then(|found| Some((found, poses(run, found.2)?)));
    match violated {
        Some(((check, measure, moment), poses)) => {
            let arms = vec![arm("twin", twin_words(report).of_arm, &poses, run)];
            let figure = figure_of(arms, &poses, &moment.subject, run);
            let caption = at_violation(check, measure, moment, run);
            TwoArms { figure, tips_apart_m: 0.0 }.markup(&caption)
        }
        None => at_largest_difference(twin_words(report), run),
    }
}

/// What the model is compared with, as it is called.
#[derive(Clone, Copy)]
struct TwinWords {
    name: &'static str,
    of_arm: &'static str,
}

/// A log has no physics: its arm is the URDF at the joints that were recorded.
fn twin_words(report: &RunReport) -> TwinWords {
    match &report.source {
        Some(_) => TwinWords { name: "log", of_arm: "log" },
        None => TwinWords { name: "twin", of_arm: "twin (physics)" },
    }
}

/// The quantity that was violated first, at that instant; `None` if it is that model and twin differ, which is shown where it
/// is largest.
fn first_violation(report: &RunReport) -> Option<(&CheckResult, &Measure, &Moment)> {
    let first = *violated(report).first()?;
    let moment = first.measure.first_violation.as_ref()?;
    (first.check.check != CheckKind::Agreement).then_some((first.check, first.measure, moment))
}

/// Poses of the twin at the configuration of a moment.
fn poses(run: &RunContent, moment: &Moment) -> Option<Vec<Isometry3<f64>>> {
    let robot = &run.description.robot;
    let mut q = RobotQ::zeros(robot.dof());
    for (joint, value) in moment.q.iter() {
        q[robot.coordinate(robot.find_joint(joint)?)?] = value;
    }
    let mut poses = vec![Pose::identity(); robot.links().len()];
    UrdfTree::new(robot).root_from_links_into(&q, &mut poses).ok()?;
    Some(poses.iter().map(Pose::to_isometry).collect())
}

fn at_violation(check: &CheckResult, measure: &Measure, moment: &Moment, run: &RunContent) -> Markup {
    html! {
        "The robot at " (quantity(moment.time_s, "s")) ", where check " (check.check) " is violated first: "
        (sentence_at(measure, moment)) "." (moving(run))
    }
}

fn figure_of(arms: Vec<DrawnArm>, poses: &[Isometry3<f64>], subject: &str, run: &RunContent) -> Figure {
    let subjects = subjects(subject, &run.description.robot);
    Figure { bodies: bodies(poses, run, &subjects), arms, path: run.series.tcp_path.points() }
}

/// Links, obstacles and zones that a value is about: of a joint, the link that moves with it.
fn subjects<'a>(subject: &'a str, robot: &'a Robot) -> Vec<&'a str> {
    let joint_values =
        robot.find_joint(subject).map(|joint| robot.link(robot.joint(joint).child).name.as_str());
    // The name of a pair is that of both of its subjects, joined by `--`.
    subject.split("--").chain(joint_values).collect()
}

fn at_largest_difference(words: TwinWords, run: &RunContent) -> Markup {
    let largest = &run.series.largest;
    let tip = run.description.tip.get();
    let model: Vec<Isometry3<f64>> = largest.model.iter().map(Pose::to_isometry).collect();
    let arms = vec![arm("twin", words.of_arm, &largest.twin, run), arm("model", "model", &model, run)];
    let figure = Figure { bodies: bodies(&largest.twin, run, &[]), arms, path: run.series.tcp_path.points() };
    let tips_apart_m = (largest.twin[tip].translation.vector - model[tip].translation.vector).norm();
    let caption = html! {
        "Model and " (words.name) " where they differ most, at " (quantity(largest.time_s, "s")) ": by "
        (length(largest.error.position_m)) " and " (angle(largest.error.orientation_rad)) " at link "
        (run.names.links[largest.link]) "." (moving(run))
    };
    TwoArms { figure, tips_apart_m }.markup(&caption)
}

fn moving(run: &RunContent) -> &'static str {
    if run.obstacles_move { " Obstacles are where they are at the start." } else { "" }
}

fn arm(class: &'static str, name: &str, poses: &[Isometry3<f64>], run: &RunContent) -> DrawnArm {
    let description = &run.description;
    let skeleton = Skeleton::new(&description.robot, poses, description.tip);
    DrawnArm { class, name: name.to_owned(), skeleton }
}

/// Obstacles, zones, and the shapes of the arm; those that a check found are marked.
fn bodies(poses: &[Isometry3<f64>], run: &RunContent, marked: &[&str]) -> Vec<PictureBody> {
    let is_marked = |name: &str| marked.contains(&name);
    let around = |class: &'static str, body: &Obstacle| PictureBody {
        class,
        name: Some(body.name.clone()),
        points: corners(&body.geometry, &body.world_from_obstacle),
        is_marked: is_marked(&body.name),
    };
    let mut bodies: Vec<PictureBody> = run.obstacles.iter().map(|body| around("obstacle", body)).collect();
    bodies.extend(run.zones.iter().map(|zone| around("zone", zone)));
    let shapes = shapes(&run.description.robot, poses).into_iter();
    bodies.extend(
        shapes.map(|(link, points)| PictureBody { is_marked: is_marked(link), ..PictureBody::shape(points) }),
    );
    bodies
}
