//! The table of actuators: the largest effort of each joint beside its limit.

use congruent_input::display::{number, quantity};
use congruent_results::report::RunReport;
use congruent_twin::source::ActuatorUse;
use maud::{Markup, html};

use crate::parts::{Pointer, value};

/// The table; nothing if the robot has no actuators.
pub(super) fn actuators(report: &RunReport) -> Markup {
    html! {
        @if !report.actuators.is_empty() {
            section {
                h2 { "Actuators" }
                table {
                    thead { tr {
                        th { "joint" } th { "largest effort" } th { "limit" } th { "time at the effort limit" } th { "time at the velocity limit" }
                    } }
                    tbody {
                        @for (index, of) in report.actuators.iter().enumerate() {
                            (row(of, &Pointer::root().key("actuators").key(index)))
                        }
                    }
                }
            }
        }
    }
}

fn row(of: &ActuatorUse, at: &Pointer) -> Markup {
    let share = |key: &str, share: f64| value(&at.key(key), share, &format!("{} %", number(100.0 * share)));
    html! {
        tr {
            th scope="row" { (of.joint) }
            td data-label="largest effort" {
                (value(&at.key("largest_effort"), of.largest_effort, &quantity(of.largest_effort, of.unit.symbol())))
            }
            td data-label="limit" {
                @match of.effort_limit {
                    Some(limit) => (value(&at.key("effort_limit"), limit, &quantity(limit, of.unit.symbol()))),
                    None => "none",
                }
            }
            td data-label="at the effort limit" { (share("at_effort_limit", of.at_effort_limit)) }
            td data-label="at the velocity limit" { (share("at_velocity_limit", of.at_velocity_limit)) }
        }
    }
}
