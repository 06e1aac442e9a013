//! The drive of a joint in one step: a torque and a servo, within the limits of effort and speed.
//!
//! The servo's law `stiffness (q - q(t)) + damping (qd - qd(t))` holds for the state at the end of the step. Within
//! the effort limit it is linear: a spring and a damper, which rapier adds to the mass matrix and solves exactly. A servo
//! at its effort limit is not linear: it becomes a constraint, which rapier's sweeps solve.

use congruent_description::SPEED_MARGIN;

use crate::commands::{Gains, Motor};

/// Largest shift of a spring's rest position by which it exerts a constant torque, rad or m: the sum loses at most 1e-14.
const LARGEST_SHIFT: f64 = 100.0;

/// Which limits of an actuator were active in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Saturation {
    /// The controller commanded more than the effort limit.
    pub effort: bool,
    /// The actuator would have driven the joint faster than its velocity limit.
    pub speed: bool,
}

/// Limits of an actuator; `f64::MAX` if there is no limit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DriveCapability {
    /// Effort limit of the joint, N m or N.
    pub effort: f64,
    /// Velocity limit of the joint, rad/s or m/s.
    pub speed: f64,
}

/// Position and velocity of a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CoordinateState {
    pub q: f64,
    pub qd: f64,
}

/// A torque that is constant over the step, and a servo.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct JointDrive {
    pub torque: f64,
    pub servo: Option<Motor>,
    /// Whether the servo reaches its effort limit, so that its law is not linear.
    pub is_constrained: bool,
    pub saturation: Saturation,
}

impl DriveCapability {
    /// The drive that is commanded, within the limits.
    pub(crate) fn drive(
        self,
        torque: f64,
        servo: Option<Motor>,
        state: CoordinateState,
        step_s: f64,
    ) -> JointDrive {
        let mut drive =
            JointDrive { torque: torque.clamp(-self.effort, self.effort), servo, ..JointDrive::default() };
        // By bits: any change by the clamp counts, however small.
        drive.saturation.effort = drive.torque.to_bits() != torque.to_bits();
        if !self.limit_speed(&mut drive, state) && drive.servo.is_some() {
            // A guess of the state at the end, to which the law applies; `correct` repeats the step if it was wrong.
            let end = CoordinateState { q: state.q + step_s * state.qd, ..state };
            drive.is_constrained = drive.effort(end).abs() > self.effort;
        }
        drive
    }

    /// Turns a drive that pushes a joint beyond its largest speed into one that holds this speed, and brakes if necessary;
    /// returns whether it did.
    fn limit_speed(self, drive: &mut JointDrive, state: CoordinateState) -> bool {
        let wanted = drive.effort(state).clamp(-self.effort, self.effort);
        // Braking is never limited, and once limited a drive stays so for the step: corrections have to end.
        if wanted * state.qd <= 0.0 || state.qd.abs() <= self.speed || drive.saturation.speed {
            return false;
        }
        // The effort falls linearly from the commanded one to zero within the margin: no jump, and stable, since implicit.
        let margin = SPEED_MARGIN * self.speed;
        let gains = Gains { stiffness: 0.0, damping: wanted.abs() / margin };
        // Beyond the limit by the margin, where the damping's effort is zero: at the limit itself it is the wanted
        // one.
        let qd = (self.speed + margin).copysign(wanted);
        (drive.torque, drive.servo) = (0.0, Some(Motor { gains, q: state.q, qd }));
        drive.is_constrained = drive.effort(state).abs() > self.effort;
        drive.saturation.speed = true;
        true
    }

    /// Corrects a drive that took the joint beyond a limit in a step that ended in a state; returns whether it did.
    pub(crate) fn correct(self, drive: &mut JointDrive, end: CoordinateState) -> bool {
        if self.limit_speed(drive, end) {
            return true;
        }
        // Only towards constrained, never back: the repeated step may end below the limit again, and would then
        // alternate.
        let exceeds = drive.servo.is_some() && !drive.is_constrained && self.exerted(drive, end).1;
        drive.is_constrained |= exceeds;
        exceeds
    }

    /// The effort of a drive in a step that ended in a state, and whether it is the largest.
    pub(crate) fn exerted(self, drive: &JointDrive, end: CoordinateState) -> (f64, bool) {
        let effort = drive.effort(end);
        (effort.clamp(-self.effort, self.effort), effort.abs() > self.effort)
    }
}

impl JointDrive {
    /// The effort at a state, without the limit.
    fn effort(&self, state: CoordinateState) -> f64 {
        let servo = self.servo.map_or(0.0, |Motor { gains, q, qd }| {
            gains.stiffness * (q - state.q) + gains.damping * (qd - state.qd)
        });
        self.torque + servo
    }

