//! Analytical kinematics: Denavit-Hartenberg tables, screws and URDF chains.
