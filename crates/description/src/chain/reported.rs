//! The chain that a command used, as reports print it.

use std::fmt;

use congruent_input::display::counted;
use schemars::JsonSchema;
use serde::Serialize;

/// Who determined an end of the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChainEnd {
    /// The robot file names the link.
    Declared,
    /// The command or the program names the link.
    Given,
    /// Nobody names it. As base the root link was taken, as tip the frame for tools at the end of the longest
    /// chain of moving joints, before a gripper.
    #[default]
    Chosen,
}

/// Who determined base and tip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ChainEnds {
    /// Who determined the base link.
    pub base: ChainEnd,
    /// Who determined the tip link.
    pub tip: ChainEnd,
}

/// The chain that a command used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ReportedChain {
    /// The link that the chain starts from.
    pub base: String,
    /// Who determined the base.
    pub base_is: ChainEnd,
    /// The link that it ends at.
    pub tip: String,
    /// Who determined the tip.
    pub tip_is: ChainEnd,
    /// The moving joints between them, mimic joints included.
    pub joints: Vec<String>,
    /// Values of the robot that were set in place of those of its files, `KEY=VALUE`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set_values: Vec<String>,
}

impl fmt::Display for ReportedChain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let why = |end: ChainEnd, chosen: &'static str| match end {
            ChainEnd::Declared => "declared",
            ChainEnd::Given => "given",
            ChainEnd::Chosen => chosen,
        };
        write!(
            f,
            "chain from {} ({}) to {} ({}), {}",
            self.base,
            why(self.base_is, "chosen: the root link"),
            self.tip,
            why(self.tip_is, "chosen: the end of the arm"),
            counted(self.joints.len(), "moving joint")
        )?;
        if self.set_values.is_empty() { Ok(()) } else { write!(f, "; --set {}", self.set_values.join(", ")) }
    }
}