    /// The servo that exerts the torque as well: its target is shifted. `None` without a servo.
    pub(crate) fn combined(&self) -> Option<Motor> {
        self.servo.map(|mut motor| {
            let Gains { stiffness, damping } = motor.gains;
            // By the larger gain, so that the shift is small and a gain of zero is never a divisor.
            if stiffness > damping {
                motor.q += self.torque / stiffness;
            } else {
                motor.qd += self.torque / damping;
            }
            motor
        })
    }

    /// The drive as a spring, a damper and a constant torque.
    pub(crate) fn linear(&self) -> Linear {
        let Some(Motor { gains: Gains { stiffness, damping }, q, qd }) = self.servo else {
            return Linear { torque: self.torque, ..Linear::default() };
        };
        let torque = self.torque + damping * qd;
        // Infinite or NaN without stiffness; the comparison below then keeps the constant torque.
        let shift = torque / stiffness;
        if shift.abs() < LARGEST_SHIFT {
            return Linear { stiffness, damping, rest: q + shift, torque: 0.0 };
        }
        Linear { stiffness, damping, rest: q, torque }
    }
}

/// `stiffness (rest - q) - damping qd + torque`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Linear {
    pub stiffness: f64,
    pub damping: f64,
    pub rest: f64,
    pub torque: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAPABILITY: DriveCapability = DriveCapability { effort: 20.0, speed: 2.0 };
    const AT_REST: CoordinateState = CoordinateState { q: 0.0, qd: 0.0 };

    fn servo(stiffness: f64, damping: f64, q: f64) -> Motor {
        Motor { gains: Gains { stiffness, damping }, q, qd: 0.0 }
    }

    #[test]
    fn the_combined_servo_exerts_the_torque_as_well() {
        for gains in [(400.0, 40.0), (3.0, 40.0), (0.0, 40.0), (400.0, 0.0)] {
            let drive = JointDrive {
                torque: 7.0,
                servo: Some(servo(gains.0, gains.1, 0.01)),
                ..JointDrive::default()
            };
            let state = CoordinateState { q: 0.003, qd: -0.2 };
            let both = JointDrive { torque: 0.0, servo: drive.combined(), ..drive };
            assert!((both.effort(state) - drive.effort(state)).abs() < 1e-13, "{gains:?}");
        }
    }

    #[test]
    fn the_linear_drive_is_the_same_law() {
        for gains in [(400.0, 40.0), (1e-6, 40.0), (0.0, 40.0), (400.0, 0.0)] {
            let mut drive = JointDrive {
                torque: 7.0,
                servo: Some(servo(gains.0, gains.1, 0.01)),
                ..JointDrive::default()
            };
            drive.servo.as_mut().unwrap().qd = 0.7;
            let state = CoordinateState { q: 0.003, qd: -0.2 };
            let Linear { stiffness, damping, rest, torque } = drive.linear();
            let effort = stiffness * (rest - state.q) - damping * state.qd + torque;
            assert!((effort - drive.effort(state)).abs() < 1e-12, "{gains:?}");
        }
    }

    #[test]
    fn a_joint_at_its_largest_speed_is_braked_but_not_pushed() {
        let fast = CoordinateState { q: 0.0, qd: 2.001 };
        let pushed = CAPABILITY.drive(5.0, None, fast, 1e-3);
        let speed_only = Saturation { effort: false, speed: true };
        assert_eq!(pushed.saturation, speed_only);
        // In the middle of the margin half of the torque is left, beyond it the drive brakes.
        assert!((pushed.effort(fast) - 2.5).abs() < 1e-9, "{pushed:?}");
        assert!(pushed.effort(CoordinateState { q: 0.0, qd: 2.1 }) < 0.0);
        let braked = CAPABILITY.drive(-5.0, None, fast, 1e-3);
        assert_eq!(
            (braked.effort(fast).to_bits(), braked.saturation),
            ((-5.0_f64).to_bits(), Saturation::default())
        );
        let mut unaware = CAPABILITY.drive(5.0, None, AT_REST, 1e-3);
        assert!(CAPABILITY.correct(&mut unaware, fast) && unaware.saturation == speed_only);
    }

    #[test]
    fn torque_and_servo_have_one_effort_limit() {
        let drive = CAPABILITY.drive(15.0, Some(servo(100.0, 1e3, 0.1)), AT_REST, 1e-3);
        assert!(drive.is_constrained);
        assert_eq!(CAPABILITY.exerted(&drive, AT_REST), (20.0, true));
        let opposed = CAPABILITY.drive(15.0, Some(servo(100.0, 1e3, -0.3)), AT_REST, 1e-3);
        assert!(!opposed.is_constrained, "15 - 30 N m are within 20");
        assert!(CAPABILITY.drive(25.0, None, AT_REST, 1e-3).saturation.effort);
    }
}
