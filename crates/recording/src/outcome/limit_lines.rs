//! Lines at the limits in the plots, from the start to the end of the run.

use congruent_input::Quantity;
use congruent_monitors::{
    RecordingError,
    verdict::{CheckResult, Measure},
};
use congruent_results::report::RunReport;
use congruent_scenario::CheckKind;
use re_log_types::EntityPath;
use re_sdk_types::{archetypes::SeriesLines, components::Color};

use crate::{
    rrd::{
        paths,
        times::{SampleTime, SampleTimes},
        writer::RrdWriter,
    },
    scene::{palette, styles::line},
    series::{
        checks::path_parts,
        scalars::{log10, write_scalars},
    },
};

/// Width of a line at a limit on the screen.
const WIDTH_UI_POINTS: f32 = 1.5;

/// The style of a line at a limit.
pub(super) fn style(name: &str, color: Color) -> SeriesLines {
    line(name, color, WIDTH_UI_POINTS)
}

/// The times at which every line begins and ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LimitLines {
    ends: [SampleTime; 2],
}

/// A limit of a check of this number, and the name of its line.
struct NamedLimit<'a> {
    number: usize,
    check: &'a CheckResult,
    measure: &'a Measure,
    name: &'a str,
}

impl LimitLines {
    /// For a run that ends at this time.
    pub(crate) fn until(end: SampleTime) -> Self {
        Self { ends: [SampleTime::new(0.0, 0), end] }
    }

    /// Writes a line with its value.
    pub(crate) fn write(
        &self,
        writer: &mut RrdWriter,
        path: &EntityPath,
        style: &SeriesLines,
        value: f64,
    ) -> Result<(), RecordingError> {
        writer.log_static(path, style)?;
        let mut times = SampleTimes::default();
        self.ends.into_iter().for_each(|time| times.push(time));
        write_scalars(writer, path, &times.columns(), [value; 2].into_iter())
    }

    /// Writes the limits of all checks with a plot: of agreement and distances always, of others if they are violated.
    pub(crate) fn write_checks(
        &self,
        writer: &mut RrdWriter,
        report: &RunReport,
    ) -> Result<(), RecordingError> {
        let mut written = Vec::new();
        for (number, check) in report.checks.iter().enumerate() {
            for (at, measure) in check.measures.iter().enumerate() {
                // Further pairs of a check have the same limit.
                let is_same = |before: &Measure| before.quantity == measure.quantity;
                if check.measures[..at].iter().any(is_same) {
                    continue;
                }
                if let Some(name) = new_name(&mut written, check.check, measure) {
                    self.write_limit(writer, &NamedLimit { number, check, measure, name: &name })?;
                }
            }
        }
        Ok(())
    }

    fn write_limit(&self, writer: &mut RrdWriter, of: &NamedLimit<'_>) -> Result<(), RecordingError> {
        let NamedLimit { number, check, measure, name } = *of;
        let Measure { quantity, unit, limit, .. } = *measure;
        let [position, orientation] = palette::TOLERANCES;
        let (path, color) = match (check.check, quantity) {
            (CheckKind::Agreement, Quantity::Position) => (paths::position_error(name), position),
            (CheckKind::Agreement, Quantity::Orientation) => (paths::orientation_error(name), orientation),
            (CheckKind::Clearance, _) => (paths::clearance(name), palette::LIMIT),
            (CheckKind::Zone, _) => (paths::zone_limit(name), palette::LIMIT),
            _ if measure.first_violation.is_none() => return Ok(()),
            _ => {
                let [check, quantity] = path_parts(number, check.check, quantity, unit);
                (paths::check_limit(&check, &quantity), palette::LIMIT)
            }
        };
        self.write(writer, &path, &style(name, color), limit)?;
        if check.check == CheckKind::Agreement {
            let name = format!("{quantity} {name}");
            self.write(writer, &paths::worst_of_links(&name), &style(&name, color), log10(limit))?;
        }
        Ok(())
    }
}

/// The name of the line of a limit: `limit`, or `limit_2` if an earlier check of the kind has another limit. `None` if an
/// earlier one has the same.
fn new_name(
    written: &mut Vec<(CheckKind, Quantity, f64)>,
    check: CheckKind,
    measure: &Measure,
) -> Option<String> {
    let word = if check == CheckKind::Agreement { "tolerance" } else { "limit" };
    // The lines of other kinds are below the number of their check.
    if !matches!(check, CheckKind::Agreement | CheckKind::Clearance | CheckKind::Zone) {
        return Some(word.to_owned());
    }
    let this = (check, measure.quantity, measure.limit);
    if written.contains(&this) {
        return None;
    }
    let earlier =
        written.iter().filter(|(kind, quantity, _)| (*kind, *quantity) == (check, measure.quantity));
    let name = match earlier.count() {
        0 => word.to_owned(),
        earlier => format!("{word}_{}", earlier + 1),
    };
    written.push(this);
    Some(name)
}
