//! `line_tcp`, `arc_tcp` and `path_tcp`: motions that blend into each other are one path with one speed profile.

use std::sync::Arc;

use congruent_description::RobotQ;
use congruent_input::{
    Diagnostic,
    display::{angle, length, number, quantity},
};
use congruent_kinematics::{Arm, Pose, TargetPart, UrdfTree};
use congruent_scenario::{ArcMotion, FilePlace, MotionSettings, PoseSettings, ToolOrientation};
use nalgebra::{Isometry3, Vector3};

use super::{
    drive::{LegTiming, arc_drive, blend_rates, line_drive, path_drive},
    geometry::TcpPath,
    inverse::{PathFailure, along},
    segment::Segment,
};
use crate::{
    JointSpacePath, JointSpline, Motion, MotionPlan, PlannedMove, RateLimits, SpeedProfile, Stretch,
    TimeScaling, codes, planning::Planning, spline::SplineValues,
};

/// A tool that is nearer to its target than this, m and rad, has reached it.
const REACHED: f64 = 1e-6;
/// A blend may be longer than half of a line by this much. Kind: rounding.
const ROUNDING_M: f64 = 1e-9;

/// One line or arc with its timing.
struct Leg<'a> {
    segment: Segment,
    /// Index of the motion in the group that the segment belongs to.
    motion: usize,
    blend_m: f64,
    drive: LegTiming,
    place: FilePlace<'a>,
}

/// How many motions from here on are one path; 0 if the first is no line or arc.
pub(crate) fn group_length(motions: &[MotionSettings]) -> usize {
    let is_path = |motion: &MotionSettings| {
        matches!(motion, MotionSettings::Line(_) | MotionSettings::Arc(_) | MotionSettings::TcpPath(_))
    };
    let leads_on = |motion: &MotionSettings| match motion {
        MotionSettings::Line(line) => line.blend_m > 0.0,
        MotionSettings::Arc(arc) => arc.blend_m > 0.0,
        _ => false,
    };
    let mut count = 0;
    while count < motions.len() && is_path(&motions[count]) {
        count += 1;
        if !leads_on(&motions[count - 1]) {
            break;
        }
    }
    count
}

/// Plans the motions of one path; `planning.place` is the list of all motions, in which the first has this index.
pub(crate) fn plan(
    motions: &[MotionSettings],
    first: usize,
    planning: &mut Planning<'_>,
) -> Result<Vec<Motion>, Diagnostic> {
    let places = planning.place;
    planning.place = places.item(first);
    let world_from_base = world_from_base(planning)?;
    let legs = legs(motions, places, first, planning, &world_from_base)?;
    check(&legs)?;
    let part = part(motions, planning.place)?;
    planning.warnings.extend(legs.iter().filter_map(Leg::slower_on_arc));
    // Time first, from the tool's path alone; the joints' limits are checked on the whole move below.
    let time_scaling = time_scaling(&legs);
    let ends: Vec<usize> = legs.iter().map(|leg| leg.motion).collect();
    let places_of_legs: Vec<FilePlace<'_>> = legs.iter().map(|leg| leg.place).collect();
    let path = TcpPath::new(legs.into_iter().map(|leg| (leg.segment, leg.blend_m)).collect());
    let spline = along(&path, planning.description, &world_from_base.inverse(), planning.from, part);
    let spline = Arc::new(spline.map_err(|stop| refused(stop, &path, &places_of_legs))?);
    let whole = PlannedMove {
        to: end_of(&spline, 1.0, planning.from.len()),
        joint_path: JointSpacePath::Spline(Arc::clone(&spline)),
        time_scaling,
        begins_s: 0.0,
    };
    let where_ = |time_s: f64, time_scaling: &TimeScaling| {
        let at_m = time_scaling.at(time_s).share * path.length_m();
        format!(", {} along the path of {}", length(at_m), length(path.length_m()))
    };
    let time_scaling = whole.time_scaling.clone();
    let whole =
        planning.within_limits(whole, |time_s| where_(time_s, &time_scaling)).map_err(|mut error| {
            let help = error.help.take().unwrap_or_default();
            error.with_help(format!("{help}; joints are fast if the tool is fast or near a singularity"))
        })?;
    planning.place = places;
    Ok(split(&whole, &spline, &path, &ends))
}

