//! The certificates: the largest difference that was found and the bound that no configuration exceeds; and the picture of the
//! arm where the difference is largest.

use congruent_agreement::{
    SourcePair,
    compare::{CheckReport, Model, ReportedBracket, ReportedCertificate},
};
use congruent_description::{JointValues, RobotDescription, RobotQ};
use congruent_input::display::{length, length_and_angle};
use congruent_kinematics::{Pose, UrdfTree, move_inside_limits};
use maud::{Markup, html};
use nalgebra::Isometry3;

use super::checked_robot::CheckedRobot;
use crate::{
    parts::{Pointer, UnitColumn, value},
    picture::{DrawnArm, Figure, PictureBody, Skeleton, TwoArms, shapes},
};

/// The section on certificates: attained difference and certified bound.
pub(super) fn certificate(robot: &CheckedRobot<'_>, at: &Pointer) -> Markup {
    let report = robot.geometry;
    html! {
        section {
            h2 { "Over the whole joint range" }
            @if report.certificates.is_empty() { p { "There is no chain of joints to bound." } }
            @else { (table(&report.certificates, &at.key("certificates"))) }
        }
    }
}

fn table(certificates: &[ReportedCertificate], at: &Pointer) -> Markup {
    let brackets = || certificates.iter().filter_map(|of| of.brackets.as_ref());
    let lengths = brackets().flat_map(|of| [of.position_m.attained, of.position_m.certified]);
    let angles = brackets().flat_map(|of| [of.orientation_rad.attained, of.orientation_rad.certified]);
    let columns = [UnitColumn::of_lengths(lengths), UnitColumn::of_angles(angles)];
    let [position, orientation] = columns.map(|column| column.unit);
    html! {
        table {
            thead { tr {
                th { "compared" }
                th { "largest found, " (position) } th { "certified bound, " (position) }
                th { "largest found, " (orientation) } th { "certified bound, " (orientation) }
            } }
            tbody {
                @for (index, certificate) in certificates.iter().enumerate() {
                    @let at = at.key(index);
                    tr {
                        th scope="row" { (certificate.title) }
                        @match &certificate.brackets {
                            Some(brackets) => {
                                (cells(&brackets.position_m, &columns[0], &at.key("position_m")))
                                (cells(&brackets.orientation_rad, &columns[1], &at.key("orientation_rad")))
                            }
                            None if let Some(joint) = &certificate.unranged => {
                                td colspan="4" { "no bound: joint " (joint) " slides without a range" }
                            }
                            None => { td colspan="4" { "no bound: a joint has no limits, or its motion is not a pure screw motion" } }
                        }
                    }
                    @if let Some(premise) = &certificate.premise {
                        tr.notes { td {} td colspan="4" {
                            "its joints are " @if !premise.holds { "not " } "pure screw motions: residual "
                            (value(&at.keys(&["premise", "residual_m"]), premise.residual_m, &length(premise.residual_m)))
                        } }
                    }
                }
            }
        }
    }
}

/// What was found and what is certified, in the unit of the column.
fn cells(of: &ReportedBracket, column: &UnitColumn, at: &Pointer) -> Markup {
    let cell = |name: &str, key: &str, exact: f64| {
        html! { td data-label=(format!("{name}, {}", column.unit)) { (value(&at.key(key), exact, &column.words(exact))) } }
    };
    html! { (cell("largest found", "attained", of.attained)) (cell("certified", "certified", of.certified)) }
}

/// Where the arm is drawn, and why there.
struct DrawnAt {
    q: RobotQ,
    pair: SourcePair,
    what: String,
}

/// The configuration that attains the bound of the position, or the worst that was found.
fn drawn_at(robot: &CheckedRobot<'_>) -> Option<DrawnAt> {
    let CheckReport { certificates, certificate_bracket, worst, comparisons, .. } = robot.geometry;
    let structure = &robot.description.robot;
    if let Some(brackets) = certificate_bracket {
        let attains = |of: &&ReportedCertificate| {
            of.brackets.as_ref().is_some_and(|of| of.position_m == brackets.position_m)
        };
        let pair = certificates.iter().find(attains)?.name;
        let [q, _] = brackets.attained_at(structure);
        return Some(DrawnAt {
            q,
            pair,
            what: "Where the difference of the tips comes nearest to its bound".to_owned(),
        });
    }
    let mut q = RobotQ::zeros(structure.dof());
    for (joint, value) in worst.at.iter() {
        q[structure.coordinate(structure.find_joint(joint)?)?] = value;
    }
    // Zero may be outside the limits of a joint that the worst does not name.
    move_inside_limits(&mut q, structure);
    let pair = comparisons.iter().find(|of| of.worst == *worst).map_or(SourcePair::ModelUrdf, |of| of.name);
    let what = format!(
        "Where the largest difference was found, {} at {}",
        length_and_angle(worst.error.position_m, worst.error.orientation_rad),
        worst.link
    );
    Some(DrawnAt { q, pair, what })
}

