//! Compares the velocity limits of revolute and continuous joints with the parts that they carry and with their torques.

use congruent_description::{Joint, JointKind};
use congruent_input::display::{number, quantity};

use super::{
    UnitCheck, UnitMistake,
    features::median,
    lengths::is_real,
    thresholds::{
        FASTEST_CONTINUOUS_RAD_S, FASTEST_ROTOR_RAD_S, FASTEST_TURN_RAD_S, LEAST_FAST_RAD_S, LEAST_MASS_KG,
        LEAST_ODD_RAD_S, MEDIAN_TURN_RAD_S, MOST_LAST_SPEED_TO_MEDIAN, MOST_POWER_OF_FAST, MOST_POWER_W_KG,
        MOST_SPEED_TO_MEDIAN,
    },
};
use crate::codes;

const SPEED: UnitMistake = UnitMistake {
    code: codes::units::SPEED,
    words: "joints have an implausible velocity limit",
    element: "limit",
};

pub(super) fn speed(joint: &Joint) -> Option<f64> {
    let speed = joint.limit.filter(|_| joint.kind.is_angular())?.velocity?;
    (is_real(speed) && speed > 0.0).then_some(speed)
}

/// Torque times speed of a joint of usual speed, W.
fn usual_power_w(joint: &Joint) -> Option<f64> {
    let effort = joint.limit?.effort.filter(|effort| is_real(*effort))?;
    Some(effort * speed(joint).filter(|speed| *speed <= LEAST_ODD_RAD_S)?)
}

impl UnitCheck<'_> {
    /// Reports implausible velocity limits. `fastest_tip_m_s` is the largest plausible speed of a carried point; `None` if the
    /// lengths of the file are not reliable.
    pub(super) fn speeds(&mut self, fastest_tip_m_s: Option<f64>) {
        let robot = self.robot;
        let speeds = || robot.joints().iter().filter_map(speed);
        // Of fewer joints a median says nothing.
        let middle = median(speeds()).filter(|_| speeds().count() >= 4);
        let all_are_fast = middle > Some(MEDIAN_TURN_RAD_S);
        let mass_kg: f64 = robot.links().iter().filter_map(|link| Some(link.inertia?.mass_kg)).sum();
        let usual_w = robot.joints().iter().filter_map(usual_power_w).fold(0.0, f64::max);
        for joint in robot.joints() {
            let is_last = !self.sizes.carries_joint[joint.child.get()];
            let least = if is_last { LEAST_FAST_RAD_S } else { LEAST_ODD_RAD_S };
            let Some(speed) = speed(joint).filter(|speed| *speed > least) else { continue };
            if self.is_rotor(joint) && speed < FASTEST_ROTOR_RAD_S {
                continue;
            }
            let most = if joint.kind == JointKind::Continuous || is_last {
                FASTEST_CONTINUOUS_RAD_S
            } else {
                FASTEST_TURN_RAD_S
            };
            let carried_m_s = speed * self.sizes.radius_m(robot, joint);
            let effort = joint.limit.and_then(|limit| limit.effort).filter(|effort| is_real(*effort));
            let power_w = effort.map_or(0.0, |effort| effort * speed);
            // Only joints with a range are compared with the median: wheels and rotors may be far faster than the arm beside them.
            let most_to_median = if is_last { MOST_LAST_SPEED_TO_MEDIAN } else { MOST_SPEED_TO_MEDIAN };
            let is_odd = joint.kind == JointKind::Revolute
                && middle.is_some_and(|middle| speed > most_to_median * middle)
                && !(power_w > 0.0 && power_w <= MOST_POWER_OF_FAST * usual_w);
            let why = if speed > most || (all_are_fast && speed > MEDIAN_TURN_RAD_S) {
                String::new()
            } else if let (true, Some(middle)) = (is_odd, middle) {
                format!(", but the median of the robot's joints is {} rad/s", number(middle))
            } else if speed <= LEAST_FAST_RAD_S {
                continue;
            } else if fastest_tip_m_s.is_some_and(|fastest_m_s| carried_m_s > fastest_m_s) {
                format!(", at which the parts that it carries would reach {}", quantity(carried_m_s, "m/s"))
            } else if mass_kg > LEAST_MASS_KG && power_w > MOST_POWER_W_KG * mass_kg {
                format!(
                    ", which times its effort limit is {} for a robot of {}",
                    quantity(power_w, "W"),
                    quantity(mass_kg, "kg")
                )
            } else {
                continue;
            };
            let what = format!("its velocity limit is {} rad/s{why}", number(speed));
            let help = format!(
                "the velocity is read in rad/s: if the value is in deg/s, {0} deg/s are {1} rad/s; {0} rpm are {2} rad/s",
                number(speed),
                number(speed.to_radians()),
                number(speed * std::f64::consts::TAU / 60.0)
            );
            self.warn_joint(&SPEED, &joint.name, &what, help);
        }
    }

    /// Whether a joint turns a propeller, a spindle or the like. Only the names of the joint and its link distinguish it from a
    /// wrist.
    pub(super) fn is_rotor(&self, joint: &Joint) -> bool {
        let carries_none = self.robot.joints().iter().all(|other| other.parent != joint.child);
        let names = [&joint.name, &self.robot.link(joint.child).name].map(|name| name.to_lowercase());
        carries_none && ROTORS.iter().any(|rotor| names.iter().any(|name| name.contains(rotor)))
    }
}

/// Parts of the names of joints and links that turn fast.
const ROTORS: [&str; 8] = ["prop", "rotor", "spin", "flywheel", "fan", "turbine", "thruster", "centrifuge"];
