//! What is known beside a log, and how one becomes a log that is read.

/// What is known beside the log.
#[derive(Debug, Clone, Default)]
pub struct LogOptions {
    /// Rate of the rows of a table without times, Hz.
    pub rate_hz: Option<f64>,
    /// The index of the episode of a dataset that is read alone; all by default.
    pub episode: Option<u64>,
    /// Names of the joints of the robot, by which columns of a table are recognised; empty without a robot.
    pub joints: Vec<String>,
}

/// How a bag in SQL, or one whose messages are compressed one by one, becomes an MCAP that is read.
pub(crate) const CONVERT: &str = "write to out.yaml, and convert with `ros2 bag convert -i BAG -o out.yaml`:\n\
     output_bags:\n- uri: converted\n  storage_id: mcap\n  all_topics: true\n  all_services: true";
