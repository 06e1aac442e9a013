//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    tolerances {
        ROBOT = "CGR-COMMAND-105", "tolerances::robot",
            "The errors of the chain cannot be computed, as of a chain without a moving joint. Choose another chain with --base and --tip.\n    wrong: congruent tolerances robots/ur5e --tip base\n    right: congruent tolerances robots/ur5e --tip tool0";
        NONE = "CGR-COMMAND-106", "tolerances::none",
            "No parameter of the robot has a tolerance, so nothing varies, or a tolerance is of a parameter that the robot does not have. Declare [tolerances] in robot.toml, or give tolerances as options: --a, --d, --alpha and --theta of the rows of a table, --xyz and --rpy of the origins of joints without one, --zero of the joints, --tcp; or take them from --calibration FILE or --digits.\n    [tolerances]\n    a_mm = 0.05\n    d_mm = 0.05\n    alpha_deg = 0.02\n    theta_deg = 0.02";
        JOINT = "CGR-COMMAND-107", "tolerances::joint",
            "A row of [tolerances] names a joint that is not of the chain, or one that has a row already. The help has the most similar name and the known ones.\n    wrong: joint = \"elbow\"\n    right: joint = \"elbow_joint\"";
        CALIBRATION = "CGR-COMMAND-108", "tolerances::calibration",
            "The file of --calibration is not what `congruent calibrate --format json` prints of this robot, or has no covariance.\n    congruent calibrate robots/ur5e points.csv --format json > calibration.json";
    }
}
