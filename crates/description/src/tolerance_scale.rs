//! What a tolerance is compared with: the size of the robot.

use congruent_input::{
    Diagnostic,
    display::{angle, length},
    units::{LARGEST_PLAUSIBLE_M, Unit},
};
use congruent_robot::{LinkIndex, Robot};
use nalgebra::Isometry3;

use crate::codes;

/// The scale that a tolerance is compared with: one as large as the robot, or as half a turn, accepts every pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToleranceScale {
    /// An upper bound of the reach; `None` if sliding joints without limits leave it open, or nothing is away from the axis.
    reach_m: Option<f64>,
}

/// A tolerance above this share of the reach, or of half a turn, is reported as wide.
const WIDE: f64 = 0.1;

impl ToleranceScale {
    /// The scale of a robot with a tool centre point at `tip_from_tcp` on link `tip`.
    pub(crate) fn with_tool(robot: &Robot, tip: LinkIndex, tip_from_tcp: Option<&Isometry3<f64>>) -> Self {
        let tool_m = tip_from_tcp.map_or(0.0, |tool| tool.translation.vector.norm());
        let longest = |start: DistanceStart| {
            let distances_m = distances(robot, start);
            let tcp_m = distances_m.get(tip.get()).map_or(0.0, |tip_m| tip_m + tool_m);
            distances_m.into_iter().fold(tcp_m, f64::max)
        };
        // A wheel on a frame has all its parts on the first axis, so the distance from it is 0; then the root counts.
        let found = [longest(DistanceStart::FirstAxis), longest(DistanceStart::Root)]
            .into_iter()
            .find(|&reach_m| reach_m > 0.0);
        Self { reach_m: found.filter(|reach_m| reach_m.is_finite()) }
    }

    /// The reach, if it is known and not zero: no link can be farther from the first axis.
    pub fn reach_m(self) -> Option<f64> {
        self.reach_m
    }

    /// What is wrong with a tolerance, in m or rad, that is written under `key`: an error if it allows every pose, a
    /// warning if it is wide.
    ///
    /// # Examples
    /// ```
    /// use congruent_input::units::Unit;
    /// let urdf = r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
    ///     <joint name="i" type="continuous"><parent link="a"/><child link="b"/></joint>
    ///     <joint name="j" type="continuous"><parent link="b"/><child link="c"/><origin xyz="2 0 0"/></joint></robot>"#;
    /// let robot = congruent_description::parse_urdf(urdf).unwrap();
    /// let scale = congruent_description::ToleranceScale::without_tool(&robot);
    /// assert_eq!(scale.reach_m(), Some(2.0));
    /// assert!(scale.examine(Unit::Length, "position_m", 2.1).is_some());
    /// assert!(scale.examine(Unit::Length, "position_m", 0.1).is_none());
    /// ```
    pub fn examine(self, unit: Unit, key: &str, value: f64) -> Option<Diagnostic> {
        let (largest, of_what, shown): (f64, &str, fn(f64) -> String) = match (unit, self.reach_m) {
            (Unit::Length, Some(reach_m)) => (reach_m, "the reach of the robot", length),
            // Sliding joints without limits reach any distance, but no difference of two descriptions is that large.
            (Unit::Length, None) => (LARGEST_PLAUSIBLE_M, "the largest plausible length of a robot", length),
            (Unit::Angle, _) => (std::f64::consts::PI, "half a turn", angle),
        };
        let tenth = shown(WIDE * largest);
        let (value, whole) = (Some(value).filter(|&value| value > WIDE * largest)?, shown(largest));
        let allowed = shown(value);
        Some(if value > largest {
            let message =
                format!("`{key}` = {allowed} exceeds {of_what}, {whole}, so every pose would agree");
            Diagnostic::error(codes::tolerance::MEANINGLESS, message).with_help(format!(
                "give less than {whole}, usually far less than {tenth}; is the minus sign of an exponent missing?"
            ))
        } else {
            let message = format!("`{key}` = {allowed} is more than a tenth of {of_what}, {whole}");
            Diagnostic::warning(codes::tolerance::WIDE, message)
                .with_help(format!("give at most {tenth}, unless such a wide tolerance is intended"))
        })
    }

