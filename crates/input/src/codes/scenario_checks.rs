//! Findings about what is around the robot of a scenario, its payloads and faults, and its checks.

use super::Area;

pub(super) const AREAS: &[Area] = &[Area {
    word: "SCENARIO",
    codes: &[
        (
            55,
            "scenario::obstacle_name",
            "An obstacle has no name. Reports and checks refer to an obstacle by its name. Give it one.",
        ),
        (
            56,
            "scenario::obstacle_twice",
            "Two obstacles share a name. Reports and checks could not distinguish them. Rename one.",
        ),
        (
            57,
            "scenario::obstacle_is_link",
            "An obstacle has the name of a link of the robot. A pair of names in a check of distances would be ambiguous. Rename the obstacle.",
        ),
        (
            58,
            "scenario::obstacle_shape",
            "An obstacle must have exactly one shape. Give one of `box_m`, `sphere_radius_m`, `cylinder`, `mesh`.",
        ),
        (
            59,
            "scenario::obstacle_size",
            "A size or a coordinate of an obstacle exceeds 100,000 m. Give lengths in metres, or coordinates in millimetres under `xyz_mm`.",
        ),
        (60, "scenario::obstacle_path", "The path of an obstacle cannot be followed."),
        (
            61,
            "scenario::obstacle_overlap",
            "An obstacle overlaps the robot at the start; the contact forces would throw them apart. Move the obstacle or change [start]. Meshes are replaced by their convex hulls, which are larger. The controller \"kinematic\" moves the robot without forces.",
        ),
        (62, "scenario::zone_name", "A zone has no name. Reports refer to a zone by its name. Give it one."),
        (
            63,
            "scenario::zone_twice",
            "Two zones share a name. Reports could not distinguish them. Rename one.",
        ),
        (
            64,
            "scenario::zone_is_link",
            "A zone has the name of a link of the robot. Reports could not distinguish them. Rename the zone.",
        ),
        (
            65,
            "scenario::zone_shape",
            "A zone must have exactly one shape. Give one of `box_m`, `sphere_radius_m`, `cylinder`.",
        ),
        (
            66,
            "scenario::zone_size",
            "A size or a coordinate of a zone exceeds 100,000 m. Give lengths in metres, or coordinates in millimetres under `xyz_mm`.",
        ),
        (
            67,
            "scenario::zone_links",
            "A zone applies to no link, or to links without a shape. Then no link is forbidden to enter it. Give links = [\"*\"] for all moving links, or names of links that have a shape.",
        ),
        (
            68,
            "scenario::zone_unchecked",
            "No check covers the zones, so they have no effect. Add a check of zones; the help has its `kind`.",
        ),
        (
            69,
            "scenario::no_zone",
            "A check of zones is given, but the scenario has no zone. Add a [[zone]] with a name, links, a shape and a position.",
        ),
        (
            70,
            "scenario::grasp",
            "A grasp does not name an obstacle or a link, or its times or its mass do not fit.",
        ),
        (
            71,
            "scenario::grasp_inertia",
            "The inertia of a grasped body is missing, or no rigid body can have it. Give `inertia_kg_m2`: each of the three moments must be at most the sum of the other two.",
        ),
        (
            72,
            "scenario::payload",
            "The mass or inertia of a payload is impossible for a rigid body, or the payload has no name.",
        ),
        (
            73,
            "scenario::payload_twice",
            "Two payloads share a name. Reports could not distinguish them. Rename one.",
        ),
        (
            74,
            "scenario::taken_too_late",
            "A payload is attached after the end of the run, so it is never carried. Give an earlier `from_s`, or a longer run.",
        ),
        (
            75,
            "scenario::fault_value",
            "A fault has no value, more than one value, or a value outside its range.",
        ),
        (
            76,
            "scenario::fault_time",
            "A fault begins outside of the run. A fault must begin before the end of the run, and end after it began and within the run.",
        ),
        (
            77,
            "scenario::fault_no_effect",
            "A fault has no effect in this run. The message says why, the help what to change. A run with it would look as if no check could detect the fault.",
        ),
        (
            78,
            "scenario::faults_exclude",
            "Two faults of a joint cannot act at the same time. Let one end (`until_s`) before the other begins (`at_s`), or remove one of them.",
        ),
        (
            79,
            "scenario::no_limit",
            "A check has no limit, so it could never fail. Give at least one limit; the help names the keys.",
        ),
        (
            80,
            "scenario::goal",
            "A goal has a rotation but no tolerance for it, or a tolerance but no rotation. Give both for a pose, neither for a position.",
        ),
        (
            81,
            "scenario::tracking",
            "A `tracking` check has no limit. Or it has `settling_s` but no goal limit (such as `goal_deg`), which is the band that counts as settled. Or its limit is for a kind of joint that the robot does not have.",
        ),
        (
            82,
            "scenario::expect",
            "The scenario expects a failure of a check that it does not have, or lists checks while it expects the verdict pass.",
        ),
        (
            83,
            "clearance::unknown_name",
            "A pair names something that is neither a link nor an obstacle. The help has the most similar name and the known ones.",
        ),
        (
            84,
            "clearance::no_pair",
            "A check of distances has no pair to measure, so it would always pass. Ignore fewer pairs, or remove the check.",
        ),
        (
            85,
            "clearance::pair_in_both",
            "A pair is listed both as measured and as ignored. The two contradict each other. Remove it from one of the lists.",
        ),
        (
            86,
            "clearance::pair_not_measured",
            "The distance of a pair is not measured: the two cannot move relative to each other, or have no shape. Remove the pair from `pairs`. A pair that the SRDF disables is not measured, either.",
        ),
        (
            87,
            "scenario::long_run",
            "The physics of this many joints takes minutes or more: the time of a step grows with the cube of the number of joints. Give a longer `step_s` or a shorter `duration_s`, or use a robot with fewer moving joints.",
        ),
        (
            88,
            "scenario::unwatched",
            "No check measures the distance to an obstacle or its contacts, so a run in which the arm passes through the obstacle would pass. Add a [[check]] with kind = \"clearance\" or \"contact\".",
        ),
    ],
}];
