//! Compares the effort limits and the damping of turning joints with their speeds and with the mass of the robot.

use congruent_description::Joint;
use congruent_input::display::{number, quantity};

use super::{
    UnitCheck, UnitMistake,
    features::has_one_digit,
    speeds::speed,
    thresholds::{
        LEAST_FAST_RAD_S, LEAST_MASS_KG, LEAST_PLACEHOLDER_N_M, MOST_DAMPING_TO_EFFORT,
        MOST_PLACEHOLDER_POWER_W_KG, MOST_ROTOR_W, MOST_TORQUE_POWER_W_KG, MOST_TORQUE_TO_OTHERS,
    },
};
use crate::codes;

const EFFORT: UnitMistake = UnitMistake {
    code: codes::units::EFFORT,
    words: "joints have an implausible effort limit",
    element: "limit",
};
const DAMPING: UnitMistake = UnitMistake {
    code: codes::units::DAMPING,
    words: "joints have an implausible damping",
    element: "dynamics",
};

const FRICTION: UnitMistake = UnitMistake {
    code: codes::units::FRICTION,
    words: "joints have a dry friction above their effort limit",
    element: "dynamics",
};

/// An effort limit with what it is compared with.
#[derive(Debug, Clone, Copy)]
struct TorqueOfJoint {
    effort: f64,
    /// Times the velocity limit.
    power_w: f64,
    /// Mass of the robot.
    mass_kg: f64,
    /// The largest effort limit of the other turning joints.
    others: f64,
}

/// The effort limit of a turning joint, N m; 0 stands for an unknown one.
fn effort_limit(joint: &Joint) -> Option<f64> {
    let limit = joint.limit.filter(|_| joint.kind.is_angular())?;
    limit.effort.filter(|effort| *effort > 0.0)
}

impl UnitCheck<'_> {
    /// Reports implausible effort limits and damping of turning joints, and friction that no joint could overcome.
    pub(super) fn efforts(&mut self) {
        let robot = self.robot;
        robot.joints().iter().for_each(|joint| self.friction(joint));
        let mass_kg: f64 = robot.links().iter().filter_map(|link| Some(link.inertia?.mass_kg)).sum();
        for joint in robot.joints() {
            // Without a speed neither a power nor a loss is known; the speed of a fast joint is examined with its torque.
            let Some(speed) = speed(joint) else { continue };
            let Some(effort) = joint.limit.and_then(|limit| limit.effort).filter(|effort| *effort > 0.0)
            else {
                continue;
            };
            // A rotor may have any speed, and propellers are written with any torque, but not with the power of a ship.
            if speed > LEAST_FAST_RAD_S && (!self.is_rotor(joint) || effort * speed < MOST_ROTOR_W) {
                continue;
            }
            let of_others =
                robot.joints().iter().filter(|other| other.name != joint.name).filter_map(effort_limit);
            let others = of_others.fold(0.0, f64::max);
            if !self.torque(joint, TorqueOfJoint { effort, power_w: effort * speed, mass_kg, others }) {
                self.damping(joint, effort, speed);
            }
        }
    }

    /// Reports an effort limit whose power no motor of the robot's mass has, or far above those of all other joints; whether it did.
    fn torque(&mut self, joint: &Joint, of: TorqueOfJoint) -> bool {
        let TorqueOfJoint { effort, power_w, mass_kg, others } = of;
        let is_placeholder = effort >= LEAST_PLACEHOLDER_N_M && has_one_digit(effort);
        let most = if is_placeholder { MOST_PLACEHOLDER_POWER_W_KG } else { MOST_TORQUE_POWER_W_KG };
        // Powers of ten of any size, and numbers such as 2e6, stand for "no limit".
        let is_unlimited = is_placeholder && (libm::log10(effort).fract() == 0.0 || effort >= 1e6);
        let why = if is_unlimited {
            return false;
        } else if mass_kg > LEAST_MASS_KG && power_w > most * mass_kg {
            format!(
                "which times its velocity limit is {} for a robot of {}",
                quantity(power_w, "W"),
                quantity(mass_kg, "kg")
            )
        } else if others > 0.0 && effort > MOST_TORQUE_TO_OTHERS * others && !is_placeholder {
            format!("but the largest of the robot's other joints is {} N m", number(others))
        } else {
            return false;
        };
        let what = format!("its effort limit is {} N m, {why}", number(effort));
        let help = format!(
            "the effort is read in N m: if the value is in N mm, {} N mm are {} N m",
            number(effort),
            number(effort / 1000.0)
        );
        self.warn_joint(&EFFORT, &joint.name, &what, help);
        true
    }

    /// Reports a dry friction that the effort limit cannot overcome.
    fn friction(&mut self, joint: &Joint) {
        let effort = joint.limit.and_then(|limit| limit.effort).filter(|effort| *effort > 0.0);
        let Some(effort) = effort.filter(|effort| joint.friction > *effort) else { return };
        let unit = if joint.kind.is_angular() { "N m" } else { "N" };
        let what = format!(
            "its dry friction is {} {unit}, more than its effort limit of {} {unit}: its motor could never move it",
            number(joint.friction),
            number(effort)
        );
        let help = format!("the friction is read in {unit}: is the value 1000 times too large, as in N mm?");
        self.warn_joint(&FRICTION, &joint.name, &what, help);
    }

    /// Reports a damping that takes many times the effort limit at the velocity limit.
    fn damping(&mut self, joint: &Joint, effort: f64, speed: f64) {
        let lost = joint.damping * speed;
        if lost <= MOST_DAMPING_TO_EFFORT * effort {
            return;
        }
        let what = format!(
            "its damping is {} N m s/rad, which at its velocity limit takes {} N m, {} times its effort limit",
            number(joint.damping),
            number(lost),
            number(lost / effort)
        );
        let help = "the damping is read in N m s/rad: is the value in N mm s/rad?".to_owned();
        self.warn_joint(&DAMPING, &joint.name, &what, help);
    }
}