    /// The scale of a robot without a tool.
    pub fn without_tool(robot: &Robot) -> Self {
        Self::with_tool(robot, robot.root(), None)
    }
}

/// Where a distance begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DistanceStart {
    /// At the first moving axis above a link: the distance before it never changes.
    FirstAxis,
    /// At the root link.
    Root,
}

/// How far each link can be at most from the start: along its joints, with the range of those that slide.
fn distances(robot: &Robot, start: DistanceStart) -> Vec<f64> {
    let mut distances_m = vec![0.0; robot.links().len()];
    let mut moves = vec![start == DistanceStart::Root; robot.links().len()];
    // Parents come before their children.
    for joint in robot.joints() {
        let (parent, child) = (joint.parent.get(), joint.child.get());
        let origin_m = if moves[parent] { joint.parent_from_joint.translation.vector.norm() } else { 0.0 };
        distances_m[child] = distances_m[parent] + origin_m + joint.largest_shift_m();
        moves[child] = moves[parent] || joint.kind.is_movable();
    }
    distances_m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse_urdf;
    use congruent_input::Severity;

    fn robot(joints: &str) -> Robot {
        let links: String = ["a", "b", "c", "d"].map(|name| format!("<link name='{name}'/>")).concat();
        parse_urdf(&format!("<robot name='r'>{links}{joints}</robot>")).unwrap()
    }

    fn joint(kind: &str, [parent, child]: [&str; 2], rest: &str) -> String {
        format!(
            "<joint name='{child}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{rest}</joint>"
        )
    }

    #[test]
    fn the_reach_is_counted_from_the_first_axis() {
        let far = "<origin xyz='50 0 0'/>";
        let arm = |last: &str| {
            robot(
                &[joint("fixed", ["a", "b"], far), joint("continuous", ["b", "c"], far), last.to_owned()]
                    .concat(),
            )
        };
        let turning = arm(&joint("continuous", ["c", "d"], "<origin xyz='0 3 4'/>"));
        assert_eq!(ToleranceScale::without_tool(&turning).reach_m(), Some(5.0));
        let limits = "<origin xyz='0 3 4'/><limit lower='-2' upper='1' effort='1' velocity='1'/>";
        let sliding = arm(&joint("prismatic", ["c", "d"], limits));
        assert_eq!(ToleranceScale::without_tool(&sliding).reach_m(), Some(7.0));
        let tool = Isometry3::translation(0.0, 0.0, 2.0);
        let tip = turning.find_link("d").unwrap();
        assert_eq!(ToleranceScale::with_tool(&turning, tip, Some(&tool)).reach_m(), Some(7.0));
        let wheel = arm(&joint("continuous", ["c", "d"], ""));
        assert_eq!(ToleranceScale::without_tool(&wheel).reach_m(), Some(100.0), "all is in the axis");
    }

    #[test]
    fn a_tolerance_as_large_as_the_robot_is_refused() {
        let scale = ToleranceScale { reach_m: Some(1.0) };
        let severity = |unit, value| scale.examine(unit, "key", value).map(|found| found.severity);
        assert_eq!(severity(Unit::Length, 0.1), None);
        assert_eq!(severity(Unit::Length, 0.11), Some(Severity::Warning));
        assert_eq!(severity(Unit::Length, 1.0), Some(Severity::Warning));
        assert_eq!(severity(Unit::Length, 1e9), Some(Severity::Error));
        assert_eq!(severity(Unit::Angle, 0.3), None);
        assert_eq!(severity(Unit::Angle, 3.0), Some(Severity::Warning));
        assert_eq!(severity(Unit::Angle, 3.2), Some(Severity::Error));
        let open = ToleranceScale { reach_m: None };
        assert_eq!(open.examine(Unit::Length, "key", 0.9), None);
        assert!(open.examine(Unit::Length, "key", f64::INFINITY).is_some());
        assert!(open.examine(Unit::Angle, "key", 1e9).is_some());
    }
}
