//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    log {
        FORMAT = "CGR-LOG-001", "log::format" unreadable,
            "The log is of a format that is not read: a bag of ROS 1 (.bag), a file that was compressed as a whole (.mcap.zstd), or, in a program that was built without the feature `db3`, a SQLite bag (.db3). The help has the command that makes an MCAP of it.\n    wrong: congruent describe monday.bag\n    right: congruent describe monday.mcap";
        NOT_MCAP = "CGR-LOG-002", "log::not_mcap" unreadable,
            "The file is named .mcap but does not begin as one. It was damaged in its first bytes, or is another file under this name.";
        FOLDER = "CGR-LOG-003", "log::folder" unreadable,
            "The folder has no file of a format that is read. Files are found by their endings, since the names in metadata.yaml are often those of before a file was renamed.";
        COMPRESSED_MESSAGES = "CGR-LOG-004", "log::compressed_messages" unreadable,
            "Each message was compressed on its own (compression mode `message`), which only rosbag2 reads. Chunks that are compressed as a whole are read. Convert the bag; the help has the lines.\n    wrong: compression_mode: message\n    right: compression_mode: \"\"";
        ENCODING = "CGR-LOG-005", "log::encoding" unreadable,
            "The joint states or poses of a topic are not encoded as CDR, as ROS 2 does, but as ROS 1 (ros1), Protobuf or JSON. Only CDR is read. Convert the log; nothing else of it has joints or poses.\n    rosbags-convert --src monday.bag --dst monday --dst-storage mcap";
        TRUNCATED = "CGR-LOG-006", "log::truncated",
            "The log has no end: its recorder was killed, it is still being written, or it was cut when it was copied. All that is whole is read; what was recorded behind the last whole chunk is lost.";
        DAMAGED = "CGR-LOG-007", "log::damaged",
            "A part of the log is damaged: its sum is wrong, it cannot be decompressed, a page of a database is not what it should be, or a length in it is impossible. No message of that part is used. The message has the place and, if the file says so, the time. Copy the log again from the recorder.";
        MESSAGE = "CGR-LOG-008", "log::message",
            "Messages of a type that is read cannot be decoded: they end early, or a length in them is impossible. They are counted and not used. Often the type that the log declares is not the one that was published.";
        NOTHING_READ = "CGR-LOG-009", "log::nothing_read",
            "The log has neither joint states nor poses nor TF. The help lists the types that it has. Record /joint_states and /tf.\n    wrong: ros2 bag record /rosout\n    right: ros2 bag record -s mcap /joint_states /tf /tf_static /robot_description";
        JOINTS = "CGR-LOG-010", "log::joints",
            "Names of joints in the log are not those of the robot, or joints of the robot are not in the log. The message has the common prefix if there is one, the help the nearest names.\n    wrong: left_elbow_joint in the log, elbow_joint in the URDF\n    right: the same name, or a prefix that all joints of the topic have";
        UNIT = "CGR-LOG-011", "log::unit",
            "Recorded positions lie beyond the limits of the robot, and would lie within them if they were degrees, or millimetres of a joint that slides. Joint states of ROS are in rad and m. Correct the program that publishes them, or convert the log.\n    wrong: position: [-90.0]\n    right: position: [-1.5708]";
        BEYOND_LIMITS = "CGR-LOG-012", "log::beyond_limits",
            "A tenth or more of the recorded positions of a joint lie beyond its limits, and another unit does not make them fit. The robot is another one, the joints have another zero or direction, or the limits of the file are too narrow.";
        TABLE_ENCODING = "CGR-LOG-013", "log::table_encoding" unreadable,
            "The table is not a text of numbers: it is UTF-16, has no row with more than one number, or its header has another number of names than its rows have cells. Save it as CSV in UTF-8 with a name for each column.";
        TIME = "CGR-LOG-014", "log::time" unreadable,
            "The rows of the table have no time: no column is named as one, or that column has whole seconds or one value throughout. Then the rate of the rows must be given.\n    wrong: congruent describe q.csv\n    right: congruent describe q.csv --rate-hz 125";
        COLUMNS = "CGR-LOG-015", "log::columns" unreadable,
            "No column of the table is of a joint. Columns are found by the names of the joints of --robot, or by words such as position, q, velocity, effort. The help lists the columns.\n    wrong: a,b,c\n    right: time_s,elbow_position,wrist_position";
        ROWS = "CGR-LOG-016", "log::rows",
            "Rows of the table have another number of cells than its columns, or cells that are not numbers. Such rows are not used; such cells count as missing. The message has their number and the first line.";
        LENGTHS = "CGR-LOG-018", "log::lengths",
            "Arrays of joint states are neither empty nor as long as the list of names, so which value is of which joint is unknown. The values of such messages are not used. Correct the driver.\n    wrong: name: [a, b, c], position: [0.1, 0.2]\n    right: name: [a, b, c], position: [0.1, 0.2, 0.3], velocity: []";
        STAMPS = "CGR-LOG-017", "log::stamps",
            "The stamps of a topic go back by more than a second: a clock was set, a simulation or a replay was started again. What is before and after cannot be ordered by stamps. Cut the log there, or use the time of the recorder.";
        NO_DESCRIPTION = "CGR-LOG-019", "log::no_description",
            "The log has no description of the robot, so that there is none to compare. Nodes publish it once, at their start; a recorder that begins later gets it if it subscribes with the durability `transient_local`, as `ros2 bag record` does by itself.\n    wrong: ros2 bag record -s mcap /joint_states\n    right: ros2 bag record -s mcap /joint_states /robot_description";
        DESCRIPTIONS = "CGR-LOG-020", "log::descriptions",
            "The log has several descriptions of a robot: on two topics, or one that was published again with another text. On one topic the last one is compared. Of two topics nobody says which is meant: keep one.\n    wrong: topics /left/robot_description and /right/robot_description\n    right: one of the two, by `ros2 bag convert` with `topics: [/left/robot_description]`";
        DATABASE = "CGR-LOG-021", "log::database" unreadable,
            "The file is named .db3 and is no database of SQLite, or has not the tables `topics` and `messages` that rosbag2 writes, or a file -wal or -journal beside it must be taken in first. It was damaged in its first bytes, is a database of another program, is in a folder that is read-only, or its recorder died while it wrote.";
        PARQUET = "CGR-LOG-022", "log::parquet" unreadable,
            "The file is no Parquet that is read: it has no end, is damaged, or is compressed by another method than snappy, which is read without a decoder in C; or a dataset of LeRobot has no file with rows. Write it again by pyarrow.\n    wrong: pq.write_table(table, \"log.parquet\", compression=\"zstd\")\n    right: pq.write_table(table, \"log.parquet\", compression=\"snappy\")";
        MOTOR_UNITS = "CGR-LOG-023", "log::motor_units",
            "Positions of a dataset of LeRobot are values of the motor bus: -100 to 100 of the range that was calibrated, 0 to 100 for a gripper, degrees, or rad. The dataset does not say which; the calibration file of the arm does. Nothing is converted: compared with a robot, values of another unit lie beyond its limits.\n    wrong: shoulder_pan.pos from -98.2 to 99.1\n    right: shoulder_pan_position from -1.9 to 1.9, in rad";
        LINES = "CGR-LOG-024", "log::lines",
            "Lines of a log or stream in JSON Lines are no messages. They are not used; the message has the first of them, or each as it comes. A line has its time in s and positions by the names of joints, or a pose.\n    wrong: {\"q\": [0.4, 0.1]}\n    right: {\"time_s\": 1.25, \"q\": {\"elbow_joint\": 0.4}}";
        STREAM = "CGR-LOG-025", "log::stream" unreadable,
            "A stream broke off with an error of the system. What came until then was judged. Look at the program that writes it.\n    my_driver | congruent watch robots/ur5e";
        RTDE = "CGR-LOG-026", "log::rtde" unreadable,
            "The controller of a Universal Robot cannot be reached, or does not give what is asked for by RTDE (port 30004). Give the address of the robot, allow RTDE in its settings of network services, and look whether a firewall is between. A variable that it does not know is named.\n    congruent watch robots/ur5e --rtde 192.168.1.10";
        MISSING_FILES = "CGR-LOG-028", "log::missing_files",
            "The metadata.yaml of a bag names files that are not in its folder: it was copied in part. What is there is read; the rest of the recording is not judged. Copy the whole folder again.\n    wrong: monday/metadata.yaml, monday/monday_1.mcap\n    right: monday/metadata.yaml, monday/monday_0.mcap, monday/monday_1.mcap";
        STATE_NAMES = "CGR-LOG-029", "log::state_names",
            "The meta/info.json of a dataset of LeRobot does not name the values of observation.state, one for each, or is no JSON. They are called joint_1, joint_2 and so on, by which no joint of a robot is found.\n    wrong: \"observation.state\": {\"shape\": [2], \"names\": null}\n    right: \"observation.state\": {\"shape\": [2], \"names\": [\"shoulder_pan\", \"gripper\"]}";
        MILLISECONDS = "CGR-LOG-030", "log::milliseconds",
            "The lines of a log or stream in JSON Lines are 1 to 1000 s apart by their time_s. Robots are recorded faster: such times are mostly in ms. They are read as s, by which every velocity is a thousandth of what it was.\n    wrong: {\"time_s\": 1250, \"q\": {\"elbow_joint\": 0.4}}\n    right: {\"time_s\": 1.25, \"q\": {\"elbow_joint\": 0.4}}";
        EPISODE = "CGR-LOG-027", "log::episode" unreadable,
            "The episode that is to be read alone is not in the log: the dataset has no episode with this index, or the log is no Parquet with a column episode_index. The message has the range of indices.\n    wrong: congruent replay robots/so101 pusht --episode 50\n    right: congruent replay robots/so101 pusht --episode 49";
    }
}
