//! The codes of the messages of this crate, with what `congruent explain` says about them.

congruent_input::codes! {
    replay {
        READ = "CGR-COMMAND-088", "replay::read",
            "The log ends in the middle of what is read of it, or has no instant with all joints of the robot. `congruent describe LOG --robot ROBOT` shows what is there.\n    congruent describe monday.mcap --robot robots/ur5e";
        POSES = "CGR-COMMAND-087", "replay::poses",
            "The log has no topic of this name with poses. `congruent describe LOG` lists its topics.\n    wrong: --measured-pose /tracker\n    right: --measured-pose /tracker/pose";
    }
    identify {
        EFFORT = "CGR-COMMAND-101", "identify::effort",
            "The log has no efforts of the robot, or they are nothing that can be identified from: neither torques, nor torques without gravity, nor currents by the masses of the description. State what they are, and correct the masses of the description if they are placeholders.\n    congruent identify robots/ur5e monday.mcap --effort current";
        MOTION = "CGR-COMMAND-102", "identify::motion",
            "The log has no instants to identify from: no joint moves fast enough, or rows are too far apart for velocities and accelerations. At rest, masses show by gravity alone.\n    congruent identify robots/ur5e monday.mcap --still --free payload";
        FREE = "CGR-COMMAND-103", "identify::free",
            "What is to be identified cannot be: a link or a joint of this name is not there, or two parameters show their ratio alone, as the masses of all links and the torque constants of all motors.\n    wrong: --effort current --free links\n    right: --effort current --free links --torque-constant elbow_joint=9.2";
        PLAN = "CGR-COMMAND-104", "identify::plan",
            "No motion was found that stays within the limits of the robot and keeps its links away from each other and from obstacles. Ask for less clearance, or begin where there is room.\n    congruent plan robots/ur5e --clearance 5mm";
    }
}
