//! Chains of many joints: what is compared of them, what is not, and at which cost.

#[cfg(target_os = "linux")]
use crate::command::with_memory;
use crate::{calibration::Bench, command::congruent};

/// A URDF of a chain of so many revolute joints, its axes in turn along x, y and z; `shifted` is a joint 5 mm from its place.
fn chain(joints: usize, shifted: Option<usize>) -> String {
    let axes = ["0 0 1", "0 1 0", "1 0 0"];
    let link = |at: usize| {
        format!(
            "<link name=\"l{at}\"><inertial><mass value=\"0.5\"/><inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" \
             iyz=\"0\"/></inertial></link>\n"
        )
    };
    let joint = |at: usize| {
        let [x, y, z] = [7, 11, 13].map(|prime| 0.01 * f64::from(u32::try_from(at * prime % 9).unwrap()));
        let x = if shifted == Some(at) { x + 0.005 } else { x };
        format!(
            "<joint name=\"j{at}\" type=\"revolute\"><parent link=\"l{}\"/><child link=\"l{at}\"/><origin xyz=\"{x} {y} {z}\"/>\
             <axis xyz=\"{}\"/><limit lower=\"-2\" upper=\"2\" effort=\"10\" velocity=\"2\"/></joint>\n",
            at - 1,
            axes[at % 3]
        )
    };
    let links: String = (0..=joints).map(link).collect();
    let joints: String = (1..=joints).map(joint).collect();
    format!("<robot name=\"chain\">\n{links}{joints}</robot>\n")
}

#[test]
fn torques_of_many_joints_are_not_compared_which_is_no_disagreement() {
    let bench = Bench::new();
    let urdf = bench.write("chain.urdf", &chain(70, None));
    let found = congruent(&["check", &urdf, "--against", &urdf, "--format", "json"]);
    let report = found.json();
    assert_eq!((found.code, &report["verdict"]), (0, &"agree".into()), "{}", found.stderr);
    let not_asked = report["not_asked"].as_array().unwrap();
    assert!(not_asked.iter().any(|of| of["source"] == "other_dynamics"), "{not_asked:?}");
    assert!(report["against"]["dynamics_not_compared"].is_null());
}

/// Candidates and fits of a diagnosis grow with the square of the joints; what is kept of them does not.
#[test]
#[cfg(target_os = "linux")]
fn a_long_chain_is_diagnosed_in_little_memory() {
    /// Of which 60 MB are the program's own.
    const MOST_KIB: u32 = 160 << 10;
    let bench = Bench::new();
    let urdf = bench.write("chain.urdf", &chain(100, None));
    let shifted = bench.write("shifted.urdf", &chain(100, Some(50)));
    let mut command = with_memory(MOST_KIB, &["check", &shifted, "--against", &urdf]);
    let ended = command.output().unwrap();
    let [text, said] = [&ended.stdout, &ended.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    assert_eq!(ended.status.code(), Some(1), "{text}{said}");
    assert!(text.contains("of joint \"j50\" is the first that is elsewhere, by up to 5 mm"), "{text}");
}
