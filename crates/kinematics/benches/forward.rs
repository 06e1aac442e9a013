//! What one forward kinematics costs, on arms of six joints.

fn main() {
    divan::main();
}
