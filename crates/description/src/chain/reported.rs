//! Which chain a command used, as its report says it.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use crate::display::counted;

/// Why an end of the chain is where it is.
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

/// Why base and tip are where they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ChainEnds {
    /// The base.
    pub base: ChainEnd,
    /// The tip.
    pub tip: ChainEnd,
}

/// The chain that a command used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ReportedChain {
    /// The link that the chain starts from.
    pub base: String,
    /// Why this one.
    pub base_is: ChainEnd,
    /// The link that it ends at.
    pub tip: String,
    /// Why this one.
    pub tip_is: ChainEnd,
    /// The moving joints between them, mimic joints included.
    pub joints: Vec<String>,
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
        )
    }
}
