//! What to write into the robot file: every value in which the corrected table differs from the given one, as
//! whole lines, by the shortest text that the tolerance allows.

use congruent_description::{ConstantKey, DhRowKind, RobotFilePlaces, RowKey};
use congruent_input::{ChangedLines, Slack, TextEdit, units::Unit};

use super::fault_message::row_key;
use crate::diagnosis::{
    CandidateModel, Cause, Criterion, DhEntry, ExplainedFault, Explanation, FaultPlace, ModelPair,
    RowConstants, with_dropped_joints,
};

/// Most that a written value may be off if the fit is exact. Unit: m or rad; kind: choice, a digit below
/// what data sheets and calibrations give.
const MOST_SLACK: f64 = 1e-7;

/// Digits below this part of the residual say nothing. Kind: choice.
const PART_OF_RESIDUAL: f64 = 0.3;

/// A fitted ratio of 1. No unit; kind: rounding of a fit.
const SAME_RATIO: f64 = 1e-9;

/// Part of the margin between residual and tolerance that rounding the written values may use. Kind: choice.
const PART_OF_MARGIN: f64 = 0.5;

/// How far the written values of a corrected model may be from the fitted ones: so little that all of them
/// together stay within the tolerance.
pub(super) fn slack(models: &ModelPair, explanation: &Explanation, criterion: &Criterion) -> Slack {
    let count = changed(&models.candidate, &explanation.corrected.candidate).len().max(1);
    let reach = criterion.configurations.iter().map(|q| models.reference.base_from_tip(q).translation.norm());
    let reach_m = reach.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let (residual, tolerance) = (explanation.residual, criterion.tolerance);
    #[expect(clippy::cast_precision_loss, reason = "tables have few entries")]
    let values = count as f64;
    // A value in another unit is not fitted: it keeps its digits, however far it is from explaining the difference.
    let noise =
        if explanation.faults.iter().all(|fault| fault.cause.is_unit()) { 0.0 } else { PART_OF_RESIDUAL };
    // Digits below the residual are noise of the fit, or of the places that the file is typed with; with an exact fit they
    // end where data sheets end.
    let half_place = explanation.digits.coarsest_half_place(DhEntry::A);
    let half_place = if half_place > 0.0 { half_place } else { f64::INFINITY };
    let least = (noise * residual.position_m).min(PART_OF_RESIDUAL * half_place).max(MOST_SLACK);
    // An angle at the base moves the tip by the angle times the reach, so it needs as many more digits.
    let angle_rad = (least / reach_m).max(noise * residual.orientation_rad);
    // Nothing to stay within: the model is not accepted with all digits either, or by the digits of its files.
    if !residual.is_within(&tolerance) {
        return Slack { length_m: least, angle_rad };
    }
    // All written values may round to the same side; each gets an equal share of the margin.
    let share = |residual: f64, tolerance: f64| PART_OF_MARGIN * (tolerance - residual) / values;
    let length_m = least.min(share(residual.position_m, tolerance.position_m));
    let by_length = share(residual.position_m, tolerance.position_m) / reach_m;
    let angle_rad = angle_rad.min(by_length).min(share(residual.orientation_rad, tolerance.orientation_rad));
    Slack { length_m, angle_rad }
}

/// A value of the robot file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileValue {
    Convention,
    Row(usize, RowKey),
    Constant(ConstantKey),
}

/// The values in which two tables differ.
fn changed(before: &CandidateModel, after: &CandidateModel) -> Vec<FileValue> {
    let mut list = Vec::new();
    list.extend((before.convention != after.convention).then_some(FileValue::Convention));
    let constants = [
        (&before.base, &after.base, ConstantKey::BaseFromDh0),
        (&before.tool, &after.tool, ConstantKey::DhnFromTip),
    ];
    let moved = constants.into_iter().filter(|(before, after, _)| before.pose != after.pose);
    list.extend(moved.map(|(.., key)| FileValue::Constant(key)));
    for (row, (one, two)) in before.rows.iter().zip(&after.rows).enumerate() {
        let kind = |link| matches!(link, RowConstants::Dh { kind: DhRowKind::Prismatic, .. });
        let keys = [
            (one.joint != two.joint, RowKey::Joint),
            (kind(one.link) != kind(two.link), RowKey::Kind),
            // Other ratios cannot be written.
            (one.rate * two.rate < 0.0 && (two.rate.abs() - 1.0).abs() < SAME_RATIO, RowKey::Sign),
        ];
        let differs = |entry: &DhEntry| before.entry(row, *entry) != after.entry(row, *entry);
        let entries = DhEntry::ALL.into_iter().filter(differs).map(row_key);
        let keys = keys.into_iter().filter_map(|(is_changed, key)| is_changed.then_some(key));
        list.extend(keys.chain(entries).map(|key| FileValue::Row(row, key)));
    }
    list
}

