//! A motion that tells the parameters of a robot.
