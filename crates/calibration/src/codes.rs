//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    measurements {
        JSON = "CGR-TABLE-011", "measurements::json",
            "The file is not a JSON array of measurements. An entry has the joints and what was measured.\n    [{\"q\": {\"elbow_joint\": 0.1}, \"translation_m\": [0.5, 0, 0.3]}]";
        NONE = "CGR-TABLE-012", "measurements::none",
            "The file has no measurement, so there is nothing to fit. Add a line for each measured configuration.\n    wrong: a file with a header alone\n    right: a header and the line 0,0,0.9,0.01";
        NOTHING_MEASURED = "CGR-TABLE-013", "measurements::nothing_measured",
            "No column gives a measured position or orientation. Then there is nothing to compare with the model. Add the measured position, and the orientation if it was measured.\n    wrong: joint_1_deg,joint_2_deg\n    right: joint_1_deg,joint_2_deg,x_m,y_m";
        UNKNOWN_COLUMN = "CGR-TABLE-014", "measurements::unknown_column",
            "A column is neither a joint nor a measured quantity. Often the columns are separated by semicolons or tabs. Separate them with commas, and write decimals with a point.\n    wrong: joint_1_deg;joint_2_deg;x_m;y_m\n    right: joint_1_deg,joint_2_deg,x_m,y_m";
        REPEATED_COLUMN = "CGR-TABLE-015", "measurements::repeated_column",
            "Two columns give the same quantity. The two may contradict each other. Remove one.\n    wrong: joint_1_deg,joint_2_deg,x_m,x_mm\n    right: joint_1_deg,joint_2_deg,x_m,y_m";
        REPEATED = "CGR-TABLE-016", "measurements::repeated",
            "A measurement gives the same quantity by two keys. The two may contradict each other. Keep one of the keys.\n    wrong: \"translation_m\": [0.9, 0.01], \"translation_mm\": [900, 10]\n    right: \"translation_m\": [0.9, 0.01]";
        MISSING_JOINT = "CGR-TABLE-017", "measurements::missing_joint",
            "A joint of the chain has no column, so its position is unknown. Each joint of the chain needs its position in each measurement. Add the column.\n    wrong: joint_1_deg,x_m,y_m\n    right: joint_1_deg,joint_2_deg,x_m,y_m";
        UNIT = "CGR-TABLE-018", "measurements::unit",
            "The name of a column lacks a unit, or has a unit that does not fit its joint.\n    elbow_joint_deg";
        CELLS = "CGR-TABLE-019", "measurements::cells",
            "A line has another number of cells than the header, so a value is missing or added, and the values after it would be read as other quantities. Give each line a cell for each column.\n    wrong: 30,20,0.6\n    right: 30,20,0.6,0.6";
        EMPTY_CELL = "CGR-TABLE-020", "measurements::empty_cell",
            "A cell of a joint is empty. A missing position is not taken as 0. Write the position, or remove the line.\n    wrong: 30,,0.6,0.6\n    right: 30,20,0.6,0.6";
        NUMBER = "CGR-TABLE-021", "measurements::number",
            "A cell is not a finite number. Write decimals with a point. NaN and words for missing values are not numbers.\n    wrong: 30,20,n/a,0.6\n    right: 30,20,0.6,0.6";
        TRANSLATION = "CGR-TABLE-022", "measurements::translation",
            "A measured position does not have two or three coordinates, or a coordinate is not a distance. Give x, y and z, or x and y for a planar measurement.\n    wrong: \"translation_m\": [0.9]\n    right: \"translation_m\": [0.9, 0.01]";
        ORIENTATION = "CGR-TABLE-023", "measurements::orientation",
            "A measured orientation is incomplete, is given twice, or is not a rotation. Give a quaternion of norm 1, or roll, pitch and yaw, not both.\n    wrong: x_m,y_m,z_m,roll_deg\n    right: x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg";
        SEEN_POINT = "CGR-TABLE-030", "measurements::seen_point",
            "A camera on the robot saw a target, and a row does not give all three coordinates of the target in the frame of the camera. A row then places no point. Give x, y and z, with or without an orientation, or leave the row out.\n    wrong: joint_1_deg,x_m,y_m\n    right: joint_1_deg,x_m,y_m,z_m";
    }
    calibrate {
        ROBOT = "CGR-COMMAND-020", "calibrate::robot",
            "No joint moves the tip relative to the base, so there is nothing to calibrate. Choose base and tip so that a joint between them moves.\n    wrong: congruent calibrate robots/ur5e measured.csv --tip base\n    right: congruent calibrate robots/ur5e measured.csv --tip tool0";
        NO_TABLE = "CGR-COMMAND-021", "calibrate::no_table",
            "Corrections of table entries were requested, but the robot has no Denavit-Hartenberg table. Free zero-offsets, axes, base or tool instead.\n    wrong: --free dh\n    right: --free zero-offsets";
        NOTHING_FREE = "CGR-COMMAND-022", "calibrate::nothing_free",
            "No correction is free, so there is nothing to fit. Free a group or a single correction with --free; the help lists the groups.\n    wrong: --free zero-offsets --hold zero-offsets\n    right: --free zero-offsets";
        UNKNOWN_CORRECTION = "CGR-COMMAND-023", "calibrate::unknown_correction",
            "--free names neither a group of corrections nor a single correction. The help has the most similar name and the known ones.\n    wrong: --free zero-offset\n    right: --free zero-offsets";
        NEXT = "CGR-COMMAND-024", "calibrate::next",
            "More configurations were requested than there are candidates to choose from. Ask for fewer; the help names the number of candidates.\n    wrong: --next 100000\n    right: --next 10";
        OTHER_MOTION = "CGR-COMMAND-091", "calibrate::other_motion",
            "A calibrated robot is to be written, and a joint of the URDF turns or slides in another direction than the table says, or less than its variable. No origin of the joint makes the two the same. Correct the sign or the kind of the row first.\n    wrong: sign = -1 for a joint that turns as its variable says\n    right: sign = 1";
        SAME_POINT = "CGR-COMMAND-093", "calibrate::same_point",
            "A file of --same-point has too few configurations: of those at one point some are held out, and the others must still determine the point. Touch the point in more configurations that differ much.\n    wrong: three lines\n    right: thirty lines";
        UNPROVED = "CGR-COMMAND-092", "calibrate::unproved",
            "The files of a calibrated robot were read again, and the robot in them is not the calibrated one, so they were removed. This is a fault of Congruent: please report it with the robot and the measurements.\n    congruent calibrate robots/ur5e measured.csv --format json";
    }
    measured_check {
        TOLERANCE = "CGR-COMMAND-081", "measured_check::tolerance",
            "Measured poses are compared with a model, and no tolerance says how far they may be off. Measured values never agree to the digits of a model, so there is no default. Take it from the accuracy of arm and instrument: 1 to 3 mm for an arm as it is delivered, 0.5 mm for a calibrated one.\n    wrong: congruent check robots/ur5e --measurements points.csv\n    right: congruent check robots/ur5e --measurements points.csv --tolerance 1mm";
        ARM = "CGR-COMMAND-082", "measured_check::arm",
            "--free names a correction of the arm, which would hide what is compared. Base and tool may be fitted, since they are often not known; congruent calibrate fits the arm.\n    wrong: --free base,dh\n    right: --free base,tool";
        TOO_FEW = "CGR-COMMAND-083", "measured_check::too_few",
            "The measurements determine base and tool and no more, so any arm would agree with them. Measure at more configurations, or free less.\n    wrong: --free base,tool with two measured poses\n    right: --free base,tool with ten of them";
    }
}