/// The arm where the difference is largest; nothing if it has no such configuration.
pub(super) fn picture(robot: &CheckedRobot<'_>) -> Markup {
    let Some(drawn) = drawn_at(robot) else { return html! {} };
    let DrawnAt { q, pair, what } = &drawn;
    let description = robot.description;
    let Some(urdf) = poses_by_urdf(description, q) else { return html! {} };
    let arm = |class: &'static str, name: &str, of: &RobotDescription, poses: &[Isometry3<f64>]| DrawnArm {
        class,
        name: name.to_owned(),
        skeleton: Skeleton::new(&of.robot, poses, of.tip),
    };
    let title = robot.geometry.title(*pair);
    let (first, there) = title.split_once(" against ").unwrap_or((title, ""));
    // Of a table and a URDF, or the physics that is made of it, the poses of the URDF are the twin's.
    let own = if first == "DH table" && *pair != SourcePair::UrdfOther { there } else { first };
    let mut arms = vec![arm("twin", own.trim_end_matches(" chain"), description, &urdf)];
    match (pair, robot.other) {
        (SourcePair::UrdfOther, Some(other)) => {
            let poses = poses_by_urdf(other, &positions_by_name(description, other, q));
            arms.extend(poses.map(|poses| arm("model", there.trim_end_matches(" chain"), other, &poses)));
        }
        _ if description.dh.is_some() => {
            let poses = poses_by_model(description, q);
            arms.extend(poses.map(|poses| arm("model", "DH table", description, &poses)));
        }
        _ => {}
    }
    let tips: Vec<_> = arms.iter().map(|arm| arm.skeleton.tip.translation.vector).collect();
    // With one arm there is no window, and the distance is 0.
    let tips_apart_m = tips.windows(2).map(|tips| (tips[0] - tips[1]).norm()).fold(0.0, f64::max);
    let bodies = shapes(&description.robot, &urdf).into_iter();
    let bodies = bodies.map(|(_, points)| PictureBody::shape(points)).collect();
    let two = TwoArms { figure: Figure { bodies, arms, path: Vec::new() }, tips_apart_m };
    let at = JointValues::for_movable_joints(&description.robot, q).for_people(&description.robot);
    let tip = &description.robot.link(description.tip).name;
    let caption = html! {
        (what) " (" (title) ")" @if !at.is_empty() { ": " (at) } ". The tips" @if *tip != robot.geometry.worst.link { " (" (tip) ")" } " are " (length(tips_apart_m)) " apart here."
    };
    two.markup(&caption)
}

fn poses_by_urdf(description: &RobotDescription, q: &RobotQ) -> Option<Vec<Isometry3<f64>>> {
    let mut poses = vec![Pose::identity(); description.robot.links().len()];
    UrdfTree::new(&description.robot).root_from_links_into(q, &mut poses).ok()?;
    Some(poses.iter().map(Pose::to_isometry).collect())
}

fn poses_by_model(description: &RobotDescription, q: &RobotQ) -> Option<Vec<Isometry3<f64>>> {
    let mut model = Model::new(description).ok()?;
    let poses = model.root_from_links(q).ok()?;
    Some(poses.iter().map(Pose::to_isometry).collect())
}

/// The same positions by the names of the joints.
fn positions_by_name(description: &RobotDescription, other: &RobotDescription, q: &RobotQ) -> RobotQ {
    let mut there = RobotQ::zeros(other.robot.dof());
    for (joint, value) in JointValues::for_movable_joints(&description.robot, q).iter() {
        let coordinate = other.robot.find_joint(joint).and_then(|joint| other.robot.coordinate(joint));
        if let Some(coordinate) = coordinate {
            there[coordinate] = value;
        }
    }
    there
}