impl FileValue {
    /// Whether correcting a fault changes this value.
    fn is_changed_by(self, fault: &ExplainedFault) -> bool {
        match (self, &fault.place) {
            (_, FaultPlace::Model) => (fault.cause == Cause::ConventionSwapped) == (self == Self::Convention),
            (Self::Constant(ConstantKey::BaseFromDh0), FaultPlace::Base)
            | (Self::Constant(ConstantKey::DhnFromTip), FaultPlace::Tool) => true,
            (Self::Row(row, key), FaultPlace::Rows(rows)) => {
                rows.contains(&row)
                    && match fault.cause {
                        Cause::JointsSwapped => true,
                        Cause::ParametersExchanged => matches!(key, RowKey::A | RowKey::D),
                        Cause::Parameter => key == RowKey::Kind,
                        _ => key == RowKey::Sign,
                    }
            }
            (Self::Row(row, key), FaultPlace::Entries(entry, rows)) => {
                rows.contains(&row) && row_key(*entry) == key
            }
            (Self::Row(row, key), FaultPlace::RowEntries(entries, at)) => {
                row == *at && entries.iter().any(|&entry| row_key(entry) == key)
            }
            (Self::Row(_, key), FaultPlace::Column(entries) | FaultPlace::ShiftedColumn(entries, _)) => {
                entries.iter().any(|&entry| row_key(entry) == key)
            }
            _ => false,
        }
    }

    /// The value of the corrected table, as a change of the file.
    fn edits(
        self,
        places: &RobotFilePlaces,
        [before, after]: [&CandidateModel; 2],
        slack: Slack,
    ) -> Vec<TextEdit> {
        let (row, key) = match self {
            Self::Convention => {
                let convention = after.convention;
                return convention.and_then(|written| places.set_convention(written)).into_iter().collect();
            }
            Self::Constant(key) => {
                let constant =
                    if key == ConstantKey::BaseFromDh0 { after.base.pose } else { after.tool.pose };
                return places.set_constant(key, &constant.to_isometry(), slack);
            }
            Self::Row(row, key) => (row, key),
        };
        let literal = match key {
            RowKey::Joint => {
                // The name is copied from the row that has it now, quotes included.
                let own = before.rows.iter().position(|each| each.joint == after.rows[row].joint);
                let place = own.and_then(|own| places.value(own, RowKey::Joint));
                place.map(|place| places.source().text[place.span].to_owned())
            }
            RowKey::Sign => Some(if after.rows[row].rate < 0.0 { "-1" } else { "1" }.to_owned()),
            RowKey::Kind => match after.rows[row].link {
                RowConstants::Dh { kind, .. } => Some(format!("\"{}\"", kind.name())),
                RowConstants::Screw { .. } => None,
            },
            RowKey::A | RowKey::Alpha | RowKey::D | RowKey::Theta => {
                let entry = DhEntry::ALL.into_iter().find(|&entry| row_key(entry) == key);
                let value = |of: &CandidateModel| entry.and_then(|entry| of.entry(row, entry));
                let unit =
                    if matches!(key, RowKey::Alpha | RowKey::Theta) { Unit::Angle } else { Unit::Length };
                let place = places.value(row, key);
                value(before)
                    .zip(value(after))
                    .zip(place)
                    .map(|((found, expected), place)| unit.corrected(found, expected, place.units, slack))
            }
        };
        literal.and_then(|literal| places.set_value(row, key, &literal)).into_iter().collect()
    }
}

/// The correction of a robot file.
pub(super) struct FileCorrection {
    /// The lines that each fault of an explanation changes; `None` if the file cannot say its correction. A line that
    /// two faults share is the first one's, with both corrections.
    pub(super) by_fault: Vec<Option<Vec<ChangedLines>>>,
    /// All changes of the text.
    pub(super) edits: Vec<TextEdit>,
}

/// What the robot file would have to say for an explanation to hold.
pub(super) fn file_correction(
    models: &ModelPair,
    explanation: &Explanation,
    places: &RobotFilePlaces,
    slack: Slack,
) -> FileCorrection {
    let explanation = &with_dropped_joints(models, explanation);
    let tables = [&models.candidate, &explanation.corrected.candidate];
    let mut edits: Vec<(usize, TextEdit)> = Vec::new();
    let values = changed(tables[0], tables[1]);
    for &value in &values {
        let is_entry_fault = |fault: &ExplainedFault| matches!(fault.place, FaultPlace::Entries(..));
        let faults = || explanation.faults.iter();
        // A fault of this entry alone comes before one of the whole row.
        let own = faults().position(|fault| is_entry_fault(fault) && value.is_changed_by(fault));
        let Some(fault) = own.or_else(|| faults().position(|fault| value.is_changed_by(fault))) else {
            continue;
        };
        edits.extend(value.edits(places, tables, slack).into_iter().map(|edit| (fault, edit)));
    }
    let text = &places.source().text;
    let all: Vec<TextEdit> = edits
        .iter()
        .map(|(_, edit)| edit.clone())
        .filter(|edit| text[edit.span.clone()] != *edit.text)
        .collect();
    let is_said = |fault| values.iter().any(|value: &FileValue| value.is_changed_by(fault));
    let mut by_fault: Vec<Option<Vec<ChangedLines>>> =
        explanation.faults.iter().map(|fault| is_said(fault).then(Vec::new)).collect();
    for lines in places.changed_lines(&all) {
        let is_in = |edit: &TextEdit| {
            let line = congruent_input::line_column(text, edit.span.start).0;
            (lines.from_line..=lines.to_line).contains(&line)
        };
        let first = edits.iter().filter(|(_, edit)| is_in(edit)).map(|(fault, _)| *fault).min();
        // Two faults in one line would both print it, each without the other's correction.
        if let Some(of_first) = first.and_then(|fault| by_fault[fault].as_mut()) {
            of_first.push(lines);
        }
    }
    FileCorrection { by_fault, edits: all }
}
