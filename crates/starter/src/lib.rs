//! Files to start from: a robot file for a URDF, a scenario for a robot. Each is tried before anyone relies on it.

pub mod codes;
mod joint_move;
mod robot_file;
mod scenario;
mod scenario_text;
mod settings;
mod touching;
mod trial;
mod written;

pub use robot_file::{NewRobot, RobotFileDraft, robot_file};
pub use scenario::{NewScenario, ScenarioDraft, scenario};
pub use trial::try_scenario;
