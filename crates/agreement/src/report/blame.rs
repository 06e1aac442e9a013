//! One fault in words: the line of the file, what stands there, what should.

use std::{ops::Range, sync::Arc};

use congruent_description::{
    ConstantKey, ConstantPart, DhConvention, DhRowKind, RobotFilePlaces, RowKey, SourceFile, fitted_number,
    fitted_transform, line_column,
    units::{Unit, UnitSystem},
};
use congruent_kinematics::{Pose, rotation_log};

use super::{
    figures::{Figure, angle, isometry, length},
    ladder::Names,
    ladder_report::Blame,
};
use crate::diagnosis::{Case, Cause, Entry, Part, Place, Suspect, SuspectLink};

/// A fault, as programs read it and in words.
pub(super) struct Accusation {
    pub(super) blame: Blame,
    pub(super) message: String,
    pub(super) spot: Option<Spot>,
    cause: Cause,
}

/// A place in a file.
pub(super) struct Spot {
    pub(super) source: Arc<SourceFile>,
    pub(super) span: Range<usize>,
}

impl Accusation {
    /// The finding's stable code.
    pub(super) fn code(&self) -> &'static str {
        match self.cause {
            Cause::AxisFlipped => "check::axis_flipped",
            Cause::ConventionSwapped => "check::convention_swapped",
            Cause::JointsSwapped => "check::joints_swapped",
            Cause::DegreesAsRadians => "check::degrees_as_radians",
            Cause::RadiansAsDegrees => "check::radians_as_degrees",
            Cause::MillimetresAsMetres => "check::millimetres_as_metres",
            Cause::ParametersExchanged => "check::parameters_exchanged",
            Cause::RpyOrder => "check::rpy_order",
            Cause::FixedJointDropped => "check::fixed_joint_dropped",
            Cause::ZeroOffset => "check::zero_offset",
            Cause::Tool => "check::tool",
            Cause::Base => "check::base",
            Cause::Parameter => "check::parameter",
            Cause::Ratio => "check::ratio",
            Cause::Several => "check::several",
            Cause::Unexplained => "check::unexplained",
        }
    }
}

/// Both models before and after a fault is undone, with their names.
pub(super) struct Witness<'a> {
    pub(super) part: &'a Part,
    pub(super) before: &'a Case,
    pub(super) after: &'a Case,
    names: &'a Names<'a>,
}

/// Says what a part of an explanation accuses.
pub(super) fn accuse(part: &Part, before: &Case, after: &Case, names: &Names<'_>) -> Accusation {
    let witness = Witness { part, before, after, names };
    let (mut blame, message, spot) = match &part.place {
        Place::Model => witness.model(),
        Place::Rows(rows) => witness.rows(rows),
        Place::Entries(entry, rows) => witness.entries(*entry, rows),
        Place::Column(entries) => witness.columns(entries),
        Place::Base => witness.constant(ConstantKey::BaseFromDh0),
        Place::Tool => witness.constant(ConstantKey::DhnFromTip),
        Place::ReferenceJoints(joints) => witness.reference_joints(joints),
    };
    blame.cause = part.cause.name();
    if let Some(Spot { source, span }) = &spot {
        blame.file = Some(source.path.display().to_string());
        blame.line = Some(line_column(&source.text, span.start).0);
    }
    Accusation { blame, message, spot, cause: part.cause }
}

/// What is said, and where it stands.
pub(super) type Said = (Blame, String, Option<Spot>);

