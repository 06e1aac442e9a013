//! What is asked of a controller, and where it is.

/// The port of RTDE.
pub const RTDE_PORT: u16 = 30_004;
/// Joints of a robot of Universal Robots.
pub const RTDE_JOINTS: usize = 6;

/// What is asked of a controller.
#[derive(Debug, Clone)]
pub struct RtdeOptions {
    /// Name or address of the controller, with or without a port.
    pub address: String,
    /// Rate of the data packages, Hz.
    pub rate_hz: f64,
    /// Names of the joints, from the base on.
    pub joints: [String; RTDE_JOINTS],
}

impl RtdeOptions {
    /// The address with its port.
    pub fn with_port(&self) -> String {
        let has_port = self.address.rsplit_once(':').is_some_and(|(_, port)| port.parse::<u16>().is_ok());
        if has_port { self.address.clone() } else { format!("{}:{RTDE_PORT}", self.address) }
    }
}
