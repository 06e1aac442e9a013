//! Speeds of turning joints against what they carry and what drives them.

use super::{
    Judge, Kind,
    features::median,
    lengths::is_real,
    thresholds::{
        FASTEST_CONTINUOUS_RAD_S, FASTEST_ROTOR_RAD_S, FASTEST_TURN_RAD_S, LEAST_FAST_RAD_S, LEAST_MASS_KG,
        MEDIAN_TURN_RAD_S, MOST_POWER_W_KG, MOST_SPEED_TO_MEDIAN,
    },
};
use crate::{
    display::{number, quantity},
    model::{Joint, JointKind},
};

const SPEED: Kind = Kind { code: "units::speed", words: "joints turn faster than any joint does" };

fn speed(joint: &Joint) -> Option<f64> {
    let speed = joint.limit.filter(|_| joint.kind.is_angular())?.velocity?;
    (is_real(speed) && speed > 0.0).then_some(speed)
}

impl Judge<'_> {
    /// With the fastest speed of a point, if lengths are as they should be.
    pub(super) fn speeds(&mut self, fastest_tip_m_s: Option<f64>) {
        let robot = self.robot;
        let speeds = || robot.joints().iter().filter_map(speed);
        let middle = median(speeds()).filter(|_| speeds().count() >= 4);
        let all_are_fast = middle > Some(MEDIAN_TURN_RAD_S);
        let mass_kg: f64 = robot.links().iter().filter_map(|link| Some(link.inertia?.mass_kg)).sum();
        for joint in robot.joints() {
            let Some(speed) = speed(joint).filter(|speed| *speed > LEAST_FAST_RAD_S) else { continue };
            if self.is_rotor(joint) && speed < FASTEST_ROTOR_RAD_S {
                continue;
            }
            let most = if joint.kind == JointKind::Continuous {
                FASTEST_CONTINUOUS_RAD_S
            } else {
                FASTEST_TURN_RAD_S
            };
            let carried_m_s = speed * self.sizes.radius_m(robot, joint);
            let effort = joint.limit.and_then(|limit| limit.effort).filter(|effort| is_real(*effort));
            let power_w = effort.map_or(0.0, |effort| effort * speed);
            // Wheels and rotors turn without limits, beside slow arms.
            let is_odd = joint.kind == JointKind::Revolute
                && middle.is_some_and(|middle| speed > MOST_SPEED_TO_MEDIAN * middle);
            let why = if speed > most || (all_are_fast && speed > MEDIAN_TURN_RAD_S) {
                String::new()
            } else if let (true, Some(middle)) = (is_odd, middle) {
                format!(": the middle one of the robot turns with {} rad/s", number(middle))
            } else if fastest_tip_m_s.is_some_and(|fastest_m_s| carried_m_s > fastest_m_s) {
                format!(": what it carries would reach {}", quantity(carried_m_s, "m/s"))
            } else if mass_kg > LEAST_MASS_KG && power_w > MOST_POWER_W_KG * mass_kg {
                format!(
                    ": with its torque that is {}, of a robot of {}",
                    quantity(power_w, "W"),
                    quantity(mass_kg, "kg")
                )
            } else {
                continue;
            };
            let what = format!("its velocity is {} rad/s{why}", number(speed));
            let help = format!(
                "the velocity is in rad/s: {} deg/s are {} rad/s",
                number(speed),
                number(speed.to_radians())
            );
            self.warn_joint(&SPEED, &joint.name, &what, ("limit", help));
        }
    }

    /// Whether a joint turns a propeller, a spindle or the like, by its name or that of its link, as nothing else in the file
    /// tells it from a wrist.
    fn is_rotor(&self, joint: &Joint) -> bool {
        let carries_none = self.robot.joints().iter().all(|other| other.parent != joint.child);
        let names = [&joint.name, &self.robot.link(joint.child).name].map(|name| name.to_lowercase());
        carries_none && ROTORS.iter().any(|rotor| names.iter().any(|name| name.contains(rotor)))
    }
}

/// Parts of names of what turns fast.
const ROTORS: [&str; 8] = ["prop", "rotor", "spin", "flywheel", "fan", "turbine", "thruster", "centrifuge"];
