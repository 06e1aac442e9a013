//! `[controller]` checked against its robot: one number for each joint, periods in steps.

use congruent_description::Robot;
use congruent_input::{Diagnostic, Findings};
use congruent_scenario::{
    ControllerKind, ControllerSettings, FilePlace, JointNumbers, Range, ScenarioFolder,
};
use congruent_simulation::Gains;
use congruent_tables::read_table;

use super::{
    joint_numbers::{NumberRule, Unnamed, resolve},
    torque_table::TorqueTable,
};
use crate::codes;

/// The controller of a run; vectors hold one entry for each movable joint.
#[derive(Debug, Clone, PartialEq)]
pub struct ControllerSetup {
    /// The law by which efforts follow from states and setpoints.
    pub kind: ControllerKind,
    pub(crate) gains: Vec<Gains>,
    /// Torque per integral of the position error.
    pub(crate) integral: Vec<f64>,
    /// Constant torques, N m or N.
    pub(crate) torque: Vec<f64>,
    /// Torques over time, added to the constant ones.
    pub(crate) torque_table: Option<TorqueTable>,
    /// `None` for a controller that is continuous in time.
    pub(crate) sampling: Option<ControlPeriod>,
}

/// The clock of a digital controller, in steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ControlPeriod {
    /// From one reading of the sensors to the next.
    pub(crate) period: u64,
    /// From a reading to the torques that follow from it.
    pub(crate) delay: usize,
}

/// Largest deviation of a period or a delay from a whole number of steps, in steps. Kind: digits of files.
const WHOLE_STEPS: f64 = 1e-6;
/// Longest period or delay, in steps: the torques of all steps of a delay are in memory.
const MOST_DELAYED: f64 = 1e5;
/// Largest file of torques that is read.
const MOST_BYTES: u64 = 64 << 20;

impl ControllerSetup {
    /// Whether the controller drives the robot by efforts.
    pub(crate) fn has_actuators(&self) -> bool {
        self.kind.has_actuators()
    }

    pub(in crate::setup) fn new(
        settings: &ControllerSettings,
        place: FilePlace<'_>,
        folder: ScenarioFolder<'_>,
        robot: &Robot,
        step_s: f64,
    ) -> Result<Self, Findings> {
        let kind = settings.kind;
        let mut errors: Vec<Diagnostic> = strange_keys(settings, kind, place).collect();
        let mut numbers = |numbers: &JointNumbers, key: &str, (range, unnamed)| {
            let rule = NumberRule { what: key, range, unnamed, of_angles: None };
            let resolved = resolve(numbers, rule, place.key(key), robot);
            resolved.map_err(|found| errors.extend(found)).unwrap_or_default()
        };
        let stiffness = numbers(&settings.stiffness, "stiffness", (Range::NonNegative, Unnamed::Refused));
        let damping = numbers(&settings.damping, "damping", (Range::NonNegative, Unnamed::Refused));
        let integral = numbers(&settings.integral, "integral", (Range::NonNegative, Unnamed::Refused));
        let torque = numbers(&settings.torque, "torque", (Range::Finite, Unnamed::Zero));
        let mut keep = |result: Result<_, Diagnostic>| result.map_err(|error| errors.push(error)).ok();
        // The pairs give both calls of `keep` one type.
        let sampling = keep(sampling(settings, place, step_s).map(|sampling| (sampling, None)));
        let torque_table = keep(torque_table(settings, place, folder, robot).map(|table| (None, table)));
        let (Some((sampling, _)), Some((_, torque_table)), true) =
            (sampling, torque_table, errors.is_empty())
        else {
            return Err(errors.into());
        };
        let gains = stiffness.into_iter().zip(damping);
        let gains = gains.map(|(stiffness, damping)| Gains { stiffness, damping }).collect();
        Ok(Self { kind, gains, integral, torque, torque_table, sampling })
    }
}

/// Keys that do not belong to the controller; gains of zero have no effect and are not reported.
fn strange_keys<'a>(
    settings: &'a ControllerSettings,
    kind: ControllerKind,
    place: FilePlace<'a>,
) -> impl Iterator<Item = Diagnostic> + 'a {
    let is_playback =
        matches!(kind, ControllerKind::Absent | ControllerKind::Passive | ControllerKind::Kinematic);
    let given = [
        // Both controllers without actuators have always ignored gains.
        ("stiffness", !is_playback && !settings.stiffness.is_zero()),
        ("damping", !is_playback && !settings.damping.is_zero()),
        ("integral", !settings.integral.is_zero()),
        ("torque", !settings.torque.is_zero()),
        ("torque_file", settings.torque_file.is_some()),
        ("rate_hz", settings.rate_hz.is_some()),
        ("delay_s", settings.delay_s.is_some()),
    ];
    given.into_iter().filter(move |&(key, is_given)| is_given && !kind.takes(key)).map(move |(key, _)| {
        let message = format!("controller \"{}\" has no `{key}`", kind.name());
        let with = congruent_scenario::CONTROLLER_KINDS.into_iter().filter(|kind| kind.takes(key));
        let with: Vec<&str> = with.map(ControllerKind::name).collect();
        let error = Diagnostic::error(codes::scenario::CONTROLLER_KEY, message);
        place.key(key).mark(error.with_help(format!("controllers that have it: {}", with.join(", "))))
    })
}

/// Periods in steps; a controller with a delay but no rate computes at every step.
fn sampling(
    settings: &ControllerSettings,
    place: FilePlace<'_>,
    step_s: f64,
) -> Result<Option<ControlPeriod>, Diagnostic> {
    if settings.rate_hz.is_none() && settings.delay_s.is_none() {
        return Ok(None);
    }
    let whole = |steps: f64, key: &str, written: String| {
        let rounded = steps.round();
        if (steps - rounded).abs() > WHOLE_STEPS || rounded < 1.0 {
            let message = format!("{key} = {written} is {steps:.4} steps of {step_s} s, not a whole number");
            let help = "change the value, or `step_s` under [simulation]";
            return Err(place
                .key(key)
                .mark(Diagnostic::error(codes::scenario::SAMPLING, message).with_help(help)));
        }
        if rounded > MOST_DELAYED {
            let message = format!("{key} = {written} is {rounded} steps, limit <= {MOST_DELAYED}");
            return Err(place.key(key).mark(Diagnostic::error(codes::scenario::SAMPLING, message)));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 <= rounded <= 1e5")]
        let steps = rounded as usize;
        Ok(steps)
    };
    let period = settings
        .rate_hz
        .map_or(Ok(1), |rate_hz| whole(1.0 / rate_hz / step_s, "rate_hz", format!("{rate_hz}")))?;
    let delay =
        settings.delay_s.map_or(Ok(0), |delay_s| whole(delay_s / step_s, "delay_s", format!("{delay_s}")))?;
    Ok(Some(ControlPeriod { period: period as u64, delay }))
}

fn torque_table(
    settings: &ControllerSettings,
    place: FilePlace<'_>,
    folder: ScenarioFolder<'_>,
    robot: &Robot,
) -> Result<Option<TorqueTable>, Diagnostic> {
    let Some(path) = &settings.torque_file else { return Ok(None) };
    let source = read_table(folder.access, &folder.path.join(path), MOST_BYTES);
    let table = source.and_then(|source| {
        TorqueTable::read(&source, robot).map(Some).map_err(|error| error.in_file(&source))
    });
    table.map_err(|error| if error.source.is_none() { place.key("torque_file").mark(error) } else { error })
}
