//! One fault in words: the line of the file, the found and the expected value, what to change.

use std::{
    f64::consts::{PI, TAU},
    ops::Range,
    sync::Arc,
};

use congruent_description::{ConstantKey, ConstantPart, DhConvention, DhRowKind, RobotFilePlaces, RowKey};
use congruent_input::{
    ChangedLines, PastedLines, Slack, SourceFile, TypingError, WrongUnit,
    display::{angle, length, length_and_angle, number},
    fitted_number, fitted_transform, line_column, unit_hint,
    units::{Unit, UnitSystem},
};
use congruent_kinematics::{Pose, rotation_log};

use super::{content::Fault, names::ModelNames, values::ReportedValue};
use crate::diagnosis::{CandidateModel, Cause, DhEntry, ExplainedFault, FaultPlace, ModelPair, RowConstants};

/// A fault for programs, its message for people, and its place.
pub(super) struct FaultMessage {
    pub(super) fault: Fault,
    pub(super) message: String,
    pub(super) location: Option<FileLocation>,
}

impl FaultMessage {
    /// Replaces the suggestion in words by whole lines of a file.
    pub(super) fn advise(&mut self, changes: Vec<ChangedLines>, source: &SourceFile) {
        let (mut lines, mut pasted) = (Vec::new(), Vec::new());
        // A fault that is quoted from the URDF may be corrected in the robot file.
        let is_elsewhere = self.location.as_ref().is_none_or(|location| location.source.path != source.path);
        let file = if is_elsewhere { format!(" of {}", source.path.display()) } else { String::new() };
        for change in &changes {
            let (new, place) = new_lines(change, &source.text);
            lines.push(new);
            pasted.push(PastedLines { text: new.to_owned(), place: format!("{place}{file}") });
        }
        self.fault.suggestion = if lines.is_empty() {
            "nothing more: the lines to write for another cause correct this as well".to_owned()
        } else {
            lines.join("\n")
        };
        self.fault.pasted = pasted;
        self.fault.changes = changes;
    }
}

/// The new lines and where they belong; of a line that stays and gets others below it, these alone.
fn new_lines<'a>(change: &'a ChangedLines, text: &str) -> (&'a str, String) {
    let ChangedLines { from_line, to_line, text: new } = change;
    let old: Vec<&str> = text.lines().skip(from_line - 1).take(to_line + 1 - from_line).collect();
    match new.strip_prefix(&old.join("\n")).and_then(|rest| rest.strip_prefix('\n')) {
        Some(added) => (added, format!("below line {to_line}")),
        None if from_line == to_line => (new, format!("line {from_line}")),
        None => (new, format!("lines {from_line} to {to_line}")),
    }
}

/// A place in a file.
pub(super) struct FileLocation {
    pub(super) source: Arc<SourceFile>,
    pub(super) span: Range<usize>,
}

/// A fault, and both models before and after its correction, with their names.
pub(super) struct FaultContext<'a> {
    pub(super) fault: &'a ExplainedFault,
    pub(super) before: &'a ModelPair,
    pub(super) after: &'a ModelPair,
    pub(super) slack: Slack,
    pub(super) names: &'a ModelNames<'a>,
}

/// The message of one fault.
pub(super) fn describe_fault(context: &FaultContext<'_>) -> FaultMessage {
    let fault = context.fault;
    let mut described = match &fault.place {
        FaultPlace::Model => context.model(),
        FaultPlace::Rows(rows) => context.rows(rows),
        FaultPlace::Entries(entry, rows) => context.entries(*entry, rows),
        FaultPlace::RowEntries(entries, row) if fault.cause == Cause::ParametersExchanged => {
            context.row_exchanged(*row, entries)
        }
        FaultPlace::RowEntries(entries, row) => context.row_signs(*row, entries),
        FaultPlace::Column(entries) => match fault.cause {
            Cause::ParametersExchanged => context.columns_exchanged(entries),
            Cause::Parameter => context.column_signs(entries),
            _ => context.columns(entries),
        },
        FaultPlace::ShiftedColumn(entries, shift) => context.shifted(entries, *shift),
        FaultPlace::Base => context.declared_transform(ConstantKey::BaseFromDh0),
        FaultPlace::Tool => context.declared_transform(ConstantKey::DhnFromTip),
        FaultPlace::ReferenceJoints(joints) => context.reference_joints(joints),
    };
    described.fault.cause = fault.cause;
    described.fault.message.clone_from(&described.message);
    if let Some(FileLocation { source, span }) = &described.location {
        described.fault.file = Some(source.path.display().to_string());
        described.fault.line = Some(line_column(&source.text, span.start).0);
    }
    described
}

