//! Controller, resistances, sensors and payloads of a scenario, each checked, so that one call names all faults.

use congruent_description::{Diagnostic, RobotDescription};
use congruent_dynamics::JointResistance;

use super::{
    controller::ControllerSetup, payloads::payloads, resistances::resistances, sensors::SensorSetup,
};
use crate::{
    scenario::{FilePlace, Scenario, ScenarioFolder},
    setup::payload::Payload,
};

/// What moves the joints of a run, what resists them, and how their state is known.
pub(in crate::setup) struct Actuation {
    pub(in crate::setup) controller: ControllerSetup,
    pub(in crate::setup) resistances: Vec<JointResistance>,
    pub(in crate::setup) sensors: SensorSetup,
    pub(in crate::setup) payloads: Vec<Payload>,
}

impl Actuation {
    /// # Errors
    /// Every fault of every section.
    pub(in crate::setup) fn new(
        scenario: &Scenario,
        (place, folder): (FilePlace<'_>, ScenarioFolder<'_>),
        description: &RobotDescription,
    ) -> Result<Self, Vec<Diagnostic>> {
        let (robot, step_s) = (&description.robot, scenario.simulation.step_s);
        let written = (place.key("controller"), folder);
        let controller = ControllerSetup::new(&scenario.controller, written, robot, step_s);
        let resistances = resistances(&scenario.joints, place.key("joints"), robot);
        let sensors = SensorSetup::new(&scenario.sensors, place.key("sensors"), robot);
        let payloads = payloads(&scenario.payload, place.key("payload"), description);
        match (controller, resistances, sensors, payloads) {
            (Ok(controller), Ok(resistances), Ok(sensors), Ok(payloads)) => {
                Ok(Self { controller, resistances, sensors, payloads })
            }
            (controller, resistances, sensors, payloads) => {
                let errors = [controller.err(), resistances.err(), sensors.err(), payloads.err()];
                Err(errors.into_iter().flatten().flatten().collect())
            }
        }
    }
}
