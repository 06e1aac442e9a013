//! The text of a scenario with comments.

use std::{collections::BTreeMap, fmt::Write};

use congruent_description::RobotDescription;
use congruent_input::{toml_key, toml_string};
use congruent_scenario::{Check, ControllerKind, JointMotion, MotionSettings, Scenario, TrackingCheck};

use crate::written::comment;

/// Content of a scenario before it is written as text.
pub(super) struct ScenarioContent {
    pub(super) scenario: Scenario,
    /// Remarks: the smallest distance, ignored pairs, and checks that are omitted with the reason.
    pub(super) remarks: Vec<String>,
}

/// The file; a key that is not given has its default.
pub(super) fn text(description: &RobotDescription, content: &ScenarioContent, duration_s: f64) -> String {
    let scenario = &content.scenario;
    let mut text = comment(&format!(
        "{}: made by `congruent new scenario`, which has run it: every check passed. {duration_s:.1} s of motion.\n\
         `congruent run` runs it, `congruent schema scenario` has all keys.",
        description.name
    ));
    for remark in &content.remarks {
        text += &comment(&format!("- {remark}"));
    }
    let _ = writeln!(text, "schema_version = {}", scenario.schema_version);
    let _ = writeln!(text, "name = {}", toml_string(&scenario.name));
    let _ = writeln!(text, "robot = {} # relative to this file", toml_string(&scenario.robot));
    start(&mut text, description, scenario);
    controller(&mut text, scenario);
    for (motion, about) in scenario.motion.iter().zip(["there", "and back"]) {
        let MotionSettings::Joints(motion) = motion else { continue };
        joint_motion(&mut text, description, motion, about);
    }
    for check in &scenario.check {
        let (keys, about) = keys_and_purpose(check);
        let _ = writeln!(text, "\n[[check]] # {about}\nkind = {}", toml_string(check.kind().word()));
        for (key, value) in keys {
            let _ = writeln!(text, "{key} = {value}");
        }
    }
    text + "\n[expect]\nverdict = \"pass\"\n"
}

fn start(text: &mut String, description: &RobotDescription, scenario: &Scenario) {
    let _ = writeln!(text, "\n[start] # within the limits, links apart");
    by_name(
        text,
        description,
        [("joints_deg", &scenario.start.joints_deg), ("joints_m", &scenario.start.joints_m)],
    );
}

fn controller(text: &mut String, scenario: &Scenario) {
    let kind = scenario.controller.kind;
    let _ = writeln!(text, "\n[controller]\nkind = {}", toml_string(kind.name()));
    text.push_str(match kind {
        ControllerKind::ComputedTorque => {
            "stiffness = 400.0 # 1/s^2: critically damped, whatever the masses are\ndamping = 40.0 # 1/s\n"
        }
        ControllerKind::GravityCompensation => {
            "stiffness = 2000.0 # N m/rad, N/m\ndamping = 120.0 # N m s/rad, N s/m\n"
        }
        _ => "",
    });
}

fn joint_motion(text: &mut String, description: &RobotDescription, motion: &JointMotion, about: &str) {
    let _ = writeln!(text, "\n[[motion]] # {about}");
    let joints = [("move_joints_deg", &motion.move_joints_deg), ("move_joints_m", &motion.move_joints_m)];
    by_name(text, description, joints);
    if let Some(duration_s) = motion.duration_s {
        let _ = writeln!(text, "duration_s = {duration_s:?}");
    }
    text.push_str("profile = \"quintic\"\n");
}

/// Positions by joint, in the robot's order.
fn by_name(text: &mut String, description: &RobotDescription, keys: [(&str, &BTreeMap<String, f64>); 2]) {
    for (key, values) in keys {
        let names = description.robot.movable_joint_names();
        let entries: Vec<String> =
            names.filter_map(|name| Some(format!("{} = {:?}", toml_key(name), values.get(name)?))).collect();
        if !entries.is_empty() {
            let _ = writeln!(text, "{key} = {{ {} }}", entries.join(", "));
        }
    }
}

/// The keys of a check, and what it is for.
fn keys_and_purpose(check: &Check) -> (Vec<(&'static str, String)>, &'static str) {
    let number = |value: f64| format!("{value:?}");
    let given = |key: &'static str, value: Option<f64>| value.map(|value| (key, number(value)));
    match check {
        Check::Agreement(check) => {
            let keys = [
                given("position_m", check.position_m),
                given("position_mm", check.position_mm),
                given("orientation_rad", check.orientation_rad),
                given("orientation_deg", check.orientation_deg),
            ];
            (keys.into_iter().flatten().collect(), "model against twin, every link, every sample")
        }
        Check::Tracking(TrackingCheck { path_deg, path_mm, goal_deg, goal_mm, .. }) => {
            let keys = [
                given("path_deg", *path_deg),
                given("path_mm", *path_mm),
                given("goal_deg", *goal_deg),
                given("goal_mm", *goal_mm),
            ];
            (keys.into_iter().flatten().collect(), "the twin against its setpoint")
        }
        Check::Clearance(check) => {
            let keys = [given("minimum_m", check.minimum_m), given("minimum_mm", check.minimum_mm)];
            let mut keys: Vec<_> = keys.into_iter().flatten().collect();
            keys.extend(ignore(&check.ignore));
            (keys, "distance between links")
        }
        Check::Contact(check) => (ignore(&check.ignore).into_iter().collect(), "no links touch"),
        Check::Limits(_) => (Vec::new(), "position, velocity and effort of each joint"),
        Check::Invariants(_) => (Vec::new(), "rotations are rotations, joint states are numbers"),
        Check::Twist(_) => (Vec::new(), "velocity by the Jacobian against the motion of the tool"),
        Check::Dynamics(_) => (Vec::new(), "the twin moves as forward dynamics says"),
        Check::Effort(_) => (Vec::new(), "the actuators deliver what they are commanded to"),
        Check::Power(_) => (Vec::new(), "the actuators' work is where it should be"),
        // Of a log, a given time, a target or a zone, which a new scenario has not.
        Check::CycleTime(_)
        | Check::Goal(_)
        | Check::Pose(_)
        | Check::Recording(_)
        | Check::Step(_)
        | Check::SamePoint(_)
        | Check::Velocity(_)
        | Check::Zone(_) => (Vec::new(), ""),
    }
}

fn ignore(pairs: &[[String; 2]]) -> Option<(&'static str, String)> {
    let pair = |[a, b]: &[String; 2]| format!("[{}, {}]", toml_string(a), toml_string(b));
    let pairs: Vec<String> = pairs.iter().map(pair).collect();
    (!pairs.is_empty()).then(|| ("ignore", format!("[{}]", pairs.join(", "))))
}
