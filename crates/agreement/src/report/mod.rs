//! What a diagnosis says in names, lines and values of the robot file.

mod blame;
mod figures;
mod ladder;
mod ladder_report;
mod units;

pub use figures::Figure;
pub use ladder::climb;
pub use ladder_report::{Blame, Ladder, ReportedAlternative, ReportedCause, ReportedDifference};
