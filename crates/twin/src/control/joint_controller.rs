//! The controller of a run: a law, continuous in time or with a clock of its own.

use congruent_scenario::ControllerKind;
use congruent_simulation::{Commands, Controller, JointsView, Kinematic, Setpoint};

use super::{computed_torque::ComputedTorque, digital::Hold, servos::Servos};
use crate::setup::{ControllerSetup, RunSetup};

/// The controller that a scenario asks for.
#[derive(Debug, Clone)]
pub struct JointController<'a> {
    law: Law<'a>,
    /// `None` for a controller that is continuous in time.
    hold: Option<Hold>,
}

#[derive(Debug, Clone)]
enum Law<'a> {
    Passive,
    Kinematic,
    Torque(&'a ControllerSetup),
    Servos(Servos<'a>),
    ComputedTorque(Box<ComputedTorque<'a>>),
}

impl<'a> JointController<'a> {
    /// The controller of a run, before its first step.
    pub fn new(setup: &'a RunSetup) -> Self {
        let controller = &setup.controller;
        let servos = || Servos::new(setup);
        let law = match controller.kind {
            ControllerKind::Absent | ControllerKind::Passive => Law::Passive,
            ControllerKind::Kinematic => Law::Kinematic,
            ControllerKind::Torque => Law::Torque(controller),
            ControllerKind::Velocity => Law::Servos(servos().on_velocity()),
            ControllerKind::Pd => Law::Servos(servos()),
            ControllerKind::Pid => Law::Servos(servos().with_integral(setup)),
            ControllerKind::GravityCompensation => Law::Servos(servos().with_gravity(setup)),
            ControllerKind::ComputedTorque => Law::ComputedTorque(Box::new(ComputedTorque::new(setup))),
        };
        let dof = setup.description.robot.dof();
        Self { law, hold: controller.sampling.map(|sampling| Hold::new(sampling, dof)) }
    }
}

impl Controller for JointController<'_> {
    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        match &mut self.hold {
            None => self.law.command(joints, setpoint, commands),
            Some(hold) => {
                #[expect(clippy::cast_precision_loss, reason = "a period is at most 1e5 steps")]
                // Integrals advance once per period, by all of it.
                let period_s = hold.period() as f64 * joints.step_s();
                let law = &mut self.law;
                // Efforts, not motors: between two readings a digital drive exerts a constant torque and knows no
                // state.
                let torques = hold.next(|torques| law.efforts_into(joints, setpoint, period_s, torques));
                commands.torque_mut().copy_from_slice(torques);
            }
        }
    }
}

impl Law<'_> {
    /// The torques of a controller that is continuous in time.
    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        match self {
            Law::Passive => {}
            Law::Kinematic => Kinematic.command(joints, setpoint, commands),
            Law::Servos(servos) => servos.command(joints, setpoint, commands),
            Law::Torque(_) | Law::ComputedTorque(_) => {
                self.efforts_into(joints, setpoint, joints.step_s(), commands.torque_mut());
            }
        }
    }

    /// The efforts at this instant, for a period.
    fn efforts_into(
        &mut self,
        joints: &JointsView<'_>,
        setpoint: &Setpoint<'_>,
        period_s: f64,
        efforts: &mut [f64],
    ) {
        match self {
            Law::Passive | Law::Kinematic => efforts.fill(0.0),
            Law::Servos(servos) => servos.efforts_into(joints, setpoint, period_s, efforts),
            Law::ComputedTorque(law) => law.efforts_into(joints, setpoint, efforts),
            Law::Torque(ControllerSetup { torque, torque_table, .. }) => {
                efforts.copy_from_slice(torque);
                if let Some(table) = torque_table {
                    table.add_at(joints.time_s(), efforts);
                }
            }
        }
    }
}
