//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    scenario {
        STEP = "CGR-SCENARIO-017", "scenario::step",
            "The time step must be greater than 0, and must not exceed the largest step of the physics or the duration. Give for example 0.001 s.\n    wrong: step_s = 1\n    right: step_s = 0.001";
        STEPS = "CGR-SCENARIO-018", "scenario::steps",
            "The run has more steps than the limit of one run. Give a longer `step_s` or a shorter `duration_s`.\n    wrong: step_s = 1e-9\n    right: step_s = 0.001";
        DURATION = "CGR-SCENARIO-019", "scenario::duration",
            "The duration of the run is missing, or is not greater than 0. Give `duration_s` under [simulation], or a [[motion]].\n    wrong: no duration_s and no [[motion]]\n    right: duration_s = 1.0";
        DURATION_ROUNDED = "CGR-SCENARIO-020", "scenario::duration_rounded",
            "The duration is not a whole number of steps. The run takes the nearest whole number of steps. Give a multiple of `step_s` to be rid of the warning.\n    wrong: duration_s = 1.0005\n    right: duration_s = 1.0";
        CUT_SHORT = "CGR-SCENARIO-021", "scenario::cut_short",
            "The run ends before its motions end. The checks do not see the rest of the motions. Remove `duration_s` to run to the end of the motions.\n    wrong: duration_s = 0.5\n    right: duration_s = 1.0";
        SHARE = "CGR-SCENARIO-038", "scenario::share",
            "The share of a limit that a check allows is so large that the check would pass a violation of the limit itself. The help names the largest share.\n    wrong: velocity_share = 1.5\n    right: velocity_share = 0.9";
        TAKEN_TOO_LATE = "CGR-SCENARIO-074", "scenario::taken_too_late",
            "A payload is attached after the end of the run, so it is never carried. Give an earlier `from_s`, or a longer run.\n    wrong: from_s = 5.0\n    right: from_s = 0.5";
        GOAL = "CGR-SCENARIO-080", "scenario::goal",
            "A goal has a rotation but no tolerance for it, or a tolerance but no rotation. Give both for a pose, neither for a position.\n    wrong: rpy_deg = [180, 0, 0] and position_mm = 1.0 alone\n    right: orientation_deg = 1.0, too";
        TRACKING = "CGR-SCENARIO-081", "scenario::tracking",
            "A `tracking` check has no limit. Or it has `settling_s` but no goal limit (such as `goal_deg`), which is the band that counts as settled. Or its limit is for a kind of joint that the robot does not have. Give a limit, and the goal limit of the joints that the robot has.\n    wrong: settling_s = 0.2\n    right: settling_s = 0.2 and goal_deg = 0.1";
    }
}
