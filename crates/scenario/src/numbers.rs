//! Checks the numbers of a scenario that was made in code; those of a file are checked as they are read.

use congruent_input::Diagnostic;

use crate::{
    ArcMotion, Check, LineMotion, MotionSettings, ObstacleSettings, Range, Scenario, SourceSettings,
    ZoneSettings, codes,
};

/// All numbers that are out of range.
pub fn check(scenario: &Scenario) -> Vec<Diagnostic> {
    let mut numbers = Numbers(Vec::new());
    let simulation = &scenario.simulation;
    numbers.one("simulation.step_s", simulation.step_s, Range::Positive);
    numbers.check_optional("simulation.duration_s", simulation.duration_s, Range::Positive);
    simulation
        .gravity_m_s2
        .iter()
        .for_each(|&value| numbers.one("simulation.gravity_m_s2", value, Range::Finite));
    numbers.one("simulation.contact_friction", simulation.contact_friction, Range::NonNegative);
    numbers.one("simulation.contact_restitution", simulation.contact_restitution, Range::Share);
    numbers.check_optional("controller.rate_hz", scenario.controller.rate_hz, Range::Positive);
    numbers.check_optional("controller.delay_s", scenario.controller.delay_s, Range::Positive);
    scenario.source.iter().for_each(|source| numbers.source(source));
    for payload in &scenario.payload {
        numbers.one("payload.mass_kg", payload.mass_kg, Range::Positive);
        numbers.one("payload.from_s", payload.from_s, Range::NonNegative);
        numbers.check_optional("payload.until_s", payload.until_s, Range::Positive);
    }
    numbers.check_optional(
        "output.trajectory_period_s",
        scenario.output.trajectory_period_s,
        Range::Positive,
    );
    for motion in &scenario.motion {
        numbers.check_optional("motion.duration_s", motion.duration_s(), Range::Positive);
        numbers.motion(motion);
    }
    for obstacle in &scenario.obstacle {
        numbers.shape("obstacle", obstacle);
        obstacle
            .scale
            .iter()
            .flatten()
            .for_each(|&value| numbers.one("obstacle.scale", value, Range::Positive));
        let times = obstacle.path.iter().map(|pose| pose.at_s);
        times.for_each(|at_s| numbers.one("obstacle.path.at_s", at_s, Range::NonNegative));
    }
    for grasp in &scenario.grasp {
        numbers.one("grasp.from_s", grasp.from_s, Range::NonNegative);
        numbers.check_optional("grasp.until_s", grasp.until_s, Range::Positive);
        numbers.check_optional("grasp.reach_m", grasp.reach_m, Range::NonNegative);
        numbers.check_optional("grasp.reach_mm", grasp.reach_mm, Range::NonNegative);
        numbers.check_optional("grasp.mass_kg", grasp.mass_kg, Range::Positive);
        let inertia = grasp.inertia_kg_m2.iter().flatten();
        inertia.for_each(|&value| numbers.one("grasp.inertia_kg_m2", value, Range::Positive));
    }
    for zone in scenario.zone.iter().map(ZoneSettings::space) {
        numbers.shape("zone", &zone);
    }
    for check in &scenario.check {
        numbers.limits(check);
        numbers.check_optional("check.passing", check.passing(), Range::InnerShare);
    }
    if let Some(uncertainty) = &scenario.uncertainty {
        numbers.one("uncertainty.confidence", uncertainty.confidence, Range::InnerShare);
    }
    numbers.0
}

struct Numbers(Vec<Diagnostic>);

impl Numbers {
    fn one(&mut self, key: &str, value: f64, range: Range) {
        if !range.contains(value) {
            let message = format!("{key}: expected {}, found {value}", range.words());
            self.0.push(Diagnostic::error(codes::scenario::NUMBER, message));
        }
    }

    fn check_optional(&mut self, key: &str, value: Option<f64>, range: Range) {
        if let Some(value) = value {
            self.one(key, value, range);
        }
    }

    fn source(&mut self, source: &SourceSettings) {
        self.check_optional("source.rate_hz", source.rate_hz, Range::Positive);
        self.check_optional("source.from_s", source.from_s, Range::Finite);
        self.check_optional("source.until_s", source.until_s, Range::Finite);
        self.check_optional("source.maximum_gap_s", source.maximum_gap_s, Range::Positive);
        for pose in &source.pose {
            self.one("source.pose.offset_s", pose.offset_s, Range::Finite);
            self.one("source.pose.drift", pose.drift, Range::Finite);
        }
    }

