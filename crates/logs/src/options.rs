//! What is known beside a log.

/// What is known beside the log.
#[derive(Debug, Clone, Default)]
pub struct LogOptions {
    /// Rate of the rows of a table without times, Hz.
    pub rate_hz: Option<f64>,
    /// Names of the joints of the robot, by which columns of a table are recognised; empty without a robot.
    pub joints: Vec<String>,
}