/// Whether the orientation is controlled as well: the same for motions that blend, and without a rotation if it is free.
fn part(motions: &[MotionSettings], place: FilePlace<'_>) -> Result<TargetPart, Diagnostic> {
    let of = |motion: &MotionSettings| match motion {
        MotionSettings::Line(line) => (line.orientation, line.line_tcp.has_rotation()),
        MotionSettings::Arc(arc) => (arc.orientation, arc.arc_tcp.to.has_rotation()),
        MotionSettings::TcpPath(path) => {
            (path.orientation, path.path_tcp.iter().any(PoseSettings::has_rotation))
        }
        _ => (ToolOrientation::Led, false),
    };
    let refused = |message: &str, help: &str| {
        Err(place.mark(Diagnostic::error(codes::scenario::ORIENTATION, message).with_help(help)))
    };
    let free = motions.iter().map(of).filter(|(orientation, _)| *orientation == ToolOrientation::Free);
    match free.clone().count() {
        0 => Ok(TargetPart::Pose),
        _ if free.clone().any(|(_, has_rotation)| has_rotation) => {
            refused("the target has a rotation, but `orientation = \"free\"`", "remove one of them")
        }
        count if count < motions.len() => refused(
            "a motion with `orientation = \"free\"` blends into a motion that controls the orientation",
            "give `orientation = \"free\"` to all of them, or remove `blend_m` between them",
        ),
        _ => Ok(TargetPart::Position),
    }
}

/// The motions of one path, each from the end of the one before: all share the path and its time scaling.
fn split(whole: &PlannedMove, spline: &JointSpline, path: &TcpPath, motion_of_leg: &[usize]) -> Vec<Motion> {
    let count = motion_of_leg.last().map_or(0, |last| last + 1);
    let mut begins_s = 0.0;
    let mut motions = Vec::with_capacity(count);
    for motion in 0..count {
        let last_leg = motion_of_leg.iter().rposition(|&of| of == motion).unwrap_or(0);
        let share = path.ends_m()[last_leg] / path.length_m();
        let is_last = motion + 1 == count;
        let ends_s = match &whole.time_scaling {
            TimeScaling::Phases(phases) if !is_last => phases.time_of(share),
            _ => whole.time_scaling.duration_s(),
        };
        let to = if is_last { whole.to.clone() } else { end_of(spline, share, whole.to.len()) };
        let motion_plan = MotionPlan::Planned(PlannedMove { to, begins_s, ..whole.clone() });
        motions.push(Motion { duration_s: ends_s - begins_s, motion_plan });
        begins_s = ends_s;
    }
    motions
}

fn end_of(spline: &JointSpline, share: f64, dof: usize) -> RobotQ {
    let (mut q, mut first, mut second) = (RobotQ::zeros(dof), vec![0.0; dof], vec![0.0; dof]);
    spline.at(share, SplineValues { q: &mut q, first: &mut first, second: &mut second });
    q
}

fn world_from_base(planning: &Planning<'_>) -> Result<Isometry3<f64>, Diagnostic> {
    let tree = UrdfTree::new(&planning.description.robot);
    let found = tree.root_from_link(planning.from, planning.description.base);
    let refused = |error: congruent_kinematics::KinematicsError| {
        Diagnostic::error(codes::scenario::PATH, error.to_string())
    };
    found.map(|pose| pose.to_isometry()).map_err(|error| planning.place.mark(refused(error)))
}

fn legs<'a>(
    motions: &[MotionSettings],
    places: FilePlace<'a>,
    first: usize,
    planning: &Planning<'_>,
    world_from_base: &Isometry3<f64>,
) -> Result<Vec<Leg<'a>>, Diagnostic> {
    let model = |error: congruent_kinematics::KinematicsError| {
        planning.place.mark(Diagnostic::error(codes::scenario::PATH, error.to_string()))
    };
    let mut arm = Arm::from_description(planning.description).map_err(model)?;
    let from = arm.from_robot(planning.from);
    let world_from_start: Isometry3<f64> =
        world_from_base * arm.base_from_tcp(&from).map_err(model)?.to_isometry();
    let mut legs: Vec<Leg<'a>> = Vec::new();
    for (motion, settings) in motions.iter().enumerate() {
        let place = places.item(first + motion);
        let begins = legs.last().map_or(world_from_start, Leg::end);
        match settings {
            MotionSettings::Line(line) => {
                let to = pose_of(&line.line_tcp, &begins, place.key("line_tcp"))?;
                let (segment, drive) = (Segment::line(begins, to), line_drive(line, place)?);
                legs.push(Leg { segment, motion, blend_m: line.blend_m, drive, place });
            }
            MotionSettings::Arc(arc) => {
                let segment = arc_of(arc, &begins, place)?;
                let drive = arc_drive(arc, place)?;
                legs.push(Leg { segment, motion, blend_m: arc.blend_m, drive, place });
            }
            MotionSettings::TcpPath(path) => {
                for (index, point) in path.path_tcp.iter().enumerate() {
                    let place = place.key("path_tcp").item(index);
                    let begins = legs.last().map_or(world_from_start, Leg::end);
                    let segment = Segment::line(begins, pose_of(point, &begins, place)?);
                    let blend_m = if index + 1 < path.path_tcp.len() { path.blend_m } else { 0.0 };
                    legs.push(Leg { segment, motion, blend_m, drive: path_drive(path), place });
                }
                if path.path_tcp.is_empty() {
                    let error = Diagnostic::error(codes::scenario::PATH_POINTS, "the path has no points");
                    return Err(place.mark(error));
                }
            }
            _ => unreachable!("a group holds lines, arcs and paths"),
        }
    }
    Ok(legs)
}