    fn motion(&mut self, motion: &MotionSettings) {
        let (speed, blend_m) = match motion {
            MotionSettings::Servo(motion) => {
                return self.check_optional("motion.gain_per_s", motion.gain_per_s, Range::Positive);
            }
            MotionSettings::Line(LineMotion { speed_m_s, acceleration_m_s2, jerk_m_s3, blend_m, .. })
            | MotionSettings::Arc(ArcMotion { speed_m_s, acceleration_m_s2, jerk_m_s3, blend_m, .. }) => {
                ([*speed_m_s, *acceleration_m_s2, *jerk_m_s3], *blend_m)
            }
            MotionSettings::TcpPath(path) => {
                ([Some(path.speed_m_s), path.acceleration_m_s2, path.jerk_m_s3], path.blend_m)
            }
            // Times of a path are checked with its points.
            MotionSettings::Joints(_)
            | MotionSettings::Tcp(_)
            | MotionSettings::JointPath(_)
            | MotionSettings::Playback(_) => return,
        };
        for (key, value) in ["speed_m_s", "acceleration_m_s2", "jerk_m_s3"].into_iter().zip(speed) {
            self.check_optional(&format!("motion.{key}"), value, Range::Positive);
        }
        self.one("motion.blend_m", blend_m, Range::NonNegative);
    }

    fn shape(&mut self, what: &str, shape: &ObstacleSettings) {
        let key = |name: &str| format!("{what}.{name}");
        shape.box_m.iter().flatten().for_each(|&edge| self.one(&key("box_m"), edge, Range::Positive));
        self.check_optional(&key("sphere_radius_m"), shape.sphere_radius_m, Range::Positive);
        if let Some(cylinder) = shape.cylinder {
            self.one(&key("cylinder.radius_m"), cylinder.radius_m, Range::Positive);
            self.one(&key("cylinder.length_m"), cylinder.length_m, Range::Positive);
        }
    }

    fn limits(&mut self, check: &Check) {
        match check {
            Check::Contact(check) => self.check_optional("check.force_n", check.force_n, Range::NonNegative),
            Check::CycleTime(check) => self.one("check.limit_s", check.limit_s, Range::Positive),
            Check::Dynamics(check) => self.check_optional("check.relative", check.relative, Range::Positive),
            Check::Effort(check) => {
                self.check_optional("check.relative", check.relative, Range::Positive);
                self.check_optional("check.unexplained_share", check.unexplained_share, Range::Share);
            }
            Check::SamePoint(check) => self.check_optional("check.still_s", check.still_s, Range::Positive),
            Check::Invariants(check) => {
                self.check_optional("check.rotation", check.rotation, Range::Positive);
            }
            Check::Limits(check) => {
                self.check_optional("check.velocity_share", check.velocity_share, Range::Positive);
                self.check_optional("check.effort_share", check.effort_share, Range::Positive);
            }
            Check::Power(check) => self.check_optional("check.relative", check.relative, Range::Positive),
            Check::Tracking(check) => {
                self.check_optional("check.settling_s", check.settling_s, Range::NonNegative);
                self.check_optional("check.travel_share", check.travel_share, Range::Positive);
            }
            Check::Recording(check) => {
                self.check_optional("check.used_share", check.used_share, Range::Share);
                self.check_optional("check.longest_gap_s", check.longest_gap_s, Range::Positive);
            }
            Check::Velocity(check) => self.check_optional("check.factor", check.factor, Range::Positive),
            Check::Agreement(_)
            | Check::Clearance(_)
            | Check::Goal(_)
            | Check::Pose(_)
            | Check::Step(_)
            | Check::Twist(_)
            | Check::Zone(_) => {}
        }
        let range = match check {
            Check::Agreement(_) | Check::Goal(_) | Check::Pose(_) | Check::SamePoint(_) | Check::Step(_) => {
                Range::Positive
            }
            _ => Range::NonNegative,
        };
        for keys in check.unit_keys() {
            for (key, value) in keys.keys.into_iter().zip(keys.written) {
                self.check_optional(&format!("check.{key}"), value, range);
            }
        }
    }
}