impl Witness<'_> {
    fn model(&self) -> Said {
        if self.part.cause != Cause::ConventionSwapped {
            return self.columns(&[Entry::A, Entry::D]);
        }
        let span = self.names.places.and_then(RobotFilePlaces::convention);
        let word = |suspect: &Suspect| suspect.convention.unwrap_or(DhConvention::Standard).name();
        let (found, expected) = (word(&self.before.suspect), word(&self.after.suspect));
        let blame = Blame {
            found: Some(Figure::Text(found.to_owned())),
            expected: Some(Figure::Text(expected.to_owned())),
            suggestion: format!("write convention = \"{expected}\""),
            ..Blame::default()
        };
        (blame, format!("the table is read as {found}, its figures are {expected}"), self.in_robot_file(span))
    }

    fn rows(&self, rows: &[usize]) -> Said {
        if self.part.cause == Cause::Parameter {
            return self.kind(rows[0]);
        }
        let names: Vec<String> = rows.iter().map(|&row| self.joint(row)).collect();
        let listed = names.join("\", \"");
        let joint = if let [name] = &names[..] { Some(name.clone()) } else { None };
        let rate = |case: &Case| case.suspect.rows[rows[0]].rate;
        let (found, expected) = (rate(self.before), rate(self.after));
        let ratio = |blame: Blame| Blame {
            value: Some(found / expected),
            found: Some(Figure::Number(found)),
            expected: Some(Figure::Number(expected)),
            ..blame
        };
        let named =
            Blame { joints: if joint.is_some() { Vec::new() } else { names }, joint, ..Blame::default() };
        let (blame, message, suggestion) = match self.part.cause {
            Cause::AxisFlipped => (
                ratio(named),
                format!(
                    "joint \"{listed}\" moves the other way: sign is {}, it should be {}",
                    fitted_number(found),
                    fitted_number(expected)
                ),
                format!("write sign = {}, or turn the joint's axis round", fitted_number(expected)),
            ),
            Cause::Ratio => (
                ratio(named),
                format!(
                    "joint \"{listed}\" moves {} times as far as it should",
                    fitted_number(found / expected)
                ),
                "check the joint's gear ratio and unit".to_owned(),
            ),
            Cause::JointsSwapped => {
                let (what, how) =
                    if self.figures_moved(rows) { ("rows", "rows") } else { ("names", "joint names") };
                (
                    named,
                    format!("the {what} of joints \"{listed}\" are exchanged"),
                    format!("exchange the two {how}"),
                )
            }
            Cause::ParametersExchanged => self.lengths_exchanged(named, rows[0]),
            _ => (
                ratio(named),
                format!("the position of joint \"{listed}\" is taken in another unit"),
                "give joint positions in rad".to_owned(),
            ),
        };
        let key = match self.part.cause {
            Cause::AxisFlipped => RowKey::Sign,
            Cause::ParametersExchanged if self.is_written(rows[0], RowKey::A) => RowKey::A,
            Cause::ParametersExchanged => RowKey::D,
            _ => RowKey::Joint,
        };
        (Blame { suggestion, ..blame }, message, self.spot(rows[0], key))
    }

    fn kind(&self, row: usize) -> Said {
        let kind = |case: &Case| match case.suspect.rows[row].link {
            SuspectLink::Dh { kind, .. } => kind.name(),
            SuspectLink::Screw { .. } => DhRowKind::Revolute.name(),
        };
        let (found, expected, joint) = (kind(self.before), kind(self.after), self.joint(row));
        let message = format!("the row of joint \"{joint}\" is {found}, the joint is {expected}");
        let blame = Blame {
            joint: Some(joint),
            parameter: Some("kind".to_owned()),
            found: Some(Figure::Text(found.to_owned())),
            expected: Some(Figure::Text(expected.to_owned())),
            suggestion: format!("write kind = \"{expected}\""),
            ..Blame::default()
        };
        (blame, message, self.spot(row, RowKey::Kind))
    }

    fn lengths_exchanged(&self, named: Blame, row: usize) -> (Blame, String, String) {
        let pair = |case: &Case| {
            let figure = |entry| self.written(row, entry, case.suspect.entry(row, entry).unwrap_or_default());
            [figure(Entry::A), figure(Entry::D)]
        };
        let (found, expected) = (pair(self.before).join(", "), pair(self.after));
        let blame = Blame {
            parameter: Some("a, d".to_owned()),
            found: Some(Figure::Text(found.clone())),
            expected: Some(Figure::Text(expected.join(", "))),
            ..named
        };
        let message =
            format!("a and d of joint \"{}\" stand in each other's place: {found}", self.joint(row));
        (blame, message, format!("write {}", expected.join(" and ")))
    }

    fn entries(&self, entry: Entry, rows: &[usize]) -> Said {
        let row = rows[0];
        let value = |case: &Case, row: usize| case.suspect.entry(row, entry).unwrap_or_default();
        let (found, expected) = (value(self.before, row), value(self.after, row));
        let parameter = Some(entry_name(entry).to_owned());
        if let &[first, second] = rows {
            let joints = vec![self.joint(first), self.joint(second)];
            let message =
                format!("alpha of joints \"{}\" stand in each other's place", joints.join("\", \""));
            let suggestion = format!(
                "exchange them: {} and {}",
                self.written(first, entry, expected),
                self.written(second, entry, value(self.after, second))
            );
            let blame = Blame { joints, parameter, suggestion, ..Blame::default() };
            return (blame, message, self.spot(second, row_key(entry)));
        }
        let joint = self.joint(row);
        let right = self.written(row, entry, expected);
        let (stands, suggestion) = if self.is_written(row, row_key(entry)) {
            (format!("{} stands there", self.written(row, entry, found)), format!("write {right}"))
        } else {
            (format!("{} is not written, so 0", entry_name(entry)), format!("add {right} to the row"))
        };
        let message = format!("joint \"{joint}\": {stands}, it should be {right}");
        let blame = Blame {
            joint: Some(joint),
            parameter,
            value: Some(off(entry, found, expected)),
            found: Some(Figure::Number(found)),
            expected: Some(Figure::Number(expected)),
            suggestion,
            ..Blame::default()
        };
        (blame, message, self.spot(row, row_key(entry)))
    }

    fn constant(&self, key: ConstantKey) -> Said {
        let pose: fn(&Case) -> Pose = match key {
            ConstantKey::BaseFromDh0 => |case| case.suspect.base.pose,
            ConstantKey::DhnFromTip => |case| case.suspect.tool.pose,
        };
        let name = key.name();
        let (found, expected) = (pose(self.before), pose(self.after));
        let shift = found.translation - expected.translation;
        let turn = rotation_log(&(expected.rotation.transpose() * found.rotation));
        let how = match self.part.cause {
            Cause::RpyOrder => "has its roll, pitch and yaw in another order".to_owned(),
            Cause::Tool | Cause::Base => format!("is off by {}", off_by(shift.norm(), turn.norm())),
            _ => "is in another unit than its keys say".to_owned(),
        };
        let places = self.names.places;
        let [found, expected] = [found, expected].map(|pose| isometry(&pose));
        let suggestion = match places {
            Some(places) => places.constant_as(key, &expected),
            None => format!("write {name} = {}", fitted_transform(&expected)),
        };
        let blame = Blame {
            found: Some(Figure::Text(fitted_transform(&found))),
            expected: Some(Figure::Text(fitted_transform(&expected))),
            translation_m: Some(shift.into()),
            rotation_rad: Some(turn.into()),
            suggestion,
            ..Blame::default()
        };
        let part =
            if shift.norm() > turn.norm() { ConstantPart::Translation } else { ConstantPart::Rotation };
        let span = places.map(|places| places.constant(key, part));
        (blame, format!("the declared transform {name} {how}"), self.in_robot_file(span))
    }

    fn reference_joints(&self, joints: &[usize]) -> Said {
        let names: Vec<String> = joints.iter().map(|&joint| self.names.chain_joint(joint)).collect();
        let listed = names.join("\", \"");
        let rotation = |case: &Case, joint: usize| case.reference.joints[joint].parent_from_joint.rotation;
        let turn = |joint: usize| {
            rotation_log(&(rotation(self.after, joint).transpose() * rotation(self.before, joint))).norm()
        };
        let most = joints.iter().map(|&joint| turn(joint)).fold(0.0, f64::max);
        let mut blame = Blame::default();
        let (message, suggestion) = match self.part.cause {
            Cause::FixedJointDropped => (
                format!("the model leaves out the fixed joint \"{listed}\" of the URDF"),
                format!("put the origin of \"{listed}\" into the model"),
            ),
            Cause::RpyOrder => (
                format!("the rpy of joint \"{listed}\" is in another order in the URDF than in the model"),
                format!("check the rpy of joint \"{listed}\": R = Rz(yaw) Ry(pitch) Rx(roll)"),
            ),
            _ => {
                blame.parameter = Some("rpy".to_owned());
                blame.value = Some(most);
                (
                    format!(
                        "the URDF writes quarter turns of joints \"{listed}\" with too few digits, off by up to {most:.1e} rad"
                    ),
                    "write pi/2 as 1.5707963267948966 in the URDF".to_owned(),
                )
            }
        };
        let spot = self.names.urdf.and_then(|urdf| {
            Some(Spot { source: Arc::clone(urdf.source()), span: urdf.joint_origin(names.first()?)? })
        });
        match <[String; 1]>::try_from(names) {
            Ok([name]) => blame.joint = Some(name),
            Err(names) => blame.joints = names,
        }
        (Blame { suggestion, ..blame }, message, spot)
    }

    fn joint(&self, row: usize) -> String {
        self.names.moving_joint(self.before.suspect.rows[row].joint)
    }

    fn in_robot_file(&self, span: Option<Range<usize>>) -> Option<Spot> {
        Some(Spot { source: Arc::clone(self.names.places?.source()), span: span? })
    }

    /// Whether the file writes a figure of a row; where there is no file nothing is left out.
    fn is_written(&self, row: usize, key: RowKey) -> bool {
        let place = self.names.places.and_then(|places| places.value(row, key));
        place.is_none_or(|place| place.is_written)
    }

    /// Where a figure of a row stands.
    pub(super) fn spot(&self, row: usize, key: RowKey) -> Option<Spot> {
        self.in_robot_file(Some(self.names.places?.value(row, key)?.span))
    }

    /// Whether the figures have changed places with the names.
    fn figures_moved(&self, rows: &[usize]) -> bool {
        self.before.suspect.rows[rows[0]].link != self.after.suspect.rows[rows[0]].link
    }

    /// A figure of a row as the file writes it, in the unit of its key there.
    fn written(&self, row: usize, entry: Entry, value: f64) -> String {
        let place = self.names.places.and_then(|places| places.value(row, row_key(entry)));
        let unit = if is_angle(entry) { Unit::Angle } else { Unit::Length };
        match place {
            Some(place) => format!("{} = {}", place.key, unit.fitted(value, place.units)),
            None => format!("{} = {}", entry_name(entry), unit.fitted(value, UnitSystem::Si)),
        }
    }
}