/// The pose of a target in the world; without a rotation it keeps the orientation.
fn pose_of(
    settings: &PoseSettings,
    before: &Isometry3<f64>,
    place: FilePlace<'_>,
) -> Result<Isometry3<f64>, Diagnostic> {
    let mut pose = settings.target(place)?;
    if !settings.has_rotation() {
        pose.rotation = before.rotation;
    }
    // Through `Pose`, which makes the rotation orthonormal again: a matrix in a file has few digits.
    Ok(Pose::from(pose).to_isometry())
}

fn arc_of(arc: &ArcMotion, before: &Isometry3<f64>, place: FilePlace<'_>) -> Result<Segment, Diagnostic> {
    let place = place.key("arc_tcp");
    let via_place = place.key("via");
    if arc.arc_tcp.via.has_rotation() {
        let error =
            Diagnostic::error(codes::scenario::ARC, "`via` has a rotation, but only its position is used");
        return Err(
            via_place.mark(error.with_help("remove it: the tool rotates evenly from the start to `to`"))
        );
    }
    let via = arc.arc_tcp.via.target(via_place)?.translation.vector;
    let to = pose_of(&arc.arc_tcp.to, before, place.key("to"))?;
    Segment::arc(*before, via, to).ok_or_else(|| {
        let error = Diagnostic::error(
            codes::scenario::ARC,
            "no circle: start, `via` and `to` are on a straight line",
        );
        place.mark(error.with_help("move `via` off the line, or use line_tcp; a full circle is two arcs"))
    })
}

/// Refuses blends that do not fit, and lines whose timing is not determined.
fn check(legs: &[Leg<'_>]) -> Result<(), Diagnostic> {
    for (index, leg) in legs.iter().enumerate() {
        let is_last = index + 1 == legs.len();
        let refused = |message: String, help: &'static str| {
            Err(leg.place.mark(Diagnostic::error(codes::scenario::PATH, message).with_help(help)))
        };
        if leg.segment.is_turn_alone() && leg.segment.length_m() < REACHED {
            return refused("the motion ends where it starts".to_owned(), "remove the motion");
        }
        if leg.segment.is_turn_alone() && matches!(leg.drive, LegTiming::Speed(_)) {
            let help = "give `duration_s` instead of `speed_m_s`";
            return refused(
                "the tool only rotates: `speed_m_s` does not determine the duration".to_owned(),
                help,
            );
        }
        if matches!(leg.drive, LegTiming::Duration { .. }) && legs.len() > 1 {
            let help = "give `speed_m_s` instead of `duration_s` to all of them";
            return refused("motions that blend into each other need `speed_m_s`".to_owned(), help);
        }
        if is_last && leg.blend_m > 0.0 {
            let help = "remove `blend_m`, or add a line_tcp, arc_tcp or path_tcp after this motion";
            return refused("`blend_m` is given, but no line or arc follows".to_owned(), help);
        }
        let shortest_m = |other: &Leg<'_>| other.segment.length_m() / 2.0;
        let at_most_m =
            legs.get(index + 1).map_or(f64::INFINITY, |next| shortest_m(leg).min(shortest_m(next)));
        // Lengths are differences of positions: half of a line may be rounded below what is written.
        if !is_last && leg.blend_m > at_most_m + ROUNDING_M {
            let (blend, at_most) = (length(leg.blend_m), length(at_most_m));
            let message = format!(
                "a blend of {blend} does not fit: limit {at_most}, half of the shorter of the two segments"
            );
            return refused(message, "the blends at the two ends of a segment may not overlap");
        }
    }
    Ok(())
}

