//! The tables of actuators: the largest effort of each joint beside its limit, joints of one unit in one table.

use congruent_input::{SiUnit, display::number};
use congruent_results::report::RunReport;
use congruent_twin::source::ActuatorUse;
use maud::{Markup, html};

use crate::parts::{Pointer, value};

/// The tables, one for each unit; nothing if the robot has no actuators.
pub(super) fn actuators(report: &RunReport) -> Markup {
    let mut units: Vec<SiUnit> = Vec::new();
    for of in &report.actuators {
        if !units.contains(&of.unit) {
            units.push(of.unit);
        }
    }
    html! {
        @if !report.actuators.is_empty() {
            section {
                h2 { "Actuators" }
                @for unit in units { (of_unit(report, unit)) }
            }
        }
    }
}

fn of_unit(report: &RunReport, unit: SiUnit) -> Markup {
    html! {
        table {
            thead { tr {
                th { "joint" } th { "largest effort, " (unit) } th { "limit, " (unit) } th { "at the effort limit, % of the time" }
                th { "at the velocity limit, % of the time" }
            } }
            tbody {
                @for (index, of) in report.actuators.iter().enumerate().filter(|(_, of)| of.unit == unit) {
                    (row(of, &Pointer::root().key("actuators").key(index)))
                }
            }
        }
    }
}

fn row(of: &ActuatorUse, at: &Pointer) -> Markup {
    let share = |key: &str, share: f64| value(&at.key(key), share, &number(100.0 * share));
    html! {
        tr {
            th scope="row" { (of.joint) }
            td data-label="largest effort" { (value(&at.key("largest_effort"), of.largest_effort, &number(of.largest_effort))) }
            td data-label="limit" {
                @match of.effort_limit {
                    Some(limit) => (value(&at.key("effort_limit"), limit, &number(limit))),
                    None => "none",
                }
            }
            td data-label="effort limit, %" { (share("at_effort_limit", of.at_effort_limit)) }
            td data-label="velocity limit, %" { (share("at_velocity_limit", of.at_velocity_limit)) }
        }
    }
}
