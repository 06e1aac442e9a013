//! Checks the numbers of a scenario that was made in code; those of a file are checked as they are read.

use congruent_description::Diagnostic;

use crate::scenario::{Check, MotionSettings, ObstacleSettings, Range, Scenario, ZoneSettings};

/// All numbers that are out of range.
pub(super) fn check(scenario: &Scenario) -> Vec<Diagnostic> {
    let mut numbers = Numbers(Vec::new());
    let simulation = &scenario.simulation;
    numbers.one("simulation.step_s", simulation.step_s, Range::Positive);
    numbers.maybe("simulation.duration_s", simulation.duration_s, Range::Positive);
    simulation
        .gravity_m_s2
        .iter()
        .for_each(|&value| numbers.one("simulation.gravity_m_s2", value, Range::Finite));
    numbers.one("controller.stiffness", scenario.controller.stiffness, Range::NonNegative);
    numbers.one("controller.damping", scenario.controller.damping, Range::NonNegative);
    for motion in &scenario.motion {
        let duration_s = match motion {
            MotionSettings::Joints(motion) => motion.duration_s,
            MotionSettings::Tcp(motion) => motion.duration_s,
            MotionSettings::Servo(motion) => {
                numbers.maybe("motion.gain_per_s", motion.gain_per_s, Range::Positive);
                motion.duration_s
            }
        };
        numbers.one("motion.duration_s", duration_s, Range::Positive);
    }
    for obstacle in &scenario.obstacle {
        numbers.shape("obstacle", obstacle);
    }
    for zone in scenario.zone.iter().map(ZoneSettings::space) {
        numbers.shape("zone", &zone);
    }
    for check in &scenario.check {
        numbers.limits(check);
    }
    numbers.0
}

struct Numbers(Vec<Diagnostic>);

impl Numbers {
    fn one(&mut self, key: &str, value: f64, range: Range) {
        if !range.contains(value) {
            let message = format!("{key}: expected {}, found {value}", range.words());
            self.0.push(Diagnostic::error("scenario::number", message));
        }
    }

    fn maybe(&mut self, key: &str, value: Option<f64>, range: Range) {
        if let Some(value) = value {
            self.one(key, value, range);
        }
    }

    fn shape(&mut self, what: &str, shape: &ObstacleSettings) {
        let key = |name: &str| format!("{what}.{name}");
        shape.box_m.iter().flatten().for_each(|&edge| self.one(&key("box_m"), edge, Range::Positive));
        self.maybe(&key("sphere_radius_m"), shape.sphere_radius_m, Range::Positive);
        if let Some(cylinder) = shape.cylinder {
            self.one(&key("cylinder.radius_m"), cylinder.radius_m, Range::Positive);
            self.one(&key("cylinder.length_m"), cylinder.length_m, Range::Positive);
        }
    }

    fn limits(&mut self, check: &Check) {
        match check {
            Check::Agreement(check) => {
                self.maybe("check.position_m", check.position_m, Range::Positive);
                self.maybe("check.orientation_rad", check.orientation_rad, Range::Positive);
            }
            Check::Clearance(check) => self.one("check.minimum_m", check.minimum_m, Range::NonNegative),
            Check::Goal(check) => {
                self.one("check.position_m", check.position_m, Range::Positive);
                self.maybe("check.orientation_rad", check.orientation_rad, Range::Positive);
            }
            Check::CycleTime(check) => self.one("check.limit_s", check.limit_s, Range::Positive),
            Check::Dynamics(check) => self.maybe("check.relative", check.relative, Range::Positive),
            Check::Invariants(check) => self.maybe("check.rotation", check.rotation, Range::Positive),
            Check::Limits(check) => {
                self.maybe("check.velocity_share", check.velocity_share, Range::Positive);
                self.maybe("check.effort_share", check.effort_share, Range::Positive);
            }
            Check::Power(check) => self.maybe("check.relative", check.relative, Range::Positive),
            Check::Tracking(check) => self.maybe("check.settling_s", check.settling_s, Range::NonNegative),
            Check::Contact(_) | Check::Twist(_) | Check::Zone(_) => {}
        }
        for keys in check.unit_keys() {
            for (key, value) in keys.keys.into_iter().zip(keys.written) {
                self.maybe(&format!("check.{key}"), value, Range::NonNegative);
            }
        }
    }
}