fn time_scaling(legs: &[Leg<'_>]) -> TimeScaling {
    if let [Leg { drive: LegTiming::Duration { duration_s, profile }, .. }] = legs {
        return TimeScaling::Shape { profile: *profile, duration_s: *duration_s };
    }
    let path = TcpPath::new(legs.iter().map(|leg| (leg.segment.clone(), leg.blend_m)).collect());
    let rates: Vec<RateLimits> = legs.iter().filter_map(Leg::rates).collect();
    // Segments without their blends, and each blend as a stretch of its own with lower limits.
    let mut stretches = Vec::with_capacity(2 * legs.len());
    let mut blended_m = 0.0;
    for (index, (leg, limits)) in legs.iter().zip(&rates).enumerate() {
        let length = leg.segment.length_m() - blended_m - leg.blend_m;
        let is_last = index + 1 == legs.len();
        let stops = !is_last && leg.blend_m == 0.0;
        if length > 0.0 {
            stretches.push(Stretch { length, limits: *limits, stops });
        }
        blended_m = leg.blend_m;
        if !is_last && leg.blend_m > 0.0 {
            let limits = blend_rates(limits, &rates[index + 1], path.corner(index) / leg.blend_m);
            stretches.push(Stretch { length: 2.0 * leg.blend_m, limits, stops: false });
        }
    }
    TimeScaling::Phases(Arc::new(SpeedProfile::over(&stretches)))
}

impl Leg<'_> {
    fn end(&self) -> Isometry3<f64> {
        self.segment.at(self.segment.length_m())
    }

    /// Limits along the path; on an arc also the speed at which the centripetal acceleration v^2 / r reaches its limit.
    fn rates(&self) -> Option<RateLimits> {
        let LegTiming::Speed(rates) = self.drive else { return None };
        let fastest = (rates.acceleration * self.segment.radius_m()).sqrt();
        Some(RateLimits { velocity: rates.velocity.min(fastest), ..rates })
    }
}

impl Leg<'_> {
    /// The warning that an arc is too narrow for its speed.
    fn slower_on_arc(&self) -> Option<Diagnostic> {
        let LegTiming::Speed(asked) = self.drive else { return None };
        let rates = self.rates().filter(|rates| rates.velocity < asked.velocity)?;
        let [speed, asked] = [rates.velocity, asked.velocity].map(|value| quantity(value, "m/s"));
        let message = format!(
            "the tool moves at {speed} instead of {asked} on an arc of radius {}",
            length(self.segment.radius_m())
        );
        let help = format!(
            "a higher speed would exceed the limit of {} by centripetal acceleration",
            quantity(rates.acceleration, "m/s^2")
        );
        Some(self.place.mark(Diagnostic::warning(codes::scenario::ARC_SPEED, message).with_help(help)))
    }
}

/// A longer path of a tool is taken for one whose target was written in mm as m. Kind: choice; the largest arms reach 5 m.
const LONGEST_PATH_M: f64 = 50.0;

/// Help that suggests to control the position alone.
fn position_alone(angle_rad: f64, axis: &Vector3<f64>) -> String {
    let [x, y, z] = [axis.x, axis.y, axis.z].map(|entry| number((entry * 1e3).round() / 1e3));
    format!(
        "the position alone is reachable, with an orientation error of {} about [{x}, {y}, {z}]: \
         `orientation = \"free\"` allows it",
        angle(angle_rad)
    )
}

/// The error if there are no joint positions along the path, at the line or arc on which the solution ends.
fn refused(stop: PathFailure, path: &TcpPath, places: &[FilePlace<'_>]) -> Diagnostic {
    let at = |at_m: f64| {
        let whole = path.at(at_m).translation.vector;
        let [x, y, z] = [whole.x, whole.y, whole.z].map(|value| quantity(value, "m"));
        format!("at {} along the path of {}, [{x}, {y}, {z}]", length(at_m), length(path.length_m()))
    };
    let place = |at_m: f64| places[path.segment_at(at_m)];
    match stop {
        PathFailure::OutOfReach { at_m, smallest_error, limits_held, off } => {
            let message = format!("the path goes out of reach {}: smallest error {smallest_error}", at(at_m));
            let help = if limits_held.is_empty() {
                "move the path nearer to the arm, or start in another configuration of the arm".to_owned()
            } else {
                format!("joints at a limit: {}; start in another configuration", limits_held.join(", "))
            };
            let help = match off {
                // No arm has a path of this length: the help about its orientation would be wrong.
                _ if path.length_m() > LONGEST_PATH_M => {
                    format!(
                        "the path is {} long: is its target in mm? then write xyz_mm",
                        length(path.length_m())
                    )
                }
                Some((angle_rad, axis)) => format!("{help}; {}", position_alone(angle_rad, &axis)),
                None => help,
            };
            place(at_m).mark(Diagnostic::error(codes::scenario::PATH_REACH, message).with_help(help))
        }
        PathFailure::Singular { at_m, joint } => {
            let message = format!("joint \"{joint}\" would jump {}", at(at_m));
            let help =
                "the path passes a singularity: move the path, or start in another configuration of the arm";
            place(at_m).mark(Diagnostic::error(codes::scenario::PATH_SINGULAR, message).with_help(help))
        }
        PathFailure::Model(error) => {
            places[0].mark(Diagnostic::error(codes::scenario::PATH, error.to_string()))
        }
    }
}