/// How far a transform is off, without the part that is only rounding.
fn off_by(shift_m: f64, turn_rad: f64) -> String {
    /// Rounding of a fit, in m or rad.
    const NOTHING: f64 = 1e-12;
    let shift = (shift_m > NOTHING).then(|| length(shift_m));
    let turn = (turn_rad > NOTHING).then(|| angle(turn_rad));
    shift.into_iter().chain(turn).collect::<Vec<_>>().join(" and ")
}

/// Found less expected; of angles within half a turn.
fn off(entry: Entry, found: f64, expected: f64) -> f64 {
    let off = found - expected;
    if is_angle(entry) { off.sin().atan2(off.cos()) } else { off }
}

pub(super) fn is_angle(entry: Entry) -> bool {
    matches!(entry, Entry::Alpha | Entry::Theta)
}

pub(super) fn entry_name(entry: Entry) -> &'static str {
    match entry {
        Entry::A => "a",
        Entry::Alpha => "alpha",
        Entry::D => "d",
        Entry::Theta => "theta",
    }
}

pub(super) fn row_key(entry: Entry) -> RowKey {
    match entry {
        Entry::A => RowKey::A,
        Entry::Alpha => RowKey::Alpha,
        Entry::D => RowKey::D,
        Entry::Theta => RowKey::Theta,
    }
}