impl FaultContext<'_> {
    fn model(&self) -> FaultMessage {
        if self.fault.cause != Cause::ConventionSwapped {
            return self.columns(&[DhEntry::A, DhEntry::D]);
        }
        let span = self.names.places.and_then(RobotFilePlaces::convention);
        let word = |candidate: &CandidateModel| match candidate.convention {
            Some(DhConvention::Modified) => "modified",
            _ => "standard",
        };
        let (found, expected) = (word(&self.before.candidate), word(&self.after.candidate));
        let fault = Fault {
            found: Some(ReportedValue::Text(found.to_owned())),
            expected: Some(ReportedValue::Text(expected.to_owned())),
            suggestion: format!("convention = \"{expected}\""),
            ..Fault::default()
        };
        let message =
            format!("the values are those of the {expected} DH convention, but convention = \"{found}\"");
        FaultMessage { fault, message, location: self.in_robot_file(span) }
    }

    fn rows(&self, rows: &[usize]) -> FaultMessage {
        match self.fault.cause {
            Cause::Parameter => return self.kind(rows[0]),
            Cause::ParametersExchanged => return self.row_exchanged(rows[0], &[DhEntry::A, DhEntry::D]),
            _ => {}
        }
        let names: Vec<String> = rows.iter().map(|&row| self.joint(row)).collect();
        let listed = names.join("\", \"");
        let joint = if let [name] = &names[..] { Some(name.clone()) } else { None };
        let rate = |models: &ModelPair| models.candidate.rows[rows[0]].rate;
        let (found, expected) = (rate(self.before), rate(self.after));
        let ratio = |fault: Fault| Fault {
            value: Some(found / expected),
            found: Some(ReportedValue::Number(found)),
            expected: Some(ReportedValue::Number(expected)),
            ..fault
        };
        let named =
            Fault { joints: if joint.is_some() { Vec::new() } else { names }, joint, ..Fault::default() };
        let (fault, message, suggestion) = match self.fault.cause {
            Cause::AxisFlipped => (
                ratio(named),
                format!(
                    "joint \"{listed}\" moves in the opposite direction: sign is {}, expected {}",
                    fitted_number(found),
                    fitted_number(expected)
                ),
                format!("sign = {}", fitted_number(expected)),
            ),
            Cause::Ratio => (
                ratio(named),
                format!("joint \"{listed}\" moves {} times as far as expected", times(found / expected)),
                "check the joint's gear ratio and unit".to_owned(),
            ),
            Cause::JointsSwapped => {
                let (what, how) =
                    if self.values_moved(rows) { ("rows", "rows") } else { ("names", "joint names") };
                (
                    named,
                    format!("the {what} of joints \"{listed}\" are exchanged"),
                    format!("exchange the two {how}"),
                )
            }
            _ => (
                ratio(named),
                format!(
                    "the position of joint \"{listed}\" is in the wrong unit: {}",
                    self.unit_misreading()
                ),
                "give joint positions in rad".to_owned(),
            ),
        };
        let key = if self.fault.cause == Cause::AxisFlipped { RowKey::Sign } else { RowKey::Joint };
        FaultMessage { fault: Fault { suggestion, ..fault }, message, location: self.location(rows[0], key) }
    }

    /// How joint positions are misread if their unit is wrong.
    fn unit_misreading(&self) -> &'static str {
        match self.fault.cause {
            Cause::DegreesAsRadians => "degrees are read as radians",
            _ => "radians are read as degrees",
        }
    }

    fn kind(&self, row: usize) -> FaultMessage {
        let kind = |models: &ModelPair| match models.candidate.rows[row].link {
            RowConstants::Dh { kind: DhRowKind::Prismatic, .. } => "prismatic",
            _ => "revolute",
        };
        let (found, expected, joint) = (kind(self.before), kind(self.after), self.joint(row));
        let message =
            format!("the row of joint \"{joint}\" has kind = \"{found}\", but the joint is {expected}");
        let fault = Fault {
            joint: Some(joint),
            parameter: Some("kind".to_owned()),
            found: Some(ReportedValue::Text(found.to_owned())),
            expected: Some(ReportedValue::Text(expected.to_owned())),
            suggestion: format!("kind = \"{expected}\""),
            ..Fault::default()
        };
        FaultMessage { fault, message, location: self.location(row, RowKey::Kind) }
    }

    fn entries(&self, entry: DhEntry, rows: &[usize]) -> FaultMessage {
        let row = rows[0];
        let value = |models: &ModelPair, row: usize| models.candidate.entry(row, entry).unwrap_or_default();
        let (found, expected) = (value(self.before, row), value(self.after, row));
        let parameter = Some(entry.to_string());
        if let &[first, second] = rows {
            return self.values_exchanged(entry, [first, second]);
        }
        let joint = self.joint(row);
        let right = self.corrected(row, entry, found, expected);
        let given = if self.is_written(row, row_key(entry)) {
            self.given(row, entry, found)
        } else {
            format!("{entry} is not written (default 0)")
        };
        let expected = within_a_turn(entry, expected);
        let how = typing_error(&given, &right).map(|how| format!(" ({how})")).unwrap_or_default();
        let message = format!("joint \"{joint}\": {given}, expected {right}{how}");
        let fault = Fault {
            joint: Some(joint),
            parameter,
            value: Some(off(entry, found, expected)),
            found: Some(ReportedValue::Number(found)),
            expected: Some(ReportedValue::Number(expected)),
            suggestion: right,
            ..Fault::default()
        };
        FaultMessage { fault, message, location: self.location(row, row_key(entry)) }
    }

    fn declared_transform(&self, key: ConstantKey) -> FaultMessage {
        let pose: fn(&ModelPair) -> Pose = match key {
            ConstantKey::BaseFromDh0 => |models| models.candidate.base.pose,
            ConstantKey::DhnFromTip => |models| models.candidate.tool.pose,
        };
        let name = key.name();
        let (found, expected) = (pose(self.before), pose(self.after));
        let shift = found.translation - expected.translation;
        let turn = rotation_log(&(expected.rotation.transpose() * found.rotation));
        let how = match self.fault.cause {
            Cause::RpyOrder => "has its roll, pitch and yaw in the wrong order".to_owned(),
            Cause::Tool | Cause::Base => format!("is off by {}", off_by(shift.norm(), turn.norm())),
            _ => {
                let is_angle = self.fault.cause != Cause::MillimetresAsMetres;
                let is_too_large = match self.fault.cause {
                    Cause::DegreesAsRadians => true,
                    Cause::RadiansAsDegrees => false,
                    _ => found.translation.norm() > expected.translation.norm(),
                };
                let (what, unit) = if is_angle { ("angles", Unit::Angle) } else { ("lengths", Unit::Length) };
                let units = self.names.places.map(|places| places.constant_units(key, unit));
                format!("has {what} {}", WrongUnit { is_angle, is_too_large }.under(units, "its key says"))
            }
        };
        let places = self.names.places;
        let [found, expected] = [found, expected].map(|pose| pose.to_isometry());
        let suggestion = format!("{name} = {}", fitted_transform(&expected, self.slack));
        let fault = Fault {
            found: Some(ReportedValue::Text(fitted_transform(&found, Slack::default()))),
            expected: Some(ReportedValue::Text(fitted_transform(&expected, self.slack))),
            translation_m: Some(shift.into()),
            rotation_rad: Some(turn.into()),
            suggestion,
            ..Fault::default()
        };
        // The label of the snippet is at the part that is more wrong, metres against radians: near enough for an
        // arm of 1 m.
        let part =
            if shift.norm() > turn.norm() { ConstantPart::Translation } else { ConstantPart::Rotation };
        let span = places.map(|places| places.constant(key, part));
        let message = if places.is_none_or(|places| places.has_constant(key)) {
            format!("the declared transform {name} {how}")
        } else {
            let ends = match key {
                ConstantKey::BaseFromDh0 => "the base and the first frame of the table",
                ConstantKey::DhnFromTip => "the last frame of the table and the tip",
            };
            format!("{name} is missing: {ends} are {} apart", off_by(shift.norm(), turn.norm()))
        };
        FaultMessage { fault, message, location: self.in_robot_file(span) }
    }

    pub(super) fn joint(&self, row: usize) -> String {
        self.names.moving_joint(self.before.candidate.rows[row].joint)
    }

    fn in_robot_file(&self, span: Option<Range<usize>>) -> Option<FileLocation> {
        Some(FileLocation { source: Arc::clone(self.names.places?.source()), span: span? })
    }

    /// Whether the file writes a value of a row; true if there is no file.
    pub(super) fn is_written(&self, row: usize, key: RowKey) -> bool {
        let place = self.names.places.and_then(|places| places.value(row, key));
        place.is_none_or(|place| place.is_written)
    }

    /// The place of a value of a row in the robot file.
    pub(super) fn location(&self, row: usize, key: RowKey) -> Option<FileLocation> {
        self.in_robot_file(Some(self.names.places?.value(row, key)?.span))
    }

    /// Whether the values of the rows are exchanged as well as the names.
    fn values_moved(&self, rows: &[usize]) -> bool {
        self.before.candidate.rows[rows[0]].link != self.after.candidate.rows[rows[0]].link
    }

    /// A value of a row as the file writes it, with its key and in the unit of that key.
    pub(super) fn written(&self, row: usize, entry: DhEntry, value: f64) -> String {
        self.corrected(row, entry, f64::INFINITY, value)
    }

    /// The expected value of a row, with enough digits to differ from the found one.
    fn corrected(&self, row: usize, entry: DhEntry, found: f64, expected: f64) -> String {
        let place = self.names.places.and_then(|places| places.value(row, row_key(entry)));
        let unit = if entry.is_angle() { Unit::Angle } else { Unit::Length };
        let (key, units) =
            place.map_or_else(|| (entry.to_string(), UnitSystem::Si), |place| (place.key, place.units));
        format!("{key} = {}", unit.corrected(found, expected, units, self.slack))
    }

    /// The given value of a row, in the digits of the file.
    pub(super) fn given(&self, row: usize, entry: DhEntry, value: f64) -> String {
        let place = self.names.places.and_then(|places| Some((places, places.value(row, row_key(entry))?)));
        match place {
            Some((places, place)) if place.is_written => {
                format!("{} = {}", place.key, &places.source().text[place.span])
            }
            _ => self.written(row, entry, value),
        }
    }
}

