//! Controller, resistances, sensors and payloads of a scenario; all are checked, so that one call reports every error.

use congruent_description::RobotDescription;
use congruent_dynamics::JointResistance;
use congruent_input::Findings;
use congruent_monitors::RunPayload;
use congruent_scenario::{FilePlace, Scenario, ScenarioFolder};

use super::{
    controller::ControllerSetup, payloads::payloads, resistances::resistances, sensors::SensorSetup,
};

/// Controller, resistances, sensors and payloads of the joints of a run.
pub(in crate::setup) struct Actuation {
    pub(in crate::setup) controller: ControllerSetup,
    pub(in crate::setup) resistances: Vec<JointResistance>,
    pub(in crate::setup) sensors: SensorSetup,
    pub(in crate::setup) payloads: Vec<RunPayload>,
}

impl Actuation {
    /// # Errors
    /// Every fault of every section.
    pub(in crate::setup) fn new(
        scenario: &Scenario,
        place: FilePlace<'_>,
        folder: ScenarioFolder<'_>,
        description: &RobotDescription,
    ) -> Result<Self, Findings> {
        let (robot, step_s) = (&description.robot, scenario.simulation.step_s);
        let controller =
            ControllerSetup::new(&scenario.controller, place.key("controller"), folder, robot, step_s);
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