/// An angle in `-pi < angle <= pi`; a length as it is.
fn within_a_turn(entry: DhEntry, value: f64) -> f64 {
    if !entry.is_angle() || (value > -PI && value <= PI) {
        return value;
    }
    value - TAU * ((value - PI) / TAU).ceil()
}

/// A ratio, with its distance from 1 if the digits for people do not show one.
fn times(ratio: f64) -> String {
    let formatted = number(ratio);
    let sign = if ratio < 1.0 { '-' } else { '+' };
    if formatted == "1" { format!("1 {sign} {}", number((ratio - 1.0).abs())) } else { formatted }
}

/// The error of a transform; a part that is rounding is left out if the other is not.
pub(super) fn off_by(shift_m: f64, turn_rad: f64) -> String {
    /// Rounding of a fit. Unit: m or rad.
    const ROUNDING: f64 = 1e-12;
    if shift_m.max(turn_rad) <= ROUNDING {
        return length_and_angle(shift_m, turn_rad);
    }
    let shift = (shift_m > ROUNDING).then(|| length(shift_m));
    let turn = (turn_rad > ROUNDING).then(|| angle(turn_rad));
    shift.into_iter().chain(turn).collect::<Vec<_>>().join(" and ")
}

/// Found minus expected; of angles within half a turn.
fn off(entry: DhEntry, found: f64, expected: f64) -> f64 {
    let off = found - expected;
    if entry.is_angle() { libm::atan2(libm::sin(off), libm::cos(off)) } else { off }
}

pub(super) fn row_key(entry: DhEntry) -> RowKey {
    match entry {
        DhEntry::A => RowKey::A,
        DhEntry::Alpha => RowKey::Alpha,
        DhEntry::D => RowKey::D,
        DhEntry::Theta => RowKey::Theta,
    }
}

/// What a typed value has otherwise than the expected one, both as `key = value`; `None` if they differ in more, or if the
/// keys have other units.
fn typing_error(found: &str, expected: &str) -> Option<String> {
    if let Some(hint) = unit_hint(found, expected) {
        return Some(hint);
    }
    let ((key, found), (other_key, expected)) = (found.split_once(" = ")?, expected.split_once(" = ")?);
    let error = TypingError::between(found, expected).filter(|_| key == other_key)?;
    error.in_words().map(str::to_owned)
}
